//! The answer of a plan in one line: the option that is recommended. Every face says the same line.

use std::fmt::{self, Display, Formatter};

use super::assumption_words;
use super::to_be_confirmed::count_assumed;
use crate::report::language::{phrase, say};
use crate::study::Case;
use crate::study::judge::recommend::{Lead, are_alike, recommended};
use crate::study::judge::{Judgement, OptionResults, verdict_of};
use crate::study::standing::verdict_word::ThinPass;
use crate::units;
use crate::verdict::Verdict;

/// The answer of a plan.
#[derive(Clone, Debug)]
pub enum Headline {
    /// An option is recommended.
    Recommends(Recommended),
    /// No option is recommended, for this reason.
    Nothing(String),
}

/// An option that is recommended, in the parts of its sentence.
#[derive(Clone, Debug)]
pub struct Recommended {
    /// Index of the option.
    pub option: usize,
    /// Name of the option.
    pub name: String,
    /// What the pass does not cover: `, slide NOT checked`, or nothing.
    pub unchecked: &'static str,
    /// What ranks the option first: `, the safest of 7`; empty where the plan has one option.
    pub among: String,
    /// Why the pass is thin, by the planned shot and one dud; what the pass stands on is not known here.
    pub thin: Option<String>,
    /// `if your inputs hold`, with the number of assumed inputs.
    pub inputs_hold: String,
    /// Number of assumed inputs; 0 where the plan states no unknowns.
    pub assumed: usize,
    /// N in `fewer than 1 in N shots exceed a limit`.
    pub one_in: String,
}

impl Headline {
    /// Index of the recommended option.
    pub fn option(&self) -> Option<usize> {
        match self {
            Headline::Recommends(recommended) => Some(recommended.option),
            Headline::Nothing(_) => None,
        }
    }
}

impl Display for Headline {
    /// `42 ms passes, slide NOT checked, the safest of 7: if your inputs hold, fewer than 1 in 100 shots exceed a limit`.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Recommended { name, unchecked, among, thin, inputs_hold, one_in, .. } = match self {
            Headline::Recommends(recommended) => recommended,
            Headline::Nothing(why) => return f.write_str(why),
        };
        f.write_str(&match thin {
            Some(thin) => {
                say!("{name} passes{unchecked}, but thinly{among}: {thin}", name, unchecked, among, thin)
            }
            None => say!(
                "{name} passes{unchecked}{among}: {inputs_hold}, fewer than 1 in {one_in} shots exceed a limit",
                name,
                unchecked,
                among,
                inputs_hold,
                one_in
            ),
        })
    }
}

/// Answer from the results of all options of a plan.
pub fn headline(case: &Case, results: &OptionResults) -> Headline {
    let Some(option) = recommended(case, results) else {
        return Headline::Nothing(why_none(results));
    };
    let thin = results[option].as_ref().ok().and_then(|judged| ThinPass::of(judged, None));
    Headline::Recommends(Recommended {
        option,
        name: case.plan.delays[option].name.clone(),
        unchecked: unchecked(case),
        among: rank(case, results, option),
        thin: thin.map(assumption_words::thin),
        inputs_hold: inputs_hold(case),
        assumed: assumed_of_stated(case),
        one_in: units::one_in(case.limits.accepted_risk),
    })
}

fn count(results: &OptionResults, wanted: Verdict) -> usize {
    results.iter().filter(|result| verdict_of(result) == wanted).count()
}

/// Why no option is recommended.
fn why_none(results: &OptionResults) -> String {
    let (all, passing) = (results.len(), count(results, Verdict::Pass));
    if passing > 0 {
        return say!(
            "{passing} of {all} pass at a step that somebody fixed: none of them may be fired",
            passing,
            all
        );
    }
    match (count(results, Verdict::Undecided), all) {
        (0, 1) => say!("the option fails"),
        (0, _) => say!("none of {all} options passes", all),
        (open, _) => say!("no option passes, {open} of {all} are open", open, all),
    }
}

/// What ranks the `best` option before the others, as the end of a sentence.
fn rank(case: &Case, results: &OptionResults, best: usize) -> String {
    let (all, passing) = (results.len(), count(results, Verdict::Pass));
    let judged = |option: usize| results[option].as_ref().ok();
    let passes = |judged: &Judgement| judged.verdict() == Verdict::Pass;
    let timed = |option: usize| Some((judged(option)?, case.shots[option].duration()));
    let others = (0..all).filter(|option| *option != best).filter_map(timed);
    let others: Vec<_> = others.filter(|(other, _)| passes(other)).collect();
    // What a pass stands on is not known here, and may still make the pass thin.
    let is_thin = |judged: &Judgement| ThinPass::of(judged, None).is_some();
    let alone_is_not =
        judged(best).is_some_and(|best| !is_thin(best)) && others.iter().all(|(other, _)| is_thin(other));
    let are_alike = |best: &Judgement| others.iter().any(|(other, _)| are_alike(best, other));
    match (passing, timed(best).and_then(|best| Lead::of(case, best, &others))) {
        _ if all == 1 => String::new(),
        (1, _) => say!(", the only one of {all}", all),
        _ if alone_is_not => {
            say!(", the only one of {passing} that pass which is not thin as planned", passing)
        }
        (_, Some(Lead::Failures)) if !judged(best).is_some_and(are_alike) => {
            say!(", the safest of {all}", all)
        }
        // The sampled shots do not surely tell the options apart, so the words say what ranks the best.
        (_, Some(Lead::Failures)) => say!(", its computed shots fail least of {passing} that pass", passing),
        (_, Some(Lead::Dud)) => say!(", the only one of {passing} that pass which bears one dud", passing),
        (_, Some(Lead::Room)) => say!(", keeps farthest from its limits of {passing} that pass", passing),
        (_, Some(Lead::Launches)) => say!(", bears the fastest launches of {passing} that pass", passing),
        (_, Some(Lead::Duration)) => say!(", the quickest of {passing} that pass", passing),
        (_, None) => say!(", first of {passing} that pass", passing),
    }
}

/// What no pass covers where the plan does not limit how far tires slide.
pub const UNCHECKED: &str = "slide NOT checked";

/// Words behind `passes`: the pass covers height and force alone, where the plan does not limit how far tires slide.
pub fn unchecked(case: &Case) -> &'static str {
    if case.limits.drift.is_none() { phrase(", slide NOT checked") } else { "" }
}

/// Condition of every pass: `if your inputs hold`, with the number of inputs that the plan marks as assumed, leaves out, or takes
/// as exact.
pub fn inputs_hold(case: &Case) -> String {
    match assumed_of_stated(case) {
        0 => say!("if your inputs hold"),
        assumed => say!("if your inputs hold ({assumed} assumed)", assumed),
    }
}

/// Number of assumed inputs; 0 where the plan has no `[uncertainty]`, and all unknowns are assumed.
fn assumed_of_stated(case: &Case) -> usize {
    if case.plan.uncertainty.assumed { 0 } else { count_assumed(case) }
}
