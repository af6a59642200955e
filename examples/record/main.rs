//! Records the program as a person uses it: `cargo run --release --example record`.
//!
//! The program runs on a pseudo-terminal of 100 x 30 cells and gets the keys of [`SCRIPT`], once on a dark ground and once on a light
//! one. `walk.cast` holds all that it wrote on the dark one, for `asciinema play examples/record/walk.cast`. A picture of the screen at each
//! step named is written into `docs/pictures`, one for each ground, as the README and the book show them.

mod picture;

use std::error::Error;
use std::fmt::Write as _;
use std::fs;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use portable_pty::{CommandBuilder, PtySize, native_pty_system};

use picture::Ground;

/// Size of the terminal [cells].
const SIZE: (u16, u16) = (100, 30);
/// Longest wait for a text on the screen.
const PATIENCE: Duration = Duration::from_secs(600);
/// How long each screen stands before the next key.
const LOOK: Duration = Duration::from_millis(1500);

/// Keys, the text for which the recording then waits, and the name of a picture of that screen.
const SCRIPT: [(&str, &str, Option<&str>); 7] = [
    ("", "holds    until ", Some("compare")),
    ("kkw", "select one:", None),
    ("j", "makes the selected change", Some("remedies")),
    ("wjj3", "109 ms ✓ PASS* · drawn: 1 in 100", None),
    (" ", "playing", Some("flight")),
    ("4\r", "✓ ", None),
    ("\r", "recommended", Some("sweep")),
];

/// What the program writes, seen on a screen and kept with its time.
struct Recording {
    screen: vt100::Parser,
    output: Receiver<Vec<u8>>,
    begun: Instant,
    cast: String,
}

impl Recording {
    /// Takes what the program writes for a while; ends early where the screen shows `until`.
    fn watch(&mut self, longest: Duration, until: Option<&str>) -> Result<bool, Box<dyn Error>> {
        let begun = Instant::now();
        while begun.elapsed() < longest {
            match self.output.recv_timeout(Duration::from_millis(20)) {
                Ok(bytes) => {
                    self.screen.process(&bytes);
                    let event = (self.begun.elapsed().as_secs_f64(), "o", String::from_utf8_lossy(&bytes));
                    writeln!(self.cast, "{}", serde_json::to_string(&event)?)?;
                }
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return Ok(false),
            }
            if until.is_some_and(|text| self.screen.screen().contents().contains(text)) {
                return Ok(true);
            }
        }
        Ok(until.is_none())
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let cast = record(Ground::Dark)?;
    record(Ground::Light)?;
    fs::write(folder("examples/record").join("walk.cast"), cast)?;
    Ok(())
}

/// A folder of the sources.
fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// Writes the pictures of a ground; returns all that the program wrote, as a cast.
fn record(ground: Ground) -> Result<String, Box<dyn Error>> {
    let (cols, rows) = SIZE;
    let terminal = native_pty_system().openpty(PtySize { rows, cols, pixel_width: 0, pixel_height: 0 })?;
    // The example lies beside the program: target/release/examples.
    let program =
        std::env::current_exe()?.parent().and_then(Path::parent).ok_or("no folder")?.join("shelter");
    let configuration = tempfile::tempdir()?;
    fs::create_dir(configuration.path().join("shelter"))?;
    let theme = format!("theme = \"{}\"\n", ground.name());
    fs::write(configuration.path().join("shelter/config.toml"), theme)?;
    let mut command = CommandBuilder::new(program);
    command.args(["plans/amur-three-rows.toml", "--accuracy", "draft"]);
    command.cwd(env!("CARGO_MANIFEST_DIR"));
    command.env("TERM", "xterm-256color");
    command.env("COLORTERM", "truecolor");
    command.env("XDG_CONFIG_HOME", configuration.path());
    let mut child = terminal.slave.spawn_command(command)?;
    let mut written = terminal.master.try_clone_reader()?;
    let mut keyboard = terminal.master.take_writer()?;
    let (send, output) = channel();
    thread::spawn(move || {
        let mut bytes = [0; 65536];
        while let Ok(count @ 1..) = written.read(&mut bytes) {
            if send.send(bytes[..count].to_vec()).is_err() {
                return;
            }
        }
    });
    let head = serde_json::json!({ "version": 2, "width": cols, "height": rows, "title": "shelter" });
    let (screen, begun) = (vt100::Parser::new(rows, cols, 0), Instant::now());
    let mut recording = Recording { screen, output, begun, cast: format!("{head}\n") };
    for (keys, text, picture) in SCRIPT {
        for key in keys.chars() {
            keyboard.write_all(key.to_string().as_bytes())?;
            recording.watch(LOOK / 4, None)?;
        }
        if !recording.watch(PATIENCE, Some(text))? {
            return Err(format!("{text:?} is not on the screen").into());
        }
        recording.watch(LOOK, None)?;
        if let Some(name) = picture {
            let file = format!("{name}-{}.svg", ground.name());
            fs::write(folder("docs/pictures").join(file), picture::svg(recording.screen.screen(), ground))?;
        }
    }
    keyboard.write_all(b"q")?;
    child.wait()?;
    Ok(recording.cast)
}
