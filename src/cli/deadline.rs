//! Ends the program at its `--timeout` while plans are read, because the reader looks at no clock. `--timeout` counts from the program's
//! start.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use super::status::Status;

/// The start of the program.
static BEGUN: OnceLock<Instant> = OnceLock::new();
/// Whether plans are still being read.
static IS_LOADING: AtomicBool = AtomicBool::new(true);

/// Ends the program at the timeout [s] if its plans are not read by then.
pub fn watch(timeout: Option<f64>) {
    BEGUN.get_or_init(Instant::now);
    let Some(timeout) = timeout.and_then(|timeout| Duration::try_from_secs_f64(timeout).ok()) else { return };
    thread::spawn(move || {
        thread::sleep(timeout);
        if IS_LOADING.load(Ordering::Relaxed) {
            end("the time was up before the plan was read");
        }
    });
}

/// Time since the program began.
pub fn elapsed() -> Duration {
    BEGUN.get_or_init(Instant::now).elapsed()
}

/// Notes that all plans are read. From here on, the work looks at the time itself.
pub fn note_loaded() {
    IS_LOADING.store(false, Ordering::Relaxed);
}

/// Ends the program at once, without a result. The program writes a file whole or not at all.
pub fn end(why: &str) -> ! {
    tell!("{why}");
    std::process::exit(Status::Fail as i32)
}
