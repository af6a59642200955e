//! The greatest force between two steps, where holes fire on taut cables and pushes begin and end: against closed forms, and
//! against fine runs of which every step is looked at and nothing lies between.

use std::ops::ControlFlow;

use nalgebra::Vector3;
use shelter::choice::Method;
use shelter::plan::{HoleTiming, Plan, Time};
use shelter::scene::{Firing, Scene, Shot};
use shelter::simulation::{Model, Motion};
use shelter::study::{Case, ComputeSettings};
use shelter::verdict::Estimate;

use super::support::scenes::{METHODS, settings, tie, tires};
use super::support::{Edited, small_plan};

const DAMPING: [f64; 5] = [0.0, 0.05, 0.2, 0.5, 0.8];
const MASS: f64 = 280.0;
/// Speed at which the two masses part at first [m/s].
const SPEED: f64 = 2.0;

/// The force of a shot at a step [s], with its error, as a check tells it.
fn force(case: &Case, method: Method, step: f64) -> Estimate {
    let compute = ComputeSettings { method, step: Some(step), ..ComputeSettings::of(&case.plan) };
    case.check_as_planned(0, &compute).expect("the runs have outcomes").estimates.force
}

/// How many errors hold the truth; each that does not is told.
#[derive(Default)]
struct Held {
    within: usize,
    all: usize,
}

impl Held {
    fn note(&mut self, found: Estimate, exact: f64, resolved: f64, of: &str) {
        let off = (found.value - exact).abs();
        self.all += 1;
        if off <= found.error + resolved * exact {
            self.within += 1;
        } else {
            println!("{of}: {:.2} ± {:.2} is {off:.2} from {exact:.2}", found.value, found.error);
        }
        assert!(
            off <= 3.0 * found.error + 1e-3 * exact,
            "{of}: {} ± {}, not {exact}",
            found.value,
            found.error
        );
    }

    /// The errors hold in 19 of 20, as errors shall.
    fn assert(&self) {
        println!("{} of {} errors hold", self.within, self.all);
        assert!(self.all > 20 && 20 * self.within >= 19 * self.all, "{} of {}", self.within, self.all);
    }
}

/// Two free masses on a cable that is just taut, without gravity.
struct TwoMasses {
    scene: Scene,
    /// Damping ζ, natural frequency ω [rad/s], stiffness [N/m] and viscosity [N s/m].
    damping: f64,
    omega: f64,
    stiffness: f64,
    viscosity: f64,
}

impl TwoMasses {
    fn new(damping: f64) -> Self {
        let mut scene = tires(&[(0.0, 0.0), (2.0, 0.0)], MASS);
        (scene.gravity, scene.friction, scene.damping) = (0.0, 0.0, damping);
        tie(&mut scene, 0, 1, 2e6, 1.0);
        let (stiffness, reduced) = (scene.cables[0].stiffness, 0.5 * MASS);
        let viscosity = 2.0 * damping * (stiffness * reduced).sqrt();
        Self { scene, damping, omega: (stiffness / reduced).sqrt(), stiffness, viscosity }
    }

    /// Stretch and its rate after a time, where s″ + 2ζω s′ + ω² s = `pull`.
    fn swing(&self, [stretch, rate]: [f64; 2], pull: f64, time: f64) -> [f64; 2] {
        let centre = pull / (self.omega * self.omega);
        let (decay, frequency) =
            (self.damping * self.omega, self.omega * (1.0 - self.damping * self.damping).sqrt());
        let (sin, cos) = (frequency * time).sin_cos();
        let [from, turned] = [stretch - centre, (rate + decay * (stretch - centre)) / frequency];
        let fading = (-decay * time).exp();
        let swing = fading * (from * cos + turned * sin);
        [centre + swing, fading * frequency * (turned * cos - from * sin) - decay * swing]
    }

    fn force(&self, [stretch, rate]: [f64; 2]) -> f64 {
        if stretch < 0.0 { 0.0 } else { self.stiffness * stretch + self.viscosity * rate }
    }

    /// Greatest force over a `time` [s] of one swing that begins with a stretch and its rate under a pull.
    fn greatest(&self, from: [f64; 2], pull: f64, time: f64) -> f64 {
        let at = |n: u32| self.force(self.swing(from, pull, time * f64::from(n) / 20_000.0));
        (0..=20_000).map(at).fold(0.0, f64::max)
    }

    /// The two part at [`SPEED`], and the second does what `firing` says; a run of `duration` [s].
    fn case(&self, firing: Firing, duration: f64) -> Case {
        let plan = Plan::parse("", &small_plan()).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let mut case = Case::new(plan);
        case.plan.simulation.duration_s = Some(duration);
        let launch = Vector3::x() * (0.5 * SPEED);
        let firings = vec![Firing::at_once(0.0, 0, -launch), Firing::at_once(0.0, 1, launch), firing];
        (case.model, case.shots) = (Model::new(self.scene.clone()), vec![Shot::from_firings(firings)]);
        case
    }
}

/// What a trace shows of a damped cable is its force at that time, with an error of second order: a quarter at half the step. The
/// force of half a step ago is off by a whole order more.
#[test]
fn the_force_of_a_damped_cable_in_a_trace_is_that_of_its_time() {
    for two in [0.05, 0.2, 0.5].map(TwoMasses::new) {
        let end = 1.0 / two.omega;
        let still = Firing::at_once(0.5 * end, 1, Vector3::zeros());
        let case = two.case(still, end);
        let farthest = |step: f64| {
            let mut off: f64 = 0.0;
            let mut look = |motion: &dyn Motion| {
                let time = motion.time();
                if time > 2.5 * step && time < end {
                    off = off.max((motion.force(0) - two.force(two.swing([0.0, SPEED], 0.0, time))).abs());
                }
                ControlFlow::Continue(())
            };
            let settings = settings(Method::Verlet, step, Some(end));
            case.model.run(&case.shots[0], &settings, &mut look).expect("the run has an outcome");
            off / two.greatest([0.0, SPEED], 0.0, end)
        };
        let [coarse, fine] = [0.04, 0.02].map(|step| farthest(step / two.omega));
        assert!(coarse < 0.002 && fine < 0.3 * coarse, "ζ {}: {coarse:e}, {fine:e}", two.damping);
    }
}

/// A hole fires under one of two masses on a taut cable, and the speed at which they part changes by Δ at once. The stretch is that
/// of a damped swing before and after, and the force k s + c s′ is greatest in one of them, just before the hole fires, or just
/// after: a parabola through both sides adds an eighth of the drop.
#[test]
fn a_hole_that_fires_on_a_taut_cable_leaves_its_greatest_force() {
    let mut held = Held::default();
    for two in DAMPING.map(TwoMasses::new) {
        for change in [-3.0, -0.7, 0.6] {
            for part in 1..8 {
                let at = 0.17 * f64::from(part) / two.omega;
                let [stretch, rate] = two.swing([0.0, SPEED], 0.0, at);
                let after = 2.0 / two.omega;
                let exact = two.greatest([0.0, SPEED], 0.0, at);
                let exact = exact.max(two.greatest([stretch, rate + change], 0.0, after));
                let case = two.case(Firing::at_once(at, 1, Vector3::x() * change), at + after);
                for method in
                    METHODS.into_iter().filter(|&method| method == Method::Verlet || two.damping == 0.0)
                {
                    for step in [0.1, 0.031, 0.009] {
                        let found = force(&case, method, step / two.omega);
                        let of = format!("{method:?} ζ {} Δ {change} part {part} ωh {step}", two.damping);
                        held.note(found, exact, 1e-6, &of);
                    }
                }
            }
        }
    }
    held.assert();
}

/// A push on one of two masses on a taut damped cable is a pull on their stretch from its start to its end, where the force has
/// kinks.
#[test]
fn a_push_that_ends_on_a_taut_cable_leaves_its_greatest_force() {
    let mut held = Held::default();
    for two in DAMPING.map(TwoMasses::new) {
        for change in [-3.0, 1.5] {
            for part in 1..7 {
                let (at, push) = (0.17 * f64::from(part) / two.omega, 0.37 / two.omega);
                let begun = two.swing([0.0, SPEED], 0.0, at);
                let ended = two.swing(begun, change / push, push);
                let after = 2.0 / two.omega;
                let exact = two.greatest([0.0, SPEED], 0.0, at);
                let exact =
                    exact.max(two.greatest(begun, change / push, push)).max(two.greatest(ended, 0.0, after));
                let firing = Firing { push_time: push, ..Firing::at_once(at, 1, Vector3::x() * change) };
                let case = two.case(firing, at + push + after);
                for step in [0.1, 0.031, 0.009] {
                    let found = force(&case, Method::Verlet, step / two.omega);
                    held.note(
                        found,
                        exact,
                        1e-6,
                        &format!("ζ {} Δ {change} part {part} ωh {step}", two.damping),
                    );
                }
            }
        }
    }
    held.assert();
}

/// Three rows over damped cables, at three steps: against the greatest force of any step of a run at 4 µs. Between two of these it
/// changes by 2e-4 of its value at most, but where a hole fires.
#[test]
fn forces_of_damped_cables_hold_against_a_fine_run() {
    let mut held = Held::default();
    for damping in [5, 20, 50, 80] {
        for interval in [20, 42] {
            let text = small_plan()
                .edited("slack_percent = 2\n", &format!("slack_percent = 2\ndamping_percent = {damping}\n"));
            let plan = Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
            let mut case = Case::new(plan);
            case.plan.simulation.duration_s = Some(0.3);
            let interval_s = f64::from(interval) * 1e-3;
            case.shots = vec![case.shot(&[0, 1, 2], Time::from_ms(1e3 * interval_s), &HoleTiming::TOGETHER)];
            let mut exact = 0.0_f64;
            let fine = settings(Method::Verlet, 4e-6, Some(0.3));
            let cables = case.scene().cables.len();
            let watched = case.model.run(&case.shots[0], &fine, &mut |motion| {
                exact = (0..cables).map(|cable| motion.force(cable)).fold(exact, f64::max);
                ControlFlow::Continue(())
            });
            watched.expect("the run has an outcome");
            for step in [3e-4, 1.2e-4, 5e-5] {
                let found = force(&case, Method::Verlet, step);
                held.note(found, exact, 2e-4, &format!("ζ {damping} % at {interval} ms, step {step}"));
            }
        }
    }
    held.assert();
}
