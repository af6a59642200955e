//! How a plan stands beside what was seen of earlier shots.

use super::contradiction::Contradiction;
use super::other_shot::OtherShot;
use crate::plan::observations::Observation;

/// A plan compared with what was seen of earlier shots. A caller without observations says so
/// ([`nothing_seen`](Self::nothing_seen)).
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct Comparison {
    objections: Vec<Objection>,
    not_compared: Option<NotCompared>,
    other_blasts: Vec<String>,
    above_bands: Vec<AboveBand>,
    unread_films: Vec<String>,
}

/// A value that lies above the band in which nine of ten shots lie, by no more than chance explains: nothing is held for it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AboveBand {
    /// What was seen.
    pub seen: Observation,
    /// The upper end of the band [SI unit of the quantity].
    pub end: f64,
}

/// What speaks against the verdicts of a plan, of what was seen of earlier shots.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Objection {
    /// Values or firing times that the plan leaves no room for.
    Contradiction(Contradiction),
    /// It was seen of a shot with another charge, stemming or mass of tires.
    OtherShot(OtherShot),
}

/// Why observations are not compared with a plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotCompared {
    /// The time was up before.
    OutOfTime,
    /// The terminal has not compared them with the plan on the screen.
    NotYet,
    /// They were told in the terminal, and only the shots as planned were asked for: these have no band in which a film could lie.
    PlannedAlone,
    /// They were told in the terminal. They do not fit this plan as it is now, came while it was computed, or nobody looked.
    InRecord,
    /// The file of the plan is gone, so the observations beside it cannot be read.
    NoPlan,
    /// They stand in a file that cannot be read, that has lost its plan, or whose plan is the same. Holds the file and the reason.
    Unreadable(String),
    /// The runs that would have compared them failed.
    RunsFailed,
    /// The plan was fitted to some that were taken back.
    TakenBack,
}

impl Comparison {
    /// Nothing was seen of earlier shots.
    pub fn nothing_seen() -> Self {
        Self::compared(Vec::new())
    }

    /// All that was seen is compared: these speak against the plan.
    pub fn compared(objections: Vec<Objection>) -> Self {
        Self {
            objections,
            not_compared: None,
            other_blasts: Vec::new(),
            above_bands: Vec::new(),
            unread_films: Vec::new(),
        }
    }

    /// Something was seen, and is not compared.
    pub fn not_compared(why: NotCompared) -> Self {
        Self::nothing_seen().except(Some(why))
    }

    /// The same, but more was seen that is not compared, if there is a reason `why`.
    pub fn except(self, why: Option<NotCompared>) -> Self {
        Self { not_compared: self.not_compared.or(why), ..self }
    }

    /// The same, beside files of these names that tell of other blasts.
    pub fn beside(self, other_blasts: &[String]) -> Self {
        Self { other_blasts: other_blasts.to_vec(), ..self }
    }

    /// Names of files beside that of the plan that tell of other blasts. Nobody has compared them with the plan, and none speaks against it.
    pub fn other_blasts(&self) -> &[String] {
        &self.other_blasts
    }

    /// The same, though nobody gave these films of the plan's own folder of shots.
    pub fn without(self, unread_films: Vec<String>) -> Self {
        Self { unread_films, ..self }
    }

    /// Films of the plan's own folder of shots that nobody gave.
    pub fn unread_films(&self) -> &[String] {
        &self.unread_films
    }

    /// The same, of which these values lie above their bands.
    pub fn with_above_bands(self, above_bands: Vec<AboveBand>) -> Self {
        Self { above_bands, ..self }
    }

    /// Values above their bands.
    pub fn above_bands(&self) -> &[AboveBand] {
        &self.above_bands
    }

    /// What speaks against the plan.
    pub fn objections(&self) -> &[Objection] {
        &self.objections
    }

    /// Why some of what was seen is not compared; `None` where all is.
    pub fn why_not_compared(&self) -> Option<&NotCompared> {
        self.not_compared.as_ref()
    }

    /// Whether all that was seen is compared, and nothing of it speaks against the plan.
    pub fn agrees(&self) -> bool {
        self.objections.is_empty() && self.not_compared.is_none()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_speaks_against_a_plan_or_is_not_compared_does_not_agree() {
        let against = Objection::Contradiction(Contradiction::Unpredicted { outside: 2, of: 2 });
        let [agrees, speaks_against] = [vec![], vec![against]].map(Comparison::compared);
        let not_compared = Comparison::not_compared(NotCompared::NotYet);
        let both = speaks_against.clone().except(Some(NotCompared::NotYet));
        assert!(agrees.agrees() && agrees.clone().except(None).agrees());
        assert!([speaks_against, not_compared, both].iter().all(|compared| !compared.agrees()));
        let twice = agrees.except(Some(NotCompared::NoPlan)).except(Some(NotCompared::NotYet)).except(None);
        assert_eq!(twice.why_not_compared(), Some(&NotCompared::NoPlan), "the first reason stays");
    }
}
