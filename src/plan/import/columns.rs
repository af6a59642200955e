//! The columns of a list of holes: their names in several languages, their units, and names that look like times but are
//! not known.

/// A column that is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Column {
    Pattern,
    Id,
    X,
    Y,
    Row,
    Fire,
    Delay,
    From,
    Launch,
}

/// What a name of a column means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meaning {
    Known(Column),
    /// A time or a velocity that does not say its unit; the unit that is read.
    WithoutUnit(&'static str),
    /// Perhaps a firing time, a delay, a row or a launch velocity.
    Unclear,
    Other,
}

/// Names of the columns, in small letters and without signs or spaces.
#[rustfmt::skip]
const NAMES: &[(Column, &[&str])] = &[
    (Column::Pattern, &["entityname", "blast", "blastname", "layername", "pattern", "patternname"]),
    (Column::Id, &[
        "id", "hole", "holeid", "holename", "holeno", "holenumber", "number", "no", "name",
        "скважина", "номер", "номерскважины",
        "barreno", "taladro", "pozo", "numero", "número",
        "bohrloch", "bohrlochnr", "nummer", "nr",
    ]),
    (Column::X, &[
        "x", "xm", "east", "easting", "eastingm", "startx", "startxlocation", "collarx", "xcollar",
        "х", "хм", "восток", "este", "estem", "ost", "ostwert", "rechtswert",
    ]),
    (Column::Y, &[
        "y", "ym", "north", "northing", "northingm", "starty", "startylocation", "collary", "ycollar",
        "у", "ум", "север", "norte", "nortem", "nord", "nordwert", "hochwert",
    ]),
    (Column::Row, &["row", "rowid", "rowname", "rowno", "blastrow", "ряд", "номерряда", "fila", "reihe", "bohrreihe"]),
    (Column::From, &["from", "fromid", "fromhole", "fromholeid", "отскважины", "desde", "von", "vonbohrloch"]),
];

/// Names of times, without their unit.
#[rustfmt::skip]
const TIMES: &[(Column, &[&str])] = &[
    (Column::Fire, &[
        "fire", "fireat", "firetime", "firingtime", "initiationtime", "holetime",
        "времявзрыва", "времясрабатывания", "tiempodedisparo", "zündzeit", "zündzeitpunkt",
    ]),
    (Column::Delay, &["delay", "timingdelay", "замедление", "retardo", "verzögerung"]),
];
const MILLISECONDS: &[&str] = &["ms", "msec", "milliseconds", "мс"];

/// Names of the launch velocity, without its unit.
const LAUNCH: &[&str] = &["launch", "launchvelocity", "v0"];
/// Ends of a name in small letters, without brackets.
const METRES_PER_SECOND: &[&str] = &["m/s", "m_s", "mpers", "м/с"];

/// A program whose lists do not say the unit of their firing times in the header.
pub struct Program {
    pub name: &'static str,
    /// Columns by which a list is known as the program's.
    columns: &'static [&'static str],
    /// Columns of firing times [ms].
    times: &'static [&'static str],
}

const PROGRAMS: &[Program] = &[
    Program {
        name: "Kirra",
        columns: &["entityname", "holeid", "timingdelaymilliseconds"],
        times: &["initiationtime", "holetime"],
    },
    Program {
        name: "BlastLogic",
        columns: &["blast", "holeid", "bearing", "subdrill", "time"],
        times: &["time"],
    },
];

/// Parts of names that stand for a firing time, a delay or a row.
#[rustfmt::skip]
const TIMING: &[&str] = &[
    "time", "timing", "interval", "period", "launch", "delay", "fire", "firing", "deton", "initiat", "sequence", "milliseconds",
    "время", "замедл", "задерж", "интервал", "очеред",
    "tiempo", "retard", "retraso", "secuencia",
    "zeit", "zünd", "verzög", "reihe",
];
/// Whole words of names that stand for a firing time, an order or a row.
#[rustfmt::skip]
const TIMING_WORDS: &[&str] = &[
    "row", "rows", "ms", "lag", "ttd", "order", "seq", "line", "group", "echelon", "wave",
    "ряд", "ряда", "мс", "порядок", "линия", "группа", "ступень",
    "fila", "hilera", "orden", "línea", "grupo",
    "folge", "reihenfolge", "linie", "gruppe", "stufe",
];

/// A name in small letters, without signs and spaces.
pub fn plain(name: &str) -> String {
    name.to_lowercase().replace(|c: char| !c.is_alphanumeric(), "")
}

/// The program that wrote a list with these columns, where its firing times are known to be in milliseconds.
pub fn program(header: &[String]) -> Option<&'static Program> {
    let names: Vec<String> = header.iter().map(|name| plain(name)).collect();
    PROGRAMS
        .iter()
        .find(|program| program.columns.iter().all(|column| names.iter().any(|name| name == column)))
}

impl Program {
    /// What the name of a column means in the lists of this program.
    pub fn meaning(&self, name: &str) -> Meaning {
        if self.times.contains(&plain(name).as_str()) { Meaning::Known(Column::Fire) } else { meaning(name) }
    }
}

/// What the name of a column means in a list of a program that is not known.
pub fn meaning(name: &str) -> Meaning {
    // Without its signs a velocity in m/s would look like a time in ms.
    let small = name.trim().trim_end_matches([')', ']']).to_lowercase();
    let velocity = METRES_PER_SECOND.iter().find_map(|unit| small.strip_suffix(unit));
    if velocity.is_some_and(|name| LAUNCH.contains(&plain(name).as_str())) {
        return Meaning::Known(Column::Launch);
    }
    let whole = plain(name);
    let of = |table: &[(Column, &[&str])], name: &str| {
        table.iter().find(|(_, names)| names.contains(&name)).map(|(column, _)| *column)
    };
    let in_ms = |unit: &&str| of(TIMES, whole.strip_suffix(unit)?);
    if let Some(column) = of(NAMES, &whole) {
        Meaning::Known(column)
    } else if velocity.is_some() {
        unclear(name)
    } else if let Some(column) = MILLISECONDS.iter().find_map(in_ms) {
        Meaning::Known(column)
    } else if of(TIMES, &whole).is_some() {
        Meaning::WithoutUnit("ms")
    } else if LAUNCH.contains(&whole.as_str()) {
        Meaning::WithoutUnit("m/s")
    } else {
        unclear(name)
    }
}

/// Whether a name that is not known may stand for a firing time, a delay or a row. The time at which a value was measured
/// is none of these.
fn unclear(name: &str) -> Meaning {
    let whole = plain(name);
    let mut words = name.split(|c: char| !c.is_alphanumeric()).map(str::to_lowercase);
    let timing = !whole.ends_with("timestamp")
        && (whole == "t"
            || TIMING.iter().any(|part| whole.contains(part))
            || words.any(|word| TIMING_WORDS.contains(&word.as_str())));
    if timing { Meaning::Unclear } else { Meaning::Other }
}
