//! Exit statuses. Only this module decides which status a command returns to the shell.

use std::io;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::report::parts::Report;
use crate::report::words::no_result;
use crate::study::{ComputeResult, Computed, NoResult};
use crate::verdict::Verdict;

/// Exit status of a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Everything that the command judged passes.
    Pass = 0,
    /// Something fails or stays undecided.
    Fail = 1,
    /// The plan or the arguments are wrong, or the system refused something that the command needs.
    Wrong = 2,
    /// Interrupted by a signal.
    Interrupted = 130,
}

impl Status {
    /// Exit status for printed reports, by the worst conclusion. A report without a conclusion counts as a pass.
    pub fn of(reports: &[Report]) -> Self {
        let conclusions = reports.iter().filter_map(|report| report.conclusion.as_ref());
        match Verdict::worst(conclusions.map(|conclusion| conclusion.word.verdict())) {
            Verdict::Pass => Status::Pass,
            Verdict::Undecided | Verdict::Fail => Status::Fail,
        }
    }
}

impl From<Status> for ExitCode {
    fn from(status: Status) -> Self {
        ExitCode::from(status as u8)
    }
}

/// Whether a signal ended a study. The results are partial then.
static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// Notes that a signal ended a study.
pub fn note_interrupt() {
    INTERRUPTED.store(true, Ordering::Relaxed);
}

/// Whether a signal ended a study. Commands write nothing then.
pub fn was_interrupted() -> bool {
    INTERRUPTED.load(Ordering::Relaxed)
}

/// Whether results could not be saved.
static UNSAVED: AtomicBool = AtomicBool::new(false);

/// Notes that results could not be saved.
pub fn note_unsaved() {
    UNSAVED.store(true, Ordering::Relaxed);
}

/// Exit status of a command that ended. Prints its error, if it has one.
pub fn ended(result: io::Result<Status>) -> ExitCode {
    let status = match result {
        Ok(status) => status,
        // Only `trace` prints row by row, and it has no verdict. What prints a text never gets here (`print_text`).
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Status::Pass,
        Err(error) => {
            tell!("error: {error}");
            Status::Wrong
        }
    };
    if was_interrupted() { Status::Interrupted.into() } else { status.into() }
}

/// Exit status of a shard that was saved.
pub fn saved(finding: ComputeResult<()>) -> io::Result<Status> {
    match finding {
        Err(reason) => failed(&reason),
        // The file is the only result of a shard.
        Ok(_) if UNSAVED.load(Ordering::Relaxed) => {
            tell!("the shard is not complete: make room, and give the same command again");
            Ok(Status::Wrong)
        }
        Ok(Computed { partial: true, .. }) => {
            tell!("the shard is not complete: the same command goes on from there");
            Ok(Status::Fail)
        }
        Ok(Computed { partial: false, .. }) => Ok(Status::Pass),
    }
}

/// Reports a mistake in the arguments.
pub fn wrong(message: &str) -> io::Result<Status> {
    tell!("error: {message}");
    Ok(Status::Wrong)
}

/// Remedy for a run that failed at its step.
pub const REMEDY_AS_ARGUMENTS: &str = "choose a finer --accuracy or a smaller --dt";

/// Reports why a study has no result, with arguments as the remedy.
pub fn failed(reason: &NoResult) -> io::Result<Status> {
    match reason {
        NoResult::Stopped => {
            tell!("{reason}");
            Ok(Status::Interrupted)
        }
        NoResult::OutOfTime => {
            tell!("the time was up before there was a result");
            Ok(Status::Fail)
        }
        NoResult::NoInterval => wrong(&format!("{reason}: give --interval FROM..TO:STEP")),
        NoResult::HolesDiffer => wrong(&format!("{reason} Give --option NAME")),
        NoResult::NotShared(_) => wrong(&format!("{reason}: leave out --shard")),
        NoResult::Failed(failure) if failure.needs_finer_step() => {
            wrong(&format!("{reason}: {REMEDY_AS_ARGUMENTS}"))
        }
        _ => wrong(&no_result::message(reason)),
    }
}
