//! Draws the shots that `[uncertainty]` describes.
//!
//! A sample is a variant of the scene and of the shot. Every draw follows from the seed, the number of the sample, and the purpose
//! of the draw: an input of the whole shot, a gap between blast rows, a blast row, a tire, or a cable. So a sample does not depend
//! on threads, shards, accuracy or the order of options. The options of a plan are compared on the same draws.
//!
//! Factors on launch velocities, masses and breaking forces are lognormal with mean 1. The launch velocity of a hole belongs to the
//! tire over it in the plan, with the mass of that tire. The [mass law](crate::plan::mass_law) says how fast a tire of another mass
//! leaves. Each gap between blast rows scatters on its own and shifts all later rows. Each gap between the holes of a row scatters
//! on its own, too, and shifts the later holes of its side.
//!
//! Each hole lies beside its planned place, and the shelter lies beside the whole pattern. The nearest tire gets the impulse, along
//! the line from below the hole ([`PushLine`]). The slopes of that line, of the whole shot and of each hole add. Each hole may fail
//! on its own. A cable is as long as it was tied, and never shorter than the distance that it spans.
//!
//! Functions such as the exponential come from `libm`, not from the system: the last digits differ between systems.

use std::iter::repeat_n;

use nalgebra::Vector2;
use rand::seq::IteratorRandom;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::plan::Uncertainty;
use crate::plan::keys::{Key, uncertainty};
use crate::plan::mass_law::launch_factor;
use crate::scene::{
    Firing, PushLine, Scene, Shot, Wiring, change_cables, direction_of_slope, lengthen_cables,
};
use crate::study::Case;

/// An input that is the same in the whole shot and is not known exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Input {
    /// Factor on all launch velocities.
    LaunchCommon,
    /// Coefficient of friction.
    Friction,
    /// Slack of all cables [%].
    Slack,
    /// Factor on the axial stiffness of all cables.
    AxialStiffness,
    /// Factor on all launch velocities that the next shot draws anew.
    LaunchBetweenShots,
    /// Exponent of the mass law.
    MassExponent,
    /// Slope of all launches along x.
    CommonSlopeX,
    /// Slope of all launches along y.
    CommonSlopeY,
    /// Offset of the shelter from its planned place along x [m].
    OffsetX,
    /// Offset of the shelter from its planned place along y [m].
    OffsetY,
    /// Number of holes that do not fire.
    Duds,
}

impl Input {
    /// Every input, in the order of the values of [`DrawnShot::inputs`].
    pub const ALL: [Input; 11] = [
        Input::LaunchCommon,
        Input::Friction,
        Input::Slack,
        Input::AxialStiffness,
        Input::LaunchBetweenShots,
        Input::MassExponent,
        Input::CommonSlopeX,
        Input::CommonSlopeY,
        Input::OffsetX,
        Input::OffsetY,
        Input::Duds,
    ];

    /// The key of a plan that says how uncertain the input is.
    pub fn key(self) -> &'static Key {
        match self {
            Input::LaunchCommon => &uncertainty::LAUNCH_COMMON_PERCENT,
            Input::Friction => &uncertainty::FRICTION,
            Input::Slack => &uncertainty::SLACK_PERCENT,
            Input::AxialStiffness => &uncertainty::AXIAL_STIFFNESS_PERCENT,
            Input::LaunchBetweenShots => &uncertainty::LAUNCH_BETWEEN_SHOTS_PERCENT,
            Input::MassExponent => &uncertainty::LAUNCH_MASS_EXPONENT,
            Input::CommonSlopeX | Input::CommonSlopeY => &uncertainty::LAUNCH_TILT_COMMON_DEG,
            Input::OffsetX | Input::OffsetY => &uncertainty::PATTERN_OFFSET_M,
            Input::Duds => &uncertainty::HOLE_FAILS_PERCENT,
        }
    }

    /// Whether the next shot has the same value.
    pub fn repeats(self) -> bool {
        matches!(
            self,
            Input::LaunchCommon
                | Input::Friction
                | Input::Slack
                | Input::AxialStiffness
                | Input::MassExponent
        )
    }
}

/// One drawn sample: its shelter and its shot.
#[derive(Clone, Debug)]
pub struct DrawnShot {
    /// The shelter with the numbers of the sample.
    pub scene: Scene,
    /// The shot with the numbers of the sample.
    pub shot: Shot,
    /// Values of the inputs in [`Input::ALL`].
    pub inputs: [f64; Input::ALL.len()],
    /// Shift of all firing times after the draw, so that no hole fires before time 0 [s].
    pub later: f64,
}

/// The random numbers of one sample, kept apart by their purpose.
struct Random(ChaCha8Rng);

/// Purpose of draws within a sample.
#[derive(Clone, Copy)]
enum Draws {
    WholeShot,
    Gaps,
    BlastRow(usize),
    LaunchOfRow(usize),
    Tire(usize),
    HolesUnder(usize),
    Cable(usize),
    LengthOf(usize),
    Wiring,
}

impl Random {
    fn new(seed: u64, number: usize) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(number as u64);
        Self(random)
    }

    /// Moves to the random numbers of these draws. Each tire has room for a hundred thousand holes.
    fn at(&mut self, draws: Draws) -> &mut ChaCha8Rng {
        let word = match draws {
            Draws::WholeShot => 0,
            Draws::Gaps => 1 << 32,
            Draws::BlastRow(row) => (1 << 40) + ((row as u128) << 20),
            Draws::LaunchOfRow(row) => (1 << 43) + ((row as u128) << 6),
            Draws::Tire(tire) => (1 << 44) + ((tire as u128) << 20),
            Draws::HolesUnder(tire) => (1 << 52) + ((tire as u128) << 20),
            Draws::Cable(cable) => (1 << 60) + ((cable as u128) << 6),
            Draws::LengthOf(cable) => (1 << 61) + ((cable as u128) << 6),
            Draws::Wiring => 1 << 36,
        };
        self.0.set_word_pos(word);
        &mut self.0
    }
}

/// Lognormal factor with mean 1 and a coefficient of variation [%].
fn factor(random: &mut ChaCha8Rng, cv_percent: f64) -> f64 {
    let variance = libm::log1p((cv_percent * 1e-2).powi(2));
    libm::exp(variance.sqrt() * normal(random) - 0.5 * variance)
}

fn normal(random: &mut ChaCha8Rng) -> f64 {
    StandardNormal.sample(random)
}

/// Sample `number` of the shots that the plan describes beside `planned`. If the plan leaves open which holes a dud takes along,
/// there is one shot for each way. A verdict counts the worst of them.
pub fn draw_shots(case: &Case, planned: &Shot, seed: u64, number: usize) -> Vec<DrawnShot> {
    let draw = Draw::new(case, planned, seed, number);
    let mut lost: Vec<Vec<bool>> = Vec::new();
    for wiring in Wiring::all().take(if draw.is_open() { usize::MAX } else { 1 }) {
        let of_wiring = draw.lost_with(wiring);
        if !lost.contains(&of_wiring) {
            lost.push(of_wiring);
        }
    }
    let draws = repeat_n(draw, lost.len());
    draws.zip(lost).map(|(draw, lost)| draw.without(&lost)).collect()
}

/// The same sample as one shot: the wiring that the plan leaves open is drawn, too.
pub fn draw_shot(case: &Case, planned: &Shot, seed: u64, number: usize) -> DrawnShot {
    let draw = Draw::new(case, planned, seed, number);
    let mut random = Random::new(seed, number);
    let wiring = if draw.is_open() { Wiring::all().choose(random.at(Draws::Wiring)) } else { None };
    let lost = draw.lost_with(wiring.unwrap_or_default());
    draw.without(&lost)
}

/// The draws of one sample, before its duds take other holes along.
#[derive(Clone)]
struct Draw<'p> {
    planned: &'p Shot,
    scene: Scene,
    /// All holes, duds included, in the order of `planned` (`n_holes`).
    firings: Vec<Firing>,
    duds: Vec<bool>,
    friction: f64,
    /// Values of all inputs but the last, which is [`Input::Duds`].
    inputs: [f64; Input::ALL.len() - 1],
}

impl<'p> Draw<'p> {
    fn new(case: &Case, planned: &'p Shot, seed: u64, number: usize) -> Self {
        let uncertainty = &case.plan.uncertainty;
        let mut random = Random::new(seed, number);
        let whole = random.at(Draws::WholeShot);
        let launch_common = factor(whole, uncertainty.launch_common_percent);
        let mut between = |[low, high]: [f64; 2]| low + (high - low) * whole.random::<f64>();
        let friction = between(uncertainty.friction);
        let slack_percent = between(uncertainty.slack_percent);
        let stiffness = 1.0 + 1e-2 * between(uncertainty.axial_stiffness_percent);
        let mass_exponent = between(uncertainty.launch_mass_exponent);
        let launch_of_shot = factor(whole, uncertainty.launch_between_shots_percent);
        let slope = on_both_axes(whole, tangent(uncertainty.launch_tilt_common_deg));
        let offset = on_both_axes(whole, uncertainty.pattern_offset_m);
        let launches =
            LaunchesOfShot { factor: launch_common * launch_of_shot, mass_exponent, slope, offset };

        let mut firings = planned.firings.clone();
        scatter_gaps(planned, &mut firings, uncertainty, &mut random);
        let mut scene = case.scene().clone();
        let duds = scatter_tires(&mut scene, &mut firings, uncertainty, &launches, &mut random);
        change_cables(&mut scene, &case.plan, slack_percent, stiffness);
        if uncertainty.cable_length_m > 0.0 {
            let axial_stiffness = case.plan.cable.axial_stiffness_kn * 1e3 * stiffness;
            let longer = |cable| uncertainty.cable_length_m * normal(random.at(Draws::LengthOf(cable)));
            lengthen_cables(&mut scene, &case.plan, axial_stiffness, longer);
        }
        if uncertainty.breaking_force_cv_percent > 0.0 {
            let strength =
                |cable| factor(random.at(Draws::Cable(cable)), uncertainty.breaking_force_cv_percent);
            scene.strength = (0..scene.cables.len()).map(strength).collect();
        }
        let differ_tire_by_tire = uncertainty.tire_mass_cv_percent > 0.0;
        let differ_cable_by_cable =
            uncertainty.breaking_force_cv_percent > 0.0 || uncertainty.cable_length_m > 0.0;
        if differ_tire_by_tire || differ_cable_by_cable {
            scene.mirrors.clear();
        }
        let inputs = [
            launch_common,
            friction,
            slack_percent,
            stiffness,
            launch_of_shot,
            mass_exponent,
            slope.x,
            slope.y,
            offset.x,
            offset.y,
        ];
        Self { planned, scene, firings, duds, friction, inputs }
    }

    /// Whether the plan leaves open which holes the duds take along.
    fn is_open(&self) -> bool {
        self.planned.fired_through && self.duds.contains(&true)
    }

    /// Which holes do not fire (`n_holes`), by the planned times.
    fn lost_with(&self, wiring: Wiring) -> Vec<bool> {
        self.planned.lost_with(self.duds.clone(), wiring)
    }

    /// The sample without the `lost` holes.
    fn without(self, lost: &[bool]) -> DrawnShot {
        let count_of_lost = lost.iter().filter(|lost| **lost).count() as f64;
        let fired = self.firings.iter().zip(lost).filter(|(_, lost)| !**lost).map(|(firing, _)| *firing);
        let mut fired: Vec<Firing> = fired.collect();
        // No hole may fire before the start: all firings are shifted, and so is the end of the run.
        let later = -fired.iter().map(|firing| firing.time).fold(0.0, f64::min);
        fired.iter_mut().for_each(|firing| firing.time += later);
        let shot = Shot { friction: Some(self.friction), ..self.planned.with_firings(fired) };
        let mut inputs = [count_of_lost; Input::ALL.len()];
        inputs[..self.inputs.len()].copy_from_slice(&self.inputs);
        DrawnShot { scene: self.scene, shot, inputs, later }
    }
}

/// Tangent of an angle [°].
fn tangent(degrees: f64) -> f64 {
    libm::tan(degrees.to_radians())
}

/// Normal deviations along x and y with the standard deviation `deviation`.
fn on_both_axes(random: &mut ChaCha8Rng, deviation: f64) -> Vector2<f64> {
    let x = deviation * normal(random);
    Vector2::new(x, deviation * normal(random))
}

/// Shifts the firing times of a `planned` shot [s] by the scatter of the gaps before them: gaps between the rows, and gaps between
/// the holes of their row.
fn scatter_gaps(planned: &Shot, firings: &mut [Firing], uncertainty: &Uncertainty, random: &mut Random) {
    let rows = planned.rows_of_chains(Wiring::default());
    let begins = |chains: &[Vec<usize>]| planned.firings[chains[0][0]].time;
    let starts: Vec<f64> = rows.iter().map(|(_, chains)| begins(chains)).collect();
    let scattered_starts = scatter_chain(&starts, uncertainty, random.at(Draws::Gaps));
    for ((row, chains), start) in rows.iter().zip(scattered_starts) {
        let first = begins(chains);
        let random = random.at(Draws::BlastRow(*row));
        for chain in chains {
            let of_chain = chain.iter().map(|&n| planned.firings[n].time);
            let planned: Vec<f64> = [first].into_iter().chain(of_chain).collect();
            let scattered = scatter_chain(&planned, uncertainty, random);
            for (&n, at) in chain.iter().zip(&scattered[1..]) {
                firings[n].time = at - first + start;
            }
        }
    }
}

/// Firing times [s] of a chain in which each firing starts the next. Every gap between the `planned` times (sorted) scatters and
/// shifts all later times. A gap is a delay, so it is never negative.
fn scatter_chain(planned: &[f64], uncertainty: &Uncertainty, random: &mut ChaCha8Rng) -> Vec<f64> {
    let mut at = planned.to_vec();
    for n in 1..planned.len() {
        let gap = planned[n] - planned[n - 1];
        at[n] = match gap > 0.0 {
            true => at[n - 1] + (gap + uncertainty.delay.deviation(gap) * normal(random)).max(0.0),
            false => at[n - 1],
        };
    }
    at
}

/// What all launches of a shot have in common.
struct LaunchesOfShot {
    /// Factor on all launch velocities.
    factor: f64,
    /// Exponent of the mass law.
    mass_exponent: f64,
    /// Slope that is added to every launch.
    slope: Vector2<f64>,
    /// Offset of the shelter from its place [m].
    offset: Vector2<f64>,
}

/// Draws for one hole.
struct DrawnHole {
    /// Factor on its launch velocity.
    factor: f64,
    /// Slope that is added to its launch.
    slope: Vector2<f64>,
    /// Offset of the hole from its place [m].
    beside: Vector2<f64>,
    /// Shift of its firing time [s].
    later: f64,
}

/// Scatters masses tire by tire, and places, launches and in-hole delays hole by hole. Returns which holes are duds (`n_holes`).
fn scatter_tires(
    scene: &mut Scene,
    firings: &mut [Firing],
    uncertainty: &Uncertainty,
    launches: &LaunchesOfShot,
    random: &mut Random,
) -> Vec<bool> {
    let mut above: Vec<Vec<usize>> = vec![Vec::new(); scene.tire_count()];
    firings.iter().enumerate().for_each(|(n, firing)| above[firing.tire].push(n));
    let in_hole = uncertainty.in_hole_deviation();
    let slope = tangent(uncertainty.launch_tilt_deg);
    let planned_mass = scene.mass.clone();
    let (mut drawn, mut duds) = (Vec::with_capacity(firings.len()), vec![false; firings.len()]);
    for (tire, mass) in scene.mass.iter_mut().enumerate() {
        let of_tire = random.at(Draws::Tire(tire));
        *mass *= factor(of_tire, uncertainty.tire_mass_cv_percent);
        let own = |_: &usize| DrawnHole {
            factor: factor(of_tire, uncertainty.launch_cv_percent),
            slope: on_both_axes(of_tire, slope),
            later: in_hole * normal(of_tire),
            beside: Vector2::zeros(),
        };
        let mut holes: Vec<DrawnHole> = above[tire].iter().map(own).collect();
        let of_holes = random.at(Draws::HolesUnder(tire));
        for (&n, hole) in above[tire].iter().zip(&mut holes) {
            hole.beside = on_both_axes(of_holes, uncertainty.hole_position_m);
            duds[n] = 1e2 * of_holes.random::<f64>() < uncertainty.hole_fails_percent;
        }
        drawn.extend(above[tire].iter().copied().zip(holes));
    }
    let row_factor = |row| factor(random.at(Draws::LaunchOfRow(row)), uncertainty.launch_row_cv_percent);
    let rows = firings.iter().map(|firing| firing.row + 1).max().unwrap_or(0);
    let of_row: Vec<f64> = (0..rows).map(row_factor).collect();
    for (n, hole) in drawn {
        let firing = &mut firings[n];
        let moved = hole.beside - launches.offset;
        let place = scene.position[firing.tire].xy() - firing.line.offset + moved;
        // A hole that is known to lie under its tire keeps the tire, whatever else is near.
        let tire = if moved == Vector2::zeros() { firing.tire } else { nearest_tire(scene, place) };
        let line = PushLine { offset: scene.position[tire].xy() - place, ..firing.line };
        let slope = line.slope_at(line.offset) + launches.slope + hole.slope;
        // The planned launch belongs to the tire that the plan has over the hole.
        let of_mass = launch_factor(scene.mass[tire] / planned_mass[firing.tire], launches.mass_exponent);
        let speed = firing.launch.norm() * launches.factor * of_row[firing.row] * hole.factor * of_mass;
        *firing = Firing {
            tire,
            time: firing.time + hole.later,
            launch: speed * direction_of_slope(slope),
            line,
            ..*firing
        };
    }
    duds
}

/// Index of the tire whose center is nearest to a point [m], the first of several.
pub(in crate::study) fn nearest_tire(scene: &Scene, place: Vector2<f64>) -> usize {
    let away = |tire: &usize| (scene.position[*tire].xy() - place).norm_squared();
    (0..scene.tire_count()).min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Plan;

    /// The draws of each purpose, and of each tire, row or cable, begin where no other draws lie. They follow one another in this
    /// order.
    #[test]
    fn draws_of_different_purposes_are_apart() {
        let mut random = Random::new(1, 0);
        let mut begins = |draws: Draws| random.at(draws).get_word_pos();
        let indices = [0, 1, 2, 3, 100, 10_000];
        let single = [Draws::WholeShot, Draws::Gaps].map(&mut begins).to_vec();
        let of_each = |draws: fn(usize) -> Draws| indices.map(draws);
        let [rows, launches] = [of_each(Draws::BlastRow), of_each(Draws::LaunchOfRow)];
        let [tires, holes] = [of_each(Draws::Tire), of_each(Draws::HolesUnder)];
        let [cables, lengths] = [of_each(Draws::Cable), of_each(Draws::LengthOf)];
        let ordered: Vec<u128> = [rows, launches, tires, holes, cables, lengths]
            .into_iter()
            .flat_map(|draws| draws.map(&mut begins))
            .collect();
        let all = [single, ordered].concat();
        assert!(all.windows(2).all(|pair| pair[0] + 64 <= pair[1]), "{all:?}");
        // Room of a tire: some ten numbers for each of a hundred thousand holes.
        for many in [Draws::BlastRow, Draws::Tire, Draws::HolesUnder] {
            assert_eq!(begins(many(8)) - begins(many(7)), 1 << 20);
        }
    }

    /// An observed shot says nothing about inputs that each shot draws anew.
    #[test]
    fn only_what_stays_as_it_is_repeats() {
        let anew: Vec<Input> = Input::ALL.into_iter().filter(|input| !input.repeats()).collect();
        let [x, y] = [Input::CommonSlopeX, Input::CommonSlopeY];
        assert_eq!(anew, [Input::LaunchBetweenShots, x, y, Input::OffsetX, Input::OffsetY, Input::Duds]);
    }

    /// Two by two tires, which are their own images in several mirror planes, with these keys of `[uncertainty]`. Everything else
    /// is exact.
    fn drawn(unknown: &str) -> (Case, DrawnShot) {
        let zero: String = [
            "delay_sd_ms",
            "launch_cv_percent",
            "launch_common_percent",
            "launch_between_shots_percent",
            "launch_row_cv_percent",
            "launch_tilt_deg",
            "launch_tilt_common_deg",
            "tire_mass_cv_percent",
            "hole_position_m",
            "pattern_offset_m",
            "hole_fails_percent",
            "cable_length_m",
            "breaking_force_cv_percent",
        ]
        .into_iter()
        .filter(|key| !unknown.contains(key))
        .map(|key| format!("{key} = 0\n"))
        .collect();
        let text = format!(
            r#"
shelter = {{ layout = "grid", rows = 2, columns = 2, spacing_m = 1.5 }}
tire = {{ mass_kg = 280 }}
cable = {{ axial_stiffness_kn = 1400, breaking_force_kn = 60 }}
ground = {{ friction = 0.5 }}
blast_row = [{{ name = "1", under_row = 1, launch_m_s = 6 }}, {{ name = "2", under_row = 2, launch_m_s = 6 }}]
limits = {{ flight_height_m = 5, cable_safety_factor = 1 }}
delay = [{{ name = "1", interval_ms = 20 }}]
[uncertainty]
{zero}{unknown}
"#
        );
        let case = Case::new(Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")));
        let drawn = draw_shot(&case, &case.shots[0], 1, 0);
        (case, drawn)
    }

    /// A shelter whose tires or cables differ is no mirror image of itself. Each of these draws alone makes them differ.
    #[test]
    fn what_differs_tire_by_tire_or_cable_by_cable_has_no_mirrors() {
        let (case, same) = drawn("");
        assert!(!case.scene().mirrors.is_empty());
        assert_eq!(same.scene.mirrors.len(), case.scene().mirrors.len());
        for unknown in ["tire_mass_cv_percent = 3", "breaking_force_cv_percent = 3", "cable_length_m = 0.01"]
        {
            assert!(drawn(unknown).1.scene.mirrors.is_empty(), "{unknown}");
        }
        assert_eq!(same.scene.strength, case.scene().strength);
        let strength = drawn("breaking_force_cv_percent = 3").1.scene.strength;
        assert_eq!(strength.len(), case.scene().cables.len());
        assert!(strength.iter().all(|factor| (factor - 1.0).abs() < 0.15 && *factor != 1.0), "{strength:?}");
    }

    /// With a scatter of 5 ms in the holes, some would fire before the start. So all fire later, and the first fires at the start.
    #[test]
    fn no_hole_fires_before_the_start() {
        let (case, later) = drawn("in_hole_delay_ms = 500\ndelay_cv_percent = 1");
        let first = later.shot.firings.iter().map(|firing| firing.time).fold(f64::INFINITY, f64::min);
        assert!(later.later > 0.0 && first == 0.0, "{} {first}", later.later);
        let times = |shot: &Shot| shot.firings.iter().map(|firing| firing.time).sum::<f64>();
        let (planned, later_in_all) = (times(&case.shots[0]), 4.0 * later.later);
        assert!((times(&later.shot) - planned - later_in_all).abs() < 4.0 * 4.0 * 5e-3);
    }

    /// Each gap between firings has its own deviation and shifts all later firings. Holes that fire together stay together. No gap
    /// is negative.
    #[test]
    fn a_gap_shifts_all_that_fires_behind_it() {
        let (case, _) = drawn("delay_cv_percent = 10");
        let uncertainty = &case.plan.uncertainty;
        let random = || ChaCha8Rng::seed_from_u64(1);
        let planned = [0.0, 0.02, 0.02, 0.07];
        let scattered = scatter_chain(&planned, uncertainty, &mut random());
        let mut drawn = random();
        let first = 0.02 + 0.1 * 0.02 * normal(&mut drawn);
        let last = first + (0.07 - 0.02) + 0.1 * (0.07 - 0.02) * normal(&mut drawn);
        assert!(scattered.iter().zip([0.0, first, first, last]).all(|(at, own)| (at - own).abs() < 1e-12));
        assert!(first != 0.02 && scattered[1] == scattered[2]);
        let many: Vec<f64> = (0..1000).map(f64::from).collect();
        let (wide, _) = self::drawn("delay_cv_percent = 90");
        let scattered = scatter_chain(&many, &wide.plan.uncertainty, &mut random());
        assert!(scattered.windows(2).all(|pair| pair[1] >= pair[0]));
        assert!(scattered.windows(2).any(|pair| pair[1] == pair[0]), "a test that can fail");
    }

    /// The rope is a fifth stiffer than planned, between ends that are not. The cable keeps this stiffness when it is tied longer.
    #[test]
    fn a_cable_tied_longer_keeps_the_stiffness_of_its_rope() {
        let stiffness = |unknown: &str| {
            let (case, drawn) = drawn(&format!("axial_stiffness_percent = [20, 20]\n{unknown}"));
            drawn.scene.cables[0].stiffness / case.scene().cables[0].stiffness
        };
        let [same, tied] = ["", "cable_length_m = 1e-9"].map(stiffness);
        assert!((1.19..1.2).contains(&same) && (tied - same).abs() < 1e-6, "{same} {tied}");
    }
}
