//! The options of the plan under a question that is not answered yet. Each option has a bar: the share of its nearest limit that its shots
//! use, or the bounds of its risk.
//!
//! ```text
//!  share of the nearest limit █ 1 in 100 shots above • planned           100 %
//!  42 ms        △ THIN ▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆•▆▆▆▆▆▆▆▆▆▆▆▆      ┃          93 % height
//!  long period  ✗ FAIL ▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆▆┃▆▆▆▆▆▆▆  141 % force
//! ```

use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use unicode_width::UnicodeWidthStr;

use super::columns::name_of;
use super::compare::{TRYING, curve, turning, verdict_words};
use super::fitting::option_name;
use super::gauges::{self, DECIDING, PLANNED, REVIEWED};
use super::widgets::highlight;
use crate::report::words::drawn_shot::one_in_above;
use crate::study::judge::Judgement;
use crate::study::question::StudyKind;
use crate::tui::app::{App, Areas, ClickTarget};
use crate::tui::plan_side::PlanOption;
use crate::units;
use crate::verdict::Quantity;

/// Least and greatest width of a name. `VERDICT`: width of a verdict.
const NAME: [usize; 2] = [8, 24];
const VERDICT: usize = 7;
/// Width of the number behind a bar.
const NUMBER: usize = 14;
/// Least width of a bar beside other words. `MOST_BAR`: greatest width.
const LEAST_BAR: usize = 6;
const MOST_BAR: usize = 20;
/// Share of a limit at the end of a bar beside other words. An excess has a cell beyond the limit.
const END: f64 = 1.3;
/// Least and greatest share of a limit at the end of the bars.
const MOST: [f64; 2] = [1.15, 2.0];

/// Lines that all options need.
pub fn height(app: &App) -> u16 {
    app.options.len() as u16 + 1
}

/// Draws a line for each option that fits. The selected option is always visible.
pub fn draw(app: &App, frame: &mut Frame, area: Rect, areas: &mut Areas) {
    if area.height < 2 {
        return;
    }
    let room = usize::from(area.height - 1);
    let names = app.case.plan.delays.iter().map(|delay| delay.name.width());
    let name = names.max().unwrap_or(0).clamp(NAME[0], NAME[1].min(usize::from(area.width) / 4).max(NAME[0]));
    let width = usize::from(area.width).saturating_sub(name + VERDICT + NUMBER + 4);
    let is_risk = app.studies.shown == StudyKind::Risk;
    let used: Vec<Option<Used>> = (0..app.options.len()).map(|option| Used::of(app, option)).collect();
    let greatest = used.iter().flatten().map(|used| used.deciding).fold(0.0, f64::max);
    let most = greatest.clamp(MOST[0], MOST[1]);
    let first = (app.selected + 1).saturating_sub(room);
    let hidden = app.options.len().saturating_sub(room);
    let (scale, title) = match is_risk {
        true => {
            let scale = gauges::risk_scale(app.case.limits.accepted_risk, width);
            (scale, ["shots that fail", "shots fail", ""])
        }
        false => {
            let end = cell_of_limit(most, width) + "100 %".len() / 2 + 1;
            (format!("{:>end$}", "100 %"), ["share of nearest limit", "share of limit", "share"])
        }
    };
    let more = if hidden > 0 { format!("{hidden} more · ") } else { String::new() };
    let before = name + VERDICT + 3;
    let title = title.into_iter().map(|title| format!(" {more}{title}"));
    let title = title.into_iter().find(|title| title.width() < before).unwrap_or_default();
    frame.render_widget(Line::styled(format!("{title:before$}{scale}"), app.theme.muted()), area);
    // If no row is free below the bars, the head shows the key.
    let has_row = usize::from(area.height) > app.options.len() + 1;
    let room = if has_row { usize::from(area.width) } else { width.saturating_sub(scale.width() + 2) };
    let key = Line::styled(key(app, is_risk, room), app.theme.muted());
    let place = match has_row {
        true => Rect { x: area.x + before as u16, y: area.y + height(app), ..area },
        false => Rect { x: area.right().saturating_sub((NUMBER + key.width()) as u16), ..area },
    };
    frame.render_widget(key, Rect { height: 1, ..place }.intersection(area));
    for (y, option) in (area.y + 1..area.bottom()).zip(first..app.options.len()) {
        let mut line = named(app, option, name);
        match (is_risk, &used[option], app.judgement(option)) {
            (true, _, Some(judged)) => line.spans.extend(risk(app, option, judged, width)),
            (false, Some(used), _) => line.spans.extend(used.bar(app, option, most, width)),
            _ => {}
        }
        let row = Rect { y, height: 1, ..area };
        frame.render_widget(line, row);
        if option == app.selected {
            highlight(app, row, frame);
        }
        areas.push((row, ClickTarget::Option(PlanOption { side: app.side, option })));
    }
}

/// The utilization of an option's nearest limit, as a bar and a number in `cells` cells; empty if there are too few cells.
pub fn use_of_nearest_limit(app: &App, option: usize, cells: usize) -> Vec<Span<'static>> {
    let Some(bar) = cells.checked_sub(NUMBER).filter(|bar| *bar >= LEAST_BAR) else { return Vec::new() };
    let used = Used::of(app, option);
    used.map_or_else(Vec::new, |used| used.bar(app, option, END, bar.min(MOST_BAR)))
}

/// The meaning of the signs of a bar, if it fits.
fn key(app: &App, is_risk: bool, room: usize) -> String {
    if is_risk {
        return String::new();
    }
    let above = one_in_above(&app.case.limits);
    let review = app.shot_in_review(app.selected);
    let review = review.map(|(number, _)| format!(" {REVIEWED} shot {number}")).unwrap_or_default();
    let keys = [
        format!("{DECIDING} {above} {PLANNED} planned{review}"),
        format!("{DECIDING} {above} {PLANNED} planned"),
        format!("{DECIDING} {} {PLANNED} plan", above.trim_end_matches(" shots above")),
    ];
    keys.into_iter().find(|key| key.width() <= room).unwrap_or_default()
}

/// Name and verdict of an option.
fn named<'l>(app: &App, option: usize, width: usize) -> Line<'l> {
    let name = option_name(app, option, width);
    let style = if option == app.selected { app.theme.title() } else { app.theme.base() };
    let (words, of_words) = verdict_words(app, option);
    let words = match words {
        TRYING => format!("{} …", turning(app.beat + option)),
        words => words.to_owned(),
    };
    let name = Span::styled(format!(" {name:width$} "), style);
    Line::from(vec![name, Span::styled(format!("{words:VERDICT$} "), of_words)])
}

/// The bounds of the risk of an option, and the number of its failed shots.
fn risk(app: &App, option: usize, judged: &Judgement, width: usize) -> Vec<Span<'static>> {
    let Some(sampled) = judged.sampled.known() else { return Vec::new() };
    let bar = if app.is_held() { app.theme.faint() } else { verdict_words(app, option).1 };
    let bounds = Some(sampled.bounds.interval);
    let gauge = gauges::risk(bounds, app.case.limits.accepted_risk, width, [bar, app.theme.muted()])
        .spans
        .into_iter();
    let count = format!("  {} of {}", sampled.bounds.failures, sampled.bounds.samples);
    gauge.chain([Span::styled(count, app.theme.base())]).collect()
}

/// Utilization of the nearest limit of an option.
struct Used {
    quantity: Quantity,
    planned: f64,
    /// Utilization that only the accepted share of the sampled shots exceeds.
    deciding: f64,
}

impl Used {
    /// `None` until enough shots of the option are sampled.
    fn of(app: &App, option: usize) -> Option<Self> {
        let judged = app.judgement(option)?;
        let (quantity, deciding) = judged.nearest_limit(&app.case.limits)?;
        let planned = judged.checked.share_of_limit(quantity, &app.case.limits)?;
        Some(Self { quantity, planned, deciding })
    }

    /// The bar with its number. The shot in review has a mark in it.
    fn bar(&self, app: &App, option: usize, most: f64, width: usize) -> Vec<Span<'static>> {
        let (theme, limit) = (app.theme, cell_of_limit(most, width));
        let calm = if app.is_held() { theme.faint() } else { curve(app, option) };
        // A share within the limit ends before its mark, and a share over the limit crosses it, however near it is.
        let cells = |share: f64| {
            let cells = (share * limit as f64).round() as usize;
            if share > 1.0 { cells.max(limit + 2) } else { cells.min(limit.saturating_sub(1)) }
        };
        let [planned, deciding] = [self.planned, self.deciding].map(cells);
        let limit_of_nearest = app.case.limits.get(self.quantity);
        let reviewed = app.shot_in_review(option).zip(limit_of_nearest);
        let reviewed = reviewed.map(|((_, shot), limit)| shot.finest().get(self.quantity) / limit);
        let review = reviewed.filter(|share| share.is_finite()).map(|share| cells(share).min(width));
        let of_review = if reviewed.is_some_and(|share| share > 1.0) { theme.limit() } else { theme.title() };
        let span = |n: usize| match () {
            () if n == limit => Span::styled("┃", theme.limit_line()),
            () if Some(n + 1) == review => Span::styled(REVIEWED, of_review),
            () if n + 1 == width && deciding > width => Span::styled("▶", theme.limit()),
            () if n + 1 == planned => Span::styled(PLANNED, theme.title()),
            () if n < deciding => {
                Span::styled(DECIDING, theme.heat(calm, (n + 1) as f64 / limit.max(1) as f64))
            }
            () => Span::raw(" "),
        };
        let number = format!(" {:>4.0} % {}", units::whole_percent(self.deciding), name_of(self.quantity));
        let style = if self.deciding > 1.0 { theme.limit() } else { theme.base() };
        (0..width).map(span).chain([Span::styled(number, style)]).collect()
    }
}

/// The cell of the limit on a scale that ends at `most` times the limit.
fn cell_of_limit(most: f64, width: usize) -> usize {
    (width as f64 / most) as usize
}
