//! Everything that the screen shows. `news` holds how jobs change it, `actions` the effects of keys and clicks.
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
    /// Judge every option of another plan, and end the studies of the old plan.
    JudgeNewPlan,
    /// Begin a study.
    Study(StudyKind),
    /// End a study.
    Cancel(StudyKind),
    /// Read this file of observations.
    ReadObserved(PathBuf),
    /// Write the plan.
    Save,
    /// Ask for a new file to write the plan to.
    AskPlanPath,
    /// Write the plan to this new file.
    SaveAs(PathBuf),
    /// Ask for a file to export to; offer an unused name of this stem and ending.
    NameExport(String, &'static str),
    /// Write the contents of the screen to this file.
    Export(PathBuf),
    /// Ask for a file for the page of the selected option; offer an unused name of this stem.
    NamePage(String),
    /// Write the page of the selected option to this file.
    Page(PathBuf),
    /// Put the contents of the screen on the clipboard.
    Copy,
    /// Give the terminal back for now.
    Suspend,
    /// Leave.
    Quit,
}

/// Effect of a click on an area of the screen.
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
    /// Takes a change of the plan that a row of a study offers: its index among the rows with offers.
    Offer(usize),
    /// No click: the greatest number of lines the area can be scrolled.
    Lines(u16),
    /// Types the firing time of a blast row of the selected option, or the interval that it follows from.
    FiringTime(usize),
    /// Shows the flight of the selected option, which plays there where nothing computes.
    Flight,
    /// Shows a time of the flight: 0 at the left end of the area, this time [s] at the right end.
    Time(f64),
}

/// Areas of the screen and what a click on each does; of several at a point the last counts.
pub type Areas = Vec<(Rect, ClickTarget)>;

/// Everything that the screen shows.
#[derive(Clone, Debug)]
pub struct App {
    /// The plan.
    pub case: Arc<Case>,
    /// Which of two plans it is.
    pub side: PlanSide,
    /// The other of two plans.
    pub beside: Option<Box<App>>,
    /// What two plans say differently.
    pub differences: Vec<Difference>,
    /// Whether the list of these differences is open.
    pub shows_differences: bool,
    /// How finely the plan is computed.
    pub compute: ComputeSettings,
    /// State of each delay option (`n_options`).
    pub options: Vec<OptionState>,
    /// Where nine of ten sampled shots of each option lie over time; `None` where it is not known (`n_options`).
    pub bands: Vec<Option<Box<CourseBand>>>,
    /// What the pass of each option stands on, the nearest; `None` where it is not known (`n_options`).
    pub assumptions: Vec<Option<Box<Assumptions>>>,
    /// Index of the selected option.
    pub selected: usize,
    /// Whether the selected option fills the screen.
    pub zoom: bool,
    /// Lines its sentences are scrolled then.
    pub zoom_scroll: u16,
    /// Whether the help is open.
    pub help: bool,
    /// Lines the help is scrolled.
    pub help_scroll: u16,
    /// Colours.
    pub theme: Theme,
    /// Threads that a study computes on.
    pub threads: usize,
    /// Which key asks for which action.
    pub keymap: Keymap,
    /// The screen shown.
    pub screen: Screen,
    /// The answer, once all options are judged.
    pub answer: Option<Headline>,
    /// Whether the plan ever had several options. If one is left, it was chosen among them, and fresh draws must confirm it.
    pub had_several: bool,
    /// Whether the user has selected an option: else the recommended one is selected once it is known.
    pub has_selected: bool,
    /// How the options are listed.
    pub listing: Listing,
    /// Which shot of the options is drawn.
    pub shown_shot: ShownShot,
    /// Which time of the flight is shown.
    pub player: Player,
    /// The order of firing that is played on the map of the plan.
    pub firing_play: FiringPlay,
    /// How long shots have passed in review.
    pub review: Duration,
    /// The studies.
    pub studies: Studies,
    /// What was seen of earlier shots.
    pub record: ObservationRecord,
    /// What became of the file of the plan, as far as it is known.
    pub file: FileState,
    /// The option of the shot that was seen last.
    pub fired: Option<usize>,
    /// The text of the plan.
    pub editor: Editor,
    /// The line being typed at the foot of the screen.
    pub prompt: Option<Prompt>,
    /// How fast the options are judged.
    pub pace: Pace,
    /// Grows while shots are tried. Marks that turn on the screen follow it.
    pub beat: usize,
    /// Areas of the screen as drawn last.
    pub areas: Areas,
    /// Pages written so far: a page of the same name replaces them.
    pub pages: Vec<PathBuf>,
    /// Names of pages written before, beside the plan, that permit what may not be fired.
    pub old_pages: Vec<String>,
    /// The plan with the estimates of a fit, until the user has answered whether it takes the place of this one.
    pub fitted_plan: Option<FittedPlan>,
    /// A message in place of the header's second line.
    pub notice: Option<String>,
    /// Whether the file has changed but was not read again, because the plan here has unsaved changes.
    pub file_is_newer: bool,
    /// Name of the file that another program has changed, and that was left for another name: two plans of one shot lie there now.
    pub left_file: Option<String>,
    /// Whether the other plan on the screen has observations that this one lacks.
    pub seen_beside: bool,
    /// Whether the user was warned once that quitting drops unsaved changes.
    pub quit_warned: bool,
    /// Why the key before asked for a page and got none.
    pub page_refused: Option<String>,
    /// The option whose page would lack what its pass stands on, once the user was warned of that.
    pub page_warned: Option<usize>,
}

/// Why a question about an option is refused until the option is judged.
pub(super) const NOT_JUDGED_YET: &str = "the option is not judged yet: more samples come";
/// Why a pass is not told what it holds until.
pub(super) const HOLDS_SOUGHT: &str = "what it holds until is still being found";
/// Why no change is made as long as none was found.
pub(super) const STILL_LOOKED_FOR: &str = "the changes are still being looked for";

impl App {
    /// An app on which nothing is computed yet.
    pub fn new(case: Arc<Case>, compute: ComputeSettings, config: &Config) -> Self {
        let options = vec![OptionState::Waiting; case.plan.delays.len()];
        let (assumptions, had_several) = (vec![None; options.len()], options.len() > 1);
        let bands = vec![None; options.len()];
        let (editor, studies) = (Editor::new(&case.source.text), Studies::new(&case.source.text));
        // A new plan and an example have no file yet, and one that has changed since is read again.
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
            seen_beside: false,
            quit_warned: false,
            page_refused: None,
            page_warned: None,
        }
    }

    /// The options of this plan, to be listed.
    pub fn to_list(&self) -> PlanOptions<'_> {
        let words = (0..self.options.len()).map(|option| self.word(option)).collect();
        PlanOptions { plan: &self.case.plan, states: &self.options, words }
    }

    /// The result of an option, once there is one.
    pub fn judgement(&self, option: usize) -> Option<&Judgement> {
        self.options.get(option)?.judgement()
    }

    /// What the pass of an option stands on; `None` where it does not pass, or that is not known.
    pub fn stands_on(&self, option: usize) -> Option<&Assumptions> {
        self.stands_on_so_far(option).filter(|found| found.nearest_are_known())
    }

    /// As much of it as tells whether the pass is thin, which is known first; `None` where the option does not pass, or that is not known.
    pub fn stands_on_so_far(&self, option: usize) -> Option<&Assumptions> {
        let passes = self.judgement(option)?.verdict() == Verdict::Pass;
        self.assumptions.get(option)?.as_deref().filter(|_| passes)
    }

    /// The options whose verdict is a pass.
    pub fn passing(&self) -> impl Iterator<Item = usize> {
        let passes =
            |option: &usize| self.judgement(*option).is_some_and(|judged| judged.verdict() == Verdict::Pass);
        (0..self.options.len()).filter(passes)
    }

    /// Share done of finding what the pass of an option stands on; `None` where that of another one is found first.
    pub fn held_until_share(&self, option: usize) -> Option<f64> {
        let is_known = |option: usize| self.stands_on(option).is_some();
        // In the order in which they are found.
        let next = self.recommended().into_iter().chain(self.passing()).find(|option| !is_known(*option));
        // Whether passes are thin is found before, of all of them.
        let is_begun = self.passing().all(|option| self.stands_on_so_far(option).is_some());
        self.pace.done_of_next().filter(|_| is_begun && next == Some(option))
    }

    /// The result that the others are compared with, and its option.
    pub fn baseline(&self) -> Option<(usize, &Judgement)> {
        let option = self.listing.baseline?;
        Some((option, self.judgement(option)?))
    }

    /// Selects the option `lines` further down the list; negative: further up.
    pub(super) fn select_listed(&mut self, lines: isize) {
        let listed = self.listed_options();
        let line = listed.iter().position(|&at| at == self.selected_option());
        let last = listed.len().saturating_sub(1);
        let next = line.map_or(0, |line| line.saturating_add_signed(lines).min(last));
        if let Some(&at) = listed.get(next) {
            self.select_option(at);
        }
    }

    /// Asks for a study.
    pub(super) fn begin_study(&mut self, kind: StudyKind) -> Request {
        if kind == StudyKind::Fit {
            // Estimates of an older fit are none of this one.
            self.leave_estimates();
        }
        self.studies.set(kind, StudyState::Running(StudyAt::default()));
        Request::Study(kind)
    }

    /// Asks to end a study, if it computes.
    pub(super) fn cancel_study(&mut self, kind: StudyKind) -> Request {
        if !self.studies.is_running(kind) {
            return Request::None;
        }
        self.studies.set(kind, StudyState::Idle);
        Request::Cancel(kind)
    }

    /// Notes the areas of the screen just drawn; limits scrolling to the lines that exist.
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

    /// Asks the user for a file; `path` stands in the line already.
    pub fn ask_for_file(&mut self, purpose: Purpose, path: &str) {
        self.prompt = Some(Prompt::new(purpose, TypedLine::offering(path)));
    }

    /// Whether the flight plays.
    pub fn playing(&self) -> bool {
        self.screen == Screen::Flight && self.player.playing
    }
}
