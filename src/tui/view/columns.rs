//! The columns of digits in the table of delay options, most important first.

use crate::study::as_planned::check::CheckedShot;
use crate::study::judge::Judgement;
use crate::study::judge::grounds::Evidence;
use crate::tui::app::App;
use crate::tui::compare::SortBy;
use crate::units::{self, Unit};
use crate::verdict::{Estimate, Quantity};

/// A column of digits: two head lines, sort key, width and cell text.
pub struct CompareColumn {
    pub head: [&'static str; 2],
    pub sort: SortBy,
    pub width: u16,
    pub cell: fn(&App, usize, &Judgement) -> String,
}

/// Second head line of columns that hold shares of a limit.
pub const SHARE: &str = "share";

/// Significant digits of a value. `BAND_DIGITS`: of a band.
const DIGITS: i32 = 3;
const BAND_DIGITS: i32 = 2;

pub const COLUMNS: &[CompareColumn] = &[
    CompareColumn { head: ["fail", "of tried"], sort: SortBy::Risk, width: 9, cell: failed_of_tried },
    CompareColumn {
        head: ["height", SHARE],
        sort: SortBy::Height,
        width: 6,
        cell: |app, _, judged| share_of_limit(app, judged, Quantity::Height),
    },
    CompareColumn {
        head: ["force", SHARE],
        sort: SortBy::Force,
        width: 6,
        cell: |app, _, judged| share_of_limit(app, judged, Quantity::Force),
    },
    CompareColumn {
        head: ["height", "plan, m"],
        sort: SortBy::Height,
        width: 8,
        cell: |app, option, _| {
            value_or_difference(app, option, |checked| checked.estimates.height, Unit::Metre)
        },
    },
    CompareColumn {
        head: ["force", "plan, kN"],
        sort: SortBy::Force,
        width: 8,
        cell: |app, option, _| {
            value_or_difference(app, option, |checked| checked.estimates.force, Unit::Kilonewton)
        },
    },
    CompareColumn {
        head: ["safety", "factor"],
        sort: SortBy::Force,
        width: 6,
        cell: |_, _, judged| units::factor(judged.checked.safety_factor),
    },
    CompareColumn {
        head: ["slide", "plan, m"],
        sort: SortBy::Drift,
        width: 8,
        cell: |app, option, _| {
            value_or_difference(app, option, |checked| checked.estimates.drift, Unit::Metre)
        },
    },
    CompareColumn {
        head: ["height, m", "90 % of shots"],
        sort: SortBy::Height,
        width: 13,
        cell: |_, _, judged| band(judged, Quantity::Height, Unit::Metre),
    },
    CompareColumn {
        head: ["force, kN", "90 % of shots"],
        sort: SortBy::Force,
        width: 13,
        cell: |_, _, judged| band(judged, Quantity::Force, Unit::Kilonewton),
    },
];

/// Failing shots of all sampled shots: `9/200`. Dots follow while more samples come.
fn failed_of_tried(app: &App, option: usize, judged: &Judgement) -> String {
    let more = if app.options[option].is_sampling() { "…" } else { "" };
    match &judged.sampled {
        Evidence::NotAsked => String::new(),
        Evidence::Awaited => format!("0{more}"),
        Evidence::Known(sampled) => format!("{}/{}{more}", sampled.bounds.failures, sampled.samples.len()),
    }
}

/// Short name of a quantity for screens.
pub fn name_of(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Height => "height",
        Quantity::Force => "force",
        Quantity::Drift => "slide",
    }
}

/// Share of a limit that an option uses, as text; empty if not known.
pub fn share_of_limit(app: &App, judged: &Judgement, quantity: Quantity) -> String {
    let share = judged.used_of_limit(quantity, &app.case.limits);
    share.map_or_else(String::new, |share| format!("{:.0} %", units::whole_percent(share)))
}

/// The 5th and the 95th percentile of a quantity, as text.
fn band(judged: &Judgement, quantity: Quantity, unit: Unit) -> String {
    let band = judged.sampled.known().and_then(|sampled| sampled.band(quantity));
    band.map_or_else(String::new, |[low, _, high, _]| {
        [low, high].map(|value| units::significant(value, unit, BAND_DIGITS)).join(" to ")
    })
}

/// A quantity of the planned shot, or its difference from the baseline.
fn value_or_difference(
    app: &App,
    option: usize,
    quantity: fn(&CheckedShot) -> Estimate,
    unit: Unit,
) -> String {
    let Some(Estimate { value: mine, error, .. }) =
        app.judgement(option).map(|judged| quantity(&judged.checked))
    else {
        return String::new();
    };
    // The value may still grow.
    let over = if error.is_infinite() { ">" } else { "" };
    match app.baseline() {
        Some((other, base)) if other != option => {
            let of_base = quantity(&base.checked);
            if of_base.error.is_infinite() {
                return "…".to_owned();
            }
            let difference = mine - of_base.value;
            let sign = if difference >= 0.0 { "+" } else { "" };
            format!("{over}{sign}{}", units::significant(difference, unit, BAND_DIGITS))
        }
        _ => format!("{over}{}", units::significant(mine, unit, DIGITS)),
    }
}
