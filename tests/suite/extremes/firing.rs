//! Extremes of what fires when.

use super::*;

#[test]
fn all_holes_at_once_lift_the_shelter_as_one() {
    let scene = grid(3, 3, 2.0, EA);
    for out in stable_both("all at once", &scene, &fire(&(0..9).collect::<Vec<_>>(), LAUNCH), LAUNCH) {
        // Nothing stretches any cable.
        close(out.height.value, LAUNCH * LAUNCH / (2.0 * GRAVITY), 1e-9, "height");
        close(out.force.value, 0.0, EA * 1e-14, "force");
    }
}

#[test]
fn ten_thousand_holes_are_stable() {
    let scene = grid(100, 100, 2.0, EA);
    let h = step(&scene, LAUNCH);
    let all: Vec<usize> = (0..10_000).collect();
    stable("at once", &scene, &fire(&all, LAUNCH), Method::Verlet, h, 400);
    // One by one in an order that jumps about: 7919 is prime to 10,000.
    let firing = |n: usize| Firing::up(n as f64 * 1e-5, n * 7919 % 10_000, LAUNCH);
    let shot = Shot::from_firings((0..10_000).map(firing).collect());
    stable("one by one", &scene, &shot, Method::Verlet, h, 400);
}

#[test]
fn firing_one_tire_100_times_at_one_instant_is_one_launch_of_the_sum() {
    let scene = cross();
    for method in METHODS {
        let many = stable("100 at once", &scene, &fire(&[4; 100], 0.0625), method, 1e-4, steps(method));
        // A sixteenth sums without rounding.
        let one = stable("one", &scene, &fire(&[4], 6.25), method, 1e-4, steps(method));
        close(many.height.value, one.height.value, 1e-9, "height");
        close(many.force.value, one.force.value, 1e-6 * one.force.value, "force");
        close(many.ledger.put_in, one.ledger.put_in, 1e-9 * one.ledger.put_in, "energy");
    }
}

#[test]
fn firing_one_tire_100_times_in_turn_is_stable() {
    let scene = cross();
    for interval in [1e-5, 1e-3, 0.01] {
        let firing = |n: usize| Firing::up(n as f64 * interval, 4, 1.0);
        let shot = Shot::from_firings((0..100).map(firing).collect());
        for method in METHODS {
            stable("100 in turn", &scene, &shot, method, 1e-4, steps(method));
        }
    }
}

/// Time is counted from the firing, so it costs no digits to fire late.
#[test]
fn firing_after_1e5_s_is_firing_at_0() {
    let scene = cross();
    for method in METHODS {
        let late = Shot::from_firings(vec![Firing::up(1e5, 4, LAUNCH)]);
        let out = stable("late", &scene, &late, method, 1e-4, steps(method));
        let early = stable("early", &scene, &fire(&[4], LAUNCH), method, 1e-4, steps(method));
        assert_eq!(out.height.value, early.height.value);
        assert_eq!(out.force.value, early.force.value);
        close(out.height.time, 1e5 + early.height.time, 1e-10, "time of the top");
    }
}

/// Two crosses far apart, the second fired ten hours after the first, against one cross fired alone; and one tire twice.
#[test]
fn ten_hours_between_two_firings_are_two_runs() {
    let pause = 36_000.0;
    let one = cross();
    let mut two = cross();
    two.position.extend(one.position.iter().map(|p| p + Vector3::x() * 100.0));
    two.mass.extend(&one.mass);
    two.tire_ids.extend(&one.tire_ids);
    let moved = |cable: &shelter::scene::Cable| {
        let mut cable = *cable;
        cable.ends = cable.ends.map(|end| end + 5);
        cable
    };
    two.cables.extend(one.cables.iter().map(moved));
    let lone = tires(&[(0.0, 0.0)], 280.0);
    for method in METHODS {
        let settings = settings(method, 5e-4, None);
        let alone = run(&one, &fire(&[4], LAUNCH), settings);
        let weaker = run(&one, &fire(&[4], 5.0), settings);
        let both = Shot::from_firings(vec![Firing::up(0.0, 4, 5.0), Firing::up(pause, 9, LAUNCH)]);
        let out = run(&two, &both, settings);
        // The same but for the order in which energies and forces are summed.
        close(out.height.value, alone.height.value, 1e-9, "height");
        close(out.height.time, pause + alone.height.time, 1e-9, "time of the top");
        close(out.force.value, alone.force.value, 1e-9 * alone.force.value, "force");
        close(out.drift.value, alone.drift.value.max(weaker.drift.value), 1e-9, "drift");
        close(out.end.time, pause + alone.end.time, 1e-6, "end");
        assert_eq!(out.steps, alone.steps + weaker.steps, "{method:?}: the pause takes no step");
        let energies = alone.ledger.dissipated + weaker.ledger.dissipated;
        close(out.ledger.dissipated, energies, 1e-9 * energies, "dissipated");

        let twice = Shot::from_firings(vec![Firing::up(0.0, 0, LAUNCH), Firing::up(pause, 0, LAUNCH)]);
        let out = run(&lone, &twice, settings);
        assert_eq!(out.steps, 2 * run(&lone, &fire(&[0], LAUNCH), settings).steps);
    }
}
