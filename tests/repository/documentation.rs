//! What the documentation shows is what there is: the golden picture of the default scene, code of an example, files that
//! links lead to.

use std::path::Path;

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

/// Whether the package of the core holds a file or folder of the repository.
fn is_packaged(file: &Path) -> bool {
    let manifest = std::fs::read_to_string(path("Cargo.toml")).unwrap();
    let (_, package) = manifest.split_once("\n[package]\n").unwrap();
    let (_, excluded) = package.split_once("\nexclude = [").unwrap();
    let (excluded, _) = excluded.split_once(']').unwrap();
    let is_excluded = excluded
        .split(',')
        .any(|name| file.starts_with(name.trim().trim_matches('"')));
    let is_of_another_package = file
        .ancestors()
        .filter(|folder| !folder.as_os_str().is_empty())
        .any(|folder| path("").join(folder).join("Cargo.toml").exists());
    path("").join(file).exists() && !is_excluded && !is_of_another_package
}

/// What Markdown links to or shows, web addresses and embedded data aside.
fn links(markdown: &str) -> Vec<&str> {
    let between = |open: &'static str, close: &'static str| {
        let parts = markdown.split(open).skip(1);
        parts.filter_map(move |part| part.split_once(close).map(|(target, _)| target))
    };
    between("](", ")")
        .chain(between("src=\"", "\""))
        .filter(|target| !target.contains("://") && !target.starts_with("data:"))
        .filter(|target| !target.starts_with('#'))
        .collect()
}

#[test]
fn links_lead_to_files_of_the_package() {
    let mut count = 0;
    let mut dead = Vec::new();
    let docs = std::fs::read_dir(path("docs")).unwrap();
    let docs = docs.map(|file| Path::new("docs").join(file.unwrap().file_name()));
    let files = ["README.md", "CHANGELOG.md", "docs/error-vs-time/report.md"]
        .map(|file| Path::new(file).to_owned());
    for file in docs.chain(files) {
        if file.extension().is_none_or(|extension| extension != "md") {
            continue;
        }
        let text = std::fs::read_to_string(path("").join(&file)).unwrap();
        for link in links(&text) {
            count += 1;
            let link = link.split_once('#').map_or(link, |(file, _)| file);
            let mut target = file.parent().unwrap().to_owned();
            for part in link.trim_end_matches('/').split('/') {
                match part {
                    ".." => drop(target.pop()),
                    part => target.push(part),
                }
            }
            if !is_packaged(&target) {
                dead.push(format!("{}: {link}", file.display()));
            }
        }
    }
    assert!(dead.is_empty(), "not in the package:\n{}", dead.join("\n"));
    assert!(count > 20, "only {count} links found");
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
