#!/usr/bin/env python3
"""Says what a picture's instructions are spent on, and estimates the cycles of a Cortex-M4F.

    profiler.py [--scene FILE] [--board BOARD] [--profile size|release] [--flags FLAG…] [--top N]
    profiler.py --image IMAGE …       an image that is there already; sources are named if it has line tables

Draws the scene as `picture` does, at 160×120, under emulation, and counts each instruction between the readings of the board's
counter: what the tables publish as instructions per pixel. Prints three tables, per pixel:

* by kind of instruction;
* by function of the source, inlined ones apart: `own` are a function's own instructions (the core library's are its
  caller's), `all` counts what it calls too. Functions that are called rather than inlined are charged to their callers by
  their mean cost;
* by function of the image (symbol).

Cycles (device with hardware floating point only) weight what was executed, by Arm's manual of the Cortex-M4F for memory
without wait states: load 2, of several registers 1 + their number; multiply-accumulate 3; divide and root 14; integer
division 12; taken branch 2, through a register 3; all else 1. Neighbouring loads, which can overlap, and waiting for a
result are not modelled. An instruction of an IT block that its condition skips counts as executed.
"""

import argparse
import collections
import os
import re
import subprocess
import sys
import tempfile

import elf
import emulate
from builder import BOARDS, FIRMWARE, Builder, Failed

PIXELS = 160 * 120
BEHIND = re.compile(r"^\s*([0-9a-f]+):\t(\S+)(?:\t([^@]*))?")
LABEL = re.compile(r"^([0-9a-f]+) <(.+)>:$")
CALL = re.compile(r"^([0-9a-f]+) <")
# Sources of the libraries core and compiler_builtins, from rustup, Debian or built in.
LIBRARY = re.compile(r"/(?:rustlib/src/rust|rust-src[^/]*|rustc/[0-9a-f.]+|rustc-[^/]+)/library/|/rust/library/")
CONDITION = "(?:eq|ne|cs|hs|cc|lo|mi|pl|vs|vc|hi|ls|ge|lt|gt|le)?"

# The first that matches is an instruction's kind.
KINDS = [(kind, re.compile(f"(?:{names}){CONDITION}$")) for kind, names in (
    ("float divide, root", "vdiv|vsqrt"),
    ("float multiply-accumulate", "vn?mla|vn?mls|vfn?ma|vfn?ms"),
    ("float add, multiply", "vadd|vsub|vn?mul|vneg|vabs"),
    ("float compare", "vcmpe?|vmrs"),
    ("float move, convert", "vmov|vcvtr?|vsel.*|vmsr"),
    ("load", "v?ldr.*|v?ldm.*|v?pop"),
    ("store", "v?str.*|v?stm.*|v?push"),
    ("integer divide", "[su]div"),
    ("branch", "b|bl|blx|bx|cbn?z|tb[bh]"),
    ("integer", ".*"),
)]


class Instruction:
    def __init__(self, address, name, operands, symbol):
        self.address, self.operands, self.symbol = address, operands, symbol
        self.name = name.split(".")[0]
        self.executed = self.jumped = 0
        self.kind = next(kind for kind, names in KINDS if names.match(self.name))
        self.chain = []  # (file, function) of the source, the innermost first

    def registers(self):
        """How many registers a list names, `{r4-r7, lr}`."""
        count = 0
        for part in re.search(r"\{(.*?)\}", self.operands)[1].split(","):
            first, _, last = part.strip().partition("-")
            count += int(last[1:]) - int(first[1:]) + 1 if last else 1
        return count

    def passed_on(self):
        """How often it went where it points."""
        return self.executed if self.name in ("b", "bl", "blx") else self.jumped

    def cycles(self):
        """What all its executions take."""
        through_register = self.kind != "branch" or self.name in ("bx", "blx", "tbb", "tbh")
        jumps = self.jumped * (2 if through_register else 1)
        if self.kind in ("load", "store") and "{" in self.operands:
            return self.executed * (1 + self.registers()) + jumps
        each = {"load": 3 if self.name.startswith("ldrd") else 2, "float multiply-accumulate": 3,
                "float divide, root": 14, "integer divide": 12}.get(self.kind, 1)
        return self.executed * each + jumps


def disassemble(image):
    """Instructions by address."""
    text = subprocess.run(["arm-none-eabi-objdump", "-d", "-C", "--no-show-raw-insn", image],
                          check=True, capture_output=True, text=True).stdout
    found, symbol = {}, None
    for line in text.splitlines():
        if label := LABEL.match(line):
            symbol = label[2]
        elif (match := BEHIND.match(line)) and not match[2].startswith("."):
            address = int(match[1], 16)
            found[address] = Instruction(address, match[2], (match[3] or "").strip(), symbol)
    return found


def name_sources(image, instructions):
    """Fills in the chains of inlined functions, without those of the core library."""
    addresses = "\n".join(hex(address) for address in instructions)
    lines = subprocess.run(["arm-none-eabi-addr2line", "-a", "-i", "-f", "-C", "-e", image], input=addresses,
                           check=True, capture_output=True, text=True).stdout.splitlines()
    current, index = None, 0
    while index < len(lines):
        if lines[index].startswith("0x"):
            current, index = instructions[int(lines[index], 16)], index + 1
            continue
        function, place = lines[index], lines[index + 1].rsplit(":", 1)[0]
        index += 2
        if place.startswith("/") and not LIBRARY.search(place):
            repository = os.path.dirname(FIRMWARE) + "/"
            crate = re.sub(r"^.*/registry/src/[^/]+/", "", place.removeprefix(repository))
            current.chain.append((crate, re.sub(r"<.*", "", function.replace("{{closure}}", "closure"))))
    for instruction in instructions.values():
        instruction.chain = instruction.chain or [("library", instruction.symbol)]


def counter_readings(instructions):
    """Addresses of the instructions that read the board's counter."""
    return [i.address for i in instructions.values() if any(function == "ticks" for _, function in i.chain)
            and i.kind == "load" and not re.search(r"\[(?:pc|sp)", i.operands)]


def count(image, instructions, toggles):
    """Runs the image and fills in what was executed. What the board printed."""
    version = subprocess.run(["qemu-system-arm", "--version"], check=True, capture_output=True, text=True).stdout
    major, minor = map(int, re.search(r"version (\d+)\.(\d+)", version).groups())
    # The functions used are the same in all versions of the interface.
    interface = 1 if (major, minor) < (8, 2) else 2
    with tempfile.TemporaryDirectory() as folder:
        plugin, out = os.path.join(folder, "profiler.so"), os.path.join(folder, "counts")
        subprocess.run(["cc", "-O2", "-shared", "-fPIC", f"-DINTERFACE={interface}", "-o", plugin,
                        os.path.join(FIRMWARE, "tools", "profiler.c")], check=True)
        options = ",".join([f"file={plugin}", f"out={out}", *(f"toggle={address:#x}" for address in toggles)])
        done = subprocess.run([*emulate.command(image), "-plugin", options], stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode:
            raise Failed(f"the emulator ended with {done.returncode}: {done.stdout}")
        with open(out, encoding="ascii") as file:
            for line in file:
                address, executed, jumped = line.split()
                instruction = instructions[int(address, 16)]
                instruction.executed, instruction.jumped = int(executed), int(jumped)
    return done.stdout


class Costs:
    """Instructions and cycles."""

    def __init__(self):
        self.instructions = self.cycles = 0

    def add(self, instructions, cycles):
        self.instructions += instructions
        self.cycles += cycles


def calls_of(instructions):
    """Call instruction -> symbol that it calls."""
    found = {}
    for i in instructions.values():
        target = CALL.match(i.operands)
        callee = instructions.get(int(target[1], 16)) if target else None
        if i.kind == "branch" and callee and callee.symbol != i.symbol:
            found[i.address] = callee.symbol
    return found


def mean_costs(instructions, calls):
    """Symbol -> (instructions, cycles) of a call, with all that it calls."""
    own, below, times = collections.defaultdict(Costs), collections.defaultdict(collections.Counter), collections.Counter()
    for i in instructions.values():
        own[i.symbol].add(i.executed, i.cycles())
        if callee := calls.get(i.address):
            times[callee] += i.passed_on()
            below[i.symbol][callee] += i.passed_on()
    known = {}

    def mean(symbol):
        if symbol not in known:
            known[symbol] = (0, 0)  # recursion ends here
            total = [own[symbol].instructions, own[symbol].cycles]
            for callee, number in below[symbol].items():
                total = [sum + number * each for sum, each in zip(total, mean(callee))]
            known[symbol] = tuple(sum / max(times[symbol], 1) for sum in total)
        return known[symbol]

    for symbol in list(own):
        mean(symbol)
    return known


def profile(image):
    """(what the board printed, its instructions with their counts, whether the counter's readings bound them)"""
    instructions = disassemble(image)
    name_sources(image, instructions)
    toggles = counter_readings(instructions)
    printed = count(image, instructions, toggles)
    if toggles:
        counted = sum(i.executed for i in instructions.values())
        ticks = int(re.search(r"^ticks (\S+)", printed, re.MULTILINE)[1], 16) * BOARDS[emulate.board(image)][2]
        # The two see the same, but for a few instructions at each reading and for the tick under way.
        if abs(counted - ticks) > ticks / 100:
            raise Failed(f"{counted} instructions were seen, the board counted {ticks:.0f}")
    return printed, instructions, bool(toggles)


def cost(image):
    """(instructions, cycles) a pixel of an image with line tables."""
    _, instructions, is_bounded = profile(image)
    if not is_bounded:
        raise Failed("no reading of the counter was recognised")
    return (sum(i.executed for i in instructions.values()) / PIXELS, sum(i.cycles() for i in instructions.values()) / PIXELS)


def by_source(instructions):
    """(file, function) -> own costs, and with all it calls."""
    calls = calls_of(instructions)
    means = mean_costs(instructions, calls)
    own, total = collections.defaultdict(Costs), collections.defaultdict(Costs)
    for i in instructions.values():
        own[i.chain[0]].add(i.executed, i.cycles())
        called = means[calls[i.address]] if i.address in calls else (0, 0)
        for function in set(i.chain):
            total[function].add(i.executed + i.passed_on() * called[0], i.cycles() + i.passed_on() * called[1])
    return own, total


def rows(title, entries, top, with_cycles):
    """Prints a table: entries are (costs, costs or None, name)."""
    columns = ["own", "all"] if any(all for _, all, _ in entries) else ["own"]
    if with_cycles:
        columns += [f"{column} cycles" for column in columns]
    print("".join(f"{column:>12}" for column in columns) + f"  {title}")
    entries = [entry for entry in entries if entry[0].instructions or entry[1] and entry[1].instructions]
    entries.sort(key=lambda entry: -entry[0].instructions)
    for costs, all, name in entries[:top]:
        figures = [costs] + ([all] if all else [])
        cells = [c.instructions for c in figures] + ([c.cycles for c in figures] if with_cycles else [])
        print("".join(f"{cell / PIXELS:12.1f}" for cell in cells) + f"  {name}")
    print()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--image", help="an image of an Arm board instead of a scene")
    parser.add_argument("--scene", default="../scenes/default.txt", help="relative to firmware/")
    parser.add_argument("--board", default="mps2-an386", choices=[name for name in BOARDS if name not in ("virt",)])
    parser.add_argument("--profile", default="size", choices=["size", "release"])
    parser.add_argument("--flags", nargs="*", default=[], help="more of the compiler's, such as --flags=-Ctarget-cpu=cortex-m4")
    parser.add_argument("--top", type=int, default=40, help="lines of a table")
    arguments = parser.parse_args()
    if arguments.image and not os.path.exists(arguments.image):
        sys.exit(f"{arguments.image}: no such image")
    with tempfile.TemporaryDirectory() as folder:
        try:
            image = arguments.image or Builder(folder).image(
                arguments.board, "picture", "profiled", arguments.profile, flags=arguments.flags,
                SCANRAY_SCENE=arguments.scene)
            printed, instructions, is_bounded = profile(image)
        except (Failed, OSError, subprocess.CalledProcessError) as why:
            sys.exit(str(why))
        has_cycles = elf.Image(image).is_hard_float
    print(printed, end="")
    total, kinds, symbols = Costs(), collections.defaultdict(Costs), collections.defaultdict(Costs)
    for i in instructions.values():
        for costs in (total, kinds[i.kind], symbols[i.symbol]):
            costs.add(i.executed, i.cycles())
    cycles = f", about {total.cycles / PIXELS:,.0f} cycles of a Cortex-M4F" if has_cycles else ""
    what = "of drawing" if is_bounded else "of the whole run, start-up and hash included: no line tables,"
    print(f"{total.instructions / PIXELS:,.1f} instructions a pixel {what}{cycles}\n")
    rows("kind of instruction", [(costs, None, kind) for kind, costs in kinds.items()], None, has_cycles)
    own, all = by_source(instructions)
    rows("function of the source", [(own[key], all[key], " ".join(key)) for key in all], arguments.top, has_cycles)
    rows("function of the image", [(costs, None, symbol) for symbol, costs in symbols.items()], arguments.top, has_cycles)


if __name__ == "__main__":
    main()
