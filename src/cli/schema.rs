//! `shelter schema`: the keys of a plan as a JSON Schema.

use std::io;

use super::print::print_text;
use super::status::Status;
use crate::plan::schema::schema;
use crate::report::json;

pub fn run() -> io::Result<Status> {
    print_text(&json::text(&schema())?)?;
    Ok(Status::Pass)
}
