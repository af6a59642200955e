//! The direction of a launch, derived from the way down of its hole.

/// Direction of the launches of a list.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Directions {
    /// Straight up, whatever the list says about its holes.
    #[default]
    Vertical,
    /// Against the way down of each hole. The list must give angles and bearings.
    AgainstHoles,
}

/// Tilt of a launch, as a plan writes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tilt {
    /// Angle from the vertical [°].
    pub deg: f64,
    /// Azimuth from +x toward +y [°], from 0 to below 360.
    pub toward_deg: f64,
}

impl Tilt {
    /// Tilt of the launch against the way down of a hole, to a thousandth of a degree; `None` if the hole is vertical.
    ///
    /// `angle_deg` is the angle of the hole from the vertical [°]. `bearing_deg`, β, is the bearing of the bottom of the hole, clockwise
    /// from north [°]. x points east and y north; azimuths count from +x toward +y.
    ///
    /// 1. The hole goes down toward the azimuth 90° - β.
    /// 2. The launch points the other way, 180° further: toward 270° - β.
    pub fn against_hole(angle_deg: f64, bearing_deg: f64) -> Option<Self> {
        let rounded = |deg: f64| (deg * 1e3).round() / 1e3;
        let toward_deg = rounded((270.0 - bearing_deg).rem_euclid(360.0)) % 360.0;
        Some(Self { deg: rounded(angle_deg), toward_deg }).filter(|tilt| tilt.deg > 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn launches_oppose_the_way_down_of_their_holes() {
        let launch = |angle: f64, bearing: f64| {
            Tilt::against_hole(angle, bearing).map(|tilt| (tilt.deg, tilt.toward_deg))
        };
        assert_eq!(launch(0.0, 90.0), None);
        // A hole that goes down to the north launches to the south, a hole that goes down to the east launches to the west, and so on.
        assert_eq!(launch(15.0, 0.0), Some((15.0, 270.0)));
        assert_eq!(launch(15.0, 90.0), Some((15.0, 180.0)));
        assert_eq!(launch(15.0, 180.0), Some((15.0, 90.0)));
        assert_eq!(launch(15.0, 270.0), Some((15.0, 0.0)));
        assert_eq!(launch(15.0, 360.0), Some((15.0, 270.0)));
        assert_eq!(launch(15.0, -90.0), Some((15.0, 0.0)));
        assert_eq!(launch(15.0, 270.0 + 1e-9), Some((15.0, 0.0)));
        assert_eq!(launch(10.25, 313.784), Some((10.25, 316.216)));
    }

    #[test]
    fn hole_and_launch_lie_on_one_line() {
        for (angle, bearing) in [(5.0_f64, 12.0_f64), (15.0, 175.94), (30.0, 237.975), (60.0, 359.0)] {
            let tilt = Tilt::against_hole(angle, bearing).expect("an inclined hole");
            let ((sideways, down), (east, north)) =
                (angle.to_radians().sin_cos(), bearing.to_radians().sin_cos());
            let ((outward, up), (y, x)) =
                (tilt.deg.to_radians().sin_cos(), tilt.toward_deg.to_radians().sin_cos());
            let sums = [sideways * east + outward * x, sideways * north + outward * y, up - down];
            assert!(sums.iter().all(|sum| sum.abs() < 1e-4), "{angle} {bearing}: {sums:?}");
        }
    }
}
