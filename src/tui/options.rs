//! The delay options on the screen: the state of each, and which are listed in which order.

use crate::plan::Plan;
use crate::study::NoResult;
use crate::study::check::Checked;
use crate::verdict::Verdict;

/// State of one delay option.
#[derive(Clone, Debug)]
pub enum OptionState {
    /// Not begun.
    Waiting,
    /// Computing.
    Running {
        /// Runs finished.
        runs: usize,
        /// Share of the least number of runs that is done, 0 to 1.
        done: f64,
    },
    /// Judged.
    Done(Box<Checked>),
    /// Without a result.
    Failed(NoResult),
}

impl OptionState {
    /// The result, once there is one.
    pub fn checked(&self) -> Option<&Checked> {
        match self {
            OptionState::Done(checked) => Some(checked),
            OptionState::Waiting | OptionState::Running { .. } | OptionState::Failed(_) => None,
        }
    }

    /// Whether the option still computes.
    pub fn is_computing(&self) -> bool {
        matches!(self, OptionState::Waiting | OptionState::Running { .. })
    }
}

/// Key of the order in which the options are listed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SortBy {
    /// Order of the plan.
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
    /// The next key; the first follows the last.
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

    /// The number that orders results by this key; `Plan` and `Name` need none.
    fn value(self, checked: &Checked) -> f64 {
        match self {
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
}

/// How the options are listed.
#[derive(Clone, Debug, Default)]
pub struct Listing {
    /// Key of the order.
    pub sort: SortBy,
    /// Greatest first.
    pub reversed: bool,
    /// Only options whose name or verdict contains this text are listed.
    pub filter: String,
    /// Index of the option that the others are compared with.
    pub baseline: Option<usize>,
}

impl Listing {
    /// Sorts by a column; a column that sorts already is turned round.
    pub fn sort_by(&mut self, sort: SortBy) {
        self.reversed = self.sort == sort && !self.reversed;
        self.sort = sort;
    }

    /// Indices of the options listed, in order; `states` has one state per option of the plan. Options without a result
    /// stand last, whatever the direction.
    pub fn listed(&self, plan: &Plan, states: &[OptionState]) -> Vec<usize> {
        let name = |option: usize| plan.delays[option].name.to_lowercase();
        let checked = |option: usize| states[option].checked();
        let wanted = self.filter.to_lowercase();
        let mut options: Vec<usize> = (0..states.len())
            .filter(|&option| {
                let verdict = checked(option).map_or("", |checked| checked.verdict.name());
                name(option).contains(&wanted) || verdict.contains(&wanted)
            })
            .collect();
        if self.sort == SortBy::Name {
            options.sort_by_key(|&option| name(option));
        } else if self.sort != SortBy::Plan {
            let key = |option: usize| checked(option).map(|checked| self.sort.value(checked));
            options.sort_by(|&a, &b| match (key(a), key(b)) {
                (Some(a), Some(b)) if self.reversed => b.total_cmp(&a),
                (Some(a), Some(b)) => a.total_cmp(&b),
                (a, b) => a.is_none().cmp(&b.is_none()),
            });
            return options;
        }
        if self.reversed {
            options.reverse();
        }
        options
    }
}
