//! Image files, written row by row.

mod png;
mod ppm;

use std::io::{self, Write};
use std::path::Path;

/// A kind of image file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ImageFormat {
    /// Binary PPM (P6).
    Ppm,
    /// PNG with 8 bits a channel.
    Png,
}

impl ImageFormat {
    /// The format that a file's extension stands for.
    pub(crate) fn of(path: &Path) -> Option<Self> {
        let extension = path.extension()?;
        if extension.eq_ignore_ascii_case("ppm") {
            Some(Self::Ppm)
        } else if extension.eq_ignore_ascii_case("png") {
            Some(Self::Png)
        } else {
            None
        }
    }
}

/// Writes an image of `width` × `height` pixels: `rows` has as many, three bytes a pixel.
///
/// # Errors
///
/// Those of `file`.
pub(crate) fn write(
    format: ImageFormat,
    file: &mut dyn Write,
    [width, height]: [u16; 2],
    rows: &mut dyn Iterator<Item = Vec<u8>>,
) -> io::Result<()> {
    match format {
        ImageFormat::Ppm => ppm::write(file, width, height, rows),
        ImageFormat::Png => png::write(file, width, height, rows),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_extension_decides() {
        let of = |path: &str| ImageFormat::of(Path::new(path));
        assert_eq!(of("a.ppm"), Some(ImageFormat::Ppm));
        assert_eq!(of("dir.x/a.b.PNG"), Some(ImageFormat::Png));
        assert_eq!(of("a.jpg"), None);
        assert_eq!(of("ppm"), None);
        assert_eq!(of(".png"), None);
    }

    #[test]
    fn both_formats_hold_the_same_pixels() {
        let rows = [[1, 2, 3, 4, 5, 6], [7, 8, 9, 250, 251, 252]];
        let write = |format| {
            let mut file = Vec::new();
            let mut rows = rows.iter().map(|row| row.to_vec());
            super::write(format, &mut file, [2, 2], &mut rows).unwrap();
            file
        };
        let ppm = write(ImageFormat::Ppm);
        assert_eq!(ppm, [&b"P6\n2 2\n255\n"[..], &rows.concat()].concat());
        let png = write(ImageFormat::Png);
        let mut reader = ::png::Decoder::new(io::Cursor::new(png))
            .read_info()
            .unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut pixels).unwrap();
        assert_eq!((info.width, info.height), (2, 2));
        assert_eq!(pixels, rows.concat());
    }
}
