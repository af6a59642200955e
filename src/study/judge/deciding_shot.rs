//! The shots that decide an option: only the accepted share of all samples is worse. Each deciding shot runs once more, to record height
//! and force over time.

use crate::outcome::History;
use crate::scene::Shot;
use crate::study::samples::run_sample::AUDIT_HALVINGS;
use crate::study::samples::sampled_shot::SampledShot;
use crate::study::trace::{DrawnSample, TracedShot};
use crate::study::{Context, NoResult};
use crate::verdict::Quantity;

/// A sample that is run once more.
#[derive(Clone, Debug, PartialEq)]
pub struct DecidingShot {
    /// The sample.
    pub sample: DrawnSample,
    /// The shot with its firing times.
    pub shot: Shot,
    /// Height and force over time.
    pub history: History,
}

impl DecidingShot {
    /// Runs a sample of an option.
    ///
    /// # Panics
    ///
    /// If the plan has no delay option with the index `option`.
    pub fn run(context: &Context<'_>, option: usize, sample: DrawnSample) -> Result<Self, NoResult> {
        let &Context { case, compute, control, .. } = context;
        let traced = TracedShot::new(case, option, &compute, Some(sample));
        let outcome = traced.run(&mut |_| control.keep_going());
        let history = outcome.map_err(|failure| control.no_result(failure))?.history;
        Ok(Self { sample, shot: traced.shot().clone(), history })
    }
}

/// The samples that decide an option: only the accepted share of all samples is worse.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DecidingSamples {
    /// Decides by its use of any limit.
    pub of_any: DrawnSample,
    /// Decides by its height alone.
    pub height: DrawnSample,
    /// Decides by its cable force alone.
    pub force: DrawnSample,
}

impl DecidingSamples {
    /// The deciding samples among those drawn with `seed`; `None` if too few samples are decided.
    pub fn of(sampled: &SampledShot, seed: u64) -> Option<Self> {
        sampled.deciding_value(Quantity::Height)?;
        // Run it as it was judged: an audited sample at its finer step.
        let drawn = |number| {
            let is_audited =
                sampled.samples.iter().any(|sample| sample.number == number && sample.finer.is_some());
            let finer = if is_audited { AUDIT_HALVINGS } else { 0 };
            DrawnSample { seed, number, step_halvings: sampled.step_halvings + finer }
        };
        let deciding_by = |quantity| sampled.deciding_sample_by(quantity).map(drawn);
        Some(Self {
            of_any: drawn(sampled.deciding_sample()?),
            height: deciding_by(Quantity::Height)?,
            force: deciding_by(Quantity::Force)?,
        })
    }
}

/// The two shots that decide an option, by height and by force. They may differ: the worst shot by height may pull far less than the other.
#[derive(Clone, Debug, PartialEq)]
pub struct DecidingShots {
    /// The deciding samples.
    pub samples: DecidingSamples,
    /// The shot that decides by its height.
    pub height: DecidingShot,
    /// The shot that decides by its force; often the same.
    pub force: DecidingShot,
}

impl DecidingShots {
    /// Runs the samples of an option that decide by height and by force.
    ///
    /// # Panics
    ///
    /// If the plan has no delay option with the index `option`.
    pub fn run(context: &Context<'_>, option: usize, samples: DecidingSamples) -> Result<Self, NoResult> {
        let height = DecidingShot::run(context, option, samples.height)?;
        let force = match samples.force == samples.height {
            true => height.clone(),
            false => DecidingShot::run(context, option, samples.force)?,
        };
        Ok(Self { samples, height, force })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::judge::brief_judgement::tests::case as two_tires;
    use crate::study::standing::tests::{case, passing};
    use crate::study::{ComputeSettings, StudyControl};

    /// If no sample is left out, the worst one decides, as it was judged: an audited sample by its finer run. Of few samples, none decides.
    #[test]
    fn the_worst_samples_decide_each_at_the_step_at_which_it_was_judged() {
        let few = passing(&case(), 50).sampled.known().expect("samples").clone();
        assert_eq!(DecidingSamples::of(&few, 3), None);
        let mut sampled = passing(&case(), 100).sampled.known().expect("samples").clone();
        sampled.bounds.accepted = 1e-3;
        sampled.step_halvings = 1;
        sampled.samples[7].run.height = 1.9;
        sampled.samples[7].finer = Some(sampled.samples[7].run);
        sampled.samples[9].run.force = 5.0;
        let drawn = |number, step_halvings| DrawnSample { seed: 3, number, step_halvings };
        let (highest, hardest) = (drawn(7, 1 + AUDIT_HALVINGS), drawn(9, 1));
        let expected = DecidingSamples { of_any: highest, height: highest, force: hardest };
        assert_eq!(DecidingSamples::of(&sampled, 3), Some(expected));
    }

    #[test]
    fn the_shots_that_decide_are_those_of_their_samples() {
        let (case, control) = (two_tires("", false), StudyControl::default());
        let context = Context::new(&case, ComputeSettings::of(&case.plan), &control);
        let drawn = |number| DrawnSample { seed: 3, number, step_halvings: 0 };
        for (height, force) in [(0, 0), (0, 1)] {
            let samples = DecidingSamples { of_any: drawn(0), height: drawn(height), force: drawn(force) };
            let found = DecidingShots::run(&context, 0, samples).expect("a result");
            assert_eq!([found.height.sample, found.force.sample], [drawn(height), drawn(force)]);
        }
    }
}
