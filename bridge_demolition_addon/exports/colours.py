"""What colour a body has in other programs."""

from __future__ import annotations

from ..model.results.inventory import Inventory

Colour = tuple[float, float, float]

_COLOURS: dict[str, Colour] = {
    "ball": (0.03, 0.03, 0.03),
    "ground": (0.35, 0.32, 0.26),
    "tool": (0.6, 0.4, 0.0),
    "crane": (0.6, 0.4, 0.0),
    "deck": (0.42, 0.42, 0.41),
    "girder": (0.28, 0.32, 0.38),
    "pier": (0.35, 0.28, 0.22),
    "pier cap": (0.30, 0.24, 0.20),
    "abutment": (0.22, 0.22, 0.22),
}
_OTHER: Colour = (0.4, 0.4, 0.4)


def coloured_by(inventory: Inventory) -> list[str]:
    """Return what each body is coloured by: the kind of its member, or its own kind where it is of none."""
    pairs = zip(inventory.body_member_kinds.tolist(), inventory.body_kinds.tolist(), strict=True)
    return [member or body for member, body in pairs]


def colour_of(kind: str) -> Colour:
    """Return red, green and blue from 0 to 1, linear."""
    return _COLOURS.get(kind, _OTHER)
