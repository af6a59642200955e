//! Kick and drift of a register of tires: step 2 and 3 of [`super::verlet`].

use pulp::Simd;

use super::pack::Wide;

/// Tires at the start of a step.
#[derive(Clone, Copy)]
pub struct Tires<S: Simd> {
    /// Displacement uₙ [m].
    pub u: [Wide<S>; 3],
    /// Velocity at mid-step n − ½ [m/s].
    pub v: [Wide<S>; 3],
    /// Cable force at uₙ [N].
    pub f: [Wide<S>; 3],
    /// Mass [kg].
    pub mass: Wide<S>,
    /// One over mass [1/kg].
    pub inverse: Wide<S>,
    /// Step h [s].
    pub step: Wide<S>,
    /// Coefficient of friction μ.
    pub friction: Wide<S>,
    /// Gravity [m/s²].
    pub gravity: Wide<S>,
}

/// The same tires a step later, were there no landing and no firing, and their energies at tₙ.
#[derive(Clone, Copy)]
pub struct Kicked<S: Simd> {
    /// Displacement uₙ₊₁ [m].
    pub u: [Wide<S>; 3],
    /// Velocity at mid-step n + ½ [m/s].
    pub v: [Wide<S>; 3],
    /// Kinetic and potential energy [J].
    pub energy: Wide<S>,
    /// Dissipated by friction over the kick, half before and half after tₙ [J].
    pub dissipated: Wide<S>,
    /// Positive where a tire has speed or height.
    pub motion: Wide<S>,
}

impl<S: Simd> Tires<S> {
    /// v* = v + h (f/m − g), what the ground leaves of it, and the drift that follows. Roots and quotients only where a tire
    /// slips.
    #[inline(always)]
    pub fn kick(&self, simd: S) -> Kicked<S> {
        let Self { u, v, f, mass, inverse, step, friction, gravity } = *self;
        let (zero, half) = (Wide::splat(simd, 0.0), Wide::splat(simd, 0.5));
        let (one, tiny) = (Wide::splat(simd, 1.0), Wide::splat(simd, f64::MIN_POSITIVE));
        let free = [
            step.times_plus(f[0] * inverse, v[0]),
            step.times_plus(f[1] * inverse, v[1]),
            step.times_plus(f[2] * inverse - gravity, v[2]),
        ];
        let supported = u[2].at_most(zero).and(free[2].less(zero));
        let limit = friction * free[2];
        let sideways2 = free[0].times_plus(free[0], free[1] * free[1]);
        let mut keep = supported.select(zero, one);
        if supported.and((limit * limit).less(sideways2)).any() {
            let left = one + limit / sideways2.sqrt().max(tiny);
            keep = supported.select(left.max(zero), one);
        }
        let after = [free[0] * keep, free[1] * keep, supported.select(zero, free[2])];
        let (mut moved, mut speed2, mut work, mut motion) = (u, zero, zero, u[2].abs());
        for c in 0..3 {
            let mean = half * (v[c] + after[c]);
            speed2 = mean.times_plus(mean, speed2);
            work = mean.times_plus(free[c] - after[c], work);
            motion = motion.max(v[c].abs()).max(after[c].abs());
            moved[c] = step.times_plus(after[c], u[c]);
        }
        Kicked {
            u: moved,
            v: after,
            energy: mass * (half * speed2 + gravity * u[2]),
            dissipated: mass * work,
            motion,
        }
    }
}
