//! Each file of scenes/invalid/ is rejected with the message beside it, and leaves the pools empty.
//!
//! `BLESS=1 cargo test --test repository invalid_scenes` rewrites the messages; read them before they are committed.

use std::path::PathBuf;

use crate::common::rejection::{check_place, rejection};
use crate::common::{is_blessing, scenes};

#[test]
fn every_invalid_scene_has_its_message() {
    let mut files: Vec<PathBuf> = std::fs::read_dir(scenes::path("scenes/invalid"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    files.sort();
    let mut count = 0;
    let mut failures = Vec::new();
    for file in &files {
        let name = file.file_name().unwrap().to_str().unwrap();
        let mut fail = |what: String| failures.push(format!("scenes/invalid/{name} {what}"));
        match file.extension().and_then(|extension| extension.to_str()) {
            Some("txt") => {}
            Some("expected") => {
                if !file.with_extension("txt").exists() {
                    fail(String::from("has no .txt beside it"));
                }
                continue;
            }
            _ => {
                fail(String::from("is neither a .txt nor a .expected"));
                continue;
            }
        }
        count += 1;
        let text = std::fs::read(file).unwrap();
        let error = match rejection(&text) {
            Ok(error) => error,
            Err(what) => {
                fail(what);
                continue;
            }
        };
        if let Err(what) = check_place(&text, &error) {
            fail(what);
        }
        let actual = format!("{error}\n");
        let message = file.with_extension("expected");
        if is_blessing() {
            std::fs::write(&message, actual).unwrap();
            continue;
        }
        match std::fs::read_to_string(&message) {
            Ok(expected) if expected == actual => {}
            Ok(expected) => fail(format!("\n  says:     {actual}  expected: {expected}")),
            Err(_) => fail(String::from("has no .expected beside it")),
        }
    }
    assert!(
        failures.is_empty(),
        "\n{}\nIf the messages are right, accept them with\n    BLESS=1 cargo test --test repository invalid_scenes\n",
        failures.join("\n")
    );
    assert!(count > 100, "only {count} files in scenes/invalid/");
}
