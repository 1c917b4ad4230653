//! PPM, the binary variant P6; what is read may also be in decimal (P3) or grey (PGM: P5, P2).

use std::io::{self, Write};

use super::{Image, SMALLER};
use crate::picture_memory::room;

pub(super) fn write(
    file: &mut dyn Write,
    width: u16,
    height: u16,
    comment: Option<&str>,
    rows: &mut dyn Iterator<Item = Vec<u8>>,
) -> io::Result<()> {
    writeln!(file, "P6")?;
    if let Some(comment) = comment {
        // Where GIMP puts its own, so that all readers know it there.
        writeln!(file, "# {comment}")?;
    }
    write!(file, "{width} {height}\n255\n")?;
    for row in rows {
        file.write_all(&row)?;
    }
    Ok(())
}

/// The comment below the first line.
pub(super) fn comment(bytes: &[u8]) -> Option<String> {
    let behind = bytes.strip_prefix(b"P6\n# ")?;
    let line = behind.split(|byte| *byte == b'\n').next()?;
    String::from_utf8(line.to_owned()).ok()
}

/// Reads a PPM or PGM file after netpbm's specification; of several pictures in a file, the first.
///
/// Samples of another maximum than 255 are rounded to the nearest of 256 levels.
///
/// # Errors
///
/// A sentence.
pub(super) fn read(bytes: &[u8]) -> Result<Image, String> {
    let (is_binary, channels) = match bytes {
        [b'P', b'2', ..] => (false, 1),
        [b'P', b'3', ..] => (false, 3),
        [b'P', b'5', ..] => (true, 1),
        _ => (true, 3),
    };
    let mut rest = &bytes[2..];
    let mut header = |name: &str, most: usize| {
        next_number(&mut rest)
            .filter(|number| (1..=most).contains(number))
            .ok_or_else(|| format!("the PPM's {name} is not a number from 1 to {most}"))
    };
    let width = header("width", usize::from(u16::MAX))?;
    let height = header("height", usize::from(u16::MAX))?;
    let maximum = header("largest value", usize::from(u16::MAX))?;
    let count = width * height * channels;
    let too_short = || format!("the file ends before the {width}x{height} pixels it announces");
    let level = |sample: usize| {
        (sample <= maximum)
            .then(|| ((sample * 255 + maximum / 2) / maximum) as u8)
            .ok_or_else(|| format!("the PPM has the value {sample}, but its largest is {maximum}"))
    };
    let samples: Vec<u8> = if is_binary {
        let wide = 1 + usize::from(maximum > 255);
        let samples = raster(rest, count * wide).ok_or_else(too_short)?;
        let value = |sample: &[u8]| {
            sample
                .iter()
                .fold(0, |value, byte| value << 8 | usize::from(*byte))
        };
        let mut levels = room(count, "the picture", SMALLER)?;
        for sample in samples.chunks_exact(wide) {
            levels.push(level(value(sample))?);
        }
        levels
    } else {
        // A sample takes two bytes at least, which bounds what is allocated for a wrong header.
        let mut samples = Vec::with_capacity(count.min(rest.len() / 2 + 1));
        for _ in 0..count {
            samples.push(level(next_number(&mut rest).ok_or_else(too_short)?)?);
        }
        samples
    };
    let rgb888 = match channels {
        1 => samples.iter().flat_map(|gray| [*gray; 3]).collect(),
        _ => samples,
    };
    Ok(Image {
        width,
        height,
        rgb888,
    })
}

/// From the end of a line on.
fn behind_comment(text: &[u8]) -> &[u8] {
    let end = text.iter().position(|byte| matches!(byte, b'\n' | b'\r'));
    &text[end.unwrap_or(text.len())..]
}

/// The bytes of the samples behind the header's last number: one blank stands between them, and the samples may themselves
/// look like blanks. A comment right behind the number belongs to the header. The line's end that ends it is the blank, as
/// netpbm reads it; where the file has a byte more than that, it is the blank behind it, as netpbm's specification has it.
fn raster(mut rest: &[u8], length: usize) -> Option<&[u8]> {
    if rest.first() == Some(&b'#') {
        rest = behind_comment(rest);
        if rest.len() == length + 2 && rest[1].is_ascii_whitespace() {
            rest = &rest[1..];
        }
    }
    rest.get(1..)?.get(..length)
}

/// Takes blanks, comments and a decimal number; `None` if there is none.
fn next_number(rest: &mut &[u8]) -> Option<usize> {
    loop {
        *rest = rest.trim_ascii_start();
        if rest.first() != Some(&b'#') {
            break;
        }
        *rest = behind_comment(rest);
    }
    let length = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
    let (digits, behind) = rest.split_at(length);
    *rest = behind;
    std::str::from_utf8(digits).ok()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_variants_become_rgb888() {
        let colors = [10, 32, 35, 4, 5, 6];
        for file in [
            // The first samples are a line feed, a blank and the sign of a comment.
            &b"P6\n2 1\n255\n\n #\x04\x05\x06"[..],
            b"P6 # two\n#\n2\t# wide\r\n1\n255 \n #\x04\x05\x06",
            b"P6 2 1 255\n\n #\x04\x05\x06P6 2 1 255\n second",
            b"P6 2 1 65535\n\x0a\x0a\x20\x20\x23\x23\x04\x04\x05\x05\x06\x06",
            // A comment right behind the last number, as netpbm reads it and as its specification has it.
            b"P6 2 1 255# one\n\n #\x04\x05\x06",
            b"P6 2 1 255# one\n\n\n #\x04\x05\x06",
            b"P6 2 1# two\r255#\r\n #\x04\x05\x06",
            b"P3\n2 1 255\n10 32 35 # one\n4 5 6\n",
            b"P3 2 1 51 2 6 7 1 1 1",
        ] {
            let image = read(file).unwrap();
            assert_eq!((image.width, image.height), (2, 1));
            match file.ends_with(b"7 1 1 1") {
                true => assert_eq!(image.rgb888, [10, 30, 35, 5, 5, 5]),
                false => assert_eq!(image.rgb888, colors, "{file:?}"),
            }
        }
        for file in [&b"P5 2 1 255\n\x09\xc8"[..], b"P2 2 1 255 9 200"] {
            assert_eq!(read(file).unwrap().rgb888, [9, 9, 9, 200, 200, 200]);
        }
    }

    #[test]
    fn wrong_files_are_refused() {
        for (file, words) in [
            (&b"P6"[..], "width"),
            (b"P6 0 1 255\n", "width"),
            (b"P6 65536 1 255\n", "width"),
            (b"P6 1 99999999999999999999 255\n", "height"),
            (b"P6 1 -1 255\n", "height"),
            (b"P6 1 1 65536\n", "largest value"),
            (b"P6 1 1 255\n\x01\x02", "ends before the 1x1 pixels"),
            (b"P6 1 1 255", "ends before the 1x1 pixels"),
            (b"P6 1 1 9\n\x01\x02\x0a", "the value 10"),
            (
                b"P3 65535 65535 255 1 2",
                "ends before the 65535x65535 pixels",
            ),
            (b"P3 1 1 255 1 2 x", "ends before the 1x1 pixels"),
        ] {
            let why = read(file).unwrap_err();
            assert!(why.contains(words), "{why}");
        }
    }
}
