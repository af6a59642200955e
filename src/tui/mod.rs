//! The terminal: set up, kept drawn, given back whole. ratatui and crossterm stop here.
//!
//! The loop waits for a key, a click or news, updates the [`App`] and draws only when something changed. The terminal comes back on
//! every way out: quitting, an error, a panic, a signal.

mod act;
pub mod app;
pub mod compare;
pub mod config;
pub mod editor;
mod export;
pub mod keymap;
mod plan_file;
pub mod player;
pub mod prompt;
pub mod start;
pub mod studies;
pub mod theme;
pub mod view;

use std::io::{self, Stdout, Write};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use crossterm::clipboard::CopyToClipboard;
use crossterm::cursor::Show;
use crossterm::event::{
    self, DisableMouseCapture, EnableMouseCapture, Event, KeyCode, KeyEvent, KeyEventKind, KeyModifiers,
    MouseButton, MouseEventKind,
};
use crossterm::terminal::{
    Clear, ClearType, EnterAlternateScreen, LeaveAlternateScreen, disable_raw_mode, enable_raw_mode,
};
use crossterm::{ExecutableCommand, QueueableCommand};
use ratatui::backend::CrosstermBackend;
use ratatui::layout::Position;
use ratatui::{Frame, Terminal};

use self::app::{App, Request};
use self::keymap::Action;
use self::plan_file::{PlanFile, Refusal};
use self::prompt::{Prompt, Purpose};
use self::start::{Next, Opened, Start};
use self::theme::Theme;
use crate::worker::{Errands, Kind, Worker};

/// How the screen is drawn.
#[derive(Clone, Copy, Debug, Default)]
pub struct Look {
    /// Plain characters only.
    pub ascii: bool,
    /// With colours.
    pub color: bool,
}

/// How the user left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// By a key.
    Quit,
    /// By a signal.
    Signal,
}

/// Wait for a key while something computes: a frame.
const FRAME: Duration = Duration::from_millis(16);
/// Wait for a key while nothing does.
const IDLE: Duration = Duration::from_millis(250);

/// Shows the app until the user leaves.
///
/// `plan` is the file shown, if it is one: it is read again when it changes.
pub fn run(app: App, worker: Worker, errands: Errands, look: Look, plan: Option<&Path>) -> io::Result<Exit> {
    // Without this, crossterm under NO_COLOR resets bold and reverse as well; colours are taken out in `draw`.
    crossterm::style::force_color_output(true);
    let signals = Signals::register()?;
    restore_on_panic();
    let mut display = Display::open()?;
    let mut session = Session { app, worker, errands, file: plan.map(PlanFile::new) };
    session.worker.start(&session.app.case, session.app.compute);
    let (mut dirty, mut drawn) = (true, Instant::now());
    loop {
        dirty |= session.listen();
        if session.app.moving() {
            session.app.pass(drawn.elapsed());
            dirty = true;
        }
        drawn = Instant::now();
        if dirty {
            let mut places = Vec::new();
            display.draw(look, |frame| places = view::draw(&session.app, frame))?;
            session.app.drawn(places);
            dirty = false;
        }
        if signals.end.load(Ordering::Relaxed) {
            return Ok(Exit::Signal);
        }
        let busy = session.app.busy() || session.app.moving();
        let request = if signals.stop.swap(false, Ordering::Relaxed) {
            Request::Suspend
        } else if event::poll(if busy { FRAME } else { IDLE })? {
            dirty = true;
            match update(&mut session.app, &event::read()?) {
                Request::None => session.app.wanted(),
                request => request,
            }
        } else {
            session.app.wanted()
        };
        match request {
            Request::Quit => return Ok(Exit::Quit),
            Request::Suspend => {
                display.suspend()?;
                dirty = true;
            }
            other => session.serve(other),
        }
    }
}

/// The app with those that work for it.
struct Session {
    app: App,
    worker: Worker,
    errands: Errands,
    file: Option<PlanFile>,
}

impl Session {
    /// Takes in what the workers and the plan's file have to say; whether there was anything.
    fn listen(&mut self) -> bool {
        let mut heard = false;
        for news in self.worker.news() {
            self.app.hear(news);
            heard = true;
        }
        for (kind, result) in self.errands.results() {
            self.app.learn(kind, result);
            heard = true;
        }
        for kind in Kind::ALL {
            if let Some(counts) = self.errands.counts(kind) {
                heard |= self.app.studies.advance(kind, counts);
            }
        }
        if self.app.behind && !self.app.is_changing() {
            self.app.behind = false;
            self.file.iter_mut().for_each(PlanFile::forget);
        }
        if let Some(read) = self.file.as_mut().and_then(PlanFile::changed) {
            if self.app.reload(read) == Request::Replaced {
                self.replace();
            }
            heard = true;
        }
        heard
    }

    /// Does what the app asked for.
    fn serve(&mut self, request: Request) {
        match request {
            Request::None | Request::Quit | Request::Suspend => {}
            Request::Run => self.worker.start(&self.app.case, self.app.compute),
            Request::Replaced => self.replace(),
            Request::Save => match &mut self.file {
                Some(file) => match file.write(&self.app.editor.saved, &self.app.editor.text) {
                    Ok(()) => self.app.written(Ok(self.app.case.source.path.clone())),
                    Err(Refusal::Failed(words)) => self.app.written(Err(words)),
                    Err(Refusal::Changed) => {
                        let words = "another program has changed the file; give another name";
                        self.app.written(Err(words.to_owned()));
                        self.app.ask_for_file();
                    }
                },
                None => self.app.ask_for_file(),
            },
            Request::SaveAs(path) => self.save_as(&path),
            Request::Export(path) => {
                self.app.notice = Some(match export::write(&self.app, &path) {
                    Ok(()) => format!("wrote {}", path.display()),
                    Err(words) => {
                        self.app.prompt = Some(Prompt::new(Purpose::Export, &path.to_string_lossy()));
                        words
                    }
                });
            }
            Request::Yank => {
                let copied = export::csv(&self.app).and_then(|text| {
                    let copy = io::stdout().execute(CopyToClipboard::to_clipboard_from(text)).map(|_| ());
                    copy.map_err(|error| error.to_string())
                });
                self.app.notice = Some(copied.map_or_else(|words| words, |()| "copied as CSV".to_owned()));
            }
            Request::Start(kind) => {
                self.errands.start(kind, &self.app.case, self.app.selected, self.app.compute);
            }
            Request::Cancel(kind) => self.errands.cancel(kind),
        }
    }

    /// Computes another plan; results of the old one would say nothing of it.
    fn replace(&mut self) {
        Kind::ALL.into_iter().for_each(|kind| self.errands.cancel(kind));
        self.worker.start(&self.app.case, self.app.compute);
    }

    /// Writes the plan to a new file, which is then the one shown.
    fn save_as(&mut self, path: &Path) {
        let written = crate::file::create(path, &self.app.editor.text).map_err(|error| error.to_string());
        if written.is_ok() {
            self.file = Some(PlanFile::new(path));
            self.app.rename(path);
            config::remember(path);
        } else {
            self.app.prompt = Some(Prompt::new(Purpose::SaveAs, &path.to_string_lossy()));
        }
        self.app.written(written.map(|()| path.display().to_string()));
    }
}

/// Lets the user choose what to open, or leave.
pub fn choose(mut start: Start, theme: Theme, look: Look) -> io::Result<Result<Opened, Exit>> {
    crossterm::style::force_color_output(true);
    let signals = Signals::register()?;
    restore_on_panic();
    let mut screen = Display::open()?;
    loop {
        screen.draw(look, |frame| start.draw(theme, frame))?;
        while !event::poll(IDLE)? {
            if signals.end.load(Ordering::Relaxed) {
                return Ok(Err(Exit::Signal));
            }
            if signals.stop.swap(false, Ordering::Relaxed) {
                screen.suspend()?;
            }
        }
        match start.update(&event::read()?) {
            Next::Wait => {}
            Next::Open(opened) => return Ok(Ok(opened)),
            Next::Quit => return Ok(Err(Exit::Quit)),
        }
    }
}

/// What a terminal event does to the app.
pub fn update(app: &mut App, event: &Event) -> Request {
    match event {
        Event::Key(key) if key.kind == KeyEventKind::Release => Request::None,
        Event::Key(key) if app.prompt.is_some() => app.type_in_prompt(&given_up(key)),
        Event::Key(key) if app.editor.typing() => app.type_key(&given_up(key)),
        Event::Key(KeyEvent { code: KeyCode::Esc, .. }) => app.escape(),
        Event::Key(key) => app.keymap.action(key).map_or(Request::None, |action| app.act(action)),
        Event::Mouse(_) if app.prompt.is_some() || app.editor.typing() => Request::None,
        Event::Mouse(mouse) => match mouse.kind {
            MouseEventKind::Down(MouseButton::Left) => app.click(Position::new(mouse.column, mouse.row)),
            MouseEventKind::ScrollUp => app.act(Action::Up),
            MouseEventKind::ScrollDown => app.act(Action::Down),
            _ => Request::None,
        },
        _ => Request::None,
    }
}

/// A key while something is typed: Ctrl-C gives it up, as Esc does.
fn given_up(key: &KeyEvent) -> KeyEvent {
    let interrupt = key.code == KeyCode::Char('c') && key.modifiers.contains(KeyModifiers::CONTROL);
    if interrupt { KeyEvent::new(KeyCode::Esc, KeyModifiers::NONE) } else { *key }
}

/// The terminal while it is ours.
struct Display {
    terminal: Terminal<CrosstermBackend<Stdout>>,
}

impl Display {
    fn open() -> io::Result<Self> {
        enter()?;
        // From here on dropping gives the terminal back.
        Terminal::new(CrosstermBackend::new(io::stdout()))
            .map(|terminal| Self { terminal })
            .inspect_err(|_| leave())
    }

    fn draw(&mut self, look: Look, content: impl FnOnce(&mut Frame)) -> io::Result<()> {
        self.terminal.draw(|frame| {
            content(frame);
            let buffer = frame.buffer_mut();
            if look.ascii {
                theme::to_ascii(buffer);
            }
            if !look.color {
                theme::without_color(buffer);
            }
        })?;
        Ok(())
    }

    fn suspend(&mut self) -> io::Result<()> {
        leave();
        #[cfg(unix)]
        signal_hook::low_level::raise(signal_hook::consts::SIGSTOP)?;
        enter()?;
        // One that knows of nothing drawn yet. `clear` would ask the terminal where its cursor is, and wait.
        self.terminal = Terminal::new(CrosstermBackend::new(io::stdout()))?;
        Ok(())
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        leave();
    }
}

fn enter() -> io::Result<()> {
    enable_raw_mode()?;
    let mut out = io::stdout();
    // Not every terminal empties its second screen by itself.
    let entered = out
        .execute(EnterAlternateScreen)
        .and_then(|out| out.execute(Clear(ClearType::All)))
        .and_then(|out| out.execute(EnableMouseCapture));
    entered.map(|_| ()).inspect_err(|_| leave())
}

/// Gives the terminal back. Nothing can be done about a terminal that is gone.
fn leave() {
    let mut out = io::stdout();
    let _ = out
        .queue(DisableMouseCapture)
        .and_then(|out| out.queue(LeaveAlternateScreen))
        .and_then(|out| out.queue(Show))
        .map(Write::flush);
    let _ = disable_raw_mode();
}

/// A panic on this thread gives the terminal back before it is reported; one in a worker is that option's failure and is
/// reported on the screen.
fn restore_on_panic() {
    let (ours, report) = (thread::current().id(), std::panic::take_hook());
    std::panic::set_hook(Box::new(move |panic| {
        if thread::current().id() == ours {
            leave();
            report(panic);
        }
    }));
}

/// Signals as flags.
struct Signals {
    /// Terminate, interrupt or hang up.
    end: Arc<AtomicBool>,
    /// Stop.
    stop: Arc<AtomicBool>,
}

impl Signals {
    fn register() -> io::Result<Self> {
        let signals = Self { end: Arc::default(), stop: Arc::default() };
        #[cfg(unix)]
        {
            use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGTSTP};
            for signal in [SIGHUP, SIGINT, SIGTERM] {
                signal_hook::flag::register(signal, Arc::clone(&signals.end))?;
            }
            signal_hook::flag::register(SIGTSTP, Arc::clone(&signals.stop))?;
        }
        Ok(signals)
    }
}
