# SPDX-License-Identifier: GPL-3.0-or-later
"""Compiled lines of a log are those of Python's formatting, which writes them where a loop does not know a text."""

import numpy as np
import pytest

from bridge_demolition_addon.model.run_folder import log_loops, logs
from bridge_demolition_addon.model.run_folder.logs import BodyLog, LogColumn, LogTable

NAMES = ["Deck.001", 'a "pier", 100 %', "Stütze"]
TABLE = LogTable(("body",), (LogColumn("value", "m", lambda values: values, ("x", "y")),))


def written(path, values):
    log = BodyLog(path, TABLE, NAMES)
    log.write(12, 1.0 / 3.0, values)
    log.close()
    return path.read_bytes()


def text_of(number):
    found = log_loops.lines(np.array([[number]]), np.zeros(0, np.uint8), np.zeros(0, np.uint8), np.array([0]))
    return found.tobytes().decode()


@pytest.mark.parametrize("largest", [4, 12, 280])
def test_numbers_have_the_text_of_python(largest):
    rng = np.random.default_rng(largest)
    for number in (rng.normal(size=5000) * 10.0 ** rng.uniform(-largest, largest, 5000)).tolist():
        assert text_of(number) == f",{number:.9g}\n"


def test_numbers_beside_powers_of_ten_have_the_text_of_python():
    powers = 10.0 ** np.arange(-280, 280)
    both = [np.nextafter(powers, 0.0), powers, np.nextafter(powers, np.inf), powers * (1.0 - 4e-10)]
    for number in (0.0, -0.0, np.nan, 0.1, -2.5, 123456789.4, 999999999.6, *np.concatenate(both).tolist()):
        assert text_of(number) == f",{number:.9g}\n"


@pytest.mark.parametrize("number", [1234567895.0, 100000000.5, 5e-324, 1e300, np.inf, -np.inf])
def test_no_text_is_guessed(number):
    assert text_of(number) == ""


@pytest.mark.parametrize("odd", [1.5, np.inf, 100000000.5], ids=["ordinary", "endless", "in the middle"])
def test_a_log_is_the_same_without_numba(tmp_path, monkeypatch, odd):
    values = np.random.default_rng(1).normal(size=(3, 2)) * 1e6
    values[1, 1] = odd
    compiled = written(tmp_path / "compiled.csv", values)
    monkeypatch.setattr(logs, "log_loops", lambda: None)
    assert compiled == written(tmp_path / "plain.csv", values)
    assert f"{odd:.9g}" in compiled.decode() and "Stütze" in compiled.decode()
