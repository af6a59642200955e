//! Printing what a study found that several machines can share: all of it, or the share of this machine.

use std::io;

use super::arguments::{FormatArg, LookArguments};
use super::print::{print, print_text};
use super::status::{Status, wrong};
use crate::report::json::{OrdersDocument, ScatterDocument};
use crate::report::notes::SWAP;
use crate::report::{orders, scatter};
use crate::study::merge::{Findings, Question, write_share};
use crate::study::orders::Orders;
use crate::study::scatter::swaps;
use crate::study::{Case, ComputeSettings, Shard};

/// What a study of many shots found.
pub struct Answer<'a> {
    pub case: &'a Case,
    pub question: Question,
    pub settings: ComputeSettings,
    pub findings: Findings,
    /// Whether the time was up before all shots were judged.
    pub partial: bool,
}

/// Prints all that was found, or this machine's share of it.
pub fn print_findings(
    answer: Answer<'_>,
    shard: Option<Shard>,
    format: FormatArg,
    look: &LookArguments,
) -> io::Result<Status> {
    if let Some(shard) = shard {
        let Answer { case, question, settings, findings, .. } = answer;
        print_text(&write_share(case, question, settings, shard, &findings)?)?;
        return Ok(Status::Pass);
    }
    let Answer { case, question, findings, partial, .. } = answer;
    match (findings, question) {
        (Findings::Scatter(samples), Question::Scatter { spec, sampling }) => {
            let document = || {
                let swaps = swaps(case, &spec, SWAP);
                ScatterDocument::new(case, &sampling, &samples, &swaps, partial)
            };
            print(&[scatter::report(case, &sampling, &samples, partial)], document, format, look)
        }
        (Findings::Orders(tried), Question::Orders { intervals_s }) => {
            let orders = Orders::new(case, tried, intervals_s.len());
            let document = || OrdersDocument::new(case, &orders, partial);
            print(&[orders::report(case, &orders, partial)], document, format, look)
        }
        (Findings::Scatter(_), Question::Orders { .. }) | (Findings::Orders(_), Question::Scatter { .. }) => {
            wrong("the shares do not fit together")
        }
    }
}
