//! Holes by position, the pattern off by 10 cm: how often does an option pass whose true risk is greater than the accepted one?

use shelter::study::Context;
use shelter::{Case, ComputeSettings, Plan, Sampling, StudyControl, Verdict};

use super::motion::Bounds;
use super::random::Random;
use super::sampler::Planned;

/// Samples that place the limit of a plan.
const PILOT: usize = 1000;
/// Seeds of the pilot and of the truth.
const PILOT_SEED: u64 = 2;
const TRUTH_SEED: u64 = 3;
/// Least and greatest risk that limits are placed for, as powers of ten; 1 % is accepted.
const RISKS: [f64; 2] = [-3.0, -1.7];
/// Greatest share of passing options whose risk may be above the accepted one.
const MOST_WRONG: f64 = 0.05;

/// A random plan of holes near their tires; its limits are far beyond any shot.
fn random_plan(random: &mut Random) -> Plan {
    let mut pick = |low: f64, high: f64| random.between([low, high]);
    let (rows, columns) = (pick(3.0, 5.0) as usize, pick(3.0, 6.0) as usize);
    let spacing = pick(2.0, 3.0);
    let diameter = if pick(0.0, 1.0) < 0.5 { 0.0 } else { pick(1.0, 0.8 * spacing) };
    let (stiffness, slack, friction) = (pick(1000.0, 6000.0), pick(1.0, 4.0), pick(0.3, 0.7));
    let (interval, launch) = (pick(5.0, 80.0), pick(4.0, 6.5));
    let mut text = format!(
        r#"
shelter = {{ layout = "grid", rows = {rows}, columns = {columns}, spacing_m = {spacing} }}
tire = {{ mass_kg = 280, outer_diameter_m = {diameter} }}
cable = {{ axial_stiffness_kn = {stiffness}, breaking_force_kn = 100000, slack_percent = {slack} }}
ground = {{ friction = {friction} }}
limits = {{ flight_height_m = 1000, cable_safety_factor = 1 }}
delay = [{{ name = "only", interval_ms = {interval} }}]
uncertainty = {{ pattern_offset_m = 0.1 }}
"#
    );
    for row in 0..2 {
        let mut hole = |column: usize| {
            let (x, y) =
                (spacing * column as f64 + pick(-0.1, 0.1), spacing * f64::from(row) + pick(-0.1, 0.1));
            format!("{{ x_m = {x}, y_m = {y}, launch_m_s = {launch} }}")
        };
        let holes: Vec<String> = (0..columns).map(&mut hole).collect();
        text += &format!("[[blast_row]]\nname = \"{row}\"\nholes = [{}]\n", holes.join(", "));
    }
    Plan::parse("random", &text).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

/// The plan with a limit of height or force that about this share of its shots exceeds.
fn with_limit(mut plan: Plan, risk: f64, by_height: bool) -> Case {
    let case = Case::new(plan.clone());
    let planned = Planned::new(&case, 0, None);
    let value = |number: usize| {
        let reached = planned.reach(PILOT_SEED, number, &Bounds::NONE);
        if by_height { reached.height } else { reached.force }
    };
    let mut values: Vec<f64> = (0..PILOT).map(value).collect();
    values.sort_by(f64::total_cmp);
    let limit = values[((1.0 - risk) * PILOT as f64) as usize];
    if by_height {
        plan.limits.flight_height_m = limit;
    } else {
        plan.cable.breaking_force_kn = limit * 1e-3;
    }
    Case::new(plan)
}

/// Judges random plans until so many `options` pass, and samples each of these independently; true where at most one in twenty has a
/// risk above the accepted one.
pub fn judge(options: usize, samples: usize) -> bool {
    println!(
        "\npatterns off by 10 cm, options that pass; independent share of {samples} samples, in percent\n"
    );
    println!("| plan | tires | limit | program: at most, % | independent |");
    println!("|---|---|---|---|---|");
    let (mut passing, mut wrong) = (0, 0);
    let mut plans = 0;
    while passing < options {
        let mut random = Random::new(20, plans);
        plans += 1;
        let plan = random_plan(&mut random);
        let risk = 10_f64.powf(random.between(RISKS));
        let by_height = plans % 2 == 0;
        let case = with_limit(plan, risk, by_height);
        let compute = ComputeSettings::of(&case.plan);
        let judged = Context::new(&case, compute, &StudyControl::default())
            .with_sampling(Sampling::OF_VERDICT)
            .judge_options();
        let judged = judged.expect("a result").value.remove(0).expect("a judgement");
        if judged.verdict() != Verdict::Pass {
            continue;
        }
        passing += 1;
        let share = Planned::new(&case, 0, None).share(TRUTH_SEED, samples);
        wrong += usize::from(share.value() > case.limits.accepted_risk);
        let most = judged.sampled.known().map_or(1.0, |risk| risk.bounds.interval[1]);
        println!(
            "| {plans} | {} | {} | {:.2} | {share} |",
            case.scene().tire_count(),
            if by_height { "height" } else { "force" },
            100.0 * most
        );
    }
    println!(
        "\n{plans} plans judged, {passing} pass; the independent risk of {wrong} of them is above the accepted one"
    );
    wrong as f64 <= MOST_WRONG * passing as f64
}
