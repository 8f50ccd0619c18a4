"""The exceptions of the library."""
from __future__ import annotations


class Error(RuntimeError):
    """Everything that the library raises on purpose.

    ``str(error)`` is the sentence for a person; ``error.code`` is the stable name for a program, which
    ``clackers explain CODE`` tells more of.
    """

    code: str

    def __init__(self, message: str, code: str = "") -> None:
        super().__init__(message)
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
