//! Finds the objections against a plan in observations of earlier shots.

use std::collections::BTreeMap;

use super::find_contradictions::find_contradictions;
use super::other_shot::{OtherShot, other_shots};
use super::{AboveBand, Comparison, NotCompared, Objection, ObservationRecord};
use crate::choice::ObservedQuantity;
use crate::plan::observations::{MeasuredFiring, Observation, Observations};
use crate::study::fit::ComparedWithObservations;
use crate::study::fit::observation_bands::{Prediction, predict_observations};
use crate::study::fit::observed_shots::ObservedShots;
use crate::study::{Case, Context, NoResult};

/// All objections against a plan: from the observations `seen` of each shot with their predictions, from the firing times `logged`, and
/// from the heads of the `files`.
pub fn find_objections(
    case: &Case,
    seen: &[Vec<(Observation, Prediction)>],
    logged: &[MeasuredFiring],
    files: &[Observations],
) -> Vec<Objection> {
    let against = find_contradictions(case, seen, logged).into_iter().map(Objection::Contradiction);
    let others = other_shots(case, files).into_iter().filter(OtherShot::differs);
    against.chain(others.map(Objection::OtherShot)).collect()
}

/// Compares a plan with the observations `seen` in these files and their predictions (`n_observations`).
pub fn compare(
    case: &Case,
    files: &[Observations],
    seen: &ObservedShots,
    predictions: &[Prediction],
) -> Comparison {
    let above = above_bands(&seen.list, predictions).collect();
    Comparison::compared(objections_of_files(case, files, seen, predictions)).with_above_bands(above)
}

/// Values above their bands, for quantities of which more is worse.
fn above_bands(seen: &[Observation], predictions: &[Prediction]) -> impl Iterator<Item = AboveBand> {
    let of_one = |(seen, prediction): (&Observation, &Prediction)| {
        let [_, end] = prediction.band?;
        let is_above = seen.value > end && seen.watched.quantity != ObservedQuantity::Lift;
        is_above.then_some(AboveBand { seen: *seen, end })
    };
    seen.iter().zip(predictions).filter_map(of_one)
}

/// Objections against a plan from the observations `seen` in these files and their predictions (`n_observations`).
pub fn objections_of_files(
    case: &Case,
    files: &[Observations],
    seen: &ObservedShots,
    predictions: &[Prediction],
) -> Vec<Objection> {
    let is_fitted = |file: usize| files[file].is_mostly_fitted(&case.plan.fitted_from);
    let shot = |n: usize| if is_fitted(seen.file[n]) { None } else { Some(seen.file[n]) };
    let mut shots = by_shot(&seen.list, predictions, shot);
    // Observations that the plan was fitted to are calm by construction. Among the others they would make a real contradiction look like
    // chance.
    let fitted: Vec<_> = shots.remove(&None).into_iter().collect();
    let of_fitted = find_contradictions(case, &fitted, &[]).into_iter().map(Objection::Contradiction);
    let shots: Vec<_> = shots.into_values().collect();
    let of_others = find_objections(case, &shots, &seen.firings.concat(), files);
    of_fitted.chain(of_others).collect()
}

/// Observations of a shot, each with its prediction.
type ShotSeen = Vec<(Observation, Prediction)>;

/// Observations with their predictions, one list for each shot, that is for each option and file. Observations that the plan was fitted to
/// form one common list under `None`.
fn by_shot(
    seen: &[Observation],
    predictions: &[Prediction],
    file: impl Fn(usize) -> Option<usize>,
) -> BTreeMap<Option<(usize, usize)>, ShotSeen> {
    let mut shots = BTreeMap::<Option<(usize, usize)>, Vec<_>>::new();
    for (n, (seen, prediction)) in seen.iter().zip(predictions).enumerate() {
        let shot = file(n).map(|file| (seen.option, file));
        shots.entry(shot).or_default().push((*seen, *prediction));
    }
    shots
}

/// Compares a plan with the record of earlier shots, by samples of the plan. Without samples only limits and logged times could speak
/// against the plan, so the result is "not compared".
pub fn compare_record(context: &Context<'_>, record: &ObservationRecord) -> Comparison {
    compare_own(context, record).with_other_blasts(record.other_blasts())
}

/// Compares the plan with its own record, without the names of files about other blasts.
fn compare_own(context: &Context<'_>, record: &ObservationRecord) -> Comparison {
    if record.is_fitted_to_withdrawn(&context.case.plan) {
        return Comparison::not_compared(NotCompared::TakenBack);
    }
    if record.is_empty() {
        return Comparison::nothing_seen();
    }
    if let Some(file) = record.unreadable_file() {
        return Comparison::not_compared(NotCompared::Unreadable(file.to_owned()));
    }
    let Ok(files) = record.read(context.case) else {
        return Comparison::not_compared(NotCompared::InRecord);
    };
    let seen = ObservedShots::new(&files);
    match predict_observations(context, &seen) {
        Ok(found) => compare(context.case, &files, &seen, &found)
            .with_not_compared(context.sampling.is_none().then_some(NotCompared::NoSamples)),
        Err(NoResult::OutOfTime) => Comparison::not_compared(NotCompared::OutOfTime),
        Err(_) => Comparison::not_compared(NotCompared::RunsFailed),
    }
}

impl ComparedWithObservations {
    /// Objections against the plan of this comparison.
    pub fn objections(&self, case: &Case) -> Vec<Objection> {
        objections_of_files(case, &self.files, &self.seen, &self.predictions)
    }

    /// The comparison of the plan with the observations.
    pub fn comparison(&self, case: &Case) -> Comparison {
        compare(case, &self.files, &self.seen, &self.predictions)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::PlanSource;
    use crate::study::fit::observable_names;
    use crate::study::judge::brief_judgement::tests::case as two_tires;
    use crate::study::samples::sample_count::Sampling;
    use crate::study::{ComputeSettings, StudyControl};

    /// Both values of a film lie 2.2 standard deviations too high. The film contradicts a plan, also beside a film that the plan was fitted
    /// to. Beside a film that the plan was not fitted to, it may be chance: 2 x 2.8 % is more than 5 %.
    #[test]
    fn what_was_fitted_makes_no_chance_of_a_new_film() {
        let text = include_str!("../../../tests/fixtures/amur-three-rows.toml").to_owned();
        let mut case = Case::parse(PlanSource { text, ..PlanSource::default() }).expect("a plan");
        let film = |value: f64| {
            let line = |tire: &str| format!("42 ms,{tire},flight_height_m,{value},0.01\n");
            let text = format!("option,tire,quantity,value,sd\n{}{}", line("3:1"), line("3:2"));
            Observations::parse("film.csv", &text, &observable_names(&case)).expect("observations")
        };
        let (high, calm) = (film(1.0 + 2.2 * 0.1 / 1.645), film(1.0));
        let is_contradicted = |case: &Case, files: &[&Observations]| {
            let files: Vec<Observations> = files.iter().copied().cloned().collect();
            let seen = ObservedShots::new(&files);
            let predictions =
                vec![
                    Prediction { planned: 1.0, band: Some([0.9, 1.1]), middle: 1.0, ..Prediction::default() };
                    seen.list.len()
                ];
            !objections_of_files(case, &files, &seen, &predictions).is_empty()
        };
        assert!(is_contradicted(&case, &[&high]) && !is_contradicted(&case, &[&high, &calm]));
        case.plan.fitted_from = calm.kept_in_plan().collect();
        assert!(is_contradicted(&case, &[&high, &calm]));
    }

    #[test]
    fn what_a_plan_was_fitted_to_and_another_shot_speak_against_it_too() {
        let text = include_str!("../../../tests/fixtures/amur-three-rows.toml").to_owned();
        let mut case = Case::parse(PlanSource { text, ..PlanSource::default() }).expect("a plan");
        let film = |head: &str, value: f64| {
            let text =
                format!("{head}option,tire,quantity,value,sd\n42 ms,3:1,flight_height_m,{value},0.01\n");
            Observations::parse("film.csv", &text, &observable_names(&case)).expect("observations")
        };
        let [calm, far] = [1.0, 1.9].map(|value| film("", value));
        let mut heavy = calm.clone();
        heavy.head.cover = Some("tires of 560 kg".to_owned());
        let objections = |case: &Case, file: &Observations| {
            let seen = ObservedShots::new(std::slice::from_ref(file));
            let predictions =
                vec![
                    Prediction { planned: 1.0, band: Some([0.9, 1.1]), middle: 1.0, ..Prediction::default() };
                    seen.list.len()
                ];
            objections_of_files(case, std::slice::from_ref(file), &seen, &predictions)
        };
        assert_eq!(objections(&case, &calm), []);
        assert!(matches!(objections(&case, &heavy)[..], [Objection::OtherShot(_)]));
        case.plan.fitted_from = far.kept_in_plan().collect();
        assert!(matches!(objections(&case, &far)[..], [Objection::Contradiction(_)]));
    }

    /// A height a little above its band is chance, but it is reported. A height below its band is not reported, and neither is a time of
    /// lift.
    #[test]
    fn what_lies_above_its_band_is_told_where_more_is_worse() {
        let case = Case::parse(PlanSource {
            text: include_str!("../../../tests/fixtures/amur-three-rows.toml").to_owned(),
            ..PlanSource::default()
        })
        .expect("a plan");
        let found = |quantity: &str, value: f64| {
            let text = format!("option,tire,quantity,value,sd\n42 ms,3:1,{quantity},{value},0.01\n");
            let file = Observations::parse("film.csv", &text, &observable_names(&case)).expect("one");
            let seen = ObservedShots::new(std::slice::from_ref(&file));
            let prediction =
                Prediction { planned: 1.0, band: Some([0.9, 1.1]), middle: 1.0, ..Prediction::default() };
            let compared = super::compare(&case, &[file], &seen, &[prediction]);
            (compared.agrees(), compared.above_bands().iter().map(|above| above.end).collect::<Vec<_>>())
        };
        assert_eq!(found("flight_height_m", 1.105), (true, vec![1.1]));
        assert_eq!(found("flight_height_m", 1.095), (true, vec![]));
        assert_eq!(found("flight_height_m", 0.895), (true, vec![]));
        assert_eq!(found("lift_s", 1.105), (true, vec![]));
    }

    /// Observations that cannot be compared are reported as such, and never count as agreeing.
    #[test]
    fn what_was_told_agrees_once_it_is_compared_and_keeps_to_the_plan() {
        let case = two_tires("", false);
        let compare = |case: &Case, record: &ObservationRecord, is_in_time: bool| {
            let control = StudyControl::default();
            if !is_in_time {
                control.expire();
            }
            let context = Context::new(case, ComputeSettings::of(&case.plan), &control);
            let sampled = compare_record(&context.with_sampling(Sampling::exactly(20, 1)), record);
            // The planned shot alone has no band in which a film could lie.
            let planned = compare_record(&context, record);
            assert_eq!(planned.why_not_compared().is_none(), record.is_empty());
            sampled
        };
        // A standard deviation of 45 cm fits every prediction.
        let record = |height: &str| {
            let mut record = ObservationRecord::default();
            assert_eq!(record.add_line(&case, 0, &format!("1:1 {height} 0.45")), Ok(()));
            record
        };
        assert!(
            compare(&case, &ObservationRecord::default(), false).agrees()
                && compare(&case, &record("1"), true).agrees()
        );
        assert!(!compare(&case, &record("6"), true).objections().is_empty(), "over the limit of 5 m");
        let not_compared = |case: &Case, record: &ObservationRecord| {
            compare(case, record, false).why_not_compared().cloned()
        };
        assert_eq!(not_compared(&case, &record("1")), Some(NotCompared::OutOfTime));
        let damaged = ObservationRecord::unreadable("plan.seen.json".as_ref(), "it ends early");
        assert_eq!(
            not_compared(&case, &damaged),
            Some(NotCompared::Unreadable("plan.seen.json: it ends early".to_owned()))
        );
        let mut renamed = case.clone();
        renamed.plan.delays[0].name = "another".to_owned();
        assert_eq!(not_compared(&renamed, &record("1")), Some(NotCompared::InRecord));
    }
}
