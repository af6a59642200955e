//! Commands: what users type, turned into studies, reports and an exit status. clap stops here.

mod accuracy;
mod check;
mod init;
mod load;
mod long;
mod merge;
mod orders;
mod packaging;
mod report;
mod ropes;
mod scatter;
mod size;
mod sweep;
mod trace;

use std::io;
use std::path::PathBuf;
use std::process::ExitCode;
use std::str::FromStr;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::error::ErrorKind;
use clap::{Args, CommandFactory, Parser, Subcommand, ValueEnum};

use crate::choice::{Accuracy, Method, UnknownName};
use crate::plan::Plan;
use crate::report::table::Style;
use crate::study::ComputeSettings;

/// Which blasting delay is safe under a shelter of tires and cables.
///
/// Opens a plan in the terminal: `shelter plans/amur-three-rows.toml`. Scripts use `shelter check`.
#[derive(Parser)]
#[command(name = "shelter", version, args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    /// Plan to open
    #[arg(value_name = "PLAN")]
    plan: Option<PathBuf>,
    #[command(flatten)]
    compute: Compute,
    #[command(flatten)]
    look: Look,
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
    /// Detonator and launch scatter: how often each option fails
    Scatter(scatter::Arguments),
    /// The lightest rope, tires and border with which every option passes
    Size(size::Arguments),
    /// Joins the shares of `orders` or `scatter` that several machines computed
    Merge(merge::Arguments),
    /// One self-contained page for the blast file
    Report(report::Arguments),
    /// The rope catalogue
    Ropes(ropes::Arguments),
    /// A commented starter plan
    Init(init::Arguments),
    /// Shell completions
    Completions(packaging::Completions),
    /// The manual page
    Man,
    /// The keys of a plan as a JSON Schema, for editors
    Schema,
    /// The default configuration of the terminal, commented
    Config,
}

/// How to compute; shared by every command that does.
#[derive(Args, Clone)]
struct Compute {
    /// How finely the refinement starts
    #[arg(long, value_parser = named::<Accuracy>(Accuracy::NAMES))]
    accuracy: Option<Accuracy>,
    /// Time integration method
    #[arg(long, value_parser = named::<Method>(Method::NAMES))]
    method: Option<Method>,
    /// Exactly this step, never refined
    #[arg(long, value_name = "SECONDS", value_parser = positive, allow_negative_numbers = true)]
    dt: Option<f64>,
    /// Worker threads; default: one per core
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// End after this time with what is computed by then
    #[arg(long, value_name = "SECONDS", value_parser = positive, allow_negative_numbers = true)]
    timeout: Option<f64>,
}

impl Compute {
    /// As the plan asks, with what the command line overrides.
    fn settings(&self, plan: &Plan) -> ComputeSettings {
        let asked = ComputeSettings::of(plan);
        ComputeSettings {
            method: self.method.unwrap_or(asked.method),
            accuracy: self.accuracy.unwrap_or(asked.accuracy),
            step: self.dt,
        }
    }

    /// Runs `work` on the threads asked for.
    fn on_threads<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        match rayon::ThreadPoolBuilder::new().num_threads(self.threads.unwrap_or(0).into()).build() {
            Ok(pool) => pool.install(work),
            Err(_) => work(),
        }
    }
}

/// How output looks.
#[derive(Args, Clone)]
struct Look {
    /// Plain characters only, for poor fonts
    #[arg(long, global = true)]
    ascii: bool,
    /// Colour; `auto` obeys NO_COLOR
    #[arg(long, value_enum, default_value = "auto", global = true)]
    color: ColorArg,
}

impl Look {
    /// Style of texts on a stream that is or is not a terminal.
    fn style(&self, terminal: bool) -> Style {
        Style { ascii: self.ascii || terminal && !shows_unicode(), color: self.colored(terminal) }
    }

    /// Whether to colour what goes to a stream that is or is not a terminal.
    fn colored(&self, terminal: bool) -> bool {
        match self.color {
            ColorArg::Always => true,
            ColorArg::Never => false,
            ColorArg::Auto => terminal && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty()),
        }
    }
}

/// Whether the terminal shows more than ASCII, as far as its name and the locale say.
fn shows_unicode() -> bool {
    let set = |name: &str| std::env::var(name).ok().filter(|value| !value.is_empty());
    let locale = ["LC_ALL", "LC_CTYPE", "LANG"].into_iter().find_map(set);
    let utf8 = |locale: String| locale.to_lowercase().replace('-', "").contains("utf8");
    set("TERM").as_deref() != Some("dumb") && locale.is_none_or(utf8)
}

#[derive(Clone, Copy, ValueEnum)]
enum ColorArg {
    Auto,
    Always,
    Never,
}

#[derive(Clone, Copy, Default, ValueEnum)]
enum FormatArg {
    #[default]
    Text,
    Json,
    Csv,
}

/// A parser that takes the names of a choice, and shows them in the help.
fn named<T>(names: &'static [&'static str]) -> impl TypedValueParser<Value = T>
where
    T: FromStr<Err = UnknownName> + Clone + Send + Sync + 'static,
{
    PossibleValuesParser::new(names).try_map(|name| name.parse())
}

/// The help, where a command is missing.
fn print_help() -> io::Result<()> {
    Cli::command().print_help()
}

fn positive(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err("must be a positive number".to_owned()) }
}

/// clap takes a command it does not know for a plan, and then stumbles over what follows: says what was meant instead.
fn misspelt(error: &clap::Error) -> Option<clap::Error> {
    let first = std::env::args().nth(1)?;
    let stumbled = matches!(error.kind(), ErrorKind::ArgumentConflict | ErrorKind::UnknownArgument);
    if !stumbled || first.starts_with('-') || std::path::Path::new(&first).exists() {
        return None;
    }
    let command = Cli::command();
    let names = || command.get_subcommands().map(clap::Command::get_name);
    if names().any(|name| name == first) {
        return None;
    }
    let near = names().max_by(|a, b| strsim::jaro(a, &first).total_cmp(&strsim::jaro(b, &first)))?;
    let words = format!("there is no command and no plan '{first}'; did you mean `shelter {near}`?\n");
    Some(Cli::command().error(ErrorKind::InvalidSubcommand, words))
}

/// What a command that ran to its end says to the shell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Status {
    /// Every option passes.
    Pass = 0,
    /// Some option fails or stays undecided.
    Fail = 1,
    /// The plan or the arguments are wrong.
    Wrong = 2,
    /// Interrupted by a signal.
    Interrupted = 130,
}

impl From<Status> for ExitCode {
    fn from(status: Status) -> Self {
        ExitCode::from(status as u8)
    }
}

/// Runs the command line.
pub fn run() -> ExitCode {
    let cli = Cli::try_parse().unwrap_or_else(|error| misspelt(&error).unwrap_or(error).exit());
    let done = match (cli.command, cli.plan) {
        (Some(Command::Check(arguments)), _) => check::run(&arguments, &cli.look),
        (Some(Command::Trace(arguments)), _) => trace::run(&arguments, &cli.look),
        (Some(Command::Accuracy(arguments)), _) => accuracy::run(&arguments, &cli.look),
        (Some(Command::Sweep(arguments)), _) => sweep::run(&arguments, &cli.look),
        (Some(Command::Orders(arguments)), _) => orders::run(&arguments, &cli.look),
        (Some(Command::Scatter(arguments)), _) => scatter::run(&arguments, &cli.look),
        (Some(Command::Size(arguments)), _) => size::run(&arguments, &cli.look),
        (Some(Command::Merge(arguments)), _) => merge::run(&arguments, &cli.look),
        (Some(Command::Report(arguments)), _) => report::run(&arguments, &cli.look),
        (Some(Command::Ropes(arguments)), _) => ropes::run(&arguments),
        (Some(Command::Init(arguments)), _) => init::run(&arguments, &cli.look),
        (Some(Command::Completions(arguments)), _) => packaging::completions(&arguments),
        (Some(Command::Man), _) => packaging::man(),
        (Some(Command::Schema), _) => packaging::schema(),
        (Some(Command::Config), _) => packaging::config(),
        (None, Some(plan)) => load::open(&plan, &cli.compute, &cli.look),
        (None, None) => load::start(&cli.compute, &cli.look),
    };
    match done {
        Ok(status) => status.into(),
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Status::Pass.into(),
        Err(error) => {
            eprintln!("error: {error}");
            Status::Wrong.into()
        }
    }
}
