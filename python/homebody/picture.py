"""Pictures for notebooks and files."""

from __future__ import annotations

import json
from os import PathLike
from pathlib import Path
from typing import Any

from homebody import arguments
from homebody._homebody import png
from homebody.errors import HomebodyError


class Picture:
    """A picture. Notebooks display it; :meth:`save` writes it as SVG or PNG.

    >>> import homebody as hb
    >>> hb.scenario("studio").plan.plot().svg[:4]
    '<svg'
    """

    def __init__(self, svg: str) -> None:
        #: Its SVG text.
        self.svg = svg

    def png(self, width: int = 1600) -> bytes:
        """The picture as PNG, with this width in pixels."""
        return png(self.svg, arguments.whole("width", width, 1, 20_000))

    def save(self, path: str | PathLike[str], width: int = 1600) -> Path:
        """Writes it to a file whose name ends in ``.svg`` or ``.png``."""
        path = Path(arguments.path("path", path))
        match path.suffix.lower():
            case ".svg":
                written = self.svg.encode()
            case ".png":
                written = self.png(width)
            case other:
                raise ValueError(f"path is {str(path)!r}, which ends in {other!r}; expected .svg or .png")
        try:
            path.write_bytes(written)
        except OSError as error:
            hint = f"\n  hint: {path.parent} is not a folder" if not path.parent.is_dir() else ""
            raise HomebodyError(f"{path}: {error.strerror or error}{hint}") from None
        return path

    def _repr_svg_(self) -> str:
        return self.svg

    def _repr_png_(self) -> bytes:
        return self.png()

    def __repr__(self) -> str:
        return f"<homebody.Picture: {len(self.svg):,} bytes of SVG>"


class Answer:
    """Figures, with their picture.

    >>> import homebody as hb
    >>> coverage = hb.scenario("studio").coverage()
    >>> 0 < coverage.data["whole"]["floor_m2"]
    True
    >>> coverage.plot()
    <homebody.Picture: ...
    """

    def __init__(self, what: str, figures: str, svg: str) -> None:
        self._what = what
        #: The figures, as in the command's ``--json``.
        self.data: dict[str, Any] = json.loads(figures)
        self._picture = Picture(svg)

    def plot(self) -> Picture:
        """The picture."""
        return self._picture

    def save(self, path: str | PathLike[str], width: int = 1600) -> Path:
        """Writes the picture to a file."""
        return self._picture.save(path, width)

    def _repr_svg_(self) -> str:
        return self._picture.svg

    def __repr__(self) -> str:
        return f"<homebody.{self._what}: {', '.join(self.data)}>"
