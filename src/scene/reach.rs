//! Which objects a ray that leaves a surface can meet: the data; how it is found is told in
//! `visibility`.

/// A set of objects of a scene: one bit for each of the first 32 of a shape. Objects beyond those are
/// in every set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ObjectSet {
    /// Spheres, by their index in the scene.
    pub spheres: u32,
    /// Planes.
    pub planes: u32,
    /// Triangles.
    pub triangles: u32,
}

impl ObjectSet {
    /// Number of objects of a shape that a set tells apart.
    pub const BITS: usize = u32::BITS as usize;

    /// Every object.
    pub const ALL: Self = Self {
        spheres: u32::MAX,
        planes: u32::MAX,
        triangles: u32::MAX,
    };

    /// No object but those that are in every set.
    pub const NONE: Self = Self {
        spheres: 0,
        planes: 0,
        triangles: 0,
    };
}

/// What rays can meet that leave one side of an object.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reach {
    /// Objects that a mirrored or refracted ray can meet first.
    pub near: ObjectSet,
    /// Objects that may stand between this side and a light.
    pub occluders: ObjectSet,
    /// No light reaches this side.
    pub shadowed: bool,
}

impl Reach {
    /// Anything may be met.
    pub const ALL: Self = Self {
        near: ObjectSet::ALL,
        occluders: ObjectSet::ALL,
        shadowed: false,
    };
}
