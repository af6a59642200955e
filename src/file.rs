//! Writing text files: whole or not at all. Their checksums.

use std::fs::OpenOptions;
use std::io::{self, ErrorKind, Write};
use std::path::Path;

use sha2::{Digest, Sha256};
use tempfile::NamedTempFile;

/// SHA-256 in hexadecimal digits.
pub fn checksum(bytes: impl AsRef<[u8]>) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Replaces the contents of a file by `text`, all at once: a reader, also after a loss of power, finds the old text or the new
/// text, never a part.
///
/// Files that may not be written stay as they are; a device or a pipe is written to, not replaced.
pub fn save(path: &Path, text: &str) -> io::Result<()> {
    // A link stays a link: the file it points to is replaced.
    let path = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
    replace(&path, text).map_err(|error| named(&path, &error))
}

fn replace(path: &Path, text: &str) -> io::Result<()> {
    let old = path.metadata().ok();
    if old.as_ref().is_some_and(|old| !old.is_file()) {
        return OpenOptions::new().write(true).open(path)?.write_all(text.as_bytes());
    }
    if old.as_ref().is_some_and(|old| old.permissions().readonly()) {
        return Err(ErrorKind::ReadOnlyFilesystem.into());
    }
    let new = write_temporary(path, text)?;
    if let Some(old) = old {
        new.as_file().set_permissions(old.permissions())?;
    }
    new.persist(path)?;
    Ok(())
}

/// Writes a new file whole, never over one that is there.
pub fn create(path: &Path, text: &str) -> io::Result<()> {
    let created = write_temporary(path, text).and_then(|new| Ok(new.persist_noclobber(path).map(drop)?));
    created.map_err(|error| named(path, &error))
}

/// A name ending in `ending` that no file has: the stem, or the stem with a number.
pub fn unused_path(stem: &str, ending: &str) -> String {
    let numbered = (2..100).map(|n| format!("{stem}-{n}.{ending}"));
    let mut names = std::iter::once(format!("{stem}.{ending}")).chain(numbered);
    names.find(|name| !Path::new(name).exists()).unwrap_or_default()
}

/// The text in a file without a name of its own yet, in the folder of `path`.
fn write_temporary(path: &Path, text: &str) -> io::Result<NamedTempFile> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut new = builder.tempfile_in(folder)?;
    new.write_all(text.as_bytes())?;
    new.as_file().sync_all()?;
    Ok(new)
}

/// An error with the name of the file and what it means for it.
fn named(path: &Path, error: &io::Error) -> io::Error {
    let words = match error.kind() {
        ErrorKind::NotFound => "there is no such folder".to_owned(),
        ErrorKind::AlreadyExists => "it is there already and is not overwritten".to_owned(),
        ErrorKind::ReadOnlyFilesystem => "it may only be read".to_owned(),
        ErrorKind::PermissionDenied => "it may not be written".to_owned(),
        ErrorKind::StorageFull => "the disk is full".to_owned(),
        kind => kind.to_string(),
    };
    io::Error::new(error.kind(), format!("{}: {words}", path.display()))
}
