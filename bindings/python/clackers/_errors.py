"""The exceptions of the library."""
from __future__ import annotations

from typing import TYPE_CHECKING

from clackers._words import in_python

if TYPE_CHECKING:
    from clackers._record import Record


class Error(RuntimeError):
    """Everything that the library raises on purpose.

    ``str(error)`` is the sentence for a person; ``error.code`` is the stable name for a program, which
    ``clackers explain CODE`` describes.
    """

    code: str

    def __init__(self, message: str, code: str = "") -> None:
        super().__init__(in_python(message))
        self.code = code


class InputError(Error, ValueError):
    """Refused input: nothing was done. The message says what was given, what is allowed and what to do.

    >>> import clackers
    >>> try:
    ...     clackers.case("three-parameter", xi1=1.5)
    ... except ValueError as error:
    ...     print(error.code)
    out-of-range
    """


class FileError(Error, OSError):
    """A file, the disk or an external program failed."""


class SolverError(Error, ValueError):
    """Every run of a solver failed. The first exception that it raised is the ``__cause__``."""

    record: Record
    """Of all subjects."""

    def __init__(self, message: str, code: str, record: Record) -> None:
        super().__init__(message, code)
        self.record = record


class Interrupted(KeyboardInterrupt):
    """Ctrl-C ended a study; ``record`` has the rows that were finished, None where there are none."""

    record: Record | None

    def __init__(self, record: Record | None) -> None:
        super().__init__("interrupted; " + ("nothing was finished" if record is None else "see .record"))
        self.record = record
