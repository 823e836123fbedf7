# SPDX-License-Identifier: GPL-3.0-or-later
"""Blind forecasts: each stays as it was committed, and the page says what became of it."""

import blind
import blind_page
import pytest
import validate
from blind import Forecast, Foreseen

PASCALS_PER_PSI = 6894.757
PAGE = validate.DOCUMENT.read_text(encoding="utf-8").split("## Blind forecasts")[1]


@pytest.fixture
def kept_elsewhere(tmp_path, monkeypatch):
    """Forecasts and outcomes are kept in a folder of the test."""
    monkeypatch.setattr(blind, "KEPT", tmp_path)
    return tmp_path


@pytest.mark.parametrize("name", validate.BLIND_CASES)
def test_a_forecast_is_still_the_one_that_was_committed(name):
    """Its outcome names the digest of the file that its commit has: `git show COMMIT:docs/data/blind/NAME.json`."""
    outcome = blind.kept_outcome(name)
    assert blind.digest(name) == outcome.forecast_sha256
    assert blind.kept_forecast(name).made <= outcome.opened


@pytest.mark.parametrize("name", validate.BLIND_CASES)
def test_the_page_has_each_forecast_with_its_commit_and_names_its_misses(name):
    case, outcome = validate.blind_case_named(name), blind.kept_outcome(name)
    own = PAGE.split(f"### {case.title}\n")[1].split("\n### ")[0]
    assert f"`{outcome.forecast_commit}`" in own and outcome.learned in own
    pairs = list(blind_page.compared(name))
    assert pairs and own.count("**missed**") == sum(not foreseen.has(measured) for foreseen, measured in pairs)


def test_a_forecast_is_kept_once(kept_elsewhere):
    forecast = Forecast("2026-11-27", "abc", [Foreseen("way", "m", 2.0, 1.0, 3.0)])
    blind.keep("toss", forecast)
    assert blind.kept_forecast("toss") == forecast and blind.kept_outcome("toss") is None
    with pytest.raises(FileExistsError):
        blind.keep("toss", forecast)


def test_a_range_has_its_ends():
    foreseen = Foreseen("way", "m", 2.0, 1.0, 3.0)
    assert [foreseen.has(measured) for measured in (0.99, 1.0, 3.0, 3.01)] == [False, True, True, False]


def test_the_measured_pressure_is_that_of_the_page_it_is_from():
    """11.012 psi, 2 m from 200 g, which its author takes for 260 g of TNT."""
    assert blind.kept_outcome("blind_airblast").measured[0] == pytest.approx(11.012e-3 * PASCALS_PER_PSI, abs=0.01)
