//! No pixel of any scene casts more rays than promised.

use crate::common::scenes;
use scanray::{ScenePools, Tracer, tracer::WorkCount};

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
