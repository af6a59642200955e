//! Designs of SHOTPlus: what is read of them, and what is said of those that do not load.

use std::io::{Cursor, Write};
use std::path::Path;

use shelter::Plan;
use shelter::plan::import::{Directions, Imported, plan_from_file};
use shelter::plan::{LaunchTargets, Time};
use zip::write::SimpleFileOptions;

use crate::support::{shelter, text};

/// One hole as SHOTPlus 6.25 writes it, cut to what is read: name, collar, firing time, detonators (deck, time) and weight.
fn hole(id: &str, [x, y]: [f64; 2], fire_ms: f64, detonators: &[(usize, f64)], weight: f64) -> String {
    let initiators: String = detonators
        .iter()
        .map(|(deck, time)| {
            format!(
                "<Initiators><ExDeckIndex>{deck}</ExDeckIndex><FiringTime>{time}</FiringTime></Initiators>"
            )
        })
        .collect();
    format!(
        r#"<Hole><Index>0</Index><HoleId>{id}</HoleId>
<DesignCoordinates><X xmlns="">{x}</X><Y xmlns="">{y}</Y><Z xmlns="">5390</Z></DesignCoordinates>
<ActualCoordinates><X xmlns="">{x}</X><Y xmlns="">{y}</Y><Z xmlns="">5390</Z></ActualCoordinates>
<DesignAngle>0</DesignAngle><FiringTime>{fire_ms}</FiringTime><Comment /><IsDummy>false</IsDummy>
<DesignLoading><Decks><Weight>{weight}</Weight><Type>Explosive</Type></Decks>
<Decks><Weight>0</Weight><Type>Stemming</Type></Decks></DesignLoading>
<InitSysLoading>{initiators}</InitSysLoading></Hole>
"#
    )
}

/// Three holes: 500 ms in every hole, ties of 17 and 25 ms.
fn three() -> [String; 3] {
    [
        hole("B1", [9544.0, 19286.0], 500.0, &[(0, 500.0)], 45.984),
        hole("A&amp;2", [9546.0, 19286.0], 517.0001, &[(0, 517.0)], 45.984),
        hole("7", [9544.0, 19288.5], 542.0002, &[(0, 542.0)], 47.0),
    ]
}

fn xml(holes: &[String]) -> String {
    format!(
        "\u{feff}<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<BlisBlastData xmlns=\"http://www.orica.com/namespaces/blis\">\n\
         <Holes>\n{}</Holes>\n<FiringTimes><FiringTime xmlns=\"\"><FiringTime>1</FiringTime></FiringTime></FiringTimes>\n\
         </BlisBlastData>\n",
        holes.concat()
    )
}

fn archive(files: &[(&str, &[u8])]) -> Vec<u8> {
    let mut archive = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in files {
        archive.start_file(*name, SimpleFileOptions::default()).expect("a file");
        archive.write_all(bytes).expect("written");
    }
    archive.finish().expect("an archive").into_inner()
}

fn design(holes: &[String]) -> Vec<u8> {
    archive(&[("Header.Xml", b"<FileHeader />"), ("BlisData.Xml", xml(holes).as_bytes())])
}

/// What becomes of a file: notes and plan, or every mistake.
fn outcome(bytes: &[u8], name: &str) -> Result<(Vec<String>, Plan, String), String> {
    outcome_with(bytes, name, Directions::Vertical)
}

fn outcome_with(
    bytes: &[u8],
    name: &str,
    directions: Directions,
) -> Result<(Vec<String>, Plan, String), String> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).expect("written");
    match plan_from_file(&path, directions) {
        Ok(Imported { text, notes }) => {
            let plan =
                Plan::parse("plan.toml", &text).unwrap_or_else(|mistakes| panic!("{mistakes}\n{text}"));
            Ok((notes, plan, text))
        }
        Err(mistakes) => {
            Err(mistakes.iter().map(|(_, _, message, remedy)| format!("{message}\n    {remedy}\n")).collect())
        }
    }
}

/// Where the first hole of each row lies [m].
fn places(plan: &Plan) -> Vec<(f64, f64)> {
    let first = |row: &shelter::plan::BlastRow| {
        let LaunchTargets::Holes(holes) = &row.targets else { panic!("holes") };
        (holes[0].x_m, holes[0].y_m)
    };
    plan.blast_rows.iter().map(first).collect()
}

#[test]
fn a_design_becomes_the_plan_it_says() {
    let (notes, plan, text) = outcome(&design(&three()), "blast.spf").expect("a plan");
    assert_eq!(
        notes,
        [
            "read 3 holes in 3 blast rows, which fire from 500 to 542 ms",
            "assumed, put in yours: launch velocities, tires, rope, slack, friction, limits, detonators and [uncertainty]",
            "neighbouring holes lie 2.00 m apart, x to the east and y to the north, by this list, under 5 x 4 tires: compare it with your pattern",
            "the holes hold 139.0 kg of explosive, written as charge_kg"
        ]
    );
    // What SHOTPlus adds for every tie is gone.
    assert_eq!(plan.delays[0].timing.fire_at(), [0.0, 17.0, 42.0].map(Time::from_ms));
    assert_eq!(places(&plan), [(2.0, 2.0), (4.0, 2.0), (2.0, 4.5)]);
    let charges: Vec<_> = plan.launches().map(|launch| launch.charge_kg).collect();
    assert_eq!(charges, [Some(45.984), Some(45.984), Some(47.0)]);
    assert!(text.contains("# A&2"), "{text}");
}

/// Dummy holes, inclined holes, holes drilled elsewhere, designs without detonators: each is said.
#[test]
fn what_a_plan_does_not_hold_is_said() {
    let [first, second, third] = three();
    let dummy = second.replace("<IsDummy>false", "<IsDummy>True");
    let inclined = third.replace("<DesignAngle>0", "<DesignAngle>12.5");
    let drilled =
        first.replace("<ActualCoordinates><X xmlns=\"\">9544", "<ActualCoordinates><X xmlns=\"\">9544.25");
    let (notes, plan, _) = outcome(&design(&[drilled, dummy, inclined]), "blast.spf").expect("a plan");
    assert_eq!(plan.blast_rows.len(), 2);
    let expected = [
        "read 2 holes in 2 blast rows, which fire from 500 to 542 ms; left out: the dummy holes A&2; the angles of the holes, up to 12.5 degrees from the vertical",
        "assumed, put in yours: launch velocities, tires, rope, slack, friction, limits, detonators and [uncertainty]",
        "neighbouring holes lie 2.51 m apart, x to the east and y to the north, by this list, under 4 x 4 tires: compare it with your pattern",
        "collars lie as drilled, up to 0.250 m from the design",
        "the holes hold 93.0 kg of explosive, written as charge_kg",
    ];
    assert_eq!(notes, expected);
    let untimed = [hole("1", [0.0, 0.0], 0.0, &[], 0.0), hole("2", [2.0, 0.0], 17.0001, &[], 0.0)];
    let (notes, plan, _) = outcome(&design(&untimed), "blast.spf").expect("a plan");
    assert_eq!(plan.delays[0].timing.fire_at(), [0.0, 17.0].map(Time::from_ms));
    let expected = [
        "read 2 holes in 2 blast rows, which fire from 0 to 17 ms",
        "assumed, put in yours: launch velocities, tires, rope, slack, friction, limits, detonators and [uncertainty]",
        "neighbouring holes lie 2.00 m apart, x to the east and y to the north, by this list, under 3 x 4 tires: compare it with your pattern",
        "no hole has a detonator: the firing times are those of the surface",
    ];
    assert_eq!(notes, expected);
}

/// What is fired was drilled: a hole that was not surveyed is where it was designed, and one drilled 4 m away is a slip.
#[test]
fn holes_lie_as_drilled() {
    let [first, second, third] = three();
    let moved = |hole: &str, x: &str| {
        let at = hole.find("<ActualCoordinates><X xmlns=\"\">").expect("a place")
            + "<ActualCoordinates><X xmlns=\"\">".len();
        let end = at + hole[at..].find('<').expect("an end");
        format!("{}{x}{}", &hole[..at], &hole[end..])
    };
    let unsurveyed = {
        let (from, to) = (second.find("<ActualCoordinates>"), second.find("</ActualCoordinates>"));
        let (from, to) = (from.expect("a place"), to.expect("an end") + "</ActualCoordinates>".len());
        format!("{}{}", &second[..from], &second[to..])
    };
    let (notes, plan, _) =
        outcome(&design(&[moved(&first, "9544.25"), unsurveyed, third.clone()]), "blast.spf")
            .expect("a plan");
    let told = "collars lie as drilled, up to 0.250 m from the design; 1 as designed, nobody surveyed them";
    assert!(notes.iter().any(|note| note == told), "{notes:?}");
    assert_eq!(places(&plan), [(2.0, 1.75), (3.75, 1.75), (1.75, 4.25)]);
    let refused =
        outcome(&design(&[moved(&first, "9548.5"), second, third]), "blast.spf").expect_err("a slip");
    assert!(refused.contains("was drilled 4.5 m from where it was designed"), "{refused}");
}

#[test]
fn a_design_that_does_not_say_it_all_is_refused_by_name() {
    let [first, second, third] = three();
    let at = [9550.0, 19286.0];
    let with = |hole: String| design(&[first.clone(), hole]);
    let whole = design(&three());
    let blis = xml(&three());
    let mut flipped = whole.clone();
    let middle = whole.len() / 2;
    flipped[middle] ^= 0x55;
    let only = |text: &str| archive(&[("BlisData.Xml", text.as_bytes())]);
    let files: Vec<(&str, Vec<u8>)> = vec![
        ("cut off", whole[..whole.len() - 40].to_vec()),
        ("a byte flipped", flipped),
        ("an empty archive", archive(&[])),
        ("no list of holes", archive(&[("Header.Xml", b"<FileHeader />")])),
        ("a workbook", archive(&[("xl/workbook.xml", b"<workbook />")])),
        ("64 MB of spaces", archive(&[("BlisData.Xml", &vec![b' '; (64 << 20) + 1])])),
        ("no XML", only("hole,x,y\n")),
        ("another XML", only("<Blast><Holes><Hole><HoleId>1</HoleId></Hole></Holes></Blast>")),
        ("XML cut off", only(&blis[..blis.len() / 2])),
        ("tags crossed", only(&blis.replacen("</HoleId>", "</Index>", 1))),
        ("an entity", only(&blis.replacen("&amp;", "&bomb;", 1))),
        ("Latin letters of one byte", archive(&[("BlisData.Xml", b"<BlisBlastData>\xe9</BlisBlastData>")])),
        ("no holes", design(&[])),
        ("no X", with(second.replace("9546", ""))),
        ("a decimal comma", with(second.replacen("9546", "9546,5", 1))),
        ("no firing time", with(second.replace("<FiringTime>517.0001</FiringTime>", ""))),
        ("not tied in", with(hole("4", at, 1e10, &[(0, 1e10)], 46.0))),
        ("not tied in, as others write it", with(hole("4", at, 1e7, &[(0, 1e7)], 46.0))),
        ("no explosive, unlike others", with(second.replace("<Type>Explosive</Type>", "<Type>Air</Type>"))),
        ("two firing times", with(second.replace("<Comment />", "<FiringTime>600</FiringTime>"))),
        ("two charges", with(hole("4", at, 500.0, &[(0, 500.0), (1, 525.0)], 46.0))),
        ("a detonator at another time", with(hole("4", at, 517.0, &[(0, 542.0)], 46.0))),
        ("no detonator, unlike others", with(hole("4", at, 17.0, &[], 0.0))),
        ("a detonator without a charge", with(second.replace("<ExDeckIndex>0</ExDeckIndex>", ""))),
        ("a weight that is no number", with(second.replacen("<Weight>", "<Weight>?", 1))),
        ("no weight", with(second.replacen("<Weight>45.984</Weight>", "", 1))),
        ("in one place", design(&[first.clone(), third.replace("19288.5", "19286")])),
        (
            "a name of control characters",
            with(second.replace("A&amp;2", "&#27;[31m").replace("9546", "east")),
        ),
    ];
    let mut told = String::new();
    for (what, bytes) in files {
        let refused = outcome(&bytes, "blast.spf").err().unwrap_or_else(|| panic!("{what} is read"));
        told += &format!("## {what}\n{refused}\n");
    }
    let no_archive = outcome(b"hole,x,y\n1,0,0\n", "blast.SPF").expect_err("no archive");
    insta::assert_snapshot!(format!("{told}## a table named .SPF\n{no_archive}"));
}

/// Angle and bearing of a design become the direction of the launch; a hole of which the design does not say them is named.
#[test]
fn launch_directions_come_from_the_design() {
    let [first, second, third] = three();
    let dips = |hole: &str, angle: f64, bearing: f64| {
        let said = format!("<DesignAngle>{angle}</DesignAngle><DesignBearing>{bearing}</DesignBearing>");
        hole.replace("<DesignAngle>0</DesignAngle>", &said)
    };
    let holes = [dips(&first, 0.0, 88.736), dips(&second, 10.0, 0.0), dips(&third, 12.5, 90.0)];
    let (notes, plan, text) =
        outcome_with(&design(&holes), "blast.spf", Directions::AgainstHoles).expect("a plan");
    let tilts: Vec<_> = plan.launches().map(|launch| (launch.tilt_deg, launch.tilt_toward_deg)).collect();
    assert_eq!(tilts, [(0.0, 0.0), (10.0, 270.0), (12.5, 180.0)]);
    assert_eq!(
        notes[..2],
        [
            "read 3 holes in 3 blast rows, which fire from 500 to 542 ms; launches point against the holes' way down, up to 12.5 degrees from the vertical",
            "assumed, put in yours: launch velocities, launch directions, tires, rope, slack, friction, limits, detonators and [uncertainty]",
        ]
    );
    assert!(text.contains("tilt_deg = 12.5, tilt_toward_deg = 180.0, charge_kg = 47.0 }, # 7"), "{text}");
    let unsaid = [
        first,
        second.replace("<DesignAngle>0", "<DesignAngle>10"),
        third.replace("<DesignAngle>0", "<DesignAngle>90"),
    ];
    let refused =
        outcome_with(&design(&unsaid), "blast.spf", Directions::AgainstHoles).expect_err("a mistake");
    assert!(refused.contains("hole A&2: DesignBearing is ``"), "{refused}");
    assert!(refused.contains("hole 7: DesignAngle is `90`"), "{refused}");
}

/// Memory stays small, however the XML is made: what is not read of a hole is not kept, and what no design has is refused.
#[test]
fn odd_designs_take_little_memory() {
    let with = |inside: &str| {
        let list = xml(&[hole("1", [0.0, 0.0], 0.0, &[], 0.0).replace("<Index>0</Index>", inside)]);
        archive(&[("BlisData.Xml", list.as_bytes())])
    };
    let nested = |depth: usize| "<a>".repeat(depth) + &"</a>".repeat(depth);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("blast.spf");
    let megabytes = |bytes: &[u8]| {
        std::fs::write(&path, bytes).expect("written");
        let mut read = Err(String::new());
        let used = allocation_counter::measure(|| {
            let found = plan_from_file(&path, Directions::Vertical);
            read = found.map(|_| ()).map_err(|mistakes| mistakes.render(false));
        });
        (used.bytes_max >> 20, read)
    };
    // A hole lies three deep.
    let (used, read) = megabytes(&with(&nested(17)));
    assert!(used < 2 && read.is_ok(), "{used} MB: {read:?}");
    for depth in [18, 20_000] {
        let (used, read) = megabytes(&with(&nested(depth)));
        let told = read.expect_err("it is too deep");
        assert!(used < 2 && told.contains("its elements lie more than 20 deep"), "{used} MB: {told}");
    }
    // Four megabytes of elements that nobody reads; the list itself, and its text, are four times as much.
    let (used, read) = megabytes(&with(&(0..250_000).map(|n| format!("<a{n:07}/>\n")).collect::<String>()));
    assert!(used < 20 && read.is_ok(), "{used} MB: {read:?}");
    let (used, read) =
        megabytes(&archive(&[("BlisData.Xml", xml(&vec!["<Hole/>".to_owned(); 60_000]).as_bytes())]));
    let told = read.expect_err("there are too many");
    assert!(used < 20 && told.contains("more than 50000 holes"), "{used} MB: {told}");
}

/// Two detonators in one charge are one shot: the first fires it.
#[test]
fn a_second_detonator_does_not_move_a_charge() {
    let second = hole("2", [9546.0, 19286.0], 517.0, &[(0, 542.0), (0, 517.0)], 46.0);
    let (_, plan, _) = outcome(&design(&[three()[0].clone(), second]), "blast.spf").expect("a plan");
    assert_eq!(plan.delays[0].timing.fire_at(), [0.0, 17.0].map(Time::from_ms));
}

/// What a file holds counts, not its name; a broken one ends with 2 and nothing is written.
#[test]
fn the_program_knows_designs_by_their_content() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).display().to_string();
    let whole = design(&three());
    std::fs::write(path("holes.csv"), &whole).expect("written");
    std::fs::write(path("broken.csv"), &whole[..whole.len() / 2]).expect("written");
    let read = shelter(&["init", &path("plan.toml"), "--from", &path("holes.csv")]);
    assert_eq!(read.status.code(), Some(0));
    assert!(
        text(&read.stderr).starts_with("note: read 3 holes in 3 blast rows, which fire from 500 to 542 ms\n")
    );
    assert!(Path::new(&path("plan.toml")).exists());
    let refused = shelter(&["init", &path("none.toml"), "--from", &path("broken.csv")]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(text(&refused.stderr).contains("the archive cannot be read"), "{}", text(&refused.stderr));
    assert!(!Path::new(&path("none.toml")).exists());
}

proptest::proptest! {
    /// No damage does harm: what is accepted is a plan, what is not is told.
    #[test]
    fn any_damage_is_a_plan_or_a_mistake(
        changes in proptest::collection::vec((0.0..1.0_f64, "(<Hole>|</Hole>|<X>|é|&|;|[0-9.<>/ a-z]){0,3}"), 0..4),
        cut in proptest::option::of(0.0..1.0_f64),
    ) {
        let mut list = xml(&three());
        for (at, text) in changes {
            let mut at = (at * list.len() as f64) as usize;
            while !list.is_char_boundary(at) {
                at -= 1;
            }
            list.insert_str(at, &text);
        }
        let mut bytes = archive(&[("BlisData.Xml", list.as_bytes())]);
        bytes.truncate((cut.unwrap_or(1.0) * bytes.len() as f64) as usize);
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("blast.spf");
        std::fs::write(&path, &bytes).expect("written");
        match plan_from_file(&path, Directions::AgainstHoles) {
            Ok(Imported { text, .. }) => proptest::prop_assert!(Plan::parse("plan.toml", &text).is_ok(), "{text}"),
            Err(mistakes) => proptest::prop_assert!(!mistakes.render(false).is_empty()),
        }
    }
}
