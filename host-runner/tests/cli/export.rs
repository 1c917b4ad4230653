//! Scenes for POV-Ray.

use crate::program::{Folder, SMALL_SCENE};

#[test]
fn writes_a_file_or_standard_output() {
    let folder = Folder::new();
    folder.write("scene.txt", SMALL_SCENE);
    let run = folder.succeed(&["export", "scene.txt", "-o", "scene.pov"]);
    assert_eq!(run.stderr, "Scene for POV-Ray written to scene.pov\n");
    let pov = String::from_utf8(folder.read("scene.pov")).unwrap();
    for words in [
        "//   povray +Iscene.pov +Oscene.png +W8 +H6 -A File_Gamma=1.0\n",
        "#version 3.7;\n",
        "max_trace_level 6 ",
        "camera { perspective location <0.0, 0.0, 0.0> direction z up 2*y right 2.6666666666666665*x }\n",
        "light_source { <5.0, 5.0, -5.0>, rgb <1.0, 1.0, 1.0> }\n",
        "sphere { <0.0, 0.0, 3.0>, 1.0 pigment { rgb <0.8, 0.2, 0.2> }",
        "phong 0.5 phong_size 50.0 }",
    ] {
        assert!(pov.contains(words), "{words}: {pov}");
    }
    let printed = folder.succeed(&["export", "scene.txt"]).stdout;
    assert_eq!(String::from_utf8(printed).unwrap(), pov);
    let settings = ["--size", "300x100", "--max-depth", "0"];
    let printed = folder
        .succeed(&[&["export", "scene.txt"], &settings[..]].concat())
        .stdout;
    let pov = String::from_utf8(printed).unwrap();
    assert!(
        pov.contains("max_trace_level 1 ") && pov.contains("right 6.0*x"),
        "{pov}"
    );
}

#[test]
fn the_command_in_the_file_can_be_pasted() {
    let folder = Folder::new();
    folder.write("scene.txt", SMALL_SCENE);
    folder.succeed(&["export", "scene.txt", "-o", "it's a.pov"]);
    let pov = String::from_utf8(folder.read("it's a.pov")).unwrap();
    let command = r"povray '+Iit'\''s a.pov' '+Oit'\''s a.png' +W8 +H6 -A File_Gamma=1.0";
    assert!(pov.contains(&format!("//   {command}\n")), "{pov}");
}

#[test]
fn rejects_what_the_other_commands_reject() {
    let folder = Folder::new();
    folder.write("scene.txt", SMALL_SCENE.replace("0 0 3  1", "0 0 3  1e-60"));
    let said = folder.fail(3, &["export", "scene.txt"]);
    assert_eq!(said, folder.fail(3, &["inspect", "scene.txt"]));
    assert!(said.contains("scene.txt:8:11"), "{said}");
    let arguments = ["export", "scene.txt", "--scalar", "f64"];
    let pov = String::from_utf8(folder.succeed(&arguments).stdout).unwrap();
    assert!(pov.contains("<0.0, 0.0, 3.0>, 1e-60 "), "{pov}");
}

#[test]
fn wrong_input_is_told() {
    let folder = Folder::new();
    folder.write("scene.txt", SMALL_SCENE);
    folder.write("bad.txt", "1 x");
    for (code, arguments, words) in [
        (2, &["export"][..], "<SCENE>"),
        (
            2,
            &["export", "scene.txt", "-o", "scene.obj"],
            "must end in .pov",
        ),
        (
            2,
            &["export", "scene.txt", "--max-depth", "33"],
            "from 0 (no mirror rays) to 32",
        ),
        (3, &["export", "bad.txt", "-o", "bad.pov"], "bad.txt:1:3"),
        (4, &["export", "missing.txt"], "cannot read missing.txt"),
        (
            4,
            &["export", "scene.txt", "-o", "no/where.pov"],
            "there is no folder no",
        ),
    ] {
        let said = folder.fail(code, arguments);
        assert!(said.contains(words), "{arguments:?}: {said}");
    }
    assert_eq!(folder.names(), ["bad.txt", "scene.txt"]);
}
