//! The terminal: as it was before, once this is over.

use std::io::{self, IsTerminal, Write};

use crossterm::cursor::{Hide, MoveTo, Show};
use crossterm::terminal::{
    BeginSynchronizedUpdate, Clear, ClearType, EndSynchronizedUpdate, EnterAlternateScreen,
    LeaveAlternateScreen, disable_raw_mode, enable_raw_mode,
};
use crossterm::{execute, queue};

use super::cells::{Colors, Style};
use crate::interrupt;

/// What is known of standard output.
#[derive(Clone, Copy, Debug)]
pub(super) struct Output {
    pub(super) is_terminal: bool,
    /// Whether it is a terminal that cannot place the cursor.
    pub(super) is_dumb: bool,
    pub(super) style: Style,
    pub(super) columns: u16,
    pub(super) lines: u16,
}

impl Output {
    /// Looks at standard output. What is no terminal is 80 cells wide and 24 high, or as `COLUMNS` and
    /// `LINES` say.
    pub(super) fn new() -> Self {
        let variable = |name| std::env::var(name).ok();
        let number = |name| variable(name)?.parse().ok().filter(|n: &u16| *n > 0);
        let is_terminal = io::stdout().is_terminal();
        let is_dumb = variable("TERM").is_some_and(|term| term == "dumb");
        let size = if is_terminal {
            crossterm::terminal::size().ok()
        } else {
            None
        };
        let size = size.filter(|(columns, lines)| *columns > 0 && *lines > 0);
        let (columns, lines) = size.unwrap_or_else(|| {
            (
                number("COLUMNS").unwrap_or(80),
                number("LINES").unwrap_or(24),
            )
        });
        Self {
            is_terminal,
            is_dumb,
            style: match colors() {
                Some(colors) if is_terminal && !is_dumb => Style::Blocks(colors),
                _ => Style::Letters,
            },
            columns,
            lines,
        }
    }
}

/// The colours that standard output shows, as far as its environment tells.
fn colors() -> Option<Colors> {
    if std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty()) {
        return None;
    }
    let level = supports_color::on(supports_color::Stream::Stdout)?;
    // No variable says so on Windows, but all its terminals that know escape sequences know these.
    if level.has_16m || cfg!(windows) {
        Some(Colors::All)
    } else {
        level.has_256.then_some(Colors::Palette)
    }
}

/// The whole terminal, to be written on anew. When this is dropped the terminal is as it was before.
#[derive(Debug)]
pub(super) struct FullScreen {
    /// Whether the program was stopped and goes on, since it was last asked.
    #[cfg(unix)]
    continued: std::sync::Arc<std::sync::atomic::AtomicBool>,
}

impl FullScreen {
    /// # Errors
    ///
    /// Those of the terminal.
    pub(super) fn enter() -> io::Result<Self> {
        let screen = Self {
            #[cfg(unix)]
            continued: std::sync::Arc::default(),
        };
        #[cfg(unix)]
        signal_hook::flag::register(
            signal_hook::consts::SIGCONT,
            std::sync::Arc::clone(&screen.continued),
        )?;
        // From here on it is left again, whatever happens.
        interrupt::restore_by(Some(leave));
        interrupt::end_on_hang_up();
        enter()?;
        Ok(screen)
    }

    /// Stops the program and its pipeline as Ctrl-Z does where it is a signal, with the terminal as it was before. When
    /// the program goes on, the screen is this one's again, and empty.
    ///
    /// # Errors
    ///
    /// Those of the terminal.
    #[cfg(unix)]
    pub(super) fn suspend(&self) -> io::Result<()> {
        leave();
        rustix::process::kill_current_process_group(rustix::process::Signal::TSTP)?;
        enter()?;
        self.continued
            .store(false, std::sync::atomic::Ordering::Relaxed);
        Ok(())
    }

    /// Elsewhere nothing is stopped.
    #[cfg(not(unix))]
    pub(super) fn suspend(&self) -> io::Result<()> {
        Ok(())
    }

    /// Whether somebody else had stopped the program and lets it go on: the screen is then this one's again, and empty.
    ///
    /// # Errors
    ///
    /// Those of the terminal.
    pub(super) fn is_taken_back(&self) -> io::Result<bool> {
        #[cfg(unix)]
        if self
            .continued
            .swap(false, std::sync::atomic::Ordering::Relaxed)
        {
            // The shell has set the modes meanwhile.
            disable_raw_mode()?;
            enter()?;
            return Ok(true);
        }
        Ok(false)
    }

    /// Replaces what is shown by these lines, from the top left; there are not more than `height`.
    ///
    /// # Errors
    ///
    /// Those of the terminal.
    pub(super) fn show(&self, lines: &[String], height: u16) -> io::Result<()> {
        let mut frame = Vec::new();
        queue!(frame, BeginSynchronizedUpdate)?;
        for (row, line) in (0..height).zip(lines) {
            // Cleared first: behind a full line the cursor still stands on its last cell.
            queue!(frame, MoveTo(0, row), Clear(ClearType::UntilNewLine))?;
            frame.write_all(line.as_bytes())?;
        }
        if lines.len() < usize::from(height) {
            let below = lines.len() as u16;
            queue!(frame, MoveTo(0, below), Clear(ClearType::FromCursorDown))?;
        }
        queue!(frame, EndSynchronizedUpdate)?;
        let mut stdout = io::stdout().lock();
        stdout.write_all(&frame)?;
        stdout.flush()
    }
}

impl Drop for FullScreen {
    fn drop(&mut self) {
        interrupt::restore_by(None);
        leave();
    }
}

fn enter() -> io::Result<()> {
    enable_raw_mode()?;
    execute!(io::stdout(), EnterAlternateScreen, Hide)
}

fn leave() {
    // There is nobody left to tell. The modes come first: they can be set even where nothing can be written.
    let _ = disable_raw_mode();
    let _ = execute!(io::stdout(), Show, LeaveAlternateScreen);
}
