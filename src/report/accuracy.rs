//! The results of `accuracy` as text, JSON and CSV; schema `shelter.accuracy/1`.

use serde::Serialize;

use crate::choice::Method;
use crate::study::Case;
use crate::study::accuracy::{CLASSES, Measured, PAPER, PaperRow, Study, paper_table};
use crate::units;

/// The document.
#[derive(Serialize)]
pub struct Document {
    schema: &'static str,
    plan: String,
    option: String,
    rows: Vec<Row>,
    reference: Choice,
    recommended: Recommended,
}

/// One method at one step.
#[derive(Serialize)]
pub struct Row {
    method: &'static str,
    dt_s: f64,
    steps: Option<usize>,
    stable: bool,
    flight_height_m: Option<f64>,
    cable_force_n: Option<f64>,
    height_error: Option<f64>,
    force_error: Option<f64>,
    energy_residual: Option<f64>,
    wall_s: Option<f64>,
}

#[derive(Serialize)]
struct Choice {
    method: &'static str,
    dt_s: f64,
}

#[derive(Serialize)]
struct Recommended {
    draft: Choice,
    field: Choice,
    reference: Choice,
}

/// The rows of a study.
pub fn rows(study: &Study) -> Vec<Row> {
    let row = |row: &crate::study::accuracy::Row| {
        let result = row.result.as_ref();
        Row {
            method: row.method.name(),
            dt_s: row.step,
            steps: result.map(|m| m.steps),
            stable: result.is_some(),
            flight_height_m: result.map(|m| m.height),
            cable_force_n: result.map(|m| m.force),
            height_error: result.map(|m| m.height_error),
            force_error: result.map(|m| m.force_error),
            energy_residual: result.map(|m| m.energy_residual),
            wall_s: result.map(|m| m.wall.as_secs_f64()),
        }
    };
    study.rows.iter().map(row).collect()
}

impl Document {
    /// The results of one option.
    pub fn new(case: &Case, option: usize, study: &Study) -> Self {
        let choice = |dt_s| Choice { method: Method::Verlet.name(), dt_s };
        let [draft, field, reference] = study.levels.map(|(_, step)| choice(step));
        Self {
            schema: "shelter.accuracy/1",
            plan: case.source.path.clone(),
            option: case.plan.delays[option].name.clone(),
            rows: rows(study),
            reference: choice(study.reference_step),
            recommended: Recommended { draft, field, reference },
        }
    }
}

/// A work-precision table, the plot, what the levels use, and the paper's table where it is its plan.
pub fn text(case: &Case, option: usize, study: &Study) -> String {
    let mut text = format!(
        "{}, option {}\nerrors against verlet at {}; times on this machine, one thread\n\n",
        case.title(),
        case.plan.delays[option].name,
        units::milliseconds(study.reference_step)
    );
    text += &format!(
        "{:8} {:>11} {:>8} {:>10} {:>10} {:>10} {:>10} {:>9} {:>11}\n",
        "method", "step", "steps", "height, m", "error", "force, kN", "error", "residual", "time"
    );
    for row in &study.rows {
        let level = study.levels.iter().find(|(_, step)| *step == row.step && row.method == Method::Verlet);
        let level = level.map_or("", |(level, _)| level.name());
        text += &format!("{:8} {:>11} ", row.method.name(), units::milliseconds(row.step));
        text += &row.result.as_ref().map_or_else(|| "not stable\n".to_owned(), |m| measured(m, level));
    }
    text += &plot(study);
    for class in CLASSES {
        text += &format!("\nwithin {} % of height and {} % of force:", class.0 * 100.0, class.1 * 100.0);
        let best = [Method::Verlet, Method::Newmark].map(|method| study.cheapest(method, class));
        for (name, best) in ["verlet", "newmark"].into_iter().zip(best) {
            match best {
                Some((step, wall)) => {
                    let (step, wall) = (units::milliseconds(step), units::milliseconds(wall.as_secs_f64()));
                    text += &format!(" {name} at {step} in {wall};");
                }
                None if study.rows.iter().all(|row| row.method.name() != name) => {
                    text += &format!(" {name} not measured;");
                }
                None => text += &format!(" {name} not reached;"),
            }
        }
        if let [Some((_, fast)), Some((_, slow))] = best {
            text += &format!(" {:.0} times faster", slow.as_secs_f64() / fast.as_secs_f64());
        }
    }
    text.push('\n');
    for method in [Method::Verlet, Method::Newmark] {
        text += &paper_table(case, method).map_or_else(String::new, |rows| paper(method, &rows));
    }
    text
}

fn measured(m: &Measured, level: &str) -> String {
    format!(
        "{:>8} {:>10.5} {:>10} {:>10.4} {:>10} {:>9.0e} {:>11}  {level}\n",
        m.steps,
        m.height,
        percent(m.height_error),
        m.force * 1e-3,
        percent(m.force_error),
        m.energy_residual,
        units::milliseconds(m.wall.as_secs_f64()),
    )
}

fn percent(error: f64) -> String {
    format!("{:.4} %", error * 100.0)
}

/// Size of the plot.
const PLOT: (usize, usize) = (64, 14);

/// The larger of both errors over time, log-log: `v` verlet, `n` newmark.
fn plot(study: &Study) -> String {
    let points: Vec<(char, f64, f64)> = study
        .rows
        .iter()
        .filter_map(|row| {
            let m = row.result.as_ref()?;
            let error = m.height_error.max(m.force_error).max(1e-8);
            let mark = if row.method == Method::Verlet { 'v' } else { 'n' };
            error.is_finite().then(|| (mark, m.wall.as_secs_f64().max(1e-7).log10(), error.log10()))
        })
        .collect();
    let range = |of: fn(&(char, f64, f64)) -> f64| {
        let low = points.iter().map(of).fold(f64::INFINITY, f64::min).floor();
        (low, points.iter().map(of).fold(low, f64::max).ceil().max(low + 1.0))
    };
    let (times, errors) = (range(|p| p.1), range(|p| p.2));
    let mut grid = vec![vec![' '; PLOT.0]; PLOT.1];
    let place = |value: f64, (low, high): (f64, f64), size: usize| {
        (((value - low) / (high - low) * (size - 1) as f64).round() as usize).min(size - 1)
    };
    for (mark, time, error) in &points {
        grid[PLOT.1 - 1 - place(*error, errors, PLOT.1)][place(*time, times, PLOT.0)] = *mark;
    }
    let mut text = format!(
        "\nerror, 1e{} to 1e{} (upwards), over time, 1e{} to 1e{} s; v verlet, n newmark\n",
        errors.0, errors.1, times.0, times.1
    );
    for line in grid {
        text += &format!("  |{}\n", line.into_iter().collect::<String>().trim_end());
    }
    text + &format!("  +{}\n", "-".repeat(PLOT.0))
}

fn paper(method: Method, ours: &[PaperRow]) -> String {
    let mut text = format!(
        "\nTable 1 of the source paper, ours ({}) beside it\n{:>10}  {:^23}  {:^23}  {:^23}\n",
        method.name(),
        "step, s",
        "height, m",
        "greatest force, kN",
        "force at 0.16 s, kN"
    );
    for (paper, ours) in PAPER.iter().zip(ours) {
        let pair = |paper: f64, ours: f64| {
            let paper = if paper.is_nan() { "-".to_owned() } else { format!("{paper:.3}") };
            format!("{paper:>11} {ours:>11.4}")
        };
        text += &format!(
            "{:>10}  {}  {}  {}\n",
            format!("{:e}", paper.0),
            pair(paper.1, ours.1),
            pair(paper.2 * 1e-3, ours.2 * 1e-3),
            pair(paper.3 * 1e-3, ours.3 * 1e-3)
        );
    }
    text
}
