//! The table of delay options: a row per option, as many columns as the width holds.

use ratatui::Frame;
use ratatui::layout::{Constraint, Rect};
use ratatui::style::Style;
use ratatui::text::Line;
use ratatui::widgets::{Row as Cells, Table, TableState};

use super::gauges;
use crate::report::words::no_result;
use crate::study::as_planned::check::CheckedShot;
use crate::study::judgement::{Evidence, Judgement};
use crate::tui::app::{App, Areas, ClickTarget};
use crate::tui::compare::OptionState;
use crate::tui::compare::SortBy;
use crate::tui::theme;
use crate::units::{self, Unit};
use crate::verdict::{Estimate, Quantity, Verdict};

/// A column of digits: head and width.
struct CompareColumn {
    head: &'static str,
    sort: SortBy,
    width: u16,
    cell: fn(&App, usize, &Judgement) -> String,
}

const VERDICT_WIDTH: u16 = 6;
/// Least and greatest number of characters of an option's name.
const NAME: [u16; 2] = [8, 24];
/// Least and greatest width of the gauge of risk.
const RISK: [u16; 2] = [6, 16];
/// Least and greatest width of a sparkline.
const SPARK: [u16; 2] = [7, 40];
/// Least and greatest width of a gauge of a limit.
const GAUGE: [u16; 2] = [7, 13];

const COLUMNS: &[CompareColumn] = &[
    CompareColumn { head: "of limit", sort: SortBy::Verdict, width: 8, cell: use_of_limit },
    CompareColumn { head: "fails, %", sort: SortBy::Risk, width: 15, cell: |_, _, judged| fails(judged) },
    CompareColumn { head: "samples", sort: SortBy::Risk, width: 7, cell: samples },
    CompareColumn {
        head: "plan H, m",
        sort: SortBy::Height,
        width: 10,
        cell: |app, option, _| value_or_difference(app, option, |checked| checked.height, Unit::Metre),
    },
    CompareColumn {
        head: "5 to 95 %",
        sort: SortBy::Height,
        width: 14,
        cell: |_, _, judged| band(judged, Quantity::Height, Unit::Metre),
    },
    CompareColumn {
        head: "plan F, kN",
        sort: SortBy::Force,
        width: 11,
        cell: |app, option, _| value_or_difference(app, option, |checked| checked.force, Unit::Kilonewton),
    },
    CompareColumn {
        head: "5 to 95 %",
        sort: SortBy::Force,
        width: 18,
        cell: |_, _, judged| band(judged, Quantity::Force, Unit::Kilonewton),
    },
    CompareColumn {
        head: "factor",
        sort: SortBy::Force,
        width: 6,
        cell: |_, _, judged| units::factor(judged.checked.safety_factor),
    },
    CompareColumn {
        head: "plan D, m",
        sort: SortBy::Drift,
        width: 9,
        cell: |app, option, _| value_or_difference(app, option, |checked| checked.drift, Unit::Metre),
    },
];

/// Bounds of the share of shots that fail.
fn fails(judged: &Judgement) -> String {
    judged.sampled.known().map_or_else(String::new, |sampled| units::probabilities(sampled.bounds.interval))
}

/// Number of samples; dots as long as more come.
fn samples(app: &App, option: usize, judged: &Judgement) -> String {
    let more = if app.options[option].is_sampling() { "…" } else { "" };
    match &judged.sampled {
        Evidence::NotAsked => String::new(),
        sampled => format!("{}{more}", sampled.known().map_or(0, |sampled| sampled.samples.len())),
    }
}

/// 5th and 95th percentile of a quantity.
fn band(judged: &Judgement, quantity: Quantity, unit: Unit) -> String {
    let band = judged.sampled.known().and_then(|sampled| sampled.band(quantity));
    band.map_or_else(String::new, |[low, _, high, _]| {
        format!("{} to {}", units::value(low, unit), units::value(high, unit))
    })
}

/// A quantity of the shot as planned, or its difference from the baseline.
fn value_or_difference(
    app: &App,
    option: usize,
    quantity: fn(&CheckedShot) -> Estimate,
    unit: Unit,
) -> String {
    let Some(mine) = app.judgement(option).map(|judged| quantity(&judged.checked)) else {
        return String::new();
    };
    match app.baseline() {
        Some((other, base)) if other != option => {
            let difference = mine.value - quantity(&base.checked).value;
            let sign = if difference >= 0.0 { "+" } else { "" };
            format!("{sign}{}", units::value(difference, unit))
        }
        _ => units::value_by_error(mine.value, mine.error, unit),
    }
}

/// How much of its limit all but the accepted share of the samples use at most, of the quantity that uses most: `F 105 %`. The shot
/// as planned counts where it uses more. Empty as long as there are few samples: the shot as planned alone would flatter the
/// option.
fn use_of_limit(app: &App, _: usize, judged: &Judgement) -> String {
    let limits = &app.case.limits;
    let share = |(letter, quantity)| {
        let value = judged.sampled.known()?.value_at_risk(quantity)?;
        let as_planned = judged.checked.share_of_limit(quantity, limits)?;
        Some((letter, as_planned.max(value / limits.get(quantity)?)))
    };
    let shares = ['H', 'F', 'D'].into_iter().zip(Quantity::ALL).filter_map(share);
    let worst = shares.max_by(|a, b| a.1.total_cmp(&b.1));
    worst.map_or_else(String::new, |(letter, share)| format!("{letter} {}", units::percent(share, 0)))
}

/// Widths of the graphics of a row: name, gauge of risk, sparkline and gauge of a limit.
#[derive(Clone, Copy)]
struct Graphics {
    name: u16,
    risk: u16,
    spark: u16,
    gauge: u16,
}

impl Graphics {
    /// The graphics and columns of digits for a table of this width. Graphics stand at every width; digits take what is left of
    /// them, and what then is left goes to the sparklines.
    fn for_width(width: u16, longest_name: u16) -> (Self, Vec<&'static CompareColumn>) {
        let [least_name, most_name] = NAME;
        let mut graphics = Self { name: least_name, risk: RISK[0], spark: SPARK[0], gauge: GAUGE[0] };
        let mut room = width.saturating_sub(graphics.width());
        let mut grow = |size: &mut u16, most: u16, times: u16| {
            let more = (room / times).min(most.saturating_sub(*size));
            *size += more;
            room -= times * more;
        };
        grow(&mut graphics.name, (longest_name + 1).clamp(least_name, most_name), 1);
        grow(&mut graphics.gauge, GAUGE[1], 2);
        grow(&mut graphics.risk, RISK[1], 1);
        let fits = |column: &&CompareColumn| {
            let fits = room > column.width;
            room -= if fits { column.width + 1 } else { 0 };
            fits
        };
        let columns = COLUMNS.iter().filter(fits).collect();
        graphics.spark += (room / 2).min(SPARK[1] - SPARK[0]);
        (graphics, columns)
    }

    /// Width of all of them and of the verdict, with a space between two.
    fn width(&self) -> u16 {
        self.name + VERDICT_WIDTH + self.risk + 2 * (self.spark + self.gauge) + 6
    }
}

/// Draws the table.
pub fn draw(app: &App, frame: &mut Frame, area: Rect, areas: &mut Areas) {
    let longest = app.case.plan.delays.iter().map(|delay| delay.name.chars().count()).max().unwrap_or(0);
    let (graphics, columns) = Graphics::for_width(area.width, longest as u16);
    let Graphics { name, risk, spark, gauge } = graphics;
    let mut heads = vec![("option", SortBy::Name, name), ("", SortBy::Verdict, VERDICT_WIDTH)];
    let wide = |wide: &'static str, short: &'static str, width: u16| {
        if usize::from(width) >= wide.len() { wide } else { short }
    };
    heads.extend([
        (wide("fails .01-100%", "fails", risk), SortBy::Risk, risk),
        (wide("height in time", "height", spark), SortBy::Height, spark),
        (wide("of its limit", "limit", gauge), SortBy::Height, gauge),
        (wide("force in time", "force", spark), SortBy::Force, spark),
        (wide("of its limit", "limit", gauge), SortBy::Force, gauge),
    ]);
    heads.extend(columns.iter().map(|column| (column.head, column.sort, column.width)));
    let first_digits = heads.len() - columns.len();
    let listed = app.listed();
    let rows = listed.iter().map(|&option| row(app, option, &columns, graphics));
    let widths = heads.iter().map(|head| Constraint::Length(head.2));
    // Several columns may sort by the same quantity: the first has the mark.
    let marked = heads.iter().position(|head| head.1 == app.listing.sort);
    let mark = if app.listing.reversed { "▼" } else { "▲" };
    let cells = heads.iter().enumerate().map(|(n, head)| {
        let line = Line::from(format!("{}{}", head.0, if marked == Some(n) { mark } else { "" }));
        if n >= first_digits { line.right_aligned() } else { line }
    });
    let table = Table::new(rows, widths).header(Cells::new(cells).style(app.theme.muted()));
    let selected = listed.iter().position(|&option| option == app.selected);
    let mut state = TableState::new().with_selected(selected);
    frame.render_stateful_widget(table, area, &mut state);
    let mut x = area.x;
    for (_, sort, width) in heads {
        areas.push((Rect { x, width, height: 1, ..area }, ClickTarget::Sort(sort)));
        x += width + 1;
    }
    let shown = listed.iter().skip(state.offset()).take(usize::from(area.height.saturating_sub(1)));
    for (y, &option) in (area.y + 1..).zip(shown) {
        areas.push((Rect { y, height: 1, ..area }, ClickTarget::Option(option)));
    }
    if listed.is_empty() && area.height > 1 {
        let none = format!("no option has '{}' in its name or verdict; Esc shows all", app.listing.filter);
        frame.render_widget(Line::styled(none, app.theme.muted()), Rect { y: area.y + 1, height: 1, ..area });
    }
}

fn row<'r>(app: &'r App, option: usize, columns: &[&CompareColumn], graphics: Graphics) -> Cells<'r> {
    let style = if option == app.selected { app.theme.selected() } else { app.theme.base() };
    let mark = if app.listing.baseline == Some(option) { "=" } else { "" };
    let label = format!("{mark}{}", app.case.plan.delays[option].name);
    let name = usize::from(graphics.name);
    let mut cells = vec![Line::styled(format!("{:1$}", cut(&label, name), name), style)];
    match &app.options[option] {
        OptionState::Judged { judgement, .. } => {
            cells.push(verdict(app, judgement.verdict()));
            cells.extend(graphics_of(app, judgement, graphics));
            let cell =
                |column: &&CompareColumn| Line::from((column.cell)(app, option, judgement)).right_aligned();
            cells.extend(columns.iter().map(cell));
        }
        OptionState::Failed(failed) => {
            cells.push(verdict(app, Verdict::Undecided));
            cells.push(Line::from(no_result::message(failed)));
        }
        OptionState::Waiting => cells.push(Line::styled("waits", app.theme.muted())),
        OptionState::Running { runs, done } => {
            cells.push(Line::styled(format!("{:>3.0} %", done * 100.0), app.theme.muted()));
            cells.push(Line::styled(bar(*done, 15), app.theme.muted()));
            cells.push(Line::styled(format!("run {}", runs + 1), app.theme.muted()));
        }
    }
    Cells::new(cells)
}

/// The gauge of risk, and for height and force the planned shot over time and the use of its limit.
fn graphics_of(app: &App, judged: &Judgement, graphics: Graphics) -> Vec<Line<'static>> {
    let (theme, limits) = (app.theme, &app.case.limits);
    let sampled = judged.sampled.known();
    let bar = theme.verdict(sampled.map_or(Verdict::Undecided, |sampled| sampled.verdict()));
    let interval = sampled.map(|sampled| sampled.bounds.interval);
    let mut cells =
        vec![gauges::risk(interval, limits.accepted_risk, graphics.risk.into(), [bar, theme.muted()])];
    let history = &judged.checked.history;
    for (quantity, series, limit) in
        [(Quantity::Height, &history.height, limits.height), (Quantity::Force, &history.force, limits.force)]
    {
        let worst = sampled.and_then(|sampled| sampled.value_at_risk(quantity)).map(|value| value / limit);
        let planned = judged.checked.get(quantity).value / limit;
        let [curve, fail] = [theme.curve(), theme.limit()];
        cells.push(gauges::over_time(series, limit, graphics.spark.into(), [curve, fail]));
        cells.push(gauges::use_of_limit(planned, worst, graphics.gauge.into(), [curve, fail, theme.muted()]));
    }
    cells
}

/// A name in so many columns: where letters are left out, its end stays, because names differ there.
pub(super) fn cut(name: &str, width: usize) -> String {
    let letters: Vec<char> = name.chars().collect();
    if letters.len() <= width {
        return name.to_owned();
    }
    let end = (width / 3).min(4);
    let start = width.saturating_sub(end + 1);
    letters[..start].iter().chain(&['…']).chain(&letters[letters.len() - end..]).collect()
}

fn verdict(app: &App, verdict: Verdict) -> Line<'static> {
    let (words, style) = verdict_words(app, verdict);
    Line::styled(words, style)
}

/// A verdict with its sign; a pass that was seen otherwise has the sign of a warning.
pub(super) fn verdict_words(app: &App, verdict: Verdict) -> (String, Style) {
    match verdict == Verdict::Pass && !app.contradiction().is_empty() {
        true => (format!("! {}", verdict.for_people()), app.theme.limit()),
        false => (theme::label(verdict).to_owned(), app.theme.verdict(verdict)),
    }
}

fn bar(done: f64, width: usize) -> String {
    let full = (done * width as f64) as usize;
    "█".repeat(full) + &"▁".repeat(width - full.min(width))
}
