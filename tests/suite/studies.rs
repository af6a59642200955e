//! Studies against brute force over the plain check, and against what is known exactly.

use std::collections::{HashMap, HashSet};
use std::ops::ControlFlow;

use itertools::Itertools;
use shelter::plan::{DelayScatter, LaunchTargets, Plan, Timing, Uncertainty};
use shelter::ropes::catalogue;
use shelter::scene::{Shot, nearby};
use shelter::simulation::Model;
use shelter::study::check::{check, check_shot};
use shelter::study::check_all::check_all;
use shelter::study::nearby::{CHANGE, PER_SHOT};
use shelter::study::orders::{Orders, Tried, orders, refine};
use shelter::study::scatter::{Sampling, drawn, scatter, summary, swaps};
use shelter::study::size::{Demand, size};
use shelter::study::sweep::{GAP, Point, sweep};
use shelter::study::{Case, ComputeSettings, Intervals, NoResult, Shard};
use shelter::study::{Envelope, Progress};
use shelter::verdict::Verdict;

use crate::scenes::GRAVITY;

/// A shelter with `rows` blast rows in the middle of 6 × 4 tires, and more keys.
fn plan(rows: usize, more: &str) -> Plan {
    let mut text = format!(
        r#"
shelter = {{ layout = "grid", rows = 6, columns = 4, spacing_m = 1.5 }}
tire = {{ mass_kg = 280 }}
ground = {{ friction = 0.5 }}
limits = {{ flight_height_m = 1.2, cable_safety_factor = 1.5 }}
delay = [{{ name = "a", interval_ms = 20 }}, {{ name = "b", interval_ms = 45 }}]
{more}
"#
    );
    if !more.contains("cable") {
        text += "cable = { axial_stiffness_kn = 1400, breaking_force_kn = 60, slack_percent = 3 }\n";
    }
    for row in 0..rows {
        let (name, under, launch) = (row + 1, row + 2, 4.0 + 0.5 * row as f64);
        text += &format!("[[blast_row]]\nname = \"{name}\"\nunder_row = {under}\nlaunch_m_s = {launch}\n");
    }
    Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

fn case(rows: usize, more: &str) -> Case {
    Case::new(plan(rows, more))
}

fn judged(case: &Case, order: &[usize], interval: f64) -> Envelope {
    let compute = ComputeSettings::of(&case.plan);
    let shot = case.shot(order, interval);
    let checked = check_shot(case, &shot, &compute, &mut |_| ControlFlow::Continue(()));
    Envelope::of(&checked.expect("a result"))
}

/// Every point has the verdict of `check`; at the intervals of the plan's options it has the very numbers.
#[test]
fn a_sweep_is_the_check_of_every_interval() {
    let case = case(3, "");
    let intervals = Intervals { from: 0.0, to: 0.06, step: 0.007 };
    let swept = sweep(&case, &[0, 1, 2], &intervals, &ComputeSettings::of(&case.plan), &Progress::default());
    let swept = swept.expect("a result").value;
    let verdict = |point: &Point| point.envelope.verdict;
    let (mut own, mut decided) = (0, 0);
    for point in &swept.points {
        let checked = judged(&case, &[0, 1, 2], point.interval);
        if [0.02, 0.045].contains(&point.interval) {
            own += 1;
            assert_eq!(point.envelope, checked);
        }
        if verdict(point) != Verdict::Undecided {
            decided += 1;
            assert_eq!(verdict(point), checked.verdict, "{}", point.interval);
        }
        let around =
            swept.windows.iter().filter(|[from, to]| (*from..=*to).contains(&point.interval)).count();
        assert_eq!(around, usize::from(verdict(point) == Verdict::Pass), "{}", point.interval);
    }
    assert_eq!(own, 2);
    assert!(decided > 100 && 20 * decided > 19 * swept.points.len(), "{decided} of {}", swept.points.len());
    let shares: Vec<f64> = swept.points.iter().map(|p| p.envelope.utilization(&case.limits)).collect();
    let worst = swept.worst(&case).expect("points").envelope.utilization(&case.limits);
    assert_eq!(worst, shares.iter().copied().fold(0.0, f64::max));
    // Where the verdict changes, neighbours are 1/32 ms apart at most.
    for pair in swept
        .points
        .windows(2)
        .filter(|pair| (verdict(&pair[0]) == Verdict::Pass) != (verdict(&pair[1]) == Verdict::Pass))
    {
        assert!(pair[1].interval - pair[0].interval < 0.032e-3);
    }
    assert!(
        swept.largest_gap() <= GAP + 1e-9 && swept.windows.iter().any(|[from, to]| to - from > 10.0 * GAP)
    );
    // No digits that nobody asked for: whole nanoseconds.
    let shown = |point: &Point| format!("{}", point.interval);
    assert!(swept.points.iter().all(|point| shown(point).len() <= "0.000000001".len()));
    let recommended = swept.recommended.expect("a window");
    let near = |point: &&Point| (point.interval - recommended.interval).abs() <= recommended.room;
    for point in swept.points.iter().filter(near) {
        assert!(point.envelope.with_errors(1.0).utilization(&case.limits) <= recommended.utilization);
    }
}

/// An option with firing times of its own is a point, too, where its rows fire at one interval.
#[test]
fn every_option_at_one_interval_is_a_point() {
    let mut plan = plan(3, "");
    plan.delays[0].timing = Timing::At(vec![0.0, 31.0627, 62.1254]);
    let case = Case::new(plan);
    let compute = ComputeSettings::of(&case.plan);
    let intervals = Intervals { from: 0.03, to: 0.035, step: 0.005 };
    let swept = sweep(&case, &[0, 1, 2], &intervals, &compute, &Progress::default()).expect("a result").value;
    let point = swept.points.iter().find(|point| point.interval == 0.031_062_7);
    let checked = check(&case, 0, &compute, &mut |_| ControlFlow::Continue(())).expect("a result");
    assert_eq!(point.expect("the option is tried").envelope, Envelope::of(&checked));
}

/// All orders stand in the ranking once, with the verdict of `check`; the worst and the best have the very numbers.
#[test]
fn orders_find_the_worst_and_the_best_of_brute_force() {
    let case = case(4, "");
    for interval in [0.02, 0.045, 0.2] {
        let compute = ComputeSettings::of(&case.plan);
        let tried =
            orders(&case, &[interval], Shard::WHOLE, &compute, &Progress::default()).expect("a result");
        let ranked = Orders::new(&case, tried.value, 1).ranked;
        let share = |envelope: &Envelope| envelope.utilization(&case.limits);
        let brute: HashMap<Vec<usize>, Envelope> =
            (0..4).permutations(4).map(|order| (order.clone(), judged(&case, &order, interval))).collect();
        assert_eq!(ranked.len(), 24);
        for tried in ranked.iter().filter(|tried| tried.envelope.verdict != Verdict::Undecided) {
            assert_eq!(tried.envelope.verdict, brute[&tried.order].verdict);
        }
        let all = || brute.values().map(share);
        let [worst, best] = [&ranked[0], &ranked[23]];
        assert_eq!(share(&worst.envelope), all().fold(0.0, f64::max));
        assert_eq!(share(&best.envelope), all().fold(f64::INFINITY, f64::min));
        assert_eq!(worst.envelope, brute[&worst.order]);
    }
}

/// Four rows, the last two of which are the mirror images of the first two.
fn mirrored_case() -> Case {
    let mut plan = plan(4, "");
    let launch = plan.blast_rows[0].targets.clone();
    plan.blast_rows[3].targets = match (launch, &plan.blast_rows[3].targets) {
        (LaunchTargets::UnderRow { launch, .. }, LaunchTargets::UnderRow { row, .. }) => {
            LaunchTargets::UnderRow { row: *row, launch }
        }
        _ => panic!("rows"),
    };
    plan.blast_rows[2].targets = match &plan.blast_rows[1].targets {
        LaunchTargets::UnderRow { row, launch } => {
            LaunchTargets::UnderRow { row: row + 1.0, launch: *launch }
        }
        _ => panic!("rows"),
    };
    Case::new(plan)
}

/// A search may have tried an order without its mirrored order, and a screen may have failed.
#[test]
fn an_order_without_its_mirrored_order_is_refined() {
    let case = mirrored_case();
    let order = vec![3, 2, 1, 0];
    let tried = Tried { number: 0, order: order.clone(), interval: 0.045, envelope: Envelope::UNKNOWN };
    let compute = ComputeSettings::of(&case.plan);
    let refined = refine(&case, vec![tried], &compute, &Progress::default()).expect("a result").value;
    assert_eq!(refined[0].envelope, judged(&case, &order, 0.045));
}

/// With a fixed step no study chooses steps of its own.
#[test]
fn a_fixed_step_is_the_step_of_every_shot() {
    let case = case(3, "");
    let compute = ComputeSettings { step: Some(1e-3), ..ComputeSettings::of(&case.plan) };
    let fixed = |order: &[usize], interval: f64| {
        let shot = case.shot(order, interval);
        let checked = check_shot(&case, &shot, &compute, &mut |_| ControlFlow::Continue(()));
        Envelope::of(&checked.expect("a result"))
    };
    let progress = Progress::default();
    let tried = orders(&case, &[0.045], Shard::WHOLE, &compute, &progress).expect("a result").value;
    assert_eq!(tried.len(), 6);
    for tried in tried {
        assert_eq!(tried.envelope, fixed(&tried.order, tried.interval));
    }
    let intervals = Intervals { from: 0.03, to: 0.031, step: 0.001 };
    let swept = sweep(&case, &[0, 1, 2], &intervals, &compute, &progress).expect("a result").value;
    for point in swept.points {
        assert_eq!(point.envelope, fixed(&[0, 1, 2], point.interval));
    }
}

/// Where the shelter is its own mirror image, an order and its mirrored order have the same result, computed once.
#[test]
fn mirrored_orders_are_judged_once() {
    let case = mirrored_case();
    let compute = ComputeSettings::of(&case.plan);
    let progress = Progress::default();
    let tried =
        orders(&case, &[0.045], Shard { index: 0, of: 2 }, &compute, &progress).expect("a result").value;
    let other =
        orders(&case, &[0.045], Shard { index: 1, of: 2 }, &compute, &progress).expect("a result").value;
    assert_eq!(progress.counts(), (12, 12));
    let by_order: HashMap<&[usize], &Tried> =
        tried.iter().chain(&other).map(|tried| (tried.order.as_slice(), tried)).collect();
    assert_eq!(by_order.len(), 24);
    for (number, order) in (0..4).permutations(4).enumerate() {
        let mirrored: Vec<usize> = order.iter().map(|row| 3 - row).collect();
        let [one, image] = [&order, &mirrored].map(|order| by_order[order.as_slice()]);
        assert_eq!((one.number, one.envelope), (number, image.envelope));
        let brute = judged(&case, &order, 0.045);
        assert!(
            (one.envelope.height.value - brute.height.value).abs()
                < one.envelope.height.error + brute.height.error
        );
    }
}

/// Nine rows are searched: from the order of the plan, its reverse and a thousand others, all different. The search ends
/// where no exchange of two rows makes its worst order worse or its best order better, so neither falls behind a start.
#[test]
fn many_rows_are_searched() {
    let text = "simulation = { duration_s = 0.05, accuracy = \"draft\" }";
    let rows = 9;
    let mut plan = plan(4, text);
    for n in 4..rows {
        let mut row = plan.blast_rows[n % 4].clone();
        row.name = format!("{}", n + 1);
        plan.blast_rows.push(row);
    }
    plan.delays.clear();
    let case = Case::new(plan);
    let tried = orders(&case, &[0.002], Shard::WHOLE, &ComputeSettings::of(&case.plan), &Progress::default());
    let tried = tried.expect("a result").value;
    assert!(tried.len() > 1000);
    let different: HashSet<&[usize]> = tried.iter().map(|t| t.order.as_slice()).collect();
    assert_eq!(different.len(), tried.len());
    let listed: Vec<usize> = (0..rows).collect();
    let reversed: Vec<usize> = (0..rows).rev().collect();
    assert_eq!([&tried[0].order, &tried[1].order], [&listed, &reversed]);
    let share = |tried: &Tried| tried.envelope.utilization(&case.limits);
    let by_order: HashMap<&[usize], f64> = tried.iter().map(|t| (t.order.as_slice(), share(t))).collect();
    let ranked = Orders::new(&case, tried.clone(), 1).ranked;
    let worst = &ranked[0];
    // Of orders that are equally good, the one that was tried first.
    let best =
        ranked.iter().find(|tried| share(tried) == share(&ranked[ranked.len() - 1])).expect("the best");
    for start in &tried[..1000] {
        assert!((share(best)..=share(worst)).contains(&share(start)));
    }
    assert!(share(best) < share(worst));
    for a in 0..rows {
        for b in a + 1..rows {
            let exchanged = |of: &Tried| {
                let mut order = of.order.clone();
                order.swap(a, b);
                *by_order.get(order.as_slice()).expect("the exchange is tried")
            };
            assert!(exchanged(worst) <= share(worst) && exchanged(best) >= share(best));
        }
    }
}

#[test]
fn the_lightest_shelter_is_that_of_brute_force() {
    let size_keys = "size = { tire_mass_kg = [150, 400], ropes = \"FAMILY\", most_border_rows = 1 }";
    let family = catalogue().families()[0];
    let more = size_keys.replace("FAMILY", family) + "\ncable = { rope = \"GOST 2688-80 6.2\" }";
    let mut plan = plan(2, &more);
    // So that the thinnest rope holds as planned, and not with inputs changed a little.
    plan.limits.cable_safety_factor = 2.6;
    let compute = ComputeSettings::of(&plan);
    let sizing = size(&plan, &Demand::Options, &compute, &Progress::default()).expect("a result").value;
    let (mut lightest, mut fragile) = (f64::INFINITY, 0);
    for rope in catalogue().ropes.iter().filter(|rope| rope.family == family) {
        for (mass, border) in [(150.0, 0), (150.0, 1), (400.0, 0), (400.0, 1)] {
            let case = Case::new(plan.with(rope, mass, border));
            let passes = |case: &Case, shot: &Shot| {
                let checked = check_shot(case, shot, &compute, &mut |_| ControlFlow::Continue(()));
                checked.expect("a result").verdict == Verdict::Pass
            };
            let near = |shot: &Shot, number: u64| {
                let (scene, shot) = nearby(case.scene(), shot, CHANGE, number);
                passes(&Case { model: Model::new(scene), ..case.clone() }, &shot)
            };
            let length: f64 = case.scene().cables.iter().map(|cable| cable.rest_length).sum();
            let total = case.scene().mass.len() as f64 * mass + length * rope.mass_kg_per_m;
            if total >= lightest || !case.shots.iter().all(|shot| passes(&case, shot)) {
                continue;
            }
            if case.shots.iter().all(|shot| (0..PER_SHOT).all(|n| near(shot, n))) {
                lightest = total;
            } else {
                fragile += 1;
            }
        }
    }
    let found = sizing.found().map_or(f64::INFINITY, |found| found.total_mass);
    assert!((found - lightest).abs() <= 1e-9 * lightest || found == lightest, "{found} {lightest}");
    assert!(lightest.is_finite() && fragile > 0, "the test sizes nothing: {lightest} {fragile}");
    let margins: Vec<f64> =
        sizing.frontier().iter().filter_map(|c| Some(c.trial.ok()?.utilization)).collect();
    assert!(margins.windows(2).all(|pair| pair[1] < pair[0]), "{margins:?}");
}

/// A lone tire rises v²/2g: with a lognormal launch it passes its limit with a probability known in closed form. In 300
/// studies of 100 samples the 95 % interval covers it in 95 % of them; fewer than 270 has a probability below 1e-4.
#[test]
fn the_interval_covers_a_known_probability() {
    let text = r#"
shelter = { layout = "grid", rows = 1, columns = 1, spacing_m = 1.5 }
tire = { mass_kg = 280 }
cable = { axial_stiffness_kn = 1400, breaking_force_kn = 60 }
ground = { friction = 0.5 }
blast_row = [{ name = "1", under_row = 1, launch_m_s = 6 }]
limits = { flight_height_m = 2, cable_safety_factor = 1 }
delay = [{ name = "1", interval_ms = 0 }]
uncertainty = { launch_cv_percent = 10 }
simulation = { accuracy = "draft" }
"#;
    let case = Case::new(Plan::parse("", text).unwrap_or_else(|mistakes| panic!("{mistakes}")));
    let spec = case.plan.uncertainty;
    let sigma = (1.01_f64).ln().sqrt();
    let threshold = (2.0 * GRAVITY * 2.0).sqrt() / 6.0;
    let normal = (threshold.ln() + 0.5 * sigma * sigma) / sigma;
    // 1 − Φ(normal) by the trapezoidal rule, far finer than needed.
    let density = |x: f64| (-0.5 * x * x).exp() / std::f64::consts::TAU.sqrt();
    let step = 1e-4;
    let exact: f64 = (0..100_000).map(|n| density(normal + (n as f64 + 0.5) * step) * step).sum();
    assert!((0.2..0.8).contains(&exact), "{exact}");
    let compute = ComputeSettings::of(&case.plan);
    let covered = (0..300)
        .filter(|&seed| {
            let sampling = Sampling { samples: 100, seed, certain_at: None };
            let samples = scatter(&case, &spec, &sampling, Shard::WHOLE, &compute, &Progress::default());
            let [low, high] = summary(&samples.expect("a result").value, 0).interval;
            (low..=high).contains(&exact)
        })
        .count();
    assert!((270..=300).contains(&covered), "{covered}");
}

/// Mean and deviation of what is drawn: the launch keeps its mean and has its coefficient of variation, the firing times
/// their deviation; each within four standard errors of 20,000 draws.
#[test]
fn draws_have_the_moments_asked_for() {
    let case = case(2, "");
    let spec = Uncertainty {
        delay: DelayScatter { sd_ms: 0.0, cv_percent: 2.0 },
        launch_cv_percent: 20.0,
        friction: [0.3, 0.5],
        ..case.plan.uncertainty
    };
    let last = case.shots[1].firings.len() - 1;
    let (nominal, count) = (case.shots[1].firings[last], 20_000);
    let mut values = [Vec::new(), Vec::new(), Vec::new()];
    for number in 0..count {
        let shot = drawn(&case.shots[1], &spec, 7, 1, number);
        let same = shot.firings.iter().find(|firing| firing.tire == nominal.tire).expect("the same hole");
        values[0].push(same.launch.z / nominal.launch.z);
        values[1].push((same.at - nominal.at) / nominal.at);
        values[2].push(shot.friction.expect("a friction"));
    }
    let expected = [(1.0, 0.2), (0.0, 0.02), (0.4, 0.2 / 12_f64.sqrt())];
    for (values, (mean, deviation)) in values.iter().zip(expected) {
        let n = count as f64;
        let average = values.iter().sum::<f64>() / n;
        let spread = (values.iter().map(|v| (v - average).powi(2)).sum::<f64>() / n).sqrt();
        assert!((average - mean).abs() < 4.0 * deviation / n.sqrt(), "{average} {mean}");
        assert!((spread / deviation - 1.0).abs() < 0.04, "{spread} {deviation}");
    }
    assert_eq!(drawn(&case.shots[1], &spec, 7, 1, 5), drawn(&case.shots[1], &spec, 7, 1, 5));
}

/// Two rows 20 ms apart, both with a deviation of 10 ms: 1 − Φ(20 / 14.14) = 0.0786.
#[test]
fn rows_that_may_swap_are_named() {
    let case = case(2, "");
    let delay = DelayScatter { sd_ms: 10.0, cv_percent: 0.0 };
    let spec = Uncertainty { delay, ..case.plan.uncertainty };
    let swaps = swaps(&case, &spec, 1e-2);
    assert_eq!(swaps.len(), 1, "the option of 45 ms is safe: {swaps:?}");
    assert_eq!((swaps[0].option, swaps[0].rows), (0, [0, 1]));
    assert!((swaps[0].probability - 0.078_65).abs() < 1e-4, "{}", swaps[0].probability);
}

/// A study says itself whether its time was up before all shots were judged.
#[test]
fn a_study_without_time_is_partial() {
    let case = case(2, "uncertainty = { launch_cv_percent = 10 }");
    let compute = ComputeSettings { step: Some(2e-3), ..ComputeSettings::of(&case.plan) };
    let intervals = Intervals { from: 0.0, to: 0.02, step: 0.01 };
    let spec = case.plan.uncertainty;
    let partial = |progress: &Progress| {
        let sampling = |certain_at| Sampling { samples: 3, seed: 1, certain_at };
        let scattered = |certain_at| {
            scatter(&case, &spec, &sampling(certain_at), Shard::WHOLE, &compute, progress)
                .map(|found| found.partial)
        };
        [
            sweep(&case, &[0, 1], &intervals, &compute, progress).map(|found| found.partial),
            orders(&case, &[0.02], Shard::WHOLE, &compute, progress).map(|found| found.partial),
            size(&case.plan, &Demand::Options, &compute, progress).map(|found| found.partial),
            check_all(&[(&case, compute)], progress).map(|found| found.partial),
            scattered(None),
            scattered(Some(0.01)),
        ]
    };
    let out_of_time = Progress::default();
    out_of_time.expire();
    assert_eq!(partial(&out_of_time), [const { Ok(true) }; 6]);
    assert_eq!(partial(&Progress::default()), [const { Ok(false) }; 6]);
}

/// A share of the samples cannot tell when the verdict on all of them is certain.
#[test]
fn samples_until_certain_are_not_shared() {
    let case = case(2, "uncertainty = { launch_cv_percent = 10 }");
    let sampling = Sampling { samples: 3, seed: 1, certain_at: Some(0.01) };
    let spec = case.plan.uncertainty;
    let compute = ComputeSettings::of(&case.plan);
    let share = Shard { index: 1, of: 2 };
    let shared = scatter(&case, &spec, &sampling, share, &compute, &Progress::default());
    assert_eq!(shared, Err(NoResult::SharedUntilCertain));
}

/// With a bound, few samples prove nothing: a shelter whose few samples all pass does not hold for sure.
#[test]
fn a_shelter_sized_for_samples_must_hold_surely() {
    let more = "size = { ropes = \"GOST 2688-80\" }\ncable = { rope = \"GOST 2688-80 6.2\" }\n\
                uncertainty = { launch_cv_percent = 1 }";
    let plan = plan(1, more);
    let spec = plan.uncertainty;
    let compute = ComputeSettings { step: Some(2e-3), ..ComputeSettings::of(&plan) };
    let found = |certain_at, samples| {
        let demand = Demand::Samples(spec, Sampling { samples, seed: 1, certain_at });
        let sizing = size(&plan, &demand, &compute, &Progress::default()).expect("a result").value;
        sizing.found().is_some()
    };
    assert!(found(None, 20));
    assert!(!found(Some(0.05), 20) && found(Some(0.05), 400));
}

#[test]
fn a_stopped_study_has_no_result() {
    let case = case(3, "");
    let progress = Progress::default();
    progress.stop();
    assert!(orders(&case, &[0.02], Shard::WHOLE, &ComputeSettings::of(&case.plan), &progress).is_err());
}
