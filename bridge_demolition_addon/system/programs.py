"""Programs of this package that run in processes of their own."""

import sys
from pathlib import Path

_PACKAGE = Path(__file__).resolve().parents[1]


def program_command(module: str, blender: str = "") -> list[str]:
    """Return the command that runs `main` of a module of this package, from any folder; arguments may follow.

    Parameters
    ----------
    module
        Name of the module within the package.
    blender
        Program of Blender that runs it, without a window; this Python where it is empty. Blender without preferences
        knows no extensions and none of their libraries, so it gets the paths of this process.
    """
    libraries = f"sys.path += {sys.path!r}; " if blender else ""
    start = (
        f"import sys; sys.path.insert(0, {str(_PACKAGE.parent)!r}); {libraries}"
        f"from {_PACKAGE.name}.{module} import main; main()"
    )
    if not blender:
        return [sys.executable, "-c", start]
    return [blender, "--background", "--factory-startup", "--python-exit-code", "1", "--python-expr", start]
