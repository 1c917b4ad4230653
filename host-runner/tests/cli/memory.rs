//! Pictures that the machine has no memory for.
#![cfg(target_os = "linux")]

use crate::program::{Folder, SMALL_SCENE};

/// Runs the program with some megabytes of address space.
fn run(folder: &Folder, megabytes: u32, arguments: &str) -> (Option<i32>, String) {
    let script = format!(
        "ulimit -v {megabytes}000; exec '{}' {arguments}",
        env!("CARGO_BIN_EXE_scanray")
    );
    let output = std::process::Command::new("sh")
        .args(["-c", &script])
        .current_dir(folder.path(""))
        .output()
        .unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    (output.status.code(), said)
}

#[test]
fn what_needs_more_memory_than_there_is_is_refused_before_it_is_drawn() {
    let folder = Folder::new();
    folder.write("big.txt", SMALL_SCENE.replace("8 6", "60000 60000"));
    for (arguments, words) in [
        (
            "render big.txt -o big.gif",
            "a GIF of 60000x60000 pixels needs 25.23 GB of memory, more than there is: draw it smaller with --size, or \
             into .ppm or .png files",
        ),
        (
            "render big.txt --turntable 3 -o big.gif",
            "a GIF of 60000x60000 pixels needs 25.23 GB",
        ),
        (
            "view big.txt --size 60000x60000",
            "a picture of 60000x60000 pixels needs 10.80 GB of memory, more than there is: give a smaller --size",
        ),
    ] {
        let (code, said) = run(&folder, 3000, arguments);
        assert_eq!(code, Some(4), "{arguments}: {said}");
        assert!(
            said.starts_with("error: ") || said.contains("\nerror: "),
            "{said}"
        );
        assert!(said.contains(words), "{arguments}: {said}");
        assert!(
            !said.contains("panicked") && !said.contains("backtrace"),
            "{said}"
        );
    }
    assert_eq!(folder.names(), ["big.txt"]);
}

#[test]
fn what_is_written_row_by_row_needs_no_more_for_a_larger_picture() {
    let folder = Folder::new();
    // A sky of 200 million pixels would be 600 MB.
    folder.write(
        "sky.txt",
        "0\n0 0 0\n20000 10000\n0 0 0 1 1 1 1 1 1\n0\n0\n0 0 0\n",
    );
    let (code, said) = run(&folder, 600, "render sky.txt --threads 2 -o /dev/null");
    assert_eq!(code, Some(0), "{said}");
}
