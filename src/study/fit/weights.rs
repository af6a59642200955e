//! How far the observations of a shot may lie from what the plan predicts, for reasons other than the parameters.
//!
//! The covariance of the observations is the sum of four:
//! 1. what was stated of each observation, and
//! 2. the error of the time integration, both independent;
//! 3. scatter from hole to hole and from tire to tire, as `[uncertainty]` has it: from [`SAMPLES`] samples of each shot in which the
//!    inputs in common are held. The samples of a shot give covariances too, which are drawn toward 0 by the share n/(n + samples)
//!    for n observations, so that chance does not tie observations together. Different shots are independent;
//! 4. inputs in common that are not estimated: their slopes over one standard deviation to each side, times their variance. They tie
//!    all shots together.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::parameter::{Parameter, Prior};
use super::predict::{Predictor, seen};
use crate::plan::Uncertainty;
use crate::plan::observations::Observation;
use crate::study::as_planned::step_error;
use crate::study::samples::draw::draw;
use crate::study::samples::rounds::step;
use crate::study::work::batch::run_jobs;
use crate::study::{Case, NoResult};

/// Samples of each shot behind the scatter from hole to hole.
const SAMPLES: usize = 64;

/// Observations, each with the number of its file, in the order of their options.
pub struct Seen {
    /// The observations.
    pub list: Vec<Observation>,
    /// Index of the file of each.
    pub file: Vec<usize>,
}

impl Seen {
    /// Indices of the observations of each shot: of one option in one file.
    fn shots(&self) -> Vec<Vec<usize>> {
        let mut shots: Vec<((usize, usize), Vec<usize>)> = Vec::new();
        for (n, observation) in self.list.iter().enumerate() {
            let shot = (self.file[n], observation.option);
            match shots.iter_mut().find(|(known, _)| *known == shot) {
                Some((_, all)) => all.push(n),
                None => shots.push((shot, vec![n])),
            }
        }
        shots.into_iter().map(|(_, all)| all).collect()
    }
}

/// The covariance of observations about their predictions, and its parts.
pub struct Weights {
    /// Error of the time integration of each prediction.
    pub errors: Vec<f64>,
    /// Standard deviation of each observation about its prediction.
    pub sds: Vec<f64>,
    /// Logarithm of the determinant of the covariance.
    pub log_determinant: f64,
    factor: Cholesky<f64, Dyn>,
}

/// Residual, in standard deviations, of a prediction that has no value: the tire never lifts, or never lands.
const NEVER: f64 = 10.0;

impl Weights {
    /// The residuals of predictions, made independent and of unit variance.
    pub fn whitened(&self, observed: &[Observation], predicted: &[f64]) -> Option<DVector<f64>> {
        let residual = |n: usize| match predicted[n].is_nan() {
            true => NEVER * self.sds[n],
            false => observed[n].value - predicted[n],
        };
        self.factor.l().solve_lower_triangular(&DVector::from_fn(observed.len(), |n, _| residual(n)))
    }

    /// Derivatives of the predictions [their units], likewise (`n_observations` × `n_parameters`).
    pub fn whiten(&self, slopes: &DMatrix<f64>) -> Option<DMatrix<f64>> {
        self.factor.l().solve_lower_triangular(slopes)
    }
}

/// What the weights depend on besides the coordinates.
pub struct Weighing<'a> {
    /// The predictions of the parameters.
    pub predictor: &'a Predictor<'a>,
    /// Inputs in common that are not estimated, each with what the plan knows of it.
    pub others: &'a [(Parameter, Prior)],
    /// The observations.
    pub seen: &'a Seen,
    /// Seed of the samples; `None`: nothing scatters.
    pub seed: Option<u64>,
}

impl Weighing<'_> {
    /// The weights at these coordinates; `None` where the run there fails.
    pub fn weights(&self, at: &[f64]) -> Result<Option<Weights>, NoResult> {
        let Some(errors) = self.integration_errors(at)? else { return Ok(None) };
        let list = &self.seen.list;
        let mut covariance = DMatrix::from_diagonal(&DVector::from_fn(list.len(), |n, _| {
            list[n].sd.powi(2) + errors[n].powi(2)
        }));
        if let Some(seed) = self.seed {
            self.add_scatter(at, seed, &mut covariance)?;
            self.add_others(at, &mut covariance)?;
        }
        let sds = covariance.diagonal().iter().map(|variance| variance.sqrt()).collect();
        let Some(factor) = covariance.cholesky() else { return Ok(None) };
        let log_determinant = 2.0 * factor.l_dirty().diagonal().iter().map(|x| x.ln()).sum::<f64>();
        Ok(Some(Weights { errors, sds, log_determinant, factor }))
    }

    /// Error of each prediction, from runs at coarser steps; 0 where none of these has the value.
    fn integration_errors(&self, at: &[f64]) -> Result<Option<Vec<f64>>, NoResult> {
        let Some(values) = self.predictor.values(at, 1.0)? else { return Ok(None) };
        let coarser: Vec<f64> =
            (1..=step_error::NEIGHBOURS).map(|n| step_error::RATIO.powi(n as i32)).collect();
        let runs = run_jobs(&coarser, self.predictor.progress, |&step| self.predictor.values(at, step))?;
        let error = |n: usize| {
            let near =
                coarser.iter().zip(&runs).filter_map(|(&step, run)| Some((step, run.as_ref()?.as_ref()?[n])));
            step_error::estimate(1.0, values[n], near.filter(|(_, value)| value.is_finite()))
        };
        Ok(Some(
            (0..values.len()).map(error).map(|error| if error.is_finite() { error } else { 0.0 }).collect(),
        ))
    }

    fn add_scatter(&self, at: &[f64], seed: u64, covariance: &mut DMatrix<f64>) -> Result<(), NoResult> {
        let case = with_holes_alone(&self.predictor.case(at));
        if !scatters(&case.plan.uncertainty) {
            return Ok(());
        }
        let compute = self.predictor.compute;
        let shots = self.seen.shots();
        let jobs: Vec<(usize, usize)> = itertools::iproduct!(0..shots.len(), 0..SAMPLES).collect();
        let runs = run_jobs(&jobs, self.predictor.progress, |&(shot, number)| {
            let option = self.seen.list[shots[shot][0]].option;
            let watched: Vec<_> = shots[shot].iter().map(|&n| self.seen.list[n].watched).collect();
            // A seed for each shot: what scatters in one does not repeat in another.
            let sample = draw(&case, &case.shots[option], seed.wrapping_add(shot as u64), number);
            let settings = case.run_settings(compute.method, step(&compute, &sample.scene));
            seen(&case, Some(&sample.scene), &sample.shot, &watched, &settings, self.predictor.progress)
        })?;
        if runs.contains(&None) {
            return Err(NoResult::OutOfTime);
        }
        for (observations, runs) in shots.iter().zip(runs.chunks(SAMPLES)) {
            let samples: Vec<&Vec<f64>> = runs.iter().flatten().flatten().collect();
            let toward_zero = samples.len() as f64 / (samples.len() + observations.len()) as f64;
            for (i, &a) in observations.iter().enumerate() {
                for (j, &b) in observations.iter().enumerate() {
                    let kept = if i == j { 1.0 } else { toward_zero };
                    covariance[(a, b)] +=
                        kept * covariance_of(samples.iter().map(|sample| [sample[i], sample[j]]));
                }
            }
        }
        Ok(())
    }

    fn add_others(&self, at: &[f64], covariance: &mut DMatrix<f64>) -> Result<(), NoResult> {
        let Predictor { plan, parameters, options, compute, progress } = self.predictor;
        let beside = |&(other, side): &(usize, f64)| {
            let (parameter, prior) = self.others[other];
            let mut plan = plan.clone();
            if parameter.unknown == crate::choice::Unknown::Launch {
                parameter.put_into(&mut plan, side * prior.sd);
            } else {
                let [least, most] = parameter.range(&plan);
                parameter.put_into(&mut plan, (prior.mean + side * prior.sd).clamp(least, most));
            }
            let (parameters, options) = (parameters.clone(), options.clone());
            Predictor { plan, parameters, options, compute: *compute, progress }.values(at, 1.0)
        };
        let jobs: Vec<(usize, f64)> = itertools::iproduct!(0..self.others.len(), [1.0, -1.0]).collect();
        let runs = run_jobs(&jobs, progress, beside)?;
        if runs.contains(&None) {
            return Err(NoResult::OutOfTime);
        }
        for pair in runs.chunks(2) {
            let [Some(Some(more)), Some(Some(less))] = pair else { continue };
            let half = DVector::from_fn(more.len(), |n, _| 0.5 * (more[n] - less[n]));
            let known = half.map(|change| if change.is_finite() { change } else { 0.0 });
            *covariance += &known * known.transpose();
        }
        Ok(())
    }
}

/// The case whose inputs in common are known exactly, so that only holes and tires scatter.
fn with_holes_alone(case: &Case) -> Case {
    let mut plan = case.plan.clone();
    let exact = |value: f64| [value; 2];
    plan.uncertainty = Uncertainty {
        launch_common_percent: 0.0,
        friction: exact(plan.ground.friction),
        slack_percent: exact(plan.cable.slack_percent),
        axial_stiffness_percent: exact(0.0),
        ..plan.uncertainty
    };
    Case::new(plan)
}

/// Whether anything scatters from hole to hole or from tire to tire.
fn scatters(unknown: &Uncertainty) -> bool {
    let Uncertainty { launch_cv_percent, launch_tilt_deg, tire_mass_cv_percent, delay, .. } = *unknown;
    [launch_cv_percent, launch_tilt_deg, tire_mass_cv_percent, delay.sd_ms, delay.cv_percent]
        .iter()
        .any(|&x| x > 0.0)
}

/// Covariance of pairs, without those of which a value is missing; 0 for fewer than two.
fn covariance_of(pairs: impl Iterator<Item = [f64; 2]>) -> f64 {
    let pairs: Vec<[f64; 2]> = pairs.filter(|pair| pair.iter().all(|value| value.is_finite())).collect();
    let count = pairs.len() as f64;
    let mean = |n: usize| pairs.iter().map(|pair| pair[n]).sum::<f64>() / count;
    let [a, b] = [mean(0), mean(1)];
    if pairs.len() < 2 {
        0.0
    } else {
        pairs.iter().map(|[x, y]| (x - a) * (y - b)).sum::<f64>() / (count - 1.0)
    }
}
