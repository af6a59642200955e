//! The answer of a plan in one line: which option is recommended. Every face says it alike.

use super::assumption_words;
use super::warnings::count_assumed;
use crate::report::language::{phrase, say};
use crate::study::Case;
use crate::study::judge::recommend::{Lead, are_alike, recommended};
use crate::study::judge::{Judgement, OptionResults, verdict_of};
use crate::study::standing::verdict_word::ThinPass;
use crate::units;
use crate::verdict::Verdict;

/// The answer: `42 ms passes, slide NOT checked, the safest of 7: if your inputs hold, fewer than 1 in 100 shots exceed a limit`.
pub fn headline(case: &Case, results: &OptionResults) -> String {
    let count = |wanted: Verdict| results.iter().filter(|result| verdict_of(result) == wanted).count();
    let (all, passing) = (results.len(), count(Verdict::Pass));
    let Some(best) = recommended(case, results) else {
        if passing > 0 {
            return say!(
                "{passing} of {all} pass at a step that somebody fixed: none of them may be fired",
                passing,
                all
            );
        }
        return match (count(Verdict::Undecided), all) {
            (0, 1) => say!("the option fails"),
            (0, _) => say!("none of {all} options passes", all),
            (open, _) => say!("no option passes, {open} of {all} are open", open, all),
        };
    };
    let name = &case.plan.delays[best].name;
    let judged = |option: usize| results[option].as_ref().ok();
    let passes = |judged: &Judgement| judged.verdict() == Verdict::Pass;
    let timed = |option: usize| Some((judged(option)?, case.shots[option].duration()));
    let others = (0..all).filter(|option| *option != best).filter_map(timed);
    let others: Vec<_> = others.filter(|(other, _)| passes(other)).collect();
    // What a pass stands on may still make it thin.
    let is_thin = |judged: &Judgement| ThinPass::of(judged, None).is_some();
    let alone_is_not =
        judged(best).is_some_and(|best| !is_thin(best)) && others.iter().all(|(other, _)| is_thin(other));
    let are_alike = |best: &Judgement| others.iter().any(|(other, _)| are_alike(best, other));
    let among = match (passing, timed(best).and_then(|best| Lead::of(best, &others))) {
        _ if all == 1 => String::new(),
        (1, _) => say!(", the only one of {all}", all),
        _ if alone_is_not => {
            say!(", the only one of {passing} that pass which is not thin as planned", passing)
        }
        (_, Some(Lead::Failures)) if !judged(best).is_some_and(are_alike) => {
            say!(", the safest of {all}", all)
        }
        // Their shots do not tell them apart surely: what ranks them is said.
        (_, Some(Lead::Failures)) => say!(", its computed shots fail least of {passing} that pass", passing),
        (_, Some(Lead::Dud)) => say!(", the only one of {passing} that pass which bears one dud", passing),
        (_, Some(Lead::Launches)) => say!(", bears the fastest launches of {passing} that pass", passing),
        (_, Some(Lead::Duration)) => say!(", the quickest of {passing} that pass", passing),
        (_, None) => say!(", first of {passing} that pass", passing),
    };
    let unchecked = unchecked(case);
    if let Some(thin) = results[best].as_ref().ok().and_then(|judged| ThinPass::of(judged, None)) {
        let thin = assumption_words::thin(thin);
        return say!("{name} passes{unchecked}, but thinly{among}: {thin}", name, unchecked, among, thin);
    }
    let (one_in, inputs_hold) = (units::one_in(case.limits.accepted_risk), inputs_hold(case));
    say!(
        "{name} passes{unchecked}{among}: {inputs_hold}, fewer than 1 in {one_in} shots exceed a limit",
        name,
        unchecked,
        among,
        inputs_hold,
        one_in
    )
}

/// What no pass is about where the plan does not limit how far tires slide.
pub const UNCHECKED: &str = "slide NOT checked";

/// Behind `passes`: that it is one of height and force alone, where the plan does not limit how far tires slide.
pub fn unchecked(case: &Case) -> &'static str {
    if case.limits.drift.is_none() { phrase(", slide NOT checked") } else { "" }
}

/// What every pass stands on: `if your inputs hold`, and how many of them the plan itself calls assumed.
pub fn inputs_hold(case: &Case) -> String {
    // Where the plan states none of what is not known, all of that is assumed.
    let all_assumed = case.plan.uncertainty.assumed;
    match count_assumed(case) {
        assumed if assumed > 0 && !all_assumed => say!("if your inputs hold ({assumed} assumed)", assumed),
        _ => say!("if your inputs hold"),
    }
}
