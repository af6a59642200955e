//! What was seen of earlier shots that speaks against the verdicts of a plan.

use crate::choice::ObservedQuantity;
use crate::plan::DelayScatter;
use crate::plan::observations::{MeasuredFiring, Observation};
use crate::study::Case;
use crate::study::fit::observation_bands::Prediction;

/// What speaks against the verdicts of a plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Contradiction {
    /// A value over its limit.
    OverLimit {
        /// What was seen.
        seen: Observation,
        /// The limit [SI unit].
        limit: f64,
    },
    /// A value that one of thousands of shots of the plan would show.
    FarOutside {
        /// What was seen.
        seen: Observation,
        /// 5th and 95th percentile of what could have been seen [SI unit]; not numbers where hardly any shot has a value.
        band: [f64; 2],
    },
    /// More values lie outside their bands than chance explains.
    Unpredicted {
        /// Number of these.
        outside: usize,
        /// Number of values that have a band.
        of: usize,
    },
    /// Holes fired at times that the plan and its `[uncertainty]` leave no room for.
    FiredOtherwise {
        /// Number of these.
        far: usize,
        /// Number of logged firing times.
        logged: usize,
        /// The farthest of them.
        fired: MeasuredFiring,
        /// When its hole was planned to fire [s].
        planned: f64,
    },
}

/// Distance beyond its 90 % band from which an observation contradicts the plan, in widths of the band. Of a normal distribution
/// this is 3.6 standard deviations from the middle: 3 of 10,000 observations lie farther out.
const FAR_OUTSIDE: f64 = 0.6;
/// Observations of one shot, or of one option, from which they count by themselves.
const ENOUGH_OF_ONE: usize = 2;

/// What contradicts a plan, of what was `seen` of each shot and of firing times that were `logged`:
///
/// 1. values over a limit, and values far outside their bands;
/// 2. more values outside their bands than chance explains (1 in 10): of all shots, else of an option, else of a shot;
/// 3. holes that fired at other times than planned.
pub fn find_contradictions(
    case: &Case,
    seen: &[Vec<(Observation, Prediction)>],
    logged: &[MeasuredFiring],
) -> Vec<Contradiction> {
    let by_shot = seen.iter().filter(|shot| shot.len() >= ENOUGH_OF_ONE);
    let by_shot = by_shot.clone().find_map(|shot| unpredicted(shot));
    let mut seen = seen.concat();
    seen.sort_by_key(|(seen, _)| seen.option);
    let of_option = seen.chunk_by(|(a, _), (b, _)| a.option == b.option);
    let by_option = of_option.filter(|seen| seen.len() >= ENOUGH_OF_ONE).find_map(unpredicted);
    let too_many = unpredicted(&seen).or(by_option).or(by_shot);
    let of_one = |one: &(Observation, Prediction)| over_limit(case, &one.0).or_else(|| far_outside(one));
    let fired = fired_otherwise(case, logged);
    seen.iter().filter_map(of_one).chain(too_many).chain(fired).collect()
}

fn over_limit(case: &Case, seen: &Observation) -> Option<Contradiction> {
    let limit = match seen.watched.quantity {
        ObservedQuantity::FlightHeight | ObservedQuantity::Height => case.limits.height,
        ObservedQuantity::Force => case.limits.force,
        ObservedQuantity::Drift => case.limits.drift?,
        ObservedQuantity::Lift | ObservedQuantity::Landing => return None,
    };
    (seen.value > limit).then_some(Contradiction::OverLimit { seen: *seen, limit })
}

fn far_outside((seen, prediction): &(Observation, Prediction)) -> Option<Contradiction> {
    let band @ [low, high] = prediction.band?;
    let room = FAR_OUTSIDE * (high - low);
    let has_room = (low - room..=high + room).contains(&seen.value);
    (!has_room).then_some(Contradiction::FarOutside { seen: *seen, band })
}

fn unpredicted(seen: &[(Observation, Prediction)]) -> Option<Contradiction> {
    let (within, of) = count_within(seen)?;
    let outside = of - within;
    let is_odd = outside > of.div_ceil(10) || outside == of;
    is_odd.then_some(Contradiction::Unpredicted { outside, of })
}

/// How many observations lie in their bands, and how many have one; `None` where none has.
pub fn count_within(seen: &[(Observation, Prediction)]) -> Option<(usize, usize)> {
    let held = seen.iter().filter_map(|(seen, prediction)| prediction.contains(seen.value));
    let (within, of) = held.fold((0, 0), |(within, of), held| (within + usize::from(held), of + 1));
    (of > 0).then_some((within, of))
}

/// How far a logged firing time may lie from the planned one: standard deviations, and beside them the resolution of a log [s].
const FAR_FROM_PLANNED: (f64, f64) = (5.0, 1e-3);

/// Whether holes of earlier shots fired at times that the plan and its `[uncertainty]` leave no room for.
fn fired_otherwise(case: &Case, logged: &[MeasuredFiring]) -> Option<Contradiction> {
    let uncertainty = &case.plan.uncertainty;
    let beside = |fired: &MeasuredFiring| {
        let shot = &case.shots[fired.option];
        let over = shot.firings.iter().filter(|firing| firing.tire == fired.tire).map(|firing| firing.time);
        let planned = over.min_by(|a, b| (a - fired.time).abs().total_cmp(&(b - fired.time).abs()))?;
        // Every delay before it scatters by itself. The fixed parts add as squares; the rest is no more than that of one long
        // delay.
        let DelayScatter { sd_ms, cv_percent } = uncertainty.delay;
        let fixed = sd_ms * 1e-3 * (shot.firings.len() as f64).sqrt();
        let delays = fixed.hypot(cv_percent * 1e-2 * planned);
        let (deviations, resolution) = FAR_FROM_PLANNED;
        let room = resolution + deviations * delays.hypot(uncertainty.in_hole_deviation());
        let away = (fired.time - planned).abs();
        (away > room).then_some((away, planned, *fired))
    };
    let far: Vec<_> = logged.iter().filter_map(beside).collect();
    let &(_, planned, fired) = far.iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(Contradiction::FiredOtherwise { far: far.len(), logged: logged.len(), fired, planned })
}
