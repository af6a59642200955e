//! The option to be fired, at the head of the page: when its holes fire, its verdict, and what the verdict rests on.

use maud::{Markup, html};

use super::Page;
use super::table::word;
use crate::plan::DelayOption;
use crate::report::{check, explain, no_result};
use crate::scene::Shot;
use crate::study::Case;
use crate::study::judgement::Judgement;
use crate::study::margin::LaunchMargin;
use crate::study::sampled::Sampled;
use crate::study::together::Together;
use crate::units;
use crate::verdict::{Estimate, Quantity, Verdict};

/// The box with the option to be fired; one line where none is chosen.
pub fn head(page: &Page<'_>, warnings: &[&String]) -> Markup {
    let Some(option) = page.fired else {
        return html! { p.chosen { "No option is chosen to be fired: --option NAME of shelter report chooses one." } };
    };
    let case = page.case;
    let (delay, shot, result) = (&case.plan.delays[option], &case.shots[option], &page.results[option]);
    let together = explain::together(Together::of(case, shot));
    let verdict = result.as_ref().map_or(Verdict::Undecided, Judgement::verdict);
    let caveat = check::pass_caveat(case, page.sampling.is_some());
    let reasons = match result {
        Ok(judged) => check::reason_sentences(case, judged),
        Err(reason) => vec![no_result::message(reason)],
    };
    html! {
        div.fired {
            p.what { "To be fired: " (delay.name) ", " (firing(delay)) }
            p.large { (word(verdict)) (only_planned(page)) }
            @if verdict != Verdict::Pass { p { strong { "Do not fire this option as it stands." } } }
            @if !caveat.is_empty() { p { "Judged:" (caveat.replace(['(', ')'], "")) "." } }
            @for reason in &reasons { p { (reason) } }
            table.facts {
                @for (name, text) in result.iter().flat_map(|judged| judgement(case, shot, judged)) {
                    tr { th { (name) } td { (text) } }
                }
                tr { th { "Within any 8 ms" } td { (together) " fire, as planned" } }
            }
            @for warning in warnings { p { strong { "Warning: " } (warning) } }
        }
    }
}

/// Words behind a verdict for which no possible shot was judged.
pub fn only_planned(page: &Page<'_>) -> &'static str {
    if page.sampling.is_some() { "" } else { " as planned only; the possible shots were NOT judged" }
}

/// When the rows fire, in the order of the plan, and how the holes of each follow: `rows at 0/42/84 ms, holes 17 ms left`.
fn firing(delay: &DelayOption) -> String {
    // A sum of intervals has digits that nobody wrote.
    let exact = |time: &f64| ((time * 1e6).round() / 1e6).to_string();
    let times: Vec<String> = delay.timing.fire_at_ms().iter().map(exact).collect();
    let rows = if times.len() == 1 { "row" } else { "rows" };
    let rows = format!("{rows} at {} ms", times.join("/"));
    [rows].into_iter().chain(delay.hole_timing.words()).collect::<Vec<_>>().join(", ")
}

/// What the verdict rests on, each with its name.
fn judgement(case: &Case, shot: &Shot, judged: &Judgement) -> Vec<(&'static str, String)> {
    let mut facts = vec![("Risk", risk(case, judged)), ("Launch margin", launch_margin(shot, judged))];
    if let Some(risk) = judged.risk.drawn() {
        let inputs = explain::inputs(risk, &case.limits);
        facts.push(("What decides", inputs.unwrap_or_else(|| "too few samples to tell".to_owned())));
    }
    facts.push(("As planned", explain::peaks(case.scene(), &judged.as_planned)));
    facts.push(("Utilization as planned", utilization(case, judged)));
    let bands = judged.risk.drawn().and_then(explain::bands);
    facts.extend(bands.map(|bands| ("Possible shots", bands)));
    facts
}

/// Bounds of the share of the possible shots that fail, and the share accepted.
fn risk(case: &Case, judged: &Judgement) -> String {
    let accepted = format!("accepted {} %", units::short(case.plan.limits.accepted_risk_percent));
    match &judged.risk {
        Sampled::NotAsked => "not judged: the plan's own numbers only, nothing varied".to_owned(),
        Sampled::Drawn(risk) if !risk.samples.is_empty() => {
            let bounds = &risk.bounds;
            format!(
                "{} % of the possible shots fail (95 % bounds; {} of {} samples fail); {accepted}",
                units::probabilities(bounds.interval),
                bounds.failures,
                bounds.samples
            )
        }
        Sampled::Drawn(_) | Sampled::NotDrawn => {
            format!("not known: no sample was drawn, the time was up; {accepted}")
        }
    }
}

/// How much faster the tires may leave, in words.
fn launch_margin(shot: &Shot, judged: &Judgement) -> String {
    let none = || match judged.launch_margin {
        Some(LaunchMargin::NotPassing) => "none: the shot as planned does not pass".to_owned(),
        _ => "not computed".to_owned(),
    };
    explain::launch_limit(shot, judged).map_or_else(none, |limit| format!("as planned it {limit}"))
}

/// The share of each limit that the shot as planned takes.
fn utilization(case: &Case, judged: &Judgement) -> String {
    let checked = &judged.as_planned;
    let of = |name: &str, peak: Estimate, quantity: Quantity| {
        Some(format!("{name} {}", units::percent(peak.value / case.limits.get(quantity)?, 0)))
    };
    let shares = [
        of("height", checked.height, Quantity::Height),
        of("force", checked.force, Quantity::Force),
        of("drift", checked.drift, Quantity::Drift),
    ];
    let shares: Vec<String> = shares.into_iter().flatten().collect();
    format!("{} of the limit", shares.join(" · "))
}
