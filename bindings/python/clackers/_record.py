"""What a study found: verdicts, diagnoses, tables and figures."""
from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from clackers import _core
from clackers._errors import InputError
from clackers._table import Table
from clackers._words import html_in_python, in_python

if TYPE_CHECKING:
    import pandas  # type: ignore[import]

WIDTH = 80
"""Characters a line of the text of a record."""

_FORMATS = {".json": "json", ".csv": "csv", ".xml": "junit", ".tex": "latex", ".txt": "table"}


@dataclass(frozen=True)
class Diagnosis:
    """A cause of what the runs show.

    Attributes
    ----------
    code : str
        The name in ``clackers.catalogue("diagnoses")``, for example ``restitution-differs``.
    value : float
        The parameter of the cause, in ``unit``; NaN where the cause has none.
    unit : str
        Empty when dimensionless.
    confidence : float
        From 0 to 1.
    evidence : dict of float
        The numbers that it rests on, by name: gain, uncertainty, expected, ...
    text : str
        The same in a sentence, with what to check.
    """

    code: str
    value: float
    unit: str
    confidence: float
    evidence: dict[str, float]
    text: str

    @property
    def gain(self) -> float | None:
        """How much closer the history is to the motion under this cause than to the exact one."""
        return self.evidence.get("gain")

    def __str__(self) -> str:
        return f"{self.text} [{self.code}]"


@dataclass(frozen=True)
class Subject:
    """What was assessed on one case: a method, a callable, a program, or a set of histories.

    Attributes
    ----------
    name : str
        As in every table.
    kind : str
        ``method``, ``callable``, ``program`` or ``histories``.
    case : str
        The name of the case.
    verdict : str
        ``agrees``, ``disagrees``, ``not claimed``, ``undecided``, ``refused`` or ``interrupted``.
    behaviour : str
        ``exact``, ``proper``, ``reduced``, ``irregular``, ``stagnating``, ``divergent`` or ``undecided``.
    order : float or None
        The measured order of the error in u, None where the errors lie on no line.
    uncertainty : float or None
        Half width of the 95 % interval of ``order``.
    claim : str or None
        What is claimed or expected, None for nothing.
    reason : str
        The code of what decided, empty where none is needed.
    findings : tuple of str
        Sentences: causes, the finding, failures of runs, and notes on the histories.
    diagnoses : tuple of Diagnosis
        Causes, strongest first.
    """

    name: str
    kind: str
    case: str
    verdict: str
    behaviour: str
    order: float | None
    uncertainty: float | None
    claim: str | None
    reason: str
    findings: tuple[str, ...]
    diagnoses: tuple[Diagnosis, ...]
    _core: _core.Record = field(repr=False, compare=False)
    _place: tuple[int, int] = field(repr=False, compare=False)

    @property
    def levels(self) -> Table:
        """The levels, coarsest first: the worst of the runs of each."""
        return Table(*self._core.levels(*self._place))

    @property
    def runs(self) -> Table:
        """Every run, with all columns and metrics."""
        return Table(*self._core.subject_runs(*self._place))


class Figure:
    """A figure as a Vega-Lite specification, which notebooks draw.

    >>> import clackers
    >>> figure = clackers.verify("rk4", levels=3, samples_per_level=2).figure("convergence")
    >>> figure.spec["$schema"]
    'https://vega.github.io/schema/vega-lite/v5.json'
    """

    name: str
    spec: dict[str, Any]
    """Vega-Lite, version 5, with its data inside."""

    def __init__(self, name: str, spec: dict[str, Any]) -> None:
        self.name = name
        self.spec = spec

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the specification as json.

        Parameters
        ----------
        path : path
            For example ``convergence.vl.json``.

        Raises
        ------
        OSError
            Where the file cannot be written.

        Examples
        --------
        >>> import clackers, os
        >>> clackers.verify("rk4", levels=3, samples_per_level=2).figure("convergence").save(os.devnull)
        """
        with open(path, "w", encoding="utf-8") as file:
            json.dump(self.spec, file, ensure_ascii=False)

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> dict[str, Any]:
        return {"application/vnd.vegalite.v5+json": self.spec, "text/plain": repr(self)}

    def __repr__(self) -> str:
        return f"<clackers.Figure {self.name}>"


class Record:
    """The result of ``clackers.verify`` and ``clackers.check``.

    ``print(record)`` shows it as the command does; a notebook shows tables. Of a record with a single
    subject ``verdict``, ``behaviour``, ``order`` and so on are those of the subject; otherwise
    ``record["rk4"]`` is one of its subjects, ``record["stop", "rk4"]`` one of several cases.

    >>> import clackers
    >>> record = clackers.verify("rk4", "newmark", levels=3, samples_per_level=2)
    >>> list(record)
    ['rk4', 'newmark']
    >>> record["rk4"].kind
    'method'
    """

    def __init__(self, core: _core.Record) -> None:
        self._core = core
        self._cases = core.cases
        self._subjects: tuple[Subject, ...] | None = None

    @classmethod
    def from_json(cls, text: str) -> Record:
        """A record from its text.

        Parameters
        ----------
        text : str
            What ``to_json`` or ``clackers verify --format json`` wrote.

        Returns
        -------
        Record

        Raises
        ------
        InputError
            ``not-a-record`` for other text.

        Examples
        --------
        >>> import clackers
        >>> record = clackers.verify("rk4", levels=2, samples_per_level=1)
        >>> clackers.Record.from_json(record.to_json()).verdict == record.verdict
        True
        """
        return cls(_core.Record.from_json(_core.read_text("Record.from_json", "text", text)))

    # Over all.

    @property
    def command(self) -> str:
        """``verify`` or ``check``."""
        return self._core.command

    @property
    def verdict(self) -> str:
        """``agrees``, ``disagrees``, ``undecided``, ``not claimed`` or ``interrupted``, over all subjects."""
        return self._core.verdict

    @property
    def interrupted(self) -> bool:
        """Whether only what was finished before Ctrl-C is there."""
        return self._core.interrupted

    @property
    def exit_code(self) -> int:
        """That of the command: 0 agrees or nothing claimed, 1 disagrees, 3 undecided, 130 interrupted."""
        return self._core.exit_code

    @property
    def provenance(self) -> dict[str, str]:
        """What was run, where and by what: command, version, compiler, machine, processor, date."""
        return self._core.provenance

    @property
    def cases(self) -> tuple[str, ...]:
        """The names of the cases."""
        return tuple(name for name, _, _ in self._cases)

    # Subjects.

    @property
    def subjects(self) -> tuple[Subject, ...]:
        """All subjects of all cases."""
        if self._subjects is None:
            self._subjects = tuple(_subject(self._core, row) for row in self._core.subjects)
        return self._subjects

    def keys(self) -> tuple[str | tuple[str, str], ...]:
        """What ``record[...]`` takes.

        Returns
        -------
        tuple
            Names, or (case, name) where there are several cases.

        Examples
        --------
        >>> import clackers
        >>> clackers.verify("rk4", case=["stop", "sdof"], levels=2, samples_per_level=1).keys()
        (('stop', 'rk4'), ('sdof', 'rk4'))
        """
        if len(self._cases) == 1:
            return tuple(subject.name for subject in self.subjects)
        return tuple((subject.case, subject.name) for subject in self.subjects)

    def __iter__(self) -> Iterator[str | tuple[str, str]]:
        return iter(self.keys())

    def __len__(self) -> int:
        return len(self.subjects)

    def __contains__(self, key: object) -> bool:
        return key in self.keys()

    def __getitem__(self, key: str | tuple[str, str]) -> Subject:
        found = [
            subject
            for subject in self.subjects
            if (subject.name == key if isinstance(key, str) else (subject.case, subject.name) == key)
        ]
        if len(found) == 1:
            return found[0]
        hint = "Several cases have it." if found else ""
        _core.refuse("record", "subject", repr(key), ", ".join(map(repr, self.keys())), hint, "unknown-name")

    @property
    def subject(self) -> Subject:
        """The only subject. Raises InputError where there are several."""
        if len(self.subjects) != 1:
            _core.refuse(
                "record", "subjects", f"{len(self.subjects)} of them", "one, to ask the record itself",
                "Ask one of them: " + ", ".join(f"record[{key!r}]" for key in self.keys()) + ".", "wrong-size",
            )
        return self.subjects[0]

    @property
    def behaviour(self) -> str:
        """That of the only subject."""
        return self.subject.behaviour

    @property
    def order(self) -> float | None:
        """That of the only subject."""
        return self.subject.order

    @property
    def uncertainty(self) -> float | None:
        """That of the only subject."""
        return self.subject.uncertainty

    @property
    def claim(self) -> str | None:
        """That of the only subject."""
        return self.subject.claim

    @property
    def reason(self) -> str:
        """That of the only subject."""
        return self.subject.reason

    @property
    def findings(self) -> tuple[str, ...]:
        """Those of the only subject."""
        return self.subject.findings

    @property
    def diagnoses(self) -> tuple[Diagnosis, ...]:
        """Those of the only subject, strongest first."""
        return self.subject.diagnoses

    @property
    def levels(self) -> Table:
        """Those of the only subject."""
        return self.subject.levels

    # Outputs.

    def table(self) -> Table:
        """All runs of all subjects.

        Returns
        -------
        Table
            A row a run; the columns are those of ``clackers.catalogue("columns")``.

        Examples
        --------
        >>> import clackers
        >>> record = clackers.verify("rk4", levels=2, samples_per_level=1)
        >>> record.table()["step"].round(2)
        array([0.05, 0.03])
        """
        return Table(*self._core.runs())

    def to_pandas(self) -> pandas.DataFrame:
        """``table()`` for pandas.

        Returns
        -------
        pandas.DataFrame
            A row a run; as ``Table.to_pandas`` makes it.

        Raises
        ------
        ImportError
            Where pandas is not installed.

        Examples
        --------
        >>> import clackers
        >>> clackers.verify("rk4", levels=2, samples_per_level=1).to_pandas()["impacts_matched"].tolist()
        [6, 6]
        """
        return self.table().to_pandas()

    def to_json(self) -> str:
        """The record as text, for ``from_json``.

        Returns
        -------
        str
            What ``clackers verify --format json`` prints; every number reads back to the same double.

        Examples
        --------
        >>> import clackers, json
        >>> json.loads(clackers.verify("rk4", levels=2, samples_per_level=1).to_json())["schema"]
        'clackers/record/1'
        """
        return self._core.to_json()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the record by the ending of ``path``.

        Parameters
        ----------
        path : path
            ``.html`` is a self-contained page with figures, ``.json`` what ``clackers.load`` reads, ``.csv`` a row
            a run, ``.xml`` JUnit, ``.tex`` LaTeX tables, ``.txt`` the text of ``print``.

        Raises
        ------
        InputError
            For another ending.
        OSError
            Where the file cannot be written.

        Examples
        --------
        >>> import clackers, pathlib, tempfile
        >>> record = clackers.verify("rk4", levels=2, samples_per_level=1)
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     record.save(pathlib.Path(folder, "record.json"))
        ...     str(clackers.load(pathlib.Path(folder, "record.json"))) == str(record)
        True
        """
        ending = os.path.splitext(os.fspath(path))[1].lower()
        if ending != ".html" and ending not in _FORMATS:
            _core.refuse("Record.save", "path", os.fspath(path), "a name in " + ", ".join([".html", *_FORMATS]))
        text = self._in_words(self._core.page(), html_in_python) if ending == ".html" else self._written(_FORMATS[ending])
        with open(path, "w", encoding="utf-8", newline="") as file:
            file.write(text)

    @property
    def figures(self) -> tuple[str, ...]:
        """The names that ``figure`` takes, of the first case."""
        return tuple(self._cases[0][2])

    def figure(self, name: str = "convergence", case: str | None = None) -> Figure:
        """A figure of the page as a Vega-Lite specification.

        Parameters
        ----------
        name : str
            ``convergence``, ``history``, ``work``, ``profile`` or ``response``; ``figures`` has those with something to draw.
        case : str, optional
            The name of one of several cases; default the first.

        Returns
        -------
        Figure

        Raises
        ------
        InputError
            For another name.

        Examples
        --------
        >>> import clackers
        >>> clackers.verify("rk4", levels=3, samples_per_level=2).figure("response", case="three-parameter")
        <clackers.Figure response>
        """
        if case is not None and case not in self.cases:
            _core.refuse("Record.figure", "case", case, ", ".join(self.cases), "", "unknown-name")
        place = 0 if case is None else self.cases.index(case)
        return Figure(name, json.loads(self._core.figure(place, _core.read_text("Record.figure", "name", name))))

    def __reduce__(self) -> tuple[Callable[[str], Record], tuple[str]]:
        return Record.from_json, (self.to_json(),)

    def __str__(self) -> str:
        return self._written("table").rstrip("\n")

    def _written(self, form: str) -> str:
        text = self._core.written(form, WIDTH)
        return self._in_words(text, in_python) if form == "table" else text

    def _in_words(self, text: str, reworded: Callable[[str], str]) -> str:
        """In words of Python, unless the command made the record: it is to be made again by the command."""
        return reworded(text) if self.provenance["command"].startswith("clackers.") else text

    def __repr__(self) -> str:
        return f"<clackers.Record {self.command} on {', '.join(self.cases)}: {self.verdict}>"

    def _repr_html_(self) -> str:
        return self._in_words(self._core.notebook(), html_in_python)

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> dict[str, str]:
        return {"text/plain": str(self), "text/html": self._repr_html_()}


def load(path: str | os.PathLike[str]) -> Record:
    """The record in a file.

    Parameters
    ----------
    path : path
        What ``Record.save`` or ``clackers verify --format json --out`` wrote.

    Returns
    -------
    Record

    Raises
    ------
    InputError
        ``not-a-record`` for another file.
    OSError
        Where it cannot be read.

    Examples
    --------
    >>> import clackers, os
    >>> try:
    ...     clackers.load(os.devnull)
    ... except ValueError as error:
    ...     print(error.code)
    not-a-record
    """
    with open(path, "rb") as file:
        text = file.read().decode("utf-8", errors="replace")
    try:
        return Record(_core.Record.from_json(text))
    except InputError as error:
        raise InputError(f"{os.fsdecode(path)}: {error}", error.code) from None


def _subject(core: _core.Record, row: dict[str, Any]) -> Subject:
    fields = dict(row)
    fields["findings"] = tuple(map(in_python, row["findings"]))
    fields["diagnoses"] = tuple(replace(Diagnosis(*cause), text=in_python(cause[-1])) for cause in row["diagnoses"])
    place = fields.pop("place")
    return Subject(**fields, _core=core, _place=place)
