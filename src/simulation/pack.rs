//! Arithmetic on as many numbers at once as the instruction set holds, chosen at run time.

use std::ops::{Add, Deref, DerefMut, Div, Mul, Sub};

use pulp::Simd;

/// Elements that are laid out, slept and woken together; every instruction set holds a part of it.
pub const LANES: usize = 8;

/// One value per lane.
pub type Pack = [f64; LANES];

/// Numbers in one register.
#[derive(Clone, Copy)]
pub struct Wide<S: Simd> {
    simd: S,
    value: S::f64s,
}

/// Conditions, one for each number in a register.
#[derive(Clone, Copy)]
pub struct Mask<S: Simd> {
    simd: S,
    value: S::m64s,
}

/// Numbers that begin at a line of the cache, so that no pack of them lies across two.
#[derive(Debug)]
pub struct Aligned {
    memory: Vec<f64>,
    start: usize,
    len: usize,
}

impl Aligned {
    /// Zeros; what is never touched takes no memory.
    pub fn zeros(len: usize) -> Self {
        let memory = vec![0.0; len + LANES];
        let start = memory.as_ptr().align_offset(size_of::<Pack>()).min(LANES);
        Self { memory, start, len }
    }
}

impl Deref for Aligned {
    type Target = [f64];

    #[inline(always)]
    fn deref(&self) -> &[f64] {
        &self.memory[self.start..self.start + self.len]
    }
}

impl DerefMut for Aligned {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [f64] {
        &mut self.memory[self.start..self.start + self.len]
    }
}

impl<S: Simd> Wide<S> {
    /// How many numbers; divides [`LANES`].
    pub const LEN: usize = S::F64_LANES;

    /// The same number in all places.
    #[inline(always)]
    pub fn splat(simd: S, value: f64) -> Self {
        Self { simd, value: simd.splat_f64s(value) }
    }

    /// Numbers from `at` on.
    #[inline(always)]
    pub fn load(simd: S, from: &[f64], at: usize) -> Self {
        Self { simd, value: S::as_simd_f64s(&from[at..at + Self::LEN]).0[0] }
    }

    /// Writes the numbers from `at` on.
    #[inline(always)]
    pub fn store(self, to: &mut [f64], at: usize) {
        S::as_mut_simd_f64s(&mut to[at..at + Self::LEN]).0[0] = self.value;
    }

    /// The numbers, in the first places of a pack.
    #[inline(always)]
    pub fn pack(self) -> Pack {
        let mut pack = [0.0; LANES];
        self.store(&mut pack, 0);
        pack
    }

    /// Adds the numbers to those from `at` on.
    #[inline(always)]
    pub fn add_to(self, to: &mut [f64], at: usize) {
        (Self::load(self.simd, to, at) + self).store(to, at);
    }

    /// self × factor + term, rounded once where the machine can.
    #[inline(always)]
    pub fn times_plus(self, factor: Self, term: Self) -> Self {
        Self { value: self.simd.mul_add_e_f64s(self.value, factor.value, term.value), ..self }
    }

    /// Square roots.
    #[inline(always)]
    pub fn sqrt(self) -> Self {
        Self { value: self.simd.sqrt_f64s(self.value), ..self }
    }

    /// Sizes without sign.
    #[inline(always)]
    pub fn abs(self) -> Self {
        Self { value: self.simd.abs_f64s(self.value), ..self }
    }

    /// The greater of each two.
    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        Self { value: self.simd.max_f64s(self.value, other.value), ..self }
    }

    /// Where these are less.
    #[inline(always)]
    pub fn less(self, other: Self) -> Mask<S> {
        Mask { simd: self.simd, value: self.simd.less_than_f64s(self.value, other.value) }
    }

    /// Where these are less or equal.
    #[inline(always)]
    pub fn at_most(self, other: Self) -> Mask<S> {
        Mask { simd: self.simd, value: self.simd.less_than_or_equal_f64s(self.value, other.value) }
    }
}

impl<S: Simd> Mask<S> {
    /// Whether any condition holds.
    #[inline(always)]
    pub fn any(self) -> bool {
        self.simd.first_true_m64s(self.value) < S::F64_LANES
    }

    /// Where both hold.
    #[inline(always)]
    pub fn and(self, other: Self) -> Self {
        Self { value: self.simd.and_m64s(self.value, other.value), ..self }
    }

    /// Where one of both holds.
    #[inline(always)]
    pub fn differs(self, other: Self) -> Self {
        Self { value: self.simd.xor_m64s(self.value, other.value), ..self }
    }

    /// `yes` where the condition holds, `no` elsewhere.
    #[inline(always)]
    pub fn select(self, yes: Wide<S>, no: Wide<S>) -> Wide<S> {
        Wide { value: self.simd.select_f64s(self.value, yes.value, no.value), ..yes }
    }
}

impl<S: Simd> Add for Wide<S> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { value: self.simd.add_f64s(self.value, other.value), ..self }
    }
}

impl<S: Simd> Sub for Wide<S> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { value: self.simd.sub_f64s(self.value, other.value), ..self }
    }
}

impl<S: Simd> Mul for Wide<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self { value: self.simd.mul_f64s(self.value, other.value), ..self }
    }
}

impl<S: Simd> Div for Wide<S> {
    type Output = Self;

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self { value: self.simd.div_f64s(self.value, other.value), ..self }
    }
}
