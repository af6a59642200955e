//! The Plan screen: the values of the plan, the shelter from above with its holes, and the verdicts.

use ratatui::Frame;
use ratatui::layout::{self, Constraint, Margin, Rect};
use ratatui::text::Line;
use ratatui::widgets::{Paragraph, Wrap};
use unicode_width::UnicodeWidthStr;

use super::widgets::{draw_divider, wrapped};
use super::{detail, fields, firing_map, hardest_cables, launch, limit_chart, plan_verdict};
use crate::plan::Layout;
use crate::report::words::{objections, plan_warnings};
use crate::tui::app::{App, Areas, ClickTarget};
use crate::tui::editor::entry::Entry;
use crate::tui::keymap::Action;
use crate::tui::screen::Screen;

/// Least rows below the values for a map of the cables: a blank row, a rule, two rows for each row of tires, a legend.
const CABLES: u16 = 12;

/// Width of the map [% of the screen].
const RIGHT: u16 = 45;

/// Height of charts below a map for which the map gives up its true proportions.
const TALL_CHARTS: u16 = 10;

/// Margins that stay free beside sentences.
const SIDES: Margin = Margin::new(1, 0);

/// Draws the screen.
pub fn draw(app: &App, frame: &mut Frame, area: Rect, areas: &mut Areas) {
    let columns = [Constraint::Min(0), Constraint::Length(area.width * RIGHT / 100)];
    let [left, right] = layout::Layout::horizontal(columns).spacing(1).areas(area);
    let mut warnings = plan_warnings::of_plan(&app.case);
    warnings.extend(objections::of_file(&app.case.source.name(), app.file));
    let hint = hint(app);
    let lines =
        wrapped(std::slice::from_ref(&hint), left.inner(SIDES).width) + u16::from(!warnings.is_empty());
    // Warnings are more important than the last values.
    let lines = lines
        + warnings.iter().map(|warning| height(warning, left.inner(SIDES))).sum::<u16>().min(area.height / 2);
    let [list, message] =
        layout::Layout::vertical([Constraint::Min(0), Constraint::Length(lines)]).areas(left);
    let [drawn, limits] =
        layout::Layout::vertical([Constraint::Min(0), Constraint::Length(plan_verdict::LIMITS)]).areas(right);
    let rows = match launch::is_asked(app) {
        true => {
            launch::draw(app, frame, drawn);
            Vec::new()
        }
        false => draw_shelter_and_charts(app, frame, drawn, areas),
    };
    let shelter = drawn;
    let times = app.editor.times_of(app.selected);
    areas.extend(times.map(|field| (shelter, ClickTarget::Field(field))));
    areas.extend(rows.into_iter().map(|(line, row)| (line, ClickTarget::FiringTime(row))));
    plan_verdict::draw_limits(app, frame, limits);
    draw_divider(app, frame, left);
    // The fields come after the map, because their lists of names lie over it.
    let free = fields::draw(app, frame, list, areas);
    // Draw the top of the divider again, now that the rule above the values exists for it to join.
    draw_divider(app, frame, Rect { height: 1.min(left.height), ..left });
    if let Some(judged) = app.judgement(app.selected).filter(|_| free.height >= CABLES) {
        hardest_cables::draw_alone(
            app,
            judged,
            frame,
            Rect { y: free.y + 1, height: free.height - 1, ..free },
        );
    }
    draw_message(hint, app, &warnings, frame, message.inner(SIDES));
}

/// Draws the shelter in true proportions, and the charts of the selected option if they fit below it.
fn draw_shelter_and_charts(
    app: &App,
    frame: &mut Frame,
    area: Rect,
    areas: &mut Areas,
) -> Vec<(Rect, usize)> {
    let [width, height] = firing_map::size(app.case.scene());
    // Around the map stand title, column numbers, firing times and legend; beside it the row numbers. A cell is twice as high as wide.
    let in_proportion = (0.5 * f64::from(area.width) * height / width).ceil() as u16;
    let in_proportion = in_proportion.saturating_add(firing_map::AROUND);
    // If the charts would be low, one row between two rows of tires is enough.
    let in_proportion = match &app.case.plan.layout {
        Layout::Grid(mesh) => {
            let low = firing_map::lines_of_rows(mesh.rows).saturating_add(firing_map::AROUND);
            in_proportion.min(low.max(area.height.saturating_sub(TALL_CHARTS)))
        }
        Layout::Quincunx(_) | Layout::List { .. } => in_proportion,
    };
    let left = area.height.saturating_sub(in_proportion);
    let has_charts = left >= limit_chart::LEAST_SIZE.1 && area.width > 2 * limit_chart::LEAST_SIZE.0;
    let charts = if has_charts { left } else { 0 };
    let [shelter, charts] =
        layout::Layout::vertical([Constraint::Min(0), Constraint::Length(charts)]).areas(area);
    detail::draw_charts(app, None, frame, charts, areas);
    firing_map::draw(app, frame, shelter)
}

/// Lines of a warning behind its sign, plus one: words are not split, so lines have gaps.
fn height(warning: &str, area: Rect) -> u16 {
    (warning.width() + 2).div_ceil(usize::from(area.width.max(1))) as u16 + 1
}

/// The keys that the footer does not show, or the current mistake.
fn hint(app: &App) -> Line<'static> {
    let editor = &app.editor;
    let muted = app.theme.muted();
    match (&editor.problem, &editor.entry) {
        (Some(problem), _) => Line::styled(problem.clone(), app.theme.limit()),
        (None, Some(Entry::Order(_))) => {
            let [up, down, left, right] =
                [Action::Up, Action::Down, Action::Left, Action::Right].map(|action| app.keymap.hint(action));
            let hint =
                format!("{up} {down} select a row, {left} {right} move it · Enter takes it, Esc leaves it");
            Line::styled(hint, muted)
        }
        (None, Some(Entry::Name(_))) => {
            Line::styled("letters find a name · Enter takes it, Esc leaves it", muted)
        }
        (None, Some(Entry::Typed { .. })) => {
            Line::styled("Enter takes it, Esc leaves it · an arrow key keeps what stands there", muted)
        }
        (None, None) if editor.launch_is_selected() => {
            let fit = app.keymap.first_key(Action::Show(Screen::Studies));
            let open = app.keymap.hint(Action::Open);
            let hint = format!("{open} edits · filmed? {fit} Studies, Fit: tell it the height that was seen");
            Line::styled(hint, muted)
        }
        (None, None) if editor.field().is_some_and(|field| field.is_assumed) => {
            let hint = "found on site? Type it here, and take the word out of its comment in the file";
            Line::styled(hint, app.theme.caution())
        }
        (None, None) => {
            let [up, down] = [Action::PageUp, Action::PageDown].map(|action| app.keymap.hint(action));
            Line::styled(format!("{up} {down}: groups"), muted)
        }
    }
}

fn draw_message(hint: Line<'static>, app: &App, warnings: &[String], frame: &mut Frame, area: Rect) {
    let mut lines: Vec<Line> = Vec::new();
    // Keep the last lines for the hint and for the number of hidden warnings.
    let mut room =
        usize::from(area.height.saturating_sub(wrapped(std::slice::from_ref(&hint), area.width) + 1));
    for (n, warning) in warnings.iter().enumerate() {
        let height = usize::from(height(warning, area));
        let warning = format!("! {warning}");
        if height > room {
            let hidden = warnings.len() - n;
            lines.push(Line::styled(
                format!("! {hidden} more: `shelter check` lists them"),
                app.theme.limit(),
            ));
            break;
        }
        room -= height;
        lines.push(Line::styled(warning, app.theme.limit()));
    }
    lines.push(hint);
    frame.render_widget(Paragraph::new(lines).wrap(Wrap { trim: true }), area);
}
