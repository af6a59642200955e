//! The shelter at rest, and when its rows fire.

use crate::options::Options;

pub const TIRE_MASS: f64 = 280.0;
pub const LAUNCH: f64 = 6.0;
pub const FRICTION: f64 = 0.5;
pub const GRAVITY: f64 = 9.81;

pub struct Scene {
    pub tires: Vec<[f64; 2]>,
    pub cables: Vec<Cable>,
    /// Firing time and launched tires, in order of time.
    pub shots: Vec<(f64, Vec<usize>)>,
}

pub struct Cable {
    pub ends: [usize; 2],
    pub length: f64,
    pub stiffness: f64,
}

impl Scene {
    pub fn build(options: &Options) -> Self {
        let (rows, columns) = (options.rows, options.columns);
        let quincunx = options.layout == "quincunx";
        let corner = |row: usize, column: usize| row * columns + column;
        let centre = |row: usize, column: usize| rows * columns + row * (columns - 1) + column;

        // Position in rows and columns, from 1.
        let mut places: Vec<[f64; 2]> = Vec::new();
        for row in 0..rows {
            places.extend((0..columns).map(|column| [row as f64 + 1.0, column as f64 + 1.0]));
        }
        if quincunx {
            for row in 0..rows - 1 {
                places.extend((0..columns - 1).map(|column| [row as f64 + 1.5, column as f64 + 1.5]));
            }
        }

        let mut links = Vec::new();
        for row in 0..rows {
            for column in 0..columns {
                let (right, up) = (column + 1 < columns, row + 1 < rows);
                if right {
                    links.push([corner(row, column), corner(row, column + 1)]);
                }
                if up {
                    links.push([corner(row, column), corner(row + 1, column)]);
                }
                if right && up {
                    let cell = [(row, column), (row + 1, column + 1), (row, column + 1), (row + 1, column)]
                        .map(|(row, column)| corner(row, column));
                    if quincunx {
                        links.extend(cell.map(|tire| [centre(row, column), tire]));
                    } else {
                        links.extend([[cell[0], cell[1]], [cell[2], cell[3]]]);
                    }
                }
            }
        }

        let tires: Vec<[f64; 2]> =
            places.iter().map(|[row, column]| [column * options.spacing, row * options.spacing]).collect();
        let cables = links
            .into_iter()
            .map(|ends| {
                let [from, to] = ends.map(|end| tires[end]);
                let length = (to[0] - from[0]).hypot(to[1] - from[1]);
                Cable { ends, length, stiffness: options.axial_stiffness / length }
            })
            .collect();
        let shots = options
            .blast_rows
            .iter()
            .enumerate()
            .map(|(shot, row)| {
                let launched = (0..places.len()).filter(|&tire| places[tire][0] == *row).collect();
                (shot as f64 * options.delay, launched)
            })
            .collect();
        Self { tires, cables, shots }
    }
}
