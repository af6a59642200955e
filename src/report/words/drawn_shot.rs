//! Which shot of an option is drawn, in words.

use crate::report::language::{phrase, say};
use crate::study::judge::deciding_shot::DecidingSamples;
use crate::units;
use crate::verdict::Limits;

/// The shot as planned.
pub const AS_PLANNED: &str = "as planned";

/// The shot that decides, named by how many it is the worst of, or the one as planned.
pub fn shot_words(limits: &Limits, decides: bool) -> String {
    match decides {
        true => say!("worst of {}", units::one_in(limits.accepted_risk)),
        false => phrase(AS_PLANNED).to_owned(),
    }
}

/// Which samples decide by height and by force, and how to see their numbers.
pub fn deciding_samples(limits: &Limits, samples: &DecidingSamples) -> String {
    let one_in = units::one_in(limits.accepted_risk);
    let DecidingSamples { height, force, .. } = samples;
    match height == force {
        true => say!(
            "Worst of {one_in}: sample {number}; 1 in {one_in} uses more of a limit. `shelter trace --sample {number}` tells its motion",
            one_in,
            height.number
        ),
        false => say!(
            "Worst of {one_in}: by height sample {}, by force {}; 1 in {one_in} lies above. Its motion: `shelter trace --sample N`",
            one_in,
            height.number,
            force.number
        ),
    }
}
