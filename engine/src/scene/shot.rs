//! Firings of one shot: which tire is launched when, and how fast.

use std::collections::BTreeMap;

use itertools::Itertools;
use nalgebra::{Vector2, Vector3};
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
    /// Number of the hole in its row, from 0, in the order of the plan.
    pub number: usize,
    /// Place of the hole in its row, counted from the left, from 0. It tells the sides of a row apart if its holes fire one after
    /// another.
    pub from_left: usize,
    /// Side of the row to which the hole belongs. [`Shot::with_dud`] sets the side in a row that has lost a hole, because the remaining
    /// firings no longer show it.
    pub side: Option<Side>,
    /// Explosive in the hole [kg]; 0 if the plan gives none.
    pub charge: f64,
    /// Line along which the hole pushes.
    pub line: PushLine,
}

/// Everything in a firing that decides the verdict on a planned or sampled shot, except the blast row. The blast row counts, too,
/// because its launches vary together: compare causes row by row. Two causes are equal if all their bits are equal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FiringNumbers {
    tire: usize,
    numbers: [u64; 11],
}

/// Side of a row that has lost a hole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Side {
    /// Number of the side, from 0.
    pub number: usize,
    /// Whether the whole row, before it lost a hole, began with one hole alone.
    pub row_begins_alone: bool,
}

/// Line along which a hole pushes its tire: from a point below the mouth of the hole to the centre of the tire.
///
/// Directions add as slopes. A slope is the part along the ground over the part along the ground's normal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PushLine {
    /// Vector from the mouth of the hole to the centre of the tire, along the ground [m].
    pub offset: Vector2<f64>,
    /// Slope that the tilt in the plan gives.
    pub tilt: Vector2<f64>,
    /// Depth below the mouth from which the push comes [m]; `None` if the plan gives none.
    pub depth: Option<f64>,
}

/// Depth below the mouth of the hole from which the push comes in samples if the plan gives no depth [m]. No measurement supports
/// this value. A smaller depth tilts launches more.
pub const ASSUMED_PUSH_DEPTH: f64 = 0.8;

impl PushLine {
    /// Slope of the planned launch. Without a depth, the offset of the hole adds no slope.
    pub fn planned_slope(&self) -> Vector2<f64> {
        self.depth.map_or(self.tilt, |depth| self.tilt + self.offset / depth)
    }

    /// Slope of the launch if the hole lies at `offset` [m] (centre of the tire less hole).
    pub fn slope_at(&self, offset: Vector2<f64>) -> Vector2<f64> {
        self.tilt + offset / self.depth.unwrap_or(ASSUMED_PUSH_DEPTH)
    }
}

/// Unit vector with the slope `slope`.
pub fn direction_of_slope(slope: Vector2<f64>) -> Vector3<f64> {
    slope.push(1.0) / slope.push(1.0).norm()
}

impl Firing {
    /// Firing at `time` [s] that launches a tire straight up with `speed` [m/s].
    pub fn up(time: f64, tire: usize, speed: f64) -> Self {
        Self::at_once(time, tire, Vector3::z() * speed)
    }

    /// Firing at `time` [s] that gives a tire the velocity `launch` [m/s] at once.
    pub fn at_once(time: f64, tire: usize, launch: Vector3<f64>) -> Self {
        let line = PushLine::default();
        Self {
            time,
            tire,
            launch,
            push_time: 0.0,
            row: 0,
            number: 0,
            from_left: 0,
            side: None,
            charge: 0.0,
            line,
        }
    }

    /// Image of the firing in a mirror plane.
    pub fn mirrored(&self, mirror: &Mirror) -> Self {
        let (tire, launch) = mirror.reflect(self.tire, self.launch);
        let mut line = self.line;
        for slope in [&mut line.offset, &mut line.tilt] {
            slope[mirror.axis] = -slope[mirror.axis];
        }
        Self { tire, launch, line, ..*self }
    }

    /// Everything in the firing that decides a verdict.
    pub fn cause(&self) -> FiringNumbers {
        let Self { time, tire, launch, push_time, charge, line: PushLine { offset, tilt, depth }, .. } =
            *self;
        let depth = depth.unwrap_or(f64::INFINITY);
        let [x, y, z] = launch.into();
        let numbers = [time, x, y, z, push_time, charge, offset.x, offset.y, tilt.x, tilt.y, depth];
        // 0 and −0 count as one number.
        FiringNumbers { tire, numbers: numbers.map(|number| (number + 0.0).to_bits()) }
    }
}

/// One way in which the holes may fire one another. A plan does not say which way holds, so a dud is judged under each of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Wiring {
    /// Whether holes that fire together, but are fewer than the sides of their row, belong to its last sides, not to its first.
    /// Example: a row is fired from both ends, and its middle hole fires alone. The middle hole may belong to either side.
    pub with_last_sides: bool,
    /// What a hole fires if several holes begin the row together.
    pub beginner_fires: BeginnerFires,
}

/// What a hole fires if it begins its row together with others. A hole that begins its row alone fires the whole row and all later
/// rows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum BeginnerFires {
    /// Its own side of the row.
    #[default]
    Side,
    /// Its own side of the row, and the later rows.
    LaterRows,
    /// All holes of its row that fire later, and the later rows.
    RowAndLaterRows,
}

impl Wiring {
    /// All possible wirings.
    pub fn all() -> impl Iterator<Item = Self> {
        let fired = [BeginnerFires::Side, BeginnerFires::LaterRows, BeginnerFires::RowAndLaterRows];
        let wiring = |(beginner_fires, with_last_sides)| Self { with_last_sides, beginner_fires };
        fired.into_iter().cartesian_product([false, true]).map(wiring)
    }
}

/// All firings of one shot.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shot {
    /// Firings in order of time, then of tires (`n_holes`).
    pub firings: Vec<Firing>,
    /// Coefficient of friction in this shot; `None`: the friction of the scene. Nearby shots and samples vary the friction and
    /// share the scene.
    pub friction: Option<f64>,
    /// Whether one hole fires the next. Then a dud stops the holes behind it.
    pub fired_through: bool,
}

impl Shot {
    /// Shot of `firings`, which may be in any order.
    pub fn from_firings(mut firings: Vec<Firing>) -> Self {
        firings.sort_by(|a, b| a.time.total_cmp(&b.time).then(a.tire.cmp(&b.tire)));
        Self { firings, friction: None, fired_through: false }
    }

    /// Time from the first hole to the last [s].
    pub fn duration(&self) -> f64 {
        let ends = self.firings.first().zip(self.firings.last());
        ends.map_or(0.0, |(first, last)| last.time - first.time)
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

    /// The same shot, with all holes later by `time` [s].
    pub fn later_by(&self, time: f64) -> Self {
        let later = |firing: &Firing| Firing { time: firing.time + time, ..*firing };
        Self { firings: self.firings.iter().map(later).collect(), ..*self }
    }

    /// The same shot, with other firing times for the holes under some tires: `times` holds tires and times [s].
    pub fn with_times(&self, times: &[(usize, f64)]) -> Self {
        let time = |firing: &Firing| times.iter().find(|(tire, _)| *tire == firing.tire).map(|(_, at)| *at);
        let timed = |firing: &Firing| Firing { time: time(firing).unwrap_or(firing.time), ..*firing };
        self.with_firings(self.firings.iter().map(timed).collect())
    }

    /// The same shot with other firings, which may be in any order.
    pub fn with_firings(&self, firings: Vec<Firing>) -> Self {
        Self { firings: Self::from_firings(firings).firings, ..*self }
    }

    /// The same shot without hole `dud` and without the holes that do not fire because of it. The remaining holes of rows that lose a hole
    /// keep their sides. In the other rows every wiring stays possible.
    pub fn with_dud(&self, dud: usize, wiring: Wiring) -> Self {
        let lost = self.lost_with((0..self.firings.len()).map(|n| n == dud).collect(), wiring);
        let mut firings = self.firings.clone();
        for (row, chains) in self.rows_of_chains(wiring) {
            if !chains.iter().flatten().any(|&n| lost[n]) {
                continue;
            }
            let row_begins_alone = self.begins_alone(&self.beginners(row, &chains));
            for (number, chain) in chains.iter().enumerate() {
                chain.iter().for_each(|&n| firings[n].side = Some(Side { number, row_begins_alone }));
            }
        }
        let left = firings.into_iter().zip(lost).filter(|(_, lost)| !lost).map(|(firing, _)| firing);
        Self { firings: left.collect(), ..*self }
    }

    /// Whether each hole does not fire if the holes in `lost` are duds (`n_holes`).
    ///
    /// In a shot that is fired through, a dud stops:
    ///
    /// - every later hole on its own side of the row, but no hole that fires together with it
    /// - the whole row and every row that begins later, if it begins its row alone
    /// - the holes that `wiring` names, if it begins its row together with others
    pub fn lost_with(&self, mut lost: Vec<bool>, wiring: Wiring) -> Vec<bool> {
        if !self.fired_through || !lost.contains(&true) {
            return lost;
        }
        for (row, chains) in self.rows_of_chains(wiring) {
            for chain in &chains {
                let dead = chain.iter().position(|&n| lost[n]).unwrap_or(chain.len());
                chain[dead..].iter().for_each(|&n| lost[n] = true);
            }
            let (begins, beginners) = (self.row_begins(row), self.beginners(row, &chains));
            let begins_alone = self.begins_alone(&beginners);
            let takes_later_rows = begins_alone || wiring.beginner_fires != BeginnerFires::Side;
            let takes_row = begins_alone || wiring.beginner_fires == BeginnerFires::RowAndLaterRows;
            if takes_later_rows && beginners.iter().any(|&n| lost[n]) {
                let goes_along = |firing: &Firing| match firing.row == row {
                    true => takes_row && firing.time > begins,
                    false => self.row_begins(firing.row) > begins,
                };
                for (firing, lost) in self.firings.iter().zip(&mut lost) {
                    *lost |= goes_along(firing);
                }
            }
        }
        lost
    }

    /// The first hole of each chain of a row that begins with the row.
    fn beginners(&self, row: usize, chains: &[Vec<usize>]) -> Vec<usize> {
        let begins = self.row_begins(row);
        chains.iter().map(|chain| chain[0]).filter(|&n| self.firings[n].time == begins).collect()
    }

    /// Whether the row of these `beginners` began with one hole alone, when it was whole.
    fn begins_alone(&self, beginners: &[usize]) -> bool {
        let alone = |&n: &usize| self.firings[n].side.is_none_or(|side| side.row_begins_alone);
        beginners.len() == 1 && beginners.iter().all(alone)
    }

    /// Time at which a blast row begins to fire [s].
    fn row_begins(&self, row: usize) -> f64 {
        let of_row = self.firings.iter().filter(|firing| firing.row == row);
        of_row.map(|firing| firing.time).fold(f64::INFINITY, f64::min)
    }

    /// Blast rows in the order in which they begin, each with its chains of holes (indices of firings). In a chain one hole fires
    /// the next.
    ///
    /// Holes with the same planned time belong to different chains. A row that is fired from its middle has two chains, its two
    /// sides. A hole that begins a row alone is the first of one chain.
    pub fn rows_of_chains(&self, wiring: Wiring) -> Vec<(usize, Vec<Vec<usize>>)> {
        let mut rows: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        self.firings.iter().enumerate().for_each(|(n, firing)| rows.entry(firing.row).or_default().push(n));
        let mut rows: Vec<(usize, Vec<Vec<usize>>)> =
            rows.into_iter().map(|(row, holes)| (row, self.chains_of(&holes, wiring))).collect();
        rows.sort_by(|a, b| self.row_begins(a.0).total_cmp(&self.row_begins(b.0)));
        rows
    }

    /// Chains of the `holes` of a row. The holes are in order of time.
    fn chains_of(&self, holes: &[usize], wiring: Wiring) -> Vec<Vec<usize>> {
        let mut chains: Vec<Vec<usize>> = Vec::new();
        let volleys = || holes.chunk_by(|&a, &b| self.firings[a].time == self.firings[b].time);
        let sides = volleys().map(<[usize]>::len).max().unwrap_or(0);
        for together in volleys() {
            let first = if wiring.with_last_sides { sides - together.len() } else { 0 };
            // The number of a tire does not show its side: the tires of a list lie in any order.
            let from_left = together.iter().sorted_by_key(|&&n| self.firings[n].from_left);
            for (nth, &hole) in from_left.enumerate() {
                let side = self.firings[hole].side.map_or(first + nth, |side| side.number);
                chains.resize(chains.len().max(side + 1), Vec::new());
                chains[side].push(hole);
            }
        }
        // A dud may leave no hole of a side.
        chains.retain(|chain| !chain.is_empty());
        chains
    }

    /// Two shots near this one, on opposite sides of it: a value that is greater in one shot is smaller in the other.
    ///
    /// Random factors change the friction and, for each firing time, the time and all launch velocities. Each factor differs from 1
    /// by `relative`/2 to `relative`. A shot that is its own mirror image stays so. `friction` is the friction of the scene. The
    /// same `number` gives the same two shots.
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
            Self { friction, ..self.with_firings(firings) }
        })
    }

    /// Whether the shot is its own image in a mirror plane.
    pub fn is_mirrored(&self, mirror: &Mirror) -> bool {
        // The launch moves the tire. The address, the charge and the push line of the hole do not, so they do not count.
        let line = PushLine::default();
        let plain = |firing: Firing| Firing {
            row: 0,
            number: 0,
            from_left: 0,
            side: None,
            charge: 0.0,
            line,
            ..firing
        };
        let firings = self.firings.iter().copied().map(plain);
        let image = self.firings.iter().map(|firing| plain(firing.mirrored(mirror)));
        firings.eq(Self::from_firings(image.collect()).firings)
    }

    /// Greatest number of holes that fire within any `window` [s]. The end of the window is not part of it.
    pub fn most_holes_within(&self, window: f64) -> usize {
        self.greatest_sum_within(window, |_| 1.0) as usize
    }

    /// Heaviest charge that fires within any `window` [s], its end left out [kg]. The sum is rounded to the milligram: ten charges
    /// of 8.7 kg are 87 kg.
    pub fn heaviest_charge_within(&self, window: f64) -> f64 {
        (self.greatest_sum_within(window, |firing| firing.charge) * 1e6).round() / 1e6
    }

    /// Greatest sum of `weight` over the firings within any `window` [s], its end left out. Times are rounded to 1 ns, as plans state
    /// them, so that holes planned a window apart do not count together.
    fn greatest_sum_within(&self, window: f64, weight: impl Fn(&Firing) -> f64) -> f64 {
        let nanoseconds = |time: f64| (time * 1e9).round();
        let sum_from = |first: usize| {
            let end = nanoseconds(self.firings[first].time) + nanoseconds(window);
            let within = self.firings[first..].iter().take_while(|firing| nanoseconds(firing.time) < end);
            within.map(&weight).sum::<f64>()
        };
        // Holes that fire together begin the same window, so the first of them is enough.
        let is_first = |&n: &usize| n == 0 || self.firings[n - 1].time < self.firings[n].time;
        (0..self.firings.len()).filter(is_first).map(sum_from).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two rows that are fired from both ends, the second one 42 ms after the first. The middle hole of a row may hang on either side.
    fn from_both_ends() -> Shot {
        let hole = |row: usize, number: usize| {
            let time = 42e-3 * row as f64 + if number == 1 { 17e-3 } else { 0.0 };
            Firing { row, number, from_left: number, ..Firing::up(time, 3 * row + number, 6.0) }
        };
        let holes = [0, 1].into_iter().cartesian_product([0, 1, 2]).map(|(row, number)| hole(row, number));
        Shot { fired_through: true, ..Shot::from_firings(holes.collect()) }
    }

    /// A dud in one row leaves open on which side the middle hole of the other row hangs: samples of the shot try both.
    #[test]
    fn a_dud_decides_nothing_about_rows_that_lose_no_hole() {
        let shot = from_both_ends();
        let last =
            shot.firings.iter().position(|firing| (firing.row, firing.number) == (1, 1)).expect("a hole");
        let after = shot.with_dud(last, Wiring::default());
        assert_eq!(after.firings.len(), 5);
        let lost_by = |first: [usize; 2]| -> Vec<usize> {
            let duds =
                after.firings.iter().map(|firing| [firing.row, firing.number] == first).collect::<Vec<_>>();
            Wiring::all()
                .map(|wiring| after.lost_with(duds.clone(), wiring).into_iter().filter(|lost| *lost).count())
                .collect()
        };
        // By wiring the middle hole is lost with the left hole of row 0, or with the right one.
        let [left, right] = [lost_by([0, 0]), lost_by([0, 2])];
        assert_eq!([left[0], left[1]], [2, 1]);
        assert_eq!([right[0], right[1]], [1, 2]);
    }

    /// Of two holes that begin a row together one is a dud. The other still fires its side alone, not the later rows.
    #[test]
    fn a_beginner_that_is_left_does_not_begin_alone() {
        let shot = from_both_ends();
        let side = Wiring::default();
        let after = shot.with_dud(0, side);
        let left: Vec<[usize; 2]> = after.firings.iter().map(|firing| [firing.row, firing.number]).collect();
        assert_eq!(left, [[0, 2], [1, 0], [1, 2], [1, 1]]);
        assert_eq!(after.lost_with(vec![true, false, false, false], side), [true, false, false, false]);
        // As a row that never had another beginner it takes the later row along.
        let alone =
            Shot { fired_through: true, ..Shot::from_firings(vec![shot.firings[0], shot.firings[3]]) };
        assert_eq!(alone.lost_with(vec![true, false], side), [true, true]);
    }

    /// A detonator is programmed in tenths of a millisecond or less: half a microsecond is no window.
    #[test]
    fn holes_that_fire_just_within_a_window_count_together() {
        let count = |apart: f64| {
            Shot::from_firings(vec![Firing::up(0.1, 0, 6.0), Firing::up(0.1 + apart, 1, 6.0)])
                .most_holes_within(8e-3)
        };
        assert_eq!([7.9996e-3, 8e-3, 8.0004e-3].map(count), [2, 1, 1]);
    }

    /// In binary, ten times 8.7 add up to 87.00000000000001, which would exceed a limit of 87 kg.
    #[test]
    fn charges_add_up_as_written() {
        for (count, charge, sum) in [(10, 8.7, 87.0), (3, 1.1, 3.3), (7, 12.4, 86.8), (2, 1e-6, 2e-6)] {
            let hole = |tire| Firing { charge, ..Firing::up(0.0, tire, 6.0) };
            let shot = Shot::from_firings((0..count).map(hole).collect());
            assert_eq!(shot.heaviest_charge_within(8e-3), sum);
        }
    }

    /// Seven holes fire from the middle outward, and the second hole from the left is a dud. The right side stays a side of its
    /// own: a further dud on the left stops no hole there.
    #[test]
    fn a_shot_with_a_dud_keeps_its_sides() {
        let hole =
            |n: usize| Firing { number: n, from_left: n, ..Firing::up(n.abs_diff(3) as f64 * 0.02, n, 6.0) };
        let shot = Shot { fired_through: true, ..Shot::from_firings((0..7).map(hole).collect()) };
        let of =
            |shot: &Shot, n: usize| shot.firings.iter().position(|firing| firing.number == n).expect("fires");
        let plain = Wiring::default();
        let left = shot.with_dud(of(&shot, 1), plain);
        let numbers = |shot: &Shot| shot.firings.iter().map(|firing| firing.number).collect_vec();
        assert_eq!(numbers(&left), [3, 2, 4, 5, 6]);
        assert_eq!(numbers(&left.with_dud(of(&left, 2), plain)), [3, 4, 5, 6]);
        assert_eq!(numbers(&left.with_dud(of(&left, 4), plain)), [3, 2]);
    }

    /// Two rows of five holes, each fired from both ends. The middle hole may belong to either end, and either end may fire the
    /// second row. A dud at one end stops the mirror image of what a dud at the other end stops.
    #[test]
    fn what_a_plan_leaves_open_of_its_wiring_is_lost_either_way() {
        let from_ends = |row: usize, at: f64| {
            (0..5_usize).map(move |n| Firing {
                row,
                number: n,
                from_left: n,
                ..Firing::up(at + n.min(4 - n) as f64 * 0.02, 5 * row + n, 6.0)
            })
        };
        let holes = from_ends(0, 0.0).chain(from_ends(1, 0.1)).collect();
        let shot = Shot { fired_through: true, ..Shot::from_firings(holes) };
        let left = |tire: usize, wiring: Wiring| {
            let dud = shot.firings.iter().position(|firing| firing.tire == tire).expect("fires");
            shot.with_dud(dud, wiring).firings.iter().map(|firing| firing.tire).sorted().collect_vec()
        };
        let behind = [5, 6, 7, 8, 9];
        let wirings: Vec<Wiring> = Wiring::all().collect();
        let [to_left, to_right, left_and_later, right_and_later, all_of_row, _] = wirings[..] else {
            panic!("{wirings:?}")
        };
        assert_eq!(left(0, all_of_row), [4], "what begins together does not hang on one another");
        assert_eq!(left(0, to_left), [&[3, 4][..], &behind].concat());
        assert_eq!(left(0, to_right), [&[2, 3, 4][..], &behind].concat());
        assert_eq!(left(4, to_left), [&[0, 1, 2][..], &behind].concat());
        assert_eq!(left(4, to_right), [&[0, 1][..], &behind].concat());
        assert_eq!((left(0, left_and_later), left(4, right_and_later)), (vec![3, 4], vec![0, 1]));
        assert_eq!(left(1, right_and_later), [&[0, 2, 3, 4][..], &behind].concat());
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
