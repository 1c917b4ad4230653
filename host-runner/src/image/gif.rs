//! GIF: one picture or several, each with a palette of at most 256 colours of its own.

use std::borrow::Cow;
use std::collections::{BTreeSet, HashMap};
use std::io;

use color_quant::NeuQuant;
use gif::{DisposalMethod, Encoder, Frame, Repeat};

/// Colours of a palette.
const PALETTE: usize = 256;

/// Of so many pixels one is looked at when a palette is chosen; 1 is the best and slowest.
const SAMPLING: i32 = 3;

/// Pictures of the same size, encoded into memory one after the other.
pub(crate) struct Animation {
    encoder: Encoder<Vec<u8>>,
    width: u16,
    height: u16,
    /// How long each picture is shown, in hundredths of a second.
    delay: u16,
}

impl Animation {
    /// No pictures yet. They will be repeated for ever, unless there is only one.
    ///
    /// # Errors
    ///
    /// None: nothing but memory is written to.
    pub(crate) fn new([width, height]: [u16; 2], delay: u16) -> io::Result<Self> {
        let mut encoder = Encoder::new(Vec::new(), width, height, &[]).map_err(io::Error::other)?;
        encoder
            .set_repeat(Repeat::Infinite)
            .map_err(io::Error::other)?;
        Ok(Self {
            encoder,
            width,
            height,
            delay,
        })
    }

    /// Appends a picture: all its pixels, three bytes each. Up to 256 different colours are kept exactly;
    /// more become the 256 that a neural network settles on.
    ///
    /// # Errors
    ///
    /// None: nothing but memory is written to.
    pub(crate) fn add(&mut self, rgb888: &[u8]) -> io::Result<()> {
        let (palette, indices) = exact(rgb888).unwrap_or_else(|| approximate(rgb888));
        let frame = Frame {
            width: self.width,
            height: self.height,
            delay: self.delay,
            dispose: DisposalMethod::Keep,
            palette: Some(palette),
            buffer: Cow::Owned(indices),
            ..Frame::default()
        };
        self.encoder.write_frame(&frame).map_err(io::Error::other)
    }

    /// The file.
    ///
    /// # Errors
    ///
    /// None: nothing but memory is written to.
    pub(crate) fn finish(self) -> io::Result<Vec<u8>> {
        self.encoder.into_inner().map_err(io::Error::other)
    }
}

/// The colours themselves, in order, and the index of each pixel's, if a palette has room for all.
fn exact(rgb888: &[u8]) -> Option<(Vec<u8>, Vec<u8>)> {
    let mut colors = BTreeSet::new();
    for pixel in rgb888.chunks_exact(3) {
        if colors.insert(pixel) && colors.len() > PALETTE {
            return None;
        }
    }
    let index_of: HashMap<&[u8], u8> = colors.iter().copied().zip(0..=u8::MAX).collect();
    let indices = rgb888.chunks_exact(3).map(|pixel| index_of[pixel]);
    Some((
        colors
            .iter()
            .flat_map(|color| color.iter().copied())
            .collect(),
        indices.collect(),
    ))
}

/// 256 colours near all others, and the index of the one nearest to each pixel.
fn approximate(rgb888: &[u8]) -> (Vec<u8>, Vec<u8>) {
    let rgba: Vec<u8> = rgb888
        .chunks_exact(3)
        .flat_map(|pixel| [pixel[0], pixel[1], pixel[2], u8::MAX])
        .collect();
    let network = NeuQuant::new(SAMPLING, PALETTE, &rgba);
    let mut known = HashMap::new();
    let indices = rgba.chunks_exact(4).map(|pixel| {
        *known
            .entry(pixel)
            .or_insert_with(|| network.index_of(pixel) as u8)
    });
    let indices = indices.collect();
    (network.color_map_rgb(), indices)
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
        let mut animation = Animation::new(size, 7).unwrap();
        for picture in pictures {
            animation.add(picture).unwrap();
        }
        animation.finish().unwrap()
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
