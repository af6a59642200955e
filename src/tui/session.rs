//! A session at the terminal: the loop that waits for a key, a click or news, updates the app, draws, and serves the app's requests:
//! jobs, files, pages.

use std::io::{self, Write};
use std::path::Path;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use crossterm::clipboard::CopyToClipboard;
use crossterm::{ExecutableCommand, event};

use super::actions::dispatch::dispatch;
use super::app::{App, Areas, Request};
use super::display::{Display, Signals};
use super::old_pages::permitting_wrongly;
use super::prompt::Purpose;
use super::studies::StudyState;
use super::watched_file::{Refusal, WatchedFile};
use super::{Exit, config, export, view};
use crate::file;
use crate::jobs::Jobs;
use crate::kept::{self, Keeper, Recovered};
use crate::plan::{observations, visible};
use crate::study::Case;
use crate::study::FileState;
use crate::study::question::StudyKind;
use crate::study::study_trait::Subject;

/// Longest wait for a key while something computes or moves: one frame.
const FRAME: Duration = Duration::from_millis(16);
/// Least time between two drawings that only show news, and between two moves of the marks that show computing.
const BEAT: Duration = Duration::from_millis(150);
/// Time between two frames of a flight that moves by itself.
const BELOW: Duration = Duration::from_millis(80);
/// Age at which an unsaved edit is kept on disk. A kill or a power loss loses at most this time.
const KEPT_AFTER: Duration = Duration::from_secs(1);
/// Longest wait for a key while nothing computes or moves.
pub(super) const IDLE: Duration = Duration::from_millis(250);

/// The app, and the jobs and files of its plans.
pub struct Session {
    app: App,
    /// One for each plan, in the order of [`plan_side::PlanSide`].
    plans: Vec<OpenedPlan>,
}

/// The jobs and the file of one plan.
struct OpenedPlan {
    jobs: Jobs,
    file: Option<WatchedFile>,
    /// Keeps unsaved edits and observations on disk. `unkept` holds the last error.
    keeper: Keeper,
    unkept: Option<String>,
    /// State at the last look at the pages beside the plan: the plan's saved text, and the options that must not be fired.
    looked_for: Option<(String, Vec<String>)>,
}

impl OpenedPlan {
    /// The path of the plan's file.
    fn path(&self) -> Option<&Path> {
        self.file.as_ref().map(WatchedFile::path)
    }

    /// Drops everything that this session kept of the plan.
    fn forget(&mut self) {
        let path = self.file.as_ref().map(WatchedFile::path);
        self.keeper.forget(path);
    }

    /// Keeps unsaved edits and observations that are older than `pause`.
    fn keep_after(&mut self, pause: Duration, app: &App) -> io::Result<()> {
        self.keep_text(pause, app, &app.editor.text)
    }

    /// The same, with `text` as the text of the plan.
    fn keep_text(&mut self, pause: Duration, app: &App, text: &str) -> io::Result<()> {
        let path = self.file.as_ref().map(WatchedFile::path);
        self.keeper.keep_after(pause, path, [app.editor.saved(), text], &app.record)
    }
}

impl Session {
    /// A session that shows `app`. `plans` holds the jobs and the file of each plan, in the order of the plans.
    pub fn new(app: App, plans: Vec<(Jobs, Option<&Path>)>) -> Self {
        let opened = |(jobs, path): (Jobs, Option<&Path>)| OpenedPlan {
            jobs,
            file: path.map(WatchedFile::new),
            keeper: Keeper::default(),
            unkept: None,
            looked_for: None,
        };
        Self { app, plans: plans.into_iter().map(opened).collect() }
    }

    /// Restores unsaved edits and observations, and begins to judge.
    pub fn begin(&mut self) {
        self.for_each_plan(|session| {
            session.expect_change_since_read();
            session.restore_unsaved();
            session.carry_out(Request::Judge);
        });
    }

    /// Keeps unsaved edits and observations at the end; drops the edits if the user gave them up.
    pub fn end(&mut self, given_up: bool) {
        self.for_each_plan(|session| session.keep_or_drop_edits(given_up));
    }

    /// The app, and the jobs and the file of the plan in front.
    fn in_front(&mut self) -> (&mut App, &mut OpenedPlan) {
        let Self { app, plans } = self;
        let plan = &mut plans[app.side as usize];
        (app, plan)
    }

    /// Runs `work` once for each plan, with that plan in front.
    fn for_each_plan(&mut self, mut work: impl FnMut(&mut Self)) {
        for _ in 0..self.plans.len() {
            work(self);
            self.app.swap_plans();
        }
    }

    /// Draws and listens until the user leaves.
    pub fn serve_events(&mut self, display: &mut Display, signals: &Signals) -> io::Result<Exit> {
        let (mut dirty, mut heard) = (true, false);
        let [mut looked, mut drawn, mut beat] = [Instant::now(); 3];
        loop {
            self.for_each_plan(|session| {
                let told = session.listen();
                if told || dirty {
                    session.look_for_pages();
                }
                heard |= told;
                dirty |= session.keep_edits(KEPT_AFTER);
            });
            let moves_by_itself = self.app.plays_below() || self.app.plays_by_itself();
            if self.app.playing() || moves_by_itself {
                let was_playing = self.app.playing();
                self.app.advance(looked.elapsed());
                let moves = self.app.playing() || self.app.plays_below();
                let has_ended = was_playing && !self.app.playing();
                dirty |= has_ended || moves && (!moves_by_itself || drawn.elapsed() >= BELOW);
            }
            if !self.app.player.rests {
                dirty |= self.app.firing_play.advance(looked.elapsed());
            }
            if self.app.reviews() {
                dirty |= self.app.advance_review(looked.elapsed());
            }
            self.app.play_firings();
            looked = Instant::now();
            if beat.elapsed() >= BEAT {
                (beat, heard) = (looked, heard | self.app.count_on());
            }
            // Nobody reads faster than this, and the samples need the processor more.
            dirty |= heard && drawn.elapsed() >= BEAT;
            if dirty {
                (drawn, heard) = (looked, false);
                let mut areas = Areas::new();
                self.app.share_screen();
                display.draw(|frame| areas = view::draw(&self.app, frame))?;
                self.app.note_drawn(areas);
                dirty = false;
            }
            if signals.end.load(Ordering::Relaxed) {
                return Ok(Exit::Signal);
            }
            let wait = match () {
                () if moves_by_itself => BELOW,
                () if self.app.busy() || self.app.playing() || self.app.firing_play.played.is_some() => FRAME,
                () => IDLE,
            };
            let request = if signals.stop.swap(false, Ordering::Relaxed) {
                Request::Suspend
            } else if event::poll(wait)? {
                dirty = true;
                match dispatch(&mut self.app, &event::read()?) {
                    Request::None => self.app.request_flight(),
                    request => request,
                }
            } else {
                self.app.request_flight()
            };
            match request {
                Request::Quit => return Ok(Exit::Quit),
                Request::Suspend => {
                    // A suspended program may be killed.
                    self.for_each_plan(|session| {
                        session.keep_edits(Duration::ZERO);
                    });
                    display.suspend()?;
                    dirty = true;
                }
                other => self.carry_out(other),
            }
        }
    }

    /// Makes the plan's file be read again if the file has changed since the plan was read. Until now nobody watched it.
    fn expect_change_since_read(&mut self) {
        let (app, plan) = self.in_front();
        let file = plan.file.as_mut().filter(|_| FileState::now(&app.case.source) == FileState::Changed);
        file.into_iter().for_each(WatchedFile::expect_change);
    }

    /// Restores the unsaved edits and observations of the last session. Undo removes the edits.
    fn restore_unsaved(&mut self) {
        let (app, plan) = self.in_front();
        // The start screen offers a plan without a file. Such a plan is recognized by its text.
        let is_shown = |kept: &Recovered| plan.file.is_some() || kept.text == app.editor.text;
        let found = kept::find(plan.path()).filter(is_shown);
        match found.clone() {
            Some(kept) => {
                let request = app.restore_unsaved(kept);
                self.carry_out(request);
            }
            // This plan has no kept observations, but records of other plans beside it may hold some.
            None => app.record = plan.path().map(kept::find_record).unwrap_or_default(),
        }
        let (app, plan) = self.in_front();
        let texts = [app.editor.saved(), &app.editor.text];
        plan.keeper = Keeper::new(plan.path(), found, texts, &app.record);
    }

    /// Keeps unsaved edits and observations older than `pause`. Returns whether the screen shows a new error.
    fn keep_edits(&mut self, pause: Duration) -> bool {
        let (app, plan) = self.in_front();
        let Err(error) = plan.keep_after(pause, app) else { return false };
        let error = visible(&error.to_string()).into_owned();
        let is_new = plan.unkept.as_ref() != Some(&error);
        if is_new {
            app.notice = Some(format!("a crash would lose what is not saved: {error}"));
            plan.unkept = Some(error);
        }
        is_new
    }

    /// Looks at the pages beside the plan if the plan's saved text or the options that must not be fired have changed.
    fn look_for_pages(&mut self) {
        let (app, plan) = self.in_front();
        let (text, refused) = (app.editor.saved(), app.refused());
        let is_known = plan.looked_for.as_ref().is_some_and(|(known, of)| known == text && *of == refused);
        if !is_known {
            let found = plan.path().map(|path| permitting_wrongly(path, text, &refused));
            plan.looked_for = Some((text.to_owned(), refused));
            app.old_pages = found.unwrap_or_default();
        }
    }

    /// Keeps unsaved edits, unless the user gave them up, and the observations. So a plan that contradicts its observations is on hold
    /// again at the next start.
    fn keep_or_drop_edits(&mut self, given_up: bool) {
        let (app, plan) = self.in_front();
        let has_file = plan.file.is_some();
        match (app.editor.unsaved() || !app.record.is_nothing(), given_up) {
            (true, given_up) if !given_up || has_file && !app.record.is_nothing() => {
                let text = if given_up { app.editor.saved() } else { &app.editor.text };
                if let Err(error) = plan.keep_text(Duration::ZERO, app, text) {
                    let _ = writeln!(
                        io::stderr(),
                        "edits that were not saved, and what was typed as seen, are lost: {}",
                        visible(&error.to_string())
                    );
                }
            }
            _ => plan.forget(),
        }
    }

    /// Takes the news of the jobs, of the record and of the plan's file. Returns whether there is any.
    fn listen(&mut self) -> bool {
        let (mut heard, (app, plan)) = (false, self.in_front());
        for news in plan.jobs.news() {
            app.take_news(news);
            heard = true;
        }
        let there = plan.file.as_ref().and_then(|file| plan.keeper.record_file.changed(file.path()));
        if let Some(there) = there {
            let request = app.merge_record(there);
            self.carry_out(request);
            return true;
        }
        if app.file_is_newer && !app.is_changing() {
            app.file_is_newer = false;
            plan.file.iter_mut().for_each(WatchedFile::expect_change);
        }
        if let Some(read) = plan.file.as_mut().and_then(WatchedFile::changed) {
            let request = app.reload(read);
            self.carry_out(request);
            heard = true;
        }
        heard
    }

    fn ask(&mut self, kind: StudyKind, subject: Subject) {
        let (app, plan) = self.in_front();
        plan.jobs.study(kind, &app.case, subject, app.compute);
    }

    /// Serves a request of the app.
    fn carry_out(&mut self, request: Request) {
        let (app, OpenedPlan { jobs, .. }) = self.in_front();
        match request {
            Request::None | Request::Quit | Request::Suspend => {}
            Request::Judge => jobs.judge(&app.case, app.compute, app.known(), app.depth()),
            Request::JudgeNewPlan => {
                StudyKind::ALL.into_iter().for_each(|kind| jobs.cancel(kind));
                jobs.judge(&app.case, app.compute, app.known(), app.depth());
                // Every new plan is compared with the observations.
                if !app.record.is_empty() {
                    let request = app.begin_study(StudyKind::Fit);
                    self.carry_out(request);
                }
            }
            Request::Study(StudyKind::Fit) => match app.record.read(&app.case) {
                Ok(observed) => self.ask(StudyKind::Fit, Subject { observed, ..Subject::default() }),
                Err(mistake) => {
                    // A fit that still runs lacks some of the observations.
                    jobs.cancel(StudyKind::Fit);
                    app.studies.set(StudyKind::Fit, StudyState::Idle);
                    app.notice = Some(mistake);
                }
            },
            Request::ReadObserved(path) => {
                // Reading a pipe that nobody writes to would block the screen.
                let text = match path.is_file() {
                    true => observations::read_text(&path).map_err(|mistakes| mistakes.first()),
                    false => Err(format!("there is no file {}", visible(&path.to_string_lossy()))),
                };
                let request = app.take_observed_file(&path, text);
                self.carry_out(request);
            }
            Request::Study(StudyKind::Check) => {
                if let Some(fitted) = &app.fitted_plan {
                    jobs.study(StudyKind::Check, &fitted.case, Subject::default(), app.compute);
                }
            }
            Request::Study(StudyKind::Flight) => {
                if let Some((option, sample)) = app.player.recorded {
                    self.ask(StudyKind::Flight, Subject { option, sample, ..Subject::default() });
                }
            }
            Request::Study(kind) => {
                let subject = Subject::option(app.selected);
                self.ask(kind, subject);
            }
            Request::Cancel(kind) => jobs.cancel(kind),
            Request::Save => self.save(),
            Request::AskPlanPath => self.name_plan(),
            Request::SaveAs(path) => self.save_as(&path),
            Request::NameExport(stem, ending) => {
                self.app.ask_for_file(Purpose::Export, &file::unused_path(&stem, ending));
            }
            Request::Export(path) => self.write(Purpose::Export, &path, export::write),
            Request::NamePage(stem) => {
                self.app.ask_for_file(Purpose::Page, &file::unused_path(&stem, "html"));
            }
            Request::Page(path) if self.app.misnames_page(&path) => {
                let request = self.app.name_page();
                self.carry_out(request);
                self.app.notice =
                    Some("the plan or its verdict has changed: the page has another name".to_owned());
            }
            Request::Page(path) => self.write(Purpose::Page, &path, export::write_page),
            Request::Copy => {
                let copied = export::csv(&self.app).and_then(|text| {
                    let copy = io::stdout().execute(CopyToClipboard::to_clipboard_from(text)).map(|_| ());
                    copy.map_err(|error| error.to_string())
                });
                self.app.notice = Some(copied.map_or_else(|reason| reason, |()| "copied as CSV".to_owned()));
            }
        }
    }

    /// Writes to a new file. Asks for another name if that fails.
    fn write(&mut self, purpose: Purpose, path: &Path, write: fn(&App, &Path) -> Result<(), String>) {
        self.app.notice = Some(match write(&self.app, path) {
            Ok(()) => {
                if purpose == Purpose::Page {
                    self.app.pages.push(path.to_owned());
                }
                format!("wrote {}", path.display())
            }
            Err(reason) => {
                self.app.ask_for_file(purpose, &path.to_string_lossy());
                reason
            }
        });
    }

    /// Writes the plan to its file. Asks for a new file if there is none, or if the file may not be overwritten.
    fn save(&mut self) {
        let (app, plan) = self.in_front();
        let Some(file) = &mut plan.file else { return self.name_plan() };
        if app.editor.is_older_than_file() {
            let reason = "these edits are of an older text of the file; give another name";
            app.note_saved(Err(reason.to_owned()));
            return self.name_plan();
        }
        match file.write(app.editor.saved(), &app.editor.text) {
            Ok(()) => app.note_saved(Ok(app.case.source.name())),
            Err(Refusal::Failed(reason)) => {
                app.note_saved(Err(reason));
                self.name_plan();
            }
            Err(Refusal::Changed) => {
                let reason = "another program has changed the file; give another name";
                app.note_saved(Err(reason.to_owned()));
                self.name_plan();
            }
        }
    }

    /// Asks for a file for the plan and offers an unused name.
    fn name_plan(&mut self) {
        let plan = Path::new(&self.app.case.source.path);
        let stem = if plan.exists() { plan.with_extension("") } else { "plan".into() };
        let unused = file::unused_path(&stem.to_string_lossy(), "toml");
        self.app.ask_for_file(Purpose::SaveAs, &unused);
    }

    /// Writes the plan to a new file. The new file becomes the file of the plan.
    fn save_as(&mut self, path: &Path) {
        let (app, plan) = self.in_front();
        // Two plans of one shot exist then. The comment gives the new one a line to confirm, on every face.
        let left = Path::new(&app.case.source.path).file_name().filter(|_| app.leaves_a_changed_file());
        let remarked = left.map(|left| with_remark(&app.editor.text, &left.to_string_lossy()));
        let has_remark = remarked.is_some();
        let text = remarked.unwrap_or_else(|| app.editor.text.clone());
        let written = file::create(path, &text).map_err(|error| error.to_string());
        if written.is_ok() {
            // The observations speak against the plan in the old file, too.
            let is_kept = plan.file.is_some()
                && !app.record.is_nothing()
                && plan.keep_text(Duration::ZERO, app, app.editor.saved()).is_ok();
            if !is_kept {
                plan.forget();
            }
            plan.keeper = Keeper::default();
            plan.file = Some(WatchedFile::new(path));
            app.rename(path);
            config::remember(path);
        } else {
            app.ask_for_file(Purpose::SaveAs, &path.to_string_lossy());
        }
        let is_read_again = has_remark && written.is_ok();
        app.note_saved(written.map(|()| path.display().to_string()));
        if is_read_again {
            // The plan here gets its remark as the file has it.
            let saved = app.notice.take();
            let request = app.reload(Case::load(path).map_err(|mistakes| mistakes.to_string()));
            app.notice = saved;
            self.carry_out(request);
        }
    }
}

/// The text of a plan with a remark in its first line: the file `left` says something else.
fn with_remark(text: &str, left: &str) -> String {
    let (mark, rest) = text.split_at(if text.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 });
    let left: String = left.chars().filter(|sign| !sign.is_control()).collect();
    format!(
        "{mark}# not checked: another program changed {left} before this was saved: compare both, then take this line out\n{rest}"
    )
}
