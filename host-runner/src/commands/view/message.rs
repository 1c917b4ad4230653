//! What is said below the picture, in a few lines.

/// The lines, none of which is wider than the terminal, and not more than `most`, at least 1. Of the report on an
/// error in a scene, the last to go are the place and what is wrong.
pub(super) fn condensed(message: &[String], columns: usize, most: usize) -> Vec<String> {
    let is_frame = |line: &str| line.trim().trim_matches('|').is_empty();
    let mut lines: Vec<&str> = message.iter().map(|line| &**line).collect();
    lines.retain(|line| !is_frame(line));
    let mut first = lines
        .first()
        .map_or_else(String::new, |line| (*line).to_owned());
    let mut rest = lines.get(1..).unwrap_or_default();
    if wrapped(&first, columns).len() + rest.len() > most
        && let [place, behind @ ..] = rest
        && let Some(place) = place.trim_start().strip_prefix("--> ")
    {
        first = format!("{place}: {first}");
        rest = behind;
    }
    let mut shown = wrapped(&first, columns);
    // A line of the scene says little without the carets below it.
    if shown.len() + rest.len() <= most {
        shown.extend(rest.iter().map(|line| line.chars().take(columns).collect()));
    }
    shown.truncate(most);
    shown
}

/// The text in lines of the terminal.
fn wrapped(text: &str, columns: usize) -> Vec<String> {
    let letters: Vec<char> = text.chars().collect();
    let lines = letters.chunks(columns.max(1));
    lines.map(|line| line.iter().collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_place_is_the_last_to_go() {
        let report = [
            "error: expected a number; found `zero`",
            " --> scene.txt:5:1",
            "  |",
            "5 | zero",
            "  | ^^^^",
        ]
        .map(str::to_owned);
        assert_eq!(
            condensed(&report, 80, 5),
            [&report[0], &report[1], &report[3], &report[4]].map(String::as_str)
        );
        let first = "scene.txt:5:1: error: expected a number; found `zero`";
        assert_eq!(condensed(&report, 80, 3), [first, "5 | zero", "  | ^^^^"]);
        assert_eq!(condensed(&report, 80, 2), [first]);
        assert_eq!(condensed(&report, 30, 1), [&first[..30]]);
        assert_eq!(condensed(&report, 30, 3), [&first[..30], &first[30..]]);
        assert_eq!(condensed(&["ab".to_owned()], 1, 5), ["a", "b"]);
    }
}
