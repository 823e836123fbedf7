"""How far some work is, as the one who does it tells and the one who shows it takes in."""


class Progress:
    """Takes in how far some work is, and shows nothing of it."""

    def stage(self, text: str) -> None:
        """Take in what begins now."""

    def frame(self, done: int, total: int, broken: int, left_s: float | None) -> None:
        """Take in how many frames are done and connections broken, and how long the other frames take, if known."""

    def part(self, done: int, total: int, text: str) -> None:
        """Take in how many parts of a stage are done."""

    def finish(self) -> None:
        """Leave the terminal ready for other output."""
