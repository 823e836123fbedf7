"""The validation: its page has every case, and what it says of a case is what the case says."""

import sys

import pytest
from places import ROOT

sys.path.insert(0, str(ROOT / "scripts"))
sys.path.insert(1, str(ROOT / "validation"))

import validate
from case import GROUPS, Comparison


@pytest.mark.parametrize("name", validate.CASES)
def test_the_page_has_the_case_as_it_is_now(name):
    case = validate.case_named(name)
    assert case.name == name and case.group in GROUPS
    assert f"scripts/validate {name} " in validate.DOCUMENT.read_text(encoding="utf-8")
    assert (ROOT / "docs" / "pictures" / "validation" / f"{name}.png").is_file()


def test_the_page_is_what_was_kept():
    """`scripts/validate --page` writes it."""
    assert validate.DOCUMENT.read_text(encoding="utf-8") == validate.page(
        [validate.kept(each) for each in validate.CASES]
    )


def test_all_cases_together_take_half_an_hour_at_most():
    assert sum(validate.kept(each).seconds for each in validate.CASES) <= 1800.0


def test_a_quantity_is_held_against_its_tolerance():
    assert Comparison("way", "m", 2.0, 2.03, 0.02).is_met
    assert not Comparison("way", "m", 2.0, 1.95, 0.02).is_met
    assert Comparison("place", "", (0.3, 0.4), 0.3).is_met
    assert not Comparison("place", "", (0.3, 0.4), 0.41).is_met


def test_one_case_runs_and_is_met(blender, tmp_path):
    """The cheapest: friction stops a block where Coulomb says."""
    import sliding_block

    times, way = sliding_block._course(tmp_path, 0.6)
    expected = sliding_block.SPEED_M_S**2 / (2.0 * 0.6 * sliding_block.G)
    assert way[-1] == pytest.approx(expected, rel=0.02)
    assert times[-1] == pytest.approx(2.5, abs=0.05)
