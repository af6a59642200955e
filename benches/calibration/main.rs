//! Are the reported errors right? Compares them with true errors over random scenes of eighteen regimes.
//!
//! `cargo bench --bench calibration -- 40` takes 40 scenes of each regime and prints, for every level, how often the true
//! error is within the reported error, how wide reported errors are, how many verdicts flip against the truth, how many stay
//! open, and what refining only open verdicts saves.

mod compare;
mod random;
mod regimes;

use compare::{Compared, QUANTITIES, compare, median, within};
use rayon::prelude::*;
use regimes::Regime;
use shelter::choice::Accuracy;
use shelter::verdict::Verdict;

/// First scene of each regime used here; margins were fitted on scenes 1,000 to 1,059 and 2,000 to 2,059.
const FIRST: u64 = 10_000;
/// Limits drawn for each scene.
const LIMITS: usize = 4;
/// How much finer the truth is than the field level.
const FINER: f64 = 64.0;

fn main() {
    let count = std::env::args().filter_map(|argument| argument.parse().ok()).next().unwrap_or(40_u64);
    let scenes: Vec<(Regime, u64)> =
        Regime::ALL.iter().flat_map(|&regime| (FIRST..FIRST + count).map(move |n| (regime, n))).collect();
    for &accuracy in Accuracy::ALL {
        let all: Vec<Compared> =
            scenes.par_iter().map(|&(regime, n)| compare(regime, n, accuracy, LIMITS, FINER)).collect();
        println!("\n{}: {} scenes\n", accuracy.name(), all.len());
        println!("| regime | height | force | drift |");
        println!("|---|---|---|---|");
        let percents =
            |share: &dyn Fn(usize) -> f64| [0, 1, 2].map(|q| format!("{:.1} %", share(q))).join(" | ");
        for regime in Regime::ALL {
            let own = |q| within(all.iter().filter(|c| c.regime == regime), q);
            println!("| {regime:?} | {} |", percents(&own));
        }
        println!("| all | {} |", percents(&|q| within(all.iter(), q)));
        println!("\n| | median true error | median reported | reported / true |");
        println!("|---|---|---|---|");
        for (q, name) in QUANTITIES.into_iter().enumerate() {
            let pulled = || all.iter().filter(|c| c.reported[q] > 0.0);
            let (truth, reported) =
                (median(pulled().map(|c| c.truth[q])), median(pulled().map(|c| c.reported[q])));
            println!(
                "| {name} | {:.4} % | {:.4} % | {:.1} |",
                100.0 * truth,
                100.0 * reported,
                reported / truth
            );
        }
        let verdicts: Vec<_> = all.iter().flat_map(|c| &c.verdicts).collect();
        let open = verdicts.iter().filter(|(found, _)| *found == Verdict::Undecided).count();
        let flips =
            verdicts.iter().filter(|(found, right)| *found != Verdict::Undecided && found != right).count();
        println!(
            "\n{} limits 0.01 to 10 % from the true values: {flips} verdicts flip, {open} open",
            verdicts.len()
        );
        let sum = |count: fn(&Compared) -> usize| all.iter().map(count).sum::<usize>() as f64;
        let share = sum(|c| c.steps) / sum(|c| c.steps_at_finest);
        println!("{:.1} % of the steps that single runs at the step of the truth take", 100.0 * share);
    }
}
