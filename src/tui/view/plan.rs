//! The plan screen: the values of the plan, the shelter from above with its holes, and the verdicts.

use ratatui::Frame;
use ratatui::layout::{self, Constraint, Margin, Rect};
use ratatui::style::Color;
use ratatui::symbols::Marker;
use ratatui::text::{Line, Span};
use ratatui::widgets::canvas::{self, Canvas, Points};
use ratatui::widgets::{Block, Borders, Paragraph, Wrap};
use unicode_width::UnicodeWidthStr;

use super::widgets::{color, draw_divider, wrapped};
use super::{compare, detail, fields, hardest_cables, launch, limit_chart, map_numbers, plan_verdict};
use crate::plan::Layout;
use crate::report::words::option_sentences::{firing_times, firing_times_text};
use crate::report::words::{objections, warnings};
use crate::scene::{Firing, Scene};
use crate::study::Case;
use crate::tui::app::{App, Areas, ClickTarget};
use crate::tui::editor::entry::Entry;
use crate::tui::keymap::Action;
use crate::tui::screen::Screen;

/// Least rows below the values that have a map of the cables: a blank one, its rule, two for each row of tires, its legend.
const CABLES: u16 = 12;

/// Percent of the width for the map, and least width of the table of options that has all its bars and names.
const RIGHT: u16 = 45;
const WITH_NAMES: u16 = 60;

/// Height of charts below a map, for which a map gives up that a cell is twice as high as wide.
const TALL_CHARTS: u16 = 10;

/// Left free beside sentences.
const SIDES: Margin = Margin::new(1, 0);

/// Draws the plan.
pub fn draw(app: &App, frame: &mut Frame, area: Rect, areas: &mut Areas) {
    // Verdicts, bars and whole names have room beside the values.
    let right = area.width * RIGHT / 100;
    let right = if area.width >= 2 * WITH_NAMES { right.max(WITH_NAMES) } else { right };
    let columns = [Constraint::Min(0), Constraint::Length(right)];
    let [left, right] = layout::Layout::horizontal(columns).spacing(1).areas(area);
    let mut warnings = warnings::of_plan(&app.case);
    warnings.extend(objections::of_file(&app.case.source.name(), app.file));
    let hint = hint(app);
    let lines =
        wrapped(std::slice::from_ref(&hint), left.inner(SIDES).width) + u16::from(!warnings.is_empty());
    // Warnings are worth more than the last values.
    let lines = lines
        + warnings.iter().map(|warning| height(warning, left.inner(SIDES))).sum::<u16>().min(area.height / 2);
    let options = app.listed_options().len() as u16 + compare::HEAD_LINES;
    let below_values = fields::height(app) + options + lines <= left.height;
    let [list, below, message] = layout::Layout::vertical([
        Constraint::Min(0),
        Constraint::Length(if below_values { options } else { 0 }),
        Constraint::Length(lines),
    ])
    .areas(left);
    // Without room for all options beside the map the selected one stands there: the values list all with their verdicts.
    let has_table = below_values || options <= right.height / 3;
    let beside = match has_table {
        true if below_values => 0,
        true => options,
        false => plan_verdict::LIMITS,
    };
    let [drawn, beside] =
        layout::Layout::vertical([Constraint::Min(0), Constraint::Length(beside)]).areas(right);
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
    match has_table {
        true => compare::draw(app, frame, if below_values { below } else { beside }, areas),
        false => plan_verdict::draw_limits(app, frame, beside),
    }
    draw_divider(app, frame, left);
    // Their lists of names lie over the map.
    let free = fields::draw(app, frame, list, areas);
    if let Some(judged) = app.judgement(app.selected).filter(|_| free.height >= CABLES) {
        hardest_cables::draw(app, judged, frame, Rect { y: free.y + 1, height: free.height - 1, ..free });
    }
    draw_message(hint, app, &warnings, frame, message.inner(SIDES));
}

/// Draws the shelter, as high as it is in proportion to its width, and the charts of the selected option where that leaves room for them.
fn draw_shelter_and_charts(
    app: &App,
    frame: &mut Frame,
    area: Rect,
    areas: &mut Areas,
) -> Vec<(Rect, usize)> {
    let [width, height] = map_size(app.case.scene());
    // Title, numbers of columns and legend stand around the map, numbers of rows beside it. A cell is twice as high as wide.
    let in_proportion = (0.5 * f64::from(area.width) * height / width).ceil() as u16 + 3;
    // Where charts would be low, one row between two of tires is enough.
    let in_proportion = match &app.case.plan.layout {
        Layout::Grid(mesh) => {
            in_proportion.min((2 * mesh.rows as u16 + 3).max(area.height.saturating_sub(TALL_CHARTS)))
        }
        Layout::Quincunx(_) | Layout::List { .. } => in_proportion,
    };
    let left = area.height.saturating_sub(in_proportion);
    let has_charts = left >= limit_chart::LEAST_SIZE.1 && area.width > 2 * limit_chart::LEAST_SIZE.0;
    let charts = if has_charts { left } else { 0 };
    let [shelter, charts] =
        layout::Layout::vertical([Constraint::Min(0), Constraint::Length(charts)]).areas(area);
    detail::draw_charts(app, None, frame, charts, areas);
    draw_shelter(app, frame, shelter)
}

/// Width and height of the map [m]: the tires with a margin around them.
fn map_size(scene: &Scene) -> [f64; 2] {
    let margin = margin(scene);
    [0, 1].map(|axis| {
        let [from, to] = scene.extent(axis);
        to - from + 2.0 * margin
    })
}

/// The margin around the tires [m].
fn margin(scene: &Scene) -> f64 {
    let [across, up] = [0, 1].map(|axis| scene.extent(axis)).map(|[from, to]| to - from);
    0.05 * across.max(up).max(1.0)
}

/// What a map of so many cells reaches along an axis [m]: the tires with a margin around them. Those of a grid stand evenly, so many whole
/// cells apart.
fn bounds(case: &Case, axis: usize, cells: u16) -> [f64; 2] {
    let (scene, last) = (case.scene(), f64::from(cells.max(2) - 1));
    let ([from, to], margin) = (scene.extent(axis), margin(scene));
    let around = [from - margin, to + margin];
    let Layout::Grid(mesh) = &case.plan.layout else { return around };
    let spacing = [mesh.column_spacing_m, mesh.row_spacing_m][axis];
    // Behind the last column its label needs room; above the last row nothing does.
    let length = [around[1] - around[0], to - from][axis];
    let apart = (spacing * last / length + ROUNDING_NOISE).floor();
    if !apart.is_finite() || apart < 1.0 {
        return around;
    }
    let cell = spacing / apart;
    let start = from - (0.5 * (last - (to - from) / cell) + ROUNDING_NOISE).floor() * cell;
    [start, start + last * cell]
}

/// What numbers of cells may be off by.
const ROUNDING_NOISE: f64 = 1e-6;

/// Lines of a warning behind its sign. Words that are not broken leave gaps: a line more.
fn height(warning: &str, area: Rect) -> u16 {
    (warning.width() + 2).div_ceil(usize::from(area.width.max(1))) as u16 + 1
}

/// What the keys do beside those of the footer, or what is wrong.
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
        (None, None) => {
            let [up, down] = [Action::PageUp, Action::PageDown].map(|action| app.keymap.hint(action));
            Line::styled(format!("{up} {down}: groups"), muted)
        }
    }
}

fn draw_message(hint: Line<'static>, app: &App, warnings: &[String], frame: &mut Frame, area: Rect) {
    let mut lines: Vec<Line> = Vec::new();
    // The lines at the foot stay for the hint, and one for how many warnings have no room.
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

/// Draws the shelter from above: a point per tire, the firing time of each hole in ms, or the sign of its turn where times have no
/// room, and lines of equal time. Returns the cell of each hole with its blast
/// row.
fn draw_shelter(app: &App, frame: &mut Frame, area: Rect) -> Vec<(Rect, usize)> {
    let (case, theme) = (&app.case, app.theme);
    let Some(delay) = case.plan.delays.get(app.selected) else { return Vec::new() };
    let [rows, times] = [firing_times_text(&case.plan.blast_rows, delay), firing_times(delay)];
    let titles =
        [format!(" {} · {rows} ", delay.name), format!(" {} · {times} ", delay.name), format!(" {times} ")];
    // Half a time is a wrong time.
    let title = titles.into_iter().find(|title| title.width() <= usize::from(area.width)).unwrap_or_default();
    let title = Line::styled(title, theme.title());
    let block = Block::new().borders(Borders::TOP).border_style(theme.muted()).title(title);
    let verdict = plan_verdict::line(app, area.width);
    let scene = case.scene();
    let tires: Vec<(f64, f64)> = scene.position.iter().map(|tire| (tire.x, tire.y)).collect();
    let mut fires = vec![false; tires.len()];
    let mut turns: Vec<(f64, Vec<(f64, f64)>)> = Vec::new();
    for firing in case.shots.get(app.selected).map_or(&[][..], |shot| &shot.firings) {
        let hole = tires[firing.tire];
        fires[firing.tire] = true;
        match turns.last_mut().filter(|(at, _)| *at == firing.time) {
            Some((_, holes)) => holes.push(hole),
            None => turns.push((firing.time, vec![hole])),
        }
    }
    let others: Vec<(f64, f64)> =
        tires.iter().zip(&fires).filter(|(_, fires)| !**fires).map(|(tire, _)| *tire).collect();
    // The canvas puts a character half a cell left of and above a point with the same coordinates: move the characters.
    let around = block.inner(area);
    frame.render_widget(block, area);
    // The first line is the verdict, the last one the legend.
    frame.render_widget(verdict, Rect { height: around.height.min(1), ..around });
    let around = Rect { y: around.y + 1, height: around.height.saturating_sub(2), ..around };
    let inside = map_numbers::map_area(scene, around);
    let [[left, right], [bottom, top]] =
        [(0, inside.width), (1, inside.height)].map(|(axis, cells)| bounds(case, axis, cells));
    let half = |length: f64, cells: u16| 0.5 * length / f64::from(cells.max(2) - 1);
    let (right_by, down_by) = (half(right - left, inside.width), half(top - bottom, inside.height));
    let lines = equal_time_lines(case, app.selected);
    let times: Vec<String> = turns.iter().map(|(at, _)| (at * 1e3).round().to_string()).collect();
    let widest = times.iter().map(String::len).max().unwrap_or(0);
    // A number that is cut would be another number: the last of a row begins further left.
    let last_start = |letters: usize| right - 2.0 * right_by * letters as f64;
    let start = |x: f64, letters: usize| (x + right_by).min(last_start(letters));
    // As the canvas finds it: a cell beside is none.
    let [cells, wide] = [f64::from(inside.width.max(1) - 1), right - left];
    let cell_of_start = |x: f64| ((start(x, widest) - left) * cells / wide) as usize;
    let starts: Vec<usize> = distinct_x(&turns).into_iter().map(cell_of_start).collect();
    let has_room = starts.windows(2).all(|pair| pair[0] + widest < pair[1]);
    let label = |turn: usize| match has_room {
        true => times[turn].clone(),
        false => sign(turn),
    };
    let canvas = Canvas::default()
        .background_color(theme.base().bg.unwrap_or(Color::Reset))
        .marker(Marker::Dot)
        .x_bounds([left, right])
        .y_bounds([bottom, top])
        .paint(|context| {
            context.draw(&Points { coords: &others, color: color(theme.muted()) });
            context.layer();
            context.marker(Marker::Braille);
            for &[(x1, y1), (x2, y2)] in &lines {
                context.draw(&canvas::Line { x1, y1, x2, y2, color: color(theme.title()) });
            }
            context.layer();
            for (turn, (_, holes)) in turns.iter().enumerate() {
                let label = label(turn);
                let letters = label.chars().count();
                for &(x, y) in holes {
                    context.print(
                        start(x, letters),
                        (y - down_by).max(bottom),
                        Span::styled(label.clone(), theme.title()),
                    );
                }
            }
        });
    frame.render_widget(canvas, inside);
    let cell = |[x, y]: [f64; 2]| {
        let across = (x - left) / (right - left) * f64::from(inside.width.max(1) - 1);
        let down = (top - y) / (top - bottom) * f64::from(inside.height.max(1) - 1);
        (inside.x + across.round() as u16, inside.y + down.round() as u16)
    };
    map_numbers::draw(scene, inside, around, cell, theme.muted(), frame.buffer_mut());
    let [signs, short] = match has_room {
        true => ["numbers: fired at, ms", "fired at, ms"],
        false => ["signs: 1 fires first, 2 next", "1 fires first"],
    };
    let lines = if lines.is_empty() { "" } else { " · lines: fire at once" };
    let is_grid = matches!(case.plan.layout, Layout::Grid(_));
    let [tire, cable, place] = match is_grid {
        true => {
            [" · tire 2:4: row 2, column 4", " · cable 2:4-3:4: between two tires", " · 2:4: row 2, column 4"]
        }
        false => [""; 3],
    };
    let legends = [
        format!(" {signs}{lines} · points: no hole{tire}{cable}"),
        format!(" {signs}{lines}{tire}{cable}"),
        format!(" {signs}{lines}{tire}"),
        format!(" {short}{lines}{place}"),
        format!(" {signs}{lines}"),
        format!(" {signs}"),
        format!(" {short}"),
    ];
    let fits = |legend: &String| legend.width() <= usize::from(area.width);
    let legend = Line::styled(legends.into_iter().find(fits).unwrap_or_default(), theme.muted());
    let last = Rect { y: area.bottom().saturating_sub(1), height: 1.min(area.height), ..area };
    frame.render_widget(legend, last);
    let firings = case.shots.get(app.selected).map_or(&[][..], |shot| &shot.firings);
    let place = |firing: &Firing| {
        let (x, y) = cell([scene.position[firing.tire].x, scene.position[firing.tire].y]);
        let label = Rect { x, y, width: (widest as u16).max(1), height: 1 };
        (label.intersection(inside), firing.row)
    };
    firings.iter().map(place).collect()
}

/// Number of lines of equal time between the first and the last hole.
const LINES: usize = 6;

/// A point of the map [m].
type MapPoint = (f64, f64);

/// Lines of equal firing time between neighbouring blast rows, as pairs of points; rows that fire at once have none.
fn equal_time_lines(case: &Case, option: usize) -> Vec<[MapPoint; 2]> {
    let Some(shot) = case.shots.get(option) else { return Vec::new() };
    let mut rows: Vec<Vec<(MapPoint, f64)>> = vec![Vec::new(); case.plan.blast_rows.len()];
    for firing in &shot.firings {
        let hole = case.scene().position[firing.tire];
        rows[firing.row].push(((hole.x, hole.y), firing.time));
    }
    rows.retain(|row| !row.is_empty());
    rows.iter_mut().for_each(|row| row.sort_by(|a, b| a.0.0.total_cmp(&b.0.0).then(a.0.1.total_cmp(&b.0.1))));
    rows.sort_by(|a, b| a[0].0.1.total_cmp(&b[0].0.1));
    let last = shot.firings.last().map_or(0.0, |firing| firing.time);
    let mut lines = Vec::new();
    for n in 1..=LINES {
        let level = last * n as f64 / (LINES + 1) as f64;
        let crossings: Vec<Vec<MapPoint>> = rows.iter().map(|row| points_at(row, level)).collect();
        for pair in crossings.windows(2).filter(|pair| pair[0].len() == pair[1].len()) {
            lines.extend(pair[0].iter().zip(&pair[1]).map(|(&a, &b)| [a, b]));
        }
    }
    lines
}

/// Points along a row at which the firing time is `level` [s], interpolated between its holes.
fn points_at(row: &[(MapPoint, f64)], level: f64) -> Vec<MapPoint> {
    let between = |pair: &[(MapPoint, f64)]| {
        let [(a, from), (b, to)] = [pair[0], pair[1]];
        let part = (level - from) / (to - from);
        let is_between = (from < level) != (to < level);
        is_between.then_some((a.0 + part * (b.0 - a.0), a.1 + part * (b.1 - a.1)))
    };
    row.windows(2).filter_map(between).collect()
}

/// Where holes lie along x [m], ascending; those of one column count once.
fn distinct_x(turns: &[(f64, Vec<MapPoint>)]) -> Vec<f64> {
    let mut along: Vec<f64> = turns.iter().flat_map(|(_, holes)| holes.iter().map(|(x, _)| *x)).collect();
    along.sort_by(f64::total_cmp);
    along.dedup_by(|b, a| *b - *a < 1e-3);
    along
}

/// Sign of a turn: 1 to 9, then letters, then `+`.
fn sign(turn: usize) -> String {
    char::from_digit(turn as u32 + 1, 36).unwrap_or('+').to_string()
}
