//! Static pools that own a scene: no allocation, capacities fixed where they are declared.

use core::fmt;

use heapless::{Vec, VecView};

use super::{Needs, Object, ObjectSet, Reach, Scene, Tree, TreeEntry, TreeNode, Zones};
use crate::background::Background;
use crate::camera::{Camera, Resolution};
use crate::light::Light;
use crate::material::{Material, MaterialDescription};
use crate::scalar::Scalar;
use crate::shape::{Plane, ShapeError, Sphere, Surface, Triangle};
use crate::vec3::Vec3;

/// How many of the latest materials a new one is compared with: enough for files that repeat a
/// material along a mesh, and constant, so that loading stays linear in the text.
const MATERIAL_LOOK_BACK: usize = 16;

/// Pools for one scene, in RAM: a `static`, a local or a field.
///
/// A full pool is an error, never a silent loss; only two capacities are for speed alone
/// ([`ScenePools::prepare`]): `SIDES`, the number of objects whose mutual visibility is kept, and `TREE`, the
/// number of spheres and triangles that a [`Tree`] is built for, which takes 36 bytes each in `f32` (60 in `f64`) and
/// pays from some 50 objects on, with a tracer that uses it ([`Tracer::with_tree`](crate::Tracer::with_tree)). The default capacities hold every scene of the repository's `scenes/` folder,
/// without a tree.
#[derive(Clone, Debug)]
pub struct ScenePools<
    T = f32,
    const SPHERES: usize = 16,
    const PLANES: usize = 8,
    const TRIANGLES: usize = 24,
    const MATERIALS: usize = 16,
    const LIGHTS: usize = 1,
    const SIDES: usize = 48,
    const TREE: usize = 0,
> {
    settings: Settings<T>,
    spheres: Vec<Sphere<T>, SPHERES>,
    planes: Vec<Plane<T>, PLANES>,
    triangles: Vec<Triangle<T>, TRIANGLES>,
    materials: Vec<Material<T>, MATERIALS>,
    lights: Vec<Light<T>, LIGHTS>,
    sides: Vec<[Reach; 2], SIDES>,
    zones: Vec<Zones<T>, PLANES>,
    nodes: Vec<TreeNode<T>, TREE>,
    entries: Vec<TreeEntry, TREE>,
}

/// What a scene has one of.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Settings<T> {
    camera: Camera<T>,
    resolution: Resolution,
    ambient: T,
    background: Background<T>,
}

impl<T: Scalar> Settings<T> {
    // All bits zero, so that empty pools in a `static` take no flash.
    const EMPTY: Self = Self {
        camera: Camera {
            position: Vec3::new(T::ZERO, T::ZERO, T::ZERO),
        },
        resolution: Resolution {
            width: 0,
            height: 0,
        },
        ambient: T::ZERO,
        background: Background {
            color: crate::color::Color::BLACK,
            sky: false,
        },
    };
}

/// A kind of pool.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pool {
    /// Spheres.
    Spheres,
    /// Planes.
    Planes,
    /// Triangles.
    Triangles,
    /// Different materials.
    Materials,
    /// Lights.
    Lights,
}

impl Pool {
    /// All kinds, in the order of the parameters of [`ScenePools`].
    pub const ALL: [Self; 5] = [
        Self::Spheres,
        Self::Planes,
        Self::Triangles,
        Self::Materials,
        Self::Lights,
    ];

    /// Its name in messages, in the plural.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Spheres => "spheres",
            Self::Planes => "planes",
            Self::Triangles => "triangles",
            Self::Materials => "materials",
            Self::Lights => "lights",
        }
    }
}

/// How full a pool is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PoolUse {
    /// Which pool.
    pub pool: Pool,
    /// Entries in it.
    pub used: usize,
    /// Entries it has room for.
    pub capacity: usize,
    /// Bytes of all its entries, used or not.
    pub bytes: usize,
}

/// Why something could not be added to a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SceneError {
    /// The pool has no room left.
    PoolFull {
        /// Which pool.
        pool: Pool,
        /// What it holds at most.
        capacity: usize,
    },
    /// The numbers make no shape.
    Shape(ShapeError),
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::PoolFull { pool, capacity } => {
                write!(f, "the pool holds at most {capacity} {}", pool.name())
            }
            Self::Shape(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for SceneError {}

impl From<ShapeError> for SceneError {
    fn from(error: ShapeError) -> Self {
        Self::Shape(error)
    }
}

impl<
    T: Scalar,
    const SPHERES: usize,
    const PLANES: usize,
    const TRIANGLES: usize,
    const MATERIALS: usize,
    const LIGHTS: usize,
    const SIDES: usize,
    const TREE: usize,
> ScenePools<T, SPHERES, PLANES, TRIANGLES, MATERIALS, LIGHTS, SIDES, TREE>
{
    /// The stages that a scene in these pools can need, for [`tracer_for!`](crate::tracer_for): what there is no room for
    /// is left out: shapes and lights, loops where there can be one of them at most, and what only scenes of more than
    /// 31 objects need, or a tree.
    pub const NEEDS: Needs = {
        // Spheres, planes, triangles and lights, and what several of them need.
        let pools = [
            (SPHERES, Needs::SPHERES, Needs::SEVERAL_SPHERES),
            (PLANES, Needs::PLANES, Needs::SEVERAL_PLANES),
            (TRIANGLES, Needs::TRIANGLES, Needs::SEVERAL_TRIANGLES),
            (LIGHTS, Needs::LIGHT, Needs::SEVERAL_LIGHTS),
        ];
        let mut missing = Needs::NONE;
        let mut i = 0;
        while i < pools.len() {
            let (capacity, one, several) = pools[i];
            missing = match capacity {
                0 => missing.union(one).union(several),
                1 => missing.union(several),
                _ => missing,
            };
            i += 1;
        }
        if SPHERES + PLANES + TRIANGLES <= ObjectSet::TOLD_APART {
            missing = missing.union(Needs::MANY_OBJECTS);
        }
        let tree = if TREE == 0 { Needs::NONE } else { Needs::TREE };
        Needs::ALL.without(missing).union(tree)
    };

    /// Empty pools: a scene without objects and lights, of 0×0 pixels.
    pub const fn new() -> Self {
        Self {
            settings: Settings::EMPTY,
            spheres: Vec::new(),
            planes: Vec::new(),
            triangles: Vec::new(),
            materials: Vec::new(),
            lights: Vec::new(),
            sides: Vec::new(),
            zones: Vec::new(),
            nodes: Vec::new(),
            entries: Vec::new(),
        }
    }

    /// The scene in the pools.
    pub fn as_scene(&self) -> Scene<'_, T> {
        Scene {
            camera: self.settings.camera,
            resolution: self.settings.resolution,
            ambient: self.settings.ambient,
            background: self.settings.background,
            lights: &self.lights,
            spheres: &self.spheres,
            planes: &self.planes,
            triangles: &self.triangles,
            materials: &self.materials,
            sides: self.sides.as_flattened(),
            zones: &self.zones,
            tree: Tree {
                nodes: &self.nodes,
                entries: &self.entries,
            },
        }
    }

    /// The pools without their capacities in the type, to be filled.
    pub fn as_mut(&mut self) -> PoolsMut<'_, T> {
        PoolsMut {
            settings: &mut self.settings,
            spheres: &mut self.spheres,
            planes: &mut self.planes,
            triangles: &mut self.triangles,
            materials: &mut self.materials,
            lights: &mut self.lights,
            sides: &mut self.sides,
            zones: &mut self.zones,
            nodes: &mut self.nodes,
            entries: &mut self.entries,
        }
    }

    /// How full each pool is.
    pub fn usage(&self) -> [PoolUse; 5] {
        fn of<E>(pool: Pool, entries: &[E], capacity: usize) -> PoolUse {
            PoolUse {
                pool,
                used: entries.len(),
                capacity,
                bytes: capacity * size_of::<E>(),
            }
        }
        [
            of(Pool::Spheres, &self.spheres, SPHERES),
            of(Pool::Planes, &self.planes, PLANES),
            of(Pool::Triangles, &self.triangles, TRIANGLES),
            of(Pool::Materials, &self.materials, MATERIALS),
            of(Pool::Lights, &self.lights, LIGHTS),
        ]
    }
}

impl<
    T: Scalar,
    const SPHERES: usize,
    const PLANES: usize,
    const TRIANGLES: usize,
    const MATERIALS: usize,
    const LIGHTS: usize,
    const SIDES: usize,
    const TREE: usize,
> Default for ScenePools<T, SPHERES, PLANES, TRIANGLES, MATERIALS, LIGHTS, SIDES, TREE>
{
    fn default() -> Self {
        Self::new()
    }
}

/// Pools of any capacity, borrowed to be filled. Objects are numbered in the order in which they are
/// added, whatever their shape.
#[derive(Debug)]
pub struct PoolsMut<'p, T> {
    settings: &'p mut Settings<T>,
    spheres: &'p mut VecView<Sphere<T>>,
    planes: &'p mut VecView<Plane<T>>,
    triangles: &'p mut VecView<Triangle<T>>,
    materials: &'p mut VecView<Material<T>>,
    lights: &'p mut VecView<Light<T>>,
    sides: &'p mut VecView<[Reach; 2]>,
    zones: &'p mut VecView<Zones<T>>,
    nodes: &'p mut VecView<TreeNode<T>>,
    entries: &'p mut VecView<TreeEntry>,
}

impl<T: Scalar> PoolsMut<'_, T> {
    /// Removes everything.
    pub fn clear(&mut self) {
        *self.settings = Settings::EMPTY;
        self.spheres.clear();
        self.planes.clear();
        self.triangles.clear();
        self.materials.clear();
        self.lights.clear();
        self.forget_visibility();
    }

    /// Removes what is only true of the objects and lights so far.
    fn forget_visibility(&mut self) {
        self.sides.clear();
        self.zones.clear();
        self.nodes.clear();
        self.entries.clear();
    }

    /// Removes what is only true of the ambient light and the lights so far.
    fn forget_faint_highlights(&mut self) {
        for material in self.materials.iter_mut() {
            material.set_faint_alignment(T::ZERO);
        }
    }

    /// Sets where the scene is seen from.
    pub fn set_camera(&mut self, camera: Camera<T>) {
        self.settings.camera = camera;
    }

    /// Sets the size of the picture.
    pub fn set_resolution(&mut self, resolution: Resolution) {
        self.settings.resolution = resolution;
    }

    /// Sets the intensity of the ambient light.
    pub fn set_ambient(&mut self, ambient: T) {
        self.settings.ambient = ambient;
        self.forget_faint_highlights();
    }

    /// Sets what is behind everything.
    pub fn set_background(&mut self, background: Background<T>) {
        self.settings.background = background;
    }

    /// Whether a pool takes another entry.
    ///
    /// # Errors
    ///
    /// [`SceneError::PoolFull`].
    pub fn has_room(&self, pool: Pool) -> Result<(), SceneError> {
        let (used, capacity) = match pool {
            Pool::Spheres => (self.spheres.len(), self.spheres.capacity()),
            Pool::Planes => (self.planes.len(), self.planes.capacity()),
            Pool::Triangles => (self.triangles.len(), self.triangles.capacity()),
            Pool::Materials => (self.materials.len(), self.materials.capacity()),
            Pool::Lights => (self.lights.len(), self.lights.capacity()),
        };
        if used < capacity {
            Ok(())
        } else {
            Err(SceneError::PoolFull { pool, capacity })
        }
    }

    /// Adds a light.
    ///
    /// # Errors
    ///
    /// [`SceneError::PoolFull`].
    pub fn add_light(&mut self, light: Light<T>) -> Result<(), SceneError> {
        self.forget_visibility();
        self.forget_faint_highlights();
        push(self.lights, light, Pool::Lights)
    }

    /// Adds a sphere.
    ///
    /// # Errors
    ///
    /// [`SceneError::PoolFull`] and those of [`Sphere::new`]; the scene is then as it was.
    pub fn add_sphere(
        &mut self,
        center: Vec3<T>,
        radius: T,
        material: MaterialDescription<T>,
    ) -> Result<(), SceneError> {
        self.has_room(Pool::Spheres)?;
        let mut sphere = Sphere::new(center, radius, self.next_surface())?;
        sphere.set_material(self.share(material)?);
        self.forget_visibility();
        push(self.spheres, sphere, Pool::Spheres)
    }

    /// Adds the plane of the points with `normal·p + distance = 0`.
    ///
    /// # Errors
    ///
    /// [`SceneError::PoolFull`] and those of [`Plane::new`]; the scene is then as it was.
    pub fn add_plane(
        &mut self,
        normal: Vec3<T>,
        distance: T,
        material: MaterialDescription<T>,
    ) -> Result<(), SceneError> {
        self.has_room(Pool::Planes)?;
        let mut plane = Plane::new(normal, distance, self.next_surface())?;
        plane.set_material(self.share(material)?);
        self.forget_visibility();
        push(self.planes, plane, Pool::Planes)
    }

    /// Adds a triangle.
    ///
    /// # Errors
    ///
    /// [`SceneError::PoolFull`] and those of [`Triangle::new`]; the scene is then as it was.
    pub fn add_triangle(
        &mut self,
        vertices: [Vec3<T>; 3],
        material: MaterialDescription<T>,
    ) -> Result<(), SceneError> {
        self.has_room(Pool::Triangles)?;
        let mut triangle = Triangle::new(vertices, self.next_surface())?;
        triangle.set_material(self.share(material)?);
        self.forget_visibility();
        push(self.triangles, triangle, Pool::Triangles)
    }

    /// The scene so far, and room for what is to be found out about it.
    fn as_scene_and_visibility(&mut self) -> (Scene<'_, T>, Visibility<'_, T>) {
        let scene = Scene {
            camera: self.settings.camera,
            resolution: self.settings.resolution,
            ambient: self.settings.ambient,
            background: self.settings.background,
            lights: self.lights,
            spheres: self.spheres,
            planes: self.planes,
            triangles: self.triangles,
            materials: self.materials,
            sides: &[],
            zones: &[],
            tree: Tree::NONE,
        };
        let visibility = Visibility {
            sides: self.sides,
            zones: self.zones,
            nodes: self.nodes,
            entries: self.entries,
        };
        (scene, visibility)
    }

    /// Fills in the sides of all objects, or of none if there is not enough room for all.
    pub(crate) fn fill_sides(&mut self, sides: fn(&Scene<'_, T>, Object<'_, T>) -> [Reach; 2]) {
        let (scene, room) = self.as_scene_and_visibility();
        room.sides.clear();
        if scene.object_count() > room.sides.capacity() {
            return;
        }
        for object in scene.objects() {
            // There is room for all.
            let _ = room.sides.push(sides(&scene, object));
        }
    }

    /// Fills in the alignments of all materials below which no highlight is seen.
    pub(crate) fn fill_faint_alignments(
        &mut self,
        faint_alignment: fn(&Scene<'_, T>, &Material<T>) -> T,
    ) {
        for index in 0..self.materials.len() {
            let (scene, _) = self.as_scene_and_visibility();
            let alignment = scene
                .materials
                .get(index)
                .map(|material| faint_alignment(&scene, material));
            if let (Some(alignment), Some(material)) = (alignment, self.materials.get_mut(index)) {
                material.set_faint_alignment(alignment);
            }
        }
    }

    /// Fills in the zones of all planes, if the sides are known.
    pub(crate) fn fill_zones(&mut self, zones: fn(&Scene<'_, T>, &Plane<T>) -> Zones<T>) {
        let (scene, room) = self.as_scene_and_visibility();
        room.zones.clear();
        if room.sides.is_empty() {
            return;
        }
        for plane in scene.planes {
            // There is room for all.
            let _ = room.zones.push(zones(&scene, plane));
        }
    }

    /// Fills in a tree of all spheres and triangles, or none if they are fewer than `fewest` or there is
    /// not enough room for all.
    pub(crate) fn fill_tree(
        &mut self,
        fewest: usize,
        build: impl FnOnce(&Scene<'_, T>, &mut [TreeEntry], &mut VecView<TreeNode<T>>),
    ) {
        let (scene, room) = self.as_scene_and_visibility();
        room.nodes.clear();
        room.entries.clear();
        let count = scene.spheres.len() + scene.triangles.len();
        if count < fewest || count > room.entries.capacity() {
            return;
        }
        let spheres = (0..scene.spheres.len()).map(|index| TreeEntry::sphere(index as u32));
        let triangles = (0..scene.triangles.len()).map(|index| TreeEntry::triangle(index as u32));
        for entry in spheres.chain(triangles) {
            // There is room for all. `extend` could panic, as far as the compiler knows.
            let _ = room.entries.push(entry);
        }
        build(&scene, room.entries, room.nodes);
    }

    /// The surface of the next object, its material still to be found.
    fn next_surface(&self) -> Surface {
        let number = self.spheres.len() + self.planes.len() + self.triangles.len();
        Surface {
            material: 0,
            number: number as u32,
        }
    }

    /// The index of a material: of an equal one added lately, or of a new one.
    fn share(&mut self, description: MaterialDescription<T>) -> Result<u32, SceneError> {
        let known = self
            .materials
            .iter()
            .enumerate()
            .rev()
            .take(MATERIAL_LOOK_BACK)
            .find(|(_, material)| *material.description() == description);
        if let Some((index, _)) = known {
            return Ok(index as u32);
        }
        let index = self.materials.len() as u32;
        push(self.materials, Material::new(description), Pool::Materials)?;
        Ok(index)
    }
}

/// Room for what is found out about a scene.
struct Visibility<'p, T> {
    sides: &'p mut VecView<[Reach; 2]>,
    zones: &'p mut VecView<Zones<T>>,
    nodes: &'p mut VecView<TreeNode<T>>,
    entries: &'p mut VecView<TreeEntry>,
}

fn push<E>(entries: &mut VecView<E>, entry: E, pool: Pool) -> Result<(), SceneError> {
    let capacity = entries.capacity();
    entries
        .push(entry)
        .map_err(|_| SceneError::PoolFull { pool, capacity })
}
