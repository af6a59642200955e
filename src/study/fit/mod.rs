//! What observations of earlier shots tell of launch velocities and other unknowns.
//!
//! Weighted least squares: of the parameters within plausible ranges those whose predictions fit the observations best; what
//! `[uncertainty]` of the plan states of them counts as observations. The weights are the inverse of the observations'
//! [`covariance`], first at the plan, then at each answer. Inputs that are not estimated are not taken for exact: they widen the
//! covariance. Launch velocities differ from shot to shot, and no observation of one shot says how far: each shot has a factor of
//! its own in the covariance ([`between_shots`]).
//!
//! | question | where |
//! |---|---|
//! | what is found | `answer` |
//! | which numbers are estimated, and what the plan knows of them | [`parameter`] |
//! | which answers the observations leave, and how sure they are | `problem` |
//! | the observations by shot | [`observed_shots`] |
//! | what a plan predicts | `predictor`, `observation_recorder` |
//! | how far observations may lie from it | [`covariance`] |
//! | how far shots differ | [`between_shots`] |
//! | which parameters fit best, in which separate answers | [`search`] |
//! | whether observations determine them | [`determined`] |
//! | how observations lie among the shots that were possible, and what tells most of a shot | [`observation_bands`] |
//! | what values of a shot tell together of its launches | [`launch_information`] |
//! | what to observe next, of a shot that may be fired | [`what_next`] |

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

/// What observations of a plan may name.
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

/// Launch velocities and other unknowns from what was seen of earlier shots, beside what the plan says of them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Question {
    /// Files of observations.
    pub observed: Vec<Observations>,
    /// What is estimated, each once.
    pub unknowns: Vec<Unknown>,
}

/// What was seen of earlier shots, beside what the plan says of it.
#[derive(Clone, Debug)]
pub struct ComparedWithSeen {
    /// The fit of what the plan was not fitted to yet; `None` where it was fitted to all.
    pub fitted: Option<FitResult>,
    /// The observations that it is of.
    pub new: Vec<Observations>,
    /// All files of observations, those that the plan was fitted to, too.
    pub files: Vec<Observations>,
    /// What was seen in them.
    pub seen: ObservedShots,
    /// What the plan says now of each of these observations.
    pub predictions: Vec<Prediction>,
    /// Whether there were samples of what the plan does not know.
    pub is_sampled: bool,
}

/// Runs that a fit usually takes.
const RUNS_OF_FIT: usize = 6000;

impl Study for Question {
    type Found = ComparedWithSeen;
    const LISTED: Option<Listed> = Some(Listed {
        name: "Fit",
        question: "What did you see?",
        about: "How fast did the tires really leave? From observations of earlier shots.",
        tells: "how fast your tires leave, and whether the plan holds",
    });

    fn expected_runs(case: &Case) -> Option<usize> {
        // What to observe next follows from the verdicts of all options.
        Some(RUNS_OF_FIT + case.shots.len() * samples_to_come(case, 0))
    }

    fn usual(_case: &Case, about: Subject) -> Self {
        Self { observed: about.observed, unknowns: vec![Unknown::Launch] }
    }

    fn answer(&self, context: &Context<'_>) -> ComputeResult<ComparedWithSeen> {
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
        Ok(Computed::complete(ComparedWithSeen { fitted, new, files, seen, predictions, is_sampled }))
    }
}

/// Fits unknowns of a plan, each named once, to files of observations. Without samples all but the unknowns is taken for exact, and
/// nothing is known of these beforehand.
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
        // The estimates go into a plan that the draws of the seed itself then judge.
        seed: sampling.map(|sampling| sampling.for_screening().seed),
    };
    control.has_steps(3);
    let answering = control.part(SHARE_OF_ANSWERS);
    let mut settled = problem.answers(case)?;
    drop(answering);
    let again = control.part(SHARE_OF_ANSWERS);
    if let Some(before) = between_shots {
        // The mean of the factors is followed by a launch; where none is estimated, it is one parameter more.
        let follow = problem.predictor.parameters.len() + usize::from(!estimates_launches(unknowns));
        let of_shots = before.of_shots(&problem.seen, &settled[0], follow);
        if of_shots.percent != problem.between_shots_percent {
            problem.between_shots_percent = of_shots.percent;
            settled = problem.answers(case)?;
        }
        between_shots = Some(of_shots);
    }
    drop(again);
    let _telling = control.part(1.0);
    let best = &settled[0];
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
    let answers: Vec<Answer> = settled.iter().map(|settled| problem.answer(case, settled)).collect();
    let launches = estimates_launches(unknowns).then(|| {
        let before = &case.plan.uncertainty;
        answers[0].launch_uncertainty(before, between_shots.map(|between| between.percent))
    });
    let ObservedShots { list: observed, file, .. } = problem.seen;
    let mut fit = Fit { answers, observed, file, predictions, between_shots, launches, next: None };
    fit.next = what_to_observe_next(context, &fit)?;
    Ok(FitResult::Fitted(fit))
}

/// Shares of what is left that the estimates take, twice, and the bands of what was seen.
const SHARE_OF_ANSWERS: f64 = 0.5;
const SHARE_OF_PREDICTIONS: f64 = 0.5;

/// Whether launches are among what is estimated.
fn estimates_launches(unknowns: &[Unknown]) -> bool {
    unknowns.iter().any(|unknown| matches!(unknown, Unknown::Launch | Unknown::LaunchByRow))
}

/// The case without a `duration_s`, where friction brings the tires to rest: what was seen later than that is computed, too.
fn until_rest(case: &Case) -> Case {
    let least_friction = case.plan.ground.friction.min(case.plan.uncertainty.friction[0]);
    match 1e2 * least_friction > case.plan.ground.slope_percent {
        true => case.with_duration(None),
        false => case.clone(),
    }
}

/// What `[uncertainty]` states of each parameter; an unknown of which it says that it is exact is an error.
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

/// Inputs in common that are not estimated and that are not exact.
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

/// The plan with the inputs that are not estimated at their means.
fn plan_of_not_estimated(context: &Context<'_>, unknowns: &[Unknown]) -> Plan {
    let mut plan = context.case.plan.clone();
    not_estimated(context, unknowns).iter().for_each(|(other, prior)| other.set_in(&mut plan, prior.mean));
    plan
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

/// What to observe next, by the plan that `fit --write` would leave: of a shot of the option observed most. `None` where the estimates do
/// not explain what was seen: then no shot is to be fired before they do.
fn what_to_observe_next(context: &Context<'_>, fit: &Fit) -> Result<Option<WhatNext>, NoResult> {
    let &Context { case, sampling, .. } = context;
    let Some(sampling) = sampling.filter(|_| fit.answers[0].explains()) else { return Ok(None) };
    let text = crate::plan::write_fit::write(&case.source.text, &case.plan, &fit.to_write(), &[]);
    let Some(plan) = text.ok().and_then(|text| Plan::parse("", &text).ok()) else { return Ok(None) };
    let shots = fit.observed.chunk_by(|a, b| a.option == b.option);
    let Some(most) = shots.max_by_key(|shot| shot.len()) else { return Ok(None) };
    next_observation_of(&context.with_case(&Case::new(plan)), most[0].option, &sampling).map(Some)
}
