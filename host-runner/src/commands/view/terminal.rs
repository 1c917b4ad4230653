//! The terminal: as it was before, once this is over.

use std::io::{self, IsTerminal, Write};

use crossterm::cursor::{Hide, MoveTo, Show};
use crossterm::terminal::{
    BeginSynchronizedUpdate, Clear, ClearType, EndSynchronizedUpdate, EnterAlternateScreen,
    LeaveAlternateScreen, disable_raw_mode, enable_raw_mode,
};
use crossterm::{execute, queue};

use super::cells::Style;

/// What is known of standard output.
#[derive(Clone, Copy, Debug)]
pub(super) struct Output {
    pub(super) is_terminal: bool,
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
        let has_colors = variable("NO_COLOR").is_none_or(|value| value.is_empty());
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
            style: if is_terminal && has_colors && !is_dumb {
                Style::Blocks
            } else {
                Style::Letters
            },
            columns,
            lines,
        }
    }
}

/// The whole terminal, to be written on anew. When this is dropped the terminal is as it was before.
#[derive(Debug)]
pub(super) struct FullScreen(());

impl FullScreen {
    /// # Errors
    ///
    /// Those of the terminal.
    pub(super) fn enter() -> io::Result<Self> {
        enable_raw_mode()?;
        // From here on it is left again, whatever happens.
        let screen = Self(());
        execute!(io::stdout(), EnterAlternateScreen, Hide)?;
        Ok(screen)
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
        // There is nobody left to tell.
        let _ = execute!(io::stdout(), Show, LeaveAlternateScreen);
        let _ = disable_raw_mode();
    }
}
