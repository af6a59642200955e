//! An app on a test terminal: what the tests of screens and keys share.

use std::sync::Arc;
use std::time::Duration;

use crossterm::event::{Event, KeyCode, KeyEvent, KeyModifiers};
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use ratatui::buffer::Buffer;
use shelter::choice::{Accuracy, Method};
use shelter::jobs::News;
use shelter::outcome::{EndReason, History, RunEnd};
use shelter::plan::{HoleTiming, Time};
use shelter::report::words::headline::{self, Headline};
use shelter::ropes::catalogue;
use shelter::study::accuracy::{AccuracyTable, LevelStep, Measured, StepRow};
use shelter::study::as_planned::check::CheckedShot;
use shelter::study::as_planned::cover::Cover;
use shelter::study::as_planned::shot_reason::ShotReason;
use shelter::study::fit::observed_shots::ObservedShots;
use shelter::study::fit::{Answer, ComparedWithObservations, Fit, FitResult};
use shelter::study::judge::batch::Depth;
use shelter::study::judge::brief_judgement::BriefJudgement;
use shelter::study::judge::deciding_shot::{DecidingSamples, DecidingShot, DecidingShots};
use shelter::study::judge::grounds::{Evidence, Grounds};
use shelter::study::judge::one_dud::OneDud;
use shelter::study::judge::{Judgement, Part};
use shelter::study::orders::{Orders, TriedOrder};
use shelter::study::question::{Found, StudyKind};
use shelter::study::risk::Risks;
use shelter::study::samples::failure_bounds::ErrorShare;
use shelter::study::samples::sample::{Sample, SampleRun};
use shelter::study::samples::sample_count::Sampling;
use shelter::study::samples::sampled_shot::SampledShot;
use shelter::study::size::{Combination, Sizing, Trial, WorstShotRisk};
use shelter::study::sweep::{Point, Recommended, Sweep};
use shelter::study::trace::DrawnSample;
use shelter::study::{Case, ComputeSettings, Computed, Context, NoResult, flight};
use shelter::study::{ShotSummary, ValueWithError};
use shelter::tui::app::{App, Areas, Request};
use shelter::tui::compare::OptionState;
use shelter::tui::config::Config;
use shelter::tui::{dispatch, view};
use shelter::verdict::{Estimate, PerQuantity, Quantity, Verdict};
use tempfile::TempDir;

use super::tested_plan;

pub fn app() -> App {
    let path = tested_plan("amur-three-rows.toml");
    let mut case = Case::load(path.as_ref()).expect("a shipped plan");
    case.source.path = "plans/amur-three-rows.toml".into();
    let compute = ComputeSettings::of(&case.plan);
    App::new(Arc::new(case), compute, &Config::default())
}

/// A result with round numbers, so that a snapshot changes with the screen and not with the physics.
pub fn checked(verdict: Verdict) -> CheckedShot {
    let wave = |n: usize| (n as f64 * 0.05).sin().abs();
    let estimate = |value, error, time, index| Estimate { value, error, time, index };
    let force = estimate(61_234.0, 45.0, 0.123, 3);
    let limit = ShotReason::Limit { quantity: Quantity::Force, verdict, estimate: force, limit: 61_019.0 };
    CheckedShot {
        launch_is_estimated: false,
        broken: Vec::new(),
        verdict,
        reasons: if verdict == Verdict::Pass { Vec::new() } else { vec![limit] },
        estimates: PerQuantity {
            height: estimate(1.2345, 0.0012, 0.456, 7),
            force,
            drift: estimate(0.321, 0.01, 1.3, 9),
        },
        safety_factor: 1.49,
        cover: Cover::NONE,
        history: History {
            width: 0.005,
            height: (0..200).map(wave).collect(),
            force: (0..200).map(|n| 61_234.0 * wave(3 * n)).collect(),
        },
        compute: ComputeSettings { method: Method::Verlet, accuracy: Accuracy::Field, step: None },
        step: 5e-4,
        steps: 2000,
        energy_residual: 3e-5,
        end: RunEnd { time: 1.3, reason: EndReason::AtRest },
        wall: Duration::from_millis(2),
        total_wall: Duration::from_millis(6),
        runs: 4,
        total_steps: 5000,
    }
}

/// Round samples, of which none fails or one in ten.
pub fn samples(case: &Case, count: usize, some_fail: bool) -> SampledShot {
    let mut risk = SampledShot::new(case, None, ErrorShare::Whole, false);
    for number in 0..count {
        let part = number as f64 / count as f64;
        let fails = some_fail && number % 10 == 3;
        risk.push(Sample {
            number,
            run: SampleRun {
                verdict: if fails { Verdict::Fail } else { Verdict::Pass },
                uncovering: 0.0,
                breaks: Verdict::Pass,
                height: 1.1 + 0.2 * part,
                force: 50e3 + 10e3 * part * part,
                tire: 12,
                cable: 0,
                drift: 0.3,
            },
            finer: None,
            inputs: [part, 0.5, 2.0, 1.0, 1.0, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0],
        });
    }
    risk
}

/// A judgement with 200 samples, of which one in ten fails in every second option.
pub fn judgement(case: &Case, option: usize) -> Judgement {
    let verdict = if option.is_multiple_of(3) { Verdict::Fail } else { Verdict::Pass };
    let sampled = samples(case, 200, option.is_multiple_of(2));
    Judgement { sampled: Evidence::Known(sampled), ..Judgement::of_planned_alone(checked(verdict)) }
}

/// The judgement on an option as it begins: checked as planned, and nothing else.
pub fn begun(case: &Case, verdict: Verdict) -> Result<Box<Judgement>, NoResult> {
    Ok(Box::new(Depth::Full.begin(case, checked(verdict))))
}

/// An option that passes with any one hole left out.
pub fn withstood_dud() -> Part {
    let planned = ShotSummary::of(&checked(Verdict::Pass));
    let one_dud =
        OneDud { row: 0, number: 0, planned, not_passing: 0, failing: 0, places: 15, sampled: None };
    Part::Dud { one_dud: Some(Box::new(one_dud)), next_tires: None, turned_height: None }
}

/// Shots that decide, both the same, higher and harder than the shot as planned; past the limit of force where that fails.
pub fn deciding(case: &Case, option: usize) -> DecidingShots {
    let History { width, height, force } = checked(Verdict::Pass).history;
    let harder = |values: Vec<f64>, factor: f64| {
        let fades = |(n, value): (usize, f64)| factor * value * (1.0 - n as f64 / 400.0);
        values.into_iter().enumerate().map(fades).collect()
    };
    let sample = DrawnSample { seed: Sampling::OF_VERDICT.seed, number: 7, step_halvings: 0 };
    let shot = DecidingShot {
        sample,
        shot: case.shots[option].clone(),
        history: History {
            width,
            height: harder(height, 1.3),
            force: harder(force, if option.is_multiple_of(3) { 1.5 } else { 1.1 }),
        },
    };
    let samples = DecidingSamples { of_any: sample, height: sample, force: sample };
    DecidingShots { samples, height: shot.clone(), force: shot }
}

/// A judged option.
pub fn done(judgement: Judgement, more_samples: bool) -> OptionState {
    OptionState::Judged { judgement: Box::new(judgement), more_samples }
}

/// Every option with its samples: one passes, one needs more samples, five fail or are undecided as planned.
pub fn finished() -> App {
    let mut app = app();
    let verdicts = [Verdict::Fail, Verdict::Pass, Verdict::Undecided];
    for (n, row) in app.options.iter_mut().enumerate() {
        let sampled =
            if n == 4 { samples(&app.case, 500, false) } else { samples(&app.case, 200, n % 2 == 0) };
        let nominal = Judgement::of_planned_alone(checked(verdicts[n % 3]));
        let deciding = Some(deciding(&app.case, n));
        *row = done(Judgement { sampled: Evidence::Known(sampled), deciding, ..nominal }, false);
    }
    app
}

/// Recommends an option of the plan, as all that was judged would.
pub fn recommend(app: &mut App, option: usize) {
    app.answer = Some(Headline::Recommends(headline::Recommended {
        option,
        name: app.case.plan.delays[option].name.clone(),
        unchecked: headline::unchecked(&app.case),
        among: ", the only one of 7".to_owned(),
        thin: None,
        inputs_hold: headline::inputs_hold(&app.case),
        assumed: 0,
        one_in: "100".to_owned(),
    }));
}

/// Puts the plan into a file, as it is where somebody saved it.
pub fn save(app: &mut App) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("plan.toml");
    std::fs::write(&path, &app.case.source.text).expect("written");
    Arc::make_mut(&mut app.case).source.path = path.to_path_buf();
    folder
}

pub fn draw(app: &App, width: u16, height: u16) -> Buffer {
    let mut terminal = Terminal::new(TestBackend::new(width, height)).expect("a test terminal");
    terminal.draw(|frame| drop(view::draw(app, frame))).expect("drawn");
    terminal.backend().buffer().clone()
}

/// Areas of the screen and what a click on each does.
pub fn draw_areas(app: &App, width: u16, height: u16) -> Areas {
    let mut terminal = Terminal::new(TestBackend::new(width, height)).expect("a test terminal");
    let mut areas = Areas::new();
    terminal.draw(|frame| areas = view::draw(app, frame)).expect("drawn");
    areas
}

pub fn text(buffer: &Buffer) -> String {
    let lines = buffer.content.chunks(usize::from(buffer.area.width));
    let line = |cells: &[ratatui::buffer::Cell]| {
        let line: String = cells.iter().map(ratatui::buffer::Cell::symbol).collect();
        line.trim_end().to_owned()
    };
    lines.map(line).collect::<Vec<_>>().join("\n")
}

pub fn key(app: &mut App, code: KeyCode) -> Request {
    dispatch(app, &Event::Key(KeyEvent::new(code, KeyModifiers::NONE)))
}

/// A study has ended, computed with the settings of the screen.
pub fn study_ends(app: &mut App, kind: StudyKind, result: Result<Found, NoResult>) {
    let compute = app.compute;
    app.take_news(News::Studied { kind, compute, result });
}

/// What a study found in time.
fn found<T>(kind: impl FnOnce(Box<Computed<T>>) -> Found, value: T) -> Found {
    kind(Box::new(Computed::complete(value)))
}

/// A comparison in which nothing was seen.
pub fn nothing_seen() -> ComparedWithObservations {
    ComparedWithObservations {
        fitted: None,
        new: Vec::new(),
        files: Vec::new(),
        seen: ObservedShots::new(&[]),
        predictions: Vec::new(),
        is_sampled: false,
    }
}

/// What a fit found that settled without a value.
pub fn fitted() -> ComparedWithObservations {
    let answers = vec![Answer { is_converged: true, ..Answer::default() }];
    let fit = Fit { answers, ..Fit::default() };
    ComparedWithObservations { fitted: Some(FitResult::Fitted(fit)), ..nothing_seen() }
}

/// A sweep with round numbers.
pub fn swept(case: &Case) -> Found {
    let point = |n: usize| {
        let share = (n as f64 * 0.3).sin().abs();
        let verdict = if share < 0.8 { Verdict::Pass } else { Verdict::Fail };
        let height = ValueWithError { value: 2.0 * share, error: 0.01 };
        let force = ValueWithError { value: 76_000.0 * share, error: 250.0 };
        Point {
            interval: Time::from_ms(10.0) * n as i64,
            judged: BriefJudgement::of_planned_alone(
                case,
                ShotSummary {
                    verdict,
                    values: PerQuantity { height, force, drift: ValueWithError::default() },
                    cover: Cover::NONE,
                },
            ),
            is_quick: false,
        }
    };
    let windows = [[0, 3], [8, 13], [18, 24], [29, 34], [39, 44], [50, 50]];
    let windows = windows.map(|window| window.map(|n| Time::from_ms(10.0) * n)).to_vec();
    let (interval, room) = (Time::from_ms(210.0), Time::from_ms(10.0));
    let recommended = Some(Recommended { interval, room, utilization: 0.2, thin: None });
    found(
        Found::Sweep,
        Sweep {
            order: vec![0, 1, 2],
            holes: HoleTiming::TOGETHER,
            points: (0..51).map(point).collect(),
            windows_as_planned: windows.clone(),
            windows,
            recommended,
            failed_full_verdict: 0,
        },
    )
}

/// What accuracy costs, with round numbers.
pub fn measured() -> Found {
    let levels = [(Accuracy::Draft, 8e-4), (Accuracy::Field, 4e-4), (Accuracy::Reference, 1e-4)]
        .map(|(level, step)| LevelStep { level, step });
    let row = |n: i32, method: Method| {
        let part = 0.5_f64.powi(n);
        let cost = if method == Method::Verlet { 1.0 } else { 50.0 };
        StepRow {
            method,
            step: 8e-4 * part,
            result: Some(Measured {
                steps: 1000 << n,
                height: 1.7,
                force: 60e3,
                drift: 0.4,
                height_error: 1e-4 * part * part,
                force_error: 5e-4 * part * part,
                drift_error: 2e-4 * part * part,
                energy_residual: 1e-5,
                wall: Duration::from_micros((400.0 * cost / part) as u64),
            }),
        }
    };
    let rows =
        [Method::Verlet, Method::Newmark].iter().flat_map(|&method| (0..6).map(move |n| row(n, method)));
    let table =
        AccuracyTable { option: 4, rows: rows.collect(), reference_step: 1e-5, paper: Vec::new(), levels };
    found(Found::Accuracy, table)
}

/// The motion of the shot shown of an option, at a fixed step.
pub fn recorded(app: &App, option: usize) -> Found {
    let compute = ComputeSettings { step: Some(5e-4), ..app.compute };
    let control = Default::default();
    let context = Context::new(&app.case, compute, &control);
    let flight = flight::record(&context, option, app.shown_sample(option));
    found(Found::Flight, flight.expect("a flight"))
}

/// What is kept of a shot that uses so much of its limits.
fn shot_summary(share: f64) -> ShotSummary {
    let verdict = if share < 1.0 { Verdict::Pass } else { Verdict::Fail };
    ShotSummary {
        verdict,
        values: PerQuantity {
            height: ValueWithError { value: 1.8 * share, error: 0.01 },
            force: ValueWithError { value: 61_000.0 * share, error: 250.0 },
            drift: ValueWithError::default(),
        },
        cover: Cover::NONE,
    }
}

/// Orders, samples and sizes with round numbers.
pub fn spreads(app: &App) -> [(StudyKind, Found); 3] {
    let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    let tried = orders.iter().enumerate().map(|(number, order)| TriedOrder {
        number,
        order: order.to_vec(),
        interval: Time::from_ms(20.0),
        planned: shot_summary(1.5 - 0.2 * number as f64),
    });
    let judged = app.options.iter().enumerate().map(|(n, _)| Ok(judgement(&app.case, n)));
    let combinations = catalogue().ropes.iter().take(8).enumerate().map(|(n, rope)| {
        let share = 1.5 - 0.1 * n as f64;
        let risk = Some(WorstShotRisk {
            verdict: Verdict::Pass,
            samples: 3045,
            failures: 2,
            failure_upper_bound: 0.004,
        });
        let holds = share < 1.0;
        let known = Evidence::Known(Verdict::Pass);
        let grounds = holds.then_some(Grounds {
            planned: Verdict::Pass,
            launch_is_estimated: false,
            samples: known,
            one_dud: known,
            confirmation: known,
        });
        let worst = shot_summary(share);
        let trial = Trial { holds, worst, utilization: share, shots: 7, risk, grounds, thin: None };
        let (total_mass, trial) = (14_000.0 + 100.0 * n as f64, Ok(trial));
        Combination { rope, tire_mass: 280.0, border_rows: 0, tires: 50, total_mass, trial }
    });
    let sampling = Sampling::exactly(200, 1);
    [
        (
            StudyKind::Orders,
            found(Found::Orders, Orders::new(&app.case, tried.collect(), 1, HoleTiming::TOGETHER)),
        ),
        (StudyKind::Risk, found(Found::Risk, Risks { sampling, results: judged.collect() })),
        (
            StudyKind::Size,
            found(Found::Size, Sizing { combinations: combinations.collect(), launch_is_estimated: false }),
        ),
    ]
}
