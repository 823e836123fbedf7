"""Several bridges in one file: which of them is imported."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from ..errors import IfcError
from .elements import Element
from .kinds import LeftOut
from .settings import ImportSettings, matches
from .source import IfcSource

CARRYING = ("deck", "girder", "arch")
"""Kinds of members that carry the road; what has none is no bridge."""

_CLASSES = ("IfcBridge", "IfcBuilding")
"""Classes that stand for a bridge, where a file has them: a building in schemas that have no bridges."""


@dataclass(frozen=True, slots=True)
class BridgeInFile:
    """A bridge of a file: its unique name, its GlobalId and how many members it has."""

    name: str
    global_id: str
    number: int
    members: int


def bridges_in(source: IfcSource, elements: Sequence[Element]) -> list[BridgeInFile]:
    """Return the bridges of a file, the one with the most members first; none where nothing stands for a bridge."""
    for name in _CLASSES:
        try:
            wholes = source.model.by_type(name)
        except RuntimeError:  # a class that the schema does not have
            continue
        found: list[BridgeInFile] = []
        for whole in wholes:
            own = [element for element in elements if element.is_member and whole.id() in element.wholes]
            if not any(element.kind in CARRYING for element in own):
                continue
            plain = " ".join((whole.Name or "").split()) or name
            taken = [other.name for other in found]
            called = next(text for text in (plain, *(f"{plain} {n}" for n in range(2, 10_000))) if text not in taken)
            found.append(BridgeInFile(called, whole.GlobalId, whole.id(), len(own)))
        if found:
            return sorted(found, key=lambda bridge: -bridge.members)
    return []


@dataclass(frozen=True, slots=True)
class ChosenElements:
    """Elements of the chosen bridge, its name, and notes on what was left out."""

    elements: tuple[Element, ...]
    title: str = ""
    notes: tuple[str, ...] = ()


def chosen_elements(source: IfcSource, elements: Sequence[Element], settings: ImportSettings) -> ChosenElements:
    """Return the elements of the bridge that the user wants, or of the one with the most members."""
    bridges = bridges_in(source, elements)
    names = ", ".join(f"{bridge.name} ({bridge.members} members)" for bridge in bridges)
    if settings.only is not None:
        chosen = [bridge for bridge in bridges if matches(settings.only, (bridge.name, bridge.global_id))]
        if not chosen:
            known = f"it has {names}" if bridges else "nothing in it stands for a bridge"
            raise IfcError(f'{source.path}: has no bridge "{settings.only}": {known}')
        notes: tuple[str, ...] = ()
    elif len(bridges) < 2:
        return ChosenElements(tuple(elements))
    elif settings.strict:
        raise IfcError(f"{source.path}: holds {len(bridges)} bridges, {names}: say which one by --only NAME")
    else:
        chosen = bridges[:1]
        notes = (
            f"the file holds {len(bridges)} bridges, {names}: {chosen[0].name} is taken; --only NAME takes another",
        )
    kept = {bridge.number for bridge in chosen}
    others = LeftOut("it belongs to another bridge of the file: --only NAME takes that")
    left = tuple(
        replace(element, kind=others) if element.is_member and kept.isdisjoint(element.wholes) else element
        for element in elements
    )
    return ChosenElements(left, chosen[0].name, notes)
