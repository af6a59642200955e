//! Turns TOML text into a valid [`Plan`]: one function reads each section and notes every mistake with its remedy.

mod layout;
mod shot;
mod study;

use toml::de::DeTable;

use self::layout::{check_gaps, read_layout};
use self::shot::{check_charges, read_blast_rows, read_delays};
pub(super) use self::study::OF_INPUTS;
use self::study::{left_out, read_search, read_size, read_uncertainty};
use super::diagnostic::Diagnostics;
use super::fitted_blast;
use super::keys;
use super::keys::{cable, ground, limits, simulation, tire, uncertainty};
use super::reader::{At, Mistakes, SectionReader};
use super::{CableSpec, GroundSpec, Layout, LimitsSpec, Plan, SimulationSpec, TireSpec};
use crate::choice::{Accuracy, Method, OnOverload};
use crate::ropes::{Rope, Termination, catalogue};

/// Largest number of sections and of tables in braces in a plan: each takes a kilobyte of memory. A shelter of 60,000 tires listed one by
/// one has that many, with its cables.
const MOST_TABLES: usize = 300_000;

/// Number of sections and of tables in braces.
fn tables(source: &str) -> usize {
    let sections = source.lines().filter(|line| line.trim_start().starts_with('[')).count();
    sections + source.bytes().filter(|&byte| byte == b'{').count()
}

/// The plan of a text, or all mistakes; messages name the file `path`.
pub fn parse(path: &str, text: &str) -> Result<Plan, Diagnostics> {
    let source = text.strip_prefix('\u{feff}').unwrap_or(text);
    let tables = tables(source);
    if tables > MOST_TABLES {
        let message = format!("the file has {tables} sections; a plan has at most {MOST_TABLES}");
        return Err(Diagnostics::unreadable(path, message, "a plan is a short text: check the path"));
    }
    let (document, errors) = DeTable::parse_recoverable(source);
    let mistakes = Mistakes::of(source);
    for error in errors {
        let span = error.span().unwrap_or(0..0);
        mistakes.add(
            span,
            error.message().to_owned(),
            "a plan is TOML: `key = value` lines in [sections], decimals with a point",
        );
    }
    if mistakes.count() > 0 {
        return Err(Diagnostics::new(path, source, mistakes.take()));
    }
    let root = SectionReader::new(&keys::plan::SECTION, 0..0, document.get_ref(), &mistakes);
    let plan = read_plan(&root, &mistakes);
    root.finish();
    if mistakes.count() > 0 {
        return Err(Diagnostics::new(path, source, mistakes.take()));
    }
    // A plan without a mistake has every section.
    plan.ok_or_else(|| Diagnostics::unreadable(path, "the plan is incomplete".to_owned(), ""))
}

fn read_plan(root: &SectionReader<'_>, mistakes: &Mistakes) -> Option<Plan> {
    use keys::plan::{CABLE, GROUND, LIMITS, SEARCH, SHELTER, SIMULATION, SIZE, TIRE, TITLE, UNCERTAINTY};
    let title = root.text_if(&TITLE).map(|title| title.value.to_owned());
    let simulation = read_simulation(root.section_or_empty(&SIMULATION));
    let tire = root.section(&TIRE).map(|section| read_tire(section, simulation.method));
    let layout = root.section(&SHELTER).and_then(|section| read_layout(section, mistakes));
    let cable = root.section(&CABLE).map(|section| read_cable(section, simulation.method, mistakes));
    let ground = root.section(&GROUND).map(read_ground);
    let blast_rows = read_blast_rows(root, layout.as_ref(), &simulation, mistakes);
    let limits = root.section(&LIMITS).map(read_limits);
    let delays = read_delays(root, &blast_rows, mistakes);
    let unknown = root.section_or_empty(&UNCERTAINTY);
    let left_out = if root.has(&UNCERTAINTY) { left_out(&unknown) } else { Vec::new() };
    let (uncertainty, fitted_from) = read_uncertainty(
        unknown,
        !root.has(&UNCERTAINTY),
        ground.map_or(0.0, |ground| ground.friction),
        cable.as_ref().map_or(0.0, |cable| cable.slack_percent),
    );
    let termination = cable.as_ref().and_then(|cable| cable.termination.as_deref());
    let own_masses = layout.as_ref().is_some_and(Layout::has_own_masses);
    let size = read_size(root.section_or_empty(&SIZE), termination, own_masses);
    if let (Some(layout), Some(tire)) = (&layout, &tire) {
        check_gaps(layout, tire, size.most_border_rows, root, mistakes);
    }
    let search = read_search(root.section_or_empty(&SEARCH));
    let plan = Plan {
        title,
        layout: layout?,
        tire: tire?,
        cable: cable?,
        ground: ground?,
        blast_rows,
        limits: limits?,
        delays,
        simulation,
        uncertainty,
        fitted_from,
        left_out,
        size,
        search,
    };
    check_slope(&plan, root, mistakes);
    check_charges(&plan, root);
    check_fitted(&plan, root);
    Some(plan)
}

fn read_simulation(section: SectionReader<'_>) -> SimulationSpec {
    let spec = SimulationSpec {
        duration_s: section.number_if(&simulation::DURATION_S),
        accuracy: section.choice(&simulation::ACCURACY, Accuracy::DEFAULT),
        method: section.choice(&simulation::METHOD, Method::DEFAULT),
        gravity_m_s2: section.number(&simulation::GRAVITY_M_S2),
    };
    section.finish();
    spec
}

fn read_tire(section: SectionReader<'_>, method: Method) -> TireSpec {
    let spec = TireSpec {
        mass_kg: section.number(&tire::MASS_KG),
        outer_diameter_m: section.number(&tire::OUTER_DIAMETER_M),
        turns: false,
        restitution: section.number(&tire::RESTITUTION),
    };
    if spec.restitution > 0.0 && method == Method::Newmark {
        let message = "newmark has no restitution";
        section.wrong(&tire::RESTITUTION, message, "leave it out, or choose method \"verlet\"");
    }
    section.finish();
    spec
}

fn read_ground(section: SectionReader<'_>) -> GroundSpec {
    let spec = GroundSpec {
        friction: section.number(&ground::FRICTION),
        slope_percent: section.number(&ground::SLOPE_PERCENT),
        slope_toward_deg: section.number(&ground::SLOPE_TOWARD_DEG),
    };
    section.finish();
    spec
}

/// Notes a mistake if the launches were fitted to shots of another charge, stemming, hole diameter or tire mass.
fn check_fitted(plan: &Plan, root: &SectionReader<'_>) {
    if let (Some(message), Some(section)) =
        (fitted_blast::differs(plan), root.section_if(&keys::plan::UNCERTAINTY))
    {
        let remedy = "their launch is another: estimate it (`shelter launch`) or film a shot, and take `fitted_from` out";
        section.wrong(&uncertainty::FITTED_FROM, message, remedy);
    }
}

/// Notes a mistake if the least friction does not hold a tire on the slope, and nothing ends the run.
fn check_slope(plan: &Plan, root: &SectionReader<'_>, mistakes: &Mistakes) {
    let GroundSpec { friction, slope_percent, .. } = plan.ground;
    let least = friction.min(plan.uncertainty.friction[0]);
    if slope_percent * 1e-2 > least && plan.simulation.duration_s.is_none() {
        let message = format!("on a slope of {slope_percent} % friction of {} holds no tire", least);
        let remedy = "the shelter never comes to rest: give [simulation] a duration_s";
        let section = root.section_if(&keys::plan::GROUND);
        let span = section.map_or(0..0, |section| section.span_of(&ground::SLOPE_PERCENT));
        mistakes.add(span, message, remedy);
    }
}

fn read_limits(section: SectionReader<'_>) -> LimitsSpec {
    let spec = LimitsSpec {
        flight_height_m: section.number(&limits::FLIGHT_HEIGHT_M),
        cable_safety_factor: section.number(&limits::CABLE_SAFETY_FACTOR),
        drift_m: section.number_if(&limits::DRIFT_M),
        holes_in_8_ms: section.has(&limits::HOLES_IN_8_MS).then(|| section.whole(&limits::HOLES_IN_8_MS)),
        charge_in_8_ms_kg: section.number_if(&limits::CHARGE_IN_8_MS_KG),
        accepted_risk_percent: section.number(&limits::ACCEPTED_RISK_PERCENT),
        withstands_one_dud: section.flag(&limits::WITHSTANDS_ONE_DUD),
        dud_risk_percent: section.number(&limits::DUD_RISK_PERCENT),
    };
    section.finish();
    spec
}

fn read_cable(section: SectionReader<'_>, method: Method, mistakes: &Mistakes) -> CableSpec {
    let rope = section.text_if(&cable::ROPE);
    let (axial_stiffness_kn, breaking_force_kn) = read_rope(&section, rope.as_ref(), mistakes);
    let termination = read_termination(&section, rope.as_ref(), mistakes);
    let percent = section.number(&cable::TERMINATION_PERCENT);
    let termination_percent = termination.map_or(percent, |known| known.efficiency_percent);
    let spec = CableSpec {
        rope: rope.map(|rope| rope.value.to_owned()),
        axial_stiffness_kn,
        breaking_force_kn: breaking_force_kn * termination_percent * 1e-2,
        slack_percent: section.number(&cable::SLACK_PERCENT),
        end_stiffness_kn_m: section.number_if(&cable::END_STIFFNESS_KN_M),
        damping_percent: section.number(&cable::DAMPING_PERCENT),
        termination: termination.map(|known| known.name.clone()),
        termination_percent,
        on_overload: section.choice(&cable::ON_OVERLOAD, OnOverload::DEFAULT),
    };
    if spec.damping_percent > 0.0 && method == Method::Newmark {
        let message = "newmark has no damping";
        section.wrong(&cable::DAMPING_PERCENT, message, "leave it out, or choose method \"verlet\"");
    }
    section.finish();
    spec
}

/// Axial stiffness and breaking force of the rope [kN], from the catalogue or from the plan.
fn read_rope(section: &SectionReader<'_>, rope: Option<&At<&str>>, mistakes: &Mistakes) -> (f64, f64) {
    let stiffness = section.number_if(&cable::AXIAL_STIFFNESS_KN);
    let breaking = section.number_if(&cable::BREAKING_FORCE_KN);
    match (rope, stiffness, breaking) {
        (None, Some(stiffness), Some(breaking)) => return (stiffness, breaking),
        (Some(rope), None, None) => match catalogue().find(rope.value) {
            Some(found) => return (found.axial_stiffness_kn, found.breaking_force_kn),
            None => {
                let remedy = catalogue().suggest(rope.value).map_or_else(
                    || "`shelter ropes` lists the catalogue".to_owned(),
                    |near| format!("did you mean \"{near}\"? `shelter ropes` lists the catalogue"),
                );
                let message = format!("no rope \"{}\" in the catalogue", rope.value);
                mistakes.add(rope.span.clone(), message, remedy);
            }
        },
        (Some(_), ..) => {
            let both =
                if stiffness.is_some() { &cable::AXIAL_STIFFNESS_KN } else { &cable::BREAKING_FORCE_KN };
            let message = format!("`{}` stands beside `rope`, which gives it too", both.name);
            section.wrong(both, message, "keep one of them");
        }
        (None, ..) => {
            let missing = match (stiffness, breaking) {
                (Some(_), _) => "`breaking_force_kn`",
                (_, Some(_)) => "`axial_stiffness_kn`",
                _ => "rope",
            };
            let remedy =
                "add `rope = \"GOST 2688-80 6.2\"`, or both axial_stiffness_kn and breaking_force_kn";
            mistakes.add(section.span.clone(), format!("[cable] has no {missing}"), remedy);
        }
    }
    (1.0, 1.0)
}

/// The termination that the plan names. It must fit the rope.
fn read_termination(
    section: &SectionReader<'_>,
    rope: Option<&At<&str>>,
    mistakes: &Mistakes,
) -> Option<&'static Termination> {
    let name = section.name_if(&cable::TERMINATION)?;
    if section.has(&cable::TERMINATION_PERCENT) {
        let message = "`termination_percent` stands beside `termination`";
        section.wrong(&cable::TERMINATION_PERCENT, message, "keep one of them");
    }
    let termination = catalogue().termination(name.value)?;
    if let Some(rope) = rope.and_then(|rope| catalogue().find(rope.value))
        && !termination.fits.contains(&rope.kind)
    {
        let message = format!("{} does not fit {}, a {}", name.value, rope.name, rope.kind.label());
        mistakes.add(name.span, message, other_termination(rope));
    }
    Some(termination)
}

/// Remedy for a termination that does not fit `rope`.
fn other_termination(rope: &Rope) -> String {
    let stated = "`termination_percent` with the figure of the maker";
    let fitting = catalogue().terminations.iter().filter(|known| known.fits.contains(&rope.kind));
    let names: Vec<String> = fitting.map(|known| format!("\"{}\"", known.name)).collect();
    if names.is_empty() {
        format!("give {stated}")
    } else {
        format!("choose {}; or give {stated}", names.join(", "))
    }
}
