//! The terminal: set up, kept drawn, given back whole. ratatui and crossterm stop here.
//!
//! The loop waits for a key or news, updates the [`App`] and draws only when something changed. The terminal comes back on
//! every way out: quitting, an error, a panic, a signal.

pub mod app;
pub mod editor;
mod file;
pub mod keymap;
pub mod start;
pub mod studies;
pub mod theme;
pub mod view;

use std::io::{self, Stdout, Write};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use crossterm::cursor::Show;
use crossterm::event::{self, Event, KeyCode, KeyEvent, KeyEventKind};
use crossterm::terminal::{EnterAlternateScreen, LeaveAlternateScreen, disable_raw_mode, enable_raw_mode};
use crossterm::{ExecutableCommand, QueueableCommand};
use ratatui::backend::CrosstermBackend;
use ratatui::{Frame, Terminal};

use self::app::{App, Request, Screen};
use self::file::PlanFile;
use self::start::{Choice, Next, Start};
use self::studies::Progress;
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
pub enum Left {
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
pub fn run(
    mut app: App,
    mut worker: Worker,
    mut errands: Errands,
    look: Look,
    plan: Option<&Path>,
) -> io::Result<Left> {
    let mut file = plan.map(PlanFile::new);
    // Without this, crossterm under NO_COLOR resets bold and reverse as well; colours are taken out in `draw`.
    crossterm::style::force_color_output(true);
    let signals = Signals::register()?;
    restore_on_panic();
    let mut screen = Display::open()?;
    worker.start(&app.case, app.effort);
    let mut dirty = true;
    loop {
        for news in worker.news() {
            app.hear(news);
            dirty = true;
        }
        for (kind, result) in errands.results() {
            app.learn(kind, result);
            dirty = true;
        }
        for kind in Kind::ALL {
            if let Some((done, total)) = errands.counts(kind) {
                app.studies.set(kind, Progress::Running { done, total });
                dirty |= app.screen == Screen::Studies;
            }
        }
        if let Some(read) = file.as_mut().and_then(PlanFile::changed) {
            if app.reload(read) == Request::Replaced {
                replace(&app, &mut worker, &mut errands);
            }
            dirty = true;
        }
        if dirty {
            screen.draw(look, |frame| view::draw(&app, frame))?;
            dirty = false;
        }
        if signals.end.load(Ordering::Relaxed) {
            return Ok(Left::Signal);
        }
        let request = if signals.stop.swap(false, Ordering::Relaxed) {
            Request::Suspend
        } else if event::poll(if app.busy() { FRAME } else { IDLE })? {
            dirty = true;
            update(&mut app, &event::read()?)
        } else {
            Request::None
        };
        match request {
            Request::None => {}
            Request::Run => worker.start(&app.case, app.effort),
            Request::Replaced => replace(&app, &mut worker, &mut errands),
            Request::Save => {
                let written = match &mut file {
                    Some(file) => file.write(&app.editor.saved, &app.editor.text),
                    None => Err("the plan was not read from a file".to_owned()),
                };
                app.written(written);
            }
            Request::Start(kind) => errands.start(kind, &app.case, app.effort),
            Request::Cancel(kind) => errands.cancel(kind),
            Request::Quit => return Ok(Left::Quit),
            Request::Suspend => {
                screen.suspend()?;
                dirty = true;
            }
        }
    }
}

/// Lets the user choose what to open; `None` when they leave instead.
pub fn choose(mut start: Start, look: Look) -> io::Result<Option<Choice>> {
    crossterm::style::force_color_output(true);
    let signals = Signals::register()?;
    restore_on_panic();
    let mut screen = Display::open()?;
    loop {
        screen.draw(look, |frame| start.draw(Theme::default(), frame))?;
        while !event::poll(IDLE)? {
            if signals.end.load(Ordering::Relaxed) {
                return Ok(None);
            }
        }
        match start.update(&event::read()?) {
            Next::Wait => {}
            Next::Open(choice) => return Ok(Some(choice)),
            Next::Quit => return Ok(None),
        }
    }
}

/// Computes another plan; results of the old one would say nothing of it.
fn replace(app: &App, worker: &mut Worker, errands: &mut Errands) {
    Kind::ALL.into_iter().for_each(|kind| errands.cancel(kind));
    worker.start(&app.case, app.effort);
}

/// What a terminal event does to the app.
pub fn update(app: &mut App, event: &Event) -> Request {
    match event {
        Event::Key(key) if app.editor.input.is_some() && key.kind != KeyEventKind::Release => {
            app.type_key(key)
        }
        Event::Key(KeyEvent { code: KeyCode::Esc, kind: KeyEventKind::Press, .. }) => app.escape(),
        Event::Key(key) if key.kind != KeyEventKind::Release => {
            keymap::action(key).map_or(Request::None, |action| app.act(action))
        }
        _ => Request::None,
    }
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
        self.terminal.clear()
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        leave();
    }
}

fn enter() -> io::Result<()> {
    enable_raw_mode()?;
    io::stdout().execute(EnterAlternateScreen).map(|_| ()).inspect_err(|_| leave())
}

/// Gives the terminal back. Nothing can be done about a terminal that is gone.
fn leave() {
    let mut out = io::stdout();
    let _ = out.queue(LeaveAlternateScreen).and_then(|out| out.queue(Show)).map(Write::flush);
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
