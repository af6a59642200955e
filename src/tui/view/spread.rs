//! Orders, samples and sizes as one picture each: how much of the limits they use.

use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::symbols::Marker;
use ratatui::widgets::{Dataset, GraphType};

use super::chart::{Scale, chart, line};
use crate::study::orders::Orders;
use crate::study::scatter::Sample;
use crate::study::size::{Combination, Sizing};
use crate::tui::app::App;
use crate::worker::Found;

/// What is drawn: how much of a limit is used [%] against something else.
struct Picture {
    title: String,
    /// What the horizontal axis counts, after its numbers.
    unit: &'static str,
    /// Joined, in the colour of what passes.
    curve: Vec<(f64, f64)>,
    /// Single, in a colour of their own.
    points: Vec<(f64, f64)>,
}

/// Draws what a study found; sweeps have charts of their own.
pub fn draw(app: &App, found: &Found, frame: &mut Frame, area: Rect) {
    let picture = match found {
        Found::Orders(orders) => of_orders(app, orders),
        Found::Scatter(_, samples) => of_samples(app, samples),
        Found::Size(sizing) => of_sizes(sizing),
        Found::Sweep(_) | Found::Flight(_) | Found::Accuracy(_) => return,
    };
    let all = || picture.curve.iter().chain(&picture.points);
    if area.height < 5 || all().next().is_none() {
        return;
    }
    let (left, right) = all().fold((f64::INFINITY, 0.0_f64), |(a, b), (x, _)| (a.min(*x), b.max(*x)));
    // Far past the limit it no longer matters how far.
    let top = all().map(|(_, y)| *y).fold(120.0, f64::max).min(300.0);
    let limit = [(left, 100.0), (right, 100.0)];
    let points = Dataset::default()
        .data(&picture.points)
        .graph_type(GraphType::Scatter)
        .marker(Marker::Dot)
        .style(app.theme.firing());
    let sets = vec![
        line(&limit, app.theme.limit(), Marker::Dot),
        points,
        line(&picture.curve, app.theme.curve(), Marker::Braille),
    ];
    let ends = [left, right].map(|x| format!("{}{}", (x * 10.0).round() / 10.0, picture.unit));
    let chart = chart(app, picture.title, sets, Scale::new([left, right], ends), Scale::up_to(top));
    frame.render_widget(chart, area);
}

/// From the worst to the best.
fn of_orders(app: &App, orders: &Orders) -> Picture {
    let share = |tried: &crate::study::orders::Tried| 100.0 * tried.envelope.utilization(&app.case.limits);
    Picture {
        title: "use of the limits, %, from the worst order to the best (dotted: limit)".to_owned(),
        unit: "",
        curve: orders.ranked.iter().enumerate().map(|(n, tried)| ((n + 1) as f64, share(tried))).collect(),
        points: Vec::new(),
    }
}

/// Of the selected option, from the gentlest sample to the hardest.
fn of_samples(app: &App, samples: &[Sample]) -> Picture {
    let mine = samples.iter().filter(|sample| sample.option == app.selected);
    let mut shares: Vec<f64> =
        mine.map(|sample| 100.0 * sample.envelope.utilization(&app.case.limits)).collect();
    shares.sort_by(f64::total_cmp);
    let count = shares.len().max(1) as f64;
    let name = app.case.plan.delays.get(app.selected).map_or("", |delay| &delay.name);
    Picture {
        title: format!("{name}: use of the limits, %, against the share of samples (dotted: limit)"),
        unit: " %",
        curve: shares.into_iter().enumerate().map(|(n, y)| (100.0 * (n + 1) as f64 / count, y)).collect(),
        points: Vec::new(),
    }
}

/// All combinations tried, and those that no lighter one beats.
fn of_sizes(sizing: &Sizing) -> Picture {
    let point = |combination: &Combination| {
        Some((combination.total_mass * 1e-3, 100.0 * combination.trial.ok()?.utilization))
    };
    Picture {
        title: "use of the limits, %, against mass, t (line: lightest that hold; dotted: limit)".to_owned(),
        unit: " t",
        curve: sizing.frontier().into_iter().filter_map(point).collect(),
        points: sizing.combinations.iter().filter_map(point).collect(),
    }
}
