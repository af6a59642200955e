//! What was planned, for the page: shelter, cables, limits and blast rows, and the command that gives the results again.

use maud::{Markup, html};

use crate::choice::OnOverload;
use crate::plan::{DelayScatter, GroundSpec, Hole, Launch, LaunchTargets, Layout, Plan, Uncertainty};
use crate::report::limits::limits;
use crate::study::check_all::OptionResults;
use crate::study::sampling::Sampling;
use crate::study::{Case, ComputeSettings};

/// The plan as a table.
pub fn shelter(case: &Case) -> Markup {
    let (plan, scene) = (&case.plan, case.scene());
    let cable = match &plan.cable.rope {
        Some(rope) => format!("{rope}, termination {} %", plan.cable.termination_percent),
        None => format!("EA {} kN", plan.cable.axial_stiffness_kn),
    };
    html! {
        table {
            tr { th { "Tires" } td { (scene.mass.len()) " of " (plan.tire.mass_kg) " kg, " (layout(plan)) ", " (rims(plan.tire.outer_diameter_m)) } }
            tr { th { "Cables" } td { (scene.cables.len()) ", " (cable) ", slack " (plan.cable.slack_percent) " %" (if plan.cable.on_overload == OnOverload::Break { "; past its breaking force a cable is gone" } else { "" }) } }
            tr { th { "Ground" } td { (ground(&plan.ground)) } }
            tr { th { "Limits" } td { (limits(case)) } }
            @for row in &plan.blast_rows {
                tr { th { "Blast row " (row.name) } td { (launched(&row.targets)) } }
            }
        }
    }
}

/// What `[uncertainty]` says, with the defaults of keys left out.
pub fn uncertainty(unknown: &Uncertainty) -> Markup {
    let DelayScatter { sd_ms, cv_percent } = unknown.delay;
    let between =
        |[low, high]: [f64; 2], unit: &str| format!("anything between {low}{unit} and {high}{unit}");
    let rows = [
        (
            "Delays between blast rows",
            format!("standard deviation {sd_ms} ms or {cv_percent} % of the delay, the greater"),
        ),
        ("Delay in the holes", format!("{} ms, scattering alike", unknown.in_hole_delay_ms)),
        (
            "Launch velocities, hole by hole",
            format!("coefficient of variation {} %", unknown.launch_cv_percent),
        ),
        (
            "Launch velocities in common",
            format!("coefficient of variation {} %", unknown.launch_common_percent),
        ),
        (
            "Launch directions",
            format!("standard deviation {}° about each horizontal axis", unknown.launch_tilt_deg),
        ),
        ("Friction", between(unknown.friction, "")),
        ("Slack", between(unknown.slack_percent, " %")),
        (
            "Axial stiffness of the rope",
            format!("its own, changed by {}", between(unknown.axial_stiffness_percent, " %")),
        ),
        ("Tire masses, tire by tire", format!("coefficient of variation {} %", unknown.tire_mass_cv_percent)),
        (
            "Breaking forces, cable by cable",
            format!("coefficient of variation {} %", unknown.breaking_force_cv_percent),
        ),
    ];
    html! { table { @for (name, text) in rows { tr { th { (name) } td { (text) } } } } }
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

fn ground(ground: &GroundSpec) -> String {
    let GroundSpec { friction, slope_percent, slope_toward_deg } = *ground;
    match slope_percent {
        0.0 => format!("friction {friction}, level"),
        _ => format!(
            "friction {friction}, falls {slope_percent} % toward {slope_toward_deg}° from +x; heights are normal to it"
        ),
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
        LaunchTargets::UnderRow { row, launch } => {
            format!("under shelter row {row}, launch {}", speed(launch))
        }
        LaunchTargets::UnderTires { tires, launch } => {
            let numbers: Vec<String> = tires.iter().map(|tire| (tire + 1).to_string()).collect();
            format!("under tires {}, launch {}", numbers.join(", "), speed(launch))
        }
        LaunchTargets::Holes(holes) => {
            let hole = |hole: &Hole| format!("({}, {}) m {}", hole.x_m, hole.y_m, speed(&hole.launch));
            format!("{} holes: {}", holes.len(), holes.iter().map(hole).collect::<Vec<_>>().join(" · "))
        }
    }
}

fn speed(launch: &Launch) -> String {
    let Launch { speed_m_s, tilt_deg, tilt_toward_deg, push_ms, charge_kg } = *launch;
    let mut text = format!("{speed_m_s} m/s");
    if tilt_deg > 0.0 {
        text += &format!(", tilted by {tilt_deg}° toward {tilt_toward_deg}° from +x");
    }
    if push_ms > 0.0 {
        text += &format!(", pushed over {push_ms} ms");
    }
    if let Some(charge_kg) = charge_kg {
        text += &format!(", {charge_kg} kg");
    }
    text
}

/// A path as a shell takes it; one of standard input by a word in its place.
fn quoted(path: &str) -> String {
    let plain = |letter: char| letter.is_alphanumeric() || "/._-+".contains(letter);
    match path {
        "-" => "PLAN".to_owned(),
        _ if path.starts_with('-') => quoted(&format!("./{path}")),
        _ if path.chars().all(plain) => path.to_owned(),
        _ => format!("'{}'", path.replace('\'', "'\\''")),
    }
}

/// The command that gives these results.
pub fn command(case: &Case, results: &OptionResults, sampling: Option<&Sampling>) -> String {
    let mut command = format!("shelter check {}", quoted(&case.source.path));
    let (asked, of_plan) = (
        results.iter().flatten().next().map(|judged| judged.as_planned.compute),
        ComputeSettings::of(&case.plan),
    );
    if let Some(ComputeSettings { method, accuracy, step }) = asked.filter(|asked| *asked != of_plan) {
        command += &format!(" --method {} --accuracy {}", method.name(), accuracy.name());
        if let Some(step) = step {
            command += &format!(" --dt {step}");
        }
    }
    match sampling {
        None => command += " --nominal",
        Some(Sampling { most, seed, .. }) => command += &format!(" --samples {most} --seed {seed}"),
    }
    command
}
