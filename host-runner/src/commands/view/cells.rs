//! A picture in the cells of a terminal, which are about twice as high as wide: two pixels each, or eight dots.

use scanray::Resolution;

use super::screen::Pixels;

/// How a cell shows its pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Style {
    /// As upper half block, in the colours of both.
    Blocks(Colors),
    /// Eight pixels of black or white as the dots of a braille character.
    Dots(Colors),
    /// As a letter that is as dense as their mean is bright, without any colour.
    Letters,
}

/// Which colours a terminal has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Colors {
    /// 24 bits.
    All,
    /// The 256 of xterm: a cube of 6 levels a channel, and greys.
    Palette,
}

impl Style {
    /// Columns and rows of pixels in a cell.
    fn pixels(self) -> [u16; 2] {
        match self {
            Self::Blocks(_) | Self::Letters => [1, 2],
            Self::Dots(_) => [2, 4],
        }
    }

    /// The most pixels in so many cells, sideways and downwards.
    fn room(self, columns: u16, lines: u16) -> [u64; 2] {
        let [wide, high] = self.pixels().map(u64::from);
        [
            wide * u64::from(columns.max(1)),
            high * u64::from(lines.max(1)),
        ]
    }

    /// Whether a picture of this size fits into so many cells.
    pub(super) fn has_room(self, size: Resolution, columns: u16, lines: u16) -> bool {
        let [width, height] = self.room(columns, lines);
        u64::from(size.width) <= width && u64::from(size.height) <= height
    }
}

/// Letters from dark to bright, on a dark ground.
const LETTERS: &[u8] = b" .:-=+*#%@";

/// Back to the terminal's own colours.
const RESET: &str = "\x1b[0m";

/// The size of a picture of these proportions that fills the cells one way.
pub(super) fn filling(
    proportions: Resolution,
    style: Style,
    columns: u16,
    lines: u16,
) -> Resolution {
    let [width, height] = [proportions.width, proportions.height].map(u64::from);
    let [most_wide, most_high] = style.room(columns, lines);
    let scaled = |length: u64, to: u64, from: u64| (length * to + from / 2) / from;
    let (width, height) = if most_wide * height <= most_high * width {
        (most_wide, scaled(height, most_wide, width))
    } else {
        (scaled(width, most_high, height), most_high)
    };
    Resolution {
        width: width.clamp(1, u64::from(u16::MAX)) as u16,
        height: height.clamp(1, u64::from(u16::MAX)) as u16,
    }
}

/// A line of text for each row of cells, without line ends. The colours are reset in each.
pub(super) fn lines(pixels: &Pixels, style: Style) -> Vec<String> {
    let [_, high] = style.pixels().map(usize::from);
    (0..pixels.height.div_ceil(high))
        .map(|row| match style {
            Style::Blocks(colors) => blocks(pixels, row, colors),
            Style::Dots(colors) => dots(pixels, row, colors),
            Style::Letters => letters(pixels, row),
        })
        .collect()
}

/// The first of these numbers is of the foreground, 38, or of the background, 48.
fn color(ground: u8, [r, g, b]: [u8; 3], colors: Colors) -> String {
    match colors {
        Colors::All => format!("\x1b[{ground};2;{r};{g};{b}m"),
        Colors::Palette => format!("\x1b[{ground};5;{}m", nearest([r, g, b])),
    }
}

/// The number of the nearest of xterm's 256 colours, the first 16 aside, which users change.
fn nearest(rgb: [u8; 3]) -> u8 {
    const LEVELS: [u8; 6] = [0, 95, 135, 175, 215, 255];
    let distance = |other: [u8; 3]| -> u32 {
        let channels = rgb.into_iter().zip(other);
        channels.map(|(a, b)| u32::from(a.abs_diff(b)).pow(2)).sum()
    };
    let places = rgb.map(|level| {
        (0..6)
            .min_by_key(|i| LEVELS[*i].abs_diff(level))
            .unwrap_or(0)
    });
    let of_cube = places.map(|place| LEVELS[place]);
    let mean = rgb.into_iter().map(u32::from).sum::<u32>() / 3;
    // Greys are 8, 18, … 238.
    let grey = (mean.saturating_sub(3) / 10).min(23) as u8;
    if distance([8 + 10 * grey; 3]) < distance(of_cube) {
        return 232 + grey;
    }
    let [r, g, b] = places.map(|place| place as u8);
    16 + 36 * r + 6 * g + b
}

/// Braille characters, which have two columns of four dots each.
fn dots(pixels: &Pixels, row: usize, colors: Colors) -> String {
    // The bit of each dot in the character's number.
    const BITS: [[u32; 2]; 4] = [[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]];
    let is_lit = |x, y| pixels.get(x, y).is_some_and(|[_, green, _]| green > 127);
    let character = |column: usize| {
        let mut number = 0x2800;
        for (y, bits) in BITS.iter().enumerate() {
            for (x, bit) in bits.iter().enumerate() {
                if is_lit(2 * column + x, 4 * row + y) {
                    number |= bit;
                }
            }
        }
        char::from_u32(number).unwrap_or(' ')
    };
    let mut line = color(38, [255; 3], colors) + &color(48, [0; 3], colors);
    line.extend((0..pixels.width.div_ceil(2)).map(character));
    line + RESET
}

fn blocks(pixels: &Pixels, row: usize, colors: Colors) -> String {
    let mut line = String::new();
    let mut before = (None, None);
    for x in 0..pixels.width {
        let (upper, lower) = (pixels.get(x, 2 * row), pixels.get(x, 2 * row + 1));
        if let Some(rgb) = upper.filter(|_| upper != before.0) {
            line += &color(38, rgb, colors);
        }
        if let Some(rgb) = lower.filter(|_| lower != before.1) {
            line += &color(48, rgb, colors);
        }
        line.push('▀');
        before = (upper, lower);
    }
    line + RESET
}

fn letters(pixels: &Pixels, row: usize) -> String {
    let letter = |x| {
        let both = [2 * row, 2 * row + 1].map(|y| pixels.get(x, y));
        let lumas = both
            .into_iter()
            .flatten()
            .map(|[r, g, b]| (299 * u32::from(r) + 587 * u32::from(g) + 114 * u32::from(b)) / 1000);
        let (sum, count) = lumas.fold((0, 0), |(sum, count), luma| (sum + luma, count + 1));
        let luma = sum / count.max(1);
        char::from(LETTERS[luma as usize * LETTERS.len() / 256])
    };
    let line: String = (0..pixels.width).map(letter).collect();
    line.trim_end().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_fill_one_way_and_fit_the_other() {
        let filling = |w, h, columns, lines| {
            let size = filling(
                Resolution {
                    width: w,
                    height: h,
                },
                Style::Letters,
                columns,
                lines,
            );
            (size.width, size.height)
        };
        assert_eq!(filling(800, 600, 80, 23), (61, 46));
        assert_eq!(filling(800, 600, 40, 100), (40, 30));
        assert_eq!(filling(1, 65_535, 80, 24), (1, 48));
        assert_eq!(filling(65_535, 1, 80, 24), (80, 1));
        assert_eq!(filling(8, 6, 0, 0), (1, 1));
    }

    #[test]
    fn no_colour_of_the_palette_is_nearer() {
        let palette = |index: u8| match index {
            232.. => [8 + 10 * (index - 232); 3],
            _ => [36, 6, 1].map(|weight| match (index - 16) / weight % 6 {
                0 => 0,
                level => 55 + 40 * level,
            }),
        };
        let distance = |a: [u8; 3], b: [u8; 3]| -> u32 {
            let channels = a.into_iter().zip(b);
            channels.map(|(a, b)| u32::from(a.abs_diff(b)).pow(2)).sum()
        };
        let levels = || (0..=255_u8).step_by(15);
        for r in levels() {
            for g in levels() {
                for b in levels().chain([r]) {
                    let rgb = [r, g, b];
                    let least = (16..=255).map(|index| distance(palette(index), rgb)).min();
                    assert_eq!(Some(distance(palette(nearest(rgb)), rgb)), least, "{rgb:?}");
                }
            }
        }
    }

    #[test]
    fn dots_are_pixels() {
        let mut pixels = Pixels::new(Resolution {
            width: 3,
            height: 5,
        })
        .unwrap();
        // The upper left, the lower right of the first cell, and the last.
        for index in [0, 3 * 3 + 1, 14] {
            pixels.rgb[index] = [255; 3];
        }
        let colors = "\x1b[38;5;231m\x1b[48;5;16m";
        assert_eq!(
            lines(&pixels, Style::Dots(Colors::Palette)),
            [format!("{colors}⢁⠀{RESET}"), format!("{colors}⠀⠁{RESET}")]
        );
    }

    #[test]
    fn letters_are_dense_where_it_is_bright() {
        let mut pixels = Pixels::new(Resolution {
            width: 3,
            height: 3,
        })
        .unwrap();
        pixels.rgb[0] = [255; 3];
        pixels.rgb[3] = [255; 3];
        pixels.rgb[1] = [255; 3];
        pixels.rgb[8] = [255; 3];
        assert_eq!(lines(&pixels, Style::Letters), ["@=", "  @"]);
    }

    #[test]
    fn blocks_change_colours_only_where_they_change() {
        let mut pixels = Pixels::new(Resolution {
            width: 2,
            height: 3,
        })
        .unwrap();
        pixels.rgb = vec![[1, 2, 3], [1, 2, 3], [4, 5, 6], [7, 8, 9], [0; 3], [0; 3]];
        assert_eq!(
            lines(&pixels, Style::Blocks(Colors::All)),
            [
                "\x1b[38;2;1;2;3m\x1b[48;2;4;5;6m▀\x1b[48;2;7;8;9m▀\x1b[0m",
                "\x1b[38;2;0;0;0m▀▀\x1b[0m"
            ]
        );
    }
}
