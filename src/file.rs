//! Reads text files, and writes them whole or not at all. Also checksums and paths of files.

use std::fs::{File, Metadata, OpenOptions};
use std::io::{self, ErrorKind, Write};
#[cfg(unix)]
use std::os::unix::fs::{MetadataExt, PermissionsExt, fchown};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use sha2::{Digest, Sha256};
use tempfile::NamedTempFile;

/// SHA-256 in hexadecimal digits.
pub fn checksum(bytes: impl AsRef<[u8]>) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Stamp of a file: time of its last change, and its size [bytes].
pub type Stamp = (SystemTime, u64);

/// Stamp of a file; `None` if there is no such file.
pub fn stamp(path: &Path) -> Option<Stamp> {
    let data = path.metadata().ok().filter(Metadata::is_file)?;
    Some((data.modified().ok()?, data.len()))
}

/// Path of a file from the root, with links followed, as people write it: on Windows without `\\?\` before it.
pub fn canonical(path: &Path) -> io::Result<PathBuf> {
    dunce::canonicalize(path)
}

/// Text of a file: UTF-8 with or without a byte order mark, or little-endian UTF-16 with a byte order mark, as PowerShell writes
/// it.
pub fn read(path: &Path) -> io::Result<String> {
    let bytes = std::fs::read(path).map_err(|error| unreadable(path, error))?;
    let text = match bytes.as_slice() {
        [0xff, 0xfe, units @ ..] => {
            let units = units.chunks_exact(2).map(|unit| u16::from_le_bytes([unit[0], unit[1]]));
            char::decode_utf16(units).collect::<Result<String, _>>().ok()
        }
        [0xef, 0xbb, 0xbf, text @ ..] | text => std::str::from_utf8(text).ok().map(str::to_owned),
    };
    text.ok_or_else(|| io::Error::new(ErrorKind::InvalidData, "it is no text"))
}

/// Error of reading a file, in the same words on every system.
pub fn unreadable(path: &Path, error: io::Error) -> io::Error {
    // Windows says of a folder that it may not be read.
    let kind = if path.is_dir() { ErrorKind::IsADirectory } else { error.kind() };
    let words = match kind {
        ErrorKind::NotFound => "there is no such file",
        ErrorKind::IsADirectory => "it is a folder",
        ErrorKind::PermissionDenied => "it may not be read",
        _ => return error,
    };
    io::Error::new(kind, words)
}

/// Replaces the contents of a file by `text` in one step. A reader finds the old text or the new text, never a part, even after a
/// loss of power.
///
/// A write-protected file stays as it is. A device or a pipe is written to, not replaced.
pub fn save(path: &Path, text: &str) -> io::Result<()> {
    // A link stays a link: the file behind the link is replaced.
    let path = canonical(path).unwrap_or_else(|_| path.to_path_buf());
    replace(&path, text).map_err(|error| named(&path, &error))
}

fn replace(path: &Path, text: &str) -> io::Result<()> {
    let old = path.metadata().ok();
    if old.as_ref().is_some_and(|old| !old.is_file()) {
        return write_to_device(path, text);
    }
    if old.as_ref().is_some_and(|old| old.permissions().readonly()) {
        return Err(ErrorKind::ReadOnlyFilesystem.into());
    }
    if old.is_some() {
        // Who may not write a file may not replace it either, even if the folder permits that.
        OpenOptions::new().write(true).open(path)?;
    }
    write_temporary(path, text, old.as_ref())?.persist(path)?;
    Ok(())
}

/// Writes to a device or a pipe. A pipe that nobody reads from is an error.
fn write_to_device(path: &Path, text: &str) -> io::Result<()> {
    let mut device = open_device(path)?;
    let mut left = text.as_bytes();
    while !left.is_empty() {
        match device.write(left) {
            Ok(0) => return Err(ErrorKind::WriteZero.into()),
            Ok(count) => left = &left[count..],
            // The reader of the pipe is slow.
            Err(error) if error.kind() == ErrorKind::WouldBlock => std::thread::sleep(PIPE_PAUSE),
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
    Ok(())
}

/// Pause between two looks at a pipe, and number of looks for a reader.
const PIPE_PAUSE: Duration = Duration::from_millis(20);
#[cfg(unix)]
const PIPE_LOOKS: usize = 100;

#[cfg(unix)]
fn open_device(path: &Path) -> io::Result<File> {
    use std::os::unix::fs::OpenOptionsExt;
    for _ in 0..PIPE_LOOKS {
        match OpenOptions::new().write(true).custom_flags(libc::O_NONBLOCK).open(path) {
            Err(error) if error.raw_os_error() == Some(libc::ENXIO) => std::thread::sleep(PIPE_PAUSE),
            opened => return opened,
        }
    }
    Err(ErrorKind::NotConnected.into())
}

#[cfg(not(unix))]
fn open_device(path: &Path) -> io::Result<File> {
    OpenOptions::new().write(true).open(path)
}

/// Writes a new file whole, never over an existing file.
pub fn create(path: &Path, text: &str) -> io::Result<()> {
    let created =
        write_temporary(path, text, None).and_then(|new| Ok(new.persist_noclobber(path).map(drop)?));
    created.map_err(|error| named(path, &error))
}

/// Name with the ending `ending` that no file has: the stem, or the stem with a number up to 99. Empty if all these names exist.
pub fn unused_path(stem: &str, ending: &str) -> String {
    let numbered = (2..100).map(|n| format!("{stem}-{n}.{ending}"));
    let mut names = std::iter::once(format!("{stem}.{ending}")).chain(numbered);
    names.find(|name| !Path::new(name).exists()).unwrap_or_default()
}

/// Temporary file with the text, in the folder of `path`. It has the owner and the rights of the old file, if there is one.
fn write_temporary(path: &Path, text: &str, old: Option<&Metadata>) -> io::Result<NamedTempFile> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    #[cfg_attr(not(unix), expect(unused_mut))]
    let mut builder = tempfile::Builder::new();
    // The old file may be secret. So nobody else may read the new file before it has the rights of the old file.
    #[cfg(unix)]
    builder.permissions(PermissionsExt::from_mode(if old.is_some() { 0o600 } else { 0o666 }));
    let mut new = builder.tempfile_in(folder)?;
    if let Some(old) = old {
        keep_owner(new.as_file(), old)?;
        new.as_file().set_permissions(old.permissions())?;
    }
    new.write_all(text.as_bytes())?;
    new.as_file().sync_all()?;
    Ok(new)
}

/// Gives a new file the owner and the group of the old one.
#[cfg(unix)]
fn keep_owner(new: &File, old: &Metadata) -> io::Result<()> {
    let now = new.metadata()?;
    if (now.uid(), now.gid()) == (old.uid(), old.gid()) {
        return Ok(());
    }
    fchown(new, Some(old.uid()), Some(old.gid())).map_err(|_| ErrorKind::Unsupported.into())
}

#[cfg(not(unix))]
fn keep_owner(_: &File, _: &Metadata) -> io::Result<()> {
    Ok(())
}

/// Error with the name of the file, and what the error means for it. The error has no kind: a broken pipe here is not standard
/// output, whose reader may go.
fn named(path: &Path, error: &io::Error) -> io::Error {
    let words = match error.kind() {
        ErrorKind::NotFound => "there is no such folder".to_owned(),
        ErrorKind::AlreadyExists => "it is there already and is not overwritten".to_owned(),
        ErrorKind::ReadOnlyFilesystem => "it may only be read".to_owned(),
        ErrorKind::PermissionDenied => "it may not be written".to_owned(),
        ErrorKind::Unsupported => {
            "it belongs to somebody else, and would not after a save; give another name".to_owned()
        }
        ErrorKind::NotConnected => "nobody reads from it".to_owned(),
        ErrorKind::StorageFull => "the disk is full".to_owned(),
        kind => kind.to_string(),
    };
    io::Error::other(format!("{}: {words}", path.display()))
}
