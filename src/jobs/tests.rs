use std::time::{Duration, Instant};

use super::*;
use crate::plan::observations::Observations;
use crate::plan::{Plan, PlanSource};
use crate::study::as_planned::margin::LaunchMargin;
use crate::study::fit::observable_names;
use crate::study::judge::batch::Depth;
use crate::study::judge::deciding_shot::DecidingSamples;
use crate::study::samples::sample_count::Sampling;
use crate::study::samples::sampled_shot::SampledShot;

const STUDY: StudyKind = StudyKind::Orders;

fn case() -> Arc<Case> {
    case_of(include_str!("../../tests/fixtures/amur-three-rows.toml").to_owned())
}

/// The same options under 3 × 3 tires.
fn small_case() -> Arc<Case> {
    let text = include_str!("../../tests/fixtures/amur-three-rows.toml");
    case_of(text.replace("rows = 5 ", "rows = 3 ").replace("columns = 10 ", "columns = 3 "))
}

fn case_of(text: String) -> Arc<Case> {
    let case = Case::parse(PlanSource { path: std::path::PathBuf::new(), text });
    Arc::new(case.unwrap_or_else(|mistakes| panic!("{mistakes}")))
}

fn coarse(case: &Case) -> ComputeSettings {
    ComputeSettings { step: Some(1e-3), ..ComputeSettings::of(&case.plan) }
}

/// Settings that make a run last for minutes.
fn endless(case: &Case) -> ComputeSettings {
    ComputeSettings { step: Some(1e-9), ..ComputeSettings::of(&case.plan) }
}

/// Calls `look` until there is a value.
fn wait<T>(mut look: impl FnMut() -> Option<T>) -> T {
    let begun = Instant::now();
    loop {
        if let Some(found) = look() {
            return found;
        }
        assert!(begun.elapsed() < Duration::from_secs(60), "nothing came");
        thread::sleep(Duration::from_millis(5));
    }
}

/// Results of every option, by option.
fn checked(jobs: &mut Jobs, options: usize) -> Vec<Result<Box<Judgement>, NoResult>> {
    let mut results = Vec::new();
    wait(|| {
        for news in jobs.news() {
            if let News::Checked { option, result } = news {
                results.push((option, result));
            }
        }
        (results.len() == options).then_some(())
    });
    results.sort_by_key(|(option, _)| *option);
    results.into_iter().map(|(_, result)| result).collect()
}

/// Samples and launch margins of every option, by option.
fn sampled(jobs: &mut Jobs, options: usize) -> Vec<(Box<SampledShot>, LaunchMargin)> {
    let (mut shots, mut margins) = (vec![None; options], vec![None; options]);
    wait(|| {
        for news in jobs.news() {
            match news {
                News::Found { option, part: Part::Samples { sampled, more: false } } => {
                    shots[option] = Some(sampled);
                }
                News::Found { option, part: Part::Margin(margin) } => margins[option] = Some(margin),
                _ => {}
            }
        }
        margins.iter().all(Option::is_some).then_some(())
    });
    shots.into_iter().zip(margins).filter_map(|(shot, margin)| Some((shot?, margin?))).collect()
}

/// Judges all options. Nothing is known of them before.
fn judge(jobs: &mut Jobs, case: &Arc<Case>, compute: ComputeSettings) {
    jobs.judge(case, compute, Vec::new(), Depth::Full);
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let case = small_case();
    let options = case.shots.len();
    let values = |threads| {
        let mut jobs = Jobs::new(threads);
        judge(&mut jobs, &case, coarse(&case));
        let results = checked(&mut jobs, options);
        let values = results.into_iter().map(|result| result.map(|judged| judged.checked.estimates));
        (values.collect::<Vec<_>>(), sampled(&mut jobs, options))
    };
    let (few, many) = (values(1), values(3));
    assert_eq!(few, many);
    assert!(few.1.iter().all(|(shot, _)| shot.samples.len() >= 200));
}

/// While samples come, the shot that decides so far is reported. The last report is the deciding shot of all samples.
#[test]
fn the_shot_that_decides_is_told_while_samples_come() {
    let (case, mut jobs) = (small_case(), Jobs::new(2));
    judge(&mut jobs, &case, coarse(&case));
    let (mut told, mut last) = (Vec::new(), None);
    wait(|| {
        for news in jobs.news() {
            match news {
                News::Found { option: 0, part: Part::Samples { sampled, .. } } => {
                    last = DecidingSamples::of(&sampled, Sampling::OF_VERDICT.seed)
                }
                News::Found { option: 0, part: Part::Deciding(run) } => told.push((run.samples, last)),
                News::Found { option: 0, part: Part::Margin(_) } => return Some(()),
                _ => {}
            }
        }
        None
    });
    assert!(told.len() > 1 && told.iter().any(|(sample, now)| Some(*sample) == *now), "{told:?}");
    assert_eq!(told.last().map(|(sample, _)| Some(*sample)), Some(last));
}

#[test]
fn a_new_request_ends_sampling() {
    let (case, mut jobs) = (case(), Jobs::new(2));
    // Hundreds of samples of each option at this step would take minutes.
    judge(&mut jobs, &case, ComputeSettings { step: Some(5e-5), ..coarse(&case) });
    checked(&mut jobs, case.shots.len());
    let control = jobs.judging.clone().expect("under way");
    judge(&mut jobs, &case, coarse(&case));
    let begun = Instant::now();
    wait(|| {
        jobs.news();
        (Arc::strong_count(&control) == 1).then_some(())
    });
    assert!(begun.elapsed() < Duration::from_secs(5), "{:?}", begun.elapsed());
}

#[test]
fn the_newest_request_of_a_kind_wins() {
    let (case, mut jobs) = (small_case(), Jobs::new(2));
    judge(&mut jobs, &case, endless(&case));
    jobs.study(STUDY, &case, Subject::default(), endless(&case));
    judge(&mut jobs, &case, coarse(&case));
    jobs.study(STUDY, &case, Subject::default(), coarse(&case));
    let (mut options, mut studies) = (Vec::new(), Vec::new());
    wait(|| {
        for news in jobs.news() {
            match news {
                News::Checked { option, result } => {
                    options.push((option, result.expect("a result").checked.compute))
                }
                News::Studied { compute, result, .. } => studies.push((compute, result.is_ok())),
                News::Checking { .. }
                | News::Judging(_)
                | News::Found { .. }
                | News::Assumptions { .. }
                | News::Band { .. }
                | News::Studying { .. } => {}
            }
        }
        (options.len() == case.shots.len() && !studies.is_empty()).then_some(())
    });
    assert!(options.iter().all(|(_, compute)| *compute == coarse(&case)));
    assert_eq!(studies, [(coarse(&case), true)]);
}

#[test]
fn a_cancelled_study_ends_within_a_step_and_has_no_news() {
    let (case, mut jobs) = (case(), Jobs::new(1));
    jobs.study(STUDY, &case, Subject::default(), endless(&case));
    wait(|| jobs.news().into_iter().find(|news| matches!(news, News::Studying { .. })));
    let control = jobs.studies[STUDY as usize].clone().expect("under way");
    jobs.cancel(STUDY);
    // The job and its news hold the control. Once both are gone, only the test holds it.
    wait(|| {
        assert!(jobs.news().is_empty());
        (Arc::strong_count(&control) == 1).then_some(())
    });
}

#[test]
fn a_panic_is_the_result_of_its_option_or_study_alone() {
    let (good, mut jobs) = (case(), Jobs::new(2));
    let mut bad = (*good).clone();
    bad.shots[1].firings[0].tire = usize::MAX;
    judge(&mut jobs, &Arc::new(bad), coarse(&good));
    let results = checked(&mut jobs, good.shots.len());
    for (option, result) in results.iter().enumerate() {
        assert_eq!(matches!(result, Err(NoResult::Panicked(_))), option == 1, "{option}");
    }
    jobs.study(StudyKind::Flight, &good, Subject::option(usize::MAX), coarse(&good));
    // The judging job may still report its progress.
    let told = wait(|| jobs.news().into_iter().find(|news| matches!(news, News::Studied { .. })));
    assert!(matches!(told, News::Studied { result: Err(NoResult::Panicked(_)), .. }), "{told:?}");
}

#[test]
fn dropping_the_jobs_ends_each_of_them() {
    let (case, mut jobs) = (case(), Jobs::new(1));
    judge(&mut jobs, &case, endless(&case));
    StudyKind::ALL.into_iter().for_each(|kind| jobs.study(kind, &case, Subject::default(), endless(&case)));
    let all: Vec<_> = jobs.studies.iter().chain([&jobs.judging]).flatten().cloned().collect();
    assert_eq!(all.len(), 1 + StudyKind::ALL.len());
    drop(jobs);
    wait(|| all.iter().all(|control| Arc::strong_count(control) == 1).then_some(()));
}

/// Observations from which a plan was fitted are compared with the plan, and never fitted twice.
#[test]
fn what_the_plan_was_fitted_to_is_compared_and_not_fitted_again() {
    let plain = case();
    let read = |case: &Case, text: &str| {
        let text = format!("option,tire,quantity,value,sd\n{text}");
        Observations::parse("seen.csv", &text, &observable_names(case)).expect("observations")
    };
    let (old, new) = ("20 ms,3:1,flight_height_m,1.95,0.05\n", "42 ms,3:1,flight_height_m,1.2,0.05\n");
    let plan = Plan { fitted_from: vec![read(&plain, old).checksum], ..plain.plan.clone() };
    let case = Arc::new(Case::new(plan));
    let mut jobs = Jobs::new(2);
    for (files, fits) in [(vec![old], false), (vec![old, new], true)] {
        let files = files.into_iter().map(|text| read(&case, text)).collect();
        let subject = Subject { observed: files, ..Subject::default() };
        jobs.study(StudyKind::Fit, &case, subject, coarse(&case));
        let found = wait(|| {
            jobs.news().into_iter().find_map(|news| match news {
                News::Studied { result, .. } => Some(result.expect("a result")),
                _ => None,
            })
        });
        let Found::Fit(compared) = found else { panic!("a fit") };
        let compared = compared.value;
        assert_eq!((compared.fitted.is_some(), compared.new.len()), (fits, usize::from(fits)));
        let count = compared.files.len();
        assert_eq!((compared.seen.list.len(), compared.predictions.len()), (count, count));
        assert!(compared.predictions[0].band.is_some(), "as wide as the samples are");
    }
}
