# SPDX-License-Identifier: GPL-3.0-or-later
"""Be `bda`, whose draws are run by the program that simulates nothing. Usage: … LOG LARGEST ARGUMENTS OF BDA

LARGEST is the size in bytes above which no file can be written, as on a full disk; 0 for none.
"""

import sys

LOG, LARGEST, *ARGUMENTS = sys.argv[1:]
if int(LARGEST):
    import resource
    import signal

    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (int(LARGEST), int(LARGEST)))

from functools import partial  # noqa: E402
from pathlib import Path  # noqa: E402

from support.run_programs import VERSIONS, command_with  # noqa: E402

from bridge_demolition_addon.cli import ensemble  # noqa: E402
from bridge_demolition_addon.cli.main import entry  # noqa: E402

ensemble.LocalProcesses = partial(ensemble.LocalProcesses, command=command_with(Path(LOG)), versions=VERSIONS)
sys.argv[1:] = ARGUMENTS
entry()
