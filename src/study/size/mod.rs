//! Finds the lightest rope, tires and border with which a shelter holds.
//!
//! Each combination of rope, tire mass and border rows is a shelter of its own. A stiffer rope pulls harder. A heavier tire flies
//! lower and pulls longer. So one combination says nothing about another, with one exception: ropes of equal stiffness and mass
//! move the shelter alike. Then the stronger rope holds wherever the weaker rope holds. The strongest rope of each stiffness is
//! tried first. If it fails, the other ropes of that stiffness are not tried.
//!
//! Nobody knows how fast a tire of another mass leaves ([mass law](crate::plan::mass_law)). A combination with such tires must hold
//! at both ends of `launch_mass_exponent`. The written plan takes the worse end.
//!
//! A combination whose planned shots hold is a choice only if surely fewer of its sampled shots fail than accepted, and fresh draws
//! confirm it. From the lightest on, every combination with a smaller utilization than the choices before is sampled in this way.

mod size_candidate;

use std::cmp::Ordering;

use itertools::Itertools;
use serde::{Deserialize, Serialize};

use self::size_candidate::{ShotsToSample, SizeCandidate};
use super::cost::RUNS_OF_VERDICT;
use super::judge::grounds::{Evidence, Grounds};
use super::samples::sample_count::Sampling;
use super::standing::verdict_word::ThinPass;
use super::study_trait::{Listed, Study, Subject};
use super::work::study_control::Part;
use super::{Case, ComputeResult, Computed, Context, NoResult, ShotSummary};
use crate::plan::{HoleTiming, Layout, Plan, SizeSpec, Time, edit};
use crate::ropes::{Rope, catalogue};
use crate::sorting::{sort_by, sorted_by, sorted_by_key};
use crate::verdict::Verdict;

/// The shots that a shelter must hold.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Demand {
    /// Delay options of the plan, by their indices.
    Options(Vec<usize>),
    /// Every order of the blast rows (at most [`MOST_ROWS`](super::orders::MOST_ROWS)) at each of these intervals. The holes of
    /// each row fire by this timing.
    AnyOrder(Vec<Time>, HoleTiming),
}

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
    /// Result of its trial, or why there was none.
    pub trial: Result<Trial, Untried>,
}

impl Combination {
    /// The text of the plan of `case` with this combination, or why that text has no place for it.
    pub fn written(&self, case: &Case) -> Result<String, String> {
        let Self { rope, tire_mass, border_rows, .. } = self;
        edit::write_sizes(&case.source.text, &case.plan, &rope.name, *tire_mass, *border_rows)
            .map_err(|error| error.to_string())
    }
}

/// Why a combination was not tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Untried {
    /// A stronger rope of the same stiffness does not hold.
    StrongerRopeDoesNotHold,
    /// The time ran out.
    OutOfTime,
    /// A run failed.
    RunFailed,
}

/// Result of trying a combination.
#[derive(Clone, Copy, Debug)]
pub struct Trial {
    /// Whether every planned shot passes.
    pub holds: bool,
    /// The worst verdict, and the greatest value of each quantity, of all checked shots. If the combination does not hold, shots
    /// that were not checked may be worse.
    pub worst: ShotSummary,
    /// Utilization: the greatest value over its limit.
    pub utilization: f64,
    /// Number of shots checked.
    pub shots: usize,
    /// Samples of the worst shot; `None` if none were drawn.
    pub risk: Option<WorstShotRisk>,
    /// The evidence for the verdict on its shots; `None` if the combination was not examined further.
    pub grounds: Option<Grounds>,
    /// What ends its pass, if it is the lightest choice and its pass is thin.
    pub thin: Option<ThinPass>,
}

/// Samples of the worst shot of a combination: the worst verdict counts first, then the greatest failing share, then the greatest
/// upper bound.
#[derive(Clone, Copy, Debug)]
pub struct WorstShotRisk {
    /// The verdict of the samples.
    pub verdict: Verdict,
    /// Number of samples.
    pub samples: usize,
    /// Number of samples that failed.
    pub failures: usize,
    /// Upper bound of the failure probability.
    pub failure_upper_bound: f64,
}

impl Trial {
    /// The verdict on its shots, from all requested evidence; `None` if the combination was not examined further.
    pub fn verdict(&self) -> Option<Verdict> {
        self.grounds.map(|grounds| grounds.verdict())
    }

    /// Whether it is a choice: it holds, the risk of its shots passes, and its utilization is smaller than that of every lighter
    /// choice. Other combinations are not examined further.
    pub fn is_acceptable(&self) -> bool {
        self.verdict() == Some(Verdict::Pass)
    }
}

impl WorstShotRisk {
    /// The samples of no shot.
    const NONE: Self = Self { verdict: Verdict::Pass, samples: 0, failures: 0, failure_upper_bound: 0.0 };

    fn compare(&self, other: &Self) -> Ordering {
        let share = |sampled: &Self| sampled.failures as f64 / sampled.samples.max(1) as f64;
        let by_share = share(self).total_cmp(&share(other));
        let by_bound = self.failure_upper_bound.total_cmp(&other.failure_upper_bound);
        self.verdict.cmp(&other.verdict).then(by_share).then(by_bound)
    }
}

/// Result of sizing.
#[derive(Clone, Debug)]
pub struct Sizing {
    /// All combinations, lightest first.
    pub combinations: Vec<Combination>,
    /// Whether the launch velocity is an estimate that nobody observed. Then no combination is a choice.
    pub launch_is_estimated: bool,
}

impl Sizing {
    /// The verdict: pass if the lightest choice is known, fail if no combination is a choice. It is open while combinations are
    /// untried, because the time ran out or a run failed: a lighter combination may be a choice.
    pub fn verdict(&self) -> Verdict {
        let holds = |combination: &Combination| combination.trial.is_ok_and(|trial| trial.holds);
        let would_be_one = self.launch_is_estimated && self.combinations.iter().any(holds);
        let may_be_one =
            would_be_one || self.count_with_risk(Verdict::Undecided) > 0 || self.is_open_as_planned();
        let is_open = self.is_incomplete() || self.lightest_choice().is_none() && may_be_one;
        match self.lightest_choice() {
            _ if is_open => Verdict::Undecided,
            Some(_) => Verdict::Pass,
            None => Verdict::Fail,
        }
    }

    /// Whether untried combinations may be a choice.
    pub fn is_incomplete(&self) -> bool {
        self.count_untried(Untried::OutOfTime) > 0 || self.count_untried(Untried::RunFailed) > 0
    }

    /// The lightest choice; of equally light choices the one with the weakest rope.
    pub fn lightest_choice(&self) -> Option<&Combination> {
        self.choices().next()
    }

    /// All choices, lightest first.
    pub fn choices(&self) -> impl Iterator<Item = &Combination> {
        self.combinations.iter().filter(|c| c.trial.is_ok_and(|trial| trial.is_acceptable()))
    }

    /// Whether any combination was judged by samples, too.
    pub fn is_sampled(&self) -> bool {
        self.combinations.iter().any(|c| c.trial.is_ok_and(|trial| trial.risk.is_some()))
    }

    /// Number of combinations that were tried.
    pub fn count_tried(&self) -> usize {
        self.combinations.iter().filter(|c| c.trial.is_ok()).count()
    }

    /// Number of combinations whose planned shots hold, and whose risk has this verdict.
    pub fn count_with_risk(&self, verdict: Verdict) -> usize {
        let has = |c: &&Combination| {
            c.trial.is_ok_and(|trial| trial.risk.is_some() && trial.verdict() == Some(verdict))
        };
        self.combinations.iter().filter(has).count()
    }

    /// Whether the planned shots of a combination stay undecided.
    pub fn is_open_as_planned(&self) -> bool {
        let is_open = |c: &Combination| c.trial.is_ok_and(|trial| trial.worst.verdict == Verdict::Undecided);
        self.combinations.iter().any(is_open)
    }

    /// Number of combinations that were not tried for the reason `why`.
    pub fn count_untried(&self, why: Untried) -> usize {
        self.combinations.iter().filter(|c| c.trial.is_err_and(|untried| untried == why)).count()
    }
}

/// The task for every combination.
#[derive(Clone, Copy)]
struct SizingTask<'q> {
    plan: &'q Plan,
    demand: &'q Demand,
    context: &'q Context<'q>,
}

/// Share of sizing with samples that the planned shots take.
const SHARE_AS_PLANNED: f64 = 0.3;

/// The part of the work for one of `left` equal pieces. It reduces `left` by one.
fn next_part<'q>(task: &SizingTask<'q>, left: &mut usize) -> Part<'q> {
    *left = left.saturating_sub(1);
    task.context.control.part(1.0 / (*left + 1) as f64)
}

/// The question: which is the lightest shelter that holds?
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Question {
    /// What may be chosen.
    pub choices: SizeSpec,
    /// What the shelter must hold.
    pub demand: Demand,
}

/// Runs that each shot of a combination takes, in runs of a sample; and usual number of combinations with samples. Measured on the
/// plans of examples.
const RUNS_OF_COMBINATION: usize = 30;
const COMBINATIONS_SAMPLED: usize = 6;

impl Study for Question {
    type Found = Sizing;
    const LISTED: Option<Listed> = Some(Listed {
        name: "Size",
        question: "Lightest shelter?",
        about: "What is the lightest rope, tire and border with which every option passes?",
        tells: "the lightest rope, tires and border that still pass",
    });

    fn expected_runs(case: &Case) -> Option<usize> {
        let size = &case.plan.size;
        let borders = if matches!(case.plan.layout, Layout::List { .. }) { 0 } else { size.most_border_rows };
        let ropes = catalogue().ropes.iter();
        let ropes = ropes.filter(|rope| size.family.as_ref().is_none_or(|family| *family == rope.family));
        let combinations = ropes.count() * size.tire_mass_kg.len().max(1) * (borders + 1);
        Some(combinations * case.shots.len() * RUNS_OF_COMBINATION + COMBINATIONS_SAMPLED * RUNS_OF_VERDICT)
    }

    fn usual(case: &Case, _about: Subject) -> Self {
        let demand = Demand::Options((0..case.shots.len()).collect());
        Self { choices: case.plan.size.clone(), demand }
    }

    fn answer(&self, context: &Context<'_>) -> ComputeResult<Sizing> {
        size(context, &self.choices, &self.demand)
    }
}

/// Tries the combinations that `choices` allow, with ropes that the termination of the plan fits, until the time is up. Without
/// samples only the planned shots count.
pub fn size(context: &Context<'_>, choices: &SizeSpec, demand: &Demand) -> ComputeResult<Sizing> {
    let &Context { case, sampling, control, .. } = context;
    let plan = &Plan { size: choices.clone(), ..case.plan.clone() };
    let task = SizingTask { plan, demand, context };
    control.has_steps(if sampling.is_some() { 2 } else { 1 });
    let trying = control.part(if sampling.is_some() { SHARE_AS_PLANNED } else { 1.0 });
    let mut tried = try_all(&task)?;
    drop(trying);
    sort_by(&mut tried, |(a, _), (b, _)| {
        let strength = |c: &Combination| c.rope.breaking_force_kn;
        a.total_mass.total_cmp(&b.total_mass).then(strength(a).total_cmp(&strength(b)))
    });
    let _choosing = control.part(1.0);
    choose(&task, &mut tried)?;
    let sizing = Sizing {
        combinations: tried.into_iter().map(|(combination, _)| combination).collect(),
        launch_is_estimated: plan.uncertainty.launch_is_estimated(),
    };
    let partial = sizing.count_untried(Untried::OutOfTime) > 0;
    Ok(Computed { value: sizing, partial })
}

/// Tries every combination with its planned shots.
fn try_all(task: &SizingTask<'_>) -> Result<Vec<(Combination, ShotsToSample)>, NoResult> {
    let plan = task.plan;
    let own_mass = [plan.tire.mass_kg];
    let masses = if plan.size.tire_mass_kg.is_empty() { &own_mass[..] } else { &plan.size.tire_mass_kg };
    let most_border = if matches!(plan.layout, Layout::List { .. }) { 0 } else { plan.size.most_border_rows };
    let mut tried = Vec::new();
    // Index of the shot at which the last combination failed. The next combination likely fails at it, too.
    let mut last_failed = 0;
    let groups = ropes_by_stiffness(plan);
    let mut left = groups.len() * masses.len() * (most_border + 1);
    for (ropes, &tire_mass, border_rows) in itertools::iproduct!(groups, masses, 0..=most_border) {
        let _group = next_part(task, &mut left);
        let mut stronger_holds = true;
        for rope in ropes {
            let candidate = SizeCandidate::new(task, rope, tire_mass, border_rows);
            let (mut hardest, mut trial) = (ShotsToSample::new(), Err(Untried::StrongerRopeDoesNotHold));
            if task.context.control.expired() {
                trial = Err(Untried::OutOfTime);
            } else if stronger_holds {
                match candidate.try_as_planned(&mut last_failed) {
                    Ok(Some((made, shots))) => (trial, hardest) = (Ok(made), shots),
                    Ok(None) => trial = Err(Untried::OutOfTime),
                    Err(NoResult::Failed(_)) => trial = Err(Untried::RunFailed),
                    Err(ended) => return Err(ended),
                }
            }
            // A run that fails says nothing about weaker ropes.
            stronger_holds = match trial {
                Ok(trial) => trial.holds,
                Err(why) => why != Untried::StrongerRopeDoesNotHold,
            };
            let combination = candidate.combination(trial);
            if let Ok(trial) = trial {
                let (control, mass) = (task.context.control, combination.total_mass);
                control.note_tried(mass, trial.utilization);
                control.note_found(if trial.holds { mass } else { f64::NAN }, || {
                    format!("{} as planned", rope.name)
                });
            }
            tried.push((combination, hardest));
        }
    }
    Ok(tried)
}

/// Ropes that the plan allows and its termination fits. Ropes of equal stiffness and mass form a group, strongest first.
fn ropes_by_stiffness(plan: &Plan) -> Vec<Vec<&'static Rope>> {
    let own_rope = plan.cable.rope.as_ref().and_then(|name| catalogue().find(name));
    let wanted = plan.size.family.as_ref().or(own_rope.map(|rope| &rope.family));
    let of_family = |rope: &&Rope| wanted.is_none_or(|family| *family == rope.family);
    let termination = plan.cable.termination.as_ref().and_then(|name| catalogue().termination(name));
    let fits = |rope: &&Rope| termination.is_none_or(|termination| termination.fits.contains(&rope.kind));
    let ropes = catalogue().ropes.iter().filter(of_family).filter(fits);
    // The bit patterns of positive numbers sort like the numbers.
    let stiffness = |rope: &&Rope| (rope.axial_stiffness_kn.to_bits(), rope.mass_kg_per_m.to_bits());
    let strongest_first = |a: &&Rope, b: &&Rope| b.breaking_force_kn.total_cmp(&a.breaking_force_kn);
    let groups = sorted_by_key(ropes.into_group_map_by(stiffness), |(stiffness, _)| *stiffness);
    groups.into_iter().map(|(_, ropes)| sorted_by(ropes, strongest_first)).collect()
}

/// Judges the shots of a combination whose planned shots hold, the hardest first: by samples, if these pass with one dud, then by
/// fresh draws. `None` if the time was up.
fn judge(
    candidate: &SizeCandidate<'_>,
    shots: &ShotsToSample,
    mut grounds: Grounds,
    sampling: &Sampling,
    confirmations: &mut usize,
) -> Result<Option<(WorstShotRisk, Grounds)>, NoResult> {
    let mut worst = WorstShotRisk::NONE;
    for part in candidate.hardest_and_rest(shots).into_iter().filter(|part| !part.is_empty()) {
        let Some(risk) = candidate.sample(&part, &Sampling { least: 0, ..*sampling })? else {
            return Ok(None);
        };
        worst = if worst.compare(&risk) == Ordering::Greater { worst } else { risk };
        grounds.samples = Evidence::Known(worst.verdict);
        if worst.verdict == Verdict::Pass {
            let Some(one_dud) = candidate.withstands_one_dud(&part, sampling)? else { return Ok(None) };
            grounds.one_dud = one_dud;
        }
        if grounds.verdict() != Verdict::Pass {
            return Ok(Some((worst, grounds)));
        }
    }
    if grounds.verdict() == Verdict::Pass {
        *confirmations += 1;
        let fresh = sampling.for_confirmation(*confirmations);
        let Some(confirmed) = candidate.confirm(shots, &fresh)? else { return Ok(None) };
        grounds.confirmation = Evidence::Known(confirmed);
    }
    Ok(Some((worst, grounds)))
}

/// Marks the choices among combinations that are sorted by mass. It samples the combinations that could be a choice, and confirms
/// those that pass.
fn choose(task: &SizingTask<'_>, tried: &mut [(Combination, ShotsToSample)]) -> Result<(), NoResult> {
    let (mut least, mut confirmations) = (f64::INFINITY, 0);
    let launch_is_estimated = task.plan.uncertainty.launch_is_estimated();
    let holding = |combination: &Combination| combination.trial.is_ok_and(|trial| trial.holds);
    let mut left = tried.iter().filter(|(combination, _)| holding(combination)).count();
    for (combination, hardest) in tried {
        let Ok(mut trial) = combination.trial else { continue };
        if !trial.holds {
            continue;
        }
        let _one = next_part(task, &mut left);
        if trial.utilization >= least {
            continue;
        }
        task.context.control.note_trying(combination.rope.name.clone());
        let grounds = Grounds {
            planned: Verdict::Pass,
            launch_is_estimated,
            samples: Evidence::NotAsked,
            one_dud: Evidence::NotAsked,
            confirmation: Evidence::NotAsked,
        };
        trial.grounds = Some(grounds);
        if let Some(sampling) = task.context.sampling {
            let Combination { rope, tire_mass, border_rows, .. } = *combination;
            let candidate = SizeCandidate::new(task, rope, tire_mass, border_rows);
            let Some((risk, judged)) = judge(&candidate, hardest, grounds, &sampling, &mut confirmations)?
            else {
                combination.trial = Err(Untried::OutOfTime);
                continue;
            };
            (trial.risk, trial.grounds) = (Some(risk), Some(judged));
            if least == f64::INFINITY && trial.is_acceptable() {
                trial.thin = candidate.thin(hardest)?;
            }
        }
        if trial.is_acceptable() {
            least = trial.utilization;
        }
        combination.trial = Ok(trial);
    }
    Ok(())
}
