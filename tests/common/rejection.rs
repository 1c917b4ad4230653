//! What every rejected scene text promises.

use scanray::{Background, ParseError, Resolution, Vec3, parser::Found};

use super::scenes;

/// Parses a text into pools that hold another scene; the error, after which the pools must be empty.
pub(crate) fn rejection(text: &[u8]) -> Result<ParseError, String> {
    let mut pools = scenes::load::<f32>("default");
    match pools.parse(text) {
        Ok(_) => Err(String::from("is accepted")),
        Err(error) => {
            let scene = pools.as_scene();
            let is_empty = scene.object_count() == 0
                && pools.usage().iter().all(|pool| pool.used == 0)
                && scene.objects().next().is_none()
                && scene.camera().position == Vec3::default()
                && (scene.resolution()
                    == Resolution {
                        width: 0,
                        height: 0,
                    })
                && scene.ambient() == 0.0
                && scene.background() == Background::default();
            if is_empty {
                Ok(error)
            } else {
                Err(format!("leaves something in the pools: {scene:?}"))
            }
        }
    }
}

/// Line and column of a byte, both from 1.
fn place(text: &[u8], offset: usize) -> (u32, u32) {
    let before = &text[..offset];
    let line = before.iter().filter(|&&byte| byte == b'\n').count() + 1;
    let column = before
        .iter()
        .rev()
        .take_while(|&&byte| byte != b'\n')
        .count()
        + 1;
    (line as u32, column as u32)
}

/// What every rejection promises, whatever is wrong.
pub(crate) fn check_place(text: &[u8], error: &ParseError) -> Result<(), String> {
    if error.offset > text.len() {
        return Err(format!("offset {} is beyond the text", error.offset));
    }
    let expected = place(text, error.offset);
    if (error.line, error.column) != expected {
        return Err(format!(
            "offset {} is at {expected:?}: {error}",
            error.offset
        ));
    }
    let is_number = |byte: u8| !byte.is_ascii_whitespace() && byte != b'#';
    let (before, after) = text.split_at(error.offset);
    // It is no part of the first word.
    let before = before.strip_prefix(b"\xef\xbb\xbf").unwrap_or(before);
    let starts_word = after.first().is_some_and(|&b| is_number(b))
        && !before.last().is_some_and(|&b| is_number(b));
    let follows_word = before.last().is_some_and(|&b| is_number(b));
    let nothing_before = before.is_empty();
    let is_right = match error.found {
        Found::EndOfLine | Found::EndOfText => follows_word || nothing_before,
        _ => starts_word,
    };
    if is_right {
        Ok(())
    } else {
        Err(format!("points into the middle of something: {error}"))
    }
}
