//! The selected option: its peaks with place and time, why it does not pass, height and force over time.
//!
//! ```text
//! ── 20 ms ───────────────────────────────────────
//! height 1.741 ± 0.001 m at tire 3:1, 0.602 s …
//! ✗ cable force … is over the limit of …
//!  flight height, m        │ cable force, kN
//! ```

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::text::Line;
use ratatui::widgets::{Block, Borders, Paragraph, Wrap};

use super::chart;
use crate::outcome::EndReason;
use crate::report::charts;
use crate::report::explain::{broken, peaks, reason};
use crate::report::no_result;
use crate::scene::fire_at_s;
use crate::study::check::Checked;
use crate::tui::app::App;
use crate::tui::options::OptionState;
use crate::units;

/// Draws the detail of the selected option.
pub fn draw(app: &App, frame: &mut Frame, area: Rect) {
    let Some(delay) = app.case.plan.delays.get(app.selected) else { return };
    let rule = Block::new()
        .borders(Borders::TOP)
        .border_style(app.theme.quiet())
        .title(Line::styled(format!(" {} ", delay.name), app.theme.title()));
    let inside = rule.inner(area);
    frame.render_widget(rule, area);
    let checked = match &app.options[app.selected] {
        OptionState::Done(checked) => checked,
        OptionState::Failed(failed) => {
            let text = format!("No result: {}", no_result::message(failed));
            return frame.render_widget(Paragraph::new(text).wrap(Wrap { trim: true }), inside);
        }
        OptionState::Waiting | OptionState::Running { .. } => {
            let fires: Vec<_> = fire_at_s(&delay.timing).into_iter().map(units::milliseconds).collect();
            let text = format!("Rows fire at {}. Computing…", fires.join(", "));
            return frame.render_widget(Paragraph::new(text).wrap(Wrap { trim: true }), inside);
        }
    };
    let facts = fact_lines(app, checked);
    let lines: u16 =
        facts.iter().map(|line| (line.width() as u16).div_ceil(inside.width.max(1)).max(1)).sum();
    let [text, rest] =
        Layout::vertical([Constraint::Length(lines.min(inside.height / 2)), Constraint::Min(0)])
            .areas(inside);
    frame.render_widget(Paragraph::new(facts).wrap(Wrap { trim: true }), text);
    let [left, right] = Layout::horizontal([Constraint::Fill(1); 2]).spacing(1).areas(rest);
    let [height, force] = charts::history(&app.case, &checked.history, &fire_at_s(&delay.timing));
    chart::draw(app, &height, None, frame, left);
    chart::draw(app, &force, None, frame, right);
}

fn fact_lines<'a>(app: &App, checked: &Checked) -> Vec<Line<'a>> {
    let how = format!(
        "step {} · {} runs in {} · energy residual {:.0e} · {} {}",
        units::milliseconds(checked.step),
        checked.runs,
        units::milliseconds(checked.total_wall.as_secs_f64()),
        checked.energy_residual,
        match checked.end.reason {
            EndReason::AtRest => "at rest after",
            EndReason::TimeLimit => "followed for",
        },
        units::seconds(checked.end.at),
    );
    let mut lines = vec![Line::from(peaks(app.case.scene(), checked)), Line::styled(how, app.theme.quiet())];
    for why in &checked.reasons {
        let sign = crate::tui::theme::label(why.verdict()).chars().next().unwrap_or(' ');
        lines.push(Line::styled(format!("{sign} {}", reason(why)), app.theme.verdict(why.verdict())));
    }
    if !checked.broken.is_empty() {
        lines.push(Line::styled(broken(app.case.scene(), checked), app.theme.limit()));
    }
    lines
}
