//! The shots that were tried, passing in review one after another once nothing computes: how much they differ is seen.

use std::time::Duration;

use super::app::App;
use super::screen::Screen;
use crate::study::samples::sample::Sample;

/// How long each shot is shown.
const SHOWN: Duration = Duration::from_millis(400);

impl App {
    /// Whether shots pass in review, one of each option at a time.
    pub fn reviews(&self) -> bool {
        !self.player.rests && (0..self.options.len()).any(|option| self.shot_in_review(option).is_some())
    }

    /// Moves on after so much real time. Returns whether another shot is shown.
    pub fn advance_review(&mut self, elapsed: Duration) -> bool {
        let before = self.turn();
        self.review += elapsed;
        before != self.turn()
    }

    /// The shot of an option that is shown, and its number; from the last one on they begin again.
    pub fn shot_in_review(&self, option: usize) -> Option<(usize, &Sample)> {
        let is_seen = match self.screen {
            Screen::Studies => !self.studies.open,
            Screen::Accuracy => true,
            Screen::Plan | Screen::Compare | Screen::Flight => false,
        };
        if !is_seen || self.busy() {
            return None;
        }
        let samples = &self.judgement(option)?.sampled.known()?.samples;
        let turn = self.turn() % samples.len().max(1);
        Some((turn + 1, samples.get(turn)?))
    }

    /// How many shots of each option were shown before.
    fn turn(&self) -> usize {
        (self.review.as_millis() / SHOWN.as_millis()) as usize
    }
}
