//! Does a search of schedules find the least risk? Compares it with every schedule sampled by brute force.

use std::time::Instant;

use itertools::Itertools;
use rayon::prelude::*;
use shelter::plan::{HoleTiming, Plan, Time};
use shelter::scene::Shot;
use shelter::study::samples::run_sample::ShotToSample;
use shelter::study::samples::sample_count::Sampling;
use shelter::study::samples::sample_until_sure::sample_shots;
use shelter::study::search::{Schedule, search};
use shelter::study::{Case, ComputeSettings, Computed, Context, StudyControl};

/// Samples of each schedule by brute force, with draws of their own.
const BRUTE: Sampling = Sampling::exactly(2000, 77);
/// Intervals to choose from, gap by gap [ms].
const DEFAULT_INTERVALS: [f64; 6] = [9.0, 17.0, 25.0, 42.0, 67.0, 109.0];

/// Compares on the random plans of these numbers, of three rows: 6 orders and 36 pairs of intervals.
pub fn compare(plans: std::ops::Range<u64>) {
    println!(
        "| plan | schedules | least risk of all, % | least of those found, % | of the first, % | verdict of the first | search, s | brute force, s | ratio |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    for n in plans {
        let case = unsure(super::plans::case(n, Some(3), n % 2 == 0), ROOM[n as usize % ROOM.len()]);
        let compute = ComputeSettings::of(&case.plan);
        let begun = Instant::now();
        let found = search(
            &Context::new(&case, compute, &StudyControl::default()).with_sampling(Sampling::OF_VERDICT),
        );
        let (found, wall) = (found.expect("a result").value, begun.elapsed().as_secs_f64());
        let begun = Instant::now();
        let schedules = all();
        let share = |schedule: &Schedule| {
            let shot: Shot = schedule.shot(&case);
            let target = ShotToSample::new(&case, &shot, compute, BRUTE);
            let risk = sample_shots(&[target], &StudyControl::default()).expect("a result").value.remove(0);
            risk.bounds.probability().unwrap_or(1.0)
        };
        let shares: Vec<f64> = schedules.par_iter().map(share).collect();
        let brute = begun.elapsed().as_secs_f64();
        let least = shares.iter().copied().fold(1.0, f64::min);
        let place = |found: &Schedule| schedules.iter().position(|one| one == found).expect("one of all");
        let of_found: Vec<f64> = found.schedules.iter().map(|found| shares[place(found)]).collect();
        println!(
            "| {n} | {} | {:.2} | {:.2} | {:.2} | {} | {wall:.1} | {brute:.1} | {:.2} |",
            schedules.len(),
            100.0 * least,
            100.0 * of_found.iter().copied().fold(1.0, f64::min),
            100.0 * of_found[0],
            Computed::complete(found).verdict().for_scripts(),
            wall / brute,
        );
    }
}

/// Factors on the limits of the random plans, which are those of shots as planned: from hopeless to safe.
const ROOM: [f64; 4] = [1.0, 1.15, 1.3, 1.45];

/// The plan with inputs known to some percent, `room` times higher limits, and every gap free.
fn unsure(case: Case, room: f64) -> Case {
    let mut plan: Plan = case.plan;
    plan.limits.flight_height_m *= room;
    plan.cable.breaking_force_kn *= room;
    plan.search.intervals = DEFAULT_INTERVALS.map(Time::from_ms).to_vec();
    plan.search.equal_intervals = false;
    let unknown = &mut plan.uncertainty;
    (unknown.launch_common_percent, unknown.launch_cv_percent) = (5.0, 5.0);
    unknown.friction = unknown.friction.map(|friction| friction * 1.1);
    unknown.axial_stiffness_percent = [-10.0, 20.0];
    Case::new(plan)
}

fn all() -> Vec<Schedule> {
    let gaps = DEFAULT_INTERVALS.iter().cartesian_product(DEFAULT_INTERVALS);
    let orders = (0..3).permutations(3);
    let schedule = |(order, (&first, second)): (Vec<usize>, (&f64, f64))| Schedule {
        order,
        gaps: [first, second].map(Time::from_ms).to_vec(),
        hole_timing: HoleTiming::TOGETHER,
    };
    orders.cartesian_product(gaps.collect_vec()).map(schedule).collect()
}
