//! Verdicts on the shots that `[uncertainty]` describes: draws, variants, and probabilities known in closed form.

use std::collections::HashMap;
use std::ops::ControlFlow;

use shelter::choice::{Accuracy, Method};
use shelter::outcome::{History, Outcome};
use shelter::plan::{DelayScatter, Plan, Uncertainty};
use shelter::scene::{Scene, Shot};
use shelter::simulation::{Model, RunSettings};
use shelter::study::as_planned::check_many::check_summary;
use shelter::study::as_planned::margin::{LaunchMargin, launch_margin};
use shelter::study::judge::Judgement;
use shelter::study::judge::batch::{Depth, judge};
use shelter::study::judge::deciding_shot::{DecidingShot, DecidingShots};
use shelter::study::question::{Asked, Question};
use shelter::study::results_file::{self, Head};
use shelter::study::samples::influence::input_shares;
use shelter::study::samples::random_shot::{DrawnShot, draw_shot};
use shelter::study::samples::risk_summary::sample_shots_in_brief;
use shelter::study::samples::run_sample::ShotToSample;
use shelter::study::samples::sample_count::Sampling;
use shelter::study::samples::sample_until_sure::{run_shard, sample_shots};
use shelter::study::samples::sampled_shot::SampledShot;
use shelter::study::trace::{DrawnSample, TracedItems, TracedShot, trace};
use shelter::study::{
    Case, ComputeSettings, Context, Journal, Shard, ShotSummary, StudyControl, risk, thread_pool,
};
use shelter::verdict::{Quantity, Verdict};

use crate::support::AS_DRAWN;
use crate::support::scenes::{GRAVITY, METHODS, fire, tie, tires};

/// A lone tire launched with 6 m/s, whose limit of height is `height` [m]; nothing but its launch velocity is unknown.
fn lone(height: f64, launch_cv_percent: f64) -> Case {
    let text = format!(
        r#"
shelter = {{ layout = "grid", rows = 1, columns = 1, spacing_m = 1.5 }}
tire = {{ mass_kg = 280 }}
cable = {{ axial_stiffness_kn = 1400, breaking_force_kn = 60 }}
ground = {{ friction = 0.5 }}
blast_row = [{{ name = "1", under_row = 1, launch_m_s = 6 }}]
limits = {{ flight_height_m = {height}, cable_safety_factor = 1 }}
delay = [{{ name = "1", interval_ms = 0 }}]
simulation = {{ accuracy = "draft" }}
[uncertainty]
launch_cv_percent = {launch_cv_percent}
launch_common_percent = 0
launch_between_shots_percent = 0
tire_mass_cv_percent = 0
{AS_DRAWN}"#
    );
    Case::new(Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")))
}

/// Three rows under 5 × 6 tires with some slack, from rim to rim.
fn rows(more: &str) -> Case {
    let text = format!(
        r#"
shelter = {{ layout = "grid", rows = 5, columns = 6, spacing_m = 2.6 }}
tire = {{ mass_kg = 280, outer_diameter_m = 1.6 }}
ground = {{ friction = 0.5 }}
limits = {{ flight_height_m = 1.8, cable_safety_factor = 1.5 }}
blast_row = [{{ name = "1", under_row = 2, launch_m_s = 5 }}, {{ name = "2", under_row = 4, launch_m_s = 6 }}]
delay = [{{ name = "20", interval_ms = 20 }}, {{ name = "60", interval_ms = 60 }}]
{more}
"#
    );
    let cable = "cable = { axial_stiffness_kn = 3000, breaking_force_kn = 90, slack_percent = 2 }\n";
    let text = if more.contains("cable = ") { text } else { cable.to_owned() + &text };
    Case::new(Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")))
}

fn risk_of(case: &Case, sampling: &Sampling) -> SampledShot {
    let (shot, compute) = (&case.shots[0], ComputeSettings::of(&case.plan));
    let target = ShotToSample::new(case, shot, compute, *sampling);
    let found = sample_shots(&[target], &StudyControl::default());
    found.expect("a result").value.remove(0)
}

/// Samples that end in the air show neither that they pass nor that they fail.
#[test]
fn samples_that_end_early_bound_nothing() {
    let mut case = lone(5.0, 5.0);
    case.plan.simulation.duration_s = Some(0.3);
    let risk = risk_of(&case, &Sampling::exactly(300, 1));
    assert_eq!((risk.bounds.undecided, risk.bounds.interval), (300, [0.0, 1.0]));
    assert_eq!((risk.breaks.undecided, risk.breaks.interval), (300, [0.0, 1.0]));
    assert_eq!((risk.verdict(), risk.deciding_sample()), (Verdict::Undecided, None));
    // Those that are past the limit by then fail all the same.
    case.limits.height = 1.0;
    assert_eq!(risk_of(&case, &Sampling::exactly(300, 1)).verdict(), Verdict::Fail);
}

/// The deciding sample, traced, is the run that was judged: the same greatest height and force to the last digit. Another seed draws
/// another.
#[test]
fn the_deciding_sample_traced_is_the_sample_that_was_judged() {
    let case = rows("[uncertainty]\ndelay_sd_ms = 3\nin_hole_delay_ms = 500\n");
    let risk = risk_of(&case, &Sampling::exactly(300, 5));
    let number = risk.deciding_sample().expect("decided samples");
    let judged = risk.samples[number].run;
    let compute = ComputeSettings::of(&case.plan);
    let greatest = |seed: u64, compute: &ComputeSettings| {
        let sample = DrawnSample { seed, number, step_halvings: 0 };
        let shot = TracedShot::new(&case, 0, compute, Some(sample));
        let all = TracedItems { tires: Vec::new(), cables: (0..case.scene().cables.len()).collect() };
        let mut pulled = 0.0_f64;
        let traced = trace(&shot, &all, shot.settings.step, &mut |row| {
            pulled = row[1..].iter().copied().fold(pulled, f64::max);
            ControlFlow::Continue(())
        });
        let outcome = traced.expect("an outcome");
        // Between two rows a force is greatest by what a parabola adds.
        assert!(pulled <= outcome.force.value && pulled > 0.98 * outcome.force.value);
        (outcome.height.value, outcome.force.value, outcome.step)
    };
    let (height, force, _) = greatest(5, &compute);
    assert_eq!((height, force), (judged.height, judged.force));
    assert_ne!(greatest(6, &compute).1, judged.force);
    assert_eq!(greatest(5, &ComputeSettings { step: Some(3e-4), ..compute }).2, 3e-4);
    // Samples that were run anew at half the step, twice, are so traced.
    let step = |step_halvings: u32| {
        let sample = DrawnSample { seed: 5, number, step_halvings };
        TracedShot::new(&case, 0, &compute, Some(sample)).settings.step
    };
    assert_eq!(step(2), 0.25 * step(0));
}

/// What is drawn of the shot that decides is what `trace --sample` tells of that sample, step by step.
#[test]
fn the_shot_that_decides_is_drawn_as_it_is_traced() {
    let case = rows("[uncertainty]\ndelay_sd_ms = 3\nin_hole_delay_ms = 500\n");
    let compute = ComputeSettings::of(&case.plan);
    let found = Context::new(&case, compute, &StudyControl::default())
        .with_sampling(Sampling::exactly(300, 5))
        .judge_options();
    let judged = found.expect("a result").value.remove(0).expect("a result");
    let DecidingShots { samples, height: deciding, force } = judged.deciding.expect("shots that decide");
    let sampled = judged.sampled.known().expect("samples");
    assert_eq!((Some(samples.of_any.number), sampled.step_halvings), (sampled.deciding_sample(), 0));
    // Each quantity is drawn of the shot whose value is the one that is told beside it.
    assert_eq!([samples.height, samples.force], [deciding.sample, force.sample]);
    assert_ne!(deciding.sample, force.sample, "or the plan tells nothing of it");
    for (number, quantity) in
        [(samples.height.number, Quantity::Height), (samples.force.number, Quantity::Force)]
    {
        let drawn = sampled.samples[number].finest().get(quantity);
        assert_eq!(Some(drawn), sampled.deciding_value(quantity));
    }
    let hardest = |shot: &DecidingShot| shot.history.force.iter().copied().fold(0.0, f64::max);
    let run = sampled.samples[force.sample.number].run;
    // Between two steps a force is greatest by what a parabola adds.
    assert!(hardest(&force) <= run.force && hardest(&force) > 0.98 * run.force);
    assert!(hardest(&deciding) < hardest(&force));
    let sample = DrawnSample { seed: 5, number: deciding.sample.number, step_halvings: 0 };
    let shot = TracedShot::new(&case, 0, &compute, Some(sample));
    let (tires, cables) = (case.scene().tire_count(), case.scene().cables.len());
    let all = TracedItems { tires: (0..tires).collect(), cables: (0..cables).collect() };
    let mut traced = History::new(shot.settings.step);
    trace(&shot, &all, shot.settings.step, &mut |row| {
        let greatest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
        let height = greatest(&mut row[1..].iter().skip(2).step_by(5).take(tires).copied());
        traced.note(row[0], height, greatest(&mut row[1 + 5 * tires..].iter().copied()));
        ControlFlow::Continue(())
    })
    .expect("an outcome");
    let differing = |drawn: &[f64], traced: &[f64], noise: f64| {
        assert_eq!(drawn.len(), traced.len());
        let differ = drawn.iter().zip(traced).filter(|(drawn, traced)| (*drawn - *traced).abs() > noise);
        differ.map(|(drawn, _)| *drawn).collect::<Vec<f64>>()
    };
    // The peaks of the run lie between its steps, of which alone the trace tells.
    let run = sampled.samples[deciding.sample.number].run;
    assert_eq!(differing(&deciding.history.height, &traced.height, 0.0), [run.height]);
    // A force is computed anew from the lengths: the last digits of 1e5 N differ.
    let forces = differing(&deciding.history.force, &traced.force, 1e-6);
    assert!(forces.len() <= 1 && forces.iter().all(|force| *force == run.force), "{forces:?} {}", run.force);
    assert_ne!(deciding.history.height, judged.checked.history.height);
}

/// Launch velocity at which a lone tire just reaches `height` [m].
fn speed_to_reach(height: f64) -> f64 {
    (2.0 * GRAVITY * height).sqrt()
}

/// Probability that a lognormal factor with mean 1 and this coefficient of variation is greater than `factor`.
fn exceeds(factor: f64, cv: f64) -> f64 {
    let sigma = cv.powi(2).ln_1p().sqrt();
    0.5 * libm::erfc((factor.ln() + 0.5 * sigma * sigma) / (sigma * std::f64::consts::SQRT_2))
}

/// A lone tire rises v²/2g, so it passes its limit with a probability known in closed form. Of 100 seeds, the interval of 300
/// samples looked at as they come leaves the probability out in at most 5 %, but for four standard errors (9 %). At a third of the
/// speed it flies a third of the time, to a ninth of the height.
#[test]
fn the_interval_covers_a_known_probability() {
    for height in [2.0, 2.45] {
        let mut plan = lone(height / 9.0, 10.0).plan;
        plan.launches_mut().for_each(|launch| launch.speed_m_s /= 3.0);
        let case = Case::new(plan);
        let exact = exceeds(speed_to_reach(height) / 6.0, 0.1);
        let missed = (0..100).filter(|&seed| {
            let risk = risk_of(&case, &Sampling::exactly(300, seed));
            let [low, high] = risk.bounds.interval;
            !(low..=high).contains(&exact)
        });
        let missed = missed.count();
        assert!(missed <= 14, "{missed} of 100 at {exact}");
    }
}

/// Far from the accepted risk the verdict is the right one, after few samples where many fail; beside it the verdict stays
/// open. The accepted risk is 1 %.
#[test]
fn verdicts_follow_the_accepted_risk() {
    let cv = 0.05;
    for (factor, verdict, most) in
        [(1.2, Verdict::Pass, 500), (1.02, Verdict::Fail, 50), (1.125, Verdict::Undecided, 2000)]
    {
        let case = lone((6.0_f64 * factor).powi(2) / (2.0 * GRAVITY), 100.0 * cv);
        let exact = exceeds(factor, cv);
        let expected = match verdict {
            Verdict::Pass => exact < 1e-3,
            Verdict::Fail => exact > 0.2,
            Verdict::Undecided => (0.008..0.012).contains(&exact),
        };
        assert!(expected, "{factor}: {exact}");
        let risk = risk_of(&case, &Sampling { least: 0, ..Sampling::OF_VERDICT });
        assert_eq!(risk.verdict(), verdict, "{exact}: {:?}", risk.bounds);
        assert!(risk.samples.len() <= most, "{} samples at {exact}", risk.samples.len());
    }
}

/// The shot as planned passes; the shots that are possible do not: that is the whole point.
#[test]
fn a_shot_that_passes_as_planned_fails_by_its_risk() {
    let case = lone(6.1_f64.powi(2) / (2.0 * GRAVITY), 5.0);
    let judged = |sampling: Option<&Sampling>| -> Judgement {
        let compute = ComputeSettings::of(&case.plan);
        let found = Context::new(&case, compute, &StudyControl::default())
            .with_sampling(sampling.copied())
            .judge_options();
        found.expect("a result").value.remove(0).expect("a result")
    };
    assert_eq!(judged(None).verdict(), Verdict::Pass);
    let both = judged(Some(&Sampling::OF_VERDICT));
    assert_eq!((both.checked.verdict, both.verdict()), (Verdict::Pass, Verdict::Fail));
}

/// A lone tire launched with 6 m/s under a limit that 6.27 m/s reach: it passes up to +4 %. One that fails as planned has no
/// margin; one under a limit out of reach has a wide one.
#[test]
fn the_launch_margin_is_the_room_below_the_limit() {
    let margin = |height: f64| {
        let case = lone(height, 1.0);
        let control = StudyControl::default();
        let contexts = [Context::new(&case, ComputeSettings::of(&case.plan), &control)];
        let mut found = judge(&contexts, Depth::Chosen, None).expect("a result");
        assert!(!found.partial);
        found.value[0].remove(0).expect("a result").launch_margin.expect("a margin")
    };
    assert_eq!(
        margin(6.27_f64.powi(2) / (2.0 * GRAVITY)),
        LaunchMargin::UpTo { rise: 0.04, above: Verdict::Fail }
    );
    assert_eq!(margin(5.9_f64.powi(2) / (2.0 * GRAVITY)), LaunchMargin::NotPassing);
    assert_eq!(margin(12.1_f64.powi(2) / (2.0 * GRAVITY)), LaunchMargin::BeyondTried);
}

/// What quick checks leave open a whole check decides: at 5 % faster launches they do, and the margin of this option is far more.
#[test]
fn the_launch_margin_ends_where_whole_checks_no_longer_pass() {
    let text = std::fs::read_to_string(crate::support::shipped("amur-three-rows.toml")).expect("the plan");
    let (head, _) = text.split_once("[[delay]]").expect("an option");
    let text = format!("{head}[[delay]]\nname = \"long period\"\ninterval_ms = 500\n");
    let case = Case::new(Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")));
    let control = StudyControl::default();
    let context = Context::new(&case, ComputeSettings::of(&case.plan), &control);
    let whole = |rise: f64| {
        check_summary(&context, &case.shots[0].with_launches(1.0 + rise)).expect("a result").verdict
    };
    let Ok(LaunchMargin::UpTo { rise, .. }) = launch_margin(&context, &case.shots[0], Verdict::Pass) else {
        panic!("a margin")
    };
    assert!(whole(rise) == Verdict::Pass && whole(rise + 0.01) != Verdict::Pass, "{rise}");
}

/// Rows 109 ms apart, in the plan of three rows with nothing unknown: the step of samples is far too long for this motion
/// (force 51 to 81 kN at steps down to a quarter of a millisecond, 83.4 kN refined).
fn too_hard_for_samples() -> Case {
    let text =
        std::fs::read_to_string(crate::support::tested_plan("amur-three-rows.toml")).expect("the plan");
    let (head, _) = text.split_once("[[delay]]").expect("an option");
    let exact = "delay_sd_ms = 0\nlaunch_cv_percent = 0\nlaunch_common_percent = 0\n\
                 launch_between_shots_percent = 0\nfriction = 0\nslack_percent = 0\naxial_stiffness_percent = 0\ntire_mass_cv_percent = 0\n";
    let text =
        format!("{head}[[delay]]\nname = \"109 ms\"\ninterval_ms = 109\n[uncertainty]\n{exact}{AS_DRAWN}");
    Case::new(Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")))
}

/// A limit between the force of the samples and the refined one is not passed.
#[test]
fn samples_whose_step_is_too_long_pass_nothing() {
    let mut case = too_hard_for_samples();
    case.plan.limits.withstands_one_dud = false;
    case.limits.accepted_risk = 0.05;
    let control = StudyControl::default();
    let context =
        Context::new(&case, ComputeSettings::of(&case.plan), &control).with_sampling(Sampling::OF_VERDICT);
    let mut found = judge(&[context], Depth::Unconfirmed, None).expect("a result").value;
    let judged = found.remove(0).remove(0).expect("a result");
    let risk = judged.sampled.known().expect("samples");
    assert_eq!((judged.checked.verdict, risk.bounds.verdict()), (Verdict::Pass, Verdict::Pass));
    assert_eq!(judged.verdict(), Verdict::Undecided, "{:?}", risk.samples[0]);
    assert!(risk.step_halvings > 0, "the audit saw it, too");
    // Sweeps and orders sample shots this way.
    let shots = [(case.shots[0].clone(), ShotSummary::of(&judged.checked))];
    let sampled = sample_shots_in_brief(&context, &shots, &Sampling::OF_VERDICT);
    let sampled = sampled.expect("a result").remove(0).expect("samples");
    assert_eq!((sampled.bounds.verdict(), sampled.verdict), (Verdict::Pass, Verdict::Undecided));
}

/// A plan in which little is unknown, so that all samples have the same error of the step: their force is 3 % too small, and
/// a fifth of the shots fail, by 2,000 samples at a fortieth of the step.
const BIASED: &str = r#"
[shelter]
layout="grid"
rows=3
columns=2
spacing_m=1.0
[tire]
mass_kg=50.0
outer_diameter_m=0.0
[cable]
axial_stiffness_kn=6371.038785020701
breaking_force_kn=1.8164
slack_percent=0.0
[ground]
friction=0.5
[[blast_row]]
name="0"
under_row=1
launch_m_s=6.0
[[blast_row]]
name="1"
under_row=2
launch_m_s=6.0
[[blast_row]]
name="2"
under_row=3
launch_m_s=6.0

[limits]
flight_height_m=50
cable_safety_factor=1
drift_m=50
[[delay]]
name="a"
interval_ms=17.0
[uncertainty]
launch_cv_percent=0.2
launch_common_percent=0.2
launch_between_shots_percent=0
launch_mass_exponent=[1,1]
slack_percent=[0,0]
tire_mass_cv_percent=0.2
friction=[0.5,0.5]
axial_stiffness_percent=[0,0]
launch_row_cv_percent=0
launch_tilt_deg=0
launch_tilt_common_deg=0
hole_position_m=0
pattern_offset_m=0
hole_fails_percent=0
cable_length_m=0
"#;

#[test]
fn samples_that_share_one_error_pass_nothing() {
    let case = Case::new(Plan::parse("", BIASED).unwrap_or_else(|mistakes| panic!("{mistakes}")));
    for seed in [1, 2] {
        let risk = risk_of(&case, &Sampling { seed, ..Sampling::OF_VERDICT });
        assert_ne!(risk.verdict(), Verdict::Pass, "{seed}: {:?}", risk.bounds);
    }
}

/// The same where 10 % are accepted, so that few samples seem to do: 17 to 19 % fail, by 600 samples at 50 µs. With ten audits
/// of 200 samples and a test of their signs alone each of these seeds passes it, and 3 of 16 others; without an audit of values all do.
#[test]
fn few_samples_that_share_one_error_pass_nothing() {
    let text = BIASED
        .replace("mass_kg=50.0", "mass_kg=48.676")
        .replace(
            "axial_stiffness_kn=6371.038785020701\nbreaking_force_kn=1.8164",
            "rope=\"GOST 2688-80 12 1960\"",
        )
        .replace("cable_safety_factor=1\n", "cable_safety_factor=46.6\naccepted_risk_percent=10\n");
    let case = Case::new(Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")));
    let passed = [1, 2].into_iter().filter(|&seed| {
        // A wrong pass at 10 % takes a few hundred samples.
        let at_once = Sampling { seed, least: 0, most: 500, ..Sampling::OF_VERDICT };
        risk_of(&case, &at_once).verdict() == Verdict::Pass
    });
    assert_eq!(passed.collect::<Vec<u64>>(), [0; 0]);
}

/// Bounds that the audit shows to be wrong are not kept because they leave the verdict open: at this strength 8 % fail, by
/// 10,000 samples at 20 µs, where samples at their own step say 0.2 to 1.3 %. Without an audit of values each of these seeds keeps them.
#[test]
fn open_bounds_that_share_one_error_are_looked_through() {
    let text = BIASED.replace("breaking_force_kn=1.8164", "breaking_force_kn=1.8240");
    let case = Case::new(Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")));
    for seed in [1, 4] {
        let risk = risk_of(&case, &Sampling { seed, ..Sampling::OF_VERDICT });
        let [low, high] = risk.bounds.interval;
        assert!((low..=high).contains(&0.083) || risk.finer_runs_disagree(), "{seed}: {low} to {high}");
    }
}

/// Shards are drawn at the usual step; where the audit contradicts them, all of them together are sampled anew, as on one
/// machine.
#[test]
fn shards_that_the_audit_contradicts_are_sampled_anew() {
    let case = too_hard_for_samples();
    let compute = ComputeSettings::of(&case.plan);
    let (sampling, control) = (Sampling::exactly(300, 1), StudyControl::default());
    let target = ShotToSample::new(&case, &case.shots[0], compute, sampling);
    let folder = tempfile::tempdir().expect("a folder");
    let mut known = HashMap::new();
    for index in [0, 1] {
        let (file, shard) = (folder.path().join(index.to_string()), Shard { index, count: 2 });
        let question = Question::Risk(risk::Question {});
        let head = Head::new(&case, &Asked { question, sampling: Some(sampling), compute }, shard);
        let saved = StudyControl::with_journal(results_file::open(&file, &head).expect("a new file"));
        run_shard(&[target], shard, &saved).expect("samples");
        let text = std::fs::read_to_string(&file).expect("a shard");
        known.extend(results_file::read("a shard", &text).expect("results").known);
    }
    assert_eq!(known.len(), 300);
    let joined = StudyControl::with_journal(Journal::of_known(known));
    let mut of_shards = Context::new(&case, compute, &joined)
        .with_sampling(sampling)
        .sample_options()
        .expect("a result")
        .value;
    assert!(joined.journal().recalled() >= 100, "until the audit contradicts them");
    let whole = Context::new(&case, compute, &control)
        .with_sampling(sampling)
        .sample_options()
        .expect("a result")
        .value;
    let whole = whole[0].as_ref().expect("a result").sampled.known().expect("samples");
    assert!(whole.step_halvings > 0, "a test that can fail");
    assert_eq!(of_shards.remove(0).expect("a result").sampled.known(), Some(whole));
}

/// Mean and standard deviation.
fn moments(values: &[f64]) -> [f64; 2] {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    [mean, (values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / n).sqrt()]
}

/// Everything that is drawn has the mean and the deviation asked for, within four standard errors of 20,000 draws (of the
/// deviation: 4 %).
#[test]
fn draws_have_the_moments_asked_for() {
    let mut case = rows(&format!("[uncertainty]\n{AS_DRAWN}"));
    case.plan.uncertainty = Uncertainty {
        delay: DelayScatter { sd_ms: 0.0, cv_percent: 2.0 },
        in_hole_delay_ms: 500.0,
        launch_cv_percent: 20.0,
        launch_common_percent: 10.0,
        launch_between_shots_percent: 6.0,
        launch_mass_exponent: [0.2, 0.8],
        launch_tilt_deg: 3.0,
        friction: [0.3, 0.5],
        slack_percent: [1.0, 4.0],
        axial_stiffness_percent: [-10.0, 20.0],
        tire_mass_cv_percent: 8.0,
        breaking_force_cv_percent: 3.0,
        ..case.plan.uncertainty
    };
    let nominal = &case.shots[1];
    let (hole, scene) = (nominal.firings[11], case.scene());
    let names = [
        "launch of the hole",
        "common",
        "between shots",
        "mass exponent",
        "tilt x",
        "tilt y",
        "time",
        "friction",
        "slack",
        "stiffness",
        "mass",
        "strength",
    ];
    let mut values = names.map(|_| Vec::new());
    for number in 0..20_000 {
        let DrawnShot { scene: drawn, shot, inputs, .. } = draw_shot(&case, nominal, 7, number);
        let first = shot.firings.iter().find(|f| f.tire == nominal.firings[0].tire).expect("the first hole");
        let same = shot.firings.iter().find(|firing| firing.tire == hole.tire).expect("the same hole");
        let heavier = drawn.mass[hole.tire] / scene.mass[hole.tire];
        let cable = (&drawn.cables[5], &scene.cables[5]);
        let rest = cable.0.rest_length / cable.1.rest_length * 1.02;
        for (values, value) in values.iter_mut().zip([
            same.launch.norm() * heavier.powf(inputs[5]) / hole.launch.norm() / inputs[0] / inputs[4],
            inputs[0],
            inputs[4],
            inputs[5],
            same.launch.x / same.launch.z,
            same.launch.y / same.launch.z,
            same.time - first.time,
            shot.friction.expect("a friction"),
            rest - 1.0,
            cable.0.stiffness * cable.0.rest_length / (cable.1.stiffness * cable.1.rest_length),
            heavier,
            drawn.strength(5),
        ]) {
            values.push(value);
        }
        assert_eq!((&drawn.position, drawn.cables[5].span), (&scene.position, scene.cables[5].span));
    }
    let uniform = |low: f64, high: f64| [0.5 * (low + high), (high - low) / 12_f64.sqrt()];
    let tilt = 3_f64.to_radians().tan();
    // The gap of 60 ms scatters by 1.2 ms, and two holes by 10 ms each.
    let times = [0.06, 0.0012_f64.hypot(0.01 * 2_f64.sqrt())];
    let expected = [
        [1.0, 0.2],
        [1.0, 0.1],
        [1.0, 0.06],
        uniform(0.2, 0.8),
        [0.0, tilt],
        [0.0, tilt],
        times,
        uniform(0.3, 0.5),
        uniform(0.01, 0.04),
        uniform(0.9, 1.2),
        [1.0, 0.08],
        [1.0, 0.03],
    ];
    for ((name, values), [mean, deviation]) in names.iter().zip(&values).zip(expected) {
        let [average, spread] = moments(values);
        assert!((average - mean).abs() < 4.0 * deviation / 20_000_f64.sqrt(), "{name}: {average} {mean}");
        assert!((spread / deviation - 1.0).abs() < 0.04, "{name}: {spread} {deviation}");
    }
}

/// Height of a lone tire in some samples of a plan with these keys of `[uncertainty]`, and its mass over that of the plan.
fn heights_and_masses(more: &str) -> Vec<(f64, f64)> {
    let text = format!(
        "shelter = {{ layout = \"grid\", rows = 1, columns = 1, spacing_m = 1.5 }}\ntire = {{ mass_kg = 280 }}\n\
         cable = {{ axial_stiffness_kn = 1400, breaking_force_kn = 60 }}\nground = {{ friction = 0.5 }}\n\
         blast_row = [{{ name = \"1\", under_row = 1, launch_m_s = 6 }}]\n\
         limits = {{ flight_height_m = 9, cable_safety_factor = 1 }}\ndelay = [{{ name = \"1\", interval_ms = 0 }}]\n\
         [uncertainty]\nlaunch_cv_percent = 0\nlaunch_common_percent = 0\n{AS_DRAWN}{more}"
    );
    let case = Case::new(Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")));
    let sampled = risk_of(&case, &Sampling::exactly(40, 1));
    let of_sample = |sample: &shelter::study::samples::sample::Sample| {
        let drawn = draw_shot(&case, &case.shots[0], 1, sample.number);
        (sample.run.get(Quantity::Height), drawn.scene.mass[0] / case.scene().mass[0])
    };
    sampled.samples.iter().map(of_sample).collect()
}

/// A tire of mass m' rises V0² (m/m')^(2n) / 2g: as high as any at n = 0, with the momentum of the plan's at n = 1. The apex of a
/// parabola is computed to rounding.
#[test]
fn a_tire_of_another_mass_rises_as_the_mass_law_says() {
    let planned = 36.0 / (2.0 * GRAVITY);
    for exponent in [0.0, 0.3, 1.0] {
        let keys = format!(
            "launch_between_shots_percent = 0\nlaunch_mass_exponent = [{exponent}, {exponent}]\ntire_mass_cv_percent = 20\n"
        );
        let all = heights_and_masses(&keys);
        assert!(all.iter().any(|(_, heavier)| *heavier > 1.2) && all.iter().any(|(_, h)| *h < 0.85));
        for (height, heavier) in all {
            let exact = planned * heavier.powf(-2.0 * exponent);
            assert!((height / exact - 1.0).abs() < 1e-6, "{exponent}: {height} {exact}");
        }
    }
}

/// Where nothing but the shots differs, the height of a tire scatters as the square of a lognormal factor with mean 1: by 10 %
/// where launches differ by 5 %. 40 heights know their standard deviation to 11 %, their mean to 1.6 %.
#[test]
fn shots_differ_by_a_factor_of_their_own() {
    let all = heights_and_masses("launch_between_shots_percent = 5\ntire_mass_cv_percent = 0\n");
    let planned = 36.0 / (2.0 * GRAVITY);
    let [mean, deviation] = moments(&all.iter().map(|(height, _)| height / planned).collect::<Vec<f64>>());
    assert!((mean - 1.0025).abs() < 0.05 && (deviation / 0.1 - 1.0).abs() < 0.35, "{mean} {deviation}");
}

/// A draw belongs to seed, number, hole or tire: another option, another order of the options, another accuracy have the
/// same draws; another seed or number has not.
#[test]
fn draws_are_the_same_for_every_option_and_accuracy() {
    let case = rows(
        "[uncertainty]\nlaunch_cv_percent = 5\nlaunch_tilt_deg = 2\nin_hole_delay_ms = 500\nhole_position_m = 0\n\
         pattern_offset_m = 0\n",
    );
    let drawn = |option: usize, seed: u64, number: usize| {
        let DrawnShot { scene, shot, inputs, .. } = draw_shot(&case, &case.shots[option], seed, number);
        let mut launches: Vec<_> =
            shot.firings.iter().map(|f| (f.tire, f.launch.map(f64::to_bits))).collect();
        launches.sort_by_key(|(tire, _)| *tire);
        (scene.mass, launches, inputs)
    };
    assert_eq!(drawn(0, 1, 5), drawn(1, 1, 5));
    assert_ne!(drawn(0, 1, 5), drawn(0, 1, 6));
    assert_ne!(drawn(0, 1, 5), drawn(0, 2, 5));
}

fn run_variant(model: &Model, scene: &Scene, shot: &Shot, method: Method) -> Outcome {
    let settings = RunSettings { method, step: 1e-3, duration: None };
    model.run_variant(scene, shot, &settings, &mut |_| ControlFlow::Continue(())).expect("a run")
}

/// A run under a variant of a model equals the run of a model that was laid out with the variant's numbers, to the last bit;
/// with mirror planes and without.
#[test]
fn a_variant_runs_like_a_scene_laid_out_with_its_numbers() {
    let base = rows("");
    for more in
        [String::new(), format!("[uncertainty]\nlaunch_cv_percent = 0\ntire_mass_cv_percent = 0\n{AS_DRAWN}")]
    {
        let case = rows(&more);
        for number in 0..3 {
            let DrawnShot { scene, shot, .. } = draw_shot(&case, &case.shots[0], 1, number);
            for method in METHODS {
                let laid_out = run_variant(&Model::new(scene.clone()), &scene, &shot, method);
                let variant = run_variant(&base.model, &scene, &shot, method);
                assert_eq!(variant, laid_out, "{method:?} {number}");
                // The variant differs from the plan.
                assert_ne!(variant.force, run_variant(&base.model, base.scene(), &shot, method).force);
            }
            let planes = base.model.modelled_tires(Method::Verlet, &shot);
            assert_eq!(planes < 30, !more.is_empty(), "both ways are tried");
        }
    }
}

/// Without a range and without scatter every sample is the shot as planned, to the last bit.
#[test]
fn what_is_known_exactly_is_not_changed() {
    let case = rows(
        "[uncertainty]\ndelay_sd_ms = 0\nlaunch_cv_percent = 0\nlaunch_common_percent = 0\n\
         launch_row_cv_percent = 0\nlaunch_tilt_deg = 0\nlaunch_tilt_common_deg = 0\nhole_position_m = 0\n\
         pattern_offset_m = 0\nhole_fails_percent = 0\ncable_length_m = 0\nlaunch_between_shots_percent = 0\nfriction = [0.5, 0.5]\nslack_percent = [2, 2]\naxial_stiffness_percent = [0, 0]\ntire_mass_cv_percent = 0\n",
    );
    let DrawnShot { scene, shot, .. } = draw_shot(&case, &case.shots[1], 1, 3);
    for method in METHODS {
        let exact = run_variant(&case.model, case.scene(), &case.shots[1], method);
        assert_eq!(run_variant(&case.model, &scene, &shot, method), exact);
    }
}

/// Two pairs of tires, each tied by one cable, and each cable pulled by a launch of its own: the greatest force over
/// strength is that of the cable whose force over strength is greatest, though the other pulls harder.
#[test]
fn a_weak_cable_counts_by_its_strength() {
    let mut scene = tires(&[(0.0, 0.0), (1.0, 0.0), (0.0, 9.0), (1.0, 9.0)], 280.0);
    tie(&mut scene, 0, 1, 1e6, 1.0);
    tie(&mut scene, 2, 3, 1e6, 1.0);
    let mut shot = fire(&[0, 2], 4.0);
    shot.firings[1].launch *= 0.9;
    for method in METHODS {
        let run = |strength: Vec<f64>, breaking_force: Option<f64>| {
            let scene = Scene { strength, breaking_force, ..scene.clone() };
            run_variant(&Model::new(scene.clone()), &scene, &shot, method)
        };
        let strong = run(Vec::new(), None);
        let gentle = run(vec![1e9, 1.0], None);
        assert_eq!((strong.force.index, gentle.force.index), (0, 1));
        let weak = run(vec![1.0, 0.7], None);
        assert!(weak.force.index == 1 && (weak.force.time - gentle.force.time).abs() < 1e-12);
        let ratio = weak.force.value / (gentle.force.value / 0.7);
        assert!((ratio - 1.0).abs() < 1e-12 && weak.force.value > strong.force.value, "{method:?} {ratio}");
        // A strong cable holds a force at which one of the plan's strength would break.
        let held = run(vec![2.0, 1.0], Some(0.95 * strong.force.value));
        assert!(held.broken.is_empty() && 2.0 * held.force.value > strong.force.value, "{method:?}");
        assert_eq!(held.force, gentle.force, "{method:?}");
        // The weak cable breaks at a force that it would hold at the plan's strength.
        let breaking = 1.1 * strong.force.value;
        let broken = |strength: Vec<f64>| run(strength, Some(breaking)).broken;
        assert!(broken(Vec::new()).is_empty());
        let cables: Vec<usize> = broken(vec![1.0, 0.5]).iter().map(|broken| broken.cable).collect();
        assert_eq!(cables, [1], "{method:?}");
    }
}

/// Slack alone decides how hard two tires pull at their cable; then its share is nearly all of the variance.
#[test]
fn the_input_that_decides_has_the_greatest_share() {
    let case = rows(
        "[uncertainty]\nlaunch_cv_percent = 0\nlaunch_common_percent = 0.5\n\
         launch_row_cv_percent = 0\nlaunch_tilt_deg = 0\nlaunch_tilt_common_deg = 0\nhole_position_m = 0\n\
         pattern_offset_m = 0\nhole_fails_percent = 0\ncable_length_m = 0\nlaunch_between_shots_percent = 0\nslack_percent = [0.5, 1.2]\n\
         tire_mass_cv_percent = 0\n",
    );
    let risk = risk_of(&case, &Sampling::exactly(400, 3));
    let shares = input_shares(&risk, &case.limits).expect("enough samples");
    assert_eq!(shares[0].0.key().name, "slack_percent", "{shares:?}");
    assert!(shares[0].1 > 0.5 && shares.iter().map(|(_, share)| share).sum::<f64>() < 1.1, "{shares:?}");
    let few = risk_of(&case, &Sampling::exactly(150, 3));
    assert!(input_shares(&few, &case.limits).is_none());
    assert!(few.band(Quantity::Force).is_some());
}

/// Samples do not depend on the number of threads, and a reader who gets them one by one comes to the same interval.
#[test]
fn samples_are_the_same_on_any_number_of_threads() {
    let case = rows("[uncertainty]\nlaunch_cv_percent = 5\n");
    let compute = ComputeSettings { accuracy: Accuracy::Draft, ..ComputeSettings::of(&case.plan) };
    let sampling = Sampling::exactly(120, 1);
    let on = |threads| {
        let work = || {
            Context::new(&case, compute, &StudyControl::default()).with_sampling(sampling).sample_options()
        };
        let found = thread_pool(threads).expect("threads").install(work).expect("a result").value;
        let risk = |judged: Judgement| judged.sampled.known().cloned().expect("samples");
        found.into_iter().map(|result| risk(result.expect("a result"))).collect::<Vec<SampledShot>>()
    };
    let one = on(1);
    assert_eq!(one, on(3));
}

/// Samples whose first hole would fire before time 0 are shifted, and so is the end of their run: what comes to rest by
/// `duration_s` before the shift is no run that ends early.
#[test]
fn samples_are_followed_as_long_as_the_shot_as_planned() {
    let mut endless = rows(
        "[uncertainty]\nin_hole_delay_ms = 1500\ndelay_sd_ms = 60\nlaunch_cv_percent = 0\nlaunch_common_percent = 0\n\
         launch_between_shots_percent = 0\n",
    );
    // Whatever fails does so at any end.
    (endless.limits.height, endless.limits.force, endless.limits.breaking_force) = (100.0, 1e9, 1e9);
    let shot = &endless.shots[0];
    // At another step rest is found somewhat earlier or later.
    let rest = |scene: &Scene, shot: &Shot| {
        let at = |step| {
            let settings = RunSettings { method: Method::Verlet, step, duration: None };
            let run = endless.model.run_variant(scene, shot, &settings, &mut |_| ControlFlow::Continue(()));
            run.expect("an outcome").end.time
        };
        at(1e-3).max(at(2e-3))
    };
    let duration = rest(endless.scene(), shot) + 0.12;
    let mut limited = endless.clone();
    limited.plan.simulation.duration_s = Some(duration);
    let verdicts = |case: &Case| {
        let target =
            ShotToSample::new(case, shot, ComputeSettings::of(&case.plan), Sampling::exactly(100, 1));
        let found = sample_shots(&[target], &StudyControl::default()).expect("samples").value.remove(0);
        found.samples.iter().map(|sample| sample.finest().verdict).collect::<Vec<_>>()
    };
    let (mut in_time, mut after_the_end_unshifted) = (0, 0);
    for (number, (limited, endless_verdict)) in
        verdicts(&limited).into_iter().zip(verdicts(&endless)).enumerate()
    {
        let DrawnShot { scene, shot, later, .. } = draw_shot(&endless, shot, 1, number);
        let end = rest(&scene, &shot);
        if end - later < duration - 0.02 {
            assert_eq!(
                limited, endless_verdict,
                "sample {number}, {later} s later, rests at {end} s of {duration} s"
            );
            in_time += 1;
            after_the_end_unshifted += usize::from(end > duration + 0.02);
        }
    }
    assert!(in_time >= 10 && after_the_end_unshifted >= 5, "{in_time}, {after_the_end_unshifted}");
}
