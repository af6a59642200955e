//! Texts that nobody would write: damaged plans and configurations. What `fuzz` does for hours, for a second.

use std::ops::ControlFlow;

use proptest::prelude::*;
use shelter::choice::Method;
use shelter::plan::{Layout, Plan};
use shelter::simulation::{RunError, RunSettings};
use shelter::study::Case;
use shelter::tui::config::{self, Config};

use super::bad_plans::GOOD;

/// Pieces that mean something where they land.
const PIECES: &[&str] = &[
    "",
    "0",
    "-1",
    "1e308",
    "nan",
    "\"",
    "[",
    "]",
    "{",
    "=",
    "\n",
    "'''",
    "\u{feff}",
    "[[delay]]",
    "layout = \"list\"",
    "quincunx",
    "border_rows = 2",
    "on_overload = \"break\"",
    "at_ms = [0, 0]",
    "under_row = 1.5",
    "free_flight_height_m = 3",
    "slack_percent = 7",
    "outer_diameter_m = 1",
];

/// A text with a few stretches replaced by pieces.
fn damaged(text: &'static str) -> impl Strategy<Value = String> {
    let edit = (any::<prop::sample::Index>(), 0..12_usize, prop::sample::select(PIECES));
    proptest::collection::vec(edit, 1..5).prop_map(move |edits| {
        let mut text = text.to_owned();
        for (at, length, piece) in edits {
            let places: Vec<usize> = text.char_indices().map(|(place, _)| place).collect();
            if places.is_empty() {
                continue;
            }
            let from = at.index(places.len());
            let to = (from + length).min(places.len() - 1);
            text.replace_range(places[from]..places[to], piece);
        }
        text
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    /// A damaged plan is refused with a reason, or moves with finite numbers by both methods.
    #[test]
    fn a_damaged_plan_is_refused_or_runs(text in damaged(GOOD)) {
        let plan = match Plan::parse("plan.toml", &text) {
            Ok(plan) => plan,
            Err(mistakes) => {
                let told = mistakes.iter().all(|(line, _, message, remedy)| {
                    line > 0 && !message.is_empty() && !remedy.is_empty()
                });
                prop_assert!(told, "a mistake has its place and remedy");
                prop_assert!(!mistakes.render(false).is_empty());
                return Ok(());
            }
        };
        if let Layout::Grid(mesh) | Layout::Quincunx(mesh) = &plan.layout
            && (mesh.rows + 2 * mesh.border_rows) * (mesh.columns + 2 * mesh.border_rows) > 400
        {
            return Ok(());
        }
        let case = Case::new(plan);
        let step = (0.2 * case.scene().critical_step()).min(1e-3);
        for method in [Method::Verlet, Method::Newmark] {
            let mut left = 20;
            let outcome = case.model.run(&case.shots[0], &RunSettings { method, step, duration: None }, &mut |motion| {
                left -= 1;
                let finite = (0..case.scene().tire_count()).all(|tire| motion.displacement(tire).norm().is_finite());
                if left > 0 && finite { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
            });
            let stopped_early = matches!(outcome, Err(RunError::Stopped { .. })) && left > 0;
            prop_assert!(!stopped_early, "{:?}: a number is not finite", method);
        }
    }

    /// A damaged configuration is a configuration or one mistake in words.
    #[test]
    fn a_damaged_configuration_is_refused_or_counts(text in damaged(CONFIG)) {
        if let Err(words) = Config::parse(&text) {
            prop_assert!(!words.is_empty());
        }
    }
}

const CONFIG: &str =
    "theme = \"light\"\nascii = true\n[keys]\nquit = [\"ctrl-q\", \"f10\"]\nsort = [\"S\"]\n";

#[test]
fn the_default_configuration_is_one() {
    assert!(Config::parse(&config::default_text()).is_ok());
    assert!(Config::parse(CONFIG).is_ok());
}
