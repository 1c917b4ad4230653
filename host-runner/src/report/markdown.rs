//! The report as Markdown, with the plots beside it as SVG files.

use std::fmt::Write as _;

use super::document::{Cost, Document, Measure, SceneReport, Verdict};
use super::{method, plot, table};

/// The text, and the files it shows: name and content.
pub(crate) fn write(document: &Document) -> (String, Vec<(String, String)>) {
    let mut text = String::from("# Error against run time\n");
    let mut files = Vec::new();
    for scene in &document.scenes {
        let size = scene.size;
        let _ = write!(
            text,
            "\n## {} ({}×{})\n\n",
            scene.name, size.width, size.height
        );
        for (cost, measure) in [
            (Cost::ALL[0], Measure::Total),
            (Cost::ALL[0], Measure::BeforeQuantisation),
            (Cost::ALL[2], Measure::Total),
        ] {
            if let Ok(svg) = plot::svg(scene, cost, measure) {
                let name = format!("{}-{}-{}.svg", scene.name, cost.slug(), measure.slug());
                let _ = writeln!(text, "![{}: {}]({name})", scene.name, cost.label());
                files.push((name, svg));
            }
        }
        text.push_str("\nBold: on the Pareto front.\n\n");
        write_table(&mut text, scene);
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

fn write_table(text: &mut String, scene: &SceneReport) {
    let row = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
    text.push_str(&row(table::COLUMNS
        .iter()
        .map(|c| c.heading.to_owned())
        .collect()));
    let rule = (0..table::COLUMNS.len()).map(|i| if i == 0 { "---" } else { "---:" }.to_owned());
    text.push_str(&row(rule.collect()));
    for configuration in &scene.configurations {
        let mut cells: Vec<String> = table::COLUMNS
            .iter()
            .map(|column| (column.cell)(configuration))
            .collect();
        match configuration.verdict {
            Verdict::Best => cells[0] = format!("**{}**", cells[0]),
            Verdict::Failed(_) => cells[0].push_str(" (failed)"),
            _ => {}
        }
        text.push_str(&row(cells));
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
