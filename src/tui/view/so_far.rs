//! The picture below a question: the options of the plan before the study, the shots tried so far during it, and the same picture of all
//! shots after it.

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};

use super::compare::{TRYING, curve, verdict_words};
use super::gauges::REVIEWED;
use super::tried_chart::{self, Marked, Tried};
use super::{histogram, holds_chart, option_bars};
use crate::plan::HoleTiming;
use crate::study::orders::Orders;
use crate::study::question::{Found, StudyKind};
use crate::study::risk::Risks;
use crate::study::samples::sample::Sample;
use crate::study::samples::sampled_shot::{SAMPLES_FOR_BANDS, SampledShot};
use crate::study::sweep::{DEFAULT_INTERVALS, Sweep};
use crate::study::work::progress::Progress;
use crate::tui::app::{App, Areas};
use crate::tui::screen::Screen;
use crate::units::{self, Unit};
use crate::verdict::Quantity;

/// Draws what the study has tried so far, or the options if it has tried nothing.
pub fn draw(app: &App, progress: &Progress, frame: &mut Frame, area: Rect, areas: &mut Areas) {
    let kind = app.studies.shown;
    if let Some(tried) = tried_so_far(app, kind, progress) {
        return tried_chart::draw(app, &tried, frame, area);
    }
    if let Some(found) = app
        .stands_on(app.selected)
        .filter(|_| kind == StudyKind::Assumptions && app.is_pass_of_plan(app.selected))
    {
        return holds_chart::draw(app, found, frame, area);
    }
    // One line below the bars for the meaning of their signs.
    let bars = option_bars::height(app) + 1;
    let has_shots = area.height >= bars + SHOTS;
    let above = Constraint::Length(if has_shots { bars } else { area.height });
    let [above, below] = Layout::vertical([above, Constraint::Min(0)]).areas(area);
    option_bars::draw(app, frame, above, areas);
    let judged = app.judgement(app.selected).filter(|_| has_shots);
    if let Some(sampled) = judged.and_then(|judged| judged.sampled.known()) {
        draw_shots(app, app.selected, &sampled.samples, frame, below);
    }
}

/// Least height of histograms below the bars of the options.
const SHOTS: u16 = 5;

/// What a study has tried so far; `None` if it has tried nothing, or nothing beyond 0 on the axis.
fn tried_so_far(app: &App, kind: StudyKind, progress: &Progress) -> Option<Tried> {
    let planned = progress.tried.clone();
    let (what, unit) = match kind {
        StudyKind::Sweep => ("intervals", Unit::Millisecond),
        StudyKind::Orders => ("orders by interval", Unit::Millisecond),
        StudyKind::Search => ("schedules by duration", Unit::Millisecond),
        StudyKind::Size => ("combinations by mass", Unit::Tonne),
        _ => return None,
    };
    let swept = [DEFAULT_INTERVALS.from, DEFAULT_INTERVALS.to].map(|at| at.seconds());
    let last = planned.iter().map(|(at, _)| *at).fold(0.0, f64::max);
    let across = if kind == StudyKind::Sweep { swept } else { [0.0, HEADROOM * last] };
    let short = format!("{} {what}", planned.len());
    let rows: Vec<usize> = (0..app.case.plan.blast_rows.len()).collect();
    let holes = app.case.plan.shared_hole_timing().filter(|_| kind == StudyKind::Sweep);
    let options = holes.map_or_else(Vec::new, |holes| options(app, &rows, &holes));
    // Before the study has sampled shots, bars at a few intervals would look like all of them.
    let of_options = if progress.sampled.is_empty() { &[][..] } else { &options };
    let tried = Tried {
        titles: [format!("share of a limit of {short}"), short],
        across,
        labels: labels(across, unit),
        width: 0.0,
        planned,
        sampled: with_options(progress.sampled.iter().copied(), of_options),
        sampled_are: sampled_are(app),
        options,
        windows: Vec::new(),
        windows_are: "",
    };
    (!tried.planned.is_empty() && across[1] > 0.0).then_some(tried)
}

/// Length of the axis relative to the greatest value tried.
const HEADROOM: f64 = 1.1;

/// Labels of both ends and of the middle of the axis.
fn labels([from, to]: [f64; 2], unit: Unit) -> [String; 3] {
    [from, 0.5 * (from + to), to].map(|at| format!("{} {}", units::short(at / unit.size()), unit.symbol()))
}

/// Everything that an answer was found from; `None` if the report draws it.
pub fn tried_in_all(app: &App, found: &Found) -> Option<Tried> {
    let mut tried = match found {
        Found::Sweep(found) => swept(app, &found.value),
        Found::Orders(found) => ordered(app, &found.value),
        _ => return None,
    };
    if app.is_held() {
        tried.windows.clear();
    }
    (!tried.planned.is_empty()).then_some(tried)
}

fn swept(app: &App, sweep: &Sweep) -> Tried {
    let across = sweep.range().map(|end| end.seconds());
    let points = || sweep.points.iter().map(|point| (point.interval.seconds(), &point.judged));
    let planned = points().map(|(at, judged)| (at, judged.planned.utilization(&app.case.limits)));
    let sampled = points().filter_map(|(at, judged)| Some((at, judged.risk.known()?.utilization)));
    let windows = sweep.windows.iter().map(|window| window.map(|end| end.seconds())).collect();
    let options = options(app, &sweep.order, &sweep.holes);
    let of_options = if sweep.has_risk() { &options[..] } else { &[] };
    Tried {
        titles: ["share of a limit at ", ""].map(|what| format!("{what}{} intervals", sweep.points.len())),
        across,
        labels: labels(across, Unit::Millisecond),
        width: 0.0,
        planned: finite(planned),
        sampled: with_options(sampled, of_options),
        sampled_are: sampled_are(app),
        options,
        windows,
        windows_are: if sweep.has_risk() { "worth a check" } else { "keeps limits as planned" },
    }
}

/// Words for the share of the sampled shots that is drawn, long and short. Few samples of each interval cannot show a rare share.
fn sampled_are(app: &App) -> [String; 2] {
    let accepted = app.case.limits.accepted_risk;
    if accepted * (SAMPLES_FOR_BANDS as f64) < 1.0 {
        return [format!("most of {SAMPLES_FOR_BANDS} shots"), format!("of {SAMPLES_FOR_BANDS}")];
    }
    let one_in = units::one_in(accepted);
    [format!("1 in {one_in} shots above"), format!("1 in {one_in}")]
}

/// The judged options that fire the rows in this `order` with the hole timing `holes`, each at its interval.
fn options(app: &App, order: &[usize], holes: &HoleTiming) -> Vec<Marked> {
    let place = |option: usize| {
        let delay = &app.case.plan.delays[option];
        let (is_alike, interval) = (delay.hole_timing.is_same(holes), delay.timing.interval_in(order)?);
        let (words, style) = verdict_words(app, option);
        let mark = if words == TRYING { "…" } else { words.split(' ').next().unwrap_or_default() };
        let sampled = app.judgement(option)?.sampled.known();
        let share = sampled.map(SampledShot::deciding_utilization);
        is_alike.then(|| Marked { at: interval.seconds(), share, word: app.word(option), mark, style })
    };
    (0..app.options.len()).filter_map(place).collect()
}

/// The utilizations of the sampled shots, with those of the options added. An option has more samples than other intervals.
fn with_options(sampled: impl Iterator<Item = (f64, f64)>, options: &[Marked]) -> Vec<(f64, f64)> {
    let of_options = options.iter().filter_map(|option| Some((option.at, option.share?)));
    sampled.chain(of_options).collect()
}

fn ordered(app: &App, orders: &Orders) -> Tried {
    let count = orders.ranked.len();
    let place = |n: usize| (n + 1) as f64;
    let planned = (0..count).map(|n| (place(n), orders.ranked[n].planned.utilization(&app.case.limits)));
    let sampled = (0..count).filter_map(|n| Some((place(n), orders.judged(n).risk.known()?.utilization)));
    Tried {
        titles: ["share of a limit of ", ""].map(|what| format!("{what}{count} orders")),
        across: [0.5, count as f64 + 0.5],
        labels: ["worst as planned ", "", " best"].map(str::to_owned),
        width: 1.0,
        planned: finite(planned),
        sampled: sampled.collect(),
        sampled_are: sampled_are(app),
        options: Vec::new(),
        windows: Vec::new(),
        windows_are: "",
    }
}

/// The points without failed runs, whose value is not finite.
fn finite(points: impl Iterator<Item = (f64, f64)>) -> Vec<(f64, f64)> {
    points.filter(|(_, share)| share.is_finite()).collect()
}

/// Draws the samples that a study of risks drew for the selected option.
pub fn draw_risk(app: &App, risks: &Risks, frame: &mut Frame, area: Rect) {
    let judged = risks.results.get(app.selected).and_then(|result| result.as_ref().ok());
    let samples = judged.and_then(|judged| judged.sampled.known()).map_or(&[][..], |known| &known.samples);
    draw_shots(app, app.selected, samples, frame, area);
}

/// Draws histograms of an option's shots by height and by force, one above the other if there is room, else side by side.
pub fn draw_shots(app: &App, option: usize, samples: &[Sample], frame: &mut Frame, area: Rect) {
    let Some(judged) = app.judgement(option).filter(|_| !samples.is_empty()) else { return };
    // The accuracy screen shows the name above.
    let is_named = app.screen != Screen::Accuracy;
    let name_of_option = if is_named { app.case.plan.delays[option].name.as_str() } else { "" };
    let is_sampling = app.options[option].is_sampling();
    let is_tall = area.height >= 2 * TALL && area.width < 2 * area.height * 2;
    let layout = if is_tall { Layout::vertical } else { Layout::horizontal };
    let places: [Rect; 2] = layout([Constraint::Fill(1); 2]).spacing(u16::from(!is_tall)).areas(area);
    let quantities =
        [(Quantity::Height, "height", Unit::Metre), (Quantity::Force, "force", Unit::Kilonewton)];
    for ((quantity, name, unit), place) in quantities.into_iter().zip(places) {
        let limit = app.case.limits.get(quantity).unwrap_or(f64::INFINITY);
        let shares = samples.iter().map(|sample| sample.finest().get(quantity) / limit);
        let last = match app.shot_in_review(option) {
            Some((number, _)) => samples.get(number - 1).map(|sample| (sample, number.to_string())),
            None => samples.last().filter(|_| is_sampling).map(|sample| (sample, "last".to_owned())),
        };
        let last = last.map(|(sample, name)| (sample.finest().get(quantity) / limit, name));
        let last = last.filter(|(share, _)| share.is_finite());
        let of_all = format!("{name} of {} shots", samples.len());
        let shots = histogram::Shots {
            option: name_of_option.to_owned(),
            titles: match &last {
                Some((_, last)) => [of_all, format!("{name} {REVIEWED} {last} of {}", samples.len())],
                None => [of_all.clone(), of_all],
            },
            last: last.map(|(share, _)| share),
            shares: shares.collect(),
            planned: Some(judged.checked.get(quantity).value / limit),
            limit: format!("{} {}", units::significant(limit, unit, 3), unit.symbol()),
            bars: curve(app, option),
        };
        histogram::draw(app, &shots, frame, place);
    }
}

/// Least height of histograms one above the other.
const TALL: u16 = 7;
