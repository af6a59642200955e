//! Histogram of the sampled shots over the share of a limit that they use.
//!
//! ```text
//!  42 ms: height of 500 shots ▲ planned ┃ limit ─
//!               ▂▅█▆▃                    ┃
//!             ▁▆██████▅▂▁                ┃   what stands behind it fails
//! 0 ───────────────▲───────────────2.35 m┃──   ◆ is the last one, while more come
//! ```

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::style::Style;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Borders};
use unicode_width::UnicodeWidthStr;

use super::compare::cut;
use super::gauges::{EIGHTHS, REVIEWED};
use crate::tui::app::App;

/// Least width and height of a histogram that can be read.
pub const LEAST_SIZE: (u16, u16) = (24, 4);
/// Label at the beginning of the axis.
const ZERO: &str = "0 ";
/// A share of 1 / `BEHIND` of the cells lies beyond the limit.
const BEHIND: usize = 6;

/// Shots to draw, each as the share of a limit that it uses.
pub struct Shots {
    /// Name of the option; empty if it stands above already.
    pub option: String,
    /// Two titles: without and with the name of the marked shot.
    pub titles: [String; 2],
    /// Share of the limit of each shot.
    pub shares: Vec<f64>,
    /// Share of the limit of the planned shot.
    pub planned: Option<f64>,
    /// Share of the marked shot: the latest while samples come, or the shot in review.
    pub last: Option<f64>,
    /// The limit with its unit, as text.
    pub limit: String,
    /// Color of the bars.
    pub bars: Style,
}

/// Draws the histogram. Draws nothing if the area is too small.
pub fn draw(app: &App, shots: &Shots, frame: &mut Frame, area: Rect) {
    if area.width < LEAST_SIZE.0 || area.height < LEAST_SIZE.1 {
        return;
    }
    let theme = app.theme;
    let [title, body, axis] =
        Layout::vertical([Constraint::Length(1), Constraint::Min(0), Constraint::Length(1)]).areas(area);
    let rule = Block::new().borders(Borders::TOP).border_style(theme.muted());
    frame.render_widget(rule.title(titled(app, shots, title.width.into())), title);
    let width = usize::from(area.width);
    let limit = width - width / BEHIND - 1;
    let counts = counts(&shots.shares, width, limit);
    let most = counts.iter().copied().max().unwrap_or(0).max(1) as f64;
    let last = shots.last.map(|share| column_of(share, width, limit));
    for row in 0..body.height {
        let from = f64::from(body.height - 1 - row);
        let cell = |column: usize| {
            let style = if column > limit { theme.limit() } else { shots.bars };
            let share = (column + 1) as f64 / limit as f64;
            let style = if column < limit { theme.heat(style, share) } else { style };
            let full = (EIGHTHS.len() - 1) as f64;
            let eighths = (counts[column] as f64 / most * f64::from(body.height) - from) * full;
            // Even a single shot is visible.
            let least = if from == 0.0 && counts[column] > 0 { 1.0 } else { 0.0 };
            match eighths.clamp(least, full) as usize {
                // The column of the marked shot is visible above the bars, too.
                0 if last == Some(column) => Span::styled("┆", style),
                eighths => Span::styled(EIGHTHS[eighths], style),
            }
        };
        let mut line: Vec<Span<'_>> = (0..width).map(cell).collect();
        line[limit] = Span::styled("┃", theme.limit_line());
        frame.render_widget(Line::from(line), Rect { y: body.y + row, height: 1, ..body });
    }
    draw_axis(app, shots, limit, frame, axis);
}

/// The title with the meaning of the signs, as far as they fit.
fn titled<'l>(app: &App, shots: &Shots, width: usize) -> Line<'l> {
    let planned = if shots.planned.is_some() { "▲ planned " } else { "" };
    let [counted, marked] = shots.titles.each_ref().map(|title| format!(" {title} "));
    let of_option = |title: &str| match shots.option.as_str() {
        "" => title.to_owned(),
        option => format!(" {}:{title}", cut(option, width.saturating_sub(title.width() + 2))),
    };
    let titles = [
        format!("{}{planned}┃ limit ", of_option(&marked)),
        format!("{marked}{planned}┃ limit "),
        format!("{marked}{planned}"),
        of_option(&marked),
        marked,
        counted,
    ];
    let title = titles.into_iter().find(|title| title.width() <= width).unwrap_or_default();
    Line::styled(title, app.theme.muted())
}

/// Number of shots in each of `width` columns. `limit` is the column of the limit. A shot within the limit counts before this column, a
/// shot over the limit behind it, however near it is.
fn counts(shares: &[f64], width: usize, limit: usize) -> Vec<usize> {
    let mut counts = vec![0; width];
    for share in shares.iter().filter(|share| share.is_finite()) {
        counts[column_of(*share, width, limit)] += 1;
    }
    counts
}

/// Column of a share of the limit.
fn column_of(share: f64, width: usize, limit: usize) -> usize {
    let column = (share * limit as f64) as usize;
    let column = if share > 1.0 { column.max(limit + 1) } else { column.min(limit - 1) };
    column.min(width - 1)
}

/// Draws the axis from 0 to the limit and beyond, with the planned and the marked shot.
fn draw_axis(app: &App, shots: &Shots, limit: usize, frame: &mut Frame, area: Rect) {
    let theme = app.theme;
    let mut cells = vec![Span::styled("─", theme.muted()); area.width.into()];
    cells[limit] = Span::styled("┃", theme.limit_line());
    let put = |cells: &mut Vec<Span<'_>>, start: usize, text: &str, style: Style| {
        for (cell, letter) in cells[start..].iter_mut().zip(text.chars()) {
            *cell = Span::styled(letter.to_string(), style);
        }
    };
    put(&mut cells, 0, ZERO, theme.muted());
    let column = |share: f64| column_of(share, area.width.into(), limit);
    let signs = [(shots.last, REVIEWED), (shots.planned, "▲")];
    let signs = signs.into_iter().filter_map(|(share, sign)| Some((column(share?), sign)));
    let signs: Vec<(usize, &str)> = signs.collect();
    // The last column also counts all shots beyond it.
    let last = usize::from(area.width).saturating_sub(1);
    let has_beyond = shots.shares.iter().any(|share| (share * limit as f64) as usize > last);
    let beyond = has_beyond.then_some((last, "▶"));
    let taken: Vec<usize> = signs.iter().chain(&beyond).map(|(at, _)| *at).collect();
    let start = label_start(limit, shots.limit.width(), area.width.into(), &taken);
    start.into_iter().for_each(|start| put(&mut cells, start, &shots.limit, theme.limit_line()));
    for (at, sign) in beyond.into_iter().chain(signs) {
        put(&mut cells, at, sign, theme.title());
    }
    frame.render_widget(Line::from(cells), area);
}

/// Start of a label of `label` cells beside the `limit`: before it, else behind it. Elsewhere it would label another share. `None` if it
/// does not fit or would collide with a sign: a covered digit would leave another number.
fn label_start(limit: usize, label: usize, width: usize, signs: &[usize]) -> Option<usize> {
    let before = limit.checked_sub(label).filter(|start| *start >= ZERO.len());
    let behind = Some(limit + 1).filter(|start| start + label <= width);
    let is_free = |start: &usize| signs.iter().all(|at| !(*start..start + label).contains(at));
    before.into_iter().chain(behind).find(is_free)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The label stands beside the limit or nowhere.
    #[test]
    fn the_limit_has_its_number_beside_its_mark_or_none() {
        assert_eq!(label_start(19, 6, 23, &[3]), Some(13));
        assert_eq!(label_start(19, 6, 23, &[13]), None, "no digit is covered");
        assert_eq!(label_start(40, 6, 48, &[36, 12]), Some(41), "behind it");
        assert_eq!(label_start(40, 6, 48, &[36, 46]), None);
        assert_eq!(label_start(7, 6, 9, &[]), None, "a nought and a number would be another number");
    }

    #[test]
    fn a_shot_stands_on_its_side_of_the_limit() {
        let counts = counts(&[0.0, 0.5, 1.0, 1.001, 9.0, f64::NAN], 12, 9);
        assert_eq!(counts, [1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1]);
    }
}
