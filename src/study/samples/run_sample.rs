//! One sample: it is drawn, and run at a step that its scene allows.

use super::random_shot::{DrawnShot, Input, draw_shots};
use super::sample::{Sample, SampleRun};
use super::sample_count::Sampling;
use super::sampled_shot::LEAST_AUDITS;
use crate::choice::Accuracy;
use crate::scene::{Scene, Shot};
use crate::simulation::{Motion, RunSettings};
use crate::study::as_planned::cover::CoverRecorder;
use crate::study::as_planned::shot_reason::energy_balance_closes;
use crate::study::compute_settings::step_factor;
use crate::study::{Case, ComputeSettings, Fingerprint, NoResult, ShotSummary, StudyControl, catch_panic};
use crate::verdict::{Limits, Verdict};

/// A shot to sample.
#[derive(Clone, Copy, Debug)]
pub struct ShotToSample<'c> {
    /// The plan.
    pub case: &'c Case,
    /// The planned shot.
    pub shot: &'c Shot,
    /// Check of the planned shot by finer runs; `None` if there is none.
    pub planned: Option<ShotSummary>,
    /// Method and accuracy.
    pub compute: ComputeSettings,
    /// Number of samples and seed.
    pub sampling: Sampling,
    /// Samples at the usual step that other machines drew, in order of their numbers.
    pub precomputed: &'c [Sample],
    /// Whether only a pass is of interest: sampling then ends as soon as no pass can come.
    pub only_pass: bool,
}

impl<'c> ShotToSample<'c> {
    /// A shot that nobody has judged or sampled yet.
    pub fn new(case: &'c Case, shot: &'c Shot, compute: ComputeSettings, sampling: Sampling) -> Self {
        Self { case, shot, planned: None, compute, sampling, precomputed: &[], only_pass: false }
    }

    /// The same shot, with `planned` as the check of its planned shot.
    pub fn with_planned(self, planned: ShotSummary) -> Self {
        Self { planned: Some(planned), ..self }
    }

    /// The same shot, with samples at the usual step that other machines drew, in order of their numbers.
    pub fn with_precomputed(self, precomputed: &'c [Sample]) -> Self {
        Self { precomputed, ..self }
    }

    /// Fingerprint of everything that the samples depend on, except their numbers.
    pub(in crate::study) fn fingerprint(&self) -> Fingerprint {
        Fingerprint::of((self.case.fingerprint(), self.shot, self.compute, self.sampling.seed))
    }

    /// The same shot, but sampling ends as soon as no pass can come. A shot that passes gets all its samples.
    pub fn only_pass(self) -> Self {
        Self { only_pass: true, ..self }
    }
}

/// One sample in so many is audited: 5 %, and more of the first samples.
const AUDIT_EVERY: usize = 20;
const AUDIT_EVERY_AT_FIRST: usize = 10;
/// Number of first samples, of which more are audited: enough for [`LEAST_AUDITS`].
const FIRST_SAMPLES: usize = AUDIT_EVERY_AT_FIRST * LEAST_AUDITS;
/// Number of times that the step of a sample is halved for its audit. The error of the audit is then a sixteenth.
pub(in crate::study) const AUDIT_HALVINGS: u32 = 2;
const AUDIT_STEP_DIVISOR: f64 = (1 << AUDIT_HALVINGS) as f64;

/// Draws one sample and runs it once, without an audit: for a first look at one of many shots.
pub(in crate::study) fn run_sample_once(
    target: &ShotToSample<'_>,
    number: usize,
    control: &StudyControl,
) -> Result<Sample, NoResult> {
    undecided_if_panicked(catch_panic(|| try_sample(target, number, 0, false, control)), number)
}

/// Draws one sample and runs it at a step halved `step_halvings` times. If the sample belongs to the audit, it also runs at a finer
/// step.
pub(in crate::study) fn run_sample(
    target: &ShotToSample<'_>,
    number: usize,
    step_halvings: u32,
    control: &StudyControl,
) -> Result<Sample, NoResult> {
    undecided_if_panicked(catch_panic(|| try_sample(target, number, step_halvings, true, control)), number)
}

/// A sample in which the program panicked is undecided. The other samples go on.
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

/// Longest step of a sample [s]: it resolves a landing.
const LONGEST_STEP: f64 = 2e-3;
/// Greatest step of a sample over the critical step of its own scene. With this step 0.1 % of verdicts are wrong, with a quarter of
/// it none (`benches/RESULTS.md`, "Are the verdicts right?").
const CRITICAL_STEP_FRACTION: f64 = 0.55;
/// Factor on the step of a sample for accuracy `reference`. Draft and field use the same step.
const REFERENCE_STEP_FACTOR: f64 = 0.25;

/// Step of a sample [s]; the fixed step if there is one.
pub(in crate::study) fn sample_step(compute: &ComputeSettings, scene: &Scene) -> f64 {
    let level = if compute.accuracy == Accuracy::Reference { REFERENCE_STEP_FACTOR } else { 1.0 };
    let usual = LONGEST_STEP.min(CRITICAL_STEP_FRACTION * scene.critical_step());
    compute.step.unwrap_or(step_factor(compute.method) * level * usual)
}

/// Number of steps of a sample that ends at `end` [s].
pub fn steps_of_sample(case: &Case, compute: &ComputeSettings, end: f64) -> f64 {
    end / sample_step(compute, case.scene())
}

/// Settings of the run of a sample at `step` [s]. All its firings are shifted by `later` [s].
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
    let (drawn, (run, finer)) = run_worst(target, number, step_halvings, may_audit, control)?;
    Ok(Sample { number, run, finer, inputs: drawn.inputs })
}

/// A sample as it is judged, without its runs. If duds leave the wiring open, this is the wiring that is worst for the shelter. The
/// sample is run to find it.
pub(in crate::study) fn worst_drawn(
    target: &ShotToSample<'_>,
    number: usize,
    step_halvings: u32,
) -> DrawnShot {
    let mut drawn = draw_shots(target.case, target.shot, target.sampling.seed, number);
    let first = drawn.swap_remove(0);
    if drawn.is_empty() {
        return first;
    }
    let worst = run_worst(target, number, step_halvings, false, &StudyControl::default());
    worst.map_or(first, |(worst, _)| worst)
}

/// The run of a sample, and its run at a finer step if it is audited.
type Runs = (SampleRun, Option<SampleRun>);

/// Draws a sample and runs it in each way that the plan leaves open for its wiring. Returns the [worst](worst_of).
fn run_worst(
    target: &ShotToSample<'_>,
    number: usize,
    step_halvings: u32,
    may_audit: bool,
    control: &StudyControl,
) -> Result<(DrawnShot, Runs), NoResult> {
    let ShotToSample { case, shot, sampling, .. } = *target;
    let every = if number < FIRST_SAMPLES { AUDIT_EVERY_AT_FIRST } else { AUDIT_EVERY };
    let is_audited = may_audit && number % every == every / 2;
    let mut drawn = draw_shots(case, shot, sampling.seed, number);
    let runs = drawn.iter().map(|drawn| run_drawn(target, drawn, step_halvings, is_audited, control));
    let (worst, runs) = worst_of(&runs.collect::<Result<Vec<_>, _>>()?, &case.limits);
    Ok((drawn.swap_remove(worst), runs))
}

/// The worst of one or more ways to wire a sample, with its index. A failure comes before an undecided run, then the greatest
/// utilization counts. Each value of the result is the greatest of all ways, and a cable breaks if it breaks in any way. So no
/// limit looks farther away than it may be. A trace of the sample shows the worst way alone.
fn worst_of(all: &[Runs], limits: &Limits) -> (usize, Runs) {
    let finest = |n: usize| all[n].1.unwrap_or(all[n].0);
    let used = |n: usize| finest(n).utilization(limits);
    let worse =
        |a: usize, b: usize| finest(a).verdict.cmp(&finest(b).verdict).then(used(a).total_cmp(&used(b)));
    let worst = (0..all.len()).max_by(|&a, &b| worse(a, b)).unwrap_or(0);
    let (run, finer) = all[worst];
    let greatest_of = |run: SampleRun, others: &mut dyn Iterator<Item = SampleRun>| {
        others.fold(run, |greatest, other| SampleRun {
            verdict: greatest.verdict,
            uncovering: greatest.uncovering.max(other.uncovering),
            breaks: Verdict::worst([greatest.breaks, other.breaks]),
            height: greatest.height.max(other.height),
            force: greatest.force.max(other.force),
            tire: if other.height > greatest.height { other.tire } else { greatest.tire },
            cable: if other.force > greatest.force { other.cable } else { greatest.cable },
            drift: greatest.drift.max(other.drift),
        })
    };
    let coarse = greatest_of(run, &mut all.iter().map(|(run, _)| *run));
    let finer = finer.map(|finer| greatest_of(finer, &mut all.iter().filter_map(|(_, finer)| *finer)));
    (worst, (coarse, finer))
}

/// Runs a sample as `drawn`, at a step halved `step_halvings` times. If it is audited, it also runs at a finer step.
fn run_drawn(
    target: &ShotToSample<'_>,
    drawn: &DrawnShot,
    step_halvings: u32,
    is_audited: bool,
    control: &StudyControl,
) -> Result<Runs, NoResult> {
    let ShotToSample { case, compute, .. } = *target;
    let DrawnShot { scene, shot, later, .. } = drawn;
    // Returns the run, and whether it failed or has no energy balance.
    let run = |step: f64| {
        let settings = sample_settings(case, &compute, step, *later);
        let mut cover = CoverRecorder::new(case, &shot.firings, step);
        let watch = &mut |motion: &dyn Motion| {
            cover.observe(motion);
            control.keep_going()
        };
        match case.model.run_variant(scene, shot, &settings, watch) {
            Ok(outcome) => {
                let run = SampleRun::new(case, shot, &outcome, &cover.cover());
                Ok((run, !energy_balance_closes(outcome.ledger.residual())))
            }
            Err(failure) => match control.no_result(failure) {
                NoResult::Failed(_) => Ok((SampleRun::FAILED_RUN, true)),
                ended => Err(ended),
            },
        }
    };
    let step = sample_step(&compute, scene) * 0.5_f64.powi(step_halvings as i32);
    match compute.step {
        Some(_) => Ok((run(step)?.0, None)),
        None => run_and_audit(step, is_audited, run),
    }
}

/// Runs a sample at `step` [s]. If that run shows nothing, runs it at the step of an audit instead. An audited sample also runs at
/// a still finer step. `run` returns a run, and whether it shows nothing.
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
pub(in crate::study) mod tests {
    use super::*;
    use crate::choice::Method;
    use crate::study::trace::{DrawnSample, TracedShot};

    /// No run is its own audit. Otherwise it would confirm any verdict.
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
                    tire: 0,
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

    /// Two tires, of which one is fired.
    pub fn one_of_two_tires_fired() -> Case {
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

    /// One sample in ten of the first 200 is audited, and one in twenty of the others. The audit runs the sample at a quarter of
    /// its step.
    #[test]
    fn every_twentieth_sample_is_audited_and_more_of_the_first() {
        let (case, control) = (one_of_two_tires_fired(), StudyControl::default());
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
        // If the user fixed the step, there is no finer run.
        let fixed = ComputeSettings { step: Some(1e-3), ..compute };
        let target = ShotToSample { compute: fixed, ..target };
        assert_eq!(run_sample(&target, 5, 0, &control).expect("a sample").finer, None);
    }

    /// The step is 0.55 of the critical step, never longer than 2 ms, a quarter of that for accuracy `reference`, and the fixed
    /// step if there is one.
    #[test]
    fn a_sample_takes_a_step_that_its_scene_allows() {
        let case = one_of_two_tires_fired();
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

    /// A failure counts before an undecided run, however great the utilization of that run. A finer run counts before a coarse run.
    /// A break in a mild run is a break.
    #[test]
    fn the_worst_wiring_is_the_one_that_fails() {
        let limits = one_of_two_tires_fired().limits;
        let run = |verdict, breaks, height| SampleRun {
            verdict,
            uncovering: 0.0,
            breaks,
            height,
            force: 0.0,
            tire: 0,
            cable: 0,
            drift: 0.0,
        };
        let [pass, open, fail] = [Verdict::Pass, Verdict::Undecided, Verdict::Fail];
        let worst = |all: &[Runs]| {
            let (worst, (run, finer)) = worst_of(all, &limits);
            (worst, run.breaks, finer.map(|finer| finer.breaks))
        };
        let [mild, high] = [run(pass, pass, 1.0), run(pass, pass, 2.0)];
        assert_eq!(worst(&[(mild, None)]), (0, pass, None));
        assert_eq!(worst(&[(high, None), (mild, None)]), (0, pass, None));
        assert_eq!(worst(&[(mild, None), (high, None)]), (1, pass, None));
        let unknown = run(open, open, f64::INFINITY);
        assert_eq!(worst(&[(unknown, None), (run(fail, pass, 1.5), None)]), (1, open, None));
        assert_eq!(worst(&[(high, None), (unknown, None)]), (1, open, None));
        assert_eq!(worst(&[(high, None), (run(pass, fail, 1.0), None)]), (0, fail, None));
        // By its finer run, the second way is the worse.
        assert_eq!(worst(&[(high, Some(mild)), (mild, Some(run(pass, fail, 1.5)))]), (1, pass, Some(fail)));
        // The way with the greatest utilization, by its force, flies lower than the other.
        let pulled = SampleRun { force: 0.9 * limits.force, cable: 3, drift: 0.1, ..mild };
        let slid = SampleRun { drift: 7.0, tire: 5, ..high };
        let (_, (run, _)) = worst_of(&[(slid, None), (pulled, None)], &limits);
        assert_eq!((run.height, run.tire, run.drift), (2.0, 5, 7.0));
        assert_eq!((run.force, run.cable), (0.9 * limits.force, 3));
    }

    /// A row that is fired from both ends begins with two holes, and the plan does not say which holes each of them fires. Each
    /// sample is the worst of the possible ways. Its trace shows the way that was judged.
    #[test]
    fn a_sample_counts_the_worst_of_what_its_wiring_leaves_open() {
        let text = r#"
shelter = { layout = "grid", rows = 3, columns = 5, spacing_m = 3 }
tire = { mass_kg = 280, outer_diameter_m = 1.6 }
cable = { axial_stiffness_kn = 600, breaking_force_kn = 60, slack_percent = 5 }
ground = { friction = 0.5 }
blast_row = [{ name = "1", under_row = 1, launch_m_s = 5 }, { name = "2", under_row = 2, launch_m_s = 5 }]
limits = { flight_height_m = 5, cable_safety_factor = 1 }
delay = [{ name = "1", interval_ms = 80, hole_interval_ms = 20, hole_order = "ends", fired_through = true }]
uncertainty = { hole_fails_percent = 10 }
"#;
        let case =
            Case::new(crate::plan::Plan::parse("", text).unwrap_or_else(|mistakes| panic!("{mistakes}")));
        let (control, compute) = (StudyControl::default(), ComputeSettings::of(&case.plan));
        let target = ShotToSample::new(&case, &case.shots[0], compute, Sampling::exactly(40, 1));
        let (mut open, mut changed) = (0, 0);
        for number in 0..40 {
            let sample = run_sample_once(&target, number, &control).expect("a sample").run;
            let runs: Vec<f64> = draw_shots(&case, &case.shots[0], 1, number)
                .iter()
                .map(|DrawnShot { scene, shot, later, .. }| {
                    let settings = sample_settings(&case, &compute, sample_step(&compute, scene), *later);
                    let run = case.model.run_variant(scene, shot, &settings, &mut |_| control.keep_going());
                    let outcome = run.expect("an outcome");
                    (outcome.height.value / case.limits.height).max(outcome.force.value / case.limits.force)
                })
                .collect();
            let worst = runs.iter().copied().fold(0.0, f64::max);
            assert_eq!(sample.utilization(&case.limits), worst, "sample {number} of {runs:?}");
            let drawn = DrawnSample { seed: 1, number, step_halvings: 0 };
            let traced = TracedShot::new(&case, 0, &compute, Some(drawn));
            let outcome = traced.run(&mut |_| control.keep_going()).expect("an outcome");
            let traced =
                (outcome.height.value / case.limits.height).max(outcome.force.value / case.limits.force);
            assert_eq!(traced, worst, "sample {number}");
            open += usize::from(runs.len() > 1);
            changed += usize::from(runs[0] < worst);
        }
        assert!(
            open > 10 && changed > 3,
            "a test that can fail: {open} open, {changed} worse than the first"
        );
    }

    #[test]
    fn a_sample_that_panics_is_undecided_and_a_stop_stays_a_stop() {
        let panicked = undecided_if_panicked(Err(NoResult::Panicked("why".to_owned())), 7).expect("a sample");
        assert_eq!((panicked.number, panicked.run), (7, SampleRun::FAILED_RUN));
        assert_eq!(undecided_if_panicked(Err(NoResult::Stopped), 7), Err(NoResult::Stopped));
    }
}
