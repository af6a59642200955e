//! `shelter size`: the lightest shelter that holds.

use std::io;
use std::path::PathBuf;

use clap::Args;

use super::arguments::{LookArguments, StudyArguments, intervals};
use super::ask::{Ask, needs_file, write_plan};
use super::load_plans::choose_options;
use super::save::SaveArguments;
use super::status::{Status, was_interrupted};
use crate::plan::{Layout, Plan, SizeSpec};
use crate::report::check::NOTHING_VARIED;
use crate::report::words::plan_notes::launches_of_mass;
use crate::ropes::catalogue;
use crate::study::orders::{MOST_ROWS, tries_all};
use crate::study::question::{Found, Question};
use crate::study::size::{self, Combination, Demand};
use crate::study::{Case, Intervals, NoResult};

#[derive(Args)]
pub struct Arguments {
    /// Plan to size; its section [size] says what may be chosen
    plan: PathBuf,
    /// Every order of the rows must pass, not only the plan's options
    #[arg(long)]
    any_order: bool,
    /// With --any-order: intervals in ms; default: those of the delay options
    #[arg(long, value_name = "FROM..TO:STEP", value_parser = intervals, requires = "any_order", allow_hyphen_values = true)]
    interval: Option<Intervals>,
    /// Delay option that must pass, as often as wanted; default: all
    #[arg(long, value_name = "NAME", conflicts_with = "any_order")]
    option: Vec<String>,
    /// Family of ropes; default: that of [size], else that of the plan's rope, else the whole catalogue
    #[arg(long, value_name = "FAMILY")]
    ropes: Option<String>,
    /// Most rows of ballast on each side; default: that of [size], else none
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(0..=100))]
    border: Option<u16>,
    /// Write the choice into the plan
    #[arg(long)]
    write: bool,
    #[command(flatten)]
    saved: SaveArguments,
    #[command(flatten)]
    study: StudyArguments,
}

pub fn run(arguments: &Arguments, look: &LookArguments) -> io::Result<Status> {
    let ask = Ask::of_study(&arguments.plan, &arguments.study).saved(&arguments.saved);
    let question = |case: &Case| {
        if arguments.write {
            needs_file(&arguments.plan)?;
        }
        let choices = choose_sizes(arguments, &case.plan)?;
        Ok(Question::Size(size::Question { choices, demand: choose_demand(arguments, case)? }))
    };
    ask.run_then(look, question, |answered, status| {
        if let (Status::Pass, true, Found::Size(sizing)) =
            (status, arguments.write && !was_interrupted(), &answered.found)
            && let Some(found) = sizing.value.lightest_choice()
        {
            write(arguments, &answered.case, found, sizing.value.is_sampled())?;
        }
        Ok(status)
    })
}

/// The choices: the section `[size]` of the plan, with the choices of the command line in it.
fn choose_sizes(arguments: &Arguments, plan: &Plan) -> Result<SizeSpec, String> {
    let mut choices = plan.size.clone();
    if let Some(family) = &arguments.ropes {
        let families = catalogue().families();
        if !families.contains(&family.as_str()) {
            return Err(format!(
                "no family of ropes '{family}' in the catalogue, which has: {}",
                families.join(", ")
            ));
        }
        let termination = plan.cable.termination.as_deref();
        if let Some(termination) = termination.filter(|termination| !catalogue().fits(termination, family)) {
            return Err(format!(
                "{termination}, the termination of [cable], fits no rope of {family}: name another family, or give termination_percent in [cable]"
            ));
        }
        choices.family = Some(family.clone());
    }
    if let Some(border) = arguments.border {
        choices.most_border_rows = border.into();
    }
    if choices.most_border_rows > 0 && matches!(plan.layout, Layout::List { .. }) {
        return Err("a list layout has no border rows: leave them out".to_owned());
    }
    if let Some(why) = plan.layout.lacks_room(plan.tire.outer_diameter_m, choices.most_border_rows) {
        return Err(format!("{why}: leave out the border rows, or set another spacing"));
    }
    Ok(choices)
}

/// Demand on the shelter: the delay options that must pass, or all orders at some intervals.
fn choose_demand(arguments: &Arguments, case: &Case) -> Result<Demand, String> {
    if !arguments.any_order {
        return Ok(Demand::Options(choose_options(case, &arguments.option)?));
    }
    if !tries_all(case) {
        return Err(format!("--any-order tries all orders of at most {MOST_ROWS} blast rows"));
    }
    let holes = case.plan.shared_hole_timing();
    let holes = holes
        .ok_or_else(|| format!("{} --any-order takes plans whose options agree", NoResult::HolesDiffer))?;
    let of_plan = || case.plan.intervals(Some(holes));
    let intervals = arguments.interval.map_or_else(of_plan, |interval| interval.values());
    if intervals.is_empty() {
        return Err(format!("{}: give --interval FROM..TO:STEP", NoResult::NoInterval));
    }
    Ok(Demand::AnyOrder(intervals, holes))
}

fn write(arguments: &Arguments, case: &Case, found: &Combination, is_sampled: bool) -> io::Result<()> {
    write_plan(&arguments.plan, case, found.written(case))?;
    let launches = launches_of_mass(&case.plan, found.tire_mass).map(|told| format!("; {told}"));
    let caveat = if is_sampled { "" } else { NOTHING_VARIED };
    tell!("written: {}{caveat}{}", arguments.plan.display(), launches.unwrap_or_default());
    Ok(())
}
