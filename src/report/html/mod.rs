//! One page for the blast file: what was planned, what came out and what the model leaves out. Nothing in it is fetched
//! from elsewhere, and it prints on A4.

mod top_view;

pub use self::top_view::svg as top_view;

use chrono::{DateTime, Local};
use maud::{DOCTYPE, Markup, PreEscaped, html};
use sha2::{Digest, Sha256};

use super::check::{broken, command, compute_label, explain, peak};
use super::{chart, no_result};
use crate::choice::OnOverload;
use crate::plan::{LaunchTargets, Layout, Plan};
use crate::scene::fire_at_s;
use crate::study::Case;
use crate::study::check::Checked;
use crate::study::plans::{Results, verdict};
use crate::units::{self, Unit, value_and_error};
use crate::verdict::Verdict;

const STYLE: &str = "
@page { size: A4; margin: 15mm }
body { font: 10pt/1.4 system-ui, sans-serif; color: #111; max-width: 190mm; margin: 0 auto; padding: 5mm }
h1 { font-size: 18pt; margin: 0 } h2 { font-size: 12pt; margin: 6mm 0 2mm; border-bottom: 1px solid #999 }
table { border-collapse: collapse; width: 100% } th, td { text-align: left; padding: 1mm 2mm; border-bottom: 1px solid #ddd }
td.n, th.n { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap }
.pass { color: #00469a; font-weight: bold } .fail { color: #a03000; font-weight: bold } .undecided { color: #6e5000; font-weight: bold }
.quiet { color: #555 } .charts { display: flex; gap: 4mm; break-inside: avoid } .charts svg, .view svg { width: 100%; height: auto }
.charts > div { flex: 1 } section { break-inside: avoid }
";

/// What stands under the results, whatever the plan.
const ASSUMPTIONS: &[&str] = &[
    "Tires are point masses that do not turn; the ground is flat and hard, and a landing does not bounce.",
    "Cables are elastic, without mass and damping; they only pull, and their fastenings hold.",
    "Each hole gives its tire the launch velocity written in the plan; the program knows nothing of charges, stemming or gas.",
    "Friction on the ground is Coulomb's, with one coefficient.",
    "The error stated with each value is that of the computation; it says nothing of the plan's own numbers.",
    "The limits are the plan's; no limit is safe by default. A competent person decides.",
];

/// The page of one plan; `date` is printed as given.
pub fn page(case: &Case, results: &Results, date: &str) -> String {
    let plan = &case.plan;
    let hash = Sha256::digest(case.source.text.as_bytes());
    let hash: String = hash.iter().map(|byte| format!("{byte:02x}")).collect();
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                title { (case.title()) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                h1 { (case.title()) }
                p { (word(verdict(results, false))) " · " (passing(results)) " of " (results.len()) " delay options pass" }
                p.quiet { "Plan " (case.source.path) " · " (date) " · shelter " (env!("CARGO_PKG_VERSION")) }
                section {
                    h2 { "Shelter" }
                    (shelter(case))
                    div.view { (PreEscaped(top_view(case, None))) }
                }
                section {
                    h2 { "Delay options" }
                    (options(case, results))
                }
                @for (delay, result) in plan.delays.iter().zip(results) {
                    @if let Ok(checked) = result {
                        section {
                            h2 { (delay.name) " " (word(checked.verdict)) }
                            p.quiet { (how(case, checked)) }
                            div.charts {
                                @for curve in chart::history(case, &checked.history, &fire_at_s(&delay.timing)) {
                                    div { (PreEscaped(curve)) }
                                }
                            }
                        }
                    }
                }
                section {
                    h2 { "What the model assumes" }
                    ul { @for assumption in ASSUMPTIONS { li { (assumption) } } }
                }
                section {
                    h2 { "Reproduce" }
                    p { (command(case, results)) }
                    p.quiet { "SHA-256 of the plan: " code { (hash) } }
                }
            }
        }
    };
    page.into_string()
}

/// Today; a day fixed by SOURCE_DATE_EPOCH where pages are to be reproduced.
pub fn today() -> String {
    let fixed = std::env::var("SOURCE_DATE_EPOCH").ok().and_then(|seconds| seconds.parse().ok());
    let fixed = fixed.and_then(|seconds| DateTime::from_timestamp(seconds, 0));
    fixed.map_or_else(|| Local::now().date_naive(), |fixed| fixed.date_naive()).to_string()
}

fn word(verdict: Verdict) -> Markup {
    html! { span class=(verdict.name()) { (verdict.label()) } }
}

fn passing(results: &Results) -> usize {
    results.iter().flatten().filter(|checked| checked.verdict == Verdict::Pass).count()
}

fn shelter(case: &Case) -> Markup {
    let (plan, scene) = (&case.plan, case.scene());
    let cable = match &plan.cable.rope {
        Some(rope) => format!("{rope}, termination {} %", plan.cable.termination_percent),
        None => format!("EA {} kN", plan.cable.axial_stiffness_kn),
    };
    let limits = [
        Some(format!("flight height {} m", units::value(case.limits.height, Unit::Metre))),
        Some(format!(
            "cable force {} kN (breaking force {} kN / {})",
            units::value(case.limits.force, Unit::Kilonewton),
            units::value(case.limits.breaking_force, Unit::Kilonewton),
            plan.limits.cable_safety_factor
        )),
        case.limits.drift.map(|drift| format!("drift {} m", units::value(drift, Unit::Metre))),
    ];
    html! {
        table {
            tr { th { "Tires" } td { (scene.mass.len()) " of " (plan.tire.mass_kg) " kg, " (layout(plan)) ", " (rims(plan.tire.outer_diameter_m)) } }
            tr { th { "Cables" } td { (scene.cables.len()) ", " (cable) ", slack " (plan.cable.slack_percent) " %" (if plan.cable.on_overload == OnOverload::Break { "; past its breaking force a cable is gone" } else { "" }) } }
            tr { th { "Friction" } td { (plan.friction) } }
            tr { th { "Limits" } td { (limits.into_iter().flatten().collect::<Vec<_>>().join("; ")) } }
            @for row in &plan.blast_rows {
                tr { th { "Blast row " (row.name) } td { (launched(&row.targets)) } }
            }
        }
    }
}

fn layout(plan: &Plan) -> String {
    match &plan.layout {
        Layout::Grid(mesh) => {
            format!(
                "{} × {}, {} m × {} m apart",
                mesh.rows, mesh.columns, mesh.row_spacing_m, mesh.column_spacing_m
            )
        }
        Layout::Quincunx(mesh) => format!(
            "{} × {} with centres, {} m × {} m apart",
            mesh.rows, mesh.columns, mesh.row_spacing_m, mesh.column_spacing_m
        ),
        Layout::List { .. } => "placed one by one".to_owned(),
    }
}

fn rims(diameter_m: f64) -> String {
    if diameter_m > 0.0 {
        format!("outer diameter {diameter_m} m: cables from rim to rim")
    } else {
        "cables from centre to centre".to_owned()
    }
}

fn launched(targets: &LaunchTargets) -> String {
    match targets {
        LaunchTargets::UnderRow { row, launch_m_s } => {
            format!("under shelter row {row}, launch {launch_m_s} m/s")
        }
        LaunchTargets::UnderTires { tires, launch_m_s } => {
            let numbers: Vec<String> = tires.iter().map(|tire| (tire + 1).to_string()).collect();
            format!("under tires {}, launch {launch_m_s} m/s", numbers.join(", "))
        }
        LaunchTargets::Holes(holes) => format!("{} holes", holes.len()),
    }
}

fn options(case: &Case, results: &Results) -> Markup {
    html! {
        table {
            tr {
                th { "Option" } th { "Rows fire, as listed, at" } th { "Verdict" } th.n { "Height, m" } th.n { "Force, kN" } th.n { "Factor" } th.n { "Drift, m" }
            }
            @for (delay, result) in case.plan.delays.iter().zip(results) {
                tr {
                    td { (delay.name) }
                    td { (times(&delay.timing.fire_at_ms())) }
                    @match result {
                        Ok(checked) => {
                            td { (word(checked.verdict)) }
                            td.n { (value_and_error(checked.height.value, checked.height.error, Unit::Metre)) }
                            td.n { (value_and_error(checked.force.value, checked.force.error, Unit::Kilonewton)) }
                            td.n { (units::factor(checked.safety_factor)) }
                            td.n { (value_and_error(checked.drift.value, checked.drift.error, Unit::Metre)) }
                        }
                        Err(reason) => { td colspan="5" { (no_result::message(reason)) } }
                    }
                }
                @if let Ok(checked) = result {
                    @for reason in &checked.reasons {
                        tr { td {} td.quiet colspan="6" { (explain(reason)) } }
                    }
                    @if !checked.broken.is_empty() {
                        tr { td {} td.quiet colspan="6" { (broken(case.scene(), checked)) } }
                    }
                }
            }
        }
    }
}

fn times(ms: &[f64]) -> String {
    let times: Vec<String> = ms.iter().map(f64::to_string).collect();
    format!("{} ms", times.join(", "))
}

fn how(case: &Case, checked: &Checked) -> String {
    let [height, force] = peak(case.scene(), checked);
    format!(
        "Highest: {height}; greatest force: {force}; {}, step {}, {} runs, energy residual {:.0e}",
        compute_label(&checked.compute),
        units::milliseconds(checked.step),
        checked.runs,
        checked.energy_residual,
    )
}
