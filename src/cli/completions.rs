//! `shelter completions`: completions for a shell.

use std::io;

use clap::{Args, CommandFactory};
use clap_complete::Shell;

use super::Cli;
use super::print::print_text;
use super::status::Status;

#[derive(Args)]
pub struct Arguments {
    /// Which shell
    shell: Shell,
}

pub fn run(arguments: &Arguments) -> io::Result<Status> {
    let mut text = Vec::new();
    clap_complete::generate(arguments.shell, &mut Cli::command(), "shelter", &mut text);
    print_text(&String::from_utf8_lossy(&text))?;
    Ok(Status::Pass)
}
