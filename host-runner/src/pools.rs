//! The pools scenes are loaded into: the device's, with room for large scenes.

use std::sync::{Mutex, MutexGuard, PoisonError};

use scanray::{Scalar, ScenePools, parser::FromDecimal};

/// Pools with the host's capacities.
///
/// They are statics, never on the stack. Empty pools are all zeros, so that they take no space in the
/// executable, and no memory before a scene fills them.
pub type HostPools<T> = ScenePools<T, 131_072, 1024, 131_072, 262_144, 16, 48, 262_144>;

static F32: Mutex<HostPools<f32>> = Mutex::new(HostPools::new());
static F64: Mutex<HostPools<f64>> = Mutex::new(HostPools::new());

/// A scalar that the host has pools for.
pub trait HostScalar: Scalar + FromDecimal {
    /// The scalar's pools. Whoever holds them keeps all others waiting.
    fn pools() -> MutexGuard<'static, HostPools<Self>>;
}

impl HostScalar for f32 {
    fn pools() -> MutexGuard<'static, HostPools<Self>> {
        F32.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl HostScalar for f64 {
    fn pools() -> MutexGuard<'static, HostPools<Self>> {
        F64.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
