#!/usr/bin/env python3
"""Counts the host's instructions and compares them with the checked-in table.

    lab/tools/instructions.py [--bless]

callgrind (valgrind) counts the instructions of `scanray render --threads 1` for two sizes of a picture; the difference is
that of the pixels, without start-up, loading and the end of the program. A row of the table that differs by more
than 1 % from what is counted fails, by its name; --bless writes the table anew.

Compiled code depends on the compiler: the table's name has its version, and with another one nothing is compared. Rows of
f32 are of the AVX2 renderer, and are skipped on a machine without.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
TOLERANCE = 0.01
LARGE, SMALL = (160, 120), (16, 12)

# Name, scene or the words for `scanray generate`, scalar.
ROWS = [
    ("default", "scenes/default.txt"),
    ("mirror-room", "scenes/mirror-room.txt"),
    ("1,000 spheres", "spheres --count 1000"),
    ("10,000 spheres", "spheres --count 10000"),
    ("20,480 triangles", "icosphere --count 20480"),
]
SCALARS = ["f32", "f64"]


def skip(why):
    print(f"host instructions: not compared, because {why}")
    sys.exit(0)


def run(*command, **options):
    return subprocess.run([str(word) for word in command], check=True, **options)


def collected(program, folder, scene, scalar, size):
    """Instructions of the whole program for one picture."""
    picture = folder / "picture.ppm"
    result = run(
        "valgrind", "--tool=callgrind", f"--callgrind-out-file={folder / 'callgrind.out'}",
        program, "render", scene, "--scalar", scalar, "--threads", "1",
        "--size", f"{size[0]}x{size[1]}", "-o", picture,
        capture_output=True, text=True,
    )
    found = re.search(r"Collected : (\d+)", result.stderr)
    if not found:
        sys.exit(f"callgrind said: {result.stderr}")
    return int(found[1])


def per_pixel(program, folder, scene, scalar):
    large, small = (collected(program, folder, scene, scalar, size) for size in (LARGE, SMALL))
    return (large - small) / (LARGE[0] * LARGE[1] - SMALL[0] * SMALL[1])


def read(table):
    rows = {}
    for line in table.read_text().splitlines()[1:]:
        name, scalar, count = re.split(r"  +", line.strip())
        rows[name, scalar] = float(count)
    return rows


def main():
    is_blessing = sys.argv[1:] == ["--bless"]
    if sys.argv[1:] and not is_blessing:
        sys.exit(__doc__)
    if not shutil.which("valgrind"):
        skip("valgrind is not installed")
    version = run("rustc", "--version", capture_output=True, text=True, cwd=ROOT).stdout.split()[1]
    table = ROOT / f"lab/tables/instructions-rustc-{version}.txt"
    if not table.exists() and not is_blessing:
        skip(f"there is no table of rustc {version}")
    cpu = pathlib.Path("/proc/cpuinfo")
    has_avx2 = cpu.exists() and " avx2 " in cpu.read_text()

    run("cargo", "build", "--quiet", "--release", "-p", "scanray-host", "--target-dir", ROOT / "target", cwd=ROOT)
    program = ROOT / "target/release/scanray"
    counts = {}
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for name, source in ROWS:
            scene = ROOT / source
            if source.split()[0] in ("spheres", "icosphere"):
                scene = folder / "scene.txt"
                run(program, "generate", *source.split(), "-o", scene, capture_output=True)
            for scalar in SCALARS:
                if scalar == "f32" and not has_avx2:
                    print(f"host instructions: {name} in f32 is not compared, because there is no AVX2")
                    continue
                counts[name, scalar] = per_pixel(program, folder, scene, scalar)

    if is_blessing:
        lines = [f"{'scene':<20}  scalar  {'instructions/pixel':>18}"]
        lines += [f"{name:<20}  {scalar:<6}  {count:>18.1f}" for (name, scalar), count in counts.items()]
        table.parent.mkdir(exist_ok=True)
        table.write_text("\n".join(lines) + "\n")
        print(f"{table.relative_to(ROOT)} is written")
        return
    expected = read(table)
    failed = False
    for key, count in counts.items():
        before = expected.get(key)
        change = None if before is None else count / before - 1
        is_wrong = change is None or abs(change) > TOLERANCE
        failed |= is_wrong
        told = "not in the table" if change is None else f"{change:+.2%}"
        print(f"{key[0]:<20}  {key[1]:<6}  {count:>12.1f}  {told}{'  <-- FAILED' if is_wrong else ''}")
    if failed:
        sys.exit("instruction counts have changed: --bless accepts them")


if __name__ == "__main__":
    main()
