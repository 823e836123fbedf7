# SPDX-License-Identifier: GPL-3.0-or-later
"""What the panels Results and Stages say of bearings."""

from dataclasses import replace

from bridge_demolition_addon.model.results.records import BearingOfRun
from bridge_demolition_addon.ui.results.shown_run import bearing_rows
from bridge_demolition_addon.ui.stages import reaction_cells_of

STANDS = BearingOfRun(
    name="deck on pier 1",
    at_rest_up_n=178_040.0,
    least_up_n=-20_000.0,
    largest_up_n=250_000.0,
    largest_horizontal_n=1_500.0,
    largest_moment_y_nm=0.0,
    largest_displacement_m=0.0,
    left_share=1.0,
    opened=False,
    opened_s=None,
    largest_open_share=0.0,
    slid=False,
    gone_s=None,
)
NUMBERS = ("178.0", "-20.0", "250.0", "1.5")


def test_results_show_forces_and_what_happened():
    others = (
        ({}, ""),
        ({"opened": True, "largest_open_share": 1.0, "slid": True}, "opened and slid"),
        ({"largest_open_share": 0.28}, "opened by 28 %"),
        ({"slid": None}, ""),
        ({"opened": True, "largest_open_share": 1.0, "gone_s": 0.52}, "gone at 0.52 s"),
    )
    head, *rows = bearing_rows([replace(STANDS, **changed) for changed, _ in others])
    assert head == ("Bearings, kN", "at rest", "least", "most", "sideways", "")
    assert rows == [("deck on pier 1", *NUMBERS, said) for _, said in others]
    assert bearing_rows([]) == ()
    _, slept = bearing_rows([replace(STANDS, at_rest_up_n=None)])
    assert slept[1:3] == ("not known", "-20.0")


def test_stages_show_bearings_as_they_show_supports():
    row = {"bearing": "deck on pier 1"}
    row |= {f"force_{axis}_kN": value for axis, value in zip("xyz", (1.0, -2.0, 178.04), strict=True)}
    row |= {f"moment_{axis}_kNm": value for axis, value in zip("xyz", (15.08, 0.0, 11.58), strict=True)}
    assert reaction_cells_of({}, "force", "bearing") == ("Bearings, kN", "x", "y", "z")
    assert reaction_cells_of(row, "force", "bearing") == ("deck on pier 1", "1.0", "-2.0", "178.0")
    assert reaction_cells_of(row, "moment", "bearing") == ("deck on pier 1", "15.1", "0.0", "11.6")
