//! Warnings: what a reader must know beside the results, one sentence each. Text, page and terminal draw them; where only numbers
//! are printed, they go to standard error.

use crate::plan::DelayOption;
use crate::plan::keys::Key;
use crate::plan::usual::Unusual;
use crate::study::check_all::OptionResults;
use crate::study::cover::Cover;
use crate::study::judgement::Judgement;
use crate::study::swaps::{self, Swap};
use crate::study::{Case, NoResult, ShotSummary};
use crate::units;

/// Least probability of a swap of blast rows that deserves a warning.
const SWAP: f64 = 1e-4;
/// Drift over the widest distance of tied tires from which it is told where no limit judges it.
const FAR: f64 = 0.5;

/// Warnings of a plan, whatever is found: values that are not usual, and ranges of `[uncertainty]` that leave out what the plan
/// itself says.
pub fn of_plan(case: &Case) -> Vec<String> {
    let unusual = case.plan.unusual();
    let unusual = unusual.iter().map(|Unusual { section, key, value, usual: [low, high] }| {
        let (name, title, unit) = (key.name, section.title, key.kind.unit());
        let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
        format!(
            "`{name} = {value}` of {title} is unusual, a slip of the pen? Usual are {low} to {high}{unit}"
        )
    });
    let warning = |(key, [low, high], own): (&Key, [f64; 2], f64)| {
        let name = key.name;
        format!(
            "`{name} = [{low}, {high}]` of [uncertainty] leaves out {own}, the plan's own: no sample is like the nominal shot"
        )
    };
    unusual.chain(case.plan.ranges_beside_the_plan().into_iter().map(warning)).collect()
}

/// Warnings of the options of a plan: blast rows that may fire in the wrong order, and holes that fire under no cover.
pub fn of_options(case: &Case, results: &OptionResults) -> Vec<String> {
    let sampled = results.iter().flatten().any(|judged| judged.risk.is_asked());
    let swaps = if sampled { swaps(case) } else { Vec::new() };
    let covers = |(delay, result): (&DelayOption, &Result<Judgement, NoResult>)| {
        let cover = uncovered(&result.as_ref().ok()?.as_planned.cover)?;
        Some(format!("option {}: {cover}", delay.name))
    };
    let covers = case.plan.delays.iter().zip(results).filter_map(covers);
    swaps.into_iter().chain(covers).chain(drifts(case, results)).collect()
}

/// The warning that tires end far from where they lay, and no limit judges that; `None` where none does.
fn drifts(case: &Case, results: &OptionResults) -> Option<String> {
    let far = FAR * case.plan.layout.widest_tie();
    let drift = |(delay, result): (&DelayOption, &Result<Judgement, NoResult>)| {
        let drift = result.as_ref().ok()?.as_planned.drift.value;
        (case.limits.drift.is_none() && drift > far)
            .then(|| format!("{} {} m", delay.name, units::rounded(drift, 2)))
    };
    let drifts: Vec<String> = case.plan.delays.iter().zip(results).filter_map(drift).collect();
    (!drifts.is_empty()).then(|| {
        format!(
            "drift is not judged, there is no limit `drift_m`, and tires end more than half the distance of tied tires from where they lay: {}",
            drifts.join(", ")
        )
    })
}

/// Warnings of blast rows that may fire in the wrong order, of all options.
pub fn swaps(case: &Case) -> Vec<String> {
    swaps::swaps(case, SWAP).iter().map(|found| swap(case, found)).collect()
}

/// The same of one option.
pub fn swaps_of(case: &Case, option: usize) -> Vec<String> {
    let all = swaps::swaps(case, SWAP);
    all.iter().filter(|found| found.option == option).map(|found| swap(case, found)).collect()
}

/// The warning that two blast rows may fire in the wrong order.
fn swap(case: &Case, swap: &Swap) -> String {
    let [first, second] = swap.rows.map(|row| &case.plan.blast_rows[row].name);
    format!(
        "option {}: {} between rows {first} and {second} is short for the scatter of the detonators; a given hole of row {second} fires before a given hole of row {first} with a probability of {}",
        case.plan.delays[swap.option].name,
        units::exact_milliseconds(swap.interval),
        units::percent(swap.probability, 2),
    )
}

/// The warning that holes fire under a tire in the air or aside; `None` where none does.
pub fn uncovered(cover: &Cover) -> Option<String> {
    let Cover { holes, uncovered, height, shift } = cover;
    let [height, shift] = [height, shift].map(|value| units::rounded(*value, 2));
    (*uncovered > 0).then(|| {
        format!(
            "{uncovered} of {holes} holes fire under a tire in the air or moved aside, up to {height} m high and {shift} m aside: \
             the model gives it the whole launch"
        )
    })
}

/// The same for one of the shots of a study, called `name`.
pub fn uncovered_shot(name: &str, shot: Option<&ShotSummary>) -> Option<String> {
    Some(format!("{name}: {}", uncovered(&shot?.cover)?))
}

/// How many of the shots of a study have such holes; `what` they are, many of them: `intervals tried`.
pub fn count_uncovered<'a>(
    what: &str,
    shots: impl ExactSizeIterator<Item = &'a ShotSummary>,
) -> Option<String> {
    let all = shots.len();
    let some = shots.filter(|shot| shot.cover.uncovered > 0).count();
    (some > 0).then(|| {
        format!("of {all} {what} {some} have holes that fire under a tire in the air or moved aside: the model gives it the whole launch")
    })
}
