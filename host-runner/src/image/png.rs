//! PNG, 8 bits a channel.

use std::io::{self, Write};

use png::{BitDepth, ColorType, Encoder};

pub(super) fn write(
    file: &mut dyn Write,
    width: u16,
    height: u16,
    rows: &mut dyn Iterator<Item = Vec<u8>>,
) -> io::Result<()> {
    let mut encoder = Encoder::new(file, width.into(), height.into());
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    let mut png = encoder.write_header()?;
    let mut stream = png.stream_writer()?;
    for row in rows {
        stream.write_all(&row)?;
    }
    stream.finish()?;
    Ok(png.finish()?)
}
