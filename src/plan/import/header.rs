//! Finds which column of a list holds which value: by the names in its header, or in Kirra's lists without a header by their marks.

use super::columns::{Column, Meaning, meaning, plain, program};
use super::direction::Directions;
use super::table::Line;
use crate::plan::diagnostic::Mistake;
use crate::plan::reader::nearest;

/// Remedy: what to write into the first line.
pub const REMEDY: &str =
    "name the columns in the first line: hole, x, y in metres, and row, or fire_ms, or delay_ms and from";

/// The columns of a list.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Columns {
    /// The columns that are read, each with its index.
    pub read: Vec<(Column, usize)>,
    /// Number of values of a line.
    pub width: usize,
    /// Names of the columns that are not read.
    pub left_out: Vec<String>,
    /// Note about the program that the list seems to come from.
    pub note: Option<String>,
    /// Whether rows only say where holes lie, as in the lists of design programs.
    pub rows_are_places: bool,
}

impl Columns {
    /// Index of a column.
    pub fn index(&self, column: Column) -> Option<usize> {
        self.read.iter().find(|(known, _)| *known == column).map(|(_, n)| *n)
    }

    fn has(&self, column: Column) -> bool {
        self.index(column).is_some()
    }
}

/// Lists that Kirra writes without a header: number of values, and the header to put above them.
const KIRRA_WITHOUT_TIMES: &[(usize, &str)] = &[
    (4, "hole,x,y,z"),
    (7, "hole,x,y,z,toe_x,toe_y,toe_z"),
    (9, "hole,x,y,z,toe_x,toe_y,toe_z,diameter,type"),
];

/// The columns of a list without a header: a list of Kirra that gives the preceding hole of each hole as `Pattern:::Hole`.
pub fn without_header(first: &Line, directions: Directions) -> Result<Columns, Vec<Mistake>> {
    if directions == Directions::AgainstHoles {
        let message = "a table without a header does not say the angles and bearings of its holes".to_owned();
        let remedy = "export it with a header and all columns, or leave out --directions".to_owned();
        return Err(vec![Mistake { span: first.span.clone(), message, remedy }]);
    }
    let width = first.values.len();
    let names_a_hole = |n: usize| first.values[n].contains(":::");
    let read = match width {
        12 if names_a_hole(9) => {
            vec![(Column::Id, 0), (Column::X, 1), (Column::Y, 2), (Column::From, 9), (Column::Delay, 10)]
        }
        14 if names_a_hole(11) && first.values[1] == "hole" => vec![
            (Column::Pattern, 0),
            (Column::Id, 2),
            (Column::X, 3),
            (Column::Y, 4),
            (Column::From, 11),
            (Column::Delay, 12),
        ],
        _ => {
            let message = format!("a table of {width} columns without a header");
            let of_kirra = KIRRA_WITHOUT_TIMES.iter().find(|(count, _)| *count == width);
            let remedy = of_kirra.map_or(REMEDY.to_owned(), |(_, header)| {
                format!("{REMEDY}; if Kirra wrote it, put this line before it: {header}")
            });
            return Err(vec![Mistake { span: first.span.clone(), message, remedy }]);
        }
    };
    let note = format!(
        "the list has no header: its {width} columns are read as Kirra writes them, with delays in ms after the hole named"
    );
    Ok(Columns { read, width, note: Some(note), ..Columns::default() })
}

/// The columns of a list whose first line names them.
pub fn with_header(header: &Line, directions: Directions) -> Result<Columns, Vec<Mistake>> {
    // Cells without a name at the end of a header are not columns.
    let width = header.values.iter().rposition(|name| !name.is_empty()).map_or(0, |last| last + 1);
    let mut columns = Columns { width, ..Columns::default() };
    let mut mistakes = Vec::new();
    let mut wrong = |message: String, remedy: String| {
        mistakes.push(Mistake { span: header.span.clone(), message, remedy })
    };
    let program = program(&header.values);
    if header.runs_on {
        wrong("a name runs over several lines".to_owned(), "is a quotation mark missing?".to_owned());
    }
    for (n, name) in header.values[..width].iter().enumerate() {
        let mut meaning = program.map_or_else(|| meaning(name), |program| program.meaning(name));
        if directions == Directions::Vertical
            && matches!(meaning.column(), Some(Column::Angle | Column::Bearing))
        {
            meaning = Meaning::Other;
        }
        if let Some(column) = meaning.column() {
            if columns.has(column) {
                let message =
                    format!("two columns are a hole's {column:?}; the second is `{name}`").to_lowercase();
                wrong(message, "rename or remove one of them".to_owned());
            }
            columns.read.push((column, n));
        }
        match meaning {
            Meaning::Known(_) => {}
            Meaning::WithoutUnit(column) => {
                let unit = column.unit();
                wrong(
                    format!("the column `{name}` does not say its unit"),
                    format!("call it `{name} {unit}` if it is in {unit}; else convert it"),
                );
            }
            Meaning::OtherUnit(column, found) => {
                let unit = column.unit();
                wrong(
                    format!("the column `{name}` is in {found}, not in {unit}"),
                    format!("convert its values to {unit}, and write {unit} in its name"),
                );
            }
            Meaning::Unclear => wrong(
                format!("the column `{name}` looks like a time, a row or a launch velocity, and is not known"),
                "call it fire_ms if it is the firing time in ms counted from the first hole, delay_ms if it is a delay in ms after the hole in a column `from`, row, or launch_m_s; else remove it".to_owned(),
            ),
            Meaning::Other if name.is_empty() => {
                wrong(format!("column {} has no name", n + 1), "name it, or remove it".to_owned());
            }
            Meaning::Other => columns.left_out.push(format!("`{name}`")),
        }
    }
    for (column, word) in [(Column::X, "x"), (Column::Y, "y")] {
        if !columns.has(column) {
            let all: Vec<String> = header.values.iter().map(|name| plain(name)).collect();
            let near = nearest(word, all.iter().map(String::as_str))
                .map(|near| format!("is it `{near}`? "))
                .unwrap_or_default();
            wrong(format!("no column is {word}"), format!("{near}{REMEDY}"));
        }
    }
    if directions == Directions::AgainstHoles {
        if !columns.has(Column::Angle) {
            wrong(
                "no column is the angle of the holes from the vertical".to_owned(),
                "name it angle_from_vertical_deg, 0 in a vertical hole (90 less a dip), or leave out --directions".to_owned(),
            );
        }
        if !columns.has(Column::Bearing) {
            wrong(
                "no column is the bearing of the holes".to_owned(),
                "name it bearing_deg, clockwise from north toward the bottom of the hole, or leave out --directions".to_owned(),
            );
        }
    }
    // Without names, line numbers would stand for the holes, and a hole would follow another hole than the list means.
    if columns.has(Column::From) && columns.has(Column::Delay) && !columns.has(Column::Id) {
        wrong(
            "holes that follow others, in a list without a column of their names".to_owned(),
            "call the column of the names `hole`".to_owned(),
        );
    }
    match [Column::Fire, Column::Delay, Column::From].map(|column| columns.has(column)) {
        [false, false, true] => wrong(
            "holes that follow others, without a column of their delays".to_owned(),
            "name the column of the delays delay_ms, or remove the column `from`".to_owned(),
        ),
        [false, true, false] => wrong(
            "a delay without saying after what".to_owned(),
            "call it fire_ms if it counts from the first hole; if it counts from another hole, add a column `from` that names it".to_owned(),
        ),
        [true, true, false] => wrong(
            "a delay besides the firing time, without saying after what".to_owned(),
            "add it to the firing time if it comes after that, and remove the column; or add a column `from` with the hole before".to_owned(),
        ),
        [true, false, true] => columns.left_out.extend(columns.index(Column::From).map(|n| format!("`{}`", header.values[n]))),
        _ => {}
    }
    columns.rows_are_places = program.is_some();
    let angles = match directions {
        Directions::Vertical => "",
        Directions::AgainstHoles => ", its angles count from the vertical",
    };
    columns.note = program.map(|program| {
        format!("the columns are those of {}: its firing times are in ms{angles}", program.name)
    });
    if mistakes.is_empty() { Ok(columns) } else { Err(mistakes) }
}
