//! Which option is recommended, and whether a plan passes.

use std::cmp::Ordering;

use itertools::Itertools;
use serde::{Deserialize, Serialize};

use super::judgement::{Judgement, OptionResults, verdict_of};
use crate::study::Case;
use crate::verdict::{Limits, Verdict};

/// Index of the option to be recommended: the safest of those that pass with everything asked for; `None` where none does.
pub fn recommended(case: &Case, results: &OptionResults) -> Option<usize> {
    safest_first(case, results, |_| 1.0)
        .into_iter()
        .find(|&option| results[option].as_ref().is_ok_and(Judgement::is_full_pass))
}

/// Indices of all options, the safest first: by verdict before any confirmation, then by the share of the samples that fail, then by how
/// little of the limits the shots [use](Judgement::used_of_limits), then the shorter shot. An option without samples has the share that
/// `share_without_samples` gives. How much faster the tires may leave in the shot as planned does not count: it may speak for an option of
/// which more of the other shots fail.
pub fn safest_first(
    case: &Case,
    results: &OptionResults,
    share_without_samples: impl Fn(usize) -> f64,
) -> Vec<usize> {
    let key = |&option: &usize| {
        let judged = results[option].as_ref().ok();
        let verdict = judged.map_or(Verdict::Undecided, |judged| judged.grounds().before_confirmation());
        let share = judged.and_then(Judgement::failing_share);
        let used = judged.map_or(f64::INFINITY, |judged| judged.used_of_limits(&case.limits));
        let share = share.unwrap_or_else(|| share_without_samples(option));
        (verdict, share, used, case.shots[option].duration())
    };
    (0..results.len()).sorted_by(|a, b| key(a).partial_cmp(&key(b)).unwrap_or(Ordering::Equal)).collect()
}

/// Why one passing option stands before another, the strongest reason first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Rank {
    /// Fewer of its samples fail.
    Failures,
    /// Its shots use less of the limits.
    Use,
    /// Its shot is not the longer one.
    Duration,
}

impl Rank {
    /// Why `first` stands before `second`.
    pub fn of(limits: &Limits, first: &Judgement, second: &Judgement) -> Self {
        match () {
            () if first.failing_share() != second.failing_share() => Self::Failures,
            () if first.used_of_limits(limits) != second.used_of_limits(limits) => Self::Use,
            () => Self::Duration,
        }
    }
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

    /// Of passes the one of which fewest samples fail stands first, then who uses least of a limit, then the shorter shot; what does not
    /// pass stands behind by its share of failures, whatever it uses, and what has no result behind what is open and fails less.
    #[test]
    fn the_safest_option_stands_first() {
        let mut case = case();
        case.limits.accepted_risk = 0.05;
        let ranked = |options: &[(usize, f64)], no_result: usize| {
            let mut results = results(&case, options);
            results.extend(vec![Err(NoResult::OutOfTime); no_result]);
            safest_first(&case, &results, |_| 0.25)
        };
        assert_eq!(ranked(&[(900, 0.8), (2, 0.9), (600, 0.9), (0, 0.95), (2, 0.8)], 0), [3, 4, 1, 2, 0]);
        assert_eq!(ranked(&[(0, 0.9), (0, 0.9), (0, 0.8)], 0), [2, 0, 1], "the second fires longer");
        assert_eq!(ranked(&[(150, 0.8), (149, 0.9), (0, 0.9)], 1), [2, 1, 0, 3], "open");
    }

    /// The shot as planned may bear much faster launches, and more of the others fail, or come near to a limit, all the same.
    #[test]
    fn how_much_faster_the_planned_shot_may_be_ranks_nothing() {
        let case = case();
        for mild in [(2, 0.8), (0, 0.9)] {
            let mut results = results(&case, &[mild, (0, 0.8)]);
            results[0].as_mut().expect("a result").launch_margin = Some(LaunchMargin::BeyondTried);
            results[1].as_mut().expect("a result").launch_margin = Some(LaunchMargin::NotPassing);
            assert_eq!(safest_first(&case, &results, |_| 1.0), [1, 0]);
        }
    }

    /// The shot as planned may be far from a limit that one in so many comes near to.
    #[test]
    fn what_all_but_the_accepted_share_use_counts() {
        let case = case();
        let mut judged = judged(&case, 2, 0.8);
        assert_eq!(judged.used_of_limits(&case.limits), 0.8);
        let Evidence::Known(sampled) = &mut judged.sampled else { panic!("samples") };
        sampled.samples.iter_mut().filter(|sample| sample.run.verdict == Verdict::Pass).for_each(|sample| {
            sample.run.height = 0.95 * case.limits.height;
        });
        assert_eq!(judged.used_of_limits(&case.limits), 0.95);
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
