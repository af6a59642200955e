//! Speed of fragments that leave the collar of a hole. It is no velocity of the cover, which is heavier and lets gas through.
//!
//! 1. Symbols: v the speed, w the charge over its length [kg/m], St the stemming [m], K a factor from 13.5 (soft rock) to 27 (hard rock).
//! 2. v = K (√w / St)^1.3 (Richards and Moore 2004, for cratering at the collar).
//!
//! The source fitted K to ranges of flyrock and states no range of validity. The range here is that of the impulse at the collar.

use super::{Blast, Kind, LaunchEstimate, Missing, PERCENT_OF_BOUNDS, collar};
use crate::units;

/// K of soft rock and of hard rock.
const SOFT: f64 = 13.5;
const HARD: f64 = 27.0;
const EXPONENT: f64 = 1.3;

/// The speed of rock at the collar, as an estimate.
pub fn estimate(blast: &Blast) -> Result<LaunchEstimate, Missing> {
    let stemming = blast.stemming_m.ok_or(Missing("the stemming"))?;
    let per_metre = blast.charge_per_metre()?;
    let scaled = (per_metre.sqrt() / stemming).powf(EXPONENT);
    let out_of_range = blast.hole_diameter_mm.and_then(|diameter| {
        // The scaled depth is no part of this model, so any value inside the range serves.
        collar::out_of_range(1.0, diameter, stemming)
    });
    Ok(LaunchEstimate {
        kind: Kind::RockSpeed,
        name: String::new(),
        band: [SOFT, (SOFT * HARD).sqrt(), HARD].map(|hardness| hardness * scaled),
        common_percent: PERCENT_OF_BOUNDS,
        out_of_range,
        basis: format!(
            "{} kg/m under {} m of stemming{}",
            units::short(per_metre),
            units::short(stemming),
            blast.assumed_density()
        ),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Worked numbers for soft and hard rock [m/s].
    #[test]
    fn worked_numbers_come_out() {
        for (diameter, stemming, expected) in [
            (76.0, 2.0, [15.0, 29.0]),
            (89.0, 2.5, [13.0, 27.0]),
            (105.0, 3.0, [13.0, 26.0]),
            (105.0, 4.2, [8.5, 17.0]),
            (105.0, 5.0, [7.0, 14.0]),
        ] {
            let blast = Blast {
                hole_diameter_mm: Some(diameter),
                stemming_m: Some(stemming),
                explosive_density: Some(1.0),
                ..Blast::default()
            };
            let band = estimate(&blast).expect("an estimate").band;
            for (found, expected) in [band[0], band[2]].into_iter().zip(expected) {
                // The expected numbers are whole.
                assert!((found - expected).abs() <= 0.5, "{diameter} {stemming}: {found} {expected}");
            }
        }
    }
}
