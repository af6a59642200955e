//! Judges the delay options of one or several plans together. Each step of a judgement runs for all options in parallel.

use std::iter::repeat;
use std::ops::ControlFlow;

use itertools::Itertools;

use super::confirm::confirm_shots;
use super::deciding_shot::{DecidingSamples, DecidingShots};
use super::grounds::Evidence;
use super::judgement::{Judgement, OptionResults, Part};
use super::next_tires::judge_next_tires;
use super::one_dud::{expected_dud_samples, judge_one_dud};
use super::recommend::safest_first;
use super::turned::turned_height;
use crate::scene::Shot;
use crate::study::as_planned::check::{CheckProgress, CheckedShot, check_as_planned};
use crate::study::as_planned::margin::launch_margin;
use crate::study::samples::run_sample::ShotToSample;
use crate::study::samples::sample_count::Sampling;
use crate::study::samples::sample_until_sure::sample_shots_watched;
use crate::study::samples::sampled_shot::SampledShot;
use crate::study::work::batch::run_batch;
use crate::study::{
    Case, ComputeResult, Computed, Context, NoResult, ShotSummary, StudyControl, catch_panic,
};
use crate::verdict::Verdict;

/// An option of one of several cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CaseOption {
    /// Index of the case.
    pub case: usize,
    /// Index of the option in its plan.
    pub option: usize,
}

/// A step in the judgement of an option, in this order.
#[derive(Clone, Copy, Debug)]
pub enum JudgeEvent<'r> {
    /// A run of the planned shot has advanced by [`STEPS_PER_EVENT`] steps.
    Checking(CheckProgress),
    /// The planned shot is checked and the rest is still to come, or the option has no result.
    Checked(&'r Result<Judgement, NoResult>),
    /// A part of the judgement is known.
    Found(&'r Part),
}

/// Steps of a run between two events.
const STEPS_PER_EVENT: usize = 64;

/// Receives events on the threads that compute; `None` receives none.
pub type OnEvent<'w> = Option<&'w (dyn Fn(CaseOption, JudgeEvent<'_>) + Sync)>;

/// How far options are judged if samples are asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depth {
    /// The planned shots, their samples, and one dud if the plan makes that part of the verdict. No option is recommended or confirmed.
    Unconfirmed,
    /// What `check`, the page and the terminal show. This adds launch margins. If a plan has several options, it also adds fresh draws for
    /// those that pass.
    Full,
    /// The same for options that the program itself chose. A lone option is confirmed, too.
    Chosen,
}

impl Depth {
    /// The judgement of a checked planned shot. It awaits samples, and everything else that the plan and this depth ask for.
    pub fn begin(self, case: &Case, checked: CheckedShot) -> Judgement {
        let judged = Judgement {
            sampled: Evidence::Awaited,
            withstands_dud: Evidence::asked_if(case.plan.limits.withstands_one_dud),
            ..Judgement::of_planned_alone(checked)
        };
        self.begin_again(case, judged)
    }

    /// The same judgement after other options were added or deleted. Only the fresh draws depend on the other options, so they are awaited
    /// again. If fresh draws refused the shot or were asked for, that stays. So nobody makes an option pass by deleting the others.
    pub fn begin_again(self, case: &Case, judged: Judgement) -> Judgement {
        let confirms = match self {
            Depth::Unconfirmed => false,
            Depth::Full => case.shots.len() > 1 || judged.confirmation.is_asked(),
            Depth::Chosen => true,
        };
        let is_refused = judged.confirmation.known().is_some_and(|drawn| drawn.verdict != Verdict::Pass);
        let confirmation = if is_refused { judged.confirmation } else { Evidence::asked_if(confirms) };
        Judgement { confirmation, ..judged }
    }
}

impl Context<'_> {
    /// The risk of every delay option: as planned, by samples, and with one dud if the plan asks for that.
    pub fn sample_options(&self) -> ComputeResult<OptionResults> {
        self.judge(Depth::Unconfirmed)
    }

    /// Judges every delay option like `check`: as planned, and if samples are asked for, by samples and fresh draws. Without samples only
    /// the numbers of the plan count. Nothing varies then, not even the launches.
    pub fn judge_options(&self) -> ComputeResult<OptionResults> {
        self.judge(Depth::Full)
    }

    pub(in crate::study) fn judge(&self, depth: Depth) -> ComputeResult<OptionResults> {
        let Computed { mut value, partial } = judge(&[*self], depth, None)?;
        Ok(Computed { value: value.remove(0), partial })
    }
}

/// Judges every option of every case. The results are in the order of cases and options. An option for which there was no time has the
/// result [`NoResult::OutOfTime`]. All contexts belong to one study and share sampling and control.
pub fn judge(
    contexts: &[Context<'_>],
    depth: Depth,
    watch: OnEvent<'_>,
) -> ComputeResult<Vec<OptionResults>> {
    judge_rest(contexts, depth, &[], watch)
}

/// Like [`judge`], but takes what is `known` of each option and computes only the rest (`n_options` of all cases together).
/// [`Depth::begin_again`] makes the known part: an earlier judgement of the same shot, with the same settings and other plan values.
pub fn judge_rest(
    contexts: &[Context<'_>],
    depth: Depth,
    known: &[Option<Judgement>],
    watch: OnEvent<'_>,
) -> ComputeResult<Vec<OptionResults>> {
    let Some(&Context { sampling, control, .. }) = contexts.first() else {
        return Ok(Computed::complete(Vec::new()));
    };
    let results = vec![Vec::new(); contexts.len()];
    let mut batch = Batch { contexts, depth, sampling, control, known, watch, results };
    let partial = batch.judge()?;
    Ok(Computed { value: batch.results, partial })
}

/// Options that are judged together, and what is known of each. Each step returns whether the time was up before it ended.
struct Batch<'a> {
    contexts: &'a [Context<'a>],
    depth: Depth,
    sampling: Option<Sampling>,
    control: &'a StudyControl,
    /// What is known of each option beforehand, over all cases.
    known: &'a [Option<Judgement>],
    watch: OnEvent<'a>,
    /// Results by case.
    results: Vec<OptionResults>,
}

/// Share of the planned shots in a judgement by samples.
const SHARE_AS_PLANNED: f64 = 0.1;
/// Shares of the steps of a full judgement, each of the work left.
const SHARE_OF_JUDGING: f64 = 0.5;
const SHARE_OF_MARGINS: f64 = 0.25;
const SHARE_OF_DUDS: f64 = 0.5;

impl<'a> Batch<'a> {
    fn judge(&mut self) -> Result<bool, NoResult> {
        let Batch { sampling, control, .. } = *self;
        match (self.depth, &sampling) {
            (Depth::Unconfirmed | Depth::Full, None) => return self.check_and_sample(),
            (Depth::Unconfirmed, Some(sampling)) => {
                let asks = |context: &Context<'_>| context.case.plan.limits.withstands_one_dud;
                if !self.contexts.iter().any(asks) {
                    return self.check_and_sample();
                }
                control.has_steps(2);
                let [without, with] = self.expected_samples(sampling);
                let judging = control.part(without as f64 / (without + with).max(1) as f64);
                let partial = self.check_and_sample()?;
                drop(judging);
                let _leaving_out = control.part(1.0);
                // Samples with a dud are announced round by round. Announcing all of them here gives an early reader the whole number.
                control.announce(with);
                return Ok(partial | self.find_duds(sampling)?);
            }
            (Depth::Full | Depth::Chosen, _) => {}
        }
        control.has_steps(if sampling.is_some() { 4 } else { 2 });
        let judging = control.part(SHARE_OF_JUDGING);
        let mut partial = self.check_and_sample()?;
        if let Some(Sampling { seed, .. }) = sampling {
            partial |= self.find_deciding_shots(seed)?;
        }
        drop(judging);
        let finding_margins = control.part(if sampling.is_some() { SHARE_OF_MARGINS } else { 1.0 });
        partial |= self.find_launch_margins()?;
        drop(finding_margins);
        let Some(sampling) = sampling else { return Ok(partial) };
        let leaving_out = control.part(SHARE_OF_DUDS);
        partial |= self.find_duds(&sampling)?;
        drop(leaving_out);
        let _confirming = control.part(1.0);
        Ok(partial | self.confirm(&sampling)?)
    }

    /// Expected number of samples without a dud, and with one.
    fn expected_samples(&self, sampling: &Sampling) -> [usize; 2] {
        let shots = self
            .contexts
            .iter()
            .flat_map(|context| context.case.shots.iter().map(|shot| (context.case, shot)));
        let of_shot = |[without, with]: [usize; 2], (case, shot): (&Case, &Shot)| {
            [without + sampling.most, with + expected_dud_samples(case, shot)]
        };
        shots.fold([0; 2], of_shot)
    }

    /// Checks all planned shots, then takes their samples if these are asked for.
    fn check_and_sample(&mut self) -> Result<bool, NoResult> {
        let control = self.control;
        let as_planned = control.part(if self.sampling.is_some() { SHARE_AS_PLANNED } else { 1.0 });
        let partial = self.check_as_planned()?;
        drop(as_planned);
        let Some(sampling) = self.sampling else { return Ok(partial) };
        let _samples = control.part(1.0);
        Ok(partial | self.sample(&sampling)?)
    }

    fn check_as_planned(&mut self) -> Result<bool, NoResult> {
        let of_case = |(case, context): (usize, &Context<'_>)| {
            (0..context.case.shots.len()).map(move |option| CaseOption { case, option })
        };
        let options: Vec<CaseOption> = self.contexts.iter().enumerate().flat_map(of_case).collect();
        let known = self.known.iter().chain(repeat(&None));
        let jobs: Vec<(CaseOption, &Option<Judgement>)> = options.iter().copied().zip(known).collect();
        let all = run_batch(&jobs, self.control, |&(at, known)| {
            if let Some(judged) = known {
                return Ok(Ok(judged.clone()));
            }
            let begun = catch_panic(|| self.begin(at));
            self.tell(at, JudgeEvent::Checked(&begun));
            match begun {
                Err(ended @ (NoResult::Stopped | NoResult::OutOfTime)) => Err(ended),
                // If one option has no result, the others still get theirs.
                result => Ok(result),
            }
        })?;
        let partial = all.iter().any(Option::is_none);
        for (at, begun) in options.into_iter().zip(all) {
            self.results[at.case].push(begun.unwrap_or(Err(NoResult::OutOfTime)));
        }
        Ok(partial)
    }

    /// Checks the planned shot of an option and begins its judgement.
    fn begin(&self, at: CaseOption) -> Result<Judgement, NoResult> {
        let Context { case, compute, sampling, control } = self.contexts[at.case];
        let mut steps = 0_usize;
        let checked = check_as_planned(case, at.option, &compute, &mut |progress| {
            steps += 1;
            if steps.is_multiple_of(STEPS_PER_EVENT) {
                self.tell(at, JudgeEvent::Checking(progress));
            }
            control.keep_going()
        });
        let checked = checked.map_err(|failure| control.no_result(failure))?;
        Ok(match sampling {
            Some(_) => self.depth.begin(case, checked),
            None => Judgement::of_planned_alone(checked),
        })
    }

    /// Samples the options whose planned shot is checked.
    fn sample(&mut self, sampling: &Sampling) -> Result<bool, NoResult> {
        let awaits = |(_, judged): &(CaseOption, &Judgement)| matches!(judged.sampled, Evidence::Awaited);
        let target = |(at, judged): (CaseOption, &Judgement)| {
            let planned = ShotSummary::of(&judged.checked);
            // An option that fails as planned is sampled only to show by how much.
            let fails = planned.verdict == Verdict::Fail;
            let sampling = if fails { sampling.least_only() } else { *sampling };
            (at, self.target(at, sampling).with_planned(planned))
        };
        let (options, targets): (Vec<_>, Vec<_>) = self.judged().filter(awaits).map(target).unzip();
        let mut watch_round = |n: usize, sampled: &SampledShot| {
            if self.watch.is_some() {
                let part = Part::Samples { sampled: Box::new(sampled.clone()), more: true };
                self.tell(options[n], JudgeEvent::Found(&part));
            }
            ControlFlow::Continue(())
        };
        let Computed { value, partial } = sample_shots_watched(&targets, self.control, &mut watch_round)?;
        for (at, sampled) in options.into_iter().zip(value) {
            self.tell_and_take(at, Part::Samples { sampled: Box::new(sampled), more: false });
        }
        Ok(partial)
    }

    /// Runs the deciding shots of every option that was sampled with `seed`.
    fn find_deciding_shots(&mut self, seed: u64) -> Result<bool, NoResult> {
        let samples = |judged: &Judgement| {
            DecidingSamples::of(judged.sampled.known()?, seed).filter(|_| judged.deciding.is_none())
        };
        self.find(samples, |context, option, &samples| {
            Ok(Part::Deciding(Box::new(DecidingShots::run(context, option, samples)?)))
        })
    }

    fn find_launch_margins(&mut self) -> Result<bool, NoResult> {
        let verdict = |judged: &Judgement| judged.launch_margin.is_none().then_some(judged.checked.verdict);
        self.find(verdict, |context, option, &as_planned| {
            Ok(Part::Margin(launch_margin(context, &context.case.shots[option], as_planned)?))
        })
    }

    /// Judges every option with any one hole left out, with the next tire over holes between two tires, and with tires that turn.
    fn find_duds(&mut self, sampling: &Sampling) -> Result<bool, NoResult> {
        // An option that already fails is not sampled with duds. Its duds are only checked as planned.
        let fails = |judged: &Judgement| {
            judged.one_dud.is_none().then(|| judged.grounds().before_confirmation() == Verdict::Fail)
        };
        self.find(fails, |context, option, &fails| {
            let shot = &context.case.shots[option];
            let is_sampled = context.case.plan.limits.withstands_one_dud && !fails;
            let sampling_of_duds = is_sampled.then_some(sampling);
            let one_dud = if_known(|| judge_one_dud(context, shot, sampling_of_duds, fails))?.map(Box::new);
            let next_tires = if_known(|| judge_next_tires(context, shot))?;
            let turned_height = match fails {
                true => Some(None),
                false => if_known(|| turned_height(context, option, sampling.seed))?,
            };
            Ok(Part::Dud { one_dud, next_tires, turned_height })
        })
    }

    /// Computes one part of every judgement for which `job` gives a job, in parallel. If a computation fails, the verdict stands without
    /// the part.
    fn find<J: Sync>(
        &mut self,
        job: impl Fn(&Judgement) -> Option<J>,
        find: impl Fn(&Context<'_>, usize, &J) -> Result<Part, NoResult> + Sync,
    ) -> Result<bool, NoResult> {
        let jobs: Vec<_> = self.judged().filter_map(|(at, judged)| Some((at, job(judged)?))).collect();
        let found = run_batch(&jobs, self.control, |(at, job)| {
            match catch_panic(|| find(&self.contexts[at.case], at.option, job)) {
                Err(NoResult::Failed(_) | NoResult::Panicked(_)) => Ok(None),
                part => part.map(Some).inspect(|part| {
                    part.iter().for_each(|part| self.tell(*at, JudgeEvent::Found(part)));
                }),
            }
        })?;
        // A part may compute several batches. If the time is up during one of them, or one fails, the part is incomplete.
        let is_whole = |part: &Option<Option<Part>>| {
            part.as_ref().is_some_and(|part| part.as_ref().is_none_or(Part::is_whole))
        };
        let partial = !found.iter().all(is_whole);
        for ((at, _), part) in jobs.into_iter().zip(found) {
            part.flatten().into_iter().for_each(|part| self.take(at, part));
        }
        Ok(partial)
    }

    /// Confirms the options that await fresh draws, the safest first. The options of a plan share the probability of an error.
    fn confirm(&mut self, sampling: &Sampling) -> Result<bool, NoResult> {
        let of_case = |(case, results): (usize, &OptionResults)| {
            let awaits = |option: usize| {
                let judged = results[option].as_ref().ok()?;
                judged.grounds().awaits_confirmation().then(|| (option, ShotSummary::of(&judged.checked)))
            };
            let ranked = safest_first(self.contexts[case].case, results, |_| 1.0).into_iter();
            let target = |(n, (option, planned))| {
                let at = CaseOption { case, option };
                (at, self.target(at, sampling.for_confirmation(n + 1)).with_planned(planned))
            };
            ranked.filter_map(awaits).enumerate().map(target).collect_vec()
        };
        let (options, targets): (Vec<_>, Vec<_>) = self.results.iter().enumerate().flat_map(of_case).unzip();
        let confirmations = confirm_shots(&targets, self.control)?;
        let partial = confirmations.contains(&None);
        for (at, confirmation) in options.into_iter().zip(confirmations) {
            confirmation
                .into_iter()
                .for_each(|drawn| self.tell_and_take(at, Part::Confirmation(Box::new(drawn))));
        }
        Ok(partial)
    }

    /// The options whose planned shot is checked.
    fn judged(&self) -> impl Iterator<Item = (CaseOption, &Judgement)> {
        self.results.iter().enumerate().flat_map(|(case, results)| {
            let judged = results.iter().enumerate();
            judged.filter_map(move |(option, result)| {
                Some((CaseOption { case, option }, result.as_ref().ok()?))
            })
        })
    }

    fn target(&self, at: CaseOption, sampling: Sampling) -> ShotToSample<'a> {
        let Context { case, compute, .. } = self.contexts[at.case];
        ShotToSample::new(case, &case.shots[at.option], compute, sampling)
    }

    fn tell(&self, at: CaseOption, event: JudgeEvent<'_>) {
        self.watch.iter().for_each(|watch| watch(at, event));
    }

    fn take(&mut self, at: CaseOption, part: Part) {
        if let Ok(judged) = &mut self.results[at.case][at.option] {
            judged.take(part);
        }
    }

    fn tell_and_take(&mut self, at: CaseOption, part: Part) {
        self.tell(at, JudgeEvent::Found(&part));
        self.take(at, part);
    }
}

/// What `work` finds; `None` if it fails, as if the time was up: the others of its kind stand, and the result is partial.
fn if_known<T>(work: impl FnOnce() -> Result<Option<T>, NoResult>) -> Result<Option<T>, NoResult> {
    match catch_panic(work) {
        Err(NoResult::Failed(_) | NoResult::Panicked(_)) => Ok(None),
        found => found,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Plan;
    use crate::study::ComputeSettings;
    use crate::study::judge::brief_judgement::tests::case as two_tires;
    use crate::study::samples::failure_bounds::{ErrorShare, FailureBounds};
    use crate::study::samples::risk_summary::RiskSummary;

    /// The time is up after the first of nine places of a dud. The result says that something is missing, and the parts that exist are
    /// whole.
    #[test]
    fn duds_that_the_time_did_not_suffice_for_are_told() {
        let text = include_str!("../../../tests/fixtures/amur-three-rows.toml");
        let mut case = Case::new(Plan::parse("", text).unwrap_or_else(|mistakes| panic!("{mistakes}")));
        case.plan.delays.truncate(1);
        case.shots.truncate(1);
        let (compute, control) = (ComputeSettings::of(&case.plan), StudyControl::default());
        let contexts = [Context::new(&case, compute, &control)];
        let mut batch = Batch {
            contexts: &contexts,
            depth: Depth::Unconfirmed,
            sampling: None,
            control: &control,
            known: &[],
            watch: None,
            results: vec![Vec::new()],
        };
        batch.check_as_planned().expect("a result");
        let (before, _) = control.counts();
        let pool = crate::study::thread_pool(1).expect("a thread");
        let partial = std::thread::scope(|scope| {
            scope.spawn(|| {
                while control.counts().0 == before {
                    std::thread::yield_now();
                }
                control.expire();
            });
            pool.install(|| batch.find_duds(&Sampling::OF_VERDICT)).expect("a result")
        });
        let judged = batch.results[0][0].as_ref().expect("a result");
        assert_eq!(partial, judged.one_dud.is_none());
    }

    /// Fresh draws are for an option that was chosen among several, or by the program. If they refused an option or were asked for, that
    /// stays, whatever options are deleted.
    #[test]
    fn nobody_makes_an_option_pass_by_deleting_the_others() {
        let case = two_tires("", false);
        let checked = case.check_as_planned(0, &ComputeSettings::of(&case.plan)).expect("a result");
        let drawn = |verdict| {
            let bounds = FailureBounds::new(0.01, ErrorShare::Whole);
            Evidence::Known(RiskSummary { bounds, verdict, finer_runs_disagree: false, utilization: 0.5 })
        };
        let [passed, refused] = [Verdict::Pass, Verdict::Undecided].map(drawn);
        let [not_asked, awaited] = [Evidence::NotAsked, Evidence::Awaited];
        for (depth, options, before, after) in [
            (Depth::Unconfirmed, 2, not_asked, not_asked),
            (Depth::Full, 1, not_asked, not_asked),
            (Depth::Full, 1, awaited, awaited),
            (Depth::Full, 1, passed, awaited),
            (Depth::Full, 2, not_asked, awaited),
            (Depth::Full, 2, passed, awaited),
            (Depth::Full, 2, refused, refused),
            (Depth::Full, 1, refused, refused),
            (Depth::Chosen, 1, not_asked, awaited),
        ] {
            let judged = Judgement { confirmation: before, ..Judgement::of_planned_alone(checked.clone()) };
            let again = depth.begin_again(&case.with_options(&vec![0; options]), judged);
            assert_eq!(again.confirmation, after, "{depth:?} {options} {before:?}");
        }
    }

    /// Judges two equal options. The time is up at the `nth` event of a kind, from 1. Returns the results, whether something is missing,
    /// and the kinds of events in order.
    fn judged(
        case: &Case,
        depth: Depth,
        up_at: Option<(&str, usize)>,
    ) -> (OptionResults, bool, Vec<&'static str>) {
        let case = case.with_options(&[0, 0]);
        let (control, told) = (StudyControl::default(), std::sync::Mutex::new(Vec::new()));
        let watch = |_: CaseOption, event: JudgeEvent<'_>| {
            let kind = match event {
                JudgeEvent::Checking(_) => return,
                JudgeEvent::Checked(_) => "checked",
                JudgeEvent::Found(Part::Samples { .. }) => "samples",
                JudgeEvent::Found(Part::Deciding(_)) => "deciding",
                JudgeEvent::Found(Part::Margin(_)) => "margin",
                JudgeEvent::Found(Part::Dud { .. }) => "dud",
                JudgeEvent::Found(Part::Confirmation(_)) => "confirmation",
            };
            let mut told = told.lock().expect("no panic");
            told.push(kind);
            if up_at.is_some_and(|(last, nth)| {
                last == kind && told.iter().filter(|told| **told == kind).count() == nth
            }) {
                control.expire();
            }
        };
        let context = Context::new(&case, ComputeSettings::of(&case.plan), &control).with_sampling(SAMPLING);
        let pool = crate::study::thread_pool(1).expect("a thread");
        let found = pool.install(|| judge(&[context], depth, Some(&watch)));
        let Computed { mut value, partial } = found.expect("a result");
        (value.remove(0), partial, told.into_inner().expect("no panic"))
    }

    const SAMPLING: Sampling = Sampling { most: 600, ..Sampling::OF_VERDICT };

    /// Two tires without a tie fly the same. Both options pass on every ground, and each is confirmed by draws of its own.
    #[test]
    fn a_full_judgement_has_every_part_and_tells_it() {
        let case = two_tires("", true);
        let (results, partial, told) = judged(&case, Depth::Full, None);
        assert!(!partial);
        for (kind, count) in [("checked", 2), ("deciding", 2), ("margin", 2), ("dud", 2), ("confirmation", 2)]
        {
            assert_eq!(told.iter().filter(|told| **told == kind).count(), count, "{kind}");
        }
        assert!(told.iter().filter(|told| **told == "samples").count() > 4, "each of several rounds");
        for (n, judged) in results.iter().enumerate() {
            let judged = judged.as_ref().expect("a result");
            assert!(judged.is_full_pass() && judged.deciding.is_some() && judged.launch_margin.is_some());
            assert!(judged.one_dud.is_some_and(|dud| dud.sampled.is_some()), "with samples");
            let compute = ComputeSettings::of(&case.plan);
            let target = ShotToSample::new(&case, &case.shots[0], compute, SAMPLING)
                .with_planned(ShotSummary::of(&judged.checked));
            let drawn = super::super::confirm::confirm_shot(&target, n + 1, &StudyControl::default());
            assert_eq!(judged.confirmation, Evidence::Known(drawn.expect("a result").expect("in time")));
        }
        // Without `withstands_one_dud` there are no samples with a dud, and a dud does not count in the verdict. At a lesser depth there
        // are no fresh draws.
        let is_sampled = |case: &Case, depth| {
            let (results, partial, _) = judged(case, depth, None);
            let judged = results[1].as_ref().expect("a result");
            assert!(!partial && judged.confirmation.is_asked() == (depth == Depth::Full));
            (judged.verdict(), judged.one_dud.map(|dud| dud.sampled.is_some()))
        };
        let not_asked = two_tires("", false);
        assert_eq!(is_sampled(&not_asked, Depth::Full), (Verdict::Pass, Some(false)));
        assert_eq!(is_sampled(&not_asked, Depth::Unconfirmed), (Verdict::Pass, None));
        assert_eq!(is_sampled(&case, Depth::Unconfirmed), (Verdict::Pass, Some(true)));
    }

    /// An option that fails as planned is sampled only to show by how much. Its duds are not sampled.
    #[test]
    fn an_option_that_fails_as_planned_gets_the_least_samples_and_none_with_duds() {
        let mut case = two_tires("", true);
        case.limits.height = 0.1;
        let (results, partial, _) = judged(&case, Depth::Full, None);
        let judged = results[0].as_ref().expect("a result");
        let drawn = judged.sampled.known().map(|sampled| sampled.samples.len());
        assert_eq!((judged.verdict(), drawn, partial), (Verdict::Fail, Some(SAMPLING.least), false));
        assert!(judged.one_dud.is_some_and(|dud| dud.sampled.is_none() && dud.failing > 0));
    }

    /// If the time is up before the end of a judgement, the judgement says that it is partial, and the second option does not pass.
    #[test]
    fn a_judgement_that_the_time_cut_short_says_so() {
        let case = two_tires("", true);
        let mut tied = two_tires("\"row\"", true);
        tied.limits.force = 1.0;
        for (case, depth, last, nth, is_partial) in [
            (&case, Depth::Full, "checked", 1, true),
            (&case, Depth::Full, "samples", 1, true),
            (&case, Depth::Full, "deciding", 1, true),
            (&case, Depth::Full, "margin", 1, true),
            (&case, Depth::Full, "dud", 1, true),
            (&case, Depth::Full, "dud", 2, true),
            (&tied, Depth::Full, "dud", 1, true),
            (&case, Depth::Full, "confirmation", 2, false),
            (&case, Depth::Unconfirmed, "checked", 1, true),
            (&case, Depth::Unconfirmed, "dud", 1, true),
            (&case, Depth::Unconfirmed, "dud", 2, false),
            (&two_tires("", false), Depth::Unconfirmed, "checked", 1, true),
            (&two_tires("", false), Depth::Unconfirmed, "samples", 1, true),
        ] {
            let (results, partial, told) = judged(case, depth, Some((last, nth)));
            assert_eq!(partial, is_partial, "{depth:?} {last} {nth} {told:?}");
            let passes = results[1].as_ref().is_ok_and(|judged| judged.verdict() == Verdict::Pass);
            assert_eq!(passes, !is_partial, "{depth:?} {last} {nth} {told:?}");
        }
    }

    /// Samples and fresh draws are no evidence if the planned shot exceeds them by far.
    #[test]
    fn a_planned_shot_beyond_its_samples_leaves_them_no_evidence() {
        let case = two_tires("", false);
        let (compute, control) = (ComputeSettings::of(&case.plan), StudyControl::default());
        let context = Context::new(&case, compute, &control).with_sampling(SAMPLING);
        let (before, _, _) = judged(&case, Depth::Full, None);
        let passing = before[0].clone().expect("a result");
        let mut checked = passing.checked.clone();
        checked.estimates.height.value *= 10.0;
        let exceeding = Judgement { checked, ..passing.clone() };
        let evidence = |judged: Judgement, is_sampled: bool| {
            let sampled = if is_sampled { judged.sampled } else { Evidence::Awaited };
            let known = Judgement { sampled, confirmation: Evidence::Awaited, ..judged };
            let found =
                judge_rest(&[context], Depth::Full, &[Some(known)], None).expect("a result").value.remove(0);
            let judged = found[0].as_ref().expect("a result");
            [judged.sampled.map(SampledShot::verdict), judged.confirmation.map(|drawn| drawn.verdict)]
        };
        let [pass, open] = [Verdict::Pass, Verdict::Undecided].map(Evidence::Known);
        assert_eq!([true, false].map(|is_sampled| evidence(passing.clone(), is_sampled)), [[pass; 2]; 2]);
        assert_eq!(evidence(exceeding.clone(), true), [pass, open]);
        assert_eq!(evidence(exceeding, false), [open, Evidence::Awaited]);
    }
}
