//! Plans from lists of holes: the formats that load, and what is said of those that do not.

use std::path::Path;

use shelter::plan::assumed::assumed_values;
use shelter::plan::import::{Directions, Imported, plan_from_file, plan_from_holes};
use shelter::plan::{Hole, LaunchTargets, Plan, Time, Timing};
use shelter::study::Case;

use crate::support::{shelter, text};

fn imported(list: &str) -> Plan {
    let read = plan_from_holes("holes.csv", list, Directions::Vertical);
    let text = read.unwrap_or_else(|mistakes| panic!("{mistakes}")).text;
    Plan::parse("plan.toml", &text).unwrap_or_else(|mistakes| panic!("{mistakes}\n{text}"))
}

fn holes_of(targets: &LaunchTargets) -> &[Hole] {
    if let LaunchTargets::Holes(holes) = targets { holes } else { &[] }
}

/// Names of the blast rows with their number of holes, and the firing times.
fn rows_and_times(plan: &Plan) -> (Vec<(&str, usize)>, Vec<f64>) {
    let rows = plan.blast_rows.iter().map(|row| (row.name.as_str(), holes_of(&row.targets).len())).collect();
    (rows, plan.delays[0].timing.fire_at().into_iter().map(Time::ms).collect())
}

/// A velocity in a list is no film: nobody said how well it is known.
#[test]
fn listed_launches_are_estimates() {
    let plan = imported("hole,x,y,row,launch_m_s\nA1,0,0,A,3\nA2,2,0,A,3\nB1,0,2,B,3\nB2,2,2,B,3\n");
    assert!(plan.launches().all(|launch| launch.speed_m_s == 3.0) && plan.uncertainty.launch_is_estimated());
}

/// Holes that begin a chain of their own beside another one are told: one that is not tied in fires at once.
/// A list says nothing of launches, ballast and links: whoever reads the plan sees that the program put them in. Charges it says.
#[test]
fn what_a_list_does_not_say_is_marked() {
    let written = |list: &str| {
        let read = plan_from_holes("holes.csv", list, Directions::Vertical);
        read.unwrap_or_else(|mistakes| panic!("{mistakes}")).text
    };
    let plan = written("hole,x,y,row,charge_kg\n1,0,0,1,12\n2,2.5,0,1,36\n3,0,2.5,2,12\n4,2.5,2.5,2,12\n");
    let assumed: Vec<&str> = assumed_values(&plan).map(|value| value.line).collect();
    for line in ["rows = 4", "columns = 4", "links = [\"row\", \"column\", \"diagonal\"]", "mass_kg = 280"] {
        assert!(assumed.contains(&line), "{line}: {assumed:?}");
    }
    assert_eq!(
        assumed.iter().filter(|line| line.starts_with("# launch_m_s of these holes is assumed")).count(),
        2
    );
    assert_eq!(plan.matches("charge_kg = 12.0").count(), 3, "{plan}");
    let launched = written("hole,x,y,row,launch_m_s\n1,0,0,1,5\n2,2.5,0,1,5\n");
    assert!(!launched.contains("launch_m_s of these holes"), "{launched}");
}

#[test]
fn holes_that_are_not_tied_in_are_told() {
    let list =
        |from: &str| format!("hole,x,y,delay_ms,from\n1,0,0,0,1\n2,2,0,25,1\n3,4,0,25,2\n4,6,0,25,{from}\n");
    let told = |from: &str| {
        let read = plan_from_holes("holes.csv", &list(from), Directions::Vertical);
        read.unwrap_or_else(|mistakes| panic!("{mistakes}"))
            .notes
            .join("\n")
            .contains("1, 4 follow no other hole")
    };
    assert_eq!([told("4"), told("3")], [true, false]);
}

#[test]
fn rows_without_times_get_options_to_choose_from() {
    let plan = imported("Hole,X (m),Y (m),Row\nA1,100,200,A\nA2,102,200,A\nB1,100,202,B\nB2,102,202,B\n");
    let (rows, _) = rows_and_times(&plan);
    assert_eq!(rows, [("A", 2), ("B", 2)]);
    assert_eq!(plan.delays.len(), 3);
    assert!(
        plan.uncertainty.launch_is_estimated(),
        "nobody gave a launch velocity: no option may pass on it"
    );
    assert!(matches!(plan.delays[0].timing, Timing::Interval { .. }));
    // Every hole launches a tire of its own, right above it.
    let case = Case::new(plan);
    let mut tires: Vec<usize> = case.shots[0].firings.iter().map(|firing| firing.tire).collect();
    tires.dedup();
    assert_eq!(tires.len(), 4);
    for firing in &case.shots[0].firings {
        let place = case.scene().position[firing.tire];
        assert!([2.0, 4.0].contains(&place.x) && [2.0, 4.0].contains(&place.y), "{place}");
    }
}

#[test]
fn firing_times_group_holes_whatever_separates_the_columns() {
    let expected = (vec![("0 ms", 2), ("25 ms", 1)], vec![0.0, 25.0]);
    for list in [
        "id,x,y,fire_ms\n1,0,0,100\n2,2,0,100\n3,0,2,125\n",
        "\u{feff}ID;Easting;Northing;Firing time (ms)\r\n1;0,0;0;100\r\n2;2,0;0;100\r\n3;0;2,0;125\r\n",
        "hole_id\tx_m\ty_m\tinitiation_time_ms\n1\t0\t0\t100\n\n2\t2\t0\t100\n3\t0\t2\t125",
    ] {
        let plan = imported(list);
        assert_eq!(rows_and_times(&plan), expected, "{list}");
    }
}

#[test]
fn delays_after_other_holes_add_up() {
    let plan = imported("id,x,y,delay_ms,from\nc,4,0,42,b\na,0,0,0,a\nb,2,0,17,a\n");
    assert_eq!(rows_and_times(&plan), (vec![("0 ms", 1), ("17 ms", 1), ("59 ms", 1)], vec![0.0, 17.0, 59.0]));
}

/// Kirra's layouts of 12 and 14 columns without a header and of 35 with one, as its documentation describes them.
#[test]
fn kirra_exports_load_as_they_are() {
    let twelve = "1,0,0,10,0,0,0,165,Production,B:::1,0,red\n2,4,0,10,4,0,0,165,Production,B:::1,17,red\n";
    assert_eq!(rows_and_times(&imported(twelve)).1, [0.0, 17.0]);
    let fourteen = "B,hole,1,0,0,10,0,0,0,165,Production,B:::1,0,red\nB,hole,2,4,0,10,4,0,0,165,Production,B:::1,17,red\n";
    assert_eq!(rows_and_times(&imported(fourteen)).1, [0.0, 17.0]);
    // Each of two patterns has a hole 1.
    let two = fourteen.to_owned()
        + "C,hole,1,0,4,10,0,4,0,165,Production,B:::2,25,red\nC,hole,2,4,4,10,4,4,0,165,Production,C:::1,9,red\n";
    assert_eq!(rows_and_times(&imported(&two)).1, [0.0, 17.0, 42.0, 51.0]);
    let header = "entityName,entityType,holeID,startXLocation,startYLocation,startZLocation,endXLocation,endYLocation,endZLocation,gradeXLocation, gradeYLocation, gradeZLocation, subdrillAmount, subdrillLength, benchHeight, holeDiameter,holeType,fromHoleID,timingDelayMilliseconds,colorHexDecimal,holeLengthCalculated,holeAngle,holeBearing,initiationTime,measuredLength,measuredLengthTimeStamp,measuredMass,measuredMassTimeStamp,measuredComment,measuredCommentTimeStamp, rowID, posID, burden, spacing, connectorCurve";
    let line = |id: usize, from: usize, delay: usize, time: usize, row: usize| {
        let x = 4.5 * id as f64;
        format!(
            "B,hole,{id},{x},7,5,{x},7,0,{x},7,1,1.5,0,11,165,contour,B:::{from},{delay},#888888,13,0,180,{time},12,9/05/2025 7:00,178,9/05/1975 0:00,None,9/05/1975 0:00,{row},1,0,0,0\n"
        )
    };
    let list = format!("{header}\n{}{}{}", line(1, 2, 42, 59, 2), line(2, 3, 17, 17, 1), line(3, 3, 0, 0, 1));
    let plan = imported(&list);
    assert_eq!(rows_and_times(&plan).1, [0.0, 17.0, 59.0]);
}

#[test]
fn every_bad_line_is_named_with_its_remedy() {
    let lists = [
        "",
        "\n\n",
        "id,x,y,row\n",
        "id,x,y,delay\n1,0,0,17\n2,2,0,34\n",
        "id,x,y,delay_ms\n1,0,0,17\n2,2,0,34\n",
        "id,easting\n1,0\n",
        "id,x,y,z,t,u\n1,2\n",
        "1,2,3,4,5\n2,3,4,5,6\n",
        "id,x,y\n1,zero,0\n2,0,\n3,NaN,inf\n4,0,0\n5,0,0\n",
        "id,x,y,fire_ms\n1,0,0,10\n2,2,0,\n3,4,0,-5\n4,6,0,1e999\n",
        "id,x,y,from,delay_ms\n1,0,0,2,5\n2,2,0,1,5\n3,4,0,9,5\n",
        "id,x,y,X\n1,0,0,0\n",
        "id,x,y\n1,0,0\n2,1000000,1000000\n",
        "id,x,y,launch_m_s\n1,0,0,-6\n",
        "id,x,y\n\"1,0,0\n",
        "id;x;y;delay_ms;from\n1;0;0;0666666666666666666666666,1\n23w;%;3;0;17;1\n",
        "id,x,y,from,delay_ms\n1,0,0,1,0\n2,2,0,1,900000000\n3,4,0,2,900000000\n",
        "id,x,y,launch_m_s\n1,0,0,20000\n",
    ];
    let told: Vec<String> = lists
        .iter()
        .map(|list| {
            let words = match plan_from_holes("holes.csv", list, Directions::Vertical) {
                Ok(_) => panic!("{list} is accepted"),
                Err(mistakes) => {
                    let line = |(line, column, message, remedy)| {
                        format!("{line}:{column} {message}\n    {remedy}\n")
                    };
                    mistakes.iter().map(line).collect::<String>()
                }
            };
            format!("## {}\n{words}", list.replace('\n', " / "))
        })
        .collect();
    insta::assert_snapshot!(told.join("\n"));
}

/// Each launch opposes the way down of its hole: of a hole that dips to the north it points to the south, and so on.
#[test]
fn launch_directions_come_from_angles_and_bearings() {
    let list = "hole,x,y,row,angle_from_vertical_deg,bearing_deg\n\
        vertical,0,0,1,0,45\nto the north,2,0,1,15,0\nto the east,4,0,1,20,90\nto the south west,6,0,1,5,225\n";
    let read = plan_from_holes("holes.csv", list, Directions::AgainstHoles);
    let Imported { text, notes } = read.unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let plan = Plan::parse("plan.toml", &text).unwrap_or_else(|mistakes| panic!("{mistakes}\n{text}"));
    let holes = holes_of(&plan.blast_rows[0].targets);
    let tilts: Vec<_> =
        holes.iter().map(|hole| (hole.launch.tilt_deg, hole.launch.tilt_toward_deg)).collect();
    assert_eq!(tilts, [(0.0, 0.0), (15.0, 270.0), (20.0, 180.0), (5.0, 45.0)]);
    assert!(text.contains("# Launch directions are assumed"), "{text}");
    assert!(
        notes[0]
            .ends_with("; launches point against the holes' way down, up to 20 degrees from the vertical")
    );
    assert!(notes[1].contains("launch directions"), "{notes:?}");
    // x points to the east, y to the north.
    let launch: Vec<_> = Case::new(plan).shots[0].firings.iter().map(|firing| firing.launch).collect();
    assert!(launch[0].x == 0.0 && launch[0].y == 0.0 && launch[0].z > 0.0);
    assert!(launch[1].x.abs() < 1e-12 && launch[1].y < 0.0 && launch[1].z > 0.0);
    assert!(launch[2].x < 0.0 && launch[2].y.abs() < 1e-12 && launch[2].z > 0.0);
    // Without the request nothing of it is read.
    let upright = imported(list);
    assert!(holes_of(&upright.blast_rows[0].targets).iter().all(|hole| hole.launch.tilt_deg == 0.0));
}

#[test]
fn the_program_tells_what_it_does_with_directions() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).display().to_string();
    std::fs::write(path("with.csv"), "id,x,y,angle_from_vertical_deg,bearing\n1,0,0,10,0\n")
        .expect("written");
    std::fs::write(path("without.csv"), "id,x,y\n1,0,0\n").expect("written");
    let read = shelter(&["init", &path("plan.toml"), "--from", &path("with.csv"), "--directions"]);
    assert_eq!(read.status.code(), Some(0));
    let first = text(&read.stderr).lines().next().unwrap_or_default().to_owned();
    assert!(
        first.starts_with("note: read 1 hole") && first.contains("way down, up to 10 degrees"),
        "{first}"
    );
    let plan = std::fs::read_to_string(path("plan.toml")).expect("a plan");
    assert!(plan.contains("tilt_deg = 10.0, tilt_toward_deg = 270.0 }, # 1"), "{plan}");
    let refused = shelter(&["init", &path("none.toml"), "--from", &path("without.csv"), "--directions"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(text(&refused.stderr).contains("no column is the bearing"), "{}", text(&refused.stderr));
    assert!(!Path::new(&path("none.toml")).exists());
}

/// Every list is read rightly, or refused with its line and a remedy: no value, time or row is guessed or dropped unsaid. Those
/// named `directions-` are read with their directions.
#[test]
fn lists_are_read_or_refused_and_never_guessed() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/lists");
    let entries = std::fs::read_dir(folder).expect("the lists are there");
    let mut files: Vec<_> = entries.map(|entry| entry.expect("an entry").path()).collect();
    files.sort();
    assert!(files.len() >= 40);
    let mut outcomes = String::new();
    for file in files {
        let name = file.file_name().and_then(|name| name.to_str()).expect("UTF-8").to_owned();
        let directions =
            if name.starts_with("directions-") { Directions::AgainstHoles } else { Directions::Vertical };
        let read = plan_from_file(&file, directions);
        outcomes += &format!("## {name}\n");
        match read {
            Ok(Imported { text, notes }) => {
                let plan =
                    Plan::parse("plan.toml", &text).unwrap_or_else(|mistakes| panic!("{name}: {mistakes}"));
                notes.iter().for_each(|note| outcomes += &format!("{note}\n"));
                for row in &plan.blast_rows {
                    let at = holes_of(&row.targets).iter().map(|hole| {
                        let tilt = match hole.launch.tilt_deg {
                            0.0 => String::new(),
                            tilt => format!(" tilted {tilt} toward {}", hole.launch.tilt_toward_deg),
                        };
                        format!("({}, {}){tilt}", hole.x_m, hole.y_m)
                    });
                    let at: Vec<_> = at.collect();
                    outcomes += &format!("    row {:?}: {}\n", row.name, at.join(" "));
                }
                outcomes += &format!("    {:?}\n", plan.delays[0].timing);
            }
            Err(mistakes) => {
                for (line, column, message, remedy) in mistakes.iter() {
                    outcomes += &format!("refused: {line}:{column} {message}\n    {remedy}\n");
                }
            }
        }
        outcomes.push('\n');
    }
    insta::assert_snapshot!(outcomes);
}

proptest::proptest! {
    /// Nothing that is not a list of holes does harm, and whatever is accepted is a plan.
    #[test]
    fn any_text_is_a_plan_or_a_mistake(list in "(id|x|y|row|fire_ms|delay_ms|from|bearing|angle_from_vertical_deg|[-0-9.,;e \t]{0,12}|\n){0,40}") {
        for directions in [Directions::Vertical, Directions::AgainstHoles] {
            if let Ok(Imported { text, .. }) = plan_from_holes("holes.csv", &list, directions) {
                proptest::prop_assert!(Plan::parse("plan.toml", &text).is_ok(), "{text}");
            }
        }
    }
}
