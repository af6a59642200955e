//! Which delay options the comparison lists, and in which order.

use super::app::{App, Row};
use crate::study::check::Checked;
use crate::verdict::Verdict;

/// What the list is sorted by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SortBy {
    /// As the plan lists them.
    #[default]
    Plan,
    /// Name.
    Name,
    /// Pass, open, fail.
    Verdict,
    /// Flight height.
    Height,
    /// Cable force.
    Force,
    /// Drift.
    Drift,
}

impl SortBy {
    /// The next one.
    pub fn next(self) -> Self {
        match self {
            SortBy::Plan => SortBy::Name,
            SortBy::Name => SortBy::Verdict,
            SortBy::Verdict => SortBy::Height,
            SortBy::Height => SortBy::Force,
            SortBy::Force => SortBy::Drift,
            SortBy::Drift => SortBy::Plan,
        }
    }
}

/// How the options are listed.
#[derive(Clone, Debug, Default)]
pub struct Compare {
    /// What they are sorted by.
    pub sort: SortBy,
    /// Greatest first.
    pub reversed: bool,
    /// Only those whose name or verdict contains this.
    pub filter: String,
    /// Index of the option that the others are compared with.
    pub baseline: Option<usize>,
}

impl Compare {
    /// Sorts by a column; the other way round where it is sorted by it already.
    pub fn sort_by(&mut self, sort: SortBy) {
        self.reversed = self.sort == sort && !self.reversed;
        self.sort = sort;
    }
}

impl App {
    /// Indices of the options listed, in order.
    pub fn listed(&self) -> Vec<usize> {
        let mut options: Vec<usize> = (0..self.rows.len()).filter(|&option| self.is_listed(option)).collect();
        let Compare { sort, reversed, .. } = self.compare;
        if sort == SortBy::Name {
            options.sort_by_key(|&option| self.case.plan.delays[option].name.to_lowercase());
        } else if sort != SortBy::Plan {
            // Those without a result stay last either way.
            let key = |option: usize| self.checked(option).map(|checked| value(checked, sort));
            options.sort_by(|&a, &b| match (key(a), key(b)) {
                (Some(a), Some(b)) if reversed => b.total_cmp(&a),
                (Some(a), Some(b)) => a.total_cmp(&b),
                (a, b) => a.is_none().cmp(&b.is_none()),
            });
            return options;
        }
        if reversed {
            options.reverse();
        }
        options
    }

    fn is_listed(&self, option: usize) -> bool {
        let asked = self.compare.filter.to_lowercase();
        let verdict = self.checked(option).map_or("", |checked| checked.verdict.name());
        let name = self.case.plan.delays[option].name.to_lowercase();
        name.contains(&asked) || verdict.contains(&asked)
    }

    /// The result of an option, once there is one.
    pub fn checked(&self, option: usize) -> Option<&Checked> {
        match self.rows.get(option) {
            Some(Row::Done(checked)) => Some(checked),
            _ => None,
        }
    }

    /// The result that others are compared with, and its option.
    pub fn baseline(&self) -> Option<(usize, &Checked)> {
        let option = self.compare.baseline?;
        Some((option, self.checked(option)?))
    }

    /// Selects an option so many places further down the list.
    pub(super) fn select_listed(&mut self, places: isize) {
        let listed = self.listed();
        let at = listed.iter().position(|&option| option == self.selected);
        let last = listed.len().saturating_sub(1);
        let next = at.map_or(0, |at| at.saturating_add_signed(places).min(last));
        if let Some(&option) = listed.get(next) {
            self.selected = option;
        }
    }
}

fn value(checked: &Checked, sort: SortBy) -> f64 {
    match sort {
        SortBy::Plan | SortBy::Name => 0.0,
        SortBy::Verdict => match checked.verdict {
            Verdict::Pass => 0.0,
            Verdict::Undecided => 1.0,
            Verdict::Fail => 2.0,
        },
        SortBy::Height => checked.height.value,
        SortBy::Force => checked.force.value,
        SortBy::Drift => checked.drift.value,
    }
}
