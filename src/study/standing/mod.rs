//! Whether the passes of a plan stand, and whether an option may be fired. These are reasons from outside the options. One rule serves
//! pages, reports, exit codes, names of files and screens.
//!
//! | what | where |
//! |---|---|
//! | what happened to the plan's file | [`plan_file`] |
//! | the word that people read: PASS, THIN, HOLD, OPEN or FAIL | [`verdict_word`] |
//! | whether a plan may take the estimates of a fit | [`writable`] |

pub mod plan_file;
pub mod verdict_word;
pub mod writable;

use super::assumptions::Assumptions;
use super::judge::Judgement;
use super::observed::Comparison;
use super::{Case, FileState};
use crate::verdict::Verdict;

/// A reason against firing an option.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Doubt {
    /// The plan is an example.
    Example,
    /// The plan has no `[uncertainty]`, or only one that a fit wrote.
    NoUncertainty,
    /// `[uncertainty]` does not say how well the launch is known. The launch decides most.
    LaunchUnstated,
    /// A range of `[uncertainty]` leaves out the plan's own value.
    RangeBesidePlan,
    /// Gravity is not that of the earth, so nothing falls like that.
    NotOfEarth,
    /// The plan accepts that more shots fail than anyone should accept.
    AcceptsTooMuch,
    /// The pass of the option is on HOLD.
    Hold(Hold),
    /// No file holds the plan: the file is gone, or the plan came from a pipe. No record of observations can lie beside a pipe.
    NoFile,
    /// The option does not pass.
    NoPass,
    /// The option passes as planned, but no other shot was judged.
    PlannedAlone,
    /// The option passes at a fixed step, which nothing refines.
    FixedStep,
    /// In other draws of the same plan, more shots fail than accepted.
    OtherDrawsFail,
    /// It is not yet known what the pass stands on.
    StandsOnUnknown,
}

/// A reason that puts the passes of a plan on HOLD.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hold {
    /// Observations of earlier shots speak against the plan.
    Contradicted,
    /// Observations of earlier shots are not compared with the plan.
    NotCompared,
    /// The file of the plan has changed.
    FileChanged,
}

/// Whether the passes of a plan stand, and whether they permit firing.
#[derive(Clone, Debug)]
pub struct Standing {
    /// Reasons against every option of the plan.
    of_plan: Vec<Doubt>,
    /// What happened to the file of the plan.
    file: FileState,
    /// The comparison of the plan with observations of earlier shots.
    compared: Comparison,
}

/// Greatest share of shots exceeding a limit that a page may permit, whatever the plan accepts.
const MOST_ACCEPTED: f64 = 0.1;

impl Standing {
    /// The standing of a plan, from the state of its file and its comparison with observations of earlier shots.
    pub fn of(case: &Case, file: FileState, compared: Comparison) -> Self {
        // In the order in which they are reported.
        let each = [
            (Doubt::Example, case.plan.is_example()),
            (Doubt::NoUncertainty, case.plan.uncertainty.assumed),
            (Doubt::LaunchUnstated, case.plan.leaves_launch_unstated()),
            (Doubt::RangeBesidePlan, !case.plan.ranges_beside_the_plan().is_empty()),
            (Doubt::NotOfEarth, !case.plan.has_gravity_of_earth()),
            (Doubt::AcceptsTooMuch, case.limits.accepted_risk > MOST_ACCEPTED),
            (Doubt::Hold(Hold::Contradicted), !compared.objections().is_empty()),
            (Doubt::Hold(Hold::NotCompared), compared.why_not_compared().is_some()),
            (Doubt::Hold(Hold::FileChanged), file == FileState::Changed),
            (Doubt::NoFile, matches!(file, FileState::Gone | FileState::Pipe)),
        ];
        let of_plan = each.into_iter().filter_map(|(doubt, holds)| holds.then_some(doubt)).collect();
        Self { of_plan, file, compared }
    }

    /// The comparison of the plan with observations of earlier shots.
    pub fn compared(&self) -> &Comparison {
        &self.compared
    }

    /// What happened to the file of the plan.
    pub fn file(&self) -> FileState {
        self.file
    }

    /// Whether this reason speaks against every option.
    pub fn has(&self, doubt: Doubt) -> bool {
        self.of_plan.contains(&doubt)
    }

    /// The first reason that puts passes on HOLD; `None` if passes stand and an option may be recommended.
    pub fn against_passes(&self) -> Option<Hold> {
        self.of_plan.iter().find_map(|doubt| match doubt {
            Doubt::Hold(hold) => Some(*hold),
            _ => None,
        })
    }

    /// The verdict as it stands: a pass on HOLD is open.
    pub fn verdict(&self, verdict: Verdict) -> Verdict {
        if self.against_passes().is_none() { verdict } else { verdict.max(Verdict::Undecided) }
    }

    /// The first reason against firing any option; `None` if there is none.
    pub fn against_plan(&self) -> Option<Doubt> {
        self.of_plan.first().copied()
    }

    /// The first reason against firing an option; `None` if the option may be fired. `stands_on` is `None` if it is not known what the pass
    /// stands on.
    pub fn against_firing(
        &self,
        judged: Option<&Judgement>,
        stands_on: Option<&Assumptions>,
    ) -> Option<Doubt> {
        self.against_plan().or_else(|| judged.map_or(Some(Doubt::NoPass), against_full_pass)).or(
            match stands_on {
                None => Some(Doubt::StandsOnUnknown),
                Some(found) if !found.pass_as_stated() => Some(Doubt::OtherDrawsFail),
                Some(_) => None,
            },
        )
    }
}

/// The reason against a full pass; `None` for a full pass. In a full pass, everything asked for passes: the planned shot, the samples, and
/// the fresh draws if the plan has other options.
fn against_full_pass(judged: &Judgement) -> Option<Doubt> {
    match judged.verdict() {
        Verdict::Undecided | Verdict::Fail => Some(Doubt::NoPass),
        Verdict::Pass if !judged.sampled.is_asked() => Some(Doubt::PlannedAlone),
        Verdict::Pass if judged.checked.compute.step.is_some() => Some(Doubt::FixedStep),
        Verdict::Pass => None,
    }
}

impl Judgement {
    /// Whether the option passes with everything asked for.
    pub fn is_full_pass(&self) -> bool {
        against_full_pass(self).is_none()
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::plan::Plan;
    use crate::study::judge::grounds::Evidence;
    use crate::study::judge::one_dud::OneDud;
    use crate::study::observed::contradiction::Contradiction;
    use crate::study::observed::{NotCompared, Objection};
    use crate::study::samples::failure_bounds::ErrorShare;
    use crate::study::samples::random_shot::Input;
    use crate::study::samples::sample::{Sample, SampleRun};
    use crate::study::samples::sampled_shot::SampledShot;
    use crate::study::{ComputeSettings, ShotSummary};

    fn not_compared() -> Comparison {
        Comparison::not_compared(NotCompared::OutOfTime)
    }

    fn saved(case: &Case, compared: Comparison) -> Standing {
        Standing::of(case, FileState::AsJudged, compared)
    }

    const TEXT: &str = include_str!("../../../tests/fixtures/amur-three-rows.toml");

    pub fn case() -> Case {
        let plan = Plan::parse("", TEXT).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        Case::new(Plan { title: Some("a site".to_owned()), ..plan })
    }

    /// A pass is open if the file has changed or observations speak against it. A fail stays a fail. Nothing else puts a pass on HOLD.
    #[test]
    fn only_what_was_seen_and_a_changed_file_take_passes_back() {
        let verdicts = |standing: Standing| {
            [Verdict::Pass, Verdict::Undecided, Verdict::Fail].map(|verdict| standing.verdict(verdict))
        };
        let all = [Verdict::Pass, Verdict::Undecided, Verdict::Fail];
        let none = [Verdict::Undecided, Verdict::Undecided, Verdict::Fail];
        assert_eq!(verdicts(saved(&case(), Comparison::nothing_seen())), all);
        assert_eq!(verdicts(saved(&case(), not_compared())), none);
        for (file, expected) in [(FileState::Changed, none), (FileState::Gone, all), (FileState::Pipe, all)] {
            assert_eq!(verdicts(Standing::of(&case(), file, Comparison::nothing_seen())), expected);
        }
    }

    /// Each reason alone is enough, and none needs a judgement.
    #[test]
    fn whatever_speaks_against_a_plan_is_told_before_its_options_are_looked_at() {
        let nothing = Comparison::nothing_seen;
        let refused = |case: Case, compared| saved(&case, compared).against_firing(None, None);
        assert_eq!(refused(case(), nothing()), Some(Doubt::NoPass));
        let mut example = case();
        example.plan.title = Some("EXAMPLE of a site".to_owned());
        let mut assumed = case();
        assumed.plan.uncertainty.assumed = true;
        assert_eq!(refused(example, nothing()), Some(Doubt::Example));
        assert_eq!(refused(assumed, nothing()), Some(Doubt::NoUncertainty));
        let mut beside = case();
        beside.plan.cable.slack_percent = beside.plan.uncertainty.slack_percent[1] + 1.0;
        assert_eq!(refused(beside, nothing()), Some(Doubt::RangeBesidePlan));
        for (gravity, risk, expected) in
            [(98.1, 0.01, Doubt::NotOfEarth), (9.81, 0.11, Doubt::AcceptsTooMuch), (9.81, 0.1, Doubt::NoPass)]
        {
            let mut senseless = case();
            senseless.plan.simulation.gravity_m_s2 = gravity;
            senseless.limits.accepted_risk = risk;
            assert_eq!(refused(senseless, nothing()), Some(expected), "{gravity} m/s², {risk}");
        }
        assert_eq!(refused(case(), not_compared()), Some(Doubt::Hold(Hold::NotCompared)));
        let fired = Contradiction::Unpredicted { outside: 2, of: 2 };
        let contradicted = Comparison::compared(vec![Objection::Contradiction(fired)]);
        let both = contradicted.clone().with_not_compared(Some(NotCompared::OutOfTime));
        assert_eq!(
            [contradicted, both].map(|compared| refused(case(), compared)),
            [Some(Doubt::Hold(Hold::Contradicted)); 2]
        );
        for (file, doubt) in
            [(FileState::Changed, Doubt::Hold(Hold::FileChanged)), (FileState::Gone, Doubt::NoFile)]
        {
            let standing = Standing::of(&case(), file, nothing());
            assert_eq!(standing.against_firing(None, None), Some(doubt));
        }
    }

    /// An option that passes as planned and by `count` samples.
    pub fn passing(case: &Case, count: usize) -> Judgement {
        sampled(case, count, 0)
    }

    /// An option that passes as planned, with `count` samples. The `failing` ones are spread evenly among them.
    pub fn sampled(case: &Case, count: usize, failing: usize) -> Judgement {
        let mut checked = case.check_as_planned(0, &ComputeSettings::of(&case.plan)).expect("a result");
        (checked.verdict, checked.reasons) = (Verdict::Pass, Vec::new());
        let mut sampled = SampledShot::new(case, None, ErrorShare::Whole, false);
        for number in 0..count {
            let fails = number * failing / count < (number + 1) * failing / count;
            let (verdict, height) = if fails { (Verdict::Fail, 9.0) } else { (Verdict::Pass, 1.0) };
            let (force, drift, uncovering, breaks) = (1.0, 0.0, 0.0, Verdict::Pass);
            let run = SampleRun { verdict, uncovering, breaks, height, tire: 0, force, cable: 0, drift };
            sampled.push(Sample { number, run, finer: None, inputs: [1.0; Input::ALL.len()] });
        }
        Judgement { sampled: Evidence::of(sampled), ..Judgement::of_planned_alone(checked) }
    }

    /// The result of one dud: at `failing` of 15 places the shot exceeds a limit.
    pub fn one_dud(judged: &Judgement, failing: usize) -> OneDud {
        let planned = ShotSummary::of(&judged.checked);
        OneDud { row: 0, number: 0, planned, not_passing: failing, failing, places: 15, sampled: None }
    }

    /// A shot may be fired if it passes as planned and by samples, at steps that are refined, by the draws of the verdict and by others.
    #[test]
    fn only_a_pass_of_all_that_is_asked_for_may_be_fired() {
        let case = case();
        let standing = saved(&case, Comparison::nothing_seen());
        let stands_on = |failing| {
            let (samples, accepted, planned) = (300, 3, Verdict::Pass);
            Assumptions { option: 0, samples, accepted, planned, failing, all: Vec::new() }
        };
        let against = |judged: &Judgement| standing.against_firing(Some(judged), Some(&stands_on(3)));
        let full = passing(&case, 500);
        assert_eq!((against(&full), full.is_full_pass()), (None, true));
        assert_eq!(standing.against_firing(Some(&full), Some(&stands_on(4))), Some(Doubt::OtherDrawsFail));
        assert_eq!(standing.against_firing(Some(&full), None), Some(Doubt::StandsOnUnknown));
        let planned_alone = Judgement::of_planned_alone(full.checked.clone());
        let mut fixed = full.clone();
        fixed.checked.compute.step = Some(1e-3);
        let mut fails = full.clone();
        fails.checked.verdict = Verdict::Fail;
        for (judged, doubt) in [
            (planned_alone, Doubt::PlannedAlone),
            (fixed, Doubt::FixedStep),
            (fails, Doubt::NoPass),
            (passing(&case, 100), Doubt::NoPass),
            (passing(&case, 0), Doubt::NoPass),
            (Judgement { confirmation: Evidence::Awaited, ..full }, Doubt::NoPass),
        ] {
            assert_eq!((against(&judged), judged.is_full_pass()), (Some(doubt), false), "{doubt:?}");
        }
    }

    #[test]
    fn a_plan_has_the_doubts_that_hold_and_no_others() {
        let has = |standing: &Standing| [Doubt::NoFile, Doubt::Example].map(|doubt| standing.has(doubt));
        assert_eq!(has(&Standing::of(&case(), FileState::Pipe, Comparison::nothing_seen())), [true, false]);
        assert_eq!(has(&saved(&case(), Comparison::nothing_seen())), [false, false]);
    }
}
