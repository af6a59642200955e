//! All minima of a sum of squares over a box. Starts lie across the box; damped Gauss–Newton steps refine the lowest of them.
//!
//! The crate `levenberg-marquardt` (0.15) does not serve here. It depends on nalgebra 0.34, a second copy beside the 0.35 of this
//! crate. It also needs smooth functions with exact derivatives. The height of a tire over its launch velocity is not smooth: it
//! has kinks where a cable catches, and steps where a tire is launched anew. So the derivatives here are central differences over
//! about half a standard deviation of the estimate, and never over less than a thousandth of the range. Smaller roughness does not
//! count.
//!
//! One refinement, with residuals r, their derivatives J, and a damping λ (Marquardt 1963):
//! 1. Solve (JᵀJ + λ diag JᵀJ) d = −Jᵀr for the step d, without the coordinates that press against an end of their range.
//! 2. If the sum of squares falls at the next point, go there and lower λ. Else raise λ and try again. If all tries fail, narrow
//!    the differences.
//! 3. End when the sum of squares falls no more and the differences are at their narrowest.

use nalgebra::{DMatrix, DVector};

use crate::sorting::sort_by;
use crate::study::work::batch::run_batch;
use crate::study::{NoResult, StudyControl};

/// The residuals at given coordinates; `None` if a run fails. Their number is the same everywhere.
pub type Residuals<'f> = dyn Fn(&[f64]) -> Result<Option<DVector<f64>>, NoResult> + Sync + 'f;

/// The box to search.
#[derive(Clone, Debug)]
pub struct SearchBox {
    /// Ends of each coordinate (`n_parameters`).
    pub ranges: Vec<[f64; 2]>,
    /// The part of each range that should hold the minimum. Half of the starts lie there.
    pub expected: Vec<[f64; 2]>,
}

/// A minimum of the sum of squares.
#[derive(Clone, Debug)]
pub struct Minimum {
    /// Coordinates of the minimum.
    pub point: Vec<f64>,
    /// Sum of squares at the minimum.
    pub misfit: f64,
    /// Inverse of JᵀJ: the covariance of the coordinates.
    pub covariance: DMatrix<f64>,
}

impl Minimum {
    /// Standard deviation of a coordinate.
    pub fn sd(&self, n: usize) -> f64 {
        self.covariance[(n, n)].max(0.0).sqrt()
    }

    /// Whether two minima are the same answer: no coordinate differs by more than two standard deviations.
    pub fn is_same(&self, other: &Self) -> bool {
        let near = |n: usize| (self.point[n] - other.point[n]).abs() <= 2.0 * self.sd(n).max(other.sd(n));
        (0..self.point.len()).all(near)
    }
}

/// Greatest number of starts that are refined.
const MOST_REFINED: usize = 10;
/// Share of the progress of a search that the starts take.
const SHARE_OF_STARTS: f64 = 0.3;
/// Greatest number of steps of a refinement.
const MOST_STEPS: usize = 20;
/// Least and greatest reach of a difference to each side, as a share of the range.
const DIFFERENCE: [f64; 2] = [1e-3, 2e-2];
/// Standard deviation of a coordinate without any effect, over its range.
const UNKNOWN: f64 = 10.0;
/// A fall of the sum of squares up to this counts as none.
const NO_FALL: f64 = 1e-3;

impl SearchBox {
    /// Width of a range.
    fn width(&self, n: usize) -> f64 {
        self.ranges[n][1] - self.ranges[n][0]
    }

    /// The point of the box that is nearest to `point`.
    pub fn clamped(&self, point: &[f64]) -> Vec<f64> {
        point.iter().zip(&self.ranges).map(|(value, [low, high])| value.clamp(*low, *high)).collect()
    }

    /// Starts: `own`, then points spread evenly over the box and over the part that should hold the minimum.
    fn starts(&self, own: &[f64]) -> Vec<Vec<f64>> {
        let dimensions = self.ranges.len();
        let count = [97, 160, 320, 480][(dimensions - 1).min(3)];
        let inside = |ends: &[[f64; 2]], shares: &dyn Fn(usize) -> f64| -> Vec<f64> {
            ends.iter().enumerate().map(|(n, [low, high])| low + (high - low) * shares(n)).collect()
        };
        let share = |start: usize, n: usize| match dimensions {
            1 => start as f64 / (count - 1) as f64,
            _ => van_der_corput(start + 1, PRIMES[n % PRIMES.len()]),
        };
        let over = |ends| (0..count).map(move |start| inside(ends, &|n| share(start, n)));
        let mut starts = vec![self.clamped(own)];
        starts.extend(over(&self.ranges));
        if self.expected != self.ranges {
            starts.extend(over(&self.expected));
        }
        starts
    }

    /// All minima that may have the least sum of squares, sorted from the least.
    pub fn minima(
        &self,
        own: &[f64],
        residuals: &Residuals<'_>,
        control: &StudyControl,
    ) -> Result<Vec<Minimum>, NoResult> {
        let starts = self.starts(own);
        let starting = control.part(SHARE_OF_STARTS);
        let misfits = run_batch(&starts, control, |start| Ok(residuals(start)?.map(|r| r.norm_squared())))?;
        let misfits: Option<Vec<f64>> =
            misfits.into_iter().map(|misfit| misfit.map(|known| known.unwrap_or(f64::INFINITY))).collect();
        drop(starting);
        let Some(misfits) = misfits else { return Err(NoResult::OutOfTime) };
        let mut chosen: Vec<usize> =
            (0..starts.len()).filter(|&n| self.is_lowest_near(n, &starts, &misfits)).collect();
        sort_by(&mut chosen, |&a, &b| misfits[a].total_cmp(&misfits[b]));
        chosen.truncate(MOST_REFINED);
        let chosen: Vec<Vec<f64>> = chosen.into_iter().map(|n| starts[n].clone()).collect();
        let _refining = control.part(1.0);
        let refined = run_batch(&chosen, control, |start| self.refine(start, residuals))?;
        let refined: Option<Vec<Option<Minimum>>> = refined.into_iter().collect();
        let mut minima: Vec<Minimum> = refined.ok_or(NoResult::OutOfTime)?.into_iter().flatten().collect();
        sort_by(&mut minima, |a, b| a.misfit.total_cmp(&b.misfit));
        Ok(distinct(minima))
    }

    /// Whether no start near this one has a smaller sum of squares.
    fn is_lowest_near(&self, n: usize, starts: &[Vec<f64>], misfits: &[f64]) -> bool {
        if !misfits[n].is_finite() {
            return false;
        }
        let distance = |other: usize| -> f64 {
            let apart = |i: usize| ((starts[n][i] - starts[other][i]) / self.width(i)).powi(2);
            (0..self.ranges.len()).map(apart).sum()
        };
        let mut neighbours: Vec<usize> = (0..starts.len()).filter(|&other| distance(other) > 1e-12).collect();
        sort_by(&mut neighbours, |&a, &b| distance(a).total_cmp(&distance(b)));
        neighbours.iter().take(2 * self.ranges.len()).all(|&other| misfits[n] <= misfits[other])
    }

    /// The minimum that a start leads to; `None` if the run at the start fails.
    pub fn refine(&self, start: &[f64], residuals: &Residuals<'_>) -> Result<Option<Minimum>, NoResult> {
        let mut point = self.clamped(start);
        let Some(mut r) = residuals(&point)? else { return Ok(None) };
        let count = point.len();
        let mut difference: Vec<f64> = (0..count).map(|n| 0.5 * DIFFERENCE[1] * self.width(n)).collect();
        // Damping of Levenberg and Marquardt. Its first value and its factors cost steps, but change no answer.
        let mut damping = 1e-3;
        for _ in 0..MOST_STEPS {
            let slopes = self.slopes(&point, &r, &difference, residuals)?;
            let mut fall = 0.0;
            for _ in 0..6 {
                let next = self.clamped(&self.step(&point, &r, &slopes, damping));
                if let Some(lower) = residuals(&next)?.filter(|lower| lower.norm_squared() < r.norm_squared())
                {
                    fall = r.norm_squared() - lower.norm_squared();
                    (point, r) = (next, lower);
                    damping = (0.2 * damping).max(1e-9);
                    break;
                }
                damping *= 8.0;
            }
            let narrowest = (0..count).all(|n| difference[n] <= 1.01 * DIFFERENCE[0] * self.width(n));
            if fall <= NO_FALL && narrowest {
                break;
            }
            let covariance = self.covariance(&slopes);
            for n in 0..count {
                let [least, most] = DIFFERENCE.map(|share| share * self.width(n));
                let wanted = 0.5 * covariance[(n, n)].max(0.0).sqrt();
                difference[n] = if fall > NO_FALL { wanted } else { 0.25 * difference[n] }.clamp(least, most);
            }
        }
        let covariance = self.final_covariance(&point, &r, residuals)?;
        Ok(Some(Minimum { misfit: r.norm_squared(), point, covariance }))
    }

    /// The covariance of the coordinates, from differences of about one standard deviation to each side.
    fn final_covariance(
        &self,
        point: &[f64],
        r: &DVector<f64>,
        residuals: &Residuals<'_>,
    ) -> Result<DMatrix<f64>, NoResult> {
        let mut difference: Vec<f64> = (0..point.len()).map(|n| DIFFERENCE[1] * self.width(n)).collect();
        let mut found = DMatrix::zeros(0, 0);
        for _ in 0..2 {
            found = self.covariance(&self.slopes(point, r, &difference, residuals)?);
            for n in 0..point.len() {
                let width = self.width(n);
                difference[n] = found[(n, n)].max(0.0).sqrt().clamp(DIFFERENCE[0] * width, 0.1 * width);
            }
        }
        Ok(found)
    }

    /// Derivatives of the residuals by central differences (`n_residuals` × `n_parameters`).
    pub fn slopes(
        &self,
        point: &[f64],
        r: &DVector<f64>,
        difference: &[f64],
        residuals: &Residuals<'_>,
    ) -> Result<DMatrix<f64>, NoResult> {
        let mut slopes = DMatrix::zeros(r.len(), point.len());
        for n in 0..point.len() {
            let beside = |side: f64| {
                let mut beside = point.to_vec();
                beside[n] = (point[n] + side * difference[n]).clamp(self.ranges[n][0], self.ranges[n][1]);
                beside
            };
            // If the run on one side fails, the middle replaces that side.
            let end = |side: f64| -> Result<(f64, DVector<f64>), NoResult> {
                let place = beside(side);
                Ok(residuals(&place)?.map_or_else(|| (point[n], r.clone()), |there| (place[n], there)))
            };
            let ((more, above), (less, below)) = (end(1.0)?, end(-1.0)?);
            if more > less {
                slopes.set_column(n, &((above - below) / (more - less)));
            }
        }
        Ok(slopes)
    }

    /// Inverse of JᵀJ. A coordinate without effect on the residuals gets a standard deviation of [`UNKNOWN`] times its range.
    fn covariance(&self, slopes: &DMatrix<f64>) -> DMatrix<f64> {
        self.inverse(slopes.transpose() * slopes)
    }

    /// Inverse of a precision matrix of the coordinates. A coordinate with no information is treated in the same way.
    pub fn inverse(&self, mut normal: DMatrix<f64>) -> DMatrix<f64> {
        for n in 0..self.ranges.len() {
            normal[(n, n)] += (UNKNOWN * self.width(n)).powi(-2);
        }
        let nothing_known = || {
            let variance = |n: usize| (UNKNOWN * self.width(n)).powi(2);
            DMatrix::from_diagonal(&DVector::from_fn(self.ranges.len(), |n, _| variance(n)))
        };
        normal.cholesky().map_or_else(nothing_known, |factor| factor.inverse())
    }

    /// The point after one damped step.
    fn step(&self, point: &[f64], r: &DVector<f64>, slopes: &DMatrix<f64>, damping: f64) -> Vec<f64> {
        let gradient = slopes.transpose() * r;
        let mut normal = slopes.transpose() * slopes;
        let pressed = |n: usize| {
            let [low, high] = self.ranges[n];
            point[n] <= low && gradient[n] > 0.0 || point[n] >= high && gradient[n] < 0.0
        };
        for n in 0..point.len() {
            // A coordinate without any effect stays where it is.
            normal[(n, n)] += damping * normal[(n, n)] + 1e-12 / self.width(n).powi(2);
        }
        let free: Vec<usize> = (0..point.len()).filter(|&n| !pressed(n)).collect();
        let normal = normal.select_rows(&free).select_columns(&free);
        let mut next = point.to_vec();
        if let Some(step) = normal.cholesky().map(|factor| factor.solve(&gradient.select_rows(&free))) {
            free.iter().zip(step.iter()).for_each(|(&n, step)| next[n] -= step);
        }
        next
    }
}

/// The minima without duplicates.
fn distinct(minima: Vec<Minimum>) -> Vec<Minimum> {
    minima.into_iter().fold(Vec::new(), |mut all: Vec<Minimum>, minimum| {
        if !all.iter().any(|known| known.is_same(&minimum)) {
            all.push(minimum);
        }
        all
    })
}

const PRIMES: [usize; 8] = [2, 3, 5, 7, 11, 13, 17, 19];

/// Member `n` of the sequence of van der Corput, evenly spread over 0 to 1. With one base per coordinate the points fill a box
/// (Halton 1960).
fn van_der_corput(mut n: usize, base: usize) -> f64 {
    let (mut share, mut digit) = (0.0, 1.0 / base as f64);
    while n > 0 {
        share += digit * (n % base) as f64;
        n /= base;
        digit /= base as f64;
    }
    share
}
