//! Entries in `fitted_from` of a plan about the files that were fitted, and the check that no file is fitted twice: a shot that counts
//! twice looks surer than it is.

use itertools::Itertools;

use super::{Observation, Observations};
use crate::plan::fitted_blast;

/// Number of digits in the mark of one observation.
pub(super) const MARK_DIGITS: usize = 8;
/// Number of digits in the checksum of a file.
const CHECKSUM_DIGITS: usize = 64;

/// Number of files that were fitted into a plan with these `fitted_from`.
pub fn fitted_files(fitted_from: &[String]) -> usize {
    fitted_from.iter().filter(is_checksum).count()
}

/// Whether an entry of `fitted_from` is the checksum of a file. The entry for the day of a shot may be as long.
fn is_checksum(kept: &&String) -> bool {
    kept.len() == CHECKSUM_DIGITS && !kept.starts_with(SEEN_ON)
}

/// Number of observations whose marks `fitted_from` holds.
pub fn fitted_values(fitted_from: &[String]) -> usize {
    fitted_from.iter().filter(|kept| kept.len() == MARK_DIGITS).count()
}

/// Beginning of the entry for the day of a shot.
const SEEN_ON: &str = "seen on ";

/// Entry of `fitted_from` for the day on which an option was fired.
pub(super) fn day(date: &str, option: &str) -> String {
    format!("{SEEN_ON}{date}: {option}")
}

/// Advice on how to distinguish two shots of one day.
const APART: &str = "tell two shots apart by their dates, as `2026-05-04, second shot`";

impl Observations {
    /// Entries of `fitted_from` for a file that was fitted: its checksum, a mark of each observation, and the day of the shot.
    pub fn kept_in_plan(&self) -> impl Iterator<Item = String> {
        [&self.checksum].into_iter().chain(&self.marks).chain(&self.days).cloned()
    }

    /// Entries of `fitted_from` as in `kept_in_plan`, and the charge and stemming that the file states.
    pub fn kept_by_fit(&self) -> impl Iterator<Item = String> {
        self.kept_in_plan().chain(fitted_blast::seen(self.head.charge_kg, self.head.stemming_m))
    }

    /// Whether the file, or a shot in it, was fitted into a plan with these `fitted_from`, and must not be fitted again. A file that has
    /// grown, or has another standard deviation, still holds the same shot.
    pub fn was_fitted(&self, fitted_from: &[String]) -> bool {
        self.is_in(fitted_from, |common, kept| 2 * common > kept.min(self.marks.len()))
    }

    /// Whether most observations of the file were fitted into a plan with these `fitted_from`. Such observations agree with the plan by
    /// construction. A file that has at least doubled since the fit counts as new.
    pub fn is_mostly_fitted(&self, fitted_from: &[String]) -> bool {
        self.is_in(fitted_from, |common, _| 2 * common > self.marks.len())
    }

    /// Whether `fitted_from` holds this file: the same checksum, or enough of the same marks. `enough` gets the number of common marks, and
    /// the number of marks that `fitted_from` holds of one file.
    fn is_in(&self, fitted_from: &[String], enough: impl Fn(usize, usize) -> bool) -> bool {
        // The checksum of each file stands before the marks of its observations.
        let mut fitted = fitted_from.chunk_by(|_, next| !is_checksum(&next));
        fitted.any(|file| {
            let kept = file.iter().filter(|kept| kept.len() == MARK_DIGITS).count();
            let common = self.marks.iter().filter(|mark| file.contains(mark)).count();
            file.contains(&self.checksum) || enough(common, kept)
        })
    }

    /// Whether both files hold observations of one option on one day.
    fn is_of_same_day(&self, other: &Self) -> bool {
        let is_fired_there = |seen: &Observation| other.list.iter().any(|known| known.option == seen.option);
        self.head.date.is_some() && self.head.date == other.head.date && self.list.iter().any(is_fired_there)
    }
}

/// Message about a file that must not be fitted; `None` if all files may be. A file must not be fitted if its shot had a dud, if the file
/// or the day of its shot is in `fitted_from` of the plan called `plan`, or if another file holds the same shot.
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

/// Message about a file with the same shot as another file; `None` if there is none.
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
