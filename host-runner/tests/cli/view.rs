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

/// What else than `TERM` tells of a terminal's colours.
const COLOR_VARIABLES: [&str; 6] = [
    "NO_COLOR",
    "COLORTERM",
    "FORCE_COLOR",
    "CLICOLOR_FORCE",
    "CLICOLOR",
    "TERM_PROGRAM",
];

/// The program on a terminal.
struct Terminal {
    master: Box<dyn MasterPty + Send>,
    /// Its end would be the end of input.
    keys: Box<dyn Write + Send>,
    child: Box<dyn Child + Send + Sync>,
    output: Receiver<Vec<u8>>,
    parser: Parser,
    /// The terminal's modes before the program began.
    modes_before: String,
    /// All that was written.
    stream: Vec<u8>,
}

impl Terminal {
    /// With all colours.
    fn new(folder: &Folder, arguments: &[&str], size: [u16; 2]) -> Self {
        Self::with(folder, arguments, size, &[("COLORTERM", "truecolor")])
    }

    fn with(
        folder: &Folder,
        arguments: &[&str],
        size: [u16; 2],
        environment: &[(&str, &str)],
    ) -> Self {
        let command = [&[env!("CARGO_BIN_EXE_scanray")], arguments].concat();
        Self::running(folder, &command, size, environment)
    }

    /// Any program.
    fn running(
        folder: &Folder,
        arguments: &[&str],
        [columns, lines]: [u16; 2],
        environment: &[(&str, &str)],
    ) -> Self {
        let size = PtySize {
            rows: lines,
            cols: columns,
            pixel_width: 0,
            pixel_height: 0,
        };
        let pair = native_pty_system().openpty(size).unwrap();
        let mut command = CommandBuilder::new(arguments[0]);
        command.args(&arguments[1..]);
        command.cwd(folder.path(""));
        for name in COLOR_VARIABLES {
            command.env_remove(name);
        }
        command.env("TERM", "xterm-256color");
        for (name, value) in environment {
            command.env(name, value);
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
            keys: pair.master.take_writer().unwrap(),
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
        self.keys.write_all(keys.as_bytes()).unwrap();
        self.keys.flush().unwrap();
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
        let mut view = Terminal::new(&folder, &[&["view", &path], options].concat(), terminal);
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
    let mut view = Terminal::new(&folder, &[&["view"], &options[..]].concat(), [40, 24]);
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
    let mut view = Terminal::new(&folder, &[&["view"], &options[..]].concat(), [32, 13]);
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
    let mut view = Terminal::new(&folder, &[&["view"], &options[..]].concat(), [32, 13]);
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
        let mut view = Terminal::new(&folder, &["view", "scene.txt", "-w"], [40, 12]);
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

/// Whether the program has ended, after some time.
fn ends(child: &mut dyn Child) -> Option<u32> {
    let start = Instant::now();
    while start.elapsed() < PATIENCE {
        if let Some(status) = child.try_wait().unwrap() {
            return Some(status.exit_code());
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    let _ = child.kill();
    None
}

#[test]
fn watching_ends_when_the_terminal_is_gone() {
    let folder = Folder::new();
    folder.write("scene.txt", SMALL_SCENE);
    let watch = format!("exec {} view scene.txt --watch", crate::PROGRAM);
    // With the signal and without it, as below `nohup` and where the terminal's process is another.
    for script in [watch.clone(), format!("trap '' HUP; {watch}")] {
        let pair = native_pty_system().openpty(PtySize::default()).unwrap();
        let mut command = CommandBuilder::new("sh");
        command.args(["-c", &script]);
        command.cwd(folder.path(""));
        command.env("TERM", "xterm-256color");
        let mut child = pair.slave.spawn_command(command).unwrap();
        drop(pair.slave);
        let mut reader = pair.master.try_clone_reader().unwrap();
        let mut shown = Vec::new();
        while !String::from_utf8_lossy(&shown).contains("q quits") {
            let mut buffer = [0; 1 << 12];
            let count = reader.read(&mut buffer).unwrap();
            shown.extend(&buffer[..count]);
        }
        // Until it waits for keys.
        std::thread::sleep(Duration::from_millis(100));
        drop(reader);
        drop(pair.master);
        let code = ends(&mut *child);
        // By the signal, or because it cannot write any more.
        assert!(matches!(code, Some(129 | 4)), "{script}: {code:?}");
    }
}

#[test]
fn a_suspended_watch_goes_on_with_its_picture() {
    let folder = Folder::new();
    folder.write("scene.txt", SMALL_SCENE.replace("8 6", "20 12"));
    let expected = folder.draw(&["scene.txt"]);
    // A shell with jobs, which says when the program is stopped.
    let script =
        "set -m; \"$0\" view scene.txt --watch --size 20x12; echo \"stopped $?\"; read -r line; fg";
    let mut view = Terminal::running(
        &folder,
        &["bash", "-c", script, crate::PROGRAM],
        [70, 16],
        &[("COLORTERM", "truecolor")],
    );
    let done = |screen: &vt100::Screen| {
        screen.contents().contains(" ms  q quits")
            && picture(screen, 20, 12).as_ref() == Some(&expected)
    };
    view.wait_until("the picture", done);
    view.press("\x1a");
    view.wait_until("the shell", |screen| {
        screen.contents().contains("stopped 148")
    });
    assert_is_as_before(view.parser.screen());
    assert_eq!(modes(&*view.master), view.modes_before);
    view.press("\n");
    view.wait_until("the picture again", done);
    assert!(view.parser.screen().alternate_screen() && view.parser.screen().hide_cursor());
    view.press("q");
    assert_eq!(view.finish(), 0);
    assert_is_as_before(view.parser.screen());
    assert_eq!(modes(&*view.master), view.modes_before);
}

#[test]
fn a_terminal_without_all_colours_gets_the_nearest_of_256() {
    let folder = Folder::new();
    let options = ["--size", "33x21"];
    let expected = folder.draw(&[&*scene("pyramids"), "--size", "33x21"]);
    let path = scene("pyramids");
    let mut view = Terminal::with(
        &folder,
        &[&["view", &*path], &options[..]].concat(),
        [80, 24],
        &[],
    );
    assert_eq!(view.finish(), 0);
    let level = |index: u8, weight: u8| match index {
        232.. => 8 + 10 * (index - 232),
        _ => match (index - 16) / weight % 6 {
            0 => 0,
            level => 55 + 40 * level,
        },
    };
    let screen = view.parser.screen();
    let mut indices = Vec::new();
    for (i, pixel) in expected.rgb888.chunks_exact(3).enumerate() {
        let (x, y) = (i % 33, i / 33);
        let cell = screen.cell((y / 2) as u16, x as u16).unwrap();
        let color = if y % 2 == 0 {
            cell.fgcolor()
        } else {
            cell.bgcolor()
        };
        let Color::Idx(index @ 16..) = color else {
            panic!("{color:?} at {x}, {y}")
        };
        indices.push(index);
        for (channel, weight) in [36, 6, 1].into_iter().enumerate() {
            // The widest gap of the cube is 95.
            let error = level(index, weight).abs_diff(pixel[channel]);
            assert!(error <= 48, "{index} for {pixel:?}");
        }
    }
    indices.sort();
    indices.dedup();
    assert!(indices.len() > 10, "{indices:?}");
    assert!(!String::from_utf8_lossy(&view.stream).contains("8;2;"));
}

#[test]
fn a_dumb_terminal_gets_letters_and_no_watch() {
    let folder = Folder::new();
    folder.write("scene.txt", SMALL_SCENE);
    for (term, has_escapes) in [("dumb", false), ("vt100", false), ("xterm-direct", true)] {
        let mut view = Terminal::with(&folder, &["view", "scene.txt"], [32, 13], &[("TERM", term)]);
        assert_eq!(view.finish(), 0);
        assert_eq!(view.stream.contains(&b'\x1b'), has_escapes, "{term}");
    }
    let dumb = [("TERM", "dumb")];
    let mut view = Terminal::with(&folder, &["view", "scene.txt", "-w"], [80, 13], &dumb);
    assert_eq!(view.finish(), 2);
    let said = view.parser.screen().contents();
    assert!(
        said.contains("TERM=dumb") && !view.stream.contains(&b'\x1b'),
        "{said}"
    );
}

/// The picture in the dots of the braille characters at the top left.
fn dots(screen: &vt100::Screen, width: usize, height: usize) -> Option<Picture> {
    const BITS: [[u32; 4]; 2] = [[0x01, 0x02, 0x04, 0x40], [0x08, 0x10, 0x20, 0x80]];
    let mut rgb888 = Vec::new();
    for y in 0..height {
        for x in 0..width {
            let cell = screen.cell((y / 4) as u16, (x / 2) as u16)?;
            let number = u32::from(cell.contents().chars().next()?).checked_sub(0x2800)?;
            let is_lit = number & BITS[x % 2][y % 4] != 0;
            rgb888.extend([if is_lit { 255 } else { 0 }; 3]);
        }
    }
    Some(Picture {
        width,
        height,
        rgb888,
    })
}

#[test]
fn pixels_of_one_bit_are_dots_where_cells_are_too_few() {
    let folder = Folder::new();
    let path = scene("reflective");
    // Drawn in fewer pixels only where there are not even enough dots.
    for (options, size, drawn) in [
        (&["--display", "ssd1306"][..], [80, 24], None),
        (
            &["--size", "101x50", "--color", "binary", "--dither"],
            [60, 20],
            None,
        ),
        (&["--display", "epd4in2"], [80, 24], Some("123x92")),
    ] {
        let arguments = [&["view", &*path], options].concat();
        let mut view = Terminal::new(&folder, &arguments, size);
        assert_eq!(view.finish(), 0);
        let mut same = [&[&*path], options].concat();
        if let Some(drawn) = drawn {
            same.extend(["--size", drawn]);
        }
        let expected = folder.draw(&same);
        let screen = view.parser.screen();
        let shown = dots(screen, expected.width, expected.height);
        assert!(
            shown.as_ref() == Some(&expected),
            "{options:?} {}",
            screen.contents()
        );
        assert_is_as_before(screen);
    }
    // Where there are cells enough, they are the pixels.
    let arguments = ["view", &*path, "--display", "pcd8544"];
    let mut view = Terminal::new(&folder, &arguments, [84, 30]);
    assert_eq!(view.finish(), 0);
    let expected = folder.draw(&[&*path, "--display", "pcd8544"]);
    assert!(picture(view.parser.screen(), 84, 48) == Some(expected));
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
    let mut view = Terminal::with(
        &folder,
        &["view", "scene.txt"],
        [32, 13],
        &[("NO_COLOR", "1"), ("COLORTERM", "truecolor")],
    );
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
