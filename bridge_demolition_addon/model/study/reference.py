"""Reference of all keys of a study file, made from the dataclasses that check them.

``python -m bridge_demolition_addon.model.study.reference docs/study_file.md`` writes it.
"""

import sys
from pathlib import Path

from ..scenario.reference import reference
from .settings import StudySettings

INTRODUCTION = """\
# Study files

<!-- Made by `python -m bridge_demolition_addon.model.study.reference docs/study_file.md`: change the code instead. -->

A study file is a [TOML](https://toml.io) file, which `bda study FILE --output DIR` runs; see [studies](studies.md).
Start from [i235_one_span.toml](../examples/studies/i235_one_span.toml). A key that is not listed here is refused, and
so is a value outside its limits.
"""


def study_reference() -> str:
    """Return every table and key of a study file with its default, limits and meaning, in Markdown."""
    return reference(INTRODUCTION, StudySettings)


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(study_reference(), encoding="utf-8", newline="\n")
