//! The nearest changes of a plan with which a delay option that does not pass would pass.
//!
//! 1. Candidates come by kind (interval, rope, termination, ballast, slack, launches), the smallest change first. Each is written into the
//!    text of the plan, and the plan of the new text is judged. So a user who writes the change gets exactly this plan.
//! 2. All candidates are judged coarsely, as planned. Those that surely fail are dropped. A candidate is thin if slightly faster launches
//!    end its pass. Thin candidates go behind the others of their kind.
//! 3. Of each kind, the first candidate left is judged like in `check`: as planned, then by the samples of a verdict, then by fresh draws
//!    ([`recommend`](super::judge::recommend)). If that is no PASS, the next candidate follows. The first PASS is offered.
//!
//! A candidate gets no more samples once too many failed for a PASS. This never offers a wrong change, because a PASS has all samples of
//! `check`.

mod candidates;
mod hard_samples;

use std::cmp::Ordering;
use std::collections::{BTreeMap, VecDeque};

use serde::{Deserialize, Serialize};

use self::candidates::find_candidates;
use self::hard_samples::{HardDrawn, HardSamples};
use super::as_planned::check::{CheckedShot, check_as_planned};
use super::as_planned::margin::{THIN_LAUNCH, launch_margin};
use super::as_planned::quick_check::{quick_check, quick_or_whole_check};
use super::as_planned::shot_reason::exceeds_together;
use super::judge::Judgement;
use super::judge::OptionResults;
use super::judge::confirm::confirm_shots;
use super::judge::grounds::Evidence;
use super::judge::one_dud::{judge_one_dud, withstands_one_dud};
use super::samples::run_sample::ShotToSample;
use super::samples::sample_until_sure::sample_shots;
use super::samples::sampled_shot::SampledShot;
use super::standing::verdict_word::{ThinPass, if_known};
use super::study_trait::{Study, Subject};
use super::work::batch::run_batch;
use super::{Case, ComputeResult, Computed, Context, NoResult, ShotSummary, StudyControl, catch_panic};
use crate::plan::PlanSource;
use crate::plan::edit::change::{Change, ChangeKind};
use crate::sorting::{sort_by_key, sorted_by};
use crate::verdict::Verdict;

/// The changes tried for one delay option, by kind. Kinds without a candidate are left out.
#[derive(Clone, Debug)]
pub struct Remedies {
    /// Index of the option.
    pub option: usize,
    /// Whether enough samples are allowed for a pass. If not, nothing was tried.
    pub enough_samples: bool,
    /// One entry for each kind.
    pub kinds: Vec<TriedKind>,
}

impl Remedies {
    /// The changes with which the option passes, at most one of each kind. Lower launches come last, because no plan makes them. Thin
    /// changes come before these. Otherwise the order is by the share of shots that fails, then by cost.
    pub fn passing(&self) -> impl Iterator<Item = &Remedy> {
        let rank = |remedy: &&Remedy| {
            let is_thin = ThinPass::of_planned(&remedy.judgement).is_some();
            let is_launch = remedy.change.kind() == ChangeKind::Launch;
            (is_launch, is_thin, remedy.judgement.failing_share().unwrap_or(0.0))
        };
        let passing = self.kinds.iter().filter_map(|tried| tried.passing.as_ref());
        sorted_by(passing, |a, b| rank(a).partial_cmp(&rank(b)).unwrap_or(Ordering::Equal)).into_iter()
    }
}

/// The changes of one kind that were tried for one option.
#[derive(Clone, Debug)]
pub struct TriedKind {
    /// The kind.
    pub kind: ChangeKind,
    /// The changes tried, the smallest first.
    pub tried: Vec<Change>,
    /// Number of changes that neither pass nor surely fail.
    pub undecided: usize,
    /// Whether the time was up before a change passed or all were tried.
    pub out_of_time: bool,
    /// The change that passes: the smallest that is not thin as planned, or else the smallest.
    pub passing: Option<Remedy>,
}

/// A change with which an option passes.
#[derive(Clone, Debug)]
pub struct Remedy {
    /// The change.
    pub change: Change,
    /// The judgement of the option in the changed plan.
    pub judgement: Judgement,
}

/// Indices of the options that have a result and do not pass.
pub fn not_passing(results: &OptionResults) -> Vec<usize> {
    let judged =
        results.iter().enumerate().filter_map(|(option, result)| Some((option, result.as_ref().ok()?)));
    judged.filter(|(_, judged)| judged.verdict() != Verdict::Pass).map(|(option, _)| option).collect()
}

/// The changes of one kind for one option, while they are tried.
struct ChangesOfOneKind {
    option: usize,
    left: VecDeque<Change>,
    found: TriedKind,
}

impl ChangesOfOneKind {
    /// Whether there is a next change to judge.
    fn has_next(&self) -> bool {
        self.found.passing.is_none() && !self.found.out_of_time && !self.left.is_empty()
    }

    fn note(&mut self, verdict: Verdict) {
        self.found.undecided += usize::from(verdict == Verdict::Undecided);
    }
}

/// A change to judge in full.
struct ChangeToJudge {
    /// Index of its kind in the list of kinds.
    kind: usize,
    change: Change,
    case: Case,
}

impl ChangeToJudge {
    /// The change as offered, with the launch margin and the one dud that may make its pass thin.
    fn offered(&self, context: &Context<'_>, option: usize, passing: Judgement) -> Result<Remedy, NoResult> {
        let (context, shot) = (context.with_case(&self.case), &self.case.shots[option]);
        let launch_margin = if_known(|| launch_margin(&context, shot, passing.checked.verdict))?;
        let one_dud = if_known(|| judge_one_dud(&context, shot, None, false))?.flatten();
        Ok(Remedy { change: self.change, judgement: Judgement { launch_margin, one_dud, ..passing } })
    }
}

/// Factor on all launches that a pass bears if it is not thin: the first rise tried beyond [`THIN_LAUNCH`].
const ENDS_THIN_PASS: f64 = 1.0 + THIN_LAUNCH + 0.01;

/// Share of the coarse look at all changes in the work.
const SHARE_OF_SCREENING: f64 = 0.1;
/// Shares of the planned shots and of the samples in a round, each of the work left.
const SHARE_AS_PLANNED: f64 = 0.1;
const SHARE_OF_SAMPLES: f64 = 0.6;
/// Share of the samples that failed before in the work of the samples.
const SHARE_OF_HARD_SAMPLES: f64 = 0.2;

/// Which changes of the plan make one option pass.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Question {
    /// Index of the option.
    pub option: usize,
}

impl Study for Question {
    type Found = Remedies;

    fn usual(_case: &Case, about: Subject) -> Self {
        Self { option: about.option }
    }

    fn answer(&self, context: &Context<'_>) -> ComputeResult<Remedies> {
        let Computed { mut value, partial } = find_all_remedies(context, &[self.option])?;
        Ok(Computed { value: value.remove(0), partial })
    }
}

/// Tries changes for the options with these indices until the time is up. Without a `sampling` only the planned shots count.
pub fn find_all_remedies(context: &Context<'_>, options: &[usize]) -> ComputeResult<Vec<Remedies>> {
    let &Context { case, control, sampling, .. } = context;
    let mut hard = HardSamples::new(case.limits.accepted_risk, sampling.map_or(0, |sampling| sampling.most));
    let enough_samples = sampling.is_none() || hard.enough_samples();
    control.has_steps(2);
    let screening = control.part(SHARE_OF_SCREENING);
    let may_pass = enough_samples && !case.plan.uncertainty.launch_is_estimated();
    let mut kinds = if may_pass { screen_candidates(context, options)? } else { Vec::new() };
    drop(screening);
    let _judging = control.part(1.0);
    let mut confirmations = BTreeMap::new();
    while kinds.iter().any(ChangesOfOneKind::has_next) {
        let with_next = kinds.iter().filter(|kind| kind.has_next());
        let most_left = with_next.map(|kind| kind.left.len()).max().unwrap_or(0);
        // A kind ends at its first pass, so the last rounds rarely come.
        let _round = control.part(2.0 / (most_left + 1) as f64);
        judge_next(context, &mut kinds, &mut hard, &mut confirmations)?;
    }
    let partial = kinds.iter().any(|kind| kind.found.out_of_time);
    let mut remedies: Vec<Remedies> =
        options.iter().map(|&option| Remedies { option, enough_samples, kinds: Vec::new() }).collect();
    for ChangesOfOneKind { option, found: tried, .. } in kinds {
        if let Some(of_option) = remedies.iter_mut().find(|of_option| of_option.option == option) {
            of_option.kinds.push(tried);
        }
    }
    Ok(Computed { value: remedies, partial })
}

/// The plan with a change; `None` if the change makes no valid plan.
fn with_change(case: &Case, change: &Change) -> Option<Case> {
    let text = change.apply(&case.source.text).ok()?;
    Case::parse(PlanSource { path: case.source.path.clone(), text }).ok()
}

/// The kinds of all options, each with the candidates that do not surely fail a coarse run as planned. Candidates without a valid plan
/// count as not tried. A kind without a candidate is left out.
fn screen_candidates(context: &Context<'_>, options: &[usize]) -> Result<Vec<ChangesOfOneKind>, NoResult> {
    let &Context { case, control, .. } = context;
    let kinds = |&option: &usize| {
        let crowded = exceeds_together(case, &case.shots[option]);
        find_candidates(&case.plan, option, crowded).into_iter().map(move |changes| (option, changes))
    };
    let changes_by_option: Vec<(usize, Vec<Change>)> = options.iter().flat_map(kinds).collect();
    let jobs: Vec<(usize, Change)> = changes_by_option
        .iter()
        .flat_map(|(option, changes)| changes.iter().map(|&change| (*option, change)))
        .collect();
    let mut verdicts = run_batch(&jobs, control, |(option, change)| {
        let Some(changed) = with_change(case, change) else { return Ok(None) };
        let (changed_context, shot) = (context.with_case(&changed), &changed.shots[*option]);
        let verdict = |found: Result<ShotSummary, NoResult>| match found {
            // The full judgement will show.
            Err(NoResult::Failed(_) | NoResult::Panicked(_)) => Ok(Verdict::Undecided),
            found => Ok(found?.verdict),
        };
        let coarse = verdict(catch_panic(|| quick_check(&changed_context, shot)))?;
        let bears_faster = || {
            let faster = shot.with_launches(ENDS_THIN_PASS);
            Ok(verdict(catch_panic(|| quick_or_whole_check(&changed_context, &faster)))? == Verdict::Pass)
        };
        Ok(Some((coarse, coarse != Verdict::Fail && !bears_faster()?)))
    })?
    .into_iter();
    let mut kinds = Vec::new();
    for (option, changes) in changes_by_option {
        let kind = changes.first().map(Change::kind);
        let (mut tried, mut left, mut out_of_time) = (Vec::new(), Vec::new(), false);
        for (change, verdict) in changes.into_iter().zip(verdicts.by_ref()) {
            match verdict {
                None => out_of_time = true,
                Some(None) => {}
                Some(Some((verdict, is_thin))) => {
                    tried.push(change);
                    left.extend((verdict != Verdict::Fail).then_some((is_thin, change)));
                }
            }
        }
        sort_by_key(&mut left, |(is_thin, _)| *is_thin);
        let left = left.into_iter().map(|(_, change)| change).collect();
        if let Some(kind) = kind.filter(|_| out_of_time || !tried.is_empty()) {
            let found = TriedKind { kind, tried, undecided: 0, out_of_time, passing: None };
            kinds.push(ChangesOfOneKind { option, left, found });
        }
    }
    Ok(kinds)
}

/// Judges in full the next change of every kind that has one. `confirmations` counts the confirmations of each option, because all changes
/// for one option share the probability of an error.
fn judge_next(
    context: &Context<'_>,
    kinds: &mut [ChangesOfOneKind],
    hard: &mut HardSamples,
    confirmations: &mut BTreeMap<usize, usize>,
) -> Result<(), NoResult> {
    let mut to_judge = Vec::new();
    for (n, kind) in kinds.iter_mut().enumerate().filter(|(_, kind)| kind.has_next()) {
        let change = kind.left.pop_front();
        to_judge.extend(change.and_then(|change| {
            Some(ChangeToJudge { kind: n, change, case: with_change(context.case, &change)? })
        }));
    }
    let checking = context.control.part(SHARE_AS_PLANNED);
    let as_planned = check_changes(context, kinds, &to_judge)?;
    drop(checking);
    let passing = to_judge.iter().zip(as_planned).filter_map(|(next, checked)| Some((next, checked?)));
    let passing: Vec<(&ChangeToJudge, CheckedShot)> = passing.collect();
    let Some(sampling) = context.sampling else {
        for (next, checked) in passing {
            let kind = &mut kinds[next.kind];
            kind.found.passing =
                Some(next.offered(context, kind.option, Judgement::of_planned_alone(checked))?);
        }
        return Ok(());
    };
    let mut targets = Vec::with_capacity(passing.len());
    for (next, checked) in &passing {
        let option = kinds[next.kind].option;
        let target = ShotToSample::new(&next.case, &next.case.shots[option], context.compute, sampling);
        targets.push((option, target.with_planned(ShotSummary::of(checked)).only_pass()));
    }
    let sampling_changes = context.control.part(SHARE_OF_SAMPLES);
    let sampled_changes = sample(&targets, hard, context.control)?;
    drop(sampling_changes);
    let _confirming = context.control.part(1.0);
    let (mut to_confirm, mut fresh) = (Vec::new(), Vec::new());
    for (((next, checked), sampled), (option, target)) in passing.iter().zip(sampled_changes).zip(&targets) {
        let kind = &mut kinds[next.kind];
        match sampled {
            SampledChange::CannotPass => kind.note(Verdict::Undecided),
            SampledChange::OutOfTime => kind.found.out_of_time = true,
            SampledChange::Sampled(sampled) => {
                let planned = Judgement::of_planned_alone(checked.clone());
                let mut judgement = Judgement { sampled: Evidence::of(*sampled), ..planned };
                if judgement.verdict() == Verdict::Pass {
                    let changed = context.with_case(&next.case);
                    let shot = &next.case.shots[*option];
                    let Some(with_dud) = withstands_one_dud(&changed, shot, &sampling)? else {
                        kind.found.out_of_time = true;
                        continue;
                    };
                    judgement.withstands_dud = with_dud;
                }
                kind.note(judgement.verdict());
                if judgement.verdict() == Verdict::Pass {
                    let count = confirmations.entry(*option).or_insert(0);
                    *count += 1;
                    fresh.push(ShotToSample { sampling: sampling.for_confirmation(*count), ..*target });
                    to_confirm.push((*next, judgement));
                }
            }
        }
    }
    for ((next, judgement), drawn) in to_confirm.into_iter().zip(confirm_shots(&fresh, context.control)?) {
        let kind = &mut kinds[next.kind];
        let Some(drawn) = drawn else {
            kind.found.out_of_time = true;
            continue;
        };
        let judgement = Judgement { confirmation: Evidence::Known(drawn), ..judgement };
        kind.note(judgement.verdict());
        if judgement.verdict() == Verdict::Pass {
            kind.found.passing = Some(next.offered(context, kind.option, judgement)?);
        }
    }
    Ok(())
}

/// Checks changes as planned. Changes that do not pass give `None`, and their kinds note them.
fn check_changes(
    context: &Context<'_>,
    kinds: &mut [ChangesOfOneKind],
    to_judge: &[ChangeToJudge],
) -> Result<Vec<Option<CheckedShot>>, NoResult> {
    let options: Vec<usize> = to_judge.iter().map(|next| kinds[next.kind].option).collect();
    let jobs: Vec<(&Case, usize)> = to_judge.iter().map(|next| &next.case).zip(options).collect();
    let all = run_batch(&jobs, context.control, |(case, option)| {
        let check = || {
            let checked =
                check_as_planned(case, *option, &context.compute, &mut |_| context.control.keep_going());
            checked.map_err(|failure| context.control.no_result(failure))
        };
        match catch_panic(check) {
            Err(NoResult::Failed(_) | NoResult::Panicked(_)) => Ok(None),
            checked => checked.map(Some),
        }
    })?;
    let checked = to_judge.iter().zip(all).map(|(next, result)| {
        let kind = &mut kinds[next.kind];
        match result {
            None => kind.found.out_of_time = true,
            Some(None) => kind.note(Verdict::Undecided),
            Some(Some(checked)) if checked.verdict == Verdict::Pass => return Some(checked),
            Some(Some(checked)) => kind.note(checked.verdict),
        }
        None
    });
    Ok(checked.collect())
}

/// The samples of a change.
enum SampledChange {
    /// The hard samples fail so often that no pass can come.
    CannotPass,
    /// The time was up before the verdict was known.
    OutOfTime,
    /// All samples for the verdict.
    Sampled(Box<SampledShot>),
}

/// Draws the samples of changes, each for an option.
fn sample(
    targets: &[(usize, ShotToSample<'_>)],
    hard: &mut HardSamples,
    control: &StudyControl,
) -> Result<Vec<SampledChange>, NoResult> {
    let hard_samples = control.part(SHARE_OF_HARD_SAMPLES);
    let first = hard.run(targets, control)?;
    drop(hard_samples);
    let mut sampled_changes: Vec<SampledChange> = Vec::new();
    let (mut left, mut places) = (Vec::new(), Vec::new());
    for (n, ((_, target), first)) in targets.iter().zip(&first).enumerate() {
        sampled_changes.push(if first.is_some() {
            SampledChange::CannotPass
        } else {
            SampledChange::OutOfTime
        });
        if let Some(HardDrawn { samples, can_pass: true }) = first {
            left.push(target.with_precomputed(samples));
            places.push(n);
        }
    }
    for ((target, n), sampled) in left.iter().zip(places).zip(sample_shots(&left, control)?.value) {
        hard.note(targets[n].0, &sampled);
        let sampling = target.sampling;
        let is_complete = sampling.is_complete(&sampled) || !sampled.bounds.can_pass(sampling.most);
        sampled_changes[n] = match is_complete {
            true => SampledChange::Sampled(Box::new(sampled)),
            false => SampledChange::OutOfTime,
        };
    }
    Ok(sampled_changes)
}
