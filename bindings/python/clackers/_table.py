"""Tables with named columns, and the catalogue."""
from __future__ import annotations

import html
import importlib
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, overload

import numpy.typing as npt

from clackers import _core
from clackers._errors import InputError
from clackers._words import in_python

if TYPE_CHECKING:
    import pandas  # type: ignore[import]
    import xarray

Cell = str | float | int | None


class Column(NamedTuple):
    """A column of a table: its name, its unit (empty when dimensionless or text) and its meaning.

    Attributes
    ----------
    name : str
        ``t``, ``u1``, ...
    unit : str
        Empty when dimensionless or text.
    meaning : str
        In words.
    """

    name: str
    unit: str
    meaning: str


class Table(Mapping[str, npt.NDArray[Any]]):
    """A mapping from the names of columns to arrays of equal lengths.

    Numbers are float64 or int64; the column ``side`` is -1 (before an impact), 1 (after it) or 0; texts are
    ``str``, and ``None`` where a cell is empty. ``rows`` has the rows. A name that is not there raises InputError,
    which is a KeyError here.

    Examples
    --------
    >>> import clackers
    >>> table = clackers.case("stop").energies([0, 1])
    >>> list(table)
    ['t', 'side', 'kinetic', 'potential', 'dissipated', 'lost', 'total', 'momentum']
    >>> table["t"]
    array([0., 1.])
    >>> len(table.rows), table.rows[0][:2]
    (2, (0.0, 0))
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
        return len(self._arrays)

    def __iter__(self) -> Iterator[str]:
        return iter(self._arrays)

    def __getitem__(self, key: str) -> npt.NDArray[Any]:
        if key not in self._arrays and isinstance(key, str) and key.startswith("collision"):
            key = key.replace("collision", "impact")  # the former names
        if key in self._arrays:
            return self._arrays[key]
        try:
            key = _core.read_text("table", "column", key)
            _core.refuse_name(f'column in the table "{self.title}" called', key, list(self._arrays))
        except InputError as error:
            raise _UnknownColumn(str(error), error.code) from None

    @property
    def rows(self) -> list[tuple[Cell, ...]]:
        """The rows, with numbers of Python."""
        return list(zip(*(array.tolist() for array in self._arrays.values())))

    def head(self, rows: int = 10) -> Table:
        """The first rows as a table of their own.

        Parameters
        ----------
        rows : int
            How many, at most.

        Returns
        -------
        Table

        Examples
        --------
        >>> import clackers
        >>> clackers.catalogue("metrics").head(3)["name"].shape
        (3,)
        """
        return Table(self.schema, self.title, self.columns, [array[:rows] for array in self._arrays.values()])

    def to_pandas(self) -> pandas.DataFrame:
        """The table for pandas.

        Returns
        -------
        pandas.DataFrame
            Its ``attrs`` hold schema, title, units and meanings.

        Raises
        ------
        ImportError
            Where pandas is not installed.

        Examples
        --------
        >>> import clackers
        >>> clackers.catalogue("cases").to_pandas().columns.tolist()
        ['name', 'equations', 'parameters', 'summary']
        """
        frame: pandas.DataFrame = _module("Table.to_pandas()", "pandas").DataFrame(self._arrays)
        frame.attrs.update(
            schema=self.schema,
            title=self.title,
            units={column.name: column.unit for column in self.columns},
            meanings={column.name: column.meaning for column in self.columns},
        )
        return frame

    def to_xarray(self) -> xarray.Dataset:
        """The table for xarray.

        Returns
        -------
        xarray.Dataset
            A variable a column over the dimension ``row``, with ``units`` and ``long_name``; the first is a coordinate.

        Raises
        ------
        ImportError
            Where xarray is not installed.

        Examples
        --------
        >>> import clackers
        >>> clackers.case("stop").energies([0, 1]).to_xarray()["kinetic"].attrs["units"]
        'J'
        """
        variables = {
            column.name: ("row", self[column.name], {"units": column.unit, "long_name": column.meaning})
            for column in self.columns
        }
        made: xarray.Dataset = _module("Table.to_xarray()", "xarray").Dataset(
            variables, attrs={"schema": self.schema, "title": self.title}
        )
        return made.set_coords(self.columns[0].name)

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


class _UnknownColumn(InputError, KeyError):
    """A KeyError, so that the methods of Mapping know what is not there."""

    __str__ = BaseException.__str__  # KeyError's has the quotes of repr()


def _module(user: str, name: str) -> Any:
    """A module that only ``user`` needs."""
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise ImportError(f"{user} needs {name}: apt-get install python3-{name}, or pip install {name}") from error


_MOST_SHOWN = 60
_SIDES = {-1: "-", 1: "+", 0: None}


def _shown(table: Table) -> list[tuple[Cell, ...]]:
    """The rows that a table shows of itself, with sides as the command prints them."""
    sides = [column.name == "side" for column in table.columns]
    return [
        tuple(_SIDES[int(cell)] if is_side and isinstance(cell, int) else in_python(cell) if isinstance(cell, str) else cell
              for cell, is_side in zip(row, sides))
        for row in table.head(_MOST_SHOWN).rows
    ]


def _rest(table: Table) -> str:
    left = len(table.rows) - _MOST_SHOWN
    return f"... and {left} more rows\n" if left > 0 else ""


@overload
def catalogue() -> dict[str, Table]: ...


@overload
def catalogue(kind: str) -> Table: ...


def catalogue(kind: str | None = None) -> dict[str, Table] | Table:
    """What there is: cases, integrators, contact treatments, methods, pairs, metrics, diagnoses and columns.

    Parameters
    ----------
    kind : str, optional
        One of them.

    Returns
    -------
    Table or dict of Table
        Without ``kind`` all tables by their kind.

    Raises
    ------
    InputError
        For an unknown kind.

    Examples
    --------
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
    """What a code means and what to do about it.

    Parameters
    ----------
    code : str, optional
        Of an error, a behaviour, a verdict or a diagnosis.

    Returns
    -------
    Table
        With one row; without ``code`` all codes.

    Raises
    ------
    InputError
        For an unknown code.

    Examples
    --------
    >>> import clackers
    >>> clackers.explain("time-outside")["kind"][0]
    'refusal'
    """
    return Table(*_core.explain(code))
