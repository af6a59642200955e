//! `shelter PLAN` and `shelter` alone: the terminal.

use std::io::{self, IsTerminal};
use std::path::Path;
use std::sync::Arc;

use super::arguments::{ComputeArguments, FormatArg, LookArguments};
use super::judge_plans::{judge_plans, print_judged_plans};
use super::status::{Status, failed};
use super::tell;
use super::{load_plans, print_help};
use crate::jobs::Jobs;
use crate::plan::{PlanSource, starter};
use crate::study::Case;
use crate::study::check;
use crate::study::samples::sample_count::Sampling;
use crate::tui::config::{self, Config};
use crate::tui::start::{Opened, Start};
use crate::tui::{self, app::App, recovery};

/// Opens a plan in the terminal; where output is no terminal or only words are wanted, says the same as `check`.
pub fn plan(plan: &Path, compute: &ComputeArguments, look: &LookArguments) -> io::Result<Status> {
    let Some(case) = load_plans::open(plan, look) else { return Ok(Status::Wrong) };
    if look.plain || !io::stdout().is_terminal() {
        let cases = [case];
        return match judge_plans(&cases, Some(Sampling::OF_VERDICT), compute, &check::Question::OF_VERDICT) {
            Ok(checked) => print_judged_plans(&cases, &checked, &[], FormatArg::Text, look),
            Err(reason) => failed(&reason),
        };
    }
    needs_keyboard(compute)?;
    // Standard input and pipes are read once; only a file can be watched and written.
    let file = plan.is_file().then_some(plan);
    if let Some(file) = file {
        config::remember(file);
    }
    let settings = compute.settings(&case.plan);
    let (config, mistake) = Config::load_or_default();
    let mut app = App::new(Arc::new(case), settings, &config);
    app.notice = mistake;
    show(app, file, &config, compute, look)
}

/// Without a plan: offers what there is; where output is no terminal, the help.
pub fn start(compute: &ComputeArguments, look: &LookArguments) -> io::Result<Status> {
    if !io::stdout().is_terminal() {
        print_help()?;
        return Ok(Status::Wrong);
    }
    needs_keyboard(compute)?;
    let (config, mistake) = Config::load_or_default();
    let start = Start::new(Path::new("."), config::recent(), recovery::find(None));
    let (name, text, kept) = match tui::choose(start, &config, screen(&config, look))? {
        Err(exit) => return Ok(status(&exit)),
        Ok(Opened::File(path)) => return self::plan(&path, compute, look),
        Ok(Opened::Example(name, text)) => (name, text.to_owned(), true),
        Ok(Opened::New(text)) => (tui::NEW_PLAN, text, false),
    };
    match Case::parse(PlanSource { path: name.to_owned(), text }) {
        Ok(case) => {
            let settings = compute.settings(&case.plan);
            let mut app = App::new(Arc::new(case), settings, &config);
            app.notice = mistake;
            if !kept {
                app.editor.set_saved("");
                app.notice = Some(starter::ASSUMED.to_owned());
            }
            show(app, None, &config, compute, look)
        }
        Err(mistakes) => {
            tell::mistakes(&mistakes, look.colored(io::stderr().is_terminal()));
            Ok(Status::Wrong)
        }
    }
}

fn needs_keyboard(compute: &ComputeArguments) -> io::Result<()> {
    let wrong = if !io::stdin().is_terminal() {
        "the terminal UI needs a keyboard on standard input; scripts use `shelter check`"
    } else if compute.timeout.is_some() {
        "--timeout ends commands such as `shelter check`; in the terminal UI a key ends what computes"
    } else {
        return Ok(());
    };
    Err(io::Error::other(wrong))
}

fn screen(config: &Config, look: &LookArguments) -> tui::ScreenStyle {
    tui::ScreenStyle {
        ascii: config.ascii || look.style(true).ascii,
        color: look.colored(true),
        mouse: config.mouse,
    }
}

fn show(
    mut app: App,
    file: Option<&Path>,
    config: &Config,
    compute: &ComputeArguments,
    look: &LookArguments,
) -> io::Result<Status> {
    let threads = compute.threads.unwrap_or(0).into();
    let jobs = Jobs::new(threads);
    app.threads = jobs.threads();
    tui::run(app, jobs, screen(config, look), file).map(|exit| status(&exit))
}

fn status(exit: &tui::Exit) -> Status {
    match exit {
        tui::Exit::Quit => Status::Pass,
        tui::Exit::Signal => Status::Interrupted,
    }
}
