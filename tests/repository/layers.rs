//! The layers of the core: a file may use the modules above it in src/lib.rs, never those below.

use std::path::{Path, PathBuf};

use crate::common::scenes;

/// The modules of src/lib.rs, in its order.
fn layers(lib: &str) -> Vec<String> {
    without_comments_and_tests(lib)
        .lines()
        .filter_map(|line| {
            let line = line.trim();
            let line = line.strip_prefix("pub ").unwrap_or(line);
            let name = line.strip_prefix("mod ")?.strip_suffix(';')?;
            Some(name.to_owned())
        })
        .collect()
}

/// Rust source without comments, text in quotes, and items under `#[cfg(test)]`.
fn without_comments_and_tests(source: &str) -> String {
    let mut code = String::new();
    for line in source.lines() {
        let end = line.find("//").unwrap_or(line.len());
        // Text in quotes has no paths, but may have braces.
        let parts = line[..end].split('"').step_by(2);
        code.extend(parts);
        code.push('\n');
    }
    while let Some(start) = code.find("#[cfg(test)]") {
        // The item ends with its block or, if that comes first, with a semicolon.
        let rest = &code[start..];
        let block = rest.find('{').unwrap_or(rest.len());
        let end = match rest.find(';') {
            Some(semicolon) if semicolon < block => semicolon + 1,
            _ => end_of_block(rest, block),
        };
        code.replace_range(start..start + end, "");
    }
    code
}

/// Behind the block that opens at `open`.
fn end_of_block(code: &str, open: usize) -> usize {
    let mut depth = 0;
    for (i, c) in code[open..].char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return open + i + 1;
        }
    }
    code.len()
}

/// The modules that code names by `crate::name` or in `crate::{name, …}`.
fn used_modules(code: &str) -> Vec<String> {
    let name_at = |text: &str| -> String {
        text.trim_start()
            .chars()
            .take_while(|c| c.is_alphanumeric() || *c == '_')
            .collect()
    };
    let mut used = Vec::new();
    for (start, path) in code.match_indices("crate::") {
        // `$crate::` in a macro is the user's way in.
        if code[..start].ends_with('$') {
            continue;
        }
        let rest = &code[start + path.len()..];
        if rest.starts_with('{') {
            let mut depth = 0;
            let mut begins_item = false;
            for (i, c) in rest[..end_of_block(rest, 0)].char_indices() {
                match c {
                    '{' => {
                        depth += 1;
                        begins_item = depth == 1;
                    }
                    '}' => depth -= 1,
                    ',' => begins_item = depth == 1,
                    c if begins_item && !c.is_whitespace() => {
                        used.push(name_at(&rest[i..]));
                        begins_item = false;
                    }
                    _ => {}
                }
            }
        } else {
            used.push(name_at(rest));
        }
    }
    used
}

/// The files of the core with the layer each belongs to.
fn files(layers: &[String]) -> Vec<(usize, PathBuf)> {
    fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                collect(&path, files);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                files.push(path);
            }
        }
    }
    let source = scenes::path("src");
    let mut all = Vec::new();
    collect(&source, &mut all);
    all.sort();
    all.retain(|file| *file != source.join("lib.rs"));
    all.into_iter()
        .map(|file| {
            let relative = file.strip_prefix(&source).unwrap().with_extension("");
            let first = relative.iter().next().unwrap().to_str().unwrap();
            let layer = layers.iter().position(|layer| layer == first);
            let layer =
                layer.unwrap_or_else(|| panic!("{} is in no module of src/lib.rs", file.display()));
            (layer, file)
        })
        .collect()
}

#[test]
fn no_file_uses_a_layer_below_its_own() {
    let lib = std::fs::read_to_string(scenes::path("src/lib.rs")).unwrap();
    let layers = layers(&lib);
    assert!(layers.len() >= 10, "{layers:?}");
    let mut violations = Vec::new();
    let mut uses = 0;
    for (own, file) in files(&layers) {
        let source = std::fs::read_to_string(&file).unwrap();
        let shown = file.strip_prefix(scenes::path("")).unwrap().display();
        for used in used_modules(&without_comments_and_tests(&source)) {
            uses += 1;
            match layers.iter().position(|layer| *layer == used) {
                Some(layer) if layer <= own => {}
                Some(_) => {
                    violations.push(format!("{shown} uses crate::{used}, which is below it"))
                }
                None => violations.push(format!(
                    "{shown} uses crate::{used}, which is no module: name the module it is in"
                )),
            }
        }
    }
    violations.dedup();
    assert!(
        violations.is_empty(),
        "the order of src/lib.rs is {layers:?}, but\n{}",
        violations.join("\n")
    );
    assert!(
        uses > 50,
        "only {uses} uses found: is this test still looking in the right place?"
    );
}

#[test]
fn the_reader_of_this_test_sees_what_it_should() {
    let source = "
        //! Uses crate::comment.
        use crate::scalar::Scalar; // and crate::remark
        use crate::{vec3::Vec3, shape::{Plane, Sphere}, ray};
        fn f() { crate::color::g(\"crate::text {\") }
        macro_rules! m { () => { $crate::outside } }
        #[cfg(test)]
        use crate::probe;
        #[cfg(test)]
        mod tests { use crate::tracer::Tracer; fn f() { {} } }
        fn g(s: &crate::scene::Scene) {}
    ";
    let code = without_comments_and_tests(source);
    assert_eq!(
        used_modules(&code),
        ["scalar", "vec3", "shape", "ray", "color", "scene"]
    );
    assert_eq!(
        layers("mod scalar;\n#[cfg(feature = \"x\")]\nmod parser;\npub mod shape;\n// mod no;\n"),
        ["scalar", "parser", "shape"]
    );
}
