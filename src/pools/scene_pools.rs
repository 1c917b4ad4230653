//! Pools for the world of the numeric dialect: spheres, planes, triangles.

use heapless::Vec;

use super::{AccelPools, Declared, Lent, Pool, PoolUse, PoolsMut, Settings, stages_of_pools};
use crate::light::Light;
use crate::material::Material;
use crate::scalar::Scalar;
use crate::scene::Scene;
use crate::shape::{Geometry, Plane, Sphere, Stored, Triangle};
use crate::stages::Stages;

/// What [`ScenePools`] are declared for: all that the numeric dialect can say.
#[derive(Clone, Copy, Debug)]
pub struct Paper;

impl Declared for Paper {
    const STAGES: Stages = Stages::ALL.without(Stages::STORED_SHAPES);
}

/// The same, and a hierarchy of large scenes.
#[derive(Clone, Copy, Debug)]
struct PaperWithBvh;

impl Declared for PaperWithBvh {
    const STAGES: Stages = Paper::STAGES.union(Stages::BVH);
}

/// Pools for one scene of the numeric dialect, in RAM: a `static`, a local or a field.
/// [`scene_pools!`](crate::scene_pools) declares pools by name, for scenes of anything.
///
/// A full pool is an error, never a silent loss; only two capacities are for speed alone
/// ([`ScenePools::prepare`]): `SIDES`, the number of objects whose mutual visibility is kept, and `BVH`, the
/// number of spheres and triangles that a [`Bvh`](crate::accel::Bvh) is built for, which takes 36 bytes each in `f32` (60 in
/// `f64`) and pays from some 50 objects on, with a tracer that uses it ([`Tracer::with_bvh`](crate::Tracer::with_bvh)). The
/// default capacities hold every scene of the repository's `scenes/` folder, without a hierarchy.
#[derive(Clone, Debug)]
pub struct ScenePools<
    T = f32,
    const SPHERES: usize = 16,
    const PLANES: usize = 8,
    const TRIANGLES: usize = 24,
    const MATERIALS: usize = 16,
    const LIGHTS: usize = 1,
    const SIDES: usize = 48,
    const BVH: usize = 0,
> {
    settings: Settings<T>,
    spheres: Vec<Sphere<T>, SPHERES>,
    planes: Vec<Plane<T>, PLANES>,
    triangles: Vec<Triangle<T>, TRIANGLES>,
    materials: Vec<Material<T>, MATERIALS>,
    lights: Vec<Light<T>, LIGHTS>,
    accel: AccelPools<T, SIDES, PLANES, BVH>,
}

impl<
    T: Scalar,
    const SPHERES: usize,
    const PLANES: usize,
    const TRIANGLES: usize,
    const MATERIALS: usize,
    const LIGHTS: usize,
    const SIDES: usize,
    const BVH: usize,
> ScenePools<T, SPHERES, PLANES, TRIANGLES, MATERIALS, LIGHTS, SIDES, BVH>
{
    /// The stages that a scene in these pools can need, for [`tracer_for!`](crate::tracer_for): what there is no room for
    /// is left out: shapes and lights, loops where there can be one of them at most, and what only scenes of more than
    /// 31 objects need, or a hierarchy.
    pub const STAGES: Stages = stages_of_pools(
        &[
            ("spheres", SPHERES),
            ("planes", PLANES),
            ("triangles", TRIANGLES),
            ("materials", MATERIALS),
            ("lights", LIGHTS),
        ],
        BVH,
    );

    /// Empty pools: a scene without objects and lights, of 0×0 pixels.
    pub const fn new() -> Self {
        Self {
            settings: Settings::EMPTY,
            spheres: Vec::new(),
            planes: Vec::new(),
            triangles: Vec::new(),
            materials: Vec::new(),
            lights: Vec::new(),
            accel: AccelPools::new(),
        }
    }

    /// The scene in the pools.
    pub fn as_scene(&self) -> Scene<'_, T> {
        let Settings {
            camera,
            resolution,
            ambient,
            background,
        } = self.settings;
        Scene {
            camera,
            resolution,
            ambient,
            background,
            lights: &self.lights,
            geometry: Geometry {
                spheres: &self.spheres,
                planes: &self.planes,
                triangles: &self.triangles,
                stored: Stored::NONE,
            },
            materials: &self.materials,
            accel: self.accel.as_accel(),
        }
    }

    /// The pools without their capacities in the type, to be filled.
    pub fn as_mut(&mut self) -> PoolsMut<'_, T> {
        self.lend()
    }

    /// The pools without their capacities.
    #[inline(always)]
    fn lend<D: Declared>(&mut self) -> PoolsMut<'_, T, D> {
        let lent = Lent {
            spheres: Some(&mut self.spheres),
            planes: Some(&mut self.planes),
            triangles: Some(&mut self.triangles),
            materials: Some(&mut self.materials),
            lights: Some(&mut self.lights),
            stored: None,
        };
        PoolsMut::new(&mut self.settings, lent, self.accel.as_mut())
    }

    /// Derives from the scene what spares rays tests, if the pools have room for that: which objects can hit which, and a
    /// bounding-volume hierarchy of a large scene. The picture is the same in less time.
    ///
    /// Loading a scene text does this; call it after changing a scene by hand.
    // Not inlined, so that its locals are not on the stack while a text is read.
    #[inline(never)]
    pub fn prepare(&mut self) {
        // Not compiled for pools without room.
        if const { BVH > 0 } {
            self.lend::<PaperWithBvh>().prepare();
        } else {
            self.lend::<Paper>().prepare();
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
    const BVH: usize,
> Default for ScenePools<T, SPHERES, PLANES, TRIANGLES, MATERIALS, LIGHTS, SIDES, BVH>
{
    fn default() -> Self {
        Self::new()
    }
}
