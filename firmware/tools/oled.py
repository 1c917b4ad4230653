#!/usr/bin/env python3
"""Takes the OLED's picture from the emulated LM3S6965 board.

    oled.py IMAGE [--pgm FILE] [--png FILE]

The image prints "drawn" when the picture stands. The screen shot of the emulator shows each of the panel's 128×64 pixels as
a block of 4×4, in the grey `level × 17`; anything else is an error.
"""

import argparse
import json
import os
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import zlib

import emulate

WIDTH, HEIGHT, BLOCK, STEP = 128, 64, 4, 17
MARKER = "drawn"


class Failed(Exception):
    """Why there is no picture."""


def screen_shot(image, timeout):
    """The bytes of the screen dump, a binary PPM."""
    with tempfile.TemporaryDirectory() as folder:
        monitor_path, dump = os.path.join(folder, "monitor"), os.path.join(folder, "screen.ppm")
        command = emulate.command(image) + ["-qmp", f"unix:{monitor_path},server=on,wait=off"]
        board = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                 stderr=subprocess.STDOUT, text=True)
        # A board that says nothing must not hold the check up.
        watchdog = threading.Timer(timeout, board.kill)
        watchdog.start()
        try:
            printed = []
            for line in board.stdout:
                printed.append(line)
                if line.strip() == MARKER:
                    break
            else:
                raise Failed(f"no '{MARKER}' in {timeout} s; the board printed: {''.join(printed).strip() or 'nothing'}")
            with socket.socket(socket.AF_UNIX) as monitor:
                monitor.settimeout(timeout)
                monitor.connect(monitor_path)
                answers = monitor.makefile()
                answers.readline()  # greeting
                for execute, options in (("qmp_capabilities", {}), ("screendump", {"filename": dump}), ("quit", {})):
                    monitor.sendall(json.dumps({"execute": execute, "arguments": options}).encode())
                    answer = json.loads(answers.readline())
                    while "event" in answer:
                        answer = json.loads(answers.readline())
                    if "error" in answer:
                        raise Failed(f"{execute}: {answer['error']['desc']}")
            board.wait(timeout)
            with open(dump, "rb") as file:
                return file.read()
        finally:
            watchdog.cancel()
            board.kill()
            board.wait()
            board.stdout.close()


def levels(dump):
    """The panel's greys, 0 to 15, row by row."""
    magic, size, depth, pixels = dump.split(b"\n", 3)
    if (magic, size, depth) != (b"P6", b"%d %d" % (WIDTH * BLOCK, HEIGHT * BLOCK), b"255"):
        raise Failed(f"the screen is {magic} {size} {depth}")
    pitch = WIDTH * BLOCK * 3
    panel = bytearray()
    for y in range(HEIGHT):
        first = pixels[y * BLOCK * pitch:][:pitch]
        row = bytes(first[x * BLOCK * 3] // STEP for x in range(WIDTH))
        block_row = b"".join(bytes([level * STEP]) * (3 * BLOCK) for level in row)
        if pixels[y * BLOCK * pitch:][:pitch * BLOCK] != block_row * BLOCK:
            raise Failed(f"row {y} of the panel is not made of {BLOCK}×{BLOCK} blocks of 16 greys")
        panel += row
    return bytes(panel)


def pgm(panel):
    """A text PGM: small, readable, and a diff shows which pixels changed."""
    rows = (" ".join(str(level) for level in panel[y * WIDTH:(y + 1) * WIDTH]) for y in range(HEIGHT))
    return f"P2\n{WIDTH} {HEIGHT}\n15\n" + "\n".join(rows) + "\n"


def read_pgm(text):
    """The greys of a PGM that `pgm` wrote."""
    words = text.split()
    if words[:4] != ["P2", str(WIDTH), str(HEIGHT), "15"]:
        raise Failed(f"not a text PGM of {WIDTH}×{HEIGHT} in 16 greys")
    return bytes(int(word) for word in words[4:])


def png(panel):
    """A PNG as the panel looks, each pixel a block."""
    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))
    rows = b""
    for y in range(HEIGHT):
        row = b"".join(bytes([level * STEP]) * BLOCK for level in panel[y * WIDTH:(y + 1) * WIDTH])
        rows += (b"\0" + row) * BLOCK
    header = struct.pack(">IIBBBBB", WIDTH * BLOCK, HEIGHT * BLOCK, 8, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("image")
    parser.add_argument("--pgm", help="write the panel's levels as a text PGM")
    parser.add_argument("--png", help="write the panel as it looks")
    parser.add_argument("--timeout", type=float, default=60)
    arguments = parser.parse_args()
    try:
        panel = levels(screen_shot(arguments.image, arguments.timeout))
    except Failed as why:
        sys.exit(f"{arguments.image}: {why}")
    if arguments.pgm:
        with open(arguments.pgm, "w", encoding="ascii") as file:
            file.write(pgm(panel))
    if arguments.png:
        with open(arguments.png, "wb") as file:
            file.write(png(panel))


if __name__ == "__main__":
    main()
