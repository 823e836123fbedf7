"""Reference pages of the files of studies, searches and optimisations, made from the tables that check their keys.

``python -m bridge_demolition_addon.model.ensemble.reference docs`` writes them all to a folder.
"""

import sys
from pathlib import Path

from ..optimise.settings import OptimiseSettings
from ..scenario.reference import reference
from ..search.settings import SearchSettings
from ..study.settings import EnsembleSettings, StudySettings

_PAGES: dict[str, tuple[type[EnsembleSettings], str, str, str, str]] = {
    "study_file.md": (StudySettings, "Study", "A study", "[studies](studies.md)", "studies/i235_one_span.toml"),
    "search_file.md": (SearchSettings, "Search", "A search", "[searches](search.md)", "searches/lightest_ball.toml"),
    "optimise_file.md": (
        OptimiseSettings,
        "Optimisation",
        "An optimisation",
        "[optimisation](optimise.md)",
        "optimisations/least_charge.toml",
    ),
}
"""Of each page: settings, name of the file and with an article, the page that explains it, an example."""

_INTRODUCTION = """\
# {name} files

<!-- Made by `python -m bridge_demolition_addon.model.ensemble.reference docs`: change the code instead. -->

{named} file is a [TOML](https://toml.io) file, which `bda {command} FILE --output DIR` runs; see {page}. Start from
[{example_name}](../examples/{example}). A key that is not listed here is refused, and so is a value outside its limits.
"""


def reference_pages() -> dict[str, str]:
    """Return every table and key with its default, limits and meaning, in Markdown, by the names of the pages."""
    return {
        page: reference(
            _INTRODUCTION.format(
                name=name,
                named=named,
                command=settings.table,
                page=link,
                example=example,
                example_name=Path(example).name,
            ),
            settings,
        )
        for page, (settings, name, named, link, example) in _PAGES.items()
    }


if __name__ == "__main__":
    for name, text in reference_pages().items():
        (Path(sys.argv[1]) / name).write_text(text, encoding="utf-8", newline="\n")
