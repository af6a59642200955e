//! Observations grouped by shot. A shot is one option in one file.

use std::ops::Range;

use itertools::Itertools;

use crate::plan::observations::{MeasuredFiring, Observation, Observations, ObservedPoint};
use crate::sorting::sort_by_key;

/// Observations, each with the index of its file, sorted by option, then by file.
#[derive(Clone, Debug)]
pub struct ObservedShots {
    /// The observations (`n_observations`).
    pub list: Vec<Observation>,
    /// Index of the file of each observation (`n_observations`).
    pub file: Vec<usize>,
    /// Measured firing times of each file (`n_files`).
    pub firings: Vec<Vec<MeasuredFiring>>,
}

impl ObservedShots {
    /// The observations of all files. A file with the same content as an earlier file does not count again.
    pub fn new(files: &[Observations]) -> Self {
        let of_file = |(n, file): (usize, &Observations)| {
            file.list.iter().map(move |seen| (n, *seen)).collect::<Vec<_>>()
        };
        let distinct = files.iter().enumerate().unique_by(|(_, file)| &file.checksum);
        let mut all: Vec<(usize, Observation)> = distinct.flat_map(of_file).collect();
        sort_by_key(&mut all, |(file, seen)| (seen.option, *file));
        let (file, list) = all.into_iter().unzip();
        Self { list, file, firings: files.iter().map(|file| file.firings.clone()).collect() }
    }

    /// The shots, without duplicates: shots of one option with the same firing times become one, because without scatter they are
    /// alike.
    pub fn distinct_shots(&self) -> Vec<ObservedShot> {
        let mut distinct: Vec<ObservedShot> = Vec::new();
        for shot in self.shots() {
            match distinct.last_mut() {
                Some(last) if last.option == shot.option && last.times == shot.times => {
                    last.watched.extend(shot.watched);
                }
                _ => distinct.push(shot),
            }
        }
        distinct
    }

    /// The shots: one for each option in each file.
    pub fn shots(&self) -> Vec<ObservedShot> {
        let mut shots: Vec<ObservedShot> = Vec::new();
        let mut last = None;
        for (n, &Observation { option, watched, .. }) in self.list.iter().enumerate() {
            let file = self.file[n];
            if last.replace((option, file)) != Some((option, file)) {
                let of_shot = self.firings[file].iter().filter(|firing| firing.option == option);
                let times = of_shot.map(|firing| (firing.tire, firing.time)).collect();
                shots.push(ObservedShot { option, times, watched: Vec::new(), first: n });
            }
            if let Some(shot) = shots.last_mut() {
                shot.watched.push(watched);
            }
        }
        shots
    }
}

/// One observed shot, and the points watched in it.
#[derive(Clone, Debug)]
pub struct ObservedShot {
    /// Index of the delay option.
    pub option: usize,
    /// Tires above holes with measured firing times, and these times [s].
    pub times: Vec<(usize, f64)>,
    /// Watched points, in the order of the observations.
    pub watched: Vec<ObservedPoint>,
    /// Index of the first observation of the shot.
    pub first: usize,
}

impl ObservedShot {
    /// Indices of the observations of the shot.
    pub fn observations(&self) -> Range<usize> {
        self.first..self.first + self.watched.len()
    }
}
