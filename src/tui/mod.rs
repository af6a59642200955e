//! The terminal: sets it up, draws it, gives it back. No module outside uses ratatui or crossterm.
//!
//! | what | where |
//! |---|---|
//! | the state of the screen, and how news of jobs change it | [`app`], `news`; each option: [`compare`]; the studies: [`studies`] |
//! | replacing the plan: edited, changed by another program, or restored | `shown_plan` |
//! | the action of a key, and the effect of the action | [`keymap`], `actions` with one file for each screen |
//! | the plan being edited | [`editor`]; its file: `watched_file`; unsaved edits and observations: [`crate::kept`] |
//! | the time left until all options are judged | [`pace`] |
//! | taking the terminal and giving it back; signals | `display` |
//! | the event loop, and its services for the app: jobs, files, pages | `session` |
//! | drawing | [`view`] with one file for each screen; styles: [`theme`] |
//! | two plans side by side | `two_plans`, [`plan_side`] |
//! | the plan compared with observations of earlier shots | `compared_with_observed`, [`fitted_plan`] |
//! | the line being typed | [`prompt`] with `typed_line` |
//! | playback of the flight, of the firings and of the sampled shots | [`player`], `firing_play`, `review` |
//! | export to a file | [`export`] |
//! | older pages that permit what must no longer be fired | [`old_pages`] |
//! | the start screen; the user's configuration | [`start`], [`config`] |
//!
//! The loop (`session`) waits for a key, a click or news, updates the [`App`], and draws if something changed. Every exit gives the
//! terminal back: quitting, an error, a panic, a signal.

mod actions;
pub mod app;
pub mod compare;
mod compared_with_observed;
pub mod config;
mod display;
pub mod editor;
pub mod export;
mod firing_play;
pub mod fitted_plan;
pub mod keymap;
mod news;
mod observation_line;
pub mod old_pages;
pub mod pace;
pub mod plan_side;
pub mod player;
pub mod prompt;
mod review;
pub mod screen;
mod session;
mod shown_plan;
pub mod shown_shot;
pub mod start;
pub mod studies;
pub mod study_answer;
pub mod theme;
mod two_plans;
mod typed_line;
pub mod view;
mod watched_file;

use std::io;
use std::path::Path;
use std::sync::atomic::Ordering;

use crossterm::event;

pub use self::actions::NEW_PLAN;
pub use self::actions::dispatch::dispatch;
use self::app::App;
use self::config::Config;
pub use self::display::ScreenStyle;
use self::display::{Display, Signals, restore_on_panic};
use self::session::{IDLE, Session};
use self::start::{Next, Opened, Start};
use crate::jobs::Jobs;

/// How the user left the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// By a key.
    Quit,
    /// By a signal.
    Signal,
}

/// Shows the app until the user leaves. `plans` holds the jobs and the file (if there is one) of each plan, in the order of the plans.
/// A changed file is read again.
pub fn run(app: App, plans: Vec<(Jobs, Option<&Path>)>, look: ScreenStyle) -> io::Result<Exit> {
    // Under NO_COLOR crossterm would reset bold and reverse as well. `draw` removes the colors instead.
    crossterm::style::force_color_output(true);
    let signals = Signals::register()?;
    restore_on_panic();
    let mut display = Display::open(look)?;
    let mut session = Session::new(app, plans);
    session.begin();
    let exit = session.serve_events(&mut display, &signals);
    // Messages printed on the alternate screen would vanish with that screen.
    drop(display);
    session.end(matches!(exit, Ok(Exit::Quit)));
    exit
}

/// Lets the user choose a plan to open, or leave the program.
pub fn choose(mut start: Start, config: &Config, look: ScreenStyle) -> io::Result<Result<Opened, Exit>> {
    crossterm::style::force_color_output(true);
    let signals = Signals::register()?;
    restore_on_panic();
    let mut screen = Display::open(look)?;
    loop {
        screen.draw(|frame| start.draw(config, frame))?;
        while !event::poll(IDLE)? {
            if signals.end.load(Ordering::Relaxed) {
                return Ok(Err(Exit::Signal));
            }
            if signals.stop.swap(false, Ordering::Relaxed) {
                screen.suspend()?;
            }
        }
        match start.update(&event::read()?, &config.keymap) {
            Next::Wait => {}
            Next::Open(opened) => return Ok(Ok(opened)),
            Next::Quit => return Ok(Err(Exit::Quit)),
        }
    }
}
