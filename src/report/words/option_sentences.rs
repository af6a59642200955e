//! Sentences about one checked option, the same in every face.

use crate::outcome::BrokenCable;
use crate::plan::{BlastRow, DelayOption, HoleTiming, Time};
use crate::report::language::{phrase, say};
use crate::scene::{Scene, Shot};
use crate::study::as_planned::check::CheckedShot;
use crate::study::as_planned::margin::LaunchMargin;
use crate::study::eight_ms::WithinEightMs;
use crate::study::hole_places::HoleBesideTire;
use crate::study::judge::Judgement;
use crate::study::judge::grounds::Evidence;
use crate::study::judge::one_dud::OneDud;
use crate::study::samples::random_shot::Input;
use crate::study::samples::sample::Sample;
use crate::study::samples::sampled_shot::SampledShot;
use crate::study::{Case, ComputeSettings};
use crate::units::{self, Unit, value_and_error};
use crate::verdict::{Estimate, PerQuantity, Quantity, Verdict};

/// Meaning of the three verdicts.
pub const VERDICTS: [&str; 3] = [
    "PASS: of the shots that [uncertainty] describes, surely fewer than the accepted risk exceed a limit, and the planned shot does not either.",
    "FAIL: the planned shot exceeds a limit, or surely more shots do than accepted.",
    "OPEN: neither, with the finest step and the most samples allowed; surely means 95 %, however often the samples are looked at.",
];

/// The most holes that fire within any 8 ms, and the heaviest charge where the plan names charges: `3 holes, 75 kg`.
pub fn together(WithinEightMs { holes, charge }: WithinEightMs) -> String {
    let holes = if holes == 1 { say!("1 hole") } else { say!("{holes} holes", holes) };
    charge.map_or(holes.clone(), |charge| format!("{holes}, {} kg", kg_to_the_gram(charge)))
}

/// Firing time of each blast row of an option, and how its holes follow: `1: 0 ms, 2: 42 ms · holes 17 ms left`.
pub fn firing_times_text(rows: &[BlastRow], delay: &DelayOption) -> String {
    let times = delay.timing.fire_at();
    let row = |(row, at): (&BlastRow, &Time)| format!("{}: {at} ms", row.name);
    let rows: Vec<String> = rows.iter().zip(&times).map(row).collect();
    [rows.join(", ")].into_iter().chain(hole_timing(&delay.hole_timing)).collect::<Vec<_>>().join(" · ")
}

/// Firing times of the rows in the order of the plan, and how the holes of each row follow: `0/42/84 ms, holes 17 ms left`.
pub fn firing_times(delay: &DelayOption) -> String {
    let times: Vec<String> = delay.timing.fire_at().iter().map(Time::to_string).collect();
    [format!("{} ms", times.join("/"))]
        .into_iter()
        .chain(hole_timing(&delay.hole_timing))
        .collect::<Vec<_>>()
        .join(", ")
}

/// Timing of the holes of a row, such as `holes 17 ms left`; `None` where they fire together.
pub fn hole_timing(timing: &HoleTiming) -> Option<String> {
    let HoleTiming { interval, order, .. } = timing;
    (!timing.is_together()).then(|| say!("holes {interval} ms {order}", interval, phrase(order.name())))
}

/// Bounds of a probability in percent, without the percent sign: `0.00 to 0.60`.
pub fn percent_range(interval: [f64; 2]) -> String {
    let [low, high] = units::probabilities(interval);
    say!("{low} to {high}", low, high)
}

/// A sum of charges [kg], rounded to a gram: adding leaves digits that mean nothing.
pub(in crate::report) fn kg_to_the_gram(charge: f64) -> f64 {
    (charge * 1e3).round() / 1e3
}

/// Inputs that decide how a shot turns out, with their share of the variance:
/// `slack 61 %, launch 24 %, chance differences between holes, rows and cables 13 %`.
pub fn inputs(shares: &[(Input, f64)]) -> String {
    let unexplained = 1.0 - shares.iter().map(|(_, share)| share).sum::<f64>();
    let worth = shares.iter().filter(|(_, share)| *share >= LEAST_SHARE);
    let mut words: Vec<String> = worth
        .map(|(input, share)| format!("{} {}", phrase(input_name(*input)), units::percent(*share, 0)))
        .collect();
    words.push(say!(
        "chance differences between holes, rows and cables {}",
        units::percent(unexplained.max(0.0), 0)
    ));
    words.join(", ")
}

/// What to measure on site so that the bands of a shot narrow most. The first of `shares` is the input that decides; `None` where
/// there is none.
pub fn measure_first(shares: &[(Input, f64)]) -> Option<&'static str> {
    let &(input, share) = shares.first()?;
    Some(match input {
        _ if share < DECIDES => "no one measurement narrows that much",
        Input::LaunchCommon => "to know more, film a shot and fit its launch velocities (Studies, Fit)",
        Input::Friction => "to know more, drag a tire along the ground with a spring scale",
        Input::Slack => "to know more, measure the slack of laid cables",
        Input::AxialStiffness => "to know more, find the stiffness of the rope, by its maker or a pull test",
        Input::LaunchBetweenShots => {
            "to know more, film five shots or more and fit them together (Studies, Fit)"
        }
        Input::MassExponent => "to know more, launch loose tires of different mass from holes that are alike",
        Input::CommonSlopeX | Input::CommonSlopeY => "to know more, film a shot from two sides",
        Input::OffsetX | Input::OffsetY => {
            "to know more, measure from the shelter to the holes at two corners"
        }
        Input::Duds => "test every detonator before you lay the shelter",
    })
}

/// Share of the variance from which an input is worth a measurement.
pub const DECIDES: f64 = 0.3;

/// Least share of the variance worth naming.
const LEAST_SHARE: f64 = 0.05;

fn input_name(input: Input) -> &'static str {
    match input {
        Input::LaunchCommon => "launch",
        Input::Friction => "friction",
        Input::Slack => "slack",
        Input::AxialStiffness => "stiffness",
        Input::LaunchBetweenShots => "launch between shots",
        Input::MassExponent => "mass exponent",
        Input::CommonSlopeX | Input::CommonSlopeY => "tilt of all launches",
        Input::OffsetX | Input::OffsetY => "offset of the shelter",
        Input::Duds => "duds",
    }
}

/// Verdict on the planned shot in which a hole between two tires launches the next tire, one sentence per hole.
pub fn next_tires(case: &Case, judged: &Judgement) -> Vec<String> {
    let sentence = |(hole, verdict): &(HoleBesideTire, Verdict)| {
        let [own, next] = hole.tires.map(|tire| case.scene().tire_ids[tire]);
        let [near, far] = hole.away.map(|away| units::rounded(away, 2));
        let row = &case.plan.blast_rows[hole.row].name;
        say!(
            "row {row}, hole {}: {near} m from tire {own}, {far} m from tire {next}; as planned with tire {next}: {}",
            row,
            hole.number + 1,
            near,
            own,
            far,
            next,
            phrase(verdict.for_people())
        )
    };
    judged.next_tires.iter().map(sentence).collect()
}

/// Effect of one dud on an option whose planned shot passes; `None` where the effect is not known, or is a reason of the verdict
/// already.
pub fn dud_of(case: &Case, judged: &Judgement) -> Option<String> {
    let is_reason =
        judged.withstands_dud.is_asked() && judged.withstands_dud != Evidence::Known(Verdict::Pass);
    let found = judged.one_dud.filter(|_| judged.checked.verdict == Verdict::Pass && !is_reason)?;
    let mut text = one_dud(case, &found);
    if let Some(sampled) = judged.sampled.known() {
        let duds = Input::ALL.iter().position(|input| *input == Input::Duds);
        let has_dud = |sample: &&Sample| duds.is_some_and(|n| sample.inputs[n] > 0.0);
        let fails = |sample: &&Sample| sample.finest().verdict == Verdict::Fail;
        let failing = sampled.samples.iter().filter(fails);
        let with_dud = failing.clone().filter(has_dud).count();
        if with_dud > 0 {
            text += &say!("; {with_dud} of {} failing shots have a dud", with_dud, failing.count());
        }
    }
    Some(text)
}

/// Effect of one dud on an option, in brief: `one dud exceeds a limit at 2 of 15 holes`.
pub fn one_dud_in_brief(one_dud: &OneDud) -> String {
    match *one_dud {
        OneDud { not_passing: 0, places: 1, .. } => "one dud: nothing flies".to_owned(),
        OneDud { not_passing: 0, places, .. } => {
            format!("one dud: within limits as planned at all {places} holes")
        }
        OneDud { failing: 0, not_passing, places, .. } => {
            format!("one dud: open at {not_passing} of {places} holes")
        }
        OneDud { failing, places, .. } => {
            format!("one dud exceeds a limit at {failing} of {places} holes")
        }
    }
}

/// Effect of one dud on an option: `one dud, nothing else varied: within limits at all 15 holes`.
pub fn one_dud(case: &Case, one_dud: &OneDud) -> String {
    let OneDud { row, number, planned, not_passing, failing, places, sampled } = one_dud;
    let place = say!("row {}, hole {}", case.plan.blast_rows[*row].name, number + 1);
    let quantity = one_dud.nearest_limit(case);
    let (name, unit) = quantity_name(quantity);
    let [value, limit] = [planned.get(quantity).value, case.limits.get(quantity).unwrap_or(f64::INFINITY)]
        .map(|value| format!("{} {}", units::value(value, unit), unit.symbol()));
    let worst = say!("the worst, {place}: {name} {value}, limit {limit}", place, name, value, limit);
    let planned = match not_passing {
        0 if *places == 1 => say!("one dud, and nothing flies"),
        0 => {
            say!("one dud, nothing else varied: within limits at all {places} holes; {worst}", places, worst)
        }
        _ => {
            let open = not_passing - failing;
            let found = match (failing, open) {
                (0, _) => say!("open at {open} of {places} holes", open, places),
                (_, 0) => say!("past a limit at {failing} of {places} holes", failing, places),
                _ => say!(
                    "past a limit at {failing} of {places} holes, open at {open} more",
                    failing,
                    places,
                    open
                ),
            };
            say!("one dud, nothing else varied: {found}; {worst}", found, worst)
        }
    };
    let sampled = sampled.as_ref().map(|sampled| {
        let bounds = percent_range(sampled.risk.bounds.interval);
        let place = say!("row {}, hole {}", case.plan.blast_rows[sampled.row].name, sampled.number + 1);
        say!(
            "; with everything varied, {place}: {bounds} % of the shots fail, {} % accepted",
            place,
            bounds,
            units::short(case.plan.limits.dud_risk_percent)
        )
    });
    planned + &sampled.unwrap_or_default()
}

/// How much faster the tires may leave, in brief: `to +4 %`.
pub fn launch_margin(margin: LaunchMargin) -> String {
    match margin {
        LaunchMargin::NotPassing => say!("to +0 %"),
        LaunchMargin::UpTo { rise, .. } => say!("to +{}", units::percent(rise, 0)),
        LaunchMargin::BeyondTried => say!("over +100 %"),
    }
}

/// How much faster the tires may leave, as a sentence: `fails from +5 % launch, 6.3 m/s`. `None` where the planned shot does not
/// pass, or the margin is not known. `shot` is the planned shot.
pub fn launch_limit(shot: &Shot, judged: &Judgement) -> Option<String> {
    let speed = |factor: f64| {
        let speeds = shot.firings.iter().map(|firing| factor * firing.launch.norm());
        let [least, most] = speeds.fold([f64::INFINITY, 0.0], |[a, b]: [f64; 2], v| [a.min(v), b.max(v)]);
        // Rows of different speeds have no speed in common.
        let same = most - least <= 1e-9 * most;
        if same { format!(", {} m/s", units::short(most)) } else { String::new() }
    };
    match judged.launch_margin? {
        LaunchMargin::NotPassing => None,
        LaunchMargin::UpTo { rise, above } => {
            let (share, becomes) =
                (rise + 0.01, phrase(if above == Verdict::Fail { "fails" } else { "is open" }));
            Some(say!("{becomes} from +{} launch{}", becomes, units::percent(share, 0), speed(1.0 + share)))
        }
        LaunchMargin::BeyondTried => Some(say!("passes up to +100 % launch{}", speed(2.0))),
    }
}

/// Most cables that a sentence names, of the cables that samples pull hardest.
const NAMED_CABLES: usize = 2;

/// Greatest height and force of the samples (5th and 95th percentile), the cables pulled hardest, and how likely a cable breaks.
/// `None` for too few samples.
pub fn bands(case: &Case, sampled: &SampledShot) -> Option<String> {
    let (scene, limits) = (case.scene(), &case.limits);
    let band = |quantity: Quantity, unit: Unit| {
        let [low, _, high, _] = sampled.band(quantity)?;
        let share = limits.get(quantity).map_or(f64::NAN, |limit| high / limit);
        Some(say!(
            "{} to {} {}, {} % of the limit",
            units::value(low, unit),
            units::value(high, unit),
            unit.symbol(),
            units::whole_percent(share)
        ))
    };
    let cables = sampled.hardest_pulled_cables();
    let named: Vec<String> = cables
        .iter()
        .take(NAMED_CABLES)
        .map(|(cable, share)| format!("{} ({})", scene.cable_name(*cable), units::percent(*share, 0)))
        .collect();
    let hardest = if named.is_empty() {
        String::new()
    } else {
        say!(", most often hardest: {} of shots", named.join(", "))
    };
    Some(say!(
        "5 to 95 % of {} samples: height {} · force {}{hardest} · a cable breaks in {} %",
        sampled.decided().count(),
        band(Quantity::Height, Unit::Metre)?,
        band(Quantity::Force, Unit::Kilonewton)?,
        hardest,
        percent_range(sampled.breaks.interval)
    ))
}

/// Method and accuracy that results were asked for, or method and step: `verlet, field` or `verlet, step 1 ms`.
pub fn compute_label(compute: &ComputeSettings) -> String {
    let method = compute.method.name();
    match compute.step {
        Some(step) => say!("{method}, step {}", method, units::milliseconds(step)),
        None => format!("{method}, {}", phrase(compute.accuracy.name())),
    }
}

/// Tire or cable, and time, of the greatest height and of the greatest force.
fn peak(scene: &Scene, checked: &CheckedShot) -> [String; 2] {
    let PerQuantity { height, force, .. } = checked.estimates;
    let lifted = say!("tire {}, {}", scene.tire_ids[height.index], units::seconds(height.time));
    let pulled = say!("cable {}, {}", scene.cable_name(force.index), units::seconds(force.time));
    [
        if height.value > 0.0 { lifted } else { say!("no tire lifts") },
        if force.value > 0.0 { pulled } else { say!("no cable pulls") },
    ]
}

/// Most broken cables that a sentence names.
const BROKEN: usize = 4;

/// The cables that broke, the first of them by name.
pub fn broken(scene: &Scene, checked: &CheckedShot) -> String {
    let name =
        |broken: &BrokenCable| say!("{} at {}", scene.cable_name(broken.cable), units::seconds(broken.time));
    let names: Vec<String> = checked.broken.iter().take(BROKEN).map(name).collect();
    let more = checked.broken.len().saturating_sub(BROKEN);
    let and_more = if more > 0 { say!(" and {more} more", more) } else { String::new() };
    say!("broken: {}{and_more}", names.join(", "), and_more)
}

/// Greatest height, force and drift with their errors; height and force with tire or cable, and time.
pub fn peaks(scene: &Scene, checked: &CheckedShot) -> String {
    let [highest, hardest] = peak(scene, checked);
    let value = |peak: &Estimate, unit: Unit| {
        format!("{} {}", value_and_error(peak.value, peak.error, unit), unit.symbol())
    };
    say!(
        "height {}, {highest} · force {}, {hardest} · slide {}",
        value(&checked.estimates.height, Unit::Metre),
        highest,
        value(&checked.estimates.force, Unit::Kilonewton),
        hardest,
        value(&checked.estimates.drift, Unit::Metre)
    )
}

/// Place and time of the peaks, and how the values of an option were computed.
pub fn computation(scene: &Scene, checked: &CheckedShot) -> String {
    let [height, force] = peak(scene, checked);
    say!(
        "Highest: {height}; greatest force: {force}; {}, step {}, {} runs, energy residual {}",
        height,
        force,
        compute_label(&checked.compute),
        units::milliseconds(checked.step),
        checked.runs,
        units::residual(checked.energy_residual)
    )
}

/// Name and unit of a quantity.
pub fn quantity_name(quantity: Quantity) -> (&'static str, Unit) {
    match quantity {
        Quantity::Height => (phrase("flight height"), Unit::Metre),
        Quantity::Force => (phrase("cable force"), Unit::Kilonewton),
        Quantity::Drift => (phrase("slide"), Unit::Metre),
    }
}
