//! Running the program.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use tempfile::TempDir;

/// A folder for a test, and the program running in it.
pub(crate) struct Folder(TempDir);

/// What a run of the program left.
pub(crate) struct Run {
    pub(crate) code: i32,
    pub(crate) stdout: Vec<u8>,
    pub(crate) stderr: String,
}

/// A picture from a P6 file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Picture {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) rgb888: Vec<u8>,
}

impl Folder {
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// The program, to be run here.
    pub(crate) fn program(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(crate::PROGRAM);
        command.current_dir(self.0.path()).args(arguments);
        command
    }

    /// Runs the program without input.
    pub(crate) fn run(&self, arguments: &[&str]) -> Run {
        self.run_with_input(arguments, b"")
    }

    /// Runs the program with standard input.
    pub(crate) fn run_with_input(&self, arguments: &[&str], input: &[u8]) -> Run {
        let mut child = self
            .program(arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        // The program need not read it.
        let _ = child.stdin.take().unwrap().write_all(input);
        let output = child.wait_with_output().unwrap();
        Run {
            code: output.status.code().unwrap(),
            stdout: output.stdout,
            stderr: String::from_utf8(output.stderr).unwrap(),
        }
    }

    /// Runs the program, which must succeed.
    #[track_caller]
    pub(crate) fn succeed(&self, arguments: &[&str]) -> Run {
        let run = self.run(arguments);
        assert_eq!(run.code, 0, "{arguments:?}: {}", run.stderr);
        run
    }

    /// Runs the program, which must fail with this code; returns what it said.
    #[track_caller]
    pub(crate) fn fail(&self, code: i32, arguments: &[&str]) -> String {
        let run = self.run(arguments);
        assert_eq!(run.code, code, "{arguments:?}: {}", run.stderr);
        assert_eq!(run.stdout, b"", "{arguments:?}");
        run.stderr
    }

    /// Draws into a PPM file and reads it.
    #[track_caller]
    pub(crate) fn draw(&self, arguments: &[&str]) -> Picture {
        let arguments = [&["render", "-o", "drawn.ppm"], arguments].concat();
        self.succeed(&arguments);
        self.ppm("drawn.ppm")
    }

    pub(crate) fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap()
    }

    pub(crate) fn write(&self, name: &str, text: impl AsRef<[u8]>) {
        fs::write(self.path(name), text).unwrap();
    }

    #[track_caller]
    pub(crate) fn ppm(&self, name: &str) -> Picture {
        Picture::from_ppm(&self.read(name))
    }

    /// Names of all that is in the folder.
    pub(crate) fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.0.path()).unwrap();
        let mut names: Vec<_> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }
}

impl Picture {
    /// The picture of a file that holds one.
    #[track_caller]
    pub(crate) fn from_ppm(file: &[u8]) -> Self {
        let (picture, rest) = Self::first_of(file);
        assert_eq!(rest, b"");
        picture
    }

    /// The first picture of a file, and what follows it.
    #[track_caller]
    pub(crate) fn first_of(file: &[u8]) -> (Self, &[u8]) {
        let mut rest = file;
        let mut line = || {
            loop {
                let end = rest.iter().position(|byte| *byte == b'\n').unwrap();
                let line = std::str::from_utf8(&rest[..end]).unwrap();
                rest = &rest[end + 1..];
                if !line.starts_with('#') {
                    return line;
                }
            }
        };
        assert_eq!(line(), "P6");
        let (width, height) = line().split_once(' ').unwrap();
        let (width, height) = (width.parse().unwrap(), height.parse().unwrap());
        assert_eq!(line(), "255");
        let (pixels, rest) = rest.split_at(width * height * 3);
        let picture = Self {
            width,
            height,
            rgb888: pixels.to_vec(),
        };
        (picture, rest)
    }

    /// The picture of a PNG file with 8 bits a channel.
    #[track_caller]
    pub(crate) fn from_png(file: &[u8]) -> Self {
        let mut reader = png::Decoder::new(std::io::Cursor::new(file))
            .read_info()
            .unwrap();
        let mut rgb888 = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut rgb888).unwrap();
        assert_eq!(info.color_type, png::ColorType::Rgb);
        Self {
            width: info.width as usize,
            height: info.height as usize,
            rgb888,
        }
    }

    /// The different levels of all channels.
    pub(crate) fn levels(&self) -> Vec<u8> {
        let mut levels = self.rgb888.clone();
        levels.sort();
        levels.dedup();
        levels
    }
}

/// Says what is not tested here, and why. The test harness shows what is written in this way, but hides what a test
/// prints.
pub(crate) fn tell(words: &str) {
    let _ = writeln!(std::io::stderr(), "{words}");
}

/// A scene of the repository.
pub(crate) fn scene(name: &str) -> String {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    let path = scenes.join(name).with_extension("txt");
    path.into_os_string().into_string().unwrap()
}

/// Scene text for a small sphere in front of the sky.
pub(crate) const SMALL_SCENE: &str = "\
1
0 0 0
8 6
5 5 -5  1 1 1  1 1 1
0.1
1
0 0 0
0  0 0 3  1  .8 .2 .2  .5 .5 .5  1 1 1  0 50 0 0
";
