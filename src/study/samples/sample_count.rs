//! How many samples are drawn, from which seed, and when they suffice.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::failure_bounds::ErrorShare;
use super::influence::SAMPLES_FOR_SHARES;
use super::sampled_shot::{SAMPLES_FOR_BANDS, SampledShot};
use crate::verdict::Verdict;

/// Samples of a round: while few are drawn, and later.
const SHORT_ROUND: usize = 50;
const LONG_ROUND: usize = 100;

/// Greatest number of samples of a confirmation. In most cases it confirms a shot that fails in 0.5 % at an accepted risk of 1 %.
const MOST_OF_CONFIRMATION: usize = 5000;

/// Numbers that keep the draws of one purpose apart from the draws of another.
const SCREENING: u64 = 0x5c7e_e21f_60d1_a3b5;
const CONFIRMATION: u64 = 0xc04f_12a7_93be_0d61;
const ASSUMPTIONS: u64 = 0x91d3_5b0e_7c2a_f846;

/// Number of samples of each shot, and their seed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sampling {
    /// Least number of samples of each shot.
    pub least: usize,
    /// Greatest number of samples of each shot.
    pub most: usize,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Share of the error probability that a verdict takes.
    pub error_share: ErrorShare,
}

impl Sampling {
    /// The sampling of a verdict: enough samples for the shares of the inputs, and more until the verdict is sure.
    pub const OF_VERDICT: Self =
        Self { least: SAMPLES_FOR_SHARES, most: 2000, seed: 1, error_share: ErrorShare::Whole };

    /// The sampling of a study of risk: as many samples as a verdict may take.
    pub const OF_RISK: Self = Self::exactly(Self::OF_VERDICT.most, Self::OF_VERDICT.seed);

    /// Exactly `count` samples of each shot.
    pub const fn exactly(count: usize, seed: u64) -> Self {
        Self { least: count, most: count, seed, error_share: ErrorShare::Whole }
    }

    /// The sampling of a first look at many shots: 100 samples of each, fewer if a shot surely fails too often.
    pub fn first_look(&self) -> Self {
        Self { least: 0, most: SAMPLES_FOR_BANDS.min(self.most), ..*self }
    }

    /// Whether no more samples are needed: the greatest number is drawn, or enough for a
    /// verdict, and enough of them are audited.
    pub fn is_complete(&self, sampled: &SampledShot) -> bool {
        let drawn = sampled.samples.len();
        drawn >= self.most || drawn >= self.least && sampled.verdict_once_audited() != Verdict::Undecided
    }

    /// Numbers of the samples to draw next; empty once the samples are complete.
    pub(super) fn next_round(&self, sampled: &SampledShot) -> Range<usize> {
        let drawn = sampled.samples.len();
        if self.is_complete(sampled) {
            return drawn..drawn;
        }
        let size = if drawn < SAMPLES_FOR_SHARES { SHORT_ROUND } else { LONG_ROUND };
        drawn..(drawn + size).min(self.most)
    }

    /// Draws that choose among many shots, or that a fit learns from. No verdict rests on them.
    pub fn for_screening(&self) -> Self {
        Self { seed: mixed(self.seed ^ SCREENING), error_share: ErrorShare::Whole, ..*self }
    }

    /// Draws that find how far a verdict holds. A search may choose a shot because it fails seldom in
    /// [its draws](Self::for_screening). So the shot is judged by these other draws.
    pub fn for_assumptions(&self) -> Self {
        Self { seed: mixed(self.seed ^ ASSUMPTIONS), error_share: ErrorShare::Whole, ..*self }
    }

    /// Draws for the `n`-th shot that one question confirms, n from 1. Nothing used them before: they follow from the seed alone.
    pub fn for_confirmation(&self, n: usize) -> Self {
        Self {
            least: 0,
            most: self.most.max(MOST_OF_CONFIRMATION),
            seed: mixed(self.seed ^ CONFIRMATION),
            error_share: ErrorShare::Nth(n),
        }
    }

    /// The sampling of a planned shot that fails: only to show by how much.
    pub fn least_only(&self) -> Self {
        Self { most: self.least, ..*self }
    }
}

/// A seed unlike those near it (the finalizer of SplitMix64, Steele, Lea and Flood 2014).
fn mixed(seed: u64) -> u64 {
    let seed = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let seed = (seed ^ (seed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let seed = (seed ^ (seed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    seed ^ (seed >> 31)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::super::random_shot::Input;
    use super::super::sample::{Sample, SampleRun};
    use super::*;
    use crate::plan::PlanSource;
    use crate::study::Case;

    /// The first numbers of SplitMix64 from the seeds 0 and 1, as its authors' program prints them.
    #[test]
    fn seeds_are_mixed_as_published() {
        assert_eq!([mixed(0), mixed(1)], [0xe220_a839_7b1d_cdaf, 0x910a_2dec_8902_5cc1]);
    }

    /// Verdict, screening, assumptions and confirmation each have their own seed, whatever the seed.
    #[test]
    fn no_purpose_uses_the_draws_of_another() {
        let of_seed = |seed: u64| {
            let sampling = Sampling { seed, ..Sampling::OF_VERDICT };
            let all = [
                sampling,
                sampling.for_screening(),
                sampling.for_assumptions(),
                sampling.for_confirmation(1),
            ];
            all.map(|sampling| sampling.seed)
        };
        let seeds: BTreeSet<u64> = (0..1000).flat_map(of_seed).collect();
        assert_eq!(seeds.len(), 4000);
        let third = Sampling { error_share: ErrorShare::Nth(3), ..Sampling::OF_VERDICT };
        assert_eq!(third.for_screening().error_share, ErrorShare::Whole, "no verdict rests on it");
    }

    /// 100 samples of each shot, or as many as are allowed. There is no least number, because a sure failure does not need it.
    #[test]
    fn a_first_look_takes_few_samples() {
        let look = |most: usize| Sampling { most, ..Sampling::OF_VERDICT }.first_look();
        assert_eq!([look(2000).least, look(2000).most, look(60).most], [0, 100, 60]);
    }

    /// Rounds of 50 up to 200 samples, then rounds of 100, until the bounds decide. 500 passes decide. If the planned shot fails,
    /// the least number is enough.
    #[test]
    fn rounds_end_where_the_bounds_tell() {
        let text = include_str!("../../../plans/paper-5-tire.toml").to_owned();
        let source = PlanSource { path: std::path::PathBuf::new(), text };
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
                    uncovering: 0.0,
                    breaks: Verdict::Pass,
                    height: 0.5,
                    force: 1.0,
                    tire: 0,
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
