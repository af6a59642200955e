//! Whether a plan may take what a fit found.

use crate::choice::Unknown;
use crate::plan::observations::Observations;
use crate::study::Case;
use crate::study::fit::{Fit, FittedParameter};
use crate::study::seen::other_shot::{OtherShot, other_shots};

/// Why a plan may not take what a fit found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NotWritable {
    /// It was seen of a shot with another charge, stemming or mass of tires.
    OtherShot(OtherShot),
    /// A check would take an estimate for exact that is known poorly, by its standard deviation.
    TooUnsure(FittedParameter),
    /// The residuals are larger than chance makes them.
    DoesNotExplain,
    /// Another round could move the estimates.
    NotSettled,
    /// An estimate lies at an end of its plausible range.
    AtEnd,
    /// So many separate answers fit nearly as well.
    SeveralAnswers(usize),
}

/// Standard deviation of an estimate without a place in `[uncertainty]`, as a share of it, from which nobody takes it for exact.
const TOO_UNSURE: f64 = 0.1;

impl Fit {
    /// Why the plan of `case` may not take the estimates, which are from these `files`; `None` where it may.
    pub fn not_writable(&self, case: &Case, files: &[Observations]) -> Option<NotWritable> {
        let other = other_shots(case, files).into_iter().find(OtherShot::differs);
        other.map(NotWritable::OtherShot).or_else(|| self.why_no_answer())
    }

    /// Why the fit tells nothing that a plan may take, whatever it was seen of; `None` where it does.
    pub fn why_no_answer(&self) -> Option<NotWritable> {
        let best = &self.answers[0];
        let is_too_unsure = |estimate: &&FittedParameter| {
            let has_no_place = matches!(estimate.parameter.unknown, Unknown::EndStiffness | Unknown::Damping);
            has_no_place && estimate.sd > TOO_UNSURE * estimate.value
        };
        if let Some(unsure) = best.estimates.iter().find(is_too_unsure) {
            return Some(NotWritable::TooUnsure(*unsure));
        }
        match self.answers.len() {
            _ if !best.explains() => Some(NotWritable::DoesNotExplain),
            _ if !best.is_settled => Some(NotWritable::NotSettled),
            _ if best.estimates.iter().any(|estimate| estimate.is_at_end) => Some(NotWritable::AtEnd),
            1 => None,
            count => Some(NotWritable::SeveralAnswers(count)),
        }
    }
}
