//! One page for the blast file: what was planned, what came out and what the model leaves out. Nothing in it is fetched
//! from elsewhere, and it prints on A4.

mod facts;
mod svg;
mod table;
mod top_view;

pub use self::svg::{stack, svg};
use self::table::word;
pub use self::top_view::svg as top_view;

use chrono::{DateTime, Local};
use maud::{DOCTYPE, PreEscaped, html};
use sha2::{Digest, Sha256};

use super::model::Block;
use super::palette::Role;
use super::{charts, check, explain};
use crate::study::Case;
use crate::study::check_all::OptionResults;
use crate::study::sampling::Sampling;
use crate::verdict::Verdict;

const STYLE: &str = "
@page { size: A4; margin: 15mm }
body { font: 10pt/1.4 system-ui, sans-serif; color: #111; max-width: 190mm; margin: 0 auto; padding: 5mm }
h1 { font-size: 18pt; margin: 0 } h2 { font-size: 12pt; margin: 6mm 0 2mm; border-bottom: 1px solid #999 }
table { border-collapse: collapse; width: 100% } th, td { text-align: left; padding: 1mm 2mm; border-bottom: 1px solid #ddd }
td.n, th.n { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap }
th::first-letter { text-transform: uppercase } .pass, .fail, .undecided { font-weight: bold }
.quiet { color: #555 } .charts { display: flex; gap: 4mm; break-inside: avoid } .charts svg, .view svg { width: 100%; height: auto }
.charts > div { flex: 1 } section { break-inside: avoid } section.long { break-inside: auto }
pre { font-size: 8pt; white-space: pre-wrap; overflow-wrap: anywhere }
";

/// What stands under the results, whatever the plan.
const ASSUMPTIONS: &[&str] = &[
    "Tires are point masses that do not turn; the ground is a hard plane. It is level, and a landing does not rebound, where the plan says nothing else.",
    "Cables are elastic, without mass and damping; they only pull, and their fastenings hold.",
    "Each hole gives its tire the launch velocity written in the plan, varied in the possible shots as [uncertainty] says; it does not follow from charge, stemming or gas: charges only count within 8 ms.",
    "Friction on the ground is Coulomb's, with one coefficient.",
    "The error stated with a value of the shot as planned is that of the computation; what the plan's own numbers leave open is in the bands and the risk.",
    "The limits are the plan's; no limit is safe by default. A competent person decides.",
];

/// The page of one plan; `date` is printed as given.
pub fn page(
    case: &Case,
    results: &OptionResults,
    partial: bool,
    sampling: Option<&Sampling>,
    date: &str,
) -> String {
    let plan = &case.plan;
    let hash = Sha256::digest(case.source.text.as_bytes());
    let hash: String = hash.iter().map(|byte| format!("{byte:02x}")).collect();
    let report = check::report(case, results, None, false, partial);
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                title { (case.title()) }
                style { (PreEscaped(STYLE)) (PreEscaped(verdict_colors())) }
            }
            body {
                h1 { (case.title()) }
                @if let Some(conclusion) = &report.conclusion {
                    p { (word(conclusion.verdict)) " · " (conclusion.text) }
                }
                p.quiet { "Plan " (case.source.path) " · " (date) " · shelter " (env!("CARGO_PKG_VERSION")) }
                section {
                    h2 { "Shelter" }
                    (facts::shelter(case))
                    div.view { (PreEscaped(top_view(case, None))) }
                }
                section {
                    h2 { "Delay options" }
                    @for fact in &report.facts { p.quiet { (fact) } }
                    @if let Some(Sampling { most, seed, .. }) = sampling {
                        p.quiet { "At most " (most) " possible shots of each option, drawn from seed " (seed) }
                        ul { @for meaning in explain::VERDICTS { li { (meaning) } } }
                    } @else {
                        p { "The plan's own numbers only, nothing varied: other shots that may come of this plan can fail." }
                    }
                    @for block in &report.blocks {
                        @if let Block::Table(options) = block { (table::table(options)) }
                    }
                    @for warning in &report.warnings { p { strong { "Warning: " } (warning) } }
                }
                @for ((delay, shot), result) in plan.delays.iter().zip(&case.shots).zip(results) {
                    @if let Ok(judged) = result {
                        section {
                            h2 { (delay.name) " " (word(judged.verdict())) }
                            p.quiet { (explain::computation(case.scene(), &judged.as_planned)) }
                            div.charts {
                                @for chart in charts::history(case, &judged.as_planned.history, shot) {
                                    div { (PreEscaped(svg(&chart).unwrap_or_default())) }
                                }
                            }
                        }
                    }
                }
                @if sampling.is_some() {
                    section {
                        h2 { "What is not known" }
                        (facts::uncertainty(&plan.uncertainty))
                    }
                }
                section {
                    h2 { "What the model assumes" }
                    ul { @for assumption in ASSUMPTIONS { li { (assumption) } } }
                }
                section {
                    h2 { "Reproduce" }
                    p { (facts::command(case, results, sampling)) }
                    @if partial { p { "The time was up before all was computed: the same command computes more." } }
                    p.quiet { "SHA-256 of the plan: " code { (hash) } }
                }
                @if !case.source.text.is_empty() {
                    section.long {
                        h2 { "The plan, word for word" }
                        pre { (case.source.text) }
                    }
                }
            }
        }
    };
    page.into_string()
}

/// Today; a day fixed by SOURCE_DATE_EPOCH where pages are to be reproduced.
pub fn today() -> String {
    let fixed = std::env::var("SOURCE_DATE_EPOCH").ok().and_then(|seconds| seconds.parse().ok());
    let fixed = fixed.and_then(|seconds| DateTime::from_timestamp(seconds, 0));
    fixed.map_or_else(|| Local::now().date_naive(), |fixed| fixed.date_naive()).to_string()
}

/// Colours of verdicts, by the names of their classes.
fn verdict_colors() -> String {
    let rule = |verdict: Verdict| {
        let [red, green, blue] = Role::of(verdict).on_light();
        format!(".{} {{ color: rgb({red}, {green}, {blue}) }}\n", verdict.name())
    };
    [Verdict::Pass, Verdict::Undecided, Verdict::Fail].map(rule).concat()
}
