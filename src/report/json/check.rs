//! Schema `shelter.check/2`.

use serde::Serialize;
use serde_json::Number;

use super::remedies::{PassingChange, RefusedKind};
use super::risk::{Share, input_shares};
use super::{Bounds, Failures, LimitsObject, intervals};
use crate::choice::HoleOrder;
use crate::outcome::BrokenCable;
use crate::plan::Time;
use crate::report::check::judged_inputs;
use crate::report::option_row::option_rows;
use crate::report::shared_columns::launch_margin_share;
use crate::report::words::reasons;
use crate::report::words::{no_result, warnings};
use crate::scene::{Scene, TireId};
use crate::study::eight_ms::WithinEightMs;
use crate::study::judge_options::{MustPass, OptionResults, verdict_on_plan};
use crate::study::judgement::Judgement;
use crate::study::one_dud::OneDud;
use crate::study::recommend::recommended;
use crate::study::remedies::Remedies;
use crate::study::samples::sampled_shot::SampledShot;
use crate::study::{Case, ValueWithError};
use crate::verdict::{Estimate, Quantity};

/// The document of one plan.
#[derive(Serialize)]
pub struct CheckDocument {
    schema: &'static str,
    plan: String,
    title: String,
    judged: &'static str,
    accepted_risk_percent: f64,
    verdict: &'static str,
    /// Name of the option recommended; null where none is.
    recommended: Option<String>,
    partial: bool,
    scene: SceneSize,
    limits: LimitsObject,
    options: Vec<JudgedOption>,
    warnings: Vec<String>,
}

#[derive(Serialize)]
struct SceneSize {
    tires: usize,
    cables: usize,
    modelled_tires: usize,
}

#[derive(Serialize)]
struct JudgedOption {
    name: String,
    fire_at_s: Vec<f64>,
    hole_interval_s: f64,
    hole_order: HoleOrder,
    holes_in_8_ms: usize,
    /// Null where the plan names no charges.
    charge_in_8_ms_kg: Option<f64>,
    verdict: &'static str,
    reasons: Vec<String>,
    would_pass: Option<Vec<PassingChange>>,
    would_not_pass: Option<Vec<RefusedKind>>,
    #[serde(flatten)]
    values: Option<OptionValues>,
}

#[derive(Serialize)]
struct OptionValues {
    nominal_verdict: &'static str,
    /// Whether fresh draws confirm the pass; null where none were drawn.
    confirmed: Option<bool>,
    failure_probability: Option<Failures>,
    one_dud: Option<OneDudObject>,
    any_cable_breaks: Option<Bounds>,
    launch_margin: Option<f64>,
    inputs: Option<Vec<Share>>,
    /// Number of the sample that decides, for `trace --sample`; null without a sample.
    deciding_sample: Option<usize>,
    flight_height_m: TirePeakObject,
    cable_force_n: CablePeakObject,
    cable_safety_factor: Option<f64>,
    drift_m: TirePeakObject,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    broken: Vec<BrokenAt>,
    cover: CoverAtFirings,
    method: &'static str,
    dt_s: f64,
    steps: usize,
    energy_residual: f64,
    wall_s: f64,
    total_wall_s: f64,
    runs: usize,
}

/// The shot as planned with one hole left out, the worst of all holes.
#[derive(Serialize)]
struct OneDudObject {
    verdict: &'static str,
    /// Blast row, and number of the hole in it, from 1.
    hole: (String, usize),
    places: usize,
    not_passing: usize,
    flight_height_m: ValueWithError,
    cable_force_n: ValueWithError,
    /// Of the worst place, where the plan asks for `withstands_one_dud`.
    failure_probability: Option<Bounds>,
}

impl OneDudObject {
    fn new(case: &Case, one_dud: &OneDud) -> Self {
        Self {
            verdict: one_dud.verdict().for_scripts(),
            hole: (case.plan.blast_rows[one_dud.row].name.clone(), one_dud.number + 1),
            places: one_dud.places,
            not_passing: one_dud.not_passing,
            flight_height_m: one_dud.planned.height,
            cable_force_n: one_dud.planned.force,
            failure_probability: one_dud.sampled.map(|sampled| sampled.bounds.interval.into()),
        }
    }
}

/// The cover over the holes of the shot as planned, each at its firing time: holes under a tire in the air or aside, and the
/// greatest height and shift of a tire over a hole.
#[derive(Serialize)]
struct CoverAtFirings {
    holes: usize,
    uncovered: usize,
    height_m: f64,
    shift_m: f64,
}

/// Percentiles of the samples; null for too few samples.
#[derive(Serialize)]
pub(super) struct Percentiles {
    p05: Option<f64>,
    p50: Option<f64>,
    p95: Option<f64>,
}

impl Percentiles {
    pub(super) fn of(sampled: Option<&SampledShot>, quantity: Quantity) -> Self {
        let band = sampled.and_then(|sampled| sampled.band(quantity)).map(|band| band.map(Some));
        let [p05, p50, p95, _] = band.unwrap_or_default();
        Self { p05, p50, p95 }
    }
}

#[derive(Serialize)]
pub(super) struct TirePeakObject {
    value: f64,
    /// Null where it is not known, because the run ended before the value could no longer grow.
    error: f64,
    #[serde(flatten)]
    band: Percentiles,
    at_s: f64,
    tire: Vec<Number>,
}

#[derive(Serialize)]
pub(super) struct CablePeakObject {
    value: f64,
    /// Null where it is not known, because the run ended before the value could no longer grow.
    error: f64,
    #[serde(flatten)]
    band: Percentiles,
    at_s: f64,
    cable: Option<[Vec<Number>; 2]>,
}

/// A cable that broke.
#[derive(Serialize)]
struct BrokenAt {
    cable: [Vec<Number>; 2],
    at_s: f64,
}

impl BrokenAt {
    fn new(scene: &Scene, broken: &BrokenCable) -> Self {
        let ends = scene.cables[broken.cable].ends;
        Self { cable: ends.map(|end| tire_address(&scene.tire_ids[end])), at_s: broken.time }
    }
}

impl TirePeakObject {
    pub(super) fn new(scene: &Scene, estimate: &Estimate, band: Percentiles) -> Self {
        let Estimate { value, error, time, index } = *estimate;
        Self {
            value,
            error,
            band,
            at_s: time,
            tire: scene.tire_ids.get(index).map(tire_address).unwrap_or_default(),
        }
    }
}

impl CablePeakObject {
    pub(super) fn new(scene: &Scene, estimate: &Estimate, band: Percentiles) -> Self {
        let Estimate { value, error, time, index } = *estimate;
        let ends = |cable: &crate::scene::Cable| cable.ends.map(|end| tire_address(&scene.tire_ids[end]));
        Self { value, error, band, at_s: time, cable: scene.cables.get(index).map(ends) }
    }
}

impl OptionValues {
    fn new(case: &Case, judged: &Judgement) -> Self {
        let (scene, checked, sampled) = (case.scene(), &judged.checked, judged.sampled.known());
        let drift_is_judged = sampled.filter(|_| case.limits.drift.is_some());
        Self {
            nominal_verdict: checked.verdict.for_scripts(),
            confirmed: judged.is_confirmed(),
            failure_probability: Failures::of(&judged.sampled),
            one_dud: judged.one_dud.map(|one_dud| OneDudObject::new(case, &one_dud)),
            any_cable_breaks: intervals(&judged.sampled).map(|[_, breaks]| breaks.into()),
            launch_margin: launch_margin_share(judged),
            inputs: sampled.and_then(|sampled| input_shares(sampled, &case.limits)),
            deciding_sample: sampled.and_then(SampledShot::deciding_sample),
            flight_height_m: TirePeakObject::new(
                scene,
                &checked.height,
                Percentiles::of(sampled, Quantity::Height),
            ),
            cable_force_n: CablePeakObject::new(
                scene,
                &checked.force,
                Percentiles::of(sampled, Quantity::Force),
            ),
            cable_safety_factor: Some(checked.safety_factor).filter(|factor| factor.is_finite()),
            drift_m: TirePeakObject::new(
                scene,
                &checked.drift,
                Percentiles::of(drift_is_judged, Quantity::Drift),
            ),
            broken: checked.broken.iter().map(|broken| BrokenAt::new(scene, broken)).collect(),
            cover: CoverAtFirings {
                holes: checked.cover.holes,
                uncovered: checked.cover.uncovered,
                height_m: checked.cover.height,
                shift_m: checked.cover.shift,
            },
            method: checked.compute.method.name(),
            dt_s: checked.step,
            steps: checked.steps,
            energy_residual: checked.energy_residual,
            wall_s: checked.wall.as_secs_f64(),
            total_wall_s: checked.total_wall.as_secs_f64(),
            runs: checked.runs,
        }
    }
}

impl CheckDocument {
    /// The document of the results of one plan, which are partial where the time was up.
    pub fn new(
        case: &Case,
        results: &OptionResults,
        remedies: Option<&[Remedies]>,
        must_pass: MustPass,
        partial: bool,
    ) -> Self {
        let (plan, scene) = (&case.plan, case.scene());
        let method = results
            .iter()
            .flatten()
            .next()
            .map_or(plan.simulation.method, |judged| judged.checked.compute.method);
        let options = option_rows(case, results).enumerate().map(|(n, row)| {
            let tried = remedies.map(|all| all.iter().find(|remedies| remedies.option == n));
            let WithinEightMs { holes, charge } = row.together();
            JudgedOption {
                name: row.delay.name.clone(),
                fire_at_s: row.delay.timing.fire_at().into_iter().map(Time::seconds).collect(),
                hole_interval_s: row.delay.hole_timing.interval.seconds(),
                hole_order: row.delay.hole_timing.order,
                holes_in_8_ms: holes,
                charge_in_8_ms_kg: charge,
                verdict: row.verdict().for_scripts(),
                reasons: match row.result {
                    Ok(judged) => reasons::sentences(case, judged),
                    Err(reason) => vec![no_result::message(reason)],
                },
                would_pass: tried
                    .map(|tried| tried.map_or_else(Vec::new, |tried| PassingChange::all(case, tried))),
                would_not_pass: tried.map(|tried| tried.map_or_else(Vec::new, RefusedKind::all)),
                values: row.result.as_ref().ok().map(|judged| OptionValues::new(case, judged)),
            }
        });
        Self {
            schema: "shelter.check/2",
            plan: case.source.path.clone(),
            title: case.title().to_owned(),
            judged: results
                .iter()
                .flatten()
                .next()
                .map_or("nominal", |judged| judged_inputs(case, judged.sampled.is_asked())),
            accepted_risk_percent: plan.limits.accepted_risk_percent,
            verdict: verdict_on_plan(results, must_pass).for_scripts(),
            recommended: recommended(case, results).map(|option| plan.delays[option].name.clone()),
            partial,
            scene: SceneSize {
                tires: scene.tire_count(),
                cables: scene.cables.len(),
                modelled_tires: case.modelled_tires(method),
            },
            limits: LimitsObject::of(case),
            options: options.collect(),
            warnings: warnings::of_plan(case)
                .into_iter()
                .chain(warnings::of_options(case, results, None))
                .collect(),
        }
    }
}

impl CheckDocument {
    /// The same document beside what was seen that speaks against its verdicts; nothing is recommended then.
    pub fn contradicted_by(mut self, contradiction: &[String]) -> Self {
        self.recommended = self.recommended.filter(|_| contradiction.is_empty());
        self.warnings.extend(contradiction.iter().cloned());
        self
    }
}

/// The address of a tire: whole numbers but for the centres of a quincunx.
fn tire_address(tire: &TireId) -> Vec<Number> {
    let number = |n: f64| {
        if n.fract() == 0.0 { Some(Number::from(n as i64)) } else { Number::from_f64(n) }
    };
    tire.numbers().into_iter().filter_map(number).collect()
}
