//! Other ray tracers that draw the same scenes: Tachyon and POV-Ray.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

use scanray::{Scene, Vec3, shape::Object};

use crate::run::{is_installed, temporary};

/// Pixels of the picture, and of the one that shows what reading and preparing takes.
const SIZES: [[usize; 2]; 2] = [[800, 600], [8, 6]];

/// Another ray tracer.
#[derive(Clone, Copy)]
pub(crate) enum Peer {
    Tachyon,
    PovRay,
}

impl Peer {
    pub(crate) const ALL: [Self; 2] = [Self::Tachyon, Self::PovRay];

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Tachyon => "Tachyon",
            Self::PovRay => "POV-Ray",
        }
    }

    pub(crate) fn is_installed(self) -> bool {
        is_installed(self.program())
    }

    const fn program(self) -> &'static str {
        match self {
            Self::Tachyon => "tachyon",
            Self::PovRay => "povray",
        }
    }

    /// Writes a scene for it.
    pub(crate) fn export(self, file: &Path, scene: &Scene<'_>) -> PathBuf {
        match self {
            Self::Tachyon => {
                let exported = temporary("peer.dat");
                std::fs::write(&exported, tachyon_scene(scene)).expect("the scene is written");
                exported
            }
            Self::PovRay => {
                let exported = temporary("peer.pov");
                let status = Command::new(crate::run::program())
                    .arg("export")
                    .arg(file)
                    .arg("-o")
                    .arg(&exported)
                    .stderr(std::process::Stdio::null())
                    .status()
                    .expect("scanray runs");
                assert!(status.success(), "scanray export: {status}");
                exported
            }
        }
    }

    /// CPU nanoseconds a pixel on one thread, without what a picture of hardly any pixels takes as well.
    #[cfg(unix)]
    pub(crate) fn time(self, scene: &Path) -> f64 {
        let [whole, start] =
            SIZES.map(|size| crate::run::cpu_seconds(&mut self.command(scene, size)));
        let [pixels, of_start] = SIZES.map(|[width, height]| (width * height) as f64);
        (whole - start) * 1e9 / (pixels - of_start)
    }

    #[cfg_attr(not(unix), expect(dead_code))]
    fn command(self, scene: &Path, size: [usize; 2]) -> Command {
        let mut command = Command::new(self.program());
        let [width, height] = size.map(|pixels| pixels.to_string());
        match self {
            Self::Tachyon => command
                .arg(scene)
                .args(["-res", &width, &height, "-numthreads", "1", "-fullshade"])
                .args(["-format", "PPM", "-o"])
                .arg(temporary("peer.ppm")),
            Self::PovRay => command
                .arg(format!("+I{}", scene.display()))
                .args([&format!("+W{width}"), &format!("+H{height}")])
                .args(["+WT1", "-A", "-D", "-F"]),
        };
        command
    }
}

/// A scene for Tachyon, whose lights, highlights and sky differ a little; rays, objects and the view are the same. It
/// bends no light.
fn tachyon_scene(scene: &Scene<'_>) -> String {
    let mut text = String::new();
    let vector = |v: Vec3| format!("{} {} {}", v.x, v.y, v.z);
    let mut write = |line: std::fmt::Arguments<'_>| {
        text.write_fmt(line).expect("a string takes any text");
        text.push('\n');
    };
    write(format_args!("BEGIN_SCENE\nRESOLUTION 800 600\nCAMERA"));
    // The height of the view at distance 1 is 2; the ray from the camera is a level too.
    write(format_args!(
        "ZOOM 0.5\nASPECTRATIO 1.0\nANTIALIASING 0\nRAYDEPTH 6\nCENTER {}\nVIEWDIR 0 0 1\nUPDIR 0 1 0\nEND_CAMERA",
        vector(scene.camera().position)
    ));
    for light in scene.lights() {
        write(format_args!(
            "LIGHT CENTER {} RAD 0.01 COLOR {} {} {}",
            vector(light.position),
            light.diffuse.r,
            light.diffuse.g,
            light.diffuse.b
        ));
    }
    write(format_args!("BACKGROUND 0.75 0.85 1.0"));
    for object in scene.objects() {
        match object {
            Object::Sphere(sphere) => write(format_args!(
                "SPHERE CENTER {} RAD {}",
                vector(sphere.center()),
                sphere.radius()
            )),
            Object::Plane(plane) => write(format_args!(
                "PLANE CENTER {} NORMAL {}",
                vector(plane.normal() * plane.height()),
                vector(plane.normal())
            )),
            Object::Triangle(triangle) => {
                let [a, b, c] = triangle.vertices().map(vector);
                write(format_args!("TRI V0 {a} V1 {b} V2 {c}"));
            }
            other => unreachable!("no scene of the bench has {other:?}"),
        }
        let material = scene
            .materials()
            .get(object.info().material as usize)
            .map(|material| *material.description())
            .unwrap_or_default();
        let color = material.diffuse;
        write(format_args!(
            "TEXTURE AMBIENT {} DIFFUSE 1.0 SPECULAR {} OPACITY 1.0 PHONG PLASTIC {} PHONG_SIZE {} COLOR {} {} {} \
             TEXFUNC 0",
            scene.ambient(),
            material.reflection,
            material.specular.r,
            material.shininess,
            color.r,
            color.g,
            color.b
        ));
    }
    write(format_args!("END_SCENE"));
    text
}
