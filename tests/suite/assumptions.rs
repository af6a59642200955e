//! What a PASS stands on: where each assumption ends, against closed forms on lone tires and against the draws themselves.

use std::ops::ControlFlow;

use shelter::outcome::Outcome;
use shelter::plan::{Plan, PlanSource};
use shelter::simulation::Motion;
use shelter::study::as_planned::quick_check::quick_check;
use shelter::study::assumptions::assumed::{Assumed, Ranged, Side, Spread, Toward};
use shelter::study::assumptions::{
    Assumption, Assumptions, Extent, NEAREST, SAMPLES, find_assumptions, find_these,
};
use shelter::study::samples::random_shot::{DrawnShot, Input, draw_shot};
use shelter::study::samples::sample_count::Sampling;
use shelter::study::standing::verdict_word::ThinPass;
use shelter::study::{Case, ComputeSettings, Context, StudyControl, thread_pool};
use shelter::verdict::Verdict;

use super::support::scenes::GRAVITY;
use super::support::{AS_DRAWN, json, shelter, text};

const SAMPLING: Sampling = Sampling::exactly(SAMPLES, 1);
/// Speed of every launch [m/s].
const SPEED: f64 = 6.0;

/// A shelter with these blast rows and limits; of all that is not named in `unknown`, everything is known exactly.
fn plan(shelter: &str, rows: &str, limits: &str, unknown: &[(&str, &str)]) -> String {
    let known = "delay_sd_ms = 0\nlaunch_cv_percent = 0\nlaunch_common_percent = 0\ntire_mass_cv_percent = 0\n\
                 friction = [0.5, 0.5]\nslack_percent = [2, 2]\naxial_stiffness_percent = [0, 0]\n\
                 launch_mass_exponent = [1, 1]\nlaunch_between_shots_percent = 0\n";
    let mut exact = format!("{known}{AS_DRAWN}");
    for (key, value) in unknown {
        let line =
            exact.lines().find(|line| line.starts_with(&format!("{key} = "))).expect("a key").to_owned();
        exact = exact.replace(&line, &format!("{key} = {value}"));
    }
    format!(
        "tire = {{ mass_kg = 280 }}\nground = {{ friction = 0.5 }}\n\
         cable = {{ axial_stiffness_kn = 1400, breaking_force_kn = 10, slack_percent = 2 }}\n\
         limits = {{ cable_safety_factor = 1, {limits} }}\n\
         delay = [{{ name = \"20 ms\", interval_ms = 20 }}]\n{rows}\n{shelter}\n[uncertainty]\n{exact}"
    )
}

fn case(text: &str) -> Case {
    Case::new(Plan::parse("plan.toml", text).unwrap_or_else(|mistakes| panic!("{mistakes}")))
}

const LONE: &str = "shelter = { layout = \"grid\", rows = 1, columns = 1, spacing_m = 1.5 }";
const ROW: &str = "blast_row = [{ name = \"1\", under_row = 1, launch_m_s = 6 }]";

/// One tire that must not fly above `height` [m].
fn lone(height: f64, unknown: &[(&str, &str)]) -> Case {
    case(&plan(LONE, ROW, &format!("flight_height_m = {height}"), unknown))
}

fn find(case: &Case, extent: Extent, samples: usize) -> Assumptions {
    let (compute, control) = (ComputeSettings::of(&case.plan), StudyControl::default());
    let context = Context::new(case, compute, &control).with_sampling(Sampling::exactly(samples, 1));
    find_assumptions(&context, 0, extent).expect("a result").value
}

fn find_only<const N: usize>(case: &Case, assumed: [Assumed; N]) -> Assumptions {
    let (compute, control) = (ComputeSettings::of(&case.plan), StudyControl::default());
    let context = Context::new(case, compute, &control).with_sampling(SAMPLING);
    find_these(&context, 0, assumed.into_iter(), Extent::All).expect("a result").value
}

fn of(found: &Assumptions, assumed: Assumed) -> Assumption {
    *found.all.iter().find(|found| found.assumed == assumed).expect("it is tried")
}

/// A fine run of the shot as planned.
fn as_planned(case: &Case) -> Outcome {
    let settings = case.run_settings(case.plan.simulation.method, 1e-4);
    let run = |_: &dyn Motion| ControlFlow::Continue(());
    case.model.run(&case.shots[0], &settings, &mut { run }).expect("a run")
}

/// Number of the draws of a study of which this holds.
fn count_draws(case: &Case, sampling: Sampling, holds: impl Fn(&DrawnShot) -> bool) -> usize {
    let seed = sampling.for_assumptions().seed;
    (0..sampling.most).filter(|&number| holds(&draw_shot(case, &case.shots[0], seed, number))).count()
}

/// Both ends of the step in which an assumption fails.
fn ends(found: &Assumptions, assumed: Assumed) -> [f64; 2] {
    let Assumption { passes_until, fails_from, .. } = of(found, assumed);
    [passes_until.expect("it passes"), fails_from.expect("it fails")]
}

/// A lone tire rises V0²/2g: with nothing else unknown it fails where that is past the limit.
#[test]
fn launches_end_where_a_lone_tire_flies_too_high() {
    for limit in [1.95, 5.0] {
        let found = find_only(&lone(limit, &[]), [Assumed::LaunchVelocity]);
        let exact = (2.0 * GRAVITY * limit).sqrt() / SPEED;
        let [until, from] = ends(&found, Assumed::LaunchVelocity);
        assert!(until < exact && exact < from, "{until} {exact} {from}");
        assert!(from - until < 0.21, "values lie close");
    }
}

/// A shot that flies higher than the limit with probability p, and of 300 draws at most 3 may: what passes has p below 3.3 %, what fails
/// p above 0.28 % (else a binomial count would be that small, or that large, in less than 1 of 100). The draws themselves tell more:
/// the first value at which 4 of them fly too high by V0²/2g is the one that fails.
#[test]
fn the_estimate_of_launches_ends_at_its_quantile() {
    let limit: f64 = 2.3;
    let case = lone(limit, &[("launch_common_percent", "2")]);
    let [spread, shot_by_shot] = [Spread::LaunchCommon, Spread::LaunchBetweenShots].map(Assumed::Spread);
    let found = find_only(&case, [spread, shot_by_shot]);
    let [until, from] = ends(&found, spread);
    let exceeds = |cv_percent: f64| {
        let variance = (cv_percent * 1e-2).powi(2).ln_1p();
        let rise = ((2.0 * GRAVITY * limit).sqrt() / SPEED).ln();
        let deviations = (rise + 0.5 * variance) / variance.sqrt();
        0.5 * libm::erfc(deviations / std::f64::consts::SQRT_2)
    };
    assert!(exceeds(until) < 0.033 && exceeds(from) > 0.0028, "{until} {from}");
    let too_high = |cv_percent: f64| {
        let mut varied = case.clone();
        varied.plan.uncertainty.launch_common_percent = cv_percent;
        count_draws(&varied, SAMPLING, |drawn| {
            drawn.shot.firings[0].launch.z.powi(2) / (2.0 * GRAVITY) > limit
        })
    };
    assert!(too_high(until) <= 3 && too_high(from) > 3, "{} {}", too_high(until), too_high(from));
    assert_eq!(of(&found, spread).ratio, Some(from / 2.0));
    // Shot by shot is another such factor, known exactly here: what passes with it has few draws that fly too high.
    let other = of(&found, shot_by_shot).passes_until.expect("it passes");
    assert!(exceeds(other.hypot(2.0)) < 0.033, "{other}");
}

/// Three tires 1.5 m apart, of which the second and the third are tied: a hole under the first tears nothing. Where the shelter lies
/// more than half of that toward -x, the second tire is over the hole, and pulls at its cable. Toward the other sides no tire is
/// left over it.
#[test]
fn a_shelter_laid_aside_ends_where_the_next_tire_is_nearer() {
    let shelter = "[shelter]\nlayout = \"list\"\ncable = [{ from = 2, to = 3 }]\n\
                   tire = [{ x_m = 0, y_m = 0 }, { x_m = 1.5, y_m = 0 }, { x_m = 3, y_m = 0 }]";
    let hole =
        "blast_row = [{ name = \"1\", holes = [{ x_m = 0, y_m = 0, launch_m_s = 6, push_depth_m = 1000 }] }]";
    let toward = [Toward::MinusX, Toward::PlusX, Toward::PlusY, Toward::MinusY].map(Assumed::Place);
    let offset = Assumed::Spread(Spread::PatternOffset);
    let [a, b, c, d] = toward;
    let found = find_only(&case(&plan(shelter, hole, "flight_height_m = 3", &[])), [a, b, c, d, offset]);
    assert!(found.pass_as_stated());
    for place in toward {
        assert_eq!(ends(&found, place), [0.7, 1.0], "0.75 m, {place:?}");
    }
    // Drawn offsets: 300 of a spread of which 4 lie beyond 0.75 m toward -x, and none of a spread of a tenth.
    let spread = of(&found, offset);
    assert_eq!(spread.fails_from, None, "ten times 0.01 m");
}

/// A hole under a tire of 280 kg lifts it by 1.8 m; the tire of 35 kg beside it leaves eight times as fast, by momentum.
#[test]
fn a_shelter_laid_aside_ends_where_a_lighter_tire_is_nearer() {
    let shelter = "[shelter]\nlayout = \"list\"\ncable = []\n\
                   tire = [{ x_m = 0, y_m = 0 }, { x_m = 1.5, y_m = 0, mass_kg = 35 }]";
    let hole = "blast_row = [{ name = \"1\", holes = [{ x_m = 0, y_m = 0, launch_m_s = 6 }] }]";
    let aside = Assumed::Place(Toward::MinusX);
    let found = find_only(&case(&plan(shelter, hole, "flight_height_m = 3", &[])), [aside]);
    assert_eq!(ends(&found, aside), [0.7, 1.0], "0.75 m");
}

/// A tire 0.1 m beside its hole comes as far as the line of its push says: V² sin 2θ/g in flight, then it slides.
#[test]
fn a_shallow_push_ends_where_the_tire_comes_too_far() {
    let hole = "blast_row = [{ name = \"1\", holes = [{ x_m = -0.1, y_m = 0, launch_m_s = 6, push_depth_m = 0.8 }] }]";
    let limit = 2.0;
    let limits = format!("flight_height_m = 3, drift_m = {limit}");
    let found = find_only(&case(&plan(LONE, hole, &limits, &[])), [Assumed::PushDepth]);
    let range = |depth: f64| {
        let (angle, friction) = ((0.1 / depth).atan(), 0.5);
        let slide = (SPEED * angle.sin() - friction * SPEED * angle.cos()).max(0.0);
        SPEED.powi(2) * (2.0 * angle).sin() / GRAVITY + slide.powi(2) / (2.0 * friction * GRAVITY)
    };
    let [until, from] = ends(&found, Assumed::PushDepth);
    assert!(range(until) < limit && limit < range(from), "{} {}", range(until), range(from));
    assert!(from < until && until < 0.8);
}

/// A row of two tied tires moves as one; a dud pulls at the cable. At most 3 of 300 draws may have exactly one dud.
#[test]
fn duds_end_where_too_many_draws_have_one() {
    let two = "shelter = { layout = \"grid\", rows = 1, columns = 2, spacing_m = 1.5 }";
    let case = case(&plan(two, ROW, "flight_height_m = 3", &[("hole_fails_percent", "0.5")]));
    let found = find_only(&case, [Assumed::Spread(Spread::Duds)]);
    let [until, from] = ends(&found, Assumed::Spread(Spread::Duds));
    let lost = |percent: f64| {
        let mut varied = case.clone();
        varied.plan.uncertainty.hole_fails_percent = percent;
        let duds = Input::ALL.iter().position(|input| *input == Input::Duds).expect("an input");
        count_draws(&varied, SAMPLING, |drawn| drawn.inputs[duds] == 1.0)
    };
    assert!(lost(until) <= 3 && lost(from) > 3, "{until}: {}, {from}: {}", lost(until), lost(from));
}

/// Two tied tires of which one is launched: its height comes near the limit, the force of the cable does not, unless a draw has a weak
/// one. The first value at which more than 3 of 300 draws do is the one that fails.
#[test]
fn weak_cables_end_a_pass_whose_heights_come_nearer_to_their_limit() {
    let two = "shelter = { layout = \"grid\", rows = 1, columns = 2, spacing_m = 1.5 }";
    let hole = "blast_row = [{ name = \"1\", holes = [{ x_m = 0, y_m = 0, launch_m_s = 6 }] }]";
    let with_limits = |height: f64, breaking_kn: f64| {
        let limits = format!("flight_height_m = {height}");
        let unknown = "[uncertainty]\nbreaking_force_cv_percent = 3";
        let text = plan(two, hole, &limits, &[]).replace("[uncertainty]", unknown);
        case(&text.replace("breaking_force_kn = 10", &format!("breaking_force_kn = {breaking_kn}")))
    };
    let outcome = as_planned(&with_limits(5.0, 500.0));
    let weakest = 0.75;
    let case = with_limits(outcome.height.value / 0.98, 1e-3 * outcome.force.value / weakest);
    let (compute, control) = (ComputeSettings::of(&case.plan), StudyControl::default());
    let strengths = Assumed::Spread(Spread::BreakingForce);
    for seed in 1..=8 {
        let sampling = Sampling::exactly(SAMPLES, seed);
        let context = Context::new(&case, compute, &control).with_sampling(sampling);
        let found = find_these(&context, 0, [strengths].into_iter(), Extent::All).expect("a result").value;
        let [until, from] = ends(&found, strengths);
        let weak = |cv_percent: f64| {
            let mut varied = case.clone();
            varied.plan.uncertainty.breaking_force_cv_percent = cv_percent;
            count_draws(&varied, sampling, |drawn| drawn.scene.strength[0] < weakest)
        };
        let counts = [weak(until), weak(from)];
        assert!(counts[0] <= 3 && counts[1] > 3, "seed {seed}: {until}, {from}: {counts:?}");
    }
}

/// A tire that is pushed aside slides too far in the draws of the lowest friction. Beside it a tire pulls another along, and its cable is
/// near its limit, the nearer the more friction holds that other: the draws that come nearest to a limit as stated are those that slide
/// least. The first value at which more than 3 of 300 draws slide too far is the one that fails, wherever the limit is.
#[test]
fn the_draws_of_the_lowest_friction_end_a_pass_whose_nearest_draws_have_the_highest() {
    let shelter = "[shelter]\nlayout = \"list\"\ncable = [{ from = 2, to = 3 }]\n\
                   tire = [{ x_m = 0, y_m = 0 }, { x_m = 20, y_m = 0 }, { x_m = 21.5, y_m = 0 }]";
    let holes = "blast_row = [{ name = \"1\", holes = [\n\
                 { x_m = -0.2, y_m = 0, launch_m_s = 6, push_depth_m = 0.2 },\n\
                 { x_m = 20, y_m = 0, launch_m_s = 4, tilt_deg = 45, tilt_toward_deg = 180 }] }]";
    let low = Assumed::Range(Ranged::Friction, Side::Low);
    // The velocity across and up; flight, then sliding.
    let speed = SPEED * std::f64::consts::FRAC_1_SQRT_2;
    let drift = |friction: f64| {
        let slide = speed * (1.0 - friction);
        (2.0 * speed.powi(2) + slide.powi(2) / (2.0 * friction)) / GRAVITY
    };
    let with_limits = |drift: f64, breaking_kn: f64| {
        let limits = format!("flight_height_m = 5, drift_m = {drift}");
        let text = plan(shelter, holes, &limits, &[("friction", "[0.45, 0.5]")]);
        case(&text.replace("breaking_force_kn = 10", &format!("breaking_force_kn = {breaking_kn}")))
    };
    let force = 1e-3 * as_planned(&with_limits(50.0, 500.0)).force.value;
    for n in 0..12 {
        let limit = drift(0.43 - 0.01 * f64::from(n));
        let case = with_limits(limit, force / 0.98);
        let [until, from] = ends(&find_only(&case, [low]), low);
        let too_far = |lowest: f64, limit: f64| {
            let mut varied = case.clone();
            varied.plan.uncertainty.friction[0] = lowest;
            count_draws(&varied, SAMPLING, |drawn| drawn.shot.friction.is_some_and(|it| drift(it) > limit))
        };
        let counts = [too_far(until, 1.001 * limit), too_far(from, 0.999 * limit)];
        assert!(counts[0] <= 3 && counts[1] > 3, "{limit}: {until}, {from}: {counts:?}");
    }
}

/// Samples that fail by what no limit tells: sixty lone tires are launched, and how fast the first one is, `launches` [m/s] with the others
/// and `interval` [ms] later, decides. The first value of the spread at which more than 1 of 300 draws are faster than `fastest` [m/s]
/// is the one that fails.
fn the_first_tire_ends_a_pass(launches: [Option<f64>; 2], interval: f64, more: &str, fastest: f64) {
    let place = |n: usize| format!("x_m = {}, y_m = 0", 3 * n);
    let tires: Vec<String> = (0..60).map(|n| format!("{{ {} }}", place(n))).collect();
    let shelter = format!("[shelter]\nlayout = \"list\"\ncable = []\ntire = [{}]\n{more}", tires.join(", "));
    let hole = |n: usize, launch: f64| format!("{{ {}, launch_m_s = {launch} }}", place(n));
    let [with_others, later] = launches.map(|launch| launch.map(|launch| hole(0, launch)));
    let first: Vec<String> = with_others.into_iter().chain((1..60).map(|n| hole(n, SPEED))).collect();
    let rows = format!(
        "blast_row = [{{ name = \"1\", holes = [{}] }}, {{ name = \"2\", holes = [{}] }}]",
        first.join(", "),
        later.unwrap_or_default()
    );
    let limits = "flight_height_m = 50, accepted_risk_percent = 0.34";
    let text = plan(&shelter, &rows, limits, &[("launch_cv_percent", "5")]);
    let text = text.replace("interval_ms = 20", &format!("interval_ms = {interval}"));
    let case = case(&text.replace("mass_kg = 280", "mass_kg = 280, outer_diameter_m = 0.8"));
    let (compute, control) = (ComputeSettings::of(&case.plan), StudyControl::default());
    let launches = Assumed::Spread(Spread::LaunchByHole);
    for seed in 1..=8 {
        let sampling = Sampling::exactly(SAMPLES, seed);
        let context = Context::new(&case, compute, &control).with_sampling(sampling);
        let found = find_these(&context, 0, [launches].into_iter(), Extent::All).expect("a result").value;
        let [until, from] = ends(&found, launches);
        let too_fast = |cv_percent: f64, fastest: f64| {
            let mut varied = case.clone();
            varied.plan.uncertainty.launch_cv_percent = cv_percent;
            count_draws(&varied, sampling, |drawn| {
                drawn.shot.firings.iter().find(|it| it.tire == 0).is_some_and(|it| it.launch.z > fastest)
            })
        };
        let counts = [too_fast(until, 1.01 * fastest), too_fast(from, 0.99 * fastest)];
        assert!(counts[0] <= 1 && counts[1] > 1, "seed {seed}: {until}, {from}: {counts:?}");
    }
}

/// A second hole fires under the first tire after 100 ms. The tire covers it up to half its radius, 0.2 m: up to 2.49 m/s.
#[test]
fn a_tire_that_stands_high_ends_a_pass_far_from_its_limits() {
    the_first_tire_ends_a_pass([Some(2.1), Some(1.0)], 100.0, "", 2.0 + 0.5 * GRAVITY * 0.1);
}

/// The first tire flies last, 2 s after the others, and must lie still at the end of the run.
#[test]
fn a_tire_that_still_flies_at_the_end_ends_a_pass_far_from_its_limits() {
    let fastest = 5.0;
    let more = format!("[simulation]\nduration_s = {}", 2.0 + 2.0 * fastest / GRAVITY);
    the_first_tire_ends_a_pass([None, Some(4.2)], 2000.0, &more, fastest);
}

/// Limits that nothing reaches: every assumption is tried to its end. And a wider limit makes no end come earlier.
#[test]
fn what_no_value_exceeds_has_no_end() {
    let found = find(&lone(50.0, &[]), Extent::All, 10);
    assert!(found.pass_as_stated());
    for assumption in &found.all {
        assert_eq!((assumption.fails_from, assumption.ratio), (None, None), "{assumption:?}");
        assert!(assumption.is_complete);
    }
    let tilt = of(&found, Assumed::Spread(Spread::TiltCommon));
    assert_eq!(
        (tilt.stated, tilt.passes_until),
        (0.0, Some(2.5)),
        "from the least spread, 0.25°, to ten times it"
    );
    let friction = of(&found, Assumed::Range(Ranged::Friction, Side::Low));
    assert_eq!((friction.stated, friction.passes_until), (0.5, Some(0.4)));
    let scattered = [("launch_cv_percent", "3"), ("launch_common_percent", "3")];
    let some = [
        Assumed::LaunchVelocity,
        Assumed::Spread(Spread::LaunchByHole),
        Assumed::Spread(Spread::LaunchCommon),
        Assumed::Spread(Spread::TiltCommon),
        Assumed::Range(Ranged::Friction, Side::Low),
    ];
    let [near, far] = [2.5, 3.0].map(|limit| find_only(&lone(limit, &scattered), some));
    let mut later = 0;
    for near in &near.all {
        let far = of(&far, near.assumed);
        let end = |found: &Assumption| found.ratio.unwrap_or(f64::INFINITY);
        assert!(end(near) <= end(&far), "{near:?} {far:?}");
        later += usize::from(end(near) < end(&far));
    }
    assert!(later > 0, "a test that can fail");
}

/// What fails with all as stated has no value that passes.
#[test]
fn what_does_not_pass_as_stated_stands_on_nothing() {
    // The planned shot fails; only samples do.
    for case in [lone(1.5, &[]), lone(1.9, &[("launch_common_percent", "3")])] {
        let found = find(&case, Extent::All, SAMPLES);
        assert!(!found.pass_as_stated() && found.failing > 3);
        assert!(found.all.iter().all(|one| one.passes_until.is_none() && one.fails_from == Some(one.stated)));
    }
}

/// A shot as planned that passes by the finer steps of a check, and is too near its limit for a quick one, passes as stated.
#[test]
fn a_planned_shot_too_near_for_a_quick_check_is_checked() {
    let two = "shelter = { layout = \"grid\", rows = 1, columns = 2, spacing_m = 1.5 }";
    let hole = "blast_row = [{ name = \"1\", holes = [{ x_m = 0, y_m = 0, launch_m_s = 6 }] }]";
    let with_limit = |breaking_kn: f64| {
        let text = plan(two, hole, "flight_height_m = 5", &[]);
        case(&text.replace("breaking_force_kn = 10", &format!("breaking_force_kn = {breaking_kn}")))
    };
    let wide = with_limit(500.0);
    let compute = ComputeSettings::of(&wide.plan);
    let at_first = ComputeSettings { step: Some(compute.first_step(&wide)), ..compute };
    let force = wide.check_as_planned(0, &at_first).expect("a check").estimates.force;
    let near = with_limit(1e-3 * (force.value + 2.0 * force.error));
    let control = StudyControl::default();
    let quick = quick_check(&Context::new(&near, compute, &control), &near.shots[0]).expect("a check");
    let checked = near.check_as_planned(0, &compute).expect("a check").verdict;
    assert_eq!((quick.verdict, checked), (Verdict::Undecided, Verdict::Pass), "a test that can fail");
    assert!(find(&near, Extent::All, 0).pass_as_stated());
}

/// Whether a study ends at the nearest three, and on how many threads it runs, changes nothing of these.
#[test]
fn the_nearest_are_the_same_however_they_are_found() {
    let unknown = [("launch_common_percent", "2"), ("launch_tilt_deg", "1"), ("hole_position_m", "0.05")];
    let case = case(&plan(LONE, ROW, "flight_height_m = 2.5, drift_m = 2", &unknown));
    // More than the first 100, after which those left may be spared.
    let samples = 120;
    let nearest = |threads: usize, extent: Extent| -> Vec<Assumption> {
        let pool = thread_pool(threads).expect("threads");
        pool.install(|| find(&case, extent, samples)).failing().take(NEAREST).copied().collect()
    };
    let all = nearest(1, Extent::All);
    assert_eq!(all.len(), NEAREST);
    assert!(all.is_sorted_by(|a, b| a.ratio <= b.ratio));
    assert_eq!(nearest(3, Extent::Nearest), all);
}

/// What makes a pass thin is found, however many ends are nearer by what the plan states: small stated errors of launches let three of them
/// end before 5 % of launch are tried.
#[test]
fn a_thin_pass_is_thin_by_the_nearest_ends_alone() {
    let text = "shelter = { layout = \"list\", tire = [{ x_m = 0, y_m = 0 }], cable = [] }\n\
        tire = { mass_kg = 280 }\ncable = { axial_stiffness_kn = 1400, breaking_force_kn = 60 }\n\
        ground = { friction = 0.3 }\nblast_row = [{ name = \"1\", under_tires = [1], launch_m_s = 6 }]\n\
        limits = { flight_height_m = 2.1, cable_safety_factor = 1, drift_m = 1.85 }\n\
        delay = [{ name = \"1\", interval_ms = 0 }]\n[uncertainty]\nlaunch_cv_percent = 0.5\n\
        launch_row_cv_percent = 0.5\nlaunch_common_percent = 0.5\nlaunch_between_shots_percent = 0.5\n\
        launch_tilt_deg = 3\nlaunch_tilt_common_deg = 3\nlaunch_mass_exponent = [0, 1]\nhole_position_m = 0\n\
        pattern_offset_m = 0\nhole_fails_percent = 0\ncable_length_m = 0\nfriction = [0.25, 0.35]\n\
        slack_percent = [0, 0]\naxial_stiffness_percent = [0, 0]\ntire_mass_cv_percent = 0\ndelay_sd_ms = 0\n";
    let case = Case::parse(PlanSource { text: text.to_owned(), ..PlanSource::default() }).expect("a plan");
    let thin = |extent| ThinPass::of_assumptions(&find(&case, extent, SAMPLES));
    let of_all = thin(Extent::All);
    let Some(ThinPass::StandsOn(found)) = of_all else { panic!("it stands on launches") };
    assert_eq!(found.assumed, Assumed::LaunchVelocity);
    assert_eq!([Extent::Nearest, Extent::Thin].map(thin), [of_all; 2]);
}

/// The command: text, the fields that scripts read, and plans of which no option passes.
#[test]
fn the_command_tells_the_nearest_first() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("plan.toml");
    let run = |height: f64, more: &[&str]| {
        let limits = format!("flight_height_m = {height}");
        let unknown = [("launch_common_percent", "2"), ("launch_tilt_common_deg", "1")];
        std::fs::write(&path, plan(LONE, ROW, &limits, &unknown)).expect("written");
        let few = ["--samples", "100"];
        let more = if more.contains(&"--nominal") { more.to_vec() } else { [more, &few].concat() };
        let output = shelter(&[&["assumptions", path.to_str().expect("UTF-8")], &more[..]].concat());
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        output
    };
    let told = text(&run(2.3, &[]).stdout).replace(folder.path().to_str().expect("UTF-8"), "folder");
    insta::assert_snapshot!(told);
    let document = json(&run(2.3, &["--format", "json"]));
    assert_eq!(document["schema"], "shelter.assumptions/1");
    let option = &document["options"][0];
    assert_eq!((&option["name"], &option["verdict"]), (&"20 ms".into(), &"pass".into()));
    let all = option["assumptions"].as_array().expect("assumptions");
    let common = all.iter().find(|one| one["name"] == "launch_common_percent").expect("a key");
    assert_eq!(
        (&common["value"], &common["unit"], &common["samples"]),
        (&2.0.into(), &"%".into(), &100.into())
    );
    assert!(common["passes_until"].as_f64() < common["fails_from"].as_f64());
    assert!(all.last().expect("one")["fails_from"].is_null(), "those without an end stand last");
    // As planned alone, only what changes the shot as planned is asked about.
    let nominal = json(&run(2.3, &["--nominal", "--format", "json"]));
    assert_eq!(nominal["options"][0]["assumptions"].as_array().map(Vec::len), Some(6));
    let csv = run(2.3, &["--nominal", "--format", "csv"]);
    let csv = text(&csv.stdout);
    assert!(csv.starts_with("option,name,value,unit,passes_until,fails_from,samples\n"), "{csv}");
    assert_eq!(csv.lines().count(), 1 + 6);
    let failing = run(1.5, &[]);
    assert!(text(&failing.stdout).contains("20 ms: FAIL, there is no PASS to ask about"));
    assert!(json(&run(1.5, &["--format", "json"]))["options"][0]["assumptions"].is_null());
}
