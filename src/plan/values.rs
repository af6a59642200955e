//! The values of a plan, in the units of its keys.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::{Diagnostics, PlanSource, Time, Uncertainty, sections};
use crate::choice::{Accuracy, HoleOrder, Link, Method, OnOverload, SearchedOrders};
use crate::ropes::Rope;

/// A blast row, the shelter over it, and the delay options to choose from.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Free text shown above every view.
    pub title: Option<String>,
    /// Tires and the ties between them.
    pub layout: Layout,
    /// The tire at every position of the layout.
    pub tire: TireSpec,
    /// The rope of every tie.
    pub cable: CableSpec,
    /// The ground under the tires.
    pub ground: GroundSpec,
    /// Blast rows in the order listed.
    pub blast_rows: Vec<BlastRow>,
    /// Limits that an option must keep to pass.
    pub limits: LimitsSpec,
    /// Delay options in the order listed; never empty.
    pub delays: Vec<DelayOption>,
    /// Settings of the simulation.
    pub simulation: SimulationSpec,
    /// What is not known of the shot, and how far.
    pub uncertainty: Uncertainty,
    /// SHA-256 of every file of observations that a fit has written into this plan, in hexadecimal digits.
    pub fitted_from: Vec<String>,
    /// Inputs that `[uncertainty]` leaves out, so that small values of the program count; empty where there is no such section.
    pub left_out: Vec<&'static str>,
    /// Choices of `shelter size`.
    pub size: SizeSpec,
    /// Choices of `shelter search`.
    pub search: SearchSpec,
}

/// Choices of `shelter search`.
#[derive(Clone, Debug, PartialEq)]
pub struct SearchSpec {
    /// Intervals between successive rows, ascending; empty: those of the delay options.
    pub intervals: Vec<Time>,
    /// Whether all rows of a schedule follow one another at one interval.
    pub equal_intervals: bool,
    /// Orders of the rows.
    pub orders: SearchedOrders,
    /// Intervals and orders of the holes of a row; never empty.
    pub holes: Vec<HoleTiming>,
    /// Greatest time from the first hole to the last.
    pub longest: Option<Time>,
    /// Most holes that fire within any 8 ms.
    pub most_holes_in_8_ms: Option<usize>,
}

/// Choices of `shelter size`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SizeSpec {
    /// Masses of the tires at hand [kg]; empty: only the mass of `[tire]`.
    pub tire_mass_kg: Vec<f64>,
    /// Family of ropes; `None`: that of the plan's rope, or the whole catalogue where it has none.
    pub family: Option<String>,
    /// Most rows of ballast on each side.
    pub most_border_rows: usize,
}

impl Plan {
    /// Whether the title says that the plan is an example: nothing of it is to be fired.
    pub fn is_example(&self) -> bool {
        self.title.as_deref().is_some_and(|title| title.to_uppercase().contains("EXAMPLE"))
    }

    /// The plan with another rope, tire mass and border. Tires of another mass leave as fast as the worse end of the
    /// [mass law](super::mass_law) says. All other values stay.
    pub fn with_sizes(&self, rope: &Rope, tire_mass_kg: f64, border_rows: usize) -> Plan {
        let mut plan = self.clone();
        plan.cable.rope = Some(rope.name.clone());
        plan.cable.axial_stiffness_kn = rope.axial_stiffness_kn;
        plan.cable.breaking_force_kn = rope.breaking_force_kn * plan.cable.termination_percent * 1e-2;
        plan.tire.mass_kg = tire_mass_kg;
        let factor = self.launch_factor_of_mass(tire_mass_kg);
        plan.launches_mut().for_each(|launch| launch.speed_m_s *= factor);
        if let Layout::Grid(mesh) | Layout::Quincunx(mesh) = &mut plan.layout {
            mesh.border_rows = border_rows;
        }
        plan
    }

    /// Reads and validates a plan file; `-` is standard input.
    pub fn load(path: &Path) -> Result<Self, Diagnostics> {
        PlanSource::read(path)?.plan()
    }

    /// Validates the text of a plan; messages name the file `path`.
    pub fn parse(path: &str, text: &str) -> Result<Self, Diagnostics> {
        sections::parse(path, text)
    }

    /// How the holes of each row fire in every delay option; `None` where options differ.
    pub fn shared_hole_timing(&self) -> Option<HoleTiming> {
        let mut all = self.delays.iter().map(|delay| delay.hole_timing);
        let first = all.next().unwrap_or(HoleTiming::TOGETHER);
        all.all(|holes| holes.is_same(&first)).then_some(first)
    }

    /// How the holes of each row fire in a study that varies order or interval: as in this option, or as in all; `None` where the
    /// options differ, and no option is given.
    pub fn hole_timing_of(&self, option: Option<usize>) -> Option<HoleTiming> {
        option.map(|option| self.delays[option].hole_timing).or_else(|| self.shared_hole_timing())
    }

    /// Intervals of the delay options whose holes fire so; of all without `holes`; ascending, without repetitions.
    pub fn intervals(&self, holes: Option<HoleTiming>) -> Vec<Time> {
        let interval = |delay: &DelayOption| match delay.timing {
            Timing::Interval { interval, .. }
                if holes.is_none_or(|holes| delay.hole_timing.is_same(&holes)) =>
            {
                Some(interval)
            }
            Timing::Interval { .. } | Timing::At(_) => None,
        };
        let mut all: Vec<Time> = self.delays.iter().filter_map(interval).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// Masses of the tires, of a list in its order [kg]; one where all have that of `[tire]`.
    pub fn tire_masses(&self) -> Vec<f64> {
        match &self.layout {
            Layout::List { tires, .. } if self.layout.has_own_masses() => {
                tires.iter().map(|tire| tire.mass_kg.unwrap_or(self.tire.mass_kg)).collect()
            }
            Layout::Grid(_) | Layout::Quincunx(_) | Layout::List { .. } => vec![self.tire.mass_kg],
        }
    }

    /// Launch velocities of all blast rows and holes.
    pub fn launches(&self) -> impl Iterator<Item = &Launch> {
        self.blast_rows.iter().flat_map(BlastRow::launches)
    }

    /// The same, to change them.
    pub fn launches_mut(&mut self) -> impl Iterator<Item = &mut Launch> {
        self.blast_rows.iter_mut().flat_map(|row| -> Vec<&mut Launch> {
            match &mut row.targets {
                LaunchTargets::UnderRow { launch, .. } | LaunchTargets::UnderTires { launch, .. } => {
                    vec![launch]
                }
                LaunchTargets::Holes(holes) => holes.iter_mut().map(|hole| &mut hole.launch).collect(),
            }
        })
    }
}

/// Positions of the tires, and the neighbours that are tied.
#[derive(Clone, Debug, PartialEq)]
pub enum Layout {
    /// `rows` × `columns` tires.
    Grid(Mesh),
    /// `rows` × `columns` corner tires, and one more tire at the centre of every cell.
    Quincunx(Mesh),
    /// Tires and cables one by one.
    List {
        /// Tires in the order listed.
        tires: Vec<ListedTire>,
        /// Pairs of tire indices, from 0.
        cables: Vec<(usize, usize)>,
    },
}

impl Layout {
    /// Whether tires have masses of their own.
    pub fn has_own_masses(&self) -> bool {
        matches!(self, Layout::List { tires, .. } if tires.iter().any(|tire| tire.mass_kg.is_some()))
    }

    /// Greatest distance between the centres of tied tires [m]; of a mesh its greater spacing.
    pub fn widest_tie(&self) -> f64 {
        match self {
            Layout::Grid(mesh) | Layout::Quincunx(mesh) => mesh.column_spacing_m.max(mesh.row_spacing_m),
            Layout::List { tires, cables } => {
                let length = |&(a, b): &(usize, usize)| {
                    Some((tires.get(a)?, tires.get(b)?)).map(|(a, b)| (a.x_m - b.x_m).hypot(a.y_m - b.y_m))
                };
                // Tires without ties say nothing about a distance; no tire is wider.
                cables.iter().filter_map(length).reduce(f64::max).unwrap_or(5.0)
            }
        }
    }
}

/// A regular layout.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// Tires along y.
    pub rows: usize,
    /// Tires along x.
    pub columns: usize,
    /// Distance between rows [m].
    pub row_spacing_m: f64,
    /// Distance between columns [m].
    pub column_spacing_m: f64,
    /// Neighbours that are tied.
    pub links: Vec<Link>,
    /// Rows of ballast around the mesh, on each side. No blast row lies under them; tire (1,1) stays at the origin.
    pub border_rows: usize,
}

impl Mesh {
    /// Distance of a point from the area of the mesh and its border [m].
    pub fn distance_outside(&self, x: f64, y: f64) -> f64 {
        let border = self.border_rows as f64;
        let beyond = |at: f64, count: usize, spacing: f64| {
            (-border * spacing - at).max(at - (count as f64 - 1.0 + border) * spacing).max(0.0)
        };
        let (across, along) = (self.column_spacing_m, self.row_spacing_m);
        beyond(x, self.columns, across).hypot(beyond(y, self.rows, along))
    }

    /// Number of tires of a grid, or at the corners of a quincunx, with the border.
    pub fn corners(&self) -> usize {
        let with_border = |n: usize| n.saturating_add(2 * self.border_rows);
        with_border(self.rows).saturating_mul(with_border(self.columns))
    }
}

/// One tire of a `list` layout.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ListedTire {
    /// Along the rows [m].
    pub x_m: f64,
    /// Across the rows [m].
    pub y_m: f64,
    /// Mass [kg]; `None`: that of `[tire]`.
    pub mass_kg: Option<f64>,
}

/// A tire.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TireSpec {
    /// Mass [kg].
    pub mass_kg: f64,
    /// Outer diameter [m]: cables run from rim to rim. 0: cables run from centre to centre.
    pub outer_diameter_m: f64,
    /// Normal speed after a landing over normal speed before it.
    pub restitution: f64,
}

/// The ground under the tires; x and y of a plan lie in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroundSpec {
    /// Coefficient of friction between tire and ground.
    pub friction: f64,
    /// Slope [%]: the tangent of its angle to the level.
    pub slope_percent: f64,
    /// Direction downhill: azimuth from +x toward +y [°].
    pub slope_toward_deg: f64,
}

/// The cable between two tires, with the figures of the catalogue.
#[derive(Clone, Debug, PartialEq)]
pub struct CableSpec {
    /// Name in the rope catalogue; `None` where the plan gives stiffness and breaking force.
    pub rope: Option<String>,
    /// Axial stiffness EA [kN].
    pub axial_stiffness_kn: f64,
    /// Breaking force used [kN]: that of the rope × the efficiency of the termination.
    pub breaking_force_kn: f64,
    /// Slack [%]: unstretched length over distance at rest, less one.
    pub slack_percent: f64,
    /// Name of the termination in the rope catalogue; `None` where the plan gives its efficiency, or has none.
    pub termination: Option<String>,
    /// Efficiency of the termination [%]; 100 where the plan has none.
    pub termination_percent: f64,
    /// Stiffness of tie and tire at each end of a cable [kN/m]; `None`: stiff ends.
    pub end_stiffness_kn_m: Option<f64>,
    /// Damping of a cable with its two tires over critical damping [%].
    pub damping_percent: f64,
    /// Effect of a force past the breaking force.
    pub on_overload: OnOverload,
}

impl CableSpec {
    /// Stiffness of tie and tire at each end of a cable [N/m]; `None`: stiff ends.
    pub fn end_stiffness(&self) -> Option<f64> {
        self.end_stiffness_kn_m.map(|stiffness| stiffness * 1e3)
    }
}

/// Holes that a delay option fires as one group: together, or one after another.
#[derive(Clone, Debug, PartialEq)]
pub struct BlastRow {
    /// Name; delay options address the row by it.
    pub name: String,
    /// Tires launched by the row.
    pub targets: LaunchTargets,
}

impl BlastRow {
    /// Its launch velocities: one, or one of each hole.
    pub fn launches(&self) -> Vec<&Launch> {
        match &self.targets {
            LaunchTargets::UnderRow { launch, .. } | LaunchTargets::UnderTires { launch, .. } => vec![launch],
            LaunchTargets::Holes(holes) => holes.iter().map(|hole| &hole.launch).collect(),
        }
    }
}

/// Tires launched by a blast row, and how fast.
#[derive(Clone, Debug, PartialEq)]
pub enum LaunchTargets {
    /// Every tire of one shelter row; half numbers address the centres of a quincunx.
    UnderRow {
        /// Number of the shelter row, from 1, in steps of one half.
        row: f64,
        /// Launch velocity.
        launch: Launch,
    },
    /// Tires of a list layout.
    UnderTires {
        /// Tire indices, from 0.
        tires: Vec<usize>,
        /// Launch velocity.
        launch: Launch,
    },
    /// Holes, each launching the nearest tire.
    Holes(Vec<Hole>),
}

/// One hole; tire (1,1) of a mesh is at the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hole {
    /// Along the rows [m].
    pub x_m: f64,
    /// Across the rows [m].
    pub y_m: f64,
    /// Launch velocity.
    pub launch: Launch,
}

/// What a hole does to its tire.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Launch {
    /// Speed [m/s].
    pub speed_m_s: f64,
    /// Angle to the ground's normal [°].
    pub tilt_deg: f64,
    /// Direction of the tilt along the ground: azimuth from +x toward +y [°].
    pub tilt_toward_deg: f64,
    /// Time over which the hole pushes [ms]; 0: at once.
    pub push_ms: f64,
    /// Explosive in the hole [kg]; all holes of a plan have a charge, or none has.
    pub charge_kg: Option<f64>,
    /// Stemming above the charge [m].
    pub stemming_m: Option<f64>,
    /// Diameter of the hole [mm].
    pub hole_diameter_mm: Option<f64>,
    /// Depth below the hole's mouth from which the push comes [m].
    pub push_depth_m: Option<f64>,
}

/// Limits of a passing option.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimitsSpec {
    /// Greatest flight height of any tire [m].
    pub flight_height_m: f64,
    /// Smallest ratio of breaking force to greatest force.
    pub cable_safety_factor: f64,
    /// Greatest horizontal shift of any tire at the end [m].
    pub drift_m: Option<f64>,
    /// Most holes that fire within any 8 ms.
    pub holes_in_8_ms: Option<usize>,
    /// Heaviest charge within any 8 ms [kg].
    pub charge_in_8_ms_kg: Option<f64>,
    /// Share of the shots that `[uncertainty]` describes that may go past a limit [%].
    pub accepted_risk_percent: f64,
    /// Whether an option passes only if it also holds with any one hole that does not fire.
    pub withstands_one_dud: bool,
    /// Share of the shots with one dud that may go past a limit [%].
    pub dud_risk_percent: f64,
}

/// One delay option.
#[derive(Clone, Debug, PartialEq)]
pub struct DelayOption {
    /// Name in every view; unique.
    pub name: String,
    /// Firing times of the rows: of the first hole of each.
    pub timing: Timing,
    /// Firing times of the holes of each row.
    pub hole_timing: HoleTiming,
}

impl DelayOption {
    /// Whether two options fire every hole at the same time.
    pub fn fires_like(&self, other: &Self) -> bool {
        self.timing.fire_at() == other.timing.fire_at() && self.hole_timing.is_same(&other.hole_timing)
    }
}

/// How the holes of each row fire, from the firing time of the row on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct HoleTiming {
    /// Time between successive holes; 0: together.
    pub interval: Time,
    /// Where the holes begin.
    pub order: HoleOrder,
    /// Whether one hole fires the next, so that a dud takes others along.
    pub fired_through: bool,
}

impl HoleTiming {
    /// The holes of a row fire together.
    pub const TOGETHER: Self = Self { interval: Time::ZERO, order: HoleOrder::DEFAULT, fired_through: false };

    /// Whether the holes of a row fire at one time.
    pub fn is_together(&self) -> bool {
        self.interval == Time::ZERO
    }

    /// Whether the holes of every row fire alike: without an interval the order says nothing.
    pub fn is_same(&self, other: &Self) -> bool {
        let is_alike = self.is_together() && other.is_together() && self.fired_through == other.fired_through;
        self == other || is_alike
    }

    /// In words, such as `holes 17 ms left`; `None` where they fire together.
    pub fn words(&self) -> Option<String> {
        let Self { interval, order, .. } = self;
        (!self.is_together()).then(|| format!("holes {interval} ms {order}"))
    }
}

/// Firing times of the blast rows.
#[derive(Clone, Debug, PartialEq)]
pub enum Timing {
    /// The rows fire one after another.
    Interval {
        /// Indices of the blast rows in firing order.
        order: Vec<usize>,
        /// Time between successive rows.
        interval: Time,
    },
    /// Firing time of each blast row, in the order of the plan (`n_blast_rows`).
    At(Vec<Time>),
}

impl Timing {
    /// Firing time of each blast row (`n_blast_rows`).
    pub fn fire_at(&self) -> Vec<Time> {
        match self {
            Timing::At(times) => times.clone(),
            Timing::Interval { order, interval } => fire_in_turn(order, *interval),
        }
    }

    /// The time between successive rows where they fire in this `order`, at one interval; `None` where they do not, or there is one row, or
    /// the order is one of other rows.
    pub fn interval_in(&self, order: &[usize]) -> Option<Time> {
        let at = self.fire_at();
        let &[first, second, ..] = order else { return None };
        if order.len() != at.len() || order.iter().any(|&row| row >= at.len()) {
            return None;
        }
        let interval = at[second] - at[first];
        (fire_in_turn(order, interval) == at).then_some(interval).filter(|interval| *interval >= Time::ZERO)
    }
}

/// Firing time of each blast row where the rows fire in `order`, `interval` apart (`n_blast_rows`).
pub fn fire_in_turn(order: &[usize], interval: Time) -> Vec<Time> {
    let mut at = vec![Time::ZERO; order.len()];
    for (turn, &row) in order.iter().enumerate() {
        at[row] = interval * turn as i64;
    }
    at
}

/// Settings of the simulation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SimulationSpec {
    /// End of the run [s]; `None`: until every tire is at rest.
    pub duration_s: Option<f64>,
    /// Accuracy level.
    pub accuracy: Accuracy,
    /// Time integration method.
    pub method: Method,
    /// Gravity [m/s²].
    pub gravity_m_s2: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Without an interval the order of holes says nothing, but a dud that takes others along does.
    #[test]
    fn hole_timings_that_fire_alike_are_the_same() {
        let left = HoleTiming { order: HoleOrder::Left, ..HoleTiming::TOGETHER };
        let right = HoleTiming { order: HoleOrder::Right, ..HoleTiming::TOGETHER };
        assert!(left.is_same(&right));
        let interval = Time::from_ms(17.0);
        assert!(!HoleTiming { interval, ..left }.is_same(&HoleTiming { interval, ..right }));
        assert!(!left.is_same(&HoleTiming { fired_through: true, ..left }));
    }

    /// An order of other rows, as of a plan that has changed since, fires nothing at one interval.
    #[test]
    fn rows_fire_at_one_interval_in_their_own_order_alone() {
        let at = |times: &[f64]| Timing::At(times.iter().copied().map(Time::from_ms).collect());
        let in_order = |times: &[f64], order: &[usize]| at(times).interval_in(order).map(Time::ms);
        assert_eq!(in_order(&[84.0, 0.0, 42.0], &[1, 2, 0]), Some(42.0));
        for (times, order) in [
            (&[84.0, 0.0, 42.0][..], &[0, 1, 2][..]),
            (&[0.0, 42.0, 85.0], &[0, 1, 2]),
            (&[0.0, 42.0], &[2, 0, 1]),
            (&[0.0, 42.0], &[0, 2]),
            (&[0.0, 42.0, 84.0], &[0, 1]),
            (&[0.0], &[0]),
        ] {
            assert_eq!(in_order(times, order), None, "{times:?} {order:?}");
        }
    }
}
