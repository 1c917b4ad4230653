//! GIF: one picture or several, each with a palette of at most 256 colours of its own.

use std::borrow::Cow;
use std::collections::{BTreeSet, HashMap};
use std::io::{self, Write};

use gif::{DisposalMethod, Encoder, EncodingError, Frame, Repeat};

use super::palette::{PLACES, nearest, palette};
use crate::picture_memory::{Shortage, require, room};

/// All colours of 8 bits a channel.
const COLORS: usize = 1 << 24;

/// Bytes that a pixel takes while it is encoded: its colour, its index, and the codes, of at most 12 bits.
const PIXEL_BYTES: u64 = 4 + 1 + 2;

/// What takes less memory.
const REMEDY: &str =
    "draw it smaller with --size, or into .ppm or .png files, which are written row by row";

/// Pictures of the same size, written into a file one after the other.
pub(crate) struct Animation<'w> {
    encoder: Encoder<&'w mut dyn Write>,
    width: u16,
    height: u16,
    /// How long each picture is shown, in hundredths of a second.
    delay: u16,
}

/// Makes sure that there is memory for a picture of this size, all of which is looked at before any is written.
///
/// # Errors
///
/// [`Shortage`].
pub(crate) fn require_memory([width, height]: [u16; 2]) -> Result<(), Shortage> {
    let pixels = u64::from(width) * u64::from(height);
    // The index of each colour, for pictures of many.
    let bytes = PIXEL_BYTES * pixels + 2 * COLORS as u64;
    require(
        bytes,
        format_args!("a GIF of {width}x{height} pixels"),
        REMEDY,
    )
}

impl<'w> Animation<'w> {
    /// No pictures yet. They will be repeated for ever, unless there is only one.
    ///
    /// # Errors
    ///
    /// Those of `file`, and a [`Shortage`] of memory.
    pub(crate) fn new(
        file: &'w mut dyn Write,
        [width, height]: [u16; 2],
        delay: u16,
    ) -> io::Result<Self> {
        require_memory([width, height])?;
        let mut encoder = Encoder::new(file, width, height, &[]).map_err(io_error)?;
        encoder.set_repeat(Repeat::Infinite).map_err(io_error)?;
        Ok(Self {
            encoder,
            width,
            height,
            delay,
        })
    }

    /// Appends a picture: all its rows, three bytes a pixel. Up to 256 different colours are kept exactly;
    /// more become the 256 that lie nearest to all.
    ///
    /// # Errors
    ///
    /// Those of the file, and a [`Shortage`] of memory.
    pub(crate) fn add(&mut self, rows: &mut dyn Iterator<Item = Vec<u8>>) -> io::Result<()> {
        let (width, height) = (self.width, self.height);
        let pixels = usize::from(width) * usize::from(height);
        let what = format_args!("a GIF of {width}x{height} pixels");
        let mut rgba = room(4 * pixels, what, REMEDY)?;
        for row in rows {
            let pixels = row.chunks_exact(3);
            rgba.extend(pixels.flat_map(|pixel| [pixel[0], pixel[1], pixel[2], u8::MAX]));
        }
        let mut indices = room(pixels, what, REMEDY)?;
        let palette = match exact(&rgba, &mut indices) {
            Some(palette) => palette,
            None => approximate(&rgba, &mut indices)?,
        };
        drop(rgba);
        let frame = Frame {
            width,
            height,
            delay: self.delay,
            dispose: DisposalMethod::Keep,
            palette: Some(palette),
            buffer: Cow::Owned(indices),
            ..Frame::default()
        };
        self.encoder.write_frame(&frame).map_err(io_error)
    }

    /// Ends the file.
    ///
    /// # Errors
    ///
    /// Those of the file.
    pub(crate) fn finish(self) -> io::Result<()> {
        self.encoder.into_inner().map(drop).map_err(io_error)
    }
}

fn io_error(error: EncodingError) -> io::Error {
    match error {
        EncodingError::Io(error) => error,
        other => io::Error::other(other),
    }
}

/// The colours themselves, in order, and the index of each pixel's, if a palette has room for all.
fn exact(rgba: &[u8], indices: &mut Vec<u8>) -> Option<Vec<u8>> {
    let mut colors = BTreeSet::new();
    for pixel in rgba.chunks_exact(4) {
        if colors.insert(pixel) && colors.len() > PLACES {
            return None;
        }
    }
    let index_of: HashMap<&[u8], u8> = colors.iter().copied().zip(0..=u8::MAX).collect();
    indices.extend(rgba.chunks_exact(4).map(|pixel| index_of[pixel]));
    let rgb = colors.iter().flat_map(|color| color[..3].iter().copied());
    Some(rgb.collect())
}

/// 256 colours near all others, and the index of the one nearest to each pixel.
fn approximate(rgba: &[u8], indices: &mut Vec<u8>) -> Result<Vec<u8>, Shortage> {
    let pixels = rgba
        .chunks_exact(4)
        .map(|pixel| [pixel[0], pixel[1], pixel[2]]);
    // One more than the index of each colour that was met before.
    require(2 * COLORS as u64, "a GIF of many colours", REMEDY)?;
    let mut known = vec![0_u16; COLORS];
    let palette = palette(pixels.clone());
    indices.extend(pixels.map(|rgb| {
        let [r, g, b] = rgb.map(usize::from);
        let known = &mut known[r << 16 | g << 8 | b];
        if *known == 0 {
            *known = 1 + nearest(&palette, rgb) as u16;
        }
        (*known - 1) as u8
    }));
    Ok(palette.concat())
}

#[cfg(test)]
mod tests {
    use super::*;
    use gif::{ColorOutput, DecodeOptions};

    /// The pictures of a file and the delay of each.
    fn decoded(file: &[u8]) -> Vec<(Vec<u8>, u16)> {
        let mut options = DecodeOptions::new();
        options.set_color_output(ColorOutput::RGBA);
        let mut decoder = options.read_info(file).unwrap();
        let mut pictures = Vec::new();
        while let Some(frame) = decoder.read_next_frame().unwrap() {
            let pixels = frame.buffer.chunks_exact(4);
            let rgb888 = pixels.flat_map(|p| [p[0], p[1], p[2]]).collect();
            pictures.push((rgb888, frame.delay));
        }
        pictures
    }

    fn encoded(size: [u16; 2], pictures: &[&[u8]]) -> Vec<u8> {
        let mut file = Vec::new();
        let mut animation = Animation::new(&mut file, size, 7).unwrap();
        for picture in pictures {
            let rows = picture.chunks_exact(3 * usize::from(size[0]));
            animation.add(&mut rows.map(<[u8]>::to_vec)).unwrap();
        }
        animation.finish().unwrap();
        file
    }

    #[test]
    fn few_colours_are_kept_exactly() {
        // One colour, two, and all there is room for.
        let one = [9; 3 * 256];
        let two: Vec<u8> = (0..256).flat_map(|i| [[0; 3], [255; 3]][i % 2]).collect();
        let all: Vec<u8> = (0..=255).rev().flat_map(|i| [i, i / 2, 255 - i]).collect();
        let pictures = [&one[..], &two, &all];
        let expected: Vec<_> = pictures.iter().map(|p| (p.to_vec(), 7)).collect();
        assert!(decoded(&encoded([16, 16], &pictures)) == expected);
    }

    #[test]
    fn many_colours_are_near() {
        let picture: Vec<u8> = (0..64_u8 * 3)
            .flat_map(|y| (0..64 * 3).flat_map(move |x| [x, y, 128]))
            .collect();
        let [(drawn, _)] = &decoded(&encoded([192, 192], &[&picture]))[..] else {
            panic!("one picture");
        };
        let errors = || picture.iter().zip(drawn).map(|(a, b)| a.abs_diff(*b));
        let sum: u64 = errors().map(u64::from).sum();
        // 256 colours on a square of 192 levels are 12 apart.
        assert!(sum as f64 / picture.len() as f64 <= 3.0, "{sum}");
        assert!(errors().max() <= Some(24), "{:?}", errors().max());
    }
}
