//! Kick and drift of eight tires at once: step 2 and 3 of [`super::verlet`].

use super::cable::{LANES, Pack};

/// What is the same for all tires, per lane.
#[derive(Clone, Copy, Debug)]
pub struct Lanes {
    /// Step h [s].
    pub step: Pack,
    /// Coefficient of friction μ.
    pub friction: Pack,
    /// Gravity [m/s²].
    pub gravity: f64,
}

/// Eight tires at the start of a step.
#[derive(Clone, Copy, Debug)]
pub struct Tires {
    /// Displacement uₙ [m].
    pub u: [Pack; 3],
    /// Velocity at mid-step n − ½ [m/s].
    pub v: [Pack; 3],
    /// Cable force at uₙ [N].
    pub f: [Pack; 3],
    /// Mass [kg].
    pub mass: Pack,
    /// One over mass [1/kg].
    pub inverse: Pack,
}

/// The same tires a step later, were there no landing and no firing, and their energies at tₙ.
#[derive(Clone, Copy, Debug)]
pub struct Kicked {
    /// Displacement uₙ₊₁ [m].
    pub u: [Pack; 3],
    /// Velocity at mid-step n + ½ [m/s].
    pub v: [Pack; 3],
    /// Kinetic energy [J].
    pub kinetic: Pack,
    /// Potential energy [J].
    pub potential: Pack,
    /// Dissipated by friction over the kick, half before and half after tₙ [J].
    pub dissipated: Pack,
    /// Non-zero where a tire has speed or height.
    pub motion: [u64; LANES],
}

impl Tires {
    /// v* = v + h (f/m − g), what the ground leaves of it, and the drift that follows.
    #[inline(always)]
    pub fn kick(&self, lanes: &Lanes) -> Kicked {
        let Self { u, v, f, mass, inverse } = self;
        let mut out = Kicked {
            u: [[0.0; LANES]; 3],
            v: [[0.0; LANES]; 3],
            kinetic: [0.0; LANES],
            potential: [0.0; LANES],
            dissipated: [0.0; LANES],
            motion: [0; LANES],
        };
        for j in 0..LANES {
            let h = lanes.step[j];
            let free = [
                v[0][j] + h * (f[0][j] * inverse[j]),
                v[1][j] + h * (f[1][j] * inverse[j]),
                v[2][j] + h * (f[2][j] * inverse[j] - lanes.gravity),
            ];
            let supported = u[2][j] <= 0.0 && free[2] < 0.0;
            let normal = if supported { -free[2] } else { 0.0 };
            let sideways = (free[0] * free[0] + free[1] * free[1]).sqrt().max(f64::MIN_POSITIVE);
            let keep = (1.0 - lanes.friction[j] * normal / sideways).max(0.0);
            let after = [free[0] * keep, free[1] * keep, if supported { 0.0 } else { free[2] }];
            let mut speed2 = 0.0;
            let mut work = 0.0;
            let mut bits = u[2][j].to_bits();
            for c in 0..3 {
                let mean = 0.5 * (v[c][j] + after[c]);
                speed2 += mean * mean;
                work += (free[c] - after[c]) * mean;
                bits |= v[c][j].to_bits() | after[c].to_bits();
                out.v[c][j] = after[c];
                out.u[c][j] = u[c][j] + h * after[c];
            }
            out.kinetic[j] = 0.5 * mass[j] * speed2;
            out.potential[j] = mass[j] * lanes.gravity * u[2][j];
            out.dissipated[j] = mass[j] * work;
            out.motion[j] = bits << 1;
        }
        out
    }
}
