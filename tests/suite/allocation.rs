//! The stepping loop takes no memory: a run ten times as long asks for none more.

use std::ops::ControlFlow;

use shelter::simulation::Model;

use crate::support::scenes::{METHODS, fire_rows, grid, settings};

#[test]
fn a_longer_run_allocates_no_more() {
    let model = Model::new(grid(6, 12, 1.5, 1.4e6));
    let shot = fire_rows(&[1, 3, 4], 12, 0.02);
    for method in METHODS {
        let allocations = |duration: f64| {
            let settings = settings(method, 1e-3, Some(duration));
            let run = || model.run(&shot, &settings, &mut |_| ControlFlow::Continue(()));
            run().expect("the first run prepares the model");
            allocation_counter::measure(|| drop(run())).count_total
        };
        let (short, long) = (allocations(0.05), allocations(0.5));
        assert!(short > 0, "nothing is counted");
        assert_eq!(short, long, "{method:?}");
    }
}
