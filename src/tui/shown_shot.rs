//! Which shot of an option Compare and Flight draw: the one that decides, or the one as planned.

use super::app::App;
use super::player::ShownShot;
use crate::report::charts::Course;
use crate::study::flight::Flight;
use crate::study::judge::deciding_shot::DecidingShots;
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
}
