//! Plays the order of firing of the selected option on the map of the plan, whenever another order comes into view. Repeats after a rest.

use super::app::App;
use super::player::FiringPlay;
use super::screen::Screen;

impl App {
    /// Starts to play the order of firing if the map of the plan shows another order than before.
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
