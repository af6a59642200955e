//! Bounds of a failure probability that hold at every look while samples come: a confidence sequence.
//!
//! 1. Symbols: n is the number of samples, k the number of failures, p the probability of a failure, and π a distribution over [0, 1].
//! 2. M(p) = ∫ qᵏ (1 − q)ⁿ⁻ᵏ dπ(q) / (pᵏ (1 − p)ⁿ⁻ᵏ). If the samples fail with probability p, M(p) is a martingale with mean 1 as
//!    samples come. It ever exceeds 1/α with a probability of at most α (Ville 1939).
//! 3. So the set of all p with M(p) < 1/α contains the true p at all looks together, with a probability of at least 1 − α.
//! 4. The upper bound takes one π, the lower bound another, each with α = `error`. Both π are mixtures of Beta distributions
//!    ([`Beta`]). For them the integral of line 2 is a quotient of Beta functions. Any π gives bounds that hold; these give close
//!    bounds on both sides of the accepted risk.
//! 5. A bound holds on once it is found: later looks only narrow the interval.

use serde::{Deserialize, Serialize};

use crate::verdict::Verdict;

/// Probability of a wrong bound on one side of a verdict that takes the whole share.
const ERROR: f64 = 0.025;

/// Number of samples between two looks.
const LOOK_EVERY: usize = 5;

/// A Beta distribution within a mixture.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Beta {
    weight: f64,
    a: f64,
    b: f64,
}

/// Bounds of a failure probability, from the samples so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FailureBounds {
    /// Accepted failure probability. The bounds are compared with it.
    pub accepted: f64,
    /// Number of samples.
    pub samples: usize,
    /// Number of samples that failed.
    pub failures: usize,
    /// Number of samples that stayed undecided: passes for the lower bound, failures for the upper bound.
    pub undecided: usize,
    /// Lower and upper bound of the failure probability.
    pub interval: [f64; 2],
    /// Whether the bounds of different looks excluded one another. Then the bounds of the last look stand, and decide nothing.
    is_contradictory: bool,
    /// Probability of a wrong bound on one side, over all looks together.
    error: f64,
    upper_mixture: [Beta; 2],
    lower_mixture: [Beta; 2],
}

/// The share of the error probability that one verdict takes, if several verdicts have to share it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum ErrorShare {
    /// There is no other verdict.
    Whole,
    /// The n-th verdict of a series, n from 1: the share is 1/(n (n + 1)). However many verdicts there are, together they take no
    /// more than the whole.
    Nth(usize),
}

impl ErrorShare {
    /// The whole divided by this share.
    fn parts(self) -> usize {
        match self {
            ErrorShare::Whole => 1,
            ErrorShare::Nth(n) => n * (n + 1),
        }
    }
}

impl FailureBounds {
    /// Bounds before the first sample of a shot. The verdict takes this share of the error probability.
    pub fn new(accepted: f64, share: ErrorShare) -> Self {
        let beta = |weight, a, b| Beta { weight, a, b };
        Self {
            accepted,
            error: ERROR / share.parts() as f64,
            samples: 0,
            failures: 0,
            undecided: 0,
            interval: [0.0, 1.0],
            is_contradictory: false,
            upper_mixture: [beta(0.9, 0.5, 2.0 / accepted), beta(0.1, 0.5, 0.5)],
            lower_mixture: [beta(0.5, 1.0, 1.0), beta(0.5, 0.5, 0.35 / accepted)],
        }
    }

    /// The bounds after the first `counts` samples; `counts` never decrease. This looks at the bounds only at these counts. So all
    /// bounds but the last may be a little wider than the bounds of the judgement.
    pub fn after(&self, samples: impl IntoIterator<Item = Verdict>, counts: &[usize]) -> Vec<[f64; 2]> {
        let mut bounds = Self {
            samples: 0,
            failures: 0,
            undecided: 0,
            interval: [0.0, 1.0],
            is_contradictory: false,
            ..*self
        };
        let mut samples = samples.into_iter();
        let after = |&count: &usize| {
            samples.by_ref().take(count - bounds.samples).for_each(|sample| bounds.count(sample));
            bounds.look();
            if count == self.samples { self.interval } else { bounds.interval }
        };
        counts.iter().map(after).collect()
    }

    fn count(&mut self, sample: Verdict) {
        self.samples += 1;
        self.failures += usize::from(sample == Verdict::Fail);
        self.undecided += usize::from(sample == Verdict::Undecided);
    }

    /// Takes the next sample.
    pub fn push(&mut self, sample: Verdict) {
        self.count(sample);
        if self.samples.is_multiple_of(LOOK_EVERY) {
            self.look();
        }
    }

    /// Narrows the interval by the samples so far.
    fn look(&mut self) {
        let Self {
            samples,
            failures,
            undecided,
            interval: [low, high],
            error,
            upper_mixture,
            lower_mixture,
            ..
        } = *self;
        let most = failures + undecided;
        let now = [
            bound(&lower_mixture, failures, samples, error, 0.0),
            bound(&upper_mixture, most, samples, error, 1.0),
        ];
        let narrowed = [low.max(now[0]), high.min(now[1])];
        self.is_contradictory |= narrowed[0] > narrowed[1];
        self.interval = if self.is_contradictory { now } else { narrowed };
    }

    /// The verdict of the bounds: a pass if surely less than the accepted share of the shots fails, a fail if surely more does.
    pub fn verdict(&self) -> Verdict {
        let [low, high] = self.interval;
        match (high < self.accepted, low > self.accepted) {
            _ if self.is_contradictory => Verdict::Undecided,
            (true, false) => Verdict::Pass,
            (false, true) => Verdict::Fail,
            _ => Verdict::Undecided,
        }
    }

    /// Whether the bounds reach a pass within `most` samples in all if no further sample fails.
    pub fn can_pass(&self, most: usize) -> bool {
        let last_look = most - most % LOOK_EVERY;
        let mut best = Self { samples: last_look.max(self.samples), ..*self };
        best.look();
        best.verdict() == Verdict::Pass
    }

    /// Failures over decided samples; `None` without a decided sample.
    pub fn probability(&self) -> Option<f64> {
        let decided = self.samples - self.undecided;
        (decided > 0).then(|| self.failures as f64 / decided as f64)
    }
}

/// The probability between the share of failures and `end` (0 or 1) at which the martingale reaches 1 / `error`; `end` if it never
/// does.
fn bound(mixture: &[Beta], failures: usize, samples: usize, error: f64, end: f64) -> f64 {
    let (k, n) = (failures as f64, samples as f64);
    let terms = mixture
        .iter()
        .map(|&Beta { weight, a, b }| libm::log(weight) + ln_beta(a + k, b + n - k) - ln_beta(a, b));
    let mean = terms.clone().fold(f64::NEG_INFINITY, f64::max);
    let mean = mean + libm::log(terms.map(|term| libm::exp(term - mean)).sum::<f64>());
    let power = |count: f64, ln: f64| if count == 0.0 { 0.0 } else { count * ln };
    let is_refuted =
        |p: f64| mean - power(k, libm::log(p)) - power(n - k, libm::log1p(-p)) >= -libm::log(error);
    let (mut inside, mut outside) = (k / n, end);
    if !is_refuted(end) {
        return end;
    }
    while (outside - inside).abs() > 1e-6 * inside.max(outside) {
        let middle = 0.5 * (inside + outside);
        if is_refuted(middle) { outside = middle } else { inside = middle }
    }
    outside
}

fn ln_beta(a: f64, b: f64) -> f64 {
    libm::lgamma(a) + libm::lgamma(b) - libm::lgamma(a + b)
}

#[cfg(test)]
mod tests {
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    /// At an accepted risk of 1 %, some 430 samples without a failure pass.
    #[test]
    fn a_pass_is_out_of_reach_with_few_samples_or_many_failures() {
        let new = FailureBounds::new(0.01, ErrorShare::Whole);
        assert!(!new.can_pass(400) && new.can_pass(450));
        let least = (400..450).find(|&most| new.can_pass(most)).expect("a number");
        assert!(least.is_multiple_of(LOOK_EVERY), "nobody looks in between: {least}");
        let mut bounds = new;
        (0..400).for_each(|_| bounds.push(Verdict::Pass));
        let mut reached = Vec::new();
        for _ in 0..20 {
            let mut best = bounds;
            (bounds.samples..2000).for_each(|_| best.push(Verdict::Pass));
            assert_eq!(bounds.can_pass(2000), best.verdict() == Verdict::Pass, "{}", bounds.failures);
            reached.push(bounds.can_pass(2000));
            bounds.push(Verdict::Fail);
        }
        assert!(reached[5] && !reached[15]);
    }

    fn drawn(random: &mut ChaCha8Rng, p: f64) -> Verdict {
        if random.random::<f64>() < p { Verdict::Fail } else { Verdict::Pass }
    }

    /// The bound solves M(p) = 40 of line 2, for 3 failures in 50. Here the integral is a sum of a million terms.
    #[test]
    fn bounds_solve_the_equation_of_the_martingale() {
        let mixture = [Beta { weight: 0.3, a: 1.0, b: 1.0 }, Beta { weight: 0.7, a: 2.0, b: 30.0 }];
        let likelihood = |q: f64| q.powi(3) * (1.0 - q).powi(47);
        // Beta(2, 30) has the density 930 q (1 − q)²⁹.
        let density = |q: f64| 0.3 + 0.7 * 930.0 * q * (1.0 - q).powi(29);
        let middles = (0..1_000_000).map(|n| (f64::from(n) + 0.5) * 1e-6);
        let mean: f64 = middles.map(|q| likelihood(q) * density(q)).sum::<f64>() * 1e-6;
        for end in [0.0, 1.0] {
            let bound = bound(&mixture, 3, 50, 0.025, end);
            assert!((mean / likelihood(bound) / 40.0 - 1.0).abs() < 1e-3, "{bound}");
        }
    }

    /// In 2,000 streams with up to 400 looks each, each bound is wrong in at most 2.5 %, plus four standard errors of that count
    /// (1.4 %). A 95 % interval of fixed sample size, with as many looks, is wrong in some 30 %.
    #[test]
    fn bounds_hold_at_every_look() {
        let mut random = ChaCha8Rng::seed_from_u64(5);
        for (p, accepted) in [(0.01, 0.01), (0.3, 0.01), (0.1, 0.1)] {
            let mut wrong = [0; 2];
            for _ in 0..2000 {
                let mut bounds = FailureBounds::new(accepted, ErrorShare::Whole);
                (0..2000).for_each(|_| bounds.push(drawn(&mut random, p)));
                // The interval only narrows. So its last bounds are wrong if any were.
                let [low, high] = bounds.interval;
                wrong[0] += usize::from(low > p);
                wrong[1] += usize::from(high < p);
            }
            let share = wrong.map(|count| count as f64 / 2000.0);
            assert!(share.iter().all(|&share| share < ERROR + 0.014), "{p}: {share:?}");
            assert!(share.iter().any(|&share| share > 0.0), "a test that can fail: {p}");
        }
    }

    /// Six shots are sampled one after the other. All bounds together are wrong as rarely as the bounds of a single verdict. The
    /// shots here fail just as often as accepted. Without the shares a tenth would be wrong.
    #[test]
    fn candidates_share_the_probability_of_an_error() {
        let mut random = ChaCha8Rng::seed_from_u64(7);
        let mut any_passes = || {
            (1..=6).any(|n| {
                let mut bounds = FailureBounds::new(0.1, ErrorShare::Nth(n));
                (0..1000).for_each(|_| bounds.push(drawn(&mut random, 0.1)));
                bounds.interval[1] < 0.1
            })
        };
        let wrong = (0..1000).filter(|_| any_passes()).count();
        assert!((wrong as f64) < 1000.0 * (ERROR + 0.02), "{wrong}");
    }

    /// Mean number of samples until the bounds decide, over 100 streams: as few as the interface promises.
    #[test]
    fn a_verdict_takes_few_samples_away_from_the_accepted_risk() {
        let mut random = ChaCha8Rng::seed_from_u64(6);
        for (p, verdict, most) in [
            (0.5, Verdict::Fail, 12.0),
            (0.1, Verdict::Fail, 60.0),
            (0.05, Verdict::Fail, 200.0),
            (0.0, Verdict::Pass, 440.0),
        ] {
            let mut samples = 0;
            for _ in 0..100 {
                let mut bounds = FailureBounds::new(0.01, ErrorShare::Whole);
                while bounds.verdict() == Verdict::Undecided {
                    bounds.push(drawn(&mut random, p));
                }
                assert_eq!(bounds.verdict(), verdict, "{p}");
                samples += bounds.samples;
            }
            assert!(samples as f64 / 100.0 <= most, "{p}: {samples}");
        }
    }

    /// Bounds with fewer looks include the bounds of every look. The last bounds are the bounds of the judgement.
    #[test]
    fn bounds_are_told_as_they_narrowed() {
        let mut random = ChaCha8Rng::seed_from_u64(8);
        let drawn: Vec<Verdict> = (0..903).map(|_| drawn(&mut random, 0.02)).collect();
        let (mut bounds, mut judged) = (FailureBounds::new(0.01, ErrorShare::Nth(2)), Vec::new());
        for &sample in &drawn {
            bounds.push(sample);
            judged.push(bounds.interval);
        }
        let counts = [5, 100, 450, 900, 903];
        let told = bounds.after(drawn, &counts);
        assert_eq!(told.last(), Some(&bounds.interval));
        for (&count, [low, high]) in counts.iter().zip(&told) {
            let [judged_low, judged_high] = judged[count - 1];
            assert!(*low <= judged_low + 1e-3 && *high >= judged_high - 1e-3, "{count}: {low} to {high}");
        }
        assert!(told[0][1] > 0.5 && told[4][1] < 0.1, "{told:?}");
    }

    /// With a look at every look of the judgement, the bounds are what they were then: also with undecided samples, and with a
    /// contradiction at the end.
    #[test]
    fn bounds_are_told_as_they_were_at_every_look() {
        let [pass, fail, open] = [Verdict::Pass, Verdict::Fail, Verdict::Undecided];
        let samples = [(pass, 450), (fail, 10), (open, 20), (fail, 200)];
        let samples = samples.into_iter().flat_map(|(verdict, count)| std::iter::repeat_n(verdict, count));
        let (mut bounds, mut judged) = (FailureBounds::new(0.01, ErrorShare::Whole), Vec::new());
        for sample in samples.clone() {
            bounds.push(sample);
            judged.push(bounds.interval);
        }
        assert!(bounds.is_contradictory && judged[449][1] < 0.01);
        let looks: Vec<usize> = (LOOK_EVERY..=bounds.samples).step_by(LOOK_EVERY).collect();
        let at_looks: Vec<[f64; 2]> = looks.iter().map(|&count| judged[count - 1]).collect();
        assert_eq!(bounds.after(samples, &looks), at_looks);
    }

    /// Samples that stop passing contradict the bound found before.
    #[test]
    fn bounds_that_contradict_one_another_decide_nothing() {
        let mut bounds = FailureBounds::new(0.01, ErrorShare::Whole);
        (0..500).for_each(|_| bounds.push(Verdict::Pass));
        assert_eq!(bounds.verdict(), Verdict::Pass);
        (0..200).for_each(|_| bounds.push(Verdict::Fail));
        assert_eq!(bounds.verdict(), Verdict::Undecided, "{:?}", bounds.interval);
    }

    /// The bound of 1,000 samples that pass excludes the share that the next 60 failures show. Both lie far below the accepted risk.
    #[test]
    fn bounds_that_contradict_one_another_below_the_accepted_risk_pass_nothing() {
        let mut bounds = FailureBounds::new(0.5, ErrorShare::Whole);
        (0..1000).for_each(|_| bounds.push(Verdict::Pass));
        assert_eq!(bounds.verdict(), Verdict::Pass);
        let high = bounds.interval[1];
        (0..60).for_each(|_| bounds.push(Verdict::Fail));
        let ([low, high_now], share) = (bounds.interval, 60.0 / 1060.0);
        assert!(high < low && low < share && share < high_now && high_now < 0.5, "{:?}", bounds.interval);
        assert_eq!(bounds.verdict(), Verdict::Undecided);
    }

    /// The shares of a series are 1/2, 1/6, 1/12 …: n of them together are 1 − 1/(n + 1).
    #[test]
    fn shares_of_however_many_verdicts_are_no_more_than_the_whole() {
        assert_eq!(ErrorShare::Whole.parts(), 1);
        let together: f64 = (1..=99).map(|n| 1.0 / ErrorShare::Nth(n).parts() as f64).sum();
        assert!((together - 0.99).abs() < 1e-12, "{together}");
        let mut third = FailureBounds::new(0.01, ErrorShare::Nth(3));
        (0..100).for_each(|_| third.push(Verdict::Pass));
        assert_eq!(third.interval[1], bound(&third.upper_mixture, 0, 100, ERROR / 12.0, 1.0));
    }

    #[test]
    fn undecided_samples_widen_the_interval_to_both_sides() {
        let after = |tenth: Verdict| {
            let mut bounds = FailureBounds::new(0.01, ErrorShare::Whole);
            (0..100).for_each(|n| bounds.push(if n % 10 == 0 { tenth } else { Verdict::Pass }));
            bounds
        };
        let [failed, passed, open] = [Verdict::Fail, Verdict::Pass, Verdict::Undecided].map(after);
        assert_eq!(open.interval, [passed.interval[0], failed.interval[1]]);
        assert_eq!((open.probability(), failed.probability()), (Some(0.0), Some(0.1)));
        let mut few = FailureBounds::new(0.01, ErrorShare::Whole);
        assert_eq!(few.probability(), None);
        for next in [Verdict::Undecided, Verdict::Undecided, Verdict::Fail, Verdict::Pass] {
            few.push(next);
        }
        assert_eq!(few.probability(), Some(0.5));
    }
}
