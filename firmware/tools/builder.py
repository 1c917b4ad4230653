"""Builds the programs with cargo, and says which boards there are."""

import glob
import os
import re
import shutil
import subprocess
import threading

FIRMWARE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
BUILD_STD = os.environ.get("SCANRAY_BUILD_STD") == "1"

# Board -> (target, column in the tables, instructions per tick, profiles that are measured).
BOARDS = {
    "mps2-an386": ("thumbv7em-none-eabihf", "M4F", 40, ("size", "release")),
    "mps2-an385": ("thumbv7m-none-eabi", "M3", 40, ("size",)),
    "microbit": ("thumbv6m-none-eabi", "M0", 62.5, ("size",)),
    "virt": ("riscv32imc-unknown-none-elf", "RISC-V", 1, ("size",)),
    "lm3s6965evb": ("thumbv7m-none-eabi", "OLED", None, ()),
}


class Failed(Exception):
    """Why a check fails."""


def scenes():
    """Scene name -> file, those of the repository first."""
    paths = sorted(glob.glob("../scenes/*.txt", root_dir=FIRMWARE)) + sorted(glob.glob("scenes/*.txt", root_dir=FIRMWARE))
    return {os.path.basename(path).removesuffix(".txt"): path for path in paths}


class Builder:
    """Cargo, one build at a time: what takes long is the emulation."""

    def __init__(self, images):
        self.images = images
        self.root = os.environ.get("CARGO_TARGET_DIR", os.path.join(FIRMWARE, "target"))
        self.lock = threading.Lock()

    def cargo(self, arguments, **variables):
        """What cargo printed."""
        environment = os.environ | {"CARGO_TARGET_DIR": self.root, "RUSTC_BOOTSTRAP": "1"} | variables
        # A variable would replace the flags of .cargo/config.toml.
        environment.pop("RUSTFLAGS", None)
        done = subprocess.run(["cargo", arguments[0], "--quiet", "--locked", *arguments[1:]], cwd=FIRMWARE,
                              env=environment, timeout=900, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode != 0:
            raise Failed("\n" + done.stdout.strip())
        return done.stdout

    def image(self, board, program, name, profile="size", proven=True, example=False, flags=(), **variables):
        """The path of a program's image, with line tables for the profiler, which change no code. `flags` are the
        compiler's, added to those of .cargo/config.toml."""
        target = BOARDS[board][0]
        features = board + (",prove-no-panic" if proven else "")
        variables[f"CARGO_PROFILE_{profile.upper()}_DEBUG"] = "line-tables-only"
        flags = ", ".join(f"'{flag}'" for flag in ("-Zemit-stack-sizes", "-Clink-arg=-Tstack_sizes.x", *flags))
        arguments = ["build", "--profile", profile, "--target", target, "--no-default-features", "--features", features,
                     "--example" if example else "--bin", program, "--config", f"target.{target}.rustflags=[{flags}]"]
        if BUILD_STD:
            arguments.append("-Zbuild-std=core")
        with self.lock:
            self.cargo(arguments, **variables)
            built = os.path.join(self.root, target, profile, "examples" if example else "", program)
            return shutil.copy(built, os.path.join(self.images, f"{board}-{name}"))

    def host(self):
        version = subprocess.run([os.environ.get("RUSTC", "rustc"), "-vV"], check=True, capture_output=True, text=True)
        return re.search(r"host: (\S+)", version.stdout)[1]

    def reference(self):
        """The path of the host's program."""
        with self.lock:
            self.cargo(["build", "--release", "--package", "reference", "--target", self.host()])
        return os.path.join(self.root, self.host(), "release", "reference")

    def unit_tests(self):
        with self.lock:
            self.cargo(["test", "--lib", "--tests", "--package", "board", "--package", "displays", "--target", self.host()])

    def missing_stage(self, board):
        """What the compiler says of a tracer without a stage that its scene needs."""
        with self.lock:
            try:
                self.cargo(["check", "--target", BOARDS[board][0], "--no-default-features", "--features",
                            board + ",must-not-compile", "--bin", "missing_stage",
                            *(["-Zbuild-std=core"] if BUILD_STD else [])])
            except Failed as why:
                return str(why)
        raise Failed("a tracer without a stage that its scene needs compiles")

    def lint(self, board):
        """Clippy over everything that compiles for a board."""
        if BUILD_STD:
            return "skipped, clippy needs the compiled core library of rustup"
        with self.lock:
            try:
                self.cargo(["clippy", "--version"])
            except Failed:
                return "skipped, this toolchain has no clippy"
            self.cargo(["clippy", "--target", BOARDS[board][0], "--no-default-features", "--features", board,
                        "--package", "scanray-firmware", "--package", "board", "--package", "displays",
                        "--lib", "--bins", "--examples", "--", "--deny", "warnings"])
        return None


def compiler():
    """The compiler's name in file names: counts and sizes are its own."""
    version = subprocess.run([os.environ.get("RUSTC", "rustc"), "--version"], check=True, capture_output=True, text=True)
    return "rustc-" + version.stdout.split()[1] + ("-build-std" if BUILD_STD else "")
