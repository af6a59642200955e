//! Which shot of an option Compare and Flight draw, the one that decides or the one as planned, and its flight.

use std::time::Duration;

use super::app::{App, ClickTarget, Request};
use super::compare::OptionState;
use super::player::ShownShot;
use super::screen::Screen;
use crate::report::charts::Course;
use crate::study::flight::Flight;
use crate::study::judge::deciding_shot::DecidingShots;
use crate::study::question::StudyKind;
use crate::study::trace::DrawnSample;

impl App {
    /// The shots that decide an option, where they were asked for and have run.
    pub fn deciding(&self, option: usize) -> Option<&DecidingShots> {
        let is_asked = self.shown_shot == ShownShot::Deciding;
        self.judgement(option)?.deciding.as_ref().filter(|_| is_asked)
    }

    /// Whether the rows of all options draw the shots that decide: from the first on that has them, so that no row as planned stands among
    /// them.
    pub fn rows_are_deciding(&self) -> bool {
        (0..self.options.len()).any(|option| self.deciding(option).is_some())
    }

    /// The sample that the flight of an option shows; `None` for the shot as planned.
    pub fn shown_sample(&self, option: usize) -> Option<DrawnSample> {
        self.deciding(option).map(|deciding| deciding.samples.of_any)
    }

    /// The motion of the selected option that was asked for last, once it is recorded.
    pub fn flight(&self) -> Option<&Flight> {
        let flight = self.studies.flight(self.selected)?;
        Some(flight).filter(|flight| self.player.recorded == Some((flight.option, flight.sample)))
    }

    /// The shots whose height and force are shown of an option over time, and behind them the shot as planned where that is another;
    /// nothing without a result.
    pub fn courses(&self, option: usize) -> Option<([Course<'_>; 2], Option<Course<'_>>)> {
        let checked = &self.judgement(option)?.checked;
        let planned = Course::planned(&self.case, option, checked);
        Some(match self.deciding(option) {
            Some(deciding) => (Course::of(deciding), Some(planned)),
            None => ([planned; 2], None),
        })
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

    /// Moves the flight on after so much real time.
    pub fn advance(&mut self, elapsed: Duration) {
        let end = self.flight_end();
        match self.screen {
            Screen::Flight if self.plays_by_itself() => {
                let worst = self.flight().map_or(0.0, |flight| flight.worst_moment(&self.case.limits));
                self.player.advance_by_itself(elapsed, end, worst);
            }
            Screen::Flight => self.player.advance(elapsed, end),
            _ => self.player.go_round(elapsed, self.flight_end()),
        }
    }

    /// Whether the flight on the screen plays now and then, as nobody has steered it.
    pub fn plays_by_itself(&self) -> bool {
        let is_left_alone = !self.player.is_steered && !self.player.rests;
        is_left_alone && self.screen == Screen::Flight && self.flight().is_some() && !self.busy()
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
        !self.player.rests && self.flight_below().is_some()
    }

    /// End of the flight shown [s]; 0 while there is none.
    pub(super) fn flight_end(&self) -> f64 {
        self.flight().map_or(0.0, Flight::end)
    }
}
