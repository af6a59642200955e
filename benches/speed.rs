//! How fast the stepping loop is: `cargo bench --bench speed`. Items are cable-steps of the whole shelter, asleep or not.

use std::ops::ControlFlow;

use divan::Bencher;
use divan::counter::ItemsCount;
use shelter::choice::Method;
use shelter::plan::{DelayScatter, Plan, Uncertainty};
use shelter::simulation::{Model, Motion, RunSettings};
use shelter::study::StudyControl;
use shelter::study::as_planned::check;
use shelter::study::samples::random_shot::{DrawnShot, draw_shot};
use shelter::study::work::batch::run_batch;
use shelter::study::{Case, NoResult};

fn main() {
    divan::main();
}

/// `rows` × `columns` tires, with blast rows under the middle ones, 20 ms apart, or a single hole in the middle.
fn case(rows: usize, columns: usize, blast_rows: usize) -> Case {
    let mut text = format!(
        r#"
shelter = {{ layout = "grid", rows = {rows}, columns = {columns}, spacing_m = 1.5 }}
tire = {{ mass_kg = 280 }}
cable = {{ axial_stiffness_kn = 1400, breaking_force_kn = 45 }}
ground = {{ friction = 0.5 }}
limits = {{ flight_height_m = 1.8, cable_safety_factor = 2 }}
delay = [{{ name = "20 ms", interval_ms = 20 }}]
"#
    );
    for n in 0..blast_rows {
        let row = rows / 2 + n;
        text += &format!("[[blast_row]]\nname = \"{n}\"\nunder_row = {row}\nlaunch_m_s = 6\n");
    }
    if blast_rows == 0 {
        let [x, y] = [columns, rows].map(|n| (n / 2) as f64 * 1.5);
        text +=
            &format!("[[blast_row]]\nname = \"1\"\nholes = [{{ x_m = {x}, y_m = {y}, launch_m_s = 6 }}]\n");
    }
    Case::new(Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")))
}

/// The same model without its mirror planes.
fn whole(case: &Case) -> Model {
    let mut scene = case.scene().clone();
    scene.mirrors.clear();
    Model::new(scene)
}

fn time(bencher: Bencher, model: &Model, case: &Case, method: Method, step: f64, duration: Option<f64>) {
    let settings = RunSettings { method, step, duration };
    let run = || model.run(&case.shots[0], &settings, &mut |_| ControlFlow::Continue(()));
    let steps = run().expect("a result").steps;
    bencher.counter(ItemsCount::new(steps * model.scene().cables.len())).bench_local(run);
}

/// One run at 2 ms by size, three rows fired; without mirrors, what a longer line costs is a straight line.
#[divan::bench(args = [5, 10, 20, 50, 100, 300, 1000], max_time = 20)]
fn by_size(bencher: Bencher, n: usize) {
    let case = case(n, n, 3);
    time(bencher, &whole(&case), &case, Method::Verlet, 2e-3, None);
}

/// The same with mirror planes.
#[divan::bench(args = [5, 20, 50, 100, 300])]
fn by_size_with_mirrors(bencher: Bencher, n: usize) {
    let case = case(n, n, 3);
    time(bencher, &case.model, &case, Method::Verlet, 2e-3, None);
}

/// One hole in the middle of a small and of a large shelter.
#[divan::bench(args = [Method::Verlet, Method::Newmark].into_iter().flat_map(|method| [30, 100, 300].map(|n| (method, n))))]
fn single_hole(bencher: Bencher, (method, n): (Method, usize)) {
    let case = case(n, n, 0);
    time(bencher, &whole(&case), &case, method, 2e-3, None);
}

/// Both methods at the same step.
#[divan::bench(args = [Method::Verlet, Method::Newmark])]
fn by_method(bencher: Bencher, method: Method) {
    let case = case(20, 20, 3);
    time(bencher, &whole(&case), &case, method, 2e-3, Some(0.5));
}

/// A batch of samples of 1.5 s on all cores; cable-steps of the whole 1.5 s count, at rest or not.
#[divan::bench(args = [(5, 10, 1000), (50, 50, 100)], max_time = 20)]
fn scattered(bencher: Bencher, (rows, columns, samples): (usize, usize, usize)) {
    let mut case = case(rows, columns, 3);
    case.plan.uncertainty = Uncertainty {
        delay: DelayScatter { sd_ms: 1.0, cv_percent: 0.0 },
        launch_cv_percent: 5.0,
        friction: [0.4, 0.6],
        ..case.plan.uncertainty
    };
    let drawn: Vec<_> = (0..samples).map(|number| draw_shot(&case, &case.shots[0], 1, number)).collect();
    let settings = RunSettings { method: Method::Verlet, step: 2e-3, duration: Some(1.5) };
    let run = || {
        run_batch(&drawn, &StudyControl::default(), |DrawnShot { scene, shot, .. }| {
            let watch = &mut |_: &dyn Motion| ControlFlow::Continue(());
            case.model.run_variant(scene, shot, &settings, watch).map_err(NoResult::Failed)
        })
    };
    bencher.counter(ItemsCount::new(samples * case.scene().cables.len() * 750)).bench_local(run);
}

/// Ten checked options on 50 × 50, from one change to the last verdict.
#[divan::bench]
fn ten_options_checked(bencher: Bencher) {
    let plan = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("plans/large-50x50.toml");
    let case = Case::new(Plan::load(&plan).unwrap_or_else(|mistakes| panic!("{mistakes}")));
    let compute = shelter::study::ComputeSettings {
        accuracy: shelter::choice::Accuracy::Draft,
        ..shelter::study::ComputeSettings::of(&case.plan)
    };
    let options: Vec<usize> = (0..case.shots.len()).collect();
    bencher.bench_local(|| {
        run_batch(&options, &StudyControl::default(), |&option| {
            check::check_as_planned(&case, option, &compute, &mut |_| ControlFlow::Continue(()))
                .map_err(NoResult::Failed)
        })
    });
}
