//! From a plan to an immutable [`Scene`] (masses, cables, ground) and one [`Shot`] (its firings) per delay option, in SI units.
//!
//! The types belong to the engine. Only this module makes them from a plan.

use nalgebra::{Rotation2, Vector2, Vector3};

pub use shelter_engine::scene::*;

use crate::choice::{HoleOrder, Link, OnOverload};
use crate::plan::{
    BlastRow, DelayOption, Hole, HoleTiming, Launch, LaunchTargets, Layout, Mesh, NearestPoint, Plan, Time,
    fire_in_turn,
};
use crate::sorting::{sort_by_key, sorted_by};

/// Shot of the blast rows under `scene`, fired as a delay option says.
pub fn shot_of_option(scene: &Scene, rows: &[BlastRow], delay: &DelayOption) -> Shot {
    of_rows(scene, rows, &delay.timing.fire_at(), &delay.hole_timing)
}

/// Shot of the blast rows under `scene`, fired in `order`, `interval` apart. The holes of each row fire as `holes` says.
pub fn shot_in_order(
    scene: &Scene,
    rows: &[BlastRow],
    order: &[usize],
    interval: Time,
    holes: &HoleTiming,
) -> Shot {
    of_rows(scene, rows, &fire_in_turn(order, interval), holes)
}

/// Shot of the blast rows under `scene`, each at its time in `row_at` (`n_blast_rows`). Here times become seconds.
fn of_rows(scene: &Scene, rows: &[BlastRow], row_at: &[Time], holes: &HoleTiming) -> Shot {
    let (mut firings, mut along) = (Vec::new(), None);
    for (row, BlastRow { targets, .. }) in rows.iter().enumerate() {
        let firings_of_row = row_firings(scene, targets);
        let places = hole_places(scene, targets, &firings_of_row);
        let direction = direction_of_row(&places, along);
        along = Some(direction);
        let turns = match holes.is_together() {
            true => vec![Turn::default(); firings_of_row.len()],
            false => hole_turns(&places, direction, holes.order),
        };
        let fire = |(number, (firing, turn)): (usize, (Firing, Turn))| Firing {
            time: (row_at[row] + holes.interval * turn.number as i64).seconds(),
            row,
            number,
            from_left: turn.from_left,
            side: None,
            ..firing
        };
        firings.extend(firings_of_row.into_iter().zip(turns).enumerate().map(fire));
    }
    Shot { fired_through: holes.fired_through, ..Shot::from_firings(firings) }
}

/// Unit vector along the holes of a row, from left to right. `places` are the places of the holes [m].
///
/// The vector points the same way as the vector of the row `before`, so that neighbouring rows begin at the same side. For the
/// first row, and for a row across the row before, it points toward +x, or toward +y if the row is steep. Errors of a survey turn
/// no row round, unless the row lies in a direction in which hardly any row lies.
fn direction_of_row(places: &[Vector2<f64>], before: Option<Vector2<f64>>) -> Vector2<f64> {
    let middle = places.iter().sum::<Vector2<f64>>() / places.len().max(1) as f64;
    let moment =
        |a: usize, b: usize| places.iter().map(|p| (p[a] - middle[a]) * (p[b] - middle[b])).sum::<f64>();
    let [xx, yy, xy] = [moment(0, 0), moment(1, 1), moment(0, 1)];
    // Main axis of the moments; exactly along x or y if `xy` is 0.
    let direction = match xy == 0.0 {
        true if yy > xx => Vector2::y(),
        true => Vector2::x(),
        false => {
            let angle = 0.5 * libm::atan2(2.0 * xy, xx - yy);
            Vector2::new(libm::cos(angle), libm::sin(angle))
        }
    };
    if is_turned(direction, before) { -direction } else { direction }
}

/// Whether a direction points from right to left.
fn is_turned(direction: Vector2<f64>, before: Option<Vector2<f64>>) -> bool {
    let ahead = before.map_or(0.0, |before| direction.dot(&before));
    match ahead.abs() > STEEP {
        true => ahead < 0.0,
        false if direction.x.abs() > STEEP => direction.x < 0.0,
        false => direction.y < 0.0,
    }
}

/// Distance along a row within which a survey decides which of two holes comes first [m].
const SIDE_BY_SIDE_M: f64 = 0.2;
/// Angle by which the errors of a survey may turn a row [rad].
const SURVEY_TURN: f64 = 0.02;
/// If the moment across a row exceeds this share of the moment along it, nobody can tell along which way the row lies.
const AS_WIDE_AS_LONG: f64 = 0.5;

/// For each blast row, two holes whose order from the left depends on the centimetres of a survey (numbers from 0); `None` if the
/// order of the row is sure.
///
/// The order is unsure if two holes lie side by side, if the row is about as wide as it is long, or if the row lies where left and
/// right change sides.
pub fn holes_of_unsure_order(scene: &Scene, rows: &[BlastRow]) -> Vec<Option<[usize; 2]>> {
    let mut along = None;
    let of_row = |BlastRow { targets, .. }: &BlastRow| {
        let places = hole_places(scene, targets, &row_firings(scene, targets));
        let direction = direction_of_row(&places, along);
        let turns_round = [-SURVEY_TURN, SURVEY_TURN]
            .map(|angle| Rotation2::new(angle) * direction)
            .into_iter()
            .any(|direction| is_turned(direction, along));
        along = Some(direction);
        let across = Vector2::new(-direction.y, direction.x);
        let middle = places.iter().sum::<Vector2<f64>>() / places.len().max(1) as f64;
        let moment = |way: Vector2<f64>| places.iter().map(|p| (p - middle).dot(&way).powi(2)).sum::<f64>();
        let turns = hole_turns(&places, direction, HoleOrder::Left);
        let from_left = sorted_by(0..places.len(), |a, b| turns[*a].number.cmp(&turns[*b].number));
        let is_wide = moment(across) > AS_WIDE_AS_LONG * moment(direction);
        let is_beside =
            |pair: &&[usize]| is_wide || (places[pair[1]] - places[pair[0]]).dot(&direction) < SIDE_BY_SIDE_M;
        match from_left[..] {
            [first, .., last] if turns_round => Some([first, last]),
            _ => from_left.windows(2).find(is_beside).map(|pair| [pair[0], pair[1]]),
        }
    };
    rows.iter().map(of_row).collect()
}

/// Cosine of 67.5°, half way between a right angle and the angle of a diagonal. Two directions have no common way if their cosine
/// is smaller.
const STEEP: f64 = 0.382_683_432_365_089_8;

/// Turn and place of a hole in its row.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Turn {
    /// Turn in which the hole fires, from 0.
    number: usize,
    /// Place from the left, from 0.
    from_left: usize,
}

/// Turn of each hole of a row (`n_holes`). `places` are the places of the holes [m]; `direction` points from left to right. From
/// the middle and from the ends, the n-th holes of both sides fire together. So a survey of the collars to the centimetre changes
/// nothing.
fn hole_turns(places: &[Vector2<f64>], direction: Vector2<f64>, order: HoleOrder) -> Vec<Turn> {
    let across = Vector2::new(-direction.y, direction.x);
    let place = |hole: &usize| (places[*hole].dot(&direction), places[*hole].dot(&across));
    let by_place = |a: &usize, b: &usize| {
        let ((a, beside_a), (b, beside_b)) = (place(a), place(b));
        a.total_cmp(&b).then(beside_a.total_cmp(&beside_b))
    };
    let from_left = sorted_by(0..places.len(), by_place);
    let last = places.len().saturating_sub(1);
    let mut turns = vec![Turn::default(); places.len()];
    for (n, hole) in from_left.into_iter().enumerate() {
        let from_end = n.min(last - n);
        let number = match order {
            HoleOrder::Left => n,
            HoleOrder::Right => last - n,
            HoleOrder::Ends => from_end,
            HoleOrder::Centre => last / 2 - from_end,
        };
        turns[hole] = Turn { number, from_left: n };
    }
    turns
}

/// Firing at time 0 under a tire. The centre of the tire lies `offset` [m] from the mouth of the hole.
fn firing(tire: usize, launch: &Launch, offset: Vector2<f64>) -> Firing {
    let Launch { speed_m_s, tilt_deg, tilt_toward_deg, push_ms, charge_kg, push_depth_m, .. } = *launch;
    let (sine, cosine) = (cosine(tilt_deg - 90.0), cosine(tilt_deg));
    let line = PushLine { offset, tilt: sine / cosine * azimuth(tilt_toward_deg), depth: push_depth_m };
    let direction = match push_depth_m {
        // Straight from the angles: a mirrored launch is then exactly its own mirror image.
        None => (sine * azimuth(tilt_toward_deg)).push(cosine),
        Some(_) => direction_of_slope(line.planned_slope()),
    };
    let charge = charge_kg.unwrap_or(0.0);
    let at_once = Firing::at_once(0.0, tire, speed_m_s * direction);
    Firing { push_time: push_ms / 1e3, charge, line, ..at_once }
}

/// Direction along the ground at an azimuth [°] from +x toward +y.
fn azimuth(degrees: f64) -> Vector2<f64> {
    Vector2::new(cosine(degrees), cosine(degrees - 90.0))
}

/// Cosine of an angle in degrees, exact at multiples of 90, so that a launch along an axis is exactly its own mirror image.
fn cosine(degrees: f64) -> f64 {
    match degrees.rem_euclid(360.0) {
        90.0 | 270.0 => 0.0,
        angle => libm::cos(angle.to_radians()),
    }
}

/// Two tied tires and the vector between their centres [m].
struct Tie {
    ends: [usize; 2],
    between: Vector3<f64>,
}

/// Scene of a valid plan.
pub fn build(plan: &Plan) -> Scene {
    // Tangent and cosine of the slope's angle.
    let fall = plan.ground.slope_percent * 1e-2;
    let level = 1.0 / (1.0 + fall * fall).sqrt();
    let mut scene = Scene {
        position: Vec::new(),
        mass: Vec::new(),
        tire_ids: Vec::new(),
        cables: Vec::new(),
        friction: plan.ground.friction,
        gravity: plan.simulation.gravity_m_s2 * level,
        downhill: plan.simulation.gravity_m_s2 * fall * level * azimuth(plan.ground.slope_toward_deg),
        restitution: plan.tire.restitution,
        damping: plan.cable.damping_percent * 1e-2,
        breaking_force: (plan.cable.on_overload == OnOverload::Break)
            .then_some(plan.cable.breaking_force_kn * 1e3),
        strength: Vec::new(),
        mirrors: Vec::new(),
    };
    let ties = match &plan.layout {
        Layout::Grid(mesh) => lay_grid(&mut scene, mesh),
        Layout::Quincunx(mesh) => lay_quincunx(&mut scene, mesh),
        Layout::List { tires, cables } => {
            for (n, tire) in tires.iter().enumerate() {
                add_tire(&mut scene, TireId::Listed(n + 1), tire.x_m, tire.y_m);
            }
            let between = |a: usize, b: usize| scene.position[b] - scene.position[a];
            cables.iter().map(|&(a, b)| Tie { ends: [a, b], between: between(a, b) }).collect()
        }
    };
    scene.mass = vec![plan.tire.mass_kg; scene.position.len()];
    if let Layout::List { tires, .. } = &plan.layout {
        for (mass, tire) in scene.mass.iter_mut().zip(tires) {
            *mass = tire.mass_kg.unwrap_or(*mass);
        }
    }
    let axial_stiffness = plan.cable.axial_stiffness_kn * 1e3;
    let slack = 1.0 + plan.cable.slack_percent * 1e-2;
    scene.cables = ties
        .into_iter()
        .map(|Tie { ends, between }| {
            let (along, turned) = (between.normalize(), plan.tire.turned_m());
            let span = between - along * (plan.tire.outer_diameter_m - turned);
            let own_length = slack * (span.norm() - turned);
            let stiffness = with_ends(axial_stiffness / own_length, plan.cable.end_stiffness());
            Cable { ends, rest_length: own_length + turned, stiffness, span }
        })
        .collect();
    // The stepping loop takes several equal cables at once if their tires follow one another.
    sort_by_key(&mut scene.cables, |cable| (cable.ends[1] as isize - cable.ends[0] as isize, cable.ends[0]));
    scene.find_mirrors();
    scene
}

fn add_tire(scene: &mut Scene, id: TireId, x: f64, y: f64) {
    scene.position.push(Vector3::new(x, y, 0.0));
    scene.tire_ids.push(id);
}

/// Adds tires row by row. The first tire lies `first` rows and columns from the first corner of the border.
fn lay_tires(scene: &mut Scene, mesh: &Mesh, first: f64, rows: usize, columns: usize) {
    let start = first - mesh.border_rows as f64;
    for r in 0..rows {
        for c in 0..columns {
            let (x, y) = (start + c as f64, start + r as f64);
            let (row, column) = (y + 1.0, x + 1.0);
            let inside =
                row >= 1.0 && row <= mesh.rows as f64 && column >= 1.0 && column <= mesh.columns as f64;
            let id = if inside { TireId::Cell { row, column } } else { TireId::Border { row, column } };
            add_tire(scene, id, x * mesh.column_spacing_m, y * mesh.row_spacing_m);
        }
    }
}

/// Adds the tires of a grid; returns its ties.
fn lay_grid(scene: &mut Scene, mesh: &Mesh) -> Vec<Tie> {
    let [rows, columns] = [mesh.rows, mesh.columns].map(|n| n + 2 * mesh.border_rows);
    lay_tires(scene, mesh, 0.0, rows, columns);
    let [row, column, diagonal] =
        [Link::Row, Link::Column, Link::Diagonal].map(|link| mesh.links.contains(&link));
    let (dx, dy) = (mesh.column_spacing_m, mesh.row_spacing_m);
    let tire_at = |r: usize, c: usize| r * columns + c;
    let mut ties = Vec::new();
    for r in 0..rows {
        for c in 0..columns {
            let (left, right, up) = (c > 0, c + 1 < columns, r + 1 < rows);
            let mut tie = |tied: bool, r2: usize, c2: usize, x: f64, y: f64| {
                if tied {
                    ties.push(Tie {
                        ends: [tire_at(r, c), tire_at(r2, c2)],
                        between: Vector3::new(x, y, 0.0),
                    });
                }
            };
            tie(row && right, r, c + 1, dx, 0.0);
            tie(diagonal && up && left, r + 1, c.wrapping_sub(1), -dx, dy);
            tie(column && up, r + 1, c, 0.0, dy);
            tie(diagonal && up && right, r + 1, c + 1, dx, dy);
        }
    }
    ties
}

/// Adds the tires of a quincunx, corners first; returns its ties.
fn lay_quincunx(scene: &mut Scene, mesh: &Mesh) -> Vec<Tie> {
    let diagonal = mesh.links.contains(&Link::Diagonal);
    let mut corners = mesh.clone();
    corners.links.retain(|link| *link != Link::Diagonal);
    let mut ties = lay_grid(scene, &corners);
    let [rows, columns] = [mesh.rows, mesh.columns].map(|n| n + 2 * mesh.border_rows);
    let first_centre = scene.position.len();
    lay_tires(scene, mesh, 0.5, rows - 1, columns - 1);
    let (dx, dy) = (0.5 * mesh.column_spacing_m, 0.5 * mesh.row_spacing_m);
    let spokes = [(0, dx, dy), (1, -dx, dy), (columns, dx, -dy), (columns + 1, -dx, -dy)];
    for r in 0..rows - 1 {
        for c in (0..columns - 1).filter(|_| diagonal) {
            let (corner, centre) = (r * columns + c, first_centre + r * (columns - 1) + c);
            ties.extend(
                spokes.map(|(step, x, y)| Tie {
                    ends: [corner + step, centre],
                    between: Vector3::new(x, y, 0.0),
                }),
            );
        }
    }
    ties
}

/// Gives all cables of a plan's scene the slack `slack_percent` [%], and `stiffness_factor` times the axial stiffness of the plan.
pub fn change_cables(scene: &mut Scene, plan: &Plan, slack_percent: f64, stiffness_factor: f64) {
    let (spec, turned) = (&plan.cable, plan.tire.turned_m());
    let length = (1.0 + 1e-2 * slack_percent) / (1.0 + 1e-2 * spec.slack_percent);
    for cable in &mut scene.cables {
        let own_length = cable.rest_length - turned;
        let rope = spec.axial_stiffness_kn * 1e3 / own_length;
        let stiffness = with_ends(rope * stiffness_factor / length, spec.end_stiffness());
        *cable = Cable { rest_length: own_length * length + turned, stiffness, ..*cable };
    }
}

/// Makes each cable longer by `longer(cable)` [m], but never shorter than its span. `axial_stiffness` is the axial stiffness of the
/// rope [N].
pub fn lengthen_cables(
    scene: &mut Scene,
    plan: &Plan,
    axial_stiffness: f64,
    mut longer: impl FnMut(usize) -> f64,
) {
    for (n, cable) in scene.cables.iter_mut().enumerate() {
        let rest_length = (cable.rest_length + longer(n)).max(cable.span.norm());
        let own_length = rest_length - plan.tire.turned_m();
        let stiffness = with_ends(axial_stiffness / own_length, plan.cable.end_stiffness());
        *cable = Cable { rest_length, stiffness, ..*cable };
    }
}

/// Firings of the holes of a blast row at time 0. A hole fires under the nearest tire; of two equally near tires, under the first.
pub fn row_firings(scene: &Scene, targets: &LaunchTargets) -> Vec<Firing> {
    match targets {
        LaunchTargets::UnderRow { row, launch } => {
            let in_row = |&n: &usize| matches!(scene.tire_ids[n], TireId::Cell { row: r, .. } if r == *row);
            let tires = (0..scene.tire_ids.len()).filter(in_row);
            tires.map(|tire| firing(tire, launch, Vector2::zeros())).collect()
        }
        LaunchTargets::UnderTires { tires, launch } => {
            tires.iter().map(|&tire| firing(tire, launch, Vector2::zeros())).collect()
        }
        LaunchTargets::Holes(holes) => {
            let nearest = NearestPoint::of(scene.position.iter().map(|at| [at.x, at.y]).collect());
            let firing_at = |hole: &Hole| {
                let tire = nearest.to([hole.x_m, hole.y_m])?;
                let offset = scene.position[tire].xy() - Vector2::new(hole.x_m, hole.y_m);
                Some(firing(tire, &hole.launch, offset))
            };
            holes.iter().filter_map(firing_at).collect()
        }
    }
}

/// Places of the holes of a blast row [m] (`n_holes`). `firings` are the firings of the row. A row under tires has each hole under
/// the middle of its tire.
fn hole_places(scene: &Scene, targets: &LaunchTargets, firings: &[Firing]) -> Vec<Vector2<f64>> {
    match targets {
        LaunchTargets::Holes(holes) => holes.iter().map(|hole| Vector2::new(hole.x_m, hole.y_m)).collect(),
        LaunchTargets::UnderRow { .. } | LaunchTargets::UnderTires { .. } => {
            firings.iter().map(|firing| scene.position[firing.tire].xy()).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Holes on one line have a sure order, whatever the survey says. The order of two lines side by side is unsure,
    /// and so is the order of four holes in a box.
    #[test]
    fn an_order_that_a_survey_decides_is_unsure() {
        let unsure = |places: &[(f64, f64)]| {
            let holes: Vec<String> =
                places.iter().map(|(x, y)| format!("{{ x_m = {x}, y_m = {y}, launch_m_s = 3 }}")).collect();
            let text = format!(
                r#"
shelter = {{ layout = "grid", rows = 3, columns = 4, spacing_m = 2.6 }}
tire = {{ mass_kg = 280 }}
cable = {{ axial_stiffness_kn = 600, breaking_force_kn = 100 }}
ground = {{ friction = 0.5 }}
blast_row = [{{ name = "1", holes = [{}] }}]
limits = {{ flight_height_m = 5, cable_safety_factor = 1 }}
delay = [{{ name = "1", interval_ms = 0, hole_interval_ms = 25, hole_order = "ends" }}]
"#,
                holes.join(", ")
            );
            let plan = Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
            holes_of_unsure_order(&build(&plan), &plan.blast_rows)
        };
        assert_eq!(unsure(&[(0.0, 0.0), (2.6, 0.1), (5.2, -0.1), (7.8, 0.0)]), [None]);
        assert_eq!(unsure(&[(0.0, 0.0), (1.3, 0.6), (2.6, 0.0), (3.9, 0.6)]), [None], "staggered");
        assert_eq!(unsure(&[(0.0, 0.0)]), [None]);
        let lines = [(0.0, 0.0), (2.6, 0.0), (5.2, 0.0), (0.01, 2.6), (2.6, 2.6), (5.2, 2.6)];
        assert_eq!(unsure(&lines), [Some([0, 3])]);
        let diamond = [(0.0, 0.0), (1.3, 1.3), (2.6, 0.01), (1.6, -1.3)];
        assert!(unsure(&diamond)[0].is_some(), "as wide as it is long");
        // A row at 112.5°: one centimetre makes the upper end the left end.
        let steep = |shift: f64| -> Vec<(f64, f64)> {
            let at =
                |n: f64| (5.2 - 0.8 * n * STEEP + shift * n / 5.0, 0.8 * n * (1.0 - STEEP * STEEP).sqrt());
            (0..6).map(|n| at(f64::from(n))).collect()
        };
        for shift in [-0.01, 0.01] {
            let ends = unsure(&steep(shift))[0].map(|ends| ends.iter().sum::<usize>());
            assert_eq!(ends, Some(5), "the first and the last hole, {shift}");
        }
    }

    /// Rims that turn toward a cable lend it their diameter. The cable has the stiffness of its own length. It equals a cable from
    /// centre to centre with a greater axial stiffness. That holds as planned, and with another slack, rope and tied length.
    #[test]
    fn a_tire_that_turns_lends_its_cable_half_a_diameter() {
        let laid = |diameter: f64, stiffness: f64, slack: f64, turns: bool| {
            let text = format!(
                r#"
shelter = {{ layout = "grid", rows = 1, columns = 2, spacing_m = 2.6 }}
tire = {{ mass_kg = 280, outer_diameter_m = {diameter} }}
cable = {{ axial_stiffness_kn = {stiffness}, breaking_force_kn = 100, slack_percent = {slack} }}
ground = {{ friction = 0.5 }}
blast_row = [{{ name = "1", under_row = 1, launch_m_s = 3 }}]
limits = {{ flight_height_m = 5, cable_safety_factor = 1 }}
delay = [{{ name = "1", interval_ms = 0 }}]
"#
            );
            let mut plan = Plan::parse("", &text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
            plan.tire.turns = turns;
            (build(&plan), plan)
        };
        let (turning, plan) = laid(1.6, 600.0, 2.0, true);
        let only = |scene: &Scene| {
            (scene.cables[0].rest_length, scene.cables[0].stiffness, scene.cables[0].span.norm())
        };
        let close = |a: (f64, f64, f64), b: (f64, f64, f64)| {
            [(a.0, b.0), (a.1, b.1), (a.2, b.2)].iter().all(|(a, b)| (a / b - 1.0).abs() < 1e-12)
        };
        // A cable of 1 m and 2 % slack between two rims. 1.6 m of tire lie in line with the cable.
        let expected = (1.02 + 1.6, 6e5 / 1.02, 2.6);
        assert!(close(only(&turning), expected), "{:?}", only(&turning));
        let (from_centre, _) = laid(0.0, 600.0 * 2.62 / 1.02, 100.0 * (2.62 / 2.6 - 1.0), false);
        assert!(close(only(&from_centre), expected), "{:?}", only(&from_centre));
        let mut other = turning.clone();
        change_cables(&mut other, &plan, 4.0, 1.1);
        assert!(close(only(&other), (1.04 + 1.6, 6.6e5 / 1.04, 2.6)), "{:?}", only(&other));
        lengthen_cables(&mut other, &plan, 6.6e5, |_| 0.02);
        assert!(close(only(&other), (1.06 + 1.6, 6.6e5 / 1.06, 2.6)), "{:?}", only(&other));
        lengthen_cables(&mut other, &plan, 6.6e5, |_| -1.0);
        assert!(
            close(only(&other), (2.6, 6.6e5, 2.6)),
            "never shorter than what it spans: {:?}",
            only(&other)
        );
    }
}
