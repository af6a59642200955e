//! The command line: `--name value` pairs, the same names as the Python peers take.

use std::str::FromStr;

pub struct Options {
    pub layout: String,
    pub rows: usize,
    pub columns: usize,
    pub spacing: f64,
    pub blast_rows: Vec<f64>,
    pub delay: f64,
    pub axial_stiffness: f64,
    pub duration: f64,
    pub step: f64,
    pub repeats: usize,
    pub precision: String,
    pub reference_height: f64,
    pub reference_force: f64,
    pub tuning: Tuning,
}

/// What the search for Rapier's best settings turned.
pub struct Tuning {
    /// Substeps of a step; the cable forces are held constant over them.
    pub solver_iterations: usize,
    /// Passes that solve contacts again without position correction.
    pub stabilization_iterations: usize,
    /// Give launches half a step of gravity back, as velocities live at half steps.
    pub half_step_launch: bool,
    /// Hand tension over as velocity jumps (true) or as forces (false).
    pub impulses: bool,
    pub contact_frequency: f64,
    pub contact_damping: f64,
    pub coulomb_cone: bool,
    /// Ground as a large box (true) or as a half-space (false).
    pub cuboid_ground: bool,
    /// Recycle contacts of pairs that hardly moved.
    pub contact_recycling: bool,
    /// Let tires at rest sleep, from the start on.
    pub sleep: bool,
}

impl Options {
    pub fn from_arguments() -> Result<Self, String> {
        let arguments: Vec<String> = std::env::args().skip(1).collect();
        let mut options = Self::default();
        for pair in arguments.chunks(2) {
            let [name, value] = pair else {
                return Err(format!("'{}' needs a value", pair[0]));
            };
            options.set(name, value)?;
        }
        Ok(options)
    }

    pub fn steps(&self) -> usize {
        (self.duration / self.step).round() as usize
    }

    fn set(&mut self, name: &str, value: &str) -> Result<(), String> {
        let tuning = &mut self.tuning;
        match name {
            "--layout" => self.layout = value.into(),
            "--rows" => self.rows = number(value)?,
            "--columns" => self.columns = number(value)?,
            "--spacing" => self.spacing = number(value)?,
            "--blast-rows" => self.blast_rows = rows(value)?,
            "--delay" => self.delay = number(value)?,
            "--axial-stiffness" => self.axial_stiffness = number(value)?,
            "--duration" => self.duration = number(value)?,
            "--step" => self.step = number(value)?,
            "--repeats" => self.repeats = number(value)?,
            "--precision" => self.precision = value.into(),
            "--reference-height" => self.reference_height = number(value)?,
            "--reference-force" => self.reference_force = number(value)?,
            "--solver-iterations" => tuning.solver_iterations = number(value)?,
            "--stabilization-iterations" => tuning.stabilization_iterations = number(value)?,
            "--half-step-launch" => tuning.half_step_launch = number(value)?,
            "--impulses" => tuning.impulses = number(value)?,
            "--contact-frequency" => tuning.contact_frequency = number(value)?,
            "--contact-damping" => tuning.contact_damping = number(value)?,
            "--coulomb-cone" => tuning.coulomb_cone = number(value)?,
            "--cuboid-ground" => tuning.cuboid_ground = number(value)?,
            "--contact-recycling" => tuning.contact_recycling = number(value)?,
            "--sleep" => tuning.sleep = number(value)?,
            _ => return Err(format!("unknown option '{name}'")),
        }
        Ok(())
    }
}

impl Default for Options {
    fn default() -> Self {
        Self {
            layout: "grid".into(),
            rows: 20,
            columns: 20,
            spacing: 1.5,
            blast_rows: (6..=15).map(f64::from).collect(),
            delay: 0.02,
            axial_stiffness: 1.4e6,
            duration: 1.0,
            step: 1e-3,
            repeats: 5,
            precision: "f32".into(),
            reference_height: 1.82570,
            reference_force: 26750.4,
            tuning: Tuning {
                solver_iterations: 1,
                stabilization_iterations: 0,
                half_step_launch: false,
                impulses: true,
                contact_frequency: 60.0,
                contact_damping: 10.0,
                coulomb_cone: false,
                cuboid_ground: true,
                contact_recycling: true,
                sleep: false,
            },
        }
    }
}

fn number<T: FromStr>(text: &str) -> Result<T, String> {
    text.parse().map_err(|_| format!("'{text}' is not a value of this option"))
}

/// `6-15`, `2,3,4` or `1.5`.
fn rows(text: &str) -> Result<Vec<f64>, String> {
    match text.split_once('-') {
        Some((first, last)) => Ok((number(first)?..=number::<u32>(last)?).map(f64::from).collect()),
        None => text.split(',').map(number).collect(),
    }
}
