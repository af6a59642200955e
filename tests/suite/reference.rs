//! Both methods against the event-driven reference answers, and against each other.

use shelter::choice::Method;
use shelter::outcome::EndReason;

use crate::support::scenes::{METHODS, close, fire, fire_rows, grid, quincunx, run, settings};

/// Four reference scenes: height [m], force [N]; the digits given end at 5e-6 m and 0.05 N. `cargo bench --bench validation -- 20x20`
/// makes them again.
#[test]
fn the_reference_answers_are_found() {
    // Measured at these steps: verlet within 0.001 % and 0.001 %, newmark within 0.004 % and 0.03 %.
    for (method, step, height_tolerance, force_tolerance) in
        [(Method::Verlet, 2e-4, 3e-5, 5e-5), (Method::Newmark, 2e-4, 1e-4, 1e-3)]
    {
        let check = |scene, shot, height: f64, force: f64, name: &str| {
            let out = run(&scene, &shot, settings(method, step, Some(1.0)));
            close(out.height.value, height, height_tolerance * height + 5e-6, name);
            close(out.force.value, force, force_tolerance * force + 0.05, name);
        };
        check(quincunx(2.0, 1.4e6), fire(&[4], 6.0), 1.08394, 10015.6, "2 m diagonal");
        check(quincunx(1.0, 1.519e6), fire(&[4], 6.0), 0.75741, 17735.7, "1 m diagonal");
        let rows = fire_rows(&[1, 2, 3], 10, 0.02);
        check(grid(5, 10, 1.5, 1.4e6), rows, 1.76711, 10016.8, "5 x 10");
        if method == Method::Verlet {
            let rows = fire_rows(&(5..15).collect::<Vec<_>>(), 20, 0.02);
            check(grid(20, 20, 1.5, 1.4e6), rows, 1.82570, 26750.4, "20 x 20");
        }
    }
}

/// The source paper's scene at its own step: figures of the converged solution, the perimeter never pulls.
#[test]
fn the_paper_scene_has_its_numbers_at_its_step() {
    let scene = quincunx(1.0, 1.519e6);
    for (method, height, force, at_160_ms) in
        [(Method::Verlet, 1e-4, 1e-4, 2e-3), (Method::Newmark, 5e-3, 5e-3, 2e-2)]
    {
        let (mut diagonal, mut perimeter) = (f64::NAN, 0.0_f64);
        let settings = settings(method, 2e-4, Some(1.0));
        let out = crate::support::scenes::watch(&scene, &fire(&[4], 6.0), settings, |motion| {
            let force = |n: usize| {
                let cable = &scene.cables[n];
                let [a, b] = cable.ends.map(|end| motion.displacement(end));
                cable.force((cable.span + (b - a)).norm())
            };
            perimeter = (0..4).map(force).fold(perimeter, f64::max);
            if (motion.time() - 0.16).abs() < 1e-9 {
                diagonal = force(4);
            }
        });
        close(out.height.value, 0.75741, height * 0.75741, "height");
        close(out.force.value, 17735.7, force * 17735.7, "force");
        close(diagonal, 7114.2, at_160_ms * 7114.2, "force at 0.16 s");
        assert_eq!(perimeter, 0.0, "perimeter cables never pull");
    }
}

#[test]
fn both_methods_converge_to_one_answer() {
    let (scene, shot) = (grid(5, 10, 1.5, 1.519e6), fire_rows(&[1, 2, 3], 10, 0.02));
    let verlet = run(&scene, &shot, settings(Method::Verlet, 1e-4, Some(1.0)));
    let newmark = run(&scene, &shot, settings(Method::Newmark, 1e-4, Some(1.0)));
    close(newmark.height.value, verlet.height.value, 5e-4 * verlet.height.value, "height");
    close(newmark.force.value, verlet.force.value, 5e-4 * verlet.force.value, "force");
    close(verlet.height.value, 1.7655, 5e-4 * 1.7655, "height of the reference table");
    close(verlet.force.value, 9926.0, 5e-4 * 9926.0, "force of the reference table");
}

/// Halving the step divides the error by four where the motion is smooth: the pinned cross of the closed forms.
#[test]
fn both_methods_are_of_second_order() {
    let mut scene = quincunx(2.65, 1.41e6);
    scene.friction = 1e9;
    scene.mass[..4].fill(1e9);
    let exact = 0.554_923_923;
    for method in crate::support::scenes::METHODS {
        let error = |h: f64| {
            let out = run(&scene, &fire(&[4], 6.0), settings(method, h, Some(0.2)));
            (out.height.value - exact).abs()
        };
        // Averaged over neighbouring steps, so that where the step falls against the top does not matter.
        let mean = |h: f64| [0.9, 0.97, 1.0, 1.06, 1.11].map(|part| error(part * h)).iter().sum::<f64>();
        let order = (mean(2e-3) / mean(1e-3)).log2();
        assert!((1.7..2.4).contains(&order), "{method:?}: order {order}");
    }
}

/// The end asked for falls between two steps: drift is that of the end, not of the step after it.
#[test]
fn drift_is_that_of_the_end_asked_for() {
    let (scene, shot) = (grid(2, 3, 1.5, 1.4e6), fire_rows(&[0], 3, 0.0));
    for method in METHODS {
        let drift = |h: f64| run(&scene, &shot, settings(method, h, Some(0.403))).drift;
        let (coarse, fine) = (drift(2.7e-4), drift(2e-6));
        assert!((coarse.time - 0.403).abs() < 1e-12, "{}", coarse.time);
        // 0.4 of a step later it is further by 4e-4.
        close(coarse.value, fine.value, 2e-4 * fine.value, "drift");
    }
}

/// Fifty by fifty tires until the last of them lies still.
#[test]
fn a_large_shelter_comes_to_rest_and_stays_bounded() {
    let scene = grid(50, 50, 1.5, 1.519e6);
    let out = run(&scene, &fire_rows(&[23, 24, 25], 50, 0.02), settings(Method::Verlet, 1e-3, None));
    assert_eq!(out.end.reason, EndReason::AtRest);
    assert!(out.end.time < 10.0, "{} s", out.end.time);
    assert!(out.history.height.len() <= shelter::outcome::History::CAPACITY);
    // (ωh)² of the elastic part of the energy, with ωh = 2h / critical step.
    let omega_h: f64 = 2e-3 / scene.critical_step();
    assert!(out.ledger.residual() < 0.1 * omega_h.powi(2), "{:e}", out.ledger.residual());
}
