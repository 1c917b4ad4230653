//! The examples of every help text are run.

use std::fs;
use std::process::Command;

use crate::program::{Folder, SMALL_SCENE, scene, tell};

/// Programs in examples that need not be installed.
const OTHER_PROGRAMS: [&str; 2] = ["pnmtojpeg", "jq"];

/// The commands that the program lists.
fn commands(folder: &Folder) -> Vec<String> {
    let help = String::from_utf8(folder.succeed(&["--help"]).stdout).unwrap();
    let lines = help
        .lines()
        .skip_while(|line| !line.starts_with("Commands:"));
    let listed = lines.skip(1).take_while(|line| line.starts_with("  "));
    let names = listed.filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
    let names = names.filter(|name| !name.is_empty() && *name != "help");
    // A window waits for a person; tests/window.rs opens it.
    let names = names.filter(|name| *name != "window");
    names.map(str::to_owned).collect()
}

/// The command lines below `Examples:`; what they do stands two blanks behind them or in the next line.
fn examples(help: &str) -> Vec<String> {
    let lines = help.lines().skip_while(|line| *line != "Examples:").skip(1);
    let lines = lines.take_while(|line| line.starts_with("  "));
    let lines = lines.filter_map(|line| line.strip_prefix("  "));
    let lines = lines.filter(|line| !line.starts_with(' '));
    let commands = lines.filter_map(|line| line.split("  ").next());
    commands.map(str::to_owned).collect()
}

/// A folder with all that the examples name.
fn furnished() -> Folder {
    let folder = Folder::new();
    folder.write("scene.txt", SMALL_SCENE);
    fs::create_dir(folder.path("scenes")).unwrap();
    for name in ["default", "pyramids"] {
        let text = fs::read_to_string(scene(name)).unwrap();
        // As small as a display.
        let text = text.replace("800 600", "80 60");
        folder.write(&format!("scenes/{name}.txt"), text);
    }
    crate::furnish(&folder);
    folder
}

#[test]
#[cfg(unix)]
fn every_example_of_every_command_works() {
    let folder = furnished();
    let program = folder.program(&[]);
    let bin = std::path::Path::new(program.get_program())
        .parent()
        .unwrap();
    let path = format!("{}:{}", bin.display(), std::env::var("PATH").unwrap());
    let is_installed = |name: &str| {
        let found = Command::new("sh")
            .args(["-c", &format!("command -v {name}")])
            .output();
        found.unwrap().status.success()
    };
    let commands = commands(&folder);
    assert!(commands.len() > 2, "{commands:?}");
    for command in [""].into_iter().chain(commands.iter().map(|name| &**name)) {
        let help =
            folder.succeed(&[&[command][..], &["--help"]].concat()[command.is_empty().into()..]);
        let help = String::from_utf8(help.stdout).unwrap();
        let examples = examples(&help);
        assert!(
            !examples.is_empty(),
            "{} {command} --help has no examples",
            crate::NAME
        );
        for example in examples {
            let missing = OTHER_PROGRAMS
                .iter()
                .find(|name| example.contains(*name) && !is_installed(name));
            if let Some(missing) = missing {
                tell(&format!(
                    "not run, because {missing} is not installed: {example}"
                ));
                continue;
            }
            let run = Command::new("sh")
                .args(["-c", &example])
                .current_dir(folder.path(""))
                .env("PATH", &path)
                .output()
                .unwrap();
            let said = String::from_utf8_lossy(&run.stderr);
            assert!(run.status.success(), "{example}: {said}");
            if example.ends_with("> scene.txt") {
                // The others draw the small one.
                folder.write("scene.txt", SMALL_SCENE);
            }
        }
    }
}
