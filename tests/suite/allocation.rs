//! The stepping loop takes no memory: a run ten times as long asks for none more. What is no plan and no list is refused before it
//! takes much.

use std::ops::ControlFlow;

use shelter::Plan;
use shelter::plan::Diagnostics;
use shelter::plan::import::{Directions, plan_from_file, plan_from_holes};
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

/// Most memory held at once while a text is read that has mistakes [MB], and what is told of them.
fn memory_of<T>(read: impl FnOnce() -> Result<T, Diagnostics>) -> (u64, String) {
    let mut told = String::new();
    let used = allocation_counter::measure(|| {
        told = read().map(|_| ()).expect_err("it has mistakes").render(false);
    });
    (used.bytes_max >> 20, told)
}

/// A kilobyte for each of so many sections, and a message for each, would be 800 MB.
#[test]
fn half_a_million_sections_are_refused_before_they_take_memory() {
    let sections: String = (0..500_000).map(|n| format!("[a{n:06}]\nx = 1\n")).collect();
    let (megabytes, told) = memory_of(|| Plan::parse("plan.toml", &sections));
    assert!(told.contains("500000 sections") && megabytes < 1, "{megabytes} MB: {told}");
}

/// Of 300,000 mistakes 1,000 are kept: the others would take as much as the plan itself, some 50 MB.
#[test]
fn mistakes_take_no_more_memory_than_the_plan() {
    let delays = "[[delay]]\n".repeat(100_000);
    let (megabytes, told) = memory_of(|| Plan::parse("plan.toml", &delays));
    assert!(told.contains("and at least 980 more mistakes") && megabytes < 60, "{megabytes} MB: {told}");
}

#[test]
fn a_table_takes_a_bounded_amount_of_memory() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("holes.csv");
    let read = || plan_from_file(&path, Directions::Vertical);
    let holes = |megabytes: usize| "3,3.0,0\n".repeat(megabytes << 17);
    let quote = "hole,x,y\n1,0,0\n2,\"1.5,0\n";
    std::fs::write(&path, format!("{quote}{}", holes(60))).expect("written");
    let (megabytes, told) = memory_of(read);
    assert!(told.contains("larger than 8 MB") && megabytes < 32, "60 MB: {megabytes} MB: {told}");
    std::fs::write(&path, format!("{quote}{}", holes(7))).expect("written");
    let (megabytes, told) = memory_of(read);
    assert!(
        told.contains("the line has 2 values for 3 columns") && megabytes < 120,
        "{megabytes} MB: {told}"
    );
    // From elsewhere than a file, too.
    let holes = format!("hole,x,y\n{}", holes(30));
    let (megabytes, told) = memory_of(|| plan_from_holes("holes.csv", &holes, Directions::Vertical));
    assert!(told.contains("more than 1000000 values") && megabytes < 200, "{megabytes} MB: {told}");
}
