"""Kinds of elements: members, or elements that carry nothing, by class, type, part of the bridge and name."""

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
    name
        Its class where the file gives no name.
    classes
        Its class, and the classes above it.
    predefined
        Its predefined type, such as ``PIERCAP``; empty without one.
    words
        Its name, object type, predefined type and the name of its type.
    parts
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
        """Names that a user may give it."""
        return (self.name, self.classes[0], self.global_id)


@dataclass(frozen=True, slots=True)
class LeftOut:
    """That an element is no member, and why."""

    why: str


_CARRIES_NOTHING = "it carries nothing"

_OF_CLASS = {
    "it is counted in the strength of reinforced concrete": ("IfcReinforcingElement",),
    "it lies in the ground, which holds the footings": ("IfcPile",),
    _CARRIES_NOTHING: (
        *("IfcRailing", "IfcSign", "IfcSignal", "IfcFurnishingElement", "IfcDistributionElement"),
        *("IfcTransportElement", "IfcTransportationDevice", "IfcDoor", "IfcWindow", "IfcFastener"),
        *("IfcMechanicalFastener", "IfcDiscreteAccessory", "IfcVibrationDamper", "IfcVibrationIsolator"),
    ),
    "surfacing carries nothing; where its mass counts, raise the density of the deck": (
        "IfcCovering",
        "IfcCourse",
        "IfcPavement",
        "IfcKerb",
        "IfcRail",
        "IfcTrackElement",
    ),
    "it is part of the ground": ("IfcEarthworksElement", "IfcGeographicElement", "IfcGeotechnicalElement"),
}
"""Classes that are left out, by the reason."""

_OF_TYPE: dict[str | LeftOut, tuple[str, ...]] = {
    "pier cap": ("PIERCAP",),
    "girder": ("GIRDER_SEGMENT", "T_BEAM", "DIAPHRAGM"),
    "pier": ("PIERSTEM", "PIERSTEM_SEGMENT", "STANDCOLUMN"),
    "footing": ("BASESLAB",),
    "parapet": ("PARAPET",),
    "bracing": ("BRACE", "STRUT"),
    LeftOut("it lies on the soil behind the abutment"): ("APPROACH_SLAB",),
    LeftOut("cables are not modelled"): ("STAY_CABLE", "SUSPENSION_CABLE", "SUSPENDER", "STRUCTURALCABLE"),
}
"""Predefined types, whatever the class, by their kind."""

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
"""Kinds of a class by the part of the bridge; an empty class stands for all other classes."""

_ELSEWHERE = {"IfcBeam": "girder", "IfcSlab": "deck", "IfcWall": "wall", "IfcPlate": "girder", "IfcMember": "girder"}
"""Kinds of a class in all other parts."""

_NAMED = {
    "IfcBeam": ("pier cap", "diaphragm"),
    "IfcSlab": ("footing",),
    "IfcWall": ("abutment", "pier", "parapet"),
}
"""Kinds that the name of an element decides before its part does; for all other classes any kind."""

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
"""Words in names; the first kind that matches counts."""

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
    """Return the kind of an element, or why it is left out; names and kinds of the user's own come first."""
    for pattern, own_kind in own:
        if matches(pattern, facts.names):
            return own_kind
    for why, classes in _OF_CLASS.items():
        if not set(classes).isdisjoint(facts.classes):
            return LeftOut(why)
    for kind, types in _OF_TYPE.items():
        if facts.predefined in types:
            return kind
    return _of_class(facts)


def _of_class(facts: ElementFacts) -> str | LeftOut:
    for name, kind in _ALWAYS.items():
        if name in facts.classes:
            return kind
    known = next((cls for cls in facts.classes if cls in _ELSEWHERE), "")
    by_name = _named_kind(facts.words)
    if by_name and by_name in _NAMED.get(known, _WORDS):
        return LeftOut(_CARRIES_NOTHING) if by_name == "left out" else by_name.replace("diaphragm", "girder")
    part = _part_of(facts.parts)
    return _BY_PART[known].get(part) or _ELSEWHERE.get(known) or LeftOut(_OTHER)


def _named_kind(words: str) -> str | None:
    plain = re.sub(r"[_\-.:]+", " ", words).lower()
    return next((kind for kind, pattern in _WORDS.items() if re.search(pattern, plain)), None)


def _part_of(parts: tuple[str, ...]) -> str:
    return next((kind for part in parts for kind, words in _PARTS.items() if re.search(words, part.lower())), "")
