//! Pictures of 8 bits a channel: PNG files, comparison, difference.

use std::fs::File;
use std::io::{BufReader, BufWriter};
use std::path::Path;

use scanray::Resolution;

/// A picture of red, green and blue bytes, row by row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Rgb {
    pub(crate) size: Resolution,
    pub(crate) pixels: Vec<[u8; 3]>,
}

impl Rgb {
    /// The picture of a function of column and row.
    pub(crate) fn from_fn(size: Resolution, mut pixel: impl FnMut(u16, u16) -> [u8; 3]) -> Self {
        let pixels = (0..size.height)
            .flat_map(|y| (0..size.width).map(move |x| (x, y)))
            .map(|(x, y)| pixel(x, y))
            .collect();
        Self { size, pixels }
    }

    pub(crate) fn read_png(file: &Path) -> Result<Self, String> {
        let describe = |error: &dyn std::fmt::Display| format!("{}: {error}", file.display());
        let input = BufReader::new(File::open(file).map_err(|e| describe(&e))?);
        let mut reader = png::Decoder::new(input)
            .read_info()
            .map_err(|e| describe(&e))?;
        let length = reader
            .output_buffer_size()
            .ok_or_else(|| describe(&"too large"))?;
        let mut bytes = vec![0; length];
        let info = reader.next_frame(&mut bytes).map_err(|e| describe(&e))?;
        if (info.color_type, info.bit_depth) != (png::ColorType::Rgb, png::BitDepth::Eight) {
            return Err(describe(&"not a picture of RGB bytes"));
        }
        let (pixels, _) = bytes.as_chunks::<3>();
        Ok(Self {
            size: Resolution {
                width: info.width as u16,
                height: info.height as u16,
            },
            pixels: pixels.to_vec(),
        })
    }

    pub(crate) fn write_png(&self, file: &Path) {
        let written = (|| {
            std::fs::create_dir_all(file.parent().expect("a file in a folder"))?;
            let output = BufWriter::new(File::create(file)?);
            let (width, height) = (self.size.width.into(), self.size.height.into());
            let mut encoder = png::Encoder::new(output, width, height);
            encoder.set_color(png::ColorType::Rgb);
            encoder.set_depth(png::BitDepth::Eight);
            encoder.set_compression(png::Compression::High);
            let mut writer = encoder.write_header()?;
            writer.write_image_data(self.pixels.as_flattened())?;
            writer.finish()
        })();
        if let Err(error) = written {
            panic!("{}: {error}", file.display());
        }
    }

    /// A picture of where two pictures of one size differ: dim grey where they agree, bright in the
    /// channels that do not.
    pub(crate) fn difference(&self, other: &Self) -> Self {
        let pixel = |(a, b): (&[u8; 3], &[u8; 3])| {
            if a == b {
                let grey = a.iter().map(|&channel| u16::from(channel)).sum::<u16>() / 12;
                return [grey as u8; 3];
            }
            std::array::from_fn(|i| match a[i].abs_diff(b[i]) {
                0 => 0,
                difference => difference.saturating_mul(8).saturating_add(120),
            })
        };
        Self {
            size: self.size,
            pixels: self.pixels.iter().zip(&other.pixels).map(pixel).collect(),
        }
    }

    /// What differs between two pictures, in words; `None` if nothing does.
    pub(crate) fn describe_difference(&self, expected: &Self) -> Option<String> {
        if self.size != expected.size {
            return Some(format!(
                "is {}×{} instead of {}×{} pixels",
                self.size.width, self.size.height, expected.size.width, expected.size.height
            ));
        }
        let mut count = 0;
        let mut worst = 0;
        let mut first = None;
        for (i, (is, was)) in self.pixels.iter().zip(&expected.pixels).enumerate() {
            if is != was {
                let levels = is.iter().zip(was).map(|(a, b)| a.abs_diff(*b)).max();
                worst = worst.max(levels.unwrap_or(0));
                count += 1;
                first.get_or_insert((i, is, was));
            }
        }
        first.map(|(i, is, was)| {
            let width = usize::from(self.size.width);
            format!(
                "differs in {count} of {} pixels by up to {worst} levels, first at column {} of row {}: \
                 {is:?} instead of {was:?}",
                self.pixels.len(),
                i % width,
                i / width,
            )
        })
    }
}
