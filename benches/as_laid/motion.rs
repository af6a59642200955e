//! Motion of tires and ties a third time, as simply as can be: velocity Verlet at a small fixed step.
//!
//! Written from the equations of the model, apart from the program's simulation: it shares no type and no line with it. One step of
//! length h:
//!
//! 1. v ← v + h/2 (f/m + g), f the pull of the taut ties. A tire on the ground whose v_z is then negative gets the impulse −m v_z
//!    of the ground, and loses up to μ times that of its horizontal momentum.
//! 2. u ← u + h v. A tire below the ground lands: u_z and v_z become 0, and friction takes up to μ m |v_z|.
//! 3. Line 1 again, with the pull at the new places.
//!
//! A step ends where a hole fires. The run ends once all holes have fired and all tires are at rest.

use nalgebra::{Vector2, Vector3};

/// Point masses on the ground, and ties between them.
pub struct Shelter {
    /// Masses [kg] (`n_tires`).
    pub masses: Vec<f64>,
    /// Coefficient of friction.
    pub friction: f64,
    /// Gravity [m/s²]; the third axis is the ground's normal.
    pub gravity: Vector3<f64>,
    /// Ties (`n_ties`).
    pub ties: Vec<Tie>,
}

/// A tie that only pulls, with k s where it is stretched by s > 0.
pub struct Tie {
    /// Its two tires.
    pub ends: [usize; 2],
    /// Vector between its fastenings at rest [m].
    pub span: Vector3<f64>,
    /// Length without stretch [m].
    pub length: f64,
    /// k [N/m].
    pub stiffness: f64,
    /// Breaking force over that of the plan.
    pub strength: f64,
}

/// A velocity [m/s] that a tire gets at a time [s].
pub struct Launch {
    pub time: f64,
    pub tire: usize,
    pub velocity: Vector3<f64>,
}

/// Greatest values that a shot may reach; infinite where there is no limit.
#[derive(Clone, Copy)]
pub struct Bounds {
    /// Height of a tire [m].
    pub height: f64,
    /// Force of a tie over its strength [N].
    pub force: f64,
    /// Horizontal shift of a tire at the end [m].
    pub drift: f64,
}

impl Bounds {
    pub const NONE: Self = Self { height: f64::INFINITY, force: f64::INFINITY, drift: f64::INFINITY };
}

/// Greatest values that a shot reached; of a shot that fails, up to its first failure.
#[derive(Clone, Copy, Default)]
pub struct Reached {
    /// Height of a tire [m].
    pub height: f64,
    /// Force of a tie over its strength [N].
    pub force: f64,
    /// Horizontal shift of a tire at the end [m].
    pub drift: f64,
}

impl Reached {
    /// Whether a value is beyond its bound.
    pub fn fails(&self, bounds: &Bounds) -> bool {
        self.height > bounds.height || self.force > bounds.force || self.drift > bounds.drift
    }
}

/// Time after the last hole at which a run ends even if tires still move [s]: far longer than any flight of these plans.
const LONGEST: f64 = 20.0;

/// Motion of `shelter` under `launches`, in order of time, at this `step` [s]. It ends early where height or force is beyond `bounds`.
pub fn run(shelter: &Shelter, launches: &[Launch], step: f64, bounds: &Bounds) -> Reached {
    let count = shelter.masses.len();
    let mut shifts = vec![Vector3::zeros(); count];
    let mut velocities = vec![Vector3::zeros(); count];
    let mut accelerations = vec![shelter.gravity; count];
    let mut reached = Reached::default();
    let mut launches = launches.iter().peekable();
    let mut now = launches.peek().map_or(0.0, |launch| launch.time);
    let mut end = now;
    loop {
        while let Some(launch) = launches.next_if(|launch| launch.time <= now) {
            velocities[launch.tire] += launch.velocity;
            end = now + LONGEST;
        }
        let still =
            shifts.iter().zip(&velocities).all(|(u, v): (&Vector3<f64>, _)| u.z == 0.0 && v.norm() == 0.0);
        let next = launches.peek().map(|launch| launch.time);
        if next.is_none() && (still || now >= end) || reached.fails(bounds) {
            break;
        }
        // What rests stays at rest until the next hole.
        if let Some(next) = next.filter(|_| still) {
            now = next;
            continue;
        }
        let until = next.map_or(f64::INFINITY, |next| next - now);
        let length = step.min(until);
        kick(shelter, &mut velocities, &shifts, &accelerations, 0.5 * length);
        for (shift, velocity) in shifts.iter_mut().zip(&mut velocities) {
            *shift += length * *velocity;
            if shift.z < 0.0 {
                shift.z = 0.0;
                hit_ground(velocity, shelter.friction);
            }
            reached.height = reached.height.max(shift.z);
        }
        reached.force = reached.force.max(pull(shelter, &shifts, &mut accelerations));
        kick(shelter, &mut velocities, &shifts, &accelerations, 0.5 * length);
        now = if length == until { next.unwrap_or(now) } else { now + length };
    }
    reached.drift = shifts.iter().map(|shift| shift.xy().norm()).fold(0.0, f64::max);
    reached
}

/// Velocities [m/s] after these accelerations [m/s²] for a time [s].
fn kick(
    shelter: &Shelter,
    velocities: &mut [Vector3<f64>],
    shifts: &[Vector3<f64>],
    accelerations: &[Vector3<f64>],
    time: f64,
) {
    for ((velocity, shift), acceleration) in velocities.iter_mut().zip(shifts).zip(accelerations) {
        *velocity += time * acceleration;
        if shift.z <= 0.0 && velocity.z <= 0.0 {
            hit_ground(velocity, shelter.friction);
        }
    }
}

/// Takes the velocity into the ground [m/s], and by friction up to μ times that along the ground.
fn hit_ground(velocity: &mut Vector3<f64>, friction: f64) {
    let (along, lost): (Vector2<f64>, f64) = (velocity.xy(), friction * -velocity.z);
    let speed = along.norm();
    let left = if speed > lost { 1.0 - lost / speed } else { 0.0 };
    *velocity = (along * left).push(0.0);
}

/// Fills in the accelerations by ties and gravity [m/s²]; returns the greatest force of a tie over its strength [N].
fn pull(shelter: &Shelter, shifts: &[Vector3<f64>], accelerations: &mut [Vector3<f64>]) -> f64 {
    accelerations.fill(shelter.gravity);
    let mut greatest = 0.0_f64;
    for tie in &shelter.ties {
        let [a, b] = tie.ends;
        let line = tie.span + shifts[b] - shifts[a];
        if line.norm_squared() <= tie.length * tie.length {
            continue;
        }
        let length = line.norm();
        let force = tie.stiffness * (length - tie.length);
        greatest = greatest.max(force / tie.strength);
        let along = line * (force / length);
        accelerations[a] += along / shelter.masses[a];
        accelerations[b] -= along / shelter.masses[b];
    }
    greatest
}
