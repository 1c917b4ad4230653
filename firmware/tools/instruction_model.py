#!/usr/bin/env python3
"""Fits the host's instruction model to pictures drawn under emulation, and writes its coefficients.

    instruction_model.py [--dry-run]

Draws the scenes of ../scenes and scenes/, and scenes made up at random, at several maximum depths on the M4F, M3 and M0, and has
`scanray render --json` count what the tracer does for the same pictures: rays, tests and hits by kind. The coefficients are the
instructions that each of these takes, none below 0, with the least sum of squared relative errors. Prints how far the model is
off, for each scene also when it is fitted without the scene; writes ../host-runner/src/cost/instructions.txt unless told not to.
Takes ten minutes or so on two cores.
"""

import argparse
import collections
import concurrent.futures
import json
import os
import random
import subprocess
import sys
import tempfile

import emulate
from builder import BOARDS, FIRMWARE, Builder, Failed, compiler, scenes

TABLE = os.path.join(FIRMWARE, "..", "host-runner", "src", "cost", "instructions.txt")
CORES = ("mps2-an386", "mps2-an385", "microbit")
TERMS = ["primary_rays", "reflected_rays", "refracted_rays", "shadow_rays", "sphere_tests", "plane_tests", "triangle_tests",
         "sphere_crossings", "ball_crossings", "sphere_hits", "plane_hits", "triangle_hits", "bending_hits", "lit", "highlights"]
MADE_UP = 12
# As `depths` draws.
SIZE = (80, 60)
PIXELS = SIZE[0] * SIZE[1]
TIMEOUT = 1200
# How far off a prediction may be.
TOLERANCE = 0.10


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
    for plane in chance.sample([(0, 1, 0, 1.5), (0, 0, -1, 9), (1, 0, 0, 5), (-1, 0, 0, 5)], chance.choice([0, 1, 2, 4])):
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


def all_scenes(folder):
    """Scene name -> path."""
    found = {name: os.path.join(FIRMWARE, path) for name, path in scenes().items()}
    for number in range(MADE_UP):
        path = os.path.join(folder, f"made-up-{number}.txt")
        with open(path, "w", encoding="utf-8") as file:
            file.write(made_up(number))
        found[f"made up {number}"] = path
    return found


def measure(builder, board, name, path):
    """Maximum depth -> instructions a pixel."""
    image = builder.image(board, "depths", f"depths-{name}".replace(" ", "-"), proven=False, SCANRAY_SCENE=path)
    code, printed = emulate.run(image, TIMEOUT)
    if code != 0:
        raise Failed(f"{name} on {board}: ended with {code}; the board printed: {printed}")
    lines = [line.split() for line in printed.splitlines()]
    depths = [int(value) for key, value in lines if key == "depth"]
    ticks = [int(value, 16) for key, value in lines if key == "ticks"]
    return {depth: count * BOARDS[board][2] / PIXELS for depth, count in zip(depths, ticks)}


def host_program():
    """The path of `scanray`."""
    root = os.path.dirname(FIRMWARE)
    subprocess.run(["cargo", "build", "--quiet", "--release", "--package", "scanray-host"], cwd=root, check=True)
    metadata = subprocess.run(["cargo", "metadata", "--no-deps", "--format-version", "1"], cwd=root, check=True,
                              capture_output=True, text=True).stdout
    return os.path.join(json.loads(metadata)["target_directory"], "release", "scanray")


def figures(program, path, size, depth=None):
    """What the host prints of a picture, without keeping it."""
    words = [program, "render", path, "--size", f"{size[0]}x{size[1]}", "--json", "-o", os.devnull]
    done = subprocess.run(words + (["--max-depth", str(depth)] if depth is not None else []), cwd=FIRMWARE,
                          check=True, capture_output=True, text=True)
    return json.loads(done.stdout)


def compare(predicted, counted):
    """How far off a prediction is, if it is not too far off."""
    off = f"{predicted:,.0f} instructions a pixel, {counted:,.0f} were counted: {100 * (predicted / counted - 1):+.1f} %"
    if abs(predicted / counted - 1) > TOLERANCE:
        raise Failed(off + "; fit the model again (instruction_model.py)")
    return off


Picture = collections.namedtuple("Picture", "scene depth counts instructions")


def fit(pictures):
    """Instructions of each term."""
    rows = [[count / picture.instructions for count in picture.counts] for picture in pictures]
    span = range(len(TERMS))
    products = [[sum(row[i] * row[j] for row in rows) for j in span] for i in span]
    sums = [sum(row[i] for row in rows) for i in span]
    # Coordinate descent finds the least squares with no coefficient below 0.
    found = [0.0] * len(TERMS)
    for _ in range(20_000):
        for i in span:
            if products[i][i] > 0:
                rest = sum(products[i][j] * found[j] for j in span) - products[i][i] * found[i]
                found[i] = max(0.0, (sums[i] - rest) / products[i][i])
    return found


def error(coefficients, picture):
    """Relative."""
    return sum(c * n for c, n in zip(coefficients, picture.counts)) / picture.instructions - 1


def worst(coefficients, pictures):
    return max((error(coefficients, picture) for picture in pictures), key=abs)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--dry-run", action="store_true", help="print, but do not write the coefficients")
    arguments = parser.parse_args()
    program = host_program()
    with tempfile.TemporaryDirectory() as folder:
        known = all_scenes(folder)
        builder = Builder(folder)
        jobs = [(board, name) for board in reversed(CORES) for name in known]
        with concurrent.futures.ThreadPoolExecutor(max_workers=2) as workers:
            measured = dict(zip(jobs, workers.map(lambda job: measure(builder, *job, known[job[1]]), jobs)))
        counts = {}
        for name, path in known.items():
            for depth in measured[CORES[0], name]:
                work = figures(program, path, SIZE, depth)["work"]
                counts[name, depth] = [work[term] / PIXELS for term in TERMS]

    columns = {}
    for board in CORES:
        pictures = [Picture(name, depth, counts[name, depth], instructions)
                    for name in known for depth, instructions in measured[board, name].items()]
        coefficients = columns[board] = fit(pictures)
        print(f"{BOARDS[board][1]}: largest error of the model, and of one that is fitted without the scene")
        for name in known:
            its = [picture for picture in pictures if picture.scene == name]
            without = fit([picture for picture in pictures if picture.scene != name])
            print(f"  {name:28}{100 * worst(coefficients, its):+8.1f} %{100 * worst(without, its):+8.1f} %", flush=True)

    lines = ["# Instructions for each thing that the tracer does, by core: the coefficients of the instruction model.",
             f"# Written by firmware/tools/instruction_model.py with {compiler()}.",
             f"{'term':18}" + "".join(f"{BOARDS[board][1]:>10}" for board in CORES)]
    for index, term in enumerate(TERMS):
        lines.append(f"{term:18}" + "".join(f"{columns[board][index]:10.1f}" for board in CORES))
    print("\n".join(lines))
    if not arguments.dry_run:
        with open(TABLE, "w", encoding="utf-8") as file:
            file.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    try:
        main()
    except Failed as why:
        sys.exit(str(why))
