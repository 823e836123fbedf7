"""Errors that the user can mend, one family under one base."""


class DemolitionError(Exception):
    """Base of all errors of this project; its text is a sentence a user can act on."""


class ScenarioError(DemolitionError):
    """A scenario names an unknown key, lacks a needed one or holds a value that cannot be used."""


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
    if isinstance(error, OSError) and error.filename is not None and error.strerror:
        return f"{error.filename}: {error.strerror}"
    return str(error)
