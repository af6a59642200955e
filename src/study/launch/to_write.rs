//! The part of an estimate that goes into a plan. A less sure value is never written as surer.

use super::of_plan::{fastest_launch, slowest_launch};
use super::{Blast, FittedShots, Kind, LaunchEstimate};
use crate::plan::assumed::assumed_values;
use crate::plan::fitted_blast;
use crate::plan::keys::{blast_row, uncertainty};
use crate::plan::observations::Observations;
use crate::plan::write_fit::{LaunchUncertainty, StatedKeys};
use crate::plan::write_launch::LaunchToWrite;
use crate::study::Case;
use crate::study::fit::between_shots::BetweenShots;

/// Why an estimate does not go into a plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotWritten {
    /// The plan was fitted to observations, which is surer.
    PlanIsFitted,
    /// The plan says that its launch was observed. That is surer than a formula that nobody chose by name.
    PlanIsSurer,
    /// The plan already holds the estimate.
    PlanHoldsIt,
    /// The plan holds a faster observed launch. Of several test tires the fastest counts, so a mistake with one tire slows down no shot.
    PlanIsFaster,
    /// The plan tilts launches or pushes over a time. The rise of a tire shows only part of such a launch.
    PlanTiltsOrPushes,
    /// The estimate is out of the range for which it was made.
    OutOfRange,
}

/// Share of a launch velocity above which two readings count as equal.
const SAME: f64 = 0.99;

/// Whether a key holds the launch velocity of a plan, or how well that is known.
fn tells_launch(key: &str) -> bool {
    [blast_row::LAUNCH_M_S.name, uncertainty::LAUNCH_COMMON_PERCENT.name].contains(&key)
}

impl LaunchEstimate {
    /// The values that go into the plan of `case`. `fits` are those of earlier shots. `source` says where the estimate is from, and
    /// `is_named` whether somebody chose it by name.
    pub fn to_write(
        &self,
        case: &Case,
        fits: &[FittedShots],
        source: String,
        is_named: bool,
    ) -> Result<LaunchToWrite, NotWritten> {
        let of_plan = &case.plan.uncertainty;
        let stated = StatedKeys::of(&case.source.text);
        // Nobody states the hole under the loose tire. If it was the slowest hole, all others launch faster.
        let own = match self.kind {
            Kind::TestTire => slowest_launch(&case.plan),
            _ => fastest_launch(&case.plan),
        };
        let factor = self.band[1] / own;
        if !self.is_valid() {
            return Err(NotWritten::OutOfRange);
        }
        if self.kind == Kind::EarlierShots {
            let shots = fits.iter().find(|shots| shots.name() == self.name).ok_or(NotWritten::PlanHoldsIt)?;
            let launches = shots.fit().and_then(|fit| fit.launches).ok_or(NotWritten::PlanHoldsIt)?;
            let known = LaunchUncertainty { common_percent: self.common_percent, ..launches };
            // The estimate is scaled to the charge and stemming of the plan. If only the files state them, the estimate is for the blast of
            // the files, and the plan must keep that.
            let own = Blast::of_plan(&case.plan);
            let told = |file: &Observations| {
                let file_alone = |own: Option<f64>, told: Option<f64>| told.filter(|_| own.is_none());
                let charge = file_alone(own.charge_kg, file.head.charge_kg);
                fitted_blast::seen(charge, file_alone(own.stemming_m, file.head.stemming_m))
            };
            let kept = |file: &Observations| file.kept_in_plan().chain(told(file)).collect::<Vec<_>>();
            let checksums = shots.files.iter().flat_map(kept).collect();
            return Ok(LaunchToWrite { factor, known, source, checksums });
        }
        if !case.plan.fitted_from.is_empty() {
            return Err(NotWritten::PlanIsFitted);
        }
        let is_surer = stated.launch_common && !of_plan.launch_is_estimated();
        if !self.kind.is_observed() && is_surer && !is_named {
            return Err(NotWritten::PlanIsSurer);
        }
        let mut assumed = assumed_values(&case.source.text);
        let is_assumed = assumed.any(|value| value.key().is_some_and(tells_launch));
        if self.kind == Kind::TestTire && is_surer && factor < SAME && !is_assumed {
            return Err(NotWritten::PlanIsFaster);
        }
        if self.kind == Kind::TestTire
            && case.plan.launches().any(|launch| launch.push_ms > 0.0 || launch.tilt_deg > 0.0)
        {
            return Err(NotWritten::PlanTiltsOrPushes);
        }
        // A bound makes the launch no surer than the plan says. An observation does.
        let before = if stated.launch_common { of_plan.launch_common_percent } else { 0.0 };
        let common_percent =
            if self.kind.is_observed() { self.common_percent } else { self.common_percent.max(before) };
        // No estimate says how far the next shot differs.
        let between_shots_percent = BetweenShots::before(of_plan, &stated, 0).percent;
        let known = LaunchUncertainty { common_percent, between_shots_percent };
        Ok(LaunchToWrite { factor, known, source, checksums: Vec::new() })
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Blast, LaunchEstimates, Seen, TestTire};
    use super::*;
    use crate::plan::PlanSource;

    fn case(more: &str) -> Case {
        let text = include_str!("../../../tests/fixtures/amur-three-rows.toml");
        let text = text.replace("launch_common_percent = 3 ", &format!("{more} "));
        let source = PlanSource { path: "plan.toml".into(), text };
        Case::parse(source).unwrap_or_else(|mistakes| panic!("{mistakes}"))
    }

    /// A loose tire lay over an unknown hole, and the rows differ. The slowest hole counts, so no row is written slower than it may be.
    #[test]
    fn a_test_tire_never_slows_a_row_down_for_another() {
        let text = include_str!("../../../tests/fixtures/amur-three-rows.toml");
        let text = text.replacen("launch_m_s = 6.0", "launch_m_s = 9.0", 1);
        let case = Case::parse(PlanSource { path: "plan.toml".into(), text })
            .unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let tire = TestTire { seen: Seen::Height { height: 36.0 / (2.0 * 9.81), sd: 0.1 }, gravity: 9.81 };
        let written = tire.estimate().to_write(&case, &[], String::new(), true);
        assert!(written.is_ok_and(|written| (written.factor - 1.0).abs() < 1e-9));
        for more in ["push_ms = 30", "tilt_deg = 10"] {
            let text = case.source.text.replacen("launch_m_s = 9.0", &format!("launch_m_s = 9.0\n{more}"), 1);
            let case = Case::parse(PlanSource { path: "plan.toml".into(), text })
                .unwrap_or_else(|mistakes| panic!("{mistakes}"));
            let refused = tire.estimate().to_write(&case, &[], String::new(), true);
            assert_eq!(refused, Err(NotWritten::PlanTiltsOrPushes), "as `free_flight_height_m` beside it");
        }
        let blast = Blast { specific_charge_kg_m3: Some(0.25), ..Blast::default() };
        let bounds = LaunchEstimates::new(&blast, None, &[]);
        let bound = bounds.chosen().expect("an estimate");
        let written = bound.to_write(&case, &[], String::new(), true);
        assert!(written.is_ok_and(|written| (written.factor * 9.0 - bound.band[1]).abs() < 1e-9));
    }

    /// A bound is written with 50 %, or with the plan's percentage if that is greater. A test tire is written with 10 %, or with the error
    /// of its reading. Neither replaces a fit.
    #[test]
    fn nothing_less_sure_is_written_as_surer() {
        let blast = Blast { specific_charge_kg_m3: Some(0.25), ..Blast::default() };
        let percent = |case: &Case, estimate: &LaunchEstimate| {
            estimate.to_write(case, &[], String::new(), true).map(|written| written.known.common_percent)
        };
        let bounds = LaunchEstimates::new(&blast, None, &[]);
        let bound = bounds.chosen().expect("an estimate");
        let surest = case("launch_common_percent = 3");
        assert_eq!(percent(&surest, bound), Ok(50.0), "named");
        let unnamed = |case: &Case| bound.to_write(case, &[], String::new(), false).map(|_| ());
        assert_eq!(unnamed(&surest), Err(NotWritten::PlanIsSurer));
        assert_eq!(unnamed(&case("launch_common_percent = 50")), Ok(()));
        assert_eq!(percent(&case("launch_common_percent = 80"), bound), Ok(80.0));
        for (sd, expected) in [(0.01, 10.0), (0.8, 20.0)] {
            let tire = TestTire { seen: Seen::Height { height: 2.0, sd }, gravity: 9.81 }.estimate();
            assert!(
                percent(&case("launch_common_percent = 80"), &tire)
                    .is_ok_and(|p| (p - expected).abs() < 1e-9)
            );
        }
        let fitted = case("fitted_from = [\"ab12\"]\nlaunch_common_percent = 2");
        assert_eq!(percent(&fitted, bound), Err(NotWritten::PlanIsFitted));
        let far = Blast { specific_charge_kg_m3: Some(3.0), ..Blast::default() };
        let far = LaunchEstimates::new(&far, None, &[]);
        assert_eq!(percent(&surest, &far.all[0]), Err(NotWritten::OutOfRange));
        let written = bound.to_write(&surest, &[], String::new(), true).expect("a bound");
        // √(2 · 0.1 · 3.8e6 · 0.25 / 2600) = 8.55 m/s in place of 6.
        assert!((written.factor * 6.0 - 8.548).abs() < 0.001, "{}", written.factor);
    }
}
