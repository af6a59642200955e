//! Changes of a plan that may make a delay option pass, and how to write each into the plan's text.

use toml_edit::{DocumentMut, Item, Value};

use super::fields;
use super::fields::Path;
use super::{
    as_number, change_section, number, replace_keys, rounded, scale_launches, set, with_line_ends_of,
};
use crate::plan::Time;
use crate::plan::keys::{cable, delay, plan, shelter, uncertainty};
use crate::ropes::{Rope, Termination};

/// Kind of a change: the part of the plan that changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ChangeKind {
    /// The rope.
    Rope,
    /// The termination.
    Termination,
    /// Rows of ballast.
    BorderRows,
    /// The slack.
    Slack,
    /// The launch velocities.
    Launch,
    /// The interval of one delay option.
    Interval,
}

impl ChangeKind {
    /// Name that scripts read.
    pub fn name(self) -> &'static str {
        match self {
            ChangeKind::Rope => "rope",
            ChangeKind::Termination => "termination",
            ChangeKind::BorderRows => "border_rows",
            ChangeKind::Slack => "slack",
            ChangeKind::Launch => "launch",
            ChangeKind::Interval => "interval",
        }
    }
}

/// One change of a plan. Every change is for all delay options, except `Interval`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Change {
    /// Another rope.
    Rope(&'static Rope),
    /// Another termination.
    Termination(&'static Termination),
    /// This number of ballast rows on each side.
    BorderRows(usize),
    /// Another slack [%]. The range in `[uncertainty]` moves with the slack.
    Slack(f64),
    /// All launch velocities times this factor.
    Launch(f64),
    /// Another interval of one delay option.
    Interval {
        /// Index of the option.
        option: usize,
        /// The new interval.
        interval: Time,
    },
}

impl Change {
    /// Kind of the change.
    pub fn kind(&self) -> ChangeKind {
        match self {
            Change::Rope(_) => ChangeKind::Rope,
            Change::Termination(_) => ChangeKind::Termination,
            Change::BorderRows(_) => ChangeKind::BorderRows,
            Change::Slack(_) => ChangeKind::Slack,
            Change::Launch(_) => ChangeKind::Launch,
            Change::Interval { .. } => ChangeKind::Interval,
        }
    }

    /// The text of a plan with this change, or why the text has no place for it. Everything else in the text stays, comments and formatting
    /// too. Only the plan's reader checks that the new text is a valid plan.
    pub fn apply(&self, text: &str) -> Result<String, String> {
        if let Change::Interval { option, interval } = *self {
            let path = Path { section: plan::DELAY.name, index: Some(option), key: &delay::INTERVAL_MS };
            return fields::set(text, &path, &interval.to_string());
        }
        let mut document: DocumentMut =
            text.parse().map_err(|error: toml_edit::TomlError| error.message().to_owned())?;
        match *self {
            Change::Rope(rope) => change_section(&mut document, &plan::CABLE, |table| {
                set(table, cable::ROPE.name, rope.name.as_str().into());
            }),
            Change::Termination(termination) => change_section(&mut document, &plan::CABLE, |table| {
                let name = termination.name.as_str().into();
                match table.contains_key(cable::TERMINATION_PERCENT.name) {
                    true => replace_keys(table, &[&cable::TERMINATION_PERCENT], &cable::TERMINATION, name),
                    false => set(table, cable::TERMINATION.name, name),
                }
            }),
            Change::BorderRows(rows) => change_section(&mut document, &plan::SHELTER, |table| {
                set(table, shelter::BORDER_ROWS.name, (rows as i64).into());
            }),
            Change::Slack(percent) => change_slack(&mut document, percent),
            Change::Launch(factor) => scale_launches(&mut document, factor),
            Change::Interval { .. } => {}
        }
        Ok(with_line_ends_of(text, &document))
    }
}

/// Sets the slack [%], and moves the range of slack by the same amount, not below 0. A range written as `0` stays: it means exactly the
/// plan's slack.
fn change_slack(document: &mut DocumentMut, percent: f64) {
    let section = document.get(plan::CABLE.name).and_then(Item::as_table_like);
    let old = section.and_then(|section| number(section, cable::SLACK_PERCENT.name));
    let moved = percent - old.unwrap_or(0.0);
    change_section(document, &plan::CABLE, |table| {
        set(table, cable::SLACK_PERCENT.name, rounded(percent).into());
    });
    let unknown = document.get_mut(plan::UNCERTAINTY.name).and_then(Item::as_table_like_mut);
    let range = unknown.and_then(|table| table.get_mut(uncertainty::SLACK_PERCENT.name));
    for end in range.and_then(Item::as_array_mut).into_iter().flat_map(|range| range.iter_mut()) {
        if let Some(old) = as_number(end) {
            let mut new = Value::from(rounded((old + moved).max(0.0)));
            *new.decor_mut() = end.decor().clone();
            *end = new;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Plan;
    use crate::ropes::catalogue;

    const PLAN: &str = include_str!("../../../tests/fixtures/amur-three-rows.toml");

    fn changed(text: &str, change: Change) -> String {
        change.apply(text).expect("a place for it")
    }

    #[test]
    fn one_value_changes_and_comments_stay() {
        let rope = catalogue().find("GOST 2688-80 15 1960").expect("in the catalogue");
        let spelter = catalogue().termination("spelter socket").expect("in the catalogue");
        for (change, old, new) in [
            (Change::Rope(rope), "\"GOST 2688-80 14 1960\"", "\"GOST 2688-80 15 1960\""),
            (Change::Termination(spelter), "\"mechanical sleeve\"", "\"spelter socket\""),
            (Change::Launch(0.95), "launch_m_s = 6.0", "launch_m_s = 5.7"),
            (
                Change::Interval { option: 2, interval: Time::from_ms(22.0) },
                "\"20 ms\"\ninterval_ms = 20",
                "\"22 ms\"\ninterval_ms = 22",
            ),
            (Change::BorderRows(2), "\"diagonal\"]\n", "\"diagonal\"]\nborder_rows = 2\n"),
        ] {
            let new_text = PLAN.replace(old, new);
            assert_eq!(changed(PLAN, change), new_text);
            let windows = PLAN.replace('\n', "\r\n");
            assert_eq!(changed(&windows, change), new_text.replace('\n', "\r\n"));
        }
    }

    /// The plan has a slack of 2 % and a range of 1.5 to 2.5 %. At 0.5 % the range becomes 0 to 1 %, at 0 % it becomes 0 to 0.5 %.
    #[test]
    fn the_range_of_slack_moves_with_the_slack() {
        for (percent, range) in [(0.5, [0.0, 1.0]), (0.0, [0.0, 0.5]), (2.3, [1.8, 2.8])] {
            let text = changed(PLAN, Change::Slack(percent));
            let plan = Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
            assert_eq!((plan.cable.slack_percent, plan.uncertainty.slack_percent), (percent, range));
            assert!(plan.ranges_beside_the_plan().is_empty());
            assert!(text.contains("# assumed: measure yours"), "{text}");
        }
        let exact = PLAN.replace("slack_percent = [1.5, 2.5]", "slack_percent = 0");
        let plan = Plan::parse("", &changed(&exact, Change::Slack(3.0)));
        assert_eq!(plan.map(|plan| plan.uncertainty.slack_percent).ok(), Some([3.0, 3.0]));
    }

    #[test]
    fn a_termination_takes_the_place_of_its_efficiency() {
        let text = PLAN.replace("termination = \"mechanical sleeve\"", "# tested\ntermination_percent = 70");
        let clips = catalogue().termination("clips").expect("in the catalogue");
        let new = changed(&text, Change::Termination(clips));
        assert!(
            new.contains("# tested\ntermination = \"clips\"") && !new.contains("termination_percent"),
            "{new}"
        );
    }

    #[test]
    fn heights_of_test_tires_fall_with_the_square() {
        let text = "[[blast_row]]\nlaunch_m_s = 6 # filmed\n[[blast_row]]\n\
                    holes = [{ x_m = 0, free_flight_height_m = 1.5 }]\n";
        let new = changed(text, Change::Launch(0.9));
        assert!(new.contains("launch_m_s = 5.4 # filmed") && new.contains("height_m = 1.215 }"), "{new}");
    }
}
