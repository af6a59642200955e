//! The results of `size`; schema `shelter.size/1`.

use serde::Serialize;

use super::table::Style;
use crate::study::size::{Combination, Sizing, Trial, Untried};
use crate::study::{Case, Envelope};
use crate::units::{Unit, value_and_error};
use crate::verdict::Verdict;

/// The document of one study.
#[derive(Serialize)]
pub struct Document {
    schema: &'static str,
    plan: String,
    title: String,
    found: bool,
    #[serde(flatten)]
    lightest: Option<Row>,
    tried: usize,
    not_tried: usize,
    partial: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    nearest: Option<Row>,
    frontier: Vec<Row>,
}

/// One combination, for JSON.
#[derive(Serialize)]
pub struct Row {
    rope: String,
    tire_mass_kg: f64,
    border_rows: usize,
    tires: usize,
    total_mass_kg: f64,
    utilization: Option<f64>,
    worst: Option<super::Values>,
}

/// One combination, for CSV.
#[derive(Serialize)]
pub struct Line {
    rope: String,
    tire_mass_kg: f64,
    border_rows: usize,
    tires: usize,
    total_mass_kg: f64,
    holds: bool,
    tried: bool,
    utilization: Option<f64>,
}

impl Row {
    fn new(combination: &Combination) -> Self {
        let Combination { rope, tire_mass, border_rows, tires, total_mass, trial } = combination;
        Self {
            rope: rope.name.clone(),
            tire_mass_kg: *tire_mass,
            border_rows: *border_rows,
            tires: *tires,
            total_mass_kg: *total_mass,
            utilization: trial.ok().map(|trial| trial.utilization),
            worst: trial.ok().map(|trial| super::Values::new(&trial.worst)),
        }
    }
}

impl Line {
    /// Of a combination.
    pub fn new(combination: &Combination) -> Self {
        let row = Row::new(combination);
        Self {
            rope: row.rope,
            tire_mass_kg: row.tire_mass_kg,
            border_rows: row.border_rows,
            tires: row.tires,
            total_mass_kg: row.total_mass_kg,
            holds: combination.trial.is_ok_and(|trial| trial.holds),
            tried: combination.trial.is_ok(),
            utilization: row.utilization,
        }
    }
}

impl Document {
    /// Of all combinations.
    pub fn new(case: &Case, sizing: &Sizing) -> Self {
        let found = sizing.found();
        Self {
            schema: "shelter.size/1",
            plan: case.source.path.clone(),
            title: case.title().to_owned(),
            found: found.is_some(),
            lightest: found.map(Row::new),
            tried: sizing.tried(),
            not_tried: sizing.combinations.len() - sizing.tried(),
            partial: sizing.untried(Untried::OutOfTime) > 0,
            nearest: found.is_none().then(|| nearest(sizing)).flatten().map(|(c, _)| Row::new(c)),
            frontier: sizing.frontier().into_iter().map(Row::new).collect(),
        }
    }
}

/// The frontier for reading.
pub fn text(case: &Case, sizing: &Sizing, style: Style) -> String {
    let plan = &case.plan;
    let mut text = format!("{} · {}\n", case.title(), case.source.path);
    text += &format!(
        "limits: height {} m, breaking force / {}\n",
        plan.limits.flight_height_m, plan.limits.cable_safety_factor
    );
    let (tried, all) = (sizing.tried(), sizing.combinations.len());
    text += &format!("{tried} of {all} combinations tried");
    let [same_stiffness, out_of_time, unstable] =
        [Untried::SameStiffnessFails, Untried::OutOfTime, Untried::Unstable].map(|why| sizing.untried(why));
    if same_stiffness > 0 {
        text +=
            &format!("; {same_stiffness} have the stiffness of a stronger rope that fails, and move alike");
    }
    if out_of_time > 0 {
        text += &format!("; for {out_of_time} the time did not suffice");
    }
    if unstable > 0 {
        text += &format!("; {unstable} cannot be followed at this step: choose a smaller --dt");
    }
    text += "\n\n";
    let frontier = sizing.frontier();
    let Some(found) = sizing.found() else {
        text += &match out_of_time + unstable {
            0 => format!("{}: no combination holds\n", style.verdict(Verdict::Fail)),
            _ => format!("{}: no combination tried so far holds\n", style.verdict(Verdict::Undecided)),
        };
        if let Some((combination, trial)) = nearest(sizing) {
            text += &format!("nearest: {}\n", words(combination, &trial));
        }
        return style.plain(text);
    };
    text += &format!(
        "{:26}  {:>7}  {:>6}  {:>5}  {:>9}  {:>6}  {:>17}  {:>17}\n",
        "rope", "tire kg", "border", "tires", "total t", "margin", "height, m", "force, kN"
    );
    for combination in frontier {
        let Ok(trial) = combination.trial else { continue };
        let Envelope { height, force, .. } = trial.worst;
        text += &format!(
            "{:26}  {:>7}  {:>6}  {:>5}  {:>9.2}  {:>4.0} %  {:>17}  {:>17}\n",
            combination.rope.name,
            combination.tire_mass,
            combination.border_rows,
            combination.tires,
            combination.total_mass * 1e-3,
            1e2 * (1.0 - trial.utilization),
            value_and_error(height.value, height.error, Unit::Metre),
            value_and_error(force.value, force.error, Unit::Kilonewton),
        );
    }
    let word = style.verdict(Verdict::Pass);
    if let Ok(trial) = &found.trial {
        let so_far = if out_of_time > 0 { " so far" } else { "" };
        text += &format!("\n{word}: lightest{so_far} {}\n", words(found, trial));
    }
    style.plain(text)
}

/// The combination that uses least of the limits, of those that fail.
fn nearest(sizing: &Sizing) -> Option<(&Combination, Trial)> {
    let trials = sizing.combinations.iter().filter_map(|c| Some((c, c.trial.ok()?)));
    trials.min_by(|a, b| a.1.utilization.total_cmp(&b.1.utilization))
}

fn words(combination: &Combination, trial: &Trial) -> String {
    format!(
        "{}, tires of {} kg, {} border rows: {:.2} t in all, {:.0} % of the limits used, {} shots judged",
        combination.rope.name,
        combination.tire_mass,
        combination.border_rows,
        combination.total_mass * 1e-3,
        1e2 * trial.utilization,
        trial.shots,
    )
}
