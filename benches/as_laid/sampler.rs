//! Possible shots of a plan, drawn a second time from what the keys of `[uncertainty]` mean.
//!
//! Of the library it takes what a plan says: places, masses and ties of the shelter, holes and firing times as planned, and the values
//! of the keys. Every draw and everything that follows from it is here.

use nalgebra::{Vector2, Vector3};
use rayon::prelude::*;
use shelter::Case;
use shelter::plan::Plan;

use super::motion::{Bounds, Launch, Reached, Shelter, Tie, run};
use super::random::Random;
use super::shares::Share;

/// Step of the motion [s], where nothing else is said.
pub const STEP: f64 = 2e-4;
/// Depth of the push where the plan gives none [m].
const ASSUMED_DEPTH: f64 = 0.8;

/// A delay option of a plan, from which shots are drawn.
pub struct Planned<'c> {
    plan: &'c Plan,
    /// Places of the tires [m] and their masses [kg].
    places: Vec<Vector3<f64>>,
    masses: Vec<f64>,
    gravity: Vector3<f64>,
    /// The two tires of each tie.
    ties: Vec<[usize; 2]>,
    /// Holes in order of their planned times.
    holes: Vec<Hole>,
    /// Limits of the plan.
    pub bounds: Bounds,
    /// Standard deviation of the places of tires on each axis, ropes cut for the places as planned [m]. No key of a plan says it.
    pub tires_off: f64,
    /// Step of the motion [s].
    pub step: f64,
}

/// A hole as planned.
struct Hole {
    time: f64,
    row: usize,
    place: Vector2<f64>,
    tire: usize,
    speed: f64,
    /// Slope of the push that the plan states by a tilt.
    tilt: Vector2<f64>,
    depth: Option<f64>,
}

impl<'c> Planned<'c> {
    /// The option of a plan without hole `dud`, where one is given.
    pub fn new(case: &'c Case, option: usize, dud: Option<usize>) -> Self {
        let (scene, plan) = (case.scene(), &case.plan);
        assert!(scene.damping == 0.0 && scene.restitution == 0.0 && scene.breaking_force.is_none());
        let hole = |firing: &shelter::scene::Firing| {
            assert_eq!(firing.push_time, 0.0, "a push takes no time here");
            Hole {
                time: firing.time,
                row: firing.row,
                place: scene.position[firing.tire].xy() - firing.line.offset,
                tire: firing.tire,
                speed: firing.launch.norm(),
                tilt: firing.line.tilt,
                depth: firing.line.depth,
            }
        };
        let firings = case.shots[option].firings.iter().enumerate().filter(|&(n, _)| Some(n) != dud);
        let breaking_force = plan.cable.breaking_force_kn * 1e3;
        Self {
            plan,
            places: scene.position.clone(),
            masses: scene.mass.clone(),
            gravity: scene.gravity(),
            ties: scene.cables.iter().map(|cable| cable.ends).collect(),
            holes: firings.map(|(_, firing)| hole(firing)).collect(),
            bounds: Bounds {
                height: plan.limits.flight_height_m,
                force: breaking_force / plan.limits.cable_safety_factor,
                drift: plan.limits.drift_m.unwrap_or(f64::INFINITY),
            },
            tires_off: 0.0,
            step: STEP,
        }
    }

    /// What the shot as planned reaches.
    pub fn reach_as_planned(&self) -> Reached {
        let cable = &self.plan.cable;
        let ties = self.tie(&self.places, cable.slack_percent, 1.0, |_| (0.0, 1.0));
        let launch = |hole: &Hole| {
            let aside =
                hole.depth.map_or(Vector2::zeros(), |depth| self.offset(hole.tire, hole.place) / depth);
            Launch { time: hole.time, tire: hole.tire, velocity: hole.speed * direction(hole.tilt + aside) }
        };
        let launches: Vec<Launch> = self.holes.iter().map(launch).collect();
        run(
            &self.shelter(self.masses.clone(), self.plan.ground.friction, ties),
            &launches,
            self.step,
            &Bounds::NONE,
        )
    }

    /// The shots among these numbers that fail.
    pub fn share(&self, seed: u64, samples: usize) -> Share {
        let fails = |&number: &usize| self.reach(seed, number, &self.bounds).fails(&self.bounds);
        Share { failures: (0..samples).into_par_iter().filter(fails).count(), samples }
    }

    /// What a possible shot reaches; it ends early where it is beyond `bounds`.
    pub fn reach(&self, seed: u64, number: usize, bounds: &Bounds) -> Reached {
        let (shelter, launches) = self.draw(&mut Random::new(seed, number));
        run(&shelter, &launches, self.step, bounds)
    }

    fn shelter(&self, masses: Vec<f64>, friction: f64, ties: Vec<Tie>) -> Shelter {
        Shelter { masses, friction, gravity: self.gravity, ties }
    }

    /// From a place to the centre of a tire [m].
    fn offset(&self, tire: usize, place: Vector2<f64>) -> Vector2<f64> {
        self.places[tire].xy() - place
    }

    /// Ties between tires at `places` [m], with ropes for the planned places; `own` gives what each is longer by [m], and its strength.
    fn tie(
        &self,
        places: &[Vector3<f64>],
        slack_percent: f64,
        stiffness: f64,
        mut own: impl FnMut(usize) -> (f64, f64),
    ) -> Vec<Tie> {
        let cable = &self.plan.cable;
        let between_rims = |places: &[Vector3<f64>], [a, b]: [usize; 2]| {
            let line = places[b] - places[a];
            line - line.normalize() * self.plan.tire.outer_diameter_m
        };
        let tie = |(n, &ends): (usize, &[usize; 2])| {
            let (longer, strength) = own(n);
            let cut = between_rims(&self.places, ends).norm() * (1.0 + slack_percent / 100.0);
            let span = between_rims(places, ends);
            let length = (cut + longer).max(span.norm());
            let rope = length / (cable.axial_stiffness_kn * 1e3 * stiffness);
            let ends_yield = cable.end_stiffness_kn_m.map_or(0.0, |end| 2.0 / (end * 1e3));
            Tie { ends, span, length, stiffness: 1.0 / (rope + ends_yield), strength }
        };
        self.ties.iter().enumerate().map(tie).collect()
    }

    /// A possible shot: its shelter, and its launches in order of time.
    fn draw(&self, random: &mut Random) -> (Shelter, Vec<Launch>) {
        let unknown = &self.plan.uncertainty;
        let masses: Vec<f64> =
            self.masses.iter().map(|mass| mass * random.factor(unknown.tire_mass_cv_percent)).collect();
        let launches = self.draw_launches(&masses, random);
        let mut places = self.places.clone();
        for place in &mut places {
            *place += Vector3::new(random.normal(self.tires_off), random.normal(self.tires_off), 0.0);
        }
        let slack_percent = random.between(unknown.slack_percent);
        let stiffness = 1.0 + random.between(unknown.axial_stiffness_percent) / 100.0;
        let friction = random.between(unknown.friction);
        let own =
            |_| (random.normal(unknown.cable_length_m), random.factor(unknown.breaking_force_cv_percent));
        let ties = self.tie(&places, slack_percent, stiffness, own);
        (self.shelter(masses, friction, ties), launches)
    }

    /// Launches of a possible shot under tires of these masses [kg].
    fn draw_launches(&self, masses: &[f64], random: &mut Random) -> Vec<Launch> {
        let unknown = &self.plan.uncertainty;
        let common = random.factor(unknown.launch_common_percent)
            * random.factor(unknown.launch_between_shots_percent);
        let exponent = random.between(unknown.launch_mass_exponent);
        let slope = Self::slope(unknown.launch_tilt_common_deg, random);
        let aside = Self::aside(unknown.pattern_offset_m, random);
        let rows = self.holes.iter().map(|hole| hole.row + 1).max().unwrap_or(0);
        let of_row: Vec<f64> = (0..rows).map(|_| random.factor(unknown.launch_row_cv_percent)).collect();
        let times = self.draw_times(rows, random);
        let mut launches = Vec::new();
        for (hole, time) in self.holes.iter().zip(times) {
            let place = hole.place + aside + Self::aside(unknown.hole_position_m, random);
            let own_slope = Self::slope(unknown.launch_tilt_deg, random);
            let factor = random.factor(unknown.launch_cv_percent) * common * of_row[hole.row];
            let fires = random.between([0.0, 100.0]) >= unknown.hole_fails_percent;
            let tire = if place == hole.place { hole.tire } else { self.nearest(place) };
            let line = self.offset(tire, place) / hole.depth.unwrap_or(ASSUMED_DEPTH);
            // The launch as planned belongs to the tire over the hole as planned, of its mass as planned.
            let of_mass = (self.masses[hole.tire] / masses[tire]).powf(exponent);
            let velocity = hole.speed * factor * of_mass * direction(hole.tilt + slope + own_slope + line);
            if fires {
                launches.push(Launch { time, tire, velocity });
            }
        }
        launches.sort_by(|a, b| a.time.total_cmp(&b.time));
        launches
    }

    /// A normal slope on each axis; its standard deviation is the tangent of an angle [°].
    fn slope(deviation_deg: f64, random: &mut Random) -> Vector2<f64> {
        Self::aside(deviation_deg.to_radians().tan(), random)
    }

    /// A normal deviation on each axis.
    fn aside(deviation: f64, random: &mut Random) -> Vector2<f64> {
        Vector2::new(random.normal(deviation), random.normal(deviation))
    }

    fn nearest(&self, place: Vector2<f64>) -> usize {
        let away = |tire: &usize| self.offset(*tire, place).norm();
        (0..self.places.len()).min_by(|a, b| away(a).total_cmp(&away(b))).expect("a tire")
    }

    /// Firing times [s] (`n_holes`): every gap between rows shifts the later rows, every gap between the holes of a row the later holes
    /// of the row, and the detonator in each hole that hole.
    fn draw_times(&self, rows: usize, random: &mut Random) -> Vec<f64> {
        let delay = &self.plan.uncertainty.delay;
        let deviation = |delay_s: f64| (delay.sd_ms / 1e3).max(delay.cv_percent / 100.0 * delay_s);
        let mut late = |gap: f64| match gap > 0.0 {
            true => (gap + random.normal(deviation(gap))).max(0.0) - gap,
            false => 0.0,
        };
        let starts: Vec<Option<f64>> = (0..rows)
            .map(|row| self.holes.iter().find(|hole| hole.row == row).map(|hole| hole.time))
            .collect();
        let mut in_order: Vec<(f64, usize)> =
            starts.iter().enumerate().filter_map(|(row, start)| Some(((*start)?, row))).collect();
        in_order.sort_by(|a, b| a.0.total_cmp(&b.0));
        // How late each row is so far, and the planned time of its last hole.
        let mut chains = vec![(0.0, 0.0); rows];
        let (mut shift, mut last) = (0.0, in_order.first().map_or(0.0, |first| first.0));
        for (start, row) in in_order {
            shift += late(start - last);
            last = start;
            chains[row] = (shift, start);
        }
        let chained = |hole: &Hole| {
            let (shift, last) = &mut chains[hole.row];
            *shift += late(hole.time - *last);
            *last = hole.time;
            hole.time + *shift
        };
        let mut times: Vec<f64> = self.holes.iter().map(chained).collect();
        let in_hole = self.plan.uncertainty.in_hole_delay_ms / 1e3;
        if in_hole > 0.0 {
            times.iter_mut().for_each(|time| *time += random.normal(deviation(in_hole)));
        }
        times
    }
}

/// The unit vector of a slope.
fn direction(slope: Vector2<f64>) -> Vector3<f64> {
    slope.push(1.0).normalize()
}
