"""Progress of some work, as it is reported and shown."""

from typing import Protocol


class Counts(Protocol):
    """Numbers that have a text."""

    @property
    def text(self) -> str: ...


class Progress:
    """Takes in the progress of some work, and shows nothing of it.

    Attributes
    ----------
    is_stopped
        Whether the work is to end with what there is; for what looks at it.
    """

    is_stopped = False

    def stage(self, text: str) -> None:
        """Take in the name of the stage that begins now."""

    def frame(self, done: int, total: int, connections: Counts, left_s: float | None) -> None:
        """Take in how many frames are done, what has become of connections, and how long the other frames take."""

    def part(self, done: int, total: int, text: str) -> None:
        """Take in how many parts of a stage are done."""

    def wait(self) -> None:
        """Take in that the work waits for another process, and can be stopped."""

    def finish(self) -> None:
        """Leave the terminal ready for other output."""
