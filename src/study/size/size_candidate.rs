//! One combination of rope, tire mass and border rows: its trial with the shots as planned, and its samples.

use std::ops::ControlFlow;

use itertools::Itertools;

use super::{Combination, Demand, SizingTask, Trial, Untried, WorstShotRisk};
use crate::ropes::Rope;
use crate::scene::Shot;
use crate::study::as_planned::check_many::check_summaries;
use crate::study::as_planned::cover::Cover;
use crate::study::samples::failure_bounds::FailureBounds;
use crate::study::samples::sample_count::Sampling;
use crate::study::samples::sample_until_sure::{ShotToSample, sample_shots_watched};
use crate::study::samples::sampled_shot::SampledShot;
use crate::study::{Case, Computed, NoResult, ShotSummary, ValueWithError};
use crate::verdict::Verdict;

/// Number of orders, the hardest ones, that are sampled.
const HARDEST: usize = 8;
/// Number of shots checked together before a failure ends the trial. A fixed number: the shots checked do not depend on the
/// number of threads.
const AT_ONCE: usize = 32;

/// The shots that a combination is sampled with, hardest first: the index of each and what it is as planned.
pub(super) type ShotsToSample = Vec<(usize, ShotSummary)>;

/// A combination made ready to run.
pub(super) struct SizeCandidate<'q> {
    task: &'q SizingTask<'q>,
    rope: &'static Rope,
    tire_mass: f64,
    border_rows: usize,
    case: Case,
    shots: Vec<Shot>,
}

impl<'q> SizeCandidate<'q> {
    pub(super) fn new(
        task: &'q SizingTask<'q>,
        rope: &'static Rope,
        tire_mass: f64,
        border_rows: usize,
    ) -> Self {
        let case = Case::new(task.plan.with_sizes(rope, tire_mass, border_rows));
        let shots = match task.demand {
            Demand::Options(options) => options.iter().map(|&option| case.shots[option].clone()).collect(),
            Demand::AnyOrder(intervals) => all_orders(&case, intervals),
        };
        Self { task, rope, tire_mass, border_rows, case, shots }
    }

    /// The combination with the result of its trial.
    pub(super) fn combination(&self, trial: Result<Trial, Untried>) -> Combination {
        let scene = self.case.scene();
        let length: f64 = scene.cables.iter().map(|cable| cable.rest_length).sum();
        Combination {
            rope: self.rope,
            tire_mass: self.tire_mass,
            border_rows: self.border_rows,
            tires: scene.tire_count(),
            total_mass: scene.mass.iter().sum::<f64>() + length * self.rope.mass_kg_per_m,
            trial,
        }
    }

    /// Checks the shots as planned in chunks of [`AT_ONCE`], beginning with index `last_failed`. Stops after the first chunk with a
    /// shot that does not pass, and puts that shot's index into `last_failed`. `None` where the time was up.
    pub(super) fn try_as_planned(
        &self,
        last_failed: &mut usize,
    ) -> Result<Option<(Trial, ShotsToSample)>, NoResult> {
        let (case, SizingTask { compute, control, demand, .. }) = (&self.case, self.task);
        let mut order: Vec<usize> = (0..self.shots.len()).collect();
        if *last_failed < order.len() {
            order.swap(0, *last_failed);
        }
        let mut checked: Vec<ShotSummary> = Vec::new();
        let mut holds = true;
        for chunk in order.chunks(AT_ONCE) {
            let part: Vec<Shot> = chunk.iter().map(|&n| self.shots[n].clone()).collect();
            let checked_part = check_summaries(case, &part, compute, control)?;
            let Some(checked_part) = checked_part.into_iter().collect::<Option<Vec<_>>>() else {
                return Ok(None);
            };
            let failed = checked_part.iter().position(|checked| checked.verdict != Verdict::Pass);
            checked.extend(checked_part);
            if let Some(failed) = failed {
                *last_failed = chunk[failed];
                holds = false;
                break;
            }
        }
        let utilization = |checked: &ShotSummary| checked.utilization(&case.limits);
        let by_utilization =
            |a: &usize, b: &usize| utilization(&checked[*b]).total_cmp(&utilization(&checked[*a]));
        let hardest: Vec<usize> = (0..checked.len()).sorted_by(by_utilization).collect();
        let zero = ValueWithError::default();
        let nothing = ShotSummary {
            verdict: Verdict::Pass,
            height: zero,
            force: zero,
            drift: zero,
            cover: Cover::NONE,
        };
        let mut worst = hardest.first().map_or(nothing, |&n| checked[n]);
        let covers = checked.iter().map(|checked| checked.cover);
        worst.cover = covers.max_by_key(|cover| cover.uncovered).unwrap_or(Cover::NONE);
        let trial = Trial {
            holds,
            worst,
            utilization: utilization(&worst),
            shots: checked.len(),
            risk: None,
            is_acceptable: false,
        };
        let most = if matches!(demand, Demand::Options(_)) { order.len() } else { HARDEST };
        Ok(Some((trial, hardest.into_iter().take(most).map(|n| (order[n], checked[n])).collect())))
    }

    /// Samples shots until each risk is sure, or one surely fails; `None` where the time was up.
    pub(super) fn sample(
        &self,
        hardest: &ShotsToSample,
        sampling: &Sampling,
    ) -> Result<Option<WorstShotRisk>, NoResult> {
        let compute = self.task.compute;
        let target = |&(n, planned): &(usize, ShotSummary)| {
            ShotToSample::new(&self.case, &self.shots[n], *compute, *sampling).with_planned(planned)
        };
        let targets: Vec<ShotToSample<'_>> = hardest.iter().map(target).collect();
        let until_one_fails = &mut |_, sampled: &SampledShot| match sampled.verdict() {
            Verdict::Fail => ControlFlow::Break(()),
            Verdict::Pass | Verdict::Undecided => ControlFlow::Continue(()),
        };
        let Computed { value: risks, partial } =
            sample_shots_watched(&targets, self.task.control, until_one_fails)?;
        let worst = risks.iter().map(|sampled| {
            let FailureBounds { samples, failures, interval: [_, failure_upper_bound], .. } = sampled.bounds;
            WorstShotRisk { verdict: sampled.verdict(), samples, failures, failure_upper_bound }
        });
        let nothing =
            WorstShotRisk { verdict: Verdict::Pass, samples: 0, failures: 0, failure_upper_bound: 1.0 };
        let worst = worst.max_by(WorstShotRisk::compare).unwrap_or(nothing);
        Ok((!partial).then_some(worst))
    }
}

fn all_orders(case: &Case, intervals: &[f64]) -> Vec<Shot> {
    let rows = case.plan.blast_rows.len();
    let orders = (0..rows).permutations(rows).collect_vec();
    itertools::iproduct!(intervals, &orders).map(|(&interval, order)| case.shot(order, interval)).collect()
}
