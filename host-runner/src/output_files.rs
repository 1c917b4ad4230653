//! Where pictures and texts go: files that appear whole or not at all, devices and pipes, standard output.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::console::shown;
use crate::failure::Failure;
use crate::interrupt;

/// A place for a picture, known to be writable as far as that can be known before.
#[derive(Clone, Debug)]
pub enum Place {
    /// Standard output.
    Stdout,
    /// A file that is or will be an ordinary one: written beside its place, then renamed.
    File {
        /// As the user calls it.
        name: PathBuf,
        /// What is replaced: `name`, or what `name` links to.
        target: PathBuf,
    },
    /// A device or a named pipe: written as it is.
    Device(PathBuf),
}

impl Place {
    /// Makes sure that the file can be written, before any work is done for it.
    ///
    /// # Errors
    ///
    /// [`Failure::Files`].
    pub fn file(name: &Path) -> Result<Self, Failure> {
        let cannot = |why: &dyn std::fmt::Display| Failure::file("write", name, why);
        let target = match fs::metadata(name) {
            Ok(old) if old.is_dir() => {
                return Err(cannot(&"it is a folder; name a file in it"));
            }
            Ok(old) if !old.is_file() => return Ok(Self::Device(name.to_owned())),
            Ok(old) if old.permissions().readonly() => {
                return Err(cannot(&"it is there already and is read-only"));
            }
            Ok(_) => fs::canonicalize(name).map_err(|error| cannot(&error))?,
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                let folder = folder_of(name);
                if !folder.is_dir() {
                    let folder = shown(folder);
                    return Err(cannot(&format_args!("there is no folder {folder}")));
                }
                // A link to a file that is not there yet stays a link.
                match fs::read_link(name) {
                    Ok(target) => folder.join(target),
                    Err(_) => name.to_owned(),
                }
            }
            Err(error) => return Err(cannot(&error)),
        };
        let name = name.to_owned();
        // The trial is removed at once.
        drop(PartFile::create(&name, &target)?);
        Ok(Self::File { name, target })
    }

    /// Its name in messages.
    pub fn name(&self) -> String {
        shown(self.data_name())
    }

    /// Its name in data for programs.
    pub fn data_name(&self) -> String {
        match self {
            Self::Stdout => "<stdout>".to_owned(),
            Self::File { name, .. } | Self::Device(name) => name.to_string_lossy().into_owned(),
        }
    }

    /// Writes the picture; returns the number of bytes. After an error an ordinary file is as it was.
    ///
    /// # Errors
    ///
    /// [`Failure::Files`] and [`Failure::ClosedPipe`].
    pub fn write(
        &self,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<u64, Failure> {
        self.write_made(|out| Ok(write(out)?))
    }

    /// The same for what is made while it is written, which may fail for other reasons.
    ///
    /// # Errors
    ///
    /// [`Failure::Files`], [`Failure::ClosedPipe`] and those of the making.
    pub fn write_made(
        &self,
        write: impl FnOnce(&mut dyn Write) -> Result<(), Unwritten>,
    ) -> Result<u64, Failure> {
        match self {
            Self::Stdout => write_all(io::stdout().lock(), write),
            Self::Device(name) => OpenOptions::new()
                .write(true)
                .open(name)
                .map_err(Unwritten::File)
                .and_then(|device| write_all(device, write)),
            Self::File { name, target } => {
                let mut part = PartFile::create(name, target)?;
                write_all(&mut part.file, write).and_then(|bytes| {
                    part.rename_to(target)?;
                    Ok(bytes)
                })
            }
        }
        .map_err(|unwritten| unwritten.of(self))
    }
}

/// Why something was not written.
#[derive(Debug)]
pub enum Unwritten {
    /// Its file did not take it.
    File(io::Error),
    /// It was not there.
    Unmade(Failure),
}

impl Unwritten {
    /// The end of a command that writes to a place.
    pub fn of(self, place: &Place) -> Failure {
        match (self, place) {
            (Self::Unmade(failure), _) => failure,
            (Self::File(error), Place::Stdout) => Failure::stdout(&error),
            (Self::File(error), Place::File { name, .. } | Place::Device(name)) => {
                Failure::file("write", name, error)
            }
        }
    }
}

impl From<io::Error> for Unwritten {
    fn from(error: io::Error) -> Self {
        Self::File(error)
    }
}

impl<E: Into<Failure>> From<E> for Unwritten {
    fn from(failure: E) -> Self {
        Self::Unmade(failure.into())
    }
}

/// The folder that a file is in.
fn folder_of(file: &Path) -> &Path {
    match file.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// Writes through a buffer; returns the number of bytes.
fn write_all(
    file: impl Write,
    write: impl FnOnce(&mut dyn Write) -> Result<(), Unwritten>,
) -> Result<u64, Unwritten> {
    let mut counted = Counted {
        file: BufWriter::with_capacity(1 << 16, file),
        bytes: 0,
    };
    write(&mut counted)?;
    counted.flush()?;
    Ok(counted.bytes)
}

/// A file and the number of bytes written to it.
struct Counted<W: Write> {
    file: BufWriter<W>,
    bytes: u64,
}

impl<W: Write> Write for Counted<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.file.write(bytes)?;
        self.bytes += written as u64;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// A new file beside the place of another, which it either replaces whole or leaves alone.
///
/// Invariant: unless it was renamed, the file is removed when this is dropped.
struct PartFile {
    file: File,
    /// `None` once it is renamed.
    path: Option<PathBuf>,
}

impl PartFile {
    fn create(name: &Path, target: &Path) -> Result<Self, Failure> {
        let folder = folder_of(target);
        let process = std::process::id();
        let mut attempt = 0;
        loop {
            let path = folder.join(format!("scanray-{process}-{attempt}.part"));
            interrupt::remove_unfinished(&path);
            let file = File::create_new(&path);
            if file.is_err() {
                interrupt::keep_finished(&path);
            }
            match file {
                Ok(file) => {
                    let path = Some(path);
                    return Ok(Self { file, path });
                }
                // Left behind by a process of the same number that was killed.
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists && attempt < 1000 => {
                    attempt += 1;
                }
                Err(error) => return Err(Failure::file("write", name, error)),
            }
        }
    }

    /// Takes the target's place, and its owner and permissions if there is an older one.
    fn rename_to(mut self, target: &Path) -> io::Result<()> {
        if let Ok(old) = fs::metadata(target) {
            keep_owner(&self.file, &old);
            self.file.set_permissions(old.permissions())?;
        }
        // Some file systems say only now that they are full.
        self.file.sync_all()?;
        if let Some(path) = &self.path {
            interrupt::finish(path, || fs::rename(path, target))?;
        }
        self.path = None;
        Ok(())
    }
}

/// Gives a file the owner and the group of an older one, as far as this user may.
#[cfg(unix)]
fn keep_owner(file: &File, old: &fs::Metadata) {
    use std::os::unix::fs::{MetadataExt, fchown};
    // One by one: a user may give a file to a group of theirs, but to nobody else.
    let _ = fchown(file, None, Some(old.gid()));
    let _ = fchown(file, Some(old.uid()), None);
}

/// Elsewhere a file belongs to its folder's owner.
#[cfg(not(unix))]
fn keep_owner(_: &File, _: &fs::Metadata) {}

impl Drop for PartFile {
    fn drop(&mut self) {
        if let Some(path) = &self.path {
            let _ = fs::remove_file(path);
            interrupt::keep_finished(path);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        let mut names: Vec<_> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn a_failed_write_leaves_the_older_file_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.ppm");
        fs::write(&path, "old").unwrap();
        let place = Place::file(&path).unwrap();
        assert_eq!(names(folder.path()), ["a.ppm"]);
        let result = place.write(|file| {
            file.write_all(&[0; 100_000])?;
            Err(io::ErrorKind::StorageFull.into())
        });
        assert!(matches!(result, Err(Failure::Files(words)) if words.contains("a.ppm")));
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(names(folder.path()), ["a.ppm"]);
        let bytes = place.write(|file| file.write_all(b"newer")).unwrap();
        assert_eq!(bytes, 5);
        assert_eq!(fs::read(&path).unwrap(), b"newer");
        assert_eq!(names(folder.path()), ["a.ppm"]);
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_a_link_and_permissions_stay() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("a.ppm"), folder.path().join("b.ppm"));
        fs::write(&file, "old").unwrap();
        fs::set_permissions(&file, fs::Permissions::from_mode(0o640)).unwrap();
        symlink("a.ppm", &link).unwrap();
        let place = Place::file(&link).unwrap();
        place.write(|file| file.write_all(b"new")).unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read(&file).unwrap(), b"new");
        let mode = fs::metadata(&file).unwrap().permissions().mode();
        assert_eq!(mode & 0o777, 0o640);
    }

    #[test]
    fn what_is_left_of_a_killed_process_is_no_obstacle() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.ppm");
        let process = std::process::id();
        let left = folder.path().join(format!("scanray-{process}-0.part"));
        fs::write(&left, "").unwrap();
        let place = Place::file(&path).unwrap();
        place.write(|file| file.write_all(b"new")).unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
    }
}
