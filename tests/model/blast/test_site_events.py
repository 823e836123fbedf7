# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of measured events: heads and units as programs of seismographs and charge plans write them."""

import numpy as np
import pytest

from bridge_demolition_addon.errors import BlastError, ScenarioError
from bridge_demolition_addon.model.blast.site_events import law_of_file, site_events

DISTANCES_M = [10.0, 20.0, 35.0, 60.0, 100.0]


def written(folder, *lines):
    path = folder / "events.csv"
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def test_a_drop_test_has_its_energy_and_the_largest_component(tmp_path):
    """5 t from 20 m: 5000 · 9.80665 · 20 J = 980.665 kJ."""
    path = written(
        tmp_path,
        "Station,Distance (m),Mass (t),Drop height (m),Tran PPV (mm/s),Vert PPV (mm/s),PVS (mm/s),Freq (Hz),Mic (dB)",
        *(
            f"S{number},{distance},5,20,8,{200 / distance},99,{number},110"
            for number, distance in enumerate(DISTANCES_M, 5)
        ),
    )
    events = site_events(path)
    assert events.of == "fall"
    assert events.sizes == pytest.approx([980.665] * 5) and events.distances_m == pytest.approx(DISTANCES_M)
    assert events.velocities_m_s == pytest.approx(np.maximum(8.0, 200.0 / np.array(DISTANCES_M)) / 1e3)
    assert events.frequencies_hz.tolist() == [5, 6, 7, 8, 9]


@pytest.mark.parametrize(
    "head, row, distance_m, charge_kg, velocity_m_s",
    [
        ("distance_m,charge_kg,ppv_mm_s", "30,2.5,12", 30.0, 2.5, 0.012),
        ("Distance (ft),Max Charge/Delay (lbs),Peak Vector Sum (in/s)", "100,10,0.5", 30.48, 4.5359237, 0.0127),
        ("Distance [ft];MIC [lb];PPV [ips]", "100;10;0,5", 30.48, 4.5359237, 0.0127),
        ("Abstand [m];Lademenge je Zündstufe [g];PPV [mm/s]", "30,5;2500;12,5", 30.5, 2.5, 0.0125),
        (
            "Scaled Distance (m),PPV (cm/s),Distance (m),Total charge (kg),Charge weight (kg)",
            "9,1.2,30,99,2.5",
            30,
            2.5,
            0.012,
        ),
    ],
)
def test_heads_of_many_programs_are_read(tmp_path, head, row, distance_m, charge_kg, velocity_m_s):
    """International foot and pound: 0.3048 m and 0.45359237 kg."""
    events = site_events(written(tmp_path, "# made by a seismograph", head, row, "", row))
    assert events.of == "charges" and len(events.sizes) == 2
    assert (events.distances_m[0], events.sizes[1], events.velocities_m_s[0]) == pytest.approx(
        (distance_m, charge_kg, velocity_m_s)
    )


@pytest.mark.parametrize(
    "head, row, complaint",
    [
        ("distance_m,charge_kg", "10,1", "no column is a velocity"),
        ("distance,charge_kg,ppv_mm_s", "10,1,1", 'column "distance" is a distance: expected its unit at its end, m'),
        ("distance_m,charge_m,ppv_mm_s", "10,1,1", 'column "charge_m" is a charge: expected its unit'),
        ("distance_ft,charge_kg,ppv_mm_s", "10,1,1", 'units of two systems, "distance_ft" and "charge_kg"'),
        ("distance_m,Distance (ft),charge_kg,ppv_mm_s", "10,33,1,1", "expected one"),
        ("distance_m,range_m,charge_kg,ppv_mm_s", "10,33,1,1", "are both a distance: expected one"),
        ("distance_m,mass_kg,ppv_mm_s", "10,1,1", "expected either a charge per delay"),
        ("distance_m,charge_kg,energy_kj,ppv_mm_s", "10,1,1,1", "expected either a charge per delay"),
        ("distance_m,charge_kg,ppv_mm_s", "20 ft,1,1", 'row 2: "distance_m" is "20 ft": expected a number above 0'),
        ("distance_m,charge_kg,ppv_mm_s", "20,nan,1", 'row 2: "charge_kg" is "nan"'),
        ("distance_m,charge_kg,ppv_mm_s", "20,1", 'row 2: "ppv_mm_s" is ""'),
        ("distance_m,charge_kg,ppv_mm_s", "20,1,-3", 'row 2: "ppv_mm_s" is "-3"'),
        ("distance_m,charge_kg,ppv_mm_s", "20,inf,3", 'row 2: "charge_kg" is "inf"'),
    ],
)
def test_wrong_tables_are_told_what_is_wrong(tmp_path, head, row, complaint):
    with pytest.raises(ScenarioError) as raised:
        site_events(written(tmp_path, head, row))
    assert complaint in str(raised.value) and "events.csv" in str(raised.value)


def test_no_law_is_given_of_too_few_events(tmp_path):
    with pytest.raises(BlastError, match=r"events\.csv: too few events, 1: expected at least 5; no law is given"):
        law_of_file(written(tmp_path, "distance_m,charge_kg,ppv_mm_s", "20,1,3"))
    with pytest.raises(BlastError, match="too few events, 0"):
        law_of_file(written(tmp_path, "distance_m,charge_kg,ppv_mm_s"))
    with pytest.raises(ScenarioError, match="found no rows"):
        site_events(written(tmp_path, ""))
    with pytest.raises(ScenarioError, match="no such file"):
        site_events(tmp_path / "none.csv")
