//! Results of pieces of work by their fingerprints: the results that an earlier run of the same study saved, and new results.
//!
//! A study is always computed from its beginning, and takes from the journal what is there. So its result depends neither on where
//! it was stopped, nor on which machine computed a piece.

use std::collections::HashMap;
use std::fmt::{self, Debug, Write as _};
use std::fs::File;
use std::io::{self, Write};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use serde::Serialize;
use serde::de::DeserializeOwned;
use sha2::{Digest, Sha256};

use super::NoResult;

/// Identity of a piece of work: a digest of everything that its result depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Fingerprint(u128);

impl Fingerprint {
    /// The fingerprint of a piece of work that depends on `inputs`. `Debug` writes every digit of a number.
    pub fn of(inputs: impl Debug) -> Self {
        let mut digest = DigestOfText(Sha256::new());
        // A digest takes any text.
        let _ = write!(digest, "{inputs:?}");
        let mut first = [0; 16];
        first.copy_from_slice(&digest.0.finalize()[..16]);
        Self(u128::from_be_bytes(first))
    }

    fn parse(text: &str) -> Option<Self> {
        (text.len() == 32).then(|| u128::from_str_radix(text, 16).ok().map(Self)).flatten()
    }
}

struct DigestOfText(Sha256);

impl fmt::Write for DigestOfText {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.update(text);
        Ok(())
    }
}

/// Results known before, and the file that takes new results. The default journal has neither.
#[derive(Debug, Default)]
pub struct Journal {
    known: HashMap<Fingerprint, Box<str>>,
    file: Option<Mutex<Appender>>,
    recalled: AtomicUsize,
}

/// The open end of a results file.
#[derive(Debug)]
struct Appender {
    file: File,
    /// Number of result lines in the file.
    results: usize,
    synced: Instant,
    /// The first error. After it nothing more is written, because the last line may be torn.
    failed: Option<io::Error>,
}

/// Time after which results are written through to the disk, in case of a power loss.
const SYNC_EVERY: Duration = Duration::from_secs(5);

impl Journal {
    /// A journal that knows these results and keeps no new ones.
    pub fn of_known(known: HashMap<Fingerprint, Box<str>>) -> Self {
        Self { known, ..Self::default() }
    }

    /// The journal that continues a file with `results` lines of results.
    pub fn appending(self, file: File, results: usize) -> Self {
        let appender = Appender { file, results, synced: Instant::now(), failed: None };
        Self { file: Some(Mutex::new(appender)), ..self }
    }

    /// Whether the journal has results, or keeps new ones.
    pub fn is_on(&self) -> bool {
        self.file.is_some() || !self.known.is_empty()
    }

    /// Number of recalled results.
    pub fn recalled(&self) -> usize {
        self.recalled.load(Ordering::Relaxed)
    }

    /// The result of a piece of work: recalled, or computed and kept.
    pub fn recall_or<T: Serialize + DeserializeOwned + PartialEq>(
        &self,
        fingerprint: impl FnOnce() -> Fingerprint,
        work: impl FnOnce() -> Result<T, NoResult>,
    ) -> Result<T, NoResult> {
        if !self.is_on() {
            return work();
        }
        let fingerprint = fingerprint();
        if let Some(result) = self.known.get(&fingerprint).and_then(|text| serde_json::from_str(text).ok()) {
            self.recalled.fetch_add(1, Ordering::Relaxed);
            return Ok(result);
        }
        let result = work()?;
        self.keep(fingerprint, &result);
        Ok(result)
    }

    /// Appends a result. A result that would not be read back as it was written is left out, and computed anew later.
    fn keep<T: Serialize + DeserializeOwned + PartialEq>(&self, fingerprint: Fingerprint, result: &T) {
        let Some(file) = &self.file else { return };
        let Ok(text) = serde_json::to_string(result) else { return };
        if serde_json::from_str::<T>(&text).is_ok_and(|read| read == *result) {
            let line = sealed(&format!("{{\"{KEY}\":\"{:032x}\",\"{RESULT}\":{text}", fingerprint.0));
            file.lock().unwrap_or_else(PoisonError::into_inner).append(&line, 1);
        }
    }

    /// Marks the file as complete: it holds everything that the study computed.
    pub fn complete(&self) {
        let Some(file) = &self.file else { return };
        let mut file = file.lock().unwrap_or_else(PoisonError::into_inner);
        let line = sealed(&format!("{{\"{COMPLETE}\":{}", file.results));
        file.append(&line, 0);
    }

    /// Writes the kept results through to the disk. Returns an error if not all of them were written.
    pub fn close(self) -> io::Result<()> {
        let Some(file) = self.file else { return Ok(()) };
        let Appender { file, failed, .. } = file.into_inner().unwrap_or_else(PoisonError::into_inner);
        failed.map_or_else(|| file.sync_data(), Err)
    }
}

impl Appender {
    fn append(&mut self, line: &str, results: usize) {
        if self.failed.is_some() {
            return;
        }
        // A line is written in one piece, so that a killed program tears the last line at most.
        let written = self.file.write_all(line.as_bytes()).and_then(|()| {
            self.results += results;
            if self.synced.elapsed() < SYNC_EVERY {
                return Ok(());
            }
            self.synced = Instant::now();
            self.file.sync_data()
        });
        self.failed = written.err();
    }
}

/// Names of the parts of a line.
const KEY: &str = "key";
const RESULT: &str = "result";
const COMPLETE: &str = "complete";
const CHECK: &str = ",\"check\":\"";

/// Digits of the checksum of a line.
const CHECK_DIGITS: usize = 16;

fn check_digits(body: &str) -> String {
    let mut digits = crate::file::checksum(body);
    digits.truncate(CHECK_DIGITS);
    digits
}

/// A line of a results file: a JSON object without its closing brace, sealed with the checksum of the text before.
pub(in crate::study) fn sealed(body: &str) -> String {
    format!("{body}{CHECK}{}\"}}\n", check_digits(body))
}

/// The body of a sealed line; `None` if the line was changed.
pub(in crate::study) fn unsealed(line: &str) -> Option<&str> {
    let (body, check) = line.rsplit_once(CHECK)?;
    (check.strip_suffix("\"}")? == check_digits(body)).then_some(body)
}

/// A line after the first.
pub(in crate::study) enum Line<'t> {
    /// A result, as JSON.
    Result(Fingerprint, &'t str),
    /// The study was computed to its end, with so many results before this line.
    Complete(usize),
}

/// The content of the body of a line; `None` if it is no such line.
pub(in crate::study) fn read_body(body: &str) -> Option<Line<'_>> {
    if let Some(count) = body.strip_prefix(&format!("{{\"{COMPLETE}\":")) {
        return count.parse().ok().map(Line::Complete);
    }
    let (key, rest) = body.strip_prefix(&format!("{{\"{KEY}\":\""))?.split_at_checked(32)?;
    Some(Line::Result(Fingerprint::parse(key)?, rest.strip_prefix(&format!("\",\"{RESULT}\":"))?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_result_is_computed_once_and_read_as_it_was_written() {
        let mut file = tempfile::tempfile().expect("a file");
        let journal = Journal::default().appending(file.try_clone().expect("the file"), 0);
        for value in [0.1, 1e-300, f64::NAN] {
            assert!(journal.recall_or(|| Fingerprint::of(value), || Ok(value)).is_ok());
        }
        assert_eq!(
            journal.recall_or(|| Fingerprint::of("stopped"), || Err::<f64, _>(NoResult::Stopped)),
            Err(NoResult::Stopped)
        );
        journal.complete();
        journal.close().expect("written");
        let mut text = String::new();
        io::Seek::rewind(&mut file)
            .and_then(|()| io::Read::read_to_string(&mut file, &mut text))
            .expect("read");
        let known: HashMap<Fingerprint, Box<str>> = text
            .lines()
            .filter_map(|line| match read_body(unsealed(line)?)? {
                Line::Result(key, result) => Some((key, result.into())),
                Line::Complete(_) => None,
            })
            .collect();
        let last = text.lines().last().and_then(unsealed).and_then(read_body);
        assert!(matches!(last, Some(Line::Complete(2))), "{text}");
        assert_eq!(known.len(), 2, "what is no number is computed anew: {text}");
        let journal = Journal::of_known(known);
        for value in [0.1, 1e-300] {
            let recalled =
                journal.recall_or(|| Fingerprint::of(value), || -> Result<f64, _> { panic!("it is known") });
            assert_eq!(recalled, Ok(value));
        }
        assert_eq!(journal.recalled(), 2);
    }

    /// If the file does not take a result, closing the journal reports it.
    #[test]
    fn what_was_not_written_is_told() {
        let file = tempfile::NamedTempFile::new().expect("a file");
        let only_read = File::open(file.path()).expect("the file");
        let journal = Journal::default().appending(only_read, 0);
        assert_eq!(journal.recall_or(|| Fingerprint::of(1), || Ok(1)), Ok(1));
        assert!(journal.close().is_err());
    }

    #[test]
    fn a_line_with_any_character_changed_is_not_as_it_was_written() {
        let line = sealed("{\"key\":\"0123456789abcdef0123456789abcdef\",\"result\":[1.5,\"fail\"]");
        let line = line.trim_end();
        assert!(unsealed(line).and_then(read_body).is_some());
        assert!(serde_json::from_str::<serde_json::Value>(line).is_ok(), "a line is JSON");
        for at in 0..line.len() {
            let other = if line.as_bytes()[at] == b'1' { "2" } else { "1" };
            let changed = format!("{}{other}{}", &line[..at], &line[at + 1..]);
            assert!(unsealed(&changed).is_none(), "{changed}");
            assert!(unsealed(&line[..at]).is_none());
        }
    }
}
