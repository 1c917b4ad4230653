//! What the boards must draw and print, from the host:
//!
//! * `reference hash SCENE…`: the CRC-32 of each scene's picture, a line each, every object tested for every ray;
//! * `reference cutoff SCENE`: the CRC-32 of its picture without the rays that hardly show, by the cut-off 1/256;
//! * `reference oled SCENE`: the picture on the OLED, dithered, as a text PGM;
//! * `reference rejected`: the messages for the bad scenes.

use std::{env, error::Error, fs, io::Write as _};

use embedded_graphics::pixelcolor::{Gray4, GrayColor, Rgb888, RgbColor};
use scanray::{
    Picture, Resolution, ScenePools, Tracer,
    render::{Exact, PixelSource},
};

#[path = "../../src/bad_scenes.rs"]
mod bad_scenes;
#[path = "../../board/src/crc32.rs"]
mod crc32;

use bad_scenes::{BAD_SCENES, SPHERES};

type Pools = ScenePools<f32, 1024, 1024, 1024, 1024>;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["hash", ref scenes @ ..] => scenes.iter().try_for_each(|path| {
            println!("{:08x}", hash(path, None)?);
            Ok(())
        }),
        ["cutoff", scene] => {
            println!("{:08x}", hash(scene, Some(1.0 / 256.0))?);
            Ok(())
        }
        ["oled", scene] => oled(scene),
        ["rejected"] => rejected(),
        _ => Err("reference hash SCENE… | cutoff SCENE | oled SCENE | rejected".into()),
    }
}

fn parse(path: &str) -> Result<Box<Pools>, Box<dyn Error>> {
    let mut pools = Box::new(Pools::new());
    let text = fs::read(path).map_err(|error| format!("{path}: {error}"))?;
    pools
        .parse(&text)
        .map_err(|error| format!("{path}: {error}"))?;
    Ok(pools)
}

fn hash(path: &str, cutoff: Option<f32>) -> Result<u32, Box<dyn Error>> {
    let pools = parse(path)?;
    let resolution = Resolution {
        width: 160,
        height: 120,
    };
    let tracer = Tracer::new(pools.as_scene()).with_resolution(resolution);
    Ok(match cutoff {
        Some(cutoff) => hash_of(tracer.with_cutoff(cutoff)),
        None => hash_of(tracer),
    })
}

fn hash_of(source: impl PixelSource) -> u32 {
    let picture: Picture<_, Exact<Rgb888>> = Picture::new(source);
    let mut row = [Rgb888::BLACK; 160];
    let mut crc = crc32::Crc32::new();
    for y in 0..picture.resolution().height {
        picture.row(0, y, &mut row);
        for pixel in row {
            for byte in [pixel.r(), pixel.g(), pixel.b()] {
                crc.byte(byte);
            }
        }
    }
    crc.value()
}

fn oled(path: &str) -> Result<(), Box<dyn Error>> {
    let pools = parse(path)?;
    let resolution = Resolution {
        width: 128,
        height: 64,
    };
    let tracer = Tracer::new(pools.as_scene()).with_resolution(resolution);
    let picture = Picture::<_, Exact<Gray4>>::new(&tracer).dithered();
    let mut row = [Gray4::BLACK; 128];
    let mut out = std::io::stdout().lock();
    writeln!(out, "P2\n128 64\n15")?;
    for y in 0..resolution.height {
        picture.row(0, y, &mut row);
        writeln!(
            out,
            "{}",
            row.map(|pixel| pixel.luma().to_string()).join(" ")
        )?;
    }
    Ok(())
}

fn rejected() -> Result<(), Box<dyn Error>> {
    let mut pools = ScenePools::<f32, SPHERES>::new();
    for text in BAD_SCENES {
        match pools.parse(text) {
            Ok(_) => return Err("a bad scene was accepted".into()),
            Err(error) => println!("{error}"),
        }
    }
    Ok(())
}
