#!/usr/bin/env python3
"""Fits the host's instruction model to pictures drawn under emulation, and writes its coefficients.

    instruction_model.py [--dry-run] [--counted FILE]

Draws the scenes of scenes/, made-up ones and some with a hierarchy on the M4F, M3 and M0, some with more settings, and has
`scanray render --json` count the model's terms for the same pictures. The coefficients are the instructions that each term takes,
none below 0, with the least sum of squared relative errors. How far the model is off is told of these pictures and of others, which
are held out: the scenes of ../scenes, and more hierarchies. Prints it scene by scene, and writes
../host-runner/src/cost/instructions.txt unless told not to; the largest error in it is what the host's programs tell their users
and what test.sh allows. `--counted` takes what the boards counted from a file if it is there, and else writes it. Takes ten minutes
or so on two cores.
"""

import argparse
import collections
import json
import math
import operator
import os
import random
import subprocess
import sys
import tempfile

import settings
from builder import FIRMWARE, Builder, Failed, compiler, scenes

TABLE = os.path.join(FIRMWARE, "..", "host-runner", "src", "cost", "instructions.txt")
CORES = ("M4F", "M3", "M0")
# A quarter of the pictures whose costs are published: a pixel takes about as much, and there are many to draw.
SIZE = (80, 60)


def setting(**changed):
    """As `scanray report` names it; what is not named is the default."""
    default = {"max_depth": 5, "cutoff": 0, "samples": 1, "adaptive": None, "power": "squaring", "preview": "full",
               "color": "rgb888", "dither": False}
    return default | changed


# Such as `scanray tune` recommends.
RECOMMENDED = [setting(samples=4, max_depth=3), setting(samples=16, adaptive=1 / 8, cutoff=1 / 256),
               setting(color="rgb565", dither=True, max_depth=2)]
DEPTHS = [setting(max_depth=0), setting(max_depth=2), setting()]
MORE = [setting(cutoff=1 / 64, max_depth=8), *RECOMMENDED, setting(preview="half"), setting(preview="quarter")]
# Scenes that test.sh draws with the recommended settings.
PREDICTED = ("default", "mirror-room")
MADE_UP = [f"made up {number}" for number in range(16)]
# Scenes with a hierarchy -> arguments of `scanray generate`.
LARGE = {"gem": ("icosphere", 80), "boulder": ("icosphere", 980), "swarm": ("spheres", 60), "crowd": ("spheres", 300),
         "ball": ("icosphere", 320), "flock": ("spheres", 150)}
STAGES = [name for name, path in scenes().items() if path.startswith("scenes/")]
# Scenes and settings that the model is fitted to, and those that it only has to predict.
FITTED = [(["sky", *STAGES, *MADE_UP, "gem", "boulder", "swarm", "crowd"], DEPTHS), (["sky", "made up 3", "made up 5", "gem"], MORE)]
HELD_OUT = [([*(name for name in scenes() if name not in STAGES), "ball", "flock"], DEPTHS), (PREDICTED, MORE)]

# Nothing but the gradient of the sky.
SKY = "0\n0 0 0\n160 120\n0 9 0 1 1 1 1 1 1\n0.2\n1\n0 0 0\n"


def made_up(number):
    """The text of a scene: a few objects of each kind at random places in view, of random materials."""
    chance = random.Random(number)

    def between(low, high):
        return low + (high - low) * chance.random()

    def material():
        reflection = chance.choice([0, 0, 0.2, 0.5, 0.8])
        refraction, index = chance.choice([(0, 0), (0, 0), (0, 0), (0.7, 1.5), (0.8, 1.0)])
        specular = chance.choice([0, 0.7])
        shininess = chance.choice([8, 50, 120])
        colors = [round(between(0.05, 0.9), 3) for _ in range(3)]
        return [*colors, *[specular] * 3, *colors, reflection, shininess, refraction, index]

    def point(spread=1.0):
        z = between(2.5, 8)
        return [between(-0.6, 0.6) * z * spread, between(-0.45, 0.45) * z * spread, z]

    objects = []
    for _ in range(chance.choice([0, 2, 5, 9])):
        objects.append([0, *point(), between(0.2, 1.1), *material()])
    planes = [(0, 1, 0, 1.5), (0, 0, -1, 9), (1, 0, 0, 5), (-1, 0, 0, 5), (0.8, 0, -0.6, 7), (-0.6, 0, -0.8, 8), (0, 0.96, -0.28, 2)]
    for plane in chance.sample(planes, chance.choice([0, 1, 2, 4])):
        objects.append([1, *plane, *material()])
    for _ in range(chance.choice([0, 1, 4, 10])):
        center, size = point(), between(0.5, 2.5)
        corners = [c + between(-size, size) for _ in range(3) for c in center]
        objects.append([2, *corners, 0, 0, 0, 0, *material()])
    if not objects:
        return made_up(number + 1000)
    lines = [[len(objects)], [0, 0, 0], [160, 120], [between(-6, 6), between(2, 9), -3, *[1] * 6], [0.2],
             [chance.choice([0, 1])], [0.1, 0.1, 0.2], *objects]
    return "\n".join(" ".join(str(value) for value in line) for line in lines) + "\n"


def all_scenes(program, folder):
    """Scene name -> path."""
    found = {name: os.path.join(FIRMWARE, path) for name, path in scenes().items()}
    written = {"sky": SKY} | {name: made_up(number) for number, name in enumerate(MADE_UP)}
    for name, text in written.items():
        found[name] = os.path.join(folder, f"{name}.txt")
        with open(found[name], "w", encoding="utf-8") as file:
            file.write(text)
    for name, (kind, count) in LARGE.items():
        found[name] = generate(program, folder, name, kind, count)
    return found


def generate(program, folder, name, kind, count):
    """The path of a large scene."""
    path = os.path.join(os.path.abspath(folder), f"{name}.txt")
    subprocess.run([program, "generate", kind, "--count", str(count), "-o", path], check=True, capture_output=True)
    return path


def host_program():
    """The path of `scanray`."""
    root = os.path.dirname(FIRMWARE)
    subprocess.run(["cargo", "build", "--quiet", "--release", "--package", "scanray-host"], cwd=root, check=True)
    metadata = subprocess.run(["cargo", "metadata", "--no-deps", "--format-version", "1"], cwd=root, check=True,
                              capture_output=True, text=True).stdout
    return os.path.join(json.loads(metadata)["target_directory"], "release", "scanray")


def figures(program, path, size, of=None):
    """What the host prints of a picture with a setting, without keeping it."""
    words = [program, "render", path, "--size", f"{size[0]}x{size[1]}", "--json", "-o", os.devnull]
    if of is not None:
        words += ["--max-depth", str(of["max_depth"]), "--samples", str(of["samples"]), "--cutoff", str(of["cutoff"]),
                  "--preview", of["preview"], "--color", of["color"], *(["--dither"] if of["dither"] else [])]
        if of["adaptive"] is not None:
            words += ["--adaptive", str(of["adaptive"])]
    done = subprocess.run(words, cwd=FIRMWARE, check=True, capture_output=True, text=True)
    return json.loads(done.stdout)


def within(core):
    """By what share a prediction may be off, as the table says."""
    with open(TABLE, encoding="utf-8") as file:
        rows = [line.split() for line in file if not line.startswith("#")]
    column = rows[0].index(core)
    return max(float(row[column]) for row in rows if row[0].startswith("largest_error")) / 100


def compare(predicted, counted, core):
    """How far off a prediction is, if it is not farther off than the table says."""
    off = f"{predicted:,.0f} instructions a pixel, {counted:,.0f} were counted: {100 * (predicted / counted - 1):+.1f} %"
    if abs(predicted / counted - 1) > within(core):
        raise Failed(f"{off}, the table says {within(core):.0%}; fit the model again (instruction_model.py)")
    return off


Picture = collections.namedtuple("Picture", "scene setting counts instructions")


def fit(pictures):
    """Instructions of each term."""
    rows = [[count / picture.instructions for count in picture.counts] for picture in pictures]
    span = range(len(rows[0]))
    products = [[sum(row[i] * row[j] for row in rows) for j in span] for i in span]
    sums = [sum(row[i] for row in rows) for i in span]
    # Coordinate descent finds the least squares with no coefficient below 0.
    found = [0.0] * len(rows[0])
    for _ in range(10_000):
        for i in span:
            line = products[i]
            if line[i] > 0:
                rest = sum(map(operator.mul, line, found)) - line[i] * found[i]
                found[i] = max(0.0, (sums[i] - rest) / line[i])
    return found


def error(coefficients, picture):
    """Relative."""
    return sum(map(operator.mul, coefficients, picture.counts)) / picture.instructions - 1


def count_all(builder, known, groups):
    """[scene's name, setting, core, instructions a pixel]."""
    found = []
    for names, wanted in groups:
        for scene, index, core, counted in settings.all_counts(builder, SIZE, CORES, [known[name] for name in names], wanted):
            if isinstance(counted, Exception):
                raise Failed(f"{names[scene]} on {core}: {counted}")
            found.append([names[scene], wanted[index], core, counted])
    return found


def errors(title, coefficients, pictures):
    """Median and largest error in percent, the largest rounded up; prints the largest of each scene."""
    off = [error(coefficients, picture) for picture in pictures]
    print(title)
    for name in dict.fromkeys(picture.scene for picture in pictures):
        value, of = max(((e, p.setting) for e, p in zip(off, pictures) if p.scene == name), key=lambda pair: abs(pair[0]))
        words = ", ".join(f"{key} {value}" for key, value in of.items() if setting()[key] != value) or "default"
        print(f"  {name:28}{100 * value:+8.1f} %  {words}", flush=True)
    sizes = sorted(100 * abs(e) for e in off)
    return sizes[len(sizes) // 2], math.ceil(sizes[-1])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--dry-run", action="store_true", help="print, but do not write the coefficients")
    parser.add_argument("--counted", metavar="FILE", help="what the boards counted: read if it is there, else written")
    arguments = parser.parse_args()
    program = host_program()
    with tempfile.TemporaryDirectory() as folder:
        known = all_scenes(program, folder)
        if arguments.counted and os.path.exists(arguments.counted):
            with open(arguments.counted, encoding="utf-8") as file:
                counted = json.load(file)
        else:
            builder = Builder(folder)
            counted = [count_all(builder, known, groups) for groups in (FITTED, HELD_OUT)]
            if arguments.counted:
                with open(arguments.counted, "w", encoding="utf-8") as file:
                    json.dump(counted, file)
        terms = {}
        for name, of, _, _ in sum(counted, []):
            key = name, json.dumps(of)
            if key not in terms:
                terms[key] = figures(program, known[name], SIZE, of)["work"]

    def pictures(part, core):
        pixels = SIZE[0] * SIZE[1]
        return [Picture(name, of, [count / pixels for count in terms[name, json.dumps(of)].values()], instructions)
                for name, of, counted_on, instructions in part if counted_on == core]

    rows = collections.defaultdict(list)
    for core in CORES:
        fitted, held_out = (pictures(part, core) for part in counted)
        coefficients = fit(fitted)
        for kind, its in (("fitted", fitted), ("held_out", held_out)):
            median, largest = errors(f"{core}, {kind}: largest error of each scene", coefficients, its)
            rows[f"median_error_{kind}"].append(f"{median:.1f}")
            rows[f"largest_error_{kind}"].append(str(largest))
        for term, each in zip(next(iter(terms.values())), coefficients):
            rows[term].append(f"{each:.1f}")

    lines = ["# How far the instruction model is off, in percent, over the pictures it is fitted to and over others, and its coefficients:",
             "# instructions for each thing that the tracer does, by core.",
             f"# Written by firmware/tools/instruction_model.py with {compiler()}.",
             f"{'term':28}" + "".join(f"{core:>10}" for core in CORES)]
    lines += [f"{name:28}" + "".join(f"{cell:>10}" for cell in cells) for name, cells in rows.items()]
    print("\n".join(lines))
    if not arguments.dry_run:
        with open(TABLE, "w", encoding="utf-8") as file:
            file.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    try:
        main()
    except Failed as why:
        sys.exit(str(why))
