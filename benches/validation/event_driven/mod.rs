//! The model of the source paper a second time, solved from event to event: no step, no penalty stiffness, no iteration.
//!
//! Written apart from the program's simulation: it shares no type and no line with it. Each tire is in one of four modes, each
//! tie is taut or slack, and while none of these changes the motion is smooth. So it is integrated by a Runge-Kutta method of
//! fifth order whose step follows a tolerance. A mode ends where one of its inequalities is violated (`modes`); that instant is
//! found by root finding on the length of the last step, the mode is changed there, and the integration begins anew.
//!
//! | what | where |
//! |---|---|
//! | tires, ties, launches; from event to event | here |
//! | forces, modes, inequalities and changes of mode | `modes` |
//! | a step of fifth order with its error | `dormand_prince` |
//! | the shelters of the reference answers | `shelters` |

mod dormand_prince;
mod modes;
pub mod shelters;

use nalgebra::Vector3;

use self::modes::{Modes, Motion};

/// Gravity [m/s²].
pub const GRAVITY: f64 = 9.81;

/// Point masses on level ground, and ties between them.
pub struct Shelter {
    /// Places at rest [m] (`n_tires`).
    pub places: Vec<Vector3<f64>>,
    /// Mass of each tire [kg].
    pub mass: f64,
    /// Coefficient of friction.
    pub friction: f64,
    /// Ties between tires (`n_ties`).
    pub ties: Vec<Tie>,
}

/// A tie that pulls with k s where it is stretched by s > 0.
pub struct Tie {
    /// Its two tires.
    pub ends: [usize; 2],
    /// Length without stretch [m].
    pub length: f64,
    /// k [N/m].
    pub stiffness: f64,
}

/// A velocity [m/s] that a tire gets at a time [s].
pub struct Launch {
    pub time: f64,
    pub tire: usize,
    pub velocity: Vector3<f64>,
}

/// A greatest value, and when it was reached [s].
#[derive(Clone, Copy, Default)]
pub struct Greatest {
    pub value: f64,
    pub time: f64,
}

impl Greatest {
    fn note(&mut self, value: f64, time: f64) {
        if value > self.value {
            *self = Self { value, time };
        }
    }
}

/// What the shelter did.
#[derive(Default)]
pub struct Answer {
    /// Greatest height of a tire [m].
    pub height: Greatest,
    /// Greatest force of a tie [N].
    pub force: Greatest,
    /// Changes of mode.
    pub events: usize,
    /// Steps between them.
    pub steps: usize,
}

/// Longest step [s]: heights and forces between two ends of a step are those of a cubic.
const LONGEST_STEP: f64 = 5e-4;
/// Precision of the instant of an event [s].
const INSTANT: f64 = 1e-14;

/// Motion of `shelter` under `launches`, in order of time, until `end` [s]. Errors of a step stay below `tolerance`, for places in
/// metres and velocities in metres per second, each relative where it is greater than 1.
pub fn solve(shelter: &Shelter, launches: &[Launch], end: f64, tolerance: f64) -> Answer {
    let mut answer = Answer::default();
    let (mut motion, mut modes) = (Motion::at_rest(shelter), Modes::at_rest(shelter));
    let (mut now, mut length) = (0.0_f64, 1e-5_f64);
    let mut launches = launches.iter().peekable();
    while now < end {
        while let Some(launch) = launches.next_if(|launch| launch.time <= now) {
            motion.velocities[launch.tire] += launch.velocity;
            modes.settle(shelter, &mut motion, launch.tire);
        }
        modes.head(shelter, &motion);
        let until = launches.peek().map_or(end, |launch| launch.time.min(end)) - now;
        let attempt = length.min(until);
        let (mut after, error) = dormand_prince::step(shelter, &modes, &motion, attempt);
        let error = error / tolerance;
        // The error of a step is of sixth order in its length.
        length = (attempt * (0.9 * error.powf(-0.2)).clamp(0.2, 4.0)).min(LONGEST_STEP);
        if error > 1.0 {
            continue;
        }
        let middle = Motion::between(shelter, &modes, (&motion, &after), attempt);
        let violated = |state| modes.least_gap(shelter, state) < 0.0;
        let late = if violated(&middle) { Some(0.5 * attempt) } else { violated(&after).then_some(attempt) };
        let mut passed = attempt;
        if let Some(late) = late {
            passed = first_event(shelter, &modes, &motion, late);
            after = dormand_prince::step(shelter, &modes, &motion, passed).0;
        }
        note_greatest(&mut answer, shelter, (&motion, &after), now, passed);
        answer.steps += 1;
        answer.events += modes.change(shelter, &mut after);
        motion = after;
        now = if passed == until { now + until } else { now + passed };
        if until - passed < INSTANT {
            now = launches.peek().map_or(end, |launch| launch.time.min(end));
        }
    }
    answer
}

/// Length [s] of the step from `motion` at whose end an inequality is first violated, by no more than [`INSTANT`]; at `late` [s] one
/// is. Regula falsi with the Illinois rule, and every third time bisection.
fn first_event(shelter: &Shelter, modes: &Modes, motion: &Motion, late: f64) -> f64 {
    let gap = |length: f64| modes.least_gap(shelter, &dormand_prince::step(shelter, modes, motion, length).0);
    let (mut early, mut late) = (0.0, late);
    let (mut gap_early, mut gap_late) = (modes.least_gap(shelter, motion), gap(late));
    for turn in 0_usize.. {
        if late - early <= INSTANT || gap_late >= 0.0 {
            break;
        }
        let secant = early + (late - early) * gap_early / (gap_early - gap_late);
        let inside = secant > early && secant < late && turn % 3 != 2;
        let between = if inside { secant } else { 0.5 * (early + late) };
        let found = gap(between);
        if found < 0.0 {
            (late, gap_late, gap_early) = (between, found, 0.5 * gap_early);
        } else {
            (early, gap_early, gap_late) = (between, found, 0.5 * gap_late);
        }
    }
    late
}

/// Notes the greatest height and force between two states, `length` [s] apart, the first at `start` [s].
fn note_greatest(
    answer: &mut Answer,
    shelter: &Shelter,
    (before, after): (&Motion, &Motion),
    start: f64,
    length: f64,
) {
    for tire in 0..shelter.places.len() {
        let at = |motion: &Motion| [motion.shifts[tire].z, motion.velocities[tire].z];
        let (height, part) = greatest_of_cubic(at(before), at(after), length);
        answer.height.note(height, start + part * length);
    }
    for tie in &shelter.ties {
        let (stretch, part) =
            greatest_of_cubic(before.stretch(shelter, tie), after.stretch(shelter, tie), length);
        answer.force.note(tie.stiffness * stretch, start + part * length);
    }
}

/// Greatest value of the cubic with these values and rates at its ends, `length` apart, and the part of the way where it is.
fn greatest_of_cubic([y0, rate0]: [f64; 2], [y1, rate1]: [f64; 2], length: f64) -> (f64, f64) {
    let (m0, m1) = (rate0 * length, rate1 * length);
    let ends = if y0 > y1 { (y0, 0.0) } else { (y1, 1.0) };
    if !(m0 > 0.0 && m1 < 0.0) {
        return ends;
    }
    // Root of the derivative c + b θ + a θ², which falls from m0 > 0 to m1 < 0.
    let (a, b, c) = (6.0 * (y0 - y1) + 3.0 * (m0 + m1), 6.0 * (y1 - y0) - 4.0 * m0 - 2.0 * m1, m0);
    let part = 2.0 * c / (-b + (b * b - 4.0 * a * c).sqrt());
    let rest = 1.0 - part;
    let value = rest * rest * ((1.0 + 2.0 * part) * y0 + part * m0)
        + part * part * ((1.0 + 2.0 * rest) * y1 - rest * m1);
    (value, part)
}
