"""What an element of a bridge is: a kind of member, or nothing that bears, by its class, type, part and name."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from .settings import matches


@dataclass(frozen=True, slots=True, kw_only=True)
class ElementFacts:
    """What an IFC file says of an element.

    Attributes
    ----------
    name, global_id : str
        As in the file; the name is the class where there is none.
    classes : tuple of str
        Its class, and those that this is one of.
    predefined : str
        Its predefined type, such as ``PIERCAP``; empty without one.
    words : str
        What else it is called: its name, object type and that of its type.
    parts : tuple of str
        Parts of the bridge that it is in, the smallest first, each as its predefined type and its name.
    """

    name: str
    global_id: str
    classes: tuple[str, ...]
    predefined: str = ""
    words: str = ""
    parts: tuple[str, ...] = ()

    @property
    def names(self) -> tuple[str, ...]:
        """Return what a user may call it by."""
        return (self.name, self.classes[0], self.global_id)


@dataclass(frozen=True, slots=True)
class LeftOut:
    """That an element is no member, and why."""

    why: str


_IN_STRENGTH = "it is counted in the strength of reinforced concrete"
_BEARS_NOTHING = "it bears nothing"
_GROUND = "it is part of the ground"
_SURFACING = "surfacing bears nothing; where its mass counts, raise the density of the deck"
_CABLE = "cables are not modelled"

_OF_CLASS = {
    "IfcReinforcingElement": _IN_STRENGTH,
    "IfcPile": "it lies in the ground, which holds the footings",
    "IfcRailing": _BEARS_NOTHING,
    "IfcSign": _BEARS_NOTHING,
    "IfcSignal": _BEARS_NOTHING,
    "IfcFurnishingElement": _BEARS_NOTHING,
    "IfcDistributionElement": _BEARS_NOTHING,
    "IfcTransportElement": _BEARS_NOTHING,
    "IfcTransportationDevice": _BEARS_NOTHING,
    "IfcDoor": _BEARS_NOTHING,
    "IfcWindow": _BEARS_NOTHING,
    "IfcFastener": _BEARS_NOTHING,
    "IfcMechanicalFastener": _BEARS_NOTHING,
    "IfcDiscreteAccessory": _BEARS_NOTHING,
    "IfcVibrationDamper": _BEARS_NOTHING,
    "IfcVibrationIsolator": _BEARS_NOTHING,
    "IfcCovering": _SURFACING,
    "IfcCourse": _SURFACING,
    "IfcPavement": _SURFACING,
    "IfcKerb": _SURFACING,
    "IfcRail": _SURFACING,
    "IfcTrackElement": _SURFACING,
    "IfcEarthworksElement": _GROUND,
    "IfcGeographicElement": _GROUND,
    "IfcGeotechnicalElement": _GROUND,
}
"""Why elements of a class are left out."""

_OF_TYPE: dict[str, str | LeftOut] = {
    "PIERCAP": "pier cap",
    "GIRDER_SEGMENT": "girder",
    "T_BEAM": "girder",
    "DIAPHRAGM": "girder",
    "PIERSTEM": "pier",
    "PIERSTEM_SEGMENT": "pier",
    "STANDCOLUMN": "pier",
    "BASESLAB": "footing",
    "PARAPET": "parapet",
    "BRACE": "bracing",
    "STRUT": "bracing",
    "APPROACH_SLAB": LeftOut("it lies on the soil behind the abutment"),
    "STAY_CABLE": LeftOut(_CABLE),
    "SUSPENSION_CABLE": LeftOut(_CABLE),
    "SUSPENDER": LeftOut(_CABLE),
    "STRUCTURALCABLE": LeftOut(_CABLE),
}
"""Kinds by the predefined type, whatever the class."""

_ALWAYS = {"IfcBearing": "bearing", "IfcFooting": "footing", "IfcCaissonFoundation": "footing", "IfcColumn": "pier"}
"""Kinds of classes that leave no doubt."""

_BY_PART = {
    "IfcBeam": {"pier": "pier cap", "abutment": "pier cap", "substructure": "pier cap"},
    "IfcSlab": {"pier": "pier cap", "abutment": "abutment", "foundation": "footing"},
    "IfcWall": {"pier": "pier", "abutment": "abutment", "foundation": "footing", "deck": "parapet"},
    "IfcPlate": {"pier": "pier", "abutment": "abutment"},
    "IfcMember": {"pier": "pier", "abutment": "abutment"},
    "": {"pier": "pier", "abutment": "abutment", "foundation": "footing", "deck": "deck", "superstructure": "deck"},
}
"""Kinds of a class by the part of the bridge; those under no name hold for all other classes."""

_ELSEWHERE = {"IfcBeam": "girder", "IfcSlab": "deck", "IfcWall": "wall", "IfcPlate": "girder", "IfcMember": "girder"}
"""Kinds of a class in all other parts."""

_NAMED = {
    "IfcBeam": ("pier cap", "diaphragm"),
    "IfcSlab": ("footing",),
    "IfcWall": ("abutment", "pier", "parapet"),
}
"""Kinds that the name of an element of a class says, before its part is asked; of all other classes any."""

_WORDS = {
    "left out": r"railing|guard ?rail|hand ?rail|tendon|rebar|reinforc|drain|lamp|\blight|\bsign\b|cable",
    "bearing": r"bearing",
    "pier cap": r"(pier|bent) ?cap|cap ?beam|cross ?head|hammer ?head|head ?stock",
    "footing": r"footing|foundation|pile ?cap|base ?slab",
    "abutment": r"abutment|wing ?wall|back ?wall",
    "parapet": r"parapet",
    "pier": r"\bpier|column|pylon|\bbent\b",
    "bracing": r"bracing|\bbrace|cross ?frame",
    "diaphragm": r"diaphragm",
    "girder": r"girder|\bbeam|stringer",
    "deck": r"\bdeck|\bslab|superstructure",
}
"""Words in names, in the order in which they are looked for."""

_PARTS = {
    "pier": r"\bpiers?\b|pier_segment|pylon|\bbents?\b",
    "abutment": r"abutment",
    "foundation": r"foundation|footing",
    "deck": r"\bdeck|surfacestructure",
    "superstructure": r"superstructure",
    "substructure": r"substructure",
}
"""Words in the names and types of parts of a bridge."""

_OTHER = "neither its class nor its name says what it is: give its kind by --kind, as in --kind 'NAME=deck'"


def kind_of(facts: ElementFacts, own: Sequence[tuple[str, str]] = ()) -> str | LeftOut:
    """Return the kind of an element, or why it is left out.

    Parameters
    ----------
    facts : ElementFacts
        What the file says of it.
    own : sequence of (str, str)
        Names of elements and their kinds, as the user gives them.
    """
    for pattern, kind in own:
        if matches(pattern, facts.names):
            return kind
    for name, why in _OF_CLASS.items():
        if name in facts.classes:
            return LeftOut(why)
    return _OF_TYPE.get(facts.predefined) or _of_class(facts)


def _of_class(facts: ElementFacts) -> str | LeftOut:
    for name, kind in _ALWAYS.items():
        if name in facts.classes:
            return kind
    known = next((cls for cls in facts.classes if cls in _ELSEWHERE), "")
    by_name = _named_kind(facts.words)
    if by_name and by_name in _NAMED.get(known, _WORDS):
        return LeftOut(_BEARS_NOTHING) if by_name == "left out" else by_name.replace("diaphragm", "girder")
    part = _part_of(facts.parts)
    return _BY_PART[known].get(part) or _ELSEWHERE.get(known) or LeftOut(_OTHER)


def _named_kind(words: str) -> str | None:
    plain = re.sub(r"[_\-.:]+", " ", words).lower()
    return next((kind for kind, pattern in _WORDS.items() if re.search(pattern, plain)), None)


def _part_of(parts: tuple[str, ...]) -> str:
    for each in parts:
        for part, pattern in _PARTS.items():
            if re.search(pattern, each.lower()):
                return part
    return ""
