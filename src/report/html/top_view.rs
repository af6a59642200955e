//! The shelter from above: tires, cables and holes, with the names of the blast rows, or with the firing times of one option. Of
//! that option the cable with the greatest force and the highest tire are marked.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::FRAC_PI_2;

use nalgebra::Vector2;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::map_frame::{Area, Drawn, Frame};
use super::svg::color;
use crate::plan::{BlastRow, Layout};
use crate::report::language::{phrase, say};
use crate::report::palette::Role;
use crate::scene::{Shot, row_firings};
use crate::study::Case;
use crate::study::as_planned::check::CheckedShot;
use crate::study::hole_places::place_of_hole;
use crate::units::{self, Unit};
use crate::verdict::PerQuantity;

/// Most cables that are drawn. The cables of larger shelters would only be a grey area.
const MOST_CABLES: usize = 5000;
/// Most texts in a picture.
const MOST_LABELS: usize = 60;
/// Distance [m] below which two holes are one hole with several charges.
const SAME_PLACE: f64 = 1e-3;
/// Height of the letters beside holes [px].
const LETTERS: i32 = 14;
const TIRE: RGBColor = RGBColor(120, 120, 120);
const CABLE: RGBColor = RGBColor(200, 200, 200);

/// The view as SVG, with the firing times of `option`, or with the names of the blast rows. The peaks of the option are marked
/// where it is `checked`. Empty where the view cannot be drawn.
pub fn svg(case: &Case, option: Option<usize>, checked: Option<&CheckedShot>) -> String {
    let labels = match option.and_then(|option| case.shots.get(option)) {
        Some(shot) => times(case, shot),
        None => names(case),
    };
    draw(case, &labels, &peaks(case, checked)).unwrap_or_default()
}

/// Texts at the holes.
struct Labels {
    /// Place of each hole as drilled [m], also beside the middle of a tire or under none, with its text, which may be empty.
    texts: Vec<(Vector2<f64>, String)>,
    /// Meaning of the texts for the legend: where all are written, and where only some are.
    meaning: [&'static str; 2],
}

/// A peak of the planned shot, marked in the view and named in the legend.
enum Peak {
    /// Index of the cable with the greatest force, and the text of the legend.
    Cable(usize, String),
    /// Index of the highest tire, and the text of the legend.
    Tire(usize, String),
}

/// The cable with the greatest force and the highest tire of a planned shot; nothing where no cable pulls or no tire lifts.
fn peaks(case: &Case, checked: Option<&CheckedShot>) -> Vec<Peak> {
    let Some(checked) = checked else { return Vec::new() };
    let PerQuantity { height, force, .. } = checked.estimates;
    let scene = case.scene();
    let pulled = || {
        let value = units::value_by_error(force.value, force.error, Unit::Kilonewton);
        say!("greatest force as planned: cable {}, {value} kN", scene.cable_name(force.index), value)
    };
    let lifted = || {
        let value = units::value_by_error(height.value, height.error, Unit::Metre);
        say!("highest as planned: tire {}, {value} m", scene.tire_ids[height.index], value)
    };
    let cable = (force.value > 0.0).then(|| Peak::Cable(force.index, pulled()));
    let tire = (height.value > 0.0).then(|| Peak::Tire(height.index, lifted()));
    cable.into_iter().chain(tire).collect()
}

/// The name of each blast row at its first hole. The other holes have no text.
fn names(case: &Case) -> Labels {
    let row = |row: &BlastRow| {
        let mut name = row.name.clone();
        let holes = row_firings(case.scene(), &row.targets);
        holes
            .iter()
            .map(|hole| (place_of_hole(case.scene(), hole), std::mem::take(&mut name)))
            .collect::<Vec<_>>()
    };
    let first_holes = case.plan.blast_rows.iter().flat_map(row).collect();
    Labels {
        texts: first_holes,
        meaning: ["hole, the first of a row with its name", "hole, some with the name of their row"],
    }
}

/// Firing times at the holes. A picture with too many holes shows only the first and the last hole of each row to fire. Holes in
/// one place share a text.
fn times(case: &Case, shot: &Shot) -> Labels {
    let written = |kept: &dyn Fn(usize) -> bool| {
        let mut texts: Vec<(Vector2<f64>, Vec<String>)> = Vec::new();
        for (n, firing) in shot.firings.iter().enumerate() {
            let place = place_of_hole(case.scene(), firing);
            let here = texts.iter().position(|(other, _)| (other - place).norm() < SAME_PLACE);
            let here = here.unwrap_or_else(|| {
                texts.push((place, Vec::new()));
                texts.len() - 1
            });
            if kept(n) {
                texts[here].1.push(units::exact_number_of_milliseconds(firing.time).to_string());
            }
        }
        texts.into_iter().map(|(place, texts)| (place, texts.join(" + "))).collect()
    };
    let mut ends = BTreeMap::<usize, [usize; 2]>::new();
    for (n, firing) in shot.firings.iter().enumerate() {
        ends.entry(firing.row).or_insert([n; 2])[1] = n;
    }
    let ends: BTreeSet<usize> = ends.into_values().flatten().collect();
    let all_labelled = shot.firings.len() <= MOST_LABELS;
    let some = "hole, some with their firing time in ms";
    let meaning = if all_labelled { ["hole, with its firing time in ms", some] } else { [some; 2] };
    Labels { texts: written(&|n| all_labelled || ends.contains(&n)), meaning }
}

/// Places of holes that launch their tires aside, each with a direction along the ground. Its length grows with the tilt, up to 1
/// for 90°.
fn directions(case: &Case) -> Vec<[Vector2<f64>; 2]> {
    let scene = case.scene();
    let firings = case.plan.blast_rows.iter().flat_map(|row| row_firings(scene, &row.targets));
    let aside = firings.filter(|firing| firing.launch.xy().norm() > 0.0);
    aside
        .map(|firing| {
            let tilt = firing.launch.xy().norm().atan2(firing.launch.z) / FRAC_PI_2;
            // The length begins at 0.5, so that even a slight tilt shows.
            [place_of_hole(case.scene(), &firing), firing.launch.xy().normalize() * (0.5 + 0.5 * tilt)]
        })
        .collect()
}

/// The view as SVG. Holes are marked where they were drilled, with a stroke where the launch is tilted.
fn draw(case: &Case, labels: &Labels, peaks: &[Peak]) -> Result<String, Box<dyn std::error::Error>> {
    let (scene, hole) = (case.scene(), color(Role::Fail));
    let frame = Frame::new(scene, labels.texts.iter().map(|(place, _)| *place), 1 + peaks.len());
    let at = |place: Vector2<f64>| frame.at(place.x, place.y);
    let place = |tire: usize| at(scene.position[tire].xy());
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, frame.size).into_drawing_area();
        if scene.cables.len() <= MOST_CABLES {
            for cable in &scene.cables {
                area.draw(&PathElement::new(cable.ends.map(place), CABLE.stroke_width(1)))?;
            }
        }
        let nearest = scene.cables.iter().map(|cable| cable.ends.map(|end| scene.position[end]));
        let nearest = nearest.map(|[a, b]| (a - b).norm()).fold(f64::INFINITY, f64::min);
        let spacing = frame.scale * if nearest.is_finite() { nearest } else { 2.0 };
        let radius = (0.3 * spacing).clamp(1.0, 12.0) as i32;
        // Marks lie over letters, so that no letter hides a hole.
        let written = draw_labels(&area, labels, at, radius)?;
        for peak in peaks {
            if let Peak::Cable(cable, _) = peak {
                area.draw(&PathElement::new(scene.cables[*cable].ends.map(place), BLACK.stroke_width(5)))?;
            }
        }
        for tire in 0..scene.tire_count() {
            area.draw(&Circle::new(place(tire), radius, TIRE.stroke_width(1)))?;
        }
        for (place, _) in &labels.texts {
            area.draw(&Circle::new(at(*place), (radius / 2).max(1), hole.filled()))?;
        }
        for peak in peaks {
            if let Peak::Tire(tire, _) = peak {
                area.draw(&Circle::new(place(*tire), radius + 4, BLACK.stroke_width(3)))?;
            }
        }
        for [place, direction] in directions(case) {
            let ((x, y), end) = (at(place), direction * 0.6 * spacing);
            let end = (x + end.x as i32, y - end.y as i32);
            area.draw(&PathElement::new([(x, y), end], hole.stroke_width(2)))?;
        }
        draw_slope(case, &area, &frame)?;
        draw_tire_numbers(case, &area, place, radius)?;
        frame.draw_numbers(&area, scene, radius)?;
        frame.draw_scale_bar(&area)?;
        draw_legend(&area, &frame, phrase(labels.meaning[usize::from(!written)]), peaks)?;
        area.present()?;
    }
    // A white edge keeps letters readable over cables and tires.
    Ok(text.replace("<text ", "<text stroke=\"white\" stroke-width=\"4\" paint-order=\"stroke\" "))
}

/// Draws the direction in which the ground falls.
fn draw_slope(case: &Case, area: &Area<'_>, frame: &Frame) -> Drawn {
    if case.plan.ground.slope_percent == 0.0 {
        return Ok(());
    }
    let (x, y) = (frame.size.0 as i32 - 200, 14);
    let down = case.scene().downhill.normalize() * 12.0;
    let style = ("sans-serif", 13).into_font().color(&TIRE);
    let end = (x + down.x as i32, y - down.y as i32);
    area.draw(&PathElement::new([(x, y), end], TIRE.stroke_width(2)))?;
    area.draw(&Circle::new((x, y), 3, TIRE.filled()))?;
    let falls = say!("the ground falls {} % this way", case.plan.ground.slope_percent);
    area.draw(&Text::new(falls, (x + 18, y - 6), style))?;
    Ok(())
}

/// Draws labels beside their holes, without labels that would lie on another label or hole. Returns whether all are drawn.
fn draw_labels(
    area: &Area<'_>,
    labels: &Labels,
    at: impl Fn(Vector2<f64>) -> (i32, i32),
    radius: i32,
) -> Result<bool, Box<dyn std::error::Error>> {
    let asked: Vec<&(Vector2<f64>, String)> =
        labels.texts.iter().filter(|(_, label)| !label.is_empty()).collect();
    let style = ("sans-serif", LETTERS).into_font().color(&color(Role::Fail));
    let mut placed: Vec<[i32; 3]> = Vec::new();
    for (place, label) in asked.iter().take(MOST_LABELS) {
        let (x, y) = at(*place);
        // The width of a letter is some 0.6 of its height.
        let width = (label.chars().count() as i32 + 1) * LETTERS * 6 / 10;
        let [left, top] = [(x + radius + 1).min(area.dim_in_pixel().0 as i32 - width), y - radius - 13];
        let right = left + width;
        let lies_on =
            |[from, to, high]: &[i32; 3]| left < *to && *from < right && (top - high).abs() < LETTERS;
        let hides = |(hole, _): &(Vector2<f64>, String)| {
            let ((x, y), dot) = (at(*hole), radius / 2);
            left < x + dot && x - dot < right && top < y + dot && y - dot < top + LETTERS
        };
        if !placed.iter().any(lies_on) && !labels.texts.iter().any(hides) {
            placed.push([left, right, top]);
            area.draw(&Text::new(label.as_str(), (left, top), style.clone()))?;
        }
    }
    Ok(placed.len() == asked.len())
}

/// Draws the numbers of listed tires: a list has no rows and columns.
fn draw_tire_numbers(case: &Case, area: &Area<'_>, at: impl Fn(usize) -> (i32, i32), radius: i32) -> Drawn {
    let scene = case.scene();
    if !matches!(case.plan.layout, Layout::List { .. }) || scene.tire_ids.len() > MOST_LABELS {
        return Ok(());
    }
    let place = Pos::new(HPos::Center, VPos::Top);
    let style = ("sans-serif", 12).into_font().color(&TIRE).pos(place);
    for (tire, id) in scene.tire_ids.iter().enumerate() {
        let (x, y) = at(tire);
        area.draw(&Text::new(id.to_string(), (x, y + radius + 4), style.clone()))?;
    }
    Ok(())
}

/// Draws the legend: the marks of the picture and their meaning. `holes` is the meaning of the mark of a hole.
fn draw_legend(area: &Area<'_>, frame: &Frame, holes: &str, peaks: &[Peak]) -> Drawn {
    let mark = frame.draw_item(area, 0, holes)?;
    area.draw(&Circle::new(mark, 9, TIRE.stroke_width(1)))?;
    area.draw(&Circle::new(mark, 4, color(Role::Fail).filled()))?;
    for (n, peak) in peaks.iter().enumerate() {
        let (Peak::Cable(_, text) | Peak::Tire(_, text)) = peak;
        let (x, y) = frame.draw_item(area, n + 1, text)?;
        match peak {
            Peak::Cable(..) => {
                area.draw(&PathElement::new([(x - 12, y), (x + 12, y)], BLACK.stroke_width(5)))?;
            }
            Peak::Tire(..) => area.draw(&Circle::new((x, y), 9, BLACK.stroke_width(3)))?,
        }
    }
    Ok(())
}
