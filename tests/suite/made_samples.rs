//! What samples tell, on samples whose values are made up: what an audit changes, what a broken cable hides, which sample decides.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use shelter::plan::Plan;
use shelter::report::words::reasons;
use shelter::study::judge::Judgement;
use shelter::study::judge::deciding_shot::DecidingSamples;
use shelter::study::judge::grounds::Evidence;
use shelter::study::samples::failure_bounds::ErrorShare;
use shelter::study::samples::influence::input_shares;
use shelter::study::samples::random_shot::Input;
use shelter::study::samples::risk_reason::RiskReason;
use shelter::study::samples::risk_summary::RiskSummary;
use shelter::study::samples::sample::{Sample, SampleRun};
use shelter::study::samples::sampled_shot::SampledShot;
use shelter::study::{Case, ComputeSettings, ShotSummary, ValueWithError};
use shelter::verdict::{PerQuantity, Quantity, Verdict};

use super::support::Edited;

/// The five tires of the source paper, whose limit of force is the breaking force.
fn five_tires(on_overload: &str) -> Case {
    let text = include_str!("../../plans/paper-5-tire.toml");
    let text = text.edited(
        "breaking_force_kn = 20.4",
        &format!("breaking_force_kn = 20.4\non_overload = \"{on_overload}\""),
    );
    Case::new(Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")))
}

/// A run that uses these shares of its limits; where a cable can break and is gone, no force is greater than the breaking force.
fn run(case: &Case, height: f64, force: f64) -> SampleRun {
    let verdict = |fails: bool| if fails { Verdict::Fail } else { Verdict::Pass };
    let most = if case.scene().breaking_force.is_some() { 1.0 } else { f64::INFINITY };
    SampleRun {
        verdict: verdict(height > 1.0 || force > 1.0),
        uncovering: 0.0,
        breaks: verdict(force > 1.0),
        height: height * case.limits.height,
        force: force.min(most) * case.limits.breaking_force,
        tire: 0,
        cable: 0,
        drift: 0.0,
    }
}

/// Samples in order of their numbers; every twentieth has a finer run.
fn sampled(case: &Case, count: usize, runs: impl Fn(usize) -> [SampleRun; 2]) -> SampledShot {
    let mut sampled = SampledShot::new(case, None, ErrorShare::Whole, true);
    for number in 0..count {
        let [run, finer] = runs(number);
        let finer = number.is_multiple_of(20).then_some(finer);
        sampled.push(Sample { number, run, finer, inputs: [1.0; Input::ALL.len()] });
    }
    sampled
}

/// One sample in ten breaks a cable, and the finer runs have forces 0.1 % lower: those that break do so all the same. Where a cable
/// breaks and is gone, its force ends at the breaking force, and 0.998 of that is no pass.
#[test]
fn a_broken_cable_fails_whatever_its_force_was() {
    for on_overload in ["break", "report"] {
        let case = five_tires(on_overload);
        let force = |number: usize| if number % 10 == 5 { 1.4 } else { 0.8 + 1e-5 * number as f64 };
        let sampled =
            sampled(&case, 400, |number| [1.0, 0.999].map(|of| run(&case, 0.5, of * force(number))));
        assert_eq!(sampled.bounds.failures, 40);
        assert!(!sampled.finer_runs_disagree(), "{on_overload}");
        assert_eq!((sampled.verdict(), sampled.reason()), (Verdict::Fail, Some(RiskReason::TooManyFail)));
    }
}

/// Three samples of 3,000 break a cable, which passes at 1 %; that the finer runs have forces 0.1 % lower does not undo the three.
#[test]
fn few_broken_cables_pass_whatever_their_forces_were() {
    let case = five_tires("break");
    let force = |number: usize| if number % 1000 == 5 { 1.4 } else { 0.8 + 1e-6 * number as f64 };
    let sampled = sampled(&case, 3000, |number| [1.0, 0.999].map(|of| run(&case, 0.5, of * force(number))));
    assert_eq!((sampled.bounds.failures, sampled.verdict()), (3, Verdict::Pass));
}

/// Forces of 0.975 of the limit, 1.5 % higher at the finer step, would pass it at twice that: with a cable that breaks and is gone as
/// with one that is only told. Three of the finer runs break, and tell no force that could be compared.
#[test]
fn forces_that_rise_toward_a_break_pass_nothing() {
    for on_overload in ["break", "report"] {
        let case = five_tires(on_overload);
        let sampled = sampled(&case, 1500, |number| {
            let finer = if number % 600 == 20 { 1.3 } else { 0.975 * (1.015 + 1e-6 * number as f64) };
            [0.975, finer].map(|force| run(&case, 0.5, force))
        });
        assert_eq!(sampled.bounds.verdict(), Verdict::Pass);
        assert_eq!(
            (sampled.verdict(), sampled.reason()),
            (Verdict::Undecided, Some(RiskReason::FinerRunsDisagree))
        );
    }
}

/// Of 19 failures 16 are cables that broke, and three fly too high: the reason names all.
#[test]
fn a_reason_counts_cables_that_break() {
    let case = five_tires("break");
    let sampled = sampled(&case, 400, |number| {
        let (height, force) = match number {
            number if number % 25 == 1 => (0.5, 1.2),
            number if number % 130 == 20 => (1.2, 0.5),
            _ => (0.5, 0.5),
        };
        [run(&case, height, force); 2]
    });
    let checked = case.check_as_planned(0, &ComputeSettings::of(&case.plan)).expect("a result");
    let judged = Judgement { sampled: Evidence::of(sampled), ..Judgement::of_planned_alone(checked) };
    let sentences = reasons::sentences(&case, &judged);
    let expected = "19 of 400 sampled shots fail (flight height 3, a cable breaks 16), surely more than the 1 % accepted";
    assert_eq!(sentences, [expected]);
}

/// Nine of twenty samples of the audit that fail no longer do so at the finer step, and the heights of all others rise: neither to
/// one side beyond chance, but verdicts change in one direction only, with a probability of 2/512.
#[test]
fn an_audit_that_changes_verdicts_contradicts_the_samples() {
    let case = five_tires("report");
    let contradicted = |changed: usize| {
        let sampled = sampled(&case, 400, |number| match number / 20 < changed {
            true => [run(&case, 1.2, 0.5), run(&case, 0.9, 0.5)],
            false => [1.2, 1.21 + 1e-5 * number as f64].map(|height| run(&case, height, 0.5)),
        });
        assert_eq!(sampled.bounds.verdict(), Verdict::Fail);
        (sampled.finer_runs_disagree(), sampled.verdict())
    };
    assert_eq!(contradicted(7), (false, Verdict::Fail));
    assert_eq!(contradicted(9), (true, Verdict::Undecided));
}

/// Of 1,000 samples in no order, the value at a risk of 1 % is exceeded by ten.
#[test]
fn the_accepted_share_exceeds_the_deciding_value() {
    let case = five_tires("report");
    let height = |number: usize| 1e-3 * (number * 389 % 1000) as f64;
    let sampled = sampled(&case, 1000, |number| [run(&case, height(number), 0.1); 2]);
    let value = sampled.deciding_value(Quantity::Height).expect("enough samples");
    let above = sampled.samples.iter().filter(|sample| sample.run.height > value).count();
    assert_eq!((sampled.bounds.accepted, above), (0.01, 10));
}

/// A sample of the audit was judged by its finer run, a quarter of the step: the curve drawn is that of the number beside it.
#[test]
fn what_decides_is_drawn_of_the_run_that_was_judged() {
    let case = five_tires("report");
    for (deciding, halvings) in [(40, 2), (41, 0)] {
        let height = |number: usize| if number == deciding { 0.9 } else { 1e-3 * (number % 100) as f64 };
        // The greatest is left out.
        let above = |number: usize| if number == 77 { 0.95 } else { height(number) };
        let sampled = sampled(&case, 100, |number| [run(&case, above(number), 0.1); 2]);
        let drawn = DecidingSamples::of(&sampled, 5).expect("decided samples");
        assert_eq!((drawn.height.number, drawn.height.step_halvings), (deciding, halvings));
        assert_eq!(drawn.of_any, drawn.height);
    }
}

/// Why samples do not pass is found once for those there are, and anew once another comes.
#[test]
fn another_sample_may_change_the_reason() {
    let case = five_tires("report");
    let mut sampled = sampled(&case, 500, |_| [run(&case, 0.5, 0.1); 2]);
    assert_eq!(sampled.reason(), None);
    for number in 500..600 {
        let run = run(&case, 1.5, 0.1);
        sampled.push(Sample { number, run, finer: None, inputs: [1.0; Input::ALL.len()] });
    }
    assert_ne!(sampled.reason(), None);
}

/// Of 1,000 samples at a risk of 1 % the eleventh decides, by its finer run where it has one. A broken cable comes before all that
/// hold, and what is undecided does not judge.
#[test]
fn the_sample_that_decides_is_the_first_that_counts() {
    let case = five_tires("break");
    // Two broken cables, then heights from the greatest down; sample 40 is one of the audit.
    let heights = |number: usize| match number {
        40 => [0.1, 0.9985],
        _ => [1e-3 * (number * 389 % 1000) as f64; 2],
    };
    let sampled = sampled(&case, 1000, |number| match number {
        3 | 7 => [run(&case, 0.01, 1.5); 2],
        9 => [SampleRun::FAILED_RUN; 2],
        _ => heights(number).map(|height| run(&case, height, 0.1)),
    });
    // The greatest is 0.999, then that of the audit: the eleventh in all, behind two broken cables, is 0.992.
    let decides = (0..1000).find(|number| number * 389 % 1000 == 992);
    assert_eq!(sampled.deciding_sample(), decides);
    assert_eq!(SampledShot::new(&case, None, ErrorShare::Whole, true).deciding_sample(), None);
}

/// Runs of this share of the limit of height, of which every `audit_every`-th sample has two alike.
fn heights(
    case: &Case,
    planned: Option<ShotSummary>,
    audit_every: usize,
    runs: impl IntoIterator<Item = SampleRun>,
) -> SampledShot {
    let mut sampled = SampledShot::new(case, planned, ErrorShare::Whole, audit_every > 0);
    for (number, run) in runs.into_iter().enumerate() {
        let finer = (audit_every > 0 && number.is_multiple_of(audit_every)).then_some(run);
        sampled.push(Sample { number, run, finer, inputs: [1.0; Input::ALL.len()] });
    }
    sampled
}

/// What keeps samples from a pass, and nothing where they pass: 600 at half the limit do, where 20 of them are audited or none has to be.
#[test]
fn a_reason_says_what_keeps_samples_from_a_pass() {
    let case = five_tires("report");
    let told = |case: &Case, count: usize, audit_every: usize, open: usize| {
        let half = run(case, 0.5, 0.5);
        let runs =
            (0..count).map(|n| if n % 30 == 7 && n / 30 < open { SampleRun::FAILED_RUN } else { half });
        let sampled = heights(case, None, audit_every, runs);
        (sampled.verdict(), sampled.reason())
    };
    assert_eq!(told(&case, 600, 30, 0), (Verdict::Pass, None), "20 audits");
    assert_eq!(told(&case, 600, 0, 0), (Verdict::Pass, None), "none asked for");
    let open = |reason| (Verdict::Undecided, Some(reason));
    assert_eq!(told(&case, 570, 30, 0), open(RiskReason::FewAudited), "19 audits");
    assert_eq!(told(&case, 300, 10, 0), open(RiskReason::NotSure));
    assert_eq!(told(&case, 600, 20, 20), open(RiskReason::UndecidedSamples));
    let text = include_str!("../../plans/paper-5-tire.toml");
    let text = text.edited("launch_common_percent = 0\n", "launch_common_percent = 50\n");
    let estimated = Case::new(Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")));
    assert_eq!(told(&estimated, 600, 20, 0), open(RiskReason::LaunchEstimated));
    assert_eq!(told(&estimated, 300, 20, 0), open(RiskReason::NotSure));
}

/// Samples reach 0.75 of the limit. A shot as planned that is higher by d speaks against them where 0.75 + 2 d is past the limit, and
/// only against a pass.
#[test]
fn a_shot_as_planned_above_all_samples_speaks_against_their_pass() {
    let mut case = five_tires("report");
    case.limits.height = 1.0;
    let exceeds = |count: usize, greatest: f64, planned: f64| {
        let value = ValueWithError { value: planned, error: 0.0 };
        let mut summary = ShotSummary { verdict: Verdict::Pass, ..ShotSummary::FAILED_RUN };
        let none = ValueWithError::default();
        summary.values = PerQuantity { height: value, force: none, drift: none };
        let runs = (0..count).map(|n| run(&case, if n == 7 { greatest } else { 0.5 }, 0.5));
        let sampled = heights(&case, Some(summary), 20, runs);
        assert_eq!(sampled.finer_runs_disagree(), sampled.planned_exceeds_samples());
        (sampled.planned_exceeds_samples(), sampled.reason())
    };
    let above = (true, Some(RiskReason::PlannedExceedsSamples));
    assert_eq!(exceeds(600, 0.75, 0.9), above);
    for planned in [0.7, 0.8, 0.875] {
        assert_eq!(exceeds(600, 0.75, planned), (false, None), "{planned}");
    }
    assert_eq!(exceeds(300, 0.75, 0.9), (false, Some(RiskReason::NotSure)));
    // One of 3,000 flies as high as the shot as planned, past the limit: that is no more than samples show.
    assert_eq!(exceeds(3000, 1.25, 1.25), (false, None));
    assert_eq!(exceeds(3000, 1.25, 1.5), above);
}

/// Of heights of 1 % to 100 % of the limit all but the accepted share of 5 % use at most 95 % of it; without a sample nothing is known to
/// be used, and where each cable breaks no number tells how much.
#[test]
fn a_summary_tells_how_much_of_a_limit_all_but_the_accepted_share_use() {
    let mut case = five_tires("report");
    case.limits.accepted_risk = 0.05;
    let used = |count: usize| {
        let runs = (1..=count).map(|n| run(&case, 1e-2 * n as f64, 0.005));
        heights(&case, None, 0, runs)
    };
    let most_used = |count: usize| RiskSummary::of(&used(count)).utilization;
    assert!((most_used(100) - 0.95).abs() < 1e-12);
    assert_eq!(most_used(0), f64::INFINITY);
    // What is undecided may use any share.
    let with_undecided = |count: usize| {
        let mut sampled = used(100 - count);
        for number in 100 - count..100 {
            let inputs = [1.0; Input::ALL.len()];
            sampled.push(Sample { number, run: SampleRun::FAILED_RUN, finer: None, inputs });
        }
        RiskSummary::of(&sampled).utilization
    };
    assert!((with_undecided(3) - 0.95).abs() < 1e-12);
    assert_eq!(with_undecided(6), f64::INFINITY);
    let breaks = five_tires("break");
    let broken = heights(&breaks, None, 0, (0..10).map(|_| run(&breaks, 0.5, 1.5)));
    assert_eq!(RiskSummary::of(&broken).utilization, f64::INFINITY);
    let band = used(100).band(Quantity::Height).expect("enough samples");
    let expected = [0.05, 0.5, 0.95, 1.0].map(|share| share * case.limits.height);
    assert!(band.iter().zip(expected).all(|(value, expected)| (value - expected).abs() < 1e-12), "{band:?}");
    assert_eq!(used(99).band(Quantity::Height), None);
}

/// All samples fail by half a percent. That finer runs are 0.3 % lower changes none of them, but twice that passes all; twice 0.1 % does
/// not.
#[test]
fn an_error_to_one_side_that_would_pass_what_fails_leaves_it_open() {
    let case = five_tires("report");
    let told = |lower: f64| {
        let sampled = sampled(&case, 400, |number| {
            [1.005, 1.005 * (1.0 - lower * (1.0 + 1e-4 * number as f64))]
                .map(|height| run(&case, height, 0.5))
        });
        assert_eq!(sampled.bounds.failures, 400);
        (sampled.finer_runs_disagree(), sampled.verdict())
    };
    assert_eq!(told(0.003), (true, Verdict::Undecided));
    assert_eq!(told(0.001), (false, Verdict::Fail));
}

/// Of 600 samples some fail at the usual step, and none at the finer one. Up to the accepted 1 % they are let pass; beyond that nobody
/// knows of the samples that were not audited.
#[test]
fn more_failures_than_accepted_before_the_audit_leave_a_pass_open() {
    let case = five_tires("report");
    let told = |changed: usize| {
        let sampled = sampled(&case, 600, |number| {
            let first = if number % 20 == 0 && number / 20 < changed { 1.2 } else { 0.5 };
            [first, 0.5].map(|height| run(&case, height, 0.5))
        });
        assert_eq!((sampled.bounds.failures, sampled.bounds.verdict()), (0, Verdict::Pass));
        (sampled.finer_runs_disagree(), sampled.verdict())
    };
    assert_eq!(told(6), (false, Verdict::Pass));
    assert_eq!(told(7), (true, Verdict::Undecided));
}

/// A value that is the limit itself passes; where the finer runs are the same, no sample is moved past it.
#[test]
fn samples_at_the_limit_itself_pass() {
    let mut case = five_tires("report");
    case.limits.height = 1.0;
    let sampled = heights(&case, None, 20, (0..600).map(|_| run(&case, 1.0, 0.5)));
    assert_eq!((sampled.finer_runs_disagree(), sampled.verdict()), (false, Verdict::Pass));
}

/// A sample is decided where all of its runs are. Of four that are, two pull hardest at cable 2, one at cable 0, and one pulls at none.
#[test]
fn cables_count_by_the_decided_samples_in_which_they_are_pulled_hardest() {
    let case = five_tires("report");
    let pulled = |cable: usize, force: f64| SampleRun { cable, force, ..run(&case, 0.5, 0.5) };
    let runs = [pulled(2, 3e3), pulled(0, 7e3), pulled(2, 5e3), pulled(1, 0.0)];
    let mut sampled = heights(&case, None, 0, runs);
    let open = Sample {
        number: 4,
        run: pulled(1, 9e3),
        finer: Some(SampleRun::FAILED_RUN),
        inputs: [1.0; Input::ALL.len()],
    };
    sampled.push(open);
    sampled.push(Sample { number: 5, run: SampleRun::FAILED_RUN, finer: Some(pulled(1, 9e3)), ..open });
    assert_eq!(sampled.decided().count(), 4);
    assert_eq!(sampled.hardest_pulled_cables(), [(2, 0.5), (0, 0.25)]);
    assert_eq!(sampled.deciding_cables(), None, "too few samples");
}

/// Of 200 samples 1 % are left out: the two that pull hardest, in a cable that would be the first. The force at risk is that of the third.
#[test]
fn the_cable_to_strengthen_is_that_of_the_deciding_force() {
    let case = five_tires("report");
    let pulled = |cable: usize, force: f64| SampleRun { cable, force, ..run(&case, 0.5, 0.5) };
    let hardest = [pulled(3, 9e3), pulled(3, 8e3), pulled(2, 7e3), pulled(2, 6e3), pulled(1, 5e3)];
    let mild = (0..195).map(|n| pulled(0, 1e3 + f64::from(n)));
    let sampled = heights(&case, None, 0, hardest.into_iter().chain(mild));
    assert_eq!(sampled.deciding_value(Quantity::Force), Some(7e3));
    assert_eq!(sampled.deciding_cables(), Some(vec![(2, 7e3), (1, 5e3), (0, 1194.0)]));
}

/// Heights of 3 a + 2 b + 2 c, with a the launch of all and b, c the slopes along x and y: of 17 parts of the variance the launch
/// explains 9, the slope 8. Forces follow the friction, further below their limit. Within three standard errors of 2,000 draws (0.05).
#[test]
fn what_decides_is_told_of_the_quantity_nearest_its_limit() {
    let mut case = five_tires("report");
    case.limits.height = 10.0;
    let shares = |count: usize| {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let mut sampled = SampledShot::new(&case, None, ErrorShare::Whole, false);
        for number in 0..count {
            let [a, b, c, d]: [f64; 4] = random.random();
            let mut inputs = [1.0; Input::ALL.len()];
            for (n, input) in Input::ALL.into_iter().enumerate() {
                inputs[n] = match input {
                    Input::LaunchCommon => a,
                    Input::CommonSlopeX => b,
                    Input::CommonSlopeY => c,
                    Input::Friction => d,
                    _ => 1.0,
                };
            }
            let height = 2.5 + 3.0 * a + 2.0 * b + 2.0 * c;
            let run =
                SampleRun { height, force: (0.1 + 0.4 * d) * case.limits.force, ..run(&case, 0.0, 0.0) };
            sampled.push(Sample { number, run, finer: None, inputs });
        }
        input_shares(&sampled, &case.limits)
    };
    let all = shares(2000).expect("enough samples");
    let [first, second] = [all[0], all[1]];
    assert_eq!((first.0, second.0), (Input::LaunchCommon, Input::CommonSlopeX), "{all:?}");
    assert!((first.1 - 9.0 / 17.0).abs() < 0.05 && (second.1 - 8.0 / 17.0).abs() < 0.05, "{all:?}");
    assert!(all[2..].iter().all(|(_, share)| *share < 0.05), "{all:?}");
    assert!(shares(199).is_none() && shares(200).is_some() && shares(201).is_some());
}

/// The launch decides the height, the friction the force, the slack the drift: of these the one that comes nearest its limit is told.
#[test]
fn the_quantity_nearest_its_limit_is_found_among_all() {
    let mut case = five_tires("report");
    case.limits.height = 10.0;
    case.limits.drift = Some(4.0);
    for used in [[9, 7, 5], [9, 5, 7], [7, 9, 5], [5, 9, 7], [7, 5, 9], [5, 7, 9]] {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let mut sampled = SampledShot::new(&case, None, ErrorShare::Whole, false);
        for number in 0..250 {
            let drawn: [f64; 3] = random.random();
            let mut inputs = [1.0; Input::ALL.len()];
            inputs[..3].copy_from_slice(&drawn);
            let limits = [10.0, case.limits.force, 4.0];
            let [height, force, drift] =
                [0, 1, 2].map(|n| 0.1 * f64::from(used[n]) * limits[n] * (0.9 + 0.1 * drawn[n]));
            let run = SampleRun { height, force, drift, ..run(&case, 0.0, 0.0) };
            sampled.push(Sample { number, run, finer: None, inputs });
        }
        let decides = input_shares(&sampled, &case.limits).expect("enough samples")[0].0;
        let nearest = used.iter().position(|&tenths| tenths == 9).expect("one of them");
        assert_eq!(decides, [Input::LaunchCommon, Input::Friction, Input::Slack][nearest], "{used:?}");
    }
}
