//! Pools that are declared by name.

use heapless::Vec;

use super::{Lent, PoolEntry, StoredMut};
use crate::accel::{Accel, AccelMut, Bvh, BvhNode, Candidates, ObjectSet, PlaneGrid};
use crate::scalar::Scalar;
use crate::scene::Scene;
use crate::shape::{Disc, Stored, StoredEntry, StoredShape};
use crate::stages::Stages;

/// Declares a type of pools for one scene, by the names of what a scene in them may hold.
///
/// `scene_pools! { pub struct Mine { spheres: 16, planes: 2, materials: 8, lights: 1 } without refraction }` is a type `Mine` that
/// holds so many spheres, planes, materials and lights, and for the tracer what is derived from them. A kind that is not named
/// takes no RAM, and neither loading nor tracing has code for it; so do the stages behind `without`: `reflection`,
/// `refraction`, `bending` (indices other than 1), `specular`. `without accel` keeps nothing that is derived: the
/// same picture with less RAM in more time. A scene that needs more is an error, which says what.
///
/// ```
/// scanray::scene_pools! {
///     /// For the scenes of my device.
///     pub struct Mine { spheres: 5, planes: 1, materials: 4, lights: 1 } without refraction
/// }
///
/// let mut pools = Mine::new(); // or a `static`
/// # #[cfg(feature = "parser")]
/// pools.parse(b"1
///     0 0 0
///     64 48
///     5 5 -5  1 1 1  1 1 1
///     0.1
///     1
///     0 0 0
///     0  0 0 3  1  0.8 0.1 0.1  0.5 0.5 0.5  0.8 0.1 0.1  0.2 50 0 0")?;
/// let tracer = pools.tracer();
/// assert!(!tracer.stages().contains(scanray::Stages::TRIANGLES));
/// # let _ = tracer.pixel(32, 24);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// In `f64`: `pub struct Mine<f64> { … }`.
#[macro_export]
macro_rules! scene_pools {
    (
        $(#[$meta:meta])*
        $visibility:vis struct $name:ident { $($pool:ident: $capacity:expr),+ $(,)? }
        $(without $($left_out:ident),+ $(,)?)?
    ) => {
        $crate::scene_pools! {
            $(#[$meta])*
            $visibility struct $name<f32> { $($pool: $capacity),+ } $(without $($left_out),+)?
        }
    };
    (
        $(#[$meta:meta])*
        $visibility:vis struct $name:ident<$scalar:ty> { $($pool:ident: $capacity:expr),+ $(,)? }
        $(without $($left_out:ident),+ $(,)?)?
    ) => {
        $(#[$meta])*
        #[derive(Clone, Debug)]
        $visibility struct $name {
            settings: $crate::pools::Settings<$scalar>,
            $($pool: $crate::field_of_pool!($pool, $scalar, { $capacity }),)+
            stored: $crate::pools::StoredPools<
                $scalar,
                { $name::STORED[0] },
                { $name::STORED[1] },
            >,
            accel: $crate::pools::AccelPools<
                $scalar,
                { $name::ACCEL[0] },
                { $name::ACCEL[1] },
                { $name::ACCEL[2] },
            >,
        }

        #[allow(dead_code)]
        impl $name {
            const POOLS: &[(&str, usize)] = &[$((stringify!($pool), { $capacity })),+];
            const LEFT_OUT: &[&str] = &[$($(stringify!($left_out)),+)?];
            const STORED: [usize; 2] = $crate::pools::stored_capacities(Self::POOLS);
            const ACCEL: [usize; 3] = $crate::pools::accel_capacities(Self::POOLS, Self::LEFT_OUT);

            /// The stages that a scene in these pools can need.
            pub const STAGES: $crate::Stages = {
                $crate::pools::require_pool(Self::POOLS, "materials");
                $crate::pools::stages_of_declaration(Self::POOLS, Self::LEFT_OUT)
            };

            /// Empty pools: a scene without objects and lights, of 0×0 pixels.
            pub const fn new() -> Self {
                Self {
                    settings: $crate::pools::Settings::EMPTY,
                    $($pool: <$crate::field_of_pool!($pool, $scalar, { $capacity })
                        as $crate::pools::PoolField<$scalar>>::NEW,)+
                    stored: $crate::pools::StoredPools::new(),
                    accel: $crate::pools::AccelPools::new(),
                }
            }

            /// The scene in the pools.
            pub fn as_scene(&self) -> $crate::Scene<'_, $scalar> {
                let scene = self.settings.scene();
                $(let scene = $crate::pools::PoolField::put(&self.$pool, scene);)+
                scene.with_stored(self.stored.as_stored()).with_accel(self.accel.as_accel())
            }

            /// The pools without their capacities in the type, to be filled.
            pub fn as_mut(&mut self) -> $crate::pools::PoolsMut<'_, $scalar, Self> {
                let mut lent = $crate::pools::Lent::NONE;
                $($crate::pools::PoolField::lend(&mut self.$pool, &mut lent);)+
                self.stored.lend(&mut lent);
                $crate::pools::PoolsMut::new(&mut self.settings, lent, self.accel.as_mut())
            }

            /// Derives from the scene what spares rays tests; loading a text does this.
            pub fn prepare(&mut self) {
                self.as_mut().prepare();
            }

            $crate::parse_into_pools! {}

            /// A tracer of the scene in the pools, with the stages that one in them can need.
            pub fn tracer(
                &self,
            ) -> $crate::Tracer<'_, $scalar, { $name::STAGES.bits() }, { $crate::DEFAULT_MAX_DEPTH }> {
                $crate::Tracer::with_stages(self.as_scene())
            }
        }

        impl $crate::pools::Declared for $name {
            const STAGES: $crate::Stages = Self::STAGES;
            const POOLS: &'static [(&'static str, usize)] = Self::POOLS;
        }

        impl ::core::default::Default for $name {
            fn default() -> Self {
                Self::new()
            }
        }
    };
}

/// The field of a pool of this name.
#[doc(hidden)]
#[macro_export]
macro_rules! field_of_pool {
    (spheres, $scalar:ty, $capacity:expr) => {
        $crate::pools::Entries<$crate::shape::Sphere<$scalar>, $capacity>
    };
    (planes, $scalar:ty, $capacity:expr) => {
        $crate::pools::Entries<$crate::shape::Plane<$scalar>, $capacity>
    };
    (triangles, $scalar:ty, $capacity:expr) => {
        $crate::pools::Entries<$crate::shape::Triangle<$scalar>, $capacity>
    };
    (materials, $scalar:ty, $capacity:expr) => {
        $crate::pools::Entries<$crate::Material<$scalar>, $capacity>
    };
    (lights, $scalar:ty, $capacity:expr) => {
        $crate::pools::Entries<$crate::Light<$scalar>, $capacity>
    };
    (discs, $scalar:ty, $capacity:expr) => { $crate::pools::InStored };
    ($other:ident, $scalar:ty, $capacity:expr) => {
        compile_error!(concat!(
            "there is no pool `",
            stringify!($other),
            "`: name spheres, planes, triangles, discs, materials or lights"
        ))
    };
}

/// Loading, of a build that can.
#[cfg(feature = "parser")]
#[doc(hidden)]
#[macro_export]
macro_rules! parse_into_pools {
    () => {
        /// Replaces the scene in the pools by that of a text in the numeric dialect.
        ///
        /// # Errors
        ///
        /// `ParseError` for the first thing that is wrong; the pools are then empty.
        pub fn parse(&mut self, text: &[u8]) -> Result<$crate::parser::Report, $crate::ParseError> {
            self.as_mut().parse(text)
        }
    };
}

/// Loading, of a build that cannot.
#[cfg(not(feature = "parser"))]
#[doc(hidden)]
#[macro_export]
macro_rules! parse_into_pools {
    () => {};
}

/// The field of a pool.
#[doc(hidden)]
pub trait PoolField<T> {
    /// Empty.
    const NEW: Self;

    /// The scene with what is in the pool.
    fn put<'a>(&'a self, scene: Scene<'a, T>) -> Scene<'a, T>;

    /// Lends the pool without its capacity.
    fn lend<'p>(&'p mut self, lent: &mut Lent<'p, T>);
}

impl<T, E: PoolEntry<T>, const CAPACITY: usize> PoolField<T> for Vec<E, CAPACITY> {
    const NEW: Self = Self::new();

    fn put<'a>(&'a self, scene: Scene<'a, T>) -> Scene<'a, T> {
        E::put(scene, self)
    }

    fn lend<'p>(&'p mut self, lent: &mut Lent<'p, T>) {
        *E::lent(lent) = Some(self);
    }
}

/// The field of a pool whose objects are stored by their numbers, in [`StoredPools`].
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub struct InStored;

impl<T> PoolField<T> for InStored {
    const NEW: Self = Self;

    fn put<'a>(&'a self, scene: Scene<'a, T>) -> Scene<'a, T> {
        scene
    }

    fn lend<'p>(&'p mut self, _: &mut Lent<'p, T>) {}
}

/// Room for objects of all shapes that are stored by their numbers.
#[doc(hidden)]
#[derive(Clone, Debug)]
pub struct StoredPools<T, const ENTRIES: usize, const NUMBERS: usize> {
    entries: Vec<StoredEntry, ENTRIES>,
    numbers: Vec<T, NUMBERS>,
}

impl<T: Scalar, const ENTRIES: usize, const NUMBERS: usize> StoredPools<T, ENTRIES, NUMBERS> {
    /// No objects.
    pub const fn new() -> Self {
        Self {
            entries: Vec::new(),
            numbers: Vec::new(),
        }
    }

    /// The objects.
    pub fn as_stored(&self) -> Stored<'_, T> {
        Stored {
            entries: &self.entries,
            numbers: &self.numbers,
        }
    }

    /// Lends the room, if there is any.
    pub fn lend<'p>(&'p mut self, lent: &mut Lent<'p, T>) {
        if const { ENTRIES > 0 } {
            lent.stored = Some(StoredMut {
                entries: &mut self.entries,
                numbers: &mut self.numbers,
            });
        }
    }
}

impl<T: Scalar, const ENTRIES: usize, const NUMBERS: usize> Default
    for StoredPools<T, ENTRIES, NUMBERS>
{
    fn default() -> Self {
        Self::new()
    }
}

/// Room for what is derived from a scene.
#[doc(hidden)]
#[derive(Clone, Debug)]
pub struct AccelPools<T, const SIDES: usize, const GRIDS: usize, const BVH: usize> {
    sides: Vec<[Candidates; 2], SIDES>,
    grids: Vec<PlaneGrid<T>, GRIDS>,
    nodes: Vec<BvhNode<T>, BVH>,
    entries: Vec<u32, BVH>,
    lights_are_clear: bool,
}

impl<T: Scalar, const SIDES: usize, const GRIDS: usize, const BVH: usize>
    AccelPools<T, SIDES, GRIDS, BVH>
{
    /// Nothing is known.
    pub const fn new() -> Self {
        Self {
            sides: Vec::new(),
            grids: Vec::new(),
            nodes: Vec::new(),
            entries: Vec::new(),
            lights_are_clear: false,
        }
    }

    /// What is known.
    pub fn as_accel(&self) -> Accel<'_, T> {
        Accel {
            sides: self.sides.as_flattened(),
            grids: &self.grids,
            bvh: Bvh {
                nodes: &self.nodes,
                entries: &self.entries,
            },
            lights_are_clear: self.lights_are_clear,
        }
    }

    /// The room without its capacities.
    pub fn as_mut(&mut self) -> AccelMut<'_, T> {
        AccelMut {
            sides: &mut self.sides,
            grids: &mut self.grids,
            nodes: &mut self.nodes,
            entries: &mut self.entries,
            lights_are_clear: &mut self.lights_are_clear,
        }
    }
}

impl<T: Scalar, const SIDES: usize, const GRIDS: usize, const BVH: usize> Default
    for AccelPools<T, SIDES, GRIDS, BVH>
{
    fn default() -> Self {
        Self::new()
    }
}

/// A pool of objects, and the stages of one and of several. Objects of bounded shapes can be in a hierarchy.
const SHAPES: [(&str, Stages, Stages, bool); 4] = [
    ("spheres", Stages::SPHERES, Stages::SEVERAL_SPHERES, true),
    ("planes", Stages::PLANES, Stages::SEVERAL_PLANES, false),
    (
        "triangles",
        Stages::TRIANGLES,
        Stages::SEVERAL_TRIANGLES,
        true,
    ),
    ("discs", Stages::DISCS, Stages::NONE, true),
];

/// The pools of shapes that are stored, and how many numbers each object has.
const STORED: [(&str, usize); 1] = [("discs", <Disc as StoredShape<f32>>::NUMBERS)];

/// Objects that are stored by their numbers, and their numbers, that there is to be room for.
#[doc(hidden)]
pub const fn stored_capacities(pools: &[(&str, usize)]) -> [usize; 2] {
    let (mut entries, mut numbers) = (0, 0);
    let mut i = 0;
    while i < STORED.len() {
        let capacity = capacity_of(pools, STORED[i].0);
        entries += capacity;
        numbers += capacity * STORED[i].1;
        i += 1;
    }
    [entries, numbers]
}

/// What the word of a pool is declared with; 0 if it is not.
pub(super) const fn capacity_of(pools: &[(&str, usize)], word: &str) -> usize {
    let mut i = 0;
    while i < pools.len() {
        if is_word(pools[i].0, word) {
            return pools[i].1;
        }
        i += 1;
    }
    0
}

/// `a == b`, in constants.
const fn is_word(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    let mut i = 0;
    while i < a.len() && i < b.len() {
        if a[i] != b[i] {
            return false;
        }
        i += 1;
    }
    a.len() == b.len()
}

/// Ends the compilation if a pool that every scene needs is not declared.
#[doc(hidden)]
pub const fn require_pool(pools: &[(&str, usize)], word: &str) {
    assert!(
        capacity_of(pools, word) > 0,
        "scene_pools! needs room for `materials`: every object has one"
    );
}

/// Objects of all shapes that pools hold, and planes, and bounded objects among them.
const fn objects(pools: &[(&str, usize)]) -> [usize; 3] {
    let (mut all, mut bounded) = (0, 0);
    let mut i = 0;
    while i < SHAPES.len() {
        let capacity = capacity_of(pools, SHAPES[i].0);
        all += capacity;
        if SHAPES[i].3 {
            bounded += capacity;
        }
        i += 1;
    }
    [all, capacity_of(pools, "planes"), bounded]
}

/// The stages that a scene in pools of these names and capacities can need, with a hierarchy of so many objects.
#[doc(hidden)]
pub const fn stages_of_pools(pools: &[(&str, usize)], bvh: usize) -> Stages {
    let mut missing = Stages::NONE;
    let mut i = 0;
    while i <= SHAPES.len() {
        let (word, one, several) = if i < SHAPES.len() {
            (SHAPES[i].0, SHAPES[i].1, SHAPES[i].2)
        } else {
            ("lights", Stages::LIGHT, Stages::SEVERAL_LIGHTS)
        };
        missing = match capacity_of(pools, word) {
            0 => missing.union(one).union(several),
            1 => missing.union(several),
            _ => missing,
        };
        i += 1;
    }
    let [objects, ..] = objects(pools);
    if objects <= ObjectSet::TOLD_APART {
        missing = missing.union(Stages::MANY_OBJECTS);
    }
    let bvh = if bvh == 0 { Stages::NONE } else { Stages::BVH };
    Stages::ALL.without(missing).union(bvh)
}

/// [`stages_of_pools`] without some, by their words.
#[doc(hidden)]
pub const fn stages_of_declaration(pools: &[(&str, usize)], left_out: &[&str]) -> Stages {
    let [_, _, bvh] = accel_capacities(pools, left_out);
    let mut stages = stages_of_pools(pools, bvh);
    let mut i = 0;
    while i < left_out.len() {
        stages = stages.without(stage_of_word(left_out[i]));
        i += 1;
    }
    stages
}

/// The stages that a word behind `without` leaves out.
const fn stage_of_word(word: &str) -> Stages {
    if is_word(word, "reflection") {
        Stages::REFLECTION
    } else if is_word(word, "refraction") {
        Stages::REFRACTION.union(Stages::BENDING)
    } else if is_word(word, "bending") {
        Stages::BENDING
    } else if is_word(word, "specular") {
        Stages::SPECULAR.union(Stages::FRACTIONAL_SHININESS)
    } else if is_word(word, "accel") {
        Stages::NONE
    } else {
        panic!("`without` takes reflection, refraction, bending, specular and accel")
    }
}

/// With fewer bounded objects than this, lists of candidates are kept; with more, a hierarchy.
const LISTED: usize = Bvh::<f32>::FEWEST_OBJECTS;

/// Objects with candidates, planes with grids, and bounded objects in a hierarchy, that there is to be room for.
#[doc(hidden)]
pub const fn accel_capacities(pools: &[(&str, usize)], left_out: &[&str]) -> [usize; 3] {
    let mut i = 0;
    while i < left_out.len() {
        if is_word(left_out[i], "accel") {
            return [0; 3];
        }
        i += 1;
    }
    let [all, planes, bounded] = objects(pools);
    let listed = if all < LISTED { all } else { LISTED };
    let bvh = if bounded < LISTED { 0 } else { bounded };
    [listed, planes, bvh]
}
