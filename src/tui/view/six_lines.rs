//! The selected option in a few short lines. Each line has a label and a fixed place; the limiting quantity and the next step stand out. A
//! line without news is left out.
//!
//! ```text
//!  fails    0 of 500 computed shots fail: under 1 in 100 if your inputs hold
//!  limited  by height, 95 %: 2.23 of 2.35 m   planned 1.67 at 1:1
//!  then     by force, 92 %: 77.1 of 84.0 kN   in 2:1-3:1  planned 53.0
//!  holds    until all launches tilt by 2.6° (assumed 1°)
//!  one dud  within limits as planned at all 15 holes; varied at most 2.71 % fail
//!  depends  on launch speed (60 % of the scatter): film a shot (4 Fit)
//!  next     P: page to sign
//!  cables   4 above 80 % of the limit, none past it
//!           2:1-3:1  77.1 kN   92 % ▆▆▆▆▆▆▆▆  ┃
//! ```

use std::iter::repeat;

use itertools::Itertools;
use ratatui::style::Style;
use ratatui::text::{Line, Span};
use unicode_width::UnicodeWidthStr;

use super::columns::share_of_limit;
use super::compare::verdict_words;
use super::fitting::{filled, fitting, whole_first};
use super::from_above::NEAR_LIMIT;
use super::gauges;
use super::next_step::{NOT_YET, depends, next};
use super::widgets::bar;
use crate::report::sweep::nearer_than_recommended;
use crate::report::words::assumption_words;
use crate::report::words::option_sentences::one_dud_in_brief;
use crate::report::words::reasons::{self, ReasonWords};
use crate::report::words::warnings;
use crate::sorting::sort_by;
use crate::study::assumptions::Assumptions;
use crate::study::judge::Judgement;
use crate::study::judge::Reason;
use crate::study::samples::sampled_shot::SampledShot;
use crate::study::standing::verdict_word::ThinPass;
use crate::tui::app::App;
use crate::tui::keymap::Action;
use crate::units::{self, Unit};
use crate::verdict::{Quantity, Verdict, VerdictWord};

/// Labels that stand out. `DUD`: label of the line about a dud.
const STRONG: [&str; 3] = ["limited", "next", NOT_YET];
const DUD: &str = "one dud";
/// Width of a label with its spaces.
const LABEL: usize = 10;
/// Significant digits.
const DIGITS: i32 = 3;
/// Most cables listed.
const CABLES: usize = 10;
/// Most cables that are named for strengthening. `GAUGE`: width of a cable's gauge.
const STRENGTHENED: usize = 3;
const GAUGE: usize = 13;
/// Width of the progress bar of the search for the assumptions of a pass.
const BAR: usize = 12;

/// A line before the rows are counted.
struct Said {
    /// Lines with a greater rank are dropped first if there are too few rows.
    rank: u8,
    label: &'static str,
    text: String,
    style: Style,
}

/// Ranks of the lines. Lines about the present verdict and the next step are dropped last.
const FAILS: u8 = 0;
const LIMITED: u8 = 1;
const NEXT: u8 = 2;
const HOLDS: u8 = 3;
const THEN: u8 = 4;
/// A badge says it, too.
const TURNED: u8 = 5;
const HOLDS_TOO: u8 = 6;
const DEPENDS: u8 = 7;
const STRENGTHEN: u8 = 8;

/// The lines of the selected option, none wider than `width`, at most `rows`. The least important lines are dropped. Rows that are left
/// show the cables that are pulled hardest.
pub fn six_lines(app: &App, judged: &Judgement, width: u16, rows: usize) -> Vec<Line<'static>> {
    let room = usize::from(width).saturating_sub(LABEL);
    let mut lines = said(app, judged, room);
    let mut is_cut = false;
    while lines.len() > rows {
        let ranked = lines.iter().enumerate();
        let Some(last) = ranked.max_by_key(|(n, said)| (said.rank, *n)).map(|(n, _)| n) else { break };
        is_cut |= lines.remove(last).rank == HOLDS_TOO;
    }
    // If a line about a further end of the pass was dropped, the last kept line says that there is more.
    let of_holds = |said: &&mut Said| said.rank == HOLDS_TOO || ["holds", "thin"].contains(&said.label);
    if let Some(holds) = lines.iter_mut().rfind(of_holds).filter(|_| is_cut) {
        let more = format!(", and more: {}", app.keymap.hint(Action::Open));
        let fits = |more: &&str| holds.text.width() + more.width() <= room;
        let more = [more.as_str(), ", and more", " …"].into_iter().find(fits);
        holds.text += more.unwrap_or_default();
    }
    let left = rows - lines.len();
    let lines = lines.into_iter().map(|said| said.line(app));
    lines.chain(cables(app, judged, left)).collect()
}

/// Why the selected option does not pass: what fails, and the limits; at most `most` lines.
pub fn why(app: &App, judged: &Judgement, width: u16, most: usize) -> Vec<Line<'static>> {
    let lines = said(app, judged, usize::from(width).saturating_sub(LABEL)).into_iter();
    let of_limits = lines.filter(|said| [FAILS, LIMITED, THEN].contains(&said.rank));
    of_limits.take(most).map(|said| said.line(app)).collect()
}

/// All lines of the selected option.
fn said(app: &App, judged: &Judgement, room: usize) -> Vec<Said> {
    let (plain, strong) = (app.theme.base(), app.theme.title());
    let (_, colour) = verdict_words(app, app.selected);
    let said = |rank, label, text, style| Said { rank, label, text, style };
    let labelled = |label| [label].into_iter().chain(repeat(""));
    let fails = whole_first(fails(app, judged, room), " · ", room);
    let mut lines: Vec<Said> =
        labelled("fails").zip(fails).map(|(label, text)| said(FAILS, label, text, colour)).collect();
    lines.extend(limits(app, judged, room));
    let turned = warnings::turned_over_limit(&app.case, judged).map(|height| {
        let limit = units::significant(app.case.limits.height, Unit::Metre, DIGITS);
        let height = warnings::turned_words(&app.case, height);
        fitting(vec![format!("if tires turned they rose over {height}, limit {limit}")], "", room)
    });
    lines.extend(turned.map(|text| said(TURNED, "turned", text, app.theme.caution())));
    // The end of a thin pass has its own label, apart from what the pass holds until.
    let is_found = app.assumptions.get(app.selected).and_then(Option::as_deref);
    let is_thin = is_found.is_some_and(Assumptions::pass_as_stated) && app.thin(app.selected).is_some();
    let parts = holds(app).into_iter().enumerate();
    let (ends, until): (Vec<_>, Vec<_>) =
        parts.partition(|(n, part)| is_thin && (*n == 0 || part.starts_with("fails")));
    let [ends, until] =
        [ends, until].map(|parts| filled(&parts.into_iter().map(|(_, part)| part).collect::<Vec<_>>(), room));
    let labels = [labelled("thin").zip(ends), labelled("holds").zip(until)];
    // A part with several lines continues behind an indent.
    let mut is_first = true;
    let holds = labels.into_iter().flatten().enumerate().map(|(n, (label, text))| {
        is_first &= n == 0 || text.starts_with(' ');
        ((if is_first { HOLDS } else { HOLDS_TOO }, label), text)
    });
    let style = match app.word(app.selected) {
        word @ (VerdictWord::Thin | VerdictWord::Hold) => app.theme.verdict(word),
        _ => plain,
    };
    lines.extend(holds.map(|((rank, label), text)| said(rank, label, text, style)));
    // The line is left out for a fail if every dud stays within the limits.
    let passes = judged.checked.verdict == Verdict::Pass;
    // The line about the thin pass already says it.
    let is_said = app.stands_on_so_far(app.selected).is_some()
        && matches!(app.thin(app.selected), Some(ThinPass::OneDud { .. }));
    let dud = judged
        .one_dud
        .filter(|dud| passes && !is_said && (dud.not_passing > 0 || judged.verdict() != Verdict::Fail));
    if let Some(dud) = dud {
        let rank = HOLDS;
        let text = one_dud_in_brief(&dud);
        let text = text.trim_start_matches(DUD).trim_start_matches([':', ' ']).to_owned();
        // Only a coarse step can leave a planned shot open.
        let is_open = dud.failing == 0 && dud.not_passing > 0;
        let finer = is_open.then(|| format!(", {} finer accuracy may tell", app.keymap.hint(Action::Finer)));
        // Without these words, the line would seem to contradict the pass.
        let passes_anyway = judged.verdict() == Verdict::Pass && dud.not_passing > 0;
        let not_asked = passes_anyway.then(|| " (the plan does not ask)".to_owned());
        let mut text = fitting([text].into_iter().chain(not_asked).chain(finer).collect(), "", room);
        if let Some(sampled) = dud.sampled.filter(|_| dud.not_passing == 0) {
            let most = units::at_most(sampled.risk.bounds.interval[1]);
            let accepted = units::short(app.case.plan.limits.dud_risk_percent);
            let texts = [
                format!("{text}; varied at most {most} fail, {accepted} % accepted"),
                format!("0 of {} fail as planned; varied at most {most} ({accepted} % accepted)", dud.places),
                format!("0 of {} fail as planned; varied ≤ {most} ({accepted} % accepted)", dud.places),
            ];
            text = texts.into_iter().find(|longer| longer.width() <= room).unwrap_or(text);
        }
        let style = if dud.not_passing > 0 { app.theme.caution() } else { plain };
        lines.push(said(rank, DUD, text, style));
    }
    lines.push(said(DEPENDS, "depends", fitting(depends(app, judged), "", room), plain));
    // Sweep may recommend another interval than the first line. This line says why.
    let sweep = app.studies.sweep(&app.compute).filter(|_| app.is_pass_of_plan(app.selected));
    let nearer =
        sweep.and_then(|sweep| nearer_than_recommended(&sweep.value, &app.case.plan.delays[app.selected]));
    lines.extend(nearer.map(|parts| said(THEN, "sweep", fitting(parts.into(), "", room), plain)));
    let (label, texts) = next(app, judged, room);
    let ranks = [NEXT].into_iter().chain(repeat(HOLDS_TOO));
    let ticks = labelled(label).zip(texts).zip(ranks);
    lines.extend(ticks.map(|((label, text), rank)| said(rank, label, text, strong)));
    // While samples come, no cable is called strong enough.
    let strengthen =
        strengthen(app, judged).filter(|(past, _)| *past > 0 || !app.options[app.selected].is_sampling());
    // If a force exceeds its limit, the advice to strengthen is kept longer.
    let rank = if strengthen.as_ref().is_some_and(|(past, _)| *past > 0) { HOLDS } else { STRENGTHEN };
    let text = strengthen.map_or_else(String::new, |(_, parts)| fitting(parts, "", room));
    lines.push(said(rank, "cables", text, plain));
    lines.retain(|said| !said.text.is_empty());
    if app.is_held() {
        // If the plan is contradicted, its numbers are refuted.
        lines.iter_mut().filter(|said| said.rank != NEXT).for_each(|said| said.style = app.theme.faint());
    }
    lines
}

impl Said {
    fn line(self, app: &App) -> Line<'static> {
        line(app, self.label, vec![Span::styled(self.text, self.style)])
    }
}

/// A line from a label and its text.
fn line(app: &App, label: &str, text: Vec<Span<'static>>) -> Line<'static> {
    let style = if STRONG.contains(&label) { app.theme.title() } else { app.theme.muted() };
    let label = Span::styled(format!(" {label:0$}", LABEL - 1), style);
    Line::from_iter([label].into_iter().chain(text))
}

/// The number of failing shots, and other reasons against a pass.
fn fails(app: &App, judged: &Judgement, room: usize) -> Vec<String> {
    let is_open = app.options[app.selected].is_open_for_now();
    // A fail needs no reasons that are still open. While samples come, their number says more than the reason that they are too few.
    let decides = |why: &Reason| why.verdict() == judged.verdict();
    let reasons = judged.reasons().into_iter().filter(decides);
    let reasons = reasons.filter(|why| !is_open || matches!(why, Reason::AsPlanned(_)));
    let mut parts: Vec<String> = reasons.filter_map(|why| reason_words(app, judged, &why)).collect();
    let counts = judged.sampled.known().map(|sampled| &sampled.bounds);
    let accepted = app.case.limits.accepted_risk;
    // If the plan takes all inputs as exact, all samples are the same shot.
    let is_alike = |quantity| {
        let band = judged.sampled.known().and_then(|sampled| sampled.band(quantity));
        band.is_none_or(|[low, .., most]| low == most)
    };
    let are_all_alike = Quantity::ALL.into_iter().all(is_alike);
    parts.extend(counts.map(|bounds| {
        let one_in = units::one_in(accepted);
        let failed = format!("{} of {}", bounds.failures, bounds.samples);
        let [low, high] = bounds.interval;
        let words = match (is_open, parts.is_empty() && !app.is_held()) {
            (true, _) => " so far, more come".to_owned(),
            (_, false) => String::new(),
            _ if high < accepted && are_all_alike => {
                return format!("nothing is varied: all {} computed shots are alike", bounds.samples);
            }
            _ if high < accepted => format!(": under 1 in {one_in} if your inputs hold"),
            _ if low > accepted => format!(": over 1 in {one_in}"),
            _ => format!(": may be over 1 in {one_in}"),
        };
        // The condition is stated at every width.
        let whole = format!("{failed} computed shots fail{words}");
        let short = whole.replace(" shots ", " ").replace(" your ", " ");
        let shortest = short.replace(" computed ", " ");
        let texts = [&whole, &short, &shortest];
        texts.into_iter().find(|text| text.width() <= room).unwrap_or(&shortest).clone()
    }));
    if is_open && counts.is_none() {
        parts.push("no shot tried so far, the first come".to_owned());
    }
    parts
}

/// Why an option does not pass; `None` for a reason that the count of shots already states.
fn reason_words(app: &App, judged: &Judgement, reason: &Reason) -> Option<String> {
    let ReasonWords { brief, needs_finer_accuracy, .. } = reasons::words(&app.case, judged, reason);
    let finer = || format!(": {} finer accuracy", app.keymap.hint(Action::Finer));
    Some(brief? + &if needs_finer_accuracy { finer() } else { String::new() })
}

/// A line for each limit, greatest utilization first: the value that only the accepted share of the shots exceeds, and the planned value,
/// each with its tire or cable.
fn limits(app: &App, judged: &Judgement, room: usize) -> Vec<Said> {
    let (scene, checked, limits) = (app.case.scene(), &judged.checked, &app.case.limits);
    let sampled = judged.sampled.known();
    let limited = Quantity::ALL.into_iter().filter_map(|quantity| Some((quantity, limits.get(quantity)?)));
    let mut rows: Vec<(f64, [String; 4])> = Vec::new();
    for (quantity, limit) in limited {
        let (name, unit, none) = match quantity {
            Quantity::Height => ("height", Unit::Metre, "no tire lifts"),
            Quantity::Force => ("force", Unit::Kilonewton, "no cable pulls"),
            Quantity::Drift => ("slide", Unit::Metre, "no tire slides"),
        };
        let estimate = checked.get(quantity);
        let deciding = sampled.and_then(|sampled| sampled.deciding_value(quantity));
        let digits = |value| units::significant(value, unit, DIGITS);
        // A value that differs from the limit gets more digits if it would look like the limit.
        let value = |value: f64| match value != limit && digits(value) == digits(limit) {
            true => units::significant(value, unit, 2 * DIGITS),
            false => digits(value),
        };
        let share = share_of_limit(app, judged, quantity);
        let greatest = deciding.map_or(estimate.value, |deciding| deciding.max(estimate.value));
        // Name the cable with the greater pull, in the deciding or in the planned shot: this is the cable to strengthen.
        let decides = quantity == Quantity::Force && deciding >= Some(estimate.value);
        let cables = sampled.filter(|_| decides).and_then(SampledShot::deciding_cables);
        let cable =
            cables.and_then(|cables| cables.first().copied()).map_or(estimate.index, |(cable, _)| cable);
        let has_value = !share.is_empty() && greatest > 0.0;
        let [of_greatest, of_planned] = match quantity {
            Quantity::Force if has_value => {
                // Two cables, each with its force.
                let other = Some(estimate.index).filter(|planned| *planned != cable);
                let of_planned =
                    other.map_or_else(String::new, |other| format!(" in {}", scene.cable_name(other)));
                [format!(" in {}", scene.cable_name(cable)), of_planned]
            }
            Quantity::Force => [String::new(), format!(" in {}", scene.cable_name(estimate.index))],
            Quantity::Height | Quantity::Drift => {
                // The limit is for the center of a tire. The edge of a tire may be half a diameter higher.
                let radius = 0.5 * app.case.plan.tire.outer_diameter_m;
                let highest = judged.highest_tire().map(|tire| scene.tire_ids[tire]);
                let at = highest.map_or_else(String::new, |tire| format!(" at {tire}"));
                let of_centres = match quantity == Quantity::Height && has_value {
                    true if radius > 0.0 => format!("{at} (edge +{} m)", units::short(radius)),
                    true => at,
                    false => String::new(),
                };
                [of_centres, format!(" at {}", scene.tire_ids[estimate.index])]
            }
        };
        let planned = match estimate.value > 0.0 {
            // The value may still grow.
            true if estimate.error.is_infinite() => format!("  planned over {}", value(estimate.value)),
            true => format!("  planned {}", value(estimate.value)),
            false => format!("  planned: {none}"),
        };
        let of_planned = if estimate.value > 0.0 { of_planned } else { String::new() };
        // Without its own cable, the planned force would seem to belong to the cable before it. The tire matters less.
        let [planned, of_planned] = match quantity {
            Quantity::Force => [planned + &of_planned, String::new()],
            Quantity::Height | Quantity::Drift => [planned, of_planned],
        };
        let limit_words = format!("{} {}", digits(limit), unit.symbol());
        // This is the share of the value that 1 in so many shots exceed, as the head of the table says.
        let used = match share.is_empty() {
            true => format!("by {name}, limit {limit_words}"),
            false => format!("by {name}, {share}: {} of {limit_words}", value(greatest)),
        };
        rows.push((greatest / limit, [used, of_greatest, planned, of_planned]));
    }
    sort_by(&mut rows, |a, b| b.0.total_cmp(&a.0));
    let longest = rows.iter().map(|(_, [used, ..])| used.width()).max().unwrap_or(0);
    let lines = rows.into_iter().enumerate().map(|(n, (share, [used, place, planned, of_planned]))| {
        let style = match (n, share > 1.0) {
            (_, true) => app.theme.limit(),
            (0, false) => app.theme.title(),
            (_, false) => app.theme.base(),
        };
        let (rank, label) = if n == 0 { (LIMITED, "limited") } else { (THEN, "then") };
        let used = format!("{used:longest$}");
        let whole = format!("{used}{place}{planned}{of_planned}");
        let text = if whole.width() <= room { whole } else { fitting(vec![used, place, planned], "", room) };
        Said { rank, label, text, style }
    });
    lines.collect()
}

/// The number of cables whose pull exceeds the limit once the accepted share of the shots is left out, and the cables to strengthen, most
/// important first. `None` if too few shots are sampled.
///
/// Only the hardest pulled cable of each shot is known. If the cables over the limit are strengthened, the next cable decides, with at
/// least the force that it has in a shot of its own.
fn strengthen(app: &App, judged: &Judgement) -> Option<(usize, Vec<String>)> {
    let (limit, scene) = (app.case.limits.force, app.case.scene());
    let known = judged.sampled.known()?.deciding_cables()?;
    let count = |share: f64| known.iter().filter(|(_, force)| *force > share * limit).count();
    let (past, near) = (count(1.0), count(NEAR_LIMIT));
    let name = |&(cable, _): &(usize, f64)| scene.cable_name(cable);
    let share = |&(_, force): &(usize, f64)| units::whole_percent(force / limit);
    let parts = match (past, near) {
        (0, 0) => vec!["none above 80 % of the limit: none to strengthen".to_owned()],
        (0, 1) => {
            vec![format!("1 above 80 % of the limit, {}", name(&known[0])), ", none past it".to_owned()]
        }
        (0, near) => vec![format!("{near} above 80 % of the limit"), ", none past it".to_owned()],
        (1..=STRENGTHENED, _) => {
            let names = known[..past].iter().map(name).join(", ");
            let then = known.get(past).map(|next| format!(": still {:.0} % in {}", share(next), name(next)));
            [format!("strengthen {names}")].into_iter().chain(then).collect()
        }
        _ => {
            let worst = format!(", worst {} {:.0} %", name(&known[0]), share(&known[0]));
            vec![format!("{past} past the limit{worst}"), ": strengthening one is not enough".to_owned()]
        }
    };
    Some((past, parts))
}

/// The cables that are pulled hardest once the accepted share of the shots is left out, at most `most`, each with its share of the limit.
fn cables(app: &App, judged: &Judgement, most: usize) -> Vec<Line<'static>> {
    let (theme, limit) = (app.theme, app.case.limits.force);
    let sampled = judged.sampled.known().filter(|_| !app.is_held());
    let known = sampled.and_then(SampledShot::deciding_cables).unwrap_or_default();
    let shown: Vec<(String, f64)> = known
        .into_iter()
        .take(most.min(CABLES))
        .map(|(cable, force)| (app.case.scene().cable_name(cable), force))
        .collect();
    let longest = shown.iter().map(|(name, _)| name.width()).max().unwrap_or(0);
    let lines = shown.into_iter().map(|(name, force)| {
        let (kn, share) = (units::significant(force, Unit::Kilonewton, DIGITS), force / limit);
        let text = format!("{name:longest$} {kn:>5} kN {:>4.0} %  ", units::whole_percent(share));
        let style = if share > 1.0 { theme.limit() } else { theme.base() };
        let gauge = gauges::use_of_limit(theme, None, Some(share), GAUGE, theme.shots(), false);
        line(app, "", [Span::styled(text, style)].into_iter().chain(gauge.spans).collect())
    });
    lines.collect()
}

/// What the pass of the selected option holds until; empty if it does not pass, because the margin of the planned shot alone would flatter
/// it.
pub fn holds(app: &App) -> Vec<String> {
    if !app.is_pass_of_plan(app.selected) {
        return Vec::new();
    }
    let Some(found) = app.assumptions.get(app.selected).and_then(Option::as_deref) else {
        return vec![being_found(app)];
    };
    if !found.pass_as_stated() {
        return vec![format!("not with all as stated: {} of {} fail", found.failing, found.samples)];
    }
    // The planned shot alone may end a pass sooner than the assumptions.
    match app.thin(app.selected).or_else(|| ThinPass::of_assumptions(found)) {
        // Same words as in the first line.
        Some(thin) => {
            let others = assumption_words::nearest_beside(found, thin);
            let others = if found.nearest_are_known() { others } else { Vec::new() };
            [assumption_words::thin(thin)].into_iter().chain(others).collect()
        }
        None if !found.nearest_are_known() => vec![being_found(app)],
        None if assumption_words::nearest(found).is_empty() => {
            vec!["at every value tried of what it stands on".to_owned()]
        }
        None => assumption_words::nearest(found),
    }
}

/// Says that the assumptions of the selected option's pass are still being found, with the progress.
fn being_found(app: &App) -> String {
    let done = app.assumption_search_progress(app.selected);
    let done = done.map_or_else(String::new, |share| format!(" {}", bar(share, BAR)));
    format!("still being found{done}; the page waits")
}
