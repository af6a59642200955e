//! `shelter completions`, `shelter man`, `shelter schema` and `shelter config`: texts about the program itself.

use std::io::{self, Write};

use clap::{Args, CommandFactory};
use clap_complete::Shell;

use super::Cli;
use super::status::Status;

#[derive(Args)]
pub struct Completions {
    /// Which shell
    shell: Shell,
}

pub fn completions(arguments: &Completions) -> io::Result<Status> {
    let mut text = Vec::new();
    clap_complete::generate(arguments.shell, &mut Cli::command(), "shelter", &mut text);
    io::stdout().write_all(&text)?;
    Ok(Status::Pass)
}

pub fn man() -> io::Result<Status> {
    let mut text = Vec::new();
    clap_mangen::Man::new(Cli::command()).render(&mut text)?;
    io::stdout().write_all(&text)?;
    Ok(Status::Pass)
}

pub fn config() -> io::Result<Status> {
    io::stdout().write_all(crate::tui::config::default_text().as_bytes())?;
    Ok(Status::Pass)
}

pub fn schema() -> io::Result<Status> {
    io::stdout().write_all(crate::report::json::text(&crate::plan::schema::schema()).as_bytes())?;
    Ok(Status::Pass)
}
