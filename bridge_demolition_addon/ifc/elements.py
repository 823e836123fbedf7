"""The elements of an IFC file: which of them are members, and what each is."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from ..errors import IfcError
from .kinds import ElementFacts, LeftOut, kind_of
from .library import library
from .settings import ImportSettings, matches
from .source import IfcSource

_NO_BODIES = (
    "Axis",
    "FootPrint",
    "Box",
    "Annotation",
    "Profile",
    "Survey",
    "Lighting",
    "Reference",
    "Clearance",
    "CoG",
)
"""Representations of an element that are none of its body."""

_LISTED = 5


@dataclass(frozen=True, slots=True)
class Element:
    """An element of an IFC file.

    Attributes
    ----------
    entity : ifcopenshell.entity_instance
        The element itself.
    facts : ElementFacts
        What the file says of it.
    kind : str or LeftOut
        What it is, or why it is left out.
    """

    entity: Any
    facts: ElementFacts
    kind: str | LeftOut

    @property
    def is_member(self) -> bool:
        """Whether it has a body that is part of the bridge, a bearing included."""
        return isinstance(self.kind, str)

    @property
    def member_kind(self) -> str:
        """What a member is."""
        assert isinstance(self.kind, str)
        return self.kind

    @property
    def names(self) -> tuple[str, ...]:
        """What a user may call it by, its kind included."""
        return (*self.facts.names, self.member_kind) if self.is_member else self.facts.names

    @property
    def title(self) -> str:
        """What it is called in messages."""
        return f"{self.facts.name} ({self.facts.classes[0]} #{self.entity.id()})"


def elements_of(source: IfcSource, settings: ImportSettings) -> tuple[Element, ...]:
    """Return all elements of a file in its order, openings and the like not among them."""
    found = tuple(_elements(source.model, settings))
    for pattern in (*settings.without, *(pattern for pattern, _ in settings.kinds)):
        if not any(matches(pattern, each.names) for each in found):
            known = ", ".join(each.facts.name for each in found[:_LISTED])
            raise IfcError(
                f'{source.path}: has no element "{pattern}": expected a name, a class such as IfcBeam, a kind or a '
                f"GlobalId of one; it has {known}{' and more' if len(found) > _LISTED else ''}"
            )
    found = tuple(_without(each, settings.without) for each in found)
    if not any(each.is_member for each in found):
        classes = sorted({each.facts.classes[0] for each in found})
        seen = f"{', '.join(classes)} only" if classes else "no elements"
        raise IfcError(
            f"{source.path}: has no element that is a member of a bridge, {seen}; say what they are by --kind, as in "
            "--kind 'IfcBuildingElementProxy=deck'"
        )
    return found


def _without(element: Element, patterns: tuple[str, ...]) -> Element:
    """Return an element as left out where the user says so."""
    if element.is_member and any(matches(pattern, element.names) for pattern in patterns):
        return replace(element, kind=LeftOut("it is to be left out"))
    return element


def _elements(model: Any, settings: ImportSettings) -> Iterator[Element]:
    for entity in sorted(model.by_type("IfcElement"), key=lambda each: each.id()):
        if entity.is_a("IfcFeatureElement") or entity.is_a("IfcVirtualElement"):
            continue
        has_body = _has_body(entity)
        if not has_body and entity.IsDecomposedBy:
            continue  # its parts are elements, too
        facts = _facts_of(entity)
        kind = kind_of(facts, settings.kinds)
        if isinstance(kind, str) and not has_body:
            kind = LeftOut("it has no body")
        yield Element(entity, facts, kind)


def _has_body(entity: Any) -> bool:
    shapes = entity.Representation.Representations if entity.Representation else ()
    return any(shape.RepresentationIdentifier not in _NO_BODIES for shape in shapes)


def _facts_of(entity: Any) -> ElementFacts:
    util = library("util.element")
    kind = util.get_type(entity)
    predefined = str(util.get_predefined_type(entity) or "").upper()
    words = (entity.Name, entity.ObjectType, getattr(kind, "Name", None), predefined)
    return ElementFacts(
        name=(entity.Name or "").strip() or entity.is_a(),
        global_id=entity.GlobalId,
        classes=_classes(entity),
        predefined=predefined,
        words=" ".join(word for word in words if word),
        parts=tuple(_parts(entity)),
    )


def _classes(entity: Any) -> tuple[str, ...]:
    wrapper = library().ifcopenshell_wrapper
    declaration = wrapper.schema_by_name(entity.file.schema_identifier).declaration_by_name(entity.is_a())
    names = []
    while declaration is not None:
        names.append(declaration.name())
        declaration = declaration.supertype()
    return tuple(names)


def _parts(entity: Any) -> Iterator[str]:
    """Yield type and name of all that an element is in, the smallest first, up to the bridge."""
    util = library("util.element")
    whole = util.get_parent(entity)
    while whole is not None and not whole.is_a("IfcProject") and not whole.is_a("IfcSite"):
        yield f"{getattr(whole, 'PredefinedType', None) or ''} {whole.Name or ''}"
        whole = util.get_parent(whole)
