//! R3: scenes whose pictures can be computed by hand, which R1 and R2 are checked with.

#[cfg(test)]
mod tests;

use scanray::Resolution;

use super::errors::Error;
use super::linear::Linear;
use super::references::{DEPTH, References, SAMPLES_A_SIDE};
use super::scenes::BothScalars;
use super::settings::{Sampling, Settings};
use scanray_host::failure::Failure;
use scanray_host::knobs::Detail;
use scanray_host::parallel_drawing::Workers;
use scanray_host::scene_file::SceneSource;

const SIZE: Resolution = Resolution {
    width: 32,
    height: 24,
};

/// A scene of greys, and the grey at a place on the image plane at z = 1.
struct ClosedForm {
    name: &'static str,
    scene: String,
    grey: fn(f64, f64) -> f64,
}

/// How far R1 and R2 are from a closed form: the largest difference of a pixel, in levels of 255.
#[derive(Clone, Debug, serde::Serialize)]
pub(crate) struct Distance {
    pub(crate) name: &'static str,
    pub(crate) r1: f64,
    pub(crate) r2: f64,
}

/// Radius of the silhouette of a sphere of radius 2.1 around the point (0, 0, 5).
fn silhouette() -> f64 {
    2.1 / (25.0_f64 - 2.1 * 2.1).sqrt()
}

/// Ambient light and reflection of facing mirrors.
const MIRRORS: (f64, f64) = (0.2, 0.6);

/// What is seen in facing mirrors after as many reflections.
fn series(depth: usize) -> f64 {
    let (ambient, share) = MIRRORS;
    (0..=depth)
        .map(|k| ambient * f64::powi(share, k as i32))
        .sum()
}

fn closed_forms() -> [ClosedForm; 3] {
    let (ambient, share) = MIRRORS;
    let mirror = format!("0 0 0 0 0 0 {ambient} {ambient} {ambient} {share} 1 0 0\n");
    [
        ClosedForm {
            name: "a sphere's silhouette",
            // A disc of 0.7 on 0.2: the silhouette of a sphere on the axis is a circle.
            scene: head(1, "0 0 -9 0 0 0 0 0 0", "0.2 0.2 0.2")
                + "0 0 0 5 2.1 0 0 0 0 0 0 0.7 0.7 0.7 0 1 0 0\n",
            grey: |x, y| {
                let is_inside = x * x + y * y <= silhouette() * silhouette();
                if is_inside { 0.7 } else { 0.2 }
            },
        },
        ClosedForm {
            name: "a lit floor",
            // At y = −1, below a grey background.
            scene: head(1, "1 3 4 0 0 0 1 1 1", "0.5 0.5 0.5")
                + "1 0 1 0 1 0.8 0.8 0.8 0 0 0 0.1 0.1 0.1 0 1 0 0\n",
            grey: |x, y| {
                if y >= 0.0 {
                    return 0.5;
                }
                let point = [x / -y, -1.0, 1.0 / -y];
                let to_light = [1.0 - point[0], 4.0, 4.0 - point[2]];
                let distance = to_light.iter().map(|c| c * c).sum::<f64>().sqrt();
                0.1 + 0.8 * 4.0 / distance
            },
        },
        ClosedForm {
            name: "facing mirrors",
            scene: head(2, "0 9 0 0 0 0 0 0 0", "0 0 0")
                + &format!("1 0 0 1 1 {mirror}1 0 0 -1 1 {mirror}"),
            grey: |_, _| series(DEPTH),
        },
    ]
}

/// The head of a scene without sky: camera at the origin, light as given, ambient intensity 1, background.
fn head(objects: usize, light: &str, background: &str) -> String {
    format!("{objects}\n0 0 0\n32 24\n{light}\n1\n0\n{background}\n")
}

/// Where the centre of a part of a pixel lies on the image plane at z = 1.
fn place(x: u16, y: u16, part: (u16, u16), parts: u16) -> (f64, f64) {
    let at = |pixel: u16, part: u16| f64::from(pixel) + (f64::from(part) + 0.5) / f64::from(parts);
    let (width, height) = (f64::from(SIZE.width), f64::from(SIZE.height));
    let (x, y) = (at(x, part.0), at(y, part.1));
    ((2.0 * x - width) / height, (height - 2.0 * y) / height)
}

fn pixels() -> impl Iterator<Item = (u16, u16)> {
    (0..SIZE.height).flat_map(|y| (0..SIZE.width).map(move |x| (x, y)))
}

impl ClosedForm {
    /// The mean grey of the parts of a pixel along each side.
    fn mean(&self, x: u16, y: u16, parts: u16) -> f64 {
        let all = (0..parts).flat_map(|b| (0..parts).map(move |a| (a, b)));
        let sum: f64 = all
            .map(|part| {
                let (x, y) = place(x, y, part, parts);
                (self.grey)(x, y)
            })
            .sum();
        sum / f64::from(parts * parts)
    }

    fn picture(&self, parts: u16) -> Linear {
        let pixel = |(x, y)| [self.mean(x, y, parts); 3];
        Linear {
            resolution: SIZE,
            pixels: pixels().map(pixel).collect(),
        }
    }

    /// The scene, loaded. No other may be loaded meanwhile: the host has its pools once.
    fn load(&self) -> Result<BothScalars, Failure> {
        BothScalars::load_text(&SceneSource::Default, self.scene.as_bytes())
    }
}

/// How far R1 and R2 are from all closed forms. No scene may be loaded meanwhile.
///
/// # Errors
///
/// [`Failure`].
pub(crate) fn distances(workers: &Workers) -> Result<Vec<Distance>, Failure> {
    let distance = |form: &ClosedForm| {
        let scene = form.load()?;
        let references = References::draw(scene.double(Settings::DEFAULT.power), SIZE, workers)?;
        let r1 = references.r1(Sampling::Fixed(1), Detail::Full, workers);
        Ok(Distance {
            name: form.name,
            r1: Error::between(&r1, &form.picture(1)).max,
            r2: Error::between(&references.r2, &form.picture(SAMPLES_A_SIDE)).max,
        })
    };
    closed_forms().iter().map(distance).collect()
}
