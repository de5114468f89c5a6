#!/usr/bin/env python3
"""Imports plans of Sweet Home 3D and simulates a day in each: with its own furniture, and with missing furniture added by --furnish.

Usage: python3 checks/plans/lived.py HOMEBODY FOLDER...

HOMEBODY is the program. The script reads all NAME.sh3d of each FOLDER and prints a Markdown table, with the reason if a plan has no
ordinary day. It exits with code 1 if fewer than nine in ten of the plans with rooms and furniture have an ordinary day with --furnish.
"""

from __future__ import annotations

import argparse
import json
import sqlite3
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

LEAST_SHARE = 0.9
#: The least of an ordinary day: hours asleep, meals, visits to the bathroom.
LEAST = (4.0, 2, 2)
DAY = """
SELECT (SELECT coalesce(sum(julianday(end_at) - julianday(begin_at)), 0) * 24 FROM activity WHERE name = 'sleeping'),
       (SELECT count(*) FROM activity WHERE name LIKE 'eating_%'), (SELECT count(*) FROM activity WHERE name = 'using_bathroom')
"""
#: The beginning of a warning about a need of the ordinary routine that the home does not meet.
LACK = "warning[new-home::routine-lacks]: "


@dataclass
class Life:
    """The result for a plan."""

    #: The reason why it was not imported; `None` if it was.
    refused: str | None = None
    rooms: int = 0
    doors: int = 0
    pieces: int = 0
    remarks: list[str] = field(default_factory=list)
    lacks: list[str] = field(default_factory=list)
    #: Hours asleep, meals and visits to the bathroom; `None` if the home lacks furniture for them.
    day: tuple[float, int, int] | None = None

    @property
    def is_lived_in(self) -> bool:
        return self.day is not None and all(had >= least for had, least in zip(self.day, LEAST))

    @property
    def outcome(self) -> str:
        if self.refused is not None:
            return "not imported"
        if self.day is None:
            return "no: " + "; ".join(self.lacks)
        asleep, meals, visits = self.day
        return f"{'yes' if self.is_lived_in else 'no'}: {asleep:.1f} h asleep, {meals} meals, {visits} bathroom"


def lived(homebody: Path, plan: Path, folder: Path, *options: str) -> Life:
    """Imports a plan into a folder, and simulates a day if the home has all necessary furniture."""

    def run(*words: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run([homebody, *words], cwd=folder, capture_output=True, text=True, check=False)

    name = "-".join([plan.stem, *(option.strip("-") for option in options)])
    imported = run("import", str(plan), name, *options)
    said = [line.removeprefix(f"{plan}: ") for line in imported.stderr.splitlines()]
    if imported.returncode != 0:
        return Life(refused=said[0] if said else "", remarks=said)
    ready = next((index for index, line in enumerate(said) if line.startswith(f"{name} is ready")), len(said))
    lacks = [line.removeprefix(LACK) for line in said if line.startswith(LACK)]
    remarks = [line for line in said[:ready] if not line.startswith((LACK, "  ", "Anna's routine"))]
    home = json.loads((folder / name / "home.json").read_text())
    life = Life(None, len(home["rooms"]), len(home["doors"]), len(home["furniture"]), remarks, lacks)
    if not lacks:
        truth = f"{name}.truth.db"
        run("run", name, "--for", "1d", "--quiet", "--out", f"csv:{name}.csv", "--truth", f"sqlite:{truth}").check_returncode()
        with sqlite3.connect(folder / truth) as connection:
            life.day = connection.execute(DAY).fetchone()
    return life


def main() -> int:
    parser = argparse.ArgumentParser(description="Counts the plans of Sweet Home 3D in which Homebody can simulate an ordinary day.")
    parser.add_argument("homebody", type=Path)
    parser.add_argument("folders", type=Path, nargs="+")
    arguments = parser.parse_args()
    counts = []
    print("| plan | rooms, doors, pieces | ordinary day as drawn | with --furnish |")
    print("|---|---|---|---|")
    for folder in arguments.folders:
        lives = []
        for plan in sorted(folder.glob("*.sh3d")):
            with tempfile.TemporaryDirectory() as scratch:
                given = arguments.homebody.resolve(), plan.resolve(), Path(scratch)
                drawn = lived(*given)
                # A home with all the furniture does not need more.
                furnished = drawn if drawn.is_lived_in else lived(*given, "--furnish")
            lives.append((drawn, furnished))
            size = drawn.refused or f"{drawn.rooms}, {drawn.doors}, {drawn.pieces}"
            print(f"| {plan.stem} | {size} | {drawn.outcome} | {furnished.outcome} |", flush=True)
        counts.append((folder.name, lives))
    print()
    every = [life for _, lives in counts for life in lives]
    for name, lives in [*counts, ("all", every)]:
        imported = [pair for pair in lives if pair[0].refused is None]
        whole = [pair for pair in imported if pair[0].rooms and pair[0].pieces]
        shares = [sum(pair[way].is_lived_in for pair in whole) for way in (0, 1)]
        anyhow = sum(pair[1].is_lived_in for pair in imported)
        print(f"{name}: {len(lives)} plans, {len(imported)} imported, {len(whole)} with rooms and furniture; of these with an ordinary day as drawn "
              f"{shares[0]}, with --furnish {shares[1]}; of all imported with --furnish {anyhow}")
    whole = [furnished for drawn, furnished in every if drawn.rooms and drawn.pieces]
    return 0 if whole and sum(life.is_lived_in for life in whole) >= LEAST_SHARE * len(whole) else 1


if __name__ == "__main__":
    sys.exit(main())
