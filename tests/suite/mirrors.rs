//! Half and quarter shelters are the whole ones.

use nalgebra::Vector3;
use proptest::prelude::*;
use shelter::choice::Method;
use shelter::plan::Plan;
use shelter::scene::{Firing, Scene, Shot, build};
use shelter::simulation::Model;

use crate::support::scenes::{run, settings, watch};

/// A shelter from a plan, so that its mirror planes are found.
fn shelter(layout: &str, rows: usize, columns: usize, slack: f64) -> Scene {
    let text = format!(
        r#"
shelter = {{ layout = "{layout}", rows = {rows}, columns = {columns}, spacing_m = 1.7 }}
tire = {{ mass_kg = 280 }}
cable = {{ axial_stiffness_kn = 1400, breaking_force_kn = 20, slack_percent = {slack} }}
ground = {{ friction = 0.4 }}
blast_row = [{{ name = "1", under_row = 1, launch_m_s = 6 }}]
limits = {{ flight_height_m = 1, cable_safety_factor = 1 }}
delay = [{{ name = "1", interval_ms = 0 }}]
"#
    );
    build(&Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")))
}

#[test]
fn planes_are_found_and_shared_with_what_fires() {
    let scene = shelter("grid", 5, 8, 0.0);
    let row = |row: usize, at: f64| (0..8).map(move |column| Firing::up(at, row * 8 + column, 6.0));
    let shot = |firings: Vec<Firing>| Shot::from_firings(firings);
    assert_eq!(modelled_tires(&scene, &shot(row(2, 0.0).collect())), 12, "the middle row: a quarter");
    assert_eq!(modelled_tires(&scene, &shot(row(1, 0.0).collect())), 20, "another row: a half");
    let both = row(1, 0.0).chain(row(3, 0.02)).collect();
    assert_eq!(modelled_tires(&scene, &shot(both)), 20, "rows one after the other: a half");
    let tilted = |toward: Vector3<f64>| row(2, 0.0).map(move |f| Firing { launch: f.launch + toward, ..f });
    assert_eq!(modelled_tires(&scene, &shot(tilted(Vector3::y()).collect())), 20, "tilted along y: a half");
    assert_eq!(modelled_tires(&scene, &shot(tilted(Vector3::x()).collect())), 24, "tilted along x: a half");
    let apart = row(2, 0.0).map(|f| Firing { launch: f.launch + Vector3::x() * (f.tire as f64 - 19.5), ..f });
    assert_eq!(modelled_tires(&scene, &shot(apart.collect())), 12, "tilted away from the middle: a quarter");
    let corner = Firing::up(0.0, 0, 6.0);
    assert_eq!(modelled_tires(&scene, &shot(vec![corner])), 40, "a corner: the whole");
    let quincunx = shelter("quincunx", 2, 2, 0.0);
    let centre = Firing::up(0.0, 4, 6.0);
    assert_eq!(
        modelled_tires(&quincunx, &shot(vec![centre])),
        2,
        "the paper's shelter: a corner and the centre"
    );
}

fn modelled_tires(scene: &Scene, shot: &Shot) -> usize {
    Model::new(scene.clone()).modelled_tires(Method::Verlet, shot)
}

/// What breaks in the part that is modelled breaks in its images, too.
#[test]
fn cables_break_in_the_images_as_well() {
    for layout in ["grid", "quincunx"] {
        let scene = Scene { breaking_force: Some(15e3), ..shelter(layout, 4, 5, 0.5) };
        let whole = Scene { mirrors: Vec::new(), ..scene.clone() };
        let row = (5..10).map(|tire| Firing::up(0.0, tire, 7.0));
        let shot = Shot::from_firings(row.collect());
        let settings = settings(Method::Verlet, 5e-4, Some(0.4));
        let broken = |scene: &Scene| {
            let mut cables: Vec<usize> =
                run(scene, &shot, settings).broken.iter().map(|broken| broken.cable).collect();
            cables.sort_unstable();
            cables
        };
        assert!(broken(&scene).len() > 2, "{layout}");
        assert_eq!(broken(&scene), broken(&whole), "{layout}");
        // What is broken pulls no more.
        let first = broken(&scene)[0];
        for scene in [&scene, &whole] {
            let mut forces = Vec::new();
            watch(scene, &shot, settings, |motion| forces.push(motion.force(first)));
            let last = forces.iter().rposition(|&force| force > 0.0).expect("it pulled");
            assert!(forces[last] < 15e3 && last + 1 < forces.len(), "{layout}: {}", forces[last]);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, ..ProptestConfig::default() })]

    /// The same run without looking for mirrors: the same envelopes, ledger and places of every tire. Only the order of
    /// summation differs, 1e-16 at first; impacts multiply that, by less than 1e4 in the time given.
    #[test]
    fn a_quotient_moves_as_the_whole(
        quincunx in any::<bool>(),
        (rows, columns) in (2..6_usize, 2..7_usize),
        slack in 0.0..4.0,
        fired in proptest::collection::vec((0..6_usize, 0.0..0.2, 2.0..7.0), 1..4),
    ) {
        let scene = shelter(if quincunx { "quincunx" } else { "grid" }, rows, columns, slack);
        let whole = Scene { mirrors: Vec::new(), ..scene.clone() };
        let row = |&(row, at, launch): &(usize, f64, f64)| {
            (0..columns).map(move |column| Firing::up(at, (row % rows) * columns + column, launch))
        };
        let shot = Shot::from_firings(fired.iter().flat_map(row).collect());
        prop_assert!(modelled_tires(&scene, &shot) < scene.tire_count());
        let settings = settings(Method::Verlet, 1e-3, Some(0.5));
        let (part, full) = (run(&scene, &shot, settings), run(&whole, &shot, settings));
        let close = |a: f64, b: f64| (a - b).abs() <= 1e-12 + 1e-9 * b.abs();
        prop_assert!(close(part.height.value, full.height.value), "{} {}", part.height.value, full.height.value);
        prop_assert!(close(part.force.value, full.force.value), "{} {}", part.force.value, full.force.value);
        prop_assert!(close(part.drift.value, full.drift.value), "{} {}", part.drift.value, full.drift.value);
        prop_assert!(close(part.ledger.put_in, full.ledger.put_in));
        prop_assert!((part.ledger.dissipated - full.ledger.dissipated).abs() <= 1e-8 * full.ledger.put_in);
        prop_assert!((part.ledger.greatest_residual - full.ledger.greatest_residual).abs() <= 1e-8 * full.ledger.put_in);
        let places = |scene: &Scene| {
            let mut all = Vec::new();
            watch(scene, &shot, settings, |motion| {
                all.extend((0..scene.tire_count()).map(|tire| motion.displacement(tire)));
            });
            all
        };
        for (a, b) in places(&scene).iter().zip(places(&whole)) {
            prop_assert!((a - b).norm() < 1e-9);
        }
    }
}
