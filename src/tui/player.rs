//! Playback of a flight: which shot and time are shown, and the speed; and of an order of firing.

use std::time::Duration;

use crate::scene::Shot;
use crate::study::trace::DrawnSample;

/// Speeds, as shares of real time.
pub const SPEEDS: [f64; 7] = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0];

/// How long a flight that goes round rests at its end, as a share of it.
const REST: f64 = 0.15;

/// How long a flight rests at its worst moment before it plays by itself.
const AT_WORST: Duration = Duration::from_secs(4);

/// Which shot of an option Compare and Flight draw.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ShownShot {
    /// The sample that decides; the shot as planned until it has run.
    #[default]
    Deciding,
    /// The shot as planned.
    AsPlanned,
}

impl ShownShot {
    /// The other one.
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
    /// Option and sample of the recording that was requested; without a sample the shot as planned.
    pub recorded: Option<(usize, Option<DrawnSample>)>,
    /// Time at which the recording opens [s]; `None`: at its worst moment.
    pub open_at: Option<f64>,
    /// Time shown [s].
    pub time: f64,
    /// Whether the flight plays.
    pub playing: bool,
    /// Whether it plays and rests when it is told to, and no more by itself.
    pub is_steered: bool,
    /// How long it has rested at its worst moment before it plays by itself.
    rested: Duration,
    /// Time of the flight that goes round below the table of options [s].
    pub time_below: f64,
    /// Whether all that moves by itself was told to rest: that flight, the order of firing, and shots that pass in review.
    pub rests: bool,
    /// Whether the side view looks along the shelter's rows; otherwise it looks across them.
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
    /// Shows another option, or another shot of it.
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

    /// Moves the flight below the table on after so much real time, and after a rest at the end round again.
    pub fn go_round(&mut self, elapsed: Duration, end: f64) {
        let time = self.time_below + elapsed.as_secs_f64() * self.speed();
        self.time_below = if time < end * (1.0 + REST) { time } else { 0.0 };
    }

    /// Plays a flight that nobody steers from its beginning to its `end` [s], once it has rested at its `worst` moment [s], and goes back
    /// there.
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

    /// Moves a playing flight on after so much real time.
    pub fn advance(&mut self, elapsed: Duration, end: f64) {
        if self.playing {
            self.seek(self.time + elapsed.as_secs_f64() * self.speed(), end);
            self.playing = self.time < end;
        }
    }
}

/// How long the first to the last hole take when their order is played.
const PLAYED_IN: Duration = Duration::from_millis(1300);

/// How long the map rests before they are played again.
const BETWEEN_PLAYS: Duration = Duration::from_secs(5);

/// How long a hole is shown as just fired, as a share of that.
pub const JUST_FIRED: f64 = 0.2;

/// An order of firing that is played, and after a rest again.
#[derive(Clone, Debug, Default)]
pub struct FiringPlay {
    /// The option and its shot that were begun to be played.
    pub shown: Option<(usize, Shot)>,
    /// The share of the time until the last hole that was played; `None` at rest.
    pub played: Option<f64>,
    /// How long it has been at rest.
    pub rested: Duration,
}

impl FiringPlay {
    /// Moves on after so much real time, until the last hole has been shown, and after a rest from the first one on. Returns whether
    /// anything moved.
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

    /// How long ago a hole fires whose time is `at` [s], where the last one fires at `last` [s], as a share of the time played; negative
    /// where it is still to fire, `None` at rest.
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

    /// It rests at its worst moment for four seconds, then takes ten for 1 s of flight.
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

    /// At a tenth of real time: 1 s of flight takes 10 s, and rests 1.5 s.
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
