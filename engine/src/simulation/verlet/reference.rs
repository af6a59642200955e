//! The method of [`super`] as plain as possible: one tire and one cable after another. Nothing sleeps, nothing is an image, and no
//! effect is switched on. Read it beside the paper. A test holds the registers to it.

use nalgebra::Vector3;

use crate::scene::{Cable, Scene, Shot};
use crate::simulation::contact::{HoleImpulse, TireStep};

/// The shelter at time n h after the first firing.
pub struct Reference<'a> {
    scene: &'a Scene,
    shot: &'a Shot,
    /// Step [s].
    h: f64,
    n: usize,
    /// Number of holes that have fired.
    fired: usize,
    /// Displacement uₙ [m] (`n_tires`).
    pub u: Vec<Vector3<f64>>,
    /// Velocity vₙ₋½ [m/s] (`n_tires`).
    pub v: Vec<Vector3<f64>>,
    /// L² at tₙ₋₁ minus L² as laid [m²] (`n_cables`).
    gained: Vec<f64>,
}

/// Velocity of a tire after a kick [m/s]: v* without the ground, and the velocity with the ground.
pub struct Kicked {
    pub free: Vector3<f64>,
    pub after: Vector3<f64>,
}

/// Mean force over the step of a cable on its first tire [N]. `ends` are the displacements of its ends [m]. Updates `gained`, L²
/// minus L² as laid [m²].
pub fn pull(cable: &Cable, ends: [Vector3<f64>; 2], gained: &mut f64) -> Vector3<f64> {
    let d = cable.between(ends);
    let (laid2, rest2, length2) =
        (cable.span.norm_squared(), cable.rest_length * cable.rest_length, d.norm_squared());
    // e = L² − L0², one step before and now.
    let (before, now) = (*gained + (laid2 - rest2), length2 - rest2);
    *gained = length2 - laid2;
    let (was_taut, is_taut) = (before > 0.0, now > 0.0);
    if !was_taut && !is_taut {
        return Vector3::zeros(); // (4)
    }
    let length = length2.sqrt();
    let force = cable.force(length);
    if was_taut == is_taut {
        return force / length * d;
    }
    // A switch within the step: line 7 of `CableEvaluator::evaluate`.
    let (apart, sum) = ((now - before).abs() * (length + cable.rest_length), now + before);
    (force * apart + cable.stiffness / 8.0 * sum * sum) / (apart * length) * d
}

/// Kick of a tire at `height` [m] with the velocity `v` [m/s], under the acceleration `a` of cables and gravity [m/s²].
pub fn kick(height: f64, v: Vector3<f64>, a: Vector3<f64>, friction: f64, h: f64) -> Kicked {
    let free = v + h * a;
    if height > 0.0 || free.z >= 0.0 {
        return Kicked { free, after: free }; // in the air: R = 0, Ff = 0
    }
    // (2): the normal impulse per mass, R h/m = −v*₃, stops the fall. (3): friction takes at most μR h/m of the sideways speed.
    let (sideways, most) = (free.xy(), friction * -free.z);
    if sideways.norm_squared() <= most * most {
        return Kicked { free, after: Vector3::zeros() };
    }
    // Friction acts against the velocity at tₙ, the middle of the kick.
    let middle = 0.5 * (v.xy() + sideways);
    let goes_on = middle.norm_squared() >= (0.5 * most) * (0.5 * most);
    let along = if goes_on { middle } else { sideways };
    Kicked { free, after: (sideways + -most / along.norm() * along).push(0.0) }
}

impl<'a> Reference<'a> {
    pub fn new(scene: &'a Scene, shot: &'a Shot, h: f64) -> Self {
        let zeros = vec![Vector3::zeros(); scene.tire_count()];
        Self {
            scene,
            shot,
            h,
            n: 0,
            fired: 0,
            u: zeros.clone(),
            v: zeros,
            gained: vec![0.0; scene.cables.len()],
        }
    }

    /// One step, from tₙ to tₙ₊₁.
    pub fn step(&mut self) {
        let (force, due) = (self.forces(), self.due());
        for (tire, force) in force.into_iter().enumerate() {
            let (u, v, h) = (self.u[tire], self.v[tire], self.h);
            let a = force * (1.0 / self.scene.mass[tire]) + self.scene.gravity();
            let after = kick(u.z, v, a, self.scene.friction, h).after;
            (self.u[tire], self.v[tire]) = (u + h * after, after);
            let holes: Vec<_> = due.iter().filter(|due| due.0 == tire).map(|due| due.1).collect();
            if self.u[tire].z < 0.0 || !holes.is_empty() {
                // Phase by phase from the velocity at tₙ to the velocity at tₙ₊₁, and back to mid-step.
                let mut step = TireStep::new(u, 0.5 * (v + after), a, self.scene.friction, 0.0);
                let last = step.integrate(h, holes.into_iter());
                (self.u[tire], self.v[tire]) = (step.displacement, step.velocity - last * (0.5 * h));
            }
        }
        self.n += 1;
    }

    /// Sum of the cable forces on each tire [N]. The cables that begin at a tire are added first.
    fn forces(&mut self) -> Vec<Vector3<f64>> {
        let Self { scene, u, gained, .. } = self;
        let cables = || scene.cables.iter();
        let pulls: Vec<_> = cables()
            .zip(gained)
            .map(|(cable, gained)| pull(cable, cable.ends.map(|end| u[end]), gained))
            .collect();
        let mut sum = vec![Vector3::zeros(); u.len()];
        cables().zip(&pulls).for_each(|(cable, pull)| sum[cable.ends[0]] += pull);
        cables().zip(&pulls).for_each(|(cable, pull)| sum[cable.ends[1]] -= pull);
        sum
    }

    /// Impulses of the holes that fire in this step, each with its tire.
    fn due(&mut self) -> Vec<(usize, HoleImpulse)> {
        let (start, first) = (self.n as f64 * self.h, self.shot.firings[0].time);
        let mut due = Vec::new();
        while let Some(firing) = self.shot.firings.get(self.fired)
            && firing.time - first < start + self.h
        {
            let since_start = (firing.time - first - start).clamp(0.0, self.h);
            due.push((
                firing.tire,
                HoleImpulse { since_start, launch: firing.launch, ..HoleImpulse::default() },
            ));
            self.fired += 1;
        }
        due
    }
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use nalgebra::Vector2;
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use crate::choice::Method;
    use crate::scene::{Firing, TireId};
    use crate::simulation::verlet::{Part, Stepper};
    use crate::simulation::wake::tests::scenes;
    use crate::simulation::{Motion, RunSettings};

    /// Three to thirty tires near a grid, of any mass, tied at random, with holes under some of them.
    fn random_scene(rng: &mut ChaCha8Rng) -> (Scene, Shot) {
        let count = rng.random_range(3..=30);
        let position: Vec<Vector3<f64>> = (0..count)
            .map(|n| {
                let place = 2.0 * Vector2::new((n % 5) as f64, (n / 5) as f64);
                let off = Vector2::from_fn(|_, _| rng.random_range(-0.4..0.4));
                // Some tires lie in line, so that their cables are parallel and share registers.
                (if n % 3 == 0 { place + off } else { place }).push(0.0)
            })
            .collect();
        let mut cables = Vec::new();
        for a in 0..count {
            for b in a + 1..count {
                let span = position[b] - position[a];
                if span.norm() < 3.2 && rng.random_bool(0.8) {
                    let rest_length = span.norm() * rng.random_range(1.0..1.05);
                    let stiffness = 10_f64.powf(rng.random_range(4.5..6.0)) / rest_length;
                    cables.push(Cable { ends: [a, b], rest_length, stiffness, span });
                }
            }
        }
        let firing = |rng: &mut ChaCha8Rng| {
            let sideways = if rng.random() { rng.random_range(-2.0..2.0) } else { 0.0 };
            let launch =
                Vector3::new(sideways, rng.random_range(-1.0..1.0) * sideways, rng.random_range(2.0..7.0));
            Firing::at_once(rng.random_range(0.0..0.15), rng.random_range(0..count), launch)
        };
        let firings = (0..rng.random_range(1..=8)).map(|_| firing(rng)).collect();
        let scene = Scene {
            mass: (0..count).map(|_| rng.random_range(50.0..600.0)).collect(),
            tire_ids: (1..=count).map(TireId::Listed).collect(),
            cables,
            friction: rng.random_range(0.0..0.9),
            position,
            ..scenes().0
        };
        (scene, Shot::from_firings(firings))
    }

    /// Greatest distance of a tire from its place in the reference, over all steps of a run [m].
    fn greatest_distance(arch: pulp::Arch, scene: &Scene, shot: &Shot, step: f64) -> f64 {
        let settings =
            RunSettings { method: Method::Verlet, step, duration: Some(shot.firings[0].time + 0.5) };
        let (mut reference, mut distance) = (Reference::new(scene, shot, step), 0.0_f64);
        let mut watch = |motion: &dyn Motion| {
            let apart = |tire: usize| (motion.displacement(tire) - reference.u[tire]).amax();
            distance = (0..scene.tire_count()).map(apart).fold(distance, f64::max);
            reference.step();
            ControlFlow::Continue(())
        };
        Stepper::new(&Part::new(scene, &[]), scene, shot, &settings).run(arch, &mut watch).expect("a run");
        assert!(reference.n as f64 * step > 0.3, "{} steps are too few", reference.n);
        distance
    }

    /// Sorts the cables in the order in which the register path sums the forces of a tire.
    fn sorted(mut scene: Scene) -> Scene {
        scene.cables.sort_by_key(|cable| (cable.ends[1] - cable.ends[0], cable.ends[0]));
        scene
    }

    /// The scalar registers make the same operations as the reference, in the same order. Wider registers round once if they have a
    /// fused instruction. Measured: at most 1.1e-14 m after half a second. The test accepts a thousand times as much.
    #[test]
    fn registers_move_tires_as_the_reference_does() {
        let mut rng = ChaCha8Rng::seed_from_u64(36);
        let (mesh, shots) = scenes();
        let meshes = shots.into_iter().take(2).map(|shot| (mesh.clone(), shot));
        let random = (0..200).map(|_| random_scene(&mut rng));
        for (n, (scene, shot)) in meshes.chain(random).enumerate() {
            let scene = sorted(scene);
            let step = (0.1 * scene.critical_step()).min(2e-3);
            assert_eq!(greatest_distance(pulp::Arch::Scalar, &scene, &shot, step), 0.0, "scene {n}");
            let wide = greatest_distance(pulp::Arch::new(), &scene, &shot, step);
            assert!(wide < 1e-11, "scene {n}: {wide} m");
        }
    }

    /// The example "One step of one tire, with numbers" of the manual.
    #[test]
    fn the_manual_steps_as_the_reference_does() {
        const MANUAL: &str = include_str!("../../../../docs/model.md");
        let (mass, friction, gravity, h, rest_length) = (280.0, 0.5, Vector3::z() * -9.81, 1e-3, 2.02);
        let cable =
            Cable { ends: [0, 1], rest_length, stiffness: 1.4e6 / rest_length, span: Vector3::x() * 2.0 };
        let (other, v) = (Vector3::new(0.01, 0.0, 0.3), Vector3::new(0.4, 0.3, 0.0));
        // The cable was taut one step before, too: no switch.
        let force = pull(&cable, [Vector3::zeros(), other], &mut 0.2);
        let a = force * (1.0 / mass) + gravity;
        let Kicked { free, after } = kick(0.0, v, a, friction, h);
        let middle = 0.5 * (v + free).xy();
        let most = friction * -free.z;
        let by_hand = free.xy() - most * middle.normalize();
        assert!((after.xy() - by_hand).norm() < 1e-15 && after.z == 0.0);
        let length = cable.between([Vector3::zeros(), other]).norm();
        let digits = |values: &[f64], digits: usize, unit: &str| {
            let numbers: Vec<String> = values.iter().map(|value| format!("{value:.digits$}")).collect();
            format!("| {} {unit} |", numbers.join(", ").replace('-', "−"))
        };
        let rows = [
            ("length of the cable L", digits(&[length], 6, "m")),
            ("force N, since", digits(&[force.norm()], 2, "N")),
            ("pull along x, y and up", digits(force.as_slice(), 2, "N")),
            ("acceleration without the ground a", digits(a.as_slice(), 5, "m/s²")),
            ("velocity without the ground v*", digits(free.as_slice(), 6, "m/s")),
            ("reaction of the ground R", digits(&[-mass * free.z / h], 1, "N")),
            ("speed that friction can take", digits(&[most], 6, "m/s")),
            ("does the tire stick?", digits(&[free.xy().norm()], 6, "m/s").replace("| ", "| no: ")),
            ("velocity at the middle of the kick", digits(middle.as_slice(), 6, "m/s")),
            ("velocity half a step later", digits(after.as_slice(), 6, "m/s")),
            ("way over the step", digits((1e3 * h * after.xy()).as_slice(), 6, "mm")),
        ];
        for (quantity, value) in rows {
            let row = MANUAL.lines().find(|line| line.starts_with(&format!("| {quantity}")));
            assert!(
                row.is_some_and(|row| row.ends_with(&value)),
                "{quantity} is {value}, the manual has {row:?}"
            );
        }
    }
}
