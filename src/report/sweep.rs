//! `sweep` as a report: charts against the interval, the windows, the worst and the recommended interval.

use itertools::Itertools;

use super::brief::Brief;
use super::charts;
use super::check::{NOTHING_VARIED, pass_caveat};
use super::parts::{Audience, Block, Cell, Column, Conclusion, Field, Offer, Report, Table, advice, fact};
use super::shared_columns::{
    FAILURES, FORCE, HEIGHT, INTERVAL, NOMINAL_VERDICT, PROBABILITY, SAMPLES, VERDICT, failures, force,
    height, probability, sampled, samples,
};
use super::sweep_windows::{HUNDREDTH, listed, table_of_windows, wide};
use super::words::assumption_words::thin as thin_words;
use super::words::{plan_notes, warnings};
use super::{judged_facts, report_head, row_names};
use crate::plan::{DelayOption, Time};
use crate::report::language::{phrase, say};
use crate::study::search::Schedule;
use crate::study::sweep::{Point, Recommended, Sweep};
use crate::study::{Case, Computed, ShotSummary};
use crate::units;
use crate::verdict::{Verdict, VerdictWord};

/// Columns of every interval tried, for scripts.
fn points<'a>() -> [Field<&'a Point>; 9] {
    [
        Field::new(INTERVAL.shown(Audience::Scripts), |point| Cell::Interval(point.interval.seconds())),
        Field::new(HEIGHT.shown(Audience::Scripts), |point| height(point.judged.planned.values.height)),
        Field::new(FORCE.shown(Audience::Scripts), |point| force(point.judged.planned.values.force)),
        Field::new(VERDICT.shown(Audience::Scripts), |point| point.verdict().into()),
        Field::new(NOMINAL_VERDICT, |point| point.judged.planned.verdict.into()),
        Field::scripts(&["quick"], |point| Cell::Flag(point.is_quick)),
        Field::new(SAMPLES, |point| samples(point.judged.risk.known())),
        Field::new(PROBABILITY, |point| probability(point.judged.risk.known())),
        Field::new(FAILURES.shown(Audience::Scripts), |point| failures(point.judged.risk.known())),
    ]
}

/// Columns of the worst and the recommended interval, each with its name, for people.
fn highlights<'a>() -> [Field<(&'static str, VerdictWord, &'a Point)>; 6] {
    [
        Field::new(Column::words(&[], ""), |(name, ..)| phrase(name).into()),
        Field::new(INTERVAL.without_keys(), |(.., point)| Cell::Interval(point.interval.seconds())),
        Field::new(VERDICT.without_keys(), |(_, word, _)| (*word).into()),
        Field::new(HEIGHT.without_keys(), |(.., point)| height(point.judged.planned.values.height)),
        Field::new(FORCE.without_keys(), |(.., point)| force(point.judged.planned.values.force)),
        Field::new(FAILURES.without_keys(), |(.., point)| failures(point.judged.risk.known())),
    ]
}

/// The report of a sweep. It is partial where the time was up.
pub fn report(case: &Case, swept: &Computed<Sweep>) -> Report {
    let Computed { value: sweep, partial } = swept;
    let names = row_names(case, &sweep.order).join(", ");
    let [from, to] = sweep.range().map(|end| units::milliseconds(end.seconds()));
    let head =
        say!("interval between rows {names}: {from} to {to}, {} tried", names, from, to, sweep.points.len());
    let mut report = report_head(case, "shelter.sweep/1", sweep.has_risk());
    let blocks = &mut report.blocks;
    blocks.push(Block::Facts(judged_facts(case, swept.verdict(), sweep.has_risk(), *partial)));
    blocks.push(Block::Facts(vec![fact(&["order"], row_names(case, &sweep.order))]));
    if !sweep.points.is_empty() {
        blocks.push(Block::Text(
            [head].into_iter().chain(plan_notes::hole_timing(case, &sweep.holes)).collect(),
        ));
        blocks.extend(charts::sweep(case, sweep).into_iter().map(Block::Chart));
        blocks.push(Block::Table(table_of_highlights(case, sweep)));
        blocks.push(Block::Text(windows(case, sweep, *partial)));
        blocks.push(Block::Table(table_of_windows(sweep)));
    }
    blocks.push(Block::Table(Table::of(&points(), &sweep.points).key("points")));
    let wider_than_a_point =
        |windows: &[[Time; 2]]| Cell::list(windows.iter().copied().filter(|[from, to]| from < to));
    let (windows_that_pass, worth_a_check) = match sweep.has_risk() {
        true => (Cell::list(sweep.passing_windows()), wider_than_a_point(&sweep.windows)),
        false => (wider_than_a_point(&sweep.windows), Cell::Nothing),
    };
    blocks.push(Block::Facts(vec![
        advice(&["nominal_windows_s"], wider_than_a_point(&sweep.windows_as_planned)),
        advice(&["windows_s"], windows_that_pass),
        advice(&["worth_a_check_s"], worth_a_check),
        fact(&["largest_gap_s"], sweep.largest_gap()),
        advice(&["recommended_s"], sweep.recommended.map(|recommended| recommended.interval)),
        advice(&["recommended_room_s"], sweep.recommended.map(|recommended| recommended.room)),
        fact(&["worst"], sweep.worst(case).map(|worst| Cell::object(&points(), &worst))),
    ]));
    let passing = sweep.points.iter().map(|point| &point.judged.planned);
    let passing: Vec<&ShotSummary> = passing.filter(|shot| shot.verdict == Verdict::Pass).collect();
    let bare = sweep.points.iter().filter(|point| point.judged.planned.cover.under_no_tire > 0).count();
    report.warnings.extend((bare > 0).then(|| {
        let all = sweep.points.len();
        say!("at {bare} of {all} intervals tried a hole fires where no tire lies any more, and these pass nothing", bare, all)
    }));
    let best = sweep.best().map(|point| (point.interval, &point.judged.planned));
    let uncovered = warnings::count_uncovered("intervals that pass as planned", passing.into_iter());
    let best_is_covered = best.is_some_and(|(_, shot)| shot.cover.uncovered == 0);
    let name = name_of_best(sweep);
    let not_the_best =
        if best_is_covered { say!("; the {name} one has none", phrase(name)) } else { String::new() };
    report.warnings.extend(uncovered.map(|warning| warning + &not_the_best));
    report.warnings.extend(
        best.and_then(|(interval, shot)| warnings::uncovered_shot(&say!("at {interval} ms", interval), shot)),
    );
    report.conclusion = Some(conclusion(case, swept));
    report
}

/// Name of the interval deepest in a window. It is recommended only with a full verdict.
fn name_of_best(sweep: &Sweep) -> &'static str {
    if sweep.has_risk() { "recommended" } else { "deepest" }
}

fn table_of_highlights(case: &Case, sweep: &Sweep) -> Table {
    let best = sweep.best();
    let named = [(name_of_best(sweep), best), ("worst", sweep.worst(case))];
    let named = named.into_iter().filter_map(|(name, point)| Some((name, point?)));
    let is_thin = |point: &Point| {
        sweep.recommended.is_some_and(|best| best.interval == point.interval && best.thin.is_some())
    };
    let named = named.map(|(name, point)| {
        let word = if is_thin(point) { VerdictWord::Thin } else { point.verdict().into() };
        match (name, point.is_quick) {
            ("worst", true) => ("worst, by a quick check", word, point),
            _ => (name, word, point),
        }
    });
    // Without any sample the last column has no cell.
    let (fields, is_sampled) = (highlights(), sweep.points.iter().any(Point::is_sampled));
    // Only an interval with a full verdict is offered. Without such an interval the first row would be another interval.
    let offers = best.map(|point| {
        let schedule = Schedule::at_interval(&sweep.order, point.interval, sweep.holes);
        Offer::Option(schedule.named_option(&case.plan.blast_rows))
    });
    Table::of(if is_sampled { &fields[..] } else { &fields[..5] }, named).offering(offers)
}

/// Sentences: the windows, how closely they were tried, and how the recommended interval was chosen.
fn windows(case: &Case, sweep: &Sweep, partial: bool) -> Vec<String> {
    if sweep.windows_as_planned.is_empty() {
        return vec![say!("no interval tried passes")];
    }
    let so_far = if partial { phrase(" so far") } else { "" };
    let sampled: Vec<&Point> = sweep.points.iter().filter(|point| point.is_sampled()).collect();
    let has_risk = sweep.has_risk();
    let mut lines = recommended(case, sweep, has_risk);
    if has_risk {
        let risk = format!("{} %", case.plan.limits.accepted_risk_percent);
        let accepted: Vec<&&Point> = sampled.iter().filter(|point| point.is_accepted()).collect();
        lines.extend(listed(&say!("worth a check, not proven{so_far}", so_far), &sweep.windows));
        lines.push(say!(
            "at {} of {} intervals sampled no more than {risk} of the samples fail",
            accepted.len(),
            sampled.len(),
            risk
        ));
        if !accepted.is_empty() {
            let apart = sweep.largest_gap();
            lines.push(say!("inside a window the intervals sampled are at most {apart} ms apart", apart));
        }
        let open = accepted.iter().filter(|point| point.verdict() == Verdict::Undecided);
        let samples = open.filter_map(|point| Some(point.judged.risk.known()?.bounds.samples));
        if let Some(few) = samples.min() {
            lines.push(say!(
                "{few} samples cannot prove {risk}: `check` an interval before you choose it",
                few,
                risk
            ));
        }
        lines.extend(listed(
            &say!("as planned, nothing varied, no permission to fire{so_far}", so_far),
            &sweep.windows_as_planned,
        ));
    } else {
        lines.extend(listed(&say!("windows that pass{so_far}", so_far), &sweep.windows));
        let inside =
            |point: &&Point| wide(&sweep.windows).iter().any(|[a, b]| (*a..=*b).contains(&point.interval));
        match sweep.points.iter().filter(inside).count() {
            0 => {}
            count => lines.push(say!(
                "all {count} points tried in them pass, at most {} ms apart",
                count,
                sweep.largest_gap()
            )),
        }
    }
    if !has_risk {
        lines.push(say!("judged: the planned shots only, nothing varied"));
        lines.extend(why_not(case, sweep));
    }
    lines
}

/// Sentences: the recommended interval and why it is recommended, or why none is.
fn recommended(case: &Case, sweep: &Sweep, has_risk: bool) -> Vec<String> {
    let mut lines = Vec::new();
    if let Some(Recommended { interval, room, utilization, thin }) = sweep.recommended {
        let one_in = units::one_in(case.limits.accepted_risk);
        let what = if has_risk {
            say!("all but 1 in {one_in} of the sampled shots use at most", one_in)
        } else {
            say!("the planned shot uses at most")
        };
        let name = phrase(name_of_best(sweep));
        lines.push(say!(
            "{name} {interval} ms: within {} ms of it {what} {} of the limits",
            name,
            interval,
            room.rounded_down(HUNDREDTH),
            what,
            units::percent((1e3 * utilization).ceil() * 1e-3, 1)
        ));
        if let Some(risk) = sweep.best().and_then(|point| point.judged.risk.known()) {
            lines.push(say!(
                "its full verdict is PASS: {}, surely fewer than accepted; fresh draws confirm it",
                sampled(risk)
            ));
            lines.extend(thin.map(|thin| say!("but its pass is THIN: {}", thin_words(thin))));
        }
    } else if has_risk && sweep.failed_full_verdict == 0 && sweep.windows.iter().all(|[from, to]| from == to)
    {
        lines.push(say!("no interval is recommended: no window worth a check is wider than a point"));
    }
    if sweep.failed_full_verdict > 0 {
        let none = if sweep.recommended.is_some() {
            phrase("other intervals that do not")
        } else {
            phrase("no interval is recommended: the deepest intervals do not")
        };
        lines.push(say!("{none} pass their full verdict: {}", none, sweep.failed_full_verdict));
    }
    lines
}

/// Why intervals of the plan that pass as planned are not the recommended interval: Compare may recommend one of them.
fn why_not(case: &Case, sweep: &Sweep) -> Option<String> {
    let best = sweep.recommended?;
    let of_plan: Vec<Time> = case.plan.delays.iter().filter_map(|delay| sweep.interval_of(delay)).collect();
    let is_other = |point: &&Point| {
        let passes = point.judged.planned.verdict == Verdict::Pass;
        passes && point.interval != best.interval && of_plan.contains(&point.interval)
    };
    let (failing, others): (Vec<&Point>, Vec<&Point>) =
        sweep.points.iter().filter(is_other).partition(|point| point.verdict() == Verdict::Fail);
    let room = |point: &&Point| sweep.room_beside(point.interval);
    let (in_window, outside): (Vec<&Point>, Vec<&Point>) =
        others.into_iter().partition(|point| room(point).is_some());
    let (edge, in_window): (Vec<&Point>, Vec<&Point>) =
        in_window.into_iter().partition(|point| room(point).is_some_and(|room| room < HUNDREDTH));
    let (narrow, rest): (Vec<&Point>, Vec<&Point>) =
        in_window.into_iter().partition(|point| room(point).is_some_and(|room| room < best.room));
    let listed = |points: &[&Point]| points.iter().map(|point| point.interval.to_string()).join(", ");
    let rooms =
        narrow.iter().filter_map(room).map(|room| room.rounded_down(HUNDREDTH).to_string()).join(", ");
    let said =
        |points: &[&Point], why: &dyn Fn(String) -> String| (!points.is_empty()).then(|| why(listed(points)));
    let all = [
        said(&failing, &|named| say!("why not {} ms of the plan: it fails", named)),
        said(&outside, &|named| {
            say!("why not {} ms of the plan: too many of its shots fail, or may fail", named)
        }),
        said(&edge, &|named| say!("why not {} ms of the plan: what is accepted ends there", named)),
        said(&narrow, &|named| {
            say!("why not {} ms of the plan: intervals only {} ms beside it are not accepted", named, rooms)
        }),
        said(&rest, &|named| say!("why not {} ms of the plan: limits are nearer", named)),
    ];
    let all = all.into_iter().flatten().join("; ");
    (!all.is_empty()).then_some(all)
}

/// Distance from an option of the plan to the nearest interval that is not accepted, where that distance is shorter than at the
/// recommended interval; then the distance at the recommended interval. Both are parts of a sentence; `None` otherwise.
pub fn nearer_than_recommended(sweep: &Sweep, delay: &DelayOption) -> Option<[String; 2]> {
    let (best, interval) = (sweep.recommended?, sweep.interval_of(delay)?);
    let room = sweep.room_beside(interval).filter(|room| *room < best.room)?;
    let [room, best_room] = [room, best.room].map(|room| room.rounded_down(HUNDREDTH));
    Some([
        match room {
            Time::ZERO => "what is accepted ends at this interval".to_owned(),
            room => format!("intervals only {room} ms beside it are not accepted"),
        },
        format!("; {} ms has {best_room} ms", best.interval),
    ])
}

fn conclusion(case: &Case, swept: &Computed<Sweep>) -> Conclusion {
    let Computed { value: sweep, partial } = swept;
    let so_far = if *partial { phrase(" so far") } else { "" };
    let best = sweep.best().map(|best| format!("{} ms", best.interval));
    let has_risk = sweep.has_risk();
    let thin = sweep.recommended.and_then(|best| best.thin);
    let answer = match best {
        _ if sweep.points.is_empty() => say!("no interval was tried"),
        Some(best) if has_risk => match thin {
            None => say!("{best} is recommended; fresh draws confirm it", best),
            Some(thin) => say!("{best} is recommended, but passes thinly: {}", best, thin_words(thin)),
        },
        Some(best) => say!(
            "{best} lies deepest among intervals that pass{NOTHING_VARIED}",
            best,
            phrase(NOTHING_VARIED)
        ),
        None => say!("no interval is recommended{so_far}", so_far),
    };
    let passing = sweep.points.iter().filter(|point| point.judged.planned.verdict == Verdict::Pass).count();
    let count = say!("{passing} of {} tried{so_far} pass as planned", passing, sweep.points.len(), so_far);
    // A pass as planned is no pass. Beside an interval that does pass, the count would read as passes.
    let more = match has_risk && sweep.recommended.is_some() {
        true => why_not(case, sweep),
        false => (!sweep.points.is_empty()).then_some(count),
    };
    let caveat = if has_risk { pass_caveat(case, true) } else { "" };
    let text = [answer + caveat].into_iter().chain(more).collect::<Vec<_>>().join(" · ");
    Conclusion::new(word_of(swept), text)
}

/// The word of a sweep: the word of the pass of the recommended interval.
fn word_of(swept: &Computed<Sweep>) -> VerdictWord {
    match swept.value.recommended {
        Some(Recommended { thin: Some(_), .. }) => VerdictWord::Thin,
        _ => swept.verdict().into(),
    }
}

/// The recommended interval, and the window around it, in one line.
pub fn in_brief(case: &Case, sweep: &Computed<Sweep>) -> Brief {
    let charts = charts::sweep(case, &sweep.value);
    let shares = charts.last().map(|chart| charts::shares_along(chart, f64::max)).unwrap_or_default();
    let Some(best) = sweep.value.best() else {
        return Brief::judged(sweep.verdict(), vec!["no interval is recommended".to_owned()])
            .drawn_as(shares);
    };
    let name = format!("{} ms", best.interval);
    let around = sweep.value.windows.iter().find(|[from, to]| (*from..=*to).contains(&best.interval));
    // The window in whole milliseconds, rounded inward.
    let around = around.map(|[from, to]| [from.ms().ceil(), to.ms().floor()]).filter(|[from, to]| from < to);
    let with_window = around.map(|[from, to]| format!("{name}; others of {from} to {to} ms not proven"));
    Brief::judged(sweep.verdict(), with_window.into_iter().chain([name]).collect()).drawn_as(shares)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::{HoleTiming, Plan};
    use crate::report::sweep_windows::rounded_inward;
    use crate::study::judge::brief_judgement::BriefJudgement;
    use crate::study::judge::grounds::Evidence;
    use crate::study::samples::risk_summary::RiskSummary;
    use crate::study::standing::tests::sampled;

    fn case() -> Case {
        let plan = Plan::parse("", include_str!("../../plans/amur-three-rows.toml"));
        Case::new(plan.unwrap_or_else(|mistakes| panic!("{mistakes}")))
    }

    fn swept(points: Vec<Point>, windows: Vec<[Time; 2]>) -> Sweep {
        Sweep {
            order: vec![0, 1, 2],
            holes: HoleTiming::TOGETHER,
            points,
            windows_as_planned: windows.clone(),
            windows,
            recommended: None,
            failed_full_verdict: 0,
        }
    }

    /// A single interval that passes between two that do not is no window.
    #[test]
    fn a_window_is_wider_than_a_point() {
        let case = case();
        let windows =
            [[10.0, 10.0], [20.0, 30.0], [40.0, 40.0]].map(|window| window.map(Time::from_ms)).to_vec();
        let value = swept(Vec::new(), windows);
        let report = report(&case, &Computed { value, partial: false });
        let text = crate::report::json::json(&[report]).expect("a document");
        let document: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        for windows in ["windows_s", "nominal_windows_s"] {
            assert_eq!(document[windows], serde_json::json!([[0.02, 0.03]]));
        }
    }

    /// A script that takes its interval from a passing window takes an interval whose full verdict passes, never an interval that
    /// few samples leave open.
    #[test]
    fn a_passing_window_of_samples_holds_only_full_verdicts() {
        let case = case();
        let point = |ms: f64, shots: usize, is_quick: bool| {
            let planned = ShotSummary { verdict: Verdict::Pass, ..ShotSummary::FAILED_RUN };
            let mut judged = BriefJudgement::of_planned_alone(&case, planned);
            let sampled = sampled(&case, shots, 0).sampled;
            judged.risk = Evidence::Known(RiskSummary::of(sampled.known().expect("samples")));
            Point { interval: Time::from_ms(ms), judged, is_quick }
        };
        let points = vec![point(10.0, 2000, true), point(11.0, 2000, false), point(12.0, 20, true)];
        let verdicts: Vec<Verdict> = points.iter().map(Point::verdict).collect();
        assert_eq!(verdicts, [Verdict::Pass, Verdict::Pass, Verdict::Undecided]);
        let windows = vec![[10.0, 12.0].map(Time::from_ms)];
        let value = swept(points, windows);
        let report = report(&case, &Computed { value, partial: false });
        let text = crate::report::json::json(&[report]).expect("a document");
        let document: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        assert_eq!(document["windows_s"], serde_json::json!([[0.011, 0.011]]));
        assert_eq!(document["worth_a_check_s"], serde_json::json!([[0.01, 0.012]]));
    }

    /// The text says of an option that it fails, not that it is less deep. It says nothing of an option that fires in another
    /// order.
    #[test]
    fn why_not_an_interval_of_the_plan_says_what_fails() {
        let case = case();
        let point = |ms: f64, verdict| {
            let planned = ShotSummary { verdict, ..ShotSummary::FAILED_RUN };
            let judged = BriefJudgement::of_planned_alone(&case, planned);
            Point { interval: Time::from_ms(ms), judged, is_quick: false }
        };
        use Verdict::{Fail, Pass};
        let passing = [9.0, 20.0, 25.0, 42.0, 109.0].map(|ms| point(ms, Pass));
        let mut points: Vec<Point> = passing.into_iter().chain([point(500.0, Fail)]).collect();
        let half_fail = sampled(&case, 200, 100).sampled;
        points[1].judged.risk =
            half_fail.known().map_or(Evidence::NotAsked, |sampled| Evidence::Known(RiskSummary::of(sampled)));
        let [interval, room] = [90.0, 30.0].map(Time::from_ms);
        let sweep = Sweep {
            recommended: Some(Recommended { interval, room, utilization: 0.5, thin: None }),
            ..swept(points, vec![[40.0, 150.0].map(Time::from_ms)])
        };
        assert_eq!(
            why_not(&case, &sweep).as_deref(),
            Some(
                "why not 20 ms of the plan: it fails; \
                 why not 9 ms of the plan: too many of its shots fail, or may fail; \
                 why not 42 ms of the plan: intervals only 2 ms beside it are not accepted; \
                 why not 109 ms of the plan: limits are nearer"
            )
        );
    }

    #[test]
    fn windows_are_rounded_inward() {
        let rounded = |window: [f64; 2]| rounded_inward(window.map(Time::from_ms)).map(|end| end.to_string());
        assert_eq!(rounded([257.65625, 263.34375]), ["257.66", "263.34"]);
        assert_eq!(rounded([0.0, 30.5]), ["0", "30.5"]);
    }

    /// A gap is reported, however narrow: nothing in it passes.
    #[test]
    fn windows_are_one_where_only_narrow_gaps_part_them() {
        let windows =
            [[0.0, 203.37], [203.66, 230.53], [231.53, 240.0]].map(|window| window.map(Time::from_ms));
        assert_eq!(
            listed("worth a check", &windows),
            ["worth a check: 0 ms to 230.53 ms without 203.37 ms to 203.66 ms · 231.53 ms to 240 ms"]
        );
    }

    #[test]
    fn a_sweep_passes_only_where_an_interval_is_recommended() {
        let case = case();
        let said = |verdicts: &[Verdict], recommended: bool, partial: bool| {
            let as_planned = |verdict| ShotSummary { verdict, ..ShotSummary::FAILED_RUN };
            let point = |(n, &verdict): (usize, &Verdict)| Point {
                interval: Time::from_ms(n as f64),
                judged: BriefJudgement::of_planned_alone(&case, as_planned(verdict)),
                is_quick: false,
            };
            let points = verdicts.iter().enumerate().map(point).collect();
            let deepest =
                Recommended { interval: Time::from_ms(1.0), room: Time::ZERO, utilization: 0.0, thin: None };
            let value = Sweep {
                order: vec![0, 1],
                holes: HoleTiming::TOGETHER,
                points,
                windows_as_planned: Vec::new(),
                windows: Vec::new(),
                recommended: recommended.then_some(deepest),
                failed_full_verdict: 0,
            };
            conclusion(&case, &Computed { value, partial }).word.verdict()
        };
        use Verdict::{Fail, Pass, Undecided};
        assert_eq!(said(&[Pass, Pass], true, false), Pass);
        assert_eq!(said(&[Fail, Pass], true, true), Pass);
        assert_eq!(said(&[Pass, Pass], false, false), Undecided);
        assert_eq!(said(&[Fail, Fail], false, false), Fail);
        assert_eq!(said(&[Fail, Fail], false, true), Undecided);
        assert_eq!(said(&[], false, true), Undecided);
    }
}
