//! Impulses of holes within a step: launches at once, and pushes over many steps.
//!
//! A tire under a push is integrated by itself in every step of the push. Its velocity at mid-step holds what the push adds until
//! the step ends. So the kick of a whole register, which knows no pushes, gives the right velocity at the start of the next step.
//! On the ground that kick has another friction than the tire. There the velocity is computed from the velocity at mid-step with
//! the push.

use nalgebra::Vector3;

use super::Stepper;
use crate::simulation::contact::HoleImpulse;
use crate::simulation::pack::LANES;
use crate::simulation::verlet::half_kicks::PushedTire;

/// Impulse on a tire within the present step.
#[derive(Clone, Copy, Debug)]
pub struct DueImpulse {
    /// Index of the tire in the part.
    pub tire: usize,
    /// Time and kind of the impulse.
    pub impulse: HoleImpulse,
}

/// Pushes that go on after the present step.
#[derive(Clone, Debug)]
pub struct Pushes {
    active: Vec<Push>,
    /// Tires on the ground that were under a push as the present step began.
    began: Vec<PushedTire>,
    /// Tires on the ground that are under a push as the next step begins.
    next: Vec<PushedTire>,
}

/// A push that goes on after the present step.
#[derive(Clone, Copy, Debug)]
struct Push {
    tire: usize,
    /// Acceleration by the push [m/s²].
    acceleration: Vector3<f64>,
    /// End of the push [s].
    end: f64,
}

impl Pushes {
    /// No pushes yet, with room for `count` pushes at once.
    pub fn with_capacity(count: usize) -> Self {
        let [began, next] = [Vec::with_capacity(count), Vec::with_capacity(count)];
        Self { active: Vec::with_capacity(count), began, next }
    }

    /// The tire, if it is on the ground and was under a push until the step began.
    pub fn pushed_on_ground(&self, tire: usize) -> Option<PushedTire> {
        self.began.iter().find(|pushed| pushed.tire == tire).copied()
    }

    /// Whether a push on a tire goes on after the present step.
    pub fn is_pushed_after_step(&self, tire: usize) -> bool {
        self.active.iter().any(|push| push.tire == tire)
    }

    /// Whether no push goes on after the present step.
    pub fn is_empty(&self) -> bool {
        self.active.is_empty()
    }

    /// Acceleration of a tire by the pushes that go on after the present step [m/s²].
    pub fn after_step(&self, tire: usize) -> Vector3<f64> {
        self.active.iter().filter(|push| push.tire == tire).map(|push| push.acceleration).sum()
    }

    /// Keeps a tire on the ground under a push that goes on after the step.
    pub fn remember_on_ground(&mut self, pushed: PushedTire) {
        self.next.push(pushed);
    }
}

/// Acceleration of a tire by pushes as the step begins [m/s²]; `due` are the impulses of the step.
pub fn push_at_start(due: &[DueImpulse], tire: usize) -> Vector3<f64> {
    let here = due.iter().filter(|due| due.tire == tire && due.impulse.since_start <= 0.0);
    here.map(|due| due.impulse.push_acceleration).sum()
}

impl Stepper<'_> {
    /// Collects the impulses of the present step, and wakes their tires.
    pub(super) fn collect_due_impulses(&mut self) {
        let Self { clock, step, firings, due, pushes, wake, .. } = self;
        due.clear();
        let start = clock.since_base();
        let step_end = start + *step;
        let since_start = |time: f64| (time - start).clamp(0.0, *step);
        let pushed = |tire, since_start, push| {
            let impulse = HoleImpulse { since_start, push_acceleration: push, ..HoleImpulse::default() };
            DueImpulse { tire, impulse }
        };
        std::mem::swap(&mut pushes.began, &mut pushes.next);
        pushes.next.clear();
        pushes.active.retain(|&Push { tire, acceleration, end }| {
            due.push(pushed(tire, 0.0, acceleration));
            let push_end = end - clock.base;
            let ends = push_end < step_end;
            if ends {
                due.push(pushed(tire, since_start(push_end), -acceleration));
            }
            !ends
        });
        while let Some(firing) = firings.get(clock.fired) {
            let (tire, time) = (firing.tire, firing.time - clock.base);
            if time >= step_end {
                break;
            }
            clock.fired += 1;
            if firing.push_time <= 0.0 {
                let impulse = HoleImpulse {
                    since_start: since_start(time),
                    launch: firing.launch,
                    ..HoleImpulse::default()
                };
                due.push(DueImpulse { tire, impulse });
                continue;
            }
            let acceleration = firing.launch / firing.push_time;
            due.push(pushed(tire, since_start(time), acceleration));
            if time + firing.push_time < step_end {
                due.push(pushed(tire, since_start(time + firing.push_time), -acceleration));
            } else {
                pushes.active.push(Push { tire, acceleration, end: firing.time + firing.push_time });
            }
        }
        due.iter().for_each(|due| wake.set_moving(due.tire / LANES, true));
        due.sort_by(|a, b| a.tire.cmp(&b.tire).then(a.impulse.since_start.total_cmp(&b.impulse.since_start)));
    }
}
