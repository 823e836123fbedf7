# SPDX-License-Identifier: GPL-3.0-or-later
"""What elements are, by what a file says of them."""

import pytest

from bridge_demolition_addon.errors import IfcError
from bridge_demolition_addon.ifc.kinds import ElementFacts, LeftOut, kind_of
from bridge_demolition_addon.ifc.settings import ImportSettings


def facts(kind, words="", predefined="", part="", classes=()):
    parts = (part,) if part else ()
    return ElementFacts(
        name=words or kind, global_id="0", classes=(kind, *classes), predefined=predefined, words=words, parts=parts
    )


@pytest.mark.parametrize(
    "said, kind",
    [
        (facts("IfcBeam"), "girder"),
        (facts("IfcBeam", predefined="PIERCAP"), "pier cap"),
        (facts("IfcBeam", "Cap beam 2"), "pier cap"),
        (facts("IfcBeam", "B12", part="PIER Pier 2"), "pier cap"),
        (facts("IfcBeam", "Girder over pier 2", part="SUPERSTRUCTURE "), "girder"),
        (facts("IfcSlab"), "deck"),
        (facts("IfcSlab", "Deck over pier 2", part="DECK "), "deck"),
        (facts("IfcSlab", predefined="BASESLAB"), "footing"),
        (facts("IfcSlab", part="FOUNDATION "), "footing"),
        (facts("IfcSlab", "Pile cap"), "footing"),
        (facts("IfcColumn", part="ABUTMENT "), "pier"),
        (facts("IfcWall", part="ABUTMENT "), "abutment"),
        (facts("IfcWall", "Wing wall"), "abutment"),
        (facts("IfcWall", part="PIER_SEGMENT "), "pier"),
        (facts("IfcWall"), "wall"),
        (facts("IfcPlate", part="SUPERSTRUCTURE "), "girder"),
        (facts("IfcMember", "Cross frame"), "bracing"),
        (facts("IfcFooting", "Pier foundation"), "footing"),
        (facts("IfcBearing"), "bearing"),
        (facts("IfcBuildingElementProxy", "Pot bearing B1"), "bearing"),
        (facts("IfcBuildingElementProxy", "Main_Girder:1"), "girder"),
        (facts("IfcBuildingElementProxy", "Object 7", part=" Abutment north"), "abutment"),
    ],
    ids=lambda value: "" if isinstance(value, str) else f"{value.classes[0]} {value.words}",
)
def test_kinds(said, kind):
    assert kind_of(said) == kind


@pytest.mark.parametrize(
    "said, why",
    [
        (facts("IfcTendon", classes=("IfcReinforcingElement",)), "strength of reinforced concrete"),
        (facts("IfcReinforcingBar", classes=("IfcReinforcingElement",)), "strength of reinforced concrete"),
        (facts("IfcRailing"), "carries nothing"),
        (facts("IfcPile"), "in the ground"),
        (facts("IfcPavement"), "surfacing"),
        (facts("IfcMember", predefined="STAY_CABLE"), "cables"),
        (facts("IfcBuildingElementProxy", "Handrail"), "carries nothing"),
        (facts("IfcBuildingElementProxy", "Object 7"), "--kind"),
    ],
    ids=lambda value: "" if isinstance(value, str) else f"{value.classes[0]} {value.words}",
)
def test_what_is_left_out_says_why(said, why):
    found = kind_of(said)
    assert isinstance(found, LeftOut)
    assert why in found.why


def test_the_user_says_what_an_element_is():
    said = facts("IfcBuildingElementProxy", "Überbau 3")
    assert kind_of(said, [("überbau*", "deck")]) == "deck"
    assert kind_of(facts("IfcPile", "P1"), [("IfcPile", "pier")]) == "pier"


def test_a_kind_that_there_is_not():
    with pytest.raises(IfcError, match='kind of "X" is "dock": expected one of deck, girder'):
        ImportSettings(kinds=(("X", "dock"),))
