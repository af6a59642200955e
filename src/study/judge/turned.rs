//! How high an option would throw its tires if rims turned toward their cables. The model leaves this out.

use crate::plan::{Plan, TireSpec};
use crate::study::samples::influence::SAMPLES_FOR_SHARES;
use crate::study::samples::random_shot::{DrawnShot, draw_shots};
use crate::study::samples::run_sample::{sample_settings, sample_step};
use crate::study::samples::sampled_shot::left_out;
use crate::study::work::batch::run_batch;
use crate::study::{Case, Context, NoResult};

/// Number of samples behind the height.
const SAMPLES: usize = SAMPLES_FOR_SHARES;

/// Height of tires that turn, which only the accepted share of the samples with this seed exceeds [m]. It is infinite if the runs of more
/// samples fail. The inner value is `None` for cables from centre to centre. The outer value is `None` if the time was up.
///
/// # Panics
///
/// If the plan has no delay option with the index `option`.
pub fn turned_height(
    context: &Context<'_>,
    option: usize,
    seed: u64,
) -> Result<Option<Option<f64>>, NoResult> {
    let &Context { case, compute, control, .. } = context;
    let tire = TireSpec { turns: true, ..case.plan.tire };
    if tire.turned_m() == 0.0 {
        return Ok(Some(None));
    }
    let turning = Case::new(Plan { tire, ..case.plan.clone() });
    let numbers: Vec<usize> = (0..SAMPLES).collect();
    let heights = run_batch(&numbers, control, |&number| {
        let mut highest = 0.0_f64;
        for DrawnShot { scene, shot, later, .. } in draw_shots(&turning, &turning.shots[option], seed, number)
        {
            let settings = sample_settings(&turning, &compute, sample_step(&compute, &scene), later);
            let run = turning.model.run_variant(&scene, &shot, &settings, &mut |_| control.keep_going());
            match run.map_err(|failure| control.no_result(failure)) {
                Ok(outcome) => highest = highest.max(outcome.height.value),
                Err(NoResult::Failed(_)) => highest = f64::INFINITY,
                Err(ended) => return Err(ended),
            }
        }
        Ok(highest)
    })?;
    let Some(mut heights) = heights.into_iter().collect::<Option<Vec<f64>>>() else { return Ok(None) };
    heights.sort_by(|a, b| b.total_cmp(a));
    Ok(Some(heights.get(left_out(case.limits.accepted_risk, SAMPLES)).copied()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::judge::brief_judgement::tests::case as two_tires;
    use crate::study::samples::run_sample::ShotToSample;
    use crate::study::samples::sample_count::Sampling;
    use crate::study::samples::sample_until_sure::sample_shots;
    use crate::study::standing::tests::case;
    use crate::study::{ComputeSettings, StudyControl};
    use crate::verdict::Quantity;

    /// The result equals the 1 in 100 value of samples of a plan whose tires turn. It is not one bad sample of the plan itself with turning
    /// tires. Both have the same steps.
    #[test]
    fn the_height_of_tires_that_turn_is_that_of_their_samples() {
        let (case, control) = (case(), StudyControl::default());
        let context = Context::new(&case, ComputeSettings::of(&case.plan), &control);
        let found = turned_height(&context, 4, 1).expect("a result").flatten().expect("a height");
        let tire = TireSpec { turns: true, ..case.plan.tire };
        let turning = Case::new(Plan { tire, ..case.plan.clone() });
        let told = |case: &Case| {
            let sampling = Sampling::exactly(SAMPLES, 1);
            let target = ShotToSample::new(case, &case.shots[4], ComputeSettings::of(&case.plan), sampling);
            let sampled = sample_shots(&[target], &control).expect("samples").value.swap_remove(0);
            sampled.deciding_value(Quantity::Height).expect("enough samples")
        };
        let expected = told(&turning);
        assert!((found / expected - 1.0).abs() < 1e-3, "{found} {expected}");
        assert!(found > 1.05 * told(&case), "{found} {}", told(&case));
    }

    #[test]
    fn cables_from_centre_to_centre_turn_with_their_tires() {
        let (case, control) = (two_tires("", false), StudyControl::default());
        let context = Context::new(&case, ComputeSettings::of(&case.plan), &control);
        assert_eq!(turned_height(&context, 0, 1).expect("a result"), Some(None));
    }

    /// If the time was up, nothing is known of tires that turn, and the judgement is not whole. A page would lack its warning.
    #[test]
    fn what_there_was_no_time_for_is_not_known() {
        let (case, control) = (case(), StudyControl::default());
        control.expire();
        let context = Context::new(&case, ComputeSettings::of(&case.plan), &control);
        assert_eq!(turned_height(&context, 4, 1).expect("no mistake"), None);
    }
}
