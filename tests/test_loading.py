# SPDX-License-Identifier: GPL-3.0-or-later
"""What loading the command line and the extension brings along, and what has to wait until it is needed."""

import pytest
from support.processes import run_program


@pytest.mark.parametrize(("loading", "brought"), [("command line", []), ("extension", ["bpy"])])
def test_nobody_waits_for_what_draws_figures_or_reads_meshes(loading, brought):
    done = run_program("loaded_modules", loading)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[-1].split() == brought  # Blender may have said something before
