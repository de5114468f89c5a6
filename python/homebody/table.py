"""Arrow tables in memory, for pandas, polars and pyarrow."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from homebody._homebody import Stream
from homebody.errors import needs

if TYPE_CHECKING:
    import pandas
    import polars
    import pyarrow


class Table:
    """A table. Libraries with the Arrow PyCapsule interface read it directly: ``polars.DataFrame(table)``, ``pyarrow.table(table)``.

    >>> import homebody as hb
    >>> run = hb.scenario("studio").run(days=1, seed=7)
    >>> run.events.columns
    ['time', 'device', 'value']
    >>> len(run.events) > 100
    True
    """

    def __init__(self, stream: Stream) -> None:
        self._stream = stream

    def __len__(self) -> int:
        return self._stream.rows

    @property
    def columns(self) -> list[str]:
        """The names of its columns."""
        return self._stream.columns

    @property
    def types(self) -> dict[str, str]:
        """The types of its columns, by Arrow's names."""
        return dict(zip(self._stream.columns, self._stream.types))

    @property
    def nbytes(self) -> int:
        """Its size in memory, in bytes."""
        return self._stream.bytes

    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object:
        return self._stream.__arrow_c_stream__(requested_schema)

    def to_pyarrow(self) -> pyarrow.Table:
        """The table as a pyarrow table, over the same memory."""
        needs("pyarrow", "Table.to_pyarrow")
        import pyarrow

        return pyarrow.table(self)

    def to_pandas(self) -> pandas.DataFrame:
        """The table as a pandas frame: times have a zone, texts are categories."""
        needs("pandas", "Table.to_pandas", "pandas")
        needs("pyarrow", "Table.to_pandas", "pandas")
        return self.to_pyarrow().to_pandas()

    def to_polars(self) -> polars.DataFrame:
        """The table as a polars frame."""
        needs("polars", "Table.to_polars", "polars")
        import polars

        return polars.DataFrame(self)

    def __repr__(self) -> str:
        return f"<homebody.Table: {len(self):,} rows of {', '.join(self.columns)}>"

    def _repr_html_(self) -> str | None:
        """Its first rows in a notebook, if pandas is installed."""
        try:
            html: Any = self.to_pandas().head(10).to_html()
        except ImportError:
            return None
        return f"{html}<p>{len(self):,} rows</p>"
