//! The numbers that a study keeps of each checked shot.

use serde::{Deserialize, Deserializer, Serialize};

use super::check::CheckedShot;
use super::cover::Cover;
use crate::verdict::{Estimate, Limits, PerQuantity, Quantity, Verdict};

/// A computed value and its estimated error, one-sided, both in the same SI unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ValueWithError {
    /// The value.
    #[serde(deserialize_with = "or_infinite")]
    pub value: f64,
    /// The error; infinite if it is unknown.
    #[serde(deserialize_with = "or_infinite")]
    pub error: f64,
}

/// Reads null as infinity: JSON has no infinity and writes null instead.
pub(in crate::study) fn or_infinite<'d, D: Deserializer<'d>>(from: D) -> Result<f64, D::Error> {
    Option::<f64>::deserialize(from).map(|value| value.unwrap_or(f64::INFINITY))
}

impl ValueWithError {
    /// Value of a run that failed: unknown, so infinite.
    const UNKNOWN: Self = Self { value: f64::INFINITY, error: f64::INFINITY };
}

impl From<Estimate> for ValueWithError {
    fn from(Estimate { value, error, .. }: Estimate) -> Self {
        Self { value, error }
    }
}

/// Verdict and greatest values of a checked shot.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ShotSummary {
    /// Pass, fail or undecided.
    pub verdict: Verdict,
    /// Greatest flight height [m], cable force [N], and drift at the end [m].
    #[serde(flatten)]
    pub values: PerQuantity<ValueWithError>,
    /// The cover over each hole as it fires.
    pub cover: Cover,
}

impl ShotSummary {
    /// The shot of a run that failed: undecided, with infinite values.
    pub const FAILED_RUN: Self = Self {
        verdict: Verdict::Undecided,
        values: PerQuantity {
            height: ValueWithError::UNKNOWN,
            force: ValueWithError::UNKNOWN,
            drift: ValueWithError::UNKNOWN,
        },
        cover: Cover::NONE,
    };

    /// The numbers of a checked shot.
    pub fn of(checked: &CheckedShot) -> Self {
        Self::new(checked.verdict, &checked.estimates, checked.cover)
    }

    /// The summary of a verdict, its values and the cover.
    pub fn new(verdict: Verdict, estimates: &PerQuantity<Estimate>, cover: Cover) -> Self {
        Self { verdict, values: estimates.map(|&estimate| estimate.into()), cover }
    }

    /// The same shot with `times` every error added to its value, and no error left; ±∞ if the error is unknown.
    pub fn with_errors(&self, times: f64) -> Self {
        let add = |&ValueWithError { value, error }: &ValueWithError| {
            let more = times * error;
            ValueWithError { value: if more.is_infinite() { more } else { value + more }, error: 0.0 }
        };
        Self { values: self.values.map(add), ..*self }
    }

    /// The same shot with unknown errors set to 0: the values that a run with an early end has shown until then.
    pub fn as_far_as_shown(&self) -> Self {
        let shown =
            |quantity: &ValueWithError| match quantity.value.is_finite() && quantity.error.is_infinite() {
                true => ValueWithError { error: 0.0, ..*quantity },
                false => *quantity,
            };
        Self { values: self.values.map(shown), ..*self }
    }

    /// Utilization: the greatest value over its limit. Above 1 the shot fails.
    pub fn utilization(&self, limits: &Limits) -> f64 {
        limits.utilization(|quantity| self.get(quantity).value)
    }

    /// The value of a quantity and its error.
    pub fn get(&self, quantity: Quantity) -> ValueWithError {
        *self.values.get(quantity)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_that_are_unknown_survive_a_file() {
        let text = serde_json::to_string(&ShotSummary::FAILED_RUN).expect("JSON");
        assert_eq!(serde_json::from_str::<ShotSummary>(&text).expect("read again"), ShotSummary::FAILED_RUN);
    }
}
