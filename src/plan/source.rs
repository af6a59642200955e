//! The file that a plan, or a list of holes, was read from: its path and its text.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use super::{Diagnostics, Plan, sections, visible};
use crate::file;

/// Largest file that is read [bytes]. Reading a text takes up to fifty times as much memory.
const MOST_BYTES: u64 = 8 << 20;

/// The path and the text of a plan or of a list of holes. Both are empty if the program made the plan.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PlanSource {
    /// The file as the user named it; `-` is standard input.
    pub path: PathBuf,
    /// The text as written.
    pub text: String,
}

impl PlanSource {
    /// Reads a file; `-` is standard input.
    pub fn read(path: &Path) -> Result<Self, Diagnostics> {
        match read_bytes(path).and_then(text_of) {
            Ok(text) => Ok(Self { path: path.to_owned(), text }),
            Err((message, remedy)) => Err(Diagnostics::unreadable(&shown(path), message, remedy)),
        }
    }

    /// The name of the file, for display. If the path is not UTF-8, this name does not lead back to the file.
    pub fn name(&self) -> String {
        shown(&self.path)
    }

    /// The values of the plan, or every mistake in its text.
    pub fn plan(&self) -> Result<Plan, Diagnostics> {
        sections::parse(&self.name(), &self.text)
    }
}

fn shown(path: &Path) -> String {
    visible(&path.display().to_string()).into_owned()
}

/// A message with its remedy.
pub(super) type Unreadable = (String, &'static str);

/// The bytes of a file; `-` is standard input.
pub(super) fn read_bytes(path: &Path) -> Result<Vec<u8>, Unreadable> {
    let cannot = |error: std::io::Error| {
        let error = file::unreadable(path, error);
        let remedy = match error.kind() {
            std::io::ErrorKind::NotFound => {
                "check the path, or write a starter plan with `shelter init FILE`"
            }
            std::io::ErrorKind::IsADirectory => "name a plan file inside it",
            _ => "check the path and its permissions",
        };
        (format!("cannot read the file: {error}"), remedy)
    };
    let mut bytes = Vec::new();
    let read = if path.as_os_str() == "-" {
        std::io::stdin().lock().take(MOST_BYTES + 1).read_to_end(&mut bytes)
    } else {
        File::open(path).and_then(|file| file.take(MOST_BYTES + 1).read_to_end(&mut bytes))
    };
    read.map_err(cannot)?;
    if bytes.len() as u64 > MOST_BYTES {
        return Err((
            format!("the file is larger than {} MB", MOST_BYTES >> 20),
            "a plan, or a list, is a short text: check the path",
        ));
    }
    Ok(bytes)
}

/// The bytes as UTF-8 text.
pub(super) fn text_of(bytes: Vec<u8>) -> Result<String, Unreadable> {
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) || bytes.contains(&0) {
        return Err((
            "the file is UTF-16 text, or no text".to_owned(),
            "save it as UTF-8, for example with: iconv -f UTF-16 -t UTF-8 OLD > NEW (without a mark at its start: -f UTF-16LE)",
        ));
    }
    String::from_utf8(bytes).map_err(|error| {
        (
            format!("the file is not UTF-8 text from byte {} on", error.utf8_error().valid_up_to()),
            "save it as UTF-8, for example with: iconv -f WINDOWS-1251 -t UTF-8 OLD > NEW (Western Europe: -f WINDOWS-1252)",
        )
    })
}
