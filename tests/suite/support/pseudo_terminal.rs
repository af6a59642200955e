//! The real program on a pseudo-terminal, watched.

use std::io::{Read, Write};
use std::path::Path;
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::Duration;

use portable_pty::{Child, CommandBuilder, MasterPty, PtySize, native_pty_system};

use super::{PROGRAM, SHORT_PATIENCE, tested_plan, wait};

/// A shelter running in a terminal that is watched.
pub struct RunningShelter {
    pub screen: Arc<Mutex<vt100::Parser>>,
    pub keyboard: Box<dyn Write + Send>,
    pub master: Box<dyn MasterPty + Send>,
    pub child: Box<dyn Child + Send + Sync>,
    /// Where the user's configuration would be.
    pub home: Arc<tempfile::TempDir>,
}

/// Longest wait for a screen: options are judged on it.
const PATIENCE: Duration = Duration::from_secs(120);

impl RunningShelter {
    pub fn open(plan: &str, arguments: &[&str], columns: u16, rows: u16) -> Self {
        let plan = if Path::new(plan).is_absolute() { plan.to_owned() } else { tested_plan(plan) };
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
        let is_there = || self.contents().contains(what).then_some(());
        wait(PATIENCE, is_there, || format!("no {what:?} on the screen:\n{}", self.contents()));
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
        let screen = Arc::clone(&self.screen);
        let contents = || screen.lock().expect("the parser lives").screen().contents();
        let status = wait(
            PATIENCE,
            || self.child.try_wait().expect("a child"),
            || format!("still running:\n{}", contents()),
        );
        // What it wrote last may still be on its way.
        let restored = || {
            let parser = self.screen.lock().expect("the parser lives");
            let screen = parser.screen();
            let mouse = screen.mouse_protocol_mode() != vt100::MouseProtocolMode::None;
            let as_before =
                !screen.alternate_screen() && !screen.hide_cursor() && !mouse && !screen.bracketed_paste();
            as_before.then_some(())
        };
        wait(SHORT_PATIENCE, restored, || {
            let claim = "the alternate screen, the mouse and pasting are left, and the cursor is back";
            format!("not so: {claim}:\n{}", contents())
        });
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

    /// Ends the program as a loss of power does: at once, without a word.
    pub fn kill(mut self) {
        self.signal("KILL");
        wait(SHORT_PATIENCE, || self.child.try_wait().expect("a child"), || "it lives".to_owned());
    }
}

/// No test leaves a program behind, whatever it found.
impl Drop for RunningShelter {
    fn drop(&mut self) {
        if self.child.try_wait().is_ok_and(|status| status.is_none()) {
            let _ = self.child.kill();
        }
    }
}
