//! Wrong command lines and wrong scenes.

use crate::program::{Folder, SMALL_SCENE, scene};

#[test]
fn usage_errors_say_what_to_do() {
    let folder = Folder::new();
    let default = scene("default");
    for (arguments, words) in [
        (&["render", "--size", "160"][..], "such as 320x240"),
        (&["render", "--size", "0x120"], "from 1 to 65535 pixels"),
        (&["render", "--size", "70000x1"], "from 1 to 65535 pixels"),
        (
            &["render", "--max-depth", "33"],
            "from 0 (no mirror rays) to 32",
        ),
        (&["render", "--max-depth", "-1"], "from 0 (no mirror rays)"),
        (&["render", "--rows", "5"], "such as 0..100"),
        (&["render", "--rows", "5..5"], "such as 0..100"),
        (&["render", "--rows", "0..601"], "the most is 0..600"),
        (&["render", "--steps", "0..2"], "--turntable <N>"),
        (
            &["render", "--turntable", "0"],
            "a whole number from 1 to 65535",
        ),
        (
            &["render", "--turntable", "x"],
            "a whole number from 1 to 65535",
        ),
        (&["render", "--rows", "-3..4"], "such as 0..100"),
        (
            &["render", "--turntable", "9", "--steps", "-1..2"],
            "such as 0..100",
        ),
        (
            &["pixel", &default, "-1,0"],
            "-1,0: give column and row from 0 to 65535",
        ),
        (&["pixel", &default, "--1,0"], "unexpected argument"),
        (
            &["diff", "a.png", "b.png", "--tolerance", "x"],
            "a whole number from 0 to 255",
        ),
        (
            &["render", "--threads", "x"],
            "a whole number from 1 to 1024",
        ),
        (
            &["render", "--turntable", "9", "--steps", "8..10"],
            "--steps 8..10: the turntable has 9 steps, so the most is 0..9",
        ),
        (
            &["render", "--turntable", "9", "--about", "1"],
            "such as 0,2.5",
        ),
        (
            &["render", "--turntable", "9", "--delay", "5"],
            "tens of milliseconds",
        ),
        (
            &["render", "--rows", "0..9", "-o", "a.gif"],
            "draw parts into .ppm or .png files",
        ),
        (
            &["render", "--threads", "0"],
            "a whole number from 1 to 1024",
        ),
        (&["render", "--color", "rgb"], "possible values: rgb888, "),
        (&["render", "--scalar", "f16"], "possible values: f32, f64"),
        (
            &["render", "-o", ""],
            "--output <FILE> is empty: a variable that is not set, perhaps?",
        ),
        (
            &["render", ""],
            "[SCENE]... is empty: a variable that is not set, perhaps?",
        ),
        (
            &["pixel", "4,3"],
            "For example: scanray pixel scene.txt 4,3\n",
        ),
        (
            &["join"],
            "For example: scanray join upper.ppm lower.ppm -o whole.png\n",
        ),
        (
            &["render", "-o", "picture.jpg"],
            "must end in .ppm, .png or .gif",
        ),
        (
            &["render", "-o", "picture"],
            "must end in .ppm, .png or .gif",
        ),
        (&["render", "-o", "pictures/"], "there is no such folder"),
        (&["render", "-o", "-", "--json"], "name a file with -o"),
        (
            &["render", &default, "a.txt", "-o", "a.ppm"],
            "name an existing folder, or leave -o out",
        ),
        (
            &["render", &default, "default.txt"],
            "would both become default.ppm",
        ),
        (&["rendr"], "'render'"),
        (&["scene.txt"], "scanray render scene.txt"),
        (&["--size", "9x9"], "scanray render --size"),
    ] {
        let said = folder.fail(2, arguments);
        assert!(said.contains("error: "), "{arguments:?}: {said}");
        assert!(said.contains(words), "{arguments:?}: {said}");
    }
    assert_eq!(folder.names(), [""; 0]);
}

#[test]
#[cfg(not(feature = "window"))]
fn a_program_without_windows_says_how_to_get_one() {
    let said = Folder::new().fail(2, &["window", "scene.txt"]);
    assert!(said.contains("--features window"), "{said}");
}

#[test]
fn a_usage_error_of_rows_depends_on_the_size() {
    let folder = Folder::new();
    folder.succeed(&["render", "--rows", "600..601", "--size", "2x700"]);
    let said = folder.fail(2, &["render", "--rows", "20..", "--size", "8x16"]);
    assert!(
        said.contains("--rows 20..: the picture has 16 rows"),
        "{said}"
    );
}

#[test]
fn files_that_cannot_be_read_have_their_own_code() {
    let folder = Folder::new();
    for command in ["render", "inspect"] {
        let said = folder.fail(4, &[command, "missing.txt"]);
        assert!(said.contains("cannot read missing.txt: "), "{said}");
        let said = folder.fail(4, &[command, "."]);
        assert!(said.contains("cannot read .: "), "{said}");
    }
    assert_eq!(folder.names(), [""; 0]);
}

/// The line of a report that shows the scene, without its margin, and the line of carets below it.
fn shown(report: &str, line: u32) -> (String, String) {
    let margin = format!("{line} |");
    let behind_margin = |line: &str| -> String { line.chars().skip(margin.len() + 1).collect() };
    let mut lines = report.lines().skip_while(|l| !l.starts_with(&margin));
    let mut next = || behind_margin(lines.next().unwrap_or_default());
    (next(), next())
}

#[test]
fn scene_errors_show_the_place() {
    let folder = Folder::new();
    let sphere = SMALL_SCENE.lines().last().unwrap();
    for (text, place, source, carets, message) in [
        // A word that is no number.
        (
            SMALL_SCENE.replace("0 0 3", "0 0 three"),
            (8, 8),
            &*sphere.replace("0 0 3", "0 0 three"),
            "       ^^^^^",
            "found `three`",
        ),
        // A value that is not allowed.
        (
            SMALL_SCENE.replace("0.1\n", "-0.1 # dim\n"),
            (5, 1),
            "-0.1 # dim",
            "^^^^",
            "expected the ambient intensity: a number from 0 to 1e30; found `-0.1`",
        ),
        // A line that is too short: behind its last number.
        (
            SMALL_SCENE.replacen("0 0 0\n", "0 0 # x y\n", 1),
            (2, 4),
            "0 0 # x y",
            "   ^",
            "found the end of the line",
        ),
        // A line that is too long, and tabs, which are shown as four blanks but count as one column.
        (
            SMALL_SCENE.replace("8 6\n", "\t8\t 6\t7\r\n"),
            (3, 7),
            "    8     6    7",
            "               ^",
            "expected the end of the line; found `7`",
        ),
        // Text that is not ASCII.
        (
            SMALL_SCENE.replace("8 6\n", "8 größe # ü\n"),
            (3, 3),
            "8 größe # ü",
            "  ^^^^^",
            "found `größe`",
        ),
        // A record that is missing.
        (
            SMALL_SCENE.replacen('1', "2", 1) + "\n# end\n",
            (8, sphere.len() as u32 + 1),
            sphere,
            &(" ".repeat(sphere.len()) + "^"),
            "expected object 2: line 1 says 2 objects, 1 follow: write 1; found the end of the text",
        ),
        (String::new(), (1, 1), "", "^", "found the end of the text"),
    ] {
        folder.write("bad.txt", &text);
        let (line, column) = place;
        for command in ["render", "inspect"] {
            let said = folder.fail(3, &[command, "bad.txt"]);
            assert!(said.starts_with("error: "), "{said}");
            assert!(
                said.contains(&format!("bad.txt:{line}:{column}\n")),
                "{said}"
            );
            assert!(said.contains(message), "{said}");
            let (shown_source, shown_carets) = shown(&said, line);
            assert_eq!((&*shown_source, &*shown_carets), (source, carets), "{said}");
        }
    }
    assert_eq!(folder.names(), ["bad.txt"]);
}

#[test]
fn every_rejection_is_shown_at_its_place() {
    let folder = Folder::new();
    let default = scene("default");
    let invalid = std::path::Path::new(&default).with_file_name("invalid");
    let mut count = 0;
    let mut wrong = Vec::new();
    for entry in std::fs::read_dir(invalid).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "txt") {
            continue;
        }
        count += 1;
        // `line L, column C: MESSAGE`
        let expected = std::fs::read_to_string(path.with_extension("expected")).unwrap();
        let (place, message) = expected.trim_end().split_once(": ").unwrap();
        let place = place.replace("line ", "").replace(", column ", ":");
        let path = path.to_str().unwrap();
        let said = folder.fail(3, &["inspect", path]);
        // Where the caret is: below the place, but tabs are shown as four blanks.
        let (line, column) = place.split_once(':').unwrap();
        let (line, column): (u32, usize) = (line.parse().unwrap(), column.parse().unwrap());
        let (source, carets) = shown(&said, line);
        let caret = carets.chars().take_while(|c| *c == ' ').count();
        let caret_is_right = caret == column - 1 + 3 * tabs_before(path, line, column);
        let is_right = said.starts_with(&format!("error: {message}\n"))
            && said.contains(&format!("--> {path}:{place}\n"))
            // A line too long for the terminal is shown in part.
            && (caret_is_right || source.contains("..."));
        if !is_right {
            wrong.push(format!("{expected}{said}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(count > 50, "{count}");
}

#[test]
fn unreadable_encodings_are_named_with_a_remedy() {
    let folder = Folder::new();
    let utf16: Vec<u8> = [0xFEFF]
        .into_iter()
        .chain(SMALL_SCENE.encode_utf16())
        .flat_map(u16::to_le_bytes)
        .collect();
    for (text, words) in [
        (
            SMALL_SCENE.replace('\n', "\r").into_bytes(),
            "carriage returns (CR) for line ends; save it with LF or CRLF",
        ),
        (utf16, "the file is UTF-16; save it as UTF-8"),
    ] {
        folder.write("scene.txt", text);
        let said = folder.fail(3, &["inspect", "scene.txt"]);
        assert!(said.contains(words), "{said}");
    }
}

#[test]
fn a_word_behind_an_option_without_the_sign_of_equality_is_told() {
    let folder = Folder::new();
    folder.write("scene.txt", SMALL_SCENE);
    for (code, arguments) in [
        (4, &["render", "--dither", "off"][..]),
        (4, &["render", "scene.txt", "--dither", "off"]),
        (4, &["view", "--dither", "off"]),
        (2, &["pixel", "scene.txt", "--dither", "off", "4,3"]),
    ] {
        let run = folder.run(arguments);
        let said = run.stderr;
        assert_eq!(run.code, code, "{arguments:?}: {said}");
        assert!(
            said.contains("if it is meant for --dither, write --dither=off"),
            "{arguments:?}: {said}"
        );
    }
    // A scene may stand there, and a file of that name.
    folder.succeed(&["render", "--dither", "scene.txt"]);
    let said = folder.fail(4, &["render", "off"]);
    assert!(!said.contains("--dither"), "{said}");
}

#[test]
fn of_repeated_options_the_last_holds() {
    let folder = Folder::new();
    let drawn = folder.draw(&[
        "--size",
        "9x9",
        "--dither",
        "--size",
        "4x3",
        "--dither=off",
        "--scalar",
        "f64",
        "--scalar=f32",
    ]);
    assert!(drawn == folder.draw(&["--size", "4x3"]));
    let twice = folder.succeed(&["needs", "--json", "--json"]).stdout;
    assert!(twice == folder.succeed(&["needs", "--json"]).stdout);
    // Those that take several values keep them all.
    folder.write("a.txt", SMALL_SCENE);
    let two = folder
        .succeed(&["pixel", "a.txt", "4,3", "4,4", "--json"])
        .stdout;
    assert_eq!(two.iter().filter(|byte| **byte == b'\n').count(), 2);
}

#[test]
fn a_byte_order_mark_at_the_start_is_skipped() {
    let folder = Folder::new();
    folder.write("plain.txt", SMALL_SCENE);
    folder.write("scene.txt", format!("\u{feff}{SMALL_SCENE}"));
    assert!(folder.draw(&["scene.txt"]) == folder.draw(&["plain.txt"]));
    let canonical = |name| folder.succeed(&["fmt", "-o", "-", name]).stdout;
    assert!(canonical("scene.txt") == canonical("plain.txt"));
    // As editors count, which do not show it.
    folder.write("scene.txt", format!("\u{feff}x{SMALL_SCENE}"));
    let said = folder.fail(3, &["inspect", "scene.txt"]);
    assert!(said.contains("scene.txt:1:1"), "{said}");
}

/// Tabs before a place in a file.
fn tabs_before(path: &str, line: u32, column: usize) -> usize {
    let text = std::fs::read(path).unwrap();
    let mut lines = text.split(|byte| *byte == b'\n');
    let line = lines.nth(line as usize - 1).unwrap_or_default();
    let before = line.iter().take(column - 1);
    before.filter(|byte| **byte == b'\t').count()
}

#[test]
fn text_that_is_no_utf8_does_not_move_the_caret() {
    let folder = Folder::new();
    let mut text = b"# \xff\xfe caf\xe9\n".to_vec();
    text.extend(SMALL_SCENE.replace("8 6", "8 x # \u{fffd}").into_bytes());
    text.extend(b"# \xff\n");
    folder.write("bad.txt", text);
    let said = folder.fail(3, &["render", "bad.txt"]);
    assert!(said.contains("bad.txt:4:3\n"), "{said}");
    assert_eq!(shown(&said, 4).1, "  ^", "{said}");
}

#[test]
fn control_characters_of_a_scene_do_not_reach_the_terminal() {
    let folder = Folder::new();
    let text = SMALL_SCENE.replace("8 6", "8 \u{1b}[2J");
    let said = folder
        .run_with_input(&["render", "-"], text.as_bytes())
        .stderr;
    assert!(said.contains("<stdin>:3:3"), "{said}");
    assert!(!said.contains('\u{1b}'), "{said:?}");
}

#[test]
fn the_light_of_8_numbers_is_worth_a_warning() {
    let folder = Folder::new();
    folder.write(
        "short.txt",
        SMALL_SCENE.replace("1 1 1  1 1 1\n", "1 1 1  1 1\n"),
    );
    let run = folder.succeed(&["inspect", "short.txt"]);
    let warning = "warning: short.txt:4: the light has 8 numbers instead of 9";
    assert!(run.stderr.starts_with(warning), "{}", run.stderr);
    folder.write("small.txt", SMALL_SCENE);
    assert_eq!(folder.succeed(&["inspect", "small.txt"]).stderr, "");
}

#[test]
fn a_bad_scene_does_not_keep_the_others_from_being_drawn() {
    let folder = Folder::new();
    folder.write("a.txt", SMALL_SCENE);
    folder.write("b.txt", "oh");
    folder.write("c.txt", SMALL_SCENE);
    let said = folder.fail(3, &["render", "a.txt", "b.txt", "missing.txt", "c.txt"]);
    assert!(said.contains("b.txt:1:1") && said.contains("cannot read missing.txt"));
    assert_eq!(
        folder.names(),
        ["a.ppm", "a.txt", "b.txt", "c.ppm", "c.txt"]
    );
}

#[test]
fn sentences_of_help_have_no_line_break_in_them() {
    let folder = Folder::new();
    let commands = folder.succeed(&["--help"]).stdout;
    let commands = String::from_utf8(commands).unwrap();
    let (_, commands) = commands.split_once("Commands:\n").unwrap();
    let (commands, _) = commands.split_once("\n\n").unwrap();
    let names = commands
        .lines()
        .filter_map(|line| line.split_whitespace().next());
    let mut broken = Vec::new();
    for name in names.filter(|name| *name != "help") {
        // So wide that nothing is wrapped.
        let output = folder
            .program(&[name, "--help"])
            .env("COLUMNS", "1000")
            .output()
            .unwrap();
        let help = String::from_utf8(output.stdout).unwrap();
        let lines: Vec<_> = help.lines().collect();
        for pair in lines.windows(2) {
            let is_text = |line: &str| line.starts_with(|c: char| c.is_alphanumeric() || c == '`');
            let goes_on =
                pair[1].starts_with(|c: char| c.is_lowercase()) && !pair[1].contains("  ");
            if is_text(pair[0]) && is_text(pair[1]) && goes_on {
                broken.push(format!("{name}: {}\n{}", pair[0], pair[1]));
            }
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

#[test]
fn help_has_examples() {
    let folder = Folder::new();
    for arguments in [&["--help"][..], &["render", "--help"], &["help", "inspect"]] {
        let help = String::from_utf8(folder.succeed(arguments).stdout).unwrap();
        assert!(help.contains("Examples:\n  scanray"), "{help}");
    }
}

#[test]
fn what_is_hardly_meant_is_worth_a_warning() {
    let folder = Folder::new();
    let bright = SMALL_SCENE.replace(".8 .2 .2", "255 51 51");
    folder.write("bright.txt", bright);
    let warning = "warning: bright.txt:8: the diffuse colour 255 51 51 looks like levels of 0 to 255, but 1 is full intensity: \
                   write 1 0.2 0.2\n";
    for command in [
        &["inspect", "bright.txt"][..],
        &["fmt", "--check", "bright.txt"],
        &["render", "bright.txt", "-o", "x.ppm"],
    ] {
        let said = folder.run(command).stderr;
        assert_eq!(said.matches(warning).count(), 1, "{command:?}: {said}");
    }
    folder.write("inside.txt", SMALL_SCENE.replace("0 0 3  1", "0 0 0.5  1"));
    let said = folder.succeed(&["inspect", "inside.txt"]).stderr;
    assert!(
        said.starts_with("warning: inside.txt:8: the camera is inside of this sphere"),
        "{said}"
    );
    for name in [
        "default",
        "mirror-room",
        "pyramids",
        "reflective",
        "window-room",
    ] {
        assert_eq!(
            folder.succeed(&["inspect", &scene(name)]).stderr,
            "",
            "{name}"
        );
    }
}
