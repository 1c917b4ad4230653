//! The lines of scene text: numbers, comment.

/// A line of scene text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Line<'t> {
    /// Counted from 1.
    pub(crate) number: u32,
    /// What is before the comment.
    record: &'t [u8],
    /// From the `#` on, without the end of the line and blanks before it.
    pub(crate) comment: Option<&'t [u8]>,
}

impl<'t> Line<'t> {
    /// The words before the comment.
    pub(crate) fn words(&self) -> impl Iterator<Item = &'t [u8]> + use<'t> {
        let words = self
            .record
            .split(|byte| matches!(byte, b' ' | b'\t' | b'\r'));
        words.filter(|word| !word.is_empty())
    }

    /// Whether it has words: each line that has some is a record.
    pub(crate) fn is_record(&self) -> bool {
        self.words().next().is_some()
    }
}

/// The lines of a text, without a byte-order mark. A line feed at the end begins no further line.
pub(crate) fn lines(text: &[u8]) -> impl Iterator<Item = Line<'_>> {
    let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
    let lines = text.split_inclusive(|byte| *byte == b'\n').zip(1..);
    lines.map(|(line, number)| {
        let comment_at = line.iter().position(|byte| *byte == b'#');
        let (record, comment) = line.split_at(comment_at.unwrap_or(line.len()));
        Line {
            number,
            record: record.trim_ascii_end(),
            comment: comment_at.map(|_| comment.trim_ascii_end()),
        }
    })
}

/// How many records come before the objects.
pub(crate) const HEADER_RECORDS: usize = 7;

/// The line of each object of a scene's text, in the order of their numbers.
pub(crate) fn object_lines(text: &[u8]) -> Vec<u32> {
    let records = lines(text).filter(Line::is_record);
    records
        .skip(HEADER_RECORDS)
        .map(|line| line.number)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use scanray::ScenePools;

    #[test]
    fn words_and_comments() {
        let all: Vec<_> = lines(b"1 # one\r\n\n \t# two #\n+2.\t3#x\r\n4").collect();
        let words = |line: &Line<'_>| -> Vec<String> {
            line.words()
                .map(|w| String::from_utf8_lossy(w).into())
                .collect()
        };
        let seen: Vec<_> = all.iter().map(|line| (words(line), line.comment)).collect();
        assert_eq!(
            seen,
            [
                (vec!["1".into()], Some(&b"# one"[..])),
                (vec![], None),
                (vec![], Some(&b"# two #"[..])),
                (vec!["+2.".into(), "3".into()], Some(&b"#x"[..])),
                (vec!["4".into()], None),
            ]
        );
        assert_eq!(lines(b"").count(), 0);
        let marked: Vec<_> = lines(b"\xef\xbb\xbf1\n")
            .flat_map(|line| words(&line))
            .collect();
        assert_eq!(marked, ["1"]);
        assert_eq!(lines(b"\n").count(), 1);
    }

    #[test]
    fn the_parser_counts_the_same_lines() {
        for text in [
            &include_bytes!("../../scenes/default.txt")[..],
            include_bytes!("../../scenes/window-room.txt"),
        ] {
            let mut pools = Box::new(ScenePools::<f64, 64, 64, 64, 64>::new());
            pools.parse(text).unwrap();
            let objects = object_lines(text);
            assert_eq!(objects.len(), pools.as_scene().object_count());
            // A word too many in an object's line is an error of that line.
            for object in objects {
                let mut all: Vec<_> = text
                    .split(|byte| *byte == b'\n')
                    .map(<[u8]>::to_vec)
                    .collect();
                all[object as usize - 1].splice(0..0, *b"9 ");
                let error = pools.parse(&all.join(&b'\n')).unwrap_err();
                assert_eq!((error.line, error.column), (object, 1));
            }
        }
    }
}
