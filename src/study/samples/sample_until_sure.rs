//! Draws and runs samples of many shots in rounds, until each risk is sure.

use std::collections::BTreeSet;
use std::ops::{ControlFlow, Range};

use super::run_sample::{ShotToSample, run_sample};
use super::sample::Sample;
use super::sampled_shot::SampledShot;
use crate::study::work::batch::run_batch;
use crate::study::{ComputeResult, Computed, Fingerprint, NoResult, Shard, StudyControl};

impl ShotToSample<'_> {
    /// Numbers of the samples to draw next.
    fn next_round(&self, sampled: &SampledShot) -> Range<usize> {
        let drawn = sampled.samples.len();
        if self.only_pass && !sampled.bounds.can_pass(self.sampling.most) {
            return drawn..drawn;
        }
        self.sampling.next_round(sampled)
    }

    /// Sample `number`, if another machine drew it.
    fn drawn_elsewhere(&self, number: usize) -> Option<&Sample> {
        let found = self.precomputed.binary_search_by_key(&number, |sample| sample.number);
        found.ok().map(|n| &self.precomputed[n])
    }

    /// Number of samples still expected: as many as a pass takes, or as many again as were drawn.
    fn expected(&self, sampled: &SampledShot) -> usize {
        let (drawn, next) = (sampled.samples.len(), self.next_round(sampled).len());
        if next == 0 {
            return 0;
        }
        let all = self.sampling.least.max(USUAL_OF_PASS).max(2 * drawn).min(self.sampling.most);
        all.saturating_sub(drawn).max(next)
    }

    /// Whether the shot may be sampled anew at half the step, after so many halvings: not if the user fixed the step.
    fn may_halve(&self, step_halvings: u32) -> bool {
        self.compute.step.is_none() && step_halvings < MOST_STEP_HALVINGS
    }

    fn no_samples(&self) -> SampledShot {
        SampledShot::new(self.case, self.planned, self.sampling.error_share, self.compute.step.is_none())
    }
}

/// Usual number of samples of a pass.
pub const USUAL_OF_PASS: usize = 500;
/// The accepted risk at which a pass takes so many.
pub const RISK_OF_USUAL: f64 = 0.01;
/// Greatest number of times that a shot is sampled anew at half the step.
const MOST_STEP_HALVINGS: u32 = 3;

/// Draws and runs samples of every shot until its risk is sure.
///
/// The result is partial if the time ran out before a shot had all its samples.
pub fn sample_shots(targets: &[ShotToSample<'_>], control: &StudyControl) -> ComputeResult<Vec<SampledShot>> {
    sample_shots_watched(targets, control, &mut |_, _| ControlFlow::Continue(()))
}

/// Like [`sample_shots`]. `watch` gets every shot after each of its rounds, and may end the sampling of all shots. A result that
/// `watch` ended is not partial.
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
            // Samples count in order. So a result is always the result of the first so many samples.
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

/// Keys of shots in the journal; `None` without a journal.
fn keys(targets: &[ShotToSample<'_>], control: &StudyControl) -> Vec<Option<Fingerprint>> {
    let is_on = control.journal().is_on();
    targets.iter().map(|target| is_on.then(|| target.fingerprint())).collect()
}

/// The sample of [`run_sample`], recalled from the journal if it is there. `key` is the key of the shot.
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

/// Draws and runs the samples of every shot that belong to `shard`; `None` for samples that ran out of time.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::ComputeSettings;
    use crate::study::ShotSummary;
    use crate::study::samples::random_shot::Input;
    use crate::study::samples::run_sample::tests::one_of_two_tires_fired;
    use crate::study::samples::sample::SampleRun;
    use crate::study::samples::sample_count::Sampling;
    use crate::verdict::Verdict;

    /// Samples drawn elsewhere count as they are. Here their audit contradicts them, so all are drawn anew at half the step.
    #[test]
    fn samples_drawn_elsewhere_are_taken_at_the_usual_step_only() {
        let (case, control) = (one_of_two_tires_fired(), StudyControl::default());
        let run = |verdict| SampleRun {
            verdict,
            uncovering: 0.0,
            breaks: verdict,
            height: 1.0,
            force: 1.0,
            tire: 0,
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
        // If the user fixed the step, it is not halved.
        let fixed = ShotToSample { compute: ComputeSettings { step: Some(1e-3), ..compute }, ..target };
        let sampled = sample_shots(&[fixed], &control).expect("samples").value.remove(0);
        assert_eq!((sampled.step_halvings, sampled.samples), (0, made_up.clone()));
    }

    /// A shot is sampled anew three times at most. A shot of which only a pass is of interest is sampled while it can pass.
    #[test]
    fn sampling_ends_where_it_shows_no_more() {
        let case = one_of_two_tires_fired();
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

    /// Two machines together draw every sample of every shot once, as one machine would.
    #[test]
    fn shards_draw_what_one_machine_would() {
        let (case, control) = (one_of_two_tires_fired(), StudyControl::default());
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
}
