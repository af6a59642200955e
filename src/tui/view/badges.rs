//! The badges on the second line of every screen. A badge stays until its cause is removed.

use ratatui::style::Modifier;
use ratatui::text::{Line, Span};
use unicode_width::UnicodeWidthStr;

use super::compare::has_starred_pass;
use crate::plan::observations::fitted_values;
use crate::report::effects;
use crate::report::words::assumption_words::thin;
use crate::report::words::headline::UNCHECKED;
use crate::report::words::limits::limits_in_short;
use crate::report::words::option_sentences::{self, compute_label, one_dud_in_brief};
use crate::report::words::{plan_warnings, to_be_confirmed, warnings};
use crate::study::as_planned::shot_reason::ShotReason;
use crate::study::eight_ms::WithinEightMs;
use crate::study::judge::Judgement;
use crate::study::observed::contradiction::count_within;
use crate::study::samples::risk_reason::RiskReason;
use crate::study::standing::verdict_word::ThinPass;
use crate::study::standing::{Doubt, Hold};
use crate::study::{Case, FileState};
use crate::tui::app::App;
use crate::tui::keymap::Action;
use crate::tui::screen::Screen;
use crate::tui::theme;
use crate::units::{self, Unit};
use crate::verdict::{Quantity, Verdict};

/// Badge text if observations of earlier shots are compared with the plan and none speaks against it.
const AGREES: &str = "observations agree";
/// The same for a plan that was fitted to the observations, and for a single value.
const FITTED: &str = "fitted to the observations, so they agree";
const ONE_AGREES: &str = "the one value seen agrees: it tells little";

/// Greatest accepted risk that plans usually state.
const USUAL_RISK: f64 = 0.05;

/// The badges, then limits and method if they fit. Does not repeat text that the first line has `said`.
pub fn badge_line<'a>(app: &'a App, said: &str, width: u16) -> Line<'a> {
    let theme = app.theme;
    let badges = fitting(&badges(app, said), width.into());
    let used = badges.iter().map(|badge| badge.0.width()).sum::<usize>();
    let case = &app.case;
    let risk = units::short(case.plan.limits.accepted_risk_percent);
    let limits = format!("limits: {}", limits_in_short(case));
    let all = format!("{limits}, risk {risk} % · {}", compute_label(&app.compute));
    let behind = if badges.is_empty() { "" } else { " · " };
    let mut room = usize::from(width).saturating_sub(used);
    let mut about = String::new();
    let agrees = agreement(app).map(str::to_owned).into_iter();
    // The table of options shows the limits already.
    let limits = [all, limits].into_iter().filter(|_| app.screen != Screen::Compare);
    for texts in [agrees.collect::<Vec<_>>(), limits.collect()] {
        let before = if about.is_empty() { behind } else { " · " };
        if let Some(text) = texts.into_iter().find(|text| before.width() + text.width() <= room) {
            room -= before.width() + text.width();
            about += &format!("{before}{text}");
        }
    }
    // If the first line says that nothing may be fired, this line says why. One loud sign is enough.
    let is_said = app.names_a_forbidden_pass();
    let badge = |(words, forbids)| match forbids {
        true if is_said => Span::styled(words, theme.limit()),
        true => Span::styled(words, theme.limit().add_modifier(Modifier::REVERSED)),
        false => Span::styled(words, theme.caution()),
    };
    Line::from_iter(badges.into_iter().map(badge).chain([Span::styled(about, theme.muted())]))
}

/// How well the observations agree with the plan. `None` if there are no observations, an observation speaks against the plan, or fewer
/// values than usual are as predicted.
fn agreement(app: &App) -> Option<&'static str> {
    let (within, of) = agreeing(app)?;
    match () {
        () if lies_outside(within, of) => None,
        () if !app.case.plan.fitted_from.is_empty() => Some(FITTED),
        () if app.record.is_one_value() => Some(ONE_AGREES),
        () => Some(AGREES),
    }
}

/// Number of observed values that are as predicted, and of all observed values. `None` if an observation speaks against the plan.
fn agreeing(app: &App) -> Option<(usize, usize)> {
    let agrees = !app.record.is_empty() && app.standing().compared().agrees();
    let compared = app.compared_with_observed().filter(|_| agrees)?;
    let seen: Vec<_> = compared.seen.list.iter().copied().zip(compared.predictions.iter().copied()).collect();
    Some(count_within(&seen).unwrap_or_default())
}

/// Whether fewer than the usual 9 of 10 values are as predicted.
fn lies_outside(within: usize, of: usize) -> bool {
    10 * within < 9 * of
}

/// A warning that stays until its cause is removed; wordings from longest to shortest.
struct Badge {
    words: [String; 4],
    /// Whether nothing may be fired while the badge stands.
    forbids: bool,
}

impl Badge {
    fn forbidding(self) -> Self {
        Self { forbids: true, ..self }
    }
}

/// All badges in one line, each with whether it forbids firing. If the line is too long, the last badges are shortened first. Then each
/// badge, from the first on, becomes as long as fits.
fn fitting(badges: &[Badge], width: usize) -> Vec<(String, bool)> {
    let line = |lengths: &[usize]| {
        let words = badges.iter().zip(lengths).enumerate();
        let words = words.map(|(n, (Badge { words, forbids }, &length))| {
            let before = match (n, forbids) {
                (0, _) => "! ",
                (_, false) if !badges[n - 1].forbids => " · ",
                (_, true) | (_, false) => " ",
            };
            let after = if *forbids { " " } else { "" };
            (format!("{before}{}{after}", words[length]), *forbids)
        });
        words.collect::<Vec<_>>()
    };
    let is_wider =
        |line: Vec<(String, bool)>| line.iter().map(|(words, _)| words.width()).sum::<usize>() > width;
    let mut lengths = vec![0; badges.len()];
    for shorter in [1, 2, 3] {
        for n in (0..badges.len()).rev() {
            if is_wider(line(&lengths)) {
                lengths[n] = shorter;
            }
        }
    }
    for n in 0..badges.len() {
        let shortened = lengths[n];
        let fits = (0..shortened).find(|&longer| {
            lengths[n] = longer;
            !is_wider(line(&lengths))
        });
        lengths[n] = fits.unwrap_or(shortened);
    }
    line(&lengths)
}

/// The badges in a fixed order: plans, file, reasons against the verdicts, shots, inputs, and where to read more.
fn badges(app: &App, said: &str) -> Vec<Badge> {
    let (case, judged) = (&app.case, app.judgement(app.selected));
    // The badges on slide and dud are about this option.
    let recommended = app.recommended();
    let about = recommended.unwrap_or(app.selected);
    let badge = |long: &str, short: &str, shortest: &str| Badge {
        words: [long, short, short, shortest].map(str::to_owned),
        forbids: false,
    };
    let mut badges = Vec::new();
    if app.beside.is_some() {
        let key = app.keymap.first_key(Action::Differences);
        let differ = match app.differences.len() {
            1 => "1 value differs".to_owned(),
            count => format!("{count} values differ"),
        };
        let files = app.plans().iter().map(|app| app.file_of_letter()).collect::<Vec<_>>().join(", ");
        let named = format!("{files} ({key})");
        badges.push(badge(&format!("{files}: {differ} ({key})"), &named, &named));
        let verdicts = match &app.verdicts_that_differ()[..] {
            [] => None,
            [only] => Some(only.clone()),
            [first, others @ ..] => Some(format!("{first}, {} more", others.len())),
        };
        badges.extend(verdicts.map(|verdicts| badge(&verdicts, &verdicts, "verdicts differ")));
    }
    if case.plan.is_example() {
        // The first line may say it already.
        let long = match (case.plan.is_titled_example(), app.names_a_forbidden_pass()) {
            (false, _) => "EXAMPLE by its values",
            (true, true) => "EXAMPLE, not your site",
            (true, false) => "EXAMPLE, not to be fired",
        };
        badges.push(badge(long, long, "EXAMPLE").forbidding());
    }
    if let Some(told) = app.of_old_pages() {
        let short = "do not fire by the page written before";
        let words = [told.clone(), told, short.to_owned(), "OLD PAGE".to_owned()];
        badges.push(Badge { words, forbids: true });
    }
    if case.limits.accepted_risk > USUAL_RISK {
        let risk = format!("1 in {} shots may fail by this plan", units::one_in(case.limits.accepted_risk));
        let risk = badge(&risk, &risk, &risk);
        badges.push(if app.standing().has(Doubt::AcceptsTooMuch) { risk.forbidding() } else { risk });
    }
    if let Some(unusual) = case.plan.unusual().first() {
        let (key, value) = (unusual.key.name, units::short(unusual.value));
        let slip = format!("{key} {value}: a slip");
        badges.push(badge(&format!("{slip} of the pen?"), &format!("{slip}?"), &format!("{key}?")));
    }
    match app.file {
        FileState::AsJudged | FileState::Pipe => {}
        FileState::Changed => {
            badges.push(
                badge("the plan's file says something else", "file changed", "file changed").forbidding(),
            );
        }
        FileState::Gone => {
            badges.push(badge("the plan's file is gone", "file gone", "file gone").forbidding())
        }
    }
    if let Some(left) = &app.left_file {
        let long = format!("{left} says something else: another program changed it");
        badges.push(badge(&long, &format!("{left} differs"), "two plans"));
    }
    let standing = app.standing();
    if standing.has(Doubt::Hold(Hold::Contradicted)) {
        badges.push(badge("observations contradict this plan", "contradicted", "contradicted").forbidding());
    } else if standing.has(Doubt::Hold(Hold::NotCompared)) {
        badges.push(
            badge("observations are not compared with this plan", "not compared", "not compared")
                .forbidding(),
        );
    }
    if let Some((within, of)) = agreeing(app).filter(|(within, of)| lies_outside(*within, *of)) {
        let fit = app.keymap.first_key(Action::Show(Screen::Studies));
        let as_predicted = format!("{within} of {of} values seen are as predicted");
        let [long, short] = match of {
            1 => ["the one value seen lies outside what is predicted", "the value seen lies outside"]
                .map(str::to_owned),
            _ => [format!("{as_predicted}, 9 of 10 are usual"), as_predicted],
        };
        badges.push(badge(&format!("{long}: fit ({fit})"), &short, "seen otherwise"));
    }
    if let Some(uncovered) = judged.and_then(uncovered) {
        badges.push(
            badge(&format!("NOT to be fired: {uncovered}"), "holes under no tire", "holes under no tire")
                .forbidding(),
        );
    }
    let is_best = app.thin_answer().is_some_and(|(best, _)| best == app.selected);
    let thin_pass = app.thin(app.selected).map(|pass| (pass, thin(pass)));
    // If the first line says that the answer is thin, a line of the selected option on Compare says why, at every width.
    let is_told = app.screen == Screen::Compare;
    let is_said = |pass: ThinPass, thin: &str| {
        is_best && (said.contains(thin) || is_told && !matches!(pass, ThinPass::OneDud { .. }))
    };
    if let Some((pass, thin)) = thin_pass.filter(|(pass, thin)| !is_said(*pass, thin)) {
        let name = &case.plan.delays[app.selected].name;
        let dud = if matches!(pass, ThinPass::OneDud { .. }) { ": one dud" } else { "" };
        let shortest = format!("{name} THIN{dud}");
        badges.push(badge(&format!("{name} THIN: {thin}"), &format!("{name} THIN: {thin}"), &shortest));
    }
    // The selected option may have the star for turned tires even if the recommended option has none.
    let turned_over =
        |option: usize| Some((option, warnings::turned_over_limit(case, app.judgement(option)?)?));
    if let Some((turned, height)) = [about, app.selected].into_iter().find_map(turned_over) {
        let (height, limit) = (warnings::turned_words(case, height), units::rounded(case.limits.height, 2));
        let (name, one_in) = (&case.plan.delays[turned].name, units::one_in(case.limits.accepted_risk));
        let star = if has_starred_pass(app) { theme::PROVISO } else { "" };
        badges.push(badge(
            &format!("{star}if tires turned, 1 in {one_in} of {name} rises over {height}, limit {limit} m"),
            &format!("{star}if tires turn {height}, limit {limit}"),
            &format!("{star}turned {height}>{limit}"),
        ));
    }
    if case.limits.drift.is_none() {
        let sampled = app.judgement(about).and_then(|judged| judged.sampled.known());
        let far = sampled
            .and_then(|sampled| sampled.deciding_value(Quantity::Drift).zip(Some(sampled.share_above())));
        let far = far.zip(case.plan.delays.get(about));
        // The first line may say it already.
        let named = if said.contains(UNCHECKED) { "slide" } else { UNCHECKED };
        let [mut long, mut short] = [UNCHECKED; 2].map(str::to_owned);
        if let Some(((far, above), delay)) = far {
            let (far, one_in) = (units::significant(far, Unit::Metre, 2), units::one_in(above));
            long = format!("{named}: with {} 1 in {one_in} end beyond {far} m", delay.name);
            short = format!("{named}: {}, 1 in {one_in} > {far} m", delay.name);
        }
        let words = [long, short, UNCHECKED.to_owned(), "no slide limit".to_owned()];
        // The table marks the passes that this badge is about.
        let sign = if has_starred_pass(app) { theme::PROVISO } else { "" };
        let words = words.map(|words| format!("{sign}{words}"));
        badges.push(Badge { words, forbids: false });
    }
    let uncertainty = &case.plan.uncertainty;
    if uncertainty.launch_is_estimated() {
        badges.push(badge(
            "launch estimated: nothing passes before one is filmed",
            "launch estimated",
            "launch estimated",
        ));
    } else if app.editor.launch_is_retyped() {
        let known = units::short(uncertainty.launch_common_percent);
        badges.push(badge(
            &format!("launch speed changed: is it known to {known} % as before?"),
            "launch changed: how sure?",
            "launch changed",
        ));
    }
    if case.plan.takes_launch_as_too_sure() && !standing.has(Doubt::LaunchUnstated) {
        let known = units::short(uncertainty.launch_common_percent);
        let long = format!("launch taken as known to {known} %, surer than any film");
        badges.push(badge(&long, &format!("launch known to {known} %?"), "launch: how sure?"));
    }
    if fitted_values(&case.plan.fitted_from) == 1 {
        badges.push(badge("launches fitted to ONE observation", "fitted to ONE value", "ONE value"));
    }
    if !case.plan.fitted_from.is_empty() && app.record.is_nothing() {
        let long = "fitted to observations that are not beside this plan: not compared";
        badges.push(badge(long, "fitted: not compared here", "not compared"));
    }
    match standing.against_plan() {
        Some(Doubt::LaunchUnstated) => {
            let long = "how well the launch is known is not stated";
            badges.push(badge(long, "launch not stated", "launch not stated").forbidding());
        }
        Some(Doubt::RangeBesidePlan) => {
            let long = "a range of [uncertainty] leaves out the plan's value";
            badges.push(badge(long, "range beside the plan", "range beside").forbidding());
        }
        Some(Doubt::NotOfEarth) => {
            let long = "gravity is not that of the earth";
            badges.push(badge(long, long, "gravity").forbidding());
        }
        Some(Doubt::NoFile) if app.file == FileState::Pipe => {
            badges.push(badge("no file holds this plan", "no file", "no file").forbidding());
        }
        _ => {}
    }
    if uncertainty.assumed {
        badges.push(badge("all inputs assumed", "inputs assumed", "assumed").forbidding());
    } else if uncertainty.incomplete {
        badges.push(badge("some inputs are defaults", "some defaults", "defaults"));
    }
    let dud_of = |option: usize, unnamed: Option<&str>| {
        // The badge of a thin pass, or the first line, says it already.
        let is_thin = matches!(app.thin(option), Some(ThinPass::OneDud { .. }));
        let dud = app.judgement(option)?.one_dud.filter(|dud| dud.not_passing > 0)?;
        if is_thin && (option == app.selected || said.contains(&one_dud_in_brief(&dud))) {
            return None;
        }
        let name = &case.plan.delays.get(option)?.name;
        let short = if dud.failing > 0 { "a dud exceeds a limit" } else { "a dud is open" };
        let named = format!("{name}: {short}");
        let long = format!("{name}: {}", one_dud_in_brief(&dud));
        let [short, shortest] = unnamed.map_or([short, "dud"], |unnamed| [unnamed; 2]);
        let words = [long, named, short.to_owned(), shortest.to_owned()];
        Some(Badge { words, forbids: false })
    };
    badges.extend(dud_of(about, (about != app.selected).then_some("dud")));
    // On Compare a line of the selected option says it already.
    if about != app.selected && app.screen != Screen::Compare && app.verdict(app.selected) != Verdict::Fail {
        badges.extend(dud_of(app.selected, Some("dud in this one")));
    }
    let together = recommended.and_then(|option| together(case, option));
    badges.extend(together.map(|[long, short]| badge(&long, &short, "many holes at once")));
    if recommended.is_some() && app.beside.is_none() && !case.plan.is_example() {
        // Counting reads the whole plan, so it is done only here. The first line may say it already.
        let marked = to_be_confirmed::count_assumed(case);
        let long = if marked == 1 {
            "1 value is assumed".to_owned()
        } else {
            format!("{marked} values are assumed")
        };
        let inputs = if marked == 1 { "input assumed" } else { "inputs assumed" };
        let [short, shortest] = [inputs, "assumed"].map(|words| format!("{marked} {words}"));
        let is_said = said.contains(&format!("{marked} assumed"));
        badges.extend((marked > 0 && !is_said).then(|| badge(&long, &short, &shortest)));
    }
    let lacking = app.studies.effects(&app.compute).map(effects::lacking).unwrap_or_default();
    if !lacking.is_empty() {
        let studies = app.keymap.first_key(Action::Show(Screen::Studies));
        let lacks = format!("required, not in the plan: {}", lacking.join(", "));
        let counted = format!("plan lacks {} ({studies} Effects)", lacking.len());
        badges.push(badge(&format!("{lacks} ({studies} Effects)"), &counted, "plan lacks effects"));
    }
    let of_plan = plan_warnings::of_plan(case).len();
    if of_plan > 0 {
        let plan = app.keymap.first_key(Action::Show(Screen::Plan));
        badges.push(badge(&format!("warnings: {of_plan} ({plan} Plan)"), "warnings: see Plan", "warnings"));
    }
    let of_option = judged.filter(|_| app.screen == Screen::Compare);
    let of_option = of_option.map_or_else(Vec::new, |judged| warnings_of_option(app, judged));
    if let Some(first) = of_option.first() {
        let open = app.keymap.hint(Action::Open);
        let counted = format!("warnings of this option: {} ({open})", of_option.len());
        let long = if of_option.len() == 1 { first.clone() } else { counted.clone() };
        let words = [long, counted, format!("warning: {open}"), "more".to_owned()];
        badges.push(Badge { words, forbids: false });
    }
    badges
}

/// Says how many holes of an option count together for ground vibration, if another option has fewer. The safest option for the shelter may
/// be the worst for the ground.
fn together(case: &Case, option: usize) -> Option<[String; 2]> {
    let holes = |shot| WithinEightMs::of(case, shot).holes;
    let most = holes(case.shots.get(option)?);
    let least = case.shots.iter().map(holes).min()?;
    let name = &case.plan.delays[option].name;
    (most > least).then(|| {
        [
            format!("{name}: {most} holes within 8 ms, of others {least}; ground shock is not judged"),
            format!("{name}: {most} holes within 8 ms"),
        ]
    })
}

/// Says that holes fire under no tire: as laid, after earlier holes moved the tires, or in so many sampled shots that the samples do not
/// pass.
fn uncovered(judged: &Judgement) -> Option<String> {
    let has = |is: fn(&ShotReason) -> bool| judged.checked.reasons.iter().any(is);
    if has(|reason| matches!(reason, ShotReason::UnderNoTire(_))) {
        return Some("holes lie under no tire".to_owned());
    }
    if has(|reason| matches!(reason, ShotReason::TiresMovedAway(_))) {
        return Some("tires leave holes before these fire".to_owned());
    }
    let sampled = judged.sampled.known()?;
    let (uncovered, all) = (sampled.uncovered(), sampled.samples.len());
    let is_open = uncovered > 0 && sampled.reason() == Some(RiskReason::UndecidedSamples);
    is_open.then(|| format!("a hole fires under no tire in {uncovered} of {all} shots"))
}

/// Warnings about the selected option that no other badge gives.
fn warnings_of_option(app: &App, judged: &Judgement) -> Vec<String> {
    let all = warnings::swaps_and_cover(&app.case, app.selected, judged);
    all.chain(option_sentences::next_tires(&app.case, judged)).collect()
}
