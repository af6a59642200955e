//! The values of the plan in groups with headings, and the lists for choosing a value.

use ratatui::Frame;
use ratatui::layout::{Position, Rect};
use ratatui::style::Style;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Borders, Clear, List, ListState};

use super::compare::{TRYING, verdict_words};
use super::fitting::{cut_at_word, option_name};
use super::option_bars::use_of_nearest_limit;
use crate::plan::DelayOption;
use crate::plan::edit::fields::{EditField, Path};
use crate::plan::keys::{limits, plan};
use crate::report::words::headline::UNCHECKED;
use crate::report::words::option_sentences::firing_times;
use crate::ropes::catalogue;
use crate::sorting::sort_by_key;
use crate::study::Case;
use crate::tui::app::{App, Areas, ClickTarget};
use crate::tui::editor::entry::Entry;
use crate::tui::editor::name_list::NameList;
use crate::tui::editor::order_editor::OrderEditor;
use crate::tui::keymap::Action;
use unicode_width::UnicodeWidthStr;

/// Shorter labels for the one-line form of a group: (label, short label).
const SHORT: [(&str, &str); 6] = [
    ("limit of flight height", "height"),
    ("cable safety factor", "safety"),
    ("tire mass", "mass"),
    ("outer diameter", "diameter"),
    ("shelter rows", "rows"),
    ("shelter columns", "columns"),
];
/// Least width of an option's name. `SIGNS`: width of the signs beside it. `GROUP`: width of the name of another group.
const OPTION: usize = 13;
const SIGNS: usize = 4;
const GROUP: usize = 7;
/// Most names of a list shown at once.
const MOST_NAMES: u16 = 12;

/// Draws the values. Returns the rows left free below them.
pub fn draw(app: &App, frame: &mut Frame, area: Rect, areas: &mut Areas) -> Rect {
    let editor = &app.editor;
    let title = if editor.unsaved() { " Plan, not saved, * changed " } else { " Plan " };
    let block = Block::new()
        .borders(Borders::TOP)
        .border_style(app.theme.muted())
        .title(Span::styled(title, app.theme.title()));
    let inside = block.inner(area);
    let width = label_width(app, area.width.into());
    // One cell stays free beside the divider.
    let line_width = usize::from(area.width).saturating_sub(1);
    let times = app.case.plan.delays.iter().map(|delay| times_and_order(&app.case, delay)[0].width());
    let times = times.max().unwrap_or(0);
    let named = name_width(&app.case, line_width, times);
    // Widths of names and of whole lines, and the column at which bars begin.
    let widths = [named, line_width, named + SIGNS + times + 1];
    // A closed group has one line or more. The open group has a heading, which has no index, and a line for each value.
    let mut lines: Vec<(Option<usize>, Line<'_>)> = Vec::new();
    let groups = groups(app, inside.height.into());
    let mut free = usize::from(inside.height).saturating_sub(lines_at_least(app, &groups));
    let mut first = 0;
    for group in groups {
        let numbers = first..first + group.len();
        if numbers.contains(&editor.selected) {
            lines.push((None, heading(app, &group[0], widths)));
            let values = numbers
                .zip(group)
                .map(|(n, field)| (Some(n), value_line(app, n, field, width, area.width.into())));
            lines.extend(values);
        } else {
            let rows = group_lines(app, group, widths, free);
            free -= rows.len() - 1;
            lines.extend(rows.into_iter().map(|row| (Some(editor.place_in_group(first)), row)));
        }
        first += group.len();
    }
    let selected = lines.iter().position(|(n, _)| *n == Some(editor.selected));
    let left = inside.height.saturating_sub(lines.len() as u16);
    let below = Rect { y: inside.bottom() - left, height: left, ..inside };
    let mut state = ListState::default().with_selected(selected);
    let (numbers, rows): (Vec<Option<usize>>, Vec<Line<'_>>) = lines.into_iter().unzip();
    frame.render_stateful_widget(List::new(rows).block(block).scroll_padding(1), area, &mut state);
    let shown = numbers.into_iter().skip(state.offset()).take(usize::from(inside.height));
    for (y, field) in (inside.y..).zip(shown) {
        let row = Rect { y, height: 1, ..inside };
        let Some(field) = field else { continue };
        areas.push((row, ClickTarget::Field(field)));
        if field != editor.selected {
            continue;
        }
        match &editor.entry {
            Some(Entry::Typed { line, .. }) => {
                let x = inside.x + (width + 5 + line.input.visual_cursor()) as u16;
                frame.set_cursor_position(Position::new(x.min(inside.right().saturating_sub(1)), y));
            }
            Some(Entry::Order(order)) => draw_order(app, order, frame, row),
            Some(Entry::Name(names)) => draw_names(app, names, frame, row),
            None => {}
        }
    }
    below
}

/// The heading of the open group. The heading of a delay option includes the sign of its verdict, below the signs of the others.
fn heading<'l>(app: &App, first: &EditField, widths @ [named, ..]: [usize; 3]) -> Line<'l> {
    let option = first.path.index.filter(|_| first.path.section == plan::DELAY.name);
    let mut line = Line::styled(format!(" {:named$}", first.group), app.theme.title());
    let Some(option) = option else { return line };
    let (sign, style) = sign_of_verdict(app, option);
    line.push_span(Span::styled(format!(" {sign}"), style));
    with_bar(app, option, line, widths)
}

/// The sign of the verdict on an option; dots while there is none.
fn sign_of_verdict(app: &App, option: usize) -> (String, Style) {
    match verdict_words(app, option) {
        (TRYING, style) => ("…".to_owned(), style),
        (words, style) => (words.chars().take(1).collect(), style),
    }
}

/// The groups in order. If they have no room with one line each, neighboring blast rows with the same launch become one group.
fn groups(app: &App, room: usize) -> Vec<&[EditField]> {
    let fields = &app.editor.fields;
    let all: Vec<&[EditField]> = fields.chunk_by(|a, b| a.group == b.group).collect();
    if lines_at_least(app, &all) <= room {
        return all;
    }
    let is_closed_row =
        |group: &[EditField]| group[0].path.section == plan::BLAST_ROW.name && !is_open(app, group);
    let folds = |a: &&[EditField], b: &&[EditField]| {
        is_closed_row(a) && is_closed_row(b) && launch_in_short(a) == launch_in_short(b)
    };
    let mut first = 0;
    let folded = all.chunk_by(folds).map(|groups| {
        let from = first;
        first += groups.iter().map(|group| group.len()).sum::<usize>();
        &fields[from..first]
    });
    folded.collect()
}

/// Whether a group contains the selected value.
fn is_open(app: &App, group: &[EditField]) -> bool {
    app.editor.fields.get(app.editor.selected).is_some_and(|field| field.group == group[0].group)
}

/// The values of a blast row without its place.
fn launch_in_short(row: &[EditField]) -> Vec<String> {
    in_short(row).into_iter().filter(|value| !value.starts_with("under")).collect()
}

/// Number of lines of all groups if each closed group has one line.
fn lines_at_least(app: &App, groups: &[&[EditField]]) -> usize {
    groups.iter().map(|group| if is_open(app, group) { group.len() + 1 } else { 1 }).sum()
}

/// Width of the labels of the open group; without units if they do not fit.
fn label_width(app: &App, room: usize) -> usize {
    let editor = &app.editor;
    let selected = editor.fields.get(editor.selected).map(|field| &field.group);
    let of_group = || editor.fields.iter().filter(|field| Some(&field.group) == selected);
    let widest = |label: fn(&'static str) -> &'static str| {
        of_group().map(|field| label(field.label).width()).max().unwrap_or(0)
    };
    let whole = widest(|label| label);
    if 2 * whole <= room { whole } else { widest(without_unit).min(room / 2) }
}

/// A label without its unit.
fn without_unit(label: &'static str) -> &'static str {
    label.split_once(", ").map_or(label, |(label, _)| label)
}

/// A closed group: the values that the plan states, in one line, or in up to `more` further lines.
fn group_lines<'l>(
    app: &App,
    group: &[EditField],
    widths @ [_, width, _]: [usize; 3],
    more: usize,
) -> Vec<Line<'l>> {
    let Path { section, index, .. } = group[0].path;
    let mark = if group.iter().any(|field| app.editor.is_changed(field)) { "*" } else { " " };
    let mark = Span::styled(mark, app.theme.limit());
    let option = index.filter(|_| section == plan::DELAY.name);
    if let Some((option, delay)) = option.and_then(|n| Some((n, app.case.plan.delays.get(n)?))) {
        return vec![option_line(app, option, delay, mark, widths)];
    }
    let (mut name, mut values) = (group[0].group.clone(), in_short(group));
    let last = &group[group.len() - 1].group;
    if *last != name {
        // Blast rows with one launch: `row 1-3`.
        name = format!("{name}-{}", last.trim_start_matches("row "));
        values = launch_in_short(group.chunk_by(|a, b| a.group == b.group).next().unwrap_or(group));
    }
    let name = format!("{name:GROUP$} ");
    let room = width.saturating_sub(1 + name.width());
    let mut rows = rows(&values, room);
    if rows.len() > 1 + more {
        rows.truncate(1 + more);
        match rows.last_mut().filter(|_| more > 0) {
            // The cue replaces the comma at the end.
            Some(last) => last.replace_range(last.len() - 1.., " …"),
            None => rows = vec![fitting(&values, room)],
        }
    }
    let mut rows = rows.into_iter();
    let mut first = Line::from(vec![mark, Span::styled(name.clone(), app.theme.title())]);
    if let Some(row) = rows.next() {
        let told =
            assumed(group).into_iter().chain([UNCHECKED.to_owned()]).find(|told| row.starts_with(told));
        let (told, others) = row.split_at(told.map_or(0, |told| told.len()));
        first.push_span(Span::styled(told.to_owned(), app.theme.caution()));
        first.push_span(Span::styled(others.to_owned(), app.theme.muted()));
    }
    let rows = rows.map(|row| Span::styled(row, app.theme.muted()));
    let indent = " ".repeat(1 + name.width());
    [first].into_iter().chain(rows.map(|row| Line::from(vec![Span::raw(indent.clone()), row]))).collect()
}

/// All values in lines of `width`. No value is split.
fn rows(values: &[String], width: usize) -> Vec<String> {
    let mut rows: Vec<String> = Vec::new();
    for value in values {
        match rows.last_mut().filter(|row| row.width() + 2 + value.width() < width) {
            Some(row) => *row += &format!(", {value}"),
            None => {
                rows.last_mut().into_iter().for_each(|row| row.push(','));
                rows.push(super::compare::cut(value, width));
            }
        }
    }
    rows
}

/// Width of the names of options: the longest name if the widest `times` fit beside it.
fn name_width(case: &Case, width: usize, times: usize) -> usize {
    let longest = case.plan.delays.iter().map(|delay| delay.name.width()).max().unwrap_or(0);
    longest.min(width.saturating_sub(times + SIGNS)).max(OPTION)
}

/// Firing times of the rows: with their order, and without it.
fn times_and_order(case: &Case, delay: &DelayOption) -> [String; 2] {
    let times = firing_times(delay).replace('/', " ");
    [format!("{times} {}", order(case, delay)), times]
}

/// A delay option in one line: its name in `named` cells, the sign of its verdict, its firing times, and the order of its rows.
fn option_line<'l>(
    app: &App,
    option: usize,
    delay: &DelayOption,
    mark: Span<'l>,
    widths @ [named, width, _]: [usize; 3],
) -> Line<'l> {
    let (sign, style) = sign_of_verdict(app, option);
    let name = format!("{:named$}", option_name(app, option, named));
    // A time that is cut off would be a wrong time.
    let room = width.saturating_sub(named + SIGNS);
    let fits = |text: &String| text.width() <= room;
    let times = times_and_order(&app.case, delay).into_iter().find(fits).unwrap_or_else(|| "…".to_owned());
    let line = Line::from(vec![
        mark,
        Span::styled(name, app.theme.base()),
        Span::styled(format!(" {sign} "), style),
        Span::styled(times, app.theme.muted()),
    ]);
    with_bar(app, option, line, widths)
}

/// The line of an option with a bar for the utilization of its nearest limit, if the bar fits beside the times of all options.
fn with_bar<'l>(app: &App, option: usize, mut line: Line<'l>, [_, width, bar_at]: [usize; 3]) -> Line<'l> {
    let bar = use_of_nearest_limit(app, option, width.saturating_sub(bar_at));
    if !bar.is_empty() {
        line.push_span(" ".repeat(bar_at.saturating_sub(line.width())));
        line.extend(bar);
    }
    line
}

/// The blast rows in their order of firing: `1-2-3`; `1+2-3` if two rows fire together.
fn order(case: &Case, delay: &DelayOption) -> String {
    let times = delay.timing.fire_at();
    let mut rows: Vec<usize> = (0..times.len()).collect();
    sort_by_key(&mut rows, |&row| times[row]);
    let name = |row: usize| case.plan.blast_rows[row].name.as_str();
    let mut order = rows.first().map_or_else(String::new, |&row| name(row).to_owned());
    for pair in rows.windows(2) {
        let sign = if times[pair[0]] == times[pair[1]] { '+' } else { '-' };
        order.push(sign);
        order += name(pair[1]);
    }
    order
}

/// As many values as fit, with a cue if there are more.
fn fitting(values: &[String], width: usize) -> String {
    let joined = |count: usize| {
        let more = if count < values.len() { " …" } else { "" };
        format!("{}{more}", values[..count].join(", "))
    };
    let fits = (1..=values.len()).rev().map(joined).find(|line| Span::raw(line).width() <= width);
    fits.unwrap_or_else(|| super::compare::cut(&joined(values.len().min(1)), width))
}

/// Number of values of a group that are marked as assumed, as text.
fn assumed(group: &[EditField]) -> Option<String> {
    let count = group.iter().filter(|field| field.is_assumed).count();
    (count > 0).then(|| format!("{count} assumed"))
}

/// The values that a group states, each with its label. The number of assumed values comes first. For the limits, also that the slide has
/// no limit.
fn in_short(group: &[EditField]) -> Vec<String> {
    let stated = group.iter().filter(|field| !field.value.is_empty());
    let value = |field: &EditField| {
        let (label, unit) = field.label.split_once(", ").unwrap_or((field.label, ""));
        let short = SHORT.iter().find(|(long, _)| *long == label).map_or(label, |(_, short)| short);
        let label = short.strip_prefix("limit of ").unwrap_or(short);
        // The name of the group stands before its values.
        let label = if *label == *group[0].group { "" } else { label };
        format!("{label} {} {unit}", field.value.trim_matches('"')).trim().to_owned()
    };
    let values = stated.map(value);
    let section = group[0].path.section;
    let is_drift = |field: &&EditField| field.path.key.name == limits::DRIFT_M.name && field.value.is_empty();
    let unjudged = group.iter().find(is_drift).map(|_| UNCHECKED.to_owned());
    let values: Vec<String> = assumed(group).into_iter().chain(unjudged).chain(values).collect();
    match values.is_empty() {
        true if section == plan::UNCERTAINTY.name => vec!["all of it ASSUMED".to_owned()],
        true => vec!["as by default".to_owned()],
        false => values,
    }
}

fn value_line<'l>(app: &'l App, n: usize, field: &'l EditField, width: usize, room: usize) -> Line<'l> {
    let editor = &app.editor;
    let selected = n == editor.selected;
    let label = match field.label.width() > width {
        true => cut_at_word(without_unit(field.label), width),
        false => field.label.to_owned(),
    };
    let typed = editor.typed().filter(|_| selected);
    let value = match typed {
        Some(line) => line.value().to_owned(),
        None if field.value.is_empty() => field.unset(),
        None => field.value.clone(),
    };
    // A typed text is never cut, because the cursor stands at its end.
    let room = room.saturating_sub(width + 5);
    let value = match typed.is_some() || value.chars().count() <= room {
        true => value,
        false => cut_at_word(&value, room),
    };
    let mark = if editor.is_changed(field) { "*" } else { " " };
    let style = if selected { app.theme.selected() } else { app.theme.base() };
    let before = typed.filter(|line| line.value() != field.value && !field.value.is_empty());
    let before = before.map(|_| Span::styled(format!(" was {}", field.value), app.theme.muted()));
    let has_room = value.width() + " assumed".len() <= room;
    let assumed = (field.is_assumed && before.is_none() && has_room)
        .then(|| Span::styled("assumed", app.theme.caution()));
    let spans = [
        Span::styled(mark, app.theme.limit()),
        Span::styled(format!(" {label:width$} "), app.theme.muted()),
        Span::styled(format!(" {value} "), style),
    ];
    Line::from_iter(spans.into_iter().chain(assumed).chain(before))
}

/// An area of `height` lines below `value`, or above it if there is no room below.
fn area_beside(value: Rect, height: u16, frame: &Frame) -> Rect {
    let height = height.min(frame.area().height);
    let below = value.y + 1 + height <= frame.area().bottom();
    let y = if below { value.y + 1 } else { value.y.saturating_sub(height) };
    Rect { y, height, ..value }.intersection(frame.area())
}

/// Draws the blast rows in their order of firing.
fn draw_order(app: &App, order: &OrderEditor, frame: &mut Frame, value: Rect) {
    let area = area_beside(value, order.names.len() as u16 + 2, frame);
    let rows = order.names.iter().enumerate().map(|(n, name)| {
        let style = if n == order.selected { app.theme.selected() } else { app.theme.base() };
        Line::styled(format!(" {}. row {name} ", n + 1), style)
    });
    let [left, right] = [Action::Left, Action::Right].map(|action| app.keymap.hint(action));
    let title = format!(" Firing order: {left} earlier, {right} later ");
    let block = Block::bordered().title(title).style(app.theme.base());
    let mut state = ListState::default().with_selected(Some(order.selected));
    frame.render_widget(Clear, area);
    frame.render_stateful_widget(List::new(rows).block(block), area, &mut state);
}

/// Draws the names that match the typed letters, with the figures that help to choose.
fn draw_names(app: &App, names: &NameList, frame: &mut Frame, value: Rect) {
    let matches = names.matches();
    let wide = frame.area().width.min(76);
    let area =
        area_beside(Rect { width: wide, ..value }, (matches.len() as u16).clamp(1, MOST_NAMES) + 2, frame);
    let rows = matches.iter().enumerate().map(|(n, name)| {
        let style = if n == names.selected { app.theme.selected() } else { app.theme.base() };
        Line::from(vec![
            Span::styled(format!(" {name:34.34} "), style),
            Span::styled(figures(name), app.theme.muted()),
        ])
    });
    let title = match names.letters.value() {
        "" => " type letters, Up Down, Enter takes it ".to_owned(),
        typed => format!(" {typed} "),
    };
    let block = Block::bordered().title(title).style(app.theme.base());
    let mut state = ListState::default().with_selected(Some(names.selected));
    frame.render_widget(Clear, area);
    frame.render_stateful_widget(List::new(rows).block(block), area, &mut state);
}

/// Diameter, breaking force and mass of a rope; efficiency of a termination.
fn figures(name: &str) -> String {
    if let Some(rope) = catalogue().ropes.iter().find(|rope| rope.name == name) {
        return format!(
            "{:>5} mm {:>7.1} kN {:>6.3} kg/m",
            rope.diameter_mm, rope.breaking_force_kn, rope.mass_kg_per_m
        );
    }
    let termination = catalogue().terminations.iter().find(|termination| termination.name == name);
    termination.map_or_else(String::new, |termination| format!("holds {} %", termination.efficiency_percent))
}
