//! What is known of a question before it is answered: what its study tried so far, and before it what the options of the plan tell.

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};

use super::compare::curve;
use super::{chart, histogram, holds_chart};
use crate::plan::Timing;
use crate::report::charts;
use crate::report::parts::Chart;
use crate::study::question::StudyKind;
use crate::study::risk::Risks;
use crate::study::samples::sample::Sample;
use crate::study::sweep::DEFAULT_INTERVALS;
use crate::tui::app::App;
use crate::tui::screen::Screen;
use crate::units::{self, Unit};
use crate::verdict::Quantity;

/// Draws what was `tried` so far, each with its place and the share of a limit that its shots use at most; where nothing was, what the options
/// tell.
pub fn draw(app: &App, tried: &[(f64, f64)], frame: &mut Frame, area: Rect) {
    let kind = app.studies.shown;
    if let Some(chart) = chart_of_tried(kind, tried).or_else(|| chart_of_options(app, kind)) {
        return chart::draw(app, &chart, None, frame, area);
    }
    if let Some(found) = app.stands_on(app.selected).filter(|_| kind == StudyKind::Assumptions) {
        return holds_chart::draw(app, found, frame, area);
    }
    let Some(judged) = app.judgement(app.selected) else { return };
    let samples = judged.sampled.known().map_or(&[][..], |known| &known.samples);
    draw_shots(app, app.selected, samples, frame, area);
}

/// What an axis across is, and how far it reaches where that is known before.
type Across = ((&'static str, Unit), Option<[f64; 2]>);

/// Against what a study tries what it tries; `None` where it tries one thing.
fn across(kind: StudyKind) -> Option<Across> {
    let swept = [DEFAULT_INTERVALS.from, DEFAULT_INTERVALS.to].map(|at| at.seconds());
    match kind {
        StudyKind::Sweep => Some((("interval", Unit::Millisecond), Some(swept))),
        StudyKind::Orders => Some((("interval", Unit::Millisecond), None)),
        StudyKind::Search => Some((("duration", Unit::Millisecond), None)),
        StudyKind::Size => Some((("mass", Unit::Tonne), None)),
        _ => None,
    }
}

fn chart_of_tried(kind: StudyKind, tried: &[(f64, f64)]) -> Option<Chart> {
    let ((name, unit), range) = across(kind).filter(|_| !tried.is_empty())?;
    let what = if kind == StudyKind::Search { "their worst sample" } else { "as planned" };
    let title = format!("{} tried, {what}: share of a limit against {name}", tried.len());
    Some(charts::tried(&title, (name, unit), range, tried.to_vec()))
}

/// Where the options of the plan lie among what the study will try.
fn chart_of_options(app: &App, kind: StudyKind) -> Option<Chart> {
    let ((name, unit), range) = across(kind).filter(|_| kind != StudyKind::Size)?;
    let delays = app.case.plan.delays.iter().enumerate();
    let point = |(option, delay): (usize, &crate::plan::DelayOption)| {
        let at = match (kind, &delay.timing) {
            (StudyKind::Search, _) => app.case.shots[option].duration(),
            (_, Timing::Interval { interval, .. }) => interval.seconds(),
            (_, Timing::At(_)) => return None,
        };
        Some((at, share_of_limit(app, option)?))
    };
    let points: Vec<(f64, f64)> = delays.filter_map(point).collect();
    let range = range.or_else(|| {
        let last = points.iter().map(|point| point.0).fold(0.0, f64::max);
        Some([0.0, 1.1 * last])
    });
    let title = format!("options of the plan so far: share of a limit against {name}");
    (!points.is_empty()).then(|| charts::with_stems(charts::tried(&title, (name, unit), range, points)))
}

/// The greatest share of a limit that an option uses; `None` as long as few of its shots were tried.
fn share_of_limit(app: &App, option: usize) -> Option<f64> {
    let judged = app.judgement(option)?;
    let share = |quantity| judged.used_of_limit(quantity, &app.case.limits);
    [Quantity::Height, Quantity::Force].into_iter().filter_map(share).reduce(f64::max)
}

/// Draws the samples that a study of risks drew of the selected option.
pub fn draw_risk(app: &App, risks: &Risks, frame: &mut Frame, area: Rect) {
    let judged = risks.results.get(app.selected).and_then(|result| result.as_ref().ok());
    let samples = judged.and_then(|judged| judged.sampled.known()).map_or(&[][..], |known| &known.samples);
    draw_shots(app, app.selected, samples, frame, area);
}

/// Draws where shots of an option lie by height and by force, one above the other where there is room, else side by side.
pub fn draw_shots(app: &App, option: usize, samples: &[Sample], frame: &mut Frame, area: Rect) {
    let Some(judged) = app.judgement(option).filter(|_| !samples.is_empty()) else { return };
    // The accuracy screen has its name above.
    let is_named = app.screen != Screen::Accuracy;
    let name_of_option = if is_named { app.case.plan.delays[option].name.as_str() } else { "" };
    let is_tall = area.height >= 2 * TALL && area.width < 2 * area.height * 2;
    let layout = if is_tall { Layout::vertical } else { Layout::horizontal };
    let places: [Rect; 2] = layout([Constraint::Fill(1); 2]).spacing(u16::from(!is_tall)).areas(area);
    let quantities =
        [(Quantity::Height, "height", Unit::Metre), (Quantity::Force, "force", Unit::Kilonewton)];
    for ((quantity, name, unit), place) in quantities.into_iter().zip(places) {
        let limit = app.case.limits.get(quantity).unwrap_or(f64::INFINITY);
        let shares = samples.iter().map(|sample| sample.finest().get(quantity) / limit);
        let shots = histogram::Shots {
            option: name_of_option.to_owned(),
            title: format!("{name} of {} shots", samples.len()),
            shares: shares.collect(),
            planned: Some(judged.checked.get(quantity).value / limit),
            limit: format!("{} {}", units::significant(limit, unit, 3), unit.symbol()),
            bars: curve(app, option),
        };
        histogram::draw(app, &shots, frame, place);
    }
}

/// Least height of histograms that stand one above the other.
const TALL: u16 = 7;
