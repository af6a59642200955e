//! Estimates launch velocities and other unknowns from observations of earlier shots.
//!
//! The method is weighted least squares. Within plausible ranges, the fit finds the parameters whose predictions fit the
//! observations best. Each prior that `[uncertainty]` states counts as one more observation. The weights are the inverse of the
//! [`covariance`] of the observations, first at the plan, then at each answer. Inputs that are not estimated are not exact: they
//! widen the covariance. Launch velocities differ from shot to shot, and observations of one shot do not show how far. So each shot
//! has its own factor in the covariance ([`between_shots`]).
//!
//! | question | where |
//! |---|---|
//! | the result | `answer` |
//! | which numbers are estimated, and their priors in the plan | [`parameter`] |
//! | which answers fit the observations, and how sure they are | `problem` |
//! | the observations by shot | [`observed_shots`] |
//! | the predictions of a plan | `predictor`, `observation_recorder` |
//! | how far observations may lie from a prediction | [`covariance`] |
//! | how far shots differ | [`between_shots`] |
//! | which parameters fit best, in which separate answers | [`search`] |
//! | whether observations determine the parameters | [`determined`] |
//! | where observations lie among the sampled shots, and which observation says most about a shot | [`observation_bands`] |
//! | what the values of one shot together say about its launches | [`launch_information`] |
//! | what to observe next, in a shot that may be fired | [`what_next`] |

mod answer;
pub mod between_shots;
pub mod covariance;
pub mod determined;
pub mod launch_information;
pub mod observation_bands;
mod observation_recorder;
pub mod observed_shots;
pub mod parameter;
mod predictor;
mod problem;
mod refined_answer;
pub mod search;
pub mod what_next;

pub use self::answer::{Answer, Fit, FitResult, FittedParameter, Residual};
use serde::{Deserialize, Serialize};

use self::between_shots::BetweenShots;
pub use self::determined::{NotDetermined, Observable};
use self::observation_bands::{Prediction, predict_observations};
use self::observed_shots::ObservedShots;
use self::parameter::{Parameter, Prior};
use self::predictor::Predictor;
use self::problem::FitProblem;
use self::search::SearchBox;
use self::what_next::{WhatNext, next_observation_of};
use super::cost::samples_to_come;
use super::study_trait::{Listed, Study, Subject};
use super::{Case, ComputeResult, Computed, Context, NoResult};
use crate::choice::{Method, Unknown};
use crate::plan::Plan;
use crate::plan::observations::{ObservableNames, Observations};
use crate::plan::write_fit::StatedKeys;
use crate::scene::TireId;

/// Names that observations of a plan may use.
pub fn observable_names(case: &Case) -> ObservableNames {
    let scene = case.scene();
    ObservableNames {
        options: case.plan.delays.iter().map(|delay| delay.name.clone()).collect(),
        tires: scene.tire_ids.iter().map(TireId::numbers).collect(),
        cables: scene.cables.iter().map(|cable| cable.ends).collect(),
        holes: case
            .shots
            .iter()
            .map(|shot| shot.firings.iter().map(|hole| (hole.tire, hole.time)).collect())
            .collect(),
    }
}

/// The question: which launch velocities and other unknowns follow from observations of earlier shots, beside the predictions of
/// the plan?
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Question {
    /// Files of observations.
    pub observed: Vec<Observations>,
    /// Unknowns to estimate, each once.
    pub unknowns: Vec<Unknown>,
}

/// Observations of earlier shots, beside the predictions of the plan.
#[derive(Clone, Debug)]
pub struct ComparedWithObservations {
    /// Fit to the files that the plan was not fitted to yet; `None` if it was fitted to all.
    pub fitted: Option<FitResult>,
    /// The files of that fit.
    pub new: Vec<Observations>,
    /// All files of observations, including the files that the plan was already fitted to.
    pub files: Vec<Observations>,
    /// The observations in all files.
    pub seen: ObservedShots,
    /// Prediction of the present plan for each of these observations.
    pub predictions: Vec<Prediction>,
    /// Whether the plan was sampled.
    pub is_sampled: bool,
}

/// Usual number of runs of a fit.
const RUNS_OF_FIT: usize = 6000;

impl Study for Question {
    type Found = ComparedWithObservations;
    const LISTED: Option<Listed> = Some(Listed {
        name: "Fit",
        question: "What did you see?",
        about: "How fast did the tires really leave? From observations of earlier shots.",
        tells: "how fast your tires leave, and whether the plan holds",
    });

    fn expected_runs(case: &Case) -> Option<usize> {
        // The search for the next observation needs verdicts. This counts all options, though the fit judges only the option
        // observed most.
        Some(RUNS_OF_FIT + case.shots.len() * samples_to_come(case, 0))
    }

    fn usual(_case: &Case, about: Subject) -> Self {
        Self { observed: about.observed, unknowns: vec![Unknown::Launch] }
    }

    fn answer(&self, context: &Context<'_>) -> ComputeResult<ComparedWithObservations> {
        let files = self.observed.clone();
        let is_new = |file: &&Observations| !file.was_fitted(&context.case.plan.fitted_from);
        let new: Vec<Observations> = files.iter().filter(is_new).cloned().collect();
        let fitted = match new.is_empty() {
            true => None,
            false => Some(fit(context, &new, &self.unknowns)?),
        };
        let seen = ObservedShots::new(&files);
        let predictions = predict_observations(context, &seen)?;
        let is_sampled = context.sampling.is_some();
        Ok(Computed::complete(ComparedWithObservations { fitted, new, files, seen, predictions, is_sampled }))
    }
}

/// Fits unknowns of a plan, each named once, to files of observations. Without samples everything but the unknowns counts as exact,
/// and the unknowns have no prior.
pub fn fit(
    context: &Context<'_>,
    files: &[Observations],
    unknowns: &[Unknown],
) -> Result<FitResult, NoResult> {
    let case = &until_rest(context.case);
    let context = &context.with_case(case);
    let &Context { compute, control, sampling, .. } = context;
    let parameters = Parameter::all(unknowns, &case.plan);
    let priors = match stated_priors(context, &parameters) {
        Ok(priors) => priors,
        Err(unknown) => return Ok(FitResult::KnownExactly(unknown)),
    };
    if compute.method == Method::Newmark && unknowns.contains(&Unknown::Damping) {
        return Ok(FitResult::NotInMethod(Unknown::Damping));
    }
    let seen = ObservedShots::new(files);
    let stated = StatedKeys::of(&case.source.text);
    let mut between_shots =
        sampling.map(|_| BetweenShots::before(&case.plan.uncertainty, &stated, seen.shots().len()));
    let mut problem = FitProblem {
        space: search_box(&case.plan, &parameters, &priors),
        predictor: Predictor {
            plan: plan_of_not_estimated(context, unknowns),
            shots: seen.distinct_shots(),
            parameters,
            compute,
            control,
        },
        not_estimated: not_estimated(context, unknowns),
        between_shots_percent: between_shots.map_or(0.0, BetweenShots::taken_first),
        priors,
        seen,
        // The plan with the estimates is later judged by the draws of the seed itself, so the fit uses other draws.
        seed: sampling.map(|sampling| sampling.for_screening().seed),
    };
    control.has_steps(3);
    let answering = control.part(SHARE_OF_ANSWERS);
    let mut refined = problem.answers(case)?;
    drop(answering);
    let again = control.part(SHARE_OF_ANSWERS);
    if let Some(before) = between_shots {
        // The mean of the factors follows a launch. If no launch is estimated, the mean is one more parameter.
        let follow = problem.predictor.parameters.len() + usize::from(!estimates_launches(unknowns));
        let of_shots = before.of_shots(&problem.seen, &refined[0], follow);
        if of_shots.percent != problem.between_shots_percent {
            problem.between_shots_percent = of_shots.percent;
            refined = problem.answers(case)?;
        }
        between_shots = Some(of_shots);
    }
    drop(again);
    let _telling = control.part(1.0);
    let best = &refined[0];
    let slopes = best.covariance.whiten(&best.slopes).unwrap_or_else(|| best.slopes.clone());
    let start = problem.start_coordinates(&case.plan);
    let refused = determined::refuse(&problem.predictor, &problem.space, &start, &slopes)?;
    let predicting = control.part(SHARE_OF_PREDICTIONS);
    let predictions = predict_observations(context, &problem.seen)?;
    drop(predicting);
    if let Some(refused) = refused {
        let observed = problem.seen.list;
        return Ok(FitResult::NotDetermined { refused, observed, predictions });
    }
    let answers: Vec<Answer> = refined.iter().map(|refined| problem.answer(case, refined)).collect();
    let launches = estimates_launches(unknowns).then(|| {
        let before = &case.plan.uncertainty;
        answers[0].launch_uncertainty(before, between_shots.map(|between| between.percent))
    });
    let ObservedShots { list: observed, file, .. } = problem.seen;
    let mut fit = Fit { answers, observed, file, predictions, between_shots, launches, next: None };
    fit.next = what_to_observe_next(context, &fit)?;
    Ok(FitResult::Fitted(fit))
}

/// Shares of the remaining progress: for the estimates, taken twice, and for the bands of the observations.
const SHARE_OF_ANSWERS: f64 = 0.5;
const SHARE_OF_PREDICTIONS: f64 = 0.5;

/// Whether launches are among the unknowns.
fn estimates_launches(unknowns: &[Unknown]) -> bool {
    unknowns.iter().any(|unknown| matches!(unknown, Unknown::Launch | Unknown::LaunchByRow))
}

/// The case without `duration_s` if friction brings the tires to rest. Then later observations are computed, too.
fn until_rest(case: &Case) -> Case {
    let least_friction = case.plan.ground.friction.min(case.plan.uncertainty.friction[0]);
    match 1e2 * least_friction > case.plan.ground.slope_percent {
        true => case.with_duration(None),
        false => case.clone(),
    }
}

/// The prior that `[uncertainty]` states for each parameter. An unknown that it states as exact is an error.
fn stated_priors(
    &Context { case, sampling, .. }: &Context<'_>,
    parameters: &[Parameter],
) -> Result<Vec<Option<Prior>>, Unknown> {
    if sampling.is_none() {
        return Ok(vec![None; parameters.len()]);
    }
    let stated = StatedKeys::of(&case.source.text);
    let prior = |parameter: &Parameter| match parameter.stated_prior(&case.plan, &stated) {
        Some(prior) if prior.sd <= 0.0 => Err(parameter.unknown),
        prior => Ok(prior),
    };
    parameters.iter().map(prior).collect()
}

/// Inputs in common that are neither estimated nor exact, each with its prior.
fn not_estimated(
    &Context { case, sampling, .. }: &Context<'_>,
    unknowns: &[Unknown],
) -> Vec<(Parameter, Prior)> {
    if sampling.is_none() {
        return Vec::new();
    }
    let all = Parameter::not_estimated(unknowns).into_iter();
    all.filter_map(|other| Some((other, other.prior(&case.plan).filter(|prior| prior.sd > 0.0)?))).collect()
}

/// The plan with all inputs that are not estimated set to their means.
fn plan_of_not_estimated(context: &Context<'_>, unknowns: &[Unknown]) -> Plan {
    let mut plan = context.case.plan.clone();
    not_estimated(context, unknowns).iter().for_each(|(other, prior)| other.set_in(&mut plan, prior.mean));
    plan
}

/// Plausible ranges, and the parts of them that the plan expects: within three standard deviations of the prior mean.
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

/// What to observe next in a shot of the option observed most, by the plan that `fit --write` would leave. `None` if the estimates
/// do not explain the observations: then no shot is to be fired before they do.
fn what_to_observe_next(context: &Context<'_>, fit: &Fit) -> Result<Option<WhatNext>, NoResult> {
    let &Context { case, sampling, .. } = context;
    let Some(sampling) = sampling.filter(|_| fit.answers[0].explains()) else { return Ok(None) };
    let text = crate::plan::write_fit::write(&case.source.text, &case.plan, &fit.to_write(), &[]);
    let Some(plan) = text.ok().and_then(|text| Plan::parse("", &text).ok()) else { return Ok(None) };
    let shots = fit.observed.chunk_by(|a, b| a.option == b.option);
    let Some(most) = shots.max_by_key(|shot| shot.len()) else { return Ok(None) };
    next_observation_of(&context.with_case(&Case::new(plan)), most[0].option, &sampling).map(Some)
}
