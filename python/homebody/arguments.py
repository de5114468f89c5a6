"""Checks of arguments. An error names the argument, its value and the expected value."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from math import isfinite
from os import PathLike, fspath
from typing import Any

from homebody import _homebody

#: The options of a run, by name: type, range and expected values. The struct ``RunOptions`` in Rust declares them.
RUN_OPTIONS: dict[str, dict[str, Any]] = json.loads(_homebody.RUN_OPTIONS)


def wrong(name: str, value: object, wanted: str) -> TypeError:
    """The error for an argument of a wrong type."""
    return TypeError(f"{name} is {value!r}; expected {wanted}")


def number(name: str, value: object) -> float:
    """A number; ``True`` and ``False`` are not numbers.

    >>> number("days", 7), number("days", 0.5)
    (7.0, 0.5)
    >>> number("days", "ten")
    Traceback (most recent call last):
    TypeError: days is 'ten'; expected a number
    """
    if isinstance(value, (bool, str)) or not hasattr(value, "__float__"):
        raise wrong(name, value, "a number")
    # Also for numpy's numbers.
    return float(value)


def whole(name: str, value: object, least: int, most: int, what: str = "a whole number") -> int:
    """A whole number within bounds."""
    if isinstance(value, bool) or not hasattr(value, "__index__"):
        raise wrong(name, value, what)
    count = int(value.__index__())
    if not least <= count <= most:
        raise ValueError(f"{name} is {count}; expected a number from {least:,} to {most:,}")
    return count


def option_type(name: str) -> str:
    """The type of the values of an option of a run, as JSON Schema names it.

    >>> option_type("seed")
    'integer'
    """
    types = RUN_OPTIONS[name]["type"]
    return str(types[0] if isinstance(types, list) else types)


def option(name: str, value: object) -> Any:
    """The value of an option of a run.

    >>> option("days", -1)
    Traceback (most recent call last):
    ValueError: days is -1.0; expected more than 0 and at most 36,525 (a hundred years)
    """
    schema = RUN_OPTIONS[name]
    kind = option_type(name)
    if kind == "integer":
        return whole(name, value, schema["minimum"], schema["maximum"])
    if kind == "number":
        real = number(name, value)
        if not schema["exclusiveMinimum"] < real <= schema["maximum"]:
            raise ValueError(f"{name} is {real}; expected {schema['expected']}")
        return real
    if kind == "boolean":
        return flag(name, value)
    if kind == "array":
        return texts(name, value, schema["expected"])
    if kind == "object":
        return {key: _finite(f"{name}[{key!r}]", one) for key, one in mapping(name, value, schema["expected"]).items()}
    return text(name, value, schema["expected"])


def run_options(given: Mapping[str, object]) -> str:
    """The options of a run among these arguments, as JSON. ``None`` is the value of the scenario."""
    return json.dumps({name: option(name, given[name]) for name in RUN_OPTIONS if given.get(name) is not None})


def _finite(name: str, value: object) -> float:
    real = number(name, value)
    if not isfinite(real):
        raise ValueError(f"{name} is {real}; expected a finite number")
    return real


def flag(name: str, value: object) -> bool:
    """``True`` or ``False``; words are refused.

    >>> flag("one_of_many", "no")
    Traceback (most recent call last):
    TypeError: one_of_many is 'no'; expected True or False
    """
    # Also for numpy's values.
    if isinstance(value, bool) or type(value).__name__ in ("bool_", "bool"):
        return bool(value)
    raise wrong(name, value, "True or False")


def text(name: str, value: object, wanted: str = "a text") -> str:
    """A text."""
    if not isinstance(value, str):
        raise wrong(name, value, wanted)
    return value


def one_of(name: str, value: object, known: Sequence[str]) -> str:
    """One of some words.

    >>> one_of("truth", "all", ("all", "brief"))
    'all'
    >>> one_of("truth", "some", ("all", "brief"))
    Traceback (most recent call last):
    ValueError: truth is 'some'; expected all or brief
    """
    wanted = " or ".join(known)
    if text(name, value, wanted) not in known:
        raise ValueError(f"{name} is {value!r}; expected {wanted}")
    return str(value)


def texts(name: str, value: object, wanted: str) -> list[str]:
    """Several texts; a single text is refused."""
    if isinstance(value, (str, Mapping)) or not isinstance(value, Iterable):
        raise wrong(name, value, wanted)
    return [text(f"{name}[{number}]", one) for number, one in enumerate(value)]


def path(name: str, value: object, wanted: str = "a path") -> str:
    """A path, as a text."""
    if not isinstance(value, (str, PathLike)):
        raise wrong(name, value, wanted)
    return str(fspath(value))


def point(name: str, value: object) -> tuple[float, float]:
    """A point, in metres."""
    if isinstance(value, str) or not isinstance(value, Iterable) or len(two := list(value)) != 2:
        raise wrong(name, value, "a point: two numbers, in metres")
    return number(name, two[0]), number(name, two[1])


def mapping(name: str, value: object, wanted: str) -> Mapping[str, Any]:
    """A mapping whose keys are texts."""
    if not isinstance(value, Mapping):
        raise wrong(name, value, wanted)
    for key in value:
        text(f"a key of {name}", key)
    return value
