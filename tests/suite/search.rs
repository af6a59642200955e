//! The search of firing schedules, against all schedules judged one by one.

use shelter::plan::{HoleTiming, Plan, PlanSource, Time, edit};
use shelter::report;
use shelter::report::words::headline::headline;
use shelter::study::as_planned::check::check_shot;
use shelter::study::eight_ms::WithinEightMs;
use shelter::study::judge::OptionResults;
use shelter::study::judge::recommend::recommended;
use shelter::study::orders::try_orders;
use shelter::study::samples::failure_bounds::ErrorShare;
use shelter::study::samples::sample_count::Sampling;
use shelter::study::search::{MOST_TRIED, Search, search};
use shelter::study::{Case, ComputeSettings, Computed, Context, NoResult, Shard, StudyControl};
use shelter::verdict::Verdict;

use super::support::{Edited, json, shelter, text};

/// A shelter of 5 × 3 tires over three rows; `choices` are the keys of `[search]`.
fn plan(choices: &str) -> String {
    format!(
        "# by hand\nshelter = {{ layout = \"grid\", rows = 5, columns = 3, spacing_m = 2 }}\ntire = {{ mass_kg = 280 }}\n\
         cable = {{ axial_stiffness_kn = 1519, breaking_force_kn = 90, slack_percent = 2 }}\nground = {{ friction = 0.5 }}\n\
         limits = {{ flight_height_m = 2.2, cable_safety_factor = 1.2, accepted_risk_percent = 5 }}\n\
         search = {{ {choices} }}\n\
         [[blast_row]]\nname = \"1\"\nunder_row = 2\nlaunch_m_s = 6\n\
         [[blast_row]]\nname = \"2\"\nunder_row = 3\nlaunch_m_s = 6.2\n\
         [[blast_row]]\nname = \"3\"\nunder_row = 4\nlaunch_m_s = 6.1\n\
         [[delay]]\nname = \"20 ms\" # ours\ninterval_ms = 20\n"
    )
}

fn case(text: &str) -> Case {
    let source = PlanSource { path: "plan.toml".into(), text: text.to_owned() };
    Case::parse(source).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

const FEW: Sampling = Sampling { least: 0, most: 200, seed: 1, error_share: ErrorShare::Whole };

fn searched(case: &Case, sampling: Option<&Sampling>) -> Search {
    let compute = ComputeSettings::of(&case.plan);
    search(&Context::new(case, compute, &StudyControl::default()).with_sampling(sampling.copied()))
        .expect("a result")
        .value
}

/// Every gap by itself, every order, with and without holes one after another: 6 × 3² × 3.
#[test]
fn all_schedules_are_counted_and_judged() {
    let choices = "intervals_ms = [9, 42, 67], equal_intervals = false, hole_intervals_ms = [17, 0], hole_orders = [\"left\", \"ends\"]";
    let found = searched(&case(&plan(choices)), None);
    assert_eq!((found.possible, found.complete), (6 * 9 * 3, true));
    // The shelter is its own image from left to right, but no two schedules are images of one another: a row from the left and one
    // from the right would be.
    assert_eq!(found.screened, found.possible);
    let both = choices.replace("\"ends\"", "\"right\"");
    let found = searched(&case(&plan(&both)), None);
    assert_eq!(
        (found.possible, found.screened),
        (6 * 9 * 3, 6 * 9 * 2),
        "from the right is the image of from the left"
    );
    let equal = searched(&case(&plan("intervals_ms = { from = 8, to = 10, step = 0.5 }")), None);
    assert_eq!((equal.possible, equal.screened), (6 * 5, 6 * 5));
}

/// As planned, the best is the best of all schedules checked one by one.
#[test]
fn as_planned_the_best_of_all_is_found() {
    let case = case(&plan("intervals_ms = [9, 25, 42, 109], equal_intervals = false"));
    let found = searched(&case, None);
    let compute = ComputeSettings::of(&case.plan);
    let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    let mut delays = Vec::new();
    for order in orders {
        for gaps_ms in itertools::iproduct!([9.0, 25.0, 42.0, 109.0], [9.0, 25.0, 42.0, 109.0]) {
            let schedule = shelter::study::search::Schedule {
                order: order.to_vec(),
                gaps: [gaps_ms.0, gaps_ms.1].map(Time::from_ms).to_vec(),
                hole_timing: shelter::plan::HoleTiming::TOGETHER,
            };
            delays.push(schedule.delay_option(schedule.name(&case.plan.blast_rows)));
        }
    }
    let all = Case::new(Plan { delays, ..case.plan.clone() });
    let results: OptionResults =
        Context::new(&all, compute, &StudyControl::default()).judge_options().expect("a result").value;
    let utilization = |results: &OptionResults| -> f64 {
        let of = results.iter().flatten().map(|judged| {
            let checked = &judged.checked;
            (checked.estimates.height.value / all.limits.height)
                .max(checked.estimates.force.value / all.limits.force)
        });
        of.fold(f64::INFINITY, f64::min)
    };
    // The race ranks by coarse runs, whose errors are some 1 %.
    assert!(utilization(&found.results) <= 1.01 * utilization(&results));
}

/// With samples, the least risk found is that of all schedules sampled one by one, within what 400 samples can tell.
#[test]
fn the_least_risk_of_all_is_found() {
    let case = case(&plan("intervals_ms = [9, 42], equal_intervals = false"));
    let all_at_once = Sampling { least: 400, most: 400, seed: 9, error_share: ErrorShare::Whole };
    let found = searched(&case, Some(&FEW));
    let share = |results: &OptionResults, n: usize| {
        let risk = results[n].as_ref().ok().and_then(|judged| judged.sampled.known());
        risk.and_then(|risk| risk.bounds.probability()).unwrap_or(1.0)
    };
    let compute = ComputeSettings::of(&case.plan);
    let mut delays = Vec::new();
    for order in itertools::Itertools::permutations(0..3, 3) {
        for (first, second) in itertools::iproduct!([9.0, 42.0], [9.0, 42.0]) {
            let schedule = shelter::study::search::Schedule {
                order: order.clone(),
                gaps: [first, second].map(Time::from_ms).to_vec(),
                hole_timing: shelter::plan::HoleTiming::TOGETHER,
            };
            delays.push(schedule.delay_option(schedule.name(&case.plan.blast_rows)));
        }
    }
    let all = Case::new(Plan { delays, ..case.plan.clone() });
    let results = Context::new(&all, compute, &StudyControl::default())
        .with_sampling(all_at_once)
        .sample_options()
        .expect("a result")
        .value;
    let least = (0..results.len()).map(|n| share(&results, n)).fold(1.0, f64::min);
    let best = found.case.plan.delays.iter().map(|delay| {
        let at = all.plan.delays.iter().position(|other| other.timing == delay.timing);
        share(&results, at.expect("one of all"))
    });
    let best = best.fold(1.0, f64::min);
    assert!(best <= least + 0.005, "{best} found, {least} is the least");
}

/// Compare, `check` and the page would recommend, of what was found, what the search calls its best.
#[test]
fn the_best_found_is_what_compare_would_recommend() {
    let case = case(&plan("intervals_ms = [9, 25, 42, 67, 109]"));
    let compute = ComputeSettings::of(&case.plan);
    let control = StudyControl::default();
    let found = search(&Context::new(&case, compute, &control).with_sampling(Some(FEW))).expect("a result");
    let Search { case: listed, results, .. } = &found.value;
    let best = &listed.plan.delays[0].name;
    assert!(listed.plan.delays.len() > 2 && found.verdict() == Verdict::Pass, "a test that can fail");
    assert_eq!(recommended(listed, results), Some(0), "{best}");
    assert!(headline(listed, results).to_string().starts_with(&format!("{best} passes, ")));
    let report = report::search::report(&case, &found);
    let said = report.conclusion.map(|conclusion| conclusion.text).expect("an answer");
    assert!(said.starts_with(&format!("the best schedule found: {best}")), "{said}");
}

#[test]
fn what_is_found_keeps_the_limits_of_the_search() {
    let choices = "intervals_ms = [9, 42, 67], equal_intervals = false, hole_intervals_ms = [0, 5, 9], longest_ms = 80, \
                   most_holes_in_8_ms = 2";
    let case = case(&plan(choices));
    let found = searched(&case, None);
    assert!(found.screened > 0 && found.screened < found.possible);
    for shot in &found.case.shots {
        assert!(shot.duration() <= 0.08 + 1e-9);
        assert!(WithinEightMs::of(&case, shot).holes <= 2);
    }
    let none = searched(&self::case(&plan("intervals_ms = [67], longest_ms = 80")), None);
    assert_eq!((none.screened, none.results.len()), (0, 0));
    assert_eq!(Computed::complete(none).verdict(), Verdict::Fail);
}

/// Rows 1, 2 and 3 lie in this order across the shelter: beside those that fired, 2³⁻¹ orders; one order where they are listed.
#[test]
fn rows_fire_beside_rows_that_have_fired() {
    let found = searched(&case(&plan("intervals_ms = [42], orders = \"adjacent\"")), None);
    assert_eq!((found.possible, found.screened), (4, 4));
    for schedule in &found.schedules {
        assert!(schedule.order != [0, 2, 1] && schedule.order != [2, 0, 1], "{:?}", schedule.order);
    }
    let found = searched(&case(&plan("intervals_ms = [42], orders = \"listed\"")), None);
    assert_eq!((found.possible, found.screened, &found.schedules[0].order[..]), (1, 1, &[0, 1, 2][..]));
}

/// Where there are too many, a search finds no worse than the best of those that it begins with, and says that it is a search.
#[test]
fn too_many_schedules_are_searched() {
    let choices = "intervals_ms = { from = 8, to = 150, step = 1 }, equal_intervals = false";
    let case = case(&plan(choices));
    let found = searched(&case, None);
    assert_eq!((found.possible, found.complete), (6 * 143 * 143, false));
    assert!(found.screened <= MOST_TRIED && found.screened > 2000, "{}", found.screened);
    let again = searched(&case, None);
    assert_eq!(found.schedules, again.schedules, "the same every time");
    for (n, schedule) in found.schedules.iter().enumerate() {
        assert!(found.schedules[..n].iter().all(|other| !other.is_nearly_same(schedule)), "told apart");
    }
}

/// Verdicts found are those of `check` on the plan with the schedules written into it, but for the stricter bounds of several
/// verdicts at once; comments stay, names are free.
#[test]
fn schedules_are_written_as_options_that_check_judges_alike() {
    let text = plan("intervals_ms = [9, 42, 67], equal_intervals = false, hole_intervals_ms = [0, 17.5]");
    let case = case(&text);
    let found = searched(&case, Some(&FEW));
    let delays: Vec<_> = found.case.plan.delays.iter().collect();
    let inline = text
        .edited("[[delay]]\nname = \"20 ms\" # ours\ninterval_ms = 20\n", "")
        .replace("# by hand\n", "# by hand\ndelay = [{ name = \"20 ms\", interval_ms = 20 }]\n");
    for text in [text.clone(), text.replace('\n', "\r\n"), inline] {
        let written = edit::add_delays(&text, &case.plan, &delays).expect("TOML");
        assert!(written.contains("# by hand"));
        let again = self::case(&written);
        assert_eq!(again.plan.delays.len(), 1 + delays.len());
        assert_eq!(&again.shots[1..], &found.case.shots[..]);
        let twice = edit::add_delays(&written, &again.plan, &delays).expect("TOML");
        assert_eq!(self::case(&twice).plan.delays.len(), 1 + 2 * delays.len(), "names are free");
    }
    let again = self::case(&edit::add_delays(&text, &case.plan, &delays).expect("TOML"));
    let compute = ComputeSettings::of(&again.plan);
    let checked = Context::new(&again, compute, &StudyControl::default())
        .with_sampling(FEW)
        .judge_options()
        .expect("a result")
        .value;
    for (found, checked) in found.results.iter().zip(&checked[1..]) {
        let [found, checked] = [found, checked].map(|result| result.as_ref().expect("a result"));
        assert_eq!(found.checked.estimates.height, checked.checked.estimates.height);
        let shared = |judged: &shelter::study::judge::Judgement| {
            let samples = &judged.sampled.known().expect("samples").samples;
            samples[..50.min(samples.len())].to_vec()
        };
        assert_eq!(shared(found), shared(checked), "the draws of `check`");
    }
}

/// Where one option of the plan is fired through, a dud takes holes along in every schedule found, and in every option written.
#[test]
fn schedules_beside_a_shot_that_is_fired_through_are_so_too() {
    let own = "interval_ms = 20\n";
    let text = plan("intervals_ms = [9, 42], hole_intervals_ms = [0, 17]")
        .edited(own, &format!("{own}fired_through = true\n"));
    let case = case(&text);
    let found = searched(&case, None);
    assert!(!found.case.shots.is_empty() && found.case.shots.iter().all(|shot| shot.fired_through));
    let delays: Vec<_> = found.case.plan.delays.iter().collect();
    let again = self::case(&edit::add_delays(&text, &case.plan, &delays).expect("TOML"));
    assert_eq!(&again.shots[1..], &found.case.shots[..]);
}

#[test]
fn the_command_prints_writes_and_refuses() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("plan.toml");
    let path = path.to_str().expect("UTF-8");
    std::fs::write(path, plan("intervals_ms = [42, 109]")).expect("written");
    let out = shelter(&["search", path, "--samples", "300", "--format", "json", "--write"]);
    let document = json(&out);
    assert_eq!(document["schema"], "shelter.search/1");
    assert_eq!((document["count"].as_u64(), document["possible"].as_u64()), (Some(12), Some(12)));
    let best = &document["found"][0];
    for key in [
        "order",
        "intervals_s",
        "hole_interval_s",
        "hole_order",
        "fire_at_s",
        "verdict",
        "probability",
        "interval_95",
        "launch_margin",
        "flight_height_m",
        "cable_force_n",
        "duration_s",
        "holes_in_8_ms",
    ] {
        assert!(!best[key].is_null(), "{key}: {best}");
    }
    assert!(text(&out.stderr).contains("written"), "{}", text(&out.stderr));
    assert!(!text(&out.stderr).contains("no permission to fire"), "{}", text(&out.stderr));
    let written = std::fs::read_to_string(path).expect("read");
    assert_eq!(case(&written).plan.delays[1].name, best["name"].as_str().expect("a name"));
    let again = shelter(&["search", path, "--samples", "300", "--write"]);
    assert!(text(&again.stderr).contains("in the plan already"), "{}", text(&again.stderr));
    assert_eq!(std::fs::read_to_string(path).expect("read"), written);
    // Into a plan that what was seen speaks against nothing is written.
    std::fs::write(path, plan("intervals_ms = [42, 109]")).expect("written");
    let seen = folder.path().join("plan.seen.json");
    std::fs::write(&seen, "damaged").expect("written");
    let held = shelter(&["search", path, "--nominal", "--write"]);
    assert!(text(&held.stderr).contains("nothing was written: observations"), "{}", text(&held.stderr));
    assert_eq!(std::fs::read_to_string(path).expect("read"), plan("intervals_ms = [42, 109]"));
    std::fs::remove_file(seen).expect("removed");
    let nominal = shelter(&["search", path, "--nominal", "--write"]);
    assert!(text(&nominal.stderr).contains("no permission to fire"), "{}", text(&nominal.stderr));
    std::fs::write(path, plan("intervals_ms = [42, 109]")).expect("written");
    let csv = shelter(&["search", path, "--nominal", "--format", "csv"]);
    assert!(text(&csv.stdout).starts_with("name,order,intervals_ms,"), "{}", text(&csv.stdout));
    std::fs::write(path, plan("intervals_ms = []")).expect("written");
    assert_eq!(shelter(&["search", path]).status.code(), Some(2));
    std::fs::write(path, plan("intervals_ms = { from = 9, to = 8, step = 1 }")).expect("written");
    assert_eq!(shelter(&["search", path]).status.code(), Some(2));
}

/// Stopped, a search has no result; without time it is partial and says so.
#[test]
fn a_search_can_end_early() {
    let case = case(&plan("intervals_ms = [9, 42], equal_intervals = false"));
    let compute = ComputeSettings::of(&case.plan);
    let stopped = StudyControl::default();
    stopped.stop();
    assert!(matches!(
        search(&Context::new(&case, compute, &stopped).with_sampling(FEW)),
        Err(NoResult::Stopped)
    ));
    let expired = StudyControl::default();
    expired.expire();
    let found = search(&Context::new(&case, compute, &expired).with_sampling(FEW)).expect("partial");
    assert!(found.partial && found.value.screened == 0 && !found.value.complete);
    assert_ne!(found.verdict(), Verdict::Pass);
}

/// On level ground two orders are images of one another; on a slope that falls from one row to the next they are not.
#[test]
fn a_slope_takes_mirror_images_away() {
    let alike = plan("intervals_ms = [42], orders = \"adjacent\"").replace("6.2", "6").replace("6.1", "6");
    let on_slope = |toward: f64| {
        case(&alike.edited(
            "friction = 0.5",
            &format!("friction = 0.5, slope_percent = 25, slope_toward_deg = {toward}"),
        ))
    };
    assert_eq!(searched(&case(&alike), None).screened, 2);
    assert_eq!(searched(&on_slope(0.0), None).screened, 2, "it falls along the rows");
    let falling = on_slope(90.0);
    assert_eq!(searched(&falling, None).screened, 4);
    let compute = ComputeSettings::of(&falling.plan);
    let tried = try_orders(
        &Context::new(&falling, compute, &StudyControl::default()),
        &[Time::from_ms(42.0)],
        HoleTiming::TOGETHER,
        Shard::WHOLE,
    );
    let tried = tried.expect("a result").value;
    let height = |order: [usize; 3]| {
        let of_order = tried.iter().find(|tried| tried.order == order);
        of_order.expect("every order").planned.values.height
    };
    for order in [[0, 1, 2], [2, 1, 0], [1, 0, 2], [1, 2, 0]] {
        let flow =
            &mut |_: shelter::study::as_planned::check::CheckProgress| std::ops::ControlFlow::Continue(());
        let checked = check_shot(
            &falling,
            &falling.shot(&order, Time::from_ms(42.0), &HoleTiming::TOGETHER),
            &compute,
            flow,
        )
        .expect("a result");
        let apart = (checked.estimates.height.value - height(order).value).abs();
        assert!(apart <= checked.estimates.height.error + height(order).error, "{order:?}");
    }
    assert!((height([0, 1, 2]).value - height([2, 1, 0]).value).abs() > 1e-3, "uphill is not downhill");
}

/// Limits that leave one schedule in a thousand leave all of these to the search; limits that leave none are named.
#[test]
fn tight_limits_leave_what_keeps_them() {
    let choices = "intervals_ms = { from = 9, to = 60, step = 1 }, equal_intervals = false, hole_intervals_ms = [0, 9, 17, 25]";
    let charged = plan(choices)
        .replace("launch_m_s", "charge_kg = 25\nlaunch_m_s")
        .edited("accepted_risk_percent = 5", "accepted_risk_percent = 5, charge_in_8_ms_kg = 25");
    let tight = case(&charged.replace("equal_intervals", "longest_ms = 70, equal_intervals"));
    let found = searched(&tight, None);
    let within_limits = found.within_limits.expect("all were looked at");
    assert!(
        within_limits > 0 && within_limits < found.possible / 30,
        "{within_limits} of {}",
        found.possible
    );
    assert!(found.complete && found.screened == within_limits, "{} of {within_limits}", found.screened);
    let refused = found.refused;
    assert_eq!(refused.too_long + refused.too_many_holes + refused.too_heavy + within_limits, found.possible);
    let none = searched(&case(&charged.edited("[0, 9, 17, 25]", "[0]")), None);
    assert_eq!((none.screened, none.refused.too_heavy), (0, none.possible));
    assert_eq!(Computed::complete(none).verdict(), Verdict::Fail);
    // More than can be listed, and few of them short enough.
    let many = "intervals_ms = { from = 9, to = 999, step = 1 }, equal_intervals = false, longest_ms = 100";
    let found = searched(&case(&plan(many)), None);
    assert!(found.within_limits.is_none() && !found.complete && found.screened > 100, "{}", found.screened);
}

/// A schedule that an option fires already has the name of that option; a name that another has is not taken.
#[test]
fn names_tell_options_apart() {
    let text = plan("intervals_ms = [42, 67], orders = \"listed\"");
    let named = |own: &str| {
        let case = case(&text.edited("name = \"20 ms\" # ours\ninterval_ms = 20", own));
        let found = searched(&case, None);
        let mut names: Vec<String> = found.case.plan.delays.iter().map(|delay| delay.name.clone()).collect();
        names.sort();
        names
    };
    assert_eq!(named("name = \"42 ms\"\ninterval_ms = 500"), ["42 ms (2)", "67 ms"]);
    assert_eq!(named("name = \"ours\"\ninterval_ms = 42"), ["67 ms", "ours"]);
}
