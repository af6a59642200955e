//! One combination of rope, tire mass and border rows: its trial with the planned shots, and its samples.

use std::ops::ControlFlow;

use itertools::Itertools;

use super::{Combination, Demand, SizingTask, Trial, Untried, WorstShotRisk};
use crate::plan::mass_law::launch_factor;
use crate::plan::{HoleTiming, Time};
use crate::ropes::Rope;
use crate::scene::Shot;
use crate::study::as_planned::check_many::{check_summary, run_checks};
use crate::study::as_planned::cover::Cover;
use crate::study::judge::confirm::confirm_shots;
use crate::study::judge::grounds::Evidence;
use crate::study::judge::nearest_limits::nearest_each_limit_in_turn;
use crate::study::judge::one_dud::withstands_one_dud;
use crate::study::samples::failure_bounds::FailureBounds;
use crate::study::samples::risk_summary::RiskSummary;
use crate::study::samples::run_sample::ShotToSample;
use crate::study::samples::sample_count::Sampling;
use crate::study::samples::sample_until_sure::sample_shots_watched;
use crate::study::samples::sampled_shot::SampledShot;
use crate::study::standing::verdict_word::ThinPass;
use crate::study::{Case, Computed, NoResult, ShotSummary};
use crate::verdict::{PerQuantity, Verdict};

/// Number of shots, the hardest, that are judged before all others. Most combinations that do not hold fail at one of them.
const HARDEST: usize = 8;
/// Number of shots checked together before a failure ends the trial. The number is fixed, so the checked shots do not depend on the
/// number of threads.
const AT_ONCE: usize = 32;

/// The shots that a combination must hold, hardest first: the index of each, and the summary of its planned shot.
pub(super) type ShotsToSample = Vec<(usize, ShotSummary)>;

/// A combination made ready to run.
pub(super) struct SizeCandidate<'q> {
    task: &'q SizingTask<'q>,
    rope: &'static Rope,
    tire_mass: f64,
    border_rows: usize,
    /// The plan with these sizes. Its launches are at the worse end of the [mass law](crate::plan::mass_law).
    case: Case,
    /// Exponents of the mass law at which the shelter must hold, worse end first; a single one if no launch depends on it.
    exponents: Vec<f64>,
    /// The plan with these sizes for each exponent (`n_exponents`). In its samples the exponent is known. Empty if there is one
    /// exponent.
    with_exponent: Vec<Case>,
    /// The demanded shots, once for each exponent (`n_exponents` × `n_demanded`).
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
        let shots: Vec<Shot> = match task.demand {
            Demand::Options(options) => options.iter().map(|&option| case.shots[option].clone()).collect(),
            Demand::AnyOrder(intervals, holes) => all_orders(&case, intervals, holes),
        };
        let heavier = tire_mass / task.plan.tire.mass_kg;
        let uncertainty = &task.plan.uncertainty;
        let worse = uncertainty.worse_mass_exponent(heavier);
        let others = uncertainty.launch_mass_exponent.into_iter().filter(|&n| heavier != 1.0 && n != worse);
        let exponents: Vec<f64> = [worse].into_iter().chain(others).collect();
        let at = |&exponent: &f64| {
            let factor = launch_factor(heavier, exponent) / launch_factor(heavier, worse);
            shots.iter().map(move |shot| shot.with_launches(factor)).collect::<Vec<_>>()
        };
        let shots = exponents.iter().flat_map(at).collect();
        let with_exponent = match exponents[..] {
            [_] => Vec::new(),
            _ => exponents.iter().map(|&exponent| with_exponent(&case, exponent)).collect(),
        };
        Self { task, rope, tire_mass, border_rows, case, exponents, with_exponent, shots }
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

    /// Checks the planned shots in chunks of [`AT_ONCE`], beginning with index `last_failed`. Stops after the first chunk with a
    /// shot that does not pass, and puts the index of that shot into `last_failed`. `None` if the time was up.
    pub(super) fn try_as_planned(
        &self,
        last_failed: &mut usize,
    ) -> Result<Option<(Trial, ShotsToSample)>, NoResult> {
        let (case, SizingTask { context, .. }) = (&self.case, self.task);
        let mut order: Vec<usize> = (0..self.shots.len()).collect();
        if *last_failed < order.len() {
            order.swap(0, *last_failed);
        }
        let mut checked: Vec<ShotSummary> = Vec::new();
        let mut holds = true;
        for chunk in order.chunks(AT_ONCE) {
            let part: Vec<Shot> = chunk.iter().map(|&n| self.shots[n].clone()).collect();
            let context = context.with_case(case);
            let checked_part = run_checks(&part, context.control, |shot| check_summary(&context, shot))?;
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
        let hardest = nearest_each_limit_in_turn(&case.limits, &checked);
        // A user who chooses shackles by the force needs the greatest force of all shots.
        let greatest = |quantity| {
            let of_shots = checked.iter().map(|checked| *checked.values.get(quantity));
            of_shots.max_by(|a, b| a.value.total_cmp(&b.value)).unwrap_or_default()
        };
        let covers = checked.iter().map(|checked| checked.cover);
        let worst = ShotSummary {
            // The shot that keeps a combination from holding need not be the shot with the greatest utilization.
            verdict: Verdict::worst(checked.iter().map(|checked| checked.verdict)),
            values: PerQuantity::from_fn(greatest),
            cover: covers.max_by_key(|cover| cover.uncovered).unwrap_or(Cover::NONE),
        };
        let trial = Trial {
            holds,
            worst,
            utilization: worst.utilization(&case.limits),
            shots: checked.len(),
            risk: None,
            grounds: None,
            thin: None,
        };
        let to_sample = hardest.into_iter().map(|n| (order[n], checked[n])).collect();
        Ok(Some((trial, to_sample)))
    }

    /// What ends the pass of a shot, if one of them has a thin pass. The hardest shots are tried first.
    pub(super) fn thin(&self, shots: &ShotsToSample) -> Result<Option<ThinPass>, NoResult> {
        let context = self.task.context.with_case(&self.case);
        for (n, _) in self.hardest_and_rest(shots).into_iter().flatten() {
            let thin = ThinPass::of_passing_shot(&context, &self.shots[n])?;
            if thin.is_some() {
                return Ok(thin);
            }
        }
        Ok(None)
    }

    /// The shots to sample in two parts: the hardest shots of each exponent, then the rest.
    pub(super) fn hardest_and_rest(&self, shots: &ShotsToSample) -> [ShotsToSample; 2] {
        let mut left = vec![HARDEST; self.exponents.len()];
        let is_hardest = |&(n, _): &(usize, ShotSummary)| {
            let left = &mut left[self.exponent_of(n)];
            let is_one = *left > 0;
            *left -= usize::from(is_one);
            is_one
        };
        let (hardest, rest) = shots.iter().copied().partition(is_hardest);
        [hardest, rest]
    }

    /// Index of the exponent that a shot belongs to.
    fn exponent_of(&self, shot: usize) -> usize {
        shot * self.exponents.len() / self.shots.len()
    }

    /// Samples shots until each risk is sure, or one shot does not pass; `None` if the time was up. If the mass of the tires
    /// changes, the shots of the worse end are sampled first, by the plan with these sizes. Then the shots of each end are sampled
    /// by the plan with its exponent.
    pub(super) fn sample(
        &self,
        shots: &ShotsToSample,
        sampling: &Sampling,
    ) -> Result<Option<WorstShotRisk>, NoResult> {
        let mut worst = WorstShotRisk::NONE;
        for (exponent, case) in self.cases() {
            let targets = self.targets(exponent, case, shots, sampling);
            let until_one_fails = &mut |_, sampled: &SampledShot| match sampled.verdict() {
                Verdict::Fail => ControlFlow::Break(()),
                Verdict::Pass | Verdict::Undecided => ControlFlow::Continue(()),
            };
            let Computed { value: risks, partial } =
                sample_shots_watched(&targets, self.task.context.control, until_one_fails)?;
            if partial {
                return Ok(None);
            }
            let of_shot = |sampled: &SampledShot| {
                let FailureBounds { samples, failures, interval: [_, failure_upper_bound], .. } =
                    sampled.bounds;
                WorstShotRisk { verdict: sampled.verdict(), samples, failures, failure_upper_bound }
            };
            let all = [worst].into_iter().chain(risks.iter().map(of_shot));
            worst = all.max_by(WorstShotRisk::compare).unwrap_or(worst);
            if worst.verdict != Verdict::Pass {
                break;
            }
        }
        Ok(Some(worst))
    }

    /// Whether every shot withstands any one dud, if the plan makes that a part of the verdict; `None` if the time was up.
    pub(super) fn withstands_one_dud(
        &self,
        shots: &ShotsToSample,
        sampling: &Sampling,
    ) -> Result<Option<Evidence<Verdict>>, NoResult> {
        for (exponent, case) in self.cases() {
            let context = self.task.context.with_case(case);
            for (n, _) in shots.iter().filter(|(n, _)| self.exponent_of(*n) == exponent) {
                match withstands_one_dud(&context, &self.shots[*n], sampling)? {
                    Some(Evidence::Known(Verdict::Pass)) => {}
                    known => return Ok(known),
                }
            }
        }
        Ok(Some(Evidence::Known(Verdict::Pass)))
    }

    /// Whether fresh draws confirm every shot; `None` if the time was up.
    pub(super) fn confirm(
        &self,
        shots: &ShotsToSample,
        sampling: &Sampling,
    ) -> Result<Option<Verdict>, NoResult> {
        let targets: Vec<ShotToSample<'_>> =
            self.cases().flat_map(|(exponent, case)| self.targets(exponent, case, shots, sampling)).collect();
        let drawn = confirm_shots(&targets, self.task.context.control)?;
        let drawn: Option<Vec<_>> = drawn.into_iter().collect();
        let verdicts = |drawn: Vec<RiskSummary>| Verdict::worst(drawn.iter().map(|drawn| drawn.verdict));
        Ok(drawn.map(verdicts))
    }

    /// The plan with these sizes. If the mass of the tires changes, also the plan at each end of the mass law. Each plan comes with
    /// the index of its exponent.
    fn cases(&self) -> impl Iterator<Item = (usize, &Case)> {
        [(0, &self.case)].into_iter().chain(self.with_exponent.iter().enumerate())
    }

    /// The shots of one exponent, to be sampled by the plan of `case`.
    fn targets<'s>(
        &'s self,
        exponent: usize,
        case: &'s Case,
        shots: &ShotsToSample,
        sampling: &Sampling,
    ) -> Vec<ShotToSample<'s>> {
        let of_case = shots.iter().filter(|(n, _)| self.exponent_of(*n) == exponent);
        let target = |&(n, planned): &(usize, ShotSummary)| {
            ShotToSample::new(case, &self.shots[n], self.task.context.compute, *sampling)
                .with_planned(planned)
        };
        of_case.map(target).collect()
    }
}

/// The case with a known exponent of the mass law in its samples.
fn with_exponent(case: &Case, exponent: f64) -> Case {
    let mut plan = case.plan.clone();
    plan.uncertainty.launch_mass_exponent = [exponent; 2];
    Case::new(plan)
}

fn all_orders(case: &Case, intervals: &[Time], holes: &HoleTiming) -> Vec<Shot> {
    let rows = case.plan.blast_rows.len();
    let orders = (0..rows).permutations(rows).collect_vec();
    itertools::iproduct!(intervals, &orders)
        .map(|(&interval, order)| case.shot(order, interval, holes))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::judge;
    use super::*;
    use crate::choice::Accuracy;
    use crate::plan::Plan;
    use crate::ropes::catalogue;
    use crate::study::judge::grounds::Grounds;
    use crate::study::{ComputeSettings, Context, StudyControl};

    /// `amur-three-rows` with tires of 350 kg on its rope 14-1960, fired 20 ms apart, for several ranges of the exponent. By
    /// momentum none of hundreds of shots fails. If these tires leave as fast as tires of 280 kg, 38 to 63 % fail by an independent
    /// sampler.
    #[test]
    fn heavier_tires_that_only_momentum_would_hold_are_no_choice() {
        let text = include_str!("../../../tests/fixtures/amur-three-rows.toml");
        let verdict = |launch_mass_exponent: [f64; 2]| {
            let mut plan = Plan::parse("", text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
            plan.uncertainty.launch_mass_exponent = launch_mass_exponent;
            let demand = Demand::Options(vec![2]);
            let compute = ComputeSettings { accuracy: Accuracy::Draft, ..ComputeSettings::of(&plan) };
            let control = StudyControl::default();
            let case = Case::new(plan.clone());
            let context = Context::new(&case, compute, &control);
            let task = SizingTask { plan: &plan, demand: &demand, context: &context };
            let rope = catalogue().find("GOST 2688-80 14 1960").expect("the plan's rope");
            let candidate = SizeCandidate::new(&task, rope, 350.0, 0);
            let (trial, hardest) = candidate.try_as_planned(&mut 0).expect("a run").expect("time");
            let sampling = Sampling { least: 0, ..Sampling::OF_VERDICT };
            let risk = candidate.sample(&hardest, &sampling).expect("samples").expect("time");
            (trial.shots, trial.holds, risk.verdict)
        };
        assert_eq!(verdict([1.0, 1.0]), (1, true, Verdict::Pass));
        assert_eq!(verdict([0.0, 0.0]), (1, true, Verdict::Fail));
        assert_eq!(verdict([0.0, 1.0]), (2, true, Verdict::Fail));
    }

    /// Any order of three rows at three intervals. With a dud, the order 3 2 1 pulls 40.0 kN, against the 39.6 kN of the rope. This
    /// order is not among the hardest planned shots.
    #[test]
    fn a_size_for_any_order_holds_each_of_them() {
        let text = include_str!("../../../tests/fixtures/dud-in-one-order.toml");
        let mut plan = Plan::parse("", text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        plan.limits.cable_safety_factor = 1.05;
        let demand = Demand::AnyOrder([20.0, 25.0, 30.0].map(Time::from_ms).to_vec(), HoleTiming::TOGETHER);
        let compute = ComputeSettings { accuracy: Accuracy::Draft, ..ComputeSettings::of(&plan) };
        let control = StudyControl::default();
        let case = Case::new(plan.clone());
        let context = Context::new(&case, compute, &control);
        let task = SizingTask { plan: &plan, demand: &demand, context: &context };
        let rope = catalogue().find("GOST 2688-80 8.3 1960").expect("in the catalogue");
        let candidate = SizeCandidate::new(&task, rope, 280.0, 0);
        let (trial, shots) = candidate.try_as_planned(&mut 0).expect("a run").expect("time");
        assert!(trial.holds && shots.len() == 18);
        let grounds = Grounds {
            planned: Verdict::Pass,
            launch_is_estimated: false,
            samples: Evidence::NotAsked,
            one_dud: Evidence::NotAsked,
            confirmation: Evidence::NotAsked,
        };
        let judged = judge(&candidate, &shots, grounds, &Sampling::OF_VERDICT, &mut 0);
        let (_, grounds) = judged.expect("samples").expect("time");
        assert_ne!(grounds.verdict(), Verdict::Pass);
    }

    /// The written plan takes the worse end of the mass law: the first shots have its launches.
    #[test]
    fn the_worse_end_comes_first() {
        let text = include_str!("../../../tests/fixtures/amur-three-rows.toml");
        let plan = Plan::parse("", text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let (compute, control) = (ComputeSettings::of(&plan), StudyControl::default());
        let demand = Demand::Options(vec![2, 4]);
        let case = Case::new(plan.clone());
        let context = Context::new(&case, compute, &control);
        let task = SizingTask { plan: &plan, demand: &demand, context: &context };
        let rope = catalogue().find("GOST 2688-80 14 1960").expect("the plan's rope");
        for (mass, speeds) in
            [(350.0, &[6.0, 6.0, 4.8, 4.8][..]), (280.0, &[6.0, 6.0]), (240.0, &[7.0, 7.0, 6.0, 6.0])]
        {
            let candidate = SizeCandidate::new(&task, rope, mass, 0);
            let launches: Vec<f64> = candidate.shots.iter().map(|shot| shot.firings[0].launch.z).collect();
            assert_eq!(launches.len(), speeds.len(), "{mass}");
            let is_near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-12;
            assert!(launches.iter().zip(speeds).all(is_near), "{mass}: {launches:?}");
        }
    }
}
