//! `scanray window`: the display in a window, drawn as slowly as a device draws.

use std::panic::{self, AssertUnwindSafe};
use std::path::PathBuf;
use std::process::ExitCode;
use std::str::FromStr;
use std::time::{Duration, Instant};

use clap::Args;
use embedded_graphics::Pixel;
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics_simulator::sdl2::Keycode;
use embedded_graphics_simulator::{
    OutputSettingsBuilder, SimulatorDisplay, SimulatorEvent, Window,
};
use scanray::{Picture, Resolution, Scene, render::Quantizer};
use sdl2::VideoSubsystem;

use crate::console::{print, say};
use crate::cost::{Core, MODEL};
use crate::displays;
use crate::failure::Failure;
use crate::host_pixels::Drawing;
use crate::host_tracer::HostTracer;
use crate::option_values::{ScalarName, with_color};
use crate::parallel_drawing::Workers;
use crate::picture_memory::require;
use crate::pools::HostScalar;
use crate::render_settings::{PictureArgs, PictureSettings};
use crate::scene_file::SceneSource;

/// The command line.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  scanray window scene.txt --display st7789               a row every 3 ms
  scanray window scene.txt --display ssd1306 --scale 8    large pixels
  scanray window scene.txt --speed 20000px/s              a bus or a core of that speed
  scanray window scene.txt --display st7789 --target m4f --clock 168MHz
                                                          each row as long as that core takes

Space draws again; q, Escape or closing the window quits.")]
pub(crate) struct WindowArgs {
    /// Scene file, `-` for standard input; the default scene if there is none
    #[arg(value_name = "SCENE")]
    scene: Option<PathBuf>,

    #[command(flatten)]
    picture: PictureArgs,

    /// Time that each row takes, such as 3ms or 800us, or pixels a second, such as 20000px/s
    #[arg(long, value_name = "SPEED", default_value = "3ms")]
    speed: Speed,

    /// Let each row take what it takes this core by the model that `scanray report` uses, at one
    /// instruction a cycle, tracing alone
    #[arg(
        long,
        value_name = "CORE",
        conflicts_with = "speed",
        requires = "clock"
    )]
    target: Option<Core>,

    /// Clock of the core, such as 168MHz
    #[arg(long, value_name = "MHz", requires = "target", value_parser = megahertz)]
    clock: Option<f64>,

    /// Pixels of the screen for a pixel of the display, each way [default: as many as fit 960x720]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=32))]
    scale: Option<u32>,
}

/// How fast a device is.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Speed {
    /// The time of a row.
    Row(Duration),
    /// Pixels a second.
    Pixels(f64),
}

/// The window is shown anew about as often.
const FRAME_TIME: Duration = Duration::from_millis(16);

/// No row takes longer.
const LONGEST_ROW: Duration = Duration::from_secs(60);

impl FromStr for Speed {
    type Err = String;

    fn from_str(word: &str) -> Result<Self, String> {
        let number = |unit: &str| -> Option<f64> {
            let digits = word.strip_suffix(unit)?;
            digits
                .parse()
                .ok()
                .filter(|n: &f64| n.is_finite() && *n >= 0.0)
        };
        let row = |seconds: f64| (seconds <= LONGEST_ROW.as_secs_f64()).then_some(seconds);
        let seconds = |unit, factor| number(unit).map(|n| n * factor).and_then(row);
        let speed = if let Some(pixels) = number("px/s") {
            (pixels >= 0.1).then_some(Self::Pixels(pixels))
        } else {
            seconds("us", 1e-6)
                .or_else(|| seconds("ms", 1e-3))
                .or_else(|| seconds("s", 1.0))
                .map(|seconds| Self::Row(Duration::from_secs_f64(seconds)))
        };
        speed.ok_or_else(|| {
            "give the time of a row up to 60s, such as 3ms or 800us, or pixels a second, such as 20000px/s"
                .to_owned()
        })
    }
}

/// A clock in megahertz.
///
/// # Errors
///
/// A sentence.
fn megahertz(word: &str) -> Result<f64, String> {
    let digits = word.strip_suffix("MHz").unwrap_or(word);
    digits
        .parse()
        .ok()
        .filter(|clock| (0.01..=10_000.0).contains(clock))
        .ok_or_else(|| "give megahertz from 0.01 to 10000, such as 168MHz".to_owned())
}

/// Shows the picture.
///
/// # Errors
///
/// [`Failure`].
pub(crate) fn run(args: &WindowArgs) -> Result<ExitCode, Failure> {
    if args.picture.wants_list() {
        return print(displays::write_list).map(|()| ExitCode::SUCCESS);
    }
    let scene = SceneSource::named(args.scene.as_deref());
    let settings = args.picture.settings()?;
    match settings.scalar {
        ScalarName::F32 => show::<f32>(args, &scene, &settings)?,
        ScalarName::F64 => show::<f64>(args, &scene, &settings)?,
    }
    Ok(ExitCode::SUCCESS)
}

fn show<T: HostScalar + Drawing>(
    args: &WindowArgs,
    source: &SceneSource,
    settings: &PictureSettings,
) -> Result<(), Failure> {
    let mut pools = T::pools();
    source.load(&mut pools)?;
    let scene: Scene<'_, T> = pools.as_scene();
    let resolution = settings.resolution(scene.resolution());
    let tracer = HostTracer::new(scene, resolution, settings.max_depth)?.with_knobs(settings.knobs);
    let times = args.row_times(&tracer, resolution)?;
    let total: Duration = times.iter().sum();
    say(format_args!(
        "{} on {}x{} takes {:.3} s, {:.3} ms a row on average{}.",
        source.name(),
        resolution.width,
        resolution.height,
        total.as_secs_f64(),
        1e3 * total.as_secs_f64() / f64::from(resolution.height),
        args.target.map_or(String::new(), |core| {
            let within = MODEL.within_percent()[core as usize];
            format!("; its instructions are predicted within {within} %")
        })
    ));
    let pixels = T::pixels(&tracer);
    let title = format!("scanray: {}", source.name());
    with_color!(settings.color, C => {
        let picture = Picture::<_, scanray::render::Exact<C>>::new(&pixels);
        if settings.dither {
            let picture = picture.dithered();
            animate(&title, resolution, args.scale, &times, |y| row(&picture, y))
        } else {
            animate(&title, resolution, args.scale, &times, |y| row(&picture, y))
        }
    })
}

/// A row as the display shows it.
fn row<
    P: scanray::render::PixelSource,
    Q: Quantizer<Color: scanray::render::DisplayColor + Into<Rgb888>>,
>(
    picture: &Picture<P, Q>,
    y: u16,
) -> Vec<Rgb888> {
    let black = scanray::Color::<f32>::BLACK;
    let black = <Q::Color as scanray::render::DisplayColor>::from_linear(black, 0.5);
    let mut row = vec![black; usize::from(picture.resolution().width)];
    picture.row(0, y, &mut row);
    row.into_iter().map(Into::into).collect()
}

impl WindowArgs {
    /// What each row takes.
    fn row_times<T: HostScalar + Drawing>(
        &self,
        tracer: &HostTracer<'_, T>,
        resolution: Resolution,
    ) -> Result<Vec<Duration>, Failure> {
        let width = f64::from(resolution.width);
        let (Some(core), Some(clock)) = (self.target, self.clock) else {
            let time = match self.speed {
                Speed::Row(time) => time,
                Speed::Pixels(rate) => Duration::from_secs_f64(width / rate).min(LONGEST_ROW),
            };
            return Ok(vec![time; usize::from(resolution.height)]);
        };
        let workers = Workers::new(None)?;
        let time = |y: u16| {
            let work = tracer.count_work(y..y + 1, &workers);
            let instructions = MODEL.instructions_per_pixel(&work);
            let cycles = width * instructions[core as usize];
            Duration::from_secs_f64((cycles / (clock * 1e6)).max(0.0)).min(LONGEST_ROW)
        };
        Ok((0..resolution.height).map(time).collect())
    }
}

/// Opens a window and draws row by row, each when its time has come, until the window is closed.
fn animate(
    title: &str,
    resolution: Resolution,
    scale: Option<u32>,
    times: &[Duration],
    row: impl Fn(u16) -> Vec<Rgb888>,
) -> Result<(), Failure> {
    let [width, height] = [resolution.width, resolution.height].map(u32::from);
    let fitting = (960 / width).min(720 / height).clamp(1, 32);
    let scale = scale.unwrap_or(fitting);
    let settings = OutputSettingsBuilder::new().scale(scale).build();
    // The display, and the screen's pixels, which the simulator and SDL have once each.
    let bytes = u64::from(width) * u64::from(height) * (3 + 2 * 4 * u64::from(scale).pow(2));
    require(
        bytes,
        format_args!("a window of {width}x{height} pixels, each {scale}x{scale} on the screen,"),
        "give a smaller --size or --scale",
    )?;
    let mut display = SimulatorDisplay::<Rgb888>::new(Size::new(width, height));
    let mut window = open(title, &settings, &display)?;
    let (mut start, mut next, mut due) = (Instant::now(), 0, Duration::ZERO);
    loop {
        let frame = Instant::now();
        while let Some(time) = times.get(usize::from(next))
            && start.elapsed() >= due + *time
            // Where the host is slower than the device, the window answers nevertheless.
            && frame.elapsed() < FRAME_TIME
        {
            let pixels = (0..).zip(row(next));
            let pixels = pixels.map(|(x, color)| Pixel(Point::new(x, next.into()), color));
            let Ok(()) = display.draw_iter(pixels);
            due += *time;
            next += 1;
        }
        window.update(&display);
        for event in window.events() {
            match event {
                SimulatorEvent::Quit
                | SimulatorEvent::KeyDown {
                    keycode: Keycode::Q,
                    ..
                } => return Ok(()),
                // As on the device: over the picture that is there.
                SimulatorEvent::KeyDown {
                    keycode: Keycode::Space,
                    ..
                } => (start, next, due) = (Instant::now(), 0, Duration::ZERO),
                _ => {}
            }
        }
    }
}

/// Opens the window. The simulator panics where it cannot, which is turned into an error here.
fn open(
    title: &str,
    settings: &embedded_graphics_simulator::OutputSettings,
    display: &SimulatorDisplay<Rgb888>,
) -> Result<Window, Failure> {
    // Held until the window has it too: a display that nobody uses may vanish in between, as an X server's that starts anew.
    let _screen = screen().ok_or_else(no_display)?;
    let hook = panic::take_hook();
    panic::set_hook(Box::new(|_| {}));
    let window = panic::catch_unwind(AssertUnwindSafe(|| {
        let mut window = Window::new(title, settings);
        window.update(display);
        window
    }));
    panic::set_hook(hook);
    window.map_err(|_| no_display())
}

/// Where SDL shows windows to somebody. Without a display it takes a driver that shows them to nobody, which
/// is wanted only where the user has named it.
fn screen() -> Option<VideoSubsystem> {
    let video = sdl2::init().and_then(|sdl| sdl.video()).ok()?;
    let is_named = std::env::var_os("SDL_VIDEODRIVER").is_some_and(|name| !name.is_empty());
    let is_hidden = ["offscreen", "dummy", "evdev"].contains(&video.current_video_driver());
    (is_named || !is_hidden).then_some(video)
}

fn no_display() -> Failure {
    Failure::Usage(
        "cannot open a window: there is no graphical display here (is DISPLAY set?), or the picture is \
         too large for it; scanray view shows it in the terminal"
            .to_owned(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn speeds() {
        let speed = |word: &str| word.parse::<Speed>().ok();
        let row = |micros| Some(Speed::Row(Duration::from_micros(micros)));
        assert_eq!(speed("3ms"), row(3000));
        assert_eq!(speed("0.5s"), row(500_000));
        assert_eq!(speed("800us"), row(800));
        assert_eq!(speed("0ms"), row(0));
        assert_eq!(speed("20000px/s"), Some(Speed::Pixels(20_000.0)));
        for word in ["", "3", "ms", "-1ms", "61s", "infs", "0px/s", "3 m"] {
            assert_eq!(speed(word), None, "{word}");
        }
        assert_eq!(megahertz("168MHz"), Ok(168.0));
        assert_eq!(megahertz("16"), Ok(16.0));
        for word in ["", "0", "-1MHz", "1GHz", "nan"] {
            assert!(megahertz(word).is_err(), "{word}");
        }
    }
}
