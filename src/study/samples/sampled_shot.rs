//! Result of the samples of a shot: how likely the shot fails when the unknowns vary as `[uncertainty]` says.
//!
//! A sample runs once, at a coarse step. The error of that step falls to both sides of a limit. So the failure probability is far
//! more exact than any one sample. The audit runs some samples again at a finer step. If these runs, or the planned shot,
//! contradict the samples, the risk is open. Then [`sample_shots`](super::sample_until_sure::sample_shots) samples the shot anew at
//! half the step.

use std::collections::BTreeMap;
use std::iter::repeat_n;
use std::sync::OnceLock;

use itertools::Itertools;

use super::failure_bounds::{ErrorShare, FailureBounds};
use super::risk_reason::RiskReason;
use super::sample::{Sample, SampleRun};
use crate::sorting::{sort_by, sorted_by};
use crate::study::{Case, ShotSummary};
use crate::verdict::{Limits, PerQuantity, Quantity, Verdict};

/// Factor on a difference to one side. The audit has an error of its own, so the factor is greater than 1.
const BIAS_ALLOWANCE: f64 = 2.0;
/// Probability below which a difference between samples and audit counts as more than chance.
const SIGNIFICANCE: f64 = 0.01;
/// Normal deviate that both sides together exceed with the probability [`SIGNIFICANCE`].
const SIGNIFICANT_DEVIATIONS: f64 = 2.576;
/// Least number of audited samples. With fewer, no risk passes.
pub const LEAST_AUDITS: usize = 20;
/// Samples needed for bands.
pub const SAMPLES_FOR_BANDS: usize = 100;

/// The samples of one shot, in order of their numbers, and their result.
#[derive(Clone, Debug, PartialEq)]
pub struct SampledShot {
    /// The samples.
    pub samples: Vec<Sample>,
    /// Bounds of the failure probability.
    pub bounds: FailureBounds,
    /// Bounds of the probability that a cable breaks.
    pub breaks: FailureBounds,
    /// Number of times that the step was halved because finer runs contradicted the samples.
    pub step_halvings: u32,
    /// Whether samples are audited: not if the user fixed the step.
    is_audited: bool,
    /// Whether the launch velocity is an estimate that nobody observed.
    launch_is_estimated: bool,
    /// Force at which a cable breaks and is gone, so that no run shows a greater force [N]; infinite if no cable breaks.
    breaking_force: f64,
    planned: Option<ShotSummary>,
    limits: Limits,
    reason: FoundOnce,
}

/// Why the samples do not pass. Found once for all samples so far, because the screen asks for it all the time.
#[derive(Clone, Debug, Default)]
struct FoundOnce(OnceLock<Option<RiskReason>>);

impl PartialEq for FoundOnce {
    /// Always equal, because the reason follows from the samples.
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl SampledShot {
    /// A shot without samples, checked as `planned`. The plan of `case` names the accepted risk. The verdict takes `share` of the
    /// error probability.
    pub fn new(case: &Case, planned: Option<ShotSummary>, share: ErrorShare, is_audited: bool) -> Self {
        let limits = case.limits;
        let bounds = FailureBounds::new(limits.accepted_risk, share);
        let breaking_force = case.scene().breaking_force.unwrap_or(f64::INFINITY);
        Self {
            samples: Vec::new(),
            bounds,
            breaks: bounds,
            step_halvings: 0,
            is_audited,
            launch_is_estimated: case.plan.uncertainty.launch_is_estimated(),
            breaking_force,
            planned,
            limits,
            reason: FoundOnce::default(),
        }
    }

    /// Adds the next sample. An audited sample counts by its run at the finer step.
    pub fn push(&mut self, sample: Sample) {
        let SampleRun { verdict, breaks, .. } = *sample.finest();
        self.bounds.push(verdict);
        self.breaks.push(breaks);
        self.samples.push(sample);
        self.reason = FoundOnce::default();
    }

    /// Lower and upper bound of the failure probability after the first `counts` samples; `counts` never decrease.
    pub fn bounds_after(&self, counts: &[usize]) -> Vec<[f64; 2]> {
        self.bounds.after(self.samples.iter().map(|sample| sample.finest().verdict), counts)
    }

    /// The verdict of the samples: the verdict of their [`reason`](Self::reason), or a pass if there is none.
    pub fn verdict(&self) -> Verdict {
        self.reason().map_or(Verdict::Pass, RiskReason::verdict)
    }

    /// Why the samples do not pass; `None` if they do. If finer runs contradict the samples, the samples prove no fail either.
    pub fn reason(&self) -> Option<RiskReason> {
        *self.reason.0.get_or_init(|| self.find_reason())
    }

    fn find_reason(&self) -> Option<RiskReason> {
        if self.planned_exceeds_samples() {
            return Some(RiskReason::PlannedExceedsSamples);
        }
        if self.finer_runs_disagree() {
            return Some(RiskReason::FinerRunsDisagree);
        }
        match self.bounds.verdict() {
            Verdict::Fail => Some(RiskReason::TooManyFail),
            Verdict::Undecided if self.bounds.undecided > 0 => Some(RiskReason::UndecidedSamples),
            Verdict::Undecided => Some(RiskReason::NotSure),
            Verdict::Pass if self.verdict_once_audited() != Verdict::Pass => Some(RiskReason::FewAudited),
            Verdict::Pass => self.launch_is_estimated.then_some(RiskReason::LaunchEstimated),
        }
    }

    /// The verdict of the bounds; no pass before [`LEAST_AUDITS`] samples are audited.
    pub fn verdict_once_audited(&self) -> Verdict {
        match self.bounds.verdict() {
            Verdict::Pass if self.is_audited && self.audited().count() < LEAST_AUDITS => Verdict::Undecided,
            verdict => verdict,
        }
    }

    /// Whether finer runs contradict the samples: the runs of the audit beyond chance, or the planned shot.
    pub fn finer_runs_disagree(&self) -> bool {
        self.audit_differs() || self.is_biased() || self.planned_exceeds_samples()
    }

    /// Whether the samples pass only because their step is too long. The planned shot is computed more finely. It exceeds the
    /// greatest sample by some d, and that sample + 2 d exceeds a limit.
    pub fn planned_exceeds_samples(&self) -> bool {
        let Some(planned) = self.planned else { return false };
        let would_fail = |quantity: Quantity| {
            let refined = self.uncapped(quantity, planned.get(quantity).value);
            let values = self.decided().map(|sample| self.value(&sample.run, quantity));
            let greatest = values.fold(0.0, f64::max);
            let limit = self.limits.get(quantity).unwrap_or(f64::INFINITY);
            refined > greatest && 2.0 * refined - greatest > limit
        };
        let passes = self.bounds.verdict() == Verdict::Pass;
        passes && Quantity::ALL.into_iter().any(would_fail)
    }

    /// Whether audited samples fail more often or less often at the finer step, beyond chance. This is a sign test on the samples
    /// that change (McNemar 1947).
    fn audit_differs(&self) -> bool {
        let count = |more: bool| {
            let audited = self.audited().map(|(coarse, fine)| (coarse.verdict, fine.verdict));
            let changed =
                audited.filter(|(coarse, fine)| (*coarse == Verdict::Pass) != (*fine == Verdict::Pass));
            changed.filter(|(_, fine)| (*fine != Verdict::Pass) == more).count()
        };
        sign_test_rejects(count(true), count(false))
    }

    /// The value of a quantity in a run [its SI unit]; infinite for the force of a cable that broke and is gone.
    fn value(&self, run: &SampleRun, quantity: Quantity) -> f64 {
        self.uncapped(quantity, run.get(quantity))
    }

    /// A value of a quantity [its SI unit]. The force of a cable that broke and is gone becomes infinite, because it would have
    /// grown further.
    fn uncapped(&self, quantity: Quantity, value: f64) -> f64 {
        let broke = quantity == Quantity::Force && value >= self.breaking_force;
        if broke { f64::INFINITY } else { value }
    }

    /// Whether a cable broke in a run and was gone from then on.
    pub fn broke_a_cable(&self, run: &SampleRun) -> bool {
        self.value(run, Quantity::Force) == f64::INFINITY && run.verdict != Verdict::Undecided
    }

    /// Number of samples in which a hole fires under no tire.
    pub fn uncovered(&self) -> usize {
        self.samples.iter().filter(|sample| sample.finest().is_uncovered()).count()
    }

    /// The samples without an undecided run.
    pub fn decided(&self) -> impl Iterator<Item = &Sample> {
        let is_decided = |run: &SampleRun| run.verdict != Verdict::Undecided;
        self.samples.iter().filter(move |sample| is_decided(&sample.run) && is_decided(sample.finest()))
    }

    /// The runs of the audited samples, each at both steps: coarse, then finer.
    fn audited(&self) -> impl Iterator<Item = (&SampleRun, &SampleRun)> {
        self.samples.iter().filter_map(|sample| Some((&sample.run, sample.finer.as_ref()?)))
    }

    /// Whether the error of the step would change the verdict if all samples had the same error. This happens if the uncertainty is
    /// small: then no single sample changes its verdict between two steps, but all together would.
    ///
    /// 1. The values of the audit at the finer step lie to one side of the values at the coarser step, beyond chance.
    /// 2. The values of all samples are moved to that side by [`BIAS_ALLOWANCE`] times the mean difference.
    /// 3. The share that then fails contradicts the samples if it lies outside the bounds, or on the other side of the accepted risk.
    fn is_biased(&self) -> bool {
        let factors = PerQuantity::from_fn(|quantity| self.bias_factor(quantity));
        let fails = |sample: &&Sample| {
            let value = |quantity: Quantity| self.value(&sample.run, quantity) * factors.get(quantity);
            self.limits.utilization(value) > 1.0
        };
        let share = self.samples.iter().filter(fails).count() as f64 / self.samples.len().max(1) as f64;
        let is_moved = factors.iter().any(|&factor| factor != 1.0);
        let [low, high] = self.bounds.interval;
        let is_outside = is_moved && !(low..=high).contains(&share);
        // A share below the accepted share is outside the bounds of a fail.
        is_outside || self.bounds.verdict() == Verdict::Pass && share > self.bounds.accepted
    }

    /// Factor that moves a quantity: 1, unless the finer values lie to one side beyond chance.
    fn bias_factor(&self, quantity: Quantity) -> f64 {
        let pairs = self.audited().map(|runs| <[_; 2]>::from(runs).map(|run| self.value(run, quantity)));
        let known = pairs.filter(|values| values.iter().all(|value| value.is_finite()));
        let changes = known.map(|[coarse, fine]| fine / coarse - 1.0);
        let changes: Vec<f64> = changes.filter(|change| change.is_finite()).collect();
        if lies_to_one_side(&changes) {
            1.0 + BIAS_ALLOWANCE * changes.iter().sum::<f64>() / changes.len() as f64
        } else {
            1.0
        }
    }

    /// The value of a quantity that no more than the accepted share of the decided samples exceeds; `None` for fewer than
    /// [`SAMPLES_FOR_BANDS`]. An audited sample counts by its finer run, as it does for the verdict.
    pub fn deciding_value(&self, quantity: Quantity) -> Option<f64> {
        let value = self.deciding_by(quantity)?.finest().get(quantity);
        (self.decided().count() >= SAMPLES_FOR_BANDS).then_some(value)
    }

    /// Share of all shots above the [`deciding_value`](Self::deciding_value): the accepted share. If there are too few decided
    /// samples to leave any out, it is one of them: the greatest of 200 samples says nothing about 1 shot in 1000.
    pub fn share_above(&self) -> f64 {
        self.bounds.accepted.max(1.0 / self.decided().count().max(1) as f64)
    }

    /// Number of the decided sample with the [`deciding_value`](Self::deciding_value) of a quantity; of equal samples the first.
    /// `None` without a decided sample.
    pub fn deciding_sample_by(&self, quantity: Quantity) -> Option<usize> {
        self.deciding_by(quantity).map(|sample| sample.number)
    }

    fn deciding_by(&self, quantity: Quantity) -> Option<&Sample> {
        let value = |sample: &&Sample| sample.finest().get(quantity);
        let mut values: Vec<f64> = self.decided().map(|sample| value(&sample)).collect();
        values.sort_by(f64::total_cmp);
        let deciding = *values.iter().nth_back(self.left_out_of_decided()).or(values.first())?;
        self.decided().find(|sample| value(sample) == deciding)
    }

    /// Cables with the greatest force in a decided sample, each with its share of these samples, most frequent first.
    pub fn hardest_pulled_cables(&self) -> Vec<(usize, f64)> {
        let all = self.decided().map(|sample| sample.finest()).filter(|run| run.force > 0.0);
        let counts: BTreeMap<usize, usize> = all.map(|run| run.cable).counts().into_iter().collect();
        let total = self.decided().count() as f64;
        let mut cables: Vec<_> =
            counts.into_iter().map(|(cable, count)| (cable, count as f64 / total)).collect();
        sort_by(&mut cables, |a, b| b.1.total_cmp(&a.1));
        cables
    }

    /// The tire that reaches the [`deciding_value`](Self::deciding_value) of the height. It is seldom the tire of the planned shot.
    pub fn deciding_tire(&self) -> Option<usize> {
        self.deciding_value(Quantity::Height)?;
        self.deciding_by(Quantity::Height).map(|sample| sample.finest().tire)
    }

    /// The cables that are pulled hardest in some decided sample, each with its greatest force there [N], greatest first. Samples
    /// above the [`deciding_value`](Self::deciding_value) are left out. The first cable is seldom the cable of the planned shot.
    pub fn deciding_cables(&self) -> Option<Vec<(usize, f64)>> {
        let most = self.deciding_value(Quantity::Force)?;
        let runs = self.decided().map(|sample| sample.finest());
        let runs = runs.filter(|run| run.force > 0.0 && run.force <= most);
        let forces =
            runs.map(|run| (run.cable, run.force)).into_grouping_map().fold(0.0, |a, _, b| f64::max(a, b));
        Some(sorted_by(forces, |a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0))))
    }

    /// Number of the sample that decides. The decided samples are sorted by utilization. The accepted share at the top is left out,
    /// and the next sample decides; of equal samples the first. `None` without a decided sample.
    pub fn deciding_sample(&self) -> Option<usize> {
        let mut decided: Vec<(f64, usize)> = self.decided().map(|s| (self.share(s), s.number)).collect();
        sort_by(&mut decided, |a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        decided.get(self.left_out()).or(decided.last()).map(|&(_, number)| number)
    }

    /// Greatest utilization of all samples, with the accepted share at the top left out. An undecided sample may have any
    /// utilization, so it counts as infinite, like a broken cable.
    pub fn deciding_utilization(&self) -> f64 {
        let undecided = repeat_n(f64::INFINITY, self.samples.len() - self.decided().count());
        let mut shares: Vec<f64> = self.decided().map(|sample| self.share(sample)).chain(undecided).collect();
        shares.sort_by(f64::total_cmp);
        shares.into_iter().nth_back(self.left_out()).unwrap_or(f64::INFINITY)
    }

    /// Number of samples that the accepted share leaves out.
    fn left_out(&self) -> usize {
        left_out(self.bounds.accepted, self.samples.len())
    }

    /// Number of decided samples that the accepted share leaves out. Undecided samples may be worse, so they are left out first.
    fn left_out_of_decided(&self) -> usize {
        self.left_out().saturating_sub(self.samples.len() - self.decided().count())
    }

    /// Utilization of a sample.
    fn share(&self, sample: &Sample) -> f64 {
        self.limits.utilization(|quantity| self.value(sample.finest(), quantity))
    }

    /// The 5th, 50th and 95th percentile and the greatest value of a quantity over the decided samples; `None` for fewer than
    /// [`SAMPLES_FOR_BANDS`]. All values come from runs at the step of samples. The finer runs of the audit count for the verdict
    /// alone.
    pub fn band(&self, quantity: Quantity) -> Option<[f64; 4]> {
        let values = self.decided().map(|sample| sample.run.get(quantity));
        (self.decided().count() >= SAMPLES_FOR_BANDS).then(|| percentiles(values, [0.05, 0.5, 0.95, 1.0]))?
    }
}

/// Values below which these shares of `values` lie; `None` without a value.
pub(in crate::study) fn percentiles<const N: usize>(
    values: impl Iterator<Item = f64>,
    shares: [f64; N],
) -> Option<[f64; N]> {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    let value_below = |share: f64| sorted[((share * sorted.len() as f64).ceil() as usize).max(1) - 1];
    (!sorted.is_empty()).then(|| shares.map(value_below))
}

/// Whether changes lie to one side beyond chance, by their signs and ranks (Wilcoxon 1945). Nine large,
/// alike changes of ten lie to one side, even if the tenth, a small one, does not.
fn lies_to_one_side(changes: &[f64]) -> bool {
    let mut changes: Vec<f64> = changes.iter().copied().filter(|&change| change != 0.0).collect();
    sort_by(&mut changes, |a, b| a.abs().total_cmp(&b.abs()));
    let ranks = changes.iter().enumerate().map(|(n, change)| change.signum() * (n + 1) as f64);
    let count = changes.len() as f64;
    let deviation = (count * (count + 1.0) * (2.0 * count + 1.0) / 6.0).sqrt();
    ranks.sum::<f64>().abs() > SIGNIFICANT_DEVIATIONS * deviation
}

/// Whether one side has more changes than by chance: `more` samples change to one side, `fewer` to the other.
fn sign_test_rejects(more: usize, fewer: usize) -> bool {
    let all = (more + fewer) as f64;
    let mut term = (-all * std::f64::consts::LN_2).exp();
    let mut tail = 0.0;
    for k in 0..=more.min(fewer) {
        tail += term;
        term *= (all - k as f64) / (k as f64 + 1.0);
    }
    2.0 * tail < SIGNIFICANCE
}

/// Number of samples that the accepted share leaves out.
pub fn left_out(accepted: f64, samples: usize) -> usize {
    (accepted * samples as f64 + 1e-9) as usize
}

#[cfg(test)]
mod tests {
    use super::super::random_shot::Input;
    use super::*;
    use crate::plan::PlanSource;

    /// Of n changes, half are expected to each side. 8 of 8 have a probability of 2/256, and 7 of 7 of 2/128; 10 of 11 of 24/2048,
    /// and 11 of 12 of 26/4096; 12 of 14 of 212/16384, 13 of 15 of 242/32768, and 15 of 18 of 1976/262144.
    #[test]
    fn an_audit_differs_only_beyond_chance() {
        assert!(
            !sign_test_rejects(0, 0)
                && !sign_test_rejects(7, 0)
                && sign_test_rejects(8, 0)
                && sign_test_rejects(0, 8)
        );
        assert!(!sign_test_rejects(10, 1) && sign_test_rejects(11, 1));
        assert!(!sign_test_rejects(12, 2) && sign_test_rejects(2, 13) && sign_test_rejects(15, 3));
    }

    /// With n changes of one sign the rank sum is n (n + 1)/2: for 8 it is 36, or 2.52 deviations of 14.28; for 9 it is 45, or 2.67
    /// of 16.88.
    #[test]
    fn changes_lie_to_one_side_only_beyond_chance() {
        let alike = |count: usize| (0..count).map(|n| 0.03 + 1e-4 * n as f64).collect::<Vec<_>>();
        assert!(!lies_to_one_side(&[]) && !lies_to_one_side(&alike(8)) && lies_to_one_side(&alike(9)));
        let with_one = |odd: f64| [alike(9), vec![odd]].concat();
        assert!(lies_to_one_side(&with_one(-0.01)) && !lies_to_one_side(&with_one(-0.1)));
        let both: Vec<f64> = (0..100).map(|n| if n % 2 == 0 { 0.01 } else { -0.01 }).collect();
        assert!(!lies_to_one_side(&both));
    }

    /// A hundred samples fail, and all of them pass at the finer step. The bounds on the way are the bounds of the finer runs. A
    /// run in which nothing is pulled has no deciding cable.
    #[test]
    fn the_finer_run_counts_on_the_way_too_and_no_cable_is_pulled_by_nothing() {
        let case = crate::study::as_planned::shot_reason::tests::case();
        let mut sampled = SampledShot::new(&case, None, ErrorShare::Whole, true);
        let mut halfway = [0.0; 2];
        for number in 0..100 {
            let pass = SampleRun { verdict: Verdict::Pass, force: 0.0, ..SampleRun::FAILED_RUN };
            let fail = SampleRun { verdict: Verdict::Fail, ..pass };
            sampled.push(Sample { number, run: fail, finer: Some(pass), inputs: [1.0; Input::ALL.len()] });
            if number == 49 {
                halfway = sampled.bounds.interval;
            }
        }
        assert!(sampled.bounds.interval[1] < halfway[1] && halfway[1] < 0.1);
        assert_eq!(sampled.bounds_after(&[50, 100]), [halfway, sampled.bounds.interval]);
        assert_eq!(sampled.deciding_cables(), Some(Vec::new()));
    }

    /// Undecided samples may be worse than all decided samples. Five samples may be worse than the deciding sample; three of them
    /// are undecided.
    #[test]
    fn undecided_samples_are_left_out_first() {
        let mut case = crate::study::as_planned::shot_reason::tests::case();
        case.limits.accepted_risk = 0.05;
        let mut sampled = SampledShot::new(&case, None, ErrorShare::Whole, true);
        for number in 0..100 {
            let decided =
                SampleRun { verdict: Verdict::Pass, height: number as f64, ..SampleRun::FAILED_RUN };
            let run = if number < 3 { SampleRun::FAILED_RUN } else { decided };
            sampled.push(Sample { number, run, finer: None, inputs: [1.0; Input::ALL.len()] });
        }
        assert_eq!(sampled.bounds.undecided, 3, "a test that can fail");
        assert_eq!(sampled.deciding_sample_by(Quantity::Height), Some(97));
    }

    /// Samples at 0.98 of the limit are 1.2 % higher at the finer step. Twice 1.2 % exceeds the limit, though no sample changes its
    /// verdict. Twice 0.8 % does not. A tenth of the error, or the error once, would pass both.
    #[test]
    fn an_error_to_one_side_counts_twice() {
        let text = include_str!("../../../plans/paper-5-tire.toml").to_owned();
        let source = PlanSource { path: std::path::PathBuf::new(), text };
        let case = Case::parse(source).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let finer_runs_disagree = |change: f64| {
            let mut sampled = SampledShot::new(&case, None, ErrorShare::Whole, true);
            for number in 0..600 {
                // No two changes are alike.
                let finer = 1.0 + change * (1.0 + 1e-4 * number as f64);
                let [run, finer] = [1.0, finer].map(|factor| SampleRun {
                    verdict: Verdict::Pass,
                    uncovering: 0.0,
                    breaks: Verdict::Pass,
                    height: 0.98 * factor * case.limits.height,
                    force: 1.0,
                    tire: 0,
                    cable: 0,
                    drift: 0.0,
                });
                let finer = (number % 20 == 0).then_some(finer);
                sampled.push(Sample { number, run, finer, inputs: [1.0; Input::ALL.len()] });
            }
            assert_eq!(sampled.bounds.verdict(), Verdict::Pass);
            (sampled.finer_runs_disagree(), sampled.verdict())
        };
        assert_eq!(finer_runs_disagree(0.012), (true, Verdict::Undecided));
        assert_eq!(finer_runs_disagree(0.008), (false, Verdict::Pass));
    }
}
