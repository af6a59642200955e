//! Reads the sections of studies: scatter from shot to shot, and the choices of `shelter size`.

use crate::plan::keys::{Key, scatter, size};
use crate::plan::read::SectionReader;
use crate::plan::{DelayScatter, ScatterSpec, SizeSpec};

pub fn read_scatter(section: SectionReader<'_>) -> ScatterSpec {
    let of_plan = DelayScatter {
        sd_ms: section.number(&scatter::DELAY_SD_MS),
        cv_percent: section.number(&scatter::DELAY_CV_PERCENT),
    };
    let detonator = section.choice_if(&scatter::DETONATOR).map(DelayScatter::of);
    if section.has(&scatter::DETONATOR) {
        refuse_beside_detonator(&section, &scatter::DELAY_SD_MS);
        refuse_beside_detonator(&section, &scatter::DELAY_CV_PERCENT);
    }
    let spec = ScatterSpec {
        delay: detonator.unwrap_or(of_plan),
        launch_cv_percent: section.number(&scatter::LAUNCH_CV_PERCENT),
        friction: section.range(&scatter::FRICTION),
    };
    section.finish();
    spec
}

fn refuse_beside_detonator(section: &SectionReader<'_>, key: &Key) {
    if section.has(key) {
        let message = format!("`{}` stands beside `detonator`, which gives it too", key.name);
        section.wrong(key, message, "keep one of them");
    }
}

pub fn read_size(section: SectionReader<'_>) -> SizeSpec {
    let masses = section.numbers(&size::TIRE_MASS_KG).map_or_else(Vec::new, |list| list.value);
    let spec = SizeSpec {
        tire_mass_kg: masses.into_iter().map(|mass| mass.value).collect(),
        family: section.name_if(&size::ROPES).map(|family| family.value.to_owned()),
        most_border_rows: section.whole(&size::MOST_BORDER_ROWS),
    };
    section.finish();
    spec
}
