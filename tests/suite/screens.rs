//! The screens, drawn without a terminal.

use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::Duration;

use crossterm::event::KeyCode;
use itertools::Itertools;
use ratatui::buffer::{Buffer, Cell};
use ratatui::style::{Color, Modifier, Style};
use shelter::jobs::{News, StudyAt};
use shelter::plan::edit::fields::remove_delay;
use shelter::plan::{HoleTiming, PlanSource, Time, Timing};
use shelter::report;
use shelter::report::charts;
use shelter::report::csv::Separators;
use shelter::report::parts::SeriesKind;
use shelter::report::words::warnings;
use shelter::simulation::RunError;
use shelter::study::as_planned::margin::LaunchMargin;
use shelter::study::assumptions::assumed::{Assumed, Ranged, Side, Spread};
use shelter::study::assumptions::{Assumption, Assumptions};
use shelter::study::course_band::CourseBand;
use shelter::study::effects::{EffectsOnOptions, effects};
use shelter::study::judge::deciding_shot::DecidingSamples;
use shelter::study::judge::grounds::Evidence;
use shelter::study::judge::one_dud::OneDud;
use shelter::study::judge::recommend::MustPass;
use shelter::study::judge::recommend::recommended;
use shelter::study::judge::{Judgement, Part};
use shelter::study::question::{Found, StudyKind};
use shelter::study::risk::Risks;
use shelter::study::samples::risk_summary::RiskSummary;
use shelter::study::samples::sample_count::Sampling;
use shelter::study::search::{FrontPoint, RoughShare, Schedule};
use shelter::study::work::progress::Progress;
use shelter::study::{Case, Computed, Context, NoResult, ShotSummary, StudyControl};
use shelter::tui::app::{App, Request};
use shelter::tui::compare::{OptionState, results};
use shelter::tui::config::Config;
use shelter::tui::export;
use shelter::tui::keymap::BINDINGS;
use shelter::tui::player::ShownShot;
use shelter::tui::prompt::Purpose;
use shelter::tui::screen::Screen;
use shelter::tui::studies::StudyState;
use shelter::tui::theme::{self, Theme};
use shelter::verdict::{Verdict, VerdictWord};

use super::support::Edited;
use super::support::stage::{
    app, begun, checked, deciding, done, draw, finished, fitted, judgement, key, measured, recommend,
    recorded, samples, save, spreads, study_ends, swept, text, withstood_dud,
};

#[test]
fn compare_at_three_sizes() {
    for (width, height) in [(80, 24), (120, 36), (200, 60)] {
        insta::assert_snapshot!(format!("compare_{width}x{height}"), text(&draw(&finished(), width, height)));
    }
}

#[test]
fn computing_failed_and_enlarged() {
    let mut app = app();
    app.options[0] = done(judgement(&app.case, 1), false);
    app.options[1] = OptionState::Running { runs: 2, done: 0.45 };
    app.options[2] = OptionState::Failed(NoResult::Failed(RunError::Diverged { time: 0.3 }));
    app.selected = 1;
    insta::assert_snapshot!("computing", text(&draw(&app, 100, 30)));
    app.selected = 2;
    insta::assert_snapshot!("failed", text(&draw(&app, 100, 30)));
    app.selected = 0;
    key(&mut app, KeyCode::Enter);
    insta::assert_snapshot!("enlarged", text(&draw(&app, 100, 30)));
}

/// Nobody takes a verdict as planned for the verdict, and a fail is told at once.
#[test]
fn samples_stream_in_and_decide() {
    let mut app = app();
    for (option, verdict) in [(0, Verdict::Fail), (1, Verdict::Pass)] {
        app.take_news(News::Checked { option, result: begun(&app.case, verdict) });
    }
    let line = |app: &App, name: &str| {
        let screen = text(&draw(app, 170, 36));
        screen
            .lines()
            .find(|line| line.trim_start_matches([' ', '▸']).starts_with(name))
            .expect(name)
            .to_owned()
    };
    assert!(line(&app, "all at once").contains("FAIL"));
    // What is not yet judged counts the shots that were tried, behind a mark that turns.
    let turns = |app: &App, tried: &str| {
        let is_mark = |letter: &char| ('\u{2800}'..='\u{28ff}').contains(letter);
        let mark = |beat| line(&App { beat, ..app.clone() }, "9 ms").chars().find(is_mark).expect("a mark");
        assert!(line(app, "9 ms").contains(&format!(" {tried} ")), "{}", line(app, "9 ms"));
        assert!((1..8).all(|beat| mark(beat) != mark(beat - 1)));
    };
    turns(&app, "0");
    assert!(line(&app, "9 ms").contains(" 0…"));
    assert!(app.busy());
    let news = |app: &App, count, more| {
        let sampled = Box::new(samples(&app.case, count, false));
        News::Found { option: 1, part: Part::Samples { sampled, more } }
    };
    app.take_news(news(&app, 200, true));
    let sampling = line(&app, "9 ms");
    turns(&app, "200");
    assert!(sampling.contains("200…"), "{sampling}");
    app.take_news(news(&app, 500, false));
    // A pass beside others waits for the draws that confirm it.
    turns(&app, "more");
    let drawn = RiskSummary::of(&samples(&app.case, 600, false));
    app.take_news(News::Found { option: 1, part: Part::Confirmation(Box::new(drawn)) });
    assert!(line(&app, "9 ms").contains("… wait"), "what it stands on is still to be found");
    app.assumptions[1] = Some(Box::new(Assumptions { all: Vec::new(), ..three_nearest() }));
    assert!(line(&app, "9 ms").contains("✓ PASS") && !line(&app, "9 ms").contains('…'));
    app.take_news(News::Checked { option: 0, result: Err(NoResult::OutOfTime) });
    assert!(matches!(app.options[0], OptionState::Failed(NoResult::OutOfTime)));
}

/// A run of a sample that no longer decides is not drawn.
#[test]
fn only_the_sample_that_decides_now_is_drawn() {
    let mut app = app();
    app.take_news(News::Checked { option: 1, result: begun(&app.case, Verdict::Pass) });
    let sampled = samples(&app.case, 500, false);
    // Of 500, five are left out at 1 %; the later a sample, the higher it flies.
    assert_eq!(sampled.deciding_sample(), Some(494));
    let part = Part::Samples { sampled: Box::new(sampled.clone()), more: true };
    app.take_news(News::Found { option: 1, part });
    let head = |app: &App| text(&draw(app, 80, 24)).lines().nth(4).expect("the heads").to_owned();
    let samples = DecidingSamples::of(&sampled, Sampling::OF_VERDICT.seed).expect("decided samples");
    for (number, drawn) in [(7, "as planned"), (494, "1 in 100"), (7, "1 in 100")] {
        let mut run = deciding(&app.case, 1);
        run.samples = samples;
        run.samples.of_any.number = number;
        app.take_news(News::Found { option: 1, part: Part::Deciding(Box::new(run)) });
        assert!(head(&app).contains(drawn), "{number}: {}", head(&app));
        assert_eq!(app.shown_sample(1).map(|sample| sample.number), (drawn == "1 in 100").then_some(494));
    }
}

#[test]
fn the_header_says_what_a_pass_is_about() {
    let mut app = finished();
    let assumed = "inputs assumed";
    assert!(!text(&draw(&app, 120, 36)).contains(assumed));
    Arc::make_mut(&mut app.case).plan.uncertainty.assumed = true;
    assert!(text(&draw(&app, 120, 36)).contains(assumed));
    assert!(text(&draw(&app, 80, 24)).contains(assumed));
}

const LABELS: [&str; 7] = ["fails", "limited", "then", "holds", "one dud", "depends", "next"];

/// The lines of the detail, each as its label and its text; of a wide screen those left of the cables.
fn detail_lines(app: &App, width: u16) -> Vec<(usize, &'static str, String)> {
    let screen = text(&draw(app, width, 36));
    let body = width - 1;
    let column = usize::from(if width < 120 { width } else { body - body * 9 / 20 - 1 });
    let lines = screen.lines().enumerate().filter_map(|(n, line)| {
        let left: String = line.chars().take(column).collect();
        let label = LABELS.into_iter().find(|label| left.starts_with(&format!(" {label:9}")))?;
        Some((n, label, left[10..].trim().to_owned()))
    });
    lines.collect()
}

/// A line of the detail is whole words of the longest one, and the lines follow one another.
#[test]
fn no_line_of_the_detail_is_cut_or_wraps() {
    let mut app = finished();
    for option in 0..app.options.len() {
        app.selected = option;
        let whole = detail_lines(&app, 119);
        assert!((4..=6).contains(&whole.len()), "{whole:?}");
        for width in 60..=170 {
            let lines = detail_lines(&app, width);
            assert!(lines.windows(2).all(|pair| pair[0].0 + 1 == pair[1].0), "{width}: {lines:?}");
            for (_, label, line) in &lines {
                let (_, _, longest) = whole.iter().find(|(_, known, _)| known == label).expect("its line");
                let parts = line.split(" · ").flat_map(|part| part.split("  ")).map(str::trim);
                for part in parts.flat_map(|part| part.split(", ")) {
                    let words = |text: &'_ str| {
                        text.split(' ')
                            .map(|word| word.trim_matches([',', ':']).to_owned())
                            .collect::<Vec<_>>()
                    };
                    let mut known = words(longest).into_iter();
                    let is_within = words(part).into_iter().all(|word| known.any(|known| known == word));
                    assert!(is_within, "{width}: '{part}' of '{longest}'");
                }
            }
        }
    }
}

#[test]
fn every_row_has_both_sparklines_from_60_columns() {
    let app = finished();
    for width in 60..=170 {
        let screen = text(&draw(&app, width, 36));
        assert!(!screen.contains("that fail height"), "the heads stand apart, {width}:\n{screen}");
        for delay in &app.case.plan.delays {
            let start: String = delay.name.chars().take(4).collect();
            let is_row = |line: &&str| line.trim_start_matches([' ', '▸']).starts_with(&start);
            let row = screen.lines().skip(5).find(is_row).expect(&start);
            let sparks = row.split(|letter| letter != '✗' && !('▁'..='█').contains(&letter));
            // A gauge has full cells alone.
            let sparks = sparks.filter(|run| run.chars().count() >= 7 && run.chars().any(|bar| bar < '█'));
            assert_eq!(sparks.count(), 2, "{width}:\n{screen}");
            assert_eq!(row.matches('┃').count(), 2, "both limits, {width}:\n{screen}");
        }
        let heads: String = screen.lines().skip(3).take(2).collect();
        assert_eq!(heads.matches("1 in 100").count(), 1, "it is said once, {width}:\n{screen}");
        assert!(heads.contains("• plan") && heads.contains("┃ limit"), "{width}:\n{screen}");
        assert_eq!(
            screen.matches(" above").count(),
            heads.matches(" above").count() + 1,
            "{width}:\n{screen}"
        );
    }
}

/// Every column of tires has its number in the flight, also the last one, whose cell is the last of its view.
#[test]
fn the_flight_numbers_every_column() {
    let mut app = finished();
    (app.screen, app.selected) = (Screen::Flight, 4);
    drop(app.request_flight());
    let flight = recorded(&app, 4);
    study_ends(&mut app, StudyKind::Flight, Ok(flight));
    for width in 60..=170 {
        let screen = text(&draw(&app, width, 24));
        let numbers = screen.lines().nth(5).and_then(|line| line.split('│').next()).expect("a line");
        let numbers: Vec<&str> = numbers.split_whitespace().collect();
        assert_eq!(numbers.join(" "), "1 2 3 4 5 6 7 8 9 10", "{width}:\n{screen}");
    }
}

/// What fires later is dim until its turn, what has just fired stands out; then the map rests as it does without being played, until another
/// order of firing comes into view, or five seconds have passed.
#[test]
fn the_order_of_firing_is_played() {
    let mut app = finished();
    (app.screen, app.selected) = (Screen::Plan, 4);
    assert_eq!(app.case.plan.delays[4].name, "42 ms");
    let at_rest = draw(&app, 120, 36);
    let row = |buffer: &Buffer, number: &str| -> Style {
        let lines = text(buffer);
        let is_row = |line: &str| line.rsplit('│').next().is_some_and(|map| map.starts_with(number));
        let y = lines.lines().position(is_row).expect(&lines);
        let x = (60..120).find(|&x| buffer[(x, y as u16)].symbol() == "●").expect(&lines);
        buffer[(x, y as u16)].style()
    };
    let is_just_fired = |style: Style| style.add_modifier.contains(Modifier::REVERSED);
    let is_dim = |app: &App, style: Style| style.fg == app.theme.muted().fg;
    app.play_firings();
    let first = draw(&app, 120, 36);
    assert!(is_just_fired(row(&first, " 1  0")), "{}", text(&first));
    assert!(is_dim(&app, row(&first, " 2 42")) && is_dim(&app, row(&first, " 3 84")), "{}", text(&first));
    app.firing_play.advance(Duration::from_millis(700));
    let second = draw(&app, 120, 36);
    assert!(is_just_fired(row(&second, " 2 42")) && is_dim(&app, row(&second, " 3 84")), "{}", text(&second));
    assert!(text(&second).contains("0━━━━") && text(&second).contains("────84 ms"), "{}", text(&second));
    app.firing_play.advance(Duration::from_millis(900));
    app.play_firings();
    assert!(app.firing_play.played.is_none() && draw(&app, 120, 36) == at_rest);
    assert!(!app.firing_play.advance(Duration::from_millis(4900)) && app.firing_play.played.is_none());
    assert!(app.firing_play.advance(Duration::from_millis(200)) && draw(&app, 120, 36) == first, "again");
    key(&mut app, KeyCode::Char(' '));
    assert!(app.firing_play.played.is_none() && draw(&app, 120, 36) == at_rest, "told to rest, it does");
    key(&mut app, KeyCode::Char(' '));
    app.selected = 5;
    app.play_firings();
    assert!(app.firing_play.played.is_some(), "another option");
    app.firing_play.advance(Duration::from_secs(2));
    app.screen = Screen::Compare;
    app.play_firings();
    assert!(app.firing_play.played.is_none(), "no map is in sight");
    app.screen = Screen::Plan;
    app.play_firings();
    assert!(app.firing_play.played.is_some(), "it comes into view again");
}

/// How sure the shots make of the risk grows with them, and the last one is marked while more come; then each of them in turn.
#[test]
fn accuracy_shows_how_its_shots_came() {
    let mut app = finished();
    (app.screen, app.selected) = (Screen::Accuracy, 4);
    let after = |app: &mut App, count: usize, more: bool| {
        let sampled = samples(&app.case, count, false);
        let judged = Judgement {
            sampled: Evidence::Known(sampled),
            ..Judgement::of_planned_alone(checked(Verdict::Pass))
        };
        app.options[4] = done(judged, more);
        text(&draw(app, 120, 36))
    };
    let (few, more, all) =
        (after(&mut app, 100, true), after(&mut app, 300, true), after(&mut app, 500, false));
    assert!(few.contains("◆ last") && more.contains("◆ last") && !all.contains("◆ last"), "{all}");
    let (mut app, mut before) = (app, all.clone());
    for number in [2, 3, 500, 1] {
        let turns = (number + 500 - app.shot_in_review(4).expect("a shot").0) % 500;
        assert!(app.reviews() && app.advance_review(Duration::from_millis(400) * turns as u32));
        let screen = text(&draw(&app, 120, 36));
        assert!(screen.contains(&format!("height ◆ {number} of 500 ")) && screen != before, "{screen}");
        before = screen;
    }
    app.player.rests = true;
    assert!(!app.reviews() && text(&draw(&app, 120, 36)) == before, "it rests where it is");
    for (screen, count) in [(&few, "100"), (&more, "300"), (&all, "500")] {
        let marked = if count == "500" { "1" } else { "last" };
        assert!(screen.contains(&format!("height ◆ {marked} of {count} ")), "{screen}");
        let axis = screen.lines().find(|line| line.ends_with(" 500 shots")).expect(screen);
        assert_eq!(axis.contains(&format!("─{count}─")), count != "500", "numbers that touch:\n{screen}");
        // As long as the risk may lie above the accepted one, its band covers the line; what surely lies below leaves it.
        let accepted = screen.lines().find_map(|line| line.split_once("  1% ")).expect(screen).1;
        let covered = accepted.matches(|sign| ('▁'..='█').contains(&sign)).count();
        let expected = count.parse::<usize>().expect("a count") * accepted.chars().count() / 500;
        match count {
            "500" => assert!(covered > 20 && accepted.ends_with('┄'), "{screen}"),
            _ => assert!(covered.abs_diff(expected) <= 1, "{covered}, {expected}:\n{screen}"),
        }
    }
}

/// What the pass of 42 ms stands on: three assumptions that are told, and one that is farther.
fn three_nearest() -> Assumptions {
    let nearest = |assumed, stated, passes_until: f64| Assumption {
        assumed,
        stated,
        passes_until: Some(passes_until),
        fails_from: Some(1.25 * passes_until),
        ratio: Some(passes_until / stated),
        is_complete: true,
    };
    let all = vec![
        nearest(Assumed::Spread(Spread::LaunchBetweenShots), 3.0, 6.0),
        nearest(Assumed::Spread(Spread::TiltCommon), 1.0, 2.6),
        nearest(Assumed::Range(Ranged::AxialStiffness, Side::High), 10.0, 25.0),
        nearest(Assumed::Spread(Spread::TireMass), 5.0, 20.0),
    ];
    Assumptions { option: 4, samples: 200, accepted: 2, planned: Verdict::Pass, failing: 0, all }
}

/// What nobody tried has no bar, as if it held; and once the plan has lost the option, nothing is drawn of it.
#[test]
fn no_bar_is_drawn_of_what_was_not_tried_or_of_a_plan_before() {
    let mut app = finished();
    app.screen = Screen::Studies;
    app.selected = 6;
    let mut found = Assumptions { option: 6, ..three_nearest() };
    let open = Assumption { fails_from: None, ratio: None, is_complete: false, ..found.all[3] };
    found.all[3] = open;
    study_ends(&mut app, StudyKind::Assumptions, Ok(Found::Assumptions(Box::new(Computed::complete(found)))));
    app.studies.select(StudyKind::Assumptions);
    let screen = text(&draw(&app, 170, 45));
    let row = screen.lines().find(|line| line.contains("tire masses") && line.contains("not tried further"));
    assert!(row.is_some_and(|row| !row.contains('▶') && !row.contains('━')), "{screen}");
    assert!(screen.contains("long period: the pass ends at so many times"), "{screen}");
    let removed = remove_delay(&app.case.source.text, 6).expect("an option less");
    let source = PlanSource { text: removed, ..app.case.source.clone() };
    let _ = app.reload(Ok(Case::parse(source).expect("a plan")));
    for (width, height) in [(80, 24), (170, 45)] {
        let screen = text(&draw(&app, width, height));
        assert!(screen.contains("OF THE PLAN BEFORE") && !screen.contains("the pass ends at"), "{screen}");
    }
}

/// A name loses its end where its beginning tells it apart; never a digit of a number, and not where another begins so.
#[test]
fn a_name_that_is_cut_keeps_its_numbers_and_is_no_other() {
    let mut app = finished();
    let mut named = |names: [&str; 2]| {
        let case = Arc::make_mut(&mut app.case);
        for (delay, name) in case.plan.delays.iter_mut().zip(names) {
            name.clone_into(&mut delay.name);
        }
        let screen = text(&draw(&app, 80, 24));
        let rows = screen.lines().skip_while(|line| !line.contains("option  ")).skip(1).take(2);
        rows.map(|row| row.chars().skip(1).take(14).collect::<String>()).collect::<Vec<_>>()
    };
    assert_eq!(named(["26 ms, middle first", "all"]), ["26 ms, middle…", "all           "]);
    let [one, other] = ["26 ms, middle first", "26 ms, middle last"];
    assert_eq!(named([one, other]), ["26 ms, mi…irst", "26 ms, mi…last"]);
    for name in ["both rows at 109 ms", "rows apart 109 first"] {
        let cut = named([name, "all"]).swap_remove(0);
        assert!(cut.contains("109") || !cut.contains("10"), "{cut}");
    }
}

/// What a pass stands on is told in full, where a wide screen has rows for it.
#[test]
fn a_pass_tells_the_nearest_assumptions_it_stands_on() {
    let mut app = finished();
    app.selected = 4;
    app.assumptions[4] = Some(Box::new(three_nearest()));
    for width in 120..=200 {
        let screen = text(&draw(&app, width, 36));
        for told in [
            "launches of shots differ by 6 %",
            "(assumed 3 %)",
            "tilt by 2.6° (assumed 1°)",
            "the rope is 25 % stiffer",
        ] {
            assert!(screen.contains(told), "{width} {told}:\n{screen}");
        }
        // Nobody filmed a launch of this plan.
        let next = "film (4 Fit) ☐ 12 more assumed";
        assert!(screen.contains(next), "{width}:\n{screen}");
        assert!(text(&draw(&app, 60, 24)).contains("☐ film (4 Fit) ☐ 12 more assumed"));
        assert!(text(&draw(&app, 80, 24)).contains(" not yet  ☐ "), "who reads on does not fire");
        let mut filmed = app.clone();
        study_ends(&mut filmed, StudyKind::Fit, Ok(Found::Fit(Box::new(Computed::complete(fitted())))));
        let screen = text(&draw(&filmed, width, 36));
        let next = ["☐ film (4 Fit, E) ☐ ", "☐ put the film into the plan (4 Fit, E) ☐ "];
        assert!(next.iter().any(|next| screen.contains(next)), "{width}");
        assert!(screen.contains(" to tick"), "the page is not out of reach, {width}:\n{screen}");
        let case = Arc::make_mut(&mut app.case);
        case.plan.ground.friction = 0.51;
        let stated = std::mem::replace(&mut case.plan.uncertainty.launch_common_percent, 10.0);
        assert!(!text(&draw(&app, width, 36)).contains("film ("), "{width}");
        assert!(text(&draw(&app, 80, 24)).contains("☐ 13 assumed values (1 Plan) · P: page with 13 to tick"));
        Arc::make_mut(&mut app.case).plan.uncertainty.launch_common_percent = stated;
        assert!(!screen.contains("tire masses differ"), "{width}:\n{screen}");
    }
    // All of it at 80 columns, too, where a row more is there.
    let least = text(&draw(&app, 80, 24));
    assert!(least.contains("differ by 6 % (assumed 3 %)") && least.contains(", and more: "), "{least}");
    let screen = text(&draw(&app, 80, 28));
    for told in ["differ by 6 % (assumed 3 %)", "tilt by 2.6° (assumed 1°)", "rope is 25 % stiffer"] {
        assert!(screen.contains(told), "{told}:\n{screen}");
    }
    // Where rows lack, the line says that there is more.
    for height in 20..24 {
        let screen = text(&draw(&app, 60, height));
        let has_all = screen.contains("assumed 10 %") && screen.contains("to tick");
        assert_ne!(has_all, screen.contains(", and more") || screen.contains(" …\n"), "{height}:\n{screen}");
    }
    Arc::make_mut(&mut app.case).plan.title = Some("EXAMPLE".to_owned());
    for width in [60, 80, 120] {
        let screen = text(&draw(&app, width, 36));
        assert!(!screen.contains("to sign"), "{width}:\n{screen}");
        assert!(width == 60 || screen.contains("P: page, not to be fired"), "{width}:\n{screen}");
    }
}

/// What is safest for the shelter may be worst for the ground: how much fires together is seen where it is recommended.
#[test]
fn a_recommended_option_that_fires_more_together_than_others_says_so() {
    let mut app = finished();
    let together = "all at once: 30 holes within 8 ms, of others 10";
    for (best, is_told) in [(0, true), (4, false)] {
        recommend(&mut app, best);
        let screen = text(&draw(&app, 170, 45));
        assert_eq!(screen.contains(together), is_told, "{screen}");
    }
}

/// The planned shot of this option uses more of a limit than the one that decides: no screen shows the smaller share.
#[test]
fn the_plan_shows_no_smaller_share_of_a_limit_than_the_table() {
    let mut app = finished();
    app.selected = 4;
    let compared = text(&draw(&app, 120, 36));
    assert!(compared.contains("by force, 73 %: 61.2 of 84.0 kN"), "{compared}");
    app.screen = Screen::Plan;
    let plan = text(&draw(&app, 170, 45));
    assert!(plan.contains("force: 73 % of its limit"), "{plan}");
}

/// What is assumed belongs to what it holds until, in the least rows, too.
#[test]
fn a_pass_says_what_is_assumed_on_the_smallest_screens() {
    let mut app = finished();
    app.selected = 4;
    let mut found = three_nearest();
    found.all[0].assumed = Assumed::LaunchVelocity;
    (found.all[0].stated, found.all[0].passes_until) = (1.0, Some(1.13));
    found.all[1].assumed = Assumed::PushDepth;
    (found.all[1].stated, found.all[1].passes_until) = (0.8, Some(0.25));
    found.all.truncate(2);
    app.assumptions[4] = Some(Box::new(found));
    let screen = text(&draw(&app, 60, 20));
    assert!(screen.contains("until holes push from 25 cm deep (assumed 80 cm)"), "{screen}");
}

/// Whatever becomes known of an option, its charts stay where they are, and no row above them is empty.
#[test]
fn charts_stay_where_they_are_from_the_first_frame_on() {
    for (width, height) in [(60, 24), (80, 24), (100, 30), (120, 36), (170, 45)] {
        let mut app = app();
        let verdict = |option| if option == 4 { Verdict::Pass } else { Verdict::Fail };
        (0..7).for_each(|option| {
            app.take_news(News::Checked { option, result: begun(&app.case, verdict(option)) });
        });
        app.selected = 4;
        let place = |app: &App| {
            let screen = text(&draw(app, width, height));
            let lines: Vec<&str> = screen.lines().collect();
            let chart = lines.iter().position(|line| line.starts_with(" 2.35 m")).expect(&screen);
            let rule = lines.iter().position(|line| line.starts_with(" 42 ms ")).expect("the rule");
            (chart, lines[rule + 1..chart].iter().any(|line| line.is_empty()), screen.clone())
        };
        let (first, _, _) = place(&app);
        let stays = |app: &App, what: &str| {
            let (at, has_empty, screen) = place(app);
            // One cable alone is pulled in the samples of this test.
            let is_filled = width > 80 || what == "samples" || !has_empty;
            assert!(at == first && is_filled, "{width}x{height} {what}:\n{screen}");
        };
        for more in [true, false] {
            let sampled = Box::new(samples(&app.case, 500, false));
            app.take_news(News::Found { option: 4, part: Part::Samples { sampled, more } });
            stays(&app, "samples");
        }
        let drawn = RiskSummary::of(&samples(&app.case, 600, false));
        app.take_news(News::Found { option: 4, part: Part::Confirmation(Box::new(drawn)) });
        app.take_news(News::Found { option: 4, part: withstood_dud() });
        stays(&app, "a pass");
        app.take_news(News::Assumptions { option: 4, found: Box::new(three_nearest()) });
        stays(&app, "what it holds until");
        assert!(place(&app).2.contains("holds    until"), "{width}x{height}");
    }
}

/// What is filled is the shot that decides, at every size: of the planned shot alone nothing is.
#[test]
fn nothing_is_filled_but_the_shot_that_decides() {
    let mut app = finished();
    app.selected = 4;
    // Bars of limits are of one sign, whatever is drawn over time.
    let is_filled = |sign: &char| ('▁'..='█').contains(sign) && *sign != '▆';
    for (width, height) in [(60, 20), (80, 24), (100, 30), (120, 36), (170, 45)] {
        app.shown_shot = ShownShot::Deciding;
        let deciding = text(&draw(&app, width, height));
        assert!(deciding.chars().filter(is_filled).count() > 4 * 14, "{width}x{height}:\n{deciding}");
        app.shown_shot = ShownShot::AsPlanned;
        let planned = text(&draw(&app, width, height));
        assert_eq!(planned.chars().filter(is_filled).count(), 0, "{width}x{height}:\n{planned}");
        // A narrow gauge has digits.
        let has_gauge = |line: &&str| line.contains('•') || line.contains("%┃");
        let rows = planned.lines().filter(|line| has_gauge(line) && line.contains(['⣀', '⠤', '⠒', '⠉']));
        assert!(rows.count() >= 6, "a line, and where it ends of its limit, {width}x{height}:\n{planned}");
    }
}

/// Which cables to strengthen is an answer: those past the limit, and what then decides; none where none is near it; no single one where
/// many are past it.
#[test]
fn cables_are_an_answer() {
    let mut app = finished();
    app.selected = 1;
    let limit = app.case.limits.force;
    for (shares, told) in [
        (vec![0.79, 0.7], "cables   none above 80 % of the limit: none to strengthen"),
        (vec![0.95, 0.9, 0.7], "cables   2 above 80 % of the limit, none past it"),
        (vec![1.2, 1.1, 0.96], "cables   strengthen 1:1-1:2, 1:2-1:3: still 96 % in 1:3-1:4"),
        (vec![1.4, 1.3, 1.2, 1.1, 1.05], "cables   5 past the limit, worst "),
    ] {
        let mut sampled = samples(&app.case, 200, false);
        for (n, sample) in sampled.samples.iter_mut().enumerate() {
            (sample.run.cable, sample.run.force) = match shares.get(n / 10) {
                // 1 % of the hardest are left out.
                Some(share) => (n / 10, share * limit),
                None => (shares.len() - 1, 0.5 * limit),
            };
        }
        let OptionState::Judged { judgement, .. } = &mut app.options[1] else { panic!("judged") };
        judgement.sampled = Evidence::Known(sampled);
        let screen = text(&draw(&app, 120, 36));
        assert!(screen.contains(told), "{told}:\n{screen}");
        // A shot that is still tried may pull harder: only what is past its limit already is told.
        let mut app = app.clone();
        let OptionState::Judged { more_samples, .. } = &mut app.options[1] else { panic!("judged") };
        *more_samples = true;
        let screen = text(&draw(&app, 120, 36));
        assert_eq!(screen.contains("cables   "), shares[0] > 1.0, "{screen}");
    }
}

/// A thin pass counts apart, and as long as it is not known how thin a pass is, the count is one so far.
#[test]
fn thin_passes_are_counted_apart() {
    let mut app = finished();
    let counts = |app: &App, words: &str| text(&draw(app, 120, 36)).contains(words);
    assert!(
        counts(&app, "2 OPEN · 4 FAIL so far")
            && !counts(&app, "1 PASS")
            && counts(&app, "… wait")
            && !counts(&app, "✓ PASS")
    );
    app.assumptions[4] = Some(Box::new(three_nearest()));
    assert!(counts(&app, "1 PASS · 2 OPEN · 4 FAIL") && !counts(&app, "so far"));
    let OptionState::Judged { judgement, .. } = &mut app.options[4] else { panic!("judged") };
    judgement.launch_margin = Some(LaunchMargin::UpTo { rise: 0.01, above: Verdict::Fail });
    assert!(counts(&app, "1 THIN · 2 OPEN · 4 FAIL"), "{}", text(&draw(&app, 120, 36)));
    app.options[1] = app.options[4].clone();
    let OptionState::Judged { judgement, .. } = &mut app.options[1] else { panic!("judged") };
    judgement.launch_margin = None;
    app.assumptions[1] = Some(Box::new(Assumptions { all: Vec::new(), ..three_nearest() }));
    assert!(counts(&app, "1 PASS · 1 THIN · 1 OPEN · 4 FAIL"), "{}", text(&draw(&app, 120, 36)));
}

/// The limit that the worst shot comes nearest stands first, with the cable that is to be strengthened; so does the list of cables.
#[test]
fn the_nearest_limit_stands_first_and_names_one_cable() {
    let mut app = finished();
    app.selected = 4;
    for (height, first) in [(2.35, "limited  by force"), (1.3, "limited  by height")] {
        Arc::make_mut(&mut app.case).limits.height = height;
        for (width, rows) in [(60, 20), (80, 24), (120, 36)] {
            let screen = text(&draw(&app, width, rows));
            assert!(screen.contains(first), "{width}:\n{screen}");
            // Harder as planned: that is the cable that has a name.
            let force = screen.lines().find(|line| line.contains("by force, ")).expect(&screen);
            let force = force.split_whitespace().join(" ");
            assert!(force.contains("61.2 of 84.0 kN in 1:4-1:5"), "{width}:\n{screen}");
            assert_eq!(force.matches(" in ").count(), 1, "{width}:\n{screen}");
        }
    }
    for (width, rows, zoom) in [(120, 36, false), (80, 24, true)] {
        app.zoom = zoom;
        let screen = text(&draw(&app, width, rows));
        assert!(screen.contains("cables   none above 80 % of the limit"), "{width}:\n{screen}");
        assert!(screen.contains("         1:1-1:2  59.8 kN   72 %"), "{width}:\n{screen}");
    }
    // The planned force is that of another cable, which has its name, too.
    app.zoom = false;
    let OptionState::Judged { judgement, .. } = &mut app.options[4] else { panic!("judged") };
    judgement.checked.estimates.force.value = 50e3;
    let screen = text(&draw(&app, 170, 45));
    let force =
        screen.lines().find(|line| line.contains("by force, ")).expect(&screen).split_whitespace().join(" ");
    assert!(force.contains("59.8 of 84.0 kN in 1:1-1:2 planned 50.0 in 1:4-1:5"), "{screen}");
}

/// How much faster the tires may leave as planned is no promise of how far a pass holds, and flatters what does not pass.
#[test]
fn the_margin_of_the_planned_shot_alone_is_on_no_screen_of_an_option() {
    let mut app = finished();
    for (option, holds) in [(4, true), (1, false), (0, false)] {
        app.selected = option;
        for margin in
            [LaunchMargin::UpTo { rise: 0.37, above: Verdict::Undecided }, LaunchMargin::BeyondTried]
        {
            app.take_news(News::Found { option, part: Part::Margin(margin) });
            for width in [60, 80, 120, 170] {
                let screen = text(&draw(&app, width, 36));
                assert!(
                    !screen.contains("planned alone") && !screen.contains("margin"),
                    "{width}:\n{screen}"
                );
                assert_eq!(screen.contains("holds    still being found"), holds, "{width}:\n{screen}");
            }
        }
    }
}

/// In a row of which shots are tried one cell moves, and nothing moves elsewhere, nor once all is judged.
#[test]
fn one_cell_moves_in_the_rows_that_are_tried() {
    let mut app = finished();
    let still = draw(&app, 80, 24);
    assert!(!app.count_on());
    assert_eq!(draw(&app, 80, 24), still, "all is judged");
    for option in [1, 5] {
        let sampled = Box::new(samples(&app.case, 100, false));
        app.take_news(News::Found { option, part: Part::Samples { sampled, more: true } });
    }
    for width in [60, 80, 120] {
        let before = draw(&app, width, 24);
        assert!(app.count_on());
        let after = draw(&app, width, 24);
        let moved = before.content.iter().zip(&after.content).filter(|(before, after)| before != after);
        let is_mark = |letter: &str| letter.chars().all(|c| ('\u{2800}'..='\u{28ff}').contains(&c));
        let moved: Vec<_> = moved.collect();
        assert_eq!(moved.len(), 2, "{width}: the mark that turns of each");
        assert!(moved.iter().all(|(before, after)| is_mark(before.symbol()) && is_mark(after.symbol())));
    }
}

/// What is still tried is called so wherever its verdict will stand, and is not open: that is a verdict.
#[test]
fn one_word_says_that_an_option_is_still_tried() {
    let mut app = app();
    app.take_news(News::Checked { option: 0, result: begun(&app.case, Verdict::Pass) });
    let sampled = Box::new(samples(&app.case, 100, false));
    app.take_news(News::Found { option: 0, part: Part::Samples { sampled, more: true } });
    for screen in [Screen::Compare, Screen::Plan, Screen::Flight] {
        app.screen = screen;
        let drawn = text(&draw(&app, 120, 36));
        assert!(!drawn.contains("OPEN"), "{drawn}");
        assert!(screen == Screen::Flight || drawn.contains("trying"), "{drawn}");
    }
}

/// Between the last sample and what still decides of a pass, nobody reads that no option passes.
#[test]
fn no_answer_stands_before_all_verdicts_are_known() {
    let mut app = app();
    Arc::make_mut(&mut app.case).plan.limits.withstands_one_dud = true;
    let head = |app: &App, width| text(&draw(app, width, 24)).lines().nth(1).expect("a line").to_owned();
    let is_so_far = |app: &App, judged: usize, ahead: &str| {
        for width in [60, 80, 120] {
            let head = head(app, width);
            assert!(head.starts_with(&format!(" … {judged} of 7 judged")), "{width}: {head}");
            assert!(!head.contains("pass") && head.contains(ahead), "{width}: {head}");
        }
    };
    for option in 0..7 {
        let verdict = if option == 4 { Verdict::Pass } else { Verdict::Fail };
        app.take_news(News::Checked { option, result: begun(&app.case, verdict) });
    }
    is_so_far(&app, 6, "");
    for option in 0..7 {
        let count = if option == 4 { 500 } else { 200 };
        let sampled = Box::new(samples(&app.case, count, option != 4));
        app.take_news(News::Found { option, part: Part::Samples { sampled, more: false } });
    }
    is_so_far(&app, 6, "42 ms");
    assert_eq!(app.selected, 4, "cursor and charts show whom the headline names");
    app.take_news(News::Found { option: 4, part: withstood_dud() });
    is_so_far(&app, 6, "42 ms");
    let drawn = RiskSummary::of(&samples(&app.case, 600, false));
    app.take_news(News::Found { option: 4, part: Part::Confirmation(Box::new(drawn)) });
    // Nor is it final before it is known what the pass stands on.
    for width in [60, 80, 120] {
        let head = head(&app, width);
        assert!(
            head.starts_with(" … 42 ms leads") && head.contains("tried") && !head.contains('✓'),
            "{head}"
        );
    }
    app.assumptions[4] = Some(Box::new(three_nearest()));
    assert!(head(&app, 120).contains("NOT YET  42 ms passes"), "{}", head(&app, 120));
    // A finer computation takes the answer back.
    key(&mut app, KeyCode::Char('+'));
    assert!(!head(&app, 120).contains("passes"), "{}", head(&app, 120));
}

/// Without it a file in a deep directory would show the directory and not its name.
#[test]
fn a_path_without_room_keeps_its_file_name() {
    let mut app = finished();
    app.screen = Screen::Plan;
    app.assumptions[4] = Some(Box::new(three_nearest()));
    let path = "/home/blaster/sites/amur/spring/three-rows-west.toml";
    Arc::make_mut(&mut app.case).source.path = path.into();
    for (width, shown) in [(120, path), (80, "…/spring/three-rows-west.toml"), (60, "three-rows-west")] {
        let head = text(&draw(&app, width, 24)).lines().nth(1).expect("a line").to_owned();
        assert!(head.contains(shown), "{width}: {head}");
    }
}

/// A bar says how much of its limit it uses, behind the limit, or in its place where it would be short, unless a column of digits does.
#[test]
fn a_bar_past_its_limit_has_its_share_at_every_width() {
    let mut app = finished();
    let limits = &mut Arc::make_mut(&mut app.case).limits;
    (limits.height, limits.force) = (0.3 * limits.height, 10.0 * limits.force);
    for width in [60, 80, 120] {
        let screen = text(&draw(&app, width, 24));
        let row = screen.lines().find(|line| line.contains("42 ms")).expect("the row").to_owned();
        let told = match width {
            60 => ["185%┃", " 8%┃"],
            80 => ["▆▆▶185%", "┃8%"],
            _ => ["┃▆▶", "185 %"],
        };
        assert!(told.iter().all(|told| row.contains(told)), "{width}: {row}");
    }
}

/// A row whose sign the middle of the axis covers would seem not to fire.
#[test]
fn each_row_that_fires_has_its_sign_below_the_charts() {
    let mut app = finished();
    app.selected = 6;
    for width in 60..=170 {
        let screen = text(&draw(&app, width, 30));
        let axes: Vec<&str> = screen.lines().filter(|line| line.contains(" 0 ▲")).collect();
        let signs = axes.iter().map(|line| line.matches('▲').count()).sum::<usize>();
        assert_eq!(signs, 6, "three rows below two charts, {width}:\n{screen}");
    }
}

/// Cables that no shot pulled hardest are drawn, too: also the diagonal ones.
#[test]
fn the_map_has_the_whole_mesh() {
    let mut app = finished();
    app.selected = 4;
    let screen = text(&draw(&app, 120, 36));
    let diagonals = screen.matches('╳').count();
    // Four rows of nine meshes, as far as they are drawn with room.
    assert_eq!(diagonals, 36, "{screen}");
    app.theme = Theme::Light;
    assert_eq!(text(&draw(&app, 120, 36)), screen);
}

/// A key that ends what computes is offered where something computes.
#[test]
fn cancelling_is_offered_only_where_something_computes() {
    let mut app = finished();
    for (screen, kind) in [(Screen::Studies, StudyKind::Sweep), (Screen::Accuracy, StudyKind::Accuracy)] {
        app.screen = screen;
        app.studies.select(kind);
        let offers = |app: &App| {
            text(&draw(app, 170, 30)).lines().last().is_some_and(|footer| footer.contains(" x cancel "))
        };
        app.studies.set(kind, StudyState::Idle);
        assert!(!offers(&app), "{screen:?}");
        app.studies.set(kind, StudyState::Running(StudyAt::default()));
        assert!(offers(&app), "{screen:?}: {}", text(&draw(&app, 170, 30)));
    }
}

/// On the plan, too: below the values where there is no room beside them.
#[test]
fn the_plan_has_both_sparklines_of_an_option_and_its_firing_times_whole() {
    let mut app = finished();
    (app.screen, app.selected) = (Screen::Plan, 4);
    for width in 60..=170 {
        let screen = text(&draw(&app, width, 20));
        let sparks = screen.lines().filter_map(|line| {
            let runs = line.split(|letter| letter != '✗' && !('▁'..='█').contains(&letter));
            let count = runs.filter(|run| run.chars().count() >= 7).count();
            (count > 0).then_some(count)
        });
        assert!(sparks.sum::<usize>() >= 2, "{width}:\n{screen}");
        assert!(
            screen.contains("0/42/84 ms") || screen.contains("1: 0 ms, 2: 42 ms, 3: 84 ms"),
            "{width}:\n{screen}"
        );
    }
}

/// How much of each limit the moment uses is the question of the flight: no width cuts it. The cursor on a chart is no bar.
#[test]
fn the_flight_tells_both_shares_of_the_limits_at_every_width() {
    let mut app = finished();
    app.selected = 4;
    app.screen = Screen::Flight;
    drop(app.request_flight());
    let flight = recorded(&app, 4);
    study_ends(&mut app, StudyKind::Flight, Ok(flight));
    for width in 60..=170 {
        let screen = text(&draw(&app, width, 24));
        let now =
            screen.lines().skip(3).find(|line| line.contains(" kN") && line.contains('%')).expect("a line");
        assert_eq!(now.split(" %").count(), 3, "{width}: {now}");
        assert!(!now.trim_end().ends_with('1'), "{width}: {now}");
    }
    let buffer = draw(&app, 80, 24);
    let cursors = buffer
        .content()
        .iter()
        .filter(|cell| cell.symbol() == "┆" && cell.fg == app.theme.title().fg.unwrap_or(cell.fg));
    assert!(cursors.count() >= 2, "a thin line on both charts");
}

/// How many cables pull is said in whole words; the mark of the time covers no digit of the axis.
#[test]
fn the_flight_says_how_many_cables_pull_and_keeps_its_digits() {
    let mut app = finished();
    app.selected = 4;
    app.screen = Screen::Flight;
    drop(app.request_flight());
    let flight = recorded(&app, 4);
    study_ends(&mut app, StudyKind::Flight, Ok(flight));
    let end = app.flight().expect("a flight").end();
    let digits = |app: &App| {
        let screen = text(&draw(app, 80, 24));
        let axis = screen.lines().rev().nth(1).expect("the axis").to_owned();
        axis.chars().filter(char::is_ascii_digit).collect::<String>()
    };
    let mut told = 0;
    app.player.time = 0.0;
    let at_rest = digits(&app);
    for n in 0..=100 {
        app.player.time = end * f64::from(n) / 100.0;
        assert_eq!(digits(&app), at_rest, "{n}");
        for (width, height) in [(60, 20), (80, 24)] {
            let screen = text(&draw(&app, width, height));
            let title = screen.lines().nth(4).expect("the title").trim_end_matches(['─', ' ']).to_owned();
            told += usize::from(title.ends_with(" cables taut"));
            let is_whole = [" taut", "no cable pulls", " times"].iter().any(|end| title.ends_with(end));
            assert!(is_whole, "{screen}");
        }
    }
    assert!(told > 10, "a test that can fail");
}

/// The count of shots says what became of them, and what follows.
#[test]
fn the_count_of_shots_says_that_they_failed_and_what_is_sure_of_it() {
    let mut app = finished();
    for (samples_of, words) in [
        (samples(&app.case, 500, false), "fail: under 1 in 100 if "),
        (samples(&app.case, 200, true), "20 of 200 computed shots fail: over 1 in 100"),
        (samples(&app.case, 100, false), "0 of 100 computed shots fail: may be over 1 in 100"),
    ] {
        let judged = Judgement {
            sampled: Evidence::Known(samples_of),
            ..Judgement::of_planned_alone(checked(Verdict::Pass))
        };
        app.options[4] = done(judged, false);
        app.selected = 4;
        for width in [60, 80, 120] {
            let screen = text(&draw(&app, width, 24));
            assert!(screen.contains(words), "{width}:\n{screen}");
        }
    }
}

/// A narrow screen has no room for every study above the one that fills it: the one shown is always named.
#[test]
fn the_study_shown_has_its_tab_at_every_width() {
    let mut app = finished();
    let found = swept(&app.case);
    study_ends(&mut app, StudyKind::Sweep, Ok(found));
    spreads(&app).into_iter().for_each(|(kind, found)| study_ends(&mut app, kind, Ok(found)));
    key(&mut app, KeyCode::Char('4'));
    let names = ["Sweep", "Orders", "Risk", "Search", "Size", "Effects", "Fit", "Holds"];
    for (kind, name) in StudyKind::tabs().into_iter().zip(names) {
        app.studies.show(kind);
        for width in 60..=120 {
            let screen = text(&draw(&app, width, 24));
            let tabs = screen.lines().nth(3).expect("tabs");
            assert!(tabs.split_whitespace().any(|tab| tab == name), "{width}, {name}: {tabs}");
        }
    }
}

/// On a launch that nobody observed no change of the plan makes an option pass: a film does.
#[test]
fn a_guessed_launch_is_said_to_be_filmed_first() {
    let mut app = finished();
    let PlanSource { path, text: plan } = app.case.source.clone();
    let plan = plan.edited("launch_common_percent = 3", "launch_common_percent = 50");
    app.case = Arc::new(Case::parse(PlanSource { path, text: plan }).expect("a plan"));
    for state in &mut app.options {
        let OptionState::Judged { judgement, .. } = state else { panic!("judged") };
        judgement.checked.launch_is_estimated = true;
    }
    app.screen = Screen::Compare;
    let sampled = Box::new(samples(&app.case, 200, true));
    app.take_news(News::Found { option: 4, part: Part::Samples { sampled, more: false } });
    for width in [60, 80, 120] {
        let screen = text(&draw(&app, width, 24));
        assert!(screen.contains("film a test tire: no guess passes (shelter launch)"), "{width}:\n{screen}");
        assert!(!screen.contains("what would make"), "{width}:\n{screen}");
    }
    let screen = text(&draw(&app, 120, 24));
    assert!(screen.contains("the launch is a guess, film one"), "{screen}");
}

#[test]
fn the_headline_names_the_recommended_option_and_what_a_pass_leaves_open() {
    let mut app = finished();
    Arc::make_mut(&mut app.case).plan.uncertainty.assumed = true;
    // Nothing is recommended before duds are judged and fresh draws confirm it.
    let OptionState::Judged { judgement, .. } = &mut app.options[4] else { panic!("a judgement") };
    (judgement.withstands_dud, judgement.confirmation) = (Evidence::Awaited, Evidence::Awaited);
    let sampled = samples(&app.case, 500, false);
    let drawn = RiskSummary::of(&sampled);
    app.take_news(News::Found { option: 4, part: Part::Samples { sampled: Box::new(sampled), more: false } });
    assert!(app.answer.is_none());
    app.take_news(News::Found { option: 4, part: withstood_dud() });
    app.take_news(News::Found { option: 4, part: Part::Confirmation(Box::new(drawn)) });
    assert_eq!(app.selected, 4, "the best option is selected");
    let is_filled = |app: &App| draw(app, 120, 36)[(119, 1)].modifier.contains(Modifier::REVERSED);
    assert!(!is_filled(&app), "what is not final looks so");
    app.assumptions[4] = Some(Box::new(three_nearest()));
    assert!(!is_filled(&app), "nothing may be fired by it");
    // Only the colour of a pass goes: what holds the answer keeps its own.
    let colour = |app: &App| {
        let drawn = draw(app, 120, 36);
        let tag = "  DO NOT FIRE  ".len() as u16;
        let at = (0..120).find(|&x| drawn[(x, 1)].symbol() == "!").unwrap_or(tag);
        drawn[(at, 1)].fg
    };
    assert_ne!(Some(colour(&app)), app.theme.verdict(Verdict::Pass).fg);
    let mut held = app.clone();
    held.assumptions[4] = Some(Box::new(Assumptions { failing: 100, ..three_nearest() }));
    assert_eq!(Some(colour(&held)), app.theme.limit().fg, "{}", text(&draw(&held, 120, 36)));
    let mut stated = finished();
    (stated.answer, stated.assumptions[4]) = (app.answer.clone(), app.assumptions[4].clone());
    assert!(!is_filled(&stated), "assumed values are to be confirmed first");
    let case = Arc::make_mut(&mut stated.case);
    // Nor is it an example with another rope.
    case.plan.ground.friction = 0.51;
    case.source.text = case.source.text.replace("assumed", "measured").replace("estimate", "film");
    let unknown = &mut case.plan.uncertainty;
    // Nothing is taken as exact, or as surer than a film.
    (unknown.launch_row_cv_percent, unknown.launch_common_percent) = (1.0, 10.0);
    (unknown.launch_between_shots_percent, unknown.launch_tilt_common_deg) = (2.0, 0.5);
    (unknown.hole_position_m, unknown.pattern_offset_m, unknown.cable_length_m) = (0.05, 0.05, 0.01);
    unknown.hole_fails_percent = 0.01;
    assert!(is_filled(&stated), "{}", text(&draw(&stated, 120, 36)));
    assert!(text(&draw(&stated, 120, 36)).contains(" ✓ 42 ms passes"));
    // As on the page: films that nobody gave are a condition, too.
    let mut elsewhere = stated.clone();
    Arc::make_mut(&mut elsewhere.case).plan.fitted_from = vec!["ab12".to_owned()];
    assert!(text(&draw(&elsewhere, 120, 36)).contains("NOT YET  42 ms passes"));
    // What is not final is no line to fire by.
    let mut sought = stated.clone();
    let partly = Assumption {
        assumed: Assumed::LaunchVelocity,
        stated: 1.0,
        passes_until: Some(1.05),
        fails_from: None,
        ratio: None,
        is_complete: false,
    };
    sought.assumptions[4] = Some(Box::new(Assumptions { all: vec![partly], ..three_nearest() }));
    assert!(!is_filled(&sought), "{}", text(&draw(&sought, 120, 36)));
    for width in 60..=170 {
        let screen = text(&draw(&app, width, 36));
        let header: Vec<&str> = screen.lines().skip(1).take(2).collect();
        // What the answer stands on is part of it at every width; what ranks it gives way first.
        assert!(header[0].starts_with("  DO NOT FIRE  42 ms would pass, "), "{width}:\n{screen}");
        assert!(header[0].contains("if your inputs hold"), "{width}:\n{screen}");
        assert!(width < 113 || header[0].contains("the only one of 7"), "{width}:\n{screen}");
        assert!(header[1].contains("inputs assumed"), "{width}:\n{screen}");
        assert!(header.join("").contains("slide NOT checked"), "{width}:\n{screen}");
        assert!(width < 120 || header[1].contains("13 values"), "{width}:\n{screen}");
    }
    // The name of an option stays what it is, and the words behind it are whole.
    let name = "42 ms passes by";
    Arc::make_mut(&mut app.case).plan.delays[4].name = name.to_owned();
    recommend(&mut app, 4);
    let head = |app: &App, width| text(&draw(app, width, 36)).lines().nth(1).expect("a line").to_owned();
    for width in 60..=170 {
        let told = head(&app, width);
        assert!(told.contains(" would pass, ") && told.contains("if your inputs hold"), "{width}: {told}");
        assert!(width < 75 || told.contains("42 ms passes by would pass"), "{width}: {told}");
    }
    app.assumptions[4] = None;
    let words = [
        "; what it stands on is being tried",
        "; what it stands on: being tried",
        ", more is tried",
        ": not final",
    ];
    for width in 60..=170 {
        let told = head(&app, width);
        assert!(words.iter().any(|words| told.contains(words)), "{width}: {told}");
    }
}

/// A plan that does not ask for one dud passes without an answer to it: the first line and the row say so, once.
#[test]
fn a_pass_that_one_dud_ends_is_thin_on_the_first_line_and_in_its_row() {
    let mut app = finished();
    let OptionState::Judged { judgement, .. } = &mut app.options[4] else { panic!("a judgement") };
    let planned = ShotSummary::of(&judgement.checked);
    let (row, number, sampled) = (0, 0, None);
    judgement.one_dud =
        Some(OneDud { row, number, planned, not_passing: 2, failing: 2, places: 15, sampled });
    app.selected = 4;
    let is_told = |app: &App| {
        text(&draw(app, 120, 36))
            .lines()
            .skip(3)
            .any(|line| line.contains("exceeds a limit at 2 of 15 holes"))
    };
    assert!(is_told(&app), "before it is known what the pass holds until");
    app.assumptions[4] = Some(Box::new(three_nearest()));
    recommend(&mut app, 4);
    let screen = text(&draw(&app, 120, 36));
    let told = "one dud exceeds a limit at 2 of 15 holes";
    assert!(screen.lines().nth(1).is_some_and(|line| line.contains(&format!("thinly: {told}"))), "{screen}");
    assert!(screen.lines().any(|line| line.contains("42 ms") && line.contains("△ THIN")), "{screen}");
    for width in 60..=170 {
        for screen in [Screen::Compare, Screen::Plan] {
            app.screen = screen;
            let screen = text(&draw(&app, width, 36));
            let header: Vec<&str> = screen.lines().skip(1).take(2).collect();
            assert_eq!(header.join("").matches("dud").count(), 1, "{width}:\n{screen}");
        }
    }
}

/// A pass of height and force alone has a mark in its row, which a badge explains; with a limit on the slide there is neither.
#[test]
fn a_row_whose_slide_is_not_checked_is_marked() {
    let mut app = finished();
    recommend(&mut app, 4);
    app.assumptions[4] = Some(Box::new(Assumptions { all: Vec::new(), ..three_nearest() }));
    let row =
        |screen: &str| screen.lines().find(|line| line.contains("✓ PASS")).unwrap_or_default().to_owned();
    for width in [60, 80, 120, 170] {
        let screen = text(&draw(&app, width, 36));
        assert!(row(&screen).contains("✓ PASS*"), "{screen}");
        assert!(screen.lines().nth(2).is_some_and(|badges| badges.contains("*slide")), "{screen}");
    }
    Arc::make_mut(&mut app.case).limits.drift = Some(30.0);
    let screen = text(&draw(&app, 80, 36));
    assert!(row(&screen).contains("✓ PASS ") && !screen.contains("*slide"), "{screen}");
}

/// How many inputs are assumed is said whole in the first line, or in the badges; the words behind a pass are never cut.
#[test]
fn a_pass_says_at_every_width_what_it_stands_on() {
    let mut app = finished();
    app.selected = 4;
    app.assumptions[4] = Some(Box::new(three_nearest()));
    recommend(&mut app, 4);
    for title in ["Rows", "EXAMPLE rows"] {
        Arc::make_mut(&mut app.case).plan.title = Some(title.to_owned());
        for width in 60..=170 {
            let screen = text(&draw(&app, width, 24));
            let [first, badges] = [1, 2].map(|n| screen.lines().nth(n).expect("a line"));
            let bare = first.replace(" (13 assumed)", "");
            assert!(bare.contains("if your inputs hold") && !bare.contains('('), "{width}:\n{screen}");
            let is_told = first != bare || badges.contains("assumed") || title.starts_with("EXAMPLE");
            assert!(is_told, "{width}:\n{screen}");
        }
    }
}

/// A name that is cut inside would be another option's, and a pass without what it rests on a final one.
#[test]
fn a_narrow_headline_cuts_no_name_at_its_comma_and_no_word_of_a_pass() {
    let mut app = finished();
    let name = "42 ms, village side first";
    Arc::make_mut(&mut app.case).plan.delays[4].name = name.to_owned();
    recommend(&mut app, 4);
    let head = |app: &App, width| text(&draw(app, width, 24)).lines().nth(1).expect("a line").to_owned();
    assert!(
        head(&app, 60).contains("more is tried") && !head(&app, 60).contains("PASS ·"),
        "{}",
        head(&app, 60)
    );
    app.assumptions[4] = Some(Box::new(three_nearest()));
    for width in [60, 80, 120] {
        let told = head(&app, width);
        assert!(told.contains("passes") && told.contains("if your inputs hold"), "{told}");
        assert!(width < 80 || told.contains(name), "{told}");
        assert!(told.contains("42 ms, vi"), "{told}");
    }
}

/// Headline, last line of `check` and the page name one option: the rule is one. A pass that is thin is called so by all of them.
#[test]
fn every_face_recommends_the_same_option() {
    let mut app = finished();
    let drawn = RiskSummary::of(&samples(&app.case, 600, false));
    let folder = tempfile::tempdir().expect("a folder");
    let _saved = save(&mut app);
    for (rise, is_thin) in [(0.05, true), (0.06, false)] {
        // Another option passes as well, with less spare launch speed.
        for option in [1, 4] {
            let OptionState::Judged { judgement, .. } = &mut app.options[option] else { panic!("judged") };
            judgement.checked = checked(Verdict::Pass);
            judgement.sampled = Evidence::Known(samples(&app.case, 500, false));
            let rise = if option == 4 { rise } else { 0.01 };
            judgement.launch_margin = Some(LaunchMargin::UpTo { rise, above: Verdict::Fail });
            app.take_news(News::Found { option, part: Part::Confirmation(Box::new(drawn)) });
        }
        let results = results(&app.options).expect("all are judged");
        let best = recommended(&app.case, &results).expect("one passes");
        assert_eq!(best, 4);
        app.selected = best;
        let nothing_fails = Assumptions { all: Vec::new(), ..three_nearest() };
        app.assumptions[best] = Some(Box::new(nothing_fails));
        let name = &app.case.plan.delays[best].name.clone();
        let answer = app.answer.as_ref().expect("an answer").to_string();
        let says = |text: &str| text.contains("THIN") || text.contains("thin");
        let thinly = if is_thin { ", but thinly" } else { "" };
        // Beside thin passes a firm one is the only one.
        let lead = if is_thin {
            "bears the fastest launches of 2 that pass"
        } else {
            "the only one of 2 that pass which is not thin as planned"
        };
        assert!(
            answer.starts_with(&format!("{name} passes, slide NOT checked{thinly}, {lead}: ")),
            "{answer}"
        );
        let screen = text(&draw(&app, 220, 36));
        let lines: Vec<&str> = screen.lines().collect();
        let said = if is_thin {
            format!("NOT YET  △ {name} passes, slide NOT checked, but thinly")
        } else {
            format!("NOT YET  {answer}")
        };
        assert!(lines[1].trim_start().starts_with(&said), "{screen}");
        let words = ["✓ PASS", "△ THIN"][usize::from(is_thin)];
        let row = lines.iter().find(|line| line.starts_with("▸42 ms")).expect("its row");
        assert!(row.contains(words), "{screen}");
        app.selected = 1;
        let beside = text(&draw(&app, 160, 36));
        let [thinly, why] =
            if is_thin { [", but thinly", ""] } else { ["", ", which as planned bears faster launches"] };
        assert!(beside.contains(&format!("next     recommended{thinly}: {name}{why}")), "{beside}");
        app.selected = best;
        let standing = app.standing();
        let report = report::check::report_of_plan(
            &app.case,
            &results,
            None,
            MustPass::Every,
            (&standing, &[]),
            false,
        );
        assert_eq!(report.answer.as_ref(), Some(&answer));
        let told = report::text::text(&report, report::text::Style::default());
        assert!(told.lines().last().is_some_and(|line| line.starts_with(&answer)), "{told}");
        let row = told.lines().find(|line| line.starts_with(name.as_str())).expect("its row");
        assert_eq!((row.contains("THIN"), row.contains("PASS")), (is_thin, !is_thin), "{told}");
        let any =
            report::check::report_of_plan(&app.case, &results, None, MustPass::One, (&standing, &[]), false);
        let word = [VerdictWord::Pass, VerdictWord::Thin][usize::from(is_thin)];
        assert_eq!(any.conclusion.map(|conclusion| conclusion.word), Some(word));
        // Scripts read a verdict.
        let csv = report::csv::csv(&[report], Separators::Comma).expect("a table");
        assert!(csv.contains(",pass,") && !says(&csv), "{csv}");
        let Request::NamePage(stem) = key(&mut app, KeyCode::Char('P')) else { panic!("a page") };
        assert!(
            stem.ends_with(
                ["42-ms-if-confirmed-to-be-fired", "42-ms-thin-if-confirmed-to-be-fired"]
                    [usize::from(is_thin)]
            ),
            "{stem}"
        );
        let file = "plan-42-ms-if-confirmed-to-be-fired.html";
        assert_eq!(app.misnames_page(file.as_ref()), is_thin);
        app.ask_for_file(Purpose::Page, "page.html");
        let prompt = text(&draw(&app, 120, 36));
        let said = if is_thin {
            "(THIN, slide NOT checked: even the planned shot"
        } else {
            "page of “42 ms” (PASS, slide NOT checked)"
        };
        assert!(prompt.contains(said), "{prompt}");
        let mut edited = app.clone();
        Arc::make_mut(&mut edited.case).source.text.push('\n');
        let prompt = text(&draw(&edited, 120, 36));
        assert!(prompt.contains("page of “42 ms” (HOLD"), "as its page: {prompt}");
        app.prompt = None;
        let path = folder.path().join(format!("page-{is_thin}.html"));
        export::write_page(&app, &path).expect("a page");
        let page = std::fs::read_to_string(&path).expect("the page");
        // The plan marks values as assumed.
        let thin = if is_thin { ", and a THIN pass" } else { "" };
        let head =
            format!("To be fired only if all that is to be confirmed is right{thin}, slide NOT checked: ");
        assert!(page.contains(&head) && page.contains(name.as_str()), "{page}");
        assert_eq!(page.contains("The pass is thin: "), is_thin);
        // Its foot, too: a sheet may lie alone.
        assert_eq!(page.matches("a THIN pass").count() > 1, is_thin);
    }
    // A sweep asks another question, of all intervals and not of the options: where its answer is another, it says why. Of a search
    // `search::the_best_found_is_what_compare_would_recommend`.
    let found = swept(&app.case);
    study_ends(&mut app, StudyKind::Sweep, Ok(found));
    key(&mut app, KeyCode::Char('4'));
    app.studies.show(StudyKind::Sweep);
    let screen = text(&draw(&app, 170, 45));
    assert!(screen.contains("210 ms"), "{screen}");
    assert!(screen.contains(" ms of the plan: what is accepted ends there"), "{screen}");
}

/// Accuracy begins with whether a finer computation would tell more.
#[test]
fn accuracy_says_first_whether_it_is_exact_enough() {
    let mut app = finished();
    (app.screen, app.selected) = (Screen::Accuracy, 4);
    let first =
        |app: &App, width| text(&draw(app, width, 24)).lines().nth(4).expect("a line").trim().to_owned();
    // Errors of 0.1 % beside samples that spread by 9 % to each side.
    assert_eq!(first(&app, 80), "Your inputs decide: force ±9 %; computing 0.10 %: finer tells no more");
    assert!(first(&app, 60).starts_with("Your inputs decide: force ±9 %"), "{}", first(&app, 60));
    // Inputs that leave open twice the value leave something to do.
    let known = app.options[4].clone();
    let OptionState::Judged { judgement, .. } = &mut app.options[4] else { panic!("a judgement") };
    let Evidence::Known(sampled) = &mut judgement.sampled else { panic!("samples") };
    sampled.samples.iter_mut().for_each(|sample| sample.run.height = 0.1 * (sample.number % 100) as f64);
    let wide = first(&app, 80);
    assert!(wide.starts_with("! Your inputs decide") && wide.ends_with("measure these first"), "{wide}");
    app.options[4] = known;
    let OptionState::Judged { judgement, .. } = &mut app.options[4] else { panic!("a judgement") };
    judgement.checked.estimates.height.error = 0.05 * judgement.checked.estimates.height.value;
    let coarse = first(&app, 80);
    assert!(coarse.starts_with("! Computing adds 5 %") && coarse.contains("computes finer"), "{coarse}");
}

/// However small the screen, the option that is selected has its line, and what is told below is of it.
#[test]
fn accuracy_shows_the_selected_option_at_every_size() {
    let mut app = finished();
    app.screen = Screen::Accuracy;
    for is_measured in [false, true] {
        if is_measured {
            study_ends(&mut app, StudyKind::Accuracy, Ok(measured()));
        }
        for option in 0..app.options.len() {
            app.selected = option;
            let start: String = app.case.plan.delays[option].name.chars().take(5).collect();
            for (width, height) in [(60, 18), (60, 20), (80, 24), (100, 30), (120, 36), (170, 45)] {
                let screen = text(&draw(&app, width, height));
                let row = screen.lines().find(|line| line.starts_with(&format!(" ▸{start}")));
                assert!(row.is_some_and(|row| row.contains("●─")), "{width}x{height}, {start}:\n{screen}");
                assert!(screen.contains("Your inputs decide"), "{screen}");
            }
        }
    }
    // Charts stand below also once the step was measured: options give their rows, and a cue counts them.
    app.selected = 4;
    let screen = text(&draw(&app, 80, 24));
    assert!(screen.contains("height ◆ 1 of 500 ▲ planned") && screen.contains(" 2 ↓ "), "{screen}");
    // A filter that leaves no option leaves what is told of the selected one.
    app.listing.filter = "no such option".to_owned();
    for (width, height) in [(60, 18), (120, 36)] {
        assert!(text(&draw(&app, width, height)).contains("Your inputs decide"));
    }
}

/// A study of risks tries no margin and draws nothing fresh: it calls nothing a pass that Compare does not.
#[test]
fn no_study_passes_what_compare_does_not() {
    let mut app = finished();
    app.screen = Screen::Studies;
    let results = app.options.iter().map(|state| Ok(state.judgement().expect("judged").clone())).collect();
    let risks = Risks { sampling: Sampling::exactly(500, 1), results };
    study_ends(&mut app, StudyKind::Risk, Ok(Found::Risk(Box::new(Computed::complete(risks)))));
    app.studies.select(StudyKind::Risk);
    for (is_pass, is_open) in [(true, false), (true, true), (false, false), (false, true)] {
        if !is_pass {
            app.options[4] = done(judgement(&app.case, 4), false);
        }
        app.studies.open = is_open;
        let screen = text(&draw(&app, 120, 36));
        let row = screen.lines().find(|line| line.trim_start().starts_with("42 ms  ")).expect(&screen);
        assert_eq!(row.contains("PASS"), is_pass, "{row}\n{screen}");
    }
}

/// Before a question is answered, the screen shows what is known of it; once it is, the same chart of its answer.
#[test]
fn what_is_known_stands_below_a_question() {
    let mut app = finished();
    (app.screen, app.selected) = (Screen::Studies, 4);
    app.assumptions[4] = Some(Box::new(three_nearest()));
    let below = |app: &App, wanted: &str| {
        for (width, height) in [(60, 20), (80, 24), (100, 30), (120, 36), (170, 45)] {
            let screen = text(&draw(app, width, height));
            assert!(screen.contains(wanted), "{width}x{height}, {wanted}:\n{screen}");
        }
    };
    for (kind, wanted) in [
        (StudyKind::Sweep, "share"),
        (StudyKind::Search, "share"),
        (StudyKind::Risk, "0 of 500"),
        (StudyKind::Assumptions, "so many times what is assumed"),
    ] {
        app.studies.select(kind);
        below(&app, wanted);
    }
    let found = Found::Assumptions(Box::new(Computed::complete(three_nearest())));
    study_ends(&mut app, StudyKind::Assumptions, Ok(found));
    for (width, height) in [(100, 30), (120, 36)] {
        let screen = text(&draw(&app, width, height));
        let ends = screen.lines().filter(|line| line.contains("━┃")).count();
        assert!(ends == 4 && screen.contains("stiffness"), "{screen}");
    }
    insta::assert_snapshot!("holds_100x30", text(&draw(&app, 100, 30)));
}

/// Charts in time tell where nine of ten shots lie, once that is known.
#[test]
fn charts_tell_how_far_19_of_20_shots_reach() {
    let mut app = finished();
    app.selected = 4;
    let before = text(&draw(&app, 140, 44));
    assert!(!before.contains('░'));
    let end = |height: f64| vec![height; 160];
    let band = CourseBand { width: 0.0075, height: [end(0.4), end(2.0)], force: [end(5e3), end(40e3)] };
    app.take_news(News::Band { option: 4, band: Box::new(band) });
    let screen = text(&draw(&app, 140, 44));
    assert!(screen.contains("░ 19 of 20 shots") && screen.matches('░').count() > 20, "{screen}");
    for (width, height) in [(60, 20), (80, 24), (100, 30), (120, 36)] {
        let screen = text(&draw(&app, width, height));
        let signs = screen.matches('░').count();
        assert!(signs == 0 || screen.contains("░ 19 of 20"), "a sign without its words:\n{screen}");
    }
    // A plan that is judged anew knows no band.
    app.take_news(News::Checked { option: 4, result: begun(&app.case, Verdict::Pass) });
    assert!(app.bands[4].is_none());
}

#[test]
fn options_without_room_are_counted() {
    let app = finished();
    assert!(text(&draw(&app, 60, 18)).contains("1 more ↓"));
    for (width, height) in [(60, 20), (80, 24)] {
        assert!(!text(&draw(&app, width, height)).contains("more ↓"), "{width}x{height}");
    }
    // A message takes the rows of the charts, and none of an option.
    let mut app = finished();
    app.notice = Some("a message of two lines ".repeat(5));
    let screen = text(&draw(&app, 80, 24));
    assert!(!screen.contains("more ↓") && !screen.contains("height  "), "{screen}");
}

#[test]
fn help_and_a_screen_that_is_too_small() {
    let mut app = finished();
    key(&mut app, KeyCode::Char('?'));
    insta::assert_snapshot!("help", text(&draw(&app, 100, 36)));
    insta::assert_snapshot!("too_small", text(&draw(&app, 50, 10)));
    // Narrow screens break its lines at words.
    let narrow = text(&draw(&app, 60, 120)).replace('│', " ");
    let words: Vec<&str> = narrow.split_whitespace().collect();
    for binding in BINDINGS.iter().filter(|binding| binding.is_on(app.screen)) {
        assert!(words.join(" ").contains(binding.text), "{}:\n{narrow}", binding.text);
    }
}

/// Below the limit no bar looks like one past it, with the colours away, at any size.
#[test]
fn what_lies_past_a_limit_differs_without_colours() {
    let app = finished();
    for (width, height) in [(60, 20), (80, 24), (120, 36), (170, 45)] {
        let mut screen = draw(&app, width, height);
        theme::without_color(&mut screen);
        let rows = text(&screen);
        let of =
            |name: &str| rows.lines().position(|line| line.trim_start_matches(['▸', ' ']).starts_with(name));
        let past = |name: &str| {
            let row = of(name).expect(name) as u16;
            (0..width).filter(|&x| screen[(x, row)].symbol() == "✗").count()
        };
        // One is the sign of its verdict.
        assert!(past("25 ms") > 1 && past("42 ms") == 0, "{width}x{height}:\n{rows}");
    }
}

#[test]
fn ascii_and_colourless_screens_say_the_same() {
    let mut buffer = draw(&finished(), 120, 36);
    theme::to_ascii(&mut buffer);
    theme::without_color(&mut buffer);
    let screen = text(&buffer);
    assert!(screen.is_ascii());
    assert!(buffer.content.iter().all(|cell| cell.fg == ratatui::style::Color::Reset));
    insta::assert_snapshot!("ascii", screen);
}

#[test]
fn studies_wait_run_and_show_what_they_found() {
    let mut app = finished();
    key(&mut app, KeyCode::Char('4'));
    insta::assert_snapshot!("study_idle", text(&draw(&app, 80, 24)));
    assert_eq!(key(&mut app, KeyCode::Enter), Request::Study(StudyKind::Sweep));
    let progress = Progress {
        fraction: 0.34,
        step: 2,
        steps: 3,
        trying: Some("42 ms".to_owned()),
        best: None,
        tried: vec![(0.042, 0.8), (0.1, 1.1)],
        sampled: vec![(0.042, 0.9)],
    };
    let at = StudyAt { progress, left: Some(Duration::from_secs(6)) };
    app.studies.set(StudyKind::Sweep, StudyState::Running(at));
    for (width, height) in [(60, 20), (80, 24)] {
        insta::assert_snapshot!(format!("study_running_{width}x{height}"), text(&draw(&app, width, height)));
    }
    let found = swept(&app.case);
    study_ends(&mut app, StudyKind::Sweep, Ok(found));
    insta::assert_snapshot!("study_answered", text(&draw(&app, 80, 24)));
    key(&mut app, KeyCode::Enter);
    for (width, height) in [(80, 24), (120, 36)] {
        insta::assert_snapshot!(format!("sweep_{width}x{height}"), text(&draw(&app, width, height)));
    }
    key(&mut app, KeyCode::Char('2'));
    key(&mut app, KeyCode::Char('4'));
    assert!(matches!(app.studies.state(StudyKind::Sweep), StudyState::Done(_)), "a result is kept");
}

/// Each question is one line at every width: cut at a word, or in fewer words.
/// What Compare says that a pass holds until, the question of it says too, before anybody asks.
#[test]
fn what_a_pass_holds_until_answers_its_question() {
    let mut app = finished();
    app.selected = 4;
    app.screen = Screen::Studies;
    let line = |app: &App, width| {
        let screen = text(&draw(app, width, 36));
        screen.lines().find(|line| line.contains("What must hold?")).expect("the question").to_owned()
    };
    assert!(line(&app, 120).contains("○ until when the pass holds"), "{}", line(&app, 120));
    app.assumptions[4] = Some(Box::new(three_nearest()));
    for width in [60, 80, 120] {
        let told = line(&app, width);
        assert!(told.contains("✓ ") && told.contains("until "), "{width}: {told}");
        assert!(!told.contains('…'), "no sentence is cut: {told}");
    }
    assert!(line(&app, 120).contains("✓ 42 ms until "), "{}", line(&app, 120));
}

#[test]
fn every_question_has_a_line_with_its_cost_and_answer() {
    let mut app = finished();
    app.screen = Screen::Studies;
    let found = swept(&app.case);
    study_ends(&mut app, StudyKind::Sweep, Ok(found));
    for (kind, found) in spreads(&app) {
        study_ends(&mut app, kind, Ok(found));
    }
    let questions = ["Which interval?", "Which row first?", "How likely?", "Safest schedule?"];
    for (width, height) in [(60, 18), (60, 20), (80, 24), (120, 36), (170, 45)] {
        for _ in StudyKind::tabs() {
            key(&mut app, KeyCode::Down);
            let screen = text(&draw(&app, width, height));
            let first = screen.lines().position(|line| line.contains(questions[0])).expect("the first");
            let lines: Vec<&str> = screen.lines().skip(first).take(StudyKind::tabs().len()).collect();
            for (line, question) in lines.iter().zip(questions) {
                // What it found in a row stands in place of what it costs.
                let is_answered = !line.contains('○');
                let has_bars = line.chars().any(|letter| ('▁'..='█').contains(&letter) || letter == '✗');
                assert!(
                    line.chars().take(24).collect::<String>().contains(question),
                    "{width}: {line}\n{screen}"
                );
                assert!(
                    has_bars == is_answered && line.contains('~') != is_answered,
                    "{width}: {line}\n{screen}"
                );
            }
            let selected = StudyKind::tabs().iter().position(|kind| *kind == app.studies.shown);
            assert!(lines[selected.expect("a question")].starts_with('▸'), "{screen}");
            assert!(lines[0].contains("✓ 210 ms") && lines[2].contains("fail least"), "{screen}");
        }
        insta::assert_snapshot!(format!("questions_{width}x{height}"), text(&draw(&app, width, height)));
    }
}

/// What the badge counts is found: each value that the plan's own comment calls assumed says so.
#[test]
fn an_assumed_value_is_marked_where_it_stands() {
    let mut app = finished();
    key(&mut app, KeyCode::Char('1'));
    app.editor.find("launch by hole", false);
    let screen = text(&draw(&app, 80, 24));
    let marked = |label: &str| {
        screen.lines().find(|line| line.contains(label)).is_some_and(|line| line.contains(" assumed"))
    };
    assert!(marked("launch by hole, %") && !marked("detonators"), "{screen}");
    assert!(screen.contains("found on site? Type it here"), "{screen}");
}

#[test]
fn the_plan_is_shown_with_its_values() {
    let mut app = finished();
    key(&mut app, KeyCode::Char('1'));
    for (width, height) in [(80, 24), (120, 36)] {
        insta::assert_snapshot!(format!("plan_{width}x{height}"), text(&draw(&app, width, height)));
    }
    key(&mut app, KeyCode::Enter);
    key(&mut app, KeyCode::Char('x'));
    insta::assert_snapshot!("plan_typing", text(&draw(&app, 100, 30)));
}

/// Firing times that ran together would be other times.
/// Where all words have no room, fewer say what the signs of the table and of the charts mean.
#[test]
fn signs_have_their_meaning_on_a_narrow_screen() {
    let mut app = finished();
    app.selected = 4;
    for (width, meaning) in [(70, " ▆ 1 in 100 above • plan ┃ limit"), (64, " height in time ⠒ planned ")]
    {
        let screen = text(&draw(&app, width, 36));
        assert!(screen.contains(meaning), "{screen}");
    }
}

/// On a wide screen the cables stand below the values, the options with all of their graphics below charts, and these below a map that keeps
/// its proportions.
#[test]
fn the_plan_uses_the_room_of_a_wide_screen() {
    let mut app = finished();
    (app.screen, app.selected) = (Screen::Plan, 4);
    let screen = text(&draw(&app, 170, 45));
    let lines: Vec<&str> = screen.lines().collect();
    // Both limits of the selected option stand below its map.
    for limit in ["height ", "force "] {
        let mut right = lines.iter().filter_map(|line| line.split('│').nth(1));
        assert!(right.any(|line| line.trim_start().starts_with(limit) && line.contains('┃')), "{screen}");
    }
    // The names of the values are whole there, their signs below one another.
    let signs = lines.iter().filter(|line| line.contains(" ms 1-2-3") || line.contains(" ms 2-1-3"));
    let places: Vec<Option<usize>> =
        signs.map(|line| line.chars().position(|sign| "✓✗?△…".contains(sign))).collect();
    assert!(places.len() >= 4 && places.iter().all_equal(), "{places:?}:\n{screen}");
    assert!(lines.iter().any(|line| line.starts_with(" 25 ms, middle first ")), "{screen}");
    assert!(
        ["height in time ⠒ planned", "force in time ⠒ planned"].iter().all(|title| screen.contains(title)),
        "{screen}"
    );
    // Rows and columns of tires stand as far apart as each other: a cell is twice as high as wide.
    let points = |line: &&&str| line.chars().skip(93).filter(|sign| *sign == 'o').count() == 10;
    let row = lines.iter().find(points).expect("a row without holes");
    let places: Vec<usize> =
        row.chars().enumerate().skip(93).filter(|(_, sign)| *sign == 'o').map(|(n, _)| n).collect();
    let across = (places[9] - places[0]) as f64 / 9.0;
    let holes = |line: &&&str| line.contains("│ 2 42 ");
    let [top, bottom] =
        [lines.iter().position(|line| points(&line)), lines.iter().position(|line| holes(&line))];
    let (top, bottom) = (top.expect("row 5") as f64, bottom.expect("row 2") as f64);
    let down = 2.0 * (bottom - top) / 3.0;
    assert!((0.75..1.33).contains(&(across / down)), "{across} by {down}:\n{screen}");
}

/// Columns of tires are as far apart from one another as any two; the verdict beside them is that of Compare.
#[test]
fn the_map_stands_evenly_under_the_verdict() {
    let mut app = finished();
    app.screen = Screen::Plan;
    for option in 0..app.options.len() {
        app.selected = option;
        let words = ["✗ FAIL", "? OPEN", "✗ FAIL", "✗ FAIL", "… wait", "? OPEN", "✗ FAIL"][option];
        let widths = (60..=170).step_by(if option == 0 { 1 } else { 7 });
        for (width, height) in widths.cartesian_product([20, 24, 36]) {
            let screen = text(&draw(&app, width, height));
            // Cables are lines between the signs.
            let is_line = |sign: char| "─│╱╲╳".contains(sign);
            let map = |line: &str| line.split_once('│').unwrap_or_default().1.replace(is_line, " ");
            let is_row = |line: &&str| map(line).matches('o').count() == 10;
            let row = map(screen.lines().find(is_row).expect(&screen));
            let places: Vec<usize> =
                row.chars().enumerate().filter(|(_, sign)| *sign == 'o').map(|(n, _)| n).collect();
            assert!(places.windows(2).map(|pair| pair[1] - pair[0]).all_equal(), "{width}:\n{screen}");
            assert!(screen.contains(&format!("│ {words} · ")), "{width}, {option}:\n{screen}");
            // No hole is missing: each row of them is numbered, has its time and all ten.
            for row in ["1", "2", "3"] {
                let is_row = |line: &str| {
                    let map = map(line);
                    let words: Vec<&str> = map.split_whitespace().collect();
                    words.first() == Some(&row) && words.len() == 12
                };
                assert!(screen.lines().any(is_row), "{width}, row {row}:\n{screen}");
            }
        }
    }
}

#[test]
fn firing_times_on_the_map_never_run_together() {
    let shipped = app();
    // Holes of a row that fire one after the other have a time each.
    let slow = shipped.editor.text.edited("interval_ms = 9\n", "interval_ms = 500\nhole_interval_ms = 1\n");
    let case = Case::parse(PlanSource { path: std::path::PathBuf::new(), text: slow }).expect("a plan");
    let mut app = App::new(Arc::new(case), shipped.compute, &Config::default());
    app.screen = Screen::Plan;
    app.selected = app.case.plan.delays.iter().position(|delay| delay.name == "9 ms").expect("an option");
    let mut with_times = 0;
    for width in 60..=180 {
        let screen = text(&draw(&app, width, 36));
        let words: Vec<&str> = screen.split_whitespace().collect();
        with_times += usize::from(words.iter().filter(|word| **word == "1009").count() > 1);
        let in_time = screen.lines().find(|line| line.contains("│ fires ")).expect(&screen);
        let last = in_time.trim_end_matches([' ', '│']);
        assert!(last.ends_with("1009 ms"), "{width}: the last time is whole\n{screen}");
        for word in words.iter().filter(|word| word.bytes().all(|byte| byte.is_ascii_digit())) {
            assert!(word.len() <= 4, "{width}: {word}\n{screen}");
        }
    }
    assert!((1..=120).contains(&with_times), "wide screens have times, narrow ones signs: {with_times}");
}

/// A time beside the map is that of the row whose number stands there, also where rows of tires share a line.
#[test]
fn a_time_beside_the_map_is_that_of_its_row() {
    let shipped = app();
    let mut seen = BTreeSet::new();
    for rows in [5, 8, 12, 30] {
        let text_of_plan = shipped.editor.text.edited("rows = 5 ", &format!("rows = {rows} "));
        let source = PlanSource { path: std::path::PathBuf::new(), text: text_of_plan };
        let case = Case::parse(source).expect("a plan");
        let mut app = App::new(Arc::new(case), shipped.compute, &Config::default());
        app.screen = Screen::Plan;
        app.selected =
            app.case.plan.delays.iter().position(|delay| delay.name == "109 ms").expect("an option");
        for (width, height) in (18..=60).flat_map(|height| [(80, height), (120, height), (170, height)]) {
            let screen = text(&draw(&app, width, height));
            let lines = screen.lines().filter_map(|line| line.rsplit('│').next());
            let holes = lines.filter(|line| line.contains('●'));
            for line in holes.filter(|line| !line.contains("hole")) {
                let numbers: Vec<&str> = line.split_whitespace().take_while(|word| *word != "●").collect();
                let [row, time] = numbers[..] else { continue };
                let fires = [("1", "0"), ("2", "109"), ("3", "218")];
                assert!(fires.contains(&(row, time)), "{rows} rows, {width}x{height}: {line}\n{screen}");
                seen.insert((rows, row.to_owned()));
            }
        }
    }
    assert!(seen.len() >= 9, "{seen:?}");
}

/// Nothing fires together where nothing fires.
#[test]
fn no_time_is_told_of_an_option_without_firings() {
    let mut app = app();
    app.screen = Screen::Plan;
    assert!(text(&draw(&app, 80, 24)).contains("fires 0 ms, all at once"));
    Arc::make_mut(&mut app.case).shots[0].firings.clear();
    assert!(!text(&draw(&app, 80, 24)).contains(" fires "));
}

/// Beside the map of the cables it is said how many shots are left out, whether the table has room or not.
#[test]
fn the_plan_says_how_many_shots_pull_harder_than_its_cables_show() {
    let shipped = app();
    let more: String = (0..15).map(|n| format!("[[delay]]\nname = \"n {n}\"\ninterval_ms = {n}\n")).collect();
    let many = shipped
        .editor
        .text
        .edited("[[delay]]\nname = \"9 ms\"", &format!("{more}[[delay]]\nname = \"9 ms\""));
    let case = Case::parse(PlanSource { path: std::path::PathBuf::new(), text: many }).expect("a plan");
    let mut app = App::new(Arc::new(case), shipped.compute, &Config::default());
    (0..app.options.len()).for_each(|option| app.options[option] = done(judgement(&app.case, option), false));
    app.screen = Screen::Plan;
    let mut with_map = 0;
    for (width, height) in
        [60, 80, 120, 170].into_iter().flat_map(|width| (40..90).map(move |height| (width, height)))
    {
        let screen = text(&draw(&app, width, height));
        let has_map = screen.contains("◆ hardest");
        let is_told = screen.contains("1 in 100 shots above") || screen.contains("1 in 100 above");
        assert!(is_told || !has_map, "{width}x{height}:\n{screen}");
        with_map += usize::from(has_map);
    }
    assert!(with_map > 0);
}

/// A shelter may have more rows than a screen could ever have.
#[test]
fn a_plan_of_very_many_rows_is_drawn() {
    let shipped = app();
    let long =
        shipped.editor.text.edited("rows = 5 ", "rows = 40_000 ").edited("columns = 10 ", "columns = 1 ");
    let case = Case::parse(PlanSource { path: std::path::PathBuf::new(), text: long }).expect("a plan");
    let mut app = App::new(Arc::new(case), shipped.compute, &Config::default());
    app.screen = Screen::Plan;
    for (width, height) in [(80, 24), (120, 36), (170, 45)] {
        let screen = text(&draw(&app, width, height));
        assert!(screen.contains("all at once"), "{width}:\n{screen}");
    }
}

#[test]
fn orders_samples_and_sizes_have_a_picture() {
    let mut app = finished();
    key(&mut app, KeyCode::Char('4'));
    for (kind, found) in spreads(&app) {
        study_ends(&mut app, kind, Ok(found));
        app.studies.show(kind);
        let name = format!("{kind:?}").to_lowercase();
        insta::assert_snapshot!(format!("{name}_120x36"), text(&draw(&app, 120, 36)));
        for (width, height) in [(60, 18), (80, 24), (200, 60)] {
            draw(&app, width, height);
        }
    }
}

/// A result that stays under a header with other settings says so.
#[test]
fn a_result_of_other_settings_is_marked() {
    let mut app = finished();
    key(&mut app, KeyCode::Char('4'));
    let found = swept(&app.case);
    study_ends(&mut app, StudyKind::Sweep, Ok(found));
    let fresh = text(&draw(&app, 80, 24));
    assert!(fresh.contains(" · verlet, field · Enter") && !fresh.contains("computes again"), "{fresh}");
    key(&mut app, KeyCode::Char('-'));
    let marked = text(&draw(&app, 80, 24));
    assert!(marked.contains("computed with verlet, field; r computes again"), "{marked}");
    assert_eq!(key(&mut app, KeyCode::Char('r')), Request::Study(StudyKind::Sweep));
    let found = swept(&app.case);
    study_ends(&mut app, StudyKind::Sweep, Ok(found));
    let fresh = text(&draw(&app, 80, 24));
    assert!(fresh.contains(" · verlet, draft · ") && !fresh.contains("computes again"), "{fresh}");
}

/// Foreground colours of the cells that show a text, wherever the screen shows it.
fn colors(buffer: &Buffer, wanted: &str) -> Vec<Vec<Color>> {
    let width = usize::from(buffer.area.width);
    let wanted: Vec<String> = wanted.chars().map(String::from).collect();
    let lines = buffer.content.chunks(width);
    let hits = lines.flat_map(|line| line.windows(wanted.len()));
    let hits = hits.filter(|cells| cells.iter().map(Cell::symbol).eq(wanted.iter().map(String::as_str)));
    hits.map(|cells| cells.iter().map(|cell| cell.fg).collect()).collect()
}

/// A cell is coloured because it is a verdict, not because its text looks like one.
#[test]
fn a_blast_row_named_like_a_verdict_has_no_colour() {
    let mut app = app();
    let mut case = (*app.case).clone();
    case.plan.blast_rows[0].name = "PASS-3".to_owned();
    app.case = Arc::new(case);
    key(&mut app, KeyCode::Char('4'));
    for (kind, found) in spreads(&app) {
        study_ends(&mut app, kind, Ok(found));
    }
    app.studies.show(StudyKind::Orders);
    let buffer = draw(&app, 120, 36);
    let (plain, pass, fail) =
        (Color::Reset, app.theme.verdict(Verdict::Pass).fg, app.theme.verdict(Verdict::Fail).fg);
    let named = colors(&buffer, "PASS-3");
    assert_eq!(named.len(), 7, "six orders, and the best again: {}", text(&buffer));
    assert!(named.iter().flatten().all(|color| *color == plain), "{named:?}");
    for (label, color, count) in [("PASS ", pass, 3), ("FAIL ", fail, 3)] {
        let found = colors(&buffer, label);
        // The sentence above the table names the best order and its verdict, in plain words.
        let colored = found.iter().filter(|cells| Some(cells[0]) == color);
        assert_eq!(colored.count(), count, "{}", text(&buffer));
    }
}

#[test]
fn the_smallest_screen_shows_the_conclusion_and_the_windows_of_a_sweep() {
    let mut app = finished();
    key(&mut app, KeyCode::Char('4'));
    let found = swept(&app.case);
    study_ends(&mut app, StudyKind::Sweep, Ok(found));
    key(&mut app, KeyCode::Enter);
    let screen = text(&draw(&app, 60, 18));
    assert!(
        screen.contains("30 of 51 tried pass as planned") && screen.contains("windows that pass: 0 ms to"),
        "{screen}"
    );
    insta::assert_snapshot!("sweep_60x18", screen);
}

/// Commands print these notes to standard error.
#[test]
fn notes_stand_beside_the_results() {
    let mut app = finished();
    let mut case = (*app.case).clone();
    case.plan.delays[1].timing = Timing::At([0.0, 20.0, 40.0].map(Time::from_ms).to_vec());
    case.plan.uncertainty.delay.sd_ms = 20.0;
    case.plan.uncertainty.in_hole_delay_ms = 500.0;
    app.case = Arc::new(case);
    key(&mut app, KeyCode::Char('4'));
    for (kind, found) in spreads(&app) {
        study_ends(&mut app, kind, Ok(found));
    }
    app.studies.show(StudyKind::Orders);
    let orders = text(&draw(&app, 120, 36));
    let left_out = &app.case.plan.delays[1].name;
    assert!(orders.contains(&format!("and left out: {left_out}")), "{orders}");
    app.studies.show(StudyKind::Risk);
    let risk = text(&draw(&app, 120, 36));
    assert!(risk.contains("is short for the scatter of the detonators; a given hole of row 2"), "{risk}");
    let mut case = (*app.case).clone();
    case.plan.delays[1].hole_timing.interval = Time::from_ms(17.0);
    let swaps = warnings::of_option(&case, 1, app.judgement(1).expect("judged"));
    assert!(swaps[0].contains("the first hole of row 2 fires before the first hole of row 1"), "{swaps:?}");
}

/// Every screen in plain characters, and where each theme shows which style.
#[test]
fn every_screen_in_every_theme() {
    for (width, height) in [(80, 24), (120, 36)] {
        for screen in Screen::ALL {
            let mut app = finished();
            app.screen = screen;
            app.selected = 4;
            let found = swept(&app.case);
            study_ends(&mut app, StudyKind::Sweep, Ok(found));
            study_ends(&mut app, StudyKind::Accuracy, Ok(measured()));
            let flight = recorded(&app, 4);
            study_ends(&mut app, StudyKind::Flight, Ok(flight));
            app.player.show(4, app.shown_sample(4));
            // The second row fires; the first is in the air.
            app.player.time = 0.05;
            let mut plain = draw(&app, width, height);
            theme::to_ascii(&mut plain);
            let ascii = text(&plain);
            assert!(ascii.is_ascii(), "{ascii}");
            let mut shown = format!("{ascii}\n");
            for theme in [Theme::Dark, Theme::Light, Theme::Sunlight] {
                app.theme = theme;
                shown += &format!("\n{theme:?}\n{}\n", styles(&draw(&app, width, height)));
            }
            let name = screen.name().to_lowercase();
            insta::assert_snapshot!(format!("{name}_styles_{width}x{height}"), shown);
        }
    }
}

/// Every line as runs of named styles, then the colours that each name stands for.
fn styles(buffer: &Buffer) -> String {
    let mut legend = BTreeSet::new();
    let mut text = String::new();
    for line in buffer.content.chunks(usize::from(buffer.area.width)) {
        let named: Vec<String> = line.iter().map(|cell| style_name(cell.style())).collect();
        let runs = named.chunk_by(|a, b| a == b).map(|run| format!("{} {}", run.len(), run[0]));
        text += &(runs.collect::<Vec<_>>().join(", ") + "\n");
        legend.extend(line.iter().map(|cell| {
            let Style { fg, bg, add_modifier, .. } = cell.style();
            format!("\n{}: {fg:?} on {bg:?} {add_modifier:?}", style_name(cell.style()))
        }));
    }
    text.extend(legend);
    text
}

/// `bold orange`, `reversed`, `blue on blue`; `plain` for text as it is.
fn style_name(style: Style) -> String {
    let color = |color: Option<Color>| match color {
        Some(Color::Reset | Color::Rgb(0, 0, 0) | Color::Rgb(30, 30, 30)) => None,
        Some(Color::Rgb(255, 255, 255) | Color::Rgb(250, 250, 246)) => None,
        Some(Color::Rgb(154, 162, 170) | Color::Rgb(80, 80, 80)) => Some("gray".to_owned()),
        Some(Color::Rgb(86, 180, 233) | Color::Rgb(0, 70, 150)) => Some("blue".to_owned()),
        Some(Color::Rgb(240, 228, 66) | Color::Rgb(130, 95, 0)) => Some("yellow".to_owned()),
        Some(Color::Rgb(255, 140, 60) | Color::Rgb(190, 25, 0)) => Some("orange".to_owned()),
        other => Some(format!("{other:?}")),
    };
    let modifiers = style.add_modifier.iter_names().map(|(name, _)| name.to_lowercase());
    let words: Vec<String> =
        modifiers.chain(color(style.fg)).chain(color(style.bg).map(|name| format!("on {name}"))).collect();
    if words.is_empty() { "plain".to_owned() } else { words.join(" ") }
}

/// A share of the limit that only the shot as planned keeps would flatter an option beside its samples.
#[test]
fn the_share_of_the_limit_is_that_of_95_percent_of_the_possible_shots() {
    let mut app = finished();
    let shares = |app: &App| -> String {
        let compare = text(&draw(app, 120, 36));
        compare.lines().find(|line| line.starts_with("▸all at once")).expect("the first option").to_owned()
    };
    let limit = app.case.limits.height;
    let OptionState::Judged { judgement, .. } = &mut app.options[0] else { panic!("judged") };
    let Evidence::Known(sampled) = &mut judgement.sampled else { panic!("sampled") };
    for (n, sample) in sampled.samples.iter_mut().enumerate() {
        sample.run.height = limit * if n % 10 == 0 { 1.17 } else { 0.5 };
    }
    assert!(shares(&app).contains(" 117 %"), "one in ten is that high: {}", shares(&app));
    let OptionState::Judged { judgement, .. } = &mut app.options[0] else { panic!("judged") };
    judgement.sampled = Evidence::Awaited;
    let alone = shares(&app);
    assert!(!alone.contains('%'), "the planned shot alone would flatter: {alone}");
}

/// Between two schedules found there is none: the chart has points, and no line that would look like more.
#[test]
fn the_chart_of_a_search_has_points() {
    let app = finished();
    let point = |duration: f64, failures: usize| FrontPoint {
        schedule: Schedule::at_interval(&[0, 1, 2], Time::from_ms(500.0 * duration), HoleTiming::TOGETHER),
        duration,
        share: RoughShare { samples: 256, failures },
    };
    let chart = charts::front(&app.case, &[point(0.04, 20), point(0.08, 2)]);
    assert!(chart.series.iter().all(|series| series.kind == SeriesKind::Points));
}

/// What is drawn before a question is asked has every option of the plan: also those that fire at no even interval, and those far past a limit.
#[test]
fn every_option_has_its_bar_before_a_question_is_asked() {
    let mut app = finished();
    app.screen = Screen::Studies;
    for kind in [StudyKind::Sweep, StudyKind::Orders, StudyKind::Risk, StudyKind::Search, StudyKind::Size] {
        app.studies.select(kind);
        for (width, height) in [(80, 24), (120, 36), (170, 45)] {
            let screen = text(&draw(&app, width, height));
            let signs = if kind == StudyKind::Risk { "━" } else { "┃" };
            let bars = screen.lines().skip(13).filter(|line| line.contains(signs));
            for delay in &app.case.plan.delays {
                let name: String = delay.name.chars().take(6).collect();
                assert!(bars.clone().any(|bar| bar.starts_with(&format!(" {name}"))), "{name}:\n{screen}");
            }
        }
    }
}

/// Sweep may recommend another interval than the first line: beside an option that passes stands how near the next one lies that is not accepted.
#[test]
fn an_option_beside_intervals_that_are_not_accepted_says_so() {
    let mut app = finished();
    app.selected = 4;
    let mut with = |windows: Vec<[f64; 2]>| {
        let Found::Sweep(mut sweep) = swept(&app.case) else { unreachable!("a sweep") };
        sweep.value.windows = windows.into_iter().map(|window| window.map(Time::from_ms)).collect();
        study_ends(&mut app, StudyKind::Sweep, Ok(Found::Sweep(sweep)));
        text(&draw(&app, 80, 24))
    };
    // The recommended 210 ms has 10 ms on either side.
    let line = " sweep    intervals only 2.5 ms beside it are not accepted; 210 ms has 10 ms";
    assert!(with(vec![[39.5, 60.0]]).contains(line));
    for windows in [vec![[32.0, 60.0]], vec![[43.0, 60.0]]] {
        assert!(!with(windows).contains(" sweep "));
    }
}

/// What a scene requires and the plan leaves out is no secret of the screen that computed it.
#[test]
fn effects_that_the_plan_lacks_stay_told_on_compare() {
    let mut app = finished();
    app.selected = 4;
    let badges = |app: &App| text(&draw(app, 170, 45)).lines().nth(2).expect("badges").to_owned();
    assert!(!badges(&app).contains("required, not in the plan"));
    let case = app.case.with_options(&[4]);
    let found = effects(&Context::new(&case, app.compute, &StudyControl::default())).expect("a result");
    let options = EffectsOnOptions { options: vec![4], effects: found.value };
    let lacking = options.all().find(|row| row.is_required() && row.assumed && row.effect.is_of_plan());
    let name = lacking.expect("tilted launches change the slide").effect.name();
    let found = Found::Effects(Box::new(Computed::complete(options)));
    study_ends(&mut app, StudyKind::Effects, Ok(found));
    assert!(badges(&app).contains(&format!("required, not in the plan: {name}")), "{}", badges(&app));
    app.compute.step = Some(2e-3);
    assert!(!badges(&app).contains("required, not in the plan"), "they were computed otherwise");
}
