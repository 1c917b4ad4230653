//! The report as Markdown, with the plots beside it as SVG files.

use std::fmt::Write as _;

use super::document::{Cost, Document, Emulation, Measure, SceneReport, Verdict};
use super::{method, plot, table};

/// The text, and the files it shows: name and content.
pub(crate) fn write(document: &Document) -> (String, Vec<(String, String)>) {
    let mut text = String::from("# Error against run time\n");
    let mut files = Vec::new();
    let emulation = &document.emulation;
    for scene in &document.scenes {
        let size = scene.size;
        let _ = write!(
            text,
            "\n## {} ({}×{})\n\n",
            escaped(&scene.name),
            size.width,
            size.height
        );
        for (cost, measure) in [
            (Cost::ALL[0], Measure::Total),
            (Cost::ALL[0], Measure::BeforeQuantisation),
            (Cost::ALL[2], Measure::Total),
        ] {
            if let Ok(svg) = plot::svg(scene, emulation, cost, measure) {
                let name = format!("{}-{}-{}.svg", scene.slug, cost.slug(), measure.slug());
                let title = format!("{}: {}", escaped(&scene.name), cost.label(emulation));
                let _ = writeln!(text, "![{title}]({name})");
                files.push((name, svg));
            }
        }
        text.push_str(
            "\nBold: on the Pareto front of the first plot, or equal to one that is.\n\n",
        );
        write_table(&mut text, scene, emulation);
        write_list(&mut text, "Equal", &table::equal(scene));
        write_list(&mut text, "Dominated", &table::dominated(scene));
        write_list(&mut text, "Failed", &table::failed(scene));
    }
    text.push_str("\n## How the figures came about\n");
    for (heading, words) in method::paragraphs(document) {
        let _ = write!(text, "\n* **{heading}**: {words}");
    }
    let _ = write!(text, "\n\nscanray {}\n", document.version);
    (text, files)
}

/// A name without what Markdown takes for its own.
fn escaped(name: &str) -> String {
    let escape = |c: char| match c {
        '\\' | '`' | '*' | '_' | '[' | ']' | '<' | '>' | '|' | '#' | '!' => format!("\\{c}"),
        c if c.is_control() => " ".to_owned(),
        c => c.to_string(),
    };
    name.chars().map(escape).collect()
}

fn write_table(text: &mut String, scene: &SceneReport, emulation: &Emulation) {
    let row = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
    text.push_str(&row(table::COLUMNS
        .iter()
        .map(|column| table::heading(column, emulation))
        .collect()));
    let rule = (0..table::COLUMNS.len()).map(|i| if i == 0 { "---" } else { "---:" }.to_owned());
    text.push_str(&row(rule.collect()));
    for configuration in &scene.configurations {
        let mut cells: Vec<String> = table::COLUMNS
            .iter()
            .map(|column| (column.cell)(configuration))
            .collect();
        match configuration.verdict {
            _ if is_worth_having(scene, &configuration.verdict) => {
                cells[0] = format!("**{}**", cells[0])
            }
            Verdict::Failed(_) => cells[0].push_str(" (failed)"),
            _ => {}
        }
        text.push_str(&row(cells));
    }
}

/// Whether it is on the Pareto front or equal to one that is: what is equal to a dominated one is not.
fn is_worth_having(scene: &SceneReport, verdict: &Verdict) -> bool {
    let is_best = |verdict: &Verdict| *verdict == Verdict::Best;
    match verdict {
        Verdict::EqualTo(other) => {
            let other = scene.configurations.get(*other);
            other.is_some_and(|other| is_best(&other.verdict))
        }
        verdict => is_best(verdict),
    }
}

fn write_list(text: &mut String, heading: &str, lines: &[String]) {
    let _ = write!(text, "\n{heading}: ");
    if lines.is_empty() {
        text.push_str("nothing.\n");
    } else {
        let _ = writeln!(text, "{}.", lines.join("; "));
    }
}
