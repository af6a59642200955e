//! The meaning of the signs and colors in a row of the table, stated once above all rows.
//!
//! ```text
//! ▆ 1 in 100 shots above • planned ┃ limit ▆▆▆ 50 to 100 %
//! ```

use ratatui::style::Style;
use ratatui::text::{Line, Span};

use super::gauges::{DECIDING, LINE, PLANNED};
use crate::report::words::drawn_shot::one_in_above;
use crate::tui::app::App;
use crate::verdict::Quantity;

/// Shares of a limit whose colors are shown.
const WARMER: [f64; 3] = [0.5, 0.75, 1.0];

/// The signs with their meaning. The longest wording that fits.
pub fn line<'l>(app: &App, width: usize) -> Line<'l> {
    let (theme, calm) = (app.theme, app.theme.shots());
    let words = |words: &str| vec![Span::styled(words.to_owned(), theme.muted())];
    let meaning = |sign: &'static str, style: Style, meaning: &str| {
        [vec![Span::styled(sign, style)], words(&format!(" {meaning}"))].concat()
    };
    let above = above(app);
    let short = above.replace(" shots ", " ");
    let [whole, brief] = [&above, &short].map(|above| meaning(DECIDING, calm, above));
    let [planned, plan] = ["planned", "plan"].map(|words| meaning(PLANNED, theme.title(), words));
    let limit = meaning("┃", theme.muted(), "limit");
    let warmer = WARMER.map(|share| Span::styled(DECIDING, theme.heat(calm, share)));
    let warmer = [warmer.to_vec(), words(" 50 to 100 %")].concat();
    let in_time = meaning(LINE[2], calm, "as planned");
    let texts = match () {
        () if app.plans().iter().any(|app| app.rows_are_deciding()) => vec![
            vec![whole.clone(), planned.clone(), limit.clone(), warmer.clone()],
            vec![brief.clone(), plan.clone(), limit.clone(), warmer],
            vec![whole, planned, limit.clone()],
            vec![brief.clone(), plan, limit],
            vec![brief],
            vec![words(&short)],
        ],
        // The rows show planned shots, but the bars are from sampled shots.
        () if app.plans().iter().any(|app| has_bars(app)) => vec![
            vec![in_time.clone(), whole, planned, limit.clone()],
            vec![in_time.clone(), brief.clone(), limit],
            vec![in_time, brief],
            vec![words("as planned")],
        ],
        () => vec![
            vec![
                [
                    vec![Span::styled(LINE[2], calm), " ".into()],
                    meaning(PLANNED, theme.title(), "as planned"),
                ]
                .concat(),
                limit,
            ],
            vec![words("as planned")],
        ],
    };
    let lines = texts.into_iter().map(|parts| Line::from(parts.join(&Span::raw(" "))));
    lines.into_iter().find(|line| line.width() <= width).unwrap_or_default()
}

/// Words for the share of shots above the bar. Without a number if the plans accept different shares.
fn above(app: &App) -> String {
    let accepted = app.case.limits.accepted_risk;
    match app.plans().iter().all(|app| app.case.limits.accepted_risk == accepted) {
        true => one_in_above(&app.case.limits),
        false => "few shots above".to_owned(),
    }
}

/// Whether any option has enough sampled shots for a bar.
fn has_bars(app: &App) -> bool {
    let judged = (0..app.options.len()).filter_map(|option| app.judgement(option));
    judged.into_iter().any(|judged| judged.used_of_limit(Quantity::Height, &app.case.limits).is_some())
}
