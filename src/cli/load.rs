//! Plans from the command line: loading with diagnostics on stderr, and opening one in the terminal.

use std::io::{self, IsTerminal};
use std::path::Path;
use std::sync::Arc;

use super::{Compute, Look, Status};
use crate::plan::PlanSource;
use crate::study::Case;
use crate::tui::config::{self, Config};
use crate::tui::start::{Opened, Start};
use crate::tui::{self, app::App};
use crate::worker::{Errands, Worker};

/// Loads plans; prints every mistake of every plan and returns `None` when there is one.
pub fn cases<'a>(paths: impl IntoIterator<Item = &'a std::path::PathBuf>, look: &Look) -> Option<Vec<Case>> {
    let mut cases = Some(Vec::new());
    for path in paths {
        match Case::load(path) {
            Ok(case) => {
                if let Some(cases) = &mut cases {
                    cases.push(case);
                }
            }
            Err(diagnostics) => {
                eprint!("{}", diagnostics.render(look.colored(io::stderr().is_terminal())));
                cases = None;
            }
        }
    }
    cases
}

/// Opens a plan in the terminal; where output is no terminal, says the same as `check`.
pub fn open(plan: &Path, compute: &Compute, look: &Look) -> io::Result<Status> {
    let Some(case) = cases(&[plan.to_path_buf()], look).and_then(|mut cases| cases.pop()) else {
        return Ok(Status::Wrong);
    };
    if !io::stdout().is_terminal() {
        return super::check::print(vec![case], compute, look, &super::check::Output::default());
    }
    needs_keyboard(compute)?;
    // Standard input and pipes are read once; only a file can be watched and written.
    let file = plan.is_file().then_some(plan);
    if let Some(file) = file {
        config::remember(file);
    }
    let settings = compute.settings(&case.plan);
    let config = config()?;
    let app = App::new(Arc::new(case), settings, &config);
    show(app, file, &config, compute, look)
}

/// Without a plan: offers what there is; where output is no terminal, the help.
pub fn start(compute: &Compute, look: &Look) -> io::Result<Status> {
    if !io::stdout().is_terminal() {
        super::print_help()?;
        return Ok(Status::Wrong);
    }
    needs_keyboard(compute)?;
    let config = config()?;
    let start = Start::new(Path::new("."), config::recent());
    let (name, text, kept) = match tui::choose(start, config.theme, screen(&config, look))? {
        Err(exit) => return Ok(status(&exit)),
        Ok(Opened::File(path)) => return open(&path, compute, look),
        Ok(Opened::Example(name, text)) => (name, text.to_owned(), true),
        Ok(Opened::New(text)) => ("new plan", text, false),
    };
    match Case::parse(PlanSource { path: name.to_owned(), text }) {
        Ok(case) => {
            let settings = compute.settings(&case.plan);
            let mut app = App::new(Arc::new(case), settings, &config);
            if !kept {
                app.editor.saved.clear();
            }
            show(app, None, &config, compute, look)
        }
        Err(mistakes) => wrong(&mistakes.to_string()),
    }
}

fn config() -> io::Result<Config> {
    Config::load().map_err(io::Error::other)
}

fn needs_keyboard(compute: &Compute) -> io::Result<()> {
    let wrong = if !io::stdin().is_terminal() {
        "the terminal UI needs a keyboard on standard input; scripts use `shelter check`"
    } else if compute.timeout.is_some() {
        "--timeout ends commands such as `shelter check`; in the terminal UI a key ends what computes"
    } else {
        return Ok(());
    };
    Err(io::Error::other(wrong))
}

fn screen(config: &Config, look: &Look) -> tui::Look {
    tui::Look { ascii: config.ascii || look.style(true).ascii, color: look.colored(true) }
}

fn show(
    app: App,
    file: Option<&Path>,
    config: &Config,
    compute: &Compute,
    look: &Look,
) -> io::Result<Status> {
    let threads = compute.threads.unwrap_or(0).into();
    let (worker, errands) = (Worker::new(threads), Errands::new(threads));
    tui::run(app, worker, errands, screen(config, look), file).map(|exit| status(&exit))
}

fn status(exit: &tui::Exit) -> Status {
    match exit {
        tui::Exit::Quit => Status::Pass,
        tui::Exit::Signal => Status::Interrupted,
    }
}

/// A plan and one of its delay options; prints what is wrong and returns `None` when there is none such.
pub fn case_and_option(plan: &Path, option: Option<&str>, look: &Look) -> Option<(Case, usize)> {
    let case = cases(&[plan.to_path_buf()], look)?.pop()?;
    match find_option(&case, option) {
        Ok(option) => Some((case, option)),
        Err(message) => {
            eprintln!("error: {message}");
            None
        }
    }
}

/// The delay option of this name; the first without one.
fn find_option(case: &Case, name: Option<&str>) -> Result<usize, String> {
    let names: Vec<&str> = case.plan.delays.iter().map(|delay| delay.name.as_str()).collect();
    let Some(name) = name else { return Ok(0) };
    names.iter().position(|&known| known == name).ok_or_else(|| {
        format!("no delay option '{name}' in {}; it has: {}", case.source.path, names.join("; "))
    })
}

/// Reports a mistake in the arguments.
pub fn wrong(message: &str) -> io::Result<Status> {
    eprintln!("error: {message}");
    Ok(Status::Wrong)
}
