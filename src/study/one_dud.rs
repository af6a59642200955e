//! One dud: the shot as planned with each single hole left out, as a grid of power is judged with each single line out (N − 1).
//!
//! Holes that are each other's images in a mirror plane of shelter and shot are judged once, and so are holes that take the same
//! others along. Nothing else varies. Where the plan asks for more (`withstands_one_dud`), the [`SAMPLED_PLACES`] worst places are
//! sampled, too, unless the worst fails as planned.

use std::collections::BTreeMap;

use itertools::Itertools;

use super::as_planned::check_many::{check_summary, or_failed_run};
use super::as_planned::quick_check::quick_check;
use super::samples::risk_summary::RiskSummary;
use super::samples::sample_count::Sampling;
use super::samples::sample_until_sure::{ShotToSample, sample_shots};
use super::work::batch::run_batch;
use super::{Case, Computed, Context, NoResult, ShotSummary};
use crate::scene::Shot;
use crate::verdict::{Quantity, Verdict};

/// Places of a dud that are sampled where the plan asks for it: the worst ones.
const SAMPLED_PLACES: usize = 3;

/// A shot as planned in which one hole is a dud, at the worst place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OneDud {
    /// Index of the blast row of the hole.
    pub row: usize,
    /// Number of the hole in its row, from 0.
    pub number: usize,
    /// The shot without it.
    pub planned: ShotSummary,
    /// Places at which a dud does not leave a pass.
    pub not_passing: usize,
    /// All places: the number of holes.
    pub places: usize,
    /// What the samples of the worst places tell, of the worst of them; `None` where the plan does not ask for it, or the option fails
    /// without them.
    pub sampled: Option<RiskSummary>,
}

impl OneDud {
    /// Whether the option withstands any one dud, as far as it was asked for.
    pub fn verdict(&self) -> Verdict {
        let sampled = self.sampled.map_or(Verdict::Pass, |sampled| sampled.verdict);
        self.planned.verdict.max(sampled)
    }

    /// The quantity that takes the greatest share of its limit without the hole.
    pub fn nearest_limit(&self, case: &Case) -> Quantity {
        let share = |quantity: &Quantity| {
            case.limits.get(*quantity).map_or(-1.0, |limit| self.planned.get(*quantity).value / limit)
        };
        let all = Quantity::ALL.into_iter().rev();
        all.max_by(|a, b| share(a).total_cmp(&share(b))).unwrap_or(Quantity::Height)
    }
}

/// One hole for all those of which a dud makes the same motion, but for mirror images: the index of its firing, and their number.
fn places(case: &Case, shot: &Shot) -> Vec<(usize, usize)> {
    let mirrors: Vec<_> =
        case.scene().mirrors_with_slope().filter(|mirror| shot.is_mirrored(mirror)).collect();
    let tires = |n: usize| -> Vec<(usize, u64)> {
        let left = shot.with_dud(n);
        left.firings.iter().map(|firing| (firing.tire, firing.time.to_bits())).sorted().collect()
    };
    let mut counts: BTreeMap<Vec<(usize, u64)>, (usize, usize)> = BTreeMap::new();
    for n in 0..shot.firings.len() {
        let mut images = vec![tires(n)];
        for mirror in &mirrors {
            let reflected = |image: &Vec<(usize, u64)>| {
                image.iter().map(|&(tire, time)| (mirror.image[tire], time)).sorted().collect()
            };
            let of_all: Vec<_> = images.iter().map(reflected).collect();
            images.extend(of_all);
        }
        let first = images.into_iter().min().unwrap_or_default();
        counts.entry(first).or_insert((n, 0)).1 += 1;
    }
    counts.into_values().sorted().collect()
}

/// Judges a shot with any one hole left out; with a `sampling` the worst places are sampled, too, unless the shot fails without. `None` where the time was up, or
/// the shot has no hole.
pub fn judge_one_dud(
    context: &Context<'_>,
    shot: &Shot,
    sampling: Option<&Sampling>,
) -> Result<Option<OneDud>, NoResult> {
    let &Context { case, control, .. } = context;
    let places = places(case, shot);
    let checked =
        run_batch(&places, control, |&(hole, _)| or_failed_run(quick_check(context, &shot.with_dud(hole))))?;
    let Some(checked) = checked.into_iter().collect::<Option<Vec<_>>>() else { return Ok(None) };
    let mut places: Vec<((usize, usize), ShotSummary)> = places.into_iter().zip(checked).collect();
    let utilization = |planned: &ShotSummary| planned.utilization(&case.limits);
    places
        .sort_by(|(_, a), (_, b)| b.verdict.cmp(&a.verdict).then(utilization(b).total_cmp(&utilization(a))));
    let Some(&((worst, _), _)) = places.first() else { return Ok(None) };
    // The worst is told with the errors of a check.
    let planned = match or_failed_run(check_summary(context, &shot.with_dud(worst))) {
        Err(NoResult::OutOfTime) => return Ok(None),
        planned => planned?,
    };
    let mut sampled = None;
    if let Some(sampling) = sampling.filter(|_| planned.verdict != Verdict::Fail) {
        let holes = places.iter().take(SAMPLED_PLACES).map(|&((hole, _), planned)| (hole, planned));
        sampled = sample_worst(context, shot, holes, sampling)?;
        if sampled.is_none() {
            return Ok(None);
        }
    }
    let not_passing = places.iter().filter(|(_, planned)| planned.verdict != Verdict::Pass);
    Ok(Some(OneDud {
        row: shot.firings[worst].row,
        number: shot.firings[worst].number,
        planned,
        not_passing: not_passing.map(|((_, count), _)| count).sum(),
        places: shot.firings.len(),
        sampled,
    }))
}

/// Samples a shot without each of these holes, until surely fewer than `dud_risk_percent` fail, or more; of the worst what its
/// samples tell. `None` where the time was up.
fn sample_worst(
    context: &Context<'_>,
    shot: &Shot,
    holes: impl Iterator<Item = (usize, ShotSummary)>,
    sampling: &Sampling,
) -> Result<Option<RiskSummary>, NoResult> {
    let &Context { case, compute, control, .. } = context;
    let mut case = case.clone();
    case.limits.accepted_risk = case.plan.limits.dud_risk_percent * 1e-2;
    let (shots, planned): (Vec<Shot>, Vec<ShotSummary>) =
        holes.map(|(hole, planned)| (shot.with_dud(hole), planned)).unzip();
    let sampling = Sampling { least: 0, ..*sampling };
    let target = |(shot, planned): (_, &ShotSummary)| {
        ShotToSample::new(&case, shot, compute, sampling).with_planned(*planned)
    };
    let targets: Vec<ShotToSample<'_>> = shots.iter().zip(&planned).map(target).collect();
    let Computed { value: sampled, partial } = sample_shots(&targets, control)?;
    let risks = sampled.iter().map(|sampled| RiskSummary::of(sampled, &case.limits));
    let worst =
        risks.max_by(|a, b| a.verdict.cmp(&b.verdict).then(a.failing_share().total_cmp(&b.failing_share())));
    Ok(worst.filter(|_| !partial))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Plan;

    fn case(more: &str) -> Case {
        let text =
            include_str!("../../tests/fixtures/amur-three-rows.toml").replace("name = \"42 ms\"", more);
        Case::new(Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")))
    }

    /// Five holes a row in a shelter that is its own mirror image across x: three places a row, of 2, 2 and 1 holes.
    #[test]
    fn places_that_are_mirror_images_are_judged_once() {
        let case = case("name = \"42 ms\"");
        let option = case.plan.delays.iter().position(|delay| delay.name == "42 ms").expect("an option");
        let shot = &case.shots[option];
        let places = places(&case, shot);
        assert_eq!(places.iter().map(|(_, count)| count).sum::<usize>(), shot.firings.len());
        let columns = shot.firings.len() / 3;
        assert_eq!(places.len(), 3 * columns.div_ceil(2), "{places:?}");
    }

    /// A row fired through from the left: its first hole takes it and the rows after it, the last only itself.
    #[test]
    fn a_dud_takes_along_what_it_would_have_fired() {
        let case = case("name = \"42 ms\"\nhole_interval_ms = 5\nfired_through = true");
        let option = case.plan.delays.iter().position(|delay| delay.name == "42 ms").expect("an option");
        let shot = &case.shots[option];
        let (rows, columns) = (3, shot.firings.len() / 3);
        let left = |row: usize, number: usize| {
            let hole = shot.firings.iter().position(|f| f.row == row && f.number == number).expect("a hole");
            shot.with_dud(hole).firings.len()
        };
        for row in 0..rows {
            assert_eq!(left(row, 0), row * columns, "the row and all later rows");
            assert_eq!(left(row, columns - 1), shot.firings.len() - 1);
            assert_eq!(left(row, 1), shot.firings.len() - columns + 1);
        }
        assert_eq!(places(&case, shot).len(), shot.firings.len());
    }
}
