//! Estimates of the launch velocity from the blast plan, on one scale, beside a launch velocity that the user types.
//!
//! ```text
//!  Where does this velocity come from?      0 to 25.8 m/s
//!  heave by energy        4.7 to 12.1      ━━━━┿━━━━
//!  impulse at the collar  6.5 to 25.8       ━━━━━━┿━━━━━━━━━━━━━
//!  this plan              6.0              ┿
//! ```

use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Borders, Paragraph, Wrap};

use crate::report::launch::{estimate_name, missing_words};
use crate::study::launch::{Blast, EarlierShots, LaunchEstimate, LaunchEstimates, fastest_launch};
use crate::tui::app::App;
use crate::tui::keymap::Action;
use crate::tui::screen::Screen;
use crate::units;

/// Most cells of the scale.
const SCALE: usize = 22;
/// Least cells of the scale; with fewer, only names and numbers are shown. `NAME`, `NUMBERS`: their widths.
const LEAST_SCALE: usize = 4;
const NAME: usize = 22;
const NUMBERS: usize = 13;

/// Whether the user is typing a launch velocity.
pub fn is_asked(app: &App) -> bool {
    app.editor.entry.is_some() && app.editor.launch_is_selected()
}

/// Draws the estimates.
pub fn draw(app: &App, frame: &mut Frame, area: Rect) {
    let own = fastest_launch(&app.case.plan);
    let earlier: Vec<EarlierShots> = EarlierShots::of_plan(&app.case.plan).into_iter().collect();
    let estimates = LaunchEstimates::new(&Blast::of_plan(&app.case.plan), None, &earlier);
    let top = estimates.all.iter().map(|estimate| estimate.band[2]).fold(1.2 * own, f64::max);
    let title = format!(" where the launch speed comes from · 0 to {} m/s ", units::rounded(top, 1));
    let block = Block::new().borders(Borders::TOP).title(title).border_style(app.theme.muted());
    let room = usize::from(area.width).saturating_sub(NAME + NUMBERS + 2);
    let cells = if room < LEAST_SCALE { 0 } else { room.min(SCALE) };
    let row = |name: String, band: [f64; 3], is_valid: bool| {
        let [low, _, high] = band;
        let numbers = match low == high {
            true => units::rounded(low, 1),
            false => format!("{} to {}", units::rounded(low, 1), units::rounded(high, 1)),
        };
        let style = if is_valid { app.theme.curve() } else { app.theme.muted() };
        Line::from(vec![
            Span::raw(format!("{name:NAME$.NAME$} {numbers:NUMBERS$}")),
            Span::styled(on_scale(band, top, cells), style),
        ])
    };
    let mut lines: Vec<Line> = vec![row("this plan".to_owned(), [own; 3], true)];
    let name = |estimate: &LaunchEstimate| match estimate.is_valid() {
        true => estimate_name(estimate),
        false => format!("({})", estimate_name(estimate)),
    };
    lines
        .extend(estimates.all.iter().map(|estimate| row(name(estimate), estimate.band, estimate.is_valid())));
    lines.push(Line::default());
    lines.extend(missing_words(&estimates).map(|text| Line::styled(text, app.theme.muted())));
    let fit = app.keymap.first_key(Action::Show(Screen::Studies));
    lines.push(Line::raw("Film a loose tire: one that rises 1.83 m, or flies 1.22 s, left at 6 m/s."));
    lines.push(Line::raw(format!(
        "Filmed a shot? Esc, {fit} Studies, Fit: {} types it in.",
        app.keymap.hint(Action::Open)
    )));
    let command =
        format!("`shelter launch {}` shows all, and --write says how sure they are.", app.case.source.name());
    lines.push(Line::styled(command, app.theme.muted()));
    frame.render_widget(Paragraph::new(lines).wrap(Wrap { trim: false }).block(block), area);
}

/// A band on a scale from 0 to `top` [m/s] in `cells` cells, with a mark at its middle value.
fn on_scale([low, middle, high]: [f64; 3], top: f64, cells: usize) -> String {
    let cell = |speed: f64| ((speed / top * cells as f64) as usize).min(cells - 1);
    let sign = |n: usize| match () {
        () if n == cell(middle) => '┿',
        () if (cell(low)..=cell(high)).contains(&n) => '━',
        () => ' ',
    };
    let scale: String = (0..cells).map(sign).collect();
    if cells > 0 { format!(" {scale}") } else { scale }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_band_lies_at_its_velocities() {
        assert_eq!(on_scale([5.5, 11.0, 22.0], 22.0, 22), "      ━━━━━━┿━━━━━━━━━━");
        assert_eq!(on_scale([6.0; 3], 22.0, 22).find('┿'), Some(7));
        assert_eq!(on_scale([5.5, 11.0, 22.0], 22.0, 4), "  ━┿━");
        assert_eq!(on_scale([5.5, 11.0, 22.0], 22.0, 0), "");
    }
}
