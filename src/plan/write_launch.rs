//! Writes the result of `launch` into the text of a plan: the velocity, its uncertainty, and its source in a comment.

use toml_edit::{DocumentMut, Item};

use super::Plan;
use super::edit::{change_section, with_line_ends_of};
use super::keys::{plan, uncertainty};
use super::write_fit::{self, EstimateToWrite, FitToWrite, LaunchUncertainty};
use crate::choice::Unknown;

/// A launch velocity for a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct LaunchToWrite {
    /// Factor on all launch velocities of the plan.
    pub factor: f64,
    /// Uncertainty of the launches with this velocity.
    pub known: LaunchUncertainty,
    /// Source of the velocity, for the comment.
    pub source: String,
    /// Checksums of the observations behind the velocity.
    pub checksums: Vec<String>,
}

/// The text of a plan with this launch velocity. Comments stay, except the comment beside `launch_common_percent`: it states the source of
/// the velocity.
pub fn write(text: &str, before: &Plan, launch: &LaunchToWrite) -> Result<String, String> {
    let LaunchToWrite { factor, known, source, checksums } = launch;
    let percent = known.common_percent;
    let estimate =
        EstimateToWrite { unknown: Unknown::Launch, row: None, value: *factor, sd: 1e-2 * percent * factor };
    let fitted = FitToWrite { estimates: vec![estimate], launches: Some(*known) };
    let written = write_fit::write(text, before, &fitted, checksums)?;
    let mut document: DocumentMut =
        written.parse().map_err(|error: toml_edit::TomlError| error.message().to_owned())?;
    change_section(&mut document, &plan::UNCERTAINTY, |section| {
        let common = section.get_mut(uncertainty::LAUNCH_COMMON_PERCENT.name).and_then(Item::as_value_mut);
        // A line end or a control character would end the comment.
        let source: String = source.chars().map(|sign| if sign.is_control() { ' ' } else { sign }).collect();
        if let Some(value) = common {
            value.decor_mut().set_suffix(format!(" # {source}"));
        }
    });
    Ok(with_line_ends_of(text, &document))
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAN: &str = include_str!("../../tests/fixtures/amur-three-rows.toml");

    fn parsed(text: &str) -> Plan {
        Plan::parse("plan.toml", text).unwrap_or_else(|mistakes| panic!("{mistakes}"))
    }

    /// A launch that is an estimate stays an estimate after the plan is read, and after an edit of the velocity.
    #[test]
    fn an_estimate_says_so_in_the_plan_and_stays_one() {
        let known = LaunchUncertainty { common_percent: 50.0, between_shots_percent: 5.0 };
        let source = "impulse at the collar\nscaled depth 1.69".to_owned();
        let launch = LaunchToWrite { factor: 2.0, known, source, checksums: Vec::new() };
        let text = write(PLAN, &parsed(PLAN), &launch).expect("TOML");
        assert!(
            text.contains("launch_common_percent = 50.0 # impulse at the collar scaled depth 1.69\n"),
            "{text}"
        );
        let plan = parsed(&text);
        assert!(plan.uncertainty.launch_is_estimated() && plan.fitted_from.is_empty());
        assert!(plan.launches().all(|launch| launch.speed_m_s == 12.0));
        let edited = crate::plan::edit::with_launches(&text, 0.5).expect("TOML");
        assert!(parsed(&edited).uncertainty.launch_is_estimated());
        assert!(!parsed(PLAN).uncertainty.launch_is_estimated());
        // A plan without the section, and a plan with Windows line ends.
        let bare = PLAN[..PLAN.find("\n[uncertainty]").expect("the section") + 1].replace('\n', "\r\n");
        let text = write(&bare, &parsed(&bare), &launch).expect("TOML");
        assert!(parsed(&text).uncertainty.launch_is_estimated() && !text.replace("\r\n", "").contains('\n'));
    }
}
