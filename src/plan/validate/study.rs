//! Reads what is not known of the shot, and the choices of `shelter size`.

use crate::choice::Detonator;
use crate::plan::keys::{Key, size, uncertainty};
use crate::plan::read::SectionReader;
use crate::plan::{DelayScatter, SizeSpec, Uncertainty};
use crate::ropes::catalogue;

/// Reads `[uncertainty]` of a plan with this friction and slack [%]; `assumed`: the plan has no such section.
pub fn read_uncertainty(
    section: SectionReader<'_>,
    assumed: bool,
    friction: f64,
    slack_percent: f64,
) -> Uncertainty {
    let uncertainty = Uncertainty {
        assumed,
        incomplete: OF_INPUTS.iter().any(|key| !section.has(key)),
        delay: read_delay_scatter(&section),
        in_hole_delay_ms: section.number(&uncertainty::IN_HOLE_DELAY_MS),
        launch_cv_percent: section.number(&uncertainty::LAUNCH_CV_PERCENT),
        launch_common_percent: section.number(&uncertainty::LAUNCH_COMMON_PERCENT),
        launch_tilt_deg: section.number(&uncertainty::LAUNCH_TILT_DEG),
        friction: section
            .range(&uncertainty::FRICTION, friction)
            .unwrap_or_else(|| Uncertainty::usual_friction(friction)),
        slack_percent: section
            .range(&uncertainty::SLACK_PERCENT, slack_percent)
            .unwrap_or_else(|| Uncertainty::usual_slack(slack_percent)),
        axial_stiffness_percent: section
            .range(&uncertainty::AXIAL_STIFFNESS_PERCENT, 0.0)
            .unwrap_or(Uncertainty::USUAL_AXIAL_STIFFNESS),
        tire_mass_cv_percent: section.number(&uncertainty::TIRE_MASS_CV_PERCENT),
        breaking_force_cv_percent: section.number(&uncertainty::BREAKING_FORCE_CV_PERCENT),
    };
    section.finish();
    uncertainty
}

/// Keys whose default is an input known to 1 %.
const OF_INPUTS: [&Key; 6] = [
    &uncertainty::LAUNCH_CV_PERCENT,
    &uncertainty::LAUNCH_COMMON_PERCENT,
    &uncertainty::FRICTION,
    &uncertainty::SLACK_PERCENT,
    &uncertainty::AXIAL_STIFFNESS_PERCENT,
    &uncertainty::TIRE_MASS_CV_PERCENT,
];

/// Scatter of firing times: of the detonator, or as the plan gives it.
fn read_delay_scatter(section: &SectionReader<'_>) -> DelayScatter {
    let sd_ms = section.number_if(&uncertainty::DELAY_SD_MS);
    let cv_percent = section.number_if(&uncertainty::DELAY_CV_PERCENT);
    let detonator = section.choice_if(&uncertainty::DETONATOR);
    if section.has(&uncertainty::DETONATOR) {
        refuse_beside_detonator(section, &uncertainty::DELAY_SD_MS);
        refuse_beside_detonator(section, &uncertainty::DELAY_CV_PERCENT);
    }
    if sd_ms.is_none() && cv_percent.is_none() {
        return DelayScatter::of(detonator.unwrap_or(Detonator::Electronic));
    }
    DelayScatter { sd_ms: sd_ms.unwrap_or(0.0), cv_percent: cv_percent.unwrap_or(0.0) }
}

fn refuse_beside_detonator(section: &SectionReader<'_>, key: &Key) {
    if section.has(key) {
        let message = format!("`{}` stands beside `detonator`, which gives it too", key.name);
        section.wrong(key, message, "keep one of them");
    }
}

/// Reads `[size]` of a plan with this termination; `own_masses`: listed tires have masses of their own.
pub fn read_size(section: SectionReader<'_>, termination: Option<&str>, own_masses: bool) -> SizeSpec {
    let masses = section.numbers(&size::TIRE_MASS_KG).map_or_else(Vec::new, |list| list.value);
    let spec = SizeSpec {
        tire_mass_kg: masses.into_iter().map(|mass| mass.value).collect(),
        family: section.name_if(&size::ROPES).map(|family| family.value.to_owned()),
        most_border_rows: section.whole(&size::MOST_BORDER_ROWS),
    };
    if let (Some(family), Some(termination)) = (&spec.family, termination)
        && !catalogue().fits(termination, family)
    {
        let message = format!("{termination}, the termination of [cable], fits no rope of {family}");
        section.wrong(&size::ROPES, message, "name another family, or give `termination_percent` in [cable]");
    }
    if own_masses && section.has(&size::TIRE_MASS_KG) {
        let message = "the tires of the list have masses of their own";
        section.wrong(&size::TIRE_MASS_KG, message, "remove these, or the mass_kg of each [[shelter.tire]]");
    }
    section.finish();
    spec
}
