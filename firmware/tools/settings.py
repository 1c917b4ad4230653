#!/usr/bin/env python3
"""Counts the instructions that pictures take on the emulated boards, setting by setting: settings.py < JOB

The job is JSON: `size`, width and height; `cores`, of M4F, M3 and M0; `scenes`, their texts; `settings`, objects with the fields of
`scanray report`'s JSON. Prints a line of JSON for each picture: `scene` and `setting`, which are indices, `core` and
`instructions` a pixel; or one with `scene`, `core`, `settings` and `error`, where a program cannot be built or ends with a mistake.

A program is compiled for each way of sampling, with a cut-off or without, for each kind of display and each way to compute powers. What a
program can set without being compiled again (depth, cut-off, threshold, size of the blocks) is unknown to the compiler. Of
a picture that has more than 100,000 samples, as many to each pixel, so many rows are drawn as have 100,000, and stand for all.
"""

import collections
import concurrent.futures
import itertools
import json
import math
import os
import sys
import tempfile

import emulate
from builder import BOARDS, Builder, Failed

TIMEOUT = 3600
BOARD_OF = {column: board for board, (_, column, _, _) in BOARDS.items() if board != "virt"}
# More samples than that are not drawn of a picture.
ENOUGH_SAMPLES = 100_000
BLOCKS = {"full": 1, "half": 2, "quarter": 4}

Code = collections.namedtuple("Code", "method samples has_cutoff color dither power")
Run = collections.namedtuple("Run", "max_depth cutoff threshold block of_rows")


def split(setting, size):
    """What is compiled, and what is set for a picture of a size."""
    block = BLOCKS[setting.get("preview", "full")]
    samples, threshold, cutoff = setting["samples"], setting["adaptive"], setting["cutoff"]
    if threshold is not None:
        method = "Adaptive"
    else:
        method = "Preview" if block > 1 else "Fixed"
    code = Code(method, samples, cutoff != 0, setting["color"], setting["dither"], setting["power"])
    of_rows = 1
    if method == "Fixed":
        of_rows = min(size[1], math.ceil(size[0] * size[1] * samples / ENOUGH_SAMPLES))
    return code, Run(setting["max_depth"], float(cutoff), float(threshold or 0), block, of_rows)


def source(size, code, runs):
    """The items that the program `settings` includes."""
    color = "BinaryColor" if code.color == "binary" else code.color.capitalize()
    cutoff = "cutoff = $run.cutoff, " if code.has_cutoff else ""
    written = ", ".join("Run {{ max_depth: {}, cutoff: {}, threshold: {}, block: {}, of_rows: {} }}".format(*run) for run in runs)
    return f"""
type Shown = embedded_graphics::pixelcolor::{color};
const DITHERED: bool = {str(code.dither).lower()};
const RESOLUTION: Resolution = Resolution {{ width: {size[0]}, height: {size[1]} }};
const METHOD: Method = Method::{code.method};
const SAMPLES: usize = {code.samples};
const STACK: usize = {max(1, *(run.max_depth for run in runs))};
const RUNS: &[Run] = &[{written}];
macro_rules! tracer {{ ($run:ident) => {{ tracer_for!(SCENE, {cutoff}stack = STACK) }} }}
"""


def rows(run, size):
    """How many rows a run draws."""
    return max(1, len(range(run.of_rows // 2, size[1], run.of_rows)))


def count(builder, name, board, scene, size, code, runs):
    """Instructions a pixel of the whole picture, run by run."""
    image = builder.image(board, "settings", name, proven=False, SCANRAY_SCENE=os.path.abspath(scene),
                          SCANRAY_SETTINGS=source(size, code, runs), SCANRAY_POWER=code.power)
    status, printed = emulate.run(image, TIMEOUT)
    os.remove(image)
    ticks = [int(line.split()[1], 16) for line in printed.splitlines() if line.startswith("ticks ")]
    if status != 0 or len(ticks) != len(runs):
        outcome = f"ran longer than {TIMEOUT} s" if status is None else f"ended with {status}"
        raise Failed(f"the program {outcome} and printed: {printed.strip() or 'nothing'}")
    return [tick * BOARDS[board][2] / (size[0] * rows(run, size)) for tick, run in zip(ticks, runs)]


def jobs(size, cores, scenes, settings):
    """(core, scene's index, code, indices of settings), what takes longest first."""
    codes = collections.defaultdict(list)
    for index, setting in enumerate(settings):
        codes[split(setting, size)[0]].append(index)
    longest_first = sorted(codes.items(), key=lambda item: (item[0].method != "Adaptive", -item[0].samples))
    slowest_first = sorted(cores, key=["M0", "M3", "M4F"].index)
    for core, (code, indices), scene in itertools.product(slowest_first, longest_first, range(len(scenes))):
        yield core, scene, code, indices


def all_counts(builder, size, cores, scenes, settings):
    """What was counted as (scene's index, setting's index, core, instructions), and what failed as (scene's index, indices of settings,
    core, Failed), in the order in which it is done."""

    def work(number, core, scene, code, indices):
        runs = [split(settings[index], size)[1] for index in indices]
        try:
            counted = count(builder, f"settings-{number}", BOARD_OF[core], scenes[scene], size, code, runs)
        except (Failed, OSError) as why:
            return [(scene, indices, core, why)]
        return [(scene, index, core, instructions) for index, instructions in zip(indices, counted)]

    with concurrent.futures.ThreadPoolExecutor(max_workers=os.cpu_count() or 1) as workers:
        futures = [workers.submit(work, number, *job) for number, job in enumerate(jobs(size, cores, scenes, settings))]
        for done in concurrent.futures.as_completed(futures):
            yield from done.result()


def main():
    if len(sys.argv) != 1:
        sys.exit(__doc__)
    job = json.load(sys.stdin)
    with tempfile.TemporaryDirectory() as folder:
        paths = []
        for number, text in enumerate(job["scenes"]):
            paths.append(os.path.join(folder, f"scene-{number}.txt"))
            with open(paths[-1], "w", encoding="utf-8") as file:
                file.write(text)
        for scene, setting, core, found in all_counts(Builder(folder), job["size"], job["cores"], paths, job["settings"]):
            if isinstance(found, Exception):
                line = {"scene": scene, "settings": setting, "core": core, "error": str(found).strip()}
            else:
                line = {"scene": scene, "setting": setting, "core": core, "instructions": found}
            print(json.dumps(line), flush=True)


if __name__ == "__main__":
    main()
