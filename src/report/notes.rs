//! Notes about a plan that readers of a study need beside its report.

use super::risk::swap_warning;
use crate::plan::Timing;
use crate::plan::keys::Key;
use crate::study::Case;
use crate::study::swaps::swaps as find_swaps;

/// Least probability of a swap of blast rows that deserves a warning.
pub const SWAP: f64 = 1e-4;

/// The delay options that a study of orders leaves out at the intervals of the plan; `None` where there is no such option.
pub fn orders(case: &Case) -> Option<String> {
    let own = case.plan.delays.iter().filter(|delay| matches!(delay.timing, Timing::At(_)));
    let names: Vec<&str> = own.map(|delay| delay.name.as_str()).collect();
    (!names.is_empty())
        .then(|| format!("note: without an interval of their own, and left out: {}", names.join("; ")))
}

/// Warnings of ranges of `[uncertainty]` that leave out what the plan itself says.
pub fn ranges(case: &Case) -> Vec<String> {
    let warning = |(key, [low, high], own): (&Key, [f64; 2], f64)| {
        let (path, name) = (&case.source.path, key.name);
        format!(
            "warning: {path}: `{name} = [{low}, {high}]` of [uncertainty] leaves out {own}, the plan's own: no sample is like \
             the nominal shot"
        )
    };
    case.plan.ranges_beside_the_plan().into_iter().map(warning).collect()
}

/// Warnings of blast rows that may fire in the wrong order, when the detonators scatter as the plan says.
pub fn swaps(case: &Case) -> Vec<String> {
    find_swaps(case, SWAP).iter().map(|swap| format!("warning: {}", swap_warning(case, swap))).collect()
}
