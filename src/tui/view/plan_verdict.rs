//! The verdict on the selected option beside its map, and the use of both limits.
//!
//! ```text
//! ✓ PASS · 0 of 500 shots fail · height: 79 % of its limit
//!        ▆ 1 in 100 above • plan ┃ limit
//! height ▄▆▇▇▇▆▄ ▆▆▆▆▆•▆▆ ┃
//! force  ▆▃▂▃▂▃▂ ▆▆•▆▆    ┃
//! ```

use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use unicode_width::UnicodeWidthStr;

use super::columns::name_of;
use super::compare::{TRYING, turning, use_of_limits, verdict_words};
use super::signs;
use crate::tui::app::App;
use crate::units;
use crate::verdict::Quantity;

/// Lines of both limits and of the meaning of the signs.
pub const LIMITS: u16 = 3;
/// Width of the name of a quantity. `GAUGE`: greatest width of its gauge.
const NAME: usize = 7;
const GAUGE: usize = 13;

const QUANTITIES: [Quantity; 2] = [Quantity::Height, Quantity::Force];

/// The verdict in one line. The longest wording that fits.
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
    let nearest = judged.nearest_limit(&app.case.limits).map(|(quantity, share)| {
        format!("{}: {:.0} % of its limit", name_of(quantity), units::whole_percent(share))
    });
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

/// Draws the meaning of the signs, and for both limits the shot over time and the use of the limit.
pub fn draw_limits(app: &App, frame: &mut Frame, area: Rect) {
    let Some(judged) = app.judgement(app.selected) else { return };
    let room = usize::from(area.width).saturating_sub(1 + NAME + 1);
    let gauge = (room / 2).min(GAUGE);
    let limits = use_of_limits(app, app.selected, judged, [room - gauge, gauge], true);
    let mut signs = signs::line(app, usize::from(area.width).saturating_sub(1));
    signs.spans.insert(0, " ".into());
    frame.render_widget(signs, area);
    for (y, (quantity, [in_time, used])) in
        (area.y + 1..area.bottom()).zip(QUANTITIES.into_iter().zip(limits))
    {
        let name = Span::styled(format!(" {:NAME$}", name_of(quantity)), app.theme.muted());
        let spans = [name].into_iter().chain(in_time.spans).chain([Span::raw(" ")]).chain(used.spans);
        frame.render_widget(Line::from_iter(spans), Rect { y, height: 1, ..area });
    }
}
