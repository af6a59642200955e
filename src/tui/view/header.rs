//! The header: the answer on the first line, and badges of open points on the second.
//!
//! ```text
//!  DO NOT FIRE  42 ms would pass, if your inputs hold      1 of 7 pass
//! ! EXAMPLE, not your site  slide NOT checked: 1 in 100 end beyond 3.14 m · all inputs assumed
//! ```

use itertools::Itertools;
use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::style::{Modifier, Style};
use ratatui::text::{Line, Span};
use unicode_width::UnicodeWidthStr;

use super::badges::badge_line;
use super::compare::{cut, turning};
use crate::report::words::assumption_words::thin as thin_words;
use crate::report::words::headline::{Headline, Recommended, unchecked};
use crate::study::standing::Hold;
use crate::study::standing::verdict_word::ThinPass;
use crate::tui::app::App;
use crate::tui::keymap::Action;
use crate::tui::theme;
use crate::units::{self, Unit, rough_range};
use crate::verdict::{Verdict, VerdictWord};

/// Draws the header.
pub fn draw(app: &App, frame: &mut Frame, area: Rect) {
    let [first, second] = Layout::vertical([Constraint::Length(1); 2]).areas(area);
    let said = draw_answer(app, frame, first);
    // Aligned with the text below.
    let second = Rect { x: second.x + 1, width: second.width.saturating_sub(1), ..second };
    frame.render_widget(badge_line(app, &said, second.width), second);
}

/// Least cells of an answer: room for the letter of a plan, the shortest option name and the condition of its pass.
const LEAST_ANSWER: usize = 42;

/// Draws the answer over the whole line, with the state of all options at the end. Before there is an answer, the filled part of the line
/// shows the progress. Returns the text of the answer.
fn draw_answer(app: &App, frame: &mut Frame, line: Rect) -> String {
    let text = Rect { x: line.x + 1, width: line.width.saturating_sub(2), ..line };
    let room = usize::from(text.width);
    let marks = before_answer(app);
    let mut state = format!("{}{}", app.letter(), summary(app, line.width));
    let passes = app.recommended().filter(|best| app.word(*best) == VerdictWord::Pass);
    // The end of a thin pass is more important than the verdicts on other options.
    let least = match app.thin_answer() {
        Some((option, thin)) => {
            theme::mark(VerdictWord::Thin).width() + 1 + thinly(app, option, thin).width()
        }
        None => LEAST_ANSWER + passes.map_or(0, |_| unchecked(&app.case).width()),
    };
    let before = Line::from(marks.clone()).width() + least;
    if app.answer.is_some() && room <= before + state.width() {
        // The word "final" is more important than text that a badge also gives.
        let short = tallies(app).map(|[.., short, _]| short);
        state = short.filter(|short| before + GAP + short.width() <= room).unwrap_or_default();
    }
    let title = title(app, marks, room.saturating_sub(state.width() + 1));
    let said = title.to_string();
    // The number of options with each verdict is shown only if it shortens the answer by nothing.
    let has_room = |tally: &String| title.width() + GAP + tally.width() <= room;
    if let Some(tally) = tallies(app).into_iter().flatten().find(has_room) {
        state = tally;
    }
    let last = title.spans.last().map(|span| span.style);
    let answer = last.filter(|style| style.add_modifier.contains(Modifier::REVERSED));
    // With two plans, each answer has its own background.
    let filled = answer.filter(|_| app.beside.is_none());
    frame.buffer_mut().set_style(line, filled.unwrap_or_default());
    let [left, right] =
        Layout::horizontal([Constraint::Min(0), Constraint::Length(state.width() as u16)]).areas(text);
    frame.render_widget(Line::styled(state, filled.unwrap_or(app.theme.title())), right);
    frame.render_widget(title, left);
    if answer.is_none() && app.sampling() {
        let done = (app.pace.done() * f64::from(line.width)) as u16;
        frame.buffer_mut().set_style(Rect { width: done, ..line }, app.theme.done());
    }
    said
}

/// Least cells between the answer and the state.
const GAP: usize = 2;

/// Tag before a passing option if nothing may be fired by the plan.
const FORBIDDEN: &str = " DO NOT FIRE ";

/// Tag before an option that may be fired only after its conditions are confirmed.
const CONDITIONAL: &str = " NOT YET ";

/// Tags before the answer: the plan is not saved; nothing may be fired by it, or not yet.
fn before_answer(app: &App) -> Vec<Span<'static>> {
    let unsaved = if app.editor.unsaved() { "*not saved* " } else { "" };
    [Span::styled(unsaved, app.theme.limit())].into_iter().chain(forbidden(app)).chain(held(app)).collect()
}

/// Tag that passes are on hold, while the answer that says so is still computed.
fn held(app: &App) -> Vec<Span<'static>> {
    let is_held = app.answer.is_none() && app.standing().against_passes().is_some();
    let style = app.theme.limit().add_modifier(Modifier::REVERSED);
    if is_held { vec![Span::styled(" HOLD ", style), Span::raw(" ")] } else { Vec::new() }
}

/// Tag, with a space behind it: nothing may be fired by this plan although an option passes or may pass, or firing has conditions.
fn forbidden(app: &App) -> Vec<Span<'static>> {
    let standing = app.standing();
    // This is known before any answer.
    let is_early =
        app.answer.is_none() && standing.against_passes().is_none() && standing.against_plan().is_some();
    match is_early || app.names_a_forbidden_pass() {
        true => {
            let style = app.theme.limit().add_modifier(Modifier::REVERSED);
            vec![Span::styled(FORBIDDEN, style), Span::raw(" ")]
        }
        false if app.names_a_pass_under_condition() => {
            let style = app.theme.caution().add_modifier(Modifier::REVERSED);
            vec![Span::styled(CONDITIONAL, style), Span::raw(" ")]
        }
        false => Vec::new(),
    }
}

/// Sign, verb and style of the first line for a passing option. If the plan forbids firing, the option only "would pass", without a sign or
/// a pass color: the tag before it counts.
fn pass_words(app: &App, word: VerdictWord) -> (String, &'static str, Style) {
    match app.names_a_forbidden_pass() {
        false if word == VerdictWord::Pass && app.names_a_pass_under_condition() => {
            (String::new(), "passes", app.theme.title())
        }
        false => (format!("{} ", theme::mark(word)), "passes", app.theme.verdict(word)),
        true if word == VerdictWord::Pass => (String::new(), "would pass", app.theme.title()),
        true => (String::new(), "would pass", app.theme.verdict(word)),
    }
}

/// The answer behind its `marks`; before there is an answer, the title of the plan and its file.
fn title<'a>(app: &'a App, marks: Vec<Span<'static>>, room: usize) -> Line<'a> {
    let theme = app.theme;
    let mut line = Line::from(marks);
    let room = room.saturating_sub(line.width());
    if let Some(first) = answer(app, &app.letter(), room) {
        let mut left = room.saturating_sub(first.width() + BETWEEN.width());
        line.push_span(first);
        if let Some(app) = app.beside.as_deref() {
            let marks = before_answer(app);
            left = left.saturating_sub(Line::from(marks.clone()).width());
            let other = answer(app, &format!("{} ", app.side.letter()), left);
            if let Some(other) = other.filter(|other| other.width() <= left) {
                line.push_span(Span::styled(BETWEEN, theme.muted()));
                line.extend(marks.into_iter().chain([other]));
            }
        }
        return line;
    }
    let title = format!("{}{}", app.letter(), app.case.title());
    let path = short_path(&app.case.source.name(), room.saturating_sub(title.width() + 2));
    // Two plans with one title differ by their files.
    let title = cut(&title, room.saturating_sub(path.width() + 2));
    line.extend([Span::styled(title, theme.title()), Span::styled(format!("  {path}"), theme.muted())]);
    line
}

/// Title and file of the plan, as much as fits. The first directories of the path are dropped first, then its extension.
pub(super) fn title_and_file(app: &App, room: usize) -> Option<String> {
    let (title, path) = (app.case.title(), app.case.source.name());
    let name = short_path(&path, room);
    let stem = name.strip_suffix(".toml").map(str::to_owned);
    [Some(format!("{title}  {path}")), Some(name), stem]
        .into_iter()
        .flatten()
        .find(|text| text.width() <= room)
}

/// A path in at most `room` cells, without its first directories if necessary. The file name stays complete.
fn short_path(path: &str, room: usize) -> String {
    let ends = path.match_indices(['/', '\\']).map(|(at, _)| format!("…{}", &path[at..]));
    let mut all = [path.to_owned()].into_iter().chain(ends);
    let name = || path.rsplit(['/', '\\']).next().unwrap_or(path).to_owned();
    all.find(|path| path.width() <= room).unwrap_or_else(name)
}

/// Separator between the answers of two plans.
const BETWEEN: &str = " · ";

/// The answer, behind the `letter` of its plan: the passing option and how thin its pass is, or HOLD if observations contradict the plan.
/// If the whole sentence does not fit, its first clause.
fn answer(app: &App, letter: &str, room: usize) -> Option<Span<'static>> {
    let theme = app.theme;
    if let Some((option, thin_pass)) = app.thin_answer() {
        let thin = thin_words(thin_pass);
        let name = &app.case.plan.delays[option].name;
        let (sign, passes, style) = pass_words(app, VerdictWord::Thin);
        let unchecked = unchecked(&app.case);
        let texts = [
            format!("{sign}{letter}{name} {passes}{unchecked}, but thinly: {thin}"),
            format!("{sign}{letter}{name} {passes}, but thinly: {thin}"),
            format!("{sign}{letter}{}", thinly(app, option, thin_pass)),
            format!("{sign}{letter}{name} {passes}, but thinly"),
            format!("{sign}{letter}{name}, thinly"),
        ];
        // The name is cut before the word: a thin pass must not read as a full pass.
        let [.., shortest] = &texts;
        let beside = shortest.width() - name.width();
        let cut =
            || format!("{sign}{letter}{}, thinly", cut(name, room.saturating_sub(beside).max(LEAST_NAME)));
        let text = texts.iter().find(|text| text.width() <= room).cloned().unwrap_or_else(cut);
        return Some(banner(app, text, style));
    }
    let Some(found) = app.answer.as_ref() else {
        return so_far(app, letter, room).map(|text| Span::styled(text, theme.title()));
    };
    let held = app.standing().against_passes().map(|hold| match hold {
        Hold::FileChanged => "the file of the plan is not what was judged",
        Hold::Contradicted | Hold::NotCompared => "fire nothing before observations and plan agree",
    });
    if let Some(why) = held {
        return Some(banner(app, first_clauses(format!("! {letter}HOLD: {why}"), room), theme.limit()));
    }
    let (text, style) = match found {
        Headline::Recommends(best) if app.word(best.option) == VerdictWord::Hold => {
            let held = format!("! {letter}HOLD: other draws of {} fail more often than accepted", best.name);
            (first_clauses(held, room), theme.limit())
        }
        // While it is not known whether a pass is thin, it may be thin.
        Headline::Recommends(best) if app.stands_on_so_far(best.option).is_none() => {
            return Some(Span::styled(not_final(&best.name, letter, room), theme.title()));
        }
        Headline::Recommends(best) => {
            let (sign, passes, style) = pass_words(app, VerdictWord::Pass);
            (passing(best, &format!("{sign}{letter}"), passes, room), style)
        }
        Headline::Nothing(why) => {
            let (why, style) = fails(app, &format!("{letter}{why}"));
            (first_clauses(why, room), style)
        }
    };
    Some(banner(app, text, style))
}

/// Says in few words that an option passes thinly and what ends its pass.
fn thinly(app: &App, option: usize, thin: ThinPass) -> String {
    format!("{}, thinly: {}", app.case.plan.delays[option].name, thin_words(thin))
}

/// Why no option is recommended, with a sign and advice.
fn fails(app: &App, why: &str) -> (String, Style) {
    let fails = app.theme.verdict(Verdict::Fail);
    if (0..app.options.len()).any(|option| app.verdict(option) == Verdict::Pass) {
        (format!("! {why}"), app.theme.limit())
    } else if app.case.plan.uncertainty.launch_is_estimated() {
        (format!("✗ {why}: the launch is a guess, film one (shelter launch)"), fails)
    } else {
        (format!("✗ {why}: {} tells what would make one pass", app.keymap.first_key(Action::Why)), fails)
    }
}

/// Least cells of a shortened name.
const LEAST_NAME: usize = 8;

/// The style of an answer. A final answer is reversed, so that it stands out, unless a tag forbids firing or sets a condition.
fn banner(app: &App, text: String, style: Style) -> Span<'static> {
    let is_tagged = app.names_a_forbidden_pass() || app.names_a_pass_under_condition();
    let filled = if is_tagged || !app.is_final() { Modifier::empty() } else { Modifier::REVERSED };
    Span::styled(text, style.add_modifier(filled))
}

/// Says that an option leads and that the assumptions of its pass are still tried. The longest wording that fits.
fn not_final(name: &str, letter: &str, room: usize) -> String {
    let words = ["; what it stands on is being tried", "; what it stands on: being tried", ", more is tried"];
    let mut texts = words.iter().map(|words| format!("… {letter}{name} leads{words}"));
    // The name is cut before the words: no pass must read as final.
    let short = |name: &str| format!("… {letter}{name}: not final");
    let cut = || short(&cut(name, room.saturating_sub(short("").width()).max(LEAST_NAME)));
    texts.find(|text| text.width() <= room).unwrap_or_else(cut)
}

/// Says that an option `passes`, behind its `sign`. If the whole text does not fit, the risk and the ranking are dropped first, the assumed
/// inputs after them. The name is cut last, after text that a badge also gives.
fn passing(best: &Recommended, sign: &str, passes: &str, room: usize) -> String {
    let Recommended { name, unchecked, among, inputs_hold, assumed, one_in, .. } = best;
    let passing = |name: &str, what: &str| format!("{sign}{name} {passes}{what}");
    let texts = [
        format!("{unchecked}{among}: {inputs_hold}, fewer than 1 in {one_in} shots exceed a limit"),
        format!("{unchecked}{among}, {inputs_hold}"),
        format!("{unchecked}, {inputs_hold}"),
        match assumed {
            0 => String::new(),
            1 => format!("{unchecked}, if 1 assumed input holds"),
            _ => format!("{unchecked}, if {assumed} assumed inputs hold"),
        },
        // A badge also gives the number of assumed inputs.
        format!("{unchecked}, if your inputs hold"),
        ", if your inputs hold".to_owned(),
    ];
    let fits = |text: &String| text.width() <= room;
    let whole = texts.iter().filter(|what| !what.is_empty()).map(|what| passing(name, what)).find(fits);
    let [.., shortest] = &texts;
    let room = room.saturating_sub(passing("", shortest).width()).max(LEAST_NAME);
    whole.unwrap_or_else(|| passing(&cut(name, room), shortest))
}

/// The text before its last colon, and the part of this text before its last comma.
fn clauses(text: &str) -> [&str; 2] {
    let clause = text.rsplit_once(": ").map_or(text, |(clause, _)| clause);
    [clause, clause.rsplit_once(", ").map_or(clause, |(first, _)| first)]
}

/// The whole text if it fits, else the part before its last colon, or before the last comma of that part.
fn first_clauses(text: String, room: usize) -> String {
    let fits = |text: &str| text.width() <= room;
    let [clause, first] = clauses(&text);
    [&text, clause, first].into_iter().find(|text| fits(text)).unwrap_or(first).to_owned()
}

/// Progress and findings while shots are sampled; no answer yet. The longest wording that fits. `None` before sampling, when the title of
/// the plan stands here, and once all options are judged.
fn so_far(app: &App, letter: &str, room: usize) -> Option<String> {
    if app.checking() || !app.sampling() {
        return None;
    }
    let judged = app.options.iter().filter(|state| state.is_decided()).count();
    let judged = format!("{judged} of {} judged", app.options.len());
    let timed = format!("{judged}{}", time_left(app));
    let ahead = app.ahead().and_then(|option| {
        let sampled = app.judgement(option)?.sampled.known()?;
        Some((&app.case.plan.delays[option].name, &sampled.bounds))
    });
    let texts = match ahead {
        Some((name, bounds)) => {
            let failed = format!("{} of {} computed shots fail", bounds.failures, bounds.samples);
            vec![
                format!("{timed}: {name} is ahead so far, {failed}"),
                format!("{timed}: {name} is ahead so far"),
                format!("{timed}: {name} ahead"),
                format!("{judged}: {name} ahead"),
                judged,
            ]
        }
        None => {
            let tried = app.shots_tried();
            vec![
                format!("{timed}: {tried} possible shots tried"),
                format!("{timed}: {tried} tried"),
                timed,
                judged,
            ]
        }
    };
    let mut texts = texts.into_iter().map(|text| format!("… {letter}{text}"));
    let last = texts.next_back();
    texts.find(|text| text.width() <= room).or(last)
}

/// Time left until all options are judged, as text to append; empty while it is unknown.
fn time_left(app: &App) -> String {
    let left = app.pace.left().map(|left| rough_range(left.as_secs_f64().max(1.0)));
    left.map_or_else(String::new, |[_, most]| format!(", up to ~{most} more"))
}

/// Least width of a screen that shows the rate of shots.
const WITH_RATE: u16 = 100;

/// State of the whole plan: options whose planned shot is judged, the rate of shots, or how many options pass.
fn summary(app: &App, width: u16) -> String {
    let all = app.options.len();
    if app.checking() {
        let checked = app.options.iter().filter(|state| !state.is_computing()).count();
        return format!("computing {checked}/{all}{}", time_left(app));
    }
    if app.sampling() {
        let rate = app.pace.rate().filter(|_| width >= WITH_RATE);
        // The first line says how many options are judged.
        return rate.map_or_else(String::new, |rate| {
            format!("{} shots a second {}", units::significant(rate, Unit::One, 3), turning(app.beat))
        });
    }
    let held = if app.standing().against_passes().is_none() { "" } else { ", HOLD" };
    format!("{}{}{held}", pass_count(app), so_far_if_unknown(app))
}

/// Number of options with each verdict once all are judged, in words and with marks, and whether that is final. `None` if passes do not
/// stand.
fn tallies(app: &App) -> Option<[String; 4]> {
    let words = VerdictWord::ALL.map(|word| (count(app, word), word));
    let told = || words.iter().filter(|(count, _)| *count > 0);
    let is_held = count(app, VerdictWord::Hold) > 0 || app.standing().against_passes().is_some();
    let is_told =
        !is_held && told().count() > 0 && !app.checking() && !app.sampling() && app.beside.is_none();
    is_told.then(|| {
        let so_far = so_far_if_unknown(app);
        let mut words = told().map(|(count, word)| format!("{count} {}", word.for_people())).join(" · ");
        let mut marks = told().map(|(count, word)| format!("{count}{}", theme::mark(*word))).join(" ");
        if told().count() == 1 {
            words = pass_count(app);
            marks.clone_from(&words);
        }
        let marks_alone = format!("{marks}{so_far}");
        match so_far {
            "" if app.is_final() => {
                [format!("final: {words}"), format!("final: {marks}"), "final".to_owned(), marks_alone]
            }
            "" => [words, marks, marks_alone.clone(), marks_alone],
            _ => [format!("{words}{so_far}"), marks_alone.clone(), marks_alone, so_far.trim().to_owned()],
        }
    })
}

/// Number of options that pass, fully or thinly, of all options.
fn pass_count(app: &App) -> String {
    let all = app.options.len();
    match [VerdictWord::Pass, VerdictWord::Thin].map(|word| count(app, word)) {
        [passing, 0] => format!("{passing} of {all} pass"),
        [0, thin] => format!("{thin} of {all} pass thinly"),
        [passing, thin] => format!("{} of {all} pass, {thin} thinly", passing + thin),
    }
}

fn count(app: &App, word: VerdictWord) -> usize {
    // While it is not known whether a pass is thin, it does not count as a pass.
    let is_known = |option: usize| word != VerdictWord::Pass || app.stands_on_so_far(option).is_some();
    (0..app.options.len()).filter(|&option| app.word(option) == word && is_known(option)).count()
}

/// " so far" while it is not known of some pass whether it is thin.
fn so_far_if_unknown(app: &App) -> &'static str {
    let is_known = |option| app.stands_on_so_far(option).is_some() || app.word(option) != VerdictWord::Pass;
    if (0..app.options.len()).all(is_known) { "" } else { " so far" }
}
