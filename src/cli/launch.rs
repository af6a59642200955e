//! `shelter launch`: the launch velocity of the cover, by every estimate that a blast plan allows.

use std::io;
use std::path::PathBuf;

use clap::Args;
use clap::builder::PossibleValuesParser;

use super::arguments::{LookArguments, StudyArguments, positive};
use super::ask::{needs_file, write_plan};
use super::fit::{next_shot, read_observations};
use super::load_plans::open;
use super::print::print;
use super::run_study::run_study;
use super::status::{Status, failed, was_interrupted, wrong};
use crate::plan::PlanSource;
use crate::plan::observations::{Observations, not_to_be_fitted};
use crate::plan::write_launch::{self, LaunchToWrite};
use crate::report::answer::why_held;
use crate::report::launch::{FoundLaunch, KINDS_TO_USE, not_written, report, words_for_plan};
use crate::report::words::objections::of_other_shot;
use crate::study::launch::{
    Blast, EarlierShots, FittedShots, LaunchEstimate, LaunchEstimates, Seen, TestTire, fit_by_charge,
};
use crate::study::observed::other_shot::{OtherShot, other_shots};
use crate::study::{Case, Computed, Context, NoResult};
use crate::units;

#[derive(Args)]
pub struct Arguments {
    /// Plan of the shot; without one only the options below count
    plan: Option<PathBuf>,
    /// How high a loose test tire rose, in m
    #[arg(long, value_name = "M", value_parser = positive, conflicts_with = "flight_time", help_heading = "Test tire")]
    test_height: Option<f64>,
    /// How exactly its height was read: standard deviation in m [default: a tenth of the height]
    #[arg(long, value_name = "M", value_parser = positive, requires = "test_height", help_heading = "Test tire")]
    test_height_sd: Option<f64>,
    /// How long a loose test tire was in the air, in s
    #[arg(long, value_name = "SECONDS", value_parser = positive, help_heading = "Test tire")]
    flight_time: Option<f64>,
    /// Frames a second of the film: a flight time is read to one frame
    #[arg(long, value_name = "N", value_parser = positive, default_value = "30", help_heading = "Test tire")]
    frames: f64,
    /// Observations of earlier shots at this site as CSV, as of `fit`: files, or a folder
    #[arg(long, value_name = "FILE.csv", num_args = 1.., requires = "plan")]
    observed: Vec<PathBuf>,
    /// The estimate to take; default: the surest observation, else the fastest bound
    #[arg(long = "use", value_name = "ESTIMATE", value_parser = PossibleValuesParser::new(KINDS_TO_USE.map(|(name, _)| name)))]
    chosen: Option<String>,
    /// Write the estimate into the plan, and into its [uncertainty] how well it is known
    #[arg(long, requires = "plan")]
    write: bool,
    #[command(flatten)]
    study: StudyArguments,
    // Last, because its heading in the help also applies to every argument after it.
    #[command(flatten)]
    blast: BlastArguments,
}

/// What a blast plan says; of a plan given, these options replace its keys.
#[derive(Args)]
#[command(next_help_heading = "Blast plan")]
struct BlastArguments {
    /// Diameter of the holes, in mm
    #[arg(long, value_name = "MM", value_parser = positive)]
    hole_diameter: Option<f64>,
    /// Stemming above the charge, in m
    #[arg(long, value_name = "M", value_parser = positive)]
    stemming: Option<f64>,
    /// Length of the charge, in m
    #[arg(long, value_name = "M", value_parser = positive)]
    charge_length: Option<f64>,
    /// Charge of each hole, in kg
    #[arg(long, value_name = "KG", value_parser = positive)]
    charge: Option<f64>,
    /// Density of the explosive in the hole, in g/cm³
    #[arg(long, value_name = "G/CM3", value_parser = positive)]
    density: Option<f64>,
    /// Specific charge, in kg/m³; or charge, burden, spacing and bench
    #[arg(long, value_name = "KG/M3", value_parser = positive)]
    specific_charge: Option<f64>,
    /// Burden, in m
    #[arg(long, value_name = "M", value_parser = positive)]
    burden: Option<f64>,
    /// Spacing of the holes in a row, in m
    #[arg(long, value_name = "M", value_parser = positive)]
    spacing: Option<f64>,
    /// Height of the bench, or depth of the rock that is broken, in m
    #[arg(long, value_name = "M", value_parser = positive)]
    bench: Option<f64>,
    /// The rock has no free face: a trench, a sinking cut
    #[arg(long)]
    confined: bool,
    /// Mass of the cover on each square metre, in kg
    #[arg(long, value_name = "KG/M2", value_parser = positive)]
    cover: Option<f64>,
}

impl BlastArguments {
    fn blast(&self) -> Blast {
        Blast {
            hole_diameter_mm: self.hole_diameter,
            stemming_m: self.stemming,
            charge_length_m: self.charge_length,
            charge_kg: self.charge,
            explosive_density: self.density,
            specific_charge_kg_m3: self.specific_charge,
            burden_m: self.burden,
            spacing_m: self.spacing,
            bench_m: self.bench,
            is_confined: self.confined,
            cover_kg_m2: self.cover,
        }
    }
}

impl Arguments {
    fn test_tire(&self, gravity: f64) -> Option<TestTire> {
        let of_height = self.test_height.map(|height| {
            let sd = self.test_height_sd.unwrap_or(0.1 * height);
            Seen::Height { height, sd }
        });
        let of_time = self.flight_time.map(|time| Seen::FlightTime { time, sd: 1.0 / self.frames });
        // Without gravity, a height gives no velocity.
        of_height.or(of_time).filter(|_| gravity > 0.0).map(|seen| TestTire { seen, gravity })
    }

    /// The estimate to take: the one that `--use` names, or the default. `None` if there is none.
    fn choose<'e>(&self, estimates: &'e LaunchEstimates) -> Option<&'e LaunchEstimate> {
        let Some(name) = &self.chosen else { return estimates.chosen() };
        let (_, kind) = KINDS_TO_USE.into_iter().find(|(known, _)| known == name)?;
        estimates.all.iter().find(|estimate| estimate.kind == kind)
    }
}

/// Gravity if no plan states another value [m/s²].
const GRAVITY: f64 = 9.81;

pub fn run(arguments: &Arguments, look: &LookArguments) -> io::Result<Status> {
    let case = match &arguments.plan {
        None => None,
        Some(plan) => match open(plan, look) {
            None => return Ok(Status::Wrong),
            Some(case) => Some(case),
        },
    };
    if let (true, Some(plan)) = (arguments.write, &arguments.plan)
        && let Err(message) = needs_file(plan)
    {
        return wrong(&message);
    }
    let sampling = arguments.study.verdict.sampling();
    if sampling.is_none() && !arguments.observed.is_empty() {
        return wrong("--nominal takes all that scatters for exact, which no fit does here: leave it out");
    }
    let gravity = case.as_ref().map_or(GRAVITY, |case| case.plan.simulation.gravity_m_s2);
    let stated = arguments.blast.blast();
    let blast = match &case {
        Some(case) => Blast::of_plan(&case.plan).replaced_by(stated),
        None => stated,
    };
    // A launch that is written must be for the plan's own blast, to the digit: nobody finds a difference later.
    if let (true, Some(case)) = (arguments.write, &case) {
        let (stated, own) = (arguments.blast.blast(), Blast::of_plan(&case.plan));
        let both = [
            ("--charge", "charge_kg", stated.charge_kg, own.charge_kg),
            ("--stemming", "stemming_m", stated.stemming_m, own.stemming_m),
        ];
        for (option, key, stated, own) in both {
            let Some(stated) = stated else { continue };
            match own {
                Some(own) if own == stated => {}
                Some(own) => {
                    return wrong(&format!(
                        "{option} {stated} is another blast than the plan's `{key} = {own}`, whose holes would get its launch: change the plan, or leave out --write"
                    ));
                }
                // A fit is for the blast that its files state.
                None if arguments.observed.is_empty() => {}
                None => {
                    return wrong(&format!(
                        "{option} {stated} is in no hole of the plan, which would get its launch: write {key} into the plan, or leave out --write"
                    ));
                }
            }
        }
    }
    let fits = match &case {
        Some(case) => match fits(arguments, case, look)? {
            Ok(fits) => fits,
            Err(status) => return Ok(status),
        },
        None => Vec::new(),
    };
    let mut earlier: Vec<EarlierShots> =
        case.iter().flat_map(|case| fits.iter().filter_map(|shots| shots.earlier_shots(case))).collect();
    earlier.extend(case.as_ref().and_then(|case| EarlierShots::of_plan(&case.plan)));
    let estimates = LaunchEstimates::new(&blast, arguments.test_tire(gravity).as_ref(), &earlier);
    let chosen = arguments.choose(&estimates);
    if arguments.chosen.is_some() && chosen.is_none() {
        return wrong("there is no such estimate: `shelter launch` says what each of them needs");
    }
    let to_write = case.as_ref().zip(chosen).map(|(case, chosen)| {
        chosen.to_write(case, &fits, words_for_plan(chosen), arguments.chosen.is_some())
    });
    let with_chosen = case.as_ref().zip(to_write.as_ref()).and_then(|(case, launch)| {
        let text = written(case, launch.as_ref().ok()?).ok()?;
        Case::parse(PlanSource { path: case.source.path.clone(), text }).ok()
    });
    let next = match with_chosen.as_ref().or(case.as_ref()).zip(sampling) {
        None => None,
        Some((case, sampling)) => {
            let compute = arguments.study.compute.settings(&case.plan);
            let find = |control: &_| {
                next_shot(&Context::new(case, compute, control), &sampling).map(Computed::complete)
            };
            match run_study(&arguments.study.compute, find) {
                // The estimates stand without a proposed shot.
                Err(NoResult::OutOfTime) => None,
                Err(reason) => return failed(&reason),
                Ok(Computed { value: Err(hold), .. }) => {
                    tell!("warning: HOLD, no shot is proposed: {}", why_held(hold));
                    None
                }
                Ok(Computed { value: Ok(value), .. }) => Some(value),
            }
        }
    };
    if was_interrupted() {
        return failed(&NoResult::Stopped);
    }
    let found = FoundLaunch {
        case: case.as_ref(),
        written: with_chosen.as_ref().filter(|_| arguments.write),
        estimates: &estimates,
        chosen,
        fits: &fits,
        next: next.as_ref(),
    };
    let status = print(&[report(&found)], arguments.study.format, look)?;
    let files: Vec<Observations> = fits.iter().flat_map(|shots| shots.files.iter().cloned()).collect();
    let others: Vec<OtherShot> = case.iter().flat_map(|case| other_shots(case, &files)).collect();
    // A launch is scaled to another charge or stemming, if both values are known. It is never scaled to other tires.
    let others: Vec<OtherShot> =
        others.into_iter().filter(|other| !(other.differs() && other.cause.is_scaled())).collect();
    others.iter().for_each(|other| tell!("warning: {}", of_other_shot(other)));
    if let (true, Some(plan), Some(case)) = (arguments.write, &arguments.plan, &case) {
        let why_not = match to_write {
            None => "no estimate tells the launch of the cover".to_owned(),
            Some(_) if others.iter().any(OtherShot::differs) => "film a shot with these tires".to_owned(),
            Some(Err(why)) => not_written(why).to_owned(),
            Some(Ok(launch)) => {
                write_plan(plan, case, written(case, &launch))?;
                tell!(
                    "written: {}; launch_common_percent is {} now, from {}",
                    plan.display(),
                    units::rounded(launch.known.common_percent, 1),
                    launch.source
                );
                return Ok(status);
            }
        };
        tell!("nothing was written: {why_not}");
        return Ok(if status == Status::Pass { Status::Fail } else { status });
    }
    Ok(status)
}

/// The fits of the named observations; the exit status if the observations are wrong.
fn fits(
    arguments: &Arguments,
    case: &Case,
    look: &LookArguments,
) -> io::Result<Result<Vec<FittedShots>, Status>> {
    let Some(files) = read_observations(case, &arguments.observed, look) else {
        return Ok(Err(Status::Wrong));
    };
    if let Some(message) = not_to_be_fitted(&files, &case.plan.fitted_from, &case.source.name()) {
        return wrong(&message).map(Err);
    }
    let Some(sampling) = arguments.study.verdict.sampling().filter(|_| !files.is_empty()) else {
        return Ok(Ok(Vec::new()));
    };
    let compute = arguments.study.compute.settings(&case.plan);
    let fit = |control: &_| {
        let context = Context::new(case, compute, control).with_sampling(sampling);
        fit_by_charge(&context, &files).map(Computed::complete)
    };
    match run_study(&arguments.study.compute, fit) {
        Err(reason) => failed(&reason).map(Err),
        Ok(Computed { value, .. }) => Ok(Ok(value)),
    }
}

/// The text of the plan with a launch velocity.
fn written(case: &Case, launch: &LaunchToWrite) -> Result<String, String> {
    write_launch::write(&case.source.text, &case.plan, launch)
}
