"""Statements about a life, as data: each becomes one sentence of the routine language.

>>> import homebody as hb
>>> print(hb.life(
...     hb.habit("reading", place="armchair", at="19:30", lasts_min=(30, 40), on=["tuesday", "friday"]),
...     hb.visit("daughter", at="14:00", lasts_min=120, on=["sunday"], share=0.8),
...     hb.change({"later": {"activity": "going_to_bed", "by_s": 3600}}, since="day 40", over_days=14),
... ))
On Tuesday and Friday, she reads in the armchair at 19:30 for 30 to 40 minutes.
On Sunday, on 80 % of days, her daughter visits at 14:00 for 2 hours.
From day 40, over 14 days, she goes to bed 1 hour later.
<BLANKLINE>
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

from homebody import _homebody, arguments

Statement = dict[str, Any]

#: The spreads of a time and of a length that are given as one number, as in sentences.
PLAIN_TIME_S = 300.0
PLAIN_SHARE = 0.1


def life(*statements: Statement) -> str:
    """The text of a routine: one canonical sentence for each statement."""
    return _homebody.routine_text(json.dumps(list(statements)))


def habit(activity: str, place: str | None = None, **when: Any) -> Statement:
    """An activity, by its label such as ``reading``, or in words of one's own with a place and a length.

    ``on`` has weekdays, ``months`` months, ``every`` a number of days; ``share`` is the probability on each such day, and
    ``days_a_week`` an exact number. ``at`` is a clock time or two between which it begins, ``part`` a part of the day, and
    ``after``, ``before`` and ``during`` name another activity. ``lasts_min`` is a length in minutes or a range, ``until`` a
    clock time, ``times`` a number of repetitions or a range. ``since`` and ``to`` are ``day 40`` or dates; the statement
    grows over ``over_days`` and fades over ``fading_days``.
    """
    return _placed({"kind": "habit", "activity": activity}, place, when)


def sleep(activity: str, place: str | None = None, **when: Any) -> Statement:
    """``getting_up`` or ``going_to_bed``, with the place of sleep."""
    arguments.one_of("activity", activity, ("getting_up", "going_to_bed"))
    return _placed({"kind": "sleep", "activity": activity}, place, when)


def away(**when: Any) -> Statement:
    """A time outside the home."""
    return _placed({"kind": "away", "activity": "away"}, None, when)


def visit(visitor: str, place: str | None = None, **when: Any) -> Statement:
    """A visitor, such as ``daughter``, comes and stays a while."""
    return _placed({"kind": "visit", "visitor": visitor, "activity": "visit"}, place, when)


def change(effect: Mapping[str, Any], **when: Any) -> Statement:
    """A change by its effect, such as ``{"shows": {"condition": "depression", "severity": 1.0}}``.

    A number of an effect may be one number, or two for a range.
    """
    return {"kind": "change", "effect": _effect(effect), "when": _when(when)}


def _placed(statement: Statement, place: str | None, when: Mapping[str, Any]) -> Statement:
    if place is not None:
        statement["place"] = arguments.text("place", place)
    return statement | {"when": _when(when)}


def _effect(effect: Mapping[str, Any]) -> dict[str, Any]:
    def trapezoid(name: str, value: Any) -> Any:
        if name in _FUZZY:
            return _range(name, value, 1.0, 0.0)
        if isinstance(value, Mapping):
            return {key: trapezoid(key, inner) for key, inner in value.items()}
        return value

    return {name: trapezoid(name, value) for name, value in effect.items()}


#: The fields of effects that are ranges.
_FUZZY = {
    "by_s",
    "factor",
    "pace",
    "pace_each_week",
    "irregular",
    "days_differ",
    "restless",
    "pulse",
    "respiration",
}

_WHEN = {
    "on",
    "months",
    "every",
    "share",
    "days_a_week",
    "at",
    "part",
    "after",
    "before",
    "during",
    "lasts_min",
    "until",
    "times",
    "since",
    "to",
    "over_days",
    "fading_days",
}


def _when(given: Mapping[str, Any]) -> dict[str, Any]:
    for name in given:
        arguments.one_of("a name of an argument", name, sorted(_WHEN))
    when: dict[str, Any] = {}
    phase = {"from": given.get("since"), "until": given.get("to")}
    phase |= {name: given.get(name) for name in ("over_days", "fading_days")}
    days = {"weekdays": given.get("on"), "months": given.get("months"), "every": given.get("every")}
    chance = {"probability": given.get("share"), "days_a_week": given.get("days_a_week")}
    for name, fields in (("phase", phase), ("days", days), ("chance", chance)):
        known = {field: value for field, value in fields.items() if value is not None}
        if known:
            when[name] = known
    if "at" in given:
        when["time"] = {"at": _range("at", given["at"], 1.0, PLAIN_TIME_S, _clock)}
    if "part" in given:
        when["time"] = {"within": given["part"]}
    for name, field in (("after", "after"), ("before", "before")):
        if name in given:
            when["time"] = {field: [given[name], None]}
    if "during" in given:
        when["time"] = {"with": given["during"]}
    if "lasts_min" in given:
        when["lasts_s"] = _range("lasts_min", given["lasts_min"], 60.0, None)
    if "until" in given:
        when["until_s"] = _range("until", given["until"], 1.0, PLAIN_TIME_S, _clock)
    if "times" in given:
        times = given["times"]
        when["times"] = list(times) if isinstance(times, Sequence) else [times, times]
    return when


def _range(name: str, value: Any, size: float, spread: float | None, read: Any = arguments.number) -> dict[str, float]:
    """A trapezoid of one number with its spread, or of the two ends of a range. Without a spread, it is a share."""
    if isinstance(value, (tuple, list)):
        first, last = (read(f"{name}[{index}]", one) * size for index, one in enumerate(value))
        return {"low": first, "from": first, "to": last, "high": last}
    middle = read(name, value) * size
    around = middle * PLAIN_SHARE if spread is None else spread
    return {"low": middle - around, "from": middle, "to": middle, "high": middle + around}


def _clock(name: str, value: object) -> float:
    """Seconds since midnight of a clock time such as ``07:30``."""
    hours, _, minutes = arguments.text(name, value, "a clock time such as 07:30").partition(":")
    if not (hours.isdigit() and minutes.isdigit() and int(hours) <= 24 and int(minutes) < 60):
        raise ValueError(f"{name} is {value!r}; expected a clock time such as 07:30")
    return int(hours) * 3600.0 + int(minutes) * 60.0
