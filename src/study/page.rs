//! Findings for the page of the blast file: the verdicts of a plan, other intervals, observations of earlier shots, and what the
//! pass of the option to be fired stands on.

use super::assumptions::{Assumptions, Extent, SAMPLES, find_assumptions};
use super::check::{self, JudgedPlan};
use super::fit::observation_bands::{Prediction, predict_observations};
use super::fit::observed_shots::ObservedShots;
use super::judge::Judgement;
use super::observed::objection::compare;
use super::observed::{Comparison, NotCompared};
use super::samples::sample_count::Sampling;
use super::standing::Standing;
use super::study_trait::Study;
use super::sweep::{self, Sweep};
use super::{Case, ComputeResult, Computed, Context, FileState, NoResult};
use crate::plan::observations::Observations;

/// The question of the page.
pub struct Question {
    /// Index of the option to be fired; `None` if none is chosen.
    pub to_be_fired: Option<usize>,
    /// The interval between rows to sweep; `None` for no sweep.
    pub sweep: Option<sweep::Question>,
    /// Observations of earlier shots.
    pub observed: Vec<Observations>,
}

/// Findings for the page.
#[derive(Debug)]
pub struct PageFindings {
    /// The results of the options.
    pub judged: Computed<JudgedPlan>,
    /// Height, force and risk over the interval, if a sweep was requested.
    pub sweep: Option<Computed<Sweep>>,
    /// The observations.
    pub seen: ObservedShots,
    /// Predictions of the observations (`n_observations`); `None` if the time was up.
    pub predictions: Option<Vec<Prediction>>,
    /// What the pass of the option to be fired stands on; `None` if it was not requested, or there is no result.
    pub stands_on: Option<Assumptions>,
}

/// Weights of the steps, by the time that they take.
const VERDICTS: f64 = 3.0;
const SWEEP: f64 = 3.0;
const PREDICTIONS: f64 = 1.0;
const STANDS_ON: f64 = 3.0;

impl PageFindings {
    /// Comparison of the plan with the observations in these files.
    pub fn compared(&self, case: &Case, files: &[Observations]) -> Comparison {
        match &self.predictions {
            Some(found) => compare(case, files, &self.seen, found),
            None => Comparison::not_compared(NotCompared::OutOfTime),
        }
    }
}

impl Question {
    /// The weights of the steps to take.
    fn weights(&self, is_sampled: bool) -> Vec<f64> {
        let weight = |is_asked: bool, weight: f64| is_asked.then_some(weight);
        let weights = [
            Some(VERDICTS),
            weight(self.sweep.is_some(), SWEEP),
            weight(!self.observed.is_empty(), PREDICTIONS),
            weight(self.to_be_fired.is_some() && is_sampled, STANDS_ON),
        ];
        weights.into_iter().flatten().collect()
    }

    /// All findings for the page.
    pub fn answer(&self, context: &Context<'_>) -> ComputeResult<PageFindings> {
        let &Context { case, sampling, control, .. } = context;
        let weights = self.weights(sampling.is_some());
        let mut rest: f64 = weights.iter().sum();
        if weights.len() > 1 {
            control.has_steps(weights.len());
        }
        let mut step = |weight: f64| {
            let share = weight / rest;
            rest -= weight;
            (weights.len() > 1).then(|| control.part(share))
        };
        let judging = step(VERDICTS);
        let judged = check::Question::OF_VERDICT.answer(context)?;
        drop(judging);
        let mut swept = None;
        if let Some(question) = &self.sweep {
            let _sweeping = step(SWEEP);
            swept = Some(question.answer(context)?);
        }
        let seen = ObservedShots::new(&self.observed);
        let mut predictions = Some(Vec::new());
        if !self.observed.is_empty() {
            let _predicting = step(PREDICTIONS);
            predictions = match predict_observations(context, &seen) {
                Err(NoResult::OutOfTime) => None,
                found => Some(found?),
            };
        }
        let mut found = PageFindings { judged, sweep: swept, seen, predictions, stands_on: None };
        // Only for a pass that stands, find what it stands on.
        let compared = found.compared(case, &self.observed);
        let standing = Standing::of(case, FileState::now(&case.source), compared);
        let results = &found.judged.value.results;
        let passes = |option: &usize| {
            standing.against_passes().is_none()
                && results[*option].as_ref().is_ok_and(Judgement::is_full_pass)
        };
        let mut partial = found.judged.partial
            || found.predictions.is_none()
            || found.sweep.as_ref().is_some_and(|swept| swept.partial);
        if let (Some(option), Some(Sampling { seed, .. })) = (self.to_be_fired.filter(passes), sampling) {
            let _finding = step(STANDS_ON);
            let context = context.with_sampling(Sampling::exactly(SAMPLES, seed));
            // The verdicts stand without it. A partial result says nothing: it would pass a value that was not tried.
            let stands_on = find_assumptions(&context, option, Extent::Nearest).ok();
            found.stands_on = stands_on.filter(|found| !found.partial).map(|found| found.value);
            partial = partial || found.stands_on.is_none();
        }
        Ok(Computed { value: found, partial })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::fit::observable_names;
    use crate::study::judge::brief_judgement::tests::case as two_tires;
    use crate::study::{ComputeSettings, StudyControl};

    /// Findings on the one option of a plan, after a film in which a tire flew to `height` [m].
    fn found(
        case: &Case,
        sampling: Option<Sampling>,
        height: Option<f64>,
        is_in_time: bool,
    ) -> Computed<PageFindings> {
        let control = StudyControl::default();
        if !is_in_time {
            control.expire();
        }
        let film = |height: f64| {
            let text = format!("option,tire,quantity,value,sd\n1,1:1,flight_height_m,{height},0.05\n");
            Observations::parse("film.csv", &text, &observable_names(case)).expect("observations")
        };
        let observed = height.map(film).into_iter().collect();
        let context = Context::new(case, ComputeSettings::of(&case.plan), &control).with_sampling(sampling);
        Question { to_be_fired: Some(0), sweep: None, observed }.answer(&context).expect("findings")
    }

    /// A pass that stands has findings on what it stands on. A pass that an observation contradicts has none, and neither has a fail.
    #[test]
    fn what_a_pass_stands_on_is_asked_of_a_pass_that_stands() {
        let case = two_tires("", false);
        let sampling = Some(Sampling::OF_VERDICT);
        let stands = found(&case, sampling, None, true);
        assert!(stands.value.stands_on.is_some() && !stands.partial);
        let seen = found(&case, sampling, Some(6.0), true);
        assert_eq!(seen.value.predictions.as_ref().map(Vec::len), Some(1));
        assert!(seen.value.stands_on.is_none() && !seen.partial, "over the limit of 5 m");
        let mut low = case.clone();
        low.limits.height = 0.1;
        let fails = found(&low, sampling, None, true);
        assert!(fails.value.stands_on.is_none() && !fails.partial);
        let alone = found(&case, None, None, true);
        assert!(alone.value.stands_on.is_none() && !alone.partial, "the planned shot alone");
    }

    #[test]
    fn findings_that_the_time_cut_short_say_so() {
        let case = two_tires("", false);
        assert!(found(&case, Some(Sampling::OF_VERDICT), None, false).partial);
        let seen = found(&case, Some(Sampling::OF_VERDICT), Some(1.0), false);
        let compared = seen.value.compared(&case, &[]);
        assert_eq!(
            compared.why_not_compared(),
            Some(&NotCompared::OutOfTime),
            "what was seen is not compared"
        );
    }
}
