//! The results of `check` as a table for reading.

use super::check::{broken, compute_label, explain};
use super::no_result;
use super::spark::sparkline;
use crate::study::Case;
use crate::study::check::Checked;
use crate::study::plans::{Results, verdict};
use crate::units::{self, Unit, value_and_error};
use crate::verdict::Verdict;

/// How a table looks.
#[derive(Clone, Copy, Debug, Default)]
pub struct Style {
    /// Plain characters only.
    pub ascii: bool,
    /// With colours; the words stand either way.
    pub color: bool,
}

impl Style {
    /// A verdict, in capitals.
    pub(super) fn verdict(self, verdict: Verdict) -> String {
        let word = verdict.label();
        let code = match verdict {
            Verdict::Pass => 32,
            Verdict::Undecided => 33,
            Verdict::Fail => 31,
        };
        if self.color { format!("\x1b[1;{code}m{word}\x1b[0m") } else { word.to_owned() }
    }

    pub(super) fn plain(self, text: String) -> String {
        if self.ascii { super::ascii::to_ascii(&text) } else { text }
    }
}

/// Width of a sparkline.
const SPARK: usize = 16;

/// One plan's results.
pub fn check(case: &Case, results: &Results, any: bool, style: Style) -> String {
    let plan = &case.plan;
    let mut text = super::heading(case);
    let name_width = plan.delays.iter().map(|delay| delay.name.chars().count()).max().unwrap_or(0).max(6);
    let drift = if case.limits.drift.is_some() { format!("  {:>17}", "drift, m") } else { String::new() };
    text += &format!(
        "{:name_width$}  {:4}  {:>17}  {:>17}  {:>6}{drift}  {:SPARK$}  {:SPARK$}\n",
        "option", "", "height, m", "force, kN", "factor", "height over time", "force over time"
    );
    for (delay, result) in plan.delays.iter().zip(results) {
        let verdict = result.as_ref().map_or(Verdict::Undecided, |checked| checked.verdict);
        text += &format!("{:name_width$}  {}", delay.name, style.verdict(verdict));
        match result {
            Err(reason) => text += &format!("  {}\n", no_result::message(reason)),
            Ok(checked) => text += &row(case, checked),
        }
    }
    let passed = results.iter().flatten().filter(|checked| checked.verdict == Verdict::Pass).count();
    let verdict = style.verdict(verdict(results, any));
    text += &format!("\n{verdict}: {passed} of {} options pass", results.len());
    if let Some(checked) = results.iter().flatten().next() {
        text += &format!(" · {}", compute_label(&checked.compute));
    }
    text.push('\n');
    style.plain(text)
}

/// Values, sparklines and reasons of one option.
fn row(case: &Case, checked: &Checked) -> String {
    let Checked { height, force, history, .. } = checked;
    let drift = value_and_error(checked.drift.value, checked.drift.error, Unit::Metre);
    let drift = if case.limits.drift.is_some() { format!("  {drift:>17}") } else { String::new() };
    let mut text = format!(
        "  {:>17}  {:>17}  {:>6}{drift}  {}  {}\n",
        value_and_error(height.value, height.error, Unit::Metre),
        value_and_error(force.value, force.error, Unit::Kilonewton),
        units::factor(checked.safety_factor),
        sparkline(&history.height, SPARK, case.limits.height),
        sparkline(&history.force, SPARK, case.limits.force),
    );
    for reason in &checked.reasons {
        text += &format!("    {}\n", explain(reason));
    }
    if !checked.broken.is_empty() {
        text += &format!("    {}\n", broken(case.scene(), checked));
    }
    text
}
