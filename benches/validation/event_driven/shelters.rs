//! The shelters of the reference answers: 280 kg a tire, μ = 0.5, launches of 6 m/s, rows fired 20 ms apart.

use nalgebra::Vector3;

use super::{Launch, Shelter, Tie};

/// Tires at `places` [m], those of `ties` tied by a rope of stiffness EA [N] that is just taut.
fn shelter(places: Vec<Vector3<f64>>, ties: &[[usize; 2]], axial_stiffness: f64) -> Shelter {
    let tie = |&ends: &[usize; 2]| {
        let length = (places[ends[1]] - places[ends[0]]).norm();
        Tie { ends, length, stiffness: axial_stiffness / length }
    };
    let ties = ties.iter().map(tie).collect();
    Shelter { places, mass: 280.0, friction: 0.5, ties }
}

fn up(time: f64, tire: usize) -> Launch {
    Launch { time, tire, velocity: Vector3::z() * 6.0 }
}

/// Four corner tires and a central one over the hole, `diagonal` [m] from corner to centre.
pub fn quincunx(diagonal: f64, axial_stiffness: f64) -> (Shelter, Vec<Launch>) {
    let half = diagonal / 2_f64.sqrt();
    let places = [(-half, -half), (half, -half), (-half, half), (half, half), (0.0, 0.0)];
    let ties = [[0, 1], [0, 2], [1, 3], [2, 3], [0, 4], [1, 4], [2, 4], [3, 4]];
    let places = places.map(|(x, y)| Vector3::new(x, y, 0.0)).to_vec();
    (shelter(places, &ties, axial_stiffness), vec![up(0.0, 4)])
}

/// Tires 1.5 m apart in rows and columns, each tied to its eight neighbours with EA = 1.4e6 N; `fired` are rows, from 0.
pub fn grid(rows: usize, columns: usize, fired: std::ops::Range<usize>) -> (Shelter, Vec<Launch>) {
    let tire = |row: usize, column: usize| row * columns + column;
    let (mut places, mut ties) = (Vec::new(), Vec::new());
    for row in 0..rows {
        for column in 0..columns {
            places.push(Vector3::new(1.5 * column as f64, 1.5 * row as f64, 0.0));
            let (here, last) = (tire(row, column), column + 1 == columns);
            let before = [
                (row > 0).then(|| tire(row - 1, column)),
                (column > 0).then(|| here - 1),
                (row > 0 && column > 0).then(|| tire(row - 1, column - 1)),
                (row > 0 && !last).then(|| tire(row - 1, column + 1)),
            ];
            ties.extend(before.into_iter().flatten().map(|neighbour| [neighbour, here]));
        }
    }
    let row = |(turn, row): (usize, usize)| {
        (0..columns).map(move |column| up(0.02 * turn as f64, row * columns + column))
    };
    (shelter(places, &ties, 1.4e6), fired.enumerate().flat_map(row).collect())
}
