//! Reads the uncertainty of the shot, and the choices of `shelter size` and `shelter search`.

use itertools::Itertools;

use crate::choice::{Detonator, HoleOrder, SearchedOrders};
use crate::plan::keys::{Key, intervals, search, size, uncertainty};
use crate::plan::reader::SectionReader;
use crate::plan::{DelayScatter, HoleTiming, SearchSpec, SizeSpec, Time, Uncertainty};
use crate::ropes::catalogue;

/// Reads `[uncertainty]` of a plan with this friction and slack [%], and the entries of its `fitted_from`. `assumed`: the plan has no such
/// section.
pub fn read_uncertainty(
    section: SectionReader<'_>,
    assumed: bool,
    friction: f64,
    slack_percent: f64,
) -> (Uncertainty, Vec<String>) {
    let used = section.texts(&uncertainty::FITTED_FROM).map_or_else(Vec::new, |list| list.value);
    // A fit, or an estimate of the launch, writes only these keys. They say nothing about the inputs that nobody stated.
    let of_fit = [
        &uncertainty::FITTED_FROM,
        &uncertainty::LAUNCH_COMMON_PERCENT,
        &uncertainty::LAUNCH_BETWEEN_SHOTS_PERCENT,
        &uncertainty::FRICTION,
        &uncertainty::SLACK_PERCENT,
        &uncertainty::AXIAL_STIFFNESS_PERCENT,
    ];
    let of_fit = of_fit.into_iter().filter(|key| section.has(key)).count();
    let is_of_fit = section.has(&uncertainty::FITTED_FROM) && section.count_keys() == of_fit;
    let uncertainty = Uncertainty {
        assumed: assumed || is_of_fit,
        incomplete: !left_out(&section).is_empty(),
        delay: read_delay_scatter(&section),
        in_hole_delay_ms: section.number(&uncertainty::IN_HOLE_DELAY_MS),
        launch_cv_percent: section.number(&uncertainty::LAUNCH_CV_PERCENT),
        launch_common_percent: section.number(&uncertainty::LAUNCH_COMMON_PERCENT),
        launch_between_shots_percent: section.number(&uncertainty::LAUNCH_BETWEEN_SHOTS_PERCENT),
        launch_mass_exponent: section
            .range(&uncertainty::LAUNCH_MASS_EXPONENT, 0.0)
            .unwrap_or(Uncertainty::ANY_MASS_EXPONENT),
        launch_row_cv_percent: section.number(&uncertainty::LAUNCH_ROW_CV_PERCENT),
        launch_tilt_deg: section.number(&uncertainty::LAUNCH_TILT_DEG),
        launch_tilt_common_deg: section.number(&uncertainty::LAUNCH_TILT_COMMON_DEG),
        hole_position_m: section.number(&uncertainty::HOLE_POSITION_M),
        pattern_offset_m: section.number(&uncertainty::PATTERN_OFFSET_M),
        hole_fails_percent: section.number(&uncertainty::HOLE_FAILS_PERCENT),
        cable_length_m: section.number(&uncertainty::CABLE_LENGTH_M),
        friction: section
            .range(&uncertainty::FRICTION, friction)
            .unwrap_or_else(|| Uncertainty::assumed_friction(friction)),
        slack_percent: section
            .range(&uncertainty::SLACK_PERCENT, slack_percent)
            .unwrap_or_else(|| Uncertainty::assumed_slack(slack_percent)),
        axial_stiffness_percent: section
            .range(&uncertainty::AXIAL_STIFFNESS_PERCENT, 0.0)
            .unwrap_or(Uncertainty::USUAL_AXIAL_STIFFNESS),
        tire_mass_cv_percent: section.number(&uncertainty::TIRE_MASS_CV_PERCENT),
        breaking_force_cv_percent: section.number(&uncertainty::BREAKING_FORCE_CV_PERCENT),
    };
    section.finish();
    (uncertainty, used.into_iter().map(|checksum| checksum.value.to_owned()).collect())
}

/// The inputs that `[uncertainty]` leaves out.
pub fn left_out(section: &SectionReader<'_>) -> Vec<&'static str> {
    let has_scatter = [&uncertainty::DETONATOR, &uncertainty::DELAY_SD_MS, &uncertainty::DELAY_CV_PERCENT]
        .into_iter()
        .any(|key| section.has(key));
    let left_out = OF_INPUTS.into_iter().filter(|key| !section.has(key));
    let detonator = (!has_scatter).then_some(&uncertainty::DETONATOR);
    detonator.into_iter().chain(left_out).map(|key| key.name).collect()
}

/// Keys whose default is an assumption: an input known to 1 %, and a shelter laid and fired carefully.
pub const OF_INPUTS: [&Key; 14] = [
    &uncertainty::LAUNCH_CV_PERCENT,
    &uncertainty::LAUNCH_ROW_CV_PERCENT,
    &uncertainty::LAUNCH_TILT_DEG,
    &uncertainty::LAUNCH_TILT_COMMON_DEG,
    &uncertainty::HOLE_POSITION_M,
    &uncertainty::PATTERN_OFFSET_M,
    &uncertainty::HOLE_FAILS_PERCENT,
    &uncertainty::CABLE_LENGTH_M,
    &uncertainty::LAUNCH_COMMON_PERCENT,
    &uncertainty::LAUNCH_BETWEEN_SHOTS_PERCENT,
    &uncertainty::FRICTION,
    &uncertainty::SLACK_PERCENT,
    &uncertainty::AXIAL_STIFFNESS_PERCENT,
    &uncertainty::TIRE_MASS_CV_PERCENT,
];

/// Scatter of firing times, from the detonator or from the plan.
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

/// Reads `[size]` of a plan with this termination. `own_masses`: listed tires have masses of their own.
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

/// Largest number of evenly spaced intervals.
const MOST_INTERVALS: i64 = 10_000;

/// Reads `[search]` of a plan.
pub fn read_search(section: SectionReader<'_>) -> SearchSpec {
    let mut hole_intervals = times(&section, &search::HOLE_INTERVALS_MS).unwrap_or_default();
    if hole_intervals.is_empty() {
        hole_intervals.push(Time::ZERO);
    }
    let orders = section.choices(&search::HOLE_ORDERS).filter(|orders| !orders.is_empty());
    let orders = orders.unwrap_or_else(|| vec![HoleOrder::DEFAULT]);
    let with_order = itertools::iproduct!(hole_intervals, orders);
    let holes = with_order.map(|(interval, order)| match interval > Time::ZERO {
        true => HoleTiming { interval, order, fired_through: false },
        false => HoleTiming::TOGETHER,
    });
    let limit = &search::MOST_HOLES_IN_8_MS;
    let spec = SearchSpec {
        intervals: read_intervals(&section),
        equal_intervals: section.flag(&search::EQUAL_INTERVALS),
        orders: section.choice(&search::ORDERS, SearchedOrders::DEFAULT),
        holes: holes.fold(Vec::new(), |mut all, one| {
            if !all.contains(&one) {
                all.push(one);
            }
            all
        }),
        longest: section.number_if(&search::LONGEST_MS).map(Time::from_ms),
        most_holes_in_8_ms: section.has(limit).then(|| section.whole(limit)),
    };
    section.finish();
    spec
}

/// The numbers of a list, ascending and without repetitions; an empty list is a mistake.
fn numbers(section: &SectionReader<'_>, key: &Key) -> Option<Vec<f64>> {
    let list = section.numbers(key)?;
    if list.value.is_empty() {
        section.wrong(key, format!("`{}` is an empty list", key.name), "name at least one, or leave it out");
    }
    let values = list.value.into_iter().map(|number| number.value);
    Some(values.sorted_by(f64::total_cmp).dedup().collect())
}

/// The times of a list, ascending and without repetitions.
fn times(section: &SectionReader<'_>, key: &Key) -> Option<Vec<Time>> {
    Some(numbers(section, key)?.into_iter().map(Time::from_ms).dedup().collect())
}

/// Intervals of `[search]`, from a list or evenly spaced.
fn read_intervals(section: &SectionReader<'_>) -> Vec<Time> {
    let Some(even) = section.inline_section(&search::INTERVALS_MS) else {
        return times(section, &search::INTERVALS_MS).unwrap_or_default();
    };
    let [from, to, step] = [&intervals::FROM, &intervals::TO, &intervals::STEP].map(|key| even.time(key));
    if from > to {
        even.wrong(&intervals::FROM, "`from` is greater than `to`", "write the shorter one first");
    } else if (to - from).steps(step) >= MOST_INTERVALS {
        even.wrong(&intervals::STEP, format!("more than {MOST_INTERVALS} intervals"), "choose a longer step");
    }
    even.finish();
    let count = (to - from).steps(step).clamp(0, MOST_INTERVALS);
    (0..=count).map(|n| from + step * n).collect()
}
