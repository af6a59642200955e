//! Bands of height and force in which nine of ten sampled shots lie at each time. They are for charts, apart from every verdict.

use super::judge::deciding_shot::DecidingShot;
use super::samples::sampled_shot::{SAMPLES_FOR_BANDS, SampledShot};
use super::trace::DrawnSample;
use super::work::batch::run_batch;
use super::{Context, NoResult, catch_panic};
use crate::outcome::History;

/// Number of stretches of time in a band: the columns of a wide chart.
const STRETCHES: usize = 160;
/// Shares of the shots below the two ends of a band.
const ENDS: [f64; 2] = [0.05, 0.95];

/// The 5th and the 95th percentile of the courses of sampled shots, in even stretches of time.
#[derive(Clone, Debug, PartialEq)]
pub struct CourseBand {
    /// Width of a stretch [s].
    pub width: f64,
    /// Percentiles of the greatest height in each stretch [m] (`n_stretches`).
    pub height: [Vec<f64>; 2],
    /// Percentiles of the greatest cable force in each stretch [N] (`n_stretches`).
    pub force: [Vec<f64>; 2],
}

impl CourseBand {
    /// Runs the first samples of an option again, drawn with `seed`. `None` if too few samples were drawn, or too few have a course.
    ///
    /// # Panics
    ///
    /// If the plan has no delay option with the index `option`.
    pub fn find(
        context: &Context<'_>,
        option: usize,
        sampled: &SampledShot,
        seed: u64,
    ) -> Result<Option<Self>, NoResult> {
        if sampled.samples.len() < SAMPLES_FOR_BANDS {
            return Ok(None);
        }
        let numbers: Vec<usize> = (0..SAMPLES_FOR_BANDS).collect();
        let runs = run_batch(&numbers, context.control, |&number| {
            let sample = DrawnSample { seed, number, step_halvings: sampled.step_halvings };
            match catch_panic(|| DecidingShot::run(context, option, sample)) {
                Err(NoResult::Failed(_) | NoResult::Panicked(_)) => Ok(None),
                run => run.map(|run| Some(run.history)),
            }
        })?;
        let courses: Vec<History> = runs.into_iter().flatten().flatten().collect();
        Ok((2 * courses.len() > SAMPLES_FOR_BANDS).then(|| Self::of(&courses)))
    }

    /// The band of some courses. After the end of its run, a shot counts as 0.
    fn of(courses: &[History]) -> Self {
        let end = |course: &History| course.width * course.height.len() as f64;
        let width = courses.iter().map(end).fold(0.0, f64::max) / STRETCHES as f64;
        let percentiles = |values: fn(&History) -> &[f64]| {
            let greatest = |course: &History, n: usize| {
                let [from, to] = [n, n + 1].map(|edge| edge as f64 * width / course.width);
                // Times that differ only by rounding belong to one bucket.
                let buckets = (from + 1e-9).floor() as usize..(to - 1e-9).ceil().max(0.0) as usize;
                let of_course = values(course).iter().skip(buckets.start).take(buckets.len().max(1));
                of_course.copied().fold(0.0, f64::max)
            };
            let mut ends = [Vec::with_capacity(STRETCHES), Vec::with_capacity(STRETCHES)];
            for n in 0..STRETCHES {
                let mut all: Vec<f64> = courses.iter().map(|course| greatest(course, n)).collect();
                all.sort_by(f64::total_cmp);
                for (share, end) in ENDS.into_iter().zip(&mut ends) {
                    let rank = (share * (all.len() - 1) as f64).round() as usize;
                    end.push(all[rank]);
                }
            }
            ends
        };
        Self {
            width,
            height: percentiles(|course| &course.height),
            force: percentiles(|course| &course.force),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 101 courses are as high as their numbers in their first half. Five lie below the band, and five above it.
    #[test]
    fn nine_of_ten_courses_lie_between_the_ends() {
        let course = |n: usize| History {
            width: 0.01,
            height: (0..100).map(|at| if at < 50 { n as f64 } else { 0.0 }).collect(),
            force: vec![1.0; if n < 60 { 100 } else { 50 }],
        };
        let courses: Vec<History> = (0..101).map(course).collect();
        let band = CourseBand::of(&courses);
        assert!((band.width * STRETCHES as f64 - 1.0).abs() < 1e-12);
        let (first, last) = (STRETCHES / 4, 3 * STRETCHES / 4);
        assert_eq!(band.height.each_ref().map(|end| [end[first], end[last]]), [[5.0, 0.0], [95.0, 0.0]]);
        assert_eq!(band.force.each_ref().map(|end| [end[first], end[last]]), [[1.0, 0.0], [1.0, 1.0]]);
    }
}
