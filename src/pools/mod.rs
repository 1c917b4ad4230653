//! Static pools that own a scene: no allocation, capacities fixed where they are declared.
//!
//! [`scene_pools!`](crate::scene_pools) declares pools by name, for whatever a scene holds; [`ScenePools`] are those of the numeric
//! dialect's world. Everything else borrows them without their capacities, as [`PoolsMut`].

mod named_pools;
mod scene_pools;

use named_pools::capacity_of;
#[doc(hidden)]
pub use named_pools::{
    AccelPools, InStored, PoolField, StoredPools, accel_capacities, require_pool,
    stages_of_declaration, stages_of_pools, stored_capacities,
};
pub use scene_pools::{Paper, ScenePools};

use core::fmt;
use core::marker::PhantomData;

use heapless::VecView;

use crate::accel::AccelMut;
use crate::accel::highlights::faint_alignment;
use crate::background::Background;
use crate::camera::{Camera, Resolution};
use crate::light::Light;
use crate::material::{Material, MaterialDescription};
use crate::ray::ObjectNumber;
use crate::scalar::Scalar;
use crate::scene::Scene;
use crate::shape::{
    Disc, Kind, ObjectInfo, Plane, Primitive, Shape, ShapeError, Sphere, Stored, StoredEntry,
    StoredShape, Triangle,
};
use crate::stages::Stages;
use crate::vec3::Vec3;

/// How many of the latest materials a new one is compared with: enough for files that repeat a
/// material along a mesh, and constant, so that loading stays linear in the text.
const MATERIAL_LOOK_BACK: usize = 16;

/// What a scene has one of.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings<T> {
    camera: Camera<T>,
    resolution: Resolution,
    ambient: T,
    background: Background<T>,
}

impl<T: Scalar> Settings<T> {
    /// Those of [`Scene::EMPTY`]: all bits zero, so that empty pools in a `static` take no flash.
    pub const EMPTY: Self = {
        let Scene {
            camera,
            resolution,
            ambient,
            background,
            ..
        } = Scene::EMPTY;
        Self {
            camera,
            resolution,
            ambient,
            background,
        }
    };

    /// A scene without objects and lights.
    pub const fn scene<'a>(&self) -> Scene<'a, T> {
        let mut scene = Scene::EMPTY;
        scene.camera = self.camera;
        scene.resolution = self.resolution;
        scene.ambient = self.ambient;
        scene.background = self.background;
        scene
    }
}

/// A kind of pool.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
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
    /// Discs.
    Discs,
}

impl Pool {
    /// All kinds: those of objects in the order of [`Kind::ALL`](crate::shape::Kind::ALL), then the others.
    pub const ALL: [Self; 6] = [
        Self::Spheres,
        Self::Planes,
        Self::Triangles,
        Self::Discs,
        Self::Materials,
        Self::Lights,
    ];

    /// Its name in messages and in [`scene_pools!`](crate::scene_pools), in the plural.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Spheres => "spheres",
            Self::Planes => "planes",
            Self::Triangles => "triangles",
            Self::Materials => "materials",
            Self::Lights => "lights",
            Self::Discs => "discs",
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
#[non_exhaustive]
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
    /// There is nothing at this index to be changed.
    Missing {
        /// In which pool.
        pool: Pool,
        /// The index that was asked for.
        index: usize,
        /// How many there are.
        used: usize,
    },
    /// The pools were declared without a stage that this needs.
    LeftOut {
        /// The stage.
        stage: Stages,
    },
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::PoolFull { pool, capacity } => {
                write!(f, "the pool holds at most {capacity} {}", pool.name())
            }
            Self::Shape(error) => error.fmt(f),
            Self::Missing { pool, index, used } => write!(
                f,
                "there are {used} {}, so that none has the index {index}",
                pool.name()
            ),
            Self::LeftOut { stage } => {
                write!(
                    f,
                    "the pools are declared without {stage}, which this needs"
                )
            }
        }
    }
}

impl core::error::Error for SceneError {}

impl From<ShapeError> for SceneError {
    fn from(error: ShapeError) -> Self {
        Self::Shape(error)
    }
}

/// What pools were declared for: known to the compiler, so that loading has no code for anything else.
pub trait Declared {
    /// The stages that a scene in the pools can need.
    const STAGES: Stages;

    /// The pools by name, and what they hold.
    #[doc(hidden)]
    const POOLS: &'static [(&'static str, usize)] = &[];
}

/// What a pool holds.
#[doc(hidden)]
pub trait PoolEntry<T>: Sized + 'static {
    /// The pool.
    const POOL: Pool;

    /// The pool among those lent.
    fn lent<'l, 'p>(lent: &'l mut Lent<'p, T>) -> &'l mut Option<&'p mut VecView<Self>>;

    /// The scene with what is in the pool.
    fn put<'a>(scene: Scene<'a, T>, entries: &'a [Self]) -> Scene<'a, T>;
}

macro_rules! pool_entries {
    ($($entry:ident: $pool:ident, $field:ident, $with:ident;)*) => {
        /// Pools without their capacities; `None` for what was not declared.
        #[doc(hidden)]
        #[derive(Debug)]
        pub struct Lent<'p, T> {
            $($field: Option<&'p mut VecView<$entry<T>>>,)*
            /// Objects that are stored by their numbers.
            stored: Option<StoredMut<'p, T>>,
        }

        impl<T: Scalar> Lent<'_, T> {
            /// No pools.
            pub const NONE: Self = Self { $($field: None,)* stored: None };

            fn clear(&mut self) {
                $(if let Some(pool) = &mut self.$field {
                    pool.clear();
                })*
                if let Some(stored) = &mut self.stored {
                    stored.entries.clear();
                    stored.numbers.clear();
                }
            }

            /// Entries and room of a pool.
            fn room<D: Declared>(&self, pool: Pool) -> (usize, usize) {
                match pool {
                    Pool::Discs => self.stored_room::<D>(Kind::Disc, pool),
                    $(Pool::$pool => match &self.$field {
                        Some(pool) => (pool.len(), pool.capacity()),
                        None => (0, 0),
                    },)*
                }
            }

            /// The scene in the pools, without what was derived.
            #[inline(always)]
            fn scene(&self, settings: &Settings<T>) -> Scene<'_, T> {
                let mut scene = settings.scene();
                $(if let Some(pool) = &self.$field {
                    scene = scene.$with(pool);
                })*
                if let Some(stored) = &self.stored {
                    scene = scene.with_stored(Stored {
                        entries: stored.entries,
                        numbers: stored.numbers,
                    });
                }
                scene
            }
        }

        $(impl<T: Scalar> PoolEntry<T> for $entry<T> {
            const POOL: Pool = Pool::$pool;

            fn lent<'l, 'p>(lent: &'l mut Lent<'p, T>) -> &'l mut Option<&'p mut VecView<Self>> {
                &mut lent.$field
            }

            fn put<'a>(scene: Scene<'a, T>, entries: &'a [Self]) -> Scene<'a, T> {
                scene.$with(entries)
            }
        })*
    };
}

/// Objects that are stored by their numbers, without capacities.
#[doc(hidden)]
#[derive(Debug)]
pub struct StoredMut<'p, T> {
    entries: &'p mut VecView<StoredEntry>,
    numbers: &'p mut VecView<T>,
}

impl<T: Scalar> Lent<'_, T> {
    /// Objects of a stored kind, and for how many the pools were declared.
    fn stored_room<D: Declared>(&self, kind: Kind, pool: Pool) -> (usize, usize) {
        let used = self.stored.as_ref().map_or(0, |stored| {
            let stored = Stored::<T>::from_parts(stored.entries, &[]);
            stored.count_of(kind)
        });
        (used, capacity_of(D::POOLS, pool.name()))
    }
}

pool_entries! {
    Sphere: Spheres, spheres, with_spheres;
    Plane: Planes, planes, with_planes;
    Triangle: Triangles, triangles, with_triangles;
    Material: Materials, materials, with_materials;
    Light: Lights, lights, with_lights;
}

/// The entries of one pool.
#[doc(hidden)]
pub type Entries<E, const CAPACITY: usize> = heapless::Vec<E, CAPACITY>;

/// Pools of any capacity, borrowed to be filled. `D` is what they were declared for.
///
/// Whatever changes objects, lights or materials forgets what was derived from them, so that a picture is never wrong;
/// [`PoolsMut::prepare`] derives it again, so that it takes less time.
#[derive(Debug)]
pub struct PoolsMut<'p, T, D = Paper> {
    settings: &'p mut Settings<T>,
    lent: Lent<'p, T>,
    accel: AccelMut<'p, T>,
    declared: PhantomData<D>,
}

impl<'p, T: Scalar, D: Declared> PoolsMut<'p, T, D> {
    /// Pools from their parts, for [`scene_pools!`](crate::scene_pools).
    #[doc(hidden)]
    #[inline(always)]
    pub fn new(settings: &'p mut Settings<T>, lent: Lent<'p, T>, accel: AccelMut<'p, T>) -> Self {
        Self {
            settings,
            lent,
            accel,
            declared: PhantomData,
        }
    }

    /// Removes everything.
    pub fn clear(&mut self) {
        *self.settings = Settings::EMPTY;
        self.lent.clear();
        self.accel.clear();
    }

    /// Derives from the scene what spares rays tests, if the pools have room for that: which objects can hit which, and a
    /// bounding-volume hierarchy of a large scene. The picture is the same in less time.
    ///
    /// Loading a scene text does this; call it after changing a scene by hand.
    #[inline(always)]
    pub fn prepare(&mut self) {
        let mut source = self.lent.scene(self.settings).source();
        if D::STAGES.without(Stages::STORED_SHAPES).bits() == D::STAGES.bits() {
            // Known to the compiler, so that there is no code for them.
            source.geometry.stored = Stored::NONE;
        }
        self.accel.find_clear_lights(&source);
        self.accel.find_candidates(&source);
        // Not compiled for pools without room.
        if D::STAGES.contains(Stages::BVH) {
            self.accel.build_bvh(&source.geometry);
        }
        self.find_faint_highlights();
    }

    /// Finds which highlights nobody sees.
    fn find_faint_highlights(&mut self) {
        let count = self.lent.scene(self.settings).materials.len();
        for index in 0..count {
            let source = self.lent.scene(self.settings).source();
            let faint = source
                .materials
                .get(index)
                .map(|material| faint_alignment(&source, self.settings.ambient, material));
            if let (Some(faint), Ok(material)) =
                (faint, entry::<Material<T>, T>(&mut self.lent, index))
            {
                material.set_faint_alignment(faint);
            }
        }
    }

    /// Sets where the scene is seen from; what was derived stays true.
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
        self.accel.clear();
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
        let (used, capacity) = self.lent.room::<D>(pool);
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
        self.accel.clear();
        push(&mut self.lent, light)
    }

    /// Adds an object of any shape.
    ///
    /// # Errors
    ///
    /// [`SceneError::PoolFull`], those of the shape's `new`, and [`SceneError::LeftOut`] of the material; the scene is then as it
    /// was.
    #[inline]
    pub fn add(
        &mut self,
        shape: Shape<T>,
        material: MaterialDescription<T>,
    ) -> Result<(), SceneError> {
        match shape {
            Shape::Sphere { center, radius } => self.add_sphere(center, radius, material),
            Shape::Plane { normal, distance } => self.add_plane(normal, distance, material),
            Shape::Triangle(vertices) => self.add_triangle(vertices, material),
            Shape::Disc {
                center,
                normal,
                radius,
            } => self.add_stored(
                Pool::Discs,
                |info| Disc::new(center, normal, radius, info),
                material,
            ),
        }
    }

    /// Adds a sphere.
    ///
    /// # Errors
    ///
    /// As of [`PoolsMut::add`].
    pub fn add_sphere(
        &mut self,
        center: Vec3<T>,
        radius: T,
        material: MaterialDescription<T>,
    ) -> Result<(), SceneError> {
        self.add_made(|info| Sphere::new(center, radius, info), material)
    }

    /// Adds the plane of the points with `normal·p + distance = 0`.
    ///
    /// # Errors
    ///
    /// As of [`PoolsMut::add`].
    pub fn add_plane(
        &mut self,
        normal: Vec3<T>,
        distance: T,
        material: MaterialDescription<T>,
    ) -> Result<(), SceneError> {
        self.add_made(|info| Plane::new(normal, distance, info), material)
    }

    /// Adds a triangle.
    ///
    /// # Errors
    ///
    /// As of [`PoolsMut::add`].
    pub fn add_triangle(
        &mut self,
        vertices: [Vec3<T>; 3],
        material: MaterialDescription<T>,
    ) -> Result<(), SceneError> {
        self.add_made(|info| Triangle::new(vertices, info), material)
    }

    /// Adds an object that `make` makes for its surface.
    fn add_made<P: Primitive<T> + PoolEntry<T>>(
        &mut self,
        make: impl FnOnce(ObjectInfo) -> Result<P, ShapeError>,
        material: MaterialDescription<T>,
    ) -> Result<(), SceneError> {
        self.has_room(P::POOL)?;
        let mut object = make(self.next_info())?;
        object.set_material(self.share(material)?);
        self.accel.clear();
        push(&mut self.lent, object)
    }

    /// [`PoolsMut::add_made`] of a shape that is stored by its numbers.
    fn add_stored<P: StoredShape<T>>(
        &mut self,
        pool: Pool,
        make: impl FnOnce(ObjectInfo) -> Result<P, ShapeError>,
        material: MaterialDescription<T>,
    ) -> Result<(), SceneError> {
        self.has_room(pool)?;
        let mut object = make(self.next_info())?;
        object.set_material(self.share(material)?);
        self.accel.clear();
        let full = SceneError::PoolFull {
            pool,
            capacity: capacity_of(D::POOLS, pool.name()),
        };
        // There is room for all that were declared.
        let stored = self.lent.stored.as_mut().ok_or(full)?;
        let first = stored.numbers.len();
        for _ in 0..P::NUMBERS {
            stored.numbers.push(T::ZERO).map_err(|_| full)?;
        }
        if let Some(numbers) = stored.numbers.get_mut(first..) {
            object.write(numbers);
        }
        let entry = StoredEntry {
            kind: P::KIND,
            first: first as u32,
            info: object.info(),
        };
        stored.entries.push(entry).map_err(|_| full)
    }

    /// [`PoolsMut::set_made`] of a shape that is stored by its numbers.
    fn set_stored<P: StoredShape<T>>(
        &mut self,
        pool: Pool,
        index: usize,
        make: impl FnOnce(ObjectInfo) -> Result<P, ShapeError>,
    ) -> Result<(), SceneError> {
        let (used, _) = self.lent.room::<D>(pool);
        let missing = SceneError::Missing { pool, index, used };
        let stored = self.lent.stored.as_mut().ok_or(missing)?;
        let entry = stored
            .entries
            .iter()
            .filter(|entry| entry.kind == P::KIND)
            .nth(index)
            .ok_or(missing)?;
        let object = make(entry.info)?;
        let first = entry.first as usize;
        if let Some(numbers) = stored.numbers.get_mut(first..first + P::NUMBERS) {
            object.write(numbers);
        }
        self.accel.clear();
        Ok(())
    }

    /// Puts another shape in the place of an object, by its index among those of the shape's kind. Material and index stay.
    ///
    /// # Errors
    ///
    /// [`SceneError::Missing`] and those of the shape's `new`; the scene is then as it was.
    pub fn set(&mut self, index: usize, shape: Shape<T>) -> Result<(), SceneError> {
        match shape {
            Shape::Sphere { center, radius } => self.set_sphere(index, center, radius),
            Shape::Plane { normal, distance } => self.set_plane(index, normal, distance),
            Shape::Triangle(vertices) => self.set_triangle(index, vertices),
            Shape::Disc {
                center,
                normal,
                radius,
            } => self.set_stored(Pool::Discs, index, |info| {
                Disc::new(center, normal, radius, info)
            }),
        }
    }

    /// Moves or resizes the sphere of an index among spheres.
    ///
    /// # Errors
    ///
    /// As of [`PoolsMut::set`].
    pub fn set_sphere(
        &mut self,
        index: usize,
        center: Vec3<T>,
        radius: T,
    ) -> Result<(), SceneError> {
        self.set_made(index, |info| Sphere::new(center, radius, info))
    }

    /// Moves the plane of an index among planes.
    ///
    /// # Errors
    ///
    /// As of [`PoolsMut::set`].
    pub fn set_plane(
        &mut self,
        index: usize,
        normal: Vec3<T>,
        distance: T,
    ) -> Result<(), SceneError> {
        self.set_made(index, |info| Plane::new(normal, distance, info))
    }

    /// Moves the triangle of an index among triangles.
    ///
    /// # Errors
    ///
    /// As of [`PoolsMut::set`].
    pub fn set_triangle(&mut self, index: usize, vertices: [Vec3<T>; 3]) -> Result<(), SceneError> {
        self.set_made(index, |info| Triangle::new(vertices, info))
    }

    fn set_made<P: Primitive<T> + PoolEntry<T>>(
        &mut self,
        index: usize,
        make: impl FnOnce(ObjectInfo) -> Result<P, ShapeError>,
    ) -> Result<(), SceneError> {
        let place = entry::<P, T>(&mut self.lent, index)?;
        *place = make(place.info())?;
        self.accel.clear();
        Ok(())
    }

    /// Changes the light of an index.
    ///
    /// # Errors
    ///
    /// [`SceneError::Missing`].
    pub fn set_light(&mut self, index: usize, light: Light<T>) -> Result<(), SceneError> {
        *entry::<Light<T>, T>(&mut self.lent, index)? = light;
        self.accel.clear();
        Ok(())
    }

    /// Changes the material of an index, and with it all objects that share it: those that were added with equal materials.
    /// ([`ObjectInfo::material`] of an object is that index.)
    ///
    /// # Errors
    ///
    /// [`SceneError::Missing`], [`SceneError::LeftOut`]; the scene is then as it was.
    pub fn set_material(
        &mut self,
        index: usize,
        material: MaterialDescription<T>,
    ) -> Result<(), SceneError> {
        check_stages::<T, D>(&material)?;
        *entry::<Material<T>, T>(&mut self.lent, index)? = Material::new(material);
        self.accel.clear();
        Ok(())
    }

    /// The surface of the next object, its material still to be found.
    fn next_info(&self) -> ObjectInfo {
        ObjectInfo {
            material: 0,
            number: self.lent.scene(self.settings).object_count() as ObjectNumber,
        }
    }

    /// The index of a material: of an equal one added lately, or of a new one.
    fn share(&mut self, description: MaterialDescription<T>) -> Result<u32, SceneError> {
        check_stages::<T, D>(&description)?;
        let materials = self.lent.scene(self.settings).materials;
        let known = materials
            .iter()
            .enumerate()
            .rev()
            .take(MATERIAL_LOOK_BACK)
            .find(|(_, material)| *material.description() == description);
        if let Some((index, _)) = known {
            return Ok(index as u32);
        }
        let index = materials.len() as u32;
        push(&mut self.lent, Material::new(description))?;
        Ok(index)
    }
}

/// Whether the stages that a material needs whatever the lights were declared.
fn check_stages<T: Scalar, D: Declared>(
    material: &MaterialDescription<T>,
) -> Result<(), SceneError> {
    let refracts = material.refraction > T::ZERO;
    let needed = [
        (material.reflection > T::ZERO, Stages::REFLECTION),
        (refracts, Stages::REFRACTION),
        (
            refracts && material.index_of_refraction != T::ONE,
            Stages::BENDING,
        ),
        (!material.specular.is_black(), Stages::SPECULAR),
    ];
    for (is_needed, stage) in needed {
        if is_needed && !D::STAGES.contains(stage) {
            return Err(SceneError::LeftOut { stage });
        }
    }
    Ok(())
}

fn push<E: PoolEntry<T>, T>(lent: &mut Lent<'_, T>, entry: E) -> Result<(), SceneError> {
    let full = |capacity| SceneError::PoolFull {
        pool: E::POOL,
        capacity,
    };
    let entries = E::lent(lent).as_mut().ok_or(full(0))?;
    let capacity = entries.capacity();
    entries.push(entry).map_err(|_| full(capacity))
}

fn entry<'l, E: PoolEntry<T>, T>(
    lent: &'l mut Lent<'_, T>,
    index: usize,
) -> Result<&'l mut E, SceneError> {
    let pool = E::lent(lent);
    let used = pool.as_ref().map_or(0, |pool| pool.len());
    pool.as_mut()
        .and_then(|pool| pool.get_mut(index))
        .ok_or(SceneError::Missing {
            pool: E::POOL,
            index,
            used,
        })
}
