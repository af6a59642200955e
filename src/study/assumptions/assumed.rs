//! Assumptions: what a plan takes as known, and the values of each that are tried.
//!
//! Every value has a `ratio`, which says how bad the value is compared with the plan:
//!
//! - for a spread, the spread over that of the plan;
//! - for a range, the distance of its moved ends from the plan's value over that distance in the plan;
//! - for a fixed deviation (launch velocity, place of the shelter), the deviation over its standard deviation in the plan;
//! - for a depth that shrinks, the depth of the plan over the depth.
//!
//! So 1 is as the plan states, and 2 is twice as bad.

use nalgebra::Vector2;

use crate::plan::keys::{Key, uncertainty};
use crate::plan::{Plan, Uncertainty};
use crate::scene::{ASSUMED_PUSH_DEPTH, Firing, Shot, direction_of_slope};
use crate::sorting::sort_by;
use crate::study::Case;
use crate::study::as_planned::margin::THIN_LAUNCH;
use crate::study::hole_places::place_of_hole;
use crate::study::judge::next_tires::under_tire;
use crate::study::samples::random_shot::nearest_tire;

/// A key of `[uncertainty]` that holds one number: a spread, or a probability.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spread {
    /// Launch velocities, hole by hole.
    LaunchByHole,
    /// Launch velocities, row by row.
    LaunchByRow,
    /// All launch velocities at once.
    LaunchCommon,
    /// All launch velocities, from shot to shot.
    LaunchBetweenShots,
    /// Launch directions, hole by hole.
    Tilt,
    /// Launch directions of the whole shot.
    TiltCommon,
    /// Places of holes, one by one.
    HolePosition,
    /// Place of the shelter over all holes.
    PatternOffset,
    /// Holes that do not fire.
    Duds,
    /// Lengths of cables as tied.
    CableLength,
    /// Masses, tire by tire.
    TireMass,
    /// Breaking forces, cable by cable.
    BreakingForce,
    /// Firing times, whatever the delay.
    DelayTime,
    /// Firing times, as a share of the delay.
    DelayShare,
}

/// A key of `[uncertainty]` that holds a range. Its value is the same in the whole shot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ranged {
    /// Friction under the tires.
    Friction,
    /// Slack of the cables.
    Slack,
    /// Axial stiffness of the rope.
    AxialStiffness,
    /// Exponent of the mass law.
    MassExponent,
}

/// Which end of a range moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Both ends, away from the value of the plan.
    Both,
    /// The lower end.
    Low,
    /// The upper end.
    High,
}

/// A direction along an axis of the plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Toward {
    /// +x.
    PlusX,
    /// −x.
    MinusX,
    /// +y.
    PlusY,
    /// −y.
    MinusY,
}

/// An assumption: something that a plan takes as known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Assumed {
    /// All launch velocities: a common factor on them.
    LaunchVelocity,
    /// Distance of the shelter from its place over the holes [m], in a direction.
    Place(Toward),
    /// The least depth from which any hole pushes [m].
    PushDepth,
    /// The spread of something, in the unit of its key.
    Spread(Spread),
    /// The range of something, in the unit of its key: half its width if both ends move, else the end that moves.
    Range(Ranged, Side),
}

/// A value to try.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rung {
    /// The value, as [`Assumed`] defines it.
    pub value: f64,
    /// How bad the value is compared with the plan.
    pub ratio: f64,
}

/// Factors on the plan's values.
pub(super) const FACTORS: [f64; 10] = [1.25, 1.6, 2.0, 2.5, 3.2, 4.0, 5.0, 6.3, 8.0, 10.0];
/// Rises of all launch velocities [%].
const RISES: [f64; 18] =
    [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 13.0, 16.0, 20.0, 25.0, 30.0, 40.0, 50.0, 65.0, 80.0, 100.0];
/// Distances of the shelter from its place [m]. They are tried up to the first that is at least the distance between tied tires.
const DISTANCES: [f64; 18] =
    [0.02, 0.03, 0.05, 0.07, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 5.0, 7.0, 10.0];

/// Least spread of each unit for the factors. Nobody knows these values better.
const LEAST_PERCENT: f64 = 0.5;
const LEAST_DEGREES: f64 = 0.25;
const LEAST_METRES: f64 = 0.01;
const LEAST_DUDS_PERCENT: f64 = 0.01;
const LEAST_MILLISECONDS: f64 = 0.1;

impl Spread {
    const ALL: [Spread; 14] = [
        Spread::LaunchByHole,
        Spread::LaunchByRow,
        Spread::LaunchCommon,
        Spread::LaunchBetweenShots,
        Spread::Tilt,
        Spread::TiltCommon,
        Spread::HolePosition,
        Spread::PatternOffset,
        Spread::Duds,
        Spread::CableLength,
        Spread::TireMass,
        Spread::BreakingForce,
        Spread::DelayTime,
        Spread::DelayShare,
    ];

    /// The key, the access to its value, and the least spread for the factors.
    fn parts(self) -> (&'static Key, PlaceOf<f64>, f64) {
        match self {
            Spread::LaunchByHole => {
                (&uncertainty::LAUNCH_CV_PERCENT, |all| &mut all.launch_cv_percent, LEAST_PERCENT)
            }
            Spread::LaunchByRow => {
                (&uncertainty::LAUNCH_ROW_CV_PERCENT, |all| &mut all.launch_row_cv_percent, LEAST_PERCENT)
            }
            Spread::LaunchCommon => {
                (&uncertainty::LAUNCH_COMMON_PERCENT, |all| &mut all.launch_common_percent, LEAST_PERCENT)
            }
            Spread::LaunchBetweenShots => (
                &uncertainty::LAUNCH_BETWEEN_SHOTS_PERCENT,
                |all| &mut all.launch_between_shots_percent,
                LEAST_PERCENT,
            ),
            Spread::Tilt => (&uncertainty::LAUNCH_TILT_DEG, |all| &mut all.launch_tilt_deg, LEAST_DEGREES),
            Spread::TiltCommon => {
                (&uncertainty::LAUNCH_TILT_COMMON_DEG, |all| &mut all.launch_tilt_common_deg, LEAST_DEGREES)
            }
            Spread::HolePosition => {
                (&uncertainty::HOLE_POSITION_M, |all| &mut all.hole_position_m, LEAST_METRES)
            }
            Spread::PatternOffset => {
                (&uncertainty::PATTERN_OFFSET_M, |all| &mut all.pattern_offset_m, LEAST_METRES)
            }
            Spread::Duds => {
                (&uncertainty::HOLE_FAILS_PERCENT, |all| &mut all.hole_fails_percent, LEAST_DUDS_PERCENT)
            }
            Spread::CableLength => {
                (&uncertainty::CABLE_LENGTH_M, |all| &mut all.cable_length_m, LEAST_METRES)
            }
            Spread::TireMass => {
                (&uncertainty::TIRE_MASS_CV_PERCENT, |all| &mut all.tire_mass_cv_percent, LEAST_PERCENT)
            }
            Spread::BreakingForce => (
                &uncertainty::BREAKING_FORCE_CV_PERCENT,
                |all| &mut all.breaking_force_cv_percent,
                LEAST_PERCENT,
            ),
            Spread::DelayTime => (&uncertainty::DELAY_SD_MS, |all| &mut all.delay.sd_ms, LEAST_MILLISECONDS),
            Spread::DelayShare => {
                (&uncertainty::DELAY_CV_PERCENT, |all| &mut all.delay.cv_percent, LEAST_PERCENT)
            }
        }
    }

    fn stated(self, plan: &Plan) -> f64 {
        let mut all = plan.uncertainty;
        *(self.parts().1)(&mut all)
    }

    /// The spread of the plan, or the least spread if that is greater.
    fn scale(self, plan: &Plan) -> f64 {
        self.stated(plan).max(self.parts().2)
    }
}

/// Access to a value among the plan's unknowns.
type PlaceOf<T> = fn(&mut Uncertainty) -> &mut T;

impl Ranged {
    const ALL: [Ranged; 4] = [Ranged::Friction, Ranged::Slack, Ranged::AxialStiffness, Ranged::MassExponent];

    /// The key, the access to its value, and the least half-width for the factors.
    fn parts(self) -> (&'static Key, PlaceOf<[f64; 2]>, f64) {
        match self {
            Ranged::Friction => (&uncertainty::FRICTION, |all| &mut all.friction, 0.01),
            Ranged::Slack => (&uncertainty::SLACK_PERCENT, |all| &mut all.slack_percent, 0.1),
            Ranged::AxialStiffness => {
                (&uncertainty::AXIAL_STIFFNESS_PERCENT, |all| &mut all.axial_stiffness_percent, LEAST_PERCENT)
            }
            Ranged::MassExponent => {
                (&uncertainty::LAUNCH_MASS_EXPONENT, |all| &mut all.launch_mass_exponent, 0.05)
            }
        }
    }

    fn stated(self, plan: &Plan) -> [f64; 2] {
        let mut all = plan.uncertainty;
        *(self.parts().1)(&mut all)
    }

    /// The value about which the range widens: the plan's value, clamped to the range. The exponent of the mass law has no such value, so
    /// its range widens about the middle.
    fn centre(self, plan: &Plan) -> f64 {
        let [low, high] = self.stated(plan);
        let own = match self {
            Ranged::Friction => plan.ground.friction,
            Ranged::Slack => plan.cable.slack_percent,
            Ranged::AxialStiffness => 0.0,
            Ranged::MassExponent => 0.5 * (low + high),
        };
        own.clamp(low, high)
    }

    /// The range of the plan with its moving ends `factor` times as far from the plan's value.
    fn widened(self, plan: &Plan, side: Side, factor: f64) -> [f64; 2] {
        let ([low, high], centre, (key, _, least)) = (self.stated(plan), self.centre(plan), self.parts());
        let range = key.kind.range();
        let away = |end: f64| factor * (end - centre).abs().max(least);
        let lower = (centre - away(low)).clamp(*range.start(), low);
        let upper = (centre + away(high)).clamp(high, *range.end());
        match side {
            Side::Both => [lower, upper],
            Side::Low => [lower, high],
            Side::High => [low, upper],
        }
    }
}

impl Side {
    /// The number that describes a range.
    fn value(self, [low, high]: [f64; 2]) -> f64 {
        match self {
            Side::Both => 0.5 * (high - low),
            Side::Low => low,
            Side::High => high,
        }
    }
}

impl Toward {
    const ALL: [Toward; 4] = [Toward::PlusX, Toward::MinusX, Toward::PlusY, Toward::MinusY];

    fn vector(self) -> Vector2<f64> {
        match self {
            Toward::PlusX => Vector2::x(),
            Toward::MinusX => -Vector2::x(),
            Toward::PlusY => Vector2::y(),
            Toward::MinusY => -Vector2::y(),
        }
    }
}

/// Greatest excess over the plan's length that makes a pass thin if it ends the pass [m]. A tape over tires measures no better.
const THIN_LENGTH_M: f64 = 0.02;

impl Assumed {
    /// Greatest value that makes a pass thin if the option fails there; `None` if the assumption has no such margin. `stated` is the plan's
    /// value.
    pub fn thin_until(self, stated: f64) -> Option<f64> {
        match self {
            Assumed::LaunchVelocity => Some(1.0 + THIN_LAUNCH),
            Assumed::Place(_) => Some(THIN_LENGTH_M),
            Assumed::Spread(Spread::CableLength | Spread::HolePosition | Spread::PatternOffset) => {
                Some(stated + THIN_LENGTH_M)
            }
            _ => None,
        }
    }

    /// All assumptions.
    pub(super) fn all() -> impl Iterator<Item = Assumed> {
        let sides = |ranged: Ranged| match ranged {
            // The plan has no value between the ends.
            Ranged::MassExponent => vec![Side::Both],
            _ => vec![Side::Both, Side::Low, Side::High],
        };
        let ranges = Ranged::ALL
            .into_iter()
            .flat_map(move |ranged| sides(ranged).into_iter().map(move |side| Assumed::Range(ranged, side)));
        [Assumed::LaunchVelocity, Assumed::PushDepth]
            .into_iter()
            .chain(Toward::ALL.map(Assumed::Place))
            .chain(Spread::ALL.map(Assumed::Spread))
            .chain(ranges)
    }

    /// Name for scripts: that of the key, if one key holds the value.
    pub fn name(self) -> String {
        match self {
            Assumed::LaunchVelocity => "launch_factor".to_owned(),
            Assumed::Place(toward) => {
                let toward = match toward {
                    Toward::PlusX => "plus_x",
                    Toward::MinusX => "minus_x",
                    Toward::PlusY => "plus_y",
                    Toward::MinusY => "minus_y",
                };
                format!("shelter_{toward}_m")
            }
            Assumed::PushDepth => "push_depth_m".to_owned(),
            Assumed::Spread(spread) => spread.parts().0.name.to_owned(),
            Assumed::Range(ranged, side) => {
                let end = match side {
                    Side::Both => "",
                    Side::Low => ".low",
                    Side::High => ".high",
                };
                format!("{}{end}", ranged.parts().0.name)
            }
        }
    }

    /// Unit of the values; empty if they have none.
    pub fn unit(self) -> &'static str {
        match self {
            Assumed::LaunchVelocity => "",
            Assumed::Place(_) | Assumed::PushDepth => "m",
            Assumed::Spread(spread) => spread.parts().0.kind.unit(),
            Assumed::Range(ranged, _) => ranged.parts().0.kind.unit(),
        }
    }

    /// Whether other values change the planned shot.
    pub(super) fn is_of_planned_shot(self) -> bool {
        matches!(self, Assumed::LaunchVelocity | Assumed::Place(_) | Assumed::PushDepth)
    }

    /// Whether each draw changes more, the farther the value is from the plan's value, and never becomes the draw of another shot.
    pub(super) fn changes_steadily(self) -> bool {
        match self {
            Assumed::LaunchVelocity | Assumed::PushDepth | Assumed::Range(..) => true,
            Assumed::Place(_) => false,
            Assumed::Spread(spread) => !matches!(
                spread,
                Spread::HolePosition | Spread::PatternOffset | Spread::Duds | Spread::BreakingForce
            ),
        }
    }

    /// The plan's value.
    pub(super) fn stated(self, plan: &Plan, shot: &Shot) -> f64 {
        match self {
            Assumed::LaunchVelocity => 1.0,
            Assumed::Place(_) => 0.0,
            Assumed::PushDepth => shot.firings.iter().map(push_depth).fold(f64::INFINITY, f64::min),
            Assumed::Spread(spread) => spread.stated(plan),
            Assumed::Range(ranged, side) => side.value(ranged.stated(plan)),
        }
    }

    /// The values to try beyond the plan's value, the smallest change first.
    pub(super) fn rungs(self, plan: &Plan, shot: &Shot) -> Vec<Rung> {
        let stated = self.stated(plan, shot);
        // If the plan states less than the least spread, the least spread itself is the first value.
        let factors = || [1.0].into_iter().chain(FACTORS);
        let mut rungs: Vec<Rung> = match self {
            Assumed::LaunchVelocity => {
                let common = Spread::LaunchCommon.stated(plan);
                let scale = common.hypot(Spread::LaunchBetweenShots.stated(plan)).max(LEAST_PERCENT);
                RISES.map(|rise| Rung { value: 1.0 + 1e-2 * rise, ratio: rise / scale }).to_vec()
            }
            Assumed::Place(_) => {
                let (scale, widest) = (Spread::PatternOffset.scale(plan), plan.layout.widest_tie());
                let longer = DISTANCES.iter().position(|&away| away >= widest).unwrap_or(DISTANCES.len() - 1);
                let rung = |&away: &f64| Rung { value: away, ratio: away / scale };
                DISTANCES[..=longer].iter().map(rung).collect()
            }
            Assumed::PushDepth if shot.firings.is_empty() => Vec::new(),
            Assumed::PushDepth => {
                factors().map(|factor| Rung { value: stated / factor, ratio: factor }).collect()
            }
            Assumed::Spread(spread) => {
                let (most, scale) = (*spread.parts().0.kind.range().end(), spread.scale(plan));
                factors().map(|factor| Rung { value: (factor * scale).min(most), ratio: factor }).collect()
            }
            Assumed::Range(ranged, side) => {
                let value = |factor| side.value(ranged.widened(plan, side, factor));
                factors().map(|factor| Rung { value: value(factor), ratio: factor }).collect()
            }
        };
        // Also try the greatest value of a thin pass. Otherwise it could fall between two factors.
        if let (Some(most), Some(&first)) = (self.thin_until(stated), rungs.first())
            && !matches!(self, Assumed::LaunchVelocity)
        {
            rungs.push(Rung { value: most, ratio: most * first.ratio / first.value });
            sort_by(&mut rungs, |a, b| a.value.total_cmp(&b.value));
        }
        // The plan's value is known already. Beyond the end of a key's range nothing changes.
        let mut last = stated;
        rungs.retain(|rung| std::mem::replace(&mut last, rung.value) != rung.value);
        rungs
    }

    /// The plan and the planned shot of a delay option with another value.
    pub(super) fn vary(self, case: &Case, shot: &Shot, rung: &Rung) -> (Case, Shot) {
        let mut unknown = case.plan.uncertainty;
        let shot = match self {
            Assumed::LaunchVelocity => shot.with_launches(rung.value),
            Assumed::Place(toward) => with_shelter_aside(case, shot, rung.value * toward.vector()),
            Assumed::PushDepth => with_shallower_pushes(shot, rung.ratio),
            Assumed::Spread(spread) => {
                *(spread.parts().1)(&mut unknown) = rung.value;
                shot.clone()
            }
            Assumed::Range(ranged, side) => {
                *(ranged.parts().1)(&mut unknown) = ranged.widened(&case.plan, side, rung.ratio);
                shot.clone()
            }
        };
        (case.with_uncertainty(unknown), shot)
    }
}

/// Depth from which samples take the push of a hole [m].
fn push_depth(firing: &Firing) -> f64 {
    firing.line.depth.unwrap_or(ASSUMED_PUSH_DEPTH)
}

/// The same shot with holes that push from a depth `times` smaller.
fn with_shallower_pushes(shot: &Shot, times: f64) -> Shot {
    let shallower = |firing: &Firing| {
        let mut line = firing.line;
        line.depth = Some(push_depth(firing) / times);
        let launch = firing.launch.norm() * direction_of_slope(line.planned_slope());
        Firing { line, launch, ..*firing }
    };
    shot.with_firings(shot.firings.iter().map(shallower).collect())
}

/// The same shot with the shelter moved `aside` [m] from its place over the holes. Each hole launches the tire nearest to it.
fn with_shelter_aside(case: &Case, shot: &Shot, aside: Vector2<f64>) -> Shot {
    let scene = case.scene();
    let under_nearest = |firing: &Firing| {
        let place = place_of_hole(scene, firing) - aside;
        under_tire(case, firing, nearest_tire(scene, place), place)
    };
    shot.with_firings(shot.firings.iter().map(under_nearest).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The greatest value of a thin pass is always tried, and all values rise. For lengths it lies 2 cm beyond the plan's value.
    #[test]
    fn the_end_of_a_thin_pass_is_tried_whatever_the_plan_states() {
        let text = include_str!("../../../tests/fixtures/amur-three-rows.toml");
        let mut case = Case::new(Plan::parse("", text).unwrap_or_else(|mistakes| panic!("{mistakes}")));
        for stated in [0.0, 0.01, 0.05, 0.09, 0.3] {
            let unknown = &mut case.plan.uncertainty;
            (unknown.hole_position_m, unknown.pattern_offset_m, unknown.cable_length_m) =
                (stated, stated, stated);
            for assumed in Assumed::all() {
                let Some(most) = assumed.thin_until(assumed.stated(&case.plan, &case.shots[0])) else {
                    continue;
                };
                let rungs = assumed.rungs(&case.plan, &case.shots[0]);
                assert!(
                    rungs.iter().any(|rung| rung.value == most),
                    "{assumed:?}, {stated} stated: {rungs:?}"
                );
                let rises = |pair: &[Rung]| pair[0].value < pair[1].value && pair[0].ratio < pair[1].ratio;
                assert!(rungs.windows(2).all(rises), "{assumed:?}, {stated} stated: {rungs:?}");
            }
        }
    }
}
