//! What a PASS stands on, in words: each assumption, its values, and a sentence of the nearest assumptions.

use crate::report::language::{phrase, say};
use crate::study::assumptions::assumed::{Assumed, Ranged, Side, Spread, Toward};
use crate::study::assumptions::{Assumption, Assumptions, NEAREST};
use crate::study::standing::verdict_word::ThinPass;
use crate::units;

/// Note that the numbers of `shelter assumptions` are no verdicts.
pub const ADVICE: &str = "advice, no verdict: all else is as the plan says, and a value that holds here was not judged as `check` judges; what scatters is told by its standard deviation";

/// Name of an assumption: `tilt of all launches`.
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
            Spread::LaunchCommon => "launch velocities, how well known",
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

/// Value of an assumption: `2.6°`, `+21 %`.
pub fn value(assumed: Assumed, value: f64) -> String {
    let (sign, number, unit) = match assumed {
        Assumed::LaunchVelocity if value == 1.0 => return say!("as planned"),
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

/// A number with its unit, as whoever lays the shelter says it: less than a metre in centimetres.
fn in_sentence(number: f64, unit: &str) -> String {
    match unit {
        "m" if number.abs() < 1.0 => with_unit(1e2 * number, "cm"),
        unit => with_unit(number, unit),
    }
}

/// What happens on site at a value: `all launches tilt by 2.6°`.
fn happens(assumed: Assumed, value: f64) -> String {
    let told = |number: f64| in_sentence(number, assumed.unit());
    let v = told(value);
    match assumed {
        Assumed::LaunchVelocity => say!("tires leave {} faster", with_unit(1e2 * (value - 1.0), "%")),
        Assumed::Place(toward) => {
            say!("the shelter is {v} off toward {}", v, direction(toward))
        }
        Assumed::PushDepth => say!("holes push from {v} deep", v),
        Assumed::Spread(spread) => match spread {
            Spread::LaunchByHole => say!("launches of holes differ by {v}", v),
            Spread::LaunchByRow => say!("launches of rows differ by {v}", v),
            Spread::LaunchCommon => say!("launches are known to {v} only", v),
            Spread::LaunchBetweenShots => say!("launches of shots differ by {v}", v),
            Spread::Tilt => say!("single launches tilt by {v}", v),
            Spread::TiltCommon => say!("all launches tilt by {v}", v),
            Spread::HolePosition if value == 0.0 => say!("holes lie exactly under their tires"),
            Spread::PatternOffset if value == 0.0 => say!("the shelter lies exactly over the pattern"),
            Spread::CableLength if value == 0.0 => say!("cables are tied exactly to their length"),
            Spread::HolePosition => say!("holes are {v} off their tires", v),
            Spread::PatternOffset => say!("the shelter is {v} off its place", v),
            Spread::Duds => say!("{v} of the holes are duds", v),
            Spread::CableLength => say!("cables are {v} off their length", v),
            Spread::TireMass => say!("tire masses differ by {v}", v),
            Spread::BreakingForce => say!("breaking forces differ by {v}", v),
            Spread::DelayTime => say!("firing times scatter by {v}", v),
            Spread::DelayShare => say!("firing times scatter by {v} of the delay", v),
        },
        Assumed::Range(ranged, side) => {
            let (what, of_own) = match ranged {
                Ranged::Friction => ("friction", ""),
                Ranged::Slack => ("slack", ""),
                Ranged::AxialStiffness => ("stiffness of the rope", " of its own"),
                Ranged::MassExponent => ("the mass exponent", ""),
            };
            let [what, of_own] = [what, of_own].map(phrase);
            match (ranged, side) {
                (Ranged::AxialStiffness, Side::Low | Side::High) if value < 0.0 => {
                    say!("the rope is {} softer", told(-value))
                }
                (Ranged::AxialStiffness, Side::Low | Side::High) => say!("the rope is {v} stiffer", v),
                (_, Side::Both) => say!("{what} errs by {v}{of_own} either way", what, v, of_own),
                (_, Side::Low) => say!("{what} falls to {v}", what, v),
                (_, Side::High) => say!("{what} rises to {v}", what, v),
            }
        }
    }
}

/// End of one assumption.
enum Edge {
    /// The last value tried before the first value that does not pass.
    HoldsUntil(f64),
    /// The nearest value that does not pass; only the stated value passes.
    FailsIf(f64),
}

/// End of an assumption; `None` where every value tried passes.
fn edge(found: &Assumption) -> Option<Edge> {
    let fails_from = found.fails_from?;
    let until = found.passes_until.filter(|&until| until != found.stated);
    Some(until.map_or(Edge::FailsIf(fails_from), Edge::HoldsUntil))
}

/// What happens on site at a value, with the stated value: `all launches tilt by 2.6° (assumed 1°)`.
fn beside_stated(found: &Assumption, at: f64) -> String {
    match found.assumed {
        Assumed::LaunchVelocity | Assumed::Place(_) => happens(found.assumed, at),
        Assumed::Range(_, Side::Both) => {
            say!("{} (assumed {})", happens(found.assumed, at), value(found.assumed, found.stated))
        }
        assumed => {
            let stated = in_sentence(found.stated, assumed.unit());
            say!("{} (assumed {})", happens(assumed, at), stated)
        }
    }
}

fn nearest_edges(found: &Assumptions) -> impl Iterator<Item = (&Assumption, Edge)> {
    found.failing().take(NEAREST).filter_map(|near| Some((near, edge(near)?)))
}

fn in_short((found, edge): (&Assumption, Edge)) -> String {
    match edge {
        Edge::HoldsUntil(at) => format!("until {}", beside_stated(found, at)),
        Edge::FailsIf(at) => say!("fails if {}", beside_stated(found, at)),
    }
}

/// The nearest assumptions, each with its end: `until all launches tilt by 2.6° (assumed 1°)`.
pub fn nearest(found: &Assumptions) -> Vec<String> {
    nearest_edges(found).map(in_short).collect()
}

/// The same without the assumption that ends a thin pass: that assumption has its own words.
pub fn nearest_beside(found: &Assumptions, thin: ThinPass) -> Vec<String> {
    let is_beside =
        |near: &Assumption| !matches!(thin, ThinPass::StandsOn(ends) if ends.assumed == near.assumed);
    nearest_edges(found).filter(|(near, _)| is_beside(near)).map(in_short).collect()
}

/// What ends a thin pass: `only until tires leave 2 % faster`. The value is the last that passes, as for every other pass.
pub fn thin(thin: ThinPass) -> String {
    match thin {
        ThinPass::StandsOn(found) => match edge(&found) {
            Some(Edge::HoldsUntil(at)) => say!("only until {}", happens(found.assumed, at)),
            Some(Edge::FailsIf(at)) => say!("fails if {}", happens(found.assumed, at)),
            None => String::new(),
        },
        ThinPass::PlannedAlone(rise) => {
            say!("even the planned shot passes only up to launches {} faster", units::percent(rise, 0))
        }
        ThinPass::OneDud { failing, places } => {
            say!("one dud exceeds a limit at {failing} of {places} holes", failing, places)
        }
    }
}

/// What the pass of an option stands on, by its nearest assumptions:
/// `holds until all launches tilt by 2.6° (assumed 1°), tires leave 20 % faster`.
pub fn holds(found: &Assumptions) -> String {
    if !found.pass_as_stated() {
        return match found.samples {
            0 => say!("does not hold with all as stated"),
            samples => say!(
                "does not hold with all as stated: {} of {samples} other draws fail, {} accepted",
                found.failing,
                samples,
                found.accepted
            ),
        };
    }
    let (mut until, mut fails_if) = (Vec::new(), Vec::new());
    for (near, edge) in nearest_edges(found) {
        match edge {
            Edge::HoldsUntil(at) => until.push(beside_stated(near, at)),
            Edge::FailsIf(at) => fails_if.push(beside_stated(near, at)),
        }
    }
    let is_thin = ThinPass::of_assumptions(found).is_some();
    let holds = match (until.is_empty(), is_thin) {
        (true, _) if fails_if.is_empty() => {
            return say!("holds at every value tried of what it stands on");
        }
        (true, true) => say!("holds, but thinly"),
        (true, false) => say!("holds as stated"),
        (false, true) => say!("holds, but thinly, until {}", until.join(", ")),
        (false, false) => say!("holds until {}", until.join(", ")),
    };
    match fails_if.is_empty() {
        true => holds,
        false => format!("{holds}; {}", say!("fails if {}", fails_if.join(", "))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Verdict;

    #[test]
    fn a_value_that_ends_the_pass_at_once_is_said_to_fail_it() {
        let end = |assumed, stated, passes_until, fails_from| Assumption {
            assumed,
            stated,
            passes_until: Some(passes_until),
            fails_from: Some(fails_from),
            ratio: None,
            is_complete: true,
        };
        let tilt = end(Assumed::Spread(Spread::Tilt), 1.0, 2.0, 3.0);
        let depth = end(Assumed::PushDepth, 0.5, 0.5, 0.6);
        let holds_with = |all| {
            let (planned, accepted) = (Verdict::Pass, 3);
            holds(&Assumptions { option: 0, samples: 300, accepted, planned, failing: 0, all })
        };
        assert_eq!(
            holds_with(vec![depth, tilt]),
            "holds until single launches tilt by 2° (assumed 1°); fails if holes push from 60 cm deep (assumed 50 cm)"
        );
        assert_eq!(
            holds_with(vec![depth]),
            "holds as stated; fails if holes push from 60 cm deep (assumed 50 cm)"
        );
        let launch = |passes_until, fails_from| end(Assumed::LaunchVelocity, 1.0, passes_until, fails_from);
        assert_eq!(holds_with(vec![launch(1.04, 1.05)]), "holds, but thinly, until tires leave 4 % faster");
        assert_eq!(holds_with(vec![launch(1.05, 1.06)]), "holds until tires leave 5 % faster");
        assert_eq!(holds_with(vec![launch(1.0, 1.01)]), "holds, but thinly; fails if tires leave 1 % faster");
    }
}
