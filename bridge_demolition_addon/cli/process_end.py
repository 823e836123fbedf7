"""The end of a process with Blender in it, whose own clean-up may hang or crash."""

import os
import sys
from typing import NoReturn


def end_process(status: int) -> NoReturn:
    """End this process at once with an exit status. Nothing is flushed or cleaned up.

    Windows tells all libraries of a process even when it ends by `os._exit`; Blender's then prints memory that was not
    freed as an error, to users who can do nothing about it. A process that is terminated tells none.
    """
    if sys.platform == "win32":
        import ctypes

        kernel = ctypes.WinDLL("kernel32")
        kernel.GetCurrentProcess.restype = ctypes.c_void_p
        kernel.TerminateProcess.argtypes = (ctypes.c_void_p, ctypes.c_uint)
        kernel.TerminateProcess(kernel.GetCurrentProcess(), status)
    os._exit(status)
