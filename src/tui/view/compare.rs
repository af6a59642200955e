//! The table of delay options: a row for each option, as many columns as fit.
//!
//! ```text
//!                     shots fail  height, limit 2.35 m  force, limit 84.0 kN
//!  option             none 1% all ▆ 1 in 100 shots above • planned ┃ limit
//! ▸42 ms       ✓ PASS ━━━━━┊      ▃▅▅▅▅▃▁ ▆▆▆▆▆•▆▆▆┃    ▅▄▃▃▂▁▁ ▆▆▆▆▆•▆▆ ┃
//! ```

use itertools::Itertools;
use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::style::Style;
use ratatui::text::{Line, Span, Text};
use ratatui::widgets::{Row as Cells, Table, TableState};
use unicode_width::UnicodeWidthStr;

use super::columns::{COLUMNS, CompareColumn, SHARE};
use super::fitting::option_name;
use super::widgets::{bar, highlight};
use super::{gauges, signs};
pub(super) use crate::report::text::cut_name as cut;
use crate::report::words::warnings::turned_over_limit;
use crate::study::judge::Judgement;
use crate::tui::app::{App, Areas, ClickTarget};
use crate::tui::compare::{OptionState, SortBy};
use crate::tui::plan_side::PlanOption;
use crate::tui::screen::Screen;
use crate::tui::theme;
use crate::units::{self, Unit};
use crate::verdict::{Quantity, Verdict, VerdictWord};

/// Width of a verdict: sign alone; sign and word; sign, word and [`theme::PROVISO`].
const VERDICT: [u16; 3] = [1, 6, 7];
/// Least, usual and greatest width of an option's name with its marks.
const NAME: [u16; 3] = [8, 12, 26];
/// Least, usual and greatest width of the gauge of risk.
const RISK: [u16; 3] = [6, 11, 16];
/// Least, usual and greatest width of a sparkline.
const SPARK: [u16; 3] = [7, 16, 40];
/// Number of columns of digits that get room before the sparklines grow.
const FIRST_COLUMNS: usize = 3;
/// Least and greatest width of a gauge of a limit.
const GAUGE: [u16; 2] = [7, 13];

/// Widths of the graphics of a row: name, verdict, gauge of risk, sparkline and gauge of a limit. 0 leaves a part out.
#[derive(Clone, Copy)]
struct Graphics {
    name: u16,
    verdict: u16,
    risk: u16,
    spark: u16,
    gauge: u16,
}

impl Graphics {
    /// The graphics and the columns of digits for a table of this width. Graphics come first, then digits. The sparklines take the
    /// remaining width.
    fn for_width(width: u16, longest_name: u16, verdict: u16) -> (Self, Vec<&'static CompareColumn>) {
        let mut graphics = Self { name: NAME[0], verdict, risk: RISK[0], spark: SPARK[0], gauge: GAUGE[0] };
        if width < graphics.width() {
            // Only verdict and sparklines fit beside the values of the plan.
            graphics = Self { risk: 0, gauge: 0, ..graphics };
            if width < graphics.width() {
                graphics.verdict = VERDICT[0];
            }
            graphics.name += width.saturating_sub(graphics.width());
            return (graphics, Vec::new());
        }
        let mut room = width.saturating_sub(graphics.width());
        let mut grow = |size: &mut u16, most: u16, times: u16| {
            let more = (room / times).min(most.saturating_sub(*size));
            *size += more;
            room -= times * more;
        };
        // Marks of the selected row and of the baseline stand before the name.
        let longest_name = (longest_name + 2).clamp(NAME[0], NAME[2]);
        grow(&mut graphics.name, longest_name.min(NAME[1]), 1);
        grow(&mut graphics.risk, RISK[1], 1);
        grow(&mut graphics.gauge, GAUGE[1], 2);
        grow(&mut graphics.name, longest_name, 1);
        grow(&mut graphics.risk, RISK[2], 1);
        let mut columns = Vec::new();
        let (first, others) = COLUMNS.split_at(FIRST_COLUMNS);
        // The first columns come before longer sparklines. The other columns come after; the sparklines then take the rest.
        for (digits, spark) in [(first, SPARK[1]), (others, SPARK[2])] {
            for column in digits {
                if column.width < room {
                    room -= column.width + 1;
                    columns.push(column);
                }
            }
            let more = (room / 2).min(spark - graphics.spark);
            graphics.spark += more;
            room -= 2 * more;
        }
        (graphics, columns)
    }

    /// Widths of the columns.
    fn widths(&self) -> [u16; 7] {
        let Self { name, verdict, risk, spark, gauge } = *self;
        [name, verdict, risk, spark, gauge, spark, gauge]
    }

    /// Width of all columns, with one space between two columns.
    fn width(&self) -> u16 {
        let columns = self.widths();
        let count = columns.iter().filter(|width| **width > 0).count() as u16;
        columns.iter().sum::<u16>() + count.saturating_sub(1)
    }
}

/// The two lines above a column, or above a sparkline with its gauge. A click on them sorts.
struct Head {
    lines: [String; 2],
    sort: SortBy,
    width: u16,
    has_digits: bool,
}

/// The heads of all columns: the name of the quantity, and its scale or limit.
fn heads(app: &App, graphics: Graphics, columns: &[&CompareColumn]) -> Vec<Head> {
    let head = |top: &str, bottom: String, sort, width| Head {
        lines: [top.to_owned(), bottom],
        sort,
        width,
        has_digits: false,
    };
    let (limits, Graphics { name, verdict, risk, spark, gauge }) = (&app.case.limits, graphics);
    let accepts_alike = app.plans().iter().all(|app| app.case.limits.accepted_risk == limits.accepted_risk);
    let in_time = if gauge > 0 { spark + 1 + gauge } else { spark };
    // One cell stays free for the sort mark.
    let fitting = |texts: Vec<String>| {
        let mut fit = texts.into_iter().filter(|text| text.chars().count() < usize::from(in_time.max(1)));
        fit.next().unwrap_or_default()
    };
    let against_limit = |name: &str, quantity: Quantity, unit: Unit| {
        let plans = app.plans().into_iter();
        let digits: Vec<String> = plans
            .filter_map(|app| Some(units::significant(app.case.limits.get(quantity)?, unit, 3)))
            .unique()
            .collect();
        let [whole, short] = match &digits[..] {
            [digits] => ["limit ", ""].map(|limit| format!("{limit}{digits} {}", unit.symbol())),
            // Each row is drawn against the limit of its own plan.
            _ => ["own limit", "own"].map(str::to_owned),
        };
        // The limit is for the center of a tire. The edge of a tire is higher.
        let whose = (quantity == Quantity::Height).then(|| format!("{name} of centres, {whole}"));
        let texts = [format!("{name}, {whole}"), format!("{name} {short}"), name.to_owned()];
        fitting(whose.into_iter().chain(texts).collect())
    };
    let height = against_limit("height", Quantity::Height, Unit::Metre);
    let force = against_limit("force", Quantity::Force, Unit::Kilonewton);
    let scale = match accepts_alike {
        true => gauges::risk_scale(limits.accepted_risk, risk.into()),
        false => "own risk".chars().take(risk.into()).collect(),
    };
    // Before the verdict, the cell of an option shows its sampled shots.
    let is_trying = verdict > VERDICT[0] && app.plans().iter().any(|app| app.sampling());
    let tried = if is_trying {
        "trying"
    } else if verdict > VERDICT[0] {
        "result"
    } else {
        ""
    };
    let fails = ["shots that fail", "shots fail"].into_iter().find(|words| words.len() < risk.into());
    let fails = fails.unwrap_or("fails");
    let mut heads = vec![
        head("", " option".to_owned(), SortBy::Name, name),
        head("", tried.to_owned(), SortBy::Verdict, verdict),
        head(fails, scale, SortBy::Risk, risk),
        head(&height, String::new(), SortBy::Height, in_time),
        head(&force, String::new(), SortBy::Force, in_time),
    ];
    heads.extend(columns.iter().map(|column| Head {
        lines: column.head.map(str::to_owned),
        sort: column.sort,
        width: column.width,
        has_digits: true,
    }));
    // Several columns may sort by the same quantity. Only the first gets the mark.
    if let Some(first) = heads.iter_mut().find(|head| head.sort == app.listing.sort) {
        let line = usize::from(first.lines[0].is_empty());
        first.lines[line] += if app.listing.reversed { "▼" } else { "▲" };
    }
    heads
}

/// Lines above the rows.
pub const HEAD_LINES: u16 = 2;

/// Draws the table.
pub fn draw(app: &App, frame: &mut Frame, area: Rect, areas: &mut Areas) {
    // The last column of the screen stays free: text that ends there looks cut off.
    let area = Rect { width: area.width.saturating_sub(1), ..area };
    let names = app.plans().into_iter().flat_map(|app| &app.case.plan.delays);
    let longest = names.map(|delay| app.letter().len() + delay.name.chars().count()).max().unwrap_or(0);
    let is_starred = |app: &App| (0..app.options.len()).any(|option| has_proviso(app, option));
    let is_starred = app.plans().into_iter().any(is_starred);
    let verdict = VERDICT[1 + usize::from(is_starred)];
    let (graphics, columns) = Graphics::for_width(area.width, longest as u16, verdict);
    let heads = heads(app, graphics, &columns);
    let listed = app.listed_options();
    let rows = listed.iter().filter_map(|&at| {
        Some(row(
            app.of_side(at.side)?,
            at == app.selected_option(),
            at,
            app.letter().is_empty(),
            &columns,
            graphics,
        ))
    });
    let widths = graphics.widths().into_iter().chain(columns.iter().map(|column| column.width));
    let widths = widths.filter(|width| *width > 0).map(Constraint::Length);
    let selected = listed.iter().position(|&at| at == app.selected_option());
    let mut state = TableState::new().with_selected(selected);
    let [above, table] = Layout::vertical([Constraint::Length(HEAD_LINES), Constraint::Min(0)]).areas(area);
    frame.render_stateful_widget(Table::new(rows, widths), table, &mut state);
    let (mut x, mut both) = (area.x, Rect::ZERO);
    for Head { lines, sort, width, has_digits } in heads.into_iter().filter(|head| head.width > 0) {
        let head = Rect { x, width, ..above }.intersection(above);
        let [top, bottom] = lines;
        // The first head line, quantity and limit, is read before the meaning of the signs.
        let top_style = if has_digits { app.theme.muted() } else { app.theme.base() };
        let text = Text::from_iter([Line::styled(top, top_style), Line::styled(bottom, app.theme.muted())]);
        frame.render_widget(if has_digits { text.right_aligned() } else { text }, head);
        areas.push((head, ClickTarget::Sort(sort)));
        if sort == SortBy::Height && !has_digits {
            both = Rect { y: head.y + 1, width: 2 * width + 1, height: 1, ..head }.intersection(above);
        }
        x += width + 1;
    }
    // One explanation of the signs stands above both groups.
    frame.render_widget(signs::line(app, both.width.into()), both);
    let room = usize::from(area.height.saturating_sub(HEAD_LINES));
    let shown = listed.iter().skip(state.offset()).take(room);
    for (y, &at) in (area.y + HEAD_LINES..).zip(shown) {
        let row = Rect { y, height: 1, ..area };
        if at == app.selected_option() {
            highlight(app, row, frame);
        }
        areas.push((row, ClickTarget::Option(at)));
    }
    let (above, below) = (state.offset(), listed.len().saturating_sub(state.offset() + room));
    let cue = match (above, below) {
        (0, 0) => String::new(),
        (0, below) => format!(" {below} more ↓"),
        (above, 0) => format!(" {above} more ↑"),
        (above, below) => format!(" {above} ↑ {below} ↓"),
    };
    let short = if above > 0 { " ↑" } else { " ↓" };
    let cue = match cue.chars().count() > usize::from(graphics.name) {
        true => format!(" {}{short}", above + below),
        false => cue,
    };
    let line = Rect { width: graphics.name, height: 1, ..area }.intersection(area);
    frame.render_widget(Line::styled(cue, app.theme.title()), line);
    if listed.is_empty() && area.height > HEAD_LINES {
        let none = format!("no option has '{}' in its name or verdict; Esc shows all", app.listing.filter);
        let line = Rect { y: area.y + HEAD_LINES, height: 1, ..area };
        frame.render_widget(Line::styled(none, app.theme.muted()), line);
    }
}

/// The row of an option of `app`. If two plans are shown, the row begins with the letter of the plan.
fn row<'r>(
    app: &'r App,
    is_selected: bool,
    PlanOption { side, option }: PlanOption,
    is_alone: bool,
    columns: &[&CompareColumn],
    graphics: Graphics,
) -> Cells<'r> {
    let (mark, style) = match is_selected {
        true => ("▸", app.theme.selected()),
        false => (" ", app.theme.base()),
    };
    let baseline = if app.listing.baseline == Some(option) { "=" } else { "" };
    let letter = if is_alone { String::new() } else { format!("{} ", side.letter()) };
    let name = usize::from(graphics.name).saturating_sub(1 + letter.len());
    let label = format!("{baseline}{}", option_name(app, option, name.saturating_sub(baseline.len())));
    let mut cells = vec![Line::styled(format!("{mark}{letter}{label:name$}"), style)];
    match &app.options[option] {
        OptionState::Judged { judgement, .. } => {
            let (words, style) = verdict_words(app, option);
            let grounds = judgement.grounds();
            let tried = match () {
                () if grounds.awaits_one_dud() || grounds.awaits_confirmation() => "more".to_owned(),
                () => judgement.sampled.known().map_or(0, |sampled| sampled.samples.len()).to_string(),
            };
            cells.push(match words {
                TRYING if graphics.verdict == VERDICT[0] => {
                    Line::styled(turning(app.beat + option), app.theme.title())
                }
                TRYING => Line::from(vec![
                    Span::styled(turning(app.beat + option), app.theme.title()),
                    Span::styled(format!("{tried:>5}"), style),
                ]),
                _ => Line::styled(words, style),
            });
            // If a column shows the share in digits, the gauge does not.
            let has_share = !columns.iter().any(|column| column.head[1] == SHARE);
            cells.extend(graphics_of(app, option, judgement, graphics, has_share));
            // A number without its first digits would be another number.
            let fitting = |column: &CompareColumn, text: String| {
                if text.width() > usize::from(column.width) { "…".to_owned() } else { text }
            };
            let cell = |column: &&CompareColumn| {
                Line::from(fitting(column, (column.cell)(app, option, judgement))).right_aligned()
            };
            cells.extend(columns.iter().map(cell));
        }
        // The detail below the table says why.
        OptionState::Failed(_) => {
            let (words, style) = verdict_words(app, option);
            cells.push(Line::styled(words, style));
            cells.push(Line::from("none"));
        }
        OptionState::Waiting | OptionState::Running { .. } if graphics.verdict == VERDICT[0] => {
            cells.push(Line::styled(turning(app.beat + option), app.theme.muted()));
        }
        OptionState::Waiting => cells.push(Line::styled("waits", app.theme.muted())),
        OptionState::Running { runs, done } => {
            let percent = Span::styled(format!("{:>3.0} %", done * 100.0), app.theme.muted());
            cells
                .push(Line::from(vec![Span::styled(turning(app.beat + option), app.theme.title()), percent]));
            cells.push(Line::styled(bar(*done, graphics.risk.into()), app.theme.muted()));
            cells.push(Line::styled(format!("run {}", runs + 1), app.theme.muted()));
        }
    }
    if app.is_held() {
        // Dim everything except name and verdict: these are numbers of a plan on hold.
        let dim = |span: &mut Span<'_>| span.style = span.style.patch(app.theme.faint());
        cells.iter_mut().skip(2).flat_map(|cell| &mut cell.spans).for_each(dim);
    }
    let is_left_out = graphics.widths().map(|width| width == 0);
    let drawn = cells.into_iter().enumerate().filter(|(n, _)| is_left_out.get(*n) != Some(&true));
    Cells::new(drawn.map(|(_, cell)| cell))
}

/// The gauge of risk, and for height and force the shot over time and the gauge of the limit.
fn graphics_of(
    app: &App,
    option: usize,
    judged: &Judgement,
    graphics: Graphics,
    has_share: bool,
) -> Vec<Line<'static>> {
    let (theme, limits) = (app.theme, &app.case.limits);
    let sampled = judged.sampled.known();
    let is_final = !app.options[option].is_sampling();
    let bar = match sampled.filter(|_| is_final) {
        // An option that fresh draws or a dud keep open has no pass color, whatever its samples say. A thin pass has none either.
        Some(sampled) => match sampled.verdict().max(app.verdict(option).min(Verdict::Undecided)) {
            // While it is not known whether a pass is thin, it may be thin.
            Verdict::Pass if app.stands_on_so_far(option).is_none() => theme.muted(),
            Verdict::Pass => theme.verdict(app.word(option)),
            verdict => theme.verdict(verdict),
        },
        None => theme.muted(),
    };
    let interval = sampled.map(|sampled| sampled.bounds.interval);
    let mut cells =
        vec![gauges::risk(interval, limits.accepted_risk, graphics.risk.into(), [bar, theme.muted()])];
    let widths = [graphics.spark, graphics.gauge].map(usize::from);
    cells.extend(use_of_limits(app, option, judged, widths, has_share).into_iter().flatten());
    cells
}

/// For height and for force: the shot over time in `spark` cells, and the use of the limit in `gauge` cells, with a number if `has_share`.
pub(super) fn use_of_limits(
    app: &App,
    option: usize,
    judged: &Judgement,
    [spark, gauge]: [usize; 2],
    has_share: bool,
) -> [[Line<'static>; 2]; 2] {
    let (theme, limits, calm) = (app.theme, &app.case.limits, curve(app, option));
    let is_deciding = app.rows_are_deciding();
    let histories = match is_deciding {
        true => app.deciding(option).map(|deciding| [&deciding.height.history, &deciding.force.history]),
        false => Some([&judged.checked.history; 2]),
    };
    let series = histories.map(|[height, force]| [&height.height, &force.force]);
    [(Quantity::Height, limits.height), (Quantity::Force, limits.force)].map(|(quantity, limit)| {
        let in_time = match series {
            Some([height, force]) => {
                let values = if quantity == Quantity::Height { height } else { force };
                gauges::over_time(theme, values, limit, spark, calm, !is_deciding)
            }
            // The planned shot, often milder, would make this option look better than the options that show deciding shots.
            None => {
                let words = if app.sampling() { "…" } else { "not run" };
                Line::styled(format!("{words:spark$}"), theme.muted())
            }
        };
        let planned = Some(judged.checked.get(quantity).value / limit);
        let used = judged.used_of_limit(quantity, limits);
        [in_time, gauges::use_of_limit(theme, planned, used, gauge, calm, has_share)]
    })
}

/// The color of an option's shots. It is no verdict color, because only the distance to the limit shall be visible.
pub(super) fn curve(app: &App, option: usize) -> Style {
    if app.options[option].is_sampling() { app.theme.muted() } else { app.theme.shots() }
}

/// Text instead of the verdict on a pass while it is not known whether the pass is thin.
const NOT_FINAL: &str = "… wait";

/// Whether a pass of an option has a proviso that a badge states: no limit judges the slide, or the pass holds only if the tires do not
/// turn.
fn has_proviso(app: &App, option: usize) -> bool {
    let turns = || app.judgement(option).and_then(|judged| turned_over_limit(&app.case, judged)).is_some();
    app.case.limits.drift.is_none() || turns()
}

/// Whether the table shows PASS or THIN for an option, followed by the sign of a proviso.
fn is_starred_pass(app: &App, option: usize) -> bool {
    let passes = match app.word(option) {
        VerdictWord::Thin => true,
        // While it is not known whether the pass is thin, the table shows no PASS.
        VerdictWord::Pass => app.stands_on_so_far(option).is_some(),
        _ => false,
    };
    passes && has_proviso(app, option)
}

/// Whether any option of the plan has a pass with the sign of a proviso.
pub(super) fn has_starred_pass(app: &App) -> bool {
    (0..app.options.len()).any(|option| is_starred_pass(app, option))
}

/// Text instead of the verdict while the user types the interval of the option.
const TYPED: &str = "type ms";

/// Text instead of the verdict while more shots of an option are sampled and it has not failed.
pub(super) const TRYING: &str = "trying";

/// A mark that turns while something computes.
pub(super) fn turning(beat: usize) -> &'static str {
    TURNING[beat % TURNING.len()]
}

const TURNING: [&str; 8] = ["⠇", "⠋", "⠙", "⠸", "⢰", "⣠", "⣄", "⡆"];

/// Verdict on an option with its sign and style, the same on every screen. A pass that does not stand shows no PASS.
pub(super) fn verdict_words(app: &App, option: usize) -> (&'static str, Style) {
    let state = &app.options[option];
    let is_open_so_far = state.is_sampling() && state.verdict() == Verdict::Undecided;
    // While the user types the interval of a copy, the copy is no option yet, although it fires like the copied option.
    let is_typed = app.screen == Screen::Compare && app.editor.entry.is_some() && option == app.selected;
    match app.word(option) {
        _ if is_typed => (TYPED, app.theme.caution()),
        _ if state.is_computing() || is_open_so_far => (TRYING, app.theme.muted()),
        // While it is not known whether a pass is thin, it may be thin.
        VerdictWord::Pass if app.stands_on_so_far(option).is_none() => (NOT_FINAL, app.theme.muted()),
        word => {
            let words = if has_proviso(app, option) { theme::starred(word) } else { theme::label(word) };
            (words, app.theme.verdict(word))
        }
    }
}
