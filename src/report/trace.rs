//! The columns of `trace`.

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
