# SPDX-License-Identifier: GPL-3.0-or-later
"""What loading the command line and the extension brings along, and what has to wait until it is needed."""

import pytest
from support.long_cases import long_but
from support.processes import run_program

BROUGHT = [("command line", []), ("extension", ["bpy"])]


@pytest.mark.parametrize(("loading", "brought"), long_but(BROUGHT[1:], BROUGHT, several=True))
def test_nobody_waits_for_what_draws_figures_or_reads_meshes(loading, brought):
    done = run_program("loaded_modules", loading)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[-1].split() == brought  # Blender may have said something before
