# SPDX-License-Identifier: GPL-3.0-or-later
"""What elements are, by what a file says of them."""

import pytest

from bridge_demolition_addon.engineering.geometry.solids import box
from bridge_demolition_addon.errors import IfcError
from bridge_demolition_addon.ifc.kinds import ElementFacts, LeftOut, is_french, kind_of
from bridge_demolition_addon.ifc.kinds_by_shape import kinds_below, kinds_of_shapes
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
        (facts("IfcWall", "Wing wall"), "wing wall"),
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
        (facts("IfcSlab", "Floor:Asphalt 80mm:1234"), "surfacing"),
        (facts("IfcBuildingElementProxy", "Fahrbahnbelag"), "surfacing"),
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


def test_a_wall_without_a_name_is_no_girder_however_high_it_ends():
    """Two abutments of 8 m × 1 m × 4 m on footings of 1 m, a deck over them, and a girder of 18 m × 0.5 m × 1 m."""
    sizes = [
        ((3.0, 8.0, 1.0), (0.0, 0.0, 0.5), "footing"),
        ((1.0, 8.0, 4.0), (0.0, 0.0, 3.0), "wall"),
        ((1.0, 8.0, 4.0), (18.0, 0.0, 4.0), "wall"),
        ((18.0, 0.5, 1.0), (9.0, 0.0, 4.5), "girder"),
        ((19.0, 8.0, 0.9), (9.0, 0.0, 5.45), "deck"),
    ]
    shapes = {number: box(size, middle) for number, (size, middle, _) in enumerate(sizes)}
    assert list(kinds_of_shapes(shapes).values()) == [kind for _, _, kind in sizes]


def test_what_lies_below_a_deck_is_known_by_its_shape():
    """A deck of 20 m × 8 m at 5 m; girders right below it, a pipe that hangs from it, and a light on it."""
    deck = box((20.0, 8.0, 0.3), (10.0, 0.0, 5.15))
    bodies = [
        ((20.0, 0.5, 1.0), (10.0, -2.0, 4.5), "girder"),
        ((20.0, 0.5, 1.0), (10.0, 2.0, 4.45), "girder"),
        ((20.0, 0.2, 0.2), (10.0, 0.0, 4.8), None),
        ((20.0, 0.6, 0.6), (10.0, 6.0, 4.7), None),  # beside it
        ((0.2, 0.2, 4.0), (10.0, 3.0, 7.3), None),  # on it
        ((2.0, 6.0, 0.8), (10.0, 0.0, 3.4), "pier cap"),
        ((1.0, 1.0, 3.0), (10.0, 0.0, 1.5), "pier"),
        ((3.0, 3.0, 0.5), (10.0, 0.0, -0.25), "footing"),
    ]
    shapes = {number: box(size, middle) for number, (size, middle, _) in enumerate(bodies)}
    found = kinds_below([deck], shapes)
    assert [found.get(number) for number in range(len(bodies))] == [kind for _, _, kind in bodies]


def test_the_user_says_what_an_element_is():
    said = facts("IfcBuildingElementProxy", "Überbau 3")
    assert kind_of(said, [("überbau*", "deck")]) == "deck"
    assert kind_of(facts("IfcPile", "P1"), [("IfcPile", "pier")]) == "pier"


def test_a_kind_that_there_is_not():
    with pytest.raises(IfcError, match='kind of "X" is "dock": expected one of deck, girder'):
        ImportSettings(kinds=(("X", "dock"),))


@pytest.mark.parametrize(
    "name, kind",
    [
        # Norwegian
        *(("LANDKAR", "abutment"), ("SØYLE", "pier"), ("LAGER", "bearing"), ("FUNDAMENT", "footing")),
        *(("VINGE", "wing wall"), ("BRUDEKKE", "deck"), ("OVERGANGSPLATE", "approach slab"), ("Kantdrager", "parapet")),
        # German
        *(("Widerlager Nord", "abutment"), ("Pfeiler 2", "pier"), ("Stütze", "pier"), ("Lager 3", "bearing")),
        *(
            ("Fundament", "footing"),
            ("Flügelwand", "wing wall"),
            ("Überbau", "deck"),
            ("Schleppplatte", "approach slab"),
        ),
        *(("Kappe links", "parapet"), ("Hauptträger", "girder"), ("Querträger", "girder")),
        # French
        *(("Culée C0", "abutment"), ("Appareil d'appui", "bearing"), ("Semelle", "footing"), ("Chevêtre", "pier cap")),
        *(("Mur en aile", "wing wall"), ("Tablier", "deck"), ("Dalle de transition", "approach slab")),
        # Spanish
        *(("Estribo 1", "abutment"), ("Pila 2", "pier"), ("Apoyo", "bearing"), ("Zapata", "footing")),
        *(("Aleta", "wing wall"), ("Tablero", "deck"), ("Losa de transición", "approach slab")),
        # Italian
        *(("Spalla A", "abutment"), ("Appoggio", "bearing"), ("Plinto", "footing"), ("Impalcato", "deck")),
        *(("Pulvino", "pier cap"), ("Trave", "girder")),
        # Dutch
        *(("Landhoofd", "abutment"), ("Pijler", "pier"), ("Oplegging", "bearing"), ("Fundering", "footing")),
        *(("Vleugelwand", "wing wall"), ("Brugdek", "deck"), ("Stootplaat", "approach slab"), ("Ligger", "girder")),
        # Swedish
        *(("Landfäste", "abutment"), ("Pelare", "pier"), ("Bottenplatta", "footing"), ("Vingmur", "wing wall")),
        *(("Brobaneplatta", "deck"), ("Länkplatta", "approach slab"), ("Kantbalk", "parapet")),
        # Twelve more, by the words of their codes for bridges
        *(("桥台", "abutment"), ("桥墩1", "pier"), ("盖梁", "pier cap"), ("支座", "bearing"), ("箱梁", "girder")),
        *(("橋脚", "pier"), ("主桁", "girder"), ("床版", "deck"), ("踏掛版", "approach slab"), ("壁高欄", "parapet")),
        *(("교대", "abutment"), ("교각", "pier"), ("거더", "girder"), ("받침", "bearing"), ("바닥판", "deck")),
        *(("Przyczółek", "abutment"), ("Filar 2", "pier"), ("Dźwigar", "girder"), ("Łożysko", "bearing")),
        *(
            ("Opěra", "abutment"),
            ("Pilíř", "pier"),
            ("Nosník", "girder"),
            ("Mostovka", "deck"),
            ("Křídlo", "wing wall"),
        ),
        *(("Encontro", "abutment"), ("Sapata", "footing"), ("Tabuleiro", "deck"), ("Aparelho de apoio", "bearing")),
        *(("Landfæste", "abutment"), ("Søjle", "pier"), ("Brodæk", "deck"), ("Overgangsplade", "approach slab")),
        *(("Maatuki", "abutment"), ("Pääpalkki", "girder"), ("Kansilaatta", "deck"), ("Laakeri", "bearing")),
        *(("УСТОЙ 1", "abutment"), ("Опора 2", "pier"), ("Главная балка", "girder"), ("Опорная часть", "bearing")),
        *(("Upornjak", "abutment"), ("Stupište", "pier"), ("Glavni nosač", "girder"), ("Temelj", "footing")),
        *(("Kenar Ayak", "abutment"), ("BAŞLIK KİRİŞİ", "pier cap"), ("Tabliye", "deck"), ("Mesnet", "bearing")),
        *(("Hídfő", "abutment"), ("Főtartó", "girder"), ("Pályalemez", "deck"), ("Szárnyfal", "wing wall")),
        *(("Hoveddrager 1", "girder"), ("Tværdrager", "girder"), ("Pääkannattaja", "girder"), ("Стойка", "pier")),
        *(
            ("Orta ayak 2", "pier"),
            ("Coluna", "pier"),
            ("Travessa", "pier cap"),
            ("横撑", "bracing"),
            ("가새", "bracing"),
        ),
        *(("Querhaupt", "pier cap"), ("Brobana", "deck"), ("Leje", "bearing")),
        # English
        *(("Abut1", "abutment"), ("ABUT_B", "abutment")),
        *(("MyBeam", "girder"), ("BoxBeam_01", "girder"), ("EndPier", "pier"), ("MainDeck", "deck")),
        *(("CrossBrace", "bracing"), ("PierCapNorth", "pier cap"), ("LHSAbutment", "abutment")),
        *(
            ("Arch segment", "arch"),
            ("Backfill", "fill"),
            ("Approach slab", "approach slab"),
            ("Cross girder", "girder"),
        ),
    ],
)
def test_words_of_other_languages(name, kind):
    assert kind_of(facts("IfcBuildingElementProxy", name)) == kind


def test_a_french_pile_is_a_pier_and_an_english_one_is_not():
    said = facts("IfcBuildingElementProxy", "Pile P2")
    assert kind_of(said, is_french=is_french(["Pile P2", "Culée C0"])) == "pier"
    assert isinstance(kind_of(said, is_french=is_french(["Pile P2", "Abutment"])), LeftOut)


def test_a_beam_or_slab_whose_name_says_something_else():
    assert kind_of(facts("IfcBeam", "LANDKAR")) == "abutment"
    assert kind_of(facts("IfcSlab", "VINGE")) == "wing wall"
    assert kind_of(facts("IfcBeam", "Girder over pier 2")) == "girder"
    assert kind_of(facts("IfcBeam", "cross girder", predefined="PIERCAP")) == "girder"


def test_properties_count_where_class_and_name_say_nothing():
    said = ElementFacts(
        name="CFX55_1", global_id="0", classes=("IfcElement",), words="CFX55_1", properties="OBPCrossframeX"
    )
    assert kind_of(said) == "bracing"
