//! The questions of a new plan, and the uncertainty that a plan made from the answers assumes.

use crate::plan::keys::{Key, uncertainty};

/// A question of a new plan.
#[derive(Clone, Copy, Debug)]
pub struct Question {
    /// Text of the question.
    pub text: &'static str,
    /// The answer offered.
    pub offered: &'static str,
    /// Help below the question, line by line.
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
/// Assumption about the launch velocity, in words: first as a guess, then as filmed.
pub const LAUNCH_IS_KNOWN: [&str; 2] =
    ["launch guessed, give or take 50 %: no option passes", "launch filmed, give or take 10 %"];
/// Index of the question for the spacing in [`QUESTIONS`].
pub const SPACING: usize = 2;
/// Index of the question for a rope in [`QUESTIONS`].
pub const ROPE: usize = 4;
/// Uncertainty that a plan made from the answers assumes, in the words of a blaster. Beside each text stand the keys of `[uncertainty]`
/// that it is about.
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
/// Warning about forces in a plan whose cables have rigid ends; the drop is in `benches/RESULTS.md`, "Answers that are not ours".
pub const RIGID_ENDS: &str =
    "rigid ends of cables overstate snap forces: 2.7 times in one measured drop; no damping explains that";
/// Summary of what a plan made from the answers assumes.
pub const ASSUMED: &str =
    "assumed, check these: answers taken as offered, slack, friction, diameter, termination, [uncertainty]";
