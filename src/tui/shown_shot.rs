//! Which shot of an option Compare and Flight draw (the deciding or the planned shot), and the flight of that shot.

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
    /// The shots that decide an option, if the user wants to see them and they have run.
    pub fn deciding(&self, option: usize) -> Option<&DecidingShots> {
        let is_asked = self.shown_shot == ShownShot::Deciding;
        self.judgement(option)?.deciding.as_ref().filter(|_| is_asked)
    }

    /// Whether the rows of all options draw the deciding shots. True as soon as one option has them, so that rows of planned and deciding
    /// shots do not mix.
    pub fn rows_are_deciding(&self) -> bool {
        (0..self.options.len()).any(|option| self.deciding(option).is_some())
    }

    /// The sample that the flight of an option shows; `None` for the planned shot.
    pub fn shown_sample(&self, option: usize) -> Option<DrawnSample> {
        self.deciding(option).map(|deciding| deciding.samples.of_any)
    }

    /// The recorded motion of the selected option, if the last requested recording is finished.
    pub fn flight(&self) -> Option<&Flight> {
        let flight = self.studies.flight(self.selected)?;
        Some(flight).filter(|flight| self.player.recorded == Some((flight.option, flight.sample)))
    }

    /// The shots whose height and force over time are shown for an option, and behind them the planned shot if it is another. `None` if the
    /// option has no result.
    pub fn courses(&self, option: usize) -> Option<([Course<'_>; 2], Option<Course<'_>>)> {
        let checked = &self.judgement(option)?.checked;
        let planned = Course::planned(&self.case, option, checked);
        Some(match self.deciding(option) {
            Some(deciding) => (Course::of(deciding), Some(planned)),
            None => ([planned; 2], None),
        })
    }

    /// Requests the recording to be shown, once for each option and shot. While more samples come, the first recorded sample stays.
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

    /// Advances the flight by `elapsed` of real time.
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

    /// Whether the flight on the Flight screen plays by itself from time to time: the user does not control it.
    pub fn plays_by_itself(&self) -> bool {
        let is_left_alone = !self.player.is_steered && !self.player.rests;
        is_left_alone && self.screen == Screen::Flight && self.flight().is_some() && !self.busy()
    }

    /// Whether charts, in which a flight repeats, have room below the table of options.
    fn has_charts_below(&self) -> bool {
        let is_chart = |target: &ClickTarget| matches!(target, ClickTarget::Time(_));
        self.screen == Screen::Compare && self.areas.iter().any(|(_, target)| is_chart(target))
    }

    /// The flight of the selected option below the table, and its time [s]. `None` while something computes: then other marks move.
    pub fn flight_below(&self) -> Option<(&Flight, f64)> {
        let flight = self.flight().filter(|_| self.has_charts_below() && !self.busy())?;
        Some((flight, self.player.time_below.min(flight.end())))
    }

    /// Whether the flight below the table moves.
    pub fn plays_below(&self) -> bool {
        !self.player.rests && self.flight_below().is_some()
    }

    /// End of the flight on the screen [s]; 0 if there is no flight.
    pub(super) fn flight_end(&self) -> f64 {
        self.flight().map_or(0.0, Flight::end)
    }
}
