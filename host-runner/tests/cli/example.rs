//! The scene to start from.

use crate::program::Folder;

#[test]
fn is_the_default_scene_in_canonical_form_without_warnings() {
    let folder = Folder::new();
    let run = folder.succeed(&["example"]);
    assert_eq!(run.stderr, "");
    folder.write("scene.txt", &run.stdout);
    let run = folder.succeed(&["fmt", "--check", "scene.txt"]);
    assert_eq!(run.stderr, "");
    for scalar in ["f32", "f64"] {
        let settings = ["--size", "40x30", "--scalar", scalar];
        let default = folder.draw(&settings);
        assert_eq!(
            folder.draw(&[&["scene.txt"], &settings[..]].concat()),
            default
        );
    }
    let data = |scene: &[&str]| folder.succeed(&[&["inspect"], scene].concat()).stdout;
    assert_eq!(data(&["scene.txt"]), data(&[]));
}
