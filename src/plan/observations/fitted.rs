//! What `fitted_from` of a plan keeps of the files that were fitted into it, and which file must not be fitted again: a shot that counts twice
//! looks surer than it is.

use itertools::Itertools;

use super::{Observation, Observations};
use crate::plan::fitted_blast;

/// Digits of the mark of one observation.
pub(super) const MARK_DIGITS: usize = 8;
/// Digits of the checksum of a file.
const CHECKSUM_DIGITS: usize = 64;

/// How many files were fitted into a plan that keeps `fitted_from`.
pub fn fitted_files(fitted_from: &[String]) -> usize {
    fitted_from.iter().filter(is_checksum).count()
}

/// Whether what a plan keeps is the checksum of a file; the day of a shot may be as long.
fn is_checksum(kept: &&String) -> bool {
    kept.len() == CHECKSUM_DIGITS && !kept.starts_with(SEEN_ON)
}

/// Number of observations of which a plan keeps a mark.
pub fn fitted_values(fitted_from: &[String]) -> usize {
    fitted_from.iter().filter(|kept| kept.len() == MARK_DIGITS).count()
}

/// What stands before the day of a shot.
const SEEN_ON: &str = "seen on ";

/// The day of a shot of an option, as a plan keeps it.
pub(super) fn day(date: &str, option: &str) -> String {
    format!("{SEEN_ON}{date}: {option}")
}

/// How shots of one day are told apart.
const APART: &str = "tell two shots apart by their dates, as `2026-05-04, second shot`";

impl Observations {
    /// What `fitted_from` of a plan keeps of the file that was fitted into it: its checksum, a mark of each observation, and the day of
    /// the shot.
    pub fn kept_in_plan(&self) -> impl Iterator<Item = String> {
        [&self.checksum].into_iter().chain(&self.marks).chain(&self.days).cloned()
    }

    /// The same, with what the file says of charge and stemming.
    pub fn kept_by_fit(&self) -> impl Iterator<Item = String> {
        self.kept_in_plan().chain(fitted_blast::seen(self.head.charge_kg, self.head.stemming_m))
    }

    /// Whether the file, or a shot that it tells, was fitted into a plan that keeps `fitted_from`, and must not be fitted again: a file that
    /// has grown, or of which a standard deviation was changed, tells the same shot.
    pub fn was_fitted(&self, fitted_from: &[String]) -> bool {
        self.is_in(fitted_from, |common, kept| 2 * common > kept.min(self.marks.len()))
    }

    /// Whether most of what it tells was fitted into a plan that keeps `fitted_from`, and lies within by construction. Where a file has
    /// grown by more than it was, that is new.
    pub fn is_mostly_fitted(&self, fitted_from: &[String]) -> bool {
        self.is_in(fitted_from, |common, _| 2 * common > self.marks.len())
    }

    /// Whether one of the files of which `fitted_from` keeps a checksum and marks is this one, or has so many of its marks in common with
    /// it, of so many kept, as is `enough`.
    fn is_in(&self, fitted_from: &[String], enough: impl Fn(usize, usize) -> bool) -> bool {
        // The checksum of each file stands before the marks of its observations.
        let mut fitted = fitted_from.chunk_by(|_, next| !is_checksum(&next));
        fitted.any(|file| {
            let kept = file.iter().filter(|kept| kept.len() == MARK_DIGITS).count();
            let common = self.marks.iter().filter(|mark| file.contains(mark)).count();
            file.contains(&self.checksum) || enough(common, kept)
        })
    }

    /// Whether both tell of one option on one day.
    fn is_of_same_day(&self, other: &Self) -> bool {
        let is_fired_there = |seen: &Observation| other.list.iter().any(|known| known.option == seen.option);
        self.head.date.is_some() && self.head.date == other.head.date && self.list.iter().any(is_fired_there)
    }
}

/// Which file must not be fitted: it tells of a shot with a dud, was fitted into the plan called `plan`, which holds the checksums
/// `fitted_from`, or holds a shot of another file.
pub fn not_to_be_fitted(files: &[Observations], fitted_from: &[String], plan: &str) -> Option<String> {
    if let Some((file, dud)) = files.iter().find_map(|file| Some((file, file.head.dud.as_ref()?))) {
        return Some(format!(
            "{} tells of a shot with a dud ({dud}), which is not the shot of the plan: its tires rose otherwise, and a launch found from them \
             is wrong; leave the file out, and give it to `shelter report --observed`",
            file.path
        ));
    }
    let in_plan = files.iter().find(|file| file.was_fitted(fitted_from));
    let text = |file: &Observations| {
        format!(
            "{} was fitted into {plan} already, or some of it, as its [uncertainty] says: a shot does not count twice; leave the file out, \
             or fit all that was seen of the shot at once, from the plan as it was before",
            file.path
        )
    };
    let on_day = |file: &&Observations| file.days.iter().any(|day| fitted_from.contains(day));
    let of_day = |file: &Observations| {
        format!(
            "{} tells of the same option on the same `# date` as a film that was fitted into {plan} already: {APART}, or fit all that was seen of \
             the shot at once, from the plan as it was before",
            file.path
        )
    };
    let in_plan = in_plan.map(text).or_else(|| files.iter().find(on_day).map(of_day));
    in_plan.or_else(|| named_twice(files))
}

/// Which file holds a shot that another file holds.
pub fn named_twice(files: &[Observations]) -> Option<String> {
    files.iter().tuple_combinations().find_map(|(one, other)| {
        let path = &other.path;
        match () {
            () if one.overlaps(other) => Some(format!(
                "{path} holds mostly the same observations as another file: name each shot once"
            )),
            () if one.is_of_same_day(other) => Some(format!(
                "{path} tells of the same option on the same `# date` as {}: put what was seen of one shot into one file, or {APART}",
                one.path
            )),
            () => None,
        }
    })
}
