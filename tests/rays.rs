//! What holds for every ray of every scene, however deep: directions of length 1, no more rays than
//! promised, finite colours.

mod common;

use common::scenes;
use scanray::{
    FromDecimal, Observer, Ray, RayKind, Resolution, Scalar, ScenePools, Tracer, WorkCount,
};

const DEPTH: usize = 16;

/// The worst of what was seen.
#[derive(Debug, Default)]
struct Watch {
    rays: u64,
    deepest: usize,
    off_length: f64,
}

impl<T: Scalar> Observer<T> for Watch {
    fn ray(&mut self, _: RayKind, depth: usize, ray: &Ray<T>) {
        assert!(
            ray.origin.is_finite() && ray.direction.is_finite(),
            "{ray:?}"
        );
        let d = [ray.direction.x, ray.direction.y, ray.direction.z].map(Scalar::to_f64);
        let length = d.iter().map(|x| x * x).sum::<f64>().sqrt();
        self.rays += 1;
        self.deepest = self.deepest.max(depth);
        self.off_length = self.off_length.max((length - 1.0).abs());
    }
}

/// Numerics: |direction| − 1 is at most 2e-7 at any depth.
fn directions_have_length_one<T: Scalar + FromDecimal>(tolerance: f64) {
    let size = Resolution {
        width: 40,
        height: 30,
    };
    for name in scenes::names() {
        let pools: ScenePools<T> = scenes::load(&name);
        let tracer = Tracer::new(pools.as_scene())
            .with_resolution(size)
            .with_stack::<DEPTH>()
            .with_max_depth(DEPTH)
            .unwrap();
        let mut watch = Watch::default();
        for y in 0..size.height {
            for x in 0..size.width {
                let color = tracer.pixel_observed(&tracer.scanline(y), x, &mut watch);
                assert!(color.is_finite(), "{name}: pixel ({x}, {y}) is {color:?}");
                assert_eq!(color, color.clamp(), "{name}: pixel ({x}, {y})");
            }
        }
        println!("{name}: {watch:?}");
        assert!(watch.off_length <= tolerance, "{name}: {watch:?}");
        assert!(
            watch.deepest > 3 && watch.deepest <= DEPTH,
            "{name}: {watch:?}"
        );
    }
}

#[test]
fn directions_have_length_one_in_single_precision() {
    directions_have_length_one::<f32>(2e-7);
}

#[test]
fn directions_have_length_one_in_double_precision() {
    directions_have_length_one::<f64>(4e-16);
}

#[test]
fn no_pixel_casts_more_rays_than_promised() {
    for name in scenes::names() {
        let pools: ScenePools = scenes::load(&name);
        for depth in 0..=5 {
            let tracer = Tracer::new(pools.as_scene()).with_max_depth(depth).unwrap();
            let promised = tracer.max_rays_per_pixel();
            // A full binary tree of hits, each with a shadow ray.
            assert_eq!(promised, 2 * ((2 << depth) - 1));
            for (x, y) in (0..600)
                .step_by(20)
                .flat_map(|y| (0..800).step_by(20).map(move |x| (x, y)))
            {
                let mut work = WorkCount::default();
                tracer.pixel_observed(&tracer.scanline(y), x, &mut work);
                assert_eq!(work.primary_rays, 1);
                assert!(
                    work.rays() <= promised,
                    "{name}: pixel ({x}, {y}), {work:?}"
                );
                if depth == 0 {
                    assert_eq!(work.reflected_rays + work.refracted_rays, 0);
                }
            }
        }
    }
}
