# SPDX-License-Identifier: GPL-3.0-or-later
"""What is made from runs has a command that makes it again."""

import subprocess
import sys

import pytest
from support.checkout import ROOT

sys.path.insert(0, str(ROOT / "scripts"))

import remake

PRODUCTS = {product.name: product for product in remake.products()}


@pytest.mark.parametrize("name", PRODUCTS)
def test_a_product_is_there_with_the_script_that_makes_it(name):
    product = PRODUCTS[name]
    assert [
        path for path in (*product.outputs, *product.sources, product.command[0]) if not (ROOT / path).exists()
    ] == []


def test_all_ranges_and_cases_are_products():
    ranges = {path.stem for path in (ROOT / "docs" / "data" / "seeds").glob("*.csv")}
    cases = {f"validation/{path.stem}" for path in (ROOT / "docs" / "data" / "validation").glob("*.json")}
    assert ranges | cases <= set(PRODUCTS)


def test_what_is_noted_was_made_by_this_project():
    assert set(remake.notes()) <= set(PRODUCTS)


@pytest.mark.long
def test_the_list_says_what_is_left_and_how_long_that_takes():
    done = subprocess.run(
        [sys.executable, ROOT / "scripts" / "remake.py", "--list", "growth", "i235_one_span"],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 2 and "experiments/growth" in done.stderr
    done = subprocess.run(
        [sys.executable, ROOT / "scripts" / "remake.py", "--list", "i235_one_span"], capture_output=True, text=True
    )
    assert done.stdout.startswith("1 of ") and "scripts/seeds.py i235_one_span --seeds 20" in done.stdout
