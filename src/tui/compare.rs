//! The delay options on the screen: the state of each option, the filter and the order of the list.

use crate::plan::Plan;
use crate::sorting::{sort_by, sort_by_key};
use crate::study::NoResult;
use crate::study::judge::Judgement;
use crate::study::judge::OptionResults;
use crate::verdict::{Quantity, Verdict, VerdictWord};

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
    /// The planned shot is judged, and the samples so far.
    Judged {
        /// The judgement; it has no samples until the first samples arrive.
        judgement: Box<Judgement>,
        /// Whether more samples come.
        more_samples: bool,
    },
    /// Ended without a result.
    Failed(NoResult),
}

impl OptionState {
    /// The result, once there is one.
    pub fn judgement(&self) -> Option<&Judgement> {
        match self {
            OptionState::Judged { judgement, .. } => Some(judgement),
            OptionState::Waiting | OptionState::Running { .. } | OptionState::Failed(_) => None,
        }
    }

    /// The verdict; undecided if the option has no result.
    pub fn verdict(&self) -> Verdict {
        self.judgement().map_or(Verdict::Undecided, Judgement::verdict)
    }

    /// Whether the planned shot is not judged yet.
    pub fn is_computing(&self) -> bool {
        matches!(self, OptionState::Waiting | OptionState::Running { .. })
    }

    /// Whether the samples so far decide nothing and more samples come.
    pub fn is_open_for_now(&self) -> bool {
        let tells = |judged: &Judgement| {
            judged.sampled.known().is_some_and(|sampled| sampled.verdict() != Verdict::Undecided)
        };
        self.is_sampling() && !self.judgement().is_some_and(tells)
    }

    /// Whether the verdict is final. More samples cannot take a FAIL back.
    pub fn is_decided(&self) -> bool {
        !self.is_computing() && (!self.is_sampling() || self.verdict() == Verdict::Fail)
    }

    /// Whether more samples come.
    pub fn is_sampling(&self) -> bool {
        matches!(self, OptionState::Judged { more_samples: true, .. })
    }
}

/// Results of all options, once every option has a result with all its samples.
pub fn results(options: &[OptionState]) -> Result<OptionResults, String> {
    let result = |state: &OptionState| match state {
        OptionState::Judged { more_samples: true, .. } => {
            Err("not all options have all their samples yet".to_owned())
        }
        OptionState::Judged { judgement, .. } => Ok(Ok((**judgement).clone())),
        OptionState::Failed(no_result) => Ok(Err(no_result.clone())),
        OptionState::Waiting | OptionState::Running { .. } => {
            Err("not all options are computed yet".to_owned())
        }
    };
    options.iter().map(result).collect()
}

/// Results of all options as far as they are known. An option without a result counts as out of time.
pub fn results_so_far(options: &[OptionState]) -> OptionResults {
    let result = |state: &OptionState| match state {
        OptionState::Judged { judgement, .. } => Ok((**judgement).clone()),
        OptionState::Failed(no_result) => Err(no_result.clone()),
        OptionState::Waiting | OptionState::Running { .. } => Err(NoResult::OutOfTime),
    };
    options.iter().map(result).collect()
}

/// Column by which the options are listed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SortBy {
    /// Order of the plan.
    #[default]
    Plan,
    /// Name.
    Name,
    /// Pass, open, fail.
    Verdict,
    /// Upper bound of the share of shots that fail.
    Risk,
    /// Flight height that one in so many shots exceeds, or of the planned shot if that is more.
    Height,
    /// Cable force that one in so many shots exceeds, or of the planned shot if that is more.
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
            SortBy::Verdict => SortBy::Risk,
            SortBy::Risk => SortBy::Height,
            SortBy::Height => SortBy::Force,
            SortBy::Force => SortBy::Drift,
            SortBy::Drift => SortBy::Plan,
        }
    }

    /// The number that orders results by this key; `Plan` and `Name` need none.
    fn value(self, judgement: &Judgement) -> f64 {
        let Judgement { checked, sampled, .. } = judgement;
        // Same value as the end of the gauge: the deciding value, or the value of the planned shot if that is more.
        let reached = |quantity| {
            let deciding = sampled.known().and_then(|sampled| sampled.deciding_value(quantity));
            deciding.unwrap_or(0.0).max(checked.get(quantity).value)
        };
        match self {
            SortBy::Plan | SortBy::Name => 0.0,
            SortBy::Verdict => match judgement.verdict() {
                Verdict::Pass => 0.0,
                Verdict::Undecided => 1.0,
                Verdict::Fail => 2.0,
            },
            SortBy::Risk => sampled.known().map_or(1.0, |sampled| sampled.bounds.interval[1]),
            SortBy::Height => reached(Quantity::Height),
            SortBy::Force => reached(Quantity::Force),
            SortBy::Drift => checked.estimates.drift.value,
        }
    }
}

/// How the options are listed.
#[derive(Clone, Debug, Default)]
pub struct Listing {
    /// Column that sets the order.
    pub sort: SortBy,
    /// Whether the greatest value comes first.
    pub reversed: bool,
    /// Only options whose name or verdict contains this text are listed.
    pub filter: String,
    /// Index of the option that the others are compared with.
    pub baseline: Option<usize>,
}

/// A name split into numbers and text, so that 20 ms comes before 109 ms.
fn in_parts(name: &str) -> Vec<(u64, String)> {
    let mut parts: Vec<(u64, String)> = Vec::new();
    for part in name.split_inclusive(|letter: char| !letter.is_ascii_digit()) {
        let digits = part.trim_end_matches(|letter: char| !letter.is_ascii_digit());
        parts.push((digits.parse().unwrap_or(u64::MAX), part[digits.len()..].to_owned()));
    }
    parts
}

impl Listing {
    /// Sorts by a column. If the list is already sorted by this column, reverses the order.
    pub fn sort_by(&mut self, sort: SortBy) {
        self.reversed = self.sort == sort && !self.reversed;
        self.sort = sort;
    }
}

/// The options of a plan, for the list.
pub struct PlanOptions<'p> {
    pub plan: &'p Plan,
    /// The state of each option.
    pub states: &'p [OptionState],
    /// The verdict on each option as its row shows it.
    pub words: Vec<VerdictWord>,
}

/// Listed options of several plans, in order; each is a pair (index of the plan, index of the option). Options without a result come
/// last in either direction.
pub fn listed(listing: &Listing, plans: &[PlanOptions<'_>]) -> Vec<(usize, usize)> {
    let name = |(plan, option): (usize, usize)| plans[plan].plan.delays[option].name.to_lowercase();
    let state = |(plan, option): (usize, usize)| &plans[plan].states[option];
    let wanted = listing.filter.to_lowercase();
    let all =
        (0..plans.len()).flat_map(|plan| (0..plans[plan].states.len()).map(move |option| (plan, option)));
    let mut options: Vec<(usize, usize)> = all
        .filter(|&at| {
            let word = plans[at.0].words[at.1];
            // The filter `pass` also finds a thin pass.
            let words = [word.for_people(), word.verdict().for_people()].map(str::to_lowercase);
            name(at).contains(&wanted) || words.iter().any(|word| word.contains(&wanted))
        })
        .collect();
    if listing.sort == SortBy::Name {
        sort_by_key(&mut options, |&at| in_parts(&name(at)));
    } else if listing.sort != SortBy::Plan {
        let key = |at| state(at).judgement().map(|judged| listing.sort.value(judged));
        sort_by(&mut options, |&a, &b| match (key(a), key(b)) {
            (Some(a), Some(b)) if listing.reversed => b.total_cmp(&a),
            (Some(a), Some(b)) => a.total_cmp(&b),
            (a, b) => a.is_none().cmp(&b.is_none()),
        });
        return options;
    }
    if listing.reversed {
        options.reverse();
    }
    options
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_names_sort_as_numbers() {
        let mut names = ["109 ms", "long", "20 ms", "9 ms", "20 ms, centre", "1+109 ms"];
        sort_by_key(&mut names, |name| in_parts(name));
        assert_eq!(names, ["1+109 ms", "9 ms", "20 ms", "20 ms, centre", "109 ms", "long"]);
    }
}
