//! Runs many jobs of one study on all cores.

use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

use super::{NoResult, StudyControl};

/// A pool of `threads` threads, one per core if 0. The threads end once the pool is dropped and its work is done.
pub fn thread_pool(threads: usize) -> Result<rayon::ThreadPool, NoResult> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.map_err(|error| NoResult::NoThreads(error.to_string()))
}

/// Does `work` for every job, in parallel. Returns the results in the order of the jobs; `None` for jobs that ran out of time. The
/// number of threads does not change the results.
pub fn run_batch<J: Sync, T: Send>(
    jobs: &[J],
    control: &StudyControl,
    work: impl Fn(&J) -> Result<T, NoResult> + Sync,
) -> Result<Vec<Option<T>>, NoResult> {
    control.announce(jobs.len());
    run_announced_batch(jobs, control, work)
}

/// Like [`run_batch`], for jobs that were already announced by [`StudyControl::announce`].
pub fn run_announced_batch<J: Sync, T: Send>(
    jobs: &[J],
    control: &StudyControl,
    work: impl Fn(&J) -> Result<T, NoResult> + Sync,
) -> Result<Vec<Option<T>>, NoResult> {
    let run_job = |job: &J| {
        if control.stopped() {
            return Err(NoResult::Stopped);
        }
        if control.expired() {
            return Ok(None);
        }
        match work(job) {
            Err(NoResult::OutOfTime) => Ok(None),
            result => {
                control.advance();
                result.map(Some)
            }
        }
    };
    let _batch = control.batch();
    let not_run: Vec<Result<Option<T>, NoResult>> = jobs.iter().map(|_| Ok(None)).collect();
    let results = Mutex::new(not_run);
    for_each_number(jobs.len(), &|n| {
        let result = run_job(&jobs[n]);
        results.lock().unwrap_or_else(PoisonError::into_inner)[n] = result;
    });
    results.into_inner().unwrap_or_else(PoisonError::into_inner).into_iter().collect()
}

/// Does `work` for every number below `count`, in parallel. This code is compiled once, not for each kind of work.
fn for_each_number(count: usize, work: &(dyn Fn(usize) + Sync)) {
    (0..count).into_par_iter().for_each(work);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::work::catch_panic;

    #[test]
    fn a_job_that_ends_as_the_time_is_up_keeps_its_result() {
        let control = StudyControl::default();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("one thread");
        let work = |&job: &i32| {
            control.expire();
            Ok(job)
        };
        assert_eq!(pool.install(|| run_batch(&[1, 2], &control, work)), Ok(vec![Some(1), None]));
    }

    #[test]
    fn a_panic_is_told_and_the_others_go_on() {
        let jobs = [1, 2, 3];
        let work = |&job: &i32| Ok(catch_panic(|| if job == 2 { panic!("job {job}") } else { Ok(10 * job) }));
        let results = run_batch(&jobs, &StudyControl::default(), work).expect("nobody stopped it");
        assert_eq!(results, [Some(Ok(10)), Some(Err(NoResult::Panicked("job 2".to_owned()))), Some(Ok(30))]);
    }
}
