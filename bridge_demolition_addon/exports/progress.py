"""Whoever wants to know how far an export is."""

from typing import Protocol


class Progress(Protocol):
    """Shows how far an export is."""

    def stage(self, text: str) -> None:
        """Name what begins now."""

    def part(self, done: int, total: int, text: str) -> None:
        """Give how many parts of a stage are done."""
