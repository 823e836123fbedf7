# SPDX-License-Identifier: GPL-3.0-or-later
"""Ask for a preview, print the number of its process once it is at work, and be killed: ``preview_and_die.py FILE``."""

import os
import signal
import sys
import time
from pathlib import Path

from bridge_demolition_addon.studies.preview_process import PreviewProcess
from bridge_demolition_addon.studies.preview_program import preview_program_command

process = PreviewProcess(preview_program_command())
process.ask(Path(sys.argv[1]).read_text(encoding="utf-8"))
while process.look() is None:
    time.sleep(0.05)
print(process.process_id, flush=True)
os.kill(os.getpid(), signal.SIGKILL)
