//! A person of 57 kg on a slackline between two anchors, with a load cell at one of them (slacktivity.com, "Forces in highlining").
//!
//! Typed in: span, stretch of the webbing at 10 kN, tension of the empty line, tension with the person standing, greatest tension
//! and rate of bouncing. Here the webbing is a tie on each side of a mass, straight in its law of force and without weight.

use nalgebra::Vector3;
use shelter::choice::Method;
use shelter::simulation::RunError;

use super::rig::{GRAVITY, History, Rig};

const PERSON: f64 = 57.0;

/// A line as rigged, and what was measured on it.
pub struct Line {
    pub name: &'static str,
    /// Span [m].
    pub span: f64,
    /// Stretch at 10 kN, of the length.
    pub stretch: f64,
    /// Tension of the empty line [N].
    pub empty: f64,
    /// Tension with the person standing in the middle [N].
    pub standing: f64,
    /// Greatest tension of hard bouncing [N], and its rate [1/s].
    pub bouncing: (f64, f64),
    /// Greatest tension of a fall into the leash [N].
    pub fall: f64,
}

/// The source prints 15 kN for the empty line of 63 m, more than with the person on it: read as 1.5 kN.
pub const LINES: [Line; 3] = [
    Line {
        name: "63 m of nylon",
        span: 63.0,
        stretch: 0.18,
        empty: 1500.0,
        standing: 2400.0,
        bouncing: (3600.0, 0.35),
        fall: 4300.0,
    },
    Line {
        name: "39 m of nylon",
        span: 39.0,
        stretch: 0.18,
        empty: 1400.0,
        standing: 2100.0,
        bouncing: (3300.0, 0.46),
        fall: 4000.0,
    },
    Line {
        name: "41 m of polyester",
        span: 41.0,
        stretch: 0.04,
        empty: 1700.0,
        standing: 3100.0,
        bouncing: (4400.0, 0.56),
        fall: 5300.0,
    },
];

impl Line {
    /// Stiffness EA [N].
    fn stiffness(&self) -> f64 {
        1e4 / self.stretch
    }

    /// Length of the webbing without tension [m].
    fn length(&self) -> f64 {
        self.span / (1.0 + self.empty / self.stiffness())
    }

    /// Depth of the middle [m] at a tension [N].
    fn depth(&self, tension: f64) -> f64 {
        let half = 0.5 * self.length() * (1.0 + tension / self.stiffness());
        (half * half - 0.25 * self.span * self.span).sqrt()
    }

    /// Rig with the person at rest, so deep that the tension is `tension` [N]; the person is mass 0.
    fn rig(&self, tension: f64) -> Rig {
        let mut rig = Rig::new(0.0, 0.0);
        let person = rig.mass(PERSON, Vector3::new(0.0, -self.depth(tension), 0.0), Vector3::zeros());
        for side in [-0.5, 0.5] {
            let anchor = rig.anchor(Vector3::x() * (side * self.span));
            rig.tie([anchor, person], 0.5 * self.length(), self.stiffness() / (0.5 * self.length()));
        }
        rig.pull(person, Vector3::new(0.0, -PERSON * GRAVITY, 0.0));
        rig
    }

    /// Tension [N] at which the person, let go at rest, moves neither up nor down: bisection to 0.1 N.
    pub fn standing_tension(&self, method: Method) -> Result<f64, RunError> {
        let (mut sinks, mut rises) = (self.empty, 1e4);
        while rises - sinks > 0.1 {
            let tension = 0.5 * (sinks + rises);
            let mut height = 0.0;
            self.rig(tension).run(method, 1e-3, 0.01, |motion| height = motion.displacement(0).y)?;
            if height > 0.0 {
                rises = tension;
            } else {
                sinks = tension;
            }
        }
        Ok(0.5 * (sinks + rises))
    }

    /// Rate [1/s] at which the person, let go at rest at the greatest tension of bouncing, comes and goes.
    pub fn bouncing_rate(&self, method: Method) -> Result<f64, RunError> {
        let mut height = History::default();
        self.rig(self.bouncing.0).run(method, 1e-3, 5.0, |motion| {
            height.0.push([motion.time(), motion.displacement(0).y]);
        })?;
        let top = height.turning_points().first().map_or(f64::NAN, |[time, _]| *time);
        Ok(0.5 / top)
    }

    /// Free fall [m] into a leash without stretch, in the middle of the line, that gives the measured tension by the balance of
    /// energy.
    pub fn fall_that_explains(&self) -> f64 {
        let strain = |tension: f64| tension / self.stiffness();
        let stored =
            0.5 * self.stiffness() * self.length() * (strain(self.fall).powi(2) - strain(self.empty).powi(2));
        stored / (PERSON * GRAVITY) - self.depth(self.fall)
    }
}
