//! Which file the picture of each scene becomes.

use std::collections::HashMap;
use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};

use crate::failure::Failure;
use crate::image::ImageFormat;
use crate::output::Place;
use crate::scene_file::SceneSource;

/// Where the picture of each scene goes, and in which format. `output` is what `-o` names.
///
/// # Errors
///
/// [`Failure::Usage`], and [`Failure::Files`] for a file that cannot be written.
pub(crate) fn places(
    scenes: &[SceneSource],
    output: Option<&Path>,
) -> Result<Vec<(Place, ImageFormat)>, Failure> {
    let by_name = |folder: &Path| -> Result<Vec<(Place, ImageFormat)>, Failure> {
        let paths: Vec<_> = scenes
            .iter()
            .map(|scene| {
                let mut name = scene.stem().into_os_string();
                name.push(".ppm");
                folder.join(name)
            })
            .collect();
        refuse_doubles(scenes, &paths)?;
        paths
            .iter()
            .map(|path| Ok((Place::file(path)?, ImageFormat::Ppm)))
            .collect()
    };
    match (output, scenes) {
        (None, [_]) => Ok(vec![(
            Place::file(Path::new("output.ppm"))?,
            ImageFormat::Ppm,
        )]),
        (None, _) => by_name(Path::new("")),
        (Some(folder), _) if folder.is_dir() => by_name(folder),
        (Some(output), [_]) => single_place(output).map(|place| vec![place]),
        (Some(output), _) => Err(Failure::Usage(format!(
            "-o {} cannot take the pictures of {} scenes: name an existing folder, or leave -o out to \
             get NAME.ppm for each in this one",
            output.display(),
            scenes.len()
        ))),
    }
}

/// The place that `-o` names for one picture.
///
/// # Errors
///
/// [`Failure::Usage`], and [`Failure::Files`] for a file that cannot be written.
pub(crate) fn single_place(output: &Path) -> Result<(Place, ImageFormat), Failure> {
    if output.as_os_str() == "-" {
        if io::stdout().is_terminal() {
            return Err(Failure::Usage(
                "-o - would write a picture on the terminal: add `> FILE` or `| COMMAND`"
                    .to_owned(),
            ));
        }
        return Ok((Place::Stdout, ImageFormat::Ppm));
    }
    let name = output.display();
    if output.to_string_lossy().ends_with(std::path::is_separator) {
        return Err(Failure::Usage(format!(
            "-o {name}: there is no such folder"
        )));
    }
    let format = ImageFormat::of(output);
    // A device or pipe has no extension.
    if format.is_none() && !output.metadata().is_ok_and(|there| !there.is_file()) {
        return Err(Failure::Usage(format!(
            "-o {name}: the name must end in .ppm or .png"
        )));
    }
    Ok((Place::file(output)?, format.unwrap_or(ImageFormat::Ppm)))
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
                path.display()
            )));
        }
    }
    Ok(())
}
