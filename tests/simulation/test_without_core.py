# SPDX-License-Identifier: GPL-3.0-or-later
"""Without the compiled core motion is recorded where it is enough, and all else is refused before it begins."""

import json
import os
import shutil
import sys

import numpy as np
import pytest
from support.checkout import EXAMPLES, ROOT
from support.processes import outcome, start

from bridge_demolition_addon.engineering.core.library import FILE
from bridge_demolition_addon.model.results.arrays import load_results

PACKAGE = "bridge_demolition_addon"
MISSING = f"The compiled core is missing ({{}}{os.sep}{FILE}): install the program again"

LOOSE = f"""
[scenario]
based_on = '{EXAMPLES / "report_2019" / "single_span_awake.toml"}'
[time]
duration_s = 0.5
[fracture]
shards = 40
[connections]
breaking_force_kgf = 0.001
"""
PUSHED = """
[[loads]]
members = ["deck"]
times_s = [0.0]
forces_n = [1000.0]
"""


@pytest.fixture(scope="module")
def without_core(tmp_path_factory):
    """Folder with a copy of the package in which the core does not lie."""
    folder = tmp_path_factory.mktemp("without_core")
    left_out = shutil.ignore_patterns("bda_core.*")
    shutil.copytree(ROOT / PACKAGE, folder / PACKAGE, ignore=left_out)
    return folder


def run(folder, name, scenario, *options):
    """Exit status, output and complaints of a run of the package in a folder."""
    path = folder / f"{name}.toml"
    path.write_text(scenario, encoding="utf-8")
    command = [sys.executable, "-m", PACKAGE, "run", path, "--output", folder / name, "--no-pictures", *options]
    # Safe: the checkout, in which processes start, is not before it.
    return outcome(start(command, PYTHONPATH=str(folder), PYTHONSAFEPATH="1"))


@pytest.mark.slow
def test_rigid_connections_fall_and_their_loads_are_said_not_to_be_known(without_core):
    status, printed, complaints = run(without_core, "run", LOOSE, "--report")
    assert status == 0, complaints
    missing = MISSING.format(without_core / PACKAGE / "engineering" / "core")
    warning = f"Only motion was recorded: what connections carry, and which broke, is not known. {missing}"
    assert warning in printed
    summary = json.loads((without_core / "run" / "summary.json").read_text(encoding="utf-8"))
    assert summary["only_motion_because"] == missing and summary["largest_force_sum"] is None
    assert min(summary["wall_time_s"].values()) >= 0.0
    assert "Forces are not known in every frame" in (without_core / "run" / "report.html").read_text(encoding="utf-8")
    frames = load_results(without_core / "run" / "results.npz").frames
    # Nothing holds the middle of the deck: it has fallen from rest as free bodies do.
    fallen_m = frames.positions_m[0, :, 2] - frames.positions_m[-1, :, 2]
    assert fallen_m.max() == pytest.approx(9.80665 * frames.time_s[-1] ** 2 / 2.0, rel=0.05)
    assert np.isnan(frames.loads.body_sums_n).all()


@pytest.mark.slow
def test_what_needs_the_core_is_refused_in_words(without_core):
    missing = MISSING.format(without_core / PACKAGE / "engineering" / "core").removeprefix("The compiled core ")
    elastic = f"[scenario]\nbased_on = '{EXAMPLES / 'drilled' / 'two_spans.toml'}'"
    for subject, scenario in (("elastic connections", elastic), ("loads", LOOSE + PUSHED)):
        status, _, complaints = run(without_core, subject, scenario)
        assert status == 1
        assert complaints.splitlines()[-1] == f"bda: error: {subject} need the compiled core, which {missing}"
        assert not (without_core / subject / "results.npz").exists()
