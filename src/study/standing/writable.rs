//! Whether a plan may take the estimates of a fit.

use crate::choice::Unknown;
use crate::plan::observations::Observations;
use crate::study::Case;
use crate::study::fit::{Fit, FittedParameter};
use crate::study::observed::other_shot::{OtherShot, other_shots};

/// Why a plan may not take the estimates of a fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NotWritable {
    /// The observed shot had another charge, stemming or mass of tires.
    OtherShot(OtherShot),
    /// The standard deviation of an estimate is large, but a check would take the estimate as exact.
    TooUnsure(FittedParameter),
    /// The residuals are larger than chance explains.
    DoesNotExplain,
    /// The estimates are not final: another round could move them.
    NotSettled,
    /// An estimate lies at an end of its plausible range.
    AtEnd,
    /// So many separate answers fit nearly as well.
    SeveralAnswers(usize),
}

/// Relative standard deviation from which an estimate is too unsure. This counts for unknowns without a place in `[uncertainty]`, because a
/// check takes those as exact.
const TOO_UNSURE: f64 = 0.1;

impl Fit {
    /// Why the plan of `case` may not take the estimates from these `files`; `None` if it may.
    pub fn not_writable(&self, case: &Case, files: &[Observations]) -> Option<NotWritable> {
        let other = other_shots(case, files).into_iter().find(OtherShot::differs);
        other.map(NotWritable::OtherShot).or_else(|| self.why_no_answer())
    }

    /// Why the fit gives no answer that a plan may take, whatever shots were observed; `None` if it gives one.
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
            _ if !best.is_converged => Some(NotWritable::NotSettled),
            _ if best.estimates.iter().any(|estimate| estimate.is_at_end) => Some(NotWritable::AtEnd),
            1 => None,
            count => Some(NotWritable::SeveralAnswers(count)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::fit::Answer;
    use crate::study::fit::parameter::Parameter;
    use crate::study::standing::tests::case;

    fn estimate(unknown: Unknown, sd: f64) -> FittedParameter {
        let parameter = Parameter { unknown, row: None };
        FittedParameter { parameter, value: 2.0, sd, was: Some(2.0), from_stated: None, is_at_end: false }
    }

    /// A final answer that explains the observations.
    fn answer(estimates: &[FittedParameter]) -> Answer {
        let estimates = estimates.to_vec();
        Answer { estimates, chi_square: 1.0, is_converged: true, freedom: 1, ..Answer::default() }
    }

    fn fit(answers: &[Answer]) -> Fit {
        Fit { answers: answers.to_vec(), ..Fit::default() }
    }

    #[test]
    fn a_plan_takes_one_settled_answer_that_explains_what_was_seen_and_lies_within_its_range() {
        let launch = estimate(Unknown::Launch, 0.5);
        let sound = answer(&[launch]);
        assert_eq!(fit(std::slice::from_ref(&sound)).why_no_answer(), None);
        let at_end = FittedParameter { is_at_end: true, ..launch };
        for (answers, why) in [
            (vec![Answer { chi_square: 99.0, ..sound.clone() }], NotWritable::DoesNotExplain),
            (vec![Answer { is_converged: false, ..sound.clone() }], NotWritable::NotSettled),
            (vec![answer(&[launch, at_end])], NotWritable::AtEnd),
            (vec![sound.clone(), sound.clone()], NotWritable::SeveralAnswers(2)),
        ] {
            assert_eq!(fit(&answers).why_no_answer(), Some(why));
        }
    }

    /// A tenth of the estimate is not too unsure. Only end stiffness and damping have no place in `[uncertainty]`.
    #[test]
    fn an_estimate_without_a_place_in_the_uncertainty_is_known_to_a_tenth() {
        for unknown in [Unknown::EndStiffness, Unknown::Damping, Unknown::Launch] {
            let why =
                |sd| fit(&[answer(&[estimate(Unknown::Launch, 0.5), estimate(unknown, sd)])]).why_no_answer();
            let unsure =
                Some(NotWritable::TooUnsure(estimate(unknown, 0.21))).filter(|_| unknown != Unknown::Launch);
            assert_eq!([why(0.2), why(0.21)], [None, unsure], "{unknown:?}");
        }
    }

    #[test]
    fn estimates_of_other_tires_are_not_for_the_plan() {
        let seen_under = |cover: &str| -> Vec<Observations> {
            let file = serde_json::json!({
                "path": "", "checksum": "", "marks": [], "list": [], "firings": [], "head": { "cover": cover },
            });
            vec![serde_json::from_value(file).expect("a file")]
        };
        let why = |cover, answer: Answer| fit(&[answer]).not_writable(&case(), &seen_under(cover));
        let sound = answer(&[]);
        assert_eq!(why("tires of 280 kg", sound.clone()), None);
        assert!(matches!(why("tires of 560 kg", sound.clone()), Some(NotWritable::OtherShot(_))));
        let unsettled = Answer { is_converged: false, ..sound };
        assert_eq!(why("tires of 280 kg", unsettled), Some(NotWritable::NotSettled));
    }
}
