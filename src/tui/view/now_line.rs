//! One line about the flight at the shown time.
//!
//! ```text
//! MOST FORCE 0.160 s: cable 3:8-4:8 31.2 kN, 57 % of limit · of other shots 1 in 100 pulls over 33.7 kN in 2:1-3:1
//! now 0.412 s: tire 2:1 1.67 m, 71 % of limit · cable 3:1-4:1 12.1 kN, 22 % of limit · most: ^ 1.81 m, 31.2 kN at 3:8-4:8
//! ```

use itertools::Itertools;
use ratatui::text::{Line, Span};
use unicode_width::UnicodeWidthStr;

use crate::outcome::{Outcome, Peak};
use crate::study::flight::{Flight, GROUND, SAME_TIME, Stop};
use crate::study::samples::sampled_shot::SampledShot;
use crate::tui::app::App;
use crate::units::{self, Unit};
use crate::verdict::Quantity;

/// Relative difference below which two values count as equal. Displacements are recorded in single precision.
const ALIKE: f64 = 1e-4;

/// Wordings from longest to shortest.
type Wordings = [String; 3];

/// The highest tire and the hardest pulled cable at the shown time. If `width` [cells] has room, also the peaks of the whole flight, which
/// the charts below show as well.
pub fn now_line<'l>(app: &App, flight: &Flight, forces: &[f64], width: u16) -> Line<'l> {
    let seconds = units::seconds(app.player.time);
    let name = stop_name(app, flight).map_or("now".to_owned(), |stop| format!("{stop} {seconds}"));
    let [tire, cable] = [tire_words(app, flight), cable_words(app, flight, forces)];
    let others = of_other_shots(app, flight);
    // At the greatest force the line is only about cables. This leaves room for the cable of other shots, which may be the cable to
    // strengthen.
    let is_of_cables = name.starts_with(MOST_FORCE) && others.is_some();
    let [long, short, shortest] = [0, 1, 2].map(|n| match is_of_cables {
        true => cable[n].clone(),
        false => format!("{} · {}", tire[n], cable[n]),
    });
    let texts = [
        format!(" {name}: {long}"),
        format!(" {name}: {short}"),
        format!(" {name}: {shortest}"),
        format!(" {seconds}: {shortest}"),
    ];
    let marks: Vec<String> = others.into_iter().flatten().chain(of_whole_flight(flight)).collect();
    let fits = |text: &str, mark: &str| text.width() + mark.width() <= usize::from(width);
    let first = texts.iter().position(|text| fits(text, "")).unwrap_or(3);
    // The cable to strengthen is more important than the long wording before it.
    let (named, unnamed) = marks.split_at(OF_OTHERS - 1);
    let of_others = [named, unnamed].into_iter().flat_map(|marks| texts[..3].iter().cartesian_product(marks));
    let with_others = of_others.filter(|_| is_of_cables).find(|(text, mark)| fits(text, mark));
    let alone = || Some(&texts[first]).zip(marks.iter().find(|mark| fits(&texts[first], mark)));
    let (text, mark) =
        with_others.or_else(alone).map_or((&texts[first], ""), |(text, mark)| (text, mark.as_str()));
    // The option is judged by the harder pull of other shots, so it stands out.
    let style = if with_others.is_some() { app.theme.title() } else { app.theme.muted() };
    Line::from(vec![Span::styled(text.clone(), app.theme.title()), Span::styled(mark.to_owned(), style)])
}

/// The highest tire at the shown time.
fn tire_words(app: &App, flight: &Flight) -> Wordings {
    let (peak, limit) = (&flight.outcome.height, app.case.limits.height);
    let heights: Vec<f64> = flight.at(app.player.time).iter().map(|u| f64::from(u[2])).collect();
    let Some((tire, height)) = greatest(app, peak, &heights) else {
        return [(); 3].map(|()| "no tire in the air".to_owned());
    };
    let value = format!("{} m", units::significant(height, Unit::Metre, 3));
    wordings(&format!("tire {}", flight.scene.tire_ids[tire]), &value, height / limit)
}

/// The hardest pulled cable at the shown time.
fn cable_words(app: &App, flight: &Flight, forces: &[f64]) -> Wordings {
    let (peak, limit) = (&flight.outcome.force, app.case.limits.force);
    let Some((cable, force)) = greatest(app, peak, forces) else {
        return [(); 3].map(|()| "no cable taut".to_owned());
    };
    let value = format!("{} kN", units::significant(force, Unit::Kilonewton, 3));
    wordings(&format!("cable {}", flight.scene.cable_name(cable)), &value, force / limit)
}

/// Index and value of the greatest value at the shown time. At the time of the peak, the peak itself, which lies between two recorded
/// times. `None` if no tire is in the air, or no cable pulls.
fn greatest(app: &App, peak: &Peak, values: &[f64]) -> Option<(usize, f64)> {
    if peak.time == app.player.time && peak.value > 0.0 {
        return Some((peak.index, peak.value));
    }
    // Mirror images differ only by rounding. The first one counts, as in the peaks of the run.
    let higher = |most: (usize, f64), (n, &value): (usize, &f64)| match value > most.1 * (1.0 + ALIKE) {
        true => (n, value),
        false => most,
    };
    let most = values.iter().enumerate().fold((0, 0.0), higher);
    Some(most).filter(|(_, value)| *value > f64::from(GROUND))
}

/// A value with its share of the limit, because the value alone would be half the answer.
fn wordings(place: &str, value: &str, share: f64) -> Wordings {
    // Rounded up as everywhere: a value over the limit is never shown as 100 %.
    let share = format!("{:.0} %", units::whole_percent(share));
    [
        format!("{place} {value}, {share} of limit"),
        format!("{place} {value} {share}"),
        format!("{value} {share}"),
    ]
}

/// The peaks of the whole flight.
fn of_whole_flight(flight: &Flight) -> Wordings {
    let Outcome { height, force, .. } = &flight.outcome;
    let kn = units::significant(force.value, Unit::Kilonewton, 3);
    let pulled = match force.value > 0.0 {
        true => format!("{kn} kN at {}", flight.scene.cable_name(force.index)),
        false => "no cable pulls".to_owned(),
    };
    let height = units::significant(height.value, Unit::Metre, 3);
    [format!(" · most: ^ {height} m, {pulled}"), format!(" · most: {pulled}"), " · ^ highest".to_owned()]
}

/// Number of wordings about the pull in other shots.
const OF_OTHERS: usize = 4;

/// The pull of cables in other shots, if it exceeds the pull in this shot; the deciding shot is only one shot.
fn of_other_shots(app: &App, flight: &Flight) -> Option<[String; OF_OTHERS]> {
    let sampled = app.judgement(app.selected)?.sampled.known().filter(|_| flight.sample.is_some())?;
    let force =
        sampled.deciding_value(Quantity::Force).filter(|force| *force > flight.outcome.force.value)?;
    let one_in = units::one_in(sampled.share_above());
    let cables = SampledShot::deciding_cables(sampled).unwrap_or_default();
    let strengthen =
        cables.first().map_or(String::new(), |&(cable, _)| format!(" in {}", flight.scene.cable_name(cable)));
    let kn = units::significant(force, Unit::Kilonewton, 3);
    Some([
        format!(" · of other shots 1 in {one_in} pulls over {kn} kN{strengthen}"),
        format!(" · in others {kn} kN{strengthen}"),
        format!(" · others {kn}{strengthen}"),
        format!(" · others {kn} kN"),
    ])
}

/// Name of the stop at the greatest force.
const MOST_FORCE: &str = "MOST FORCE";

/// Name of the stop at the shown time; `None` if the flight has no stop there.
fn stop_name(app: &App, flight: &Flight) -> Option<String> {
    let is_now = |at: f64| (at - app.player.time).abs() < SAME_TIME;
    let stops: Vec<Stop> =
        flight.stops().into_iter().filter(|(at, _)| is_now(*at)).map(|(_, stop)| stop).collect();
    if stops.contains(&Stop::Force) {
        return Some(MOST_FORCE.to_owned());
    }
    if stops.contains(&Stop::Height) {
        return Some("HIGHEST".to_owned());
    }
    let rows = stops.iter().filter_map(|stop| match stop {
        Stop::Row { row, at_once } => Some((app.case.plan.blast_rows.get(*row)?.name.as_str(), *at_once)),
        Stop::Force | Stop::Height => None,
    });
    let (names, at_once): (Vec<&str>, Vec<bool>) = rows.unzip();
    let [fires, fire] = match at_once.iter().all(|at_once| *at_once) {
        true => ["fires", "fire"],
        false => ["begins to fire", "begin to fire"],
    };
    match names[..] {
        [] => None,
        [row] => Some(format!("row {row} {fires}")),
        _ => Some(format!("rows {} {fire}", names.join(", "))),
    }
}
