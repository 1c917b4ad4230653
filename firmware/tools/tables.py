"""Figures as text: the files of tables/, and the table of the README."""

import os
import re

from builder import BUILD_STD, FIRMWARE, Failed, compiler

README = os.path.join(os.path.dirname(FIRMWARE), "README.md")
BEGIN = "<!-- Written by firmware/test.sh --bless. -->\n"
END = "<!-- Until here. -->\n"

# Rows of the cost table -> what the README calls them.
README_ROWS = {"stage-1-diffuse-spheres": "diffuse spheres", "stage-2-plane-and-shadows": "+ plane, shadows",
               "stage-3-mirrors": "+ mirrors", "default": "+ highlights, glass, triangle: the default scene"}
README_BOARDS = {"M4F": "Cortex-M4F", "M3": "Cortex-M3", "M0": "Cortex-M0", "RISC-V": "RISC-V, RV32IMC"}


def table(header, rows):
    """A text table, its columns aligned; the first column is text."""
    cells = [header, *rows]
    widths = [max(len(row[i]) for row in cells) for i in range(len(header))]
    lines = ["  ".join(cell.ljust(width) if i == 0 else cell.rjust(width)
                       for i, (cell, width) in enumerate(zip(row, widths))).rstrip() for row in cells]
    return "\n".join(lines) + "\n"


def compare(name, text, bless):
    """Compares with a table that is checked in, or writes it."""
    path = os.path.join(FIRMWARE, "tables", name)
    if bless:
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return "written"
    try:
        with open(path, encoding="utf-8") as file:
            known = file.read()
    except FileNotFoundError:
        if compiler() in name:
            return f"none yet for this compiler ({name}); --bless writes it"
        raise
    if known != text:
        old, new = known.splitlines(), text.splitlines()
        lines = [f"  - {line}" for line in old if line not in new] + [f"  + {line}" for line in new if line not in old]
        raise Failed(f"differs from tables/{name} (--bless accepts it):\n" + "\n".join(lines))
    return "as checked in"


def compare_costs(name, text, bless):
    """Compares costs, figure by figure, with a table that is checked in, within 1 %, or writes it. What is measured is
    named by the first three columns."""
    path = os.path.join(FIRMWARE, "tables", name)
    if bless or not os.path.exists(path):
        return compare(name, text, bless)

    def figures(content):
        header, *rows = [re.split(r"  +", line) for line in content.splitlines()]
        return {(*row[:3], figure): cell for row in rows for figure, cell in zip(header[3:], row[3:])}

    with open(path, encoding="utf-8") as file:
        known, got, different = figures(file.read()), figures(text), []
    for key in sorted(known.keys() | got.keys()):
        was, now = known.get(key, "nothing"), got.get(key, "nothing")
        try:
            close = abs(float(now) - float(was)) <= 0.01 * float(was)
        except ValueError:
            close = was == now
        if not close:
            scene, profile, board, figure = key
            different.append(f"  {scene} ({profile}) on {board}: {figure} {now}, was {was}")
    if different:
        raise Failed(f"more than 1 % from tables/{name} (--bless accepts it):\n" + "\n".join(different))
    return "within 1 % of what is checked in"


def read_table(name):
    """A table of tables/: first three columns -> the others, by their headings."""
    with open(os.path.join(FIRMWARE, "tables", name), encoding="utf-8") as file:
        header, *rows = [re.split(r"  +", line.strip()) for line in file]
    return {tuple(row[:3]): dict(zip(header[3:], row[3:])) for row in rows}


def readme_table():
    """The README's table, from the tables that are checked in."""
    costs, cycles = read_table(f"cost-{compiler()}.txt"), read_table(f"cycles-{compiler()}.txt")
    lines = [f"<!-- {compiler()} -->", "| scene | core | flash | RAM | stack | instructions a pixel | cycles a pixel |",
             "|---|---|--:|--:|--:|--:|--:|"]
    for row, name in README_ROWS.items():
        for board, core in README_BOARDS.items():
            cost, estimated = costs[row, "size", board], ""
            if board == "M4F":
                estimated = f"about {float(cycles[row, 'size', 'generic']['cycles/pixel']):,.0f}"
            bytes = " | ".join(f"{cost[figure]} B" for figure in ("flash", "RAM", "stack bound"))
            lines.append(f"| {name if board == 'M4F' else ''} | {core} | {bytes} "
                         f"| {float(cost['instructions/pixel']):,.0f} | {estimated} |")
    return "\n".join(lines) + "\n"


def compare_readme(bless):
    """Compares the README's table with the tables that are checked in, or writes it. It has the figures of one compiler,
    rustup's."""
    with open(README, encoding="utf-8") as file:
        readme = file.read()
    before, _, rest = readme.partition(BEGIN)
    known, end, after = rest.partition(END)
    if not end:
        raise Failed(f"README.md has no `{BEGIN.strip()}` … `{END.strip()}`")
    measured_with = re.match(r"<!-- (\S+) -->", known)
    if BUILD_STD or not bless and measured_with and measured_with[1] != compiler():
        return f"skipped, it has the figures of another compiler than {compiler()}"
    text = readme_table()
    if bless:
        with open(README, "w", encoding="utf-8") as file:
            file.write(before + BEGIN + text + END + after)
        return "written"
    if known != text:
        raise Failed("README.md has other figures than tables/ (--bless writes these):\n" + text)
    return "as in tables/"
