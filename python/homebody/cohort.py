"""The command ``python -m homebody.cohort``; ``homebody.cohort`` itself is a function."""

from __future__ import annotations

import argparse
import sys
import warnings
from collections.abc import Sequence
from inspect import signature
from typing import Any

from homebody._cohort import Profiles, cohort
from homebody.arguments import RUN_OPTIONS, option_type
from homebody.errors import HomebodyError
from homebody.profiles import draw

#: The options of a run that a cohort has.
_OPTIONS = [name for name in RUN_OPTIONS if name in signature(cohort).parameters]

#: The form of an option in the command, by the type of its values.
_FORMS: dict[str, dict[str, Any]] = {
    "integer": {"type": int},
    "number": {"type": float},
    "array": {"action": "append", "default": []},
}

#: Words for the values in the help. Other options have their own name in capitals.
_VALUES = {"without": "CONDITION"}


def _arguments() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m homebody.cohort",
        description="Simulates many people in a home and writes their logs to a folder, on this machine or on a Dask cluster. "
        "Repeat the command to resume a cohort that was stopped.",
    )
    parser.add_argument("scenario", help="a folder, or the name of a template")
    parser.add_argument("--out", required=True, metavar="FOLDER", help="where the cohort goes: a new folder, or a URL such as s3://bucket/cohort")
    who = parser.add_mutually_exclusive_group(required=True)
    who.add_argument("--residents", type=int, metavar="N", help="number of members, who differ as people do")
    who.add_argument("--profiles", metavar="FILE", help="list of members: a CSV file with a row for each")
    who.add_argument("--draw", nargs=2, metavar=("FILE", "N"), help="number of members, drawn from the distributions in a JSON file")
    for name in _OPTIONS:
        # The help is cut before the examples, which are written for the command line of homebody, but keeps the default.
        summary, *_ = RUN_OPTIONS[name]["description"].splitlines()
        sentence, bracket, default = summary.partition(" (default: ")
        help_text = sentence.split(": ")[0] + bracket + default
        parser.add_argument(f"--{name.replace('_', '-')}", metavar=_VALUES.get(name), help=help_text, **_FORMS[option_type(name)])
    parser.add_argument("--form", default="parquet", help="parquet, csv, jsonl, sqlite or arrow (default: parquet)")
    parser.add_argument("--truth", choices=("all", "brief"), help="tables of the ground truth to keep (default: all; brief for a large cohort)")
    parser.add_argument("--cluster", metavar="ADDRESS", help="tcp://... of a Dask scheduler, or local (default: threads)")
    parser.add_argument("--workers", type=int, metavar="N", help="number of workers of a local cluster")
    return parser


def main(words: Sequence[str] | None = None) -> int:
    """Runs the command with these arguments and returns the exit code."""
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
            **{name: getattr(asked, name) for name in _OPTIONS},
            form=asked.form,
            truth=asked.truth,
            cluster=asked.cluster,
            workers=asked.workers,
        )
    except (HomebodyError, ValueError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("stopped: repeat the command to resume", file=sys.stderr)
        return 130
    rows = sum(member["rows"] for member in lived.manifest["members"])
    print(f"{lived.manifest['scenario']}: {len(lived)} members, {rows} rows in {lived.folder}")
    return 0


if __name__ == "__main__":
    sys.exit(main())

# An import of the module gives the function of the same name.
sys.modules[__name__] = cohort  # type: ignore[assignment]
