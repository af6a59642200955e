//! The program as the tests run it, the plans that come with it, and its output as text and JSON.

#[cfg(unix)]
pub mod pseudo_terminal;
pub mod scenes;
pub mod stage;

use std::path::PathBuf;
use std::process::{Command, Output};

use serde_json::Value;

/// Path of the program.
pub const PROGRAM: &str = env!("CARGO_BIN_EXE_shelter");

/// Output of the program, run to its end; it takes 2007-09-17 for today.
pub fn shelter(arguments: &[&str]) -> Output {
    let mut command = Command::new(PROGRAM);
    command.args(arguments).env("SOURCE_DATE_EPOCH", "1190000000").output().expect("it runs")
}

/// Path of a shipped plan.
pub fn shipped(name: &str) -> String {
    format!("{}/plans/{name}", env!("CARGO_MANIFEST_DIR"))
}

/// Paths of all shipped plans.
pub fn shipped_plans() -> Vec<PathBuf> {
    let paths =
        std::fs::read_dir(shipped("")).expect("the folder").map(|entry| entry.expect("an entry").path());
    paths.filter(|path| path.extension().is_some_and(|ending| ending == "toml")).collect()
}

/// Output as text.
pub fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).expect("UTF-8")
}

/// Standard output as one JSON document.
pub fn json(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).expect("one JSON document")
}

/// Text in which a test changes something, such as a plan.
pub trait Edited {
    /// The text with `new` for `old`, which must be there: an edit that changes nothing would test nothing.
    fn edited(&self, old: &str, new: &str) -> String;
}

impl Edited for str {
    fn edited(&self, old: &str, new: &str) -> String {
        assert!(self.contains(old), "nothing to edit: '{old}' is not in the text");
        self.replace(old, new)
    }
}

/// The plan of three blast rows over a shelter of 3 × 3 tires instead of 5 × 10: its options, a fifth of its computing time.
pub fn small_plan() -> String {
    let text = include_str!("../../../plans/amur-three-rows.toml");
    text.edited("rows = 5 ", "rows = 3 ").edited("columns = 10 ", "columns = 3 ")
}
