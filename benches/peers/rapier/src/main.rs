//! The shelter in Rapier: options in, one line of JSON out.

mod options;
mod scene;

use options::Options;
use scene::Scene;

/// What one run measured: its peaks, and the time of its stepping loop.
struct Outcome {
    height: f64,
    height_at: f64,
    force: f64,
    force_at: f64,
    wall: f64,
}

/// Rapier in single precision.
mod single {
    use rapier3d as rapier;
    include!("simulate.rs");
}

/// Rapier in double precision.
mod double {
    use rapier3d_f64 as rapier;
    include!("simulate.rs");
}

fn main() {
    let options = Options::from_arguments().unwrap_or_else(|mistake| {
        eprintln!("rapier-peer: {mistake}");
        std::process::exit(2);
    });
    let scene = Scene::build(&options);
    let simulate = match options.precision.as_str() {
        "f64" => double::simulate,
        _ => single::simulate,
    };
    let outcomes: Vec<Outcome> = (0..options.repeats.max(1)).map(|_| simulate(&scene, &options)).collect();
    print_json(&options, &outcomes);
}

fn print_json(options: &Options, outcomes: &[Outcome]) {
    let mut walls: Vec<f64> = outcomes.iter().map(|outcome| outcome.wall).collect();
    walls.sort_by(f64::total_cmp);
    let Outcome { height, height_at, force, force_at, .. } = outcomes[0];
    println!(
        "{{\"peer\": \"rapier\", \"version\": \"0.36.1\", \"precision\": \"{}\", \"dt_s\": {}, \"steps\": {}, \
         \"wall_s\": {{\"min\": {:.6}, \"median\": {:.6}}}, \
         \"height_m\": {height:.6}, \"height_at_s\": {height_at:.6}, \"force_n\": {force:.2}, \"force_at_s\": {force_at:.6}, \
         \"height_error\": {:.3e}, \"force_error\": {:.3e}}}",
        options.precision,
        options.step,
        options.steps(),
        walls[0],
        walls[walls.len() / 2],
        (height / options.reference_height - 1.0).abs(),
        (force / options.reference_force - 1.0).abs(),
    );
}
