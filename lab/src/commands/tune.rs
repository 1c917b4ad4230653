//! `scanray tune`: the settings for a device and a time.

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;
use std::str::FromStr;

use clap::Args;
use scanray::Resolution;
use serde::Serialize;

use crate::cost::{Core, MODEL};
use crate::report::{BothScalars, Budget, Choice, Sampling, Settings, Sweep, Tuned, tune};
use scanray_host::console::{print, shown};
use scanray_host::failure::Failure;
use scanray_host::option_values::{ColorName, Size, name_of, whole};
use scanray_host::parallel_drawing::Workers;
use scanray_host::scene_file::SceneSource;

/// The command line.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  scanray-lab tune scene.txt --target m4f --clock 168MHz --budget 100ms --size 40x30
  scanray-lab tune scene.txt --target m0 --clock 16MHz --budget 2s --size 40x30 --dither
  scanray-lab tune scene.txt --target m3 --clock 72MHz --budget 5fps --size 40x30 --json

Tries maximum depths, cut-offs and ways of sampling, and names the setting with the least error whose time is within the \
budget at the upper end of its range. Instructions are predicted by a model, and how far off it may be is told; milliseconds are an \
estimate from the cores' manuals. Errors are those of what the display shows against the scene in f64 with 256 samples a pixel: \
the root of the mean square in levels of 255; with --dither FLIP, 0 to 1, because the mean square punishes the pattern that the \
eye averages. Displays of greys are compared with greys.

Exit codes: 1 nothing fits.")]
pub(crate) struct TuneArgs {
    /// Scene file, `-` for standard input; the default scene if there is none
    #[arg(value_name = "SCENE")]
    scene: Option<PathBuf>,

    /// The device's core
    #[arg(long, value_name = "CORE", ignore_case = true)]
    target: Core,

    /// Its clock, such as 168MHz
    #[arg(long, value_name = "FREQUENCY")]
    clock: Frequency,

    /// Time for a picture, such as 100ms, 0.5s or 10fps
    #[arg(long, value_name = "TIME")]
    budget: PictureTime,

    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "160x120")]
    size: Size,

    /// Colours of the display
    #[arg(
        long,
        value_name = "NAME",
        default_value = "rgb888",
        hide_possible_values = false
    )]
    color: ColorName,

    /// Show shades between two levels by a fixed pattern (ordered dither)
    #[arg(long)]
    dither: bool,

    /// Wait states of the flash: how many cycles each read takes longer
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = whole::<u32>(0..=32), allow_negative_numbers = true)]
    wait_states: u32,

    /// Threads that draw [default: one for each core of this machine]
    #[arg(long, value_name = "N", value_parser = whole::<u16>(1..=1024), allow_negative_numbers = true)]
    threads: Option<u16>,

    /// Print JSON: the same in fields, settings by the names of `render --json`
    #[arg(long)]
    json: bool,
}

/// Cycles a second.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Frequency(f64);

/// Seconds for a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
struct PictureTime(f64);

/// A number above 0 and its unit, which blanks may separate.
fn quantity(word: &str) -> Option<(f64, &str)> {
    let word = word.trim();
    let end = word.find(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | '_')))?;
    let number: f64 = word[..end].replace('_', "").parse().ok()?;
    (number > 0.0 && number.is_finite()).then(|| (number, word[end..].trim_start()))
}

/// The product, unless it is no number that can be worked with.
fn times(number: f64, unit: f64) -> Option<f64> {
    Some(number * unit).filter(|product| (1e-12..1e15).contains(product))
}

impl FromStr for Frequency {
    type Err = String;

    fn from_str(word: &str) -> Result<Self, String> {
        quantity(word)
            .and_then(|(number, unit)| {
                let unit = match unit.to_ascii_lowercase().as_str() {
                    "hz" => 1.0,
                    "khz" => 1e3,
                    "mhz" => 1e6,
                    "ghz" => 1e9,
                    _ => return None,
                };
                times(number, unit).map(Self)
            })
            .ok_or_else(|| {
                "give a number above 0 and Hz, kHz, MHz or GHz, such as 168MHz".to_owned()
            })
    }
}

impl FromStr for PictureTime {
    type Err = String;

    fn from_str(word: &str) -> Result<Self, String> {
        quantity(word)
            .and_then(|(number, unit)| {
                match unit.to_ascii_lowercase().as_str() {
                    "us" | "µs" => times(number, 1e-6),
                    "ms" => times(number, 1e-3),
                    "s" => times(number, 1.0),
                    "min" => times(number, 60.0),
                    "fps" => times(1.0 / number, 1.0),
                    _ => None,
                }
                .map(Self)
            })
            .ok_or_else(|| {
                "give a number above 0 and us, ms, s, min or fps, such as 100ms".to_owned()
            })
    }
}

/// Tries settings and prints the choice. Code 1 when nothing fits.
///
/// # Errors
///
/// [`Failure`].
pub(crate) fn run(args: &TuneArgs) -> Result<ExitCode, Failure> {
    let source = SceneSource::named(args.scene.as_deref());
    let Size(resolution) = args.size;
    let display = Settings {
        color: args.color,
        dither: args.dither,
        ..Settings::DEFAULT
    };
    let budget = Budget {
        core: args.target,
        clock: args.clock.0,
        seconds: args.budget.0,
        wait_states: args.wait_states,
    };
    let workers = Workers::new(args.threads)?;
    let scene = BothScalars::load(&source)?;
    let sweep = Sweep::new(&scene, resolution, &workers)?;
    let tuned = tune(&sweep, &display, &budget)?;
    let code = tuned
        .best
        .as_ref()
        .map_or(Vec::new(), |best| code(&best.settings, resolution));
    let answer = Answer {
        code,
        scene: source.data_name(),
        size: [resolution.width, resolution.height],
        target: args.target,
        clock_hz: budget.clock,
        budget_ms: 1e3 * budget.seconds,
        error_measure: if args.dither { "flip" } else { "rmse" },
        wait_states: args.wait_states,
        instructions_within_percent: MODEL.within_percent()[args.target as usize],
        tuned,
    };
    print(|out| {
        if args.json {
            serde_json::to_writer(&mut *out, &answer)?;
            writeln!(out)
        } else {
            answer.write(out, resolution, args)
        }
    })?;
    Ok(match answer.tuned.best {
        Some(_) => ExitCode::SUCCESS,
        None => ExitCode::from(1),
    })
}

/// What is printed.
#[derive(Serialize)]
struct Answer {
    scene: String,
    size: [u16; 2],
    target: Core,
    clock_hz: f64,
    budget_ms: f64,
    error_measure: &'static str,
    wait_states: u32,
    /// How far off the model that predicts the instructions may be.
    instructions_within_percent: u32,
    #[serde(flatten)]
    tuned: Tuned,
    /// Lines of Rust that draw with the best.
    code: Vec<String>,
}

impl Answer {
    /// The answer for people.
    fn write(&self, out: &mut dyn Write, size: Resolution, args: &TuneArgs) -> io::Result<()> {
        let dither = if args.dither { ", dithered" } else { "" };
        writeln!(
            out,
            "{}, {}×{} in {}{dither}, on {} at {} MHz with {} wait states, {} a picture:",
            shown(&self.scene),
            size.width,
            size.height,
            name_of(args.color),
            self.target,
            self.clock_hz / 1e6,
            self.wait_states,
            duration(self.budget_ms)
        )?;
        let Tuned {
            best,
            better,
            cheaper,
            cheapest,
            tried,
        } = &self.tuned;
        match best {
            Some(best) => {
                line(out, "best within it", best)?;
                match cheaper {
                    Some(cheaper) => line(out, "next cheaper", cheaper)?,
                    None => writeln!(out, "  nothing is cheaper")?,
                }
                match better {
                    Some(better) => line(out, "next better", better)?,
                    None => writeln!(out, "  nothing that was tried is better")?,
                }
            }
            None => {
                writeln!(out, "  nothing fits")?;
                if let Some(cheapest) = cheapest {
                    line(out, "the cheapest", cheapest)?;
                }
            }
        }
        if !self.code.is_empty() {
            writeln!(out, "  the best in code, for a display of these colours:")?;
        }
        for line in &self.code {
            writeln!(out, "    {line}")?;
        }
        writeln!(
            out,
            "{tried} settings were tried. Instructions are predicted by a model, within {} %; milliseconds are an estimate of what \
             these take, the upper end counts.\n\
             Error: {}, against f64 with 256 samples a pixel.",
            self.instructions_within_percent,
            if args.dither {
                "FLIP, 0 to 1"
            } else {
                "root of the mean square, in levels of 255"
            }
        )
    }
}

fn line(out: &mut dyn Write, what: &str, choice: &Choice) -> io::Result<()> {
    let Choice {
        settings,
        instructions,
        milliseconds,
        error,
    } = choice;
    writeln!(
        out,
        "  {what:<15} max depth {}, {}, {}: error {}, {} instructions, {} to {}",
        settings.max_depth,
        match settings.cutoff {
            Some(of) => format!("cut-off 1/{of}"),
            None => "no cut-off".to_owned(),
        },
        settings.sampling,
        rounded(*error),
        rounded(*instructions),
        duration(milliseconds.least),
        duration(milliseconds.most)
    )
}

/// How a program draws with the settings on a display of the size and the colours.
fn code(settings: &Settings, size: Resolution) -> Vec<String> {
    let Resolution { width, height } = size;
    let cutoff = settings
        .cutoff
        .map_or(String::new(), |of| format!(", cutoff = 1.0 / {of}.0"));
    let depth = settings.max_depth;
    // The stack decides about smaller depths.
    let (stack, with_depth) = match depth {
        0 => (", stack = 1".to_owned(), ".with_max_depth(0)?".to_owned()),
        scanray::DEFAULT_MAX_DEPTH => Default::default(),
        1..scanray::DEFAULT_MAX_DEPTH => (format!(", stack = {depth}"), String::new()),
        _ => (
            format!(", stack = {depth}"),
            format!(".with_max_depth({depth})?"),
        ),
    };
    let mut lines = vec![
        format!("let tracer = tracer_for!(SCENE{cutoff}{stack}){with_depth};"),
        format!(
            "let tracer = tracer.with_resolution(Resolution {{ width: {width}, height: {height} }});"
        ),
    ];
    let source = match settings.sampling {
        Sampling::Fixed(1) => "tracer".to_owned(),
        Sampling::Fixed(samples) => format!("Supersampled::<_, {samples}>::new(tracer)"),
        Sampling::Adaptive(of) => {
            lines.push(format!(
                "let mut centers = [CenterSample::EMPTY; 2 * {width}];"
            ));
            let samples = Settings::ADAPTIVE_SAMPLES;
            format!("Adaptive::<_, {samples}>::new(tracer, 1.0 / {of}.0, &mut centers)")
        }
    };
    let dithered = if settings.dither { ".dithered()" } else { "" };
    lines.push(format!(
        "Picture::new({source}){dithered}.draw(&mut display)?;"
    ));
    lines
}

/// Milliseconds in a unit that leaves few digits.
fn duration(milliseconds: f64) -> String {
    let (unit, name) = match milliseconds {
        ..1.0 => (1e-3, "µs"),
        ..1e3 => (1.0, "ms"),
        ..6e5 => (1e3, "s"),
        ..3.6e7 => (6e4, "min"),
        ..8.64e8 => (3.6e6, "h"),
        _ => (8.64e7, "days"),
    };
    format!("{} {name}", rounded(milliseconds / unit))
}

/// Three digits that count.
fn rounded(number: f64) -> String {
    crate::report::number(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frequencies() {
        let hertz = |word: &str| word.parse::<Frequency>().ok().map(|Frequency(hz)| hz);
        assert_eq!(hertz("168MHz"), Some(168e6));
        assert_eq!(hertz("16 mhz"), Some(16e6));
        assert_eq!(hertz("32.768kHz"), Some(32_768.0));
        assert_eq!(hertz("1_000Hz"), Some(1000.0));
        for word in [
            "", "168", "MHz", "0MHz", "-1MHz", "1e6Hz", "168MHzz", "inf Hz", "1.2.3MHz",
        ] {
            assert_eq!(hertz(word), None, "{word}");
        }
    }

    #[test]
    fn durations_are_readable() {
        let words = [0.25, 17.04, 2500.0, 59_900.0, 5.99e6, 5.99e8, 5.99e10].map(duration);
        let expected = [
            "250 µs", "17 ms", "2.5 s", "59.9 s", "99.8 min", "166 h", "693 days",
        ];
        assert_eq!(words, expected);
    }

    #[test]
    fn times_for_a_picture() {
        let seconds = |word: &str| word.parse::<PictureTime>().ok().map(|PictureTime(s)| s);
        assert_eq!(seconds("100ms"), Some(0.1));
        assert_eq!(seconds("0.5 s"), Some(0.5));
        assert_eq!(seconds("10fps"), Some(0.1));
        assert_eq!(seconds("2min"), Some(120.0));
        assert_eq!(seconds("250us"), Some(250.0 * 1e-6));
        for word in ["", "100", "ms", "0ms", "-5ms", "5m", "1h", "nan s"] {
            assert_eq!(seconds(word), None, "{word}");
        }
    }
}
