//! What to film next, in the words of a site: what to watch, where to stand, how exactly to read the value, and what follows.

use crate::choice::ObservedQuantity;
use crate::plan::observations::unit;
use crate::report::observed::place;
use crate::scene::TireId;
use crate::study::Case;
use crate::study::fit::Observable;
use crate::study::fit::observation_bands::NextObservation;
use crate::study::fit::what_next::WhatNext;
use crate::study::launch::LEAST_PERCENT_OF_TEST_TIRE;
use crate::units;
use crate::verdict::Verdict;

/// What to observe next and how, or why nothing. For an OPEN option the sentences also say that they are no permission to fire.
pub fn what_to_film(case: &Case, what: &WhatNext) -> Vec<String> {
    let name = |option: usize| case.plan.delays[option].name.as_str();
    match what {
        WhatNext::Observe { next, verdict } => {
            let option = name(next.observable.option);
            let is_open = *verdict != Verdict::Pass;
            let open =
                || format!("{option} is OPEN: this is what would tell most of it, and no leave to fire it");
            observation(case, next).into_iter().chain(is_open.then(open)).collect()
        }
        WhatNext::NoneMayBeFired(options) => vec![match options[..] {
            [option] => {
                format!("observe next: no shot of {}, which fails and may not be fired", name(option))
            }
            _ => format!(
                "observe next: no shot of these {} options, none of which may be fired",
                options.len()
            ),
        }],
        WhatNext::NothingNarrows => {
            vec!["no single observation of a shot narrows the verdict by a hundredth".to_owned()]
        }
    }
}

/// The observation that narrows the verdict most, and how to take it.
fn observation(case: &Case, next: &NextObservation) -> Vec<String> {
    let NextObservation { observable: Observable { option, watched }, sd, share, launch_percent } = *next;
    let left = launch_percent
        .map(|percent| format!(", and leaves the launch known to {} %", units::rounded(percent, 0)))
        .unwrap_or_default();
    let first = format!(
        "observe next: {}, to within {} {}; that takes {} from the variance of the greatest share of a limit{left}",
        place(case, option, &watched),
        units::short(sd),
        unit(watched.quantity),
        units::percent(share, 0)
    );
    let is_force = watched.quantity == ObservedQuantity::Force;
    let which = if is_force { String::new() } else { which_tire(&case.scene().tire_ids[watched.index]) };
    vec![first, format!("how: {which}{}", how(watched.quantity))]
}

/// How to film a loose test tire of `mass` [kg]; `None` where no plan states the mass.
pub fn loose_tire(mass: Option<f64>) -> String {
    let mass =
        mass.map_or_else(|| "of the cover's mass".to_owned(), |mass| format!("of {} kg", units::short(mass)));
    format!(
        "a loose tire {mass} over one hole of an ordinary shot, tied to nothing: film it from the side at 60 frames a second or more and \
         count the frames in the air (one frame is 0.08 m/s), or read its height against a pole; that leaves the launch known to \
         {LEAST_PERCENT_OF_TEST_TIRE} %, since it is one hole of one shot"
    )
}

/// Place of a tire, as somebody counts on site.
fn which_tire(tire: &TireId) -> String {
    match tire.numbers()[..] {
        [row, column] if row.fract() == 0.0 => {
            format!("tire {tire} is number {column} of shelter row {row}; ")
        }
        _ => format!("tire {tire}; "),
    }
}

/// Where to stand, and what to use, for a quantity.
fn how(quantity: ObservedQuantity) -> String {
    let film = |frames: &str| {
        format!(
            "film from the side, outside the danger area, the camera on a tripod at the height of the tires; put a pole of known length \
             beside the tire; {frames}"
        )
    };
    match quantity {
        ObservedQuantity::FlightHeight | ObservedQuantity::Height => {
            film("30 frames a second suffice, since a tire hardly moves near its top; read the height within 5 cm")
        }
        ObservedQuantity::Lift | ObservedQuantity::Landing => {
            film("60 frames a second or more, counted from the first hole: read the time within 20 ms")
        }
        ObservedQuantity::Drift => "paint a mark on the ground beside the tire before the shot, and tape the distance to it afterwards".to_owned(),
        ObservedQuantity::Force => "tie a load cell into this cable, with 1,000 readings a second or more; the greatest counts".to_owned(),
    }
}
