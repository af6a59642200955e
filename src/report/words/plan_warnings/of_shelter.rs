//! Warnings about tires, cables and ties that do not go together, or that no site has.

use std::collections::BTreeSet;

use crate::plan::Layout;
use crate::plan::assumed::is_assumed;
use crate::plan::keys::{cable, uncertainty};
use crate::report::language::{phrase, say};
use crate::ropes::{Kind, catalogue};
use crate::study::Case;
use crate::units;

/// Warnings about tires and cables that the signer confirms.
pub(super) fn warnings(case: &Case) -> Vec<String> {
    let single = [
        whole_rope_held(case),
        odd_rope(case),
        fibre_too_sure(case),
        splice_too_good(case),
        centre_to_centre(case),
        odd_tires(case),
        tied_to_nothing(case),
        far_ties(case),
        slope(case),
    ];
    let several = [softened(case)];
    single.into_iter().flatten().chain(several.into_iter().flatten()).collect()
}

/// Least and greatest elongation at which ropes break: first wire, chain and stiff fibres, then polyester, polyamide and the like.
const ELONGATION: [[f64; 2]; 2] = [[0.005, 0.04], [0.08, 0.5]];

/// Elongation at which a rope breaks that the plan does not take from the catalogue, and the kind of rope with such an elongation.
/// `None` for a rope of the catalogue.
fn own_rope(case: &Case) -> Option<(f64, Option<&'static str>)> {
    let cable = &case.plan.cable;
    let whole = cable.breaking_force_kn / (1e-2 * cable.termination_percent);
    let elongation = whole / cable.axial_stiffness_kn;
    let kinds = ELONGATION.iter().zip(["a rope of steel", "a rope of fibre"]);
    let mut kinds = kinds.filter(|([low, high], _)| (*low..=*high).contains(&elongation));
    cable.rope.is_none().then(|| (elongation, kinds.next().map(|(_, kind)| kind)))
}

/// Warning that no rope breaks at the elongation at which the plan's rope does.
fn odd_rope(case: &Case) -> Option<String> {
    let (elongation, kind) = own_rope(case)?;
    let told = units::percent(elongation, 1);
    kind.is_none().then(|| say!("by stiffness and breaking force the rope breaks when it is {told} longer, as no rope does: a slip of the pen?", told))
}

/// Line with the kind that the plan's own rope would be: a slip of ten in stiffness or strength turns one kind into the other.
pub fn kind_of_own_rope(case: &Case) -> Option<String> {
    let (elongation, kind) = own_rope(case)?;
    let (told, kind) = (units::percent(elongation, 1), phrase(kind?));
    Some(say!(
        "by stiffness and breaking force the rope breaks when it is {told} longer, as {kind} does: is it one?",
        told,
        kind
    ))
}

/// Warning that the ends of a rope are taken to hold all that the rope holds, because the plan names no termination.
fn whole_rope_held(case: &Case) -> Option<String> {
    let cable = &case.plan.cable;
    let is_whole = cable.termination.is_none() && cable.termination_percent == 100.0;
    let text = "the ends of the cables are taken to hold all that the rope holds, as no clip or splice does: name the `termination`, see `shelter ropes`";
    (is_whole && cable.rope.is_some()).then(|| phrase(text).to_owned())
}

/// Warnings that cables are taken as softer than their rope. A guess of end stiffness or damping may cut forces to a third, and no
/// film of a height shows it.
fn softened(case: &Case) -> Vec<String> {
    let cable = &case.plan.cable;
    let ends = cable.end_stiffness_kn_m.map(|stiffness| (cable::END_STIFFNESS_KN_M.name, stiffness));
    let damping =
        Some((cable::DAMPING_PERCENT.name, cable.damping_percent)).filter(|(_, percent)| *percent > 0.0);
    let warning = |(name, value): (&str, f64)| {
        say!(
            "`{name} = {value}` changes the force of every cable, and a guess may cut it to a third: was it measured?",
            name,
            value
        )
    };
    damping.into_iter().chain(ends).map(warning).collect()
}

/// Range about the stiffness of its maker in which a rope of fibre may lie [%], as new plans state it.
const FIBRE_RANGE_PERCENT: [f64; 2] = [-20.0, 50.0];
/// Greatest share of its strength that a splice leaves a rope of fibre [%] (FM 55-501).
const BEST_SPLICE_PERCENT: f64 = 90.0;

/// Whether the rope is one of fibre from the catalogue.
fn is_fibre(case: &Case) -> bool {
    let rope = case.plan.cable.rope.as_deref().and_then(|name| catalogue().find(name));
    rope.is_some_and(|rope| rope.kind == Kind::FibreRope)
}

/// Warning that the ends of a rope of fibre hold more than the best splice.
fn splice_too_good(case: &Case) -> Option<String> {
    let percent = case.plan.cable.termination_percent;
    // That ends hold all is asked about by itself.
    let is_odd = percent > BEST_SPLICE_PERCENT && percent < 100.0 && is_fibre(case);
    is_odd.then(|| say!("the ends hold {percent} % of the rope, and a well made splice of fibre 70 to 90 %: were they pulled?", percent))
}

/// Warning that the stiffness of a rope of fibre is taken as known as well as that of steel: the range may be that of the rope before.
fn fibre_too_sure(case: &Case) -> Option<String> {
    let [low, high] = case.plan.uncertainty.axial_stiffness_percent;
    let is_sure = low > FIBRE_RANGE_PERCENT[0] || high < FIBRE_RANGE_PERCENT[1];
    // A range that is marked as assumed has a box already.
    let is_marked = || is_assumed(&case.source.text, &uncertainty::AXIAL_STIFFNESS_PERCENT);
    (is_sure && is_fibre(case) && !is_marked()).then(|| {
        say!(
            "a rope of fibre may be 20 % softer and 50 % stiffer than its maker says, the plan says {low} to {high} %: was it pulled?",
            low,
            high
        )
    })
}

/// Warning that cables run from centre to centre, as on no site.
fn centre_to_centre(case: &Case) -> Option<String> {
    let text = "cables run from centre to centre, as `outer_diameter_m` is 0: those from rim to rim are shorter and pull harder";
    (case.plan.tire.outer_diameter_m == 0.0 && !case.scene().cables.is_empty())
        .then(|| phrase(text).to_owned())
}

/// Least and greatest mass of a tire over the cube of its diameter [kg/m³]. New tires of 1.1 to 4 m have 53 to 116; worn tires
/// weigh a quarter less.
const MASS_OF_CUBE: [f64; 2] = [35.0, 130.0];

/// Indices of the tires over holes.
fn launched_tires(case: &Case) -> BTreeSet<usize> {
    case.shots.first().into_iter().flat_map(|shot| &shot.firings).map(|firing| firing.tire).collect()
}

/// Warning that a tire of the plan has a mass that no tire of the plan's diameter has.
fn odd_tires(case: &Case) -> Option<String> {
    let diameter_m = case.plan.tire.outer_diameter_m;
    if diameter_m == 0.0 {
        return None;
    }
    let [low, high] = MASS_OF_CUBE.map(|density| density * diameter_m.powi(3));
    let odd = case.scene().mass.iter().find(|mass| !(low..=high).contains(*mass))?;
    let [odd, low, high] = [*odd, low, high].map(|mass| units::rounded(mass, 0));
    Some(say!(
        "tires {diameter_m} m across have {low} to {high} kg, and one of the plan has {odd} kg: a slip of the pen?",
        diameter_m,
        low,
        high,
        odd
    ))
}

/// Warning that launched tires are tied to nothing, or that the shelter has several parts that no cable ties together.
fn tied_to_nothing(case: &Case) -> Option<String> {
    let scene = case.scene();
    let count = scene.tire_count();
    if count == 1 {
        return None;
    }
    // `part` leads from each tire to the tire that stands for its part. The loop shortens these ways, because screens ask for this
    // warning as they are drawn.
    let (mut part, mut is_tied): (Vec<usize>, _) = ((0..count).collect(), vec![false; count]);
    for cable in &scene.cables {
        let [a, b] = cable.ends.map(|mut tire| {
            is_tied[tire] = true;
            while part[tire] != tire {
                part[tire] = part[part[tire]];
                tire = part[tire];
            }
            tire
        });
        part[a.max(b)] = a.min(b);
    }
    let launched = launched_tires(case);
    let loose = launched.iter().filter(|&&tire| !is_tied[tire]).count();
    let parts = part.iter().enumerate().filter(|(tire, part)| tire == *part).count();
    match (loose, parts) {
        (0, 1) => None,
        (0, _) => Some(say!("the shelter is of {parts} parts that no cable ties together", parts)),
        _ => Some(say!("{loose} of {} tires over holes are tied to nothing", loose, launched.len())),
    }
}

/// Length of a tie of a list over the middle length, from which the plan gets a warning; and the length [m] that is far by itself.
const FAR_TIE: f64 = 2.5;
const FAR_TIE_M: f64 = 10.0;

/// Warning that a list ties tires that lie far apart.
fn far_ties(case: &Case) -> Option<String> {
    let Layout::List { tires, cables } = &case.plan.layout else { return None };
    let length = |&(a, b): &(usize, usize)| (tires[a].x_m - tires[b].x_m).hypot(tires[a].y_m - tires[b].y_m);
    let mut lengths: Vec<f64> = cables.iter().map(length).collect();
    lengths.sort_by(f64::total_cmp);
    let (middle, far) = (*lengths.get(lengths.len() / 2)?, *lengths.last()?);
    let is_far = far > FAR_TIE_M || far > FAR_TIE * middle;
    is_far.then(|| say!("a cable ties tires {} m apart: a slip of the pen?", units::rounded(far, 1)))
}

/// Line with the slope of the ground in percent and degrees, and its direction. A slip shows there: degrees written for percent are
/// half of the slope.
fn slope(case: &Case) -> Option<String> {
    let ground = &case.plan.ground;
    let steep = units::rounded((1e-2 * ground.slope_percent).atan().to_degrees(), 1);
    let text = say!(
        "the ground slopes by {} %, which is {steep}°, downhill toward {}° from +x: is it so?",
        ground.slope_percent,
        steep,
        ground.slope_toward_deg
    );
    (ground.slope_percent > 0.0).then_some(text)
}

#[cfg(test)]
mod tests {
    use itertools::Itertools;

    use super::super::tests::parsed;
    use super::super::to_be_looked_at;
    use super::*;
    use crate::plan::Plan;

    /// Each of these changes turns FAIL into a pass, and none is out of the range of its own key: a rope ten times softer or
    /// stronger, a tire of a third of the mass, cables longer than on any site, and shelters that are not tied.
    #[test]
    fn values_that_do_not_go_together_are_told_and_confirmed() {
        let site = include_str!("../../../../plans/amur-three-rows.toml");
        let told = |old: &str, new: &str| {
            assert!(site.contains(old), "{old}");
            let case = parsed(site.replacen(old, new, 1));
            to_be_looked_at(&case).into_iter().chain(kind_of_own_rope(&case)).join("\n")
        };
        let rope = "rope = \"Polyester 24\"";
        let own = |stiffness: f64, breaking: f64| {
            told(rope, &format!("axial_stiffness_kn = {stiffness}\nbreaking_force_kn = {breaking}"))
        };
        assert_eq!(told(rope, rope), "");
        let (fibre, steel) = ("as a rope of fibre does: is it one?", "as a rope of steel does: is it one?");
        for (stiffness, breaking, kind) in [
            (628.0, 102.0, fibre),
            (62.8, 102.0, "162.4 % longer, as no rope does"),
            (628.0, 1020.0, "162.4 % longer, as no rope does"),
            (62800.0, 102.0, "0.2 % longer, as no rope does"),
            (7193.0, 118.0, steel),
            // Steel that is ten times too soft or too strong looks like fibre.
            (719.3, 118.0, fibre),
            (7193.0, 1180.0, fibre),
            (2000.0, 118.0, "5.9 % longer, as no rope does"),
        ] {
            assert!(own(stiffness, breaking).contains(kind), "{}", own(stiffness, breaking));
            assert_eq!(own(stiffness, breaking).contains("is it one?"), kind == fibre || kind == steel);
        }
        let light = told("mass_kg = 280 ", "mass_kg = 85 ");
        assert!(
            light.contains("tires 1.6 m across have 143 to 532 kg, and one of the plan has 85 kg"),
            "{light}"
        );
        for diameter in ["outer_diameter_m = 0 ", ""] {
            assert!(told("outer_diameter_m = 1.6 ", diameter).contains("from centre to centre"));
        }
        let links = "links = [\"row\", \"column\", \"diagonal\"]";
        assert!(told(links, "links = []").contains("30 of 30 tires over holes are tied to nothing"));
        assert!(
            told(links, "links = [\"row\"]")
                .contains("the shelter is of 5 parts that no cable ties together")
        );
        assert_eq!(told(links, "links = [\"row\", \"column\"]"), "");
    }

    /// Softer cables turned a shot that mostly fails into a page "To be fired".
    #[test]
    fn softer_cables_are_asked_about() {
        let site = include_str!("../../../../plans/amur-three-rows.toml");
        let told = |old: &str, new: &str| {
            assert!(site.contains(old), "{old}");
            to_be_looked_at(&parsed(site.replacen(old, new, 1))).join("\n")
        };
        let of_cables = |softer: &str| told("[cable]\n", &format!("[cable]\n{softer}\n"));
        assert_eq!(of_cables("damping_percent = 0"), "");
        let asked = "changes the force of every cable, and a guess may cut it to a third: was it measured?";
        for softer in ["damping_percent = 20", "end_stiffness_kn_m = 600"] {
            assert_eq!(of_cables(softer), format!("`{softer}` {asked}"));
        }
    }

    /// `size` writes the name of another rope, and the range of steel stayed: a clean page. Ballast of 2600 kg had one, too.
    #[test]
    fn a_range_of_another_rope_and_ballast_too_heavy_are_asked_about() {
        let site = include_str!("../../../../plans/amur-three-rows.toml");
        let range = "axial_stiffness_percent = [-5, 5]  # assumed: take it from the certificate of the rope";
        assert!(site.contains(range));
        let told = |new: &str| to_be_looked_at(&parsed(site.replacen(range, new, 1))).join("\n");
        let asked = "a rope of fibre may be 20 % softer and 50 % stiffer than its maker says, the plan says -5 to 5 %: was it pulled?";
        assert_eq!(told("axial_stiffness_percent = [-5, 5]"), asked);
        for (range, is_asked) in
            [("[-20, 50]", false), ("[-50, 20]", true), ("[-20, 49]", true), ("[-19, 50]", true)]
        {
            assert_eq!(!told(&format!("axial_stiffness_percent = {range}")).is_empty(), is_asked, "{range}");
        }
        let ends = |percent: &str| {
            let text =
                site.replacen("termination_percent = 70", &format!("termination_percent = {percent}"), 1);
            to_be_looked_at(&parsed(text)).join("\n").contains("a well made splice of fibre 70 to 90 %")
        };
        assert_eq!(["90", "91", "99", "100"].map(ends), [false, true, true, false]);
        assert_eq!(told(range), "");
        let list = "shelter = { layout = \"list\", tire = [{ x_m = 0, y_m = 0 }, { x_m = 2.6, y_m = 0, mass_kg = 2600 }], cable = [{ from = 1, to = 2 }] }\n\
                    tire = { mass_kg = 280, outer_diameter_m = 1.6 }\ncable = { rope = \"Polyester 24\", termination_percent = 70 }\n\
                    ground = { friction = 0.5 }\nblast_row = [{ name = \"1\", under_tires = [1], launch_m_s = 5 }]\n\
                    limits = { flight_height_m = 1.5, cable_safety_factor = 1.5 }\ndelay = [{ name = \"0 ms\", interval_ms = 0 }]\n";
        let told = to_be_looked_at(&parsed(list.to_owned())).join("\n");
        assert!(told.contains("and one of the plan has 2600 kg: a slip of the pen?"), "{told}");
    }

    #[test]
    fn a_slope_is_told_in_degrees() {
        let site = include_str!("../../../../plans/amur-three-rows.toml");
        let told = |more: &str| to_be_looked_at(&parsed(site.replacen("[ground]\n", more, 1))).join("\n");
        let slope = "the ground slopes by 15 %, which is 8.5°, downhill toward 270° from +x: is it so?";
        assert_eq!(told("[ground]\nslope_percent = 15\nslope_toward_deg = 270\n"), slope);
        assert_eq!(told("[ground]\n"), "");
    }

    /// In this list 24 m of rope tie tires that lie 26 m apart, as on no site.
    #[test]
    fn a_list_that_ties_tires_far_apart_is_told() {
        let told = |x: f64| {
            let text = format!(
                r#"
shelter = {{ layout = "list", tire = [{{ x_m = 0, y_m = 0 }}, {{ x_m = {x}, y_m = 0 }}], cable = [{{ from = 1, to = 2 }}] }}
tire = {{ mass_kg = 280, outer_diameter_m = 1.6 }}
cable = {{ rope = "Polyester 24", termination_percent = 70 }}
ground = {{ friction = 0.5 }}
blast_row = [{{ name = "1", under_tires = [1], launch_m_s = 4 }}]
limits = {{ flight_height_m = 2, cable_safety_factor = 1.5 }}
delay = [{{ name = "1", interval_ms = 0 }}]
"#
            );
            let plan = Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
            to_be_looked_at(&Case::new(plan))
                .into_iter()
                .filter(|line| line.contains("apart"))
                .collect::<Vec<_>>()
        };
        assert_eq!(told(26.0), ["a cable ties tires 26.0 m apart: a slip of the pen?"]);
        assert_eq!(told(10.0), [""; 0]);
    }
}
