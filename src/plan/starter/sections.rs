//! The sections of a new plan as text. A comment beside a value gives its meaning, and says whether the value is assumed.

use std::fmt::Display;

use super::questions::{QUESTIONS, ROPE};
use crate::choice::LayoutKind;
use crate::plan::keys::{Key, Section, cable, delay, ground, limits, plan, shelter, tire, uncertainty};
use crate::ropes::catalogue;

/// Launch velocity of a starter plan [m/s]; the user replaces it.
pub(in crate::plan) const LAUNCH_M_S: f64 = 6.0;

/// Comment in a blast row whose holes have that velocity because nobody gave one. A fit takes the comment out.
pub(in crate::plan) const LAUNCH_IS_ASSUMED: &str =
    "# launch_m_s of these holes is assumed: film a tire, then `shelter launch` or `shelter fit` writes it";

/// A grid of tires over the blast rows. All tires have one mass, and one rope ties them.
#[derive(Clone, Copy, Debug)]
pub(in crate::plan) struct Shelter<'s> {
    pub rows: usize,
    pub columns: usize,
    pub spacing_m: f64,
    pub mass_kg: f64,
    pub rope: &'s str,
    /// Keys whose values nobody was asked for, or left as they were offered.
    pub assumed: &'s [&'static Key],
}

/// Outer diameter of an 18.00-25 tire [m].
const DIAMETER_M: f64 = 1.6;
/// Smallest spacing that leaves room for cables from rim to rim [m].
const ROOMY_M: f64 = 2.0;

/// The shelter that the [`QUESTIONS`] offer.
pub(in crate::plan) const USUAL: Shelter<'_> = Shelter {
    rows: 5,
    columns: 10,
    spacing_m: 2.6,
    mass_kg: 280.0,
    rope: QUESTIONS[ROPE].offered,
    assumed: &[&shelter::ROWS, &shelter::COLUMNS, &tire::MASS_KG, &cable::ROPE],
};

impl Shelter<'_> {
    /// The text of a plan before its blast rows; `remark` is a comment behind the header of the shelter.
    pub(in crate::plan) fn sections(&self, title: &str, remark: &str) -> String {
        let diameter_m = diameter_m(self.spacing_m);
        let is_assumed = |key: &Key| self.assumed.iter().any(|assumed| assumed.name == key.name);
        let given = |key: &Key, value: &dyn Display| {
            if is_assumed(key) { assumed_key(key, value) } else { explained(key, value) }
        };
        [
            line(&plan::TITLE, quoted(title)),
            format!("\n{}{remark}\n", shelter::SECTION.title),
            line(&shelter::LAYOUT, quoted(LayoutKind::Grid.name())),
            given(&shelter::ROWS, &self.rows),
            given(&shelter::COLUMNS, &self.columns),
            given(&shelter::SPACING_M, &self.spacing_m),
            assumed_key(&shelter::LINKS, &"[\"row\", \"column\", \"diagonal\"]"),
            header(&tire::SECTION),
            remarked(
                &tire::MASS_KG,
                &self.mass_kg,
                if is_assumed(&tire::MASS_KG) { "assumed: weigh some" } else { "of one tire" },
            ),
            assumed_key(&tire::OUTER_DIAMETER_M, &diameter_m),
            header(&cable::SECTION),
            given(&cable::ROPE, &quoted(self.rope)),
            termination(self.rope),
            remarked(&cable::SLACK_PERCENT, &2, "assumed: measure yours"),
            header(&ground::SECTION),
            assumed_key(&ground::FRICTION, &0.5),
        ]
        .concat()
    }
}

/// Termination of a new plan where it fits the rope. Other ropes get a splice, as fibre ropes have.
pub(super) const SLEEVE: &str = "mechanical sleeve";
/// Share of the breaking force that a splice holds [%].
pub(super) const SPLICE_PERCENT: u8 = 70;

pub(super) fn has_sleeve(rope: &str) -> bool {
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
pub(super) fn diameter_m(spacing_m: f64) -> f64 {
    if spacing_m >= ROOMY_M { DIAMETER_M } else { 0.0 }
}

/// An empty line and the header of a section.
pub(in crate::plan) fn header(section: &Section) -> String {
    format!("\n{}\n", section.title)
}

/// A key with its value.
pub(in crate::plan) fn line(key: &Key, value: impl Display) -> String {
    format!("{} = {value}\n", key.name)
}

/// A key with its value, and its description as a comment.
pub(super) fn explained(key: &Key, value: &dyn Display) -> String {
    remarked(key, value, key.doc)
}

/// A key with its value, and its description as a comment that says that the value is assumed.
fn assumed_key(key: &Key, value: &dyn Display) -> String {
    remarked(key, value, &format!("assumed; {}", key.doc))
}

/// A key with its value, and a comment.
fn remarked(key: &Key, value: &dyn Display, remark: &str) -> String {
    format!("{:<23} # {remark}\n", format!("{} = {value}", key.name))
}

/// A text in quotes, as TOML writes it.
pub(in crate::plan) fn quoted(text: &str) -> String {
    toml_edit::value(text).to_string()
}

/// The limits of a plan: flight height [m] and safety factor of the cables. Shots with any one dud must keep the limits, too. `is_assumed`:
/// nobody was asked for the two values.
pub(in crate::plan) fn limits(height_m: f64, safety_factor: f64, is_assumed: bool) -> String {
    let limit = if is_assumed { assumed_key } else { explained };
    [
        header(&limits::SECTION),
        limit(&limits::FLIGHT_HEIGHT_M, &height_m),
        limit(&limits::CABLE_SAFETY_FACTOR, &safety_factor),
        explained(&limits::WITHSTANDS_ONE_DUD, &true),
    ]
    .concat()
}

/// The uncertainty of the shot: typical figures, each with its source. A `guessed` launch velocity is marked as an estimate. The stiffness
/// of steel ropes is known better than the stiffness of fibre ropes.
pub(in crate::plan) fn uncertainty(guessed: bool, rope: &str) -> String {
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
pub(in crate::plan) fn delay(interval_ms: f64) -> String {
    let name = line(&delay::NAME, quoted(&format!("{interval_ms} ms")));
    header(&delay::SECTION) + &name + &line(&delay::INTERVAL_MS, interval_ms)
}
