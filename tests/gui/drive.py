# SPDX-License-Identifier: GPL-3.0-or-later
"""Run inside Blender: do one job, a step at every turn of Blender's own loop, and quit.

blender --enable-event-simulate --python drive.py -- JOB FOLDER
"""

import importlib
import sys
import traceback
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent))

from person import Person

TURN_S = 0.03
"""Until the next step: Blender has then taken in the last one, and drawn what follows from it."""

job, folder = sys.argv[sys.argv.index("--") + 1 :]
person = Person(Path(folder))
module, *words = job.split("-")
steps = importlib.import_module(f"job_{module}").steps(person, *words)


def next_step() -> float | None:
    """A job yields the seconds until its next step, or None for the next turn."""
    try:
        return next(steps) or TURN_S
    except StopIteration:
        person.note("done")
    except Exception:
        person.note("every step can be taken", traceback.format_exc())
        list(person.picture("where_it_stopped"))
    bpy.ops.wm.quit_blender()
    return None


# The first frame in which Blender keeps a splash screen from being shown is the one before its window is up.
bpy.context.preferences.view.show_splash = False
bpy.context.preferences.use_preferences_save = False
bpy.app.timers.register(next_step, first_interval=1.0, persistent=True)
