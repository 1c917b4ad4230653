//! Golden pictures: every scene of scenes/ at 160×120, and the default scene in the colours of small
//! displays, compared byte for byte. `BLESS=1 cargo test --test picture golden` accepts new pictures.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use crate::common::picture::Rgb;
use crate::common::{is_blessing, scenes};
use embedded_graphics::pixelcolor::{BinaryColor, Gray4, Rgb565, Rgb888, RgbColor};
use scanray::{
    Picture, Resolution, Tracer,
    render::{PixelSource, Quantizer},
};

const COMMAND: &str = "BLESS=1 cargo test --test picture golden";

const SCENE_SIZE: Resolution = Resolution {
    width: 160,
    height: 120,
};

const DISPLAY_SIZE: Resolution = Resolution {
    width: 64,
    height: 48,
};

/// A picture, row by row through the library, in the colours that a display shows.
fn render<P: PixelSource, Q: Quantizer>(
    picture: &Picture<P, Q>,
    show: fn(Q::Color) -> Rgb888,
) -> Rgb {
    Rgb::from_fn(picture.resolution(), |x, y| {
        let color = show(picture.pixel(x, y));
        [color.r(), color.g(), color.b()]
    })
}

/// Compares a picture with its file in tests/golden/, or writes the file. A difference is shown in
/// pictures and told in the answer.
fn check(name: &str, actual: &Rgb) -> Result<(), String> {
    let golden = scenes::path("tests/golden").join(format!("{name}.png"));
    if is_blessing() {
        // Left alone when it is right already: another encoder would change its bytes for nothing.
        if Rgb::read_png(&golden).as_ref() != Ok(actual) {
            actual.write_png(&golden);
        }
        return Ok(());
    }
    let shown = format!("tests/golden/{name}.png");
    if !golden.exists() {
        return Err(format!(
            "{shown} is missing. Make it, and look at it before it is committed, with\n    {COMMAND}"
        ));
    }
    let expected = Rgb::read_png(&golden)?;
    let Some(words) = actual.describe_difference(&expected) else {
        return Ok(());
    };
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("golden");
    let actual_file = folder.join(format!("{name}.actual.png"));
    actual.write_png(&actual_file);
    let mut message = format!(
        "the picture of {shown} {words}\n  actual:     {}",
        actual_file.display()
    );
    if actual.size == expected.size {
        let difference_file = folder.join(format!("{name}.difference.png"));
        actual.difference(&expected).write_png(&difference_file);
        message += &format!("\n  difference: {}", difference_file.display());
    }
    Err(message + &format!("\nIf the new picture is the right one, accept it with\n    {COMMAND}"))
}

fn report(results: impl IntoIterator<Item = Result<(), String>>) {
    let failures: Vec<String> = results.into_iter().filter_map(Result::err).collect();
    assert!(failures.is_empty(), "\n\n{}\n", failures.join("\n\n"));
}

#[test]
fn scenes_look_as_they_did() {
    report(scenes::names().iter().map(|name| {
        let pools = scenes::load::<f32>(name);
        let tracer = Tracer::new(pools.as_scene()).with_resolution(SCENE_SIZE);
        check(name, &render(&Picture::new(&tracer), |color: Rgb888| color))
    }));
}

#[test]
fn small_displays_look_as_they_did() {
    let pools = scenes::load::<f32>("default");
    let tracer = Tracer::new(pools.as_scene()).with_resolution(DISPLAY_SIZE);
    report([
        check(
            "displays/rgb565",
            &render(&Picture::new(&tracer), |color: Rgb565| color.into()),
        ),
        check(
            "displays/gray4-dithered",
            &render(&Picture::new(&tracer).dithered(), |color: Gray4| {
                color.into()
            }),
        ),
        check(
            "displays/binary-dithered",
            &render(&Picture::new(&tracer).dithered(), |color: BinaryColor| {
                color.into()
            }),
        ),
    ]);
}

#[test]
fn no_golden_picture_has_lost_its_scene() {
    let pictures = |folder: &Path| -> BTreeSet<String> {
        std::fs::read_dir(folder)
            .into_iter()
            .flatten()
            .map(|entry| entry.unwrap().path())
            .filter(|file| file.extension().is_some_and(|extension| extension == "png"))
            .map(|file| file.file_stem().unwrap().to_str().unwrap().to_owned())
            .collect()
    };
    let scenes: BTreeSet<String> = scenes::names().into_iter().collect();
    let lost: Vec<String> = pictures(&scenes::path("tests/golden"))
        .difference(&scenes)
        .cloned()
        .collect();
    assert!(
        lost.is_empty(),
        "tests/golden/ has pictures of scenes that are not in scenes/: {lost:?}"
    );
}

#[test]
fn a_difference_is_found_shown_and_described() {
    let size = Resolution {
        width: 3,
        height: 2,
    };
    let old = Rgb::from_fn(size, |x, y| [x as u8, y as u8, 40]);
    let mut new = old.clone();
    assert_eq!(new.describe_difference(&old), None);
    new.pixels[4][2] = 39;
    let words = new.describe_difference(&old).unwrap();
    assert_eq!(
        words,
        "differs in 1 of 6 pixels by up to 1 levels, first at column 1 of row 1: [1, 1, 39] instead of \
         [1, 1, 40]"
    );
    let shown = new.difference(&old);
    assert_eq!(shown.pixels[4], [0, 0, 128]);
    assert!(
        shown
            .pixels
            .iter()
            .filter(|p| p.iter().any(|c| *c > 100))
            .count()
            == 1
    );
    // What is written to a file is what is read from it.
    let file = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("round-trip.png");
    new.write_png(&file);
    assert_eq!(Rgb::read_png(&file), Ok(new));
}
