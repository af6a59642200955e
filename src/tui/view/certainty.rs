//! The bounds of the risk of an option after each sampled shot. The band becomes narrower with every shot until it lies on one side of the
//! accepted risk.
//!
//! ```text
//!  risk as shots came, surely in █ ┄ accepted ─
//! 100% ▆▅▃▂▁
//!      █████▇▆▅▄▃▃▂▁
//!   1% █████████████▇▆▄▃▂▁┄┄┄┄┄┄┄┄   as long as the risk is open it covers the line
//! none ███████████████████████████
//!      0───────────250─────── 500 shots
//! ```

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::style::Style;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Borders};
use unicode_width::UnicodeWidthStr;

use super::compare::{curve, verdict_words};
use super::gauges::{EIGHTHS, LEAST_RISK, REVIEWED};
use super::histogram::LEAST_SIZE;
use crate::tui::app::App;
use crate::units;

/// Sign of the band. `LINE`: sign of the accepted risk.
const BAND: &str = EIGHTHS[8];
const LINE: &str = "┄";
/// Label at the top of the axis.
const ALL: &str = "100%";
/// Least length of the axis [shots]. The length doubles whenever the shots exceed it.
const LEAST_SHOTS: usize = 500;

/// Draws the bounds of an option. Draws nothing if the area is too small or no shot is sampled.
pub fn draw(app: &App, option: usize, frame: &mut Frame, area: Rect) {
    let sampled = app.judgement(option).and_then(|judged| judged.sampled.known());
    let Some(sampled) = sampled.filter(|_| area.width >= LEAST_SIZE.0 && area.height >= LEAST_SIZE.1) else {
        return;
    };
    let (theme, accepted) = (app.theme, app.case.limits.accepted_risk);
    let [title, body, axis] =
        Layout::vertical([Constraint::Length(1), Constraint::Min(0), Constraint::Length(1)]).areas(area);
    let label = format!("{}%", units::short(1e2 * accepted));
    let label = format!("{label:>0$}", ALL.len());
    let beside = Constraint::Length(label.len() as u16 + 1);
    let [labels, band] = Layout::horizontal([beside, Constraint::Min(0)]).areas(body);
    let rule = Block::new().borders(Borders::TOP).border_style(theme.muted());
    let of_band =
        if app.options[option].is_sampling() { curve(app, option) } else { verdict_words(app, option).1 };
    frame.render_widget(rule.title(titled(app, of_band, title.width.into())), title);
    let tried = sampled.samples.len();
    let mut end = LEAST_SHOTS;
    while end < tried {
        end *= 2;
    }
    let width = usize::from(band.width);
    // Number of shots at the right edge of each column that has shots. A column stands for several shots.
    let begun = (tried * width).div_ceil(end);
    let counts: Vec<usize> = (1..=begun).map(|n| (n * end).div_ceil(width).min(tried)).collect();
    let bounds = sampled.bounds_after(&counts);
    for n in 0..width {
        let bounds = bounds.get(n).copied();
        // While the risk was open, the band had no verdict color.
        let was_open = bounds.is_some_and(|[low, high]| low <= accepted && accepted <= high);
        let of_column = if was_open { curve(app, option) } else { of_band };
        for (y, sign) in (body.y..).zip(column(bounds, accepted, body.height.into())) {
            let style = if sign == LINE { theme.limit_line() } else { of_column };
            frame.buffer_mut().set_string(band.x + n as u16, y, sign, style);
        }
    }
    let row_of_accepted = body.height - 1 - row_of(accepted, body.height.into()) as u16;
    let marks = [(0, ALL, theme.muted()), (body.height - 1, "none", theme.muted())];
    for (row, text, style) in marks.into_iter().chain([(row_of_accepted, label.as_str(), theme.limit_line())])
    {
        let place = Rect { y: body.y + row, height: 1, ..labels };
        frame.render_widget(Line::styled(format!("{text:<0$}", label.len()), style), place);
    }
    let reviewed = app.shot_in_review(option).map(|(number, _)| number);
    draw_axis(app, [tried, end], reviewed, frame, Rect { x: band.x, width: band.width, ..axis });
}

/// Height of a risk in a chart with `rows` rows [rows].
fn height(risk: f64, rows: usize) -> f64 {
    rows as f64 * (1.0 - risk.max(LEAST_RISK).log10() / LEAST_RISK.log10())
}

/// Row of a risk, counted from the lowest row.
fn row_of(risk: f64, rows: usize) -> usize {
    (height(risk, rows) as usize).min(rows.saturating_sub(1))
}

/// The signs of a column from top to bottom: the band between two bounds, and the line of the accepted risk.
///
/// A band that is surely on one side of the accepted risk leaves the row of the line free, however near it is. An open band covers the
/// line.
fn column(bounds: Option<[f64; 2]>, accepted: f64, rows: usize) -> Vec<&'static str> {
    let full = EIGHTHS.len() - 1;
    let eighths = |risk: f64| (height(risk, rows) * full as f64).round() as usize;
    let line = row_of(accepted, rows);
    let [below, above] = [line, line + 1].map(|row| row * full);
    let [from, to] = match bounds {
        None => [0, 0],
        Some([low, high]) => {
            let [from, to] = [eighths(low), eighths(high).max(1)];
            match () {
                () if high < accepted => [from, to].map(|end| end.min(below)),
                () if low > accepted && line + 1 < rows => [from.max(above), to.max(above + 1)],
                () => [from.min(below), to.max(below + 1)],
            }
        }
    };
    let sign = |row: usize| {
        let [low, high] = [from, to].map(|end| end.saturating_sub(row * full).min(full));
        // A cell is filled from its lower edge. If the band begins in its upper half and continues above, the cell stays empty.
        let is_empty = high == 0 || 2 * low > full && to > (row + 1) * full;
        match () {
            () if is_empty && row == line => LINE,
            () if is_empty => EIGHTHS[0],
            () => EIGHTHS[high],
        }
    };
    (0..rows).rev().map(sign).collect()
}

/// The longest title that fits.
fn titled<'l>(app: &App, band: Style, width: usize) -> Line<'l> {
    let texts = [
        ("risk as shots came, surely in ", " ┄ accepted "),
        ("risk, surely in ", " ┄ accepted "),
        ("risk, surely in ", " "),
    ];
    let fits = |(before, after): &(&str, &str)| 2 + before.width() + after.width() <= width;
    let (before, after) = texts.into_iter().find(fits).unwrap_or_default();
    Line::from(vec![
        Span::styled(format!(" {before}"), app.theme.muted()),
        Span::styled(BAND, band),
        Span::styled(after, app.theme.muted()),
    ])
}

/// Draws the axis of shots: the number sampled, the shot in review, the end.
fn draw_axis(app: &App, [tried, end]: [usize; 2], reviewed: Option<usize>, frame: &mut Frame, area: Rect) {
    let width = usize::from(area.width);
    let mut cells = vec![Span::styled("─", app.theme.muted()); width];
    let mut put = |at: usize, text: &str, style: Style| {
        let start =
            (at * width / end).saturating_sub(text.width() / 2).min(width.saturating_sub(text.width()));
        for (cell, letter) in cells.iter_mut().skip(start).zip(text.chars()) {
            *cell = Span::styled(letter.to_string(), style);
        }
    };
    put(0, "0", app.theme.muted());
    let last = format!(" {end} shots");
    put(end, &last, app.theme.muted());
    let count = tried.to_string();
    // Two numbers that touch would read as another number.
    if tried * width / end + count.len() + last.len() < width {
        put(tried, &count, app.theme.title());
    }
    // The sign must not cover a digit.
    if let Some(number) = reviewed.filter(|number| number * width / end + 1 + last.len() < width) {
        put(number, REVIEWED, app.theme.title());
    }
    frame.render_widget(Line::from(cells), area);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A band below the line is a PASS, a band above it a FAIL, a band across it OPEN. This holds at every chart height, however near the
    /// bounds are to the accepted risk of 1 %.
    #[test]
    fn the_band_lies_on_its_side_of_the_accepted_risk() {
        for rows in 2..=20 {
            let sides = |bounds: [f64; 2]| {
                let signs = column(Some(bounds), 0.01, rows);
                let line = rows - 1 - row_of(0.01, rows);
                let has_band = |part: &[&str]| part.iter().any(|sign| ![EIGHTHS[0], LINE].contains(sign));
                [&signs[..line], &signs[line..=line], &signs[line + 1..]].map(has_band)
            };
            for pass in [[0.0, 0.0094], [0.0, 0.00999], [0.0008, 0.004]] {
                assert_eq!(sides(pass), [false, false, true], "{rows} {pass:?}");
            }
            for fail in [[0.0109, 0.0391], [0.0101, 0.012], [0.3, 0.36], [0.9, 1.0]] {
                // The lowest chart has no row above the line.
                assert_eq!(sides(fail), [rows > 2, rows == 2, false], "{rows} {fail:?}");
            }
            for open in [[0.0022, 0.0146], [0.0, 0.0101], [0.0099, 0.02]] {
                assert!(sides(open)[1], "{rows} {open:?}");
            }
        }
    }

    #[test]
    fn a_column_is_as_high_as_its_bounds() {
        let of = |bounds| column(bounds, 0.01, 4).concat();
        assert_eq!(of(None), " ┄  ");
        assert_eq!(of(Some([0.0, 1.0])), "████");
        assert_eq!(of(Some([0.0, 0.0316])), " ▄██");
        assert_eq!(of(Some([0.0022, 0.0146])), " ▁█ ");
        assert_eq!(of(Some([0.0109, 0.0391])), "▁┄  ");
        assert_eq!(of(Some([0.4, 0.5])), "▆┄  ", "a narrow band is seen");
    }
}
