//! What samples tell, on samples whose values are made up: what an audit changes, what a broken cable hides, which sample decides.

use shelter::plan::Plan;
use shelter::report::words::reasons;
use shelter::study::grounds::Evidence;
use shelter::study::judgement::Judgement;
use shelter::study::reasons::risk::RiskReason;
use shelter::study::samples::failure_bounds::ErrorShare;
use shelter::study::samples::random_shot::Input;
use shelter::study::samples::sample::{Sample, SampleRun};
use shelter::study::samples::sampled_shot::SampledShot;
use shelter::study::{Case, ComputeSettings};
use shelter::verdict::{Quantity, Verdict};

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
        is_uncovered: false,
        breaks: verdict(force > 1.0),
        height: height * case.limits.height,
        force: force.min(most) * case.limits.breaking_force,
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
        assert!(!sampled.is_contradicted(), "{on_overload}");
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
            (Verdict::Undecided, Some(RiskReason::Contradicted))
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
        (sampled.is_contradicted(), sampled.verdict())
    };
    assert_eq!(contradicted(7), (false, Verdict::Fail));
    assert_eq!(contradicted(9), (true, Verdict::Undecided));
}

/// Of 1,000 samples in no order, the value at a risk of 1 % is exceeded by ten.
#[test]
fn the_accepted_share_exceeds_the_value_at_risk() {
    let case = five_tires("report");
    let height = |number: usize| 1e-3 * (number * 389 % 1000) as f64;
    let sampled = sampled(&case, 1000, |number| [run(&case, height(number), 0.1); 2]);
    let value = sampled.value_at_risk(Quantity::Height).expect("enough samples");
    let above = sampled.samples.iter().filter(|sample| sample.run.height > value).count();
    assert_eq!((sampled.bounds.accepted, above), (0.01, 10));
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
