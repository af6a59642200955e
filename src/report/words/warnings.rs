//! Warnings of results, one sentence each: what a reader must know beside the results. Text, page and terminal show them. Commands
//! that print only numbers write them to standard error.

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
/// Drift over the greatest distance between tied tires, from which a drift without a limit gets a warning.
const FAR_DRIFT_SHARE: f64 = 0.5;

/// Most warnings that name single options. The others are counted.
const MOST_OF_A_KIND: usize = 3;

/// Warnings of one option, without its name: blast rows that may fire in the wrong order, holes that fire under no cover, tires
/// that rise too high if they turn, and a far drift that no limit judges.
pub fn of_option(case: &Case, option: usize, judged: &Judgement) -> Vec<String> {
    let slide = far_slide(case, judged);
    swaps_and_cover(case, option, judged).chain(turning(case, judged)).chain(slide).collect()
}

/// Warning that tires slide far and no limit judges the slide; `None` otherwise. The signer checks that the ground is clear.
pub fn far_slide(case: &Case, judged: &Judgement) -> Option<String> {
    let (drift, so_far) = (far_drift(case, judged)?, far_drift_lead([judged]));
    Some(format!("{so_far} {} m: {}", units::rounded(drift, 2), phrase(NOT_CHECKED)))
}

/// Warnings of all options except `but`, each with the name of its option.
pub fn of_options(case: &Case, results: &OptionResults, but: Option<usize>) -> Vec<String> {
    let name = |option: usize| &case.plan.delays[option].name;
    let (mut warnings, mut drifts, mut turned, mut most) =
        (Vec::new(), Vec::new(), Vec::new(), MOST_OF_A_KIND);
    // Every warning of the recommended option is shown, before all others. Then come the options that pass.
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
        let so_far = far_drift_lead(results.iter().flatten());
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

/// Warnings of an option that are shown by option: swapped rows, and holes that fire under no cover.
pub fn swaps_and_cover(case: &Case, option: usize, judged: &Judgement) -> impl Iterator<Item = String> {
    let swaps =
        if judged.sampled.is_asked() { find_swaps(case, option, LEAST_SWAP_PROBABILITY) } else { Vec::new() };
    let swaps = swaps.into_iter().map(move |found| swap_warning(case, option, &found));
    swaps.chain(uncovered(&judged.checked.cover))
}

/// Height [m] of tires that turn toward their cables, above the limit, of an option that passes only as long as they do not turn.
/// `None` otherwise.
pub fn turned_over_limit(case: &Case, judged: &Judgement) -> Option<f64> {
    let passes = judged.grounds().before_confirmation() == Verdict::Pass;
    judged.turned_height.filter(|height| passes && *height > case.limits.height)
}

/// Warning that an option passes only as long as its tires do not turn. `which` is the height, with the options that reach it.
fn turning_warning(case: &Case, which: &str) -> String {
    let (one_in, limit) = (units::one_in(case.limits.accepted_risk), units::rounded(case.limits.height, 2));
    say!(
        "if tires turned toward their cables, as those of the model do not, 1 shot in {one_in} would rise over {which}; the limit is {limit} m",
        one_in,
        which,
        limit
    )
}

/// Limit of a length over the length of the deciding shot, from which the limit gets a warning: a metre has 3.28 feet.
const FAR_LIMIT: f64 = 3.0;

/// Warnings that the limit of height or of slide is far above what an option reaches: somebody may have meant another number.
pub fn far_limits(case: &Case, judged: &Judgement) -> Vec<String> {
    let warning = |quantity, name: &str| {
        let limit = case.limits.get(quantity)?;
        let reached = judged.used_of_limit(quantity, &case.limits)? * limit;
        let times = units::rounded(limit / reached, 0);
        (limit > FAR_LIMIT * reached).then(|| {
            say!(
                "the limit of {name}, {} m, is {times} times what this shot reaches: is it in metres?",
                name,
                units::short(limit),
                times
            )
        })
    };
    let height = warning(Quantity::Height, phrase("height"));
    height.into_iter().chain(warning(Quantity::Drift, phrase("slide"))).collect()
}

/// A height [m] in words, with enough decimals to differ from the limit of height. The height is unknown where the runs with
/// turning tires fail.
pub fn turned_words(case: &Case, height: f64) -> String {
    let limit = case.limits.height;
    let decimals = [2, 3, 4].into_iter().find(|&n| units::rounded(height, n) != units::rounded(limit, n));
    match height.is_finite() {
        true => format!("{} m", units::rounded(height, decimals.unwrap_or(2))),
        false => phrase("an unknown height").to_owned(),
    }
}

/// Warning that one option passes only as long as its tires do not turn. It stands among the option's warnings, and the signer
/// confirms it.
pub fn turning(case: &Case, judged: &Judgement) -> Option<String> {
    let height = turned_over_limit(case, judged)?;
    Some(turning_warning(case, &turned_words(case, height)))
}

/// First words of the warning of a far drift. Where an option was sampled, they say that some shots slide farther.
fn far_drift_lead<'j>(judged: impl IntoIterator<Item = &'j Judgement>) -> String {
    let sampled = judged.into_iter().filter(|judged| sampled_drift(judged).is_some());
    let above = sampled.filter_map(|judged| Some(judged.sampled.known()?.share_above()));
    match above.reduce(f64::max).map(units::one_in) {
        Some(one_in) => say!("1 shot in {one_in} throws a tire farther than", one_in),
        None => say!("the planned shot moves a tire as far as"),
    }
}

/// Warning for passes at a step that somebody fixed.
pub const FIXED_STEP: &str = "computed at a step that somebody fixed: no permission to fire";
/// Last words of the warning of a far drift: what a pass leaves open.
const NOT_CHECKED: &str = "not checked, is the ground clear? set `drift_m` to limit that";

/// Drift [m] that only the accepted share of the sampled shots exceeds; `None` for too few samples.
fn sampled_drift(judged: &Judgement) -> Option<f64> {
    judged.sampled.known()?.deciding_value(Quantity::Drift)
}

/// Drift [m] of an option where it is far and no limit judges it: the drift of the planned shot, or the drift that only the
/// accepted share of the sampled shots exceeds, whichever is greater.
fn far_drift(case: &Case, judged: &Judgement) -> Option<f64> {
    let drift = judged.checked.estimates.drift.value.max(sampled_drift(judged).unwrap_or(0.0));
    let far = FAR_DRIFT_SHARE * case.plan.layout.widest_tie();
    (case.limits.drift.is_none() && drift > far).then_some(drift)
}

/// Warning that two blast rows may fire in the wrong order.
fn swap_warning(case: &Case, option: usize, swap: &Swap) -> String {
    let [first, second] = swap.rows.map(|row| &case.plan.blast_rows[row].name);
    // Where the holes of a row fire one after another, only the first holes of both rows are the interval apart.
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

/// Warning that holes fire under a tire that is in the air or moved aside; `None` where none does.
fn uncovered(cover: &Cover) -> Option<String> {
    let Cover { holes, uncovered, height, shift, .. } = cover;
    let [height, shift] = [height, shift].map(|value| units::rounded(*value, 2));
    (*uncovered > 0).then(|| {
        say!("{uncovered} of {holes} holes fire under a tire in the air or moved aside, up to {height} m high and {shift} m aside: \
             the model gives it the whole launch", uncovered, holes, height, shift)
    })
}

/// The same warning for a shot of a study, called `name`.
pub fn uncovered_shot(name: &str, shot: &ShotSummary) -> Option<String> {
    Some(format!("{}: {}", phrase(name), uncovered(&shot.cover)?))
}

/// Warning with the number of shots of a study that have such holes; `None` where none has. `what` names the shots in the plural:
/// `intervals tried`.
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
    use crate::study::judge::grounds::Evidence;
    use crate::study::samples::failure_bounds::ErrorShare;
    use crate::study::samples::random_shot::Input;
    use crate::study::samples::sample::{Sample, SampleRun};
    use crate::study::samples::sampled_shot::SampledShot;
    use crate::study::standing::tests::{case, passing};

    /// A passing option gets a warning where turning tires would exceed the limit of height, another option does not. Several such
    /// options share one line, apart from the other kinds of warnings.
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

    /// Holes that fire under a raised tire are told of one option, of one shot of a study, and counted over the shots of a study. Of options
    /// that do not pass, as many are told as fit, and how many more there are.
    #[test]
    fn holes_under_a_raised_tire_are_told() {
        let cover = |uncovered| Cover { holes: 10, uncovered, height: 0.5, shift: 0.25, ..Cover::NONE };
        let words = "2 of 10 holes fire under a tire in the air or moved aside, up to 0.50 m high and 0.25 m aside: the model gives it the \
                     whole launch";
        assert_eq!((uncovered(&cover(0)), uncovered(&cover(2)).as_deref()), (None, Some(words)));
        let shot = |uncovered| ShotSummary { cover: cover(uncovered), ..ShotSummary::FAILED_RUN };
        assert_eq!(uncovered_shot("the worst", &shot(2)), Some(format!("the worst: {words}")));
        assert_eq!(uncovered_shot("the worst", &shot(0)), None);
        let counted = |shots: &[ShotSummary]| count_uncovered("intervals tried", shots.iter());
        assert_eq!(counted(&[shot(0), shot(0)]), None);
        let of_three = counted(&[shot(0), shot(1), shot(3)]).expect("a warning");
        assert!(
            of_three.starts_with("of 3 intervals tried 2 have holes that fire under a tire"),
            "{of_three}"
        );
        let case = case();
        let mut judged = passing(&case, 500);
        judged.checked.estimates.drift.value = 0.0;
        assert_eq!(of_option(&case, 0, &judged), [""; 0]);
        judged.checked.cover = cover(2);
        assert_eq!(of_option(&case, 0, &judged), [words]);
        judged.checked.verdict = Verdict::Fail;
        let all: OptionResults = (0..5).map(|_| Ok(judged.clone())).collect();
        let told = of_options(&case.with_options(&[0, 1, 2, 3, 4]), &all, None);
        assert_eq!(told[MOST_OF_A_KIND..], ["2 more such warnings, of 5 options in all"], "{told:?}");
        assert!(told[0].starts_with("option all at once: 2 of 10 holes"), "{told:?}");
    }

    /// Slides are told from a share of the distance between tied tires on: by the planned shot, or by the sampled shots where these slide
    /// farther. A plan that limits the slide judges it instead.
    #[test]
    fn a_far_slide_is_told() {
        let mut case = case();
        let far = FAR_DRIFT_SHARE * case.plan.layout.widest_tie();
        let told = |case: &Case, planned: f64, shots: f64| {
            let mut sampled = SampledShot::new(case, None, ErrorShare::Whole, false);
            let (verdict, breaks) = (Verdict::Pass, Verdict::Pass);
            let (uncovering, height, tire, force, cable) = (0.0, 1.0, 0, 1.0, 0);
            let run = SampleRun { verdict, uncovering, breaks, height, tire, force, cable, drift: shots };
            let samples =
                (0..500).map(|number| Sample { number, run, finer: None, inputs: [1.0; Input::ALL.len()] });
            samples.for_each(|sample| sampled.push(sample));
            let mut judged = Judgement { sampled: Evidence::of(sampled), ..passing(case, 1) };
            judged.checked.estimates.drift.value = planned;
            far_slide(case, &judged)
        };
        assert_eq!(told(&case, far, far), None);
        let words = told(&case, far + 0.01, 0.0).expect("a warning");
        assert!(
            words.starts_with(&format!(
                "1 shot in 100 throws a tire farther than {:.2} m: not checked",
                far + 0.01
            )),
            "{words}"
        );
        assert!(told(&case, 0.0, far + 0.01).is_some());
        let mut alone = Judgement::of_planned_alone(passing(&case, 1).checked);
        alone.checked.estimates.drift.value = far + 0.01;
        assert!(
            far_slide(&case, &alone)
                .is_some_and(|words| words.starts_with("the planned shot moves a tire as far as "))
        );
        case.limits.drift = Some(9.0);
        assert_eq!(told(&case, far + 0.01, far + 0.01), None);
    }
}
