//! The grounds of a verdict on a shot, and the verdict. Every study, command and screen takes its verdicts from here.
//!
//! No shot passes on a launch velocity that nobody observed. A blast plan bounds the velocity only within a factor of two or three. Samples
//! drawn about such a guess prove nothing. `Uncertainty::launch_is_estimated` says whether a plan has one.

use crate::verdict::Verdict;

/// The result of one ground of a verdict beside the planned shot: samples, one dud or fresh draws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Evidence<R> {
    /// It was not asked for.
    NotAsked,
    /// It was asked for but is not known: it is still being computed, or the time was up.
    Awaited,
    /// The result.
    Known(R),
}

impl<R> Evidence<R> {
    /// Evidence that is not known yet: awaited if `is_asked`, else not asked for.
    pub fn asked_if(is_asked: bool) -> Self {
        if is_asked { Evidence::Awaited } else { Evidence::NotAsked }
    }

    /// The result; `None` if it was not asked for, or is not known.
    pub fn known(&self) -> Option<&R> {
        match self {
            Evidence::Known(told) => Some(told),
            Evidence::NotAsked | Evidence::Awaited => None,
        }
    }

    /// Whether it was asked for.
    pub fn is_asked(&self) -> bool {
        !matches!(self, Evidence::NotAsked)
    }

    /// The same evidence, with `change` applied to its result.
    pub fn map<'r, T>(&'r self, change: impl FnOnce(&'r R) -> T) -> Evidence<T> {
        match self {
            Evidence::NotAsked => Evidence::NotAsked,
            Evidence::Awaited => Evidence::Awaited,
            Evidence::Known(told) => Evidence::Known(change(told)),
        }
    }
}

impl Evidence<Verdict> {
    /// The best verdict that the evidence allows: a pass if not asked for, undecided if awaited, else its own verdict.
    fn allows(self) -> Verdict {
        match self {
            Evidence::NotAsked => Verdict::Pass,
            Evidence::Awaited => Verdict::Undecided,
            Evidence::Known(verdict) => verdict,
        }
    }
}

/// One of the grounds of a verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ground {
    /// The planned shot.
    Planned,
    /// The samples of `[uncertainty]`, and whether the launch velocity that they are drawn about was observed.
    Samples,
    /// Any one dud.
    OneDud,
    /// Fresh draws.
    Confirmation,
}

/// The grounds of a verdict on one shot. They become known in this order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grounds {
    /// The planned shot.
    pub planned: Verdict,
    /// Whether the launch velocity is an estimate that nobody observed.
    pub launch_is_estimated: bool,
    /// The samples of `[uncertainty]`.
    pub samples: Evidence<Verdict>,
    /// Any one dud, if the plan makes that part of the verdict.
    pub one_dud: Evidence<Verdict>,
    /// Fresh draws, for a shot that was chosen among several. They can refute a pass, but never prove a fail.
    pub confirmation: Evidence<Verdict>,
}

impl Grounds {
    /// The grounds that keep the shot from a pass, each with its verdict; empty for a pass. Both the verdict and the reasons come from this
    /// list. Fresh draws never prove a fail. They count only if no other ground speaks against a pass.
    pub fn against_pass(&self) -> Vec<(Ground, Verdict)> {
        let launch = if self.launch_is_estimated { Verdict::Undecided } else { Verdict::Pass };
        let first = [
            (Ground::Planned, self.planned),
            (Ground::Samples, self.samples.allows().max(launch)),
            (Ground::OneDud, self.one_dud.allows()),
        ];
        let last = (Ground::Confirmation, self.confirmation.allows().min(Verdict::Undecided));
        let is_against = |(_, verdict): &(Ground, Verdict)| *verdict != Verdict::Pass;
        let mut against: Vec<_> = first.into_iter().filter(is_against).collect();
        if against.is_empty() {
            against.extend(Some(last).filter(is_against));
        }
        against
    }

    /// The verdict. It is a pass only if everything asked for passes and the launch velocity was observed. It is a fail if the planned
    /// shot, its samples or one dud fail.
    pub fn verdict(&self) -> Verdict {
        Verdict::worst(self.against_pass().into_iter().map(|(_, verdict)| verdict))
    }

    /// The verdict without fresh draws.
    pub fn before_confirmation(&self) -> Verdict {
        Self { confirmation: Evidence::NotAsked, ..*self }.verdict()
    }

    /// The verdict without one dud and fresh draws.
    pub fn before_one_dud(&self) -> Verdict {
        Self { one_dud: Evidence::NotAsked, ..*self }.before_confirmation()
    }

    /// Whether the shot passes so far, and one dud is the next ground to judge.
    pub fn awaits_one_dud(&self) -> bool {
        matches!(self.one_dud, Evidence::Awaited) && self.before_one_dud() == Verdict::Pass
    }

    /// Whether the shot passes on all other grounds, and only fresh draws are awaited.
    pub fn awaits_confirmation(&self) -> bool {
        matches!(self.confirmation, Evidence::Awaited) && self.before_confirmation() == Verdict::Pass
    }
}

#[cfg(test)]
mod tests {
    use itertools::iproduct;

    use super::*;

    const VERDICTS: [Verdict; 3] = [Verdict::Pass, Verdict::Undecided, Verdict::Fail];
    const EVIDENCE: [Evidence<Verdict>; 5] = [
        Evidence::NotAsked,
        Evidence::Awaited,
        Evidence::Known(Verdict::Pass),
        Evidence::Known(Verdict::Undecided),
        Evidence::Known(Verdict::Fail),
    ];

    /// All 3 × 2 × 5 × 5 × 5 grounds.
    fn all() -> impl Iterator<Item = Grounds> {
        iproduct!(VERDICTS, [false, true], EVIDENCE, EVIDENCE, EVIDENCE).map(
            |(planned, launch_is_estimated, samples, one_dud, confirmation)| Grounds {
                planned,
                launch_is_estimated,
                samples,
                one_dud,
                confirmation,
            },
        )
    }

    #[test]
    fn a_pass_is_one_of_all_that_was_asked_for_on_an_observed_launch() {
        let passes = |evidence| matches!(evidence, Evidence::NotAsked | Evidence::Known(Verdict::Pass));
        for grounds in all() {
            let Grounds { planned, launch_is_estimated, samples, one_dud, confirmation } = grounds;
            let all_pass = [samples, one_dud, confirmation].into_iter().all(passes);
            let is_pass = planned == Verdict::Pass && !launch_is_estimated && all_pass;
            assert_eq!(grounds.verdict() == Verdict::Pass, is_pass, "{grounds:?}");
        }
    }

    #[test]
    fn a_fail_is_one_of_the_shot_as_planned_of_its_samples_or_of_one_dud() {
        let fails = |evidence| evidence == Evidence::Known(Verdict::Fail);
        for grounds in all() {
            let Grounds { planned, samples, one_dud, .. } = grounds;
            let is_fail = planned == Verdict::Fail || fails(samples) || fails(one_dud);
            assert_eq!(grounds.verdict() == Verdict::Fail, is_fail, "{grounds:?}");
        }
    }

    /// One dud counts for a shot that passes as planned and by its samples, whatever is known of the dud and of fresh draws.
    #[test]
    fn one_dud_is_asked_of_what_passes_without_it() {
        for grounds in all() {
            let Grounds { planned, launch_is_estimated, samples, .. } = grounds;
            let samples_pass = matches!(samples, Evidence::NotAsked | Evidence::Known(Verdict::Pass));
            let is_asked = planned == Verdict::Pass && !launch_is_estimated && samples_pass;
            assert_eq!(grounds.before_one_dud() == Verdict::Pass, is_asked, "{grounds:?}");
        }
    }

    #[test]
    fn fresh_draws_are_awaited_by_what_passes_without_them() {
        for grounds in all() {
            let passes_with = Grounds { confirmation: Evidence::Known(Verdict::Pass), ..grounds };
            let is_missing = grounds.confirmation == Evidence::Awaited;
            let awaits = is_missing && passes_with.verdict() == Verdict::Pass;
            assert_eq!(grounds.awaits_confirmation(), awaits, "{grounds:?}");
        }
    }

    #[test]
    fn one_dud_is_awaited_by_what_passes_without_it() {
        for grounds in all() {
            let awaits = grounds.one_dud == Evidence::Awaited && grounds.before_one_dud() == Verdict::Pass;
            assert_eq!(grounds.awaits_one_dud(), awaits, "{grounds:?}");
        }
    }

    #[test]
    fn what_is_asked_for_is_known_or_awaited() {
        let told: Vec<_> = EVIDENCE.iter().map(|told| (told.is_asked(), told.known().copied())).collect();
        let known = VERDICTS.map(|verdict| (true, Some(verdict)));
        assert_eq!(told, [&[(false, None), (true, None)], &known[..]].concat());
        assert_eq!([false, true].map(Evidence::<()>::asked_if), [Evidence::NotAsked, Evidence::Awaited]);
    }
}
