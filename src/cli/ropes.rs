//! `shelter ropes`: the catalogue.

use std::io;

use clap::Args;

use super::Status;

#[derive(Args)]
pub struct Arguments {
    /// Terminations and what they leave of a rope's strength
    #[arg(long)]
    terminations: bool,
}

pub fn run(_arguments: &Arguments) -> io::Result<Status> {
    Ok(Status::Pass)
}
