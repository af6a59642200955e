//! Running a study: on the threads asked for, with a progress bar, ended by a signal or by the time given.

use std::io::{self, IsTerminal};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::RecvTimeoutError;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use super::arguments::Compute;
use crate::study::{Finding, NoResult, Progress, thread_pool};

/// Time between two looks at progress and signals.
const LOOK: Duration = Duration::from_millis(50);

/// A study that will take longer is announced.
const LONG: Duration = Duration::from_secs(60);
/// Time that a study runs before its duration is estimated.
const WATCHED: Duration = Duration::from_secs(1);

/// Runs `work`. Progress and the estimate of its duration show only where standard error is a terminal.
pub fn run_study<T: Send>(
    compute: &Compute,
    work: impl FnOnce(&Progress) -> Finding<T> + Send,
) -> Finding<T> {
    let (progress, signal) = (Progress::default(), Arc::new(AtomicBool::new(false)));
    #[cfg(unix)]
    for number in [signal_hook::consts::SIGINT, signal_hook::consts::SIGTERM, signal_hook::consts::SIGHUP] {
        // Without a handler the signal ends the program at once, which is as good.
        let _ = signal_hook::flag::register(number, Arc::clone(&signal));
    }
    let template = "{bar:30} {pos} of {len} shots, {eta} left";
    let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
    let bar = ProgressBar::new(0).with_style(style);
    let (begun, mut told) = (Instant::now(), !io::stderr().is_terminal());
    let result = std::thread::scope(|scope| {
        let (ended, end) = std::sync::mpsc::channel::<()>();
        let study = scope.spawn(|| {
            // Gone with this thread, whether it returns or panics.
            let _ended = ended;
            on_threads(compute, || work(&progress))?
        });
        while end.recv_timeout(LOOK) == Err(RecvTimeoutError::Timeout) {
            let (done, total) = progress.counts();
            bar.set_length(total as u64);
            bar.set_position(done as u64);
            if signal.load(Ordering::Relaxed) {
                progress.stop();
            }
            if compute.timeout.is_some_and(|timeout| begun.elapsed().as_secs_f64() > timeout) {
                progress.expire();
            }
            let expected = begun.elapsed().mul_f64(total as f64 / done.max(1) as f64);
            if !told && done > 0 && begun.elapsed() > WATCHED && expected > LONG {
                told = true;
                let minutes = (expected.as_secs_f64() / 60.0).ceil();
                bar.suspend(|| {
                    eprintln!("about {minutes} min; --timeout SECONDS ends it with what is computed by then");
                });
            }
        }
        study.join()
    });
    bar.finish_and_clear();
    let found = result.unwrap_or_else(|panic| std::panic::resume_unwind(panic))?;
    if found.partial {
        let (done, total) = progress.counts();
        eprintln!("the time was up after {done} of {total} shots; what follows is partial");
    }
    Ok(found)
}

/// Runs `work` on the threads asked for.
fn on_threads<T: Send>(compute: &Compute, work: impl FnOnce() -> T + Send) -> Result<T, NoResult> {
    Ok(thread_pool(compute.threads.unwrap_or(0).into())?.install(work))
}
