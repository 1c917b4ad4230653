//! The words of scene text: numbers separated by blanks, comments, ends of lines.
//!
//! nom over bytes; no lexeme fails, so that every error is one of the meaning and names its place.

use nom::IResult;
use nom::Parser;
use nom::branch::alt;
use nom::bytes::complete::{tag, take_while, take_while1};
use nom::combinator::{eof, opt, peek, value};
use nom::sequence::preceded;

/// What is left of the text behind a lexeme, and the lexeme.
type Lexeme<'t, O> = IResult<&'t [u8], O, ()>;

// The carriage return of CRLF is a blank before the end of the line.
fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\r')
}

fn is_word(byte: u8) -> bool {
    !is_blank(byte) && byte != b'\n' && byte != b'#'
}

fn blanks(text: &[u8]) -> Lexeme<'_, &[u8]> {
    take_while(is_blank).parse(text)
}

fn comment(text: &[u8]) -> Lexeme<'_, &[u8]> {
    preceded(tag(&b"#"[..]), take_while(|byte| byte != b'\n')).parse(text)
}

/// Skips the blanks before the next word of the line and returns the word, or `None` at the end of the
/// line's words.
pub(super) fn word(text: &[u8]) -> Lexeme<'_, Option<&[u8]>> {
    preceded(blanks, opt(take_while1(is_word))).parse(text)
}

/// Skips what may follow the last word of a line: blanks, a comment, the end of the line.
pub(super) fn end_of_line(text: &[u8]) -> Lexeme<'_, ()> {
    value(
        (),
        (blanks, opt(comment), alt((tag(&b"\n"[..]), peek(eof)))),
    )
    .parse(text)
}

/// Skips lines without a word.
///
/// A loop, because `many0` and `recognize` slice in a way that keeps a reachable panic in firmware.
pub(super) fn empty_lines(text: &[u8]) -> Lexeme<'_, ()> {
    let mut rest = text;
    while let Ok((next, ())) = end_of_line(rest) {
        // The end of the text is the end of a line again and again.
        if next.len() == rest.len() {
            break;
        }
        rest = next;
    }
    Ok((rest, ()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_end_at_blanks_line_ends_and_comments() {
        let (rest, first) = word(b" \t1.5\t2#x\r\n").unwrap();
        assert_eq!(first, Some(&b"1.5"[..]));
        let (rest, second) = word(rest).unwrap();
        assert_eq!(second, Some(&b"2"[..]));
        let (rest, none) = word(rest).unwrap();
        assert_eq!(none, None);
        assert_eq!(end_of_line(rest), Ok((&b""[..], ())));
    }

    #[test]
    fn empty_lines_stop_at_the_first_word() {
        assert_eq!(empty_lines(b"\n # c\r\n\t\n 7\n"), Ok((&b" 7\n"[..], ())));
        assert_eq!(empty_lines(b"\n \t# end"), Ok((&b""[..], ())));
        assert_eq!(empty_lines(b""), Ok((&b""[..], ())));
    }
}
