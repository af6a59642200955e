//! What observations of earlier shots tell of launch velocities and other unknowns.
//!
//! Weighted least squares: of the parameters within plausible ranges those whose predictions fit the observations best; what
//! `[uncertainty]` of the plan states of them counts as observations. The weights are those of [`weights`], first at the plan, then
//! at each answer. Inputs that are not estimated are not taken for exact: they weaken the weights.
//!
//! | question | where |
//! |---|---|
//! | what is found | `answer` |
//! | which numbers are estimated, and what the plan knows of them | [`parameter`] |
//! | what a plan predicts | `predict`, `watch` |
//! | how far observations may lie from it | [`weights`] |
//! | which parameters fit best, in which separate answers | [`search`] |
//! | whether observations determine them | [`determined`] |
//! | how observations lie among the shots that were possible, and what to observe next | [`possible`] |

mod answer;
pub mod determined;
pub mod parameter;
pub mod possible;
mod predict;
pub mod search;
mod watch;
pub mod weights;

use nalgebra::{DMatrix, DVector};

pub use self::answer::{Answer, Estimated, Fit, FitResult, Residual};
pub use self::determined::{Candidate, NotDetermined};
use self::parameter::{Parameter, Prior};
use self::possible::{NextObservation, as_fired, next_observation};
use self::predict::Predictor;
use self::search::{Minimum, SearchBox};
use self::weights::{ObservedShots, SampledWeights, Weighing, Weights};
use super::samples::sampling::Sampling;
use super::work::batch::run_jobs;
use super::{Case, ComputeSettings, Finding, Found, NoResult, Progress};
use crate::choice::{Method, Unknown};
use crate::plan::Plan;
use crate::plan::fitted::StatedKeys;
use crate::plan::observations::{ObservableNames, Observation, Observations, Watched};
use crate::scene::TireId;

/// What observations of a plan may name.
pub fn observable_names(case: &Case) -> ObservableNames {
    let scene = case.scene();
    ObservableNames {
        options: case.plan.delays.iter().map(|delay| delay.name.clone()).collect(),
        tires: scene.tire.iter().map(TireId::numbers).collect(),
        cables: scene.cables.iter().map(|cable| cable.ends).collect(),
    }
}

/// Misfit above the least up to which another answer is told: its likelihood is 1/20 of the best.
const NEARLY_EQUAL: f64 = 6.0;
/// The same for answers whose weights are yet to be found.
const WORTH_WEIGHING: f64 = 40.0;
/// Most answers that are weighed.
const MOST_WEIGHED: usize = 6;

/// What is asked of a fit.
#[derive(Clone, Copy, Debug)]
pub struct Request<'a> {
    /// Files of observations.
    pub files: &'a [Observations],
    /// What is estimated, each once.
    pub unknowns: &'a [Unknown],
    /// Samples of what the plan does not know; `None`: all but the unknowns is taken for exact, and nothing is known of these
    /// beforehand.
    pub sampling: Option<Sampling>,
}

/// Fits unknowns of a plan to observations.
pub fn fit(
    case: &Case,
    request: &Request<'_>,
    compute: &ComputeSettings,
    progress: &Progress,
) -> Finding<FitResult> {
    let parameters = Parameter::all(request.unknowns, &case.plan);
    let priors = match stated_priors(case, request, &parameters) {
        Ok(priors) => priors,
        Err(unknown) => return Ok(whole(FitResult::KnownExactly(unknown))),
    };
    if compute.method == Method::Newmark && request.unknowns.contains(&Unknown::Damping) {
        return Ok(whole(FitResult::NotInMethod(Unknown::Damping)));
    }
    let seen = in_order(request.files);
    let fitting = Fitting {
        space: search_box(&case.plan, &parameters, &priors),
        predictor: Predictor {
            plan: plan_of_others(case, request),
            options: by_option(&seen.list),
            parameters,
            compute: *compute,
            progress,
        },
        others: others(case, request),
        priors,
        seen,
        seed: request.sampling.map(|sampling| sampling.seed),
    };
    let settled = fitting.answers(case)?;
    let best = &settled[0];
    let slopes = best.weights.whiten(&best.slopes).unwrap_or_else(|| best.slopes.clone());
    let own = fitting.start_coordinates(&case.plan);
    if let Some(refused) = determined::refuse(&fitting.predictor, &fitting.space, &own, &slopes)? {
        return Ok(whole(FitResult::NotDetermined(refused)));
    }
    let answers = settled.iter().map(|settled| fitting.answer(case, settled)).collect();
    let ObservedShots { list: observed, file } = fitting.seen;
    let as_fired = as_fired(case, &observed, request.sampling.as_ref(), compute, progress)?;
    let mut fit = Fit { answers, observed, file, as_fired, next: None };
    fit.next = next(case, &fit, request, compute, progress)?;
    Ok(whole(FitResult::Fitted(fit)))
}

fn whole(value: FitResult) -> Found<FitResult> {
    Found { value, partial: false }
}

/// Observations of all files in the order of their options.
fn in_order(files: &[Observations]) -> ObservedShots {
    let of_file =
        |(n, file): (usize, &Observations)| file.list.iter().map(move |seen| (n, *seen)).collect::<Vec<_>>();
    let mut all: Vec<(usize, Observation)> = files.iter().enumerate().flat_map(of_file).collect();
    all.sort_by_key(|(_, seen)| seen.option);
    let (file, list) = all.into_iter().unzip();
    ObservedShots { list, file }
}

/// What `[uncertainty]` states of each parameter; an unknown of which it says that it is exact is an error.
fn stated_priors(
    case: &Case,
    request: &Request<'_>,
    parameters: &[Parameter],
) -> Result<Vec<Option<Prior>>, Unknown> {
    if request.sampling.is_none() {
        return Ok(vec![None; parameters.len()]);
    }
    let stated = StatedKeys::of(&case.source.text);
    let prior = |parameter: &Parameter| match parameter.stated_prior(&case.plan, &stated) {
        Some(prior) if prior.sd <= 0.0 => Err(parameter.unknown),
        prior => Ok(prior),
    };
    parameters.iter().map(prior).collect()
}

/// Inputs in common that are not estimated and that are not exact.
fn others(case: &Case, request: &Request<'_>) -> Vec<(Parameter, Prior)> {
    if request.sampling.is_none() {
        return Vec::new();
    }
    let all = Parameter::others(request.unknowns).into_iter();
    all.filter_map(|other| Some((other, other.prior(&case.plan).filter(|prior| prior.sd > 0.0)?))).collect()
}

/// The plan with the inputs that are not estimated at their means.
fn plan_of_others(case: &Case, request: &Request<'_>) -> Plan {
    let mut plan = case.plan.clone();
    others(case, request).iter().for_each(|(other, prior)| other.set_in(&mut plan, prior.mean));
    plan
}

fn by_option(observations: &[Observation]) -> Vec<(usize, Vec<Watched>)> {
    let shots = observations.chunk_by(|a, b| a.option == b.option);
    shots.map(|shot| (shot[0].option, shot.iter().map(|seen| seen.watched).collect())).collect()
}

/// Plausible ranges, and the parts of them that the plan expects: within three standard deviations.
fn search_box(plan: &Plan, parameters: &[Parameter], priors: &[Option<Prior>]) -> SearchBox {
    let ranges: Vec<[f64; 2]> = parameters.iter().map(|parameter| parameter.range(plan)).collect();
    let expected = |(range, prior): (&[f64; 2], &Option<Prior>)| {
        prior.map_or(*range, |prior| {
            [prior.mean - 3.0 * prior.sd, prior.mean + 3.0 * prior.sd]
                .map(|end| end.clamp(range[0], range[1]))
        })
    };
    SearchBox { expected: ranges.iter().zip(priors).map(expected).collect(), ranges }
}

/// A fit under way.
struct Fitting<'p> {
    predictor: Predictor<'p>,
    space: SearchBox,
    priors: Vec<Option<Prior>>,
    others: Vec<(Parameter, Prior)>,
    seen: ObservedShots,
    seed: Option<u64>,
}

/// An answer with what is known of its neighbourhood.
struct ExactAnswer {
    minimum: Minimum,
    /// The predictions there.
    fitted: Vec<f64>,
    /// Their derivatives (`n_observations` × `n_parameters`).
    slopes: DMatrix<f64>,
    weights: Weights,
}

impl ExactAnswer {
    /// −2 × the logarithm of the likelihood, but for a constant.
    fn unlikelihood(&self) -> f64 {
        self.minimum.misfit + self.weights.log_determinant
    }
}

/// Spread of the samples about an answer, over its standard deviation: wide enough for slopes that samples hardly blur.
const SPREAD: f64 = 1.5;
/// Least and greatest spread, as a share of the range.
const SPREADS: [f64; 2] = [5e-3, 0.15];
/// Most times that samples are drawn about an answer.
const MOST_ROUNDS: usize = 6;

impl Fitting<'_> {
    /// Where the search begins: at what the plan states, or at its own numbers.
    fn start_coordinates(&self, plan: &Plan) -> Vec<f64> {
        let own = |(n, parameter): (usize, &Parameter)| {
            let planned = || parameter.planned(plan).map(|planned| parameter.coordinate(planned));
            // Stiff ends are at the stiff end of their range.
            self.priors[n].map(|prior| prior.mean).or_else(planned).unwrap_or(self.space.ranges[n][1])
        };
        self.predictor.parameters.iter().enumerate().map(own).collect()
    }

    /// Independent residuals of unit variance: those of the observations, then those of what the plan states.
    fn residuals(&self, at: &[f64], weights: &Weights) -> Result<Option<DVector<f64>>, NoResult> {
        let Some(predicted) = self.predictor.values(at, 1.0)? else { return Ok(None) };
        let Some(of_observations) = weights.whitened_residuals(&self.seen.list, &predicted) else {
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
    fn answers(&self, case: &Case) -> Result<Vec<ExactAnswer>, NoResult> {
        let own = self.start_coordinates(&case.plan);
        let weighing =
            Weighing { predictor: &self.predictor, plan: &case.plan, others: &self.others, seen: &self.seen };
        let weights = match self.seed {
            Some(seed) => {
                weighing.weigh_samples(&own, &self.sample_spread(|_| 0.0), seed)?.map(|local| local.weights)
            }
            None => weighing.weigh_without_scatter(&own)?,
        };
        let weights = weights.ok_or_else(|| self.failure(&own))?;
        let minima = self.space.minima(&own, &|at| self.residuals(at, &weights), self.predictor.progress)?;
        let least = minima.first().map_or(f64::INFINITY, |best| best.misfit);
        let is_worth = |minimum: &Minimum| minimum.misfit <= least + WORTH_WEIGHING;
        let worth: Vec<Minimum> = minima.into_iter().take_while(is_worth).take(MOST_WEIGHED).collect();
        let settled = run_jobs(&worth, self.predictor.progress, |minimum| match self.seed {
            Some(seed) => self.settle_among_samples(&weighing, minimum, seed),
            None => self.settle(&weighing, minimum),
        })?;
        let settled: Option<Vec<Option<ExactAnswer>>> = settled.into_iter().collect();
        let mut settled: Vec<ExactAnswer> =
            settled.ok_or(NoResult::OutOfTime)?.into_iter().flatten().collect();
        settled.sort_by(|a, b| a.unlikelihood().total_cmp(&b.unlikelihood()));
        let least = settled.first().map(ExactAnswer::unlikelihood).ok_or_else(|| self.failure(&own))?;
        settled.retain(|answer| answer.unlikelihood() <= least + NEARLY_EQUAL);
        Ok(settled.into_iter().fold(Vec::new(), |mut all: Vec<ExactAnswer>, settled| {
            if !all.iter().any(|known| known.minimum.is_same(&settled.minimum)) {
                all.push(settled);
            }
            all
        }))
    }

    /// The spread of samples for these standard deviations of the coordinates.
    fn sample_spread(&self, sd: impl Fn(usize) -> f64) -> Vec<f64> {
        let of_range = |(n, [low, high]): (usize, &[f64; 2])| {
            let [least, most] = SPREADS.map(|share| share * (high - low));
            (SPREAD * sd(n)).clamp(least, most)
        };
        self.space.ranges.iter().enumerate().map(of_range).collect()
    }

    /// The answer near a minimum where nothing scatters.
    fn settle(&self, weighing: &Weighing<'_>, minimum: &Minimum) -> Result<Option<ExactAnswer>, NoResult> {
        let Some(weights) = weighing.weigh_without_scatter(&minimum.at)? else { return Ok(None) };
        let Some(minimum) = self.space.refine(&minimum.at, &|at| self.residuals(at, &weights))? else {
            return Ok(None);
        };
        let Some(fitted) = self.predictor.values(&minimum.at, 1.0)? else { return Ok(None) };
        let slopes = self.slopes(&minimum, &fitted)?;
        Ok(Some(ExactAnswer { minimum, fitted, slopes, weights }))
    }

    /// The answer near a minimum, for the mean of what scatter makes of the predictions: samples about the answer give the mean,
    /// its slopes and the weights; these give the next answer.
    fn settle_among_samples(
        &self,
        weighing: &Weighing<'_>,
        minimum: &Minimum,
        seed: u64,
    ) -> Result<Option<ExactAnswer>, NoResult> {
        let count = minimum.at.len();
        let (mut at, mut spread) = (minimum.at.clone(), self.sample_spread(|n| minimum.sd(n)));
        let mut settled = None;
        for _ in 0..MOST_ROUNDS {
            let Some(SampledWeights { mean, slopes, weights }) =
                weighing.weigh_samples(&at, &spread, seed)?
            else {
                break;
            };
            let (Some(residuals), Some(whitened)) =
                (weights.whitened_residuals(&self.seen.list, &mean), weights.whiten(&slopes))
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
            let covariance = self.space.inverse(precision);
            let step = &covariance * pull;
            // A straight line holds no farther than the samples spread.
            let share = (0..count).map(|n| step[n].abs() / (2.0 * spread[n])).fold(1.0, f64::max);
            let next: Vec<f64> = (0..count).map(|n| at[n] + step[n] / share).collect();
            let next = self.space.held(&next);
            let moved = DVector::from_fn(count, |n, _| next[n] - at[n]);
            let stated = self
                .priors
                .iter()
                .zip(&next)
                .filter_map(|(prior, at)| prior.map(|prior| ((at - prior.mean) / prior.sd).powi(2)));
            let misfit = (residuals - whitened * &moved).norm_squared() + stated.sum::<f64>();
            let fitted =
                mean.iter().zip((&slopes * &moved).iter()).map(|(mean, change)| mean + change).collect();
            let minimum = Minimum { at: next, misfit, covariance };
            let wanted = self.sample_spread(|n| minimum.sd(n));
            let is_near =
                |n: usize| moved[n].abs() <= 0.3 * spread[n] && (wanted[n] / spread[n]).ln().abs() < 0.4;
            let is_settled = (0..count).all(is_near);
            (at, spread) = (minimum.at.clone(), wanted);
            settled = Some(ExactAnswer { minimum, fitted, slopes, weights });
            if is_settled {
                break;
            }
        }
        Ok(settled)
    }

    /// Why the run at these coordinates fails.
    fn failure(&self, at: &[f64]) -> NoResult {
        let case = self.predictor.case(at);
        let settings =
            case.run_settings(self.predictor.compute.method, self.predictor.compute.first_step(&case));
        let run = |(option, _): &(usize, _)| {
            let watch = &mut |_: &dyn crate::simulation::Motion| self.predictor.progress.flow();
            case.model.run(&case.shots[*option], &settings, watch).err()
        };
        let failure = self.predictor.options.iter().find_map(run);
        failure.map_or(NoResult::OutOfTime, |failure| self.predictor.progress.no_result(failure))
    }

    /// Derivatives of the predictions at a minimum, whose `values` are these.
    fn slopes(&self, minimum: &Minimum, values: &[f64]) -> Result<DMatrix<f64>, NoResult> {
        let predictions = |at: &[f64]| Ok(self.predictor.values(at, 1.0)?.map(DVector::from_vec));
        let difference = |n: usize| {
            let [low, high] = self.space.ranges[n];
            minimum.sd(n).clamp(1e-3 * (high - low), 0.1 * (high - low))
        };
        let difference: Vec<f64> = (0..minimum.at.len()).map(difference).collect();
        let values = DVector::from_column_slice(values);
        let slopes = self.space.slopes(&minimum.at, &values, &difference, &predictions)?;
        Ok(slopes.map(|slope| if slope.is_finite() { slope } else { 0.0 }))
    }

    fn answer(&self, case: &Case, settled: &ExactAnswer) -> Answer {
        let ExactAnswer { minimum, fitted, weights, .. } = settled;
        let parameters = &self.predictor.parameters;
        let count = parameters.len();
        let estimate = |n: usize| {
            let (parameter, at, [low, high]) = (parameters[n], minimum.at[n], self.space.ranges[n]);
            let near_end = 1e-6 * (high - low);
            Estimated {
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
            fitted: fitted[n],
            sd: weights.sds[n],
            deviation: (self.seen.list[n].value - fitted[n]) / weights.sds[n],
            error: weights.errors[n],
        };
        let stated = self.priors.iter().flatten().count();
        Answer {
            estimates: (0..count).map(estimate).collect(),
            correlation: (0..count).map(|a| (0..count).map(|b| correlation(a, b)).collect()).collect(),
            residuals: (0..fitted.len()).map(residual).collect(),
            chi_square: minimum.misfit,
            freedom: (fitted.len() + stated).saturating_sub(count),
        }
    }
}

/// What to observe next, by the plan with the best answer: of a shot of the option observed most.
fn next(
    case: &Case,
    fit: &Fit,
    request: &Request<'_>,
    compute: &ComputeSettings,
    progress: &Progress,
) -> Result<Option<NextObservation>, NoResult> {
    let Some(sampling) = request.sampling else { return Ok(None) };
    let text =
        crate::plan::fitted::write(&case.source.text, &case.plan.uncertainty, &fit.answers[0].fitted(), &[]);
    let Some(plan) = text.ok().and_then(|text| Plan::parse("", &text).ok()) else { return Ok(None) };
    let shots = fit.observed.chunk_by(|a, b| a.option == b.option);
    let Some(most) = shots.max_by_key(|shot| shot.len()) else { return Ok(None) };
    next_observation(&Case::new(plan), most[0].option, &sampling, compute, progress)
}
