//! Reads a design of SHOTPlus 6 (`.spf`): a ZIP archive whose `BlisData.Xml` lists the holes.
//!
//! Every hole states its firing time itself, so ties need not be added up. `FiringTime` [ms] is the sum of the shortest way of ties from a
//! lead-in, the delay in the hole, and 0.0001 ms for every tie on the way, by which SHOTPlus orders holes. `FiringTime` of the hole's
//! initiators is the same without that addition. Coordinates are in metres, angles in degrees from the vertical, weights in kilograms.

use std::collections::BTreeMap;
use std::io::{Cursor, Read};
use std::ops::Range;

use quick_xml::Reader;
use quick_xml::escape::resolve_predefined_entity;
use quick_xml::events::Event;
use zip::ZipArchive;

use super::direction::{Directions, Tilt};
use super::holes::{Holes, ListedHole, repeated};
use crate::plan::diagnostic::{MOST_KEPT, Mistake};
use crate::plan::keys::{Key, delay, hole};
use crate::plan::source::{Unreadable, text_of};

/// The file of the archive that lists the holes.
const LIST: &str = "BlisData.Xml";
/// Path of the element of a hole.
const HOLE: [&str; 3] = ["BlisBlastData", "Holes", "Hole"];
/// Paths of the elements that are read of a hole.
const READ: [&str; 13] = [
    "HoleId",
    "IsDummy",
    "DesignCoordinates/X",
    "DesignCoordinates/Y",
    "ActualCoordinates/X",
    "ActualCoordinates/Y",
    "DesignAngle",
    "DesignBearing",
    "FiringTime",
    "InitSysLoading/Initiators/FiringTime",
    "InitSysLoading/Initiators/ExDeckIndex",
    "DesignLoading/Decks/Type",
    "DesignLoading/Decks/Weight",
];
/// Largest list [bytes], largest number of holes in it, and greatest depth of its elements.
const MOST_BYTES: u64 = 64 << 20;
const MOST_HOLES: usize = 50_000;
const MOST_DEPTH: usize = 20;
/// Greatest difference between two times that count as the same [ms]: the addition for a thousand ties.
const SAME_MS: f64 = 0.1;
/// Least firing time [ms] that SHOTPlus writes for a hole that is not tied in.
const NO_TIME_MS: f64 = 1e7;
const REMEDY: &str = "save the design in SHOTPlus 6 again, or export its holes as a table";

/// The XML that lists the holes.
pub fn list(archive: &[u8]) -> Result<String, Unreadable> {
    let broken = |error: &dyn std::fmt::Display| (format!("the archive cannot be read: {error}"), REMEDY);
    let mut archive = ZipArchive::new(Cursor::new(archive)).map_err(|error| broken(&error))?;
    let Some(index) = archive.index_for_name(LIST) else {
        let message = format!("the archive holds no {LIST}, so it is no design of SHOTPlus 6");
        let workbook = archive.index_for_name("xl/workbook.xml").is_some();
        return Err((message, if workbook { "save the sheet of the workbook as CSV" } else { REMEDY }));
    };
    let mut bytes = Vec::new();
    let entry = archive.by_index(index).map_err(|error| broken(&error))?;
    entry.take(MOST_BYTES + 1).read_to_end(&mut bytes).map_err(|error| broken(&error))?;
    if bytes.len() as u64 > MOST_BYTES {
        return Err((format!("{LIST} is larger than {} MB", MOST_BYTES >> 20), REMEDY));
    }
    let text = text_of(bytes).map_err(|(message, _)| (format!("{LIST}: {message}"), REMEDY))?;
    Ok(text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text))
}

/// Distance of a surveyed collar from the design [m] above which the survey counts as a mistake.
const MOST_MOVED_M: f64 = 3.0;

/// All holes of the list, or all its mistakes.
pub fn read(xml: &str, directions: Directions) -> Result<Holes, Vec<Mistake>> {
    let elements = holes(xml)?;
    let (mut list, mut mistakes) = (Holes::default(), Vec::new());
    let (dummies, holes): (Vec<_>, Vec<_>) = elements.iter().partition(|hole| {
        hole.text("IsDummy").is_some_and(|said| said == "1" || said.eq_ignore_ascii_case("true"))
    });
    let detonators = holes.iter().any(|hole| hole.has_detonator());
    let (mut moved_m, mut steepest_deg, mut as_designed) = (0.0_f64, 0.0_f64, 0);
    for (n, hole) in holes.iter().enumerate() {
        if mistakes.len() >= MOST_KEPT {
            return Err(mistakes);
        }
        let Some(mut listed) = hole.listed(n, detonators, directions, &mut mistakes) else { continue };
        let actual = ["X", "Y"].map(|axis| hole.number(&format!("ActualCoordinates/{axis}")));
        match actual {
            [Some(x), Some(y)] => {
                let moved = (x - listed.x_m).hypot(y - listed.y_m);
                if moved > MOST_MOVED_M {
                    let message = format!(
                        "hole {} was drilled {moved:.1} m from where it was designed, by its ActualCoordinates",
                        listed.id
                    );
                    mistakes.push(Mistake::new(
                        listed.span.clone(),
                        message,
                        "survey it, or design it where it is, in SHOTPlus",
                    ));
                }
                moved_m = moved_m.max(moved);
                // The hole that fires is the drilled one.
                (listed.x_m, listed.y_m) = (x, y);
            }
            [None, None] => as_designed += 1,
            _ => {
                let message = format!("hole {} has one of the two ActualCoordinates only", listed.id);
                mistakes.push(Mistake::new(
                    listed.span.clone(),
                    message,
                    "survey it, or take both out, in SHOTPlus",
                ));
            }
        }
        steepest_deg = steepest_deg.max(hole.number("DesignAngle").unwrap_or(0.0).abs());
        list.holes.push(listed);
    }
    if list.holes.iter().any(|hole| hole.charge_kg.is_some()) {
        mistakes.extend(list.holes.iter().filter(|hole| hole.charge_kg.is_none()).map(|hole| {
            let message = format!("hole {} holds no explosive, unlike others: does it fire?", hole.id);
            Mistake::new(hole.span.clone(), message, "charge it in SHOTPlus, or make it a dummy hole")
        }));
    }
    repeated(&list.holes, &mut mistakes);
    if list.holes.is_empty() && mistakes.is_empty() {
        mistakes.push(Mistake::new(0..0, format!("{LIST} lists no hole that fires"), REMEDY));
    }
    if !mistakes.is_empty() {
        return Err(mistakes);
    }
    if !dummies.is_empty() {
        let names: Vec<&str> = dummies.iter().filter_map(|hole| hole.text("HoleId")).collect();
        list.left_out.push(format!("the dummy holes {}", names.join(", ")));
    }
    if steepest_deg > 0.0 && directions == Directions::Vertical {
        list.left_out
            .push(format!("the angles of the holes, up to {steepest_deg} degrees from the vertical"));
    }
    if moved_m > 0.001 || 0 < as_designed && as_designed < list.holes.len() {
        let others = if as_designed > 0 {
            format!("; {as_designed} as designed, nobody surveyed them")
        } else {
            String::new()
        };
        list.notes.push(format!("collars lie as drilled, up to {moved_m:.3} m from the design{others}"));
    }
    if !detonators {
        list.notes.push("no hole has a detonator: the firing times are those of the surface".to_owned());
    }
    let charges: Vec<f64> = list.holes.iter().filter_map(|hole| hole.charge_kg).collect();
    if !charges.is_empty() {
        let mass: f64 = charges.iter().sum();
        list.notes.push(format!("the holes hold {mass:.1} kg of explosive, written as charge_kg"));
    }
    Ok(list)
}

/// Content of the XML about one hole.
struct Element {
    /// Texts by path from [`READ`], in the order of the XML.
    texts: BTreeMap<&'static str, Vec<String>>,
    /// Bytes of the hole's tag in the XML.
    span: Range<usize>,
}

impl Element {
    fn all(&self, path: &str) -> &[String] {
        self.texts.get(path).map_or(&[], Vec::as_slice)
    }

    /// The text at a path, if there is exactly one.
    fn text(&self, path: &str) -> Option<&str> {
        if let [text] = self.all(path) { Some(text.as_str()).filter(|text| !text.is_empty()) } else { None }
    }

    fn number(&self, path: &str) -> Option<f64> {
        self.text(path)?.parse().ok().filter(|number: &f64| number.is_finite())
    }

    fn has_detonator(&self) -> bool {
        !self.all("InitSysLoading/Initiators/FiringTime").is_empty()
    }

    /// The hole; `None` with mistakes if it cannot be read.
    fn listed(
        &self,
        n: usize,
        detonators: bool,
        directions: Directions,
        mistakes: &mut Vec<Mistake>,
    ) -> Option<ListedHole> {
        let before = mistakes.len();
        let id = self.text("HoleId").map_or_else(|| format!("number {}", n + 1), str::to_owned);
        let mut say =
            |message: String, remedy: &str| mistakes.push(Mistake::new(self.span.clone(), message, remedy));
        let mut number = |path: &str, key: &Key| {
            let number = self.number(path).filter(|number| key.kind.range().contains(number));
            if number.is_none() {
                let text = self.all(path).join(" and ");
                let message = format!("hole {id}: {path} is `{text}`");
                let remedy = format!(
                    "it must be one number from {} to {}: correct the hole in SHOTPlus, tie it in, and save again",
                    key.kind.range().start(),
                    key.kind.range().end()
                );
                say(message, &remedy);
            }
            number
        };
        let x_m = number("DesignCoordinates/X", &hole::X_M);
        let y_m = number("DesignCoordinates/Y", &hole::Y_M);
        let stated_ms = number("FiringTime", &delay::INTERVAL_MS);
        let tilt = match directions {
            Directions::Vertical => None,
            Directions::AgainstHoles => {
                number("DesignAngle", &hole::TILT_DEG).filter(|&angle| angle > 0.0).and_then(|angle| {
                    Tilt::against_hole(angle, number("DesignBearing", &hole::TILT_TOWARD_DEG)?)
                })
            }
        };
        let fire_ms = stated_ms.and_then(|stated_ms| self.fire_ms(&id, stated_ms, detonators, mistakes));
        let charge_kg = self.charge_kg(&id, mistakes);
        if stated_ms.is_some_and(|time| time >= NO_TIME_MS) {
            let message = format!("hole {id} has no firing time: it is not tied in");
            mistakes.push(Mistake::new(self.span.clone(), message, "tie it in, or make it a dummy hole"));
        }
        if mistakes.len() > before {
            return None;
        }
        Some(ListedHole {
            x_m: x_m?,
            y_m: y_m?,
            row: None,
            // Rounding removes the 0.0001 ms that SHOTPlus adds per tie, for up to 49 ties.
            fire_ms: Some((fire_ms? * 100.0).round() / 100.0),
            delay_ms: None,
            from: None,
            launch_m_s: None,
            tilt,
            charge_kg,
            span: self.span.clone(),
            id,
        })
    }

    /// Firing time of the only charge [ms].
    fn fire_ms(
        &self,
        id: &str,
        stated_ms: f64,
        detonators: bool,
        mistakes: &mut Vec<Mistake>,
    ) -> Option<f64> {
        let times = self.all("InitSysLoading/Initiators/FiringTime");
        let decks = self.all("InitSysLoading/Initiators/ExDeckIndex");
        let mut say = |message: String, remedy: &str| {
            mistakes.push(Mistake::new(self.span.clone(), message, remedy));
            None
        };
        if times.is_empty() {
            if !detonators {
                return Some(stated_ms);
            }
            let message = format!("hole {id} has no detonator, unlike others: its firing time is not sure");
            return say(message, "give it one, or make it a dummy hole");
        }
        let parsed: Option<Vec<f64>> = times.iter().map(|time| time.parse().ok()).collect();
        let Some(parsed) = parsed.filter(|_| decks.len() == times.len()) else {
            return say(format!("hole {id}: its detonators fire at {} ms", times.join(", ")), REMEDY);
        };
        // The first detonator of a charge fires it.
        let mut charges: BTreeMap<&str, f64> = BTreeMap::new();
        for (deck, time) in decks.iter().zip(parsed) {
            let first = charges.entry(deck.as_str()).or_insert(time);
            *first = first.min(time);
        }
        let range = |from: fn(f64, f64) -> f64| charges.values().copied().reduce(from).unwrap_or(f64::NAN);
        let (first, last) = (range(f64::min), range(f64::max));
        if last - first > SAME_MS {
            let message = format!(
                "hole {id} has charges that fire at {first} and {last} ms; a plan has one time for a hole"
            );
            return say(
                message,
                "export the holes as a table, with the time of the charge that lifts the cover",
            );
        }
        if (first - stated_ms).abs() > SAME_MS {
            let message = format!("hole {id} fires at {stated_ms} ms, its detonator at {first} ms");
            return say(message, "let SHOTPlus compute the firing times again, and save the design");
        }
        Some(first)
    }

    /// Mass of the explosive in all decks [kg]; `None` if there is none. A deck without a known mass is a mistake: the hole would count as
    /// lighter than it is.
    fn charge_kg(&self, id: &str, mistakes: &mut Vec<Mistake>) -> Option<f64> {
        let kinds = self.all("DesignLoading/Decks/Type");
        let weights = self.all("DesignLoading/Decks/Weight");
        let explosive = kinds.iter().enumerate().filter(|(_, kind)| *kind == "Explosive");
        let mut mass = 0.0;
        for (deck, _) in explosive {
            let weight = weights.get(deck).filter(|_| kinds.len() == weights.len());
            match weight.and_then(|weight| weight.parse::<f64>().ok()).filter(|weight| *weight >= 0.0) {
                Some(weight) => mass += weight,
                None => {
                    let stated = weight.map_or("missing".to_owned(), |weight| format!("`{weight}`"));
                    let message = format!("hole {id}: the weight of its explosive is {stated}");
                    mistakes.push(Mistake::new(
                        self.span.clone(),
                        message,
                        "let SHOTPlus charge the hole again, and save the design",
                    ));
                    return None;
                }
            }
        }
        Some(mass).filter(|&mass| mass > 0.0)
    }
}

/// All holes of the XML.
fn holes(xml: &str) -> Result<Vec<Element>, Vec<Mistake>> {
    let mut reader = Reader::from_str(xml);
    reader.config_mut().expand_empty_elements = true;
    let broken = |at: u64, error: String| {
        let at = (at as usize).min(xml.len());
        vec![Mistake::new(at..at, format!("{LIST} is damaged: {error}"), REMEDY)]
    };
    let (mut path, mut text, mut holes): (Vec<String>, String, Vec<Element>) = Default::default();
    loop {
        let start = reader.buffer_position() as usize;
        match reader.read_event().map_err(|error| broken(reader.error_position(), error.to_string()))? {
            Event::Start(tag) => {
                path.push(tag.local_name().as_ref().to_owned());
                text.clear();
                if path.len() > MOST_DEPTH {
                    let error = format!("its elements lie more than {MOST_DEPTH} deep");
                    return Err(broken(start as u64, error));
                }
                if path == HOLE {
                    if holes.len() == MOST_HOLES {
                        return Err(broken(start as u64, format!("it lists more than {MOST_HOLES} holes")));
                    }
                    holes.push(Element {
                        texts: BTreeMap::new(),
                        span: start..reader.buffer_position() as usize,
                    });
                }
            }
            Event::End(_) => {
                if let (Some(hole), Some((above, below))) =
                    (holes.last_mut(), path.split_at_checked(HOLE.len()))
                    && above == HOLE
                    && let Some(read) = READ.iter().find(|read| read.split('/').eq(below))
                {
                    let text = text.trim().replace(char::is_control, " ");
                    hole.texts.entry(read).or_default().push(text);
                }
                path.pop();
                text.clear();
            }
            Event::Text(part) => text += &part.xml10_content(),
            Event::CData(part) => text += &part.xml10_content(),
            Event::GeneralRef(name) => {
                let sign = name.resolve_char_ref().ok().flatten().map(String::from);
                let sign =
                    sign.or_else(|| resolve_predefined_entity(&name.xml10_content()).map(str::to_owned));
                text +=
                    &sign.ok_or_else(|| broken(start as u64, "an entity that is not known".to_owned()))?;
            }
            Event::Eof if path.is_empty() => return Ok(holes),
            Event::Eof => return Err(broken(xml.len() as u64, "it ends too early".to_owned())),
            _ => {}
        }
    }
}
