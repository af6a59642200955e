//! Which shot of an option is drawn, in words.

use crate::report::language::{phrase, say};
use crate::study::judge::deciding_shot::DecidingSamples;
use crate::study::samples::influence::SAMPLES_FOR_SHARES;
use crate::units;
use crate::verdict::Limits;

/// The shot as planned.
pub const AS_PLANNED: &str = "as planned";

/// Accepted risk below which the first samples leave none out.
const TOLD_BY_FIRST_SAMPLES: f64 = 1.0 / SAMPLES_FOR_SHARES as f64;

/// Of a value that decides: `1 in 100 shots above`. Of fewer shots than that nobody could say it.
pub fn one_in_above(limits: &Limits) -> String {
    if limits.accepted_risk < TOLD_BY_FIRST_SAMPLES {
        return phrase("few shots above").to_owned();
    }
    say!("1 in {} shots above", units::one_in(limits.accepted_risk))
}

/// Of the shot that decides, how many are above it; of the other one that it is as planned.
pub fn shot_words(limits: &Limits, decides: bool) -> String {
    if decides { one_in_above(limits) } else { phrase(AS_PLANNED).to_owned() }
}

/// Which samples of an option decide by height and by force, and the command that shows one, but for its number: of another option, or of
/// other draws, the same number is another shot. `share_above` of the shots are above what is drawn.
pub fn deciding_samples(share_above: f64, samples: &DecidingSamples, trace: String) -> String {
    let one_in = units::one_in(share_above);
    let DecidingSamples { height, force, .. } = samples;
    match height == force {
        true => say!(
            "What is drawn is sample {number}: 1 in {one_in} is above. `{trace} {number}` tells its motion",
            height.number,
            one_in,
            trace
        ),
        false => say!(
            "What is drawn is sample {} by height, {} by force: 1 in {one_in} is above. Its motion: `{trace} N`",
            height.number,
            force.number,
            one_in,
            trace
        ),
    }
}
