//! Studies against brute force over the plain check, and against what is known exactly.

use std::collections::{HashMap, HashSet};
use std::ops::ControlFlow;

use itertools::Itertools;
use shelter::choice::Accuracy;
use shelter::plan::{HoleTiming, LaunchTargets, Layout, Plan, Time, Timing};
use shelter::report;
use shelter::ropes::{Kind, catalogue};
use shelter::study::as_planned::check::{check_as_planned, check_shot};
use shelter::study::judge::Judgement;
use shelter::study::judge::Reason;
use shelter::study::judge::batch::{CaseOption, Depth, JudgeEvent, judge};
use shelter::study::judge::grounds::Evidence;
use shelter::study::judge::recommend::MustPass;
use shelter::study::observed::Comparison;
use shelter::study::orders::{Orders, TriedOrder, check_extremes, orders, try_orders};
use shelter::study::samples::run_sample::ShotToSample;
use shelter::study::samples::sample_count::Sampling;
use shelter::study::samples::sample_until_sure::sample_shots;
use shelter::study::samples::sampled_shot::SampledShot;
use shelter::study::size::{Demand, size};
use shelter::study::standing::Standing;
use shelter::study::sweep::{GAP, Point, Sweep, sweep};
use shelter::study::{Case, ComputeSettings, Context, FileState, Intervals, Shard};
use shelter::study::{ShotSummary, StudyControl};
use shelter::verdict::{Quantity, Verdict};

use super::support::{Edited, shelter, small_plan};

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
    if !more.contains("cable = ") {
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

fn judged(case: &Case, order: &[usize], interval: Time) -> ShotSummary {
    let compute = ComputeSettings::of(&case.plan);
    let shot = case.shot(order, interval, &HoleTiming::TOGETHER);
    let checked = check_shot(case, &shot, &compute, &mut |_| ControlFlow::Continue(()));
    ShotSummary::of(&checked.expect("a result"))
}

/// Every point has the verdict of `check`; at the intervals of the plan's options it has the very numbers.
#[test]
fn a_sweep_is_the_check_of_every_interval() {
    let case = case(3, "");
    let intervals = Intervals { from: Time::ZERO, to: Time::from_ms(60.0), step: Time::from_ms(7.0) };
    let swept = sweep(
        &Context::new(&case, ComputeSettings::of(&case.plan), &StudyControl::default()),
        &[0, 1, 2],
        &intervals,
        HoleTiming::TOGETHER,
    );
    let swept = swept.expect("a result").value;
    let verdict = |point: &Point| point.judged.planned.verdict;
    let (mut own, mut decided) = (0, 0);
    for point in &swept.points {
        let checked = judged(&case, &[0, 1, 2], point.interval);
        if [20.0, 45.0].map(Time::from_ms).contains(&point.interval) {
            own += 1;
            assert_eq!(point.judged.planned, checked);
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
    let shares: Vec<f64> = swept.points.iter().map(|p| p.judged.planned.utilization(&case.limits)).collect();
    let worst = swept.worst(&case).expect("points").judged.planned.utilization(&case.limits);
    assert_eq!(worst, shares.iter().copied().fold(0.0, f64::max));
    // Where the verdict changes, neighbours are 1/32 ms apart at most.
    for pair in swept
        .points
        .windows(2)
        .filter(|pair| (verdict(&pair[0]) == Verdict::Pass) != (verdict(&pair[1]) == Verdict::Pass))
    {
        assert!(pair[1].interval - pair[0].interval < Time::from_ms(0.032));
    }
    assert!(swept.largest_gap() <= GAP && swept.windows.iter().any(|&[from, to]| to - from > GAP * 10));
    // No digits that nobody asked for: whole nanoseconds.
    let shown = |point: &Point| format!("{}", point.interval.seconds());
    assert!(swept.points.iter().all(|point| shown(point).len() <= "0.000000001".len()));
    let recommended = swept.recommended.expect("a window");
    let near = |point: &&Point| {
        let (at, room) = (recommended.interval, recommended.room);
        (at - room..=at + room).contains(&point.interval)
    };
    for point in swept.points.iter().filter(near) {
        assert!(point.judged.planned.with_errors(1.0).utilization(&case.limits) <= recommended.utilization);
    }
}

/// Three rows with a limit on height [m] that some of their samples reach; accepted risk 5 %.
fn risky_case(height: f64) -> Case {
    let mut plan = plan(
        3,
        "uncertainty = { launch_common_percent = 3, friction = [0.45, 0.55], launch_row_cv_percent = 0, \
         launch_tilt_deg = 0, launch_tilt_common_deg = 0, launch_between_shots_percent = 0, hole_position_m = 0, \
         pattern_offset_m = 0, hole_fails_percent = 0, cable_length_m = 0 }",
    );
    plan.limits.flight_height_m = height;
    plan.limits.accepted_risk_percent = 5.0;
    Case::new(plan)
}

/// A sweep from 20 to 60 ms with up to 600 samples, its sampling and settings.
fn risky_sweep(case: &Case) -> (Sweep, Sampling, ComputeSettings) {
    let compute = ComputeSettings { accuracy: Accuracy::Draft, ..ComputeSettings::of(&case.plan) };
    let intervals =
        Intervals { from: Time::from_ms(20.0), to: Time::from_ms(60.0), step: Time::from_ms(10.0) };
    let sampling = Sampling { most: 600, ..Sampling::OF_VERDICT };
    let swept = sweep(
        &Context::new(case, compute, &StudyControl::default()).with_sampling(sampling),
        &[0, 1, 2],
        &intervals,
        HoleTiming::TOGETHER,
    );
    (swept.expect("a result").value, sampling, compute)
}

/// The samples of one interval, drawn alone.
fn risk_at(case: &Case, interval: Time, sampling: &Sampling, compute: ComputeSettings) -> SampledShot {
    let shot = case.shot(&[0, 1, 2], interval, &HoleTiming::TOGETHER);
    let target = ShotToSample::new(case, &shot, compute, *sampling);
    let found = sample_shots(&[target], &StudyControl::default());
    found.expect("samples").value.remove(0)
}

/// Windows worth a check, against the samples of each interval drawn alone.
#[test]
fn windows_of_accepted_risk_are_those_of_the_samples() {
    let case = risky_case(1.075);
    let (swept, sampling, compute) = risky_sweep(&case);
    let inside =
        |windows: &[[Time; 2]], at: Time| windows.iter().any(|[from, to]| (*from..=*to).contains(&at));
    let sampled: Vec<&Point> = swept.points.iter().filter(|point| point.is_sampled()).collect();
    let (mut accepted, mut refused) = (0, 0);
    for point in &sampled {
        assert!(inside(&swept.windows_as_planned, point.interval));
        let bounds = point.judged.risk.known().expect("sampled").bounds;
        // More samples have the few intervals that got a full verdict.
        if bounds.samples <= 100 {
            let first_look = sampling.for_screening().first_look();
            let alone = risk_at(&case, point.interval, &first_look, compute).bounds;
            assert_eq!(bounds, alone, "the same draws at every interval");
            let keeps = 20 * alone.failures <= alone.samples;
            assert_eq!(inside(&swept.windows, point.interval), keeps, "{}", point.interval);
            (accepted, refused) = (accepted + usize::from(keeps), refused + usize::from(!keeps));
        }
    }
    assert!(accepted > 5 && refused > 5, "a test that can fail: {accepted} {refused}");
    for pair in sampled.windows(2) {
        let [a, b] = [pair[0].interval, pair[1].interval];
        let joined = swept.windows.iter().any(|[from, to]| *from <= a && b <= *to);
        assert!(!joined || b - a <= Time::from_ms(1.01), "{a} {b}");
    }
}

/// The recommended interval passes as `check` judges it: as planned, and by as many samples as its verdict needs.
#[test]
fn the_recommended_interval_has_a_full_verdict() {
    let case = risky_case(1.10);
    let (swept, sampling, compute) = risky_sweep(&case);
    let best = swept.best().expect("a window");
    let shot = case.shot(&[0, 1, 2], best.interval, &HoleTiming::TOGETHER);
    let checked = check_shot(&case, &shot, &compute, &mut |_| ControlFlow::Continue(()));
    assert_eq!(
        (best.verdict(), best.judged.planned),
        (Verdict::Pass, ShotSummary::of(&checked.expect("a result")))
    );
    // The draws of the first look chose the interval; `check` has others, and so has the confirmation.
    let full = risk_at(&case, best.interval, &sampling, compute);
    assert_eq!(
        (full.verdict(), best.judged.risk.known().expect("sampled").bounds),
        (Verdict::Pass, full.bounds)
    );
    let confirms = |n: usize| {
        risk_at(&case, best.interval, &sampling.for_confirmation(n), compute).verdict() == Verdict::Pass
    };
    assert!((1..=1 + swept.failed_full_verdict).any(confirms));
}

/// A hundred samples of an interval may keep the accepted risk, and its full verdict does not pass: it is not recommended.
#[test]
fn an_interval_whose_full_verdict_does_not_pass_is_not_recommended() {
    let (swept, ..) = risky_sweep(&risky_case(1.065));
    let wide = swept.windows.iter().filter(|&&[from, to]| to - from > Time::from_ms(0.5)).count();
    assert!(wide > 0 && swept.failed_full_verdict > 1, "a test that can fail: {:?}", swept.windows);
    assert_eq!(swept.recommended, None);
}

/// The orders nearest each limit and the best have the samples of `risk`; the best has those of a verdict.
#[test]
fn the_ends_of_the_ranking_are_sampled() {
    let case = case(4, "uncertainty = { launch_cv_percent = 5 }");
    let compute = ComputeSettings { accuracy: Accuracy::Draft, ..ComputeSettings::of(&case.plan) };
    let (control, intervals) = (StudyControl::default(), [20.0, 45.0, 200.0].map(Time::from_ms));
    let sampling = Sampling { most: 500, ..Sampling::OF_VERDICT };
    let context = Context::new(&case, compute, &control);
    let orders = |sampling: Option<Sampling>| {
        orders(&context.with_sampling(sampling), &intervals, HoleTiming::TOGETHER)
    };
    let nominal = orders(None).expect("a result").value;
    let ranked = orders(Some(sampling)).expect("a result").value;
    assert_eq!((&ranked.ranked, ranked.ranked.len()), (&nominal.ranked, 72));
    let (mut least, mut full) = (0, 0);
    for (n, tried) in ranked.ranked.iter().enumerate() {
        assert_eq!(nominal.judged(n).verdict(), tried.planned.verdict);
        let Evidence::Known(risk) = ranked.judged(n).risk else {
            // The 10 nearest each of the two limits and the 20 best are.
            let nearer = |quantity| {
                let value = |tried: &TriedOrder| tried.planned.get(quantity).value;
                ranked.ranked.iter().filter(|other| value(other) > value(tried)).count()
            };
            let is_near =
                [Quantity::Height, Quantity::Force].into_iter().any(|quantity| nearer(quantity) < 10);
            assert!((1..52).contains(&n) && !is_near, "{n}");
            assert!(ranked.judged(n).verdict() != Verdict::Pass, "not sampled, so not sure");
            continue;
        };
        let few = risk.bounds.samples <= 100;
        (least, full) = (least + usize::from(few), full + usize::from(!few));
        let sampling = if few { sampling.for_screening().first_look() } else { sampling };
        let shot = case.shot(&tried.order, tried.interval, &HoleTiming::TOGETHER);
        let target = ShotToSample::new(&case, &shot, compute, sampling);
        let risks = sample_shots(&[target], &control).expect("samples").value;
        assert_eq!(risk.bounds, risks[0].bounds);
        let samples = ranked.judged(n).verdict().max(tried.planned.verdict);
        // Fresh draws confirm the best, or leave it open.
        let may_be_open = n == 71 && samples == Verdict::Undecided;
        assert!(may_be_open || samples == tried.planned.verdict.max(risks[0].verdict()));
    }
    // The worst as planned, that which fails most often, and the best.
    assert!((2..=3).contains(&full) && least >= 37, "{full} {least}");
}

/// Runs that end in the air tell neither that a rope holds nor that it does not.
#[test]
fn size_is_open_where_every_combination_is_as_planned() {
    let of = |duration: &str| {
        let case =
            case(2, &format!("simulation = {{ {duration} }}\ncable = {{ rope = \"GOST 2688-80 14 1960\" }}"));
        let compute = ComputeSettings { step: Some(1e-3), ..ComputeSettings::of(&case.plan) };
        let demand = Demand::Options(vec![0]);
        size(&Context::new(&case, compute, &StudyControl::default()), &case.plan.size, &demand)
            .expect("a result")
            .value
    };
    let [whole, cut] = ["", "duration_s = 0.1"].map(of);
    assert_eq!(whole.verdict(), Verdict::Pass);
    assert!(cut.lightest_choice().is_none() && cut.is_open_as_planned());
    assert_eq!(cut.verdict(), Verdict::Undecided);
}

/// With a swaged socket, which is for wire rope with a core of steel, no other rope is tried.
#[test]
fn size_offers_only_ropes_that_the_termination_fits() {
    let cable =
        "cable = { axial_stiffness_kn = 1400, breaking_force_kn = 60, termination = \"swaged socket\" }";
    let case = case(2, cable);
    let (demand, compute) = (Demand::Options(vec![0]), ComputeSettings::of(&case.plan));
    let compute = ComputeSettings { step: Some(2e-3), ..compute };
    let sizing = size(&Context::new(&case, compute, &StudyControl::default()), &case.plan.size, &demand)
        .expect("a result")
        .value;
    let offered = || sizing.combinations.iter().map(|combination| combination.rope);
    assert!(offered().all(|rope| rope.kind == Kind::SteelCore));
    let steel = catalogue().ropes.iter().filter(|rope| rope.kind == Kind::SteelCore).count();
    assert_eq!(offered().count(), steel);
}

/// A rope of the catalogue is weaker at its ends, as a plan with values of its own does not ask: `size` warns of the plan that it would write.
#[test]
fn size_warns_of_the_ends_of_the_rope_that_it_chooses() {
    let folder = tempfile::tempdir().expect("a folder");
    let plan = folder.path().join("plan.toml").to_string_lossy().into_owned();
    let text = small_plan()
        .edited("rope = \"GOST 2688-80 14 1960\"", "axial_stiffness_kn = 7193\nbreaking_force_kn = 118")
        .edited("termination = \"mechanical sleeve\"\n", "");
    std::fs::write(&plan, text).expect("written");
    for (ropes, is_warned) in [("Polyester", true), ("GOST 2688-80", false)] {
        let sized = shelter(&["size", &plan, "--nominal", "--accuracy", "draft", "--ropes", ropes]);
        let told = String::from_utf8_lossy(&sized.stderr).into_owned();
        // No wire rope holds, so that none is chosen.
        assert_eq!(told.contains("name the `termination`"), is_warned, "{told}");
    }
}

/// An option with firing times of its own is a point, too, where its rows fire at one interval.
#[test]
fn every_option_at_one_interval_is_a_point() {
    let mut plan = plan(3, "");
    plan.delays[0].timing = Timing::At([0.0, 31.0627, 62.1254].map(Time::from_ms).to_vec());
    let case = Case::new(plan);
    let compute = ComputeSettings::of(&case.plan);
    let intervals =
        Intervals { from: Time::from_ms(30.0), to: Time::from_ms(35.0), step: Time::from_ms(5.0) };
    let swept = sweep(
        &Context::new(&case, compute, &StudyControl::default()),
        &[0, 1, 2],
        &intervals,
        HoleTiming::TOGETHER,
    )
    .expect("a result")
    .value;
    let point = swept.points.iter().find(|point| point.interval == Time::from_ms(31.0627));
    let checked = check_as_planned(&case, 0, &compute, &mut |_| ControlFlow::Continue(())).expect("a result");
    assert_eq!(point.expect("the option is tried").judged.planned, ShotSummary::of(&checked));
}

/// All orders stand in the ranking once, with the verdict of `check`; the worst and the best have the very numbers.
#[test]
fn orders_find_the_worst_and_the_best_of_brute_force() {
    let case = case(4, "");
    for interval in [20.0, 45.0, 200.0].map(Time::from_ms) {
        let compute = ComputeSettings::of(&case.plan);
        let tried = try_orders(
            &Context::new(&case, compute, &StudyControl::default()),
            &[interval],
            HoleTiming::TOGETHER,
            Shard::WHOLE,
        )
        .expect("a result");
        let ranked = Orders::new(&case, tried.value, 1, HoleTiming::TOGETHER).ranked;
        let share = |judged: &ShotSummary| judged.utilization(&case.limits);
        let brute: HashMap<Vec<usize>, ShotSummary> =
            (0..4).permutations(4).map(|order| (order.clone(), judged(&case, &order, interval))).collect();
        assert_eq!(ranked.len(), 24);
        for tried in ranked.iter().filter(|tried| tried.planned.verdict != Verdict::Undecided) {
            assert_eq!(tried.planned.verdict, brute[&tried.order].verdict);
        }
        let all = || brute.values().map(share);
        let [worst, best] = [&ranked[0], &ranked[23]];
        assert_eq!(share(&worst.planned), all().fold(0.0, f64::max));
        assert_eq!(share(&best.planned), all().fold(f64::INFINITY, f64::min));
        assert_eq!(worst.planned, brute[&worst.order]);
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
    let tried = TriedOrder {
        number: 0,
        order: order.clone(),
        interval: Time::from_ms(45.0),
        planned: ShotSummary::FAILED_RUN,
    };
    let compute = ComputeSettings::of(&case.plan);
    let refined = check_extremes(
        &Context::new(&case, compute, &StudyControl::default()),
        &HoleTiming::TOGETHER,
        vec![tried],
    )
    .expect("a result")
    .value;
    assert_eq!(refined[0].planned, judged(&case, &order, Time::from_ms(45.0)));
}

/// With a fixed step no study chooses steps of its own.
#[test]
fn a_fixed_step_is_the_step_of_every_shot() {
    let case = case(3, "");
    let compute = ComputeSettings { step: Some(1e-3), ..ComputeSettings::of(&case.plan) };
    let fixed = |order: &[usize], interval: Time| {
        let shot = case.shot(order, interval, &HoleTiming::TOGETHER);
        let checked = check_shot(&case, &shot, &compute, &mut |_| ControlFlow::Continue(()));
        ShotSummary::of(&checked.expect("a result"))
    };
    let control = StudyControl::default();
    let tried = try_orders(
        &Context::new(&case, compute, &control),
        &[Time::from_ms(45.0)],
        HoleTiming::TOGETHER,
        Shard::WHOLE,
    )
    .expect("a result")
    .value;
    assert_eq!(tried.len(), 6);
    for tried in tried {
        assert_eq!(tried.planned, fixed(&tried.order, tried.interval));
    }
    let intervals =
        Intervals { from: Time::from_ms(30.0), to: Time::from_ms(31.0), step: Time::from_ms(1.0) };
    let swept = sweep(&Context::new(&case, compute, &control), &[0, 1, 2], &intervals, HoleTiming::TOGETHER)
        .expect("a result")
        .value;
    for point in swept.points {
        assert_eq!(point.judged.planned, fixed(&[0, 1, 2], point.interval));
    }
}

/// Where the shelter is its own mirror image, an order and its mirrored order have the same result, computed once.
#[test]
fn mirrored_orders_are_judged_once() {
    let case = mirrored_case();
    let compute = ComputeSettings::of(&case.plan);
    let control = StudyControl::default();
    let tried = try_orders(
        &Context::new(&case, compute, &control),
        &[Time::from_ms(45.0)],
        HoleTiming::TOGETHER,
        Shard { index: 0, count: 2 },
    )
    .expect("a result")
    .value;
    let other = try_orders(
        &Context::new(&case, compute, &control),
        &[Time::from_ms(45.0)],
        HoleTiming::TOGETHER,
        Shard { index: 1, count: 2 },
    )
    .expect("a result")
    .value;
    assert_eq!(control.counts(), (12, 12));
    let by_order: HashMap<&[usize], &TriedOrder> =
        tried.iter().chain(&other).map(|tried| (tried.order.as_slice(), tried)).collect();
    assert_eq!(by_order.len(), 24);
    for (number, order) in (0..4).permutations(4).enumerate() {
        let mirrored: Vec<usize> = order.iter().map(|row| 3 - row).collect();
        let [one, image] = [&order, &mirrored].map(|order| by_order[order.as_slice()]);
        assert_eq!((one.number, one.planned), (number, image.planned));
        let brute = judged(&case, &order, Time::from_ms(45.0));
        assert!(
            (one.planned.values.height.value - brute.values.height.value).abs()
                < one.planned.values.height.error + brute.values.height.error
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
    let tried = try_orders(
        &Context::new(&case, ComputeSettings::of(&case.plan), &StudyControl::default()),
        &[Time::from_ms(2.0)],
        HoleTiming::TOGETHER,
        Shard::WHOLE,
    );
    let tried = tried.expect("a result").value;
    assert!(tried.len() > 1000);
    let different: HashSet<&[usize]> = tried.iter().map(|t| t.order.as_slice()).collect();
    assert_eq!(different.len(), tried.len());
    let listed: Vec<usize> = (0..rows).collect();
    let reversed: Vec<usize> = (0..rows).rev().collect();
    assert_eq!([&tried[0].order, &tried[1].order], [&listed, &reversed]);
    let share = |tried: &TriedOrder| tried.planned.utilization(&case.limits);
    let by_order: HashMap<&[usize], f64> = tried.iter().map(|t| (t.order.as_slice(), share(t))).collect();
    let ranked = Orders::new(&case, tried.clone(), 1, HoleTiming::TOGETHER).ranked;
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
            let exchanged = |tried: &TriedOrder| {
                let mut order = tried.order.clone();
                order.swap(a, b);
                *by_order.get(order.as_slice()).expect("the exchange is tried")
            };
            assert!(exchanged(worst) <= share(worst) && exchanged(best) >= share(best));
        }
    }
}

/// The lightest combination under which every option passes as planned, and surely few enough of its samples fail: as written, and
/// with tires that leave with the same velocity, or with the same momentum, as those of the plan.
#[test]
fn the_lightest_shelter_is_that_of_brute_force() {
    let family = "EN 12385-4 6x19 FC";
    let more = format!("size = {{ tire_mass_kg = [150, 400], ropes = \"{family}\", most_border_rows = 1 }}")
        + "\ncable = { rope = \"GOST 2688-80 6.2\" }\nuncertainty = { launch_cv_percent = 3 }";
    let mut plan = plan(2, &more);
    let Layout::Grid(mesh) = &mut plan.layout else { panic!("a grid") };
    (mesh.rows, mesh.columns) = (4, 2);
    // So that the thinnest rope holds as planned, and not in enough of its samples.
    plan.limits.cable_safety_factor = 2.6;
    // The more is accepted, the fewer samples a verdict takes.
    plan.limits.accepted_risk_percent = 10.0;
    let compute = ComputeSettings { accuracy: Accuracy::Draft, ..ComputeSettings::of(&plan) };
    let demand = Demand::Options(vec![0, 1]);
    let sampling = Sampling { least: 0, most: 200, ..Sampling::OF_VERDICT };
    let (planned, control) = (Case::new(plan.clone()), StudyControl::default());
    let context = Context::new(&planned, compute, &control).with_sampling(sampling);
    let sizing = size(&context, &plan.size, &demand);
    let sizing = sizing.expect("a result").value;
    let ropes = catalogue().ropes.iter().filter(|rope| rope.family == family);
    let combinations = itertools::iproduct!(ropes, [150.0, 400.0], 0..=1).map(|(rope, mass, border)| {
        let with_exponents = |exponents: [f64; 2]| {
            let mut plan = plan.clone();
            plan.uncertainty.launch_mass_exponent = exponents;
            Case::new(plan.with_sizes(rope, mass, border))
        };
        let cases = [[0.0, 1.0], [0.0, 0.0], [1.0, 1.0]].map(with_exponents);
        let length: f64 = cases[0].scene().cables.iter().map(|cable| cable.rest_length).sum();
        (cases[0].scene().tire_count() as f64 * mass + length * rope.mass_kg_per_m, cases)
    });
    let (mut lightest, mut fragile) = (f64::INFINITY, 0);
    for (total, cases) in combinations.sorted_by(|a, b| a.0.total_cmp(&b.0)) {
        let control = StudyControl::default();
        let contexts =
            cases.each_ref().map(|case| Context::new(case, compute, &control).with_sampling(sampling));
        let results = judge(&contexts, Depth::Unconfirmed, None);
        let results = results.expect("a result").value.concat();
        if results.iter().flatten().all(|judged| judged.verdict() == Verdict::Pass) {
            lightest = total;
            break;
        }
        let passes_as_planned = |judged: &Judgement| judged.checked.verdict == Verdict::Pass;
        fragile += usize::from(results.iter().flatten().all(passes_as_planned));
    }
    let found = sizing.lightest_choice().map_or(f64::INFINITY, |found| found.total_mass);
    assert!((found - lightest).abs() <= 1e-9 * lightest || found == lightest, "{found} {lightest}");
    assert!(lightest.is_finite() && fragile > 0, "the test sizes nothing: {lightest} {fragile}");
    let margins: Vec<f64> = sizing.choices().filter_map(|c| Some(c.trial.ok()?.utilization)).collect();
    assert!(margins.windows(2).all(|pair| pair[1] < pair[0]), "{margins:?}");
}

/// A row of two tires fired twice, 0.3 s apart or 3 s.
const FIRED_TWICE: &str = "shelter = { layout = \"grid\", rows = 1, columns = 2, spacing_m = 2 }\ntire = { mass_kg = 280 }\n\
                cable = { axial_stiffness_kn = 1000, breaking_force_kn = 60, slack_percent = 3 }\n\
                ground = { friction = 0.5 }\nlimits = { flight_height_m = 9, cable_safety_factor = 1 }\n\
                blast_row = [{ name = \"1\", under_row = 1, launch_m_s = 6 }, \
                             { name = \"2\", under_row = 1, launch_m_s = 1, tilt_deg = 30 }]\n\
                delay = [{ name = \"again\", interval_ms = 300 }, { name = \"late\", interval_ms = 3000 }]\n";

/// With tires that fly apart from each other: at the second hole each is V₀ t − g t²/2 high.
#[test]
fn holes_under_tires_in_the_air_are_counted() {
    let case = Case::new(Plan::parse("", FIRED_TWICE).unwrap_or_else(|mistakes| panic!("{mistakes}")));
    let compute = ComputeSettings::of(&case.plan);
    let [again, late] = [0, 1].map(|option| case.check_as_planned(option, &compute).expect("a result"));
    assert_eq!((again.cover.holes, again.cover.uncovered, again.cover.shift), (4, 2, 0.0));
    let height = 6.0 * 0.3 - 0.5 * 9.81 * 0.09;
    // The tires fly for up to a step longer.
    assert!((again.cover.height - height).abs() <= 3.1 * again.step, "{:?}", again.cover);
    assert_eq!((late.cover.uncovered, late.cover.height), (0, 0.0));
}

/// The model gives a tire in the air the whole launch: whoever reads a result of any study must learn that.
#[test]
fn every_study_warns_of_holes_under_tires_in_the_air() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("twice.toml");
    let sizes = "size = { tire_mass_kg = [280], ropes = \"GOST 2688-80\" }\n";
    // At 2 m/s they are 0.16 m high then, less than a quarter of the 2 m between them.
    let low = FIRED_TWICE.replace("launch_m_s = 6", "launch_m_s = 2");
    std::fs::write(&path, format!("{low}{sizes}")).expect("written");
    let path = path.to_str().expect("UTF-8");
    for arguments in [
        vec!["check", path],
        vec!["sweep", path, "--interval", "280..300:20"],
        vec!["orders", path, "--interval", "300..300:1"],
        vec!["search", path],
        vec!["size", path, "--option", "again"],
        vec!["report", path, "--output", "-"],
    ] {
        let output = shelter(&[&arguments[..], &["--nominal", "--accuracy", "draft"]].concat());
        let told = [&output.stdout, &output.stderr].map(|told| String::from_utf8_lossy(told).into_owned());
        let told_of_holes = |told: &String| told.contains("fire under a tire in the air");
        assert!(told.iter().all(told_of_holes), "{arguments:?}: {told:?}");
    }
    // At 6 m/s they are 1.36 m high: no interval passes, and the sweep says why.
    std::fs::write(path, FIRED_TWICE).expect("written");
    let output = shelter(&["sweep", path, "--interval", "280..300:20", "--nominal", "--accuracy", "draft"]);
    let told = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(told.contains("at 2 of 2 intervals tried a hole fires where no tire lies any more"), "{told}");
}

/// A study says itself whether its time was up before all shots were judged.
#[test]
fn a_study_without_time_is_partial() {
    let case = case(2, "uncertainty = { launch_cv_percent = 10 }");
    let compute = ComputeSettings { step: Some(2e-3), ..ComputeSettings::of(&case.plan) };
    let intervals = Intervals { from: Time::ZERO, to: Time::from_ms(20.0), step: Time::from_ms(10.0) };
    let (three, demand) = (Sampling::exactly(3, 1), Demand::Options(vec![0, 1]));
    let partial = |control: &StudyControl| {
        [
            sweep(&Context::new(&case, compute, control), &[0, 1], &intervals, HoleTiming::TOGETHER)
                .map(|found| found.partial),
            try_orders(
                &Context::new(&case, compute, control),
                &[Time::from_ms(20.0)],
                HoleTiming::TOGETHER,
                Shard::WHOLE,
            )
            .map(|found| found.partial),
            size(&Context::new(&case, compute, control).with_sampling(three), &case.plan.size, &demand)
                .map(|found| found.partial),
            judge(&[Context::new(&case, compute, control)], Depth::Unconfirmed, None)
                .map(|found| found.partial),
            judge(&[Context::new(&case, compute, control).with_sampling(three)], Depth::Unconfirmed, None)
                .map(|found| found.partial),
        ]
    };
    let out_of_time = StudyControl::default();
    out_of_time.expire();
    assert_eq!(partial(&out_of_time), [const { Ok(true) }; 5]);
    assert_eq!(partial(&StudyControl::default()), [const { Ok(false) }; 5]);
}

/// The time is up once a shot is checked as planned: of its samples nothing is known, in the document, too.
#[test]
fn where_no_sample_was_drawn_any_share_may_fail() {
    let mut case = case(2, "uncertainty = { launch_cv_percent = 10 }");
    case.plan.limits.withstands_one_dud = false;
    let compute = ComputeSettings { step: Some(2e-3), ..ComputeSettings::of(&case.plan) };
    let control = StudyControl::default();
    let expire = |_: CaseOption, event: JudgeEvent<'_>| {
        if matches!(event, JudgeEvent::Checked(_)) {
            control.expire();
        }
    };
    let found = judge(
        &[Context::new(&case, compute, &control).with_sampling(Sampling::OF_VERDICT)],
        Depth::Unconfirmed,
        Some(&expire),
    )
    .expect("a result");
    // Which of the options is checked before the time is up is left to the threads.
    let first = found.value[0].iter().position(Result::is_ok).expect("one was checked");
    let judged = found.value[0][first].as_ref().expect("it was");
    assert!(found.partial && judged.sampled.is_asked() && judged.sampled.known().is_none());
    assert_ne!(judged.verdict(), Verdict::Pass);
    assert!(judged.reasons().contains(&Reason::NoSamples));
    let report = report::check::report_of_plan(
        &case,
        &found.value[0],
        None,
        MustPass::Every,
        (&Standing::of(&case, FileState::AsJudged, Comparison::nothing_seen()), &[]),
        true,
    );
    let text = report::json::json(&[report]).expect("a document");
    let document: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let option = &document["options"][first];
    let nothing = serde_json::json!({ "low": 0.0, "high": 1.0, "samples": 0, "undecided": 0 });
    assert_eq!(option["failure_probability"], nothing);
    assert_eq!(option["any_cable_breaks"], serde_json::json!({ "low": 0.0, "high": 1.0 }));
}

#[test]
fn a_stopped_study_has_no_result() {
    let case = case(3, "");
    let control = StudyControl::default();
    control.stop();
    assert!(
        try_orders(
            &Context::new(&case, ComputeSettings::of(&case.plan), &control),
            &[Time::from_ms(20.0)],
            HoleTiming::TOGETHER,
            Shard::WHOLE
        )
        .is_err()
    );
}

/// With more orders than are sampled nobody can say that every one passes, though all keep the limits as planned; with fewer it may.
#[test]
fn orders_pass_only_where_each_is_sampled() {
    let case = case(4, "uncertainty = { launch_common_percent = 2 }");
    let mut plan = case.plan.clone();
    plan.launches_mut().for_each(|launch| launch.speed_m_s = 1.0);
    let case = Case::new(plan);
    let compute = ComputeSettings { accuracy: Accuracy::Draft, ..ComputeSettings::of(&case.plan) };
    let control = StudyControl::default();
    let context = Context::new(&case, compute, &control).with_sampling(Sampling::OF_VERDICT);
    let of = |intervals: &[f64]| {
        let intervals: Vec<Time> = intervals.iter().map(|&interval| Time::from_ms(interval)).collect();
        let found = orders(&context, &intervals, HoleTiming::TOGETHER).expect("a result");
        (found.value.ranked.len(), found.value.not_sampled(), found.verdict())
    };
    assert_eq!(of(&[20.0]), (24, 0, Verdict::Pass));
    let (count, not_sampled, verdict) = of(&[20.0, 45.0, 200.0]);
    assert!(count == 72 && not_sampled > 0, "{count} {not_sampled}");
    assert_eq!(verdict, Verdict::Undecided);
}

/// The order 3 2 1 fails with a dud, though it is not the worst as planned: an order with a few samples passes nothing.
#[test]
fn orders_pass_only_where_each_has_a_full_verdict() {
    let case = Case::load("tests/fixtures/dud-in-one-order.toml".as_ref()).expect("a plan");
    let control = StudyControl::default();
    let compute = ComputeSettings { accuracy: Accuracy::Draft, ..ComputeSettings::of(&case.plan) };
    let context = Context::new(&case, compute, &control).with_sampling(Sampling::OF_VERDICT);
    let found = orders(&context, &[Time::from_ms(25.0)], HoleTiming::TOGETHER).expect("a result");
    let rank = found.value.ranked.iter().position(|tried| tried.order == [2, 1, 0]).expect("tried");
    assert!(rank > 0 && found.value.ranked.iter().all(|tried| tried.planned.verdict == Verdict::Pass));
    assert_eq!(found.value.judged(rank).verdict(), Verdict::Fail);
    assert_eq!(found.verdict(), Verdict::Fail);
}
