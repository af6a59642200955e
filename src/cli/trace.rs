//! `shelter trace`: time histories of one option.

use std::io::{self, BufWriter, Write};
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::Instant;

use clap::Args;

use super::arguments::{Compute, FormatArg, Look, positive};
use super::load_plans::open_option;
use super::status::{Status, wrong};
use crate::report;
use crate::scene::{Scene, TireId, seconds};
use crate::simulation::{Failure, Settings};
use crate::study::check::start_step;
use crate::study::trace::{Chosen, trace};

#[derive(Args)]
pub struct Arguments {
    /// Plan to trace
    plan: PathBuf,
    /// Name of the delay option; default: the first
    #[arg(long, value_name = "NAME")]
    option: Option<String>,
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
    compute: Compute,
}

pub fn run(arguments: &Arguments, look: &Look) -> io::Result<Status> {
    let Some((case, option)) = open_option(&arguments.plan, arguments.option.as_deref(), look) else {
        return Ok(Status::Wrong);
    };
    let mut chosen = match chosen(case.scene(), arguments) {
        Ok(chosen) => chosen,
        Err(message) => return wrong(&message),
    };
    let compute = arguments.compute.settings(&case.plan);
    let settings = Settings {
        method: compute.method,
        step: compute.step.unwrap_or_else(|| start_step(&case, compute.method, compute.accuracy)),
        duration: case.plan.simulation.duration_s,
    };
    let (begun, timeout) = (Instant::now(), arguments.compute.timeout);
    let in_time = || match timeout {
        Some(timeout) if begun.elapsed().as_secs_f64() > timeout => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    };
    if chosen == Chosen::default() {
        match case.model.run(&case.shots[option], &settings, &mut |_| in_time()) {
            Ok(outcome) => chosen = Chosen::of(&outcome),
            Err(failure) => return failed(&failure),
        }
    }
    let mut rows = Rows::begin(arguments.format, report::trace::header(case.scene(), &chosen))?;
    let every = arguments.every.map_or(settings.step, seconds);
    let mut written = Ok(());
    let done = trace(&case, option, &settings, &chosen, every, &mut |row| {
        written = rows.row(row);
        if written.is_ok() { in_time() } else { ControlFlow::Break(()) }
    });
    written?;
    rows.end()?;
    done.map_or_else(|failure| failed(&failure), |_| Ok(Status::Pass))
}

fn failed(failure: &Failure) -> io::Result<Status> {
    if let Failure::Stopped { at } = failure {
        eprintln!("the time was up at {at:.3} s of the motion");
        return Ok(Status::Fail);
    }
    wrong(&report::no_result::message(&failure.clone().into()))
}

/// Writes rows as they come.
struct Rows {
    out: BufWriter<io::StdoutLock<'static>>,
    json: bool,
    first: bool,
}

impl Rows {
    fn begin(format: FormatArg, header: Vec<String>) -> io::Result<Self> {
        let mut out = BufWriter::new(io::stdout().lock());
        let json = matches!(format, FormatArg::Json);
        if json {
            let columns = serde_json::to_string(&header)?;
            write!(out, "{{ \"schema\": \"shelter.trace/1\", \"columns\": {columns}, \"rows\": [")?;
        } else {
            writeln!(out, "{}", header.join(","))?;
        }
        Ok(Self { out, json, first: true })
    }

    fn row(&mut self, row: &[f64]) -> io::Result<()> {
        let cells: Vec<String> = row.iter().map(f64::to_string).collect();
        if self.json {
            let comma = if self.first { "" } else { "," };
            write!(self.out, "{comma}\n  [{}]", cells.join(", "))?;
        } else {
            writeln!(self.out, "{}", cells.join(","))?;
        }
        self.first = false;
        Ok(())
    }

    fn end(mut self) -> io::Result<()> {
        if self.json {
            writeln!(self.out, "\n] }}")?;
        }
        self.out.flush()
    }
}

fn chosen(scene: &Scene, arguments: &Arguments) -> Result<Chosen, String> {
    let tires = arguments.tire.iter().map(|text| find_tire(scene, text)).collect::<Result<_, _>>()?;
    let cables = arguments.cable.iter().map(|text| find_cable(scene, text)).collect::<Result<_, _>>()?;
    Ok(Chosen { tires, cables })
}

fn find_tire(scene: &Scene, text: &str) -> Result<usize, String> {
    let numbers: Result<Vec<f64>, _> = text.split([',', ':']).map(|part| part.trim().parse()).collect();
    let numbers = numbers.map_err(|_| format!("'{text}' is no tire: write ROW,COLUMN such as 2,3"))?;
    let found = scene.tire.iter().position(|id: &TireId| id.numbers() == numbers);
    let last = scene.tire.last().map_or_else(String::new, TireId::to_string);
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
