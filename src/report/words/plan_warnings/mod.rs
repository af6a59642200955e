//! Warnings of a plan, whatever a study finds: slips of the pen, and values that nobody on a site knows so well.

mod of_holes;
mod of_launch;
mod of_shelter;

use itertools::Itertools;

use super::false_names;
use crate::plan::keys::Key;
use crate::plan::usual::Unusual;
use crate::report::language::{phrase, say};
use crate::study::Case;
pub use of_launch::without_film;
pub use of_shelter::kind_of_own_rope;

/// Warnings of a plan, whatever a study finds: a retitled example, an estimated launch, inputs left out, values to look at, unusual
/// values, and ranges of `[uncertainty]` that leave out the plan's own value.
pub fn of_plan(case: &Case) -> Vec<String> {
    let unusual = case.plan.unusual();
    let unusual = unusual.iter().map(|Unusual { section, key, value, usual: [low, high], is_gap }| {
        if *is_gap {
            return say!(
                "rows fire {value} ms apart: is one of the times of `{}` in seconds?",
                value,
                key.name
            );
        }
        let (name, title, unit) = (key.name, section.title, key.kind.unit());
        let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
        say!(
            "`{name} = {value}` of {title} is unusual, a slip of the pen? Usual are {low} to {high}{unit}",
            name,
            value,
            title,
            low,
            high,
            unit
        )
    });
    let warning = |(key, [low, high], own): (&Key, [f64; 2], f64)| {
        let name = key.name;
        say!(
            "`{name} = [{low}, {high}]` of [uncertainty] leaves out {own}, the plan's own: no sample is like the nominal shot",
            name,
            low,
            high,
            own
        )
    };
    let ranges = case.plan.ranges_beside_the_plan().into_iter().map(warning);
    retitled_example(case)
        .into_iter()
        .chain(of_launch::launch_estimated(case))
        .chain(inputs_left_out(case))
        .chain(to_be_looked_at(case))
        .chain(unusual)
        .chain(ranges)
        .collect()
}

/// Warnings of a plan that the signer confirms as they are: somebody may have a reason, or the value is a slip.
pub fn to_be_looked_at(case: &Case) -> Vec<String> {
    let of_names = false_names::warnings(&case.plan).collect();
    [of_launch::warnings(case), of_shelter::warnings(case), of_holes::warnings(case), of_names].concat()
}

/// Warning that the plan is an example under another title.
fn retitled_example(case: &Case) -> Option<String> {
    let name = if case.plan.is_titled_example() { None } else { case.plan.example_of_site() }?;
    Some(say!(
        "EXAMPLE: tires, cables, ground, holes and launches are those of `{name}`, so nothing of it is to be fired: put in those of your site",
        name
    ))
}

/// Line that names the parts of a plan that are still those of an example, if most are.
pub fn of_example(case: &Case) -> Option<String> {
    let (name, parts) = case.plan.parts_of_example()?;
    let parts = parts.into_iter().map(phrase).join(", ");
    Some(say!("of the example `{name}` there are still: {parts}: are they those of your site?", name, parts))
}

/// Warning with the inputs that `[uncertainty]` leaves out.
fn inputs_left_out(case: &Case) -> Option<String> {
    let keys = case.plan.left_out.iter().map(|key| format!("`{key}`")).join(", ");
    let text = || say!("[uncertainty] leaves out {keys}: small values of the program count, not yours", keys);
    (!keys.is_empty()).then(text)
}

/// Warning with the inputs that `[uncertainty]` says are exact, or nearly: nothing on a site is exact. The warning stands with the
/// results of a study. On screens these inputs count as assumed.
pub fn nearly_exact_inputs(case: &Case) -> Option<String> {
    let all = case.plan.nearly_exact_inputs();
    let mut named = all.iter().take(MOST_NAMED).map(|key| format!("`{key}`")).join(", ");
    let more = all.len().saturating_sub(MOST_NAMED);
    if more > 0 {
        named += &say!(" and {more} more", more);
    }
    let text = || say!("[uncertainty] takes as exact, or nearly: {named}", named);
    (!all.is_empty()).then(text)
}

/// Most inputs that one sentence names.
const MOST_NAMED: usize = 2;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::{Plan, PlanSource};

    /// Case of a plan given as text, with its comments.
    pub(super) fn parsed(text: String) -> Case {
        let source = PlanSource { text, ..PlanSource::default() };
        Case::parse(source).unwrap_or_else(|mistakes| panic!("{mistakes}"))
    }

    /// The warning names an input that a 0, or a range of one value, keeps out of the samples. A rope without a named termination
    /// gets a warning, too.
    #[test]
    fn what_is_taken_as_exact_or_whole_is_told() {
        let told = |changes: &[(&str, &str)]| {
            let text = include_str!("../../../../plans/amur-three-rows.toml").to_owned();
            let change = |text: String, (old, new): &(&str, &str)| {
                assert!(text.contains(old), "{old}");
                text.replacen(old, new, 1)
            };
            let text = changes.iter().fold(text, change);
            let plan = Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
            let case = Case::new(plan);
            of_plan(&case)
                .into_iter()
                .chain(nearly_exact_inputs(&case))
                .filter(|line| line.contains("exact") || line.contains("hold all"))
                .collect::<Vec<_>>()
        };
        assert_eq!(told(&[]), [""; 0]);
        let exact = "[uncertainty] takes as exact, or nearly: ";
        assert_eq!(
            told(&[("hole_position_m = 0.05", "hole_position_m = 0")]),
            [format!("{exact}`hole_position_m`")]
        );
        for (spread, is_told) in [("0.024", true), ("0.025", false)] {
            let told = told(&[("hole_position_m = 0.05", &format!("hole_position_m = {spread}"))]);
            assert_eq!(!told.is_empty(), is_told, "{spread}: {told:?}");
        }
        let nearly = ("axial_stiffness_percent = [-5, 5]", "axial_stiffness_percent = [-0.4, 0.4]");
        assert_eq!(told(&[nearly]), [format!("{exact}`axial_stiffness_percent`")]);
        let times = ("detonator = \"electronic\"", "delay_sd_ms = 0");
        let friction = ("friction = [0.4, 0.6]", "friction = [0.5, 0.5]");
        assert_eq!(told(&[times, friction]), [format!("{exact}`delay_sd_ms`, `friction`")]);
        let named = "termination_percent = 70 ";
        for whole in ["termination_percent = 100 ", ""] {
            assert!(told(&[(named, whole)])[0].contains("hold all that the rope holds"));
        }
        assert_eq!(told(&[(named, "termination_percent = 90 ")]), [""; 0]);
    }
}
