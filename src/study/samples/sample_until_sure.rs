//! Samples of many shots, drawn and run in rounds until each risk is sure.

use std::collections::BTreeSet;
use std::ops::{ControlFlow, Range};

use super::random_shot::{DrawnShot, Input, draw_shot};
use super::sample::{Sample, SampleRun};
use super::sample_count::Sampling;
use super::sampled_shot::{LEAST_AUDITS, SampledShot};
use crate::choice::Accuracy;
use crate::scene::{Scene, Shot};
use crate::simulation::{Motion, RunSettings};
use crate::study::as_planned::cover::CoverRecorder;
use crate::study::as_planned::shot_reason::energy_balance_closes;
use crate::study::compute_settings::step_factor;
use crate::study::work::batch::run_batch;
use crate::study::{
    Case, ComputeResult, ComputeSettings, Computed, Fingerprint, NoResult, Shard, ShotSummary, StudyControl,
    catch_panic,
};

/// A shot whose risk is asked for.
#[derive(Clone, Copy, Debug)]
pub struct ShotToSample<'c> {
    /// The plan.
    pub case: &'c Case,
    /// The shot as planned.
    pub shot: &'c Shot,
    /// The shot as planned, checked by finer runs; `None` where it is not known.
    pub planned: Option<ShotSummary>,
    /// Method and accuracy.
    pub compute: ComputeSettings,
    /// Number of samples and seed.
    pub sampling: Sampling,
    /// Samples at the usual step that other machines drew, in order of their numbers.
    pub precomputed: &'c [Sample],
    /// Whether only a pass is of interest: sampling ends where none can come.
    pub only_pass: bool,
}

impl<'c> ShotToSample<'c> {
    /// A shot that nobody has judged or sampled yet.
    pub fn new(case: &'c Case, shot: &'c Shot, compute: ComputeSettings, sampling: Sampling) -> Self {
        Self { case, shot, planned: None, compute, sampling, precomputed: &[], only_pass: false }
    }

    /// The same shot, with its check as `planned`.
    pub fn with_planned(self, planned: ShotSummary) -> Self {
        Self { planned: Some(planned), ..self }
    }

    /// The same shot, of which other machines drew samples at the usual step, in order of their numbers.
    pub fn with_precomputed(self, precomputed: &'c [Sample]) -> Self {
        Self { precomputed, ..self }
    }

    /// The same shot, whose sampling ends as soon as no pass can come. A shot that passes gets all its samples.
    pub fn only_pass(self) -> Self {
        Self { only_pass: true, ..self }
    }

    /// Numbers of the samples to draw next.
    fn next_round(&self, sampled: &SampledShot) -> Range<usize> {
        let drawn = sampled.samples.len();
        if self.only_pass && !sampled.bounds.can_pass(self.sampling.most) {
            return drawn..drawn;
        }
        self.sampling.next_round(sampled)
    }

    /// The sample of a number, where another machine drew it.
    fn drawn_elsewhere(&self, number: usize) -> Option<&Sample> {
        let found = self.precomputed.binary_search_by_key(&number, |sample| sample.number);
        found.ok().map(|n| &self.precomputed[n])
    }

    /// Fingerprint of all that its samples depend on, but for their numbers.
    pub(in crate::study) fn fingerprint(&self) -> Fingerprint {
        Fingerprint::of((self.case.fingerprint(), self.shot, self.compute, self.sampling.seed))
    }

    /// Number of samples that are still expected: as many as a pass takes, or as many again as were drawn.
    fn expected(&self, sampled: &SampledShot) -> usize {
        let (drawn, next) = (sampled.samples.len(), self.next_round(sampled).len());
        if next == 0 {
            return 0;
        }
        let all = self.sampling.least.max(USUAL_OF_PASS).max(2 * drawn).min(self.sampling.most);
        all.saturating_sub(drawn).max(next)
    }

    /// Whether it may be sampled anew at half the step, after so many times: not where the user fixed the step.
    fn may_halve(&self, step_halvings: u32) -> bool {
        self.compute.step.is_none() && step_halvings < MOST_STEP_HALVINGS
    }

    fn no_samples(&self) -> SampledShot {
        SampledShot::new(self.case, self.planned, self.sampling.error_share, self.compute.step.is_none())
    }
}

/// Samples that a pass usually takes.
pub const USUAL_OF_PASS: usize = 500;
/// The accepted risk at which it does.
pub const RISK_OF_USUAL: f64 = 0.01;
/// One sample in so many is audited: 5 %, and more of the first ones.
const AUDIT_EVERY: usize = 20;
const AUDIT_EVERY_AT_FIRST: usize = 10;
/// Number of samples of which more are audited: enough for [`LEAST_AUDITS`].
const FIRST_SAMPLES: usize = AUDIT_EVERY_AT_FIRST * LEAST_AUDITS;
/// Times that the step of a sample is halved for its audit, whose own error is a sixteenth.
pub(in crate::study) const AUDIT_HALVINGS: u32 = 2;
const AUDIT_STEP_DIVISOR: f64 = (1 << AUDIT_HALVINGS) as f64;

/// Most times that a shot is sampled anew at half the step.
const MOST_STEP_HALVINGS: u32 = 3;

/// Draws and runs samples of every shot, until its risk is sure.
///
/// The result is partial where a shot has no more samples than the time sufficed for.
pub fn sample_shots(targets: &[ShotToSample<'_>], control: &StudyControl) -> ComputeResult<Vec<SampledShot>> {
    sample_shots_watched(targets, control, &mut |_, _| ControlFlow::Continue(()))
}

/// Like [`sample_shots`]; `watch` sees every shot after each of its rounds, and may end the sampling of all: what it ended is not
/// partial.
pub fn sample_shots_watched(
    targets: &[ShotToSample<'_>],
    control: &StudyControl,
    watch: &mut dyn FnMut(usize, &SampledShot) -> ControlFlow<()>,
) -> ComputeResult<Vec<SampledShot>> {
    let mut sampled_shots: Vec<SampledShot> = targets.iter().map(ShotToSample::no_samples).collect();
    let keys = keys(targets, control);
    loop {
        let round = |(n, sampled): (usize, &SampledShot)| {
            let (numbers, step_halvings) = (targets[n].next_round(sampled), sampled.step_halvings);
            numbers.map(move |number| (n, number, step_halvings))
        };
        let jobs: Vec<(usize, usize, u32)> = sampled_shots.iter().enumerate().flat_map(round).collect();
        if jobs.is_empty() {
            return Ok(Computed::complete(sampled_shots));
        }
        let expected: usize =
            targets.iter().zip(&sampled_shots).map(|(target, sampled)| target.expected(sampled)).sum();
        let _round = control.part(jobs.len() as f64 / expected as f64);
        let drawn = run_batch(&jobs, control, |&(n, number, step_halvings)| {
            match targets[n].drawn_elsewhere(number) {
                Some(sample) if step_halvings == 0 => Ok(*sample),
                _ => recall_sample(&targets[n], keys[n], number, step_halvings, control),
            }
        })?;
        let out_of_time = drawn.contains(&None);
        let mut complete = vec![true; targets.len()];
        for (&(n, ..), sample) in jobs.iter().zip(drawn) {
            // Samples are counted in order, so that a result is that of so many samples.
            complete[n] &= sample.is_some();
            if let Some(sample) = sample.filter(|_| complete[n]) {
                sampled_shots[n].push(sample);
            }
        }
        for n in jobs.iter().map(|&(n, ..)| n).collect::<BTreeSet<_>>() {
            let (target, sampled) = (&targets[n], &mut sampled_shots[n]);
            if !out_of_time && target.may_halve(sampled.step_halvings) && sampled.finer_runs_disagree() {
                let step_halvings = sampled.step_halvings + 1;
                *sampled = target.no_samples();
                sampled.step_halvings = step_halvings;
            }
            if watch(n, sampled).is_break() {
                return Ok(Computed::complete(sampled_shots));
            }
        }
        if out_of_time {
            return Ok(Computed { value: sampled_shots, partial: true });
        }
    }
}

/// Keys of shots in the journal; `None` where there is no journal.
fn keys(targets: &[ShotToSample<'_>], control: &StudyControl) -> Vec<Option<Fingerprint>> {
    let is_on = control.journal().is_on();
    targets.iter().map(|target| is_on.then(|| target.fingerprint())).collect()
}

/// The sample of [`run_sample`], taken from the journal where it is there; `key` is that of the shot.
fn recall_sample(
    target: &ShotToSample<'_>,
    key: Option<Fingerprint>,
    number: usize,
    step_halvings: u32,
    control: &StudyControl,
) -> Result<Sample, NoResult> {
    let key = || Fingerprint::of(("sample", key, number, step_halvings));
    control.journal().recall_or(key, || run_sample(target, number, step_halvings, control))
}

/// Draws one sample and runs it once, without an audit: for a first look at a shot among many.
pub(in crate::study) fn run_sample_once(
    target: &ShotToSample<'_>,
    number: usize,
    control: &StudyControl,
) -> Result<Sample, NoResult> {
    undecided_if_panicked(catch_panic(|| try_sample(target, number, 0, false, control)), number)
}

/// Draws one sample and runs it, at a step halved `step_halvings` times; where the sample is one of the audit, also at a finer
/// step.
pub(in crate::study) fn run_sample(
    target: &ShotToSample<'_>,
    number: usize,
    step_halvings: u32,
    control: &StudyControl,
) -> Result<Sample, NoResult> {
    undecided_if_panicked(catch_panic(|| try_sample(target, number, step_halvings, true, control)), number)
}

/// A sample in which the program panicked shows nothing; the others go on.
fn undecided_if_panicked(sample: Result<Sample, NoResult>, number: usize) -> Result<Sample, NoResult> {
    match sample {
        Err(NoResult::Panicked(_)) => Ok(Sample {
            number,
            run: SampleRun::FAILED_RUN,
            finer: None,
            inputs: [f64::NAN; Input::ALL.len()],
        }),
        sample => sample,
    }
}

/// Draws and runs the samples of every shot that belong to `shard`; `None` for those that the time did not suffice for.
pub fn run_shard(
    targets: &[ShotToSample<'_>],
    shard: Shard,
    control: &StudyControl,
) -> Result<Vec<(usize, Option<Sample>)>, NoResult> {
    let of_target = |n: usize| (0..targets[n].sampling.most).map(move |number| (n, number));
    let jobs: Vec<(usize, usize)> =
        (0..targets.len()).flat_map(of_target).filter(|&(_, number)| shard.has(number)).collect();
    let keys = keys(targets, control);
    let recall = |&(n, number): &(usize, usize)| recall_sample(&targets[n], keys[n], number, 0, control);
    let drawn = run_batch(&jobs, control, recall)?;
    Ok(jobs.into_iter().map(|(n, _)| n).zip(drawn).collect())
}

/// Longest step of a sample [s]: it resolves a landing.
const LONGEST_STEP: f64 = 2e-3;
/// Greatest step of a sample over the critical step of its own scene. With it 0.1 % of verdicts are wrong, at a quarter of the step
/// none (`benches/RESULTS.md`, "Are the verdicts right?").
const CRITICAL_STEP_FRACTION: f64 = 0.55;
/// Factor on the step of a sample where accuracy `reference` is asked for; draft and field use one step.
const REFERENCE_STEP_FACTOR: f64 = 0.25;

/// Step of a sample [s]: the fixed step where there is one.
pub(in crate::study) fn sample_step(compute: &ComputeSettings, scene: &Scene) -> f64 {
    let level = if compute.accuracy == Accuracy::Reference { REFERENCE_STEP_FACTOR } else { 1.0 };
    let usual = LONGEST_STEP.min(CRITICAL_STEP_FRACTION * scene.critical_step());
    compute.step.unwrap_or(step_factor(compute.method) * level * usual)
}

/// Number of steps of a sample that ends at `end` [s].
pub fn steps_of_sample(case: &Case, compute: &ComputeSettings, end: f64) -> f64 {
    end / sample_step(compute, case.scene())
}

/// Settings of the run of a sample at `step` [s], all of whose firings are shifted by `later` [s].
pub(in crate::study) fn sample_settings(
    case: &Case,
    compute: &ComputeSettings,
    step: f64,
    later: f64,
) -> RunSettings {
    let planned = case.run_settings(compute.method, step);
    RunSettings { duration: planned.duration.map(|duration| duration + later), ..planned }
}

fn try_sample(
    target: &ShotToSample<'_>,
    number: usize,
    step_halvings: u32,
    may_audit: bool,
    control: &StudyControl,
) -> Result<Sample, NoResult> {
    let ShotToSample { case, shot, compute, sampling, .. } = *target;
    let DrawnShot { scene, shot, inputs, later } = draw_shot(case, shot, sampling.seed, number);
    // The run, and whether it failed or has no energy balance.
    let run = |step: f64| {
        let settings = sample_settings(case, &compute, step, later);
        let mut cover = CoverRecorder::new(case, &shot.firings, step);
        let watch = &mut |motion: &dyn Motion| {
            cover.observe(motion);
            control.keep_going()
        };
        match case.model.run_variant(&scene, &shot, &settings, watch) {
            Ok(outcome) => {
                let run = SampleRun::new(case, &shot, &outcome, &cover.cover());
                Ok((run, !energy_balance_closes(outcome.ledger.residual())))
            }
            Err(failure) => match control.no_result(failure) {
                NoResult::Failed(_) => Ok((SampleRun::FAILED_RUN, true)),
                ended => Err(ended),
            },
        }
    };
    let step = sample_step(&compute, &scene) * 0.5_f64.powi(step_halvings as i32);
    if compute.step.is_some() {
        return Ok(Sample { number, run: run(step)?.0, finer: None, inputs });
    }
    let every = if number < FIRST_SAMPLES { AUDIT_EVERY_AT_FIRST } else { AUDIT_EVERY };
    let is_audited = may_audit && number % every == every / 2;
    let (run, finer) = run_and_audit(step, is_audited, run)?;
    Ok(Sample { number, run, finer, inputs })
}

/// Runs a sample at `step` [s]. If that run shows nothing, runs it at the step of an audit instead. Runs a sample that is audited
/// once more, at a still finer step. `run` returns a run and whether it shows nothing.
fn run_and_audit(
    step: f64,
    is_audited: bool,
    run: impl Fn(f64) -> Result<(SampleRun, bool), NoResult>,
) -> Result<(SampleRun, Option<SampleRun>), NoResult> {
    let (coarse, shows_nothing) = run(step)?;
    let step = if shows_nothing { step / AUDIT_STEP_DIVISOR } else { step };
    let first = if shows_nothing { run(step)?.0 } else { coarse };
    let finer = if is_audited { Some(run(step / AUDIT_STEP_DIVISOR)?.0) } else { None };
    Ok((first, finer))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choice::Method;
    use crate::verdict::Verdict;

    /// No run is its own audit: it would bear out any verdict.
    #[test]
    fn the_audit_is_finer_than_the_run_that_counts() {
        let at_step = |shows_nothing_from: f64| {
            move |step: f64| {
                let run = SampleRun {
                    verdict: Verdict::Pass,
                    uncovering: 0.0,
                    breaks: Verdict::Pass,
                    height: step,
                    force: 1.0,
                    cable: 0,
                    drift: 0.0,
                };
                Ok((run, step >= shows_nothing_from))
            }
        };
        let steps = |shows_nothing_from, is_audited| {
            let runs = run_and_audit(16.0, is_audited, at_step(shows_nothing_from)).expect("runs");
            (runs.0.height, runs.1.map(|finer| finer.height))
        };
        assert_eq!(steps(20.0, false), (16.0, None));
        assert_eq!(steps(20.0, true), (16.0, Some(4.0)));
        assert_eq!(steps(10.0, false), (4.0, None));
        assert_eq!(steps(10.0, true), (4.0, Some(1.0)));
    }

    /// A lone tire, fired alone.
    fn lone_tire() -> Case {
        let text = r#"
shelter = { layout = "grid", rows = 1, columns = 2, spacing_m = 3 }
tire = { mass_kg = 280 }
cable = { axial_stiffness_kn = 1400, breaking_force_kn = 60 }
ground = { friction = 0.5 }
blast_row = [{ name = "1", holes = [{ x_m = 0, y_m = 0, launch_m_s = 3 }] }]
limits = { flight_height_m = 5, cable_safety_factor = 1 }
delay = [{ name = "1", interval_ms = 0 }]
"#;
        Case::new(crate::plan::Plan::parse("", text).unwrap_or_else(|mistakes| panic!("{mistakes}")))
    }

    /// One sample in ten of the first 200, one in twenty of the others. The run of the audit is that of the sample at a quarter of its
    /// step.
    #[test]
    fn every_twentieth_sample_is_audited_and_more_of_the_first() {
        let (case, control) = (lone_tire(), StudyControl::default());
        let compute = ComputeSettings::of(&case.plan);
        let target = ShotToSample::new(&case, &case.shots[0], compute, Sampling::OF_VERDICT);
        let sample = |number, halvings| run_sample(&target, number, halvings, &control).expect("a sample");
        let audited: Vec<usize> = [0, 4, 5, 6, 15, 25, 35, 195, 199, 200, 205, 209, 210, 211, 220, 230]
            .into_iter()
            .filter(|&number| sample(number, 0).finer.is_some())
            .collect();
        assert_eq!(audited, [5, 15, 25, 35, 195, 210, 230]);
        assert_eq!(sample(5, 0).finer, Some(sample(5, 2).run));
        assert_ne!(sample(5, 0).run, sample(5, 2).run);
        assert_eq!(run_sample_once(&target, 5, &control).expect("a sample").finer, None);
        // Where the user fixed the step there is no other.
        let fixed = ComputeSettings { step: Some(1e-3), ..compute };
        let target = ShotToSample { compute: fixed, ..target };
        assert_eq!(run_sample(&target, 5, 0, &control).expect("a sample").finer, None);
    }

    /// The step is 0.55 of the critical one, never longer than 2 ms, a quarter of that for a reference, and the fixed one where there is
    /// one.
    #[test]
    fn a_sample_takes_a_step_that_its_scene_allows() {
        let case = lone_tire();
        let compute =
            ComputeSettings { accuracy: Accuracy::Field, step: None, ..ComputeSettings::of(&case.plan) };
        let mut scene = case.scene().clone();
        let step = |compute: &ComputeSettings, scene: &Scene| sample_step(compute, scene);
        let critical = scene.critical_step();
        let usual = step(&compute, &scene);
        assert_eq!(usual, (0.55 * critical).min(2e-3));
        for accuracy in [Accuracy::Draft, Accuracy::Reference] {
            let factor = if accuracy == Accuracy::Reference { 0.25 } else { 1.0 };
            assert_eq!(step(&ComputeSettings { accuracy, ..compute }, &scene), factor * usual);
        }
        assert_eq!(step(&ComputeSettings { method: Method::Newmark, ..compute }, &scene), 0.25 * usual);
        assert_eq!(step(&ComputeSettings { step: Some(5e-3), ..compute }, &scene), 5e-3);
        assert_eq!(steps_of_sample(&case, &compute, 100.0 * usual), 100.0);
        // Tires a thousand times as heavy swing slowly, and tires a thousandth as heavy fast.
        scene.mass.iter_mut().for_each(|mass| *mass *= 1e3);
        assert_eq!(step(&compute, &scene), 2e-3);
        scene.mass.iter_mut().for_each(|mass| *mass *= 1e-6);
        assert_eq!(step(&compute, &scene), 0.55 * scene.critical_step());
        assert!(0.55 * scene.critical_step() < 2e-3, "a test that can fail");
    }

    /// Samples drawn elsewhere count as they are. Here their audit contradicts them, and all are drawn anew at half the step.
    #[test]
    fn samples_drawn_elsewhere_are_taken_at_the_usual_step_only() {
        let (case, control) = (lone_tire(), StudyControl::default());
        let run = |verdict| SampleRun {
            verdict,
            uncovering: 0.0,
            breaks: verdict,
            height: 1.0,
            force: 1.0,
            cable: 0,
            drift: 0.0,
        };
        let made_up = |number: usize| {
            let finer = (number % 10 == 5).then_some(run(Verdict::Fail));
            Sample { number, run: run(Verdict::Pass), finer, inputs: [1.0; Input::ALL.len()] }
        };
        let made_up: Vec<Sample> = (0..100).map(made_up).collect();
        let compute = ComputeSettings::of(&case.plan);
        let target = ShotToSample::new(&case, &case.shots[0], compute, Sampling::exactly(100, 1))
            .with_precomputed(&made_up);
        let sampled = sample_shots(&[target], &control).expect("samples").value.remove(0);
        assert_eq!((sampled.step_halvings, sampled.samples.len()), (1, 100));
        for number in [0, 5, 99] {
            assert_eq!(Ok(sampled.samples[number]), run_sample(&target, number, 1, &control));
        }
        // Where the user fixed the step, it is not halved.
        let fixed = ShotToSample { compute: ComputeSettings { step: Some(1e-3), ..compute }, ..target };
        let sampled = sample_shots(&[fixed], &control).expect("samples").value.remove(0);
        assert_eq!((sampled.step_halvings, sampled.samples), (0, made_up.clone()));
    }

    /// A shot is sampled anew three times at most. One that shall only pass is sampled while it can.
    #[test]
    fn sampling_ends_where_it_shows_no_more() {
        let case = lone_tire();
        let compute = ComputeSettings::of(&case.plan);
        let target = ShotToSample::new(&case, &case.shots[0], compute, Sampling::exactly(2000, 1));
        assert!(target.may_halve(0) && target.may_halve(2) && !target.may_halve(3));
        let fixed = ShotToSample { compute: ComputeSettings { step: Some(1e-3), ..compute }, ..target };
        assert!(!fixed.may_halve(0));
        assert_eq!(target.with_planned(ShotSummary::FAILED_RUN).no_samples(), {
            SampledShot::new(&case, Some(ShotSummary::FAILED_RUN), target.sampling.error_share, true)
        });
        let only_pass = target.only_pass();
        let mut sampled = target.no_samples();
        assert_eq!(only_pass.next_round(&sampled), 0..50);
        (0..50).for_each(|_| sampled.bounds.push(Verdict::Fail));
        assert!(only_pass.next_round(&sampled).is_empty() && !target.next_round(&sampled).is_empty());
    }

    /// Two machines draw every sample of every shot once, each as one machine would.
    #[test]
    fn shards_draw_what_one_machine_would() {
        let (case, control) = (lone_tire(), StudyControl::default());
        let compute = ComputeSettings::of(&case.plan);
        let target = ShotToSample::new(&case, &case.shots[0], compute, Sampling::exactly(3, 1));
        let of_shard = |index: usize| {
            run_shard(&[target, target], Shard { index, count: 2 }, &control).expect("samples")
        };
        let mut drawn = [0, 1].map(of_shard).concat();
        drawn.sort_by_key(|(n, sample)| (*n, sample.map(|sample| sample.number)));
        let all = sample_shots(&[target], &control).expect("samples").value.remove(0).samples;
        let of_both = [0, 1].into_iter().flat_map(|n| all.iter().map(move |sample| (n, Some(*sample))));
        assert_eq!(drawn, of_both.collect::<Vec<_>>());
    }

    #[test]
    fn a_sample_that_panics_is_undecided_and_a_stop_stays_a_stop() {
        let panicked = undecided_if_panicked(Err(NoResult::Panicked("why".to_owned())), 7).expect("a sample");
        assert_eq!((panicked.number, panicked.run), (7, SampleRun::FAILED_RUN));
        assert_eq!(undecided_if_panicked(Err(NoResult::Stopped), 7), Err(NoResult::Stopped));
    }
}
