//! Writes a fit into the text of a plan: the estimates, their uncertainty, and the observations behind them.

use toml_edit::{Array, Decor, DocumentMut, Item, RawString, TableLike, Value};

use super::assumed::says_assumed;
use super::edit::{change_launches, change_section, replace_keys, set, with_line_ends_of};
use super::keys::{cable, ground, plan, uncertainty};
use super::starter::LAUNCH_IS_ASSUMED;
use super::{Plan, Uncertainty, fitted_blast};
use crate::choice::Unknown;
use crate::plan::keys::Key;
use crate::ropes::catalogue;
use crate::units::{self, Unit};

/// Which inputs `[uncertainty]` of a plan states. The other inputs have defaults.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StatedKeys {
    /// The launch velocity, in common.
    pub launch_common: bool,
    /// The launch velocity, from shot to shot.
    pub launch_between_shots: bool,
    /// Friction.
    pub friction: bool,
    /// Slack.
    pub slack: bool,
    /// Axial stiffness.
    pub axial_stiffness: bool,
}

impl StatedKeys {
    /// The inputs that the text of a plan states.
    pub fn of(text: &str) -> Self {
        let document: Option<DocumentMut> = text.trim_start_matches('\u{feff}').parse().ok();
        let section = document.as_ref().and_then(|document| document.get(plan::UNCERTAINTY.name));
        let section = section.and_then(Item::as_table_like);
        let has = |key: &Key| section.is_some_and(|section| section.contains_key(key.name));
        Self {
            launch_common: has(&uncertainty::LAUNCH_COMMON_PERCENT),
            launch_between_shots: has(&uncertainty::LAUNCH_BETWEEN_SHOTS_PERCENT),
            friction: has(&uncertainty::FRICTION),
            slack: has(&uncertainty::SLACK_PERCENT),
            axial_stiffness: has(&uncertainty::AXIAL_STIFFNESS_PERCENT),
        }
    }
}

/// Result of a fit, for a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct FitToWrite {
    /// The estimates.
    pub estimates: Vec<EstimateToWrite>,
    /// Uncertainty of launches; `None` if the fit estimates none.
    pub launches: Option<LaunchUncertainty>,
}

/// Uncertainty of launches after a fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaunchUncertainty {
    /// Coefficient of variation of all launch velocities at once that remains after the fit [%].
    pub common_percent: f64,
    /// Coefficient of variation from shot to shot [%], which no fit of few shots reduces.
    pub between_shots_percent: f64,
}

/// One estimate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EstimateToWrite {
    /// The estimated unknown.
    pub unknown: Unknown,
    /// Index of the blast row, for a launch by row.
    pub row: Option<usize>,
    /// The estimate: a factor on launch velocities, else in the unit of the key of the plan.
    pub value: f64,
    /// Standard deviation of the estimate, in the unit of `value`.
    pub sd: f64,
}

impl EstimateToWrite {
    /// Standard deviation over estimate [%].
    fn percent(&self) -> f64 {
        1e2 * self.sd / self.value
    }

    /// The ends of the uniform distribution with this mean and standard deviation. The range is at least as wide as `before`, and not below
    /// 0.
    fn ends(&self, before: [f64; 2]) -> [f64; 2] {
        let half = (3.0_f64.sqrt() * self.sd).max(0.5 * (before[1] - before[0]));
        [(self.value - half).max(0.0), self.value + half]
    }
}

/// The text of a plan with these estimates, and with the checksums of the observations behind them. Comments and formatting stay, except
/// a comment that calls the launch assumed. An axial stiffness takes the place of the rope's name.
///
/// The plan gets the common uncertainty of launches after the fit, and beside it the variation from shot to shot, which a fit does not
/// reduce. For friction, slack and stiffness a plan has a single range for both. If an estimate is less sure than `before`, its range gets
/// wider. No range gets narrower: well-known values of past shots do not say how far the next shot differs from them.
pub fn write(text: &str, before: &Plan, fitted: &FitToWrite, checksums: &[String]) -> Result<String, String> {
    let mut document: DocumentMut =
        text.parse().map_err(|error: toml_edit::TomlError| error.message().to_owned())?;
    let Plan { uncertainty: Uncertainty { friction, slack_percent, axial_stiffness_percent, .. }, .. } =
        *before;
    for estimate in &fitted.estimates {
        write_value(&mut document, estimate);
    }
    change_section(&mut document, &plan::UNCERTAINTY, |section| {
        if let Some(LaunchUncertainty { common_percent, between_shots_percent }) = fitted.launches {
            for (key, percent) in [
                (&uncertainty::LAUNCH_COMMON_PERCENT, common_percent),
                (&uncertainty::LAUNCH_BETWEEN_SHOTS_PERCENT, between_shots_percent),
            ] {
                set(section, key.name, short(percent).into());
            }
            let common =
                section.get_mut(uncertainty::LAUNCH_COMMON_PERCENT.name).and_then(Item::as_value_mut);
            if let Some(decor) = common.map(Value::decor_mut).filter(|decor| is_assumed(decor)) {
                decor.set_suffix(" # as fitted");
            }
        }
        for estimate in &fitted.estimates {
            match estimate.unknown {
                Unknown::Friction => {
                    set_range(section, &uncertainty::FRICTION, estimate.ends(friction));
                }
                Unknown::Slack => {
                    set_range(section, &uncertainty::SLACK_PERCENT, estimate.ends(slack_percent));
                }
                Unknown::AxialStiffness => {
                    let half = 3.0_f64.sqrt() * estimate.percent();
                    let [low, high] = axial_stiffness_percent;
                    set_range(
                        section,
                        &uncertainty::AXIAL_STIFFNESS_PERCENT,
                        [low.min(-half), high.max(half)],
                    );
                }
                Unknown::Launch | Unknown::LaunchByRow | Unknown::EndStiffness | Unknown::Damping => {}
            }
        }
        let used = section.entry(uncertainty::FITTED_FROM.name).or_insert(Array::new().into());
        if let Some(list) = used.as_array_mut() {
            checksums.iter().for_each(|checksum| list.push(checksum.as_str()));
            if fitted.launches.is_some() && !checksums.is_empty() {
                let new = fitted_blast::kept(before).filter(|kept| !before.fitted_from.contains(kept));
                list.extend(new);
            }
        }
    });
    let written = with_line_ends_of(text, &document);
    if fitted.launches.is_none() {
        return Ok(written);
    }
    Ok(written.split_inclusive('\n').filter(|line| line.trim() != LAUNCH_IS_ASSUMED).collect())
}

/// Whether the comment behind a value says that nobody has determined the value.
fn is_assumed(decor: &Decor) -> bool {
    decor.suffix().and_then(RawString::as_str).is_some_and(says_assumed)
}

/// Writes an estimate in place of the plan's value.
fn write_value(document: &mut DocumentMut, estimate: &EstimateToWrite) {
    let value = estimate.value;
    let of_row = |row: usize| if estimate.row.is_none_or(|named| named == row) { value } else { 1.0 };
    match estimate.unknown {
        Unknown::Launch | Unknown::LaunchByRow => {
            change_launches(document, &|row, speed| short(speed * of_row(row)), &|row, height| {
                short(height * of_row(row).powi(2))
            })
        }
        Unknown::Friction => change_section(document, &plan::GROUND, |section| {
            set(section, ground::FRICTION.name, short(value).into());
        }),
        Unknown::Slack => set_of_cable(document, &cable::SLACK_PERCENT, value),
        Unknown::EndStiffness => set_of_cable(document, &cable::END_STIFFNESS_KN_M, value),
        Unknown::Damping => set_of_cable(document, &cable::DAMPING_PERCENT, value),
        Unknown::AxialStiffness => {
            change_section(document, &plan::CABLE, |section| {
                let rope = section.get(cable::ROPE.name).and_then(Item::as_str);
                if let Some(rope) = rope.and_then(|name| catalogue().find(name)) {
                    let breaking = rope.breaking_force_kn;
                    replace_keys(section, &[&cable::ROPE], &cable::AXIAL_STIFFNESS_KN, short(value).into());
                    set(section, cable::BREAKING_FORCE_KN.name, breaking.into());
                }
            });
            set_of_cable(document, &cable::AXIAL_STIFFNESS_KN, value);
        }
    }
}

fn set_of_cable(document: &mut DocumentMut, key: &Key, value: f64) {
    change_section(document, &plan::CABLE, |section| set(section, key.name, short(value).into()));
}

fn set_range(section: &mut dyn TableLike, key: &Key, ends: [f64; 2]) {
    set(section, key.name, Value::from_iter(ends.map(short)));
}

/// The number rounded to six digits.
fn short(number: f64) -> f64 {
    units::exact(number, Unit::One).parse().unwrap_or(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAN: &str = include_str!("../../tests/fixtures/amur-three-rows.toml");

    fn written(text: &str, fitted: &[EstimateToWrite]) -> (String, Plan) {
        let before = Plan::parse("plan.toml", text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let text = write(text, &before, &to_write(fitted), &["ab12".to_owned()]).expect("TOML");
        let plan = Plan::parse("plan.toml", &text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        (text, plan)
    }

    /// A fit of these estimates. Launches are known to 2 %, and differ by 5 % from shot to shot.
    fn to_write(estimates: &[EstimateToWrite]) -> FitToWrite {
        let of_launches = |e: &EstimateToWrite| matches!(e.unknown, Unknown::Launch | Unknown::LaunchByRow);
        let launches = LaunchUncertainty { common_percent: 2.0, between_shots_percent: 5.0 };
        let launches = estimates.iter().any(of_launches).then_some(launches);
        FitToWrite { estimates: estimates.to_vec(), launches }
    }

    fn fitted(unknown: Unknown, value: f64, sd: f64) -> EstimateToWrite {
        EstimateToWrite { unknown, row: None, value, sd }
    }

    /// Whoever films a tire has nothing to look for in the comments: those that call the launch assumed go, and only those.
    #[test]
    fn a_fitted_launch_is_not_called_assumed_any_more() {
        let listed = PLAN.replacen("launch_m_s = 6.0", &format!("{LAUNCH_IS_ASSUMED}\nlaunch_m_s = 6.0"), 1);
        let about = |text: &str| {
            text.lines().filter(|line| line.contains("launch") && line.contains("assumed")).count()
        };
        let [friction, launch] = [fitted(Unknown::Friction, 0.45, 0.02), fitted(Unknown::Launch, 1.1, 0.022)];
        assert_eq!(about(&written(&listed, &[friction]).0), about(&listed));
        assert_eq!(about(&written(&listed, &[launch]).0), about(&listed) - 2);
    }

    /// A line without an estimate stays as it is, with its comment. A range that an estimate would narrow stays, too. The uncertainty of
    /// launches is written as the fit leaves it, in common and from shot to shot.
    #[test]
    fn only_the_lines_of_estimates_change() {
        let estimates = [
            fitted(Unknown::Launch, 1.1, 0.022),
            fitted(Unknown::Friction, 0.45, 0.02),
            fitted(Unknown::Slack, 0.1, 0.1),
        ];
        let (text, plan) = written(PLAN, &estimates);
        let changed: Vec<&str> = text.lines().filter(|line| !PLAN.lines().any(|old| old == *line)).collect();
        assert_eq!(
            changed,
            [
                "slack_percent = 0.1",
                "friction = 0.45          # rocky soil 0.3 to 0.5",
                "launch_m_s = 6.6",
                "launch_m_s = 6.6",
                "launch_m_s = 6.6",
                "launch_common_percent = 2.0 # as fitted",
                "launch_between_shots_percent = 5.0 # from shot to shot, which no fit of one shot takes away; assumed: put in yours",
                "friction = [0.35, 0.55]            # rocky soil",
                "slack_percent = [0.0, 0.6]       # assumed: measure yours",
                "fitted_from = [\"ab12\", \"tires 280 kg\"]",
            ]
        );
        assert_eq!(plan.fitted_from, ["ab12", "tires 280 kg"]);
        let again = write(&text, &plan, &to_write(&[]), &["cd34".to_owned()]).expect("TOML");
        assert!(again.contains("fitted_from = [\"ab12\", \"tires 280 kg\", \"cd34\"]"), "{again}");
        let before = Plan::parse("", PLAN).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let windows = PLAN.replace('\n', "\r\n");
        let windows = write(&windows, &before, &to_write(&estimates), &["ab12".to_owned()]).expect("TOML");
        assert_eq!(windows, text.replace('\n', "\r\n"));
    }

    /// The rope keeps its breaking force under the same termination.
    #[test]
    fn a_fitted_stiffness_takes_the_place_of_the_rope() {
        let before = Plan::parse("", PLAN).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let (_, plan) = written(
            PLAN,
            &[fitted(Unknown::AxialStiffness, 5000.0, 250.0), fitted(Unknown::EndStiffness, 900.0, 1.0)],
        );
        assert_eq!(plan.cable.axial_stiffness_kn, 5000.0);
        assert_eq!(plan.cable.breaking_force_kn, before.cable.breaking_force_kn);
        assert_eq!(plan.cable.end_stiffness_kn_m, Some(900.0));
        assert_eq!(plan.uncertainty.axial_stiffness_percent, [-8.66025, 8.66025]);
    }

    #[test]
    fn launches_of_a_row_change_alone() {
        let row =
            |row, value| EstimateToWrite { row: Some(row), ..fitted(Unknown::LaunchByRow, value, 0.05) };
        let (_, plan) = written(PLAN, &[row(0, 0.5), row(1, 1.0), row(2, 2.0)]);
        let speeds: Vec<f64> = plan.launches().map(|launch| launch.speed_m_s).collect();
        assert_eq!(speeds, [3.0, 6.0, 12.0]);
        assert_eq!(plan.uncertainty.launch_common_percent, 2.0);
    }

    #[test]
    fn a_plan_without_the_section_gets_it() {
        let text = &PLAN[..PLAN.find("\n[uncertainty]").expect("the section") + 1];
        assert_eq!(StatedKeys::of(text), StatedKeys::default());
        let (text, plan) = written(text, &[fitted(Unknown::Launch, 0.9, 0.018)]);
        assert_eq!(plan.uncertainty.launch_common_percent, 2.0);
        assert_eq!(plan.uncertainty.launch_between_shots_percent, 5.0);
        let stated = StatedKeys { launch_common: true, launch_between_shots: true, ..StatedKeys::default() };
        assert_eq!(StatedKeys::of(&text), stated);
    }
}
