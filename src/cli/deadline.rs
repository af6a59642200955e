//! `--timeout` from the start of the program: also while plans are read and built, which nothing else can end.

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

/// Takes note that plans are read: from here on what computes looks at the time by itself.
pub fn note_loaded() {
    IS_LOADING.store(false, Ordering::Relaxed);
}

/// Ends the program at once, without a result. What it writes is written whole or not at all.
pub fn end(why: &str) -> ! {
    tell!("{why}");
    std::process::exit(Status::Fail as i32)
}
