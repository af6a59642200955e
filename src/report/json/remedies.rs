//! What would make an option pass, in `shelter.check/2`.

use serde::Serialize;

use super::Failures;
use crate::plan::edit::change::Change;
use crate::plan::keys::{Key, blast_row, cable, delay, plan, shelter};
use crate::report::remedies::FromTo;
use crate::study::Case;
use crate::study::remedies::{Remedies, Remedy, TriedKind};

/// A change with which the option passes.
#[derive(Serialize)]
pub struct PassingChange {
    kind: &'static str,
    from: String,
    to: String,
    key: String,
    value: Value,
    verdict: &'static str,
    failure_probability: Option<Failures>,
    flight_height_m: f64,
    cable_force_n: f64,
}

/// A kind of change of which none tried passes.
#[derive(Serialize)]
pub struct RefusedKind {
    kind: &'static str,
    tried: usize,
    undecided: usize,
    complete: bool,
}

/// What stands at the key; of launches the factor on every one.
#[derive(Serialize)]
#[serde(untagged)]
enum Value {
    Name(&'static str),
    Count(usize),
    Number(f64),
}

impl PassingChange {
    /// The changes with which an option passes.
    pub fn all(case: &Case, remedies: &Remedies) -> Vec<Self> {
        remedies.passing().map(|passing| Self::new(case, passing)).collect()
    }

    fn new(case: &Case, passing: &Remedy) -> Self {
        let Remedy { change, judgement } = passing;
        let FromTo { from, to } = FromTo::new(case, change);
        let (section, key, value): (&Key, &Key, Value) = match *change {
            Change::Rope(rope) => (&plan::CABLE, &cable::ROPE, Value::Name(&rope.name)),
            Change::Termination(known) => (&plan::CABLE, &cable::TERMINATION, Value::Name(&known.name)),
            Change::BorderRows(rows) => (&plan::SHELTER, &shelter::BORDER_ROWS, Value::Count(rows)),
            Change::Slack(percent) => (&plan::CABLE, &cable::SLACK_PERCENT, Value::Number(percent)),
            Change::Launch(factor) => (&plan::BLAST_ROW, &blast_row::LAUNCH_M_S, Value::Number(factor)),
            Change::Interval { interval, .. } => {
                (&plan::DELAY, &delay::INTERVAL_MS, Value::Number(interval.ms()))
            }
        };
        Self {
            kind: change.kind().name(),
            from,
            to,
            key: format!("{}.{}", section.name, key.name),
            value,
            verdict: judgement.verdict().for_scripts(),
            failure_probability: Failures::of(&judgement.sampled),
            flight_height_m: judgement.checked.height.value,
            cable_force_n: judgement.checked.force.value,
        }
    }
}

impl RefusedKind {
    /// The kinds of which no change tried passes.
    pub fn all(remedies: &Remedies) -> Vec<Self> {
        let refused = remedies.kinds.iter().filter(|tried| tried.passing.is_none());
        let object = |tried: &TriedKind| Self {
            kind: tried.kind.name(),
            tried: tried.tried.len(),
            undecided: tried.undecided,
            complete: !tried.out_of_time,
        };
        refused.map(object).collect()
    }
}
