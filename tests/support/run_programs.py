# SPDX-License-Identifier: GPL-3.0-or-later
"""Programs of draws that need no Blender, and what they are asked."""

import sys
from dataclasses import replace

from support.checkout import ROOT, TESTS
from support.scenarios import SHORT_RUN

from bridge_demolition_addon.model.scenario.file import scenario_text

VERSIONS = {"program": "of tests"}


def program_in(folder):
    """Command of a program that simulates nothing, and the log in a folder of what it begins."""
    log = folder / "draws.log"
    log.touch()
    return command_with(log), log


def command_with(log):
    """Command of that program, whatever has to be found by it."""
    program = TESTS / "programs" / "runs_without_blender.py"
    start = f"import runpy, sys; sys.path.insert(0, {str(ROOT)!r}); sys.argv[:] = ['', {str(log)!r}]; "
    return [sys.executable, "-c", f"{start}runpy.run_path({str(program)!r}, run_name='__main__')"]


def request(deed, seed=1):
    """What is asked for a draw that is to do something."""
    return {"scenario": scenario_text(replace(SHORT_RUN, title=deed, seed=seed)), "study": ""}


def begun(log):
    """Deeds that were begun, in order, and the processes that did."""
    lines = [line.split(" ", 1) for line in log.read_text(encoding="utf-8").splitlines()]
    return [deed.rsplit(" ", 1)[0] for _, deed in lines], [int(process) for process, _ in lines]
