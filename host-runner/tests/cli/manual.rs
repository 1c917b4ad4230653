//! Completions and manual pages.

use std::io::Write;

use crate::program::Folder;

#[test]
fn every_shell_has_completions_that_know_the_commands() {
    let folder = Folder::new();
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let run = folder.succeed(&["completions", shell]);
        let script = String::from_utf8(run.stdout).unwrap();
        for word in ["render", "diff", "max-depth"] {
            assert!(script.contains(word), "{shell} {word}");
        }
    }
    let said = folder.fail(2, &["completions", "command.com"]);
    assert!(said.contains("possible values: bash"), "{said}");
}

#[test]
fn bash_completes() {
    let folder = Folder::new();
    let Ok(found) = std::process::Command::new("bash").arg("--version").output() else {
        let _ = writeln!(std::io::stderr(), "not run, because bash is not installed");
        return;
    };
    assert!(found.status.success());
    folder.write(
        "scanray.bash",
        folder.succeed(&["completions", "bash"]).stdout,
    );
    let script = ". ./scanray.bash; COMP_WORDS=(scanray insp); COMP_CWORD=1; \
                  _scanray scanray insp scanray; echo \"${COMPREPLY[@]}\"";
    let run = std::process::Command::new("bash")
        .args(["--norc", "-c", script])
        .current_dir(folder.path(""))
        .output()
        .unwrap();
    assert_eq!(String::from_utf8_lossy(&run.stdout), "inspect\n");
}

#[test]
fn every_command_has_a_page() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("man1")).unwrap();
    let run = folder.succeed(&["man", "-o", "man1"]);
    let help = String::from_utf8(folder.succeed(&["--help"]).stdout).unwrap();
    let mut count = 0;
    for entry in std::fs::read_dir(folder.path("man1")).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap();
        let page = std::fs::read_to_string(&path).unwrap();
        assert!(
            page.contains(".SH NAME") && page.contains(".SH EXAMPLES\n") && !page.contains("EXTRA"),
            "{name}: {page}"
        );
        if let Some(command) = name.strip_prefix("scanray-") {
            assert!(help.contains(&format!("\n  {command} ")), "{command}");
            let printed = folder.succeed(&["man", command]).stdout;
            assert_eq!(String::from_utf8(printed).unwrap(), page);
        }
        count += 1;
    }
    assert!(count > 8, "{count}");
    assert_eq!(run.stderr, format!("{count} pages written to man1\n"));
}

#[test]
fn examples_of_a_page_keep_their_lines() {
    let folder = Folder::new();
    let page = String::from_utf8(folder.succeed(&["man", "fmt"]).stdout).unwrap();
    let (_, examples) = page.split_once(".SH EXAMPLES\n").unwrap();
    let lines: Vec<_> = examples.lines().collect();
    assert_eq!(lines[..2], [".PP", ".nf"]);
    assert!(lines[2].starts_with("scanray fmt scene.txt "), "{examples}");
    assert_eq!(lines.last(), Some(&".fi"));
    for title in ["NOTES", "EXIT STATUS"] {
        assert!(page.contains(title), "{title}: {page}");
    }
}

#[test]
fn wrong_input_is_told() {
    let folder = Folder::new();
    let said = folder.fail(2, &["man", "rendr"]);
    assert!(
        said.contains("there is no command rendr; there are render, view"),
        "{said}"
    );
    let said = folder.fail(4, &["man", "-o", "nowhere"]);
    assert!(
        said.contains("there is no folder nowhere: create it first"),
        "{said}"
    );
}
