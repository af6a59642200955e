//! Launch velocity from a fit of earlier shots at this site, for a shot with another charge or stemming.
//!
//! 1. Symbols: V the launch velocity, r the ratio of the plan's charge or stemming to that of the earlier shots, a and b the least and
//!    greatest exponent of V in r.
//! 2. No law says how the velocity of a cover follows its charge. The estimates of a blast plan bound the exponent. For the charge it is ½
//!    (heave), 0.65 (rock speed) or about 1.1 (impulse at the collar). For the stemming it is 0, −1.3 or about −3.3.
//! 3. V is scaled by the middle of each range, so by r^((a + b)/2).
//! 4. The exponent is uniform in its range. So it adds (ln r · (b − a))²/12 to the variance of ln V.

use super::{Blast, Kind, LaunchEstimate, PERCENT_OF_BOUNDS, band_of};
use crate::units;

/// Least and greatest exponent of V in charge and in stemming.
const OF_CHARGE: [f64; 2] = [0.5, 1.1];
const OF_STEMMING: [f64; 2] = [-3.3, 0.0];

/// Greatest ratio of charges or stemmings for which a shot counts as in range.
const MOST_RATIO: f64 = 1.5;

/// The launch velocity from a fit of earlier shots.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EarlierShots {
    /// The files, or other words for the shots.
    pub name: String,
    /// Fastest launch velocity of the plan after the fit [m/s].
    pub speed: f64,
    /// Coefficient of variation of the velocity [%], without the scatter from shot to shot.
    pub percent: f64,
    /// Charge of the holes [kg]; `None` if as in the plan.
    pub charge_kg: Option<f64>,
    /// Stemming of the holes [m]; `None` if as in the plan.
    pub stemming_m: Option<f64>,
}

/// Ratio of the plan's value to that of the earlier shots, with the exponents of V in it.
struct Scaled {
    what: &'static str,
    ratio: f64,
    exponents: [f64; 2],
}

impl EarlierShots {
    /// The launch velocity for the plan's blast, as an estimate.
    pub fn estimate(&self, blast: &Blast) -> LaunchEstimate {
        let scaled = |what, own: Option<f64>, then: Option<f64>, exponents| {
            let ratio = own.zip(then).map_or(1.0, |(own, then)| own / then);
            Scaled { what, ratio, exponents }
        };
        let all = [
            scaled("charge", blast.charge_kg, self.charge_kg, OF_CHARGE),
            scaled("stemming", blast.stemming_m, self.stemming_m, OF_STEMMING),
        ];
        let (mut speed, mut variance) = (self.speed, (self.percent * 1e-2).powi(2).ln_1p());
        for Scaled { ratio, exponents: [low, high], .. } in &all {
            speed *= ratio.powf(0.5 * (low + high));
            variance += (ratio.ln() * (high - low)).powi(2) / 12.0;
        }
        let percent = 1e2 * variance.exp_m1().sqrt();
        let far = all.iter().find(|Scaled { ratio, .. }| !(1.0 / MOST_RATIO..=MOST_RATIO).contains(ratio));
        let out_of_range = far.map(|Scaled { what, ratio, .. }| {
            format!("the {what} is {} times that of these shots", units::rounded(*ratio, 2))
        });
        let changed = all.iter().filter(|Scaled { ratio, .. }| (ratio - 1.0).abs() > 1e-9);
        let changed: Vec<String> = changed
            .map(|Scaled { what, ratio, .. }| {
                format!(", scaled to {} times the {what}", units::rounded(*ratio, 2))
            })
            .collect();
        LaunchEstimate {
            kind: Kind::EarlierShots,
            name: self.name.clone(),
            band: band_of(speed, percent),
            // Out of its range the estimate is not chosen, and says no more than a bound.
            common_percent: if out_of_range.is_some() { percent.max(PERCENT_OF_BOUNDS) } else { percent },
            out_of_range,
            basis: format!(
                "{} m/s found{}",
                units::value_and_sd(self.speed, 1e-2 * self.percent * self.speed),
                changed.concat()
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shots() -> EarlierShots {
        EarlierShots {
            speed: 6.0,
            percent: 3.0,
            charge_kg: Some(10.0),
            stemming_m: Some(3.0),
            ..EarlierShots::default()
        }
    }

    /// The same charge changes nothing. A greater charge launches faster and makes the velocity less sure. A charge far off is out of
    /// range.
    #[test]
    fn another_charge_is_scaled_and_less_sure() {
        let with = |charge_kg, stemming_m| {
            shots().estimate(&Blast {
                charge_kg: Some(charge_kg),
                stemming_m: Some(stemming_m),
                ..Blast::default()
            })
        };
        let same = with(10.0, 3.0);
        assert!((same.band[1] - 6.0).abs() < 1e-12 && (same.common_percent - 3.0).abs() < 1e-9, "{same:?}");
        let more = with(12.0, 3.0);
        // V grows by (12/10)^0.8. The exponent adds ln 1.2 · 0.6/√12 = 3.16 % to the uncertainty.
        assert!((more.band[1] - 6.0 * 1.2_f64.powf(0.8)).abs() < 1e-9);
        assert!((more.common_percent - 4.36).abs() < 0.02, "{}", more.common_percent);
        let less_stemming = with(10.0, 2.5);
        assert!(less_stemming.band[1] > 6.0 && less_stemming.common_percent > 15.0, "{less_stemming:?}");
        assert!(!with(16.0, 3.0).is_valid() && with(16.0, 3.0).common_percent >= PERCENT_OF_BOUNDS);
    }

    #[test]
    fn what_neither_says_is_taken_as_the_same() {
        let found = shots().estimate(&Blast::default());
        assert!((found.common_percent - 3.0).abs() < 1e-9 && found.is_valid());
    }
}
