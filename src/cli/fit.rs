//! `shelter fit`: launch velocities and other unknowns from what was seen of earlier shots.

use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};

use clap::Args;
use itertools::Itertools;

use super::arguments::{LookArguments, StudyArguments, named};
use super::load_plans::open;
use super::print::{print, print_text};
use super::run_study::run_study;
use super::status::{Status, failed, was_interrupted, wrong};
use super::tell;
use crate::choice::Unknown;
use crate::file;
use crate::plan::Plan;
use crate::plan::observations::{Observations, template, used_twice};
use crate::plan::write_fit::{self, LaunchUncertainty};
use crate::report::fit::{refusal, report};
use crate::report::json::FitDocument;
use crate::study::fit::{Fit, FitRequest, FitResult, fit, observable_names};
use crate::study::{Case, Computed, Context, NoResult};
use crate::units;

#[derive(Args)]
pub struct Arguments {
    /// Plan of the shots that were observed
    plan: PathBuf,
    /// Observations as CSV; a file for each time that an option was fired
    #[arg(long, value_name = "FILE.csv", required_unless_present = "template")]
    observed: Vec<PathBuf>,
    /// What to estimate
    #[arg(long, value_delimiter = ',', default_value = "launch", value_parser = named::<Unknown>(Unknown::NAMES))]
    unknown: Vec<Unknown>,
    /// Write the estimates into the plan, and into its [uncertainty] how sure they are
    #[arg(long)]
    write: bool,
    /// Print a file of observations to begin with
    #[arg(long, conflicts_with_all = ["observed", "write", "unknown"])]
    template: bool,
    #[command(flatten)]
    study: StudyArguments,
}

pub fn run(arguments: &Arguments, look: &LookArguments) -> io::Result<Status> {
    let Some(case) = open(&arguments.plan, look) else { return Ok(Status::Wrong) };
    if arguments.template {
        print_text(&template_of(&case))?;
        return Ok(Status::Pass);
    }
    if arguments.write && !arguments.plan.is_file() {
        return wrong("--write has no file to write into: give the plan by its name");
    }
    if arguments.write && arguments.study.verdict.sampling().is_none() {
        return wrong(
            "--nominal takes all that scatters for exact, and its estimates for surer than they are: leave out --nominal or --write",
        );
    }
    let unknowns = &arguments.unknown;
    if let Some(message) = contradiction(unknowns) {
        return wrong(&message);
    }
    let Some(files) = read_observations(&case, &arguments.observed, look) else { return Ok(Status::Wrong) };
    if let Some(message) = used_twice(&files, &case.plan.fitted_from, &case.source.path) {
        return wrong(&message);
    }
    let compute = arguments.study.compute.settings(&case.plan);
    let sampling = arguments.study.verdict.sampling();
    let request = FitRequest { files: &files, unknowns };
    let found = match run_study(&arguments.study.compute, |control| {
        fit(&Context::new(&case, compute, control).with_sampling(sampling), &request)
    }) {
        Err(reason) => return failed(&reason),
        Ok(Computed { value: found, .. }) => found,
    };
    if was_interrupted() {
        return failed(&NoResult::Stopped);
    }
    if let Some(message) = refusal(&case, &found) {
        return wrong(&message);
    }
    let FitResult::Fitted(fit) = &found else { return Ok(Status::Wrong) };
    let document = || FitDocument::new(&case, &files, fit);
    let reports = [report(&case, &files, fit, sampling.is_some())];
    let status = print(&reports, document, arguments.study.format, look)?;
    if arguments.write {
        match reports[0].conclusion.as_ref() {
            Some(conclusion) => tell!("nothing was written: {}", conclusion.text),
            None => write(&arguments.plan, &case, &files, fit)?,
        }
    }
    Ok(status)
}

/// The observations of all files; prints every mistake, `None` where there is one.
pub fn read_observations(case: &Case, paths: &[PathBuf], look: &LookArguments) -> Option<Vec<Observations>> {
    let names = observable_names(case);
    let open = |path: &PathBuf| {
        let read = Observations::read(path, &names);
        read.inspect_err(|mistakes| tell::mistakes(mistakes, look.colored(io::stderr().is_terminal()))).ok()
    };
    // All of them are read before the first mistake ends the command.
    let files: Vec<Option<Observations>> = paths.iter().map(open).collect();
    files.into_iter().collect()
}

/// What is wrong with unknowns that are each right by themselves.
fn contradiction(unknowns: &[Unknown]) -> Option<String> {
    if unknowns.contains(&Unknown::Launch) && unknowns.contains(&Unknown::LaunchByRow) {
        return Some("launch and launch_by_row contradict one another: choose one of them".to_owned());
    }
    let twice = unknowns.iter().duplicates_by(|unknown| unknown.name()).next()?;
    Some(format!("--unknown names {twice} twice"))
}

/// A file of observations with a tire and a cable of the plan.
fn template_of(case: &Case) -> String {
    let scene = case.scene();
    let tire = case.shots[0].firings.first().map_or(0, |firing| firing.tire);
    let cable =
        scene.cables.iter().position(|cable| cable.ends.contains(&tire)).map(|cable| scene.cable_name(cable));
    template(&case.plan.delays[0].name, &scene.tire_ids[tire].to_string(), cable.as_deref())
}

/// Writes the estimates into the plan.
fn write(path: &Path, case: &Case, files: &[Observations], fit: &Fit) -> io::Result<()> {
    if std::fs::read_to_string(path)? != case.source.text {
        return Err(io::Error::other("the plan has changed meanwhile; nothing was written"));
    }
    let checksums: Vec<String> = files.iter().flat_map(Observations::kept_in_plan).collect();
    let text = write_fit::write(&case.source.text, &case.plan.uncertainty, &fit.to_write(), &checksums);
    let text = text.map_err(io::Error::other)?;
    if let Err(mistakes) = Plan::parse(&case.source.path, &text) {
        return Err(io::Error::other(format!(
            "the plan would not be valid; nothing was written: {}",
            mistakes.first()
        )));
    }
    file::save(path, &text)?;
    let launches = fit.launches.map(|launches| {
        let LaunchUncertainty { common_percent, between_shots_percent } = launches;
        let [common, between] =
            [common_percent, between_shots_percent].map(|percent| units::rounded(percent, 1));
        format!("; launch_common_percent is {common} now, and launch_between_shots_percent {between}")
    });
    tell!("written: {}{}", path.display(), launches.unwrap_or_default());
    Ok(())
}
