//! Whatever the schedule (rows, bands, rectangles, instalments, threads, displays that fail), the picture
//! has the bits of `Picture::pixel`, and every pixel is drawn exactly once.

use std::cell::Cell;

use crate::common::canvas::{BusError, Canvas, FailingDisplay};
use crate::common::random::Random;
use crate::common::scenes;
use embedded_graphics::Drawable;
use embedded_graphics::draw_target::{DrawTarget, DrawTargetExt};
use embedded_graphics::geometry::{Dimensions, Point, Size};
use embedded_graphics::mock_display::MockDisplay;
use embedded_graphics::pixelcolor::{BinaryColor, PixelColor, Rgb565, Rgb888};
use embedded_graphics::primitives::Rectangle;
use scanray::{
    Color, Picture, Resolution, ScenePools, Tracer,
    render::{Budget, Exact, Frame, PixelSource, Progress, Quantizer},
};

const SIZE: Resolution = Resolution {
    width: 37,
    height: 23,
};

/// What buffers hold at first: a colour that is in no picture here.
const UNTRACED: Rgb888 = Rgb888::new(254, 1, 253);

fn pools() -> ScenePools {
    scenes::load("default")
}

fn tracer(pools: &ScenePools) -> Tracer<'_> {
    Tracer::new(pools.as_scene()).with_resolution(SIZE)
}

fn rectangle(x: i32, y: i32, width: u32, height: u32) -> Rectangle {
    Rectangle::new(Point::new(x, y), Size::new(width, height))
}

/// The picture pixel by pixel: what every schedule is held to.
#[derive(Clone)]
struct Expected<C> {
    size: Resolution,
    pixels: Vec<C>,
}

impl<C: PixelColor + std::fmt::Debug> Expected<C> {
    fn of<P: PixelSource, Q: Quantizer<Color = C>>(picture: &Picture<P, Q>) -> Self {
        let size = picture.resolution();
        let pixels = (0..size.height)
            .flat_map(|y| (0..size.width).map(move |x| (x, y)))
            .map(|(x, y)| picture.pixel(x, y))
            .collect();
        Self { size, pixels }
    }

    fn get(&self, x: i32, y: i32) -> C {
        self.pixels[y as usize * usize::from(self.size.width) + x as usize]
    }

    /// The canvas shows this picture inside `area`, drawn once, and nothing elsewhere.
    #[track_caller]
    fn assert_drawn(&self, canvas: &Canvas<C>, area: Rectangle, how: &str) {
        assert_eq!(canvas.overdrawn, 0, "{how}: pixels drawn twice");
        self.assert_shown(canvas, area, how);
    }

    /// The same, whatever was drawn over.
    #[track_caller]
    fn assert_shown(&self, canvas: &Canvas<C>, area: Rectangle, how: &str) {
        let visible = area.intersection(&canvas.bounding_box());
        for y in visible.rows() {
            for x in visible.columns() {
                assert_eq!(
                    canvas.get(x, y),
                    Some(self.get(x, y)),
                    "{how}: pixel ({x}, {y})"
                );
            }
        }
        let count = (visible.size.width * visible.size.height) as usize;
        assert_eq!(canvas.drawn(), count, "{how}: drawn outside {area:?}");
    }
}

/// Counts the pixels that are traced.
#[derive(Debug)]
struct Counted<P> {
    source: P,
    pixels: Cell<u32>,
}

impl<P> Counted<P> {
    fn new(source: P) -> Self {
        Self {
            source,
            pixels: Cell::new(0),
        }
    }
}

impl<P: PixelSource> PixelSource for Counted<P> {
    type Scalar = P::Scalar;
    type Scanline = P::Scanline;

    fn resolution(&self) -> Resolution {
        self.source.resolution()
    }

    fn scanline(&self, y: u16) -> P::Scanline {
        self.source.scanline(y)
    }

    fn pixel_on(&self, scanline: &P::Scanline, x: u16) -> (Color<P::Scalar>, u32) {
        self.pixels.set(self.pixels.get() + 1);
        self.source.pixel_on(scanline, x)
    }
}

/// Colours that tell where they belong, at no cost, for pictures of any size.
#[derive(Clone, Copy, Debug)]
struct Coordinates(Resolution);

impl PixelSource for Coordinates {
    type Scalar = f64;
    type Scanline = u16;

    fn resolution(&self) -> Resolution {
        self.0
    }

    fn scanline(&self, y: u16) -> u16 {
        y
    }

    fn pixel_on(&self, y: &u16, x: u16) -> (Color<f64>, u32) {
        let level = |value: u16| f64::from(value) / 255.0;
        let color = Color::new(level(x % 256), level(y % 256), level((x / 256) ^ (y / 256)));
        // An uneven price, so that budgets of rays end anywhere.
        (color, u32::from(x % 3) + 1)
    }
}

fn budgets() -> Vec<Budget> {
    let mut budgets = vec![Budget::Unlimited];
    for amount in [
        1,
        2,
        3,
        7,
        36,
        37,
        38,
        74,
        100,
        850,
        851,
        852,
        5_000,
        u32::MAX,
    ] {
        budgets.extend([Budget::Rays(amount), Budget::Pixels(amount)]);
    }
    budgets
}

#[test]
fn parts_of_rows_have_the_bits_of_their_pixels() {
    let pools = pools();
    let picture = Picture::<_, Exact<Rgb888>>::new(tracer(&pools));
    let expected = Expected::of(&picture);
    for y in 0..SIZE.height {
        for (start, length) in [(0, 37), (0, 1), (0, 0), (1, 36), (5, 7), (36, 1), (30, 7)] {
            let mut buffer = vec![UNTRACED; length];
            picture.row(start, y, &mut buffer);
            for (x, color) in (i32::from(start)..).zip(&buffer) {
                assert_eq!(*color, expected.get(x, y.into()), "pixel ({x}, {y})");
            }
        }
    }
}

#[test]
fn a_row_counts_its_rays() {
    let pools = pools();
    let picture = Picture::<_, Exact<Rgb888>>::new(tracer(&pools));
    let mut row = [UNTRACED; 37];
    let whole = picture.row(0, 12, &mut row);
    let (left, right) = row.split_at_mut(20);
    assert_eq!(picture.row(0, 12, left) + picture.row(20, 12, right), whole);
    // Primary rays, and shadow rays where anything is hit.
    assert!(whole > 37, "{whole}");
}

#[test]
fn drawing_takes_one_call_a_row_and_each_pixel_once() {
    let pools = pools();
    let source = Counted::new(tracer(&pools));
    let picture = Picture::<_, Exact<Rgb565>>::new(&source);
    let expected = Expected::of(&picture);
    source.pixels.set(0);
    let mut canvas = Canvas::new(SIZE.width, SIZE.height);
    picture.draw(&mut canvas).unwrap();
    expected.assert_drawn(&canvas, picture.bounding_box(), "drawn");
    assert_rows(&canvas, picture.bounding_box());
    assert_eq!(source.pixels.get(), 37 * 23);
}

/// One `fill_contiguous` a row, from the top, and no other call.
#[track_caller]
fn assert_rows<C: PixelColor>(canvas: &Canvas<C>, area: Rectangle) {
    let rows: Vec<_> = area
        .rows()
        .map(|y| rectangle(area.top_left.x, y, area.size.width, 1))
        .collect();
    assert_eq!(canvas.fills, rows);
    assert_eq!(canvas.other_calls, 0);
}

#[test]
fn a_frame_with_a_row_of_buffer_takes_one_call_a_row() {
    let pools = pools();
    let source = Counted::new(tracer(&pools));
    let picture = Picture::<_, Exact<Rgb888>>::new(&source);
    let expected = Expected::of(&picture);
    for length in [37, 38, 500] {
        for budget in [Budget::Unlimited, Budget::Rays(40), Budget::Pixels(5)] {
            source.pixels.set(0);
            let how = format!("buffer of {length}, {budget:?}");
            let mut canvas = Canvas::new(SIZE.width, SIZE.height);
            draw_all(&picture, &mut canvas, &mut vec![UNTRACED; length], budget);
            expected.assert_drawn(&canvas, picture.bounding_box(), &how);
            assert_rows(&canvas, picture.bounding_box());
            assert_eq!(source.pixels.get(), 37 * 23, "{how}: pixels traced");
        }
    }
}

/// Draws a whole frame in instalments of `budget`; returns how many there were.
fn draw_all<P, Q, D>(
    picture: &Picture<P, Q>,
    display: &mut D,
    buffer: &mut [Q::Color],
    budget: Budget,
) -> u32
where
    P: PixelSource,
    Q: Quantizer,
    D: DrawTarget<Color = Q::Color>,
    D::Error: std::fmt::Debug,
{
    let mut frame = Frame::of(picture);
    let mut instalments = 1;
    while frame.draw(picture, display, buffer, budget).unwrap() != Progress::Done {
        instalments += 1;
        assert!(instalments < 1_000_000, "{budget:?} never ends: {frame:?}");
    }
    instalments
}

#[test]
fn buffers_and_budgets_of_any_size_give_the_same_picture() {
    let picture = Picture::<_, Exact<Rgb888>>::new(Coordinates(SIZE));
    let expected = Expected::of(&picture);
    for length in 0..=40 {
        for budget in budgets() {
            let how = format!("buffer of {length}, {budget:?}");
            let mut canvas = Canvas::new(SIZE.width, SIZE.height);
            let instalments = draw_all(&picture, &mut canvas, &mut vec![UNTRACED; length], budget);
            expected.assert_drawn(&canvas, picture.bounding_box(), &how);
            assert_eq!(canvas.other_calls, 0, "{how}");
            match budget {
                Budget::Unlimited => assert_eq!(instalments, 1, "{how}"),
                // The last instalment may find nothing left to trace.
                Budget::Pixels(pixels) => {
                    let least = (37 * 23_u32).div_ceil(pixels);
                    assert!(
                        (least..=least + 1).contains(&instalments),
                        "{how}: {instalments}"
                    );
                }
                _ => {}
            }
        }
    }
}

#[test]
fn traced_scenes_do_not_depend_on_budgets_either() {
    for name in scenes::names() {
        let pools: ScenePools = scenes::load(&name);
        let picture = Picture::<_, Exact<Rgb888>>::new(tracer(&pools)).dithered();
        let expected = Expected::of(&picture);
        for (length, budget) in [
            (37, Budget::Rays(50)),
            (16, Budget::Pixels(11)),
            (1, Budget::Rays(1)),
        ] {
            let how = format!("{name}, buffer of {length}, {budget:?}");
            let mut canvas = Canvas::new(SIZE.width, SIZE.height);
            draw_all(&picture, &mut canvas, &mut vec![UNTRACED; length], budget);
            expected.assert_drawn(&canvas, picture.bounding_box(), &how);
        }
    }
}

#[test]
fn an_empty_buffer_traces_each_pixel_once_and_keeps_to_the_budget() {
    let source = Counted::new(Coordinates(SIZE));
    let picture = Picture::<_, Exact<Rgb888>>::new(&source);
    let mut canvas = Canvas::new(SIZE.width, SIZE.height);
    let mut frame = Frame::of(&picture);
    let progress = frame
        .draw(&picture, &mut canvas, &mut [], Budget::Pixels(10))
        .unwrap();
    assert_eq!(
        progress,
        Progress::SoFar {
            pixels: 10,
            of: 851
        }
    );
    assert_eq!((canvas.drawn(), source.pixels.get()), (10, 10));
    let progress = frame.draw(&picture, &mut canvas, &mut [], Budget::Unlimited);
    assert_eq!(progress, Ok(Progress::Done));
    assert_eq!((canvas.drawn(), source.pixels.get()), (851, 851));
}

#[test]
fn a_spent_budget_traces_nothing() {
    let source = Counted::new(Coordinates(SIZE));
    let picture = Picture::<_, Exact<Rgb888>>::new(&source);
    let mut canvas = Canvas::new(SIZE.width, SIZE.height);
    let mut frame = Frame::of(&picture);
    for budget in [Budget::Pixels(0), Budget::Rays(0)] {
        for length in [0, 1, 5, 37] {
            let mut buffer = vec![UNTRACED; length];
            let progress = frame.draw(&picture, &mut canvas, &mut buffer, budget);
            assert_eq!(progress, Ok(Progress::SoFar { pixels: 0, of: 851 }));
            assert_eq!(
                (canvas.drawn(), source.pixels.get()),
                (0, 0),
                "buffer of {length}, {budget:?}"
            );
        }
    }
}

#[test]
fn progress_counts_pixels_and_a_budget_of_pixels_is_kept() {
    let picture = Picture::<_, Exact<Rgb888>>::new(Coordinates(SIZE));
    let mut frame = Frame::of(&picture);
    let mut canvas = Canvas::new(SIZE.width, SIZE.height);
    let mut buffer = [UNTRACED; 37];
    assert_eq!(frame.progress(), Progress::SoFar { pixels: 0, of: 851 });
    for (amount, total) in [(10, 10), (27, 37), (1, 38), (800, 838)] {
        let progress = frame.draw(&picture, &mut canvas, &mut buffer, Budget::Pixels(amount));
        assert_eq!(
            progress,
            Ok(Progress::SoFar {
                pixels: total,
                of: 851
            })
        );
        assert_eq!(frame.progress(), progress.unwrap());
        // Whole stretches only are on the display.
        assert_eq!(canvas.drawn(), total as usize / 37 * 37);
    }
    let progress = frame.draw(&picture, &mut canvas, &mut buffer, Budget::Pixels(13));
    assert_eq!(progress, Ok(Progress::Done));
    assert_eq!(frame.progress(), Progress::Done);
    // A frame that is done draws nothing more.
    let fills = canvas.fills.len();
    let progress = frame.draw(&picture, &mut canvas, &mut buffer, Budget::Unlimited);
    assert_eq!(progress, Ok(Progress::Done));
    assert_eq!(canvas.fills.len(), fills);
}

#[test]
fn a_budget_of_rays_is_exceeded_by_one_pixel_at_most() {
    let picture = Picture::<_, Exact<Rgb888>>::new(Coordinates(SIZE));
    let price = |x: u32| x % 37 % 3 + 1;
    for amount in [1, 2, 5, 50, 75] {
        let mut frame = Frame::of(&picture);
        let mut canvas = Canvas::new(SIZE.width, SIZE.height);
        let mut buffer = [UNTRACED; 37];
        let mut before = 0;
        while let Ok(Progress::SoFar { pixels, .. }) =
            frame.draw(&picture, &mut canvas, &mut buffer, Budget::Rays(amount))
        {
            let rays: u32 = (before..pixels).map(price).sum();
            let without_last = rays - price(pixels - 1);
            assert!(
                rays >= amount && without_last < amount,
                "{rays} rays of {amount}"
            );
            before = pixels;
        }
    }
}

#[test]
fn bands_and_rectangles_have_the_bits_of_the_whole() {
    let pools = pools();
    let picture = Picture::<_, Exact<Rgb565>>::new(tracer(&pools));
    let expected = Expected::of(&picture);
    let random = Random::of_test(57);
    let mut areas: Vec<Rectangle> = (0..23).map(|y| rectangle(0, y, 37, 1)).collect();
    areas.extend((0..37).map(|x| rectangle(x, 0, 1, 23)));
    areas.extend([
        rectangle(0, 0, 37, 12),
        rectangle(0, 12, 37, 11),
        rectangle(0, 0, 0, 0),
        rectangle(3, 3, 0, 5),
        rectangle(3, 3, 5, 0),
        // What lies outside the picture is not drawn.
        rectangle(-5, -7, 10, 10),
        rectangle(30, 20, 100, 100),
        rectangle(-100, -100, 1_000, 1_000),
        rectangle(37, 0, 5, 5),
        rectangle(0, 23, 5, 5),
        rectangle(-9, 4, 9, 3),
    ]);
    for _ in 0..60 {
        areas.push(rectangle(
            random.below(45) as i32 - 4,
            random.below(30) as i32 - 4,
            random.below(40) as u32,
            random.below(30) as u32,
        ));
    }
    for area in areas {
        let inside = area.intersection(&picture.bounding_box());
        let count = inside.size.width * inside.size.height;
        let length = random.below(41);
        let budget = Budget::Pixels(1 + random.below(100) as u32);
        let how = format!("{area:?}, buffer of {length}, {budget:?}");
        let mut frame = Frame::of_area(&picture, area);
        let so_far = Progress::SoFar {
            pixels: 0,
            of: count,
        };
        let progress = if count == 0 { Progress::Done } else { so_far };
        assert_eq!(frame.progress(), progress, "{how}");
        if count > 0 {
            assert_eq!(frame.area(), inside, "{how}");
        }
        let mut canvas = Canvas::new(SIZE.width, SIZE.height);
        let mut buffer = vec![Rgb565::new(31, 0, 31); length];
        while frame
            .draw(&picture, &mut canvas, &mut buffer, budget)
            .unwrap()
            != Progress::Done
        {}
        expected.assert_drawn(&canvas, inside, &how);
    }
}

#[test]
fn a_frame_may_be_stopped_copied_resumed_and_rewound() {
    let pools = pools();
    let picture = Picture::<_, Exact<Rgb888>>::new(tracer(&pools));
    let expected = Expected::of(&picture);
    let whole = picture.bounding_box();
    for stop_after in [1, 36, 37, 40, 400, 850] {
        let how = format!("stopped after {stop_after} pixels");
        let mut buffer = [UNTRACED; 37];
        let mut canvas = Canvas::new(SIZE.width, SIZE.height);
        let mut frame = Frame::of(&picture);
        frame
            .draw(
                &picture,
                &mut canvas,
                &mut buffer,
                Budget::Pixels(stop_after),
            )
            .unwrap();
        // A copy of the few words of state goes on where the frame stopped, in a copy of the buffer.
        let (mut copy, mut canvas_of_copy) = (frame, canvas.clone());
        let mut buffer_of_copy = buffer;
        copy.draw(
            &picture,
            &mut canvas_of_copy,
            &mut buffer_of_copy,
            Budget::Unlimited,
        )
        .unwrap();
        expected.assert_drawn(&canvas_of_copy, whole, &how);
        // The frame itself is aimed anew.
        let mut again = frame.rewound();
        assert_eq!(again, Frame::of(&picture));
        let mut fresh = Canvas::new(SIZE.width, SIZE.height);
        again
            .draw(&picture, &mut fresh, &mut buffer, Budget::Unlimited)
            .unwrap();
        expected.assert_drawn(&fresh, whole, &how);
        assert_eq!(again.rewound(), frame.rewound());
    }
}

/// Traces a frame into buffers and copies each stretch to where it belongs.
#[track_caller]
fn assert_traced<C: PixelColor + std::fmt::Debug>(
    canvas: &mut Canvas<C>,
    stretch: Rectangle,
    colors: &[C],
) {
    assert_eq!(stretch.size.height, 1);
    assert_eq!(stretch.size.width as usize, colors.len());
    canvas
        .fill_contiguous(&stretch, colors.iter().copied())
        .unwrap();
}

#[test]
fn two_buffers_take_turns() {
    let pools = pools();
    let picture = Picture::<_, Exact<Rgb565>>::new(tracer(&pools));
    let expected = Expected::of(&picture);
    let mut frame = Frame::of(&picture);
    let mut canvas = Canvas::new(SIZE.width, SIZE.height);
    let mut buffers = [[Rgb565::new(31, 0, 31); 37]; 2];
    let mut turn = 0;
    while frame.progress() != Progress::Done {
        let mut budget = Budget::Pixels(10);
        if let Some((stretch, colors)) = frame.trace(&picture, &mut buffers[turn], &mut budget) {
            assert_traced(&mut canvas, stretch, colors);
            turn = 1 - turn;
        }
    }
    expected.assert_drawn(&canvas, picture.bounding_box(), "two buffers");
}

#[test]
fn once_a_stretch_is_complete_a_buffer_of_another_length_may_follow() {
    let picture = Picture::<_, Exact<Rgb888>>::new(Coordinates(SIZE));
    let expected = Expected::of(&picture);
    for lengths in [[5, 3], [3, 5], [10, 37], [37, 10], [1, 36]] {
        let how = format!("buffers of {lengths:?}");
        let mut frame = Frame::of(&picture);
        let mut canvas = Canvas::new(SIZE.width, SIZE.height);
        let mut turn = 0;
        while frame.progress() != Progress::Done {
            let mut buffer = vec![UNTRACED; lengths[turn % 2]];
            let (stretch, colors) = frame
                .trace(&picture, &mut buffer, &mut Budget::Unlimited)
                .expect("a complete stretch");
            assert_traced(&mut canvas, stretch, colors);
            turn += 1;
        }
        expected.assert_drawn(&canvas, picture.bounding_box(), &how);
    }
}

#[test]
fn threads_that_share_the_picture_draw_the_same_bits() {
    for name in ["default", "mirror-room"] {
        let pools: ScenePools = scenes::load(name);
        let picture = Picture::<_, Exact<Rgb888>>::new(tracer(&pools));
        let expected = Expected::of(&picture);
        for threads in [1, 2, 3, 5, 8, 23, 40] {
            let mut pixels = vec![UNTRACED; expected.pixels.len()];
            let rows_of_each = usize::from(SIZE.height).div_ceil(threads);
            let width = usize::from(SIZE.width);
            std::thread::scope(|scope| {
                for (band, rows) in pixels.chunks_mut(rows_of_each * width).enumerate() {
                    let picture = &picture;
                    scope.spawn(move || {
                        for (i, row) in rows.chunks_mut(width).enumerate() {
                            picture.row(0, (band * rows_of_each + i) as u16, row);
                        }
                    });
                }
            });
            assert!(pixels == expected.pixels, "{name}, {threads} threads");
        }
    }
}

#[test]
fn frames_of_bands_on_threads_draw_the_same_bits() {
    let pools = pools();
    let picture = Picture::<_, Exact<Rgb565>>::new(tracer(&pools));
    let expected = Expected::of(&picture);
    for rows in [1, 4, 23] {
        let bands: Vec<_> = (0..23).step_by(rows).collect();
        std::thread::scope(|scope| {
            let drawn: Vec<_> = bands
                .iter()
                .map(|&top| {
                    let area = rectangle(0, top, 37, rows as u32);
                    let picture = &picture;
                    scope.spawn(move || {
                        let mut canvas = Canvas::new(SIZE.width, SIZE.height);
                        let mut buffer = [Rgb565::new(31, 0, 31); 16];
                        let mut frame = Frame::of_area(picture, area);
                        while frame.draw(picture, &mut canvas, &mut buffer, Budget::Rays(70))
                            != Ok(Progress::Done)
                        {}
                        (canvas, frame.area())
                    })
                })
                .collect();
            for thread in drawn {
                let (canvas, area) = thread.join().unwrap();
                expected.assert_drawn(&canvas, area, &format!("bands of {rows} rows"));
            }
        });
    }
}

/// MockDisplay panics when a pixel is drawn twice or outside of its 64×64 pixels.
#[test]
fn a_mock_display_sees_every_pixel_exactly_once() {
    fn check<C>(draw: impl Fn(&mut MockDisplay<C>), expected: &Expected<C>)
    where
        C: PixelColor + embedded_graphics::mock_display::ColorMapping + std::fmt::Debug,
    {
        let mut display = MockDisplay::new();
        draw(&mut display);
        for y in 0..64 {
            for x in 0..64 {
                let inside =
                    x < i32::from(expected.size.width) && y < i32::from(expected.size.height);
                let color = inside.then(|| expected.get(x, y));
                assert_eq!(
                    display.get_pixel(Point::new(x, y)),
                    color,
                    "pixel ({x}, {y})"
                );
            }
        }
    }

    let pools = pools();
    for (width, height) in [(64, 64), (64, 48), (37, 23), (1, 64), (64, 1), (1, 1)] {
        let tracer = tracer(&pools).with_resolution(Resolution { width, height });
        let colors = Picture::<_, Exact<Rgb565>>::new(&tracer);
        let expected = Expected::of(&colors);
        check(|display| colors.draw(display).unwrap(), &expected);
        for (length, budget) in [
            (64, Budget::Unlimited),
            (10, Budget::Rays(33)),
            (0, Budget::Pixels(7)),
        ] {
            let draw = |display: &mut MockDisplay<_>| {
                draw_all(&colors, display, &mut vec![UNTRACED.into(); length], budget);
            };
            check(draw, &expected);
        }
        let bits = Picture::<_, Exact<BinaryColor>>::new(&tracer).dithered();
        check(|display| bits.draw(display).unwrap(), &Expected::of(&bits));
    }
}

#[test]
fn a_display_smaller_than_the_picture_costs_only_what_it_shows() {
    let source = Counted::new(Coordinates(SIZE));
    let picture = Picture::<_, Exact<Rgb888>>::new(&source);
    let expected = Expected::of(&picture);
    for area in [
        rectangle(0, 0, 10, 8),
        rectangle(0, 0, 37, 1),
        rectangle(0, 0, 100, 5),
        rectangle(5, 7, 10, 4),
        rectangle(-3, -2, 10, 8),
        rectangle(30, 20, 100, 100),
        rectangle(-50, -50, 200, 200),
        rectangle(37, 0, 5, 5),
        rectangle(0, 23, 5, 5),
        rectangle(0, 0, 0, 0),
        rectangle(4, 4, 0, 9),
    ] {
        source.pixels.set(0);
        let mut canvas = Canvas::with_area(area);
        picture.draw(&mut canvas).unwrap();
        let shown = area.intersection(&picture.bounding_box());
        expected.assert_drawn(&canvas, shown, &format!("display {area:?}"));
        if shown.size.width == 0 {
            assert!(canvas.fills.is_empty(), "display {area:?}");
        } else {
            assert_rows(&canvas, shown);
        }
        let count = shown.size.width * shown.size.height;
        assert_eq!(
            source.pixels.get(),
            count,
            "display {area:?}: pixels traced"
        );
    }
}

#[test]
fn cropped_and_moved_displays_show_their_part() {
    let picture = Picture::<_, Exact<Rgb888>>::new(Coordinates(SIZE));
    let expected = Expected::of(&picture);
    let mut canvas = Canvas::new(60, 40);
    picture
        .draw(&mut canvas.translated(Point::new(20, 10)))
        .unwrap();
    assert_eq!(canvas.drawn(), 37 * 23);
    assert_eq!(canvas.get(20, 10), Some(expected.get(0, 0)));
    assert_eq!(canvas.get(56, 32), Some(expected.get(36, 22)));
    let mut canvas = Canvas::new(37, 23);
    let crop = rectangle(4, 3, 10, 9);
    picture.draw(&mut canvas.clipped(&crop)).unwrap();
    expected.assert_drawn(&canvas, crop, "clipped");
}

#[test]
fn an_error_of_the_display_comes_back_unchanged_and_drawing_again_completes_the_picture() {
    let pools = pools();
    let picture = Picture::<_, Exact<Rgb565>>::new(tracer(&pools));
    let expected = Expected::of(&picture);
    let whole = picture.bounding_box();
    for fails_at in [0, 1, 11, 22] {
        let mut display = FailingDisplay::new(Canvas::new(SIZE.width, SIZE.height), fails_at);
        assert_eq!(picture.draw(&mut display), Err(BusError { call: fails_at }));
        // What came before is there, and nothing after the error was tried.
        assert_eq!(
            (display.calls, display.canvas.drawn()),
            (fails_at + 1, fails_at * 37)
        );
        assert_eq!(picture.draw(&mut display), Ok(()));
        expected.assert_shown(&display.canvas, whole, &format!("call {fails_at} failed"));
    }
}

#[test]
fn a_frame_repeats_the_stretch_that_the_display_refused() {
    let source = Counted::new(Coordinates(SIZE));
    let picture = Picture::<_, Exact<Rgb888>>::new(&source);
    let expected = Expected::of(&picture);
    for length in [0, 1, 10, 37, 50] {
        for budget in [Budget::Unlimited, Budget::Rays(9), Budget::Pixels(37)] {
            let calls_a_row = 37_usize.div_ceil(length.clamp(1, 37));
            for fails_at in [0, 1, calls_a_row, 23 * calls_a_row - 1] {
                let how = format!("buffer of {length}, {budget:?}, call {fails_at} failed");
                let mut display =
                    FailingDisplay::new(Canvas::new(SIZE.width, SIZE.height), fails_at);
                let mut buffer = vec![UNTRACED; length];
                let mut frame = Frame::of(&picture);
                let mut errors = Vec::new();
                loop {
                    match frame.draw(&picture, &mut display, &mut buffer, budget) {
                        Ok(Progress::Done) => break,
                        Ok(_) => {}
                        Err(error) => {
                            errors.push(error);
                            assert_ne!(frame.progress(), Progress::Done, "{how}");
                            // The buffer is the caller's: it may have been used for something else.
                            buffer.fill(UNTRACED);
                        }
                    }
                }
                assert_eq!(errors, [BusError { call: fails_at }], "{how}");
                // Nothing but the refused stretch was sent twice.
                assert_eq!(display.calls, 23 * calls_a_row + 1, "{how}");
                expected.assert_drawn(&display.canvas, picture.bounding_box(), &how);
            }
        }
    }
}

#[test]
fn the_largest_picture_has_its_last_pixels() {
    let size = Resolution {
        width: 65_535,
        height: 65_535,
    };
    let picture = Picture::<_, Exact<Rgb888>>::new(Coordinates(size));
    let mut row = vec![UNTRACED; 65_535];
    let mut frame = Frame::of_area(&picture, rectangle(65_530, 65_533, 100, 100));
    assert_eq!(frame.area(), rectangle(65_530, 65_533, 5, 2));
    let mut stretches = Vec::new();
    while let Some((stretch, colors)) = frame.trace(&picture, &mut row, &mut Budget::Unlimited) {
        stretches.push(stretch);
        for (x, color) in stretch.columns().zip(colors) {
            let y = stretch.top_left.y;
            assert_eq!(
                *color,
                picture.pixel(x as u16, y as u16),
                "pixel ({x}, {y})"
            );
        }
    }
    assert_eq!(
        stretches,
        [
            rectangle(65_530, 65_533, 5, 1),
            rectangle(65_530, 65_534, 5, 1)
        ]
    );
    let mut frame = Frame::of(&picture);
    let of = 65_535 * 65_535;
    assert_eq!(frame.progress(), Progress::SoFar { pixels: 0, of });
    frame.trace(&picture, &mut row, &mut Budget::Pixels(65_536));
    assert_eq!(frame.progress(), Progress::SoFar { pixels: 65_535, of });
    // A row that is asked for beyond the last column ends there.
    let mut tail = [UNTRACED; 4];
    picture.row(65_534, 0, &mut tail);
    assert_eq!(tail[0], picture.pixel(65_534, 0));
}

#[test]
fn a_picture_without_pixels_is_done_at_once() {
    for (width, height) in [(0, 0), (0, 5), (5, 0)] {
        let source = Counted::new(Coordinates(Resolution { width, height }));
        let picture = Picture::<_, Exact<Rgb888>>::new(&source);
        let mut frame = Frame::of(&picture);
        assert_eq!(frame.progress(), Progress::Done);
        let mut canvas = Canvas::new(10, 10);
        for length in [0, 3] {
            let mut buffer = vec![UNTRACED; length];
            let progress = frame.draw(&picture, &mut canvas, &mut buffer, Budget::Unlimited);
            assert_eq!(progress, Ok(Progress::Done));
        }
        picture.draw(&mut canvas).unwrap();
        assert_eq!((canvas.drawn(), source.pixels.get()), (0, 0));
    }
}

#[test]
fn a_shorter_buffer_in_the_middle_of_a_stretch_loses_nothing() {
    let source = Coordinates(SIZE);
    let picture = Picture::<_, Exact<Rgb888>>::new(&source);
    let expected = Expected::of(&picture);
    let random = Random::of_test(77);
    for _ in 0..50 {
        let mut canvas = Canvas::new(SIZE.width, SIZE.height);
        let mut frame = Frame::of(&picture);
        let mut buffer = [Rgb888::new(0, 0, 0); 37];
        for _ in 0..1_000_000 {
            let length = random.below(buffer.len() + 1);
            let budget = Budget::Pixels(1 + random.below(60) as u32);
            let progress = frame
                .draw(&picture, &mut canvas, &mut buffer[..length], budget)
                .unwrap();
            if progress == Progress::Done {
                break;
            }
        }
        assert_eq!(frame.progress(), Progress::Done);
        assert_eq!(
            canvas.drawn(),
            usize::from(SIZE.width) * usize::from(SIZE.height)
        );
        // Where a buffer became shorter, what the longer one held is traced again.
        assert_eq!(canvas.overdrawn, 0);
        expected.assert_drawn(&canvas, picture.bounding_box(), "buffers of any length");
    }
}

#[test]
fn areas_at_the_ends_of_their_range_are_cut_to_the_picture() {
    let source = Coordinates(SIZE);
    let picture = Picture::<_, Exact<Rgb888>>::new(&source);
    let huge = Size::new(u32::MAX, u32::MAX);
    let place =
        |x, y, size| Frame::of_area(&picture, Rectangle::new(Point::new(x, y), size)).area();
    assert_eq!(place(i32::MIN, i32::MIN, huge), picture.bounding_box());
    assert_eq!(
        place(5, 7, huge),
        rectangle(5, 7, u32::from(SIZE.width) - 5, u32::from(SIZE.height) - 7)
    );
    assert!(place(i32::MAX, 0, Size::new(9, 9)).is_zero_sized());
    assert!(place(0, i32::MAX, huge).is_zero_sized());
}
