"""Tables with named columns, and the catalogue."""
from __future__ import annotations

import html
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, overload

import numpy.typing as npt

from clackers import _core
from clackers._words import in_python

if TYPE_CHECKING:
    import pandas  # type: ignore[import]

Cell = str | float | int | None


class Column(NamedTuple):
    """A column of a table: its name, its unit (empty when dimensionless or text) and its meaning."""

    name: str
    unit: str
    meaning: str


class Table:
    """Rows with named columns, each column an array.

    ``table["u1"]`` is a column, ``table[0]`` a row, ``len(table)`` the number of rows, and iteration
    yields the rows as tuples. Numbers are float64 or int64; the column ``side`` is -1 (before an
    impact), 1 (after it) or 0; texts are ``str``, and ``None`` where a cell is empty.

    >>> import clackers
    >>> table = clackers.case("stop").energies([0, 1])
    >>> [column.name for column in table.columns]
    ['t', 'side', 'kinetic', 'potential', 'dissipated', 'lost', 'total', 'momentum']
    >>> table["t"]
    array([0., 1.])
    >>> len(table)
    2
    """

    schema: str
    """Name and version of the columns, for example ``clackers/energy/1``."""
    title: str
    """What the table shows; empty for none."""
    columns: tuple[Column, ...]
    """Name, unit and meaning of each column."""

    def __init__(
        self,
        schema: str,
        title: str,
        columns: Sequence[tuple[str, str, str]],
        arrays: Sequence[npt.NDArray[Any]],
    ) -> None:
        self.schema = schema
        self.title = in_python(title)
        self.columns = tuple(Column(name, unit, in_python(meaning)) for name, unit, meaning in columns)
        self._arrays = {column.name: array for column, array in zip(self.columns, arrays, strict=True)}

    def __len__(self) -> int:
        return len(next(iter(self._arrays.values()))) if self._arrays else 0

    def __iter__(self) -> Iterator[tuple[Cell, ...]]:
        return zip(*(array.tolist() for array in self._arrays.values()))

    @overload
    def __getitem__(self, key: str) -> npt.NDArray[Any]: ...

    @overload
    def __getitem__(self, key: int) -> tuple[Cell, ...]: ...

    def __getitem__(self, key: str | int) -> npt.NDArray[Any] | tuple[Cell, ...]:
        if not isinstance(key, str):
            return tuple(array[key].item() if array.dtype != object else array[key]
                         for array in self._arrays.values())
        if key not in self._arrays and key.startswith("collision"):
            key = key.replace("collision", "impact")  # the former names
        if key not in self._arrays:
            _core.refuse_name(f'column in the table "{self.title}" called', key, list(self._arrays))
        return self._arrays[key]

    @property
    def arrays(self) -> dict[str, npt.NDArray[Any]]:
        """All columns by name."""
        return dict(self._arrays)

    def head(self, rows: int = 10) -> Table:
        """The first rows as a table of their own.

        >>> import clackers
        >>> len(clackers.catalogue("metrics").head(3))
        3
        """
        return Table(self.schema, self.title, self.columns, [array[:rows] for array in self._arrays.values()])

    def to_pandas(self) -> pandas.DataFrame:
        """The table as a ``pandas.DataFrame``; its ``attrs`` hold schema, title, units and meanings.

        Raises ImportError where pandas is not installed.

        >>> import clackers
        >>> clackers.catalogue("cases").to_pandas().columns.tolist()
        ['name', 'equations', 'parameters', 'summary']
        """
        try:
            import pandas
        except ImportError as error:
            raise ImportError(
                "Table.to_pandas() needs pandas: apt-get install python3-pandas, or pip install pandas"
            ) from error
        frame = pandas.DataFrame(self._arrays)
        frame.attrs.update(
            schema=self.schema,
            title=self.title,
            units={column.name: column.unit for column in self.columns},
            meanings={column.name: column.meaning for column in self.columns},
        )
        return frame

    def __repr__(self) -> str:
        return self._text(width=80).rstrip("\n")

    def _text(self, width: int) -> str:
        columns = [(column.name, column.unit) for column in self.columns]
        text = _core.table_text(self.title, columns, _shown(self), width)
        return text + _rest(self)

    def _repr_html_(self) -> str:
        names = "".join(
            f'<th title="{html.escape(column.meaning)}">{html.escape(column.name)}'
            + (f"<br>[{html.escape(column.unit)}]" if column.unit else "") + "</th>"
            for column in self.columns
        )
        rows = "".join(
            "<tr>" + "".join(f"<td>{html.escape(_core.cell_text(cell))}</td>" for cell in row) + "</tr>"
            for row in _shown(self)
        )
        rest = html.escape(_rest(self).strip())
        return (
            f"<table><caption>{html.escape(self.title)}</caption><thead><tr>{names}</tr></thead>"
            f"<tbody>{rows}</tbody></table>" + (f"<p>{rest}</p>" if rest else "")
        )


_MOST_SHOWN = 60
_SIDES = {-1: "-", 1: "+", 0: None}


def _shown(table: Table) -> list[tuple[Cell, ...]]:
    """The rows that a table shows of itself, with sides as the command prints them."""
    sides = [column.name == "side" for column in table.columns]
    return [
        tuple(_SIDES[int(cell)] if is_side and isinstance(cell, int) else in_python(cell) if isinstance(cell, str) else cell
              for cell, is_side in zip(row, sides))
        for row in table.head(_MOST_SHOWN)
    ]


def _rest(table: Table) -> str:
    left = len(table) - _MOST_SHOWN
    return f"... and {left} more rows\n" if left > 0 else ""


@overload
def catalogue() -> dict[str, Table]: ...


@overload
def catalogue(kind: str) -> Table: ...


def catalogue(kind: str | None = None) -> dict[str, Table] | Table:
    """What there is: cases, integrators, contact treatments, methods, pairs, metrics, diagnoses and columns.

    Without ``kind`` all tables by their kind. Raises InputError for an unknown kind.

    >>> import clackers
    >>> clackers.catalogue("cases")["name"][0]
    'three-parameter'
    >>> sorted(clackers.catalogue())
    ['cases', 'columns', 'contacts', 'diagnoses', 'integrators', 'methods', 'metrics', 'pairs']
    """
    if kind is None:
        return {each: catalogue(each) for each in _core.listing_kinds()}
    return Table(*_core.listing(kind))


def explain(code: str | None = None) -> Table:
    """What a code means and what to do about it, as a table of one row; without ``code`` all codes.

    Codes are those of errors, behaviours, verdicts and diagnoses. Raises InputError for an unknown code.

    >>> import clackers
    >>> clackers.explain("time-outside")["kind"][0]
    'refusal'
    """
    return Table(*_core.explain(code))
