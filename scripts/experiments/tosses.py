# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure what friction, restitution and deactivation do to tossed cubes, and what MuJoCo makes of them.

Usage: tosses.py measure | mujoco

`measure` tosses every tenth of the measured cubes of the case `tossed_cubes` and writes docs/data/tosses.csv; `mujoco`
tosses every second one there and writes docs/data/tosses_by_mujoco.csv. It needs the extra `measured`: E. Todorov, T.
Erez and Y. Tassa, MuJoCo, IROS 2012, with a cube and friction as in the case. It has no restitution; its contacts are
soft, by default with a time constant of 20 ms, and sub-steps of 2 ms. Stiff ones have 2 ms, elliptic cones and 0.5 ms.
"""

from __future__ import annotations

import csv
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
sys.path.insert(1, str(Path(__file__).resolve().parents[2] / "validation"))

from tossed_cubes import (
    DURATION_S,
    FRICTION,
    MASS_KG,
    REST_M_S,
    SIDE_M,
    Contact,
    Ends,
    Tosses,
    axes_of,
    measured,
    off_by_shares,
    spread,
    tossed,
    turned_shares,
)

ROOT = Path(__file__).resolve().parents[2]
TABLE, BY_MUJOCO = ROOT / "docs" / "data" / "tosses.csv", ROOT / "docs" / "data" / "tosses_by_mujoco.csv"
EVERY, EVERY_IN_MUJOCO = 10, 2
VARIANTS: dict[str, tuple[float | bool, ...]] = {
    "friction": (0.1, 0.3),
    "restitution": (0.0, 0.5),
    "use_deactivation": (True,),
}
"""What is changed, one at a time; all else is as in the case."""

XML = """
<mujoco>
  <option timestep="{step_s}" cone="{cone}" gravity="0 0 -9.80665"/>
  <worldbody>
    <geom type="plane" size="9 9 1" friction="{friction} 0 0" solref="{softness_s} 1"/>
    <body name="cube"><freejoint/>
      <geom type="box" size="{half_m} {half_m} {half_m}" mass="{mass_kg}" friction="{friction} 0 0"
            solref="{softness_s} 1"/>
    </body>
  </worldbody>
</mujoco>
"""
SETTINGS: dict[str, dict[str, float | str]] = {
    "default": {"step_s": 0.002, "cone": "pyramidal", "softness_s": 0.02},
    "stiff": {"step_s": 0.0005, "cone": "elliptic", "softness_s": 0.002},
}


def main(words: list[str]) -> int:
    """Write what is asked for."""
    if words == ["measure"]:
        commit = ["git", "log", "-1", "--format=%h", "--", "bridge_demolition_addon"]
        version = subprocess.run(commit, cwd=ROOT, capture_output=True, text=True, check=True).stdout.strip()
        write(TABLE, ("changed", "to"), by_this(measured(EVERY)), version)
    elif words == ["mujoco"]:
        import mujoco

        write(BY_MUJOCO, ("contacts",), by_mujoco(measured(EVERY_IN_MUJOCO)), f"MuJoCo {mujoco.__version__}")
    else:
        sys.exit(__doc__)
    return 0


def write(path: Path, keys: tuple[str, ...], rows: Iterator[tuple[tuple[str, ...], dict[str, float]]], by: str) -> None:
    """Write a table, row by row."""
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        for number, (key, numbers) in enumerate(rows):
            if not number:
                table.writerow([*keys, *numbers, "by"])
            table.writerow([*key, *(f"{value:.3f}" for value in numbers.values()), by])
            file.flush()
            print(*key, *(f"{name} {value:.3f}" for name, value in numbers.items()), flush=True)


def by_this(tosses: Tosses) -> Iterator[tuple[tuple[str, ...], dict[str, float]]]:
    """Yield what each variant gives, the first as the case has it."""
    cases = [("nothing", ""), *((what, value) for what, values in VARIANTS.items() for value in values)]
    for what, value in cases:
        contact = replace(Contact(), **({} if what == "nothing" else {what: value}))
        with tempfile.TemporaryDirectory() as folder:
            yield (what, str(value)), over_measured(tossed(Path(folder), tosses, contact), tosses)


def over_measured(found: Ends, tosses: Tosses) -> dict[str, float]:
    """Return means and spreads over those that were measured, and shares."""
    ends = tosses.ends
    turned, upside_down = turned_shares(found.faces, tosses)
    return {
        "travel": found.travels_m.mean() / ends.travels_m.mean(),
        "travel_spread": spread(found.travels_m) / spread(ends.travels_m),
        "rest": found.rest_s.mean() / ends.rest_s.mean(),
        "rest_spread": spread(found.rest_s) / spread(ends.rest_s),
        "turned": turned,
        "upside_down": upside_down,
        "same_face": float(np.mean(found.faces == ends.faces)),
        "end_off_by": float(np.median(off_by_shares(found, tosses))),
    }


def by_mujoco(tosses: Tosses) -> Iterator[tuple[tuple[str, ...], dict[str, float]]]:
    """Yield what MuJoCo gives with soft and with stiff contacts."""
    for name, settings in SETTINGS.items():
        yield (name,), over_measured(tossed_by_mujoco(tosses, settings), tosses)


def tossed_by_mujoco(tosses: Tosses, settings: Mapping[str, float | str]) -> Ends:
    """Toss each cube alone."""
    import mujoco

    model = mujoco.MjModel.from_xml_string(
        XML.format(friction=FRICTION, half_m=SIDE_M / 2.0, mass_kg=MASS_KG, **settings)
    )
    data = mujoco.MjData(model)
    ways, quaternions, rests = [], [], []
    for row in range(len(tosses)):
        mujoco.mj_resetData(model, data)
        data.qpos[:3], data.qpos[3:] = tosses.positions_m[row], quaternion_of(tosses.axes[row])
        data.qvel[:3] = tosses.velocities_m_s[row]
        data.qvel[3:] = tosses.axes[row].T @ tosses.angular_velocities_rad_s[row]  # about the cube's own axes
        rest = 0.0
        while data.time < DURATION_S:
            mujoco.mj_step(model, data)
            if np.sqrt(np.sum(data.qvel[:3] ** 2)) > REST_M_S:
                rest = data.time
        ways.append(data.qpos[:2] - tosses.positions_m[row, :2])
        quaternions.append(data.qpos[3:].copy())
        rests.append(rest)
    return Ends(np.array(ways), axes_of(np.array(quaternions)), np.array(rests))


def quaternion_of(axes: np.ndarray) -> np.ndarray:
    """Return the quaternion w, x, y, z of a rotation (3, 3): of the largest eigenvalue of Bar-Itzhack's matrix."""
    a = axes
    lower = [
        [a[0, 0] - a[1, 1] - a[2, 2], 0.0, 0.0, 0.0],
        [a[1, 0] + a[0, 1], a[1, 1] - a[0, 0] - a[2, 2], 0.0, 0.0],
        [a[2, 0] + a[0, 2], a[2, 1] + a[1, 2], a[2, 2] - a[0, 0] - a[1, 1], 0.0],
        [a[2, 1] - a[1, 2], a[0, 2] - a[2, 0], a[1, 0] - a[0, 1], a[0, 0] + a[1, 1] + a[2, 2]],
    ]
    x, y, z, w = np.linalg.eigh(np.array(lower), UPLO="L")[1][:, -1]
    return np.array([w, x, y, z])


if __name__ == "__main__":
    status = main(sys.argv[1:])
    sys.stdout.flush()
    os._exit(status)  # Blender as a module may crash as it ends
