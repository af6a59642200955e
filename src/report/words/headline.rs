//! The answer of a plan in one line: which option is recommended. Every face says it alike.

use crate::study::Case;
use crate::study::judge_options::OptionResults;
use crate::study::judgement::Judgement;
use crate::study::recommend::recommended;
use crate::units;
use crate::verdict::Verdict;

/// The answer: `42 ms passes, the safest of 7: surely fewer than 1 in 100 shots exceed a limit`.
pub fn headline(case: &Case, results: &OptionResults) -> String {
    let verdict =
        |result: &Result<Judgement, _>| result.as_ref().map_or(Verdict::Undecided, Judgement::verdict);
    let count = |wanted: Verdict| results.iter().filter(|result| verdict(result) == wanted).count();
    let (all, passing) = (results.len(), count(Verdict::Pass));
    let Some(best) = recommended(case, results) else {
        return match (count(Verdict::Undecided), all) {
            (0, 1) => "the option fails".to_owned(),
            (0, _) => format!("none of {all} options passes"),
            (open, _) => format!("no option passes, {open} of {all} are open"),
        };
    };
    let name = &case.plan.delays[best].name;
    let among = match (passing, all) {
        (_, 1) => String::new(),
        (1, _) => format!(", the only one of {all}"),
        _ => format!(", the safest of {all}"),
    };
    let one_in = units::one_in(case.limits.accepted_risk);
    format!("{name} passes{among}: surely fewer than 1 in {one_in} shots exceed a limit")
}
