//! Playback of a flight (shot, time, speed), and of the order of firing.

use std::time::Duration;

use crate::scene::Shot;
use crate::study::trace::DrawnSample;

/// Playback speeds, as shares of real time.
pub const SPEEDS: [f64; 7] = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0];

/// Rest at the end of a repeating flight, as a share of the flight's duration.
const REST: f64 = 0.15;

/// Rest at the worst moment before a flight plays by itself.
const AT_WORST: Duration = Duration::from_secs(4);

/// Which shot of an option the Compare and Flight screens draw.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ShownShot {
    /// The deciding sample; the planned shot until that sample has run.
    #[default]
    Deciding,
    /// The planned shot.
    AsPlanned,
}

impl ShownShot {
    /// The other shot.
    pub fn other(self) -> Self {
        match self {
            ShownShot::Deciding => ShownShot::AsPlanned,
            ShownShot::AsPlanned => ShownShot::Deciding,
        }
    }
}

/// Playback of one option.
#[derive(Clone, Debug)]
pub struct Player {
    /// Option and sample of the requested recording. Without a sample, the recording is of the planned shot.
    pub recorded: Option<(usize, Option<DrawnSample>)>,
    /// Time at which the recording opens [s]. `None`: its worst moment.
    pub open_at: Option<f64>,
    /// Time shown [s].
    pub time: f64,
    /// Whether the flight plays.
    pub playing: bool,
    /// Whether the user controls the playback. Then it no longer plays by itself.
    pub is_steered: bool,
    /// Time that the flight has rested at its worst moment.
    rested: Duration,
    /// Time of the repeating flight below the table of options [s].
    pub time_below: f64,
    /// Whether the user has stopped everything that moves by itself: the repeating flight, the order of firing, and the review of the
    /// shots.
    pub rests: bool,
    /// Whether the side view looks along the shelter's rows. Otherwise it looks across them.
    pub along_rows: bool,
    speed: usize,
}

impl Default for Player {
    fn default() -> Self {
        Self {
            recorded: None,
            open_at: None,
            time: 0.0,
            playing: false,
            is_steered: false,
            rested: Duration::ZERO,
            time_below: 0.0,
            rests: false,
            along_rows: false,
            speed: 3,
        }
    }
}

impl Player {
    /// Shows the flight of another option, or of another shot of the option.
    pub fn show(&mut self, option: usize, sample: Option<DrawnSample>) {
        let recorded = Some((option, sample));
        let (is_steered, rested) = (false, Duration::ZERO);
        *self = Self { recorded, time: 0.0, time_below: 0.0, is_steered, rested, ..self.clone() };
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

    /// Plays or pauses. At the end `end` [s], plays from the beginning.
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

    /// Advances the repeating flight below the table by `elapsed` of real time. The flight rests at its end [s], then starts again.
    pub fn go_round(&mut self, elapsed: Duration, end: f64) {
        let time = self.time_below + elapsed.as_secs_f64() * self.speed();
        self.time_below = if time < end * (1.0 + REST) { time } else { 0.0 };
    }

    /// Advances a flight that nobody controls by `elapsed` of real time. The flight rests at its `worst` moment [s], plays from the
    /// beginning to its `end` [s], and returns to the worst moment.
    pub fn advance_by_itself(&mut self, elapsed: Duration, end: f64, worst: f64) {
        if self.playing {
            self.advance(elapsed, end);
            self.rested = Duration::ZERO;
            self.time = if self.playing { self.time } else { worst };
            return;
        }
        self.rested += elapsed;
        if self.rested >= AT_WORST {
            (self.time, self.playing) = (0.0, true);
        }
    }

    /// Advances a playing flight by `elapsed` of real time.
    pub fn advance(&mut self, elapsed: Duration, end: f64) {
        if self.playing {
            self.seek(self.time + elapsed.as_secs_f64() * self.speed(), end);
            self.playing = self.time < end;
        }
    }
}

/// Playing time from the first hole to the last.
const PLAYED_IN: Duration = Duration::from_millis(1300);

/// Rest of the map before the order of firing plays again.
const BETWEEN_PLAYS: Duration = Duration::from_secs(5);

/// Time that a hole is shown as just fired, as a share of `PLAYED_IN`.
pub const JUST_FIRED: f64 = 0.2;

/// Playback of an order of firing. Repeats after a rest.
#[derive(Clone, Debug, Default)]
pub struct FiringPlay {
    /// Option and shot being played.
    pub shown: Option<(usize, Shot)>,
    /// Played share of the time until the last hole fires; `None` at rest. It exceeds 1 while the last hole is shown.
    pub played: Option<f64>,
    /// Time since the playback came to rest.
    pub rested: Duration,
}

impl FiringPlay {
    /// Advances by `elapsed` of real time. The playback runs until the last hole has been shown, rests, then starts at the first hole
    /// again. Returns whether anything moved.
    pub fn advance(&mut self, elapsed: Duration) -> bool {
        if let Some(played) = self.played {
            let played = played + elapsed.as_secs_f64() / PLAYED_IN.as_secs_f64();
            self.played = Some(played).filter(|played| *played < 1.0 + JUST_FIRED);
            self.rested = Duration::ZERO;
            return true;
        }
        self.rested += elapsed;
        let is_again = self.shown.is_some() && self.rested >= BETWEEN_PLAYS;
        self.played = is_again.then_some(0.0);
        is_again
    }

    /// Time since a hole fired, as a share of the playing time. The hole fires at `at` [s], the last hole at `last` [s]. Negative before
    /// the hole fires; `None` at rest.
    pub fn since(&self, at: f64, last: f64) -> Option<f64> {
        let share = if last > 0.0 { at / last } else { 0.0 };
        Some(self.played? - share)
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

    /// The flight rests at its worst moment for 4 s. Then 1 s of flight takes 10 s.
    #[test]
    fn a_flight_that_nobody_steers_plays_by_itself() {
        let mut player = Player { time: 0.6, ..Player::default() };
        let mut after = |seconds| {
            player.advance_by_itself(Duration::from_secs(seconds), 1.0, 0.6);
            (player.time, player.playing)
        };
        assert_eq!([after(3), after(1), after(5)], [(0.6, false), (0.0, true), (0.5, true)]);
        assert_eq!([after(5), after(3), after(1)], [(0.6, false), (0.6, false), (0.0, true)]);
    }

    /// At a tenth of real time, 1 s of flight takes 10 s. The rest takes 1.5 s.
    #[test]
    fn below_the_table_it_goes_round() {
        let mut player = Player::default();
        let mut after = |seconds| {
            player.go_round(Duration::from_secs(seconds), 1.0);
            player.time_below
        };
        assert_eq!([after(4), after(7), after(1), after(2)], [0.4, 1.1, 0.0, 0.2]);
    }
}
