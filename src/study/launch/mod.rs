//! How fast a blast launches its cover: every estimate that a blast plan allows, each with its band, source and range.
//!
//! No published formula leads from charge, burden and stemming to the velocity of a tire. Bounds exist. Observations of a tire or of
//! earlier shots say more. All estimates are listed, and the surest one is chosen.
//!
//! | estimate | where | kind |
//! |---|---|---|
//! | earlier shots at this site, fitted, scaled by charge and stemming | `fits`, `earlier_shots` | an observation of the cover |
//! | a loose test tire | `test_tire` | an observation of one tire |
//! | heave by energy | `heave` | a bound from specific charge; an upper bound if the rock is confined |
//! | impulse at the collar | `collar` | an upper bound from stemming and charge |
//! | speed of the rock | `rock_speed` | a bound for fragments, not for the cover; never chosen |

mod collar;
mod earlier_shots;
mod fits;
mod heave;
mod of_plan;
mod rock_speed;
mod test_tire;
mod to_write;

pub use self::earlier_shots::EarlierShots;
pub use self::fits::{FittedShots, fit_by_charge};
pub use self::of_plan::{fastest_launch, slowest_launch};
pub use self::test_tire::{LEAST_PERCENT as LEAST_PERCENT_OF_TEST_TIRE, Seen, TestTire};
pub use self::to_write::NotWritten;

use crate::sorting::sort_by;

/// Values of a blast plan for one hole and the cover over it; `None` is unknown.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Blast {
    /// Diameter of the hole [mm].
    pub hole_diameter_mm: Option<f64>,
    /// Length of the stemming above the charge [m].
    pub stemming_m: Option<f64>,
    /// Length of the charge [m].
    pub charge_length_m: Option<f64>,
    /// Mass of the charge [kg].
    pub charge_kg: Option<f64>,
    /// Density of the explosive in the hole [g/cm³].
    pub explosive_density: Option<f64>,
    /// Explosive over the volume of rock that it breaks [kg/m³].
    pub specific_charge_kg_m3: Option<f64>,
    /// Burden [m].
    pub burden_m: Option<f64>,
    /// Spacing of the holes in a row [m].
    pub spacing_m: Option<f64>,
    /// Depth of the rock that is broken [m].
    pub bench_m: Option<f64>,
    /// Whether the rock has no free face to move to.
    pub is_confined: bool,
    /// Mass of the cover over its area [kg/m²].
    pub cover_kg_m2: Option<f64>,
}

impl Blast {
    /// Mass of the charge over its length [kg/m].
    fn charge_per_metre(&self) -> Result<f64, Missing> {
        let over_length = self.charge_kg.zip(self.charge_length_m).map(|(charge, length)| charge / length);
        let by_density = || {
            let diameter = self.hole_diameter_mm? * 1e-3;
            let density = self.explosive_density.unwrap_or(USUAL_DENSITY);
            Some(0.25 * std::f64::consts::PI * diameter * diameter * density * 1e3)
        };
        let missing = Missing("the diameter of the hole, or charge with its length");
        over_length.or_else(by_density).ok_or(missing)
    }

    /// Words for an assumed density, if one was assumed. The density changes the velocity by some 17 % at most.
    fn assumed_density(&self) -> &'static str {
        match self.explosive_density.is_none() && self.charge_kg.zip(self.charge_length_m).is_none() {
            true => ", explosive of 1 g/cm³ assumed",
            false => "",
        }
    }

    /// Length of the charge [m].
    fn charge_length(&self) -> Result<f64, Missing> {
        let by_mass = || Some(self.charge_kg? / self.charge_per_metre().ok()?);
        self.charge_length_m.or_else(by_mass).ok_or(Missing("the length of the charge, or its mass"))
    }

    /// Specific charge [kg/m³].
    fn specific_charge(&self) -> Result<f64, Missing> {
        let by_volume = || {
            let charge =
                self.charge_kg.or_else(|| Some(self.charge_per_metre().ok()? * self.charge_length_m?));
            Some(charge? / (self.burden_m? * self.spacing_m? * self.bench_m?))
        };
        let missing = Missing("the specific charge, or charge, burden, spacing and depth of the bench");
        self.specific_charge_kg_m3.or_else(by_volume).ok_or(missing)
    }
}

/// Density of an explosive if nobody states it [g/cm³]. It lies between those of ANFO, 0.85, and of emulsion, 1.15.
const USUAL_DENSITY: f64 = 1.0;

/// A value that an estimate needs but the blast plan does not state, in words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Missing(pub &'static str);

/// Source of an estimate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A fit of earlier shots.
    EarlierShots,
    /// A loose test tire.
    TestTire,
    /// Heave by energy.
    Heave,
    /// Impulse at the collar.
    Collar,
    /// Speed of the rock.
    RockSpeed,
}

impl Kind {
    /// Whether the estimate is an observation, rather than a bound from a blast plan alone.
    pub fn is_observed(self) -> bool {
        matches!(self, Kind::EarlierShots | Kind::TestTire)
    }

    /// Whether the estimate is for the cover. An estimate for the rock alone says nothing about the cover.
    fn is_of_cover(self) -> bool {
        self != Kind::RockSpeed
    }

    /// Whether the cover may be slower than the band without a contradiction.
    fn is_upper_bound(self) -> bool {
        matches!(self, Kind::Collar | Kind::RockSpeed)
    }
}

/// One estimate of the launch velocity.
#[derive(Clone, Debug, PartialEq)]
pub struct LaunchEstimate {
    /// Source of the estimate.
    pub kind: Kind,
    /// Name that distinguishes the estimate from others of its kind, such as a file; empty if there is only one.
    pub name: String,
    /// Low end, middle and high end of the band [m/s]. The band of an observation holds nine in ten. The band of a bound is the one that
    /// its source states.
    pub band: [f64; 3],
    /// Coefficient of variation of the launch velocity if this estimate is chosen [%].
    pub common_percent: f64,
    /// Why the estimate does not hold here; `None` if it is in the range for which it was made.
    pub out_of_range: Option<String>,
    /// Basis of the estimate in numbers: a scaled depth of burial, a specific charge.
    pub basis: String,
}

impl LaunchEstimate {
    /// Whether the estimate is in the range for which it was made.
    pub fn is_valid(&self) -> bool {
        self.out_of_range.is_none()
    }
}

/// Coefficient of variation of a launch velocity if only bounds are known [%].
pub const PERCENT_OF_BOUNDS: f64 = 50.0;

/// Standard normal deviate at the ends of a band that holds nine in ten.
const NINE_IN_TEN: f64 = 1.645;

/// Band of an observation: nine in ten of a lognormal distribution with this median and coefficient of variation [%].
fn band_of(median: f64, percent: f64) -> [f64; 3] {
    let factor = (NINE_IN_TEN * (percent * 1e-2).powi(2).ln_1p().sqrt()).exp();
    [median / factor, median, median * factor]
}

/// All estimates for a blast, and the values that further estimates need.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LaunchEstimates {
    /// The estimates: first the observations, the surest of them first, then the bounds.
    pub all: Vec<LaunchEstimate>,
    /// Estimates that the blast plan does not allow, each with the missing value.
    pub missing: Vec<(Kind, Missing)>,
}

impl LaunchEstimates {
    /// Makes every possible estimate.
    pub fn new(blast: &Blast, test_tire: Option<&TestTire>, earlier: &[EarlierShots]) -> Self {
        let mut all: Vec<LaunchEstimate> = earlier.iter().map(|shots| shots.estimate(blast)).collect();
        all.extend(test_tire.map(TestTire::estimate));
        sort_by(&mut all, |a, b| a.common_percent.total_cmp(&b.common_percent));
        let mut missing = Vec::new();
        for (kind, estimate) in [
            (Kind::Heave, heave::estimate(blast)),
            (Kind::Collar, collar::estimate(blast)),
            (Kind::RockSpeed, rock_speed::estimate(blast)),
        ] {
            match estimate {
                Ok(estimate) => all.push(estimate),
                Err(what) => missing.push((kind, what)),
            }
        }
        Self { all, missing }
    }

    /// The estimate to take: the surest observation. Without one, the bound for the cover with the fastest middle, among those in their
    /// range, because that is the safe side. `None` if there is no estimate.
    pub fn chosen(&self) -> Option<&LaunchEstimate> {
        let valid = || self.all.iter().filter(|estimate| estimate.is_valid() && estimate.kind.is_of_cover());
        let observed = valid().find(|estimate| estimate.kind.is_observed());
        observed.or_else(|| valid().max_by(|a, b| a.band[1].total_cmp(&b.band[1])))
    }

    /// Pairs of estimates in their range whose bands do not meet. A cover slower than an upper bound agrees with that bound.
    pub fn disagreements(&self) -> Vec<[&LaunchEstimate; 2]> {
        let valid: Vec<&LaunchEstimate> = self.all.iter().filter(|estimate| estimate.is_valid()).collect();
        let pairs = itertools::Itertools::tuple_combinations(valid.into_iter());
        let disagree = |slow: &LaunchEstimate, fast: &LaunchEstimate| {
            slow.band[2] < fast.band[0] && !fast.kind.is_upper_bound()
        };
        pairs.filter(|(a, b)| disagree(a, b) || disagree(b, a)).map(|(a, b)| [a, b]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A hole of 105 mm, with 3 m of stemming, under 140 kg/m².
    fn blast() -> Blast {
        Blast {
            hole_diameter_mm: Some(105.0),
            stemming_m: Some(3.0),
            charge_length_m: Some(2.0),
            explosive_density: Some(1.0),
            specific_charge_kg_m3: Some(0.25),
            cover_kg_m2: Some(140.0),
            ..Blast::default()
        }
    }

    fn test_tire(height: f64) -> TestTire {
        TestTire { seen: Seen::Height { height, sd: 0.1 }, gravity: 9.81 }
    }

    #[test]
    fn an_observation_is_chosen_before_any_bound_and_bounds_by_the_fastest_middle() {
        let bounds = LaunchEstimates::new(&blast(), None, &[]);
        assert_eq!(bounds.chosen().map(|chosen| chosen.kind), Some(Kind::Collar));
        assert_eq!(bounds.chosen().map(|chosen| chosen.common_percent), Some(PERCENT_OF_BOUNDS));
        let tire = test_tire(1.83);
        let both = LaunchEstimates::new(&blast(), Some(&tire), &[]);
        assert_eq!(both.chosen().map(|chosen| chosen.kind), Some(Kind::TestTire));
        let shots = EarlierShots { speed: 6.0, percent: 4.0, ..EarlierShots::default() };
        let all = LaunchEstimates::new(&blast(), Some(&tire), &[shots]);
        assert_eq!(all.chosen().map(|chosen| chosen.kind), Some(Kind::EarlierShots));
    }

    /// Without a specific charge, or the values for it, heave is missing. Without stemming, the impulse at the collar and the rock speed
    /// are missing, too.
    #[test]
    fn an_estimate_that_lacks_a_number_says_which() {
        let found = LaunchEstimates::new(&Blast::default(), None, &[]);
        assert!(found.all.is_empty() && found.chosen().is_none());
        let kinds: Vec<Kind> = found.missing.iter().map(|(kind, _)| *kind).collect();
        assert_eq!(kinds, [Kind::Heave, Kind::Collar, Kind::RockSpeed]);
        let by_volume = Blast {
            charge_kg: Some(10.0),
            burden_m: Some(2.5),
            spacing_m: Some(2.0),
            bench_m: Some(8.0),
            ..Blast::default()
        };
        assert_eq!(by_volume.specific_charge(), Ok(0.25));
    }

    /// The speed of rock says nothing about the cover, so it is not chosen even if alone. An estimate out of its range is not chosen,
    /// either.
    #[test]
    fn what_says_nothing_of_the_cover_is_not_chosen() {
        let no_cover = Blast { cover_kg_m2: None, specific_charge_kg_m3: None, ..blast() };
        let found = LaunchEstimates::new(&no_cover, None, &[]);
        assert_eq!(found.all.iter().map(|estimate| estimate.kind).collect::<Vec<_>>(), [Kind::RockSpeed]);
        assert!(found.chosen().is_none());
        let deep = Blast { stemming_m: Some(5.0), specific_charge_kg_m3: None, ..blast() };
        let found = LaunchEstimates::new(&deep, None, &[]);
        assert!(found.chosen().is_none(), "{found:?}");
    }

    /// A tire that flew at 2 m/s contradicts heave of 4.7 to 12.1 m/s, but no upper bound. A tire that flew at 40 m/s contradicts all three
    /// estimates.
    #[test]
    fn estimates_whose_bands_do_not_meet_are_named() {
        let slow = test_tire(0.2);
        let found = LaunchEstimates::new(&blast(), Some(&slow), &[]);
        let kinds: Vec<[Kind; 2]> =
            found.disagreements().iter().map(|pair| pair.map(|estimate| estimate.kind)).collect();
        assert_eq!(kinds, [[Kind::TestTire, Kind::Heave]]);
        let fast = test_tire(80.0);
        assert_eq!(LaunchEstimates::new(&blast(), Some(&fast), &[]).disagreements().len(), 3);
    }
}
