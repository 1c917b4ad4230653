//! `scanray needs`: what a scene asks of a device.

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, ValueEnum};
use scanray::{Resolution, Stages};
use serde::Serialize;

use crate::console::{print, shown};
use crate::device_memory::DeviceMemory;
use crate::displays;
use crate::failure::Failure;
use crate::option_values::{ColorName, ScalarName, name_of, with_color};
use crate::pools::HostScalar;
use crate::render_settings::PictureArgs;
use crate::scene_file::SceneSource;

/// The command line.
#[derive(Args, Debug)]
#[command(after_help = "\
Sizes are those of a device with pointers of 32 bits, such as a Cortex-M.

Examples:
  scanray needs                                 the default scene
  scanray needs scene.txt --display st7735      with a row for this display
  scanray needs scenes/pyramids.txt --json")]
pub(crate) struct NeedsArgs {
    /// Scene file, `-` for standard input; the default scene if there is none
    #[arg(value_name = "SCENE")]
    scene: Option<PathBuf>,

    #[command(flatten)]
    picture: PictureArgs,

    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// What a scene asks for.
#[derive(Debug, Serialize)]
struct Report {
    scene: String,
    objects: usize,
    scalar: &'static str,
    max_depth: usize,
    /// 0 without one.
    cutoff: f64,
    /// Stages of the tracer.
    stages: Vec<&'static str>,
    /// Bytes, for pointers of 32 bits.
    #[serde(flatten)]
    memory: DeviceMemory,
    /// Pixels of a row.
    width: u16,
    /// A row of a colour.
    rows: Vec<Row>,
    /// The type of pools with just enough room.
    pools_type: String,
    /// Rust source for firmware.
    source: String,
    /// Pools by name, for the same scene and no other stages.
    declaration: String,
}

#[derive(Debug, Serialize)]
struct Row {
    color: String,
    bytes: usize,
}

/// Tells what the scene needs.
///
/// # Errors
///
/// [`Failure`].
pub(crate) fn run(args: &NeedsArgs) -> Result<ExitCode, Failure> {
    if args.picture.wants_list() {
        return print(displays::write_list).map(|()| ExitCode::SUCCESS);
    }
    match args.picture.settings()?.scalar {
        ScalarName::F32 => tell::<f32>(args, |scene| scene.stages())?,
        ScalarName::F64 => tell::<f64>(args, |scene| scene.stages())?,
    }
    Ok(ExitCode::SUCCESS)
}

fn tell<T: HostScalar>(
    args: &NeedsArgs,
    needs: impl Fn(&scanray::Scene<'_, T>) -> Stages,
) -> Result<(), Failure> {
    let settings = args.picture.settings()?;
    let source = SceneSource::named(args.scene.as_deref());
    let mut pools = T::pools();
    source.load(&mut pools)?;
    let scene = pools.as_scene();
    let Resolution { width, .. } = settings.resolution(scene.resolution());
    let memory = DeviceMemory::of(&scene, settings.max_depth);
    let needs = needs(&scene);
    let cutoff = settings.knobs.cutoff;
    let with_cutoff = if cutoff > 0.0 {
        format!(".with_cutoff({cutoff:?})")
    } else {
        String::new()
    };
    let pools_type = memory.pools_type(T::NAME);
    let report = Report {
        scene: source.data_name(),
        objects: scene.object_count(),
        scalar: T::NAME,
        max_depth: settings.max_depth,
        cutoff,
        stages: needs.names().collect(),
        width,
        rows: rows(width),
        source: format!(
            "let mut pools: {pools_type} = ScenePools::new();\nlet tracer = {}{with_cutoff};",
            memory.tracer_expression(settings.max_depth)
        ),
        pools_type,
        declaration: memory.declaration(needs, T::NAME),
        memory,
    };
    let color = name_of(settings.color);
    print(|out| {
        if args.json {
            serde_json::to_writer(&mut *out, &report)?;
            writeln!(out)
        } else {
            report.write(out, &color)
        }
    })
}

/// A row of each colour.
fn rows(width: u16) -> Vec<Row> {
    let bytes = |color| with_color!(color, C => size_of::<C>() * usize::from(width));
    let colors = ColorName::value_variants().iter();
    let row = |color: &ColorName| Row {
        color: name_of(*color),
        bytes: bytes(*color),
    };
    colors.map(row).collect()
}

impl Report {
    /// For people.
    fn write(&self, out: &mut dyn Write, color: &str) -> io::Result<()> {
        let memory = &self.memory;
        let plural = if self.objects == 1 { "" } else { "s" };
        writeln!(
            out,
            "{}: {} object{plural}",
            shown(&self.scene),
            self.objects
        )?;
        writeln!(out, "stages: {}", self.stages.join(", "))?;

        writeln!(
            out,
            "\n{:<14}{:>7} {:>6} {:>8}",
            "scene", "entries", "each", "bytes"
        )?;
        for pool in memory.pools.iter().filter(|pool| pool.entries > 0) {
            write!(
                out,
                "{:<14}{:>7} {:>6} {:>8}",
                pool.pool, pool.entries, pool.bytes_each, pool.bytes
            )?;
            let note = if pool.for_speed_alone {
                "  for speed: 0 gives the same picture"
            } else {
                ""
            };
            writeln!(out, "{note}")?;
        }
        write_line(out, "camera, background, …", memory.settings, "")?;
        write_line(
            out,
            "ScenePools",
            memory.scene_pools,
            "all of these and the pools' lengths, in RAM",
        )?;
        write_line(
            out,
            "or baked",
            memory.baked,
            "all of it in flash, and no RAM: scanray bake",
        )?;

        writeln!(out, "\n{:<28} {:>8}", "renderer", "bytes")?;
        write_line(out, "Tracer", memory.tracer, "")?;
        let frames = format!("{} frames of {}", self.max_depth, memory.stack_frame);
        write_line(
            out,
            &frames,
            memory.stack,
            "one a depth, on the call stack while a pixel is traced",
        )?;
        if self.cutoff > 0.0 {
            write_line(
                out,
                "cut-off",
                memory.cutoff_stack,
                "more on the call stack: a factor a depth",
            )?;
        }
        write_line(out, "Frame", memory.frame, "to draw in instalments")?;
        for row in self.rows.iter().filter(|row| row.color == color) {
            let name = format!("row of {} {color}", self.width);
            write_line(
                out,
                &name,
                row.bytes,
                "for Frame or DMA; Picture::draw needs none",
            )?;
        }

        let by_color: Vec<_> = self
            .rows
            .iter()
            .map(|row| format!("{} {}", row.color, row.bytes))
            .collect();
        writeln!(
            out,
            "\nrow of {} by colour: {}",
            self.width,
            by_color.join(", ")
        )?;
        writeln!(out, "\n{}", self.source)?;
        writeln!(
            out,
            "\nor by name, without what the scene does not need (let tracer = pools.tracer();):\n{}",
            self.declaration
        )
    }
}

fn write_line(out: &mut dyn Write, name: &str, bytes: usize, what: &str) -> io::Result<()> {
    let separator = if what.is_empty() { "" } else { "  " };
    writeln!(out, "{name:<28} {bytes:>8}{separator}{what}")
}
