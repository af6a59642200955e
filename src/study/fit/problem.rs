//! A fit in progress: residuals, answers near minima, and the contents of an answer.

use nalgebra::{DMatrix, DVector};

use super::answer::{Answer, FittedParameter, Residual};
use super::covariance::{CovarianceModel, ObservationCovariance, SampledPrediction};
use super::observed_shots::{ObservedShot, ObservedShots};
use super::parameter::{Parameter, Prior};
use super::predictor::Predictor;
use super::refined_answer::RefinedAnswer;
use super::search::{Minimum, SearchBox};
use crate::plan::Plan;
use crate::sorting::sort_by;
use crate::study::work::batch::run_batch;
use crate::study::{Case, NoResult};

/// Another answer is reported if its misfit is at most this much above the least: its likelihood is then 1/20 of the best.
const NEARLY_EQUAL: f64 = 6.0;

/// The same bound for answers that are not final yet.
const WORTH_REFINING: f64 = 40.0;

/// Greatest number of answers that are made final.
const MOST_REFINED: usize = 6;

/// A fit in progress.
pub(super) struct FitProblem<'p> {
    pub predictor: Predictor<'p>,
    pub space: SearchBox,
    pub priors: Vec<Option<Prior>>,
    pub not_estimated: Vec<(Parameter, Prior)>,
    /// Coefficient of variation of launch velocities from shot to shot [%].
    pub between_shots_percent: f64,
    pub seen: ObservedShots,
    pub seed: Option<u64>,
}

/// Spread of the samples about an answer, over its standard deviation: wide enough that the scatter of the samples hardly blurs the
/// slopes.
const SPREAD: f64 = 1.5;

/// Least and greatest spread, as a share of the range.
const SPREADS: [f64; 2] = [5e-3, 0.15];

/// Greatest number of times that samples are drawn about an answer.
const MOST_ROUNDS: usize = 6;

/// Shares of the remaining progress for the covariance and for the search of minima. The answers near the minima take the rest.
const SHARE_OF_SAMPLES: f64 = 0.1;
const SHARE_OF_SEARCH: f64 = 0.3;

impl FitProblem<'_> {
    /// Where the search begins: at the means that the plan states, or at its own numbers.
    pub fn start_coordinates(&self, plan: &Plan) -> Vec<f64> {
        let start = |(n, parameter): (usize, &Parameter)| {
            let planned = || parameter.planned(plan).map(|planned| parameter.coordinate(planned));
            // Stiff ends begin at the stiff end of their range.
            self.priors[n].map(|prior| prior.mean).or_else(planned).unwrap_or(self.space.ranges[n][1])
        };
        self.predictor.parameters.iter().enumerate().map(start).collect()
    }

    /// Independent residuals of unit variance: first of the observations, then of the priors.
    fn residuals(
        &self,
        at: &[f64],
        covariance: &ObservationCovariance,
    ) -> Result<Option<DVector<f64>>, NoResult> {
        let Some(predicted) = self.predictor.values(at, 1.0)? else { return Ok(None) };
        let Some(of_observations) = covariance.whitened_residuals(&self.seen.list, &predicted) else {
            return Ok(None);
        };
        let stated = self
            .priors
            .iter()
            .zip(at)
            .filter_map(|(prior, at)| prior.map(|prior| (at - prior.mean) / prior.sd));
        let all: Vec<f64> = of_observations.iter().copied().chain(stated).collect();
        Ok(Some(DVector::from_vec(all)))
    }

    /// Answers of nearly equal misfit, the best first.
    pub fn answers(&self, case: &Case) -> Result<Vec<RefinedAnswer>, NoResult> {
        let start = self.start_coordinates(&case.plan);
        let model = CovarianceModel {
            predictor: &self.predictor,
            plan: &case.plan,
            not_estimated: &self.not_estimated,
            between_shots_percent: self.between_shots_percent,
            seen: &self.seen,
        };
        let control = self.predictor.control;
        let sampling = control.part(SHARE_OF_SAMPLES);
        let covariance = match self.seed {
            Some(seed) => {
                model.from_samples(&start, &self.sample_spread(|_| 0.0), seed)?.map(|local| local.covariance)
            }
            None => model.without_scatter(&start)?,
        };
        let covariance = covariance.ok_or_else(|| self.failure(&start))?;
        drop(sampling);
        let searching = control.part(SHARE_OF_SEARCH);
        let minima = self.space.minima(&start, &|at| self.residuals(at, &covariance), control)?;
        drop(searching);
        let _settling = control.part(1.0);
        let least = minima.first().map_or(f64::INFINITY, |best| best.misfit);
        let is_worth = |minimum: &Minimum| minimum.misfit <= least + WORTH_REFINING;
        let worth: Vec<Minimum> = minima.into_iter().take_while(is_worth).take(MOST_REFINED).collect();
        let refined = run_batch(&worth, control, |minimum| match self.seed {
            Some(seed) => self.settle_among_samples(&model, minimum, seed),
            None => self.converge(&model, minimum),
        })?;
        let refined: Option<Vec<Option<RefinedAnswer>>> = refined.into_iter().collect();
        let mut refined: Vec<RefinedAnswer> =
            refined.ok_or(NoResult::OutOfTime)?.into_iter().flatten().collect();
        sort_by(&mut refined, |a, b| a.unlikelihood().total_cmp(&b.unlikelihood()));
        let least = refined.first().map(RefinedAnswer::unlikelihood).ok_or_else(|| self.failure(&start))?;
        refined.retain(|answer| answer.unlikelihood() <= least + NEARLY_EQUAL);
        Ok(refined.into_iter().fold(Vec::new(), |mut all: Vec<RefinedAnswer>, refined| {
            if !all.iter().any(|known| known.minimum.is_same(&refined.minimum)) {
                all.push(refined);
            }
            all
        }))
    }

    /// Spread of the samples for the standard deviations `sd` of the coordinates.
    fn sample_spread(&self, sd: impl Fn(usize) -> f64) -> Vec<f64> {
        let of_range = |(n, [low, high]): (usize, &[f64; 2])| {
            let [least, most] = SPREADS.map(|share| share * (high - low));
            (SPREAD * sd(n)).clamp(least, most)
        };
        self.space.ranges.iter().enumerate().map(of_range).collect()
    }

    /// The answer near a minimum if nothing scatters.
    fn converge(
        &self,
        model: &CovarianceModel<'_>,
        minimum: &Minimum,
    ) -> Result<Option<RefinedAnswer>, NoResult> {
        let Some(covariance) = model.without_scatter(&minimum.point)? else { return Ok(None) };
        let Some(minimum) = self.space.refine(&minimum.point, &|at| self.residuals(at, &covariance))? else {
            return Ok(None);
        };
        let Some(predicted) = self.predictor.values(&minimum.point, 1.0)? else { return Ok(None) };
        let slopes = self.slopes(&minimum, &predicted)?;
        let over_shot_factor = DVector::zeros(predicted.len());
        Ok(Some(RefinedAnswer {
            minimum,
            predicted,
            slopes,
            over_shot_factor,
            covariance,
            is_converged: true,
        }))
    }

    /// The answer near a minimum for the mean predictions under scatter. Samples about an answer give the mean, its slopes and the
    /// covariance of the observations. These give the next answer.
    fn settle_among_samples(
        &self,
        model: &CovarianceModel<'_>,
        minimum: &Minimum,
        seed: u64,
    ) -> Result<Option<RefinedAnswer>, NoResult> {
        let count = minimum.point.len();
        let (mut at, mut spread) = (minimum.point.clone(), self.sample_spread(|n| minimum.sd(n)));
        let mut refined = None;
        for _ in 0..MOST_ROUNDS {
            let Some(SampledPrediction { mean, slopes, over_shot_factor, covariance }) =
                model.from_samples(&at, &spread, seed)?
            else {
                break;
            };
            let (Some(residuals), Some(whitened)) =
                (covariance.whitened_residuals(&self.seen.list, &mean), covariance.whiten(&slopes))
            else {
                break;
            };
            let mut precision = whitened.transpose() * &whitened;
            let mut pull = whitened.transpose() * &residuals;
            for n in 0..count {
                if let Some(prior) = self.priors[n] {
                    precision[(n, n)] += prior.sd.powi(-2);
                    pull[n] += (prior.mean - at[n]) / prior.sd.powi(2);
                }
            }
            let of_coordinates = self.space.inverse(precision);
            let step = &of_coordinates * pull;
            // The straight line holds no farther than the samples spread.
            let share = (0..count).map(|n| step[n].abs() / (2.0 * spread[n])).fold(1.0, f64::max);
            let next: Vec<f64> = (0..count).map(|n| at[n] + step[n] / share).collect();
            let next = self.space.clamped(&next);
            let moved = DVector::from_fn(count, |n, _| next[n] - at[n]);
            let stated = self
                .priors
                .iter()
                .zip(&next)
                .filter_map(|(prior, at)| prior.map(|prior| ((at - prior.mean) / prior.sd).powi(2)));
            let misfit = (residuals - whitened * &moved).norm_squared() + stated.sum::<f64>();
            let predicted =
                mean.iter().zip((&slopes * &moved).iter()).map(|(mean, change)| mean + change).collect();
            let minimum = Minimum { point: next, misfit, covariance: of_coordinates };
            let wanted = self.sample_spread(|n| minimum.sd(n));
            // Samples about the next answer would show the same: it lies well inside the present samples, which spread as far.
            let is_near =
                |n: usize| moved[n].abs() <= 0.3 * spread[n] && (wanted[n] / spread[n]).ln().abs() < 0.4;
            let is_converged = (0..count).all(is_near);
            (at, spread) = (minimum.point.clone(), wanted);
            refined = Some(RefinedAnswer {
                minimum,
                predicted,
                slopes,
                over_shot_factor,
                covariance,
                is_converged,
            });
            if is_converged {
                break;
            }
        }
        Ok(refined)
    }

    /// The reason why the run at these coordinates fails.
    pub fn failure(&self, at: &[f64]) -> NoResult {
        let case = self.predictor.case(at);
        let settings =
            case.run_settings(self.predictor.compute.method, self.predictor.compute.first_step(&case));
        let run = |shot: &ObservedShot| {
            let watch = &mut |_: &dyn crate::simulation::Motion| self.predictor.control.keep_going();
            case.model.run(&case.shots[shot.option].with_times(&shot.times), &settings, watch).err()
        };
        let failure = self.predictor.shots.iter().find_map(run);
        failure.map_or(NoResult::OutOfTime, |failure| self.predictor.control.no_result(failure))
    }

    /// Derivatives of the predictions at a minimum; `values` are the predictions there.
    fn slopes(&self, minimum: &Minimum, values: &[f64]) -> Result<DMatrix<f64>, NoResult> {
        let predictions = |at: &[f64]| Ok(self.predictor.values(at, 1.0)?.map(DVector::from_vec));
        let difference = |n: usize| {
            let [low, high] = self.space.ranges[n];
            minimum.sd(n).clamp(1e-3 * (high - low), 0.1 * (high - low))
        };
        let difference: Vec<f64> = (0..minimum.point.len()).map(difference).collect();
        let values = DVector::from_column_slice(values);
        let slopes = self.space.slopes(&minimum.point, &values, &difference, &predictions)?;
        Ok(slopes.map(|slope| if slope.is_finite() { slope } else { 0.0 }))
    }

    pub fn answer(&self, case: &Case, refined: &RefinedAnswer) -> Answer {
        let RefinedAnswer { minimum, predicted, covariance, .. } = refined;
        let parameters = &self.predictor.parameters;
        let count = parameters.len();
        let estimate = |n: usize| {
            let (parameter, at, [low, high]) = (parameters[n], minimum.point[n], self.space.ranges[n]);
            let near_end = 1e-6 * (high - low);
            FittedParameter {
                parameter,
                value: parameter.value(at),
                sd: parameter.sd_of_value(at, minimum.sd(n)),
                was: parameter.planned(&case.plan),
                from_stated: self.priors[n].map(|prior| (at - prior.mean) / prior.sd),
                is_at_end: at - low <= near_end || high - at <= near_end,
            }
        };
        let correlation = |a: usize, b: usize| minimum.covariance[(a, b)] / (minimum.sd(a) * minimum.sd(b));
        let residual = |n: usize| Residual {
            predicted: predicted[n],
            sd: covariance.sds[n],
            deviation: (self.seen.list[n].value - predicted[n]) / covariance.sds[n],
            error: covariance.errors[n],
        };
        let stated = self.priors.iter().flatten().count();
        Answer {
            is_converged: refined.is_converged,
            estimates: (0..count).map(estimate).collect(),
            correlation: (0..count).map(|a| (0..count).map(|b| correlation(a, b)).collect()).collect(),
            residuals: (0..predicted.len()).map(residual).collect(),
            chi_square: minimum.misfit,
            freedom: (predicted.len() + stated).saturating_sub(count),
        }
    }
}
