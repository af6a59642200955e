//! The selected option in at most six short lines, each with a label and a place of its own. A line without news is left out.
//!
//! ```text
//!  fails    0 of 500 shots failed: surely under 1 in 100
//!  highest  planned 1.67 m at 1:1       worst 2.23             limit 2.35
//!  hardest  planned 53.0 kN in 3:1-4:1  worst 77.1 in 2:1-3:1  limit 84.0
//!  holds    until all launches tilt by 2.6° (assumed 1°)
//!  depends  on launch speed (60 % of the scatter): film a shot (4 Fit)
//!  next     P: page to sign
//! ```

use std::iter::repeat;

use ratatui::style::Style;
use ratatui::text::{Line, Span};
use unicode_width::UnicodeWidthStr;

use crate::report::remedies::words;
use crate::report::words::assumption_words;
use crate::report::words::option_sentences::{DECIDES, one_dud_in_brief};
use crate::report::words::reasons::{self, ReasonWords};
use crate::study::as_planned::margin::LaunchMargin;
use crate::study::judge::Judgement;
use crate::study::judge::Reason;
use crate::study::judge::recommend::are_alike;
use crate::study::samples::influence::input_shares;
use crate::study::samples::random_shot::Input;
use crate::tui::app::App;
use crate::tui::keymap::Action;
use crate::tui::screen::Screen;
use crate::units::{self, Unit};
use crate::verdict::{Quantity, Verdict};

/// Width of a label with the spaces around it.
const LABEL: usize = 10;
/// Number of lines.
const LINES: usize = 6;
/// Significant digits.
const DIGITS: i32 = 3;
/// What a pass stands on, until it is known.
const BEING_FOUND: &str = "still being found";

/// The lines of the selected option, none wider than `width`. Where they have more than six rows, each assumption that a pass stands on
/// has its own.
pub fn six_lines(app: &App, judged: &Judgement, width: u16, rows: usize) -> Vec<Line<'static>> {
    let room = usize::from(width).saturating_sub(LABEL);
    let verdict = judged.verdict();
    let [highest, hardest] = peaks(app, judged, room);
    let (stands, margin) = margin(app, judged);
    let plain = app.theme.base();
    let singly: Vec<String> = margin.iter().flat_map(|part| broken_at_bracket(part, room)).collect();
    let of_margin = match rows + 1 >= LINES + singly.len() && singly.iter().all(|part| part.width() <= room) {
        true => singly,
        false => vec![fitting(margin, ", ", room)],
    };
    let labels = [stands].into_iter().chain(repeat(""));
    let mut lines = vec![
        ("fails", fitting(fails(app, judged), " · ", room), app.theme.verdict(verdict)),
        ("highest", highest, plain),
        ("hardest", hardest, plain),
    ];
    lines.extend(labels.zip(of_margin).map(|(label, text)| (label, text, plain)));
    lines.extend([
        ("depends", fitting(depends(app, judged), "", room), plain),
        ("next", fitting(next(app, judged), "", room), app.theme.title()),
    ]);
    let lines = lines.into_iter().filter(|(_, text, _)| !text.is_empty());
    lines.map(|(label, text, style)| line(app, label, text, style)).collect()
}

/// A label and what it says.
fn line(app: &App, label: &str, text: String, style: Style) -> Line<'static> {
    let label = format!(" {label:0$}", LABEL - 1);
    Line::from(vec![Span::styled(label, app.theme.muted()), Span::styled(text, style)])
}

/// A part that is wider than `room` broken before its bracket: `… by 12 %`, `(assumed 3 %)`.
fn broken_at_bracket(part: &str, room: usize) -> Vec<String> {
    match part.split_once(" (").filter(|_| part.width() > room) {
        Some((before, bracket)) => vec![before.to_owned(), format!("  ({bracket}")],
        None => vec![part.to_owned()],
    }
}

/// As many of `parts` as have room, in their order; a part without room is left out.
fn fitting(parts: Vec<String>, between: &str, room: usize) -> String {
    parts.into_iter().fold(String::new(), |line, part| {
        let longer = if line.is_empty() { part } else { format!("{line}{between}{part}") };
        if longer.width() <= room { longer } else { line }
    })
}

/// How many shots fail of those tried, and what else keeps the option from a pass.
fn fails(app: &App, judged: &Judgement) -> Vec<String> {
    let is_open = app.options[app.selected].is_open_for_now();
    // A fail needs no word of what is still open. As long as samples come, how many there are says more than that they do not suffice.
    let decides = |why: &Reason| why.verdict() == judged.verdict();
    let reasons = judged.reasons().into_iter().filter(decides);
    let reasons = reasons.filter(|why| !is_open || matches!(why, Reason::AsPlanned(_)));
    let mut parts: Vec<String> = reasons.filter_map(|why| reason_words(app, judged, &why)).collect();
    let counts = judged.sampled.known().map(|sampled| &sampled.bounds);
    let accepted = app.case.limits.accepted_risk;
    parts.extend(counts.map(|bounds| {
        let failed = format!("{} of {} shots failed", bounds.failures, bounds.samples);
        let one_in = units::one_in(accepted);
        let [low, high] = bounds.interval;
        match (is_open, parts.is_empty()) {
            (true, _) => format!("{failed} so far, more come"),
            (_, false) => failed,
            _ if high < accepted => format!("{failed}: surely under 1 in {one_in}"),
            _ if low > accepted => format!("{failed}: surely over 1 in {one_in}"),
            _ => format!("{failed}: not surely under 1 in {one_in}"),
        }
    }));
    if is_open && counts.is_none() {
        parts.push("no shot tried so far, the first come".to_owned());
    }
    parts
}

/// Why an option does not pass; `None` for a reason that the count of shots says.
fn reason_words(app: &App, judged: &Judgement, reason: &Reason) -> Option<String> {
    let ReasonWords { brief, needs_finer_accuracy, .. } = reasons::words(&app.case, judged, reason);
    let finer = || format!(": {} finer accuracy", app.keymap.hint(Action::Finer));
    Some(brief? + &if needs_finer_accuracy { finer() } else { String::new() })
}

/// The highest tire and the hardest pulled cable: planned, in the worst of the accepted number of shots, and the limit. Tire and cable
/// stand behind the value that is theirs.
fn peaks(app: &App, judged: &Judgement, room: usize) -> [String; 2] {
    let (scene, checked) = (app.case.scene(), &judged.checked);
    let row = |quantity: Quantity, unit: Unit, place: String, none: &str| {
        let digits = |value| units::significant(value, unit, DIGITS);
        let planned = checked.get(quantity).value;
        let worst = judged.sampled.known().and_then(|sampled| sampled.value_at_risk(quantity));
        let limit = app.case.limits.get(quantity);
        // What is past the limit does not look like it.
        let digits = |value: f64| match limit {
            Some(limit) if value != limit && digits(value) == digits(limit) => {
                units::significant(value, unit, 2 * DIGITS)
            }
            _ => digits(value),
        };
        [
            match planned > 0.0 {
                true => format!("planned {} {} {place}", digits(planned), unit.symbol()),
                false => format!("planned: {none}"),
            },
            worst.map_or_else(String::new, |worst| format!("worst {}", digits(worst))),
            limit.map_or_else(String::new, |limit| format!("limit {}", digits(limit))),
        ]
    };
    let [height, force] = [&checked.estimates.height, &checked.estimates.force];
    let highest = format!("at {}", scene.tire_ids[height.index]);
    let hardest = format!("in {}", scene.cable_name(force.index));
    let mut rows = [
        row(Quantity::Height, Unit::Metre, highest, "no tire lifts"),
        row(Quantity::Force, Unit::Kilonewton, hardest, "no cable pulls"),
    ];
    // The worst pull has the name of its own cable: that is the one to strengthen.
    let at_risk = judged.sampled.known().and_then(|sampled| sampled.cable_at_risk());
    if let Some(cable) = at_risk.filter(|_| !rows[1][1].is_empty()) {
        rows[1][1] += &format!(" in {}", scene.cable_name(cable));
    }
    // The shots tried pull their hardest cables elsewhere than the shot as planned, where they do.
    let most_often =
        judged.sampled.known().and_then(|sampled| Some(sampled.hardest_pulled_cables().first()?.0));
    let elsewhere = most_often
        .filter(|&cable| checked.estimates.force.value > 0.0 && cable != checked.estimates.force.index);
    let elsewhere =
        elsewhere.map_or_else(String::new, |cable| format!("most often {}", scene.cable_name(cable)));
    let [highest, hardest] = rows;
    let rows: [Vec<String>; 2] = [
        highest.into_iter().chain([String::new()]).collect(),
        hardest.into_iter().chain([elsewhere]).collect(),
    ];
    let [mut above, mut below] = [String::new(), String::new()];
    for (column, (a, b)) in rows[0].iter().zip(&rows[1]).enumerate() {
        let gap = if column == 0 { 0 } else { 2 };
        let start = above.width().max(below.width()) + gap;
        let fits = start + a.width().max(b.width()) <= room;
        for (line, text) in [(&mut above, a), (&mut below, b)] {
            if fits && !text.is_empty() {
                *line += &" ".repeat(start - line.width());
                *line += text;
            }
        }
    }
    [above, below]
}

/// What a pass stands on, or how much faster the tires may leave; and what one dud does.
fn margin(app: &App, judged: &Judgement) -> (&'static str, Vec<String>) {
    let assumptions = app.assumptions.get(app.selected).and_then(Option::as_deref);
    let passes = judged.verdict() == Verdict::Pass;
    let dud = judged.one_dud.filter(|_| judged.checked.verdict == Verdict::Pass);
    let dud = dud.map(|dud| one_dud_in_brief(&dud));
    if let Some(found) = assumptions.filter(|_| passes) {
        let nearest = assumption_words::nearest(found);
        let parts = match (found.pass_as_stated(), nearest.is_empty()) {
            (false, _) => {
                vec![format!("not with all as stated: {} of {} fail", found.failing, found.samples)]
            }
            (true, true) => vec!["at every value tried of what it stands on".to_owned()],
            (true, false) => nearest.into_iter().map(|happens| format!("until {happens}")).collect(),
        };
        return ("holds", parts.into_iter().chain(dud).collect());
    }
    if passes {
        // What the planned shot alone leaves would flatter a pass that stands on less.
        return ("holds", [BEING_FOUND.to_owned()].into_iter().chain(dud).collect());
    }
    let launch = judged.launch_margin.and_then(|margin| match margin {
        LaunchMargin::NotPassing => None,
        LaunchMargin::UpTo { rise, above } => {
            let becomes = if above == Verdict::Fail { "fails" } else { "unproven" };
            Some(format!("planned alone: {becomes} if tires leave {} faster", units::percent(rise + 0.01, 0)))
        }
        LaunchMargin::BeyondTried => Some("planned alone: passes at twice the launch speed".to_owned()),
    });
    ("margin", launch.into_iter().chain(dud).collect())
}

/// The input that decides how a shot turns out, and how it is measured on site.
fn depends(app: &App, judged: &Judgement) -> Vec<String> {
    let shares = judged.sampled.known().and_then(|sampled| input_shares(sampled, &app.case.limits));
    let Some(&(input, share)) = shares.as_deref().and_then(<[_]>::first) else { return Vec::new() };
    if share < DECIDES {
        return vec!["on chance differences between holes".to_owned()];
    }
    let fit = format!("({} Fit)", app.keymap.first_key(Action::Show(Screen::Studies)));
    let (name, measure) = match input {
        Input::LaunchCommon => ("launch speed", format!("film a shot {fit}")),
        Input::LaunchBetweenShots => ("launch from shot to shot", format!("film five shots {fit}")),
        Input::Friction => ("friction", "drag a tire with a spring scale".to_owned()),
        Input::Slack => ("slack", "measure laid cables".to_owned()),
        Input::AxialStiffness => ("rope stiffness", "pull test, or ask its maker".to_owned()),
        Input::MassExponent => ("tire mass", "launch tires of other mass".to_owned()),
        Input::CommonSlopeX | Input::CommonSlopeY => ("tilt of launches", "film from two sides".to_owned()),
        Input::OffsetX | Input::OffsetY => ("offset of the shelter", "measure two corners".to_owned()),
        Input::Duds => ("duds", "test every detonator".to_owned()),
    };
    vec![format!("on {name} ({} of the scatter)", units::percent(share, 0)), format!(": {measure}")]
}

/// What to do now.
fn next(app: &App, judged: &Judgement) -> Vec<String> {
    let key = |action| app.keymap.first_key(action);
    let best = app.answer.as_ref().and_then(|(best, _)| *best);
    let text = match judged.verdict() {
        _ if !app.contradiction().is_empty() => {
            let what = if app.is_compared_with_seen() { "contradict" } else { "are not compared with" };
            format!("observations {what} the plan: {} Fit", key(Action::Show(Screen::Studies)))
        }
        _ if app.options[app.selected].is_sampling() => return Vec::new(),
        Verdict::Pass if best.is_none_or(|best| best == app.selected) => {
            let page = key(Action::WritePage);
            let found = app.assumptions.get(app.selected).and_then(Option::as_deref);
            return match found.map(|found| assumption_words::nearest(found).is_empty()) {
                None => {
                    vec!["wait for what it holds until".to_owned(), format!(", then {page}: page to sign")]
                }
                Some(false) => {
                    vec![format!("check on site what it holds until; {page}: page"), " to sign".to_owned()]
                }
                Some(true) => vec![format!("{page}: write the page to sign")],
            };
        }
        Verdict::Pass => {
            let safest = best.map_or("", |best| app.case.plan.delays[best].name.as_str());
            let is_same = best.is_some_and(|best| app.case.shots[best] == app.case.shots[app.selected]);
            let is_alike =
                best.and_then(|best| app.judgement(best)).is_some_and(|best| are_alike(best, judged));
            let what = match (is_same, is_alike) {
                (true, _) => "the same shot is recommended",
                (_, true) => "as safe by its shots, with more spare launch",
                _ => "a safer option passes",
            };
            return vec![what.to_owned(), format!(": {safest}")];
        }
        Verdict::Fail | Verdict::Undecided if app.case.plan.uncertainty.launch_is_estimated() => {
            "film a test tire: no guess passes (shelter launch)".to_owned()
        }
        Verdict::Fail | Verdict::Undecided => {
            let why = key(Action::Why);
            let found = app.studies.remedies(app.selected, &app.compute);
            let first = found.and_then(|found| found.passing().next());
            return match first {
                Some(first) => {
                    vec![
                        format!("{why}: what to change"),
                        format!(", as {}", words(&app.case, &first.change)),
                    ]
                }
                None => vec![format!("{why}: what would make it pass")],
            };
        }
    };
    vec![text]
}
