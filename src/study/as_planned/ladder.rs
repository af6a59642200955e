//! Runs at ever finer steps until the result is sure.

use super::step_error;
use crate::simulation::RunError;

/// Greatest number of steps below the first: the finest step is 64 times finer.
const MOST_REFINEMENTS: i32 = 12;

/// Result of the runs so far.
pub struct Finding<T> {
    /// The result.
    pub found: T,
    /// Whether the result is sure. A sure result ends the ladder.
    pub is_sure: bool,
}

/// Runs a ladder of steps, from the coarsest to the finest, and returns the last finding. No step runs twice.
///
/// 1. The coarser neighbors of the step `first` [s] run first, then `first`, then finer steps.
/// 2. After `first` and after each finer run, `examine` is called, once there are two runs. It gets all runs so far, and whether no
///    finer run can follow. The last run gives the values, the others give the errors.
/// 3. If `fixed`, the ladder ends at `first`. If every coarser neighbor failed, one finer run gives the error. It is put before
///    `first`, so that the values stay at `first`.
///
/// Both closures get the `runner`.
pub fn run_ladder<C, R, T>(
    runner: &mut C,
    first: f64,
    fixed: bool,
    mut run: impl FnMut(&mut C, f64) -> Result<R, RunError>,
    mut examine: impl FnMut(&mut C, &[R], bool) -> Result<Finding<T>, RunError>,
) -> Result<T, RunError> {
    let rung = |n: i32| first * step_error::RATIO.powi(n);
    let mut runs = Vec::new();
    for n in (1..=step_error::NEIGHBOURS as i32).rev() {
        match run(runner, rung(n)) {
            Ok(coarser) => runs.push(coarser),
            Err(failure) if failure.needs_finer_step() => {}
            Err(failure) => return Err(failure),
        }
    }
    let mut finer = 0;
    loop {
        runs.push(run(runner, rung(-finer))?);
        if runs.len() < 2 && fixed {
            // The finer run gives the error. The values stay at the requested step.
            runs.insert(0, run(runner, rung(-1))?);
        }
        // A single run has no error. Its neighbor is the next finer run.
        if runs.len() >= 2 {
            let is_last = fixed || finer == MOST_REFINEMENTS;
            let Finding { found, is_sure } = examine(runner, &runs, is_last)?;
            if is_sure || is_last {
                return Ok(found);
            }
        }
        finer += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulation::Iteration;

    /// Steps that the ladder runs if steps above `coarsest` fail, and the step that gives the values.
    fn ran(coarsest: f64, fixed: bool, sure_at: f64) -> (Vec<f64>, f64) {
        let mut asked = Vec::new();
        let run = |asked: &mut Vec<f64>, step: f64| {
            asked.push(step);
            let failure = RunError::NotConverged { what: Iteration::ContactRegion, time: 0.0 };
            if step > coarsest { Err(failure) } else { Ok(step) }
        };
        let examine = |_: &mut Vec<f64>, runs: &[f64], _: bool| {
            let found = runs[runs.len() - 1];
            Ok(Finding { found, is_sure: found <= sure_at })
        };
        let values = run_ladder(&mut asked, 1.0, fixed, run, examine).expect("fine steps work");
        (asked, values)
    }

    #[test]
    fn no_step_is_run_twice() {
        for coarsest in [4.0, 2.0, 1.0] {
            for fixed in [false, true] {
                for sure_at in [1.0, 0.5, 1e-9] {
                    let (mut asked, _) = ran(coarsest, fixed, sure_at);
                    let count = asked.len();
                    asked.sort_by(f64::total_cmp);
                    asked.dedup();
                    assert_eq!(asked.len(), count, "{coarsest} {fixed} {sure_at}");
                }
            }
        }
    }

    #[test]
    fn values_come_from_the_step_asked_for_or_from_the_finest() {
        assert_eq!(ran(4.0, true, 1e-9).1, 1.0);
        assert_eq!(ran(1.0, true, 1e-9).1, 1.0, "though its only neighbour is finer");
        assert_eq!(ran(4.0, false, 1.0).1, 1.0);
        assert!(
            (ran(1.0, false, 1.0).1 * step_error::RATIO - 1.0).abs() < 1e-12,
            "no error without a neighbour"
        );
        assert!((ran(4.0, false, 0.0).1 * 64.0 - 1.0).abs() < 1e-12, "the finest step allowed");
    }
}
