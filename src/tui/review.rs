//! The review: the sampled shots, shown one after another while nothing computes. The user sees how much they differ.

use std::time::Duration;

use super::app::App;
use super::screen::Screen;
use crate::study::samples::sample::Sample;

/// Time for which each shot is shown.
const SHOWN: Duration = Duration::from_millis(400);

impl App {
    /// Whether the review runs. It shows one shot of each option at a time.
    pub fn reviews(&self) -> bool {
        !self.player.rests && (0..self.options.len()).any(|option| self.shot_in_review(option).is_some())
    }

    /// Advances the review by `elapsed` of real time. Returns whether another shot is shown.
    pub fn advance_review(&mut self, elapsed: Duration) -> bool {
        let before = self.turn();
        self.review += elapsed;
        before != self.turn()
    }

    /// Number (from 1) and sample of the option's shot in the review. After the last shot, the first follows.
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

    /// Number of shots of each option shown before.
    fn turn(&self) -> usize {
        (self.review.as_millis() / SHOWN.as_millis()) as usize
    }
}
