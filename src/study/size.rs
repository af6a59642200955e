//! The lightest rope, tires and border with which a shelter holds.
//!
//! Each combination of rope, tire mass and border rows is a shelter of its own. A stiffer rope pulls harder; a heavier tire
//! flies lower and pulls longer; so one combination says nothing about another, with one exception: ropes of equal
//! stiffness move the shelter alike, and the stronger rope holds wherever the weaker one holds. The strongest rope of each
//! stiffness is tried first. Where it fails, the other ropes of that stiffness are not tried.
//!
//! A combination that holds as planned is a choice only if surely fewer shots than accepted fail of those that `[uncertainty]`
//! describes. From the lightest on, every combination with more margin than the choices before is sampled so.

use itertools::Itertools;

use super::batch::judge_shots;
use super::failure_bounds::FailureBounds;
use super::sampling::{Sampling, ShotToSample, find_risks};
use super::{Bounded, Case, ComputeSettings, Envelope, Finding, Found, NoResult, Progress};
use crate::plan::{Layout, Plan};
use crate::ropes::{Rope, catalogue};
use crate::scene::Shot;
use crate::verdict::Verdict;

/// The shots that a shelter must hold.
#[derive(Clone, Debug, PartialEq)]
pub enum Demand {
    /// Delay options of the plan, by their indices.
    Options(Vec<usize>),
    /// Every order of the blast rows (at most [`MOST_ROWS`](super::orders::MOST_ROWS)) at each of these intervals [s].
    AnyOrder(Vec<f64>),
}

/// Number of orders, the hardest ones, that are sampled.
const HARDEST: usize = 8;
/// Number of shots judged together before a failure ends the trial. A fixed number: the shots judged do not depend on the
/// number of threads.
const AT_ONCE: usize = 32;

/// One combination of rope, tire mass and border rows.
#[derive(Clone, Debug)]
pub struct Combination {
    /// Rope of the catalogue.
    pub rope: &'static Rope,
    /// Mass of a tire [kg].
    pub tire_mass: f64,
    /// Rows of ballast on each side.
    pub border_rows: usize,
    /// Number of tires.
    pub tires: usize,
    /// Mass of all tires and cables [kg].
    pub total_mass: f64,
    /// Result of its trial, or why there was no trial.
    pub trial: Result<Trial, Untried>,
}

/// Why a combination was not tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Untried {
    /// A stronger rope of the same stiffness fails.
    SameStiffnessFails,
    /// The time did not suffice.
    OutOfTime,
    /// The step asked for is too long for this combination.
    Unstable,
}

/// Result of trying a combination.
#[derive(Clone, Copy, Debug)]
pub struct Trial {
    /// Whether the combination holds.
    pub holds: bool,
    /// The worst shot judged. Where the combination fails, shots that were not judged may be worse.
    pub worst: Envelope,
    /// Utilization of the worst shot: the greatest value over its limit.
    pub utilization: f64,
    /// Number of shots judged.
    pub shots: usize,
    /// What the samples tell; `None` where none were drawn.
    pub risk: Option<SampledRisk>,
}

impl Trial {
    /// Whether the combination is a choice: it holds, and its risk passes.
    pub fn is_choice(&self) -> bool {
        self.holds && self.risk.is_none_or(|risk| risk.verdict == Verdict::Pass)
    }
}

/// Samples of the shots of a combination, up to the first shot whose risk does not pass: those of the shot of which the greatest
/// share fails.
#[derive(Clone, Copy, Debug)]
pub struct SampledRisk {
    /// The verdict of the samples.
    pub verdict: Verdict,
    /// Number of samples.
    pub samples: usize,
    /// Number of those that failed.
    pub failures: usize,
}

/// Result of sizing.
#[derive(Clone, Debug)]
pub struct Sizing {
    /// All combinations, the lightest first.
    pub combinations: Vec<Combination>,
}

impl Sizing {
    /// The lightest choice; of equally light ones, that of the weakest rope.
    pub fn found(&self) -> Option<&Combination> {
        self.combinations.iter().find(|c| c.trial.is_ok_and(|trial| trial.is_choice()))
    }

    /// Choices with a smaller utilization than every lighter choice.
    pub fn frontier(&self) -> Vec<&Combination> {
        let mut least = f64::INFINITY;
        let better = |c: &&Combination| {
            let used = c.trial.ok().filter(Trial::is_choice).map(|trial| trial.utilization);
            let better = used.is_some_and(|used| used < least);
            least = used.unwrap_or(least).min(least);
            better
        };
        self.combinations.iter().filter(better).collect()
    }

    /// Number of combinations that were tried.
    pub fn tried(&self) -> usize {
        self.combinations.iter().filter(|c| c.trial.is_ok()).count()
    }

    /// Number of combinations that hold as planned, and whose risk has this verdict.
    pub fn with_risk(&self, verdict: Verdict) -> usize {
        let has = |c: &&Combination| {
            c.trial.is_ok_and(|trial| trial.risk.is_some_and(|risk| risk.verdict == verdict))
        };
        self.combinations.iter().filter(has).count()
    }

    /// Number of combinations that were not tried for reason `why`.
    pub fn untried(&self, why: Untried) -> usize {
        self.combinations.iter().filter(|c| c.trial.is_err_and(|untried| untried == why)).count()
    }
}

/// The shots that a combination is sampled with, hardest first: the index of each and what it is as planned.
type Hardest = Vec<(usize, Envelope)>;

/// Tries the combinations that the plan allows, of ropes that its termination fits, until the time is up. Without a `sampling`
/// only the shots as planned count.
pub fn size(
    plan: &Plan,
    demand: &Demand,
    sampling: Option<&Sampling>,
    compute: &ComputeSettings,
    progress: &Progress,
) -> Finding<Sizing> {
    let own_rope = plan.cable.rope.as_ref().and_then(|name| catalogue().find(name));
    let wanted = plan.size.family.as_ref().or(own_rope.map(|rope| &rope.family));
    let family = |rope: &&Rope| wanted.is_none_or(|family| *family == rope.family);
    let termination = plan.cable.termination.as_ref().and_then(|name| catalogue().termination(name));
    let fits = |rope: &&Rope| termination.is_none_or(|termination| termination.fits.contains(&rope.kind));
    let by_stiffness = catalogue()
        .ropes
        .iter()
        .filter(family)
        .filter(fits)
        .into_group_map_by(|rope| (rope.axial_stiffness_kn.to_bits(), rope.mass_kg_per_m.to_bits()));
    let own_mass = [plan.tire.mass_kg];
    let masses = if plan.size.tire_mass_kg.is_empty() { &own_mass[..] } else { &plan.size.tire_mass_kg };
    let most_border = if matches!(plan.layout, Layout::List { .. }) { 0 } else { plan.size.most_border_rows };
    let mut tried: Vec<(Combination, Hardest)> = Vec::new();
    // Index of the shot at which the last combination failed: the next combination likely fails at it, too.
    let mut likeliest = 0;
    // The bit patterns of positive numbers sort like the numbers.
    let stiffnesses = by_stiffness.into_iter().sorted_by_key(|(stiffness, _)| *stiffness);
    for ((_, ropes), &tire_mass, border_rows) in
        itertools::iproduct!(stiffnesses.collect_vec(), masses, 0..=most_border)
    {
        let ropes = ropes.into_iter().sorted_by(|a, b| b.breaking_force_kn.total_cmp(&a.breaking_force_kn));
        let mut held = true;
        for rope in ropes {
            let case = Case::new(plan.with(rope, tire_mass, border_rows));
            let (tires, total_mass) = (case.scene().mass.len(), total_mass(&case, rope));
            let mut hardest = Vec::new();
            let trial = if progress.expired() {
                Err(Untried::OutOfTime)
            } else if held {
                match try_out(&case, demand, compute, &mut likeliest, progress) {
                    Err(NoResult::Failed(_)) => Err(Untried::Unstable),
                    Err(ended) => return Err(ended),
                    Ok(None) => Err(Untried::OutOfTime),
                    Ok(Some((trial, shots))) => {
                        hardest = shots;
                        Ok(trial)
                    }
                }
            } else {
                Err(Untried::SameStiffnessFails)
            };
            // Weaker ropes of the same stiffness fail where this one fails; where it is not stable, they are not either.
            held = match trial {
                Ok(trial) => trial.holds,
                Err(why) => why != Untried::SameStiffnessFails,
            };
            let combination = Combination { rope, tire_mass, border_rows, tires, total_mass, trial };
            tried.push((combination, hardest));
        }
    }
    tried.sort_by(|(a, _), (b, _)| {
        let strength = |c: &Combination| c.rope.breaking_force_kn;
        a.total_mass.total_cmp(&b.total_mass).then(strength(a).total_cmp(&strength(b)))
    });
    let (mut least, mut attempt) = (f64::INFINITY, 0);
    for (combination, hardest) in &mut tried {
        if let Ok(trial) = combination.trial
            && trial.holds
            && trial.utilization < least
        {
            let case = Case::new(plan.with(combination.rope, combination.tire_mass, combination.border_rows));
            let mut trial = trial;
            if let Some(sampling) = sampling {
                attempt += 1;
                let shots = shots(&case, demand);
                trial.risk = sample_hardest(
                    &case,
                    hardest.iter().map(|&(n, planned)| (&shots[n], planned)),
                    &Sampling { least: 0, attempt, ..*sampling },
                    compute,
                    progress,
                )?;
                let complete = trial.risk.is_some();
                combination.trial = if complete { Ok(trial) } else { Err(Untried::OutOfTime) };
            }
            least = if combination.trial.is_ok() && trial.is_choice() { trial.utilization } else { least };
        }
    }
    let sizing = Sizing { combinations: tried.into_iter().map(|(combination, _)| combination).collect() };
    let partial = sizing.untried(Untried::OutOfTime) > 0;
    Ok(Found { value: sizing, partial })
}

fn total_mass(case: &Case, rope: &Rope) -> f64 {
    let scene = case.scene();
    let length: f64 = scene.cables.iter().map(|cable| cable.rest_length).sum();
    scene.mass.iter().sum::<f64>() + length * rope.mass_kg_per_m
}

/// Samples the shots of a case, each with what it is as planned, one after the other, until the risk of one does not pass;
/// `None` where the time was up.
fn sample_hardest<'s>(
    case: &Case,
    shots: impl Iterator<Item = (&'s Shot, Envelope)>,
    sampling: &Sampling,
    compute: &ComputeSettings,
    progress: &Progress,
) -> Result<Option<SampledRisk>, NoResult> {
    let mut worst = SampledRisk { verdict: Verdict::Pass, samples: 0, failures: 0 };
    for (shot, planned) in shots {
        let planned = Some(planned);
        let target =
            ShotToSample { case, shot, planned, compute: *compute, sampling: *sampling, precomputed: &[] };
        let Found { value: risks, partial } = find_risks(&[target], progress, &mut |_, _| {})?;
        if partial {
            return Ok(None);
        }
        let FailureBounds { samples, failures, .. } = risks[0].bounds;
        let share = |of: &SampledRisk| of.failures as f64 / of.samples.max(1) as f64;
        let here = SampledRisk { verdict: risks[0].verdict(), samples, failures };
        if here.verdict != Verdict::Pass {
            return Ok(Some(here));
        }
        if worst.samples == 0 || share(&here) > share(&worst) {
            worst = here;
        }
    }
    Ok(Some(worst))
}

/// The shots that the shelter of `case` must hold.
fn shots(case: &Case, demand: &Demand) -> Vec<Shot> {
    match demand {
        Demand::Options(options) => options.iter().map(|&option| case.shots[option].clone()).collect(),
        Demand::AnyOrder(intervals) => all_orders(case, intervals),
    }
}

/// Tries one combination.
fn try_out(
    case: &Case,
    demand: &Demand,
    compute: &ComputeSettings,
    likeliest: &mut usize,
    progress: &Progress,
) -> Result<Option<(Trial, Hardest)>, NoResult> {
    let shots = shots(case, demand);
    let mut order: Vec<usize> = (0..shots.len()).collect();
    if *likeliest < shots.len() {
        order.swap(0, *likeliest);
    }
    let mut judged: Vec<Envelope> = Vec::new();
    for chunk in order.chunks(AT_ONCE) {
        let part: Vec<Shot> = chunk.iter().map(|&n| shots[n].clone()).collect();
        let envelopes = judge_shots(case, &part, compute, progress)?;
        let Some(envelopes) = envelopes.into_iter().collect::<Option<Vec<_>>>() else { return Ok(None) };
        let failed = envelopes.iter().position(|envelope| envelope.verdict != Verdict::Pass);
        judged.extend(envelopes);
        if let Some(failed) = failed {
            *likeliest = chunk[failed];
            break;
        }
    }
    let trial = trial(case, &judged, judged.iter().all(|envelope| envelope.verdict == Verdict::Pass));
    let utilization = |n: usize| judged[n].utilization(&case.limits);
    let hardest = (0..judged.len()).sorted_by(|&a, &b| utilization(b).total_cmp(&utilization(a)));
    let most = if matches!(demand, Demand::Options(_)) { shots.len() } else { HARDEST };
    Ok(Some((trial, hardest.map(|n| (order[n], judged[n])).take(most).collect())))
}

fn all_orders(case: &Case, intervals: &[f64]) -> Vec<Shot> {
    let rows = case.plan.blast_rows.len();
    let orders = (0..rows).permutations(rows).collect_vec();
    itertools::iproduct!(intervals, &orders).map(|(&interval, order)| case.shot(order, interval)).collect()
}

fn trial(case: &Case, judged: &[Envelope], holds: bool) -> Trial {
    let zero = Bounded::default();
    let none = Envelope { verdict: Verdict::Pass, height: zero, force: zero, drift: zero };
    let share = |envelope: &Envelope| envelope.utilization(&case.limits);
    let worst = judged.iter().copied().max_by(|a, b| share(a).total_cmp(&share(b))).unwrap_or(none);
    Trial { holds, worst, utilization: share(&worst), shots: judged.len(), risk: None }
}
