"""The reference of a search file's keys says what the code does, and the example is a search that can be made."""

from support.checkout import EXAMPLES, ROOT

from bridge_demolition_addon.model.schema import key_fields
from bridge_demolition_addon.model.search.file import read_search
from bridge_demolition_addon.model.search.reference import search_reference
from bridge_demolition_addon.model.search.settings import SearchSettings

DOCUMENT = ROOT / "docs" / "search_file.md"


def test_the_document_is_up_to_date():
    assert DOCUMENT.read_text(encoding="utf-8") == search_reference(), (
        "run: python -m bridge_demolition_addon.model.search.reference docs/search_file.md"
    )


def test_every_key_of_a_search_has_a_row():
    text = DOCUMENT.read_text(encoding="utf-8")
    for item in key_fields(SearchSettings):
        assert f"| `{item.name}` | " in text


def test_examples_can_be_read():
    paths = sorted((EXAMPLES / "searches").glob("*.toml"))
    assert paths
    for path in paths:
        search = read_search(path)
        assert search.trial(1, search.settings.highest).scenario.title == search.study.scenario.title
