//! Kills, full disks and closed pipes: what is on the disk stays whole, and what happened is said.

use std::fs;
#[cfg(unix)]
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::thread;
#[cfg(unix)]
use std::time::Duration;
use std::time::Instant;

use shelter::file;

#[cfg(unix)]
use super::support::within;
use super::support::{PATIENCE, PROGRAM, ended, output, tested_plan};

/// A plan of one small shelter that three ropes are tried for, and what `size --write` makes of it.
fn small_plan(folder: &Path) -> (std::path::PathBuf, String, String) {
    let plan = folder.join("plan.toml");
    let text = include_str!("../../plans/paper-5-tire.toml");
    // Long enough that a save takes more than one block of the disk.
    let text = format!("{text}\n{}", "# what the shotfirer noted\n".repeat(2000));
    fs::write(&plan, &text).expect("written");
    assert!(size(&plan).status.success());
    let new = fs::read_to_string(&plan).expect("the plan");
    assert_ne!(new, text);
    (plan, text, new)
}

fn size(plan: &Path) -> Output {
    output(&mut sizing(plan))
}

fn sizing(plan: &Path) -> Command {
    let mut command = Command::new(PROGRAM);
    command.args(["size", "--write", "--nominal", "--accuracy", "draft"]).arg(plan);
    command.stdout(Stdio::null()).stderr(Stdio::null());
    command
}

/// Killed at thirty moments from its start to past its end, and later ones while a loaded machine has not let it come to its
/// end once, it leaves the old plan or the new one.
#[test]
fn a_killed_save_leaves_the_old_plan_or_the_new_one() {
    let folder = tempfile::tempdir().expect("a folder");
    let (plan, old, new) = small_plan(folder.path());
    let begun = Instant::now();
    fs::write(&plan, &old).expect("written");
    size(&plan);
    let whole = begun.elapsed();
    let mut seen = [0, 0];
    for n in 0..200 {
        if n >= 30 && seen[1] > 0 {
            break;
        }
        fs::write(&plan, &old).expect("written");
        let mut child = sizing(&plan).spawn().expect("it starts");
        thread::sleep(whole.mul_f64(f64::from(n) / 24.0));
        // It may have ended by itself.
        let _ = child.kill();
        child.wait().expect("it ended");
        let left = fs::read_to_string(&plan).expect("the plan");
        assert!(left == old || left == new, "after {n}: {} bytes", left.len());
        seen[usize::from(left == new)] += 1;
    }
    assert!(seen[0] > 0 && seen[1] > 0, "both were seen: {seen:?}");
}

/// Killed as soon as anything in the folder changes, in the midst of writing a plan of megabytes.
#[test]
fn a_save_killed_as_it_begins_leaves_the_old_plan_or_the_new_one() {
    let folder = tempfile::tempdir().expect("a folder");
    let (plan, old, new) = small_plan(folder.path());
    let notes = "# what the shotfirer noted\n".repeat(200_000);
    let (old, new) = (old + &notes, new + &notes);
    for n in 0..8 {
        fs::write(&plan, &old).expect("written");
        let files = || fs::read_dir(folder.path()).expect("the folder").count();
        let before = files();
        let mut child = sizing(&plan).spawn().expect("it starts");
        let length = || plan.metadata().map_or(0, |data| data.len());
        let begun = Instant::now();
        while child.try_wait().expect("a child").is_none() && begun.elapsed() < PATIENCE {
            if files() != before || length() != old.len() as u64 {
                let _ = child.kill();
                break;
            }
        }
        ended(child);
        let left = fs::read_to_string(&plan).expect("the plan");
        assert!(left == old || left == new, "round {n}: {} bytes of {}", left.len(), old.len());
    }
}

/// The disk is full after a few blocks: the old text stays until all of the new one is written, and nothing
/// else is left behind.
#[cfg(unix)]
#[test]
fn a_full_disk_leaves_the_old_plan() {
    let folder = tempfile::tempdir().expect("a folder");
    let (plan, old, _) = small_plan(folder.path());
    for blocks in [0, 1, 2, 5, 10, 20, 40, 50] {
        fs::write(&plan, &old).expect("written");
        // A file may grow to `blocks` blocks of 512 bytes; beyond that writing fails as on a full disk.
        let script = format!(
            "trap '' XFSZ; ulimit -f {blocks}; exec \"$0\" size --write --nominal --accuracy draft \"$1\""
        );
        let output = output(Command::new("sh").args(["-c", &script, PROGRAM]).arg(&plan));
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{blocks} blocks: {told}");
        assert!(told.contains("plan.toml"), "{told}");
        assert_eq!(fs::read_to_string(&plan).expect("the plan"), old, "{blocks} blocks");
        assert_eq!(fs::read_dir(folder.path()).expect("the folder").count(), 1, "{blocks} blocks");
    }
}

#[test]
fn a_folder_that_cannot_be_written_leaves_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("file");
    fs::write(&file, "text").expect("written");
    // A file where a folder should be.
    assert!(file::save(&file.join("plan.toml"), "new").is_err());
    assert!(file::save(&folder.path().join("none/plan.toml"), "new").is_err());
    assert_eq!(fs::read_dir(folder.path()).expect("the folder").count(), 1);
}

/// A link stays a link, and rights stay as they were.
#[cfg(unix)]
#[test]
fn links_and_rights_survive_a_save() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().expect("a folder");
    let (file, link) = (folder.path().join("file.toml"), folder.path().join("link.toml"));
    fs::write(&file, "old").expect("written");
    fs::set_permissions(&file, fs::Permissions::from_mode(0o664)).expect("set");
    std::os::unix::fs::symlink(&file, &link).expect("linked");
    file::save(&link, "new").expect("saved");
    assert!(link.symlink_metadata().expect("the link").is_symlink());
    assert_eq!(fs::read_to_string(&file).expect("the file"), "new");
    assert_eq!(file.metadata().expect("the file").permissions().mode() & 0o777, 0o664);
    fs::set_permissions(&file, fs::Permissions::from_mode(0o440)).expect("set");
    assert!(file::save(&link, "newer").is_err_and(|error| error.to_string().contains("may only be read")));
    assert_eq!(fs::read_to_string(&file).expect("the file"), "new");
}

/// What is no file is written to and not replaced.
#[cfg(target_os = "linux")]
#[test]
fn a_device_stays_one() {
    use std::os::unix::fs::FileTypeExt;
    let full = Path::new("/dev/full");
    assert!(file::save(full, "text").is_err_and(|error| error.to_string().contains("the disk is full")));
    assert!(full.metadata().expect("a device").file_type().is_char_device());
    file::save(Path::new("/dev/null"), "text").expect("written");
}

#[cfg(target_os = "linux")]
#[test]
fn output_that_cannot_be_written_is_said() {
    let full = fs::OpenOptions::new().write(true).open("/dev/full").expect("the full device");
    let plan = &tested_plan("paper-5-tire.toml");
    let mut command = Command::new(PROGRAM);
    let child = command.args(["check", plan]).stdout(full).stderr(Stdio::piped()).spawn();
    let output = ended(child.expect("it runs"));
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("No space left"));
}

/// Where nothing can be written any more, neither results nor errors, the program ends with a status: it does not panic.
#[cfg(target_os = "linux")]
#[test]
fn output_and_errors_that_nobody_takes_end_in_a_status() {
    let folder = tempfile::tempdir().expect("a folder");
    let bad = folder.path().join("bad.toml");
    fs::write(&bad, "rows = ").expect("written");
    let (plan, bad) = (tested_plan("paper-5-tire.toml"), bad.to_str().expect("UTF-8").to_owned());
    let draft = ["--accuracy", "draft", "--nominal"];
    let cases: &[&[&str]] = &[
        &["check", &plan],
        &["check", &bad],
        &["check", &plan, "--timeout", "0.001", "--accuracy", "reference"],
        &["size", &plan],
        &["sweep", &plan],
        &["merge", &bad],
        &["trace", &plan],
        &["fit", &plan, "--observed", &bad],
        &["ropes"],
        &["man"],
        &["schema"],
        &["config"],
        &["completions", "bash"],
        &["init", "-"],
        &["no-such-command", "-x"],
        &[],
    ];
    for arguments in cases {
        let full = || fs::OpenOptions::new().write(true).open("/dev/full").expect("the full device");
        let more = if ["check", "size", "sweep"].contains(arguments.first().unwrap_or(&"")) {
            &draft[..]
        } else {
            &[]
        };
        let more = if arguments.contains(&"--timeout") { &[] } else { more };
        let mut command = Command::new(PROGRAM);
        let child = command.args(*arguments).args(more).stdout(full()).stderr(full()).spawn();
        let code = ended(child.expect("it runs")).status.code();
        assert!([Some(1), Some(2)].contains(&code), "{arguments:?}: {code:?}");
    }
}

/// Whoever reads the output may stop reading: nothing is said about it.
#[test]
fn a_closed_pipe_ends_it_quietly() {
    let plan = &tested_plan("paper-5-tire.toml");
    for arguments in [&["check", plan][..], &["trace", plan], &["ropes"], &["man"], &["schema"]] {
        let mut child = Command::new(PROGRAM)
            .args(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("it starts");
        drop(child.stdout.take());
        let output = ended(child);
        let told = String::from_utf8_lossy(&output.stderr);
        assert!(told.lines().all(|line| line.starts_with("warning: ")), "{arguments:?}: {told}");
        assert_ne!(output.status.code(), None, "{arguments:?} ends by itself");
    }
}

#[test]
fn a_closed_pipe_does_not_turn_a_fail_into_a_pass() {
    let mut child = Command::new(PROGRAM)
        .args(["check", &tested_plan("amur-three-rows.toml"), "--accuracy", "draft", "--samples", "50"])
        .stdout(Stdio::piped())
        .spawn()
        .expect("it starts");
    drop(child.stdout.take());
    assert_eq!(ended(child).status.code(), Some(1));
}

/// A plan that comes through a pipe is read as it comes.
#[cfg(unix)]
#[test]
fn a_plan_is_read_from_a_fifo_and_from_standard_input() {
    let folder = tempfile::tempdir().expect("a folder");
    let fifo = folder.path().join("fifo");
    assert!(Command::new("mkfifo").arg(&fifo).status().expect("mkfifo runs").success());
    let text = include_str!("../../plans/paper-5-tire.toml");
    let check = |path: &Path| {
        let mut command = Command::new(PROGRAM);
        command.args(["check", "--format", "csv"]).arg(path).stdin(Stdio::piped()).stdout(Stdio::piped());
        command.spawn().expect("it starts")
    };
    let child = check(&fifo);
    let open = move || fs::OpenOptions::new().write(true).open(&fifo).expect("the fifo");
    let mut writer = within("opening a fifo that nobody reads", open);
    let (first, second) = text.split_at(text.len() / 2);
    writer.write_all(first.as_bytes()).expect("written");
    thread::sleep(Duration::from_millis(50));
    writer.write_all(second.as_bytes()).expect("written");
    drop(writer);
    assert!(ended(child).status.success());
    let mut child = check(Path::new("-"));
    child.stdin.take().expect("a pipe").write_all(text.as_bytes()).expect("written");
    assert!(ended(child).status.success());
}

/// A pipe that nobody reads from, or writes to, holds up neither --timeout nor a signal.
#[cfg(unix)]
#[test]
fn a_pipe_without_a_partner_holds_nothing_up() {
    let folder = tempfile::tempdir().expect("a folder");
    let fifo = folder.path().join("fifo");
    assert!(Command::new("mkfifo").arg(&fifo).status().expect("mkfifo runs").success());
    let (fifo, plan) = (fifo.to_str().expect("UTF-8"), tested_plan("paper-5-tire.toml"));
    let begun = Instant::now();
    let start = |arguments: &[&str]| {
        let mut command = Command::new(PROGRAM);
        command.args(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("it starts")
    };
    let output = ended(start(&["report", &plan, "-o", fifo, "--force", "--nominal"]));
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("nobody reads from it"));
    let output = ended(start(&["check", fifo, "--timeout", "0.5"]));
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stderr).contains("the time was up before the plan was read"));
    let output = ended(start(&["search", fifo, "--write", "--timeout", "0.5"]));
    assert!(!output.status.success());
    let waiting = start(&["check", fifo]);
    thread::sleep(Duration::from_millis(300));
    let id = waiting.id().to_string();
    assert!(Command::new("kill").args(["-s", "TERM", &id]).status().expect("kill runs").success());
    assert!(!ended(waiting).status.success());
    assert!(begun.elapsed() < Duration::from_secs(60), "{:?}", begun.elapsed());
    // With a partner, however slow, all of it arrives.
    let reader = thread::spawn({
        let fifo = fifo.to_owned();
        move || {
            let mut file = fs::File::open(fifo).expect("the fifo");
            thread::sleep(Duration::from_millis(200));
            let mut text = String::new();
            std::io::Read::read_to_string(&mut file, &mut text).map(|_| text)
        }
    });
    let text = "what the shotfirer noted\n".repeat(100_000);
    file::save(Path::new(fifo), &text).expect("written");
    assert!(within("reading a fifo", || reader.join()).expect("a reader").expect("read") == text);
    // A partner that leaves is an error; of standard output it would be none.
    let leaves = thread::spawn({
        let fifo = fifo.to_owned();
        move || fs::File::open(fifo).map(drop)
    });
    let error = file::save(Path::new(fifo), &text).expect_err("it is not read to its end");
    assert_ne!(error.kind(), std::io::ErrorKind::BrokenPipe, "{error}");
    within("leaving a fifo", || leaves.join()).expect("a reader").expect("opened");
}

/// A plan of somebody else stays theirs, though anybody may write into its folder. Only root can set this up.
#[cfg(target_os = "linux")]
#[test]
fn a_save_keeps_the_owner_or_refuses() {
    use std::os::unix::fs::{MetadataExt, PermissionsExt, chown};
    use std::os::unix::process::CommandExt;
    const NOBODY: u32 = 65_534;
    let folder = tempfile::tempdir().expect("a folder");
    let plan = folder.path().join("plan.toml");
    fs::write(&plan, "old").expect("written");
    if fs::metadata(&plan).expect("a file").uid() != 0 {
        return;
    }
    let rights =
        |path: &Path, mode: u32| fs::set_permissions(path, fs::Permissions::from_mode(mode)).expect("set");
    chown(&plan, Some(NOBODY), Some(NOBODY)).expect("given");
    rights(&plan, 0o640);
    file::save(&plan, "new").expect("saved");
    let kept = fs::metadata(&plan).expect("a file");
    assert_eq!((kept.uid(), kept.gid(), kept.mode() & 0o777), (NOBODY, NOBODY, 0o640));
    rights(folder.path(), 0o777);
    chown(&plan, Some(0), Some(0)).expect("given");
    // The program where anybody may run it.
    let program = folder.path().join("shelter");
    fs::copy(PROGRAM, &program).expect("copied");
    let text = include_str!("../../plans/paper-5-tire.toml");
    for (mode, said) in [(0o644, "it may not be written"), (0o666, "it belongs to somebody else")] {
        fs::write(&plan, text).expect("written");
        rights(&plan, mode);
        let mut command = Command::new(&program);
        command.args(["size", "--write", "--accuracy", "draft"]).arg(&plan).uid(NOBODY).gid(NOBODY);
        let output = output(&mut command);
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{told}");
        assert!(told.contains(said), "{told}");
        assert_eq!(fs::read_to_string(&plan).expect("the plan"), text);
        assert_eq!(fs::metadata(&plan).expect("a file").uid(), 0);
    }
    assert_eq!(fs::read_dir(folder.path()).expect("the folder").count(), 2, "nothing is left beside it");
}

/// A file name that clears the screen, turns text round or begins a line is shown, not done.
#[cfg(unix)]
#[test]
fn a_file_name_with_characters_that_nobody_sees_is_shown() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = include_str!("../../plans/paper-5-tire.toml").replacen("title", "# title", 1);
    let names = ["\u{1b}[2Ja.toml", "PASS\n\u{202e}b.toml"];
    for (name, shown) in names.iter().zip(["\\u{1b}[2Ja.toml", "PASS\\n\\u{202e}b.toml"]) {
        let plan = folder.path().join(name);
        let page = folder.path().join("page.html");
        let run = |arguments: &[&str]| {
            let output = output(Command::new(PROGRAM).args(arguments).current_dir(folder.path()));
            let all = [output.stdout, output.stderr].concat();
            String::from_utf8(all).expect("UTF-8")
        };
        let hidden = |text: &str| text.contains(['\u{1b}', '\u{202e}']) || text.contains("PASS\n");
        let path = plan.to_str().expect("UTF-8");
        fs::write(&plan, &text).expect("written");
        let checked = run(&["check", path, "--nominal"]);
        assert!(checked.contains(shown) && !hidden(&checked), "{checked}");
        let _ = run(&["report", path, "--nominal", "-o", page.to_str().expect("UTF-8")]);
        let written = fs::read_to_string(&page).expect("the page");
        assert!(written.contains(shown) && !written.contains(['\u{1b}', '\u{202e}']));
        fs::remove_file(&page).expect("removed");
        fs::write(&plan, "rows = \"\u{202e}\"\n\"\u{9b}2J\" = 1").expect("written");
        for told in [
            run(&["check", path]),
            run(&["check", "none", path]),
            run(&["init", path]),
            run(&["merge", path]),
        ] {
            assert!(!told.is_empty() && told.contains(shown) && !hidden(&told), "{told}");
        }
    }
}
