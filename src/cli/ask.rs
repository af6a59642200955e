//! Asks a question of a plan: opens the plan, builds the question, answers it under its journal, and prints the answer.

use std::fmt::Display;
use std::io;
use std::path::Path;

use super::arguments::{ComputeArguments, FormatArg, LookArguments, StudyArguments};
use super::load_plans::open;
use super::print::print;
use super::run_study::run_saved_study;
use super::save::{SaveArguments, SharedArguments};
use super::standing::{observation_record, standing_now};
use super::status::{Status, failed, saved, wrong};
use crate::file;
use crate::plan::Plan;
use crate::report::answer::answer;
use crate::report::language::phrase;
use crate::report::words::warnings::FIXED_STEP;
use crate::study::observed::objection::compare_record;
use crate::study::question::{Asked, Found, Question};
use crate::study::samples::sample_count::Sampling;
use crate::study::standing::Standing;
use crate::study::{Case, Computed, Journal, Shard};

/// How to answer one question of a command, and how to print the answer.
#[derive(Clone, Copy)]
pub struct Ask<'a> {
    plan: &'a Path,
    compute: &'a ComputeArguments,
    sampling: Option<Sampling>,
    format: FormatArg,
    save: Option<&'a SaveArguments>,
    shard: Option<Shard>,
}

/// A question with its answer.
pub struct Answered {
    /// The plan.
    pub case: Case,
    /// Standing of the plan now.
    pub standing: Standing,
    /// The result.
    pub found: Found,
    /// Whether somebody fixed the step of the samples.
    pub is_step_fixed: bool,
}

/// Why the arguments do not make a question about the plan.
pub enum Refusal {
    /// What is wrong with the arguments.
    Why(String),
    /// The reason is printed already.
    Reported,
}

impl<M: Into<String>> From<M> for Refusal {
    fn from(message: M) -> Self {
        Self::Why(message.into())
    }
}

/// Refuses `--write` if the plan came from no file.
pub fn needs_file(plan: &Path) -> Result<(), String> {
    match plan.is_file() {
        true => Ok(()),
        false => Err("--write has no file to write into: give the plan by its name".to_owned()),
    }
}

/// Writes a new text over the plan that was studied. Refuses if the file has changed since, or if the text is no valid plan.
pub fn write_plan(path: &Path, case: &Case, text: Result<String, impl Display>) -> io::Result<()> {
    let refused = |why: String| io::Error::other(format!("nothing was written: {why}"));
    if std::fs::read_to_string(path)? != case.source.text {
        return Err(refused("the plan has changed meanwhile".to_owned()));
    }
    let text = text.map_err(|why| refused(why.to_string()))?;
    if let Err(mistakes) = Plan::parse(&case.source.name(), &text) {
        return Err(refused(format!("the plan would not be valid: {}", mistakes.first())));
    }
    file::save(path, &text)
}

impl<'a> Ask<'a> {
    /// Asks a plan, with these samples for a verdict.
    pub fn new(
        plan: &'a Path,
        compute: &'a ComputeArguments,
        sampling: Option<Sampling>,
        format: FormatArg,
    ) -> Self {
        Self { plan, compute, sampling, format, save: None, shard: None }
    }

    /// Asks a plan, with the samples for a verdict from the command line.
    pub fn of_study(plan: &'a Path, study: &'a StudyArguments) -> Self {
        Self::new(plan, &study.compute, study.verdict.sampling(), study.format)
    }

    /// The same question, with the results saved in a file.
    pub fn saved(self, save: &'a SaveArguments) -> Self {
        Self { save: Some(save), ..self }
    }

    /// The same question, with the results saved in a file; only the results of a shard, if one is requested.
    pub fn shared(self, shared: &'a SharedArguments) -> Self {
        Self { shard: shared.shard, ..self.saved(&shared.file) }
    }

    /// Answers and prints the question of the plan. Prints what is wrong with the question.
    pub fn run(
        self,
        look: &LookArguments,
        question: impl FnOnce(&Case) -> Result<Question, Refusal>,
    ) -> io::Result<Status> {
        self.run_then(look, question, |_, status| Ok(status))
    }

    /// Like [`run`](Self::run). If there is an answer, `then` turns it and the status of the printed report into the exit status.
    pub fn run_then(
        self,
        look: &LookArguments,
        question: impl FnOnce(&Case) -> Result<Question, Refusal>,
        then: impl FnOnce(&Answered, Status) -> io::Result<Status>,
    ) -> io::Result<Status> {
        match self.answer(look, question)? {
            Ok(answered) => then(&answered, answered.print(self.format, look)?),
            Err(status) => Ok(status),
        }
    }

    /// Answers the question of the plan. If there is no answer to print, returns the exit status.
    pub fn answer(
        self,
        look: &LookArguments,
        question: impl FnOnce(&Case) -> Result<Question, Refusal>,
    ) -> io::Result<Result<Answered, Status>> {
        let Some(case) = open(self.plan, look) else { return Ok(Err(Status::Wrong)) };
        let question = match question(&case) {
            Ok(question) => question,
            Err(Refusal::Why(message)) => return wrong(&message).map(Err),
            Err(Refusal::Reported) => return Ok(Err(Status::Wrong)),
        };
        let asked = Asked { question, sampling: self.sampling, compute: self.compute.settings(&case.plan) };
        let shard = self.shard.unwrap_or(Shard::WHOLE);
        let journal = self.save.map_or(Ok(Journal::default()), |save| save.journal(&case, &asked, shard));
        let journal = match journal {
            Ok(journal) => journal,
            Err(message) => return wrong(&message).map(Err),
        };
        if self.shard.is_some() {
            let work = |control: &_| asked.answer_shard(&case, control, shard);
            return saved(run_saved_study(self.compute, journal, work)).map(Err);
        }
        let answered = run_saved_study(self.compute, journal, |control| {
            let found = asked.answer(&case, control)?;
            let compared = compare_record(&asked.context(&case, control), &observation_record(&case));
            Ok(Computed { partial: found.is_partial(), value: (found, compared) })
        });
        match answered {
            Ok(Computed { value: (found, compared), .. }) => {
                let standing = standing_now(&case, compared);
                let is_step_fixed = asked.is_step_fixed();
                Ok(Ok(Answered { case, standing, found, is_step_fixed }))
            }
            Err(reason) => failed(&reason).map(Err),
        }
    }
}

impl Answered {
    /// Prints the answer.
    pub fn print(&self, format: FormatArg, look: &LookArguments) -> io::Result<Status> {
        let Self { case, standing, found, is_step_fixed } = self;
        let mut report = answer(case, standing, found);
        if *is_step_fixed {
            report.warnings.push(phrase(FIXED_STEP).to_owned());
        }
        print(&[report], format, look)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::PlanSource;

    /// A change that a colleague made meanwhile is not overwritten.
    #[test]
    fn a_plan_that_has_changed_meanwhile_is_not_written() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("plan.toml");
        let text = include_str!("../../tests/fixtures/amur-three-rows.toml");
        let case = Case::parse(PlanSource { path: path.clone(), text: text.to_owned() }).expect("a plan");
        let new = || Ok::<_, String>(text.replace("friction = 0.5", "friction = 0.4"));
        for (on_disk, is_written) in [(text.to_owned(), true), (format!("{text}# ours\n"), false)] {
            std::fs::write(&path, &on_disk).expect("written");
            assert_eq!(write_plan(&path, &case, new()).is_ok(), is_written);
            let now = std::fs::read_to_string(&path).expect("read");
            assert_eq!(now == on_disk, !is_written);
        }
    }
}
