//! Every key of a plan: one row each.
//!
//! Sections stand in the order of a plan, the keys of a section in the order of the terminal's editor. A row gives the name of the key, the
//! kind of its value, a valid value, and a description. Where they apply, the default, the usual range, the label in the editor, and
//! whether the editor offers the key follow. A new key is one row here, one field of the plan, and the line that reads it.

use std::ops::RangeInclusive;

use super::{Key, Kind, Section, key, number, section};
use crate::choice::{Accuracy, Detonator, HoleOrder, LayoutKind, Link, Method, OnOverload, SearchedOrders};
use crate::ropes::catalogue;

/// Old names of sections, each with the section that took its place.
pub const RENAMED: [(&str, &Key); 1] = [("scatter", &plan::UNCERTAINTY)];

/// Names that screens use for a limit, each with its key: people may write these names into a plan.
pub const CALLED: [(&str, &Key); 2] = [("slide_m", &limits::DRIFT_M), ("slide", &limits::DRIFT_M)];

/// Largest number of tires in a shelter.
pub const MOST_TIRES: usize = 4_000_000;

const POSITION: Kind = number("m", -1e7..=1e7);
const SPACING: RangeInclusive<f64> = 1e-4..=1e5;
const MASS: Kind = number("kg", 1e-3..=1e7);
const CABLE_FORCE: Kind = number("kN", 1e-6..=1e9);
const FRICTION_RANGE: RangeInclusive<f64> = 0.0..=1e9;
const SLACK: RangeInclusive<f64> = 0.0..=1e3;
const LIMIT: Kind = number("m", 1e-6..=1e6);
const TIME: Kind = number("ms", 0.0..=1e9);
const PERCENT: Kind = number("%", 0.0..=100.0);
const TIRE_NUMBER: Kind = Kind::Whole(1..=MOST_TIRES);

fn rope_names() -> Vec<&'static str> {
    catalogue().ropes.iter().map(|rope| rope.name.as_str()).collect()
}

fn termination_names() -> Vec<&'static str> {
    catalogue().terminations.iter().map(|termination| termination.name.as_str()).collect()
}

/// Declares sections: for each a module with a constant for every key, and the [`Section`] that lists the keys.
macro_rules! sections {
    ($( $section:ident $title:literal $doc:literal { $( $key:ident = $value:expr; )+ } )+) => { $(
        #[doc = concat!("Keys of ", $title, ".")]
        #[allow(missing_docs)]
        pub mod $section {
            use super::*;
            $( pub const $key: Key = $value; )+
            pub const SECTION: Section = Section { title: $title, doc: $doc, keys: &[$(&$key),+] };
        }
    )+ };
}

sections! {
    plan "the plan" "A blast row, the shelter over it, and the delay options to choose from" {
        TITLE = key("title", Kind::Text, "\"…\"", "free text above every view").described("path of the file");
        SHELTER = section("shelter", &shelter::SECTION, "layout, rows, columns and spacing_m").required();
        TIRE = section("tire", &tire::SECTION, "mass_kg = 280").required();
        CABLE = section("cable", &cable::SECTION, "rope = \"GOST 2688-80 6.2\"").required();
        GROUND = section("ground", &ground::SECTION, "friction = 0.5").required();
        BLAST_ROW = key("blast_row", Kind::Sections(&blast_row::SECTION), "name, under_row and launch_m_s",
            "in the order listed").required();
        LIMITS = section("limits", &limits::SECTION, "flight_height_m and cable_safety_factor").required();
        DELAY = key("delay", Kind::Sections(&delay::SECTION), "name and interval_ms", "options to compare")
            .required();
        SIMULATION = section("simulation", &simulation::SECTION, "accuracy = \"field\"");
        UNCERTAINTY = section("uncertainty", &uncertainty::SECTION, "detonator = \"electronic\"");
        SIZE = section("size", &size::SECTION, "most_border_rows = 1");
        SEARCH = section("search", &search::SECTION, "intervals_ms = [17, 25, 42]");
    }

    shelter "[shelter]" "tires and the ties between them" {
        LAYOUT = key("layout", Kind::Choice(LayoutKind::NAMES), "\"grid\"", "how the tires lie").required();
        ROWS = key("rows", Kind::Whole(1..=MOST_TIRES), "5", "along y, numbered from 1").edit("shelter rows");
        COLUMNS = key("columns", Kind::Whole(1..=MOST_TIRES), "10", "along x, numbered from 1")
            .edit("shelter columns");
        SPACING_M = key("spacing_m", Kind::NumberOrSection(&number("m", SPACING), &spacing::SECTION), "1.5",
            "centre to centre").usual(0.5, 10.0).edit("spacing, m");
        LINKS = key("links", Kind::List(&Kind::Choice(Link::NAMES)), "[\"row\", \"column\", \"diagonal\"]",
            "which neighbours are tied").described("all");
        BORDER_ROWS = key("border_rows", Kind::Whole(0..=1000), "1", "rows of ballast around the mesh, over no hole")
            .default(0.0).edit("border rows").offered();
        TIRE = key("tire", Kind::Sections(&listed_tire::SECTION), "x_m and y_m", "of a list");
        CABLE = key("cable", Kind::Sections(&listed_cable::SECTION), "from and to", "of a list");
    }

    spacing "[shelter.spacing_m]" "between rows, between columns" {
        ROW = key("row", number("m", SPACING), "1.5", "between rows").required();
        COLUMN = key("column", number("m", SPACING), "1.6", "between columns").required();
    }

    listed_tire "[[shelter.tire]]" "one tire" {
        X_M = key("x_m", POSITION, "0", "along the rows").required();
        Y_M = key("y_m", POSITION, "0", "across the rows").required();
        MASS_KG = key("mass_kg", MASS, "280", "instead of that of [tire]");
    }

    listed_cable "[[shelter.cable]]" "one cable" {
        FROM = key("from", TIRE_NUMBER, "1", "number of a tire, from 1").required();
        TO = key("to", TIRE_NUMBER, "2", "number of a tire, from 1").required();
    }

    tire "[tire]" "the tire at every position" {
        MASS_KG = key("mass_kg", MASS, "280", "").required().usual(30.0, 3000.0).edit("tire mass, kg");
        OUTER_DIAMETER_M = key("outer_diameter_m", number("m", 0.0..=1e3), "1.6",
            "cables run from rim to rim; 0: from centre to centre").default(0.0).usual(0.7, 4.0).edit("outer diameter, m").offered();
        RESTITUTION = key("restitution", number("", 0.0..=0.9), "0.3", "speed after a landing over speed before")
            .default(0.0).edit("restitution").offered();
    }

    cable "[cable]" "the rope of every tie: from the catalogue, or stiffness and breaking force" {
        ROPE = key("rope", Kind::Catalogue(rope_names), "\"GOST 2688-80 6.2\"", "`shelter ropes` lists the catalogue")
            .edit("rope");
        TERMINATION = key("termination", Kind::Catalogue(termination_names), "\"clips\"",
            "the breaking force used is rope × termination").edit("termination").offered();
        TERMINATION_PERCENT = key("termination_percent", number("%", 1.0..=100.0), "80",
            "share of the breaking force that the termination holds").default(100.0);
        SLACK_PERCENT = key("slack_percent", number("%", SLACK), "2", "length over distance").default(0.0).usual(0.0, 15.0)
            .edit("slack, %").offered();
        AXIAL_STIFFNESS_KN = key("axial_stiffness_kn", CABLE_FORCE, "1519", "EA").usual(20.0, 2e5).edit("axial stiffness EA, kN");
        BREAKING_FORCE_KN = key("breaking_force_kn", CABLE_FORCE, "20.9", "").usual(1.0, 2500.0).edit("breaking force, kN");
        DAMPING_PERCENT = key("damping_percent", number("%", 0.0..=100.0), "5", "of critical damping, of two tires on a cable")
            .default(0.0).usual(0.0, 20.0).edit("damping, %").offered();
        END_STIFFNESS_KN_M = key("end_stiffness_kn_m", number("kN/m", 1e-3..=1e12), "2000",
            "of tie and tire at each end, in line with the rope").described("stiff ends").usual(400.0, 1e6).edit("stiffness of ends, kN/m")
            .offered();
        ON_OVERLOAD = key("on_overload", Kind::Choice(OnOverload::NAMES), "\"report\"",
            "whether a cable past its breaking force is reported and pulls on, or is gone")
            .named(OnOverload::DEFAULT.name());
    }

    ground "[ground]" "the ground under the tires" {
        FRICTION = key("friction", number("", FRICTION_RANGE), "0.5", "of a tire on the ground; rocky soil 0.3 to 0.5")
            .required().usual(0.1, 1.0).edit("friction");
        SLOPE_PERCENT = key("slope_percent", number("%", 0.0..=200.0), "10", "fall of the ground over its level length")
            .default(0.0).edit("slope, %").offered();
        SLOPE_TOWARD_DEG = key("slope_toward_deg", number("°", -360.0..=360.0), "270",
            "direction downhill, from +x toward +y").default(0.0).edit("slope toward, deg")
            .offered_beside(SLOPE_PERCENT.name);
    }

    blast_row "[[blast_row]]" "holes that a delay option fires as one group, together or one after another" {
        NAME = key("name", Kind::Text, "\"1\"", "delay options address the row by it").required();
        LAUNCH_M_S = key("launch_m_s", number("m/s", 1e-3..=1e4), "6.0", "launch velocity of the tires; with push_ms the impulse over the mass, before gravity takes its part")
            .usual(2.5, 30.0).edit("launch, m/s");
        FREE_FLIGHT_HEIGHT_M = key("free_flight_height_m", number("m", 1e-6..=1e5), "1.83",
            "seen on a loose test tire on level ground, instead of launch_m_s").edit("free flight height, m");
        TILT_DEG = key("tilt_deg", number("°", 0.0..=80.0), "10", "of the launch from the ground's normal")
            .default(0.0).usual(0.0, 45.0).edit("tilt, deg");
        TILT_TOWARD_DEG = key("tilt_toward_deg", number("°", -360.0..=360.0), "90",
            "direction of the tilt, from +x toward +y").default(0.0).edit("tilt toward, deg")
            .offered_beside(TILT_DEG.name);
        PUSH_MS = key("push_ms", number("ms", 0.0..=200.0), "20", "time over which the launch acts, as a constant force")
            .default(0.0).usual(0.5, 40.0).edit("push, ms");
        CHARGE_KG = key("charge_kg", number("kg", 1e-6..=1e6), "25", "explosive in each hole").usual(0.1, 2000.0).edit("charge, kg");
        STEMMING_M = key("stemming_m", number("m", 0.01..=1e3), "3.0", "above the charge of each hole: for `shelter launch` and the page")
            .usual(0.3, 15.0).edit("stemming, m");
        HOLE_DIAMETER_MM = key("hole_diameter_mm", number("mm", 1.0..=2e3), "105", "of each hole: for `shelter launch` and the page")
            .usual(30.0, 400.0).edit("hole diameter, mm");
        PUSH_DEPTH_M = key("push_depth_m", number("m", 0.01..=1e3), "0.8",
            "depth below the hole's mouth from which the push comes: a hole beside its tire pushes it aside")
            .described("0.8 in samples; as planned the push is straight up").usual(0.3, 5.0).edit("push depth, m");
        UNDER_ROW = key("under_row", Kind::ShelterRow(0.0..=1e7), "2", "launches every tire of this shelter row")
            .edit("under row");
        UNDER_TIRES = key("under_tires", Kind::List(&TIRE_NUMBER), "[3, 4]", "launches these tires of a list");
        HOLES = key("holes", Kind::Sections(&hole::SECTION), "[{ x_m = 1.5, y_m = 4.5, launch_m_s = 6.0 }]",
            "one by one; each hole has its own launch_m_s or free_flight_height_m, tilt_deg with tilt_toward_deg, push_ms, charge_kg, stemming_m, hole_diameter_mm, and push_depth_m");
    }

    hole "a hole" "one hole; it launches the nearest tire" {
        X_M = key("x_m", POSITION, "1.5", "along the rows").required();
        Y_M = key("y_m", POSITION, "4.5", "across the rows").required();
        LAUNCH_M_S = blast_row::LAUNCH_M_S;
        FREE_FLIGHT_HEIGHT_M = blast_row::FREE_FLIGHT_HEIGHT_M;
        TILT_DEG = blast_row::TILT_DEG;
        TILT_TOWARD_DEG = blast_row::TILT_TOWARD_DEG;
        PUSH_MS = blast_row::PUSH_MS;
        CHARGE_KG = blast_row::CHARGE_KG;
        STEMMING_M = blast_row::STEMMING_M;
        HOLE_DIAMETER_MM = blast_row::HOLE_DIAMETER_MM;
        PUSH_DEPTH_M = blast_row::PUSH_DEPTH_M;
    }

    limits "[limits]" "what an option must keep to pass" {
        FLIGHT_HEIGHT_M = key("flight_height_m", LIMIT, "1.5",
            "greatest rise of any tire's centre; an edge may stand half a diameter higher").required().usual(0.05, 10.0)
            .edit("limit of flight height, m");
        CABLE_SAFETY_FACTOR = key("cable_safety_factor", number("", 1.0..=1e6), "2.0",
            "breaking force / greatest force").required().usual(1.2, 20.0).edit("cable safety factor");
        DRIFT_M = key("drift_m", LIMIT, "0.5", "greatest horizontal shift of any tire at the end")
            .usual(0.05, 20.0).edit("limit of slide, m").offered();
        HOLES_IN_8_MS = key("holes_in_8_ms", Kind::Whole(1..=MOST_TIRES), "20", "most holes that fire within any 8 ms")
            .edit("limit of holes in 8 ms").offered();
        CHARGE_IN_8_MS_KG = key("charge_in_8_ms_kg", number("kg", 1e-6..=1e9), "200",
            "heaviest charge within any 8 ms; every hole then needs charge_kg").usual(1.0, 20000.0).edit("limit of charge in 8 ms, kg").offered();
        ACCEPTED_RISK_PERCENT = key("accepted_risk_percent", number("%", 1e-6..=50.0), "1",
            "share of the shots that may exceed a limit").default(1.0).usual(0.01, 2.0).edit("accepted risk, %").offered();
        WITHSTANDS_ONE_DUD = key("withstands_one_dud", Kind::Flag, "true",
            "whether a PASS also needs this: with any one dud the planned shot passes, and dud_risk_percent is kept").named("false");
        DUD_RISK_PERCENT = key("dud_risk_percent", number("%", 1e-6..=90.0), "10",
            "share of the shots with the worst dud that may exceed a limit, with withstands_one_dud").default(10.0).usual(0.1, 20.0);
    }

    delay "[[delay]]" "one delay option" {
        NAME = key("name", Kind::Text, "\"20 ms\"", "name in every view").required().edit("name");
        INTERVAL_MS = key("interval_ms", TIME, "20", "between successive blast rows").usual(4.0, 20000.0).edit("interval, ms");
        AT_MS = key("at_ms", Kind::List(&TIME), "[0, 20, 40]", "firing time of each blast row, in the order listed")
            .usual(1.0, 20000.0).edit("at, ms");
        ORDER = key("order", Kind::RowNames, "[\"2\", \"1\"]", "names of the blast rows as they fire")
            .described("as listed").edit("order").offered_beside(INTERVAL_MS.name);
        HOLE_INTERVAL_MS = key("hole_interval_ms", TIME, "17", "between successive holes of each row; 0: rows fire at once")
            .default(0.0).usual(1.0, 20000.0).edit("hole interval, ms").offered();
        HOLE_ORDER = key("hole_order", Kind::Choice(HoleOrder::NAMES), "\"left\"",
            "where the holes of each row begin: left is toward the smaller x, of a row within 22.5° of y toward the smaller y, of a further row \
             as of the one before; from centre or ends, the n-th holes of both sides fire together")
            .named(HoleOrder::DEFAULT.name()).edit("hole order").offered_beside(HOLE_INTERVAL_MS.name);
        FIRED_THROUGH = key("fired_through", Kind::Flag, "true",
            "whether one hole fires the next: a dud takes along those later on its side of the row; what the plan leaves open is judged each way, and each sampled shot counts as the worst of them").named("false");
    }

    simulation "[simulation]" "how to compute" {
        DURATION_S = key("duration_s", number("s", 1e-6..=1e6), "1.5", "end of the run")
            .described("until every tire is at rest").edit("duration, s");
        ACCURACY = key("accuracy", Kind::Choice(Accuracy::NAMES), "\"field\"", "how fine a verdict starts and ends")
            .named(Accuracy::DEFAULT.name());
        METHOD = key("method", Kind::Choice(Method::NAMES), "\"verlet\"", "time integration method")
            .named(Method::DEFAULT.name());
        GRAVITY_M_S2 = key("gravity_m_s2", number("m/s²", 0.0..=1e3), "9.81", "gravity").default(9.81).usual(9.7, 9.9);
    }

    uncertainty "[uncertainty]" "what is not known of the shot, and how far; 0 or [x, x] means exact" {
        DETONATOR = key("detonator", Kind::Choice(Detonator::NAMES), "\"electronic\"", "gives the scatter of firing times")
            .described("electronic, without delay_sd_ms and delay_cv_percent")
            .edit("detonators").offered();
        DELAY_SD_MS = key("delay_sd_ms", number("ms", 0.0..=1e6), "0.5",
            "standard deviation of each delay between rows, or between holes; holes without one between them fire as one")
            .described("that of the detonator").usual(0.01, 100.0).edit("scatter of times, ms");
        DELAY_CV_PERCENT = key("delay_cv_percent", PERCENT, "2", "standard deviation over delay")
            .described("that of the detonator").usual(0.0, 10.0).edit("scatter of times, %");
        IN_HOLE_DELAY_MS = key("in_hole_delay_ms", TIME, "500",
            "of the detonator in every hole, which scatters too; 0 draws none there")
            .default(0.0).usual(10.0, 20000.0).edit("in-hole delay, ms").offered();
        LAUNCH_CV_PERCENT = key("launch_cv_percent", PERCENT, "5", "of launch velocities, hole by hole, lognormal")
            .default(1.0).usual(0.5, 30.0).edit("launch by hole, %").offered();
        LAUNCH_ROW_CV_PERCENT = key("launch_row_cv_percent", PERCENT, "3", "of launch velocities, row by row, lognormal")
            .default(1.0).usual(0.5, 30.0).edit("launch by row, %").offered();
        LAUNCH_COMMON_PERCENT = key("launch_common_percent", PERCENT, "10",
            "of all launch velocities at once, which are an estimate: what a fit learns; lognormal").default(1.0)
            .usual(0.5, 50.0).edit("launch in common, %").offered();
        LAUNCH_BETWEEN_SHOTS_PERCENT = key("launch_between_shots_percent", PERCENT, "5",
            "of all launch velocities at once, from shot to shot, lognormal; a fit takes 5 or more where it is left out")
            .default(1.0).usual(0.5, 30.0).edit("launch between shots, %").offered();
        LAUNCH_MASS_EXPONENT = key("launch_mass_exponent", Kind::Range(&number("", 0.0..=1.0)), "[0, 1]",
            "a tire of mass m' leaves with V0 (m/m')^n: n = 1 keeps the momentum, n = 0 the velocity")
            .described("0 to 1").edit("mass exponent between").offered();
        LAUNCH_TILT_DEG = key("launch_tilt_deg", number("°", 0.0..=45.0), "3",
            "of launch directions, hole by hole: standard deviation about each horizontal axis").default(1.0)
            .usual(0.1, 15.0).edit("launch direction, deg").offered();
        LAUNCH_TILT_COMMON_DEG = key("launch_tilt_common_deg", number("°", 0.0..=45.0), "1",
            "of the launch directions of the whole shot: standard deviation about each horizontal axis").default(0.5)
            .usual(0.05, 10.0).edit("direction in common, deg").offered();
        HOLE_POSITION_M = key("hole_position_m", number("m", 0.0..=1e2), "0.1",
            "how far a hole lies from its planned place under the tire: standard deviation along each axis; samples move the hole, no tire")
            .default(0.05).usual(0.005, 0.5).edit("hole position, m").offered();
        PATTERN_OFFSET_M = key("pattern_offset_m", number("m", 0.0..=1e2), "0.1",
            "of the shelter over the whole pattern of holes: standard deviation along each axis").default(0.05)
            .usual(0.005, 1.0).edit("pattern offset, m").offered();
        HOLE_FAILS_PERCENT = key("hole_fails_percent", number("%", 0.0..=100.0), "0.05",
            "how likely a hole does not fire, each by itself").default(0.01).usual(0.001, 5.0).edit("duds, %").offered();
        CABLE_LENGTH_M = key("cable_length_m", number("m", 0.0..=1e2), "0.02",
            "of the length of cables as tied, one by one: standard deviation; never shorter than what a cable spans")
            .default(0.01).usual(0.002, 0.2).edit("cable length, m").offered();
        FRICTION = key("friction", Kind::Range(&number("", FRICTION_RANGE)), "[0.4, 0.6]",
            "anything between, the same under the whole shot").described("1 % either side of that of [ground]")
            .usual(0.1, 1.0).edit("friction between").offered();
        SLACK_PERCENT = key("slack_percent", Kind::Range(&number("%", SLACK)), "[1, 4]",
            "anything between, the same in all cables")
            .described("0.1 either side of that of [cable], not below 0")
            .usual(0.0, 15.0).edit("slack between, %").offered();
        AXIAL_STIFFNESS_PERCENT = key("axial_stiffness_percent", Kind::Range(&number("%", -90.0..=1e3)), "[-10, 20]",
            "of the rope's own, the same in all cables").described("-1 to 1").usual(-50.0, 100.0).edit("stiffness between, %").offered();
        TIRE_MASS_CV_PERCENT = key("tire_mass_cv_percent", PERCENT, "10", "of masses, tire by tire").default(1.0)
            .usual(0.5, 30.0).edit("tire masses, %").offered();
        BREAKING_FORCE_CV_PERCENT = key("breaking_force_cv_percent", PERCENT, "3", "of breaking forces, cable by cable")
            .default(0.0).usual(0.5, 15.0).edit("breaking forces, %").offered();
        FITTED_FROM = key("fitted_from", Kind::List(&Kind::Text), "[\"…\"]",
            "checksums of the observations that `shelter fit --write` has used, and the charge and stemming that its launches belong to");
    }

    search "[search]" "what `shelter search` may choose from" {
        INTERVALS_MS = key("intervals_ms", Kind::ListOrSection(&TIME, &intervals::SECTION), "[17, 25, 42]",
            "between successive blast rows").described("those of the delay options").usual(1.0, 20000.0);
        EQUAL_INTERVALS = key("equal_intervals", Kind::Flag, "false",
            "whether all rows follow one another at one interval; false: every gap is chosen by itself").named("true");
        ORDERS = key("orders", Kind::Choice(SearchedOrders::NAMES), "\"adjacent\"", "in which rows may fire")
            .named(SearchedOrders::DEFAULT.name());
        HOLE_INTERVALS_MS = key("hole_intervals_ms", Kind::List(&TIME), "[0, 17, 25]",
            "between successive holes of a row; 0: rows fire at once").described("[0]").usual(1.0, 20000.0);
        HOLE_ORDERS = key("hole_orders", Kind::List(&Kind::Choice(HoleOrder::NAMES)), "[\"left\", \"centre\"]",
            "where the holes of each row begin").described("[\"left\"]");
        LONGEST_MS = key("longest_ms", TIME, "500", "from the first hole to the last").described("any duration");
        MOST_HOLES_IN_8_MS = key("most_holes_in_8_ms", Kind::Whole(1..=MOST_TIRES), "20", "holes that fire within any 8 ms")
            .described("holes_in_8_ms of [limits]");
    }

    intervals "[search.intervals_ms]" "evenly spaced intervals" {
        FROM = key("from", TIME, "8", "shortest").required();
        TO = key("to", TIME, "150", "longest").required();
        STEP = key("step", number("ms", 1e-3..=1e6), "1", "between neighbours").required();
    }

    size "[size]" "what `shelter size` may choose from" {
        ROPES = key("ropes", Kind::Catalogue(|| catalogue().families()), "\"GOST 2688-80\"", "a family of ropes")
            .described("that of the plan's rope, else the whole catalogue");
        TIRE_MASS_KG = key("tire_mass_kg", Kind::List(&MASS), "[200, 280, 350]", "masses of tires at hand")
            .described("that of [tire]");
        MOST_BORDER_ROWS = key("most_border_rows", Kind::Whole(0..=100), "2", "rows of ballast").default(0.0);
    }
}
