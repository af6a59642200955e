//! Advice on the selected option: the input to measure better, and the next step.

use itertools::Itertools;
use unicode_width::UnicodeWidthStr;

use super::compare::cut;
use super::fitting::fitting;
use crate::report::remedies::{thinly, words};
use crate::report::words::assumption_words;
use crate::report::words::option_sentences::DECIDES;
use crate::report::words::to_be_confirmed::{About, count_assumed};
use crate::study::judge::Judgement;
use crate::study::judge::recommend::{Lead, are_alike};
use crate::study::samples::influence::input_shares;
use crate::study::samples::random_shot::Input;
use crate::study::standing::{Doubt, Hold};
use crate::tui::app::App;
use crate::tui::keymap::Action;
use crate::tui::screen::Screen;
use crate::units;
use crate::verdict::Verdict;

/// Label of the line with the points to tick.
pub const NOT_YET: &str = "not yet";
/// Most cells of the name of another option.
const LONGEST_NAME: usize = 26;

/// The input with the greatest influence on the shots, and how to measure it on site.
pub fn depends(app: &App, judged: &Judgement) -> Vec<String> {
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

/// The next step with the label of its line. If the option may be fired only after points are ticked, these points.
pub fn next(app: &App, judged: &Judgement, room: usize) -> (&'static str, Vec<String>) {
    match to_be_ticked(app, judged) {
        Some((ticks, page)) => (NOT_YET, ticked(&ticks, &page, room)),
        None => ("next", vec![fitting(next_words(app, judged), "", room)]),
    }
}

/// The open points before the option may be fired, and the key of the page; each in a long and a short wording. `None` if another step
/// comes first.
fn to_be_ticked(app: &App, judged: &Judgement) -> Option<(Vec<[String; 2]>, [String; 2])> {
    let is_first = app.recommended().is_none_or(|best| best == app.selected);
    let passes = judged.verdict() == Verdict::Pass && !app.options[app.selected].is_sampling();
    let is_permitted = app.standing().against_firing(Some(judged), app.stands_on(app.selected)).is_none();
    if !(is_first && passes && is_permitted) || app.editor.unsaved() {
        return None;
    }
    let boxes = app.to_be_confirmed(app.selected);
    if boxes.is_empty() {
        return None;
    }
    let key = |action| app.keymap.first_key(action);
    let (fit, plan) = (key(Action::Show(Screen::Studies)), key(Action::Show(Screen::Plan)));
    let count = |about| boxes.iter().filter(|line| line.about == about).count();
    // Long and short wording. All points together are as many as the boxes of the page.
    let ticks =
        [About::Film, About::OtherBlasts, About::AssumedValue, About::Slide, About::Turning, About::More];
    let tick = |about: About| {
        let told = match (about, count(about)) {
            (_, 0) => return None,
            (About::Film, count) => {
                let many = if count > 1 { format!("{count}: ") } else { String::new() };
                let (text, keys) = match app.has_estimates() {
                    true => {
                        ("put the film into the plan", format!("{fit} Fit, {}", key(Action::UseEstimates)))
                    }
                    false => ("fit a film", format!("{fit} Fit")),
                };
                [format!("{many}{text} ({keys})"), format!("{many}film ({keys})")]
            }
            (About::OtherBlasts, _) => ["films of another blast beside", "films beside"].map(str::to_owned),
            // A film would also give a launch, which the first line counts as an assumed value.
            (About::AssumedValue, count) if count < count_assumed(&app.case) => {
                [format!("{count} more assumed values ({plan} Plan)"), format!("{count} more assumed")]
            }
            (About::AssumedValue, 1) => [format!("1 assumed value ({plan} Plan)"), "1 assumed".to_owned()],
            (About::AssumedValue, count) => {
                [format!("{count} assumed values ({plan} Plan)"), format!("{count} assumed")]
            }
            (About::Slide, _) => [format!("limit the slide ({plan} Plan)"), "slide".to_owned()],
            (About::Turning, _) => ["tires that turn", "turning"].map(str::to_owned),
            (About::More, count) => [format!("{count} more on the page"), format!("{count} more")],
        };
        Some(told)
    };
    let page = key(Action::WritePage);
    let boxes = boxes.len();
    let page = [format!("{page}: page with {boxes} to tick"), format!("{page}: {boxes} to tick")];
    Some((ticks.into_iter().filter_map(tick).collect(), page))
}

/// All points and the page in one line, in long or short wording; otherwise in several lines. No point is left out.
fn ticked(ticks: &[[String; 2]], page: &[String; 2], room: usize) -> Vec<String> {
    let parts = |words: usize| {
        let ticks = ticks.iter().map(move |tick| format!("☐ {}", tick[words]));
        ticks.chain([format!("· {}", page[words])])
    };
    let mut lines = [0, 1].map(|words| parts(words).join(" ")).into_iter();
    match lines.find(|line| line.width() <= room) {
        Some(line) => vec![line],
        None => parts(1).fold(Vec::new(), |mut lines: Vec<String>, part| {
            match lines.last_mut().filter(|line| line.width() + 1 + part.width() <= room) {
                Some(line) => *line += &format!(" {part}"),
                None => lines.push(part),
            }
            lines
        }),
    }
}

/// The next step, in parts of a sentence.
fn next_words(app: &App, judged: &Judgement) -> Vec<String> {
    let key = |action| app.keymap.first_key(action);
    let best = app.recommended();
    let fit = key(Action::Show(Screen::Studies));
    let held = app.standing().against_passes().map(|hold| match hold {
        Hold::FileChanged => "look at the file of the plan: another program has changed it".to_owned(),
        Hold::Contradicted => format!("observations contradict the plan: {fit} Fit"),
        Hold::NotCompared => format!("observations are not compared with the plan: {fit} Fit"),
    });
    if let Some(held) = held {
        return vec![held];
    }
    let text = match judged.verdict() {
        _ if app.options[app.selected].is_sampling() => return Vec::new(),
        Verdict::Pass if best.is_none_or(|best| best == app.selected) => {
            let page = key(Action::WritePage);
            let stands_on = app.stands_on(app.selected);
            let needed = match app.standing().against_firing(Some(judged), stands_on) {
                Some(Doubt::StandsOnUnknown) => {
                    return vec![
                        "wait for what it holds until".to_owned(),
                        format!(", then {page}: page to sign"),
                    ];
                }
                None if app.editor.unsaved() => {
                    return vec![
                        format!("save ({})", key(Action::Save)),
                        format!(", then {page}: page to sign"),
                    ];
                }
                None => {
                    let page = format!("{page}: page to sign");
                    if app.has_estimates() {
                        let take = key(Action::UseEstimates);
                        return vec![
                            format!("put the film into the plan ({fit} Fit, {take})"),
                            format!("; {page}"),
                        ];
                    }
                    return vec![page, "; fire only once it is signed".to_owned()];
                }
                Some(Doubt::Example) => {
                    format!("press {}: put in your own site", key(Action::Show(Screen::Plan)))
                }
                Some(Doubt::RangeBesidePlan) => {
                    "let the ranges of [uncertainty] hold the plan's values".to_owned()
                }
                Some(Doubt::NotOfEarth) => "let gravity_m_s2 be that of the earth".to_owned(),
                Some(Doubt::AcceptsTooMuch) => "accept fewer failures: accepted_risk_percent".to_owned(),
                Some(Doubt::LaunchUnstated) => {
                    "say how well the launch is known: launch_common_percent".to_owned()
                }
                Some(Doubt::NoUncertainty) => "write [uncertainty] into the plan".to_owned(),
                Some(Doubt::NoFile) => {
                    format!("save the plan ({}): no file holds it", key(Action::Save))
                }
                Some(Doubt::FixedStep) => format!("judge without a fixed step ({})", key(Action::Finer)),
                Some(Doubt::OtherDrawsFail) => "leave more room: other draws fail".to_owned(),
                Some(Doubt::PlannedAlone) => "judge the shots that are possible, too".to_owned(),
                Some(Doubt::Hold(_) | Doubt::NoPass) => return Vec::new(),
            };
            return vec![needed, format!("; {page}: page, not to be fired")];
        }
        Verdict::Pass => {
            let safest = best.map_or("", |best| app.case.plan.delays[best].name.as_str());
            let is_same = best.is_some_and(|best| app.case.shots[best] == app.case.shots[app.selected]);
            let of_best = best.and_then(|best| app.judgement(best));
            let is_alike = of_best.is_some_and(|best| are_alike(best, judged));
            let duration = |option: usize| app.case.shots[option].duration();
            let lead = best.zip(of_best).and_then(|(best, of_best)| {
                Lead::of(&app.case, (of_best, duration(best)), &[(judged, duration(app.selected))])
            });
            let why_first = match lead {
                Some(Lead::Failures) => "whose shots fail less",
                Some(Lead::Dud) => "which bears one dud",
                Some(Lead::Room) => "which keeps farther from its limits",
                Some(Lead::Launches) => "which as planned bears faster launches",
                Some(Lead::Duration) => "the shorter one",
                None => "",
            };
            // Surely safer by its shots. Otherwise another option may be recommended only because the selected option is thin.
            let is_safer = !is_alike && lead == Some(Lead::Failures);
            return match (is_same, is_safer) {
                (true, _) => vec!["it is the same shot".to_owned(), format!(" as {safest}")],
                // The name tells that this is not about the selected option. How thin that pass is may favor the selected option.
                (_, false) => {
                    let thin = best.and_then(|best| app.thin(best)).map(assumption_words::thin);
                    let (thinly, why) = match thin {
                        None => ("", why_first.to_owned()),
                        Some(thin) => (", but thinly", thin),
                    };
                    let safest = cut(safest, LONGEST_NAME);
                    let why = if why.is_empty() { why } else { format!(", {why}") };
                    // Some plans permit no firing. Then nothing is recommended.
                    let first =
                        if app.names_a_forbidden_pass() { "would be recommended" } else { "recommended" };
                    vec![format!("{first}{thinly}: {safest}"), why]
                }
                _ => vec!["a safer option passes".to_owned(), format!(": {safest}")],
            };
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
                        format!(", as {}{}", words(&app.case, &first.change), thinly(first)),
                    ]
                }
                None => vec![format!("{why}: what would make it pass")],
            };
        }
    };
    vec![text]
}
