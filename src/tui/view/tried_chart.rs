//! Everything that a study tries, from its first shot to its answer: the share of a limit that each shot uses, over the varied quantity.
//! Every point drawn was computed, and no computed point is left out. Nothing is drawn between points. A point above the axis has a mark at
//! the upper edge.
//!
//! ```text
//!  share of a limit at 2248 intervals ⠒ as planned █ 1 in 100 shots above ━ worth a check
//!  138 %                           ⠠⠤⠔⠒
//!  100 % ⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣰⠊⣀⣀⣀⣀⣀
//!        ▇▇▇▆▆▅▅▅▄▄▄▄▄▄▄▄       ⠔⠁
//!        █████████████████⠒⠒⠒⠒⠒⠊        not sampled yet, or not to be: it fails as planned
//!  plan  ✗ ??△  ✓                  ✗    options of the plan at these intervals
//!    0 % 0 ms━━━━━━━━━━━━250 ms───500 ms
//! ```

use std::collections::{BTreeMap, BTreeSet};

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::style::{Modifier, Style};
use ratatui::text::{Line, Span};

use super::gauges::EIGHTHS;
use crate::tui::app::App;
use crate::tui::theme::Theme;
use crate::units;
use crate::verdict::VerdictWord;

/// Least width and height of a chart that can be read.
const LEAST_SIZE: (u16, u16) = (30, 5);
/// Least height of a chart that shows the options of the plan.
const WITH_OPTIONS: u16 = 7;
/// Width of the labels on the left.
const LABELS: u16 = 7;
/// Greatest share of a limit on the axis. Farther beyond the limit, the exact value no longer matters.
const MOST: f64 = 3.0;
/// Points are drawn large if they take fewer than 1 / `SPARSE` of the columns.
const SPARSE: usize = 4;
/// Bits of the dots of a braille character, from the lower edge to the upper edge: left and right column.
const DOTS: [[u8; 2]; 4] = [[0x40, 0x80], [0x04, 0x20], [0x02, 0x10], [0x01, 0x08]];
/// The line of the limit, at the lower edge of its row.
const LIMIT: u8 = DOTS[0][0] | DOTS[0][1];

/// Everything that a study tried.
pub struct Tried {
    /// Title, long and short.
    pub titles: [String; 2],
    /// Both ends of the horizontal axis. `labels`: of the left end, the middle and the right end.
    pub across: [f64; 2],
    pub labels: [String; 3],
    /// Width of a shot on the horizontal axis; 0 for a point.
    pub width: f64,
    /// (place, share of a limit) of each planned shot.
    pub planned: Vec<(f64, f64)>,
    /// The same of sampled shots: the share that only the accepted share of them exceeds. Infinite if too many samples are undecided or
    /// break cables.
    pub sampled: Vec<(f64, f64)>,
    /// Words for the drawn share of the sampled shots, long and short.
    pub sampled_are: [String; 2],
    /// Options of the plan.
    pub options: Vec<Marked>,
    /// Marked windows on the horizontal axis. `windows_are`: their meaning.
    pub windows: Vec<[f64; 2]>,
    pub windows_are: &'static str,
}

/// A delay option of the plan in a chart.
#[derive(Clone, Copy)]
pub struct Marked {
    /// Its place on the horizontal axis.
    pub at: f64,
    /// Share of a limit that only the accepted share of its shots exceeds, if known.
    pub share: Option<f64>,
    /// Its verdict. `mark` and `style`: the sign of the verdict as on all screens.
    pub word: VerdictWord,
    pub mark: &'static str,
    pub style: Style,
}

/// Draws the chart. Draws nothing if the area is too small.
pub fn draw(app: &App, tried: &Tried, frame: &mut Frame, area: Rect) {
    if area.width < LEAST_SIZE.0 || area.height < LEAST_SIZE.1 {
        return;
    }
    let theme = app.theme;
    let has_options = !tried.options.is_empty() && area.height >= WITH_OPTIONS;
    let one = Constraint::Length(1);
    let rows = [one, Constraint::Min(0), Constraint::Length(has_options.into()), one];
    let [title, body, options, axis] = Layout::vertical(rows).areas(area);
    frame.render_widget(titled(tried, theme, title.width.into()), title);
    let [left, body] = Layout::horizontal([Constraint::Length(LABELS), Constraint::Min(0)]).areas(body);
    if has_options {
        frame.render_widget(Line::styled(" plan", theme.muted()), options);
        draw_options(tried, frame, Rect { x: body.x, width: body.width, ..options });
    }
    let shares = tried.planned.iter().chain(&tried.sampled).map(|(_, share)| *share);
    let greatest = shares.fold(0.0, f64::max);
    // The limit lies between two rows.
    let below = (f64::from(body.height) / greatest.clamp(1.0, MOST)) as u16;
    let below = below.clamp(1, body.height - 1);
    let raster = Raster::of(tried, body, below);
    for row in 0..body.height {
        let line = Line::from_iter((0..body.width).map(|column| raster.cell(theme, column, row)));
        frame.render_widget(line, Rect { y: body.bottom() - 1 - row, height: 1, ..body });
    }
    let row_of = |share: f64| ((share * f64::from(below)) as u16).min(body.height - 1);
    let percent = |share: f64| format!("{:.0} %", units::whole_percent(share));
    let top = Some((row_of(greatest), percent(greatest.min(MOST)), theme.limit()));
    let top = top.filter(|(row, ..)| *row > below);
    let of_limit = (below, percent(1.0), theme.limit_line());
    for (row, text, style) in [of_limit].into_iter().chain(top) {
        let label = Line::styled(format!("{text} "), style).right_aligned();
        frame.render_widget(label, Rect { y: body.bottom() - 1 - row, height: 1, ..left });
    }
    frame.render_widget(Line::styled("0 % ", theme.muted()).right_aligned(), Rect { width: LABELS, ..axis });
    draw_axis(tried, theme, frame, Rect { x: body.x, width: body.width, ..axis });
}

/// The title with the meaning of the signs. The longest wording that fits.
fn titled(tried: &Tried, theme: Theme, width: usize) -> Line<'static> {
    let point = if tried.is_sparse(width) { "•" } else { "⠒" };
    let line = |title: &String, shots: &str| {
        let entries = [
            (!tried.planned.is_empty(), point, theme.title(), "as planned"),
            (!tried.sampled.is_empty(), "█", theme.shots(), shots),
            (!tried.windows.is_empty(), "━", theme.curve(), tried.windows_are),
        ];
        let mut line = Line::styled(format!(" {title}"), theme.muted());
        for (_, sign, style, words) in entries.into_iter().filter(|(is_drawn, ..)| *is_drawn) {
            line.push_span(Span::styled(format!("  {sign} "), style));
            line.push_span(Span::styled(words.to_owned(), theme.muted()));
        }
        line
    };
    let [long, short] = tried.titles.each_ref();
    let [shots, fewer] = &tried.sampled_are;
    let texts = [(long, shots), (short, shots), (short, fewer)];
    let [first, others @ ..] = texts.map(|(title, shots)| line(title, shots));
    others.into_iter().fold(first, |line, shorter| if line.width() <= width { line } else { shorter })
}

/// Draws the verdict signs of the options at their places.
fn draw_options(tried: &Tried, frame: &mut Frame, area: Rect) {
    for (column, worst) in tried.worst_options(area.width) {
        let place = Rect { x: area.x + column, width: 1, ..area };
        frame.render_widget(Span::styled(worst.mark, worst.style), place);
    }
}

/// Draws the horizontal axis with its windows and labels.
fn draw_axis(tried: &Tried, theme: Theme, frame: &mut Frame, area: Rect) {
    let [from, to] = tried.across;
    let worst = tried.worst_options(area.width);
    let share = |column: u16| from + (to - from) * f64::from(column) / f64::from(area.width);
    // A column is marked only if it lies in a window entirely and no option in it fails, so the marks hide no gap.
    let is_marked = |column: u16| {
        let [start, end] = [share(column), share(column + 1)];
        tried.windows.iter().any(|[from, to]| *from <= start && end <= *to)
            && worst.get(&column).is_none_or(|worst| worst.word != VerdictWord::Fail)
    };
    let sign = |column: u16| match is_marked(column) {
        true => Span::styled("━", theme.curve()),
        false => Span::styled("─", theme.muted()),
    };
    frame.render_widget(Line::from_iter((0..area.width).map(sign)), area);
    let [first, middle, last] = &tried.labels;
    let width = |text: &String| text.chars().count() as u16;
    let places =
        [0, (area.width - width(middle).min(area.width)) / 2, area.width.saturating_sub(width(last))];
    for (x, text) in places.into_iter().zip([first, middle, last]) {
        let place = Rect { x: area.x + x, width: width(text), ..area }.intersection(area);
        frame.render_widget(Line::styled(text.clone(), theme.muted()), place);
    }
}

impl Tried {
    /// Whether the points are so few that each is drawn large.
    fn is_sparse(&self, width: usize) -> bool {
        let columns: BTreeSet<usize> =
            self.planned.iter().map(|(place, _)| self.columns(*place, width).start).collect();
        self.width == 0.0 && columns.len() * SPARSE < width
    }

    /// The options by their column, of `count` columns. If two share a column, the worse one.
    fn worst_options(&self, count: u16) -> BTreeMap<u16, Marked> {
        let mut worst = BTreeMap::new();
        for &option in &self.options {
            let column = self.columns(option.at, count.into()).start as u16;
            let shown = worst.entry(column).or_insert(option);
            if option.word > shown.word {
                *shown = option;
            }
        }
        worst
    }

    /// The columns, of `count`, that a shot at `place` takes.
    fn columns(&self, place: f64, count: usize) -> std::ops::Range<usize> {
        let [from, to] = self.across;
        let column = |at: f64| ((at - from) / (to - from) * count as f64).clamp(0.0, count as f64) as usize;
        let first = column(place - 0.5 * self.width).min(count - 1);
        first..column(place + 0.5 * self.width).clamp(first + 1, count)
    }
}

/// A chart as cells. Row 0 is at the lower edge.
struct Raster {
    /// Rows below the limit.
    below: u16,
    /// Number of all rows.
    rows: u16,
    is_sparse: bool,
    /// Filled share of the limit in each column.
    filled: Vec<f64>,
    /// Bits of the dots in each cell (rows × columns).
    dots: Vec<Vec<u8>>,
    /// Whether a point lies above the upper edge, for each column.
    beyond: Vec<bool>,
}

impl Raster {
    fn of(tried: &Tried, area: Rect, below: u16) -> Self {
        let [width, rows] = [area.width, area.height].map(usize::from);
        let mut raster = Self {
            below,
            rows: area.height,
            is_sparse: tried.is_sparse(width),
            filled: vec![0.0; width],
            dots: vec![vec![0; width]; rows],
            beyond: vec![false; width],
        };
        let top = f64::from(area.height) / f64::from(below);
        for &(place, share) in &tried.sampled {
            for column in tried.columns(place, width) {
                raster.filled[column] = share.max(raster.filled[column]);
                raster.beyond[column] |= share > top;
            }
        }
        let limit = DOTS.len() * usize::from(below);
        for &(place, share) in &tried.planned {
            let dot = (share * limit as f64) as usize;
            // A share within the limit lies below its line, and a share over the limit above it, however near it is.
            let dot = if share > 1.0 { dot.max(limit) } else { dot.min(limit - 1) };
            for across in tried.columns(place, 2 * width) {
                match raster.dots.get_mut(dot / DOTS.len()) {
                    Some(row) => row[across / 2] |= DOTS[dot % DOTS.len()][across % 2],
                    None => raster.beyond[across / 2] = true,
                }
            }
        }
        raster
    }

    fn cell(&self, theme: Theme, column: u16, row: u16) -> Span<'static> {
        let (n, below) = (usize::from(column), f64::from(self.below));
        if row + 1 == self.rows && self.beyond[n] {
            return Span::styled("▲", theme.limit());
        }
        let full = (EIGHTHS.len() - 1) as f64;
        let share = self.filled[n];
        // A value above 0 is always visible, and so is a value over the limit.
        let is_least = row == 0 && share > 0.0 || row == self.below && share > 1.0;
        let eighths = ((share * below - f64::from(row)) * full).clamp(if is_least { 1.0 } else { 0.0 }, full);
        let dots = self.dots[usize::from(row)][n];
        let middle = (f64::from(row) + 0.5) / below;
        let (past, warm) = match row >= self.below {
            true => (theme.limit(), theme.limit()),
            false => (theme.title(), theme.heat(theme.shots(), middle)),
        };
        let line = if row == self.below { LIMIT } else { 0 };
        // If the bar reaches the dots of a row, the bar hides them: dots would make the bar look lower.
        let lowest = DOTS.iter().position(|pair| dots & (pair[0] | pair[1]) != 0).unwrap_or(0);
        let is_in_bar = eighths >= 1.0 && eighths * DOTS.len() as f64 >= full * lowest as f64;
        match dots {
            0 if eighths < 1.0 && line == 0 => Span::raw(" "),
            0 if eighths < 1.0 => Span::styled(braille(line), theme.limit_line()),
            0 => Span::styled(EIGHTHS[eighths as usize], warm),
            _ if is_in_bar && eighths < full => Span::styled(EIGHTHS[eighths as usize], warm),
            _ if self.is_sparse => Span::styled("•", past),
            // On a filled cell the points are gaps.
            dots if eighths == full => Span::styled(braille(dots), warm.add_modifier(Modifier::REVERSED)),
            dots => Span::styled(braille(dots | line), past),
        }
    }
}

fn braille(dots: u8) -> String {
    char::from_u32(0x2800 + u32::from(dots)).map_or_else(String::new, String::from)
}

#[cfg(test)]
mod tests {
    use ratatui::Terminal;
    use ratatui::backend::TestBackend;

    use super::*;
    use crate::tui::theme;

    fn tried(planned: Vec<(f64, f64)>, sampled: Vec<(f64, f64)>) -> Tried {
        Tried {
            titles: Default::default(),
            across: [0.0, 4.0],
            labels: Default::default(),
            width: 0.0,
            planned,
            sampled,
            sampled_are: Default::default(),
            options: Vec::new(),
            windows: Vec::new(),
            windows_are: "",
        }
    }

    fn drawn(planned: Vec<(f64, f64)>, sampled: Vec<(f64, f64)>, rows: u16, below: u16) -> Vec<String> {
        let tried = tried(planned, sampled);
        let raster = Raster::of(&tried, Rect::new(0, 0, 4, rows), below);
        let row = |row| (0..4).map(|column| raster.cell(Theme::Dark, column, row).content).collect();
        (0..rows).rev().map(row).collect()
    }

    /// Points at every half cell, from a tenth of the limit to five times the limit.
    #[test]
    fn every_point_is_drawn_on_its_side_of_the_limit() {
        let dense = |shares: [f64; 8]| (0..8).map(|n| (0.5 * n as f64, shares[n])).collect();
        let rows = drawn(dense([0.5, 0.5, 0.99, 1.0, 1.0001, 1.2, 5.0, 0.1]), Vec::new(), 3, 2);
        assert_eq!(rows, ["⣀⣀⣠▲", "⣀⠉  ", "   ⢀"].map(|row: &str| row.to_owned()));
    }

    /// Two options share a column, and one of them fails. Another option fails at the end of the axis.
    #[test]
    fn of_options_in_a_column_the_worse_one_is_marked() {
        let (pass, fail) = (VerdictWord::Pass, VerdictWord::Fail);
        let option =
            |at: f64, word| Marked { at, share: None, word, mark: theme::mark(word), style: Style::new() };
        let options = vec![option(0.1, fail), option(0.0, pass), option(2.0, pass), option(4.0, fail)];
        let tried = Tried { options, ..tried(Vec::new(), Vec::new()) };
        let mut terminal = Terminal::new(TestBackend::new(4, 1)).expect("a screen of memory");
        let draw = |frame: &mut Frame| draw_options(&tried, frame, frame.area());
        terminal.draw(draw).expect("it draws");
        let drawn = |terminal: &Terminal<TestBackend>| -> String {
            terminal.backend().buffer().content().iter().map(|cell| cell.symbol()).collect()
        };
        assert_eq!(drawn(&terminal), "✗ ✓✗");
        let tried = Tried { windows: vec![[0.0, 4.0]], ..tried };
        let draw = |frame: &mut Frame| draw_axis(&tried, Theme::Dark, frame, frame.area());
        terminal.draw(draw).expect("it draws");
        assert_eq!(drawn(&terminal), "─━━─", "no window where an option fails");
    }

    /// Bars of 70 % with planned shots at 55, 90 and 30 %, in rows of half the limit.
    #[test]
    fn no_dot_hides_how_far_a_bar_reaches() {
        let rows =
            drawn(vec![(0.0, 0.55), (1.0, 0.9), (2.0, 0.3)], vec![(0.0, 0.7), (1.0, 0.7), (2.0, 0.7)], 3, 2);
        assert_eq!(rows[1], "▃⠁▃ ", "{rows:?}");
    }

    #[test]
    fn what_goes_past_the_limit_is_seen_and_what_keeps_it_is_below() {
        let rows = drawn(Vec::new(), vec![(0.0, 1.0), (1.0, 1.001), (2.0, 0.5), (3.0, 9.0)], 3, 2);
        assert_eq!(rows, ["⣀▁⣀▲", "██ █", "████"].map(|row: &str| row.to_owned()));
    }
}
