"""What loading the command line and the add-on brings along, and what has to wait until it is needed."""

import subprocess
import sys

import pytest

ENDED = "import sys, os; print(*({'bpy', 'matplotlib'} & sys.modules.keys()), flush=True); os._exit(0)"
"""Blender's own end may hang or crash where its handlers are registered."""


@pytest.mark.parametrize(
    ("loading", "brought"),
    [
        ("import bridge_demolition_addon.cli.main", []),
        ("import bridge_demolition_addon; bridge_demolition_addon.register()", ["bpy"]),
    ],
    ids=["command line", "add-on"],
)
def test_nobody_waits_for_matplotlib_who_draws_nothing(loading, brought):
    # In a process of its own, as other tests have loaded both here.
    done = subprocess.run([sys.executable, "-c", f"{loading}\n{ENDED}"], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1].split() == brought  # Blender may have said something before
