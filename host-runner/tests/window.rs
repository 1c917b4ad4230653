//! The window, on a virtual screen whose memory is read: `cargo test -p scanray-host --features window`
//!
//! `BLESS=1` writes the screen shot that the README shows.
#![cfg(all(target_os = "linux", feature = "window"))]

use std::io::{Read, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use tempfile::TempDir;

const PATIENCE: Duration = Duration::from_secs(60);

/// A virtual screen.
struct Screen {
    server: Child,
    display: String,
    folder: TempDir,
}

/// Pixels of something.
#[derive(Clone, PartialEq, Eq)]
struct Picture {
    width: usize,
    height: usize,
    rgb888: Vec<u8>,
}

impl Screen {
    /// None where there is no Xvfb.
    fn new() -> Option<Self> {
        let folder = tempfile::tempdir().unwrap();
        let server = Command::new("Xvfb")
            .args([
                "-displayfd",
                "1",
                "-screen",
                "0",
                "1000x760x24",
                "-nolisten",
                "tcp",
            ])
            .arg("-fbdir")
            .arg(folder.path())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn();
        let Ok(mut server) = server else {
            // The test harness hides what is printed.
            let _ = writeln!(
                std::io::stderr(),
                "not run, because Xvfb is not installed: apt-get install xvfb"
            );
            return None;
        };
        let mut number = String::new();
        let mut stdout = server.stdout.take().unwrap();
        while !number.ends_with('\n') {
            let mut byte = [0];
            assert_eq!(stdout.read(&mut byte).unwrap(), 1, "Xvfb ended");
            number.push(byte[0].into());
        }
        Some(Self {
            server,
            display: format!(":{}", number.trim()),
            folder,
        })
    }

    /// The program on this screen, which starts anew when a program leaves it: one program for each screen.
    fn run(&self, arguments: &[&str]) -> Child {
        Command::new(env!("CARGO_BIN_EXE_scanray"))
            .args(arguments)
            .env("DISPLAY", &self.display)
            .env_remove("SDL_VIDEODRIVER")
            .env_remove("WAYLAND_DISPLAY")
            .stderr(Stdio::piped())
            .spawn()
            .unwrap()
    }

    /// The middle of the screen, where windows open. The file is an X window dump.
    fn middle(&self, width: usize, height: usize) -> Picture {
        let dump = std::fs::read(self.folder.path().join("Xvfb_screen0")).unwrap();
        let field = |index: usize| {
            let bytes = dump[4 * index..][..4].try_into().unwrap();
            u32::from_be_bytes(bytes) as usize
        };
        let (header, screen_width, screen_height) = (field(0), field(4), field(5));
        let (is_big_endian, bits, line_bytes, colors) = (field(7), field(11), field(12), field(19));
        assert_eq!((is_big_endian, bits), (0, 32));
        let pixels = &dump[header + 12 * colors..];
        let (left, top) = ((screen_width - width) / 2, (screen_height - height) / 2);
        let mut rgb888 = Vec::new();
        for y in top..top + height {
            for x in left..left + width {
                let pixel = &pixels[y * line_bytes + 4 * x..][..3];
                rgb888.extend(pixel.iter().rev());
            }
        }
        Picture {
            width,
            height,
            rgb888,
        }
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

impl Picture {
    fn row(&self, y: usize) -> &[u8] {
        &self.rgb888[3 * self.width * y..][..3 * self.width]
    }

    /// Each pixel as a square.
    fn scaled(&self, scale: usize) -> Self {
        let mut rgb888 = Vec::new();
        for y in 0..self.height * scale {
            for pixel in self.row(y / scale).chunks_exact(3) {
                rgb888.extend(pixel.repeat(scale));
            }
        }
        Self {
            width: self.width * scale,
            height: self.height * scale,
            rgb888,
        }
    }

    /// The rows that are not black.
    fn drawn_rows(&self) -> usize {
        let is_drawn = |y: &usize| self.row(*y).iter().any(|level| *level != 0);
        (0..self.height).filter(is_drawn).count()
    }

    fn write_png(&self, path: &Path) {
        let file = std::fs::File::create(path).unwrap();
        let mut encoder = png::Encoder::new(file, self.width as u32, self.height as u32);
        encoder.set_color(png::ColorType::Rgb);
        let mut writer = encoder.write_header().unwrap();
        writer.write_image_data(&self.rgb888).unwrap();
    }
}

fn scene(name: &str) -> String {
    format!("{}/../scenes/{name}.txt", env!("CARGO_MANIFEST_DIR"))
}

/// What render draws.
fn drawn(options: &[&str]) -> Picture {
    let output = Command::new(env!("CARGO_BIN_EXE_scanray"))
        .args([&["render", "-o", "-"], options].concat())
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&output.stdout[..20]);
    let size = text.lines().nth(1).unwrap();
    let (width, height) = size.split_once(' ').unwrap();
    let (width, height): (usize, usize) = (width.parse().unwrap(), height.parse().unwrap());
    let header = output.stdout.len() - 3 * width * height;
    Picture {
        width,
        height,
        rgb888: output.stdout[header..].to_vec(),
    }
}

/// Looks at the window until it is as it should be.
#[track_caller]
fn wait_until(screen: &Screen, size: [usize; 2], is_so: impl Fn(&Picture) -> bool) -> Picture {
    let start = Instant::now();
    loop {
        let shown = screen.middle(size[0], size[1]);
        if is_so(&shown) {
            return shown;
        }
        let rows = shown.drawn_rows();
        assert!(
            start.elapsed() < PATIENCE,
            "never so; {rows} rows are drawn"
        );
        std::thread::sleep(Duration::from_millis(15));
    }
}

fn end(mut program: Child) {
    let kill = Command::new("kill").arg(program.id().to_string()).status();
    assert!(kill.unwrap().success());
    assert_eq!(program.wait().unwrap().code(), Some(0));
}

#[test]
fn shows_the_display_row_by_row() {
    let Some(screen) = Screen::new() else { return };
    let path = scene("reflective");
    let display = [&*path, "--display", "st7789"];
    let whole = drawn(&display).scaled(2);
    let size = [whole.width, whole.height];
    let program = screen.run(
        &[
            &["window"],
            &display[..],
            &["--scale", "2", "--speed", "10ms"],
        ]
        .concat(),
    );
    // What is drawn is drawn from above; the rest is black as yet.
    let partly = wait_until(&screen, size, |shown| shown.drawn_rows() > whole.height / 2);
    let rows = partly.drawn_rows();
    assert!(rows < whole.height, "{rows}");
    let upper = 3 * whole.width * rows;
    assert!(partly.rgb888[..upper] == whole.rgb888[..upper]);
    assert!(partly.rgb888[upper..].iter().all(|level| *level == 0));
    wait_until(&screen, size, |shown| *shown == whole);
    end(program);
    if std::env::var_os("BLESS").is_some_and(|bless| bless == "1") {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/window.png");
        partly.write_png(Path::new(path));
    }
}

#[test]
fn few_colours_and_large_pixels_by_the_speed_of_a_core() {
    let Some(screen) = Screen::new() else { return };
    let path = scene("default");
    let display = [&*path, "--display", "ssd1306"];
    let whole = drawn(&display).scaled(7);
    let size = [whole.width, whole.height];
    let mut program = screen.run(
        &[
            &["window"],
            &display[..],
            &["--target", "m4f", "--clock", "168MHz"],
        ]
        .concat(),
    );
    wait_until(&screen, size, |shown| *shown == whole);
    let mut stderr = program.stderr.take().unwrap();
    end(program);
    let mut said = String::new();
    stderr.read_to_string(&mut said).unwrap();
    assert!(said.contains("on 128x64 takes 0."), "{said}");
    assert!(
        said.contains(" ms a row on average; its instructions are predicted within "),
        "{said}"
    );
}

/// The command lines of the help text.
fn examples() -> Vec<String> {
    let help = Command::new(env!("CARGO_BIN_EXE_scanray"))
        .args(["window", "--help"])
        .output()
        .unwrap();
    let help = String::from_utf8(help.stdout).unwrap();
    let lines = help.lines().map(str::trim);
    let lines = lines.filter(|line| line.starts_with("scanray window "));
    let commands = lines.filter_map(|line| line.split("  ").next());
    commands.map(str::to_owned).collect()
}

#[test]
fn every_example_opens_a_window() {
    let examples = examples();
    assert_eq!(examples.len(), 4, "{examples:?}");
    for example in examples {
        let Some(screen) = Screen::new() else { return };
        let path = scene("reflective");
        let words: Vec<&str> = example.split(' ').skip(1).collect();
        let words: Vec<&str> = words
            .into_iter()
            .map(|word| if word == "scene.txt" { &*path } else { word })
            .collect();
        let program = screen.run(&words);
        // Its first rows, in the middle of the upper half.
        wait_until(&screen, [8, 300], |shown| shown.drawn_rows() > 0);
        end(program);
        wait_until(&screen, [8, 300], |shown| shown.drawn_rows() == 0);
    }
}

#[test]
fn a_window_without_memory_is_refused() {
    let Some(screen) = Screen::new() else { return };
    let program = format!(
        "ulimit -v 3000000; exec '{}' window --size 60000x60000",
        env!("CARGO_BIN_EXE_scanray")
    );
    let output = Command::new("sh")
        .args(["-c", &program])
        .env("DISPLAY", &screen.display)
        .env("SDL_VIDEODRIVER", "x11")
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(4), "{said}");
    assert!(
        said.contains("GB of memory, more than there is: give a smaller"),
        "{said}"
    );
}

#[test]
fn wrong_use_is_told() {
    for (code, arguments, words) in [
        (
            2,
            &["window"][..],
            "cannot open a window: there is no graphical display",
        ),
        (2, &["window", "--speed", "3"], "such as 3ms or 800us"),
        (2, &["window", "--target", "m4f"], "--clock <MHz>"),
        (2, &["window", "--clock", "8MHz"], "--target <CORE>"),
        (
            2,
            &["window", "--target", "m4f", "--clock", "1GHz"],
            "such as 168MHz",
        ),
        (4, &["window", "missing.txt"], "cannot read missing.txt"),
    ] {
        let output = Command::new(env!("CARGO_BIN_EXE_scanray"))
            .args(arguments)
            .env_remove("SDL_VIDEODRIVER")
            .env("DISPLAY", ":12345")
            .env_remove("WAYLAND_DISPLAY")
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {said}");
        assert!(said.contains(words), "{arguments:?}: {said}");
        assert!(!said.contains("panicked"), "{said}");
    }
}
