"""References of an IFC file that lead to nothing: what is said by them is absent, and shapes that need them unknown.

Programs write relations without one of their ends, and files lose lines. What such a relation says, a material, a set
of properties, a type, counts as not said. A shape or position that a missing line is part of could be any other.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from .library import library

_CHECKED = (
    *("IfcRelationship", "IfcPropertyDefinition", "IfcProperty", "IfcPhysicalQuantity"),
    *("IfcMaterialDefinition", "IfcMaterialUsageDefinition", "IfcMaterialList", "IfcMaterialProperties"),
    *("IfcMaterialLayer", "IfcMaterialLayerSet", "IfcMaterialLayerSetUsage"),
    *("IfcNamedUnit", "IfcDerivedUnit", "IfcDerivedUnitElement", "IfcMeasureWithUnit", "IfcUnitAssignment"),
    *("IfcCoordinateOperation", "IfcStyledItem", "IfcPresentationLayerAssignment"),
)
"""Classes of which none is part of a shape: without what they need they are absent. In IFC2X3 materials are of four."""

_ALL_NEEDED = (
    *("IfcProperty", "IfcPhysicalQuantity"),
    *("IfcNamedUnit", "IfcDerivedUnit", "IfcDerivedUnitElement", "IfcMeasureWithUnit"),
)
"""Classes that say nothing without their names and numbers, either."""

_OF_SHAPES = (
    *("IfcRepresentationItem", "IfcObjectPlacement", "IfcRepresentation", "IfcRepresentationMap"),
    *("IfcProfileDef", "IfcProductRepresentation"),
)

_OF_PLACES = ("ObjectPlacement", "PlacementRelTo", "RelativePlacement", "Axis", "RefDirection")
"""Attributes that say where something is, or how it is turned there."""

_NOT_OF_SHAPES = ("ContextOfItems", "CfsFaces", "OwnerHistory")
"""Attributes that a shape is known without: holes where faces are missing are closed, or the body is refused."""

_LOGGED = re.compile(r"reference #(\d+) used by instance #(\d+) at attribute index (\d+) not found")


@dataclass(frozen=True, slots=True)
class MissingLine:
    """A line that is missing in a file: its number, and the statement and attribute that name it."""

    number: int
    named_by: int
    attribute: int


@dataclass(frozen=True, slots=True)
class _Reference:
    """An attribute that refers to other statements, of some classes, or a value that is needed, of none."""

    index: int
    is_needed: bool
    is_list: bool
    classes: tuple[str, ...]


def opened(text: str) -> tuple[Any, tuple[MissingLine, ...]]:
    """Return the text of a file as an `ifcopenshell.file`, and the lines that are missing in it."""
    openshell = library()
    openshell.get_log()  # which empties it
    # By its text, as a file opened by its path is not closed before the interpreter ends.
    model = openshell.file.from_string(text)
    found = dict.fromkeys(_LOGGED.findall(openshell.get_log()))
    return model, tuple(MissingLine(*map(int, numbers)) for numbers in found)


def remove_incomplete(model: Any) -> tuple[str, ...]:
    """Remove what lacks an end that its schema asks for, and return a sentence on it; none for a whole file."""
    cut: Counter[str] = Counter()
    while removed := _removed(model, cut):
        cut.update(removed)
    if not cut:
        return ()
    texts = ", ".join(f"{count} {name}" for name, count in cut.items())
    return (f"what leads to nothing, or lacks what its class needs, counts as absent: {texts}",)


def unknown_shapes(model: Any, missing: Sequence[MissingLine]) -> tuple[dict[int, str], tuple[str, ...]]:
    """Return why products have no shape or position that is known, by their numbers in the file, and a note.

    Where all that has a shape is placed in lines that are missing, these moved all of it alike: they count as absent.
    """
    of_shapes: dict[int, int] = {}
    of_places: dict[int, int] = {}
    for line in missing:
        entity = model.by_id(line.named_by)
        attribute = entity.attribute_name(line.attribute)
        if attribute in _OF_PLACES and _is_of_places(model, entity):
            of_places[line.named_by] = line.number
        elif attribute not in _NOT_OF_SHAPES:
            of_shapes[line.named_by] = line.number
    unfinished = [place for place in model.by_type("IfcLocalPlacement") if place.RelativePlacement is None]
    of_places = {place.id(): place.id() for place in unfinished} | of_places
    unplaced = _products_of(model, of_places)
    notes: tuple[str, ...] = ()
    if unplaced and {product.id() for product in model.by_type("IfcProduct") if product.Representation} <= set(
        unplaced
    ):
        for place in unfinished:
            point = model.create_entity("IfcCartesianPoint", (0.0, 0.0, 0.0))
            place.RelativePlacement = model.create_entity("IfcAxis2Placement3D", point)
        lines = ", ".join(f"#{number}" for number in dict.fromkeys(unplaced.values()))
        unplaced, notes = {}, (f"all that has a shape is placed in {lines}, which is missing, and counts as absent",)
    return {
        product: f"it needs line #{number}, which is missing or of an unknown class"
        for product, number in (unplaced | _products_of(model, of_shapes)).items()
    }, notes


def _is_of_places(model: Any, entity: Any) -> bool:
    """Return whether a statement is a product, or says where products are, and nothing of their shapes."""
    if entity.is_a("IfcPlacement"):
        return all(one.is_a("IfcObjectPlacement") for one in model.get_inverse(entity))
    return bool(entity.is_a("IfcObjectPlacement") or entity.is_a("IfcProduct"))


def _removed(model: Any, cut: Counter[str]) -> list[str]:
    """Remove incomplete statements once, with wrong members of lists, and return the classes of those removed."""
    references: dict[str, tuple[_Reference, ...]] = {}
    incomplete: dict[int, str] = {}
    for entity in _of_classes(model, _CHECKED):
        name = entity.is_a()
        if name not in references:
            references[name] = tuple(_references(model, name))
        if not all([_mended(entity, reference) for reference in references[name]]):
            incomplete[entity.id()] = name
    removed = []
    for number, name in incomplete.items():
        try:
            model.remove(model.by_id(number))
        except RuntimeError:  # a number that two lines have leads to one of them
            continue
        removed.append(name)
    return removed


def _mended(entity: Any, reference: _Reference) -> bool:
    """Return whether what a statement needs is there, once what is no reference to its classes is taken away."""
    value = entity[reference.index]
    if value is None or not reference.classes:
        return not reference.is_needed or value is not None
    if reference.is_list:
        whole = isinstance(value, tuple)
        kept = tuple(one for one in value if _is_of(one, reference.classes)) if whole else ()
        if len(kept) < len(value if whole else ()):
            entity[reference.index] = kept
        return bool(kept) or not reference.is_needed
    if _is_of(value, reference.classes):
        return True
    if not reference.is_needed:
        entity[reference.index] = None
    return not reference.is_needed


def _is_of(value: Any, classes: Sequence[str]) -> bool:
    return hasattr(value, "is_a") and any(value.is_a(name) for name in classes)


def _references(model: Any, name: str) -> Iterator[_Reference]:
    declaration = library().ifcopenshell_wrapper.schema_by_name(model.schema_identifier).declaration_by_name(name)
    entity = declaration.as_entity()
    are_all_needed = any(_is_kind_of(entity, one) for one in _ALL_NEEDED)
    for index, (attribute, is_derived) in enumerate(zip(entity.all_attributes(), entity.derived(), strict=True)):
        kind = attribute.type_of_attribute()
        of_list = kind.as_aggregation_type()
        classes, has_entities = _classes_in(of_list.type_of_element() if of_list else kind)
        if has_entities and not is_derived and attribute.name() != "OwnerHistory":
            yield _Reference(index, not attribute.optional(), of_list is not None, classes)
        elif are_all_needed and not is_derived and not attribute.optional():
            yield _Reference(index, True, False, ())


def _is_kind_of(declaration: Any, name: str) -> bool:
    while declaration is not None and declaration.name() != name:
        declaration = declaration.supertype()
    return declaration is not None


def _classes_in(kind: Any) -> tuple[tuple[str, ...], bool]:
    """Return the classes that an attribute of a type may be of, and whether any of them is a statement."""
    named = kind.as_named_type() if hasattr(kind, "as_named_type") else None
    declared = named.declared_type() if named else kind
    if not hasattr(declared, "as_select_type"):  # a plain value, or a list of lists
        return (), False
    if select := declared.as_select_type():
        parts = [_classes_in(one) for one in select.select_list()]
        return tuple(name for names, _ in parts for name in names), any(has for _, has in parts)
    return (declared.name(),), declared.as_entity() is not None


def _products_of(model: Any, missing: Mapping[int, int]) -> dict[int, int]:
    """Return the products whose shape or position statements are part of, and the line that is missing in these.

    Both go by numbers in the file.
    """
    lines, waiting = dict(missing), list(missing)
    products = {}
    while waiting:
        here = model.by_id(waiting.pop())
        number = here.id()
        if here.is_a("IfcProduct"):
            products[number] = lines[number]
        elif any(here.is_a(name) for name in _OF_SHAPES):
            for one in model.get_inverse(here):
                if one.id() not in lines:
                    lines[one.id()] = lines[number]
                    waiting.append(one.id())
    return products


def _of_classes(model: Any, names: Sequence[str]) -> Iterator[Any]:
    for name in names:
        try:
            yield from model.by_type(name)
        except RuntimeError:  # a class that the schema does not have
            continue


CONTRADICTIONS = (
    *(ArithmeticError, AssertionError, AttributeError, IndexError, KeyError),
    *(RecursionError, TypeError, ValueError),
)
"""What reading an element fails with where it lacks what its schema asks for."""


def representations_of(product: Any) -> tuple[Any, ...]:
    """Return the representations of a product."""
    found = getattr(product.Representation, "Representations", None) or ()
    return tuple(one for one in found if one.is_a("IfcRepresentation"))


def items_of(product: Any, kind: str = "IfcRepresentationItem") -> list[Any]:
    """Return the items of a class in all representations of a product."""
    return [item for one in representations_of(product) for item in one.Items or () if item.is_a(kind)]
