//! Do windows hold between their points, do orders find the worst, and a search the least risk? Compares all with brute force.
//!
//! `cargo bench --bench studies -- sweep` checks intervals [`CLOSE`] apart inside the windows of the shipped plans and of ten
//! random ones, rim to rim. `cargo bench --bench studies -- orders 6 10` checks all orders of 6 rows of 10 random plans, rim to
//! rim and centre to centre in turn, at three intervals. Of more than [`MOST_CHECKED_ROWS`] rows every order is run once at the
//! step of the level, and the [`ENDS`] worst and best by that run are checked. `cargo bench --bench studies -- search 20` samples
//! every schedule of 20 random plans 2,000 times, `search 20 11` only of those from number 11 on. `cargo bench --bench studies --
//! fit 200` estimates 200 unknowns of random plans whose truth is known; `calm 200` judges 200 plans that were fitted to one shot;
//! `sites 100` follows the advice on the launch velocity at 100 made-up sites.

mod calm;
mod plans;
#[allow(dead_code)]
#[path = "../calibration/random.rs"]
mod random;
mod round_trip;
mod schedules;
mod sites;

use std::ops::ControlFlow;
use std::time::Instant;

use itertools::Itertools;
use rayon::prelude::*;
use shelter::plan::{HoleTiming, Time};
use shelter::study::as_planned::check::check_shot;
use shelter::study::orders::try_orders;
use shelter::study::sweep::sweep;
use shelter::study::{Case, ComputeSettings, Context, Intervals, Shard, ShotSummary, StudyControl};
use shelter::verdict::Verdict;

/// Distance between the intervals that are checked inside windows.
const CLOSE: Time = Time::from_nanoseconds(50_000);
/// Greatest number of rows at which every order is checked.
const MOST_CHECKED_ROWS: usize = 6;
/// Number of orders of more rows that are checked at each end.
const ENDS: usize = 400;
/// Intervals at which orders are compared [ms].
const DEFAULT_INTERVALS_MS: [i64; 3] = [9, 42, 109];

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    let number =
        |n: usize, default: usize| words.get(n).and_then(|word| word.parse().ok()).unwrap_or(default);
    match words.first().map(String::as_str) {
        Some("calm") => calm::compare(number(1, 200) as u64),
        Some("sites") => sites::compare(number(1, 100) as u64),
        Some("fit") => round_trip::compare(number(1, 200)),
        Some("search") => schedules::compare(number(2, 0) as u64..number(1, 20) as u64),
        Some("orders") => compare_orders(number(1, 6), number(2, 10) as u64),
        _ => compare_windows(number(1, 10) as u64),
    }
}

fn checked(case: &Case, order: &[usize], interval: Time) -> ShotSummary {
    let compute = ComputeSettings::of(&case.plan);
    let checked = check_shot(case, &case.shot(order, interval, &HoleTiming::TOGETHER), &compute, &mut |_| {
        ControlFlow::Continue(())
    });
    checked.map_or(ShotSummary::FAILED_RUN, |checked| ShotSummary::of(&checked))
}

fn compare_windows(random: u64) {
    println!(
        "| plan | points tried | windows, wider than a point | together, ms | widest gap, ms | checked inside | do not pass | of these open | farthest past a limit | sweep, s |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|");
    let shipped = ["amur-three-rows", "point-blasting", "large-50x50"].map(|name| {
        let case = Case::load(format!("plans/{name}.toml").as_ref());
        (name.to_owned(), case.unwrap_or_else(|mistakes| panic!("{mistakes}")))
    });
    let random = (0..random).map(|n| (format!("random {n}"), plans::case(n, None, true)));
    let (mut inside, mut failures) = (0, 0);
    for (name, case) in shipped.into_iter().chain(random) {
        let order: Vec<usize> = (0..case.plan.blast_rows.len()).collect();
        let intervals = Intervals { from: Time::ZERO, to: Time::from_ms(500.0), step: Time::from_ms(0.25) };
        let (begun, compute) = (Instant::now(), ComputeSettings::of(&case.plan));
        let swept = sweep(
            &Context::new(&case, compute, &StudyControl::default()),
            &order,
            &intervals,
            HoleTiming::TOGETHER,
        );
        let (swept, wall) = (swept.expect("a result").value, begun.elapsed().as_secs_f64());
        let close = (0..=10_000).map(|n| CLOSE * n);
        let close: Vec<Time> =
            close.filter(|at| swept.windows.iter().any(|[from, to]| (*from..=*to).contains(at))).collect();
        let judged = close.par_iter().map(|&at| checked(&case, &order, at));
        let bad: Vec<ShotSummary> = judged.filter(|judged| judged.verdict != Verdict::Pass).collect();
        let open = bad.iter().filter(|judged| judged.verdict == Verdict::Undecided).count();
        let farthest = bad.iter().map(|judged| judged.utilization(&case.limits)).fold(0.0, f64::max);
        let wide: Vec<Time> =
            swept.windows.iter().map(|&[from, to]| to - from).filter(|wide| *wide > Time::ZERO).collect();
        println!(
            "| {name} | {} | {}, {} | {:.1} | {:.3} | {} | {} | {open} | {farthest:.3} | {wall:.2} |",
            swept.points.len(),
            swept.windows.len(),
            wide.len(),
            wide.iter().copied().sum::<Time>(),
            swept.largest_gap(),
            close.len(),
            bad.len(),
        );
        (inside, failures) = (inside + close.len(), failures + bad.len());
    }
    println!("\n{failures} of {inside} do not pass: {:.2} %", 100.0 * failures as f64 / inside as f64);
}

fn compare_orders(rows: usize, random: u64) {
    println!(
        "| plan | interval, ms | worst of all, error | short of it | best of all | above it | orders, s | all compared, s |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    for n in 0..random {
        let rim = n % 2 == 0;
        let case = plans::case(n, Some(rows), rim);
        let compute = ComputeSettings::of(&case.plan);
        let ends = |all: &[ShotSummary]| {
            let order = |a: &f64, b: &f64| a.total_cmp(b);
            let all = all.iter().map(|judged| judged.utilization(&case.limits));
            [all.clone().max_by(order), all.min_by(order)].map(|end| end.expect("an order"))
        };
        for interval in DEFAULT_INTERVALS_MS.map(|ms| Time::from_nanoseconds(1_000_000) * ms) {
            let begun = Instant::now();
            let found = try_orders(
                &Context::new(&case, compute, &StudyControl::default()),
                &[interval],
                HoleTiming::TOGETHER,
                Shard::WHOLE,
            );
            let (found, wall) = (found.expect("a result").value, begun.elapsed().as_secs_f64());
            let found: Vec<ShotSummary> = found.iter().map(|tried| tried.planned).collect();
            let begun = Instant::now();
            let compared = hardest_and_easiest(&case, rows, interval);
            let brute: Vec<ShotSummary> =
                compared.par_iter().map(|order| checked(&case, order, interval)).collect();
            let ([worst, best], [high, low]) = (ends(&found), ends(&brute));
            let [upper, _] = ends(&brute.iter().map(|judged| judged.with_errors(1.0)).collect_vec());
            println!(
                "| {n}, {} | {:.0} | {high:.4}, {:.4} | {:.3} % | {low:.4} | {:.3} % | {wall:.1} | {:.1} |",
                if rim { "rim to rim" } else { "centre to centre" },
                interval,
                upper - high,
                100.0 * (1.0 - worst / high),
                100.0 * (best / low - 1.0),
                begun.elapsed().as_secs_f64(),
            );
        }
    }
}

/// All orders, or those that may be the worst or the best by one run of each.
fn hardest_and_easiest(case: &Case, rows: usize, interval: Time) -> Vec<Vec<usize>> {
    let all = (0..rows).permutations(rows).collect_vec();
    if rows <= MOST_CHECKED_ROWS {
        return all;
    }
    let compute = ComputeSettings::of(&case.plan);
    let settings = case.run_settings(compute.method, compute.first_step(case));
    let utilization = |order: &Vec<usize>| {
        let run = case.model.run(&case.shot(order, interval, &HoleTiming::TOGETHER), &settings, &mut |_| {
            ControlFlow::Continue(())
        });
        let run = run.expect("a run");
        let values = [run.height.value, run.force.value, run.drift.value];
        case.limits.utilization(|quantity| values[quantity as usize])
    };
    let used: Vec<f64> = all.par_iter().map(utilization).collect();
    let ranked: Vec<usize> = (0..all.len()).sorted_by(|&a, &b| used[b].total_cmp(&used[a])).collect();
    let [worst, best] = [&ranked[..ENDS], &ranked[ranked.len() - ENDS..]];
    worst.iter().chain(best).map(|&n| all[n].clone()).collect()
}
