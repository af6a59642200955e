//! Warnings of results: what a reader must know beside them, one sentence each. Text, page and terminal draw them; where only numbers
//! are printed, they go to standard error.

use crate::report::language::{phrase, say};
use crate::sorting::{sort_by, sorted_by_key};
use crate::study::as_planned::cover::Cover;
use crate::study::judge::recommend::recommended;
use crate::study::judge::{Judgement, OptionResults, verdict_of};
use crate::study::samples::swaps::{Swap, find_swaps};
use crate::study::{Case, ShotSummary};
use crate::units;
use crate::verdict::Quantity;

/// Least probability of a swap of blast rows that deserves a warning.
const LEAST_SWAP_PROBABILITY: f64 = 1e-4;
/// Drift over the widest distance of tied tires from which it is told where no limit judges it.
const FAR_DRIFT_SHARE: f64 = 0.5;

/// Most warnings that name single options; the others are counted.
const MOST_OF_A_KIND: usize = 3;

/// Warnings of one option, without its name: blast rows that may fire in the wrong order, holes that fire under no cover, a far
/// drift that no limit judges.
pub fn of_option(case: &Case, option: usize, judged: &Judgement) -> Vec<String> {
    let drift = far_drift(case, judged);
    let so_far = as_far_as([judged]);
    let drift =
        drift.map(|drift| format!("{so_far} {} m: {}", units::rounded(drift, 2), phrase(NOT_CHECKED)));
    swaps_and_cover(case, option, judged).chain(drift).collect()
}

/// The same of all options but one, each with the name of its option.
pub fn of_options(case: &Case, results: &OptionResults, but: Option<usize>) -> Vec<String> {
    let name = |option: usize| &case.plan.delays[option].name;
    let (mut warnings, mut drifts, mut most) = (Vec::new(), Vec::new(), MOST_OF_A_KIND);
    // All of the option to be recommended are told, and first; then come those that pass.
    let chosen = recommended(case, results);
    let order =
        sorted_by_key(0..results.len(), |&option| (Some(option) != chosen, verdict_of(&results[option])));
    for option in order {
        let Ok(judged) = &results[option] else { continue };
        if Some(option) == but {
            continue;
        }
        let of_option = swaps_and_cover(case, option, judged);
        warnings.extend(of_option.map(|warning| say!("option {}: {warning}", name(option), warning)));
        most = most.max(if Some(option) == chosen { warnings.len() } else { 0 });
        drifts.extend(far_drift(case, judged).map(|drift| (drift, option)));
    }
    let more = warnings.len().saturating_sub(most);
    if more > 0 {
        warnings.truncate(most);
        warnings.push(say!("{more} more such warnings, of {} options in all", more, results.len()));
    }
    sort_by(&mut drifts, |a, b| a.0.total_cmp(&b.0));
    if let (Some(&(least, _)), Some(&(most, farthest))) = (drifts.first(), drifts.last()) {
        let so_far = as_far_as(results.iter().flatten());
        let [least, most] = [least, most].map(|drift| units::rounded(drift, 2));
        let drift = match drifts.len() {
            1 => format!("{most} m ({})", name(farthest)),
            count => say!(
                "{least} to {most} m ({count} options; most with {})",
                least,
                most,
                count,
                name(farthest)
            ),
        };
        warnings.push(format!("{so_far} {drift}: {}", phrase(NOT_CHECKED)));
    }
    warnings
}

/// Warnings of an option that need no other option beside them.
pub fn swaps_and_cover(case: &Case, option: usize, judged: &Judgement) -> impl Iterator<Item = String> {
    let swaps =
        if judged.sampled.is_asked() { find_swaps(case, option, LEAST_SWAP_PROBABILITY) } else { Vec::new() };
    let swaps = swaps.into_iter().map(move |found| swap_warning(case, option, &found));
    swaps.chain(uncovered(&judged.checked.cover)).chain(turning(case, judged))
}

/// That an option keeps the limit of height only as long as its tires do not turn toward their cables.
fn turning(case: &Case, judged: &Judgement) -> Option<String> {
    let turned = judged.deciding.as_ref()?.turned_height?;
    let one_in = units::one_in(judged.sampled.known()?.share_above());
    let (used, limit) = (judged.used_of_limit(Quantity::Height, &case.limits)?, case.limits.height);
    let [turned_m, limit_m] = [turned, limit].map(|height| units::rounded(height, 2));
    let text = say!(
        "if tires turned toward their cables, as those of the model do not, 1 shot in {one_in} would rise over {turned_m} m; the limit is {limit_m} m",
        one_in,
        turned_m,
        limit_m
    );
    (used <= 1.0 && turned > limit).then_some(text)
}

/// What the drift of options is; where one was sampled, nobody may take it for the farthest.
fn as_far_as<'j>(judged: impl IntoIterator<Item = &'j Judgement>) -> String {
    let sampled = judged.into_iter().filter(|judged| sampled_drift(judged).is_some());
    let above = sampled.filter_map(|judged| Some(judged.sampled.known()?.share_above()));
    match above.reduce(f64::max).map(units::one_in) {
        Some(one_in) => say!("1 shot in {one_in} throws a tire farther than", one_in),
        None => say!("the planned shot moves a tire as far as"),
    }
}

/// What passes at a step that somebody fixed are worth.
pub const FIXED_STEP: &str = "computed at a step that somebody fixed: no permission to fire";
/// What a pass leaves open where tires drift far.
const NOT_CHECKED: &str = "not checked, set `drift_m` to limit that";

/// The drift that the accepted share of the possible shots exceeds [m]; `None` for too few of them.
fn sampled_drift(judged: &Judgement) -> Option<f64> {
    judged.sampled.known()?.deciding_value(Quantity::Drift)
}

/// The drift of an option where no limit judges it and it is far [m]: of the shot as planned, or what the
/// accepted share of the possible shots exceeds.
fn far_drift(case: &Case, judged: &Judgement) -> Option<f64> {
    let drift = judged.checked.estimates.drift.value.max(sampled_drift(judged).unwrap_or(0.0));
    let far = FAR_DRIFT_SHARE * case.plan.layout.widest_tie();
    (case.limits.drift.is_none() && drift > far).then_some(drift)
}

/// The warning that two blast rows may fire in the wrong order.
fn swap_warning(case: &Case, option: usize, swap: &Swap) -> String {
    let [first, second] = swap.rows.map(|row| &case.plan.blast_rows[row].name);
    // Where the holes of a row fire one after another, only the first ones are the interval apart.
    let which =
        phrase(if case.plan.delays[option].hole_timing.is_together() { "a given" } else { "the first" });
    say!(
        "{} between rows {first} and {second} is short for the scatter of the detonators; {which} hole of row {second} fires before {which} hole of row {first} with a probability of {}",
        units::exact_milliseconds(swap.interval),
        first,
        second,
        which,
        units::percent(swap.probability, 2)
    )
}

/// The warning that holes fire under a tire in the air or aside; `None` where none does.
fn uncovered(cover: &Cover) -> Option<String> {
    let Cover { holes, uncovered, height, shift, .. } = cover;
    let [height, shift] = [height, shift].map(|value| units::rounded(*value, 2));
    (*uncovered > 0).then(|| {
        say!("{uncovered} of {holes} holes fire under a tire in the air or moved aside, up to {height} m high and {shift} m aside: \
             the model gives it the whole launch", uncovered, holes, height, shift)
    })
}

/// The same for one of the shots of a study, called `name`.
pub fn uncovered_shot(name: &str, shot: &ShotSummary) -> Option<String> {
    Some(format!("{}: {}", phrase(name), uncovered(&shot.cover)?))
}

/// How many of the shots of a study have such holes; `what` they are, many of them: `intervals tried`.
pub fn count_uncovered<'a>(
    what: &str,
    shots: impl ExactSizeIterator<Item = &'a ShotSummary>,
) -> Option<String> {
    let all = shots.len();
    let some = shots.filter(|shot| shot.cover.uncovered > 0).count();
    (some > 0).then(|| {
        say!("of {all} {what} {some} have holes that fire under a tire in the air or moved aside: the model gives it the whole launch", all, phrase(what), some)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::judge::deciding_shot::{DecidingSamples, DecidingShot, DecidingShots};
    use crate::study::standing::tests::{case, passing};

    /// A height over the limit of tires that turn is told of an option that keeps it, and of no other.
    #[test]
    fn a_height_that_holds_only_for_tires_that_do_not_turn_is_told() {
        let case = case();
        let told = |turned_height, limit| {
            let mut case = case.clone();
            case.limits.height = limit;
            let mut judged = passing(&case, 500);
            let samples = DecidingSamples::of(judged.sampled.known().expect("samples"), 1).expect("samples");
            let history = judged.checked.history.clone();
            let shot = DecidingShot { sample: samples.height, shot: case.shots[0].clone(), history };
            judged.deciding =
                Some(DecidingShots { samples, height: shot.clone(), force: shot, turned_height });
            let all: Vec<String> = of_option(&case, 0, &judged)
                .into_iter()
                .filter(|line| line.contains("turned toward"))
                .collect();
            all
        };
        let most = passing(&case, 500).used_of_limit(Quantity::Height, &case.limits).expect("samples");
        let most = most * case.limits.height;
        let said = "1 shot in 100 would rise over 2.36 m; the limit is 2.35 m";
        assert!(told(Some(2.36), 2.35)[0].contains(said), "{:?}", told(Some(2.36), 2.35));
        assert_eq!([told(Some(2.34), 2.35), told(None, 2.35), told(Some(9.0), 0.9 * most)], [[""; 0]; 3]);
    }
}
