//! Warnings of holes that fire under a tire in the air or moved aside.

use crate::plan::DelayOption;
use crate::study::check::Checked;
use crate::study::check_all::OptionResults;
use crate::study::cover::Cover;
use crate::study::judgement::Judgement;
use crate::study::{Case, NoResult};
use crate::units;

/// A warning of holes of an option that fire under a tire in the air or aside; `None` where there is none.
pub fn cover(checked: &Checked) -> Option<String> {
    let Cover { holes, uncovered, height, shift } = checked.cover;
    let [height, shift] = [height, shift].map(|value| units::rounded(value, 2));
    (uncovered > 0).then(|| {
        format!(
            "{uncovered} of {holes} holes fire under a tire in the air or moved aside, up to {height} m high and {shift} m aside: \
             the model gives it the whole launch"
        )
    })
}

/// The same for every option of a plan.
pub fn covers(case: &Case, results: &OptionResults) -> Vec<String> {
    let warning = |(delay, result): (&DelayOption, &Result<Judgement, NoResult>)| {
        let cover = cover(&result.as_ref().ok()?.as_planned)?;
        Some(format!("warning: option {}: {cover}", delay.name))
    };
    case.plan.delays.iter().zip(results).filter_map(warning).collect()
}
