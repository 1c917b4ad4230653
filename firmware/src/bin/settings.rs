//! Draws the baked scene with settings that the build names (`SCANRAY_SETTINGS`) and prints what each takes.
//!
//! A build is one code: a way of sampling, with a cut-off or without, for one kind of display. What a program may set without
//! being compiled again (depth, cut-off, threshold, blocks) differs from run to run, and the compiler does not know it.

#![no_std]
#![no_main]

use core::convert::Infallible;
use core::hint::black_box;

use board::console;
use embedded_graphics::{prelude::*, primitives::Rectangle};
use scanray::{
    Color, Picture, Resolution, Scene,
    render::{
        Adaptive, Budget, CenterSample, DisplayColor, PixelSource, Progressive, Quantizer,
        Supersampled,
    },
    tracer_for,
};

/// How pixels come about.
#[allow(dead_code, reason = "a build has one of them")]
#[derive(Clone, Copy)]
enum Method {
    /// All of them, each with `SAMPLES`.
    Fixed,
    /// The same where neighbours differ.
    Adaptive,
    /// The first pass of a picture that is drawn coarse to fine.
    Preview,
}

/// A picture to draw. A build without a cut-off reads none.
#[allow(dead_code)]
#[derive(Clone, Copy)]
struct Run {
    max_depth: usize,
    cutoff: f32,
    threshold: f32,
    /// Side of the blocks of a preview.
    block: u16,
    /// Of so many rows one is drawn, which stands for all.
    of_rows: u16,
}

// The display's colour `Shown`, DITHERED, RESOLUTION, METHOD, SAMPLES, STACK, RUNS, and a macro that makes a run's tracer.
include!(concat!(env!("OUT_DIR"), "/settings.rs"));

static SCENE: Scene<'static> = include!(concat!(env!("OUT_DIR"), "/scene.rs"));

const WIDTH: usize = RESOLUTION.width as usize;

/// Centres that adaptive sampling keeps, and colours of a row that a preview keeps.
const KEPT: [usize; 2] = match METHOD {
    Method::Fixed => [0, 0],
    Method::Adaptive => [2 * WIDTH, 0],
    Method::Preview => [0, WIDTH],
};

type Memory = ([CenterSample; KEPT[0]], [Color; KEPT[1]]);

board::entry!(
    program,
    Memory = ([CenterSample::EMPTY; KEPT[0]], [Color::BLACK; KEPT[1]])
);

fn program((centers, colors): &mut Memory) -> Result<(), &'static str> {
    for run in RUNS {
        let run = black_box(*run);
        let tracer = tracer!(run).with_resolution(RESOLUTION);
        let tracer = tracer
            .with_max_depth(run.max_depth)
            .map_err(|_| "too deep")?;
        let ticks = match METHOD {
            Method::Fixed if SAMPLES == 1 => as_shown(tracer, run, colors),
            Method::Fixed => as_shown(Supersampled::<_, SAMPLES>::new(tracer), run, colors),
            Method::Adaptive => {
                let adaptive = Adaptive::<_, SAMPLES>::new(tracer, run.threshold, centers);
                as_shown(&adaptive, run, colors)
            }
            Method::Preview => as_shown(tracer, run, colors),
        };
        console::hexadecimal("ticks ", ticks.ok_or("too long to count")?);
    }
    Ok(())
}

/// What drawing takes in the display's colours.
#[inline(always)]
fn as_shown(source: impl PixelSource<Scalar = f32>, run: Run, colors: &mut [Color]) -> Option<u32> {
    let picture = Picture::<_, scanray::render::Exact<Shown>>::new(source);
    if DITHERED {
        drawing(&picture.dithered(), run, colors)
    } else {
        drawing(&picture, run, colors)
    }
}

#[inline(always)]
fn drawing<Q: Quantizer<Color = Shown>>(
    picture: &Picture<impl PixelSource<Scalar = f32>, Q>,
    run: Run,
    colors: &mut [Color],
) -> Option<u32> {
    match METHOD {
        Method::Preview => {
            let mut progressive = if run.block == 2 {
                Progressive::from_half(picture)
            } else {
                Progressive::of(picture)
            };
            let before = board::ticks();
            let Ok(_) = progressive.draw_pass(picture, &mut Nowhere, colors, Budget::Unlimited);
            Some(board::ticks().wrapping_sub(before))
        }
        _ => rows(picture, run),
    }
}

/// Row by row.
#[inline(always)]
fn rows<Q: Quantizer<Color = Shown>>(
    picture: &Picture<impl PixelSource, Q>,
    run: Run,
) -> Option<u32> {
    let mut row = [Shown::from_linear(Color::<f32>::BLACK, 0.0); WIDTH];
    let mut ticks = 0_u32;
    let mut y = run.of_rows / 2;
    while y < RESOLUTION.height {
        let before = board::ticks();
        picture.row(0, y, &mut row);
        // The row is complete before the clock is read again.
        black_box(&mut row);
        ticks = ticks.checked_add(board::ticks().wrapping_sub(before))?;
        y += run.of_rows;
    }
    Some(ticks)
}

/// A display that takes every pixel and shows none.
struct Nowhere;

impl OriginDimensions for Nowhere {
    fn size(&self) -> Size {
        Size::new(RESOLUTION.width.into(), RESOLUTION.height.into())
    }
}

impl DrawTarget for Nowhere {
    type Color = Shown;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Shown>>>(
        &mut self,
        pixels: I,
    ) -> Result<(), Infallible> {
        pixels.into_iter().for_each(|pixel| {
            black_box(pixel);
        });
        Ok(())
    }

    fn fill_contiguous<I: IntoIterator<Item = Shown>>(
        &mut self,
        _: &Rectangle,
        colors: I,
    ) -> Result<(), Infallible> {
        colors.into_iter().for_each(|color| {
            black_box(color);
        });
        Ok(())
    }
}
