//! The dialogue.

use crate::program::{Folder, SMALL_SCENE};

const FIRST: &str = "Enter 1 for default scene input file or 0 to specify filename: ";
const NAME: &str = "Enter the name of the input text file (ex.'scenedata.txt'): ";

#[test]
fn the_dialogue_is_that_of_the_original() {
    let folder = Folder::new();
    folder.write("scenedata.txt", SMALL_SCENE);
    let run = folder.run_with_input(&["ask"], b"0\nscenedata.txt\n");
    let said = String::from_utf8(run.stdout).unwrap();
    let listing = "\
SCENE DATA
Number of Objects: 1
Camera Position: (0.000000, 0.000000, 0.000000)
Image properties: 8x6
Light Source Direction: (5.000000, 5.000000, -5.000000)
Light Source Diffuse Colour: (1.000000, 1.000000, 1.000000)
Light Source Specular Colour: (1.000000, 1.000000, 1.000000)
Ambient Intensity: 0.100000
Use Sky Gradient Background (1-Yes; 0-No): 1
Background Colour: (0.000000, 0.000000, 0.000000)
SPHERE: centre(0.00, 0.00, 3.00), radius=1.00, diffuse(0.80, 0.20, 0.20), specular(0.50, 0.50, 0.50), \
ambient(1.00, 1.00, 1.00), reflection=0.00, shininess=50.00, refraction=0.00, indexOfRefraction=0.00
";
    let place = std::fs::canonicalize(folder.path("")).unwrap();
    let expected = format!(
        "RAY TRACER\n{FIRST}{NAME}\n{listing}\nImage file output.ppm saved in {}\n",
        place.display()
    );
    assert_eq!(said, expected);
    assert_eq!((run.code, &*run.stderr), (0, ""));
    let asked = folder.ppm("output.ppm");
    assert_eq!(asked, folder.draw(&["scenedata.txt"]));
}

#[test]
fn one_is_the_default_scene() {
    let folder = Folder::new();
    let run = folder.run_with_input(&["ask"], b" 1 \r\n");
    assert_eq!(run.code, 0, "{}", run.stderr);
    let said = String::from_utf8(run.stdout).unwrap();
    assert!(said.starts_with(&format!(
        "RAY TRACER\n{FIRST}\nSCENE DATA\nNumber of Objects: 7\n"
    )));
    assert_eq!(folder.names(), ["output.ppm"]);
}

#[test]
fn wrong_answers_are_asked_for_again() {
    let folder = Folder::new();
    folder.write("bad.txt", "1 x");
    folder.write("good.txt", SMALL_SCENE);
    let answers = b"2\n\nyes\n0\n\nmissing.txt\n0\nbad.txt\n0\n  good.txt\n";
    let run = folder.run_with_input(&["ask"], answers);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let said = String::from_utf8(run.stdout).unwrap();
    assert_eq!(said.matches(FIRST).count(), 6);
    assert_eq!(said.matches(NAME).count(), 4);
    assert_eq!(run.stderr.matches("Please answer 1 or 0.\n").count(), 3);
    for words in [
        "Please name a file.",
        "cannot read missing.txt: ",
        "bad.txt:1:3",
    ] {
        assert!(run.stderr.contains(words), "{}", run.stderr);
    }
    assert_eq!(folder.names(), ["bad.txt", "good.txt", "output.ppm"]);
}

#[test]
fn the_end_of_the_input_is_a_polite_end() {
    let folder = Folder::new();
    for (answers, code) in [
        (&b""[..], 0),
        (b"2\n", 0),
        (b"0", 0),
        (b"0\nmissing.txt\n", 4),
        (b"0\n.\n0\n", 4),
    ] {
        let run = folder.run_with_input(&["ask"], answers);
        assert_eq!(run.code, code);
        assert!(
            run.stderr
                .ends_with("The input has ended: no picture is drawn.\n"),
            "{}",
            run.stderr
        );
        assert!(run.stdout.ends_with(b": \n"));
    }
    assert_eq!(folder.names(), [""; 0]);
}

#[test]
fn a_picture_that_cannot_be_written_is_told() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("output.ppm")).unwrap();
    let run = folder.run_with_input(&["ask"], b"1\n");
    assert_eq!(run.code, 4);
    assert!(
        run.stderr
            .contains("error: cannot write output.ppm: it is a folder"),
        "{}",
        run.stderr
    );
}

#[test]
fn a_scene_is_not_overwritten_by_its_picture() {
    let folder = Folder::new();
    folder.write("output.ppm", SMALL_SCENE);
    let run = folder.run_with_input(&["ask"], b"0\noutput.ppm\n");
    assert_eq!(run.code, 2, "{}", run.stderr);
    assert!(
        run.stderr.contains("would overwrite what is read"),
        "{}",
        run.stderr
    );
    assert!(folder.read("output.ppm") == SMALL_SCENE.as_bytes());
}
