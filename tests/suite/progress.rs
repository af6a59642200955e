//! The progress of every study, as a user watches it.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use shelter::choice::Accuracy;
use shelter::plan::{HoleTiming, PlanSource, Time};
use shelter::study::assumptions::{Extent, find_assumptions};
use shelter::study::effects::{SAMPLES, effects};
use shelter::study::orders::orders;
use shelter::study::remedies;
use shelter::study::samples::sample_count::Sampling;
use shelter::study::search::search;
use shelter::study::size::{Demand, size};
use shelter::study::study_trait::Study;
use shelter::study::sweep::sweep;
use shelter::study::work::progress::Progress;
use shelter::study::{Case, ComputeSettings, Context, Intervals, NoResult, StudyControl, thread_pool};

use super::support::{Edited, small_plan_of};

/// Greatest fraction that may be shown once three quarters of the work are done.
const NEARLY_DONE: f64 = 0.98;

/// What is shown while `work` runs, each with the pieces of work done.
fn watched(work: impl FnOnce(&StudyControl) -> Result<(), NoResult> + Send) -> Vec<(usize, Progress)> {
    let (control, ended) = (StudyControl::default(), AtomicBool::new(false));
    std::thread::scope(|scope| {
        let watching = scope.spawn(|| {
            let mut seen = Vec::new();
            while !ended.load(Ordering::Relaxed) {
                seen.push((control.counts().0, control.progress()));
                std::thread::sleep(Duration::from_micros(200));
            }
            seen.push((control.counts().0, control.progress()));
            seen
        });
        let found = thread_pool(2).expect("threads").install(|| work(&control));
        ended.store(true, Ordering::Relaxed);
        found.expect("a result");
        watching.join().expect("watched")
    })
}

fn assert_honest(study: &str, seen: &[(usize, Progress)], steps: usize) {
    let falls = |pair: &&[(usize, Progress)]| {
        let [(_, before), (_, after)] = [&pair[0], &pair[1]];
        after.fraction < before.fraction || after.step < before.step
    };
    assert_eq!(seen.windows(2).find(falls), None, "{study}");
    let (all, last) = seen.last().expect("watched");
    assert_eq!((last.step, last.steps), (steps, steps), "{study}");
    assert!((last.fraction - 1.0).abs() < 1e-9, "{study} ends at {last:?}");
    let late = seen.iter().find(|(done, _)| 4 * done >= 3 * all && done < all);
    // Work that proves needless is passed over in one leap.
    assert!(late.is_none_or(|(_, late)| late.fraction <= NEARLY_DONE), "{study} waits: {late:?} of {all}");
    let half = seen.iter().find(|(done, _)| 2 * done >= *all).expect("the second half");
    assert!(half.1.fraction >= 0.1, "{study} stands still: {half:?} of {all}");
}

#[test]
fn no_study_runs_backwards_or_waits_at_its_end() {
    // The more is accepted, the fewer samples a verdict takes.
    let text = small_plan_of(&["all at once", "42 ms"])
        .edited("accepted_risk_percent = 1 ", "accepted_risk_percent = 5 ")
        .edited("tire_mass_kg = [280, 350]", "tire_mass_kg = [280]")
        .edited("ropes = \"GOST 2688-80\"", "ropes = \"EN 12385-4 6x36 IWRC\"");
    let case = Case::parse(PlanSource { path: std::path::PathBuf::new(), text }).expect("a plan");
    let compute = ComputeSettings { accuracy: Accuracy::Draft, ..ComputeSettings::of(&case.plan) };
    let few = Sampling { most: 200, ..Sampling::OF_VERDICT };
    let some = Some(&few);
    let intervals = Intervals { from: Time::ZERO, to: Time::from_ms(40.0), step: Time::from_ms(8.0) };
    let seen = watched(|control| {
        sweep(
            &Context::new(&case, compute, control).with_sampling(some.copied()),
            &[0, 1, 2],
            &intervals,
            HoleTiming::TOGETHER,
        )
        .map(drop)
    });
    assert_honest("sweep", &seen, 3);
    let seen = watched(|control| {
        orders(
            &Context::new(&case, compute, control).with_sampling(some.copied()),
            &case.plan.intervals(None),
            HoleTiming::TOGETHER,
        )
        .map(drop)
    });
    assert_honest("orders", &seen, 2);
    let seen = watched(|control| {
        search(&Context::new(&case, compute, control).with_sampling(some.copied())).map(drop)
    });
    assert_honest("search", &seen, 2);
    assert!(seen.iter().any(|(_, progress)| progress.trying.is_some()), "what is judged has a name");
    let demand = Demand::Options(vec![1]);
    let seen = watched(|control| {
        size(&Context::new(&case, compute, control).with_sampling(some.copied()), &case.plan.size, &demand)
            .map(drop)
    });
    assert_honest("size", &seen, 2);
    let samples = Sampling::exactly(SAMPLES, 1);
    let seen =
        watched(|control| effects(&Context::new(&case, compute, control).with_sampling(samples)).map(drop));
    assert_honest("effects", &seen, 2);
    let seen = watched(|control| {
        Context::new(&case, compute, control).with_sampling(some.copied()).judge_options().map(drop)
    });
    assert_honest("check", &seen, 4);
    let seen = watched(|control| {
        let context = Context::new(&case, compute, control).with_sampling(some.copied());
        remedies::Question { option: 0 }.answer(&context).map(drop)
    });
    assert_honest("remedies", &seen, 2);
    // Duds are judged after all samples, and take longer.
    let mut with_duds = case.clone();
    with_duds.plan.limits.withstands_one_dud = true;
    let hundred = Sampling::exactly(100, 1);
    let seen = watched(|control| {
        Context::new(&with_duds, compute, control).with_sampling(hundred).sample_options().map(drop)
    });
    assert_honest("risk", &seen, 2);
    let values = Sampling::exactly(15, 1);
    let holds = |control: &StudyControl| {
        find_assumptions(&Context::new(&case, compute, control).with_sampling(values), 1, Extent::All)
            .map(drop)
    };
    assert_honest("holds", &watched(holds), 0);
}

/// What a study costs is known to a factor of two: both ends are told, with one digit.
#[test]
fn a_cost_is_told_as_a_range() {
    let told =
        [1.0, 8.0, 26.0, 40.0, 1800.0, 7200.0].map(|time| shelter::units::rough_range(time)[0].clone());
    assert_eq!(told, ["1-2 s", "4-20 s", "10-50 s", "20 s-1 min", "20-60 min", "60 min-4 h"]);
}
