//! The contribution cut-off: secondary rays that hardly show are not cast.
//!
//! A ray's *throughput* is what its colour is multiplied with on its way to the pixel: the product of
//! the coefficients along its path. Colours lie in 0…1, and neither adding nor clamping makes a
//! difference larger, so that a ray that is not cast darkens each channel of the pixel by its throughput
//! at most, and brightens none. What several such rays take away adds up: with one threshold for each ray
//! the sum depends on their number, which grows with 2 to the depth. So a pixel has an allowance instead:
//! in the order of the depth-first walk, a ray whose throughput still fits into it is not cast and uses
//! it up. The pixel then loses less than its allowance, whatever the scene and the depth.

use super::{ALL_AND_BVH, Tracer, stage};
use crate::scalar::Scalar;
use crate::stages::Stages;

/// Every stage and the cut-off.
const ALL_AND_CUTOFF: u64 = Stages::ALL.union(Stages::CUTOFF).bits();

/// The same and the hierarchy.
const BVH_AND_CUTOFF: u64 = Stages::from_bits(ALL_AND_BVH).union(Stages::CUTOFF).bits();

impl<'a, T: Scalar, const STACK: usize> Tracer<'a, T, { Stages::ALL.bits() }, STACK> {
    /// The same tracer that does not cast the secondary rays that hardly show: no channel of a pixel
    /// becomes darker by `cutoff` or more, and none brighter, for any scene and depth (up to rounding, of
    /// about 1e-6). 0 casts them all, and so does what is no number.
    ///
    /// [`DisplayColor::LEVEL`](crate::render::DisplayColor::LEVEL) ties it to the display: no channel of a pixel is
    /// then more than one level off.
    ///
    /// The cut-off is a stage of the tracer that costs nothing where it is not asked for. For a `static`
    /// scene `tracer_for!(SCENE, cutoff = …)` compiles it.
    ///
    /// ```
    /// use embedded_graphics::pixelcolor::Rgb565;
    /// use scanray::{render::DisplayColor, ScenePools, Stages, Tracer};
    ///
    /// let pools: ScenePools = ScenePools::new();
    /// let tracer = Tracer::new(pools.as_scene()).with_cutoff(Rgb565::LEVEL);
    /// assert_eq!(tracer.cutoff(), 1.0 / 64.0);
    /// assert!(tracer.stages().contains(Stages::CUTOFF));
    /// ```
    pub const fn with_cutoff(self, cutoff: T) -> Tracer<'a, T, ALL_AND_CUTOFF, STACK> {
        Tracer {
            scene: self.scene,
            max_depth: self.max_depth,
            cutoff,
        }
    }
}

impl<'a, T: Scalar, const STACK: usize> Tracer<'a, T, ALL_AND_BVH, STACK> {
    /// The cut-off of a tracer without the hierarchy, for one with it.
    pub const fn with_cutoff(self, cutoff: T) -> Tracer<'a, T, BVH_AND_CUTOFF, STACK> {
        Tracer {
            scene: self.scene,
            max_depth: self.max_depth,
            cutoff,
        }
    }
}

impl<'a, T: Scalar, const STAGES: u64, const STACK: usize> Tracer<'a, T, STAGES, STACK> {
    /// The same tracer with another cut-off, for one whose stages have it: `tracer_for!(SCENE, cutoff = …)`,
    /// [`Tracer::with_cutoff`] and what they are specialised to. Others are an error of the compiler.
    pub const fn with_compiled_cutoff(mut self, cutoff: T) -> Self {
        const {
            assert!(
                stage(STAGES, Stages::CUTOFF),
                "the stage `cutoff` is left out: take Tracer::with_cutoff or tracer_for!(SCENE, cutoff = …)"
            )
        };
        self.cutoff = cutoff;
        self
    }

    /// What the secondary rays that are not cast would add to a channel of a pixel is less than this; 0
    /// without a cut-off.
    pub const fn cutoff(&self) -> T {
        self.cutoff
    }

    /// Whether a secondary ray is cast from a hit; otherwise its throughput is taken from the pixel's
    /// allowance.
    #[inline(always)]
    pub(super) fn shows(&self, throughput: T, coefficient: T, allowance: &mut T) -> bool {
        if !stage(STAGES, Stages::CUTOFF) || coefficient == T::ZERO {
            return true;
        }
        let throughput = throughput * coefficient;
        let is_cut = throughput < *allowance;
        if is_cut {
            *allowance -= throughput;
        }
        !is_cut
    }
}
