//! Prints the verdict of every delay option of a plan: `cargo run --no-default-features --example check -- PLAN`.

use std::error::Error;
use std::path::Path;

use shelter::study::Context;
use shelter::units::{Unit, probabilities, value_and_error};
use shelter::{Case, ComputeSettings, Sampling, StudyControl};

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "plans/amur-three-rows.toml".to_owned());
    let case = Case::load(Path::new(&path))?;
    let compute = ComputeSettings::of(&case.plan);
    let found = Context::new(&case, compute, &StudyControl::default())
        .with_sampling(Sampling::OF_VERDICT)
        .judge_options()?;
    for (delay, judged) in case.plan.delays.iter().zip(found.value) {
        let judged = judged?;
        let force = &judged.checked.estimates.force;
        let force = value_and_error(force.value, force.error, Unit::Kilonewton);
        let failing = judged.sampled.known().map(|risk| probabilities(risk.bounds.interval).join(" to "));
        let failing = failing.unwrap_or_default();
        let verdict = judged.verdict().for_people();
        println!("{}: {verdict}, {failing} % of the shots fail, {force} kN as planned", delay.name);
    }
    Ok(())
}
