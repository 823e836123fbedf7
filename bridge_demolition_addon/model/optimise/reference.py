"""Reference of all keys of an optimisation file, made from the dataclasses that check them.

``python -m bridge_demolition_addon.model.optimise.reference docs/optimise_file.md`` writes it.
"""

import sys
from pathlib import Path

from ..scenario.reference import reference
from .settings import OptimiseSettings

INTRODUCTION = """\
# Optimisation files

<!-- Made by `python -m bridge_demolition_addon.model.optimise.reference docs/optimise_file.md`: change the code. -->

An optimisation file is a [TOML](https://toml.io) file, which `bda optimise FILE --output DIR` runs; see
[optimisation](optimise.md). Start from [least_reach.toml](../examples/optimisations/least_reach.toml). A key that
is not listed here is refused, and so is a value outside its limits.
"""


def optimise_reference() -> str:
    """Return every table and key of an optimisation file with its default, limits and meaning, in Markdown."""
    return reference(INTRODUCTION, OptimiseSettings)


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(optimise_reference(), encoding="utf-8", newline="\n")
