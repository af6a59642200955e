//! All delay options of one plan or of several, judged in parallel.

use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};

use super::deciding_shot::{DecidingShot, deciding_sample};
use super::grounds::Evidence;
use super::judgement::Judgement;
use super::next_tires::judge_next_tires;
use super::one_dud::judge_one_dud;
use crate::study::as_planned::check::{CheckProgress, CheckedShot, check_as_planned};
use crate::study::as_planned::margin::{LaunchMargin, launch_margin};
use crate::study::samples::risk_summary::RiskSummary;
use crate::study::samples::sample_count::Sampling;
use crate::study::samples::sample_until_sure::{ShotToSample, sample_shots_watched};
use crate::study::samples::sampled_shot::SampledShot;
use crate::study::work::batch::run_batch;
use crate::study::{ComputeResult, Computed, Context, NoResult, ShotSummary, StudyControl, catch_panic};
use crate::verdict::Verdict;

/// Results of the options of one plan, in their order (`n_options`).
pub type OptionResults = Vec<Result<Judgement, NoResult>>;

/// An option of one of several cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CaseOption {
    /// Index of the case.
    pub case: usize,
    /// Index of the option in its plan.
    pub option: usize,
}

/// What becomes known of an option while all are judged, in this order.
#[derive(Clone, Copy, Debug)]
pub enum JudgeEvent<'r> {
    /// A run of the shot as planned has gone on by [`STEPS_PER_EVENT`] steps.
    Checking(CheckProgress),
    /// The shot as planned is checked, or has no result.
    Checked(&'r Result<CheckedShot, NoResult>),
    /// A round of samples was drawn.
    Sampled {
        /// The shot with its samples so far.
        sampled: &'r SampledShot,
        /// Whether more samples come.
        more: bool,
    },
    /// The sample that decides has run.
    Deciding(&'r DecidingShot),
    /// The launch margin is known.
    Margin(LaunchMargin),
    /// The option is judged with any one hole left out.
    Dud(&'r Judgement),
    /// Fresh draws confirm a pass, or do not.
    Confirmed(&'r RiskSummary),
}

/// Steps of a run between two events.
const STEPS_PER_EVENT: usize = 64;

/// Share of a judgement that the shots as planned take; the samples take the rest.
const SHARE_AS_PLANNED: f64 = 0.1;

/// Sees events, on the threads that compute.
pub type OnEvent<'w> = &'w (dyn Fn(CaseOption, JudgeEvent<'_>) + Sync);

/// Sees nothing.
pub const UNWATCHED: OnEvent<'static> = &|_, _| {};

impl Context<'_> {
    /// The risk of every delay option, as planned and by samples, and with one dud where the plan asks for it. Nothing is recommended,
    /// and nothing confirmed.
    pub fn sample_options(&self) -> ComputeResult<OptionResults> {
        let Computed { mut value, mut partial } = judge_all(&[*self], UNWATCHED)?;
        if let Some(sampling) = self.sampling.filter(|_| self.case.plan.limits.withstands_one_dud) {
            partial |= find_duds(&[*self], &mut value, &sampling, self.control, UNWATCHED)?.partial;
        }
        Ok(Computed { value: value.remove(0), partial })
    }
}

/// Judges every option of every case: first all shots as planned, then, where a `sampling` is given, how likely they fail.
/// Returns the results by case; an option that the time did not suffice for has the result [`NoResult::OutOfTime`]. The contexts are
/// those of one study: they share sampling and control.
pub fn judge_all(contexts: &[Context<'_>], watch: OnEvent<'_>) -> ComputeResult<Vec<OptionResults>> {
    let Some(&Context { sampling, control, .. }) = contexts.first() else {
        return Ok(Computed::complete(Vec::new()));
    };
    let of_case =
        |case: usize| (0..contexts[case].case.shots.len()).map(move |option| CaseOption { case, option });
    let options: Vec<CaseOption> = (0..contexts.len()).flat_map(of_case).collect();
    let as_planned = control.part(if sampling.is_some() { SHARE_AS_PLANNED } else { 1.0 });
    let all = run_batch(&options, control, |&at| {
        let checked = catch_panic(|| check_one_as_planned(&contexts[at.case], at, watch));
        watch(at, JudgeEvent::Checked(&checked));
        match checked {
            Err(ended @ (NoResult::Stopped | NoResult::OutOfTime)) => Err(ended),
            // An option without a result is no reason for the others to have none.
            result => Ok(result),
        }
    })?;
    drop(as_planned);
    let mut partial = all.iter().any(Option::is_none);
    let mut results: Vec<OptionResults> = vec![Vec::new(); contexts.len()];
    for (at, checked) in options.into_iter().zip(all) {
        let checked = checked.unwrap_or(Err(NoResult::OutOfTime));
        results[at.case].push(checked.map(Judgement::of_planned_alone));
    }
    if let Some(sampling) = &sampling {
        let _samples = control.part(1.0);
        partial |= add_risks(contexts, &mut results, sampling, control, watch)?.partial;
    }
    Ok(Computed { value: results, partial })
}

fn check_one_as_planned(
    &Context { case, compute, control, .. }: &Context<'_>,
    at: CaseOption,
    watch: OnEvent<'_>,
) -> Result<CheckedShot, NoResult> {
    let mut steps = 0_usize;
    let checked = check_as_planned(case, at.option, &compute, &mut |progress| {
        steps += 1;
        if steps.is_multiple_of(STEPS_PER_EVENT) {
            watch(at, JudgeEvent::Checking(progress));
        }
        control.keep_going()
    });
    checked.map_err(|failure| control.no_result(failure))
}

/// The options that are checked as planned.
fn checked_options(results: &mut [OptionResults]) -> Vec<(CaseOption, &mut Judgement)> {
    let of_case = |(case, results)| {
        let options = <OptionResults as AsMut<[_]>>::as_mut(results).iter_mut().enumerate();
        options.filter_map(move |(option, result)| Some((CaseOption { case, option }, result.as_mut().ok()?)))
    };
    results.iter_mut().enumerate().flat_map(of_case).collect()
}

/// Samples the options that are checked as planned.
fn add_risks(
    contexts: &[Context<'_>],
    results: &mut [OptionResults],
    sampling: &Sampling,
    control: &StudyControl,
    watch: OnEvent<'_>,
) -> ComputeResult<()> {
    let mut judged = checked_options(results);
    let target = |(at, judgement): &(CaseOption, &mut Judgement)| {
        shot_to_sample(&contexts[at.case], at.option, &ShotSummary::of(&judgement.checked), sampling)
    };
    let targets: Vec<ShotToSample<'_>> = judged.iter().map(target).collect();
    let mut watch_round = |n: usize, sampled: &SampledShot| {
        watch(judged[n].0, JudgeEvent::Sampled { sampled, more: true });
        ControlFlow::Continue(())
    };
    let Computed { value: sampled_shots, partial } =
        sample_shots_watched(&targets, control, &mut watch_round)?;
    for ((at, judgement), sampled) in judged.iter_mut().zip(sampled_shots) {
        watch(*at, JudgeEvent::Sampled { sampled: &sampled, more: false });
        judgement.sampled = Evidence::of(sampled);
    }
    Ok(Computed { value: (), partial })
}

/// An option to be sampled, checked as `planned`; one that fails is sampled only to show by how much.
fn shot_to_sample<'c>(
    context: &Context<'c>,
    option: usize,
    planned: &ShotSummary,
    sampling: &Sampling,
) -> ShotToSample<'c> {
    let &Context { case, compute, .. } = context;
    let fails = planned.verdict == Verdict::Fail;
    let sampling = if fails { sampling.least_only() } else { *sampling };
    ShotToSample::new(case, &case.shots[option], compute, sampling).with_planned(*planned)
}

/// Runs the shot that decides of every option that was sampled with `seed`, one run each. An option whose run fails has none.
pub fn find_deciding_shots(
    contexts: &[Context<'_>],
    results: &mut [OptionResults],
    seed: u64,
    control: &StudyControl,
    watch: OnEvent<'_>,
) -> ComputeResult<()> {
    let judged = checked_options(results).into_iter().filter_map(|(at, judgement)| {
        let sample = deciding_sample(judgement.sampled.known()?, seed)?;
        Some(((at, sample), judgement))
    });
    let (jobs, judgements): (Vec<_>, Vec<_>) = judged.unzip();
    let runs = run_batch(&jobs, control, |&(at, sample)| {
        match catch_panic(|| DecidingShot::run(&contexts[at.case], at.option, sample)) {
            // The verdicts stand without it.
            Err(NoResult::Failed(_) | NoResult::Panicked(_)) => Ok(None),
            run => run.map(Some).inspect(|run| {
                run.iter().for_each(|run| watch(at, JudgeEvent::Deciding(run)));
            }),
        }
    })?;
    let partial = runs.contains(&None);
    for (judgement, run) in judgements.into_iter().zip(runs) {
        judgement.deciding = run.flatten();
    }
    Ok(Computed { value: (), partial })
}

/// Finds the launch margin of every option of every case that has a result.
pub fn find_launch_margins(
    contexts: &[Context<'_>],
    results: &mut [OptionResults],
    control: &StudyControl,
    watch: OnEvent<'_>,
) -> ComputeResult<()> {
    let judged = checked_options(results);
    let jobs: Vec<_> = judged.iter().map(|(at, judgement)| (*at, judgement.checked.verdict)).collect();
    let margins = run_batch(&jobs, control, |&(at, as_planned)| {
        let context = &contexts[at.case];
        match catch_panic(|| launch_margin(context, &context.case.shots[at.option], as_planned)) {
            // The verdicts stand without it.
            Err(NoResult::Panicked(_)) => Ok(None),
            margin => margin.map(Some).inspect(|margin| {
                margin.iter().for_each(|&margin| watch(at, JudgeEvent::Margin(margin)));
            }),
        }
    })?;
    let partial = margins.contains(&None);
    for ((_, judgement), margin) in judged.into_iter().zip(margins) {
        judgement.launch_margin = margin.flatten();
    }
    Ok(Computed { value: (), partial })
}

/// Judges every option that is checked with any one hole left out, and with the next tire over holes between two.
pub fn find_duds(
    contexts: &[Context<'_>],
    results: &mut [OptionResults],
    sampling: &Sampling,
    control: &StudyControl,
    watch: OnEvent<'_>,
) -> ComputeResult<()> {
    let judged = checked_options(results);
    // What fails already fails with duds, too, however often: its duds are checked as planned, not sampled.
    let options: Vec<(CaseOption, bool)> = judged
        .iter()
        .map(|(at, judgement)| (*at, judgement.grounds().before_confirmation() == Verdict::Fail))
        .collect();
    let found = run_batch(&options, control, |&(at, fails)| {
        let context = &contexts[at.case];
        let &Context { case, .. } = context;
        let is_sampled = case.plan.limits.withstands_one_dud && !fails;
        let (shot, sampling) = (&case.shots[at.option], is_sampled.then_some(sampling));
        let both = catch_panic(|| {
            let one_dud = judge_one_dud(context, shot, sampling, fails)?;
            Ok((one_dud, judge_next_tires(context, shot)?))
        });
        match both {
            Err(NoResult::Failed(_) | NoResult::Panicked(_)) => Ok((None, None)),
            found => found,
        }
    })?;
    // The jobs have batches of their own, which the end of the time leaves incomplete.
    let partial = control.expired() && !found.iter().all(|found| matches!(found, Some((Some(_), Some(_)))));
    for ((at, judgement), found) in judged.into_iter().zip(found) {
        let (one_dud, next_tires) = found.unwrap_or_default();
        if contexts[at.case].case.plan.limits.withstands_one_dud {
            let verdict = one_dud.map(|one_dud| one_dud.verdict());
            judgement.withstands_dud = verdict.map_or(Evidence::NoneDrawn, Evidence::Known);
        }
        judgement.one_dud = one_dud;
        judgement.next_tires = next_tires.unwrap_or_default();
        watch(at, JudgeEvent::Dud(judgement));
    }
    Ok(Computed { value: (), partial })
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
    let each = results.iter().map(|result| result.as_ref().map_or(Verdict::Undecided, Judgement::verdict));
    match must_pass {
        MustPass::Every => Verdict::worst(each),
        MustPass::One => each.min().unwrap_or(Verdict::Pass),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Plan;
    use crate::study::{Case, ComputeSettings};

    /// The time is up once the first of nine places of a dud is judged: what is missing then is told, and what is there is whole.
    #[test]
    fn duds_that_the_time_did_not_suffice_for_are_told() {
        let text = include_str!("../../../tests/fixtures/amur-three-rows.toml");
        let mut case = Case::new(Plan::parse("", text).unwrap_or_else(|mistakes| panic!("{mistakes}")));
        case.plan.delays.truncate(1);
        case.shots.truncate(1);
        let (compute, control) = (ComputeSettings::of(&case.plan), StudyControl::default());
        let context = Context::new(&case, compute, &control);
        let mut results = judge_all(&[context], UNWATCHED).expect("a result").value;
        let (before, _) = control.counts();
        let pool = crate::study::thread_pool(1).expect("a thread");
        let found = std::thread::scope(|scope| {
            scope.spawn(|| {
                while control.counts().0 == before {
                    std::thread::yield_now();
                }
                control.expire();
            });
            let duds = || find_duds(&[context], &mut results, &Sampling::OF_VERDICT, &control, UNWATCHED);
            pool.install(duds).expect("a result")
        });
        let judged = results[0][0].as_ref().expect("a result");
        assert_eq!(found.partial, judged.one_dud.is_none());
    }
}
