# SPDX-License-Identifier: GPL-3.0-or-later
"""What every case of the validation has: what is asked, what is expected and why, and what came out."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from pathlib import Path

from matplotlib.figure import Figure

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.engineering.geometry.mesh import TriangleMesh
from bridge_demolition_addon.model.results.arrays import Results, load_results
from bridge_demolition_addon.model.scenario.file import read_scenario

VERIFICATION, VALIDATION = "Verification", "Validation"
GROUPS = (VERIFICATION, VALIDATION)
"""Cases held against theory of the same model alone, and those held against what was measured, too."""


class Against(StrEnum):
    """What a quantity is held against."""

    THEORY = "theory"
    """Of the same model: an exact answer, or another program that calculates the same."""
    MEASURED = "measured"
    """What was measured, or a formula that was fitted to tests."""


@dataclass(frozen=True, slots=True)
class Comparison:
    """A quantity of a case, next to what it should be.

    Attributes
    ----------
    quantity, unit : str
    expected : float or tuple of float
        A number, or the range that it has to be in.
    found : float
    tolerance : float
        By how much of the expected number it may be off; of a range, 0.
    against : Against
    """

    quantity: str
    unit: str
    expected: float | tuple[float, float]
    found: float
    tolerance: float = 0.0
    against: Against = Against.THEORY

    @property
    def is_met(self) -> bool:
        """Whether it is as it should be."""
        if isinstance(self.expected, tuple):
            return self.expected[0] <= self.found <= self.expected[1]
        return abs(self.found - self.expected) <= self.tolerance * abs(self.expected)

    @property
    def ratio(self) -> float | None:
        """What was found over what is expected; None where that is a range."""
        return None if isinstance(self.expected, tuple) else self.found / self.expected


@dataclass(frozen=True, slots=True)
class Found:
    """What a case came to: comparisons, and what draws its picture."""

    comparisons: Sequence[Comparison]
    draw: Callable[[Figure], None]


@dataclass(frozen=True, slots=True)
class Case:
    """A case of the validation.

    Attributes
    ----------
    name, title, group : str
    asked, left_out, source, reason : str
        What it is, what the model leaves out, where the expected values are from, and why they may be off by so much.
    run : callable
        Runs it in a folder.
    """

    name: str
    title: str
    group: str
    asked: str
    left_out: str
    source: str
    reason: str
    run: Callable[[Path], Found]


def simulated(folder: Path, name: str, scenario: str, meshes: Mapping[str, TriangleMesh]) -> Results:
    """Write a scenario and its meshes into a folder, so that anyone can run it, run it, and return the results.

    It runs for all of its time, also where everything rests before. Meshes are named with or without the suffix of
    their files, which is .stl by default; many are read faster as .obj.
    """
    from bridge_demolition_addon.model.bridge.mesh_files import exported
    from bridge_demolition_addon.simulation.run import run_scenario

    position = folder / name
    position.mkdir(parents=True, exist_ok=True)
    for mesh, solid in meshes.items():
        file = position / (mesh if Path(mesh).suffix else f"{mesh}.stl")
        file.write_bytes(exported(solid, file.suffix))
    (position / "scenario.toml").write_text(scenario, encoding="utf-8")
    planned = read_scenario(position / "scenario.toml")
    whole = replace(planned, time=replace(planned.time, stop_at_rest=False))
    run_scenario(whole, position / "run", overwrite=True, pictures=False, progress=Silence())
    return load_results(position / "run" / "results.npz")


LOOSE = """
[connections]
type = "FIXED"
method = "face"
breaking_force_n = 1e12

[[connections.between]]
members = ["member", "ground"]
none = true
"""
"""Connections of cases whose bodies only touch the ground."""

RIGID_BODIES = """
[shards]
linear_damping = 0.0
angular_damping = 0.0
use_deactivation = false
start_deactivated = false
collision_margin_m = 0.0

[contacts.shards]
friction = {shards}

[contacts.ground]
friction = {ground}
"""
"""Settings of all cases: nothing damps, nothing sleeps, and edges are sharp. Friction is that between shards, and that
of shards on the ground."""
