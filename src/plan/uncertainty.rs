//! Unknowns of the shot that will be fired, and how far each may vary, in the units of the keys.

use serde::{Deserialize, Serialize};

use super::Plan;
use super::keys::{DefaultValue, Key, cable, uncertainty};
use super::sections::OF_INPUTS;
use crate::choice::Detonator;

/// Unknowns of the shot, and how far each may vary. 0 or `[x, x]` means known exactly.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Uncertainty {
    /// Whether every input is assumed, as its default says: the plan has no `[uncertainty]`, or only what a fit wrote into it.
    pub assumed: bool,
    /// Whether at least one input is assumed, because the plan does not name it.
    pub incomplete: bool,
    /// Scatter of the firing time of every detonator.
    pub delay: DelayScatter,
    /// Nominal delay of the detonator in every hole [ms], which scatters, too. 0: there is no such detonator.
    pub in_hole_delay_ms: f64,
    /// Coefficient of variation of launch velocities, hole by hole, lognormal [%].
    pub launch_cv_percent: f64,
    /// Coefficient of variation of a factor on all launch velocities at once, lognormal [%]: the velocities are an estimate.
    pub launch_common_percent: f64,
    /// Coefficient of variation of a second factor on all launch velocities, which each shot draws anew, lognormal [%].
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
    /// Probability that a hole does not fire, independent of the other holes [%].
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
    /// Coefficient of variation in common [%] from which a launch velocity is an estimate, and no observation. One loose test tire leaves
    /// 10 %, and a test tire that was read badly leaves less than this constant. Bounds of a blast plan are written with 50 %.
    pub const ESTIMATED_LAUNCH_PERCENT: f64 = 30.0;

    /// Whether the launch velocity is an estimate that nobody observed.
    pub fn launch_is_estimated(&self) -> bool {
        self.launch_common_percent >= Self::ESTIMATED_LAUNCH_PERCENT
    }

    /// Standard deviation [s] of the firing time of a hole about the firing time of its row, from the detonator in the hole.
    pub fn in_hole_deviation(&self) -> f64 {
        let delay = self.in_hole_delay_ms * 1e-3;
        if delay > 0.0 { self.delay.deviation(delay) } else { 0.0 }
    }

    /// Whether detonators are pyrotechnic, and the plan states no scatter in the holes.
    pub fn lacks_in_hole_scatter(&self) -> bool {
        let pyrotechnic = [Detonator::Pyrotechnic, Detonator::PyrotechnicSurface].map(DelayScatter::of);
        self.in_hole_delay_ms == 0.0 && pyrotechnic.contains(&self.delay)
    }

    /// Whether firing times scatter more than electronic ones, and alike in all holes of a row, because the plan states no scatter in the
    /// holes. Detonators of [`Self::lacks_in_hole_scatter`] do not count.
    pub fn scatters_rows_alone(&self) -> bool {
        let sheet = DelayScatter::of(Detonator::Electronic);
        let is_wide = self.delay.sd_ms > sheet.sd_ms || self.delay.cv_percent > sheet.cv_percent;
        self.in_hole_delay_ms == 0.0 && is_wide && !self.lacks_in_hole_scatter()
    }

    /// Whether surface delays fire each hole, or each row, through the one before.
    pub fn has_surface_delays(&self) -> bool {
        self.delay == DelayScatter::of(Detonator::PyrotechnicSurface)
    }

    /// The range of friction assumed where the plan gives none: ±1 % of the plan's own friction.
    pub fn assumed_friction(friction: f64) -> [f64; 2] {
        [0.99 * friction, 1.01 * friction]
    }

    /// The range of slack [%] assumed where the plan gives none: ±0.1 percentage points, not below 0.
    pub fn assumed_slack(slack_percent: f64) -> [f64; 2] {
        let range = cable::SLACK_PERCENT.kind.range();
        [slack_percent - 0.1, slack_percent + 0.1].map(|slack| slack.clamp(*range.start(), *range.end()))
    }

    /// The range of the exponent of the mass law where the plan gives none: no measurement decides.
    pub const ANY_MASS_EXPONENT: [f64; 2] = [0.0, 1.0];

    /// The range of deviation of axial stiffness [%] assumed where the plan gives none.
    pub const USUAL_AXIAL_STIFFNESS: [f64; 2] = [-1.0, 1.0];
}

/// Uncertainty of a launch [%] that is too small for a single film.
const SUREST_LAUNCH_PERCENT: f64 = 2.0;
/// Uncertainty of a launch after one filmed loose test tire [%].
const ONE_FILM_PERCENT: f64 = 10.0;
/// Least uncertainty of a launch before a fit of many shots [%]. A smaller number is probably a share, and not percent.
const LEAST_LAUNCH_PERCENT: f64 = 0.5;

/// Spreads that sites measure at several times the small default. A plan that writes such a small value gets no cleaner page than a plan
/// that leaves the key out.
const SELDOM_SMALL: [&Key; 3] = [
    &uncertainty::LAUNCH_CV_PERCENT,
    &uncertainty::LAUNCH_BETWEEN_SHOTS_PERCENT,
    &uncertainty::TIRE_MASS_CV_PERCENT,
];

impl Plan {
    /// Whether `[uncertainty]` does not state how well the launch velocity is known. The default is for filmed shots. A 0 states nothing,
    /// because nobody knows a launch exactly. A 0.08 means 8 %, from somebody who writes shares.
    pub fn leaves_launch_unstated(&self) -> bool {
        let percent = self.uncertainty.launch_common_percent;
        let is_share = percent < LEAST_LAUNCH_PERCENT && self.fitted_from.is_empty();
        percent == 0.0 || is_share || self.left_out.contains(&uncertainty::LAUNCH_COMMON_PERCENT.name)
    }

    /// Whether the launch velocity counts as surer than any film shows, such as by the default of a key that is left out.
    pub fn takes_launch_as_too_sure(&self) -> bool {
        self.uncertainty.launch_common_percent <= SUREST_LAUNCH_PERCENT && self.fitted_from.is_empty()
    }

    /// Whether the launch velocity counts as surer than one filmed test tire leaves it, and no film was fitted.
    pub fn takes_launch_as_filmed(&self) -> bool {
        self.uncertainty.launch_common_percent < ONE_FILM_PERCENT && self.fitted_from.is_empty()
    }

    /// Inputs of `[uncertainty]` that the plan states as exact, or nearly: by a 0, a range of one value, or less than half of the small
    /// default. An input of [`SELDOM_SMALL`] is nearly exact up to the whole small default. The launch in common is not included: see
    /// [`Self::takes_launch_as_too_sure`].
    pub fn nearly_exact_inputs(&self) -> Vec<&'static str> {
        let is_input = |key: &Key| {
            OF_INPUTS.iter().any(|input| input.name == key.name)
                && key.name != uncertainty::LAUNCH_COMMON_PERCENT.name
        };
        let is_exact = |key: &Key, values: &[f64]| {
            let spread = if let [low, high] = values { 0.5 * (high - low) } else { values[0] };
            // No site knows launches and worn tires as well as the small default says.
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

    /// Spread of an input that the plan leaves out: its standard deviation, or half of its range.
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

    /// Ranges of `[uncertainty]` that do not contain the plan's own value: each with its key and the own value, in the unit of the key.
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
    /// Scatter of a kind of detonator: for electronic ones as their sheets specify, for others the upper ends of published figures.
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

    /// Nobody knows a launch exactly: a 0 states as little as a key that is left out.
    #[test]
    fn a_launch_known_exactly_is_not_stated() {
        let text = include_str!("../../tests/fixtures/amur-three-rows.toml");
        let stated = "launch_common_percent = ";
        let line = text.lines().find(|line| line.starts_with(stated)).expect("the key");
        for (written, is_unstated) in [
            (line.to_owned(), false),
            (format!("{stated}0"), true),
            // A share, and no percentage.
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
