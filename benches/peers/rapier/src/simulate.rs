// Included once per precision, with `rapier` naming the crate of that precision.

use std::time::Instant;

use rapier::dynamics::FrictionModel;
use rapier::prelude::*;

use crate::scene::{FRICTION, GRAVITY, LAUNCH, Scene, TIRE_MASS};
use crate::{Options, Outcome};

/// Radius of the balls that stand for the point masses.
const RADIUS: Real = 0.1;

/// Half the width of the box that stands for the ground.
const GROUND_HALF_WIDTH: Real = 200.0;

struct Tension {
    ends: [usize; 2],
    length: Real,
    stiffness: Real,
}

pub fn simulate(scene: &Scene, options: &Options) -> Outcome {
    let (mut world, tires) = build_world(scene, options);
    let cables: Vec<Tension> = scene
        .cables
        .iter()
        .map(|cable| Tension {
            ends: cable.ends,
            length: cable.length as Real,
            stiffness: cable.stiffness as Real,
        })
        .collect();
    let dt = options.step as Real;
    let tuning = &options.tuning;
    let launch = LAUNCH as Real + if tuning.half_step_launch { 0.5 * GRAVITY as Real * dt } else { 0.0 };

    let mut positions = vec![Vector::ZERO; tires.len()];
    let mut pulls = vec![Vector::ZERO; tires.len()];
    let mut shots = scene.shots.iter().peekable();
    let (mut height, mut height_step) = (0.0, 0);
    let (mut force, mut force_step) = (0.0, 0);

    let start = Instant::now();
    for step in 0..=options.steps() {
        for (position, tire) in positions.iter_mut().zip(&tires) {
            *position = world.bodies[*tire].translation();
            if position.z > height {
                (height, height_step) = (position.z, step);
            }
        }
        pulls.fill(Vector::ZERO);
        let greatest = add_tension(&cables, &positions, &mut pulls);
        if greatest > force {
            (force, force_step) = (greatest, step);
        }
        for (tire, pull) in tires.iter().zip(&pulls) {
            if tuning.impulses {
                if *pull != Vector::ZERO {
                    world.bodies[*tire].apply_impulse(*pull * dt, tuning.sleep);
                }
            } else if *pull != world.bodies[*tire].user_force() {
                let body = &mut world.bodies[*tire];
                body.reset_forces(tuning.sleep);
                body.add_force(*pull, tuning.sleep);
            }
        }
        while let Some((_, launched)) = shots.next_if(|(at, _)| (at / options.step).round() as usize <= step)
        {
            for &tire in launched {
                world.bodies[tires[tire]]
                    .apply_impulse(Vector::Z * (TIRE_MASS as Real * launch), tuning.sleep);
            }
        }
        if step < options.steps() {
            world.step();
        }
    }
    let wall = start.elapsed().as_secs_f64();

    Outcome {
        height: f64::from(height - RADIUS),
        height_at: height_step as f64 * options.step,
        force: f64::from(force),
        force_at: force_step as f64 * options.step,
        wall,
    }
}

/// Adds the pull of every taut cable to its two tires; returns the greatest tension.
fn add_tension(cables: &[Tension], positions: &[Vector], pulls: &mut [Vector]) -> Real {
    let mut greatest: Real = 0.0;
    for cable in cables {
        let [from, to] = cable.ends;
        let along = positions[to] - positions[from];
        let square = along.length_squared();
        if square > cable.length * cable.length {
            let length = square.sqrt();
            let tension = cable.stiffness * (length - cable.length);
            let pull = along * (tension / length);
            pulls[from] += pull;
            pulls[to] -= pull;
            greatest = greatest.max(tension);
        }
    }
    greatest
}

/// Balls without rotation that meet the ground but not each other.
fn build_world(scene: &Scene, options: &Options) -> (PhysicsWorld, Vec<RigidBodyHandle>) {
    let mut world = PhysicsWorld::default();
    world.gravity = Vector::Z * -(GRAVITY as Real);
    let tuning = &options.tuning;
    let parameters = &mut world.integration_parameters;
    parameters.dt = options.step as Real;
    parameters.num_solver_iterations = tuning.solver_iterations;
    parameters.num_internal_stabilization_iterations = tuning.stabilization_iterations;
    parameters.contact_recycling = tuning.contact_recycling;
    parameters.max_ccd_substeps = 0;
    parameters.static_contact_softness =
        SpringCoefficients::new(tuning.contact_frequency as Real, tuning.contact_damping as Real);
    if tuning.coulomb_cone {
        parameters.friction_model = FrictionModel::Coulomb;
    }

    let surface = |collider: ColliderBuilder, member: Group, meets: Group| {
        collider
            .friction(FRICTION as Real)
            .friction_combine_rule(CoefficientCombineRule::Min)
            .restitution(0.0)
            .collision_groups(InteractionGroups::new(member, meets, InteractionTestMode::And))
    };
    let ground = if tuning.cuboid_ground {
        ColliderBuilder::cuboid(GROUND_HALF_WIDTH, GROUND_HALF_WIDTH, 1.0).translation(-Vector::Z)
    } else {
        ColliderBuilder::new(SharedShape::new(HalfSpace::new(Vector::Z)))
    };
    world.colliders.insert(surface(ground, Group::GROUP_1, Group::GROUP_2));
    let tires = scene
        .tires
        .iter()
        .map(|[x, y]| {
            let body = RigidBodyBuilder::dynamic()
                .translation(Vector::new(*x as Real, *y as Real, RADIUS))
                .lock_rotations()
                .can_sleep(tuning.sleep)
                .sleeping(tuning.sleep);
            let ball = ColliderBuilder::ball(RADIUS).mass(TIRE_MASS as Real);
            world.insert(body, surface(ball, Group::GROUP_2, Group::GROUP_1)).0
        })
        .collect();
    (world, tires)
}
