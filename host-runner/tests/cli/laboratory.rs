//! `scanray report`, `scanray tune` and `scanray stability`: commands of another program.

use std::fs;
use std::process::Command;

use crate::program::Folder;

#[test]
#[cfg(unix)]
fn another_program_is_run_with_the_same_arguments() {
    use std::os::unix::fs::PermissionsExt as _;
    let folder = Folder::new();
    for place in ["beside", "in-path"] {
        fs::create_dir(folder.path(place)).unwrap();
    }
    let own = folder.path("beside/scanray");
    fs::copy(crate::PROGRAM, &own).unwrap();
    let laboratory = |place: &str| {
        let file = folder.path(place).join("scanray-lab");
        let script = format!("#!/bin/sh\necho {place} \"$@\"\nexit 7\n");
        fs::write(&file, script).unwrap();
        fs::set_permissions(&file, fs::Permissions::from_mode(0o755)).unwrap();
    };
    let run = |arguments: &[&str]| {
        let path = format!("{}:/usr/bin:/bin", folder.path("in-path").display());
        let output = Command::new(&own)
            .args(arguments)
            .env("PATH", path)
            .output()
            .unwrap();
        let printed = String::from_utf8(output.stdout).unwrap();
        (output.status.code().unwrap(), printed)
    };
    laboratory("in-path");
    let arguments = ["report", "a b.txt", "-o", "out"];
    assert_eq!(
        run(&arguments),
        (7, "in-path report a b.txt -o out\n".into())
    );
    laboratory("beside");
    assert_eq!(run(&["tune", "--help"]), (7, "beside tune --help\n".into()));
    let help = run(&["help", "stability"]);
    assert_eq!(help, (7, "beside help stability\n".into()));
    assert_eq!(run(&["--version"]).0, 0);
}

#[test]
fn its_absence_is_told() {
    let folder = Folder::new();
    let own = folder.path(&format!("scanray{}", std::env::consts::EXE_SUFFIX));
    fs::copy(crate::PROGRAM, &own).unwrap();
    for command in ["report", "tune", "stability"] {
        let output = Command::new(&own)
            .arg(command)
            .env("PATH", "")
            .output()
            .unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert_eq!(said.lines().count(), 1, "{said}");
        assert!(
            said.contains("cargo build --release -p scanray-lab"),
            "{said}"
        );
    }
}

#[test]
fn help_lists_its_commands_apart() {
    let help = Folder::new().succeed(&["--help"]).stdout;
    let help = String::from_utf8(help).unwrap();
    let (before, laboratory) = help.split_once("\nLaboratory").unwrap();
    for command in ["report", "tune", "stability"] {
        let line = format!("\n  {command} ");
        assert!(
            laboratory.contains(&line) && !before.contains(&line),
            "{help}"
        );
    }
}
