//! shelter
pub mod outcome;
pub mod plan;
pub mod ropes;
pub mod scene;
pub mod simulation;
pub mod study;
pub mod verdict;
