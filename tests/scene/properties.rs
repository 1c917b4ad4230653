//! What holds for every text: the fuzz targets, shared with tests/scene/fuzzing.rs, which tries them on a stable
//! compiler. Each panics where its property does not hold.

// Each target uses one of them.
#![allow(dead_code)]

use scanray::{
    Color, Resolution, Scalar, ScenePools, Tracer, parser::FromDecimal, tracer::RayCount,
};

/// Any bytes are a scene or an error at a place of the text, which leaves the pools empty.
pub(crate) fn parse(text: &[u8]) {
    read::<f32>(text);
    read::<f64>(text);
}

/// A scene that is accepted is drawn with finite colours in 0…1, with no more rays than promised, and with
/// the bits that it has when every ray is tested against every object.
pub(crate) fn draw(text: &[u8]) {
    draw_with::<f32>(text);
    draw_with::<f64>(text);
}

/// The pools of a text that is a scene.
pub(crate) fn read<T: Scalar + FromDecimal>(text: &[u8]) -> Option<Box<ScenePools<T>>> {
    let mut pools = Box::new(ScenePools::new());
    match pools.parse(text) {
        Ok(_) => Some(pools),
        Err(error) => {
            let before = text.get(..error.offset).expect("a place in the text");
            let line = before.split(|&byte| byte == b'\n').count();
            let column = before.rsplit(|&byte| byte == b'\n').next().unwrap().len() + 1;
            assert_eq!((error.line as usize, error.column as usize), (line, column));
            let message = error.to_string();
            assert!(message.contains("expected ") && message.contains("; found "));
            assert!(message.chars().all(|c| !c.is_control()), "{message:?}");
            assert!(pools.usage().iter().all(|pool| pool.used == 0));
            None
        }
    }
}

fn draw_with<T: Scalar + FromDecimal>(text: &[u8]) {
    const SIZE: Resolution = Resolution {
        width: 8,
        height: 8,
    };
    let Some(pools) = read::<T>(text) else { return };
    let scene = pools.as_scene();
    let every_object = scene.without_accel();
    let tracer = Tracer::new(scene).with_resolution(SIZE);
    let exhaustive = Tracer::new(every_object).with_resolution(SIZE);
    for y in 0..SIZE.height {
        let scanline = tracer.scanline(y);
        for x in 0..SIZE.width {
            let mut rays = RayCount::default();
            let color = tracer.pixel_observed(&scanline, x, &mut rays);
            assert!(color.is_finite(), "pixel ({x}, {y}) is {color:?}");
            assert_eq!(color, color.clamp(), "pixel ({x}, {y})");
            assert!(u64::from(rays.0) <= tracer.max_rays_per_pixel());
            let expected = exhaustive.radiance(exhaustive.primary_ray(&scanline, x));
            assert_eq!(bits(color), bits(expected), "pixel ({x}, {y})");
        }
    }
}

fn bits<T: Scalar>(color: Color<T>) -> [u64; 3] {
    [color.r, color.g, color.b].map(|channel| channel.to_f64().to_bits())
}
