//! Mean predictions of a plan near some coordinates of the parameters, and the covariance of observations about them.
//!
//! The motion is not smooth. The prediction of the unchanged plan jumps where a cable catches, and is not the mean under scatter.
//! So samples are drawn. In them the parameters spread a little, inputs in common that are not estimated spread as `[uncertainty]`
//! says, each shot has its own launch factor, and holes and tires scatter. The observed values are regressed on parameters, inputs
//! and factors. This gives
//! 1. the mean prediction and its slopes over the parameters,
//! 2. the covariance of the observations about the mean. It is a sum of five parts: the stated error of each observation, and the
//!    error of the time integration, both independent; the variance from the inputs in common (by their slopes), which ties all
//!    shots together; the variance from the launch factor of a shot (by its slope), which ties the observations of that shot
//!    together; and the covariance of the rest within each shot, which is the scatter from hole to hole. Different shots scatter
//!    independently.
//!
//! Covariances from a finite number of samples tie observations together by chance. So for n observations of a shot, the
//! covariances of the rest move toward 0 by the share n/(n + samples).

use std::ops::Range;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;

use super::observed_shots::{ObservedShot, ObservedShots};
use super::parameter::{Parameter, Prior};
use super::predictor::{Predictor, observe_shot};
use crate::plan::observations::Observation;
use crate::plan::{Plan, Uncertainty};
use crate::study::as_planned::step_error;
use crate::study::samples::random_shot::draw_shot;
use crate::study::samples::run_sample::sample_step;
use crate::study::work::batch::run_batch;
use crate::study::{Case, NoResult};

/// Least number of samples for a mean, its slopes, and its covariance.
const SAMPLES: usize = 96;
/// Least number of samples per observation. Then slopes by chance add a share of 1/4 or less to what the observations say.
const SAMPLES_EACH: usize = 4;
/// Least share of samples with a value that a prediction needs.
const LEAST_KNOWN_SHARE: f64 = 0.5;

/// The covariance of observations about their predictions, and its parts.
pub struct ObservationCovariance {
    /// Error of the time integration of each prediction.
    pub errors: Vec<f64>,
    /// Standard deviation of each observation about its prediction.
    pub sds: Vec<f64>,
    /// Logarithm of the determinant of the covariance.
    pub log_determinant: f64,
    factor: Cholesky<f64, Dyn>,
}

/// Residual of a prediction without a value [standard deviations]: the tire never lifts, or never lands.
const UNKNOWN_VALUE_SDS: f64 = 10.0;

impl ObservationCovariance {
    /// The residuals of predictions, made independent and of unit variance.
    pub fn whitened_residuals(&self, observed: &[Observation], predicted: &[f64]) -> Option<DVector<f64>> {
        let residual = |n: usize| match predicted[n].is_nan() {
            true => UNKNOWN_VALUE_SDS * self.sds[n],
            false => observed[n].value - predicted[n],
        };
        self.factor.l().solve_lower_triangular(&DVector::from_fn(observed.len(), |n, _| residual(n)))
    }

    /// Derivatives of the predictions [their units], made independent and of unit variance (`n_observations` × `n_parameters`).
    pub fn whiten(&self, slopes: &DMatrix<f64>) -> Option<DMatrix<f64>> {
        self.factor.l().solve_lower_triangular(slopes)
    }

    /// The covariance of a range of consecutive observations.
    pub fn of(&self, observations: Range<usize>) -> DMatrix<f64> {
        let (first, count) = (observations.start, observations.len());
        let rows = self.factor.l().rows(first, count).clone_owned();
        &rows * rows.transpose()
    }

    fn new(covariance: DMatrix<f64>, errors: Vec<f64>) -> Option<Self> {
        let sds = covariance.diagonal().iter().map(|variance| variance.sqrt()).collect();
        let factor = covariance.cholesky()?;
        let log_determinant = 2.0 * factor.l_dirty().diagonal().iter().map(|x| x.ln()).sum::<f64>();
        Some(Self { errors, sds, log_determinant, factor })
    }
}

/// Predictions of a plan near some coordinates.
pub struct SampledPrediction {
    /// The mean of each prediction at the coordinates; NaN if most samples have no value.
    pub mean: Vec<f64>,
    /// Derivatives of the mean (`n_observations` × `n_parameters`).
    pub slopes: DMatrix<f64>,
    /// Change of each prediction over a standard deviation of the launch factor of its shot (`n_observations`).
    pub over_shot_factor: DVector<f64>,
    /// The covariance of the observations about the mean.
    pub covariance: ObservationCovariance,
}

/// What predictions depend on, besides the coordinates.
pub struct CovarianceModel<'a> {
    /// The predictions of the parameters.
    pub predictor: &'a Predictor<'a>,
    /// The unchanged plan.
    pub plan: &'a Plan,
    /// Inputs in common that are not estimated, each with its prior.
    pub not_estimated: &'a [(Parameter, Prior)],
    /// Coefficient of variation of launch velocities from shot to shot [%].
    pub between_shots_percent: f64,
    /// The observations.
    pub seen: &'a ObservedShots,
}

impl CovarianceModel<'_> {
    /// The covariance at these coordinates if nothing scatters and all inputs are exact; `None` if the run there fails.
    pub fn without_scatter(&self, at: &[f64]) -> Result<Option<ObservationCovariance>, NoResult> {
        let Some(errors) = self.integration_errors(at)? else { return Ok(None) };
        Ok(ObservationCovariance::new(self.observation_covariance(&errors), errors))
    }

    /// The predictions near the coordinates `at`, from samples with this seed. In the samples each coordinate spreads by its
    /// standard deviation in `spread`. `None` if the run at the coordinates fails.
    pub fn from_samples(
        &self,
        at: &[f64],
        spread: &[f64],
        seed: u64,
    ) -> Result<Option<SampledPrediction>, NoResult> {
        let Some(errors) = self.integration_errors(at)? else { return Ok(None) };
        let shots = self.seen.shots();
        let drawn = SAMPLES.max(SAMPLES_EACH * self.seen.list.len());
        let numbers: Vec<usize> = (0..drawn).collect();
        let samples = run_batch(&numbers, self.predictor.control, |&number| {
            let sample = self.sample(at, spread, shots.len(), seed, number);
            // Each shot has its own seed: scatter in one shot does not repeat in another.
            let observe = |(n, shot): (usize, &ObservedShot)| {
                self.observe_sample(&sample, n, shot, seed.wrapping_add(n as u64), number)
            };
            let runs = shots.iter().enumerate().map(observe).collect::<Result<Vec<_>, _>>()?;
            Ok((sample.deviations, sample.shot_deviations, runs))
        })?;
        let samples: Option<Vec<_>> = samples.into_iter().collect();
        let samples = samples.ok_or(NoResult::OutOfTime)?;
        // Columns: the mean, the parameters, the inputs that are not estimated, the factor of the shot.
        let (count, inputs) = (self.seen.list.len(), 2 + at.len() + self.not_estimated.len());
        let mut values = DMatrix::from_element(drawn, count, f64::NAN);
        for (number, (.., runs)) in samples.iter().enumerate() {
            for (shot, run) in shots.iter().zip(runs) {
                let seen = shot.observations().zip(run.iter().flatten());
                seen.for_each(|(n, &value)| values[(number, n)] = value);
            }
        }
        let is_known = fill_gaps(&mut values);
        let (mut found, mut rest) = (DMatrix::zeros(inputs, count), values.clone());
        for (n, shot) in shots.iter().enumerate() {
            let regressor = |number: usize, input: usize| {
                let (deviations, shot_deviations, _) = &samples[number];
                match input {
                    0 => 1.0,
                    _ if input == inputs - 1 => shot_deviations[n],
                    _ => deviations[input - 1],
                }
            };
            let regressors = DMatrix::from_fn(drawn, inputs, regressor);
            // The small term gives a coordinate that cannot spread the slope 0.
            let normal =
                regressors.transpose() * &regressors + DMatrix::from_diagonal_element(inputs, inputs, 1e-9);
            let Some(factor) = normal.cholesky() else { return Ok(None) };
            let (first, watched) = (shot.first, shot.watched.len());
            let of_shot = factor.solve(&(regressors.transpose() * values.columns(first, watched)));
            let explained = regressors * &of_shot;
            found.columns_mut(first, watched).copy_from(&of_shot);
            let mut unexplained = rest.columns_mut(first, watched);
            unexplained -= explained;
        }
        let mut covariance = self.observation_covariance(&errors);
        let of_not_estimated = found.rows(1 + at.len(), self.not_estimated.len());
        covariance += of_not_estimated.transpose() * of_not_estimated;
        let over_shot_factor = found.row(inputs - 1).transpose();
        let freedom = (drawn - inputs) as f64;
        for shot in &shots {
            let toward_zero = drawn as f64 / (drawn + shot.watched.len()) as f64;
            for (a, b) in itertools::iproduct!(shot.observations(), shot.observations()) {
                let kept = if a == b { 1.0 } else { toward_zero };
                covariance[(a, b)] += kept * rest.column(a).dot(&rest.column(b)) / freedom
                    + over_shot_factor[a] * over_shot_factor[b];
            }
        }
        let mean = (0..count).map(|n| if is_known[n] { found[(0, n)] } else { f64::NAN }).collect();
        // Slopes per coordinate, not per standard deviation of its spread.
        let slopes =
            DMatrix::from_fn(count, at.len(), |n, parameter| found[(1 + parameter, n)] / spread[parameter]);
        let covariance = ObservationCovariance::new(covariance, errors);
        Ok(covariance.map(|covariance| SampledPrediction { mean, slopes, over_shot_factor, covariance }))
    }

    /// Covariance from the stated error of each observation and the integration error of each prediction.
    fn observation_covariance(&self, errors: &[f64]) -> DMatrix<f64> {
        let variance = |n: usize| self.seen.list[n].sd.powi(2) + errors[n].powi(2);
        DMatrix::from_diagonal(&DVector::from_fn(errors.len(), |n, _| variance(n)))
    }

    /// Sample `number`, with a launch factor for each of so many `shots`.
    fn sample(&self, at: &[f64], spread: &[f64], shots: usize, seed: u64, number: usize) -> SampleOfShots {
        let mut random = ChaCha8Rng::seed_from_u64(!seed);
        // Samples come in pairs, one to each side. So a bend of the predictions makes no slope.
        random.set_stream((number / 2) as u64);
        let side = if number.is_multiple_of(2) { 1.0 } else { -1.0 };
        let mut plan = self.plan.clone();
        let mut draw = |parameter: &Parameter, mean: f64, sd: f64| -> f64 {
            let [least, most] = parameter.range(self.plan);
            let normal: f64 = random.sample(StandardNormal);
            let coordinate = (mean + side * sd * normal).clamp(least, most);
            parameter.set_in(&mut plan, coordinate);
            (coordinate - mean) / sd
        };
        let not_estimated: Vec<f64> =
            self.not_estimated.iter().map(|(other, prior)| draw(other, prior.mean, prior.sd)).collect();
        let parameters = self.predictor.parameters.iter().zip(at.iter().zip(spread));
        let mut deviations: Vec<f64> =
            parameters.map(|(parameter, (&mean, &sd))| draw(parameter, mean, sd)).collect();
        deviations.extend(not_estimated);
        let factor = Prior::lognormal(self.between_shots_percent);
        let mut shot_deviation =
            || if factor.sd > 0.0 { side * random.sample::<f64, _>(StandardNormal) } else { 0.0 };
        let shot_deviations: Vec<f64> = (0..shots).map(|_| shot_deviation()).collect();
        let shot_factors =
            shot_deviations.iter().map(|deviation| (factor.mean + factor.sd * deviation).exp()).collect();
        let exact = |value: f64| [value; 2];
        plan.uncertainty = Uncertainty {
            launch_common_percent: 0.0,
            launch_between_shots_percent: 0.0,
            friction: exact(plan.ground.friction),
            slack_percent: exact(plan.cable.slack_percent),
            axial_stiffness_percent: exact(0.0),
            ..plan.uncertainty
        };
        SampleOfShots { case: Case::new(plan), deviations, shot_deviations, shot_factors }
    }

    /// The observed values of the `n`-th shot of a sample; `None` if its run fails.
    fn observe_sample(
        &self,
        sampled: &SampleOfShots,
        n: usize,
        shot: &ObservedShot,
        seed: u64,
        number: usize,
    ) -> Result<Option<Vec<f64>>, NoResult> {
        let Predictor { compute, control, .. } = self.predictor;
        let case = &sampled.case;
        let planned = case.shots[shot.option].with_launches(sampled.shot_factors[n]);
        let sample = draw_shot(case, &planned, seed, number);
        let settings = case.run_settings(compute.method, sample_step(compute, &sample.scene));
        // Back to the time of the plan, in which observations are given.
        let fired = sample.shot.later_by(-sample.later).with_times(&shot.times);
        observe_shot(case, Some(&sample.scene), &fired, &shot.watched, &settings, control)
    }

    /// Error of each prediction, from runs at coarser steps; 0 if no coarser run has the value.
    fn integration_errors(&self, at: &[f64]) -> Result<Option<Vec<f64>>, NoResult> {
        let Some(values) = self.predictor.values(at, 1.0)? else { return Ok(None) };
        let coarser: Vec<f64> =
            (1..=step_error::NEIGHBOURS).map(|n| step_error::RATIO.powi(n as i32)).collect();
        let runs = run_batch(&coarser, self.predictor.control, |&step| self.predictor.values(at, step))?;
        let error = |n: usize| {
            let near =
                coarser.iter().zip(&runs).filter_map(|(&step, run)| Some((step, run.as_ref()?.as_ref()?[n])));
            step_error::estimate(1.0, values[n], near.filter(|(_, value)| value.is_finite()))
        };
        let errors = (0..values.len()).map(error);
        Ok(Some(errors.map(|error| if error.is_finite() { error } else { 0.0 }).collect()))
    }
}

/// One sample of all observed shots.
struct SampleOfShots {
    /// The case. In it only holes and tires still scatter.
    case: Case,
    /// Deviations of the parameters and other inputs from their means [standard deviations of their spread].
    deviations: Vec<f64>,
    /// Deviation of the launch factor of each shot [standard deviations] (`n_shots`).
    shot_deviations: Vec<f64>,
    /// The launch factor of each shot (`n_shots`).
    shot_factors: Vec<f64>,
}

/// Replaces missing values by the mean of their column. Returns whether each column had enough values.
fn fill_gaps(values: &mut DMatrix<f64>) -> Vec<bool> {
    let mut has_often_values = Vec::new();
    for mut column in values.column_iter_mut() {
        let finite: Vec<f64> = column.iter().copied().filter(|value| value.is_finite()).collect();
        let mean = finite.iter().sum::<f64>() / finite.len().max(1) as f64;
        column.iter_mut().filter(|value| !value.is_finite()).for_each(|value| *value = mean);
        has_often_values.push(finite.len() as f64 >= LEAST_KNOWN_SHARE * column.len() as f64);
    }
    has_often_values
}
