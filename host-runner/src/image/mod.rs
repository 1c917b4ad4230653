//! Image files: written row by row, read whole.

mod gif;
mod palette;
mod png;
mod ppm;

use std::fmt::Display;
use std::fs::File;
use std::io::{self, Read, Write};
use std::path::Path;

pub(crate) use self::gif::{Animation, require_memory as require_gif_memory};
use crate::console::shown;
use crate::failure::Failure;

/// A kind of image file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ImageFormat {
    /// Binary PPM (P6).
    Ppm,
    /// PNG with 8 bits a channel.
    Png,
    /// GIF with at most 256 colours a picture.
    Gif,
}

impl ImageFormat {
    /// All there are.
    pub const ALL: &[Self] = &[Self::Ppm, Self::Png, Self::Gif];

    /// Those that keep every colour.
    pub const EXACT: &[Self] = &[Self::Ppm, Self::Png];

    /// The extension of its files.
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Ppm => "ppm",
            Self::Png => "png",
            Self::Gif => "gif",
        }
    }

    /// The format that a file's extension stands for.
    pub fn of(path: &Path) -> Option<Self> {
        let extension = path.extension()?;
        let mut formats = Self::ALL.iter().copied();
        formats.find(|format| extension.eq_ignore_ascii_case(format.extension()))
    }
}

/// A picture from a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// Pixels in a row; at least 1.
    pub width: usize,
    /// Rows; at least 1.
    pub height: usize,
    /// Three bytes a pixel, rows from top to bottom.
    pub rgb888: Vec<u8>,
}

/// No file is longer than this: no picture that is drawn here is (65,535² pixels would be), but nobody
/// compares such pictures, and an endless file must not fill all of the memory.
const MAX_FILE_BYTES: u64 = 4 << 30;

/// What takes less memory.
const SMALLER: &str = "take a smaller picture";

impl Image {
    /// Reads a PNG or PPM file, whatever its name; `-` is standard input.
    ///
    /// # Errors
    ///
    /// [`Failure::Files`].
    pub fn read(path: &Path) -> Result<Self, Failure> {
        let is_stdin = path.as_os_str() == "-";
        let name = if is_stdin {
            "<stdin>".into()
        } else {
            shown(path)
        };
        let cannot = |why: &dyn Display| Failure::Files(format!("cannot read {name}: {why}"));
        let mut bytes = Vec::new();
        let input: &mut dyn Read = if is_stdin {
            &mut io::stdin().lock()
        } else {
            &mut File::open(path).map_err(|error| cannot(&error))?
        };
        input
            .take(MAX_FILE_BYTES)
            .read_to_end(&mut bytes)
            .map_err(|error| cannot(&error))?;
        Self::decode(&bytes).map_err(|why| cannot(&why))
    }

    /// A picture from the bytes of a file.
    ///
    /// # Errors
    ///
    /// A sentence.
    pub fn decode(bytes: &[u8]) -> Result<Self, String> {
        match bytes {
            [0x89, b'P', b'N', b'G', ..] => png::read(bytes),
            [b'P', b'2' | b'3' | b'5' | b'6', ..] => ppm::read(bytes),
            [] => Err("the file is empty".to_owned()),
            _ => Err("this is neither a PNG nor a PPM picture".to_owned()),
        }
    }
}

/// The comment that [`write()`] has put into a file.
pub fn comment(file: &[u8]) -> Option<String> {
    match file {
        [0x89, b'P', b'N', b'G', ..] => png::comment(file),
        _ => ppm::comment(file),
    }
}

/// Writes an image of `width` × `height` pixels: `rows` has as many, three bytes a pixel. The comment is a
/// line of ASCII; a GIF has none, and its pixels are kept in memory.
///
/// # Errors
///
/// Those of `file`, and a shortage of memory.
pub fn write(
    format: ImageFormat,
    file: &mut dyn Write,
    [width, height]: [u16; 2],
    comment: Option<&str>,
    rows: &mut dyn Iterator<Item = Vec<u8>>,
) -> io::Result<()> {
    match format {
        ImageFormat::Ppm => ppm::write(file, width, height, comment, rows),
        ImageFormat::Png => png::write(file, width, height, comment, rows),
        ImageFormat::Gif => {
            let mut animation = Animation::new(file, [width, height], 0)?;
            animation.add(rows)?;
            animation.finish()
        }
    }
}

/// Writes a picture of any size.
///
/// # Errors
///
/// Those of `file`.
pub fn write_whole(format: ImageFormat, file: &mut dyn Write, image: &Image) -> io::Result<()> {
    let size = [image.width, image.height].map(u16::try_from);
    let [Ok(width), Ok(height)] = size else {
        return Err(io::Error::other("it would be larger than 65535 pixels"));
    };
    let mut rows = image
        .rgb888
        .chunks_exact(image.width * 3)
        .map(<[u8]>::to_vec);
    write(format, file, [width, height], None, &mut rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_extension_decides() {
        let of = |path: &str| ImageFormat::of(Path::new(path));
        assert_eq!(of("a.ppm"), Some(ImageFormat::Ppm));
        assert_eq!(of("dir.x/a.b.PNG"), Some(ImageFormat::Png));
        assert_eq!(of("a.Gif"), Some(ImageFormat::Gif));
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
            super::write(format, &mut file, [2, 2], None, &mut rows).unwrap();
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

    #[test]
    fn comments_are_read() {
        for format in [ImageFormat::Ppm, ImageFormat::Png] {
            for words in [Some("one=1 two"), None] {
                let mut file = Vec::new();
                let mut lines = [vec![35, 10, 35, 32, 49, 10]].into_iter();
                write(format, &mut file, [2, 1], words, &mut lines).unwrap();
                assert_eq!(comment(&file).as_deref(), words, "{format:?}");
                assert_eq!(Image::decode(&file).unwrap().rgb888[..3], [35, 10, 35]);
            }
        }
        assert_eq!(comment(b"P6 #"), None);
        assert_eq!(comment(b""), None);
    }

    #[test]
    fn what_was_written_is_read() {
        let rows = [[1, 2, 3, 32, 10, 35], [7, 8, 9, 250, 251, 252]];
        for format in [ImageFormat::Ppm, ImageFormat::Png] {
            let mut file = Vec::new();
            let mut lines = rows.iter().map(|row| row.to_vec());
            write(format, &mut file, [2, 2], None, &mut lines).unwrap();
            let image = Image::decode(&file).unwrap();
            assert_eq!((image.width, image.height), (2, 2));
            assert_eq!(image.rgb888, rows.concat());
            for cut in 0..file.len() {
                let why = Image::decode(&file[..cut]);
                // The last bytes of a PNG are its end marker, which holds no pixels.
                let is_whole = format == ImageFormat::Png && cut + 20 > file.len();
                assert!(is_whole || why.is_err(), "{format:?} {cut}");
            }
        }
        assert!(Image::decode(b"GIF89a").unwrap_err().contains("neither"));
    }
}
