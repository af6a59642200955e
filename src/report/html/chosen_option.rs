//! The option to be fired, at the head of the page: its firing times, its verdict, and what the verdict rests on.

use maud::{Markup, html};

use super::Page;
use super::table::word;
use crate::report::check;
use crate::report::language::{phrase, say};
use crate::report::words::assumption_words::{self, holds};
use crate::report::words::objections::{self, forbidding};
use crate::report::words::{headline, no_result, option_sentences, reasons};
use crate::scene::Shot;
use crate::study::Case;
use crate::study::as_planned::margin::LaunchMargin;
use crate::study::eight_ms::WithinEightMs;
use crate::study::judge::grounds::Evidence;
use crate::study::judge::{Judgement, verdict_of};
use crate::study::samples::influence::input_shares;
use crate::study::standing::Doubt;
use crate::units;
use crate::verdict::{Quantity, Verdict, VerdictWord};

/// The box of the option to be fired; a line instead where no option is chosen.
pub fn head(page: &Page<'_>, warnings: &[String]) -> Markup {
    let Some(option) = page.to_be_fired else {
        return html! {
            p.chosen { (phrase("No option is chosen to be fired: --option NAME of shelter report chooses one.")) }
            (objections_of_observations(page))
            @for warning in warnings { p { strong { (phrase("Warning: ")) } (warning) } }
        };
    };
    let case = page.case;
    let (delay, shot, result) = (&case.plan.delays[option], &case.shots[option], &page.results[option]);
    let together = option_sentences::together(WithinEightMs::of(case, shot));
    let against = page.against_firing(option);
    let verdict_word = page.word(option);
    let thin = page.thin(option).filter(|_| verdict_word == VerdictWord::Thin);
    let caveat = check::pass_caveat(case, page.sampling.is_some());
    let reasons = match result {
        Ok(judged) => reasons::sentences(case, judged),
        Err(reason) => vec![no_result::message(reason)],
    };
    html! {
        div.fired {
            p.what { (firing_instruction(page, option)) ": " (say!("{option}, rows at {times}", delay.name, option_sentences::firing_times_text(&case.plan.blast_rows, delay))) }
            @if verdict_word.verdict() == Verdict::Pass && against.is_some() {
                p { (phrase("Judged:")) " " (phrase(verdict_word.for_people())) (only_planned(page)) }
            } @else if verdict_word.verdict() == Verdict::Pass && !page.to_be_confirmed().is_empty() {
                // A pass under a condition is printed no larger than the condition.
                p.what { (word(verdict_word)) (only_planned(page)) }
            } @else {
                p.large { (word(verdict_word)) (only_planned(page)) }
            }
            @if let Some(thin) = thin { p { strong { (say!("The pass is thin: {}.", assumption_words::thin(thin))) } } }
            (objections_of_observations(page))
            @if against.is_some_and(|against| against != Doubt::StandsOnUnknown) {
                p { strong { (phrase("Do not fire this option as it stands.")) } }
            }
            @if !caveat.is_empty() { p { (phrase("Judged:")) (caveat.replace(['(', ')'], "")) "." } }
            @for reason in &reasons { p { (reason) } }
            table.facts {
                @for (name, text) in result.iter().flat_map(|judged| judgement(case, shot, judged, verdict_word)) {
                    tr { th { (phrase(name)) } td { (text) } }
                }
                @if let Some(holds) = stands_on(page, option) { tr { th { (phrase("Stands on")) } td { (holds) } } }
                tr { th { (phrase("Within any 8 ms")) } td { (say!("{holes}, as planned", together)) } }
                @if !case.plan.fitted_from.is_empty() && page.observed.is_empty() {
                    tr { th { (phrase("Fitted")) } td { (phrase("to observations of earlier shots; they are not compared with the plan on this page")) } }
                }
            }
            @for warning in warnings { p { strong { (phrase("Warning: ")) } (warning) } }
        }
    }
}

/// What the pass of the option stands on. The text says that this is not known where the page was written before it was found.
/// `None` without a standing pass of sampled shots.
fn stands_on(page: &Page<'_>, option: usize) -> Option<String> {
    let stands = page.standing.against_passes().is_none();
    let passes = stands && verdict_of(&page.results[option]) == Verdict::Pass && page.sampling.is_some();
    passes.then(|| match page.stands_on(option) {
        Some(found) => say!(
            "{}; advice, no verdict: at each value {accepted} of {samples} shots may have failed",
            holds(found),
            found.accepted,
            found.samples
        ),
        None => phrase("not known: the page was written before it was found").to_owned(),
    })
}

/// Why observations of earlier shots let no verdict of the page stand; nothing where the verdicts stand.
fn objections_of_observations(page: &Page<'_>) -> Markup {
    html! {
        @let objections = objections::sentences(page.case, page.standing.compared());
        @if !objections.is_empty() {
            @let heading = match page.standing.compared().objections() {
                [] => "Observations of earlier shots are not compared with this plan.",
                _ => "Observations of earlier shots speak against this plan and its verdicts.",
            };
            p { strong { (phrase(heading)) } }
        }
        @for sentence in objections { p { strong { (sentence) } } }
    }
}

/// Words of the page on the option to be fired. Each sheet repeats them, so that a sheet that lies alone is not read as another
/// order.
pub fn firing_instruction(page: &Page<'_>, option: usize) -> String {
    let against = page.against_firing(option);
    let unchecked = if against.is_none() { headline::unchecked(page.case) } else { "" };
    let instruction = phrase(match against {
        None => match (page.word(option), page.to_be_confirmed().len()) {
            (VerdictWord::Thin, 0) => "To be fired, a THIN pass",
            (VerdictWord::Thin, _) => {
                "To be fired only if all that is to be confirmed is right, and a THIN pass"
            }
            (_, 0) => "To be fired",
            _ => "To be fired only if all that is to be confirmed is right",
        },
        Some(Doubt::StandsOnUnknown) => "NOT to be fired, this page is not complete",
        Some(Doubt::FixedStep) => "NOT to be fired, computed at a step that somebody fixed",
        Some(Doubt::OtherDrawsFail) => "NOT to be fired, other draws of the same plan fail",
        Some(doubt) => return forbidding(doubt).unwrap_or_else(|| phrase("NOT to be fired")).to_owned(),
    });
    format!("{instruction}{unchecked}")
}

/// The verdict on an option. A pass has no colour of a pass where nothing may be fired by it.
pub fn verdict_word(page: &Page<'_>, option: usize) -> Markup {
    let verdict_word = page.word(option);
    match is_forbidden_pass(page, option) {
        true => html! { (phrase(verdict_word.for_people())) },
        false => word(verdict_word),
    }
}

/// Whether an option passes but something speaks against firing it.
pub fn is_forbidden_pass(page: &Page<'_>, option: usize) -> bool {
    let against = match page.to_be_fired {
        Some(fired) if fired == option => page.against_firing(option),
        _ => page.against_any(),
    };
    page.word(option).verdict() == Verdict::Pass && against.is_some()
}

/// Words behind a verdict for which no shot was sampled.
pub fn only_planned(page: &Page<'_>) -> &'static str {
    if page.sampling.is_some() {
        ""
    } else {
        phrase(" as planned only, nothing varied: NO permission to fire")
    }
}

/// Facts that the verdict rests on, each with its name.
fn judgement(
    case: &Case,
    shot: &Shot,
    judged: &Judgement,
    verdict_word: VerdictWord,
) -> Vec<(&'static str, String)> {
    let mut facts = vec![("Risk", risk(case, judged))];
    let of_limit = |quantity| {
        let name = match quantity {
            Quantity::Height => "Height",
            Quantity::Force => "Force",
            Quantity::Drift => "Slide",
        };
        Some((name, against_limit(case, judged, quantity)?))
    };
    facts.extend(Quantity::ALL.into_iter().filter_map(of_limit));
    if let Some(sampled) = judged.sampled.known() {
        let shares = input_shares(sampled, &case.limits);
        let inputs = shares.map(|shares| option_sentences::inputs(&shares));
        facts.push(("What decides", inputs.unwrap_or_else(|| say!("too few samples to tell"))));
    }
    facts.extend(
        option_sentences::next_tires(case, judged).into_iter().map(|text| ("Hole between tires", text)),
    );
    facts.extend(option_sentences::dud_of(case, judged).map(|text| ("One dud", text)));
    // This margin stands beside what the pass stands on, so that nobody takes the larger of both. Beside a thin pass it would read
    // as the margin.
    if verdict_word != VerdictWord::Thin {
        facts.push(("Planned shot alone", launch_margin(shot, judged)));
    }
    facts
}

/// Bounds of the share of sampled shots that fail, and the accepted share.
fn risk(case: &Case, judged: &Judgement) -> String {
    let accepted = say!("accepted {} %", units::short(case.plan.limits.accepted_risk_percent));
    match &judged.sampled {
        Evidence::NotAsked => say!("not judged: the plan's own numbers only, nothing varied"),
        Evidence::Known(sampled) => {
            let bounds = &sampled.bounds;
            say!(
                "{} % of the shots fail (95 % bounds; {} of {} samples fail); {accepted}",
                option_sentences::percent_range(bounds.interval),
                bounds.failures,
                bounds.samples,
                accepted
            )
        }
        Evidence::Awaited => {
            say!("not known: no sample was drawn, ended early; {accepted}", accepted)
        }
    }
}

/// How much faster the tires may leave, in words.
fn launch_margin(shot: &Shot, judged: &Judgement) -> String {
    let none = || match judged.launch_margin {
        Some(LaunchMargin::NotPassing) => say!("none: the planned shot does not pass"),
        _ => say!("not computed"),
    };
    option_sentences::launch_limit(shot, judged)
        .map_or_else(none, |limit| say!("with nothing varied it {limit}; scatter leaves less", limit))
}

/// A quantity of the planned shot and of most sampled shots, beside its limit; `None` where the plan has no limit.
fn against_limit(case: &Case, judged: &Judgement, quantity: Quantity) -> Option<String> {
    let limit = case.limits.get(quantity)?;
    let unit = option_sentences::quantity_name(quantity).1;
    let value = |value: f64| format!("{} {}", units::value(value, unit), unit.symbol());
    // The screens show the same number: the signer reads no milder one.
    let sampled = judged.sampled.known();
    let worst = sampled.and_then(|sampled| Some((sampled.deciding_value(quantity)?, sampled.share_above())));
    let possible = worst.map(|(worst, above)| {
        let (worst, one_in) = (worst.max(judged.checked.get(quantity).value), units::one_in(above));
        say!(
            "; 1 in {one_in} is above {}, {} % of the limit",
            one_in,
            value(worst),
            units::whole_percent(worst / limit)
        )
    });
    let planned = judged.checked.get(quantity);
    let with_error =
        format!("{} {}", units::value_by_error(planned.value, planned.error, unit), unit.symbol());
    let against = say!("{} as planned{}; limit {}", with_error, possible.unwrap_or_default(), value(limit));
    Some(if quantity == Quantity::Height { against + phrase(OF_CENTRE) } else { against })
}

/// Note for the signer: the height is the height of a tire's centre.
const OF_CENTRE: &str = "; of a tire's centre, an edge may stand half a diameter higher";

/// Peaks of the planned shot with their errors, places and times, and the bands of its samples.
pub fn peaks(case: &Case, judged: &Judgement) -> Markup {
    let bands = judged.sampled.known().and_then(|sampled| option_sentences::bands(case, sampled));
    html! {
        table.facts {
            tr { th { (phrase("As planned")) } td { (option_sentences::peaks(case.scene(), &judged.checked)) } }
            @if let Some(bands) = bands { tr { th { (phrase("Sampled shots")) } td { (bands) } } }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::FileState;
    use crate::study::assumptions::Assumptions;
    use crate::study::observed::contradiction::Contradiction;
    use crate::study::observed::{Comparison, NotCompared, Objection};
    use crate::study::samples::sample_count::Sampling;
    use crate::study::standing::Standing;
    use crate::study::standing::tests::{case, passing};

    /// A page of two options that are alike.
    struct Two {
        case: Case,
        judged: Judgement,
        compared: Comparison,
        is_sampled: bool,
        /// Whether it is known what the passes stand on: other draws of the plan pass, and no assumption ends the pass.
        is_known: bool,
    }

    impl Two {
        /// Both options pass. The planned shot passes with all launches faster by up to the share `rise`.
        fn passing(rise: f64) -> Self {
            let mut case = case().with_options(&[0, 1]);
            // It is no example with another rope.
            case.plan.ground.friction = 0.51;
            // Nothing taken as exact is to be confirmed.
            let unknown = &mut case.plan.uncertainty;
            (unknown.launch_row_cv_percent, unknown.launch_between_shots_percent) = (1.0, 2.0);
            unknown.launch_common_percent = 10.0;
            (unknown.launch_tilt_common_deg, unknown.hole_fails_percent) = (0.5, 0.01);
            (unknown.hole_position_m, unknown.pattern_offset_m, unknown.cable_length_m) = (0.05, 0.05, 0.01);
            let launch_margin = Some(LaunchMargin::UpTo { rise, above: Verdict::Fail });
            let mut judged = Judgement { launch_margin, ..passing(&case, 500) };
            // No far slide is to be confirmed.
            judged.checked.estimates.drift.value = 0.1;
            Self { case, judged, compared: Comparison::nothing_seen(), is_sampled: true, is_known: true }
        }

        /// Words of the page where the first option is to be fired: the instruction, the box, and both verdicts.
        fn told(&self) -> (String, String, [String; 2]) {
            let results = vec![Ok(self.judged.clone()), Ok(self.judged.clone())];
            let standing = Standing::of(&self.case, FileState::AsJudged, self.compared.clone());
            let (samples, accepted, planned) = (300, 3, Verdict::Pass);
            let found = Assumptions { option: 0, samples, accepted, planned, failing: 0, all: Vec::new() };
            let page = Page {
                case: &self.case,
                results: &results,
                to_be_fired: Some(0),
                sampling: self.is_sampled.then_some(&Sampling::OF_VERDICT),
                stands_on: &[self.is_known.then_some(&found), None],
                sweep: None,
                observed: &[],
                files: &[],
                withdrawn: &[],
                standing: &standing,
                partial: false,
                date: "",
            };
            let verdicts = [0, 1].map(|option| verdict_word(&page, option).into_string());
            (firing_instruction(&page, 0), head(&page, &["it snows".to_owned()]).into_string(), verdicts)
        }
    }

    const COLOURED: &str = "<span class=\"pass\">PASS</span>";

    #[test]
    fn a_pass_that_stands_is_to_be_fired_and_says_what_it_rests_on() {
        let (instruction, head, verdicts) = Two::passing(0.5).told();
        assert_eq!(
            (instruction.as_str(), verdicts),
            ("To be fired, slide NOT checked", [COLOURED.to_owned(), COLOURED.to_owned()])
        );
        for words in [
            COLOURED,
            "<th>Risk</th>",
            "0 of 500 samples fail",
            "<th>Height</th>",
            "as planned; 1 in 100 is above",
            "<th>Planned shot alone</th>",
            "with nothing varied it fails from +51 % launch",
            "<th>Stands on</th>",
            "advice, no verdict",
            "Warning: </strong>it snows",
        ] {
            assert!(head.contains(words), "{words}: {head}");
        }
        assert!(
            !["pass is thin", "THIN", "Do not fire", "as planned only"]
                .iter()
                .any(|words| head.contains(words))
        );
    }

    /// Where no limit judges a far slide, the signer confirms that the ground is clear as far as tires slide.
    #[test]
    fn a_far_slide_that_no_limit_judges_is_confirmed() {
        let mut far = Two::passing(0.5);
        far.judged.checked.estimates.drift.value = 3.6;
        let told = "To be fired only if all that is to be confirmed is right, slide NOT checked";
        assert_eq!(far.told().0, told);
        far.case.limits.drift = Some(4.0);
        assert_eq!(far.told().0, "To be fired");
    }

    /// The box says what ends a thin pass, but not where the pass does not stand.
    #[test]
    fn a_thin_pass_is_said_to_be_one() {
        let thin = Two::passing(0.03);
        let (instruction, head, _) = thin.told();
        assert_eq!(instruction, "To be fired, a THIN pass, slide NOT checked");
        assert!(head.contains("The pass is thin:"), "{head}");
        let (instruction, head, _) =
            Two { compared: Comparison::not_compared(NotCompared::OutOfTime), ..thin }.told();
        assert_eq!(instruction, "NOT to be fired");
        assert!(!head.contains("The pass is thin:") && !head.contains("Stands on"), "{head}");
        assert!(head.contains("are not compared with this plan") && head.contains("Do not fire"), "{head}");
    }

    /// Where it is not known what the pass stands on, the option to be fired loses its colour. The other options keep theirs:
    /// nobody asks what they stand on.
    #[test]
    fn a_pass_on_nobody_knows_what_is_not_to_be_fired() {
        let (instruction, head, verdicts) = Two { is_known: false, ..Two::passing(0.5) }.told();
        assert_eq!(instruction, "NOT to be fired, this page is not complete");
        assert!(head.contains("not known: the page was written before it was found"), "{head}");
        assert!(!head.contains("Do not fire"), "nothing speaks against it: {head}");
        assert_eq!(verdicts, ["PASS", COLOURED]);
    }

    #[test]
    fn what_speaks_against_a_plan_or_fails_takes_the_order_to_fire_away() {
        let against = Objection::Contradiction(Contradiction::Unpredicted { outside: 2, of: 2 });
        let contradicted = Two { compared: Comparison::compared(vec![against]), ..Two::passing(0.5) };
        let (instruction, head, verdicts) = contradicted.told();
        assert_eq!(instruction, "NOT to be fired");
        assert!(head.contains("speak against this plan and its verdicts") && !head.contains("Stands on"));
        let sentences = objections::sentences(&contradicted.case, &contradicted.compared);
        assert!(sentences.len() == 1 && head.contains(&sentences[0]), "{head}");
        assert!(verdicts.iter().all(|verdict| verdict.contains("HOLD")), "{verdicts:?}");
        let mut fails = Two::passing(0.5);
        (fails.judged.checked.verdict, fails.judged.launch_margin) =
            (Verdict::Fail, Some(LaunchMargin::NotPassing));
        let (instruction, head, verdicts) = fails.told();
        assert_eq!(instruction, "NOT to be fired");
        assert!(
            head.contains("none: the planned shot does not pass") && !head.contains("Stands on"),
            "{head}"
        );
        assert!(verdicts.iter().all(|verdict| verdict.contains("class=\"fail\"")), "{verdicts:?}");
    }

    /// The box says why the option does not pass, and that its plan was fitted to observations that are not compared on the page.
    #[test]
    fn an_option_that_does_not_pass_says_why() {
        let mut open = Two::passing(0.5);
        open.judged = passing(&open.case, 100);
        open.case.plan.fitted_from = vec!["ab12".to_owned()];
        let (_, head, _) = open.told();
        let reasons = reasons::sentences(&open.case, &open.judged);
        assert!(
            !reasons.is_empty() && reasons.iter().all(|reason| head.contains(reason)),
            "{reasons:?}: {head}"
        );
        assert!(head.contains("they are not compared with the plan on this page"), "{head}");
    }

    #[test]
    fn a_pass_of_the_planned_shots_alone_says_so_and_has_no_colour() {
        let mut alone = Two { is_sampled: false, ..Two::passing(0.5) };
        alone.judged = Judgement::of_planned_alone(alone.judged.checked);
        let (instruction, head, verdicts) = alone.told();
        assert_eq!(
            (instruction.as_str(), verdicts),
            ("NOT to be fired", ["PASS".to_owned(), "PASS".to_owned()])
        );
        for words in ["as planned only, nothing varied", "nothing varied</td>", "not computed"] {
            assert!(head.contains(words), "{words}: {head}");
        }
        assert!(!head.contains("Stands on") && !head.contains("class=\"pass\""), "{head}");
    }

    #[test]
    fn greatest_values_are_those_of_the_planned_shot_and_of_its_samples() {
        let Two { case, judged, .. } = Two::passing(0.5);
        let told = peaks(&case, &judged).into_string();
        assert!(told.contains("As planned") && told.contains("Sampled shots"), "{told}");
        let told = peaks(&case, &Judgement::of_planned_alone(judged.checked)).into_string();
        assert!(told.contains("As planned") && !told.contains("Sampled shots"), "{told}");
    }
}
