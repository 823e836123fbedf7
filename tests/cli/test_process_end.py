# SPDX-License-Identifier: GPL-3.0-or-later
"""The end of the command line: at once, with its status, and without a word of Blender's clean-up."""

from support.processes import run_program


def test_neither_python_nor_blender_cleans_up():
    done = run_program("unfreed_memory")
    assert (done.returncode, done.stdout.splitlines()[-1]) == (3, "all was done")
    assert "Not freed" not in done.stdout + done.stderr
