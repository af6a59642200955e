//! The text of a starter plan, from a few answers.

use std::fmt::Display;

use super::keys::{Key, Section, blast_row, cable, delay, ground, limits, plan, shelter, tire, uncertainty};
use crate::choice::LayoutKind;
use crate::ropes::catalogue;
use crate::sorting::sort;

/// A question of a new plan.
#[derive(Clone, Copy, Debug)]
pub struct Question {
    /// What is asked.
    pub text: &'static str,
    /// The answer offered.
    pub offered: &'static str,
    /// What is said below while it is answered.
    pub help: &'static [&'static str],
}

/// Questions for a new shelter, each with the answer offered.
pub const QUESTIONS: [Question; 11] = [
    Question {
        text: "title",
        offered: "New shelter",
        help: &["It heads the page that is signed: site, and place on it."],
    },
    Question {
        text: "shelter: rows x tires, as 5x10",
        offered: "5x10",
        help: &[
            "Rows of tires, and tires in a row. The outer rows may lie over no hole:",
            "they are ballast that holds the others down.",
        ],
    },
    Question {
        text: "spacing of the tires, m",
        offered: "2.6",
        help: &["From centre to centre of neighbours, and from hole to hole below."],
    },
    Question {
        text: "mass of a tire, kg",
        offered: "280",
        help: &["Weigh five worn ones: lighter tires fly higher."],
    },
    Question {
        text: "rope (Left Right: catalogue)",
        offered: "Polyester 28",
        help: &["New rope, as its maker states it. A worn one breaks earlier."],
    },
    Question {
        text: "shelter rows over holes, as 2-4",
        offered: "2-4",
        help: &["2-4: holes lie under rows 2, 3 and 4 of the shelter, one under each tire."],
    },
    Question {
        text: "launch, m/s: guess, or `4 filmed`",
        offered: "4",
        help: &[
            "A number alone is a guess: no option passes on it.",
            "`4 filmed` was seen; `0.8 m` is how high a loose tire rose.",
            "`shelter launch` shows what charge and stemming allow.",
        ],
    },
    Question {
        text: "intervals, ms, as 9, 25 or 9..109",
        offered: "0, 9, 20, 25, 42, 67, 109",
        help: &["Delays from one row of holes to the next; each is judged. 0: all at once."],
    },
    Question {
        text: "flight height allowed, m",
        offered: "2",
        help: &["How high a tire's centre may rise; an edge may stand half a diameter higher."],
    },
    Question {
        text: "safety factor of the cables",
        offered: "1.5",
        help: &["The force allowed is what the tied rope holds, divided by this."],
    },
    Question {
        text: "slide allowed, m (empty: any)",
        offered: "",
        help: &["How far a tire may end from its place. Empty: no verdict looks at it."],
    },
];
/// Index of the question for the launch velocity in [`QUESTIONS`].
pub const LAUNCH: usize = 6;
/// How well the launch velocity of the plan is known: as a guess, and as filmed.
pub const LAUNCH_IS_KNOWN: [&str; 2] =
    ["launch guessed, give or take 50 %: no option passes", "launch filmed, give or take 10 %"];
/// Index of the question for the spacing in [`QUESTIONS`].
const SPACING: usize = 2;
/// Index of the question for a rope in [`QUESTIONS`].
pub const ROPE: usize = 4;
/// What a plan made from the answers takes as not known, in the words of a blaster; each key of `[uncertainty]` that it is about stands
/// beside it.
pub const NOT_KNOWN: [(&str, &[&Key]); 11] = [
    (
        "tires leave give or take 5 %, shots another 5 %",
        &[
            &uncertainty::LAUNCH_CV_PERCENT,
            &uncertainty::LAUNCH_ROW_CV_PERCENT,
            &uncertainty::LAUNCH_BETWEEN_SHOTS_PERCENT,
            &uncertainty::LAUNCH_MASS_EXPONENT,
        ],
    ),
    (
        "each leaves 3° off its direction, all together 0.5°",
        &[&uncertainty::LAUNCH_TILT_DEG, &uncertainty::LAUNCH_TILT_COMMON_DEG],
    ),
    ("a hole lies 5 cm off the middle of its tire, along each axis", &[&uncertainty::HOLE_POSITION_M]),
    ("the shelter lies 5 cm off the holes, along each axis", &[&uncertainty::PATTERN_OFFSET_M]),
    ("1 hole in 10,000 does not fire", &[&uncertainty::HOLE_FAILS_PERCENT]),
    ("a cable is tied 1 cm too long or too short", &[&uncertainty::CABLE_LENGTH_M]),
    ("cables hang through by 1 to 4 %", &[&uncertainty::SLACK_PERCENT]),
    ("ropes break at their force, give or take 3 %", &[&uncertainty::BREAKING_FORCE_CV_PERCENT]),
    ("tires weigh as written, give or take 10 %", &[&uncertainty::TIRE_MASS_CV_PERCENT]),
    ("friction on the ground is 0.3 to 0.5", &[&uncertainty::FRICTION]),
    ("detonators are electronic", &[&uncertainty::DETONATOR, &uncertainty::IN_HOLE_DELAY_MS]),
];
/// What a plan whose cables have rigid ends makes of forces; `benches/RESULTS.md`, "Answers that are not ours", has the drop.
pub const RIGID_ENDS: &str =
    "rigid ends of cables overstate snap forces: 2.7 times in one measured drop; no damping explains that";
/// What a plan made from the answers assumes.
pub const ASSUMED: &str =
    "assumed, check these: answers taken as offered, slack, friction, diameter, termination, [uncertainty]";
/// Most blast rows of a starter plan.
const MOST_ROWS: usize = 50;
/// Intervals of a range without a step.
const INTERVALS_OF_RANGE: usize = 6;
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
    /// Whether nobody was asked for tires and rope.
    pub is_assumed: bool,
}

/// Outer diameter of an 18.00-25 tire [m].
const DIAMETER_M: f64 = 1.6;
/// Smallest spacing that leaves room for cables from rim to rim [m].
const ROOMY_M: f64 = 2.0;

/// The shelter that the [`QUESTIONS`] offer.
pub(super) const USUAL: Shelter<'_> = Shelter {
    rows: 5,
    columns: 10,
    spacing_m: 2.6,
    mass_kg: 280.0,
    rope: QUESTIONS[ROPE].offered,
    is_assumed: true,
};

impl Shelter<'_> {
    /// The text of a plan before its blast rows; `remark` is a comment behind the header of the shelter.
    pub(super) fn sections(&self, title: &str, remark: &str) -> String {
        let diameter_m = diameter_m(self.spacing_m);
        [
            line(&plan::TITLE, quoted(title)),
            format!("\n{}{remark}\n", shelter::SECTION.title),
            line(&shelter::LAYOUT, quoted(LayoutKind::Grid.name())),
            explained(&shelter::ROWS, &self.rows),
            explained(&shelter::COLUMNS, &self.columns),
            explained(&shelter::SPACING_M, &self.spacing_m),
            header(&tire::SECTION),
            remarked(
                &tire::MASS_KG,
                &self.mass_kg,
                if self.is_assumed { "assumed: weigh some" } else { "of one tire" },
            ),
            assumed_key(&tire::OUTER_DIAMETER_M, &diameter_m),
            header(&cable::SECTION),
            if self.is_assumed { assumed_key } else { explained }(&cable::ROPE, &quoted(self.rope)),
            termination(self.rope),
            remarked(&cable::SLACK_PERCENT, &2, "assumed: measure yours"),
            header(&ground::SECTION),
            assumed_key(&ground::FRICTION, &0.5),
        ]
        .concat()
    }
}

/// The termination that a rope gets where it fits; else it gets the splice that fibre ropes have.
const SLEEVE: &str = "mechanical sleeve";
/// Share of the breaking force that a splice holds [%].
const SPLICE_PERCENT: u8 = 70;

fn has_sleeve(rope: &str) -> bool {
    let family = catalogue().find(rope).map(|rope| rope.family.as_str());
    family.is_none_or(|family| catalogue().fits(SLEEVE, family))
}

fn termination(rope: &str) -> String {
    match has_sleeve(rope) {
        true => remarked(&cable::TERMINATION, &quoted(SLEEVE), "assumed"),
        false => remarked(
            &cable::TERMINATION_PERCENT,
            &SPLICE_PERCENT,
            "assumed: spliced eyes; a well made splice leaves 70 to 90 % (FM 55-501)",
        ),
    }
}

/// Outer diameter of the tires of a shelter with this spacing [m]; 0 where cables run from centre to centre.
fn diameter_m(spacing_m: f64) -> f64 {
    if spacing_m >= ROOMY_M { DIAMETER_M } else { 0.0 }
}

/// All that a plan made from the answers assumes, a line each, with the keys of the plan that say it: of the shelter, then of the shot.
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

/// An empty line and the header of a section.
pub(super) fn header(section: &Section) -> String {
    format!("\n{}\n", section.title)
}

/// A key with its value.
pub(super) fn line(key: &Key, value: impl Display) -> String {
    format!("{} = {value}\n", key.name)
}

/// A key with its value, and its description as a comment.
fn explained(key: &Key, value: &dyn Display) -> String {
    remarked(key, value, key.doc)
}

/// The same of a value that nobody was asked for.
fn assumed_key(key: &Key, value: &dyn Display) -> String {
    remarked(key, value, &format!("assumed; {}", key.doc))
}

/// A key with its value, and a comment.
fn remarked(key: &Key, value: &dyn Display, remark: &str) -> String {
    format!("{:<23} # {remark}\n", format!("{} = {value}", key.name))
}

/// A text in quotes, as TOML writes it.
pub(super) fn quoted(text: &str) -> String {
    toml_edit::value(text).to_string()
}

/// The limits of a plan: its flight height [m] and the safety factor of its cables; `is_assumed`: nobody was asked for them. No dud may
/// exceed them.
pub(super) fn limits(height_m: f64, safety_factor: f64, is_assumed: bool) -> String {
    let limit = if is_assumed { assumed_key } else { explained };
    [
        header(&limits::SECTION),
        limit(&limits::FLIGHT_HEIGHT_M, &height_m),
        limit(&limits::CABLE_SAFETY_FACTOR, &safety_factor),
        explained(&limits::WITHSTANDS_ONE_DUD, &true),
    ]
    .concat()
}

/// What is not known of the shot: typical figures, each with its source. A launch velocity that is `guessed` is marked as an estimate.
/// Ropes of steel are known better than those of fibre.
pub(super) fn uncertainty(guessed: bool, rope: &str) -> String {
    let [percent, known] = match guessed {
        true => ["50", "nobody observed it: no option passes before a shot or a test tire is filmed"],
        false => ["10", "of a velocity from a flight height known to 20 %: V0 = √(2 g h)"],
    };
    let [stiffness, of_rope] = match has_sleeve(rope) {
        true => ["[-10, 10]", "handbooks: modulus of fibre-core steel ropes 0.9 to 1.1e11 Pa"],
        false => ["[-20, 50]", "assumed: ask its maker; a rope of fibre is stiffer when it is pulled fast"],
    };
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
            "assumed: 0.1 ms or 0.01 %, by specification sheets; or \"pyrotechnic\"",
        ),
        typical(
            &uncertainty::IN_HOLE_DELAY_MS,
            "0",
            "of the detonator in every hole; assumed: there is none, or it is electronic",
        ),
        typical(&uncertainty::LAUNCH_CV_PERCENT, "5", "hole by hole; assumed: put in yours"),
        typical(&uncertainty::LAUNCH_ROW_CV_PERCENT, "1", "row by row; assumed"),
        typical(&uncertainty::LAUNCH_COMMON_PERCENT, percent, known),
        typical(&uncertainty::LAUNCH_BETWEEN_SHOTS_PERCENT, "5", "from shot to shot; assumed: put in yours"),
        typical(
            &uncertainty::LAUNCH_MASS_EXPONENT,
            "[0, 1]",
            "a tire of mass m' leaves with V0 (m/m')^n; no measurement decides",
        ),
        typical(&uncertainty::LAUNCH_TILT_DEG, "3", "assumed: put in yours"),
        typical(&uncertainty::LAUNCH_TILT_COMMON_DEG, "0.5", "of all launches together; assumed"),
        typical(&uncertainty::HOLE_POSITION_M, "0.05", "of a hole about its mark; assumed: measure some"),
        typical(
            &uncertainty::PATTERN_OFFSET_M,
            "0.05",
            "of the shelter over all holes; assumed: measure at two corners",
        ),
        typical(&uncertainty::HOLE_FAILS_PERCENT, "0.01", "duds; assumed"),
        typical(&uncertainty::CABLE_LENGTH_M, "0.01", "of a rope as tied; assumed: measure some"),
        typical(&uncertainty::FRICTION, "[0.3, 0.5]", "rocky soil"),
        typical(
            &uncertainty::SLACK_PERCENT,
            "[1, 4]",
            "assumed: measure yours; new ropes stretch by 0.25 to 0.75 % for good (Certex)",
        ),
        typical(&uncertainty::AXIAL_STIFFNESS_PERCENT, stiffness, of_rope),
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

/// The text of an answer for the launch velocity that was filmed; `None` where it is a guess.
fn filmed(launch: &str) -> Option<&str> {
    launch.trim().strip_suffix(FILMED).map(str::trim)
}

/// Whether an answer for the launch velocity is a guess: nothing says that it was filmed.
pub fn is_guessed(launch: &str) -> bool {
    filmed(launch).is_none() && !launch.trim().ends_with('m')
}

/// What stands behind a launch velocity that was filmed.
const FILMED: &str = "filmed";

/// The text of the plan, or a message that names a wrong answer.
///
/// Ranges of numbers are checked when the plan is read.
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
        // Many write a comma before the decimals: `12,5` may be one number.
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
    let mut text = Shelter { rows, columns, spacing_m: spacing, mass_kg: mass, rope, is_assumed: false }
        .sections(title, "");
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

/// Shelter rows in words: `2-4`, `1, 3`; or why there are no such rows.
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

/// Whole numbers at even distances from one end to the other.
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

    /// `12,5` may be one interval or two: nobody fires one that was never asked for. The ends of a range are those typed.
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

    /// A screen of 80 columns cuts no help.
    #[test]
    fn help_has_room() {
        for line in QUESTIONS.iter().flat_map(|question| question.help) {
            assert!(line.chars().count() < 79, "{line}");
        }
    }

    /// A launch is marked as an estimate unless the answer says that it was filmed: also the one offered, and any number alone.
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
        // What only a program writes is not offered.
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
