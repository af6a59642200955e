//! A delay option and its result, as a row of a table.

use super::parts::Cell;
use crate::plan::DelayOption;
use crate::scene::Shot;
use crate::study::as_planned::check::CheckedShot;
use crate::study::eight_ms::WithinEightMs;
use crate::study::judge::Judgement;
use crate::study::judge::OptionResults;
use crate::study::samples::sampled_shot::SampledShot;
use crate::study::search::Schedule;
use crate::study::{Case, NoResult};
use crate::verdict::VerdictWord;

/// A delay option and its result.
pub struct OptionRow<'a> {
    pub case: &'a Case,
    pub delay: &'a DelayOption,
    pub shot: &'a Shot,
    pub result: &'a Result<Judgement, NoResult>,
    /// Schedule of the option, where a search made the option.
    pub schedule: Option<&'a Schedule>,
}

/// One row per option of a case.
pub fn option_rows<'a>(
    case: &'a Case,
    results: &'a OptionResults,
) -> impl Iterator<Item = OptionRow<'a>> + Clone {
    let options = case.plan.delays.iter().zip(&case.shots).zip(results);
    options.map(move |((delay, shot), result)| OptionRow { case, delay, shot, result, schedule: None })
}

impl OptionRow<'_> {
    /// A cell of the judgement; nothing where there is no result.
    pub fn judged<C: Into<Cell>>(&self, cell: impl FnOnce(&Judgement) -> C) -> Cell {
        self.result.as_ref().ok().map(cell).into()
    }

    /// A cell of the planned shot; nothing where there is no result.
    pub fn as_planned<C: Into<Cell>>(&self, cell: impl FnOnce(&CheckedShot) -> C) -> Cell {
        self.judged(|judged| cell(&judged.checked))
    }

    /// A cell of the samples; nothing where there are none.
    pub fn sampled<C: Into<Cell>>(&self, cell: impl FnOnce(&SampledShot) -> C) -> Cell {
        self.judged(|judged| judged.sampled.known().map(cell))
    }

    /// Holes and charge that fire together in the planned shot.
    pub fn together(&self) -> WithinEightMs {
        WithinEightMs::of(self.case, self.shot)
    }

    /// The verdict. A pass is THIN where the planned shot or one dud shows that.
    pub fn verdict(&self) -> VerdictWord {
        self.result.as_ref().map_or(VerdictWord::Open, |judged| judged.word(None))
    }
}
