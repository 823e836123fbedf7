# SPDX-License-Identifier: GPL-3.0-or-later
"""The references of study, search and optimisation files say what the code does, and the examples can be run."""

import pytest
from support.checkout import EXAMPLES, ROOT

from bridge_demolition_addon.model.ensemble.reference import reference_pages
from bridge_demolition_addon.model.optimise.file import read_optimisation
from bridge_demolition_addon.model.optimise.settings import (
    ChosenOption,
    ChosenOrder,
    ChosenPlace,
    ChosenQuantity,
    OptimiseSettings,
)
from bridge_demolition_addon.model.schema import key_fields
from bridge_demolition_addon.model.search.file import read_search
from bridge_demolition_addon.model.search.settings import SearchSettings
from bridge_demolition_addon.model.study.file import read_study
from bridge_demolition_addon.model.study.sampled_runs import sampled_run
from bridge_demolition_addon.model.study.settings import StudySettings, Vary

TABLES = {
    "study_file.md": (StudySettings, Vary),
    "search_file.md": (SearchSettings,),
    "optimise_file.md": (OptimiseSettings, ChosenQuantity, ChosenPlace, ChosenOrder, ChosenOption),
}


@pytest.mark.parametrize("page", TABLES)
def test_the_document_is_up_to_date(page):
    assert (ROOT / "docs" / page).read_text(encoding="utf-8") == reference_pages()[page], (
        "run: python -m bridge_demolition_addon.model.ensemble.reference docs"
    )


@pytest.mark.parametrize("page", TABLES)
def test_every_key_has_a_row(page):
    text = (ROOT / "docs" / page).read_text(encoding="utf-8")
    for table in TABLES[page]:
        for item in key_fields(table):
            assert f"| `{item.name}` | " in text


def test_all_runs_of_the_example_can_be_made():
    study = read_study(EXAMPLES / "studies" / "i235_one_span.toml")
    runs = [sampled_run(study, number) for number in range(1, study.settings.runs + 1)]
    assert {run.scenario.title for run in runs} == {study.scenario.title}
    assert len({run.scenario.seed for run in runs}) == len(runs) == 93


def test_examples_of_searches_can_be_made():
    paths = sorted((EXAMPLES / "searches").glob("*.toml"))
    assert paths
    for path in paths:
        search = read_search(path)
        assert search.run_at(1, search.settings.highest).scenario.title == search.scenario.title


def test_examples_of_optimisations_can_be_made():
    paths = sorted((EXAMPLES / "optimisations").glob("*.toml"))
    assert paths
    for path in paths:
        optimisation = read_optimisation(path)
        for share in (0.0, 1.0):
            run = optimisation.run_of(1, [share] * optimisation.space.size)
            assert run.scenario.title == optimisation.scenario.title


def test_the_old_path_of_an_optimisation_leads_to_the_one_that_replaced_it(caplog):
    folder = EXAMPLES / "optimisations"
    old = read_optimisation(folder / "least_reach.toml")
    assert old.scenario.title == read_optimisation(folder / "least_charge.toml").scenario.title
    assert "least_charge.toml" in caplog.text
