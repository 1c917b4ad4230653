//! Scenes as Rust source.

use scanray::ScenePools;

use crate::program::{Folder, SMALL_SCENE, scene};

/// What the library makes of a scene.
fn baked(text: &[u8]) -> String {
    let mut pools: ScenePools = ScenePools::new();
    pools.parse(text).unwrap();
    scanray::bake(&pools.as_scene()).to_string()
}

/// The source without the comment that says where it is from.
fn expression(source: Vec<u8>, from: &str) -> String {
    let source = String::from_utf8(source).unwrap();
    let (comment, expression) = source.split_once('\n').unwrap();
    assert!(comment.starts_with(&format!("// {from} by scanray ")));
    expression.trim_end().to_owned()
}

#[test]
fn writes_what_the_library_bakes() {
    let folder = Folder::new();
    folder.write("small.txt", SMALL_SCENE);
    let expected = baked(SMALL_SCENE.as_bytes());

    let printed = folder.succeed(&["bake", "small.txt"]).stdout;
    assert_eq!(expression(printed, "small.txt"), expected);

    let run = folder.succeed(&["bake", "small.txt", "-o", "small.rs"]);
    assert_eq!(run.stdout, b"");
    assert!(run.stderr.contains("small.rs saved"), "{}", run.stderr);
    assert_eq!(expression(folder.read("small.rs"), "small.txt"), expected);

    let piped = folder.run_with_input(&["bake", "-"], SMALL_SCENE.as_bytes());
    assert_eq!(expression(piped.stdout, "<stdin>"), expected);

    let text = std::fs::read(scene("default")).unwrap();
    let default = folder.succeed(&["bake"]).stdout;
    assert_eq!(expression(default, "<default scene>"), baked(&text));
}

#[test]
fn bakes_in_f64() {
    let folder = Folder::new();
    folder.write("small.txt", SMALL_SCENE);
    let run = folder.succeed(&["bake", "small.txt", "--scalar", "f64"]);
    let source = String::from_utf8(run.stdout).unwrap();
    assert!(source.contains("0.1_f64") && !source.contains("_f32"));
}

#[test]
fn a_bad_scene_leaves_the_older_file() {
    let folder = Folder::new();
    folder.write("bad.txt", SMALL_SCENE.replace("8 6", "8 tall"));
    folder.write("scene.rs", "old");
    let said = folder.fail(3, &["bake", "bad.txt", "-o", "scene.rs"]);
    assert!(said.contains("bad.txt:3:3"), "{said}");
    assert_eq!(folder.read("scene.rs"), b"old");
}
