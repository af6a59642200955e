//! Sweeps the interval between the rows of a plan and prints the intervals that pass as planned:
//! `cargo run --release --no-default-features --example sweep -- PLAN`.

use std::error::Error;
use std::path::Path;

use shelter::plan::{HoleTiming, Time};
use shelter::study::sweep::sweep;
use shelter::study::{Context, Intervals, StudyControl};
use shelter::{Case, ComputeSettings};

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "plans/amur-three-rows.toml".to_owned());
    let case = Case::load(Path::new(&path))?;
    let compute = ComputeSettings::of(&case.plan);
    let order: Vec<usize> = (0..case.plan.blast_rows.len()).collect();
    let intervals = Intervals { from: Time::ZERO, to: Time::from_ms(100.0), step: Time::from_ms(10.0) };
    // Another thread may read the progress, or end the study.
    let swept = sweep(
        &Context::new(&case, compute, &StudyControl::default()),
        &order,
        &intervals,
        HoleTiming::TOGETHER,
    )?
    .value;
    for [from, to] in swept.windows {
        println!("{from} ms to {to} ms pass as planned");
    }
    Ok(())
}
