//! What decides the picture of a scene, for every command that draws one.

use clap::{ArgAction, Args};
use scanray::{DEFAULT_MAX_DEPTH, Resolution, render::DisplayColor};

use crate::displays::{Display, DisplayChoice};
use crate::failure::Failure;
use crate::knobs::{CutoffChoice, Detail, Knobs, SampleCount, fraction};
use crate::option_values::{ColorName, ScalarName, Size, max_depth, name_of, with_color};

/// The options of the command line.
#[derive(Args, Debug)]
pub(crate) struct PictureArgs {
    /// Draw as this display shows it: its size, colours and dither; `list` prints all
    #[arg(
        long,
        value_name = "NAME",
        hide_possible_values = false,
        ignore_case = true
    )]
    display: Option<DisplayChoice>,

    /// Width and height in pixels [default: the display's or else the scene's own]
    #[arg(long, value_name = "WxH")]
    size: Option<Size>,

    /// Colours of the display [default: the display's or else rgb888]
    #[arg(
        long,
        value_name = "NAME",
        hide_possible_values = false,
        ignore_case = true
    )]
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

    /// Leave out mirrored and refracted rays that together make no channel darker by this share or more,
    /// such as 1/512; none; auto: less than a level of the display's colours
    #[arg(
        long,
        value_name = "SHARE",
        default_value = "none",
        allow_negative_numbers = true
    )]
    cutoff: CutoffChoice,

    /// Samples in each pixel, on a fixed pattern [default: 1, or 16 with --adaptive]
    #[arg(long, value_name = "N", hide_possible_values = false)]
    samples: Option<SampleCount>,

    /// Take the samples only where a pixel differs from a neighbour by more than this share, such as
    /// 1/16, in a channel
    #[arg(long, value_name = "SHARE", value_parser = fraction, allow_negative_numbers = true)]
    adaptive: Option<f64>,

    /// Draw as far as a picture that appears coarse to fine: blocks of 4x4 pixels, of 2x2, or all
    #[arg(long, value_name = "DETAIL", default_value = "full")]
    preview: Detail,

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
    pub(crate) knobs: Knobs,
    pub(crate) scalar: ScalarName,
}

impl PictureArgs {
    /// Whether the list of displays is wanted, and no picture.
    pub(crate) fn wants_list(&self) -> bool {
        self.display == Some(DisplayChoice::List)
    }

    /// What the options say.
    ///
    /// # Errors
    ///
    /// [`Failure::Usage`] when they contradict each other.
    pub(crate) fn settings(&self) -> Result<PictureSettings, Failure> {
        let display = self.display();
        let color = self.color.or(display.map(|display| display.color));
        let color = color.unwrap_or(ColorName::Rgb888);
        let dither = self.dither.or(display.map(|display| display.dither));
        Ok(PictureSettings {
            size: match self.size {
                Some(Size(size)) => Some(size),
                None => display.map(|display| display.resolution()),
            },
            color,
            dither: dither.unwrap_or(false),
            max_depth: self.max_depth,
            knobs: self.knobs(color)?,
            scalar: self.scalar,
        })
    }

    fn knobs(&self, color: ColorName) -> Result<Knobs, Failure> {
        let samples = match (self.samples, self.adaptive) {
            (Some(SampleCount::One), Some(_)) => {
                return Err(Failure::Usage(
                    "--adaptive takes more samples at edges: give --samples 4, 16 or 64, or leave it out"
                        .to_owned(),
                ));
            }
            (Some(samples), _) => samples,
            (None, Some(_)) => SampleCount::Sixteen,
            (None, None) => SampleCount::One,
        };
        Ok(Knobs {
            cutoff: match self.cutoff {
                CutoffChoice::Auto => with_color!(color, C => C::LEVEL.into()),
                CutoffChoice::Of(cutoff) => cutoff,
            },
            samples,
            edges: self.adaptive,
            detail: self.preview,
        })
    }

    fn display(&self) -> Option<Display> {
        match self.display {
            Some(DisplayChoice::Of(display)) => Some(display),
            Some(DisplayChoice::List) | None => None,
        }
    }
}

impl Default for PictureSettings {
    /// What is drawn without any option.
    fn default() -> Self {
        Self {
            size: None,
            color: ColorName::Rgb888,
            dither: false,
            max_depth: DEFAULT_MAX_DEPTH,
            knobs: Knobs::default(),
            scalar: ScalarName::F32,
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
    /// [`PartRecord`]: crate::picture_part::PartRecord
    pub(crate) fn record(&self) -> Vec<(String, String)> {
        // Naming every field keeps a new one from being forgotten.
        let Self {
            size: _,
            color,
            dither,
            max_depth,
            knobs:
                Knobs {
                    cutoff,
                    samples,
                    edges,
                    detail,
                },
            scalar,
        } = *self;
        let dither = if dither { "on" } else { "off" };
        [
            // Other versions may draw other bits.
            ("version", env!("CARGO_PKG_VERSION").to_owned()),
            ("scalar", name_of(scalar)),
            ("max-depth", max_depth.to_string()),
            ("cutoff", cutoff.to_string()),
            ("samples", name_of(samples)),
            (
                "adaptive",
                edges.map_or("off".to_owned(), |edges| edges.to_string()),
            ),
            ("preview", name_of(detail)),
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
