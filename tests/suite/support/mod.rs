//! The program as the tests run it, the plans that come with it, and its output as text and JSON.

pub mod json_schema;
#[cfg(unix)]
pub mod pseudo_terminal;
pub mod scenes;
pub mod stage;

use std::io::Read;
use std::path::PathBuf;
use std::process::{Child, Command, Output, Stdio};
use std::sync::mpsc;
use std::thread;
use std::time::{Duration, Instant};

use serde_json::Value;

/// Keys of `[uncertainty]` with which a shelter is laid, and a shot is fired, exactly as drawn.
pub const AS_DRAWN: &str = "launch_row_cv_percent = 0\nlaunch_tilt_deg = 0\nlaunch_tilt_common_deg = 0\n\
                            hole_position_m = 0\npattern_offset_m = 0\nhole_fails_percent = 0\n\
                            cable_length_m = 0\n";

/// Path of the program.
pub const PROGRAM: &str = env!("CARGO_BIN_EXE_shelter");

/// Longest wait for what computes. Generous: machines under load are slow, and nothing here measures speed.
pub const PATIENCE: Duration = Duration::from_secs(300);
/// Longest wait for what computes nothing.
pub const SHORT_PATIENCE: Duration = Duration::from_secs(30);

/// Waits until `look` finds something; panics with what `seen` tells where it does not within `patience`.
pub fn wait<T>(patience: Duration, mut look: impl FnMut() -> Option<T>, seen: impl FnOnce() -> String) -> T {
    let begun = Instant::now();
    loop {
        if let Some(found) = look() {
            return found;
        }
        assert!(begun.elapsed() < patience, "waited for {patience:?}: {}", seen());
        thread::sleep(Duration::from_millis(5));
    }
}

/// Result of `work`, which may block; panics where it does for longer than [`SHORT_PATIENCE`].
pub fn within<T: Send + 'static>(what: &str, work: impl FnOnce() -> T + Send + 'static) -> T {
    let (sender, receiver) = mpsc::channel();
    thread::spawn(move || sender.send(work()));
    receiver.recv_timeout(SHORT_PATIENCE).unwrap_or_else(|_| panic!("{what} does not come to an end"))
}

/// Output of a child that ends within [`PATIENCE`]; kills one that does not, and panics with what it said.
pub fn ended(child: Child) -> Output {
    ended_within(PATIENCE, child)
}

fn ended_within(patience: Duration, mut child: Child) -> Output {
    drop(child.stdin.take());
    let read = |pipe: Option<Box<dyn Read + Send>>| {
        thread::spawn(move || {
            let mut bytes = Vec::new();
            pipe.map(|mut pipe| pipe.read_to_end(&mut bytes));
            bytes
        })
    };
    let stdout = read(child.stdout.take().map(|pipe| Box::new(pipe) as _));
    let stderr = read(child.stderr.take().map(|pipe| Box::new(pipe) as _));
    let begun = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().expect("a child") {
            break Some(status);
        }
        if begun.elapsed() > patience {
            let _ = child.kill();
            let _ = child.wait();
            break None;
        }
        thread::sleep(Duration::from_millis(2));
    };
    let [stdout, stderr] = [stdout, stderr].map(|reader| reader.join().expect("read"));
    let told = || [&stdout[..], &stderr[..]].map(String::from_utf8_lossy).concat();
    let status = status.unwrap_or_else(|| panic!("still running after {patience:?}: {}", told()));
    Output { status, stdout, stderr }
}

/// Output of a command that is run to its end.
pub fn output(command: &mut Command) -> Output {
    ended(
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("it runs"),
    )
}

/// Output of the program, run to its end; it takes 2007-09-17 for today.
pub fn shelter(arguments: &[&str]) -> Output {
    output(Command::new(PROGRAM).args(arguments).env("SOURCE_DATE_EPOCH", "1190000000"))
}

/// Path of a shipped plan.
pub fn shipped(name: &str) -> String {
    format!("{}/plans/{name}", env!("CARGO_MANIFEST_DIR"))
}

/// Path of the plan of this name that tests use: a fixture, whose numbers never change, or the shipped plan.
pub fn tested_plan(name: &str) -> String {
    let fixture = format!("{}/tests/fixtures/{name}", env!("CARGO_MANIFEST_DIR"));
    if std::path::Path::new(&fixture).exists() { fixture } else { shipped(name) }
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
    let text = include_str!("../../fixtures/amur-three-rows.toml");
    text.edited("rows = 5 ", "rows = 3 ").edited("columns = 10 ", "columns = 3 ")
}

/// [`small_plan`] with the options of these names and the last one, behind which the rest of the plan stands.
pub fn small_plan_of(options: &[&str]) -> String {
    let text = small_plan();
    let mut parts: Vec<&str> = text.split("[[delay]]").collect();
    let (head, rest) = (parts.remove(0), parts.pop().expect("an option"));
    let is_wanted = |part: &&str| options.iter().any(|name| part.contains(&format!("name = \"{name}\"")));
    let wanted: Vec<&str> = parts.into_iter().filter(is_wanted).collect();
    assert_eq!(wanted.len(), options.len(), "{options:?}");
    [&[head], &wanted[..], &[rest]].concat().join("[[delay]]")
}

/// [`small_plan`] as `plan.toml` in a folder: its path.
pub fn small_plan_in(folder: &std::path::Path) -> String {
    let file = folder.join("plan.toml");
    std::fs::write(&file, small_plan()).expect("written");
    file.to_str().expect("UTF-8").to_owned()
}

/// A child that never ends is killed, and what it said is told.
#[cfg(unix)]
#[test]
#[should_panic(expected = "still running after 300ms: it waits")]
fn a_child_that_never_ends_fails_its_test() {
    let mut command = Command::new("sh");
    command.args(["-c", "echo it waits; exec sleep 1000"]).stdout(Stdio::piped());
    ended_within(Duration::from_millis(300), command.spawn().expect("it runs"));
}

#[test]
#[should_panic(expected = "waited for 20ms: a blank screen")]
fn a_wait_in_vain_fails_its_test() {
    wait(Duration::from_millis(20), || None::<()>, || "a blank screen".to_owned());
}
