"""Profiles of a cohort's members: who they are, drawn from a small file of distributions, or listed."""

from __future__ import annotations

import csv
import io
import json
import random
from collections.abc import Iterable, Mapping, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from homebody.errors import Problem, ScenarioError

#: What of a member is drawn.
COLUMNS = ("age", "pace_mps", "conditions", "severity", "onset", "over", "until", "routine")

_NUMBERS = ("normal", "uniform")


def draw(
    people: Mapping[str, Any] | str | PathLike[str], count: int, seed: int = 1
) -> list[dict[str, str]]:
    """So many members, each drawn from distributions: a mapping, or a file of JSON with one.

    A number is ``{"normal": [mean, deviation]}`` or ``{"uniform": [least, most]}``, cut by ``least`` and ``most`` and rounded to
    ``digits``; anything else is how often each value comes, such as ``{"none": 0.8, "depression": 0.2}``. What is drawn of one member
    depends on the seed, the member's name and the column alone.

    >>> people = {"age": {"normal": [82, 6], "least": 65, "most": 99}, "conditions": {"none": 3, "depression": 1}}
    >>> drawn = draw(people, 100, seed=7)
    >>> drawn[0]["name"], 60 <= sum(row["conditions"] == "none" for row in drawn) <= 90
    ('0001', True)
    >>> draw({"age": {"normal": [82, 6]}}, 100, seed=7)[5]["name"]
    '0006'
    """
    name = "people"
    if not isinstance(people, Mapping):
        name = fspath(people)
        try:
            people = json.loads(Path(people).read_text(encoding="utf-8"))
        except OSError as error:
            raise ScenarioError(f"{name}: {error.strerror}") from None
        except ValueError as error:
            raise ScenarioError(f"{name} is no JSON: {error}") from None
        if not isinstance(people, Mapping):
            raise ScenarioError(f"{name}: it is an object, with a distribution for each column")
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
            # Nobody has a course of what they do not have.
            for column in ("severity", "onset", "over", "until"):
                row.pop(column, None)
        rows.append(row)
    return rows


def _wrong(file: str, column: str, of: Any) -> Iterable[Problem]:
    def problem(what: str, hint: str | None = None) -> Problem:
        return Problem(file, 0, 0, f"{column}: {what}", hint)

    if column not in COLUMNS:
        yield problem("nothing of a member is called so", f"there are {', '.join(COLUMNS)}")
        return
    if not isinstance(of, Mapping) or not of:
        yield problem("it is an object", 'write {"normal": [82, 6]}, or {"none": 0.8, "depression": 0.2}')
        return
    kinds = [kind for kind in _NUMBERS if kind in of]
    if kinds:
        two = of[kinds[0]]
        if not (isinstance(two, Sequence) and len(two) == 2 and all(isinstance(n, (int, float)) for n in two)):
            yield problem(f"{kinds[0]} has two numbers")
        for key in of:
            if key not in (*_NUMBERS, "least", "most", "digits"):
                yield problem(f"{key} is not known", "beside it stand least, most and digits")
        return
    for value, weight in of.items():
        if isinstance(weight, bool) or not isinstance(weight, (int, float)) or weight < 0:
            yield problem(f"{value} comes as often as {weight!r}", "that is a number, from 0 on")
    if not any(isinstance(weight, (int, float)) and weight > 0 for weight in of.values()):
        yield problem("nothing of it ever comes")


def _one(chance: random.Random, of: Mapping[str, Any]) -> str:
    if not any(kind in of for kind in _NUMBERS):
        return chance.choices(list(of), weights=list(of.values()))[0]
    first, second = of.get("normal") or of["uniform"]
    value = chance.gauss(first, second) if "normal" in of else chance.uniform(first, second)
    value = min(max(value, of.get("least", value)), of.get("most", value))
    digits = of.get("digits", 2)
    return str(round(value)) if digits == 0 else f"{value:.{digits}f}"


def table(rows: Iterable[Mapping[str, object]]) -> str:
    """Rows as the list that ``homebody run --profiles`` reads."""
    rows = [dict(row) for row in rows]
    columns = list(dict.fromkeys(column for row in rows for column in row))
    text = io.StringIO()
    writer = csv.DictWriter(text, columns, lineterminator="\n", restval="")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()
