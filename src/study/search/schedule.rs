//! The firing schedules that `[search]` allows.

use std::collections::HashSet;

use itertools::Itertools;
use rand::Rng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;

use crate::choice::SearchedOrders;
use crate::plan::{BlastRow, DelayOption, HoleTiming, Time, Timing};
use crate::scene::{Firing, FiringNumbers, Shot, row_firings, shot_of_option};
use crate::sorting::{sorted, sorted_by, sorted_by_key};
use crate::study::eight_ms::WithinEightMs;
use crate::study::{Case, NoResult};

/// A firing schedule.
#[derive(Clone, Debug, PartialEq)]
pub struct Schedule {
    /// Blast rows in firing order.
    pub order: Vec<usize>,
    /// Times between successive rows (`n_blast_rows` − 1).
    pub gaps: Vec<Time>,
    /// Firing times of the holes of each row.
    pub hole_timing: HoleTiming,
}

/// Two gaps count as one if they differ by less than this share of the greater gap, or by less than [`NEAR`].
const NEAR_SHARE: f64 = 0.1;
/// See [`NEAR_SHARE`].
const NEAR: Time = Time::from_nanoseconds(2_500_000);

impl Schedule {
    /// Rows fired in `order` at one interval.
    pub fn at_interval(order: &[usize], interval: Time, hole_timing: HoleTiming) -> Self {
        Self { order: order.to_vec(), gaps: vec![interval; order.len() - 1], hole_timing }
    }

    /// The schedule as a delay option with a descriptive name.
    pub fn named_option(&self, rows: &[BlastRow]) -> DelayOption {
        self.delay_option(self.name(rows))
    }

    /// The schedule as a delay option.
    pub fn delay_option(&self, name: String) -> DelayOption {
        let (order, hole_timing) = (self.order.clone(), self.hole_timing);
        let timing = match self.gaps.as_slice() {
            [] => Timing::Interval { order, interval: Time::ZERO },
            [interval, others @ ..] if others.iter().all(|gap| gap == interval) => {
                Timing::Interval { order, interval: *interval }
            }
            gaps => {
                let mut at = vec![Time::ZERO; order.len()];
                for (n, &row) in order.iter().enumerate() {
                    at[row] = gaps[..n].iter().copied().sum();
                }
                Timing::At(at)
            }
        };
        DelayOption { name, timing, hole_timing }
    }

    /// A descriptive name: `3-1-2 42+67 ms, holes 17 ms centre`. The order is left out if it is the order of the plan. A plus joins
    /// the gaps, because `42-67 ms` could be read as a range.
    pub fn name(&self, rows: &[BlastRow]) -> String {
        let mut parts = Vec::new();
        if !self.order.is_sorted() {
            let dashes = rows.iter().any(|row| row.name.contains('-'));
            let names: Vec<&str> = self.order.iter().map(|&row| rows[row].name.as_str()).collect();
            parts.push(names.join(if dashes { " > " } else { "-" }));
        }
        let mut gaps: Vec<String> = self.gaps.iter().map(Time::to_string).collect();
        if self.gaps.iter().all_equal() {
            gaps.truncate(1);
        }
        if !gaps.is_empty() {
            parts.push(format!("{} ms", gaps.join("+")));
        }
        let rows = Some(parts.join(" ")).filter(|rows| !rows.is_empty());
        let all: Vec<String> = rows.into_iter().chain(self.hole_timing.words()).collect();
        if all.is_empty() { "all at once".to_owned() } else { all.join(", ") }
    }

    /// The shot of the schedule under the shelter of a case.
    pub fn shot(&self, case: &Case) -> Shot {
        shot_of_option(case.scene(), &case.plan.blast_rows, &self.delay_option(String::new()))
    }

    /// Whether two schedules differ so little that nobody needs both.
    pub fn is_nearly_same(&self, other: &Self) -> bool {
        let near = |(&a, &b): (&Time, &Time)| {
            let (less, more) = (a.min(b), a.max(b));
            more - less < NEAR || (more - less).seconds() < NEAR_SHARE * more.seconds()
        };
        self.order == other.order
            && self.hole_timing == other.hole_timing
            && self.gaps.iter().zip(&other.gaps).all(near)
    }
}

/// A schedule, as indices into the lists of [`ScheduleSpace`].
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Candidate {
    order: Vec<usize>,
    gaps: Vec<usize>,
    holes: usize,
}

/// A limit that a schedule of a search may exceed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SearchLimit {
    /// The longest duration of `[search]`.
    Longest,
    /// The most holes within 8 ms of `[search]` or `[limits]`.
    Holes,
    /// The heaviest charge within 8 ms of `[limits]`.
    Charge,
}

/// Numbers of schedules that exceed a limit. Each schedule is counted once.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RefusedCounts {
    /// Schedules that exceed the longest duration.
    pub too_long: usize,
    /// Schedules with too many holes within 8 ms.
    pub too_many_holes: usize,
    /// Schedules with too much charge within 8 ms.
    pub too_heavy: usize,
}

impl RefusedCounts {
    /// Counts one more schedule.
    pub fn count(&mut self, exceeded: SearchLimit) {
        *match exceeded {
            SearchLimit::Longest => &mut self.too_long,
            SearchLimit::Holes => &mut self.too_many_holes,
            SearchLimit::Charge => &mut self.too_heavy,
        } += 1;
    }
}

/// The parts of which schedules are made.
pub struct ScheduleSpace<'c> {
    case: &'c Case,
    intervals: Vec<Time>,
    /// Number of gaps that are chosen separately.
    free_gaps: usize,
    /// Rank of each blast row among all, counted across the rows (`n_blast_rows`).
    rank_across: Vec<usize>,
}

impl<'c> ScheduleSpace<'c> {
    /// The space of a plan.
    pub fn new(case: &'c Case) -> Result<Self, NoResult> {
        let (spec, rows) = (&case.plan.search, case.plan.blast_rows.len());
        let intervals = match spec.intervals.as_slice() {
            [] => case.plan.intervals(None),
            given => given.to_vec(),
        };
        if intervals.is_empty() && rows > 1 {
            return Err(NoResult::NoInterval);
        }
        let gaps = rows - 1;
        let free_gaps = if spec.equal_intervals { gaps.min(1) } else { gaps };
        Ok(Self { case, intervals, free_gaps, rank_across: ranks_across(case) })
    }

    /// Number of schedules, before limits and mirror images; `usize::MAX` if there are more.
    pub fn count(&self) -> usize {
        let rows = self.rank_across.len();
        let orders = match self.case.plan.search.orders {
            SearchedOrders::All => (1..=rows).fold(1, usize::saturating_mul),
            SearchedOrders::Listed => 1,
            SearchedOrders::Adjacent => 2_usize.saturating_pow(rows as u32 - 1),
        };
        let gaps = self.intervals.len().saturating_pow(self.free_gaps as u32);
        orders.saturating_mul(gaps).saturating_mul(self.case.plan.search.holes.len())
    }

    /// All schedules of the space.
    pub fn all(&self) -> Vec<Candidate> {
        let rows = self.rank_across.len();
        let orders: Vec<Vec<usize>> = match self.case.plan.search.orders {
            SearchedOrders::Listed => vec![(0..rows).collect()],
            SearchedOrders::All => (0..rows).permutations(rows).collect(),
            SearchedOrders::Adjacent => self.adjacent_orders(),
        };
        let gaps: Vec<Vec<usize>> = match self.free_gaps {
            0 => vec![Vec::new()],
            free => (0..free).map(|_| 0..self.intervals.len()).multi_cartesian_product().collect(),
        };
        let holes = 0..self.case.plan.search.holes.len();
        itertools::iproduct!(orders, gaps, holes)
            .map(|(order, gaps, holes)| Candidate { order, gaps, holes })
            .collect()
    }

    /// The orders in which every row but the first fires beside a row that has fired, sorted. The fired rows grow from the first
    /// row to one side or the other. So n rows have 2ⁿ⁻¹ such orders, far fewer than all n! orders.
    fn adjacent_orders(&self) -> Vec<Vec<usize>> {
        let rows = self.rank_across.len();
        let by_rank = sorted_by_key(0..rows, |&row| self.rank_across[row]);
        // Each order, with the ranks between which its rows lie.
        let mut orders: Vec<(usize, usize, Vec<usize>)> =
            (0..rows).map(|rank| (rank, rank + 1, vec![by_rank[rank]])).collect();
        for _ in 1..rows {
            let mut longer = Vec::with_capacity(2 * orders.len());
            for (low, high, order) in orders {
                let with = |rank: usize| [order.as_slice(), &[by_rank[rank]]].concat();
                longer.extend((low > 0).then(|| (low - 1, high, with(low - 1))));
                longer.extend((high < rows).then(|| (low, high + 1, with(high))));
            }
            orders = longer;
        }
        sorted(orders.into_iter().map(|(.., order)| order))
    }

    /// A random schedule of the space.
    pub fn random(&self, random: &mut ChaCha8Rng) -> Candidate {
        let rows = self.rank_across.len();
        let mut order: Vec<usize> = (0..rows).collect();
        match self.case.plan.search.orders {
            SearchedOrders::Listed => {}
            SearchedOrders::All => order.shuffle(random),
            SearchedOrders::Adjacent => {
                let from_first = sorted_by_key(0..rows, |&row| self.rank_across[row]);
                let first = random.random_range(0..rows);
                // The rows that have fired lie between these ranks.
                let (mut low, mut high) = (first, first + 1);
                order = vec![from_first[first]];
                while order.len() < rows {
                    if low > 0 && (high == rows || random.random()) {
                        low -= 1;
                        order.push(from_first[low]);
                    } else {
                        order.push(from_first[high]);
                        high += 1;
                    }
                }
            }
        }
        // The greatest gap is drawn first, so short gaps alone come often, too: a longest duration may allow no others.
        let longest = random.random_range(0..self.intervals.len().max(1));
        let gaps = (0..self.free_gaps).map(|_| random.random_range(0..=longest)).collect();
        Candidate { order, gaps, holes: random.random_range(0..self.case.plan.search.holes.len()) }
    }

    /// The neighbors of a candidate: they differ in one gap, by a swap of two successive rows, or in the holes.
    pub fn neighbours(&self, candidate: &Candidate) -> Vec<Candidate> {
        let mut all = Vec::new();
        for gap in 0..candidate.gaps.len() {
            for by in STRIDES {
                let index = candidate.gaps[gap].checked_add_signed(by);
                if let Some(index) = index.filter(|&index| index < self.intervals.len()) {
                    let mut near = candidate.clone();
                    near.gaps[gap] = index;
                    all.push(near);
                }
            }
        }
        if self.case.plan.search.orders != SearchedOrders::Listed {
            for row in 1..candidate.order.len() {
                let mut near = candidate.clone();
                near.order.swap(row - 1, row);
                if self.may_fire_in(&near.order) {
                    all.push(near);
                }
            }
        }
        let others = (0..self.case.plan.search.holes.len()).filter(|&holes| holes != candidate.holes);
        all.extend(others.map(|holes| Candidate { holes, ..candidate.clone() }));
        all
    }

    /// The schedule of a candidate.
    pub fn schedule(&self, candidate: &Candidate) -> Schedule {
        let gap = |n: usize| {
            // All gaps are equal, or each has its own.
            let index = candidate.gaps.get(n).or(candidate.gaps.first());
            index.map_or(Time::ZERO, |&index| self.intervals[index])
        };
        Schedule {
            order: candidate.order.clone(),
            gaps: (0..candidate.order.len() - 1).map(gap).collect(),
            // The safe side: if one option of the plan is fired through, so is a schedule.
            hole_timing: HoleTiming {
                fired_through: self.case.plan.delays.iter().any(|delay| delay.hole_timing.fired_through),
                ..self.case.plan.search.holes[candidate.holes]
            },
        }
    }

    /// The limit that a shot exceeds, if any: the longest duration, the most holes, or the heaviest charge within 8 ms.
    pub fn exceeded_limit(&self, shot: &Shot) -> Option<SearchLimit> {
        let (spec, limits) = (&self.case.plan.search, &self.case.limits);
        if spec.longest.is_some_and(|longest| shot.duration() > longest.seconds() + 1e-9) {
            return Some(SearchLimit::Longest);
        }
        // The stricter of both limits counts.
        let most_holes = spec.most_holes_in_8_ms.into_iter().chain(limits.holes_in_8_ms).min();
        let WithinEightMs { holes, charge } = WithinEightMs::of(self.case, shot);
        if most_holes.is_some_and(|most| holes > most) {
            return Some(SearchLimit::Holes);
        }
        let too_heavy = charge.zip(limits.charge_in_8_ms).is_some_and(|(charge, most)| charge > most);
        too_heavy.then_some(SearchLimit::Charge)
    }

    fn may_fire_in(&self, order: &[usize]) -> bool {
        let is_beside = |n: usize| {
            let rank = self.rank_across[order[n]];
            order[..n].iter().any(|&fired| self.rank_across[fired].abs_diff(rank) == 1)
        };
        self.case.plan.search.orders != SearchedOrders::Adjacent || (1..order.len()).all(is_beside)
    }
}

/// Distances in the list of intervals between neighbors of a search.
const STRIDES: [isize; 6] = [-9, -3, -1, 1, 3, 9];

/// Rank of each blast row among all (`n_blast_rows`), counted along the axis on which they lie farther apart.
fn ranks_across(case: &Case) -> Vec<usize> {
    let scene = case.scene();
    let middle = |axis: usize| -> Vec<f64> {
        let of_row = |row: &BlastRow| {
            let firings = row_firings(scene, &row.targets);
            let sum: f64 = firings.iter().map(|firing| scene.position[firing.tire][axis]).sum();
            sum / firings.len().max(1) as f64
        };
        case.plan.blast_rows.iter().map(of_row).collect()
    };
    let spread = |middles: &[f64]| {
        let ends = middles.iter().copied().minmax().into_option();
        ends.map_or(0.0, |(low, high)| high - low)
    };
    let [along_x, along_y] = [middle(0), middle(1)];
    let along = if spread(&along_x) > spread(&along_y) { along_x } else { along_y };
    let mut ranks = vec![0; along.len()];
    let in_turn = sorted_by(0..along.len(), |&a, &b| along[a].total_cmp(&along[b]));
    in_turn.into_iter().enumerate().for_each(|(rank, row)| ranks[row] = rank);
    ranks
}

/// Known shots, by the causes of their firings. A shot and its mirror images count as one.
#[derive(Default)]
pub struct KnownShots(HashSet<Vec<FiringNumbers>>);

impl KnownShots {
    /// Adds a shot; returns whether neither it nor a mirror image was known.
    pub fn insert(&mut self, case: &Case, shot: &Shot) -> bool {
        let mut images = vec![shot.clone()];
        for mirror in case.scene().mirrors_with_slope() {
            let image = |shot: &Shot| {
                Shot::from_firings(shot.firings.iter().map(|firing| firing.mirrored(mirror)).collect())
            };
            let reflected: Vec<Shot> = images.iter().map(image).collect();
            images.extend(reflected);
        }
        let keys = images.iter().map(|shot| sorted(shot.firings.iter().map(Firing::cause)));
        keys.min().is_some_and(|key| self.0.insert(key))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::PlanSource;

    fn rows(count: usize) -> Case {
        let row = |n: usize| format!("[[blast_row]]\nname = \"{n}\"\nunder_row = {n}\nlaunch_m_s = 6\n");
        let text = format!(
            "[tire]\nmass_kg = 280\n[ground]\nfriction = 0.5\n[shelter]\nlayout = \"grid\"\nrows = {count}\ncolumns = 2\nspacing_m = 1.65\n[cable]\naxial_stiffness_kn = 1000\nbreaking_force_kn = 100\n\
             [limits]\nflight_height_m = 2\ncable_safety_factor = 2\n[search]\norders = \"adjacent\"\nintervals_ms = [42]\n{}\
             [[delay]]\nname = \"a\"\ninterval_ms = 42\n",
            (1..=count).map(row).collect::<String>()
        );
        let source = PlanSource { path: std::path::PathBuf::new(), text };
        Case::parse(source).unwrap_or_else(|mistakes| panic!("{mistakes}"))
    }

    /// The grown orders are exactly the orders in which each row fires beside a fired row. Sixteen rows have 32,768 of them.
    #[test]
    fn adjacent_orders_grow_from_their_first_row() {
        for count in 1..=6 {
            let case = rows(count);
            let space = ScheduleSpace::new(&case).expect("space");
            let all = (0..count).permutations(count).filter(|order| space.may_fire_in(order));
            assert_eq!(space.adjacent_orders(), all.collect_vec(), "{count} rows");
        }
        let case = rows(16);
        let space = ScheduleSpace::new(&case).expect("space");
        assert_eq!((space.all().len(), space.count()), (32_768, 32_768));
    }
}
