//! Does a user who follows the advice know the launch velocity of a site, and does a PASS hold? Synthetic sites, from a blast plan on
//! paper to a verdict.
//!
//! The world of a site: holes, stemming and specific charge are drawn; the true velocity is the impulse bound of the blast plan times
//! a lognormal share, of which nine in ten lie between a quarter and the whole, as the source of the bound was observed. What
//! `[uncertainty]` knows in common (friction, slack, stiffness) is drawn once a site. Every shot draws all else anew, and a launch
//! factor of its own of 5 %.
//!
//! What the user does:
//! 1. `launch --write`: the estimate of the blast plan, with 50 %.
//! 2. `fit --next`: films that one observation of the next shot, and reads it with the error that the advice names.
//! 3. `fit --write`, where the fit tells one launch. If it does not: a loose test tire, `launch --write`, and again from 2.
//! 4. `check`.

use std::fmt::Write;

use rand::rngs::StdRng;
use rand::seq::IndexedRandom;
use rand::{Rng, SeedableRng};
use rand_distr::StandardNormal;
use rayon::prelude::*;
use shelter::choice::{ObservedQuantity, Unknown};
use shelter::plan::observations::Observations;
use shelter::plan::{PlanSource, write_fit, write_launch};
use shelter::study::fit::observable_names;
use shelter::study::fit::observation_bands::{next_observation, predict_observations};
use shelter::study::fit::observed_shots::ObservedShots;
use shelter::study::launch::{
    Blast, LaunchEstimate, LaunchEstimates, Seen, TestTire, fastest_launch, fit_by_charge,
};
use shelter::study::samples::random_shot::draw_shot;
use shelter::study::samples::run_sample::ShotToSample;
use shelter::study::samples::sample_until_sure::sample_shots;
use shelter::study::{Case, ComputeSettings, Context, StudyControl};
use shelter::verdict::Verdict;
use shelter::{Model, Sampling};

/// Half of a 95 % interval [standard deviations].
const HALF: f64 = 1.96;
/// Samples of the truth behind a PASS.
const TRUTH: usize = 2000;
/// Scatter of launches from shot to shot [%].
const BETWEEN: f64 = 5.0;
/// Rounds of filming before a user gives up.
const ROUNDS: usize = 2;

/// A site: what is true, and the plan that its user has.
struct Site {
    truth: Case,
    plan: Case,
    blast: Blast,
    random: StdRng,
}

#[derive(Default)]
struct Lived {
    within: bool,
    filmed: bool,
    verdict: Option<Verdict>,
    bound_verdict: Option<Verdict>,
    risk: f64,
    percent: f64,
    loose: bool,
}

/// Lives through so many sites, and prints how often the launch lies in its interval and how many PASSes are wrong.
pub fn compare(count: u64) {
    let all: Vec<Lived> = (0..count).into_par_iter().map(|seed| live(&mut site(seed))).collect();
    let tally = |has: &dyn Fn(&Lived) -> bool| all.iter().filter(|lived| has(lived)).count();
    let passes = |lived: &Lived| lived.verdict == Some(Verdict::Pass);
    let of = |wanted: Verdict| tally(&|lived| lived.verdict == Some(wanted));
    let filmed = tally(&|lived| lived.filmed);
    println!(
        "{count} sites: V0 in the stated 95 % at {}; by bounds alone {} PASS; fitted to a film {filmed}, with a loose tire {}; then {} PASS, {} OPEN, {} FAIL; PASSes with a true risk over the accepted one: {}; launch_common_percent after the film, mean {:.1}",
        tally(&|lived| lived.within),
        tally(&|lived| lived.bound_verdict == Some(Verdict::Pass)),
        tally(&|lived| lived.loose),
        of(Verdict::Pass),
        of(Verdict::Undecided),
        of(Verdict::Fail),
        tally(&|lived| passes(lived) && lived.risk > 0.01),
        all.iter().filter(|lived| lived.filmed).map(|lived| lived.percent).sum::<f64>()
            / filmed.max(1) as f64,
    );
}

fn parsed(text: String) -> Case {
    Case::parse(PlanSource { path: "plan.toml".into(), text }).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

fn site(seed: u64) -> Site {
    let mut random = StdRng::seed_from_u64(seed);
    let (diameter, stemming) =
        *[(76.0, 2.2), (89.0, 2.8), (105.0, 3.5), (115.0, 4.0)].choose(&mut random).expect("one");
    let blast = Blast {
        hole_diameter_mm: Some(diameter),
        stemming_m: Some(stemming * random.random_range(0.95..1.1)),
        charge_length_m: Some(2.0),
        specific_charge_kg_m3: Some(random.random_range(0.15..0.4)),
        cover_kg_m2: Some(140.0),
        ..Blast::default()
    };
    let bound = LaunchEstimates::new(&blast, None, &[]);
    let collar =
        bound.all.iter().map(|estimate| estimate.band).find(|band| (band[0] / band[2] - 0.25).abs() < 1e-9);
    // Nine in ten of the shares lie between a quarter and the whole: about a half, by a factor of two at 1.645 standard deviations.
    let share = 0.5 * (2.0_f64.ln() / 1.645 * random.sample::<f64, _>(StandardNormal)).exp();
    let speed = share * collar.expect("the impulse at the collar")[2];
    let mut between = |low: f64, high: f64| random.random_range(low..high);
    let (friction, slack, stiffness) = (between(0.3, 0.5), between(1.0, 4.0), between(-10.0, 10.0));
    // Limits that some sites keep, and some do not.
    let limit = speed.powi(2) / (2.0 * 9.81) * between(0.5, 2.5);
    let plan = |launch: f64, in_common: &str| {
        let mut text = format!(
            "shelter = {{ layout = \"grid\", rows = 2, columns = 3, spacing_m = 2.6 }}\n\
             tire = {{ mass_kg = 280, outer_diameter_m = 1.6 }}\n\
             cable = {{ rope = \"GOST 2688-80 19.5 1960\", slack_percent = 2 }}\nground = {{ friction = 0.4 }}\n\
             limits = {{ flight_height_m = {limit}, cable_safety_factor = 1 }}\n\
             delay = [{{ name = \"a\", interval_ms = 25 }}]\n"
        );
        for row in 1..=2 {
            let _ =
                writeln!(text, "[[blast_row]]\nname = \"{row}\"\nunder_row = {row}\nlaunch_m_s = {launch}");
        }
        parsed(format!(
            "{text}[uncertainty]\nlaunch_cv_percent = 5\nlaunch_row_cv_percent = 3\nlaunch_tilt_deg = 2\ntire_mass_cv_percent = 5\n\
             launch_between_shots_percent = {BETWEEN}\n{in_common}"
        ))
    };
    let [low, high] = [0.99, 1.01];
    let truth = format!(
        "launch_common_percent = 0\nfriction = [{}, {}]\nslack_percent = [{slack}, {slack}]\naxial_stiffness_percent = [{stiffness}, {stiffness}]\n",
        low * friction,
        high * friction
    );
    let known = "friction = [0.3, 0.5]\nslack_percent = [1, 4]\naxial_stiffness_percent = [-10, 10]\n";
    Site { truth: plan(speed, &truth), plan: plan(6.0, known), blast, random }
}

fn live(site: &mut Site) -> Lived {
    let speed = fastest_launch(&site.truth.plan);
    let mut lived = Lived::default();
    let bounds = LaunchEstimates::new(&site.blast, None, &[]);
    let chosen = bounds.chosen().expect("a bound");
    site.plan = with_estimate(&site.plan, chosen);
    lived.bound_verdict = Some(verdict(&site.plan));
    for round in 0..ROUNDS {
        if let Some(fitted) = film_and_fit(site, round as u64) {
            (site.plan, lived.filmed) = (fitted, true);
            break;
        }
        let height = loose_tire(site, round as u64);
        let tire = TestTire { seen: Seen::Height { height, sd: 0.05 }, gravity: 9.81 }.estimate();
        if tire.is_valid() {
            (site.plan, lived.loose) = (with_estimate(&site.plan, &tire), true);
        }
    }
    lived.percent = site.plan.plan.uncertainty.launch_common_percent;
    let sd = (1e-2 * lived.percent).powi(2).ln_1p().sqrt();
    lived.within = (speed / fastest_launch(&site.plan.plan)).ln().abs() <= HALF * sd;
    let found = verdict(&site.plan);
    lived.verdict = Some(found);
    if found == Verdict::Pass {
        lived.risk = true_risk(site);
    }
    lived
}

/// The plan as `launch --write` leaves it.
fn with_estimate(case: &Case, estimate: &LaunchEstimate) -> Case {
    let launch = estimate.to_write(case, &[], "a bound".to_owned(), true).expect("an estimate");
    let text = write_launch::write(&case.source.text, &case.plan, &launch);
    parsed(text.expect("a plan"))
}

/// One shot of the site, of which nothing scatters any more.
fn shot_of(site: &Site, number: u64) -> Case {
    let mut fired = site.truth.clone();
    let shot = draw_shot(&site.truth, &site.truth.shots[0], site.random.clone().random::<u64>() ^ number, 0);
    (fired.model, fired.shots) = (Model::new(shot.scene), vec![shot.shot.later_by(-shot.later)]);
    fired
}

/// The plan as `fit --write` leaves it after the one observation that the advice asks for; `None` where the fit tells no one launch.
fn film_and_fit(site: &mut Site, number: u64) -> Option<Case> {
    let (control, compute) = (StudyControl::default(), ComputeSettings::of(&site.plan.plan));
    let context = Context::new(&site.plan, compute, &control).with_sampling(Sampling::exactly(200, 1));
    let next = next_observation(&context, 0, &Sampling::exactly(200, 1)).expect("runs")?;
    let (scene, watched) = (site.plan.scene(), next.observable.watched);
    let address = match watched.quantity {
        ObservedQuantity::Force => format!(",{}", scene.cable_name(watched.index)),
        _ => format!("{},", scene.tire_ids[watched.index]),
    };
    let read = |value: f64| {
        let line =
            format!("tire,cable,quantity,value,sd\n{address},{},{value},{}\n", watched.quantity, next.sd);
        Observations::parse("seen.csv", &line, &observable_names(&site.plan)).ok()
    };
    let fired = shot_of(site, number);
    let blank = ObservedShots::new(&[read(1.0)?]);
    let shown = predict_observations(&Context::new(&fired, compute, &control), &blank).expect("a run");
    let noise: f64 = site.random.sample(StandardNormal);
    // Nobody reads a height below the ground, nor what never comes.
    let value = Some(shown[0].planned).filter(|value| value.is_finite())? + next.sd * noise;
    let files = [read(value.max(0.0))?];
    let context = Context::new(&site.plan, compute, &control).with_sampling(Sampling::OF_VERDICT);
    let fits = fit_by_charge(&context, &files).expect("a fit");
    let fit = fits[0].fit()?;
    assert_eq!(fit.answers[0].estimates[0].parameter.unknown, Unknown::Launch);
    let text = write_fit::write(&site.plan.source.text, &site.plan.plan, &fit.to_write(), &[]);
    Some(parsed(text.expect("a plan")))
}

/// Height of a loose tire over a hole of another shot, as it was read [m].
fn loose_tire(site: &mut Site, number: u64) -> f64 {
    let fired = shot_of(site, 100 + number);
    let speed = fired.shots[0].firings.first().map_or(0.0, |firing| firing.launch.z);
    let noise: f64 = site.random.sample(StandardNormal);
    (speed * speed / (2.0 * 9.81) + 0.05 * noise).max(0.01)
}

fn verdict(case: &Case) -> Verdict {
    let (control, compute) = (StudyControl::default(), ComputeSettings::of(&case.plan));
    let context = Context::new(case, compute, &control).with_sampling(Sampling::OF_VERDICT);
    let judged = context.judge_options().expect("a result").value;
    judged[0].as_ref().map_or(Verdict::Undecided, shelter::Judgement::verdict)
}

/// Share of the next shots of the site that exceed a limit of the plan.
fn true_risk(site: &Site) -> f64 {
    let (control, compute) = (StudyControl::default(), ComputeSettings::of(&site.truth.plan));
    let target = ShotToSample::new(&site.truth, &site.truth.shots[0], compute, Sampling::exactly(TRUTH, 77));
    let sampled = sample_shots(&[target], &control).expect("samples").value.remove(0);
    let fails = |sample: &&shelter::study::samples::sample::Sample| sample.finest().verdict != Verdict::Pass;
    sampled.samples.iter().filter(fails).count() as f64 / TRUTH as f64
}
