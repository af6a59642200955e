//! Heave by energy: part of the explosive's energy becomes motion of the rock, and the cover moves with the rock.
//!
//! 1. Symbols: η the share of the energy that becomes motion, E the energy of the explosive, q the specific charge, ρ the density of the
//!    rock, V the launch velocity.
//! 2. Per volume of rock, q E η = ½ ρ V².
//! 3. So V = √(2 η E q / ρ).
//!
//! Measured shares are 8.5 to 14.8 % for burdens of 0.12 to 0.20 m (Huang 2022, Appl. Sci. 12:6524), and 3 to 21 % at full scale
//! (Sanchidrián et al. 2007). They hold for a free face. Confined rock is slower.

use super::{Blast, Kind, LaunchEstimate, Missing, PERCENT_OF_BOUNDS};
use crate::units;

/// Share η of the energy at the low end, the middle and the high end of the band.
const EFFICIENCY: [f64; 3] = [0.03, 0.10, 0.20];
/// Energy of the explosive [J/kg]: that of ANFO.
const ENERGY: f64 = 3.8e6;
/// Density of the rock [kg/m³].
const ROCK_DENSITY: f64 = 2600.0;
/// Range of specific charges in bench blasting, for which such shares hold [kg/m³].
const SPECIFIC_CHARGE: [f64; 2] = [0.15, 0.60];

/// The launch velocity by energy.
pub fn estimate(blast: &Blast) -> Result<LaunchEstimate, Missing> {
    let charge = blast.specific_charge()?;
    let band = EFFICIENCY.map(|efficiency| (2.0 * efficiency * ENERGY * charge / ROCK_DENSITY).sqrt());
    let [low, high] = SPECIFIC_CHARGE;
    let is_out = !(low..=high).contains(&charge);
    let charge = units::short(charge);
    Ok(LaunchEstimate {
        kind: Kind::Heave,
        name: String::new(),
        band,
        common_percent: PERCENT_OF_BOUNDS,
        out_of_range: is_out
            .then(|| format!("specific charge {charge} kg/m³ is not between {low} and {high}")),
        basis: match blast.is_confined {
            true => format!("{charge} kg/m³, confined: an upper value"),
            false => format!("{charge} kg/m³"),
        },
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Worked numbers of the model: V at η of 3, 10 and 20 % [m/s].
    #[test]
    fn worked_numbers_come_out() {
        for (specific_charge, expected) in [
            (0.15, [3.6, 6.6, 9.4]),
            (0.25, [4.7, 8.5, 12.1]),
            (0.40, [5.9, 10.8, 15.3]),
            (0.60, [7.3, 13.2, 18.7]),
        ] {
            let blast = Blast { specific_charge_kg_m3: Some(specific_charge), ..Blast::default() };
            let found = estimate(&blast).expect("an estimate");
            for (band, expected) in found.band.iter().zip(expected) {
                // The expected numbers have one decimal.
                assert!((band - expected).abs() <= 0.051, "{specific_charge}: {band} {expected}");
            }
            assert!(found.is_valid(), "{specific_charge}");
        }
        for outside in [0.05, 1.5] {
            let blast = Blast { specific_charge_kg_m3: Some(outside), ..Blast::default() };
            assert!(estimate(&blast).is_ok_and(|found| !found.is_valid()), "{outside}");
        }
    }
}
