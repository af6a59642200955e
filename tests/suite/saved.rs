//! `--save`: studies that are stopped and go on, and the files they go on from.

use std::collections::HashSet;
use std::fs;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use super::support::{self, Edited, PATIENCE, PROGRAM, shelter};

/// A small plan in a folder, and the path of a file of results there.
fn plan_and_file(folder: &Path) -> [String; 2] {
    let path = |name: &str| folder.join(name).to_str().expect("UTF-8").to_owned();
    let [plan, file] = ["plan.toml", "saved.jsonl"].map(path);
    fs::write(&plan, support::small_plan()).expect("written");
    [plan, file]
}

/// What the build script computes.
#[allow(dead_code)]
#[path = "../../build.rs"]
mod build;

fn start(arguments: &[&str]) -> Child {
    let mut command = Command::new(PROGRAM);
    command.args(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("it starts")
}

/// Keys of the results in a file, and whether each stands there once.
fn keys(file: &str) -> (usize, bool) {
    let text = fs::read_to_string(file).expect("results");
    let keys: Vec<&str> =
        text.lines().filter_map(|line| line.strip_prefix("{\"key\":\"")?.get(..32)).collect();
    let each: HashSet<&str> = keys.iter().copied().collect();
    (keys.len(), each.len() == keys.len())
}

/// Runs a study that saves its results, killed by SIGKILL `kills` times, later each time. Returns the output of the last run, and
/// how many kills left a study that was begun and not complete.
fn killed(command: &[&str], file: &str, whole: Duration, kills: u32) -> (Output, usize) {
    let saving = [command, &["--save", file]].concat();
    let mut midway = 0;
    for n in 0..kills {
        let mut child = start(&saving);
        thread::sleep(whole.mul_f64(f64::from(n % 7 + 1) / f64::from(kills)));
        // It may have ended by itself.
        let _ = child.kill();
        child.wait().expect("it ended");
        let text = fs::read_to_string(file).unwrap_or_default();
        midway += usize::from(text.lines().count() > 1 && !text.contains("{\"complete\":"));
    }
    (shelter(&saving), midway)
}

/// Killed at any moment and started again, a study gives the bytes of one that was never stopped, and computes nothing twice.
#[test]
fn a_study_that_was_killed_ends_as_one_that_was_not() {
    let folder = tempfile::tempdir().expect("a folder");
    let [plan, file] = plan_and_file(folder.path());
    let few_sizes = support::small_plan_of(&["all at once", "42 ms"])
        .edited("tire_mass_kg = [280, 350]", "tire_mass_kg = [280]")
        .edited("most_border_rows = 1", "most_border_rows = 0");
    fs::write(&plan, few_sizes).expect("written");
    let draft = ["--accuracy", "draft"];
    let mut midway = 0;
    for (command, format) in [
        (&["risk", &plan, "--samples", "200", "--seed", "4"][..], "json"),
        (&["orders", &plan, "--samples", "30"], "csv"),
        (&["search", &plan, "--samples", "20"], "json"),
        (&["sweep", &plan, "--interval", "40..60:2", "--samples", "40"], "text"),
        (&["size", &plan, "--option", "42 ms", "--ropes", "EN 12385-4 6x36 FC", "--samples", "30"], "json"),
        (&["size", &plan, "--any-order", "--nominal", "--ropes", "EN 12385-4 6x36 FC"], "text"),
    ] {
        let command = [command, &draft[..], &["--format", format]].concat();
        let begun = Instant::now();
        let whole = shelter(&command);
        let (last, midways) = killed(&command, &file, begun.elapsed(), 4);
        assert_eq!(support::text(&last.stdout), support::text(&whole.stdout), "{command:?}");
        assert_eq!(last.status.code(), whole.status.code());
        midway += midways;
        // All is there now: no result is computed again, so that none is appended.
        let (count, each_once) = keys(&file);
        let again = shelter(&[&command[..], &["--save", &file, "--threads", "1"]].concat());
        assert_eq!(again.stdout, whole.stdout);
        assert!(count > 0 && keys(&file).0 == count, "{command:?}: {count}, then {}", keys(&file).0);
        // The best order is sampled twice, and at an interval of 0 all orders are one shot.
        assert!(each_once || command[0] == "orders" || command.contains(&"--any-order"), "{command:?}");
        fs::remove_file(&file).expect("removed");
    }
    assert!(midway > 5, "a test that can fail: {midway}");
}

/// An interrupt prints what there is, as partial, with the status of a signal; the same command goes on from there. A second
/// interrupt prints nothing.
#[cfg(unix)]
#[test]
fn an_interrupt_prints_what_there_is() {
    let folder = tempfile::tempdir().expect("a folder");
    let [plan, file] = plan_and_file(folder.path());
    let command = ["risk", &plan, "--samples", "40000", "--format", "json", "--save", &file];
    let child = start(&command);
    let saved = || fs::read_to_string(&file).map_or(0, |text| text.lines().count());
    support::wait(PATIENCE, || (saved() >= 300).then_some(()), || format!("{} results are saved", saved()));
    interrupt(&child);
    let output = support::ended(child);
    let told = support::text(&output.stderr);
    assert!(told.contains("interrupted with ") && told.contains("what follows is partial"), "{told}");
    assert_eq!(output.status.code(), Some(130));
    let document = support::json(&output);
    assert_eq!(document["partial"], true);
    assert!(document["options"][0]["failures"].is_number());
    let text = fs::read_to_string(&file).expect("results");
    assert!(text.ends_with("\"}\n") && !text.contains("{\"complete\":"), "the last line is whole");
}

#[cfg(unix)]
fn interrupt(child: &Child) {
    let killed = Command::new("kill").args(["-s", "INT", &child.id().to_string()]).status();
    assert!(killed.expect("kill runs").success(), "it had ended");
}

/// The longest computation ends soon after an interrupt, with the status of a signal.
#[cfg(unix)]
#[test]
fn an_interrupt_ends_a_command_with_130() {
    let plan = support::tested_plan("large-50x50.toml");
    for command in ["check", "sweep", "orders", "size", "report"] {
        let page = ["-o", "never-written.html"];
        let arguments = [
            &[command, &plan, "--dt", "1e-6", "--threads", "1"][..],
            if command == "report" { &page } else { &[] },
        ];
        let child = start(&arguments.concat());
        thread::sleep(Duration::from_millis(700));
        let begun = Instant::now();
        interrupt(&child);
        let output = support::ended(child);
        assert_eq!(output.status.code(), Some(130), "{command}");
        assert!(begun.elapsed() < Duration::from_secs(20), "{command}");
        assert!(!Path::new("never-written.html").exists());
    }
}

/// A last line without its end is dropped, wherever the program was killed; every other line must be as it was written.
#[test]
fn a_torn_line_is_dropped_and_a_damaged_line_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let [plan, file] = plan_and_file(folder.path());
    let command = ["risk", &plan, "--samples", "20", "--accuracy", "draft", "--save", &file];
    let whole = shelter(&command);
    let text = fs::read_to_string(&file).expect("results");
    let lines: Vec<&str> = text.split_inclusive('\n').collect();
    let head = lines[0].len();
    for length in [head, head + 1, head + lines[1].len() - 1, text.len() / 2, text.len() - 1] {
        fs::write(&file, &text[..length]).expect("written");
        let output = shelter(&command);
        assert_eq!(output.stdout, whole.stdout, "{length} bytes: {}", support::text(&output.stderr));
        assert_eq!(fs::read_to_string(&file).expect("results").lines().count(), lines.len());
    }
    let without = |n: usize| {
        lines.iter().enumerate().filter(|(m, _)| *m != n).map(|(_, line)| *line).collect::<String>()
    };
    let cases = [
        (text.replacen("\"fail\"", "\"pass\"", 1), ": the line is not as it was written"),
        (text.replacen("\"height\":1", "\"height\":3", 1), ": the line is not as it was written"),
        (text.replacen("\"seed\":1", "\"seed\":2", 1), "saved.jsonl:1: the line is not as it was written"),
        (text.replacen("\n{", "\n\n{", 1), "saved.jsonl:2: the line is not as it was written"),
        (without(3), "results were written and"),
        (text.replacen("\"version\":\"", "\"version\":\"9", 1), "go on with that version"),
        (text.replacen("\"build\":\"", "\"build\":\"9", 1), "go on with that build"),
        (text.replacen("shelter.results/4", "shelter.results/99", 1), "go on with that version"),
    ];
    for (changed, message) in cases {
        assert_ne!(changed, text, "{message}");
        fs::write(&file, &changed).expect("written");
        let output = shelter(&command);
        let told = support::text(&output.stderr);
        assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{message}: {told}");
        assert!(told.contains(message) && told.contains("saved.jsonl"), "{message}: {told}");
        assert_eq!(fs::read_to_string(&file).expect("results"), changed, "it stays as it is");
        let merged = shelter(&["merge", &file]);
        assert_eq!(merged.status.code(), Some(2), "{message}");
    }
    // The remedy of a damaged line.
    fs::write(&file, without(3).replace(lines[lines.len() - 1], "")).expect("written");
    assert_eq!(shelter(&["merge", &file]).status.code(), Some(2), "not complete");
    assert_eq!(shelter(&command).stdout, whole.stdout);
    let merged = shelter(&["merge", &file]);
    assert_eq!(merged.stdout, whole.stdout, "what is saved is a shard, too");
}

/// The build of a file of results is that of the program, and what another build saved is neither gone on with nor merged, even
/// where every line of it is as it was written.
#[test]
fn results_of_another_build_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let [plan, file] = plan_and_file(folder.path());
    let second = format!("{file}.2");
    let shard = |index: &str, file: &str| {
        shelter(&["risk", &plan, "--samples", "20", "--accuracy", "draft", "--shard", index, "-o", file])
    };
    assert!(shard("1/2", &file).status.success() && shard("2/2", &second).status.success());
    assert_eq!(shelter(&["merge", &file, &second]).status.code(), Some(1));
    let text = fs::read_to_string(&second).expect("results");
    let build =
        format!("{:016x}", build::fingerprint(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("sources"));
    let version = shelter(&["--version"]);
    assert!(support::text(&version.stdout).contains(&build), "{}", support::text(&version.stdout));
    let (head, rest) = text.split_once('\n').expect("a first line");
    let changed = head.edited(&build, "0123456789abcdef");
    let (body, _) = changed.rsplit_once(",\"check\"").expect("sealed");
    let digest = shelter::file::checksum(body);
    let other = format!("{body},\"check\":\"{}\"}}\n{rest}", &digest[..16]);
    fs::write(&second, &other).expect("written");
    for output in [shard("2/2", &second), shelter(&["merge", &file, &second])] {
        let told = support::text(&output.stderr);
        assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{told}");
        assert!(told.contains("results of build 0123456789abcdef") && told.contains(&build), "{told}");
    }
    assert_eq!(fs::read_to_string(&second).expect("results"), other, "it stays as it is");
}

/// The fingerprint of a build changes with every source that computes, the rope catalogue and the dependencies, and with no screen.
#[test]
fn the_fingerprint_of_a_build_is_of_what_computes() {
    let folder = tempfile::tempdir().expect("a folder");
    let root = folder.path();
    let files = [
        ("engine/src/simulation/contact.rs", "1.0", true),
        ("src/study/risk.rs", "let n = 20;\nlet m = 2;\n", true),
        ("src/plan/values.rs", "default", true),
        ("src/ropes/ropes.toml", "20.9", true),
        ("src/verdict.rs", "<", true),
        ("Cargo.lock", "libm 0.2.16", true),
        ("src/tui/app.rs", "a screen", false),
        ("src/report/text.rs", "a table", false),
        ("src/main.rs", "main", false),
        ("src/study/.risk.rs.swp", "an editor's", false),
    ];
    for (name, text, _) in files {
        let path = root.join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("made");
        fs::write(path, text).expect("written");
    }
    let build = || build::fingerprint(root).expect("sources");
    let first = build();
    for (name, text, computes) in files {
        fs::write(root.join(name), text.replace('\n', "\r\n")).expect("written");
        assert_eq!(build(), first, "{name}: line ends do not count");
        fs::write(root.join(name), format!("{text}1")).expect("written");
        assert_eq!(build() != first, computes, "{name}");
        fs::write(root.join(name), text).expect("written");
    }
    fs::rename(root.join("src/plan/values.rs"), root.join("src/plan/other.rs")).expect("renamed");
    assert_ne!(build(), first, "a name counts");
    fs::remove_file(root.join("Cargo.lock")).expect("removed");
    assert!(build::fingerprint(root).is_ok(), "it is no mistake to have none");
}

/// Machines keep a plan in different folders; a plan that says something else is another study, and is told.
#[test]
fn shards_of_one_plan_under_two_paths_are_merged() {
    let folder = tempfile::tempdir().expect("a folder");
    let [plan, file] = plan_and_file(folder.path());
    let other = folder.path().join("elsewhere.toml").to_str().expect("UTF-8").to_owned();
    let second = format!("{file}.2");
    let risk = |plan: &str, more: &[&str]| {
        shelter(&[&["risk", plan, "--samples", "20", "--accuracy", "draft"], more].concat())
    };
    let whole = risk(&plan, &[]);
    fs::copy(&plan, &other).expect("copied");
    assert!(risk(&plan, &["--shard", "1/2", "-o", &file]).status.success());
    assert!(risk(&other, &["--shard", "2/2", "-o", &second]).status.success());
    let merged = shelter(&["merge", &file, &second]);
    assert_eq!(merged.stdout, whole.stdout, "{}", support::text(&merged.stderr));
    let changed = support::small_plan().edited("friction = 0.5", "friction = 0.4");
    fs::write(&other, changed).expect("written");
    fs::remove_file(&second).expect("removed");
    assert!(risk(&other, &["--shard", "2/2", "-o", &second]).status.success());
    let refused = shelter(&["merge", &file, &second]);
    let told = support::text(&refused.stderr);
    assert!(refused.status.code() == Some(2) && told.contains("another plan"), "{told}");
}

/// Shards hold the plan they were computed for. Where its file says something else by now, what they found is shown and nothing of
/// it is a pass: not in text, nor in JSON, nor as the exit status.
#[test]
fn shards_of_a_plan_that_has_changed_since_recommend_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let [plan, file] = plan_and_file(folder.path());
    let [plan, file] = [plan.as_str(), file.as_str()];
    let safe = support::small_plan()
        .edited("launch_m_s = 6.0", "launch_m_s = 1.0")
        .edited("accepted_risk_percent = 1 ", "accepted_risk_percent = 5 ");
    let questions: [(&str, &[&str]); 3] =
        [("risk", &["--samples", "250"]), ("orders", &["--interval", "20..20:1"]), ("search", &[])];
    for (question, own) in questions {
        fs::write(plan, &safe).expect("written");
        let _ = fs::remove_file(file);
        let shard = [&[question, plan], own, &["--accuracy", "draft", "--shard", "1/1", "-o", file]].concat();
        let computed = shelter(&shard);
        assert!(computed.status.success(), "{question:?}: {}", support::text(&computed.stderr));
        let same = shelter(&["merge", file]);
        assert_eq!(same.status.code(), Some(0), "{question:?}: {}", support::text(&same.stdout));
        assert!(!support::text(&same.stderr).contains("does not say what was judged"));

        fs::write(plan, safe.replace("friction = 0.5", "friction = 0.4")).expect("written");
        let text = shelter(&["merge", file]);
        let shown = support::text(&text.stdout);
        assert_eq!(text.status.code(), Some(1), "{question:?}: {shown}");
        assert!(shown.contains("plan.toml does not say what was judged"), "{shown}");
        let last = shown.lines().last().expect("an answer");
        assert!(last.starts_with("HOLD") && !last.contains("1 of 1") && !last.contains("2 of 2"), "{shown}");
        let json = shelter(&["merge", file, "--format", "json"]);
        let document: serde_json::Value = serde_json::from_slice(&json.stdout).expect("JSON");
        assert_eq!((json.status.code(), &document["verdict"]), (Some(1), &"undecided".into()));
        assert!(document["warnings"].to_string().contains("does not say what was judged"), "{document}");
        assert!(!document.to_string().contains("\"pass\""), "no row of it passes: {document}");
        assert!(!shown.contains("PASS"), "{shown}");

        // A machine without the plan's file: nobody can look at what was seen beside it.
        fs::remove_file(plan).expect("removed");
        let gone = shelter(&["merge", file]);
        let alone = support::text(&gone.stdout);
        assert!(alone.contains("plan.toml is not here"), "{alone}");
        assert!(alone.contains("lie beside the plan, which is not here"), "{alone}");
        assert!(alone.lines().last().is_some_and(|last| last.starts_with("HOLD")), "{alone}");
        assert_eq!(gone.status.code(), Some(1));
    }
}

/// What PowerShell makes of a shard: UTF-16 or UTF-8 with a byte order mark, and line ends of Windows.
#[test]
fn a_shard_that_powershell_wrote_is_merged() {
    let folder = tempfile::tempdir().expect("a folder");
    let [plan, file] = plan_and_file(folder.path());
    let command = ["risk", &plan, "--samples", "20", "--accuracy", "draft"];
    let whole = shelter(&command);
    assert!(shelter(&[&command[..], &["--shard", "1/1", "-o", &file]].concat()).status.success());
    let text = format!("\u{feff}{}", fs::read_to_string(&file).expect("results").replace('\n', "\r\n"));
    let utf16: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
    for bytes in [utf16, text.into_bytes()] {
        fs::write(&file, bytes).expect("written");
        let merged = shelter(&["merge", &file]);
        assert_eq!(merged.stdout, whole.stdout, "{}", support::text(&merged.stderr));
    }
}

/// A file of another study, of another program, in use or no file at all stays as it is.
#[test]
fn results_of_another_study_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let [plan, file] = plan_and_file(folder.path());
    let command = ["risk", &plan, "--samples", "20", "--accuracy", "draft", "--save", &file];
    assert!(!shelter(&command).stdout.is_empty());
    let saved = fs::read_to_string(&file).expect("results");
    let refused = |arguments: &[&str], message: &str| {
        let output = shelter(arguments);
        let told = support::text(&output.stderr);
        assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{arguments:?}: {told}");
        assert!(told.contains(message), "{arguments:?}: {told}");
    };
    let others: [(&[&str], &str); 6] = [
        (&["risk", &plan, "--samples", "21", "--accuracy", "draft"], "another question"),
        (&["risk", &plan, "--samples", "20", "--accuracy", "draft", "--seed", "2"], "another question"),
        (&["risk", &plan, "--samples", "20"], "another method, accuracy or step"),
        (&["risk", &plan, "--samples", "20", "--accuracy", "draft", "--shard", "1/2"], "another shard"),
        (&["orders", &plan, "--accuracy", "draft"], "another question"),
        (&["sweep", &plan, "--accuracy", "draft"], "another question"),
    ];
    for (arguments, message) in others {
        refused(&[arguments, &["--save", &file]].concat(), message);
    }
    let text = support::small_plan();
    fs::write(&plan, text.edited("friction = 0.5", "friction = 0.4")).expect("written");
    refused(&command, "another plan");
    fs::write(&plan, text).expect("written");
    assert_eq!(fs::read_to_string(&file).expect("results"), saved);
    let notes = folder.path().join("notes.txt").to_str().expect("UTF-8").to_owned();
    for theirs in ["{\"schema\":\"other/1\"}\n", "what the shotfirer noted", "\u{0}\u{1}"] {
        fs::write(&notes, theirs).expect("written");
        refused(&["risk", &plan, "--save", &notes], "holds no results of a study");
        assert_eq!(fs::read_to_string(&notes).expect("notes"), theirs);
    }
    refused(&["risk", &plan, "--save", folder.path().to_str().expect("UTF-8")], "is no file");
    refused(&["risk", &plan, "--save", "/none/saved.jsonl"], "there is no such folder");
    // An empty file is nobody's.
    fs::write(&notes, "").expect("written");
    let begun = ["risk", &plan, "--samples", "20", "--accuracy", "draft", "--save", &notes];
    assert_eq!(shelter(&begun).stdout, shelter(&command).stdout);
    let held = fs::File::open(&file).expect("results");
    held.lock().expect("locked");
    refused(&command, "another run saves its results there");
}

/// Results that cannot be saved are said to be missing; those that are printed stand.
#[cfg(unix)]
#[test]
fn a_full_disk_loses_no_result_that_was_saved() {
    let folder = tempfile::tempdir().expect("a folder");
    let [plan, file] = plan_and_file(folder.path());
    let command = ["risk", &plan, "--samples", "100", "--accuracy", "draft", "--save", &file];
    let script = "trap '' XFSZ; ulimit -f 40; exec \"$0\" \"$@\"";
    let output = support::output(Command::new("sh").args(["-c", script, PROGRAM]).args(command));
    let told = support::text(&output.stderr);
    assert!(told.contains("not all results are saved"), "{told}");
    let again = shelter(&command);
    assert!(!support::text(&again.stderr).contains("not all results are saved"));
    assert_eq!(again.stdout, output.stdout);
}

/// A session with a copy of a plan begins with what was seen under the first name, as commands do.
#[test]
fn a_session_with_a_copy_of_a_plan_knows_that_something_was_seen() {
    let folder = tempfile::tempdir().expect("a folder");
    let [rows, copied] = ["rows.toml", "copied.toml"].map(|name| folder.path().join(name));
    for plan in [&rows, &copied] {
        fs::write(plan, support::small_plan()).expect("written");
    }
    assert_eq!(::shelter::kept::find(Some(&copied)), None);
    let seen = "{\"typed\":[\"42 ms,2:1,flight_height_m,2.9,0.05\"],\"files\":[]}";
    fs::write(folder.path().join("rows.seen.json"), seen).expect("written");
    let kept = ::shelter::kept::find(Some(&copied)).expect("something is known");
    assert!(kept.record.has_unreadable(), "its plan is on hold until its own file says as much");
    fs::write(folder.path().join("copied.seen.json"), seen).expect("written");
    let kept = ::shelter::kept::find(Some(&copied)).expect("something is known");
    assert!(kept.record.has_typed() && !kept.record.has_unreadable());
}

/// A film of another blast holds no plan beside it, but who fires by that is asked.
#[test]
fn films_of_another_blast_in_the_folder_are_confirmed() {
    let folder = tempfile::tempdir().expect("a folder");
    let [rows, next] = ["rows.toml", "next.toml"].map(|name| folder.path().join(name));
    fs::write(&rows, support::small_plan()).expect("written");
    // One column more, and launches of which every option passes.
    let passing = support::small_plan_of(&["42 ms"]).edited("columns = 3 ", "columns = 4 ");
    fs::write(&next, passing.edited("launch_m_s = 6.0", "launch_m_s = 4.0")).expect("written");
    let boxes = || -> Vec<String> {
        let next = next.to_str().expect("UTF-8");
        let told = shelter(&["check", next, "--accuracy", "draft", "--format", "json"]);
        let passed = support::json(&told)["to_be_confirmed"].clone();
        let boxes: Vec<String> = serde_json::from_value(passed).expect("boxes of an option that passes");
        boxes.into_iter().filter(|line| line.contains("another blast")).collect()
    };
    assert_eq!(boxes(), [""; 0]);
    let seen = "{\"typed\":[\"42 ms,2:1,flight_height_m,2.9,0.05\"],\"files\":[]}";
    fs::write(folder.path().join("rows.seen.json"), seen).expect("written");
    let asked = "rows.seen.json: films of another blast, not compared: is the launch the same?";
    assert_eq!(boxes(), [asked]);
    // A film without its plan holds this one: nothing passes that boxes could release.
    fs::remove_file(&rows).expect("removed");
    let told = shelter(&["check", next.to_str().expect("UTF-8"), "--accuracy", "draft", "--format", "json"]);
    let document = support::json(&told);
    assert!(document["recommended"].is_null() && document["to_be_confirmed"].is_null(), "{document}");
}
