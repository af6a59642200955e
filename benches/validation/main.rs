//! Answers that are not the program's: closed forms, tests of other programs, measurements, and the same model solved another way.
//!
//! `cargo bench --bench validation` prints one table in less than a minute; `-- 20x20` solves the largest of the reference scenes
//! from event to event, too, which takes another minute or two. `benches/RESULTS.md`, "Answers that are not ours", says what each
//! difference comes from.

mod chain;
mod contact;
mod event_driven;
mod full_scale;
mod highline;
mod reference;
mod report;
mod rig;
mod rope_drop;

use chain::{Fall, Passage};
use contact::{block_on_slope, bouncing_ball, bump_stop, friction_pad, yielding_floor};
use event_driven::shelters;
use highline::LINES;
use report::{row, section};
use shelter::choice::Method;
use shelter::simulation::RunError;

const METHODS: [Method; 2] = [Method::Verlet, Method::Newmark];

fn main() {
    let largest = std::env::args().any(|argument| argument == "20x20");
    report::head();
    reference_answers(largest);
    falling_chain();
    contact_and_friction();
    drop_on_a_rope();
    person_on_a_highline();
    full_scale_shot();
}

fn reference_answers(largest: bool) {
    section("The same model, solved from event to event");
    reference::compare("quincunx, diagonal 2 m", &shelters::quincunx(2.0, 1.4e6));
    reference::compare("quincunx, diagonal 1 m", &shelters::quincunx(1.0, 1.519e6));
    reference::compare("5 × 10, rows 2, 3, 4", &shelters::grid(5, 10, 1..4));
    if largest {
        reference::compare("20 × 20, rows 6 to 15", &shelters::grid(20, 20, 5..15));
    }
}

fn falling_chain() {
    section("A folded chain falls; x of its length L, units √(L/g), √(gL), its weight");
    let exact = chain::exact();
    let whole_falls = [(101, &METHODS[..]), (401, &METHODS[..1])];
    for (links, methods) in whole_falls {
        let falls: Vec<_> = methods.iter().map(|&method| chain::fall(links, method, CHAIN_STEP)).collect();
        let row = |what: &str, theirs: f64, ours: &dyn Fn(&Fall) -> f64, places: usize| {
            let ours = [0, 1].map(|n| falls.get(n).map(|fall| fall.as_ref().map(ours).map_err(Clone::clone)));
            row(&format!("{links} links: {what}"), theirs, ours, places, CHAIN_SOURCE);
        };
        for (n, place) in chain::PLACES.into_iter().enumerate() {
            let Passage { time, speed, force } = exact.passages[n];
            row(&format!("time to x/L = {place}"), time, &|fall| fall.passages[n].time, 4);
            row(&format!("speed around x/L = {place}"), speed, &|fall| fall.passages[n].speed, 3);
            row(&format!("force around x/L = {place}"), force, &|fall| fall.passages[n].force, 3);
        }
        row("time of fall", exact.duration, &|fall| fall.duration, 4);
        row("greatest force", exact.greatest_force, &|fall| fall.greatest_force, 0);
    }
    let more_links = [25, 51, 201, 801].map(|links| (links, CHAIN_STEP));
    let other_steps = [0.5, 0.125].map(|part| (101, part));
    for (links, part) in more_links.into_iter().chain(other_steps) {
        let ours = METHODS.map(|method| {
            let takes_too_long = method == Method::Newmark && links > 201;
            (!takes_too_long).then(|| chain::fall(links, method, part).map(|fall| fall.duration))
        });
        let step = if part == CHAIN_STEP { String::new() } else { format!(", step of {part}") };
        row(&format!("{links} links{step}: time of fall"), exact.duration, ours, 4, CHAIN_SOURCE);
    }
}

/// Step over the time that a wave takes for a link.
const CHAIN_STEP: f64 = 0.25;
const CHAIN_SOURCE: &str = "Calkin and March 1989";

fn contact_and_friction() {
    let step = 1e-5;
    section("Contact and friction");
    let source = "Code_Aster V5.01.100";
    let pads = METHODS.map(|method| friction_pad::turning_points(method, step));
    for (n, exact) in friction_pad::EXACT.into_iter().enumerate() {
        let turn = |axis: usize, unit: f64| {
            pads.clone()
                .map(|turns| Some(turns.map(|turns| turns.get(n).map_or(f64::NAN, |turn| turn[axis] * unit))))
        };
        row(&format!("pad: turning point {}, mm", n + 1), exact * 1e3, turn(1, 1e3), 5, source);
        row("pad: its time, ms", friction_pad::EACH * (n + 1) as f64 * 1e3, turn(0, 1e3), 4, source);
    }
    let source = "Code_Aster V5.01.101";
    let (exact, shocks) = (bump_stop::exact(), METHODS.map(|method| bump_stop::shock(method, step)));
    let shock = |value: fn(&bump_stop::Shock) -> f64| shocks.each_ref().map(|shock| each(shock, value));
    row("stop: greatest force, N", exact.force, shock(|shock| shock.force), 3, source);
    row("stop: time in contact, ms", exact.duration * 1e3, shock(|shock| shock.duration * 1e3), 4, source);
    row("stop: speed after it, m/s", exact.speed, shock(|shock| shock.speed), 6, source);
    row("stop: swing to the other side, mm", exact.swing * 1e3, shock(|shock| shock.swing * 1e3), 4, source);
    let source = "Code_Aster V5.01.108 A";
    let (exact, bounces) =
        (yielding_floor::exact(), METHODS.map(|method| yielding_floor::bounce(method, step)));
    let bounce =
        |value: fn(&yielding_floor::Bounce) -> f64| bounces.each_ref().map(|bounce| each(bounce, value));
    row("floor: time of contact, s", exact.contact, bounce(|bounce| bounce.contact), 6, source);
    row("floor: speed at contact, m/s", exact.speed, bounce(|bounce| bounce.speed), 5, source);
    row("floor: greatest force, N", exact.force, bounce(|bounce| bounce.force), 4, source);
    row("floor: time in contact, s", exact.duration, bounce(|bounce| bounce.duration), 6, source);
    let least = METHODS.map(|method| Some(block_on_slope::least_force(method, 1e-3)));
    row("block on a slope moves from F/mg", block_on_slope::exact(), least, 9, "NAFEMS CGS-4");
    let tops = bouncing_ball::tops(1e-4);
    for (n, [time, height]) in bouncing_ball::exact().into_iter().enumerate() {
        let top = |axis: usize| {
            [Some(tops.clone().map(|tops| tops.get(n).map_or(f64::NAN, |top| top[axis]))), None]
        };
        let name = |what: &str| format!("ball: top {}, {what}", n + 1);
        row(&name("s"), time, top(0), 6, "Reference FMUs, `BouncingBall`");
        row(&name("m"), height, top(1), 6, "Reference FMUs, `BouncingBall`");
    }
}

/// One of the values of an outcome.
fn each<T>(outcome: &Result<T, RunError>, value: fn(&T) -> f64) -> Option<Result<f64, RunError>> {
    Some(outcome.as_ref().map(value).map_err(Clone::clone))
}

fn drop_on_a_rope() {
    let (step, kilo, measured) = (1e-5, 1e-3, rope_drop::MEASURED * 1e-3);
    section("99.7 kg fall 1.8 m on a steel rope: greatest force, kN");
    for (name, end) in [("rigid ends", None), ("ends of 433 kN/m", Some(433e3))] {
        let ours = METHODS
            .map(|method| Some(rope_drop::greatest_force(end, 0.0, method, step).map(|force| force * kilo)));
        row(name, rope_drop::exact(end) * kilo, ours.clone(), 4, "mg + √((mg)² + kmv²)");
        row(name, measured, ours, 1, "measured, one drop");
        let (damping, force) = rope_drop::best_damping(end, step).map_or((f64::NAN, f64::NAN), |best| best);
        let name = format!("{name}, the damping that helps most, {:.1} %", 100.0 * damping);
        row(&name, measured, [Some(Ok(force * kilo)), None], 1, "measured, one drop");
    }
}

fn person_on_a_highline() {
    section("57 kg on a slackline");
    for line in &LINES {
        let name = line.name;
        let standing =
            METHODS.map(|method| Some(line.standing_tension(method).map(|tension| tension * 1e-3)));
        row(&format!("{name}: tension, standing, kN"), line.standing * 1e-3, standing, 2, "measured");
        let rate = METHODS.map(|method| Some(line.bouncing_rate(method)));
        row(&format!("{name}: bouncing, 1/s"), line.bouncing.1, rate, 3, "measured");
        let fall = line.fall_that_explains();
        println!(
            "| {name}: fall into the leash, kN | {:.1} | – | – | a fall of {fall:.1} m explains it | measured |",
            line.fall * 1e-3
        );
    }
}

fn full_scale_shot() {
    section("The shot of 12.04.07: greatest flight height, m; least, median and greatest of 81 assumptions");
    for launch in [5.0, 6.0, 7.0] {
        let shown = METHODS.map(|method| {
            let [least, median, greatest] = full_scale::band(launch, method);
            format!("{least:.2}, {median:.2}, {greatest:.2}")
        });
        println!(
            "| launched at {launch} m/s | not stated | {} | {} | – | source paper |",
            shown[0], shown[1]
        );
    }
}
