//! A plan compared with observations of earlier shots.

use super::contradiction::Contradiction;
use super::other_shot::OtherShot;
use crate::plan::observations::Observation;

/// A plan compared with observations of earlier shots. A caller without observations uses [`nothing_seen`](Self::nothing_seen).
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct Comparison {
    objections: Vec<Objection>,
    not_compared: Option<NotCompared>,
    other_blasts: Vec<String>,
    above_bands: Vec<AboveBand>,
    unread_films: Vec<String>,
}

/// A value above its band, which holds nine of ten shots, by no more than chance explains. It puts no plan on HOLD.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AboveBand {
    /// The observation.
    pub seen: Observation,
    /// The upper end of the band [SI unit of the quantity].
    pub end: f64,
}

/// A reason from earlier shots against the verdicts of a plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Objection {
    /// Values or firing times that contradict the plan.
    Contradiction(Contradiction),
    /// The earlier shot had another charge, stemming or mass of tires.
    OtherShot(OtherShot),
}

/// Why observations are not compared with a plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotCompared {
    /// The time was up before the comparison.
    OutOfTime,
    /// The terminal has not yet compared them with the plan on the screen.
    NotYet,
    /// Observations of the record: only the planned shots were asked for, and these have no band in which a film could lie.
    NoSamples,
    /// Observations of the record: they do not fit the plan as it is now, arrived during the computation, or nobody looked.
    InRecord,
    /// The file of the plan is gone, so the record beside it cannot be read.
    NoPlan,
    /// The record's file cannot be read, has lost its plan, or is that of a plan with the same shelter. Holds the file and the reason.
    Unreadable(String),
    /// The runs of the comparison failed.
    RunsFailed,
    /// The plan was fitted to observations that were withdrawn.
    TakenBack,
}

impl Comparison {
    /// There are no observations of earlier shots.
    pub fn nothing_seen() -> Self {
        Self::compared(Vec::new())
    }

    /// All observations are compared. These `objections` speak against the plan.
    pub fn compared(objections: Vec<Objection>) -> Self {
        Self {
            objections,
            not_compared: None,
            other_blasts: Vec::new(),
            above_bands: Vec::new(),
            unread_films: Vec::new(),
        }
    }

    /// There are observations that are not compared.
    pub fn not_compared(why: NotCompared) -> Self {
        Self::nothing_seen().with_not_compared(Some(why))
    }

    /// The same, with more observations that are not compared if there is a reason `why`. An earlier reason stays.
    pub fn with_not_compared(self, why: Option<NotCompared>) -> Self {
        Self { not_compared: self.not_compared.or(why), ..self }
    }

    /// The same, with the names of record files beside it that are about other blasts.
    pub fn with_other_blasts(self, other_blasts: &[String]) -> Self {
        Self { other_blasts: other_blasts.to_vec(), ..self }
    }

    /// Names of record files beside that of the plan that are about other blasts. They are not compared with the plan and do not speak
    /// against it.
    pub fn other_blasts(&self) -> &[String] {
        &self.other_blasts
    }

    /// The same, with films in the plan's own folder of shots that nobody passed to the program.
    pub fn with_unread_films(self, unread_films: Vec<String>) -> Self {
        Self { unread_films, ..self }
    }

    /// Films in the plan's own folder of shots that nobody passed to the program.
    pub fn unread_films(&self) -> &[String] {
        &self.unread_films
    }

    /// The same, with values above their bands.
    pub fn with_above_bands(self, above_bands: Vec<AboveBand>) -> Self {
        Self { above_bands, ..self }
    }

    /// Values above their bands.
    pub fn above_bands(&self) -> &[AboveBand] {
        &self.above_bands
    }

    /// The reasons against the plan.
    pub fn objections(&self) -> &[Objection] {
        &self.objections
    }

    /// Why some observations are not compared; `None` if all are.
    pub fn why_not_compared(&self) -> Option<&NotCompared> {
        self.not_compared.as_ref()
    }

    /// Whether all observations are compared and none speaks against the plan.
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
        let both = speaks_against.clone().with_not_compared(Some(NotCompared::NotYet));
        assert!(agrees.agrees() && agrees.clone().with_not_compared(None).agrees());
        assert!([speaks_against, not_compared, both].iter().all(|compared| !compared.agrees()));
        let twice = agrees
            .with_not_compared(Some(NotCompared::NoPlan))
            .with_not_compared(Some(NotCompared::NotYet))
            .with_not_compared(None);
        assert_eq!(twice.why_not_compared(), Some(&NotCompared::NoPlan), "the first reason stays");
    }
}
