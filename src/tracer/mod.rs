//! The tracer: from a ray to a linear colour.

mod bvh;
mod cutoff;
mod intersect;
mod observer;
mod secondary_rays;
mod shade;
mod stack;

pub use intersect::Nearest;
pub use observer::{Intersection, LightAtHit, Observer, RayCount, RayKind, TestKind, WorkCount};

use core::fmt;

use crate::accel::{Candidates, Cell, ObjectSet, visible_in_row};
use crate::background::Background;
use crate::camera::{Resolution, Subpixel};
use crate::color::Color;
use crate::material::Material;
use crate::ray::{Ray, Side};
use crate::scalar::Scalar;
use crate::scene::Scene;
use crate::shape::ObjectInfo;
use crate::stages::Stages;
use crate::vec3::Vec3;
use stack::{Level, Pending, Refracted, Stack, Throughputs};

/// How many secondary rays may follow one another unless the tracer is told otherwise.
pub const DEFAULT_MAX_DEPTH: usize = 5;

/// Every stage of a small scene, and the hierarchy.
const ALL_AND_BVH: u64 = Stages::ALL.union(Stages::BVH).bits();

/// Whether a stage is compiled.
#[inline(always)]
const fn stage(needs: u64, stage: Stages) -> bool {
    Stages::from_bits(needs).contains(stage)
}

/// Whether any stage of several is compiled.
#[inline(always)]
const fn any_stage(needs: u64, stages: Stages) -> bool {
    stages.without(Stages::from_bits(needs)).bits() != stages.bits()
}

/// Traces rays through a scene.
///
/// `STAGES` are the stages that are compiled, `STACK` is the number of frames that stand for the
/// recursion. Neither is written by hand: [`Tracer::new`] compiles all stages that a small scene may need for
/// [`DEFAULT_MAX_DEPTH`], [`tracer_for!`](crate::tracer_for) those that a `static` scene needs, and
/// methods change the rest. For pools with room for a hierarchy there is [`Tracer::with_bvh`].
///
/// ```
/// use scanray::{ScenePools, Tracer};
///
/// let mut pools: ScenePools = ScenePools::new();
/// # #[cfg(feature = "parser")]
/// pools.parse(include_bytes!("../../scenes/default.txt"))?;
/// let tracer = Tracer::new(pools.as_scene());
/// let deeper = tracer.with_stack::<16>().with_max_depth(16)?;
/// assert_eq!(deeper.max_depth(), 16);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Tracer<
    'a,
    T = f32,
    const STAGES: u64 = { Stages::ALL.bits() },
    const STACK: usize = DEFAULT_MAX_DEPTH,
> {
    /// Its resolution is that of the picture.
    scene: Scene<'a, T>,
    max_depth: usize,
    /// Of no effect without [`Stages::CUTOFF`].
    cutoff: T,
}

/// `max_depth` is larger than the stack the tracer was compiled for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DepthError {
    /// What was asked for.
    pub max_depth: usize,
    /// What there are frames for.
    pub stack: usize,
}

impl fmt::Display for DepthError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "a maximum depth of {} needs more than the {} stack frames compiled in (Tracer::with_stack)",
            self.max_depth, self.stack
        )
    }
}

impl core::error::Error for DepthError {}

/// A scene needs stages that the tracer was compiled without.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MissingStages(pub Stages);

impl fmt::Display for MissingStages {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "the scene needs stages that are not compiled in: {}",
            self.0
        )
    }
}

impl core::error::Error for MissingStages {}

/// An intersection of a ray with a surface, ready for shading.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hit<'a, T> {
    /// The side the ray comes from.
    facing: Side,
    /// What rays can hit that leave that side.
    candidates: &'a Candidates,
    /// The cell of the plane's grid, if it lies in one.
    cell: Option<Cell<'a>>,
    material: &'a Material<T>,
    /// Unit normal on the side the ray comes from.
    normal: Vec3<T>,
    /// `−normal·direction`, at least 0.
    cosine: T,
    /// The geometric normal faces the ray.
    entering: bool,
    /// Where rays start that stay on the side the ray comes from.
    outside: Vec3<T>,
    /// Where rays start that pass the surface.
    inside: Vec3<T>,
}

/// What the pixels of a row have in common: a caller that draws row by row computes it once.
#[derive(Clone, Copy, Debug)]
pub struct Scanline<T = f32> {
    image_plane_y: T,
    visible: ObjectSet,
}

impl<T: Scalar> Scanline<T> {
    /// The objects that primary rays of the row can hit.
    pub fn visible(&self) -> ObjectSet {
        self.visible
    }

    /// `y` of its primary rays before normalisation.
    pub fn image_plane_y(&self) -> T {
        self.image_plane_y
    }
}

impl<'a, T: Scalar> Tracer<'a, T> {
    /// A tracer with all stages but the hierarchy, [`DEFAULT_MAX_DEPTH`] and the scene's own resolution.
    pub const fn new(scene: Scene<'a, T>) -> Self {
        Self::with_stages(scene)
    }
}

impl<'a, T: Scalar, const STACK: usize> Tracer<'a, T, { Stages::ALL.bits() }, STACK> {
    /// The same tracer, to draw large scenes the faster way: by the hierarchy that the scene has if its pools
    /// have room for one ([`ScenePools`](crate::ScenePools)). Without this every ray is tested against
    /// every object of such a scene, with the same bits; other scenes are drawn as before.
    ///
    /// A [cut-off](Tracer::with_cutoff) is asked for after the hierarchy.
    pub const fn with_bvh(self) -> Tracer<'a, T, ALL_AND_BVH, STACK> {
        Tracer {
            scene: self.scene,
            max_depth: self.max_depth,
            cutoff: self.cutoff,
        }
    }
}

impl<'a, T: Scalar, const STAGES: u64, const STACK: usize> Tracer<'a, T, STAGES, STACK> {
    /// Bytes of each of the `STACK` frames, with room for the refracted ray of each, which are on the call
    /// stack while a ray is traced.
    pub const FRAME_BYTES: usize = size_of::<Level<T>>() + size_of::<Refracted<T>>();

    /// Stages and stack as the type says, unchecked: stages the scene needs beyond `STAGES` are simply
    /// not drawn.
    #[doc(hidden)]
    pub const fn with_stages(scene: Scene<'a, T>) -> Self {
        Self {
            scene,
            max_depth: if STACK < DEFAULT_MAX_DEPTH {
                STACK
            } else {
                DEFAULT_MAX_DEPTH
            },
            cutoff: T::ZERO,
        }
    }

    /// The same tracer with `FRAMES` frames; the maximum depth shrinks with them if it must.
    pub const fn with_stack<const FRAMES: usize>(self) -> Tracer<'a, T, STAGES, FRAMES> {
        Tracer {
            scene: self.scene,
            max_depth: if self.max_depth < FRAMES {
                self.max_depth
            } else {
                FRAMES
            },
            cutoff: self.cutoff,
        }
    }

    /// The same tracer with another maximum depth: 0 casts primary rays alone.
    ///
    /// # Errors
    ///
    /// [`DepthError`] when the stack has fewer frames.
    pub const fn with_max_depth(mut self, max_depth: usize) -> Result<Self, DepthError> {
        if max_depth > STACK {
            return Err(DepthError {
                max_depth,
                stack: STACK,
            });
        }
        self.max_depth = max_depth;
        Ok(self)
    }

    /// The same tracer with another size of the picture; what is seen keeps its height.
    pub const fn with_resolution(mut self, resolution: Resolution) -> Self {
        self.scene.resolution = resolution;
        self
    }

    /// The scene.
    pub const fn scene(&self) -> &Scene<'a, T> {
        &self.scene
    }

    /// Size of the picture.
    #[inline(always)]
    pub const fn resolution(&self) -> Resolution {
        self.scene.resolution
    }

    /// How many secondary rays may follow one another.
    pub const fn max_depth(&self) -> usize {
        self.max_depth
    }

    /// The stages that are compiled.
    pub const fn stages(&self) -> Stages {
        Stages::from_bits(STAGES)
    }

    /// No pixel casts more rays than this: a full binary tree of secondary rays, and from each hit one
    /// shadow ray a light.
    pub fn max_rays_per_pixel(&self) -> u64 {
        let hits = (2_u64 << self.max_depth.min(40)) - 1;
        hits.saturating_mul(1 + self.scene.lights.len() as u64)
    }

    #[inline(always)]
    fn material(&self, info: ObjectInfo) -> Option<&'a Material<T>> {
        self.scene.materials.get(info.material as usize)
    }

    /// The linear colour that a ray from outside the scene sees.
    pub fn radiance(&self, ray: Ray<T>) -> Color<T> {
        self.radiance_observed(ray, ObjectSet::ALL, &mut ())
    }

    /// [`Tracer::radiance`] of a ray that hits one of the candidates first if it hits anything, watched.
    ///
    /// Depth first over the tree of reflected and refracted rays (Whitted 1980), so that a hit's colour
    /// is clamped as soon as its secondary rays are known, as the recursive form would. The stack holds
    /// one frame a level, and there is no recursion.
    #[inline(always)]
    pub fn radiance_observed(
        &self,
        ray: Ray<T>,
        candidates: ObjectSet,
        observer: &mut impl Observer<T>,
    ) -> Color<T> {
        let mut stack = Stack::<T, STACK>::new();
        let mut pending = Pending::<T, STACK>::new();
        let mut ray = ray;
        let mut candidates = candidates;
        let mut kind = RayKind::Primary;
        let mut throughput = T::ONE;
        let mut allowance = self.cutoff;
        let mut throughputs = Throughputs::<T, STACK>::new();
        loop {
            observer.ray(kind, stack.len(), &ray);
            // What is known of the colour of the ray under way, whether that is a sum still to be clamped, and
            // whether a refracted ray of the same hit waits.
            let mut color;
            let (mut is_sum, mut refracts) = (false, false);
            match self.hit(&ray, candidates, observer) {
                None => color = self.background(ray.direction),
                Some(hit) => {
                    let mut weight = T::ZERO;
                    if stack.len() < self.max_depth {
                        let material = hit.material.description();
                        let mut shows = |weight| self.shows(throughput, weight, &mut allowance);
                        if stage(STAGES, Stages::REFLECTION) && shows(material.reflection) {
                            weight = material.reflection;
                        }
                        // The mirror ray is cast first, and the refracted one kept for later.
                        if stage(STAGES, Stages::REFRACTION)
                            && material.refraction.is_positive()
                            && shows(material.refraction)
                            && let Some(refracted) = self.refracted(&ray, &hit)
                        {
                            // There is room for it and for the frame, because `max_depth ≤ STACK`.
                            refracts = pending.push(refracted).is_ok();
                            if stage(STAGES, Stages::CUTOFF) {
                                let _ = throughputs.push(throughput);
                            }
                        }
                    }
                    color = self.local_color(&ray, &hit, stack.len(), observer);
                    observer.local_color(color);
                    if stage(STAGES, Stages::REFLECTION) && weight.is_positive() {
                        let _ = stack.push(Level {
                            color,
                            weight: if refracts { -weight } else { weight },
                        });
                        kind = RayKind::Reflected;
                        let direction = ray.direction.reflect_at(hit.normal, hit.cosine);
                        candidates = self.near(hit.candidates, hit.cell, direction);
                        ray = Ray {
                            origin: hit.outside,
                            direction,
                            leaves: hit.facing,
                        };
                        if stage(STAGES, Stages::CUTOFF) {
                            throughput = throughput * weight;
                        }
                        continue;
                    }
                    is_sum = true;
                }
            }
            // Hand the colour up, to the first hit that has a ray left to cast.
            loop {
                if is_sum {
                    if stage(STAGES, Stages::REFRACTION)
                        && refracts
                        && let Some(refracted) = pending.pop()
                    {
                        let weight = refracted.weight;
                        let _ = stack.push(Level { color, weight });
                        if stage(STAGES, Stages::CUTOFF)
                            && let Some(at_hit) = throughputs.pop()
                        {
                            throughput = at_hit * weight;
                        }
                        kind = RayKind::Refracted;
                        ray = refracted.ray;
                        candidates = refracted.candidates;
                        break;
                    }
                    color = color.clamp();
                }
                observer.result(color);
                let Some(frame) = stack.pop() else {
                    return color;
                };
                color = frame.color + color * frame.weight.abs();
                observer.sum(color);
                is_sum = true;
                refracts = frame.weight.is_negative();
            }
        }
    }

    /// The nearest hit, projected back onto its surface and turned to face the ray.
    #[inline(always)]
    fn hit(
        &self,
        ray: &Ray<T>,
        candidates: ObjectSet,
        observer: &mut impl Observer<T>,
    ) -> Option<Hit<'a, T>> {
        let closest = self.closest(ray, candidates, observer);
        let (point, info, cell) = self.hit_point(ray, &closest)?;
        let slope = ray.direction.component_along(point.normal);
        let entering = slope.is_zero_or_negative();
        let normal = if entering {
            point.normal
        } else {
            -point.normal
        };
        let facing = Side::new(closest.index as u32, entering);
        let hit = Hit {
            facing,
            candidates: self.candidates(facing),
            cell,
            material: self.material(info)?,
            normal,
            cosine: slope.abs(),
            entering,
            outside: point.point.moved_along(normal, point.offset),
            inside: point.point.moved_along(normal, -point.offset),
        };
        observer.intersection(&Intersection {
            side: hit.facing,
            number: info.number,
            t: closest.t,
            point: point.point,
            normal,
            material: hit.material.description(),
        });
        Some(hit)
    }

    #[inline(always)]
    fn background(&self, direction: Vec3<T>) -> Color<T> {
        let background = &self.scene.background;
        if stage(STAGES, Stages::SKY)
            && (!stage(STAGES, Stages::PLAIN_BACKGROUND) || background.sky)
        {
            Background::sky(direction)
        } else {
            background.color.clamp()
        }
    }

    /// What the pixels of a row have in common.
    pub fn scanline(&self, y: u16) -> Scanline<T> {
        let image_plane_y = self.scene.camera.image_plane_y(self.scene.resolution, y);
        let half_width = self.scene.camera.half_width(self.scene.resolution);
        self.scanline_of(image_plane_y, half_width)
    }

    /// What the samples at a place in the pixels of a row have in common.
    pub fn scanline_at(&self, y: u16, at: Subpixel) -> Scanline<T> {
        let image_plane_y = self
            .scene
            .camera
            .image_plane_y_at(self.scene.resolution, y, at);
        let half_width = self.scene.camera.half_width_at(self.scene.resolution, at);
        self.scanline_of(image_plane_y, half_width)
    }

    #[inline(always)]
    fn scanline_of(&self, image_plane_y: T, half_width: T) -> Scanline<T> {
        Scanline {
            image_plane_y,
            visible: visible_in_row(
                &self.geometry(),
                &self.scene.camera,
                image_plane_y,
                half_width,
            ),
        }
    }

    /// The primary ray of a pixel; `x` must lie in the picture.
    #[inline(always)]
    pub fn primary_ray(&self, scanline: &Scanline<T>, x: u16) -> Ray<T> {
        self.primary_ray_at(scanline, x, Subpixel::CENTER)
    }

    /// The primary ray through a place in a pixel, for the scanline of that place.
    #[inline(always)]
    pub fn primary_ray_at(&self, scanline: &Scanline<T>, x: u16, at: Subpixel) -> Ray<T> {
        self.scene
            .camera
            .ray_at(self.scene.resolution, scanline.image_plane_y, x, at)
    }

    /// The linear colour of a pixel, each channel in 0…1: a pure function of scene, settings and
    /// coordinates.
    pub fn pixel(&self, x: u16, y: u16) -> Color<T> {
        self.pixel_observed(&self.scanline(y), x, &mut ())
    }

    /// A pixel of a row, watched.
    #[inline(always)]
    pub fn pixel_observed(
        &self,
        scanline: &Scanline<T>,
        x: u16,
        observer: &mut impl Observer<T>,
    ) -> Color<T> {
        self.sample_observed(scanline, x, Subpixel::CENTER, observer)
    }

    /// The linear colour at a place in a pixel, for the scanline of that place, watched.
    #[inline(always)]
    pub fn sample_observed(
        &self,
        scanline: &Scanline<T>,
        x: u16,
        at: Subpixel,
        observer: &mut impl Observer<T>,
    ) -> Color<T> {
        self.radiance_observed(
            self.primary_ray_at(scanline, x, at),
            scanline.visible,
            observer,
        )
    }
}

macro_rules! specialize {
    ($scalar:ty) => {
        impl<'a, const STAGES: u64, const STACK: usize> Tracer<'a, $scalar, STAGES, STACK> {
            /// The same tracer with only the stages of `KEPT`, for a scene that is known on the device
            /// but whose needs are known before.
            ///
            /// # Errors
            ///
            /// [`MissingStages`] when the scene needs more.
            pub const fn specialize<const KEPT: u64>(
                self,
            ) -> Result<Tracer<'a, $scalar, KEPT, STACK>, MissingStages> {
                let mut needs = self.scene.stages();
                if self.cutoff > 0.0 {
                    needs = needs.union(Stages::CUTOFF);
                }
                let missing = needs.without(Stages::from_bits(KEPT));
                if !missing.is_empty() {
                    return Err(MissingStages(missing));
                }
                Ok(Tracer {
                    scene: self.scene,
                    max_depth: self.max_depth,
                    cutoff: self.cutoff,
                })
            }
        }
    };
}

specialize!(f32);
specialize!(f64);

/// A tracer for a `static` scene with only the stages the scene needs, or for pools with those that a scene in them
/// can need.
///
/// `tracer_for!(SCENE)` compiles what the scene needs and frames for [`DEFAULT_MAX_DEPTH`];
/// `tracer_for!(SCENE, stack = 8)` has 8 frames; `tracer_for!(SCENE, cutoff = 1.0 / 256.0)` has a
/// [cut-off](Tracer::with_cutoff), with a stack or without; `tracer_for!(SCENE, stages = S)` compiles
/// exactly the stages `S`:
///
/// ```
/// # use scanray::*;
/// static EMPTY: Scene<'static> = Scene::EMPTY
///     .with_resolution(Resolution { width: 4, height: 3 })
///     .with_background(Background { color: Color::new(0.5, 0.5, 1.0), sky: true });
/// let tracer = tracer_for!(EMPTY);
/// assert_eq!(tracer.stages(), Stages::SKY);
/// let same = tracer_for!(EMPTY, stages = Stages::SKY);
/// # assert_eq!(tracer.pixel(1, 1), same.pixel(1, 1));
/// let faster = tracer_for!(EMPTY, cutoff = 1.0 / 256.0, stack = 8);
/// # assert_eq!(tracer.pixel(1, 1), faster.pixel(1, 1));
/// # assert_eq!((faster.cutoff(), faster.max_depth()), (1.0 / 256.0, 5));
/// ```
///
/// It does not compile when the scene needs a stage more, and the error names it: "the scene needs the
/// stage `sky`, which is left out".
///
/// ```compile_fail,E0080
/// # use scanray::*;
/// # static EMPTY: Scene<'static> = Scene::EMPTY
/// #     .with_resolution(Resolution { width: 4, height: 3 })
/// #     .with_background(Background { color: Color::new(0.5, 0.5, 1.0), sky: true });
/// let tracer = tracer_for!(EMPTY, stages = Stages::SPHERES);
/// ```
///
/// `tracer_for!(pools, in Pools)` is for a scene in pools whose type is `Pools`, with a stack or without: with room
/// for 31 objects and fewer its loops are shorter than those of [`Tracer::new`], which draws a scene of any size.
///
/// ```
/// # use scanray::*;
/// type Pools = ScenePools<f32, 12, 4, 15>;
/// let mut pools = Pools::new();
/// # #[cfg(feature = "parser")]
/// pools.parse(include_bytes!("../../scenes/default.txt"))?;
/// let tracer = tracer_for!(pools, in Pools);
/// assert!(!tracer.stages().contains(Stages::MANY_OBJECTS));
/// # assert_eq!(tracer.pixel(400, 300), Tracer::new(pools.as_scene()).pixel(400, 300));
/// let deeper = tracer_for!(pools, in Pools, stack = 8);
/// # assert_eq!(deeper.with_max_depth(8)?.max_depth(), 8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Pools of another type do not compile:
///
/// ```compile_fail,E0308
/// # use scanray::*;
/// let pools = ScenePools::<f32, 12, 4, 15>::new();
/// let tracer = tracer_for!(pools, in ScenePools<f32, 12, 4, 0>);
/// ```
#[macro_export]
macro_rules! tracer_for {
    ($pools:ident, in $type:ty) => {
        $crate::tracer_for!($pools, in $type, stack = $crate::DEFAULT_MAX_DEPTH)
    };
    ($pools:ident, in $type:ty, stack = $stack:expr) => {
        $crate::Tracer::<'_, _, { <$type>::STAGES.bits() }, { $stack }>::with_stages(
            // The type is that of the pools, or this does not compile.
            <$type>::as_scene(&$pools),
        )
    };
    ($scene:path) => {
        $crate::tracer_for!($scene, stack = $crate::DEFAULT_MAX_DEPTH)
    };
    ($scene:path, stack = $stack:expr) => {
        $crate::tracer_for!($scene, stages = $scene.stages(), stack = $stack)
    };
    ($scene:path, cutoff = $cutoff:expr) => {
        $crate::tracer_for!($scene, cutoff = $cutoff, stack = $crate::DEFAULT_MAX_DEPTH)
    };
    ($scene:path, cutoff = $cutoff:expr, stack = $stack:expr) => {
        $crate::tracer_for!(
            $scene,
            stages = $scene.stages().union($crate::Stages::CUTOFF),
            stack = $stack
        )
        .with_compiled_cutoff($cutoff)
    };
    ($scene:path, stages = $stages:expr) => {
        $crate::tracer_for!($scene, stages = $stages, stack = $crate::DEFAULT_MAX_DEPTH)
    };
    ($scene:path, stages = $stages:expr, stack = $stack:expr) => {{
        const STAGES: $crate::Stages = $stages;
        // An item, so that `cargo check` looks at it too.
        const _: () = $scene.stages().require(STAGES);
        $crate::Tracer::<'static, _, { STAGES.bits() }, { $stack }>::with_stages($scene)
    }};
}
