//! The stages of the tracer: what a scene does not need is not compiled.

use core::fmt;

/// A set of stages of the tracer. A stage that is left out is not compiled.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Stages(u64);

macro_rules! stages {
    ($($(#[$doc:meta])* $name:ident = $bit:literal, $word:literal;)*) => {
        impl Stages {
            /// Ends the compilation with the name of a needed stage that is not in `stages`: for
            /// [`tracer_for!`](crate::tracer_for), in constants alone.
            #[doc(hidden)]
            pub const fn require(self, stages: Self) {
                $(assert!(
                    !self.contains(Self::$name) || stages.contains(Self::$name),
                    concat!("the scene needs the stage `", $word, "`, which is left out")
                );)*
            }

            $($(#[$doc])* pub const $name: Self = Self(1 << $bit);)*

            /// Every stage that a scene can need that has no bounding-volume hierarchy: for scenes that are only known on the device.
            pub const ALL: Self = Self(0 $(| 1 << $bit)*);

            const NAMES: &'static [(Self, &'static str)] =
                &[$((Self::$name, $word),)* (Self::BVH, "bvh"), (Self::CUTOFF, "cutoff")];
        }
    };
}

stages! {
    /// Spheres.
    SPHERES = 0, "spheres";
    /// Planes.
    PLANES = 1, "planes";
    /// Triangles.
    TRIANGLES = 2, "triangles";
    /// Diffuse light.
    LIGHT = 3, "light";
    /// Shadow rays.
    SHADOWS = 4, "shadows";
    /// Highlights.
    SPECULAR = 5, "specular";
    /// Highlights whose shininess repeated squaring cannot raise.
    FRACTIONAL_SHININESS = 6, "fractional shininess";
    /// Mirror rays.
    REFLECTION = 7, "reflection";
    /// Refracted rays.
    REFRACTION = 8, "refraction";
    /// Refracted rays that an index other than 1 bends.
    BENDING = 9, "bending";
    /// The sky gradient.
    SKY = 10, "sky";
    /// A background of one colour.
    PLAIN_BACKGROUND = 11, "plain background";
    /// More objects than an [`ObjectSet`](crate::accel::ObjectSet) tells apart.
    MANY_OBJECTS = 12, "many objects";
    /// More than one sphere.
    SEVERAL_SPHERES = 13, "several spheres";
    /// More than one plane.
    SEVERAL_PLANES = 14, "several planes";
    /// More than one triangle.
    SEVERAL_TRIANGLES = 15, "several triangles";
    /// More than one light.
    SEVERAL_LIGHTS = 16, "several lights";
    /// Discs.
    DISCS = 17, "discs";
    /// Lights that are near a surface, or not known not to be.
    LIGHT_ON_SURFACE = 18, "light on surface";
}

impl Stages {
    /// Secondary rays that hardly show are left out: [`Tracer::with_cutoff`](crate::Tracer::with_cutoff).
    /// No scene needs it, so it is not in [`Stages::ALL`].
    pub const CUTOFF: Self = Self(1 << 63);

    /// The bounding-volume hierarchy of a large scene: [`Tracer::with_bvh`](crate::Tracer::with_bvh). Pools have one only if they
    /// have room for it, so it is not in [`Stages::ALL`].
    pub const BVH: Self = Self(1 << 62);

    /// Any of the shapes that are stored by their numbers.
    pub(crate) const STORED_SHAPES: Self = Self::DISCS;

    /// No stage.
    pub const NONE: Self = Self(0);

    /// The set as a number, for const generics.
    pub const fn bits(self) -> u64 {
        self.0
    }

    /// The set of a number; bits that name no stage are dropped.
    pub const fn from_bits(bits: u64) -> Self {
        Self(bits & (Self::ALL.0 | Self::BVH.0 | Self::CUTOFF.0))
    }

    /// Both sets together.
    #[must_use]
    pub const fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// What is in this set but not in the other.
    #[must_use]
    pub const fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// Whether all of the other set is in this one.
    pub const fn contains(self, other: Self) -> bool {
        other.without(self).is_empty()
    }

    /// Whether the set is empty.
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// The stages in the set, by name.
    pub fn names(self) -> impl Iterator<Item = &'static str> {
        Self::NAMES
            .iter()
            .filter(move |(stage, _)| self.contains(*stage))
            .map(|(_, name)| *name)
    }

    pub(crate) const fn with_if(self, stage: Self, condition: bool) -> Self {
        if condition { self.union(stage) } else { self }
    }
}

impl fmt::Display for Stages {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut separator = "";
        for name in self.names() {
            f.write_str(separator)?;
            f.write_str(name)?;
            separator = ", ";
        }
        Ok(())
    }
}

impl fmt::Debug for Stages {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Stages({self})")
    }
}
