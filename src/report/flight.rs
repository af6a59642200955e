//! The motion of one option as a report: height and force over time, as numbers and as pictures.

use super::charts::{self, Course, DrawnShot};
use super::parts::{Block, Report};
use super::trace::history;
use crate::study::flight::Flight;
use crate::study::{Case, Computed};

/// The report of a recorded motion.
pub fn report(case: &Case, Computed { value: flight, .. }: &Computed<Flight>) -> Report {
    let courses = &flight.outcome.history;
    let drawn = if flight.sample.is_some() { DrawnShot::DecidingByAny } else { DrawnShot::Planned };
    let mut report = history(courses);
    let course = Course { history: courses, shot: &flight.shot, drawn };
    report.blocks.extend(charts::history(case, [course; 2], None).map(Block::Picture));
    report
}
