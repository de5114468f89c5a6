"""The command ``python -m homebody.cohort``; ``homebody.cohort`` itself is a function."""

from __future__ import annotations

import argparse
import sys
import warnings
from collections.abc import Sequence

from homebody._cohort import Profiles, cohort
from homebody.errors import HomebodyError
from homebody.profiles import draw


def _arguments() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m homebody.cohort",
        description="Lives many people in a home into a folder, on this machine or on a cluster of Dask. The same words again go on "
        "with a cohort that was stopped.",
    )
    parser.add_argument("scenario", help="a folder, or the name of a template")
    parser.add_argument("--out", required=True, metavar="FOLDER", help="for all members together: a new folder, or a URL such as s3://bucket/cohort")
    who = parser.add_mutually_exclusive_group(required=True)
    who.add_argument("--residents", type=int, metavar="N", help="so many, of whom each differs as people do")
    who.add_argument("--profiles", metavar="FILE", help="those of a list: a CSV file with a row for each")
    who.add_argument("--draw", nargs=2, metavar=("FILE", "N"), help="so many, drawn from the distributions in a file of JSON")
    parser.add_argument("--days", type=float, help="how long each lives; the scenario's days without it")
    parser.add_argument("--seed", type=int, help="the number all randomness comes from")
    parser.add_argument("--without", action="append", default=[], metavar="CONDITION", help="leave a condition out")
    parser.add_argument("--form", default="parquet", help="parquet, csv, jsonl, sqlite or arrow (default: parquet)")
    parser.add_argument("--truth", choices=("all", "brief"), help="how much of each truth is kept (default: all, of a large cohort what is brief)")
    parser.add_argument("--cluster", metavar="ADDRESS", help="tcp://... of a scheduler of Dask, or local; threads without it")
    parser.add_argument("--workers", type=int, metavar="N", help="of a local cluster")
    return parser


def main(words: Sequence[str] | None = None) -> int:
    """Does what the words of a command line ask for; returns the exit code."""
    asked = _arguments().parse_args(words)
    warnings.showwarning = lambda message, *_: print(f"warning: {message}", file=sys.stderr)
    try:
        profiles: Profiles = asked.residents if asked.residents is not None else asked.profiles
        if asked.draw:
            profiles = draw(asked.draw[0], int(asked.draw[1]), 1 if asked.seed is None else asked.seed)
        lived = cohort(
            asked.scenario,
            profiles,
            asked.out,
            days=asked.days,
            seed=asked.seed,
            without=asked.without,
            form=asked.form,
            truth=asked.truth,
            cluster=asked.cluster,
            workers=asked.workers,
        )
    except (HomebodyError, ValueError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("stopped: the same words go on with it", file=sys.stderr)
        return 130
    rows = sum(member["rows"] for member in lived.manifest["members"])
    print(f"{lived.manifest['scenario']}: {len(lived)} lives, {rows} rows in {lived.folder}")
    return 0


if __name__ == "__main__":
    sys.exit(main())

# Whoever imports the module gets the function, which has its name.
sys.modules[__name__] = cohort  # type: ignore[assignment]
