//! Changes of the plan by single keys: step a value up or down, copy an option, remove the selected option or value.

use super::arrow_keys::{add_to_number, common_delay, neighbouring_name, step_second_digit};
use super::entry::Entry;
use super::{EditOutcome, Editor};
use crate::plan::edit::fields::{EditField, Path};
use crate::plan::edit::{self, fields};
use crate::plan::keys::{Kind, delay, plan, tire};
use crate::plan::{BlastRow, Layout, Plan};
use crate::tui::typed_line::TypedLine;

impl Editor {
    /// Text and plan with another value. If the value is the mass of the tires, the launches follow it. They are calculated from the
    /// launches and the mass of the file, so a mass that is changed back restores them. A typed launch belongs to the mass under which it
    /// was typed: it never becomes slower than the mass law gives from there.
    pub(super) fn with_value(&self, path: &Path, new: &str) -> Result<(String, Plan), String> {
        let text = fields::set(&self.text, path, new)?;
        let before = Plan::parse("", &self.text).ok().zip(self.plan_of_file()).filter(|_| is_tire_mass(path));
        let Some((before, file)) = before else { return Self::checked(text) };
        // A fitted plan names the mass of its tires. So the new mass is checked in a text whose named mass is changed, too.
        let scaled = |mass: f64, factor: &dyn Fn(usize, f64) -> f64| {
            let gravity = before.simulation.gravity_m_s2;
            let followed = edit::with_launches_of_mass(&text, factor, mass, gravity);
            followed.map_err(|error| error.to_string()).and_then(Self::checked)
        };
        let typed = new.trim().replace('_', "").parse::<f64>();
        let Ok(mass) = typed else { return Self::checked(text) };
        let (_, plan) = scaled(mass, &|_, _| 1.0)?;
        let law = Plan { uncertainty: plan.uncertainty, ..file };
        let [of_new, of_old] = [&plan, &before].map(|plan| law.launch_factor_of_mass(plan.tire.mass_kg));
        let from_old = before.launch_factor_of_mass(mass);
        scaled(mass, &|row, speed| {
            let by_law = of_new / of_old;
            if is_of_file(&law, of_old, row, speed) { by_law } else { by_law.max(from_old) }
        })
    }

    /// Moves the selected value one step up or down: to the next name of a list, the next whole number, or a number about a tenth away.
    pub fn step(&mut self, up: bool) -> EditOutcome {
        let Some(field) = self.field() else { return EditOutcome::None };
        if field.path.section == plan::LIMITS.name {
            // A stray arrow key must not change a limit.
            self.problem = Some("a limit changes only by typing it: Enter".to_owned());
            return EditOutcome::None;
        }
        let value = field.value.trim_matches('"');
        let next = match &field.path.key.kind {
            _ if is_interval(&field.path) => add_to_number(value, if up { 1.0 } else { -1.0 }),
            Kind::Whole(_) => add_to_number(value, if up { 1.0 } else { -1.0 }),
            Kind::ShelterRow(_) => {
                let plan = Plan::parse("", &self.text);
                let centres = plan.is_ok_and(|plan| matches!(plan.layout, Layout::Quincunx(_)));
                let step = if centres { 0.5 } else { 1.0 };
                add_to_number(value, if up { step } else { -step })
            }
            Kind::Number { .. } | Kind::NumberOrSection(..) => {
                value.parse().ok().map(|number| step_second_digit(number, up).to_string())
            }
            kind => neighbouring_name(&kind.names(), value, up),
        };
        let Some(next) = next else { return EditOutcome::None };
        let changed = self.with_value(&field.path, &next);
        self.adopt_if_valid(changed)
    }

    /// Sets the selected interval to the next common delay time.
    pub fn step_to_common(&mut self, up: bool) -> EditOutcome {
        let interval = self.field().filter(|field| is_interval(&field.path));
        let Some((path, Ok(time))) = interval.map(|field| (field.path, field.value.parse::<f64>())) else {
            self.problem = Some(
                "select an interval: then Shift-Left and Shift-Right step through common times".to_owned(),
            );
            return EditOutcome::None;
        };
        let Some(next) = common_delay(time, up) else {
            self.problem = Some("there is no common delay time further".to_owned());
            return EditOutcome::None;
        };
        let changed = self.with_value(&path, &next.to_string());
        self.adopt_if_valid(changed)
    }

    /// Copies a delay option. Then the user types the interval or the firing times of the copy.
    pub fn copy_option(&mut self, option: usize) -> EditOutcome {
        let copied = fields::copy_delay(&self.text, option);
        let outcome = self.adopt(copied.ok_or_else(|| "there is no delay option to copy".to_owned()));
        if matches!(outcome, EditOutcome::Changed(_)) {
            self.select_option(option + 1);
            self.entry = Some(Entry::Typed { line: TypedLine::default(), copy_of: Some(option) });
        }
        outcome
    }

    /// Removes the selected delay option, or the selected value if the plan may leave it out.
    pub fn remove(&mut self) -> EditOutcome {
        let Some(EditField { path, .. }) = self.field().cloned() else { return EditOutcome::None };
        let removed = match path.index {
            Some(option) if path.section == plan::DELAY.name => fields::remove_delay(&self.text, option)
                .ok_or_else(|| "the plan needs a delay option".to_owned()),
            // A stray key must remove neither a limit nor an uncertainty.
            _ if [plan::LIMITS.name, plan::UNCERTAINTY.name].contains(&path.section)
                && !path.key.required =>
            {
                Err("this is taken away only by typing: Enter, nothing, Enter".to_owned())
            }
            _ if path.key.required => Err(format!("the plan needs `{}`", path.key.name)),
            _ => fields::set(&self.text, &path, ""),
        };
        self.adopt(removed)
    }
}

/// Whether a launch velocity [m/s] equals one of blast row `row` in the file times `factor`, up to rounding.
pub(super) fn is_of_file(file: &Plan, factor: f64, row: usize, speed: f64) -> bool {
    let mut launches = file.blast_rows.get(row).into_iter().flat_map(BlastRow::launches);
    launches.any(|launch| (launch.speed_m_s * factor - speed).abs() <= ROUNDED * speed.abs())
}

/// Largest relative rounding error of a number with six digits.
const ROUNDED: f64 = 1e-5;

fn is_interval(path: &Path) -> bool {
    path.section == plan::DELAY.name && path.key.name == delay::INTERVAL_MS.name
}

fn is_tire_mass(path: &Path) -> bool {
    path.section == plan::TIRE.name && path.key.name == tire::MASS_KG.name
}
