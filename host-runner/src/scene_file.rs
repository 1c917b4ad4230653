//! Scenes from files, from standard input or from the program itself, and what is said of bad ones.

use std::fs::File;
use std::io::{self, IsTerminal, Read};
use std::path::{Path, PathBuf};

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use scanray::ParseError;

use crate::console::{is_invisible, say, shown};
use crate::failure::Failure;
use crate::option_values::meant_for_option;
use crate::pools::{HostPools, HostScalar};
use crate::scene_warnings::warnings;

/// The scene that is drawn when none is named.
const DEFAULT_SCENE: &[u8] = include_bytes!("../../scenes/default.txt");

/// No text is longer than this: several times what fills all pools, and not all of the memory when
/// someone names an endless file.
const MAX_TEXT_BYTES: u64 = 256 << 20;

/// Where a scene's text is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SceneSource {
    /// In the program.
    Default,
    /// On standard input.
    Stdin,
    /// In a file.
    File(PathBuf),
}

impl SceneSource {
    /// The scene of a command line, which may name none.
    pub fn named(path: Option<&Path>) -> Self {
        match path {
            None => Self::Default,
            Some(path) if path.as_os_str() == "-" => Self::Stdin,
            Some(path) => Self::File(path.to_owned()),
        }
    }

    /// The scenes of a command line that may name several.
    pub fn list(paths: &[PathBuf]) -> Vec<Self> {
        if paths.is_empty() {
            vec![Self::Default]
        } else {
            let named = |path: &PathBuf| Self::named(Some(path));
            paths.iter().map(named).collect()
        }
    }

    /// Its file, if it is in one.
    pub fn file(&self) -> Option<&PathBuf> {
        match self {
            Self::File(path) => Some(path),
            Self::Default | Self::Stdin => None,
        }
    }

    /// Its name in messages and comments.
    pub fn name(&self) -> String {
        shown(self.data_name())
    }

    /// Its name in data for programs.
    pub fn data_name(&self) -> String {
        match self {
            Self::Default => "<default scene>".to_owned(),
            Self::Stdin => "<stdin>".to_owned(),
            Self::File(path) => path.to_string_lossy().into_owned(),
        }
    }

    /// What a file made from it is called, before the extension.
    pub fn stem(&self) -> PathBuf {
        match self {
            Self::Default => "default".into(),
            Self::Stdin => "stdin".into(),
            Self::File(path) => path.file_stem().unwrap_or(path.as_os_str()).into(),
        }
    }

    /// The scene's text.
    ///
    /// # Errors
    ///
    /// [`Failure::Files`].
    pub fn read(&self) -> Result<Vec<u8>, Failure> {
        let cannot = |error: io::Error| {
            let why = match error.kind() {
                io::ErrorKind::NotFound => {
                    let advice = meant_for_option(&self.data_name()).unwrap_or_else(|| {
                        "scanray example > scene.txt writes one to start from".to_owned()
                    });
                    format!("there is no such file ({advice})")
                }
                io::ErrorKind::IsADirectory => "it is a folder; name a scene in it".to_owned(),
                _ => error.to_string(),
            };
            Failure::Files(format!("cannot read {}: {why}", self.name()))
        };
        let mut text = Vec::new();
        let input: &mut dyn Read = match self {
            Self::Default => return Ok(DEFAULT_SCENE.to_vec()),
            Self::Stdin => &mut io::stdin().lock(),
            Self::File(path) => &mut File::open(path).map_err(cannot)?,
        };
        input
            .take(MAX_TEXT_BYTES + 1)
            .read_to_end(&mut text)
            .map_err(cannot)?;
        if text.len() as u64 > MAX_TEXT_BYTES {
            let limit = MAX_TEXT_BYTES >> 20;
            return Err(Failure::Files(format!(
                "cannot read {}: a scene's text is at most {limit} MiB long",
                self.name()
            )));
        }
        Ok(text)
    }

    /// Replaces the scene in the pools by this one, and prints the parser's warnings.
    ///
    /// # Errors
    ///
    /// [`Failure::Files`] and [`Failure::Scene`].
    pub fn load<T: HostScalar>(&self, pools: &mut HostPools<T>) -> Result<(), Failure> {
        self.load_text(&self.read()?, pools)
    }

    /// The same for a text that was read from here.
    ///
    /// # Errors
    ///
    /// [`Failure::Scene`].
    pub fn load_text<T: HostScalar>(
        &self,
        text: &[u8],
        pools: &mut HostPools<T>,
    ) -> Result<(), Failure> {
        if let Some(warning) = self.parse(text, pools, &renderer())? {
            say(warning);
        }
        Ok(())
    }

    /// Whether it is a scene in this number type.
    ///
    /// # Errors
    ///
    /// [`Failure::Scene`].
    pub fn check<T: HostScalar>(&self, text: &[u8]) -> Result<(), Failure> {
        self.parse(text, &mut T::pools(), &renderer()).map(drop)
    }

    /// The same as [`SceneSource::load_text`], but the warnings are returned, each a line.
    ///
    /// # Errors
    ///
    /// [`Failure::Scene`].
    pub fn parse<T: HostScalar>(
        &self,
        text: &[u8],
        pools: &mut HostPools<T>,
        renderer: &Renderer,
    ) -> Result<Option<String>, Failure> {
        let report = pools
            .parse(text)
            .map_err(|error| Failure::Scene(error_report(&self.name(), text, &error, renderer)))?;
        let short = report.short_light_line.map(|line| {
            let words = "the light has 8 numbers instead of 9; the last is used twice";
            (line, words.to_owned())
        });
        // The scene in the program is not the user's to mend.
        let unmeant = match self {
            Self::Default => Vec::new(),
            Self::Stdin | Self::File(_) => warnings(text, &pools.as_scene()),
        };
        let warnings: Vec<String> = short
            .into_iter()
            .chain(unmeant)
            .map(|(line, words)| format!("warning: {}:{line}: {words}", self.name()))
            .collect();
        Ok((!warnings.is_empty()).then(|| warnings.join("\n")))
    }
}

/// Colours where a person looks at them.
fn renderer() -> Renderer {
    let is_plain = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    if io::stderr().is_terminal() && !is_plain {
        Renderer::styled()
    } else {
        Renderer::plain()
    }
}

/// What to do about text that an editor has saved in a form that cannot be read.
fn encoding_help(text: &[u8]) -> Option<&'static str> {
    if text.contains(&b'\r') && !text.contains(&b'\n') {
        Some("the file has carriage returns (CR) for line ends; save it with LF or CRLF")
    } else if text.starts_with(b"\xff\xfe") || text.starts_with(b"\xfe\xff") {
        Some("the file is UTF-16; save it as UTF-8")
    } else {
        None
    }
}

/// What is wrong with a scene, with its line and a caret below the place.
fn error_report(name: &str, text: &[u8], error: &ParseError, renderer: &Renderer) -> String {
    // The line of the error, and the place in it. Only the line is shown, because the rest may be no
    // UTF-8, which would move the places.
    let offset = error.offset.min(text.len());
    let before = text[..offset]
        .rsplit(|byte| *byte == b'\n')
        .next()
        .unwrap_or_default();
    // No editor shows it or counts it.
    let before = before.strip_prefix(b"\xef\xbb\xbf").unwrap_or(before);
    let behind = text[offset..]
        .split(|byte| *byte == b'\n')
        .next()
        .unwrap_or_default();
    let word_length = behind
        .iter()
        .position(|byte| byte.is_ascii_whitespace() || *byte == b'#')
        .unwrap_or(behind.len());
    let (word, rest) = behind.split_at(word_length);
    let [before, word, rest] = [before, word, rest].map(String::from_utf8_lossy);
    let span = before.len()..before.len() + word.len();
    let line = [&*before, &*word, rest.trim_end_matches('\r')].concat();
    // Character by character, so that the caret stays where it belongs; tabs are shown as such. What a terminal would obey has a
    // sign of the same length.
    let harmless = |c: char| match c.len_utf8() {
        _ if c == '\t' || !is_invisible(c) => c,
        1 => '.',
        2 => '\u{a4}',
        _ => '\u{fffd}',
    };
    let line: String = line.chars().map(harmless).collect();

    let snippet = Snippet::source(line)
        .path(name)
        .line_start(error.line as usize)
        .annotation(AnnotationKind::Primary.span(span));
    let title = Level::ERROR.primary_title(error.message().to_string());
    let mut group: Group<'_> = title.element(snippet);
    if let Some(help) = encoding_help(text) {
        group = group.element(Level::HELP.message(help));
    }
    renderer.render(&[group])
}
