//! `launch` as a report: every estimate of the launch velocity side by side on one scale, the chosen estimate, and what to film.

use super::fit::refusal;
use super::parts::{Block, Cell, Column, Field, Report, Table, fact};
use super::report_head;
use super::words::advice::{loose_tire, what_to_film};
use crate::study::Case;
use crate::study::fit::what_next::WhatNext;
use crate::study::launch::{
    FittedShots, Kind, LaunchEstimate, LaunchEstimates, NotWritten, fastest_launch, slowest_launch,
};
use crate::units::{self, Unit};

/// Estimates of the launch velocity of a blast, and the estimate that is taken.
pub struct FoundLaunch<'a> {
    /// The plan; `None` where there is none.
    pub case: Option<&'a Case>,
    /// The plan after the launch is written into it; `None` where nothing is written.
    pub written: Option<&'a Case>,
    /// The estimates.
    pub estimates: &'a LaunchEstimates,
    /// The estimate that is taken; `None` where none may be.
    pub chosen: Option<&'a LaunchEstimate>,
    /// Fits of earlier shots.
    pub fits: &'a [FittedShots],
    /// What to observe next on this plan.
    pub next: Option<&'a WhatNext>,
}

/// Name of a kind of estimate.
fn kind_name(kind: Kind) -> &'static str {
    match kind {
        Kind::EarlierShots => "earlier shots",
        Kind::TestTire => "loose test tire",
        Kind::Heave => "heave by energy",
        Kind::Collar => "impulse at the collar",
        Kind::RockSpeed => "speed of the rock",
    }
}

/// Kinds of estimates that may go into a plan, with their names on the command line.
pub const KINDS_TO_USE: [(&str, Kind); 4] = [
    ("earlier-shots", Kind::EarlierShots),
    ("test-tire", Kind::TestTire),
    ("heave", Kind::Heave),
    ("collar", Kind::Collar),
];

/// Name of an estimate, with what tells the estimate from others of its kind.
pub fn estimate_name(estimate: &LaunchEstimate) -> String {
    let LaunchEstimate { kind, name, .. } = estimate;
    match name.is_empty() {
        true => kind_name(*kind).to_owned(),
        false => format!("{}: {name}", kind_name(*kind)),
    }
}

/// Source of an estimate, for the comment in a plan.
pub fn words_for_plan(estimate: &LaunchEstimate) -> String {
    let seen = if estimate.kind.is_observed() { "" } else { "; nobody observed it: film a shot" };
    format!("{}, {}{seen}", estimate_name(estimate), estimate.basis)
}

/// Why an estimate does not go into a plan.
pub fn not_written(why: NotWritten) -> &'static str {
    match why {
        NotWritten::PlanIsSurer => {
            "the plan says that its launch was observed, which is surer than a formula; name the formula with --use to write it all the same"
        }
        NotWritten::PlanIsFitted => {
            "the plan holds what `fit` found of earlier shots, which is surer; take `fitted_from` out of it to begin anew"
        }
        NotWritten::PlanIsFaster => {
            "the plan says that a faster launch was observed, and of several test tires the fastest counts; where none was observed, write \
             `launch_common_percent = 50` first"
        }
        NotWritten::PlanHoldsIt => "the plan holds it already",
        NotWritten::PlanTiltsOrPushes => {
            "the plan has `tilt_deg` or `push_ms`, and such a launch is faster than a tire rises: enter the film with `shelter fit`"
        }
        NotWritten::OutOfRange => "the estimate is out of the range for which it was made",
    }
}

/// Source of the numbers of a kind.
pub fn source(kind: Kind) -> &'static str {
    match kind {
        Kind::EarlierShots => "fit of the observations",
        Kind::TestTire => "V0 = sqrt(2 g h) = g T / 2",
        Kind::Heave => "energy shares of 3, 10 and 20 %: Huang 2022, Sanchidrian",
        Kind::Collar => "McKenzie 2009 after Lundborg: an upper bound, x 0.25 to 1",
        Kind::RockSpeed => "Richards and Moore 2004: of fragments, not of the cover",
    }
}

/// Range for which a kind of estimate was made.
fn made_for(kind: Kind) -> &'static str {
    match kind {
        Kind::EarlierShots => "for charges and stemmings up to 1.5 times those of the shots",
        Kind::TestTire => "for readings better than 30 % of the velocity",
        Kind::Heave => "for a free face and 0.15 to 0.60 kg/m³",
        Kind::Collar => {
            "for scaled depths of 0.6 to 2.4, holes of 76 to 380 mm, stemmings of 4 to 43 diameters"
        }
        Kind::RockSpeed => "its source states no range; holes and stemmings as of the collar",
    }
}

/// One estimate on the scale of all.
struct EstimateRow<'a> {
    estimate: &'a LaunchEstimate,
    /// Right end of the scale [m/s].
    top: f64,
}

impl EstimateRow<'_> {
    /// The band as bars along the scale: 0 outside the band, 0.5 inside, 1 at the middle.
    fn bars(&self) -> Vec<f64> {
        let [low, median, high] = self.estimate.band.map(|speed| speed / self.top * SCALE_PARTS as f64);
        let part = |n: usize| {
            let (from, to) = (n as f64, n as f64 + 1.0);
            match () {
                () if (from..to).contains(&median) => 1.0,
                () if low < to && high > from => 0.5,
                () => 0.0,
            }
        };
        (0..SCALE_PARTS).map(part).collect()
    }
}

/// Number of bars of the scale.
const SCALE_PARTS: usize = 24;

fn fields<'a>() -> [Field<EstimateRow<'a>>; 8] {
    fn speed(keys: &'static [&'static str], heading: &'static str) -> Column {
        Column::numbers(keys, heading, Unit::One)
    }
    [
        Field::new(Column::words(&["name"], "estimate"), |row| Cell::Text(estimate_name(row.estimate))),
        Field::new(speed(&["low"], "low, m/s"), |row| Cell::Rounded(row.estimate.band[0], 1)),
        Field::new(speed(&["median"], "middle, m/s"), |row| Cell::Rounded(row.estimate.band[1], 1)),
        Field::new(speed(&["high"], "high, m/s"), |row| Cell::Rounded(row.estimate.band[2], 1)),
        Field::new(Column::scripts(&["unit"]), |_| Cell::Text("m/s".to_owned())),
        Field::new(Column::words(&[], "on one scale"), |row| Cell::Sparkline {
            series: row.bars(),
            top: 1.0,
        }),
        Field::new(Column::words(&["valid"], "in range"), |row| Cell::Flag(row.estimate.is_valid())),
        Field::new(Column::scripts(&["source"]), |row| Cell::Text(source(row.estimate.kind).to_owned())),
    ]
}

/// The report of all estimates.
pub fn report(found: &FoundLaunch<'_>) -> Report {
    let FoundLaunch { case, written, estimates, chosen, next, .. } = *found;
    let schema = "shelter.launch/1";
    let without_plan = || Report { schema, ..Report::default() };
    // The report warns of the plan as it will be: the written plan, where there is one.
    let mut report = written.or(case).map_or_else(without_plan, |case| report_head(case, schema, false));
    let own = case.map(|case| fastest_launch(&case.plan));
    let greatest = estimates.all.iter().map(|estimate| estimate.band[2]).fold(own.unwrap_or(0.0), f64::max);
    let blocks = &mut report.blocks;
    if !estimates.all.is_empty() {
        let rows = estimates.all.iter().map(|estimate| EstimateRow { estimate, top: greatest });
        let scale = format!("the scale runs from 0 to {} m/s", units::rounded(greatest, 1));
        let grounds = estimates.all.iter().map(ground);
        blocks.extend([
            Block::Table(Table::of(&fields(), rows).key("estimates")),
            Block::Text([scale].into_iter().chain(grounds).collect()),
        ]);
    }
    blocks.push(Block::Facts(vec![
        fact(&["chosen.launch_m_s"], chosen.map(|chosen| chosen.band[1])),
        fact(&["chosen.launch_common_percent"], chosen.map(|chosen| chosen.common_percent)),
    ]));
    blocks.push(Block::Text(missing_words(estimates).chain(choice(chosen, own)).collect()));
    let film = case.zip(next).map_or_else(Vec::new, |(case, next)| what_to_film(case, next));
    let loose = chosen.is_none_or(|chosen| chosen.kind != Kind::EarlierShots).then(|| {
        format!("before a covered shot: {}", loose_tire(case.and_then(|case| case.plan.mass_of_all_tires())))
    });
    blocks.push(Block::Text(loose.into_iter().chain(film).collect()));
    report.warnings.extend(warnings(found));
    report
}

/// Basis of an estimate, source of its numbers, and the range for which it was made.
fn ground(estimate: &LaunchEstimate) -> String {
    let LaunchEstimate { kind, basis, .. } = estimate;
    format!("{}: {basis}; {}; {}", estimate_name(estimate), source(*kind), made_for(*kind))
}

/// Sentences: what the missing estimates need.
pub fn missing_words(estimates: &LaunchEstimates) -> impl Iterator<Item = String> {
    estimates.missing.iter().map(|(kind, missing)| format!("{} needs {}", kind_name(*kind), missing.0))
}

/// Sentences: the chosen estimate, beside the launch of the plan.
fn choice(chosen: Option<&LaunchEstimate>, own: Option<f64>) -> Vec<String> {
    let Some(LaunchEstimate { kind, band: [low, median, high], common_percent, .. }) = chosen else {
        return vec!["nothing is chosen: no estimate in its range tells the launch of the cover".to_owned()];
    };
    let [speed, percent] = [units::rounded(*median, 2), units::rounded(*common_percent, 1)];
    let surety = match kind.is_observed() {
        true => "",
        false => "; only bounds are known, so no option passes on it: \"launch estimated\"",
    };
    let chosen =
        format!("chosen: {}, launch_m_s {speed}, launch_common_percent {percent}{surety}", kind_name(*kind));
    let beside = own.map(|own| {
        let lies = if (*low..=*high).contains(&own) { "lies in" } else { "lies outside of" };
        format!("the fastest launch of the plan, {} m/s, {lies} its band", units::short(own))
    });
    [chosen].into_iter().chain(beside).collect()
}

fn warnings(found: &FoundLaunch<'_>) -> Vec<String> {
    let FoundLaunch { case, estimates, fits, chosen, .. } = *found;
    let out_of_range = estimates.all.iter().filter_map(|estimate| {
        let why = estimate.out_of_range.as_ref()?;
        Some(format!("{}: out of the range for which it was made: {why}", estimate_name(estimate)))
    });
    let disagree = estimates.disagreements().into_iter().map(|[one, other]| {
        format!(
            "{} and {} disagree by more than their bands: is the blast plan right?",
            estimate_name(one),
            estimate_name(other)
        )
    });
    let unfitted = fits.iter().filter(|shots| shots.fit().is_none()).map(|shots| {
        let why = case.and_then(|case| refusal(case, &shots.found));
        let why = why.unwrap_or_else(|| "the fit tells no one launch; see `shelter fit`".to_owned());
        format!("{}: {why}", shots.name())
    });
    let over_the_slowest = case
        .filter(|_| chosen.is_some_and(|chosen| chosen.kind == Kind::TestTire))
        .and_then(of_differing_rows);
    out_of_range.chain(disagree).chain(unfitted).chain(over_the_slowest).collect()
}

/// Warning about one test tire in a plan whose rows launch differently.
fn of_differing_rows(case: &Case) -> Option<String> {
    let range @ [slowest, fastest] = [slowest_launch(&case.plan), fastest_launch(&case.plan)];
    let [slow, fast] = range.map(units::short);
    (slowest < fastest).then(|| {
        format!(
            "the plan launches at {slow} to {fast} m/s: `--write` takes the test tire as lying over a hole of {slow} m/s and \
             scales all others with it; correct by hand what was seen over another hole"
        )
    })
}
