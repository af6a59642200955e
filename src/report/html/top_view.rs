//! The shelter from above: tires, cables and holes, with the names of the blast rows or with the times at which one option
//! fires them.

use std::f64::consts::FRAC_PI_2;

use nalgebra::Vector2;
use plotters::prelude::*;

use super::svg::color;
use crate::plan::BlastRow;
use crate::report::palette::Role;
use crate::scene::Firing;
use crate::study::Case;

const WIDTH: f64 = 860.0;
const TALLEST: f64 = 600.0;
const MARGIN: f64 = 30.0;
/// Cables of larger shelters would only be a grey area.
const MOST_CABLES: usize = 5000;
/// So much is written into a picture at most.
const MOST_LABELS: usize = 60;
const TIRE: RGBColor = RGBColor(120, 120, 120);
const CABLE: RGBColor = RGBColor(200, 200, 200);

/// The view with the firing times of one option, or the names of the blast rows; empty if it cannot be drawn.
pub fn svg(case: &Case, option: Option<usize>) -> String {
    let labels = match option.and_then(|option| case.shots.get(option)) {
        Some(shot) => {
            let time = |firing: &Firing| (firing.tire, format!("{:.0}", firing.at * 1e3));
            shot.firings.iter().map(time).collect()
        }
        None => names(case),
    };
    draw(case, &labels).unwrap_or_default()
}

/// The name of each blast row at its first hole; the other holes have none.
fn names(case: &Case) -> Vec<(usize, String)> {
    let row = |row: &BlastRow| {
        let mut name = row.name.clone();
        let tires = case.scene().firings(&row.targets).into_iter().map(|firing| firing.tire);
        tires.map(|tire| (tire, std::mem::take(&mut name))).collect::<Vec<_>>()
    };
    case.plan.blast_rows.iter().flat_map(row).collect()
}

/// Holes that launch their tires aside, and the direction along the ground, as long as the launch is tilted: 1 for 90°.
fn directions(case: &Case) -> Vec<(usize, Vector2<f64>)> {
    let scene = case.scene();
    let firings = case.plan.blast_rows.iter().flat_map(|row| scene.firings(&row.targets));
    let aside = firings.filter(|firing| firing.launch.xy().norm() > 0.0);
    aside
        .map(|firing| {
            let tilt = firing.launch.xy().norm().atan2(firing.launch.z) / FRAC_PI_2;
            // Even a slight tilt shows.
            (firing.tire, firing.launch.xy().normalize() * (0.5 + 0.5 * tilt))
        })
        .collect()
}

/// Holes are marked at the labelled tires, with a stroke where the launch is tilted.
fn draw(case: &Case, labels: &[(usize, String)]) -> Result<String, Box<dyn std::error::Error>> {
    let (scene, hole) = (case.scene(), color(Role::Fail));
    let [[left, right], [bottom, top]] = [scene.extent(0), scene.extent(1)];
    let (wide, high) = ((right - left).max(1.0), (top - bottom).max(1.0));
    let scale = ((WIDTH - 2.0 * MARGIN) / wide).min((TALLEST - 2.0 * MARGIN) / high);
    let size = (WIDTH as u32, (high * scale + 2.0 * MARGIN) as u32);
    let at = |tire: usize| {
        let position = scene.position[tire];
        ((MARGIN + (position.x - left) * scale) as i32, (MARGIN + (top - position.y) * scale) as i32)
    };
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, size).into_drawing_area();
        if scene.cables.len() <= MOST_CABLES {
            for cable in &scene.cables {
                area.draw(&PathElement::new(cable.ends.map(at), CABLE.stroke_width(1)))?;
            }
        }
        let spacing = scale * scene.cables.iter().map(|cable| cable.span.norm()).fold(2.0, f64::min);
        let radius = (0.3 * spacing).clamp(1.0, 12.0) as i32;
        for tire in 0..scene.mass.len() {
            area.draw(&Circle::new(at(tire), radius, TIRE.stroke_width(1)))?;
        }
        for (tire, _) in labels {
            area.draw(&Circle::new(at(*tire), (radius / 2).max(1), hole.filled()))?;
        }
        for (tire, direction) in directions(case) {
            let ((x, y), end) = (at(tire), direction * 0.6 * spacing);
            let end = (x + end.x as i32, y - end.y as i32);
            area.draw(&PathElement::new([(x, y), end], hole.stroke_width(2)))?;
        }
        if case.plan.ground.slope_percent > 0.0 {
            let (x, y) = (WIDTH as i32 - 200, 14);
            let down = scene.downhill.normalize() * 12.0;
            let style = ("sans-serif", 11).into_font().color(&TIRE);
            area.draw(&PathElement::new(
                [(x, y), (x + down.x as i32, y - down.y as i32)],
                TIRE.stroke_width(2),
            ))?;
            area.draw(&Circle::new((x, y), 3, TIRE.filled()))?;
            let falls = format!("the ground falls {} % this way", case.plan.ground.slope_percent);
            area.draw(&Text::new(falls, (x + 18, y - 6), style))?;
        }
        let written = || labels.iter().filter(|(_, label)| !label.is_empty());
        if written().count() <= MOST_LABELS {
            let style = ("sans-serif", 10).into_font().color(&hole);
            for (tire, label) in written() {
                let (x, y) = at(*tire);
                area.draw(&Text::new(label.as_str(), (x + radius + 1, y - radius - 9), style.clone()))?;
            }
        }
        area.present()?;
    }
    Ok(text)
}
