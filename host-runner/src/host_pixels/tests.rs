//! Equality with the core, to the bit, for every knob.

use std::path::PathBuf;

use embedded_graphics::Drawable;
use embedded_graphics::framebuffer::{Framebuffer, buffer_size};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::pixelcolor::raw::{BigEndian, RawU24};
use scanray::{
    Color, Picture, Resolution, Scalar, ScenePools, Tracer,
    parser::FromDecimal,
    render::{
        Adaptive, Budget, CenterSample, Exact, PixelSource, Progress, Progressive, SampleSource,
        Supersampled,
    },
    tracer::WorkCount,
};

use super::{Drawing, HostPixels};
use crate::host_tracer::HostTracer;
use crate::knobs::{Detail, Knobs, SampleCount};
use crate::parallel_drawing::Workers;

const SIZE: Resolution = Resolution {
    width: 21,
    height: 15,
};

type Screen = Framebuffer<
    Rgb888,
    RawU24,
    BigEndian,
    { SIZE.width as usize },
    { SIZE.height as usize },
    { buffer_size::<Rgb888>(SIZE.width as usize, SIZE.height as usize) },
>;

fn load<T: Scalar + FromDecimal>(name: &str) -> Box<ScenePools<T>> {
    let mut file = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    file.extend(["..", "scenes", &format!("{name}.txt")]);
    let mut pools = Box::new(ScenePools::new());
    pools.parse(&std::fs::read(file).unwrap()).unwrap();
    pools
}

/// Compares the pixels of a tracer with those of a source, and the tracer's own.
fn assert_same<T: Drawing>(tracer: &HostTracer<'_, T>, expected: &impl PixelSource<Scalar = T>) {
    let pixels: HostPixels<'_, T> = T::pixels(tracer);
    for y in 0..SIZE.height {
        let scanline = expected.scanline(y);
        let row = pixels.scanline(y);
        for x in 0..SIZE.width {
            let expected = bits(expected.pixel_on(&scanline, x).0);
            let knobs = tracer.knobs();
            let place = format!("{x},{y} with {knobs:?}");
            assert_eq!(bits(pixels.pixel_on(&row, x).0), expected, "{place}");
            let single = tracer.pixel_observed(x, y, &mut ());
            assert_eq!(bits(single), expected, "{place}, ray by ray");
        }
    }
}

fn bits<T: Scalar>(color: Color<T>) -> [u64; 3] {
    [color.r, color.g, color.b].map(|channel| channel.to_f64().to_bits())
}

/// Compares the knobs of samples with the core's sources around a tracer.
fn samples_are_the_same<T: Drawing>(
    host: HostTracer<'_, T>,
    core: &impl SampleSource<Scalar = T>,
    knobs: Knobs,
) {
    let with = |samples, edges| {
        host.with_knobs(Knobs {
            samples,
            edges,
            ..knobs
        })
    };
    assert_same(&with(SampleCount::One, None), core);
    let four = Supersampled::<_, 4>::new(core);
    assert_same(&with(SampleCount::Four, None), &four);
    let sixteen = Supersampled::<_, 16>::new(core);
    assert_same(&with(SampleCount::Sixteen, None), &sixteen);
    for threshold in [0.0, 1.0 / 16.0, 1.0] {
        let mut centers = vec![CenterSample::EMPTY; 2 * usize::from(SIZE.width)];
        let adaptive = Adaptive::<_, 4>::new(core, T::from_f64(threshold), &mut centers);
        assert_same(&with(SampleCount::Four, Some(threshold)), &adaptive);
    }
}

fn knobs_have_the_bits_of_the_core<T: Drawing + FromDecimal>(name: &str) {
    let pools = load::<T>(name);
    let scene = pools.as_scene();
    let host = HostTracer::new(scene, SIZE, 5).unwrap();
    let core = Tracer::new(scene).with_resolution(SIZE);
    samples_are_the_same(host, &core, Knobs::default());
    let cutoff = 1.0 / 64.0;
    let knobs = Knobs {
        cutoff,
        ..Knobs::default()
    };
    samples_are_the_same(host, &core.with_cutoff(T::from_f64(cutoff)), knobs);
}

#[test]
fn knobs_have_the_bits_of_the_core_in_f32() {
    for name in ["default", "window-room"] {
        knobs_have_the_bits_of_the_core::<f32>(name);
    }
}

#[test]
fn knobs_have_the_bits_of_the_core_in_f64() {
    knobs_have_the_bits_of_the_core::<f64>("pyramids");
}

#[test]
fn rows_in_any_order_from_several_threads_are_the_same() {
    let pools = load::<f32>("default");
    let knobs = Knobs {
        samples: SampleCount::Sixteen,
        edges: Some(0.05),
        ..Knobs::default()
    };
    let tracer = HostTracer::new(pools.as_scene(), SIZE, 5)
        .unwrap()
        .with_knobs(knobs);
    let pixels = f32::pixels(&tracer);
    let compare = |y: u16| {
        for (x, color) in (0..).zip(&*pixels.scanline(y)) {
            let expected = tracer.pixel_observed(x, y, &mut ());
            assert_eq!(bits(*color), bits(expected), "{x},{y}");
        }
    };
    std::thread::scope(|scope| {
        scope.spawn(|| (0..SIZE.height).rev().for_each(compare));
        (0..SIZE.height).for_each(compare);
    });
}

#[test]
fn previews_are_the_passes_of_the_core() {
    let pools = load::<f32>("default");
    let knobs = Knobs {
        samples: SampleCount::Four,
        edges: Some(0.05),
        ..Knobs::default()
    };
    for knobs in [Knobs::default(), knobs] {
        let tracer = HostTracer::new(pools.as_scene(), SIZE, 5)
            .unwrap()
            .with_knobs(knobs);
        let full = Picture::<_, Exact<Rgb888>>::new(&tracer);
        let mut progressive = Progressive::of(&full);
        let mut screen = Screen::new();
        let mut buffer = vec![Color::BLACK; SIZE.width.into()];
        for detail in [Detail::Quarter, Detail::Half, Detail::Full] {
            let Ok(_) = progressive.draw_pass(&full, &mut screen, &mut buffer, Budget::Unlimited);
            let preview = tracer.with_knobs(Knobs { detail, ..knobs });
            let pixels = f32::pixels(&preview);
            let mut expected = Screen::new();
            let Ok(()) = Picture::<_, Exact<Rgb888>>::new(&pixels).draw(&mut expected);
            assert!(screen.data() == expected.data(), "{detail:?}");
            assert_same(&preview, &pixels);
        }
        assert_eq!(progressive.progress(), Progress::Done);
    }
}

#[test]
fn work_is_counted_as_the_core_does_it() {
    let workers = Workers::new(Some(2)).unwrap();
    let pools = load::<f32>("default");
    let scene = pools.as_scene();
    let host = HostTracer::new(scene, SIZE, 5).unwrap();
    let core = Tracer::new(scene).with_resolution(SIZE);
    let count = |knobs| {
        let host = host.with_knobs(knobs);
        host.count_work(0..SIZE.height, &workers).count
    };

    // Each centre once, and the samples of edges.
    let mut centers = vec![CenterSample::EMPTY; 2 * usize::from(SIZE.width)];
    let adaptive = Adaptive::<_, 4>::new(&core, 0.1, &mut centers);
    let mut expected = WorkCount::default();
    for y in 0..SIZE.height {
        let scanline = adaptive.scanline(y);
        for x in 0..SIZE.width {
            adaptive.pixel_observed(&scanline, x, &mut expected);
        }
    }
    let knobs = Knobs {
        samples: SampleCount::Four,
        edges: Some(0.1),
        ..Knobs::default()
    };
    let counted = count(knobs);
    assert_eq!(counted.primary_rays, expected.primary_rays);
    assert_eq!(counted.rays(), expected.rays());
    assert_eq!(counted.tests(), expected.tests());

    let full = count(Knobs::default());
    let preview = count(Knobs {
        detail: Detail::Quarter,
        ..Knobs::default()
    });
    assert_eq!(preview.primary_rays, 6 * 4);
    let cut = count(Knobs {
        cutoff: 1.0 / 256.0,
        ..Knobs::default()
    });
    assert!(cut.rays() < full.rays());
    assert_eq!(cut.primary_rays, full.primary_rays);
}
