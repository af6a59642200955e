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
