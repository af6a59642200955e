//! How often whoever fires a recommended option is wrong, and what that costs.
//!
//! 1. Streams: plans of seven options that fail in 1 to 2 % of the shots, where 1 % is accepted. Every PASS is wrong. Each plan is
//!    judged a hundred times.
//! 2. Random plans of seven intervals, whose limit is such that one of them fails as often as accepted; the truth by brute force.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use shelter::choice::Accuracy;
use shelter::plan::Plan;
use shelter::study::judge::recommend::{recommended, safest_first};
use shelter::study::samples::failure_bounds::{ErrorShare, FailureBounds};
use shelter::study::samples::sample::Sample;
use shelter::study::samples::sample_count::Sampling;
use shelter::study::{Case, ComputeSettings, Context, StudyControl};
use shelter::verdict::Verdict;

use super::brute_force;

const ACCEPTED: f64 = 0.01;
const OPTIONS: usize = 7;
/// Times that a plan of streams is judged.
const REPEATS: usize = 100;
/// Samples of the truth of an option of a random plan.
const TRUTH: usize = 20_000;

pub fn run(streams: usize, plans: usize, seeds: u64) {
    judge_streams(streams);
    judge_plans(plans, seeds);
}

/// Wrong PASSes and samples drawn, of those who take the best at first sight and of those who take the recommended one.
#[derive(Default)]
struct Tally {
    judged: usize,
    wrong_at_first_sight: usize,
    wrong_if_recommended: usize,
    recommended: usize,
    samples: usize,
    fresh_samples: usize,
}

impl Tally {
    fn print(&self, what: &str) {
        let percent = |count: usize| 100.0 * count as f64 / self.judged as f64;
        let each = |count: usize| count as f64 / self.judged as f64;
        println!(
            "{what}: {} judged · wrong {:.2} % at first sight, {:.2} % if recommended · recommended in {:.1} % · \
             samples {:.0} of all options, {:.0} fresh ones",
            self.judged,
            percent(self.wrong_at_first_sight),
            percent(self.wrong_if_recommended),
            percent(self.recommended),
            each(self.samples),
            each(self.fresh_samples),
        );
    }
}

fn judge_streams(plans: usize) {
    let mut random = ChaCha8Rng::seed_from_u64(35);
    let mut tally = Tally::default();
    for _ in 0..plans {
        let risks: Vec<f64> = (0..OPTIONS).map(|_| ACCEPTED * random.random_range(1.0..2.0)).collect();
        for _ in 0..REPEATS {
            let first: Vec<FailureBounds> =
                risks.iter().map(|&risk| stream(&mut random, risk, &Sampling::OF_VERDICT)).collect();
            let mut passing: Vec<usize> =
                (0..OPTIONS).filter(|&n| first[n].verdict() == Verdict::Pass).collect();
            passing.sort_by(|&a, &b| first[a].interval[1].total_cmp(&first[b].interval[1]));
            let fresh: Vec<FailureBounds> = passing
                .iter()
                .enumerate()
                .map(|(n, &option)| {
                    stream(&mut random, risks[option], &Sampling::OF_VERDICT.for_confirmation(n + 1))
                })
                .collect();
            let is_confirmed = fresh.iter().any(|bounds| bounds.verdict() == Verdict::Pass);
            tally.judged += 1;
            tally.wrong_at_first_sight += usize::from(!passing.is_empty());
            tally.wrong_if_recommended += usize::from(is_confirmed);
            tally.recommended += usize::from(is_confirmed);
            tally.samples += first.iter().map(|bounds| bounds.samples).sum::<usize>();
            tally.fresh_samples += fresh.iter().map(|bounds| bounds.samples).sum::<usize>();
        }
    }
    tally.print("streams");
}

/// Samples of a known risk, as many as a verdict takes.
fn stream(random: &mut ChaCha8Rng, risk: f64, sampling: &Sampling) -> FailureBounds {
    let mut bounds = FailureBounds::new(ACCEPTED, sampling.error_share);
    let is_first = sampling.error_share == ErrorShare::Whole;
    while bounds.samples < sampling.most {
        bounds.push(if random.random::<f64>() < risk { Verdict::Fail } else { Verdict::Pass });
        let at_round = bounds.samples.is_multiple_of(100);
        let is_known = at_round && bounds.samples >= sampling.least && bounds.verdict() != Verdict::Undecided;
        if is_known || at_round && !is_first && !bounds.can_pass(sampling.most) {
            break;
        }
    }
    bounds
}

fn judge_plans(plans: usize, seeds: u64) {
    let mut random = ChaCha8Rng::seed_from_u64(36);
    let mut tally = Tally::default();
    for _ in 0..plans {
        let (case, truth) = random_plan(&mut random);
        let compute = ComputeSettings::of(&case.plan);
        for seed in 0..seeds {
            let sampling = Sampling { seed, ..Sampling::OF_VERDICT };
            let found = Context::new(&case, compute, &StudyControl::default())
                .with_sampling(sampling)
                .judge_options();
            let results = found.expect("a result").value;
            let is_wrong = |option: &usize| truth[*option] > ACCEPTED;
            let first = safest_first(&case, &results, |_| 1.0).into_iter().find(|&option| {
                let judged = results[option].as_ref();
                judged.is_ok_and(|judged| judged.grounds().before_confirmation() == Verdict::Pass)
            });
            let best = recommended(&case, &results);
            tally.judged += 1;
            tally.wrong_at_first_sight += usize::from(first.as_ref().is_some_and(is_wrong));
            tally.wrong_if_recommended += usize::from(best.as_ref().is_some_and(is_wrong));
            tally.recommended += usize::from(best.is_some());
            for judged in results.iter().flatten() {
                tally.samples += judged.sampled.known().map_or(0, |sampled| sampled.samples.len());
                tally.fresh_samples += judged.confirmation.known().map_or(0, |drawn| drawn.bounds.samples);
            }
        }
    }
    tally.print("random plans");
}

/// A random plan of seven intervals, with the share of the shots of each that fails.
fn random_plan(random: &mut ChaCha8Rng) -> (Case, Vec<f64>) {
    let mut pick = |low: f64, high: f64| low + (high - low) * random.random::<f64>();
    let (rows, columns) = (pick(3.0, 5.0) as usize, pick(3.0, 5.0) as usize);
    let (spacing, stiffness, slack) = (pick(1.5, 3.0), pick(1000.0, 8000.0), pick(0.5, 4.0));
    let delays: Vec<String> = (0..OPTIONS)
        .map(|n| format!("{{ name = \"{n}\", interval_ms = {} }}", pick(5.0, 150.0).round()))
        .collect();
    let (launch, spread) = (pick(3.0, 7.0), pick(2.0, 6.0));
    let case = |height: f64, force: f64| {
        let text = format!(
            r#"
shelter = {{ layout = "grid", rows = {rows}, columns = {columns}, spacing_m = {spacing} }}
tire = {{ mass_kg = 280 }}
cable = {{ axial_stiffness_kn = {stiffness}, breaking_force_kn = {force}, slack_percent = {slack} }}
ground = {{ friction = 0.5 }}
blast_row = [{{ name = "1", under_row = 1, launch_m_s = {launch} }}, {{ name = "2", under_row = 2, launch_m_s = {launch} }}]
limits = {{ flight_height_m = {height}, cable_safety_factor = 1 }}
delay = [{}]
uncertainty = {{ launch_cv_percent = {spread}, launch_common_percent = {spread}, slack_percent = [{}, {}] }}
"#,
            delays.join(", "),
            0.9 * slack,
            1.1 * slack,
        );
        Case::new(Plan::parse("random", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")))
    };
    let wide = case(1e3, 1e9);
    let forces: Vec<Vec<f64>> = (0..OPTIONS)
        .map(|option| {
            let all = brute_force(&wide, option, TRUTH, Accuracy::Field);
            let mut forces: Vec<f64> = all.iter().map(|sample: &Sample| sample.run.force).collect();
            forces.sort_by(f64::total_cmp);
            forces
        })
        .collect();
    // The option in the middle fails a little more often than accepted.
    let quantile = |forces: &Vec<f64>| forces[((1.0 - 1.2 * ACCEPTED) * forces.len() as f64) as usize];
    let mut limits: Vec<f64> = forces.iter().map(quantile).collect();
    limits.sort_by(f64::total_cmp);
    let limit = limits[OPTIONS / 2];
    let share = |forces: &Vec<f64>| forces.iter().filter(|&&force| force > limit).count() as f64;
    let truth = forces.iter().map(|forces| share(forces) / forces.len() as f64).collect();
    (case(1e3, 1e-3 * limit), truth)
}
