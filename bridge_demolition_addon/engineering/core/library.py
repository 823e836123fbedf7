"""Find the compiled core, see that it is the one that this package was written for, and look up its functions.

The library lies beside this module where pip built it, and in the package `bridge_demolition_core` in the extension.
"""

from __future__ import annotations

import ctypes
import importlib.util
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

from ...errors import CoreError

VERSION = 9
"""`BDA_CORE_VERSION` in core/src/core.h."""

FILE = "bda_core" + {"win32": ".dll", "darwin": ".dylib"}.get(sys.platform, ".so")
FOLDER = Path(__file__).parent
CHECKOUT = Path(__file__).parents[3]
PACKAGE = "bridge_demolition_core"


@cache
def library() -> ctypes.CDLL:
    """Return the core.

    Raises
    ------
    CoreError
        It is missing, cannot be loaded, or is another than this package was written for.
    """
    builder = CHECKOUT / "core" / "build_core.py"
    return load(FOLDER / FILE, builder if builder.is_file() else None)


def missing_core() -> CoreError | None:
    """Return why there is no core; None where there is."""
    try:
        library()
    except CoreError as error:
        return error
    return None


def core_sources() -> str:
    """Return the digest of the files that the core was built from: another one may calculate otherwise."""
    return _sources_of(library())


@cache
def function(name: str, *arguments: Any, returns: Any = ctypes.c_int) -> Callable[..., Any]:
    """Return a function of the core that takes arguments of these types of ctypes."""
    found = library()[name]
    found.argtypes, found.restype = arguments, returns
    return found


def load(beside: Path, builder: Path | None = None) -> ctypes.CDLL:
    """Return the library that lies there, or in the package of its own; `builder` is what builds that of a checkout."""
    remedy = f"run: {Path(sys.executable).name} {builder}" if builder else "install the program again"
    path = beside if beside.is_file() else _packaged()
    if path is None:
        raise CoreError(f"is missing ({beside}): {remedy}")
    try:
        found = ctypes.CDLL(str(path))
        version = int(found["bda_core_version"]())
    except (OSError, AttributeError) as error:
        raise CoreError(f"cannot be loaded ({error}): {remedy}") from error
    if version != VERSION:
        raise CoreError(f"has version {version}, and version {VERSION} is needed ({path}): {remedy}")
    if builder and _sources_of(found) != _digest(builder):
        raise CoreError(f"is of other sources than those in {builder.parent} ({path}): {remedy}")
    return found


def _packaged() -> Path | None:
    """Return the path of the library in the package of its own; None where that is not installed."""
    if importlib.util.find_spec(PACKAGE) is None:
        return None
    path = Path(importlib.import_module(PACKAGE).library_path())
    return path if path.is_file() else None


def _sources_of(found: ctypes.CDLL) -> str:
    """Return the digest of the files that a library was built from."""
    sources = found["bda_core_sources"]
    sources.restype = ctypes.c_char_p
    return bytes(sources()).decode().split()[0]


def _digest(builder: Path) -> str:
    """Return the digest of the files that a checkout has."""
    spec = importlib.util.spec_from_file_location("source_digest", builder.with_name("source_digest.py"))
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return str(module.digest())
