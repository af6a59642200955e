//! The text of a starter plan, from a few answers.

use std::fmt::Display;

use super::keys::{Key, Section, blast_row, cable, delay, ground, limits, plan, shelter, tire, uncertainty};
use crate::choice::LayoutKind;

/// Questions for a new shelter, each with the answer offered.
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
/// Index of the question for a rope in [`QUESTIONS`].
pub const ROPE: usize = 5;
/// Most blast rows of a starter plan.
const MOST_ROWS: usize = 50;
/// Launch velocity of a starter plan [m/s]; the user replaces it.
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
/// Smallest spacing that leaves room for cables from rim to rim [m].
const ROOMY_M: f64 = 2.0;

/// The shelter that the [`QUESTIONS`] offer.
pub(super) const USUAL: Shelter<'_> =
    Shelter { rows: 5, columns: 10, spacing_m: 2.6, mass_kg: 280.0, rope: "GOST 2688-80 14" };

impl Shelter<'_> {
    /// The text of a plan before its blast rows; `remark` is a comment behind the header of the shelter.
    pub(super) fn sections(&self, title: &str, remark: &str) -> String {
        let diameter_m = if self.spacing_m >= ROOMY_M { DIAMETER_M } else { 0.0 };
        [
            line(&plan::TITLE, quoted(title)),
            format!("\n{}{remark}\n", shelter::SECTION.title),
            line(&shelter::LAYOUT, quoted(LayoutKind::Grid.name())),
            explained(&shelter::ROWS, self.rows),
            explained(&shelter::COLUMNS, self.columns),
            explained(&shelter::SPACING_M, self.spacing_m),
            header(&tire::SECTION),
            line(&tire::MASS_KG, self.mass_kg),
            explained(&tire::OUTER_DIAMETER_M, diameter_m),
            header(&cable::SECTION),
            explained(&cable::ROPE, quoted(self.rope)),
            line(&cable::TERMINATION, quoted("mechanical sleeve")),
            line(&cable::SLACK_PERCENT, 2),
            header(&ground::SECTION),
            explained(&ground::FRICTION, 0.5),
        ]
        .concat()
    }
}

/// An empty line and the header of a section.
pub(super) fn header(section: &Section) -> String {
    format!("\n{}\n", section.title)
}

/// A key with its value.
pub(super) fn line(key: &Key, value: impl Display) -> String {
    format!("{} = {value}\n", key.name)
}

/// A key with its value, and its description as a comment.
fn explained(key: &Key, value: impl Display) -> String {
    format!("{:<23} # {}\n", format!("{} = {value}", key.name), key.doc)
}

/// A text in quotes, as TOML writes it.
pub(super) fn quoted(text: &str) -> String {
    toml_edit::value(text).to_string()
}

/// The limits of a plan, with its limit of flight height [m].
pub(super) fn limits(height_m: f64) -> String {
    [
        header(&limits::SECTION),
        line(&limits::FLIGHT_HEIGHT_M, height_m),
        explained(&limits::CABLE_SAFETY_FACTOR, 1.5),
    ]
    .concat()
}

/// What is not known of the shot: typical figures, each with its source.
pub(super) fn uncertainty() -> String {
    let typical = |key: &Key, value: &str, source: &str| {
        format!("{:<36} # {source}\n", format!("{} = {value}", key.name))
    };
    [
        format!(
            "{} # what is not known, and how far; put in yours\n",
            header(&uncertainty::SECTION).trim_end()
        ),
        typical(
            &uncertainty::DETONATOR,
            "\"electronic\"",
            "0.1 ms or 0.01 %: specification sheets; or \"pyrotechnic\"",
        ),
        typical(
            &uncertainty::IN_HOLE_DELAY_MS,
            "0",
            "of the detonator in every hole; 0: there is none, or it is electronic",
        ),
        typical(&uncertainty::LAUNCH_CV_PERCENT, "5", "hole by hole; assumed: put in yours"),
        typical(
            &uncertainty::LAUNCH_COMMON_PERCENT,
            "10",
            "of a velocity from a flight height known to 20 %: V0 = √(2 g h)",
        ),
        typical(&uncertainty::LAUNCH_TILT_DEG, "3", "assumed: put in yours"),
        typical(&uncertainty::FRICTION, "[0.3, 0.5]", "rocky soil"),
        typical(
            &uncertainty::SLACK_PERCENT,
            "[1, 4]",
            "assumed: measure yours; new ropes stretch by 0.25 to 0.75 % for good (Certex)",
        ),
        typical(
            &uncertainty::AXIAL_STIFFNESS_PERCENT,
            "[-10, 10]",
            "handbooks: modulus of fibre-core ropes 0.9 to 1.1e11 Pa",
        ),
        typical(
            &uncertainty::TIRE_MASS_CV_PERCENT,
            "10",
            "assumed: new tires of one size differ by ±15 %, worn ones weigh 10 to 25 % less",
        ),
        typical(&uncertainty::BREAKING_FORCE_CV_PERCENT, "3", "assumed: put in yours"),
    ]
    .concat()
}

/// A delay option with its interval [ms].
pub(super) fn delay(interval_ms: f64) -> String {
    let name = line(&delay::NAME, quoted(&format!("{interval_ms} ms")));
    header(&delay::SECTION) + &name + &line(&delay::INTERVAL_MS, interval_ms)
}

/// The text of the plan, with blast rows spread evenly under the shelter; or a message that names a wrong answer.
///
/// Ranges of numbers are checked when the plan is read.
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
        text += &header(&blast_row::SECTION);
        text += &line(&blast_row::NAME, quoted(&name.to_string()));
        text += &line(&blast_row::UNDER_ROW, under);
        text += &line(&blast_row::LAUNCH_M_S, format!("{LAUNCH_M_S:?}    # put in yours"));
    }
    text += &limits(height);
    intervals.into_iter().for_each(|interval| text += &delay(interval));
    text += &uncertainty();
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
        assert!(plan.ranges_beside_the_plan().is_empty());
        for key in uncertainty::SECTION.keys.iter().filter(|key| !key.name.starts_with("delay_")) {
            assert!(text.contains(&format!("\n{} = ", key.name)), "{}", key.name);
        }
    }

    #[test]
    fn a_wrong_answer_is_named() {
        for (question, answer) in [(1, "many"), (6, "9"), (7, "soon"), (8, "")] {
            let mut answers = QUESTIONS.map(|(_, answer)| answer);
            answers[question] = answer;
            assert!(plan(&answers).is_err_and(|message| message.starts_with(QUESTIONS[question].0)));
        }
    }
}
