//! The columns of a list of holes: their names in several languages, their units, and unknown names that look like times.

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
    Angle,
    Bearing,
    Charge,
}

impl Column {
    /// Unit of the values as the import reads them; empty if they have none.
    pub fn unit(self) -> &'static str {
        match self {
            Self::X | Self::Y => "m",
            Self::Fire | Self::Delay => "ms",
            Self::Launch => "m/s",
            Self::Angle | Self::Bearing => "°",
            Self::Charge => "kg",
            Self::Pattern | Self::Id | Self::Row | Self::From => "",
        }
    }
}

/// Meaning of a column's name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meaning {
    Known(Column),
    /// A time or a velocity whose name gives no unit.
    WithoutUnit(Column),
    /// A column in another unit than the import reads; the unit.
    OtherUnit(Column, &'static str),
    /// Perhaps a firing time, a delay, a row or a launch velocity.
    Unclear,
    Other,
}

impl Meaning {
    /// The column that the name stands for, in any unit.
    pub fn column(self) -> Option<Column> {
        match self {
            Self::Known(column) | Self::WithoutUnit(column) | Self::OtherUnit(column, _) => Some(column),
            Self::Unclear | Self::Other => None,
        }
    }
}

/// Names of the columns without their unit, in small letters, without signs or spaces.
#[rustfmt::skip]
const NAMES: &[(Column, &[&str])] = &[
    (Column::Pattern, &["entityname", "blast", "blastname", "layername", "pattern", "patternname"]),
    (Column::Id, &[
        "id", "hole", "holeid", "holename", "holeno", "holenumber", "holelabel", "number", "no", "name",
        "borehole", "drillhole", "shothole",
        "скважина", "скважины", "скв", "номер", "номерскважины", "номерскв", "имя", "имяскважины",
        "barreno", "taladro", "pozo", "numero", "número",
        "bohrloch", "bohrlochnr", "bohrlochnummer", "loch", "lochnr", "nummer", "nr",
    ]),
    (Column::X, &[
        "x", "east", "easting", "startx", "startxlocation", "collarx", "xcollar",
        "х", "восток", "este", "ost", "ostwert", "rechtswert",
    ]),
    (Column::Y, &[
        "y", "north", "northing", "starty", "startylocation", "collary", "ycollar",
        "у", "север", "norte", "nord", "nordwert", "hochwert",
    ]),
    (Column::Row, &["row", "rowid", "rowname", "rowno", "blastrow", "ряд", "номерряда", "fila", "reihe", "bohrreihe"]),
    (Column::From, &["from", "fromid", "fromhole", "fromholeid", "отскважины", "desde", "von", "vonbohrloch"]),
    (Column::Fire, &[
        "fire", "fireat", "firetime", "firingtime", "initiationtime", "holetime", "time",
        "время", "времявзрыва", "времясрабатывания", "tiempo", "tiempodedisparo", "zeit", "zündzeit", "zündzeitpunkt",
    ]),
    (Column::Delay, &["delay", "timingdelay", "замедление", "retardo", "verzögerung"]),
    (Column::Launch, &["launch", "launchvelocity", "v0"]),
    (Column::Angle, &["anglefromvertical"]),
    (Column::Bearing, &["bearing", "holebearing"]),
    (Column::Charge, &[
        "charge", "chargemass", "explosive", "explosivemass", "заряд", "массазаряда", "carga", "ladung", "lademenge",
    ]),
];

/// Units, each with the endings of names that state the unit, in small letters and without brackets.
#[rustfmt::skip]
const UNITS: &[(&str, &[&str])] = &[
    ("m", &["m", "м"]),
    ("ms", &["ms", "msec", "milliseconds", "мс"]),
    ("m/s", &["m/s", "m_s", "mpers", "м/с"]),
    ("mm", &["mm", "мм"]), ("cm", &["cm", "см"]), ("km", &["km", "км"]), ("ft", &["ft", "feet", "'"]),
    ("°", &["°", "deg"]),
    ("kg", &["kg", "кг"]), ("lb", &["lb", "lbs"]), ("g", &["g"]),
    ("s", &["s", "sec", "sek", "seg", "seconds", "с", "сек"]), ("µs", &["us", "µs", "μs", "мкс"]),
    ("ft/s", &["ft/s"]), ("km/h", &["km/h", "км/ч"]),
];

/// A program whose lists do not state the unit of firing times in the header, nor from where angles count.
pub struct Program {
    pub name: &'static str,
    /// Columns that identify a list of the program.
    columns: &'static [&'static str],
    /// Columns with firing times [ms].
    times: &'static [&'static str],
    /// Column with the angles from the vertical [°].
    angle: &'static str,
}

const PROGRAMS: &[Program] = &[
    Program {
        name: "Kirra",
        columns: &["entityname", "holeid", "timingdelaymilliseconds"],
        times: &["initiationtime", "holetime"],
        angle: "holeangle",
    },
    Program {
        name: "BlastLogic",
        columns: &["blast", "holeid", "bearing", "subdrill", "time"],
        times: &["time"],
        angle: "angle",
    },
];

/// Parts of names that stand for a firing time, a delay or a row.
#[rustfmt::skip]
const TIMING: &[&str] = &[
    "time", "timing", "interval", "period", "launch", "delay", "fire", "firing", "deton", "initiat", "sequen", "milliseconds",
    "время", "замедл", "задерж", "интервал", "очеред", "детонатор",
    "tiempo", "retard", "retraso", "secuencia", "segundo",
    "zeit", "zünd", "verzög", "reihe",
];
/// Whole words of names that stand for a firing time, an order or a row.
#[rustfmt::skip]
const TIMING_WORDS: &[&str] = &[
    "row", "rows", "ms", "lag", "ttd", "det", "edd", "cap", "caps", "ihd", "downhole", "pulse", "round", "serie", "order", "seq", "line", "group", "echelon", "wave",
    "ряд", "ряда", "мс", "серия", "серии", "порядок", "линия", "группа", "ступень",
    "fila", "hilera", "orden", "línea", "grupo",
    "folge", "reihenfolge", "linie", "gruppe", "stufe",
];

/// A name in small letters, without signs and spaces.
pub fn plain(name: &str) -> String {
    name.to_lowercase().replace(|c: char| !c.is_alphanumeric(), "")
}

/// The known program that wrote a list with these columns. Its firing times are in milliseconds.
pub fn program(header: &[String]) -> Option<&'static Program> {
    let names: Vec<String> = header.iter().map(|name| plain(name)).collect();
    PROGRAMS
        .iter()
        .find(|program| program.columns.iter().all(|column| names.iter().any(|name| name == column)))
}

impl Program {
    /// Meaning of a column's name in the lists of this program.
    pub fn meaning(&self, name: &str) -> Meaning {
        match plain(name).as_str() {
            time if self.times.contains(&time) => Meaning::Known(Column::Fire),
            angle if angle == self.angle => Meaning::Known(Column::Angle),
            _ => meaning(name),
        }
    }
}

/// Meaning of a column's name in a list of an unknown program.
pub fn meaning(name: &str) -> Meaning {
    if let Some((column, unit)) = with_unit(name) {
        return if unit == column.unit() { Meaning::Known(column) } else { Meaning::OtherUnit(column, unit) };
    }
    match named(&plain(name)) {
        Some(column @ (Column::Fire | Column::Delay | Column::Launch)) => Meaning::WithoutUnit(column),
        // Such a column may name the explosive, or say that there is one.
        Some(Column::Charge) => Meaning::Other,
        Some(column) => Meaning::Known(column),
        None => unclear(name),
    }
}

/// The column that a plain name without a unit stands for.
fn named(plain: &str) -> Option<Column> {
    NAMES.iter().find(|(_, names)| names.contains(&plain)).map(|(column, _)| *column)
}

/// The column and the unit of a name that ends with a unit: `X (m)`, `fire_ms`, `Zeit [ms]`. A unit that the import does not read counts
/// only after a sign or a space: `delays` is no delay in seconds.
fn with_unit(name: &str) -> Option<(Column, &'static str)> {
    let small = name.trim().trim_end_matches([')', ']', '.']).trim_end().to_lowercase();
    let sign = |c: char| !c.is_alphanumeric();
    let ends = UNITS.iter().flat_map(|(unit, ends)| ends.iter().map(move |end| (*unit, *end)));
    ends.filter_map(|(unit, end)| {
        let before = small.strip_suffix(end)?;
        let column = named(&plain(before)).filter(|column| !column.unit().is_empty())?;
        let apart = before.ends_with(sign) || end.starts_with(sign);
        (apart || unit == column.unit()).then_some((column, unit))
    })
    .next()
}

/// Whether an unknown name may stand for a firing time, a delay or a row. The time at which a value was measured does not count.
fn unclear(name: &str) -> Meaning {
    let whole = plain(name);
    let mut words = name.split(|c: char| !c.is_alphanumeric()).map(str::to_lowercase);
    let timing = !whole.ends_with("timestamp")
        && (whole == "t"
            || TIMING.iter().any(|part| whole.contains(part))
            || words.any(|word| TIMING_WORDS.contains(&word.as_str())));
    if timing { Meaning::Unclear } else { Meaning::Other }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_of_names_are_read_or_told() {
        for name in ["X (м)", "Y (m)", "x_m", "Easting[m]", "Север, м", "estem"] {
            assert!(matches!(meaning(name), Meaning::Known(Column::X | Column::Y)), "{name}");
        }
        for name in ["Время (мс)", "Tiempo (ms)", "Zeit [ms]", "Time, ms", "Time (ms.)", "fire_ms", "firems"]
        {
            assert_eq!(meaning(name), Meaning::Known(Column::Fire), "{name}");
        }
        for name in ["Время", "Tiempo", "Zeit", "Time", "Firing time ()"] {
            assert_eq!(meaning(name), Meaning::WithoutUnit(Column::Fire), "{name}");
        }
        for name in ["Time (s)", "Время, с", "Zeit [sek]", "Tiempo_s", "Time (sec)"] {
            assert_eq!(meaning(name), Meaning::OtherUnit(Column::Fire, "s"), "{name}");
        }
        assert_eq!(meaning("y (mm)"), Meaning::OtherUnit(Column::Y, "mm"));
        assert_eq!(meaning("x (')"), Meaning::OtherUnit(Column::X, "ft"));
        assert_eq!(meaning("v0, m/s"), Meaning::Known(Column::Launch));
        assert_eq!(meaning("launch_ms"), Meaning::OtherUnit(Column::Launch, "ms"));
        assert_eq!(meaning("bearing_deg"), Meaning::Known(Column::Bearing));
        // The endings of these names are no units.
        for name in ["delays", "rows", "firing times", "Fire at (m:s)"] {
            assert_eq!(meaning(name), Meaning::Unclear, "{name}");
        }
        assert_eq!(meaning("from"), Meaning::Known(Column::From));
    }
}
