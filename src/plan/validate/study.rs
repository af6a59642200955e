//! The sections of the studies: scatter from shot to shot, and what `size` may choose from.

use crate::plan::keys::{Key, scatter, size};
use crate::plan::read::Table;
use crate::plan::{DelayScatter, ScatterSpec, SizeSpec};

pub fn read_scatter(table: Table<'_>) -> ScatterSpec {
    let of_plan = DelayScatter {
        sd_ms: table.number(&scatter::DELAY_SD_MS),
        cv_percent: table.number(&scatter::DELAY_CV_PERCENT),
    };
    let detonator = table.choice_if(&scatter::DETONATOR).map(DelayScatter::of);
    if table.has(&scatter::DETONATOR) {
        refuse_beside_detonator(&table, &scatter::DELAY_SD_MS);
        refuse_beside_detonator(&table, &scatter::DELAY_CV_PERCENT);
    }
    let spec = ScatterSpec {
        delay: detonator.unwrap_or(of_plan),
        launch_cv_percent: table.number(&scatter::LAUNCH_CV_PERCENT),
        friction: table.range(&scatter::FRICTION),
    };
    table.finish();
    spec
}

fn refuse_beside_detonator(table: &Table<'_>, key: &Key) {
    if table.has(key) {
        let message = format!("`{}` stands beside `detonator`, which gives it too", key.name);
        table.wrong(key, message, "keep one of them");
    }
}

pub fn read_size(table: Table<'_>) -> SizeSpec {
    let masses = table.numbers(&size::TIRE_MASS_KG).map_or_else(Vec::new, |list| list.value);
    let spec = SizeSpec {
        tire_mass_kg: masses.into_iter().map(|mass| mass.value).collect(),
        family: table.name_if(&size::ROPES).map(|family| family.value.to_owned()),
        most_border_rows: table.whole(&size::MOST_BORDER_ROWS),
    };
    table.finish();
    spec
}
