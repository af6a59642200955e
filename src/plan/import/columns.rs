//! The columns of a list of holes: their names in several languages, and names that look like times but are not known.

/// A column that is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Column {
    Id,
    X,
    Y,
    Row,
    Fire,
    Delay,
    From,
    Launch,
}

/// Names of the columns, in small letters and without signs or spaces.
const NAMES: &[(Column, &[&str])] = &[
    (
        Column::Id,
        &[
            "id",
            "hole",
            "holeid",
            "holename",
            "holeno",
            "holenumber",
            "number",
            "no",
            "name",
            "скважина",
            "номер",
            "номерскважины",
            "barreno",
            "taladro",
            "pozo",
            "numero",
            "número",
            "bohrloch",
            "bohrlochnr",
            "nummer",
            "nr",
        ],
    ),
    (
        Column::X,
        &[
            "x",
            "xm",
            "east",
            "easting",
            "eastingm",
            "startx",
            "startxlocation",
            "collarx",
            "xcollar",
            "х",
            "хм",
            "восток",
            "este",
            "estem",
            "ost",
            "ostwert",
            "rechtswert",
        ],
    ),
    (
        Column::Y,
        &[
            "y",
            "ym",
            "north",
            "northing",
            "northingm",
            "starty",
            "startylocation",
            "collary",
            "ycollar",
            "у",
            "ум",
            "север",
            "norte",
            "nortem",
            "nord",
            "nordwert",
            "hochwert",
        ],
    ),
    (
        Column::Row,
        &["row", "rowid", "rowname", "rowno", "blastrow", "ряд", "номерряда", "fila", "reihe", "bohrreihe"],
    ),
    (
        Column::Fire,
        &[
            "firems",
            "fireatms",
            "firetime",
            "firetimems",
            "firingtime",
            "firingtimems",
            "initiationtime",
            "initiationtimems",
            "holetime",
            "времявзрывамс",
            "времясрабатываниямс",
            "tiempodedisparoms",
            "zündzeitms",
            "zündzeitpunktms",
        ],
    ),
    (
        Column::Delay,
        &[
            "delay",
            "delayms",
            "timingdelay",
            "timingdelayms",
            "timingdelaymilliseconds",
            "замедление",
            "замедлениемс",
            "retardo",
            "retardoms",
            "verzögerung",
            "verzögerungms",
        ],
    ),
    (
        Column::From,
        &["from", "fromid", "fromhole", "fromholeid", "отскважины", "desde", "von", "vonbohrloch"],
    ),
    (Column::Launch, &["launch", "launchmpers", "launchvelocity", "v0"]),
];

/// Parts of names that stand for a firing time, a delay or a row.
const TIMING: &[&str] = &[
    "time",
    "timing",
    "interval",
    "period",
    "launchms",
    "delay",
    "fire",
    "firing",
    "deton",
    "initiat",
    "sequence",
    "milliseconds",
    "время",
    "замедл",
    "задерж",
    "интервал",
    "очеред",
    "tiempo",
    "retard",
    "retraso",
    "secuencia",
    "zeit",
    "zünd",
    "verzög",
    "reihe",
];
/// Whole words of names that stand for a firing time or a row.
const TIMING_WORDS: &[&str] = &["row", "rows", "ms", "lag", "ttd", "ряд", "ряда", "мс", "fila"];

/// A name in small letters, without signs and spaces.
pub fn plain(name: &str) -> String {
    name.to_lowercase().replace(|c: char| !c.is_alphanumeric(), "")
}

/// The column of this name.
pub fn find(name: &str) -> Option<Column> {
    // Without its signs a velocity in m/s would look like a time in ms.
    if ["launch m/s", "launch_m_s", "launch (m/s)", "launch, m/s"]
        .contains(&name.trim().to_lowercase().as_str())
    {
        return Some(Column::Launch);
    }
    let name = plain(name);
    NAMES.iter().find(|(_, names)| names.contains(&name.as_str())).map(|(column, _)| *column)
}

/// Whether a name that is not known may stand for a firing time, a delay or a row. The time at which a value was measured
/// is none of these.
pub fn looks_like_timing(name: &str) -> bool {
    let whole = plain(name);
    let words = name.split(|c: char| !c.is_alphanumeric()).map(str::to_lowercase);
    !whole.ends_with("timestamp")
        && (whole == "t"
            || TIMING.iter().any(|part| whole.contains(part))
            || words.into_iter().any(|word| TIMING_WORDS.contains(&word.as_str())))
}
