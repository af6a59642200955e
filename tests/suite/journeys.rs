//! What a person came for, in how many keys: the real program on terminals of two sizes.

use std::fs;
use std::path::Path;

use super::support::pseudo_terminal::RunningShelter;
use super::support::{Edited, PATIENCE, PROGRAM, output, text, wait};

const SIZES: [(u16, u16); 2] = [(80, 24), (120, 36)];
const ENTER: &str = "\r";
const RIGHT: &str = "\x1b[C";
const DOWN: &str = "\x1b[B";

/// Sixteen tires; two options, whose cables hold at a safety factor of 3.
const PLAN: &str = r#"
title = "Walk"
shelter = { layout = "grid", rows = 4, columns = 4, spacing_m = 2.6 }
tire = { mass_kg = 280 }
cable = { rope = "GOST 2688-80 6.2" }
ground = { friction = 0.5 }
limits = { flight_height_m = 2, cable_safety_factor = 3 }
simulation = { accuracy = "draft" }
search = { intervals_ms = [25, 34] }
blast_row = [{ name = "1", under_row = 2, launch_m_s = 5 }, { name = "2", under_row = 3, launch_m_s = 5 }]

[[delay]]
name = "42 ms"
interval_ms = 42

[uncertainty]
launch_common_percent = 1
launch_between_shots_percent = 0
launch_mass_exponent = [1, 1]
launch_row_cv_percent = 0
launch_tilt_deg = 0
launch_tilt_common_deg = 0
hole_position_m = 0
pattern_offset_m = 0
hole_fails_percent = 0
cable_length_m = 0
"#;

/// A program that is used key by key.
struct Walk {
    watched: RunningShelter,
    keys: usize,
}

impl Walk {
    fn begin(arguments: &[&str], folder: &Path, (columns, rows): (u16, u16)) -> Self {
        Self { watched: RunningShelter::start(arguments, folder, columns, rows), keys: 0 }
    }

    /// Presses keys one by one, then waits for a text on the screen.
    fn press(&mut self, keys: &[&str], then: &str) {
        keys.iter().for_each(|key| self.watched.press(key));
        self.keys += keys.len();
        self.watched.until(then);
    }

    /// Leaves; returns the number of keys pressed before.
    fn leave(mut self) -> usize {
        self.watched.press("q");
        assert_eq!(self.watched.ends(), 0);
        self.keys
    }
}

fn written(folder: &Path, plan: &str) {
    fs::write(folder.join("plan.toml"), plan).expect("written");
}

fn saved(folder: &Path) -> String {
    fs::read_to_string(folder.join("plan.toml")).expect("the plan")
}

/// The plan that was saved is the same on terminals of both sizes, and passes in a script, too.
fn pass([small, large]: [String; 2]) {
    assert_eq!(small, large);
    let folder = tempfile::tempdir().expect("a folder");
    written(folder.path(), &small);
    let mut check = std::process::Command::new(PROGRAM);
    check.args(["check", "plan.toml", "--any", "--accuracy", "draft"]).current_dir(folder.path());
    let output = output(&mut check);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stdout));
}

#[test]
fn a_newcomer_has_a_passing_plan_in_forty_keys() {
    pass(SIZES.map(|size| {
        let folder = tempfile::tempdir().expect("a folder");
        let mut walk = Walk::begin(&["--accuracy", "draft"], folder.path(), size);
        walk.press(&[], "A new plan by a few questions");
        walk.press(&[ENTER], "launch, m/s");
        // Six questions are answered as offered; the height of a test tire and the interval are typed.
        walk.press(&[ENTER; 6], "launch, m/s");
        walk.press(&["0", ".", "5", "m", ENTER, "4", "2", ENTER], "safety factor");
        walk.press(&[ENTER, ENTER, ENTER], "Assumed, to be changed on");
        walk.press(&[ENTER], "42 ms passes, slide NOT checked, if your inputs hold");
        walk.press(&["s"], "save the plan as");
        walk.press(&[ENTER], "saved plan.toml");
        let keys = walk.leave();
        assert!(keys <= 40, "{keys} keys");
        saved(folder.path())
    }));
}

/// All that is a site's own: size, spacing, mass, rope, rows over holes, launch and every limit.
#[test]
fn a_plan_of_an_own_site_takes_fewer_than_forty_keys() {
    for size in SIZES {
        let folder = tempfile::tempdir().expect("a folder");
        let mut walk = Walk::begin(&["--accuracy", "draft"], folder.path(), size);
        walk.press(&[], "A new plan by a few questions");
        walk.press(&[ENTER], "launch, m/s");
        let own = [ENTER, "4", "x", "8", ENTER, "2", ".", "4", ENTER, "3", "0", "0", ENTER, RIGHT, ENTER];
        walk.press(&own, "300");
        walk.press(&["2", "-", "3", ENTER, "1", "m", ENTER, ENTER, "2", ".", "5", ENTER], "safety factor");
        walk.press(&["2", ENTER, "3", ENTER], "Assumed, to be changed on");
        walk.press(&[ENTER], "1 OPEN · 6 FAIL");
        walk.press(&["s"], "save the plan as");
        walk.press(&[ENTER], "saved plan.toml");
        let keys = walk.leave();
        assert!(keys < 40, "{keys} keys");
        let text = saved(folder.path());
        for line in ["rows = 4", "mass_kg = 300", "free_flight_height_m = 1", "drift_m = 3"] {
            assert!(text.contains(line), "{line}:\n{text}");
        }
    }
}

#[test]
fn a_failing_option_passes_by_the_programs_own_proposal_in_six_keys() {
    pass(SIZES.map(|size| {
        let folder = tempfile::tempdir().expect("a folder");
        written(folder.path(), &PLAN.edited("cable_safety_factor = 3", "cable_safety_factor = 4.5"));
        let mut walk = Walk::begin(&["plan.toml"], folder.path(), size);
        walk.press(&[], "0 of 1 pass");
        walk.press(&["w"], "rope GOST 2688-80 ");
        walk.press(&[DOWN], "Enter makes the selected change");
        walk.press(&[ENTER], " △ THIN");
        walk.press(&["s"], "saved plan.toml");
        let keys = walk.leave();
        assert!(keys <= 6, "{keys} keys");
        saved(folder.path())
    }));
}

#[test]
fn a_found_schedule_becomes_a_page_to_sign_in_eight_keys() {
    for size in SIZES {
        let folder = tempfile::tempdir().expect("a folder");
        // The options pass so narrowly that the nearest of what a pass stands on are soon found.
        written(folder.path(), &PLAN.edited("cable_safety_factor = 3", "cable_safety_factor = 2.8"));
        let mut walk = Walk::begin(&["plan.toml"], folder.path(), size);
        walk.press(&[], " △ THIN");
        walk.press(&["4", RIGHT, RIGHT, RIGHT, ENTER], "the best schedule found");
        walk.keys = 0;
        walk.press(&[ENTER, DOWN, ENTER], "25 ms △ THIN");
        walk.press(&["s"], "saved plan.toml");
        // The page says what the pass stands on.
        let watched = &walk.watched;
        let is_found = || (!watched.contents().contains("still being found")).then_some(());
        wait(PATIENCE, is_found, || watched.contents());
        // A new plan knows little: the pass is thin.
        walk.press(&["P"], "(THIN, slide NOT checked: ");
        walk.press(&[ENTER], "wrote plan-");
        let keys = walk.leave();
        assert!(keys <= 8, "{keys} keys");
        let files = fs::read_dir(folder.path()).expect("a folder").flatten().map(|file| file.path());
        let page = files
            .into_iter()
            .find(|file| file.to_string_lossy().ends_with("-thin-if-confirmed-to-be-fired.html"));
        let page = fs::read_to_string(page.expect("a page")).expect("a text");
        assert!(
            page.contains(", and a THIN pass, slide NOT checked: ") && !page.contains("Not saved"),
            "{page}"
        );
    }
}
