//! How far the draw of a sample with another value differs from its draw with the plan's values.

use crate::scene::{Cable, Firing};
use crate::sorting::sort_by_key;
use crate::study::Case;
use crate::study::hole_places::lies_far;
use crate::study::samples::random_shot::DrawnShot;
use crate::study::samples::sample::SampleRun;
use crate::verdict::Verdict;

/// Share of the force limit below which weaker cables surely hold. With other strengths, another cable may be loaded most, and its load
/// between two steps may differ.
const SURELY_BELOW: f64 = 0.99;

/// Greatest change from a sample's draw as `stated`, whose `run` is known, to its draw as `varied`. It is the greatest of the change of the
/// friction, the relative changes of launch velocities, masses, lengths and stiffnesses, the changes of firing times [s], and the changes
/// of the holes' places under their tires [m].
///
/// The change is infinite if the run says nothing about the varied draw: a hole is a dud in only one of them, lies under another tire, or
/// moves near the edge of its tire, or a weaker cable may reach its limit. Strengths do not change the motion as long as nothing breaks.
pub fn change(case: &Case, stated: &DrawnShot, run: &SampleRun, varied: &DrawnShot) -> f64 {
    let [a, b] = [stated, varied].map(|drawn| in_order(&drawn.shot.firings));
    let stays = |(a, b): (&&Firing, &&Firing)| {
        let moves = a.line.offset != b.line.offset;
        (a.row, a.number, a.tire) == (b.row, b.number, b.tire) && !(moves && lies_far(case, b))
    };
    let is_another_shot = a.len() != b.len()
        || !a.iter().zip(&b).all(stays)
        || (stated.scene.strength != varied.scene.strength && may_break(case, stated, run, varied));
    if is_another_shot {
        return f64::INFINITY;
    }
    let of_firing = |(a, b): (&&Firing, &&Firing)| {
        let launch = (b.launch - a.launch).norm() / a.launch.norm().max(f64::MIN_POSITIVE);
        launch.max((b.time - a.time).abs()).max((b.line.offset - a.line.offset).norm())
    };
    let of_cable = |(a, b): (&Cable, &Cable)| {
        relative(a.rest_length, b.rest_length).max(relative(a.stiffness, b.stiffness))
    };
    let friction = |drawn: &DrawnShot| drawn.shot.friction.unwrap_or(drawn.scene.friction);
    let masses = stated.scene.mass.iter().zip(&varied.scene.mass).map(|(&a, &b)| relative(a, b));
    let cables = stated.scene.cables.iter().zip(&varied.scene.cables).map(of_cable);
    let firings = a.iter().zip(&b).map(of_firing);
    masses.chain(cables).chain(firings).fold((friction(varied) - friction(stated)).abs(), f64::max)
}

/// Whether a cable may reach its limit with the varied strengths.
fn may_break(case: &Case, stated: &DrawnShot, run: &SampleRun, varied: &DrawnShot) -> bool {
    let weaker = |cable: usize| stated.scene.strength(cable) / varied.scene.strength(cable);
    let weakest = (0..stated.scene.cables.len()).map(weaker).fold(1.0, f64::max);
    run.verdict != Verdict::Pass || weakest * run.force > SURELY_BELOW * case.limits.force
}

/// Relative change of a number; 0 for the mass of an anchor.
fn relative(stated: f64, varied: f64) -> f64 {
    if stated == varied { 0.0 } else { (varied - stated).abs() / stated.abs().max(f64::MIN_POSITIVE) }
}

/// The firings in the order of their holes. Another value may change the order of their times.
fn in_order(firings: &[Firing]) -> Vec<&Firing> {
    let mut firings: Vec<&Firing> = firings.iter().collect();
    sort_by_key(&mut firings, |firing| (firing.row, firing.number));
    firings
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Plan;
    use crate::study::samples::random_shot::draw_shot;

    /// Two tires of 1.2 m, tied, each over a hole; the force limit is 10 kN.
    fn case() -> Case {
        let text = r#"
shelter = { layout = "grid", rows = 1, columns = 2, spacing_m = 1.5 }
tire = { mass_kg = 280, outer_diameter_m = 1.2 }
cable = { axial_stiffness_kn = 1400, breaking_force_kn = 20 }
ground = { friction = 0.5 }
blast_row = [{ name = "1", under_row = 1, launch_m_s = 6 }]
limits = { flight_height_m = 5, cable_safety_factor = 2 }
delay = [{ name = "1", interval_ms = 0 }]
"#;
        Case::new(Plan::parse("", text).unwrap_or_else(|mistakes| panic!("{mistakes}")))
    }

    /// The [`change()`] of a draw that `vary` alters. The run with the plan's values pulled with `force` [N].
    fn changed(force: f64, vary: impl Fn(&mut DrawnShot)) -> f64 {
        let case = case();
        let stated = draw_shot(&case, &case.shots[0], 1, 0);
        let mut varied = stated.clone();
        vary(&mut varied);
        let run = SampleRun { verdict: Verdict::Pass, force, ..SampleRun::FAILED_RUN };
        change(&case, &stated, &run, &varied)
    }

    #[test]
    fn each_number_of_a_draw_counts() {
        assert_eq!(changed(0.0, |_| ()), 0.0);
        let is = |change: f64, expected: f64| {
            assert!((change - expected).abs() < 1e-12, "{change}, not {expected}");
        };
        is(
            changed(0.0, |drawn| drawn.shot.friction = drawn.shot.friction.map(|friction| friction - 0.1)),
            0.1,
        );
        is(changed(0.0, |drawn| drawn.shot.firings[1].launch *= 1.2), 0.2);
        is(changed(0.0, |drawn| drawn.shot.firings[0].time += 0.3), 0.3);
        is(changed(0.0, |drawn| drawn.shot.firings[0].line.offset.y += 0.25), 0.25);
        is(changed(0.0, |drawn| drawn.scene.mass[1] *= 0.9), 0.1);
        is(changed(0.0, |drawn| drawn.scene.cables[0].rest_length *= 1.05), 0.05);
        is(changed(0.0, |drawn| drawn.scene.cables[0].stiffness *= 0.5), 0.5);
        // The order of firing does not change the holes.
        is(changed(0.0, |drawn| drawn.shot.firings.reverse()), 0.0);
    }

    #[test]
    fn the_run_of_one_shot_tells_nothing_of_another() {
        assert_eq!(changed(0.0, |drawn| _ = drawn.shot.firings.pop()), f64::INFINITY, "a dud");
        assert_eq!(changed(0.0, |drawn| drawn.shot.firings[0].tire = 1), f64::INFINITY, "the next tire");
        let aside = |drawn: &mut DrawnShot| drawn.shot.firings[0].line.offset.x += 0.31;
        assert_eq!(changed(0.0, aside), f64::INFINITY, "past half a radius");
    }

    /// A cable of 0.8 times its strength counts as loaded 1.25 times as much: 8 kN reaches the limit of 10 kN.
    #[test]
    fn strengths_count_where_a_cable_may_come_to_its_limit() {
        let weaker = |drawn: &mut DrawnShot| drawn.scene.strength = vec![0.8];
        assert_eq!(changed(7.9e3, weaker), 0.0);
        assert_eq!(changed(7.95e3, weaker), f64::INFINITY, "not surely below");
        assert_eq!(changed(9.89e3, |drawn| drawn.scene.strength = vec![1.2]), 0.0);
        let case = case();
        let stated = draw_shot(&case, &case.shots[0], 1, 0);
        let mut varied = stated.clone();
        weaker(&mut varied);
        let failed = SampleRun { verdict: Verdict::Fail, force: 0.0, ..SampleRun::FAILED_RUN };
        assert_eq!(change(&case, &stated, &failed, &varied), f64::INFINITY);
    }
}
