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
use crate::verdict::{Quantity, Verdict};

/// Least probability of a swap of blast rows that deserves a warning.
const LEAST_SWAP_PROBABILITY: f64 = 1e-4;
/// Drift over the widest distance of tied tires from which it is told where no limit judges it.
const FAR_DRIFT_SHARE: f64 = 0.5;

/// Most warnings that name single options; the others are counted.
const MOST_OF_A_KIND: usize = 3;

/// Warnings of one option, without its name: blast rows that may fire in the wrong order, holes that fire under no cover, a far
/// drift that no limit judges.
pub fn of_option(case: &Case, option: usize, judged: &Judgement) -> Vec<String> {
    let slide = far_slide(case, judged);
    swaps_and_cover(case, option, judged).chain(turning(case, judged)).chain(slide).collect()
}

/// How far tires slide where that is far and no limit judges it: who signs looks whether the ground is clear.
pub fn far_slide(case: &Case, judged: &Judgement) -> Option<String> {
    let (drift, so_far) = (far_drift(case, judged)?, as_far_as([judged]));
    Some(format!("{so_far} {} m: {}", units::rounded(drift, 2), phrase(NOT_CHECKED)))
}

/// The same of all options but one, each with the name of its option.
pub fn of_options(case: &Case, results: &OptionResults, but: Option<usize>) -> Vec<String> {
    let name = |option: usize| &case.plan.delays[option].name;
    let (mut warnings, mut drifts, mut turned, mut most) =
        (Vec::new(), Vec::new(), Vec::new(), MOST_OF_A_KIND);
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
        turned.extend(turned_over_limit(case, judged).map(|height| (height, option)));
    }
    let more = warnings.len().saturating_sub(most);
    if more > 0 {
        warnings.truncate(most);
        warnings.push(say!("{more} more such warnings, of {} options in all", more, results.len()));
    }
    sort_by(&mut turned, |a, b| a.0.total_cmp(&b.0));
    if let (Some(&(least, _)), Some(&(most, highest))) = (turned.first(), turned.last()) {
        let [least, most] = [least, most].map(|height| turned_words(case, height));
        let which = match turned.len() {
            1 => format!("{most} ({})", name(highest)),
            count => {
                say!("{least} to {most} ({count} options; most with {})", least, most, count, name(highest))
            }
        };
        warnings.push(turning_warning(case, &which));
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
    swaps.chain(uncovered(&judged.checked.cover))
}

/// The height of tires that turn toward their cables [m], where an option passes only as long as they do not.
pub fn turned_over_limit(case: &Case, judged: &Judgement) -> Option<f64> {
    let passes = judged.grounds().before_confirmation() == Verdict::Pass;
    judged.turned_height.filter(|height| passes && *height > case.limits.height)
}

/// That an option passes only as long as its tires do not turn; `which` is the height, and of what options it is.
fn turning_warning(case: &Case, which: &str) -> String {
    let (one_in, limit) = (units::one_in(case.limits.accepted_risk), units::rounded(case.limits.height, 2));
    say!(
        "if tires turned toward their cables, as those of the model do not, 1 shot in {one_in} would rise over {which}; the limit is {limit} m",
        one_in,
        which,
        limit
    )
}

/// So many times what the deciding shot reaches a limit of height is that is told: feet for metres, or a slip of ten.
const FAR_LIMIT: f64 = 5.0;

/// That the limit of height is far above what an option reaches: it may be another number than was meant.
pub fn far_limit(case: &Case, judged: &Judgement) -> Option<String> {
    let limit = case.limits.height;
    let reached = judged.used_of_limit(Quantity::Height, &case.limits)? * limit;
    let times = units::rounded(limit / reached, 0);
    (limit > FAR_LIMIT * reached).then(|| {
        say!(
            "the limit of height, {} m, is {times} times what this shot reaches: is it in metres?",
            units::short(limit),
            times
        )
    })
}

/// How high in words, so exactly that it differs from the limit of height; where the runs of tires that turn fail nobody knows.
pub fn turned_words(case: &Case, height: f64) -> String {
    let limit = case.limits.height;
    let decimals = [2, 3, 4].into_iter().find(|&n| units::rounded(height, n) != units::rounded(limit, n));
    match height.is_finite() {
        true => format!("{} m", units::rounded(height, decimals.unwrap_or(2))),
        false => phrase("an unknown height").to_owned(),
    }
}

/// The same of one option: told with its warnings, and confirmed by who signs for it.
pub fn turning(case: &Case, judged: &Judgement) -> Option<String> {
    let height = turned_over_limit(case, judged)?;
    Some(turning_warning(case, &turned_words(case, height)))
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
const NOT_CHECKED: &str = "not checked, is the ground clear? set `drift_m` to limit that";

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
    use crate::study::standing::tests::{case, passing};

    /// A height over the limit of tires that turn is told of an option that passes, and of no other; of several in one line, apart from the
    /// other kinds of warnings.
    #[test]
    fn a_height_that_holds_only_for_tires_that_do_not_turn_is_told() {
        let case = case();
        let judged = |turned_height, samples| Judgement { turned_height, ..passing(&case, samples) };
        let limit = case.limits.height;
        let told = |height| turning(&case, &judged(height, 500));
        assert!(
            told(Some(limit + 0.01))
                .expect("a warning")
                .contains("1 shot in 100 would rise over 2.36 m; the limit is 2.35 m")
        );
        assert!(told(Some(f64::INFINITY)).expect("a warning").contains("over an unknown height"));
        assert_eq!([told(Some(limit)), told(None)], [None, None]);
        assert_eq!(turning(&case, &judged(Some(9.0), 100)), None, "it is open");
        let all: OptionResults = [None, Some(2.4), Some(2.5)].map(|height| Ok(judged(height, 500))).into();
        let told = of_options(&case.with_options(&[0, 1, 2]), &all, None);
        let turned: Vec<&String> = told.iter().filter(|line| line.contains("turned toward")).collect();
        assert!(
            turned.len() == 1 && turned[0].contains("over 2.40 m to 2.50 m (2 options; most with 20 ms)"),
            "{told:?}"
        );
    }
}
