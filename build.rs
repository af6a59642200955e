//! Gives the crate `SHELTER_BUILD`: the fingerprint of all sources that results depend on.

use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=src");
    println!("cargo::rerun-if-changed=Cargo.lock");
    let root = env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from).unwrap_or_default();
    if engine(&root).exists() {
        println!("cargo::rerun-if-changed=engine/src");
    }
    println!("cargo::rustc-env=SHELTER_BUILD={:016x}", fingerprint(&root)?);
    Ok(())
}

/// Folders and files of `src` that only show results, or ask for them. Every other one counts as computing.
const SHOWING: [&str; 5] = ["cli", "jobs", "main.rs", "report", "tui"];

/// Sources of the crate that integrates. A package has none: there its version stands in Cargo.lock.
fn engine(root: &Path) -> PathBuf {
    root.join("engine/src")
}

/// FNV-1a digest of the names and texts of all sources that compute, and of the versions of the dependencies. It is the same on
/// every system: line ends do not count.
pub fn fingerprint(root: &Path) -> io::Result<u64> {
    let mut files = Vec::new();
    for entry in fs::read_dir(root.join("src"))? {
        let entry = entry?;
        if !SHOWING.iter().any(|name| entry.file_name() == *name) {
            collect(&entry.path(), &mut files)?;
        }
    }
    if engine(root).exists() {
        collect(&engine(root), &mut files)?;
    }
    // A package has it; the crate as a dependency of others takes the versions that they choose.
    files.extend(Some(root.join("Cargo.lock")).filter(|lock| lock.exists()));
    let name = |file: &PathBuf| file.strip_prefix(root).map(|name| name.to_string_lossy().replace('\\', "/"));
    let mut texts = Vec::new();
    for file in &files {
        texts.push((name(file).map_err(io::Error::other)?, fs::read(file)?));
    }
    texts.sort();
    let bytes = texts.iter().flat_map(|(name, text)| [name.as_bytes(), b"\0", text, b"\0"].concat());
    let add = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    Ok(bytes.filter(|byte| *byte != b'\r').fold(0xcbf2_9ce4_8422_2325, add))
}

/// Appends the sources and tables in a folder and the folders in it; of a file, the file.
fn collect(path: &Path, files: &mut Vec<PathBuf>) -> io::Result<()> {
    if !path.is_dir() {
        // An editor may leave files of its own.
        let is_source = path.extension().is_some_and(|ending| ending == "rs" || ending == "toml");
        files.extend(is_source.then(|| path.to_owned()));
        return Ok(());
    }
    for entry in fs::read_dir(path)? {
        collect(&entry?.path(), files)?;
    }
    Ok(())
}
