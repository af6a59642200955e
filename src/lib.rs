//! shelter
pub mod cli;
pub mod outcome;
pub mod plan;
pub mod report;
pub mod ropes;
pub mod scene;
pub mod simulation;
pub mod study;
pub mod tui;
pub mod units;
pub mod verdict;
pub mod worker;
