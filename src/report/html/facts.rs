//! The planned shot on the page: shelter, cables, limits and blast rows, and the command that gives the same results.

use itertools::{Itertools, MinMaxResult};
use maud::{Markup, html};

use crate::choice::OnOverload;
use crate::plan::{
    CableSpec, DelayOption, DelayScatter, GroundSpec, Hole, Launch, LaunchTargets, Layout, Mesh, Plan,
    Uncertainty,
};
use crate::report::language::{phrase, say};
use crate::report::words::limits::limits;
use crate::report::words::option_sentences;
use crate::report::words::plan_notes::beyond_paper;
use crate::ropes::catalogue;
use crate::scene::Scene;
use crate::sorting::sorted_by_key;
use crate::study::eight_ms::WithinEightMs;
use crate::study::judge::OptionResults;
use crate::study::samples::sample_count::Sampling;
use crate::study::{Case, ComputeSettings};
use crate::units::{self, Unit};

/// The plan as a table. Blast rows stand with the times at which the option `to_be_fired` fires them.
pub fn shelter(case: &Case, to_be_fired: Option<usize>) -> Markup {
    let (plan, scene) = (&case.plan, case.scene());
    let gone = match plan.cable.on_overload {
        OnOverload::Break => phrase("; past its breaking force a cable is gone"),
        OnOverload::Report => "",
    };
    html! {
        dl.pairs {
            div { dt { (phrase("Tires")) } dd { (say!("{tires} of {mass} kg, {layout}, {rims}", scene.tire_count(), masses(plan), layout(plan), rims(plan.tire.outer_diameter_m))) } }
            div { dt { (phrase("Cover")) } dd { (cover(plan, scene)) } }
            @if let Some(charge) = to_be_fired.and_then(|option| charge(case, option)) {
                div { dt { (phrase("Charge")) } dd { (charge) } }
            }
            @if let Some(option) = to_be_fired { div { dt { (phrase("Duds")) } dd { (taken_along(&plan.delays[option])) } } }
            div { dt { (phrase("Cables")) } dd { (say!("{cables}, slack {percent} %", scene.cables.len(), plan.cable.slack_percent)) (gone) } }
            @for (name, text) in rope(&plan.cable) { div { dt { (phrase(name)) } dd { (text) } } }
            div { dt { (phrase("Ground")) } dd { (ground(&plan.ground)) } }
            @if let Some(more) = also_counted(plan) { div { dt { (phrase("Also counted")) } dd { (more) } } }
            div { dt { (phrase("Limits")) } dd { (limits(case)) } }
            @for (n, row) in plan.blast_rows.iter().enumerate() {
                div { dt { (say!("Blast row {name}", row.name)) } dd { (launched(&row.targets, &hole_times(case, to_be_fired, n))) (fires_at(case, to_be_fired, n)) } }
            }
        }
    }
}

/// Effects that the plan adds to the source paper's model, and the longest time for which a shot is followed.
fn also_counted(plan: &Plan) -> Option<String> {
    let followed =
        plan.simulation.duration_s.map(|duration| say!("followed for {duration} s at most", duration));
    let all: Vec<String> = beyond_paper(plan).into_iter().chain(followed).collect();
    (!all.is_empty()).then(|| all.join(" · "))
}

/// Whether a dud stops the holes behind it.
fn taken_along(delay: &DelayOption) -> &'static str {
    phrase(match delay.hole_timing.fired_through {
        true => "one hole fires the next: with a dud those behind it do not fire",
        false => "taken to stop no other hole: each needs its own way of initiation",
    })
}

/// Mass of the tires [kg], or the least and the greatest mass.
fn masses(plan: &Plan) -> String {
    match plan.tire_masses().into_iter().minmax() {
        MinMaxResult::MinMax(least, greatest) if least < greatest => {
            say!("{least} to {greatest}", least, greatest)
        }
        masses => masses.into_option().map_or_else(String::new, |(least, _)| least.to_string()),
    }
}

/// Mass of all tires; in a mesh also the mass per square metre of the shelter.
fn cover(plan: &Plan, scene: &Scene) -> String {
    let whole = say!("{} kg of tires", units::rounded(scene.mass.iter().sum(), 0));
    let per_cell = |mesh: &Mesh, tires: f64| {
        let area = mesh.row_spacing_m * mesh.column_spacing_m;
        say!(
            "{whole}, {} kg on each square metre of the shelter, gaps counted",
            whole,
            units::short(tires * plan.tire.mass_kg / area)
        )
    };
    match &plan.layout {
        Layout::Grid(mesh) => per_cell(mesh, 1.0),
        Layout::Quincunx(mesh) => per_cell(mesh, 2.0),
        Layout::List { .. } => whole,
    }
}

/// Charge of all holes of an option, and the divisor that turns a distance into a scaled distance; `None` where the plan names no
/// charges.
fn charge(case: &Case, option: usize) -> Option<String> {
    let shot = &case.shots[option];
    let within = WithinEightMs::of(case, shot).charge?;
    let all: f64 = shot.firings.iter().map(|firing| firing.charge).sum();
    let [all, heaviest] = [all, within].map(option_sentences::kg_to_the_gram);
    Some(say!(
        "{all} kg in all holes, {heaviest} kg within any 8 ms; scaled distance = distance in m / {}",
        all,
        heaviest,
        units::short(heaviest.sqrt())
    ))
}

/// The rope, its termination, and the breaking force of both together, each with its name.
fn rope(cable: &CableSpec) -> [(&'static str, String); 3] {
    let used =
        say!("{} kN, of rope and termination", units::exact(cable.breaking_force_kn * 1e3, Unit::Kilonewton));
    let alone = cable.breaking_force_kn / (cable.termination_percent * 1e-2);
    let strength = say!(
        "EA {} kN, breaking force {} kN",
        whole(cable.axial_stiffness_kn),
        units::exact(alone * 1e3, Unit::Kilonewton)
    );
    let from_catalogue = cable.rope.as_deref().and_then(|name| Some((name, catalogue().find(name)?)));
    let rope = match from_catalogue {
        Some((name, rope)) => {
            let grade = if rope.grade > 0 { say!(", grade {} N/mm²", rope.grade) } else { String::new() };
            let typical = if rope.typical {
                phrase("; typical figures: the certificate of the rope counts")
            } else {
                ""
            };
            say!(
                "{name}: {}, diameter {} mm{grade}, {strength}{typical}",
                name,
                phrase(&rope.construction),
                rope.diameter_mm,
                grade,
                strength,
                typical
            )
        }
        None => say!("{strength}, as the plan says", strength),
    };
    let efficiency = cable.termination_percent;
    let termination = match &cable.termination {
        Some(name) => say!("{name}, efficiency {efficiency} %", name, efficiency),
        None if efficiency < 100.0 => say!("efficiency {efficiency} %, as the plan says", efficiency),
        None => say!("none named: the whole breaking force of the rope counts"),
    };
    [("Rope", rope), ("Termination", termination), ("Breaking force used", used)]
}

/// A stiffness [kN] without needless digits.
fn whole(stiffness: f64) -> String {
    if stiffness >= 100.0 { units::rounded(stiffness, 0) } else { units::short(stiffness) }
}

/// Firing time of each hole of a row by the option to be fired; empty where all holes of the row fire at once.
fn hole_times(case: &Case, to_be_fired: Option<usize>, row: usize) -> Vec<String> {
    let Some(shot) = to_be_fired.map(|option| &case.shots[option]) else { return Vec::new() };
    let of_row = shot.firings.iter().filter(|firing| firing.row == row);
    let holes = sorted_by_key(of_row, |firing| firing.number);
    let times: Vec<f64> = holes.into_iter().map(|firing| firing.time).collect();
    match times.iter().all_equal() {
        true => Vec::new(),
        false => times.into_iter().map(units::exact_milliseconds).collect(),
    }
}

/// Firing time of the holes of a row by the option to be fired: `; fires at 42 ms`.
fn fires_at(case: &Case, to_be_fired: Option<usize>, row: usize) -> String {
    let Some(shot) = to_be_fired.map(|option| &case.shots[option]) else { return String::new() };
    let holes = || shot.firings.iter().filter(|firing| firing.row == row).map(|firing| firing.time);
    let (first, last) = (holes().fold(f64::INFINITY, f64::min), holes().fold(0.0, f64::max));
    match holes().count() {
        0 => String::new(),
        1 => say!("; fires at {}", units::exact_milliseconds(first)),
        count if first == last => say!("; {count} holes fire at {}", count, units::exact_milliseconds(first)),
        count => {
            let [first, last] = [first, last].map(units::exact_milliseconds);
            say!("; {count} holes fire from {first} to {last}", count, first, last)
        }
    }
}

/// The unknowns of `[uncertainty]`, with the defaults of keys left out.
pub fn uncertainty(unknown: &Uncertainty) -> Markup {
    let DelayScatter { sd_ms, cv_percent } = unknown.delay;
    let between = |[low, high]: [f64; 2], unit: &str| {
        say!("anything between {low}{unit} and {high}{unit}", low, unit, high)
    };
    let deviation =
        |sd: f64, unit: &str| say!("standard deviation {sd}{unit} along each horizontal axis", sd, unit);
    let rows = [
        (
            "Delays between blast rows",
            say!(
                "standard deviation {sd_ms} ms or {cv_percent} % of the delay, the greater",
                sd_ms,
                cv_percent
            ),
        ),
        ("Delay in the holes", say!("{} ms, scattering alike", unknown.in_hole_delay_ms)),
        ("Launch velocities, hole by hole", say!("coefficient of variation {} %", unknown.launch_cv_percent)),
        ("Launch velocities in common", say!("coefficient of variation {} %", unknown.launch_common_percent)),
        (
            "Launch velocities, shot by shot",
            say!("coefficient of variation {} %", unknown.launch_between_shots_percent),
        ),
        ("Launch velocity at another mass m' of the tire", {
            let [low, high] = unknown.launch_mass_exponent;
            say!("V0 (m/m')^n, n anything between {low} and {high}", low, high)
        }),
        (
            "Launch velocities, row by row",
            say!("coefficient of variation {} %", unknown.launch_row_cv_percent),
        ),
        ("Launch directions, hole by hole", deviation(unknown.launch_tilt_deg, "°")),
        ("Launch directions of the whole shot", deviation(unknown.launch_tilt_common_deg, "°")),
        ("Place of a hole", deviation(unknown.hole_position_m, " m")),
        ("Place of the shelter over all holes", deviation(unknown.pattern_offset_m, " m")),
        ("Holes that do not fire", say!("{} %, each by itself", unknown.hole_fails_percent)),
        (
            "Length of cables as tied, cable by cable",
            say!("standard deviation {} m, never shorter than what a cable spans", unknown.cable_length_m),
        ),
        ("Friction", between(unknown.friction, "")),
        ("Slack", between(unknown.slack_percent, " %")),
        (
            "Axial stiffness of the rope",
            say!("its own, changed by {}", between(unknown.axial_stiffness_percent, " %")),
        ),
        ("Tire masses, tire by tire", say!("coefficient of variation {} %", unknown.tire_mass_cv_percent)),
        (
            "Breaking forces, cable by cable",
            say!("coefficient of variation {} %", unknown.breaking_force_cv_percent),
        ),
    ];
    html! { dl.pairs { @for (name, text) in rows { div { dt { (phrase(name)) } dd { (text) } } } } }
}

fn layout(plan: &Plan) -> String {
    match &plan.layout {
        Layout::Grid(mesh) => {
            say!(
                "{} × {}, {} m × {} m apart",
                mesh.rows,
                mesh.columns,
                mesh.row_spacing_m,
                mesh.column_spacing_m
            )
        }
        Layout::Quincunx(mesh) => say!(
            "{} × {} with centres, {} m × {} m apart",
            mesh.rows,
            mesh.columns,
            mesh.row_spacing_m,
            mesh.column_spacing_m
        ),
        Layout::List { .. } => say!("placed one by one"),
    }
}

fn ground(ground: &GroundSpec) -> String {
    let GroundSpec { friction, slope_percent, slope_toward_deg } = *ground;
    match slope_percent {
        0.0 => say!("friction {friction}, level", friction),
        _ => say!(
            "friction {friction}, falls {slope_percent} % toward {slope_toward_deg}° from +x; heights are normal to it",
            friction,
            slope_percent,
            slope_toward_deg
        ),
    }
}

fn rims(diameter_m: f64) -> String {
    if diameter_m > 0.0 {
        say!("outer diameter {diameter_m} m: cables from rim to rim", diameter_m)
    } else {
        say!("cables from centre to centre")
    }
}

/// Tires or holes that a row launches. Listed holes stand with their firing times, where these differ.
fn launched(targets: &LaunchTargets, times: &[String]) -> String {
    match targets {
        LaunchTargets::UnderRow { row, launch } => {
            say!("under shelter row {row}, launch {}", row, speed(launch))
        }
        LaunchTargets::UnderTires { tires, launch } => {
            let numbers: Vec<String> = tires.iter().map(|tire| (tire + 1).to_string()).collect();
            say!("under tires {}, launch {}", numbers.join(", "), speed(launch))
        }
        LaunchTargets::Holes(holes) => {
            let hole = |(n, hole): (usize, &Hole)| {
                let time = times.get(n).map_or_else(String::new, |time| format!(", {time}"));
                format!("({}, {}) m {}{time}", hole.x_m, hole.y_m, speed(&hole.launch))
            };
            let count = if holes.len() == 1 { say!("1 hole") } else { say!("{} holes", holes.len()) };
            format!("{count}: {}", holes.iter().enumerate().map(hole).collect::<Vec<_>>().join(" · "))
        }
    }
}

fn speed(launch: &Launch) -> String {
    let Launch {
        speed_m_s,
        tilt_deg,
        tilt_toward_deg,
        push_ms,
        charge_kg,
        stemming_m,
        hole_diameter_mm,
        push_depth_m,
    } = *launch;
    let mut text = format!("{speed_m_s} m/s");
    if tilt_deg > 0.0 {
        text += &say!(", tilted by {tilt_deg}° toward {tilt_toward_deg}° from +x", tilt_deg, tilt_toward_deg);
    }
    if push_ms > 0.0 {
        text += &say!(", pushed over {push_ms} ms", push_ms);
    }
    if let Some(charge_kg) = charge_kg {
        text += &format!(", {charge_kg} kg");
    }
    if let Some(hole_diameter_mm) = hole_diameter_mm {
        text += &say!(", hole of {hole_diameter_mm} mm", hole_diameter_mm);
    }
    if let Some(stemming_m) = stemming_m {
        text += &say!(", stemming {stemming_m} m", stemming_m);
    }
    if let Some(push_depth_m) = push_depth_m {
        text += &say!(", pushed from {push_depth_m} m below the hole's mouth", push_depth_m);
    }
    text
}

/// A path as a shell takes it; the word `PLAN` for standard input.
pub fn quoted(path: &str) -> String {
    match path {
        "-" => "PLAN".to_owned(),
        _ if path.starts_with('-') => quoted_word(&format!("./{path}")),
        _ => quoted_word(path),
    }
}

/// A word as a shell takes it.
pub fn quoted_word(word: &str) -> String {
    let plain = |letter: char| letter.is_alphanumeric() || "/._-+".contains(letter);
    if word.chars().all(plain) { word.to_owned() } else { format!("'{}'", word.replace('\'', "'\\''")) }
}

/// The command that gives the same results.
pub fn command(case: &Case, results: &OptionResults, sampling: Option<&Sampling>) -> String {
    let mut command = format!("shelter check {}", quoted(&case.source.name()));
    let (asked, of_plan) = (
        results.iter().flatten().next().map(|judged| judged.checked.compute),
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
