//! Which option is recommended, and whether a plan passes.

use std::cmp::Ordering;

use serde::{Deserialize, Serialize};

use super::judgement::{Judgement, OptionResults, verdict_of};
use crate::sorting::sorted_by;
use crate::study::Case;
use crate::units;
use crate::verdict::Verdict;

/// Index of the recommended option: the safest of those that pass with everything asked for; `None` if there is none.
pub fn recommended(case: &Case, results: &OptionResults) -> Option<usize> {
    safest_first(case, results, |_| 1.0)
        .into_iter()
        .find(|&option| results[option].as_ref().is_ok_and(Judgement::is_full_pass))
}

/// Indices of all options, the safest first. The criteria, in order:
///
/// 1. the verdict before any confirmation;
/// 2. whether the planned shot withstands one dud and bears more than slightly faster launches;
/// 3. the share of the samples that fails, or `share_without_samples` for an option without samples;
/// 4. the use of the nearest limit by all but the accepted share of the samples, in whole percent;
/// 5. how much faster the planned shot may leave;
/// 6. the duration of the shot, the shorter first.
pub fn safest_first(
    case: &Case,
    results: &OptionResults,
    share_without_samples: impl Fn(usize) -> f64,
) -> Vec<usize> {
    let key = |&option: &usize| {
        let judged = results[option].as_ref().ok();
        let verdict = judged.map_or(Verdict::Undecided, |judged| judged.grounds().before_confirmation());
        let share = judged.and_then(Judgement::failing_share);
        let share = share.unwrap_or_else(|| share_without_samples(option));
        let margin = judged.and_then(|judged| judged.launch_margin);
        let (is_thin, rise) = margin.map_or((false, 0.0), |margin| (margin.is_thin(), margin.rise()));
        let fails_with_dud = judged.is_some_and(Judgement::fails_with_dud);
        let used = judged.and_then(|judged| used(case, judged)).unwrap_or(f64::INFINITY);
        (verdict, is_thin || fails_with_dud, share, used, -rise, case.shots[option].duration())
    };
    sorted_by(0..results.len(), |a, b| key(a).partial_cmp(&key(b)).unwrap_or(Ordering::Equal))
}

/// Use of the nearest limit, as rows show it [whole percent].
fn used(case: &Case, judged: &Judgement) -> Option<f64> {
    judged.nearest_limit(&case.limits).map(|(_, share)| units::whole_percent(share))
}

/// In what the recommended option is better than every other option that passes; `None` if in nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lead {
    /// Fewer of its samples fail.
    Failures,
    /// Its planned shot withstands one dud, and those of the others do not.
    Dud,
    /// It keeps farther from its nearest limit.
    Room,
    /// Its planned shot bears faster launches.
    Launches,
    /// Its shot is shorter.
    Duration,
}

impl Lead {
    /// The first lead that holds against each of the `others`. Each option comes with the duration of its shot [s].
    pub fn of(case: &Case, best: (&Judgement, f64), others: &[(&Judgement, f64)]) -> Option<Self> {
        let is_less = |value: &dyn Fn(&(&Judgement, f64)) -> Option<f64>| {
            let least = value(&best);
            others.iter().all(|other| least.zip(value(other)).is_some_and(|(least, other)| least < other))
        };
        match () {
            () if is_less(&|(judged, _)| judged.failing_share()) => Some(Self::Failures),
            () if is_less(&|(judged, _)| Some(f64::from(judged.fails_with_dud()))) => Some(Self::Dud),
            () if is_less(&|(judged, _)| used(case, judged)) => Some(Self::Room),
            () if is_less(&|(judged, _)| Some(-judged.launch_margin?.rise())) => Some(Self::Launches),
            () if is_less(&|(_, duration)| Some(*duration)) => Some(Self::Duration),
            () => None,
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

/// The verdict on a plan: the worst of its options, or the best if only one must pass.
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
    use crate::study::samples::failure_bounds::{ErrorShare, FailureBounds};
    use crate::study::standing::tests::{case, one_dud, sampled};
    use crate::verdict::Quantity;

    /// Of 3,000 samples, `failing` fail. The planned launches may rise by `rise`.
    fn judged(case: &Case, failing: usize, rise: f64) -> Judgement {
        let launch_margin = Some(LaunchMargin::UpTo { rise, above: Verdict::Fail });
        Judgement { launch_margin, ..sampled(case, 3000, failing) }
    }

    fn results(case: &Case, options: &[(usize, f64)]) -> OptionResults {
        options.iter().map(|&(failing, rise)| Ok(judged(case, failing, rise))).collect()
    }

    /// Among passes that bear more than slightly faster launches, the order is: fewest failing samples, fastest launches borne, shortest
    /// shot. Options that do not pass follow by their share of failures. An option without a result follows after open options that fail
    /// less.
    #[test]
    fn the_safest_option_stands_first() {
        let mut case = case();
        case.limits.accepted_risk = 0.05;
        let ranked = |options: &[(usize, f64)], no_result: usize| {
            let mut results = results(&case, options);
            results.extend(vec![Err(NoResult::OutOfTime); no_result]);
            safest_first(&case, &results, |_| 0.25)
        };
        assert_eq!(ranked(&[(900, 0.9), (2, 0.1), (600, 0.1), (0, 0.1), (2, 0.3)], 0), [3, 4, 1, 2, 0]);
        assert_eq!(ranked(&[(0, 0.1), (0, 0.1), (0, 0.2)], 0), [2, 0, 1], "the second fires longer");
        assert_eq!(ranked(&[(0, 0.05), (2, 0.06)], 0), [1, 0], "the first is thin");
        assert_eq!(ranked(&[(150, 0.9), (149, 0.1), (0, 0.1)], 1), [2, 1, 0, 3], "open");
        let mut of_dud = results(&case, &[(0, 0.9), (2, 0.1), (3, 0.1)]);
        for (judged, failing) in of_dud.iter_mut().flatten().zip([1, 0]) {
            judged.one_dud = Some(one_dud(judged, failing));
        }
        assert_eq!(safest_first(&case, &of_dud, |_| 1.0), [1, 2, 0], "the first does not bear one dud");
        let mut of_margins = results(&case, &[(0, 0.9); 3]);
        for (judged, margin) in of_margins.iter_mut().flatten().zip([None, Some(LaunchMargin::BeyondTried)]) {
            judged.launch_margin = margin;
        }
        assert_eq!(safest_first(&case, &of_margins, |_| 1.0), [1, 2, 0]);
    }

    /// Undecided samples may fail.
    #[test]
    fn undecided_samples_rank_as_those_that_fail() {
        let case = case();
        let mut results = results(&case, &[(0, 0.3), (2, 0.1)]);
        let judged = results[0].as_mut().expect("a result");
        let Evidence::Known(sampled) = &mut judged.sampled else { panic!("samples") };
        sampled.bounds.undecided = 3;
        assert_eq!(judged.failing_share(), Some(1e-3));
        assert_eq!(safest_first(&case, &results, |_| 1.0), [1, 0]);
        let Ok(Judgement { sampled: Evidence::Known(sampled), .. }) = &mut results[0] else {
            panic!("samples")
        };
        sampled.bounds = FailureBounds::new(0.01, ErrorShare::Whole);
        assert_eq!(results[0].as_ref().ok().and_then(Judgement::failing_share), None, "of none nobody knows");
    }

    /// A lead holds against every other option that passes, or it is not given.
    #[test]
    fn a_lead_holds_against_all_others() {
        let case = case();
        let lead_of = |options: &[(usize, f64)], durations: [f64; 3]| {
            let judged: Vec<Judgement> = options.iter().map(|&(n, rise)| judged(&case, n, rise)).collect();
            let all: Vec<(&Judgement, f64)> = judged.iter().zip(durations).collect();
            Lead::of(&case, all[0], &all[1..])
        };
        let lead = |options: &[(usize, f64)]| lead_of(options, [0.1, 0.2, 0.3]);
        assert_eq!(lead(&[(0, 0.1), (1, 0.3), (2, 0.2)]), Some(Lead::Failures));
        assert_eq!(lead(&[(1, 0.3), (1, 0.2), (2, 0.1)]), Some(Lead::Launches));
        assert_eq!(lead(&[(1, 0.3), (1, 0.3), (2, 0.3)]), Some(Lead::Duration));
        assert_eq!(lead(&[(0, 0.2), (0, 0.1), (1, 0.3)]), Some(Lead::Duration), "one bears faster launches");
        assert_eq!(lead_of(&[(1, 0.3); 3], [0.1, 0.2, 0.1]), None, "one is as short");
        let mut other = judged(&case, 0, 0.3);
        other.one_dud = Some(one_dud(&other, 1));
        assert_eq!(Lead::of(&case, (&judged(&case, 0, 0.1), 0.2), &[(&other, 0.1)]), Some(Lead::Dud));
        // A whole percent of a limit counts, even if the option bears slower launches and takes longer. A difference that no row shows does
        // not count.
        let using = |share: f64, rise: f64| {
            let mut judged = judged(&case, 0, rise);
            judged.checked.estimates.height.value = share * case.limits.height;
            judged
        };
        let lead = |other: f64| Lead::of(&case, (&using(0.8, 0.1), 0.2), &[(&using(other, 0.3), 0.1)]);
        assert_eq!([0.79, 0.798, 0.8, 0.9].map(lead), [None, None, None, Some(Lead::Room)]);
        let all = [(0.798, 0.1), (0.9, 0.9), (0.8, 0.2)].map(|(share, rise)| Ok(using(share, rise)));
        assert_eq!(safest_first(&case, &all.into(), |_| 1.0), [2, 0, 1]);
    }

    /// The planned shot may be far from a limit that the deciding sample nearly reaches.
    #[test]
    fn what_all_but_the_accepted_share_use_counts() {
        let case = case();
        let mut judged = judged(&case, 2, 0.1);
        judged.checked.estimates.height.value = 0.8 * case.limits.height;
        assert_eq!(judged.nearest_limit(&case.limits), Some((Quantity::Height, 0.8)));
        let Evidence::Known(sampled) = &mut judged.sampled else { panic!("samples") };
        sampled.samples.iter_mut().filter(|sample| sample.run.verdict == Verdict::Pass).for_each(|sample| {
            sample.run.height = 0.95 * case.limits.height;
        });
        assert_eq!(judged.nearest_limit(&case.limits), Some((Quantity::Height, 0.95)));
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
