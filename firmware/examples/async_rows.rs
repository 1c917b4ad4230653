//! An async task that draws a row and yields, beside another task that gets its turn after each.

#![no_std]
#![no_main]

use core::sync::atomic::{AtomicU32, Ordering};

use board::console;
use embassy_executor::{Executor, Spawner};
use embassy_futures::yield_now;
use embedded_graphics::{
    pixelcolor::{Rgb888, RgbColor},
    prelude::*,
};
use scanray::{
    Picture, Resolution, Scene,
    render::{Budget, Frame, Progress},
    tracer_for,
};
use scanray_firmware::hash::Hash;

board::entry!(program, Option<Executor> = None);

static SCENE: Scene<'static> = include!(concat!(env!("OUT_DIR"), "/scene.rs"));

/// How often the other task had its turn.
static TURNS: AtomicU32 = AtomicU32::new(0);

fn program(executor: &'static mut Option<Executor>) -> Result<(), &'static str> {
    executor.insert(Executor::new()).run(|spawner: Spawner| {
        spawner.spawn(draw().expect("spawned once"));
        spawner.spawn(other_work().expect("spawned once"));
    })
}

#[embassy_executor::task]
async fn draw() {
    let tracer = tracer_for!(SCENE).with_resolution(Resolution {
        width: 160,
        height: 120,
    });
    let picture = Picture::new(&tracer);
    let mut display = Hash::new(picture.bounding_box().size);
    let mut row = [Rgb888::BLACK; 160];
    let mut frame = Frame::of(&picture);
    while frame.draw(&picture, &mut display, &mut row, Budget::Pixels(160)) != Ok(Progress::Done) {
        yield_now().await;
    }
    display.print();
    console::decimal("turns ", TURNS.load(Ordering::Relaxed));
    board::exit(Ok(()));
}

#[embassy_executor::task]
async fn other_work() {
    loop {
        TURNS.fetch_add(1, Ordering::Relaxed);
        yield_now().await;
    }
}
