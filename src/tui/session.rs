//! A session at the terminal: the loop that waits for a key, a click or news, updates the app, draws, and serves what the app asks for: jobs,
//! files, pages.

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
use crate::study::FileState;
use crate::study::question::StudyKind;
use crate::study::study_trait::Subject;

/// Longest wait for a key while something computes or moves: one frame.
const FRAME: Duration = Duration::from_millis(16);
/// Least time between two drawings of news alone, and between two moves of what tells that shots are tried.
const BEAT: Duration = Duration::from_millis(150);
/// Time between two pictures of a flight that moves by itself.
const BELOW: Duration = Duration::from_millis(80);
/// Age at which an edit that is not saved is kept: what a kill or a loss of power takes.
const KEPT_AFTER: Duration = Duration::from_secs(1);
/// Longest wait for a key otherwise.
pub(super) const IDLE: Duration = Duration::from_millis(250);

/// The app, and what belongs to each plan that it shows.
pub struct Session {
    app: App,
    /// In the order of [`plan_side::PlanSide`].
    plans: Vec<OpenedPlan>,
}

/// The jobs that compute for a plan, and its file.
struct OpenedPlan {
    jobs: Jobs,
    file: Option<WatchedFile>,
    /// What keeps what is in no file, and why it could not.
    keeper: Keeper,
    unkept: Option<String>,
    /// The saved text of the plan, and the options that might not be fired, when pages beside the plan were looked at last.
    looked_for: Option<(String, Vec<String>)>,
}

impl OpenedPlan {
    /// The path of its file.
    fn path(&self) -> Option<&Path> {
        self.file.as_ref().map(WatchedFile::path)
    }

    /// Drops what this session kept of it.
    fn forget(&mut self) {
        let path = self.file.as_ref().map(WatchedFile::path);
        self.keeper.forget(path);
    }

    /// Keeps what the app has in no file since longer than `pause`.
    fn keep_after(&mut self, pause: Duration, app: &App) -> io::Result<()> {
        self.keep_text(pause, app, &app.editor.text)
    }

    /// The same, with this text of the plan.
    fn keep_text(&mut self, pause: Duration, app: &App, text: &str) -> io::Result<()> {
        let path = self.file.as_ref().map(WatchedFile::path);
        self.keeper.keep_after(pause, path, [app.editor.saved(), text], &app.record)
    }
}

impl Session {
    /// Shows the app; what computes for each plan, and its file, stand in the order of its plans.
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

    /// Takes back what was in no file, and begins to judge.
    pub fn begin(&mut self) {
        self.for_each_plan(|session| {
            session.expect_change_since_read();
            session.restore_unsaved();
            session.carry_out(Request::Judge);
        });
    }

    /// Keeps what is in no file, unless the user gave it up.
    pub fn end(&mut self, given_up: bool) {
        self.for_each_plan(|session| session.keep_or_drop_edits(given_up));
    }

    /// The app, and what belongs to the plan in front.
    fn in_front(&mut self) -> (&mut App, &mut OpenedPlan) {
        let Self { app, plans } = self;
        let plan = &mut plans[app.side as usize];
        (app, plan)
    }

    /// Does something with each plan, while it is in front.
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
            // Nobody reads faster, and what is tried needs the processor more.
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
                    // Who sleeps may be killed.
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

    /// Has the file of the plan read again where it says something else than what was read of it: nobody watched it in between.
    fn expect_change_since_read(&mut self) {
        let (app, plan) = self.in_front();
        let file = plan.file.as_mut().filter(|_| FileState::now(&app.case.source) == FileState::Changed);
        file.into_iter().for_each(WatchedFile::expect_change);
    }

    /// Takes back what the last session had in no file; edits can be undone.
    fn restore_unsaved(&mut self) {
        let (app, plan) = self.in_front();
        // The start screen offers a plan without a file: here it is known by its text.
        let is_shown = |kept: &Recovered| plan.file.is_some() || kept.text == app.editor.text;
        let found = kept::find(plan.path()).filter(is_shown);
        match found.clone() {
            Some(kept) => {
                let request = app.restore_unsaved(kept);
                self.carry_out(request);
            }
            // Nothing was told of this plan, but of others beside it something may be.
            None => app.record = plan.path().map(kept::find_record).unwrap_or_default(),
        }
        let (app, plan) = self.in_front();
        let texts = [app.editor.saved(), &app.editor.text];
        plan.keeper = Keeper::new(plan.path(), found, texts, &app.record);
    }

    /// Keeps what is in no file since longer than `pause`. Returns whether the screen says something new: why it cannot be kept.
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

    /// Looks at the pages beside the plan, where its text or what may not be fired has changed.
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

    /// Keeps what is in no file: edits, unless the user gave them up, and what was seen, with which a plan that it contradicts is held
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

    /// Takes the news of the jobs and of the plan's file. Returns whether there was any.
    fn listen(&mut self) -> bool {
        let (mut heard, (app, plan)) = (false, self.in_front());
        for news in plan.jobs.news() {
            app.take_news(news);
            heard = true;
        }
        let there = plan.file.as_ref().and_then(|file| plan.keeper.record_file.changed(file.path()));
        if let Some(there) = there {
            let request = app.join_seen(there);
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
                // What was seen is compared with every plan.
                if !app.record.is_empty() {
                    let request = app.begin_study(StudyKind::Fit);
                    self.carry_out(request);
                }
            }
            Request::Study(StudyKind::Fit) => match app.record.read(&app.case) {
                Ok(observed) => self.ask(StudyKind::Fit, Subject { observed, ..Subject::default() }),
                Err(mistake) => {
                    // What still runs compares less than was seen.
                    jobs.cancel(StudyKind::Fit);
                    app.studies.set(StudyKind::Fit, StudyState::Idle);
                    app.notice = Some(mistake);
                }
            },
            Request::ReadObserved(path) => {
                // A pipe without a partner would stop the screen.
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

    /// Writes to a new file; asks for another name where that fails.
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

    /// Writes the plan to its file; asks for a new file where there is none, or another program has changed it.
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

    /// Asks for a file to write the plan to; offers an unused name.
    fn name_plan(&mut self) {
        let plan = Path::new(&self.app.case.source.path);
        let stem = if plan.exists() { plan.with_extension("") } else { "plan".into() };
        let unused = file::unused_path(&stem.to_string_lossy(), "toml");
        self.app.ask_for_file(Purpose::SaveAs, &unused);
    }

    /// Writes the plan to a new file; the new file becomes the file of the plan.
    fn save_as(&mut self, path: &Path) {
        let (app, plan) = self.in_front();
        let written = file::create(path, &app.editor.text).map_err(|error| error.to_string());
        if written.is_ok() {
            // What was seen speaks against the plan in the old file, too.
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
        app.note_saved(written.map(|()| path.display().to_string()));
    }
}
