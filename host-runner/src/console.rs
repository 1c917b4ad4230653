//! Data to standard output, words to standard error.

use std::ffi::OsStr;
use std::fmt::Display;
use std::io::{self, BufWriter, Write};

use crate::failure::Failure;

/// Says a line on standard error. That nobody listens is no reason to stop.
pub fn say(words: impl Display) {
    let _ = writeln!(io::stderr(), "{words}");
}

/// A path or a piece of a user's text as messages and comments show it: on one line, without anything that a terminal would
/// obey or that a reader would not see.
pub fn shown(text: impl AsRef<OsStr>) -> String {
    let mut shown = String::new();
    for character in text.as_ref().to_string_lossy().chars() {
        if is_invisible(character) {
            shown.extend(character.escape_default());
        } else {
            shown.push(character);
        }
    }
    shown
}

/// Controls, and marks of direction, of joining and of byte order, which may change how the rest is shown.
pub(crate) fn is_invisible(character: char) -> bool {
    character.is_control()
        || matches!(
            character,
            '\u{ad}' | '\u{61c}' | '\u{feff}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}'
        )
}

/// Writes data to standard output.
///
/// # Errors
///
/// [`Failure::ClosedPipe`] and [`Failure::Files`].
pub fn print(write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), Failure> {
    let mut stdout = BufWriter::new(io::stdout().lock());
    write(&mut stdout)
        .and_then(|()| stdout.flush())
        .map_err(|error| Failure::stdout(&error))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_that_a_terminal_obeys_is_shown() {
        assert_eq!(shown("pictures/été 1.png"), "pictures/été 1.png");
        assert_eq!(
            shown("a\nb\t\u{1b}[31m\u{7f}"),
            "a\\nb\\t\\u{1b}[31m\\u{7f}"
        );
        assert_eq!(shown("\u{9b}2J\u{202e}txt"), "\\u{9b}2J\\u{202e}txt");
    }
}
