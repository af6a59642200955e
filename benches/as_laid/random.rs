//! Random numbers of its own: SplitMix64 (Steele, Lea and Flood 2014) and normal deviations by Box and Muller (1958).

/// A stream of random numbers.
pub struct Random(u64);

impl Random {
    /// The stream of sample `number` of a seed.
    pub fn new(seed: u64, number: usize) -> Self {
        let mut of_seed = Self(seed);
        Self(of_seed.next().wrapping_add(Self(number as u64).next()))
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// A number from `low` up to `high`, all alike.
    pub fn between(&mut self, [low, high]: [f64; 2]) -> f64 {
        low + (high - low) * (self.next() >> 11) as f64 * 0.5_f64.powi(53)
    }

    /// A normal deviation of this standard deviation.
    pub fn normal(&mut self, deviation: f64) -> f64 {
        let radius = (-2.0 * (1.0 - self.between([0.0, 1.0])).ln()).sqrt();
        deviation * radius * self.between([0.0, std::f64::consts::TAU]).cos()
    }

    /// A lognormal factor of mean 1 with this coefficient of variation [%].
    pub fn factor(&mut self, cv_percent: f64) -> f64 {
        let deviation = (1.0 + (cv_percent / 100.0).powi(2)).ln().sqrt();
        (self.normal(deviation) - 0.5 * deviation * deviation).exp()
    }
}
