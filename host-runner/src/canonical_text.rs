//! Scene text in canonical form: the same numbers, the same comments, one layout.
//!
//! * A record a line, its numbers in groups (a vector, a colour) with two blanks between them.
//! * Numbers are rewritten without a change of their value, however many digits they have, so that every
//!   scalar reads the same bits: `+.50` becomes `0.5`, `1e-3` becomes `0.001`. −0 keeps its sign.
//! * A light of 8 numbers gets its ninth.
//! * Comments stay where they are. Behind records they stand in a column, as far as no other line and not the
//!   first object comes between them. Several empty lines become one; there is none at the ends.

use crate::scene_lines::{HEADER_RECORDS, Line, lines};

/// The canonical form of a text that the parser accepts.
pub(crate) fn canonical(text: &[u8]) -> Vec<u8> {
    let mut out: Vec<u8> = Vec::with_capacity(text.len());
    // Records under way whose comments stand in one column.
    let mut block: Vec<(String, Option<&[u8]>)> = Vec::new();
    let mut record = 0;
    let mut wants_empty_line = false;
    for line in lines(text) {
        if line.is_record() {
            // The objects are far longer than the lines before them.
            if record == HEADER_RECORDS {
                end_block(&mut out, &mut block);
            }
            if block.is_empty() {
                begin_line(&mut out, &mut wants_empty_line);
            }
            block.push((formatted(&line, record), line.comment));
            record += 1;
            continue;
        }
        end_block(&mut out, &mut block);
        match line.comment {
            Some(comment) => {
                begin_line(&mut out, &mut wants_empty_line);
                out.extend(comment);
                out.push(b'\n');
            }
            None => wants_empty_line = true,
        }
    }
    end_block(&mut out, &mut block);
    out
}

/// Writes the empty line that is due, unless it would be the first.
fn begin_line(out: &mut Vec<u8>, wants_empty_line: &mut bool) {
    if std::mem::take(wants_empty_line) && !out.is_empty() {
        out.push(b'\n');
    }
}

/// Writes records with their comments below one another.
fn end_block(out: &mut Vec<u8>, block: &mut Vec<(String, Option<&[u8]>)>) {
    let with_comment = block.iter().filter(|(_, comment)| comment.is_some());
    let width = with_comment
        .map(|(record, _)| record.len())
        .max()
        .unwrap_or(0);
    for (record, comment) in block.drain(..) {
        out.extend(record.as_bytes());
        if let Some(comment) = comment {
            out.resize(out.len() + width - record.len() + 2, b' ');
            out.extend(comment);
        }
        out.push(b'\n');
    }
}

/// How many numbers belong together, group by group; what is left over is a group.
fn groups(record: usize, kind: &[u8]) -> &'static [usize] {
    match (record, kind) {
        (3, _) => &[3, 3, 3],
        (..HEADER_RECORDS, _) => &[],
        (_, b"0" | b"1") => &[1, 3, 1, 3, 3, 3],
        _ => &[1, 3, 3, 3, 4, 3, 3, 3],
    }
}

/// A record in canonical form. `record` counts from 0.
fn formatted(line: &Line<'_>, record: usize) -> String {
    let mut words: Vec<String> = line.words().map(number).collect();
    let is_light = record == 3;
    if is_light && words.len() == 8 {
        words.extend(words.last().cloned());
    }
    let kind = words.first().cloned().unwrap_or_default();
    let mut lengths = groups(record, kind.as_bytes()).iter();
    let mut left = *lengths.next().unwrap_or(&usize::MAX);
    let mut text = String::new();
    for word in words {
        if left == 0 {
            text.push(' ');
            left = *lengths.next().unwrap_or(&usize::MAX);
        }
        if !text.is_empty() {
            text.push(' ');
        }
        text.push_str(&word);
        left -= 1;
    }
    text
}

/// A decimal number in canonical form: the same value, to the last digit.
///
/// Plain where that takes few zeros, else with an exponent and one digit before the point.
fn number(word: &[u8]) -> String {
    let word = String::from_utf8_lossy(word);
    let (sign, unsigned) = match word.strip_prefix('-') {
        Some(unsigned) => ("-", unsigned),
        None => ("", word.strip_prefix('+').unwrap_or(&word)),
    };
    let (mantissa, exponent) = unsigned.split_once(['e', 'E']).unwrap_or((unsigned, "0"));
    // An exponent beyond all measure: the parser has read 0, or a digit with very many others.
    let Ok(exponent) = exponent.parse::<i32>().map(i64::from) else {
        return word.into_owned();
    };
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits = [whole, fraction].concat();
    // 0.DIGITS × 10^point
    let leading = digits.len() - digits.trim_start_matches('0').len();
    let digits = digits.trim_matches('0');
    if digits.is_empty() {
        return format!("{sign}0");
    }
    let point = whole.len() as i64 - leading as i64 + exponent;
    let length = digits.len() as i64;
    match point {
        -4..=0 => format!("{sign}0.{}{digits}", "0".repeat(-point as usize)),
        _ if 0 < point && point < length => {
            let (whole, fraction) = digits.split_at(point as usize);
            format!("{sign}{whole}.{fraction}")
        }
        _ if length <= point && point <= length + 6 => {
            format!("{sign}{digits}{}", "0".repeat((point - length) as usize))
        }
        _ => {
            let (first, rest) = digits.split_at(1);
            let separator = if rest.is_empty() { "" } else { "." };
            format!("{sign}{first}{separator}{rest}e{}", point - 1)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pools::HostScalar;

    #[test]
    fn numbers_keep_their_value() {
        for (word, expected) in [
            ("0", "0"),
            ("-0", "-0"),
            ("+0.00e9", "0"),
            ("-.0", "-0"),
            (".50", "0.5"),
            ("1.", "1"),
            ("+1", "1"),
            ("007", "7"),
            ("50.0", "50"),
            ("800", "800"),
            ("-12.340", "-12.34"),
            ("1e-3", "0.001"),
            ("1e-5", "0.00001"),
            ("1e-6", "1e-6"),
            ("0.000012", "0.000012"),
            ("0.0000012", "1.2e-6"),
            ("12e5", "1200000"),
            ("1e6", "1000000"),
            ("1e7", "1e7"),
            ("123456789", "123456789"),
            ("1.25E+10", "1.25e10"),
            ("1234.5e-2", "12.345"),
            ("0.1e1", "1"),
            ("00012e-7", "1.2e-6"),
            (
                "3.00000000000000000000000000001",
                "3.00000000000000000000000000001",
            ),
            ("1e99999999999999999999", "1e99999999999999999999"),
        ] {
            assert_eq!(number(word.as_bytes()), expected, "{word}");
            assert_eq!(number(expected.as_bytes()), expected, "again: {word}");
            let value = |word: &str| word.parse::<f64>().map(f64::to_bits);
            assert_eq!(value(word), value(expected), "{word}");
        }
    }

    #[test]
    fn layout_and_comments() {
        let text = b"\n\n# head \t\r\n 2 # two\n0 0.0 -0#camera\r\n\n\n\n  # size\n8   6\n1 2 3 1 1 1 .5 .5\n.1\n\
            1#sky\n0 0 0\n0  0 0 3 1 .8 .2 .2 .5 .5 .5 1 1 1 0 50 0 0 #\xff\n\n2 0 0 1 1 0 1 0 1 1 0 0 0 0 \
            1 1 1 1 1 1 1 1 1 0 50 0 0\n#\n\n";
        let expected = b"# head\n2       # two\n0 0 -0  #camera\n\n# size\n8 6\n1 2 3  1 1 1  0.5 0.5 0.5\n0.1\n\
            1  #sky\n0 0 0\n0  0 0 3  1  0.8 0.2 0.2  0.5 0.5 0.5  1 1 1  0 50 0 0  #\xff\n\n\
            2  0 0 1  1 0 1  0 1 1  0 0 0 0  1 1 1  1 1 1  1 1 1  0 50 0 0\n#\n";
        let got = canonical(text);
        let show = |text: &[u8]| String::from_utf8_lossy(text).into_owned();
        assert_eq!(show(&got), show(expected));
        assert_eq!(canonical(&got), got);
    }

    /// A text with its numbers, blanks, comments and ends of lines written otherwise.
    fn disguised(text: &str, random: &mut impl FnMut(u32) -> u32) -> String {
        let mut out = String::new();
        let mut record = 0;
        for line in text.lines() {
            let words: Vec<_> = line.split('#').next().unwrap().split_whitespace().collect();
            if words.is_empty() {
                continue;
            }
            for (index, word) in words.iter().enumerate() {
                let is_whole = matches!(record, 0 | 2 | 5) || (record > 6 && index == 0);
                let word = match (is_whole, random(6)) {
                    (true, 0) => format!("00{word}"),
                    (true, _) => (*word).to_owned(),
                    (_, 0) if !word.starts_with('-') => format!("+{word}"),
                    (_, 1) if !word.contains('e') => {
                        let point = if word.contains('.') { "" } else { "." };
                        format!("{word}{point}00")
                    }
                    (_, 2) if !word.contains('e') => format!("{word}e0"),
                    (_, 3) if word.len() > 2 && word.starts_with("0.") => word[1..].to_owned(),
                    _ => (*word).to_owned(),
                };
                out += ["", " ", "\t", "  "][random(4) as usize];
                out += if index > 0 { " " } else { "" };
                out += &word;
            }
            out += [
                "\n",
                "\r\n",
                " # comment\n",
                "#\n",
                "\n\n\n",
                "\n  # between \r\n",
            ][random(6) as usize];
            record += 1;
        }
        out
    }

    fn printed<T: HostScalar>(text: &[u8]) -> String {
        let mut pools = T::pools();
        pools.parse(text).unwrap();
        scanray::print(&pools.as_scene()).unwrap().to_string()
    }

    #[test]
    fn the_scene_is_the_same_to_the_bit_and_the_form_is_final() {
        let mut state = 7_u64;
        let mut random = |below: u32| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 33) as u32 % below
        };
        for text in [
            include_str!("../../scenes/default.txt"),
            include_str!("../../scenes/mirror-room.txt"),
            include_str!("../../scenes/pyramids.txt"),
            include_str!("../../scenes/reflective.txt"),
            include_str!("../../scenes/window-room.txt"),
        ] {
            let once = canonical(text.as_bytes());
            for round in 0..20 {
                let other = disguised(text, &mut random);
                let tidy = canonical(other.as_bytes());
                let words = |text: &[u8]| -> Vec<String> {
                    let records = lines(text).filter(Line::is_record);
                    records.map(|line| formatted(&line, 0)).collect()
                };
                assert_eq!(words(&tidy), words(&once), "round {round}: {other}");
                assert_eq!(canonical(&tidy), tidy);
            }
            assert_eq!(printed::<f32>(text.as_bytes()), printed::<f32>(&once));
            assert_eq!(printed::<f64>(text.as_bytes()), printed::<f64>(&once));
        }
        // Random numbers in random forms.
        let mut word = |longest: u32| -> String {
            let mut digits = |most| -> String {
                let count = random(most);
                (0..count)
                    .map(|_| char::from(b'0' + (random(14) as u8).min(9)))
                    .collect()
            };
            let (whole, fraction, exponent) = (digits(longest) + "7", digits(12), digits(2));
            match exponent.len() {
                0 => format!("{whole}.{fraction}"),
                _ => format!("0{whole}.{fraction}e-{exponent}"),
            }
        };
        for _ in 0..500 {
            let mut numbers =
                |count: usize| (0..count).map(|_| word(6)).collect::<Vec<_>>().join(" ");
            let scene = format!(
                "1\n{}\n8 6\n{}\n{}\n0\n{}\n0 {}",
                numbers(3),
                numbers(8),
                numbers(1),
                numbers(3),
                numbers(4),
            );
            // No share of light above a million.
            let shares: Vec<_> = (0..12).map(|_| word(4)).collect();
            let text = format!("{scene} {} 1.50\n", shares.join(" "));
            let tidy = canonical(text.as_bytes());
            assert_eq!(
                printed::<f64>(text.as_bytes()),
                printed::<f64>(&tidy),
                "{text}"
            );
            assert_eq!(
                printed::<f32>(text.as_bytes()),
                printed::<f32>(&tidy),
                "{text}"
            );
            assert_eq!(canonical(&tidy), tidy);
        }
    }
}
