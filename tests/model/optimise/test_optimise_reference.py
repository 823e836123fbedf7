"""The reference of an optimisation file's keys says what the code does, and the examples can be run."""

from support.checkout import EXAMPLES, ROOT

from bridge_demolition_addon.model.optimise.file import read_optimisation
from bridge_demolition_addon.model.optimise.reference import optimise_reference
from bridge_demolition_addon.model.optimise.settings import OptimiseSettings, Order, Place, Quantity
from bridge_demolition_addon.model.schema import key_fields

DOCUMENT = ROOT / "docs" / "optimise_file.md"


def test_the_document_is_up_to_date():
    assert DOCUMENT.read_text(encoding="utf-8") == optimise_reference(), (
        "run: python -m bridge_demolition_addon.model.optimise.reference docs/optimise_file.md"
    )


def test_every_key_of_an_optimisation_has_a_row():
    text = DOCUMENT.read_text(encoding="utf-8")
    for table in (OptimiseSettings, Quantity, Place, Order):
        for item in key_fields(table):
            assert f"| `{item.name}` | " in text


def test_examples_can_be_read():
    paths = sorted((EXAMPLES / "optimisations").glob("*.toml"))
    assert paths
    for path in paths:
        found = read_optimisation(path)
        for share in (0.0, 1.0):
            assert found.trial(1, [share] * found.space.size).scenario.title == found.study.scenario.title
