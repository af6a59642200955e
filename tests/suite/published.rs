//! Answers that others print, by every method: small versions of `cargo bench --bench validation`, and its event-driven solution.

#[path = "../../benches/validation/chain.rs"]
#[allow(dead_code)]
mod chain;
#[path = "../../benches/validation/contact.rs"]
mod contact;
#[allow(dead_code)] // The table of `benches/validation` prints times as well.
#[path = "../../benches/validation/event_driven/mod.rs"]
mod event_driven;
#[path = "../../benches/validation/rig.rs"]
mod rig;
#[path = "../../benches/validation/rope_drop.rs"]
#[allow(dead_code)]
mod rope_drop;

use shelter::choice::Method;

use self::contact::{block_on_slope, bouncing_ball, bump_stop, friction_pad, yielding_floor};
use self::event_driven::{shelters, solve};
use super::support::scenes::{METHODS, close};

const STEP: f64 = 1e-4;

/// Error of second order, (ωh)², of a swing of frequency ω [rad/s].
fn second_order(omega: f64) -> f64 {
    (omega * STEP).powi(2)
}

#[test]
fn a_rubbing_pad_turns_where_friction_lets_it() {
    for method in METHODS {
        let turns = friction_pad::turning_points(method, STEP).expect("turning points");
        assert_eq!(turns.len(), friction_pad::EXACT.len(), "{method:?}: it stays at the last");
        for (n, ([time, place], exact)) in turns.into_iter().zip(friction_pad::EXACT).enumerate() {
            close(place, exact, second_order(100.0) * 0.85e-3, &format!("{method:?}: turning point {n}"));
            close(time, friction_pad::EACH * (n + 1) as f64, 2.0 * STEP, &format!("{method:?}: its time"));
        }
    }
}

#[test]
fn a_stop_takes_up_a_mass_and_gives_it_back() {
    let exact = bump_stop::exact();
    for method in METHODS {
        let shock = bump_stop::shock(method, STEP).expect("a shock");
        let tolerance = second_order(101.0);
        close(shock.force, exact.force, tolerance * exact.force, "force");
        close(shock.duration, exact.duration, tolerance * exact.duration, "time in contact");
        close(shock.speed, exact.speed, tolerance, "speed after it");
        close(shock.swing, exact.swing, tolerance * exact.swing, "swing to the other side");
    }
}

#[test]
fn a_mass_bounces_off_a_floor_that_yields() {
    let exact = yielding_floor::exact();
    for method in METHODS {
        let bounce = yielding_floor::bounce(method, STEP).expect("a bounce");
        let tolerance = second_order(10.0);
        close(bounce.contact, exact.contact, tolerance * exact.contact, "time of contact");
        close(bounce.speed, exact.speed, tolerance * exact.speed, "speed at contact");
        close(bounce.force, exact.force, tolerance * exact.force, "force");
        close(bounce.duration, exact.duration, tolerance * exact.duration, "time in contact");
    }
}

#[test]
fn a_level_force_moves_a_block_uphill_where_it_must() {
    for method in METHODS {
        let least = block_on_slope::least_force(method, 1e-3).expect("a force");
        // Half of the last bracket.
        close(least, block_on_slope::exact(), 1e-9, &format!("{method:?}"));
    }
}

#[test]
fn a_ball_bounces_as_its_restitution_says() {
    let tops = bouncing_ball::tops(STEP).expect("tops");
    for ([time, height], [exact_time, exact_height]) in tops.into_iter().zip(bouncing_ball::exact()) {
        // Flight and landing are exact; the parabola through three steps keeps what rounding leaves.
        close(time, exact_time, 1e-9, "time of a top");
        close(height, exact_height, 1e-9, "height of a top");
    }
}

#[test]
fn a_weight_on_a_rope_pulls_with_its_fall() {
    for method in METHODS {
        for (end, omega) in [(None, 119.0), (Some(433e3), 44.0)] {
            let force = rope_drop::greatest_force(end, 0.0, method, STEP).expect("a force");
            let exact = rope_drop::exact(end);
            close(force, exact, second_order(omega) * exact, "force");
        }
    }
}

/// With 25 links the chain is late by up to 5 %, with 101 by up to 2 %; a body that falls freely is late by 14 % at the last place.
#[test]
fn a_folded_chain_falls_faster_than_a_free_body() {
    let exact = chain::exact();
    close(exact.duration, 0.84721 * 2_f64.sqrt(), 1e-5, "time of fall as published");
    for (links, method, tolerance) in
        [(25, Method::Verlet, 0.05), (25, Method::Newmark, 0.05), (101, Method::Verlet, 0.02)]
    {
        let fall = chain::fall(links, method, 0.5).expect("a fall");
        for (passage, exact) in fall.passages.iter().zip(&exact.passages) {
            let name = format!("{method:?}, {links} links");
            close(passage.time, exact.time, tolerance * exact.time, &name);
        }
        close(fall.duration, exact.duration, tolerance * exact.duration, "time of fall");
    }
}

/// The digits that the reference answers are compared with are those of the event-driven solution; `cargo bench --bench validation --
/// 20x20` makes those of the fourth scene, too.
#[test]
fn the_reference_answers_are_made_again() {
    for ((shelter, launches), height, force) in [
        (shelters::quincunx(2.0, 1.4e6), 1.08394, 10015.6),
        (shelters::quincunx(1.0, 1.519e6), 0.75741, 17735.7),
        (shelters::grid(5, 10, 1..4), 1.76711, 10016.8),
    ] {
        let answer = solve(&shelter, &launches, 1.0, 1e-9);
        close(answer.height.value, height, 5e-6, "height");
        close(answer.force.value, force, 0.05, "force");
    }
}
