#!/usr/bin/env python3
"""Measures cohorts of tigerplace: workers of a cluster against processes started by hand, and ten times the members against the members.

Usage: PYTHON checks/cohorts/measure.py HOMEBODY [workers] [tenfold]

PYTHON is the interpreter of an environment with the wheel of `pip install "./python[cluster]"`, HOMEBODY the program of `cargo build --release`, both
of one version. By default the script measures both. README.md in this folder lists the variables and the figures.
"""

from __future__ import annotations

import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

SCENARIO = Path(__file__).resolve().parents[2] / "scenarios" / "tigerplace"
MEMBERS = int(os.environ.get("MEMBERS", "1000"))
DAYS = float(os.environ.get("DAYS", "28"))
WORKERS = int(os.environ.get("WORKERS", str(os.cpu_count() or 1)))
ROUNDS = int(os.environ.get("ROUNDS", "3"))
#: Prices of clouds, in dollars: an hour of a virtual core, and a gigabyte in an object store for a month.
CORE_HOUR_USD = float(os.environ.get("CORE_HOUR_USD", "0.05"))
GB_MONTH_USD = float(os.environ.get("GB_MONTH_USD", "0.023"))

BY_CLUSTER = """
import sys
import homebody as hb
scenario, members, days, workers, folder = sys.argv[1:]
if __name__ == "__main__":
    hb.cohort(scenario, int(members), folder, days=float(days), seed=7, truth="brief", cluster="local", workers=int(workers),
              progress=False)
"""

#: The simplest way: each process simulates every n-th member, without supervision.
BY_HAND = """
import sys
import homebody as hb
from homebody.cluster import live_member
folder, first, members, step = sys.argv[1], *map(int, sys.argv[2:])
for index in range(first, members, step):
    live_member(folder, index)
"""

BEGIN = """
import json
import sys
import homebody as hb
from homebody import _homebody
scenario, members, days, folder = sys.argv[1:]
request = {"residents": int(members), "profiles": None, "form": "parquet", "truth": "brief"}
_homebody.Cohort(hb.scenario(scenario)._scenario, json.dumps({"days": float(days), "seed": 7}), request).create(folder)
"""


@dataclass
class Took:
    """The time that a measurement took."""

    wall_s: float
    cpu_s: float


def took(commands: list[list[str]]) -> Took:
    """The time that commands take when they run at once."""
    before, begun = os.times(), time.perf_counter()
    running = [subprocess.Popen(command) for command in commands]
    if any([process.wait() for process in running]):
        sys.exit("measure: a command failed")
    after = os.times()
    cpu_s = after.children_user + after.children_system - before.children_user - before.children_system
    return Took(time.perf_counter() - begun, cpu_s)


def size(folder: Path) -> tuple[int, int]:
    """Files, and their bytes."""
    files = [path.stat().st_size for path in folder.rglob("*") if path.is_file()]
    return len(files), sum(files)


def workers(scratch: Path) -> None:
    """Workers of a cluster against as many processes by hand, in turns."""
    script = scratch / "by_cluster.py"
    script.write_text(BY_CLUSTER)
    shares = []
    for number in range(ROUNDS):
        folder = scratch / "cohort"
        cluster = took([[sys.executable, str(script), str(SCENARIO), str(MEMBERS), str(DAYS), str(WORKERS), str(folder)]])
        shutil.rmtree(folder)
        took([[sys.executable, "-c", BEGIN, str(SCENARIO), str(MEMBERS), str(DAYS), str(folder)]])
        one = [sys.executable, "-c", BY_HAND, str(folder)]
        hand = took([[*one, str(first), str(MEMBERS), str(WORKERS)] for first in range(WORKERS)])
        shutil.rmtree(folder)
        shares.append(hand.wall_s / cluster.wall_s)
        print(
            f"round {number + 1}: {MEMBERS} members of {DAYS:g} days: {WORKERS} workers {cluster.wall_s:.1f} s ({cluster.cpu_s:.1f} s of cores), "
            f"{WORKERS} processes by hand {hand.wall_s:.1f} s ({hand.cpu_s:.1f} s): {shares[-1]:.3f} of the rate by hand",
            flush=True,
        )
    print(f"workers reach {statistics.median(shares):.3f} ({min(shares):.3f}-{max(shares):.3f}) of the rate of processes started by hand; target: 0.9 or more")


def tenfold(program: str, scratch: Path) -> None:
    """Ten times as many members between two cohorts of the members, and an estimate for a million."""

    def lived(members: int) -> tuple[Took, int, int, int]:
        folder = scratch / f"cohort-{members}"
        words = ["run", str(SCENARIO), "--members", str(members), "--for", f"{DAYS:g}d", "--seed", "7", "--truth-tables", "brief", "--quiet"]
        cost = took([[program, *words, "--out", f"parquet:{folder}"]])
        rows = sum(member["rows"] for member in json.loads((folder / "cohort.json").read_text())["members"])
        files, in_bytes = size(folder)
        shutil.rmtree(folder)
        print(
            f"{members} members of {DAYS:g} days: {cost.wall_s:.1f} s, {cost.cpu_s:.1f} s of cores, {rows} rows, {files} files, {in_bytes / 1e6:.1f} MB",
            flush=True,
        )
        return cost, rows, files, in_bytes

    first = lived(MEMBERS)
    many = lived(10 * MEMBERS)
    last = lived(MEMBERS)
    wall_s, cpu_s = (first[0].wall_s + last[0].wall_s) / 2, (first[0].cpu_s + last[0].cpu_s) / 2
    print(
        f"ten times as many took {many[0].wall_s / wall_s:.2f} times as long and {many[0].cpu_s / cpu_s:.2f} times the core time, "
        f"and {many[3] / first[3]:.2f} times the bytes; target: 9.5 to 10.5"
    )
    times = 1_000_000 / (10 * MEMBERS)
    core_h, in_gb = many[0].cpu_s * times / 3600, many[3] * times / 1e9
    print(
        f"estimate for a million members of {DAYS:g} days: {core_h:.0f} hours of a core, {CORE_HOUR_USD * core_h:.0f} dollars at {CORE_HOUR_USD} an hour; "
        f"{many[1] * times / 1e9:.1f} billion rows, {many[2] * times / 1e6:.1f} million files, {in_gb:.0f} GB, "
        f"{GB_MONTH_USD * in_gb:.0f} dollars a month at {GB_MONTH_USD} for a GB; on 100 cores {core_h / 100:.1f} hours"
    )


def main() -> None:
    if len(sys.argv) < 2 or not set(sys.argv[2:]) <= {"workers", "tenfold"}:
        sys.exit(__doc__)
    program = shutil.which(sys.argv[1])
    if program is None:
        sys.exit(f"measure: there is no program {sys.argv[1]}")
    wanted = sys.argv[2:] or ["workers", "tenfold"]
    with tempfile.TemporaryDirectory(prefix="homebody-cohorts-", dir=os.environ.get("SCRATCH")) as scratch:
        if "workers" in wanted:
            workers(Path(scratch))
        if "tenfold" in wanted:
            tenfold(str(Path(program).resolve()), Path(scratch))


if __name__ == "__main__":
    main()
