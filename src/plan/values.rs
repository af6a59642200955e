//! The values of a plan, in the units of its keys.

use std::path::Path;

use itertools::Itertools;
use serde::{Deserialize, Serialize};

use super::{DelayOption, Diagnostics, HoleTiming, Layout, PlanSource, Time, Timing, Uncertainty, sections};
use crate::choice::{Accuracy, Method, OnOverload, SearchedOrders};
use crate::ropes::Rope;
use crate::sorting::sort;

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
    /// Unknowns of the shot, and how far each may vary.
    pub uncertainty: Uncertainty,
    /// Entries that fits write: SHA-256 of every file of observations in hexadecimal digits, marks of its observations, days of the shots,
    /// charge, stemming and tires.
    pub fitted_from: Vec<String>,
    /// Inputs that `[uncertainty]` leaves out, so that the program's small defaults count; empty if the plan has no such section.
    pub left_out: Vec<&'static str>,
    /// Choices of `shelter size`.
    pub size: SizeSpec,
    /// Choices of `shelter search`.
    pub search: SearchSpec,
}

/// Choices of `shelter search`.
#[derive(Clone, Debug, PartialEq)]
pub struct SearchSpec {
    /// Intervals between successive rows, ascending. Empty: the intervals of the delay options.
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
    /// Family of ropes. `None`: the family of the plan's rope, or the whole catalogue if the plan names no rope.
    pub family: Option<String>,
    /// Largest number of ballast rows on each side.
    pub most_border_rows: usize,
}

impl Plan {
    /// The plan with another rope, tire mass [kg] and number of border rows. Launch velocities follow the tire mass at the worse end of the
    /// [mass law](super::mass_law). All other values stay.
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

    /// Timing of the holes of each row, if all delay options have the same; `None` if options differ.
    pub fn shared_hole_timing(&self) -> Option<HoleTiming> {
        let mut all = self.delays.iter().map(|delay| delay.hole_timing);
        let first = all.next().unwrap_or(HoleTiming::TOGETHER);
        all.all(|holes| holes.is_same(&first)).then_some(first)
    }

    /// Timing of the holes of each row in a study that varies order or interval: the timing in `option`, or without an option the timing
    /// that all options share. `None` if no option is given and the options differ.
    pub fn hole_timing_of(&self, option: Option<usize>) -> Option<HoleTiming> {
        option.map(|option| self.delays[option].hole_timing).or_else(|| self.shared_hole_timing())
    }

    /// Intervals of the delay options with this hole timing, or of all options without `holes`; ascending, without repetitions.
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
        sort(&mut all);
        all.dedup();
        all
    }

    /// Masses of the tires [kg], in the order of the list; a single mass if all tires have the mass of `[tire]`.
    pub fn tire_masses(&self) -> Vec<f64> {
        match &self.layout {
            Layout::List { tires, .. } if self.layout.has_own_masses() => {
                tires.iter().map(|tire| tire.mass_kg.unwrap_or(self.tire.mass_kg)).collect()
            }
            Layout::Grid(_) | Layout::Quincunx(_) | Layout::List { .. } => vec![self.tire.mass_kg],
        }
    }

    /// The mass of all tires [kg]; `None` if masses differ.
    pub fn mass_of_all_tires(&self) -> Option<f64> {
        let masses = self.tire_masses();
        masses.iter().all_equal_value().ok().copied()
    }

    /// Launch velocities of all blast rows and holes.
    pub fn launches(&self) -> impl Iterator<Item = &Launch> {
        self.blast_rows.iter().flat_map(BlastRow::launches)
    }

    /// Launch velocities of all blast rows and holes, to change them.
    pub fn launches_mut(&mut self) -> impl Iterator<Item = &mut Launch> {
        self.blast_rows.iter_mut().flat_map(|row| row.targets.launches_mut())
    }
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
    /// Whether rims turn toward their cables, so that each cable lies in line with the centres of its tires. No key of a plan sets it: it
    /// probes an effect that the model leaves out.
    pub turns: bool,
}

impl TireSpec {
    /// Length of the tires in line with each cable [m], besides the cable's own length; 0 if tires do not turn.
    pub fn turned_m(&self) -> f64 {
        if self.turns { self.outer_diameter_m } else { 0.0 }
    }
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
    /// Breaking force used [kN]: breaking force of the rope × efficiency of the termination.
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
    /// Effect of a force that exceeds the breaking force.
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
    /// Launch velocities of the row: one for all its tires, or one per hole.
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

impl LaunchTargets {
    /// The launch velocities, to change them.
    pub fn launches_mut(&mut self) -> Vec<&mut Launch> {
        match self {
            LaunchTargets::UnderRow { launch, .. } | LaunchTargets::UnderTires { launch, .. } => vec![launch],
            LaunchTargets::Holes(holes) => holes.iter_mut().map(|hole| &mut hole.launch).collect(),
        }
    }
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

/// Launch of a tire by a hole.
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
    /// Smallest ratio of breaking force to peak force.
    pub cable_safety_factor: f64,
    /// Greatest horizontal shift of any tire at the end [m].
    pub drift_m: Option<f64>,
    /// Most holes that fire within any 8 ms.
    pub holes_in_8_ms: Option<usize>,
    /// Heaviest charge within any 8 ms [kg].
    pub charge_in_8_ms_kg: Option<f64>,
    /// Share of the shots described by `[uncertainty]` that may exceed a limit [%].
    pub accepted_risk_percent: f64,
    /// Whether an option passes only if it also passes with any one dud.
    pub withstands_one_dud: bool,
    /// Share of the shots with one dud that may exceed a limit [%].
    pub dud_risk_percent: f64,
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
