//! What a PASS stands on, in words: each assumption, its values, and the nearest ones as a sentence.

use crate::study::assumptions::assumed::{Assumed, Ranged, Side, Spread, Toward};
use crate::study::assumptions::{Assumption, Assumptions, NEAREST};
use crate::units;

/// That the numbers of `shelter assumptions` are no verdicts.
pub const ADVICE: &str = "advice, no verdict: all else is as the plan says, and a value that holds here was not judged as `check` judges; what scatters is told by its standard deviation";

/// What is assumed: `tilt of all launches`.
pub fn name(assumed: Assumed) -> String {
    let name = match assumed {
        Assumed::LaunchVelocity => "launch velocity of all tires",
        Assumed::Place(toward) => {
            return format!("shelter laid off its place toward {}", direction(toward));
        }
        Assumed::PushDepth => "depth from which the holes push",
        Assumed::Spread(spread) => match spread {
            Spread::LaunchByHole => "launch velocities, hole by hole",
            Spread::LaunchByRow => "launch velocities, row by row",
            Spread::LaunchCommon => "launch velocities, estimate of all",
            Spread::LaunchBetweenShots => "launch velocities, shot by shot",
            Spread::Tilt => "tilt of launches, hole by hole",
            Spread::TiltCommon => "tilt of all launches",
            Spread::HolePosition => "hole beside its tire",
            Spread::PatternOffset => "shelter beside the pattern",
            Spread::Duds => "duds",
            Spread::CableLength => "cable length as tied",
            Spread::TireMass => "tire masses",
            Spread::BreakingForce => "breaking forces of cables",
            Spread::DelayTime => "firing times",
            Spread::DelayShare => "firing times, share of the delay",
        },
        Assumed::Range(ranged, side) => {
            let ranged = match ranged {
                Ranged::Friction => "friction",
                Ranged::Slack => "slack",
                Ranged::AxialStiffness => "stiffness of the rope",
                Ranged::MassExponent => "exponent of the mass law",
            };
            let side = match side {
                Side::Both => "either way",
                Side::Low => "lowest",
                Side::High => "highest",
            };
            return format!("{ranged}, {side}");
        }
    };
    name.to_owned()
}

fn direction(toward: Toward) -> &'static str {
    match toward {
        Toward::PlusX => "+x",
        Toward::MinusX => "-x",
        Toward::PlusY => "+y",
        Toward::MinusY => "-y",
    }
}

/// A value: `2.6°`, `+21 %`.
pub fn value(assumed: Assumed, value: f64) -> String {
    let (sign, number, unit) = match assumed {
        Assumed::LaunchVelocity if value == 1.0 => return "as planned".to_owned(),
        Assumed::LaunchVelocity => ("+", 1e2 * (value - 1.0), "%"),
        Assumed::Range(_, Side::Both) => ("± ", value, assumed.unit()),
        _ => ("", value, assumed.unit()),
    };
    format!("{sign}{}", with_unit(number, unit))
}

fn with_unit(number: f64, unit: &str) -> String {
    match unit {
        "" | "°" => format!("{}{unit}", units::short(number)),
        unit => format!("{} {unit}", units::short(number)),
    }
}

/// What happens on site at a value: `all launches tilt by 2.6°`.
fn happens(assumed: Assumed, value: f64) -> String {
    let told = |number: f64| with_unit(number, assumed.unit());
    let v = told(value);
    match assumed {
        Assumed::LaunchVelocity => format!("tires leave {} faster", with_unit(1e2 * (value - 1.0), "%")),
        Assumed::Place(toward) => {
            format!("the shelter lies {v} off its place toward {}", direction(toward))
        }
        Assumed::PushDepth => format!("holes push from {v} below their mouths"),
        Assumed::Spread(spread) => match spread {
            Spread::LaunchByHole => format!("launch velocities differ by {v} from hole to hole"),
            Spread::LaunchByRow => format!("launch velocities differ by {v} from row to row"),
            Spread::LaunchCommon => format!("the estimate of all launches errs by {v}"),
            Spread::LaunchBetweenShots => format!("launch velocities differ by {v} from shot to shot"),
            Spread::Tilt => format!("single launches tilt by {v}"),
            Spread::TiltCommon => format!("all launches tilt by {v}"),
            Spread::HolePosition => format!("holes lie {v} beside their tires"),
            Spread::PatternOffset => format!("the shelter lies {v} beside the pattern"),
            Spread::Duds => format!("{v} of the holes are duds"),
            Spread::CableLength => format!("cables are tied {v} off their length"),
            Spread::TireMass => format!("tire masses differ by {v}"),
            Spread::BreakingForce => format!("breaking forces of cables differ by {v}"),
            Spread::DelayTime => format!("firing times scatter by {v}"),
            Spread::DelayShare => format!("firing times scatter by {v} of the delay"),
        },
        Assumed::Range(ranged, side) => {
            let (what, of_own) = match ranged {
                Ranged::Friction => ("friction", ""),
                Ranged::Slack => ("slack", ""),
                Ranged::AxialStiffness => ("stiffness of the rope", " of its own"),
                Ranged::MassExponent => ("the exponent of the mass law", ""),
            };
            match (ranged, side) {
                (Ranged::AxialStiffness, Side::Low | Side::High) => {
                    let toward = if value < 0.0 { "below" } else { "above" };
                    format!("the rope's stiffness is {} {toward} its own", told(value.abs()))
                }
                (_, Side::Both) => format!("{what} errs by {v}{of_own} either way"),
                (_, Side::Low) => format!("{what} falls to {v}"),
                (_, Side::High) => format!("{what} rises to {v}"),
            }
        }
    }
}

/// One assumption in a sentence: `all launches tilt by 2.6° (assumed 1°)`; `None` where nothing that was tried fails.
fn holds_until(found: &Assumption) -> Option<String> {
    let Assumption { assumed, stated, passes_until, fails_from, .. } = *found;
    let fails_from = fails_from?;
    let until = passes_until.filter(|&until| until != stated);
    let is_deviation = matches!(assumed, Assumed::LaunchVelocity | Assumed::Place(_));
    Some(match until {
        Some(until) if is_deviation => happens(assumed, until),
        Some(until) => format!("{} (assumed {})", happens(assumed, until), value(assumed, stated)),
        None if is_deviation => format!("just below where {}", happens(assumed, fails_from)),
        None => format!("{}, as assumed", happens(assumed, stated)),
    })
}

/// The nearest assumptions, a sentence each: `all launches tilt by 2.6° (assumed 1°)`.
pub fn nearest(found: &Assumptions) -> Vec<String> {
    found.failing().take(NEAREST).filter_map(holds_until).collect()
}

/// What the pass of an option stands on, its nearest assumptions: `holds until all launches tilt by 2.6° (assumed 1°), tires leave 20 %
/// faster`.
pub fn holds(found: &Assumptions) -> String {
    if !found.pass_as_stated() {
        return match found.samples {
            0 => "does not hold with all as stated".to_owned(),
            samples => format!(
                "does not hold with all as stated: {} of {samples} other draws fail, {} accepted",
                found.failing, found.accepted
            ),
        };
    }
    let nearest = nearest(found);
    match nearest.is_empty() {
        true => "holds at every value tried of what it stands on".to_owned(),
        false => format!("holds until {}", nearest.join(", ")),
    }
}
