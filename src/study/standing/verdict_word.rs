//! The word for the verdict on an option. It also says whether the pass is thin and whether it stands. One rule serves rows, first lines,
//! reports, pages and the names of files.

use super::Standing;
use crate::scene::Shot;
use crate::study::as_planned::margin::{LaunchMargin, thin_launch_margin};
use crate::study::assumptions::{Assumption, Assumptions};
use crate::study::judge::Judgement;
use crate::study::judge::one_dud::{OneDud, judge_one_dud};
use crate::study::work::catch_panic;
use crate::study::{Context, NoResult};
use crate::verdict::{Verdict, VerdictWord};

/// What ends a thin pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ThinPass {
    /// Another value of something that the plan takes as known.
    StandsOn(Assumption),
    /// Launches faster than this share, with nothing else varied. For shots that scatter, the limit comes sooner.
    PlannedAlone(f64),
    /// One dud at some of the holes, with nothing else varied. The plan does not ask for this case.
    OneDud {
        /// Holes whose dud makes the shot exceed a limit.
        failing: usize,
        /// Number of all holes.
        places: usize,
    },
}

impl ThinPass {
    /// What ends the thin pass of an option; `None` if the option does not pass, or its pass is not thin as far as known. `stands_on` is
    /// `None` if it is not known what the pass stands on.
    pub fn of(judged: &Judgement, stands_on: Option<&Assumptions>) -> Option<Self> {
        let passes = judged.verdict() == Verdict::Pass;
        let of_assumptions = stands_on.and_then(Self::of_assumptions);
        of_assumptions.or_else(|| Self::of_planned(judged)).filter(|_| passes)
    }

    /// The same by the planned shot alone, whether the option passes or not.
    pub fn of_planned(judged: &Judgement) -> Option<Self> {
        Self::by(judged.launch_margin, judged.one_dud)
    }

    /// The same for a shot that passes, if no judgement of it is kept. If a computation has no result, for example because the time is up,
    /// the pass does not count as thin.
    pub fn of_passing_shot(context: &Context<'_>, shot: &Shot) -> Result<Option<Self>, NoResult> {
        let margin = if_known(|| thin_launch_margin(context, shot, Verdict::Pass))?;
        let one_dud = if_known(|| judge_one_dud(context, shot, None, false))?.flatten();
        Ok(Self::by(margin, one_dud))
    }

    fn by(launch_margin: Option<LaunchMargin>, one_dud: Option<OneDud>) -> Option<Self> {
        let by_launch = launch_margin.filter(|margin| margin.is_thin());
        let by_dud = one_dud.filter(|dud| dud.failing > 0);
        let dud = |OneDud { failing, places, .. }| ThinPass::OneDud { failing, places };
        by_launch.map(|margin| ThinPass::PlannedAlone(margin.rise())).or(by_dud.map(dud))
    }

    /// The same by the assumptions alone.
    pub fn of_assumptions(found: &Assumptions) -> Option<Self> {
        let is_thin = |assumption: &&Assumption| {
            let ends = assumption.fails_from.zip(assumption.assumed.thin_until(assumption.stated));
            ends.is_some_and(|(end, most)| end <= most)
        };
        let thin = found.failing().find(is_thin).filter(|_| found.pass_as_stated())?;
        Some(ThinPass::StandsOn(*thin))
    }
}

/// The result of `find`; `None` if there is none, except after a stop. A pass stays a pass even if it is not known whether it is thin.
pub fn if_known<T>(find: impl FnOnce() -> Result<T, NoResult>) -> Result<Option<T>, NoResult> {
    match catch_panic(find) {
        Err(NoResult::Stopped) => Err(NoResult::Stopped),
        found => Ok(found.ok()),
    }
}

impl Judgement {
    /// The word for the verdict. `stands_on` is `None` if it is not known what a pass stands on.
    pub fn word(&self, stands_on: Option<&Assumptions>) -> VerdictWord {
        match ThinPass::of(self, stands_on) {
            Some(_) => VerdictWord::Thin,
            None => self.verdict().into(),
        }
    }
}

impl Standing {
    /// The word for an option; OPEN without a judgement. `stands_on` is `None` if it is not known what the pass stands on.
    pub fn word(&self, judged: Option<&Judgement>, stands_on: Option<&Assumptions>) -> VerdictWord {
        let Some(judged) = judged else { return VerdictWord::Open };
        let word = judged.word(stands_on);
        let other_draws_fail = stands_on.is_some_and(|found| !found.pass_as_stated());
        if self.against_passes().is_some() || other_draws_fail { word.held() } else { word }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::FileState;
    use crate::study::as_planned::margin::{LaunchMargin, THIN_LAUNCH};
    use crate::study::assumptions::assumed::{Assumed, Spread, Toward};
    use crate::study::observed::Comparison;
    use crate::study::standing::tests::{case, one_dud, passing};

    #[test]
    fn a_pass_is_thin_up_to_five_percent_of_launch_or_two_centimetres() {
        let is_thin = |assumed, stated, fails_from| {
            let (passes_until, fails_from) = (Some(stated), Some(fails_from));
            let only =
                Assumption { assumed, stated, passes_until, fails_from, ratio: None, is_complete: true };
            let (planned, accepted, all) = (Verdict::Pass, 3, vec![only]);
            let found = Assumptions { option: 0, samples: 300, accepted, planned, failing: 0, all };
            ThinPass::of_assumptions(&found) == Some(ThinPass::StandsOn(only))
        };
        for (assumed, stated, last) in [
            (Assumed::LaunchVelocity, 1.0, 1.05),
            (Assumed::Place(Toward::PlusX), 0.0, 0.02),
            (Assumed::Spread(Spread::CableLength), 0.5, 0.5 + 0.02),
            (Assumed::Spread(Spread::HolePosition), 0.125, 0.125 + 0.02),
            (Assumed::Spread(Spread::PatternOffset), 0.0, 0.02),
        ] {
            assert!(is_thin(assumed, stated, last), "{assumed:?}");
            assert!(!is_thin(assumed, stated, last + 1e-6), "{assumed:?}");
        }
        assert!(!is_thin(Assumed::Spread(Spread::Tilt), 1.0, 1.001), "what has no margin of its own");
    }

    /// A pass that slightly faster launches end is thin, unless a nearer end is known. If the pass is on HOLD, or other draws of the plan
    /// fail, the word does not say that the option passes.
    #[test]
    fn a_word_is_thin_of_a_thin_pass_that_stands_and_hold_of_one_that_does_not() {
        let case = case();
        let with = |launch_margin| Judgement { launch_margin, ..passing(&case, 500) };
        let up_to = |rise| with(Some(LaunchMargin::UpTo { rise, above: Verdict::Fail }));
        let (thin, thick) = (up_to(THIN_LAUNCH), up_to(THIN_LAUNCH + 1e-9));
        assert_eq!(ThinPass::of(&thin, None), Some(ThinPass::PlannedAlone(THIN_LAUNCH)));
        for judged in [&thick, &with(None), &with(Some(LaunchMargin::BeyondTried))] {
            assert_eq!((ThinPass::of(judged, None), judged.word(None)), (None, VerdictWord::Pass));
        }
        let without = |failing| Judgement { one_dud: Some(one_dud(&thick, failing)), ..thick.clone() };
        assert_eq!(ThinPass::of(&without(2), None), Some(ThinPass::OneDud { failing: 2, places: 15 }));
        assert_eq!(without(0).word(None), VerdictWord::Pass, "open is not past a limit");
        let few = Judgement { sampled: passing(&case, 100).sampled, ..thin.clone() };
        assert_eq!((ThinPass::of(&few, None), few.word(None)), (None, VerdictWord::Open));
        let stands_on = |failing| {
            let (samples, accepted, planned) = (300, 3, Verdict::Pass);
            Assumptions { option: 0, samples, accepted, planned, failing, all: Vec::new() }
        };
        let stands = Standing::of(&case, FileState::AsJudged, Comparison::nothing_seen());
        let changed = Standing::of(&case, FileState::Changed, Comparison::nothing_seen());
        let words = |judged| {
            let by = |standing: &Standing, failing| standing.word(Some(judged), Some(&stands_on(failing)));
            [
                by(&stands, 3),
                by(&stands, 4),
                by(&changed, 3),
                by(&changed, 4),
                stands.word(Some(judged), None),
            ]
        };
        let hold = VerdictWord::Hold;
        assert_eq!(words(&thin), [VerdictWord::Thin, hold, hold, hold, VerdictWord::Thin]);
        assert_eq!(words(&thick), [VerdictWord::Pass, hold, hold, hold, VerdictWord::Pass]);
        assert_eq!(words(&few), [VerdictWord::Open; 5]);
        assert_eq!(stands.word(None, None), VerdictWord::Open);
    }
}
