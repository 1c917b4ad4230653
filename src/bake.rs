//! A loaded scene as Rust source, for a `static` in flash.

use core::fmt;

use crate::accel::{BvhNode, Candidates, NodeContent, ObjectSet, PlaneGrid, Slab};
use crate::color::Color;
use crate::light::Light;
use crate::material::Material;
use crate::scalar::Scalar;
use crate::scene::Scene;
use crate::shape::{ListedShape, ObjectInfo, Part, StoredEntry};
use crate::vec3::Vec3;

/// A scene as the source of a constant expression of type `Scene<'static, T>`.
///
/// Every number is written so that the compiler reads back the same bits, and everything that loading
/// derives (normals, bounds, offsets, shared materials, who can hit whom) is written with it: the
/// device computes nothing and spends no RAM. A build script writes it to a file for `include!`:
///
/// ```
/// let mut pools: scanray::ScenePools = scanray::ScenePools::new();
/// # #[cfg(feature = "parser")]
/// pools.parse(include_bytes!("../scenes/default.txt"))?;
/// let source = scanray::bake(&pools.as_scene()).to_string();
/// // In build.rs: std::fs::write(out_dir.join("default.rs"), source)
/// // In the firmware: static SCENE: Scene = include!(concat!(env!("OUT_DIR"), "/default.rs"));
/// # assert!(source.starts_with("::scanray::Scene::EMPTY"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn bake<'s, T: Scalar>(scene: &'s Scene<'_, T>) -> impl fmt::Display + 's {
    Baked(scene)
}

/// Something that is written as Rust source.
struct Baked<'s, S>(&'s S);

/// A list of things, each on a line of its own, between what comes before and behind it.
fn list<'s, S>(
    f: &mut fmt::Formatter<'_>,
    before: &str,
    items: &'s [S],
    behind: &str,
) -> fmt::Result
where
    Baked<'s, S>: fmt::Display,
{
    writeln!(f, "    {before}&[")?;
    for item in items {
        writeln!(f, "        {},", Baked(item))?;
    }
    writeln!(f, "    ]{behind}")
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
        writeln!(f, "::scanray::Scene::EMPTY")?;
        writeln!(
            f,
            "    .with_camera(::scanray::Camera {{ position: {} }})",
            Baked(&scene.camera.position)
        )?;
        writeln!(
            f,
            "    .with_resolution(::scanray::Resolution {{ width: {}, height: {} }})",
            scene.resolution.width, scene.resolution.height
        )?;
        writeln!(f, "    .with_ambient({})", Number(scene.ambient))?;
        writeln!(
            f,
            "    .with_background(::scanray::Background {{ color: {}, sky: {} }})",
            Baked(&scene.background.color),
            scene.background.sky
        )?;
        let geometry = &scene.geometry;
        list(f, ".with_lights(", scene.lights, ")")?;
        shapes(f, "spheres", geometry.spheres)?;
        shapes(f, "planes", geometry.planes)?;
        shapes(f, "triangles", geometry.triangles)?;
        if !geometry.stored.entries.is_empty() {
            writeln!(f, "    .with_stored(::scanray::shape::Stored::from_parts(")?;
            list(f, "", geometry.stored.entries, ",")?;
            writeln!(f, "    &[")?;
            for number in geometry.stored.numbers {
                writeln!(f, "        {},", Number(*number))?;
            }
            writeln!(f, "    ]))")?;
        }
        list(f, ".with_materials(", scene.materials, ")")?;
        let accel = &scene.accel;
        writeln!(f, "    .with_accel(::scanray::accel::Accel::from_parts(")?;
        list(f, "", accel.sides, ",")?;
        list(f, "", accel.grids, ",")?;
        list(f, "", accel.bvh.nodes, ",")?;
        list(f, "", accel.bvh.entries, ",")?;
        write!(f, "    {}))", accel.lights_are_clear)
    }
}

/// The objects of one shape, if there are any.
fn shapes<T: Scalar, P: ListedShape<T>>(
    f: &mut fmt::Formatter<'_>,
    name: &str,
    objects: &[P],
) -> fmt::Result {
    if objects.is_empty() {
        return Ok(());
    }
    writeln!(f, "    .with_{name}(&[")?;
    for object in objects {
        let (name, parts) = object.parts();
        write!(f, "        ::scanray::shape::{name}::from_parts(")?;
        for part in parts.into_iter().flatten() {
            match part {
                Part::Number(number) => write!(f, "{}, ", Number(number))?,
                Part::Vector(vector) => write!(f, "{}, ", Baked(&vector))?,
                Part::Vectors([a, b, c]) => {
                    write!(f, "[{}, {}, {}], ", Baked(&a), Baked(&b), Baked(&c))?;
                }
            }
        }
        writeln!(f, "{}),", Baked(&object.info()))?;
    }
    writeln!(f, "    ])")
}

impl<T: Scalar> fmt::Display for Baked<'_, Light<T>> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let light = self.0;
        write!(
            f,
            "::scanray::Light {{ position: {}, specular: {}, diffuse: {} }}",
            Baked(&light.position),
            Baked(&light.specular),
            Baked(&light.diffuse)
        )
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

impl fmt::Display for Baked<'_, StoredEntry> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let StoredEntry { kind, first, info } = self.0;
        write!(
            f,
            "::scanray::shape::StoredEntry::from_parts(::scanray::shape::Kind::{kind:?}, {first}, {})",
            Baked(info)
        )
    }
}

impl fmt::Display for Baked<'_, ObjectInfo> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ObjectInfo { material, number } = self.0;
        write!(
            f,
            "::scanray::shape::ObjectInfo {{ material: {material}, number: {number} }}"
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

impl<T: Scalar> fmt::Display for Baked<'_, PlaneGrid<T>> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let PlaneGrid {
            normal_axis,
            low,
            density,
            slabs,
        } = self.0;
        let [[low_u, low_v], [density_u, density_v]] = [low, density].map(|pair| pair.map(Number));
        writeln!(
            f,
            "::scanray::accel::PlaneGrid {{ normal_axis: {normal_axis}, low: [{low_u}, {low_v}], \
             density: [{density_u}, {density_v}], slabs: ["
        )?;
        for axis in slabs {
            writeln!(f, "            [")?;
            for slab in axis {
                writeln!(f, "                {},", Baked(slab))?;
            }
            writeln!(f, "            ],")?;
        }
        write!(f, "        ] }}")
    }
}

impl fmt::Display for Baked<'_, Slab> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Slab {
            ahead: [up, down],
            occluders,
        } = self.0;
        write!(
            f,
            "::scanray::accel::Slab {{ ahead: [{}, {}], occluders: {} }}",
            Baked(up),
            Baked(down),
            Baked(occluders)
        )
    }
}

impl fmt::Display for Baked<'_, Candidates> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Candidates {
            near,
            occluders,
            shadowed,
        } = self.0;
        write!(f, "::scanray::accel::Candidates {{ near: [")?;
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

impl<T: Scalar> fmt::Display for Baked<'_, BvhNode<T>> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let node = self.0;
        write!(
            f,
            "::scanray::accel::BvhNode::new({}, {}, ::scanray::accel::NodeContent::",
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

impl fmt::Display for Baked<'_, u32> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl fmt::Display for Baked<'_, ObjectSet> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "::scanray::accel::ObjectSet::from_bits({:#x})",
            self.0.bits()
        )
    }
}
