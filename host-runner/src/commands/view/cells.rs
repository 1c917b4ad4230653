//! A picture in the cells of a terminal, which are about twice as high as wide: two pixels each.

use std::fmt::Write;

use scanray::Resolution;

use super::screen::Pixels;

/// How a cell shows its pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Style {
    /// As upper half block, in the 24-bit colours of both.
    Blocks,
    /// As a letter that is as dense as their mean is bright, without any colour.
    Letters,
}

/// Letters from dark to bright, on a dark ground.
const LETTERS: &[u8] = b" .:-=+*#%@";

/// Back to the terminal's own colours.
const RESET: &str = "\x1b[0m";

/// The size of a picture of these proportions that fills the cells one way.
pub(super) fn filling(proportions: Resolution, columns: u16, lines: u16) -> Resolution {
    let [width, height] = [proportions.width, proportions.height].map(u64::from);
    let (most_wide, most_high) = (u64::from(columns.max(1)), 2 * u64::from(lines.max(1)));
    let scaled = |length: u64, to: u64, from: u64| (length * to + from / 2) / from;
    let (width, height) = if most_wide * height <= most_high * width {
        (most_wide, scaled(height, most_wide, width))
    } else {
        (scaled(width, most_high, height), most_high)
    };
    Resolution {
        width: width.max(1) as u16,
        height: height.clamp(1, u64::from(u16::MAX)) as u16,
    }
}

/// A line of text for each row of cells, without line ends. The colours are reset in each.
pub(super) fn lines(pixels: &Pixels, style: Style) -> Vec<String> {
    (0..pixels.height.div_ceil(2))
        .map(|row| match style {
            Style::Blocks => blocks(pixels, row),
            Style::Letters => letters(pixels, row),
        })
        .collect()
}

fn blocks(pixels: &Pixels, row: usize) -> String {
    let mut line = String::new();
    let mut before = (None, None);
    for x in 0..pixels.width {
        let (upper, lower) = (pixels.get(x, 2 * row), pixels.get(x, 2 * row + 1));
        // Writing to a string cannot fail.
        if let Some([r, g, b]) = upper.filter(|_| upper != before.0) {
            let _ = write!(line, "\x1b[38;2;{r};{g};{b}m");
        }
        if let Some([r, g, b]) = lower.filter(|_| lower != before.1) {
            let _ = write!(line, "\x1b[48;2;{r};{g};{b}m");
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
            lines(&pixels, Style::Blocks),
            [
                "\x1b[38;2;1;2;3m\x1b[48;2;4;5;6m▀\x1b[48;2;7;8;9m▀\x1b[0m",
                "\x1b[38;2;0;0;0m▀▀\x1b[0m"
            ]
        );
    }
}
