//! `shelter config`: the default configuration of the terminal.

use std::io;

use super::print::print_text;
use super::status::Status;
use crate::tui::config::default_text;

pub fn run() -> io::Result<Status> {
    print_text(&default_text())?;
    Ok(Status::Pass)
}
