//! The picture at the head of the crate's documentation is the golden picture of the default scene.

mod common;

use common::scenes::path;

const FILE: &str = "docs/default-scene.md";

#[test]
fn shows_the_golden_picture() {
    let png = std::fs::read(path("tests/golden/default.png")).unwrap();
    let expected = format!(
        "![The default scene](data:image/png;base64,{})\n",
        base64(&png)
    );
    if common::is_blessing() {
        std::fs::write(path(FILE), expected).unwrap();
        return;
    }
    assert!(
        std::fs::read_to_string(path(FILE)).is_ok_and(|text| text == expected),
        "{FILE} does not hold tests/golden/default.png: BLESS=1 cargo test --test documentation"
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
