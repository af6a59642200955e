//! `shelter init`: a commented starter plan.

use std::fs::OpenOptions;
use std::io::{self, Write};
use std::path::PathBuf;

use clap::Args;

use super::Status;

/// The starter plan.
pub const STARTER: &str = include_str!("../../plans/amur-three-rows.toml");

#[derive(Args)]
pub struct Arguments {
    /// File to write, never overwritten; default: standard output
    file: Option<PathBuf>,
}

pub fn run(arguments: &Arguments) -> io::Result<Status> {
    let Some(path) = &arguments.file else {
        io::stdout().write_all(STARTER.as_bytes())?;
        return Ok(Status::Pass);
    };
    let written = OpenOptions::new()
        .write(true)
        .create_new(true)
        .open(path)
        .and_then(|mut file| file.write_all(STARTER.as_bytes()));
    match written {
        Ok(()) => {
            eprintln!("wrote {0}; open it with: shelter {0}", path.display());
            Ok(Status::Pass)
        }
        Err(error) => Err(io::Error::new(error.kind(), format!("{}: {error}", path.display()))),
    }
}
