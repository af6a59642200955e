//! The results file of a study: `--save` continues it, `--shard` writes it, and `merge` joins several.
//!
//! Each line is a JSON object with its own checksum. The first line is the [`Head`]: the question, and the plan itself, so that
//! merging needs no other file. Each further line is one result with its key, in any order. Results are appended as they come. When
//! the study is computed to its end, a line says so, with the number of results. A killed program leaves at most a last line
//! without its end, which is dropped.

use std::collections::HashMap;
use std::fs::{OpenOptions, TryLockError};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::question::Asked;
use super::work::journal::{Line, read_body, sealed, unsealed};
use super::{Case, Fingerprint, Journal, Shard};
use crate::file;

/// The first line of a results file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Head {
    schema: String,
    /// Version of the program that wrote the file.
    version: String,
    /// [`BUILD`] of that program.
    build: String,
    /// The question.
    pub asked: Asked,
    /// Path of the plan.
    pub plan: String,
    /// Text of the plan.
    pub text: String,
    /// The shard that this file holds.
    pub shard: Shard,
}

/// Name of this format.
const SCHEMA: &str = "shelter.results/4";
/// Version of this program.
const VERSION: &str = env!("CARGO_PKG_VERSION");
/// Fingerprint of all sources that results depend on. A file of another build may hold other numbers.
pub const BUILD: &str = env!("SHELTER_BUILD");
/// Beginning of every first line of this format, in any version.
const BEGINNING: &str = "{\"schema\":\"shelter.results/";

impl Head {
    /// The head of a study of `case`.
    pub fn new(case: &Case, asked: &Asked, shard: Shard) -> Self {
        Self {
            schema: SCHEMA.to_owned(),
            version: VERSION.to_owned(),
            build: BUILD.to_owned(),
            asked: asked.clone(),
            plan: case.source.name(),
            text: case.source.text.clone(),
            shard,
        }
    }

    fn line(&self) -> io::Result<String> {
        let text = serde_json::to_string(self)?;
        Ok(sealed(text.strip_suffix('}').unwrap_or(&text)))
    }

    /// Why two files are not shards of one study; `None` if they are.
    pub fn difference_of_study(&self, other: &Head) -> Option<&'static str> {
        let shard = Shard { index: other.shard.index, ..self.shard };
        Head { shard, ..self.clone() }.difference(other)
    }

    /// Why this is the head of another study than `other`. Another path of the plan is no reason.
    fn difference(&self, other: &Head) -> Option<&'static str> {
        match other {
            _ if self.text != other.text => Some("another plan, or of this plan before it was changed"),
            _ if Asked { compute: other.asked.compute, ..self.asked.clone() } != other.asked => {
                Some("another question")
            }
            _ if self.asked != other.asked => Some("another method, accuracy or step"),
            _ if self.shard != other.shard => Some("another shard"),
            _ => None,
        }
    }
}

/// Contents of a results file.
pub struct Contents {
    /// The first line.
    pub head: Head,
    /// The results, as JSON.
    pub known: HashMap<Fingerprint, Box<str>>,
    /// Whether the study was computed to its end.
    pub is_complete: bool,
    /// Number of result lines.
    results: usize,
    /// Length of all whole lines [bytes].
    length: usize,
}

/// Fields of the first line in any version.
#[derive(Deserialize)]
struct Origin {
    schema: String,
    version: String,
    #[serde(default)]
    build: String,
}

/// Reads a results file, or says what is wrong with it. `name` is the name of the file in messages.
pub fn read(name: &str, text: &str) -> Result<Contents, String> {
    if !text.starts_with(BEGINNING) {
        return Err(format!(
            "{name} holds no results of a study, as --save writes them; it stays as it is: name another file"
        ));
    }
    let whole = text.rfind('\n').map_or(0, |end| end + 1);
    let mut lines = text[..whole].lines().enumerate();
    let damaged = |line: usize| {
        let remedy =
            if line == 0 { "delete the file" } else { "delete this line: its result is computed again" };
        format!("{name}:{}: the line is not as it was written; copy the file again, or {remedy}", line + 1)
    };
    let first = lines.next().map(|(_, line)| line).ok_or_else(|| damaged(0))?;
    let Origin { schema, version, build } = serde_json::from_str(first).map_err(|_| damaged(0))?;
    if schema != SCHEMA || version != VERSION {
        return Err(format!(
            "{name}: results of version {version} of the program ({schema}), but this is version {VERSION} ({SCHEMA}): go on with that version, or begin another file"
        ));
    }
    if build != BUILD {
        return Err(format!(
            "{name}: results of build {build} of the program, but this is build {BUILD}, whose numbers may differ: go on with that build (`shelter --version` names it), or begin another file"
        ));
    }
    let body = unsealed(first).ok_or_else(|| damaged(0))?;
    let head: Head = serde_json::from_str(&format!("{body}}}")).map_err(|_| damaged(0))?;
    if head.shard.index >= head.shard.count {
        return Err(damaged(0));
    }
    let (mut known, mut results, mut is_complete) = (HashMap::new(), 0, false);
    for (n, line) in lines {
        match unsealed(line).and_then(read_body).ok_or_else(|| damaged(n))? {
            Line::Result(key, result) => {
                known.insert(key, result.into());
                results += 1;
            }
            Line::Complete(count) if count == results => is_complete = true,
            Line::Complete(count) => {
                return Err(format!(
                    "{name}:{}: {count} results were written and {results} are there; copy the file again, or delete this line: what is missing is computed again",
                    n + 1
                ));
            }
        }
    }
    Ok(Contents { head, known, is_complete, results, length: whole })
}

/// Begins a results file, or continues the file that an earlier run of the same study left. The error says why it cannot.
pub fn open(path: &Path, head: &Head) -> Result<Journal, String> {
    let name = path.display().to_string();
    let cannot = |error: io::Error| format!("cannot save results: {name}: {error}");
    match path.metadata() {
        Ok(data) if !data.is_file() => return Err(format!("cannot save results: {name} is no file")),
        Ok(_) => {}
        // The first line is written whole or not at all.
        Err(_) => {
            let line = head.line().map_err(cannot)?;
            file::create(path, &line).map_err(|error| format!("cannot save results: {error}"))?;
        }
    }
    // Windows does not shorten a file that is opened to append.
    let append = cfg!(not(windows));
    let mut file = OpenOptions::new().read(true).write(true).append(append).open(path).map_err(cannot)?;
    match file.try_lock() {
        // A file system without locks is accepted.
        Ok(()) | Err(TryLockError::Error(_)) => {}
        Err(TryLockError::WouldBlock) => {
            return Err(format!("{name}: another run saves its results there: name another file"));
        }
    }
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes).map_err(cannot)?;
    if bytes.is_empty() {
        // An empty file belongs to nobody, and under the lock nobody else can take it.
        bytes = head.line().map_err(cannot)?.into_bytes();
        file.write_all(&bytes).map_err(cannot)?;
    }
    let contents = read(&name, &String::from_utf8_lossy(&bytes))?;
    if let Some(other) = contents.head.difference(head) {
        return Err(format!("{name} holds results of {other}: name another file, or delete this one"));
    }
    if contents.length < bytes.len() {
        file.set_len(contents.length as u64).map_err(cannot)?;
        file.seek(SeekFrom::End(0)).map_err(cannot)?;
    }
    Ok(Journal::of_known(contents.known).appending(file, contents.results))
}
