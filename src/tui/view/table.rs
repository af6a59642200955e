//! One row per delay option; columns come and go with the width.

use ratatui::Frame;
use ratatui::layout::{Constraint, Rect};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Row as Cells, Table, TableState};

use crate::report::spark::sparkline;
use crate::study::check::Checked;
use crate::tui::app::{App, Row};
use crate::tui::theme;
use crate::units::{self, Unit, margin_percent, value_and_error};
use crate::verdict::Verdict;

/// A column: head, width, and the least width of the screen that shows it.
struct Column {
    head: &'static str,
    width: u16,
    from: u16,
    cell: fn(&App, &Checked, u16) -> String,
}

const VERDICT: u16 = 6;

const COLUMNS: &[Column] = &[
    Column {
        head: "height, m",
        width: 15,
        from: 0,
        cell: |_, checked, _| value_and_error(checked.height.value, checked.height.error, Unit::Metre),
    },
    Column {
        head: "force, kN",
        width: 15,
        from: 0,
        cell: |_, checked, _| value_and_error(checked.force.value, checked.force.error, Unit::Kilonewton),
    },
    Column { head: "factor", width: 6, from: 70, cell: |_, checked, _| units::factor(checked.safety_factor) },
    Column {
        head: "left m",
        width: 7,
        from: 110,
        cell: |app, checked, _| percent(margin_percent(checked.height.value, app.case.limits.height)),
    },
    Column {
        head: "left kN",
        width: 7,
        from: 110,
        cell: |app, checked, _| percent(margin_percent(checked.force.value, app.case.limits.force)),
    },
    Column {
        head: "drift, m",
        width: 14,
        from: 130,
        cell: |_, checked, _| value_and_error(checked.drift.value, checked.drift.error, Unit::Metre),
    },
];

fn percent(margin: f64) -> String {
    format!("{margin:.0} %")
}

/// Draws the table.
pub fn draw(app: &App, frame: &mut Frame, area: Rect) {
    let columns: Vec<&Column> = COLUMNS.iter().filter(|column| area.width >= column.from).collect();
    let longest = app.case.plan.delays.iter().map(|delay| delay.name.chars().count()).max().unwrap_or(0);
    let fixed: u16 = columns.iter().map(|column| column.width + 1).sum::<u16>() + VERDICT + 2;
    let name = (longest.max(6) as u16).min(area.width.saturating_sub(fixed + 16).max(8));
    let spark = (area.width.saturating_sub(fixed + name + 2) / 2).min(40);
    let mut head = vec![Line::from("option"), Line::from("")];
    let mut widths = vec![Constraint::Length(name), Constraint::Length(VERDICT)];
    for column in &columns {
        head.push(Line::from(column.head).right_aligned());
        widths.push(Constraint::Length(column.width));
    }
    if spark >= 4 {
        head.extend(["height over time", "force over time"].map(Line::from));
        widths.extend([Constraint::Length(spark); 2]);
    }
    let options = app.case.plan.delays.iter().zip(&app.rows).enumerate();
    let rows = options.map(|(n, (delay, row))| {
        let style = if n == app.selected { app.theme.selected() } else { app.theme.base() };
        let name = format!("{:1$}", delay.name, usize::from(name));
        let mut cells = vec![Line::styled(name, style)];
        match row {
            Row::Done(checked) => {
                cells.push(verdict(app, checked.verdict));
                cells.extend(
                    columns
                        .iter()
                        .map(|column| Line::from((column.cell)(app, checked, area.width)).right_aligned()),
                );
                let width = usize::from(spark);
                let (history, limits) = (&checked.history, &app.case.limits);
                let spark =
                    |series, limit| Line::styled(sparkline(series, width, limit, false), app.theme.curve());
                cells.push(spark(&history.height, limits.height));
                cells.push(spark(&history.force, limits.force));
            }
            Row::Failed(message) => {
                cells.push(verdict(app, Verdict::Undecided));
                cells.push(Line::from(message.as_str()));
            }
            Row::Waiting => cells.push(Line::styled("waits", app.theme.quiet())),
            Row::Running { runs, done } => {
                cells.push(Line::styled(format!("{:>3.0} %", done * 100.0), app.theme.quiet()));
                cells.push(Line::styled(bar(*done, 15), app.theme.quiet()));
                cells.push(Line::styled(format!("run {}", runs + 1), app.theme.quiet()));
            }
        }
        Cells::new(cells)
    });
    let table = Table::new(rows, widths).header(Cells::new(head).style(app.theme.quiet()));
    let mut state = TableState::new().with_selected(app.selected);
    frame.render_stateful_widget(table, area, &mut state);
}

fn verdict(app: &App, verdict: Verdict) -> Line<'static> {
    Line::from(Span::styled(theme::word(verdict), app.theme.verdict(verdict)))
}

fn bar(done: f64, width: usize) -> String {
    let full = (done * width as f64) as usize;
    "█".repeat(full) + &"▁".repeat(width - full.min(width))
}
