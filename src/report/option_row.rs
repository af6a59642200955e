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
    /// What a search made the option of.
    pub schedule: Option<&'a Schedule>,
}

/// A row for every option of a case.
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

    /// A cell of the shot as planned; nothing where there is no result.
    pub fn as_planned<C: Into<Cell>>(&self, cell: impl FnOnce(&CheckedShot) -> C) -> Cell {
        self.judged(|judged| cell(&judged.checked))
    }

    /// A cell of the samples; nothing where there are none.
    pub fn sampled<C: Into<Cell>>(&self, cell: impl FnOnce(&SampledShot) -> C) -> Cell {
        self.judged(|judged| judged.sampled.known().map(cell))
    }

    /// What fires together in the shot as planned.
    pub fn together(&self) -> WithinEightMs {
        WithinEightMs::of(self.case, self.shot)
    }

    /// The verdict; a pass is thin where the shot as planned tells it.
    pub fn verdict(&self) -> VerdictWord {
        self.result.as_ref().map_or(VerdictWord::Open, |judged| judged.word(None))
    }
}
