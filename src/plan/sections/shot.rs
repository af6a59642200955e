//! Reads blast rows and delay options: the tires launched, and the firing times.

use std::collections::{HashMap, HashSet};

use crate::choice::{HoleOrder, Method};
use crate::plan::keys::{blast_row, delay, hole, plan};
use crate::plan::names::look;
use crate::plan::reader::{Mistakes, SectionReader, nearest};
use crate::plan::{
    BlastRow, DelayOption, Hole, HoleTiming, Launch, LaunchTargets, Layout, NearestPoint, Plan,
    SimulationSpec, Time, Timing,
};

pub fn read_blast_rows(
    root: &SectionReader<'_>,
    layout: Option<&Layout>,
    simulation: &SimulationSpec,
    mistakes: &Mistakes,
) -> Vec<BlastRow> {
    let shelter = layout.map(ShelterOverHoles::of);
    let (mut rows, mut named) = (Vec::new(), HashMap::new());
    for section in root.sections(&plan::BLAST_ROW) {
        let name = section.name(&blast_row::NAME);
        mistakes.check_name("blast row", &name, &mut named);
        let targets = read_targets(&section, shelter.as_ref(), simulation, mistakes);
        rows.push(BlastRow { name: name.value.to_owned(), targets });
        section.finish();
    }
    rows
}

/// Notes a mistake if only some holes have a charge, or if a limit of charges has no charge to judge.
pub fn check_charges(plan: &Plan, root: &SectionReader<'_>) {
    let (stated, absent): (Vec<&Launch>, Vec<&Launch>) =
        plan.launches().partition(|launch| launch.charge_kg.is_some());
    if absent.is_empty() {
        return;
    }
    if !stated.is_empty() {
        let message = "some holes have `charge_kg`, others have none";
        root.wrong(&plan::BLAST_ROW, message, "give every row or hole its charge_kg, or none of them");
    } else if plan.limits.charge_in_8_ms_kg.is_some() {
        let message = "`charge_in_8_ms_kg` of [limits] has no charge to judge";
        root.wrong(&plan::BLAST_ROW, message, "give every row or hole its charge_kg");
    }
}

/// The shelter, as the reader of holes needs it.
struct ShelterOverHoles<'l> {
    layout: &'l Layout,
    /// Tires listed one by one.
    listed: NearestPoint,
    /// Greatest distance between the centres of tied tires [m].
    widest_tie: f64,
}

impl<'l> ShelterOverHoles<'l> {
    fn of(layout: &'l Layout) -> Self {
        let listed = match layout {
            Layout::List { tires, .. } => tires.iter().map(|tire| [tire.x_m, tire.y_m]).collect(),
            Layout::Grid(_) | Layout::Quincunx(_) => Vec::new(),
        };
        Self { layout, listed: NearestPoint::of(listed), widest_tie: layout.widest_tie() }
    }

    /// Distance of a point from the area of a mesh, or from the nearest listed tire [m].
    fn distance_outside(&self, x: f64, y: f64) -> f64 {
        match self.layout {
            Layout::Grid(mesh) | Layout::Quincunx(mesh) => mesh.distance_outside(x, y),
            Layout::List { tires, .. } => {
                let tire = self.listed.to([x, y]).and_then(|nearest| tires.get(nearest));
                tire.map_or(f64::INFINITY, |tire| (tire.x_m - x).hypot(tire.y_m - y))
            }
        }
    }
}

fn read_targets(
    section: &SectionReader<'_>,
    shelter: Option<&ShelterOverHoles<'_>>,
    simulation: &SimulationSpec,
    mistakes: &Mistakes,
) -> LaunchTargets {
    let given =
        [&blast_row::UNDER_ROW, &blast_row::UNDER_TIRES, &blast_row::HOLES].map(|key| section.has(key));
    if given.iter().filter(|&&given| given).count() != 1 {
        let message = if given.contains(&true) {
            "a blast row says twice what it launches"
        } else {
            "a blast row launches no tire"
        };
        let remedy = "give it exactly one of under_row, under_tires, holes";
        mistakes.add(section.span.clone(), message, remedy);
    }
    if section.has(&blast_row::HOLES) {
        for key in [
            &blast_row::LAUNCH_M_S,
            &blast_row::FREE_FLIGHT_HEIGHT_M,
            &blast_row::TILT_DEG,
            &blast_row::TILT_TOWARD_DEG,
            &blast_row::PUSH_MS,
            &blast_row::CHARGE_KG,
            &blast_row::STEMMING_M,
            &blast_row::HOLE_DIAMETER_MM,
            &blast_row::PUSH_DEPTH_M,
        ] {
            if section.has(key) {
                let message = format!("`{}` stands beside `holes`", key.name);
                section.wrong(key, message, "write it in each hole of `holes`, behind its x_m and y_m");
            }
        }
        return LaunchTargets::Holes(read_holes(section, shelter, simulation));
    }
    let launch = read_launch(section, simulation);
    if let Some(tires) = section.whole_numbers(&blast_row::UNDER_TIRES) {
        let layout = shelter.map(|shelter| shelter.layout);
        let count = match layout {
            Some(Layout::List { tires, .. }) => tires.len(),
            Some(_) => {
                let remedy = "use under_row, or holes, in a grid or quincunx";
                section.wrong(
                    &blast_row::UNDER_TIRES,
                    "`under_tires` numbers the tires of a list layout",
                    remedy,
                );
                usize::MAX
            }
            None => usize::MAX,
        };
        if tires.value.is_empty() {
            mistakes.add(tires.span, "a blast row that launches no tire", "list at least one");
        }
        for tire in tires.value.iter().filter(|tire| tire.value == 0 || tire.value > count) {
            let message = format!("there is no tire {}", tire.value);
            let last = if count == usize::MAX { String::new() } else { format!(" to {count}") };
            mistakes.add(tire.span.clone(), message, format!("tires are numbered from 1{last}"));
        }
        let mut tires_seen = HashSet::new();
        for tire in &tires.value {
            if !tires_seen.insert(tire.value) {
                let message = format!("tire {} is launched twice", tire.value);
                mistakes.add(tire.span.clone(), message, "name each tire once");
            }
        }
        let tires = tires.value.into_iter().map(|tire| tire.value.saturating_sub(1)).collect();
        return LaunchTargets::UnderTires { tires, launch };
    }
    let row = section.number_if(&blast_row::UNDER_ROW).unwrap_or(1.0);
    check_row(section, shelter.map(|shelter| shelter.layout), row);
    LaunchTargets::UnderRow { row, launch }
}

fn read_holes(
    section: &SectionReader<'_>,
    shelter: Option<&ShelterOverHoles<'_>>,
    simulation: &SimulationSpec,
) -> Vec<Hole> {
    let holes = section.sections(&blast_row::HOLES);
    if holes.is_empty() {
        section.wrong(&blast_row::HOLES, "a blast row without a hole", "list its holes, or remove the row");
    }
    holes.into_iter().map(|hole| read_hole(hole, shelter, simulation)).collect()
}

fn read_hole(
    section: SectionReader<'_>,
    shelter: Option<&ShelterOverHoles<'_>>,
    simulation: &SimulationSpec,
) -> Hole {
    let x_m = section.number(&hole::X_M);
    let y_m = section.number(&hole::Y_M);
    let launch = read_launch(&section, simulation);
    let distances = shelter.map(|shelter| (shelter.distance_outside(x_m, y_m), shelter.widest_tie));
    if let Some((away, most)) = distances.filter(|(away, most)| away > most) {
        let message =
            format!("this hole lies {away:.1} m beside the shelter, whose tires lie {most:.1} m apart");
        let remedy = "holes and tires share one system of coordinates, in which tire (1,1) of a mesh lies at 0, 0; `shelter init --from` moves a list of holes there";
        section.wrong(&hole::X_M, message, remedy);
    }
    section.finish();
    Hole { x_m, y_m, launch }
}

fn check_row(section: &SectionReader<'_>, layout: Option<&Layout>, row: f64) {
    let (rows, halves) = match layout {
        Some(Layout::Grid(mesh)) => (mesh.rows, false),
        Some(Layout::Quincunx(mesh)) => (mesh.rows, true),
        Some(Layout::List { .. }) if section.has(&blast_row::UNDER_ROW) => {
            return section.wrong(
                &blast_row::UNDER_ROW,
                "a list layout has no rows",
                "use under_tires = [1, 2], or holes",
            );
        }
        _ => return,
    };
    let whole = row.fract() == 0.0 || (halves && row.fract() == 0.5);
    if !(whole && row >= 1.0 && row <= rows as f64) {
        let centres = if halves { ", centres between them at halves such as 1.5" } else { "" };
        let remedy = format!("shelter rows are numbered 1 to {rows}{centres}");
        section.wrong(&blast_row::UNDER_ROW, format!("there is no shelter row {row}"), remedy);
    }
}

/// Ratio of the upward force of a push to the weight of the tire, above which the push lifts the tire. The margin above 1 is more than
/// launches vary.
const LEAST_LIFT: f64 = 1.5;

fn read_launch(section: &SectionReader<'_>, simulation: &SimulationSpec) -> Launch {
    if section.has(&blast_row::TILT_TOWARD_DEG) && !section.has(&blast_row::TILT_DEG) {
        let message = "`tilt_toward_deg` stands without `tilt_deg`";
        section.wrong(&blast_row::TILT_TOWARD_DEG, message, "add tilt_deg, or remove it");
    }
    let [push_ms, tilt_deg] = [&blast_row::PUSH_MS, &blast_row::TILT_DEG].map(|key| section.number(key));
    let tilt_toward_deg = section.number(&blast_row::TILT_TOWARD_DEG);
    if push_ms > 0.0 && simulation.method == Method::Newmark {
        let message = "newmark has no push over a time";
        section.wrong(&blast_row::PUSH_MS, message, "leave it out, or choose method \"verlet\"");
    }
    for (key, value) in [(&blast_row::PUSH_MS, push_ms), (&blast_row::TILT_DEG, tilt_deg)] {
        if value > 0.0 && section.has(&blast_row::FREE_FLIGHT_HEIGHT_M) {
            let message = format!(
                "`{}` stands beside `free_flight_height_m`, from which a launch straight up at once follows",
                key.name
            );
            section.wrong(key, message, "give launch_m_s instead of free_flight_height_m");
        }
    }
    let speed_m_s = read_speed(section, simulation);
    let upward = speed_m_s * tilt_deg.to_radians().cos();
    if push_ms > 0.0 && upward <= LEAST_LIFT * simulation.gravity_m_s2 * push_ms * 1e-3 {
        let message = format!(
            "a push of {upward:.1} m/s upward over {push_ms} ms hardly lifts a tire: gravity takes as much"
        );
        section.wrong(
            &blast_row::PUSH_MS,
            message,
            "shorten push_ms, or give the launch velocity without gravity",
        );
    }
    let charge_kg = section.number_if(&blast_row::CHARGE_KG);
    let [stemming_m, hole_diameter_mm, push_depth_m] =
        [&blast_row::STEMMING_M, &blast_row::HOLE_DIAMETER_MM, &blast_row::PUSH_DEPTH_M]
            .map(|key| section.number_if(key));
    Launch {
        speed_m_s,
        tilt_deg,
        tilt_toward_deg,
        push_ms,
        charge_kg,
        stemming_m,
        hole_diameter_mm,
        push_depth_m,
    }
}

/// Launch speed [m/s].
fn read_speed(section: &SectionReader<'_>, simulation: &SimulationSpec) -> f64 {
    match (section.has(&blast_row::LAUNCH_M_S), section.has(&blast_row::FREE_FLIGHT_HEIGHT_M)) {
        (true, true) => {
            section.wrong(
                &blast_row::FREE_FLIGHT_HEIGHT_M,
                "`free_flight_height_m` stands beside `launch_m_s`",
                "keep one of them",
            );
            0.0
        }
        (false, true) => {
            let height = section.number(&blast_row::FREE_FLIGHT_HEIGHT_M);
            if simulation.gravity_m_s2 == 0.0 {
                let message = "without gravity no launch velocity follows from a height";
                section.wrong(&blast_row::FREE_FLIGHT_HEIGHT_M, message, "give launch_m_s instead");
            }
            (2.0 * simulation.gravity_m_s2 * height).sqrt()
        }
        _ => section.number(&blast_row::LAUNCH_M_S),
    }
}

pub fn read_delays(root: &SectionReader<'_>, rows: &[BlastRow], mistakes: &Mistakes) -> Vec<DelayOption> {
    let (mut delays, mut named) = (Vec::new(), HashMap::new());
    for section in root.sections(&plan::DELAY) {
        let name = section.name(&delay::NAME);
        mistakes.check_name("delay option", &name, &mut named);
        let timing = read_timing(&section, rows, mistakes);
        let hole_timing = read_hole_timing(&section);
        delays.push(DelayOption { name: name.value.to_owned(), timing, hole_timing });
        section.finish();
    }
    delays
}

fn read_hole_timing(section: &SectionReader<'_>) -> HoleTiming {
    if section.has(&delay::HOLE_ORDER) && !section.has(&delay::HOLE_INTERVAL_MS) {
        let message = "`hole_order` stands without `hole_interval_ms`";
        section.wrong(&delay::HOLE_ORDER, message, "add hole_interval_ms, or remove it");
    }
    HoleTiming {
        interval: section.time(&delay::HOLE_INTERVAL_MS),
        order: section.choice(&delay::HOLE_ORDER, HoleOrder::DEFAULT),
        fired_through: section.flag(&delay::FIRED_THROUGH),
    }
}

fn read_timing(section: &SectionReader<'_>, rows: &[BlastRow], mistakes: &Mistakes) -> Timing {
    if let Some(at) = section.numbers(&delay::AT_MS) {
        for key in [&delay::INTERVAL_MS, &delay::ORDER] {
            if section.has(key) {
                section.wrong(key, format!("`{}` stands beside `at_ms`", key.name), "keep one of them");
            }
        }
        if at.value.len() != rows.len() {
            let message = format!("{} firing times for {} blast rows", at.value.len(), rows.len());
            mistakes.add(at.span, message, "give one time for each blast row, in the order listed");
        }
        return Timing::At(at.value.into_iter().map(|time| Time::from_ms(time.value)).collect());
    }
    let interval = section.time(&delay::INTERVAL_MS);
    let names: HashMap<String, usize> =
        rows.iter().enumerate().map(|(n, row)| (look(&row.name), n)).collect();
    let Some(list) = section.texts(&delay::ORDER) else {
        return Timing::Interval { order: (0..rows.len()).collect(), interval };
    };
    let mut order = Vec::new();
    for name in &list.value {
        match names.get(&look(name.value)) {
            None => {
                let near = nearest(name.value, rows.iter().map(|row| row.name.as_str()));
                let all: Vec<_> = rows.iter().map(|row| format!("\"{}\"", row.name)).collect();
                let remedy = near.map_or_else(
                    || format!("the rows are {}", all.join(", ")),
                    |near| format!("did you mean \"{near}\"?"),
                );
                mistakes.add(name.span.clone(), format!("no blast row is named \"{}\"", name.value), remedy);
            }
            Some(row) if order.contains(row) => {
                let message = format!("the order names row \"{}\" twice", name.value);
                mistakes.add(name.span.clone(), message, "name each row once");
            }
            Some(&row) => order.push(row),
        }
    }
    if order.len() < rows.len() && list.value.len() < rows.len() {
        let absent = rows.iter().enumerate().filter(|(n, _)| !order.contains(n));
        let names: Vec<_> = absent.map(|(_, row)| format!("\"{}\"", row.name)).collect();
        mistakes.add(list.span, "the order leaves out a blast row", format!("add {}", names.join(", ")));
    }
    Timing::Interval { order, interval }
}
