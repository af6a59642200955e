//! Charts of results as data, SI.

use super::parts::{Axis, Chart, Scale, Series, SeriesKind};
use super::words::drawn_shot::{AS_PLANNED, shot_words};
use crate::choice::Method;
use crate::outcome::History;
use crate::plan::Time;
use crate::scene::Shot;
use crate::study::accuracy::{AccuracyTable, Measured};
use crate::study::as_planned::check::CheckedShot;
use crate::study::course_band::CourseBand;
use crate::study::judge::deciding_shot::{DecidingShot, DecidingShots};
use crate::study::orders::Orders;
use crate::study::samples::sampled_shot::SampledShot;
use crate::study::search::FrontPoint;
use crate::study::size::{Combination, Sizing};
use crate::study::sweep::{Point, Sweep};
use crate::study::{Case, ShotSummary};
use crate::units::{self, Unit};
use crate::verdict::{Quantity, Verdict};

/// Top of an axis over the greatest value.
const HEADROOM: f64 = 1.08;

/// Height and force of one shot over time.
#[derive(Clone, Copy, Debug)]
pub struct Course<'a> {
    /// Greatest height [m] and force [N] of each stretch of time.
    pub history: &'a History,
    /// The shot, with its firing times.
    pub shot: &'a Shot,
    /// Which shot it is.
    pub drawn: DrawnShot,
}

/// Which shot is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DrawnShot {
    /// The planned shot.
    Planned,
    /// For each quantity the sample that decides by that quantity.
    DecidingByEach,
    /// The sample that decides by its utilization of any limit. Its value of the other quantity may be far from the worst of so
    /// many samples.
    DecidingByAny,
}

impl<'a> Course<'a> {
    /// The course of the planned shot of an option.
    pub fn planned(case: &'a Case, option: usize, checked: &'a CheckedShot) -> Self {
        Self { history: &checked.history, shot: &case.shots[option], drawn: DrawnShot::Planned }
    }

    /// The courses of the samples that decide by height and by force.
    pub fn of(deciding: &'a DecidingShots) -> [Self; 2] {
        let of = |shot: &'a DecidingShot| Self {
            history: &shot.history,
            shot: &shot.shot,
            drawn: DrawnShot::DecidingByEach,
        };
        [of(&deciding.height), of(&deciding.force)]
    }

    fn end(&self) -> f64 {
        self.history.width * self.history.height.len().max(1) as f64
    }

    fn points(&self, values: fn(&History) -> &[f64]) -> Vec<(f64, f64)> {
        let middle = |(n, &value): (usize, &f64)| ((n as f64 + 0.5) * self.history.width, value);
        values(self.history).iter().enumerate().map(middle).collect()
    }
}

/// Greatest flight height and cable force over time, each of its shot in `shown`, with the firing times [s]. The `planned` shot is
/// drawn behind, where `shown` is another shot.
pub fn history(case: &Case, shown: [Course<'_>; 2], planned: Option<Course<'_>>) -> [Chart; 2] {
    let end = shown.iter().chain(&planned).map(Course::end).fold(0.0, f64::max);
    let time = axis("time", Unit::Second, [0.0, end]);
    let of_limit = |values: &[f64], limit: f64| values.iter().copied().fold(0.0, f64::max) / limit;
    let by_height = of_limit(&shown[0].history.height, case.limits.height);
    let by_force = of_limit(&shown[1].history.force, case.limits.force);
    let chart =
        |name, unit, values: fn(&History) -> &[f64], limit, shown: Course<'_>, by_other: Option<&str>| {
            let behind = planned.map(|planned| planned.points(values));
            let mut chart = quantity_chart(time, (name, unit), shown.points(values), limit);
            chart.title = match by_other.filter(|_| shown.drawn == DrawnShot::DecidingByAny) {
                Some(other) => format!("{name} in time, {OF_SHOT_WORST_BY} {other}"),
                None => {
                    format!("{name} in time, {}", shot_words(&case.limits, shown.drawn != DrawnShot::Planned))
                }
            };
            chart.firings = shown.shot.times();
            if let Some(points) = behind {
                chart.y.range[1] = top_of(&points, limit).max(chart.y.range[1]);
                chart.series[0].name = "that decides";
                chart.series.insert(0, Series { name: AS_PLANNED, kind: SeriesKind::Planned, points });
            }
            chart
        };
    let [height, force] = shown;
    [
        chart(
            height_name(case),
            Unit::Metre,
            |history| &history.height,
            case.limits.height,
            height,
            (by_height < by_force).then_some("force"),
        ),
        chart(
            FORCE,
            Unit::Kilonewton,
            |history| &history.force,
            case.limits.force,
            force,
            (by_force < by_height).then_some("height"),
        ),
    ]
}

/// Words in the title of a chart whose shot uses more of another quantity's limit.
pub const OF_SHOT_WORST_BY: &str = "of the shot worst by";

/// Adds to the charts of [`history`] the band that holds nine of ten sampled shots.
pub fn add_band(charts: &mut [Chart; 2], band: &CourseBand) {
    let middle = |(n, &value): (usize, &f64)| ((n as f64 + 0.5) * band.width, value);
    for (chart, [low, high]) in charts.iter_mut().zip([&band.height, &band.force]) {
        let series = |kind, values: &[f64]| {
            let points = values.iter().enumerate().map(middle).collect();
            Series { name: "9 of 10 shots", kind, points }
        };
        chart.series.extend([series(SeriesKind::Low, low), series(SeriesKind::High, high)]);
    }
}

/// Name of the flight height. On a slope the height is counted normal to the ground, not upright.
fn height_name(case: &Case) -> &'static str {
    if case.plan.ground.slope_percent > 0.0 { "flight height, normal to the slope" } else { "flight height" }
}

const FORCE: &str = "cable force";

/// Greatest flight height and cable force against the interval between rows, with the windows. Where there are samples, the failing
/// share follows.
pub fn sweep(case: &Case, sweep: &Sweep) -> Vec<Chart> {
    let windows = || sweep.windows.iter().map(|window| window.map(Time::seconds)).collect::<Vec<_>>();
    let windows_are = if sweep.has_risk() { "worth a check" } else { "keep limits as planned" };
    let interval = axis("interval", Unit::Millisecond, sweep.range().map(Time::seconds));
    let chart = |name, unit, quantity: fn(&ShotSummary) -> f64, limit| {
        let point = |point: &Point| (point.interval.seconds(), quantity(&point.judged.planned));
        // A run that failed has no value.
        let points = sweep.points.iter().map(point).filter(|(_, value)| value.is_finite()).collect();
        Chart { windows: windows(), windows_are, ..quantity_chart(interval, (name, unit), points, limit) }
    };
    let mut charts = vec![
        chart(height_name(case), Unit::Metre, |judged| judged.values.height.value, case.limits.height),
        chart(FORCE, Unit::Kilonewton, |judged| judged.values.force.value, case.limits.force),
    ];
    let failing = |point: &Point| match point.judged.planned.verdict {
        Verdict::Fail => Some((point.interval.seconds(), 1.0)),
        _ => Some((point.interval.seconds(), point.judged.risk.known()?.bounds.probability()?)),
    };
    if sweep.points.iter().any(Point::is_sampled) {
        let accepted = case.limits.accepted_risk;
        // On an axis up to 100 % the limit would lie on the axis itself.
        let top = (ACCEPTED_TIMES * accepted).min(1.0);
        let points =
            sweep.points.iter().filter_map(failing).map(|(at, share)| (at, share.min(top))).collect();
        let chart = quantity_chart(interval, ("failing share", Unit::Percent), points, accepted);
        let title = format!(
            "failing share, at the top {} % and more, against {}",
            units::short(1e2 * top),
            chart.x.name
        );
        let y = axis("failing share", Unit::Percent, [0.0, top]);
        charts.push(Chart { title, y, windows: windows(), windows_are, ..chart });
    }
    charts
}

/// Top of the axis of the failing share in a sweep, over the accepted share.
const ACCEPTED_TIMES: f64 = 10.0;

/// Failing share against duration, of the schedules for which no shorter schedule judged fails less.
pub fn front(case: &Case, front: &[FrontPoint]) -> Chart {
    let longest = front.iter().map(|point| point.duration).fold(0.0, f64::max);
    let duration = axis("duration", Unit::Millisecond, [0.0, longest * HEADROOM]);
    let points = front.iter().map(|point| (point.duration, point.share.value())).collect();
    let accepted = case.limits.accepted_risk;
    // No schedule lies between two schedules: a line would show one.
    let mut chart = quantity_chart(duration, ("failing share", Unit::Percent), points, accepted);
    chart.series.iter_mut().for_each(|series| series.kind = SeriesKind::Points);
    chart
}

/// Top of an axis: the limit, or some room above the greatest value where that value exceeds the limit.
fn top_of(points: &[(f64, f64)], limit: f64) -> f64 {
    let most = points.iter().map(|(_, value)| *value).fold(0.0, f64::max);
    if most > limit { most * HEADROOM } else { limit }
}

/// Chart of a quantity with its limit.
fn quantity_chart(x: Axis, (name, unit): (&'static str, Unit), points: Vec<(f64, f64)>, limit: f64) -> Chart {
    let top = top_of(&points, limit);
    Chart {
        title: format!("{name} against {}", x.name),
        x,
        y: axis(name, unit, [0.0, top]),
        series: vec![Series { name, kind: SeriesKind::Curve, points }],
        limit: Some(limit),
        windows: Vec::new(),
        windows_are: "",
        firings: Vec::new(),
    }
}

fn axis(name: &'static str, unit: Unit, range: [f64; 2]) -> Axis {
    Axis { name, unit, scale: Scale::Linear, range }
}

/// The larger error of every run against its time, both on logarithmic axes; `None` where no run has both.
pub fn work_precision(study: &AccuracyTable) -> Option<Chart> {
    let runs = |method: Method| {
        let rows = study.rows.iter().filter(move |row| row.method == method);
        rows.filter_map(|row| Some((row.step, work_and_error(&row.result?)?)))
    };
    let all = |method: Method| runs(method).map(|(_, point)| point).collect();
    let is_level = |step: &f64| study.levels.iter().any(|level| level.step == *step);
    let levels = runs(Method::Verlet).filter(|(step, _)| is_level(step)).map(|(_, point)| point).collect();
    let series = vec![
        Series { name: Method::Verlet.name(), kind: SeriesKind::Curve, points: all(Method::Verlet) },
        Series { name: Method::Newmark.name(), kind: SeriesKind::Comparison, points: all(Method::Newmark) },
        Series { name: "levels", kind: SeriesKind::Points, points: levels },
    ];
    let decades = |coordinate: fn(&(f64, f64)) -> f64| {
        let values = series.iter().flat_map(|series| &series.points).map(coordinate);
        let low = values.clone().reduce(f64::min)?.log10().floor();
        let high = values.reduce(f64::max)?.log10().ceil().max(low + 1.0);
        Some([low, high].map(|exponent| 10_f64.powf(exponent)))
    };
    let (time, error) = (decades(|point| point.0)?, decades(|point| point.1)?);
    let logarithmic = |name, unit, range| Axis { name, unit, scale: Scale::Logarithmic, range };
    Some(Chart {
        title: "error against the time of a run".to_owned(),
        x: logarithmic("time of a run", Unit::Millisecond, time),
        y: logarithmic("error", Unit::Percent, error),
        series,
        limit: None,
        windows: Vec::new(),
        windows_are: "",
        firings: Vec::new(),
    })
}

/// Time [s] and larger relative error of a run; `None` where one of the two has no logarithm.
pub fn work_and_error(measured: &Measured) -> Option<(f64, f64)> {
    let (wall, error) = (measured.wall.as_secs_f64(), measured.height_error.max(measured.force_error));
    (wall > 0.0 && error > 0.0 && error.is_finite()).then_some((wall, error))
}

/// Utilization of every order, from the worst to the best.
pub fn orders(case: &Case, orders: &Orders) -> Chart {
    let share = orders.ranked.iter().map(|tried| tried.planned.utilization(&case.limits));
    let curve = share.enumerate().map(|(n, share)| ((n + 1) as f64, share)).collect();
    utilization("from the worst order to the best", ("order", Unit::One), curve, Vec::new())
}

/// Greatest height and force of the samples, from the gentlest to the hardest.
pub fn samples(case: &Case, sampled: &SampledShot) -> [Chart; 2] {
    let chart = |name, unit, quantity, limit| {
        let mut values: Vec<f64> = sampled.samples.iter().map(|sample| sample.run.get(quantity)).collect();
        values.sort_by(f64::total_cmp);
        let count = values.len() as f64;
        let points = values.into_iter().enumerate().map(|(n, value)| ((n as f64 + 0.5) / count, value));
        // A sample whose run failed has no value.
        let points = points.filter(|(_, value)| value.is_finite()).collect();
        let share = axis("share of samples", Unit::Percent, [0.0, 1.0]);
        quantity_chart(share, (name, unit), points, limit)
    };
    [
        chart(height_name(case), Unit::Metre, Quantity::Height, case.limits.height),
        chart(FORCE, Unit::Kilonewton, Quantity::Force, case.limits.force),
    ]
}

/// Utilization of the samples of the option `name`, from the gentlest to the hardest.
pub fn risk(case: &Case, name: &str, sampled: &SampledShot) -> Chart {
    let shares = sampled.samples.iter().map(|sample| sample.run.utilization(&case.limits));
    let mut shares: Vec<f64> = shares.filter(|share| share.is_finite()).collect();
    shares.sort_by(f64::total_cmp);
    let count = shares.len() as f64;
    let curve = shares.into_iter().enumerate().map(|(n, share)| ((n + 1) as f64 / count, share)).collect();
    let chart = utilization("against the share of samples", ("samples", Unit::Percent), curve, Vec::new());
    Chart { title: format!("{name}: {}", chart.title), ..chart }
}

/// Utilization of every combination against its mass, and a line of the lightest combinations that hold.
pub fn size(sizing: &Sizing) -> Chart {
    let point =
        |combination: &Combination| Some((combination.total_mass, combination.trial.ok()?.utilization));
    let lightest = sizing.choices().filter_map(point).collect();
    let tried = sizing.combinations.iter().filter_map(point).collect();
    utilization("against mass (line: lightest that hold)", ("mass", Unit::Tonne), lightest, tried)
}

/// The longest series of a chart at even distances, as shares of its limit. `chosen` picks one of two values in a stretch. A
/// stretch without a point repeats the value of the stretch before.
pub fn shares_along(chart: &Chart, chosen: fn(f64, f64) -> f64) -> Vec<f64> {
    let longest = chart.series.iter().max_by_key(|series| series.points.len());
    let (Some(series), Some(limit), [from, to]) = (longest, chart.limit, chart.x.range) else {
        return Vec::new();
    };
    let mut stretches: Vec<Option<f64>> = vec![None; STRETCHES];
    for &(x, y) in &series.points {
        let n = ((x - from) / (to - from) * STRETCHES as f64) as usize;
        let stretch = &mut stretches[n.min(STRETCHES - 1)];
        *stretch = Some(stretch.map_or(y, |known| chosen(known, y)));
    }
    let mut last = stretches.iter().flatten().next().copied();
    let along = |stretch: Option<f64>| {
        last = stretch.or(last);
        last.map(|value| value / limit)
    };
    stretches.into_iter().filter_map(along).collect()
}

/// Number of stretches of a chart that is drawn in one line.
const STRETCHES: usize = 60;

/// Chart of the utilization against another quantity.
fn utilization(
    title: &str,
    (name, unit): (&'static str, Unit),
    curve: Vec<(f64, f64)>,
    points: Vec<(f64, f64)>,
) -> Chart {
    let drawn = || curve.iter().chain(&points);
    let across = drawn().fold([f64::INFINITY, 0.0], |[a, b]: [f64; 2], &(x, _)| [a.min(x), b.max(x)]);
    // Far above the limit, the exact value no longer matters.
    let top = drawn().map(|(_, y)| *y).fold(1.2, f64::max).min(3.0);
    Chart {
        title: format!("share of a limit {title}"),
        x: axis(name, unit, across),
        y: axis("share of a limit", Unit::Percent, [0.0, top]),
        series: vec![
            Series { name: "combinations", kind: SeriesKind::Points, points },
            Series { name: "share of a limit", kind: SeriesKind::Curve, points: curve },
        ],
        limit: Some(1.0),
        windows: Vec::new(),
        windows_are: "",
        firings: Vec::new(),
    }
}
