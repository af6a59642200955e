//! The selected option in whole sentences, as `check` prints them: why it does not pass, its assumptions, the inputs that decide.

use ratatui::text::Line;

use super::compare::TRYING;
use crate::report::words::assumption_words::holds;
use crate::report::words::objections;
use crate::report::words::option_sentences::{
    bands, broken, dud_of, inputs, launch_limit, measure_first, next_tires,
};
use crate::report::words::reasons;
use crate::report::words::warnings;
use crate::study::judge::Judgement;
use crate::study::judge::Reason;
use crate::study::samples::influence::input_shares;
use crate::tui::app::App;
use crate::tui::theme;
use crate::verdict::Verdict;

/// The sentences, most important first.
pub fn sentences(app: &App, judged: &Judgement) -> Vec<Line<'static>> {
    let (case, theme, checked) = (&app.case, app.theme, &judged.checked);
    // While samples come, their number says more than the reason that they are too few.
    let open = app.options[app.selected].is_open_for_now();
    let reasons = judged.reasons().into_iter().filter(|why| !open || matches!(why, Reason::AsPlanned(_)));
    // The check of one dud is still running: it is unknown, not ended early.
    let is_tried =
        |why: &Reason| app.sampling() && matches!(why, Reason::OneDud(_)) && judged.one_dud.is_none();
    let reasons = reasons.filter(|why| !is_tried(why));
    let mut lines: Vec<Line> = reasons
        .map(|why| {
            let sign = theme::label(why.verdict()).chars().next().unwrap_or(' ');
            let text = format!("{sign} {}", reasons::words(case, judged, &why).sentence);
            Line::styled(text, theme.verdict(why.verdict()))
        })
        .collect();
    if !checked.broken.is_empty() {
        lines.push(Line::styled(broken(case.scene(), checked), theme.limit()));
    }
    // Observations of earlier shots may speak against every verdict of the plan.
    let objections = objections::sentences(&app.case, app.standing().compared());
    let passes = app.verdict(app.selected) == Verdict::Pass;
    if let Some(sampled) = judged.sampled.known().filter(|_| passes) {
        let text = format!("✓ {}", reasons::pass(sampled));
        lines.push(Line::styled(text, theme.verdict(Verdict::Pass)));
    }
    lines.splice(
        0..0,
        objections.into_iter().map(|sentence| Line::styled(format!("! {sentence}"), theme.limit())),
    );
    let warnings = warnings::of_option(case, app.selected, judged);
    lines.extend(warnings.into_iter().map(|warning| Line::styled(format!("! {warning}"), theme.caution())));
    let sampled = judged.sampled.known();
    if open {
        let samples = sampled.map_or(0, |sampled| sampled.samples.len());
        let text = format!("{TRYING}: {samples} samples so far, more come");
        lines.push(Line::styled(text, theme.muted()));
    }
    let next_tires = next_tires(case, judged).into_iter();
    lines.extend(next_tires.map(|text| Line::styled(format!("! {text}"), theme.caution())));
    lines.extend(dud_of(case, judged).map(Line::from));
    lines.extend(
        app.stands_on(app.selected).filter(|_| app.is_pass_of_plan(app.selected)).map(holds).map(Line::from),
    );
    let shares = sampled.and_then(|sampled| input_shares(sampled, &case.limits));
    let decided = shares.as_deref().map(|shares| format!("decided by {}", inputs(shares)));
    let measure = shares.as_deref().and_then(measure_first).map(str::to_owned);
    let launch = launch_limit(&case.shots[app.selected], judged);
    let launch = launch.map(|launch| format!("as planned it {launch}"));
    let decided: Vec<String> = launch.into_iter().chain(decided).chain(measure).collect();
    if !decided.is_empty() {
        lines.push(Line::from(decided.join(" · ")));
    }
    lines.extend(sampled.and_then(|sampled| bands(case, sampled)).map(Line::from));
    lines
}
