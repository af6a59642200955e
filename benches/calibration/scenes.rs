//! Random scenes, smooth and hard, the same for every run: grids to 20 × 20, random launches, delays from 0 to 1 s.

use nalgebra::Vector3;
use shelter::scene::{Cable, Firing, Scene, Shot, TireId};

/// A small generator with a documented algorithm (SplitMix64), so that scenes never change.
pub struct Random(pub u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform in `low..high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    fn whole(&mut self, low: usize, high: usize) -> usize {
        self.between(low as f64, high as f64 + 1.0) as usize
    }
}

/// Scene and shot number `n`.
pub fn scene(n: u64) -> (Scene, Shot) {
    let mut random = Random(n.wrapping_mul(0x5851_f42d_4c95_7f2d) + 1);
    let most = if n.is_multiple_of(4) { 20 } else { 9 };
    let (rows, columns) = (random.whole(2, most), random.whole(2, most));
    let spacing = random.between(1.0, 3.0);
    let axial_stiffness = 10_f64.powf(random.between(5.7, 7.0));
    let slack = 1.0 + random.between(-0.03, 0.05).max(0.0);
    let diagonals = random.next() < 0.7;
    let mut scene = Scene {
        position: Vec::new(),
        mass: vec![random.between(100.0, 600.0); rows * columns],
        tire: (1..=rows * columns).map(TireId::Listed).collect(),
        cables: Vec::new(),
        friction: random.between(0.2, 0.7),
        gravity: 9.81,
        breaking_force: None,
        mirrors: Vec::new(),
    };
    for row in 0..rows {
        for column in 0..columns {
            scene.position.push(Vector3::new(column as f64 * spacing, row as f64 * spacing, 0.0));
            for (down, right) in [(0_usize, 1_isize), (1, -1), (1, 0), (1, 1)] {
                let (r, c) = (row + down, column as isize + right);
                let diagonal = down == 1 && right != 0;
                if r < rows && (0..columns as isize).contains(&c) && (diagonals || !diagonal) {
                    let span = Vector3::new(right as f64 * spacing, down as f64 * spacing, 0.0);
                    let rest_length = span.norm() * slack;
                    let ends = [row * columns + column, r * columns + c as usize];
                    scene.cables.push(Cable {
                        ends,
                        rest_length,
                        stiffness: axial_stiffness / rest_length,
                        span,
                    });
                }
            }
        }
    }
    let by_rows = random.next() < 0.6;
    let count = random.whole(1, if by_rows { rows.min(5) } else { 6 });
    let interval = if random.next() < 0.5 { random.between(0.0, 0.1) } else { random.between(0.1, 1.0) };
    let mut firings = Vec::new();
    for turn in 0..count {
        let (at, launch) = (turn as f64 * interval, random.between(3.0, 8.0));
        if by_rows {
            let row = random.whole(0, rows - 1);
            firings.extend((0..columns).map(|c| Firing { at, tire: row * columns + c, launch }));
        } else {
            firings.push(Firing { at, tire: random.whole(0, rows * columns - 1), launch });
        }
    }
    (scene, Shot::from_firings(firings))
}
