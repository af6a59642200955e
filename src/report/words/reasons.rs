//! Why an option does not pass, in words: one sentence per reason, and a few words where a screen has one line for all reasons.

use super::option_sentences::{self, kg_to_the_gram, quantity_name};
use crate::choice::Accuracy;
use crate::report::language::{phrase, say};
use crate::report::parts::Detail;
use crate::study::as_planned::shot_reason::{EarlyEnd, ShotReason};
use crate::study::judge::Judgement;
use crate::study::judge::Reason;
use crate::study::samples::failure_bounds::FailureBounds;
use crate::study::samples::risk_reason::RiskReason;
use crate::study::samples::sample::SampleRun;
use crate::study::samples::sampled_shot::SampledShot;
use crate::study::{Case, ComputeSettings};
use crate::units::{self, value_and_error};
use crate::verdict::{Quantity, Verdict};

/// Why nothing passes on an estimated launch.
const LAUNCH_ESTIMATED: &str =
    "the launch velocity is an estimate that nobody observed: film a shot or a test tire";

/// The same in few words.
const FILM_ONE: &str = "launch estimated: film one";

/// A reason in words.
#[derive(Clone, Debug, PartialEq)]
pub struct ReasonWords {
    /// In few words, beside the count of failing shots; `None` where that count says it.
    pub brief: Option<String>,
    /// Whether a finer accuracy helps.
    pub needs_finer_accuracy: bool,
    /// In one sentence.
    pub sentence: String,
}

impl ReasonWords {
    fn new(brief: impl Into<String>, sentence: String) -> Self {
        Self { brief: Some(brief.into()), needs_finer_accuracy: false, sentence }
    }

    fn said_by_count(sentence: String) -> Self {
        Self { brief: None, needs_finer_accuracy: false, sentence }
    }

    fn step_too_long(brief: &str, sentence: String) -> Self {
        Self { needs_finer_accuracy: true, ..Self::new(brief, sentence) }
    }
}

/// Why an option does not pass; empty for a pass.
pub fn details(case: &Case, judged: &Judgement) -> Vec<Detail> {
    let detail =
        |reason: &Reason| Detail { verdict: reason.verdict(), text: words(case, judged, reason).sentence };
    judged.reasons().iter().map(detail).collect()
}

/// Why an option does not pass, without the verdict of each reason.
pub fn sentences(case: &Case, judged: &Judgement) -> Vec<String> {
    details(case, judged).into_iter().map(|detail| detail.text).collect()
}

/// A reason of an option in words.
pub fn words(case: &Case, judged: &Judgement, reason: &Reason) -> ReasonWords {
    match (reason, judged.sampled.known()) {
        (Reason::AsPlanned(reason), _) => of_shot(reason),
        (Reason::OneDud(verdict), _) => {
            let fails = *verdict == Verdict::Fail;
            let brief = if fails { "one dud exceeds a limit" } else { "one dud: not known yet" };
            let sentence = match judged.one_dud {
                Some(one_dud) => option_sentences::one_dud(case, &one_dud),
                None => say!("whether it withstands one dud is not known: ended early"),
            };
            ReasonWords::new(brief, sentence)
        }
        (Reason::NotConfirmed { failures, samples }, _) => ReasonWords::new(
            format!("not confirmed: {failures} of {samples} new shots fail"),
            say!("fresh draws do not confirm it: {failures} of {samples} more shots fail", failures, samples),
        ),
        (Reason::AwaitsConfirmation, _) => {
            ReasonWords::new("new shots are to confirm it", say!("fresh draws are still to confirm it"))
        }
        (Reason::Samples(reason), Some(sampled)) => of_risk(case, &judged.checked.compute, sampled, *reason),
        (Reason::Samples(RiskReason::LaunchEstimated), None) => {
            ReasonWords::new(FILM_ONE, phrase(LAUNCH_ESTIMATED).to_owned())
        }
        (Reason::Samples(_) | Reason::NoSamples, _) => {
            ReasonWords::new("no shot was tried: ended early", say!("no sample was drawn: ended early"))
        }
    }
}

/// End of the sentence for holes under no tire, with the remedy.
const UNDER_NO_TIRE: &str = "under no tire, and nothing holds what comes out: move the shelter over it, and never leave a hole out of the plan to get a PASS";

/// End of the sentence for holes whose tires have moved away, with the remedy.
const MOVED_AWAY: &str = "where no tire lies any more, since earlier holes threw the tires up or aside: other delays, or more friction or ballast";

/// Why the planned shot does not pass.
fn of_shot(reason: &ShotReason) -> ReasonWords {
    let (quantity, verdict, estimate, limit) = match reason {
        ShotReason::Limit { quantity, verdict, estimate, limit } => (quantity, *verdict, estimate, limit),
        ShotReason::NotSure { quantity, estimate, limit } => (quantity, Verdict::Pass, estimate, limit),
        ShotReason::Broken(1) => {
            return ReasonWords::new("a cable breaks as planned", say!("a cable breaks"));
        }
        ShotReason::Broken(count) => {
            let brief = format!("{count} cables break as planned");
            return ReasonWords::new(brief, say!("{count} cables break", count));
        }
        ShotReason::HolesTogether { holes, limit } => {
            return ReasonWords::new(
                format!("{holes} holes fire within 8 ms, limit {limit}"),
                say!("{holes} holes fire within 8 ms, the limit is {limit}", holes, limit),
            );
        }
        ShotReason::ChargeTogether { charge, limit } => {
            return ReasonWords::new(
                format!("{} kg fire within 8 ms, limit {limit} kg", kg_to_the_gram(*charge)),
                say!("{} kg fire within 8 ms, the limit is {limit} kg", kg_to_the_gram(*charge), limit),
            );
        }
        ShotReason::UnderNoTire(holes) => {
            let sentence = match holes {
                1 => say!("1 hole lies {UNDER_NO_TIRE}", phrase(UNDER_NO_TIRE)),
                _ => say!("{holes} holes lie {UNDER_NO_TIRE}", holes, phrase(UNDER_NO_TIRE)),
            };
            return ReasonWords::new(format!("holes under no tire: {holes}"), sentence);
        }
        ShotReason::TiresMovedAway(holes) => {
            let sentence = match holes {
                1 => say!("1 hole fires {MOVED_AWAY}", phrase(MOVED_AWAY)),
                _ => say!("{holes} holes fire {MOVED_AWAY}", holes, phrase(MOVED_AWAY)),
            };
            return ReasonWords::new(format!("holes that fire under no tire: {holes}"), sentence);
        }
        ShotReason::EnergyResidual(residual) => {
            let residual = units::percent(*residual, 1);
            return ReasonWords::step_too_long(
                "step too long",
                say!(
                    "the energy balance is off by {residual}: the step is too long for this motion",
                    residual
                ),
            );
        }
        ShotReason::EndsEarly { end, open } => {
            let brief = "the run ends too early: longer duration_s";
            return ReasonWords::new(brief, ends_early(*end, *open));
        }
    };
    let (name, unit) = quantity_name(*quantity);
    let value = value_and_error(estimate.value, estimate.error, unit);
    let (limit, symbol) = (units::exact(*limit, unit), unit.symbol());
    let too_near = format!("planned {name} too near its limit");
    match verdict {
        Verdict::Fail => ReasonWords::new(
            format!("planned {name} exceeds its limit"),
            say!("{name} {value} {symbol} is over the limit of {limit} {symbol}", name, value, symbol, limit),
        ),
        Verdict::Pass => ReasonWords::new(
            too_near,
            say!(
                "{name} {value} {symbol} keeps the limit of {limit} {symbol}, but a pass must also stand with three times its error",
                name,
                value,
                symbol,
                limit
            ),
        ),
        Verdict::Undecided => ReasonWords::new(
            too_near,
            say!(
                "{name} {value} {symbol} is too near the limit of {limit} {symbol} to tell",
                name,
                value,
                symbol,
                limit
            ),
        ),
    }
}

/// Why the sampled shots pass: `0 of 500 sampled shots fail, surely fewer than the 1 % accepted`.
pub fn pass(sampled: &SampledShot) -> String {
    let FailureBounds { failures, samples, accepted, .. } = sampled.bounds;
    let accepted = units::short(1e2 * accepted);
    say!(
        "{failures} of {samples} sampled shots fail, surely fewer than the {accepted} % accepted",
        failures,
        samples,
        accepted
    )
}

/// Why the sampled shots do not pass.
fn of_risk(case: &Case, compute: &ComputeSettings, sampled: &SampledShot, reason: RiskReason) -> ReasonWords {
    let accepted = format!("{} %", units::short(case.plan.limits.accepted_risk_percent));
    let (failures, samples) = (sampled.bounds.failures, sampled.bounds.samples);
    let shots = say!(
        "{failures} of {samples} sampled shots fail{}",
        failures,
        samples,
        limits_exceeded(case, sampled)
    );
    let can_be_finer = compute.step.is_none() && compute.accuracy != Accuracy::Reference;
    let finer = if can_be_finer { phrase("; choose accuracy \"reference\"") } else { "" };
    match reason {
        RiskReason::TooManyFail => ReasonWords::said_by_count(say!(
            "{shots}, surely more than the {accepted} accepted",
            shots,
            accepted
        )),
        RiskReason::PlannedExceedsSamples => ReasonWords::step_too_long(
            FINER_RUNS_CONTRADICT,
            say!(
                "the planned shot lies above all samples: the step of samples is too long for this motion{finer}",
                finer
            ),
        ),
        RiskReason::FinerRunsDisagree => ReasonWords::step_too_long(
            FINER_RUNS_CONTRADICT,
            say!("{shots}, but finer runs contradict them{finer}", shots, finer),
        ),
        RiskReason::FewAudited => ReasonWords::new(
            "too few shots run at a finer step",
            say!("{shots}, but too few of them are run at a finer step, too: draw 200 or more", shots),
        ),
        RiskReason::LaunchEstimated => {
            ReasonWords::new(FILM_ONE, format!("{}; {}", pass(sampled), phrase(LAUNCH_ESTIMATED)))
        }
        RiskReason::UndecidedSamples => match (sampled.uncovered(), sampled.bounds.undecided) {
            (0, undecided) => ReasonWords::new(
                format!("{undecided} shots undecided"),
                say!(
                    "{shots} and {undecided} stay undecided: not surely fewer than the {accepted} accepted",
                    shots,
                    undecided,
                    accepted
                ),
            ),
            (uncovered, _) => ReasonWords::new(
                format!("{uncovered} shots: a hole under no tire"),
                say!(
                    "{shots}, and in {uncovered} more a hole fires under no tire: not surely fewer than the {accepted} accepted",
                    shots,
                    uncovered,
                    accepted
                ),
            ),
        },
        RiskReason::NotSure => ReasonWords::said_by_count(say!(
            "{shots}, not surely fewer than the {accepted} accepted",
            shots,
            accepted
        )),
    }
}

/// Few words for finer runs that show another risk.
const FINER_RUNS_CONTRADICT: &str = "finer runs contradict";

/// Number of samples that exceed each limit, and in which a cable breaks and is gone: ` (flight height 3, a cable breaks 16)`.
fn limits_exceeded(case: &Case, sampled: &SampledShot) -> String {
    let count = |quantity: Quantity| {
        let limit = case.limits.get(quantity)?;
        let is_past =
            |run: &SampleRun, quantity, limit| run.verdict != Verdict::Undecided && run.get(quantity) > limit;
        let past = sampled.samples.iter().filter(|sample| is_past(sample.finest(), quantity, limit)).count();
        (past > 0).then(|| format!("{} {past}", quantity_name(quantity).0))
    };
    let broken = sampled.samples.iter().filter(|sample| sampled.broke_a_cable(sample.finest())).count();
    let broken = (broken > 0).then(|| say!("a cable breaks {broken}", broken));
    let words: Vec<String> = Quantity::ALL.into_iter().filter_map(count).chain(broken).collect();
    if words.is_empty() { String::new() } else { format!(" ({})", words.join(", ")) }
}

/// Sentence for a run that ends too early.
fn ends_early(end: f64, open: EarlyEnd) -> String {
    let end = units::seconds(end);
    match open {
        EarlyEnd::HolesUnfired(last) => {
            say!(
                "the run ends at {end}, before the last hole fires at {}: give a longer duration_s",
                end,
                units::seconds(last)
            )
        }
        EarlyEnd::TiresInAir => {
            say!("the run ends at {end} with tires in the air: give a longer duration_s, or none", end)
        }
        EarlyEnd::ForceGrowing => {
            say!("the run ends at {end} with force at its greatest: give a longer duration_s, or none", end)
        }
        EarlyEnd::TiresMoving => {
            say!("tires still move at {end} and may pull harder later: give a longer duration_s", end)
        }
    }
}
