//! `shelter fit`: launch velocities and other unknowns from observations of earlier shots.

use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};

use clap::Args;
use itertools::Itertools;

use super::arguments::{LookArguments, StudyArguments, named};
use super::ask::{Ask, Refusal, needs_file, write_plan};
use super::load_plans::open;
use super::print::{print, print_text};
use super::run_study::run_study;
use super::standing::observation_record;
use super::status::{Status, failed, was_interrupted, wrong};
use super::tell;
use crate::choice::Unknown;
use crate::plan::observations::{Observations, files_of, not_to_be_fitted, template};
use crate::plan::write_fit::{self, LaunchUncertainty};
use crate::report::answer::why_held;
use crate::report::fit::{not_writable, refusal, report_of_next};
use crate::study::fit::what_next::{WhatNext, next_observation_of_all};
use crate::study::fit::{self, ComparedWithObservations, Fit, FitResult, observable_names};
use crate::study::observed::objection::compare_record;
use crate::study::question::{Found, Question};
use crate::study::samples::sample_count::Sampling;
use crate::study::standing::{Hold, Standing};
use crate::study::{Case, Computed, Context, FileState, NoResult};
use crate::units;

#[derive(Args)]
pub struct Arguments {
    /// Plan of the shots that were observed
    plan: PathBuf,
    /// Observations as CSV; a file for each time that an option was fired, or a folder of such files
    #[arg(long, value_name = "FILE.csv", num_args = 1.., required_unless_present_any = ["template", "next"])]
    observed: Vec<PathBuf>,
    /// What to estimate
    #[arg(long, value_delimiter = ',', default_value = "launch", value_parser = named::<Unknown>(Unknown::NAMES))]
    unknown: Vec<Unknown>,
    /// Write the estimates into the plan, and into its [uncertainty] how sure they are
    #[arg(long)]
    write: bool,
    /// Say which single observation of the next shot would narrow the verdict most, and how to take it
    #[arg(long, conflicts_with_all = ["observed", "write", "unknown", "template"])]
    next: bool,
    /// Print a file of observations to begin with
    #[arg(long, conflicts_with_all = ["observed", "write", "unknown"])]
    template: bool,
    #[command(flatten)]
    study: StudyArguments,
}

pub fn run(arguments: &Arguments, look: &LookArguments) -> io::Result<Status> {
    if arguments.template {
        let Some(case) = open(&arguments.plan, look) else { return Ok(Status::Wrong) };
        print_text(&template_of(&case))?;
        return Ok(Status::Pass);
    }
    if arguments.next {
        let Some(case) = open(&arguments.plan, look) else { return Ok(Status::Wrong) };
        return what_next(arguments, &case, look);
    }
    let ask = Ask::of_study(&arguments.plan, &arguments.study);
    let answered = match ask.answer(look, |case| question(arguments, case, look))? {
        Ok(answered) => answered,
        Err(status) => return Ok(status),
    };
    if was_interrupted() {
        return failed(&NoResult::Stopped);
    }
    let Found::Fit(compared) = &answered.found else { return Ok(Status::Wrong) };
    let ComparedWithObservations { fitted: Some(fitted), new: files, .. } = &compared.value else {
        return Ok(Status::Wrong);
    };
    let case = &answered.case;
    if let Some(message) = refusal(case, fitted) {
        return wrong(&message);
    }
    let FitResult::Fitted(fit) = fitted else { return Ok(Status::Wrong) };
    let status = answered.print(arguments.study.format, look)?;
    if arguments.write {
        match fit.not_writable(case, files) {
            Some(why) => tell!("nothing was written: {}", not_writable(case, &why)),
            None => write(&arguments.plan, case, files, fit)?,
        }
    }
    Ok(status)
}

/// Says what to observe in the next shot.
fn what_next(arguments: &Arguments, case: &Case, look: &LookArguments) -> io::Result<Status> {
    let Some(sampling) = arguments.study.verdict.sampling() else {
        return wrong(
            "--nominal takes all that scatters for exact: then there is nothing to learn; leave it out",
        );
    };
    let compute = arguments.study.compute.settings(&case.plan);
    let find =
        |control: &_| next_shot(&Context::new(case, compute, control), &sampling).map(Computed::complete);
    match run_study(&arguments.study.compute, find) {
        Err(reason) => failed(&reason),
        Ok(Computed { value: Err(hold), .. }) => {
            tell!("HOLD, no shot is proposed: {}", why_held(hold));
            Ok(Status::Fail)
        }
        Ok(Computed { value: Ok(next), .. }) => {
            print(&[report_of_next(case, &next)], arguments.study.format, look)
        }
    }
}

/// What to observe in the next shot; or the reason for no proposal, if no pass of the plan stands.
pub fn next_shot(context: &Context<'_>, sampling: &Sampling) -> Result<Result<WhatNext, Hold>, NoResult> {
    let compared = compare_record(context, &observation_record(context.case));
    // The plan may have another launch, and then it is in no file yet.
    match Standing::of(context.case, FileState::AsJudged, compared).against_passes() {
        Some(hold) => Ok(Err(hold)),
        None => next_observation_of_all(context, sampling).map(Ok),
    }
}

fn question(arguments: &Arguments, case: &Case, look: &LookArguments) -> Result<Question, Refusal> {
    if arguments.write {
        needs_file(&arguments.plan)?;
    }
    if arguments.write && arguments.study.verdict.sampling().is_none() {
        return Err(
            "--nominal takes all that scatters for exact, and its estimates for surer than they are: leave out --nominal or --write".into(),
        );
    }
    let unknowns = arguments.unknown.clone();
    if let Some(message) = unknowns_that_exclude(&unknowns) {
        return Err(message.into());
    }
    let observed = read_observations(case, &arguments.observed, look).ok_or(Refusal::Reported)?;
    match not_to_be_fitted(&observed, &case.plan.fitted_from, &case.source.name()) {
        Some(message) => Err(message.into()),
        None => Ok(Question::Fit(fit::Question { observed, unknowns })),
    }
}

/// The observations of all files. Prints every mistake; `None` if there is one.
pub fn read_observations(case: &Case, paths: &[PathBuf], look: &LookArguments) -> Option<Vec<Observations>> {
    let names = observable_names(case);
    let open = |path: &PathBuf| {
        let read = Observations::read(path, &names);
        read.inspect_err(|mistakes| tell::mistakes(mistakes, look.colored(io::stderr().is_terminal()))).ok()
    };
    let paths = files_of(paths)
        .inspect_err(|mistakes| tell::mistakes(mistakes, look.colored(io::stderr().is_terminal())))
        .ok()?;
    // All files are read before the first mistake ends the command.
    let files: Vec<Option<Observations>> = paths.iter().map(open).collect();
    files.into_iter().collect()
}

/// Message about unknowns that exclude one another, or that are named twice; `None` if all are right.
fn unknowns_that_exclude(unknowns: &[Unknown]) -> Option<String> {
    if unknowns.contains(&Unknown::Launch) && unknowns.contains(&Unknown::LaunchByRow) {
        return Some("launch and launch_by_row contradict one another: choose one of them".to_owned());
    }
    let twice = unknowns.iter().duplicates_by(|unknown| unknown.name()).next()?;
    Some(format!("--unknown names {twice} twice"))
}

/// Template of a file of observations, with a tire and a cable of the plan.
fn template_of(case: &Case) -> String {
    let scene = case.scene();
    let tire = case.shots[0].firings.first().map_or(0, |firing| firing.tire);
    let cable =
        scene.cables.iter().position(|cable| cable.ends.contains(&tire)).map(|cable| scene.cable_name(cable));
    template(&case.plan.delays[0].name, &scene.tire_ids[tire].to_string(), cable.as_deref())
}

/// Writes the estimates into the plan.
fn write(path: &Path, case: &Case, files: &[Observations], fit: &Fit) -> io::Result<()> {
    let checksums: Vec<String> = files.iter().flat_map(Observations::kept_by_fit).collect();
    let text = write_fit::write(&case.source.text, &case.plan, &fit.to_write(), &checksums);
    write_plan(path, case, text)?;
    let launches = fit.launches.map(|launches| {
        let LaunchUncertainty { common_percent, between_shots_percent } = launches;
        let [common, between] =
            [common_percent, between_shots_percent].map(|percent| units::rounded(percent, 1));
        format!("; launch_common_percent is {common} now, and launch_between_shots_percent {between}")
    });
    tell!("written: {}{}", path.display(), launches.unwrap_or_default());
    Ok(())
}
