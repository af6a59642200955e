//! Running a long study from the command line: on the threads asked for, with a progress bar, ended by a signal.

use std::io::{self, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::RecvTimeoutError;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use super::{Compute, Status};
use crate::study::{Intervals, NoResult, Progress, Shard};
use crate::{report, scene};

/// How often the bar is drawn and signals are looked for.
const LOOK: Duration = Duration::from_millis(50);

/// Studies that will take longer say so beforehand.
const LONG: Duration = Duration::from_secs(60);
/// How long one is watched before that is told.
const WATCHED: Duration = Duration::from_secs(1);

/// What a study came to.
pub struct Finished<T> {
    /// Its result.
    pub value: T,
    /// Whether the time did not suffice for all of it.
    pub partial: bool,
}

/// Runs `work`; the bar shows only where standard error is a terminal.
pub fn run<T: Send>(
    compute: &Compute,
    work: impl FnOnce(&Progress) -> Result<T, NoResult> + Send,
) -> Result<Finished<T>, NoResult> {
    let (progress, signal) = (Progress::default(), Arc::new(AtomicBool::new(false)));
    #[cfg(unix)]
    for number in [signal_hook::consts::SIGINT, signal_hook::consts::SIGTERM, signal_hook::consts::SIGHUP] {
        // Without a handler the signal ends the program at once, which is as good.
        let _ = signal_hook::flag::register(number, Arc::clone(&signal));
    }
    let template = "{bar:30} {pos} of {len} shots, {eta} left";
    let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
    let bar = ProgressBar::new(0).with_style(style);
    let (begun, mut told) = (Instant::now(), false);
    let result = std::thread::scope(|scope| {
        let (ended, end) = std::sync::mpsc::channel::<()>();
        let study = scope.spawn(|| {
            // Gone with this thread, whether it returns or panics.
            let _ended = ended;
            compute.on_threads(|| work(&progress))
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
    let value = result.unwrap_or_else(|panic| std::panic::resume_unwind(panic))?;
    let (done, total) = progress.counts();
    let partial = progress.expired() && done < total;
    if partial {
        eprintln!("the time was up after {done} of {total} shots; what follows is partial");
    }
    Ok(Finished { value, partial })
}

/// What a study without a result says to the shell.
pub fn failed(no_result: &NoResult) -> io::Result<Status> {
    match no_result {
        NoResult::OutOfTime => {
            eprintln!("the time was up before there was a result");
            Ok(Status::Fail)
        }
        NoResult::Stopped => {
            eprintln!("{no_result}");
            Ok(Status::Interrupted)
        }
        NoResult::NoInterval => super::load::wrong(&format!("{no_result}: give --interval FROM..TO:STEP")),
        no_result => super::load::wrong(&report::no_result::message(no_result)),
    }
}

/// Writes a finished text to standard output.
pub fn print(text: &str) -> io::Result<()> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes())?;
    out.flush()
}

/// `FROM..TO:STEP` in milliseconds.
pub fn intervals(text: &str) -> Result<Intervals, String> {
    let wrong = || format!("'{text}' is no range of intervals: write FROM..TO:STEP in ms, such as 0..500:5");
    let (range, step) = text.split_once(':').ok_or_else(wrong)?;
    let (from, to) = range.split_once("..").ok_or_else(wrong)?;
    let number = |text: &str| text.trim().parse::<f64>().map(scene::seconds).map_err(|_| wrong());
    let intervals = Intervals { from: number(from)?, to: number(to)?, step: number(step)? };
    let Intervals { from, to, step } = intervals;
    if !(from >= 0.0 && to >= from && to <= 1e6 && step > 0.0) {
        return Err(wrong());
    }
    if (to - from) / step > 1e5 {
        return Err(format!("'{text}' is more than 100,000 intervals: take a longer step"));
    }
    Ok(intervals)
}

/// `I/N`, I from 1.
pub fn shard(text: &str) -> Result<Shard, String> {
    let wrong = || format!("'{text}' is no share: write I/N, such as 1/4 to 4/4");
    let (index, of) = text.split_once('/').ok_or_else(wrong)?;
    let [index, of] = [index, of].map(|text| text.trim().parse::<usize>().map_err(|_| wrong()));
    let (index, of) = (index?, of?);
    if index == 0 || index > of {
        return Err(wrong());
    }
    Ok(Shard { index: index - 1, of })
}
