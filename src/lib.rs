//! shelter
pub mod plan;
pub mod ropes;
