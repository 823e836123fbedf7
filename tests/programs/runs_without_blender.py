# SPDX-License-Identifier: GPL-3.0-or-later
"""Be a program of draws that simulates nothing, but does what the title of a scenario says.

Usage: … LOG, a file to which it adds a line with the title and the seed of each draw it begins.
"""

import os
import signal
import sys
import time
import tomllib
from pathlib import Path

from bridge_demolition_addon.errors import OutputError, ScenarioError, SimulationError
from bridge_demolition_addon.studies.run_service import RunService

LOG = Path(sys.argv[1])
VERSIONS = {"program": "of tests"}
_kept = []
_played = []


def play(request, folder):
    scenario = tomllib.loads(request["scenario"])  # the model takes longer to load than all that is done here
    deed, seed = scenario["scenario"]["title"], scenario["scenario"]["seed"]
    with LOG.open("a", encoding="utf-8") as log:
        log.write(f"{os.getpid()} {deed} {seed}\n")
    (folder / "begun.txt").write_text(deed, encoding="utf-8")
    _DEEDS.get(deed, lambda _folder: None)(folder)
    _played.append(deed)
    (folder / "outlines.npz").write_bytes(b"outlines")
    outputs = {"reach_m": seed / 2**31, "broken": seed % 7}
    if ball := scenario.get("ball"):
        outputs["heavy"] = ball["mass_kg"] > 9000.0
    if charges := scenario.get("charges"):
        outputs["success"] = sum(charge["mass_kg"] for charge in charges) > 1.0
    elif "[[criteria]]" in request["study"]:
        outputs["success"] = outputs["heavy"]
    return {"outputs": outputs, "fingerprint": {"motion": f"{seed:x}"}}


def raising(error):
    def deed(_folder):
        raise error

    return deed


def crash(_folder):
    os.kill(os.getpid(), signal.SIGSEGV)


def crash_if_shared(folder):
    if _played:
        crash(folder)


def take_memory(_folder):
    while True:
        _kept.append(bytearray(os.urandom(1_000_000)))
        time.sleep(0.001)


_DEEDS = {
    "crash": crash,
    "crash if shared": crash_if_shared,
    "exit": lambda _folder: os._exit(3),
    "fail": raising(SimulationError("the world is not as expected")),
    "hang": lambda _folder: time.sleep(1000),
    "kill": lambda _folder: os.kill(os.getpid(), signal.SIGKILL),
    "lose a body": raising(OutputError("a body was lost")),
    "no memory": raising(MemoryError()),
    "refuse": raising(ScenarioError("time.duration_s is 0: expected more")),
    "say": lambda _folder: os.write(1, b"Blender 5.2.3 (hash 1234)\nbda-draw nonsense\n"),
    "stumble": lambda _folder: {}["nothing"],
    "take memory": take_memory,
    "take time": lambda _folder: time.sleep(0.3),
    "write elsewhere": lambda folder: (folder / "nowhere" / "nowhere").touch(),
    "write much": lambda folder: (folder / "much.bin").write_bytes(bytes(200_000)),
}

if __name__ == "__main__":
    print("Blender 5.2.3 says hello", flush=True)
    RunService().serve(VERSIONS, play)
