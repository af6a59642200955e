//! Warnings: what a reader must know beside the results, one sentence each. Text, page and terminal draw them; where only numbers
//! are printed, they go to standard error.

use crate::plan::keys::Key;
use crate::plan::usual::Unusual;
use crate::plan::{DelayOption, Timing};
use crate::study::check_all::OptionResults;
use crate::study::cover::Cover;
use crate::study::judgement::Judgement;
use crate::study::swaps::{self, Swap};
use crate::study::{Case, NoResult, ShotSummary};
use crate::units;
use crate::verdict::Quantity;

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
    let names = case.plan.delays.iter().filter_map(|delay| {
        let [named, fired] = false_interval(delay)?;
        let name = &delay.name;
        Some(format!("the option named \"{name}\" fires its rows {fired} ms apart, not {named} ms"))
    });
    names.chain(unusual).chain(case.plan.ranges_beside_the_plan().into_iter().map(warning)).collect()
}

/// The interval in the name of an option and the interval at which its rows fire [ms], where they differ: `42 ms` at 109 ms.
fn false_interval(delay: &DelayOption) -> Option<[f64; 2]> {
    let Timing::Interval { interval_ms, .. } = delay.timing else { return None };
    let (number, _) = delay.name.split_once(" ms")?;
    let named: f64 = number.parse().ok()?;
    (named != interval_ms).then_some([named, interval_ms])
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
    let drift = |(delay, result): (&DelayOption, &Result<Judgement, NoResult>)| {
        let drift = far_drift(case, result.as_ref().ok()?)?;
        Some(format!("{} {} m", delay.name, units::rounded(drift, 2)))
    };
    let drifts: Vec<String> = case.plan.delays.iter().zip(results).filter_map(drift).collect();
    (!drifts.is_empty()).then(|| format!("{FAR_DRIFT}: {}", drifts.join(", ")))
}

/// The same of one option.
pub fn drift(case: &Case, judged: &Judgement) -> Option<String> {
    Some(format!("{FAR_DRIFT}: {} m", units::rounded(far_drift(case, judged)?, 2)))
}

/// What is wrong where tires drift far.
const FAR_DRIFT: &str = "drift is not judged, there is no limit `drift_m`, and tires end more than half the distance of tied tires from where they lay";

/// The drift of an option where no limit judges it and it is far [m]: of the shot as planned, or of 1 in 20 of the possible shots.
fn far_drift(case: &Case, judged: &Judgement) -> Option<f64> {
    let of_samples = judged.risk.drawn().and_then(|risk| risk.band(Quantity::Drift));
    let of_samples = of_samples.map_or(0.0, |[_, _, p95, _]| p95);
    let drift = judged.as_planned.drift.value.max(of_samples);
    let far = FAR * case.plan.layout.widest_tie();
    (case.limits.drift.is_none() && drift > far).then_some(drift)
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
