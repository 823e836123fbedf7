"""Numbers as they stand beside a scale."""


def tick_text(number: float) -> str:
    """A round number in few letters: no more digits than it has, powers of ten where there would be many zeros."""
    return "0" if number == 0.0 else f"{number:.4g}"
