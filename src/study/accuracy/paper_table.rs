//! Table 1 of the source paper, and the same table computed here.

use std::ops::ControlFlow;

use crate::choice::Method;
use crate::plan::Timing;
use crate::simulation::RunSettings;
use crate::study::Case;

/// A row of Table 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaperRow {
    /// Step [s].
    pub step: f64,
    /// Greatest flight height [m].
    pub height: f64,
    /// Greatest force [N].
    pub force: f64,
    /// Force of a diagonal cable at 0.16 s [N].
    pub force_at_160_ms: f64,
}

/// Table 1 as printed; NaN where the table has a dash.
pub const PAPER: [PaperRow; 6] = [
    row(5e-4, 0.705, 17_668.0, 9_265.0),
    row(2.5e-4, 0.707, 17_687.0, 8_284.0),
    row(2e-4, 0.708, 17_704.0, 7_461.0),
    row(1e-4, 0.708, 17_704.0, 7_456.0),
    row(6.25e-5, 0.708, 17_701.0, 7_521.0),
    row(5e-5, f64::NAN, f64::NAN, 7_452.0),
];

const fn row(step: f64, height: f64, force: f64, force_at_160_ms: f64) -> PaperRow {
    PaperRow { step, height, force, force_at_160_ms }
}

/// Table 1 computed by `method`; `None` if the plan is not the shelter of the paper (five tires of 280 kg over one hole), or a run
/// fails.
pub fn paper_table(case: &Case, method: Method) -> Option<Vec<PaperRow>> {
    let scene = case.scene();
    let single =
        matches!(case.plan.delays.as_slice(), [delay] if matches!(delay.timing, Timing::Interval { .. }));
    let centre = case.shots.first()?.firings.first()?.tire;
    let [5, 8] = [scene.tire_count(), scene.cables.len()] else { return None };
    if !single || case.shots[0].firings.len() != 1 || scene.mass[0] != 280.0 || scene.friction != 0.5 {
        return None;
    }
    let diagonal = scene.cables.iter().position(|cable| cable.ends.contains(&centre))?;
    PAPER
        .iter()
        .map(|row| row.step)
        .map(|step| {
            let settings = RunSettings { method, step, duration: Some(1.0) };
            let (mut late, mut before) = (f64::NAN, (0.0, 0.0));
            let outcome = case.model.run(&case.shots[0], &settings, &mut |motion| {
                let now = (motion.time(), motion.force(diagonal));
                if before.0 < 0.16 && now.0 >= 0.16 - 1e-12 {
                    let part = ((0.16 - before.0) / (now.0 - before.0)).clamp(0.0, 1.0);
                    late = before.1 + part * (now.1 - before.1);
                }
                before = now;
                ControlFlow::Continue(())
            });
            outcome.ok().map(|outcome| row(step, outcome.height.value, outcome.force.value, late))
        })
        .collect()
}
