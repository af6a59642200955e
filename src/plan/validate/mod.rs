//! From TOML text to a valid [`Plan`]: one small function per section, every mistake noted with its remedy.

mod layout;
mod shot;
mod study;

use toml::de::DeTable;

use self::layout::{check_gaps, read_layout};
use self::shot::{read_blast_rows, read_delays};
use self::study::{read_scatter, read_size};
use super::diagnostic::Diagnostics;
use super::read::{At, Mistakes, Table};
use super::{CableSpec, Limits, Plan, SimulationSpec, TireSpec, range};
use crate::choice::{Accuracy, Method};
use crate::ropes;

/// Reads a plan from text; `path` names it in messages.
pub fn parse(path: &str, text: &str) -> Result<Plan, Diagnostics> {
    let source = text.strip_prefix('\u{feff}').unwrap_or(text);
    let (document, errors) = DeTable::parse_recoverable(source);
    let mistakes = Mistakes::default();
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
    let root = Table::new("the plan", 0..0, document.get_ref(), &mistakes);
    let plan = read_plan(&root, &mistakes);
    root.finish();
    if mistakes.count() > 0 {
        return Err(Diagnostics::new(path, source, mistakes.take()));
    }
    // Without a mistake every section was there.
    plan.ok_or_else(|| Diagnostics::unreadable(path, "the plan is incomplete".to_owned(), ""))
}

fn read_plan(root: &Table<'_>, mistakes: &Mistakes) -> Option<Plan> {
    let title = root.text_if("title", "\"…\"").map(|title| title.value.to_owned());
    let simulation = read_simulation(root.table_if("simulation"));
    let tire = root.table("tire", "mass_kg = 280").map(read_tire);
    let layout = root
        .table("shelter", "layout, rows, columns and spacing_m")
        .and_then(|table| read_layout(table, mistakes));
    let cable = root.table("cable", "rope = \"GOST 2688-80 6.2\"").map(|table| read_cable(table, mistakes));
    let friction = root.table("ground", "friction = 0.5").map(|table| {
        let friction = table.number("friction", None, range::FRICTION, "0.5");
        table.finish();
        friction
    });
    if let (Some(layout), Some(tire)) = (&layout, &tire) {
        check_gaps(layout, tire, root, mistakes);
    }
    let blast_rows = read_blast_rows(root, layout.as_ref(), simulation.gravity_m_s2, mistakes);
    let limits = root.table("limits", "flight_height_m and cable_safety_factor").map(read_limits);
    let delays = read_delays(root, &blast_rows, mistakes);
    let scatter = root.table_if("scatter").map(|table| read_scatter(table, mistakes));
    let size = root.table_if("size").map(|table| read_size(table, mistakes)).unwrap_or_default();
    Some(Plan {
        title,
        layout: layout?,
        tire: tire?,
        cable: cable?,
        friction: friction?,
        blast_rows,
        limits: limits?,
        delays,
        simulation,
        scatter,
        size,
    })
}

fn read_simulation(table: Option<Table<'_>>) -> SimulationSpec {
    let Some(table) = table else {
        return SimulationSpec {
            duration_s: None,
            accuracy: Accuracy::default(),
            method: Method::default(),
            gravity_m_s2: 9.81,
        };
    };
    let accuracies =
        [("field", Accuracy::Field), ("draft", Accuracy::Draft), ("reference", Accuracy::Reference)];
    let spec = SimulationSpec {
        duration_s: table.number_if("duration_s", range::DURATION_S, "1.5"),
        accuracy: table.word("accuracy", &accuracies),
        method: table.word("method", &[("verlet", Method::Verlet), ("newmark", Method::Newmark)]),
        gravity_m_s2: table.number("gravity_m_s2", Some(9.81), range::GRAVITY_M_S2, "9.81"),
    };
    table.finish();
    spec
}

fn read_tire(table: Table<'_>) -> TireSpec {
    let tire = TireSpec {
        mass_kg: table.number("mass_kg", None, range::MASS_KG, "280"),
        outer_diameter_m: table.number("outer_diameter_m", Some(0.0), range::DIAMETER_M, "1.6"),
    };
    table.finish();
    tire
}

fn read_limits(table: Table<'_>) -> Limits {
    let limits = Limits {
        flight_height_m: table.number("flight_height_m", None, range::LIMIT_M, "1.5"),
        cable_safety_factor: table.number("cable_safety_factor", None, range::SAFETY_FACTOR, "2.0"),
        drift_m: table.number_if("drift_m", range::LIMIT_M, "0.5"),
    };
    table.finish();
    limits
}

fn read_cable(table: Table<'_>, mistakes: &Mistakes) -> CableSpec {
    let rope = table.text_if("rope", "\"GOST 2688-80 6.2\"");
    let stiffness = table.number_if("axial_stiffness_kn", range::CABLE_KN, "1519");
    let breaking = table.number_if("breaking_force_kn", range::CABLE_KN, "20.9");
    let (axial_stiffness_kn, breaking_force_kn) = match (&rope, stiffness, breaking) {
        (None, Some(stiffness), Some(breaking)) => (stiffness, breaking),
        (Some(rope), None, None) => match ropes::catalogue().find(rope.value) {
            Some(found) => (found.axial_stiffness_kn, found.breaking_force_kn),
            None => {
                let near = ropes::catalogue().suggest(rope.value);
                let remedy = near.map_or_else(
                    || "`shelter ropes` lists the catalogue".to_owned(),
                    |near| format!("did you mean \"{near}\"? `shelter ropes` lists the catalogue"),
                );
                mistakes.add(
                    rope.span.clone(),
                    format!("no rope \"{}\" in the catalogue", rope.value),
                    remedy,
                );
                (1.0, 1.0)
            }
        },
        (Some(_), ..) => {
            let key = if stiffness.is_some() { "axial_stiffness_kn" } else { "breaking_force_kn" };
            table.wrong(key, format!("`{key}` stands beside `rope`, which gives it too"), "keep one of them");
            (1.0, 1.0)
        }
        (None, ..) => {
            let missing = match (stiffness, breaking) {
                (Some(_), _) => "`breaking_force_kn`",
                (_, Some(_)) => "`axial_stiffness_kn`",
                _ => "rope",
            };
            let remedy =
                "add `rope = \"GOST 2688-80 6.2\"`, or both axial_stiffness_kn and breaking_force_kn";
            mistakes.add(table.span.clone(), format!("[cable] has no {missing}"), remedy);
            (1.0, 1.0)
        }
    };
    let percent = table.number_if("termination_percent", range::TERMINATION_PERCENT, "80");
    let termination = table.text_if("termination", "\"clips\"");
    let termination_percent = match (termination, percent) {
        (Some(_), Some(_)) => {
            table.wrong(
                "termination_percent",
                "`termination_percent` stands beside `termination`",
                "keep one of them",
            );
            100.0
        }
        (Some(name), None) => find_termination(&name, mistakes),
        (None, percent) => percent.unwrap_or(100.0),
    };
    let spec = CableSpec {
        rope: rope.map(|rope| rope.value.to_owned()),
        axial_stiffness_kn,
        breaking_force_kn: breaking_force_kn * termination_percent * 1e-2,
        slack_percent: table.number("slack_percent", Some(0.0), range::SLACK_PERCENT, "2"),
        termination_percent,
        breaks: table.word("on_overload", &[("report", false), ("break", true)]),
    };
    table.finish();
    spec
}

fn find_termination(name: &At<&str>, mistakes: &Mistakes) -> f64 {
    let all = &ropes::catalogue().terminations;
    if let Some(found) = all.iter().find(|termination| termination.name == name.value) {
        return found.efficiency_percent;
    }
    let names: Vec<_> = all.iter().map(|termination| format!("\"{}\"", termination.name)).collect();
    let message = format!("no termination \"{}\"", name.value);
    mistakes.add(name.span.clone(), message, format!("write one of {}", names.join(", ")));
    100.0
}
