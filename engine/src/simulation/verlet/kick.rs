//! Kick and move of the tires in one register: steps 2 and 3 of [`super`]. [`super::half_kicks`] has the halves of a kick.

use pulp::Simd;

use crate::simulation::pack::Wide;

/// Tires at the start of a step.
#[derive(Clone, Copy)]
pub struct TireRegister<S: Simd> {
    /// Displacement uₙ [m].
    pub u: [Wide<S>; 3],
    /// Velocity at mid-step n − ½ [m/s].
    pub v: [Wide<S>; 3],
    /// Cable force at uₙ [N].
    pub f: [Wide<S>; 3],
    /// Mass [kg].
    pub mass: Wide<S>,
    /// One over mass [1/kg].
    pub inverse_mass: Wide<S>,
    /// Step h [s].
    pub step: Wide<S>,
    /// Coefficient of friction μ.
    pub friction: Wide<S>,
    /// Gravity g into the ground [m/s²].
    pub gravity: Wide<S>,
    /// Gravity along the ground [m/s²].
    pub downhill: [Wide<S>; 2],
}

/// Tires at the end of a step without landing and firing, and their energies at tₙ.
#[derive(Clone, Copy)]
pub struct MovedRegister<S: Simd> {
    /// Displacement uₙ₊₁ [m].
    pub u: [Wide<S>; 3],
    /// Velocity at mid-step n + ½ [m/s].
    pub v: [Wide<S>; 3],
    /// Kinetic and potential energy [J].
    pub energy: Wide<S>,
    /// Energy that friction dissipates over the kick [J], half of it before and half after tₙ.
    pub dissipated: Wide<S>,
    /// 0 for a tire at rest on the ground.
    pub moving: Wide<S>,
}

impl<S: Simd> TireRegister<S> {
    /// Kicks and moves the tires: free velocity v* = v + h (f/m + g), then support and friction of the ground, then u + h v. Roots
    /// and quotients are computed only if a tire slips. `SLOPED`: the ground slopes.
    #[inline(always)]
    pub fn kick_and_move<const SLOPED: bool>(&self, simd: S) -> MovedRegister<S> {
        let Self { u, v, f, mass, inverse_mass, step, friction, gravity, downhill } = *self;
        let zero = Wide::splat(simd, 0.0);
        let along = |c: usize| {
            let pulled = f[c] * inverse_mass;
            if SLOPED { pulled + downhill[c] } else { pulled }
        };
        let free = [
            step.times_plus(along(0), v[0]),
            step.times_plus(along(1), v[1]),
            step.times_plus(f[2] * inverse_mass - gravity, v[2]),
        ];
        let supported = u[2].at_most(zero).and(free[2].less(zero));
        // Sideways speed that friction can take from a supported tire: μR h/m, with the normal impulse per mass R h/m = −v*₃.
        let loss = friction * (zero - free[2]);
        let mut after = [
            supported.select(zero, free[0]),
            supported.select(zero, free[1]),
            supported.select(zero, free[2]),
        ];
        // (3): a tire sticks if friction of less than μR stops it. Otherwise friction is cut to μR, and the tire slips.
        let slips = supported.and((loss * loss).less(free[0].times_plus(free[0], free[1] * free[1])));
        if slips.any() {
            let sliding = slide(simd, [v[0], v[1]], [free[0], free[1]], loss);
            for c in 0..2 {
                after[c] = slips.select(sliding[c], after[c]);
            }
        }
        // Sums with twice the mean velocity: the square is four times the square of the mean, and the work is twice the work of the
        // mean.
        let (mut moved, mut speed2, mut work, mut moving) = (u, zero, zero, u[2]);
        for c in 0..3 {
            let twice = v[c] + after[c];
            speed2 = twice.times_plus(twice, speed2);
            work = twice.times_plus(free[c] - after[c], work);
            moving = moving.either(v[c].either(after[c]));
            moved[c] = step.times_plus(after[c], u[c]);
        }
        let mut height = gravity * u[2];
        if SLOPED {
            height = height - (downhill[0] * u[0] + downhill[1] * u[1]);
        }
        MovedRegister {
            u: moved,
            v: after,
            energy: mass * (Wide::splat(simd, 0.125) * speed2 + height),
            dissipated: Wide::splat(simd, 0.5) * mass * work,
            moving,
        }
    }
}

/// Sideways velocity [m/s] after the kick of a tire that slips. `v` is the velocity before the kick, `free` the velocity after it
/// without friction. Friction takes `loss` [m/s].
///
/// 1. Friction acts against the velocity at tₙ, the mean of the velocities before and after the kick. Against the velocity after
///    the kick, a slide along a curve would be of first order only.
/// 2. This mean is parallel to the mean without friction, (v + free)/2.
/// 3. If friction takes more than all of the mean without friction, the tire turns round. Friction then acts against `free`.
#[inline(always)]
fn slide<S: Simd>(simd: S, v: [Wide<S>; 2], free: [Wide<S>; 2], loss: Wide<S>) -> [Wide<S>; 2] {
    let zero = Wide::splat(simd, 0.0);
    // Twice the mean without friction. Friction takes `loss` from this, too. Only the direction counts.
    let [x, y] = [v[0] + free[0], v[1] + free[1]];
    let goes_on = (loss * loss).at_most(x.times_plus(x, y * y));
    let against = [goes_on.select(x, free[0]), goes_on.select(y, free[1])];
    let speed = against[0].times_plus(against[0], against[1] * against[1]).sqrt();
    let taken = (zero - loss) / speed.max(Wide::splat(simd, f64::MIN_POSITIVE));
    [taken.times_plus(against[0], free[0]), taken.times_plus(against[1], free[1])]
}
