//! Cables that break are gone, and take their energy with them.

use shelter::choice::Method;
use shelter::scene::Scene;

use crate::support::scenes::{GRAVITY, METHODS, close, fire, fire_rows, grid, run, settings, tie, tires};

/// A tire tied to its neighbour by a thread flies as if free: the thread breaks within a step of becoming taut, having
/// taken at most its strength times that step from the tire's momentum (60 N over 1e-4 s from 280 kg at 6 m/s).
#[test]
fn a_thread_does_not_hold_a_tire() {
    let mut scene = tires(&[(0.0, 0.0), (1.5, 0.0)], 280.0);
    tie(&mut scene, 0, 1, 1.4e6, 1.0);
    scene.breaking_force = Some(60.0);
    for method in METHODS {
        let out = run(&scene, &fire(&[0], 6.0), settings(method, 1e-4, None));
        close(out.height.value, 36.0 / (2.0 * GRAVITY), 1e-5, "free flight");
        assert_eq!(out.broken.len(), 1, "{method:?}");
        assert_eq!(out.broken[0].cable, 0);
    }
}

/// No cable breaks that stays below its strength, and then the run is the one in which cables cannot break.
#[test]
fn strong_cables_change_nothing() {
    let scene = grid(4, 4, 1.5, 1.4e6);
    let shot = fire_rows(&[1, 2], 4, 0.02);
    for method in METHODS {
        let settings = settings(method, 1e-3, Some(0.6));
        let plain = run(&scene, &shot, settings);
        let strong = Scene { breaking_force: Some(1.01 * plain.force.value), ..scene.clone() };
        assert_eq!(run(&strong, &shot, settings), plain);
    }
}

/// The ledger counts what broken cables had stored; both methods break the same cables first.
#[test]
fn the_ledger_closes_over_breaking_cables() {
    let mut scene = grid(4, 5, 1.5, 1.4e6);
    let shot = fire_rows(&[1], 5, 0.0);
    let whole = run(&scene, &shot, settings(Method::Verlet, 2e-4, Some(0.4)));
    scene.breaking_force = Some(0.5 * whole.force.value);
    let mut first = Vec::new();
    for method in METHODS {
        let out = run(&scene, &shot, settings(method, 1e-4, Some(0.4)));
        assert!(out.broken.len() > 1, "{method:?}: {}", out.broken.len());
        assert!(out.ledger.residual() < 2e-3, "{method:?} {:e}", out.ledger.residual());
        assert!(out.height.value > whole.height.value, "{method:?}");
        assert!(out.broken.windows(2).all(|pair| pair[0].time <= pair[1].time));
        first.push(out.broken[0].time);
    }
    close(first[0], first[1], 2e-4, "first break, two steps apart at most");
}
