//! How many samples are drawn, from which seed, and when they suffice.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::failure_bounds::ErrorShare;
use super::influence::SAMPLES_FOR_SHARES;
use super::sampled_shot::{SAMPLES_FOR_BANDS, SampledShot};
use crate::verdict::Verdict;

/// Samples of a round, while few are drawn and later.
const SHORT_ROUND: usize = 50;
const LONG_ROUND: usize = 100;

/// Number of samples of each shot, and their seed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sampling {
    /// Least number of samples of each shot.
    pub least: usize,
    /// Greatest number of samples of each shot.
    pub most: usize,
    /// Seed of the random numbers.
    pub seed: u64,
    /// The share of the probability of an error that a verdict takes.
    pub error_share: ErrorShare,
}

impl Sampling {
    /// The sampling of a verdict: enough for the shares of the inputs, and more until the verdict is sure.
    pub const OF_VERDICT: Self =
        Self { least: SAMPLES_FOR_SHARES, most: 2000, seed: 1, error_share: ErrorShare::Whole };

    /// The sampling of a study of risk: as many samples as a verdict may take.
    pub const OF_RISK: Self = Self::exactly(Self::OF_VERDICT.most, Self::OF_VERDICT.seed);

    /// Exactly `count` samples of each shot.
    pub const fn exactly(count: usize, seed: u64) -> Self {
        Self { least: count, most: count, seed, error_share: ErrorShare::Whole }
    }

    /// Samples of a first look at many shots: 100 of each, fewer of those that surely fail too often.
    pub fn first_look(&self) -> Self {
        Self { least: 0, most: SAMPLES_FOR_BANDS.min(self.most), ..*self }
    }

    /// Whether no more samples are needed: there are as many as there may be, or enough for a verdict that the audit bears out.
    pub fn is_complete(&self, sampled: &SampledShot) -> bool {
        let drawn = sampled.samples.len();
        drawn >= self.most || drawn >= self.least && sampled.verdict_once_audited() != Verdict::Undecided
    }

    /// Numbers of the samples to draw next; none once they are complete.
    pub(super) fn next_round(&self, sampled: &SampledShot) -> Range<usize> {
        let drawn = sampled.samples.len();
        if self.is_complete(sampled) {
            return drawn..drawn;
        }
        let size = if drawn < SAMPLES_FOR_SHARES { SHORT_ROUND } else { LONG_ROUND };
        drawn..(drawn + size).min(self.most)
    }

    /// The same sampling with other draws: a choice and the verdict on what was chosen must not share theirs.
    pub fn with_fresh_draws(&self, error_share: ErrorShare) -> Self {
        Self { seed: !self.seed, error_share, ..*self }
    }

    /// The sampling of a shot that fails as planned: only to show by how much.
    pub fn least_only(&self) -> Self {
        Self { most: self.least, ..*self }
    }
}

#[cfg(test)]
mod tests {
    use super::super::random_shot::Input;
    use super::super::sample::{Sample, SampleRun};
    use super::*;
    use crate::plan::PlanSource;
    use crate::study::Case;

    /// Rounds of 50 up to 200 samples, then of 100, until the bounds tell: 500 passes do, and so does the least number where a
    /// shot fails as planned.
    #[test]
    fn rounds_end_where_the_bounds_tell() {
        let text = include_str!("../../../plans/paper-5-tire.toml").to_owned();
        let source = PlanSource { path: String::new(), text };
        let case = Case::parse(source).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let mut sampled = SampledShot::new(&case, None, ErrorShare::Whole, false);
        let (mut sizes, sampling) = (Vec::new(), Sampling::OF_VERDICT);
        loop {
            let round = sampling.next_round(&sampled);
            if round.is_empty() {
                break;
            }
            sizes.push(round.len());
            for number in round {
                let run = SampleRun {
                    verdict: Verdict::Pass,
                    breaks: Verdict::Pass,
                    height: 0.5,
                    force: 1.0,
                    cable: 0,
                    drift: 0.0,
                };
                sampled.push(Sample { number, run, finer: None, inputs: [1.0; Input::ALL.len()] });
            }
            let has_least = sampled.samples.len() >= sampling.least;
            assert_eq!(sampling.least_only().next_round(&sampled).is_empty(), has_least);
        }
        assert_eq!(sizes, [50, 50, 50, 50, 100, 100, 100]);
    }
}
