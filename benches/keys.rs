//! How long a person waits for a key: from the key to the screen that shows what it did, while ten options of a 50×50
//! shelter compute in the background; and what the program costs while nothing happens. `cargo bench --bench keys`, of fewer keys
//! `cargo bench --bench keys -- 20`.

#[cfg(unix)]
fn main() {
    unix::main();
}

#[cfg(not(unix))]
fn main() {
    println!("needs a pseudo-terminal");
}

#[cfg(unix)]
mod unix {
    use std::io::{Read, Write};
    use std::sync::mpsc::{Receiver, channel};
    use std::thread;
    use std::time::{Duration, Instant};

    use portable_pty::{Child, CommandBuilder, MasterPty, PtySize, native_pty_system};

    /// Keys pressed, where no other number is given.
    const KEYS: usize = 400;
    const OPTIONS: usize = 10;

    struct Program {
        child: Box<dyn Child + Send + Sync>,
        keyboard: Box<dyn Write + Send>,
        /// When each piece of output had been taken in, and the name over the selected option then.
        output: Receiver<(Instant, String)>,
        _master: Box<dyn MasterPty + Send>,
    }

    fn open(arguments: &[&str]) -> Program {
        let size = PtySize { rows: 36, cols: 120, pixel_width: 0, pixel_height: 0 };
        let pair = native_pty_system().openpty(size).expect("a pty");
        let mut command = CommandBuilder::new(env!("CARGO_BIN_EXE_shelter"));
        command.args(arguments);
        command.cwd(env!("CARGO_MANIFEST_DIR"));
        command.env("XDG_STATE_HOME", std::env::temp_dir());
        let child = pair.slave.spawn_command(command).expect("it starts");
        let mut reader = pair.master.try_clone_reader().expect("a reader");
        let (sender, output) = channel();
        thread::spawn(move || {
            let mut bytes = [0; 1 << 16];
            let mut parser = vt100::Parser::new(size.rows, size.cols, 0);
            while let Ok(count @ 1..) = reader.read(&mut bytes) {
                parser.process(&bytes[..count]);
                let shown = parser.screen().contents();
                let selected =
                    shown.lines().find(|line| line.contains(" ───")).unwrap_or_default().to_owned();
                if sender.send((Instant::now(), selected)).is_err() {
                    return;
                }
            }
        });
        let keyboard = pair.master.take_writer().expect("a writer");
        Program { child, keyboard, output, _master: pair.master }
    }

    impl Program {
        fn quit(mut self) {
            self.child.kill().expect("killed");
            self.child.wait().expect("ended");
        }
    }

    pub fn main() {
        let keys = std::env::args().filter_map(|argument| argument.parse().ok()).next().unwrap_or(KEYS);
        // Steps so fine that the options compute all the while.
        let mut busy = open(&["plans/large-50x50.toml", "--dt", "2e-6"]);
        thread::sleep(Duration::from_secs(2));
        let names: Vec<String> = include_str!("../plans/large-50x50.toml")
            .lines()
            .skip_while(|line| *line != "[[delay]]")
            .filter_map(|line| Some(line.strip_prefix("name = \"")?.trim_end_matches('"').to_owned()))
            .collect();
        assert_eq!(names.len(), OPTIONS);
        let mut waits = Vec::new();
        for n in 0..keys {
            // Down the list and up again.
            let place = (n + 1) % (2 * OPTIONS - 2);
            let (key, option) = if place < OPTIONS { (b'j', place) } else { (b'k', 2 * OPTIONS - 2 - place) };
            let key = if place == 0 { b'k' } else { key };
            while busy.output.try_recv().is_ok() {}
            let pressed = Instant::now();
            busy.keyboard.write_all(&[key]).expect("typed");
            let wanted = format!(" {} ·", names[option]);
            let seen = busy.output.iter().find(|(_, selected)| selected.starts_with(&wanted));
            waits.push(seen.expect("it is selected").0.duration_since(pressed));
            thread::sleep(Duration::from_millis(23));
        }
        busy.quit();
        waits.sort();
        let at = |share: f64| waits[((waits.len() - 1) as f64 * share) as usize].as_secs_f64() * 1e3;
        println!(
            "key to repaint, {keys} keys, ten 50x50 options computing: median {:.2} ms, 95 % {:.2} ms, most {:.2} ms",
            at(0.5),
            at(0.95),
            at(1.0)
        );
        // A plan of which all is soon computed.
        let idle = open(&["plans/paper-5-tire.toml"]);
        thread::sleep(Duration::from_secs(20));
        let id = idle.child.process_id().expect("a process");
        if let Some(before) = busy_time(id) {
            let span = Duration::from_secs(10);
            thread::sleep(span);
            let used = busy_time(id).unwrap_or(before) - before;
            println!("idle: {:.2} % of a core", 100.0 * used / span.as_secs_f64());
        }
        idle.quit();
    }

    /// Processor time of a process so far [s], where the system tells: ticks are hundredths of a second.
    fn busy_time(id: u32) -> Option<f64> {
        let text = std::fs::read_to_string(format!("/proc/{id}/stat")).ok()?;
        let fields: Vec<&str> = text.rsplit_once(')')?.1.split_whitespace().collect();
        let ticks = |n: usize| fields.get(n)?.parse::<f64>().ok();
        Some((ticks(11)? + ticks(12)?) / 100.0)
    }
}
