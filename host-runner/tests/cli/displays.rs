//! Displays by name.

use crate::program::Folder;

/// The lines of `--display list`: name and the options it stands for.
fn list(folder: &Folder) -> Vec<(String, Vec<String>)> {
    let run = folder.succeed(&["render", "--display", "list"]);
    let text = String::from_utf8(run.stdout).unwrap();
    let mut displays = Vec::new();
    for line in text.lines().skip(1).take_while(|line| !line.is_empty()) {
        let mut words = line.split_whitespace().map(str::to_owned);
        let name = words.next().unwrap();
        let dither = usize::from(line.contains(" --dither "));
        displays.push((name, words.take(4 + dither).collect()));
    }
    displays
}

#[test]
fn the_list_says_what_each_name_stands_for() {
    let folder = Folder::new();
    let displays = list(&folder);
    assert!(displays.len() > 15, "{displays:?}");
    for name in [
        "ssd1306", "ssd1351", "ili9341", "st7789", "st7735", "ssd0323", "epd2in9",
    ] {
        assert!(displays.iter().any(|(listed, _)| listed == name), "{name}");
    }
    // A sky, which takes little time.
    folder.write("sky.txt", "0\n0 0 0\n8 6\n0 0 0 1 1 1 1 1 1\n0\n1\n0 0 0\n");
    for (name, options) in &displays {
        let options: Vec<&str> = options.iter().map(String::as_str).collect();
        let by_options = folder.draw(&[&["sky.txt"], &options[..]].concat());
        assert!(
            folder.draw(&["sky.txt", "--display", name]) == by_options,
            "{name}"
        );
        let size = format!("{}x{}", by_options.width, by_options.height);
        assert!(options.contains(&&*size), "{name}: {options:?}");
    }
    assert_eq!(folder.names(), ["drawn.ppm", "sky.txt"]);
}

#[test]
fn help_lists_them_too() {
    let folder = Folder::new();
    let help = String::from_utf8(folder.succeed(&["render", "--help"]).stdout).unwrap();
    for (name, _) in list(&folder) {
        assert!(help.contains(&format!("- {name}:")), "{name}: {help}");
    }
}

#[test]
fn options_beside_a_display_win() {
    let folder = Folder::new();
    let draw = |options: &[&str]| folder.draw(options);
    let oled = ["--display", "ssd1306"];
    assert!(
        draw(&[&oled[..], &["--size", "72x40"]].concat())
            == draw(&["--size", "72x40", "--color", "binary", "--dither"])
    );
    assert!(
        draw(&[&oled[..], &["--color", "gray4"]].concat())
            == draw(&["--size", "128x64", "--color", "gray4", "--dither=on"])
    );
    assert!(
        draw(&[&oled[..], &["--dither=off"]].concat())
            == draw(&["--size", "128x64", "--color", "binary"])
    );
}

#[test]
fn wrong_displays_and_dithers_are_usage_errors() {
    let folder = Folder::new();
    let said = folder.fail(2, &["render", "--display", "st7798"]);
    assert!(said.contains("a similar value exists: 'st7789'"), "{said}");
    assert!(said.contains("possible values: list, ssd1306, "), "{said}");
    let said = folder.fail(2, &["render", "--dither=yes"]);
    assert!(
        said.contains("give --dither, --dither=on or --dither=off"),
        "{said}"
    );
    assert_eq!(folder.names(), [""; 0]);
}
