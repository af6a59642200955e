//! Forces on the tires, the mode of each tire and tie, the inequalities that hold while a mode lasts, and what follows it.
//!
//! | mode | motion | lasts while |
//! |---|---|---|
//! | stick | none | friction needed ≤ μR |
//! | start | along the pull, friction μR against the pull | R ≥ 0, speed between 0 and [`MOVING`] |
//! | slide | along the ground, friction μR against the velocity | R ≥ 0, speed above [`STANDING`], no turning round |
//! | flight | free | height ≥ 0 |
//! | taut, slack tie | | stretch ≥ 0, stretch ≤ 0 |
//!
//! R is the reaction of the ground. "Start" is there because a tire that begins to slide has a direction of friction (against the
//! pull), but no velocity yet; it lasts some microseconds.

use nalgebra::{Vector2, Vector3};

use super::{GRAVITY, Shelter, Tie};

/// Speed from which on a tire slides with a direction of its own [m/s].
const MOVING: f64 = 1e-6;
/// Speed below which a sliding tire has stopped [m/s].
const STANDING: f64 = 1e-8;
/// Violation that does not count: of a length [m] and of a force [N].
const NO_LENGTH: f64 = 1e-13;
const NO_FORCE: f64 = 1e-7;

/// Displacements [m] and velocities [m/s] of all tires, or the rates of both.
#[derive(Clone)]
pub struct Motion {
    pub shifts: Vec<Vector3<f64>>,
    pub velocities: Vec<Vector3<f64>>,
}

impl Motion {
    pub fn at_rest(shelter: &Shelter) -> Self {
        let still = vec![Vector3::zeros(); shelter.places.len()];
        Self { shifts: still.clone(), velocities: still }
    }

    /// Adds `weight` times `rate`.
    pub fn add(&mut self, weight: f64, rate: &Motion) {
        for (shift, rate) in self.shifts.iter_mut().zip(&rate.shifts) {
            *shift += weight * rate;
        }
        for (velocity, rate) in self.velocities.iter_mut().zip(&rate.velocities) {
            *velocity += weight * rate;
        }
    }

    /// Greatest component, over that of `scale` where the latter is greater than 1.
    pub fn greatest_over(&self, scale: &Motion) -> f64 {
        let ours = self.shifts.iter().chain(&self.velocities).flatten();
        let theirs = scale.shifts.iter().chain(&scale.velocities).flatten();
        ours.zip(theirs).map(|(error, value)| error.abs() / value.abs().max(1.0)).fold(0.0, f64::max)
    }

    /// State halfway between two that are `length` [s] apart: the cubic through their values and rates.
    pub fn between(
        shelter: &Shelter,
        modes: &Modes,
        (before, after): (&Motion, &Motion),
        length: f64,
    ) -> Self {
        let mut middle = Self::at_rest(shelter);
        for (state, weight) in [(before, 0.125 * length), (after, -0.125 * length)] {
            middle.add(0.5, state);
            middle.add(weight, &modes.rate(shelter, state));
        }
        middle
    }

    /// Vector from the first to the second end of a tie [m].
    fn line(&self, shelter: &Shelter, tie: &Tie) -> Vector3<f64> {
        let [a, b] = tie.ends;
        shelter.places[b] - shelter.places[a] + self.shifts[b] - self.shifts[a]
    }

    /// Stretch of a tie [m], below 0 where it is slack, and its rate [m/s].
    pub fn stretch(&self, shelter: &Shelter, tie: &Tie) -> [f64; 2] {
        let (line, [a, b]) = (self.line(shelter, tie), tie.ends);
        let length = line.norm();
        [length - tie.length, line.dot(&(self.velocities[b] - self.velocities[a])) / length]
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Contact {
    Stick,
    Start,
    Slide,
    Flight,
}

/// Mode of every tire and tie.
pub struct Modes {
    contacts: Vec<Contact>,
    taut: Vec<bool>,
    /// Direction in which each tire on the ground moves, or would move, at the start of a step.
    headings: Vec<Vector2<f64>>,
}

impl Modes {
    pub fn at_rest(shelter: &Shelter) -> Self {
        Self {
            contacts: vec![Contact::Stick; shelter.places.len()],
            taut: vec![false; shelter.ties.len()],
            headings: vec![Vector2::zeros(); shelter.places.len()],
        }
    }

    /// Notes the direction of every tire on the ground at the start of a step.
    pub fn head(&mut self, shelter: &Shelter, motion: &Motion) {
        let forces = self.forces(shelter, motion);
        for (tire, heading) in self.headings.iter_mut().enumerate() {
            *heading = match self.contacts[tire] {
                Contact::Slide => motion.velocities[tire].xy().normalize(),
                Contact::Start => forces[tire].xy().normalize(),
                Contact::Stick | Contact::Flight => Vector2::zeros(),
            };
        }
    }

    /// Force of ties and gravity on each tire [N].
    fn forces(&self, shelter: &Shelter, motion: &Motion) -> Vec<Vector3<f64>> {
        let mut forces = vec![Vector3::new(0.0, 0.0, -shelter.mass * GRAVITY); shelter.places.len()];
        for (tie, _) in shelter.ties.iter().zip(&self.taut).filter(|(_, taut)| **taut) {
            let line = motion.line(shelter, tie);
            let length = line.norm();
            let pull = line * (tie.stiffness * (length - tie.length) / length);
            forces[tie.ends[0]] += pull;
            forces[tie.ends[1]] -= pull;
        }
        forces
    }

    /// Velocities and accelerations of a state.
    pub fn rate(&self, shelter: &Shelter, motion: &Motion) -> Motion {
        let mut accelerations = self.forces(shelter, motion);
        for (tire, force) in accelerations.iter_mut().enumerate() {
            let limit = -shelter.friction * force.z;
            let sideways = match self.contacts[tire] {
                Contact::Flight => {
                    *force /= shelter.mass;
                    continue;
                }
                Contact::Stick => Vector2::zeros(),
                Contact::Start => force.xy().normalize() * (force.xy().norm() - limit),
                Contact::Slide => {
                    let velocity = motion.velocities[tire].xy();
                    // Beyond a stop, friction goes on as before it, so that the instant of the stop is a smooth root.
                    let forward = velocity.dot(&self.headings[tire]).signum();
                    force.xy() - velocity.normalize() * (forward * limit)
                }
            };
            *force = (sideways / shelter.mass).push(0.0);
        }
        Motion { shifts: motion.velocities.clone(), velocities: accelerations }
    }

    /// What is left until the inequality of a tire that is next to be violated [N, m or m/s], below 0 where it is violated.
    fn contact_gap(&self, shelter: &Shelter, motion: &Motion, tire: usize, force: &Vector3<f64>) -> f64 {
        let speed = motion.velocities[tire].xy().norm();
        let forward = motion.velocities[tire].xy().dot(&self.headings[tire]);
        let reaction = -force.z + NO_FORCE;
        match self.contacts[tire] {
            Contact::Stick => shelter.friction * -force.z - force.xy().norm() + NO_FORCE,
            Contact::Start => reaction.min(forward + STANDING).min(MOVING - speed),
            Contact::Slide => reaction.min(forward).min(speed - STANDING),
            Contact::Flight => motion.shifts[tire].z + NO_LENGTH,
        }
    }

    fn tie_gap(&self, shelter: &Shelter, motion: &Motion, tie: usize) -> f64 {
        let [stretch, _] = motion.stretch(shelter, &shelter.ties[tie]);
        NO_LENGTH + if self.taut[tie] { stretch } else { -stretch }
    }

    /// The least of all that is left, below 0 where an inequality is violated.
    pub fn least_gap(&self, shelter: &Shelter, motion: &Motion) -> f64 {
        let forces = self.forces(shelter, motion);
        let contacts = (0..forces.len()).map(|tire| self.contact_gap(shelter, motion, tire, &forces[tire]));
        let ties = (0..shelter.ties.len()).map(|tie| self.tie_gap(shelter, motion, tie));
        contacts.chain(ties).fold(f64::INFINITY, f64::min)
    }

    /// Changes every mode whose inequality is violated; returns how many.
    pub fn change(&mut self, shelter: &Shelter, motion: &mut Motion) -> usize {
        let forces = self.forces(shelter, motion);
        let over: Vec<usize> = (0..forces.len())
            .filter(|&tire| self.contact_gap(shelter, motion, tire, &forces[tire]) < 0.0)
            .collect();
        let turned: Vec<usize> =
            (0..shelter.ties.len()).filter(|&tie| self.tie_gap(shelter, motion, tie) < 0.0).collect();
        for &tie in &turned {
            self.taut[tie] = !self.taut[tie];
        }
        for &tire in &over {
            let velocity = &mut motion.velocities[tire];
            let turned_round = velocity.xy().dot(&self.headings[tire]) <= 0.0;
            match self.contacts[tire] {
                Contact::Slide if turned_round || velocity.xy().norm() <= STANDING => velocity.fill(0.0),
                Contact::Start if turned_round => velocity.fill(0.0),
                _ => {}
            }
            self.settle(shelter, motion, tire);
        }
        over.len() + turned.len()
    }

    /// Mode of a tire from its state: it lands where it falls onto the ground, without rebound.
    pub fn settle(&mut self, shelter: &Shelter, motion: &mut Motion, tire: usize) {
        let (shift, velocity) = (&mut motion.shifts[tire], &mut motion.velocities[tire]);
        if velocity.z > 0.0 || shift.z > NO_LENGTH {
            self.contacts[tire] = Contact::Flight;
            return;
        }
        let speed = velocity.xy().norm();
        let lost = shelter.friction * -velocity.z;
        let left = if speed > lost { 1.0 - lost / speed } else { 0.0 };
        (shift.z, *velocity) = (0.0, (velocity.xy() * left).push(0.0));
        let speed = speed * left;
        let force = self.forces(shelter, motion)[tire];
        let cone = shelter.friction * -force.z - force.xy().norm();
        self.contacts[tire] = match () {
            () if force.z > 0.0 => Contact::Flight,
            () if speed > STANDING => Contact::Slide,
            () if cone >= 0.0 => Contact::Stick,
            () => Contact::Start,
        };
    }
}
