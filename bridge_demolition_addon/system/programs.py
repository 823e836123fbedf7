"""Programs of this package that run in processes of their own."""

import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import IO

_PACKAGE = Path(__file__).resolve().parents[1]


def program_command(
    module: str, blender: str = "", *, with_libraries: bool = False, one_thread: bool = False
) -> list[str]:
    """Return the command that runs `main` of a module of this package, from any folder; arguments may follow.

    A program of Blender runs it, without a window; this Python where none is given. Blender without preferences knows
    no extensions and none of their libraries, so it gets the paths of this process; so does this Python
    `with_libraries`, as Blender's own Python does not know them either. With `one_thread`, Blender has one, which is
    for programs that render nothing; see `processor`.
    """
    libraries = f"sys.path += {sys.path!r}; " if blender or with_libraries else ""
    paths = f"import sys; sys.path.insert(0, {str(_PACKAGE.parent)!r}); {libraries}"
    start = f"from {_PACKAGE.name}.{module} import main; main()"
    if not blender:
        load = f"from {_PACKAGE.name}.system.processor import load_on_one_core; load_on_one_core('bpy'); "
        return [sys.executable, "-c", paths + (load if one_thread else "") + start]
    threads = ["--threads", "1"] if one_thread else []
    return [
        *(blender, "--background", "--factory-startup", "--disable-autoexec", *threads),
        *("--python-exit-code", "1", "--python-expr", paths + start),
    ]


def start_program(
    command: Sequence[str], errors: IO[bytes], environment: Mapping[str, str] | None = None
) -> tuple[subprocess.Popen[str], IO[str], IO[str]]:
    """Start a program, and return it with the streams of its questions and its answers.

    Ctrl-C does not get to it: the process that started it ends it.
    """
    if sys.platform == "win32":
        new_group = subprocess.CREATE_NEW_PROCESS_GROUP
    else:
        new_group = 0
    process = subprocess.Popen(
        command,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=errors,
        env=environment,
        text=True,
        encoding="utf-8",
        errors="replace",
        start_new_session=sys.platform != "win32",
        creationflags=new_group,
    )
    assert process.stdin and process.stdout  # they are pipes
    return process, process.stdin, process.stdout
