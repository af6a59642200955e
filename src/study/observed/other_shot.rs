//! Earlier shots with another charge, stemming or mass of tires than the plan. Such shots had other launches.

use itertools::Itertools;

use crate::plan::fitted_blast::are_alike;
use crate::plan::observations::{Observations, ShotHead};
use crate::study::Case;
use crate::study::launch::Blast;

/// A property of a blast that decides the launch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LaunchCause {
    /// The charge of a hole [kg].
    Charge,
    /// The stemming of a hole [m].
    Stemming,
    /// The mass of a tire [kg].
    TireMass,
}

impl LaunchCause {
    /// Whether `shelter launch` scales a launch to another value of this property.
    pub fn is_scaled(self) -> bool {
        self != Self::TireMass
    }
}

/// A certain or possible difference between an earlier shot and the plan. The difference is only possible if one of them does not state the
/// value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OtherShot {
    /// The property that differs.
    pub cause: LaunchCause,
    /// Its value in the earlier shot [unit of the cause].
    pub then: Option<f64>,
    /// Its value in the plan [unit of the cause].
    pub planned: Option<f64>,
}

impl OtherShot {
    /// Whether both values are known and differ.
    pub fn differs(&self) -> bool {
        self.then.is_some() && self.planned.is_some()
    }
}

/// The certain and possible differences between the plan and the earlier shots of these files, each once.
pub fn other_shots(case: &Case, files: &[Observations]) -> Vec<OtherShot> {
    let blast = Blast::of_plan(&case.plan);
    let holes = case.shots.iter().flat_map(|shot| &shot.firings);
    let launched: Vec<f64> =
        holes.map(|hole| case.scene().mass[hole.tire]).unique_by(|mass| mass.to_bits()).collect();
    let mut others = Vec::new();
    for ShotHead { charge_kg, stemming_m, cover, .. } in files.iter().map(|file| &file.head) {
        let of_cover = cover.as_deref().map_or_else(Vec::new, masses_of_tires);
        let (mass, own) = unlike_masses(&of_cover, &launched);
        for (cause, then, planned) in [
            (LaunchCause::Charge, *charge_kg, blast.charge_kg),
            (LaunchCause::Stemming, *stemming_m, blast.stemming_m),
            (LaunchCause::TireMass, mass, own),
        ] {
            let is_told = match (then, planned) {
                (Some(then), Some(planned)) => !are_alike(then, planned),
                (Some(_), None) => true,
                // A cover that does not name its tires may have others. If there is no cover in the head, the tires count as those of the
                // plan.
                (None, Some(_)) => cause.is_scaled() || cover.is_some(),
                (None, None) => false,
            };
            let other = OtherShot { cause, then, planned };
            if is_told && !others.contains(&other) {
                others.push(other);
            }
        }
    }
    others
}

/// The first two masses [kg] that are not alike, one of the cover and one of a tire over a hole. If all are alike, the first of each list.
fn unlike_masses(of_cover: &[f64], launched: &[f64]) -> (Option<f64>, Option<f64>) {
    let pairs = of_cover.iter().cartesian_product(launched);
    match pairs.into_iter().find(|(then, own)| !are_alike(**then, **own)) {
        Some((then, own)) => (Some(*then), Some(*own)),
        None => (of_cover.first().copied(), launched.first().copied()),
    }
}

/// Masses [kg] in the words of a cover, such as `280 kg tires, 140 kg/m2`. A mass per area is left out.
fn masses_of_tires(cover: &str) -> Vec<f64> {
    let units = ["kg", "кг"].into_iter().flat_map(|unit| cover.match_indices(unit));
    let mass = |(at, unit): (usize, &str)| -> Option<f64> {
        let (before, after) = (cover[..at].trim_end(), &cover[at + unit.len()..]);
        let number = before.rsplit(|sign: char| !sign.is_ascii_digit() && sign != '.').next()?;
        number.parse().ok().filter(|_| !after.trim_start().starts_with('/'))
    };
    units.filter_map(mass).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cover that names the plan's mass and another mass is another cover.
    #[test]
    fn a_cover_of_two_masses_is_that_of_the_other() {
        let text = include_str!("../../../tests/fixtures/amur-three-rows.toml");
        let case =
            Case::new(crate::plan::Plan::parse("", text).unwrap_or_else(|mistakes| panic!("{mistakes}")));
        let mass_seen = |cover: &str| {
            let head = ShotHead { cover: Some(cover.to_owned()), ..ShotHead::default() };
            let file = serde_json::json!({
                "path": "", "checksum": "", "marks": [], "list": [], "firings": [], "head": head,
            });
            let file = serde_json::from_value(file).expect("a file");
            let others = other_shots(&case, &[file]).into_iter();
            others.filter(|other| other.differs()).filter_map(|other| other.then).next()
        };
        assert_eq!(mass_seen("280 kg of chain, tires of 560 kg"), Some(560.0));
        assert_eq!(mass_seen("tires of 280 kg"), None);
    }

    /// A tire over a hole counts with its own mass, whatever `[tire]` says.
    #[test]
    fn a_tire_over_a_hole_has_its_own_mass() {
        let of_cover = |launched: &[f64]| unlike_masses(&[280.0], launched);
        assert_eq!(of_cover(&[280.0]), (Some(280.0), Some(280.0)));
        assert_eq!(of_cover(&[280.0, 140.0]), (Some(280.0), Some(140.0)));
        assert_eq!(unlike_masses(&[], &[140.0]), (None, Some(140.0)));
    }

    #[test]
    fn masses_are_read_in_both_languages_and_not_of_an_area() {
        assert_eq!(masses_of_tires("280 kg tires, 140 kg/m2"), [280.0]);
        assert_eq!(masses_of_tires("шины 560 кг, 140 кг/м²"), [560.0]);
        assert_eq!(masses_of_tires("280 kg of chain, tires of 560 kg"), [280.0, 560.0]);
        assert_eq!(masses_of_tires("tires, heavy"), [0.0; 0]);
    }

    /// A value that only one side states may differ. That always holds for charge and stemming. It holds for tires if the cover does not
    /// name them.
    #[test]
    fn what_only_the_plan_or_only_the_shot_says_may_be_another() {
        let text = include_str!("../../../tests/fixtures/amur-three-rows.toml");
        let mut case =
            Case::new(crate::plan::Plan::parse("", text).unwrap_or_else(|mistakes| panic!("{mistakes}")));
        let others = |case: &Case, heads: &[ShotHead]| {
            let file = |head: &ShotHead| {
                let file = serde_json::json!({
                    "path": "", "checksum": "", "marks": [], "list": [], "firings": [], "head": head,
                });
                serde_json::from_value(file).expect("a file")
            };
            other_shots(case, &heads.iter().map(file).collect::<Vec<_>>())
        };
        let silent = ShotHead::default();
        let heavy = ShotHead { cover: Some("tires, heavy".to_owned()), ..silent.clone() };
        let charged = ShotHead { charge_kg: Some(25.0), ..silent.clone() };
        let other = |cause, then, planned| OtherShot { cause, then, planned };
        let of_tires = other(LaunchCause::TireMass, None, Some(280.0));
        let of_shot = other(LaunchCause::Charge, Some(25.0), None);
        assert_eq!(others(&case, std::slice::from_ref(&silent)), []);
        assert_eq!(others(&case, &[heavy.clone(), charged, heavy]), [of_tires, of_shot], "each once");
        case.plan.launches_mut().for_each(|launch| launch.charge_kg = Some(30.0));
        let of_plan = other(LaunchCause::Charge, None, Some(30.0));
        assert_eq!(others(&case, &[silent]), [of_plan]);
        assert!([of_tires, of_shot, of_plan].iter().all(|other| !other.differs()));
        assert!(other(LaunchCause::Charge, Some(25.0), Some(30.0)).differs());
        assert!(LaunchCause::Charge.is_scaled() && !LaunchCause::TireMass.is_scaled());
    }
}
