//! The shelter from above: tires, cables, and over each blast row's holes the order in which one option fires them.

use plotters::prelude::*;

use crate::study::Case;

const WIDTH: f64 = 860.0;
const TALLEST: f64 = 600.0;
const MARGIN: f64 = 30.0;
/// Cables of larger shelters would only be a grey area.
const MOST_CABLES: usize = 5000;
/// Firing times are written beside so many holes at most.
const MOST_LABELS: usize = 60;
const TIRE: RGBColor = RGBColor(120, 120, 120);
const CABLE: RGBColor = RGBColor(200, 200, 200);
const HOLE: RGBColor = RGBColor(160, 48, 0);

/// The view; empty if it cannot be drawn.
pub fn svg(case: &Case, option: usize) -> String {
    draw(case, option).unwrap_or_default()
}

fn draw(case: &Case, option: usize) -> Result<String, Box<dyn std::error::Error>> {
    let scene = case.scene();
    let [[left, right], [bottom, top]] = [scene.extent(0), scene.extent(1)];
    let (wide, high) = ((right - left).max(1.0), (top - bottom).max(1.0));
    let scale = ((WIDTH - 2.0 * MARGIN) / wide).min((TALLEST - 2.0 * MARGIN) / high);
    let size = (WIDTH as u32, (high * scale + 2.0 * MARGIN) as u32);
    let at = |tire: usize| {
        let place = scene.position[tire];
        ((MARGIN + (place.x - left) * scale) as i32, (MARGIN + (top - place.y) * scale) as i32)
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
        let firings = case.shots.get(option).map_or(&[][..], |shot| &shot.firings);
        for firing in firings {
            area.draw(&Circle::new(at(firing.tire), (radius / 2).max(1), HOLE.filled()))?;
            if firings.len() <= MOST_LABELS {
                let (x, y) = at(firing.tire);
                let time = format!("{:.0}", firing.at * 1e3);
                area.draw(&Text::new(
                    time,
                    (x + radius + 1, y - radius - 9),
                    ("sans-serif", 10).into_font().color(&HOLE),
                ))?;
            }
        }
        area.present()?;
    }
    Ok(text)
}
