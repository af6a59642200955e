//! The recorded motion against the closed form of free flight, and its bounds.

use shelter::plan::Plan;
use shelter::study::StudyControl;
use shelter::study::flight::record;
use shelter::study::{Case, ComputeSettings, Context};

use super::bad_plans::GOOD;
use super::support::Edited;
use super::support::scenes::{GRAVITY, close};

/// Tires that nothing ties fly as v t − g t²/2; the recording keeps single precision, 1e-7 of a few metres.
#[test]
fn loose_tires_fly_in_parabolas_and_lie_still_at_the_end() {
    let text = GOOD.edited("spacing_m = 1.5", "spacing_m = 1.5\nlinks = []");
    let plan = Plan::parse("plan.toml", &text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let case = Case::new(plan);
    for step in [1e-5, 1e-3] {
        let compute = ComputeSettings { step: Some(step), ..ComputeSettings::of(&case.plan) };
        let flight =
            record(&Context::new(&case, compute, &StudyControl::default()), 0, None).expect("a flight");
        let frames = flight.path(0, flight.end()).count();
        assert!((100..=1025).contains(&frames), "{frames} frames");
        // Shelter row 1 fires at 0, row 2 at 20 ms, with 6 m/s; four columns.
        for n in 1..=10 {
            let time = flight.end() * f64::from(n) / 11.0;
            for (tire, fired) in [(0, 0.0), (4, 0.02)] {
                let since = time - fired;
                let exact = (6.0 * since - 0.5 * GRAVITY * since * since).max(0.0);
                // The frame before may be one frame's time old.
                let age = 2.0 * flight.end() / frames as f64;
                close(f64::from(flight.at(time)[tire][2]), exact, 6.0 * age + 1e-6, "height");
            }
            assert_eq!(flight.at(time)[8], [0.0; 3], "row 3 lies over no hole");
        }
        assert!(flight.at(flight.end()).iter().all(|u| u[2] < 1e-4), "all lie on the ground at the end");
        assert_eq!(flight.at(0.0)[0][2], 0.0);
    }
}
