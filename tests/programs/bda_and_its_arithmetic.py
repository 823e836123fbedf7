# SPDX-License-Identifier: GPL-3.0-or-later
"""Print in a line of JSON what this process calculates with, and go on as the command line.

Arguments: how many cores to use at most, and those of `bda`.
"""

import ctypes
import hashlib
import json
import math
import os
import sys
from pathlib import Path

import numpy as np

from bridge_demolition_addon.cli.main import entry

NUMBERS = np.random.default_rng(1).uniform(0.0, 100.0, 10_000)


def digest(values):
    """Digest of numbers, by which other roundings are seen."""
    return hashlib.sha256(np.array(values, float).tobytes()).hexdigest()


def openblas():
    """Name of OpenBLAS's kernels in use, and number of its threads; None where numpy has another library."""
    paths = {line.split()[-1] for line in Path("/proc/self/maps").read_text().splitlines() if "openblas" in line}
    for path in sorted(paths):
        library = ctypes.CDLL(path)
        for prefix, suffix in (("scipy_", "64_"), ("scipy_", ""), ("", "64_"), ("", "")):
            try:
                kernel = getattr(library, f"{prefix}openblas_get_corename{suffix}")
                threads = getattr(library, f"{prefix}openblas_get_num_threads{suffix}")
            except AttributeError:
                continue
            kernel.restype = ctypes.c_char_p
            return kernel().decode(), threads()
    return None, None


cores = sorted(os.sched_getaffinity(0))[: int(sys.argv[1])]
os.sched_setaffinity(0, cores)
name, threads = openblas()
in_use = {
    "kernel": name,
    "threads": threads,
    "cores": len(cores),
    "numpy": digest(np.concatenate([np.exp(NUMBERS), np.log(NUMBERS), np.sin(NUMBERS), NUMBERS**3])),
    "c_library": digest([function(number) for function in (math.exp, math.log, math.sin) for number in NUMBERS]),
}
print(json.dumps(in_use), flush=True)
sys.argv[1:] = sys.argv[2:]
entry()
