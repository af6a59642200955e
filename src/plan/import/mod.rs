//! A starter plan from a list of holes, as blast design programs export it.

mod columns;
mod holes;
mod number;
mod table;
mod timing;

use std::fmt::Write;

use self::holes::{ListedHole, read};
use self::timing::{Group, groups};
use super::Diagnostics;
use super::keys::{MOST_TIRES, blast_row, delay, hole};
use super::starter::{self, LAUNCH_M_S, Shelter, USUAL, header, line, quoted};

/// Distances of holes [m] at which the tires lie as far apart as the holes; else the spacing is the usual one.
const NEAR_M: std::ops::RangeInclusive<f64> = 1.0..=3.0;
/// Rows of tires beyond the outermost holes, on each side.
const MARGIN: usize = 1;
/// Limit of flight height in the plan written [m]; the user replaces it.
const HEIGHT_M: f64 = 1.8;
/// Intervals of the delay options where the list has no firing times [ms].
const INTERVALS_MS: [f64; 3] = [17.0, 25.0, 42.0];

/// A plan from a list of holes.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    /// Text of the plan.
    pub text: String,
    /// What was read, and what was left out; one sentence each.
    pub notes: Vec<String>,
}

/// A plan for a list of holes: `text` holds values separated by commas, semicolons or tabs, `name` is the file.
///
/// The header names the columns: hole, x and y in metres, and one of: a row; a firing time (`fire_ms`, counted from the
/// first hole); a delay after another hole (`delay_ms` and `from`). A list without a header is read as one of Kirra's, which
/// have 4, 7, 9, 12 or 14 columns.
pub fn plan_from_holes(name: &str, text: &str) -> Result<Imported, Diagnostics> {
    let source = text.strip_prefix('\u{feff}').unwrap_or(text);
    let wrong = |mistakes| Diagnostics::new(name, source, mistakes);
    let table = read(source).map_err(wrong)?;
    let groups = groups(&table).map_err(wrong)?;
    let layout = Cover::of(&table.holes);
    if layout.rows.saturating_mul(layout.columns) > MOST_TIRES {
        let message = "the holes lie too far apart for one shelter".to_owned();
        return Err(Diagnostics::unreadable(
            name,
            message,
            "are x and y in metres? split the list into blasts",
        ));
    }
    let mut notes = vec![summary(&table.holes, &groups)];
    notes.extend(table.notes);
    Ok(Imported { text: write(name, &layout, &table.holes, &groups), notes })
}

/// What was read, in one sentence: holes, blast rows, first and last firing time.
fn summary(holes: &[ListedHole], groups: &[Group]) -> String {
    let count = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
    let read = format!("read {} in {}", count(holes.len(), "hole"), count(groups.len(), "blast row"));
    let last = groups.last().and_then(|group| group.fire_ms);
    match (last, groups.len()) {
        (Some(last), _) => format!("{read}, which fire from 0 to {last} ms"),
        (None, 1) if holes.iter().all(|hole| hole.row.is_none()) => {
            format!("{read}: the list has no rows and no firing times, so all holes fire at once")
        }
        (None, 1) => format!("{read}: all holes are of one row, so all fire at once"),
        (None, _) => format!("{read}; the list has no firing times: the delay options are assumed"),
    }
}

/// A grid of tires over all holes.
struct Cover {
    rows: usize,
    columns: usize,
    spacing_m: f64,
    /// Position of tire (1,1) in the coordinates of the list [m].
    origin: [f64; 2],
}

impl Cover {
    fn of(holes: &[ListedHole]) -> Self {
        let nearest = nearest_distance(holes);
        let spacing_m =
            if NEAR_M.contains(&nearest) { (nearest * 100.0).round() / 100.0 } else { USUAL.spacing_m };
        let range = |of: fn(&ListedHole) -> f64| {
            holes.iter().map(of).fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)))
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

/// Median distance of a hole to the nearest other hole [m], over the first thousand holes.
fn nearest_distance(holes: &[ListedHole]) -> f64 {
    let some = &holes[..holes.len().min(1000)];
    let nearest = |hole: &ListedHole| {
        let others = some.iter().map(|other| (other.x_m - hole.x_m).hypot(other.y_m - hole.y_m));
        others.filter(|&distance| distance > 0.0).fold(f64::INFINITY, f64::min)
    };
    let mut all: Vec<f64> = some.iter().map(nearest).collect();
    all.sort_by(f64::total_cmp);
    all.get(all.len() / 2).copied().unwrap_or(f64::INFINITY)
}

fn write(name: &str, cover: &Cover, holes: &[ListedHole], groups: &[Group]) -> String {
    let &Cover { rows, columns, spacing_m, origin } = cover;
    let shelter = Shelter { rows, columns, spacing_m, ..USUAL };
    let remark =
        format!("               # tire (1,1) lies at x = {:.3}, y = {:.3} of the list", origin[0], origin[1]);
    let mut text =
        "# Written by `shelter init --from`. Put in your tires, rope, friction and limits, and the launch velocity.\n"
            .to_owned();
    text += &shelter.sections(&format!("Holes of {name}"), &remark);
    for group in groups {
        text += &header(&blast_row::SECTION);
        text += &line(&blast_row::NAME, quoted(&group.name));
        let _ = writeln!(text, "{} = [", blast_row::HOLES.name);
        for &hole in &group.holes {
            let hole = &holes[hole];
            let _ = writeln!(
                text,
                "    {{ {} = {:.3}, {} = {:.3}, {} = {:?} }}, # {}",
                hole::X_M.name,
                hole.x_m - origin[0],
                hole::Y_M.name,
                hole.y_m - origin[1],
                hole::LAUNCH_M_S.name,
                hole.launch_m_s.unwrap_or(LAUNCH_M_S),
                hole.id,
            );
        }
        text += "]\n";
    }
    text += &starter::limits(HEIGHT_M);
    let times: Option<Vec<String>> =
        groups.iter().map(|group| Some(format!("{:?}", group.fire_ms?))).collect();
    match times {
        Some(times) => {
            text += &header(&delay::SECTION);
            text += &line(&delay::NAME, quoted("as listed"));
            text += &line(&delay::AT_MS, format!("[{}]", times.join(", ")));
        }
        None if groups.len() == 1 => text += &starter::delay(0.0),
        None => INTERVALS_MS.into_iter().for_each(|interval| text += &starter::delay(interval)),
    }
    text
}
