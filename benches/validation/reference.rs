//! The reference answers: the event-driven solution of the model beside the program's.

use std::ops::ControlFlow;

use nalgebra::Vector3;
use shelter::choice::Method;
use shelter::scene::{Firing, Shot};
use shelter::simulation::{Model, RunSettings};

use super::METHODS;
use super::event_driven::{GRAVITY, Launch, Shelter, solve};
use super::report::row;
use super::rig::Rig;

/// Step of both methods [s], and tolerance of the event-driven solution.
const STEP: f64 = 1e-4;
const TOLERANCE: f64 = 1e-9;

/// Prints greatest height and force of the first second.
pub fn compare(name: &str, (shelter, launches): &(Shelter, Vec<Launch>)) {
    let theirs = solve(shelter, launches, 1.0, TOLERANCE);
    let ours = METHODS.map(|method| greatest(shelter, launches, method));
    let source = format!("event-driven, {} events", theirs.events);
    let values = |n: usize| ours.clone().map(|value| Some(value.map(|greatest| greatest[n])));
    let (height, force) = (theirs.height, theirs.force);
    row(&format!("{name}: height at {:.3} s, m", height.time), height.value, values(0), 6, &source);
    row(&format!("{name}: force at {:.4} s, N", force.time), force.value, values(1), 2, &source);
}

fn greatest(
    shelter: &Shelter,
    launches: &[Launch],
    method: Method,
) -> Result<[f64; 2], shelter::simulation::RunError> {
    let mut rig = Rig::new(GRAVITY, shelter.friction);
    for &place in &shelter.places {
        rig.mass(shelter.mass, place, Vector3::zeros());
    }
    for tie in &shelter.ties {
        rig.tie(tie.ends, tie.length, tie.stiffness);
    }
    let firing = |launch: &Launch| Firing::at_once(launch.time, launch.tire, launch.velocity);
    let shot = Shot::from_firings(launches.iter().map(firing).collect());
    let settings = RunSettings { method, step: STEP, duration: Some(1.0) };
    let outcome = Model::new(rig.scene).run(&shot, &settings, &mut |_| ControlFlow::Continue(()))?;
    Ok([outcome.height.value, outcome.force.value])
}
