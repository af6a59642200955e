//! A study spread over several machines: each machine writes its shard of the results, and `merge` joins the shards.
//!
//! A shard is lines of JSON. The first line is the [`Head`]: the question, and the plan itself, so that merging needs no
//! other file. Each further line is one result. The last line is the SHA-256 checksum of all lines before it.

use itertools::Itertools;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::file::checksum;
use crate::study::orders::TriedOrder;
use crate::study::samples::sample::OptionSample;
use crate::study::samples::sampling::Sampling;
use crate::study::search::TriedSchedule;
use crate::study::{Case, ComputeSettings, Shard};

/// The question that a study answers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "study", rename_all = "lowercase")]
pub enum Question {
    /// Every order at these intervals.
    Orders {
        /// Between successive rows [s].
        intervals_s: Vec<f64>,
        /// Samples of the worst and the best; `None` where only the shots as planned were asked for.
        sampling: Option<Sampling>,
    },
    /// Samples of every option.
    Risk {
        /// Number of samples and seed.
        sampling: Sampling,
    },
    /// The schedules with the least risk.
    Search {
        /// Samples behind a verdict; `None` where only the shots as planned were asked for.
        sampling: Option<Sampling>,
    },
}

/// The first line of a shard.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Head {
    /// [`SCHEMA`].
    pub schema: String,
    /// Version of the program that wrote the shard.
    pub version: String,
    /// The question.
    pub question: Question,
    /// Method and accuracy.
    pub compute: ComputeSettings,
    /// Path of the plan.
    pub plan: String,
    /// Text of the plan.
    pub text: String,
    /// Which shard this is.
    pub shard: Shard,
}

/// The last line of a shard.
#[derive(Serialize, Deserialize)]
struct Foot {
    /// SHA-256 of all lines before, in hexadecimal digits.
    sha256: String,
}

/// Results of a study, in the order of one machine.
#[derive(Clone, Debug, PartialEq)]
pub enum ShardResults {
    /// Of `orders`.
    Orders(Vec<TriedOrder>),
    /// Of `risk`.
    Risk(Vec<OptionSample>),
    /// Of `search`.
    Search(Vec<TriedSchedule>),
}

/// Name of this format of shards.
const SCHEMA: &str = "shelter.shard/10";
/// Version of this program.
const VERSION: &str = env!("CARGO_PKG_VERSION");

impl ShardResults {
    /// Whether these can be results of a study of `case`, each once.
    pub(super) fn belong_to(&self, case: &Case) -> bool {
        let rows: Vec<usize> = (0..case.plan.blast_rows.len()).collect();
        match self {
            ShardResults::Orders(tried) => {
                let complete =
                    |tried: &TriedOrder| tried.order.iter().copied().sorted().eq(rows.iter().copied());
                tried.iter().all(complete) && tried.iter().map(|tried| tried.number).all_unique()
            }
            ShardResults::Risk(samples) => {
                samples.iter().all(|sample| sample.option < case.shots.len())
                    && samples.iter().map(|sample| (sample.option, sample.sample.number)).all_unique()
            }
            ShardResults::Search(tried) => tried.iter().map(|tried| tried.number).sorted().eq(0..tried.len()),
        }
    }

    /// One line of JSON for each result.
    fn lines(&self) -> serde_json::Result<String> {
        fn lines<T: Serialize>(results: &[T]) -> serde_json::Result<String> {
            results.iter().map(|result| Ok(serde_json::to_string(result)? + "\n")).collect()
        }
        match self {
            ShardResults::Orders(tried) => lines(tried),
            ShardResults::Risk(samples) => lines(samples),
            ShardResults::Search(tried) => lines(tried),
        }
    }
}

/// Text of a shard of the study of `case`.
pub fn write_shard(
    case: &Case,
    question: Question,
    compute: ComputeSettings,
    shard: Shard,
    results: &ShardResults,
) -> serde_json::Result<String> {
    let head = Head {
        schema: SCHEMA.to_owned(),
        version: VERSION.to_owned(),
        question,
        compute,
        plan: case.source.path.clone(),
        text: case.source.text.clone(),
        shard,
    };
    let text = serde_json::to_string(&head)? + "\n" + &results.lines()?;
    let foot = Foot { sha256: checksum(&text) };
    Ok(text + &serde_json::to_string(&foot)? + "\n")
}

/// Reads a shard; says what is wrong with it. `name` stands for the file in messages.
fn read_shard(name: &str, text: &str) -> Result<(Head, ShardResults), String> {
    let wrong = |line: usize, error: &dyn std::fmt::Display| {
        format!(
            "{name}:{line}: {error}; a shard is what `shelter orders`, `risk` or `search` wrote with --shard"
        )
    };
    let (first, rest) = text.split_once('\n').ok_or_else(|| wrong(1, &"the file has no second line"))?;
    let Origin { schema, version } = serde_json::from_str(first).map_err(|error| wrong(1, &error))?;
    if schema != SCHEMA || version != VERSION {
        return Err(format!(
            "{name}: a shard of format {schema}, version {version}, but this is {SCHEMA}, version {VERSION}: compute all shards and merge them with one version"
        ));
    }
    let body = text.trim_end_matches('\n');
    let (before, last) = body.rsplit_once('\n').unwrap_or((body, ""));
    let foot: Foot = serde_json::from_str(last)
        .map_err(|_| format!("{name}: the last line, a checksum, is missing; copy the shard again"))?;
    if foot.sha256 != checksum(format!("{before}\n")) {
        return Err(format!(
            "{name}: the shard is not as it was written: its checksum differs; copy it again"
        ));
    }
    let head: Head = serde_json::from_str(first).map_err(|error| wrong(1, &error))?;
    if head.shard.index >= head.shard.of {
        return Err(wrong(1, &"there is no such shard"));
    }
    fn results<T: DeserializeOwned>(
        lines: &[&str],
        wrong: impl Fn(usize, &dyn std::fmt::Display) -> String,
    ) -> Result<Vec<T>, String> {
        let read =
            |(n, line): (usize, &&str)| serde_json::from_str(line).map_err(|error| wrong(n + 2, &error));
        lines.iter().enumerate().map(read).collect()
    }
    let mut lines: Vec<&str> = rest.lines().collect();
    lines.pop();
    let results = match head.question {
        Question::Orders { .. } => ShardResults::Orders(results(&lines, wrong)?),
        Question::Risk { .. } => ShardResults::Risk(results(&lines, wrong)?),
        Question::Search { .. } => ShardResults::Search(results(&lines, wrong)?),
    };
    Ok((head, results))
}

/// What the first line of any version says.
#[derive(Deserialize)]
struct Origin {
    schema: String,
    version: String,
}

/// Joins shards, given as `(name, text)`; says what is wrong with them.
pub(super) fn join(shards: &[(String, String)]) -> Result<(Head, ShardResults), String> {
    let mut heads: Vec<(&str, Head)> = Vec::new();
    let (mut orders, mut samples, mut schedules) = (Vec::new(), Vec::new(), Vec::new());
    for (name, text) in shards {
        let (head, results) = read_shard(name, text)?;
        match results {
            ShardResults::Orders(tried) => orders.extend(tried),
            ShardResults::Risk(drawn) => samples.extend(drawn),
            ShardResults::Search(tried) => schedules.extend(tried),
        }
        heads.push((name, head));
    }
    let (_, first) = heads.first().cloned().ok_or("no shard to merge")?;
    for (name, head) in &heads {
        let shard = Shard { index: first.shard.index, ..head.shard };
        if (Head { shard, ..head.clone() }) != first {
            return Err(format!("{name}: a shard of another study than {}", heads[0].0));
        }
    }
    for index in 0..first.shard.of {
        let count = heads.iter().filter(|(_, head)| head.shard.index == index).count();
        if count != 1 {
            let which = format!("shard {}/{}", index + 1, first.shard.of);
            return Err(if count == 0 {
                format!("{which} is missing")
            } else {
                format!("{which} is there twice")
            });
        }
    }
    orders.sort_by_key(|tried: &TriedOrder| tried.number);
    samples.sort_by_key(|drawn: &OptionSample| (drawn.option, drawn.sample.number));
    let results = match first.question {
        Question::Orders { .. } => ShardResults::Orders(orders),
        Question::Risk { .. } => ShardResults::Risk(samples),
        Question::Search { .. } => ShardResults::Search(schedules),
    };
    Ok((first, results))
}
