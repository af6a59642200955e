//! Windows of intervals that pass, in words and in a table. They are rounded inward. Windows with only narrow gaps between them are
//! one.

use super::parts::{Cell, Column, Field, Table};
use crate::plan::Time;
use crate::report::language::{phrase, say};
use crate::study::sweep::Sweep;
use crate::units::Unit;

/// Windows narrower than this are counted, not listed.
const NARROW: Time = Time::from_nanoseconds(1_000_000);

/// A hundredth of a millisecond.
pub const HUNDREDTH: Time = Time::from_nanoseconds(10_000);

/// The wide windows, one per row.
pub fn table_of_windows(sweep: &Sweep) -> Table {
    let named = |name: &'static str, windows: &[[Time; 2]]| {
        grouped(windows).into_iter().map(move |group| (name, group)).collect::<Vec<_>>()
    };
    let (all, as_planned) = match sweep.has_risk() {
        true => (
            named("worth a check, not proven", &sweep.windows),
            named("as planned, no permission", &sweep.windows_as_planned),
        ),
        false => (named("that pass", &sweep.windows), Vec::new()),
    };
    let all = [all, as_planned].concat();
    let has_gaps = all.iter().any(|(_, group)| !group.gaps.is_empty());
    let fields: [Field<(&str, WindowGroup)>; 4] = [
        Field::new(Column::words(&[], "windows"), |(name, _)| phrase(name).into()),
        Field::new(Column::numbers(&[], "from", Unit::One), |(_, group)| {
            Cell::Interval(group.ends[0].seconds())
        }),
        Field::new(Column::numbers(&[], "to", Unit::One), |(_, group)| {
            Cell::Interval(group.ends[1].seconds())
        }),
        Field::new(Column::words(&[], "but"), |(_, group)| match group.gaps.len() {
            0 => String::new().into(),
            1 => phrase("a narrow gap").into(),
            count => say!("{count} narrow gaps", count).into(),
        }),
    ];
    Table::of(if has_gaps { &fields[..] } else { &fields[..3] }, all)
}

pub fn wide(windows: &[[Time; 2]]) -> Vec<[Time; 2]> {
    windows.iter().copied().filter(|&[from, to]| to - from >= NARROW).collect()
}

/// A window rounded inward to hundredths of a millisecond.
pub fn rounded_inward([from, to]: [Time; 2]) -> [Time; 2] {
    let earlier = from.rounded_down(HUNDREDTH);
    [if earlier < from { earlier + HUNDREDTH } else { earlier }, to.rounded_down(HUNDREDTH)]
}

/// Wide windows with only gaps narrower than [`NARROW`] between them.
#[derive(Clone, Debug, PartialEq)]
pub struct WindowGroup {
    /// Both ends.
    pub ends: [Time; 2],
    /// Gaps between the windows.
    pub gaps: Vec<[Time; 2]>,
}

/// The wide windows in groups, rounded inward. A row of fragments would hide that nearly all of the range is one window.
pub fn grouped(windows: &[[Time; 2]]) -> Vec<WindowGroup> {
    let mut groups: Vec<WindowGroup> = Vec::new();
    for [from, to] in wide(windows).into_iter().map(rounded_inward) {
        match groups.last_mut().filter(|group| from - group.ends[1] < NARROW) {
            Some(group) => {
                group.gaps.push([group.ends[1], from]);
                group.ends[1] = to;
            }
            None => groups.push(WindowGroup { ends: [from, to], gaps: Vec::new() }),
        }
    }
    groups
}

/// Lines: the wide windows, and the number of other windows.
pub fn listed(what: &str, windows: &[[Time; 2]]) -> Vec<String> {
    let window = |[from, to]: [Time; 2]| say!("{from} ms to {to} ms", from, to);
    let group = |WindowGroup { ends, gaps }: WindowGroup| {
        let gaps: Vec<String> = gaps.into_iter().map(window).collect();
        let whole = window(ends);
        match gaps.is_empty() {
            true => whole,
            false => say!("{whole} without {}", whole, gaps.join(", ")),
        }
    };
    let list: Vec<String> = grouped(windows).into_iter().map(group).collect();
    let mut lines = vec![match list.len() {
        0 => say!("{what}: none", what),
        _ => format!("{what}: {}", list.join(" · ")),
    }];
    let narrow = windows.len() - wide(windows).len();
    if narrow > 0 {
        let what = if narrow == 1 { phrase("window or point") } else { phrase("windows and points") };
        lines.push(say!("not listed: {narrow} {what} narrower than {NARROW} ms", narrow, what, NARROW));
    }
    lines
}
