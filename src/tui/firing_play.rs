//! The order of firing of the selected option, played on the map of the plan where another one comes into view, and now and then again.

use super::app::App;
use super::player::FiringPlay;
use super::screen::Screen;

impl App {
    /// Begins to play the order of firing where the map of the plan shows another than before.
    pub fn play_firings(&mut self) {
        let shown = self.case.shots.get(self.selected).filter(|_| self.screen == Screen::Plan);
        let before = self.firing_play.shown.as_ref().map(|(option, shot)| (*option, shot));
        if before != shown.map(|shot| (self.selected, shot)) {
            let shown = shown.map(|shot| (self.selected, shot.clone()));
            let played = shown.is_some().then_some(0.0).filter(|_| !self.player.rests);
            self.firing_play = FiringPlay { played, shown, ..FiringPlay::default() };
        }
    }
}
