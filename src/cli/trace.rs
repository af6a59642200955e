//! `shelter trace`: time histories of one option.

use std::io::{self, BufWriter, Write};
use std::ops::ControlFlow;
use std::path::PathBuf;

use clap::Args;
use itertools::Itertools;

use super::arguments::{ComputeArguments, FormatArg, LookArguments, positive};
use super::deadline;
use super::load_plans::open_option;
use super::status::{self, Status, wrong};
use crate::report;
use crate::report::csv::Separators;
use crate::report::trace::TraceDocument;
use crate::scene::{Scene, TireId};
use crate::simulation::RunError;
use crate::study::NoResult;
use crate::study::samples::sample_count::Sampling;
use crate::study::trace::{DrawnSample, TracedItems, TracedShot, trace};

#[derive(Args)]
pub struct Arguments {
    /// Plan to trace
    plan: PathBuf,
    /// Name of the delay option; default: the first
    #[arg(long, value_name = "NAME")]
    option: Option<String>,
    /// Trace this sample of the option, as `check` draws it, at the step of samples; default: the planned shot
    #[arg(long, value_name = "N")]
    sample: Option<usize>,
    /// Seed of the random numbers; default: 1
    #[arg(long, value_name = "N", requires = "sample", allow_negative_numbers = true)]
    seed: Option<u64>,
    /// Tire to follow, `ROW,COLUMN` or `N` in a list layout; default: the highest
    #[arg(long, value_name = "ROW,COLUMN")]
    tire: Vec<String>,
    /// Cable to follow, by its two tires; default: the most loaded
    #[arg(long, value_name = "ROW,COLUMN-ROW,COLUMN")]
    cable: Vec<String>,
    /// Milliseconds between rows; default: every step
    #[arg(long, value_name = "MS", value_parser = positive, allow_negative_numbers = true)]
    every: Option<f64>,
    /// Output format; `text` is CSV as well
    #[arg(long, value_enum, default_value = "csv")]
    format: FormatArg,
    #[command(flatten)]
    compute: ComputeArguments,
}

pub fn run(arguments: &Arguments, look: &LookArguments) -> io::Result<Status> {
    let Some((case, option)) = open_option(&arguments.plan, arguments.option.as_deref(), look) else {
        return Ok(Status::Wrong);
    };
    let mut chosen = match choose(case.scene(), arguments) {
        Ok(chosen) => chosen,
        Err(message) => return wrong(&message),
    };
    let compute = arguments.compute.settings(&case.plan);
    let seed = arguments.seed.unwrap_or(Sampling::OF_VERDICT.seed);
    let sample = arguments.sample.map(|number| DrawnSample { seed, number, step_halvings: 0 });
    let shot = TracedShot::new(&case, option, &compute, sample);
    deadline::note_loaded();
    let timeout = arguments.compute.timeout;
    let in_time = || match timeout {
        Some(timeout) if deadline::elapsed().as_secs_f64() > timeout => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    };
    if chosen == TracedItems::default() {
        match shot.run(&mut |_| in_time()) {
            Ok(outcome) => chosen = TracedItems::of(&outcome),
            Err(failure) => return failed(&failure),
        }
    }
    let mut rows = Rows::begin(arguments.format, &report::trace::header(case.scene(), &chosen))?;
    let every = arguments.every.map_or(shot.settings.step, |ms| ms / 1e3);
    let mut written = Ok(());
    let done = trace(&shot, &chosen, every, &mut |row| {
        written = rows.row(row);
        if written.is_ok() { in_time() } else { ControlFlow::Break(()) }
    });
    written?;
    rows.end()?;
    done.map_or_else(|failure| failed(&failure), |_| Ok(Status::Pass))
}

fn failed(failure: &RunError) -> io::Result<Status> {
    if let RunError::Stopped { time } = failure {
        tell!("the time was up at {time:.3} s of the motion");
        return Ok(Status::Fail);
    }
    status::failed(&NoResult::Failed(failure.clone()))
}

/// Writes rows one by one.
enum Rows {
    Csv(Out, Separators),
    Json(TraceDocument<Out>),
}

type Out = BufWriter<io::StdoutLock<'static>>;

impl Rows {
    fn begin(format: FormatArg, columns: &[String]) -> io::Result<Self> {
        let mut out = BufWriter::new(io::stdout().lock());
        match format {
            FormatArg::Json => TraceDocument::begin(out, columns).map(Rows::Json),
            FormatArg::Text | FormatArg::Csv | FormatArg::CsvSemicolon => {
                let separators = format.separators();
                let header = columns.iter().join(&separators.between_fields().to_string());
                writeln!(out, "{}{header}", separators.mark())?;
                Ok(Rows::Csv(out, separators))
            }
        }
    }

    fn row(&mut self, row: &[f64]) -> io::Result<()> {
        match self {
            Rows::Csv(out, separators) => {
                let numbers = row.iter().map(|&number| separators.number(number));
                writeln!(
                    out,
                    "{}",
                    numbers.collect::<Vec<_>>().join(&separators.between_fields().to_string())
                )
            }
            Rows::Json(document) => document.row(row),
        }
    }

    fn end(self) -> io::Result<()> {
        match self {
            Rows::Csv(mut out, _) => out.flush(),
            Rows::Json(document) => document.end(),
        }
    }
}

fn choose(scene: &Scene, arguments: &Arguments) -> Result<TracedItems, String> {
    let tires = arguments.tire.iter().map(|text| find_tire(scene, text)).collect::<Result<_, _>>()?;
    let cables = arguments.cable.iter().map(|text| find_cable(scene, text)).collect::<Result<_, _>>()?;
    Ok(TracedItems { tires, cables })
}

fn find_tire(scene: &Scene, text: &str) -> Result<usize, String> {
    let numbers: Result<Vec<f64>, _> = text.split([',', ':']).map(|part| part.trim().parse()).collect();
    let numbers = numbers.map_err(|_| format!("'{text}' is no tire: write ROW,COLUMN such as 2,3"))?;
    let found = scene.tire_ids.iter().position(|id: &TireId| id.numbers() == numbers);
    let last = scene.tire_ids.last().map_or_else(String::new, TireId::to_string);
    found.ok_or_else(|| format!("no tire {text} in this shelter, whose last is {last}"))
}

fn find_cable(scene: &Scene, text: &str) -> Result<usize, String> {
    let (from, to) = text
        .split_once('-')
        .ok_or_else(|| format!("'{text}' is no cable: write its two tires, such as 1,1-1,2"))?;
    let ends = [find_tire(scene, from)?, find_tire(scene, to)?];
    let joins = |cable: &[usize; 2]| *cable == ends || *cable == [ends[1], ends[0]];
    let found = scene.cables.iter().position(|cable| joins(&cable.ends));
    found.ok_or_else(|| format!("no cable between tires {from} and {to}"))
}
