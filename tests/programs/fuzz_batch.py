# SPDX-License-Identifier: GPL-3.0-or-later
"""Play sequences of steps in this process, and tell of each step. Usage: … PLAYER FOLDER BUSY_S [--bare]

Each line of standard input is a sequence as it is drawn, in JSON; news of it come as lines of JSON. A step that takes
longer than BUSY_S of the processors ends the process by SIGPROF.
"""

import faulthandler
import json
import os
import signal
import sys
import tempfile
from pathlib import Path

from fuzzing.players import player_named
from fuzzing.sequences import Drawn, play, telling


def main(name: str, folder: str, busy_s: str, *options: str) -> None:
    """Play all sequences, each in a folder of its own."""
    player_class = player_named(name)
    with telling(Path(folder) / "printed.log") as tell:
        faulthandler.enable()
        faulthandler.register(signal.SIGPROF, chain=True)  # prints where it is, and lets it end
        for line in sys.stdin:
            with tempfile.TemporaryDirectory(dir=folder, ignore_cleanup_errors=True) as position:
                os.chdir(position)
                player = player_class(Path(position), bare="--bare" in options)
                play(player, Drawn(*json.loads(line)).steps(player_class), tell, busy_s=float(busy_s))
                player.end()
                os.chdir(folder)
            tell({"done": True})
    os._exit(0)  # Blender's own end may hang


main(*sys.argv[1:])
