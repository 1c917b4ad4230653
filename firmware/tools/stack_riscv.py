"""What RISC-V instructions do to the stack and where they go, read from a disassembly: for stack_bound.py."""

import re

OBJDUMP = "riscv64-unknown-elf-objdump"
ROOT = "_start"

# The disassembler works out where `auipc` and `jalr` lead together.
TARGET = re.compile(r"\b([0-9a-f]+) <[^>]*>\s*$")


def growth(mnemonic, operands, _before):
    """Bytes the instruction adds to the stack; None when it moves the stack pointer in a way that is not followed."""
    if not re.match(r"sp\b", operands) or mnemonic in ("sw", "sh", "sb") or mnemonic.startswith("b"):
        return 0
    if constant := re.fullmatch(r"sp,sp,(-?\d+)", operands):
        return -int(constant[1]) if mnemonic in ("add", "addi") else None
    # An epilogue that takes the stack pointer back from the frame pointer only shrinks the stack.
    if mnemonic in ("add", "addi") and re.fullmatch(r"sp,s0,-\d+", operands):
        return 0
    # The start-up code puts the stack pointer at the start of the stack.
    if mnemonic == "auipc" or mnemonic in ("add", "addi", "mv") and "<_" in operands:
        return 0
    return None


def flow(image, function, order, address):
    """Where control goes: (how, addresses), or None through a pointer that is not followed.

    How is "next", "call", "jump", "branch" (to the addresses or the next) or "return".
    """
    name, operands = function.instructions[address]
    target = TARGET.search(operands)
    targets = [int(target[1], 16)] if target else []
    if name in ("jal", "jalr"):
        return ("call", targets) if targets else None
    if name in ("ret", "unimp", "ebreak"):
        return "return", []
    if name in ("j", "jr"):
        targets = targets or table_targets(image, function)
        return ("jump", targets) if targets else None
    if name.startswith("b"):
        return "branch", targets
    return "next", []


def table_targets(image, function):
    """Where jumps through tables may go: any constant that is an address in the function. Others only add paths."""
    constants = image.section(".rodata")
    data = constants.data if constants else b""
    words = {int.from_bytes(data[offset:offset + 4], "little") for offset in range(0, len(data) - 3, 4)}
    return sorted(words & function.instructions.keys())
