//! `scanray stability`.

use std::fs;
use std::path::Path;

use crate::program::Folder;

/// A file of docs/.
fn docs(name: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../docs")
        .join(name)
}

#[test]
fn what_is_measured_is_what_the_documentation_shows() {
    let folder = Folder::new();
    let cases = ["3", "17", "26", "44", "67"];
    let arguments = [
        &["stability"],
        &cases[..],
        &["--markdown", "-o", "pictures"],
    ]
    .concat();
    let run = folder.succeed(&arguments);
    let printed = String::from_utf8(run.stdout).unwrap();
    let document = fs::read_to_string(docs("stability.md")).unwrap();
    let mut rows = 0;
    for line in printed.lines().filter(|line| line.starts_with("| ")) {
        assert!(
            document.contains(line),
            "docs/stability.md has no line {line}"
        );
        rows += 1;
    }
    assert!(rows > 30, "{printed}");
    let mut pictures = 0;
    for entry in fs::read_dir(docs("stability")).unwrap() {
        let expected = entry.unwrap().path();
        let name = expected.file_name().unwrap().to_str().unwrap();
        let drawn = fs::read(folder.path("pictures").join(name)).unwrap();
        assert!(drawn == fs::read(&expected).unwrap(), "{name} differs");
        pictures += 1;
    }
    assert_eq!(pictures, 7);
    assert_eq!(fs::read_dir(folder.path("pictures")).unwrap().count(), 7);
}

#[test]
fn figures_are_json_too() {
    let folder = Folder::new();
    let run = folder.succeed(&["stability", "6", "25", "68", "--json"]);
    let json: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap();
    let cases = json.as_array().unwrap();
    let numbers: Vec<_> = cases
        .iter()
        .map(|case| case["case"].as_u64().unwrap())
        .collect();
    assert_eq!(numbers, [6, 6, 25, 25, 68, 68]);
    assert!(cases.iter().all(|case| case["pass"] == true));
    assert_eq!(cases[0]["scalar"], "f32");
    assert_eq!(cases[0]["figures"][0]["measured"], 0.0);
    assert_eq!(cases[0]["figures"][0]["of"], 12);
    assert!(cases[4]["checked_on_boards"].is_string());
}

#[test]
fn the_table_names_the_cases_and_counts_the_figures() {
    let folder = Folder::new();
    let run = folder.succeed(&["stability", "8", "--quick"]);
    let table = String::from_utf8(run.stdout).unwrap();
    assert!(
        table.starts_with(" 8 camera at the centre of a sphere: "),
        "{table}"
    );
    assert!(table.contains("   f64  yes"), "{table}");
    assert!(
        table.ends_with("2 figures, 0 beyond their bound\n"),
        "{table}"
    );
    let run = folder.run(&["stability", "74"]);
    assert_eq!(run.code, 2, "{}", run.stderr);
}

#[test]
fn seeds_are_printed_and_asked_for() {
    let folder = Folder::new();
    let measured = |seed: &str| {
        let mut program = folder.program(&["stability", "3"]);
        let output = program.env("SEED", seed).output().unwrap();
        let [table, said] =
            [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
        (output.status.code(), table, said)
    };
    let (code, table, _) = measured("7");
    assert_eq!(code, Some(0), "{table}");
    assert!(table.contains(" (seed 7)"), "{table}");
    for word in ["word", "-1", ""] {
        let (code, _, said) = measured(word);
        assert_eq!(code, Some(2), "{said}");
        assert!(
            said.contains(&format!("SEED is `{word}`: give it a whole number")),
            "{said}"
        );
    }
}
