//! The shot that decides an option: the sample that only the accepted share of all samples exceeds, run once more for its course.

use crate::outcome::History;
use crate::scene::Shot;
use crate::study::samples::sampled_shot::SampledShot;
use crate::study::trace::{DrawnSample, TracedShot};
use crate::study::{Context, NoResult};

/// The shot that decides an option.
#[derive(Clone, Debug, PartialEq)]
pub struct DecidingShot {
    /// Which sample it is.
    pub sample: DrawnSample,
    /// What fires when.
    pub shot: Shot,
    /// Height and force over time.
    pub history: History,
}

impl DecidingShot {
    /// Runs a sample of an option.
    ///
    /// # Panics
    ///
    /// Where the plan has no delay option with the index `option`.
    pub fn run(context: &Context<'_>, option: usize, sample: DrawnSample) -> Result<Self, NoResult> {
        let &Context { case, compute, control, .. } = context;
        let traced = TracedShot::new(case, option, &compute, Some(sample));
        let outcome = traced.run(&mut |_| control.keep_going());
        let history = outcome.map_err(|failure| control.no_result(failure))?.history;
        Ok(Self { sample, shot: traced.shot().clone(), history })
    }
}

/// Which of the samples drawn with `seed` decides; `None` where none is decided.
pub fn deciding_sample(sampled: &SampledShot, seed: u64) -> Option<DrawnSample> {
    let number = sampled.deciding_sample()?;
    Some(DrawnSample { seed, number, step_halvings: sampled.step_halvings })
}
