//! Warnings of a plan, whatever is found: slips of the pen, and what nobody on a site knows so well.

use std::collections::BTreeSet;

use itertools::Itertools;

use super::false_names;
use crate::choice::HoleOrder;
use crate::plan::assumed::assumed_values;
use crate::plan::keys::{Key, cable, uncertainty};
use crate::plan::observations::fitted_values;
use crate::plan::usual::Unusual;
use crate::plan::{BlastRow, HoleTiming, Layout};
use crate::report::language::{phrase, say};
use crate::scene::{Firing, holes_of_unsure_order};
use crate::sorting::{sorted_by, sorted_by_key};
use crate::study::Case;
use crate::study::hole_places::{HoleBesideTire, holes_beside_tires};
use crate::study::launch::{Blast, LaunchEstimates, fastest_launch};
use crate::units;

/// Warnings of a plan, whatever is found: values that are not usual, and ranges of `[uncertainty]` that leave out what the plan
/// itself says.
pub fn of_plan(case: &Case) -> Vec<String> {
    let unusual = case.plan.unusual();
    let unusual = unusual.iter().map(|Unusual { section, key, value, usual: [low, high], is_apart }| {
        if *is_apart {
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
        .chain(launch_estimated(case))
        .chain(inputs_left_out(case))
        .chain(to_be_looked_at(case))
        .chain(unusual)
        .chain(ranges)
        .collect()
}

/// Warnings of a plan that who signs for its shot confirms as they are: somebody may have a reason, or it is a slip.
pub fn to_be_looked_at(case: &Case) -> impl Iterator<Item = String> {
    let of_launch = launch_too_sure(case).into_iter().chain(launch_without_film(case));
    let of_launch = of_launch.chain(fitted_to_few(case));
    let of_launch = of_launch.chain(launch_below_estimate(case)).chain(launches_lighter_tire(case));
    let of_shelter = whole_rope_held(case).into_iter().chain(odd_rope(case)).chain(centre_to_centre(case));
    let of_shelter = of_shelter.chain(odd_tires(case)).chain(tied_to_nothing(case)).chain(far_ties(case));
    let of_shelter = of_shelter.chain(softened(case)).chain(gap_in_row(case));
    let of_delays = no_in_hole_scatter(case).into_iter().chain(dud_alone(case));
    let of_delays = of_delays.chain(false_names::warnings(&case.plan));
    let of_delays = of_delays.chain(order_by_survey(case)).chain(listed_otherwise(case));
    let of_holes = beside_tires(case).into_iter().chain(under_same_tires(case)).chain(tilted_to_x(case));
    of_launch.chain(of_shelter).chain(of_delays).chain(of_holes)
}

/// That the plan is an example under another title.
fn retitled_example(case: &Case) -> Option<String> {
    let name = if case.plan.is_titled_example() { None } else { case.plan.example_of_site() }?;
    Some(say!(
        "EXAMPLE: tires, cables, ground, holes and launches are those of `{name}`, so nothing of it is to be fired: put in those of your site",
        name
    ))
}

/// Which inputs `[uncertainty]` leaves out.
fn inputs_left_out(case: &Case) -> Option<String> {
    let keys = case.plan.left_out.iter().map(|key| format!("`{key}`")).join(", ");
    let text = || say!("[uncertainty] leaves out {keys}: small values of the program count, not yours", keys);
    (!keys.is_empty()).then(text)
}

/// Which inputs `[uncertainty]` says are exact, or nearly, as nothing on a site is: told with what a study found of the plan. On screens
/// they count as assumed.
pub fn taken_as_exact(case: &Case) -> Option<String> {
    let all = case.plan.taken_as_exact();
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

/// Elongations at which ropes break: of wire, chain and stiff fibres, and of polyester, polyamide and the like.
const ELONGATION: [[f64; 2]; 2] = [[0.005, 0.04], [0.08, 0.5]];

/// Elongation at which the rope of a plan breaks that names none of the catalogue, and of what kind it would be.
fn own_rope(case: &Case) -> Option<(f64, Option<&'static str>)> {
    let cable = &case.plan.cable;
    let whole = cable.breaking_force_kn / (1e-2 * cable.termination_percent);
    let elongation = whole / cable.axial_stiffness_kn;
    let kinds = ELONGATION.iter().zip(["a rope of steel", "a rope of fibre"]);
    let mut kinds = kinds.filter(|([low, high], _)| (*low..=*high).contains(&elongation));
    cable.rope.is_none().then(|| (elongation, kinds.next().map(|(_, kind)| kind)))
}

/// That no rope breaks at the elongation at which that of the plan does.
fn odd_rope(case: &Case) -> Option<String> {
    let (elongation, kind) = own_rope(case)?;
    let told = units::percent(elongation, 1);
    kind.is_none().then(|| say!("by stiffness and breaking force the rope breaks when it is {told} longer, as no rope does: a slip of the pen?", told))
}

/// Of what kind the rope would be that is none of the catalogue: a slip of ten in stiffness or strength makes one kind of the other.
pub fn kind_of_own_rope(case: &Case) -> Option<String> {
    let (elongation, kind) = own_rope(case)?;
    let (told, kind) = (units::percent(elongation, 1), phrase(kind?));
    Some(say!(
        "by stiffness and breaking force the rope breaks when it is {told} longer, as {kind} does: is it one?",
        told,
        kind
    ))
}

/// That cables run from centre to centre, as those of no site do.
fn centre_to_centre(case: &Case) -> Option<String> {
    let text = "cables run from centre to centre, as `outer_diameter_m` is 0: those from rim to rim are shorter and pull harder";
    (case.plan.tire.outer_diameter_m == 0.0 && !case.scene().cables.is_empty())
        .then(|| phrase(text).to_owned())
}

/// Mass of a tire over the cube of its diameter [kg/m³]: 53 to 116 of new ones of 1.1 to 4 m, and worn ones weigh a quarter less.
const MASS_OF_CUBE: [f64; 2] = [35.0, 130.0];

/// Tires over holes.
fn launched_tires(case: &Case) -> BTreeSet<usize> {
    case.shots.first().into_iter().flat_map(|shot| &shot.firings).map(|firing| firing.tire).collect()
}

/// That no tire of the plan's diameter has a mass of the plan.
fn odd_tires(case: &Case) -> Option<String> {
    let diameter_m = case.plan.tire.outer_diameter_m;
    if diameter_m == 0.0 {
        return None;
    }
    let [low, high] = MASS_OF_CUBE.map(|density| density * diameter_m.powi(3));
    // What lies over no hole may be other ballast.
    let launched = launched_tires(case);
    let is_odd = |&(tire, mass): &(usize, &f64)| *mass < low || *mass > high && launched.contains(&tire);
    let (_, odd) = case.scene().mass.iter().enumerate().find(is_odd)?;
    let [odd, low, high] = [*odd, low, high].map(|mass| units::rounded(mass, 0));
    Some(say!(
        "tires {diameter_m} m across have {low} to {high} kg, and one of the plan has {odd} kg: a slip of the pen?",
        diameter_m,
        low,
        high,
        odd
    ))
}

/// That cables tie launched tires to nothing, or the shelter is of several parts.
fn tied_to_nothing(case: &Case) -> Option<String> {
    let scene = case.scene();
    let count = scene.tire_count();
    if count == 1 {
        return None;
    }
    // The tire that stands for the part of each, or one nearer to it; screens ask for it as they are drawn.
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

/// How many times as long as the middle one a tie of a list is that is told, and from what distance each [m].
const FAR_TIE: f64 = 2.5;
const FAR_TIE_M: f64 = 10.0;

/// That a list ties tires that lie far apart.
fn far_ties(case: &Case) -> Option<String> {
    let Layout::List { tires, cables } = &case.plan.layout else { return None };
    let length = |&(a, b): &(usize, usize)| (tires[a].x_m - tires[b].x_m).hypot(tires[a].y_m - tires[b].y_m);
    let mut lengths: Vec<f64> = cables.iter().map(length).collect();
    lengths.sort_by(f64::total_cmp);
    let (middle, far) = (*lengths.get(lengths.len() / 2)?, *lengths.last()?);
    let is_far = far > FAR_TIE_M || far > FAR_TIE * middle;
    is_far.then(|| say!("a cable ties tires {} m apart: a slip of the pen?", units::rounded(far, 1)))
}

/// That cables are taken as softer than their rope: a guess of either value may cut forces to a third, and no film of a height tells it.
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

/// How many times as long as the middle one a gap between the holes of a row is that is told. Of an even number of gaps the shorter middle one
/// counts: of three holes left of four, one of two gaps is wide.
const WIDE_GAP: f64 = 1.8;

/// Rows that are listed hole by hole, and of which one may be missing: what is not in the plan is fired all the same.
fn gap_in_row(case: &Case) -> Vec<String> {
    let (scene, Some(shot)) = (case.scene(), case.shots.first()) else { return Vec::new() };
    let place = |firing: &Firing| scene.position[firing.tire].xy() - firing.line.offset;
    let warning = |(row, blast_row): (usize, &BlastRow)| {
        let of_row = shot.firings.iter().filter(|firing| firing.row == row);
        let from_left = sorted_by_key(of_row, |firing| firing.from_left);
        let apart = |pair: &[&Firing]| (place(pair[1]) - place(pair[0])).norm();
        let gaps = sorted_by(from_left.windows(2), |a, b| apart(a).total_cmp(&apart(b)));
        let (middle, widest) = (apart(gaps.get(gaps.len().saturating_sub(1) / 2)?), *gaps.last()?);
        let text = say!(
            "row {name}: holes {one} and {other} lie {apart} m apart, others {usual} m: is one missing between them?",
            blast_row.name,
            widest[0].number + 1,
            widest[1].number + 1,
            units::rounded(apart(widest), 1),
            units::rounded(middle, 1)
        );
        (apart(widest) > WIDE_GAP * middle).then_some(text)
    };
    case.plan.blast_rows.iter().enumerate().filter_map(warning).collect()
}

/// That the ends of a rope are taken to hold all of what the rope holds, because the plan names no termination.
fn whole_rope_held(case: &Case) -> Option<String> {
    let cable = &case.plan.cable;
    let is_whole = cable.termination.is_none() && cable.termination_percent == 100.0;
    let text = "the ends of the cables are taken to hold all that the rope holds, as no clip or splice does: name the `termination`, see `shelter ropes`";
    (is_whole && cable.rope.is_some()).then(|| phrase(text).to_owned())
}

/// That no verdict passes on a launch velocity that nobody observed.
fn launch_estimated(case: &Case) -> Option<String> {
    let uncertainty = &case.plan.uncertainty;
    let percent = units::short(uncertainty.launch_common_percent);
    let text = say!(
        "launch estimated: `launch_common_percent = {percent}` says that nobody observed this velocity, so no option passes; \
         film a loose test tire or a covered shot, see `shelter launch`",
        percent
    );
    uncertainty.launch_is_estimated().then_some(text)
}

/// That the launch velocity is taken as surer than anybody can know it.
fn launch_too_sure(case: &Case) -> Option<String> {
    let uncertainty = &case.plan.uncertainty;
    let percent = units::short(uncertainty.launch_common_percent);
    let text = say!(
        "the launch velocity is taken as known to {percent} %, surer than any film: \
         write `launch_common_percent`, 50 for a guess, 10 for a filmed test tire, or what `shelter fit` finds",
        percent
    );
    case.plan.takes_launch_as_too_sure().then_some(text)
}

/// That no film is behind a launch velocity that is taken as surer than one filmed test tire leaves it. A value that is marked as assumed is
/// confirmed as such.
fn launch_without_film(case: &Case) -> Option<String> {
    let key = uncertainty::LAUNCH_COMMON_PERCENT.name;
    let percent = units::short(case.plan.uncertainty.launch_common_percent);
    let is_marked = || assumed_values(&case.source.text).any(|value| value.key() == Some(key));
    let is_told = case.plan.takes_launch_as_filmed() && !case.plan.takes_launch_as_too_sure() && !is_marked();
    is_told.then(|| {
        say!(
            "the launch velocity is taken as known to {percent} %, and no film was fitted: one filmed test tire leaves 10 %; \
             fit your films, see `shelter fit`",
            percent
        )
    })
}

/// That a plan was fitted to so few observations that chance may have made its launches.
fn fitted_to_few(case: &Case) -> Option<String> {
    let few = match fitted_values(&case.plan.fitted_from) {
        1 => phrase("ONE observation"),
        2 => phrase("two observations"),
        _ => return None,
    };
    Some(say!("the launches are fitted to {few}: one film of one tire tells little, film more shots", few))
}

/// That a tire of a list over a hole is lighter than that of `[tire]`: the plan's launch may have been seen on the heavier one.
fn launches_lighter_tire(case: &Case) -> Option<String> {
    let (scene, usual) = (case.scene(), case.plan.tire.mass_kg);
    let launched = case.shots.first()?.firings.iter().map(|firing| firing.tire);
    let lightest = launched.min_by(|a, b| scene.mass[*a].total_cmp(&scene.mass[*b]))?;
    let [mass, planned] = [scene.mass[lightest], usual].map(|mass| units::rounded(mass, 0));
    let text = say!(
        "tire {tire} over a hole has {mass} kg, that of [tire] {planned}: its launch is taken as written; was it filmed with so light a tire?",
        scene.tire_ids[lightest],
        mass,
        planned
    );
    (scene.mass[lightest] < 0.95 * usual).then_some(text)
}

/// That the fastest launch of the plan is slower than the middle of what its charge and stemming say, and no shot was fitted.
fn launch_below_estimate(case: &Case) -> Option<String> {
    let (plan, estimates) = (&case.plan, LaunchEstimates::new(&Blast::of_plan(&case.plan), None, &[]));
    let band = estimates.chosen()?.band;
    let fastest = fastest_launch(plan);
    let [speed, low_m_s, middle, high_m_s] =
        [fastest, band[0], band[1], band[2]].map(|speed| units::rounded(speed, 1));
    let text = say!(
        "`launch_m_s = {speed}` is slower than the middle of what charge and stemming say, {middle} ({low_m_s} to {high_m_s} m/s): was it filmed? See `shelter launch`",
        speed,
        middle,
        low_m_s,
        high_m_s
    );
    (fastest < band[1] && plan.fitted_from.is_empty()).then_some(text)
}

/// That pyrotechnic caps do not scatter in the holes.
fn no_in_hole_scatter(case: &Case) -> Option<String> {
    let text =
        "detonators are pyrotechnic, but `in_hole_delay_ms` is 0: no scatter inside the holes is drawn";
    case.plan.uncertainty.lacks_in_hole_scatter().then(|| phrase(text).to_owned())
}

/// That surface delays fire the holes, and a dud of some option takes none along.
fn dud_alone(case: &Case) -> Option<String> {
    let text = "surface delays fire one hole by the one before, but `fired_through` is not set: does a dud take none along?";
    let is_alone = case.plan.delays.iter().any(|delay| !delay.hole_timing.fired_through);
    (is_alone && case.plan.uncertainty.has_surface_delays()).then(|| phrase(text).to_owned())
}

/// Rows whose holes fire one after the other in an order that a survey of them decides.
fn order_by_survey(case: &Case) -> Vec<String> {
    if case.plan.delays.iter().all(|delay| delay.hole_timing.is_together()) {
        return Vec::new();
    }
    let rows = &case.plan.blast_rows;
    let unsure = holes_of_unsure_order(case.scene(), rows).into_iter().zip(rows);
    let warning = |(pair, row): (Option<[usize; 2]>, &BlastRow)| {
        let [one, other] = pair?.map(|hole| hole + 1);
        Some(say!(
            "row {name}: a survey decides which of its holes {one} and {other} counts as the left one, and so which fires first: \
             make a row of each line of holes",
            row.name,
            one,
            other
        ))
    };
    unsure.filter_map(warning).collect()
}

/// Rows whose holes fire one after the other from the left or the right, and are not listed from left to right: who wires them as listed
/// fires what nobody judged.
fn listed_otherwise(case: &Case) -> Vec<String> {
    let goes_by_side = |timing: &HoleTiming| {
        !timing.is_together() && matches!(timing.order, HoleOrder::Left | HoleOrder::Right)
    };
    let option = case.plan.delays.iter().position(|delay| goes_by_side(&delay.hole_timing));
    let Some(shot) = option.map(|option| &case.shots[option]) else { return Vec::new() };
    let warning = |(row, blast_row): (usize, &BlastRow)| {
        let of_row = shot.firings.iter().filter(|firing| firing.row == row);
        let holes = sorted_by_key(of_row, |firing| firing.number);
        let left = holes.iter().min_by_key(|firing| firing.from_left)?;
        let (name, hole, tire) = (&blast_row.name, left.number + 1, case.scene().tire_ids[left.tire]);
        let text = say!(
            "row {name}: its holes are not listed from left to right, and `hole_order` goes by their places: the left one is hole {hole}, tire {tire}",
            name,
            hole,
            tire
        );
        (!holes.is_sorted_by_key(|firing| firing.from_left)).then_some(text)
    };
    case.plan.blast_rows.iter().enumerate().filter_map(warning).collect()
}

/// Two rows with holes under the same tires: a row that was copied leaves another one out.
fn under_same_tires(case: &Case) -> Option<String> {
    let rows = &case.plan.blast_rows;
    let under = |row: usize| -> BTreeSet<usize> {
        let firings = case.shots.first().into_iter().flat_map(|shot| &shot.firings);
        firings.filter(|firing| firing.row == row).map(|firing| firing.tire).collect()
    };
    let tires: Vec<BTreeSet<usize>> = (0..rows.len()).map(under).collect();
    let mut pairs = (0..rows.len()).tuple_combinations();
    let (a, b) = pairs.find(|&(a, b)| !tires[a].is_disjoint(&tires[b]))?;
    let (one, other, count) = (&rows[a].name, &rows[b].name, tires[a].intersection(&tires[b]).count());
    Some(say!(
        "rows {one} and {other} have holes under the same tires, {count} of them: is one a copy?",
        one,
        other,
        count
    ))
}

/// That launches tilt toward the larger x, as they do where nobody says whither.
fn tilted_to_x(case: &Case) -> Option<String> {
    let mut tilted = case.plan.launches().filter(|launch| launch.tilt_deg > 0.0).peekable();
    let text = "launches tilt toward the larger x, as `tilt_toward_deg` is 0 or left out: do they?";
    (tilted.peek().is_some() && tilted.all(|launch| launch.tilt_toward_deg == 0.0))
        .then(|| phrase(text).to_owned())
}

/// Holes that lie beside their tires, or under none.
fn beside_tires(case: &Case) -> Vec<String> {
    let Some(shot) = case.shots.first() else { return Vec::new() };
    let holes = holes_beside_tires(case, shot);
    let told = |what: &str, among: &dyn Fn(&HoleBesideTire) -> bool| {
        let some: Vec<&HoleBesideTire> = holes.iter().filter(|hole| among(hole)).collect();
        let worst = some.iter().max_by(|a, b| a.away[0].total_cmp(&b.away[0]))?;
        let place = say!("row {}, hole {}", case.plan.blast_rows[worst.row].name, worst.number + 1);
        let away = units::rounded(worst.away[0], 2);
        let tire = case.scene().tire_ids[worst.tires[0]];
        let (some, all) = (some.len(), shot.firings.len());
        Some(say!(
            "{some} of {all} holes lie {what}: {place} is {away} m from tire {tire}",
            some,
            all,
            phrase(what),
            place,
            away,
            tire
        ))
    };
    let uncovered = told("under no tire, and the nearest gets the whole launch", &|hole| hole.is_uncovered);
    let beside = told("beside their tires, which are pushed aside", &|hole| {
        !hole.is_uncovered && !hole.may_be_the_next
    });
    let between = told("between two tires, and either may get the launch", &|hole| {
        hole.may_be_the_next && !hole.is_uncovered
    });
    [uncovered, between, beside].into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::{Plan, PlanSource};

    /// The plan of a text, with its comments.
    fn parsed(text: String) -> Case {
        let source = PlanSource { text, ..PlanSource::default() };
        Case::parse(source).unwrap_or_else(|mistakes| panic!("{mistakes}"))
    }

    /// What a 0 or a range of one value leaves out of the samples is named, and a rope whose ends nobody named.
    #[test]
    fn what_is_taken_as_exact_or_whole_is_told() {
        let told = |changes: &[(&str, &str)]| {
            let text = include_str!("../../../plans/amur-three-rows.toml").to_owned();
            let change = |text: String, (old, new): &(&str, &str)| {
                assert!(text.contains(old), "{old}");
                text.replacen(old, new, 1)
            };
            let text = changes.iter().fold(text, change);
            let plan = Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
            let case = Case::new(plan);
            of_plan(&case)
                .into_iter()
                .chain(taken_as_exact(&case))
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

    #[test]
    fn duds_of_surface_delays_are_asked_about() {
        let site = include_str!("../../../plans/amur-three-rows.toml");
        let told = |detonator: &str, fired_through: bool| {
            let text = site.replace("\"electronic\"", detonator);
            let times = format!("interval_ms = 9\nfired_through = {fired_through}\n");
            let (before, options) = text.split_once("[[delay]]").expect("options");
            let (_, uncertainty) = options.split_once("[uncertainty]").expect("inputs");
            let nine = format!("{before}[[delay]]\nname = \"9 ms\"\n{times}[uncertainty]{uncertainty}");
            to_be_looked_at(&parsed(nine)).filter(|line| line.contains("fired_through")).count()
        };
        assert_eq!(told("\"pyrotechnic surface\"", false), 1);
        assert_eq!(told("\"pyrotechnic surface\"", true), 0);
        assert_eq!([told("\"pyrotechnic\"", false), told("\"electronic\"", false)], [0, 0]);
    }

    /// FAIL becomes a pass with each of these, and none is out of the range of its own key: a rope ten times softer or stronger, a tire that
    /// weighs a third, cables that are longer than any, and shelters that are not tied.
    #[test]
    fn values_that_do_not_go_together_are_told_and_confirmed() {
        let site = include_str!("../../../plans/amur-three-rows.toml");
        let told = |old: &str, new: &str| {
            assert!(site.contains(old), "{old}");
            let case = parsed(site.replacen(old, new, 1));
            to_be_looked_at(&case).chain(kind_of_own_rope(&case)).join("\n")
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
            // Steel that is ten times too soft or too strong is told to be of fibre.
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

    /// What softens cables turned a shot of which most fail into a page "To be fired", and a hole that nobody listed is fired all the same.
    #[test]
    fn softer_cables_and_a_missing_hole_are_asked_about() {
        let site = include_str!("../../../plans/amur-three-rows.toml");
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
        let listed = |columns: &[usize]| {
            let hole = |column: &usize| {
                format!("{{ x_m = {}, y_m = 0, launch_m_s = 6 }}", 2.6 * (*column as f64 - 1.0))
            };
            told(
                "under_row = 1\nlaunch_m_s = 6.0\n",
                &format!("holes = [{}]\n", columns.iter().map(hole).join(", ")),
            )
        };
        for whole in [&[1, 2, 3, 4, 5, 6][..], &[1, 3, 2, 6, 5, 4], &[1, 3, 5, 7], &[1, 3]] {
            assert_eq!(listed(whole), "", "{whole:?}");
        }
        let missing = "lie 5.2 m apart, others 2.6 m: is one missing between them?";
        for (gappy, pair) in
            [(&[1, 2, 3, 5, 6][..], "3 and 4"), (&[6, 5, 3, 2, 1], "3 and 2"), (&[1, 2, 4], "2 and 3")]
        {
            assert_eq!(listed(gappy), format!("row 1: holes {pair} {missing}"));
        }
        assert!(listed(&[1, 2, 4, 5, 7]).contains(missing), "two are missing");
    }

    /// A row that was copied lies under the tires of the first one; and who says how far launches tilt, and not whither, tilts them to +x.
    #[test]
    fn copied_rows_and_tilts_without_a_direction_are_asked_about() {
        let site = include_str!("../../../plans/amur-three-rows.toml");
        let told = |old: &str, new: &str| {
            assert!(site.contains(old), "{old}");
            to_be_looked_at(&parsed(site.replacen(old, new, 1))).join("\n")
        };
        let copied = "rows 1 and 2 have holes under the same tires, 10 of them: is one a copy?";
        assert!(told("under_row = 2", "under_row = 1").contains(copied));
        let asked = "launches tilt toward the larger x";
        for (more, is_asked) in
            [("tilt_deg = 5", true), ("tilt_deg = 5\ntilt_toward_deg = 90", false), ("tilt_deg = 0", false)]
        {
            let told = told("launch_m_s = 6.0\n", &format!("launch_m_s = 6.0\n{more}\n"));
            assert_eq!(told.contains(asked), is_asked, "{more}: {told}");
        }
    }

    /// Tires of a list that lie 26 m apart are tied by 24 m of rope, as no site does.
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
            to_be_looked_at(&Case::new(plan)).filter(|line| line.contains("apart")).collect::<Vec<_>>()
        };
        assert_eq!(told(26.0), ["a cable ties tires 26.0 m apart: a slip of the pen?"]);
        assert_eq!(told(10.0), [""; 0]);
    }

    /// Chance may have made the launches of a plan that was fitted to one film, and nobody knows a launch to a percent without one.
    #[test]
    fn launches_that_nobody_can_know_so_well_are_told() {
        let told = |uncertainty: &str| {
            let text = include_str!("../../../tests/fixtures/amur-three-rows.toml");
            let (before, after) = text.split_once("launch_common_percent = 3 ").expect("a value");
            of_plan(&parsed(format!("{before}{uncertainty} {after}"))).join("\n")
        };
        let marks =
            |count: usize| (0..count).map(|n| format!(", \"abcd000{n}\"")).collect::<Vec<_>>().concat();
        let fitted = |count: usize| {
            told(&format!("launch_common_percent = 3\nfitted_from = [\"{:64}\"{}]\n#", 1, marks(count)))
        };
        assert!(fitted(1).contains("fitted to ONE observation"), "{}", fitted(1));
        assert!(fitted(2).contains("fitted to two observations"), "{}", fitted(2));
        assert!(!fitted(3).contains("fitted to"), "{}", fitted(3));
        for (percent, is_told) in [("0", true), ("2", true), ("2.1", false)] {
            let told = told(&format!("launch_common_percent = {percent}"));
            assert_eq!(told.contains("surer than any film"), is_told, "{percent}: {told}");
        }
        for (written, is_told) in
            [("2", false), ("2.1", true), ("9.9", true), ("9.9 # assumed", false), ("10", false)]
        {
            let told = told(&format!("launch_common_percent = {written}\n#"));
            assert_eq!(told.contains("no film was fitted"), is_told, "{written}: {told}");
        }
        assert!(!fitted(3).contains("no film was fitted"), "{}", fitted(3));
    }
}
