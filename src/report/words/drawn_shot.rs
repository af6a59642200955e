//! Which shot of an option is drawn, in words.

use crate::report::language::{phrase, say};
use crate::study::judge::deciding_shot::DecidingSamples;
use crate::study::samples::influence::SAMPLES_FOR_SHARES;
use crate::units;
use crate::verdict::Limits;

/// Words for the planned shot.
pub const AS_PLANNED: &str = "as planned";

/// Accepted risk below which none of the first samples may lie above the deciding sample.
const TOLD_BY_FIRST_SAMPLES: f64 = 1.0 / SAMPLES_FOR_SHARES as f64;

/// How many shots lie above a deciding value: `1 in 100 shots above`. At a smaller accepted risk the first samples cannot say how
/// many.
pub fn one_in_above(limits: &Limits) -> String {
    if limits.accepted_risk < TOLD_BY_FIRST_SAMPLES {
        return phrase("few shots above").to_owned();
    }
    say!("1 in {} shots above", units::one_in(limits.accepted_risk))
}

/// Words for a drawn shot: how many shots lie above the deciding shot, or that the shot is as planned.
pub fn shot_words(limits: &Limits, decides: bool) -> String {
    if decides { one_in_above(limits) } else { phrase(AS_PLANNED).to_owned() }
}

/// Which samples of an option decide by height and by force, and the command that shows one. `trace` is that command without the
/// number of the sample: under another option or seed, the same number is another shot. `share_above` of the shots lie above the
/// drawn shot.
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
