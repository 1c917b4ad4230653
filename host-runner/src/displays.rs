//! Displays that people own, by the names of their controllers or, for e-paper, of their sizes.

use std::io::{self, Write};

use clap::ValueEnum;
use clap::builder::PossibleValue;
use scanray::Resolution;

use crate::option_values::{ColorName, name_of};

/// What a display shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Display {
    /// Its name on the command line.
    name: &'static str,
    width: u16,
    height: u16,
    pub(crate) color: ColorName,
    /// Whether so few colours are better dithered.
    pub(crate) dither: bool,
    /// What it is.
    what: &'static str,
    /// Other sizes that panels with the same controller have, for `--size`.
    also: &'static str,
}

/// What `--display` names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum DisplayChoice {
    /// The list of all displays.
    List,
    /// A display.
    Of(Display),
}

use ColorName::{Binary, Gray4, Rgb565, Rgb666};

/// The list, and then all displays, from few pixels to many within a kind.
#[rustfmt::skip]
const CHOICES: [DisplayChoice; 22] = [
    DisplayChoice::List,
    // Monochrome and grey OLED.
    of("ssd1306",   128,  64, Binary, "monochrome OLED", "128x32, 64x48, 72x40"),
    of("sh1106",    128,  64, Binary, "monochrome OLED", ""),
    of("ssd0323",   128,  64, Gray4,  "grey OLED, as on the board LM3S6965EVB", ""),
    of("ssd1327",   128, 128, Gray4,  "grey OLED", "128x96"),
    of("ssd1322",   256,  64, Gray4,  "grey OLED", ""),
    // Monochrome LCD.
    of("pcd8544",    84,  48, Binary, "monochrome LCD of the Nokia 5110", ""),
    of("st7920",    128,  64, Binary, "monochrome LCD", ""),
    of("ls027b7dh01", 400, 240, Binary, "reflective LCD, as in the Playdate", ""),
    // Colour OLED.
    of("ssd1331",    96,  64, Rgb565, "colour OLED", ""),
    of("ssd1351",   128, 128, Rgb565, "colour OLED", "128x96"),
    // Colour TFT.
    of("st7735",    160, 128, Rgb565, "colour TFT", "128x160, 160x80, 128x128"),
    of("gc9a01",    240, 240, Rgb565, "round colour TFT", ""),
    of("st7789",    320, 240, Rgb565, "colour TFT", "240x320, 240x240, 240x135, 320x170"),
    of("ili9341",   320, 240, Rgb565, "colour TFT", "240x320"),
    of("ili9486",   480, 320, Rgb666, "colour TFT", "320x480"),
    // E-paper, named as in the crate epd-waveshare.
    of("epd1in54",  200, 200, Binary, "e-paper of 1.54 inches", ""),
    of("epd2in13",  250, 122, Binary, "e-paper of 2.13 inches", "122x250"),
    of("epd2in9",   296, 128, Binary, "e-paper of 2.9 inches", "128x296"),
    of("epd4in2",   400, 300, Binary, "e-paper of 4.2 inches", ""),
    of("epd5in83",  648, 480, Binary, "e-paper of 5.83 inches", ""),
    of("epd7in5",   800, 480, Binary, "e-paper of 7.5 inches", "640x384"),
];

/// A display; all of them have few enough colours to be dithered.
const fn of(
    name: &'static str,
    width: u16,
    height: u16,
    color: ColorName,
    what: &'static str,
    also: &'static str,
) -> DisplayChoice {
    DisplayChoice::Of(Display {
        name,
        width,
        height,
        color,
        dither: true,
        what,
        also,
    })
}

impl Display {
    /// Its size, held as it is mostly held.
    pub(crate) const fn resolution(&self) -> Resolution {
        Resolution {
            width: self.width,
            height: self.height,
        }
    }

    /// Its size, colours and dither, in the words of the command line.
    fn figures(&self) -> String {
        let Self { width, height, .. } = self;
        let dither = if self.dither { " --dither" } else { "" };
        format!(
            "--size {width}x{height} --color {}{dither}",
            name_of(self.color)
        )
    }
}

impl ValueEnum for DisplayChoice {
    fn value_variants<'a>() -> &'a [Self] {
        &CHOICES
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(match self {
            Self::List => {
                PossibleValue::new("list").help("Print what each name stands for, and draw nothing")
            }
            Self::Of(display) => {
                let Display { width, height, .. } = display;
                let colors = name_of(display.color);
                let help = format!("{}, {width}x{height} {colors}", display.what);
                PossibleValue::new(display.name).help(help)
            }
        })
    }
}

/// Writes a line for each display.
///
/// # Errors
///
/// Those of `out`.
pub(crate) fn write_list(out: &mut dyn Write) -> io::Result<()> {
    let [name, figures, what] = ["NAME", "STANDS FOR", "WHAT IT IS"];
    writeln!(out, "{name:<11} {figures:<38} {what}")?;
    for choice in CHOICES {
        let DisplayChoice::Of(display) = choice else {
            continue;
        };
        let (figures, what) = (display.figures(), display.what);
        write!(out, "{:<11} {figures:<38} {what}", display.name)?;
        match display.also {
            "" => writeln!(out)?,
            also => writeln!(out, " (also {also})")?,
        }
    }
    writeln!(
        out,
        "\nOptions given beside --display win: --display st7789 --size 240x240 --dither=off"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_sizes_are_sizes() {
        for choice in CHOICES {
            let DisplayChoice::Of(display) = choice else {
                continue;
            };
            for size in display.also.split(", ").filter(|size| !size.is_empty()) {
                let size: crate::option_values::Size = size.parse().unwrap();
                assert_ne!(size.0, display.resolution(), "{}", display.name);
            }
        }
    }
}
