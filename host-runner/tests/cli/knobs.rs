//! What trades time for quality: cut-off, samples, edges, previews.

use serde_json::Value;

use crate::program::{Folder, Picture, scene};

/// A picture and what it took.
fn draw(folder: &Folder, options: &[&str]) -> (Picture, Value) {
    let run = folder.succeed(&[&["render", "--json", "--size", "50x40"], options].concat());
    let report = serde_json::from_slice(&run.stdout).unwrap();
    (folder.ppm("output.ppm"), report)
}

fn rays(report: &Value) -> u64 {
    report["rays"]["total"].as_u64().unwrap()
}

#[test]
fn a_cutoff_of_the_display_saves_rays_and_stays_within_a_level() {
    let folder = Folder::new();
    let (whole, all) = draw(&folder, &[]);
    let (cut, fewer) = draw(&folder, &["--cutoff", "auto"]);
    assert!(rays(&fewer) < rays(&all));
    assert_eq!(fewer["cutoff"], 1.0 / 256.0);
    let pairs = whole.rgb888.iter().zip(&cut.rgb888);
    assert!(pairs.clone().all(|(whole, cut)| whole - cut <= 1));
    assert!(pairs.clone().any(|(whole, cut)| whole != cut));

    let (same, report) = draw(&folder, &["--cutoff", "1/256"]);
    assert!(same == cut && rays(&report) == rays(&fewer));
    assert!(draw(&folder, &["--cutoff", "none"]).0 == whole);
    assert!(draw(&folder, &["--cutoff", "0"]).0 == whole);
    let (_, coarse) = draw(&folder, &["--cutoff", "auto", "--color", "rgb565"]);
    assert_eq!(coarse["cutoff"], 1.0 / 64.0);
    assert!(rays(&coarse) < rays(&fewer));
}

#[test]
fn samples_and_edges() {
    let folder = Folder::new();
    let (one, first) = draw(&folder, &["--samples", "1"]);
    assert!(one == draw(&folder, &[]).0);
    let primary = |report: &Value| report["rays"]["primary"].as_u64().unwrap();
    assert_eq!(primary(&first), 50 * 40);
    let (sixteen, report) = draw(&folder, &["--samples", "16"]);
    assert_eq!(
        (primary(&report), &report["samples"]),
        (16 * 50 * 40, &16.into())
    );

    // At edges the pixels of 16 samples, elsewhere those of one.
    let (adaptive, report) = draw(&folder, &["--adaptive", "1/16"]);
    assert_eq!(
        (&report["samples"], &report["adaptive"]),
        (&16.into(), &0.0625.into())
    );
    let pixels = |picture: &Picture| -> Vec<[u8; 3]> { picture.rgb888.as_chunks().0.to_vec() };
    let [one, sixteen, adaptive] = [one, sixteen, adaptive].map(|picture| pixels(&picture));
    let mut refined = 0;
    for ((one, sixteen), adaptive) in one.iter().zip(&sixteen).zip(&adaptive) {
        assert!(adaptive == one || adaptive == sixteen);
        refined += u64::from(adaptive != one);
    }
    assert!(refined > 100, "{refined}");
    assert!(primary(&report) >= 50 * 40 + 16 * refined);
    assert!(primary(&report) < 16 * 50 * 40);
}

#[test]
fn previews_are_blocks() {
    let folder = Folder::new();
    let (full, _) = draw(&folder, &["--preview", "full"]);
    for (detail, block) in [("quarter", 4), ("half", 2)] {
        let (preview, report) = draw(&folder, &["--preview", detail]);
        assert_eq!(report["preview"], detail);
        let [columns, rows] = [50_usize, 40].map(|side| side.div_ceil(block));
        assert_eq!(report["rays"]["primary"], columns * rows);
        let at = |picture: &Picture, x: usize, y: usize| -> [u8; 3] {
            picture.rgb888[3 * (y * 50 + x)..][..3].try_into().unwrap()
        };
        for (x, y) in (0..40).flat_map(|y| (0..50).map(move |x| (x, y))) {
            let first = at(&full, x / block * block, y / block * block);
            assert_eq!(at(&preview, x, y), first, "{x},{y}");
        }
    }
}

#[test]
fn parts_and_threads_have_the_bits_of_the_whole() {
    let folder = Folder::new();
    let every_knob = [
        "--cutoff",
        "1/64",
        "--samples",
        "4",
        "--adaptive",
        "0.05",
        "--preview",
        "half",
    ];
    for knobs in [
        &every_knob[..],
        &every_knob[2..],
        &every_knob[..6],
        &every_knob[2..6],
    ] {
        let scene = scene("window-room");
        let options = [&["--size", "40x31", scene.as_str()], knobs].concat();
        let whole = folder.draw(&options);
        let mut joined = Vec::new();
        for (rows, threads) in [("..1", "1"), ("1..14", "2"), ("14..31", "3")] {
            let part = [&options[..], &["--rows", rows, "--threads", threads]].concat();
            joined.extend(folder.draw(&part).rgb888);
        }
        assert!(joined == whole.rgb888, "{knobs:?}");
    }
}

#[test]
fn a_pixel_is_told_with_all_its_samples() {
    let folder = Folder::new();
    let scene = scene("default");
    let pixel = |options: &[&str]| {
        let run = folder.succeed(
            &[
                &["pixel", scene.as_str(), "25,20", "--size", "50x40"],
                options,
            ]
            .concat(),
        );
        String::from_utf8(run.stdout).unwrap()
    };
    let count = |text: String| text.matches("from the camera").count();
    assert_eq!(count(pixel(&[])), 1);
    assert_eq!(count(pixel(&["--samples", "4"])), 4);
}

#[test]
fn mistakes_are_told() {
    let folder = Folder::new();
    let error = folder.fail(2, &["render", "--cutoff", "2"]);
    assert!(
        error.contains("a share from 0 to 1, such as 1/256; or none, or auto"),
        "{error}"
    );
    let error = folder.fail(2, &["render", "--samples", "8"]);
    assert!(error.contains("possible values: 1, 4, 16, 64"), "{error}");
    let error = folder.fail(2, &["render", "--adaptive", "-1"]);
    assert!(error.contains("a share from 0 to 1"), "{error}");
    let error = folder.fail(2, &["render", "--adaptive", "1/16", "--samples", "1"]);
    assert!(error.contains("give --samples 4, 16 or 64"), "{error}");
}
