//! A scene as the report needs it: in both number types, with materials that a knob may have changed.

use std::sync::MutexGuard;

use scanray::{Material, Scalar, Scene};

use super::settings::PowerRoutine;
use scanray_host::failure::Failure;
use scanray_host::pools::{HostPools, HostScalar};
use scanray_host::scene_file::SceneSource;

/// A scene in both number types.
pub(crate) struct BothScalars {
    single: Loaded<f32>,
    double: Loaded<f64>,
}

/// A scene in the host's pools.
struct Loaded<T: 'static> {
    pools: MutexGuard<'static, HostPools<T>>,
    /// Its materials, their highlights computed by the polynomial alone.
    polynomial: Vec<Material<T>>,
}

impl BothScalars {
    /// Loads a scene, and prints the parser's warnings.
    ///
    /// # Errors
    ///
    /// [`Failure`].
    pub(crate) fn load(source: &SceneSource) -> Result<Self, Failure> {
        Self::load_text(source, &source.read()?)
    }

    /// The same for a text that was read from there.
    ///
    /// # Errors
    ///
    /// [`Failure`].
    pub(crate) fn load_text(source: &SceneSource, text: &[u8]) -> Result<Self, Failure> {
        let mut single = f32::pools();
        source.load_text(text, &mut single)?;
        let mut double = f64::pools();
        // Whatever was to be said of the text has been said.
        double
            .parse(text)
            .map_err(|error| Failure::Scene(error.to_string()))?;
        Ok(Self {
            single: Loaded::new(single),
            double: Loaded::new(double),
        })
    }

    /// The scene in single precision.
    pub(crate) fn single(&self, power: PowerRoutine) -> Scene<'_, f32> {
        self.single.scene(power)
    }

    /// The scene in double precision.
    pub(crate) fn double(&self, power: PowerRoutine) -> Scene<'_, f64> {
        self.double.scene(power)
    }
}

impl<T: HostScalar> Loaded<T> {
    fn new(pools: MutexGuard<'static, HostPools<T>>) -> Self {
        let polynomial = pools
            .as_scene()
            .materials()
            .iter()
            .map(polynomial)
            .collect();
        Self { pools, polynomial }
    }

    fn scene(&self, power: PowerRoutine) -> Scene<'_, T> {
        let scene = self.pools.as_scene();
        match power {
            PowerRoutine::Squaring => scene,
            // A power of another kind changes nothing that is derived.
            PowerRoutine::Polynomial => scene
                .with_materials(&self.polynomial)
                .with_accel(*scene.accel()),
        }
    }
}

/// The same material, whose shininess is not taken for a whole number.
fn polynomial<T: Scalar>(material: &Material<T>) -> Material<T> {
    Material::from_parts(
        *material.description(),
        material.inverse_index(),
        material.bend(),
        Material::<T>::FRACTIONAL,
        material.faint_alignment(),
    )
}
