//! Finds the schedules that fail least: few samples of all schedules, then ever more samples of ever fewer schedules (successive
//! halving: Karnin, Koren and Somekh 2013).

use super::schedule::Candidate;
use crate::scene::Shot;
use crate::sorting::sort_by;
use crate::study::as_planned::quick_check::quick_check;
use crate::study::samples::run_sample::{ShotToSample, run_sample_once};
use crate::study::samples::sample::SampleRun;
use crate::study::work::batch::run_batch;
use crate::study::{ComputeResult, Computed, Context, Fingerprint, NoResult};
use crate::verdict::Verdict;

/// Least number of schedules that stay to the end.
const LEAST_LEFT: usize = 24;
/// Samples of each schedule that stays to the end.
const MOST_SAMPLES: usize = 256;
/// Weight of the guess from height, force and drift beside the failures [samples].
const WEIGHT_OF_GUESS: f64 = 16.0;

/// Share of the remaining progress that a round takes. The next round has half the schedules and twice the samples.
const SHARE_OF_ROUND: f64 = 0.3;

/// A schedule with its samples so far.
#[derive(Clone, Debug)]
pub struct TriedSchedule {
    /// The schedule.
    pub candidate: Candidate,
    /// The planned shot.
    pub shot: Shot,
    /// Result of its samples.
    pub tally: Tally,
}

impl TriedSchedule {
    /// A schedule without a sample.
    pub fn new(candidate: Candidate, shot: Shot) -> Self {
        Self { candidate, shot, tally: Tally::default() }
    }
}

/// Result of the samples of a schedule.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tally {
    /// Number of samples.
    pub samples: usize,
    /// Number of samples that fail or are undecided.
    pub failures: usize,
    /// Sum, sum of squares, and number of the known utilizations.
    utilization: [f64; 3],
}

impl Tally {
    fn push(&mut self, verdict: Verdict, utilization: f64) {
        self.samples += 1;
        self.failures += usize::from(verdict != Verdict::Pass);
        if utilization.is_finite() {
            let [sum, squares, count] = &mut self.utilization;
            *sum += utilization;
            *squares += utilization * utilization;
            *count += 1.0;
        }
    }

    /// Guess of the failing share. While few samples fail, or none, the utilizations say more than the failures. A normal
    /// distribution with their mean and deviation has a share above 1. That share counts like [`WEIGHT_OF_GUESS`] samples.
    pub fn estimated_failing_share(&self) -> f64 {
        let [sum, squares, count] = self.utilization;
        if count == 0.0 {
            return 1.0;
        }
        let mean = sum / count;
        let deviation = (squares / count - mean * mean).max(0.0).sqrt().max(1e-9 * mean);
        let above = 0.5 * libm::erfc((1.0 - mean) / (deviation * std::f64::consts::SQRT_2));
        // A single run of the planned shot has no deviation. Then the schedules are sorted by their utilization.
        if self.samples < 2 {
            return mean;
        }
        (self.failures as f64 + WEIGHT_OF_GUESS * above) / (self.samples as f64 + WEIGHT_OF_GUESS)
    }
}

/// Runs samples of every schedule until it has `samples` of them. Without a sampling it runs the planned shot.
pub fn run_samples(context: &Context<'_>, tried: &mut [TriedSchedule], samples: usize) -> ComputeResult<()> {
    // A planned shot is checked once.
    let samples = if context.sampling.is_some() { samples } else { 1 };
    let jobs: Vec<&TriedSchedule> = tried.iter().filter(|trial| trial.tally.samples < samples).collect();
    let drawn = run_batch(&jobs, context.control, |trial| {
        let runs = runs(context, trial, samples)?;
        let shares = runs.iter().map(|(_, share)| *share).filter(|share| share.is_finite());
        context.control.note_tried(trial.shot.duration(), shares.fold(0.0, f64::max));
        Ok(runs)
    })?;
    let partial = drawn.contains(&None);
    let waiting = tried.iter_mut().filter(|trial| trial.tally.samples < samples);
    for (trial, runs) in waiting.zip(drawn) {
        for (verdict, utilization) in runs.into_iter().flatten() {
            trial.tally.push(verdict, utilization);
        }
    }
    Ok(Computed { value: (), partial })
}

/// Verdict and utilization of the next samples of a schedule; without a sampling, of the planned shot.
fn runs(
    context: &Context<'_>,
    schedule: &TriedSchedule,
    samples: usize,
) -> Result<Vec<(Verdict, f64)>, NoResult> {
    let (&Context { case, compute, sampling, control }, shot) = (context, &schedule.shot);
    let Some(sampling) = sampling else {
        return match quick_check(context, shot) {
            Ok(judged) => Ok(vec![(judged.verdict, judged.utilization(&case.limits))]),
            Err(NoResult::Failed(_)) => Ok(vec![(Verdict::Undecided, f64::INFINITY)]),
            Err(ended) => Err(ended),
        };
    };
    let target = ShotToSample::new(case, shot, compute, sampling);
    let run_sample = |number: usize| -> Result<(Verdict, f64), NoResult> {
        let run: SampleRun = run_sample_once(&target, number, control)?.run;
        Ok((run.verdict, run.utilization(&case.limits)))
    };
    let numbers = schedule.tally.samples..samples;
    control.journal().recall_or(
        || Fingerprint::of(("halving", target.fingerprint(), &numbers)),
        || numbers.clone().map(run_sample).collect(),
    )
}

/// Sorts the schedules, best first. It draws `first` samples of each, then twice as many samples of each better half, and so on.
pub fn halve(context: &Context<'_>, tried: &mut [TriedSchedule], first: usize) -> ComputeResult<()> {
    let (mut samples, mut left) = (first, tried.len());
    loop {
        let _round = context.control.part(SHARE_OF_ROUND);
        let drawn = run_samples(context, &mut tried[..left], samples)?;
        sort_by(&mut tried[..left], |a, b| {
            a.tally.estimated_failing_share().total_cmp(&b.tally.estimated_failing_share())
        });
        if drawn.partial || samples >= MOST_SAMPLES || context.sampling.is_none() {
            return Ok(drawn);
        }
        left = left.min((left / 2).max(LEAST_LEFT));
        samples *= 2;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// With utilizations of 0.8 ± 0.1, a share of 2.3 % lies above 1, though none of 16 samples does.
    #[test]
    fn utilizations_tell_before_failures_do() {
        let score = |low: f64, high: f64, failures: usize| {
            let mut tally = Tally::default();
            for n in 0..16 {
                let verdict = if n < failures { Verdict::Fail } else { Verdict::Pass };
                tally.push(verdict, if n % 2 == 0 { low } else { high });
            }
            tally.estimated_failing_share()
        };
        assert!((score(0.7, 0.9, 0) - 0.5 * 0.02275).abs() < 1e-4);
        assert!(score(0.5, 0.7, 0) < score(0.7, 0.9, 0));
        assert!(score(0.7, 0.9, 0) < score(0.5, 0.7, 1), "one failure of 16 outweighs a guess");
    }
}
