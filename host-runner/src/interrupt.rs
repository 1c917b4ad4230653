//! Ctrl-C and `kill`: what is tidied up and told before the program ends.
//!
//! A signal that was ignored when the program began stays ignored, as `nohup` and scripts in the background expect.

use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
#[cfg(unix)]
use std::time::Duration;

/// What a signal meets.
#[derive(Debug)]
struct State {
    /// Whether there is a thread that waits for signals.
    is_listening: bool,
    /// Whether the program ends by itself, when it has asked for the signal.
    ends_by_itself: bool,
    /// The signal that came, if the program ends by itself.
    signal: Option<u8>,
    /// What makes the terminal usable again, should the program not end by itself in time.
    restore: Option<fn()>,
    /// Files to be removed.
    unfinished: Vec<PathBuf>,
    /// What is said.
    advice: Option<String>,
    /// What is said once the file under way is finished.
    advice_when_finished: Option<String>,
}

static STATE: Mutex<State> = Mutex::new(State {
    is_listening: false,
    ends_by_itself: false,
    signal: None,
    restore: None,
    unfinished: Vec::new(),
    advice: None,
    advice_when_finished: None,
});

fn state() -> MutexGuard<'static, State> {
    let mut state = STATE.lock().unwrap_or_else(PoisonError::into_inner);
    if !state.is_listening {
        state.is_listening = true;
        listen();
    }
    state
}

/// Has a file removed when the program is interrupted.
pub(crate) fn remove_unfinished(path: &Path) {
    state().unfinished.push(path.to_owned());
}

/// Gives a file its place by `rename`, after which it is no longer removed and the other advice holds. No signal comes between.
pub(crate) fn finish<E>(path: &Path, rename: impl FnOnce() -> Result<(), E>) -> Result<(), E> {
    let mut state = state();
    rename()?;
    state.unfinished.retain(|unfinished| unfinished != path);
    if let Some(words) = state.advice_when_finished.take() {
        state.advice = Some(words);
    }
    Ok(())
}

/// No longer has a file removed.
pub(crate) fn keep_finished(path: &Path) {
    state().unfinished.retain(|unfinished| unfinished != path);
}

/// What is said when the program is interrupted: how to go on, and how once the next file is finished.
pub(crate) fn advise(words: Option<String>, when_finished: Option<String>) {
    let mut state = state();
    state.advice = words;
    state.advice_when_finished = when_finished;
}

/// The exit code of an interrupted program, 128 and the number of the signal, once it is interrupted. From the first
/// call on it does not end by itself.
pub(crate) fn exit_code() -> Option<u8> {
    let mut state = state();
    state.ends_by_itself = true;
    state.signal.map(|signal| 128 + signal)
}

/// Has the terminal restored when the program is interrupted and does not end by itself in time.
pub(crate) fn restore_by(restore: Option<fn()>) {
    state().restore = restore;
}

/// A program that ends by itself has so much time for it: it may wait for a terminal that is gone, for ever.
#[cfg(unix)]
const GRACE: Duration = Duration::from_millis(700);

/// Tells the program that it is to end, and ends it if it does not.
#[cfg(unix)]
fn end_soon(mut state: MutexGuard<'_, State>, signal: i32) -> ! {
    let number = u8::try_from(signal).unwrap_or_default();
    state.signal = Some(number);
    drop(state);
    std::thread::sleep(GRACE);
    if let Some(restore) = self::state().restore {
        // A terminal that is stopped or gone must not hold up the end.
        let restoring = std::thread::spawn(restore);
        let steps = 20;
        for _ in 0..steps {
            if restoring.is_finished() {
                break;
            }
            std::thread::sleep(GRACE / steps);
        }
    }
    std::process::exit(128 + i32::from(number));
}

/// Ends the program as SIGHUP does when its terminal is gone, also where that signal is ignored or goes to others.
#[cfg(unix)]
pub(crate) fn end_on_hang_up() {
    use rustix::event::{PollFd, PollFlags, poll};
    use std::fs::File;
    use std::io::IsTerminal;
    use std::os::fd::AsFd;
    // What keys are read from.
    let stdin = std::io::stdin();
    let terminal = if stdin.is_terminal() {
        stdin.as_fd().try_clone_to_owned()
    } else {
        File::open("/dev/tty").map(Into::into)
    };
    let Ok(terminal) = terminal else { return };
    std::thread::spawn(move || {
        loop {
            let mut fds = [PollFd::new(&terminal, PollFlags::empty())];
            match poll(&mut fds, None) {
                Ok(_) if fds[0].revents().contains(PollFlags::HUP) => break,
                Err(rustix::io::Errno::INTR) => {}
                // Here nothing can be known.
                _ => return,
            }
        }
        end_soon(state(), signal_hook::consts::SIGHUP)
    });
}

/// Elsewhere the window of a terminal ends its programs.
#[cfg(not(unix))]
pub(crate) fn end_on_hang_up() {}

#[cfg(unix)]
fn listen() {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;
    let heeded = [SIGINT, SIGTERM, SIGHUP].into_iter();
    // Where there can be no handler, the program ends as programs do.
    let Ok(mut signals) = Signals::new(heeded.filter(|signal| !is_ignored(*signal))) else {
        return;
    };
    std::thread::spawn(move || {
        for signal in signals.forever() {
            // Held until the end, so that no other file is begun.
            let state = state();
            if state.ends_by_itself {
                end_soon(state, signal);
            }
            for path in &state.unfinished {
                let _ = std::fs::remove_file(path);
            }
            if let Some(advice) = &state.advice {
                // Below the bar of the progress.
                crate::console::say(format_args!("\n{advice}"));
            }
            let _ = signal_hook::low_level::emulate_default_handler(signal);
        }
    });
}

/// Elsewhere the program ends as programs do.
#[cfg(not(unix))]
fn listen() {}

/// Whether the program was started with the signal ignored; known on Linux alone.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status
        .lines()
        .find_map(|line| line.strip_prefix("SigIgn:"))
        .and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
}
