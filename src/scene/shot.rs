//! Firings of one shot: which tire is launched when, and how fast.

use nalgebra::Vector3;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::Mirror;

/// Impulse of one hole on one tire.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Firing {
    /// Firing time [s].
    pub time: f64,
    /// Index of the tire above the hole.
    pub tire: usize,
    /// Launch velocity: impulse of the hole over the mass of the tire [m/s].
    pub launch: Vector3<f64>,
    /// Time over which the impulse acts, as a constant force [s]; 0: at once.
    pub push_time: f64,
    /// Index of the blast row.
    pub row: usize,
    /// Explosive in the hole [kg]; 0 where the plan says nothing.
    pub charge: f64,
}

impl Firing {
    /// Firing at `time` [s] that launches a tire straight up with `speed` [m/s].
    pub fn up(time: f64, tire: usize, speed: f64) -> Self {
        Self::at_once(time, tire, Vector3::z() * speed)
    }

    /// Firing at `time` [s] that gives a tire the velocity `launch` [m/s] at once.
    pub fn at_once(time: f64, tire: usize, launch: Vector3<f64>) -> Self {
        Self { time, tire, launch, push_time: 0.0, row: 0, charge: 0.0 }
    }

    /// Its image in a mirror plane.
    pub fn mirrored(&self, mirror: &Mirror) -> Self {
        let (tire, launch) = mirror.reflect(self.tire, self.launch);
        Self { tire, launch, ..*self }
    }
}

/// All firings of one shot.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shot {
    /// Firings in order of time, then of tires (`n_holes`).
    pub firings: Vec<Firing>,
    /// Coefficient of friction in this shot, which counts before that of the scene: nearby shots and samples vary it, and share the
    /// scene. `None`: the friction of the scene.
    pub friction: Option<f64>,
}

impl Shot {
    /// Shot of `firings` in any order.
    pub fn from_firings(mut firings: Vec<Firing>) -> Self {
        firings.sort_by(|a, b| a.time.total_cmp(&b.time).then(a.tire.cmp(&b.tire)));
        Self { firings, friction: None }
    }

    /// Firing times [s], each once.
    pub fn times(&self) -> Vec<f64> {
        let mut times: Vec<f64> = self.firings.iter().map(|firing| firing.time).collect();
        times.dedup();
        times
    }

    /// The same shot with all launch velocities times `factor`.
    pub fn with_launches(&self, factor: f64) -> Self {
        let faster = |firing: &Firing| Firing { launch: firing.launch * factor, ..*firing };
        Self { firings: self.firings.iter().map(faster).collect(), ..*self }
    }

    /// The same shot, in which all holes fire later by this time [s].
    pub fn later_by(&self, time: f64) -> Self {
        let later = |firing: &Firing| Firing { time: firing.time + time, ..*firing };
        Self { firings: self.firings.iter().map(later).collect(), ..*self }
    }

    /// The same shot, in which the holes under these tires fire at these times [s].
    pub fn with_times(&self, times: &[(usize, f64)]) -> Self {
        let time = |firing: &Firing| times.iter().find(|(tire, _)| *tire == firing.tire).map(|(_, at)| *at);
        let timed = |firing: &Firing| Firing { time: time(firing).unwrap_or(firing.time), ..*firing };
        Self { friction: self.friction, ..Self::from_firings(self.firings.iter().map(timed).collect()) }
    }

    /// Two shots near this one, to both sides of it: what is greater in one is smaller in the other.
    ///
    /// Friction, and for each firing time the time itself and all launch velocities, change by factors of their own, drawn
    /// between `relative`/2 and `relative` from 1. A shot that is its own image under a reflection stays so. `friction` is that
    /// of the scene. The same `number` gives the same two shots.
    pub fn nearby_pair(&self, friction: f64, relative: f64, number: u64) -> [Self; 2] {
        [1.0, -1.0].map(|side| {
            let mut random = ChaCha8Rng::seed_from_u64(number);
            let mut factor = || {
                let size = random.random_range(0.5..1.0) * if random.random() { relative } else { -relative };
                1.0 + side * size
            };
            let friction = Some(self.friction.unwrap_or(friction) * factor());
            let mut firings = self.firings.clone();
            for volley in firings.chunk_by_mut(|a, b| a.time == b.time) {
                let (time, launch) = (factor(), factor());
                for firing in volley {
                    firing.time *= time;
                    firing.launch *= launch;
                }
            }
            Self { friction, ..Self::from_firings(firings) }
        })
    }

    /// Whether the shot is its own image in a mirror plane.
    pub fn is_mirrored(&self, mirror: &Mirror) -> bool {
        // Neither the row nor the charge moves a tire.
        let plain = |firing: Firing| Firing { row: 0, charge: 0.0, ..firing };
        let firings = self.firings.iter().copied().map(plain);
        let image = self.firings.iter().map(|firing| plain(firing.mirrored(mirror)));
        firings.eq(Self::from_firings(image.collect()).firings)
    }

    /// Most holes that fire within any `window` [s], its end left out.
    pub fn most_holes_within(&self, window: f64) -> usize {
        self.greatest_sum_within(window, |_| 1.0) as usize
    }

    /// Heaviest charge that fires within any `window` [s], its end left out [kg], to the milligram: ten
    /// charges of 8.7 kg are 87 kg.
    pub fn heaviest_charge_within(&self, window: f64) -> f64 {
        (self.greatest_sum_within(window, |firing| firing.charge) * 1e6).round() / 1e6
    }

    /// Greatest sum of `weight` over the firings within any `window` [s], its end left out; times are rounded to 1 µs, so that
    /// holes planned a window apart do not count together.
    fn greatest_sum_within(&self, window: f64, weight: impl Fn(&Firing) -> f64) -> f64 {
        let microseconds = |time: f64| (time * 1e6).round();
        let sum_from = |first: usize| {
            let end = microseconds(self.firings[first].time) + microseconds(window);
            let within = self.firings[first..].iter().take_while(|firing| microseconds(firing.time) < end);
            within.map(&weight).sum::<f64>()
        };
        // The first of those that fire together stands for all.
        let is_first = |&n: &usize| n == 0 || self.firings[n - 1].time < self.firings[n].time;
        (0..self.firings.len()).filter(is_first).map(sum_from).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In binary the sum of ten times 8.7 is 87.00000000000001, and a limit of 87 kg would be exceeded.
    #[test]
    fn charges_add_up_as_written() {
        for (count, charge, sum) in [(10, 8.7, 87.0), (3, 1.1, 3.3), (7, 12.4, 86.8), (2, 1e-6, 2e-6)] {
            let hole = |tire| Firing { charge, ..Firing::up(0.0, tire, 6.0) };
            let shot = Shot::from_firings((0..count).map(hole).collect());
            assert_eq!(shot.heaviest_charge_within(8e-3), sum);
        }
    }

    #[test]
    fn shots_to_both_sides_have_the_shot_in_their_middle() {
        let firings = [(0.0, 0, 6.0), (0.0, 1, 6.0), (0.02, 2, 5.0), (0.02, 3, 5.0)];
        let shot =
            Shot::from_firings(firings.map(|(at, tire, launch)| Firing::up(at, tire, launch)).to_vec());
        let mut sides = Vec::new();
        for number in 0..20 {
            let [more, less] = shot.nearby_pair(0.5, 1e-3, number);
            let friction = [more.friction, less.friction].map(|friction| friction.expect("its own friction"));
            assert!((friction[0] + friction[1] - 1.0).abs() < 1e-15);
            assert!((friction[0] - 0.5).abs() >= 0.5 * 0.5e-3);
            for ((more, less), firing) in more.firings.iter().zip(&less.firings).zip(&shot.firings) {
                assert!((more.time + less.time - 2.0 * firing.time).abs() < 1e-15);
                assert!((more.launch + less.launch - 2.0 * firing.launch).norm() < 1e-14);
                assert!((more.launch.z / firing.launch.z - 1.0).abs() <= 1e-3);
            }
            assert!(
                more.is_mirrored(&Mirror { axis: 0, image: vec![1, 0, 3, 2] }),
                "a shelter and its image fire alike"
            );
            sides.push(more.firings[0].launch.z > 6.0);
        }
        assert!(sides.contains(&true) && sides.contains(&false));
    }
}
