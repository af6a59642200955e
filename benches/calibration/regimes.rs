//! Random scenes by regime: what is hard about them. The same for every run.

use nalgebra::{Vector2, Vector3};
use shelter::scene::{Cable, Firing, Scene, Shot, TireId};

use super::random::Random;

/// What is hard about a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Regime {
    /// Grids to 9 × 9, one volley.
    Volley,
    /// Grids to 20 × 20, rows or single holes, delays from 0 to 1 s.
    Grid,
    /// Tires anywhere, tied to their neighbours.
    Irregular,
    /// Grids whose masses differ up to fiftyfold.
    Ballast,
    /// Grids with a tire in each cell.
    Quincunx,
    /// Rows that fire twice.
    FiredTwice,
    /// Delays of 0.3 to 2 s.
    LongDelay,
    /// Many single holes under one shelter.
    ManyHoles,
    /// Launches of 15 to 30 m/s.
    FastLaunch,
    /// Trees and chains.
    Tree,
    /// Slack to 20 %.
    Slack,
    /// Friction from 0.05 to 2.
    Friction,
    /// Cables between rims, a few decimetres long.
    RimToRim,
    /// Cells up to five times as long as wide.
    Stretched,
    /// Tires that rebound.
    Rebound,
    /// Launches pushed for up to 0.2 s.
    Pushed,
    /// Sloping ground, or damped cables.
    SlopeOrDamping,
    /// Rebound, push, slope and damping at once, gravity from that of the moon to that of Jupiter.
    AllEffects,
}

impl Regime {
    pub const ALL: [Self; 18] = [
        Self::Volley,
        Self::Grid,
        Self::Irregular,
        Self::Ballast,
        Self::Quincunx,
        Self::FiredTwice,
        Self::LongDelay,
        Self::ManyHoles,
        Self::FastLaunch,
        Self::Tree,
        Self::Slack,
        Self::Friction,
        Self::RimToRim,
        Self::Stretched,
        Self::Rebound,
        Self::Pushed,
        Self::SlopeOrDamping,
        Self::AllEffects,
    ];

    /// Scene and shot number `n` of the regime.
    pub fn scene(self, n: u64) -> (Scene, Shot) {
        let seed = (n << 8) | self as u64;
        let mut random = Random(seed.wrapping_mul(0x5851_f42d_4c95_7f2d) + 1);
        let most = if self == Self::Grid && n.is_multiple_of(4) { 20 } else { 9 };
        let (rows, columns) = (random.whole(2, most), random.whole(2, most));
        let spacing = random.between(1.0, 3.0);
        let stretch = if self == Self::Stretched { random.between(2.0, 5.0) } else { 1.0 };
        let mut layout = match self {
            Self::Tree => Layout::tree(&mut random, spacing),
            Self::Irregular => Layout::irregular(&mut random, rows * columns, spacing),
            _ => Layout::grid(rows, columns, [spacing, spacing * stretch], random.chance(0.7)),
        };
        if self == Self::Quincunx {
            layout.add_centres(rows, columns);
        }
        let slack = match self {
            Self::Slack => random.between(0.05, 0.2),
            _ => random.between(-0.03, 0.05).max(0.0),
        };
        let axial_stiffness = random.scale(5e5, 1e7);
        let rims = if self == Self::RimToRim { layout.shortest() - random.between(0.1, 0.5) } else { 0.0 };
        let mass = random.between(100.0, 600.0);
        let masses = layout.places.iter().map(|_| match self {
            Self::Ballast if random.chance(0.3) => mass * random.scale(1.0, 50.0),
            _ => mass,
        });
        let mut scene = Scene {
            mass: masses.collect(),
            tire_ids: (1..=layout.places.len()).map(TireId::Listed).collect(),
            cables: Vec::new(),
            friction: if self == Self::Friction { random.scale(0.05, 2.0) } else { random.between(0.2, 0.7) },
            downhill: Vector2::zeros(),
            restitution: 0.0,
            damping: 0.0,
            gravity: 9.81,
            breaking_force: None,
            strength: Vec::new(),
            mirrors: Vec::new(),
            position: layout.places,
        };
        for [a, b] in layout.ties {
            let between = scene.position[b] - scene.position[a];
            let span = between - between.normalize() * rims.max(0.0);
            let rest_length = span.norm() * (1.0 + slack);
            let stiffness = axial_stiffness / rest_length;
            scene.cables.push(Cable { ends: [a, b], rest_length, stiffness, span });
        }
        let mut shot = self.shot(&mut random, &scene, rows, columns);
        self.add_effects(&mut random, &mut scene, &mut shot);
        (scene, shot)
    }

    /// Effects beyond the paper, where the regime is of them.
    fn add_effects(self, random: &mut Random, scene: &mut Scene, shot: &mut Shot) {
        let all = self == Self::AllEffects;
        if all {
            scene.gravity = random.scale(1.6, 25.0);
        }
        if all || self == Self::Rebound {
            scene.restitution = random.between(0.1, 0.9);
        }
        if all || self == Self::Pushed {
            let push_time = random.between(0.005, 0.2);
            let pushed = shot.firings.iter().map(|firing| Firing { push_time, ..*firing });
            *shot = Shot::from_firings(pushed.collect());
        }
        if all || self == Self::SlopeOrDamping {
            let (is_sloped, is_damped) = (all || random.chance(0.5), all || random.chance(0.5));
            // Gentler than the slope on which tires slide by themselves.
            let slope = if is_sloped { 0.8 * scene.friction * random.between(0.0, 1.0) } else { 0.0 };
            let angle = random.between(0.0, std::f64::consts::TAU);
            scene.downhill = slope * scene.gravity * Vector2::new(angle.cos(), angle.sin());
            scene.damping = if is_damped { random.between(0.02, 0.8) } else { 0.0 };
        }
    }

    fn shot(self, random: &mut Random, scene: &Scene, rows: usize, columns: usize) -> Shot {
        let tires = scene.tire_count();
        let by_rows = match self {
            Self::Volley | Self::FiredTwice => true,
            Self::ManyHoles | Self::Tree | Self::Irregular => false,
            _ => random.chance(0.6),
        };
        let turns = match self {
            Self::Volley => 1,
            Self::ManyHoles => random.whole(6, 20),
            _ => random.whole(1, if by_rows { rows.min(5) } else { 6 }),
        };
        let interval = match self {
            Self::Volley => 0.0,
            Self::LongDelay => random.between(0.3, 2.0),
            Self::Grid if random.chance(0.5) => random.between(0.1, 1.0),
            _ => random.between(0.0, 0.1),
        };
        let fast = self == Self::FastLaunch;
        let mut firings = Vec::new();
        for turn in 0..turns {
            let at = turn as f64 * interval;
            let launch = if fast { random.between(15.0, 30.0) } else { random.between(3.0, 8.0) };
            let first = random.whole(0, if by_rows { rows - 1 } else { tires - 1 });
            let fired = if by_rows { first * columns..(first + 1) * columns } else { first..first + 1 };
            firings.extend(fired.clone().map(|tire| Firing::up(at, tire, launch)));
            if self == Self::FiredTwice {
                let later = at + random.between(0.05, 1.0);
                firings.extend(fired.map(|tire| Firing::up(later, tire, launch)));
            }
        }
        Shot::from_firings(firings)
    }
}

/// Places of tires [m] and pairs of tied tires.
struct Layout {
    places: Vec<Vector3<f64>>,
    ties: Vec<[usize; 2]>,
}

impl Layout {
    /// Grid, tire `row × columns + column`.
    fn grid(rows: usize, columns: usize, [along, across]: [f64; 2], diagonals: bool) -> Self {
        let place = |n: usize| Vector3::new((n % columns) as f64 * along, (n / columns) as f64 * across, 0.0);
        let mut ties = Vec::new();
        for n in 0..rows * columns {
            let (row, column) = (n / columns, n % columns);
            for (down, right) in [(0_usize, 1_isize), (1, -1), (1, 0), (1, 1)] {
                let (r, c) = (row + down, column as isize + right);
                let diagonal = down == 1 && right != 0;
                if r < rows && (0..columns as isize).contains(&c) && (diagonals || !diagonal) {
                    ties.push([n, r * columns + c as usize]);
                }
            }
        }
        Self { places: (0..rows * columns).map(place).collect(), ties }
    }

    /// Adds a tire in the middle of each cell, tied to the corners of the cell, whose diagonals go.
    fn add_centres(&mut self, rows: usize, columns: usize) {
        self.ties.retain(|&[a, b]| a / columns == b / columns || a % columns == b % columns);
        for row in 0..rows - 1 {
            for column in 0..columns - 1 {
                let corner = row * columns + column;
                let corners = [corner, corner + 1, corner + columns, corner + columns + 1];
                let centre = 0.25 * corners.iter().map(|&n| self.places[n]).sum::<Vector3<f64>>();
                self.ties.extend(corners.map(|n| [n, self.places.len()]));
                self.places.push(centre);
            }
        }
    }

    /// Places drawn no nearer than `spacing`, tied to all places within 1.6 spacings.
    fn irregular(random: &mut Random, count: usize, spacing: f64) -> Self {
        let side = spacing * 1.5 * (count as f64).sqrt();
        let mut places: Vec<Vector3<f64>> = Vec::new();
        for _ in 0..40 * count {
            let place = Vector3::new(random.between(0.0, side), random.between(0.0, side), 0.0);
            if places.len() < count && places.iter().all(|other| (other - place).norm() >= spacing) {
                places.push(place);
            }
        }
        let mut ties = Vec::new();
        for b in 1..places.len() {
            let near = |a: &usize| (places[*a] - places[b]).norm() < 1.6 * spacing;
            ties.extend((0..b).filter(near).map(|a| [a, b]));
        }
        Self { places, ties }
    }

    /// A chain or a tree: each place is tied to one earlier place, a spacing away in any direction.
    fn tree(random: &mut Random, spacing: f64) -> Self {
        let chain = random.chance(0.4);
        let (mut places, mut ties) = (vec![Vector3::zeros()], Vec::new());
        for n in 1..random.whole(3, 30) {
            let parent = if chain { n - 1 } else { random.whole(0, n - 1) };
            let turn = random.between(0.0, std::f64::consts::TAU);
            places.push(places[parent] + Vector3::new(turn.cos(), turn.sin(), 0.0) * spacing);
            ties.push([parent, n]);
        }
        Self { places, ties }
    }

    /// Length of the shortest tie [m].
    fn shortest(&self) -> f64 {
        let lengths = self.ties.iter().map(|&[a, b]| (self.places[b] - self.places[a]).norm());
        lengths.fold(f64::INFINITY, f64::min)
    }
}
