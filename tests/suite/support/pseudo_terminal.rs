//! The real program on a pseudo-terminal, watched.

use std::io::{Read, Write};
use std::path::Path;
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

use portable_pty::{Child, CommandBuilder, MasterPty, PtySize, native_pty_system};

use super::{PROGRAM, shipped};

/// A shelter running in a terminal that is watched.
pub struct RunningShelter {
    pub screen: Arc<Mutex<vt100::Parser>>,
    pub keyboard: Box<dyn Write + Send>,
    pub master: Box<dyn MasterPty + Send>,
    pub child: Box<dyn Child + Send + Sync>,
    /// Where the user's configuration would be.
    pub home: Arc<tempfile::TempDir>,
}

/// Generous: machines under load are slow, and nothing here measures speed.
pub const PATIENCE: Duration = Duration::from_secs(300);

impl RunningShelter {
    pub fn open(plan: &str, arguments: &[&str], columns: u16, rows: u16) -> Self {
        let plan = if Path::new(plan).is_absolute() { plan.to_owned() } else { shipped(plan) };
        let all = [&[plan.as_str()], arguments].concat();
        Self::start(&all, Path::new(env!("CARGO_MANIFEST_DIR")), columns, rows)
    }

    pub fn start(arguments: &[&str], folder: &Path, columns: u16, rows: u16) -> Self {
        let home = Arc::new(tempfile::tempdir().expect("a folder"));
        Self::start_at_home(arguments, folder, columns, rows, home)
    }

    pub fn start_at_home(
        arguments: &[&str],
        folder: &Path,
        columns: u16,
        rows: u16,
        home: Arc<tempfile::TempDir>,
    ) -> Self {
        let size = PtySize { rows, cols: columns, pixel_width: 0, pixel_height: 0 };
        let pair = native_pty_system().openpty(size).expect("a pty");
        let mut command = CommandBuilder::new(PROGRAM);
        command.args(arguments);
        command.cwd(folder);
        command.env("TERM", "xterm-256color");
        command.env("LC_ALL", "C.UTF-8");
        for place in ["XDG_CONFIG_HOME", "XDG_STATE_HOME", "HOME"] {
            command.env(place, home.path());
        }
        let child = pair.slave.spawn_command(command).expect("it starts");
        let screen = Arc::new(Mutex::new(vt100::Parser::new(rows, columns, 0)));
        let mut output = pair.master.try_clone_reader().expect("a reader");
        let seen = Arc::clone(&screen);
        thread::spawn(move || {
            let mut bytes = [0; 4096];
            while let Ok(count @ 1..) = output.read(&mut bytes) {
                seen.lock().expect("the parser lives").process(&bytes[..count]);
            }
        });
        let keyboard = pair.master.take_writer().expect("a writer");
        Self { screen, keyboard, master: pair.master, child, home }
    }

    pub fn contents(&self) -> String {
        self.screen.lock().expect("the parser lives").screen().contents()
    }

    pub fn until(&self, what: &str) {
        let start = Instant::now();
        while !self.contents().contains(what) {
            assert!(start.elapsed() < PATIENCE, "no {what:?} on the screen:\n{}", self.contents());
            thread::sleep(Duration::from_millis(10));
        }
    }

    pub fn press(&mut self, keys: &str) {
        self.keyboard.write_all(keys.as_bytes()).expect("typed");
    }

    pub fn resize(&mut self, columns: u16, rows: u16) {
        let size = PtySize { rows, cols: columns, pixel_width: 0, pixel_height: 0 };
        self.screen.lock().expect("the parser lives").screen_mut().set_size(rows, columns);
        self.master.resize(size).expect("resized");
    }

    /// Waits for the end; the terminal must be as it was.
    pub fn ends(mut self) -> u32 {
        let start = Instant::now();
        let status = loop {
            if let Some(status) = self.child.try_wait().expect("a child") {
                break status;
            }
            assert!(start.elapsed() < PATIENCE, "still running:\n{}", self.contents());
            thread::sleep(Duration::from_millis(10));
        };
        // What it wrote last may still be on its way.
        let restored = || {
            let parser = self.screen.lock().expect("the parser lives");
            let screen = parser.screen();
            let mouse = screen.mouse_protocol_mode() != vt100::MouseProtocolMode::None;
            !screen.alternate_screen() && !screen.hide_cursor() && !mouse && !screen.bracketed_paste()
        };
        while !restored() {
            assert!(
                start.elapsed() < PATIENCE,
                "the alternate screen, the mouse and pasting are left, and the cursor is back"
            );
            thread::sleep(Duration::from_millis(10));
        }
        // Lines and echo, the second and fourth flag of a terminal, are on again.
        let flags = self.master.get_termios().expect("flags").local_flags.bits();
        assert_eq!(flags & 0b1010, 0b1010, "raw mode is left");
        status.exit_code()
    }

    pub fn signal(&self, name: &str) {
        let id = self.child.process_id().expect("a process").to_string();
        let status = std::process::Command::new("kill").args(["-s", name, &id]).status().expect("kill runs");
        assert!(status.success());
    }
}
