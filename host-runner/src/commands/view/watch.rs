//! Notices that a file was saved.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant, SystemTime};

use notify::{RecommendedWatcher, RecursiveMode, Watcher};

/// How long an editor may take to write a file before it is read.
const SETTLING: Duration = Duration::from_millis(40);

/// How often the file itself is looked at, because not every file system tells of changes.
const LOOK_EVERY: Duration = Duration::from_millis(500);

/// A file under watch.
///
/// Its folders are watched, not the file: editors write a new file and rename it.
#[derive(Debug)]
pub(super) struct Watch {
    path: PathBuf,
    /// Keeps watching while it lives; none where the system offers no way.
    _watcher: Option<RecommendedWatcher>,
    events: Receiver<()>,
    stamp: Option<Stamp>,
    looked: Instant,
    /// When something happened in a folder that was not looked into yet.
    happened: Option<Instant>,
}

/// What changes when a file does.
type Stamp = (SystemTime, u64);

impl Watch {
    /// Begins to watch.
    pub(super) fn new(path: &Path) -> Self {
        let (sender, events) = channel();
        let watcher = notify::recommended_watcher(move |_| {
            // Nobody listens at the end.
            let _ = sender.send(());
        });
        let watcher = watcher.ok().and_then(|mut watcher| {
            // The folder of the name, and that of the file that a link leads to.
            let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
            let folders = [path, &target].map(|path| match path.parent() {
                Some(folder) if !folder.as_os_str().is_empty() => folder,
                _ => Path::new("."),
            });
            for folder in folders {
                watcher.watch(folder, RecursiveMode::NonRecursive).ok()?;
            }
            Some(watcher)
        });
        Self {
            path: path.to_owned(),
            _watcher: watcher,
            events,
            stamp: stamp(path),
            looked: Instant::now(),
            happened: None,
        }
    }

    /// Whether the file may have changed since it was last asked.
    pub(super) fn may_have_changed(&mut self) -> bool {
        if self.events.try_iter().count() > 0 {
            self.happened.get_or_insert_with(Instant::now);
        }
        if self.happened.is_some_and(|then| then.elapsed() > SETTLING) {
            self.happened = None;
            self.stamp = stamp(&self.path);
            return true;
        }
        if self.looked.elapsed() > LOOK_EVERY {
            self.looked = Instant::now();
            let before = self.stamp;
            self.stamp = stamp(&self.path);
            return self.stamp != before;
        }
        false
    }
}

fn stamp(path: &Path) -> Option<Stamp> {
    let metadata = fs::metadata(path).ok()?;
    Some((metadata.modified().ok()?, metadata.len()))
}
