//! Schema `shelter.fit/1`.

use serde::Serialize;

use crate::choice::ObservedQuantity;
use crate::plan::observations::Observations;
use crate::report::fit::launch_speeds;
use crate::report::observed::{ObservedRow, fitted_rows, place};
use crate::study::Case;
use crate::study::fit::{Answer, Fit, FittedParameter, Residual};

/// The document of a fit. `unknowns`, `residuals` and `correlation` are those of the best answer.
#[derive(Serialize)]
pub struct FitDocument<'a> {
    schema: &'static str,
    plan: &'a str,
    title: &'a str,
    files: Vec<FileObject<'a>>,
    /// Whether the residuals are no larger than chance makes them.
    explained: bool,
    chi_square: f64,
    degrees_of_freedom: usize,
    unknowns: Vec<UnknownObject>,
    correlation: &'a [Vec<f64>],
    /// How well launches are known after the fit; null where none were estimated.
    launch_common_percent: Option<f64>,
    /// How far launches differ from shot to shot, as `--write` leaves it; null with `--nominal`.
    launch_between_shots_percent: Option<f64>,
    residuals: Vec<ResidualObject>,
    /// Separate answers that fit nearly as well.
    other_answers: Vec<AnswerObject<'a>>,
    /// Null without samples.
    bands: Option<BandsObject>,
    /// Null where no single observation would narrow the verdict by a hundredth.
    next: Option<NextObservationObject>,
}

#[derive(Serialize)]
struct FileObject<'a> {
    path: &'a str,
    sha256: &'a str,
}

#[derive(Serialize)]
struct AnswerObject<'a> {
    chi_square: f64,
    unknowns: Vec<UnknownObject>,
    correlation: &'a [Vec<f64>],
}

/// Launches are factors; `launch_m_s` are the velocities that they make.
#[derive(Serialize)]
struct UnknownObject {
    name: String,
    value: f64,
    sd: f64,
    unit: &'static str,
    was: Option<f64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    launch_m_s: Vec<f64>,
    /// Whether the estimate lies at an end of its plausible range.
    at_end: bool,
}

/// Null where a tire never lifts, or never lands.
#[derive(Serialize)]
struct ResidualObject {
    option: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    tire: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    cable: Option<String>,
    quantity: ObservedQuantity,
    #[serde(skip_serializing_if = "Option::is_none")]
    at_s: Option<f64>,
    observed: f64,
    sd: f64,
    fitted: Option<f64>,
    /// Standard deviation about the fit: stated, of computing, of the scatter of the plan.
    total_sd: Option<f64>,
    suspicious: bool,
    planned: Option<f64>,
    band: Option<[f64; 2]>,
}

/// How many observations lie in the 90 % bands that the plan predicts.
#[derive(Serialize)]
struct BandsObject {
    within: usize,
    of: usize,
}

#[derive(Serialize)]
struct NextObservationObject {
    observe: String,
    sd: f64,
    variance_share: f64,
}

impl UnknownObject {
    fn of(case: &Case, estimate: &FittedParameter) -> Self {
        let FittedParameter { parameter, value, sd, was, is_at_end, .. } = *estimate;
        let launch_m_s = launch_speeds(case, parameter).into_iter().map(|speed| speed * value).collect();
        let name = parameter.name(&case.plan);
        Self { name, value, sd, unit: parameter.unit(), was, launch_m_s, at_end: is_at_end }
    }

    fn all(case: &Case, answer: &Answer) -> Vec<Self> {
        answer.estimates.iter().map(|estimate| Self::of(case, estimate)).collect()
    }
}

impl ResidualObject {
    fn of(row: &ObservedRow<'_>) -> Self {
        let ObservedRow { case, observed, prediction, residual } = *row;
        let (scene, watched) = (case.scene(), &observed.watched);
        let is_force = watched.quantity == ObservedQuantity::Force;
        let finite = |value: f64| Some(value).filter(|value| value.is_finite());
        Self {
            option: case.plan.delays[observed.option].name.clone(),
            tire: (!is_force).then(|| scene.tire_ids[watched.index].to_string()),
            cable: is_force.then(|| scene.cable_name(watched.index)),
            quantity: watched.quantity,
            at_s: (watched.quantity == ObservedQuantity::Height).then_some(watched.time),
            observed: observed.value,
            sd: observed.sd,
            fitted: residual.and_then(|residual| finite(residual.predicted)),
            total_sd: residual.map(|residual| residual.sd),
            suspicious: residual.is_some_and(Residual::is_suspicious),
            planned: finite(prediction.planned),
            band: prediction.band,
        }
    }
}

impl<'a> FitDocument<'a> {
    /// The document of a fit to these files.
    pub fn new(case: &'a Case, files: &'a [Observations], fit: &'a Fit) -> Self {
        let (best, others) = (&fit.answers[0], &fit.answers[1..]);
        let held: Vec<bool> = fitted_rows(case, fit)
            .iter()
            .filter_map(|row| row.prediction.contains(row.observed.value))
            .collect();
        let within = held.iter().filter(|&&held| held).count();
        Self {
            schema: "shelter.fit/1",
            plan: &case.source.path,
            title: case.title(),
            files: files.iter().map(|file| FileObject { path: &file.path, sha256: &file.checksum }).collect(),
            explained: best.explains(),
            chi_square: best.chi_square,
            degrees_of_freedom: best.freedom,
            unknowns: UnknownObject::all(case, best),
            correlation: &best.correlation,
            launch_common_percent: fit.launches.map(|launches| launches.common_percent),
            launch_between_shots_percent: fit.between_shots.map(|between| between.percent),
            residuals: fitted_rows(case, fit).iter().map(ResidualObject::of).collect(),
            other_answers: others
                .iter()
                .map(|answer| AnswerObject {
                    chi_square: answer.chi_square,
                    unknowns: UnknownObject::all(case, answer),
                    correlation: &answer.correlation,
                })
                .collect(),
            bands: (!held.is_empty()).then_some(BandsObject { within, of: held.len() }),
            next: fit.next.map(|next| NextObservationObject {
                observe: place(case, next.observable.option, &next.observable.watched),
                sd: next.sd,
                variance_share: next.share,
            }),
        }
    }
}
