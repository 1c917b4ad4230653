//! A scene seen from all around: the camera circles a vertical axis, looking the same way past it.
//!
//! The camera of a scene always looks along +z, so it is the scene that turns, with everything in it: a
//! plane whose normal is not vertical, and the light, which stays where it is in the scene. Seen from above,
//! with +x to the right and +z up, the camera moves counterclockwise: what is in front moves to the left. Step
//! 0 is the scene as it is.
//!
//! All is computed in `f64`, with software functions, so that every machine gets the same numbers.

mod axis;
mod path;

use std::f64::consts::FRAC_PI_2;

use scanray::shape::{Shape, Transform};
use scanray::{
    Background, Camera, Light, MaterialDescription, Resolution, Scalar, Scene, SceneError, Vec3,
    pools::PoolsMut,
};

pub(crate) use axis::default_axis;
pub(crate) use path::{Crossing, crossings};

/// A vertical axis: all points with this x and z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Axis {
    pub(crate) x: f64,
    pub(crate) z: f64,
}

/// A scene, and how it turns.
#[derive(Clone, Debug)]
pub(crate) struct Turntable<T> {
    steps: u16,
    axis: Axis,
    camera: Camera<T>,
    resolution: Resolution,
    ambient: T,
    background: Background<T>,
    lights: Vec<Light<T>>,
    objects: Vec<(Shape<T>, MaterialDescription<T>)>,
}

impl<T: Scalar> Turntable<T> {
    /// A turntable of as many steps, at least 1, about an axis.
    pub(crate) fn new(scene: &Scene<'_, T>, steps: u16, axis: Axis) -> Self {
        Self {
            steps,
            axis,
            camera: scene.camera(),
            resolution: scene.resolution(),
            ambient: scene.ambient(),
            background: scene.background(),
            lights: scene.lights().to_vec(),
            objects: scene
                .objects()
                .map(|object| (object.shape(), scene.material(object.info())))
                .collect(),
        }
    }

    /// Replaces the scene in the pools, which held it before, by the one of a step.
    ///
    /// # Errors
    ///
    /// [`SceneError::Shape`] where turning takes a number out of the range of `T`.
    pub(crate) fn turn(&self, pools: &mut PoolsMut<'_, T>, step: u16) -> Result<(), SceneError> {
        let turn = Turn::of(self.axis, step.into(), self.steps.into());
        pools.clear();
        pools.set_camera(self.camera);
        pools.set_resolution(self.resolution);
        pools.set_ambient(self.ambient);
        pools.set_background(self.background);
        for light in &self.lights {
            pools.add_light(Light {
                position: turn.point(light.position),
                ..*light
            })?;
        }
        for (shape, material) in &self.objects {
            pools.add(shape.transformed(&turn), *material)?;
        }
        pools.prepare();
        Ok(())
    }
}

/// By how much, and about which axis.
#[derive(Clone, Copy, Debug)]
struct Turn {
    axis: Axis,
    sin: f64,
    cos: f64,
}

impl Turn {
    fn of(axis: Axis, step: u32, steps: u32) -> Self {
        let quarters = 4 * step;
        // Whole quarters are exact, so that four of them are back at the beginning.
        let rest = f64::from(quarters % steps) / f64::from(steps) * FRAC_PI_2;
        let (sin, cos) = libm::sincos(rest);
        let (sin, cos) = match quarters / steps % 4 {
            0 => (sin, cos),
            1 => (cos, -sin),
            2 => (-sin, -cos),
            _ => (-cos, sin),
        };
        Self { axis, sin, cos }
    }

    /// Turns a direction in x and z.
    fn direction(&self, x: f64, z: f64) -> (f64, f64) {
        (x * self.cos + z * self.sin, z * self.cos - x * self.sin)
    }
}

impl<T: Scalar> Transform<T> for Turn {
    fn point(&self, point: Vec3<T>) -> Vec3<T> {
        let Axis { x, z } = self.axis;
        let (right, ahead) = self.direction(point.x.to_f64() - x, point.z.to_f64() - z);
        Vec3::new(T::from_f64(right + x), point.y, T::from_f64(ahead + z))
    }

    fn normal(&self, normal: Vec3<T>) -> Vec3<T> {
        let (right, ahead) = self.direction(normal.x.to_f64(), normal.z.to_f64());
        Vec3::new(T::from_f64(right), normal.y, T::from_f64(ahead))
    }

    fn length(&self, length: T) -> T {
        length
    }

    fn plane(&self, normal: Vec3<T>, distance: T) -> (Vec3<T>, T) {
        let Axis { x, z } = self.axis;
        let (right, ahead) = self.direction(normal.x.to_f64(), normal.z.to_f64());
        // The axis keeps its distance from the plane.
        let before = normal.x.to_f64() * x + normal.z.to_f64() * z;
        let after = right * x + ahead * z;
        (
            self.normal(normal),
            T::from_f64(before - after + distance.to_f64()),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AXIS: Axis = Axis { x: 1.0, z: 3.0 };

    #[test]
    fn quarters_are_exact_and_go_round() {
        let point = Vec3::new(1.5_f32, 7.0, 1.0);
        let at = |step| Turn::of(AXIS, step, 4).point(point);
        assert_eq!(at(0), point);
        // What is in front goes to the left.
        assert_eq!(at(1), Vec3::new(-1.0, 7.0, 2.5));
        assert_eq!(at(2), Vec3::new(0.5, 7.0, 5.0));
        assert_eq!(at(3), Vec3::new(3.0, 7.0, 3.5));
        assert_eq!(at(4), point);
    }

    #[test]
    fn planes_turn_with_their_points() {
        let normal = Vec3::new(0.6_f64, 0.48, 0.64);
        for step in 0..12 {
            let turn = Turn::of(AXIS, step, 12);
            let (turned, distance) = turn.plane(normal, -2.0);
            assert!((turned.dot(turned) - 1.0).abs() < 1e-15);
            // Three points of the plane.
            for (x, y) in [(0.0, 0.0), (5.0, -3.0), (-2.0, 40.0)] {
                let z = (2.0 - normal.x * x - normal.y * y) / normal.z;
                let point = turn.point(Vec3::new(x, y, z));
                assert!((turned.dot(point) + distance).abs() < 1e-13, "{step}");
            }
        }
    }
}
