//! The questions that the terminal asks, with the settings that it gives them.

use std::time::Duration;

use crate::choice::Unknown;
use crate::plan::observations::Observations;
use crate::study::assumptions::{self, Extent};
use crate::study::question::{Asked, Question, StudyKind};
use crate::study::samples::sample_count::Sampling;
use crate::study::size::Demand;
use crate::study::sweep::DEFAULT_INTERVALS;
use crate::study::trace::DrawnSample;
use crate::study::{
    Case, ComputeSettings, accuracy, check, effects, fit, flight, orders, remedies, risk, search, size, sweep,
};

/// Samples of a study of effects.
const EFFECTS_SAMPLING: Sampling = Sampling::exactly(effects::SAMPLES, Sampling::OF_RISK.seed);
/// Samples of each value of an assumption.
pub(super) const ASSUMPTIONS_SAMPLING: Sampling =
    Sampling::exactly(assumptions::SAMPLES, Sampling::OF_VERDICT.seed);
/// Longest run that [`StudyKind::Accuracy`] makes.
const LONGEST_RUN: Duration = Duration::from_secs(1);

/// What a question of the terminal is about, beside the plan.
#[derive(Clone, Debug, Default)]
pub struct Subject {
    /// Index of the option, for a question of one option.
    pub option: usize,
    /// The sample to be seen, for [`StudyKind::Flight`]; `None` for the shot as planned.
    pub sample: Option<DrawnSample>,
    /// What was seen of earlier shots, for [`StudyKind::Fit`].
    pub observed: Vec<Observations>,
}

impl Subject {
    /// An option as planned.
    pub fn option(option: usize) -> Self {
        Self { option, ..Self::default() }
    }
}

/// The question of a kind as the terminal asks it.
pub fn ask(kind: StudyKind, case: &Case, subject: Subject, compute: ComputeSettings) -> Asked {
    let Subject { option, sample, observed } = subject;
    let all_options = || (0..case.shots.len()).collect();
    // Where the options differ in how the holes of a row fire, the selected one is meant.
    let holes_of = || case.hole_timing.is_none().then(|| case.plan.delays[option].name.clone());
    let question = match kind {
        StudyKind::Check => Question::Check(check::Question::OF_VERDICT),
        StudyKind::Sweep => Question::Sweep(sweep::Question {
            order: (0..case.plan.blast_rows.len()).collect(),
            intervals: DEFAULT_INTERVALS,
            option: holes_of(),
        }),
        StudyKind::Orders => {
            let option = holes_of();
            let intervals_s = case.with_hole_timing_of(option.as_deref()).intervals();
            Question::Orders(orders::Question { intervals_s, option })
        }
        StudyKind::Risk => Question::Risk(risk::Question {}),
        StudyKind::Search => Question::Search(search::Question {}),
        StudyKind::Size => {
            let (choices, demand) = (case.plan.size.clone(), Demand::Options(all_options()));
            Question::Size(size::Question { choices, demand })
        }
        StudyKind::Effects => Question::Effects(effects::Question { options: all_options() }),
        StudyKind::Fit => Question::Fit(fit::Question { observed, unknowns: vec![Unknown::Launch] }),
        StudyKind::Assumptions => {
            Question::Assumptions(assumptions::Question { option, extent: Extent::All })
        }
        StudyKind::AssumptionsOfPassing => {
            Question::AssumptionsOfPassing(assumptions::OfPassing { options: all_options() })
        }
        StudyKind::Flight => Question::Flight(flight::Question { option, sample }),
        StudyKind::Accuracy => {
            let patience = LONGEST_RUN;
            Question::Accuracy(accuracy::Question { option, patience, with_paper_table: false })
        }
        StudyKind::Remedies => Question::Remedies(remedies::Question { option }),
    };
    let sampling = match kind {
        StudyKind::Risk => Sampling::OF_RISK,
        StudyKind::Effects => EFFECTS_SAMPLING,
        StudyKind::Assumptions | StudyKind::AssumptionsOfPassing => ASSUMPTIONS_SAMPLING,
        _ => Sampling::OF_VERDICT,
    };
    Asked { question, sampling: Some(sampling), compute }
}
