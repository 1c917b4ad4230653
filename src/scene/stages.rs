//! Which stages a scene needs.

use super::Scene;
use crate::accel::ObjectSet;
use crate::stages::Stages;

// Trait methods are not const, so this is written out once per scalar.
macro_rules! stages_of_scene {
    ($scalar:ty) => {
        impl Scene<'_, $scalar> {
            /// The stages this scene needs; found at compile time for a `static` scene.
            pub const fn stages(&self) -> Stages {
                let objects = self.geometry.count();
                let mut needs = self
                    .geometry
                    .stages()
                    .with_if(Stages::BVH, self.accel.bvh.is_some())
                    .with_if(Stages::MANY_OBJECTS, objects > ObjectSet::TOLD_APART)
                    .with_if(Stages::SKY, self.background.sky)
                    .with_if(Stages::PLAIN_BACKGROUND, !self.background.sky);
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
                            Stages::FRACTIONAL_SHININESS,
                            material.whole_shininess()
                                == crate::material::Material::<$scalar>::FRACTIONAL,
                        );
                    }
                    needs = needs
                        .with_if(Stages::REFLECTION, d.reflection > 0.0)
                        .with_if(Stages::REFRACTION, d.refraction > 0.0)
                        .with_if(
                            Stages::BENDING,
                            d.refraction > 0.0 && d.index_of_refraction != 1.0,
                        );
                    i += 1;
                }
                let lit = (bright || shines) && objects > 0;
                let shadows =
                    lit && casts_shadow && (objects > 1 || !self.geometry.spheres.is_empty());
                needs
                    .with_if(Stages::LIGHT, lit)
                    .with_if(Stages::SPECULAR, shines && lit)
                    .with_if(Stages::SEVERAL_LIGHTS, lit && self.lights.len() > 1)
                    // A flat object alone has nothing between its lit side and the light; a sphere has
                    // itself, where it is seen from inside.
                    .with_if(Stages::SHADOWS, shadows)
                    .with_if(
                        Stages::LIGHT_ON_SURFACE,
                        shadows && !self.accel.lights_are_clear,
                    )
            }
        }
    };
}

stages_of_scene!(f32);
stages_of_scene!(f64);
