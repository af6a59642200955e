//! The text of a starter plan, from a few answers.
//!
//! | what | where |
//! |---|---|
//! | the questions, and the assumed uncertainty | `questions` |
//! | the sections of the plan | `sections` |

mod questions;
mod sections;

use std::iter::zip;

use self::questions::SPACING;
pub use self::questions::{
    ASSUMED, LAUNCH, LAUNCH_IS_KNOWN, NOT_KNOWN, QUESTIONS, Question, RIGID_ENDS, ROPE,
};
pub(super) use self::sections::{
    LAUNCH_IS_ASSUMED, LAUNCH_M_S, Shelter, USUAL, delay, header, limits, line, quoted, uncertainty,
};
use self::sections::{SLEEVE, SPLICE_PERCENT, diameter_m, explained, has_sleeve};
use super::keys::{Key, blast_row, cable, limits, shelter, tire, uncertainty};
use crate::sorting::sort;

/// Largest number of blast rows in a starter plan.
const MOST_ROWS: usize = 50;
/// Number of intervals in a range such as `9..109`, which has no step.
const INTERVALS_OF_RANGE: usize = 6;
/// Assumptions of a plan made from the answers: a line of text each, with the keys of the plan that state it. The shelter comes first, then
/// the shot.
pub fn assumed(answers: &[&str; QUESTIONS.len()]) -> Vec<(String, Vec<&'static str>)> {
    let (rope, launch) = (answers[ROPE].trim(), answers[LAUNCH]);
    let ends = match has_sleeve(rope) {
        true => (format!("cables end in a {SLEEVE}"), cable::TERMINATION.name),
        false => (
            format!("cables end in spliced eyes: {SPLICE_PERCENT} % of the rope"),
            cable::TERMINATION_PERCENT.name,
        ),
    };
    let stretch = match has_sleeve(rope) {
        true => "ropes are up to 10 % softer or stiffer",
        false => "ropes are up to 20 % softer or 50 % stiffer",
    };
    let spacing_m = answers[SPACING].trim().parse().unwrap_or(USUAL.spacing_m);
    let across = match diameter_m(spacing_m) {
        0.0 => "cables run from centre to centre of the tires".to_owned(),
        diameter_m => format!("tires are {diameter_m} m across, cables run from rim to rim"),
    };
    let of_shelter = [
        ends,
        (across, tire::OUTER_DIAMETER_M.name),
        (stretch.to_owned(), uncertainty::AXIAL_STIFFNESS_PERCENT.name),
        ("cables tie rows, columns and diagonals".to_owned(), shelter::LINKS.name),
        ("an option must also hold with any one dud".to_owned(), limits::WITHSTANDS_ONE_DUD.name),
        (
            LAUNCH_IS_KNOWN[usize::from(!is_guessed(launch))].to_owned(),
            uncertainty::LAUNCH_COMMON_PERCENT.name,
        ),
    ];
    let of_shot = NOT_KNOWN.map(|(what, keys)| (what.to_owned(), keys.iter().map(|key| key.name).collect()));
    of_shelter.into_iter().map(|(what, key)| (what, vec![key])).chain(of_shot).collect()
}

/// The number in an answer for the launch velocity, as text; `None` where the answer does not end in `filmed`.
fn filmed(launch: &str) -> Option<&str> {
    launch.trim().strip_suffix(FILMED).map(str::trim)
}

/// Whether an answer for the launch velocity is a guess: neither a filmed velocity nor the height of a test tire in m.
pub fn is_guessed(launch: &str) -> bool {
    filmed(launch).is_none() && !launch.trim().ends_with('m')
}

/// Word behind a launch velocity that was filmed.
const FILMED: &str = "filmed";

/// The text of the plan, or a message that names the wrong answer.
///
/// The reader of the plan checks the ranges of numbers, not this function.
pub fn plan(answers: &[&str; QUESTIONS.len()]) -> Result<String, String> {
    let [title, size, spacing, mass, rope, over_holes, launch, intervals, height, factor, drift] =
        answers.map(str::trim);
    let number = |text: &str, question: usize| {
        let value = text
            .parse::<f64>()
            .map_err(|_| format!("{}: '{text}' is no number", QUESTIONS[question].text))?;
        Ok::<f64, String>(value)
    };
    let count = |text: &str, question: usize| {
        text.parse::<usize>()
            .map_err(|_| format!("{}: '{text}' is no whole number", QUESTIONS[question].text))
    };
    let (rows, columns) = size
        .split_once(['x', 'X', '×', ' '])
        .ok_or_else(|| format!("{}: '{size}' is no size", QUESTIONS[1].text))?;
    let (rows, columns) = (count(rows.trim(), 1)?, count(columns.trim(), 1)?);
    let (spacing, mass) = (number(spacing, 2)?, number(mass, 3)?);
    let (height, factor) = (number(height, 8)?, number(factor, 9)?);
    let drift = if drift.is_empty() { None } else { Some(number(drift, 10)?) };
    let over_holes = shelter_rows(over_holes, rows).map_err(|why| format!("{}: {why}", QUESTIONS[5].text))?;
    let guessed = is_guessed(launch);
    let launch = match (filmed(launch), launch.strip_suffix('m')) {
        (Some(speed), _) => line(&blast_row::LAUNCH_M_S, number(speed, LAUNCH)?),
        (None, Some(height)) => line(&blast_row::FREE_FLIGHT_HEIGHT_M, number(height.trim(), LAUNCH)?),
        (None, None) => {
            let guess = launch.trim_end_matches('?').trim();
            let speed = if launch == "?" { LAUNCH_M_S } else { number(guess, LAUNCH)? };
            // A number that nobody observed must not look measured.
            line(&blast_row::LAUNCH_M_S, format!("{speed}    # assumed: put in yours"))
        }
    };
    let mut all = Vec::new();
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|digit| digit.is_ascii_digit());
    for part in intervals.split([' ', ';']).flat_map(|part| part.trim_matches(',').split("..")) {
        // Many people write a comma before the decimals: `12,5` may be one number.
        if let Some((whole, decimals)) = part.split_once(',').filter(|(a, b)| is_number(a) && is_number(b)) {
            return Err(format!(
                "{}: '{part}' is read two ways: write {whole}.{decimals}, or {whole} {decimals}",
                QUESTIONS[7].text
            ));
        }
    }
    for part in intervals.split([',', ' ', ';']).filter(|part| !part.is_empty()) {
        all.extend(match part.split_once("..") {
            Some((from, to)) => evenly(number(from, 7)?, number(to, 7)?),
            None => vec![number(part, 7)?],
        });
    }
    // Whoever presses Enter has weighed and measured nothing.
    let keys = [
        &[&shelter::ROWS, &shelter::COLUMNS][..],
        &[&shelter::SPACING_M],
        &[&tire::MASS_KG],
        &[&cable::ROPE],
    ];
    let offered = zip(keys, 1..).filter(|(_, n)| answers[*n].trim() == QUESTIONS[*n].offered);
    let assumed: Vec<&Key> = offered.flat_map(|(keys, _)| keys.iter().copied()).collect();
    let shelter = Shelter { rows, columns, spacing_m: spacing, mass_kg: mass, rope, assumed: &assumed };
    let mut text = shelter.sections(title, "");
    for (n, under) in over_holes.into_iter().enumerate() {
        text += &header(&blast_row::SECTION);
        text += &line(&blast_row::NAME, quoted(&(n + 1).to_string()));
        text += &line(&blast_row::UNDER_ROW, under);
        text += &launch;
    }
    text += &limits(height, factor, false);
    text.extend(drift.map(|drift| explained(&limits::DRIFT_M, &drift)));
    all.into_iter().for_each(|interval| text += &delay(interval));
    Ok(text + &uncertainty(guessed, rope))
}

/// Numbers of the shelter rows in an answer such as `2-4` or `1, 3`, or the reason why the answer names none.
fn shelter_rows(text: &str, rows: usize) -> Result<Vec<usize>, String> {
    let mut all = Vec::new();
    for part in text.split([',', ' ', ';']).filter(|part| !part.is_empty()) {
        let ends = part.split_once('-').unwrap_or((part, part));
        let [from, to] = [ends.0, ends.1].map(|end| end.trim().parse::<usize>());
        let (Ok(from), Ok(to)) = (from, to) else {
            return Err(format!("'{part}' names no shelter rows"));
        };
        if from < 1 || to > rows || from > to {
            return Err(format!("'{part}': the shelter has the rows 1 to {rows}"));
        }
        all.extend(from..=to);
    }
    sort(&mut all);
    all.dedup();
    match all.len() {
        0 => Err("at least one".to_owned()),
        count if count > MOST_ROWS => Err(format!("at most {MOST_ROWS}")),
        _ => Ok(all),
    }
}

/// At most six numbers at even distances from `from` to `to`. The ends stay as given; the numbers between are whole.
fn evenly(from: f64, to: f64) -> Vec<f64> {
    let last = INTERVALS_OF_RANGE - 1;
    let part = |n: usize| match n {
        0 => from,
        n if n == last => to,
        n => (from + (to - from) * n as f64 / last as f64).round().clamp(from.min(to), from.max(to)),
    };
    let mut all: Vec<f64> = (0..INTERVALS_OF_RANGE).map(part).collect();
    all.dedup();
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Plan;
    use crate::plan::assumed::assumed_values;
    use crate::plan::keys::Key;

    /// `12,5` may be one interval or two, so it is refused: nobody fires an interval that nobody asked for. The ends of a range stay as
    /// typed.
    #[test]
    fn intervals_are_those_that_were_typed() {
        assert_eq!(evenly(2.5, 5.0).first(), Some(&2.5));
        assert_eq!(evenly(2.5, 5.0).last(), Some(&5.0));
        let answer = |intervals: &str| {
            let mut answers = QUESTIONS.map(|question| question.offered.to_owned());
            answers[7] = intervals.to_owned();
            plan(&answers.each_ref().map(String::as_str))
        };
        for typed in ["12,5", "17 12,5", "9; 12,5", "12,5, 25", "12,5..25", "2..2,5"] {
            assert!(answer(typed).is_err_and(|why| why.contains("read two ways")), "{typed}");
        }
        for typed in ["12.5", "17, 25, 42", "17,25,42", "17 25"] {
            assert!(answer(typed).is_ok(), "{typed}");
        }
    }

    /// Every line of help fits on a screen of 80 columns.
    #[test]
    fn help_has_room() {
        for line in QUESTIONS.iter().flat_map(|question| question.help) {
            assert!(line.chars().count() < 79, "{line}");
        }
    }

    /// A launch is an estimate unless the answer says that the velocity was filmed, or gives a test tire's height. The offered answer and a
    /// number alone are estimates, too.
    #[test]
    fn a_launch_that_is_not_known_is_an_estimate() {
        let test_tire = (2.0 * 9.81 * 0.8_f64).sqrt();
        for (launch, speed, is_estimated) in [
            (QUESTIONS[LAUNCH].offered, 4.0, true),
            ("?", 6.0, true),
            ("5.5?", 5.5, true),
            ("5.5", 5.5, true),
            ("5.5 filmed", 5.5, false),
            ("5.5filmed", 5.5, false),
            ("0.8 m", test_tire, false),
        ] {
            let mut answers = QUESTIONS.map(|question| question.offered);
            answers[LAUNCH] = launch;
            let text = plan(&answers).expect("a plan");
            let plan = Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
            assert!(plan.launches().all(|launch| (launch.speed_m_s - speed).abs() < 1e-9), "{launch}");
            assert_eq!(is_guessed(launch), is_estimated, "{launch}");
            assert_eq!(plan.uncertainty.launch_is_estimated(), is_estimated, "{launch}");
        }
    }

    #[test]
    fn the_answers_offered_make_a_plan() {
        let offered = QUESTIONS.map(|question| question.offered);
        let (text, said) = (plan(&offered).expect("answers"), assumed(&offered));
        let plan = Plan::parse("new", &text).unwrap_or_else(|mistakes| panic!("{mistakes}\n{text}"));
        assert_eq!((plan.blast_rows.len(), plan.delays.len()), (3, 7));
        assert_eq!(text.matches("launch_m_s = 4    # assumed: put in yours").count(), 3, "{text}");
        assert!(plan.ranges_beside_the_plan().is_empty());
        assert_eq!(plan.limits.drift_m, None);
        // Whoever presses Enter has measured nothing; an answer of his own is no assumption of the program.
        let of_site = ["rows", "columns", "spacing_m", "mass_kg", "rope"];
        let marked =
            |text: &str| of_site.map(|key| assumed_values(text).any(|value| value.key() == Some(key)));
        assert_eq!(marked(&text), [true; 5]);
        let mut own = offered;
        (own[1], own[2], own[3], own[4]) = ("4x10", "2.7", "281", "Polyester 24");
        assert_eq!(marked(&super::plan(&own).expect("answers")), [false; 5]);
        // Keys that only a program writes are not offered.
        let by_hand =
            |key: &&Key| !key.name.starts_with("delay_") && key.name != uncertainty::FITTED_FROM.name;
        for key in uncertainty::SECTION.keys.iter().copied().filter(by_hand) {
            assert!(text.contains(&format!("\n{} = ", key.name)), "{}", key.name);
            assert!(said.iter().any(|(_, keys)| keys.contains(&key.name)), "{}", key.name);
        }
    }

    #[test]
    fn rows_ranges_and_test_tires_are_understood() {
        let mut answers = QUESTIONS.map(|question| question.offered);
        (answers[5], answers[6], answers[7], answers[10]) = ("1, 4-5", "0.8 m", "9..109, 200", "3");
        let text = super::plan(&answers).expect("answers");
        let plan = Plan::parse("new", &text).unwrap_or_else(|mistakes| panic!("{mistakes}\n{text}"));
        assert_eq!(plan.limits.drift_m, Some(3.0));
        let holes: Vec<&str> = text.lines().filter(|line| line.starts_with("under_row")).collect();
        assert!(
            !text.contains("# assumed: put in yours\n[[") && text.contains("free_flight_height_m = 0.8\n")
        );
        assert_eq!(holes, ["under_row = 1", "under_row = 4", "under_row = 5"]);
        let names: Vec<&str> = plan.delays.iter().map(|delay| delay.name.as_str()).collect();
        assert_eq!(names, ["9 ms", "29 ms", "49 ms", "69 ms", "89 ms", "109 ms", "200 ms"]);
        let speed = plan.launches().next().expect("a launch").speed_m_s;
        assert!((speed - (2.0 * 9.81 * 0.8_f64).sqrt()).abs() < 1e-9);
    }

    #[test]
    fn a_wrong_answer_is_named() {
        for (question, answer) in [
            (1, "many"),
            (1, "5"),
            (5, "9"),
            (5, "0-2"),
            (5, ""),
            (6, "fast"),
            (6, ""),
            (6, "filmed"),
            (6, "m"),
            (7, "soon"),
            (7, "9..x"),
            (8, ""),
            (10, "far"),
        ] {
            let mut answers = QUESTIONS.map(|question| question.offered);
            answers[question] = answer;
            assert!(plan(&answers).is_err_and(|message| message.starts_with(QUESTIONS[question].text)));
        }
    }
}
