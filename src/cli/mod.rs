//! Commands turn what users type into a study, a report and an exit status. Only this module uses clap.
//!
//! Each command has a file of its own; `launch` and `report` also use functions of `fit` and `sweep`. A command that asks a question of a
//! plan consists of its arguments and the question that they make; [`ask`] does the rest. All commands share [`arguments`], [`load_plans`],
//! [`run_study`] (threads, progress, signals), [`print`](mod@print) (formats) and [`status`] (exit status). [`judge_plans`] judges and
//! prints all options of plans, and [`standing`] gives the standing of a plan after that.

#[macro_use]
mod tell;

mod accuracy;
mod arguments;
mod ask;
mod assumptions;
mod check;
mod completions;
mod config;
mod deadline;
mod effects;
mod fit;
mod init;
mod judge_plans;
mod launch;
mod load_plans;
mod man;
mod merge;
mod open_terminal;
mod orders;
mod print;
mod report;
mod risk;
mod ropes;
mod run_study;
mod save;
mod schema;
mod search;
mod size;
mod standing;
mod status;
mod sweep;
mod trace;

use std::io;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::error::ErrorKind;
use clap::{ArgMatches, CommandFactory, FromArgMatches, Parser, Subcommand};

use self::arguments::{ComputeArguments, LookArguments};

/// Which blasting delay keeps a shelter of tires and cables within its limits.
///
/// Opens a plan in the terminal: `shelter plans/amur-three-rows.toml`. Scripts use `shelter check`.
#[derive(Parser)]
#[command(name = "shelter", args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
#[command(version = concat!(env!("CARGO_PKG_VERSION"), " (build ", env!("SHELTER_BUILD"), ")"))]
#[command(help_template = grouped_help())]
// The same name on Windows, where the file is `shelter.exe`.
#[command(bin_name = "shelter")]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    /// Plan to open, or two plans to compare
    #[arg(value_name = "PLAN", num_args = 0..=2)]
    plans: Vec<PathBuf>,
    #[command(flatten)]
    compute: ComputeArguments,
    #[command(flatten)]
    look: LookArguments,
}

#[derive(Subcommand)]
enum Command {
    /// Pass or fail of every delay option, for scripts
    Check(check::Arguments),
    /// Time histories of one option as CSV
    Trace(trace::Arguments),
    /// This plan's speed against accuracy, on this machine
    Accuracy(accuracy::Arguments),
    /// Height and force against the interval between rows; the intervals that pass
    Sweep(sweep::Arguments),
    /// Every firing order: the worst, the best
    Orders(orders::Arguments),
    /// How likely each option fails when the unknowns vary, and what decides it
    Risk(risk::Arguments),
    /// The firing schedules with the least risk: orders, intervals, holes one after another
    Search(search::Arguments),
    /// Which physical effects this scene requires: each switched on or taken away
    Effects(effects::Arguments),
    /// What a PASS stands on: of everything taken as known, the value at which an option no longer passes
    Assumptions(assumptions::Arguments),
    /// How fast a blast launches its cover: every estimate that a blast plan allows
    Launch(launch::Arguments),
    /// Launch velocities and other unknowns from observations of earlier shots
    Fit(fit::Arguments),
    /// The lightest rope, tires and border with which every option passes
    Size(size::Arguments),
    /// Joins the shards of `orders`, `risk` or `search` that several machines computed
    Merge(merge::Arguments),
    /// One self-contained page for the blast file
    Report(report::Arguments),
    /// The rope catalogue
    Ropes(ropes::Arguments),
    /// A commented starter plan
    Init(init::Arguments),
    /// Shell completions
    Completions(completions::Arguments),
    /// The manual page
    Man,
    /// The keys of a plan as a JSON Schema, for editors
    Schema,
    /// The default configuration of the terminal, commented
    Config,
}

/// The commands in groups, by the purpose of the user.
const GROUPS: [(&str, &[&str]); 5] = [
    ("Decide", &["check", "search", "risk", "assumptions", "report"]),
    ("Plan", &["init", "ropes", "size"]),
    ("Study", &["sweep", "orders", "merge"]),
    ("Learn", &["launch", "fit", "effects", "accuracy", "trace"]),
    ("Set up", &["config", "schema", "completions", "man", "help"]),
];

/// The help, with the commands in groups.
fn grouped_help() -> String {
    let all = Command::augment_subcommands(clap::Command::new("shelter"));
    let line = |name: &&str| {
        let about = all.find_subcommand(name).and_then(clap::Command::get_about);
        let about = about.map_or_else(|| "This help, or that of a command".to_owned(), ToString::to_string);
        format!("  {name:12} {about}\n")
    };
    let groups = GROUPS.iter().map(|(heading, names)| {
        let lines: String = names.iter().map(line).collect();
        format!("{heading}:\n{lines}\n")
    });
    let groups: String = groups.collect();
    format!(
        "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n\n{groups}Arguments:\n{{positionals}}\n\nOptions:\n{{options}}"
    )
}

/// Prints the help if a command is missing.
fn print_help() -> io::Result<()> {
    Cli::command().print_help()
}

/// The error that names the command that the user meant. clap takes an unknown command for a plan and fails at the next argument.
fn stumbled(error: &clap::Error) -> Option<clap::Error> {
    let first = std::env::args().nth(1)?;
    let stumbled = matches!(error.kind(), ErrorKind::ArgumentConflict | ErrorKind::UnknownArgument);
    if stumbled { misspelt(&first) } else { None }
}

/// The error that names the nearest command, if the first argument is neither a plan nor a command.
fn misspelt(first: &str) -> Option<clap::Error> {
    if first.starts_with('-') || std::path::Path::new(first).exists() {
        return None;
    }
    let command = Cli::command();
    let names = || command.get_subcommands().map(clap::Command::get_name);
    if names().any(|name| name == first) {
        return None;
    }
    let near = names().max_by(|a, b| strsim::jaro(a, first).total_cmp(&strsim::jaro(b, first)))?;
    let words = format!("there is no command and no plan '{first}'; did you mean `shelter {near}`?\n");
    Some(Cli::command().error(ErrorKind::InvalidSubcommand, words))
}

/// The `--timeout` [s] of a command that has one.
fn timeout(matches: &ArgMatches) -> Option<f64> {
    let (_, of_command) = matches.subcommand()?;
    of_command.try_get_one("timeout").ok().flatten().copied()
}

/// Runs the command line.
pub fn run() -> ExitCode {
    let parsed = Cli::command().try_get_matches().and_then(|matches| {
        deadline::watch(timeout(&matches));
        Cli::from_arg_matches(&matches)
    });
    let cli = parsed.unwrap_or_else(|error| stumbled(&error).unwrap_or(error).exit());
    // The first of two plans may be a misspelt command.
    if let [first, _] = &cli.plans[..]
        && let Some(error) = first.to_str().filter(|name| !name.contains(['.', '/', '\\'])).and_then(misspelt)
    {
        error.exit();
    }
    let done = match (cli.command, &cli.plans[..]) {
        (Some(Command::Check(arguments)), _) => check::run(&arguments, &cli.look),
        (Some(Command::Trace(arguments)), _) => trace::run(&arguments, &cli.look),
        (Some(Command::Accuracy(arguments)), _) => accuracy::run(&arguments, &cli.look),
        (Some(Command::Sweep(arguments)), _) => sweep::run(&arguments, &cli.look),
        (Some(Command::Orders(arguments)), _) => orders::run(&arguments, &cli.look),
        (Some(Command::Risk(arguments)), _) => risk::run(&arguments, &cli.look),
        (Some(Command::Search(arguments)), _) => search::run(&arguments, &cli.look),
        (Some(Command::Effects(arguments)), _) => effects::run(&arguments, &cli.look),
        (Some(Command::Assumptions(arguments)), _) => assumptions::run(&arguments, &cli.look),
        (Some(Command::Launch(arguments)), _) => launch::run(&arguments, &cli.look),
        (Some(Command::Fit(arguments)), _) => fit::run(&arguments, &cli.look),
        (Some(Command::Size(arguments)), _) => size::run(&arguments, &cli.look),
        (Some(Command::Merge(arguments)), _) => merge::run(&arguments, &cli.look),
        (Some(Command::Report(arguments)), _) => report::run(&arguments, &cli.look),
        (Some(Command::Ropes(arguments)), _) => ropes::run(&arguments, &cli.look),
        (Some(Command::Init(arguments)), _) => init::run(&arguments, &cli.look),
        (Some(Command::Completions(arguments)), _) => completions::run(&arguments),
        (Some(Command::Man), _) => man::run(),
        (Some(Command::Schema), _) => schema::run(),
        (Some(Command::Config), _) => config::run(),
        (None, []) => open_terminal::start(&cli.compute, &cli.look),
        (None, plans) => open_terminal::plans(plans, &cli.compute, &cli.look),
    };
    status::ended(done)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_command_stands_in_one_group() {
        let mut grouped: Vec<&str> = GROUPS.iter().flat_map(|(_, names)| names.iter().copied()).collect();
        let command = Cli::command();
        let mut all: Vec<&str> = command.get_subcommands().map(clap::Command::get_name).collect();
        all.push("help");
        grouped.sort_unstable();
        all.sort_unstable();
        assert_eq!(grouped, all);
    }
}
