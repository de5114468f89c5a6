"""Profiles of the members of a cohort: drawn from distributions, or listed."""

from __future__ import annotations

import csv
import io
import json
import math
import random
from collections.abc import Iterable, Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any

from homebody import _homebody, arguments
from homebody.errors import Problem, ScenarioError

#: The columns that can be drawn.
COLUMNS = ("age", "pace_mps", "conditions", "severity", "onset", "over", "until", "routine", "home")

#: The largest number of members of a cohort.
MOST = _homebody.MOST_MEMBERS

_NUMBERS = ("normal", "uniform")


def draw(
    people: Mapping[str, Any] | str | PathLike[str], count: int, seed: int = 1
) -> list[dict[str, str]]:
    """Draws members from distributions: a mapping, or a JSON file with one.

    A number is ``{"normal": [mean, deviation]}`` or ``{"uniform": [least, most]}``, within ``least`` and ``most`` and rounded to
    ``digits``. Any other mapping gives the weights of values, such as ``{"none": 0.8, "depression": 0.2}``, or, for homes, of files in
    the scenario's folder, ``{"home.json": 2, "studio.json": 1}``. The values of a member depend only on the seed, the member's name and
    the column.

    >>> people = {"age": {"normal": [82, 6], "least": 65, "most": 99}, "conditions": {"none": 3, "depression": 1}}
    >>> drawn = draw(people, 100, seed=7)
    >>> drawn[0]["name"], 60 <= sum(row["conditions"] == "none" for row in drawn) <= 90
    ('0001', True)
    >>> draw({"age": {"normal": [82, 6]}}, 100, seed=7)[5]["name"]
    '0006'
    """
    name = "people"
    count = arguments.whole("count", count, 1, MOST)
    if not isinstance(people, Mapping):
        name = arguments.path("people", people, "a mapping with a distribution for each column, or a JSON file with one")
        try:
            people = json.loads(Path(people).read_text(encoding="utf-8"))
        except OSError as error:
            raise ScenarioError(f"{name}: {error.strerror}") from None
        except ValueError as error:
            raise ScenarioError(f"{name} is not valid JSON: {error}") from None
        if not isinstance(people, Mapping):
            raise ScenarioError(f"{name}: expected an object with a distribution for each column")
    problems = [problem for column, of in people.items() for problem in _wrong(name, column, of)]
    if problems:
        raise ScenarioError("\n".join(map(str, problems)), problems)
    width = max(4, len(str(count)))
    rows = []
    for number in range(1, count + 1):
        row = {"name": f"{number:0{width}}"}
        for column, of in people.items():
            row[column] = _one(random.Random(f"{seed}/{row['name']}/{column}"), of)
        if row.get("conditions") == "none":
            # A member without a condition has no course of one.
            for column in ("severity", "onset", "over", "until"):
                row.pop(column, None)
        rows.append(row)
    return rows


def _wrong(file: str, column: str, of: Any) -> Iterable[Problem]:
    def problem(what: str, hint: str | None = None) -> Problem:
        return Problem(file, 0, 0, f"{column}: {what}", hint)

    if column not in COLUMNS:
        yield problem("unknown column", f"the columns are {', '.join(COLUMNS)}")
        return
    if not isinstance(of, Mapping) or not of:
        yield problem("expected an object", 'write {"normal": [82, 6]}, or {"none": 0.8, "depression": 0.2}')
        return
    kinds = [kind for kind in _NUMBERS if kind in of]
    if kinds:
        two = of[kinds[0]]
        if len(kinds) > 1:
            yield problem(f"both {' and '.join(kinds)} at once", "keep one of them")
        if not (isinstance(two, Sequence) and len(two) == 2 and all(map(_is_number, two))):
            yield problem(f"{kinds[0]} needs two numbers")
        elif kinds[0] == "normal" and two[1] < 0:
            yield problem(f"the deviation is {two[1]}", "it must be 0 or more")
        elif kinds[0] == "uniform" and two[0] > two[1]:
            yield problem(f"the range is from {two[0]} to {two[1]}", "put the smaller number first")
        for key in of:
            if key not in (*_NUMBERS, "least", "most", "digits"):
                yield problem(f"unknown key {key}", "the other keys are least, most and digits")
            elif key in ("least", "most") and not _is_number(of[key]):
                yield problem(f"{key} is {of[key]!r}", "it must be a number")
            elif key == "digits" and of[key] not in range(10):
                yield problem(f"digits is {of[key]!r}", "it must be a whole number from 0 to 9")
        bounds = [of[key] for key in ("least", "most") if _is_number(of.get(key))]
        if bounds != sorted(bounds):
            yield problem(f"least is {bounds[0]}, and most is {bounds[1]}", "least must not be above most")
        return
    for value, weight in of.items():
        if not _is_number(weight) or weight < 0:
            yield problem(f"the weight of {value} is {weight!r}", "it must be a number, 0 or more")
    if not any(_is_number(weight) and weight > 0 for weight in of.values()):
        yield problem("all weights are 0")


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def _one(chance: random.Random, of: Mapping[str, Any]) -> str:
    if not any(kind in of for kind in _NUMBERS):
        return chance.choices(list(of), weights=list(of.values()))[0]
    first, second = of.get("normal") or of["uniform"]
    value = chance.gauss(first, second) if "normal" in of else chance.uniform(first, second)
    value = min(max(value, of.get("least", value)), of.get("most", value))
    digits = of.get("digits", 2)
    return str(round(value)) if digits == 0 else f"{value:.{digits}f}"


def table(rows: Iterable[Mapping[str, object]]) -> str:
    """Rows in the CSV form that ``homebody run --profiles`` reads."""
    wanted = "a mapping of columns to values, such as {'name': 'anna', 'age': 82}"
    rows = [dict(arguments.mapping(f"profiles[{number}]", row, wanted)) for number, row in enumerate(rows)]
    columns = list(dict.fromkeys(column for row in rows for column in row))
    text = io.StringIO()
    writer = csv.DictWriter(text, columns, lineterminator="\n", restval="")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()
