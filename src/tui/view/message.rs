//! The message above the keys: the latest notice, and the purpose of the line being typed. The badges stay above it.

use ratatui::text::Line;

use super::compare::cut;
use super::report::wrapped;
use crate::plan::keys::delay;
use crate::report::words::assumption_words;
use crate::report::words::headline::unchecked;
use crate::report::words::option_sentences::firing_times;
use crate::tui::app::App;
use crate::tui::observation_line::EXAMPLE_TIRE;
use crate::tui::prompt::Purpose;
use crate::tui::screen::Screen;
use crate::verdict::VerdictWord;

/// Most lines of the message.
const MOST_LINES: usize = 4;
/// Most characters of an option's name or an observation in the message.
const LONGEST_NAME: usize = 60;

/// The lines of the message, each at most `width` wide.
pub fn lines(app: &App, width: u16) -> Vec<Line<'static>> {
    let style = app.theme.limit();
    let asked = app.question_of_estimates();
    let said = app.notice.clone().or_else(|| filter(app).filter(|_| asked.is_none()));
    // A question stays complete. The notice of a key pressed meanwhile stands below it.
    let texts = asked.into_iter().chain(said).chain(purpose_of_line(app));
    let room = usize::from(width).saturating_sub(2);
    let lines = texts.flat_map(|text| wrapped(&text, room)).take(MOST_LINES);
    lines.map(|line| Line::styled(format!(" {line}"), style)).collect()
}

/// Says that a filter hides some options or lines.
fn filter(app: &App) -> Option<String> {
    let (what, filter) = match app.screen {
        Screen::Studies => ("lines", &app.studies.filter),
        _ => ("options", &app.listing.filter),
    };
    (!filter.is_empty()).then(|| format!("only {what} with '{filter}' are shown; Esc shows all"))
}

/// The purpose of the line being typed, if its head does not say everything.
fn purpose_of_line(app: &App) -> Option<String> {
    let name = |option: usize| {
        let name = app.case.plan.delays.get(option).map_or("", |delay| delay.name.as_str());
        cut(name, LONGEST_NAME)
    };
    let option = name(app.selected);
    let Some(prompt) = &app.prompt else {
        let _ = app.editor.typed().filter(|_| app.screen == Screen::Compare)?;
        let what = match app.editor.field().map(|field| field.path.key.name) {
            Some(name) if name == delay::AT_MS.name => "interval between rows, or the time of each row, ms",
            _ => "interval between rows, ms",
        };
        return Some(match &app.editor.problem {
            Some(problem) => problem.clone(),
            None => match app.editor.copied().map(name) {
                Some(copied) => format!("copy of “{copied}”: {what} · Enter takes, Esc drops it"),
                None => format!("“{option}”: {what} · Enter takes it, Esc leaves it"),
            },
        });
    };
    match prompt.purpose {
        Purpose::Fired if app.fired_options(prompt.line.value()).is_empty() => {
            let typed = cut(prompt.line.value(), LONGEST_NAME);
            Some(format!("no option has “{typed}” in its name: choose first which delay was fired"))
        }
        Purpose::Fired => Some("which delay was fired in the shot that was seen?".to_owned()),
        Purpose::PageOf(best) => Some(format!(
            "“{option}” does not pass, “{}” is the recommended one: of which one is the page?",
            name(best)
        )),
        Purpose::Observe(fired) => {
            let tire = app.highest_tire(fired).unwrap_or_else(|| EXAMPLE_TIRE.to_owned());
            Some(format!(
                "seen of “{}”, rows at {}: which tire, how high it rose in m, and give or take, as `{tire} 1.95 0.05`; or a .csv file",
                name(fired),
                app.case.plan.delays.get(fired).map(firing_times).unwrap_or_default()
            ))
        }
        Purpose::Page => {
            // Same word as on the page: an unsaved edit puts the page on hold.
            let (judged, stands_on) = (app.judgement(app.selected), app.stands_on(app.selected));
            let word = app.standing_now().word(judged, app.stands_on_so_far(app.selected));
            let thin = app.thin(app.selected).filter(|_| word == VerdictWord::Thin);
            let why = match thin.map(assumption_words::thin) {
                Some(thin) => format!(": {thin}"),
                None if word == VerdictWord::Hold && app.editor.unsaved() => {
                    ": the plan is not saved".to_owned()
                }
                None => String::new(),
            };
            let is_known = stands_on.is_some() || word != VerdictWord::Pass;
            let word = if is_known { word.for_people() } else { "not decided yet" };
            let may_be_fired = app.standing_now().against_firing(judged, stands_on).is_none();
            let leave = if may_be_fired { unchecked(&app.case) } else { ", NOT to be fired" };
            let old = app.of_old_pages().map(|told| format!(" · {told}")).unwrap_or_default();
            Some(format!("page of “{option}” ({word}{leave}{why}){old}"))
        }
        Purpose::Forget => {
            let last = app.record.last().unwrap_or_default();
            Some(format!("take back “{}”?", cut(&last, LONGEST_NAME)))
        }
        Purpose::Find | Purpose::Palette | Purpose::Export | Purpose::SaveAs => None,
    }
}
