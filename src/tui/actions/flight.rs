//! Keys of the flight: time, speed, view.

use super::PAGE_LINES;
use crate::tui::app::{App, Request};
use crate::tui::keymap::Action;
use crate::tui::player::Player;
use crate::tui::screen::Screen;

/// Time that an arrow key moves the flight [s].
const SCRUB: f64 = 0.01;

impl App {
    pub(super) fn act_on_flight(&mut self, action: Action) -> Request {
        let end = self.flight_end();
        let seek = |player: &mut Player, by: f64| player.seek(player.time + by, end);
        match action {
            Action::Play => self.player.toggle(end),
            Action::NextEvent | Action::PreviousEvent => {
                let target = self.event_beside(self.player.time, action == Action::NextEvent);
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

    /// The nearest firing or peak of the flight after `time` [s], or before; the end or the beginning where there is none.
    fn event_beside(&self, time: f64, after: bool) -> f64 {
        let Some(flight) = self.studies.flight(self.selected) else { return time };
        let firings = self.case.shots[self.selected].times();
        let peaks = [flight.outcome.height.time, flight.outcome.force.time];
        let events = || firings.iter().chain(&peaks).copied();
        match after {
            true => events().filter(|&at| at > time + 1e-9).fold(self.flight_end(), f64::min),
            false => events().filter(|&at| at < time - 1e-9).fold(0.0, f64::max),
        }
    }
}
