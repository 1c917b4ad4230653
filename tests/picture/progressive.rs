//! Coarse to fine: every pass shows blocks, no pixel is traced twice, and the last one has the bits of the
//! whole picture, whatever the buffers and budgets.

use std::cell::RefCell;

use crate::common::canvas::{BusError, Canvas, FailingDisplay};
use crate::common::random::Random;
use crate::common::scenes::load;
use embedded_graphics::Drawable;
use embedded_graphics::pixelcolor::{BinaryColor, Rgb888};
use scanray::{
    Color, Picture, Resolution, Tracer,
    render::{Adaptive, Budget, CenterSample, PixelSource, Progress, Progressive, Quantizer},
};

/// Colours that tell where they belong, and which pixels were asked for.
#[derive(Debug)]
struct Coordinates {
    size: Resolution,
    traced: RefCell<Vec<(u16, u16)>>,
}

impl Coordinates {
    fn new(width: u16, height: u16) -> Self {
        Self {
            size: Resolution { width, height },
            traced: RefCell::default(),
        }
    }
}

/// A colour of its own for each of the first pixels.
fn color_at(x: u16, y: u16) -> Color<f64> {
    let level = |value: u16| f64::from(value) / 255.0;
    Color::new(level(x % 256), level(y % 256), level((x / 256) ^ (y / 256)))
}

impl PixelSource for Coordinates {
    type Scalar = f64;
    type Scanline = u16;

    fn resolution(&self) -> Resolution {
        self.size
    }

    fn scanline(&self, y: u16) -> u16 {
        y
    }

    fn pixel_on(&self, y: &u16, x: u16) -> (Color<f64>, u32) {
        self.traced.borrow_mut().push((x, *y));
        // An uneven price, so that budgets of rays end anywhere.
        (color_at(x, *y), u32::from(x % 3) + 1)
    }
}

const SIZES: [(u16, u16); 12] = [
    (1, 1),
    (1, 9),
    (9, 1),
    (2, 2),
    (3, 5),
    (4, 4),
    (5, 3),
    (8, 8),
    (16, 12),
    (17, 13),
    (37, 23),
    (39, 22),
];

/// Every pixel of a display shows the colour of the first pixel of its block, quantised in its own place.
#[track_caller]
fn assert_blocks<Q: Quantizer<Color: std::fmt::Debug>>(
    canvas: &Canvas<Q::Color>,
    size: Resolution,
    block: u16,
) {
    for y in 0..size.height {
        for x in 0..size.width {
            let color = color_at(x / block * block, y / block * block);
            assert_eq!(
                canvas.get(x.into(), y.into()),
                Some(Q::quantize(color, x, y)),
                "pixel {x},{y} in blocks of {block}"
            );
        }
    }
}

/// Draws pass by pass.
fn passes<Q: Quantizer<Color: std::fmt::Debug>>(
    picture: &Picture<&Coordinates, Q>,
    mut progressive: Progressive,
    coarsest: u16,
    room: usize,
) {
    let size = picture.resolution();
    let mut canvas = Canvas::new(size.width, size.height);
    let mut buffer = vec![Color::BLACK; room];
    let mut block = coarsest;
    loop {
        assert_eq!(progressive.block(), block);
        let progress = progressive.draw_pass(picture, &mut canvas, &mut buffer, Budget::Unlimited);
        assert_blocks::<Q>(&canvas, size, block);
        if progress == Ok(Progress::Done) {
            break;
        }
        // A pass of which nothing is left in a picture of one pixel is passed over.
        while progressive.block() != block {
            block /= 2;
        }
    }
    assert_eq!(progressive.progress(), Progress::Done);
}

#[test]
fn each_pass_shows_its_blocks_and_no_pixel_is_traced_twice() {
    for (width, height) in SIZES {
        for room in [0, 1, 2, 3, 10, 40] {
            let every_pixel = usize::from(width) * usize::from(height);
            let check = |draw: &dyn Fn(&Coordinates)| {
                let source = Coordinates::new(width, height);
                draw(&source);
                let mut traced = source.traced.take();
                traced.sort_unstable();
                traced.dedup();
                assert_eq!(traced.len(), every_pixel, "{width}x{height}, {room}");
            };
            check(&|source| {
                let picture = Picture::<_, scanray::render::Exact<Rgb888>>::new(source);
                passes(&picture, Progressive::of(&picture), 4, room);
                assert_eq!(source.traced.borrow().len(), every_pixel);
            });
            check(&|source| {
                let picture = Picture::<_, scanray::render::Exact<Rgb888>>::new(source);
                passes(&picture, Progressive::from_half(&picture), 2, room);
                assert_eq!(source.traced.borrow().len(), every_pixel);
            });
            check(&|source| {
                let picture =
                    Picture::<_, scanray::render::Exact<BinaryColor>>::new(source).dithered();
                passes(&picture, Progressive::of(&picture), 4, room);
                assert_eq!(source.traced.borrow().len(), every_pixel);
            });
        }
    }
}

#[test]
fn instalments_trace_each_pixel_once_and_are_counted() {
    let random = Random::of_test(20_261_128);
    for (width, height) in SIZES {
        for _ in 0..20 {
            let source = Coordinates::new(width, height);
            let picture: Picture<_, scanray::render::Exact<Rgb888>> = Picture::new(&source);
            let mut progressive = Progressive::of(&picture);
            let mut canvas = Canvas::new(width, height);
            let mut buffer = vec![Color::BLACK; 1 + random.below(40)];
            let of = u32::from(width) * u32::from(height);
            loop {
                let before = source.traced.borrow().len();
                let amount = random.below(30);
                let budget = match random.below(2) {
                    0 => Budget::Pixels(amount as u32),
                    _ => Budget::Rays(amount as u32),
                };
                let Ok(progress) = progressive.draw(&picture, &mut canvas, &mut buffer, budget);
                let traced = source.traced.borrow().len();
                assert!(traced - before <= amount, "{budget:?}");
                if progress == Progress::Done {
                    assert_eq!(traced as u32, of);
                    break;
                }
                let pixels = traced as u32;
                assert_eq!(progress, Progress::SoFar { pixels, of });
                if let Budget::Pixels(_) = budget {
                    assert_eq!(traced - before, amount, "the budget is used up");
                }
            }
            assert_blocks::<scanray::render::Exact<Rgb888>>(&canvas, picture.resolution(), 1);
        }
    }
}

#[test]
fn rows_that_are_new_take_one_fill() {
    let source = Coordinates::new(18, 11);
    let picture: Picture<_, scanray::render::Exact<Rgb888>> = Picture::new(&source);
    let mut progressive = Progressive::of(&picture);
    let mut canvas = Canvas::new(18, 11);
    let mut buffer = [Color::BLACK; 18];
    let mut pass = || {
        canvas.fills.clear();
        canvas.other_calls = 0;
        let _ = progressive.draw_pass(&picture, &mut canvas, &mut buffer, Budget::Unlimited);
        (canvas.fills.len(), canvas.other_calls)
    };
    // Rows 0, 4 and 8.
    assert_eq!(pass(), (3, 0));
    // Rows 2, 6 and 10; in rows 0, 4 and 8 the blocks in columns 2, 6, 10 and 14.
    assert_eq!(pass(), (3 + 3 * 4, 0));
    // The five odd rows; the even ones at once each.
    assert_eq!(pass(), (5, 6));
}

#[test]
fn what_a_display_refuses_is_drawn_again() {
    let source = Coordinates::new(18, 11);
    let picture: Picture<_, scanray::render::Exact<Rgb888>> = Picture::new(&source);
    for fails_at in 0..30 {
        let mut display = FailingDisplay::new(Canvas::new(18, 11), fails_at);
        let mut progressive = Progressive::of(&picture);
        let mut buffer = [Color::BLACK; 7];
        let mut errors = 0;
        loop {
            match progressive.draw(&picture, &mut display, &mut buffer, Budget::Pixels(50)) {
                Ok(Progress::Done) => break,
                Ok(Progress::SoFar { .. }) => {}
                Err(error) => {
                    assert_eq!(error, BusError { call: fails_at });
                    errors += 1;
                }
            }
        }
        assert_eq!(errors, 1, "call {fails_at}");
        assert_blocks::<scanray::render::Exact<Rgb888>>(&display.canvas, picture.resolution(), 1);
    }
}

#[test]
fn a_refused_stretch_counts_as_not_drawn_and_is_complete_in_a_longer_buffer() {
    let source = Coordinates::new(18, 11);
    let picture: Picture<_, scanray::render::Exact<Rgb888>> = Picture::new(&source);
    for (fails_at, room) in (0..30).flat_map(|fails_at| [1, 3, 7].map(|room| (fails_at, room))) {
        let mut display = FailingDisplay::new(Canvas::new(18, 11), fails_at);
        let mut progressive = Progressive::of(&picture);
        let mut buffer = [Color::BLACK; 18];
        let refused = loop {
            let before = progressive;
            let budget = Budget::Pixels(1);
            // Less than a stretch at a time, and the whole of it when the last of its pixels is traced.
            match progressive.draw(&picture, &mut display, &mut buffer[..room], budget) {
                Ok(Progress::Done) => break None,
                Ok(Progress::SoFar { .. }) => {}
                Err(BusError { .. }) => break Some(before),
            }
        };
        let Some(before) = refused else {
            panic!("call {fails_at} was not made");
        };
        let pixels = |progressive: &Progressive| match progressive.progress() {
            Progress::SoFar { pixels, .. } => pixels as usize,
            Progress::Done => panic!("done in spite of an error"),
        };
        assert!(
            pixels(&progressive) <= pixels(&before)
                && pixels(&progressive) + room > pixels(&before),
            "call {fails_at}, {room}: {progressive:?} after {before:?}"
        );
        // What the shorter buffer held of it is not asked for again.
        buffer.fill(Color::BLACK);
        let budget = Budget::Unlimited;
        let progress = progressive.draw(&picture, &mut display, &mut buffer, budget);
        assert_eq!(progress, Ok(Progress::Done));
        assert_blocks::<scanray::render::Exact<Rgb888>>(&display.canvas, picture.resolution(), 1);
    }
}

#[test]
fn a_buffer_that_becomes_shorter_or_longer_shows_what_it_should() {
    let random = Random::of_test(20_261_129);
    for (width, height) in SIZES {
        for _ in 0..20 {
            let source = Coordinates::new(width, height);
            let picture: Picture<_, scanray::render::Exact<Rgb888>> = Picture::new(&source);
            let mut progressive = Progressive::of(&picture);
            let mut canvas = Canvas::new(width, height);
            let mut buffer = [Color::BLACK; 40];
            loop {
                // A part of the same buffer: a longer one holds what the shorter one did.
                let part = &mut buffer[..1 + random.below(40)];
                let budget = Budget::Pixels(1 + random.below(10) as u32);
                let Ok(progress) = progressive.draw(&picture, &mut canvas, part, budget);
                if progress == Progress::Done {
                    break;
                }
            }
            assert_blocks::<scanray::render::Exact<Rgb888>>(&canvas, picture.resolution(), 1);
        }
    }
}

#[test]
fn scenes_end_with_the_bits_of_the_whole_picture() {
    let size = Resolution {
        width: 37,
        height: 23,
    };
    let pools = load::<f32>("default");
    let tracer = Tracer::new(pools.as_scene()).with_resolution(size);
    let mut centers = vec![CenterSample::EMPTY; 74];
    let adaptive = Adaptive::<_, 4>::new(&tracer, 0.1, &mut centers);
    let picture: Picture<_, scanray::render::Exact<Rgb888>> = Picture::new(&adaptive);
    let mut expected = Canvas::new(size.width, size.height);
    let Ok(()) = picture.draw(&mut expected);
    let mut canvas = Canvas::new(size.width, size.height);
    let mut progressive = Progressive::of(&picture);
    let mut buffer = [Color::BLACK; 16];
    while progressive.draw(&picture, &mut canvas, &mut buffer, Budget::Rays(300))
        != Ok(Progress::Done)
    {}
    for (x, y) in (0..23).flat_map(|y| (0..37).map(move |x| (x, y))) {
        assert_eq!(canvas.get(x, y), expected.get(x, y), "pixel {x},{y}");
    }
    // Once more, after a change.
    assert_eq!(progressive.rewound(), Progressive::of(&picture));
}

#[test]
fn pictures_at_the_ends_of_the_range() {
    for (width, height) in [(u16::MAX, 3), (3, u16::MAX), (0, 5), (5, 0), (0, 0)] {
        let source = Coordinates::new(width, height);
        let picture: Picture<_, scanray::render::Exact<Rgb888>> = Picture::new(&source);
        let mut canvas = Canvas::new(width, height);
        let mut progressive = Progressive::of(&picture);
        let mut buffer = vec![Color::BLACK; 70_000];
        let progress = progressive.draw(&picture, &mut canvas, &mut buffer, Budget::Unlimited);
        assert_eq!(progress, Ok(Progress::Done));
        assert_eq!(canvas.drawn(), usize::from(width) * usize::from(height));
        assert_blocks::<scanray::render::Exact<Rgb888>>(&canvas, picture.resolution(), 1);
    }
}
