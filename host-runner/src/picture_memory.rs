//! Memory for pictures, asked for before the work is done that needs it.

use std::fmt::Display;
use std::io;

use indicatif::DecimalBytes;

use crate::failure::Failure;

/// The machine does not give as much memory as is needed, and what to do about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Shortage(pub(crate) String);

/// Makes sure that something can have so many bytes. `remedy` tells what needs fewer.
///
/// They are reserved in one piece, which takes no time, and given back: so the system refuses what a limit (as by
/// `ulimit -v`) or the machine itself does not allow, and nothing ends halfway.
///
/// # Errors
///
/// [`Shortage`].
pub(crate) fn require(bytes: u64, what: impl Display, remedy: &str) -> Result<(), Shortage> {
    let is_there =
        usize::try_from(bytes).is_ok_and(|bytes| Vec::<u8>::new().try_reserve_exact(bytes).is_ok());
    if is_there {
        return Ok(());
    }
    Err(Shortage(format!(
        "{what} needs {} of memory, more than there is: {remedy}",
        DecimalBytes(bytes)
    )))
}

/// Room for so many values.
///
/// # Errors
///
/// [`Shortage`].
pub(crate) fn room<T>(count: usize, what: impl Display, remedy: &str) -> Result<Vec<T>, Shortage> {
    let mut values = Vec::new();
    if values.try_reserve_exact(count).is_err() {
        let bytes = count as u64 * size_of::<T>() as u64;
        require(bytes, &what, remedy)?;
        // Somebody else has given some back in between.
        if values.try_reserve_exact(count).is_err() {
            return Err(Shortage(format!("{what} finds no memory: {remedy}")));
        }
    }
    Ok(values)
}

impl From<Shortage> for Failure {
    fn from(Shortage(words): Shortage) -> Self {
        Self::Memory(words)
    }
}

impl From<Shortage> for String {
    fn from(Shortage(words): Shortage) -> Self {
        words
    }
}

impl From<Shortage> for io::Error {
    fn from(Shortage(words): Shortage) -> Self {
        Self::new(io::ErrorKind::OutOfMemory, words)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_no_machine_has_is_refused_with_the_remedy() {
        let Shortage(words) = require(u64::MAX / 4, "a picture", "draw a smaller one").unwrap_err();
        assert_eq!(
            words,
            "a picture needs 4.61 EB of memory, more than there is: draw a smaller one"
        );
        assert!(room::<[u8; 1 << 20]>(1 << 42, "a picture", "").is_err());
        assert_eq!(room::<u8>(10, "a picture", ""), Ok(Vec::new()));
    }
}
