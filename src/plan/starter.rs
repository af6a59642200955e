//! The text of a plan from a few answers.

use std::fmt::Write;

/// What is asked of somebody with a new shelter; as typed.
pub const QUESTIONS: [(&str, &str); 9] = [
    ("title", "New shelter"),
    ("shelter rows (along the depth of the blast)", "5"),
    ("shelter columns (along the blast rows)", "10"),
    ("spacing of the tires, m", "2.6"),
    ("mass of a tire, kg", "280"),
    ("rope (Left Right: the catalogue)", "GOST 2688-80 14"),
    ("blast rows", "3"),
    ("intervals to compare, ms", "0, 9, 20, 25, 42, 67, 109"),
    ("flight height allowed, m", "1.8"),
];
/// Which of the [`QUESTIONS`] asks for a rope.
pub const ROPE: usize = 5;
/// Most blast rows offered to somebody who has only numbers for them.
const MOST_ROWS: usize = 50;
/// Launch velocity until somebody puts in a better one [m/s].
pub(super) const LAUNCH_M_S: f64 = 6.0;

/// A grid of tires over the blast rows, all of one mass and tied with one rope.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shelter<'s> {
    pub rows: usize,
    pub columns: usize,
    pub spacing_m: f64,
    pub mass_kg: f64,
    pub rope: &'s str,
}

/// Outer diameter of an 18.00-25 tire [m].
const DIAMETER_M: f64 = 1.6;
/// Tires nearer together than this leave no room for cables from rim to rim [m].
const ROOMY_M: f64 = 2.0;

/// As the [`QUESTIONS`] offer it.
pub(super) const USUAL: Shelter<'_> =
    Shelter { rows: 5, columns: 10, spacing_m: 2.6, mass_kg: 280.0, rope: "GOST 2688-80 14" };

impl Shelter<'_> {
    /// What a plan says before its blast rows; `place` is a comment on where the tires lie.
    pub(super) fn sections(&self, title: &str, place: &str) -> String {
        let quoted = |text: &str| toml_edit::value(text).to_string();
        let Self { rows, columns, spacing_m, mass_kg, rope } = self;
        let diameter_m = if *spacing_m >= ROOMY_M { DIAMETER_M } else { 0.0 };
        format!(
            "title = {}

[shelter]{place}
layout = \"grid\"
rows = {rows}                # along y, numbered from 1
columns = {columns}            # along x, numbered from 1
spacing_m = {spacing_m}         # centre to centre

[tire]
mass_kg = {mass_kg}
outer_diameter_m = {diameter_m}  # cables run from rim to rim; 0: from centre to centre

[cable]
rope = {}         # `shelter ropes` lists the catalogue
termination = \"mechanical sleeve\"
slack_percent = 2

[ground]
friction = 0.5          # rocky soil 0.3 to 0.5
",
            quoted(title),
            quoted(rope)
        )
    }
}

/// The limits of a plan, one of them a height [m].
pub(super) fn limits(height_m: f64) -> String {
    format!(
        "\n[limits]\nflight_height_m = {height_m}\ncable_safety_factor = 1.5   # breaking force / greatest force\n"
    )
}

/// A delay option by its interval [ms].
pub(super) fn delay(interval_ms: f64) -> String {
    format!("\n[[delay]]\nname = \"{interval_ms} ms\"\ninterval_ms = {interval_ms}\n")
}

/// The plan, blast rows spread evenly under the shelter; or which answer is no answer.
///
/// What is wrong with a number in itself is told when the plan is read.
pub fn plan(answers: &[&str; QUESTIONS.len()]) -> Result<String, String> {
    let [title, rows, columns, spacing, mass, rope, blast_rows, intervals, height] = answers.map(str::trim);
    let number = |text: &str, question: usize| {
        let value =
            text.parse::<f64>().map_err(|_| format!("{}: '{text}' is no number", QUESTIONS[question].0))?;
        Ok::<f64, String>(value)
    };
    let count = |text: &str, question: usize| {
        text.parse::<usize>().map_err(|_| format!("{}: '{text}' is no whole number", QUESTIONS[question].0))
    };
    let (rows, columns, blast_rows) = (count(rows, 1)?, count(columns, 2)?, count(blast_rows, 6)?);
    let (spacing, mass, height) = (number(spacing, 3)?, number(mass, 4)?, number(height, 8)?);
    if blast_rows == 0 || blast_rows > rows.min(MOST_ROWS) {
        return Err(format!("{}: 1 to {}, one per shelter row at most", QUESTIONS[6].0, rows.min(MOST_ROWS)));
    }
    let intervals: Vec<f64> = intervals
        .split([',', ' ', ';'])
        .filter(|interval| !interval.is_empty())
        .map(|interval| number(interval, 7))
        .collect::<Result<_, _>>()?;
    let mut text = Shelter { rows, columns, spacing_m: spacing, mass_kg: mass, rope }.sections(title, "");
    for row in 0..blast_rows {
        let under = (2 * row + 1) * rows / (2 * blast_rows) + 1;
        let name = row + 1;
        let _ = write!(
            text,
            "\n[[blast_row]]\nname = \"{name}\"\nunder_row = {under}\nlaunch_m_s = {LAUNCH_M_S:?}    # put in yours\n"
        );
    }
    text += &limits(height);
    intervals.into_iter().for_each(|interval| text += &delay(interval));
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Plan;

    #[test]
    fn the_answers_offered_make_a_plan() {
        let text = plan(&QUESTIONS.map(|(_, answer)| answer)).expect("answers");
        let plan = Plan::parse("new", &text).unwrap_or_else(|mistakes| panic!("{mistakes}\n{text}"));
        assert_eq!((plan.blast_rows.len(), plan.delays.len()), (3, 7));
    }

    #[test]
    fn what_is_no_answer_is_named() {
        for (question, answer) in [(1, "many"), (6, "9"), (7, "soon"), (8, "")] {
            let mut answers = QUESTIONS.map(|(_, answer)| answer);
            answers[question] = answer;
            assert!(plan(&answers).is_err_and(|words| words.starts_with(QUESTIONS[question].0)));
        }
    }
}
