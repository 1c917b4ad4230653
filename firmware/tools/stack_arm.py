"""What Thumb instructions do to the stack and where they go, read from a disassembly: for stack_bound.py."""

import re

OBJDUMP = "arm-none-eabi-objdump"
ROOT = "Reset"

CONDITIONS = "eq|ne|cs|hs|cc|lo|mi|pl|vs|vc|hi|ls|ge|lt|gt|le"
TARGET = re.compile(r"\b([0-9a-f]+) <[^>]*>\s*$")


def registers(listed):
    """How many registers `{r4-r7, lr}` names, and bytes in each."""
    names = [part.strip() for part in listed.strip("{} ").split(",")]
    count = 0
    for name in names:
        first, _, last = name.partition("-")
        count += int(last[1:]) - int(first[1:]) + 1 if last else 1
    return count, 8 if names[0].startswith("d") else 4


def growth(mnemonic, operands, before):
    """Bytes the instruction adds to the stack; None when it moves the stack pointer in a way that is not followed.

    `before` are the instructions in front of it, the last first.
    """
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
        restored = re.fullmatch(r"sp, (r\d+)", operands)
        return 0 if name == "mov" and restored and is_below_frame_pointer(restored[1], before) else None
    return 0


def is_below_frame_pointer(register, before):
    """Thumb-1 takes the stack pointer back by `subs rN, r7, #…; subs rN, #…; mov sp, rN`."""
    for mnemonic, operands in before:
        if mnemonic.startswith("sub") and re.fullmatch(rf"{register}, r7, #\d+", operands):
            return True
        if not (mnemonic.startswith("sub") and re.fullmatch(rf"{register},(?: {register},)? #\d+", operands)):
            return False
    return False


def flow(image, function, order, address):
    """Where control goes: (how, addresses), or None through a pointer that is not followed.

    How is "next", "call", "jump", "branch" (to the addresses or the next), "return" or "maybe return".
    """
    mnemonic, operands = function.instructions[address]
    name, target = mnemonic.split(".")[0], TARGET.search(operands)
    targets = [int(target[1], 16)] if target else []
    if name in ("tbb", "tbh") or name in ("mov", "add", "ldr") and operands.startswith("pc,"):
        targets = table_targets(image, function, order, address, name)
        return ("jump", targets) if targets else None
    if name in ("bl", "blx"):
        if not targets:
            return None
        # A far jump stays in its function.
        is_inside = targets[0] in function.instructions and targets[0] != function.address
        return "jump" if is_inside else "call", targets
    if name == "b":
        return "jump", targets
    if name in ("cbz", "cbnz") or re.fullmatch(f"b(?:{CONDITIONS})", name):
        return "branch", targets
    if re.fullmatch(f"bx(?:{CONDITIONS})?", name):
        if operands != "lr" and not returns_by(function, order, address, operands):
            return None
        return "return" if name == "bx" else "maybe return", []
    if name == "udf" or re.search(r"\bpc\b", operands) and name in ("pop", "ldmia", "ldm"):
        return "return", []
    if re.fullmatch(f"(?:pop|ldmia|ldm)(?:{CONDITIONS})", name):
        return "maybe return", []
    return "next", []


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


def returns_by(function, order, address, register):
    """Thumb-1 returns by `pop {rN}; bx rN`."""
    before = [a for a in order if a < address][-4:]
    return any(function.instructions[a][0] == "pop" and function.instructions[a][1].strip("{}") == register
               for a in before)
