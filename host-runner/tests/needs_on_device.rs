//! What `scanray needs` tells, against the compiler for a device: the lines it prints compile, and the types have
//! the sizes it names.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// Devices with pointers of 32 bits: 4 bytes are aligned to 4, and 8 to 8.
const TARGETS: [&str; 2] = ["thumbv6m-none-eabi", "riscv32imc-unknown-none-elf"];

fn scanray(arguments: &[&str]) -> Vec<u8> {
    let output = Command::new(env!("CARGO_BIN_EXE_scanray"))
        .args(arguments)
        .output()
        .unwrap();
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    output.stdout
}

/// A function that pastes the lines for a scene, and assertions about the sizes.
fn source_for(index: usize, arguments: &[&str]) -> String {
    let json = scanray(&[&["needs", "--json"], arguments].concat());
    let json: Value = serde_json::from_slice(&json).unwrap();
    let text = |key: &str| json[key].as_str().unwrap();
    let (pools, scalar) = (text("pools_type"), text("scalar"));
    let depth = &json["max_depth"];
    let mut source = format!(
        "pub fn pasted_{index}() -> Result<usize, DepthError> {{\n{}\nOk(tracer.max_depth())\n}}\n",
        text("source").replace("let mut", "#[allow(unused_mut)] let mut")
    );
    for (of, bytes) in [
        (format!("size_of::<{pools}>()"), &json["scene_pools"]),
        (
            format!("size_of::<Tracer<'static, {scalar}>>()"),
            &json["tracer"],
        ),
        ("size_of::<Frame>()".to_owned(), &json["frame"]),
        (
            format!("Tracer::<'static, {scalar}>::FRAME_BYTES"),
            &json["stack_frame"],
        ),
        (
            format!(
                "size_of::<heapless::Vec<[{scalar}; Tracer::<'static, {scalar}>::FRAME_BYTES / size_of::<{scalar}>()], {depth}>>() + size_of::<usize>()"
            ),
            &json["stack"],
        ),
        (
            "size_of::<[embedded_graphics::pixelcolor::Rgb565; 96]>()".to_owned(),
            &json["rows"][2]["bytes"],
        ),
    ] {
        source += &format!("const _: () = assert!({of} == {bytes});\n");
    }
    source
}

#[test]
#[ignore = "compiles for devices: .ci/run runs it"]
fn the_lines_compile_and_the_sizes_are_the_compilers() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let sysroot = Command::new("rustc")
        .args(["--print", "sysroot"])
        .output()
        .unwrap();
    let sysroot = String::from_utf8(sysroot.stdout).unwrap();
    let library = Path::new(sysroot.trim()).join("lib/rustlib");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("needs");
    fs::create_dir_all(folder.join("src")).unwrap();
    let manifest = format!(
        "[package]\nname = \"needs\"\nedition = \"2024\"\n[workspace]\n[dependencies]\n\
         scanray = {{ path = {root:?} }}\nheapless = \"0.9\"\n\
         embedded-graphics = {{ version = \"0.8\", default-features = false }}\n"
    );
    fs::write(folder.join("Cargo.toml"), manifest).unwrap();
    // The versions that are there.
    fs::copy(root.join("Cargo.lock"), folder.join("Cargo.lock")).unwrap();
    let scene = |name: &str| {
        root.join("scenes")
            .join(name)
            .into_os_string()
            .into_string()
            .unwrap()
    };
    let mut source =
        "#![no_std]\nuse scanray::{render::Frame, tracer::DepthError, *};\n".to_owned();
    for (index, (name, more)) in [
        ("default.txt", &[][..]),
        ("pyramids.txt", &["--max-depth", "2"]),
        ("window-room.txt", &["--max-depth", "9"]),
        ("reflective.txt", &["--scalar", "f64"]),
    ]
    .into_iter()
    .enumerate()
    {
        let path = scene(name);
        source += &source_for(index, &[&[&*path, "--size", "96x64"], more].concat());
    }
    fs::write(folder.join("src/lib.rs"), source).unwrap();
    for target in TARGETS {
        if !library.join(target).is_dir() {
            let _ = writeln!(
                std::io::stderr(),
                "not run, because the compiler has no target {target}: rustup target add {target}"
            );
            continue;
        }
        let check = Command::new(env!("CARGO"))
            .args(["check", "--offline", "--quiet", "--target", target])
            .current_dir(&folder)
            .env("CARGO_TARGET_DIR", folder.join("target"))
            .env_remove("RUSTFLAGS")
            .output()
            .unwrap();
        assert!(
            check.status.success(),
            "{target}: {}",
            String::from_utf8_lossy(&check.stderr)
        );
    }
}
