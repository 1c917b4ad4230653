//! Generated scenes.

use crate::program::Folder;

/// Objects by kind of a scene in text.
fn kinds(text: &str) -> [usize; 3] {
    let is = |kind| move |line: &&str| line.split(' ').count() > 13 && line.starts_with(kind);
    ["0 ", "1 ", "2 "].map(|kind| text.lines().filter(is(kind)).count())
}

fn generate(folder: &Folder, arguments: &[&str]) -> String {
    let run = folder.succeed(&[&["generate"], arguments].concat());
    String::from_utf8(run.stdout).unwrap()
}

#[test]
fn writes_as_many_objects_as_asked_for() {
    let folder = Folder::new();
    let spheres = generate(&folder, &["spheres", "--count", "321"]);
    assert_eq!(kinds(&spheres), [321, 1, 0]);
    // 20 f² triangles.
    let mesh = generate(&folder, &["icosphere", "--count", "700"]);
    assert_eq!(kinds(&mesh), [0, 1, 500]);
    assert!(mesh.starts_with("# scanray generate icosphere --count 700 --seed 1\n501 # objects\n"));
    let error = folder.fail(2, &["generate", "icosphere", "--count", "19"]);
    assert!(error.contains("at least 20 triangles"), "{error}");
    folder.fail(2, &["generate", "spheres", "--count", "131073"]);
    folder.fail(2, &["generate", "cubes"]);
}

#[test]
fn the_seed_alone_decides() {
    let folder = Folder::new();
    for kind in ["spheres", "icosphere"] {
        let scene = |seed| generate(&folder, &[kind, "--count", "100", "--seed", seed]);
        assert_eq!(scene("7"), scene("7"));
        assert_ne!(kinds(&scene("7"))[1], 0);
        let objects = |text: String| text.lines().skip(8).collect::<String>();
        assert_ne!(objects(scene("7")), objects(scene("8")));
    }
    // The first sphere of the default seed, so that figures of different versions can be compared.
    let spheres = generate(&folder, &["spheres", "--count", "1000"]);
    let first = spheres.lines().nth(9).unwrap();
    let geometry: Vec<&str> = first.split(' ').take(5).collect();
    assert_eq!(
        geometry,
        ["0", "0.532493", "2.456018", "11.739025", "0.094436"]
    );
}

#[test]
fn is_drawn_by_its_bvh_with_both_scalars() {
    let folder = Folder::new();
    folder.succeed(&["generate", "spheres", "--count", "300", "-o", "many.txt"]);
    for scalar in ["f32", "f64"] {
        let render = [
            "render", "many.txt", "--size", "40x30", "--scalar", scalar, "--json",
        ];
        let run = folder.succeed(&[&render[..], &["-o", &format!("{scalar}.ppm")]].concat());
        let report: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap();
        let number = |place| report.pointer(place).unwrap().as_u64().unwrap();
        assert!(number("/tests/box") > 0);
        // Brute force takes 300 for each ray.
        assert!(number("/tests/sphere") < 20 * number("/rays/total"));
    }
    let baked = folder.succeed(&["bake", "many.txt"]);
    let source = String::from_utf8(baked.stdout).unwrap();
    assert!(source.contains("::scanray::accel::BvhNode::new("));
}
