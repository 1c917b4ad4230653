//! Which files the pictures of each scene become.

use std::collections::HashMap;
use std::ffi::OsString;
use std::io::{self, IsTerminal};
use std::ops::Range;
use std::path::{Path, PathBuf};

use crate::console::shown;
use crate::failure::Failure;
use crate::image::ImageFormat;
use crate::output_files::Place;
use crate::scene_file::SceneSource;

/// A file to be written.
#[derive(Clone, Debug)]
pub(crate) struct PictureFile {
    pub(crate) place: Place,
    pub(crate) format: ImageFormat,
    /// Which pictures of a turntable it holds; 0 alone if there is no turntable.
    pub(crate) steps: Range<u16>,
}

/// Which pictures of a turntable are drawn.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Steps {
    pub(crate) range: Range<u16>,
    /// How many the turntable has.
    pub(crate) of: u16,
}

/// Where the pictures of each scene go, and in which format. `output` is what `-o` names. The pictures of
/// a turntable become one GIF file or numbered files of another format.
///
/// # Errors
///
/// [`Failure::Usage`], also for a file that is one of the scenes, and [`Failure::Files`] for one that cannot be written.
pub(crate) fn places(
    scenes: &[SceneSource],
    output: Option<&Path>,
    turntable: Option<&Steps>,
) -> Result<Vec<Vec<PictureFile>>, Failure> {
    let default_extension = if turntable.is_some() { "gif" } else { "ppm" };
    let by_path = |path: &Path| -> Result<Vec<PictureFile>, Failure> {
        single_place(path, ImageFormat::ALL).and_then(|place| files(path, place, turntable))
    };
    let by_name = |folder: &Path| -> Result<Vec<Vec<PictureFile>>, Failure> {
        let paths: Vec<_> = scenes
            .iter()
            .map(|scene| {
                let mut name = scene.stem().into_os_string();
                name.push(".");
                name.push(default_extension);
                folder.join(name)
            })
            .collect();
        refuse_doubles(scenes, &paths)?;
        paths.iter().map(|path| by_path(path)).collect()
    };
    let places = match (output, scenes) {
        (None, [_]) => {
            let path = Path::new("output").with_extension(default_extension);
            by_path(&path).map(|files| vec![files])
        }
        (None, _) => by_name(Path::new("")),
        (Some(folder), _) if folder.is_dir() => by_name(folder),
        (Some(output), [_]) => by_path(output).map(|files| vec![files]),
        (Some(output), _) => Err(Failure::Usage(format!(
            "-o {} cannot take the pictures of {} scenes: name an existing folder, or leave -o out to \
             get NAME.{default_extension} for each in this one",
            shown(output),
            scenes.len()
        ))),
    }?;
    for file in places.iter().flatten() {
        if let Place::File { name, .. } = &file.place {
            refuse_input_as_output(name, scenes.iter().filter_map(SceneSource::file))?;
        }
    }
    Ok(places)
}

/// The place that `-o` names for one picture in one of these formats.
///
/// # Errors
///
/// [`Failure::Usage`], and [`Failure::Files`] for a file that cannot be written.
pub(crate) fn single_place(
    output: &Path,
    formats: &[ImageFormat],
) -> Result<(Place, ImageFormat), Failure> {
    if output.as_os_str() == "-" {
        if io::stdout().is_terminal() {
            return Err(Failure::Usage(
                "-o - would write a picture on the terminal: add `> FILE` or `| COMMAND`"
                    .to_owned(),
            ));
        }
        return Ok((Place::Stdout, ImageFormat::Ppm));
    }
    let name = shown(output);
    if output.to_string_lossy().ends_with(std::path::is_separator) {
        return Err(Failure::Usage(format!(
            "-o {name}: there is no such folder"
        )));
    }
    let format = ImageFormat::of(output).filter(|format| formats.contains(format));
    // A device or pipe has no extension.
    if format.is_none() && !output.metadata().is_ok_and(|there| !there.is_file()) {
        let extensions: Vec<String> = formats
            .iter()
            .map(|format| format!(".{}", format.extension()))
            .collect();
        let (last, others) = extensions
            .split_last()
            .map_or(("", String::new()), |(last, others)| {
                (last, others.join(", "))
            });
        return Err(Failure::Usage(format!(
            "-o {name}: the name must end in {others} or {last}"
        )));
    }
    Ok((Place::file(output)?, format.unwrap_or(ImageFormat::Ppm)))
}

/// Refuses an output that is also an input: what the input held would be lost.
///
/// # Errors
///
/// [`Failure::Usage`].
pub(crate) fn refuse_input_as_output<'a>(
    output: &Path,
    inputs: impl IntoIterator<Item = &'a PathBuf>,
) -> Result<(), Failure> {
    let Ok(there) = output.canonicalize() else {
        return Ok(());
    };
    let is_there = |input: &PathBuf| input.canonicalize().is_ok_and(|input| input == there);
    if there.is_file() && inputs.into_iter().any(is_there) {
        return Err(Failure::Usage(format!(
            "cannot write {}: it would overwrite what is read; name another file",
            shown(output)
        )));
    }
    Ok(())
}

/// The files of one scene, where `path` is that of its only picture.
///
/// # Errors
///
/// [`Failure::Files`] for a file that cannot be written.
pub(crate) fn files(
    path: &Path,
    (place, format): (Place, ImageFormat),
    turntable: Option<&Steps>,
) -> Result<Vec<PictureFile>, Failure> {
    let file = |place, steps| PictureFile {
        place,
        format,
        steps,
    };
    match (turntable, &place) {
        (None, _) => Ok(vec![file(place, 0..1)]),
        (Some(steps), _) if format == ImageFormat::Gif => {
            Ok(vec![file(place, steps.range.clone())])
        }
        (Some(steps), Place::File { .. }) => {
            let numbered = |step| {
                let place = Place::file(&numbered(path, step, steps.of))?;
                Ok(file(place, step..step + 1))
            };
            steps.range.clone().map(numbered).collect()
        }
        // One picture after the other.
        (Some(steps), Place::Stdout | Place::Device(_)) => {
            let same = |step| file(place.clone(), step..step + 1);
            Ok(steps.range.clone().map(same).collect())
        }
    }
}

/// `NAME-007.png` for `NAME.png`.
fn numbered(path: &Path, step: u16, of: u16) -> PathBuf {
    let digits = (of - 1).to_string().len().max(3);
    let mut name = OsString::from(path.file_stem().unwrap_or_default());
    name.push(format!("-{step:0digits$}."));
    name.push(path.extension().unwrap_or_default());
    path.with_file_name(name)
}

/// Two scenes must not become one file.
fn refuse_doubles(scenes: &[SceneSource], paths: &[PathBuf]) -> Result<(), Failure> {
    let mut first_with = HashMap::new();
    for (scene, path) in scenes.iter().zip(paths) {
        if let Some(first) = first_with.insert(path, scene) {
            return Err(Failure::Usage(format!(
                "{} and {} would both become {}: draw them one by one with -o",
                first.name(),
                scene.name(),
                shown(path)
            )));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits_or_as_many_as_are_needed() {
        let name = |path: &str, step, of| numbered(Path::new(path), step, of);
        assert_eq!(name("turn.png", 7, 36), Path::new("turn-007.png"));
        assert_eq!(name("a.b/c.d.PPM", 0, 1), Path::new("a.b/c.d-000.PPM"));
        assert_eq!(name("t.png", 999, 1000), Path::new("t-999.png"));
        assert_eq!(name("t.png", 999, 1001), Path::new("t-0999.png"));
    }
}
