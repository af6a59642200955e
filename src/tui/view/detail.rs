//! The selected option: why it does not pass, its peaks as planned, its samples, what decides it, and charts of both.
//!
//! ```text
//! ── 20 ms ───────────────────────────────────────
//! ✗ cable force … is over the limit of …
//! > launches 5 % lower … (what would make it pass)
//! as planned it fails from +5 % launch · decided by launch 60 %, …
//! as planned: height 1.741 ± 0.001 m, tire 3:1, 0.602 s …
//! 5 to 95 % of 200 samples: height …
//!  height over time        │ force over time
//!  height of the samples   │ force of the samples
//! ```

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::style::Modifier;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Borders, Paragraph, Wrap};

use super::chart;
use crate::jobs::StudyKind;
use crate::outcome::EndReason;
use crate::report::charts;
use crate::report::parts::Chart;
use crate::report::remedies::{sentence, without_pass};
use crate::report::words::option_sentences::{
    bands, broken, dud_of, firing_times_text, inputs, launch_limit, measure_first, next_tires, peaks,
};
use crate::report::words::reasons;
use crate::report::words::{no_result, warnings};
use crate::study::judgement::{self, Judgement};
use crate::study::reasons::Reason;
use crate::study::samples::influence::input_shares;
use crate::study::samples::sampled_shot::SampledShot;
use crate::tui::app::App;
use crate::tui::compare::OptionState;
use crate::tui::keymap::Action;
use crate::tui::studies::StudyState;
use crate::tui::theme;
use crate::units;
use crate::verdict::Verdict;

/// Least height of charts: flatter ones tell nothing.
const LEAST_CHART: u16 = 6;
/// Least height of two rows of charts.
const TWO_ROWS: u16 = 2 * LEAST_CHART;
/// Least width of four charts side by side.
const FOUR_CHARTS: u16 = 160;

/// Draws the detail of the selected option.
pub fn draw(app: &App, frame: &mut Frame, area: Rect) {
    let Some(delay) = app.case.plan.delays.get(app.selected) else { return };
    let rule = Block::new()
        .borders(Borders::TOP)
        .border_style(app.theme.muted())
        .title(Line::styled(format!(" {} ", delay.name), app.theme.title()));
    let times = format!(" rows fire at {} ", firing_times_text(&app.case.plan.blast_rows, delay));
    // The name is worth more than the times.
    let fits = Span::raw(&times).width() + Span::raw(&delay.name).width() + 4 <= usize::from(area.width);
    let rule = if fits { rule.title(Line::styled(times, app.theme.muted()).right_aligned()) } else { rule };
    let inside = rule.inner(area);
    frame.render_widget(rule, area);
    let judged = match &app.options[app.selected] {
        OptionState::Judged { judgement, .. } => judgement,
        OptionState::Failed(failed) => {
            let text = format!("No result: {}", no_result::message(failed));
            return frame.render_widget(Paragraph::new(text).wrap(Wrap { trim: true }), inside);
        }
        OptionState::Waiting | OptionState::Running { .. } => {
            let text = "Computing…";
            return frame.render_widget(Paragraph::new(text).wrap(Wrap { trim: true }), inside);
        }
    };
    let facts = fact_lines(app, judged);
    let lines: u16 =
        facts.iter().map(|line| (line.width() as u16).div_ceil(inside.width.max(1)).max(1)).sum();
    // Text is worth more than charts; Enter gives both the whole screen.
    let [text, rest] = Layout::vertical([Constraint::Length(lines), Constraint::Min(0)]).areas(inside);
    frame.render_widget(Paragraph::new(facts).wrap(Wrap { trim: true }), text);
    if lines > text.height {
        mark_cut(app, frame, text);
    }
    let history = charts::history(&app.case, &judged.checked.history, &app.case.shots[app.selected]);
    let sampled = judged.sampled.known();
    draw_charts(app, history, sampled, frame, rest);
}

/// Says at the end of a text that it goes on below.
fn mark_cut(app: &App, frame: &mut Frame, text: Rect) {
    let rest = match is_listed(app) {
        // Enter makes the change selected there.
        true => " … goes on below: make the window higher ".to_owned(),
        false => format!(" … goes on below: {} ", app.keymap.hint(Action::Open)),
    };
    let last = Rect { y: text.bottom().saturating_sub(1), height: text.height.min(1), ..text };
    let mark = Line::styled(rest, app.theme.firing().add_modifier(Modifier::REVERSED)).right_aligned();
    frame.render_widget(mark, last);
}

/// Draws height and force over time, and those of the samples. Where only one of both has room, the samples stand.
fn draw_charts(app: &App, history: [Chart; 2], sampled: Option<&SampledShot>, frame: &mut Frame, area: Rect) {
    if area.height < LEAST_CHART {
        return;
    }
    let rows = match sampled.map(|sampled| charts::samples(&app.case, sampled)) {
        None => vec![history.to_vec()],
        Some(samples) if area.height >= TWO_ROWS => vec![history.to_vec(), samples.to_vec()],
        Some(samples) if area.width >= FOUR_CHARTS => vec![[history, samples].concat()],
        Some(samples) => vec![samples.to_vec()],
    };
    let areas = Layout::vertical(vec![Constraint::Fill(1); rows.len()]).split(area);
    for (row, area) in rows.iter().zip(areas.iter()) {
        let areas = Layout::horizontal(vec![Constraint::Fill(1); row.len()]).spacing(1).split(*area);
        for (chart, area) in row.iter().zip(areas.iter()) {
            chart::draw(app, chart, None, frame, *area);
        }
    }
}

/// Whether the list of changes of the selected option is open.
fn is_listed(app: &App) -> bool {
    app.studies.remedy_list.is_some_and(|list| list.option == app.selected)
}

/// The changes with which the selected option would pass, the selected one marked; or how far their study is.
fn remedy_lines<'a>(app: &App) -> Vec<Line<'a>> {
    let (case, theme) = (&app.case, app.theme);
    let Some((remedies, selected)) = app.open_remedies() else {
        let text = match app.studies.state(StudyKind::Remedies) {
            StudyState::Failed(failed) => no_result::message(failed),
            state => format!("looking for changes with which it would pass… {state}"),
        };
        return vec![Line::styled(text, theme.firing())];
    };
    let mut lines = Vec::new();
    if remedies.passing().next().is_some() {
        let enter = app.keymap.hint(Action::Open);
        let head = format!("it would pass with any one of these changes; {enter} makes the selected one:");
        lines.push(Line::styled(head, theme.title()));
    }
    lines.extend(remedies.passing().enumerate().map(|(n, passing)| {
        let (mark, style) = if n == selected { ("> ", theme.selected()) } else { ("· ", theme.base()) };
        Line::styled(format!("{mark}{}", sentence(case, passing)), style)
    }));
    lines.extend(without_pass(&app.case, remedies).into_iter().map(|line| Line::styled(line, theme.muted())));
    lines
}

fn fact_lines<'a>(app: &App, judged: &Judgement) -> Vec<Line<'a>> {
    let (case, theme, checked) = (&app.case, app.theme, &judged.checked);
    // As long as samples come, how many there are says more than that they do not suffice.
    let open = app.options[app.selected].is_sampling()
        && judgement::verdict_of_both(Verdict::Pass, judged.sampled.map(SampledShot::verdict))
            == Verdict::Undecided;
    let reasons = judged.reasons().into_iter().filter(|why| !open || matches!(why, Reason::AsPlanned(_)));
    let mut lines: Vec<Line> = reasons
        .map(|why| {
            let sign = theme::label(why.verdict()).chars().next().unwrap_or(' ');
            let text = format!("{sign} {}", reasons::sentence(case, judged, &why));
            Line::styled(text, theme.verdict(why.verdict()))
        })
        .collect();
    if !checked.broken.is_empty() {
        lines.push(Line::styled(broken(case.scene(), checked), theme.limit()));
    }
    if is_listed(app) {
        lines.extend(remedy_lines(app));
    }
    // What was seen of earlier shots speaks against every verdict of the plan.
    let contradiction = app.contradiction();
    let passes = judged.verdict() == Verdict::Pass && contradiction.is_empty();
    if let Some(sampled) = judged.sampled.known().filter(|_| passes) {
        let text = format!("✓ {}", reasons::pass(sampled));
        lines.push(Line::styled(text, theme.verdict(Verdict::Pass)));
    }
    lines.splice(
        0..0,
        contradiction.into_iter().map(|sentence| Line::styled(format!("! {sentence}"), theme.limit())),
    );
    let warnings = warnings::of_option(case, app.selected, judged);
    lines.extend(warnings.into_iter().map(|warning| Line::styled(format!("! {warning}"), theme.firing())));
    let sampled = judged.sampled.known();
    if open {
        let samples = sampled.map_or(0, |sampled| sampled.samples.len());
        lines.push(Line::styled(format!("? {samples} samples so far, more come"), theme.firing()));
    }
    let next_tires = next_tires(case, judged).into_iter();
    lines.extend(next_tires.map(|text| Line::styled(format!("! {text}"), theme.firing())));
    lines.extend(dud_of(case, judged).map(Line::from));
    lines.extend(app.holds(app.selected).map(Line::from));
    let shares = sampled.and_then(|sampled| input_shares(sampled, &case.limits));
    let decided = shares.as_deref().map(|shares| format!("decided by {}", inputs(shares)));
    let measure = shares.as_deref().and_then(measure_first).map(str::to_owned);
    let launch = launch_limit(&case.shots[app.selected], judged);
    let launch = launch.map(|launch| format!("as planned it {launch}"));
    let decided: Vec<String> = launch.into_iter().chain(decided).chain(measure).collect();
    if !decided.is_empty() {
        lines.push(Line::from(decided.join(" · ")));
    }
    lines.push(Line::from(format!("as planned: {}", peaks(case.scene(), checked))));
    lines.extend(sampled.and_then(|sampled| bands(case, sampled)).map(Line::from));
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
        units::seconds(checked.end.time),
    );
    lines.push(Line::styled(how, theme.muted()));
    lines
}
