//! Names and texts that a terminal would obey, or that would break a line of what is written, are shown escaped.
#![cfg(unix)]

use crate::program::{Folder, Run, SMALL_SCENE};

/// A name with a line break, with colours and with a mark that turns the order of letters round.
const NAME: &str = "a\n\u{1b}[31mb\u{9b}2J\u{202e}.txt";

/// The same as it is shown.
const SHOWN: &str = "a\\n\\u{1b}[31mb\\u{9b}2J\\u{202e}.txt";

#[track_caller]
fn assert_harmless(what: &str, said: &str) {
    let obeyed = |c: char| (c.is_control() && c != '\n') || c == '\u{202e}';
    assert!(!said.contains(obeyed), "{what}: {said:?}");
    assert!(!said.contains("a\n\\u{1b}"), "{what}: {said:?}");
}

#[test]
fn names_of_files_are_shown_escaped() {
    let folder = Folder::new();
    folder.write(NAME, SMALL_SCENE);
    folder.write(
        "bad.txt",
        SMALL_SCENE.replace("0.1\n", "z\u{1b}[31mero \u{1b}]0;t\u{7}\n"),
    );
    std::fs::rename(folder.path("bad.txt"), folder.path(&format!("bad{NAME}"))).unwrap();
    let (bad, ppm) = (format!("bad{NAME}"), format!("{NAME}.ppm"));
    let missing = format!("missing{NAME}");
    folder.succeed(&["render", NAME, "-o", &ppm]);
    for (code, arguments) in [
        (0, &["render", NAME, "-o", &ppm][..]),
        (0, &["render", NAME, "-o", "t.gif", "--turntable", "2"]),
        (2, &["render", NAME, "-o", NAME]),
        (3, &["render", &bad]),
        (4, &["render", &missing]),
        (1, &["fmt", "--check", NAME]),
        (0, &["fmt", NAME]),
        (0, &["needs", NAME]),
        (0, &["pixel", NAME, "4,3"]),
        (0, &["export", NAME, "-o", "-"]),
        (0, &["bake", NAME]),
        (0, &["bake", NAME, "-o", &format!("{NAME}.rs")]),
        (4, &["diff", &missing, &ppm]),
        (4, &["join", &ppm, &missing, "-o", "whole.ppm"]),
        (4, &["join", &ppm, "-o", "whole.ppm"]),
        (2, &["render", NAME, NAME]),
    ] {
        let Run {
            code: got,
            stdout,
            stderr,
        } = folder.run(arguments);
        assert_eq!(got, code, "{arguments:?}: {stderr}");
        let said = String::from_utf8(stdout).unwrap() + &stderr;
        assert_harmless(&format!("{arguments:?}"), &said);
        assert!(said.contains(SHOWN), "{arguments:?}: {said:?}");
    }
    // Programs get the name itself.
    let run = folder.succeed(&["needs", NAME, "--json"]);
    let json: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!(json["scene"], NAME);
}

#[test]
fn words_of_the_command_line_are_shown_escaped() {
    let folder = Folder::new();
    folder.write(NAME, SMALL_SCENE);
    for arguments in [
        &[NAME][..],
        &["render", "--size", NAME],
        &["render", "--scalar", NAME],
        &["render", &format!("--{NAME}")],
        &["pixel", NAME, &format!("-1,{NAME}")],
        &["completions", NAME],
    ] {
        let said = folder.fail(2, arguments);
        assert_harmless(&format!("{arguments:?}"), &said);
        assert!(said.contains(SHOWN), "{arguments:?}: {said:?}");
    }
}

#[test]
fn baked_source_has_one_line_of_comment() {
    let folder = Folder::new();
    let name = "a\nstatic BROKEN: u8 = 1;.txt";
    folder.write(name, SMALL_SCENE);
    let source = String::from_utf8(folder.succeed(&["bake", name]).stdout).unwrap();
    let (comment, expression) = source.split_once('\n').unwrap();
    assert!(
        comment.starts_with("// a\\nstatic BROKEN: u8 = 1;.txt by scanray "),
        "{comment}"
    );
    assert!(!expression.contains("BROKEN"), "{expression}");
}
