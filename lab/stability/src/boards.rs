//! What firmware/ has of the scenes that boards draw. Not in tests/common: the package of the core holds that folder, not
//! firmware/.

use crate::scenes::SCENES;

/// The scenes that boards draw besides those of scenes/: the stages of the renderer.
const STAGES: &[(&str, &[u8])] = &[
    (
        "stage-1-diffuse-spheres",
        include_bytes!("../../../firmware/scenes/stage-1-diffuse-spheres.txt"),
    ),
    (
        "stage-2-plane-and-shadows",
        include_bytes!("../../../firmware/scenes/stage-2-plane-and-shadows.txt"),
    ),
    (
        "stage-3-mirrors",
        include_bytes!("../../../firmware/scenes/stage-3-mirrors.txt"),
    ),
];

/// The hashes of the pictures that the boards drew when firmware/test.sh ran last: a line for each scene.
pub(crate) const HASHES: &str = include_str!("../../../firmware/tables/pictures.txt");

/// The text of a scene that boards draw.
pub(crate) fn text(name: &str) -> Option<&'static [u8]> {
    let scene = SCENES
        .iter()
        .chain(STAGES)
        .find(|(known, _)| *known == name);
    scene.map(|(_, text)| *text)
}
