"""Where Blender renders to: it takes braces in a path for variables, and ``#`` for the number of a frame."""

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from ...system.disk import whole_file


@contextmanager
def rendered_to(path: Path) -> Iterator[str]:
    """Give a path without any of that for Blender to write a file to, which then goes to its own path, whole."""
    with TemporaryDirectory(prefix="bda_") as folder:
        rendered = Path(folder) / path.name
        yield str(rendered)
        if rendered.exists():
            with whole_file(path) as part, rendered.open("rb") as source, part.open("wb") as target:
                shutil.copyfileobj(source, target)
