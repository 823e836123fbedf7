# SPDX-License-Identifier: GPL-3.0-or-later
"""Texts of the window have the units of the scene: metric, or imperial as Blender shows them."""

import pytest

from bridge_demolition_addon.model.run_folder.summary import RunSummary

FOOT_M, POUND_KG = 0.3048, 0.45359237
"""By the international agreement of 1959."""

KIP_N = 4448.222
"""NIST SP 811, appendix B.8."""


@pytest.fixture
def imperial(extension):
    extension.context.scene.unit_settings.system = "IMPERIAL"
    return extension


def test_texts_are_metric_as_long_as_the_scene_is(extension):
    from bridge_demolition_addon.ui.scene_units import area_text, length_text, mass_text

    assert extension.context.scene.unit_settings.system == "METRIC"
    assert (length_text(3.048, ".2f"), area_text(12.4, ".0f"), mass_text(107000.0)) == ("3.05 m", "12 m²", "107 000 kg")


def test_texts_are_imperial_where_the_scene_is(imperial):
    from bridge_demolition_addon.ui.scene_units import area_text, length_text, mass_text

    assert length_text(10 * FOOT_M, ".2f") == "10 ft"
    assert mass_text(240_000 * POUND_KG) == "240 000 lb"
    assert area_text(18 * FOOT_M**2, ".0f") == "18 sq ft"


def test_forces_are_in_the_units_of_a_colour_bar_or_in_kips(extension):
    from bridge_demolition_addon.ui.scene_units import force_text

    assert [force_text(force_n) for force_n in (12.0, 4448.2, 1.23456e6)] == ["12 N", "4.448 kN", "1.235 MN"]
    extension.context.scene.unit_settings.system = "IMPERIAL"
    assert [force_text(count * KIP_N) for count in (0.25, 2000.0)] == ["0.25 kip", "2000 kip"]


def test_results_are_in_pounds_where_the_scene_is_imperial(imperial):
    from bridge_demolition_addon.ui.results.shown_run import lines_of

    summary = {
        "connections": {"broken": 1, "count": 2},
        "mass_kg": {"shard": 30 * POUND_KG},
        "frames": 3,
        "simulated_s": 0.1,
    }
    assert lines_of(RunSummary.of(summary))[0] == "Total mass: 30 lb"


@pytest.mark.parametrize(
    ("table", "key", "unit"),
    [
        ("bridge.deck", "width_m", "LENGTH"),
        ("bridge.piers", "height_m", "LENGTH"),
        ("bridge", "mass_kg", "MASS"),
        ("ball", "mass_kg", "MASS"),
        ("ball", "drop_height_m", "LENGTH"),
        ("ball", "target_m", "LENGTH"),
        ("time", "rest_speed_m_s", "VELOCITY"),
        ("time", "duration_s", "TIME_ABSOLUTE"),
        ("fracture", "recursion_smallest_m3", "VOLUME"),
    ],
)
def test_lengths_masses_and_speeds_have_units_that_blender_turns_into_others(extension, table, key, unit):
    group = extension.context.scene.bda.path_resolve(f"scenario.{table}")
    assert group.bl_rna.properties[key].unit == unit


def test_rows_of_lengths_have_no_unit_in_their_heading_as_blender_shows_the_scenes_own(extension):
    from bridge_demolition_addon.model.scenario import Bridge
    from bridge_demolition_addon.ui.scenario.ui import rows_of

    spans = next(row for row in rows_of(Bridge) if row.name == "span_lengths_m")
    assert (spans.label, spans.label_of_rows) == ("Span Lengths (m)", "Span Lengths")
    row = extension.context.scene.bda.scenario.bridge.bl_rna.properties["span_lengths_m_row_0"]
    assert row.unit == "LENGTH"
