//! Pictures in the terminal: the program runs on a pseudo-terminal, whose cells are read back as a picture.
#![cfg(unix)]

use std::io::{Read, Write};
use std::num::NonZero;
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use portable_pty::{Child, CommandBuilder, MasterPty, PtySize, native_pty_system};
use vt100::{Color, Parser};

use crate::program::{Folder, Picture, SMALL_SCENE, scene};

/// What may take long on a busy machine.
const PATIENCE: Duration = Duration::from_secs(60);

/// The program on a terminal.
struct Terminal {
    master: Box<dyn MasterPty + Send>,
    child: Box<dyn Child + Send + Sync>,
    output: Receiver<Vec<u8>>,
    parser: Parser,
    /// The terminal's modes before the program began.
    modes_before: String,
    /// All that was written.
    stream: Vec<u8>,
}

impl Terminal {
    fn new(
        folder: &Folder,
        arguments: &[&str],
        [columns, lines]: [u16; 2],
        no_color: bool,
    ) -> Self {
        let size = PtySize {
            rows: lines,
            cols: columns,
            pixel_width: 0,
            pixel_height: 0,
        };
        let pair = native_pty_system().openpty(size).unwrap();
        let mut command = CommandBuilder::new(env!("CARGO_BIN_EXE_scanray"));
        command.args(arguments);
        command.cwd(folder.path(""));
        command.env("TERM", "xterm-256color");
        command.env_remove("NO_COLOR");
        if no_color {
            command.env("NO_COLOR", "1");
        }
        let modes_before = modes(&*pair.master);
        let child = pair.slave.spawn_command(command).unwrap();
        let mut reader = pair.master.try_clone_reader().unwrap();
        let (sender, output) = channel();
        std::thread::spawn(move || {
            let mut buffer = [0; 1 << 14];
            while let Ok(count @ 1..) = reader.read(&mut buffer) {
                if sender.send(buffer[..count].to_vec()).is_err() {
                    break;
                }
            }
        });
        Self {
            master: pair.master,
            child,
            output,
            modes_before,
            parser: Parser::new(count(lines), count(columns), 0),
            stream: Vec::new(),
        }
    }

    /// Takes output until the screen is as it should be.
    #[track_caller]
    fn wait_until(&mut self, what: &str, is_so: impl Fn(&vt100::Screen) -> bool) {
        let start = Instant::now();
        while !is_so(self.parser.screen()) {
            let screen = self.parser.screen().contents();
            assert!(start.elapsed() < PATIENCE, "never {what}: {screen}");
            match self.output.recv_timeout(Duration::from_millis(100)) {
                Ok(bytes) => {
                    self.parser.process(&bytes);
                    self.stream.extend(bytes);
                }
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => {
                    assert!(is_so(self.parser.screen()), "ended before {what}: {screen}");
                }
            }
        }
    }

    fn press(&mut self, keys: &str) {
        let mut writer = self.master.take_writer().unwrap();
        writer.write_all(keys.as_bytes()).unwrap();
        writer.flush().unwrap();
        // Its end would be the end of input.
        std::mem::forget(writer);
    }

    /// Takes all output until the program ends; returns the exit code.
    #[track_caller]
    fn finish(&mut self) -> u32 {
        let code = self.child.wait().unwrap().exit_code();
        while let Ok(bytes) = self.output.recv_timeout(Duration::from_millis(300)) {
            self.parser.process(&bytes);
            self.stream.extend(bytes);
        }
        code
    }
}

/// Echo, signals and the like.
fn modes(master: &dyn MasterPty) -> String {
    format!("{:?}", master.get_termios().unwrap())
}

fn count(cells: u16) -> NonZero<u16> {
    NonZero::new(cells).unwrap()
}

fn rgb(color: Color) -> Option<[u8; 3]> {
    match color {
        Color::Rgb(r, g, b) => Some([r, g, b]),
        _ => None,
    }
}

/// The picture in the cells at the top left; none where a cell shows something else.
fn picture(screen: &vt100::Screen, width: usize, height: usize) -> Option<Picture> {
    let mut rgb888 = Vec::new();
    for y in 0..height {
        for x in 0..width {
            let cell = screen.cell((y / 2) as u16, x as u16)?;
            if cell.contents() != "▀" {
                return None;
            }
            let color = if y % 2 == 0 {
                cell.fgcolor()
            } else {
                cell.bgcolor()
            };
            rgb888.extend(rgb(color)?);
        }
    }
    Some(Picture {
        width,
        height,
        rgb888,
    })
}

/// Whether the terminal would show a prompt as it did before.
#[track_caller]
fn assert_is_as_before(screen: &vt100::Screen) {
    assert!(!screen.alternate_screen() && !screen.hide_cursor());
    assert_eq!(screen.fgcolor(), Color::Default);
    assert_eq!(screen.bgcolor(), Color::Default);
}

#[test]
fn shows_the_picture_that_render_draws() {
    let folder = Folder::new();
    // As large as the terminal, which keeps a line for the prompt; as the display shows it.
    for (options, size, terminal) in [
        (&[][..], "29x22", [40, 12]),
        (&[], "20x15", [20, 30]),
        (&["--size", "33x21"], "33x21", [80, 24]),
        (
            &["--display", "ssd1306", "--size", "72x40"],
            "72x40",
            [80, 24],
        ),
        (
            &["--scalar", "f64", "--max-depth", "0", "--size", "30x10"],
            "30x10",
            [80, 24],
        ),
    ] {
        let path = scene("pyramids");
        let mut view = Terminal::new(
            &folder,
            &[&["view", &path], options].concat(),
            terminal,
            false,
        );
        assert_eq!(view.finish(), 0);
        let mut same = vec![&*path];
        same.extend(options);
        if !options.contains(&"--size") {
            same.extend(["--size", size]);
        }
        let expected = folder.draw(&same);
        assert_eq!(format!("{}x{}", expected.width, expected.height), size);
        let screen = view.parser.screen();
        let shown = picture(screen, expected.width, expected.height);
        assert!(
            shown.as_ref() == Some(&expected),
            "{options:?} {}",
            screen.contents()
        );
        assert_eq!(
            screen.cursor_position(),
            (expected.height.div_ceil(2) as u16, 0)
        );
        assert_is_as_before(screen);
    }
}

#[test]
fn a_larger_display_is_averaged_down() {
    let folder = Folder::new();
    folder.write("scene.txt", SMALL_SCENE);
    let options = [
        "scene.txt",
        "--size",
        "80x60",
        "--color",
        "gray4",
        "--dither",
    ];
    let mut view = Terminal::new(
        &folder,
        &[&["view"], &options[..]].concat(),
        [40, 24],
        false,
    );
    assert_eq!(view.finish(), 0);
    let whole = folder.draw(&options);
    let mut rgb888 = Vec::new();
    for (y, x) in (0..30_usize).flat_map(|y| (0..40_usize).map(move |x| (y, x))) {
        for channel in 0..3 {
            let level = |x: usize, y: usize| usize::from(whole.rgb888[3 * (y * 80 + x) + channel]);
            let four = [(0, 0), (1, 0), (0, 1), (1, 1)];
            let sum: usize = four
                .iter()
                .map(|(dx, dy)| level(2 * x + dx, 2 * y + dy))
                .sum();
            rgb888.push(((sum + 2) / 4) as u8);
        }
    }
    let shown = picture(view.parser.screen(), 40, 30).unwrap();
    assert!(shown.rgb888 == rgb888);
}

#[test]
fn what_takes_long_appears_coarse_to_fine_in_place() {
    let folder = Folder::new();
    // Much work for few cells.
    let options = [
        &*scene("window-room"),
        "--size",
        "640x480",
        "--scalar",
        "f64",
        "--max-depth",
        "32",
    ];
    let mut view = Terminal::new(
        &folder,
        &[&["view"], &options[..]].concat(),
        [32, 13],
        false,
    );
    assert_eq!(view.finish(), 0);
    let screen = view.parser.screen();
    let last = picture(screen, 32, 24).unwrap();
    assert_eq!(screen.cursor_position(), (12, 0));
    // The first frame is black below; each overwrites the one before.
    let stream = String::from_utf8(view.stream.clone()).unwrap();
    let frames: Vec<&str> = stream.split("\x1b[12A").collect();
    assert!(frames.len() > 2, "{}", frames.len());
    let mut first = Parser::new(count(13), count(32), 0);
    first.process(frames[0].as_bytes());
    assert!(picture(first.screen(), 32, 24).unwrap() != last);
    assert_is_as_before(screen);
}

#[test]
fn an_interrupted_picture_leaves_no_colours_behind() {
    let folder = Folder::new();
    let options = ["--size", "6000x4000", "--scalar", "f64"];
    let mut view = Terminal::new(
        &folder,
        &[&["view"], &options[..]].concat(),
        [32, 13],
        false,
    );
    view.wait_until("a first frame", |screen| screen.contents().contains('▀'));
    view.press("\x03");
    assert_eq!(view.finish(), 130);
    assert_is_as_before(view.parser.screen());
}

/// Saves as editors do.
fn save(folder: &Folder, text: &str) {
    folder.write("scene.txt.new", text);
    std::fs::rename(folder.path("scene.txt.new"), folder.path("scene.txt")).unwrap();
}

#[test]
fn draws_again_whenever_the_scene_is_saved() {
    let folder = Folder::new();
    let good = SMALL_SCENE.replace("8 6", "30 20");
    let other = good.replace(".8 .2 .2", ".2 .8 .2");
    let [first, second] = [&good, &other].map(|text| {
        save(&folder, text);
        folder.draw(&["scene.txt"])
    });
    save(&folder, &good);
    let mut view = Terminal::new(
        &folder,
        &["view", "scene.txt", "--watch", "--size", "30x20"],
        [70, 16],
        false,
    );
    let is_shown = |expected: &Picture| {
        let expected = expected.clone();
        move |screen: &vt100::Screen| picture(screen, 30, 20).as_ref() == Some(&expected)
    };
    let done = |screen: &vt100::Screen| screen.contents().contains(" ms  q quits");
    view.wait_until("the picture", is_shown(&first));
    view.wait_until("done", done);
    assert!(view.parser.screen().alternate_screen() && view.parser.screen().hide_cursor());
    // Renamed into place, then written in place.
    save(&folder, &other);
    view.wait_until("the other picture", is_shown(&second));
    folder.write("scene.txt", &good);
    view.wait_until("the first picture again", is_shown(&first));
    // An error stands below the last good picture.
    save(&folder, &good.replace("0.1\n", "zero\n"));
    view.wait_until("the error", |screen| {
        let text = screen.contents();
        text.contains("error: expected the ambient intensity")
            && text.contains("--> scene.txt:5:1")
            && text.contains("^^^^")
    });
    assert!(picture(view.parser.screen(), 30, 16) == picture_top(&first, 16));
    std::fs::remove_file(folder.path("scene.txt")).unwrap();
    view.wait_until("that it is gone", |screen| {
        screen.contents().contains("cannot read scene.txt")
    });
    save(&folder, &other);
    view.wait_until("the picture without the error", |screen| {
        is_shown(&second)(screen) && !screen.contents().contains("error")
    });
    // Another size of the terminal. The picture is too high for it now.
    let size = PtySize {
        rows: 6,
        cols: 70,
        pixel_width: 0,
        pixel_height: 0,
    };
    view.parser.screen_mut().set_size(count(6), count(70));
    view.master.resize(size).unwrap();
    view.wait_until("the smaller picture", |screen| {
        screen.contents().contains("shown as 15x10") && picture(screen, 15, 10).is_some()
    });
    view.press("q");
    assert_eq!(view.finish(), 0);
    assert_is_as_before(view.parser.screen());
    assert_eq!(modes(&*view.master), view.modes_before);
}

#[test]
fn an_error_leaves_most_of_the_picture_on_a_small_terminal() {
    let folder = Folder::new();
    let good = SMALL_SCENE.replace("8 6", "20 12");
    save(&folder, &good);
    let expected = folder.draw(&["scene.txt"]);
    let mut view = Terminal::new(
        &folder,
        &["view", "scene.txt", "--watch", "--size", "20x12"],
        [44, 7],
        false,
    );
    view.wait_until("done", |screen| screen.contents().contains(" ms  q quits"));
    save(&folder, &good.replace("0.1\n", "zero\n"));
    view.wait_until("the error and its place", |screen| {
        screen
            .contents()
            .contains("scene.txt:5:1: error: expected the ambient")
    });
    assert!(picture(view.parser.screen(), 20, 10) == picture_top(&expected, 10));
    view.press("q");
    assert_eq!(view.finish(), 0);
}

/// The upper rows of a picture.
fn picture_top(picture: &Picture, height: usize) -> Option<Picture> {
    Some(Picture {
        height,
        rgb888: picture.rgb888[..3 * picture.width * height].to_vec(),
        ..*picture
    })
}

#[test]
fn every_way_out_of_watching_restores_the_terminal() {
    let folder = Folder::new();
    folder.write("scene.txt", SMALL_SCENE);
    for (way, code) in [
        ("q", 0),
        ("\x1b", 0),
        ("\x04", 0),
        ("\x03", 130),
        ("kill", 143),
    ] {
        let mut view = Terminal::new(&folder, &["view", "scene.txt", "-w"], [40, 12], false);
        view.wait_until("the picture", |screen| {
            screen.contents().contains("q quits")
        });
        if way == "kill" {
            let process = view.child.process_id().unwrap().to_string();
            let kill = std::process::Command::new("kill").arg(process).status();
            assert!(kill.unwrap().success());
        } else {
            view.press(way);
        }
        assert_eq!(view.finish(), code, "{way:?}");
        assert_is_as_before(view.parser.screen());
        assert_eq!(modes(&*view.master), view.modes_before, "{way:?}");
    }
}

#[test]
fn letters_stand_for_colours_where_there_are_none() {
    let folder = Folder::new();
    folder.write("scene.txt", SMALL_SCENE);
    let mut command = folder.program(&["view", "scene.txt"]);
    let run = command
        .env("COLUMNS", "32")
        .env("LINES", "13")
        .output()
        .unwrap();
    assert!(run.status.success());
    let text = String::from_utf8(run.stdout).unwrap();
    assert_eq!(text.lines().count(), 12);
    assert!(text.lines().all(|line| line.len() <= 32), "{text}");
    // The sky is bright, the lower side of the sphere dark.
    assert!(text.starts_with("####"), "{text}");
    assert!(text.contains(' ') || text.contains('.'), "{text}");
    let mut view = Terminal::new(&folder, &["view", "scene.txt"], [32, 13], true);
    assert_eq!(view.finish(), 0);
    assert_eq!(view.parser.screen().contents().trim_end(), text.trim_end());
    assert!(!view.stream.contains(&b'\x1b'));
}

#[test]
fn wrong_use_is_told() {
    let folder = Folder::new();
    folder.write("bad.txt", SMALL_SCENE.replace("0.1\n", "zero\n"));
    for (code, arguments, words) in [
        (
            2,
            &["view", "bad.txt", "--watch"][..],
            "--watch needs a terminal",
        ),
        (2, &["view", "--watch"], "scanray view scene.txt --watch"),
        (2, &["view", "-", "--watch"], "<stdin> cannot be saved"),
        (
            2,
            &["view", "--display", "tft"],
            "possible values: list, ssd1306",
        ),
        (3, &["view", "bad.txt"], "bad.txt:5:1"),
        (4, &["view", "missing.txt"], "cannot read missing.txt"),
    ] {
        let said = folder.fail(code, arguments);
        assert!(said.contains(words), "{arguments:?}: {said}");
    }
    let list = folder.succeed(&["view", "--display", "list"]).stdout;
    assert!(list == folder.succeed(&["render", "--display", "list"]).stdout);
}
