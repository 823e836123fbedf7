"""Reference of all keys of a search file, made from the dataclasses that check them.

``python -m bridge_demolition_addon.model.search.reference docs/search_file.md`` writes it.
"""

import sys
from pathlib import Path

from ..scenario.reference import reference
from .settings import SearchSettings

INTRODUCTION = """\
# Search files

<!-- Made by `python -m bridge_demolition_addon.model.search.reference docs/search_file.md`: change the code. -->

A search file is a [TOML](https://toml.io) file, which `bda search FILE --output DIR` runs; see [searches](search.md).
Start from [lightest_ball.toml](../examples/searches/lightest_ball.toml). A key that is not listed here is
refused, and so is a value outside its limits.
"""


def search_reference() -> str:
    """Return every table and key of a search file with its default, limits and meaning, in Markdown."""
    return reference(INTRODUCTION, SearchSettings)


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(search_reference(), encoding="utf-8", newline="\n")
