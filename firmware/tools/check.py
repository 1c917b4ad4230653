#!/usr/bin/env python3
"""Builds every program, runs it on its emulated board and checks what test.sh promises. Called by test.sh.

    check.py [--bless] [--keep FOLDER]

Prints a line a check. Figures are compared with the text files of tables/; `--bless` writes them. `--keep` leaves the
images in a folder. SCANRAY_BUILD_STD=1 builds the core library from source.
"""

import argparse
import concurrent.futures
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time

import elf
import emulate
import instruction_model
import oled
import profiler
import settings
import stack_bound
from builder import BOARDS, FIRMWARE, Builder, Failed, compiler, scenes
from tables import compare, compare_costs, compare_readme, table

TIMEOUT = 120

PIXELS = 160 * 120
ROW_BYTES = 160 * 4

# What the default scene may be at most on the M4F, in the size profile, and the scene of diffuse spheres.
LIMITS = {("default", "flash"): 7936, ("default", "stack"): 680, ("default", "ram"): 512 + ROW_BYTES,
          ("stage-1-diffuse-spheres", "flash"): 2304}
# Stages that the default scene is also measured without.
STAGES = ("SHADOWS", "SPECULAR", "REFLECTION", "REFRACTION", "BENDING", "PLANES", "TRIANGLES")
# Scenes with a hierarchy -> triangles, as in `scanray generate icosphere --count`.
LARGE_SCENES = {"boulder": 980, "gem": 80}


class Report:
    """What was checked. Lines of concurrent checks do not mix."""

    def __init__(self):
        self.passed, self.failed = 0, 0

    def check(self, name, check):
        """Runs a check, which returns what to say or raises, and gives its value back; None when it fails."""
        try:
            value = check()
        except (Failed, stack_bound.Unknown, oled.Failed, OSError, subprocess.SubprocessError) as why:
            self.failed += 1
            print(f"FAILED  {name}: {why}", flush=True)
            return None
        self.passed += 1
        print(f"ok      {name}" + (f": {value}" if isinstance(value, str) else ""), flush=True)
        return value


def run(image, received=b""):
    """What the board printed."""
    code, printed = emulate.run(image, TIMEOUT, received)
    if code != 0:
        outcome = f"ran longer than {TIMEOUT} s" if code is None else f"ended with {code}"
        raise Failed(f"{outcome}; the board printed: {printed.strip() or 'nothing'}")
    return printed


def values(printed):
    """`key value` lines."""
    return dict(line.rsplit(maxsplit=1) for line in printed.splitlines() if " " in line)


def forbidden(image):
    """What an f32 image must not contain: double precision on soft-float cores, fused multiplication. `vmla` rounds twice."""
    found = [name for name in elf.Image(image).symbols if re.match(r"__aeabi_(d|cd|f2d|i2d|ui2d|l2d|ul2d)", name)
             or re.match(r"__(add|sub|mul|div|extendsf|truncdf|fix\w*|float\w*)df", name)]
    if elf.Image(image).is_arm:
        text = subprocess.run(["arm-none-eabi-objdump", "-d", "--no-show-raw-insn", image],
                              check=True, capture_output=True, text=True).stdout
        found += sorted(set(re.findall(r"\tv(?:fma|fms|fnma|fnms)\S*", text)))
        found += sorted(set(re.findall(r"\t(v\S+\.f64)\b", text)))
    return found


class Measured:
    """An image's figures."""

    def __init__(self, board, image, printed):
        got = values(printed)
        if not {"crc32", "ticks", "stack"} <= got.keys():
            raise Failed(f"the board printed: {printed}")
        binary = elf.Image(image)
        self.crc = got["crc32"]
        self.flash, self.ram = binary.flash(), binary.static_ram()
        self.painted = int(got["stack"], 16)
        self.bound = stack_bound.bound(image)[0]
        self.instructions = int(got["ticks"], 16) * BOARDS[board][2] / PIXELS
        if self.painted > self.bound:
            raise Failed(f"{self.painted} bytes of stack were used, the bound says {self.bound}")
        if elements := forbidden(image):
            raise Failed("the image contains " + ", ".join(element.strip() for element in elements))

    def __str__(self):
        return (f"{self.instructions:,.0f} instructions a pixel, {self.flash:,} B flash, {self.ram} B RAM, "
                f"{self.bound} B stack ({self.painted} B used)")

    def cells(self):
        return [str(self.flash), str(self.ram), str(self.bound), str(self.painted), f"{self.instructions:.1f}"]


class Board:
    """The checks of one board that counts."""

    def __init__(self, name, builder, report, expected, large):
        self.name, self.builder, self.report, self.expected = name, builder, report, expected
        self.large = large  # name -> file
        self.crcs = {}      # scene -> CRC
        self.measured = {}  # (row of the cost table, profile) -> Measured
        self.cycles = {}    # (row, profile, core that the compiler was told) -> (instructions, cycles), M4F only

    def check(self):
        check, column = self.report.check, BOARDS[self.name][1]
        if self.name != "mps2-an385":  # the same code as on the M4F
            check(f"{column} clippy", lambda: self.builder.lint(self.name))
        check(f"{column} counter", self.calibration)
        check(f"{column} a reachable panic does not link", self.panic_control)
        check(f"{column} what is forbidden is found", self.other_controls)
        for scene, path in scenes().items():
            for profile in BOARDS[self.name][3]:
                check(f"{column} {scene} ({profile})", lambda: self.picture(scene, path, scene, profile))
        if self.name == "mps2-an386":
            check(f"{column} boulder", lambda: self.picture("boulder", self.large["boulder"], "boulder", "size"))
            check(f"{column} boulder without bvh",
                  lambda: self.picture("boulder", self.large["boulder"], "boulder without bvh", "size", "BVH"))
            check(f"{column} gem, parsed and its hierarchy built on the board", self.parsed_bvh)
            check(f"{column} a stage that is left out is named by the compiler", self.missing_stage)
            for profile in BOARDS[self.name][3]:
                check(f"{column} default for a core with a name ({profile})", lambda: self.named_core(profile))
            for stage in STAGES:
                row = f"default without {stage.lower()}"
                check(f"{column} {row}", lambda: self.picture("default", "../scenes/default.txt", row, "size", stage))
        check(f"{column} default, cut-off 1/256", self.cutoff)
        check(f"{column} harness alone", self.harness)
        check(f"{column} default, parsed on the board", self.parsed)
        check(f"{column} messages for bad scenes", self.rejected)

    def calibration(self):
        image = self.builder.image(self.name, "calibrate", "calibrate")
        printed = run(image)
        if printed != run(image):
            raise Failed("two runs differ")
        lines = [int(line.split()[1], 16) for line in printed.splitlines()]
        for rounds, ticks in zip(lines[::2], lines[1::2]):
            counted = ticks * BOARDS[self.name][2]
            # A few instructions to call the loop, and the tick under way at each end.
            if not 0 <= counted - 2 * rounds < 16 + 2 * BOARDS[self.name][2]:
                raise Failed(f"{2 * rounds} instructions were counted as {counted:.0f}")
        return f"{2 * lines[0]:,} and {2 * lines[2]:,} instructions are counted as that"

    def panic_control(self):
        try:
            self.builder.image(self.name, "negative_control", "panic")
        except Failed as why:
            if "a_panic_is_reachable" in str(why):
                return
            raise
        raise Failed("it links")

    def other_controls(self):
        image = self.builder.image(self.name, "negative_control", "negative-control", proven=False)
        try:
            stack_bound.bound(image)
            raise Failed("recursion has a bound")
        except stack_bound.Unknown as why:
            if "recursion" not in str(why):
                raise
        # A compiler without hardware for it calls a function, one with hardware is told by the instruction.
        found = " ".join(forbidden(image))
        if not re.search("__aeabi_dmul|__muldf3", found):
            raise Failed(f"no double precision among: {found}")
        if self.name == "mps2-an386":
            if "vfma" not in found:
                raise Failed(f"no fused multiplication among: {found}")
            code, printed = emulate.run(image, TIMEOUT)
            if code == 0 or "not in IEEE mode" not in printed:
                raise Failed(f"with numbers flushed to zero it ends with {code}; the board printed: {printed}")

    def missing_stage(self):
        said = self.builder.missing_stage(self.name)
        if "the scene needs the stage `refraction`" not in said:
            raise Failed(f"the compiler says: {said}")
        return "refraction"

    def picture(self, scene, path, row, profile, without="NONE"):
        image = self.builder.image(self.name, "picture", f"{row}-{profile}".replace(" ", "-"), profile,
                                   SCANRAY_SCENE=path, SCANRAY_WITHOUT=without)
        measured = Measured(self.name, image, run(image))
        self.measured[row, profile] = measured
        if self.name == "mps2-an386":
            self.cycles[row, profile, "generic"] = instructions, _ = profiler.cost(image)
            if abs(instructions - measured.instructions) > 1:
                raise Failed(f"the profiler counts {instructions:.1f} instructions a pixel, the board {measured.instructions:.1f}")
        # The hierarchy is for speed alone.
        if without in ("NONE", "BVH"):
            self.crcs[scene] = measured.crc
            if measured.crc != self.expected.get(scene):
                raise Failed(f"CRC-32 {measured.crc}, the host's is {self.expected.get(scene)}")
        return f"{measured.crc}, {measured}"

    def named_core(self, profile):
        """The same picture by code without multiply-accumulate, which LLVM makes unless it is told the core."""
        image = self.builder.image(self.name, "picture", f"default-{profile}-cortex-m4", profile,
                                   flags=("-Ctarget-cpu=cortex-m4",), SCANRAY_SCENE="../scenes/default.txt")
        crc = values(run(image))["crc32"]
        if crc != self.expected["default"]:
            raise Failed(f"CRC-32 {crc}, the host's is {self.expected['default']}")
        self.cycles["default", profile, "cortex-m4"] = instructions, cycles = profiler.cost(image)
        return f"{crc}, {instructions:,.0f} instructions and about {cycles:,.0f} cycles a pixel"

    def cutoff(self):
        return self.compared("cutoff", "default, cut-off 1/256", "cutoff", SCANRAY_CUTOFF="1.0 / 256.0")

    def parsed_bvh(self):
        return self.compared("parsed_bvh", "gem, parsed, with bvh", "gem", SCANRAY_SCENE=self.large["gem"])

    def compared(self, program, row, expected, **variables):
        """A program that draws what the host expects by this name."""
        image = self.builder.image(self.name, program, program, **variables)
        self.measured[row, "size"] = measured = Measured(self.name, image, run(image))
        if measured.crc != self.expected[expected]:
            raise Failed(f"CRC-32 {measured.crc}, the host's is {self.expected[expected]}")
        return f"{measured.crc}, {measured}"

    def harness(self):
        image = self.builder.image(self.name, "harness", "harness")
        measured = Measured(self.name, image, run(image))
        self.measured["no scene", "size"] = measured
        return str(measured)

    def parsed(self):
        image = self.builder.image(self.name, "parsed", "parsed")
        printed = run(image)
        measured = Measured(self.name, image, printed)
        self.measured["default, parsed", "size"] = measured
        if measured.crc != self.expected["default"]:
            raise Failed(f"CRC-32 {measured.crc}, the host's is {self.expected['default']}")
        place = values(printed)
        if (place["line"], place["column"]) != ("5", "5"):
            raise Failed(f"the mistake at line 5, column 5 is reported as {place['line']}, {place['column']}")
        return f"{measured.crc}, {measured}; a mistake at line 5, column 5"

    def rejected(self):
        printed = run(self.builder.image(self.name, "rejected", "rejected"))
        if printed != self.expected["rejected"]:
            raise Failed(f"the board says\n{printed}the host says\n{self.expected['rejected']}")
        return f"{len(printed.splitlines())}, as the host's"


def example_checks(builder, report, expected):
    """The examples that can run, on the board they are for. Each draws the default scene."""
    with open(os.path.join(FIRMWARE, "../scenes/default.txt"), "rb") as file:
        text = file.read()

    def crc(printed):
        if values(printed).get("crc32") != expected["default"]:
            raise Failed(f"the host's CRC-32 is {expected['default']}; the board printed: {printed}")

    def image(board, example):
        return builder.image(board, example, f"example-{example}", example=True, proven=False)

    def watchdog():
        printed = run(image("mps2-an386", "watchdog"))
        crc(printed)
        if not printed.endswith("starving the watchdog\n"):
            raise Failed(f"the board printed: {printed}")
        return "fed while drawing, it resets the board afterwards"

    def preview():
        printed = run(image("mps2-an386", "preview"))
        crc(printed)
        rays = [int(values(printed)[f"rays until the {what} are drawn"])
                for what in ("blocks of 4x4", "blocks of 2x2", "pixels")]
        if not (rays[0] * 12 < rays[2] and rays[0] < rays[1] < rays[2]):
            raise Failed(f"the passes end after {rays} rays")
        return f"the coarse picture is there after {rays[0] / rays[2]:.1%} of the rays"

    def double_row():
        printed = run(image("mps2-an386", "double_row"))
        crc(printed)
        in_time = int(values(printed)["rows sent in time"])
        if in_time < 30:
            raise Failed(f"{in_time} rows of 120 were sent while the next was traced")
        return f"{in_time} rows of 120 are sent before the next is traced"

    def async_rows():
        printed = run(image("mps2-an386", "async_rows"))
        crc(printed)
        turns = int(values(printed)["turns"])
        if turns < 119:
            raise Failed(f"the other task had {turns} turns between 120 rows")
        return f"another task has {turns} turns between 120 rows"

    def serial_scene():
        board = image("mps2-an386", "serial_scene")
        crc(run(board, text + b"\x04"))
        code, printed = emulate.run(board, TIMEOUT, text.replace(b"600", b"tall", 1) + b"\x04")
        if code in (0, None) or not printed.startswith("line 3, column 5:"):
            raise Failed(f"ended with {code}; the board printed: {printed}")
        return f"a good scene, and a bad one: {printed.splitlines()[0]}"

    def two_harts():
        crc(run(image("virt", "two_harts")))
        return "even and odd rows, the same bits"

    for example in (watchdog, preview, double_row, async_rows, serial_scene, two_harts):
        report.check(f"example {example.__name__}", example)


def oled_check(builder, reference, scene, path, png):
    image = builder.image("lm3s6965evb", "oled", f"oled-{scene}", example=True, SCANRAY_SCENE=path)
    panel = oled.levels(oled.screen_shot(image, TIMEOUT))
    wanted = oled.read_pgm(subprocess.run([reference, "oled", path], cwd=FIRMWARE, check=True, capture_output=True,
                                          text=True).stdout)
    different = sum(a != b for a, b in zip(panel, wanted))
    if different:
        raise Failed(f"{different} of {len(wanted)} pixels differ from the host's picture")
    if png:
        with open(png, "wb") as file:
            file.write(oled.png(panel))
    return f"all {len(panel)} pixels as the host's, {len(set(panel))} greys"


def limit_check(board, row, figure):
    measured = board.measured.get((row, "size"))
    if measured is None:
        raise Failed("was not measured")
    got = {"flash": measured.flash, "stack": measured.bound, "ram": measured.ram}[figure]
    if got > LIMITS[row, figure]:
        raise Failed(f"{got} bytes, {LIMITS[row, figure]} are allowed")
    return f"{got} bytes of {LIMITS[row, figure]}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--bless", action="store_true", help="write the tables")
    parser.add_argument("--keep", metavar="FOLDER", help="leave the images there")
    arguments = parser.parse_args()
    start, report = time.monotonic(), Report()
    images = arguments.keep or tempfile.mkdtemp()
    os.makedirs(images, exist_ok=True)
    try:
        check_all(Builder(images), report, arguments.bless)
    finally:
        if not arguments.keep:
            shutil.rmtree(images)
    times = os.times()
    print(f"firmware checks took {time.monotonic() - start:.0f} s, {times.children_user + times.children_system:.0f} s of them "
          f"CPU time, with {compiler()}")
    print(f"{report.passed} passed, {report.failed} failed")
    sys.exit(report.failed != 0)


def check_all(builder, report, bless):
    # The host first: everything else is compared with it.
    reference = report.check("host reference", builder.reference)
    if reference is None:
        return

    def host(*words):
        return subprocess.run([reference, *words], cwd=FIRMWARE, check=True, capture_output=True, text=True).stdout

    report.check("host tests of the drivers", builder.unit_tests)
    expected = dict(zip(scenes(), host("hash", *scenes().values()).split()))
    expected["rejected"] = host("rejected")
    expected["cutoff"] = host("cutoff", "../scenes/default.txt").strip()

    program = report.check("host program", instruction_model.host_program)
    if program is None:
        return
    large = large_scenes(program, builder.images)
    expected |= zip(large, host("hash", *large.values()).split())

    boards = [Board(name, builder, report, expected, large) for name, (_, _, rate, _) in BOARDS.items() if rate]
    # More than there are cores, as one at most builds; the slowest boards first.
    with concurrent.futures.ThreadPoolExecutor(max_workers=(os.cpu_count() or 1) + 2) as workers:
        work = [workers.submit(board.check) for board in reversed(boards)]
        work.append(workers.submit(oled_checks, builder, report, reference, bless))
        work.append(workers.submit(example_checks, builder, report, expected))
        for done in concurrent.futures.as_completed(work):
            done.result()

    columns = [BOARDS[board.name][1] for board in boards]
    pictures = table(["scene", "x86-64", *columns],
                     [[scene, expected[scene], *(board.crcs.get(scene, "–") for board in boards)] for scene in scenes()])
    print(pictures, end="")
    # Case 68 of `scanray stability`, which compares the host with this table.
    report.check("pictures", lambda: compare("pictures.txt", pictures, bless))

    rows = [[row, profile, BOARDS[board.name][1], *board.measured[row, profile].cells()]
            for board in boards for row, profile in board.measured]
    rows.sort(key=lambda row: (row[1], columns.index(row[2])))
    cost = table(["scene", "profile", "board", "flash", "RAM", "stack bound", "stack used", "instructions/pixel"], rows)
    print(cost, end="")
    report.check("costs", lambda: compare_costs(f"cost-{compiler()}.txt", cost, bless))
    cycles = table(["scene", "profile", "target-cpu", "instructions/pixel", "cycles/pixel"],
                   [[*row, f"{instructions:.1f}", f"{cycles:.0f}"] for row, (instructions, cycles) in
                    sorted(boards[0].cycles.items(), key=lambda item: item[0][1:])])
    print(cycles, end="")
    report.check("cycles", lambda: compare_costs(f"cycles-{compiler()}.txt", cycles, bless))
    report.check("README", lambda: compare_readme(bless))
    model_checks(report, boards, program, builder, large)
    for row, figure in LIMITS:
        report.check(f"M4F {row} {figure}", lambda: limit_check(boards[0], row, figure))


def large_scenes(program, folder):
    """Scenes with a hierarchy, generated: name -> file."""
    paths = {}
    for name, triangles in LARGE_SCENES.items():
        paths[name] = instruction_model.generate(program, folder, name, "icosphere", triangles)
    return paths


def model_checks(report, boards, program, builder, large):
    """The host's prediction of instructions against what the boards counted: a line for each scene and board, and for
    settings such as `scanray tune` recommends."""
    predictions = "predicted_instructions_per_pixel"
    for scene, path in (scenes() | large).items():
        predicted = instruction_model.figures(program, path, (160, 120))[predictions]
        for board in boards:
            measured, core = board.measured.get((scene, "size")), BOARDS[board.name][1]
            if measured and core in predicted:
                report.check(f"{core} {scene}, predicted",
                             lambda: instruction_model.compare(predicted[core], measured.instructions, core))
    size, recommended, predicted_scenes = instruction_model.SIZE, instruction_model.RECOMMENDED, instruction_model.PREDICTED
    paths = [os.path.join(FIRMWARE, scenes()[scene]) for scene in predicted_scenes]
    for scene, index, core, counted in settings.all_counts(builder, size, instruction_model.CORES, paths, recommended):
        def check():
            if isinstance(counted, Exception):
                raise Failed(str(counted))
            predicted = instruction_model.figures(program, paths[scene], size, recommended[index])[predictions]
            return instruction_model.compare(predicted[core], counted, core)

        report.check(f"{core} {predicted_scenes[scene]}, recommended setting {index + 1}, predicted", check)


def oled_checks(builder, report, reference, bless):
    report.check("OLED clippy", lambda: builder.lint("lm3s6965evb"))
    for scene, path in scenes().items():
        png = os.path.join(FIRMWARE, "../docs/oled.png") if bless and scene == "default" else None
        report.check(f"OLED {scene}", lambda: oled_check(builder, reference, scene, path, png))


if __name__ == "__main__":
    main()
