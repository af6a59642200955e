//! `sweep` as a report: charts against the interval, the windows that pass, the worst and the recommended interval.

use super::charts;
use super::model::{Block, Cell, Column, Conclusion, Report, Shown, Table};
use super::shared_columns::{FORCE, HEIGHT, INTERVAL, VERDICT, force, height};
use super::{limit_facts, row_names};
use crate::study::Case;
use crate::study::sweep::{Point, Recommended, Sweep};
use crate::units;
use crate::verdict::Verdict;

/// Every interval tried, for scripts.
const POINTS: [Column; 4] = [
    INTERVAL.shown(Shown::Scripts),
    HEIGHT.shown(Shown::Scripts),
    FORCE.shown(Shown::Scripts),
    VERDICT.shown(Shown::Scripts),
];

/// The worst and the recommended interval, for people.
const ENDS: [Column; 5] =
    [Column::words(&[], ""), INTERVAL.unread(), VERDICT.unread(), HEIGHT.unread(), FORCE.unread()];

/// The report of a sweep, which is partial where the time was up.
pub fn report(case: &Case, sweep: &Sweep, partial: bool) -> Report {
    let names = row_names(case, &sweep.order).join(", ");
    let [from, to] = sweep.range().map(units::milliseconds);
    let head = format!("interval between rows {names}: {from} to {to}, {} tried", sweep.points.len());
    let mut blocks = Vec::new();
    if !sweep.points.is_empty() {
        blocks.push(Block::Text(vec![head]));
        blocks.extend(charts::sweep(case, sweep).map(Block::Chart));
        blocks.push(Block::Table(ends(case, sweep)));
        blocks.push(Block::Text(windows(sweep, partial)));
    }
    let point = |&Point { interval, envelope }: &Point| {
        vec![
            Cell::Interval(interval),
            height(envelope.height),
            force(envelope.force),
            Cell::Verdict(envelope.verdict),
        ]
    };
    blocks.push(Block::Table(Table::new(&POINTS, sweep.points.iter().map(point))));
    Report { blocks, conclusion: Some(conclusion(sweep, partial)), ..limit_facts(case) }
}

fn ends(case: &Case, sweep: &Sweep) -> Table {
    let ends = [("worst", sweep.worst(case)), ("recommended", sweep.best())];
    let end = |(name, point): (&str, Option<&Point>)| {
        let Point { interval, envelope } = *point?;
        let name = Cell::Text(name.to_owned());
        let values = [height(envelope.height), force(envelope.force)];
        Some([vec![name, Cell::Interval(interval), Cell::Verdict(envelope.verdict)], values.into()].concat())
    };
    Table::new(&ENDS, ends.into_iter().filter_map(end))
}

/// What a window and a recommended interval do not know.
const EXACTLY: &str = "for exactly the plan's numbers: shots whose firing times and launches scatter may fail; see scatter first";

/// Windows narrower than this are counted, not listed [s].
const NARROW: f64 = 1e-3;

/// The windows, how closely they were tried, and how the recommended interval was chosen.
fn windows(sweep: &Sweep, partial: bool) -> Vec<String> {
    if sweep.windows.is_empty() {
        return vec!["no interval tried passes".to_owned()];
    }
    let so_far = if partial { " so far" } else { "" };
    let (wide, narrow): (Vec<_>, Vec<_>) = sweep.windows.iter().partition(|[from, to]| to - from >= NARROW);
    let window = |[from, to]: &[f64; 2]| {
        format!("{} to {}", units::exact_milliseconds(*from), units::exact_milliseconds(*to))
    };
    let mut lines = Vec::new();
    if !wide.is_empty() {
        let list: Vec<_> = wide.iter().copied().map(window).collect();
        lines.push(format!("windows that pass{so_far}: {}", list.join(" · ")));
        let inside = |point: &&Point| wide.iter().any(|[from, to]| (*from..=*to).contains(&point.interval));
        lines.push(format!(
            "all {} points tried in them pass, at most {} apart",
            sweep.points.iter().filter(inside).count(),
            units::exact_milliseconds(sweep.largest_gap())
        ));
    }
    if !narrow.is_empty() {
        let narrowest = units::exact_milliseconds(NARROW);
        lines.push(format!("not listed: {} windows and points narrower than {narrowest}", narrow.len()));
    }
    if let Some(Recommended { interval, room, utilization }) = sweep.recommended {
        lines.push(format!(
            "recommended {}: within {} of it at most {} of the limits are used, the most room x margin",
            units::exact_milliseconds(interval),
            units::exact_milliseconds(room),
            units::percent((1e3 * utilization).ceil() * 1e-3, 1)
        ));
    }
    lines.push(EXACTLY.to_owned());
    lines
}

/// Passes only where every interval of the range was tried and passes.
fn conclusion(sweep: &Sweep, partial: bool) -> Conclusion {
    let (tried, count) = (sweep.points.len(), |verdict: Verdict| {
        sweep.points.iter().filter(|point| point.envelope.verdict == verdict).count()
    });
    let (failing, not_passing) = (count(Verdict::Fail), tried - count(Verdict::Pass));
    let so_far = if partial { " so far" } else { "" };
    let verdict = match not_passing {
        0 if tried > 0 && !partial => Verdict::Pass,
        _ if failing > 0 => Verdict::Fail,
        _ => Verdict::Undecided,
    };
    let text = match not_passing {
        _ if tried == 0 => "no interval was tried".to_owned(),
        0 => format!("all {tried} intervals tried{so_far} pass"),
        _ => format!("{not_passing} of {tried} intervals tried{so_far} do not pass"),
    };
    Conclusion { verdict, text }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::Envelope;

    #[test]
    fn a_sweep_passes_only_where_every_interval_passes() {
        let said = |verdicts: &[Verdict], partial: bool| {
            let envelope = |verdict| Envelope { verdict, ..Envelope::UNKNOWN };
            let point =
                |(n, &verdict): (usize, &Verdict)| Point { interval: n as f64, envelope: envelope(verdict) };
            let points = verdicts.iter().enumerate().map(point).collect();
            let Conclusion { verdict, text } = conclusion(
                &Sweep { order: vec![0, 1], points, windows: Vec::new(), recommended: None },
                partial,
            );
            format!("{}: {text}", verdict.label())
        };
        use Verdict::{Fail, Pass, Undecided};
        assert_eq!(said(&[Pass, Pass], false), "PASS: all 2 intervals tried pass");
        assert_eq!(said(&[Pass, Pass], true), "OPEN: all 2 intervals tried so far pass");
        assert_eq!(said(&[Pass, Fail, Undecided], false), "FAIL: 2 of 3 intervals tried do not pass");
        assert_eq!(said(&[Pass, Undecided], false), "OPEN: 1 of 2 intervals tried do not pass");
        assert_eq!(said(&[], true), "OPEN: no interval was tried");
    }
}
