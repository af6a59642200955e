//! Arguments that commands share, and the parsers of their values.

use std::str::FromStr;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};

use crate::choice::{Accuracy, Method, UnknownName};
use crate::plan::Plan;
use crate::plan::Time;
use crate::report::csv::Separators;
use crate::report::language::Language;
use crate::report::text::Style;
use crate::study::samples::sample_count::Sampling;
use crate::study::{ComputeSettings, Intervals, Shard};

/// How to compute.
#[derive(Args, Clone)]
pub struct ComputeArguments {
    /// How exact to compute: draft is fastest, reference most exact
    #[arg(long, value_parser = named::<Accuracy>(Accuracy::NAMES))]
    pub accuracy: Option<Accuracy>,
    /// Integrate by verlet, fast and explicit, or by newmark, the method of the source paper
    #[arg(long, value_parser = named::<Method>(Method::NAMES))]
    pub method: Option<Method>,
    /// Take exactly this time step and refine nothing
    #[arg(long, value_name = "SECONDS", value_parser = positive, allow_negative_numbers = true)]
    pub dt: Option<f64>,
    /// Compute on N threads; default: one per core
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// End after this time; print the results computed by then
    #[arg(long, value_name = "SECONDS", value_parser = positive, allow_negative_numbers = true)]
    pub timeout: Option<f64>,
}

impl ComputeArguments {
    /// Settings of the plan. The command line overrides them.
    pub fn settings(&self, plan: &Plan) -> ComputeSettings {
        let asked = ComputeSettings::of(plan);
        ComputeSettings {
            method: self.method.unwrap_or(asked.method),
            accuracy: self.accuracy.unwrap_or(asked.accuracy),
            step: self.dt,
        }
    }
}

/// How output looks.
#[derive(Args, Clone)]
pub struct LookArguments {
    /// ASCII characters only, for poor fonts
    #[arg(long, global = true)]
    pub ascii: bool,
    /// Words and numbers only, for screen readers and old consoles: no charts, no sparklines, ASCII; a plan is printed as `check`
    /// does
    #[arg(long, global = true)]
    pub plain: bool,
    /// Colour; `auto` obeys NO_COLOR
    #[arg(long, value_enum, default_value = "auto", global = true)]
    pub color: ColorArg,
}

impl LookArguments {
    /// Style of text on a stream that is, or is not, a terminal.
    pub fn style(&self, terminal: bool) -> Style {
        let ascii = self.ascii || self.plain || terminal && !shows_unicode();
        // Zero columns: the terminal does not report its width.
        let size = terminal.then(crossterm::terminal::size).and_then(Result::ok);
        let width = size.map(|(columns, _)| usize::from(columns)).filter(|&columns| columns > 0);
        Style { ascii, color: self.colored(terminal) && !self.plain, plain: self.plain, width }
    }

    /// Whether text is coloured on a stream that is, or is not, a terminal.
    pub fn colored(&self, terminal: bool) -> bool {
        match self.color {
            ColorArg::Always => true,
            ColorArg::Never => false,
            ColorArg::Auto => {
                let refused = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
                terminal && !refused && shows_colors()
            }
        }
    }
}

/// Whether the terminal shows more than ASCII, by its name and the locale.
fn shows_unicode() -> bool {
    let set = |name: &str| std::env::var(name).ok().filter(|value| !value.is_empty());
    let locale = ["LC_ALL", "LC_CTYPE", "LANG"].into_iter().find_map(set);
    let utf8 = |locale: String| locale.to_lowercase().replace('-', "").contains("utf8");
    set("TERM").as_deref() != Some("dumb") && locale.is_none_or(utf8)
}

/// Whether the terminal understands codes for colours. Old Windows consoles print the codes as text, until the program turns the codes on.
fn shows_colors() -> bool {
    #[cfg(windows)]
    return crossterm::ansi_support::supports_ansi();
    #[cfg(not(windows))]
    true
}

/// When output is coloured.
#[derive(Clone, Copy, ValueEnum)]
pub enum ColorArg {
    Auto,
    Always,
    Never,
}

/// Format of printed results.
#[derive(Clone, Copy, Default, ValueEnum)]
pub enum FormatArg {
    #[default]
    Text,
    Json,
    Csv,
    /// For spreadsheets where 0,5 is one half: semicolons, decimal commas, a byte order mark
    CsvSemicolon,
}

impl FormatArg {
    /// Separators between the fields of CSV.
    pub fn separators(self) -> Separators {
        match self {
            FormatArg::CsvSemicolon => Separators::Semicolon,
            FormatArg::Text | FormatArg::Json | FormatArg::Csv => Separators::Comma,
        }
    }
}

/// Language of the page.
#[derive(Clone, Copy, Default, ValueEnum)]
pub enum LangArg {
    /// English
    #[default]
    En,
    /// Russian
    Ru,
}

impl From<LangArg> for Language {
    fn from(lang: LangArg) -> Self {
        match lang {
            LangArg::En => Language::English,
            LangArg::Ru => Language::Russian,
        }
    }
}

/// How many samples, from which seed.
#[derive(Args, Clone, Copy)]
pub struct SamplingArguments {
    /// Draw at most N samples of each option
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000_000))]
    samples: Option<u32>,
    /// Draw other samples: seed of the random numbers; default: 1
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    seed: Option<u64>,
}

impl SamplingArguments {
    /// The samples for a verdict, within the bounds of the command line.
    pub fn of_verdict(self) -> Sampling {
        let usual = Sampling::OF_VERDICT;
        let most = self.samples.map_or(usual.most, |samples| samples as usize);
        Sampling { least: usual.least.min(most), most, seed: self.seed.unwrap_or(usual.seed), ..usual }
    }

    /// Exactly the requested number of samples for every option; `usual` if the command line requests none.
    pub fn exactly(self, usual: usize) -> Sampling {
        let samples = self.samples.map_or(usual, |samples| samples as usize);
        Sampling::exactly(samples, self.seed.unwrap_or(Sampling::OF_VERDICT.seed))
    }
}

/// Whether what is not known counts, and how it is sampled.
#[derive(Args, Clone, Copy)]
pub struct VerdictArguments {
    /// Judge the planned shot alone and vary nothing: no permission to fire
    #[arg(long, conflicts_with_all = ["samples", "seed"])]
    nominal: bool,
    #[command(flatten)]
    sampling: SamplingArguments,
}

impl VerdictArguments {
    /// The samples for a verdict; `None` if only the planned shot counts.
    pub fn sampling(self) -> Option<Sampling> {
        (!self.nominal).then(|| self.sampling.of_verdict())
    }

    /// Exactly the requested number of samples for every option, or `usual`; `None` if only the planned shot counts.
    pub fn exactly(self, usual: usize) -> Option<Sampling> {
        (!self.nominal).then(|| self.sampling.exactly(usual))
    }
}

/// What every study of a plan takes.
#[derive(Args, Clone)]
pub struct StudyArguments {
    #[command(flatten)]
    pub verdict: VerdictArguments,
    /// Output format
    #[arg(long, value_enum, default_value = "text")]
    pub format: FormatArg,
    #[command(flatten)]
    pub compute: ComputeArguments,
}

/// A parser for the names of a choice. The help lists the names.
pub fn named<T>(names: &'static [&'static str]) -> impl TypedValueParser<Value = T>
where
    T: FromStr<Err = UnknownName> + Clone + Send + Sync + 'static,
{
    PossibleValuesParser::new(names).try_map(|name| name.parse())
}

/// A finite number above 0.
pub fn positive(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err("must be a positive number".to_owned()) }
}

/// Parses `FROM..TO:STEP` in milliseconds.
pub fn intervals(text: &str) -> Result<Intervals, String> {
    let wrong = || format!("'{text}' is no range of intervals: write FROM..TO:STEP in ms, such as 0..500:5");
    let (range, step) = text.split_once(':').ok_or_else(wrong)?;
    let (from, to) = range.split_once("..").ok_or_else(wrong)?;
    let time = |text: &str| match text.trim().parse::<f64>() {
        Ok(ms) if (0.0..=1e9).contains(&ms) => Ok(Time::from_ms(ms)),
        _ => Err(wrong()),
    };
    let intervals = Intervals { from: time(from)?, to: time(to)?, step: time(step)? };
    let Intervals { from, to, step } = intervals;
    if to < from || step == Time::ZERO {
        return Err(wrong());
    }
    if (to - from).steps(step) > 100_000 {
        return Err(format!("'{text}' is more than 100,000 intervals: take a longer step"));
    }
    Ok(intervals)
}

/// Parses `I/N`. I counts from 1.
pub fn shard(text: &str) -> Result<Shard, String> {
    let wrong = || format!("'{text}' is no shard: write I/N, such as 1/4 to 4/4");
    let (number, count) = text.split_once('/').ok_or_else(wrong)?;
    let [number, count] = [number, count].map(|text| text.trim().parse::<usize>().map_err(|_| wrong()));
    let (number, count) = (number?, count?);
    if number == 0 || number > count {
        return Err(wrong());
    }
    Ok(Shard { index: number - 1, count })
}
