//! Which option is recommended, and whether a plan passes.

use std::cmp::Ordering;

use itertools::Itertools;
use serde::{Deserialize, Serialize};

use super::judgement::{Judgement, OptionResults, verdict_of};
use crate::study::Case;
use crate::verdict::Verdict;

/// Index of the option to be recommended: the safest of those that pass with everything asked for; `None` where none does.
pub fn recommended(case: &Case, results: &OptionResults) -> Option<usize> {
    safest_first(case, results, |_| 1.0)
        .into_iter()
        .find(|&option| results[option].as_ref().is_ok_and(Judgement::is_full_pass))
}

/// Indices of all options, the safest first: by verdict before any confirmation, then by the share of the samples that fail. An
/// option without samples has the share that `share_without_samples` gives. Passing options whose bounds overlap with those of the
/// best are ties: who [uses least of its limits](Judgement::used_of_limits) stands first, then the shorter shot. How much faster the tires
/// may leave in the shot as planned does not count: it may speak for an option whose other shots come nearer to a limit.
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
    let used = |judged: &Judgement| judged.used_of_limits(&case.limits);
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
            let [used_a, used_b] = [a, b].map(|n| judged(n).map_or(f64::INFINITY, used));
            let [duration_a, duration_b] = [a, b].map(|n| case.shots[n].duration());
            used_a.total_cmp(&used_b).then(duration_a.total_cmp(&duration_b))
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
    use crate::study::as_planned::margin::LaunchMargin;
    use crate::study::judge::grounds::Evidence;
    use crate::study::standing::tests::{case, sampled};

    /// Of 3,000 samples so many fail, and the shot as planned uses this share of the limit of the flight height: more than the samples,
    /// but for those that fail.
    fn judged(case: &Case, failing: usize, used: f64) -> Judgement {
        let mut judged = sampled(case, 3000, failing);
        judged.checked.estimates.height.value = used * case.limits.height;
        judged
    }

    fn results(case: &Case, options: &[(usize, f64)]) -> OptionResults {
        options.iter().map(|&(failing, used)| Ok(judged(case, failing, used))).collect()
    }

    /// Of passes whose bounds overlap, who uses least of a limit stands first, then the shorter shot; what does not pass stands behind by
    /// its share of failures, whatever it uses, and what has no result behind what is open and fails less.
    #[test]
    fn the_safest_option_stands_first() {
        let mut case = case();
        case.limits.accepted_risk = 0.05;
        let ranked = |options: &[(usize, f64)], no_result: usize| {
            let mut results = results(&case, options);
            results.extend(vec![Err(NoResult::OutOfTime); no_result]);
            safest_first(&case, &results, |_| 0.25)
        };
        assert_eq!(ranked(&[(900, 0.8), (2, 0.9), (600, 0.9), (0, 0.9), (2, 0.8)], 0), [4, 1, 3, 2, 0]);
        assert_eq!(ranked(&[(30, 0.8), (0, 0.9)], 0), [1, 0], "it passes, too, and surely fails more often");
        assert_eq!(ranked(&[(150, 0.8), (149, 0.9), (0, 0.9)], 1), [2, 1, 0, 3], "open");
    }

    /// The shot as planned may bear much faster launches, and the one in so many come near to a limit all the same.
    #[test]
    fn what_the_possible_shots_use_ranks_and_not_how_much_faster_the_planned_one_may_be() {
        let case = case();
        let mut results = results(&case, &[(2, 0.8), (0, 0.8)]);
        let [mild, other] = &mut results[..] else { panic!("two options") };
        let [mild, other] = [mild, other].map(|judged| judged.as_mut().expect("a result"));
        mild.launch_margin = Some(LaunchMargin::BeyondTried);
        other.launch_margin = Some(LaunchMargin::NotPassing);
        let Evidence::Known(samples) = &mut mild.sampled else { panic!("samples") };
        samples.samples.iter_mut().filter(|sample| sample.run.height < 2.0).for_each(|sample| {
            sample.run.height = 0.95 * case.limits.height;
        });
        assert!(are_alike(mild, other));
        assert_eq!([&*mild, other].map(|judged| judged.used_of_limits(&case.limits)), [0.95, 0.8]);
        assert_eq!(safest_first(&case, &results, |_| 1.0), [1, 0]);
    }

    #[test]
    fn the_safest_that_passes_with_everything_asked_for_is_recommended() {
        let case = case();
        let mut all = results(&case, &[(900, 0.8), (0, 0.9), (0, 0.8)]);
        assert_eq!(recommended(&case, &all), Some(2));
        all[2].as_mut().expect("a result").confirmation = Evidence::Awaited;
        assert_eq!(recommended(&case, &all), Some(1));
        all[1].as_mut().expect("a result").sampled = Evidence::NotAsked;
        assert_eq!(recommended(&case, &all), None);
    }

    #[test]
    fn options_are_alike_where_their_bounds_overlap() {
        let case = case();
        let [none, few, many] = [0, 2, 900].map(|failing| judged(&case, failing, 0.8));
        let unknown = Judgement { sampled: Evidence::Awaited, ..none.clone() };
        for (a, b, alike) in [(&none, &few, true), (&none, &many, false), (&unknown, &many, true)] {
            assert_eq!([are_alike(a, b), are_alike(b, a)], [alike; 2]);
        }
    }

    #[test]
    fn a_plan_passes_where_every_option_does_or_one_where_one_must() {
        let case = case();
        let [pass, fail] = [0, 900].map(|failing| Ok(judged(&case, failing, 0.8)));
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
