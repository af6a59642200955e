//! Which shot of an option is drawn, in words.

use crate::report::language::{phrase, say};
use crate::study::judge::deciding_shot::DecidingShot;
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

/// Which sample decides, and how to see its numbers.
pub fn deciding_sample(limits: &Limits, deciding: &DecidingShot) -> String {
    let (one_in, number) = (units::one_in(limits.accepted_risk), deciding.sample.number);
    say!(
        "Worst of {one_in}: sample {number}; 1 in {one_in} uses more of a limit. `shelter trace --sample {number}` tells its motion",
        one_in,
        number
    )
}
