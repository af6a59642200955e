//! The plans that come with the program. Nobody may fire them, under any title.

use std::sync::OnceLock;

use itertools::Itertools;

use super::{BlastRow, Plan, names};
use crate::sorting::sorted;

/// Names and texts of the examples.
pub const EXAMPLES: &[(&str, &str)] = &[
    ("amur-three-rows", include_str!("../../plans/amur-three-rows.toml")),
    ("point-blasting", include_str!("../../plans/point-blasting.toml")),
    ("paper-5-tire", include_str!("../../plans/paper-5-tire.toml")),
    ("large-50x50", include_str!("../../plans/large-50x50.toml")),
];

impl Plan {
    /// Whether the plan is an example: its title says so, or its whole site is the site of an example.
    pub fn is_example(&self) -> bool {
        self.is_titled_example() || self.example_of_site().is_some()
    }

    /// Whether the title says that the plan is an example, or must not be fired for another reason.
    pub fn is_titled_example(&self) -> bool {
        let words = [
            "example",
            "пример",
            "not to be fired",
            "do not fire",
            "not to fire",
            "draft",
            "черновик",
            "beispiel",
            "ejemplo",
            "entwurf",
            "borrador",
            "учебн",
            "übung",
            "не взрывать",
        ];
        let is_said = |title: &str| words.iter().any(|word| names::says(title, word));
        self.title.as_deref().is_some_and(is_said)
    }

    /// Name of the example with the same tires, cables, ground, holes and launches, to the last digit. No other site has the same.
    pub fn example_of_site(&self) -> Option<&'static str> {
        examples().iter().find(|(_, example)| self.has_site_of(example)).map(|(name, _)| *name)
    }

    fn has_site_of(&self, other: &Plan) -> bool {
        PARTS.iter().all(|(_, is_alike)| is_alike(self, other))
    }

    /// An example that this plan differs from in one part alone, and the other parts: somebody began with it, and may have put in little
    /// of his own. `None` for an example itself.
    pub fn parts_of_example(&self) -> Option<(&'static str, Vec<&'static str>)> {
        if self.is_example() {
            return None;
        }
        examples().iter().find_map(|(name, example)| {
            let unlike = PARTS.iter().filter(|(_, is_alike)| !is_alike(self, example)).map(|(part, _)| *part);
            // A second part that differs ends the search: screens ask at every repaint, and the launches of a large plan take long.
            let unlike = unlike.take(2).exactly_one().ok()?;
            let alike = PARTS.iter().map(|(part, _)| *part).filter(|part| *part != unlike);
            Some((*name, alike.collect()))
        })
    }

    /// Targets and launches of each blast row, sorted. Names, the order of the rows, and values that decide no launch do not count.
    fn launched(&self) -> Vec<String> {
        let of_row = |row: &BlastRow| {
            let mut targets = row.targets.clone();
            targets.launches_mut().into_iter().for_each(|launch| {
                (launch.charge_kg, launch.stemming_m) = (None, None);
                (launch.hole_diameter_mm, launch.push_depth_m) = (None, None);
            });
            format!("{targets:?}")
        };
        sorted(self.blast_rows.iter().map(of_row))
    }
}

/// Whether two plans have the same part of a site.
type IsAlike = fn(&Plan, &Plan) -> bool;

/// The parts of a site, and what compares them; what takes long comes last.
const PARTS: [(&str, IsAlike); 5] = [
    ("shelter", |one, other| one.layout == other.layout),
    ("tires", |one, other| one.tire == other.tire),
    ("cables", |one, other| one.cable == other.cable),
    ("ground", |one, other| one.ground == other.ground),
    ("holes and launches", |one, other| one.launched() == other.launched()),
];

/// The examples, parsed once.
fn examples() -> &'static [(&'static str, Plan)] {
    static PLANS: OnceLock<Vec<(&str, Plan)>> = OnceLock::new();
    PLANS.get_or_init(|| {
        let plan = |(name, text): &(&'static str, &str)| Some((*name, Plan::parse(name, text).ok()?));
        EXAMPLES.iter().filter_map(plan).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_example_stays_one_under_any_title_limits_and_delays() {
        for (name, text) in EXAMPLES {
            let mut plan = Plan::parse(name, text).expect("a plan that is right");
            plan.title = Some("North pit, 12 May".to_owned());
            plan.limits.flight_height_m += 1.0;
            plan.delays.truncate(1);
            plan.fitted_from = vec!["0".to_owned()];
            plan.blast_rows.reverse();
            plan.blast_rows[0].name = "A".to_owned();
            plan.launches_mut().for_each(|launch| launch.charge_kg = Some(12.0));
            assert!(plan.is_example(), "{name}");
            assert_eq!(plan.example_of_site(), Some(*name));
            assert_eq!(plan.parts_of_example(), None, "it is one");
            plan.tire.mass_kg += 1.0;
            assert!(!plan.is_example(), "{name}, with a tire of its own");
            // One number of its own makes no site of an example.
            let (of, parts) = plan.parts_of_example().expect("most of an example");
            assert_eq!((of, parts), (*name, vec!["shelter", "cables", "ground", "holes and launches"]));
            plan.ground.friction += 0.01;
            assert_eq!(plan.parts_of_example(), None, "{name}");
        }
    }
}
