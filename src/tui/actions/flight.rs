//! Keys of the flight: time, speed, view.

use super::PAGE_LINES;
use crate::study::flight::SAME_TIME;
use crate::tui::app::{App, Request};
use crate::tui::keymap::Action;
use crate::tui::player::Player;
use crate::tui::screen::Screen;

/// Time that an arrow key moves the playback [s].
const SCRUB: f64 = 0.01;

impl App {
    pub(super) fn act_on_flight(&mut self, action: Action) -> Request {
        let end = self.flight_end();
        let seek = |player: &mut Player, by: f64| player.seek(player.time + by, end);
        self.player.is_steered |= matches!(
            action,
            Action::Play
                | Action::NextEvent
                | Action::PreviousEvent
                | Action::Left
                | Action::Right
                | Action::PageUp
                | Action::PageDown
                | Action::First
                | Action::Last
        );
        match action {
            Action::Play => self.player.toggle(end),
            Action::NextEvent | Action::PreviousEvent => {
                let target = self.stop_beside(self.player.time, action == Action::NextEvent);
                self.player.seek(target, end);
            }
            Action::Faster => self.player.faster(),
            Action::Slower => self.player.slower(),
            Action::Turn => self.player.along_rows = !self.player.along_rows,
            Action::Left => seek(&mut self.player, -SCRUB),
            Action::Right => seek(&mut self.player, SCRUB),
            Action::PageUp => seek(&mut self.player, -SCRUB * PAGE_LINES as f64),
            Action::PageDown => seek(&mut self.player, SCRUB * PAGE_LINES as f64),
            Action::First => self.player.seek(0.0, end),
            Action::Last => self.player.seek(end, end),
            Action::Up => self.select_listed(-1),
            Action::Down => self.select_listed(1),
            Action::Open => self.screen = Screen::Compare,
            other => return self.act_anywhere(other),
        }
        Request::None
    }

    /// Shows the flight at `time` [s], from any screen.
    pub(super) fn show_time(&mut self, time: f64) {
        if self.screen != Screen::Flight {
            self.forget_old_flight();
            self.screen = Screen::Flight;
        }
        match self.flight() {
            Some(flight) => {
                let end = flight.end();
                self.player.seek(time, end);
                self.player.is_steered = true;
            }
            None => self.player.open_at = Some(time),
        }
    }

    /// Drops the recording if it is of another option or shot than the one to be shown.
    pub(super) fn forget_old_flight(&mut self) {
        let shown = (self.selected, self.shown_sample(self.selected));
        self.player.recorded = self.player.recorded.filter(|recorded| *recorded == shown);
    }

    /// Time [s] of the nearest stop after (or before) `time` [s]; the end (or the beginning) of the flight if there is no stop.
    fn stop_beside(&self, time: f64, after: bool) -> f64 {
        let Some(flight) = self.flight() else { return time };
        let stops = flight.stops().into_iter().map(|(at, _)| at);
        match after {
            true => stops.filter(|&at| at > time + SAME_TIME).fold(flight.end(), f64::min),
            false => stops.filter(|&at| at < time - SAME_TIME).fold(0.0, f64::max),
        }
    }
}
