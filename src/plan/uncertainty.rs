//! What is not known of the shot that will be fired, and how far, in the units of the keys.

use serde::{Deserialize, Serialize};

use super::Plan;
use super::keys::{DefaultValue, Key, cable, uncertainty};
use super::sections::OF_INPUTS;
use crate::choice::Detonator;

/// What is not known of the shot, and how far; 0 or `[x, x]` means known exactly.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Uncertainty {
    /// Whether every input is assumed, see its default: the plan has no `[uncertainty]`, or only what a fit wrote into it.
    pub assumed: bool,
    /// Whether an input is assumed, because the plan does not name it.
    pub incomplete: bool,
    /// Scatter of every detonator.
    pub delay: DelayScatter,
    /// Nominal delay of the detonator in every hole, which scatters too [ms]; 0: no such detonator.
    pub in_hole_delay_ms: f64,
    /// Coefficient of variation of launch velocities, hole by hole, lognormal [%].
    pub launch_cv_percent: f64,
    /// Coefficient of variation of a factor on all launch velocities at once, lognormal [%]: they are an estimate.
    pub launch_common_percent: f64,
    /// Coefficient of variation of another such factor, which each shot draws anew, lognormal [%].
    pub launch_between_shots_percent: f64,
    /// Smallest and largest exponent n of the [mass law](super::mass_law), the same in the whole shot.
    pub launch_mass_exponent: [f64; 2],
    /// Coefficient of variation of launch velocities, row by row, lognormal [%].
    pub launch_row_cv_percent: f64,
    /// Standard deviation of the launch direction about each horizontal axis, hole by hole [°].
    pub launch_tilt_deg: f64,
    /// Standard deviation of the launch directions of the whole shot about each horizontal axis [°].
    pub launch_tilt_common_deg: f64,
    /// Standard deviation of the place of a hole along each axis, hole by hole [m].
    pub hole_position_m: f64,
    /// Standard deviation of the place of the shelter over all holes along each axis [m].
    pub pattern_offset_m: f64,
    /// Probability that a hole does not fire, each by itself [%].
    pub hole_fails_percent: f64,
    /// Standard deviation of the length of cables as tied, cable by cable [m].
    pub cable_length_m: f64,
    /// Smallest and largest coefficient of friction, the same under the whole shot.
    pub friction: [f64; 2],
    /// Smallest and largest slack, the same in all cables [%].
    pub slack_percent: [f64; 2],
    /// Smallest and largest deviation from the rope's own axial stiffness, the same in all cables [%].
    pub axial_stiffness_percent: [f64; 2],
    /// Coefficient of variation of the mass, tire by tire [%].
    pub tire_mass_cv_percent: f64,
    /// Coefficient of variation of the breaking force, cable by cable [%].
    pub breaking_force_cv_percent: f64,
}

impl Uncertainty {
    /// Coefficient of variation in common from which a launch velocity is no observation, but an estimate [%]: one loose test tire
    /// leaves 10, and one that was read badly less than this; bounds of a blast plan are written with 50.
    pub const ESTIMATED_LAUNCH_PERCENT: f64 = 30.0;

    /// Whether the launch velocity is an estimate that nobody observed.
    pub fn launch_is_estimated(&self) -> bool {
        self.launch_common_percent >= Self::ESTIMATED_LAUNCH_PERCENT
    }

    /// Standard deviation [s] of the firing time of a hole about that of its row, by the detonator in it.
    pub fn in_hole_deviation(&self) -> f64 {
        let delay = self.in_hole_delay_ms * 1e-3;
        if delay > 0.0 { self.delay.deviation(delay) } else { 0.0 }
    }

    /// Whether detonators are pyrotechnic, and none is said to scatter in the holes.
    pub fn lacks_in_hole_scatter(&self) -> bool {
        let pyrotechnic = [Detonator::Pyrotechnic, Detonator::PyrotechnicSurface].map(DelayScatter::of);
        self.in_hole_delay_ms == 0.0 && pyrotechnic.contains(&self.delay)
    }

    /// Whether firing times scatter more than electronic ones do, and those of the holes of a row all alike: none is said to scatter in the holes.
    pub fn scatters_rows_alone(&self) -> bool {
        let sheet = DelayScatter::of(Detonator::Electronic);
        let is_wide = self.delay.sd_ms > sheet.sd_ms || self.delay.cv_percent > sheet.cv_percent;
        self.in_hole_delay_ms == 0.0 && is_wide && !self.lacks_in_hole_scatter()
    }

    /// Whether surface delays fire one hole, or one row, by the one before.
    pub fn has_surface_delays(&self) -> bool {
        self.delay == DelayScatter::of(Detonator::PyrotechnicSurface)
    }

    /// The friction assumed where the plan gives no range: ±1 % of the plan's own.
    pub fn assumed_friction(friction: f64) -> [f64; 2] {
        [0.99 * friction, 1.01 * friction]
    }

    /// The slack [%] assumed where the plan gives no range: ±0.1 percentage points, not below 0.
    pub fn assumed_slack(slack_percent: f64) -> [f64; 2] {
        let range = cable::SLACK_PERCENT.kind.range();
        [slack_percent - 0.1, slack_percent + 0.1].map(|slack| slack.clamp(*range.start(), *range.end()))
    }

    /// The range of the exponent of the mass law where the plan gives none: no measurement decides.
    pub const ANY_MASS_EXPONENT: [f64; 2] = [0.0, 1.0];

    /// The deviation of axial stiffness [%] assumed where the plan gives no range.
    pub const USUAL_AXIAL_STIFFNESS: [f64; 2] = [-1.0, 1.0];
}

/// Percent to which no single film knows a launch.
const SUREST_LAUNCH_PERCENT: f64 = 2.0;
/// Percent to which one loose test tire that was filmed leaves a launch.
const ONE_FILM_PERCENT: f64 = 10.0;
/// Percent to which nobody knows a launch before a fit of many shots: less is rather a share than percent.
const LEAST_LAUNCH_PERCENT: f64 = 0.5;

/// Spreads of which sites measure several times the small default: what somebody writes as small gets no cleaner page than what is left out.
const SELDOM_SMALL: [&Key; 3] = [
    &uncertainty::LAUNCH_CV_PERCENT,
    &uncertainty::LAUNCH_BETWEEN_SHOTS_PERCENT,
    &uncertainty::TIRE_MASS_CV_PERCENT,
];

impl Plan {
    /// Whether `[uncertainty]` does not say how well the launch velocity is known: its default is that of filmed shots, nobody knows a
    /// launch exactly, and 0.08 is 8 % of somebody who writes shares.
    pub fn leaves_launch_unstated(&self) -> bool {
        let percent = self.uncertainty.launch_common_percent;
        let is_share = percent < LEAST_LAUNCH_PERCENT && self.fitted_from.is_empty();
        percent == 0.0 || is_share || self.left_out.contains(&uncertainty::LAUNCH_COMMON_PERCENT.name)
    }

    /// Whether the launch velocity is taken as surer than any film tells, such as by the default of a key that is left out.
    pub fn takes_launch_as_too_sure(&self) -> bool {
        self.uncertainty.launch_common_percent <= SUREST_LAUNCH_PERCENT && self.fitted_from.is_empty()
    }

    /// Whether the launch velocity is taken as surer than one filmed test tire leaves it, and no film was fitted.
    pub fn takes_launch_as_filmed(&self) -> bool {
        self.uncertainty.launch_common_percent < ONE_FILM_PERCENT && self.fitted_from.is_empty()
    }

    /// Inputs of `[uncertainty]` that a 0, a range of one value, or less than half of the small default, of [`SELDOM_SMALL`] no more than
    /// that, says are exact, or nearly; without
    /// the launch in common, of which [`Self::takes_launch_as_too_sure`] tells.
    pub fn taken_as_exact(&self) -> Vec<&'static str> {
        let is_input = |key: &Key| {
            OF_INPUTS.iter().any(|input| input.name == key.name)
                && key.name != uncertainty::LAUNCH_COMMON_PERCENT.name
        };
        let is_exact = |key: &Key, values: &[f64]| {
            let spread = if let [low, high] = values { 0.5 * (high - low) } else { values[0] };
            // No site knows launches and worn tires as surely as the small default has it.
            let part =
                if SELDOM_SMALL.iter().any(|seldom| seldom.name == key.name) { 1.0 + 1e-9 } else { 0.5 };
            spread == 0.0 || spread < part * self.small_spread(key)
        };
        let exact =
            self.unknowns().into_iter().filter(|(key, values)| is_input(key) && is_exact(key, values));
        let exponent = self.uncertainty.launch_mass_exponent;
        let exponent = (exponent[1] - exponent[0] < 0.5).then_some(uncertainty::LAUNCH_MASS_EXPONENT.name);
        let sheet = DelayScatter::of(Detonator::Electronic);
        let DelayScatter { sd_ms, cv_percent } = self.uncertainty.delay;
        let are_exact = sd_ms < 0.5 * sheet.sd_ms && cv_percent < 0.5 * sheet.cv_percent;
        let times = are_exact.then_some(uncertainty::DELAY_SD_MS.name);
        times.into_iter().chain(exact.map(|(key, _)| key.name)).chain(exponent).collect()
    }

    /// What an input varies by where the plan leaves it out: its standard deviation, or half of its range.
    fn small_spread(&self, key: &Key) -> f64 {
        let range = match key.name {
            name if name == uncertainty::FRICTION.name => Uncertainty::assumed_friction(self.ground.friction),
            name if name == uncertainty::SLACK_PERCENT.name => {
                Uncertainty::assumed_slack(self.cable.slack_percent)
            }
            name if name == uncertainty::AXIAL_STIFFNESS_PERCENT.name => Uncertainty::USUAL_AXIAL_STIFFNESS,
            _ => return if let Some(DefaultValue::Number(default)) = key.default { default } else { 0.0 },
        };
        0.5 * (range[1] - range[0])
    }

    /// Ranges of `[uncertainty]` that leave out what the plan itself says: each with its key and the plan's own value, in the
    /// unit of the key.
    pub fn ranges_beside_the_plan(&self) -> Vec<(&'static Key, [f64; 2], f64)> {
        let Uncertainty { friction, slack_percent, axial_stiffness_percent, .. } = self.uncertainty;
        let ranges: [(&'static Key, _, _); 3] = [
            (&uncertainty::FRICTION, friction, self.ground.friction),
            (&uncertainty::SLACK_PERCENT, slack_percent, self.cable.slack_percent),
            (&uncertainty::AXIAL_STIFFNESS_PERCENT, axial_stiffness_percent, 0.0),
        ];
        ranges.into_iter().filter(|&(_, [low, high], own)| !(low..=high).contains(&own)).collect()
    }
}

/// Scatter of a firing time: the greater of a fixed standard deviation and a share of the nominal delay.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct DelayScatter {
    /// Fixed standard deviation [ms].
    pub sd_ms: f64,
    /// Standard deviation over nominal delay [%].
    pub cv_percent: f64,
}

impl DelayScatter {
    /// Scatter of a kind of detonator: of electronic ones what their sheets specify, of others the upper ends of published figures.
    pub fn of(detonator: Detonator) -> Self {
        let (sd_ms, cv_percent) = match detonator {
            Detonator::Electronic => (0.1, 0.01),
            Detonator::Pyrotechnic => (0.0, 2.0),
            Detonator::PyrotechnicSurface => (0.0, 4.0),
        };
        Self { sd_ms, cv_percent }
    }

    /// Standard deviation [s] of a firing planned at `nominal` [s].
    pub fn deviation(&self, nominal: f64) -> f64 {
        (self.sd_ms * 1e-3).max(self.cv_percent * 1e-2 * nominal)
    }
}

#[cfg(test)]
mod tests {
    use crate::plan::Plan;

    /// Nobody knows a launch exactly: who writes 0 says as little of it as who leaves the key out.
    #[test]
    fn a_launch_known_exactly_is_not_stated() {
        let text = include_str!("../../tests/fixtures/amur-three-rows.toml");
        let stated = "launch_common_percent = ";
        let line = text.lines().find(|line| line.starts_with(stated)).expect("the key");
        for (written, is_unstated) in [
            (line.to_owned(), false),
            (format!("{stated}0"), true),
            // A share is no percentage.
            (format!("{stated}0.08"), true),
            (format!("{stated}0.5"), false),
            (String::new(), true),
        ] {
            let plan = Plan::parse("", &text.replace(line, &written))
                .unwrap_or_else(|mistakes| panic!("{mistakes}"));
            assert_eq!(plan.leaves_launch_unstated(), is_unstated, "{written}");
        }
    }
}
