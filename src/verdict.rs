//! Pass, fail or undecided: the verdict on a value with an error, given a limit. Also the worst of several verdicts.
//!
//! Values, one-sided errors and limits come in; a [`Verdict`] goes out. This module does not know where they come from.
//! `study::judge` has everything else that keeps an option from passing.

use serde::{Deserialize, Serialize};

/// Verdict on a value, a shot or a delay option: whether it keeps its limits.
///
/// Verdicts are ordered from the best to the worst. Several verdicts together give the greatest. If one of several must pass, they
/// give the least.
///
/// The undecided verdict has two words: people read OPEN, scripts read `undecided`. Both words are fixed, because scripts and
/// readers know them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// Value + error is within every limit, and nothing else keeps the shot from passing.
    Pass,
    /// Neither pass nor fail. A value is too near its limit even at the finest step allowed; or the run ends too early, loses
    /// energy or has no result; or the samples do not decide; or a
    /// hole fires under no tire, a confirmation is awaited, the launch is an estimate, or duds are not known.
    Undecided,
    /// Value − error exceeds a limit, a cable breaks, too much fires within 8 ms, or surely more samples fail than accepted.
    Fail,
}

impl Verdict {
    /// The worst of several verdicts; a pass if there are none, which callers rule out.
    pub fn worst(verdicts: impl IntoIterator<Item = Verdict>) -> Verdict {
        verdicts.into_iter().max().unwrap_or(Verdict::Pass)
    }

    /// The verdict as people read it: PASS, OPEN or FAIL.
    pub fn for_people(self) -> &'static str {
        match self {
            Verdict::Pass => "PASS",
            Verdict::Undecided => "OPEN",
            Verdict::Fail => "FAIL",
        }
    }

    /// The verdict as JSON and scripts spell it.
    pub fn for_scripts(self) -> &'static str {
        match self {
            Verdict::Pass => "pass",
            Verdict::Undecided => "undecided",
            Verdict::Fail => "fail",
        }
    }
}

/// Word of a verdict for people. A thin pass has a word of its own, and so has a pass by which nothing may be fired. Scripts read
/// the [`verdict`](VerdictWord::verdict).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum VerdictWord {
    /// A pass.
    Pass,
    /// A pass that ends if a value is a little worse than the plan states.
    Thin,
    /// A pass that does not stand: fire nothing by it.
    Hold,
    /// Neither pass nor fail.
    Open,
    /// A fail.
    Fail,
}

impl VerdictWord {
    /// All words, the best first.
    pub const ALL: [Self; 5] = [Self::Pass, Self::Thin, Self::Hold, Self::Open, Self::Fail];

    /// Verdict of the word. A pass on hold counts as undecided.
    pub fn verdict(self) -> Verdict {
        match self {
            VerdictWord::Pass | VerdictWord::Thin => Verdict::Pass,
            VerdictWord::Hold | VerdictWord::Open => Verdict::Undecided,
            VerdictWord::Fail => Verdict::Fail,
        }
    }

    /// The word as people read it.
    pub fn for_people(self) -> &'static str {
        match self {
            VerdictWord::Thin => "THIN",
            VerdictWord::Hold => "HOLD",
            VerdictWord::Pass | VerdictWord::Open | VerdictWord::Fail => self.verdict().for_people(),
        }
    }

    /// HOLD in place of any pass; other words stay.
    pub fn held(self) -> Self {
        if self.verdict() == Verdict::Pass { VerdictWord::Hold } else { self }
    }
}

impl From<Verdict> for VerdictWord {
    fn from(verdict: Verdict) -> Self {
        match verdict {
            Verdict::Pass => VerdictWord::Pass,
            Verdict::Undecided => VerdictWord::Open,
            Verdict::Fail => VerdictWord::Fail,
        }
    }
}

/// Computed value with its estimated discretisation error, its time, and its tire or cable.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    /// The value [SI unit of the quantity].
    pub value: f64,
    /// Estimated error, one-sided [same unit].
    pub error: f64,
    /// Time at which the value is reached [s].
    pub time: f64,
    /// Index of the tire or cable.
    pub index: usize,
}

impl Estimate {
    /// The same value with its error multiplied by `times`.
    pub fn times_error(self, times: f64) -> Self {
        Self { error: times * self.error, ..self }
    }

    /// Verdict on this value alone, against an upper limit.
    pub fn compare_with(&self, limit: f64) -> Verdict {
        if self.value + self.error <= limit {
            Verdict::Pass
        } else if self.value - self.error > limit {
            Verdict::Fail
        } else {
            Verdict::Undecided
        }
    }
}

/// A quantity that has a limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Flight height [m].
    Height,
    /// Cable force [N].
    Force,
    /// Drift at the end [m].
    Drift,
}

impl Quantity {
    /// All quantities.
    pub const ALL: [Self; 3] = [Self::Height, Self::Force, Self::Drift];
}

/// A value for each quantity.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PerQuantity<T> {
    /// Value for the flight height.
    pub height: T,
    /// Value for the cable force.
    pub force: T,
    /// Value for the drift.
    pub drift: T,
}

impl<T> PerQuantity<T> {
    /// The value that `value` gives for each quantity.
    pub fn from_fn(mut value: impl FnMut(Quantity) -> T) -> Self {
        let [height, force, drift] = Quantity::ALL.map(&mut value);
        Self { height, force, drift }
    }

    /// The value for a quantity.
    pub fn get(&self, quantity: Quantity) -> &T {
        match quantity {
            Quantity::Height => &self.height,
            Quantity::Force => &self.force,
            Quantity::Drift => &self.drift,
        }
    }

    /// The same quantities, with `change` applied to each value.
    pub fn map<U>(&self, mut change: impl FnMut(&T) -> U) -> PerQuantity<U> {
        PerQuantity::from_fn(|quantity| change(self.get(quantity)))
    }

    /// The values, in the order of [`Quantity::ALL`].
    pub fn iter(&self) -> impl Iterator<Item = &T> {
        [&self.height, &self.force, &self.drift].into_iter()
    }
}

/// The limits that an option must keep to pass, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Greatest flight height [m].
    pub height: f64,
    /// Greatest cable force: breaking force in use / safety factor [N].
    pub force: f64,
    /// Greatest drift at the end [m].
    pub drift: Option<f64>,
    /// Breaking force in use [N].
    pub breaking_force: f64,
    /// Accepted share of shots that exceed a limit.
    pub accepted_risk: f64,
    /// Greatest number of holes that fire within any 8 ms.
    pub holes_in_8_ms: Option<usize>,
    /// Heaviest charge that fires within any 8 ms [kg].
    pub charge_in_8_ms: Option<f64>,
}

impl Limits {
    /// Limit of a quantity [its SI unit]; `None` if the quantity has no limit.
    pub fn get(&self, quantity: Quantity) -> Option<f64> {
        match quantity {
            Quantity::Height => Some(self.height),
            Quantity::Force => Some(self.force),
            Quantity::Drift => self.drift,
        }
    }

    /// Utilization: the greatest ratio of a value to its limit. Above 1 the shot fails. A value that is no number counts as the
    /// worst.
    pub fn utilization(&self, value: impl Fn(Quantity) -> f64) -> f64 {
        let shares =
            Quantity::ALL.into_iter().filter_map(|quantity| Some(value(quantity) / self.get(quantity)?));
        shares.fold(0.0, |most, share| if share.is_nan() { f64::INFINITY } else { most.max(share) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scripts_and_people_read_words_of_their_own() {
        let all = [Verdict::Pass, Verdict::Undecided, Verdict::Fail];
        assert_eq!(all.map(Verdict::for_scripts), ["pass", "undecided", "fail"]);
        assert_eq!(all.map(Verdict::for_people), ["PASS", "OPEN", "FAIL"]);
    }

    #[test]
    fn an_error_that_reaches_over_the_limit_leaves_the_verdict_open() {
        let verdict_of = |value, error| Estimate { value, error, ..Estimate::default() }.compare_with(1.0);
        assert_eq!(verdict_of(0.9, 0.1), Verdict::Pass);
        assert_eq!(verdict_of(0.95, 0.1), Verdict::Undecided);
        assert_eq!(verdict_of(1.05, 0.1), Verdict::Undecided);
        assert_eq!(verdict_of(1.2, 0.1), Verdict::Fail);
        assert_eq!(verdict_of(1.25, 0.25), Verdict::Undecided, "it may be the limit itself");
        assert_eq!(verdict_of(f64::NAN, 0.1), Verdict::Undecided);
    }

    /// A shot with an unknown value ranks behind all shots without one, whatever its other values are.
    #[test]
    fn what_is_no_number_uses_the_limits_most() {
        let limits = Limits {
            height: 2.0,
            force: 100.0,
            drift: None,
            breaking_force: 200.0,
            accepted_risk: 0.01,
            holes_in_8_ms: None,
            charge_in_8_ms: None,
        };
        let of = |limits: Limits, values: [f64; 3]| limits.utilization(|quantity| values[quantity as usize]);
        assert_eq!(of(limits, [1.0, 80.0, f64::NAN]), 0.8, "drift has no limit");
        let limits = Limits { drift: Some(1.0), ..limits };
        for unknown in 0..3 {
            let mut values = [1.0, 80.0, 0.9];
            values[unknown] = f64::NAN;
            assert_eq!(of(limits, values), f64::INFINITY);
        }
    }

    #[test]
    fn a_pass_stands_with_many_times_its_error() {
        let estimate = Estimate { value: 0.5, error: 0.25, ..Estimate::default() };
        assert_eq!(estimate.times_error(4.0), Estimate { error: 1.0, ..estimate });
    }

    #[test]
    fn values_stand_in_the_order_of_the_quantities() {
        let values = PerQuantity::from_fn(|quantity| quantity);
        assert!(values.iter().copied().eq(Quantity::ALL));
        assert!(Quantity::ALL.into_iter().all(|quantity| *values.get(quantity) == quantity));
    }

    #[test]
    fn the_worst_of_several_decides() {
        use Verdict::{Fail, Pass, Undecided};
        assert_eq!(Verdict::worst([Pass, Undecided]), Undecided);
        assert_eq!(Verdict::worst([Fail, Undecided, Pass]), Fail);
        assert_eq!(Verdict::worst([]), Pass);
    }
}
