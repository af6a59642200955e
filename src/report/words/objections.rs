//! What speaks against the verdicts of a plan, in words.

use itertools::Itertools;

use crate::choice::ObservedQuantity;
use crate::report::language::{phrase, say};
use crate::report::observed::{place, value_by_sd};
use crate::study::observed::contradiction::Contradiction;
use crate::study::observed::other_shot::{LaunchCause, OtherShot};
use crate::study::observed::{Comparison, NotCompared, Objection};
use crate::study::standing::{Doubt, Standing};
use crate::study::{Case, FileState};
use crate::units::{self, Unit};

/// What speaks against a plan, one sentence each: the state of its file, and observations of earlier shots.
pub fn against_plan(case: &Case, standing: &Standing) -> Vec<String> {
    let file = of_file(&case.source.name(), standing.file()).into_iter();
    file.chain(sentences(case, standing.compared())).collect()
}

/// Words of the page where nothing may be fired by a plan, whatever its file and earlier shots say; `None` for other doubts.
pub fn forbidding(doubt: Doubt) -> Option<&'static str> {
    let text = match doubt {
        Doubt::Example => "NOT to be fired, the plan is an example",
        Doubt::NoUncertainty => "NOT to be fired, the plan has no [uncertainty]",
        Doubt::LaunchUnstated => {
            "NOT to be fired, launch_common_percent does not say how well the launch is known"
        }
        Doubt::NotOfEarth => "NOT to be fired, gravity_m_s2 is not that of the earth",
        Doubt::AcceptsTooMuch => "NOT to be fired, by this plan more than 1 shot in 10 may fail",
        Doubt::RangeBesidePlan => "NOT to be fired, a range of [uncertainty] leaves out the plan's own value",
        _ => return None,
    };
    Some(phrase(text))
}

/// What observations of earlier shots say against a plan, and why some are not compared with it, one sentence each.
pub fn sentences(case: &Case, compared: &Comparison) -> Vec<String> {
    let objections = compared.objections().iter().map(|objection| match objection {
        Objection::Contradiction(contradiction) => of_contradiction(case, contradiction),
        Objection::OtherShot(other) => of_other_shot(other),
    });
    objections.chain(compared.why_not_compared().map(of_not_compared)).unique().collect()
}

fn of_not_compared(why: &NotCompared) -> String {
    let text = match why {
        NotCompared::OutOfTime => {
            "observations of earlier shots were not compared with the plan: the time was up"
        }
        NotCompared::RunsFailed => {
            "observations of earlier shots were not compared with the plan: its runs failed"
        }
        NotCompared::NoSamples => {
            "observations typed in the terminal are not compared with the planned shot alone: judge without --nominal"
        }
        NotCompared::NoPlan => {
            "observations of earlier shots lie beside the plan, which is not here: run `merge` where the shards were computed"
        }
        NotCompared::TakenBack => {
            "the launches of this plan were fitted to observations that were taken back since: write those that you know without it, and take `fitted_from` out"
        }
        NotCompared::NotYet => {
            "observations of earlier shots are not compared with this plan: see Studies, Fit"
        }
        NotCompared::Unreadable(reason) => {
            return say!("observations of earlier shots are not compared with this plan: {reason}", reason);
        }
        NotCompared::InRecord => {
            "observations typed in the terminal are not compared with this plan: open it there"
        }
    };
    phrase(text).to_owned()
}

/// Warning that the file no longer holds the judged text, or that the file is gone; `None` otherwise.
pub fn of_file(path: &str, file: FileState) -> Option<String> {
    match file {
        FileState::AsJudged | FileState::Pipe => None,
        FileState::Changed => Some(say!(
            "{path} does not say what was judged: the numbers are those of another text, and nothing is recommended",
            path
        )),
        FileState::Gone => Some(say!(
            "{path} is not here: the numbers are those of the plan as it was read, compare it with the plan to be fired",
            path
        )),
    }
}

/// Charge, stemming or tire mass that an earlier shot had otherwise than the plan, or that one of the two does not state.
pub fn of_other_shot(&OtherShot { cause, then, planned }: &OtherShot) -> String {
    let (what, unit) = match cause {
        LaunchCause::Charge => (phrase("charge"), "kg"),
        LaunchCause::Stemming => (phrase("stemming"), "m"),
        LaunchCause::TireMass => (phrase("mass of a tire"), "kg"),
    };
    match (then.map(units::short), planned.map(units::short)) {
        (Some(then), Some(planned)) => say!(
            "{what}: {then} {unit} in an earlier shot, {planned} {unit} in the plan: its launch was another",
            what,
            then,
            unit,
            planned
        ),
        (Some(_), None) => {
            say!("{what}: an earlier shot says it, the plan does not: was it the same?", what)
        }
        (None, _) => say!("{what}: the plan says it, an earlier shot does not: was it the same?", what),
    }
}

fn of_contradiction(case: &Case, contradiction: &Contradiction) -> String {
    match contradiction {
        Contradiction::OverLimit { seen, limit } => {
            let unit = match seen.watched.quantity {
                ObservedQuantity::Force => Unit::Kilonewton,
                _ => Unit::Metre,
            };
            let place = place(case, seen.option, &seen.watched);
            let [value, limit] = [seen.value, *limit].map(|value| units::value(value, unit));
            say!(
                "{place}: {value} {} was seen, over the limit of {limit}",
                place,
                value,
                unit.symbol(),
                limit
            )
        }
        Contradiction::SaysNothing { seen } => {
            let (place, value, sd) =
                (place(case, seen.option, &seen.watched), value_by_sd(seen.value, seen.sd), seen.sd);
            say!(
                "{place}: {value} give or take {sd} says nothing of this plan: a slip of the unit? Mend it, or leave it out",
                place,
                value,
                sd
            )
        }
        Contradiction::FarOutside { seen, band: [low, _] } if low.is_nan() => {
            let (place, value) = (place(case, seen.option, &seen.watched), value_by_sd(seen.value, seen.sd));
            say!("{place}: {value} was seen; by this plan it hardly ever flies", place, value)
        }
        Contradiction::FarOutside { seen, band: [low, high] } => {
            let [value, low, high] = [seen.value, *low, *high].map(|value| value_by_sd(value, seen.sd));
            let place = place(case, seen.option, &seen.watched);
            say!(
                "{place}: {value} was seen, far outside what this plan predicts, {low} to {high}",
                place,
                value,
                low,
                high
            )
        }
        Contradiction::Unpredicted { of: 1, .. } => say!(
            "outside what this plan predicts: the one observation of an earlier shot; do not fire by its verdicts before it agrees with it"
        ),
        Contradiction::Unpredicted { outside, of } => say!(
            "outside what this plan predicts: {outside} of {of} observations of earlier shots; do not fire by its verdicts before it agrees with them",
            outside,
            of
        ),
        Contradiction::ToOneSide { shots, is_faster: true } => say!(
            "launches were faster than this plan predicts, further than chance explains, by earlier shots taken together ({shots}); `shelter fit` finds them",
            shots
        ),
        Contradiction::ToOneSide { shots, is_faster: false } => say!(
            "launches were slower than this plan predicts, further than chance explains, by earlier shots taken together ({shots}); `shelter fit` finds them",
            shots
        ),
        Contradiction::LeavesFaster { faster: [left, judged] } => say!(
            "earlier shots leave launches possible that are {} faster than planned, and this plan judges them up to {}: put what `shelter fit` finds into it",
            units::percent(*left, 0),
            units::percent(*judged, 0)
        ),
        Contradiction::Differ { shots } => say!(
            "earlier shots ({shots}) differ by more than this plan says of shots: see launch_between_shots_percent, and `shelter fit`",
            shots
        ),
        Contradiction::FiredOtherwise { far, logged, fired, planned } => {
            let [at, planned] = [fired.time, *planned].map(units::milliseconds);
            let (tire, option) = (case.scene().tire_ids[fired.tire], &case.plan.delays[fired.option].name);
            say!(
                "{} of {} logged firing times are not those of the plan, nor within what [uncertainty] says of delays: {option}, under tire {tire}, {at} instead of {planned}",
                far,
                logged,
                option,
                tire,
                at,
                planned
            )
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::observations::{MeasuredFiring, Observation, ObservedPoint};
    use crate::study::fit::observation_bands::Prediction;
    use crate::study::observed::objection::find_objections;

    /// Objections after one shot with these observed values [m], each with its option. The plan predicts 0.9 to 1.1 m.
    fn told(seen: &[(usize, f64)]) -> Vec<String> {
        told_of_shots(&[seen])
    }

    /// The same after several shots.
    fn told_of_shots(shots: &[&[(usize, f64)]]) -> Vec<String> {
        let text = include_str!("../../../tests/fixtures/amur-three-rows.toml").to_owned();
        let source = crate::plan::PlanSource { path: std::path::PathBuf::new(), text };
        let case = Case::parse(source).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let watched = ObservedPoint { quantity: ObservedQuantity::FlightHeight, index: 0, time: 0.0 };
        let observation =
            |&(option, value): &(usize, f64)| Observation { option, watched, value, sd: 0.02, line: 1 };
        let prediction =
            Prediction { planned: 1.0, band: Some([0.9, 1.1]), middle: 1.0, ..Prediction::default() };
        let shot = |seen: &&[(usize, f64)]| seen.iter().map(|seen| (observation(seen), prediction)).collect();
        let shots: Vec<Vec<_>> = shots.iter().map(shot).collect();
        sentences(&case, &Comparison::compared(find_objections(&case, &shots, &[], &[])))
    }

    /// A logged time within the scatter of the detonators says nothing. A time 10 ms later, and rows in another order, get an
    /// objection.
    #[test]
    fn logged_times_that_are_not_those_of_the_plan_are_told() {
        let text = include_str!("../../../tests/fixtures/amur-three-rows.toml").to_owned();
        let source = crate::plan::PlanSource { path: std::path::PathBuf::new(), text };
        let case = Case::parse(source).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let option = case.plan.delays.iter().position(|delay| delay.name == "42 ms").expect("an option");
        let second = *case.shots[option].firings.iter().find(|firing| firing.row == 1).expect("a row");
        let told = |time: f64| {
            let fired = MeasuredFiring { option, tire: second.tire, time: second.time + time };
            let objections = find_objections(&case, &[], &[fired], &[]);
            sentences(&case, &Comparison::compared(objections)).join("; ")
        };
        assert_eq!(told(0.3e-3), "");
        for off in [10e-3, -0.042] {
            assert!(told(off).starts_with("1 of 1 logged"), "{off}");
        }
        // Where delays scatter by a share of their length, all delays together scatter no more than one delay of that length: 5 x 4
        // % of 42 ms and 1 ms are 9.4 ms.
        let mut case = case.clone();
        case.plan.uncertainty.delay = crate::plan::DelayScatter { sd_ms: 0.0, cv_percent: 4.0 };
        for (off, is_told) in [(9e-3, false), (10e-3, true)] {
            let fired = MeasuredFiring { option, tire: second.tire, time: second.time + off };
            assert_eq!(find_objections(&case, &[], &[fired], &[]).len(), usize::from(is_told), "{off}");
        }
    }

    /// One value of ten lies outside by chance. One value far outside does not, to either side. Calm shots do not hide a shot that
    /// was not calm.
    #[test]
    fn neither_many_others_nor_calm_shots_hide_what_contradicts_the_plan() {
        let ten = [(0, 1.0); 10];
        assert_eq!(told(&ten), [""; 0]);
        assert_eq!(told(&[&ten[..], &[(0, 1.15)]].concat()), [""; 0]);
        for far in [1.25, 0.75] {
            let told = told(&[&ten[..], &[(0, far)]].concat());
            assert!(told.len() == 1 && told[0].contains("far outside"), "{told:?}");
        }
        assert!(
            told(&[(0, 1.12)])[0].contains("the one observation of an earlier shot"),
            "{:?}",
            told(&[(0, 1.12)])
        );
        let of_two = told(&[&ten[..], &[(1, 1.15), (1, 1.15)]].concat());
        assert!(of_two.len() == 1 && of_two[0].contains("2 of 2 observations"), "{of_two:?}");
        let one_shot = [(1, 1.15), (1, 1.0), (1, 1.15)];
        let against = told(&[&ten[..], &one_shot].concat());
        assert!(against.len() == 1 && against[0].contains("2 of 3 observations"), "{against:?}");
        // Observations of one shot may stand apart: some new, some of shots that the plan was fitted to.
        assert_eq!(told(&[&one_shot[..1], &ten, &one_shot[1..]].concat()), against);
        // Calm shots of the same option do not hide another shot, either.
        let calm = [(0, 1.0); 18];
        assert_eq!(told(&[&calm[..], &[(0, 1.15), (0, 1.15)]].concat()), [""; 0]);
        let of_two = told_of_shots(&[&calm, &[(0, 1.15), (0, 1.15)]]);
        assert!(of_two.len() == 1 && of_two[0].contains("2 of 2 observations"), "{of_two:?}");
    }
}
