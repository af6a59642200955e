//! `shelter init`: a commented starter plan.

use std::io::{self, IsTerminal};
use std::path::PathBuf;

use clap::Args;

use super::arguments::LookArguments;
use super::print::print_text;
use super::status::Status;
use super::tell;
use crate::file;
use crate::plan::import::{Directions, plan_from_file};

/// The starter plan.
pub const STARTER: &str = include_str!("../../plans/amur-three-rows.toml");

#[derive(Args)]
pub struct Arguments {
    /// File to write, never overwritten; default: standard output
    file: Option<PathBuf>,
    /// Build the plan from a list of holes, as Kirra and others export it, or from a design of SHOTPlus (.spf)
    #[arg(long, value_name = "HOLES")]
    from: Option<PathBuf>,
    /// Let each launch point against the way down of its hole, from the angles and bearings of the list; default: straight up
    #[arg(long, requires = "from")]
    directions: bool,
}

pub fn run(arguments: &Arguments, look: &LookArguments) -> io::Result<Status> {
    let directions = if arguments.directions { Directions::AgainstHoles } else { Directions::Vertical };
    let text = match &arguments.from {
        None => STARTER.to_owned(),
        Some(list) => match plan_from_file(list, directions) {
            Ok(imported) => {
                imported.notes.iter().for_each(|note| tell!("note: {note}"));
                imported.text
            }
            Err(mistakes) => {
                tell::mistakes(&mistakes, look.colored(io::stderr().is_terminal()));
                return Ok(Status::Wrong);
            }
        },
    };
    let Some(path) = arguments.file.as_ref().filter(|path| path.as_os_str() != "-") else {
        print_text(&text)?;
        return Ok(Status::Pass);
    };
    file::create(path, &text)?;
    tell!("wrote {0}; open it with: shelter {0}", path.display());
    Ok(Status::Pass)
}
