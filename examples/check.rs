//! Prints the verdict of every delay option of a plan: `cargo run --no-default-features --example check -- PLAN`.

use std::error::Error;
use std::path::Path;

use shelter::units::{Unit, value_and_error};
use shelter::{Case, ComputeSettings};

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "plans/amur-three-rows.toml".to_owned());
    let case = Case::load(Path::new(&path))?;
    let compute = ComputeSettings::of(&case.plan);
    for (option, delay) in case.plan.delays.iter().enumerate() {
        let checked = case.check(option, &compute)?;
        let height = value_and_error(checked.height.value, checked.height.error, Unit::Metre);
        let force = value_and_error(checked.force.value, checked.force.error, Unit::Kilonewton);
        println!("{}: {:?}, height {height} m, cable force {force} kN", delay.name, checked.verdict);
    }
    Ok(())
}
