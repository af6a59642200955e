//! The studies on the screen: the state of each study, and which study is shown.

use std::fmt;
use std::sync::Arc;

use super::study_answer::StudyAnswer;
use crate::jobs::StudyAt;
use crate::plan::observations::Observations;
use crate::report::answer::{ReportAsIfStanding, in_brief};
use crate::report::fit::not_writable;
use crate::study::effects::EffectsOnOptions;
use crate::study::fit::{Fit, FitResult};
use crate::study::flight::Flight;
use crate::study::observed::Comparison;
use crate::study::question::{Found, StudyKind};
use crate::study::remedies::Remedies;
use crate::study::sweep::Sweep;
use crate::study::{Case, ComputeSettings, Computed, NoResult};

/// State of one study.
#[derive(Clone, Debug, Default)]
pub enum StudyState {
    /// Not begun, or cancelled.
    #[default]
    Idle,
    /// Computing.
    Running(StudyAt),
    /// Has a result. The result stays while other screens are shown.
    Done(Arc<ShownStudy>),
    /// Ended without a result.
    Failed(NoResult),
}

/// The result of a study.
#[derive(Debug)]
pub struct ShownStudy {
    /// The result as computed.
    pub found: Found,
    /// The settings of the computation.
    pub compute: ComputeSettings,
    /// The report of the result. The standing of the plan is added when it is drawn.
    pub report: ReportAsIfStanding,
    /// The answer in one line.
    pub answer: StudyAnswer,
    /// How the plan agrees with the observations of earlier shots, if this study compares them.
    pub compared: Option<Comparison>,
}

impl ShownStudy {
    /// Makes report and answer of a result.
    pub fn new(case: &Case, compute: ComputeSettings, found: Found) -> Self {
        let report = ReportAsIfStanding::of(case, &found);
        let compared = match &found {
            Found::Fit(compared) => Some(compared.value.comparison(case)),
            _ => None,
        };
        let answer = StudyAnswer::new(in_brief(case, &found), report.concluded());
        Self { found, compute, report, answer, compared }
    }

    /// The fit whose estimates may go into the plan of `case`, and its observations; or the reason why there is none.
    pub fn estimates(&self, case: &Case) -> Result<(&Fit, &[Observations]), String> {
        let Found::Fit(compared) = &self.found else { return Err("this is no fit".to_owned()) };
        let new = &compared.value.new;
        match &compared.value.fitted {
            Some(FitResult::Fitted(fit)) => match fit.not_writable(case, new) {
                Some(why) => Err(not_writable(case, &why)),
                None => Ok((fit, new)),
            },
            Some(_) => Err("the observations determine none".to_owned()),
            None => Err("the plan was fitted to all observations".to_owned()),
        }
    }
}

impl fmt::Display for StudyState {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            StudyState::Idle => Ok(()),
            StudyState::Running(at) => write!(f, "{:.0} %", (1e2 * at.progress.fraction).floor()),
            StudyState::Done(_) => write!(f, "✓"),
            StudyState::Failed(_) => write!(f, "no result"),
        }
    }
}

/// The open list of changes with which an option would pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RemedyList {
    /// Index of the option.
    pub option: usize,
    /// Selected line; `None` until the user moves in the list. So no change is made that the user has not seen.
    pub selected: Option<usize>,
}

/// All studies, and which one is shown.
#[derive(Clone, Debug)]
pub struct Studies {
    /// The study on the screen, or the selected study among the questions.
    pub shown: StudyKind,
    /// Whether the study fills the screen. Otherwise all questions stand above it.
    pub open: bool,
    /// Lines that the study is scrolled.
    pub scroll: u16,
    /// Only lines that contain this text are shown.
    pub filter: String,
    /// Index of the selected row among the rows that offer a change of the plan.
    pub selected: usize,
    /// The open list of [`StudyKind::Remedies`]; `None` while it is closed.
    pub remedy_list: Option<RemedyList>,
    /// Text of the plan on the screen.
    plan: Arc<str>,
    states: [StudyState; StudyKind::ALL.len()],
    /// Text of the plan that each state belongs to.
    plans: [Arc<str>; StudyKind::ALL.len()],
}

impl Studies {
    /// No studies yet, for a plan with the text `plan`.
    pub fn new(plan: &str) -> Self {
        let plan: Arc<str> = plan.into();
        Self {
            shown: StudyKind::Sweep,
            open: false,
            scroll: 0,
            filter: String::new(),
            selected: 0,
            remedy_list: None,
            states: Default::default(),
            plans: std::array::from_fn(|_| plan.clone()),
            plan,
        }
    }

    /// State of a study of the plan on the screen.
    pub fn state(&self, kind: StudyKind) -> &StudyState {
        let is_of_plan = self.plans[kind as usize] == self.plan;
        if is_of_plan { &self.states[kind as usize] } else { &StudyState::Idle }
    }

    /// The result of a study of an older text of the plan. Undo brings it back.
    pub fn of_plan_before(&self, kind: StudyKind) -> Option<&ShownStudy> {
        match &self.states[kind as usize] {
            StudyState::Done(finished) if self.plans[kind as usize] != self.plan => Some(finished),
            _ => None,
        }
    }

    /// Sets the state of a study of the plan on the screen.
    pub fn set(&mut self, kind: StudyKind, state: StudyState) {
        self.states[kind as usize] = state;
        self.plans[kind as usize] = self.plan.clone();
    }

    /// Whether a study computes.
    pub fn is_running(&self, kind: StudyKind) -> bool {
        matches!(self.state(kind), StudyState::Running(_))
    }

    /// Whether any study computes.
    pub fn busy(&self) -> bool {
        StudyKind::ALL.into_iter().any(|kind| self.is_running(kind))
    }

    /// The result of a study, once there is one.
    pub fn finished(&self, kind: StudyKind) -> Option<&ShownStudy> {
        match self.state(kind) {
            StudyState::Done(finished) => Some(finished),
            StudyState::Idle | StudyState::Running(_) | StudyState::Failed(_) => None,
        }
    }

    /// The result of a study, if it was computed with the settings `compute`.
    fn found(&self, kind: StudyKind, compute: &ComputeSettings) -> Option<&Found> {
        let finished = self.finished(kind).filter(|finished| finished.compute == *compute)?;
        Some(&finished.found)
    }

    /// The sweep of the plan, if it was computed with the settings `compute`.
    pub fn sweep(&self, compute: &ComputeSettings) -> Option<&Computed<Sweep>> {
        match self.found(StudyKind::Sweep, compute)? {
            Found::Sweep(sweep) => Some(sweep),
            _ => None,
        }
    }

    /// The influence of each effect on the options of the plan, if it was computed with the settings `compute`.
    pub fn effects(&self, compute: &ComputeSettings) -> Option<&EffectsOnOptions> {
        match self.found(StudyKind::Effects, compute)? {
            Found::Effects(effects) => Some(&effects.value),
            _ => None,
        }
    }

    /// The recorded motion of an option, if the last recording is of this option.
    pub fn flight(&self, option: usize) -> Option<&Flight> {
        match &self.finished(StudyKind::Flight)?.found {
            Found::Flight(flight) if flight.value.option == option => Some(&flight.value),
            _ => None,
        }
    }

    /// The changes with which an option would pass, if they were computed with the settings `compute`.
    pub fn remedies(&self, option: usize, compute: &ComputeSettings) -> Option<&Remedies> {
        match self.found(StudyKind::Remedies, compute)? {
            Found::Remedies(remedies) if remedies.value.option == option => Some(&remedies.value),
            _ => None,
        }
    }

    /// Follows a change of the plan to the text `plan`. Results stay as results of the old text; running studies are dropped.
    pub fn mark_as_of_plan_before(&mut self, plan: &str) {
        self.plan = plan.into();
        for state in &mut self.states {
            if !matches!(state, StudyState::Done(_)) {
                *state = StudyState::Idle;
            }
        }
        (self.scroll, self.selected, self.remedy_list) = (0, 0, None);
        self.filter.clear();
    }

    /// Keeps the result of the study that `before` showed as a result of the new plan. For changes that do not concern this result.
    pub fn keep_shown_result(&mut self, before: &Self) {
        let kind = before.shown;
        self.selected = before.selected;
        self.set(kind, before.states[kind as usize].clone());
    }

    /// Selects the study `by` tabs further. The first follows the last.
    pub fn show_neighbour(&mut self, by: isize) {
        let kinds = StudyKind::tabs();
        let shown = kinds.iter().position(|kind| *kind == self.shown).unwrap_or(0) as isize;
        self.select(kinds[(shown + by).rem_euclid(kinds.len() as isize) as usize]);
    }

    /// Shows a study on the full screen.
    pub fn show(&mut self, kind: StudyKind) {
        self.select(kind);
        self.open = true;
    }

    /// Selects a study. The full screen or the list of questions stays.
    pub fn select(&mut self, kind: StudyKind) {
        self.shown = kind;
        self.scroll = 0;
        self.selected = 0;
    }

    /// Scrolls down by `lines`; a negative number scrolls up.
    pub fn scroll(&mut self, lines: i16) {
        self.scroll = self.scroll.saturating_add_signed(lines);
    }
}
