//! A validated blast plan, in the units of its keys.
//!
//! | what | where |
//! |---|---|
//! | the values | [`Plan`] and its parts, `values`, `layout`, `delays`, `uncertainty`; times as whole nanoseconds, [`Time`] |
//! | properties of a key: name, unit, range, default, description | [`keys`], one table |
//! | from TOML to values, or to mistakes | `reader` (key by key), `sections` (what a section means), `diagnostic` |
//! | valid, but unusual values | [`usual`] |
//! | values that the comments of a plan call assumed | [`assumed`] |
//! | speed of a tire of another mass | [`mass_law`] |
//! | changes to the text of a plan | [`edit`] |
//! | plans that come with the program | [`examples`] |
//! | new plans: from a few answers, from a list of holes | [`starter`], [`import`] |
//! | observations of earlier shots; writing a fit of them into a plan | [`observations`], [`write_fit`] |
//! | names as people see them; text and path of a plan; the tire nearest to a place on the ground | [`names`], `source`, `nearest_point` |
//! | the keys for editors | [`schema`] |
//!
//! [`Plan::load`] reads TOML and reports every mistake at once, each with file, line, column and remedy ([`Diagnostics`]). A [`Plan`] that
//! exists is valid: later stages never check it again. [`keys`] holds the table of all keys. This module does not know how a shelter moves,
//! and it knows no units except those of the keys. Two keys may state one value in two ways; the reader turns both into that value.
//! Example: the free flight height h of a test tire becomes its launch velocity √(2 g h).

pub mod assumed;
mod delays;
mod diagnostic;
pub mod edit;
pub mod examples;
pub mod fitted_blast;
pub mod import;
pub mod keys;
mod layout;
pub mod mass_law;
pub mod names;
mod nearest_point;
pub mod observations;
mod reader;
pub mod schema;
mod sections;
mod source;
pub mod starter;
mod time;
mod uncertainty;
pub mod usual;
mod values;
mod visible;
pub mod write_fit;
pub mod write_launch;

pub use delays::{COMMON_DELAYS_MS, DelayOption, HoleTiming, Timing, fire_in_turn};
pub use diagnostic::Diagnostics;
pub use layout::{Layout, ListedTire, Mesh};
pub use nearest_point::NearestPoint;
pub use reader::nearest;
pub use source::PlanSource;
pub use time::Time;
pub use uncertainty::{DelayScatter, Uncertainty};
pub use values::{
    BlastRow, CableSpec, GroundSpec, Hole, Launch, LaunchTargets, LimitsSpec, Plan, SearchSpec,
    SimulationSpec, SizeSpec, TireSpec,
};
pub use visible::visible;
