//! Which blasting delay keeps a shelter of tires and cables within its limits: simulated, with its numerical error.
//!
//! # From a plan to a verdict
//!
//! ```
//! use shelter::{Case, ComputeSettings, Context, Plan, StudyControl, Sampling, Verdict};
//!
//! let text = r#"
//! shelter = { layout = "grid", rows = 2, columns = 3, spacing_m = 1.5 }
//! tire = { mass_kg = 280 }
//! cable = { axial_stiffness_kn = 1400, breaking_force_kn = 40 }
//! ground = { friction = 0.5 }
//! blast_row = [{ name = "1", under_row = 1, launch_m_s = 5 }, { name = "2", under_row = 2, launch_m_s = 5 }]
//! limits = { flight_height_m = 1.5, cable_safety_factor = 1.5 }
//! delay = [{ name = "20 ms", interval_ms = 20 }]
//! "#;
//! let case = Case::new(Plan::parse("plan.toml", text)?);
//! let compute = ComputeSettings::of(&case.plan);
//! // The shot as planned alone:
//! let checked = case.check_as_planned(0, &compute)?;
//! let height = checked.estimates.height;
//! assert!(height.value + height.error < 1.5);
//! // The verdict of `shelter check`, which also samples what the plan does not know:
//! let control = StudyControl::default();
//! let found = Context::new(&case, compute, &control).with_sampling(Sampling::OF_VERDICT).judge_options()?;
//! assert_eq!(found.value[0].as_ref().map(|judged| judged.verdict()), Ok(Verdict::Pass));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The library alone, without command line, terminal and charts: `default-features = false`. The programs in `examples/`
//! check a plan, sweep an interval, step through a motion and build a shelter without a plan. The library may change between any
//! two versions; what stays is said in CHANGELOG.md.
//!
//! # Map of the modules
//!
//! One way in, one way through, here for `check`; a sweep, orders and search keep of each shot a summary (`ShotSummary`,
//! `RiskSummary`) where `check` keeps a judgement:
//!
//! ```text
//! TOML ─▶ Plan ─▶ Case (Scene, Shots) ─▶ Model::run ─▶ Outcome ─▶ CheckedShot ─▶ Judgement ─▶ Report ─▶ every face
//!         plan     study   scene          simulation    outcome    study          study        report    report, tui
//! ```
//!
//! | module | what comes in | what goes out | what it must not know |
//! |---|---|---|---|
//! | [`sorting`] | elements | the same, sorted | any other module |
//! | [`units`] | SI numbers | words | any other module |
//! | [`file`] | a text | a file, whole or not at all | any other module; the meaning of the text |
//! | [`choice`] | a name | method, accuracy level and other named choices of a plan | any other module; the effect of a choice |
//! | [`ropes`] | a data file | the rope catalogue | any other module |
//! | [`plan`] | TOML | a valid [`Plan`], or every mistake with its remedy | how a shelter moves |
//! | [`scene`] | a plan | masses, cables, firings as flat SI arrays | [`ropes`]; how motion is computed |
//! | [`outcome`] | | peaks, ledger, histories of a run | any other module |
//! | [`simulation`] | scene, shot, step | an [`Outcome`](outcome::Outcome) or a [`RunError`](simulation::RunError) | [`plan`], [`ropes`], [`file`], [`units`]; options, limits, screens |
//! | [`verdict`] | value, error, limit | pass, fail, undecided | any other module |
//! | [`study`] | a plan made ready | verdicts refined until sure; sweeps, orders, searches and other studies | formats, except those of its results (`study::results_file`, in the lines of `study::work::journal`) and of what was seen (`study::observed::record_file`) |
//! | [`report`] | study results | text, JSON, CSV, a page of HTML | terminals |
//! | [`jobs`] | a check to begin, or a question | news: progress, results; the newest request of a kind wins | [`report`]; screens |
//! | [`kept`] | edits, and what was told of earlier shots | the same at the next start, and for every command | [`report`], [`jobs`]; screens |
//! | [`tui`] | keys and events | a screen | physics |
//! | [`cli`] | the command line | an exit status | physics |
//!
//! What integrates is a crate of its own, `engine`: [`outcome`], [`simulation`], the types of [`scene`], and the choice of the method.
//! It is optimized as one piece; this crate builds in several.
//!
//! A module may use the modules above it in this table, except those linked under "what it must not know". The test `layers`
//! reads both from here and holds them. The command line and the terminal are two ways to ask the same
//! [`Question`](study::question::Question), which `report` words in one place. Of `check`, `jobs` calls the very functions that
//! `shelter check` calls, and tells what comes of each option as it comes.
//!
//! # Rules
//!
//! - The [`Scene`](scene::Scene) of a case is never changed, and what moves lives in a stepper. A sample, and a `newmark` run in
//!   which cables break, change a copy.
//! - Plan units become SI where a plan becomes a [`Case`]: scene, shots and limits. What a study changes in the plan itself keeps
//!   the units of its keys: `[uncertainty]` until samples are drawn, the intervals of a search, the changes of `remedies`.
//!   Screens that quote the plan show its own numbers; SI becomes words in `units`.
//! - What goes wrong in a run is a value, never a panic and never a pass. Functions that take the index of an option panic where
//!   there is no such option.
//! - The same plan gives the same numbers for any number of threads.
//!
//! # Words
//!
//! ```text
//! from above                                from the side, 20 ms after row 1 has fired
//!
//! shelter row 3   O───O───O───O                     O   launched, in the air
//!                 │ ╳ │ ╳ │ ╳ │                   ╱   ╲   taut cables: longer than they were laid, they pull
//! shelter row 2   O───O───O───O  over row 2     O       O───O   O   at rest: their cables are slack
//!                 │ ╳ │ ╳ │ ╳ │              ▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔
//! shelter row 1   O───O───O───O  over row 1      ·   ·   ·   ·   ·   holes in the ground
//!     O tire   ─ │ ╳ cables
//! ```
//!
//! | word | meaning |
//! |---|---|
//! | blast row | holes that a delay option fires as one group, together or one after another; each launches the tire over it |
//! | delay option | the *interval* between blast rows, and their *order* |
//! | shelter | tires (point masses) tied by *cables* that only pull: *taut* or *slack*; a tire on the ground *sticks* or *slips* |
//! | shot | one firing of all holes: which tire is launched when, and how fast |
//! | scene | the shelter itself: masses, cables, ground |
//! | case | a plan made ready: its scene, one shot for each option, its limits |
//! | peak, drift | the greatest height or force of a run; how far a tire ends from where it lay |
//! | utilization | the greatest value over its limit |
//! | checked shot | the shot as planned, run at the steps of a *ladder*, each finer than the one before, until its verdict is sure ([`CheckedShot`]); the *summary* keeps verdict, height, force and drift ([`ShotSummary`](study::ShotSummary)) |
//! | sample | one of the shots that are possible: drawn at random as `[uncertainty]` says, and run |
//! | sampling | how many samples are drawn, from which seed, and when to stop |
//! | sampled shot | all samples of a shot, and what they tell ([`SampledShot`](study::samples::sampled_shot::SampledShot)); its *risk* is the share that fails, with bounds |
//! | audit | some samples run again at a finer step |
//! | deciding | of the samples what only the accepted share of them exceeds, by default one in a hundred: a value, the sample that has it, its cables. On screens "1 in 100 is above" |
//! | judgement | checked shot and sampled shot together |
//! | nominal | as planned, nothing varied |
//! | undecided | neither pass nor fail is sure; OPEN on screens |
//! | quick check | a coarse check of one shot among thousands |
//! | launch margin | how much faster the tires may leave until the shot as planned fails |
//! | input | something that `[uncertainty]` lets vary; an *unknown* is one that a fit may estimate, a *parameter* an unknown of one blast row or of all |
//! | remedy | a change of the plan with which an option would pass |
//! | question | what a user can ask, with its settings: the command line, the terminal, a file of `--save` and a shard hold the same ([`Question`](study::question::Question)) |
//! | context | what every study is handed: case, sampling, settings, and a control that tells progress and stops ([`Context`]) |
//! | shard, journal | one machine's part of a study; what a study has computed, kept in a file by `--save` |
//! | check | of one shot: as planned; the *command* `check` judges every option |
//! | ground | one of four things that a verdict on a shot rests on: the planned shot, its samples, one dud, fresh draws ([`Ground`](study::judge::grounds::Ground)) |
//! | evidence | what a ground tells: not asked for, awaited, or known ([`Evidence`](study::judge::grounds::Evidence)) |
//! | observation | one value of an earlier shot, from a film or a gauge, with its standard deviation |
//! | record | the observations of a plan that were typed in the terminal or read from a file there; it lies beside the plan ([`ObservationRecord`](study::observed::ObservationRecord)) |
//! | comparison | the plan beside observations of earlier shots: what speaks against it, its *objections*, and why something was not compared ([`Comparison`](study::observed::Comparison)) |
//! | standing | what speaks against a plan beside its verdicts: its file, its title, its `[uncertainty]`, its comparison ([`Standing`](study::standing::Standing)) |
//! | doubt | why an option may not be fired, though it may pass ([`Doubt`](study::standing::Doubt)) |
//! | hold | a doubt that takes every pass of a plan back; the option reads HOLD ([`Hold`](study::standing::Hold)) |
//! | thin | of a pass: 5 % faster launches end it, or 2 cm more of a length, or one dud ([`ThinPass`](study::standing::verdict_word::ThinPass)) |
//! | report, page | the result of a study as data, which every face draws; the *page* is the HTML for the blast file, which the command `report` writes |
//! | face | one way to show results: text, CSV, JSON, page and terminal draw reports; the table and detail of Compare draw judgements as they come |
//!
//! A word in brackets behind a field, such as (`n_tires`), is its length.

// Both panic where the stream is gone; `cli::tell` does not.
#![deny(clippy::print_stderr, clippy::print_stdout)]

pub mod choice;
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod cli;
pub mod file;
pub mod jobs;
#[cfg(feature = "tui")]
#[doc(hidden)]
pub mod kept;
pub mod plan;
pub mod report;
pub mod ropes;
pub mod scene;
pub mod sorting;
pub mod study;
#[cfg(feature = "tui")]
#[doc(hidden)]
pub mod tui;
pub mod units;
pub mod verdict;

pub use plan::Plan;
pub use shelter_engine::{outcome, simulation};
pub use simulation::{Model, Motion, RunSettings};
pub use study::as_planned::check::{CheckedShot, check_as_planned};
pub use study::judge::Judgement;
pub use study::judge::batch::{Depth, judge};
pub use study::samples::sample_count::Sampling;
pub use study::{Case, ComputeSettings, Context, StudyControl};
pub use verdict::Verdict;
