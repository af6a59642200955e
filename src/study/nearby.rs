//! Whether shots still pass where every input is a little different from the plan.

use super::batch::{judge_shot, part_of_envelopes};
use super::screen::{is_sure, screen};
use super::{Case, ComputeSettings, NoResult, Progress};
use crate::scene::{Shot, nearby};
use crate::simulation::Model;
use crate::verdict::Verdict;

/// Nearby shots of each shot.
pub const PER_SHOT: u64 = 24;
/// Change of the inputs.
pub const CHANGE: f64 = 0.01;
/// Number of nearby shots judged together before a failure ends the trial: a fixed number, so that the number of threads
/// changes nothing.
const AT_ONCE: usize = 32;

/// Nearby shots that were judged.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Nearby {
    /// Number of nearby shots judged.
    pub judged: usize,
    /// Number of those that do not pass.
    pub failures: usize,
}

/// Judges [`PER_SHOT`] shots near each of `shots`, until some do not pass; `None` where the time ran out.
///
/// Inputs change by up to [`CHANGE`], tire by tire and hole by hole.
pub fn judge_nearby(
    case: &Case,
    shots: &[Shot],
    compute: &ComputeSettings,
    progress: &Progress,
) -> Result<Option<Nearby>, NoResult> {
    let jobs: Vec<(&Shot, u64)> = itertools::iproduct!(shots, 0..PER_SHOT).collect();
    let mut found = Nearby::default();
    for chunk in jobs.chunks(AT_ONCE) {
        let judged = part_of_envelopes(chunk, progress, |&(shot, number)| {
            let (scene, shot) = nearby(case.scene(), shot, CHANGE, number);
            let case = Case { model: Model::new(scene), ..case.clone() };
            let screened =
                screen(&case, &shot, compute, progress, |envelope, runs| is_sure(&case, envelope, runs))?;
            match screened.verdict {
                Verdict::Undecided => judge_shot(&case, &shot, compute, progress),
                _ => Ok(screened),
            }
        })?;
        let Some(judged) = judged.into_iter().collect::<Option<Vec<_>>>() else { return Ok(None) };
        found.judged += judged.len();
        found.failures += judged.iter().filter(|envelope| envelope.verdict != Verdict::Pass).count();
        if found.failures > 0 {
            break;
        }
    }
    Ok(Some(found))
}
