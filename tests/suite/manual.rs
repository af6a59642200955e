//! The manual: short sentences where a reader begins, outputs that are those of the program, links that lead somewhere.

use std::fs;
use std::path::{Path, PathBuf};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// Pages that a newcomer reads before any other.
const FIRST_PAGES: [&str; 5] =
    ["README.md", "docs/first-plan.md", "docs/what-pass-means.md", "docs/on-site.md", "docs/screens.md"];
const MOST_WORDS: usize = 30;

/// README, and the pages of the book.
fn pages() -> Vec<PathBuf> {
    let folders = ["docs", "docs/studies"].map(|folder| Path::new(ROOT).join(folder));
    let files = folders.iter().flat_map(|folder| fs::read_dir(folder).expect("a folder"));
    let files = files.map(|file| file.expect("a file").path());
    let pages = files.filter(|path| path.extension().is_some_and(|ending| ending == "md"));
    pages.chain([Path::new(ROOT).join("README.md")]).collect()
}

fn read(page: &Path) -> String {
    fs::read_to_string(page).expect("a page")
}

/// A page without its code blocks.
fn prose(page: &str) -> String {
    page.split("```").step_by(2).collect::<Vec<_>>().join("\n\n")
}

/// Sentences of a page. A cell of a table, a list item, a heading and an empty line end one, too.
fn sentences(page: &str) -> Vec<String> {
    let mut text = String::new();
    for line in prose(page).lines().map(str::trim) {
        let begins = line.is_empty() || line.starts_with(['|', '#', '-', '*', '!']);
        text.push(if begins { '\n' } else { ' ' });
        text.push_str(&line.replace('|', "\n"));
    }
    let ended = [". ", "? ", "! "].into_iter().fold(text, |text, end| text.replace(end, "\n"));
    ended.lines().map(str::to_owned).collect()
}

fn word_count(sentence: &str) -> usize {
    sentence.split_whitespace().filter(|word| word.chars().any(char::is_alphanumeric)).count()
}

#[test]
fn sentences_where_a_reader_begins_are_short() {
    for page in FIRST_PAGES {
        let sentences = sentences(&read(&Path::new(ROOT).join(page)));
        assert!(sentences.iter().filter(|sentence| word_count(sentence) > 8).count() > 20, "{page} is read");
        let long: Vec<&String> =
            sentences.iter().filter(|sentence| word_count(sentence) > MOST_WORDS).collect();
        assert!(long.is_empty(), "{page}: over {MOST_WORDS} words: {long:#?}");
    }
    let readme = read(&Path::new(ROOT).join("README.md"));
    assert!(readme.lines().count() <= 120, "README is read in two minutes");
}

#[test]
fn the_book_lists_every_page_and_its_links_lead_to_files() {
    let contents = read(&Path::new(ROOT).join("docs/SUMMARY.md"));
    for path in pages() {
        let page = read(&path);
        let prose = prose(&page);
        let book = Path::new(ROOT).join("docs");
        let inside = path.strip_prefix(&book).ok().and_then(Path::to_str);
        let between = |begin: &str, end: char| {
            prose.split(begin).skip(1).filter_map(|rest| Some(rest.split_once(end)?.0)).collect::<Vec<_>>()
        };
        let links = [between("](", ')'), between("src=\"", '"'), between("srcset=\"", '"')].concat();
        for link in links.into_iter().filter(|link| !link.starts_with("https://")) {
            let file = path.with_file_name(link.split('#').next().unwrap_or_default());
            assert!(file.exists(), "{}: {link}", path.display());
            let is_of_book =
                file.canonicalize().expect("a file").starts_with(book.canonicalize().expect("docs"));
            assert!(inside.is_none() || is_of_book, "{}: the book lacks {link}", path.display());
        }
        if let Some(name) = inside.filter(|name| *name != "SUMMARY.md") {
            let name = name.replace('\\', "/");
            assert!(contents.contains(&format!("]({name})")), "SUMMARY.md does not list {name}");
        }
    }
}

/// The tutorial names the lines to change; its second plan is the first one with these lines.
#[test]
fn the_second_plan_of_the_tutorial_is_the_first_one_changed_as_it_says() {
    let file = |name: &str| read(&Path::new(ROOT).join("docs").join(name));
    let table = |text: &str| text.parse::<toml::Table>().expect("TOML");
    let page = file("first-plan.md");
    let rows = page.split("| in place of | write |").nth(1).expect("the lines to change").lines().skip(2);
    let rows: Vec<Vec<&str>> =
        rows.take_while(|row| row.starts_with('|')).map(|row| row.split('`').collect()).collect();
    assert!(rows.len() > 2, "{rows:?}");
    let changed = rows.iter().fold(file("steel.toml"), |plan, row| {
        assert!(plan.contains(row[1]), "{}", row[1]);
        plan.replace(row[1], row[3])
    });
    assert_eq!(table(&changed), table(&file("road-cut.toml")));
}

/// Whether a program printed what a page shows. A line `…` stands for any lines, `…` at the end of a line for any text.
#[cfg(unix)]
fn is_shown(shown: &[&str], printed: &[&str]) -> bool {
    match shown {
        [] => printed.is_empty(),
        ["…", rest @ ..] => (0..=printed.len()).any(|left_out| is_shown(rest, &printed[left_out..])),
        [line, rest @ ..] => printed.split_first().is_some_and(|(first, printed)| {
            let alike = match line.strip_suffix('…') {
                Some(start) => first.starts_with(start),
                None => first == line,
            };
            alike && is_shown(rest, printed)
        }),
    }
}

/// A folder in which the commands of the manual run: the plans, the book, and the plans of the book beside them.
#[cfg(unix)]
fn reader_folder() -> tempfile::TempDir {
    use std::os::unix::fs::symlink;
    let folder = tempfile::tempdir().expect("a folder");
    let names = ["plans", "docs"].map(|name| (name, name.to_owned()));
    let plans = ["steel.toml", "road-cut.toml"].map(|name| (name, format!("docs/{name}")));
    for (name, target) in names.into_iter().chain(plans) {
        symlink(Path::new(ROOT).join(target), folder.path().join(name)).expect("a link");
    }
    folder
}

/// A block that begins with ```` ```console ```` holds commands behind `$ `, each above what it prints.
/// `INSTA_UPDATE=always` writes what the program prints into the page.
#[cfg(unix)]
#[test]
fn commands_of_the_manual_print_what_it_shows() {
    use super::support::{PROGRAM, output, text};
    let folder = reader_folder();
    let programs = Path::new(PROGRAM).parent().expect("a folder").display();
    let path = format!("{programs}:{}", std::env::var("PATH").unwrap_or_default());
    let writes = std::env::var("INSTA_UPDATE").is_ok_and(|wanted| wanted == "always");
    // What several pages show is computed once.
    let mut printed_by = std::collections::HashMap::new();
    for page in pages() {
        let mut manual = read(&page);
        let shown = manual.clone();
        let blocks = shown.split("```console\n$ ").skip(1).filter_map(|rest| rest.split("```").next());
        for (command, shown) in
            blocks.flat_map(|block| block.split("\n$ ")).filter_map(|it| it.split_once('\n'))
        {
            // Of a page nothing is shown: as planned alone it is written in no time.
            let written = command.split_once(" -o ").map(|(_, name)| folder.path().join(name));
            let run = written.iter().fold(command.to_owned(), |command, _| command + " --nominal");
            let printed = printed_by.entry(run).or_insert_with_key(|run| {
                let mut shell = std::process::Command::new("sh");
                let result = output(shell.args(["-c", run]).env("PATH", &path).current_dir(folder.path()));
                text(&result.stdout).to_owned()
            });
            assert!(
                written.is_none_or(|file| file.exists()),
                "{}: `{command}` writes no page",
                page.display()
            );
            let alike = is_shown(&shown.lines().collect::<Vec<_>>(), &printed.lines().collect::<Vec<_>>());
            if !alike && writes {
                let end = if shown.ends_with('\n') { "\n" } else { "" };
                let new = format!("$ {command}\n{}{end}", printed.trim_end());
                manual = manual.replacen(&format!("$ {command}\n{shown}"), &new, 1);
            }
            assert!(alike || writes, "{}: `{command}` prints\n{printed}", page.display());
        }
        if writes {
            fs::write(&page, manual).expect("written");
        }
    }
    assert!(printed_by.len() > 12, "{:?} were found", printed_by.keys());
}
