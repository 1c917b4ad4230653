//! Which stages of the tracer a scene needs.

use core::fmt;

use super::Scene;

/// A set of stages of the tracer. A stage that is left out is not compiled.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Needs(u32);

macro_rules! stages {
    ($($(#[$doc:meta])* $name:ident = $bit:literal, $word:literal;)*) => {
        impl Needs {
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

            /// Every stage that a scene can need that has no tree: for scenes that are only known on the device.
            pub const ALL: Self = Self(0 $(| 1 << $bit)*);

            const NAMES: &'static [(Self, &'static str)] =
                &[$((Self::$name, $word),)* (Self::TREE, "tree"), (Self::CUTOFF, "cutoff")];
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
    /// More objects than an [`ObjectSet`](super::ObjectSet) tells apart.
    MANY_OBJECTS = 12, "many objects";
    /// More than one sphere.
    SEVERAL_SPHERES = 13, "several spheres";
    /// More than one plane.
    SEVERAL_PLANES = 14, "several planes";
    /// More than one triangle.
    SEVERAL_TRIANGLES = 15, "several triangles";
    /// More than one light.
    SEVERAL_LIGHTS = 16, "several lights";
}

impl Needs {
    /// Secondary rays that hardly show are left out: [`Tracer::with_cutoff`](crate::Tracer::with_cutoff).
    /// No scene needs it, so it is not in [`Needs::ALL`].
    pub const CUTOFF: Self = Self(1 << 31);

    /// The tree of a large scene: [`Tracer::with_tree`](crate::Tracer::with_tree). Pools have one only if they
    /// have room for it, so it is not in [`Needs::ALL`].
    pub const TREE: Self = Self(1 << 30);

    /// No stage.
    pub const NONE: Self = Self(0);

    /// The set as a number, for const generics.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// The set of a number; bits that name no stage are dropped.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits & (Self::ALL.0 | Self::TREE.0 | Self::CUTOFF.0))
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

    const fn with_if(self, stage: Self, condition: bool) -> Self {
        if condition { self.union(stage) } else { self }
    }
}

impl fmt::Display for Needs {
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

impl fmt::Debug for Needs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Needs({self})")
    }
}

// Trait methods are not const, so this is written out once per scalar.
macro_rules! needs_of_scene {
    ($scalar:ty) => {
        impl Scene<'_, $scalar> {
            /// The stages this scene needs; found at compile time for a `static` scene.
            pub const fn needs(&self) -> Needs {
                let objects = self.spheres.len() + self.planes.len() + self.triangles.len();
                let mut needs = Needs::NONE
                    .with_if(Needs::SPHERES, !self.spheres.is_empty())
                    .with_if(Needs::PLANES, !self.planes.is_empty())
                    .with_if(Needs::TRIANGLES, !self.triangles.is_empty())
                    .with_if(Needs::SEVERAL_SPHERES, self.spheres.len() > 1)
                    .with_if(Needs::SEVERAL_PLANES, self.planes.len() > 1)
                    .with_if(Needs::SEVERAL_TRIANGLES, self.triangles.len() > 1)
                    .with_if(Needs::TREE, self.tree.is_some())
                    .with_if(Needs::MANY_OBJECTS, objects > super::ObjectSet::TOLD_APART)
                    .with_if(Needs::SKY, self.background.sky)
                    .with_if(Needs::PLAIN_BACKGROUND, !self.background.sky);
                let mut bright = false;
                let mut highlights = false;
                let mut i = 0;
                while i < self.lights.len() {
                    let (diffuse, specular) = (self.lights[i].diffuse, self.lights[i].specular);
                    bright |= diffuse.r > 0.0 || diffuse.g > 0.0 || diffuse.b > 0.0;
                    highlights |= specular.r > 0.0 || specular.g > 0.0 || specular.b > 0.0;
                    i += 1;
                }
                let mut casts_shadow = false;
                let mut shines = false;
                let mut i = 0;
                while i < self.materials.len() {
                    let material = &self.materials[i];
                    let d = material.description();
                    casts_shadow |= d.index_of_refraction != 1.0;
                    if highlights
                        && (d.specular.r > 0.0 || d.specular.g > 0.0 || d.specular.b > 0.0)
                    {
                        shines = true;
                        needs = needs.with_if(
                            Needs::FRACTIONAL_SHININESS,
                            material.whole_shininess()
                                == crate::material::Material::<$scalar>::FRACTIONAL,
                        );
                    }
                    needs = needs
                        .with_if(Needs::REFLECTION, d.reflection > 0.0)
                        .with_if(Needs::REFRACTION, d.refraction > 0.0)
                        .with_if(
                            Needs::BENDING,
                            d.refraction > 0.0 && d.index_of_refraction != 1.0,
                        );
                    i += 1;
                }
                let lit = (bright || shines) && objects > 0;
                needs
                    .with_if(Needs::LIGHT, lit)
                    .with_if(Needs::SPECULAR, shines && lit)
                    .with_if(Needs::SEVERAL_LIGHTS, lit && self.lights.len() > 1)
                    // A flat object alone has nothing between its lit side and the light; a sphere has
                    // itself, where it is seen from inside.
                    .with_if(
                        Needs::SHADOWS,
                        lit && casts_shadow && (objects > 1 || !self.spheres.is_empty()),
                    )
            }
        }
    };
}

needs_of_scene!(f32);
needs_of_scene!(f64);
