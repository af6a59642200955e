//! Which option is recommended, and whether a plan passes.

use std::cmp::Ordering;

use itertools::Itertools;
use serde::{Deserialize, Serialize};

use super::judgement::{Judgement, OptionResults, verdict_of};
use crate::study::Case;
use crate::study::as_planned::margin::LaunchMargin;
use crate::verdict::Verdict;

/// Index of the option to be recommended: the safest of those that pass with everything asked for; `None` where none does.
pub fn recommended(case: &Case, results: &OptionResults) -> Option<usize> {
    safest_first(case, results, |_| 1.0)
        .into_iter()
        .find(|&option| results[option].as_ref().is_ok_and(Judgement::is_full_pass))
}

/// Indices of all options, the safest first: by verdict before any confirmation, then by the share of the samples that fail. An
/// option without samples has the share that `share_without_samples` gives. Passing options whose bounds overlap with those of the
/// best are ties: the larger launch margin stands first, then the shorter shot.
pub fn safest_first(
    case: &Case,
    results: &OptionResults,
    share_without_samples: impl Fn(usize) -> f64,
) -> Vec<usize> {
    let judged = |n: usize| results[n].as_ref().ok();
    let bounds = |n: usize| judged(n).and_then(|judged| Some(judged.sampled.known()?.bounds));
    let key = |&n: &usize| {
        let share = bounds(n).and_then(|bounds| bounds.probability());
        let verdict = judged(n).map_or(Verdict::Undecided, |judged| judged.grounds().before_confirmation());
        (verdict, share.unwrap_or_else(|| share_without_samples(n)))
    };
    let interval = |n: usize| bounds(n).map_or([0.0, 1.0], |bounds| bounds.interval);
    let mut waiting: Vec<usize> =
        (0..results.len()).sorted_by(|a, b| key(a).partial_cmp(&key(b)).unwrap_or(Ordering::Equal)).collect();
    let mut ranked = Vec::new();
    while let Some(&best) = waiting.first() {
        let passes = key(&best).0 == Verdict::Pass;
        let overlaps = |n: usize| interval(n)[0] <= interval(best)[1];
        let is_tie = |n: &usize| *n == best || passes && key(n).0 == Verdict::Pass && overlaps(*n);
        let (mut ties, others): (Vec<usize>, Vec<usize>) = waiting.into_iter().partition(is_tie);
        ties.sort_by(|&a, &b| {
            let [margin_a, margin_b] = [a, b].map(|n| spare_launch(judged(n)));
            let [duration_a, duration_b] = [a, b].map(|n| case.shots[n].duration());
            margin_b.total_cmp(&margin_a).then(duration_a.total_cmp(&duration_b))
        });
        ranked.extend(ties);
        waiting = others;
    }
    ranked
}

/// Whether the samples of two options leave open which of them fails less.
pub fn are_alike(a: &Judgement, b: &Judgement) -> bool {
    let interval =
        |judged: &Judgement| judged.sampled.known().map_or([0.0, 1.0], |sampled| sampled.bounds.interval);
    let [[low_a, high_a], [low_b, high_b]] = [a, b].map(interval);
    low_a <= high_b && low_b <= high_a
}

/// How much faster the tires may leave, as a share of the planned launch velocities.
fn spare_launch(judged: Option<&Judgement>) -> f64 {
    match judged.and_then(|judged| judged.launch_margin) {
        Some(LaunchMargin::BeyondTried) => f64::INFINITY,
        Some(LaunchMargin::UpTo { rise, .. }) => rise,
        Some(LaunchMargin::NotPassing) | None => 0.0,
    }
}

/// Which options of a plan must pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum MustPass {
    /// Every option.
    Every,
    /// One of them.
    One,
}

/// The verdict on a plan: the worst of its options, or the best where one must pass.
pub fn verdict_on_plan(results: &OptionResults, must_pass: MustPass) -> Verdict {
    let each = results.iter().map(verdict_of);
    match must_pass {
        MustPass::Every => Verdict::worst(each),
        MustPass::One => each.min().unwrap_or(Verdict::Pass),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::NoResult;
    use crate::study::judge::grounds::Evidence;
    use crate::study::standing::tests::{case, sampled};

    /// Of 3,000 samples so many fail, and the planned launches may rise so far.
    fn judged(case: &Case, failing: usize, rise: f64) -> Judgement {
        let launch_margin = Some(LaunchMargin::UpTo { rise, above: Verdict::Fail });
        Judgement { launch_margin, ..sampled(case, 3000, failing) }
    }

    fn results(case: &Case, options: &[(usize, f64)]) -> OptionResults {
        options.iter().map(|&(failing, rise)| Ok(judged(case, failing, rise))).collect()
    }

    /// Of passes whose bounds overlap the larger margin stands first, then the shorter shot; what does not pass stands behind by its share
    /// of failures, whatever its margin, and what has no result behind what is open and fails less.
    #[test]
    fn the_safest_option_stands_first() {
        let mut case = case();
        case.limits.accepted_risk = 0.05;
        let ranked = |options: &[(usize, f64)], no_result: usize| {
            let mut results = results(&case, options);
            results.extend(vec![Err(NoResult::OutOfTime); no_result]);
            safest_first(&case, &results, |_| 0.25)
        };
        assert_eq!(ranked(&[(900, 0.9), (2, 0.1), (600, 0.1), (0, 0.1), (2, 0.3)], 0), [4, 1, 3, 2, 0]);
        assert_eq!(ranked(&[(30, 0.9), (0, 0.1)], 0), [1, 0], "it passes, too, and surely fails more often");
        assert_eq!(ranked(&[(150, 0.9), (149, 0.1), (0, 0.0)], 1), [2, 1, 0, 3], "open");
        let mut of_margins = results(&case, &[(0, 0.9); 3]);
        for (judged, margin) in of_margins.iter_mut().flatten().zip([None, Some(LaunchMargin::BeyondTried)]) {
            judged.launch_margin = margin;
        }
        assert_eq!(safest_first(&case, &of_margins, |_| 1.0), [1, 2, 0]);
    }

    #[test]
    fn the_safest_that_passes_with_everything_asked_for_is_recommended() {
        let case = case();
        let mut all = results(&case, &[(900, 0.9), (0, 0.1), (0, 0.3)]);
        assert_eq!(recommended(&case, &all), Some(2));
        all[2].as_mut().expect("a result").confirmation = Evidence::Awaited;
        assert_eq!(recommended(&case, &all), Some(1));
        all[1].as_mut().expect("a result").sampled = Evidence::NotAsked;
        assert_eq!(recommended(&case, &all), None);
    }

    #[test]
    fn options_are_alike_where_their_bounds_overlap() {
        let case = case();
        let [none, few, many] = [0, 2, 900].map(|failing| judged(&case, failing, 0.1));
        let unknown = Judgement { sampled: Evidence::Awaited, ..none.clone() };
        for (a, b, alike) in [(&none, &few, true), (&none, &many, false), (&unknown, &many, true)] {
            assert_eq!([are_alike(a, b), are_alike(b, a)], [alike; 2]);
        }
    }

    #[test]
    fn a_plan_passes_where_every_option_does_or_one_where_one_must() {
        let case = case();
        let [pass, fail] = [0, 900].map(|failing| Ok(judged(&case, failing, 0.1)));
        let open = Err(NoResult::OutOfTime);
        for (results, every, one) in [
            (vec![pass.clone(), pass.clone()], Verdict::Pass, Verdict::Pass),
            (vec![pass.clone(), open.clone()], Verdict::Undecided, Verdict::Pass),
            (vec![fail.clone(), open.clone()], Verdict::Fail, Verdict::Undecided),
            (vec![pass, open, fail], Verdict::Fail, Verdict::Pass),
        ] {
            assert_eq!(verdict_on_plan(&results, MustPass::Every), every);
            assert_eq!(verdict_on_plan(&results, MustPass::One), one);
        }
    }
}
