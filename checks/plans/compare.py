#!/usr/bin/env python3
"""Imports plans of Sweet Home 3D, simulates a day in each, and draws each plan next to Homebody's drawing of it.

Usage: PYTHON checks/plans/compare.py HOMEBODY DRAWN TO

PYTHON is the interpreter of an environment with Pillow, HOMEBODY the program, and DRAWN the output folder of Draw.java: NAME.sh3d, with
a picture NAME.LEVEL.png of each of its levels. The script creates the folder TO with NAME.png for each plan, and sheet.png for all.
It exits with code 1 if fewer than nine in ten of the plans with all necessary furniture have an ordinary day.
"""

from __future__ import annotations

import argparse
import math
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont

from lived import LEAST_SHARE, Life, lived

#: The words of the messages about missing necessary furniture.
NEEDED = ("the home has no place to sleep", "the home has no place to sit", "the home has no toilet", "the home has no kitchen")
HALF = (1000, 760)
HEAD = 110
SHEET_COLUMNS = 3
SHEET_WIDTH = 1950
SHEET_HEAD = 30
PAPER, INK, FADED = "white", "#202020", "#707070"


@dataclass
class Found:
    """The result for a plan."""

    name: str
    life: Life
    drawn: Image.Image | None

    @property
    def has_all(self) -> bool:
        return self.drawn is not None and not any(word in lack for lack in self.life.lacks for word in NEEDED)

    @property
    def counts(self) -> str:
        return f"{self.life.rooms} rooms, {self.life.doors} doors, {self.life.pieces} pieces"

    @property
    def outcome(self) -> str:
        return f"not imported: {self.life.refused}" if self.drawn is None else f"ordinary day: {self.life.outcome}"


def main() -> int:
    parser = argparse.ArgumentParser(description="Draws plans of Sweet Home 3D next to the homes that Homebody makes of them.")
    parser.add_argument("homebody", type=Path)
    parser.add_argument("drawn", type=Path)
    parser.add_argument("to", type=Path)
    arguments = parser.parse_args()
    arguments.to.mkdir(parents=True)
    pairs, found = [], []
    for plan in sorted(arguments.drawn.glob("*.sh3d")):
        became = found_of(arguments.homebody.resolve(), plan.resolve())
        source = in_a_row([Image.open(path) for path in levels_of(plan)])
        pair = beside(became, source)
        pair.save(arguments.to / f"{plan.stem}.png")
        pairs.append(pair)
        found.append(became)
        print(f"{became.name}: {became.counts}; {became.outcome}")
        for remark in became.life.remarks:
            print(f"    {remark}")
    sheet(found, pairs).save(arguments.to / "sheet.png", optimize=True)
    whole = [became for became in found if became.has_all]
    lived_in = sum(became.life.is_lived_in for became in whole)
    print(f"{len(found)} plans, {sum(became.drawn is not None for became in found)} imported, {len(whole)} with all necessary furniture; "
          f"{lived_in} of these with an ordinary day")
    return 0 if whole and lived_in >= LEAST_SHARE * len(whole) else 1


def levels_of(plan: Path) -> list[Path]:
    """The pictures of a plan's levels, from below; an empty list for an empty plan."""
    number = re.compile(re.escape(plan.stem) + r"\.(\d+)\.png")
    levels = [(int(match[1]), path) for path in plan.parent.iterdir() if (match := number.fullmatch(path.name))]
    return [path for _, path in sorted(levels)]


def found_of(homebody: Path, plan: Path) -> Found:
    """Imports a plan, draws the home, and simulates a day in it."""
    with tempfile.TemporaryDirectory() as folder:
        life = lived(homebody, plan, Path(folder))
        if life.refused is not None:
            return Found(plan.stem, life, None)
        words = [homebody, "plan", plan.stem, "--png", "plan.png", "--width", "1400"]
        subprocess.run(words, cwd=folder, capture_output=True, check=True)
        drawn = Image.open(Path(folder) / "plan.png").convert("RGB")
        drawn.load()
        return Found(plan.stem, life, drawn)


def in_a_row(pictures: list[Image.Image]) -> Image.Image:
    """The levels of a plan next to each other."""
    if not pictures:
        return Image.new("RGB", HALF, PAPER)
    row = Image.new("RGB", (sum(picture.width for picture in pictures), max(picture.height for picture in pictures)), PAPER)
    left = 0
    for picture in pictures:
        row.paste(picture, (left, 0))
        left += picture.width
    return row


def beside(found: Found, source: Image.Image) -> Image.Image:
    """The drawing of Sweet Home 3D on the left, that of Homebody on the right, and the result above."""
    pair = Image.new("RGB", (2 * HALF[0], HEAD + HALF[1]), PAPER)
    pen = ImageDraw.Draw(pair)
    pen.text((20, 14), found.name, INK, font(34))
    pen.text((20, 64), f"{found.counts}; {found.outcome}"[:130], FADED, font(26))
    for picture, left in [(source, 0), (found.drawn, HALF[0])]:
        if picture is not None:
            pair.paste(fitted(picture, HALF), (left, HEAD))
    pen.rectangle((0, 0, pair.width - 1, pair.height - 1), outline="#c0c0c0")
    return pair


def fitted(picture: Image.Image, size: tuple[int, int]) -> Image.Image:
    """A picture in the middle of an area, as large as fits."""
    share = min(size[0] / picture.width, size[1] / picture.height)
    small = picture.resize((round(picture.width * share), round(picture.height * share)), Image.Resampling.LANCZOS)
    space = Image.new("RGB", size, PAPER)
    space.paste(small, ((size[0] - small.width) // 2, (size[1] - small.height) // 2))
    return space


def sheet(found: list[Found], pairs: list[Image.Image]) -> Image.Image:
    """All pairs on one sheet with their names, in few colours."""
    width = SHEET_WIDTH // SHEET_COLUMNS
    height = round(width * HALF[1] / (2 * HALF[0]))
    whole = Image.new("RGB", (SHEET_WIDTH, math.ceil(len(pairs) / SHEET_COLUMNS) * (height + SHEET_HEAD)), PAPER)
    pen = ImageDraw.Draw(whole)
    for index, (became, pair) in enumerate(zip(found, pairs)):
        left, top = index % SHEET_COLUMNS * width, index // SHEET_COLUMNS * (height + SHEET_HEAD)
        pen.text((left + 8, top + 6), became.name, INK, font(18))
        drawings = pair.crop((1, HEAD, pair.width - 1, pair.height - 1))
        whole.paste(drawings.resize((width - 16, height - 6), Image.Resampling.LANCZOS), (left + 8, top + SHEET_HEAD))
    return whole.quantize(48)


def font(size: int) -> ImageFont.FreeTypeFont:
    """A font with letters of many languages, if one is installed."""
    try:
        return ImageFont.truetype("DejaVuSans.ttf", size)
    except OSError:
        return ImageFont.load_default(size)


if __name__ == "__main__":
    sys.exit(main())
