//! Which option is recommended, and whether a plan passes.

use std::cmp::Ordering;

use serde::{Deserialize, Serialize};

use super::judgement::{Judgement, OptionResults, verdict_of};
use crate::sorting::sorted_by;
use crate::study::Case;
use crate::units;
use crate::verdict::Verdict;

/// Index of the option to be recommended: the safest of those that pass with everything asked for; `None` where none does.
pub fn recommended(case: &Case, results: &OptionResults) -> Option<usize> {
    safest_first(case, results, |_| 1.0)
        .into_iter()
        .find(|&option| results[option].as_ref().is_ok_and(Judgement::is_full_pass))
}

/// Indices of all options, the safest first: by verdict before any confirmation, then those whose planned shot bears one dud, and more than
/// a little faster launches, then by the share of the samples that fail, by how much of the nearest limit all but the accepted share of them
/// use, in whole percent, by how much faster the planned shot may leave, and the shorter one. An option without samples has the share that
/// `share_without_samples` gives.
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

/// How much of its nearest limit an option uses, as rows show it [whole percent].
fn used(case: &Case, judged: &Judgement) -> Option<f64> {
    judged.nearest_limit(&case.limits).map(|(_, share)| units::whole_percent(share))
}

/// By what the recommended option surpasses each of some others that pass; `None` by nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lead {
    /// Fewer of its samples fail.
    Failures,
    /// Its planned shot bears one dud, and theirs do not.
    Dud,
    /// It keeps farther from its nearest limit.
    Room,
    /// Its planned shot bears faster launches.
    Launches,
    /// Its shot is shorter.
    Duration,
}

impl Lead {
    /// The first of them that holds against each of the `others`; each with the duration of its shot [s].
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
    use crate::study::samples::failure_bounds::{ErrorShare, FailureBounds};
    use crate::study::standing::tests::{case, one_dud, sampled};
    use crate::verdict::Quantity;

    /// Of 3,000 samples so many fail, and the planned launches may rise so far.
    fn judged(case: &Case, failing: usize, rise: f64) -> Judgement {
        let launch_margin = Some(LaunchMargin::UpTo { rise, above: Verdict::Fail });
        Judgement { launch_margin, ..sampled(case, 3000, failing) }
    }

    fn results(case: &Case, options: &[(usize, f64)]) -> OptionResults {
        options.iter().map(|&(failing, rise)| Ok(judged(case, failing, rise))).collect()
    }

    /// Of passes that bear more than a little faster launches the one of which fewest samples fail stands first, then the one that bears the
    /// fastest, then the shorter; what does not pass stands behind by its share of failures, and what has no result behind what is open and
    /// fails less.
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

    /// What stays undecided may fail.
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

    /// What is said of it holds against every other option that passes, or is not said.
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
        // A whole percent of a limit is told, also of one that bears slower launches and takes longer; what no row shows is not.
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

    /// The shot as planned may be far from a limit that one in so many comes near to.
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
