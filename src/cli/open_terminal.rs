//! `shelter PLAN` and `shelter` alone: opens the terminal.

use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::arguments::{ComputeArguments, FormatArg, LookArguments};
use super::judge_plans::{judge_plans, print_judged_plans};
use super::status::{Status, failed};
use super::tell;
use super::{load_plans, print_help};
use crate::jobs::Jobs;
use crate::kept;
use crate::plan::{PlanSource, starter};
use crate::study::Case;
use crate::study::check;
use crate::study::samples::sample_count::Sampling;
use crate::tui::config::{self, Config};
use crate::tui::start::{Opened, Start};
use crate::tui::{self, app::App};

/// Opens a plan in the terminal, or two plans side by side. If the output is no terminal, or the user wants only words, prints what `check`
/// prints.
pub fn plans(plans: &[PathBuf], compute: &ComputeArguments, look: &LookArguments) -> io::Result<Status> {
    let Some(cases) = load_plans::open_all(plans, look) else { return Ok(Status::Wrong) };
    if look.plain || !io::stdout().is_terminal() {
        return match judge_plans(cases, Some(Sampling::OF_VERDICT), compute, &check::Question::OF_VERDICT) {
            Ok(judged) => print_judged_plans(&judged, FormatArg::Text, look),
            Err(reason) => failed(&reason),
        };
    }
    needs_keyboard(compute)?;
    // The program reads standard input and pipes once. It can watch and write only a file.
    let files: Vec<Option<&Path>> =
        plans.iter().map(|plan| plan.is_file().then_some(plan.as_path())).collect();
    files.iter().flatten().for_each(|file| config::remember(file));
    let (config, mistake) = Config::load_or_default();
    let mut apps = cases.into_iter().map(|case| {
        let settings = compute.settings(&case.plan);
        App::new(Arc::new(case), settings, &config)
    });
    let Some(mut app) = apps.next() else { return Ok(Status::Wrong) };
    app.notice = mistake;
    if let Some(second) = apps.next() {
        app.put_beside(second);
    }
    show(app, &files, &config, compute, look)
}

/// Without a plan: offers plans to open. If the output is no terminal, prints the help.
pub fn start(compute: &ComputeArguments, look: &LookArguments) -> io::Result<Status> {
    if !io::stdout().is_terminal() {
        print_help()?;
        return Ok(Status::Wrong);
    }
    needs_keyboard(compute)?;
    let (config, mistake) = Config::load_or_default();
    let start = Start::new(Path::new("."), config::recent(), kept::find(None));
    let (name, text, kept) = match tui::choose(start, &config, screen(&config, look))? {
        Err(exit) => return Ok(status(&exit)),
        Ok(Opened::File(path)) => return self::plans(&[path], compute, look),
        Ok(Opened::Example(name, text)) => (name, text.to_owned(), true),
        Ok(Opened::New(text)) => (tui::NEW_PLAN, text, false),
    };
    match Case::parse(PlanSource { path: name.into(), text }) {
        Ok(case) => {
            let settings = compute.settings(&case.plan);
            let mut app = App::new(Arc::new(case), settings, &config);
            app.notice = mistake;
            if !kept {
                app.editor.set_saved("");
                app.notice = Some(starter::ASSUMED.to_owned());
            }
            show(app, &[None], &config, compute, look)
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
    files: &[Option<&Path>],
    config: &Config,
    compute: &ComputeArguments,
    look: &LookArguments,
) -> io::Result<Status> {
    let threads = compute.threads.unwrap_or(0).into();
    let plans: Vec<_> = files.iter().map(|&file| (Jobs::new(threads), file)).collect();
    for app in
        [Some(&mut app.threads), app.beside.as_mut().map(|second| &mut second.threads)].into_iter().flatten()
    {
        *app = plans[0].0.threads();
    }
    tui::run(app, plans, screen(config, look)).map(|exit| status(&exit))
}

fn status(exit: &tui::Exit) -> Status {
    match exit {
        tui::Exit::Quit => Status::Pass,
        tui::Exit::Signal => Status::Interrupted,
    }
}
