//! Writing text files: whole or not at all.

use std::io::{self, ErrorKind, Write};
use std::path::Path;

use tempfile::NamedTempFile;

/// Replaces a file with `text` whole: whoever reads it, or a loss of power, finds the old text or the new.
///
/// Files that may not be written stay as they are; a device or a pipe is written to, not replaced.
pub fn save(path: &Path, text: &str) -> io::Result<()> {
    // A link stays a link: what it names is replaced.
    let path = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
    let saved = match path.metadata() {
        Ok(old) if !old.is_file() => std::fs::OpenOptions::new()
            .write(true)
            .open(&path)
            .and_then(|mut file| file.write_all(text.as_bytes())),
        Ok(old) if old.permissions().readonly() => Err(ErrorKind::ReadOnlyFilesystem.into()),
        Ok(old) => beside(&path, text).and_then(|new| {
            new.as_file().set_permissions(old.permissions())?;
            Ok(new.persist(&path).map(drop)?)
        }),
        Err(_) => beside(&path, text).and_then(|new| Ok(new.persist(&path).map(drop)?)),
    };
    saved.map_err(|error| named(&path, &error))
}

/// Writes a new file whole, never over one that is there.
pub fn create(path: &Path, text: &str) -> io::Result<()> {
    let created = beside(path, text).and_then(|new| Ok(new.persist_noclobber(path).map(drop)?));
    created.map_err(|error| named(path, &error))
}

/// The text in a file without a name of its own yet, in the folder of `path`.
fn beside(path: &Path, text: &str) -> io::Result<NamedTempFile> {
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
