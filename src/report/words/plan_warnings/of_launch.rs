//! Warnings about launches: surer than anybody can know them, or not of the plan's tires and charges.

use crate::plan::Launch;
use crate::plan::assumed::is_assumed;
use crate::plan::keys::uncertainty;
use crate::plan::observations::fitted_values;
use crate::report::language::{phrase, say};
use crate::scene::ASSUMED_PUSH_DEPTH;
use crate::sorting::sorted_by;
use crate::study::Case;
use crate::study::launch::{Blast, LaunchEstimates, fastest_launch};
use crate::units;

/// Warnings about launches that the signer confirms.
pub(super) fn warnings(case: &Case) -> Vec<String> {
    let single = [
        without_film(case),
        fitted_to_few(case),
        launch_below_estimate(case),
        launches_far_apart(case),
        charges_far_apart(case),
        launches_lighter_tire(case),
        tilted_to_x(case),
        leaning(case),
        deep_push(case),
        long_push(case),
    ];
    single.into_iter().flatten().collect()
}

/// Warning that holes push from deeper than the program assumes: a deeper push is milder beside a tire, and nothing measures the depth.
fn deep_push(case: &Case) -> Option<String> {
    let deepest = case.plan.launches().filter_map(|launch| launch.push_depth_m).reduce(f64::max)?;
    (deepest > ASSUMED_PUSH_DEPTH).then(|| {
        say!(
            "`push_depth_m = {deepest}`: nothing measures it, and a deeper push throws a tire less to the side; left out it is {} m: is it the stemming?",
            deepest,
            ASSUMED_PUSH_DEPTH
        )
    })
}

/// Warning that launches take a time: that makes cables pull less, and a guess is milder.
fn long_push(case: &Case) -> Option<String> {
    let longest = case.plan.launches().map(|launch| launch.push_ms).reduce(f64::max)?;
    (longest > 0.0).then(|| {
        say!("`push_ms = {longest}` makes cables pull less than a launch at once: was it measured?", longest)
    })
}

/// Line with the greatest lean of the launches, and its direction: that of the hole is the opposite.
fn leaning(case: &Case) -> Option<String> {
    let by_tilt = sorted_by(case.plan.launches(), |a, b| a.tilt_deg.total_cmp(&b.tilt_deg));
    let most = by_tilt.last().filter(|launch| launch.tilt_deg > 0.0 && launch.tilt_toward_deg != 0.0)?;
    Some(say!(
        "launches lean by up to {}° toward {}° from +x; the holes lean down the other way: is it so?",
        most.tilt_deg,
        most.tilt_toward_deg
    ))
}

/// Warning that no verdict passes on a launch velocity that nobody observed.
pub(super) fn launch_estimated(case: &Case) -> Option<String> {
    let uncertainty = &case.plan.uncertainty;
    let percent = units::short(uncertainty.launch_common_percent);
    let text = say!(
        "launch estimated: `launch_common_percent = {percent}` says that nobody observed this velocity, so no option passes; \
         film a loose test tire or a covered shot, see `shelter launch`",
        percent
    );
    uncertainty.launch_is_estimated().then_some(text)
}

/// Warning that the launch velocity is taken as surer than any film makes it, or that no film was fitted: at most one of both.
pub fn without_film(case: &Case) -> Option<String> {
    launch_too_sure(case).or_else(|| launch_without_film(case))
}

/// Warning that the launch velocity is taken as surer than any film makes it.
fn launch_too_sure(case: &Case) -> Option<String> {
    let uncertainty = &case.plan.uncertainty;
    let percent = units::short(uncertainty.launch_common_percent);
    let text = say!(
        "the launch velocity is taken as known to {percent} %, surer than any film: \
         write `launch_common_percent`, 50 for a guess, 10 for a filmed test tire, or what `shelter fit` finds",
        percent
    );
    case.plan.takes_launch_as_too_sure().then_some(text)
}

/// Warning that no film was fitted, though the launch velocity is taken as surer than one filmed test tire leaves it. A value
/// marked as assumed is confirmed as such, without this warning.
fn launch_without_film(case: &Case) -> Option<String> {
    let percent = units::short(case.plan.uncertainty.launch_common_percent);
    let is_marked = || is_assumed(&case.source.text, &uncertainty::LAUNCH_COMMON_PERCENT);
    let is_told = case.plan.takes_launch_as_filmed() && !case.plan.takes_launch_as_too_sure() && !is_marked();
    is_told.then(|| {
        say!(
            "the launch velocity is taken as known to {percent} %, and no film was fitted: one filmed test tire leaves 10 %; \
             fit your films, see `shelter fit`",
            percent
        )
    })
}

/// Warning that a plan was fitted to one or two observations: chance may have made its launches.
fn fitted_to_few(case: &Case) -> Option<String> {
    let few = match fitted_values(&case.plan.fitted_from) {
        1 => phrase("ONE observation"),
        2 => phrase("two observations"),
        _ => return None,
    };
    Some(say!("the launches are fitted to {few}: one film of one tire tells little, film more shots", few))
}

/// Warning that a tire of a list over a hole is lighter than the tire of `[tire]`: the plan's launch may have been observed on the
/// heavier tire.
fn launches_lighter_tire(case: &Case) -> Option<String> {
    let (scene, usual) = (case.scene(), case.plan.tire.mass_kg);
    let launched = case.shots.first()?.firings.iter().map(|firing| firing.tire);
    let lightest = launched.min_by(|a, b| scene.mass[*a].total_cmp(&scene.mass[*b]))?;
    let [mass, planned] = [scene.mass[lightest], usual].map(|mass| units::rounded(mass, 0));
    let text = say!(
        "tire {tire} over a hole has {mass} kg, that of [tire] {planned}: its launch is taken as written; was it filmed with so light a tire?",
        scene.tire_ids[lightest],
        mass,
        planned
    );
    (scene.mass[lightest] < 0.95 * usual).then_some(text)
}

/// Warning that the fastest launch of the plan is slower than the middle estimate from charge and stemming, and no shot was fitted.
fn launch_below_estimate(case: &Case) -> Option<String> {
    let (plan, estimates) = (&case.plan, LaunchEstimates::new(&Blast::of_plan(&case.plan), None, &[]));
    let band = estimates.chosen()?.band;
    let fastest = fastest_launch(plan);
    let [speed, low_m_s, middle, high_m_s] =
        [fastest, band[0], band[1], band[2]].map(|speed| units::rounded(speed, 1));
    let text = say!(
        "`launch_m_s = {speed}` is slower than the middle of what charge and stemming say, {middle} ({low_m_s} to {high_m_s} m/s): was it filmed? See `shelter launch`",
        speed,
        middle,
        low_m_s,
        high_m_s
    );
    (fastest < band[1] && plan.fitted_from.is_empty()).then_some(text)
}

/// Ratio of two launch velocities of the same charge, stemming and hole diameter, from which the plan gets a warning.
const FAR_APART: f64 = 1.5;

/// Warning that two launches of one charge differ far: one of them may be a slip.
fn launches_far_apart(case: &Case) -> Option<String> {
    let alike = |one: &Launch, other: &Launch| {
        (one.charge_kg, one.stemming_m, one.hole_diameter_mm)
            == (other.charge_kg, other.stemming_m, other.hole_diameter_mm)
    };
    let launches = sorted_by(case.plan.launches(), |a, b| a.speed_m_s.total_cmp(&b.speed_m_s));
    let (slowest, fastest) = (launches.first()?, launches.last()?);
    let is_told = alike(slowest, fastest) && fastest.speed_m_s >= FAR_APART * slowest.speed_m_s;
    let [slow, fast] = [slowest, fastest].map(|launch| launch.speed_m_s);
    is_told
        .then(|| say!("holes of one charge launch at {slow} and at {fast} m/s: is one a slip?", slow, fast))
}

/// Warning that holes of far different charges launch alike: the launch of one of them may have been left as it was.
fn charges_far_apart(case: &Case) -> Option<String> {
    let charged = case.plan.launches().filter_map(|launch| Some((launch.charge_kg?, launch.speed_m_s)));
    let by_charge = sorted_by(charged, |a, b| a.0.total_cmp(&b.0));
    let ((least, speed), (most, fastest)) = (*by_charge.first()?, *by_charge.last()?);
    (most >= FAR_APART * least && fastest <= speed).then(|| {
        say!(
            "a hole of {} kg launches at {} m/s, and one of {} kg no faster: was each filmed?",
            least,
            speed,
            most
        )
    })
}

/// Warning that all launches tilt toward the larger x: a tilt without a stated direction does that.
fn tilted_to_x(case: &Case) -> Option<String> {
    let mut tilted = case.plan.launches().filter(|launch| launch.tilt_deg > 0.0).peekable();
    let text = "launches tilt toward the larger x, as `tilt_toward_deg` is 0 or left out: do they?";
    (tilted.peek().is_some() && tilted.all(|launch| launch.tilt_toward_deg == 0.0))
        .then(|| phrase(text).to_owned())
}

#[cfg(test)]
mod tests {
    use super::super::of_plan;
    use super::super::tests::parsed;

    /// A slip in one row, such as 2.7 for 4.7, gets a warning. Rows of different charges may differ so.
    #[test]
    fn launches_of_one_charge_that_differ_far_are_asked_about() {
        let site = include_str!("../../../../plans/amur-three-rows.toml");
        let told = |first: &str| {
            let all = site.replace("launch_m_s = 6.0", "launch_m_s = 6.0\ncharge_kg = 25");
            let text = all.replacen("launch_m_s = 6.0\ncharge_kg = 25", first, 1);
            of_plan(&parsed(text)).join("\n").contains("is one a slip?")
        };
        for (first, is_told) in [
            ("launch_m_s = 4.1\ncharge_kg = 25", false),
            ("launch_m_s = 4.0\ncharge_kg = 25", true),
            ("launch_m_s = 3.9\ncharge_kg = 10", false),
        ] {
            assert_eq!(told(first), is_told, "{first}");
        }
    }

    /// Each of these makes a shot milder, or throws it the other way.
    #[test]
    fn depth_time_and_lean_of_a_push_are_asked_about() {
        let site = include_str!("../../../../plans/amur-three-rows.toml");
        let told = |more: &str| {
            let text = site.replacen("launch_m_s = 6.0", &format!("launch_m_s = 6.0\n{more}"), 1);
            of_plan(&parsed(text)).join("\n")
        };
        for (more, asked, is_asked) in [
            ("push_depth_m = 3", "is it the stemming?", true),
            ("push_depth_m = 0.8", "is it the stemming?", false),
            ("push_ms = 20", "makes cables pull less than a launch at once", true),
            ("push_ms = 0", "makes cables pull less", false),
            (
                "tilt_deg = 15\ntilt_toward_deg = 90",
                "lean by up to 15° toward 90° from +x; the holes lean down the other way",
                true,
            ),
            ("tilt_deg = 15\ntilt_toward_deg = 0", "lean by up to", false),
        ] {
            assert_eq!(told(more).contains(asked), is_asked, "{more}: {}", told(more));
        }
    }

    /// A tripled charge with the launch of the others is faster than written.
    #[test]
    fn charges_that_differ_with_one_launch_are_asked_about() {
        let site = include_str!("../../../../plans/amur-three-rows.toml");
        let told = |first: &str| {
            let all = site.replace("launch_m_s = 6.0", "launch_m_s = 6.0\ncharge_kg = 12");
            let text = all.replacen("launch_m_s = 6.0\ncharge_kg = 12", first, 1);
            of_plan(&parsed(text)).into_iter().find(|line| line.contains("was each filmed?"))
        };
        let asked = "a hole of 12 kg launches at 6 m/s, and one of 36 kg no faster: was each filmed?";
        assert_eq!(told("launch_m_s = 6.0\ncharge_kg = 36").as_deref(), Some(asked));
        assert!(told("launch_m_s = 6.0\ncharge_kg = 18").is_some());
        for first in ["launch_m_s = 6.0\ncharge_kg = 17", "launch_m_s = 9.0\ncharge_kg = 36"] {
            assert_eq!(told(first), None, "{first}");
        }
    }

    #[test]
    fn a_launch_that_is_an_estimate_or_below_one_is_told() {
        let site = include_str!("../../../../plans/amur-three-rows.toml");
        let told = |changes: &[[&str; 2]]| {
            let text = changes.iter().fold(site.to_owned(), |text, [old, new]| text.replace(old, new));
            of_plan(&parsed(text)).join("\n")
        };
        let estimated =
            "launch estimated: `launch_common_percent = 50` says that nobody observed this velocity";
        assert!(told(&[["launch_common_percent = 3 ", "launch_common_percent = 50 "]]).contains(estimated));
        assert!(!told(&[]).contains("launch estimated"));
        let slower = "is slower than the middle of what charge and stemming say";
        let blast = |speed: &str| {
            let all = format!("launch_m_s = {speed}\ncharge_kg = 60\nstemming_m = 2\nhole_diameter_mm = 115");
            told(&[["launch_m_s = 6.0", &all]])
        };
        assert!(blast("0.6").contains(slower), "{}", blast("0.6"));
        assert!(!blast("60").contains(slower) && !told(&[]).contains(slower));
    }

    /// A launch that was filmed under a heavy tire is faster under a light one.
    #[test]
    fn a_lighter_tire_over_a_hole_is_asked_about() {
        let told = |mass: &str| {
            let list = format!(
                "shelter = {{ layout = \"list\", tire = [{{ x_m = 0, y_m = 0, mass_kg = {mass} }}, {{ x_m = 2.6, y_m = 0 }}], cable = [{{ from = 1, to = 2 }}] }}\n\
                 tire = {{ mass_kg = 280, outer_diameter_m = 1.6 }}\ncable = {{ rope = \"Polyester 24\", termination_percent = 70 }}\n\
                 ground = {{ friction = 0.5 }}\nblast_row = [{{ name = \"1\", under_tires = [1], launch_m_s = 5 }}]\n\
                 limits = {{ flight_height_m = 1.5, cable_safety_factor = 1.5 }}\ndelay = [{{ name = \"0 ms\", interval_ms = 0 }}]\n"
            );
            of_plan(&parsed(list)).join("\n").contains("was it filmed with so light a tire?")
        };
        assert_eq!(["265", "266", "300"].map(told), [true, false, false]);
    }

    /// Chance may have made the launches of a plan that was fitted to one film. Nobody knows a launch to a percent without a film.
    #[test]
    fn launches_that_nobody_can_know_so_well_are_told() {
        let told = |uncertainty: &str| {
            let text = include_str!("../../../../tests/fixtures/amur-three-rows.toml");
            let (before, after) = text.split_once("launch_common_percent = 3 ").expect("a value");
            of_plan(&parsed(format!("{before}{uncertainty} {after}"))).join("\n")
        };
        let marks =
            |count: usize| (0..count).map(|n| format!(", \"abcd000{n}\"")).collect::<Vec<_>>().concat();
        let fitted = |count: usize| {
            told(&format!("launch_common_percent = 3\nfitted_from = [\"{:64}\"{}]\n#", 1, marks(count)))
        };
        assert!(fitted(1).contains("fitted to ONE observation"), "{}", fitted(1));
        assert!(fitted(2).contains("fitted to two observations"), "{}", fitted(2));
        assert!(!fitted(3).contains("fitted to"), "{}", fitted(3));
        for (percent, is_told) in [("0", true), ("2", true), ("2.1", false)] {
            let told = told(&format!("launch_common_percent = {percent}"));
            assert_eq!(told.contains("surer than any film"), is_told, "{percent}: {told}");
        }
        for (written, is_told) in
            [("2", false), ("2.1", true), ("9.9", true), ("9.9 # assumed", false), ("10", false)]
        {
            let told = told(&format!("launch_common_percent = {written}\n#"));
            assert_eq!(told.contains("no film was fitted"), is_told, "{written}: {told}");
        }
        assert!(!fitted(3).contains("no film was fitted"), "{}", fitted(3));
    }
}
