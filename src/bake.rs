//! A loaded scene as Rust source, for a `static` in flash.

use core::fmt;

use crate::color::Color;
use crate::material::Material;
use crate::scalar::Scalar;
use crate::scene::{NodeContent, ObjectSet, Reach, Scene, Strip, TreeEntry, TreeNode, Zones};
use crate::shape::{Plane, Sphere, Surface, Triangle};
use crate::vec3::Vec3;

/// A scene as the source of a constant expression of type `Scene<'static, T>`.
///
/// Every number is written so that the compiler reads back the same bits, and everything that loading
/// derives (normals, bounds, offsets, shared materials, who can meet whom) is written with it: the
/// device computes nothing and spends no RAM. A build script writes it to a file for `include!`:
///
/// ```
/// let mut pools: scanray::ScenePools = scanray::ScenePools::new();
/// # #[cfg(feature = "parser")]
/// pools.parse(include_bytes!("../scenes/default.txt"))?;
/// let source = scanray::bake(&pools.as_scene()).to_string();
/// // In build.rs: std::fs::write(out_dir.join("default.rs"), source)
/// // In the firmware: static SCENE: Scene = include!(concat!(env!("OUT_DIR"), "/default.rs"));
/// # assert!(source.starts_with("::scanray::Scene {"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn bake<'s, T: Scalar>(scene: &'s Scene<'_, T>) -> impl fmt::Display + 's {
    Baked(scene)
}

/// Something that is written as Rust source.
struct Baked<'s, S>(&'s S);

/// A list of things, each on a line of its own.
fn list<'s, S>(f: &mut fmt::Formatter<'_>, name: &str, items: &'s [S]) -> fmt::Result
where
    Baked<'s, S>: fmt::Display,
{
    writeln!(f, "    {name}: &[")?;
    for item in items {
        writeln!(f, "        {},", Baked(item))?;
    }
    writeln!(f, "    ],")
}

/// A number with its type, or the name of one that has no literal.
struct Number<T>(T);

impl<T: Scalar> fmt::Display for Number<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.is_finite() {
            // `Debug` writes the shortest digits that read back to the same bits.
            write!(f, "{:?}_{}", self.0, T::NAME)
        } else {
            let name = if self.0 > T::ZERO {
                "INFINITY"
            } else if self.0 < T::ZERO {
                "NEG_INFINITY"
            } else {
                "NAN"
            };
            write!(f, "{}::{name}", T::NAME)
        }
    }
}

impl<T: Scalar> fmt::Display for Baked<'_, Scene<'_, T>> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let scene = self.0;
        writeln!(f, "::scanray::Scene {{")?;
        writeln!(
            f,
            "    camera: ::scanray::Camera {{ position: {} }},",
            Baked(&scene.camera.position)
        )?;
        writeln!(
            f,
            "    resolution: ::scanray::Resolution {{ width: {}, height: {} }},",
            scene.resolution.width, scene.resolution.height
        )?;
        writeln!(f, "    ambient: {},", Number(scene.ambient))?;
        writeln!(
            f,
            "    background: ::scanray::Background {{ color: {}, sky: {} }},",
            Baked(&scene.background.color),
            scene.background.sky
        )?;
        writeln!(f, "    lights: &[")?;
        for light in scene.lights {
            writeln!(
                f,
                "        ::scanray::Light {{ position: {}, specular: {}, diffuse: {} }},",
                Baked(&light.position),
                Baked(&light.specular),
                Baked(&light.diffuse)
            )?;
        }
        writeln!(f, "    ],")?;
        list(f, "spheres", scene.spheres)?;
        list(f, "planes", scene.planes)?;
        list(f, "triangles", scene.triangles)?;
        list(f, "materials", scene.materials)?;
        list(f, "sides", scene.sides)?;
        list(f, "zones", scene.zones)?;
        writeln!(f, "    tree: ::scanray::Tree {{")?;
        list(f, "nodes", scene.tree.nodes)?;
        list(f, "entries", scene.tree.entries)?;
        writeln!(f, "    }},")?;
        write!(f, "}}")
    }
}

impl<T: Scalar> fmt::Display for Baked<'_, Vec3<T>> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Vec3 { x, y, z } = *self.0;
        write!(
            f,
            "::scanray::Vec3::new({}, {}, {})",
            Number(x),
            Number(y),
            Number(z)
        )
    }
}

impl<T: Scalar> fmt::Display for Baked<'_, Color<T>> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Color { r, g, b } = *self.0;
        write!(
            f,
            "::scanray::Color::new({}, {}, {})",
            Number(r),
            Number(g),
            Number(b)
        )
    }
}

impl fmt::Display for Baked<'_, Surface> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Surface { material, number } = self.0;
        write!(
            f,
            "::scanray::shape::Surface {{ material: {material}, number: {number} }}"
        )
    }
}

impl<T: Scalar> fmt::Display for Baked<'_, Sphere<T>> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sphere = self.0;
        write!(
            f,
            "::scanray::shape::Sphere::from_parts({}, {}, {}, {}, {})",
            Baked(&sphere.center()),
            Number(sphere.radius_squared()),
            Number(sphere.radius()),
            Number(sphere.offset()),
            Baked(&sphere.surface())
        )
    }
}

impl<T: Scalar> fmt::Display for Baked<'_, Plane<T>> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let plane = self.0;
        write!(
            f,
            "::scanray::shape::Plane::from_parts({}, {}, {})",
            Baked(&plane.normal()),
            Number(plane.height()),
            Baked(&plane.surface())
        )
    }
}

impl<T: Scalar> fmt::Display for Baked<'_, Triangle<T>> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let triangle = self.0;
        let [v1, v2, v3] = triangle.vertices();
        write!(
            f,
            "::scanray::shape::Triangle::from_parts([{}, {}, {}], {}, {}, {}, {}, {})",
            Baked(&v1),
            Baked(&v2),
            Baked(&v3),
            Baked(&triangle.normal()),
            Baked(&triangle.ball_center()),
            Number(triangle.ball_radius_squared()),
            Number(triangle.offset()),
            Baked(&triangle.surface())
        )
    }
}

impl<T: Scalar> fmt::Display for Baked<'_, Material<T>> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let material = self.0;
        let d = material.description();
        write!(
            f,
            "::scanray::Material::from_parts(::scanray::MaterialDescription {{ \
             diffuse: {}, specular: {}, ambient: {}, reflection: {}, shininess: {}, \
             refraction: {}, index_of_refraction: {} }}, {}, {}, {}, {})",
            Baked(&d.diffuse),
            Baked(&d.specular),
            Baked(&d.ambient),
            Number(d.reflection),
            Number(d.shininess),
            Number(d.refraction),
            Number(d.index_of_refraction),
            Number(material.inverse_index()),
            Number(material.bend()),
            material.whole_shininess(),
            material.faint_alignment()
        )
    }
}

impl<T: Scalar> fmt::Display for Baked<'_, Zones<T>> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Zones {
            normal_axis,
            low,
            density,
            strips,
        } = self.0;
        let [[low_u, low_v], [density_u, density_v]] = [low, density].map(|pair| pair.map(Number));
        writeln!(
            f,
            "::scanray::Zones {{ normal_axis: {normal_axis}, low: [{low_u}, {low_v}], \
             density: [{density_u}, {density_v}], strips: ["
        )?;
        for axis in strips {
            writeln!(f, "            [")?;
            for strip in axis {
                writeln!(f, "                {},", Baked(strip))?;
            }
            writeln!(f, "            ],")?;
        }
        write!(f, "        ] }}")
    }
}

impl fmt::Display for Baked<'_, Strip> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Strip {
            ahead: [up, down],
            occluders,
        } = self.0;
        write!(
            f,
            "::scanray::Strip {{ ahead: [{}, {}], occluders: {} }}",
            Baked(up),
            Baked(down),
            Baked(occluders)
        )
    }
}

impl fmt::Display for Baked<'_, Reach> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Reach {
            near,
            occluders,
            shadowed,
        } = self.0;
        write!(f, "::scanray::Reach {{ near: [")?;
        for set in near {
            write!(f, "{}, ", Baked(set))?;
        }
        write!(
            f,
            "], occluders: {}, shadowed: {shadowed} }}",
            Baked(occluders)
        )
    }
}

impl<T: Scalar> fmt::Display for Baked<'_, TreeNode<T>> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let node = self.0;
        write!(
            f,
            "::scanray::TreeNode::new({}, {}, ::scanray::NodeContent::",
            Baked(&node.low()),
            Baked(&node.high())
        )?;
        match node.content() {
            NodeContent::Leaf { first, count } => {
                write!(f, "Leaf {{ first: {first}, count: {count} }})")
            }
            NodeContent::Inner { first, axis } => {
                write!(f, "Inner {{ first: {first}, axis: {axis} }})")
            }
        }
    }
}

impl fmt::Display for Baked<'_, TreeEntry> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let shape = if self.0.is_triangle() {
            "triangle"
        } else {
            "sphere"
        };
        write!(f, "::scanray::TreeEntry::{shape}({})", self.0.index())
    }
}

impl fmt::Display for Baked<'_, ObjectSet> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "::scanray::ObjectSet::from_bits({:#x})", self.0.bits())
    }
}
