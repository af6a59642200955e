//! A report in the terminal: sentences and tables as styled lines, charts as pictures.

use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};
use ratatui::text::{Line, Span};

use crate::report::parts::{Align, Audience, Block, Cell, Offer, Report, Row, Table};
use crate::tui::theme::Theme;

/// Bars of a sparkline.
const BARS: usize = 16;
/// At most 1 / `WARNING_SHARE` of the lines may be warnings before the results.
const WARNING_SHARE: u16 = 3;
/// Rows shown at each end of a ranking.
const RANKED: usize = 100;
/// Blank columns between two columns of a table.
const GAP: usize = 2;

/// A report as lines.
pub struct ReportLines<'r> {
    /// The lines from top to bottom.
    pub lines: Vec<Line<'static>>,
    /// The changes of the plan that rows offer. Each has the index of its line.
    pub offers: Vec<(usize, &'r Offer)>,
}

/// The lines of a report for an area, none wider: the conclusion, then the warnings (or their number, if they come at the end), then
/// sentences and tables. Only sentences and rows that contain `filter` are kept.
pub fn lines<'r>(report: &'r Report, filter: &str, theme: Theme, area: Rect) -> ReportLines<'r> {
    let width = usize::from(area.width.max(1));
    let filter = filter.to_lowercase();
    let kept = |text: &str| text.to_lowercase().contains(&filter);
    let (mut lines, mut offers) = (Vec::new(), Vec::new());
    if let Some(conclusion) = &report.conclusion {
        let label = conclusion.label();
        let told = format!("{label}{}: {}", conclusion.unchecked, conclusion.text);
        let mut wrapped = wrapped(&told, width).into_iter();
        let first = wrapped.next().unwrap_or_default();
        let rest = first.strip_prefix(label).unwrap_or_default().to_owned();
        let verdict = theme.verdict(conclusion.word);
        lines.push(Line::from(vec![Span::styled(label, verdict), Span::styled(rest, theme.title())]));
        lines.extend(wrapped.map(|line| Line::styled(line, theme.title())));
    }
    let warnings = report.warnings.iter().flat_map(|warning| wrapped(&format!("! {warning}"), width));
    let of_warnings = theme.caution().remove_modifier(Modifier::BOLD);
    let mut warnings: Vec<Line> = warnings.map(|line| Line::styled(line, of_warnings)).collect();
    if warnings.len() > usize::from(area.height / WARNING_SHARE) && report.warnings.len() > 1 {
        let count = format!("! {} warnings, below the results", report.warnings.len());
        lines.push(Line::styled(count, theme.caution()));
    } else {
        lines.append(&mut warnings);
    }
    for block in &report.blocks {
        match block {
            Block::Text(sentences) => {
                let sentences = sentences.iter().filter(|sentence| kept(sentence));
                lines.extend(sentences.flat_map(|sentence| wrapped(sentence, width)).map(Line::raw));
            }
            Block::Table(table) => {
                let table = table_lines(table, &filter, theme, width);
                offers.extend(table.offers.into_iter().map(|(line, offer)| (lines.len() + line, offer)));
                lines.extend(table.lines.into_iter().map(|line| cut_line(line, width)));
            }
            Block::Chart(_) | Block::Picture(_) | Block::Facts(_) => {}
        }
    }
    lines.append(&mut warnings);
    ReportLines { lines, offers }
}

/// Indent of the sentences below a row.
const DETAIL: &str = "    ";

/// Heading and rows of a table, with a blank line above. Empty if people see no column or no row is kept. Columns that do not fit in
/// `width` [cells] are left out: half a number is a wrong number.
fn table_lines<'r>(table: &'r Table, filter: &str, theme: Theme, width: usize) -> ReportLines<'r> {
    let (mut columns, left_out) = (table.columns_for(Audience::is_in_text), table.left_out(RANKED));
    let rows = [&table.rows[..left_out.start], &table.rows[left_out.end..]];
    let (mut lines, mut offers) = (Vec::new(), Vec::new());
    if columns.is_empty() {
        return ReportLines { lines, offers };
    }
    let label = |row: &Row, n: usize| row.cells[n].label(BARS);
    let headings = table.heading(&columns);
    let wide = |text: &String| Span::raw(text).width();
    let mut all: Vec<(usize, usize)> = columns.iter().map(|&n| (n, 0)).collect();
    for (column, (n, widest)) in all.iter_mut().enumerate() {
        let cells = rows.iter().flat_map(|part| part.iter()).map(|row| label(row, *n));
        let cells = cells.chain(headings.iter().map(|line| line[column].clone()));
        *widest = cells.map(|cell| wide(&cell)).max().unwrap_or(0);
    }
    let (kept, gap) = with_room(table, all, width);
    let no_room = columns.len() - kept.len();
    let widths: Vec<usize> = kept.iter().map(|(_, width)| *width).collect();
    columns = kept.into_iter().map(|(n, _)| n).collect();
    let headings = table.heading(&columns);
    let padded = |text: String, column: usize, style: Style| {
        let blank = " ".repeat(widths[column].saturating_sub(Span::raw(&text).width()));
        let gap = " ".repeat(if column + 1 < columns.len() { gap } else { 0 });
        match table.columns[columns[column]].align {
            Align::Left => [Span::styled(text, style), Span::raw(blank + &gap)],
            Align::Right => [Span::raw(blank), Span::styled(text + &gap, style)],
        }
    };
    lines.push(Line::default());
    for heading in headings {
        let cells = heading.into_iter().enumerate();
        lines.push(Line::from_iter(cells.flat_map(|(n, text)| padded(text, n, theme.muted()))));
    }
    let count = lines.len();
    for (part, rows) in rows.iter().enumerate() {
        if part > 0 && !left_out.is_empty() {
            lines.push(Line::styled(format!("… {} more", left_out.len()), theme.muted()));
        }
        for row in rows.iter() {
            let known = row.count_known(&columns);
            let cells = columns[..known].iter().enumerate();
            let mut line = Line::from_iter(
                cells.flat_map(|(column, &n)| padded(label(row, n), column, style(&row.cells[n], theme))),
            );
            line.extend(row.missing.clone().map(Span::raw));
            if row.contains(&table.columns, filter) {
                offers.extend(row.offer.as_ref().map(|offer| (lines.len(), offer)));
                lines.push(line);
                let room = width.saturating_sub(DETAIL.len()).max(1);
                lines.extend(row.details.iter().flat_map(|detail| {
                    let parts = wrapped(&detail.text, room).into_iter();
                    parts.map(|part| Line::styled(format!("{DETAIL}{part}"), theme.verdict(detail.verdict)))
                }));
            }
        }
    }
    if lines.len() == count {
        lines.clear();
    } else if no_room > 0 {
        let columns = if no_room == 1 { "column" } else { "columns" };
        lines.push(Line::styled(format!("… {no_room} more {columns} on a wider screen"), theme.muted()));
    }
    ReportLines { lines, offers }
}

/// The columns that fit, each as (index, width), and the number of blanks between them. Columns with the greatest `gives_way` go first,
/// then one of the blanks if any column has such a number, then the last columns.
fn with_room(table: &Table, mut columns: Vec<(usize, usize)>, width: usize) -> (Vec<(usize, usize)>, usize) {
    let needed = |columns: &[(usize, usize)], gap: usize| {
        columns.iter().map(|(_, width)| width + gap).sum::<usize>().saturating_sub(gap)
    };
    while columns.len() > 1 && needed(&columns, GAP) > width {
        let first = columns.iter().map(|&(n, _)| table.columns[n].gives_way).max().unwrap_or(0);
        // Columns without such numbers keep both blanks. With one blank they may run together.
        let has_order = table.columns.iter().any(|column| column.gives_way > 0);
        if first == 0 && has_order && needed(&columns, 1) <= width {
            return (columns, 1);
        }
        let last = columns.iter().rposition(|&(n, _)| table.columns[n].gives_way == first);
        last.map(|last| columns.remove(last));
    }
    (columns, GAP)
}

/// Style of a cell by the type of its value.
fn style(cell: &Cell, theme: Theme) -> Style {
    match cell {
        Cell::Verdict(verdict) => theme.verdict(*verdict),
        Cell::Sparkline { .. } => theme.curve(),
        _ => Style::new(),
    }
}

/// The words of a sentence. A number and its unit are one word, and so is a range.
fn words(sentence: &str) -> impl Iterator<Item = &str> {
    let is_kept = |before: &str, after: &str| {
        let last = before.rsplit(' ').next().unwrap_or_default();
        let first = after.split(' ').next().unwrap_or_default();
        let is_number = last.starts_with(|sign: char| sign.is_ascii_digit());
        is_number && ["ms", "m", "kN", "%", "s"].contains(&first.trim_end_matches([',', ';', ':']))
            || last == "ms" && after.starts_with("to ")
            || before.ends_with(" ms to")
    };
    let mut rest = Some(sentence);
    std::iter::from_fn(move || {
        let text = rest?;
        let breaks = text.match_indices(' ').map(|(at, _)| at);
        let end = { breaks }.find(|&at| !is_kept(&text[..at], &text[at + 1..]));
        rest = end.map(|end| &text[end + 1..]);
        Some(end.map_or(text, |end| &text[..end]))
    })
}

/// A sentence as lines of at most `width` columns. Breaks between words if possible.
pub(super) fn wrapped(sentence: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in words(sentence) {
        let last = lines.len() - 1;
        let joined = if lines[last].is_empty() { word.to_owned() } else { format!("{} {word}", lines[last]) };
        if Span::raw(&joined).width() <= width || lines[last].is_empty() {
            lines[last] = joined;
        } else {
            lines.push(word.to_owned());
        }
    }
    lines
}

/// A line without the part beyond `width` columns.
fn cut_line(line: Line<'static>, width: usize) -> Line<'static> {
    let mut room = width;
    let spans = line.spans.into_iter().map(|span| {
        let mut text = String::new();
        for letter in span.content.chars() {
            let wide = Span::raw(letter.to_string()).width();
            if wide > room {
                room = 0;
                break;
            }
            room -= wide;
            text.push(letter);
        }
        Span::styled(text, span.style)
    });
    Line::from(spans.collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::parts::Column;

    /// Columns with the greatest number go first, then the last columns. The first column stays.
    #[test]
    fn columns_give_way_in_their_order() {
        let order = [0, 0, 3, 0, 0, 1, 2];
        let columns = order.map(|number| Column::words(&[], "column").gives_way(number));
        let table = Table::new(&columns, []);
        let all: Vec<(usize, usize)> = (0..order.len()).map(|n| (n, 6)).collect();
        let kept = |count: usize| {
            let (kept, gap) = with_room(&table, all.clone(), count * (6 + GAP) - GAP);
            assert_eq!(gap, GAP);
            kept.into_iter().map(|(n, _)| n).collect::<Vec<_>>()
        };
        assert_eq!(kept(7), [0, 1, 2, 3, 4, 5, 6]);
        assert_eq!(kept(6), [0, 1, 3, 4, 5, 6]);
        assert_eq!(kept(5), [0, 1, 3, 4, 5]);
        assert_eq!(kept(4), [0, 1, 3, 4]);
        assert_eq!(kept(3), [0, 1, 3]);
        assert_eq!(with_room(&table, all.clone(), 4 * 6 + 3).1, 1, "before one of these four goes");
        assert_eq!(with_room(&table, all.clone(), 2).0, [(0, 6)]);
    }
}
