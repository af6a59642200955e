//! Does one calm shot make a PASS? The five tires of the source paper, fitted to one shot each, and judged as `fit --write` leaves them.
//!
//! What is true of a plan's launches is drawn: a factor in common of 5 %, which the plan states, and one for every shot of 5 %, of
//! which it says nothing. Six observations are made of one shot. The limit of height lies between what the next shots often reach and
//! what they never do, by samples of the truth, which also tell how often they fail.

use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use rand_distr::{Distribution, StandardNormal};
use shelter::choice::Unknown;
use shelter::plan::observations::Observations;
use shelter::plan::{PlanSource, write_fit};
use shelter::study::fit::observation_bands::predict_observations;
use shelter::study::fit::observed_shots::ObservedShots;
use shelter::study::fit::{FitResult, fit, observable_names};
use shelter::study::samples::random_shot::draw_shot;
use shelter::study::samples::run_sample::ShotToSample;
use shelter::study::samples::sample_until_sure::sample_shots;
use shelter::study::{Case, ComputeSettings, Context, StudyControl};
use shelter::verdict::Verdict;
use shelter::{Model, Sampling};

const UNCERTAINTY: &str = "[uncertainty]\nlaunch_cv_percent = 2\nlaunch_common_percent = 5\nlaunch_tilt_deg = 1\n\
    friction = [0.45, 0.55]\nslack_percent = [0.5, 1.5]\ntire_mass_cv_percent = 3\n";

/// What is seen of a shot, each with its standard deviation.
const SEEN: [(&str, f64); 6] = [
    ("1.5:1.5,,flight_height_m", 0.03),
    ("1.5:1.5,,landing_s", 0.02),
    ("1:1,,drift_m", 0.05),
    ("2:2,,drift_m", 0.05),
    (",1:1-1.5:1.5,cable_force_n", 1000.0),
    (",1.5:1.5-2:2,cable_force_n", 1000.0),
];

/// Samples of the truth behind a plan.
const TRUTH: usize = 2000;

fn parsed(text: String) -> Case {
    Case::parse(PlanSource { path: "plan.toml".into(), text }).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

/// Fits `count` shots, and prints how many intervals miss the truth and how many PASSes are wrong.
pub fn compare(count: u64) {
    let (mut missed, mut passed, mut wrong, mut refused) = (0, 0, 0, 0);
    for seed in 0..count {
        match try_one(seed) {
            None => refused += 1,
            Some(Tried { holds, passes, risk }) => {
                missed += usize::from(!holds);
                passed += usize::from(passes);
                wrong += usize::from(passes && risk > 0.01);
            }
        }
    }
    println!(
        "{count} fits, {refused} without an estimate: {missed} intervals missed, {wrong} of {passed} PASSes wrong"
    );
}

struct Tried {
    /// Whether the 95 % interval holds the truth.
    holds: bool,
    /// Whether the plan passes as the fit leaves it.
    passes: bool,
    /// Failure probability of the next shots.
    risk: f64,
}

fn try_one(seed: u64) -> Option<Tried> {
    let random = &mut StdRng::seed_from_u64(seed);
    let mut factor = || {
        let (variance, normal): (f64, f64) = (0.05_f64.powi(2).ln_1p(), StandardNormal.sample(random));
        (variance.sqrt() * normal - 0.5 * variance).exp()
    };
    let (common, of_shot) = (factor(), factor());
    let room = random.random_range(0.8..3.5);
    let text = include_str!("../../plans/paper-5-tire.toml");
    let plan = |limit: f64| {
        let line = text.lines().map(|line| match line.starts_with("flight_height_m") {
            true => format!("flight_height_m = {limit}\n"),
            false => format!("{line}\n")
                .replace("duration_s = 1.0", "")
                .replace("breaking_force_kn = ", "slack_percent = 1\nbreaking_force_kn = 9"),
        });
        parsed(line.collect::<String>() + UNCERTAINTY)
    };
    let (compute, control) = (ComputeSettings::of(&plan(9.0).plan), StudyControl::default());
    // What is true: launches by the factor in common, and shots that differ.
    let mut truth = plan(9.0).plan;
    truth.launches_mut().for_each(|launch| launch.speed_m_s *= common);
    (truth.uncertainty.launch_common_percent, truth.uncertainty.launch_between_shots_percent) = (0.0, 5.0);
    let truth = Case::new(truth);
    let target = ShotToSample::new(&truth, &truth.shots[0], compute, Sampling::exactly(TRUTH, !seed));
    let sampled = sample_shots(&[target], &control).expect("samples").value.remove(0);
    let mut heights: Vec<f64> = sampled.samples.iter().map(|sample| sample.run.height).collect();
    heights.sort_by(f64::total_cmp);
    let [median, often] = [TRUTH / 2, TRUTH - TRUTH / 20].map(|n| heights[n]);
    let limit = median + room * (often - median);
    let risk = heights.iter().filter(|height| **height > limit).count() as f64 / TRUTH as f64;
    // The shot that is seen is another of the truth, whose factor is known.
    let mut seen = truth.clone();
    seen.plan.uncertainty.launch_between_shots_percent = 0.0;
    let shot = draw_shot(&seen, &truth.shots[0].with_launches(of_shot), seed, 0);
    (seen.model, seen.shots) = (Model::new(shot.scene), vec![shot.shot.later_by(-shot.later)]);
    let case = plan(limit);
    let read = |values: &dyn Fn(usize) -> f64| {
        let line = |(n, (what, sd)): (usize, &(&str, f64))| format!("{what},{},{sd}\n", values(n));
        let lines: String = SEEN.iter().enumerate().map(line).collect();
        let read = Observations::parse(
            "seen.csv",
            &format!("tire,cable,quantity,value,sd\n{lines}"),
            &observable_names(&case),
        );
        read.unwrap_or_else(|mistakes| panic!("{mistakes}"))
    };
    let blank = ObservedShots::new(&[read(&|_| 1.0)]);
    let shown = predict_observations(&Context::new(&seen, compute, &control), &blank).expect("a run");
    let noise: Vec<f64> = SEEN.iter().map(|(_, sd)| sd * random.sample::<f64, _>(StandardNormal)).collect();
    let files = [read(&|n| (shown[n].planned + noise[n]).max(0.0))];
    let context = Context::new(&case, compute, &control).with_sampling(Sampling::exactly(1, 1));
    let FitResult::Fitted(fit) = fit(&context, &files, &[Unknown::Launch]).expect("a result") else {
        return None;
    };
    if fit.answers.len() > 1 || !fit.answers[0].explains() {
        return None;
    }
    let estimate = &fit.answers[0].estimates[0];
    let written = write_fit::write(&case.source.text, &case.plan, &fit.to_write(), &[]);
    let written = parsed(written.expect("a plan"));
    let judged = Context::new(&written, compute, &control)
        .with_sampling(Sampling::OF_VERDICT)
        .judge_options()
        .expect("a result")
        .value;
    Some(Tried {
        holds: (estimate.value - common).abs() <= 1.96 * estimate.sd,
        passes: judged[0].as_ref().expect("a result").verdict() == Verdict::Pass,
        risk,
    })
}
