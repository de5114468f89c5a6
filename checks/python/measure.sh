#!/usr/bin/env bash
# Measures a year of tigerplace into a frame of pandas beside the command, which writes it into SQLite, in turns.
#
# Usage: checks/python/measure.sh PYTHON HOMEBODY
#   PYTHON    of an environment that has the wheel and pandas
#   HOMEBODY  the program, built with --release
set -euo pipefail

python="$(realpath -s "${1:?PYTHON}")"
program="$(realpath "${2:?HOMEBODY}")"
scenario="$(realpath "$(dirname "${BASH_SOURCE[0]}")/../../scenarios/tigerplace")"
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

for round in 1 2 3; do
    "$python" - "$scenario" <<'END'
import sys
import time

begun = time.perf_counter()
import homebody as hb

imported = time.perf_counter()
import pandas  # noqa: F401  (its own import is not measured)

home = hb.scenario(sys.argv[1])
asked = time.perf_counter()
frame = home.run(days=365, seed=7, progress=False).events.to_pandas()
done = time.perf_counter()
print(f"import {(imported - begun) * 1000:.0f} ms; {len(frame)} rows in pandas after {done - asked:.2f} s")
END
    TIMEFORMAT="the command: %R s"
    time "$program" run "$scenario" --for 365d --seed 7 --quiet
    rm -rf runs
    echo "round $round is over"
done
