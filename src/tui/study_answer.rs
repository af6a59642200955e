//! What a study found, in one line: for the page of all questions.

use itertools::Itertools;

use crate::report::parts::Report;
use crate::report::words::assumption_words::nearest;
use crate::study::fit::FitResult;
use crate::study::judge::OptionResults;
use crate::study::judge::recommend::safest_first;
use crate::study::question::Found;
use crate::study::sweep::Sweep;
use crate::study::{Case, Computed};
use crate::tui::theme;
use crate::verdict::Verdict;

/// The answer of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyAnswer {
    /// The verdict, where the study has one.
    pub verdict: Option<Verdict>,
    /// The answer behind its mark, from the longest wording to the shortest.
    pub texts: Vec<String>,
}

impl StudyAnswer {
    /// The answer of a result, whose report and contradictions these are.
    pub fn new(case: &Case, found: &Found, report: &Report, contradiction: &[String]) -> Self {
        let mut is_open = !contradiction.is_empty();
        let (verdict, texts) = match found {
            Found::Sweep(sweep) => (Some(sweep.verdict()), of_sweep(sweep)),
            Found::Orders(orders) => {
                let count = orders.value.ranked.len();
                let passing = orders.value.passing_as_planned();
                let worst = orders.value.ranked.first().map(|worst| names(case, &worst.order));
                let worst = worst.map_or_else(String::new, |worst| format!("; worst {worst}"));
                let text = format!("{passing} of {count} pass as planned");
                (Some(orders.verdict()), vec![format!("{text}{worst}"), text])
            }
            Found::Risk(risks) => of_risk(case, &risks.value.results),
            Found::Search(search) => {
                let best = search.value.case.plan.delays.first().map(|best| best.name.clone());
                let passing = search.value.passing().count();
                match best {
                    Some(best) => {
                        let more =
                            format!("{best}; {passing} of {} judged pass", search.value.schedules.len());
                        (Some(search.verdict()), vec![more, best])
                    }
                    None => (Some(search.verdict()), vec!["no schedule keeps the limits".to_owned()]),
                }
            }
            Found::Size(sizing) => {
                let sizing = &sizing.value;
                let texts = match sizing.lightest_choice() {
                    Some(choice) => {
                        let (rope, mass) = (&choice.rope.name, choice.tire_mass);
                        vec![format!("{rope}, tires of {mass} kg"), rope.clone()]
                    }
                    None => vec![format!("none for all {} options", case.shots.len()), "none".to_owned()],
                };
                (Some(sizing.verdict()), texts)
            }
            Found::Effects(effects) => {
                let required = effects.value.iter().flatten().flatten().filter(|effect| effect.is_required());
                let count = required.map(|effect| effect.effect).unique().count();
                let text = match count {
                    0 => "none of the effects left out".to_owned(),
                    1 => "1 effect is required".to_owned(),
                    count => format!("{count} effects are required"),
                };
                (None, vec![text])
            }
            Found::Fit(compared) => {
                let is_compared = !matches!(
                    compared.value.fitted,
                    Some(FitResult::KnownExactly(_) | FitResult::NotInMethod(_))
                );
                let text = match (contradiction.is_empty(), is_compared) {
                    (false, _) => "contradicts this plan",
                    (true, true) => "agrees with this plan",
                    (true, false) => "is not compared with this plan",
                };
                is_open |= !is_compared;
                (None, vec![format!("what was seen {text}"), text.to_owned()])
            }
            Found::Assumptions(found) => {
                let option = &case.plan.delays[found.value.option].name;
                let holds = found.value.pass_as_stated();
                let verdict = if holds { Verdict::Pass } else { Verdict::Fail };
                let until = nearest(&found.value).into_iter().next();
                let until =
                    until.map_or_else(|| "at every value tried".to_owned(), |until| format!("until {until}"));
                let texts = match holds {
                    true => vec![format!("{option}: {until}"), format!("{option}: holds")],
                    false => vec![format!("{option}: not even as assumed"), "not as assumed".to_owned()],
                };
                (Some(verdict), texts)
            }
            _ => (None, Vec::new()),
        };
        let concluded = report.conclusion.as_ref().map(|conclusion| conclusion.verdict);
        let verdict = verdict.or(concluded);
        let mark = match verdict {
            Some(verdict) => theme::mark(verdict),
            None if is_open => "!",
            None => "·",
        };
        Self { verdict, texts: texts.into_iter().map(|text| format!("{mark} {text}")).collect() }
    }
}

/// The option that fails least, and how often.
fn of_risk(case: &Case, results: &OptionResults) -> (Option<Verdict>, Vec<String>) {
    let best = safest_first(case, results, |_| 1.0).into_iter().next();
    let best = best.and_then(|option| Some((option, results[option].as_ref().ok()?)));
    let Some((option, judged)) = best else { return (None, vec!["no result".to_owned()]) };
    let name = &case.plan.delays[option].name;
    let texts = judged.sampled.known().map_or_else(Vec::new, |sampled| {
        let failing = format!("{} of {} shots fail", sampled.bounds.failures, sampled.bounds.samples);
        vec![format!("{name} fails least: {failing}"), format!("{name}: {failing}")]
    });
    (Some(judged.verdict()), texts.into_iter().chain([name.clone()]).collect())
}

/// The recommended interval, and the window around it.
fn of_sweep(sweep: &Computed<Sweep>) -> Vec<String> {
    let Some(best) = sweep.value.best() else { return vec!["no interval is recommended".to_owned()] };
    let name = format!("{} ms", best.interval);
    let around = sweep.value.windows.iter().find(|[from, to]| (*from..=*to).contains(&best.interval));
    let around = around.map(|window| window.map(|end| format!("{:.0}", end.ms())));
    let with_window = around.map(|[from, to]| format!("{name}; {from} to {to} ms worth a check"));
    with_window.into_iter().chain([name]).collect()
}

fn names(case: &Case, order: &[usize]) -> String {
    order.iter().map(|&row| case.plan.blast_rows[row].name.as_str()).join("-")
}
