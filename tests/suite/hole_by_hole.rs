//! Holes of a row that fire one after another, and what fires within any 8 ms.

use std::ops::ControlFlow;

use itertools::Itertools;
use shelter::plan::{Plan, Time};
use shelter::report::words::plan_warnings;
use shelter::scene::Firing;
use shelter::study::eight_ms::WithinEightMs;
use shelter::study::orders::{self, try_orders};
use shelter::study::samples::random_shot::draw_shot;
use shelter::study::study_trait::{Study, Subject};
use shelter::study::sweep;
use shelter::study::{Case, ComputeSettings, Context, Intervals, NoResult, Shard, StudyControl};
use shelter::verdict::Verdict;

use super::support::Edited;

/// A shelter of 3 × `columns` tires over two rows; `row` is added to each row, `limits` to the limits, and `option` is the delay
/// option.
pub fn plan(columns: usize, row: &str, limits: &str, option: &str) -> String {
    format!(
        "shelter = {{ layout = \"grid\", rows = 3, columns = {columns}, spacing_m = 1.5 }}\ntire = {{ mass_kg = 280 }}\n\
         cable = {{ axial_stiffness_kn = 1519, breaking_force_kn = 90 }}\nground = {{ friction = 0.5 }}\n\
         limits = {{ flight_height_m = 9, cable_safety_factor = 1{limits} }}\n\
         blast_row = [{{ name = \"1\", under_row = 1, launch_m_s = 5{row} }}, {{ name = \"2\", under_row = 2, launch_m_s = 6{row} }}]\n\
         delay = [{{ name = \"a\", {option} }}]\n"
    )
}

fn case(text: &str) -> Case {
    Case::new(Plan::parse("plan", text).unwrap_or_else(|mistakes| panic!("{mistakes}")))
}

/// The mistake of a plan that is not valid.
fn mistake(text: &str) -> String {
    Plan::parse("plan", text).map(|_| ()).expect_err("a mistake").to_string()
}

/// Firing times of the tires of a row of 5 [ms], from left to right.
fn times_ms(case: &Case, row: usize) -> Vec<f64> {
    let mut firings: Vec<&Firing> = case.shots[0].firings.iter().filter(|f| f.row == row).collect();
    firings.sort_by_key(|firing| firing.tire);
    firings.iter().map(|firing| (firing.time * 1e6).round() * 1e-3).collect()
}

#[test]
fn holes_fire_from_the_left_the_right_the_centre_or_the_ends() {
    for (columns, order, first) in [
        (5, "left", vec![0.0, 17.0, 34.0, 51.0, 68.0]),
        (5, "right", vec![68.0, 51.0, 34.0, 17.0, 0.0]),
        (5, "centre", vec![34.0, 17.0, 0.0, 17.0, 34.0]),
        (5, "ends", vec![0.0, 17.0, 34.0, 17.0, 0.0]),
        (4, "centre", vec![17.0, 0.0, 0.0, 17.0]),
        (4, "ends", vec![0.0, 17.0, 17.0, 0.0]),
    ] {
        let option = format!("interval_ms = 42, hole_interval_ms = 17, hole_order = \"{order}\"");
        let case = case(&plan(columns, "", "", &option));
        assert_eq!(times_ms(&case, 0), first, "{order}");
        let second: Vec<f64> = first.iter().map(|at| at + 42.0).collect();
        assert_eq!(times_ms(&case, 1), second, "{order}: the row's own time is that of its first hole");
    }
}

/// A row that runs along y begins on the left at its smallest y.
#[test]
fn a_row_along_y_fires_along_y() {
    let holes = "holes = [{ x_m = 1.5, y_m = 3, launch_m_s = 5 }, { x_m = 1.5, y_m = 0, launch_m_s = 5 }]";
    let text = plan(4, "", "", "interval_ms = 42, hole_interval_ms = 17")
        .edited("under_row = 1, launch_m_s = 5", holes);
    let firings = case(&text).shots[0].firings.clone();
    let at: Vec<(usize, f64)> =
        firings.iter().filter(|f| f.row == 0).map(|firing| (firing.tire, firing.time)).collect();
    assert_eq!(at, [(1, 0.0), (9, 0.017)]);
}

/// What a survey is off in x turns no row round that runs along y; who lists its holes from its far end is told which one is the left.
#[test]
fn a_survey_turns_no_row_round() {
    let fired = |holes: &[[f64; 2]]| {
        let holes = holes.iter().map(|[x, y]| format!("{{ x_m = {x}, y_m = {y}, launch_m_s = 5 }}"));
        let holes = format!("holes = [{}]", holes.collect::<Vec<_>>().join(", "));
        let text = plan(4, "", "", "interval_ms = 42, hole_interval_ms = 17");
        let case = case(&text.edited("under_row = 1, launch_m_s = 5", &holes));
        let of_row = case.shots[0].firings.iter().filter(|firing| firing.row == 0);
        let numbers: Vec<usize> =
            of_row.sorted_by(|a, b| a.time.total_cmp(&b.time)).map(|f| f.number).collect();
        (numbers, plan_warnings::of_plan(&case).into_iter().find(|told| told.contains("from left to right")))
    };
    for off in [-0.2, -0.001, -1e-6, 0.0, 1e-6, 0.001, 0.2] {
        let up = [[1.5, 0.0], [1.5 + off, 1.5], [1.5 + 2.0 * off, 3.0]];
        assert_eq!(fired(&up), (vec![0, 1, 2], None), "off by {off}");
        let [a, b, c] = up;
        let (numbers, told) = fired(&[c, b, a]);
        assert_eq!(numbers, [2, 1, 0], "off by {off}");
        assert!(
            told.is_some_and(
                |told| told.contains("row 1:") && told.contains("the left one is hole 3, tire 1:2")
            )
        );
    }
}

/// Two parallel rows at 45°, one collar 2 cm off, begin at the same side; so do rows of which one is surveyed from the other end.
#[test]
fn parallel_rows_begin_at_the_same_side() {
    for off in [-0.02, 0.0, 0.02] {
        let row = |y: f64, off: f64| {
            let holes = (0..4).map(|n| {
                let (x, y) =
                    (f64::from(n) * 1.5, y + 4.5 - f64::from(n) * 1.5 + if n == 3 { off } else { 0.0 });
                format!("{{ x_m = {x}, y_m = {y}, launch_m_s = 5 }}")
            });
            format!("holes = [{}]", holes.collect::<Vec<_>>().join(", "))
        };
        let text = plan(6, "", "", "interval_ms = 42, hole_interval_ms = 17")
            .edited("rows = 3", "rows = 6")
            .edited("under_row = 1, launch_m_s = 5", &row(0.0, off))
            .edited("under_row = 2, launch_m_s = 6", &row(1.5, -off));
        let case = case(&text);
        for row in 0..2 {
            let first = case.shots[0].firings.iter().find(|firing| firing.row == row).expect("a hole");
            assert_eq!(first.tire % 6, 0, "row {row}, off by {off}: the smallest x");
        }
    }
}

/// A survey to the centimetre does not tear apart the two sides of a row fired from its middle.
#[test]
fn both_sides_fire_together_whatever_the_survey() {
    for (order, expected) in [("centre", [2, 1, 0, 1, 2]), ("ends", [0, 1, 2, 1, 0])] {
        let holes = [0.0, 1.51, 3.0, 4.48, 6.0].map(|x| format!("{{ x_m = {x}, y_m = 0, launch_m_s = 5 }}"));
        let option = format!("interval_ms = 500, hole_interval_ms = 17, hole_order = \"{order}\"");
        let text = plan(5, "", "", &option)
            .edited("under_row = 1, launch_m_s = 5", &format!("holes = [{}]", holes.join(", ")));
        assert_eq!(times_ms(&case(&text), 0), expected.map(|turn| 17.0 * f64::from(turn)), "{order}");
    }
}

/// The two sides of a row fired from its middle have detonators of their own: their times differ in every sample, by what two
/// chains of gaps with 4 % each scatter.
#[test]
fn the_sides_of_a_row_scatter_by_themselves() {
    let text = plan(5, "", "", "interval_ms = 500, hole_interval_ms = 17, hole_order = \"centre\"");
    let case = case(&format!("{text}\n[uncertainty]\ndelay_cv_percent = 4\n"));
    let (samples, mut squares) = (4000, 0.0);
    for number in 0..samples {
        let shot = draw_shot(&case, &case.shots[0], 1, number).shot;
        let at =
            |tire: usize| shot.firings.iter().find(|firing| firing.tire == tire).expect("a hole").time * 1e3;
        assert!(at(0) != at(4));
        squares += (at(0) - at(4)).powi(2);
    }
    // Two gaps of 17 ms on each side, 0.68 ms each.
    let (deviation, expected) = ((squares / f64::from(samples as u32)).sqrt(), 0.68 * 2.0);
    assert!((deviation / expected - 1.0).abs() < 0.05, "{deviation} {expected}");
}

/// The same schedule written out hole by hole has the same firings and the same results, to the bit.
#[test]
fn a_schedule_written_out_hole_by_hole_is_the_same_shot() {
    for order in ["left", "right", "centre", "ends"] {
        for (interval, hole) in [(42.0, 17.0), (9.3, 4.7), (0.0, 0.1)] {
            let option =
                format!("interval_ms = {interval}, hole_interval_ms = {hole}, hole_order = \"{order}\"");
            let short = case(&plan(5, "", "", &option));
            let mut rows = Vec::new();
            let mut at = Vec::new();
            for firing in &short.shots[0].firings {
                let (row, column) = (firing.tire / 5, firing.tire % 5);
                let turn = match order {
                    "left" => column,
                    "right" => 4 - column,
                    "centre" => column.abs_diff(2),
                    _ => 2 - column.abs_diff(2),
                };
                rows.push(format!(
                    "{{ name = \"{}\", holes = [{{ x_m = {}, y_m = {}, launch_m_s = {} }}] }}",
                    firing.tire,
                    1.5 * column as f64,
                    1.5 * row as f64,
                    [5, 6][row]
                ));
                at.push((row as f64 * interval + turn as f64 * hole).to_string());
            }
            let text = plan(5, "", "", &format!("at_ms = [{}]", at.join(", ")));
            let (head, tail) = text.split_once("blast_row = ").expect("the rows");
            let (_, tail) = tail.split_once('\n').expect("a line");
            let long = case(&format!("{head}blast_row = [{}]\n{tail}", rows.join(", ")));
            let plain = |case: &Case| -> Vec<Firing> {
                case.shots[0]
                    .firings
                    .iter()
                    .map(|&firing| Firing { row: 0, number: 0, from_left: 0, side: None, ..firing })
                    .collect()
            };
            assert_eq!(plain(&short), plain(&long), "{option}");
            let check = |case: &Case| {
                let checked = case.check_as_planned(0, &ComputeSettings::of(&case.plan)).expect("a result");
                [checked.estimates.height, checked.estimates.force, checked.estimates.drift]
            };
            if hole == 17.0 {
                assert_eq!(check(&short), check(&long), "{option}");
            }
        }
    }
}

/// Ten holes 2 ms apart: four within [t, t + 8 ms), and at 8 ms apart one, though 3 × 8 ms in binary is not 24 ms exactly.
#[test]
fn most_holes_and_the_heaviest_charge_within_8_ms() {
    let together = |hole_ms: f64, row: &str| {
        let case = case(&plan(10, row, "", &format!("interval_ms = 500, hole_interval_ms = {hole_ms}")));
        WithinEightMs::of(&case, &case.shots[0])
    };
    for (hole_ms, holes) in [(2.0, 4), (8.0, 1), (7.999, 2), (8.0004, 1), (2.7, 3), (0.0, 10)] {
        assert_eq!(together(hole_ms, ""), WithinEightMs { holes, charge: None }, "{hole_ms} ms");
        let charge = Some(12.5 * holes as f64);
        assert_eq!(together(hole_ms, ", charge_kg = 12.5"), WithinEightMs { holes, charge }, "{hole_ms} ms");
    }
    let text = plan(4, "", "", "interval_ms = 3")
        .edited("under_row = 1, launch_m_s = 5", "under_row = 1, launch_m_s = 5, charge_kg = 20")
        .edited("under_row = 2, launch_m_s = 6", "under_row = 2, launch_m_s = 6, charge_kg = 7");
    let case = case(&text);
    let together = WithinEightMs::of(&case, &case.shots[0]);
    assert_eq!(together, WithinEightMs { holes: 8, charge: Some(108.0) }, "both rows within 3 ms");
}

#[test]
fn limits_within_8_ms_fail_the_shot_as_planned_and_no_sample() {
    let verdict = |limits: &str| {
        let case = case(&plan(5, ", charge_kg = 10", limits, "interval_ms = 25, hole_interval_ms = 5"));
        let checked = case.check_as_planned(0, &ComputeSettings::of(&case.plan)).expect("a result");
        (checked.verdict, checked.reasons.len())
    };
    assert_eq!(verdict(""), (Verdict::Pass, 0));
    assert_eq!(verdict(", holes_in_8_ms = 2, charge_in_8_ms_kg = 20"), (Verdict::Pass, 0));
    assert_eq!(verdict(", holes_in_8_ms = 1, charge_in_8_ms_kg = 20"), (Verdict::Fail, 1));
    assert_eq!(verdict(", holes_in_8_ms = 1, charge_in_8_ms_kg = 19.9"), (Verdict::Fail, 2));
}

#[test]
fn what_cannot_be_meant_is_a_mistake() {
    let said = mistake(&plan(5, "", "", "interval_ms = 25, hole_order = \"left\""));
    assert!(said.contains("`hole_order` stands without `hole_interval_ms`"), "{said}");
    let said = mistake(&plan(5, "", "", "interval_ms = 25, hole_interval_ms = 5, hole_order = \"middle\""));
    assert!(said.contains("hole_order"), "{said}");
    let said = mistake(&plan(5, "", ", charge_in_8_ms_kg = 20", "interval_ms = 25"));
    assert!(said.contains("has no charge to judge"), "{said}");
    let some = plan(5, "", "", "interval_ms = 25").edited("launch_m_s = 5", "launch_m_s = 5, charge_kg = 9");
    assert!(mistake(&some).contains("some holes have `charge_kg`, others have none"));
    let said = mistake(&plan(5, "", ", holes_in_8_ms = 0", "interval_ms = 25"));
    assert!(said.contains("holes_in_8_ms"), "{said}");
}

/// Gaps between rows and gaps between the holes of a row scatter by themselves: with 2 % of each gap, the n-th hole of the second
/// row of gaps of 17 ms after a gap of 42 ms has the variance (0.84² + n 0.34²) ms². Of 4,000 samples the standard deviation is
/// within 5 % (2.2 standard errors are 2.5 %).
#[test]
fn each_gap_scatters_by_itself_and_shifts_what_follows() {
    let text = plan(5, "", "", "interval_ms = 42, hole_interval_ms = 17");
    let case = case(&format!("{text}\n[uncertainty]\ndelay_cv_percent = 2\n"));
    let mut sums = [[0.0; 5]; 2];
    let mut squares = [[0.0; 5]; 2];
    let samples = 4000;
    for number in 0..samples {
        let drawn = draw_shot(&case, &case.shots[0], 1, number);
        for firing in &drawn.shot.firings {
            let planned = firing.row as f64 * 42.0 + (firing.tire % 5) as f64 * 17.0;
            let late = firing.time * 1e3 - planned;
            sums[firing.row][firing.tire % 5] += late;
            squares[firing.row][firing.tire % 5] += late * late;
        }
    }
    for row in 0..2 {
        for hole in 0..5 {
            let n = samples as f64;
            let mean = sums[row][hole] / n;
            let deviation = (squares[row][hole] / n - mean * mean).sqrt();
            let expected = (row as f64 * 0.84_f64.powi(2) + hole as f64 * 0.34_f64.powi(2)).sqrt();
            assert!(
                (deviation - expected).abs() <= 0.05 * expected + 1e-9,
                "{row} {hole}: {deviation} {expected}"
            );
            assert!(mean.abs() < 4.0 * expected / n.sqrt() + 1e-9, "{row} {hole}: {mean}");
        }
    }
}

/// Two oblique rows are mirror images, but both count "from the left" the same way: fired hole by hole, one shot is no image of the
/// other, and its force is that of `check`.
#[test]
fn orders_of_rows_that_are_images_are_judged_as_their_holes_fire() {
    let row = |name: &str, holes: [(f64, f64); 3]| {
        let hole = |(x, y)| format!("{{ x_m = {x}, y_m = {y}, launch_m_s = 5 }}");
        format!("{{ name = \"{name}\", holes = [{}] }}", holes.map(hole).join(", "))
    };
    let rows =
        [row("B", [(12.0, 0.0), (10.0, 0.0), (8.0, 2.0)]), row("A", [(0.0, 0.0), (2.0, 0.0), (4.0, 2.0)])];
    for (hole_order, images) in [("left", false), ("right", false), ("centre", true)] {
        let option = |name: &str, order: &str| {
            format!(
                "{{ name = \"{name}\", interval_ms = 60, order = [{order}], hole_interval_ms = 42, hole_order = \"{hole_order}\" }}"
            )
        };
        let text = format!(
            "shelter = {{ layout = \"grid\", rows = 3, columns = 7, spacing_m = 2 }}\ntire = {{ mass_kg = 280 }}\n\
             cable = {{ axial_stiffness_kn = 1400, breaking_force_kn = 24.75 }}\nground = {{ friction = 0.5 }}\n\
             limits = {{ flight_height_m = 1.5, cable_safety_factor = 1.5 }}\nblast_row = [{}]\ndelay = [{}, {}]\n",
            rows.join(", "),
            option("first", "\"B\", \"A\""),
            option("second", "\"A\", \"B\""),
        );
        let case = case(&text);
        let compute = ComputeSettings::of(&case.plan);
        let control = StudyControl::default();
        let tried = try_orders(
            &Context::new(&case, compute, &control),
            &[Time::from_ms(60.0)],
            case.plan.shared_hole_timing().expect("one way"),
            Shard::WHOLE,
        );
        let forces = tried.expect("a result").value.into_iter().map(|tried| {
            let checked = case.check_as_planned(tried.order[0], &compute).expect("a result").estimates.force;
            let force = tried.planned.values.force;
            let error = force.error + checked.error;
            assert!((force.value - checked.value).abs() <= error, "{hole_order}: {force:?} {checked:?}");
            checked
        });
        let [first, second] = forces.collect::<Vec<_>>()[..] else { panic!("two orders") };
        let differ = (first.value - second.value).abs() > first.error + second.error;
        assert_eq!(differ, !images, "{hole_order}: {first:?} {second:?}");
    }
}

/// A study that varies the interval fires the holes of each row as the options do, where all do so alike.
#[test]
fn studies_keep_the_holes_of_the_options() {
    let text = plan(5, "", "", "interval_ms = 42, hole_interval_ms = 17, hole_order = \"right\"");
    let alike = case(&text);
    let holes = alike.plan.shared_hole_timing().expect("one way");
    assert_eq!(alike.shot(&[0, 1], Time::from_ms(42.0), &holes), alike.shots[0]);
    assert_eq!(alike.plan.intervals(Some(holes)), [42.0].map(Time::from_ms));
    let both = text.edited("delay = [", "delay = [{ name = \"b\", interval_ms = 9 }, ");
    let differing = case(&both);
    assert_eq!(differing.plan.hole_timing_of(None), None);
    assert_eq!(differing.plan.intervals(None), [9.0, 42.0].map(Time::from_ms));
    let (compute, control) = (ComputeSettings::of(&differing.plan), StudyControl::default());
    let context = Context::new(&differing, compute, &control);
    let intervals = Intervals { from: Time::ZERO, to: Time::from_ms(10.0), step: Time::from_ms(5.0) };
    let swept = sweep::Question { order: vec![0, 1], intervals, holes: None }.answer(&context);
    assert!(matches!(swept, Err(NoResult::HolesDiffer)), "which of them is meant?");
    let tried = orders::Question { intervals: vec![Time::from_ms(9.0)], holes: None }.answer(&context);
    assert!(matches!(tried, Err(NoResult::HolesDiffer)));
    let [together, in_turn] =
        [0, 1].map(|option| differing.plan.hole_timing_of(Some(option)).expect("holes"));
    assert_eq!(differing.shot(&[0, 1], Time::from_ms(42.0), &in_turn), differing.shots[1]);
    assert_eq!(differing.plan.intervals(Some(together)), [9.0].map(Time::from_ms));
    // The terminal means the option that is selected.
    assert_eq!(orders::Question::usual(&differing, Subject::option(1)).holes, Some(in_turn));
    assert_eq!(sweep::Question::usual(&differing, Subject::option(0)).holes, Some(together));
    let flow = &mut |_: shelter::study::as_planned::check::CheckProgress| ControlFlow::Continue(());
    let checked = shelter::study::as_planned::check::check_shot(
        &differing,
        &differing.shot(&[0, 1], Time::from_ms(9.0), &together),
        &compute,
        flow,
    );
    let own = differing.check_as_planned(0, &compute);
    assert_eq!(checked.expect("a result").estimates.height, own.expect("a result").estimates.height);
}
