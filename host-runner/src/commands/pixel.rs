//! `scanray pixel`: how the colours of pixels come about.

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;
use std::str::FromStr;

use clap::Args;
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use scanray::{Picture, Resolution, render::DisplayColor};

use crate::console::print;
use crate::displays;
use crate::failure::Failure;
use crate::host_tracer::HostTracer;
use crate::option_values::{ScalarName, name_of, with_color};
use crate::pools::HostScalar;
use crate::ray_tree::{
    Names, PixelHeader, PixelReport, RayTree, Samples, color_digits, write_rays,
};
use crate::render_settings::{PictureArgs, PictureSettings};
use crate::scene_file::SceneSource;
use crate::scene_lines::object_lines;

/// The command line.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  scanray pixel scene.txt 4,3                why the pixel in column 4, row 3 has its colour
  scanray pixel scene.txt 0,0 7,5 --json     two pixels, one line of JSON for each
  scanray pixel scenes/pyramids.txt 80,64 --display st7735 --max-depth 2
                                             with settings as for render

Columns count from 0 at the left, rows from 0 at the top. Numbers have the fewest digits that read \
back to the same bits. Each ray tells its hit, then its secondary rays, then its result: the local \
colour and the secondary rays' results times their factors, clamped to 0…1.")]
pub(crate) struct PixelArgs {
    /// Scene file, `-` for standard input
    #[arg(value_name = "SCENE", required_unless_present = "display")]
    scene: Option<PathBuf>,

    /// Columns and rows of pixels
    #[arg(value_name = "X,Y", required_unless_present = "display")]
    pixels: Vec<PixelPlace>,

    #[command(flatten)]
    picture: PictureArgs,

    /// Print JSON, one line for each pixel
    #[arg(long)]
    json: bool,
}

/// `X,Y`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct PixelPlace {
    x: u16,
    y: u16,
}

impl FromStr for PixelPlace {
    type Err = String;

    fn from_str(word: &str) -> Result<Self, String> {
        word.split_once(',')
            .and_then(|(x, y)| {
                Some(Self {
                    x: x.parse().ok()?,
                    y: y.parse().ok()?,
                })
            })
            .ok_or_else(|| "give column and row from 0 to 65535, such as 80,60".to_owned())
    }
}

/// Tells how the pixels come about.
///
/// # Errors
///
/// [`Failure`].
pub(crate) fn run(args: &PixelArgs) -> Result<ExitCode, Failure> {
    if args.picture.wants_list() {
        return print(displays::write_list).map(|()| ExitCode::SUCCESS);
    }
    let settings = args.picture.settings()?;
    match settings.scalar {
        ScalarName::F32 => tell::<f32>(args, &settings)?,
        ScalarName::F64 => tell::<f64>(args, &settings)?,
    }
    Ok(ExitCode::SUCCESS)
}

fn tell<T: HostScalar>(args: &PixelArgs, settings: &PictureSettings) -> Result<(), Failure> {
    // Only the list of displays needs neither.
    let (Some(path), [_, ..]) = (&args.scene, &*args.pixels) else {
        return Err(Failure::Usage(
            "name a scene and its pixels, such as scanray pixel scene.txt 4,3".to_owned(),
        ));
    };
    let source = SceneSource::named(Some(path));
    let text = source.read()?;
    let mut pools = T::pools();
    source.load_text(&text, &mut pools)?;
    let scene = pools.as_scene();
    let size = settings.resolution(scene.resolution());
    for PixelPlace { x, y } in &args.pixels {
        let Resolution { width, height } = size;
        if *x >= width || *y >= height {
            return Err(Failure::Usage(format!(
                "there is no pixel {x},{y}: the picture is {width}x{height}, its last pixel {},{}",
                width - 1,
                height - 1
            )));
        }
    }
    let tracer = HostTracer::new(scene, size, settings.max_depth)?.with_knobs(settings.knobs);
    let lines = object_lines(&text);
    let file = match args.json {
        true => source.data_name(),
        false => source.name(),
    };
    let names = Names {
        scene: &scene,
        file: &file,
        lines: &lines,
        max_depth: settings.max_depth,
    };
    print(|out| {
        for PixelPlace { x, y } in &args.pixels {
            let mut tree = RayTree::new();
            // The rays of the pixel that its block repeats.
            let block = settings.knobs.detail.block();
            let traced = [x - x % block, y - y % block];
            let linear = tracer.pixel_observed(traced[0], traced[1], &mut tree);
            let rays = tree.into_primary_rays();
            let header = PixelHeader {
                size,
                place: [*x, *y],
                traced,
                samples: Samples::of(&settings.knobs, rays.len()),
                linear,
                shown: with_color!(settings.color, C => shown::<T, C>(&tracer, [*x, *y], settings.dither)),
                color: name_of(settings.color),
                dither: settings.dither,
            };
            if args.json {
                serde_json::to_writer(&mut *out, &PixelReport::new(&header, &rays, &names))?;
                writeln!(out)?;
            } else {
                write_header(out, &header, &file)?;
                for ray in &rays {
                    write_rays(out, ray, &names)?;
                }
            }
        }
        Ok(())
    })
}

/// What a display shows at a pixel.
fn shown<T: HostScalar, C: DisplayColor + Into<Rgb888>>(
    tracer: &HostTracer<'_, T>,
    [x, y]: [u16; 2],
    dither: bool,
) -> [u8; 3] {
    let picture = Picture::new(tracer);
    let color: C = if dither {
        picture.dithered().pixel(x, y)
    } else {
        picture.pixel(x, y)
    };
    let color: Rgb888 = color.into();
    [color.r(), color.g(), color.b()]
}

fn write_header<T: HostScalar>(
    out: &mut dyn Write,
    header: &PixelHeader<T>,
    file: &str,
) -> io::Result<()> {
    let [x, y] = header.place;
    let [r, g, b] = header.shown;
    writeln!(
        out,
        "{file}, {}x{}, pixel {x},{y}",
        header.size.width, header.size.height
    )?;
    writeln!(out, "linear        {}", color_digits(header.linear))?;
    match header.samples {
        Samples::One => {}
        Samples::Mean { of } => writeln!(out, "samples       {of}, whose mean is the colour")?,
        Samples::CentreAlone => {
            writeln!(out, "samples       the centre: no neighbour differs enough")?
        }
        Samples::Edge { of } => writeln!(
            out,
            "samples       the centre, which differs from a neighbour, then {of}, whose mean is the colour"
        )?,
    }
    if header.traced != header.place {
        let [x, y] = header.traced;
        writeln!(out, "block         shows the pixel {x},{y}")?;
    }
    let dither = if header.dither { ", dithered" } else { "" };
    writeln!(
        out,
        "shown         {r} {g} {b} (#{r:02x}{g:02x}{b:02x}) as {}{dither}",
        header.color
    )
}
