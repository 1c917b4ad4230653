#!/usr/bin/env python3
"""Counts the shares of instructions that take more than a cycle, and writes them for the host's estimates of time.

    instruction_mix.py [--dry-run]

Three scenes on each of the cores M4F, M3 and M0, at 160×120: the least and the largest share of the three. A load or store of
several registers counts each.
"""

import argparse
import os
import sys
import tempfile

from builder import BOARDS, FIRMWARE, Builder, Failed
from profiler import profile

SCENES = ("../scenes/default.txt", "../scenes/window-room.txt", "scenes/stage-3-mirrors.txt")
CORES = ("mps2-an386", "mps2-an385", "microbit")
TABLE = os.path.normpath(os.path.join(FIRMWARE, "../lab/src/cost/mix.txt"))


def transfers(instruction):
    """How many registers a load or store moves."""
    if "{" in instruction.operands:
        return instruction.registers()
    return 2 if instruction.name in ("ldrd", "strd") else 1


SHARES = {
    "loads": lambda i: i.executed * transfers(i) if i.kind == "load" else 0,
    "stores": lambda i: i.executed * transfers(i) if i.kind == "store" else 0,
    "taken_branches": lambda i: i.jumped,
    "divides_and_roots": lambda i: i.executed if i.kind == "float divide, root" else 0,
    "multiply_accumulates": lambda i: i.executed if i.kind == "float multiply-accumulate" else 0,
    "integer_divides": lambda i: i.executed if i.kind == "integer divide" else 0,
    "long_multiplications": lambda i: i.executed if i.name in ("umull", "smull", "umlal", "smlal") else 0,
}


def shares(builder, board, scene):
    """The share of each."""
    _, instructions, is_bounded = profile(builder.image(board, "picture", "mix", SCANRAY_SCENE=scene))
    if not is_bounded:
        raise Failed("no reading of the counter was recognised")
    executed = sum(i.executed for i in instructions.values())
    return {name: sum(map(of, instructions.values())) / executed for name, of in SHARES.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--dry-run", action="store_true", help="print, but do not write the table")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        builder = Builder(folder)
        try:
            counted = [[shares(builder, board, scene) for scene in SCENES] for board in CORES]
        except (Failed, OSError) as why:
            sys.exit(str(why))
    lines = ["# Shares of instructions that take more than a cycle, by core: the least and the largest of three scenes.",
             "# Written by firmware/tools/instruction_mix.py.",
             f"{'share':30}" + "".join(f"{BOARDS[board][1]:>8}" for board in CORES)]
    for name in SHARES:
        for end, of in (("least", min), ("most", max)):
            cells = (of(scene[name] for scene in scenes) for scenes in counted)
            lines.append(f"{name + '_' + end:30}" + "".join(f"{cell:8.4f}" for cell in cells))
    text = "\n".join(lines) + "\n"
    print(text, end="")
    if not arguments.dry_run:
        with open(TABLE, "w", encoding="ascii") as file:
            file.write(text)


if __name__ == "__main__":
    main()
