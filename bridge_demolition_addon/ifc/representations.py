"""What products of a file are drawn by; nothing where the file has lost it."""

from __future__ import annotations

from typing import Any

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
