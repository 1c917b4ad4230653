//! Files appear whole or not at all.

use std::process::Stdio;

use crate::program::{Folder, SMALL_SCENE};

/// The small scene becomes this many bytes.
const SMALL_BYTES: usize = 11 + 3 * 8 * 6;

#[test]
fn a_run_that_fails_leaves_the_older_picture() {
    let folder = Folder::new();
    folder.write("output.ppm", "older");
    folder.write("bad.txt", SMALL_SCENE.replace("0.1", "nan"));
    folder.fail(3, &["render", "bad.txt"]);
    folder.fail(2, &["render", "--rows", "0..9999"]);
    assert_eq!(folder.read("output.ppm"), b"older");
    assert_eq!(folder.names(), ["bad.txt", "output.ppm"]);
    folder.write("small.txt", SMALL_SCENE);
    folder.succeed(&["render", "small.txt"]);
    assert_eq!(folder.read("output.ppm").len(), SMALL_BYTES);
}

#[test]
fn a_scene_is_not_overwritten_by_what_is_made_of_it() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("pictures")).unwrap();
    // A scene may be called anything.
    let names = [
        "scene.txt",
        "output.ppm",
        "turn-001.png",
        "scene.pov",
        "pictures/a.ppm",
    ];
    for name in names {
        folder.write(name, SMALL_SCENE);
    }
    for arguments in [
        &["bake", "scene.txt", "-o", "scene.txt"][..],
        &["bake", "scene.txt", "-o", "pictures/../scene.txt"],
        &["export", "scene.pov", "-o", "scene.pov"],
        &["render", "output.ppm"],
        &["render", "output.ppm", "-o", "output.ppm"],
        &[
            "render",
            "turn-001.png",
            "-o",
            "turn.png",
            "--turntable",
            "2",
        ],
        &["render", "scene.txt", "pictures/a.ppm", "-o", "pictures"],
    ] {
        let said = folder.fail(2, arguments);
        assert!(said.contains("it would overwrite what is read"), "{said}");
    }
    for name in names {
        assert!(folder.read(name) == SMALL_SCENE.as_bytes(), "{name}");
    }
    assert_eq!(folder.names().len(), 5);
}

#[test]
fn places_that_cannot_be_written_are_named_before_anything_is_drawn() {
    let folder = Folder::new();
    folder.write("file", "");
    folder.write("old.ppm", "older");
    std::fs::create_dir(folder.path("output.ppm")).unwrap();
    let mut permissions = folder.path("old.ppm").metadata().unwrap().permissions();
    permissions.set_readonly(true);
    std::fs::set_permissions(folder.path("old.ppm"), permissions).unwrap();
    for (output, words) in [
        (
            &["-o", "nowhere/a.ppm"][..],
            "cannot write nowhere/a.ppm: there is no folder nowhere",
        ),
        (&["-o", "file/a.png"], "cannot write file/a.png: "),
        (
            &["-o", "old.ppm"],
            "cannot write old.ppm: it is there already and is read-only",
        ),
        (&[], "cannot write output.ppm: it is a folder"),
    ] {
        // So large that drawing it would take hours.
        let said = folder.fail(4, &[&["render", "--size", "65535x65535"], output].concat());
        assert!(said.contains(words), "{said}");
    }
    assert_eq!(folder.read("old.ppm"), b"older");
    assert_eq!(folder.names(), ["file", "old.ppm", "output.ppm"]);
}

#[test]
fn a_reader_that_leaves_is_no_error() {
    let folder = Folder::new();
    for arguments in [
        &["render", "-o", "-", "--size", "300x200"][..],
        &["inspect"],
        &["render", "--json", "--size", "4x3"],
        &["render", "--verbose", "--size", "4x3"],
    ] {
        let mut child = folder
            .program(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(0), "{arguments:?}: {said}");
        assert!(
            !said.contains("panicked") && !said.contains("error"),
            "{said}"
        );
    }
}

#[test]
fn a_reader_that_leaves_does_not_cost_the_pictures() {
    for flag in ["--json", "--verbose"] {
        let folder = Folder::new();
        folder.write("a.txt", SMALL_SCENE);
        folder.write("b.txt", SMALL_SCENE);
        let mut child = folder
            .program(&["render", "a.txt", "b.txt", flag])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        assert_eq!(child.wait().unwrap().code(), Some(0));
        assert_eq!(folder.names(), ["a.ppm", "a.txt", "b.ppm", "b.txt"]);
    }
}

#[cfg(target_os = "linux")]
mod linux {
    use std::fs::{File, OpenOptions};
    use std::os::unix::process::ExitStatusExt;
    use std::process::{Child, Command, Stdio};
    use std::thread::sleep;
    use std::time::{Duration, Instant};

    use crate::program::{Folder, SMALL_SCENE};

    #[test]
    fn a_full_disk_is_an_error() {
        let folder = Folder::new();
        let full = || OpenOptions::new().write(true).open("/dev/full").unwrap();
        for arguments in [
            &["render", "-o", "-"][..],
            &["inspect"],
            &["render", "--json", "--size", "4x3"],
        ] {
            let program = folder.program(arguments).stdout(full()).output().unwrap();
            let said = String::from_utf8(program.stderr).unwrap();
            assert_eq!(program.status.code(), Some(4), "{said}");
            assert!(said.contains("cannot write to standard output: "), "{said}");
        }
        let said = folder.fail(4, &["render", "-o", "/dev/full", "--size", "4x3"]);
        assert!(said.contains("cannot write /dev/full: "), "{said}");
    }

    #[test]
    fn devices_and_pipes_are_written_as_they_are() {
        let folder = Folder::new();
        folder.write("small.txt", SMALL_SCENE);
        folder.succeed(&["render", "small.txt", "-o", "/dev/null"]);
        assert!(!std::path::Path::new("/dev/null").is_file());
        let run = folder.succeed(&["render", "small.txt", "-o", "/dev/stdout"]);
        assert_eq!(run.stdout.len(), super::SMALL_BYTES);
    }

    #[test]
    fn a_closed_standard_error_is_no_reason_to_stop() {
        let folder = Folder::new();
        let mut child = folder
            .program(&["render", "--size", "4x3"])
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stderr.take());
        assert_eq!(child.wait().unwrap().code(), Some(0));
        assert_eq!(folder.names(), ["output.ppm"]);
    }

    /// The program, which ends when it is interrupted even where the tests are not, as in a job in the background.
    fn interruptible(folder: &Folder, arguments: &[&str]) -> Command {
        let program = folder.program(arguments);
        let mut command = Command::new("env");
        command
            .arg("--default-signal=INT,TERM,HUP")
            .arg(program.get_program())
            .args(program.get_args())
            .current_dir(folder.path(""))
            .stderr(File::create(folder.path("errors")).unwrap());
        command
    }

    fn send(signal: &str, child: &Child) {
        let process = child.id().to_string();
        let kill = Command::new("kill").args([signal, &process]).status();
        assert!(kill.unwrap().success());
    }

    /// Waits until there is a file of such a name.
    #[track_caller]
    fn wait_for(folder: &Folder, end: &str) {
        let start = Instant::now();
        while !folder.names().iter().any(|name| name.ends_with(end)) {
            assert!(start.elapsed() < Duration::from_secs(60), "no {end}");
            sleep(Duration::from_millis(5));
        }
    }

    /// Takes minutes.
    const LONG: [&str; 6] = [
        "--size",
        "8000x2000",
        "--max-depth",
        "32",
        "--scalar",
        "f64",
    ];

    #[test]
    fn an_interrupted_run_leaves_the_older_picture_alone() {
        for (signal, number) in [("-INT", 2), ("-TERM", 15)] {
            let folder = Folder::new();
            folder.write("output.ppm", "older");
            let arguments = [&["render"], &LONG[..]].concat();
            let mut child = interruptible(&folder, &arguments).spawn().unwrap();
            sleep(Duration::from_millis(300));
            send(signal, &child);
            assert_eq!(child.wait().unwrap().signal(), Some(number));
            assert_eq!(folder.read("output.ppm"), b"older");
            assert_eq!(folder.names(), ["errors", "output.ppm"]);
        }
    }

    #[test]
    fn an_interrupted_turntable_leaves_nothing_unfinished_and_tells_how_to_go_on() {
        let folder = Folder::new();
        let turntable = [&["render", "--turntable", "9", "-o"][..], &["t.gif"], &LONG].concat();
        let mut child = interruptible(&folder, &turntable).spawn().unwrap();
        wait_for(&folder, ".part");
        send("-INT", &child);
        assert_eq!(child.wait().unwrap().signal(), Some(2));
        assert_eq!(folder.names(), ["errors"]);
        let said = String::from_utf8(folder.read("errors")).unwrap();
        assert!(
            said.contains("Interrupted: a GIF file is written whole or not at all."),
            "{said}"
        );

        let turntable = [
            "render",
            "--turntable",
            "2000",
            "-o",
            "t.ppm",
            "--size",
            "80x60",
        ];
        let mut child = interruptible(&folder, &turntable).spawn().unwrap();
        wait_for(&folder, "t-0000.ppm");
        send("-TERM", &child);
        assert_eq!(child.wait().unwrap().signal(), Some(15));
        let said = String::from_utf8(folder.read("errors")).unwrap();
        let rest = said.split("To go on, add --steps ").nth(1).unwrap();
        let next: usize = rest.split("..2000").next().unwrap().parse().unwrap();
        // All before are there, and whole.
        let names = folder.names();
        assert_eq!(
            names.iter().filter(|name| name.starts_with("t-")).count(),
            next,
            "{said}"
        );
        assert!(!names.iter().any(|name| name.ends_with(".part")));
        let sizes = (0..next).map(|step| folder.ppm(&format!("t-{step:04}.ppm")).width);
        assert!(sizes.eq(std::iter::repeat_n(80, next)));
    }

    #[test]
    fn what_is_started_with_signals_ignored_goes_on() {
        let folder = Folder::new();
        let script = format!(
            "trap '' INT; exec '{}' render --turntable 60 -o t.gif --size 80x60",
            env!("CARGO_BIN_EXE_scanray")
        );
        let mut command = Command::new("sh");
        command.args(["-c", &script]).current_dir(folder.path(""));
        let mut child = command.stderr(Stdio::null()).spawn().unwrap();
        wait_for(&folder, ".part");
        send("-INT", &child);
        assert!(child.wait().unwrap().success());
        assert_eq!(folder.names(), ["t.gif"]);
    }
}
