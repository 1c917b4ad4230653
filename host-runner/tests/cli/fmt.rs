//! Scenes in canonical form.

use crate::program::{Folder, SMALL_SCENE, scene, tell};

/// The small scene in canonical form.
const CANONICAL: &str = "\
1
0 0 0
8 6
5 5 -5  1 1 1  1 1 1
0.1
1
0 0 0
0  0 0 3  1  0.8 0.2 0.2  0.5 0.5 0.5  1 1 1  0 50 0 0
";

#[test]
fn rewrites_in_place_once() {
    let folder = Folder::new();
    folder.write("a.txt", SMALL_SCENE);
    folder.write("b.txt", format!("# b\r\n\r\n{SMALL_SCENE}"));
    let run = folder.succeed(&["fmt", "a.txt", "b.txt"]);
    assert_eq!(run.stdout, b"");
    assert_eq!(
        run.stderr,
        "a.txt written in canonical form\nb.txt written in canonical form\n"
    );
    assert_eq!(folder.read("a.txt"), CANONICAL.as_bytes());
    assert_eq!(
        folder.read("b.txt"),
        format!("# b\n\n{CANONICAL}").as_bytes()
    );
    assert_eq!(folder.succeed(&["fmt", "a.txt", "b.txt"]).stderr, "");
    assert_eq!(folder.names(), ["a.txt", "b.txt"]);
}

#[test]
#[cfg(unix)]
fn the_file_keeps_its_owner_and_its_mode() {
    use std::fs::{Permissions, set_permissions};
    use std::os::unix::fs::{MetadataExt, PermissionsExt, chown};
    let folder = Folder::new();
    folder.write("a.txt", SMALL_SCENE);
    let path = folder.path("a.txt");
    if chown(&path, Some(12_345), Some(23_456)).is_err() {
        tell("only the mode is tested, because no file can be given to others here: fmt");
    }
    set_permissions(&path, Permissions::from_mode(0o624)).unwrap();
    let ids = || {
        let metadata = path.metadata().unwrap();
        (metadata.uid(), metadata.gid(), metadata.mode() & 0o7777)
    };
    let before = ids();
    folder.succeed(&["fmt", "a.txt"]);
    assert_eq!(folder.read("a.txt"), CANONICAL.as_bytes());
    assert_eq!(ids(), before);
}

#[test]
fn writes_elsewhere_and_leaves_the_file() {
    let folder = Folder::new();
    folder.write("a.txt", SMALL_SCENE);
    folder.succeed(&["fmt", "a.txt", "-o", "b.txt"]);
    assert_eq!(folder.read("a.txt"), SMALL_SCENE.as_bytes());
    assert_eq!(folder.read("b.txt"), CANONICAL.as_bytes());
    for run in [
        folder.run(&["fmt", "a.txt", "-o", "-"]),
        folder.run_with_input(&["fmt", "-"], SMALL_SCENE.as_bytes()),
    ] {
        assert_eq!((run.code, &*run.stderr), (0, ""));
        assert_eq!(run.stdout, CANONICAL.as_bytes());
    }
}

#[test]
fn check_writes_nothing() {
    let folder = Folder::new();
    folder.write("a.txt", SMALL_SCENE);
    folder.write("b.txt", CANONICAL);
    let said = folder.fail(1, &["fmt", "--check", "a.txt", "b.txt"]);
    assert_eq!(said, "a.txt is not in canonical form\n");
    assert_eq!(folder.read("a.txt"), SMALL_SCENE.as_bytes());
    assert_eq!(folder.succeed(&["fmt", "--check", "b.txt"]).stderr, "");
}

#[test]
fn pictures_keep_their_bits() {
    let folder = Folder::new();
    for name in [
        "default",
        "mirror-room",
        "pyramids",
        "reflective",
        "window-room",
    ] {
        folder.succeed(&["fmt", &scene(name), "-o", "tidy.txt"]);
        let before = folder.draw(&[&scene(name), "--size", "80x60"]);
        let after = folder.draw(&["tidy.txt", "--size", "80x60"]);
        assert!(before == after, "{name}");
        let warned = folder.succeed(&["inspect", "tidy.txt"]).stderr;
        assert_eq!(warned, "", "the light has its ninth number");
    }
}

#[test]
fn a_scene_with_an_error_is_left_as_it_is() {
    let folder = Folder::new();
    let bad = SMALL_SCENE.replace("0 0 3", "0 0 three");
    folder.write("bad.txt", &bad);
    folder.write("good.txt", SMALL_SCENE);
    for (code, arguments, words) in [
        (3, &["fmt", "bad.txt", "good.txt"][..], "bad.txt:8:8"),
        (3, &["fmt", "bad.txt", "-o", "new.txt"], "bad.txt:8:8"),
        (3, &["fmt", "--check", "bad.txt"], "bad.txt:8:8"),
        (4, &["fmt", "missing.txt"], "cannot read missing.txt"),
        (
            4,
            &["fmt", "good.txt", "-o", "no/where.txt"],
            "there is no folder no",
        ),
        (2, &["fmt"], "<SCENE>"),
        (
            2,
            &["fmt", "bad.txt", "good.txt", "-o", "-"],
            "leave -o out to rewrite each",
        ),
        (
            2,
            &["fmt", "good.txt", "--check", "-o", "x.txt"],
            "cannot be used with",
        ),
    ] {
        let said = folder.fail(code, arguments);
        assert!(said.contains(words), "{arguments:?}: {said}");
    }
    assert_eq!(folder.read("bad.txt"), bad.as_bytes());
    assert_eq!(folder.read("good.txt"), CANONICAL.as_bytes());
    assert_eq!(folder.names(), ["bad.txt", "good.txt"]);
}

#[test]
fn the_scenes_that_come_with_it_are_in_canonical_form() {
    let folder = Folder::new();
    for name in [
        "default",
        "mirror-room",
        "pyramids",
        "reflective",
        "window-room",
    ] {
        let run = folder.succeed(&["fmt", "--check", &scene(name)]);
        assert_eq!(run.stderr, "", "{name}");
    }
    let example = folder.succeed(&["example"]).stdout;
    folder.write("example.txt", example);
    folder.succeed(&["fmt", "--check", "example.txt"]);
}
