//! Does a fit find what it should? Observations of shots whose unknowns are known, with scatter and noise, fitted again.
//!
//! Each plan is random; so are its truth, drawn from what `[uncertainty]` of the plan says, the scatter from hole to hole, and the
//! noise of the observations. The plan that is fitted knows its own numbers only, and its `[uncertainty]`.

use std::fmt::Write;
use std::time::Instant;

use rand::rngs::StdRng;
use rand::seq::IndexedRandom;
use rand::{Rng, SeedableRng};
use rand_distr::{Distribution, StandardNormal};
use shelter::choice::Unknown;
use shelter::plan::PlanSource;
use shelter::plan::observations::Observations;
use shelter::study::fit::observation_bands::predict_observations;
use shelter::study::fit::observed_shots::ObservedShots;
use shelter::study::fit::{FitResult, fit, observable_names};
use shelter::study::samples::random_shot::draw_shot;
use shelter::study::{Case, ComputeSettings, Context, StudyControl};
use shelter::{Model, Sampling};

/// Half of a 95 % interval [standard deviations].
const HALF: f64 = 1.96;

/// Sets of unknowns that are fitted in turn.
const SETS: [&[Unknown]; 6] = [
    &[Unknown::Launch],
    &[Unknown::Friction],
    &[Unknown::Slack],
    &[Unknown::AxialStiffness],
    &[Unknown::Launch, Unknown::Friction],
    &[Unknown::Launch, Unknown::Slack],
];

#[derive(Default)]
struct Tally {
    estimates: usize,
    within: usize,
    within_any: usize,
    several: usize,
    refused: usize,
    unexplained: usize,
    narrowed: f64,
    seconds: f64,
}

/// Fits until `count` unknowns are estimated, and prints how often the truth lies in the 95 % interval.
pub fn compare(count: usize) {
    let mut all: Vec<Tally> = SETS.iter().map(|_| Tally::default()).collect();
    let mut seed = 0;
    while all.iter().map(|tally| tally.estimates).sum::<usize>() < count {
        let set = seed as usize % SETS.len();
        try_one(seed, SETS[set], &mut all[set]);
        seed += 1;
    }
    println!(
        "| unknowns | estimates | truth in the 95 % interval | of any answer told | fits with several answers | refused | called unexplained | sd over that stated, mean | a fit, s |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    let line = |name: &str, tally: &Tally| {
        let share = |n: usize| format!("{n} ({:.0} %)", 1e2 * n as f64 / tally.estimates.max(1) as f64);
        println!(
            "| {name} | {} | {} | {} | {} | {} | {} | {:.2} | {:.2} |",
            tally.estimates,
            share(tally.within),
            share(tally.within_any),
            tally.several,
            tally.refused,
            tally.unexplained,
            tally.narrowed / tally.estimates.max(1) as f64,
            tally.seconds / tally.estimates.max(1) as f64
        );
    };
    let mut sum = Tally::default();
    for (set, tally) in SETS.iter().zip(&all) {
        let names: Vec<&str> = set.iter().map(|unknown| unknown.name()).collect();
        line(&names.join(", "), tally);
        sum.estimates += tally.estimates;
        sum.within += tally.within;
        sum.within_any += tally.within_any;
        sum.several += tally.several;
        sum.refused += tally.refused;
        sum.unexplained += tally.unexplained;
        sum.narrowed += tally.narrowed;
        sum.seconds += tally.seconds;
    }
    line("all", &sum);
}

/// A random plan of blast rows under all shelter rows but the last.
fn plan(random: &mut StdRng) -> String {
    let (rows, columns) = (random.random_range(3..=5), random.random_range(3..=6));
    let mut text = format!(
        "shelter = {{ layout = \"grid\", rows = {rows}, columns = {columns}, spacing_m = 2.6 }}\n\
         tire = {{ mass_kg = {}, outer_diameter_m = 1.6 }}\n\
         cable = {{ rope = \"GOST 2688-80 14 1960\", slack_percent = 2 }}\nground = {{ friction = 0.5 }}\n\
         limits = {{ flight_height_m = 2.5, cable_safety_factor = 1.3 }}\n\
         delay = [{{ name = \"a\", interval_ms = {} }}]\n",
        random.random_range(200..350),
        random.random_range(5..60)
    );
    let launch = random.random_range(4.0..7.5);
    for row in 1..rows {
        let _ =
            writeln!(text, "[[blast_row]]\nname = \"{row}\"\nunder_row = {row}\nlaunch_m_s = {launch:.2}");
    }
    // Usual scatter, or a third of it: under the usual one few shots tell friction or stiffness.
    let scatter = if random.random() { 1.0 } else { 1.0 / 3.0 };
    let _ = writeln!(
        text,
        "[uncertainty]\nlaunch_cv_percent = {}\nlaunch_tilt_deg = {}\ntire_mass_cv_percent = {}",
        3.0 * scatter,
        scatter,
        5.0 * scatter
    );
    text + "detonator = \"electronic\"\nlaunch_common_percent = 10\nlaunch_between_shots_percent = 3\nfriction = [0.3, 0.7]\nslack_percent = [0.5, 3.5]\n\
            axial_stiffness_percent = [-20, 20]\n"
}

fn parsed(text: String) -> Case {
    Case::parse(PlanSource { path: "plan.toml".into(), text }).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

/// Lines of observations without value and standard deviation: heights, drifts and landings of tires, forces of cables.
fn watched(case: &Case, random: &mut StdRng) -> Vec<(String, f64)> {
    let scene = case.scene();
    let fired: Vec<usize> = case.shots[0].firings.iter().map(|firing| firing.tire).collect();
    let cables: Vec<usize> = (0..scene.cables.len()).collect();
    let tires = |random: &mut StdRng, count| {
        fired.choose_multiple(random, count).map(|&tire| scene.tire_ids[tire]).collect::<Vec<_>>()
    };
    let mut lines: Vec<(String, f64)> = Vec::new();
    lines.extend(tires(random, 3).iter().map(|tire| (format!("{tire},,flight_height_m"), 0.05)));
    lines.extend(tires(random, 2).iter().map(|tire| (format!("{tire},,landing_s"), 0.02)));
    lines.extend(tires(random, 3).iter().map(|tire| (format!("{tire},,drift_m"), 0.05)));
    let chosen = cables.choose_multiple(random, 4);
    lines.extend(chosen.map(|&cable| (format!(",{},cable_force_n", scene.cable_name(cable)), 2000.0)));
    lines
}

fn try_one(seed: u64, unknowns: &[Unknown], tally: &mut Tally) {
    let random = &mut StdRng::seed_from_u64(seed);
    let case = parsed(plan(random));
    // The shot that was observed is a sample of the plan, with draws that no fit uses.
    let sample = draw_shot(&case, &case.shots[0], !seed, 0);
    let truth = |unknown: Unknown| match unknown {
        Unknown::Launch => sample.inputs[0],
        Unknown::Friction => sample.inputs[1],
        Unknown::Slack => sample.inputs[2],
        _ => sample.inputs[3] * case.plan.cable.axial_stiffness_kn,
    };
    let mut fired = case.clone();
    (fired.model, fired.shots) =
        (Model::new(sample.scene.clone()), vec![sample.shot.later_by(-sample.later)]);
    let compute = ComputeSettings::of(&case.plan);
    let lines = watched(&case, random);
    let header = "tire,cable,quantity,value,sd\n";
    let blank: String = lines.iter().map(|(line, sd)| format!("{line},1,{sd}\n")).collect();
    let known = observable_names(&case);
    let read = |text: &str| {
        Observations::parse("seen.csv", text, &known).unwrap_or_else(|mistakes| panic!("{mistakes}"))
    };
    let seen = ObservedShots::new(&[read(&format!("{header}{blank}"))]);
    let shown =
        predict_observations(&Context::new(&fired, compute, &StudyControl::default()), &seen).expect("a run");
    let mut text = header.to_owned();
    for ((line, sd), shown) in lines.iter().zip(&shown) {
        let noise: f64 = StandardNormal.sample(random);
        let value = shown.planned + sd * noise;
        // Nobody reports a tire that never lands, nor a force or a height below 0.
        if value >= 0.0 {
            let _ = writeln!(text, "{line},{value},{sd}");
        }
    }
    let files = [read(&text)];
    let begun = Instant::now();
    let control = StudyControl::default();
    let context = Context::new(&case, compute, &control).with_sampling(Sampling::exactly(50, 1));
    let found = fit(&context, &files, unknowns).expect("a result");
    tally.seconds += begun.elapsed().as_secs_f64() * unknowns.len() as f64;
    let FitResult::Fitted(fit) = found else {
        tally.refused += 1;
        return;
    };
    tally.several += usize::from(fit.answers.len() > 1);
    tally.unexplained += usize::from(!fit.answers[0].explains());
    for (n, &unknown) in unknowns.iter().enumerate() {
        let truth = truth(unknown);
        let holds = |answer: &shelter::study::fit::Answer| {
            let estimate = &answer.estimates[n];
            (estimate.value - truth).abs() <= HALF * estimate.sd
        };
        tally.estimates += 1;
        tally.within += usize::from(holds(&fit.answers[0]));
        tally.within_any += usize::from(fit.answers.iter().any(holds));
        let stated = match unknown {
            Unknown::Launch => 0.1,
            Unknown::Friction => 0.4 / 12.0_f64.sqrt(),
            Unknown::Slack => 3.0 / 12.0_f64.sqrt(),
            _ => 0.4 / 12.0_f64.sqrt() * case.plan.cable.axial_stiffness_kn,
        };
        tally.narrowed += fit.answers[0].estimates[n].sd / stated;
    }
}
