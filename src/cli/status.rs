//! Exit status: the one place that decides what a command says to the shell.

use std::io;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::report::parts::Report;
use crate::report::words::no_result;
use crate::study::{ComputeResult, Computed, NoResult};
use crate::verdict::Verdict;

/// What a command says to the shell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Everything asked for passes.
    Pass = 0,
    /// Something fails or stays undecided.
    Fail = 1,
    /// The plan or the arguments are wrong, or the system refused what was needed.
    Wrong = 2,
    /// Interrupted by a signal.
    Interrupted = 130,
}

impl Status {
    /// The status of printed reports: that of the worst conclusion. A report without a conclusion counts as a pass.
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

/// Whether a signal ended a study; its results are partial.
static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// Takes note that a signal ended a study.
pub fn note_interrupt() {
    INTERRUPTED.store(true, Ordering::Relaxed);
}

/// Whether a signal ended a study: nothing is written then.
pub fn was_interrupted() -> bool {
    INTERRUPTED.load(Ordering::Relaxed)
}

/// Whether results could not be saved.
static UNSAVED: AtomicBool = AtomicBool::new(false);

/// Takes note that results could not be saved.
pub fn note_unsaved() {
    UNSAVED.store(true, Ordering::Relaxed);
}

/// The exit status of a command that ended; prints its error, if it has one.
pub fn ended(result: io::Result<Status>) -> ExitCode {
    let status = match result {
        Ok(status) => status,
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Status::Pass,
        Err(error) => {
            tell!("error: {error}");
            Status::Wrong
        }
    };
    if was_interrupted() { Status::Interrupted.into() } else { status.into() }
}

/// The status of a shard that was saved.
pub fn saved(finding: ComputeResult<()>) -> io::Result<Status> {
    match finding {
        Err(reason) => failed(&reason),
        // Nothing else comes of a shard but its file.
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

/// Tells a mistake in the arguments.
pub fn wrong(message: &str) -> io::Result<Status> {
    tell!("error: {message}");
    Ok(Status::Wrong)
}

/// Remedy for a run that failed at its step.
pub const REMEDY_AS_ARGUMENTS: &str = "choose a finer --accuracy or a smaller --dt";

/// Tells why a study has no result, with the remedy as arguments.
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
