"""How far some work is, told where somebody looks."""

from __future__ import annotations

import sys
from collections.abc import Callable
from types import TracebackType
from typing import Any


class Progress:
    """A bar while something is done: that of tqdm in a notebook, where tqdm is there; a line on a terminal; else nothing."""

    def __init__(self, what: str, shown: bool | None = None) -> None:
        self._what = what
        self._bar: Any = None
        in_notebook = _in_notebook()
        self._shown = (in_notebook or sys.stderr.isatty()) if shown is None else shown
        if self._shown and in_notebook:
            try:
                from tqdm.auto import tqdm
            except ImportError:
                return
            self._bar = tqdm(total=100, desc=what, unit="%", leave=False)

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


def _in_notebook() -> bool:
    """Whether a notebook's kernel is what runs this."""
    return "ipykernel" in sys.modules
