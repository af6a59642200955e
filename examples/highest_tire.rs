//! Steps through the motion of the first delay option and prints the highest tire ten times a second:
//! `cargo run --no-default-features --example highest_tire -- PLAN`.

use std::error::Error;
use std::ops::ControlFlow;
use std::path::Path;

use shelter::choice::Method;
use shelter::{Case, RunSettings};

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "plans/amur-three-rows.toml".to_owned());
    let case = Case::load(Path::new(&path))?;
    let scene = case.scene();
    let settings =
        RunSettings { method: Method::Verlet, step: 0.1 * scene.critical_step(), duration: Some(1.0) };
    let mut next = 0.0;
    let outcome = case.model.run(&case.shots[0], &settings, &mut |motion| {
        if motion.time() >= next {
            next += 0.1;
            let height = |tire: usize| motion.displacement(tire).z;
            let highest = (0..scene.tire_count()).max_by(|&a, &b| height(a).total_cmp(&height(b)));
            if let Some(tire) = highest {
                println!(
                    "{:.1} s: tire {} is {:.3} m high",
                    motion.time(),
                    scene.tire_ids[tire],
                    height(tire)
                );
            }
        }
        ControlFlow::Continue(())
    })?;
    println!("peak: {:.3} m at {:.3} s", outcome.height.value, outcome.height.time);
    Ok(())
}
