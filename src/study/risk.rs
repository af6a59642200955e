//! How likely a shot fails when what is not known varies as `[uncertainty]` says.
//!
//! A sample is run once, at a coarse step: its error falls to both sides of a limit, and the failure probability is far more
//! exact than any one sample. An audit runs one sample in [`AUDIT_EVERY`] again at a finer step; where that, or the shot as
//! planned, contradicts the samples, the shot is sampled anew at half the step. Samples are drawn in rounds over all shots, until the
//! bounds of the failure probability ([`Confidence`]) tell on which side of the accepted risk each shot lies.

use serde::{Deserialize, Serialize};

use super::batch::each;
use super::confidence::Confidence;
use super::draw::{Drawn, Input, draw};
use super::envelope::or_infinite;
use super::reason::{Reason, find_reasons};
use super::{Case, ComputeSettings, Envelope, NoResult, Progress, Shard, guarded};
use crate::choice::{Accuracy, Method};
use crate::outcome::Peak;
use crate::scene::{Scene, Shot};
use crate::verdict::{Estimate, Limits, Verdict};

/// Number of samples of each shot, and their seed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sampling {
    /// Least number of samples of each shot.
    pub least: usize,
    /// Greatest number of samples of each shot.
    pub most: usize,
    /// Seed of the random numbers.
    pub seed: u64,
}

impl Sampling {
    /// The sampling of a verdict: enough for the shares of the inputs, and more until the verdict is sure.
    pub const OF_VERDICT: Self = Self { least: FOR_SHARES, most: 2000, seed: 1 };
}

/// One sample of a shot.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    /// Number of the sample, from 0.
    pub number: usize,
    /// Whether it keeps every limit; undecided where the run ends too early, fails, or loses energy.
    pub verdict: Verdict,
    /// The same sample at a finer step, for a sample of the audit.
    pub finer: Option<Finer>,
    /// Fail where a cable breaks; undecided where the sample is, and none broke.
    pub breaks: Verdict,
    /// Greatest flight height [m].
    #[serde(deserialize_with = "or_infinite")]
    pub height: f64,
    /// Greatest cable force, of a cable of the plan's breaking force [N].
    #[serde(deserialize_with = "or_infinite")]
    pub force: f64,
    /// Greatest drift at the end [m].
    #[serde(deserialize_with = "or_infinite")]
    pub drift: f64,
    /// Values of the inputs in [`Input::ALL`].
    pub inputs: [f64; Input::ALL.len()],
}

/// A sample at the finer step of the audit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Finer {
    /// Whether it keeps every limit.
    pub verdict: Verdict,
    /// Greatest flight height [m].
    #[serde(deserialize_with = "or_infinite")]
    pub height: f64,
    /// Greatest cable force [N].
    #[serde(deserialize_with = "or_infinite")]
    pub force: f64,
    /// Greatest drift at the end [m].
    #[serde(deserialize_with = "or_infinite")]
    pub drift: f64,
}

impl Sample {
    /// Utilization of the sample.
    pub fn utilization(&self, limits: &Limits) -> f64 {
        limits.utilization(self.height, self.force, self.drift)
    }
}

/// One sample in so many is audited: 5 %.
const AUDIT_EVERY: usize = 20;
/// Step of a sample over the step of its audit.
const AUDIT_FINER: f64 = 4.0;
/// Factor on a difference to one side, because the audit has an error of its own.
const MOVED: f64 = 2.0;
/// Probability below which a difference between samples and audit is more than chance.
const CHANCE: f64 = 0.01;
/// Most times that a shot is sampled anew at half the step.
const MOST_HALVINGS: u32 = 3;
/// Samples needed for bands.
pub const FOR_BANDS: usize = 100;
/// Samples needed for the shares of the inputs.
pub const FOR_SHARES: usize = 200;

/// A shot whose risk is asked for.
#[derive(Clone, Copy, Debug)]
pub struct Target<'c> {
    /// The plan.
    pub case: &'c Case,
    /// The shot as planned.
    pub shot: &'c Shot,
    /// The shot as planned, judged by finer runs; `None` where it is not known.
    pub planned: Option<Envelope>,
    /// Method and accuracy.
    pub compute: ComputeSettings,
}

/// The samples of one shot, in order of their numbers, and what they tell.
#[derive(Clone, Debug, PartialEq)]
pub struct Risk {
    /// The samples.
    pub samples: Vec<Sample>,
    /// Bounds of the failure probability.
    pub confidence: Confidence,
    /// Bounds of the probability that a cable breaks.
    pub breaks: Confidence,
    /// Times that the step was halved because finer runs contradicted the samples.
    pub halvings: u32,
    planned: Option<Envelope>,
    limits: Limits,
}

impl Risk {
    /// No sample yet of a shot that was judged as `planned`; the plan of `case` names the accepted risk.
    pub fn new(case: &Case, planned: Option<Envelope>) -> Self {
        let accepted = case.plan.limits.accepted_risk_percent * 1e-2;
        let confidence = Confidence::new(accepted);
        Self {
            samples: Vec::new(),
            confidence,
            breaks: confidence,
            halvings: 0,
            planned,
            limits: case.limits,
        }
    }

    /// Takes the next sample; one of the audit counts as it is at the finer step.
    pub fn push(&mut self, sample: Sample) {
        self.confidence.push(sample.finer.map_or(sample.verdict, |finer| finer.verdict));
        self.breaks.push(sample.breaks);
        self.samples.push(sample);
    }

    /// The verdict of the samples; undecided where finer runs contradict them.
    pub fn verdict(&self) -> Verdict {
        if self.is_contradicted() { Verdict::Undecided } else { self.confidence.verdict() }
    }

    /// Whether finer runs contradict the samples: those of the audit beyond chance, or the shot as planned.
    pub fn is_contradicted(&self) -> bool {
        self.audit_differs() || self.is_biased() || self.falls_short()
    }

    /// Whether the shot as planned, which is refined, lies so far above every sample that samples moved up by twice as much
    /// would go past a limit, though they pass: the error of their step is then greater than what is not known.
    pub fn falls_short(&self) -> bool {
        let Some(planned) = self.planned else { return false };
        let refined = [planned.height, planned.force, planned.drift].map(|of| of.value);
        let would_fail = |((of, limit), refined): ((Quantity, f64), f64)| {
            let greatest = self.decided().map(of).fold(0.0, f64::max);
            refined > greatest && 2.0 * refined - greatest > limit
        };
        let passes = self.confidence.verdict() == Verdict::Pass;
        passes && quantities(&self.limits).into_iter().zip(refined).any(would_fail)
    }

    /// Whether the samples of the audit fail more often or less often at the finer step, beyond chance: a sign test on those
    /// that change (McNemar 1947).
    fn audit_differs(&self) -> bool {
        let count = |more: bool| {
            let audited = self.audited().map(|(sample, finer)| (sample.verdict, finer.verdict));
            let changed =
                audited.filter(|(coarse, fine)| (*coarse == Verdict::Pass) != (*fine == Verdict::Pass));
            changed.filter(|(_, fine)| (*fine != Verdict::Pass) == more).count()
        };
        differs(count(true), count(false))
    }

    fn decided(&self) -> impl Iterator<Item = &Sample> {
        self.samples.iter().filter(|sample| sample.verdict != Verdict::Undecided)
    }

    fn audited(&self) -> impl Iterator<Item = (&Sample, &Finer)> {
        self.samples.iter().filter_map(|sample| Some((sample, sample.finer.as_ref()?)))
    }

    /// Whether values at the finer step lie to one side, by a sign test, and so far that the samples, moved by [`MOVED`] times
    /// the mean difference, lie on the other side of the accepted risk. Where little is unknown, all samples have the same error
    /// of the step, and none of them may change its verdict.
    fn is_biased(&self) -> bool {
        let moved = [
            self.moved_by(|sample| sample.height, |finer| finer.height),
            self.moved_by(|sample| sample.force, |finer| finer.force),
            self.moved_by(|sample| sample.drift, |finer| finer.drift),
        ];
        let fails = |sample: &&Sample| {
            let drift = self.limits.drift.is_some_and(|limit| sample.drift * moved[2] > limit);
            sample.height * moved[0] > self.limits.height
                || sample.force * moved[1] > self.limits.force
                || drift
        };
        let share = self.samples.iter().filter(fails).count() as f64 / self.samples.len().max(1) as f64;
        match self.confidence.verdict() {
            Verdict::Pass => share > self.confidence.accepted,
            Verdict::Fail => moved != [1.0; 3] && share < self.confidence.accepted,
            Verdict::Undecided => false,
        }
    }

    /// Factor by which a quantity is to be moved: 1, unless the finer values lie to one side beyond chance.
    fn moved_by(&self, coarse: Quantity, fine: fn(&Finer) -> f64) -> f64 {
        let pairs = self.audited().map(|(sample, finer)| fine(finer) / coarse(sample) - 1.0);
        let changes: Vec<f64> = pairs.filter(|change| change.is_finite()).collect();
        let count =
            |more: bool| changes.iter().filter(|&&change| change != 0.0 && (change > 0.0) == more).count();
        let is_one_sided = differs(count(true), count(false));
        if is_one_sided { 1.0 + MOVED * changes.iter().sum::<f64>() / changes.len() as f64 } else { 1.0 }
    }

    /// The 5th, 50th and 95th percentile and the greatest of a value over the decided samples; `None` for fewer than
    /// [`FOR_BANDS`].
    pub fn band(&self, of: impl Fn(&Sample) -> f64) -> Option<[f64; 4]> {
        let enough = self.decided().count() >= FOR_BANDS;
        enough.then(|| percentiles(self.decided().map(of), [0.05, 0.5, 0.95, 1.0]))?
    }
}

/// Values below which these shares of `values` lie; `None` without a value.
pub(super) fn percentiles<const N: usize>(
    values: impl Iterator<Item = f64>,
    shares: [f64; N],
) -> Option<[f64; N]> {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    let at = |share: f64| sorted[((share * sorted.len() as f64).ceil() as usize).max(1) - 1];
    (!sorted.is_empty()).then(|| shares.map(at))
}

/// Whether of samples that change, `more` to one side and `fewer` to the other, one side has more than by chance.
fn differs(more: usize, fewer: usize) -> bool {
    let all = (more + fewer) as f64;
    let mut term = (-all * std::f64::consts::LN_2).exp();
    let mut tail = 0.0;
    for k in 0..=more.min(fewer) {
        tail += term;
        term *= (all - k as f64) / (k as f64 + 1.0);
    }
    2.0 * tail < CHANCE
}

/// Draws and judges samples of every shot, until its risk is sure; `enough` says for the index of a shot that its least
/// number of samples will do. `watch` sees every shot after each of its rounds.
///
/// A shot has no more samples than the time sufficed for. Returns whether that was so.
pub fn sample(
    targets: &[Target<'_>],
    sampling: &Sampling,
    progress: &Progress,
    enough: impl Fn(usize) -> bool,
    watch: &mut dyn FnMut(usize, &Risk),
) -> Result<(Vec<Risk>, bool), NoResult> {
    let mut risks: Vec<Risk> = targets.iter().map(|target| Risk::new(target.case, target.planned)).collect();
    loop {
        let wanted = |n: usize, risk: &Risk| {
            let count = risk.samples.len();
            let open = !enough(n) && risk.confidence.verdict() == Verdict::Undecided;
            count < sampling.least || count < sampling.most && open
        };
        let round = |(n, risk): (usize, &Risk)| {
            let from = risk.samples.len();
            let to = (from + if from < FOR_SHARES { 50 } else { 100 }).min(sampling.most);
            let finer = 2.0_f64.powi(risk.halvings as i32);
            (from..to).map(move |number| (n, number, finer))
        };
        let open = risks.iter().enumerate().filter(|(n, risk)| wanted(*n, risk));
        let jobs: Vec<(usize, usize, f64)> = open.flat_map(round).collect();
        if jobs.is_empty() {
            return Ok((risks, false));
        }
        let drawn = each(&jobs, progress, |&(n, number, finer)| {
            guarded(|| run_sample(&targets[n], sampling.seed, number, finer, progress))
        })?;
        let partial = drawn.contains(&None);
        let mut complete = vec![true; targets.len()];
        for (&(n, ..), sample) in jobs.iter().zip(drawn) {
            // Samples are counted in order, so that a result is that of so many samples.
            complete[n] &= sample.is_some();
            if let Some(sample) = sample.filter(|_| complete[n]) {
                risks[n].push(sample);
            }
        }
        for n in jobs.iter().map(|&(n, ..)| n).collect::<std::collections::BTreeSet<_>>() {
            let risk = &mut risks[n];
            let Target { case, planned, compute, .. } = targets[n];
            if risk.is_contradicted() && risk.halvings < MOST_HALVINGS && compute.step.is_none() {
                *risk = Risk { halvings: risk.halvings + 1, ..Risk::new(case, planned) };
            }
            watch(n, risk);
        }
        if partial {
            return Ok((risks, true));
        }
    }
}

/// Draws and judges the samples of every shot that belong to `shard`; `None` for those that the time did not suffice for.
pub fn sample_share(
    targets: &[Target<'_>],
    sampling: &Sampling,
    shard: Shard,
    progress: &Progress,
) -> Result<Vec<(usize, Option<Sample>)>, NoResult> {
    let all = itertools::iproduct!(0..targets.len(), 0..sampling.most);
    let jobs: Vec<(usize, usize)> = all.filter(|&(_, number)| shard.has(number)).collect();
    let drawn = each(&jobs, progress, |&(n, number)| {
        guarded(|| run_sample(&targets[n], sampling.seed, number, 1.0, progress))
    })?;
    Ok(jobs.into_iter().map(|(n, _)| n).zip(drawn).collect())
}

/// Step of a sample [s]: the fixed step, or a fraction of the critical step of its own scene, and at most the step that
/// resolves a landing.
fn step(compute: &ComputeSettings, scene: &Scene) -> f64 {
    let level = if compute.accuracy == Accuracy::Reference { 0.25 } else { 1.0 };
    let implicit = if compute.method == Method::Newmark { 0.25 } else { 1.0 };
    compute.step.unwrap_or(implicit * level * 2e-3_f64.min(0.55 * scene.critical_step()))
}

/// Draws one sample and runs it, at a step shorter by the factor `finer`.
fn run_sample(
    target: &Target<'_>,
    seed: u64,
    number: usize,
    finer: f64,
    progress: &Progress,
) -> Result<Sample, NoResult> {
    let Target { case, shot, compute, .. } = *target;
    let Drawn { scene, shot, inputs } = draw(case, shot, seed, number);
    let step = step(&compute, &scene) / finer;
    let judged = |step: f64| {
        let settings = case.settings(compute.method, step);
        match case.model.run_variant(&scene, &shot, &settings, &mut |_| progress.flow()) {
            Ok(outcome) => {
                let exact = |Peak { value, at, index }| Estimate { value, error: 0.0, at, index };
                let values = [outcome.height, outcome.force, outcome.drift];
                let reasons = find_reasons(case, &shot, &outcome, values.map(exact));
                let verdict = Verdict::worst(reasons.iter().map(Reason::verdict));
                let leaks = reasons.iter().any(|reason| matches!(reason, Reason::EnergyResidual(_)));
                // A run without energy balance shows nothing.
                let verdict = if leaks { Verdict::Undecided } else { verdict };
                let broke = !outcome.broken.is_empty() || outcome.force.value > case.limits.breaking_force;
                let breaks = match verdict {
                    Verdict::Undecided => Verdict::Undecided,
                    _ if broke => Verdict::Fail,
                    _ => Verdict::Pass,
                };
                Ok((verdict, leaks, breaks, values.map(|peak| peak.value)))
            }
            Err(failure) => match progress.no_result(failure) {
                NoResult::Failed(_) => Ok((Verdict::Undecided, true, Verdict::Undecided, [f64::INFINITY; 3])),
                ended => Err(ended),
            },
        }
    };
    let fixed = compute.step.is_some();
    let mut result = judged(step)?;
    if result.1 && !fixed {
        result = judged(step / AUDIT_FINER)?;
    }
    let (verdict, _, breaks, [height, force, drift]) = result;
    let audited = number % AUDIT_EVERY == AUDIT_EVERY / 2 && !fixed;
    let finer = |(verdict, _, _, [height, force, drift]): (Verdict, bool, Verdict, [f64; 3])| Finer {
        verdict,
        height,
        force,
        drift,
    };
    let finer = if audited { Some(finer(judged(step / AUDIT_FINER)?)) } else { None };
    Ok(Sample { number, verdict, finer, breaks, height, force, drift, inputs })
}

/// Share of each input in the variance of the quantity nearest its limit, largest first; `None` for fewer than
/// [`FOR_SHARES`] samples. What is missing to 1 comes from hole by hole and from the interplay of inputs.
pub fn shares(risk: &Risk, limits: &Limits) -> Option<Vec<(Input, f64)>> {
    let nearest = nearest_its_limit(risk, limits)?;
    let values: Vec<f64> = risk.decided().map(nearest).collect();
    if values.len() < FOR_SHARES || values.iter().any(|value| !value.is_finite()) {
        return None;
    }
    let share = |(n, input): (usize, Input)| {
        let of: Vec<f64> = risk.decided().map(|sample| sample.inputs[n]).collect();
        (input, share_of_variance(&of, &values))
    };
    let mut shares: Vec<_> = Input::ALL.into_iter().enumerate().map(share).collect();
    shares.sort_by(|a, b| b.1.total_cmp(&a.1));
    Some(shares)
}

/// A quantity of a sample.
type Quantity = fn(&Sample) -> f64;

/// Height, force and drift, each with its limit.
fn quantities(limits: &Limits) -> [(Quantity, f64); 3] {
    [
        (|sample| sample.height, limits.height),
        (|sample| sample.force, limits.force),
        (|sample| sample.drift, limits.drift.unwrap_or(f64::INFINITY)),
    ]
}

/// The quantity whose 95th percentile is the greatest share of its limit.
fn nearest_its_limit(risk: &Risk, limits: &Limits) -> Option<Quantity> {
    let mut nearest: Option<(f64, Quantity)> = None;
    for (of, limit) in quantities(limits) {
        let [_, _, high, _] = risk.band(of)?;
        if nearest.is_none_or(|(most, _)| high / limit > most) {
            nearest = Some((high / limit, of));
        }
    }
    nearest.map(|(_, of)| of)
}

/// Share of the variance of `values` that `input` alone explains: the variance between bins of equal count, less what bins
/// of random values would show (the ε² of Kelley 1935).
fn share_of_variance(input: &[f64], values: &[f64]) -> f64 {
    let n = values.len();
    let bins = ((n as f64).sqrt() as usize).min(20);
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&a, &b| input[a].total_cmp(&input[b]));
    if input[order[0]] == input[order[n - 1]] {
        return 0.0;
    }
    let mean = |of: &[usize]| of.iter().map(|&i| values[i]).sum::<f64>() / of.len() as f64;
    let whole = mean(&order);
    let total: f64 = values.iter().map(|value| (value - whole).powi(2)).sum();
    let bin = |b: usize| &order[b * n / bins..(b + 1) * n / bins];
    let between: f64 = (0..bins).map(|b| bin(b).len() as f64 * (mean(bin(b)) - whole).powi(2)).sum();
    if total <= 0.0 {
        return 0.0;
    }
    let within = (total - between) / (n - bins) as f64;
    ((between - (bins - 1) as f64 * within) / total).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    /// Of n changes, half are expected to each side: 8 of 8 have a probability of 2/256, 7 of 7 of 2/128; 10 of 11 one of
    /// 24/2048, 11 of 12 one of 26/4096.
    #[test]
    fn an_audit_differs_only_beyond_chance() {
        assert!(!differs(0, 0) && !differs(7, 0) && differs(8, 0) && differs(0, 8));
        assert!(!differs(10, 1) && differs(11, 1));
    }

    /// y = 3 a + 4 b + c with three even variables of one variance: shares of 9/26, 16/26 and 1/26, each within four
    /// standard errors of 4,000 draws (0.05); an input without effect has none.
    #[test]
    fn shares_are_those_of_a_sum() {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let draws: Vec<[f64; 4]> = (0..4000).map(|_| random.random()).collect();
        let y: Vec<f64> = draws.iter().map(|[a, b, c, _]| 3.0 * a + 4.0 * b + c).collect();
        for (n, exact) in [9.0 / 26.0, 16.0 / 26.0, 1.0 / 26.0, 0.0].into_iter().enumerate() {
            let input: Vec<f64> = draws.iter().map(|draw| draw[n]).collect();
            let share = share_of_variance(&input, &y);
            assert!((share - exact).abs() < 0.05, "{n}: {share}");
        }
        assert_eq!(share_of_variance(&vec![0.5; 4000], &y), 0.0, "an input known exactly");
    }

    /// The bias of bins is removed: of 200 values without any relation, bins of equal count alone would explain 7 %.
    #[test]
    fn inputs_without_effect_have_no_share() {
        let mut random = ChaCha8Rng::seed_from_u64(2);
        let share = |random: &mut ChaCha8Rng| {
            let mut numbers = || (0..200).map(|_| random.random::<f64>()).collect::<Vec<_>>();
            share_of_variance(&numbers(), &numbers())
        };
        let mean = (0..200).map(|_| share(&mut random)).sum::<f64>() / 200.0;
        assert!(mean < 0.02, "{mean}");
    }
}
