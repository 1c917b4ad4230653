//! What decides the picture of a scene, for every command that draws one.

use clap::{ArgAction, Args};
use scanray::{DEFAULT_MAX_DEPTH, Resolution};

use crate::displays::{Display, DisplayChoice};
use crate::options::{ColorName, ScalarName, Size, max_depth, name_of};

/// The options of the command line.
#[derive(Args, Debug)]
pub(crate) struct PictureArgs {
    /// Draw as this display shows it: its size, colours and dither; `list` prints all
    #[arg(long, value_name = "NAME", hide_possible_values = false)]
    display: Option<DisplayChoice>,

    /// Width and height in pixels [default: the display's or else the scene's own]
    #[arg(long, value_name = "WxH")]
    size: Option<Size>,

    /// Colours of the display [default: the display's or else rgb888]
    #[arg(long, value_name = "NAME", hide_possible_values = false)]
    color: Option<ColorName>,

    /// Show shades between two levels by a fixed pattern (ordered dither) [default: off without a
    /// display]
    #[arg(
        long,
        value_name = "on|off",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "on",
        value_parser = on_or_off,
        action = ArgAction::Set
    )]
    dither: Option<bool>,

    /// How many mirrored or refracted rays may follow one another, at most 32
    #[arg(
        long,
        value_name = "N",
        default_value_t = DEFAULT_MAX_DEPTH,
        value_parser = max_depth,
        allow_negative_numbers = true
    )]
    max_depth: usize,

    /// Number type of the tracer
    #[arg(long, value_name = "TYPE", default_value = "f32")]
    scalar: ScalarName,
}

/// What the options say, taken together with the display's.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PictureSettings {
    size: Option<Resolution>,
    pub(crate) color: ColorName,
    pub(crate) dither: bool,
    pub(crate) max_depth: usize,
    pub(crate) scalar: ScalarName,
}

impl PictureArgs {
    /// Whether the list of displays is wanted, and no picture.
    pub(crate) fn wants_list(&self) -> bool {
        self.display == Some(DisplayChoice::List)
    }

    /// What the options say.
    pub(crate) fn settings(&self) -> PictureSettings {
        let display = self.display();
        let color = self.color.or(display.map(|display| display.color));
        let dither = self.dither.or(display.map(|display| display.dither));
        PictureSettings {
            size: match self.size {
                Some(Size(size)) => Some(size),
                None => display.map(|display| display.resolution()),
            },
            color: color.unwrap_or(ColorName::Rgb888),
            dither: dither.unwrap_or(false),
            max_depth: self.max_depth,
            scalar: self.scalar,
        }
    }

    fn display(&self) -> Option<Display> {
        match self.display {
            Some(DisplayChoice::Of(display)) => Some(display),
            Some(DisplayChoice::List) | None => None,
        }
    }
}

impl PictureSettings {
    /// The size that was asked for, if one was.
    pub(crate) fn size(&self) -> Option<Resolution> {
        self.size
    }

    /// The size of the picture of a scene that has this size of its own.
    pub(crate) fn resolution(&self, own: Resolution) -> Resolution {
        self.size.unwrap_or(own)
    }

    /// All that decides the pixels beside scene and size, name and value, for [`PartRecord`]s.
    ///
    /// [`PartRecord`]: crate::part::PartRecord
    pub(crate) fn record(&self) -> Vec<(String, String)> {
        // Naming every field keeps a new one from being forgotten.
        let Self {
            size: _,
            color,
            dither,
            max_depth,
            scalar,
        } = *self;
        let dither = if dither { "on" } else { "off" };
        [
            // Other versions may draw other bits.
            ("version", env!("CARGO_PKG_VERSION").to_owned()),
            ("scalar", name_of(scalar)),
            ("max-depth", max_depth.to_string()),
            ("color", name_of(color)),
            ("dither", dither.to_owned()),
        ]
        .map(|(name, value)| (name.to_owned(), value))
        .to_vec()
    }
}

fn on_or_off(word: &str) -> Result<bool, String> {
    match word {
        "on" => Ok(true),
        "off" => Ok(false),
        _ => Err("give --dither, --dither=on or --dither=off".to_owned()),
    }
}
