//! Everything that the screen shows. `news` holds how jobs change the app, `actions` the effects of keys and clicks.
//!
//! The app does no input or output. It returns a [`Request`], and the event loop serves the request.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use ratatui::layout::Rect;

use super::compare::{Listing, OptionState, PlanOptions, SortBy};
use super::config::Config;
use super::editor::Editor;
use super::fitted_plan::FittedPlan;
use super::keymap::{Action, Keymap};
use super::pace::Pace;
use super::plan_side::{PlanOption, PlanSide};
use super::player::{FiringPlay, Player, ShownShot};
use super::prompt::{Prompt, Purpose};
use super::screen::Screen;
use super::studies::{Studies, StudyState};
use super::theme::Theme;
use super::typed_line::TypedLine;
use crate::jobs::StudyAt;
use crate::plan::edit::differences::Difference;
use crate::report::words::headline::Headline;
use crate::study::assumptions::Assumptions;
use crate::study::course_band::CourseBand;
use crate::study::judge::Judgement;
use crate::study::observed::ObservationRecord;
use crate::study::question::StudyKind;
use crate::study::{Case, ComputeSettings, FileState};
use crate::verdict::Verdict;

/// What the event loop must do after an update.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Request {
    /// Nothing.
    None,
    /// Judge every option again.
    Judge,
    /// Begin to judge every option of another plan, and end the studies of the old plan.
    JudgeNewPlan,
    /// Begin a study.
    Study(StudyKind),
    /// End a study.
    Cancel(StudyKind),
    /// Read this file of observations.
    ReadObserved(PathBuf),
    /// Write the plan.
    Save,
    /// Ask for a new file for the plan.
    AskPlanPath,
    /// Write the plan to this new file.
    SaveAs(PathBuf),
    /// Ask for an export file; offer an unused name with this stem and ending.
    NameExport(String, &'static str),
    /// Write the contents of the screen to this file.
    Export(PathBuf),
    /// Ask for a file for the page of the selected option; offer an unused name with this stem.
    NamePage(String),
    /// Write the page of the selected option to this file.
    Page(PathBuf),
    /// Put the contents of the screen on the clipboard.
    Copy,
    /// Give the terminal back to the shell for now.
    Suspend,
    /// Leave.
    Quit,
}

/// Effect of a click on an area of the screen, or what else the area stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ClickTarget {
    /// The same as a key.
    Act(Action),
    /// Selects an option; opens the option that is selected already.
    Option(PlanOption),
    /// Sorts by a column.
    Sort(SortBy),
    /// Selects a value of the plan; edits the value that is selected already.
    Field(usize),
    /// Shows a study.
    Study(StudyKind),
    /// Makes a change of the plan that a row of a study offers. Holds the index among the rows with offers.
    Offer(usize),
    /// No click: holds the greatest number of lines that the area can scroll.
    Lines(u16),
    /// Edits the firing time of a blast row of the selected option, or the interval that sets this time.
    FiringTime(usize),
    /// Opens the Flight screen of the selected option. While nothing computes, this area plays that flight.
    Flight,
    /// Shows a time of the flight: 0 at the left end of the area, the held time [s] at the right end.
    Time(f64),
}

/// Areas of the screen and the effect of a click on each. Where areas overlap, the last counts.
pub type Areas = Vec<(Rect, ClickTarget)>;

/// Everything that the screen shows.
#[derive(Clone, Debug)]
pub struct App {
    /// The plan.
    pub case: Arc<Case>,
    /// Whether this is plan A or plan B.
    pub side: PlanSide,
    /// The other plan, if two are shown.
    pub beside: Option<Box<App>>,
    /// Differences between the two plans.
    pub differences: Vec<Difference>,
    /// Whether the list of `differences` is open.
    pub shows_differences: bool,
    /// Accuracy, step and other settings of the computation.
    pub compute: ComputeSettings,
    /// State of each delay option (`n_options`).
    pub options: Vec<OptionState>,
    /// Band over time that holds nine of ten sampled shots, for each option; `None` while it is not known (`n_options`).
    pub bands: Vec<Option<Box<CourseBand>>>,
    /// Assumptions that the pass of each option stands on; `None` while they are not known (`n_options`).
    pub assumptions: Vec<Option<Box<Assumptions>>>,
    /// Index of the selected option.
    pub selected: usize,
    /// Whether the selected option fills the screen.
    pub zoom: bool,
    /// Lines that the sentences of the option are scrolled while it fills the screen.
    pub zoom_scroll: u16,
    /// Whether the help is open.
    pub help: bool,
    /// Lines that the help or the list of differences is scrolled.
    pub help_scroll: u16,
    /// Colors.
    pub theme: Theme,
    /// Threads that a study computes on.
    pub threads: usize,
    /// Which key triggers which action.
    pub keymap: Keymap,
    /// The screen shown.
    pub screen: Screen,
    /// The answer, once all options are judged.
    pub answer: Option<Headline>,
    /// Whether the plan ever had several options. If one is left, it was chosen among several, and fresh draws must confirm it.
    pub had_several: bool,
    /// Whether the user has selected an option. If not, the program selects the recommended option once it is known.
    pub has_selected: bool,
    /// How the options are listed.
    pub listing: Listing,
    /// Which shot of each option is drawn.
    pub shown_shot: ShownShot,
    /// Playback of the flight: the time shown, the speed, the view.
    pub player: Player,
    /// Playback of the order of firing on the map of the plan.
    pub firing_play: FiringPlay,
    /// Time since the review of the shots began.
    pub review: Duration,
    /// The studies.
    pub studies: Studies,
    /// Observations of earlier shots.
    pub record: ObservationRecord,
    /// State of the plan's file, as last known.
    pub file: FileState,
    /// Index of the option that the user last named as fired.
    pub fired: Option<usize>,
    /// The text of the plan.
    pub editor: Editor,
    /// The line being typed at the foot of the screen.
    pub prompt: Option<Prompt>,
    /// How fast the options are judged.
    pub pace: Pace,
    /// Counts up while something computes. Marks that turn on the screen follow it.
    pub beat: usize,
    /// Clickable areas of the screen as last drawn.
    pub areas: Areas,
    /// Pages written so far. A new page of the same name replaces the old one.
    pub pages: Vec<PathBuf>,
    /// Names of older pages beside the plan that permit an option which must not be fired, or that are of another text of the plan.
    pub old_pages: Vec<String>,
    /// The plan with the estimates of a fit, until the user has taken or refused them.
    pub fitted_plan: Option<FittedPlan>,
    /// A message above the keys.
    pub notice: Option<String>,
    /// Whether the file has changed but was not read again: the plan here has unsaved changes, or the user is typing.
    pub file_is_newer: bool,
    /// Name of the file that another program has changed and that the user then left for another name. Two plans of one shot exist now.
    pub left_file: Option<String>,
    /// Whether the other plan on the screen has observations that this one lacks.
    pub other_plan_has_more_observations: bool,
    /// Whether the user was warned that quitting drops unsaved changes. The next request quits.
    pub quit_warned: bool,
    /// Why the last request for a page was refused.
    pub page_refused: Option<String>,
    /// Index of the option whose page would be incomplete, once the user was warned of that.
    pub page_warned: Option<usize>,
}

/// Why a question about an option is refused before the option is judged.
pub(super) const NOT_JUDGED_YET: &str = "the option is not judged yet: more samples come";
/// Why the screen does not say yet how far a pass holds.
pub(super) const ASSUMPTIONS_STILL_SOUGHT: &str = "what it holds until is still being found";
/// Why no change is made while the changes are still computed.
pub(super) const STILL_LOOKED_FOR: &str = "the changes are still being looked for";

impl App {
    /// An app on which nothing is computed yet.
    pub fn new(case: Arc<Case>, compute: ComputeSettings, config: &Config) -> Self {
        let options = vec![OptionState::Waiting; case.plan.delays.len()];
        let (assumptions, had_several) = (vec![None; options.len()], options.len() > 1);
        let bands = vec![None; options.len()];
        let (editor, studies) = (Editor::new(&case.source.text), Studies::new(&case.source.text));
        // A new plan and an example have no file yet. A file that has changed since it was read is read again.
        let is_pipe = FileState::now(&case.source) == FileState::Pipe;
        let file = if is_pipe { FileState::Pipe } else { FileState::AsJudged };
        Self {
            case,
            side: PlanSide::default(),
            beside: None,
            differences: Vec::new(),
            shows_differences: false,
            compute,
            options,
            bands,
            assumptions,
            selected: 0,
            zoom: false,
            zoom_scroll: 0,
            help: false,
            help_scroll: 0,
            theme: config.theme,
            threads: 1,
            keymap: config.keymap.clone(),
            screen: Screen::default(),
            answer: None,
            had_several,
            has_selected: false,
            listing: Listing::default(),
            shown_shot: ShownShot::default(),
            player: Player::default(),
            firing_play: FiringPlay::default(),
            review: Duration::ZERO,
            studies,
            record: ObservationRecord::default(),
            file,
            fired: None,
            editor,
            prompt: None,
            pace: Pace::default(),
            beat: 0,
            areas: Areas::new(),
            pages: Vec::new(),
            old_pages: Vec::new(),
            fitted_plan: None,
            notice: None,
            file_is_newer: false,
            left_file: None,
            other_plan_has_more_observations: false,
            quit_warned: false,
            page_refused: None,
            page_warned: None,
        }
    }

    /// The options of this plan with states and verdicts, for the list.
    pub fn to_list(&self) -> PlanOptions<'_> {
        let words = (0..self.options.len()).map(|option| self.word(option)).collect();
        PlanOptions { plan: &self.case.plan, states: &self.options, words }
    }

    /// The judgement on an option, once there is one.
    pub fn judgement(&self, option: usize) -> Option<&Judgement> {
        self.options.get(option)?.judgement()
    }

    /// Assumptions that the pass of an option stands on. `None` if the option does not pass, or the nearest assumptions are not known yet.
    pub fn stands_on(&self, option: usize) -> Option<&Assumptions> {
        self.stands_on_so_far(option).filter(|found| found.nearest_are_known())
    }

    /// The same from the moment when it is known whether the pass is thin. `None` if the option does not pass, or that is not known yet.
    pub fn stands_on_so_far(&self, option: usize) -> Option<&Assumptions> {
        let passes = self.judgement(option)?.verdict() == Verdict::Pass;
        self.assumptions.get(option)?.as_deref().filter(|_| passes)
    }

    /// Indices of the options whose verdict is PASS.
    pub fn passing(&self) -> impl Iterator<Item = usize> {
        let passes =
            |option: &usize| self.judgement(*option).is_some_and(|judged| judged.verdict() == Verdict::Pass);
        (0..self.options.len()).filter(passes)
    }

    /// Progress of the search for the assumptions of an option's pass, 0 to 1. `None` unless this option is the next to be finished.
    pub fn assumption_search_progress(&self, option: usize) -> Option<f64> {
        let is_known = |option: usize| self.stands_on(option).is_some();
        // Same order as the search: the recommended option first.
        let next = self.recommended().into_iter().chain(self.passing()).find(|option| !is_known(*option));
        // The search first finds for all passes whether they are thin.
        let is_begun = self.passing().all(|option| self.stands_on_so_far(option).is_some());
        self.pace.done_of_next().filter(|_| is_begun && next == Some(option))
    }

    /// The option that the others are compared with, and its judgement.
    pub fn baseline(&self) -> Option<(usize, &Judgement)> {
        let option = self.listing.baseline?;
        Some((option, self.judgement(option)?))
    }

    /// Selects the option `lines` further down the list; a negative number moves up.
    pub(super) fn select_listed(&mut self, lines: isize) {
        let listed = self.listed_options();
        let line = listed.iter().position(|&at| at == self.selected_option());
        let last = listed.len().saturating_sub(1);
        let next = line.map_or(0, |line| line.saturating_add_signed(lines).min(last));
        if let Some(&at) = listed.get(next) {
            self.select_option(at);
        }
    }

    /// Requests a study.
    pub(super) fn begin_study(&mut self, kind: StudyKind) -> Request {
        if kind == StudyKind::Fit {
            // The estimates of an older fit do not belong to this fit.
            self.leave_estimates();
        }
        self.studies.set(kind, StudyState::Running(StudyAt::default()));
        Request::Study(kind)
    }

    /// Requests the end of a study, if it computes.
    pub(super) fn cancel_study(&mut self, kind: StudyKind) -> Request {
        if !self.studies.is_running(kind) {
            return Request::None;
        }
        self.studies.set(kind, StudyState::Idle);
        Request::Cancel(kind)
    }

    /// Notes the areas of the screen just drawn. Limits scrolling to the lines that exist.
    pub fn note_drawn(&mut self, areas: Areas) {
        let is_over = self.help || self.shows_differences;
        let scroll = match self.screen {
            _ if is_over => &mut self.help_scroll,
            Screen::Compare => &mut self.zoom_scroll,
            _ => &mut self.studies.scroll,
        };
        for (_, target) in &areas {
            if let ClickTarget::Lines(most) = target {
                *scroll = (*scroll).min(*most);
            }
        }
        self.areas = areas;
    }

    /// Asks the user for a file. The line already holds `path`.
    pub fn ask_for_file(&mut self, purpose: Purpose, path: &str) {
        self.prompt = Some(Prompt::new(purpose, TypedLine::offering(path)));
    }

    /// Whether the flight plays.
    pub fn playing(&self) -> bool {
        self.screen == Screen::Flight && self.player.playing
    }
}
