//! `scanray view`: the picture in the terminal.

mod cells;
mod message;
mod screen;
mod terminal;
mod watch;

use std::borrow::Cow;
use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::{Duration, Instant};

use annotate_snippets::Renderer;
use clap::Args;
use crossterm::event::{self, Event, KeyCode, KeyEventKind, KeyModifiers};
use scanray::{
    Color, Picture, Resolution, Scene,
    render::{Budget, Dithered, Exact, Progress, Progressive},
};

use self::cells::{Style, filling};
use self::screen::{Linear, Pixels, Screen, Shown, shown};
use self::terminal::{FullScreen, Output};
use self::watch::Watch;
use crate::console::print;
use crate::displays;
use crate::failure::Failure;
use crate::host_pixels::Drawing;
use crate::host_tracer::HostTracer;
use crate::interrupt;
use crate::option_values::{ColorName, ScalarName, with_color};
use crate::picture_memory::Shortage;
use crate::pools::{HostPools, HostScalar};
use crate::render_settings::{PictureArgs, PictureSettings};
use crate::scene_file::SceneSource;

/// The command line.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  scanray view scene.txt                     the picture, as large as the terminal
  scanray view scene.txt --display ssd1306   as a display shows it
  scanray view scene.txt | head -n 12        without colours where the output is no terminal

With --watch the picture is drawn again whenever the file is saved: open an editor beside it.

Two pixels a cell, in 24-bit colours where COLORTERM is truecolor, or else in 256; where the terminal has none, NO_COLOR \
is set or the output is no terminal, letters stand for bright and dark. A display that is larger than the terminal is \
averaged down. One of black and white is not: its pixels become the dots of braille characters, eight a cell, and if \
even these are too many the scene is drawn in fewer pixels.

q ends --watch; Ctrl-Z suspends it on Unix, and fg goes on.

Exit codes: 0 fine, also after q, 2 usage, 3 scene, 4 files or memory, 130 interrupted by Ctrl-C, 143 by kill.")]
pub(crate) struct ViewArgs {
    /// Scene file, `-` for standard input; the default scene if there is none
    #[arg(value_name = "SCENE")]
    scene: Option<PathBuf>,

    #[command(flatten)]
    picture: PictureArgs,

    /// Draw again whenever the file is saved; errors are shown below the last good picture; q quits
    #[arg(short, long)]
    watch: bool,
}

/// The terminal shows what is there so far this often.
const FRAME_TIME: Duration = Duration::from_millis(40);

/// Rays between two looks at the clock.
const INSTALMENT: Budget = Budget::Rays(2000);

/// Shows the picture.
///
/// # Errors
///
/// [`Failure`].
pub(crate) fn run(args: &ViewArgs) -> Result<ExitCode, Failure> {
    if args.picture.wants_list() {
        return print(displays::write_list).map(|()| ExitCode::SUCCESS);
    }
    let scene = SceneSource::named(args.scene.as_deref());
    let settings = args.picture.settings()?;
    match (args.watch, settings.scalar) {
        (false, ScalarName::F32) => show::<f32>(&scene, &settings),
        (false, ScalarName::F64) => show::<f64>(&scene, &settings),
        (true, ScalarName::F32) => watch::<f32>(&scene, &settings),
        (true, ScalarName::F64) => watch::<f64>(&scene, &settings),
    }
}

/// Why a picture is not finished.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stop {
    /// The program is to end.
    Quit,
    /// The program was interrupted, and ends with this code.
    Interrupted(u8),
    /// The picture is to be drawn anew: another scene or another size.
    Anew,
}

/// Draws a picture coarse to fine; `look` sees it now and then, and may stop it.
fn draw<T: HostScalar + Drawing>(
    scene: Scene<'_, T>,
    settings: &PictureSettings,
    pixels: &mut Pixels,
    look: &mut dyn FnMut(&Pixels) -> Result<Option<Stop>, Failure>,
) -> Result<Option<Stop>, Failure> {
    let resolution = Resolution {
        width: pixels.width as u16,
        height: pixels.height as u16,
    };
    let tracer = HostTracer::new(scene, resolution, settings.max_depth)?.with_knobs(settings.knobs);
    let shown: Shown = with_color!(settings.color, C => if settings.dither {
        shown::<T, Dithered<C>>
    } else {
        shown::<T, Exact<C>>
    });
    let mut screen = Screen::new(pixels, shown);
    let picture = Picture::<_, Exact<Linear>>::new(&tracer);
    let mut progressive = Progressive::of(&picture);
    let black = Color::<T>::new(T::ZERO, T::ZERO, T::ZERO);
    let mut row = vec![black; usize::from(picture.resolution().width)];
    let mut looked = Instant::now();
    loop {
        let Ok(progress) = progressive.draw(&picture, &mut screen, &mut row, INSTALMENT);
        if progress == Progress::Done {
            return Ok(None);
        }
        if looked.elapsed() > FRAME_TIME {
            if let Some(stop) = look(screen.pixels())? {
                return Ok(Some(stop));
            }
            looked = Instant::now();
        }
    }
}

/// How a picture is fitted into the cells of a terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Layout {
    /// The size that is asked for.
    asked: Resolution,
    /// The size to draw in.
    size: Resolution,
    /// The size to show.
    shown: Resolution,
    style: Style,
}

impl Layout {
    fn new(
        settings: &PictureSettings,
        own: Resolution,
        style: Style,
        columns: u16,
        lines: u16,
    ) -> Self {
        let asked = settings.size();
        let asked = asked.unwrap_or_else(|| filling(own, style, columns, lines));
        let as_it_is = Self {
            asked,
            size: asked,
            shown: asked,
            style,
        };
        if style.has_room(asked, columns, lines) {
            return as_it_is;
        }
        if settings.color != ColorName::Binary {
            return Self {
                shown: filling(asked, style, columns, lines),
                ..as_it_is
            };
        }
        // The mean of black and white pixels is a pattern of its own, which the display does not show.
        let style = match style {
            Style::Blocks(colors) => Style::Dots(colors),
            other => other,
        };
        let size = if style.has_room(asked, columns, lines) {
            asked
        } else {
            filling(asked, style, columns, lines)
        };
        Self {
            asked,
            size,
            shown: size,
            style,
        }
    }
}

/// The picture in the size to show it in.
fn fitted(pixels: &Pixels, shown: Resolution) -> Result<Cow<'_, Pixels>, Shortage> {
    let is_same = (pixels.width, pixels.height) == (shown.width.into(), shown.height.into());
    if is_same {
        Ok(Cow::Borrowed(pixels))
    } else {
        pixels.averaged(shown).map(Cow::Owned)
    }
}

/// Shows a scene once, below the command line.
fn show<T: HostScalar + Drawing>(
    source: &SceneSource,
    settings: &PictureSettings,
) -> Result<ExitCode, Failure> {
    let mut pools = T::pools();
    source.load(&mut pools)?;
    let scene = pools.as_scene();
    let output = Output::new();
    // The line below the picture is the next prompt's.
    let layout = Layout::new(
        settings,
        scene.resolution(),
        output.style,
        output.columns,
        output.lines - 1,
    );
    let mut pixels = Pixels::new(layout.size)?;
    let mut lines_above = 0;
    let mut write = |pixels: &Pixels| {
        let lines = cells::lines(&*fitted(pixels, layout.shown)?, layout.style);
        let up = match lines_above {
            0 => String::new(),
            above => format!("\x1b[{above}A"),
        };
        lines_above = lines.len();
        let mut stdout = io::stdout().lock();
        let text = up + &lines.join("\n") + "\n";
        let written = stdout.write_all(text.as_bytes());
        written
            .and_then(|()| stdout.flush())
            .map_err(|error| Failure::stdout(&error))
    };
    let is_live = output.is_terminal && output.style != Style::Letters;
    let stop = draw(scene, settings, &mut pixels, &mut |pixels| {
        if is_live {
            // From now on the program does not end in the middle of a line, which would leave its colours
            // behind.
            if let Some(code) = interrupt::exit_code() {
                return Ok(Some(Stop::Interrupted(code)));
            }
            write(pixels)?;
        }
        Ok(None)
    })?;
    if let Some(Stop::Interrupted(code)) = stop {
        return Ok(ExitCode::from(code));
    }
    write(&pixels)?;
    Ok(ExitCode::SUCCESS)
}

/// Shows a scene in the whole terminal, and again whenever its file is saved.
fn watch<T: HostScalar + Drawing>(
    source: &SceneSource,
    settings: &PictureSettings,
) -> Result<ExitCode, Failure> {
    let SceneSource::File(path) = source else {
        return Err(Failure::Usage(format!(
            "--watch: {} cannot be saved; name a scene file, such as scanray view scene.txt --watch",
            source.name()
        )));
    };
    let output = Output::new();
    if !output.is_terminal || output.is_dumb {
        let why = match output.is_dumb {
            true => " that can place the cursor, and TERM=dumb is none",
            false => "",
        };
        return Err(Failure::Usage(format!(
            "--watch needs a terminal{why}; leave it out to print the picture once"
        )));
    }
    let file = Watch::new(path);
    let text = source.read()?;
    interrupt::exit_code();
    let terminal = FullScreen::enter().map_err(|error| Failure::stdout(&error))?;
    let mut session = Session {
        source,
        settings,
        terminal,
        output,
        file,
        text: Ok(text),
        picture: None,
        style: output.style,
        message: Vec::new(),
    };
    let mut pools = T::pools();
    loop {
        let stop = match session.draw(&mut pools)? {
            Some(stop) => stop,
            None => session.wait()?,
        };
        match stop {
            Stop::Quit => return Ok(ExitCode::SUCCESS),
            Stop::Interrupted(code) => return Ok(ExitCode::from(code)),
            Stop::Anew => {}
        }
    }
}

/// What is on the terminal.
struct Session<'a> {
    source: &'a SceneSource,
    settings: &'a PictureSettings,
    terminal: FullScreen,
    output: Output,
    file: Watch,
    /// The text of the scene, or why it cannot be read.
    text: Result<Vec<u8>, Vec<String>>,
    /// The last good picture, in the size that is shown.
    picture: Option<Pixels>,
    /// How it is shown.
    style: Style,
    /// What stands below it.
    message: Vec<String>,
}

impl Session<'_> {
    /// Draws the scene, or says why not.
    fn draw<T: HostScalar + Drawing>(
        &mut self,
        pools: &mut HostPools<T>,
    ) -> Result<Option<Stop>, Failure> {
        self.output = Output::new();
        let text = self.text.as_ref().map_err(Clone::clone);
        let parsed = text.and_then(|text| {
            let renderer = Renderer::plain().term_width(self.output.columns.into());
            let parsed = self.source.parse(text, pools, &renderer);
            parsed.map_err(|failure| message_lines(&failure))
        });
        let warning = match parsed {
            Ok(warning) => warning,
            Err(message) => {
                self.message = message;
                self.show()?;
                return Ok(None);
            }
        };
        let scene = pools.as_scene();
        let layout = Layout::new(
            self.settings,
            scene.resolution(),
            self.output.style,
            self.output.columns,
            self.output.lines.saturating_sub(1).max(1),
        );
        let start = Instant::now();
        let mut pixels = Pixels::new(layout.size)?;
        let status = |state: &str| {
            let name = self.source.name();
            let Layout { asked, shown, .. } = layout;
            let (width, height) = (asked.width, asked.height);
            let scale = if asked == shown {
                String::new()
            } else {
                format!(", shown as {}x{}", shown.width, shown.height)
            };
            format!("{name}  {width}x{height}{scale}  {state}  q quits")
        };
        self.message = vec![status("drawing")];
        let settings = self.settings;
        let stop = draw(scene, settings, &mut pixels, &mut |pixels| {
            self.style = layout.style;
            self.picture = Some(fitted(pixels, layout.shown)?.into_owned());
            self.show()?;
            self.stop(Duration::ZERO)
        })?;
        if stop.is_none() {
            let state = format!("{} ms", start.elapsed().as_millis());
            let warnings = warning.iter().flat_map(|lines| lines.lines());
            self.message = warnings
                .map(str::to_owned)
                .chain([status(&state)])
                .collect();
            self.style = layout.style;
            self.picture = Some(fitted(&pixels, layout.shown)?.into_owned());
            self.show()?;
        }
        Ok(stop)
    }

    /// Waits until there is something to do.
    fn wait(&mut self) -> Result<Stop, Failure> {
        loop {
            if let Some(stop) = self.stop(Duration::from_millis(30))? {
                return Ok(stop);
            }
        }
    }

    /// Whether to stop, after so much time at most.
    fn stop(&mut self, patience: Duration) -> Result<Option<Stop>, Failure> {
        let in_terminal = |error: io::Error| Failure::stdout(&error);
        let mut patience = patience;
        while event::poll(patience).map_err(in_terminal)? {
            patience = Duration::ZERO;
            match event::read().map_err(in_terminal)? {
                Event::Key(key) if key.kind != KeyEventKind::Release => {
                    let is_control = key.modifiers.contains(KeyModifiers::CONTROL);
                    match key.code {
                        KeyCode::Char('q') | KeyCode::Esc => return Ok(Some(Stop::Quit)),
                        KeyCode::Char('d') if is_control => return Ok(Some(Stop::Quit)),
                        // It is no signal here, but means the same.
                        KeyCode::Char('c') if is_control => {
                            return Ok(Some(Stop::Interrupted(130)));
                        }
                        KeyCode::Char('z') if is_control => {
                            self.terminal.suspend().map_err(in_terminal)?;
                            return Ok(Some(Stop::Anew));
                        }
                        _ => {}
                    }
                }
                Event::Resize(..) => return Ok(Some(Stop::Anew)),
                _ => {}
            }
        }
        if let Some(code) = interrupt::exit_code() {
            return Ok(Some(Stop::Interrupted(code)));
        }
        if self.terminal.is_taken_back().map_err(in_terminal)? {
            return Ok(Some(Stop::Anew));
        }
        if !self.file.may_have_changed() {
            return Ok(None);
        }
        let before = std::mem::replace(
            &mut self.text,
            self.source
                .read()
                .map_err(|failure| message_lines(&failure)),
        );
        Ok((self.text != before).then_some(Stop::Anew))
    }

    /// The picture and, over its last lines if need be, the message.
    fn show(&self) -> Result<(), Failure> {
        let [columns, rows] = [self.output.columns, self.output.lines].map(usize::from);
        let mut lines = match &self.picture {
            Some(pixels) => cells::lines(pixels, self.style),
            None => Vec::new(),
        };
        // The picture is what matters: most of it stays.
        let message = message::condensed(&self.message, columns, (rows / 3).clamp(1, 5));
        lines.truncate(rows - message.len().min(rows));
        lines.extend(message);
        self.terminal
            .show(&lines, self.output.lines)
            .map_err(|error| Failure::stdout(&error))
    }
}

/// What went wrong, line by line, without anything that a terminal would obey.
fn message_lines(failure: &Failure) -> Vec<String> {
    let words = failure.words();
    let clean = |line: &str| line.replace(char::is_control, "\u{fffd}");
    words.lines().map(clean).collect()
}
