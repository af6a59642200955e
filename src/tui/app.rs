//! Everything that the screen shows. `news` holds how jobs change it, `actions` the effects of keys and clicks.
//!
//! The app does no input or output. It returns a [`Request`], and the event loop serves the request.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use ratatui::layout::Rect;

use super::compare::{Listing, OptionState, PlanOptions, SortBy};
use super::config::Config;
use super::editor::{EditOutcome, Editor};
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
use crate::kept::Recovered;
use crate::plan::edit::differences::Difference;
use crate::plan::{Plan, PlanSource};
use crate::report::words::headline::Headline;
use crate::scene::Shot;
use crate::study::assumptions::Assumptions;
use crate::study::course_band::CourseBand;
use crate::study::flight::Flight;
use crate::study::judge::Judgement;
use crate::study::judge::batch::Depth;
use crate::study::question::StudyKind;
use crate::study::seen::Told;
use crate::study::trace::DrawnSample;
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
    /// The studies.
    pub studies: Studies,
    /// What was seen of earlier shots.
    pub told: Told,
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
            studies,
            told: Told::default(),
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

    /// Asks for the recording that is shown, once per option and shot. A sample that decides goes on while others come.
    pub fn request_flight(&mut self) -> Request {
        let sample = self.shown_sample(self.selected);
        let more_come = self.options.get(self.selected).is_some_and(OptionState::is_sampling);
        let is_shown = |(option, recorded): (usize, Option<DrawnSample>)| {
            option == self.selected
                && (recorded == sample || more_come && recorded.is_some() && sample.is_some())
        };
        let is_seen = self.screen == Screen::Flight || self.has_charts_below() && !self.busy();
        if !is_seen || self.player.recorded.is_some_and(is_shown) {
            return Request::None;
        }
        self.player.show(self.selected, sample);
        self.begin_study(StudyKind::Flight)
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

    /// Moves the flight on after so much real time.
    pub fn advance(&mut self, elapsed: Duration) {
        match self.screen {
            Screen::Flight => self.player.advance(elapsed, self.flight_end()),
            _ => self.player.go_round(elapsed, self.flight_end()),
        }
    }

    /// Whether the table of options has room for charts below it, in which a flight goes round.
    fn has_charts_below(&self) -> bool {
        let is_chart = |target: &ClickTarget| matches!(target, ClickTarget::Time(_));
        self.screen == Screen::Compare && self.areas.iter().any(|(_, target)| is_chart(target))
    }

    /// The flight of the selected option below the table of options, and its time [s]: while something computes, that is what moves.
    pub fn flight_below(&self) -> Option<(&Flight, f64)> {
        let flight = self.flight().filter(|_| self.has_charts_below() && !self.busy())?;
        Some((flight, self.player.time_below.min(flight.end())))
    }

    /// Whether that flight goes round.
    pub fn plays_below(&self) -> bool {
        !self.player.rests_below && self.flight_below().is_some()
    }

    /// End of the flight shown [s]; 0 while there is none.
    pub(super) fn flight_end(&self) -> f64 {
        self.flight().map_or(0.0, Flight::end)
    }

    /// Forgets what was found of every option, before all are judged anew.
    pub(super) fn forget_verdicts(&mut self) {
        self.options = vec![OptionState::Waiting; self.case.plan.delays.len()];
        self.assumptions = vec![None; self.options.len()];
        self.bands = vec![None; self.options.len()];
        self.answer = None;
        self.pace = Pace::default();
        self.page_warned = None;
        self.leave_estimates();
        self.player.recorded = None;
    }

    /// How far options are judged. If the plan ever had several, each needs fresh draws, also the last one left.
    pub fn depth(&self) -> Depth {
        if self.had_several { Depth::Chosen } else { Depth::Full }
    }

    /// What is known of each option, however little.
    pub fn known(&self) -> Vec<Option<Judgement>> {
        (0..self.options.len()).map(|option| self.judgement(option).cloned()).collect()
    }

    /// States of the options of `case`, the plan to be shown, before it is judged. If the plans differ only in options, an option
    /// whose shot was judged before keeps all that does not depend on other options.
    fn kept_of(&self, case: &Case, compute: ComputeSettings) -> Vec<OptionState> {
        let others = |plan: &Plan| Plan { delays: Vec::new(), ..plan.clone() };
        let is_alike = compute == self.compute && others(&case.plan) == others(&self.case.plan);
        let kept = |shot: &Shot| {
            let mut same = self.case.shots.iter().zip(&self.options).filter(|(before, _)| *before == shot);
            // The margin is computed after the samples. So an option with a margin has them all.
            let has_samples = |state: &OptionState, judged: &Judgement| {
                !state.is_sampling() || judged.launch_margin.is_some()
            };
            let judged =
                same.find_map(|(_, state)| state.judgement().filter(|judged| has_samples(state, judged)))?;
            let judgement = Box::new(self.depth().begin_again(case, judged.clone()));
            let grounds = judgement.grounds();
            let more_samples = grounds.awaits_one_dud() || grounds.awaits_confirmation();
            Some(OptionState::Judged { judgement, more_samples })
        };
        let state = |shot| kept(shot).filter(|_| is_alike).unwrap_or(OptionState::Waiting);
        case.shots.iter().map(state).collect()
    }

    /// Shows another plan; drops the studies of the old one.
    fn replace_plan(&mut self, case: Case) -> Request {
        let mut compute = self.compute;
        compute.adopt_changed_defaults(&self.case.plan, &case.plan);
        self.had_several |= case.shots.len() > 1;
        let options = self.kept_of(&case, compute);
        // The rows on the screen are of options of the plan before.
        self.areas.clear();
        let moved = |option: usize| {
            let name = &self.case.plan.delays.get(option)?.name;
            case.plan.delays.iter().position(|delay| delay.name == *name)
        };
        self.fired = self.fired.and_then(moved);
        self.selected = moved(self.selected).unwrap_or(self.selected);
        (self.case, self.compute) = (Arc::new(case), compute);
        self.forget_verdicts();
        self.options = options;
        self.find_answer();
        self.selected = self.selected.min(self.options.len().saturating_sub(1));
        self.listing.baseline = None;
        self.studies.mark_as_of_plan_before(&self.case.source.text);
        self.find_differences();
        Request::JudgeNewPlan
    }

    /// Shows the plan of the editor's text.
    pub(super) fn take_edited(&mut self, plan: Plan) -> Request {
        let source = PlanSource { path: self.case.source.path.clone(), text: self.editor.text.clone() };
        self.replace_plan(Case::new(plan).with_source(source))
    }

    /// Restores what the last session had in no file: what was seen of earlier shots, and edits.
    pub fn restore_unsaved(&mut self, kept: Recovered) -> Request {
        let changed = !kept.are_of(self.editor.saved());
        let has_edits = kept.has_edits_of(&self.editor.text);
        let Recovered { text, told, time, .. } = kept;
        let undo = self.keymap.hint(Action::Undo);
        let mut news = Vec::new();
        let mut request = Request::None;
        self.told = told;
        if !self.told.is_empty() {
            request = self.begin_study(StudyKind::Fit);
            news.push(format!("what was seen of earlier shots, told on {time}, is back"));
        }
        if has_edits && changed {
            // Who changed the file since knows more than those edits.
            if self.editor.keep_older_edits(text) {
                let redo = self.keymap.hint(Action::Redo);
                news.push(format!(
                    "this is the file, which another program has changed since your edits of {time}; {redo} shows those"
                ));
            }
        } else if has_edits && let EditOutcome::Changed(plan) = self.editor.adopt(Ok(text)) {
            request = self.take_edited(*plan);
            news.push(format!("edits of {time} that were not saved are back; {undo} takes them away"));
        }
        if !news.is_empty() {
            self.notice = Some(news.join(" · "));
        }
        request
    }

    /// Takes the changed file of the plan: another plan, or the mistake in it.
    pub fn reload(&mut self, read: Result<Case, String>) -> Request {
        match read {
            Ok(case) if case.source.text == self.editor.saved() => {
                // The file was gone or wrong for a while, and is as before.
                self.file = FileState::AsJudged;
                self.notice = None;
                Request::None
            }
            Ok(_) if self.is_changing() => {
                // Until somebody has looked at both, no verdict here is one of the file.
                self.file_is_newer = true;
                self.file = FileState::Changed;
                let why = match self.prompt {
                    // Keys that were meant for a line that is gone would be commands.
                    Some(_) => "it is read once this line is done",
                    None => "your changes here are not saved",
                };
                self.notice = Some(format!("the file has changed; {why}"));
                Request::None
            }
            Ok(case) => {
                self.file = FileState::AsJudged;
                self.editor.reload(&case.source.text);
                self.notice = Some("the file has changed and was read again".to_owned());
                self.replace_plan(case)
            }
            Err(mistake) => {
                self.file = FileState::of(Path::new(&self.case.source.path), self.editor.saved());
                self.notice = Some(format!("{mistake}; the last good plan is shown"));
                Request::None
            }
        }
    }

    /// Whether the plan here differs from the saved plan, or anything is being typed.
    pub fn is_changing(&self) -> bool {
        self.editor.unsaved() || self.editor.entry.is_some() || self.prompt.is_some()
    }

    /// Notes that the plan was written to a path, or why it was not.
    pub fn note_saved(&mut self, result: Result<String, String>) {
        self.notice = Some(match result {
            Ok(path) => {
                self.editor.set_saved(&self.editor.text.clone());
                self.file_is_newer = false;
                self.file = FileState::AsJudged;
                format!("saved {path}")
            }
            Err(reason) => format!("not saved: {reason}"),
        });
    }

    /// Notes that the plan stands in another file now.
    pub fn rename(&mut self, path: &Path) {
        if self.file == FileState::Changed && path != self.case.source.path {
            let old = Path::new(&self.case.source.path).file_name();
            self.left_file = old.map(|name| name.to_string_lossy().into_owned());
        }
        path.clone_into(&mut Arc::make_mut(&mut self.case).source.path);
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
