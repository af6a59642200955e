//! A study spread over several machines: each writes its share as lines of JSON, merged into what one would have found.
//!
//! The first line of a share says what is studied, with the plan itself, so that merging needs no other file.

use itertools::Itertools;
use serde::{Deserialize, Serialize};

use super::orders::Tried;
use super::scatter::{Draw, Sample};
use super::{Case, ComputeSettings, Shard};
use crate::plan::ScatterSpec;

/// What is studied.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "study", rename_all = "lowercase")]
pub enum Question {
    /// Every order at these intervals.
    Orders {
        /// Between successive rows [s].
        intervals_s: Vec<f64>,
    },
    /// Samples of every option.
    Scatter {
        /// What scatters.
        spec: ScatterSpec,
        /// How many.
        draw: Draw,
    },
}

/// The first line of a share.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Head {
    /// `shelter.shard/1`.
    pub schema: String,
    /// Version of the program.
    pub version: String,
    /// What is studied.
    pub question: Question,
    /// How finely.
    pub compute: ComputeSettings,
    /// Name of the plan.
    pub plan: String,
    /// Its text.
    pub text: String,
    /// Which share.
    pub shard: Shard,
    /// Lines that follow.
    pub lines: usize,
}

/// Results of a study, in the order of one machine.
#[derive(Clone, Debug, PartialEq)]
pub enum Findings {
    /// Of `orders`.
    Orders(Vec<Tried>),
    /// Of `scatter`.
    Scatter(Vec<Sample>),
}

/// The schema of shares.
pub const SCHEMA: &str = "shelter.shard/1";

impl Findings {
    /// Whether these can be findings of a study of `case`, each once.
    pub fn fit(&self, case: &Case) -> bool {
        let rows: Vec<usize> = (0..case.plan.blast_rows.len()).collect();
        match self {
            Findings::Orders(tried) => {
                let complete = |tried: &Tried| tried.order.iter().copied().sorted().eq(rows.iter().copied());
                tried.iter().all(complete) && tried.iter().map(|tried| tried.number).all_unique()
            }
            Findings::Scatter(samples) => {
                samples.iter().all(|sample| sample.option < case.shots.len())
                    && samples.iter().map(|sample| (sample.option, sample.number)).all_unique()
            }
        }
    }
}

/// Joins shares, given as `(name, text)`; says what is wrong with them.
pub fn merge(shares: &[(String, String)]) -> Result<(Head, Findings), String> {
    let mut heads: Vec<(&str, Head)> = Vec::new();
    let (mut orders, mut samples) = (Vec::new(), Vec::new());
    for (name, text) in shares {
        let mut lines = text.lines().enumerate();
        let wrong = |line: usize, error: &dyn std::fmt::Display| {
            format!(
                "{name}:{}: {error}; a share is what `shelter orders` or `scatter` wrote with --shard",
                line + 1
            )
        };
        let (_, first) = lines.next().ok_or_else(|| wrong(0, &"the file is empty"))?;
        let head: Head = serde_json::from_str(first).map_err(|error| wrong(0, &error))?;
        for (n, line) in lines {
            match head.question {
                Question::Orders { .. } => {
                    orders.push(serde_json::from_str(line).map_err(|error| wrong(n, &error))?);
                }
                Question::Scatter { .. } => {
                    samples.push(serde_json::from_str(line).map_err(|error| wrong(n, &error))?);
                }
            }
        }
        let found = text.lines().count() - 1;
        if found != head.lines {
            return Err(format!(
                "{name}: {found} of its {} lines are there; copy the share again",
                head.lines
            ));
        }
        if head.shard.index >= head.shard.of {
            return Err(wrong(0, &"there is no such share"));
        }
        heads.push((name, head));
    }
    let (_, first) = heads.first().cloned().ok_or("no share to merge")?;
    for (name, head) in &heads {
        let shard = Shard { index: first.shard.index, ..head.shard };
        let alike = Head { shard, lines: first.lines, ..head.clone() };
        if alike != first {
            return Err(format!("{name}: a share of another study than {}", heads[0].0));
        }
    }
    for index in 0..first.shard.of {
        let count = heads.iter().filter(|(_, head)| head.shard.index == index).count();
        if count != 1 {
            let which = format!("share {}/{}", index + 1, first.shard.of);
            return Err(if count == 0 {
                format!("{which} is missing")
            } else {
                format!("{which} is there twice")
            });
        }
    }
    orders.sort_by_key(|tried: &Tried| tried.number);
    samples.sort_by_key(|sample: &Sample| (sample.option, sample.number));
    let findings = match first.question {
        Question::Orders { .. } => Findings::Orders(orders),
        Question::Scatter { .. } => Findings::Scatter(samples),
    };
    Ok((first, findings))
}
