//! Named choices of a plan and of the command line. Each enum owns its names.
//!
//! The plan reader, the schema, the command line and every text take the names from here.

use shelter_engine::choice;
pub use shelter_engine::choice::{Method, UnknownName};

choice! {
    /// Accuracy of a verdict: how fine its steps are at the start and at the end. `shelter accuracy` measures what each level costs.
    Accuracy, default Field {
        /// For a first look.
        Draft = "draft",
        /// For the decision.
        Field = "field",
        /// For the record.
        Reference = "reference",
    }
}

choice! {
    /// How the tires of a shelter lie.
    LayoutKind {
        /// Rows and columns.
        Grid = "grid",
        /// Rows and columns of corner tires, and one tire at the centre of every cell.
        Quincunx = "quincunx",
        /// Tires and cables one by one.
        List = "list",
    }
}

choice! {
    /// Neighbours that a cable may tie.
    Link {
        /// Neighbours within a row (along x).
        Row = "row",
        /// Neighbours within a column (along y).
        Column = "column",
        /// Diagonal neighbours; in a quincunx a centre tire and its corners.
        Diagonal = "diagonal",
    }
}

choice! {
    /// Order in which the holes of a blast row fire if they do not fire together.
    HoleOrder, default Left {
        /// From the hole with the smallest x; in a row along y, from the hole with the smallest y. Later rows begin on the same
        /// side.
        Left = "left",
        /// From the other end.
        Right = "right",
        /// From the middle of the row outward; the n-th holes of both sides fire together.
        Centre = "centre",
        /// From both ends inward; the n-th holes of both sides fire together.
        Ends = "ends",
    }
}

choice! {
    /// Orders of the blast rows that `search` may choose from.
    SearchedOrders, default All {
        /// Every order.
        All = "all",
        /// The order in which the plan lists the rows.
        Listed = "listed",
        /// Orders in which a row fires first, or beside a row that has fired.
        Adjacent = "adjacent",
    }
}

choice! {
    /// Effect of a force that exceeds the breaking force of a cable.
    OnOverload, default Report {
        /// The cable is reported, and pulls on.
        Report = "report",
        /// The cable is gone from then on.
        Break = "break",
    }
}

choice! {
    /// Kind of detonator; each kind has its own scatter of firing times.
    Detonator {
        /// Electronic.
        Electronic = "electronic",
        /// Pyrotechnic, in the hole.
        Pyrotechnic = "pyrotechnic",
        /// Pyrotechnic, between the holes at the surface.
        PyrotechnicSurface = "pyrotechnic surface",
    }
}

choice! {
    /// Observed quantity of a tire or a cable.
    ObservedQuantity {
        /// Greatest flight height of a tire [m].
        FlightHeight = "flight_height_m",
        /// Height of a tire at a time [m].
        Height = "height_m",
        /// Time at which a tire first leaves the ground [s].
        Lift = "lift_s",
        /// Time at which a tire first lands [s].
        Landing = "landing_s",
        /// Horizontal shift of a tire at the end [m].
        Drift = "drift_m",
        /// Greatest force of a cable [N].
        Force = "cable_force_n",
    }
}

choice! {
    /// Unknown that a fit estimates.
    Unknown {
        /// One factor on all launch velocities.
        Launch = "launch",
        /// A factor on the launch velocities of each blast row.
        LaunchByRow = "launch_by_row",
        /// Coefficient of friction.
        Friction = "friction",
        /// Slack of all cables.
        Slack = "slack_percent",
        /// A factor on the axial stiffness of all cables.
        AxialStiffness = "axial_stiffness",
        /// Stiffness of tie and tire at each end of a cable.
        EndStiffness = "end_stiffness",
        /// Damping of the cables.
        Damping = "damping",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_choice_has_one_name_for_serde_display_and_parsing() {
        for &accuracy in Accuracy::ALL {
            assert_eq!(accuracy.name().parse(), Ok(accuracy));
            assert_eq!(accuracy.to_string(), accuracy.name());
            let json = serde_json::to_value(accuracy).expect("a text");
            assert_eq!(json, accuracy.name());
            assert_eq!(serde_json::from_value::<Accuracy>(json).ok(), Some(accuracy));
        }
        let unknown = "fine".parse::<Accuracy>().expect_err("unknown");
        assert_eq!(unknown.to_string(), "'fine' is none of draft, field, reference");
    }
}
