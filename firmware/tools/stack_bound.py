#!/usr/bin/env python3
"""Proves how deep an Arm image's stack can get, from its disassembly.

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

CONDITIONS = "eq|ne|cs|hs|cc|lo|mi|pl|vs|vc|hi|ls|ge|lt|gt|le"
LINE = re.compile(r"^\s*([0-9a-f]+):\t([a-z][^\t;@]*)(?:\t([^;@]*))?")
LABEL = re.compile(r"^([0-9a-f]+) <(.+)>:$")
TARGET = re.compile(r"\b([0-9a-f]+) <[^>]*>\s*$")
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


def disassemble(path, image):
    """Functions by address."""
    ends = {address & ~1: (address & ~1) + size for address, size, is_function in image.symbols.values()
            if is_function and size}
    text = subprocess.run(["arm-none-eabi-objdump", "-d", "--no-show-raw-insn", path],
                          check=True, capture_output=True, text=True).stdout
    functions, current, end = {}, None, None
    for line in text.splitlines():
        if label := LABEL.match(line):
            current = functions[int(label[1], 16)] = Function(label[2], int(label[1], 16))
            end = ends.get(current.address)
        elif end and (address := re.match(r"^\s*([0-9a-f]+):", line)) and int(address[1], 16) >= end:
            pass  # The linker's padding reads as branches.
        elif instruction := LINE.match(line):
            current.instructions[int(instruction[1], 16)] = (instruction[2].strip(), (instruction[3] or "").strip())
        elif word := re.match(r"^\s*[0-9a-f]+:\t\.word\t0x([0-9a-f]+)", line):
            current.words.append(int(word[1], 16))
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


def registers(listed):
    """How many registers `{r4-r7, lr}` names, and bytes in each."""
    names = [part.strip() for part in listed.strip("{} ").split(",")]
    count = 0
    for name in names:
        first, _, last = name.partition("-")
        count += int(last[1:]) - int(first[1:]) + 1 if last else 1
    return count, 8 if names[0].startswith("d") else 4


def growth(mnemonic, operands):
    """Bytes the instruction adds to the stack; None when it moves the stack pointer in a way that is not followed."""
    name = mnemonic.split(".")[0]
    if name in ("push", "vpush", "pop", "vpop"):
        count, each = registers(operands)
        return count * each if "push" in name else -count * each
    if operands.startswith("sp!"):
        count, each = registers(operands.split(",", 1)[1])
        return {"stmdb": 1, "vstmdb": 1, "ldmia": -1, "vldmia": -1, "ldm": -1}[name] * count * each
    if written := re.search(r"\[sp, #(-?\d+)\]!", operands):
        return -int(written[1])
    if written := re.search(r"\[sp\], #(-?\d+)", operands):
        return -int(written[1])
    if re.match(r"sp\b", operands) and name in ("add", "addw", "sub", "subw", "mov", "bic", "bfc", "and", "ldr", "movs"):
        constant = re.fullmatch(r"sp,(?: sp,)? #(\d+)", operands)
        if constant and name in ("add", "addw"):
            return -int(constant[1])
        if constant and name in ("sub", "subw"):
            return int(constant[1])
        # An epilogue that takes the stack pointer back from the frame pointer only shrinks the stack.
        if name == "mov" and operands == "sp, r7" or name in ("sub", "subw") and re.fullmatch(r"sp, r7, #\d+", operands):
            return 0
        return None
    return 0


def table_targets(image, function, order, address, name):
    """Where a jump through a table may go. Reading a literal behind the table as an entry only adds paths."""
    before = [a for a in order if a < address][-12:]
    names = [function.instructions[a][0].split(".")[0] for a in before[-4:]]
    if name in ("tbb", "tbh"):
        width, table = 1 if name == "tbb" else 2, address + 4
    elif name == "add" and ("ldrb" in names or "ldrh" in names):
        width, table = 1 if "ldrb" in names else 2, address + 2
        # The table's address, if it is not behind the jump.
        for a in before:
            if relative := re.fullmatch(r"r\d, pc, #(\d+)", function.instructions[a][1]):
                table = (a & ~3) + 4 + int(relative[1])
    else:
        return {word & ~1 for word in function.words if word & ~1 in function.instructions}
    text, targets = image.section(".text"), set()
    for entry in range(table - text.address, len(text.data), width):
        target = address + 4 + 2 * int.from_bytes(text.data[entry:entry + width], "little")
        if target not in function.instructions:
            break
        targets.add(target)
    return targets


def walk(image, functions, function, emitted):
    """Fills in the function's depth and calls."""
    order = sorted(function.instructions)
    following = dict(zip(order, order[1:]))
    after_last = order[-1] + (4 if function.instructions[order[-1]][0].endswith(".w") else 2) if order else 0
    fixed = None
    depth_at, waiting = {}, [(function.address, 0)]

    def call(target, depth, where):
        if target not in functions:
            raise Unknown(f"{function.name} calls {target:#x} at {where:#x}, which is no function")
        function.calls[target] = max(function.calls.get(target, 0), depth)

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
        change = growth(mnemonic, operands)
        # Padding between a call that never returns and literals.
        if mnemonic.startswith("nop") and address not in following:
            continue
        if change is None or depth > CONVERGED_BY:
            fixed = emitted.get(function.address)
            if fixed is None:
                raise Unknown(f"{function.name}: `{mnemonic} {operands}` at {address:#x} moves the stack pointer unread")
            break
        depth = max(0, depth + change)
        function.depth = max(function.depth, depth)

        # Where control goes from here.
        name = mnemonic.split(".")[0]
        target = TARGET.search(operands)
        target = int(target[1], 16) if target else None
        follow = following.get(address, after_last)
        inside = target in function.instructions and target != function.address
        if name in ("bl", "blx") and target is None:
            raise Unknown(f"{function.name} calls through a pointer at {address:#x}")
        if name in ("tbb", "tbh") or name in ("mov", "add", "ldr") and operands.startswith("pc,"):
            targets = table_targets(image, function, order, address, name)
            if not targets:
                raise Unknown(f"{function.name} jumps through a pointer at {address:#x}")
            waiting += [(target, depth) for target in targets]
        elif name in ("bl", "blx"):
            if inside:  # a far jump
                waiting.append((target, depth))
            else:
                call(target, depth, address)
                # A call that ends its function never returns.
                if follow in function.instructions:
                    waiting.append((follow, depth))
        elif name == "b":
            waiting.append((target, depth)) if inside else call(target, depth, address)
        elif name in ("cbz", "cbnz") or re.fullmatch(f"b(?:{CONDITIONS})", name):
            waiting.append((target, depth)) if inside else call(target, depth, address)
            waiting.append((follow, depth))
        elif name in ("bx",) or re.fullmatch(f"bx(?:{CONDITIONS})", name):
            if operands != "lr" and not returns_by(function, order, address, operands):
                raise Unknown(f"{function.name} jumps through a pointer at {address:#x}")
            if name != "bx":
                waiting.append((follow, depth))
        elif name == "udf" or re.search(r"\bpc\b", operands) and name in ("pop", "ldmia", "ldm"):
            pass
        elif re.fullmatch(f"(?:pop|ldmia|ldm)(?:{CONDITIONS})", name):
            waiting.append((follow, depth - change))
        else:
            waiting.append((follow, depth))

    if fixed is not None:
        # The compiler's figure holds everywhere in the function.
        function.depth = fixed
        for address, (mnemonic, operands) in function.instructions.items():
            name, target = mnemonic.split(".")[0], TARGET.search(operands)
            if name in ("bl", "blx", "b") or re.fullmatch(f"b(?:{CONDITIONS})", name):
                if target is None:
                    raise Unknown(f"{function.name} calls through a pointer at {address:#x}")
                if int(target[1], 16) not in function.instructions:
                    call(int(target[1], 16), fixed, address)
            elif name == "bx" and operands != "lr" and not returns_by(function, order, address, operands):
                raise Unknown(f"{function.name} jumps through a pointer at {address:#x}")
    elif emitted.get(function.address, function.depth) != function.depth:
        raise Unknown(f"{function.name}: read {function.depth} bytes, the compiler says {emitted[function.address]}")


def returns_by(function, order, address, register):
    """Thumb-1 returns by `pop {rN}; bx rN`."""
    before = [a for a in order if a < address][-4:]
    return any(function.instructions[a][0] == "pop" and function.instructions[a][1].strip("{}") == register
               for a in before)


def bound(image_path, root):
    """(bytes, [(function, its own bytes)] of the deepest path)."""
    image = elf.Image(image_path)
    functions, emitted = disassemble(image_path, image), emitted_sizes(image)
    entry = image.symbols[root][0] & ~1
    known, active = {}, []

    def deepest(address):
        if address in known:
            return known[address]
        function = functions[address]
        if address in active:
            raise Unknown("recursion: " + " → ".join(functions[a].name for a in active[active.index(address):] + [address]))
        active.append(address)
        walk(image, functions, function, emitted)
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
    parser.add_argument("--root", default="Reset")
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
