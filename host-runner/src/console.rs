//! Data to standard output, words to standard error.

use std::fmt::Display;
use std::io::{self, BufWriter, Write};

use crate::failure::Failure;

/// Says a line on standard error. That nobody listens is no reason to stop.
pub fn say(words: impl Display) {
    let _ = writeln!(io::stderr(), "{words}");
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
