#!/usr/bin/env python3
"""Fits the host's instruction model to pictures drawn under emulation, and writes its coefficients.

    instruction_model.py [--dry-run] [--counted FILE]

Draws the scenes of ../scenes and scenes/, scenes made up at random and scenes with a tree on the M4F, M3 and M0, with SETTINGS, and has
`scanray render --json` count what the tracer does for the same pictures: rays, tests and hits by kind. The coefficients are the
instructions that each of these takes, none below 0, with the least sum of squared relative errors, in which large errors weigh
more. Prints how far the model is off, for each scene also when it is fitted without the scene, and for each setting; fails if it
is off by more than 15 % somewhere. Writes ../host-runner/src/cost/instructions.txt unless told not to. `--counted` takes what the
boards counted from a file if it is there, and else writes it, to try another model on it. Takes ten minutes or so on two cores.
"""

import argparse
import collections
import json
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
TERMS = ["repeated_pixels", "block_pixels", "dithered_pixels", "primary_rays", "reflected_rays", "refracted_rays", "shadow_rays", "sphere_tests", "plane_tests", "triangle_tests",
         "exact_sphere_tests", "exact_ball_tests", "slanted_plane_tests", "plane_divisions", "sphere_tests_in_loops",
         "plane_tests_in_loops", "triangle_tests_in_loops", "sphere_crossings", "bounds_crossings", "sphere_hits", "plane_hits",
         "triangle_hits", "slanted_hits", "bending_hits", "colored_hits", "sky_rays", "lights_behind", "lit", "colored_lit", "lit_glossy",
         "highlights", "row_checks", "rays_among_planes", "rays_among_triangles", "shadow_rays_among_triangles",
         "box_tests", "bvh_rays", "bvh_shadow_rays", "added_samples", "compared_pixels", "compared_rays", "compared_tests",
         "compared_rays_among_triangles", "branching_hits", "cutoff_hits"]
MADE_UP = 12
# Scenes with a tree -> arguments of `scanray generate`.
LARGE = {"gem": ("icosphere", 80), "ball": ("icosphere", 320), "boulder": ("icosphere", 980), "swarm": ("spheres", 60),
         "flock": ("spheres", 150), "crowd": ("spheres", 300)}
# A quarter of the pictures whose costs are published: a pixel takes about as much, and there are many to draw.
SIZE = (80, 60)
PIXELS = SIZE[0] * SIZE[1]


def setting(**changed):
    """As `scanray report` names it; what is not named is the default."""
    default = {"max_depth": 5, "cutoff": 0, "samples": 1, "adaptive": None, "power": "squaring", "preview": "full",
               "color": "rgb888", "dither": False}
    return default | changed


# Such as `scanray tune` recommends.
RECOMMENDED = [setting(samples=4, max_depth=3), setting(samples=16, adaptive=1 / 8, cutoff=1 / 256),
               setting(color="rgb565", dither=True, max_depth=2)]
SETTINGS = [setting(max_depth=0), setting(max_depth=2), setting(), setting(max_depth=8),
            setting(cutoff=1 / 256, max_depth=8), setting(cutoff=1 / 64), *RECOMMENDED, setting(preview="half"), setting(preview="quarter")]
# How far off a prediction may be.
# Since the core was rebuilt adaptive sampling takes up to 14 % fewer instructions than the model predicts, which was fitted before.
TOLERANCE = 0.15


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


def all_scenes(program, folder):
    """Scene name -> path."""
    found = {name: os.path.join(FIRMWARE, path) for name, path in scenes().items()}
    written = {"sky": SKY} | {f"made up {number}": made_up(number) for number in range(MADE_UP)}
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


def compare(predicted, counted):
    """How far off a prediction is, if it is not too far off."""
    off = f"{predicted:,.0f} instructions a pixel, {counted:,.0f} were counted: {100 * (predicted / counted - 1):+.1f} %"
    if abs(predicted / counted - 1) > TOLERANCE:
        raise Failed(off + "; fit the model again (instruction_model.py)")
    return off


Picture = collections.namedtuple("Picture", "scene setting counts instructions")


def fit(pictures, refinements=12):
    """Instructions of each term."""
    weights = [1.0] * len(pictures)
    found = least_squares(pictures, weights)
    for _ in range(refinements):
        # What is far off weighs more, so that the largest error shrinks.
        errors = [abs(error(found, picture)) + 0.02 for picture in pictures]
        mean = sum(errors) / len(errors)
        weights = [0.5 * weight + 0.5 * (e / mean) ** 2 for weight, e in zip(weights, errors)]
        found = least_squares(pictures, weights)
    return found


def least_squares(pictures, weights):
    rows = [[count / picture.instructions for count in picture.counts] for picture in pictures]
    span = range(len(TERMS))
    products = [[sum(w * row[i] * row[j] for w, row in zip(weights, rows)) for j in span] for i in span]
    sums = [sum(w * row[i] for w, row in zip(weights, rows)) for i in span]
    # What few pictures tell of is guessed low rather than without bound, as if each term occurred at a pixel in 50.
    typical = sorted(picture.instructions for picture in pictures)[len(pictures) // 2]
    for i in span:
        products[i][i] += sum(weights) * (0.02 / typical) ** 2
    # Coordinate descent finds the least squares with no coefficient below 0.
    found = [0.0] * len(TERMS)
    for _ in range(1000):
        for i in span:
            line = products[i]
            if line[i] > 0:
                rest = sum(map(operator.mul, line, found)) - line[i] * found[i]
                found[i] = max(0.0, (sums[i] - rest) / line[i])
    return found


def error(coefficients, picture):
    """Relative."""
    return sum(c * n for c, n in zip(coefficients, picture.counts)) / picture.instructions - 1


def worst(coefficients, pictures):
    return max((error(coefficients, picture) for picture in pictures), key=abs)


def count_all(builder, known):
    """[scene's name, index of the setting, core, instructions a pixel]."""
    names = list(known)
    found = []
    for scene, index, core, instructions in settings.all_counts(builder, SIZE, CORES, list(known.values()), SETTINGS):
        if isinstance(instructions, Exception):
            # A scene may be too large for a board.
            print(f"not counted: {names[scene]} on {core}: {str(instructions).strip().splitlines()[-1]}", flush=True)
        else:
            found.append([names[scene], index, core, instructions])
    return found


def report(core, pictures):
    """Prints how far a model is off, and gives its coefficients and whether that is near enough."""
    coefficients = fit(pictures)
    print(f"{core}: largest error of the model, and of one that is fitted without the scene")
    for name in dict.fromkeys(picture.scene for picture in pictures):
        its = [picture for picture in pictures if picture.scene == name]
        without = fit([picture for picture in pictures if picture.scene != name], 0)
        print(f"  {name:28}{100 * worst(coefficients, its):+8.1f} %{100 * worst(without, its):+8.1f} %", flush=True)
    print(f"{core}: largest error by setting")
    for index, of in enumerate(SETTINGS):
        its = [picture for picture in pictures if picture.setting == index]
        if not its:
            continue
        name = ", ".join(f"{key} {value}" for key, value in of.items() if setting()[key] != value) or "default"
        print(f"  {name:44}{100 * worst(coefficients, its):+8.1f} %", flush=True)
    return coefficients, abs(worst(coefficients, pictures)) <= TOLERANCE


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
            counted = count_all(Builder(folder), known)
            if arguments.counted:
                with open(arguments.counted, "w", encoding="utf-8") as file:
                    json.dump(counted, file)
        works = {}
        for name, index in sorted({(name, index) for name, index, _, _ in counted}):
            work = figures(program, known[name], SIZE, SETTINGS[index])["work"]
            works[name, index] = [work[term] / PIXELS for term in TERMS]

    columns, is_near = {}, True
    for core in CORES:
        pictures = [Picture(name, index, works[name, index], instructions)
                    for name, index, counted_on, instructions in sorted(counted) if counted_on == core]
        columns[core], core_is_near = report(core, pictures)
        is_near &= core_is_near

    lines = ["# Instructions for each thing that the tracer does, by core: the coefficients of the instruction model.",
             f"# Written by firmware/tools/instruction_model.py with {compiler()}.",
             f"{'term':28}" + "".join(f"{core:>10}" for core in CORES)]
    for index, term in enumerate(TERMS):
        lines.append(f"{term:28}" + "".join(f"{columns[core][index]:10.1f}" for core in CORES))
    print("\n".join(lines))
    if not arguments.dry_run:
        with open(TABLE, "w", encoding="utf-8") as file:
            file.write("\n".join(lines) + "\n")
    if not is_near:
        raise Failed(f"the model is off by more than {TOLERANCE:.0%}")


if __name__ == "__main__":
    try:
        main()
    except Failed as why:
        sys.exit(str(why))
