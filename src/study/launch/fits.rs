//! Earlier shots of a site, grouped by charge and stemming. Each group is fitted by itself and gives an estimate of the next launch.

use itertools::Itertools;

use super::of_plan::fastest_launch;
use super::{Blast, EarlierShots, LaunchEstimate};
use crate::choice::Unknown;
use crate::plan::edit::with_launches;
use crate::plan::observations::{Observations, ShotHead};
use crate::plan::{PlanSource, Uncertainty};
use crate::sorting::sorted_by_key;
use crate::study::fit::{Fit, FitResult, fit};
use crate::study::{Case, Context, NoResult};

/// Shots with the same charge and stemming, with the result of their fit.
#[derive(Clone, Debug)]
pub struct FittedShots {
    /// Files of these shots.
    pub files: Vec<Observations>,
    /// Factor that scales the launches of the plan to the charge and stemming of these shots.
    scaled: f64,
    /// The result of the fit.
    pub found: FitResult,
}

impl FittedShots {
    /// Names of the files in one text.
    pub fn name(&self) -> String {
        self.files.iter().map(|file| file.path.as_str()).join(", ")
    }

    /// The fit, if it gives one launch.
    pub fn fit(&self) -> Option<&Fit> {
        let FitResult::Fitted(fit) = &self.found else { return None };
        fit.why_no_answer().is_none().then_some(fit)
    }

    /// The launch velocity of the fit; `None` if the fit gives none.
    pub fn earlier_shots(&self, case: &Case) -> Option<EarlierShots> {
        let fit = self.fit()?;
        let ShotHead { charge_kg, stemming_m, .. } = self.files[0].head;
        Some(EarlierShots {
            name: self.name(),
            speed: fastest_launch(&case.plan) * self.scaled * fit.answers[0].estimates[0].value,
            percent: fit.launches?.common_percent,
            charge_kg,
            stemming_m,
        })
    }
}

/// The plan with the charge and stemming of a shot, as far as both state them, and the factor on its launches. The launches are scaled by
/// that factor and known less well.
fn with_blast_of(case: &Case, head: &ShotHead) -> (Case, f64) {
    let (own, speed) = (Blast::of_plan(&case.plan), fastest_launch(&case.plan));
    let of_plan = EarlierShots {
        speed,
        percent: case.plan.uncertainty.launch_common_percent,
        charge_kg: own.charge_kg,
        stemming_m: own.stemming_m,
        ..EarlierShots::default()
    };
    let then = Blast { charge_kg: head.charge_kg, stemming_m: head.stemming_m, ..Blast::default() };
    let LaunchEstimate { band: [_, scaled, _], common_percent, .. } = of_plan.estimate(&then);
    let factor = scaled / speed;
    let text = with_launches(&case.source.text, factor).unwrap_or_default();
    match Case::parse(PlanSource { text, ..case.source.clone() }) {
        Ok(scaled) if factor != 1.0 => {
            let known = Uncertainty { launch_common_percent: common_percent, ..case.plan.uncertainty };
            (scaled.with_uncertainty(known), factor)
        }
        Ok(_) | Err(_) => (case.clone(), 1.0),
    }
}

/// Fits the shots of files, all files of one charge and stemming together.
pub fn fit_by_charge(context: &Context<'_>, files: &[Observations]) -> Result<Vec<FittedShots>, NoResult> {
    let alike = |file: &Observations| {
        [file.head.charge_kg, file.head.stemming_m].map(|number| number.map(f64::to_bits))
    };
    let groups = files.iter().cloned().into_group_map_by(alike);
    let groups: Vec<Vec<Observations>> =
        sorted_by_key(groups, |(key, _)| *key).into_iter().map(|(_, files)| files).collect();
    let count = groups.len();
    let mut all = Vec::with_capacity(count);
    for (n, files) in groups.into_iter().enumerate() {
        let _one = context.control.part(1.0 / (count - n) as f64);
        let (case, scaled) = with_blast_of(context.case, &files[0].head);
        let found = fit(&context.with_case(&case), &files, &[Unknown::Launch])?;
        all.push(FittedShots { files, scaled, found });
    }
    Ok(all)
}
