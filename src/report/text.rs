//! The face for pipes and plain terminals: a report as lines of text. Widths, colours and ASCII live here.

use unicode_width::UnicodeWidthStr;

use super::ascii::to_ascii;
use super::palette::Role;
use super::parts::{Align, Audience, Block, Cell, Chart, Report, Row, Scale, SeriesKind, Table};
use super::spark::sparkline;
use crate::units;
use crate::verdict::{Verdict, VerdictWord};

/// Options for the look of text.
#[derive(Clone, Copy, Debug, Default)]
pub struct Style {
    /// Whether only ASCII is written.
    pub ascii: bool,
    /// Whether colours are written. The words say the same without them.
    pub color: bool,
    /// Whether charts and sparklines are left out.
    pub plain: bool,
    /// Width of the terminal [columns], where there is one. Longer sentences are wrapped.
    pub width: Option<usize>,
}

/// Width of tables without a terminal [columns].
const USUAL_WIDTH: usize = 80;
/// Least and greatest number of bars of a series in a table.
const BARS: [usize; 2] = [9, 16];
/// Least width to which a name is cut [columns].
const SHORTEST_NAME: usize = 8;
/// Number of bars of a chart.
const CHART_BARS: usize = 60;
/// Columns and lines of a chart with logarithmic axes.
const PLOT: (usize, usize) = (64, 14);
/// Number of rows shown at each end of a ranking.
const RANKED: usize = 8;

/// A report as text.
pub fn text(report: &Report, style: Style) -> String {
    let mut paragraphs: Vec<Vec<String>> = vec![Vec::new()];
    paragraphs[0].extend(Some(report.title.clone()).filter(|title| !title.is_empty()));
    paragraphs[0].extend(report.facts.iter().cloned());
    let mut after_chart = false;
    for block in &report.blocks {
        let lines = match block {
            Block::Text(lines) => lines.clone(),
            Block::Table(table) => table_lines(table, style),
            Block::Chart(chart) if !style.plain => chart_lines(chart),
            Block::Chart(_) | Block::Picture(_) | Block::Facts(_) => continue,
        };
        match paragraphs.last_mut() {
            // Charts share a paragraph: bars above each other can be compared.
            Some(last) if after_chart && matches!(block, Block::Chart(_)) => last.extend(lines),
            _ => paragraphs.push(lines),
        }
        after_chart = matches!(block, Block::Chart(_));
    }
    paragraphs.push(report.warnings.iter().map(|warning| format!("warning: {warning}")).collect());
    if let Some(conclusion) = &report.conclusion {
        let label = colored(conclusion.word, conclusion.label(), style);
        let verdict = format!("{label}{}: {}", conclusion.unchecked, conclusion.text);
        paragraphs.push(match &report.answer {
            None => vec![verdict],
            Some(answer) => {
                let both = format!("{answer} · {verdict}");
                // Where one line has no room for both, the answer is the last line.
                let has_room = style.width.is_none_or(|width| seen_width(&both) <= width);
                if has_room { vec![both] } else { vec![verdict, answer.clone()] }
            }
        });
    }
    let wrapped = |line: &String| style.width.map_or_else(|| line.clone(), |width| wrap(line, width));
    let paragraphs = paragraphs.iter().filter(|lines| !lines.is_empty());
    let paragraphs = paragraphs.map(|lines| lines.iter().map(wrapped).collect::<Vec<_>>().join("\n"));
    let text = paragraphs.collect::<Vec<_>>().join("\n\n") + "\n";
    if style.ascii { to_ascii(&text) } else { text }
}

/// Last line of several reports: their worst verdict, and how many plans pass. Without this line the verdict on the last plan would
/// read as the verdict on all. `None` for a single report.
pub fn of_all(reports: &[Report], style: Style) -> Option<String> {
    let words: Vec<VerdictWord> =
        reports.iter().filter_map(|report| Some(report.conclusion.as_ref()?.word)).collect();
    let worst = words.iter().max().filter(|_| reports.len() > 1)?;
    let passing = words.iter().filter(|word| word.verdict() == Verdict::Pass).count();
    let verdict = colored(*worst, worst.for_people(), style);
    Some(format!("\n{verdict}: {passing} of {} plans pass\n", reports.len()))
}

/// A line broken at words. Further lines have the indent of the first, and two columns more.
fn wrap(line: &str, width: usize) -> String {
    let indent = line.len() - line.trim_start().len() + 2;
    let (mut text, mut column) = (String::new(), 0);
    for word in line.split_inclusive(' ') {
        let end = column + seen_width(word.trim_end());
        if end > width && column > indent {
            text.truncate(text.trim_end().len());
            text += &format!("\n{:indent$}", "");
            column = indent;
        }
        text += word;
        column += seen_width(word);
    }
    text
}

/// Width of a text on the screen [columns]. Colours take no room.
fn seen_width(text: &str) -> usize {
    let seen = |(n, part): (usize, &str)| match n {
        0 => part.width(),
        _ => part.split_once('m').map_or(0, |(_, seen)| seen.width()),
    };
    text.split("\x1b[").enumerate().map(seen).sum()
}

/// A name in at most `width` columns. A name that is cut keeps its end, because names differ there. The end begins at the last
/// number, as in `17 ms`, where it is shorter than half of the width.
pub fn cut_name(name: &str, width: usize) -> String {
    let letters: Vec<char> = name.chars().collect();
    if letters.len() <= width {
        return name.to_owned();
    }
    let last_digit = letters.iter().rposition(char::is_ascii_digit).unwrap_or_default();
    let number = letters[..last_digit].iter().rposition(|letter| *letter == ' ').unwrap_or_default();
    let last = letters.len() - number;
    let end = if 2 * last < width { last } else { (width / 3).min(4) };
    let start = width.saturating_sub(end + 1);
    letters[..start].iter().chain(&['…']).chain(&letters[letters.len() - end..]).collect()
}

fn colored(verdict: VerdictWord, label: &str, style: Style) -> String {
    match style.color {
        true => format!("\x1b[1;{}m{label}\x1b[0m", Role::of(verdict).ansi()),
        false => label.to_owned(),
    }
}

/// A cell or heading, complete except for its padding.
struct Label {
    text: String,
    verdict: Option<VerdictWord>,
}

impl Label {
    fn new(text: String, style: Style) -> Self {
        Self { text: if style.ascii { to_ascii(&text) } else { text }, verdict: None }
    }

    fn of(cell: &Cell, bars: usize, style: Style) -> Self {
        let verdict = if let Cell::Verdict(verdict) = cell { Some(*verdict) } else { None };
        Self { verdict, ..Self::new(cell.label(bars), style) }
    }

    fn pad(&self, align: Align, width: usize, style: Style) -> String {
        let blank = " ".repeat(width.saturating_sub(self.text.width()));
        let text = self
            .verdict
            .map_or_else(|| self.text.clone(), |verdict| colored(verdict, verdict.for_people(), style));
        match align {
            Align::Left => text + &blank,
            Align::Right => blank + &text,
        }
    }
}

/// Whether a column holds sparklines.
fn is_drawn(table: &Table, column: usize) -> bool {
    table.rows.iter().any(|row| matches!(row.cells[column], Cell::Sparkline { .. }))
}

/// Heading and rows of a table, complete except for their padding.
struct Labels {
    /// Indices of the columns shown (`n_shown`).
    seen: Vec<usize>,
    heading: Vec<Vec<Label>>,
    rows: Vec<Vec<Label>>,
    /// Width of each column [columns] (`n_shown`).
    widths: Vec<usize>,
}

impl Labels {
    /// The labels of the columns `seen`. A series gets `bars` bars.
    fn new(table: &Table, seen: Vec<usize>, bars: usize, style: Style) -> Self {
        let labels = |line: Vec<String>| line.into_iter().map(|text| Label::new(text, style)).collect();
        let heading: Vec<Vec<Label>> = table.heading(&seen).into_iter().map(labels).collect();
        let cells = |row: &Row| seen.iter().map(|&n| Label::of(&row.cells[n], bars, style)).collect();
        let rows: Vec<Vec<Label>> = table.rows.iter().map(cells).collect();
        let width =
            |n: usize| heading.iter().chain(&rows).map(|line| line[n].text.width()).max().unwrap_or(0);
        let widths = (0..seen.len()).map(width).collect();
        Self { seen, heading, rows, widths }
    }

    /// The labels with as many columns and bars as fit. A series loses bars first, down to the least of [`BARS`]. Then columns that
    /// can be spared go.
    fn that_fit(table: &Table, seen: &[usize], style: Style) -> Self {
        let width = style.width.unwrap_or(USUAL_WIDTH);
        let most_spare = seen.iter().map(|&n| table.columns[n].spare).max().unwrap_or(0);
        let keeping = |spare: u8| {
            let kept = seen.iter().copied().filter(|&n| table.columns[n].spare <= spare).collect::<Vec<_>>();
            (BARS[0]..=BARS[1]).rev().map(move |bars| (kept.clone(), bars))
        };
        let tried = (0..=most_spare).rev().flat_map(keeping);
        let mut tried = tried.map(|(seen, bars)| Self::new(table, seen, bars, style)).peekable();
        loop {
            let labels = tried.next().expect("one is tried");
            if labels.width() <= width {
                return labels;
            }
            if tried.peek().is_none() {
                let is_terminal = style.width.is_some();
                return if is_terminal { labels.with_short_names(width) } else { labels };
            }
        }
    }

    /// The same labels. The names in the first column are cut by the columns by which the table exceeds `width`.
    fn with_short_names(mut self, width: usize) -> Self {
        let over = self.width().saturating_sub(width);
        let Some(first) = self.widths.first_mut() else { return self };
        *first = first.saturating_sub(over).max(SHORTEST_NAME).min(*first);
        for line in self.heading.iter_mut().chain(&mut self.rows) {
            line[0].text = cut_name(&line[0].text, *first);
        }
        self
    }

    /// Width of the whole table [columns].
    fn width(&self) -> usize {
        self.widths.iter().sum::<usize>() + 2 * self.widths.len().saturating_sub(1)
    }
}

/// Lines of a table: heading and rows of the columns that readers of text see; empty where there is no such column.
fn table_lines(table: &Table, style: Style) -> Vec<String> {
    let mut seen = table.columns_for(Audience::is_in_text);
    seen.retain(|&n| !(style.plain && is_drawn(table, n)));
    if seen.is_empty() {
        return Vec::new();
    }
    let Labels { seen, heading, rows, widths } = Labels::that_fit(table, &seen, style);
    let join = |labels: &[Label]| {
        let labels = labels.iter().zip(&seen).zip(&widths);
        let padded = labels.map(|((label, &n), &width)| label.pad(table.columns[n].align, width, style));
        padded.collect::<Vec<_>>().join("  ").trim_end().to_owned()
    };
    let mut lines: Vec<String> = heading.iter().map(|labels| join(labels)).collect();
    let hidden = table.left_out(RANKED);
    for (n, (row, labels)) in table.rows.iter().zip(&rows).enumerate() {
        if hidden.contains(&n) {
            if n == hidden.start {
                lines.push(format!("… {} more", hidden.len()));
            }
            continue;
        }
        lines.push(match &row.missing {
            Some(missing) => format!("{}  {missing}", join(&labels[..row.count_known(&seen)])),
            None => join(labels),
        });
        lines.extend(row.details.iter().map(|detail| format!("    {}", detail.text)));
    }
    lines
}

/// Lines of a chart: bars, or marks where its axes are logarithmic.
fn chart_lines(chart: &Chart) -> Vec<String> {
    match chart.x.scale {
        Scale::Linear => chart.series.iter().map(|series| bars(chart, &series.points)).collect(),
        Scale::Logarithmic => plot_lines(chart),
    }
}

fn bars(chart: &Chart, points: &[(f64, f64)]) -> String {
    let bars = sparkline(&evenly(chart.x.range, points), CHART_BARS, chart.limit.unwrap_or(0.0));
    let [from, to] = chart.x.ends().map(|end| format!("{} {}", units::short(end), chart.x.unit.symbol()));
    format!("{:>13}  {from} {bars} {to}", chart.y.name)
}

/// Values of a chart at even distances. Each value is the greatest of the points near its place, or else the nearest point.
fn evenly([from, to]: [f64; 2], points: &[(f64, f64)]) -> Vec<f64> {
    let width = (to - from).max(f64::MIN_POSITIVE) / (CHART_BARS - 1) as f64;
    let value = |at: f64| {
        let distance = |point: &&(f64, f64)| (point.0 - at).abs();
        let near = points.iter().filter(|point| distance(point) <= 0.5 * width);
        let nearest = || points.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
        near.map(|point| point.1).reduce(f64::max).or_else(|| nearest().map(|point| point.1)).unwrap_or(0.0)
    };
    (0..CHART_BARS).map(|n| value(from + n as f64 * width)).collect()
}

/// Lines of a chart with logarithmic axes. Each point is the first letter of its series.
fn plot_lines(chart: &Chart) -> Vec<String> {
    let ([left, right], [bottom, top]) = (chart.x.ends(), chart.y.ends());
    let slot = |part: f64, size: usize| ((part * (size - 1) as f64).round() as usize).min(size - 1);
    let mut grid = vec![vec![' '; PLOT.0]; PLOT.1];
    let drawn = || chart.series.iter().filter(|series| series.kind != SeriesKind::Points);
    for series in drawn() {
        for &(x, y) in &series.points {
            let across = slot((chart.x.coordinate(x) - left) / (right - left), PLOT.0);
            let down = slot((top - chart.y.coordinate(y)) / (top - bottom), PLOT.1);
            grid[down][across] = series.name.chars().next().unwrap_or('*');
        }
    }
    let ends = |axis: &super::parts::Axis| {
        let [from, to] = axis.ends().map(|end| axis.mark(end));
        format!("{from} to {to} {}", axis.unit.symbol())
    };
    let names = drawn().filter_map(|series| Some(format!("{} {}", series.name.chars().next()?, series.name)));
    let mut lines = vec![format!(
        "{}, {} (upwards), over {}, {}; {}",
        chart.y.name,
        ends(&chart.y),
        chart.x.name,
        ends(&chart.x),
        names.collect::<Vec<_>>().join(", "),
    )];
    lines.extend(grid.iter().map(|line| format!("  |{}", line.iter().collect::<String>().trim_end())));
    lines.push(format!("  +{}", "-".repeat(PLOT.0)));
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::parts::{Column, Conclusion};
    use crate::units::Unit;
    use crate::verdict::Verdict;

    fn report(names: &[&str]) -> Report {
        let columns =
            [Column::words(&[], "option"), Column::words(&[], ""), Column::numbers(&[], "n", Unit::One)];
        let row = |name: &&str| vec![Cell::Text((*name).to_owned()), Verdict::Fail.into(), Cell::Count(7)];
        let table = Table::new(&columns, names.iter().map(row));
        Report { blocks: vec![Block::Table(table)], ..Report::default() }
    }

    /// Names differ at their ends, mostly by a number.
    #[test]
    fn names_that_are_cut_stay_apart() {
        let cut = |name: &str| cut_name(name, 16);
        assert_eq!(cut("middle first, by hole, 17 ms"), "middle fi… 17 ms");
        assert_ne!(cut("middle first, by hole, 17 ms"), cut("middle first, by hole, 25 ms"));
        assert_eq!(cut("25 ms, middle first"), "25 ms, midd…irst");
        assert_eq!(cut("109 ms"), "109 ms");
    }

    #[test]
    fn wide_and_combining_letters_keep_columns_aligned() {
        let text = text(&report(&["a", "爆破排", "e\u{301}te\u{301}"]), Style::default());
        let expected = "option        n\na       FAIL  7\n爆破排  FAIL  7\ne\u{301}te\u{301}     FAIL  7\n";
        assert_eq!(text, expected);
    }

    #[test]
    fn in_ascii_columns_stay_aligned() {
        let text = text(&report(&["a ± b", "爆破排"]), Style { ascii: true, ..Style::default() });
        assert_eq!(text, "option          n\na +- b    FAIL  7\nBaoPoPai  FAIL  7\n");
    }

    /// A series loses bars, and columns that can be spared go, until the table fits the terminal. Sentences break at its width.
    #[test]
    fn a_table_is_as_wide_as_its_terminal() {
        let digits = |heading, spare| Column::words(&[], heading).spare(spare);
        let columns =
            [Column::words(&[], "option"), digits("first", 1), digits("last", 2), digits("time", 0)];
        let words = |text: &str| Cell::Text(text.to_owned());
        let series = Cell::Sparkline { series: vec![1.0; 32], top: 2.0 };
        let table = Table::new(&columns, [vec![words("a"), words("12345"), words("6789"), series]]);
        let sentence = "many words about it".to_owned();
        let report =
            Report { blocks: vec![Block::Table(table)], warnings: vec![sentence], ..Report::default() };
        let drawn = |width| text(&report, Style { width: Some(width), ..Style::default() });
        let rows = [35, 30, 25, 18].map(|width| drawn(width).lines().nth(1).expect("a row").to_owned());
        let bars = |count| "▄".repeat(count);
        let expected = [
            format!("a       12345  6789  {}", bars(14)),
            format!("a       12345  6789  {}", bars(9)),
            format!("a       12345  {}", bars(10)),
            format!("a       {}", bars(10)),
        ];
        assert_eq!(rows, expected);
        assert!(drawn(18).ends_with("warning: many\n  words about it\n"), "{}", drawn(18));
    }

    /// The last line of several plans is their worst verdict. A single plan has no such line.
    #[test]
    fn several_plans_end_in_one_verdict() {
        let report = |word| Report {
            conclusion: Some(Conclusion::new(word, "1 of 1 options pass".to_owned())),
            ..Report::default()
        };
        let reports = [VerdictWord::Fail, VerdictWord::Thin, VerdictWord::Pass].map(report);
        let of_all = |reports: &[Report]| super::of_all(reports, Style::default());
        assert_eq!(of_all(&reports).as_deref(), Some("\nFAIL: 2 of 3 plans pass\n"));
        assert_eq!(of_all(&reports[1..]).as_deref(), Some("\nTHIN: 2 of 2 plans pass\n"));
        assert_eq!(of_all(&reports[2..]), None);
    }

    /// Colours take no room, names are cut, and the answer is the last line: nothing of a table wraps.
    #[test]
    fn no_row_wraps_and_the_answer_is_the_last_line() {
        let columns = [Column::words(&[], "option"), Column::words(&[], ""), Column::words(&[], "time")];
        let series = Cell::Sparkline { series: vec![1.0; 32], top: 2.0 };
        let cells = vec![Cell::Text("25 ms, middle first".to_owned()), Verdict::Fail.into(), series];
        let conclusion = Conclusion::new(VerdictWord::Fail, "1 of 2 options pass".to_owned());
        let report = Report {
            blocks: vec![Block::Table(Table::new(&columns, [cells]))],
            answer: Some("9 ms passes".to_owned()),
            conclusion: Some(conclusion),
            ..Report::default()
        };
        let drawn = |width| text(&report, Style { width: Some(width), color: true, ..Style::default() });
        let rows = [38, 30].map(|width| drawn(width).lines().nth(1).expect("a row").to_owned());
        let fail = "\x1b[1;31mFAIL\x1b[0m";
        let bars = |count| "▄".repeat(count);
        assert_eq!(
            rows,
            [
                format!("25 ms, middle first  {fail}  {}", bars(11)),
                format!("25 ms, m…irst  {fail}  {}", bars(9))
            ]
        );
        assert!(
            drawn(40).ends_with(&format!("9 ms passes · {fail}: 1 of 2 options pass\n")),
            "{}",
            drawn(40)
        );
        assert!(drawn(38).ends_with(&format!("{fail}: 1 of 2 options pass\n9 ms passes\n")), "{}", drawn(38));
    }

    #[test]
    fn tables_for_scripts_leave_no_trace() {
        let table = Table::new(&[Column::scripts(&["n"])], [vec![Cell::Count(7)], vec![Cell::Count(8)]]);
        let mut report = report(&["a"]);
        report.blocks.push(Block::Table(table));
        assert_eq!(text(&report, Style::default()), "option        n\na       FAIL  7\n");
    }

    #[test]
    fn plain_text_has_no_drawing() {
        let columns = [Column::words(&[], "option"), Column::words(&[], "over time")];
        let series = Cell::Sparkline { series: vec![1.0, 2.0], top: 2.0 };
        let table = Table::new(&columns, [vec![Cell::Text("a ± b".to_owned()), series]]);
        let report = Report { blocks: vec![Block::Table(table)], ..Report::default() };
        let plain = Style { ascii: true, plain: true, ..Style::default() };
        assert_eq!(text(&report, plain), "option\na +- b\n");
    }

    #[test]
    fn only_verdicts_are_coloured() {
        let text = text(&report(&["PASS-3"]), Style { color: true, ..Style::default() });
        assert_eq!(text, "option        n\nPASS-3  \x1b[1;31mFAIL\x1b[0m  7\n");
    }
}
