//! PNG, 8 bits a channel.

use std::io::{self, Cursor, Write};

use png::{BitDepth, ColorType, Decoder, Encoder, Transformations};

use super::{Image, SMALLER};
use crate::picture_memory::room;

/// What a picture looks like with pixels that are not opaque depends on what is behind.
const TRANSLUCENT: &str = "it has transparent pixels; flatten it onto a colour first";

/// The keyword of a text chunk.
const COMMENT: &str = "Comment";

pub(super) fn write(
    file: &mut dyn Write,
    width: u16,
    height: u16,
    comment: Option<&str>,
    rows: &mut dyn Iterator<Item = Vec<u8>>,
) -> io::Result<()> {
    let mut encoder = Encoder::new(file, width.into(), height.into());
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    if let Some(comment) = comment {
        encoder.add_text_chunk(COMMENT.to_owned(), comment.to_owned())?;
    }
    let mut png = encoder.write_header()?;
    let mut stream = png.stream_writer()?;
    for row in rows {
        stream.write_all(&row)?;
    }
    stream.finish()?;
    Ok(png.finish()?)
}

/// The text chunk named so.
pub(super) fn comment(bytes: &[u8]) -> Option<String> {
    let reader = Decoder::new(Cursor::new(bytes)).read_info().ok()?;
    let mut chunks = reader.info().uncompressed_latin1_text.iter();
    let chunk = chunks.find(|chunk| chunk.keyword == COMMENT)?;
    Some(chunk.text.clone())
}

/// Reads a PNG of any kind: grey and palettes become colours, 16 bits are rounded to 8.
///
/// # Errors
///
/// A sentence, also for pixels that are not opaque: what they look like depends on what is behind.
pub(super) fn read(bytes: &[u8]) -> Result<Image, String> {
    let mut decoder = Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(|error| error.to_string())?;
    let size = reader
        .output_buffer_size()
        .ok_or("the picture is too large for this machine")?;
    let mut samples: Vec<u8> = room(size, "the picture", SMALLER)?;
    samples.resize(size, 0);
    let frame = reader
        .next_frame(&mut samples)
        .map_err(|error| error.to_string())?;
    samples.truncate(frame.buffer_size());
    if frame.bit_depth == BitDepth::Sixteen {
        // An alpha that is only nearly opaque must not become so.
        let level = |sample: &[u8]| {
            let value = u32::from(sample[0]) << 8 | u32::from(sample[1]);
            ((value * 255 + 32_767) / 65_535) as u8
        };
        let is_translucent = |pixel: &[u8]| pixel[pixel.len() - 2..] != [u8::MAX; 2];
        let has_alpha = matches!(
            frame.color_type,
            ColorType::GrayscaleAlpha | ColorType::Rgba
        );
        if has_alpha
            && samples
                .chunks_exact(2 * frame.color_type.samples())
                .any(is_translucent)
        {
            return Err(TRANSLUCENT.to_owned());
        }
        samples = samples.chunks_exact(2).map(level).collect();
    }
    let gray = |gray: u8| [gray; 3];
    let (channels, has_alpha) = match frame.color_type {
        ColorType::Grayscale => (1, false),
        ColorType::GrayscaleAlpha => (2, true),
        ColorType::Rgb => (3, false),
        ColorType::Rgba => (4, true),
        // Palettes are expanded.
        ColorType::Indexed => return Err("the palette is missing".to_owned()),
    };
    let pixels = samples.chunks_exact(channels);
    if has_alpha && pixels.clone().any(|pixel| pixel[channels - 1] != u8::MAX) {
        return Err(TRANSLUCENT.to_owned());
    }
    let rgb888 = match channels {
        3 => samples,
        4 => pixels
            .flat_map(|pixel| [pixel[0], pixel[1], pixel[2]])
            .collect(),
        _ => pixels.flat_map(|pixel| gray(pixel[0])).collect(),
    };
    Ok(Image {
        width: frame.width as usize,
        height: frame.height as usize,
        rgb888,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn encode(color: ColorType, depth: BitDepth, palette: Option<&[u8]>, data: &[u8]) -> Vec<u8> {
        let mut file = Vec::new();
        let mut encoder = Encoder::new(&mut file, 2, 1);
        encoder.set_color(color);
        encoder.set_depth(depth);
        if let Some(palette) = palette {
            encoder.set_palette(palette.to_vec());
        }
        let mut writer = encoder.write_header().unwrap();
        writer.write_image_data(data).unwrap();
        writer.finish().unwrap();
        file
    }

    #[test]
    fn all_kinds_become_rgb888() {
        use BitDepth::{Eight, One, Sixteen};
        let colors = [1, 2, 3, 4, 5, 6];
        let grays = [9, 9, 9, 200, 200, 200];
        for (color, depth, palette, data, expected) in [
            (ColorType::Rgb, Eight, None, &colors[..], colors),
            (
                ColorType::Rgba,
                Eight,
                None,
                &[1, 2, 3, 255, 4, 5, 6, 255],
                colors,
            ),
            (
                ColorType::Rgb,
                Sixteen,
                None,
                // 257 to a level of 8 bits, so that 128 more are nearer to it, 129 to the next.
                &[1, 1, 2, 130, 2, 131, 4, 4, 4, 133, 6, 134],
                colors,
            ),
            (
                ColorType::GrayscaleAlpha,
                Sixteen,
                None,
                &[8, 137, 255, 255, 200, 72, 255, 255],
                grays,
            ),
            (
                ColorType::Indexed,
                Eight,
                Some(&[4, 5, 6, 1, 2, 3][..]),
                &[1, 0],
                colors,
            ),
            (ColorType::Grayscale, Eight, None, &[9, 200], grays),
            (
                ColorType::GrayscaleAlpha,
                Eight,
                None,
                &[9, 255, 200, 255],
                grays,
            ),
            (
                ColorType::Grayscale,
                One,
                None,
                &[0b0100_0000],
                [0, 0, 0, 255, 255, 255],
            ),
        ] {
            let image = read(&encode(color, depth, palette, data)).unwrap();
            assert_eq!((image.width, image.height), (2, 1));
            assert_eq!(image.rgb888, expected, "{color:?} {depth:?}");
        }
    }

    #[test]
    fn transparent_pixels_are_refused() {
        let file = encode(
            ColorType::GrayscaleAlpha,
            BitDepth::Eight,
            None,
            &[9, 255, 0, 254],
        );
        assert!(read(&file).unwrap_err().contains("transparent"));
        // Not quite opaque.
        let file = encode(
            ColorType::GrayscaleAlpha,
            BitDepth::Sixteen,
            None,
            &[9, 9, 255, 255, 0, 0, 255, 254],
        );
        assert!(read(&file).unwrap_err().contains("transparent"));
    }
}
