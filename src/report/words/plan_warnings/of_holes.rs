//! Warnings about holes that may be missing, lie beside their tires, or fire otherwise than somebody reads the plan.

use std::collections::BTreeSet;

use itertools::Itertools;
use nalgebra::Vector2;

use crate::choice::HoleOrder;
use crate::plan::{BlastRow, HoleTiming, LaunchTargets};
use crate::report::language::{phrase, say};
use crate::scene::{Firing, holes_of_unsure_order};
use crate::sorting::{sorted_by, sorted_by_key};
use crate::study::Case;
use crate::study::hole_places::{HoleBesideTire, holes_beside_tires, place_of_hole};
use crate::units;

/// Warnings about holes that the signer confirms.
pub(super) fn warnings(case: &Case) -> Vec<String> {
    let single = [
        no_in_hole_scatter(case),
        rows_scatter_alone(case),
        dud_alone(case),
        under_same_tires(case),
        few_in_row(case),
        row_left_out(case).or_else(|| wide_between_rows(case)),
        limits_nothing(case),
        side_by_side(case),
    ];
    let several = [gap_in_row(case), order_by_survey(case), listed_otherwise(case), beside_tires(case)];
    single.into_iter().flatten().chain(several.into_iter().flatten()).collect()
}

/// Warning that detonators are pyrotechnic, but no scatter inside the holes is stated.
fn no_in_hole_scatter(case: &Case) -> Option<String> {
    let text =
        "detonators are pyrotechnic, but `in_hole_delay_ms` is 0: no scatter inside the holes is drawn";
    case.plan.uncertainty.lacks_in_hole_scatter().then(|| phrase(text).to_owned())
}

/// Warning that firing times scatter from row to row only, not from hole to hole.
fn rows_scatter_alone(case: &Case) -> Option<String> {
    let text = "firing times scatter from delay to delay, and holes without a delay between them fire as one, as `in_hole_delay_ms` is 0: \
                do the detonators in the holes scatter?";
    case.plan.uncertainty.scatters_rows_alone().then(|| phrase(text).to_owned())
}

/// Warning that surface delays fire the holes one after another, but a dud of some option stops no other hole.
fn dud_alone(case: &Case) -> Option<String> {
    let text = "surface delays fire one hole by the one before, but `fired_through` is not set: does a dud take none along?";
    let is_alone = case.plan.delays.iter().any(|delay| !delay.hole_timing.fired_through);
    (is_alone && case.plan.uncertainty.has_surface_delays()).then(|| phrase(text).to_owned())
}

/// Warnings for rows whose holes fire one after another in an order that a survey of the holes decides.
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

/// Warnings for rows whose holes fire one after another from the left or the right, but are not listed from left to right. Whoever
/// wires the holes as listed fires a shot that nobody judged.
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

/// Gap between two holes of a row over the middle gap of that row, above which the row gets a warning. Of an even number of gaps
/// the shorter middle gap counts: with three holes left of four, one of two gaps is wide.
const WIDE_GAP: f64 = 1.8;

/// Warnings for rows with a wide gap: a hole may be missing there. A hole that is not in the plan is fired all the same.
fn gap_in_row(case: &Case) -> Vec<String> {
    let (scene, Some(shot)) = (case.scene(), case.shots.first()) else { return Vec::new() };
    let place = |firing: &Firing| place_of_hole(scene, firing);
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

/// Holes of a short row over the holes of a long row, up to which the plan gets a warning; and the least number of holes of the
/// long row.
const SHORT_ROW: (f64, usize) = (0.5, 4);

/// Warning that a row has few holes beside a long row: a hole that a list leaves out is fired all the same.
fn few_in_row(case: &Case) -> Option<String> {
    let shot = case.shots.first()?;
    let count = |row: usize| shot.firings.iter().filter(|firing| firing.row == row).count();
    let rows = (0..case.plan.blast_rows.len()).map(|row| (count(row), row));
    let ((fewest, short), (most, long)) = rows.minmax().into_option()?;
    let (share, least) = SHORT_ROW;
    let [short, long] = [short, long].map(|row| &case.plan.blast_rows[row].name);
    let is_told = most >= least && fewest as f64 <= share * most as f64;
    is_told.then(|| {
        say!(
            "row {short} has {fewest} of the holes, row {long} has {most}: does the plan list all of them?",
            short,
            fewest,
            long,
            most
        )
    })
}

/// Warning that blast rows skip a row of the shelter where others follow closer: a blast row may be missing, or lie under another
/// shelter row.
fn row_left_out(case: &Case) -> Option<String> {
    let under = |row: &BlastRow| match &row.targets {
        LaunchTargets::UnderRow { row, .. } => Some(*row),
        LaunchTargets::UnderTires { .. } | LaunchTargets::Holes(_) => None,
    };
    let under = sorted_by(case.plan.blast_rows.iter().filter_map(under), f64::total_cmp);
    let gaps =
        || under.iter().tuple_windows().map(|(one, next)| (next - one, one, next)).filter(|gap| gap.0 > 0.0);
    let least = gaps().map(|(gap, ..)| gap).reduce(f64::min)?;
    let (_, one, next) = gaps().find(|(gap, ..)| *gap > least)?;
    Some(say!(
        "blast rows lie under rows {one} and {next} of the shelter and none between, others follow closer: is a row missing?",
        one,
        next
    ))
}

/// Warning that two of at least three blast rows lie much farther apart than the others, across the rows, by the middle of their holes.
fn wide_between_rows(case: &Case) -> Option<String> {
    let (scene, shot, rows) = (case.scene(), case.shots.first()?, &case.plan.blast_rows);
    let places = |row: usize| -> Vec<Vector2<f64>> {
        let of_row = shot.firings.iter().filter(|firing| firing.row == row);
        of_row.map(|firing| place_of_hole(scene, firing)).collect()
    };
    let places: Vec<_> = (0..rows.len()).map(places).collect();
    let middle = |places: &Vec<Vector2<f64>>| places.iter().sum::<Vector2<f64>>() / places.len() as f64;
    let middles: Vec<Vector2<f64>> = places.iter().map(middle).collect();
    let along = |axis: usize| {
        let from_middle =
            |row: usize| places[row].iter().map(move |place| place[axis]).minmax().into_option();
        (0..rows.len()).filter_map(from_middle).map(|(low, high)| high - low).sum::<f64>()
    };
    let across = usize::from(along(1) < along(0));
    let in_turn = sorted_by(0..rows.len(), |&a, &b| middles[a][across].total_cmp(&middles[b][across]));
    let apart = |pair: &[usize]| middles[pair[1]][across] - middles[pair[0]][across];
    let gaps = sorted_by(in_turn.windows(2), |a, b| apart(a).total_cmp(&apart(b)));
    let (least, widest) = (apart(gaps.first()?), *gaps.last()?);
    (least > 0.0 && apart(widest) > WIDE_GAP * least).then(|| {
        let [one, other] = [widest[0], widest[1]].map(|row| &rows[row].name);
        say!(
            "rows {one} and {other} lie {} m apart, others {} m: is a row missing between them?",
            one,
            other,
            units::rounded(apart(widest), 1),
            units::rounded(least, 1)
        )
    })
}

/// Warning that a limit of holes or charge within 8 ms exceeds all holes together: the limit may be in another unit.
fn limits_nothing(case: &Case) -> Option<String> {
    let shot = case.shots.first()?;
    let all_charges: f64 = shot.firings.iter().map(|firing| firing.charge).sum();
    let of_charge = case.plan.limits.charge_in_8_ms_kg.map(|most| (most, all_charges));
    let of_charge = of_charge.filter(|(most, all)| most > all);
    let of_charge = of_charge.map(|(most, all)| {
        let all = units::short(all);
        say!("`charge_in_8_ms_kg = {most}` limits nothing: all holes hold {all} kg", most, all)
    });
    let holes = shot.firings.len();
    let of_holes = case.plan.limits.holes_in_8_ms.filter(|most| *most > holes);
    let of_holes = of_holes
        .map(|most| say!("`holes_in_8_ms = {most}` limits nothing: the plan has {holes} holes", most, holes));
    of_charge.or(of_holes)
}

/// Distance of two holes [m] below which they may be one hole, surveyed or listed twice.
const APART: f64 = 0.5;

/// Warning that two holes lie side by side.
fn side_by_side(case: &Case) -> Option<String> {
    let place = |firing: &Firing| place_of_hole(case.scene(), firing);
    let along_x = sorted_by(&case.shots.first()?.firings, |a, b| place(a).x.total_cmp(&place(b).x));
    let near = |n: usize| {
        let one = along_x[n];
        let others = along_x[n + 1..].iter().take_while(move |other| place(other).x - place(one).x < APART);
        others.map(move |other| (one, *other, (place(other) - place(one)).norm())).collect::<Vec<_>>()
    };
    // Rows under the same tires have their own warning.
    let is_new = |one: &Firing, other: &Firing| one.tire != other.tire || one.row == other.row;
    let all = (0..along_x.len()).flat_map(near);
    let all = all.filter(|(one, other, apart)| *apart < APART && is_new(one, other));
    let (one, other, apart) = all.min_by(|a, b| a.2.total_cmp(&b.2))?;
    let name =
        |firing: &Firing| say!("row {}, hole {}", case.plan.blast_rows[firing.row].name, firing.number + 1);
    let [one, other] = [one, other].map(name);
    let apart = units::rounded(apart, 2);
    Some(say!("{one} and {other} lie {apart} m apart: is one hole listed twice?", one, other, apart))
}

/// Warning that two rows have holes under the same tires: one may be a copy, and then another row is missing.
fn under_same_tires(case: &Case) -> Option<String> {
    let firings = case.shots.first()?.firings.iter();
    let under: BTreeSet<(usize, usize)> = firings.map(|firing| (firing.tire, firing.row)).collect();
    let pairs = under.iter().tuple_windows();
    let shared =
        || pairs.clone().filter(|((tire, _), (other, _))| tire == other).map(|(one, other)| [one.1, other.1]);
    let rows = shared().min()?;
    let count = shared().filter(|pair| *pair == rows).count();
    let [one, other] = rows.map(|row| &case.plan.blast_rows[row].name);
    Some(say!(
        "rows {one} and {other} have holes under the same tires, {count} of them: is one a copy?",
        one,
        other,
        count
    ))
}

/// Warnings for holes that lie under no tire, between two tires, or beside their tires.
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
    use itertools::Itertools;

    use super::super::tests::parsed;
    use super::super::to_be_looked_at;

    /// What is asked about a row of holes at these places [m], fired so, under 2 x 3 tires 2 m apart.
    fn asked(places: &[[f64; 2]], diameter_m: f64, times: &str) -> String {
        let hole = |[x, y]: &[f64; 2]| format!("{{ x_m = {x}, y_m = {y}, launch_m_s = 6 }}");
        let holes = places.iter().map(hole).join(", ");
        let text = format!(
            "shelter = {{ layout = \"grid\", rows = 2, columns = 3, spacing_m = 2 }}\n\
             tire = {{ mass_kg = 280, outer_diameter_m = {diameter_m} }}\n\
             cable = {{ axial_stiffness_kn = 1400, breaking_force_kn = 60 }}\nground = {{ friction = 0.5 }}\n\
             blast_row = [{{ name = \"1\", holes = [{holes}] }}]\n\
             limits = {{ flight_height_m = 2, cable_safety_factor = 1 }}\ndelay = [{{ name = \"1\", interval_ms = 0, {times} }}]\n"
        );
        to_be_looked_at(&parsed(text)).join("\n")
    }

    /// Whoever wires holes as they are listed, or as a survey puts them, may fire a shot that nobody judged.
    #[test]
    fn holes_whose_order_from_the_left_is_not_the_listed_one_are_asked_about() {
        let [left, centre] =
            ["left", "centre"].map(|order| format!("hole_interval_ms = 17, hole_order = \"{order}\""));
        let otherwise = "row 1: its holes are not listed from left to right, and `hole_order` goes by their places: the left one is hole 2, tire 1:1";
        let turned = [[4.0, 0.0], [0.0, 0.0], [2.0, 0.0]];
        assert!(asked(&turned, 1.6, &left).contains(otherwise), "{}", asked(&turned, 1.6, &left));
        let in_turn = [turned[1], turned[2], turned[0]];
        assert!(!asked(&in_turn, 1.6, &left).contains("not listed from left to right"));
        assert!(!asked(&turned, 1.6, &centre).contains("not listed from left to right"));
        assert!(!asked(&turned, 1.6, "hole_interval_ms = 0").contains("not listed from left to right"));
        let survey = "row 1: a survey decides which of its holes 2 and 3 counts as the left one";
        let beside = [[0.0, 0.0], [3.9, 0.0], [4.0, 0.8]];
        assert!(asked(&beside, 1.6, &left).contains(survey), "{}", asked(&beside, 1.6, &left));
        assert!(!asked(&in_turn, 1.6, &left).contains("a survey decides"));
        assert!(!asked(&beside, 1.6, "hole_interval_ms = 0").contains("a survey decides"));
    }

    /// A row that a list leaves out is fired all the same.
    #[test]
    fn a_wide_gap_between_listed_rows_is_asked_about() {
        let told = |lines: &[f64]| {
            let row = |(n, y): (usize, &f64)| {
                format!(
                    "{{ name = \"{}\", holes = [{{ x_m = 0, y_m = {y}, launch_m_s = 6 }}, {{ x_m = 2, y_m = {y}, launch_m_s = 6 }}] }}",
                    n + 1
                )
            };
            let rows = lines.iter().enumerate().map(row).join(", ");
            let text = format!(
                "shelter = {{ layout = \"grid\", rows = 6, columns = 2, spacing_m = 2 }}\ntire = {{ mass_kg = 280, outer_diameter_m = 1.6 }}\n\
                 cable = {{ axial_stiffness_kn = 1400, breaking_force_kn = 60 }}\nground = {{ friction = 0.5 }}\nblast_row = [{rows}]\n\
                 limits = {{ flight_height_m = 2, cable_safety_factor = 1 }}\ndelay = [{{ name = \"1\", interval_ms = 9 }}]\n"
            );
            let lines = to_be_looked_at(&parsed(text));
            lines.into_iter().find(|line| line.contains("is a row missing"))
        };
        assert_eq!(told(&[0.0, 2.0, 4.0, 6.0]), None);
        let asked = "rows 2 and 3 lie 4.0 m apart, others 2.0 m: is a row missing between them?";
        assert_eq!(told(&[0.0, 2.0, 6.0, 8.0]).as_deref(), Some(asked));
        assert_eq!(told(&[0.0, 4.0]), None, "nobody knows what is usual");
    }

    /// The worst hole of each kind is named: under no tire, between two, and beside its own.
    #[test]
    fn holes_beside_their_tires_are_told() {
        let told = |places: &[[f64; 2]], diameter_m| {
            let all = asked(places, diameter_m, "hole_interval_ms = 0");
            let of_tires = |line: &&str| line.contains("holes lie ") && line.contains("m from tire");
            all.lines().filter(of_tires).map(str::to_owned).collect::<Vec<_>>()
        };
        assert_eq!(told(&[[0.0, 0.0], [2.0, 0.0]], 1.6), [""; 0]);
        assert_eq!(
            told(&[[0.5, 0.0], [2.6, 0.0], [4.0, 0.0]], 1.6),
            [
                "2 of 3 holes lie beside their tires, which are pushed aside: row 1, hole 2 is 0.60 m from tire 1:2"
            ]
        );
        assert_eq!(
            told(&[[0.81, 0.0], [2.5, 0.0]], 1.6),
            [
                "1 of 2 holes lie under no tire, and the nearest gets the whole launch: row 1, hole 1 is 0.81 m from tire 1:1",
                "1 of 2 holes lie beside their tires, which are pushed aside: row 1, hole 2 is 0.50 m from tire 1:2",
            ]
        );
        assert_eq!(
            told(&[[0.97, 0.0], [4.0, 0.0]], 0.0),
            [
                "1 of 2 holes lie between two tires, and either may get the launch: row 1, hole 1 is 0.97 m from tire 1:1"
            ]
        );
    }

    #[test]
    fn duds_of_surface_delays_are_asked_about() {
        let site = include_str!("../../../../plans/amur-three-rows.toml");
        let told = |detonator: &str, fired_through: bool| {
            let text = site.replace("\"electronic\"", detonator);
            let times = format!("interval_ms = 9\nfired_through = {fired_through}\n");
            let (before, options) = text.split_once("[[delay]]").expect("options");
            let (_, uncertainty) = options.split_once("[uncertainty]").expect("inputs");
            let nine = format!("{before}[[delay]]\nname = \"9 ms\"\n{times}[uncertainty]{uncertainty}");
            to_be_looked_at(&parsed(nine)).iter().filter(|line| line.contains("fired_through")).count()
        };
        assert_eq!(told("\"pyrotechnic surface\"", false), 1);
        assert_eq!(told("\"pyrotechnic surface\"", true), 0);
        assert_eq!([told("\"pyrotechnic\"", false), told("\"electronic\"", false)], [0, 0]);
    }

    /// Holes of a row that fire at one time scatter as one, unless the plan states the delay of the detonator in each hole.
    #[test]
    fn times_that_scatter_from_row_to_row_alone_are_asked_about() {
        let site = include_str!("../../../../plans/amur-three-rows.toml");
        let told = |times: &str| {
            let text = site.replacen("detonator = \"electronic\"", times, 1);
            let lines = to_be_looked_at(&parsed(text));
            lines.iter().filter(|line| line.contains("in_hole_delay_ms")).count()
        };
        for (times, expected) in [
            ("delay_sd_ms = 5", 1),
            ("delay_cv_percent = 1", 1),
            ("detonator = \"pyrotechnic\"", 1),
            ("delay_sd_ms = 5\nin_hole_delay_ms = 500", 0),
            ("delay_sd_ms = 0.1", 0),
            ("detonator = \"electronic\"", 0),
        ] {
            assert_eq!(told(times), expected, "{times}");
        }
    }

    /// A copied row lies under the tires of the first row. A launch with a tilt, but without a direction, tilts toward +x.
    #[test]
    fn copied_rows_and_tilts_without_a_direction_are_asked_about() {
        let site = include_str!("../../../../plans/amur-three-rows.toml");
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

    /// A limit in grams, or with a zero too many: all holes of the plan stay far below it.
    #[test]
    fn a_limit_that_all_holes_together_keep_is_asked_about() {
        let site = include_str!("../../../../plans/amur-three-rows.toml");
        let charged = site.replace("launch_m_s = 6.0", "launch_m_s = 6.0\ncharge_kg = 25");
        let told = |limit: &str| {
            let text = charged.replacen("flight_height_m =", &format!("{limit}\nflight_height_m ="), 1);
            to_be_looked_at(&parsed(text)).join("\n").contains("limits nothing")
        };
        for (limit, is_told) in [
            ("holes_in_8_ms = 30", false),
            ("holes_in_8_ms = 31", true),
            ("charge_in_8_ms_kg = 750", false),
            ("charge_in_8_ms_kg = 751", true),
        ] {
            assert_eq!(told(limit), is_told, "{limit}");
        }
    }

    /// Three blast rows follow each other. Then the last row moves one shelter row too far.
    #[test]
    fn a_row_of_the_shelter_without_holes_is_asked_about() {
        let site = include_str!("../../../../plans/amur-three-rows.toml");
        let told = |rows: [usize; 3]| {
            let moved = |text: String, (old, new): (usize, usize)| {
                text.replacen(&format!("under_row = {old}\n"), &format!("under_row = {new} \n"), 1)
            };
            let text = [1, 2, 3].into_iter().zip(rows).fold(site.to_owned(), moved);
            to_be_looked_at(&parsed(text)).join("\n")
        };
        let asked = "blast rows lie under rows 2 and 4 of the shelter and none between";
        assert!(told([1, 2, 4]).contains(asked), "{}", told([1, 2, 4]));
        for whole in [[1, 2, 3], [1, 3, 5], [3, 2, 1], [2, 2, 3]] {
            assert!(!told(whole).contains("none between"), "{whole:?}");
        }
    }

    /// A hole that nobody listed is fired all the same.
    #[test]
    fn a_missing_hole_is_asked_about() {
        let site = include_str!("../../../../plans/amur-three-rows.toml");
        let listed = |columns: &[usize]| {
            let hole = |column: &usize| {
                format!("{{ x_m = {}, y_m = 0, launch_m_s = 6 }}", 2.6 * (*column as f64 - 1.0))
            };
            let holes = format!("holes = [{}]\n", columns.iter().map(hole).join(", "));
            let told =
                to_be_looked_at(&parsed(site.replacen("under_row = 1\nlaunch_m_s = 6.0\n", &holes, 1)));
            told.into_iter().filter(|line| line.contains("between them")).join("\n")
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

    /// A hole that was left out, or surveyed twice, is not fired as the plan says.
    #[test]
    fn short_rows_and_twin_holes_are_asked_about() {
        let site = include_str!("../../../../plans/amur-three-rows.toml");
        let row = "under_row = 1\nlaunch_m_s = 6.0\n";
        let holes = |all: &[(f64, f64)]| {
            let listed =
                all.iter().map(|(x, y)| format!("{{ x_m = {x}, y_m = {y}, launch_m_s = 6 }}")).join(", ");
            let text = site.replacen(row, &format!("holes = [{listed}]\n"), 1);
            assert_ne!(text, site);
            let lines = to_be_looked_at(&parsed(text));
            let told = |words: &str| lines.iter().any(|line| line.contains(words));
            [told("of the holes, row 3 has 10"), told("is one hole listed twice?")]
        };
        let every =
            |apart: f64, count: usize| (0..count).map(|n| (apart * n as f64, 0.0)).collect::<Vec<_>>();
        assert_eq!(holes(&every(2.61, 9)), [false, false]);
        assert_eq!(holes(&every(2.61, 5)), [true, false]);
        assert_eq!(holes(&[every(2.61, 9), vec![(2.61, 0.4)]].concat()), [false, true]);
    }
}
