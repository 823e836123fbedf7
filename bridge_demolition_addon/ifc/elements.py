"""The elements of an IFC file: which are members, and their kinds."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import chain, count
from typing import Any
from unicodedata import category

from ..errors import IfcError
from ..model.scenario.joint_settings import GROUND_NAME
from ..model.schema import LINE_BREAKING_CATEGORIES
from .kinds import OTHER, ElementFacts, LeftOut, is_french, kind_of
from .library import library
from .missing_references import representations_of
from .quantities import PropertySets, words_of
from .settings import KINDS, ImportSettings, matches
from .source import IfcSource

NO_BODIES = (
    *("Axis", "FootPrint", "Box", "Annotation", "Profile", "Survey", "Lighting", "Reference", "Clearance", "CoG"),
)
"""Representations of an element that do not show its body."""

_CLASS = re.compile(r"Ifc([A-Z]\w+)")
_LISTED = 5
_PART = re.compile(r"( part)? \d+( \(\d+\))?$")
"""What ends the name of a part of an element that is a member or bar of its own."""

_DEEPEST = 100
"""Parts within parts of a bridge; what is deeper is in itself."""


@dataclass(frozen=True, slots=True)
class Element:
    """An element of an IFC file, an `ifcopenshell.entity_instance`, with its kind or why it is left out.

    `wholes` are the numbers in the file of the wholes around it, the smallest first.
    """

    entity: Any
    facts: ElementFacts
    kind: str | LeftOut
    psets: PropertySets = field(default_factory=dict)
    wholes: tuple[int, ...] = ()

    @property
    def is_member(self) -> bool:
        """Whether it has a body that is part of the bridge, a bearing included."""
        return isinstance(self.kind, str)

    @property
    def member_kind(self) -> str:
        """Kind of a member."""
        assert isinstance(self.kind, str)
        return self.kind

    @property
    def why_left_out(self) -> str:
        """Why it is left out; empty for a member."""
        return self.kind.why if isinstance(self.kind, LeftOut) else ""

    @property
    def names(self) -> tuple[str, ...]:
        """Names that a user may give it, its kind included."""
        return (*self.facts.names, self.member_kind) if self.is_member else self.facts.names

    @property
    def title(self) -> str:
        """Its name in messages."""
        return self.facts.title


def elements_of(source: IfcSource, settings: ImportSettings) -> tuple[Element, ...]:
    """Return all elements of a file in its order, without openings and virtual elements."""
    elements = _named(tuple(_elements(source.model, settings)))
    named = (pattern for pattern, _ in (*settings.kinds, *settings.materials_of))
    without = [_of_whole(pattern, elements) for pattern in settings.without]
    for pattern in (*without, *named):
        if not any(matches(pattern, element.names) for element in elements):
            known = ", ".join(element.facts.name for element in elements[:_LISTED])
            raise IfcError(
                f'{source.path}: has no element "{pattern}": expected a name, a class such as IfcBeam, a kind or a '
                f"GlobalId of one; it has {known}{' and more' if len(elements) > _LISTED else ''}"
            )
    elements = tuple(_without(element, without) for element in elements)
    is_known = settings.strict or not any(element.kind == LeftOut(OTHER) for element in elements)
    if is_known and not any(element.is_member for element in elements):
        classes = sorted({element.facts.classes[0] for element in elements})
        present = f"{', '.join(classes)} only" if classes else "no elements"
        raise IfcError(
            f"{source.path}: has no element that is a member of a bridge, {present}; say what they are by --kind, as "
            "in --kind 'IfcBuildingElementProxy=deck'"
        )
    return elements


def _named(elements: Sequence[Element]) -> tuple[Element, ...]:
    """Return elements with different names for those that are or may become members, none of a kind or the ground."""
    taken, named = {*KINDS, GROUND_NAME}, []
    for element in elements:
        if element.kind == "bearing" or not (element.is_member or element.kind == LeftOut(OTHER)):
            named.append(element)
            continue
        plain = plain_text(element.facts.name) or "element"
        choices = chain([plain], (f"{plain} {number}" for number in count(2)))
        name = next(choice for choice in choices if choice not in taken)
        taken.add(name)
        named.append(replace(element, facts=replace(element.facts, member_name=name)))
    return tuple(named)


def _of_whole(pattern: str, elements: Sequence[Element]) -> str:
    """Return a pattern, or the name of the element if it names a part that is a member or bar of its own."""
    is_known = any(matches(pattern, element.names) for element in elements)
    return pattern if is_known else _PART.sub("", pattern)


def plain_text(text: str) -> str:
    """Return a text on one line."""
    return " ".join("".join(" " if category(sign) in LINE_BREAKING_CATEGORIES else sign for sign in text).split())


def _without(element: Element, patterns: Sequence[str]) -> Element:
    """Return an element as left out where the user says so."""
    if element.is_member and any(matches(pattern, element.names) for pattern in patterns):
        return replace(element, kind=LeftOut("it is to be left out"))
    return element


def _elements(model: Any, settings: ImportSettings) -> Iterator[Element]:
    read = [
        _read(entity)
        for entity in sorted(model.by_type("IfcElement"), key=lambda entity: entity.id())
        if not (entity.is_a("IfcFeatureElement") or entity.is_a("IfcVirtualElement"))
    ]
    french = is_french([element.facts.words for element in read])
    for element in read:
        has_body = _has_body(element.entity)
        if not has_body and element.entity.IsDecomposedBy:
            continue  # its parts are elements, too
        kind = kind_of(element.facts, settings.kinds, is_french=french)
        if isinstance(kind, str) and not has_body:
            kind = LeftOut("it has no body")
        yield replace(element, kind=kind)


def _has_body(entity: Any) -> bool:
    return any(shape.RepresentationIdentifier not in NO_BODIES for shape in representations_of(entity))


def _read(entity: Any) -> Element:
    """Return an element whose kind is not known yet."""
    util = library("util.element")
    kind = util.get_type(entity)
    predefined = str(util.get_predefined_type(entity) or "").upper()
    words = (entity.Name, entity.ObjectType, getattr(kind, "Name", None), predefined, _named_class(entity))
    wholes = list(_wholes(entity))
    psets = {name or "": values for name, values in util.get_psets(entity).items()}  # some are without a name
    facts = ElementFacts(
        name=(entity.Name or "").strip() or entity.is_a(),
        global_id=entity.GlobalId,
        classes=_classes(entity),
        predefined=predefined,
        words=" ".join(word for word in words if word),
        properties=words_of(psets),
        number=entity.id(),
        parts=tuple(
            f"{getattr(whole, 'PredefinedType', None) or ''} {whole.Name or ''}"
            for whole in wholes
            if not whole.is_a("IfcSite")
        ),
    )
    return Element(entity, facts, LeftOut(""), psets, tuple(whole.id() for whole in wholes))


def _named_class(entity: Any) -> str:
    """Return the class that a proxy is by its description, as words; schemas before IFC4X2 have no bearings."""
    found = _CLASS.fullmatch(entity.Description or "")
    return (
        re.sub(r"(?<=[a-z])(?=[A-Z])", " ", found.group(1)) if found and entity.is_a("IfcBuildingElementProxy") else ""
    )


def _classes(entity: Any) -> tuple[str, ...]:
    wrapper = library().ifcopenshell_wrapper
    declaration = wrapper.schema_by_name(entity.file.schema_identifier).declaration_by_name(entity.is_a())
    names = []
    while declaration is not None:
        names.append(declaration.name())
        declaration = declaration.supertype()
    return tuple(names)


def _wholes(entity: Any) -> Iterator[Any]:
    """Yield all that an element is in, the smallest first, up to the bridge and its site."""
    util = library("util.element")
    whole = util.get_parent(entity)
    for _ in range(_DEEPEST):
        if whole is None or whole.is_a("IfcProject"):
            return
        yield whole
        whole = util.get_parent(whole)
