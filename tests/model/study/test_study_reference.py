"""The reference of a study file's keys says what the code does, and the example is a study that can be run."""

from support.checkout import EXAMPLES, ROOT

from bridge_demolition_addon.model.schema import key_fields
from bridge_demolition_addon.model.study.draws import draw_of
from bridge_demolition_addon.model.study.file import read_study
from bridge_demolition_addon.model.study.reference import study_reference
from bridge_demolition_addon.model.study.settings import StudySettings, Vary

DOCUMENT = ROOT / "docs" / "study_file.md"
EXAMPLE = EXAMPLES / "studies" / "i235_one_span.toml"


def test_the_document_is_up_to_date():
    assert DOCUMENT.read_text(encoding="utf-8") == study_reference(), (
        "run: python -m bridge_demolition_addon.model.study.reference docs/study_file.md"
    )


def test_every_key_of_a_study_has_a_row():
    text = DOCUMENT.read_text(encoding="utf-8")
    for item in (*key_fields(StudySettings), *key_fields(Vary)):
        assert f"| `{item.name}` | " in text


def test_all_draws_of_the_example_can_be_run():
    study = read_study(EXAMPLE)
    drawn = [draw_of(study, number) for number in range(1, study.settings.runs + 1)]
    assert {each.scenario.title for each in drawn} == {study.scenario.title}
    assert len({each.scenario.seed for each in drawn}) == len(drawn) == 93
