//! Tables of figures by core, as the firmware's tools write them.

use super::Core;

/// Figures of each core, by name, in the order of the table.
pub type Rows = Vec<(String, [f64; Core::ALL.len()])>;

/// Reads a table of a header, which names the cores, and a line for each name; `#` begins a comment.
pub fn parse(text: &str) -> Option<Rows> {
    let mut lines = text
        .lines()
        .filter(|line| !line.starts_with('#') && !line.trim().is_empty());
    let header: Vec<_> = lines.next()?.split_whitespace().collect();
    let columns = Core::ALL.map(|core| header.iter().position(|word| *word == core.name()));
    lines
        .map(|line| {
            let words: Vec<_> = line.split_whitespace().collect();
            let mut numbers = [0.0; Core::ALL.len()];
            for (number, column) in numbers.iter_mut().zip(columns) {
                *number = words.get(column?)?.parse().ok()?;
            }
            Some((words.first()?.to_string(), numbers))
        })
        .collect()
}
