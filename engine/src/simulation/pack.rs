//! Arithmetic on registers of numbers, and memory laid out for registers. The instruction set is chosen at run time.

use std::ops::{Add, Deref, DerefMut, Div, Mul, Sub};
use std::slice::from_ref;

use nalgebra::Vector3;
use pulp::Simd;
use pulp::bytemuck::{bytes_of, cast_slice};

/// The three components of a vector, written out: `components!(c => f(c))` is `[f(0), f(1), f(2)]`.
///
/// The compiler may compile a closure, such as `std::array::from_fn` takes, apart, for narrower registers. Then even a subtraction
/// is a call.
macro_rules! components {
    ($axis:ident => $component:expr) => {
        [
            {
                let $axis = 0;
                $component
            },
            {
                let $axis = 1;
                $component
            },
            {
                let $axis = 2;
                $component
            },
        ]
    };
}
pub(crate) use components;

/// Number of elements in a pack; a multiple of every register length. The elements of a pack are laid out, put to sleep and woken
/// together.
pub const LANES: usize = 8;

/// One number in each lane.
pub type Pack = [f64; LANES];

/// The numbers in one register.
#[derive(Clone, Copy)]
pub struct Wide<S: Simd> {
    simd: S,
    value: S::f64s,
}

/// One condition for each number in a register.
#[derive(Clone, Copy)]
pub struct Mask<S: Simd> {
    simd: S,
    value: S::m64s,
}

/// Numbers that begin at a cache line, so that each pack lies within one cache line.
#[derive(Debug)]
pub struct Aligned {
    memory: Vec<f64>,
    start: usize,
    len: usize,
}

impl Aligned {
    /// `len` zeros. Pages that nobody touches take no memory.
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

/// Vector field over tires or cables, by component.
#[derive(Debug)]
pub struct VectorArrays {
    /// The x, y and z components, all of one length.
    pub components: [Aligned; 3],
}

impl VectorArrays {
    /// `len` zero vectors.
    pub fn zeros(len: usize) -> Self {
        Self { components: std::array::from_fn(|_| Aligned::zeros(len)) }
    }

    /// Vector at `index`.
    pub fn vector(&self, index: usize) -> Vector3<f64> {
        Vector3::from_fn(|c, _| self.components[c][index])
    }

    /// Components as slices. The compiler knows that their lengths are equal.
    #[inline(always)]
    pub fn slices(&self) -> [&[f64]; 3] {
        let [x, y, z] = &self.components;
        let n = x.len();
        [&x[..n], &y[..n], &z[..n]]
    }

    /// Components as slices to write. The compiler knows that their lengths are equal.
    #[inline(always)]
    pub fn slices_mut(&mut self) -> [&mut [f64]; 3] {
        let [x, y, z] = &mut self.components;
        let n = x.len();
        [&mut x[..n], &mut y[..n], &mut z[..n]]
    }
}

impl<S: Simd> Wide<S> {
    /// Number of numbers in a register; a divisor of [`LANES`].
    pub const LEN: usize = S::F64_LANES;

    /// `value` in all lanes.
    #[inline(always)]
    pub fn splat(simd: S, value: f64) -> Self {
        Self { simd, value: simd.splat_f64s(value) }
    }

    /// The numbers of `from` from index `at` on.
    #[inline(always)]
    pub fn load(simd: S, from: &[f64], at: usize) -> Self {
        Self { simd, value: S::as_simd_f64s(&from[at..at + Self::LEN]).0[0] }
    }

    /// Writes the numbers to `to` from index `at` on.
    #[inline(always)]
    pub fn store(self, to: &mut [f64], at: usize) {
        S::as_mut_simd_f64s(&mut to[at..at + Self::LEN]).0[0] = self.value;
    }

    /// A pack that begins with the numbers of the register.
    #[inline(always)]
    pub fn pack(self) -> Pack {
        let mut pack = [0.0; LANES];
        self.store(&mut pack, 0);
        pack
    }

    /// Adds the numbers to those of `to` from index `at` on.
    #[inline(always)]
    pub fn add_to(self, to: &mut [f64], at: usize) {
        (Self::load(self.simd, to, at) + self).store(to, at);
    }

    /// self × factor + term; rounded once if the processor has a fused instruction.
    #[inline(always)]
    pub fn times_plus(self, factor: Self, term: Self) -> Self {
        Self { value: self.simd.mul_add_e_f64s(self.value, factor.value, term.value), ..self }
    }

    /// Square roots.
    #[inline(always)]
    pub fn sqrt(self) -> Self {
        Self { value: self.simd.sqrt_f64s(self.value), ..self }
    }

    /// Absolute values.
    #[inline(always)]
    pub fn abs(self) -> Self {
        // `Simd::abs_f64s` calls a function that the compiler may compile apart, for narrower registers.
        let all_but_sign = self.simd.splat_f64s(f64::from_bits(i64::MAX as u64));
        Self { value: self.simd.and_f64s(all_but_sign, self.value), ..self }
    }

    /// The greater number of each pair.
    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        Self { value: self.simd.max_f64s(self.value, other.value), ..self }
    }

    /// Bitwise "or" of the numbers: 0 only where both numbers are 0.
    #[inline(always)]
    pub fn either(self, other: Self) -> Self {
        Self { value: self.simd.or_f64s(self.value, other.value), ..self }
    }

    /// Whether at least one number is not 0.
    #[inline(always)]
    pub fn any_but_zero(self) -> bool {
        let numbers = self.abs().value;
        cast_slice::<_, u64>(from_ref(&numbers)).iter().fold(0, |any, bits| any | bits) != 0
    }

    /// Whether each number of `self` is less than the number of `other`.
    #[inline(always)]
    pub fn less(self, other: Self) -> Mask<S> {
        Mask { simd: self.simd, value: self.simd.less_than_f64s(self.value, other.value) }
    }

    /// Whether each number of `self` is less than or equal to the number of `other`.
    #[inline(always)]
    pub fn at_most(self, other: Self) -> Mask<S> {
        Mask { simd: self.simd, value: self.simd.less_than_or_equal_f64s(self.value, other.value) }
    }
}

impl<S: Simd> Mask<S> {
    /// Whether at least one condition holds.
    #[inline(always)]
    pub fn any(self) -> bool {
        // `Simd::first_true_m64s` may become one branch for each number. The processor cannot predict these branches.
        bytes_of(&self.value).iter().fold(0, |any, byte| any | byte) != 0
    }

    /// Conditions that hold in both masks.
    #[inline(always)]
    pub fn and(self, other: Self) -> Self {
        Self { value: self.simd.and_m64s(self.value, other.value), ..self }
    }

    /// Conditions that hold in at least one of the two masks.
    #[inline(always)]
    pub fn or(self, other: Self) -> Self {
        Self { value: self.simd.or_m64s(self.value, other.value), ..self }
    }

    /// Conditions that hold in exactly one of the two masks.
    #[inline(always)]
    pub fn differs(self, other: Self) -> Self {
        Self { value: self.simd.xor_m64s(self.value, other.value), ..self }
    }

    /// The number of `yes` where the condition holds, the number of `no` elsewhere.
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
