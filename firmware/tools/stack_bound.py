#!/usr/bin/env python3
"""Proves how deep an image's stack can get, from its disassembly.

    stack_bound.py IMAGE [--root Reset]

Follows every path of every function that the root reaches and keeps the depth at each instruction. Recursion, a call
through a pointer, and a change of the stack pointer that cannot be read fail, unless the compiler's own figure
(`-Z emit-stack-sizes`) stands in for the last. Where both exist they must agree. Interrupts are not counted.
"""

import argparse
import re
import subprocess
import sys

import elf
import stack_arm
import stack_riscv

LINE = re.compile(r"^\s*([0-9a-f]+):\t([a-z.][^\t;@]*)(?:\t([^;@]*))?")
LABEL = re.compile(r"^([0-9a-f]+) <(.+)>:$")
CONVERGED_BY = 1 << 20


class Unknown(Exception):
    """Why there is no bound."""


class Function:
    def __init__(self, name, address):
        self.name, self.address = name, address
        self.instructions = {}  # address -> (mnemonic, operands)
        self.words = []         # literals, jump tables among them
        self.calls = {}         # callee's address -> depth of the deepest call
        self.depth = 0          # the deepest the function itself gets


def disassemble(path, image, core):
    """Functions by address."""
    symbols = {address & ~1: (name, size) for name, (address, size, is_function) in image.symbols.items() if is_function}
    text = subprocess.run([core.OBJDUMP, "-d", "--no-show-raw-insn", path],
                          check=True, capture_output=True, text=True).stdout
    functions, current, end = {}, None, None
    for line in text.splitlines():
        if label := LABEL.match(line):
            address = int(label[1], 16)
            # Labels inside a function are no functions.
            if current is None or address in symbols or end is None or address >= end:
                current = functions[address] = Function(label[2], address)
                size = symbols.get(address, ("", 0))[1]
                end = address + size if size else None
        elif current and end and (address := re.match(r"^\s*([0-9a-f]+):", line)) and int(address[1], 16) >= end:
            pass  # The linker's padding reads as branches.
        elif word := re.match(r"^\s*[0-9a-f]+:\t\.word\t0x([0-9a-f]+)", line):
            current.words.append(int(word[1], 16))
        elif instruction := LINE.match(line):
            current.instructions[int(instruction[1], 16)] = (instruction[2].strip(), (instruction[3] or "").strip())
    return functions


def emitted_sizes(image):
    """Function address -> frame, as the compiler printed them."""
    section, sizes, offset = image.section(".stack_sizes"), {}, 0
    data = section.data if section else b""
    while offset < len(data):
        address = int.from_bytes(data[offset:offset + 4], "little") & ~1
        offset, size, shift = offset + 4, 0, 0
        while True:
            byte, offset = data[offset], offset + 1
            size, shift = size | (byte & 127) << shift, shift + 7
            if byte < 128:
                break
        sizes[address] = size
    return sizes


def walk(image, functions, function, emitted, core):
    """Fills in the function's depth and calls."""
    order = sorted(function.instructions)
    following = dict(zip(order, order[1:]))
    places = {address: place for place, address in enumerate(order)}
    after_last = order[-1] + (4 if function.instructions[order[-1]][0].endswith(".w") else 2) if order else 0
    fixed = None
    depth_at, waiting = {}, [(function.address, 0)]

    def call(target, depth, where):
        if target not in functions:
            raise Unknown(f"{function.name} calls {target:#x} at {where:#x}, which is no function")
        function.calls[target] = max(function.calls.get(target, 0), depth)

    def flow(address):
        found = core.flow(image, function, order, address)
        if found is None:
            raise Unknown(f"{function.name} goes through a pointer at {address:#x}")
        return found

    while waiting:
        address, depth = waiting.pop()
        if address not in function.instructions:
            if address in functions:
                call(address, depth, address)
                continue
            raise Unknown(f"{function.name} runs into {address:#x}, which is no instruction")
        if depth_at.get(address, -1) >= depth:
            continue
        depth_at[address] = depth
        mnemonic, operands = function.instructions[address]
        # Padding between a call that never returns and literals.
        if mnemonic.startswith("nop") and address not in following:
            continue
        before = [function.instructions[a] for a in order[max(0, places[address] - 4):places[address]][::-1]]
        change = core.growth(mnemonic, operands, before)
        if change is None or depth > CONVERGED_BY:
            fixed = emitted.get(function.address)
            if fixed is None:
                raise Unknown(f"{function.name}: `{mnemonic} {operands}` at {address:#x} moves the stack pointer unread")
            break
        before, depth = depth, max(0, depth + change)
        function.depth = max(function.depth, depth)

        how, targets = flow(address)
        follow = following.get(address, after_last)
        if how == "call":
            for target in targets:
                call(target, depth, address)
            # A call that ends its function never returns.
            if follow in function.instructions:
                waiting.append((follow, depth))
            continue
        for target in targets:
            waiting.append((target, depth)) if target in function.instructions else call(target, depth, address)
        if how in ("next", "branch"):
            waiting.append((follow, depth))
        elif how == "maybe return":
            waiting.append((follow, before))

    if fixed is not None:
        # The compiler's figure holds everywhere in the function.
        function.depth = fixed
        for address in order:
            how, targets = flow(address)
            for target in targets:
                if how == "call" or target not in function.instructions:
                    call(target, fixed, address)
    elif emitted.get(function.address, function.depth) != function.depth:
        raise Unknown(f"{function.name}: read {function.depth} bytes, the compiler says {emitted[function.address]}")


def bound(image_path, root=None):
    """(bytes, [(function, its own bytes)] of the deepest path)."""
    image = elf.Image(image_path)
    core = stack_arm if image.is_arm else stack_riscv
    functions, emitted = disassemble(image_path, image, core), emitted_sizes(image)
    entry = image.symbols[root or core.ROOT][0] & ~1
    known, active = {}, []

    def deepest(address):
        if address in known:
            return known[address]
        function = functions[address]
        if address in active:
            raise Unknown("recursion: " + " → ".join(functions[a].name for a in active[active.index(address):] + [address]))
        active.append(address)
        walk(image, functions, function, emitted, core)
        best = (function.depth, [(function.name, function.depth)])
        for callee, depth in function.calls.items():
            below, path = deepest(callee)
            if depth + below > best[0]:
                best = (depth + below, [(function.name, depth), *path])
        active.pop()
        known[address] = best
        return best

    return deepest(entry)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("image")
    parser.add_argument("--root", help="the function that the stack begins with, if not the reset's")
    arguments = parser.parse_args()
    try:
        total, path = bound(arguments.image, arguments.root)
    except Unknown as why:
        sys.exit(f"no bound: {why}")
    for name, own in path:
        print(f"{own:6} {name}")
    print(f"{total:6} bytes at most")


if __name__ == "__main__":
    main()
