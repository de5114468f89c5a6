"""The exceptions of the package. All of them are a :class:`HomebodyError`."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path
from types import MappingProxyType


@dataclass(frozen=True)
class Problem:
    """An error in a scenario or a list, with its place and a hint."""

    file: str
    #: Counted from 1; 0 if the problem concerns the whole file.
    line: int
    column: int
    what: str
    hint: str | None = None
    #: The stable code of the message, such as ``kit::exists``; ``homebody explain`` has more about it.
    code: str = ""
    #: ``error`` or ``warning``.
    severity: str = "error"
    #: The values that the text quotes, by name.
    data: Mapping[str, object] = field(default_factory=dict)
    #: The change that solves it, where there is one: its ``kind`` is ``replace``, ``let_enter`` or ``add``.
    fix: Mapping[str, object] | None = None

    def __str__(self) -> str:
        place = f"{self.file}:{self.line}:{self.column}" if self.line else self.file
        return f"{place}: {self.what}" + (f"\n  hint: {self.hint}" if self.hint else "")


class HomebodyError(Exception):
    """The base of all errors; the text describes the error and the remedy."""

    #: The stable code of the message; empty where it has none.
    code: str = ""
    #: The way to solve it, which the text contains, too.
    hint: str | None = None
    #: The change that solves it, where there is one.
    fix: Mapping[str, object] | None = None
    #: The values that the text quotes, by name.
    data: Mapping[str, object] = MappingProxyType({})


class ScenarioError(HomebodyError):
    """Errors in a scenario, in a list of profiles, or in their use: all problems at once."""

    def __init__(self, text: str, problems: Sequence[Problem] = ()) -> None:
        super().__init__(text)
        self.problems: list[Problem] = list(problems)

    def __reduce__(self) -> tuple[object, ...]:
        # Keeps the problems, also from a worker of a cluster.
        return (type(self), (self.args[0], self.problems))


class Exists(HomebodyError, FileExistsError):
    """The output exists already, and Homebody does not replace it."""


class LogError(HomebodyError):
    """A log or a truth cannot be read or written."""


class ModelError(HomebodyError):
    """A language model does not answer, or none of its answers can be used."""


class DriverError(HomebodyError):
    """A driver returned an impossible step."""


class Stopped(HomebodyError):
    """Work was stopped before its end."""


class ClusterError(HomebodyError):
    """A cluster is not available, or has lost members of a cohort."""


class MissingPackage(HomebodyError, ImportError):
    """An optional package is missing; the text says how to install it."""


def new_folder(folder: str, make: Callable[[Path], object]) -> Path:
    """A folder of this name, which ``make`` makes; an existing one stays unchanged.

    >>> new_folder(".", Path.mkdir)
    Traceback (most recent call last):
    homebody.errors.Exists: .: the folder exists already
      hint: name a new folder
    """
    try:
        make(Path(folder))
    except FileExistsError:
        raise Exists(f"{folder}: the folder exists already\n  hint: name a new folder") from None
    except OSError as error:
        raise LogError(f"{folder}: {error.strerror or error}") from None
    return Path(folder)


def needs(package: str, what: str, extra: str | None = None) -> None:
    """Checks that an optional package is installed, which ``what`` imports next.

    >>> needs("json", "this example")
    >>> needs("no_such_package", "this example", "pandas")
    Traceback (most recent call last):
    homebody.errors.MissingPackage: this example needs no_such_package, which is not installed
      hint: pip install no_such_package, or pip install "homebody[pandas]"
    """
    try:
        import_module(package)
    except ImportError as error:
        why = "which is not installed" if getattr(error, "name", None) == package else f"which cannot be imported: {error}"
        extras = f', or pip install "homebody[{extra}]"' if extra else ""
        hint = f"pip install {package}{extras}"
        raise MissingPackage(f"{what} needs {package}, {why}\n  hint: {hint}", name=package) from None
