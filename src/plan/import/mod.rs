//! Writes a starter plan from a list of holes, as blast design programs export it.

mod columns;
mod direction;
mod header;
mod holes;
pub(super) mod number;
#[cfg(feature = "shotplus")]
mod shotplus;
mod stated_units;
pub(super) mod table;
mod timing;
mod unfired;

use std::collections::HashSet;
use std::fmt::Write;
use std::path::Path;

use itertools::Itertools;

pub use self::direction::Directions;
use self::direction::Tilt;
use self::holes::{Holes, ListedHole};
use self::timing::{Group, Timed, delays_are_whole, timed};
use super::Diagnostics;
use super::diagnostic::Mistake;
use super::keys::{MOST_TIRES, blast_row, delay, hole};
use super::source::{Unreadable, read_bytes, text_of};
use super::starter::{self, LAUNCH_IS_ASSUMED, LAUNCH_M_S, Shelter, USUAL, header, line, quoted};
use crate::units::{self, Unit};

/// Distances between holes [m] that become the spacing of the tires; other distances give the usual spacing.
const NEAR_M: std::ops::RangeInclusive<f64> = 1.0..=3.0;
/// Least median distance between holes [m]. Holes closer to one another are not in metres.
const TOO_NEAR_M: f64 = 0.1;
/// Rows of tires beyond the outermost holes, on each side.
const MARGIN: usize = 1;
/// Limit of flight height in the new plan [m]; the user replaces it.
const HEIGHT_M: f64 = 1.8;
/// Safety factor of the cables in the new plan.
const SAFETY_FACTOR: f64 = 1.5;
/// Intervals of the delay options if the list has no firing times [ms].
const INTERVALS_MS: [f64; 3] = [17.0, 25.0, 42.0];

/// A plan from a list of holes.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    /// Text of the plan.
    pub text: String,
    /// What was read and what was left out, in one sentence each.
    pub notes: Vec<String>,
}

/// A plan for the list of holes in a file; `-` is standard input. A ZIP archive is a design of SHOTPlus, any other file a table for
/// [`plan_from_holes`].
pub fn plan_from_file(path: &Path, directions: Directions) -> Result<Imported, Diagnostics> {
    let name = crate::plan::visible(&path.display().to_string()).into_owned();
    let unreadable = |(message, remedy): Unreadable| Diagnostics::unreadable(&name, message, remedy);
    let bytes = read_bytes(path).map_err(unreadable)?;
    if bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"PK\x05\x06") {
        plan_from_design(&name, &bytes, directions)
    } else if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("spf")) {
        let message = "the file is no ZIP archive, as designs of SHOTPlus 6 are".to_owned();
        Err(unreadable((message, "copy it again, or save it in SHOTPlus 6 again")))
    } else {
        plan_from_holes(&name, &text_of(bytes).map_err(unreadable)?, directions)
    }
}

#[cfg(feature = "shotplus")]
fn plan_from_design(name: &str, archive: &[u8], directions: Directions) -> Result<Imported, Diagnostics> {
    let unreadable = |(message, remedy): Unreadable| Diagnostics::unreadable(name, message, remedy);
    let xml = shotplus::list(archive).map_err(unreadable)?;
    let holes = shotplus::read(&xml, directions);
    let holes = holes.map_err(|mistakes| Diagnostics::new(name, &xml, mistakes))?;
    plan(name, &xml, holes, directions)
}

#[cfg(not(feature = "shotplus"))]
fn plan_from_design(name: &str, _: &[u8], _: Directions) -> Result<Imported, Diagnostics> {
    let message = "designs of SHOTPlus are not read by this build".to_owned();
    Err(Diagnostics::unreadable(name, message, "build it with the feature `shotplus`"))
}

/// A plan for a list of holes. `text` holds values separated by commas, semicolons or tabs; `name` is the file.
///
/// The header names the columns: hole, x and y in metres, and one of: a row; a firing time (`fire_ms`, counted from the first hole); a
/// delay after another hole (`delay_ms` and `from`). Lists without a header are read only if Kirra wrote them, with the preceding hole of
/// each hole. Directions need the columns `angle_from_vertical_deg` and `bearing_deg`.
pub fn plan_from_holes(name: &str, text: &str, directions: Directions) -> Result<Imported, Diagnostics> {
    let source = text.strip_prefix('\u{feff}').unwrap_or(text);
    let holes =
        holes::read(source, directions).map_err(|mistakes| Diagnostics::new(name, source, mistakes))?;
    plan(name, source, holes, directions)
}

/// Largest number of holes that a note names.
const MOST_NAMED: usize = 6;

fn plan(name: &str, source: &str, list: Holes, directions: Directions) -> Result<Imported, Diagnostics> {
    let timed = launches_are_whole(&list.holes).and_then(|()| timed(&list));
    let timed = timed.map_err(|mistakes| Diagnostics::new(name, source, mistakes))?;
    let nearest = nearest_distance(&list.holes);
    if nearest < TOO_NEAR_M {
        let message = format!("most holes lie less than {TOO_NEAR_M} m from another");
        return Err(Diagnostics::unreadable(
            name,
            message,
            "are x and y in metres? convert degrees or kilometres",
        ));
    }
    let layout = TireGrid::of(&list.holes, nearest);
    if layout.rows.saturating_mul(layout.columns) > MOST_TIRES {
        let message = "the holes lie too far apart for one shelter".to_owned();
        return Err(Diagnostics::unreadable(
            name,
            message,
            "are x and y in metres? split the list into blasts",
        ));
    }
    let text = write(name, &layout, &list.holes, &timed.groups, directions);
    let mut notes = vec![summary(&list, &timed, directions)];
    let begins = |hole: &&ListedHole| hole.from.as_ref() == Some(&hole.id);
    let first: Vec<&str> = list.holes.iter().filter(begins).map(|hole| hole.id.as_str()).collect();
    let follow = list.holes.iter().any(|hole| hole.from.as_ref().is_some_and(|from| *from != hole.id));
    if follow && first.len() > 1 {
        let more = first.len().saturating_sub(MOST_NAMED);
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        notes.push(format!(
            "the holes {}{more} follow no other hole, each fires at its own delay: is one of them not tied in?",
            first.iter().take(MOST_NAMED).join(", ")
        ));
    }
    notes.extend(fires_alone(&list.holes, &timed));
    let are_listed = list.holes.iter().all(|hole| hole.launch_m_s.is_some());
    if are_listed {
        notes.push(
            "launch velocities are as listed; nobody says that they were observed, so no option passes before you write how well you know \
             them into launch_common_percent"
                .to_owned(),
        );
    }
    let velocities = if are_listed { "" } else { "launch velocities, " };
    let tilts = if directions == Directions::AgainstHoles { "launch directions, " } else { "" };
    notes.push(format!(
        "assumed, put in yours: {velocities}{tilts}tires, rope, slack, friction, limits, detonators and [uncertainty]"
    ));
    if nearest.is_finite() {
        let metres = |length: f64| units::significant(length, Unit::Metre, 3);
        notes.push(format!(
            "neighbouring holes lie {} m apart, x to the east and y to the north, by this list, under {} x {} tires: compare it with your pattern",
            metres(nearest),
            layout.rows,
            layout.columns
        ));
        let some = &list.holes[..list.holes.len().min(MOST_COMPARED)];
        let apart = |hole: &ListedHole| nearest_other(hole, some);
        let far = some.iter().max_by(|a, b| apart(a).total_cmp(&apart(b)));
        notes.extend(far.filter(|hole| apart(hole) > FAR_FROM_OTHERS * nearest).map(|hole| {
            format!("hole {} lies {} m from any other: a slip of the pen?", hole.id, metres(apart(hole)))
        }));
    }
    notes.extend(list.notes);
    Ok(Imported { text, notes })
}

/// Time [ms] before all other firings from which a hole may not be tied in.
const LONG_BEFORE_MS: f64 = 200.0;

/// Warning that the first holes fire long before all others, which fire closer to one another.
fn fires_alone(holes: &[ListedHole], timed: &Timed) -> Option<String> {
    let fire = |group: &Group| group.fire.map(|time| time.ms());
    let [first, second, .., last] = &timed.groups[..] else { return None };
    let (alone, others) = (fire(second)? - fire(first)?, fire(last)? - fire(second)?);
    let who = match first.holes[..] {
        [hole] => format!("hole {} fires", holes[hole].id),
        _ => format!("{} holes fire", first.holes.len()),
    };
    let is_told = alone > LONG_BEFORE_MS && alone > others;
    is_told.then(|| format!("{who} {alone} ms before all others: tied in?"))
}

/// Notes a mistake if some holes have a launch velocity and others have none.
fn launches_are_whole(holes: &[ListedHole]) -> Result<(), Vec<Mistake>> {
    let without: Vec<&ListedHole> = holes.iter().filter(|hole| hole.launch_m_s.is_none()).collect();
    if without.is_empty() || without.len() == holes.len() {
        return Ok(());
    }
    let mistake = |hole: &&ListedHole| Mistake {
        span: hole.span.clone(),
        message: format!("hole {} has no launch velocity", hole.id),
        remedy: "give every hole one, or none".to_owned(),
    };
    Err(without.iter().map(mistake).collect())
}

/// Summary in one line: holes, blast rows, first and last firing time, launch directions, and what was left out.
fn summary(list: &Holes, timed: &Timed, directions: Directions) -> String {
    let holes = &list.holes;
    let count = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
    let read = format!("read {} in {}", count(holes.len(), "hole"), count(timed.groups.len(), "blast row"));
    let last = timed.groups.last().and_then(|group| group.fire);
    let mut line = match (last, timed.groups.len()) {
        (Some(_), 1) => format!("{read}: all fire at {} ms, at once", timed.first),
        (Some(last), _) => {
            format!("{read}, which fire from {} to {} ms", timed.first, timed.first + last)
        }
        (None, 1) if holes.iter().all(|hole| hole.row.is_none()) => {
            format!("{read}: the list has no rows and no firing times, so all holes fire at once")
        }
        (None, 1) => format!("{read}: all holes are of one row, so all fire at once"),
        (None, _) => {
            let names: Vec<&str> = timed.groups.iter().map(|group| group.name.as_str()).collect();
            let order = names.join(", ");
            format!(
                "{read}, fired in the order of the list: {order}; it has no firing times: the delay options are assumed"
            )
        }
    };
    let mut left_out = list.left_out.clone();
    let has_delays = holes.iter().any(|hole| hole.delay_ms.is_some());
    if has_delays && holes.iter().any(|hole| hole.fire_ms.is_some()) && !delays_are_whole(holes) {
        left_out.push("the delays after other holes, which not every hole has".to_owned());
    }
    if timed.without_rows {
        left_out.push("the rows, as the firing times group the holes otherwise".to_owned());
    }
    let names: HashSet<&str> = holes.iter().map(|hole| hole.id.as_str()).collect();
    if names.len() < holes.len() {
        line += "; holes of different rows have the same names";
    }
    let tilts = holes.iter().filter_map(|hole| hole.tilt).map(|tilt| tilt.deg);
    match (directions, tilts.reduce(f64::max)) {
        (Directions::Vertical, _) => {}
        (Directions::AgainstHoles, None) => line += "; launches are vertical, as all holes are",
        (Directions::AgainstHoles, Some(steepest_deg)) => {
            line += &format!(
                "; launches point against the holes' way down, up to {steepest_deg} degrees from the vertical"
            );
        }
    }
    if !left_out.is_empty() {
        line += &format!("; left out: {}", left_out.join("; "));
    }
    line
}

/// A grid of tires over all holes.
struct TireGrid {
    rows: usize,
    columns: usize,
    spacing_m: f64,
    /// Position of tire (1,1) in the coordinates of the list [m].
    origin: [f64; 2],
}

impl TireGrid {
    /// A grid over holes with this median distance `nearest` [m].
    fn of(holes: &[ListedHole], nearest: f64) -> Self {
        let spacing_m =
            if NEAR_M.contains(&nearest) { (nearest * 100.0).round() / 100.0 } else { USUAL.spacing_m };
        let range = |coordinate: fn(&ListedHole) -> f64| {
            holes
                .iter()
                .map(coordinate)
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)))
        };
        let ((left, right), (bottom, top)) = (range(|hole| hole.x_m), range(|hole| hole.y_m));
        let count = |way: f64| (way / spacing_m - 1e-6).ceil().max(0.0) as usize + 1 + 2 * MARGIN;
        let margin = MARGIN as f64 * spacing_m;
        Self {
            rows: count(top - bottom),
            columns: count(right - left),
            spacing_m,
            origin: [left - margin, bottom - margin],
        }
    }
}

/// Warning limit: distance of a hole to the nearest other hole, over the median of this distance.
const FAR_FROM_OTHERS: f64 = 3.0;

/// Distance of a hole to the nearest other one [m].
fn nearest_other(hole: &ListedHole, holes: &[ListedHole]) -> f64 {
    let others = holes.iter().map(|other| (other.x_m - hole.x_m).hypot(other.y_m - hole.y_m));
    others.filter(|&distance| distance > 0.0).fold(f64::INFINITY, f64::min)
}

/// Number of holes, from the first on, whose distances are compared.
const MOST_COMPARED: usize = 1000;

/// Median distance of a hole to the nearest other hole [m].
fn nearest_distance(holes: &[ListedHole]) -> f64 {
    let some = &holes[..holes.len().min(MOST_COMPARED)];
    let mut all: Vec<f64> = some.iter().map(|hole| nearest_other(hole, some)).collect();
    all.sort_by(f64::total_cmp);
    all.get(all.len() / 2).copied().unwrap_or(f64::INFINITY)
}

fn write(
    name: &str,
    grid: &TireGrid,
    holes: &[ListedHole],
    groups: &[Group],
    directions: Directions,
) -> String {
    let &TireGrid { rows, columns, spacing_m, origin } = grid;
    let shelter = Shelter { rows, columns, spacing_m, ..USUAL };
    let remark =
        format!("               # tire (1,1) lies at x = {:.3}, y = {:.3} of the list", origin[0], origin[1]);
    let mut text =
        "# Written by `shelter init --from`. Put in your tires, rope, friction and limits, and the launch velocity.\n"
            .to_owned();
    if directions == Directions::AgainstHoles {
        text += "# Launch directions are assumed: each launch points against the way down of its hole, by its angle and bearing.\n";
    }
    text += &shelter.sections(&format!("Holes of {name}"), &remark);
    for group in groups {
        text += &header(&blast_row::SECTION);
        text += &line(&blast_row::NAME, quoted(&group.name));
        if group.holes.iter().any(|&hole| holes[hole].launch_m_s.is_none()) {
            text += LAUNCH_IS_ASSUMED;
            text += "\n";
        }
        let _ = writeln!(text, "{} = [", blast_row::HOLES.name);
        for &hole in &group.holes {
            let hole = &holes[hole];
            let _ = writeln!(
                text,
                "    {{ {} = {:.3}, {} = {:.3}, {} = {:?}{}{} }}, # {}",
                hole::X_M.name,
                hole.x_m - origin[0],
                hole::Y_M.name,
                hole.y_m - origin[1],
                hole::LAUNCH_M_S.name,
                hole.launch_m_s.unwrap_or(LAUNCH_M_S),
                hole.tilt.map_or(String::new(), tilt_keys),
                hole.charge_kg.map_or(String::new(), charge_key),
                hole.id,
            );
        }
        text += "]\n";
    }
    text += &starter::limits(HEIGHT_M, SAFETY_FACTOR, true);
    let times: Option<Vec<String>> =
        groups.iter().map(|group| Some(format!("{:?}", group.fire?.ms()))).collect();
    match times {
        Some(times) => {
            text += &header(&delay::SECTION);
            text += &line(&delay::NAME, quoted("as listed"));
            text += &line(&delay::AT_MS, format!("[{}]", times.join(", ")));
        }
        None if groups.len() == 1 => text += &starter::delay(0.0),
        None => INTERVALS_MS.into_iter().for_each(|interval| text += &starter::delay(interval)),
    }
    // A velocity in a list is no film of a tire, so it counts as guessed.
    text + &starter::uncertainty(true, USUAL.rope)
}

/// The key of a charge [kg], to the gram, behind the other keys of its hole.
fn charge_key(charge_kg: f64) -> String {
    format!(", {} = {:?}", hole::CHARGE_KG.name, (charge_kg * 1e3).round() / 1e3)
}

/// The keys of a tilt, behind the other keys of its hole.
fn tilt_keys(tilt: Tilt) -> String {
    let (angle, toward) = (hole::TILT_DEG.name, hole::TILT_TOWARD_DEG.name);
    format!(", {angle} = {:?}, {toward} = {:?}", tilt.deg, tilt.toward_deg)
}
