//! Runs a study on the requested threads, with a progress bar. A signal or the timeout ends it early.

use std::io::{self, IsTerminal};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::RecvTimeoutError;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use super::arguments::ComputeArguments;
use super::deadline;
use super::status::{note_interrupt, note_unsaved};
use crate::report::words::progress_words::describe;
use crate::study::{ComputeResult, Computed, Journal, NoResult, StudyControl, thread_pool};
use crate::units::rough_duration;

/// Time between two checks of progress and signals.
const LOOK: Duration = Duration::from_millis(50);

/// Expected duration above which the program announces a study.
const LONG: Duration = Duration::from_secs(60);
/// Time [s] after the timeout within which a study may end by itself; a share of the timeout is added to it.
const LATE: f64 = 2.0;
const LATE_SHARE: f64 = 0.1;
/// Number of parts of the progress bar.
const BAR_PARTS: u64 = 1000;

/// Runs `work`. The progress and the estimated duration appear only if standard error is a terminal.
pub fn run_study<T: Send>(
    compute: &ComputeArguments,
    work: impl FnOnce(&StudyControl) -> ComputeResult<T> + Send,
) -> ComputeResult<T> {
    run_saved_study(compute, Journal::default(), work)
}

/// Like [`run_study`], with a journal that keeps the results.
pub fn run_saved_study<T: Send>(
    compute: &ComputeArguments,
    journal: Journal,
    work: impl FnOnce(&StudyControl) -> ComputeResult<T> + Send,
) -> ComputeResult<T> {
    deadline::note_loaded();
    let (control, signal) = (StudyControl::with_journal(journal), Arc::new(AtomicBool::new(false)));
    // Once `may_end` is set, a signal ends the program at once. The first interrupt sets it, or the end of the study.
    let may_end = Arc::new(AtomicBool::new(false));
    watch_signals(&signal, &may_end);
    let template = "{bar:30} {msg}";
    let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
    let bar = ProgressBar::new(BAR_PARTS).with_style(style);
    let (begun, mut told, mut interrupted) = (Instant::now(), !io::stderr().is_terminal(), false);
    // Progress when the time was up. After that, work that is left out counts as done.
    let mut ended_at: Option<f64> = None;
    let result = std::thread::scope(|scope| {
        let (ended, end) = std::sync::mpsc::channel::<()>();
        let study = scope.spawn(|| {
            // This thread drops `_ended` at its end, also after a panic. Then the loop below ends.
            let _ended = ended;
            on_threads(compute, || work(&control))?
        });
        while end.recv_timeout(LOOK) == Err(RecvTimeoutError::Timeout) {
            let progress = control.progress();
            bar.set_position((progress.fraction * BAR_PARTS as f64) as u64);
            let left = progress.time_left(begun.elapsed(), control.computed_share());
            bar.set_message(describe(&progress, left));
            if signal.swap(false, Ordering::Relaxed) {
                ended_at.get_or_insert(progress.fraction);
                control.expire();
                may_end.store(true, Ordering::Relaxed);
                interrupted = true;
            }
            if let Some(timeout) = compute.timeout {
                let late = deadline::elapsed().as_secs_f64() - timeout;
                if late > 0.0 {
                    ended_at.get_or_insert(progress.fraction);
                    control.expire();
                }
                // Some work between two runs does not look at the time.
                if late > LATE + LATE_SHARE * timeout {
                    deadline::end("the time was up before there was a result");
                }
            }
            let Some(left) = left else { continue };
            if !told && begun.elapsed() + left > LONG {
                told = true;
                let expected = rough_duration(left.as_secs_f64());
                bar.suspend(|| {
                    tell!(
                        "about {expected}; Ctrl-C or --timeout SECONDS ends it with what is computed by then"
                    )
                });
            }
        }
        study.join()
    });
    bar.finish_and_clear();
    may_end.store(true, Ordering::Relaxed);
    let done = (1e2 * ended_at.unwrap_or(0.0)).floor().min(99.0);
    let found = result.unwrap_or_else(|panic| std::panic::resume_unwind(panic));
    close(control.into_journal(), found.as_ref().is_ok_and(|found| !found.partial));
    if interrupted {
        note_interrupt();
    }
    match &found {
        Ok(Computed { partial: true, .. }) => {
            let why = if interrupted { "interrupted" } else { "the time was up" };
            tell!("{why} with {done} % done; what follows is partial");
        }
        Err(NoResult::OutOfTime) if interrupted => return Err(NoResult::Stopped),
        _ => {}
    }
    found
}

/// Sets `signal` if a signal asks the program to end. Once `may_end` is set, the signal ends the program.
#[cfg(unix)]
fn watch_signals(signal: &Arc<AtomicBool>, may_end: &Arc<AtomicBool>) {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::flag;
    for number in [SIGINT, SIGTERM, SIGHUP] {
        // Without a handler the signal ends the program at once, which is as good.
        let _ = flag::register_conditional_default(number, Arc::clone(may_end))
            .and_then(|_| flag::register(number, Arc::clone(signal)));
    }
}

#[cfg(windows)]
fn watch_signals(signal: &Arc<AtomicBool>, may_end: &Arc<AtomicBool>) {
    let (signal, may_end) = (Arc::clone(signal), Arc::clone(may_end));
    let interrupt = move || match may_end.load(Ordering::Relaxed) {
        true => std::process::exit(super::status::Status::Interrupted as i32),
        false => signal.store(true, Ordering::Relaxed),
    };
    // A second study of the same command gets no handler. The first handler then ends the program at Ctrl-C.
    let _ = ctrlc::set_handler(interrupt);
}

/// Closes the journal of a study. `is_complete`: the study has all its results.
fn close(journal: Journal, is_complete: bool) {
    if is_complete {
        journal.complete();
    }
    if let Err(error) = journal.close() {
        note_unsaved();
        tell!("warning: not all results are saved: {error}");
    }
}

/// Runs `work` on the requested threads.
fn on_threads<T: Send>(compute: &ComputeArguments, work: impl FnOnce() -> T + Send) -> Result<T, NoResult> {
    Ok(thread_pool(compute.threads.unwrap_or(0).into())?.install(work))
}
