//! Playback of a flight: the time shown and the speed.

use std::time::Duration;

/// Speeds, as shares of real time.
pub const SPEEDS: [f64; 7] = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0];

/// Playback of one option.
#[derive(Clone, Debug)]
pub struct Player {
    /// Index of the option whose recording was requested.
    pub option: Option<usize>,
    /// Time shown [s].
    pub time: f64,
    /// Whether the flight plays.
    pub playing: bool,
    /// Whether the side view looks along the shelter's rows; otherwise it looks across them.
    pub along_rows: bool,
    speed: usize,
}

impl Default for Player {
    fn default() -> Self {
        Self { option: None, time: 0.0, playing: false, along_rows: false, speed: 3 }
    }
}

impl Player {
    /// Shows another option, from its beginning.
    pub fn show_option(&mut self, option: usize) {
        *self = Self { option: Some(option), time: 0.0, ..self.clone() };
    }

    /// The speed, as a share of real time.
    pub fn speed(&self) -> f64 {
        SPEEDS[self.speed]
    }

    /// Switches to the next higher speed.
    pub fn faster(&mut self) {
        self.speed = (self.speed + 1).min(SPEEDS.len() - 1);
    }

    /// Switches to the next lower speed.
    pub fn slower(&mut self) {
        self.speed = self.speed.saturating_sub(1);
    }

    /// Plays or pauses; at the end `end` [s], plays from the beginning.
    pub fn toggle(&mut self, end: f64) {
        self.playing = !self.playing;
        if self.playing && self.time >= end {
            self.time = 0.0;
        }
    }

    /// Shows the time `time` [s] of a flight that ends at `end` [s].
    pub fn seek(&mut self, time: f64, end: f64) {
        self.time = time.clamp(0.0, end);
    }

    /// Moves a playing flight on after so much real time.
    pub fn advance(&mut self, elapsed: Duration, end: f64) {
        if self.playing {
            self.seek(self.time + elapsed.as_secs_f64() * self.speed(), end);
            self.playing = self.time < end;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_plays_to_the_end_and_again_from_the_beginning() {
        let mut player = Player::default();
        player.toggle(1.0);
        player.advance(Duration::from_secs(4), 1.0);
        assert_eq!((player.time, player.playing), (0.4, true));
        (0..9).for_each(|_| player.faster());
        player.advance(Duration::from_secs(4), 1.0);
        assert_eq!((player.time, player.playing, player.speed()), (1.0, false, 1.0));
        player.toggle(1.0);
        assert_eq!((player.time, player.playing), (0.0, true));
        player.seek(-3.0, 1.0);
        assert_eq!(player.time, 0.0);
    }
}
