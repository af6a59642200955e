//! Warnings: what a reader must know beside the results, one sentence each. Text, page and terminal draw them; where only numbers
//! are printed, they go to standard error.

use itertools::Itertools;

use super::false_names;
use crate::choice::HoleOrder;
use crate::plan::edit::fields::says_assumed;
use crate::plan::keys::Key;
use crate::plan::observations::{Observations, fitted_values};
use crate::plan::usual::Unusual;
use crate::plan::{BlastRow, HoleTiming};
use crate::report::language::{phrase, say};
use crate::report::observed;
use crate::sorting::{sort_by, sorted_by_key};
use crate::study::as_planned::cover::Cover;
use crate::study::hole_places::{HoleBesideTire, holes_beside_tires};
use crate::study::judge::recommend::recommended;
use crate::study::judge::{Judgement, OptionResults, verdict_of};
use crate::study::launch::{Blast, LaunchEstimates, fastest_launch};
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

/// Warnings of a plan, whatever is found: values that are not usual, and ranges of `[uncertainty]` that leave out what the plan
/// itself says.
pub fn of_plan(case: &Case) -> Vec<String> {
    let unusual = case.plan.unusual();
    let unusual = unusual.iter().map(|Unusual { section, key, value, usual: [low, high], is_apart }| {
        if *is_apart {
            return say!(
                "rows fire {value} ms apart: is one of the times of `{}` in seconds?",
                value,
                key.name
            );
        }
        let (name, title, unit) = (key.name, section.title, key.kind.unit());
        let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
        say!(
            "`{name} = {value}` of {title} is unusual, a slip of the pen? Usual are {low} to {high}{unit}",
            name,
            value,
            title,
            low,
            high,
            unit
        )
    });
    let warning = |(key, [low, high], own): (&Key, [f64; 2], f64)| {
        let name = key.name;
        say!(
            "`{name} = [{low}, {high}]` of [uncertainty] leaves out {own}, the plan's own: no sample is like the nominal shot",
            name,
            low,
            high,
            own
        )
    };
    let ranges = case.plan.ranges_beside_the_plan().into_iter().map(warning);
    retitled_example(case)
        .into_iter()
        .chain(launch_estimated(case))
        .chain(launch_too_sure(case))
        .chain(fitted_to_few(case))
        .chain(launch_below_estimate(case))
        .chain(launches_lighter_tire(case))
        .chain(inputs_left_out(case))
        .chain(whole_rope_held(case))
        .chain(no_in_hole_scatter(case))
        .chain(false_names::warnings(&case.plan))
        .chain(listed_otherwise(case))
        .chain(unusual)
        .chain(ranges)
        .chain(beside_tires(case))
        .collect()
}

/// That comments of the plan still call values assumed.
pub fn marked_as_assumed(case: &Case) -> Option<String> {
    let count = marked_values(case).count();
    let text = || {
        say!(
            "values marked `assumed` in the plan: {count}; find yours, and take the mark out of the line",
            count
        )
    };
    (count > 0).then(text)
}

/// Number of values that are assumed: the plan says so, or leaves them out.
pub fn count_assumed(case: &Case) -> usize {
    marked_values(case).count() + case.plan.left_out.len()
}

/// Values in the text of the plan whose comment says that they are assumed, as the plan writes them: `slack_percent = [1.5, 2.5]`.
fn marked_values(case: &Case) -> impl Iterator<Item = &str> {
    let commented = case.source.text.lines().filter_map(split_at_comment);
    let marked = commented.filter(|(value, comment)| !value.trim().is_empty() && says_assumed(comment));
    marked.map(|(value, _)| value.trim())
}

/// What is to be confirmed before the shot, each line once: values that are assumed or unusual, and what `files` of observations say besides.
pub fn to_be_confirmed(case: &Case, files: &[Observations]) -> Vec<String> {
    let unusual = case.plan.unusual();
    // Only that value itself is listed as unusual: another one of the same key is confirmed by itself.
    let is_unusual =
        |value: &&str| unusual.iter().any(|one| *value == format!("{} = {}", one.key.name, one.value));
    let marked = marked_values(case).filter(|value| !is_unusual(value)).map(str::to_owned);
    let left_out =
        case.plan.left_out.iter().map(|key| say!("{key}: left out, a small value of the program", key));
    let unusual =
        unusual.iter().map(|Unusual { key, value, usual: [low, high], is_apart, .. }| match is_apart {
            true => say!("{}: rows {value} ms apart", key.name, value),
            false => say!("{} = {value}: usual are {low} to {high}", key.name, value, low, high),
        });
    marked.chain(left_out).chain(unusual).chain(observed::remarks(files)).unique().collect()
}

/// A line of a plan before and behind the sign of its comment, which is none inside a text.
fn split_at_comment(line: &str) -> Option<(&str, &str)> {
    let mut quote = None;
    let at = line.char_indices().find(|(_, sign)| {
        match quote {
            Some(open) if open == *sign => quote = None,
            None if "\"'".contains(*sign) => quote = Some(*sign),
            _ => {}
        }
        quote.is_none() && *sign == '#'
    });
    at.map(|(at, _)| (&line[..at], &line[at + 1..]))
}

/// That the plan is an example under another title.
fn retitled_example(case: &Case) -> Option<String> {
    let name = if case.plan.is_titled_example() { None } else { case.plan.example_of_site() }?;
    Some(say!(
        "EXAMPLE: tires, cables, ground, holes and launches are those of `{name}`, so nothing of it is to be fired: put in those of your site",
        name
    ))
}

/// Which inputs `[uncertainty]` leaves out.
fn inputs_left_out(case: &Case) -> Option<String> {
    let keys = case.plan.left_out.iter().map(|key| format!("`{key}`")).join(", ");
    let text = || say!("[uncertainty] leaves out {keys}: small values of the program count, not yours", keys);
    (!keys.is_empty()).then(text)
}

/// Which inputs `[uncertainty]` says are exact, as nothing on a site is: told with the verdicts of a plan.
pub fn taken_as_exact(case: &Case) -> Option<String> {
    let keys = case.plan.taken_as_exact().iter().map(|key| format!("`{key}`")).join(", ");
    let text =
        || say!("[uncertainty] takes as exact what nobody knows exactly, so it is not varied: {keys}", keys);
    (!keys.is_empty()).then(text)
}

/// That the ends of a rope are taken to hold all of what the rope holds, because the plan names no termination.
fn whole_rope_held(case: &Case) -> Option<String> {
    let cable = &case.plan.cable;
    let is_whole = cable.termination.is_none() && cable.termination_percent == 100.0;
    let text = "the ends of the cables are taken to hold all that the rope holds, as no clip or splice does: name the `termination`, see `shelter ropes`";
    (is_whole && cable.rope.is_some()).then(|| phrase(text).to_owned())
}

/// That no verdict passes on a launch velocity that nobody observed.
fn launch_estimated(case: &Case) -> Option<String> {
    let uncertainty = &case.plan.uncertainty;
    let percent = units::short(uncertainty.launch_common_percent);
    let text = say!(
        "launch estimated: `launch_common_percent = {percent}` says that nobody observed this velocity, so no option passes; \
         film a loose test tire or a covered shot, see `shelter launch`",
        percent
    );
    uncertainty.launch_is_estimated().then_some(text)
}

/// That the launch velocity is taken as surer than anybody can know it.
fn launch_too_sure(case: &Case) -> Option<String> {
    let uncertainty = &case.plan.uncertainty;
    let percent = units::short(uncertainty.launch_common_percent);
    let text = say!(
        "the launch velocity is taken as known to {percent} %, surer than any film: \
         write `launch_common_percent`, 50 for a guess, 10 for a filmed test tire, or what `shelter fit` finds",
        percent
    );
    case.plan.takes_launch_as_too_sure().then_some(text)
}

/// That a plan was fitted to so few observations that chance may have made its launches.
fn fitted_to_few(case: &Case) -> Option<String> {
    let few = match fitted_values(&case.plan.fitted_from) {
        1 => phrase("ONE observation"),
        2 => phrase("two observations"),
        _ => return None,
    };
    Some(say!("the launches are fitted to {few}: one film of one tire tells little, film more shots", few))
}

/// That a tire of a list over a hole is lighter than that of `[tire]`: the plan's launch may have been seen on the heavier one.
fn launches_lighter_tire(case: &Case) -> Option<String> {
    let (scene, usual) = (case.scene(), case.plan.tire.mass_kg);
    let launched = case.shots.first()?.firings.iter().map(|firing| firing.tire);
    let lightest = launched.min_by(|a, b| scene.mass[*a].total_cmp(&scene.mass[*b]))?;
    let [mass, planned] = [scene.mass[lightest], usual].map(|mass| units::rounded(mass, 0));
    let text = say!(
        "tire {tire} over a hole has {mass} kg, that of [tire] {planned}: its launch is taken as written; was it filmed with so light a tire?",
        scene.tire_ids[lightest],
        mass,
        planned
    );
    (scene.mass[lightest] < 0.95 * usual).then_some(text)
}

/// That the fastest launch of the plan is slower than the middle of what its charge and stemming say, and no shot was fitted.
fn launch_below_estimate(case: &Case) -> Option<String> {
    let (plan, estimates) = (&case.plan, LaunchEstimates::new(&Blast::of_plan(&case.plan), None, &[]));
    let band = estimates.chosen()?.band;
    let fastest = fastest_launch(plan);
    let [speed, low_m_s, middle, high_m_s] =
        [fastest, band[0], band[1], band[2]].map(|speed| units::rounded(speed, 1));
    let text = say!(
        "`launch_m_s = {speed}` is slower than the middle of what charge and stemming say, {middle} ({low_m_s} to {high_m_s} m/s): was it filmed? See `shelter launch`",
        speed,
        middle,
        low_m_s,
        high_m_s
    );
    (fastest < band[1] && plan.fitted_from.is_empty()).then_some(text)
}

/// That pyrotechnic caps do not scatter in the holes.
fn no_in_hole_scatter(case: &Case) -> Option<String> {
    let text =
        "detonators are pyrotechnic, but `in_hole_delay_ms` is 0: no scatter inside the holes is drawn";
    case.plan.uncertainty.lacks_in_hole_scatter().then(|| phrase(text).to_owned())
}

/// Rows whose holes fire one after the other from the left or the right, and are not listed from left to right: who wires them as listed
/// fires what nobody judged.
fn listed_otherwise(case: &Case) -> Vec<String> {
    let goes_by_side = |timing: &HoleTiming| {
        !timing.is_together() && matches!(timing.order, HoleOrder::Left | HoleOrder::Right)
    };
    let option = case.plan.delays.iter().position(|delay| goes_by_side(&delay.hole_timing));
    let Some(shot) = option.map(|option| &case.shots[option]) else { return Vec::new() };
    let warning = |(row, blast_row): (usize, &BlastRow)| {
        let of_row = shot.firings.iter().filter(|firing| firing.row == row);
        let holes = sorted_by_key(of_row, |firing| firing.number);
        let left = holes.iter().min_by_key(|firing| firing.from_left)?;
        let (name, hole, tire) = (&blast_row.name, left.number + 1, case.scene().tire_ids[left.tire]);
        let text = say!(
            "row {name}: its holes are not listed from left to right, and `hole_order` goes by their places: the left one is hole {hole}, tire {tire}",
            name,
            hole,
            tire
        );
        (!holes.is_sorted_by_key(|firing| firing.from_left)).then_some(text)
    };
    case.plan.blast_rows.iter().enumerate().filter_map(warning).collect()
}

/// Holes that lie beside their tires, or under none.
fn beside_tires(case: &Case) -> Vec<String> {
    let Some(shot) = case.shots.first() else { return Vec::new() };
    let holes = holes_beside_tires(case, shot);
    let told = |what: &str, among: &dyn Fn(&HoleBesideTire) -> bool| {
        let some: Vec<&HoleBesideTire> = holes.iter().filter(|hole| among(hole)).collect();
        let worst = some.iter().max_by(|a, b| a.away[0].total_cmp(&b.away[0]))?;
        let place = say!("row {}, hole {}", case.plan.blast_rows[worst.row].name, worst.number + 1);
        let away = units::rounded(worst.away[0], 2);
        let tire = case.scene().tire_ids[worst.tires[0]];
        let (some, all) = (some.len(), shot.firings.len());
        Some(say!(
            "{some} of {all} holes lie {what}: {place} is {away} m from tire {tire}",
            some,
            all,
            phrase(what),
            place,
            away,
            tire
        ))
    };
    let uncovered = told("under no tire, and the nearest gets the whole launch", &|hole| hole.is_uncovered);
    let beside = told("beside their tires, which are pushed aside", &|hole| {
        !hole.is_uncovered && !hole.may_be_the_next
    });
    let between = told("between two tires, and either may get the launch", &|hole| {
        hole.may_be_the_next && !hole.is_uncovered
    });
    [uncovered, between, beside].into_iter().flatten().collect()
}

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
    swaps.chain(uncovered(&judged.checked.cover))
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
    use crate::plan::{Plan, PlanSource};

    /// A value that is assumed and unusual has one box; an assumed value of another section under the same key keeps its own.
    #[test]
    fn an_unusual_value_takes_the_box_of_no_other() {
        let text = include_str!("../../../plans/amur-three-rows.toml");
        let text = text.replacen("slack_percent = 2\n", "slack_percent = 40 # assumed\n", 1);
        let case = Case::parse(PlanSource { text, ..PlanSource::default() }).expect("a plan");
        let listed = to_be_confirmed(&case, &[]);
        let of_slack: Vec<&String> = listed.iter().filter(|line| line.contains("slack_percent")).collect();
        assert_eq!(of_slack, ["slack_percent = [1.5, 2.5]", "slack_percent = 40: usual are 0 to 15"]);
    }

    /// What a 0 or a range of one value leaves out of the samples is named, and a rope whose ends nobody named.
    #[test]
    fn what_is_taken_as_exact_or_whole_is_told() {
        let told = |changes: &[(&str, &str)]| {
            let text = include_str!("../../../plans/amur-three-rows.toml").to_owned();
            let change = |text: String, (old, new): &(&str, &str)| {
                assert!(text.contains(old), "{old}");
                text.replacen(old, new, 1)
            };
            let text = changes.iter().fold(text, change);
            let plan = Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
            let case = Case::new(plan);
            of_plan(&case)
                .into_iter()
                .chain(taken_as_exact(&case))
                .filter(|line| line.contains("exact") || line.contains("hold all"))
                .collect::<Vec<_>>()
        };
        assert_eq!(told(&[]), [""; 0]);
        let exact = "[uncertainty] takes as exact what nobody knows exactly, so it is not varied: ";
        assert_eq!(
            told(&[("hole_position_m = 0.05", "hole_position_m = 0")]),
            [format!("{exact}`hole_position_m`")]
        );
        let times = ("detonator = \"electronic\"", "delay_sd_ms = 0");
        let friction = ("friction = [0.4, 0.6]", "friction = [0.5, 0.5]");
        assert_eq!(told(&[times, friction]), [format!("{exact}`delay_sd_ms`, `friction`")]);
        let named = "termination_percent = 70 ";
        for whole in ["termination_percent = 100 ", ""] {
            assert!(told(&[(named, whole)])[0].contains("hold all that the rope holds"));
        }
        assert_eq!(told(&[(named, "termination_percent = 90 ")]), [""; 0]);
    }

    /// Chance may have made the launches of a plan that was fitted to one film, and nobody knows a launch to a percent without one.
    #[test]
    fn launches_that_nobody_can_know_so_well_are_told() {
        let told = |uncertainty: &str| {
            let text = include_str!("../../../tests/fixtures/amur-three-rows.toml");
            let (before, after) = text.split_once("launch_common_percent = 3 ").expect("a value");
            let plan = Plan::parse("", &format!("{before}{uncertainty} {after}"));
            of_plan(&Case::new(plan.unwrap_or_else(|mistakes| panic!("{mistakes}")))).join("\n")
        };
        let marks =
            |count: usize| (0..count).map(|n| format!(", \"abcd000{n}\"")).collect::<Vec<_>>().concat();
        let fitted = |count: usize| {
            told(&format!("launch_common_percent = 3\nfitted_from = [\"{:64}\"{}]\n#", 1, marks(count)))
        };
        assert!(fitted(1).contains("fitted to ONE observation"), "{}", fitted(1));
        assert!(fitted(2).contains("fitted to two observations"), "{}", fitted(2));
        assert!(!fitted(3).contains("fitted to"), "{}", fitted(3));
        for (percent, is_told) in [("0", true), ("1", true), ("1.1", false)] {
            let told = told(&format!("launch_common_percent = {percent}"));
            assert_eq!(told.contains("surer than any film"), is_told, "{percent}: {told}");
        }
    }
}
