//! A result as data, and its faces: the renderers that draw the result as text, CSV, JSON and HTML.
//!
//! | what | where |
//! |---|---|
//! | what a report is | [`parts`] |
//! | answer of a study → report: dispatch | [`mod@answer`] |
//! | reports on options | [`check`], [`risk`], [`assumptions`], [`remedies`], [`sweep`], `sweep_windows`, [`orders`], [`search`] |
//! | reports on shelter and model | [`size`], [`ropes`], [`effects`], [`accuracy`], `paper_table`, [`trace`] |
//! | reports on launch and observations | [`launch`], [`mod@fit`] |
//! | the answer in one line | [`brief`] |
//! | sentences that reports and screens share | [`words`] |
//! | charts, columns and rows that reports share | [`charts`], [`shared_columns`], `option_row` |
//! | faces | [`text`], [`csv`], [`json`], `html`; the terminal has its own |
//! | what faces share | [`palette`], [`ascii`], [`spark`], [`language`] |
//!
//! A builder decides which numbers and words a report holds. A face decides how they look, and reads no other face.

pub mod accuracy;
pub mod answer;
pub mod ascii;
pub mod assumptions;
pub mod brief;
pub mod charts;
pub mod check;
pub mod csv;
pub mod effects;
pub mod fit;
pub mod flight;
#[cfg(feature = "page")]
pub mod html;
pub mod json;
pub mod language;
pub mod launch;
pub mod observed;
mod option_row;
pub mod orders;
pub mod palette;
mod paper_table;
pub mod parts;
pub mod remedies;
pub mod risk;
pub mod ropes;
pub mod search;
pub mod shared_columns;
pub mod size;
pub mod spark;
pub mod sweep;
mod sweep_windows;
pub mod text;
pub mod trace;
pub mod words;

use self::check::judged_inputs;
use self::parts::{Block, Fact, Report, fact};
use self::words::{limits, plan_notes, plan_warnings};
use crate::study::Case;
use crate::verdict::Verdict;

/// Names of blast rows.
fn row_names(case: &Case, rows: &[usize]) -> Vec<String> {
    rows.iter().map(|&row| case.plan.blast_rows[row].name.clone()).collect()
}

/// Title and file of a plan.
fn title(case: &Case) -> String {
    format!("{} · {}", case.title(), case.source.name())
}

/// The accepted risk, and the assumed inputs, in words; empty where only the planned shots were judged.
fn accepted_risk(case: &Case, sampled: bool) -> String {
    let uncertainty = &case.plan.uncertainty;
    let assumed = match (uncertainty.assumed, uncertainty.incomplete) {
        (true, _) => " · inputs assumed",
        (_, true) => " · inputs that [uncertainty] leaves out are assumed",
        _ => "",
    };
    let launch = if uncertainty.launch_is_estimated() { " · launch estimated" } else { "" };
    let text = format!(" · accepted risk {} %{assumed}{launch}", case.plan.limits.accepted_risk_percent);
    if sampled { text } else { String::new() }
}

/// A report with title, size, limits, warnings of a plan and its effects beyond the source paper's model, and nothing else yet.
/// `sampled`: the report covers the shots that `[uncertainty]` describes.
fn report_head(case: &Case, schema: &'static str, sampled: bool) -> Report {
    let (plan, scene) = (&case.plan, case.scene());
    let mut facts = format!(
        "{} tires, {} cables · limits: {}",
        scene.tire_count(),
        scene.cables.len(),
        limits::limits(case)
    );
    if let Some(duration) = plan.simulation.duration_s {
        facts += &format!(" · followed for {duration} s at most");
    }
    facts += &accepted_risk(case, sampled);
    let mut warnings = plan_warnings::of_plan(case);
    // Planned shots alone vary nothing, so this warning does not apply.
    warnings.extend(sampled.then(|| plan_warnings::nearly_exact_inputs(case)).flatten());
    Report {
        schema,
        title: title(case),
        facts: [facts].into_iter().chain(plan_notes::beyond_paper(plan)).collect(),
        blocks: vec![Block::Facts(plan_facts(case))],
        warnings,
        ..Report::default()
    }
}

/// File and title of a plan, for scripts.
fn plan_facts(case: &Case) -> Vec<Fact> {
    vec![fact(&["plan"], case.source.name()), fact(&["title"], case.title().into_owned())]
}

/// Verdict of a study, what was judged, whether it ended early, and the limits, for scripts.
fn judged_facts(case: &Case, verdict: Verdict, sampled: bool, partial: bool) -> Vec<Fact> {
    vec![
        fact(&["verdict"], verdict),
        fact(&["judged"], judged_inputs(case, sampled)),
        fact(&["partial"], partial),
        fact(&["limits.flight_height_m"], case.limits.height),
        fact(&["limits.cable_force_n"], case.limits.force),
        fact(&["limits.cable_safety_factor"], case.plan.limits.cable_safety_factor),
        fact(&["limits.drift_m?"], case.limits.drift),
    ]
}
