//! The studies that the terminal offers, with the settings that it gives them.

use std::time::Duration;

use super::Job;
use crate::choice::Unknown;
use crate::plan::observations::Observations;
use crate::study::assumptions::{self, Assumptions, Extent, find_assumptions};
use crate::study::effects::{EffectsOnOptions, SAMPLES, effects};
use crate::study::fit::observation_bands::{Prediction, predict_observations};
use crate::study::fit::observed_shots::ObservedShots;
use crate::study::fit::{FitRequest, FitResult, fit};
use crate::study::flight::{Flight, record};
use crate::study::judge_options::OptionResults;
use crate::study::orders::{Orders, orders};
use crate::study::remedies::{Remedies, find_remedies};
use crate::study::samples::sample_count::Sampling;
use crate::study::search::{Search, search};
use crate::study::size::{Demand, Sizing, size};
use crate::study::sweep::{DEFAULT_INTERVALS, Sweep, sweep};
use crate::study::{Computed, NoResult, accuracy};

/// Declares the kinds of studies and the list of all of them, in one order.
macro_rules! study_kinds {
    ($( $(#[$about:meta])* $kind:ident, )+) => {
        /// A study that the terminal offers.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum StudyKind {
            $( $(#[$about])* $kind, )+
        }

        impl StudyKind {
            /// Every kind, in the order of declaration.
            pub const ALL: [StudyKind; [$(StudyKind::$kind),+].len()] = [$(StudyKind::$kind),+];
        }
    };
}

study_kinds! {
    /// Intervals from 0 to 500 ms, rows in the order listed.
    Sweep,
    /// All orders at the intervals of the delay options.
    Orders,
    /// Two thousand samples of every option.
    Risk,
    /// The schedules with the least risk.
    Search,
    /// The lightest shelter under which every option passes.
    Size,
    /// Which effects the scene requires.
    Effects,
    /// Launch velocities from what was seen of earlier shots.
    Fit,
    /// What the pass of one option stands on.
    Assumptions,
    /// The motion of one option.
    Flight,
    /// The cost of accuracy, measured on one option.
    Accuracy,
    /// The changes of the plan with which one option would pass.
    Remedies,
}

impl StudyKind {
    /// The kinds that have a tab, in the order of their tabs.
    pub const TABS: [StudyKind; 8] = [
        StudyKind::Sweep,
        StudyKind::Orders,
        StudyKind::Risk,
        StudyKind::Search,
        StudyKind::Size,
        StudyKind::Effects,
        StudyKind::Fit,
        StudyKind::Assumptions,
    ];
}

/// Result of a study.
#[derive(Clone, Debug)]
pub enum StudyResult {
    /// Result of [`StudyKind::Sweep`].
    Sweep(Computed<Sweep>),
    /// Result of [`StudyKind::Orders`].
    Orders(Computed<Orders>),
    /// Result of [`StudyKind::Risk`].
    Risk(Sampling, Computed<OptionResults>),
    /// Result of [`StudyKind::Search`].
    Search(Box<Computed<Search>>),
    /// Result of [`StudyKind::Size`].
    Size(Sizing),
    /// Result of [`StudyKind::Effects`].
    Effects(Computed<EffectsOnOptions>),
    /// Result of [`StudyKind::Fit`].
    Fit(Box<ComparedWithSeen>),
    /// Result of [`StudyKind::Assumptions`].
    Assumptions(Computed<Assumptions>),
    /// Result of [`StudyKind::Flight`].
    Flight(Box<Flight>),
    /// Result of [`StudyKind::Accuracy`].
    Accuracy(accuracy::AccuracyTable),
    /// Result of [`StudyKind::Remedies`].
    Remedies(Remedies),
}

/// What was seen of earlier shots, beside what the plan says of it.
#[derive(Clone, Debug)]
pub struct ComparedWithSeen {
    /// The fit of what the plan was not fitted to yet; `None` where it was fitted to all.
    pub fitted: Option<FitResult>,
    /// The observations that it is of.
    pub new: Vec<Observations>,
    /// The shots that the plan was fitted to: what was seen of them.
    pub in_plan: ObservedShots,
    /// What the plan says now of each of these observations.
    pub predictions: Vec<Prediction>,
}

/// Samples of every option.
const RISK_SAMPLING: Sampling = Sampling::OF_RISK;
/// Samples of a study of effects.
const EFFECTS_SAMPLING: Sampling = Sampling::exactly(SAMPLES, Sampling::OF_RISK.seed);
/// Samples of each value of an assumption.
pub(super) const ASSUMPTIONS_SAMPLING: Sampling =
    Sampling::exactly(assumptions::SAMPLES, Sampling::OF_VERDICT.seed);
/// Longest run that [`StudyKind::Accuracy`] makes.
const LONGEST_RUN: Duration = Duration::from_secs(1);

impl Job {
    pub(super) fn study(&self, kind: StudyKind, option: usize) -> Result<StudyResult, NoResult> {
        let context = &self.context().with_sampling(Sampling::OF_VERDICT);
        let case = context.case;
        // Where the options differ in how the holes of a row fire, the selected one is meant.
        let with_holes = || case.with_hole_timing_defaulting_to(option);
        match kind {
            StudyKind::Sweep => {
                let order: Vec<usize> = (0..case.plan.blast_rows.len()).collect();
                let swept = sweep(&context.with_case(&with_holes()), &order, &DEFAULT_INTERVALS)?;
                Ok(StudyResult::Sweep(swept))
            }
            StudyKind::Orders => {
                let case = with_holes();
                Ok(StudyResult::Orders(orders(&context.with_case(&case), &case.intervals())?))
            }
            StudyKind::Risk => {
                let results = context.with_sampling(RISK_SAMPLING).sample_options()?;
                Ok(StudyResult::Risk(RISK_SAMPLING, results))
            }
            StudyKind::Search => Ok(StudyResult::Search(Box::new(search(context)?))),
            StudyKind::Size => {
                let demand = Demand::Options((0..case.shots.len()).collect());
                Ok(StudyResult::Size(size(context, &case.plan.size, &demand)?.expect_complete()))
            }
            StudyKind::Effects => {
                Ok(StudyResult::Effects(effects(&context.with_sampling(EFFECTS_SAMPLING))?))
            }
            StudyKind::Fit => {
                let is_in_plan = |file: &Observations| file.was_fitted(&case.plan.fitted_from);
                let (in_plan, new): (Vec<_>, Vec<_>) = self.observed.iter().cloned().partition(is_in_plan);
                let request = FitRequest { files: &new, unknowns: &[Unknown::Launch] };
                let fitted = match new.is_empty() {
                    true => None,
                    false => Some(fit(context, &request)?.expect_complete()),
                };
                let in_plan = ObservedShots::new(&in_plan);
                let predictions = predict_observations(context, &in_plan)?;
                Ok(StudyResult::Fit(Box::new(ComparedWithSeen { fitted, new, in_plan, predictions })))
            }
            StudyKind::Assumptions => {
                let context = context.with_sampling(ASSUMPTIONS_SAMPLING);
                Ok(StudyResult::Assumptions(find_assumptions(&context, option, Extent::All)?))
            }
            StudyKind::Flight => Ok(StudyResult::Flight(Box::new(record(context, option, self.sample)?))),
            StudyKind::Accuracy => {
                Ok(StudyResult::Accuracy(accuracy::measure(context, option, LONGEST_RUN)?.expect_complete()))
            }
            StudyKind::Remedies => {
                Ok(StudyResult::Remedies(find_remedies(context, option)?.expect_complete()))
            }
        }
    }
}
