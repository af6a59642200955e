//! Holes that may launch another tire on site than the plan says, each with the verdict on that shot.

use nalgebra::Vector2;

use crate::plan::mass_law::launch_factor;
use crate::scene::{Firing, Shot, direction_of_slope};
use crate::study::as_planned::check_many::or_failed_run;
use crate::study::as_planned::quick_check::quick_check;
use crate::study::hole_places::{HoleBesideTire, holes_beside_tires};
use crate::study::work::batch::run_batch;
use crate::study::{Case, Context, NoResult};
use crate::verdict::Verdict;

/// The shot in which this hole launches the next tire.
fn with_next_tire(case: &Case, shot: &Shot, hole: &HoleBesideTire) -> Shot {
    let moved = |firing: &Firing| {
        if (firing.row, firing.number) != (hole.row, hole.number) {
            return *firing;
        }
        let place = case.scene().position[firing.tire].xy() - firing.line.offset;
        under_tire(case, firing, hole.tires[1], place)
    };
    shot.with_firings(shot.firings.iter().map(moved).collect())
}

/// The firing of a hole at `place` [m] that launches `tire`. The worse end of the [mass law](crate::plan::mass_law) gives the launch of a
/// tire of another mass.
pub(in crate::study) fn under_tire(case: &Case, firing: &Firing, tire: usize, place: Vector2<f64>) -> Firing {
    let scene = case.scene();
    let mut line = firing.line;
    line.offset = scene.position[tire].xy() - place;
    let heavier = scene.mass[tire] / scene.mass[firing.tire];
    let of_mass = launch_factor(heavier, case.plan.uncertainty.worse_mass_exponent(heavier));
    let launch = match line.depth {
        None => firing.launch,
        Some(_) => firing.launch.norm() * direction_of_slope(line.planned_slope()),
    };
    Firing { tire, line, launch: of_mass * launch, ..*firing }
}

/// The holes of a shot that may launch the next tire, each with the verdict on the planned shot in which they do; `None` if the time was
/// up.
pub fn judge_next_tires(
    context: &Context<'_>,
    shot: &Shot,
) -> Result<Option<Vec<(HoleBesideTire, Verdict)>>, NoResult> {
    let &Context { case, control, .. } = context;
    let in_doubt = |hole: &HoleBesideTire| hole.may_be_the_next || hole.is_uncovered;
    let holes: Vec<HoleBesideTire> = holes_beside_tires(case, shot).into_iter().filter(in_doubt).collect();
    let verdicts = run_batch(&holes, control, |hole| {
        let shot = with_next_tire(case, shot, hole);
        or_failed_run(quick_check(context, &shot)).map(|planned| planned.verdict)
    })?;
    let verdicts: Option<Vec<Verdict>> = verdicts.into_iter().collect();
    Ok(verdicts.map(|verdicts| holes.into_iter().zip(verdicts).collect()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Plan;
    use crate::study::{ComputeSettings, StudyControl};

    fn case(x: f64, diameter: f64) -> Case {
        let text = format!(
            "shelter = {{ layout = \"grid\", rows = 2, columns = 3, spacing_m = 2 }}\n\
             tire = {{ mass_kg = 280, outer_diameter_m = {diameter} }}\n\
             cable = {{ axial_stiffness_kn = 1400, breaking_force_kn = 60 }}\nground = {{ friction = 0.5 }}\n\
             blast_row = [{{ name = \"1\", holes = [{{ x_m = {x}, y_m = 0, launch_m_s = 6 }}] }}]\n\
             limits = {{ flight_height_m = 2, cable_safety_factor = 1 }}\ndelay = [{{ name = \"1\", interval_ms = 0 }}]\n"
        );
        Case::new(Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")))
    }

    /// The hole launches the next tire with the same velocity. Its offset then counts from that tire.
    #[test]
    fn the_next_tire_gets_the_impulse() {
        let case = case(0.95, 1.6);
        let moved = &holes_beside_tires(&case, &case.shots[0])[0];
        let shot = with_next_tire(&case, &case.shots[0], moved);
        assert_eq!((shot.firings[0].tire, shot.firings[0].launch), (1, case.shots[0].firings[0].launch));
        assert!((shot.firings[0].line.offset.x - 1.05).abs() < 1e-12);
    }
    /// A hole lies between a tire of 560 kg and one of 280 kg. The light tire leaves with up to twice the launch, the heavy tire with at
    /// most the whole launch.
    #[test]
    fn the_next_tire_leaves_as_the_mass_law_says() {
        for (x, next, factor) in [(0.95, 1, 2.0), (1.05, 0, 1.0)] {
            let text = format!(
                "tire = {{ mass_kg = 280 }}\ncable = {{ axial_stiffness_kn = 1400, breaking_force_kn = 60 }}\n\
                 ground = {{ friction = 0.5 }}\nlimits = {{ flight_height_m = 2, cable_safety_factor = 1 }}\n\
                 delay = [{{ name = \"1\", interval_ms = 0 }}]\n\
                 blast_row = [{{ name = \"1\", holes = [{{ x_m = {x}, y_m = 0, launch_m_s = 6 }}] }}]\n\
                 [shelter]\nlayout = \"list\"\ntire = [{{ x_m = 0, y_m = 0, mass_kg = 560 }}, {{ x_m = 2, y_m = 0 }}]\n\
                 cable = [{{ from = 1, to = 2 }}]\n"
            );
            let case = Case::new(Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")));
            let moved = &holes_beside_tires(&case, &case.shots[0])[0];
            let shot = with_next_tire(&case, &case.shots[0], moved);
            assert_eq!((shot.firings[0].tire, shot.firings[0].launch.norm()), (next, 6.0 * factor));
        }
    }

    #[test]
    fn a_hole_in_doubt_is_judged_under_the_next_tire() {
        let judged = |x: f64, diameter: f64, control: &StudyControl| {
            let case = case(x, diameter);
            let found = judge_next_tires(
                &Context::new(&case, ComputeSettings::of(&case.plan), control),
                &case.shots[0],
            );
            found
                .expect("a result")
                .map(|found| found.iter().map(|(hole, _)| hole.tires[1]).collect::<Vec<_>>())
        };
        let control = StudyControl::default();
        let all = [(0.95, 1.6), (0.95, 1.95), (0.0, 1.6)].map(|(x, diameter)| judged(x, diameter, &control));
        assert_eq!(all, [Some(vec![1]), Some(vec![1]), Some(vec![])], "no tire over it, and one");
        control.expire();
        assert_eq!(judged(0.95, 1.6, &control), None);
    }
}
