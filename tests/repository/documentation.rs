//! What the documentation shows is what there is: the golden picture of the default scene, code of an example.

use crate::common::is_blessing;
use crate::common::scenes::path;

const FILE: &str = "docs/default-scene.md";

#[test]
fn shows_the_golden_picture() {
    let png = std::fs::read(path("tests/golden/default.png")).unwrap();
    let expected = format!(
        "![The default scene](data:image/png;base64,{})\n",
        base64(&png)
    );
    if is_blessing() {
        std::fs::write(path(FILE), expected).unwrap();
        return;
    }
    assert!(
        std::fs::read_to_string(path(FILE)).is_ok_and(|text| text == expected),
        "{FILE} does not hold tests/golden/default.png: BLESS=1 cargo test --test repository documentation"
    );
}

#[test]
fn the_readme_quotes_an_example_of_the_firmware() {
    let read = |file| std::fs::read_to_string(path(file)).unwrap();
    let (readme, example) = (read("README.md"), read("firmware/examples/oled.rs"));
    let (_, quoted) = readme.split_once("```rust,ignore\n").unwrap();
    let (quoted, _) = quoted.split_once("```").unwrap();
    assert!(quoted.contains("tracer_for!"), "{quoted}");
    assert!(
        example.contains(quoted),
        "firmware/examples/oled.rs has not:\n{quoted}"
    );
}

/// RFC 4648, with padding.
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    bytes
        .chunks(3)
        .flat_map(|chunk| {
            let group = chunk
                .iter()
                .chain(&[0; 2])
                .take(3)
                .fold(0_u32, |group, byte| group << 8 | u32::from(*byte));
            (0..4).map(move |digit| {
                if digit > chunk.len() {
                    '='
                } else {
                    DIGITS[(group >> (18 - 6 * digit) & 63) as usize] as char
                }
            })
        })
        .collect()
}
