//! Takes the terminal and gives it back. Handles the signals that end or stop the program.

use std::io::{self, Stdout, Write};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::thread;

use crossterm::cursor::Show;
use crossterm::event::{
    DisableBracketedPaste, DisableMouseCapture, EnableBracketedPaste, EnableMouseCapture,
};
use crossterm::terminal::{
    Clear, ClearType, EnterAlternateScreen, LeaveAlternateScreen, disable_raw_mode, enable_raw_mode,
};
use crossterm::{ExecutableCommand, QueueableCommand};
use ratatui::backend::CrosstermBackend;
use ratatui::{Frame, Terminal};

use super::theme;

/// How the terminal is used.
#[derive(Clone, Copy, Debug, Default)]
pub struct ScreenStyle {
    /// Whether only plain ASCII characters are drawn.
    pub ascii: bool,
    /// Whether colors are drawn.
    pub color: bool,
    /// Whether the program takes mouse clicks.
    pub mouse: bool,
}

/// The terminal while the program draws on it.
pub(super) struct Display {
    /// `None` once the terminal is given back.
    terminal: Option<Terminal<CrosstermBackend<Stdout>>>,
    look: ScreenStyle,
}

impl Display {
    pub fn open(look: ScreenStyle) -> io::Result<Self> {
        enter(look)?;
        // From here on, `drop` gives the terminal back.
        Terminal::new(CrosstermBackend::new(io::stdout()))
            .map(|terminal| Self { terminal: Some(terminal), look })
            .inspect_err(|_| leave())
    }

    pub fn draw(&mut self, content: impl FnOnce(&mut Frame)) -> io::Result<()> {
        let (look, Some(terminal)) = (self.look, &mut self.terminal) else { return Ok(()) };
        terminal.draw(|frame| {
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

    pub fn suspend(&mut self) -> io::Result<()> {
        leave();
        #[cfg(unix)]
        signal_hook::low_level::raise(signal_hook::consts::SIGSTOP)?;
        enter(self.look)?;
        // A new `Terminal` draws every cell. `clear` would ask the terminal for its cursor and wait for the answer.
        self.terminal = Some(Terminal::new(CrosstermBackend::new(io::stdout()))?);
        Ok(())
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        leave();
        // A `Terminal` that cannot show its cursor prints to standard error when dropped, and panics if standard error is gone, too.
        if let Some(mut terminal) = self.terminal.take()
            && terminal.show_cursor().is_err()
        {
            std::mem::forget(terminal);
        }
    }
}

fn enter(look: ScreenStyle) -> io::Result<()> {
    enable_raw_mode()?;
    let mut out = io::stdout();
    // Some terminals do not clear the alternate screen.
    let entered = out
        .execute(EnterAlternateScreen)
        .and_then(|out| out.execute(Clear(ClearType::All)))
        .and_then(|out| if look.mouse { out.execute(EnableMouseCapture) } else { Ok(out) })
        .and_then(|out| out.execute(EnableBracketedPaste));
    entered.map(|_| ()).inspect_err(|_| leave())
}

/// Gives the terminal back. If the terminal is gone, this is no error: nothing is left to do.
fn leave() {
    let mut out = io::stdout();
    let _ = out
        .queue(DisableBracketedPaste)
        .and_then(|out| out.queue(DisableMouseCapture))
        .and_then(|out| out.queue(LeaveAlternateScreen))
        .and_then(|out| out.queue(Show))
        .map(Write::flush);
    let _ = disable_raw_mode();
}

/// Makes a panic of this thread give the terminal back before the panic is reported. A panic of a job is the result of that job; the
/// screen shows it.
pub(super) fn restore_on_panic() {
    let (ours, report) = (thread::current().id(), std::panic::take_hook());
    std::panic::set_hook(Box::new(move |panic| {
        if thread::current().id() == ours {
            leave();
            report(panic);
        }
    }));
}

/// Flags that signals set.
pub(super) struct Signals {
    /// Set by SIGTERM, SIGINT, SIGQUIT and SIGHUP.
    pub end: Arc<AtomicBool>,
    /// Set by SIGTSTP.
    pub stop: Arc<AtomicBool>,
}

impl Signals {
    pub fn register() -> io::Result<Self> {
        let signals = Self { end: Arc::default(), stop: Arc::default() };
        #[cfg(unix)]
        {
            use signal_hook::consts::{SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGTSTP};
            for signal in [SIGHUP, SIGINT, SIGQUIT, SIGTERM] {
                signal_hook::flag::register(signal, Arc::clone(&signals.end))?;
            }
            signal_hook::flag::register(SIGTSTP, Arc::clone(&signals.stop))?;
        }
        Ok(signals)
    }
}
