//! From a plan's layout to tires and cables: the one place where plan units become SI.

use nalgebra::Vector3;

use super::{Cable, Scene, TireId};
use crate::choice::{Link, OnOverload};
use crate::plan::{Layout, Mesh, Plan};

/// Two tied tires and the vector between their centres [m].
struct Tie {
    ends: [usize; 2],
    between: Vector3<f64>,
}

impl Scene {
    /// The scene of a valid plan.
    pub fn build(plan: &Plan) -> Self {
        let mut scene = Scene {
            position: Vec::new(),
            mass: Vec::new(),
            tire: Vec::new(),
            cables: Vec::new(),
            friction: plan.friction,
            gravity: plan.simulation.gravity_m_s2,
            breaking_force: (plan.cable.on_overload == OnOverload::Break)
                .then_some(plan.cable.breaking_force_kn * 1e3),
            mirrors: Vec::new(),
        };
        let ties = match &plan.layout {
            Layout::Grid(mesh) => scene.lay_grid(mesh),
            Layout::Quincunx(mesh) => scene.lay_quincunx(mesh),
            Layout::List { tires, cables } => {
                for (n, tire) in tires.iter().enumerate() {
                    scene.place(TireId::Listed(n + 1), tire.x_m, tire.y_m);
                }
                let between = |a: usize, b: usize| scene.position[b] - scene.position[a];
                cables.iter().map(|&(a, b)| Tie { ends: [a, b], between: between(a, b) }).collect()
            }
        };
        scene.mass = vec![plan.tire.mass_kg; scene.position.len()];
        if let Layout::List { tires, .. } = &plan.layout {
            for (mass, tire) in scene.mass.iter_mut().zip(tires) {
                *mass = tire.mass_kg.unwrap_or(*mass);
            }
        }
        let axial_stiffness = plan.cable.axial_stiffness_kn * 1e3;
        let slack = 1.0 + plan.cable.slack_percent * 1e-2;
        scene.cables = ties
            .into_iter()
            .map(|Tie { ends, between }| {
                let span = between - between.normalize() * plan.tire.outer_diameter_m;
                let rest_length = slack * span.norm();
                Cable { ends, rest_length, stiffness: axial_stiffness / rest_length, span }
            })
            .collect();
        // Runs of like cables one after the other, as the stepping loop takes them.
        scene.cables.sort_by_key(|cable| (cable.ends[1] as isize - cable.ends[0] as isize, cable.ends[0]));
        scene.find_mirrors();
        scene
    }

    fn place(&mut self, id: TireId, x: f64, y: f64) {
        self.position.push(Vector3::new(x, y, 0.0));
        self.tire.push(id);
    }

    /// Lays the tires whose row and column, counted from the first corner with the border, begin at `first`.
    fn lay_tires(&mut self, mesh: &Mesh, first: f64, rows: usize, columns: usize) {
        let from = first - mesh.border_rows as f64;
        for r in 0..rows {
            for c in 0..columns {
                let (x, y) = (from + c as f64, from + r as f64);
                let (row, column) = (y + 1.0, x + 1.0);
                let inside =
                    row >= 1.0 && row <= mesh.rows as f64 && column >= 1.0 && column <= mesh.columns as f64;
                let id = if inside { TireId::Cell { row, column } } else { TireId::Border { row, column } };
                self.place(id, x * mesh.column_spacing_m, y * mesh.row_spacing_m);
            }
        }
    }

    /// Returns the ties, as the other layouts do.
    fn lay_grid(&mut self, mesh: &Mesh) -> Vec<Tie> {
        let [rows, columns] = [mesh.rows, mesh.columns].map(|n| n + 2 * mesh.border_rows);
        self.lay_tires(mesh, 0.0, rows, columns);
        let [row, column, diagonal] =
            [Link::Row, Link::Column, Link::Diagonal].map(|link| mesh.links.contains(&link));
        let (dx, dy) = (mesh.column_spacing_m, mesh.row_spacing_m);
        let at = |r: usize, c: usize| r * columns + c;
        let mut ties = Vec::new();
        for r in 0..rows {
            for c in 0..columns {
                let (left, right, up) = (c > 0, c + 1 < columns, r + 1 < rows);
                let mut tie = |tied: bool, r2: usize, c2: usize, x: f64, y: f64| {
                    if tied {
                        ties.push(Tie { ends: [at(r, c), at(r2, c2)], between: Vector3::new(x, y, 0.0) });
                    }
                };
                tie(row && right, r, c + 1, dx, 0.0);
                tie(diagonal && up && left, r + 1, c.wrapping_sub(1), -dx, dy);
                tie(column && up, r + 1, c, 0.0, dy);
                tie(diagonal && up && right, r + 1, c + 1, dx, dy);
            }
        }
        ties
    }

    fn lay_quincunx(&mut self, mesh: &Mesh) -> Vec<Tie> {
        let diagonal = mesh.links.contains(&Link::Diagonal);
        let mut corners = mesh.clone();
        corners.links.retain(|link| *link != Link::Diagonal);
        let mut ties = self.lay_grid(&corners);
        let [rows, columns] = [mesh.rows, mesh.columns].map(|n| n + 2 * mesh.border_rows);
        let first_centre = self.position.len();
        self.lay_tires(mesh, 0.5, rows - 1, columns - 1);
        let (dx, dy) = (0.5 * mesh.column_spacing_m, 0.5 * mesh.row_spacing_m);
        let spokes = [(0, dx, dy), (1, -dx, dy), (columns, dx, -dy), (columns + 1, -dx, -dy)];
        for r in 0..rows - 1 {
            for c in (0..columns - 1).filter(|_| diagonal) {
                let (corner, centre) = (r * columns + c, first_centre + r * (columns - 1) + c);
                ties.extend(spokes.map(|(step, x, y)| Tie {
                    ends: [corner + step, centre],
                    between: Vector3::new(x, y, 0.0),
                }));
            }
        }
        ties
    }
}
