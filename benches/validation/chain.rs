//! A folded chain falls: both ends hang at one height, and one is let go (Calkin and March, Am. J. Phys. 57, 1989).
//!
//! In the limit of many links no energy is lost. Where the free end has fallen by x of the length L of a chain of mass M,
//! v² = g x (2L − x)/(L − x): it falls faster than a free body, pulled by the fold. The momentum of the moving arm,
//! M (L − x) v/2L, gives the mean force of the support between two places. Here N masses M/N hang on N ties that only pull, the first
//! at an anchor.

use nalgebra::Vector3;
use shelter::choice::Method;
use shelter::simulation::RunError;

use super::rig::{GRAVITY, History, Rig};

/// Length [m] and mass [kg] of the chain.
const LENGTH: f64 = 1.0;
const MASS: f64 = 1.0;
/// Stiffness EA of the chain over its weight: its own weight stretches it by less than 10⁻⁴.
const STIFFNESS: f64 = 1e4;

/// Places of the free end, x/L, at which the fall is compared.
pub const PLACES: [f64; 3] = [0.5, 0.8, 0.9];
/// Half the way over which speed and force are averaged, in L: links that swing to and fro make both jump about.
pub const AROUND: f64 = 0.05;

/// Mean speed and force, and time, at one of [`PLACES`].
#[derive(Clone, Copy, Debug)]
pub struct Passage {
    /// Time over √(L/g).
    pub time: f64,
    /// Mean speed over √(gL), from x − [`AROUND`] L to x + [`AROUND`] L.
    pub speed: f64,
    /// Mean force of the support over the weight, on the same way.
    pub force: f64,
}

/// A whole fall.
pub struct Fall {
    /// Passages at [`PLACES`].
    pub passages: [Passage; 3],
    /// Time at which the free end is lowest, over √(L/g).
    pub duration: f64,
    /// Greatest force of the support over the weight.
    pub greatest_force: f64,
}

/// Fall of a chain without links, whose greatest force is infinite.
pub fn exact() -> Fall {
    let speed = |x: f64| (x * (2.0 - x) / (1.0 - x)).sqrt();
    // x = s² takes the root out of dx/v; midpoints leave out both ends.
    let time = |x: f64| {
        let (parts, width) = (20_000, x.sqrt() / 20_000.0);
        let slow = |s: f64| 2.0 * ((1.0 - s * s) / (2.0 - s * s)).sqrt();
        (0..parts).map(|n| slow((f64::from(n) + 0.5) * width) * width).sum::<f64>()
    };
    let momentum = |x: f64| 0.5 * (1.0 - x) * speed(x);
    let passage = |x: f64| {
        let (from, to) = (x - AROUND, x + AROUND);
        let duration = time(to) - time(from);
        let force = 1.0 - (momentum(to) - momentum(from)) / duration;
        Passage { time: time(x), speed: (to - from) / duration, force }
    };
    Fall { passages: PLACES.map(passage), duration: time(1.0), greatest_force: f64::INFINITY }
}

/// Fall of a chain of `links` links, an odd number, at a step that is `part` of the time a wave takes for a link.
pub fn fall(links: usize, method: Method, part: f64) -> Result<Fall, RunError> {
    let (link, mass) = (LENGTH / links as f64, MASS / links as f64);
    let weight = mass * GRAVITY;
    let stiffness = STIFFNESS * MASS * GRAVITY / link;
    let held = links / 2;
    let mut rig = Rig::upright(GRAVITY);
    let mut above = rig.anchor(Vector3::zeros());
    for n in 1..=links {
        // Down the held arm, across, and up to the height of the support.
        let across = if n > held { link } else { 0.0 };
        let depth = if n > held { links - n } else { n } as f64 * link;
        let here = rig.mass(mass, Vector3::new(across, -depth, 0.0), Vector3::zeros());
        // At the start the ties of the held arm carry what hangs on them.
        let carried = (held + 1).saturating_sub(n) as f64 * weight;
        rig.tie([above, here], link - carried / stiffness, stiffness);
        above = here;
    }
    let (support, free_end) = (0, above);
    let step = part * (mass / stiffness).sqrt();
    let unit = (LENGTH / GRAVITY).sqrt();
    let (mut fallen, mut force) = (History::default(), History::default());
    rig.run(method, step, 1.3 * unit, |motion| {
        fallen.0.push([motion.time() / unit, -motion.displacement(free_end).y / LENGTH]);
        force.0.push([motion.time() / unit, motion.force(support) / (MASS * GRAVITY)]);
    })?;
    let time = |x: f64| fallen.passage(x).map_or(f64::NAN, |[time, _]| time);
    let passage = |place: f64| {
        let (from, to) = (time(place - AROUND), time(place + AROUND));
        let within = force.0.iter().filter(|[at, _]| (from..to).contains(at));
        let (sum, count) = within.fold((0.0, 0.0), |(sum, count), [_, force]| (sum + force, count + 1.0));
        Passage { time: time(place), speed: 2.0 * AROUND / (to - from), force: sum / count }
    };
    let lowest = fallen.turning_points().into_iter().find(|[_, fallen]| *fallen > 0.9);
    Ok(Fall {
        passages: PLACES.map(passage),
        duration: lowest.map_or(f64::NAN, |[time, _]| time),
        greatest_force: force.0.iter().map(|[_, force]| *force).fold(0.0, f64::max),
    })
}
