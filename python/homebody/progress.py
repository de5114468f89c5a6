"""Progress bars for terminals and notebooks."""

from __future__ import annotations

import sys
from collections.abc import Callable
from types import TracebackType
from typing import Any

from homebody import arguments


class Progress:
    """A progress bar: in a notebook that of tqdm, or a line without tqdm; a line on a terminal; otherwise nothing."""

    def __init__(self, what: str, shown: bool | None = None) -> None:
        self._what = what
        self._bar: Any = None
        in_notebook = _in_notebook()
        self._shown = (in_notebook or sys.stderr.isatty()) if shown is None else arguments.flag("progress", shown)
        if self._shown and in_notebook:
            self._bar = _bar(what)

    def __enter__(self) -> Callable[[float, float], None] | None:
        return self._tell if self._shown else None

    def _tell(self, done: float, of: float) -> None:
        percent = 100.0 * done / of if of else 100.0
        if self._bar is not None:
            self._bar.update(round(percent, 1) - self._bar.n)
        else:
            print(f"\r{self._what}: {percent:3.0f} %", end="", file=sys.stderr, flush=True)

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._bar is not None:
            self._bar.close()
        elif self._shown:
            print("\r\x1b[K", end="", file=sys.stderr, flush=True)


class _Line:
    """A line in a notebook that disappears at the end, with the part of tqdm's interface that this module uses."""

    def __init__(self, what: str) -> None:
        from IPython.display import display

        self._what = what
        self.n = 0.0
        self._handle: Any = display(self._said(""), raw=True, display_id=True)

    def _said(self, text: str) -> dict[str, str]:
        return {"text/plain": text}

    def update(self, percent: float) -> None:
        self.n += percent
        self._handle.update(self._said(f"{self._what}: {self.n:3.0f} %"), raw=True)

    def close(self) -> None:
        self._handle.update(self._said(""), raw=True)


def _bar(what: str) -> Any:
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return _Line(what)
    return tqdm(total=100, desc=what, unit="%", leave=False)


def _in_notebook() -> bool:
    """Whether a notebook's kernel runs this program."""
    return "ipykernel" in sys.modules
