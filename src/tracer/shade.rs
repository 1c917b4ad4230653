//! The colour of a hit by itself: ambient, diffuse and specular light with shadows.

use super::{Hit, LightAtHit, Observer, RayKind, Tracer, stage};
use crate::color::Color;
use crate::formula::shading::{alignment, power, reflected};
use crate::light::Light;
use crate::material::Material;
use crate::ray::{Ray, RayEnd};
use crate::real::Real;
use crate::scalar::Scalar;
use crate::stages::Stages;

impl<'a, T: Scalar, const STAGES: u64, const STACK: usize> Tracer<'a, T, STAGES, STACK> {
    /// Ambient light, and of every light that reaches the hit the diffuse share and the highlight
    /// (Phong 1975). Not clamped.
    #[inline(always)]
    pub(super) fn local_color(
        &self,
        ray: &Ray<T>,
        hit: &Hit<'a, T>,
        depth: usize,
        observer: &mut impl Observer<T>,
    ) -> Color<T> {
        let material = hit.material.description();
        let mut color = self.scene.ambient_color(material);
        if !stage(STAGES, Stages::LIGHT) {
            return color;
        }
        if stage(STAGES, Stages::SHADOWS) && hit.candidates.shadowed {
            observer.light(LightAtHit::Enclosed);
            return color;
        }
        for light in self.scene.lights {
            color = self.lit(ray, hit, light, color, depth, observer);
            if !stage(STAGES, Stages::SEVERAL_LIGHTS) {
                break;
            }
        }
        color
    }

    /// A colour, and what a light adds to it.
    #[inline(always)]
    fn lit(
        &self,
        ray: &Ray<T>,
        hit: &Hit<'a, T>,
        light: &Light<T>,
        color: Color<T>,
        depth: usize,
        observer: &mut impl Observer<T>,
    ) -> Color<T> {
        let occluders = match hit.cell {
            Some(cell) => hit.candidates.occluders.intersection(cell.occluders()),
            None => hit.candidates.occluders,
        };
        let to_light = light.position - hit.outside;
        // The sign of N·L, before its length is known: a light behind the surface costs no root.
        let toward = to_light.component_along(hit.normal);
        let distance_squared = to_light.dot(to_light);
        // The distance is 0 only in a light that lies in the hit itself, and underflows only next
        // to it.
        if !(toward.is_positive() && distance_squared.is_positive()) {
            observer.light(LightAtHit::Behind);
            return color;
        }
        let distance = distance_squared.sqrt();
        let inverse = T::ONE.over(distance);
        let direction = to_light * inverse;
        if stage(STAGES, Stages::SHADOWS) {
            let shadow = Ray {
                origin: hit.outside,
                direction,
                leaves: hit.facing,
            };
            let end = RayEnd {
                distance,
                light: Some(light.position),
            };
            observer.ray(RayKind::Shadow, depth, &shadow);
            if self.occluded_observed(&shadow, &end, occluders, observer) {
                observer.light(LightAtHit::Blocked);
                return color;
            }
        }
        let material = hit.material.description();
        let cosine = (Real(toward) * Real(inverse)).0;
        let diffuse = reflected(light.diffuse, cosine, material.diffuse);
        let mut color = color + diffuse;
        let mut specular = None;
        if stage(STAGES, Stages::SPECULAR) && !material.specular.is_black() {
            let alignment = alignment(
                Real(cosine),
                Real(hit.cosine),
                direction.real(),
                ray.direction.real(),
            )
            .0;
            let faint = if self.scene.accel.knows_faint() {
                hit.material.faint_alignment()
            } else {
                0
            };
            if alignment.upper_half() >= faint && alignment.is_positive() {
                let highlight = self.phong_power(alignment, hit.material);
                let light = reflected(light.specular, highlight, material.specular);
                color = color + light;
                specular = Some(light);
            }
        }
        observer.light(LightAtHit::Reaches { diffuse, specular });
        color
    }

    /// `alignment^shininess`; rounding may have taken the alignment beyond 1.
    #[inline(always)]
    fn phong_power(&self, alignment: T, material: &Material<T>) -> T {
        let base = if alignment.is_before(T::ONE) {
            alignment
        } else {
            T::ONE
        };
        let whole = material.whole_shininess();
        if stage(STAGES, Stages::FRACTIONAL_SHININESS) && whole == Material::<T>::FRACTIONAL {
            base.powf(material.description().shininess)
        } else {
            power(Real(base), whole).0
        }
    }
}
