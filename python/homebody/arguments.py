"""What arguments may be: a wrong type says which argument it is, what it is, and what it should be."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from os import PathLike, fspath
from typing import Any


#: No run and no cohort lives for longer.
MOST_DAYS = 36_525


def wrong(name: str, value: object, wanted: str) -> TypeError:
    """The error of an argument that is of another type than it should be."""
    return TypeError(f"{name} is {value!r}: it is {wanted}")


def number(name: str, value: object) -> float:
    """A number; what is true or false is none.

    >>> number("days", 7), number("days", 0.5)
    (7.0, 0.5)
    >>> number("days", "ten")
    Traceback (most recent call last):
    TypeError: days is 'ten': it is a number
    """
    if isinstance(value, (bool, str)) or not hasattr(value, "__float__"):
        raise wrong(name, value, "a number")
    # numpy's numbers, too.
    return float(value)


def whole(name: str, value: object, least: int, most: int, what: str = "a whole number") -> int:
    """A whole number within bounds."""
    if isinstance(value, bool) or not hasattr(value, "__index__"):
        raise wrong(name, value, what)
    count = int(value.__index__())
    if not least <= count <= most:
        raise ValueError(f"{name} is {count}: it is from {least:,} to {most:,}")
    return count


def length_days(name: str, value: object) -> float:
    """How long something is lived, in days.

    >>> length_days("days", -1)
    Traceback (most recent call last):
    ValueError: days is -1.0: it is longer than nothing, and at most 36,525, which are a hundred years
    """
    days = number(name, value)
    if not 0 < days <= MOST_DAYS:
        raise ValueError(f"{name} is {days}: it is longer than nothing, and at most {MOST_DAYS:,}, which are a hundred years")
    return days


def flag(name: str, value: object) -> bool:
    """What is true or false; no word is taken for either.

    >>> flag("one_of_many", "no")
    Traceback (most recent call last):
    TypeError: one_of_many is 'no': it is True or False
    """
    # numpy's, too.
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
    ValueError: truth is 'some': it is all or brief
    """
    wanted = " or ".join(known)
    if text(name, value, wanted) not in known:
        raise ValueError(f"{name} is {value!r}: it is {wanted}")
    return str(value)


def texts(name: str, value: object, wanted: str) -> list[str]:
    """Several texts, of which one alone is none."""
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
