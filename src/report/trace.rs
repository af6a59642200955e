//! Quantities over time as CSV: the columns of `trace`, and the rows of a history.

use serde::Serialize;

use crate::outcome::History;
use crate::scene::Scene;
use crate::study::trace::Chosen;

/// Column names: time, then per tire and per cable, each addressed as in the plan.
pub fn header(scene: &Scene, chosen: &Chosen) -> Vec<String> {
    let mut names = vec!["t_s".to_owned()];
    for &tire in &chosen.tires {
        let id = scene.tire[tire];
        let quantities = ["x_m", "y_m", "height_m", "friction_n", "friction_limit_n"];
        names.extend(quantities.map(|quantity| format!("{quantity}[{id}]")));
    }
    names.extend(chosen.cables.iter().map(|&cable| format!("force_n[{}]", scene.cable_name(cable))));
    names
}

/// Greatest height and force of a stretch of time.
#[derive(Serialize)]
pub struct Row {
    from_s: f64,
    to_s: f64,
    flight_height_m: f64,
    cable_force_n: f64,
}

/// The rows of a history.
pub fn history(history: &History) -> impl Iterator<Item = Row> + '_ {
    history.height.iter().zip(&history.force).enumerate().map(|(n, (&height, &force))| Row {
        from_s: n as f64 * history.width,
        to_s: (n + 1) as f64 * history.width,
        flight_height_m: height,
        cable_force_n: force,
    })
}
