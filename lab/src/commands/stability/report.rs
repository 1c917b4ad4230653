//! What was measured, for people and programs.

use std::io::{self, Write};

use scanray_stability::catalogue::{Case, Finding, Group, Quantity, ScalarName};
use scanray_stability::pictures::{Pictures, Telling};
use serde::Serialize;

/// A case as measured in a scalar.
#[derive(Debug)]
pub(super) struct Measured {
    pub(super) case: Case,
    pub(super) scalar: ScalarName,
    pub(super) findings: Vec<Finding>,
}

/// A telling case and its pictures.
#[derive(Debug)]
pub(super) struct Shown {
    pub(super) telling: Telling,
    pub(super) pictures: Pictures,
}

impl Measured {
    /// Whether no figure exceeds its bound.
    pub(super) fn passes(&self) -> bool {
        self.findings.iter().all(|finding| finding.pass)
    }
}

/// A figure of a quantity.
fn figure(quantity: Quantity, value: f64) -> String {
    match quantity {
        Quantity::Count => format!("{value}"),
        Quantity::Share if value == 0.0 => "0 %".to_owned(),
        Quantity::Share => format!("{} %", significant(100.0 * value)),
        Quantity::Error if value == 0.0 => "0".to_owned(),
        Quantity::Error if (1e-2..1e3).contains(&value) => significant(value),
        Quantity::Error => format!("{value:.1e}"),
    }
}

/// At most two digits that count.
fn significant(value: f64) -> String {
    let magnitude = value.abs().log10().floor();
    let decimals = (1.0 - magnitude).clamp(0.0, 6.0) as usize;
    let digits = format!("{value:.decimals$}");
    if digits.contains('.') {
        digits
            .trim_end_matches('0')
            .trim_end_matches('.')
            .to_owned()
    } else {
        digits
    }
}

/// The columns of a finding: what, of how many, measured, bound, by the textbook, whether it passes.
fn columns(finding: &Finding) -> [String; 6] {
    let value = |value: f64| figure(finding.quantity, value);
    let seed = finding.seed.map(|seed| format!(" (seed {seed})"));
    [
        finding.what.clone() + &seed.unwrap_or_default(),
        finding.of.to_string(),
        value(finding.measured),
        finding.bound.map_or_else(|| "–".to_owned(), value),
        finding.textbook.map(value).unwrap_or_default(),
        match (finding.bound, finding.pass) {
            (None, _) => "–",
            (Some(_), true) => "yes",
            (Some(_), false) => "NO",
        }
        .to_owned(),
    ]
}

/// How many figures there are, and how many exceed their bound.
fn totals(measured: &[Measured]) -> (usize, usize) {
    let findings = || measured.iter().flat_map(|measured| &measured.findings);
    (
        findings().count(),
        findings().filter(|finding| !finding.pass).count(),
    )
}

/// The table for a terminal.
pub(super) fn write_table(out: &mut dyn Write, measured: &[Measured]) -> io::Result<()> {
    let mut last = 0;
    for Measured {
        case,
        scalar,
        findings,
    } in measured
    {
        if case.number != last {
            last = case.number;
            writeln!(out, "{:2} {}: {}", case.number, case.title(), case.expected)?;
            if let Some(check) = case.on_boards() {
                writeln!(out, "   checked on the boards: {check}")?;
            }
        }
        for finding in findings {
            let [what, of, value, bound, textbook, pass] = columns(finding);
            let bound = match finding.bound {
                Some(_) => format!("at most {bound}"),
                None => "no bound".to_owned(),
            };
            write!(
                out,
                "   {}  {pass:<3}  {value:>9}  ({bound}) of {of}: {what}",
                scalar.name()
            )?;
            if !textbook.is_empty() {
                write!(out, " (textbook: {textbook})")?;
            }
            writeln!(out)?;
        }
    }
    let (figures, failed) = totals(measured);
    writeln!(out, "{figures} figures, {failed} beyond their bound")
}

/// A case as JSON.
#[derive(Serialize)]
struct CaseReport<'a> {
    case: u8,
    name: &'a str,
    group: Group,
    expected: &'a str,
    scalar: ScalarName,
    #[serde(skip_serializing_if = "Option::is_none")]
    checked_on_boards: Option<&'a str>,
    pass: bool,
    figures: &'a [Finding],
}

/// The cases as a JSON array.
pub(super) fn write_json(out: &mut dyn Write, measured: &[Measured]) -> io::Result<()> {
    let reports: Vec<_> = measured
        .iter()
        .map(|measured| CaseReport {
            case: measured.case.number,
            name: measured.case.name,
            group: measured.case.group,
            expected: measured.case.expected,
            scalar: measured.scalar,
            checked_on_boards: measured.case.on_boards(),
            pass: measured.passes(),
            figures: &measured.findings,
        })
        .collect();
    serde_json::to_writer_pretty(&mut *out, &reports)?;
    writeln!(out)
}

/// The document docs/stability.md.
pub(super) fn write_markdown(
    out: &mut dyn Write,
    measured: &[Measured],
    shown: &[Shown],
) -> io::Result<()> {
    writeln!(out, "{}", include_str!("introduction.md"))?;
    writeln!(
        out,
        "| case | scanray `f32`, textbook `f32`, scanray `f64` | off, scanray | off, textbook |"
    )?;
    writeln!(out, "|---|---|---|---|")?;
    for Shown { telling, pictures } in shown {
        let off = |picture| figure(Quantity::Share, pictures.share_off(picture));
        writeln!(
            out,
            "| {} | ![{}](stability/{}.png) | {} | {} |",
            telling.title,
            telling.name,
            telling.name,
            off(&pictures.single),
            off(&pictures.textbook)
        )?;
    }
    let (figures, failed) = totals(measured);
    writeln!(
        out,
        "\n## The cases\n\n{figures} figures, {failed} beyond their bound."
    )?;
    let groups = [
        (Group::Geometry, "Geometry"),
        (Group::Shading, "Shading and offset"),
        (Group::Image, "Camera and image"),
        (Group::Input, "Input and platform"),
    ];
    for (group, name) in groups {
        let of_group = || {
            measured
                .iter()
                .filter(move |measured| measured.case.group == group)
        };
        if of_group().next().is_none() {
            continue;
        }
        writeln!(out, "\n### {name}\n")?;
        writeln!(
            out,
            "| case | scalar | figure | of | measured | bound | textbook | pass |"
        )?;
        writeln!(out, "|---|---|---|--:|--:|--:|--:|---|")?;
        let mut last = 0;
        for Measured {
            case,
            scalar,
            findings,
        } in of_group()
        {
            if case.number != last {
                last = case.number;
                writeln!(
                    out,
                    "| **{}** | | **{}**: {} | | | | | |",
                    case.number,
                    case.title(),
                    case.expected
                )?;
                if let Some(check) = case.on_boards() {
                    writeln!(
                        out,
                        "| {} | | checked on the boards: {check} | | | | | |",
                        case.number
                    )?;
                }
            }
            for finding in findings {
                let row = columns(finding).join(" | ");
                writeln!(out, "| {} | {} | {row} |", case.number, scalar.name())?;
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_figure_beyond_its_bound_is_told() {
        let finding = Finding {
            what: "leaks".to_owned(),
            quantity: Quantity::Count,
            measured: 1.0,
            bound: Some(0.0),
            pass: false,
            of: 20_000,
            seed: Some(7),
            textbook: None,
        };
        let informs = Finding {
            what: "pixels not settled".to_owned(),
            bound: None,
            pass: true,
            seed: None,
            ..finding.clone()
        };
        let measured = [Measured {
            case: Case::all()[0],
            scalar: ScalarName::F32,
            findings: vec![finding, informs],
        }];
        assert!(!measured[0].passes());
        let mut table = Vec::new();
        write_table(&mut table, &measured).unwrap();
        let table = String::from_utf8(table).unwrap();
        assert!(
            table.contains("f32  NO           1  (at most 0) of 20000: leaks (seed 7)"),
            "{table}"
        );
        assert!(
            table.contains("f32  –            1  (no bound) of 20000: pixels not settled\n"),
            "{table}"
        );
        assert!(
            table.ends_with("2 figures, 1 beyond their bound\n"),
            "{table}"
        );
    }

    #[test]
    fn figures_have_two_digits() {
        assert_eq!(figure(Quantity::Count, 20_000.0), "20000");
        assert_eq!(figure(Quantity::Share, 0.000_9), "0.09 %");
        assert_eq!(figure(Quantity::Share, 0.503_75), "50 %");
        assert_eq!(figure(Quantity::Share, 1.0), "100 %");
        assert_eq!(figure(Quantity::Error, 4.9e-8), "4.9e-8");
        assert_eq!(figure(Quantity::Error, 0.42), "0.42");
    }
}
