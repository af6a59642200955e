//! The rope catalogue: diameters, masses, stiffness and breaking forces with their standard and source.
//!
//! The figures are data: `ropes.toml` is compiled into the program. A name without a grade, such as `GOST 2688-80 6.2`, means the
//! lowest listed grade of wire, because an overstated strength is a danger. `GOST 2688-80 6.2 1770` names a grade.

use std::sync::LazyLock;

use serde::Deserialize;

/// All ropes and terminations.
#[derive(Clone, Debug)]
pub struct Catalogue {
    /// Ropes by family, diameter and grade; the lowest grade of a diameter comes first.
    pub ropes: Vec<Rope>,
    /// Ways to fasten the end of a rope, each with its efficiency.
    pub terminations: Vec<Termination>,
}

/// A rope or chain of one diameter and grade.
#[derive(Clone, Debug, PartialEq)]
pub struct Rope {
    /// Name in plans.
    pub name: String,
    /// Name of the family.
    pub family: String,
    /// Standard.
    pub standard: String,
    /// Construction.
    pub construction: String,
    /// Kind of the rope, which decides which terminations hold it.
    pub kind: Kind,
    /// Grade of wire [N/mm²]; 0 where the rope has no grade.
    pub grade: u32,
    /// Diameter [mm].
    pub diameter_mm: f64,
    /// Metallic area [mm²].
    pub metallic_area_mm2: Option<f64>,
    /// Mass per metre [kg/m].
    pub mass_kg_per_m: f64,
    /// Axial stiffness EA [kN].
    pub axial_stiffness_kn: f64,
    /// Breaking force [kN].
    pub breaking_force_kn: f64,
    /// Source of the figures.
    pub source: String,
    /// Whether the figures are typical values, not figures from the text of the standard.
    pub typical: bool,
}

/// Kind of a rope. It decides which terminations hold the rope.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Wire rope with a fibre core, which gives way in a swaged socket.
    #[serde(rename = "fibre core")]
    FibreCore,
    /// Wire rope with a core of steel.
    #[serde(rename = "steel core")]
    SteelCore,
    /// Chain.
    Chain,
    /// Rope of fibres, without wires.
    #[serde(rename = "fibre rope")]
    FibreRope,
}

impl Kind {
    /// Name in the catalogue.
    pub fn name(self) -> &'static str {
        match self {
            Kind::FibreCore => "fibre core",
            Kind::SteelCore => "steel core",
            Kind::Chain => "chain",
            Kind::FibreRope => "fibre rope",
        }
    }

    /// Words for a message: `wire rope with a fibre core`.
    pub fn label(self) -> &'static str {
        match self {
            Kind::FibreCore => "wire rope with a fibre core",
            Kind::SteelCore => "wire rope with a steel core",
            Kind::Chain => "chain",
            Kind::FibreRope => "fibre rope",
        }
    }
}

/// A way to fasten the end of a rope.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Termination {
    /// Name in plans.
    pub name: String,
    /// Share of the rope's breaking force that the termination holds [%].
    pub efficiency_percent: f64,
    /// Kinds of rope that the termination holds at this efficiency. It fits no other kind.
    pub fits: Vec<Kind>,
    /// Source of the figure.
    pub source: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    family: Vec<Family>,
    termination: Vec<Termination>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Family {
    name: String,
    standard: String,
    construction: String,
    kind: Kind,
    stiffness_per_d2: f64,
    source: String,
    typical: bool,
    grades: Vec<u32>,
    ropes: Vec<Entry>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    diameter_mm: f64,
    metallic_area_mm2: Option<f64>,
    mass_kg_per_m: f64,
    breaking_force_kn: Vec<f64>,
}

impl Catalogue {
    /// Names of the families, in the order of the list.
    pub fn families(&self) -> Vec<&str> {
        let mut names: Vec<&str> = self.ropes.iter().map(|rope| rope.family.as_str()).collect();
        names.dedup();
        names
    }
}

/// The catalogue compiled into the program.
pub fn catalogue() -> &'static Catalogue {
    // A test parses the same text.
    static CATALOGUE: LazyLock<Catalogue> =
        LazyLock::new(|| parse(include_str!("ropes.toml")).expect("the compiled catalogue is valid"));
    &CATALOGUE
}

fn parse(text: &str) -> Result<Catalogue, toml::de::Error> {
    let file: File = toml::from_str(text)?;
    let ropes = file.family.iter().flat_map(Family::ropes).collect();
    Ok(Catalogue { ropes, terminations: file.termination })
}

impl Family {
    fn ropes(&self) -> impl Iterator<Item = Rope> {
        let rope = |entry: &Entry, grade: u32, breaking_force_kn: f64, lowest: bool| {
            let base = format!("{} {}", self.name, entry.diameter_mm);
            Rope {
                name: if lowest { base } else { format!("{base} {grade}") },
                family: self.name.clone(),
                standard: self.standard.clone(),
                construction: self.construction.clone(),
                kind: self.kind,
                grade,
                diameter_mm: entry.diameter_mm,
                metallic_area_mm2: entry.metallic_area_mm2,
                mass_kg_per_m: entry.mass_kg_per_m,
                axial_stiffness_kn: self.stiffness_per_d2 * (entry.diameter_mm * 1e-3).powi(2) * 1e-3,
                breaking_force_kn,
                source: self.source.clone(),
                typical: self.typical,
            }
        };
        self.ropes.iter().flat_map(move |entry| {
            let grades = self.grades.iter().zip(&entry.breaking_force_kn).enumerate();
            grades.map(move |(n, (&grade, &force))| rope(entry, grade, force, n == 0))
        })
    }
}

impl Catalogue {
    /// Rope with this name. The name of a lowest grade may end with the grade or not.
    pub fn find(&self, name: &str) -> Option<&Rope> {
        let named = |rope: &&Rope| rope.name == name || format!("{} {}", rope.name, rope.grade) == name;
        self.ropes.iter().find(named)
    }

    /// The termination with this name.
    pub fn termination(&self, name: &str) -> Option<&Termination> {
        self.terminations.iter().find(|known| known.name == name)
    }

    /// Whether the termination with this name fits a rope of this family. An unknown termination fits every known family.
    pub fn fits(&self, termination: &str, family: &str) -> bool {
        let mut ropes = self.ropes.iter().filter(|rope| rope.family == family);
        let termination = self.termination(termination);
        ropes.any(|rope| termination.is_none_or(|termination| termination.fits.contains(&rope.kind)))
    }

    /// Name in the catalogue that is most similar to `name`; `None` if no name is similar.
    pub fn suggest(&self, name: &str) -> Option<&str> {
        let likeness = |rope: &&Rope| strsim::jaro_winkler(&rope.name, name);
        let near = self.ropes.iter().filter(|rope| likeness(rope) > 0.7);
        near.max_by(|a, b| likeness(a).total_cmp(&likeness(b))).map(|rope| rope.name.as_str())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_compiled_catalogue_parses_and_names_are_unique() {
        let catalogue = parse(include_str!("ropes.toml")).expect("the data file is valid");
        let mut names: Vec<_> = catalogue.ropes.iter().map(|rope| &rope.name).collect();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), catalogue.ropes.len());
        assert!(catalogue.ropes.iter().all(|rope| rope.breaking_force_kn > 0.0));
    }

    #[test]
    fn a_bare_name_is_the_lowest_grade() {
        let rope = catalogue().find("GOST 2688-80 6.2").expect("in the catalogue");
        assert_eq!((rope.grade, rope.breaking_force_kn), (1570, 19.25));
        let strong = catalogue().find("GOST 2688-80 6.2 1770").expect("in the catalogue");
        assert_eq!(strong.breaking_force_kn, 21.1);
        assert_eq!(catalogue().find("GOST 2688-80 6.2 1570"), Some(rope));
    }

    /// The ratio of breaking force to area × grade is 0.80 to 0.85 for every GOST rope; a wrong digit changes it.
    #[test]
    fn breaking_forces_fit_area_and_grade() {
        for rope in catalogue().ropes.iter().filter(|rope| rope.family == "GOST 2688-80") {
            let area = rope.metallic_area_mm2.expect("GOST ropes list it");
            let ratio = rope.breaking_force_kn * 1e3 / (area * f64::from(rope.grade));
            assert!((0.80..0.85).contains(&ratio), "{}: {ratio}", rope.name);
            let density = rope.mass_kg_per_m * 1e3 / area;
            assert!((9.75..9.85).contains(&density), "{}: {density}", rope.name);
        }
    }

    /// Columns of TM 5-3810-305-10 table 4. It has no figure for a swaged socket on a fibre core, and none for chain or fibre rope.
    #[test]
    fn terminations_fit_the_ropes_of_their_source() {
        let fits = |name: &str| catalogue().termination(name).expect("in the catalogue").fits.clone();
        let wire = [Kind::FibreCore, Kind::SteelCore];
        for name in ["clips", "wedge socket", "hand splice", "mechanical sleeve", "spelter socket"] {
            assert_eq!(fits(name), wire, "{name}");
        }
        assert_eq!(fits("swaged socket"), [Kind::SteelCore]);
        assert_eq!(fits("knot"), [Kind::FibreRope]);
        let core = |rope: &Rope| match rope.construction.as_str() {
            text if text.contains("fibre core") => Kind::FibreCore,
            text if text.contains("steel core") => Kind::SteelCore,
            text if text.contains("chain") => Kind::Chain,
            _ => Kind::FibreRope,
        };
        assert!(catalogue().ropes.iter().all(|rope| rope.kind == core(rope)));
    }

    #[test]
    fn a_misspelt_rope_finds_its_neighbour() {
        assert_eq!(catalogue().suggest("GOST 2688-80 6,2"), Some("GOST 2688-80 6.2"));
    }
}
