//! How fast the stepping loop is: `cargo bench --bench speed`, or of the rows whose names contain an argument. Items are cable-steps of
//! the whole shelter, asleep or not. With `--test` each row runs once.

use std::hint::black_box;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use shelter::choice::Method;
use shelter::plan::{DelayScatter, Plan, Uncertainty};
use shelter::simulation::{Model, Motion, RunSettings};
use shelter::study::StudyControl;
use shelter::study::as_planned::check;
use shelter::study::samples::random_shot::{DrawnShot, draw_shot};
use shelter::study::work::batch::run_batch;
use shelter::study::{Case, NoResult};

const MOST_RUNS: usize = 100;
const LONGEST: Duration = Duration::from_secs(20);

/// What the arguments ask for.
struct Bench {
    wanted: Vec<String>,
    runs: usize,
}

impl Bench {
    fn asked() -> Self {
        let (switches, wanted): (Vec<String>, _) =
            std::env::args().skip(1).partition(|it| it.starts_with("--"));
        let once = switches.iter().any(|switch| switch == "--test");
        Self { wanted, runs: if once { 1 } else { MOST_RUNS } }
    }

    fn wants(&self, name: &str) -> bool {
        self.wanted.is_empty() || self.wanted.iter().any(|wanted| name.contains(wanted.as_str()))
    }

    /// Prints the least and the median time of runs one after the other, and items per second in the least.
    fn time<T>(&self, name: &str, items: usize, run: impl Fn() -> T) {
        let begun = Instant::now();
        let mut times = Vec::new();
        while times.len() < self.runs && (times.is_empty() || begun.elapsed() < LONGEST) {
            let begun = Instant::now();
            black_box(run());
            times.push(begun.elapsed().as_secs_f64());
        }
        times.sort_by(f64::total_cmp);
        let (least, median) = (times[0], times[times.len() / 2]);
        let speed = items as f64 / least;
        println!(
            "{name:<32} least {least:.6} s, median {median:.6} s of {}, {speed:.4e} items/s",
            times.len()
        );
    }
}

fn main() {
    let bench = Bench::asked();
    for n in [5, 10, 20, 50, 100, 300, 1000] {
        by_size(&bench, n);
    }
    for n in [5, 20, 50, 100, 300] {
        by_size_with_mirrors(&bench, n);
    }
    for method in [Method::Verlet, Method::Newmark] {
        for n in [30, 100, 300] {
            single_hole(&bench, method, n);
        }
        by_method(&bench, method);
    }
    scattered(&bench, 5, 10, 1000);
    scattered(&bench, 50, 50, 100);
    ten_options_checked(&bench);
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

/// Times runs of a case, with or without its mirror planes.
fn time_runs(bench: &Bench, name: &str, case: impl FnOnce() -> (Case, Model), settings: RunSettings) {
    if !bench.wants(name) {
        return;
    }
    let (case, model) = case();
    let run = || model.run(&case.shots[0], &settings, &mut |_| ControlFlow::Continue(()));
    let steps = run().expect("a result").steps;
    bench.time(name, steps * model.scene().cables.len(), run);
}

/// Settings of a run at 2 ms.
fn settings(method: Method, duration: Option<f64>) -> RunSettings {
    RunSettings { method, step: 2e-3, duration }
}

fn without_mirrors(case: Case) -> (Case, Model) {
    let model = whole(&case);
    (case, model)
}

/// One run by size, three rows fired; without mirrors, what a longer line costs is a straight line.
fn by_size(bench: &Bench, n: usize) {
    let case = || without_mirrors(case(n, n, 3));
    time_runs(bench, &format!("by_size {n}"), case, settings(Method::Verlet, None));
}

/// The same with mirror planes.
fn by_size_with_mirrors(bench: &Bench, n: usize) {
    let with_mirrors = || {
        let case = case(n, n, 3);
        let model = case.model.clone();
        (case, model)
    };
    time_runs(bench, &format!("by_size_with_mirrors {n}"), with_mirrors, settings(Method::Verlet, None));
}

/// One hole in the middle of a small and of a large shelter.
fn single_hole(bench: &Bench, method: Method, n: usize) {
    let case = || without_mirrors(case(n, n, 0));
    time_runs(bench, &format!("single_hole {method:?} {n}"), case, settings(method, None));
}

/// Both methods at the same step.
fn by_method(bench: &Bench, method: Method) {
    let case = || without_mirrors(case(20, 20, 3));
    time_runs(bench, &format!("by_method {method:?}"), case, settings(method, Some(0.5)));
}

/// A batch of samples of 1.5 s on all cores; cable-steps of the whole 1.5 s count, at rest or not.
fn scattered(bench: &Bench, rows: usize, columns: usize, samples: usize) {
    let name = format!("scattered {rows}x{columns}");
    if !bench.wants(&name) {
        return;
    }
    let mut case = case(rows, columns, 3);
    case.plan.uncertainty = Uncertainty {
        delay: DelayScatter { sd_ms: 1.0, cv_percent: 0.0 },
        launch_cv_percent: 5.0,
        friction: [0.4, 0.6],
        ..case.plan.uncertainty
    };
    let drawn: Vec<_> = (0..samples).map(|number| draw_shot(&case, &case.shots[0], 1, number)).collect();
    let settings = settings(Method::Verlet, Some(1.5));
    let run = || {
        run_batch(&drawn, &StudyControl::default(), |DrawnShot { scene, shot, .. }| {
            let watch = &mut |_: &dyn Motion| ControlFlow::Continue(());
            case.model.run_variant(scene, shot, &settings, watch).map_err(NoResult::Failed)
        })
    };
    bench.time(&name, samples * case.scene().cables.len() * 750, run);
}

/// Ten checked options on 50 × 50, from one change to the last verdict. Items are options.
fn ten_options_checked(bench: &Bench) {
    if !bench.wants("ten_options_checked") {
        return;
    }
    let plan = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("plans/large-50x50.toml");
    let case = Case::new(Plan::load(&plan).unwrap_or_else(|mistakes| panic!("{mistakes}")));
    let compute = shelter::study::ComputeSettings {
        accuracy: shelter::choice::Accuracy::Draft,
        ..shelter::study::ComputeSettings::of(&case.plan)
    };
    let options: Vec<usize> = (0..case.shots.len()).collect();
    bench.time("ten_options_checked", options.len(), || {
        run_batch(&options, &StudyControl::default(), |&option| {
            check::check_as_planned(&case, option, &compute, &mut |_| ControlFlow::Continue(()))
                .map_err(NoResult::Failed)
        })
    });
}
