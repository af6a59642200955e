//! Any table is a list of holes that makes a plan, or a list of mistakes.
#![no_main]

use libfuzzer_sys::fuzz_target;
use shelter::plan::Plan;
use shelter::plan::import::{Directions, plan_from_holes};

fuzz_target!(|text: &str| {
    for directions in [Directions::Vertical, Directions::AgainstHoles] {
        match plan_from_holes("holes.csv", text, directions) {
            Ok(imported) => {
                if let Err(mistakes) = Plan::parse("plan.toml", &imported.text) {
                    panic!("{}\n{}", mistakes.render(false), imported.text);
                }
            }
            Err(mistakes) => assert!(!mistakes.render(false).is_empty()),
        }
    }
});
