//! `shelter merge`: shares of a study joined; and the printing of what it and a single machine find.

use std::io::{self, IsTerminal};
use std::path::PathBuf;

use clap::Args;

use super::{FormatArg, Look, Status, load, long};
use crate::plan::PlanSource;
use crate::report;
use crate::study::merge::{Findings, Head, Question, merge, write_share};
use crate::study::orders::Orders;
use crate::study::scatter::{swaps, verdict};
use crate::study::{Case, ComputeSettings, Shard};
use crate::verdict::Verdict;

#[derive(Args)]
pub struct Arguments {
    /// Files that `orders` or `scatter` wrote with --shard, all of them
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// Output format
    #[arg(long, value_enum, default_value = "text")]
    format: FormatArg,
}

/// Orders printed at each end of the ranking.
const SHOWN: usize = 8;

pub fn run(arguments: &Arguments, look: &Look) -> io::Result<Status> {
    let mut shares = Vec::new();
    for file in &arguments.files {
        match std::fs::read_to_string(file) {
            Ok(text) => shares.push((file.display().to_string(), text)),
            Err(error) => return load::wrong(&format!("cannot read {}: {error}", file.display())),
        }
    }
    let (head, findings) = match merge(&shares) {
        Ok(merged) => merged,
        Err(message) => return load::wrong(&message),
    };
    let case = match Case::parse(PlanSource { path: head.plan.clone(), text: head.text.clone() }) {
        Ok(case) => case,
        Err(mistakes) => return load::wrong(&mistakes.to_string()),
    };
    if !findings.fit(&case) {
        return load::wrong("the shares hold what is no result of their plan: one of them is damaged");
    }
    let Head { question, compute, .. } = head;
    let answer = Answer { case: &case, question, settings: compute, findings, partial: false };
    print(answer, None, arguments.format, look)
}

/// What a study of many shots found.
pub struct Answer<'a> {
    pub case: &'a Case,
    pub question: Question,
    pub settings: ComputeSettings,
    pub findings: Findings,
    /// Whether the time did not suffice for all.
    pub partial: bool,
}

/// Prints all that was found, or this machine's share of it.
pub fn print(answer: Answer<'_>, shard: Option<Shard>, format: FormatArg, look: &Look) -> io::Result<Status> {
    if let Some(shard) = shard {
        let Answer { case, question, settings, findings, .. } = answer;
        long::print(&write_share(case, question, settings, shard, &findings)?)?;
        return Ok(Status::Pass);
    }
    let Answer { case, question, findings, partial, .. } = answer;
    let style = look.style(io::stdout().is_terminal());
    let (text, all_pass) = match (findings, question) {
        (Findings::Scatter(samples), Question::Scatter { spec, draw }) => {
            let text = match format {
                FormatArg::Text => report::scatter::text(case, &draw, &samples, partial, style),
                FormatArg::Json => {
                    let swaps = swaps(case, &spec, super::scatter::SWAP);
                    report::json(&report::scatter::Document::new(case, &draw, &samples, &swaps, partial))
                }
                FormatArg::Csv => report::csv(report::scatter::lines(case, &samples)),
            };
            (text, verdict(case, &draw, &samples) == Verdict::Pass)
        }
        (Findings::Orders(tried), Question::Orders { intervals_s }) => {
            let orders = Orders::new(case, tried, intervals_s.len());
            let text = match format {
                FormatArg::Text => report::orders::text(case, &orders, SHOWN, partial, style),
                FormatArg::Json => report::json(&report::orders::Document::new(case, &orders, partial)),
                FormatArg::Csv => {
                    report::csv(orders.ranked.iter().map(|tried| report::orders::Line::new(case, tried)))
                }
            };
            (text, orders.verdict() == Verdict::Pass)
        }
        (Findings::Scatter(_), Question::Orders { .. }) | (Findings::Orders(_), Question::Scatter { .. }) => {
            return load::wrong("the shares do not fit together");
        }
    };
    long::print(&text)?;
    Ok(if all_pass && !partial { Status::Pass } else { Status::Fail })
}
