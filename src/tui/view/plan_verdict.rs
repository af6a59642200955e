//! The verdict on the selected option beside its map, and how much of both limits its shots use.
//!
//! ```text
//! ✓ PASS · 0 of 500 shots fail · height: 79 % of its limit
//! height ▄▆▇▇▇▆▄ ▆▆▆▆▆•▆▆ ┃
//! force  ▆▃▂▃▂▃▂ ▆▆•▆▆    ┃
//! ```

use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use unicode_width::UnicodeWidthStr;

use super::compare::{TRYING, curve, turning, verdict_words};
use super::gauges;
use crate::tui::app::App;
use crate::units;
use crate::verdict::Quantity;

/// Lines of both limits.
pub const LIMITS: u16 = 2;
/// Width of the name of a quantity, and greatest width of its gauge.
const NAME: usize = 7;
const GAUGE: usize = 13;

const QUANTITIES: [(Quantity, &str); 2] = [(Quantity::Height, "height"), (Quantity::Force, "force")];

/// The verdict in one line, in as many words as have room.
pub fn line<'l>(app: &App, width: u16) -> Line<'l> {
    let Some(judged) = app.judgement(app.selected) else {
        let words = if app.busy() { format!(" {} computing", turning(app.beat)) } else { String::new() };
        return Line::styled(words, app.theme.muted());
    };
    let (words, style) = verdict_words(app, app.selected);
    let words = match words {
        TRYING => format!("{} {words}", turning(app.beat + app.selected)),
        _ => words.to_owned(),
    };
    let bounds = judged.sampled.known().map(|sampled| &sampled.bounds);
    let [fails, few] = ["shots fail", "fail"]
        .map(|fail| bounds.map(|bounds| format!("{} of {} {fail}", bounds.failures, bounds.samples)));
    let shares = QUANTITIES
        .iter()
        .filter_map(|&(quantity, name)| Some((name, judged.used_of_limit(quantity, &app.case.limits)?)));
    let nearest = shares.max_by(|a, b| a.1.total_cmp(&b.1));
    let nearest =
        nearest.map(|(name, share)| format!("{name}: {:.0} % of its limit", units::whole_percent(share)));
    let words = Some(words);
    let parts =
        [[&words, &fails, &nearest], [&words, &fails, &None], [&words, &few, &None], [&words, &None, &None]];
    let joined = |parts: [&Option<String>; 3]| {
        let parts: Vec<&str> = parts.into_iter().flatten().map(String::as_str).collect();
        format!(" {} ", parts.join(" · "))
    };
    let texts = parts.map(joined);
    let fits = |text: &String| text.width() <= usize::from(width);
    Line::styled(texts.into_iter().find(fits).unwrap_or_default(), style)
}

/// Draws both limits: the shot in time, and how much of its limit it uses.
pub fn draw_limits(app: &App, frame: &mut Frame, area: Rect) {
    let Some(judged) = app.judgement(app.selected) else { return };
    let (theme, is_deciding) = (app.theme, app.rows_are_deciding());
    let histories = match is_deciding {
        true => app.deciding(app.selected).map(|shots| [&shots.height.history, &shots.force.history]),
        false => Some([&judged.checked.history; 2]),
    };
    let series = histories.map(|[height, force]| [&height.height, &force.force]);
    let room = usize::from(area.width).saturating_sub(1 + NAME + 1);
    let gauge = (room / 2).min(GAUGE);
    let curve = curve(app, app.selected);
    for (n, (quantity, name)) in QUANTITIES.into_iter().enumerate() {
        let Some(limit) = app.case.limits.get(quantity) else { continue };
        let mut line = Line::from(Span::styled(format!(" {name:NAME$}"), theme.muted()));
        match series {
            Some(series) => {
                let spark = room - gauge;
                line.extend(gauges::over_time(theme, series[n], limit, spark, curve, !is_deciding));
            }
            // A milder shot among those that decide would flatter its option.
            None => line.push_span(format!("{:1$}", "…", room - gauge)),
        }
        let planned = Some(judged.checked.get(quantity).value / limit);
        let deciding = judged.used_of_limit(quantity, &app.case.limits);
        line.push_span(" ");
        line.extend(gauges::use_of_limit(theme, planned, deciding, gauge, curve));
        let row = Rect { y: area.y + n as u16, height: 1, ..area }.intersection(area);
        frame.render_widget(line, row);
    }
}
