//! `shelter man`: the manual page.

use std::io;

use clap::CommandFactory;

use super::Cli;
use super::print::print_text;
use super::status::Status;

pub fn run() -> io::Result<Status> {
    let mut text = Vec::new();
    clap_mangen::Man::new(Cli::command()).render(&mut text)?;
    print_text(&String::from_utf8_lossy(&text))?;
    Ok(Status::Pass)
}
