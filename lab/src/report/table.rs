//! The figures as tables: what columns there are, and CSV and JSON.

use std::io::{self, Write};

use serde_json::Value;

use super::document::{Configuration, Cost, Document, Emulation, SceneReport, Verdict};
use super::errors::Error;
use super::plot::number;
use super::settings::Settings;
use crate::cost::Core;

/// A column of figures, for people.
pub(crate) struct Column {
    pub(crate) heading: &'static str,
    pub(crate) explanation: &'static str,
    pub(crate) cell: fn(&Configuration) -> String,
}

/// The columns.
pub(crate) const COLUMNS: &[Column] = &[
    Column {
        heading: "settings",
        explanation: "What differs from the default",
        cell: |c| c.name.clone(),
    },
    Column {
        heading: "M4F",
        explanation: "Instructions per pixel on Cortex-M4F",
        cell: |c| instructions(c, Core::M4f),
    },
    Column {
        heading: "M3",
        explanation: "Instructions per pixel on Cortex-M3",
        cell: |c| instructions(c, Core::M3),
    },
    Column {
        heading: "M0",
        explanation: "Instructions per pixel on Cortex-M0",
        cell: |c| instructions(c, Core::M0),
    },
    Column {
        heading: "rays",
        explanation: "Rays per pixel",
        cell: |c| number(c.work.rays),
    },
    Column {
        heading: "tests",
        explanation: "Intersection tests per pixel",
        cell: |c| number(c.work.tests),
    },
    Column {
        heading: "host ms",
        explanation: "Wall time on the host, median (shortest to longest); not deterministic",
        cell: |c| {
            let time = c.host_time;
            let [median, least, most] =
                [time.median, time.least, time.most].map(|s| number(1e3 * s));
            let doubt = if time.is_doubtful() { "?" } else { "" };
            format!("{median}{doubt} ({least} to {most})")
        },
    },
    Column {
        heading: "rounding",
        explanation: "RMSE against the same settings in f64, in levels of 255",
        cell: |c| number(c.errors.rounding.rmse),
    },
    Column {
        heading: "truncation",
        explanation: "RMSE of the same settings in f64 against R1",
        cell: |c| number(c.errors.truncation.rmse),
    },
    Column {
        heading: "aliasing",
        explanation: "RMSE of R1 against R2",
        cell: |c| number(c.errors.aliasing.rmse),
    },
    Column {
        heading: "quantisation",
        explanation: "RMSE of what is shown against the colours before quantisation",
        cell: |c| number(c.errors.quantisation.rmse),
    },
    Column {
        heading: "total",
        explanation: "RMSE of what is shown against R2",
        cell: |c| number(c.errors.total.rmse),
    },
    Column {
        heading: "PSNR",
        explanation: "Of what is shown against R2, in decibels",
        cell: |c| format!("{} dB", number(psnr(c))),
    },
    Column {
        heading: "max",
        explanation: "The largest error of what is shown against R2",
        cell: |c| number(c.errors.total.max),
    },
    Column {
        heading: "> 1 level",
        explanation: "Share of the pixels more than a level away from R2",
        cell: |c| format!("{} %", number(100.0 * c.errors.total.share_above_a_level)),
    },
    Column {
        heading: "FLIP",
        explanation: "Mean FLIP error against R2, 0 to 1",
        cell: |c| number(c.flip),
    },
];

/// The columns that decide, which fit on a page.
pub(crate) fn brief() -> Vec<&'static Column> {
    const HEADINGS: [&str; 9] = [
        "settings",
        "M4F",
        "M3",
        "M0",
        "rays",
        "total",
        "PSNR",
        "> 1 level",
        "FLIP",
    ];
    let is_brief = |column: &&Column| HEADINGS.contains(&column.heading);
    COLUMNS.iter().filter(is_brief).collect()
}

fn instructions(configuration: &Configuration, core: Core) -> String {
    Cost::Instructions(core)
        .of(configuration)
        .map_or("–".to_owned(), number)
}

/// Peak signal-to-noise ratio of what is shown, in decibels.
fn psnr(configuration: &Configuration) -> f64 {
    20.0 * (255.0 / configuration.errors.total.rmse).log10()
}

/// The heading of a column, with where its figures come from.
pub(crate) fn heading(column: &Column, emulation: &Emulation) -> String {
    let of = |core: &Core| core.name() == column.heading;
    match Core::ALL.into_iter().find(of) {
        Some(core) => format!("{core} ({})", emulation.word(core)),
        None => column.heading.to_owned(),
    }
}

/// A line for each configuration that is as another in cost and error, with that other.
pub(crate) fn equal(scene: &SceneReport) -> Vec<String> {
    scene
        .configurations
        .iter()
        .filter_map(|configuration| match configuration.verdict {
            Verdict::EqualTo(other) => {
                let other = scene.configurations.get(other)?;
                Some(format!("{}: to {}", configuration.name, other.name))
            }
            _ => None,
        })
        .collect()
}

/// A line for each dominated configuration, with what dominates it.
pub(crate) fn dominated(scene: &SceneReport) -> Vec<String> {
    scene
        .configurations
        .iter()
        .filter_map(|configuration| match configuration.verdict {
            Verdict::DominatedBy(other) => {
                let other = scene.configurations.get(other)?;
                Some(format!("{}: by {}", configuration.name, other.name))
            }
            _ => None,
        })
        .collect()
}

/// A line for each failed configuration, with the reason.
pub(crate) fn failed(scene: &SceneReport) -> Vec<String> {
    scene
        .configurations
        .iter()
        .filter_map(|configuration| match &configuration.verdict {
            Verdict::Failed(why) => Some(format!("{}: {why}", configuration.name)),
            _ => None,
        })
        .collect()
}

/// Writes all figures as CSV (RFC 4180), a line for each configuration.
///
/// # Errors
///
/// Those of `out`.
pub(crate) fn write_csv(document: &Document, out: &mut dyn Write) -> io::Result<()> {
    let mut headings: Vec<String> = ["scene", "settings", "verdict"].map(str::to_owned).into();
    headings.extend(Settings::DEFAULT.fields().map(|(name, _)| name.to_owned()));
    headings.extend(["rays_per_pixel", "tests_per_pixel"].map(str::to_owned));
    for source in ["by_model", "emulated"] {
        headings.extend(
            ["m4f", "m3", "m0"].map(|core| format!("{core}_instructions_per_pixel_{source}")),
        );
    }
    headings.extend(["median", "least", "most"].map(|which| format!("host_seconds_{which}")));
    for error in [
        "rounding",
        "truncation",
        "aliasing",
        "quantisation",
        "before_quantisation",
        "total",
    ] {
        headings
            .extend(["rmse", "max", "share_above_a_level"].map(|what| format!("{error}_{what}")));
    }
    headings.extend(["total_psnr", "flip"].map(str::to_owned));
    write_record(out, &headings)?;
    for scene in &document.scenes {
        for configuration in &scene.configurations {
            write_record(out, &record(scene, configuration))?;
        }
    }
    Ok(())
}

fn record(scene: &SceneReport, configuration: &Configuration) -> Vec<String> {
    let Configuration {
        name,
        settings,
        errors,
        flip,
        work,
        host_time,
        predicted,
        counted,
        verdict,
        ..
    } = configuration;
    let verdict = match verdict {
        Verdict::Best => "pareto-front",
        Verdict::EqualTo(_) => "equal",
        Verdict::DominatedBy(_) => "dominated",
        Verdict::Failed(_) => "failed",
        Verdict::NotForDevices => "not-for-devices",
    };
    let mut record = vec![scene.name.clone(), name.clone(), verdict.to_owned()];
    record.extend(settings.fields().map(|(_, value)| match value {
        Value::String(word) => word,
        Value::Null => String::new(),
        value => value.to_string(),
    }));
    record.extend([work.rays, work.tests].map(|n| n.to_string()));
    let predicted = predicted.map_or([None; 3], |all| all.map(Some));
    record.extend(
        [predicted, *counted]
            .concat()
            .into_iter()
            .map(|count| count.map_or(String::new(), |n| format!("{n:.1}"))),
    );
    record.extend([host_time.median, host_time.least, host_time.most].map(|n| n.to_string()));
    for Error {
        rmse,
        max,
        share_above_a_level,
    } in [
        errors.rounding,
        errors.truncation,
        errors.aliasing,
        errors.quantisation,
        errors.before_quantisation,
        errors.total,
    ] {
        record.extend([rmse, max, share_above_a_level].map(|n| n.to_string()));
    }
    record.extend([psnr(configuration), *flip].map(|n| n.to_string()));
    record
}

fn write_record(out: &mut dyn Write, record: &[String]) -> io::Result<()> {
    let cells: Vec<_> = record
        .iter()
        .map(|cell| {
            if cell.contains([',', '"', '\n', '\r']) {
                format!("\"{}\"", cell.replace('"', "\"\""))
            } else {
                cell.clone()
            }
        })
        .collect();
    write!(out, "{}\r\n", cells.join(","))
}

/// Writes everything that was measured as JSON.
///
/// # Errors
///
/// Those of `out`.
pub(crate) fn write_json(document: &Document, out: &mut dyn Write) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, document)?;
    writeln!(out)
}
