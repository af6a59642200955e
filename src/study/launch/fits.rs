//! Earlier shots of a site by charge and stemming, each group fitted by itself: what they tell of the next launch.

use itertools::Itertools;

use super::EarlierShots;
use super::of_plan::fastest_launch;
use crate::choice::Unknown;
use crate::plan::observations::{Observations, ShotHead};
use crate::study::fit::{Fit, FitResult, fit};
use crate::study::{Case, Context, NoResult};

/// Shots with the same charge and stemming, and what a fit of them found.
#[derive(Clone, Debug)]
pub struct FittedShots {
    /// Their files.
    pub files: Vec<Observations>,
    /// The result of the fit.
    pub found: FitResult,
}

impl FittedShots {
    /// The files in one word.
    pub fn name(&self) -> String {
        self.files.iter().map(|file| file.path.as_str()).join(", ")
    }

    /// The fit, where it tells one launch: it has settled, and explains what was seen.
    pub fn fit(&self) -> Option<&Fit> {
        let FitResult::Fitted(fit) = &self.found else { return None };
        let best = &fit.answers[0];
        let is_one = fit.answers.len() == 1 && !best.estimates.iter().any(|estimate| estimate.is_at_end);
        (is_one && best.is_settled && best.explains()).then_some(fit)
    }

    /// What the fit tells of the launch; `None` where it tells none.
    pub fn earlier_shots(&self, case: &Case) -> Option<EarlierShots> {
        let fit = self.fit()?;
        let ShotHead { charge_kg, stemming_m, .. } = self.files[0].head;
        Some(EarlierShots {
            name: self.name(),
            speed: fastest_launch(&case.plan) * fit.answers[0].estimates[0].value,
            percent: fit.launches?.common_percent,
            charge_kg,
            stemming_m,
        })
    }
}

/// Fits the shots of files, those of one charge and stemming together.
pub fn fit_by_charge(context: &Context<'_>, files: &[Observations]) -> Result<Vec<FittedShots>, NoResult> {
    let alike = |file: &Observations| {
        [file.head.charge_kg, file.head.stemming_m].map(|number| number.map(f64::to_bits))
    };
    let groups = files.iter().cloned().into_group_map_by(alike);
    let groups: Vec<Vec<Observations>> =
        groups.into_iter().sorted_by_key(|(key, _)| *key).map(|(_, files)| files).collect();
    let count = groups.len();
    let mut all = Vec::with_capacity(count);
    for (n, files) in groups.into_iter().enumerate() {
        let _one = context.control.part(1.0 / (count - n) as f64);
        let found = fit(context, &files, &[Unknown::Launch])?;
        all.push(FittedShots { files, found });
    }
    Ok(all)
}
