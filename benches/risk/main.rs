//! Failure probabilities against brute force.
//!
//! `cargo bench --bench risk -- coverage [PLANS] [SEEDS]`: random plans whose true risk lies between 0.1 and 10 %, each
//! judged with many seeds and both steps of samples; how often the interval holds the truth and the verdict is right.
//! `cargo bench --bench risk -- shipped [SAMPLES]`: the options of the shipped plans that pass, by brute force at a fine step.
//! `cargo bench --bench risk -- recommended [STREAMS] [PLANS] [SEEDS]`: how often an option is wrong that was recommended
//! ([`recommended`]).

mod recommended;

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use shelter::choice::Accuracy;
use shelter::plan::Plan;
use shelter::study::samples::run_sample::ShotToSample;
use shelter::study::samples::sample::Sample;
use shelter::study::samples::sample_count::Sampling;
use shelter::study::samples::sample_until_sure::{run_shard, sample_shots};
use shelter::study::{Case, ComputeSettings, Context, Shard, StudyControl};
use shelter::verdict::Verdict;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    let number =
        |n: usize, usual: usize| arguments.get(n).map_or(usual, |text| text.parse().expect("a number"));
    match arguments.first().map(String::as_str) {
        Some("coverage") => coverage(number(1, 40), number(2, 25) as u64),
        Some("shipped") => shipped(number(1, 10_000)),
        Some("recommended") => recommended::run(number(1, 200), number(2, 20), number(3, 5) as u64),
        _ => coverage(4, 5),
    }
}

/// Samples of the truth of a random plan.
const TRUTH: usize = 20_000;
/// Seed of the truth, which no verdict has.
const SEED: u64 = 1 << 40;

/// Many samples, at the step of samples of `accuracy`; that of reference is fine.
fn brute_force(case: &Case, option: usize, samples: usize, accuracy: Accuracy) -> Vec<Sample> {
    let compute = ComputeSettings { accuracy, ..ComputeSettings::of(&case.plan) };
    let sampling = Sampling::exactly(samples, SEED);
    let target = ShotToSample::new(case, &case.shots[option], compute, sampling);
    let drawn = run_shard(&[target], Shard::WHOLE, &StudyControl::default()).expect("samples");
    drawn.into_iter().filter_map(|(_, sample)| sample).collect()
}

fn share(flags: impl Iterator<Item = bool>) -> f64 {
    let all: Vec<bool> = flags.collect();
    all.iter().filter(|&&is| is).count() as f64 / all.len() as f64
}

/// A random plan of one option, whose limit of height or force is passed by a share of the shots near `risk`; with the true
/// share.
fn random_plan(random: &mut ChaCha8Rng, risk: f64) -> (Case, f64) {
    let mut pick = |low: f64, high: f64| low + (high - low) * random.random::<f64>();
    let (rows, columns) = (pick(3.0, 6.0) as usize, pick(3.0, 7.0) as usize);
    let spacing = pick(2.0, 3.0);
    let diameter = if pick(0.0, 1.0) < 0.5 { 0.0 } else { pick(1.2, 0.95 * spacing) };
    let (slack, friction) = (pick(0.0, 4.0), pick(0.2, 0.8));
    let text = |height: f64, breaking_force: f64, numbers: &[f64]| {
        let [stiffness, interval, first, second, hole, common, tilt, wide] = numbers else { unreachable!() };
        format!(
            r#"
shelter = {{ layout = "grid", rows = {rows}, columns = {columns}, spacing_m = {spacing} }}
tire = {{ mass_kg = 280, outer_diameter_m = {diameter} }}
cable = {{ axial_stiffness_kn = {stiffness}, breaking_force_kn = {breaking_force}, slack_percent = {slack} }}
ground = {{ friction = {friction} }}
blast_row = [{{ name = "1", under_row = 1, launch_m_s = {first} }}, {{ name = "2", under_row = 2, launch_m_s = {second} }}]
limits = {{ flight_height_m = {height}, cable_safety_factor = 1 }}
delay = [{{ name = "1", interval_ms = {interval} }}]
[uncertainty]
detonator = "pyrotechnic"
in_hole_delay_ms = 500
launch_cv_percent = {hole}
launch_common_percent = {common}
launch_tilt_deg = {tilt}
slack_percent = [{}, {}]
axial_stiffness_percent = [-{wide}, {wide}]
tire_mass_cv_percent = {wide}
"#,
            0.8 * slack,
            1.2 * slack,
        )
    };
    let numbers = [
        pick(1000.0, 8000.0),
        pick(5.0, 200.0),
        pick(3.0, 8.0),
        pick(3.0, 8.0),
        pick(1.0, 8.0),
        pick(1.0, 8.0),
        pick(0.0, 4.0),
        pick(1.0, 10.0),
    ];
    let by_height = pick(0.0, 1.0) < 0.5;
    let plan = |height: f64, force: f64| {
        let text = text(height, force * 1e-3, &numbers);
        Case::new(Plan::parse("random", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")))
    };
    let samples = brute_force(&plan(1e3, 1e9), 0, TRUTH, Accuracy::Reference);
    let value = |sample: &Sample| if by_height { sample.run.height } else { sample.run.force };
    let mut values: Vec<f64> = samples.iter().map(value).collect();
    values.sort_by(f64::total_cmp);
    let limit = values[((1.0 - risk) * values.len() as f64) as usize];
    let case = if by_height { plan(limit, 1e9) } else { plan(1e3, limit) };
    (case, share(values.iter().map(|value| *value > limit)))
}

fn coverage(plans: usize, seeds: u64) {
    let mut random = ChaCha8Rng::seed_from_u64(16);
    let accepted = 0.01;
    let drawn: Vec<(Case, f64)> = (0..plans)
        .map(|_| {
            let risk = 10_f64.powf(random.random_range(-3.0..-1.0));
            random_plan(&mut random, risk)
        })
        .collect();
    // The same draws at the coarse step: the difference is the bias of coarse samples.
    let bias = |(case, truth): &(Case, f64)| {
        let coarse = brute_force(case, 0, TRUTH, Accuracy::Field);
        let coarse = share(coarse.iter().map(|sample| sample.run.verdict == Verdict::Fail));
        println!("  truth {truth:.4}, the same draws at the coarse step {coarse:.4}");
        (coarse - truth).abs()
    };
    let mut biases: Vec<f64> = drawn.iter().map(bias).collect();
    biases.sort_by(f64::total_cmp);
    println!("coarse step: {:.4} in the median, {:.4} at most", biases[plans / 2], biases[plans - 1]);
    println!(
        "level      plans  covered  wrong verdicts  open, truth outside half to twice the accepted risk"
    );
    for accuracy in [Accuracy::Field, Accuracy::Reference] {
        let (mut covered, mut wrong, mut open) = (Vec::new(), Vec::new(), Vec::new());
        for (case, truth) in &drawn {
            let compute = ComputeSettings { accuracy, ..ComputeSettings::of(&case.plan) };
            for seed in 1..=seeds {
                let (shot, sampling) = (&case.shots[0], Sampling { seed, ..Sampling::OF_VERDICT });
                let target = ShotToSample::new(case, shot, compute, sampling);
                let found = sample_shots(&[target], &StudyControl::default());
                let risk = found.expect("samples").value.remove(0);
                let [low, high] = risk.bounds.interval;
                covered.push((low..=high).contains(truth));
                let verdict = risk.verdict();
                let right = if *truth < accepted { Verdict::Pass } else { Verdict::Fail };
                wrong.push(verdict != right && verdict != Verdict::Undecided);
                if *truth < 0.5 * accepted || *truth > 2.0 * accepted {
                    open.push(verdict == Verdict::Undecided);
                }
            }
        }
        println!(
            "{:9}  {:5}  {:6.1} %  {:12.1} %  {:6.1} %",
            accuracy.name(),
            plans,
            1e2 * share(covered.into_iter()),
            1e2 * share(wrong.into_iter()),
            1e2 * share(open.into_iter()),
        );
    }
}

fn shipped(samples: usize) {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("plans");
    println!("plan, option: verdict, interval of check; failing share of {samples} at a fine step");
    for file in std::fs::read_dir(folder).expect("the plans").flatten() {
        let case = Case::load(&file.path()).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let compute = ComputeSettings::of(&case.plan);
        let results = Context::new(&case, compute, &StudyControl::default())
            .with_sampling(Sampling::OF_VERDICT)
            .judge_options();
        let results = results.expect("a result").value;
        for (option, result) in results.into_iter().enumerate() {
            let judged = result.expect("a result");
            let name = &case.plan.delays[option].name;
            let [low, high] = judged.sampled.known().map_or([0.0, 1.0], |risk| risk.bounds.interval);
            let verdict = judged.verdict();
            let failing = (verdict == Verdict::Pass).then(|| {
                let drawn = brute_force(&case, option, samples, Accuracy::Reference);
                share(drawn.iter().map(|sample| sample.run.verdict != Verdict::Pass))
            });
            let failing = failing.map_or_else(String::new, |share| format!("{:.2} %", 1e2 * share));
            let file = file.file_name();
            println!(
                "{}, {name}: {}, {low:.4} to {high:.4}; {failing}",
                file.to_string_lossy(),
                verdict.for_people()
            );
        }
    }
}
