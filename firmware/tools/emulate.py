#!/usr/bin/env python3
"""Runs an image on the emulated board that it was linked for: emulate.py IMAGE

Cargo's runner; check.py imports it. The board's console is standard output.
"""

import os
import socket
import subprocess
import sys

import elf

# Each guest instruction takes one nanosecond of guest time: counts are exact, and the same on every run.
COUNTED = ["-icount", "shift=0"]
SEMIHOSTING = ["-semihosting-config", "enable=on,target=native,chardev=console",
               "-chardev", "stdio,id=console,signal=off"]
# A reset ends the emulation.
HEADLESS = ["-display", "none", "-monitor", "none", "-no-reboot"]


def board(image):
    """The board's name, from the symbol its linker script defines and the core it was compiled for."""
    symbols = elf.Image(image).symbols
    for name in ("microbit", "lm3s6965evb", "virt"):
        if f"__board_{name}" in symbols:
            return name
    if "__board_mps2" in symbols:
        return "mps2-an386" if elf.Image(image).is_hard_float else "mps2-an385"
    sys.exit(f"{image}: linked for no board that is known here")


def command(image, serial=None):
    """QEMU's command line. The console is standard output; `serial` is the file descriptor of a socket."""
    name = board(image)
    if name == "virt":
        return ["qemu-system-riscv32", "-machine", "virt", "-smp", "2", "-bios", "none", "-kernel", image,
                *COUNTED, *HEADLESS, "-serial", "stdio"]
    port = ["-serial", "none"]
    if serial is not None:
        port = ["-chardev", f"socket,id=serial,fd={serial}", "-serial", "chardev:serial"]
    return ["qemu-system-arm", "-machine", name, "-kernel", image, *COUNTED, *HEADLESS, *SEMIHOSTING, *port]


def run(image, timeout, received=b""):
    """(exit code, what the board printed) for what its serial port receives; the code is None when time ran out."""
    ours, boards = socket.socketpair()
    with ours, boards:
        ours.sendall(received)
        try:
            done = subprocess.run(command(image, boards.fileno()), stdin=subprocess.DEVNULL, timeout=timeout,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, pass_fds=[boards.fileno()])
        except subprocess.TimeoutExpired as expired:
            return None, (expired.stdout or b"").decode(errors="replace")
    return done.returncode, done.stdout.decode(errors="replace")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    line = command(sys.argv[1])
    os.execvp(line[0], line)


if __name__ == "__main__":
    main()
