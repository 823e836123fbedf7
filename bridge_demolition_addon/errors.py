"""Errors that the user can mend, one family under one base."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager


class DemolitionError(Exception):
    """Base class of this project's errors; its text is a sentence a user can act on."""


class ScenarioError(DemolitionError):
    """A scenario names an unknown key, lacks a needed one or holds a value that cannot be used.

    One error may hold several faults, each a sentence by itself.
    """

    def __init__(self, *faults: str) -> None:
        super().__init__(*faults)
        self.faults = faults

    def __str__(self) -> str:
        return "; ".join(self.faults)

    def within(self, where: str) -> ScenarioError:
        """Return the error with a file's or a table's name before each of its faults."""
        return ScenarioError(*(f"{where}: {fault}" for fault in self.faults))


class Faults:
    """The faults of parts that are checked one after the other, so that the user hears them together."""

    def __init__(self) -> None:
        self.found: list[str] = []

    @contextmanager
    def noted(self) -> Iterator[None]:
        """Note the faults of what is checked within, and go on after it."""
        try:
            yield
        except ScenarioError as error:
            self.found += error.faults

    def check(self) -> None:
        """Raise one error with all faults that were found, if there are any."""
        if self.found:
            raise ScenarioError(*self.found)


class GeometryError(DemolitionError):
    """A solid is not closed, has no volume or cannot be cut as asked."""


class UnreadableError(DemolitionError):
    """A file of the user is no file, is too large or cannot be read; the text is the reason, without the path."""


class OutputError(DemolitionError):
    """The folder for the results exists already or cannot be written."""


class ClusterError(DemolitionError):
    """The cluster that a study is to run on is not there."""


class IfcError(DemolitionError):
    """An IFC file cannot be read, or says too little to make a scenario of it."""


class MissingLibraryError(DemolitionError):
    """A library that is no part of the installation is needed for this; the text says how to install it."""


class CoreError(DemolitionError):
    """The compiled core is missing, or another than is needed; the text says so behind its name, and what to do."""

    def __str__(self) -> str:
        return f"The compiled core {self.args[0]}"

    def needed_by(self, subject: str) -> str:
        """Return the sentence that a subject needs it, with its verb."""
        return f"{subject} the compiled core, which {self.args[0]}"


class NotFiniteError(DemolitionError):
    """A quantity of a body or a connection is endless or no number; the text names both.

    Attributes
    ----------
    quantity : str
        What it is.
    of_connection : bool
        Whether it is of a connection, and not of a body.
    row : int
        Which body or connection.
    """

    def __init__(self, quantity: str, row: int, *, of_connection: bool = False) -> None:
        super().__init__(quantity, row)
        self.quantity, self.row, self.of_connection = quantity, row, of_connection

    def __str__(self) -> str:
        return f"the {self.quantity} of {'connection' if self.of_connection else 'body'} {self.row} is no finite number"

    def named(self, bodies: Sequence[str], connections: Sequence[str], time_s: float) -> SimulationError:
        """Return the error with the name of the body or connection, in a sub-step after a time."""
        kind, names = ("connection", connections) if self.of_connection else ("body", bodies)
        of = f"{kind} {names[self.row]!r}" if self.row < len(names) else "a bar that stands bare"
        return SimulationError(
            f"the {self.quantity} of {of} is no finite number in the sub-step after {time_s:.4f} s: look for what "
            "pushes or holds it by an absurd amount"
        )


class LayoutError(DemolitionError):
    """Blender's memory does not look as expected; nothing in it was used or changed."""


class SimulationError(DemolitionError):
    """The simulation could not be set up or was changed from outside while it ran."""


class BlastError(DemolitionError):
    """A charge, a stand-off or a wanted load is not a number that a blast can have."""


class ContourError(DemolitionError):
    """Contours cannot be shown: of a range without an extent, or of results of another scene."""


def text_of(error: Exception) -> str:
    """Return the text of an error: of the system's, which file and why, without its number."""
    if isinstance(error, FileNotFoundError) and "temporary directory" in str(error):  # of tempfile
        return "no folder for temporary files can be written to: set TMPDIR to one that can"
    if isinstance(error, OSError) and error.filename is not None and error.strerror:
        return f"{error.filename}: {error.strerror}"
    return str(error)
