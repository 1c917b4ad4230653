//! The listing of a scene.

use crate::program::{Folder, SMALL_SCENE, scene};

/// The listing of the published example, as published.
const DEFAULT_LISTING: &str = "\
SCENE DATA
Number of Objects: 7
Camera Position: (0.000000, 0.000000, 0.000000)
Image properties: 800x600
Light Source Direction: (50.000000, 50.000000, 0.000000)
Light Source Diffuse Colour: (1.000000, 1.000000, 1.000000)
Light Source Specular Colour: (1.000000, 1.000000, 1.000000)
Ambient Intensity: 0.100000
Use Sky Gradient Background (1-Yes; 0-No): 1
Background Colour: (0.500000, 0.500000, 1.000000)
SPHERE: centre(1.50, 1.00, 4.00), radius=0.50, diffuse(0.60, 0.10, 0.10), specular(0.50, 0.50, 0.50), ambient(1.00, 1.00, 1.00), reflection=0.20, shininess=50.00, refraction=0.00, indexOfRefraction=0.00
SPHERE: centre(0.00, 0.00, 2.50), radius=1.00, diffuse(0.10, 0.10, 0.10), specular(0.50, 0.50, 0.50), ambient(1.00, 1.00, 1.00), reflection=0.10, shininess=50.00, refraction=0.70, indexOfRefraction=1.50
SPHERE: centre(-2.50, 0.00, 4.50), radius=1.00, diffuse(0.10, 0.10, 0.60), specular(0.50, 0.50, 0.50), ambient(1.00, 1.00, 1.00), reflection=0.50, shininess=50.00, refraction=0.00, indexOfRefraction=0.00
SPHERE: centre(0.00, 2.50, 4.50), radius=1.00, diffuse(0.10, 0.10, 0.60), specular(0.50, 0.50, 0.50), ambient(1.00, 1.00, 1.00), reflection=0.50, shininess=50.00, refraction=0.00, indexOfRefraction=0.00
SPHERE: centre(-2.50, 0.00, -2.50), radius=1.00, diffuse(0.10, 0.10, 0.60), specular(0.50, 0.50, 0.50), ambient(1.00, 1.00, 1.00), reflection=0.50, shininess=50.00, refraction=0.00, indexOfRefraction=0.00
PLANE: normal(0.00, 1.00, 0.00), distance=1.00, diffuse(0.50, 0.50, 0.50), specular(0.10, 0.10, 0.10), ambient(1.00, 1.00, 1.00), reflection=0.30, shininess=50.00, refraction=0.00, indexOfRefraction=0.00
TRIANGLE: T1(2.00, 0.50, 2.50), T2(3.00, 0.50, 1.50), T3(2.50, 1.50, 2.00), normal(-0.71, 0.00, -0.71), distance=3.18, diffuse(0.80, 0.10, 0.20), specular(0.50, 0.50, 0.50), ambient(1.00, 1.00, 1.00), reflection=0.20, shininess=50.00, refraction=0.00, indexOfRefraction=0.00
";

#[test]
fn lists_the_published_example_as_published() {
    let folder = Folder::new();
    let path = scene("default");
    for arguments in [
        &["inspect"][..],
        &["inspect", &path],
        &["inspect", &path, "--scalar", "f64"],
    ] {
        let run = folder.succeed(arguments);
        assert_eq!(String::from_utf8(run.stdout).unwrap(), DEFAULT_LISTING);
    }
}

#[test]
fn keeps_the_order_of_the_file_and_prints_no_minus_zero() {
    let folder = Folder::new();
    let material = "-0 0 0  0 0 0  0 0 0  0 1e6 0 0.001";
    let scene = format!(
        "3\n-0 -0.0000001 1\n8 6\n0 0 0 0 0 0 0 0 0\n0\n0\n.25 1.5 0\n\
         1  0 0 -2  -0  {material}\n\
         2  0 0 0  1 0 0  0 1 0  9 9 9 9  {material}\n\
         0  -0.004 -0.006 12345.678  .125  {material}\n"
    );
    let run = folder.run_with_input(&["inspect", "-"], scene.as_bytes());
    let material = "diffuse(0.00, 0.00, 0.00), specular(0.00, 0.00, 0.00), ambient(0.00, 0.00, 0.00), \
                    reflection=0.00, shininess=1000000.00, refraction=0.00, indexOfRefraction=0.00";
    let expected = format!(
        "SCENE DATA\n\
         Number of Objects: 3\n\
         Camera Position: (0.000000, 0.000000, 1.000000)\n\
         Image properties: 8x6\n\
         Light Source Direction: (0.000000, 0.000000, 0.000000)\n\
         Light Source Diffuse Colour: (0.000000, 0.000000, 0.000000)\n\
         Light Source Specular Colour: (0.000000, 0.000000, 0.000000)\n\
         Ambient Intensity: 0.000000\n\
         Use Sky Gradient Background (1-Yes; 0-No): 0\n\
         Background Colour: (0.250000, 1.500000, 0.000000)\n\
         PLANE: normal(0.00, 0.00, -1.00), distance=0.00, {material}\n\
         TRIANGLE: T1(0.00, 0.00, 0.00), T2(1.00, 0.00, 0.00), T3(0.00, 1.00, 0.00), \
         normal(0.00, 0.00, -1.00), distance=0.00, {material}\n\
         SPHERE: centre(0.00, -0.01, 12345.68), radius=0.12, {material}\n"
    );
    assert_eq!(String::from_utf8(run.stdout).unwrap(), expected);
    assert_eq!((run.code, &*run.stderr), (0, ""));
}

#[test]
fn lists_the_normalised_plane() {
    let folder = Folder::new();
    let plane = "1 0 2 0 3  0 0 0 0 0 0 0 0 0 0 0 0 0\n";
    let text = SMALL_SCENE.replacen('1', "2", 1) + plane;
    let run = folder.run_with_input(&["inspect", "-"], text.as_bytes());
    let listing = String::from_utf8(run.stdout).unwrap();
    assert!(
        listing.contains("PLANE: normal(0.00, 1.00, 0.00), distance=1.50, "),
        "{listing}"
    );
}
